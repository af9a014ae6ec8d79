//! Vertices lie where exact arithmetic puts them, for cameras and objects of all magnitudes, or the
//! object is refused.
//!
//! A vertex is at most 5/8 of a sub-pixel from its exact place: half for snapping, and an eighth
//! for arithmetic.

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    camera::{Camera, Perspective},
    geometry::Projection,
    numbers::{S4, S8, Subpixel},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Placed, Random, Scene, Surface, area,
    ends::{self, Stage},
    exact::{Lens, judge},
    pixel_camera,
};

/// Whether the core accepts the scene.
fn is_accepted<S: Subpixel, P: Projection>(stage: &Stage, camera: &Camera<P>) -> bool {
    let mesh = stage.surface.mesh();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(stage.pose);
    let mut storage = vec![Placed::<S>::EMPTY; mesh.vertex_count()];
    object.project(camera, &mut storage).is_ok()
}

#[test]
fn vertices_of_parallel_projections_lie_where_they_should() {
    let mut random = Random::new(11);
    let mut placed = [0; 2];
    for _ in 0..100_000 {
        let stage = ends::stage(&mut random);
        let (lens, viewport) = (ends::orthographic(&mut random), ends::viewport(&mut random));
        let camera = stage.camera(lens, viewport);
        let exact = Lens::orthographic(&lens, f64::from(viewport.size.height));
        if is_accepted::<S4, _>(&stage, &camera) {
            placed[0] += judge::<S4, _>(&stage, camera, &exact).placed;
        }
        if is_accepted::<S8, _>(&stage, &camera) {
            placed[1] += judge::<S8, _>(&stage, camera, &exact).placed;
        }
    }

    assert!(placed.iter().all(|&count| count > 10_000), "{placed:?}");
}

#[test]
fn vertices_in_perspective_lie_where_they_should() {
    let mut random = Random::new(12);
    let mut placed = [0; 2];
    for _ in 0..100_000 {
        let stage = ends::stage(&mut random);
        let [near, far] = ends::depth_range(&mut random);
        let viewport = ends::viewport(&mut random);
        let focal = ends::distance(&mut random);
        let lens = Perspective::with_focal_length(focal, near, far).unwrap();
        let camera = stage.camera(lens, viewport);
        let exact = Lens::perspective(&lens, focal.to_num());
        if is_accepted::<S4, _>(&stage, &camera) {
            placed[0] += judge::<S4, _>(&stage, camera, &exact).placed;
        }
        if is_accepted::<S8, _>(&stage, &camera) {
            placed[1] += judge::<S8, _>(&stage, camera, &exact).placed;
        }
    }

    assert!(placed.iter().all(|&count| count > 10_000), "{placed:?}");
}

/// A vertex on the guard band's right or lower end is placed in its last sub-pixel; one beyond an
/// end is clipped.
#[test]
fn guard_band_reaches_1024_pixels() {
    fn ends<S: Subpixel>() {
        let surface = Surface::new(
            vec![[1024, -1024, 0], [-1024, 1024, 0], [1025, 0, 0], [0, -1025, 0]],
            vec![[0, 1, 2], [1, 3, 0]],
        );
        let mesh = surface.mesh();
        // The middle lies at (50, 20).
        let placed = Scene::new(&mesh, pixel_camera(area(0, 0, 100, 40))).vertices::<S>();
        let last = 1024.0 - 1.0 / f64::from(1 << S::BITS);
        let want =
            [Some([50.0 + last, 20.0 + last]), Some([50.0 - 1024.0, 20.0 - 1024.0]), None, None];
        assert_eq!(placed, want);
    }
    ends::<S4>();
    ends::<S8>();
}
