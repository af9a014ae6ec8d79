//! Object space to clip space to the screen: the work on every vertex.

use super::{
    DepthFormat, Pose, PoseError, Projection, ScreenVertex, Subpixel, Varyings, projection::Lens, screen::GUARD_BITS,
};
use crate::{
    camera::Camera,
    mesh::{BoundingBox, Tables},
    numbers::{Float, IS_NARROW, dot, mul_high, saturate},
};

/// A point in clip space.
///
/// The units are an object's own, chosen so that no coordinate of a vertex reaches 2^30. `|x| <= w` and `|y| <= w` is
/// the guard band: w stands for 1,024 pixels, whatever the focal length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ClipVertex<V> {
    /// To the right.
    pub(crate) x: i32,
    /// Downwards.
    pub(crate) y: i32,
    /// Away from the camera.
    pub(crate) z: i32,
    pub(crate) varyings: V,
}

/// One coordinate of clip space as a function of an object's position: a row of the 3 x 4 matrix.
///
/// Its entries have 16 bits behind the point of a clip-space unit. Where there is no long multiply they are kept as
/// `high * 2^16 + low`: their products with positions of 16 bits fit 32 then.
#[derive(Clone, Copy, Debug)]
struct Row<const PARTS: usize = { if IS_NARROW { 2 } else { 1 } }> {
    /// The entries, or their upper and their lower halves.
    entries: [[i32; 3]; PARTS],
    translation: i32,
}

const FRACTION_BITS: u32 = 16;

/// What no coordinate reaches.
const BEYOND: i32 = 1 << 30;

impl<const PARTS: usize> Row<PARTS> {
    /// The entries and the translation in units of 2^`unit`.
    #[inline(never)]
    fn new(entries: [Float; 3], translation: Float, unit: i32) -> Self {
        let entries = entries.map(|m| m.in_units_of(unit - FRACTION_BITS as i32));
        let part = |part: usize| {
            entries.map(|m| match (PARTS, part) {
                (1, _) => m,
                (_, 0) => m >> FRACTION_BITS,
                _ => m & ((1 << FRACTION_BITS) - 1),
            })
        };
        Self {
            entries: core::array::from_fn(part),
            translation: translation.in_units_of(unit),
        }
    }

    /// Entries . p + translation, each product rounded down.
    #[inline(always)]
    fn apply(&self, [x, y, z]: [i32; 3]) -> i32 {
        let sum = match *self.entries.as_slice() {
            [[a, b, c]] => mul_high(a, x << 16) + mul_high(b, y << 16) + mul_high(c, z << 16),
            [[a, b, c], [d, e, f]] => a * x + b * y + c * z + ((d * x) >> 16) + ((e * y) >> 16) + ((f * z) >> 16),
            _ => 0,
        };
        sum + self.translation
    }
}

/// Everything between an object's table and the screen, for one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transform<P: Projection> {
    rows: [Row; 3],
    pub(super) near: i32,
    pub(super) far: i32,
    pub(super) lens: P::Lens,
    /// The viewport's middle in half pixels, and its size in pixels.
    center: [i32; 2],
    size: [u32; 2],
}

