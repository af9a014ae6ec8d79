//! Object space to clip space to the screen: the work on every vertex.

use core::array;

use super::{
    PoseError, Projection, ScreenVertex,
    lens::{Lens, Reach},
    placement::{self, Axis, Grid},
    row::Row,
    screen::GUARD_BITS,
    shape::Posed,
};
use crate::{
    attribute::{DepthFormat, Interpolate, Varyings},
    camera::Camera,
    mesh::{BoundingBox, Mesh},
    numbers::{Coordinate, Float, Subpixel, Vec3, codegen, mul_high, saturate},
};

/// A point in clip space.
///
/// The units are an object's own, chosen so that no coordinate of a vertex reaches 2^30. `|x| <= w`
/// and `|y| <= w` is the guard band: w stands for 1,024 pixels, for every focal length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ClipVertex<C, V> {
    /// To the right.
    pub(crate) x: C,
    /// Downwards.
    pub(crate) y: C,
    /// Away from the camera.
    pub(crate) z: C,
    pub(crate) varyings: V,
}

/// The axes along which an object is seen.
pub(crate) trait Axes: Copy {
    /// The axis in place of that of the camera with this number, and how far the object is along
    /// it.
    fn axis<P>(
        &self,
        camera: &Camera<P>,
        axis: usize,
        magnification: Float,
        posed: impl Posed,
        offset: Vec3,
    ) -> Axis;
}

/// Those of the camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CameraAxes;

impl Axes for CameraAxes {
    #[inline(always)]
    fn axis<P>(
        &self,
        camera: &Camera<P>,
        axis: usize,
        magnification: Float,
        posed: impl Posed,
        offset: Vec3,
    ) -> Axis {
        Axis::new(camera, axis, magnification, posed, offset)
    }
}

impl<C, V: Varyings> ClipVertex<C, V> {
    /// This vertex as a corner, 0 to 2, of one of its triangles.
    #[inline(always)]
    pub(crate) fn at(self, corner: usize) -> Self {
        Self { varyings: self.varyings.at_corner(corner), ..self }
    }
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
    /// The binary exponent of the unit of z.
    unit: i32,
    /// By how many bits positions are shifted up.
    position_shift: u32,
    /// Whether numbers fit, so that the planes beyond which an object lies are known.
    is_in_range: bool,
    /// Whether all vertices in front of the near plane are placed as exactly as promised.
    is_exact: bool,
    /// The viewport's middle in half pixels.
    center: [i32; 2],
}

