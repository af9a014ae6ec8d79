//! How much of what is behind a colour it hides.

use fixed::types::U8F8;

/// Opacity in steps of 1/256: 0 is invisible, 256 opaque.
///
/// ```
/// use rasterizer::color::Alpha;
///
/// assert_eq!(Alpha::lit("0.5"), Alpha::HALF);
/// assert_eq!(Alpha::from_u8(255), Alpha::OPAQUE);
/// assert_eq!(Alpha::from_bits(300), Alpha::OPAQUE);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Alpha(u16);

impl Alpha {
    /// Invisible.
    pub const CLEAR: Self = Self(0);

    /// Half of both colours.
    pub const HALF: Self = Self(128);

    /// All of the new colour.
    pub const OPAQUE: Self = Self(256);

    /// Of units of 1/256, at most 256.
    #[inline(always)]
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        if bits < Self::OPAQUE.0 { Self(bits) } else { Self::OPAQUE }
    }

    /// Of units of 1/256, which are known to be at most 256.
    #[inline(always)]
    pub(crate) const fn of(bits: u16) -> Self {
        debug_assert!(bits <= Self::OPAQUE.0, "an alpha is at most 256");
        Self(bits)
    }

    /// Of eight bits, 255 of which are opaque: 127 and below stand for themselves, 128 and above
    /// for one unit more, within 1/256 of the 255th.
    #[inline(always)]
    #[must_use]
    pub const fn from_u8(bits: u8) -> Self {
        Self(bits as u16 + (bits >> 7) as u16)
    }

    /// Of a decimal fraction from 0 to 1, rounded to the nearest unit; larger ones are opaque.
    ///
    /// # Panics
    ///
    /// Panics if it is no number from 0 to 255: in a constant, that does not compile.
    #[must_use]
    pub const fn lit(decimal: &str) -> Self {
        Self::from_bits(U8F8::lit(decimal).to_bits())
    }

    /// The units of 1/256, 0 to 256.
    #[inline(always)]
    #[must_use]
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    /// Whether it is at least half: what an alpha test keeps.
    #[inline(always)]
    #[must_use]
    pub const fn is_half(self) -> bool {
        self.0 >= Self::HALF.0
    }

    /// Returns the product of both, rounded to the nearest unit.
    #[inline(always)]
    #[must_use]
    pub const fn scaled(self, by: Self) -> Self {
        Self(((self.0 as u32 * by.0 as u32 + 128) >> 8) as u16)
    }
}

impl Alpha {
    /// Mixes four: two side by side, and the two below them, at a place between their centres. The
    /// fractions of the way to the right and downwards have `bits` binary digits, 1 to 8. The
    /// result is rounded to the nearest.
    #[inline(always)]
    pub(crate) const fn mixed(alphas: [Self; 4], [right, down]: [u32; 2], bits: u32) -> Self {
        let [a, b, c, d] = alphas;
        // At most 2^24.
        let one = 1 << bits;
        let upper = a.0 as u32 * (one - right) + b.0 as u32 * right;
        let lower = c.0 as u32 * (one - right) + d.0 as u32 * right;
        let sum = upper * (one - down) + lower * down;
        Self(((sum + (1 << (2 * bits - 1))) >> (2 * bits)) as u16)
    }
}

/// Opaque.
impl Default for Alpha {
    fn default() -> Self {
        Self::OPAQUE
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn eight_bits_reach_both_ends() {
        assert_eq!([0, 127, 128, 255].map(|a| Alpha::from_u8(a).to_bits()), [0, 127, 129, 256]);
        for bits in 0..=255 {
            let exact = f64::from(bits) / 255.0 * 256.0;
            assert!((f64::from(Alpha::from_u8(bits).to_bits()) - exact).abs() < 0.502, "{bits}");
            assert_eq!(Alpha::from_u8(bits).is_half(), bits >= 128, "{bits}");
        }
    }

    #[test]
    fn products_are_rounded_to_the_nearest() {
        for a in 0..=256 {
            for b in 0..=256 {
                let exact = f64::from(a) * f64::from(b) / 256.0;
                let got = Alpha::from_bits(a).scaled(Alpha::from_bits(b));
                assert!((f64::from(got.to_bits()) - exact).abs() <= 0.5, "{a} {b}");
            }
        }
    }

    #[test]
    fn mixtures_are_rounded_to_the_nearest() {
        let mut random = Random::new(5);
        for round in 0..100_000 {
            let bits = 1 + round % 8;
            let alphas: [u16; 4] = core::array::from_fn(|_| random.within(0, 256) as u16);
            let fractions = [(); 2].map(|()| random.within(0, (1 << bits) - 1) as u32);
            let [a, b, c, d] = alphas.map(f64::from);
            let [right, down] = fractions.map(|f| f64::from(f) / f64::from(1 << bits));
            let exact = (a + (b - a) * right) * (1.0 - down) + (c + (d - c) * right) * down;
            let got = Alpha::mixed(alphas.map(Alpha::from_bits), fractions, bits);
            assert!((f64::from(got.to_bits()) - exact).abs() <= 0.5, "{alphas:?} {fractions:?}");
        }
        assert_eq!(Alpha::mixed([Alpha::OPAQUE; 4], [77, 255], 8), Alpha::OPAQUE);
    }

    #[test]
    fn more_than_opaque_is_opaque() {
        assert_eq!(Alpha::from_bits(u16::MAX), Alpha::OPAQUE);
        assert_eq!(Alpha::lit("2"), Alpha::OPAQUE);
        assert_eq!(Alpha::lit("0.25").to_bits(), 64);
        assert_eq!(Alpha::default(), Alpha::OPAQUE);
    }
}
