//! Shadows on a plane in the light of a lamp.
//!
//! With the lamp's foot on the plane as origin, the lamp at (0, 0, H) and the plane as z = 0, a
//! point (x, y, h) casts its shadow at k (x, y), where k = H / (H - h). The mesh of the shadow has
//! k (x, y, h): a projective map, in which edges stay straight, and the third coordinate is
//! negative where the object is beyond the plane. Flattened along the plane's normal and cut at the
//! plane, as [`PlanarShadow`] does, that is the shadow.

use super::{PlanarShadow, Plane, Pose};
use crate::{
    mesh::Mesh,
    numbers::{Float, Rotation, Vec3, cross, unit},
};

/// The shadow of a mesh on a plane, in the light of a lamp at a point: a mesh of its own, whose
/// positions are computed each time that the object, the plane or the lamp moves.
///
/// It is drawn like the shadow of a far light: [`PlanarShadow`] tells how to move it before the
/// floor, and to give it one tone. What lies beyond the plane casts none.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{geometry::LampShadowError, mesh::Mesh};
/// use rasterizer::{
///     color::Alpha, geometry::{LampShadow, Plane}, output::{KeepDepth, Over}, prelude::*,
///     raster::Bias,
/// };
///
/// const FLOOR: Plane = Plane::new(Vec3::Y, Scalar::ZERO);
/// const LAMP: Vec3 = Vec3::lit("-1", "4", "1");
///
/// # fn shadow(
/// #     mesh: &Mesh<'_>, pose: Pose, positions: &mut [[i16; 3]],
/// # ) -> Result<(), LampShadowError> {
/// // Six bytes for each vertex of the mesh.
/// let shadow = LampShadow::new(mesh, &pose, FLOOR, LAMP, positions)?;
/// let object = Object::new(shadow.mesh(), Unlit::<Rgb565>::new())
///     .posed(*shadow.pose())
///     .clipped(shadow.clipping())
///     .blended(KeepDepth(Over(Alpha::lit("0.5"))))
///     .biased(Bias::BEHIND_LINES);
/// # let _ = object;
/// # Ok(())
/// # }
/// ```
///
/// The mesh has the triangles and the materials of the other, but no normals. Along two axes of the
/// plane, a vertex is within 2<sup>-15</sup> x (s + 1) units of where the light puts it, with s
/// half the shadow's longer side, and 2<sup>-28</sup> k of its distance from the origin, with k the
/// factor by which the lamp enlarges it; then it is placed on the screen as exactly as others. A
/// lamp just above the object makes these large. A long shadow that comes within some near
/// distances of the camera may be refused with S8, which promises a sixteenth of the error of S4.
#[derive(Clone, Copy, Debug)]
pub struct LampShadow<'a> {
    mesh: Mesh<'a>,
    pose: Pose,
    plane: Plane,
}

/// Why a lamp casts no shadow that can be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LampShadowError {
    /// There is room for fewer positions than the mesh has vertices.
    Storage {
        /// The number of vertices.
        needed: usize,
    },
    /// The lamp is on the plane, or on the side that its normal points away from; or the plane has
    /// no normal.
    LampBelow,
    /// A vertex is as high above the plane as the lamp, or higher: it has no shadow on the plane.
    ObjectAbove,
    /// The shadow reaches 2<sup>14</sup> units or more from the lamp's foot, or from the origin.
    TooLong,
}

impl core::fmt::Display for LampShadowError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Storage { needed } => {
                write!(f, "the shadow needs storage for {needed} positions")
            }
            Self::LampBelow => f.write_str("the lamp is not above the plane"),
            Self::ObjectAbove => f.write_str("the object reaches as high as the lamp"),
            Self::TooLong => {
                f.write_str("the shadow is too long: the lamp is just above the object")
            }
        }
    }
}

impl core::error::Error for LampShadowError {}

/// Shadows and planes are within 2 to this power units.
const REACH: i32 = 14;

/// A mesh as seen from the plane: its axes are two directions along the plane, and the normal.
struct View {
    /// Positions of the mesh along them, in Q30.
    rows: [[i64; 3]; 3],
    /// The mesh's origin along them from the lamp's foot, in quanta of the mesh.
    origin: [Float; 3],
    /// How high the lamp is, in quanta.
    height: Float,
}

