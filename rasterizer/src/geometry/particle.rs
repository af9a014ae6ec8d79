//! Particles: squares that face the camera, from points of the world to the screen.
//!
//! A camera's axes become rows of a matrix once a frame. A particle takes three products of it for
//! each coordinate, in 64 bits, and one reciprocal.

use super::{Projection, screen::GUARD_BITS};
use crate::{
    camera::{Camera, Distance},
    color::Alpha,
    numbers::{Float, Reciprocal, S4, Subpixel, Vec3, leading_zeros, mul_high},
};

/// A square that faces the camera: a spark, a drop, a flake, a puff of smoke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Particle<C> {
    /// Where its middle is in the world.
    pub place: Vec3,
    /// The length of a side in world units, or in pixels.
    pub size: Distance,
    /// Its colour.
    pub color: C,
    /// How much it hides, or how bright it is where light is added.
    pub alpha: Alpha,
    /// Which picture of several it shows, from 0.
    pub frame: u16,
}

impl<C> Particle<C> {
    /// Opaque, with the first picture.
    #[must_use]
    pub const fn new(place: Vec3, size: Distance, color: C) -> Self {
        Self { place, size, color, alpha: Alpha::OPAQUE, frame: 0 }
    }
}

/// What can be drawn as a particle: a type of a program's own, which may also have a speed and an
/// age. It stays where it is: its particle is made when it is drawn.
pub trait AsParticle {
    /// The type of its colour.
    type Color: Copy;

    /// Returns it as a particle.
    fn particle(&self) -> Particle<Self::Color>;
}

impl<C: Copy> AsParticle for Particle<C> {
    type Color = C;

    #[inline(always)]
    fn particle(&self) -> Self {
        *self
    }
}

/// Storage for a particle on the screen: 12 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ScreenParticle {
    /// From the viewport's middle, in 16ths of a pixel: at most 2^14.
    middle: [i16; 2],
    /// In 16ths of a pixel: at most 2^15.
    side: u16,
    number: u16,
    depth: u32,
}

impl ScreenParticle {
    /// The initial content of storage. All its bits are 0, so that storage in a `static` takes no
    /// flash.
    pub const EMPTY: Self = Self { middle: [0; 2], side: 0, number: 0, depth: 0 };

    /// The same for the particle with this place in its slice.
    #[inline(always)]
    pub(crate) const fn of(self, number: u16) -> Self {
        Self { number, ..self }
    }

    /// Where its middle lies, from the viewport's middle, in 16ths of a pixel.
    #[inline(always)]
    #[must_use]
    pub fn middle(&self) -> [i32; 2] {
        self.middle.map(i32::from)
    }

    /// The length of its sides in 16ths of a pixel.
    #[inline(always)]
    #[must_use]
    pub const fn side(&self) -> u16 {
        self.side
    }

    /// Its place in the slice of particles.
    #[inline(always)]
    #[must_use]
    pub const fn number(&self) -> u16 {
        self.number
    }

    /// Its depth in Q0.32: near / w, as a depth buffer has it.
    #[inline(always)]
    #[must_use]
    pub const fn depth(&self) -> u32 {
        self.depth
    }
}

/// A camera as particles need it, for one frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ParticleView {
    /// To the right, downwards and away from the camera, in Q(30 - d): for the first two, guard
    /// bands at w = 1. Here d is the least number, from 0 on, with which no entry is over 1.
    rows: [[i32; 3]; 3],
    /// The eye along them, in Q(46 - d).
    eye: [i64; 3],
    /// Guard bands for a unit at w = 1, in Q(30 - d).
    across: i32,
    /// The distances of the near and of the far plane, in Q(46 - d).
    near: i64,
    far: i64,
    /// w in a parallel projection, in Q(46 - d); 0 in the other one.
    parallel_w: i64,
    /// Half the viewport, in 16ths of a pixel.
    half: [i32; 2],
    /// Whether sizes are in pixels.
    is_in_pixels: bool,
}

