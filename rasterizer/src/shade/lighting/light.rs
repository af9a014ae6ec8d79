//! A directional light with ambient light.

use fixed::types::U1F15;

use super::{
    Illuminate, Levels,
    place::Anywhere,
    surface_point::{SurfacePoint, half},
    viewer::Viewpoint,
};
use crate::{
    geometry::{ObjectView, Pose},
    numbers::{Vec3, mul_q30, unit},
};

/// A brightness: Q1.15, where 1 is full.
pub type Level = U1F15;

/// Light from one direction, and light from everywhere.
///
/// A surface with the unit normal n is lit at `ambient + diffuse * max(0, n . toward)`, at most 1
/// (Lambert's law).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Light {
    /// The direction towards the light, of length one, in Q30.
    toward: [i32; 3],
    /// The same times the gain, in Q28: the factors of a normal.
    factors: [i32; 3],
    ambient: Level,
    diffuse: Level,
    /// `diffuse` / 127 in Q28, rounded down. Computed here, so that no object divides.
    gain: i32,
}

impl Light {
    /// Light from the direction of `toward`, seen from the origin; a zero vector gives ambient
    /// light only.
    #[must_use]
    pub const fn new(toward: Vec3, ambient: Level, diffuse: Level) -> Self {
        let [x, y, z] = toward.to_bits();
        let toward = match unit([x as i64, y as i64, z as i64]) {
            Some(toward) => toward,
            None => [0; 3],
        };
        let gain = (((diffuse.to_bits() as u32) << 13) / 127) as i32;
        Self { toward, factors: factors(toward, gain), ambient, diffuse, gain }
    }

    /// Returns the light in the object space of this pose.
    #[must_use]
    pub fn for_object(&self, pose: &Pose) -> Self {
        let toward = pose.rotation.turn_back(&self.toward);
        Self { toward, factors: factors(toward, self.gain), ..*self }
    }

    /// Returns the brightness of a surface with this normal in object space, 127 standing for 1:
    /// Q16, from 0 to 65,536. It is within 2<sup>-13</sup> for the normal and the direction as they
    /// are rounded.
    #[inline(always)]
    #[must_use]
    pub fn level(&self, normal: [i8; 3]) -> u32 {
        self.brightness(normal, [0; 3]) >> 12
    }

    /// The direction towards the light in Q30.
    #[must_use]
    pub const fn toward(&self) -> [i32; 3] {
        self.toward
    }

    /// The level of surfaces that face away.
    #[must_use]
    pub const fn ambient(&self) -> Level {
        self.ambient
    }

    /// What is added to the ambient level on a surface that faces the light.
    #[must_use]
    pub const fn diffuse(&self) -> Level {
        self.diffuse
    }
}

/// A [`Light`] as pixels need it.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// The direction towards it, in Q15: for near viewers.
    toward: [i32; 3],
    /// The same times the level, below 2, in Q14.
    factors: [i32; 3],
    /// The direction halfway between that and the one towards a far viewer, in Q15.
    half: [i32; 3],
    /// In Q16.
    ambient: u32,
    /// In Q14.
    level: i32,
}

impl Illuminate for Light {
    type Beams = Beam;
    type Place = Anywhere;

    const COUNT: usize = 1;

    const NO_BEAMS: Beam =
        Beam { toward: [0; 3], factors: [0; 3], half: [0; 3], ambient: 0, level: 0 };

    #[inline(always)]
    fn for_view(&self, view: &ObjectView<'_>) -> Self {
        self.for_object(view.pose())
    }

    #[inline(always)]
    fn brightness(&self, [x, y, z]: [i8; 3], _: [i16; 3]) -> u32 {
        let [lx, ly, lz] = self.factors;
        // Both are below 2 and so below 2^29, even for normals that rounding made 1 % longer.
        let direct = (i32::from(x) * lx + i32::from(y) * ly + i32::from(z) * lz).max(0) as u32;
        let level = (u32::from(self.ambient.to_bits()) << 13) + direct;
        level.min(1 << 28)
    }

    fn beams(&self, viewer: [i32; 3]) -> Beam {
        let toward = self.toward.map(|c| (c + (1 << 14)) >> 15);
        let level = i32::from(self.diffuse.to_bits());
        Beam {
            toward,
            factors: toward.map(|c| (((c * level) >> 15) + 1) >> 1),
            half: half(&toward, &viewer),
            ambient: u32::from(self.ambient.to_bits()) << 1,
            level: level >> 1,
        }
    }

    #[inline(always)]
    fn shine<V: Viewpoint>(beam: &Beam, point: &SurfacePoint<'_, V>, sum: &mut Levels) {
        sum.ambient += beam.ambient;
        sum.direct += point.normal.along(&beam.factors);
        if point.is_glossy() {
            if V::IS_NEAR {
                point.add_highlight_of(&beam.toward, beam.level, sum);
            } else {
                point.add_highlight(&beam.half, beam.level, sum);
            }
        }
    }
}

/// Q30 x Q28 to Q28.
const fn factors(toward: [i32; 3], gain: i32) -> [i32; 3] {
    let (mut factors, mut axis) = (toward, 0);
    while axis < 3 {
        factors[axis] = mul_q30(gain, toward[axis]);
        axis += 1;
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::{Rotation, Turn};

    const AMBIENT: Level = Level::lit("0.25");
    const DIFFUSE: Level = Level::lit("0.75");

    #[test]
    fn levels_follow_lamberts_law() {
        let light = Light::new(Vec3::lit("1", "2", "2"), AMBIENT, DIFFUSE);
        for normal in [
            [127, 0, 0],
            [0, 127, 0],
            [0, 0, 127],
            [42, 85, 85],
            [-42, -85, -85],
            [-127, 0, 0],
            [73, 73, 73],
        ] {
            let [x, y, z] = normal.map(|c: i8| f64::from(c) / 127.0);
            let want = (0.25 + 0.75 * ((x + 2.0 * y + 2.0 * z) / 3.0).max(0.0)).min(1.0);
            let got = f64::from(light.level(normal)) / 65536.0;
            assert!((got - want).abs() < 2f64.powi(-13), "{normal:?}: {got} {want}");
        }
    }

    #[test]
    fn full_light_saturates_and_none_is_dark() {
        let bright = Light::new(Vec3::Y, Level::ONE, Level::MAX);
        assert_eq!(bright.level([0, 127, 0]), 65_536);
        assert_eq!(bright.level([127, 127, 127]), 65_536);
        let dark = Light::new(Vec3::ZERO, Level::ZERO, Level::ONE);
        assert_eq!(dark.level([0, 127, 0]), 0);
    }

    #[test]
    fn turning_the_object_turns_the_light_back() {
        let light = Light::new(Vec3::X, AMBIENT, DIFFUSE);
        // A quarter turn about y takes z to x: the side that was +z now faces the light.
        let pose = Pose::rotated(Rotation::about_y(Turn::QUARTER));
        assert_eq!(light.for_object(&pose).level([0, 0, 127]), light.level([127, 0, 0]));
    }
}