impl<P: Projection> Transform<P> {
    /// Pose, camera, focal length and the mesh's own scale in one matrix. Where coordinates have a
    /// fraction, it is exact near the eye if it must be.
    // codegen: not inlined, or the caller's frame would hold its temporaries while triangles are
    // drawn.
    #[inline(never)]
    pub(crate) fn new<S: Subpixel>(
        camera: &Camera<P>,
        axes: impl Axes,
        posed: impl Posed,
        mesh: &Mesh<'_>,
    ) -> Self {
        let projection = camera.projection();
        let viewport = camera.viewport();
        let (corner, size) = (viewport.top_left, viewport.size);
        // Guard bands for a world unit at w = 1, and units of z.
        let [mut across, deep] = projection.magnification(size.height);
        across.exponent -= GUARD_BITS as i32;
        let offset = mesh.tables().offset;
        let axis = |axis, magnification| axes.axis(camera, axis, magnification, posed, offset);
        let (mut x_axis, mut y_axis, mut z_axis) =
            (axis(0, across), axis(1, across), axis(2, deep));
        let mut grid = Grid::new(posed, mesh);
        let mut is_in_range = placement::is_offset_in_range(posed, offset);
        let mut is_moved = false;
        let mut reach = z_axis.reach(&grid);
        reach.mantissa = -reach.mantissa;
        let least_z = z_axis.origin().plus(reach);
        loop {
            let units = projection.units(
                x_axis.magnitude(&grid).max(y_axis.magnitude(&grid)),
                z_axis.magnitude(&grid),
            );
            let [near, far] = projection.depth_range(units);
            let lens = projection.lens(units);
            let mut least_w = lens.least_w(least_z.in_units_of(units.z));
            if is_moved {
                let [x, y] = [&x_axis, &y_axis].map(|axis| {
                    let row = <Row>::new::<S::Coordinate>(axis, &grid, units.xy);
                    row.end(mesh, false).saturating_abs().max(row.end(mesh, true).saturating_abs())
                });
                let near_axis = projection.least_w(&Reach {
                    distance: grid.distance([&x_axis, &y_axis, &z_axis], posed, mesh),
                    across,
                    least_w,
                    side: i64::from(x) + i64::from(y),
                    units,
                });
                least_w = least_w.max(near_axis);
            }
            // In units, a coordinate is off by 3.7 at most: 1.9 for the entries, 0.5 each for
            // rounding the translation and the sum, the rest for the 31 bits of lengths; with a
            // fraction by 3.5. That much of x and of w move a vertex by an eighth of a sub-pixel at
            // most if w is this large. So do the steps of the way, eight of which it is off by.
            let step =
                across.magnitude().max(deep.magnitude()) - placement::FRACTION_BITS - units.xy;
            let bits = (step + 18).max(16) + S::BITS as i32;
            let is_exact = bits < 31 && least_w >> bits != 0;
            if is_exact || is_moved || !S::Coordinate::HAS_FRACTION {
                break Self {
                    x: Row::new::<S::Coordinate>(&x_axis, &grid, units.xy),
                    y: Row::new::<S::Coordinate>(&y_axis, &grid, units.xy),
                    z: Row::new::<S::Coordinate>(&z_axis, &grid, units.z),
                    near,
                    far,
                    lens,
                    unit: units.z,
                    position_shift: mesh.spare_bits() + <Row>::POSITION_SHIFT,
                    is_in_range,
                    is_exact,
                    center: [2 * corner.x + size.width as i32, 2 * corner.y + size.height as i32],
                };
            }
            is_in_range &= grid.move_anchor([&mut x_axis, &mut y_axis, &mut z_axis], posed, mesh);
            is_moved = true;
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
            unit: self.unit,
            position_shift: self.position_shift,
            is_in_range: self.is_in_range,
            is_exact: self.is_exact,
            center: self.center,
        }
    }

    /// Checks that the object fits the number range. Call this first: no other method but
    /// [`is_outside_view`](Self::is_outside_view) is valid until it succeeds. An object that is
    /// outside the view need not be exact.
    pub(crate) const fn check(&self, is_outside_view: bool) -> Result<(), PoseError> {
        if self.is_in_range && (self.is_exact || is_outside_view) { Ok(()) } else { Err(PoseError) }
    }

    /// A position of the mesh in clip space.
    #[inline(always)]
    pub(crate) fn object_to_clip<C: Coordinate, V>(
        &self,
        position: [i16; 3],
        varyings: V,
    ) -> ClipVertex<C, V> {
        let shifted = |axis: usize| i32::from(position[axis]) << self.position_shift;
        let p = [shifted(0), shifted(1), shifted(2)];
        ClipVertex { x: self.x.apply(p), y: self.y.apply(p), z: self.z.apply(p), varyings }
    }

    /// [`object_to_clip`](Self::object_to_clip) without varyings, outlined for the few vertices of
    /// boxes and clipped triangles.
    #[cold]
    #[inline(never)]
    pub(crate) fn object_to_clip_outlined<C: Coordinate>(&self, position: [i16; 3]) -> [C; 3] {
        let ClipVertex { x, y, z, .. } = self.object_to_clip(position, ());
        [x, y, z]
    }

