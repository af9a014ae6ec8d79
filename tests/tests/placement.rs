//! Vertices lie where exact arithmetic puts them, for cameras and objects of all magnitudes, or the
//! object is refused.
//!
//! A vertex is at most 5/8 of a sub-pixel from its exact place: half for snapping, and an eighth
//! for arithmetic.

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    camera::{Camera, Orthographic, Perspective},
    geometry::Projection,
    numbers::{S4, S8, Subpixel, Vec3},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Placed, Random, Scene, Surface, area,
    ends::{self, Stage},
    pixel_camera,
};

/// In sub-pixels.
const TOLERANCE: f64 = 0.5 + 0.125;
const GUARD: f64 = 1024.0;

/// A projection in f64.
#[derive(Clone, Copy)]
struct Lens {
    /// Pixels per unit at w = 1.
    magnification: f64,
    is_perspective: bool,
    near: f64,
    far: f64,
}

impl Lens {
    fn perspective(lens: &Perspective, magnification: f64) -> Self {
        Self {
            magnification,
            is_perspective: true,
            near: lens.near().to_num(),
            far: lens.far().to_num(),
        }
    }

    fn orthographic(lens: &Orthographic, height: f64) -> Self {
        Self {
            magnification: height / lens.height().to_num::<f64>(),
            is_perspective: false,
            near: lens.near().to_num(),
            far: lens.far().to_num(),
        }
    }
}

type Vector = [f64; 3];

/// A row of the matrix from quanta to clip space, and its translation.
type Row = (Vector, f64);

/// The matrix's rows: right, down and away, the first two in guard bands at w = 1.
fn matrix(stage: &Stage, lens: &Lens) -> [Row; 3] {
    let [turn, view] = [stage.pose.rotation, stage.rotation.inverse()]
        .map(|rotation| rotation.rows().map(|row| row.map(|c| c.to_num::<f64>())));
    let apply =
        |m: &[Vector; 3], v: Vector| m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
    let vector = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65_536.0);
    let scale: f64 = stage.pose.scale.to_num();
    let quantum =
        f64::from(stage.surface.scale.mantissa()) * 2f64.powi(stage.surface.scale.exponent());
    let to_view = |v: Vector| {
        let [x, y, z] = apply(&view, v);
        [x * lens.magnification / GUARD, -y * lens.magnification / GUARD, -z]
    };
    let column = |axis: usize| {
        let mut unit = [0.0; 3];
        unit[axis] = scale * quantum;
        to_view(apply(&turn, unit))
    };
    let columns = [0, 1, 2].map(column);
    let (translation, eye) = (vector(stage.pose.translation), vector(stage.eye));
    let offset = apply(&turn, vector(stage.surface.offset).map(|c| c * scale));
    let from_eye = [0, 1, 2].map(|i| offset[i] + translation[i] - eye[i]);
    let origin = to_view(from_eye);
    [0, 1, 2].map(|row| (columns.map(|column| column[row]), origin[row]))
}

/// Checks where the vertices lie. Returns how many are on the screen.
fn judge<S: Subpixel, P: Projection>(stage: &Stage, camera: Camera<P>, lens: &Lens) -> usize {
    let mesh = stage.surface.mesh();
    let scene = Scene { pose: stage.pose, ..Scene::new(&mesh, camera) };
    let rows = matrix(stage, lens);
    let (entries, origin) = rows[2];
    let reach = entries.iter().fold(origin.abs(), |sum, c| sum + c.abs() * 32_768.0);
    let viewport = camera.viewport();
    let sides = [viewport.size.width, viewport.size.height].map(f64::from);
    let corner = [viewport.top_left.x, viewport.top_left.y].map(f64::from);

    let placed = scene.vertices::<S>();
    let mut placed_count = 0;
    let positions = (0..).map_while(|index| mesh.tables().positions.get(index));
    for (index, position) in positions.enumerate() {
        let p = position.map(f64::from);
        let [x, y, z] =
            rows.map(|(row, origin)| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + origin);
        let w = if lens.is_perspective { z } else { 1.0 };
        let subpixel = 1.0 / f64::from(1 << S::BITS);
        // Whether it lies on one side of all planes by more than an eighth of a sub-pixel, and 2^-20
        // of its distance, or in a parallel projection 2^-27 of the farthest.
        let farthest = lens.far.max(reach);
        let is_certain = |margin: f64| {
            let across = margin * subpixel / 8.0 / GUARD;
            let away = if lens.is_perspective {
                margin * 2f64.powi(-20) * z.abs()
            } else {
                margin * 2f64.powi(-27) * farthest
            };
            z > lens.near + away && z < lens.far - away && x.abs().max(y.abs()) < w * (1.0 - across)
        };
        let Some(place) = placed.get(index) else {
            // The whole mesh lies outside the picture, which reaches half a viewport to each side
            // of the middle.
            let is_seen =
                x.abs() * GUARD < sides[0] / 2.0 * w && y.abs() * GUARD < sides[1] / 2.0 * w;
            assert!(!(is_certain(1.0) && is_seen), "vertex {index} is seen: {stage:?}");
            continue;
        };
        match place {
            None => {
                assert!(!is_certain(1.0), "vertex {index} is on the screen: {stage:?} {lens}");
            }
            Some([px, py]) => {
                assert!(is_certain(-1.0), "vertex {index} is not on the screen: {stage:?} {lens}");
                // The guard band's last sub-pixel is cut off.
                placed_count += 1;
                for (axis, (got, c)) in [(px, x), (py, y)].into_iter().enumerate() {
                    let exact =
                        (c / w * GUARD).min(GUARD - subpixel) + corner[axis] + sides[axis] / 2.0;
                    assert!(
                        (got - exact).abs() <= TOLERANCE * subpixel,
                        "vertex {index}: {got} {exact} {stage:?} {lens}"
                    );
                }
            }
        }
    }
    placed_count
}

impl std::fmt::Display for Lens {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} from {} to {}", self.magnification, self.near, self.far)
    }
}

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
            placed[0] += judge::<S4, _>(&stage, camera, &exact);
        }
        if is_accepted::<S8, _>(&stage, &camera) {
            placed[1] += judge::<S8, _>(&stage, camera, &exact);
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
            placed[0] += judge::<S4, _>(&stage, camera, &exact);
        }
        if is_accepted::<S8, _>(&stage, &camera) {
            placed[1] += judge::<S8, _>(&stage, camera, &exact);
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
