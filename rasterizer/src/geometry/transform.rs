//! Object space to clip space to the screen: the work on every vertex.

use super::{
    Pose, PoseError, Projection, ScreenVertex,
    lens::Lens,
    row::{Row, Terms},
    screen::GUARD_BITS,
};
use crate::{
    attribute::{DepthFormat, Interpolate, Varyings},
    camera::Camera,
    mesh::{BoundingBox, Tables},
    numbers::{Subpixel, codegen, mul_high, saturate},
};

/// A point in clip space.
///
/// The units are an object's own, chosen so that no coordinate of a vertex reaches 2^30. `|x| <= w`
/// and `|y| <= w` is the guard band: w stands for 1,024 pixels, for every focal length.
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

/// Everything between an object's table and the screen, for one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Transform<P: Projection> {
    x: Row,
    y: Row,
    z: Row,
    pub(super) near: i32,
    pub(super) far: i32,
    pub(super) lens: P::Lens,
    /// The viewport's middle in half pixels.
    center: [i32; 2],
}

impl<P: Projection> Transform<P> {
    /// Pose, camera, focal length and the mesh's own scale in one matrix.
    // codegen: not inlined, or the caller's frame would hold its temporaries while triangles are
    // drawn.
    #[inline(never)]
    pub(crate) fn new(camera: &Camera<P>, pose: &Pose, tables: &Tables<'_>) -> Self {
        let projection = camera.projection();
        let viewport = camera.viewport();
        // Guard bands for a world unit at w = 1, and units of z.
        let [mut across, deep] = projection.magnification(viewport.size.height);
        across.exponent -= GUARD_BITS as i32;
        let eye = camera.eye();
        let terms = |axis: usize, magnification| {
            Terms::new(&camera.axes()[axis], magnification, &eye, pose, tables)
        };
        let (x, y, z) = (terms(0, across), terms(1, across), terms(2, deep));

        let units = projection.units(x.magnitude().max(y.magnitude()), z.magnitude());
        let [near, far] = projection.depth_range(units);
        let (corner, size) = (viewport.top_left, viewport.size);
        Self {
            x: Row::new(&x, units.xy),
            y: Row::new(&y, units.xy),
            z: Row::new(&z, units.z),
            near,
            far,
            lens: projection.lens(units),
            center: [2 * corner.x + size.width as i32, 2 * corner.y + size.height as i32],
        }
    }

    /// A copy, field by field.
    // codegen: a copy of the whole is a call of `memcpy`, 370 bytes where nothing else calls it.
    #[inline(always)]
    pub(crate) const fn clone_by_fields(&self) -> Self {
        Self {
            x: self.x,
            y: self.y,
            z: self.z,
            near: self.near,
            far: self.far,
            lens: self.lens,
            center: self.center,
        }
    }

    /// Checks that the object fits the projection's number range. Call this first: no other method
    /// is valid until it succeeds.
    pub(crate) fn check(&self) -> Result<(), PoseError> {
        self.lens.is_in_range().then_some(()).ok_or(PoseError)
    }

    /// A position of the mesh in clip space.
    #[inline(always)]
    pub(crate) fn object_to_clip<V>(&self, position: [i16; 3], varyings: V) -> ClipVertex<V> {
        let [x, y, z] = position;
        let p = [i32::from(x), i32::from(y), i32::from(z)];
        ClipVertex { x: self.x.apply(p), y: self.y.apply(p), z: self.z.apply(p), varyings }
    }

    /// [`object_to_clip`](Self::object_to_clip) without varyings, outlined for the few vertices of
    /// boxes and clipped triangles.
    #[cold]
    #[inline(never)]
    pub(crate) fn object_to_clip_outlined(&self, position: [i16; 3]) -> [i32; 3] {
        let ClipVertex { x, y, z, .. } = self.object_to_clip(position, ());
        [x, y, z]
    }