    /// Three quarters of how far the middle of a triangle whose positions have this sum lies along
    /// the camera's axis, modulo 2^32, from an own zero
    /// ([`distance_zero`](Self::distance_zero)): within a quantum of the mesh, in multiples of
    /// 2^[`unit`](Self::unit).
    // A quarter of the sum, because a third takes multiplications.
    #[inline(always)]
    pub(crate) fn distance<C: Coordinate>(&self, sum: [i32; 3]) -> i32 {
        let spare_bits = self.position_shift - <Row>::POSITION_SHIFT;
        let position = sum.map(|c| ((c << spare_bits) >> 2) << <Row>::POSITION_SHIFT);
        self.z.apply::<C>(position).units()
    }

    /// What [`distance`](Self::distance) is more than three quarters of a triangle's distance,
    /// modulo 2^32.
    pub(crate) fn distance_zero<C: Coordinate>(&self, mesh: &Mesh<'_>) -> i32 {
        let corner = mesh.bounds().min;
        let [_, _, z] = self.object_to_clip_outlined::<C>(corner);
        let distance = self.distance::<C>(corner.map(|c| 3 * i32::from(c)));
        distance.wrapping_sub(three_quarters(z.units()))
    }

    /// The unit of [`distance`](Self::distance): two to this power. What 1 is depends on the
    /// camera alone.
    #[inline(always)]
    pub(crate) const fn unit(&self) -> i32 {
        self.unit
    }

    /// Three quarters of the least and the greatest distance of any triangle of the mesh, or a few
    /// units and a quantum of the mesh more.
    pub(crate) fn distances(&self, mesh: &Mesh<'_>) -> [i32; 2] {
        let ends = [false, true].map(|end| three_quarters(self.z.end(mesh, end)));
        // Products and sums are rounded by less than 8 units together, a triangle's position by
        // less than a quantum in each axis.
        let margin = 8 + self.z.quanta();
        [ends[0] - margin, ends[1] + margin]
    }

    /// Projects a vertex. The result is not on the screen if the vertex is outside near plane, far
    /// plane or guard band.
    #[inline(always)]
    pub(crate) fn clip_to_screen<S: Subpixel, D: DepthFormat, V: Varyings>(
        &self,
        vertex: ClipVertex<S::Coordinate, V>,
    ) -> ScreenVertex<S, D, V::OnScreen> {
        let [x, y, z] = [vertex.x, vertex.y, vertex.z].map(S::Coordinate::units);
        let w = self.lens.w(z);
        // Negative if one of them is: no coordinate reaches 2^30.
        if ((z - self.near) | (self.far - z) | (w - x) | (w + x) | (w - y) | (w + y)) < 0 {
            return ScreenVertex::off_screen(V::OnScreen::ZERO);
        }
        self.place_on_screen(vertex)
    }

    /// Projects a vertex that lies within near plane, far plane and guard band, perhaps by a
    /// fraction of a unit.
    #[inline(always)]
    pub(crate) fn place_on_screen<S: Subpixel, D: DepthFormat, V: Varyings>(
        &self,
        vertex: ClipVertex<S::Coordinate, V>,
    ) -> ScreenVertex<S, D, V::OnScreen> {
        let ClipVertex { varyings, .. } = vertex;
        let reciprocal = self.lens.reciprocal_of_twice_w(vertex.z);
        // x / w = (x << n) r / 2^61, where r = 2^62 / (2 w << n) and |x| <= w < 2^30: its upper
        // half has 29 bits behind the point; 10 + S of them are sub-pixels of the guard band.
        let to_subpixels = |c: S::Coordinate, center: i32| {
            let c = c.shifted_units(reciprocal.leading_zeros);
            let quotient = mul_high(c, reciprocal.mantissa);
            let drop = 29 - GUARD_BITS - S::BITS;
            let subpixels = (quotient + (1 << (drop - 1))) >> drop;
            let limit = 1 << (GUARD_BITS + S::BITS);
            saturate(subpixels, limit) + (center << (S::BITS - 1))
        };
        ScreenVertex::new(
            to_subpixels(vertex.x, self.center[0]),
            to_subpixels(vertex.y, self.center[1]),
            D::from_fraction(self.lens.depth(vertex.z.units(), reciprocal)),
            varyings.on_screen(self.lens.inverse_w(reciprocal)),
        )
    }

