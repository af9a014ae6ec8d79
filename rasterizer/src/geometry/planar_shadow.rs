//! Objects flattened onto a plane along the light's direction: their shadows.
//!
//! A point p casts its shadow on the plane n . p + d = 0 at s = p - l (n . p + d) / (n . l), where
//! l points to the light. Along an axis a of the camera, a . s = a . p - k (n . p + d) with
//! k = (a . l) / (n . l): it is linear in p, with a - k n in place of a. So the matrix of an object
//! takes the shadow at no cost.

use heapless::Vec;

use super::{
    ClipPlanes, Clipping, Plane,
    clip::MAX_CORNERS,
    clip_planes::Corner,
    placement::Axis,
    shape::Posed,
    transform::{Axes, ClipVertex},
    visibility::UserPlanes,
};
use crate::{
    attribute::Varyings,
    camera::Camera,
    mesh::Mesh,
    numbers::{Coordinate, Float, Scalar, Vec3, shifted},
};

/// Draws the shadow of an object on a plane, in place of the object: each of its points where the
/// light of a far source puts it. What lies beyond the plane casts none.
///
/// All of it lies in the plane. So that it is seen on a floor there, move it nearer by a
/// [`Bias`](crate::raster::Bias). Its triangles overlap: through [`Once`](crate::output::Once) a
/// blended shadow has one tone. For a closed body the faces that the light meets are enough: those
/// that [`CullBack`](super::CullBack) leaves, seen from the light's side of the plane.
///
/// ```
/// # use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor};
/// # use rasterizer::mesh::Mesh;
/// use rasterizer::{
///     color::Alpha, geometry::{Plane, PlanarShadow}, output::{KeepDepth, Over}, prelude::*,
///     raster::Bias,
/// };
///
/// const FLOOR: Plane = Plane::new(Vec3::Y, Scalar::ZERO);
/// const SUN: Vec3 = Vec3::lit("-1", "2", "1");
///
/// # fn shadow(mesh: &Mesh<'_>, pose: Pose) {
/// let shadow = Object::new(mesh, Unlit::<Rgb565>::new())
///     .posed(pose)
///     .clipped(PlanarShadow::new(FLOOR, SUN))
///     .blended(KeepDepth(Over(Alpha::lit("0.5"))))
///     .biased(Bias::BEHIND_LINES);
/// # let _ = shadow;
/// # }
/// ```
///
/// The light shines on the side that the plane's normal points to; otherwise there is no shadow.
/// Vertices are placed as an object's, with the largest coordinate m of
/// [`PoseError`](super::PoseError) taken of the shadow: it is refused where a low sun makes it too
/// long. The shadow of a light at a point is a [`LampShadow`](super::LampShadow).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PlanarShadow {
    plane: Plane,
    toward: Vec3,
    /// What is on the light's side.
    lit: ClipPlanes<1>,
}

impl PlanarShadow {
    /// On a plane of the world, in the light from the direction `toward`, of any length.
    #[must_use]
    pub const fn new(plane: Plane, toward: Vec3) -> Self {
        Self { plane, toward, lit: ClipPlanes::in_world([plane]) }
    }

    /// n . l.
    fn incidence(&self) -> Float {
        let [n, l] = [self.plane.normal, self.toward].map(Vec3::to_bits);
        // A quarter of three products of up to 2^62, so that the sum fits.
        let sum = (0..3).fold(0i64, |sum, i| sum + ((i64::from(n[i]) * i64::from(l[i])) >> 2));
        Float::new(sum, -30)
    }
}

impl Clipping for PlanarShadow {
    const CUTS: bool = true;
}

impl UserPlanes for PlanarShadow {
    const EXIST: bool = true;
    type Axes = Self;

    fn placed(self, posed: impl Posed, mesh: &Mesh<'_>) -> Self {
        // In light from the side or from beyond, nothing is left: no point has a positive sum.
        let none = Plane::new(Vec3::ZERO, Scalar::from_bits(-1));
        let is_lit = self.incidence().mantissa > 0;
        let lit = ClipPlanes::in_world([if is_lit { self.plane } else { none }]);
        Self { lit: lit.placed(posed, mesh), ..self }
    }

    fn axes(&self) -> Self {
        *self
    }

