//! Edges of a model as lines, and the lines and points of its file.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    geometry::ScreenVertex,
    numbers::S4,
    output::{Frame, Target as _},
    raster::{self, Window},
};

use super::{
    super::judged_lines::{Canvas, End, Owners},
    *,
};

/// A cube with its edges, seen from a corner.
fn cube(least_degrees: f64) -> Model {
    let obj = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
               f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let options = Options { edges_degrees: Some(least_degrees), ..Options::default() };
    Model::from_bytes(std::path::Path::new("cube.obj"), obj.as_bytes(), &options).unwrap()
}

/// The pixels of lines: all that are not background, as hidden surfaces have its colour.
fn line_pixels(model: &Model, view: &View, hides_lines: bool) -> usize {
    let picture = wireframe(model, view, hides_lines).unwrap();
    picture.pixels.iter().filter(|pixel| pixel.color != view.background).count()
}

#[test]
fn a_cube_hides_three_of_its_twelve_edges() {
    let model = cube(0.0);
    for projection in [FRONT.projection, Projection::Orthographic { height: 2.5 }] {
        for subpixel in [Subpixel::S4, Subpixel::S8] {
            let view =
                View { projection, subpixel, yaw_degrees: 40.0, pitch_degrees: 30.0, ..FRONT };
            let [all, visible] = [false, true].map(|hides| line_pixels(&model, &view, hides));
            // Those behind are shorter on the screen; where lines cross, pixels are shared.
            let part = visible as f64 / all as f64;
            assert!((0.7..0.85).contains(&part), "{visible} of {all}");
        }
    }
}

#[test]
fn edges_without_an_angle_are_left_out() {
    let view = View { yaw_degrees: 40.0, pitch_degrees: 30.0, ..FRONT };
    assert_eq!(line_pixels(&cube(100.0), &view, false), 0);
}

/// A cube with its edges and three lines to a point before it, and behind it another point.
fn with_elements() -> Model {
    let obj = "mtllib m.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\n\
               v 1 1 1\nv -1 1 1\nv 0 0 1.5\nv 0 0 -1.5\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\n\
               f 3 4 8 7\nf 4 1 5 8\nusemtl red\nl 9 5\nl 9 6\nusemtl blue\np 9 10\n";
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("m.obj"), obj).unwrap();
    fs::write(directory.path().join("m.mtl"), "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1")
        .unwrap();
    let options = Options { edges_degrees: Some(0.0), ..Options::default() };
    Model::load(directory.path().join("m.obj"), &options).unwrap()
}

fn count(picture: &FixedPicture, color: [u8; 3]) -> usize {
    picture.pixels.iter().filter(|pixel| pixel.color == color && pixel.depth > 0).count()
}

/// Colours are those of materials; the point behind the cube is hidden by its surface alone.
#[test]
fn lines_and_points_of_the_file_are_drawn() {
    let (model, blue, red) = (with_elements(), [0, 0, 255], [255, 0, 0]);
    let seen = render(&model, &FRONT).unwrap();
    // One point of 3 x 3 pixels.
    assert_eq!(count(&seen, blue), 9);
    assert!(count(&seen, red) > 20);
    let larger = LineOptions { line_width: 3, point_size: 8, ..LineOptions::default() };
    let larger = render_with_lines(&model, &FRONT, larger).unwrap();
    assert_eq!(count(&larger, blue), 64);
    assert!(count(&larger, red) > 2 * count(&seen, red));
    // The rest is the surface.
    let bare = surfaces(&model, &FRONT, None).unwrap();
    let pairs = seen.pixels.iter().zip(&bare.pixels);
    let different = pairs.filter(|(one, other)| one != other).count();
    assert_eq!(different, count(&seen, blue) + count(&seen, red));
    // Without surfaces both points are seen, from the side.
    let view = View { yaw_degrees: 90.0, ..FRONT };
    let wires = LineOptions { edges: Edges::All, ..LineOptions::default() };
    let both = count(&render_with_lines(&model, &view, wires).unwrap(), blue);
    // One of the red lines comes nearer from the middle of its point: up to two of its pixels.
    assert!((16..=18).contains(&both), "{both}");
}

/// Edges over surfaces are those that surfaces do not hide.
#[test]
fn edges_are_drawn_over_surfaces() {
    let model = cube(0.0);
    let view = View { yaw_degrees: 40.0, pitch_degrees: 30.0, ..FRONT };
    let color = [250, 0, 250];
    let with = |edges| {
        let options = LineOptions { edges, edge_color: color, ..LineOptions::default() };
        render_with_lines(&model, &view, options).unwrap()
    };
    let (over, visible) = (with(Edges::Over), with(Edges::Visible));
    assert!(count(&over, color) > 100);
    assert_eq!(count(&over, color), count(&visible, color));
    let bare = render(&model, &view).unwrap();
    for ((over, visible), bare) in over.pixels.iter().zip(&visible.pixels).zip(&bare.pixels) {
        assert_eq!(over.color, if visible.color == color { color } else { bare.color });
    }
}