    /// Whether the viewer is in front of a plane of the mesh: where three points of it run
    /// counter-clockwise.
    ///
    /// With (x, y, w) of the points as rows, the determinant is six times the volume of the
    /// tetrahedron of the eye and the three points; in a parallel projection, where w is the same
    /// everywhere, it is twice the area of their triangle on the screen times w. Counter-clockwise
    /// is negative, as y runs downwards.
    #[inline(never)]
    pub(crate) fn is_in_front_of<C: Coordinate>(&self, points: &[[i16; 3]; 3]) -> bool {
        let in_clip_space = |point| {
            let [x, y, z] = self.object_to_clip_outlined::<C>(point).map(C::units);
            [x, y, self.lens.w(z)]
        };
        let [a, b, c] = *points;
        let (mut a, b, c) = (in_clip_space(a), in_clip_space(b), in_clip_space(c));
        // Below 2^30 each, so that differences fit 32 bits, and products of two of them 62.
        let [mut u, mut v] = [b, c].map(|other| array::from_fn(|i| other[i] - a[i]));
        let mut determinant = Float::ZERO;
        // codegen: rotated, because indices that a compiler does not know have panics.
        for _ in 0..codegen::unknown(3) {
            let [[first, ..], [_, j, k], [_, l, m]] = [a, u, v];
            let minor = i64::from(j) * i64::from(m) - i64::from(k) * i64::from(l);
            determinant = determinant.plus(Float::new(minor, 0).times(Float::new(first.into(), 0)));
            [a, u, v] = [a, u, v].map(|[x, y, z]| [y, z, x]);
        }
        determinant.mantissa < 0
    }

    /// Whether a box is certain to lie outside a picture of `size` pixels in width and height: all
    /// its corners beyond one and the same plane.
    pub(crate) fn is_outside_view<C: Coordinate>(
        &self,
        cuboid: &BoundingBox,
        size: [i32; 2],
    ) -> bool {
        let mut beyond_all = 0b11_1111;
        for index in 0..codegen::unknown(8) {
            beyond_all &= self.beyond::<C>(cuboid.corner(index), size);
            if beyond_all == 0 {
                return false;
            }
        }
        true
    }

    /// The planes of the picture beyond which a position lies: a bit for each of the six.
    // codegen: not inlined, because compilers repeat it for each corner of a box.
    #[inline(never)]
    pub(crate) fn beyond<C: Coordinate>(
        &self,
        position: [i16; 3],
        [width, height]: [i32; 2],
    ) -> u8 {
        let [x, y, z] = self.object_to_clip_outlined(position).map(C::units);
        // A pixel wider than the viewport, so that rounding cannot hide a visible edge.
        let (across, down) = (width / 2 + 2, height / 2 + 2);
        // A pixel's width, rounded up: the sides move outwards, and their products stay below 2^31
        // as the viewport is no wider than the guard band. Beyond the near plane it may be
        // negative, and the sides are still planes through the eye: upwards is outwards there too.
        let w = (self.lens.w(z) >> GUARD_BITS) + 1;
        let (across, down) = (w * across, w * down);
        // In the coarse units of an object that is large beside its distance, so does depth.
        let (near, far) = (self.near - MARGIN, self.far + MARGIN);
        let beyond = [z < near, z > far, x < -across, x > across, y < -down, y > down];
        beyond.iter().fold(0, |bits, &outside| bits << 1 | u8::from(outside))
    }
}