impl<P: Projection> Transform<P> {
    /// Pose, camera, focal length and the mesh's own scale in one matrix.
    // The caller's frame would hold all of it while triangles are drawn.
    #[inline(never)]
    pub(crate) fn new(camera: &Camera<P>, pose: &Pose, tables: &Tables<'_>) -> Result<Self, PoseError> {
        let projection = camera.projection();
        let viewport = camera.viewport();
        // World units for a quantum of the mesh, and guard bands and units of z for a world unit at w = 1. The y axis
        // turns over.
        let quantum = Float::from_unsigned(pose.scale).times(Float::from_scale(tables.scale));
        let [pixels, deep] = projection.magnification(viewport.size.height);
        let across = pixels.times(Float::new(1, -(GUARD_BITS as i32)));
        let down = Float::new(-1, 0).times(across);
        let magnification = [across, down, deep];
        let columns = pose.rotation.inverse().to_bits();
        let entries: [[Float; 3]; 3] = core::array::from_fn(|row| {
            core::array::from_fn(|column| entry(&camera.axes()[row], &columns[column], quantum, magnification[row]))
        });
        let origin = origin(camera, pose, tables)?;
        let translation: [Float; 3] = core::array::from_fn(|row| origin[row].times(magnification[row]));

        let magnitude = |row: usize| magnitude(&entries[row], translation[row]);
        let units = projection
            .units(magnitude(0).max(magnitude(1)), magnitude(2))
            .ok_or(PoseError)?;
        let row = |row: usize, unit: i32| Row::new(entries[row], translation[row], unit);
        let [near, far] = projection.depth_range().map(|d| d.in_units_of(units.z));
        let (corner, size) = (viewport.top_left, viewport.size);
        Ok(Self {
            rows: [row(0, units.xy), row(1, units.xy), row(2, units.z)],
            near: near.clamp(1, BEYOND),
            far: far.min(BEYOND),
            lens: projection.lens(units),
            center: [2 * corner.x + size.width as i32, 2 * corner.y + size.height as i32],
            size: [size.width, size.height],
        })
    }

    /// A position of the mesh in clip space.
    #[inline(always)]
    pub(crate) fn object_to_clip<V>(&self, position: [i16; 3], varyings: V) -> ClipVertex<V> {
        let p = position.map(i32::from);
        ClipVertex {
            x: self.rows[0].apply(p),
            y: self.rows[1].apply(p),
            z: self.rows[2].apply(p),
            varyings,
        }
    }

    /// The same where there are few: a function that is called.
    #[cold]
    #[inline(never)]
    pub(crate) fn few_to_clip(&self, position: [i16; 3]) -> [i32; 3] {
        let ClipVertex { x, y, z, .. } = self.object_to_clip(position, ());
        [x, y, z]
    }

    /// Clip space to the screen; the result is not on the screen if the vertex is outside near plane, far plane or
    /// guard band.
    #[inline(always)]
    pub(crate) fn clip_to_screen<S: Subpixel, D: DepthFormat, V: Varyings>(
        &self,
        vertex: ClipVertex<V>,
    ) -> ScreenVertex<S, D, V> {
        let ClipVertex { x, y, z, varyings } = vertex;
        let w = self.lens.w(z);
        // Negative if one of them is: no coordinate reaches 2^30.
        if ((z - self.near) | (self.far - z) | (w - x) | (w + x) | (w - y) | (w + y)) < 0 {
            return ScreenVertex::off_screen(varyings);
        }
        let reciprocal = self.lens.reciprocal_of_twice(w);
        // x / w = (x << n) r / 2^61, where r = 2^62 / (2 w << n) and |x| <= w < 2^30: its upper half has 29 bits behind
        // the point; 10 + S of them are sub-pixels of the guard band.
        let to_subpixels = |c: i32, center: i32| {
            let quotient = mul_high(c << reciprocal.leading_zeros, reciprocal.mantissa);
            let drop = 29 - GUARD_BITS - S::BITS;
            let subpixels = (quotient + (1 << (drop - 1))) >> drop;
            let limit = 1 << (GUARD_BITS + S::BITS);
            saturate(subpixels, limit) + (center << (S::BITS - 1))
        };
        ScreenVertex::new(
            to_subpixels(x, self.center[0]),
            to_subpixels(y, self.center[1]),
            D::from_fraction(self.lens.depth(z, reciprocal)),
            varyings,
        )
    }