impl View {
    /// k (x, y, h) of a position, in quanta; `None` if it is as high as the lamp.
    #[inline(never)]
    fn cast(&self, position: [i16; 3]) -> Option<[Float; 3]> {
        let place = |axis: usize| {
            let along = (0..3).map(|i| self.rows[axis][i] * i64::from(position[i])).sum();
            Float::new(along, -30).plus(self.origin[axis])
        };
        let [x, y, h] = [place(0), place(1), place(2)];
        let below = self.height.plus(h.negative());
        if below.mantissa <= 0 {
            return None;
        }
        let k = self.height.times(below.reciprocal());
        Some([x, y, h].map(|c| c.times(k)))
    }
}

impl<'a> LampShadow<'a> {
    /// Computes the shadow of a mesh in a pose, on the side of the plane that its normal points to.
    /// It takes a position of `storage` for each vertex.
    ///
    /// # Errors
    ///
    /// Returns a [`LampShadowError`] if the storage is too small, or where there is no such shadow:
    /// the lamp must be higher above the plane than all of the object.
    #[inline(never)]
    pub fn new(
        mesh: &Mesh<'a>,
        pose: &Pose,
        plane: Plane,
        lamp: Vec3,
        storage: &'a mut [[i16; 3]],
    ) -> Result<Self, LampShadowError> {
        let tables = mesh.tables();
        let needed = tables.positions.len();
        let shadow = storage.get_mut(..needed).ok_or(LampShadowError::Storage { needed })?;
        let axes = axes(&plane).ok_or(LampShadowError::LampBelow)?;
        let [.., normal] = &axes;

        // World units.
        let per_length = Float::new(plane.normal.along(normal), -46).reciprocal();
        let offset = Float::new(plane.offset.to_bits().into(), -16).times(per_length);
        let height = Float::new(lamp.along(normal), -46).plus(offset);
        if height.mantissa <= 0 {
            return Err(LampShadowError::LampBelow);
        }
        // Of a mesh without a size, any quantum is right.
        let scale = Float::from_unsigned(pose.scale);
        let size = Float::new(tables.scale.mantissa().into(), tables.scale.exponent());
        let quantum = size.times(if scale == Float::ZERO { Float::new(1, -16) } else { scale });
        let rows = axes.map(|axis| pose.rotation.turn_back_exactly(&axis).map(|c| c >> 30));
        let per_quantum = quantum.reciprocal();
        let origin = [0, 1, 2].map(|i| {
            // The pose's place and the mesh's offset from it.
            let from = if i == 2 { Vec3::ZERO } else { lamp };
            let place = pose.translation.along(&axes[i]).wrapping_sub(from.along(&axes[i]));
            let of_mesh = tables.offset.along(&rows[i].map(|c| c as i32));
            let place = Float::new(place, -46).plus(Float::new(of_mesh, -46).times(scale));
            let place = if i == 2 { place.plus(offset) } else { place };
            place.times(per_quantum)
        });
        let rows = if scale == Float::ZERO { [[0; 3]; 3] } else { rows };
        let view = View { rows, origin, height: height.times(per_quantum) };

        let positions = || (0..needed).map_while(|i| tables.positions.get(i));
        let mut extent: Option<[[Float; 2]; 3]> = None;
        for position in positions() {
            let place = view.cast(position).ok_or(LampShadowError::ObjectAbove)?;
            let [low, high] = extent
                .map_or([place; 2], |ends| [ends.map(|[low, _]| low), ends.map(|[_, high]| high)]);
            extent = Some([0, 1, 2].map(|i| {
                let low = if place[i].is_below(low[i]) { place[i] } else { low[i] };
                [low, if high[i].is_below(place[i]) { place[i] } else { high[i] }]
            }));
        }
        let extent = extent.unwrap_or([[Float::ZERO; 2]; 3]);
        let reaches_far = |c: Float| c.times(quantum).magnitude() > REACH;
        if extent[..2].iter().flatten().any(|&c| reaches_far(c)) {
            return Err(LampShadowError::TooLong);
        }

        // The middle of the shadow is the origin of its mesh.
        let half = |c: Float| Float { exponent: c.exponent - 1, ..c };
        let [x, y, h] = extent;
        let middle = [x, y].map(|[low, high]| half(low.plus(high)));
        let sides = [x, y].map(|[low, high]| half(high.plus(low.negative())));
        let largest = sides[0].magnitude().max(sides[1].magnitude());
        let unit = (largest - 15).max(-30);
        // The third coordinate may count in a coarser unit, as only its sign tells.
        let high_unit = (h[0].magnitude().max(h[1].magnitude()) - 15).max(unit);
        for (shadow, position) in shadow.iter_mut().zip(positions()) {
            let Some([x, y, h]) = view.cast(position) else { continue };
            let within = |c: Float, unit: i32| {
                c.in_units_of(unit).clamp(i16::MIN.into(), i16::MAX.into()) as i16
            };
            let [x, y] = [x.plus(middle[0].negative()), y.plus(middle[1].negative())];
            *shadow = [within(x, unit), within(y, unit), within(h, high_unit)];
        }

        let middle = middle.map(|c| c.times(quantum));
        let mut place = [0; 3];
        for (i, place) in place.iter_mut().enumerate() {
            let along = |axis: usize, c: Float| Float::new(axes[axis][i].into(), -30).times(c);
            let foot = Float::new(lamp.to_bits()[i].into(), -16).plus(along(2, height).negative());
            let middle = foot.plus(along(0, middle[0])).plus(along(1, middle[1]));
            if middle.magnitude() > REACH {
                return Err(LampShadowError::TooLong);
            }
            *place = middle.in_units_of(-16);
        }
        let [right, up, normal] = axes;
        let rotation = Rotation::from_row_bits([0, 1, 2].map(|i| [right[i], up[i], normal[i]]));
        let scale = tables.scale.times_power_of_2(unit);
        Ok(Self {
            mesh: mesh.with_positions(shadow, scale),
            pose: Pose { rotation, translation: Vec3::from_bits(place), scale: pose.scale },
            plane,
        })
    }

