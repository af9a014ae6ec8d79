//! A light at a point, which gets weaker with distance.

use super::{
    Illuminate, Level, Levels,
    place::Here,
    point::{Point, length},
    surface_point::SurfacePoint,
    viewer::Viewpoint,
};
use crate::{
    camera::Distance,
    geometry::ObjectView,
    numbers::{Direction, Float, Vec3, dot_q15, inverse_square},
};

/// Light from a point: at the distance d its level is
///
/// ```text
///   level / (1 + (d / half)^2)
/// ```
///
/// so that it is finite close to the lamp, half at the distance `half`, and falls off with the
/// square of the distance far away. It has no ambient light: add a [`Light`](super::Light) in a
/// tuple, `(Light::new(..), Lamp::new(..))`.
///
/// A level by Lambert's law is within 2<sup>-12</sup> of the definition on the tables as they are
/// rounded, at vertices that are farther from the lamp than a 2<sup>15</sup>th of the mesh's size.
/// A vertex at the lamp's own place is not lit by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Lamp {
    position: Vec3,
    half: Distance,
    level: Level,
    /// Where it is in object space.
    point: Point,
    /// The square of `half` in squares of the point's steps: from 2^30 to 2^32, or 0, and the
    /// exponent of its unit, which is even.
    square: u32,
    exponent: i32,
}

impl Lamp {
    /// A lamp at a place in the world that gives a surface beside it this level, and half of it at
    /// the distance `half`.
    #[must_use]
    pub const fn new(position: Vec3, half: Distance, level: Level) -> Self {
        Self { position, half, level, point: Point::ORIGIN, square: 0, exponent: 0 }
    }

    /// Its place in the world.
    #[must_use]
    pub const fn position(&self) -> Vec3 {
        self.position
    }

    /// The distance at which its level is half.
    #[must_use]
    pub const fn half(&self) -> Distance {
        self.half
    }

    /// The level of a surface beside it that faces it.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Its level at this distance, in Q15: below 2^16.
    #[inline(always)]
    fn attenuated(&self, distance: &Direction) -> u32 {
        // half^2 / (half^2 + d^2), both in the unit of the larger, and halved.
        let apart = self.exponent - distance.exponent;
        let [half, d] = [self.square >> 1, distance.square >> 1];
        let shifted = |value: u32, bits: i32| value.checked_shr(bits.cast_unsigned()).unwrap_or(0);
        let [half, d] =
            if apart >= 0 { [half, shifted(d, apart)] } else { [shifted(half, -apart), d] };
        let sum = half + d;
        let up = if sum >> 30 == 0 { 2 } else { 0 };
        // Q30: a part of at most 2^16 times 2^46 / sum.
        let part = ((((half << up) >> 15) + 1) >> 1) * inverse_square(sum << up);
        ((part >> 15).min(1 << 15) * u32::from(self.level.to_bits())) >> 15
    }
}

impl Illuminate for Lamp {
    type Beams = Self;
    type Place = Here;

    const COUNT: usize = 1;

    const NO_BEAMS: Self = Self::new(Vec3::ZERO, Distance::ZERO, Level::ZERO);

    fn for_view(&self, view: &ObjectView<'_>) -> Self {
        let (point, step) = Point::of(self.position, view);
        let half = length(Float::from_unsigned(self.half), view);
        let squared = half.times(half);
        // A mantissa of 31 bits becomes one of 32 with an even exponent.
        let exponent = squared.exponent - 2 * step;
        let odd = (exponent & 1).cast_unsigned();
        let square = squared.mantissa.cast_unsigned() << odd;
        Self { point, square, exponent: exponent - odd.cast_signed(), ..*self }
    }

    #[inline(always)]
    fn brightness(&self, normal: [i8; 3], position: [i16; 3]) -> u32 {
        let to_lamp = self.point.from(self.point.normalised(position));
        let cosine = dot_q15(&normal.map(i32::from), &to_lamp.unit).max(0) as u32;
        // 127 in Q15 is 128 127ths in Q22. Below 2^16, even for normals that are 1 % longer.
        let direct = ((cosine + (1 << 6)) >> 7) * self.attenuated(&to_lamp);
        // Q30 to Q28, and 128 / 127 = 1 + 1 / 128 + 1 / 128^2 + ..
        let quarter = direct >> 2;
        (quarter + (quarter >> 7) + (quarter >> 14)).min(1 << 28)
    }

    fn beams(&self, _: [i32; 3]) -> Self {
        *self
    }

    #[inline(always)]
    fn shine<V: Viewpoint>(lamp: &Self, point: &SurfacePoint<'_, V>, sum: &mut Levels) {
        let to_lamp = lamp.point.from(point.position);
        let level = lamp.attenuated(&to_lamp) >> 1;
        // Twice the length by the cosine, below 2^17, and below 2^15.
        sum.direct += (point.normal.along(&to_lamp.unit) * level) >> 15;
        if point.is_glossy() {
            point.add_highlight_of(&to_lamp.unit, level as i32, sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::super::scenes::{Scene, dot, f64s, minus, random_normal, unit_f64},
        *,
    };
    use crate::random::Random;

    #[test]
    fn levels_are_those_of_the_definition() {
        let mut random = Random::new(21);
        let mut lit = 0;
        for round in 0..20_000 {
            let scene = Scene::new(&mut random, round % 2 == 0);
            let normal = random_normal(&mut random);
            let world_normal = scene.turned(normal.map(|c| f64::from(c) / 127.0));
            let lamp = scene.lamp;
            scene.seen(|view| {
                let seen = lamp.for_view(view);
                for position in scene.positions {
                    let way = minus(f64s(lamp.position), scene.world(position));
                    let square = dot(way, way);
                    // Within 2^-15 of the mesh's size, positions are not told apart. The lamp's own
                    // numbers, and what they are computed from, have 31 bits.
                    let reach = scene.world(position).iter().fold(0f64, |m, c| m.max(c.abs()));
                    if square.sqrt() < scene.size() * 2f64.powi(-15) + reach * 2f64.powi(-14) {
                        continue;
                    }
                    let half = lamp.half().to_num::<f64>();
                    let level = lamp.level().to_num::<f64>() / (1.0 + square / (half * half));
                    let cosine = dot(world_normal, unit_f64(way)).max(0.0);
                    let want = (level * cosine).min(1.0);
                    let got = f64::from(seen.brightness(normal, position)) / 2f64.powi(28);
                    assert!((got - want).abs() < 2f64.powi(-12), "{round}: {got} {want}");
                    lit += usize::from(want > 0.01);
                }
            });
        }
        assert!(lit > 5_000, "{lit}");
    }
}