impl ParticleView {
    #[inline(never)]
    pub(crate) fn new<P: Projection>(camera: &Camera<P>, is_in_pixels: bool) -> Self {
        let size = camera.viewport().size;
        let mut across = camera.pixels_per_unit();
        across.exponent -= GUARD_BITS as i32;
        // Positive, and at most 26 as no focal length reaches 2^36.
        let down = across.magnitude().clamp(0, 26);
        let row = |axis: &[i32; 3], scale: Float| {
            axis.map(|c| Float::new(c.into(), -30).times(scale).in_units_of(down - 30))
        };
        let [right, down_axis, forward] = camera.axes();
        let rows = [row(right, across), row(down_axis, across), row(forward, Float::new(1, 0))];
        let length = |length: Float| i64::from(length.in_units_of(-16)) << (30 - down);
        let [near, far] = camera.projection().range();
        Self {
            rows,
            eye: rows.map(|row| camera.eye().along(&row)),
            across: across.in_units_of(down - 30),
            near: length(near),
            far: length(far),
            parallel_w: if P::IS_PARALLEL { 1 << (46 - down) } else { 0 },
            half: [size.width, size.height].map(|side| (side << (S4::BITS - 1)).cast_signed()),
            is_in_pixels,
        }
    }

    /// A particle on the screen; `None` if nothing of it is in the viewport.
    #[inline(always)]
    pub(crate) fn place<C>(&self, particle: &Particle<C>) -> Option<ScreenParticle> {
        let along = |i: usize| particle.place.along(&self.rows[i]).wrapping_sub(self.eye[i]);
        let z = along(2);
        if z < self.near || z > self.far || particle.size == Distance::ZERO {
            return None;
        }
        let w = if self.parallel_w == 0 { z } else { self.parallel_w };
        let per_w = Per::new(w);
        let [x, y] = [along(0), along(1)];
        if x.max(-x) > w || y.max(-y) > w {
            return None;
        }
        // The guard band is 2^14 16ths wide, so that a 2^15th of the Q29 has half of one.
        let middle = [x, y].map(|c| (per_w.times_q29(c) + (1 << 14)) >> 15);
        let side = if self.is_in_pixels {
            particle.size.to_bits().saturating_add(1 << 11) >> 12
        } else {
            let half = (u64::from(particle.size.to_bits()) * u64::from(self.across.unsigned_abs()))
                .cast_signed()
                >> 1;
            ((per_w.times_q29(half.min(w)) + (1 << 13)) >> 14).cast_unsigned()
        };
        let side = side.clamp(1 << S4::BITS, 1 << 15);
        let reach = |axis: usize| self.half[axis] + (side.cast_signed() >> 1) + 1;
        if middle[0].abs() > reach(0) || middle[1].abs() > reach(1) {
            return None;
        }
        let depth = if self.parallel_w == 0 {
            per_w.times_q32(self.near)
        } else {
            Per::new(self.far.wrapping_sub(self.near).max(1)).times_q32(self.far.wrapping_sub(z))
        };
        Some(ScreenParticle {
            middle: middle.map(|c| c as i16),
            side: side as u16,
            number: 0,
            depth,
        })
    }
}

/// One over a positive number.
#[derive(Clone, Copy, Debug)]
struct Per {
    /// By how much numbers are shifted up, so that the divisor has its first digit in bit 62.
    shift: u32,
    /// 2^62 / the divisor's upper 32 digits: within 2^-27.
    mantissa: u32,
}

impl Per {
    const fn new(divisor: i64) -> Self {
        let upper = (divisor >> 31) as u32;
        let shift = if upper == 0 {
            32 + leading_zeros((divisor << 1) as u32)
        } else {
            leading_zeros(upper)
        };
        let normalised = ((divisor << shift) >> 31) as u32;
        Self { shift, mantissa: Reciprocal::of(normalised).mantissa.cast_unsigned() }
    }

    /// A number that is no larger than the divisor, over it: in Q29.
    const fn times_q29(self, number: i64) -> i32 {
        // Below 2^31, over 2^31 times the divisor's 32 digits: the product is in Q61.
        mul_high(((number << self.shift) >> 32) as i32, self.mantissa.cast_signed())
    }