    /// The mesh, before it is flattened.
    #[must_use]
    pub const fn mesh(&self) -> &Mesh<'a> {
        &self.mesh
    }

    /// Its pose.
    #[must_use]
    pub const fn pose(&self) -> &Pose {
        &self.pose
    }

    /// What flattens it onto the plane, and cuts it there.
    #[must_use]
    pub const fn clipping(&self) -> PlanarShadow {
        PlanarShadow::new(self.plane, self.plane.normal)
    }
}

/// Two directions along a plane and its normal, a right-handed system; `None` without a normal.
fn axes(plane: &Plane) -> Option<[[i32; 3]; 3]> {
    let normal = unit(plane.normal.to_bits().map(i64::from))?;
    // Across the axis of the world that is farthest from the normal.
    let least = (0..3).min_by_key(|&i| normal[i].unsigned_abs())?;
    let mut axis = [0; 3];
    axis[least] = 1 << 30;
    let right = unit(cross(axis, normal).map(i64::from))?;
    Some([right, cross(normal, right), normal])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        mesh::{Card, Material, Positions, Tables, Triangles},
        numbers::{Scalar, Scale, Turn},
        random::Random,
    };

    fn numbers(v: Vec3) -> [f64; 3] {
        v.to_bits().map(|c| f64::from(c) / 65_536.0)
    }

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|i| a[i] * b[i]).sum()
    }

    /// Random objects between random planes and lamps, against f64: the place of each vertex along
    /// the plane, and the side that its third coordinate tells.
    #[test]
    fn vertices_are_where_the_lamp_puts_them() {
        let mut random = Random::new(7);
        let (mut cast, mut beyond, mut refused) = (0, 0, 0);
        for _ in 0..600 {
            let mut bits = |down: u32| ((random.bits() as i32) << 1) >> down;
            let positions = [0; 20].map(|_| [0; 3].map(|_| bits(16) as i16));
            let mesh = Mesh::new_const(Tables {
                positions: Positions::I16(&positions),
                scale: Scale::new(5, -17),
                offset: Vec3::from_bits([0; 3].map(|_| bits(16))),
                triangles: Triangles::U8(&[[0; 3]]),
                materials: const { &[Material::new([0; 3], 1)] },
                ..Tables::EMPTY
            });
            let turn = Rotation::about_x(Turn::from_bits(bits(0) as u32))
                * Rotation::about_y(Turn::from_bits(bits(0) as u32));
            let pose = Pose::rotated(turn).at(Vec3::from_bits([0; 3].map(|_| bits(15))));
            let plane = Plane::new(
                Vec3::from_bits([bits(14), 4 << 16, bits(14)]),
                Scalar::from_bits(bits(14) + (4 << 16)),
            );
            let lamp = Vec3::from_bits([bits(13), (3 << 16) + bits(15).abs(), bits(13)]);
            let mut storage = [[0; 3]; 20];
            let shadow = LampShadow::new(&mesh, &pose, plane, lamp, &mut storage);

            let length = dot(numbers(plane.normal), numbers(plane.normal)).sqrt();
            let normal = numbers(plane.normal).map(|c| c / length);
            let height = |p| dot(normal, p) + plane.offset.to_num::<f64>() / length;
            let rows = turn.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let of_pose = |p: [f64; 3], rows: [[f64; 3]; 3], pose: &Pose| -> [f64; 3] {
                core::array::from_fn(|i| dot(rows[i], p) + numbers(pose.translation)[i])
            };
            let in_world = |position: [i16; 3]| {
                let offset = numbers(mesh.tables().offset);
                let p = [0, 1, 2].map(|i| f64::from(position[i]) * 5.0 / 131_072.0 + offset[i]);
                of_pose(p, rows, &pose)
            };
            let top = positions.iter().map(|&p| height(in_world(p))).fold(f64::MIN, f64::max);
            let above = height(numbers(lamp));
            let Ok(shadow) = shadow else {
                assert!(top > above - 1e-3, "{top} {above}: {:?}", shadow.err());
                refused += 1;
                continue;
            };
            assert!(top < above);
            let scale = shadow.mesh().tables().scale;
            let quantum = f64::from(scale.mantissa()) * 2f64.powi(scale.exponent());
            let rows = shadow.pose().rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let Positions::I16(got) = shadow.mesh().tables().positions;
            let extent = |axis: usize| {
                let all = got.iter().map(|p| p[axis]);
                f64::from(all.clone().max().unwrap()) - f64::from(all.min().unwrap())
            };
            let long = extent(0).max(extent(1)) / 2.0 * quantum;
            for (&position, &shadow_position) in positions.iter().zip(got) {
                let world = in_world(position);
                let (h, l) = (height(world), numbers(lamp));
                let k = above / (above - h);
                let want: [f64; 3] = core::array::from_fn(|i| l[i] + (world[i] - l[i]) * k);
                let [x, y, _] = shadow_position.map(|c| f64::from(c) * quantum);
                let got = of_pose([x, y, 0.0], rows, shadow.pose());
                // Along the plane's axes: half a quantum, and half a unit of the place's in each of
                // its coordinates.
                let size = want.iter().fold(0f64, |most, c| most.max(c.abs()));
                let bound = (long + 1.0) * 2f64.powi(-15) + size * k * 2f64.powi(-28);
                let off: [f64; 3] = core::array::from_fn(|i| got[i] - want[i]);
                for axis in [0, 1].map(|axis| rows.map(|row| row[axis])) {
                    let off = dot(axis, off);
                    assert!(off.abs() < bound, "{off:?} of {bound}, {k}");
                }
                if h.abs() > 1e-2 {
                    let is_above = h > 0.0;
                    let is_right =
                        if is_above { shadow_position[2] >= 0 } else { shadow_position[2] < 0 };
                    assert!(is_right || k * h.abs() < 1e-4 * long, "{h} {shadow_position:?}");
                    beyond += usize::from(!is_above);
                    cast += usize::from(is_above);
                }
            }
        }
        assert!(cast > 3000 && beyond > 300 && refused > 20, "{cast} {beyond} {refused}");
    }

    #[test]
    fn impossible_shadows_are_errors() {
        let mesh = Card::<2, 2>::STANDING;
        let floor = Plane::new(Vec3::Y, Scalar::ONE);
        let cast = |plane, lamp, count: usize| {
            let mut storage = [[0; 3]; 8];
            let pose = Pose::IDENTITY;
            LampShadow::new(&mesh, &pose, plane, lamp, &mut storage[..count]).map(|_| ()).err()
        };
        let lamp = |y: &str| Vec3::new(Scalar::ONE, y.parse().unwrap(), Scalar::ONE);
        // The card is 2 units high, from 1 to 3 units above the floor.
        assert_eq!(cast(floor, lamp("2.5"), 4), None);
        assert_eq!(cast(floor, lamp("2.5"), 3), Some(LampShadowError::Storage { needed: 4 }));
        for y in ["2", "1.5", "0", "-0.9"] {
            assert_eq!(cast(floor, lamp(y), 4), Some(LampShadowError::ObjectAbove), "{y}");
        }
        for y in ["-1", "-1.5"] {
            assert_eq!(cast(floor, lamp(y), 4), Some(LampShadowError::LampBelow), "{y}");
        }
        let no_plane = Plane::new(Vec3::ZERO, Scalar::ONE);
        assert_eq!(cast(no_plane, lamp("2.5"), 4), Some(LampShadowError::LampBelow));
        // A shadow 3 / 2^-16 times as long as the way to the lamp.
        assert_eq!(cast(floor, lamp("2.00002"), 4), Some(LampShadowError::TooLong));
    }
}