    /// Whether a box is certain to lie outside the picture: all its corners beyond one and the same plane.
    pub(crate) fn hides(&self, cuboid: &BoundingBox) -> bool {
        // A pixel wider than the viewport, so that rounding cannot hide an edge that shows.
        let half = self.size.map(|pixels| (pixels / 2 + 2) as i32);
        let mut beyond_all = 0b11_1111u8;
        for corner in cuboid.corners() {
            let [x, y, z] = self.few_to_clip(corner);
            // A pixel's width, rounded up: the sides move outwards, and their products stay below 2^31 as the viewport
            // is no wider than the guard band. Beyond the near plane it may be negative, and the sides are still planes
            // through the eye: upwards is outwards there too.
            let w = (self.lens.w(z) >> GUARD_BITS) + 1;
            let beyond = [
                z < self.near,
                z > self.far,
                x < -w * half[0],
                x > w * half[0],
                y < -w * half[1],
                y > w * half[1],
            ];
            beyond_all &= beyond.iter().fold(0, |bits, &outside| bits << 1 | u8::from(outside));
        }
        beyond_all != 0
    }
}

/// An entry of the matrix. Like the rest of what makes one, it is called rather than inlined: it is used for each of nine
/// entries, and once a frame.
#[inline(never)]
fn entry(axis: &[i32; 3], column: &[i32; 3], quantum: Float, magnification: Float) -> Float {
    Float::new(dot(axis, column), -60).times(quantum).times(magnification)
}

/// The least n for which a coordinate stays below 2^n.
#[inline(never)]
fn magnitude(entries: &[Float; 3], translation: Float) -> i32 {
    // |coordinate| <= 2^15 (|a| + |b| + |c|) + |t|, and four terms below 2^n add up to less than 2^(n + 2).
    let largest = entries.iter().map(|m| m.magnitude() + 15);
    largest.fold(translation.magnitude(), i32::max) + 2
}

/// Where position (0, 0, 0) of the table lies in view space: right, up, forward.
fn origin<P>(camera: &Camera<P>, pose: &Pose, tables: &Tables<'_>) -> Result<[Float; 3], PoseError> {
    let (rows, offset) = (pose.rotation.to_bits(), tables.offset.to_bits());
    let (translation, eye) = (pose.translation.to_bits(), camera.eye().to_bits());
    let mut from_eye = [0i64; 3];
    for axis in 0..3 {
        // Q30 x Q16, three times: below 2^63. To Q32.
        let turned = dot(&rows[axis], &offset) >> 14;
        let shift = (i64::from(translation[axis]) - i64::from(eye[axis])) << 16;
        from_eye[axis] = scaled_and_shifted(turned, pose.scale.to_bits(), shift).ok_or(PoseError)?;
    }
    // To 31 bits, so that products with the camera's axes in Q30 add up in 64.
    let largest = from_eye.iter().fold(0, |bits, c| bits | c.unsigned_abs());
    let down = (33 - largest.leading_zeros() as i32).max(0);
    let from_eye = from_eye.map(|c| if down == 0 { c } else { ((c >> (down - 1)) + 1) >> 1 });
    Ok(core::array::from_fn(|row| {
        let sum: i64 = (0..3).map(|k| i64::from(camera.axes()[row][k]) * from_eye[k]).sum();
        Float::new(sum, down - 62)
    }))
}

