//! Colours of vertices, judged as a picture shows them.

use super::*;

/// A tetrahedron, each of whose corners has another colour, one of them a saturated one.
const COLORED: &str = "v 1 1 1 1 0 0\nv -1 -1 1 0.2 0.9 0.3\nv -1 1 -1 0.1 0.2 1\n\
                       v 1 -1 -1 1 1 0.5\nf 1 2 4\nf 2 1 3\nf 3 1 4\nf 4 2 3\n";

#[test]
fn colors_of_vertices_are_within_a_step() {
    let model = load(COLORED);
    assert_eq!(Shading::of(&model), Shading::ColoredGouraud);
    let mut pixels = 0;
    for view in views() {
        for shading in [Shading::Colored, Shading::ColoredGouraud] {
            let outcome = pass(&model, &View { shading, ..view });
            pixels += outcome.arithmetic.deviation.pixels;
            assert!(outcome.places.judged > 50_000, "{outcome:?}");
        }
    }
    assert!(pixels > 500_000, "{pixels}");
}

#[test]
fn a_wrong_color_of_a_vertex_is_found() {
    let model = load(COLORED);
    let mut broken = model.clone();
    for color in &mut broken.vertex_colors {
        color.swap(0, 2);
    }
    for shading in [Shading::Colored, Shading::ColoredGouraud] {
        let view = View { shading, yaw_degrees: 30.0, ..FRONT };
        let wrong = fail(&broken, &view);
        assert!(wrong.iter().all(|wrong| wrong.fault == Fault::Color), "{shading:?}");
    }
}

/// A view of a model without colours is an error, not a black picture.
#[test]
fn a_model_without_colors_is_refused() {
    let model = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(Shading::of(&model), Shading::Gouraud);
    for shading in [Shading::Colored, Shading::ColoredGouraud] {
        let error = check(&model, &View { shading, ..FRONT }).unwrap_err().to_string();
        assert!(error.contains("colours of vertices"), "{error}");
    }
}
