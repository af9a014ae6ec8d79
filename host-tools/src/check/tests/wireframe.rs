//! Edges of a model as lines.

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