/// A coordinate in Q32 times a scale in Q16, and moved; nothing if it leaves the range.
#[inline(never)]
fn scaled_and_shifted(c: i64, scale: u32, shift: i64) -> Option<i64> {
    let scale = i64::from(scale);
    let upper = (c >> 16).checked_mul(scale)?;
    upper.checked_add(((c & 0xFFFF) * scale) >> 16)?.checked_add(shift)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::geometry::{Point, Size};
    use fixed::types::U16F16;

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        geometry::{S4, S8},
        mesh::{Bounds, Triangles},
        numbers::{Angle, Rotation, Scale, Vec3},
    };

    const VIEWPORT: embedded_graphics_core::primitives::Rectangle =
        embedded_graphics_core::primitives::Rectangle::new(Point::new(7, -5), Size::new(321, 240));
    const NEAR: U16F16 = U16F16::lit("0.25");
    const FAR: U16F16 = U16F16::lit("50");

    fn tables(positions: &[[i16; 3]]) -> Tables<'_> {
        Tables {
            positions,
            // A half-extent of 1.5.
            scale: Scale::new(3, -16),
            offset: Vec3::lit("0.5", "-0.25", "0.125"),
            vertex_normals: &[],
            face_normals: &[],
            texture_coordinates: &[],
            texture_fraction_bits: 16,
            triangles: Triangles::U8(&[]),
            materials: &[],
        }
    }

    fn random(state: &mut u64) -> i16 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 48) as i16
    }

    /// The pose and the camera of a case, and view-space coordinates of a position by their definition.
    struct Case {
        pose: Pose,
        eye: Vec3,
        rotation: Rotation,
    }

    impl Case {
        fn random(state: &mut u64) -> Self {
            let mut angle = || Angle::from_bits((random(state) as u32) << 16 | 0x1234);
            let rotation = Rotation::about_x(angle()) * Rotation::about_y(angle());
            let turn = Rotation::about_z(angle()) * Rotation::about_y(angle());
            let mut vector = |shift: u32| Vec3::from_bits([0; 3].map(|_| i32::from(random(state)) << shift));
            Self {
                pose: Pose::rotated(turn).at(vector(3)).scaled(U16F16::lit("1.75")),
                eye: vector(3),
                rotation,
            }
        }

        /// Right, up and forward.
        fn view(&self, position: [i16; 3]) -> [f64; 3] {
            let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65536.0);
            let rows = |r: &Rotation| r.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let apply = |m: [[f64; 3]; 3], v: [f64; 3]| m.map(|row| (0..3).map(|k| row[k] * v[k]).sum::<f64>());
            let offset = numbers(Vec3::lit("0.5", "-0.25", "0.125"));
            let model: [f64; 3] = core::array::from_fn(|i| (offset[i] + f64::from(position[i]) * 3.0 / 65536.0) * 1.75);
            let turned = apply(rows(&self.pose.rotation), model);
            let (at, eye) = (numbers(self.pose.translation), numbers(self.eye));
            let world: [f64; 3] = core::array::from_fn(|i| turned[i] + at[i] - eye[i]);
            let [right, up, back] = apply(rows(&self.rotation.inverse()), world);
            [right, up, -back]
        }
    }

    fn check<P: Projection, S: Subpixel>(projection: P, project: impl Fn([f64; 3]) -> [f64; 3]) {
        let mut state = 0x1234_5678_9ABC_DEF1;
        let mut seen = 0;
        for _ in 0..300 {
            let case = Case::random(&mut state);
            let positions: Vec<[i16; 3]> = (0..20).map(|_| [0; 3].map(|_| random(&mut state))).collect();
            let camera = Camera::at(case.eye, case.rotation, projection, VIEWPORT).unwrap();
            let transform = Transform::new(&camera, &case.pose, &tables(&positions)).unwrap();
            let mut is_seen = false;
            for &position in &positions {
                let [right, up, forward] = case.view(position);
                let vertex = transform.clip_to_screen::<S, u16, [u16; 0]>(transform.object_to_clip(position, []));
                let [x, y, depth] = project([right, up, forward]);
                let Some([got_x, got_y]) = vertex.position() else {
                    // Outside by the definition, or on the boundary within rounding.
                    let margin = 1e-4;
                    let is_inside = forward > 0.25 + margin
                        && forward < 50.0 - margin
                        && (x - 167.5).abs() < 1024.0 - 1.0
                        && (y - 115.0).abs() < 1024.0 - 1.0;
                    assert!(!is_inside, "a vertex at ({x}, {y}), {forward} away, is missing");
                    continue;
                };
                let unit = f64::from(1 << S::BITS);
                // Half a sub-pixel of snapping; an eighth for the transform's 30 bits and the reciprocal's 27.
                assert!((f64::from(got_x) - x * unit).abs() < 0.625, "x {got_x} {}", x * unit);
                assert!((f64::from(got_y) - y * unit).abs() < 0.625, "y {got_y} {}", y * unit);
                let depth = depth * 65536.0;
                assert!(
                    (f64::from(vertex.depth()) - depth).abs() < 1.1,
                    "depth {} {depth}",
                    vertex.depth()
                );
                is_seen |= (7.0..328.0).contains(&x) && (-5.0..235.0).contains(&y);
            }
            if is_seen {
                seen += 1;
                assert!(
                    !transform.hides(&Bounds::of(&positions).cuboid),
                    "a box is hidden that shows"
                );
            }
        }
        assert!(seen > 20, "only {seen} cases show anything");
    }

    /// Only the form differs, and with it what cores need for it.
    #[test]
    fn rows_in_parts_give_what_whole_rows_give() {
        let mut state = 0x1234_5678_9ABC_DEF1;
        for _ in 0..100_000 {
            let entries = [0; 3].map(|_| Float::new(i64::from(random(&mut state)) << 20 | 0x7_3C51, -24));
            let translation = Float::new(i64::from(random(&mut state)), 10);
            let p = [0; 3].map(|_| i32::from(random(&mut state)));
            let whole = Row::<1>::new(entries, translation, 0).apply(p);
            let parts = Row::<2>::new(entries, translation, 0).apply(p);
            assert_eq!(whole, parts, "{entries:?} {p:?}");
        }
    }

    #[test]
    fn perspective_places_vertices_where_the_definition_does() {
        let lens = Perspective::with_focal_length(U16F16::lit("300"), NEAR, FAR).unwrap();
        let project = |[right, up, forward]: [f64; 3]| {
            [
                167.5 + 300.0 * right / forward,
                115.0 - 300.0 * up / forward,
                0.25 / forward,
            ]
        };
        check::<_, S4>(lens, project);
        check::<_, S8>(lens, project);
    }

    #[test]
    fn parallel_projection_places_vertices_where_the_definition_does() {
        let lens = Orthographic::new(U16F16::lit("12"), NEAR, FAR).unwrap();
        let project =
            |[right, up, forward]: [f64; 3]| [167.5 + 20.0 * right, 115.0 - 20.0 * up, (50.0 - forward) / 49.75];
        check::<_, S4>(lens, project);
        check::<_, S8>(lens, project);
    }

    #[test]
    fn a_box_beyond_any_one_plane_is_hidden() {
        let lens = Perspective::new(Angle::degrees(60), NEAR, FAR).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let hides = |x: &str, y: &str, z: &str| {
            let positions = [[-1000, -1000, -1000], [1000, 1000, 1000]];
            let pose = Pose::IDENTITY.at(Vec3::lit(x, y, z));
            let transform = Transform::new(&camera, &pose, &tables(&positions)).unwrap();
            transform.hides(&Bounds::of(&positions).cuboid)
        };
        assert!(!hides("0", "0", "-5"));
        for (x, y, z) in [
            ("0", "0", "5"),
            ("0", "0", "-60"),
            ("-9", "0", "-5"),
            ("9", "0", "-5"),
            ("0", "9", "-5"),
            ("0", "-9", "-5"),
        ] {
            assert!(hides(x, y, z), "({x}, {y}, {z})");
        }
    }

    #[test]
    fn out_of_range_is_an_error() {
        let lens = Perspective::new(Angle::degrees(60), NEAR, FAR).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let mut far_off = tables(&[]);
        far_off.offset = Vec3::from_bits([i32::MAX; 3]);
        // 2^31 units of offset and 2^15 more: beyond Q32 in 64 bits.
        let pose = Pose::IDENTITY.scaled(U16F16::MAX).at(far_off.offset);
        assert_eq!(Transform::new(&camera, &pose, &far_off).err(), Some(PoseError));
        assert!(Transform::new(&camera, &Pose::IDENTITY, &far_off).is_ok());
    }
}
