//! Edges of a model as lines, and the lines and points of its file.

use super::*;

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
