//! The core's arithmetic against the f64 reference on the same vertices: coverage equal, depth
//! within one unit of its format, colour within one of 256 steps, for every model, and every
//! precision at each size and at each distance.

use host_tools::{
    check::{Bounds, Checker, DepthFormat, Projection, Shading, Subpixel, View},
    model::{Model, Options},
};
use rasterizer_tests::{other_models, shipped_models};

/// Camera distances: far away; the model fills the picture; the near plane cuts its surface; inside
/// the model.
const DISTANCES: [f64; 4] = [40.0, 3.0, 0.9, 0.05];

fn sweep(path: &std::path::Path) {
    let model = Model::load(path, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
    let precisions = [
        (Subpixel::S4, DepthFormat::U16, Shading::Gouraud),
        (Subpixel::S8, DepthFormat::U32, Shading::Gouraud),
        (Subpixel::S8, DepthFormat::U16, Shading::Flat),
        (Subpixel::S4, DepthFormat::U32, Shading::Unlit),
        (Subpixel::S4, DepthFormat::Float16, Shading::Flat),
        (Subpixel::S8, DepthFormat::Float16, Shading::Gouraud),
    ];
    let checker = Checker::new(&model);
    let mut covered = 0;
    let sizes = [[64, 64], [320, 240], [640, 480], [1, 1], [2047, 3]];
    for (i, size) in sizes.into_iter().enumerate() {
        for (k, distance) in DISTANCES.into_iter().enumerate() {
            // Every other one, so that each meets all sizes and all distances.
            let precisions = precisions.into_iter().enumerate().skip((i + k) % 2).step_by(2);
            for (turn, (subpixel, depth, shading)) in precisions {
                let view = View {
                    size,
                    distance,
                    near: 0.02,
                    yaw_degrees: 77.0 * turn as f64 + 5.0,
                    pitch_degrees: 31.0 * turn as f64,
                    subpixel,
                    depth,
                    shading,
                    ..View::default()
                };
                covered += judge(&checker, &model, &view);
            }
        }
    }
    for height in [0.1, 2.2, 50.0] {
        let view = View { projection: Projection::Orthographic { height }, ..View::default() };
        covered += judge(&checker, &model, &view);
    }
    assert!(covered > 100_000, "{}: only {covered} pixels were drawn", path.display());
}

fn judge(checker: &Checker<'_>, model: &Model, view: &View) -> usize {
    let outcome = match checker.check(view) {
        Ok(report) => report.outcome,
        // Three rows are so low that the guard band reaches 89.8 degrees to the side, where S8 has
        // no range for what surrounds the camera.
        Err(error) => {
            let is_too_wide = view.size[1] <= 3 && view.distance < 1.0;
            assert!(
                is_too_wide && view.subpixel == Subpixel::S8,
                "{}: {error}\n{view:#?}",
                model.name
            );
            return 0;
        }
    };
    assert!(
        outcome.is_within(&Bounds::ARITHMETIC),
        "{}: {:#?}\n{:#?}\n{:#?}\n{view:#?}",
        model.name,
        outcome.arithmetic,
        outcome.end_to_end.vertices,
        outcome.places
    );
    // Snapping moves a vertex by up to half a sub-pixel, the transform by up to another eighth.
    let error =
        outcome.arithmetic.vertices.vertex_error_max_px * 2f64.powi(view.subpixel.bits() as i32);
    assert!(error <= 0.625, "{}: a vertex is {error} sub-pixels off\n{view:#?}", model.name);
    outcome.arithmetic.deviation.pixels
}

#[test]
fn shipped_models_are_exact() {
    shipped_models().iter().for_each(|path| sweep(path));
}

#[test]
fn other_models_are_exact() {
    other_models().iter().for_each(|path| sweep(path));
}