    /// A number from 0 to the divisor, over it: in Q32, at most 2^32 - 1.
    fn times_q32(self, number: i64) -> u32 {
        let upper = ((number << self.shift) >> 31) as u32;
        let quotient = (u64::from(upper) * u64::from(self.mantissa)) >> 30;
        if quotient >> 32 == 0 { quotient as u32 } else { u32::MAX }
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::{
        geometry::{Point, Size},
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        random::Random,
    };

    const VIEWPORT: Rectangle = Rectangle::new(Point::new(7, -5), Size::new(321, 240));

    /// Random particles before random cameras, against f64, in a cube of 2^-`spread` of the space
    /// in which cameras are. Returns how many are seen.
    fn is_placed<P: Projection>(
        lens: P,
        pixels: impl Fn(f64) -> f64,
        depth: impl Fn(f64) -> f64,
        [reach_bits, spread]: [u32; 2],
        seed: u64,
    ) -> usize {
        let mut random = Random::new(seed);
        let mut seen = 0;
        for _ in 0..200 {
            let mut bits = |down: u32| ((random.bits() as i32) << 1) >> down;
            let eye = Vec3::from_bits([0; 3].map(|_| bits(31 - reach_bits)));
            let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, VIEWPORT).unwrap();
            let axes = camera.axes().map(|axis| axis.map(|c| f64::from(c) / 2f64.powi(30)));
            for is_in_pixels in [false, true] {
                let view = ParticleView::new(&camera, is_in_pixels);
                for _ in 0..40 {
                    let place = Vec3::from_bits([0; 3].map(|_| bits(31 + spread - reach_bits)));
                    let size = Distance::from_bits(bits(32 - reach_bits).unsigned_abs() >> 4);
                    let Some(got) = view.place(&Particle::new(place, size, ())) else { continue };
                    seen += 1;
                    let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65_536.0);
                    let (p, e) = (numbers(place), numbers(eye));
                    let along =
                        |axis: [f64; 3]| -> f64 { (0..3).map(|i| axis[i] * (p[i] - e[i])).sum() };
                    let [x, y, z] = axes.map(along);
                    let unit = 16.0 * pixels(z);
                    // Half for rounding, and an eighth for arithmetic.
                    for (got, want) in got.middle().into_iter().zip([x, y]) {
                        assert!((f64::from(got) - want * unit).abs() < 0.625, "{got} {want}");
                    }
                    let size = size.to_num::<f64>();
                    let side = if is_in_pixels { 16.0 * size } else { unit * size };
                    let side = side.clamp(16.0, 32_768.0);
                    assert!((f64::from(got.side()) - side).abs() < 0.625, "{} {side}", got.side());
                    let got = f64::from(got.depth()) / 2f64.powi(32);
                    assert!((got - depth(z)).abs() < 2f64.powi(-25), "{got} {}", depth(z));
                }
            }
        }
        seen
    }

    #[test]
    fn particles_are_where_the_camera_sees_them() {
        let (near, far) = (Distance::lit("0.25"), Distance::lit("30000"));
        for (i, focal) in [40.0, 300.0, 5000.0].into_iter().enumerate() {
            let lens =
                Perspective::with_focal_length(Distance::from_num(focal), near, far).unwrap();
            for reach_bits in [17, 20, 28] {
                let (pixels, depth) = (|z| focal / z, |z| 0.25 / z);
                let seen = is_placed(lens, pixels, depth, [reach_bits, i as u32 + 1], i as u64);
                assert!(seen > 1000, "{focal} {reach_bits}: {seen}");
            }
        }
        let lens = Orthographic::new(Distance::lit("6"), near, far).unwrap();
        let depth = |z: f64| (30_000.0 - z) / 29_999.75;
        let seen = is_placed(lens, |_| 40.0, depth, [18, 0], 9);
        assert!(seen > 1000, "{seen}");
    }

    #[test]
    fn what_is_out_of_view_is_left_out() {
        let (near, far) = (Distance::lit("1"), Distance::lit("9"));
        let lens = Perspective::with_focal_length(Distance::from_num(100), near, far).unwrap();
        let eye = Vec3::lit("0", "0", "10");
        let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, VIEWPORT).unwrap();
        let view = ParticleView::new(&camera, false);
        let is_seen = |place, size: &str| {
            let size = size.parse().unwrap();
            view.place(&Particle::new(place, size, ())).is_some()
        };
        for (place, is_in) in [
            (Vec3::lit("0", "0", "8.99"), true),
            (Vec3::lit("0", "0", "9.01"), false),
            (Vec3::lit("0", "0", "1.01"), true),
            (Vec3::lit("0", "0", "0.99"), false),
            (Vec3::lit("0", "0", "11"), false),
            // Half the width is 1.605 focal lengths, and the particle a 20th of a unit.
            (Vec3::lit("3.24", "0", "8"), false),
            (Vec3::lit("3.23", "0", "8"), true),
            (Vec3::lit("-3.23", "0", "8"), true),
            (Vec3::lit("0", "2.45", "8"), false),
            (Vec3::lit("0", "-2.42", "8"), true),
        ] {
            assert_eq!(is_seen(place, "0.05"), is_in, "{place:?}");
        }
        assert!(!is_seen(Vec3::ZERO, "0"));
        assert_eq!(size_of::<ScreenParticle>(), 12);
    }
}