    /// Projects a vertex. The result is not on the screen if the vertex is outside near plane, far
    /// plane or guard band.
    #[inline(always)]
    pub(crate) fn clip_to_screen<S: Subpixel, D: DepthFormat, V: Varyings>(
        &self,
        vertex: ClipVertex<V>,
    ) -> ScreenVertex<S, D, V::OnScreen> {
        let ClipVertex { x, y, z, varyings } = vertex;
        let w = self.lens.w(z);
        // Negative if one of them is: no coordinate reaches 2^30.
        if ((z - self.near) | (self.far - z) | (w - x) | (w + x) | (w - y) | (w + y)) < 0 {
            return ScreenVertex::off_screen(V::OnScreen::ZERO);
        }
        let reciprocal = self.lens.reciprocal_of_twice(w);
        // x / w = (x << n) r / 2^61, where r = 2^62 / (2 w << n) and |x| <= w < 2^30: its upper
        // half has 29 bits behind the point; 10 + S of them are sub-pixels of the guard band.
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
            varyings.on_screen(self.lens.inverse_w(reciprocal)),
        )
    }

    /// Whether a box is certain to lie outside a picture of `size` pixels in width and height: all
    /// its corners beyond one and the same plane.
    pub(crate) fn is_outside_view(&self, cuboid: &BoundingBox, size: [i32; 2]) -> bool {
        let mut beyond_all = 0b11_1111;
        for index in 0..codegen::unknown(8) {
            beyond_all &= self.beyond(cuboid.corner(index), size);
            if beyond_all == 0 {
                return false;
            }
        }
        true
    }

    /// The planes of the picture beyond which a position lies: a bit for each of the six.
    // codegen: not inlined, because compilers repeat it for each corner of a box.
    #[inline(never)]
    pub(crate) fn beyond(&self, position: [i16; 3], [width, height]: [i32; 2]) -> u8 {
        let [x, y, z] = self.object_to_clip_outlined(position);
        // A pixel wider than the viewport, so that rounding cannot hide a visible edge.
        let (across, down) = (width / 2 + 2, height / 2 + 2);
        // A pixel's width, rounded up: the sides move outwards, and their products stay below 2^31
        // as the viewport is no wider than the guard band. Beyond the near plane it may be
        // negative, and the sides are still planes through the eye: upwards is outwards there too.
        let w = (self.lens.w(z) >> GUARD_BITS) + 1;
        let (across, down) = (w * across, w * down);
        let beyond = [z < self.near, z > self.far, x < -across, x > across, y < -down, y > down];
        beyond.iter().fold(0, |bits, &outside| bits << 1 | u8::from(outside))
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::geometry::{Point, Size};
    use fixed::types::U16F16;

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        mesh::Positions,
        numbers::{Float, Rotation, S4, S8, Scale, Turn, Vec3},
        random::Random,
    };

    const VIEWPORT: embedded_graphics_core::primitives::Rectangle =
        embedded_graphics_core::primitives::Rectangle::new(Point::new(7, -5), Size::new(321, 240));
    const NEAR: U16F16 = U16F16::lit("0.25");
    const FAR: U16F16 = U16F16::lit("50");

    fn tables(positions: &[[i16; 3]]) -> Tables<'_> {
        Tables {
            positions: Positions::I16(positions),
            // A half-extent of 1.5.
            scale: Scale::new(3, -16),
            offset: Vec3::lit("0.5", "-0.25", "0.125"),
            ..Tables::EMPTY
        }
    }

    fn coordinate(random: &mut Random) -> i16 {
        random.bits() as i16
    }

    /// The pose and the camera of a case, and view-space coordinates of a position by their
    /// definition.
    struct Case {
        pose: Pose,
        eye: Vec3,
        rotation: Rotation,
    }

    impl Case {
        fn random(random: &mut Random) -> Self {
            let mut angle = || Turn::from_bits((coordinate(random) as u32) << 16 | 0x1234);
            let rotation = Rotation::about_x(angle()) * Rotation::about_y(angle());
            let turn = Rotation::about_z(angle()) * Rotation::about_y(angle());
            let mut vector = |shift: u32| {
                Vec3::from_bits([0; 3].map(|_| i32::from(coordinate(random)) << shift))
            };
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
            let apply = |m: [[f64; 3]; 3], v: [f64; 3]| {
                m.map(|row| (0..3).map(|k| row[k] * v[k]).sum::<f64>())
            };
            let offset = numbers(Vec3::lit("0.5", "-0.25", "0.125"));
            let model: [f64; 3] = core::array::from_fn(|i| {
                (offset[i] + f64::from(position[i]) * 3.0 / 65536.0) * 1.75
            });
            let turned = apply(rows(&self.pose.rotation), model);
            let (at, eye) = (numbers(self.pose.translation), numbers(self.eye));
            let world: [f64; 3] = core::array::from_fn(|i| turned[i] + at[i] - eye[i]);
            let [right, up, back] = apply(rows(&self.rotation.inverse()), world);
            [right, up, -back]
        }
    }

    fn check<P: Projection, S: Subpixel>(projection: P, project: impl Fn([f64; 3]) -> [f64; 3]) {
        let mut random = Random::new(0x1234_5678_9ABC_DEF1);
        let mut seen = 0;
        for _ in 0..300 {
            let case = Case::random(&mut random);
            let positions: Vec<[i16; 3]> =
                (0..20).map(|_| [0; 3].map(|_| coordinate(&mut random))).collect();
            let camera = Camera::at(case.eye, case.rotation, projection, VIEWPORT).unwrap();
            let transform = Transform::new(&camera, &case.pose, &tables(&positions));
            let mut is_seen = false;
            for &position in &positions {
                let [right, up, forward] = case.view(position);
                let vertex = transform
                    .clip_to_screen::<S, u16, [u16; 0]>(transform.object_to_clip(position, []));
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
                // Half a sub-pixel of snapping; an eighth for the transform's 30 bits and the
                // reciprocal's 27.
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
                    !transform.is_outside_view(&BoundingBox::of(&positions), [321, 240]),
                    "a box is hidden that shows"
                );
            }
        }
        assert!(seen > 20, "only {seen} cases show anything");
    }

    /// Only the form differs, and the instructions that cores need for it.
    #[test]
    fn rows_in_parts_give_what_whole_rows_give() {
        let mut random = Random::new(0x1234_5678_9ABC_DEF1);
        for _ in 0..100_000 {
            let [x, y, z] =
                [0; 3].map(|_| Float::new(i64::from(coordinate(&mut random)) << 20 | 0x7_3C51, -9));
            let terms = Terms {
                reaches: [x, y, z],
                translation: Float::new(i64::from(coordinate(&mut random)), 10),
            };
            let p = [0; 3].map(|_| i32::from(coordinate(&mut random)));
            let whole = Row::<1>::new(&terms, 0).apply(p);
            let parts = Row::<2>::new(&terms, 0).apply(p);
            assert_eq!(whole, parts, "{terms:?} {p:?}");
        }
    }

    #[test]
    fn perspective_places_vertices_where_the_definition_does() {
        let lens = Perspective::with_focal_length(U16F16::lit("300"), NEAR, FAR).unwrap();
        let project = |[right, up, forward]: [f64; 3]| {
            [167.5 + 300.0 * right / forward, 115.0 - 300.0 * up / forward, 0.25 / forward]
        };
        check::<_, S4>(lens, project);
        check::<_, S8>(lens, project);
    }

    #[test]
    fn parallel_projection_places_vertices_where_the_definition_does() {
        let lens = Orthographic::new(U16F16::lit("12"), NEAR, FAR).unwrap();
        let project = |[right, up, forward]: [f64; 3]| {
            [167.5 + 20.0 * right, 115.0 - 20.0 * up, (50.0 - forward) / 49.75]
        };
        check::<_, S4>(lens, project);
        check::<_, S8>(lens, project);
    }

    #[test]
    fn a_box_beyond_any_one_plane_is_hidden() {
        let lens = Perspective::new(Turn::degrees(60), NEAR, FAR).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let hides = |x: &str, y: &str, z: &str| {
            let positions = [[-1000, -1000, -1000], [1000, 1000, 1000]];
            let pose = Pose::IDENTITY.at(Vec3::lit(x, y, z));
            let transform = Transform::new(&camera, &pose, &tables(&positions));
            transform.is_outside_view(&BoundingBox::of(&positions), [321, 240])
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

    /// 2^31 units of offset along each axis, and 2^15 more: as far away as an object can be.
    #[test]
    fn the_farthest_object_is_where_it_should_be() {
        let camera = |eye, lens| Camera::at(eye, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        for offset in [i32::MAX, i32::MIN] {
            let mut far_off = tables(&[]);
            far_off.offset = Vec3::from_bits([offset; 3]);
            let pose = Pose::IDENTITY.scaled(U16F16::MAX).at(far_off.offset);
            let eye = Vec3::from_bits([!offset; 3]);
            let lens = Perspective::new(Turn::degrees(60), NEAR, FAR).unwrap();
            let transform = Transform::new(&camera(eye, lens), &pose, &far_off);
            assert_eq!(transform.check(), Ok(()));
            let ClipVertex { x, y, z, .. } = transform.object_to_clip([0; 3], ());
            // Along (1, 1, 1): down is -y, away -z, and 120 / tan(30 degrees) = 207.8 pixels of
            // 1,024 are a unit.
            let away = f64::from(z);
            assert!(away.abs() > f64::from(1 << 27) && (away < 0.0) == (offset > 0), "{z}");
            for (c, sign) in [(x, -1.0), (y, 1.0)] {
                let want = sign * away * 120.0 * 3f64.sqrt() / 1024.0;
                assert!((f64::from(c) / want - 1.0).abs() < 1e-6, "{c} {want}");
            }
        }
    }

    /// As `PoseError` promises, for objects that are modelled far from their origin and moved back
    /// too.
    #[test]
    fn places_are_known_to_27_bits() {
        let mut random = Random::new(0x1234_5678_9ABC_DEF1);
        let bits = |v: [i32; 3], unit: i32| v.map(|c| f64::from(c) * 2f64.powi(unit));
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
        for _ in 0..20_000 {
            let Case { mut pose, eye, rotation } = Case::random(&mut random);
            let mut tables = tables(&[]);
            tables.offset =
                Vec3::from_bits([0; 3].map(|_| i32::from(coordinate(&mut random)) << 8));
            let offset = bits(tables.offset.to_bits(), -16).map(|c| c * 1.75);
            let turned = pose.rotation.rows().map(|row| dot(row.map(|c| c.to_num()), offset));
            if coordinate(&mut random) > 0 {
                pose.translation = Vec3::from_bits(turned.map(|c| -(c * 65536.0) as i32));
            }
            let lens = Perspective::new(Turn::degrees(60), NEAR, FAR).unwrap();
            let camera = Camera::at(eye, rotation, lens, VIEWPORT).unwrap();
            let [at, eye] = [pose.translation, camera.eye()].map(|v| bits(v.to_bits(), -16));
            let way: [f64; 3] = core::array::from_fn(|i| at[i] - eye[i]);
            let largest = dot(way, way).max(dot(offset, offset)).sqrt();
            for axis in camera.axes() {
                let place =
                    Terms::new(axis, Float::new(1, 0), &camera.eye(), &pose, &tables).translation;
                let got = f64::from(place.mantissa) * 2f64.powi(place.exponent);
                let want = dot(bits(*axis, -30), core::array::from_fn(|i| way[i] + turned[i]));
                assert!((got - want).abs() <= largest * 2f64.powi(-27), "{got} {want} {largest}");
            }
        }
    }

    #[test]
    fn an_object_too_large_for_a_parallel_projection_is_an_error() {
        let lens = Orthographic::new(U16F16::DELTA, NEAR, FAR).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let check = |exponent: i32| {
            let mut large = tables(&[]);
            large.scale = Scale::new(1, exponent);
            Transform::new(&camera, &Pose::IDENTITY, &large).check()
        };
        // 240 pixels show 2^-16 units, so that the guard band is some 2^-14 units wide.
        assert_eq!(check(-5), Ok(()));
        assert_eq!(check(2), Err(PoseError));
        assert_eq!(check(900), Err(PoseError));
    }
}