/// By how much a coordinate is off at most, in units.
const MARGIN: i32 = 4;

/// 3/4 of a coordinate, rounded up.
const fn three_quarters(units: i32) -> i32 {
    units - (units >> 2)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::geometry::{Point, Size};
    use fixed::types::U16F16;

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        geometry::Pose,
        mesh::{Material, Positions, Tables, Triangles},
        numbers::{Rotation, S4, S8, Scale, Turn},
        random::Random,
    };

    const VIEWPORT: embedded_graphics_core::primitives::Rectangle =
        embedded_graphics_core::primitives::Rectangle::new(Point::new(7, -5), Size::new(321, 240));
    const NEAR: U16F16 = U16F16::lit("0.25");
    const FAR: U16F16 = U16F16::lit("50");

    const MATERIALS: [Material; 1] = [Material::new([0; 3], 1)];

    fn tables(positions: &[[i16; 3]]) -> Tables<'_> {
        Tables {
            positions: Positions::I16(positions),
            // A half-extent of 1.5.
            scale: Scale::new(3, -16),
            offset: Vec3::lit("0.5", "-0.25", "0.125"),
            triangles: Triangles::U8(&[[0; 3]]),
            materials: &MATERIALS,
            ..Tables::EMPTY
        }
    }

    fn mesh(positions: &[[i16; 3]]) -> Mesh<'_> {
        Mesh::new_const(tables(positions))
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
            let model: [f64; 3] =
                array::from_fn(|i| (offset[i] + f64::from(position[i]) * 3.0 / 65536.0) * 1.75);
            let turned = apply(rows(&self.pose.rotation), model);
            let (at, eye) = (numbers(self.pose.translation), numbers(self.eye));
            let world: [f64; 3] = array::from_fn(|i| turned[i] + at[i] - eye[i]);
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
            let transform = Transform::new::<S>(&camera, CameraAxes, &case.pose, &mesh(&positions));
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
                    !transform
                        .is_outside_view::<S::Coordinate>(&BoundingBox::of(&positions), [321, 240]),
                    "a box is hidden that shows"
                );
            }
        }
        assert!(seen > 20, "only {seen} cases show anything");
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

    /// A point in view of a mesh so large that its units are as long as the way to it.
    #[test]
    fn a_huge_object_in_view_is_refused_rather_than_hidden() {
        let [near, far] = [U16F16::lit("2.5"), U16F16::lit("23")];
        let lens = Perspective::with_focal_length(U16F16::lit("0.001"), near, far).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let positions = [[0, 0, 0]];
        let huge =
            Tables { scale: Scale::new(u32::MAX, -16), offset: Vec3::ZERO, ..tables(&positions) };
        let huge = Mesh::new_const(huge);
        for tenths in 26..230 {
            let place = Vec3::from_bits([0, 0, -(tenths << 16) / 10]);
            let pose = Pose::IDENTITY.at(place).scaled(U16F16::MAX);
            let transform = Transform::new::<S4>(&camera, CameraAxes, &pose, &huge);
            let is_hidden = transform.is_outside_view::<i32>(huge.bounds(), [321, 240]);
            assert!(!is_hidden, "at {tenths} tenths");
            assert_eq!(transform.check(is_hidden), Err(PoseError));
        }
    }

    #[test]
    fn a_box_beyond_any_one_plane_is_hidden() {
        let lens = Perspective::new(Turn::degrees(60), NEAR, FAR).unwrap();
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, VIEWPORT).unwrap();
        let hides = |x: &str, y: &str, z: &str| {
            let positions = [[-1000, -1000, -1000], [1000, 1000, 1000]];
            let pose = Pose::IDENTITY.at(Vec3::lit(x, y, z));
            let transform = Transform::new::<S4>(&camera, CameraAxes, &pose, &mesh(&positions));
            transform.is_outside_view::<i32>(&BoundingBox::of(&positions), [321, 240])
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
}