    #[inline(always)]
    fn keeps(&self, position: [i16; 3]) -> bool {
        self.lit.keeps(position)
    }

    fn excludes(&self, positions: impl Iterator<Item = [i16; 3]> + Clone) -> bool {
        self.lit.excludes(positions)
    }

    fn cut<C: Coordinate, V: Varyings>(
        &self,
        triangle: &[Corner<C, V>; 3],
        kept: &mut Vec<ClipVertex<C, V>, MAX_CORNERS>,
    ) {
        self.lit.cut(triangle, kept);
    }

    fn cut_line<C: Coordinate, V: Varyings>(
        &self,
        ends: &[Corner<C, V>; 2],
    ) -> Option<[ClipVertex<C, V>; 2]> {
        self.lit.cut_line(ends)
    }
}

impl Axes for PlanarShadow {
    #[inline(never)]
    fn axis<P>(
        &self,
        camera: &Camera<P>,
        axis: usize,
        mut magnification: Float,
        posed: impl Posed,
        offset: Vec3,
    ) -> Axis {
        let (a, pose) = (&camera.axes()[axis], posed.pose());
        let incidence = self.incidence();
        if incidence.mantissa <= 0 {
            return Axis::new(camera, axis, magnification, posed, offset);
        }
        let minus_k = Float::new(-self.toward.along(a), -46).times(incidence.reciprocal());
        let [nx, ny, nz] = self.plane.normal.to_bits().map(|c| Float::new(c.into(), -16));
        let scaled = |a: i32, n: Float| Float::new(a.into(), -30).plus(n.times(minus_k));
        let vector = [scaled(a[0], nx), scaled(a[1], ny), scaled(a[2], nz)];
        // Its coordinates below a half of 2^down.
        let down = vector.iter().fold(-1, |most, c| most.max(c.magnitude())) + 1;
        let vector = vector.map(|c| c.in_units_of(down - 30));
        // a . (t - e) - k (n . t + d), for the pose's place t and the eye e.
        let way = pose.translation.along(a) - camera.eye().along(a);
        let [tx, ty, tz] = pose.translation.to_bits().map(|c| Float::new(c.into(), -16));
        let height = nx.times(tx).plus(ny.times(ty)).plus(nz.times(tz));
        let height = height.plus(Float::new(self.plane.offset.to_bits().into(), -16));
        let way = Float::new(way, -46).plus(height.times(minus_k));
        // Within 2^16 units, as a mesh that is nearer to the eye is refused, or not seen.
        let way = match way.magnitude() - down {
            ..=16 => shifted(way.mantissa.into(), way.exponent + 46 - down),
            _ if way.mantissa < 0 => -1 << 62,
            _ => 1 << 62,
        };
        magnification.exponent += down;
        Axis::along(&vector, way, magnification, posed, offset)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec as List;

    use embedded_graphics_core::{
        geometry::{Point, Size},
        pixelcolor::Rgb565,
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        camera::{Distance, Perspective},
        geometry::{Pose, ScreenVertex},
        mesh::{Material, Positions, Tables, Triangles},
        numbers::{Rotation, S4, S8, Scale, Subpixel, Turn},
        random::Random,
        scene::Object,
        shade::Unlit,
    };

    const FOCAL: f64 = 120.0;

    /// Each vertex above the plane is where the light puts it, in pixels; the others are left out.
    fn is_cast<S: Subpixel>(bound: f64) {
        let mut random = Random::new(12);
        let (mut seen, mut beyond) = (0, 0);
        for _ in 0..400 {
            let mut bits = |down: u32| ((random.bits() as i32) << 1) >> down;
            let positions = [0; 30].map(|_| [0; 3].map(|_| bits(16) as i16));
            let mesh = Mesh::new_const(Tables {
                positions: Positions::I16(&positions),
                scale: Scale::new(1, -15),
                triangles: Triangles::U8(&[[0; 3]]),
                materials: const { &[Material::new([0; 3], 1)] },
                ..Tables::EMPTY
            });
            let turn = Rotation::about_x(Turn::from_bits(bits(0) as u32))
                * Rotation::about_y(Turn::from_bits(bits(0) as u32));
            let place = Vec3::from_bits([bits(16), bits(16), bits(16)]);
            // A plane that is nearly level, up to half a unit below the origin, in light that
            // comes from at least 27 degrees above it.
            let normal = Vec3::from_bits([bits(17), 3 << 16, bits(17)]);
            let plane = Plane::new(normal, Scalar::from_bits(bits(15)));
            let toward = Vec3::from_bits([bits(16), 1 << 16, bits(16)]);
            let (near, far) = (Distance::lit("0.5"), Distance::lit("60"));
            let lens =
                Perspective::with_focal_length(Distance::from_num(FOCAL), near, far).unwrap();
            let viewport = Rectangle::new(Point::zero(), Size::new(200, 150));
            let eye = Vec3::from_bits([bits(14), 5 << 16, 9 << 16]);
            let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, viewport).unwrap();
            let mut vertices = [ScreenVertex::<S, u32, _>::EMPTY; 30];
            let shadow = Object::new(&mesh, Unlit::<Rgb565>::new())
                .posed(Pose::rotated(turn).at(place))
                .clipped(PlanarShadow::new(plane, toward));
            if shadow.project(&camera, &mut vertices).unwrap().is_outside_view() {
                continue;
            }

            let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65_536.0);
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| a[i] * b[i]).sum::<f64>();
            let rows = turn.rows().map(|row| row.map(|c| c.to_num::<f64>()));
            let axes = camera.axes().map(|axis| axis.map(|c| f64::from(c) / f64::from(1 << 30)));
            let (n, l, t, e) = (numbers(normal), numbers(toward), numbers(place), numbers(eye));
            for (position, vertex) in positions.iter().zip(&vertices) {
                let model = position.map(|c| f64::from(c) / 32_768.0);
                let world: [f64; 3] = core::array::from_fn(|i| dot(rows[i], model) + t[i]);
                let height = dot(n, world) + plane.offset.to_num::<f64>();
                if height < -1e-3 {
                    beyond += 1;
                    assert_eq!(vertex.position(), None, "{height}");
                } else if height > 1e-3 {
                    let cast: [f64; 3] =
                        core::array::from_fn(|i| world[i] - l[i] * height / dot(n, l) - e[i]);
                    let [right, down, forward] = axes.map(|axis| dot(axis, cast));
                    let want: List<f64> =
                        [100.0 + FOCAL * right / forward, 75.0 + FOCAL * down / forward].into();
                    let Some(got) = vertex.position() else { continue };
                    seen += 1;
                    for (got, want) in got.iter().zip(want) {
                        let off = f64::from(*got) - want * f64::from(1 << S::BITS);
                        assert!(off.abs() < bound, "{off} sub-pixels, {plane:?} {toward:?}");
                    }
                    let depth = f64::from(vertex.depth()) / 2f64.powi(32);
                    assert!((depth - 0.5 / forward).abs() < 1e-6, "{depth}");
                }
            }
        }
        assert!(seen > 3000 && beyond > 1000, "{seen} {beyond}");
    }

    #[test]
    fn shadows_are_where_the_light_puts_them() {
        // Half for snapping, an eighth for arithmetic.
        is_cast::<S4>(0.625);
        is_cast::<S8>(0.625);
    }

    /// Light from beyond the plane, and along it.
    #[test]
    fn light_from_the_other_side_casts_no_shadow() {
        let mesh = crate::mesh::Card::<2, 2>::CENTERED;
        let lens =
            Perspective::new(Turn::degrees(60), Distance::lit("0.5"), Distance::lit("9")).unwrap();
        let viewport = Rectangle::new(Point::zero(), Size::new(64, 64));
        let eye = Vec3::lit("0", "1", "4");
        let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, viewport).unwrap();
        let floor = Plane::new(Vec3::Y, Scalar::ONE);
        for (toward, is_none) in [
            (Vec3::lit("1", "1", "0"), false),
            (Vec3::lit("1", "-1", "0"), true),
            (Vec3::X, true),
            (Vec3::ZERO, true),
        ] {
            let mut vertices = [ScreenVertex::<S4, u16, _>::EMPTY; 4];
            let shadow = Object::new(&mesh, Unlit::<Rgb565>::new())
                .clipped(PlanarShadow::new(floor, toward));
            let seen = shadow.project(&camera, &mut vertices).unwrap();
            assert_eq!(seen.is_outside_view(), is_none, "{toward:?}");
        }
    }
}
