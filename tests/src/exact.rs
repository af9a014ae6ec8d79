//! Where vertices lie by exact arithmetic: in `f64`, whose 53 bits are enough for differences of
//! world coordinates, which have 32.

use rasterizer::{
    camera::{Camera, Orthographic, Perspective},
    geometry::Projection,
    numbers::{Matrix, Rotation, Scale, Subpixel, Vec3},
};

use crate::{Scene, ends::Stage, vector::Vector};

/// In sub-pixels.
const TOLERANCE: f64 = 0.5 + 0.125;
const GUARD: f64 = 1024.0;

/// A projection in f64.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Pixels per unit at w = 1.
    pub magnification: f64,
    /// Whether w is the distance, or 1.
    pub is_perspective: bool,
    /// The near distance.
    pub near: f64,
    /// The far distance.
    pub far: f64,
}

impl Lens {
    /// With this focal length in pixels.
    #[must_use]
    pub fn perspective(lens: &Perspective, magnification: f64) -> Self {
        Self {
            magnification,
            is_perspective: true,
            near: lens.near().to_num(),
            far: lens.far().to_num(),
        }
    }

    /// On a viewport this high.
    #[must_use]
    pub fn orthographic(lens: &Orthographic, height: f64) -> Self {
        Self {
            magnification: height / lens.height().to_num::<f64>(),
            is_perspective: false,
            near: lens.near().to_num(),
            far: lens.far().to_num(),
        }
    }
}

/// The coordinates of a vector.
#[must_use]
pub fn numbers(v: Vec3) -> Vector {
    v.to_bits().map(|c| f64::from(c) / 65_536.0)
}

/// A mesh's quantum in its own units.
#[must_use]
pub fn quantum(scale: Scale) -> f64 {
    f64::from(scale.mantissa()) * 2f64.powi(scale.exponent())
}

/// A vector turned by the entries of a rotation.
#[must_use]
pub fn rotated(rotation: &Rotation, v: Vector) -> Vector {
    let rows = rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// A row of the matrix from quanta to clip space, and its translation.
type Row = (Vector, f64);

/// A vector that a matrix changes.
#[must_use]
pub fn changed(matrix: &Matrix, v: Vector) -> Vector {
    let rows = matrix.rows().map(|row| row.map(|c| c.to_num::<f64>()));
    rows.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The rows of the matrix of an object in a shape: right, down and away, the first two in guard
/// bands at w = 1.
fn rows_of(stage: &Stage, shape: &Matrix, lens: &Lens) -> [Row; 3] {
    let (turn, view) = (stage.pose.rotation, stage.rotation.inverse());
    let scale: f64 = stage.pose.scale.to_num();
    let quantum = quantum(stage.surface.scale);
    let to_view = |v: Vector| {
        let [x, y, z] = rotated(&view, v);
        [x * lens.magnification / GUARD, -y * lens.magnification / GUARD, -z]
    };
    let column = |axis: usize| {
        let mut unit = [0.0; 3];
        unit[axis] = scale * quantum;
        to_view(rotated(&turn, changed(shape, unit)))
    };
    let columns = [0, 1, 2].map(column);
    let (translation, eye) = (numbers(stage.pose.translation), numbers(stage.eye));
    let offset = numbers(stage.surface.offset).map(|c| c * scale);
    let offset = rotated(&turn, changed(shape, offset));
    let from_eye = [0, 1, 2].map(|i| offset[i] + translation[i] - eye[i]);
    let origin = to_view(from_eye);
    [0, 1, 2].map(|row| (columns.map(|column| column[row]), origin[row]))
}

/// What [`judge`] has found.
#[derive(Clone, Copy, Debug, Default)]
pub struct Judged {
    /// How many vertices are on the screen.
    pub placed: usize,
    /// How far the worst of them is from its exact place along x or y, in sub-pixels.
    pub worst: f64,
}

/// Checks where the vertices lie: at most 5/8 of a sub-pixel from their exact places.
///
/// # Panics
///
/// Panics if one is elsewhere, or is missing, or should be.
pub fn judge<S: Subpixel, P: Projection>(stage: &Stage, camera: Camera<P>, lens: &Lens) -> Judged {
    let mesh = stage.surface.mesh();
    let scene = Scene { pose: stage.pose, ..Scene::new(&mesh, camera) };
    let placed = scene.vertices::<S>();
    judge_placed::<S, P>(stage, &Matrix::IDENTITY, (camera, lens), &placed)
}

/// [`judge`] for an object in a shape, with its vertices as [`Scene::vertices`] returns them.
///
/// # Panics
///
/// Panics if one is elsewhere, or is missing, or should be.
pub fn judge_placed<S: Subpixel, P: Projection>(
    stage: &Stage,
    shape: &Matrix,
    (camera, lens): (Camera<P>, &Lens),
    placed: &[Option<[f64; 2]>],
) -> Judged {
    let mesh = stage.surface.mesh();
    let rows = rows_of(stage, shape, lens);
    let (entries, origin) = rows[2];
    let reach = entries.iter().fold(origin.abs(), |sum, c| sum + c.abs() * 32_768.0);
    let viewport = camera.viewport();
    let sides = [viewport.size.width, viewport.size.height].map(f64::from);
    let corner = [viewport.top_left.x, viewport.top_left.y].map(f64::from);

    let mut judged = Judged::default();
    let positions = (0..).map_while(|index| mesh.tables().positions.get(index));
    for (index, position) in positions.enumerate() {
        let p = position.map(f64::from);
        let [x, y, z] =
            rows.map(|(row, origin)| row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + origin);
        let w = if lens.is_perspective { z } else { 1.0 };
        let subpixel = 1.0 / f64::from(1 << S::BITS);
        // Whether it lies on one side of all planes by more than an eighth of a sub-pixel, and
        // 2^-20 of its distance, or in a parallel projection 2^-27 of the farthest.
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
            assert!(
                !(is_certain(1.0) && is_seen),
                "vertex {index} is seen: {stage:?} {shape:?} {lens}"
            );
            continue;
        };
        match *place {
            None => {
                assert!(
                    !is_certain(1.0),
                    "vertex {index} is on the screen: {stage:?} {shape:?} {lens}"
                );
            }
            Some([px, py]) => {
                assert!(
                    is_certain(-1.0),
                    "vertex {index} is not on the screen: {stage:?} {shape:?} {lens}"
                );
                // The guard band's last sub-pixel is cut off.
                judged.placed += 1;
                for (axis, (got, c)) in [(px, x), (py, y)].into_iter().enumerate() {
                    let exact =
                        (c / w * GUARD).min(GUARD - subpixel) + corner[axis] + sides[axis] / 2.0;
                    let error = (got - exact).abs() / subpixel;
                    judged.worst = judged.worst.max(error);
                    assert!(
                        error <= TOLERANCE,
                        "vertex {index}: {got} {exact} {stage:?} {shape:?} {lens}"
                    );
                }
            }
        }
    }
    judged
}

impl std::fmt::Display for Lens {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} from {} to {}", self.magnification, self.near, self.far)
    }
}
