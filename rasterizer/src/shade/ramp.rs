//! The colours of a surface from dark to bright.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use fixed::types::U16F16;

/// `LEVELS` colours, looked up by brightness. `LEVELS` is a power of two.
///
/// One interpolated number per pixel gives all channels, and the colours can follow any course: a
/// surface in coloured light, the few steps of a cartoon, hot metal. 64 levels are as many as the
/// finest channel of RGB565 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ramp<C, const LEVELS: usize> {
    colors: [C; LEVELS],
}

impl<C: Copy, const LEVELS: usize> Ramp<C, LEVELS> {
    const INDEX_BITS: u32 = {
        assert!(
            LEVELS.is_power_of_two() && LEVELS >= 2 && LEVELS <= 1 << 15,
            "a ramp has a power of two of levels, 2 to 32,768"
        );
        LEVELS.trailing_zeros()
    };

    /// Calls `color` with each level, from 0 to `LEVELS` - 1.
    #[must_use]
    pub fn from_fn(color: impl FnMut(usize) -> C) -> Self {
        Self { colors: core::array::from_fn(color) }
    }

    /// Returns a brightness in Q16, 0 to 65,536, as the varying that [`at`](Self::at) takes.
    ///
    /// The nearest level of the ramp is the varying's upper bits: 0 and 65,536 lie in the middle of
    /// the first and the last level.
    #[inline(always)]
    #[must_use]
    pub const fn varying(level: u32) -> u16 {
        let half_step = 1 << (15 - Self::INDEX_BITS);
        (level - (level >> Self::INDEX_BITS) + half_step) as u16
    }

    /// Returns the colour for an interpolated varying.
    #[inline(always)]
    #[must_use]
    pub const fn at(&self, varying: U16F16) -> C {
        self.colors[(varying.to_bits() >> (32 - Self::INDEX_BITS)) as usize & (LEVELS - 1)]
    }

    /// Returns the colour nearest to a brightness in Q16, 0 to 65,536.
    #[inline(always)]
    #[must_use]
    pub fn nearest(&self, level: u32) -> C {
        self.at(U16F16::from_bits(u32::from(Self::varying(level)) << 16))
    }
}

impl<C: Copy + From<Rgb888>, const LEVELS: usize> Ramp<C, LEVELS> {
    /// From `dark` to `bright` in equal steps, each channel rounded to the nearest; with more than
    /// 256 levels within 3/4 of its step.
    #[must_use]
    // codegen: not inlined, because the loop over triangles needs its registers.
    #[inline(never)]
    pub fn between(dark: Rgb888, bright: Rgb888) -> Self {
        // 1 / last in Q24, within 2^-25. A channel is off by 255 last 2^-25 at most, and rounds
        // alike if that is less than 1 / 2 last: no level is nearer to the middle of two steps, as
        // `last` is odd.
        let step = const { ((1 << 24) + (LEVELS as i32 - 1) / 2) / (LEVELS as i32 - 1) };
        let channel = |from: u8, to: u8, level: usize| {
            let way = (i32::from(to) - i32::from(from)) * level as i32;
            // Products may wrap: the sum is between 0 and 2^32.
            let sum = (u32::from(from) << 24).wrapping_add(way.wrapping_mul(step) as u32);
            (sum.wrapping_add(1 << 23) >> 24) as u8
        };
        Self::from_fn(|level| {
            C::from(Rgb888::new(
                channel(dark.r(), bright.r(), level),
                channel(dark.g(), bright.g(), level),
                channel(dark.b(), bright.b(), level),
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, GrayColor, Rgb565};

    use super::*;

    #[test]
    fn every_level_is_met_in_its_middle() {
        let ramp = Ramp::<Gray8, 64>::from_fn(|level| Gray8::new(level as u8));
        for level in 0..64u32 {
            // Level k of 63, in Q16, rounded.
            let brightness = (level * 65_536 + 31) / 63;
            assert_eq!(ramp.nearest(brightness).luma(), level as u8);
            let margin = u32::from(Ramp::<Gray8, 64>::varying(brightness)) % 1024;
            assert!((500..=524).contains(&margin), "level {level} lies at {margin} of 1024");
        }
    }

    #[test]
    fn ends_are_exact() {
        let (dark, bright) = (Rgb888::new(8, 0, 0), Rgb888::new(255, 128, 1));
        let ramp = Ramp::<Rgb888, 256>::between(dark, bright);
        assert_eq!(ramp.nearest(0), dark);
        assert_eq!(ramp.nearest(65_536), bright);
        let ramp = Ramp::<Rgb565, 64>::between(Rgb888::BLACK, Rgb888::WHITE);
        assert_eq!(ramp.nearest(65_536), Rgb565::WHITE);
    }

    #[test]
    fn channels_are_rounded_to_the_nearest() {
        fn check<const LEVELS: usize>() {
            let last = LEVELS as i32 - 1;
            for from in (0..=255u8).step_by(5) {
                for to in 0..=255u8 {
                    let ramp = Ramp::<Rgb888, LEVELS>::between(
                        Rgb888::new(from, 0, 0),
                        Rgb888::new(to, 0, 0),
                    );
                    for (level, color) in ramp.colors.iter().enumerate() {
                        let level = level as i32;
                        let sum = i32::from(from) * (last - level) + i32::from(to) * level;
                        let twice_off = (2 * (i32::from(color.r()) * last - sum)).abs();
                        let is_near =
                            if LEVELS > 256 { 2 * twice_off < 3 * last } else { twice_off < last };
                        assert!(
                            is_near,
                            "level {level} of {LEVELS} from {from} to {to}: {}",
                            color.r()
                        );
                    }
                }
            }
        }
        check::<2>();
        check::<64>();
        check::<256>();
        check::<4096>();
    }

    #[test]
    fn any_varying_finds_a_color() {
        let ramp = Ramp::<Gray8, 2>::from_fn(|level| Gray8::new(level as u8));
        assert_eq!(ramp.at(U16F16::MAX).luma(), 1);
        assert_eq!(ramp.at(U16F16::ZERO).luma(), 0);
    }
}