/// A file without faces has no surfaces to draw.
#[test]
fn lines_alone_are_a_picture() {
    let model = load("v -1 -1 0\nv 1 -1 0\nv 0 1 0\nl 1 2 3 1\n");
    let picture = render(&model, &FRONT).unwrap();
    assert!(count(&picture, [200; 3]) > 60);
    assert!(picture.pixels.iter().all(|pixel| pixel.depth == 0 || pixel.color == [200; 3]));
}

/// In both precisions, from far, and cut by the near plane; all edges, and those that are seen.
#[test]
fn lines_and_points_pass() {
    let [mut lines, mut points, mut pixels, mut hidden] = [0; 4];
    for model in [with_elements(), cube(0.0), colored_elements()] {
        for (distance, subpixel) in [(4.0, Subpixel::S4), (4.0, Subpixel::S8), (1.6, Subpixel::S8)]
        {
            for edges in [Edges::None, Edges::All, Edges::Visible] {
                for (line_width, point_size) in [(1, 3), (4, 8)] {
                    let options =
                        LineOptions { edges, line_width, point_size, ..LineOptions::default() };
                    let view = View {
                        distance,
                        subpixel,
                        yaw_degrees: 33.0,
                        pitch_degrees: 21.0,
                        ..FRONT
                    };
                    let found = judge_lines(&model, &view, options).unwrap();
                    assert!(found.is_within(), "{edges:?} at {distance}: {found:?}");
                    lines += found.lines;
                    points += found.points;
                    pixels += found.line_pixels;
                    hidden += found.line_pixels_hidden;
                    // Nothing hides edges that are drawn without surfaces.
                    assert!(
                        edges != Edges::All
                            || model.points.iter().any(|p| !p.is_empty())
                            || found.line_pixels_hidden < found.line_pixels / 4
                    );
                }
            }
        }
    }
    assert!(
        lines > 300 && points > 20 && pixels > 20_000 && hidden > 2_000,
        "{lines} {points} {pixels} {hidden}"
    );
    let shipped = shipped("gear.obj");
    let found = judge_lines(&shipped, &FRONT, LineOptions::default()).unwrap();
    assert_eq!(found, LineOutcome::default());
}

/// Two lines and a point in the colours of their vertices.
fn colored_elements() -> Model {
    let obj = "v -1 -1 0 1 0 0\nv 1 -0.8 0.3 0 1 0\nv 0.2 0.9 -0.5 0 0 1\nv 0.1 0.1 0.1 1 1 0\n\
               l 1 2 3\np 4\n";
    Model::from_bytes(std::path::Path::new("m.obj"), obj.as_bytes(), &Options::default()).unwrap()
}

/// A frame that the core has drawn, then changed in one pixel.
#[test]
fn wrong_pixels_of_lines_are_found() {
    let view = FRONT;
    let vertex = |x: i32, y: i32, depth| {
        ScreenVertex::<S4, u32, [u16; 0]>::checked(x, y, depth, []).unwrap()
    };
    let ends = [vertex(100, 200, 9_000_000), vertex(900, 640, 5_000_000)];
    let line = raster::Line::new(ends.each_ref()).unwrap();
    let before =
        Canvas { colors: vec![Rgb888::new(1, 2, 3); 320 * 240], depth: vec![0; 320 * 240] };
    let mut after = before.clone();
    let color = Rgb888::new(200, 100, 50);
    let draw = |frame: &mut Frame<'_, Rgb888, &mut [u32]>| {
        frame.fill(&line, &Window::new(&view.area()), color)
    };
    after.draw(&view, draw).unwrap();
    let mut owners = Owners::new::<S4>(&view, LineOptions::default());
    owners.add_line(ends.map(|end| End::of(&end, [200.0, 100.0, 50.0]).unwrap()));
    let judge = |after: &Canvas| owners.judge(&before, after);
    let right = judge(&after);
    assert!(right.is_within() && right.line_pixels == 50, "{right:?}");

    let drawn = after.depth.iter().position(|&depth| depth != 0).unwrap();
    let place = Some([drawn % 320, drawn / 320]);
    let mut missing = after.clone();
    (missing.depth[drawn], missing.colors[drawn]) = (0, before.colors[drawn]);
    let found = judge(&missing);
    assert_eq!((found.line_coverage_mismatches, found.line_first_wrong), (1, place));
    let mut extra = after.clone();
    extra.depth[0] = 7;
    assert_eq!(judge(&extra).line_first_wrong, Some([0, 0]));
    let mut deep = after.clone();
    deep.depth[drawn] += 5;
    let found = judge(&deep);
    assert!(found.line_depth_max_ulp > 3.0 && !found.is_within(), "{found:?}");
    let mut tinted = after;
    tinted.colors[drawn] = Rgb888::new(200, 103, 50);
    let found = judge(&tinted);
    assert!(found.line_color_max_error == 3.0 && found.line_first_wrong == place, "{found:?}");
}
