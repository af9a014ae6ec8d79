//! Colours mixed and lit, channel by channel, in the values that are stored.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor as _, IntoStorage,
    Rgb555, Rgb565, Rgb666, Rgb888, RgbColor as _, raw::RawU16,
};

use crate::color::Rgb332;

/// A colour of which textures can be filtered and lit: all of embedded-graphics, [`Rgb332`] and
/// [`Rgb565Be`](crate::output::Rgb565Be).
///
/// Colours of 15 and 16 bits are mixed in one word, between whose channels there is room for five
/// more bits; others channel by channel.
pub trait Mix: Copy {
    /// The binary digits of the fractions that [`mixed`](Self::mixed) takes, 1 to 8.
    const FRACTION_BITS: u32;

    /// Light comes in levels from 0 to 2<sup>`LIGHT_BITS`</sup>, which is full light; 1 to 8 bits.
    const LIGHT_BITS: u32;

    /// Mixes four colours: two side by side, and the two below them, at a place between their
    /// centres. The fractions of the way to the right and downwards are in units of
    /// 2<sup>-`FRACTION_BITS`</sup>, below 1. Each channel is rounded to the nearest; weights sum
    /// to one exactly, so that four equal colours give themselves.
    #[must_use]
    fn mixed(colors: [Self; 4], fractions: [u32; 2]) -> Self;

    /// Returns the colour in this light, each channel rounded to the nearest.
    #[must_use]
    fn lit(self, level: u32) -> Self;
}

/// The weights of four colours for fractions of `BITS` binary digits, which sum to
/// 2<sup>2 `BITS`</sup>.
#[inline(always)]
const fn exact_weights<const BITS: u32>([right, down]: [u32; 2]) -> [u32; 4] {
    let (both, right, down) = (right * down, right << BITS, down << BITS);
    [(1 << (2 * BITS)) + both - right - down, right - both, down - both, both]
}

/// A sum of channels times weights that sum to 2<sup>`BITS`</sup>, rounded to the nearest.
#[inline(always)]
const fn weighted<const BITS: u32>(channels: [u8; 4], weights: [u32; 4]) -> u8 {
    let [a, b, c, d] = channels;
    let [wa, wb, wc, wd] = weights;
    let sum = a as u32 * wa + b as u32 * wb + c as u32 * wc + d as u32 * wd;
    ((sum + (1 << (BITS - 1))) >> BITS) as u8
}

/// The binary digits of a fraction for colours that are mixed channel by channel.
const BITS: u32 = 8;

/// A channel times a level of 256, rounded to the nearest.
#[inline(always)]
const fn lit_channel(channel: u8, level: u32) -> u8 {
    ((channel as u32 * level + 128) >> 8) as u8
}

macro_rules! by_channels {
    ($($color:ident),*) => {
        $(impl Mix for $color {
            const FRACTION_BITS: u32 = BITS;
            const LIGHT_BITS: u32 = 8;

            #[inline(always)]
            fn mixed([a, b, c, d]: [Self; 4], fractions: [u32; 2]) -> Self {
                let weights = exact_weights::<BITS>(fractions);
                Self::new(
                    weighted::<{ 2 * BITS }>([a.r(), b.r(), c.r(), d.r()], weights),
                    weighted::<{ 2 * BITS }>([a.g(), b.g(), c.g(), d.g()], weights),
                    weighted::<{ 2 * BITS }>([a.b(), b.b(), c.b(), d.b()], weights),
                )
            }

            #[inline(always)]
            fn lit(self, level: u32) -> Self {
                Self::new(
                    lit_channel(self.r(), level),
                    lit_channel(self.g(), level),
                    lit_channel(self.b(), level),
                )
            }
        })*
    };
}

by_channels!(Rgb332, Rgb666, Rgb888, Bgr666, Bgr888);

macro_rules! by_luma {
    ($($color:ident),*) => {
        $(impl Mix for $color {
            const FRACTION_BITS: u32 = BITS;
            const LIGHT_BITS: u32 = 8;

            #[inline(always)]
            fn mixed(colors: [Self; 4], fractions: [u32; 2]) -> Self {
                let weights = exact_weights::<BITS>(fractions);
                Self::new(weighted::<{ 2 * BITS }>(colors.map(|color| color.luma()), weights))
            }

            #[inline(always)]
            fn lit(self, level: u32) -> Self {
                Self::new(lit_channel(self.luma(), level))
            }
        })*
    };
}

by_luma!(Gray2, Gray4, Gray8);

/// Channels of 5, 6 or 5 bits of a word of 16, spread over 32 so that each has room to be
/// multiplied by 32: the word twice, shifted to the right, without the bits between.
#[derive(Clone, Copy)]
pub(crate) struct Spread {
    /// By how many bits it is shifted.
    shift: u32,
    /// The channels, spread.
    mask: u32,
    /// Half of 32 in each channel.
    half: u32,
}

impl Spread {
    /// Five, six and five bits.
    pub(crate) const OF_565: Self = Self { shift: 0, mask: 0x07E0_F81F, half: 0x0200_8010 };

    /// The same with the bytes swapped. The lower three of the six bits are the word's highest, the
    /// upper three its lowest: they are side by side where the two copies of the word meet.
    pub(crate) const OF_SWAPPED_565: Self = Self { shift: 3, mask: 0x03E0_FC1F, half: 0x0200_4010 };

    /// Three times five bits.
    const OF_555: Self = Self { shift: 0, mask: 0x03E0_7C1F, half: 0x0200_4010 };

    // codegen: by a product, which compilers compute by one shifted addition; of two shifts they
    // mask each.
    #[inline(always)]
    const fn spread(self, bits: u16) -> u32 {
        (bits as u32 * 0x1_0001) >> self.shift & self.mask
    }

    /// The channels of sums with five digits behind the point, which are cut off.
    #[inline(always)]
    const fn joined(self, sums: u32) -> u16 {
        let channels = (sums >> 5) & self.mask;
        (channels << self.shift | channels >> (16 - self.shift)) as u16
    }

    /// With r and d for fractions to the right and downwards of 4 binary digits and w = r d / 8,
    /// rounded, the weights of 32 are
    ///
    /// ```text
    ///   32 - 2 r - 2 d + w,  2 r - w,  2 d - w,  w
    /// ```
    ///
    /// They sum to 32, are within half a unit of the exact ones, and none is negative: w is at most
    /// twice the lesser fraction, and at least twice their sum less 32. The sum is computed with
    /// differences of colours, modulo 2<sup>32</sup>; what they borrow between channels cancels.
    #[inline(always)]
    pub(crate) const fn mixed(self, [a, b, c, d]: [u16; 4], [right, down]: [u32; 2]) -> u16 {
        let both = (right * down + 4) >> 3;
        let (a, b, c, d) = (self.spread(a), self.spread(b), self.spread(c), self.spread(d));
        let across = b.wrapping_sub(a);
        let bend = d.wrapping_sub(c).wrapping_sub(across);
        let half_sum = ((a << 4) + self.half / 2)
            .wrapping_add(across.wrapping_mul(right))
            .wrapping_add(c.wrapping_sub(a).wrapping_mul(down));
        self.joined((half_sum << 1).wrapping_add(bend.wrapping_mul(both)))
    }

    #[inline(always)]
    pub(crate) const fn lit(self, bits: u16, level: u32) -> u16 {
        self.joined(self.spread(bits) * level + self.half)
    }
}

macro_rules! by_words {
    ($($color:ident: $spread:expr),*) => {
        $(impl Mix for $color {
            const FRACTION_BITS: u32 = 4;
            const LIGHT_BITS: u32 = 5;

            #[inline(always)]
            fn mixed(colors: [Self; 4], fractions: [u32; 2]) -> Self {
                let bits = colors.map(|color| color.into_storage());
                RawU16::new($spread.mixed(bits, fractions)).into()
            }

            #[inline(always)]
            fn lit(self, level: u32) -> Self {
                RawU16::new($spread.lit(self.into_storage(), level)).into()
            }
        })*
    };
}

by_words!(
    Rgb565: Spread::OF_565,
    Bgr565: Spread::OF_565,
    Rgb555: Spread::OF_555,
    Bgr555: Spread::OF_555
);

/// On where at least half of the weight is, and in at least half of the light.
impl Mix for BinaryColor {
    const FRACTION_BITS: u32 = BITS;
    const LIGHT_BITS: u32 = 8;

    #[inline(always)]
    fn mixed(colors: [Self; 4], fractions: [u32; 2]) -> Self {
        let weights = exact_weights::<BITS>(fractions);
        let channels = colors.map(|color| u8::from(color.is_on()));
        Self::from(weighted::<{ 2 * BITS }>(channels, weights) != 0)
    }

    #[inline(always)]
    fn lit(self, level: u32) -> Self {
        Self::from(self.is_on() && level >= 128)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{output::Rgb565Be, random::Random};

    fn all_fractions(bits: u32) -> impl Iterator<Item = [u32; 2]> {
        (0..1 << bits).flat_map(move |right| (0..1 << bits).map(move |down| [right, down]))
    }

    /// The weights of four colours of 15 and 16 bits, by their definition.
    fn short_weights([right, down]: [u32; 2]) -> [u32; 4] {
        let both = (right * down + 4) / 8;
        [32 + both - 2 * right - 2 * down, 2 * right - both, 2 * down - both, both]
    }

    #[test]
    fn weights_sum_to_one_and_are_near_the_exact_ones() {
        for fractions in all_fractions(4) {
            let [right, down] = fractions.map(|f| f64::from(f) / 16.0);
            let exact = [
                (1.0 - right) * (1.0 - down),
                right * (1.0 - down),
                (1.0 - right) * down,
                right * down,
            ];
            let short = short_weights(fractions);
            assert_eq!(short.iter().sum::<u32>(), 32, "{fractions:?}");
            for (short, exact) in short.into_iter().zip(exact) {
                assert!((f64::from(short) - 32.0 * exact).abs() <= 0.5, "{fractions:?}");
            }
        }
        for fractions in all_fractions(8) {
            let weights = exact_weights::<8>(fractions);
            assert_eq!(weights.iter().sum::<u32>(), 1 << 16, "{fractions:?}");
            assert_eq!(weights[3], fractions[0] * fractions[1]);
            assert_eq!(weights[0], (256 - fractions[0]) * (256 - fractions[1]));
        }
    }

    /// Every colour of 16 bits with all fractions, others with some.
    #[test]
    fn equal_colors_give_themselves() {
        fn check<C: Mix + PartialEq + core::fmt::Debug>(color: C) {
            for fractions in all_fractions(C::FRACTION_BITS.min(4)) {
                let up = C::FRACTION_BITS - C::FRACTION_BITS.min(4);
                let fractions = fractions.map(|f| f << up | f >> (4 - up));
                assert_eq!(C::mixed([color; 4], fractions), color, "{fractions:?}");
            }
            assert_eq!(color.lit(1 << C::LIGHT_BITS), color);
        }
        for bits in 0..=u16::MAX {
            check(Rgb565::from(RawU16::new(bits)));
        }
        for bits in (0..=u16::MAX).step_by(37) {
            check(Rgb565Be::from(RawU16::new(bits)));
            check(Bgr565::from(RawU16::new(bits)));
            check(Rgb555::from(RawU16::new(bits)));
            check(Bgr555::from(RawU16::new(bits)));
        }
        for value in 0..=255 {
            check(Gray8::new(value));
            check(Gray4::new(value));
            check(Gray2::new(value));
            check(Rgb888::new(value, 255 - value, value / 3));
            check(Bgr888::new(value, 255 - value, value / 3));
            check(Rgb666::new(value, 255 - value, value / 3));
            check(Rgb332::new(value >> 5, value >> 2, value));
        }
        check(BinaryColor::On);
        check(BinaryColor::Off);
    }

    #[test]
    fn a_constant_gray_stays_for_all_fractions() {
        for value in [0, 1, 127, 128, 254, 255] {
            for fractions in all_fractions(8) {
                let mixed = Gray8::mixed([Gray8::new(value); 4], fractions);
                assert_eq!(mixed.luma(), value, "{fractions:?}");
            }
        }
    }

    /// Every channel is the exact weighted mean of the short weights, rounded; no channel runs into
    /// another.
    #[test]
    fn channels_are_mixed_apart() {
        let mut random = Random::new(3);
        for _ in 0..100_000 {
            let bits = random.bits();
            let colors: [Rgb565; 4] =
                core::array::from_fn(|i| RawU16::new((bits >> (16 * i)) as u16).into());
            let fractions = [(bits >> 5) as u32 & 15, (bits >> 40) as u32 & 15];
            let weights = short_weights(fractions);
            let mixed = Rgb565::mixed(colors, fractions);
            let mean = |channel: fn(&Rgb565) -> u8| {
                let sum: u32 =
                    colors.iter().zip(weights).map(|(c, w)| u32::from(channel(c)) * w).sum();
                ((sum + 16) >> 5) as u8
            };
            let wanted = Rgb565::new(mean(Rgb565::r), mean(Rgb565::g), mean(Rgb565::b));
            assert_eq!(mixed, wanted);
            // By another way: other channel orders and the bus's byte order.
            let swapped = Rgb565Be::mixed(colors.map(Rgb565Be::from), fractions);
            assert_eq!(Rgb565::from(swapped), wanted);
            let other = Bgr565::mixed(colors.map(|c| Bgr565::new(c.r(), c.g(), c.b())), fractions);
            assert_eq!([other.r(), other.g(), other.b()], [wanted.r(), wanted.g(), wanted.b()]);
            let few = colors.map(|c| Rgb555::new(c.r(), c.b(), c.r() ^ 21));
            let few_mixed = Rgb555::mixed(few, fractions);
            assert_eq!([few_mixed.r(), few_mixed.g()], [wanted.r(), wanted.b()]);
        }
    }

    /// Within half a step of the channel for the exact weights of the fractions.
    #[test]
    fn wide_channels_are_rounded_to_the_nearest() {
        let mut random = Random::new(4);
        for _ in 0..100_000 {
            let bits = random.bits();
            let [a, b, c, d] = (bits as u32).to_le_bytes();
            let fractions = [(bits >> 32) as u32 & 255, (bits >> 40) as u32 & 255];
            let [right, down] = fractions.map(|f| f64::from(f) / 256.0);
            let [fa, fb, fc, fd] = [a, b, c, d].map(f64::from);
            let exact = (fa + (fb - fa) * right) * (1.0 - down) + (fc + (fd - fc) * right) * down;
            let gray = Gray8::mixed([a, b, c, d].map(Gray8::new), fractions);
            assert!((f64::from(gray.luma()) - exact).abs() <= 0.5);
            let colors = [a, b, c, d].map(|value| Rgb888::new(7, value, 255 - value));
            let color = Rgb888::mixed(colors, fractions);
            assert_eq!([color.r(), color.g()], [7, gray.luma()]);
            assert!((f64::from(color.b()) - (255.0 - exact)).abs() <= 0.5);
        }
    }

    #[test]
    fn light_is_rounded_to_the_nearest_in_each_channel() {
        for bits in 0..=u16::MAX {
            let color = Rgb565::from(RawU16::new(bits));
            for level in [0, 1, 2, 3, 7, 15, 16, 17, 29, 31, 32] {
                let channel = |full: u8| ((u32::from(full) * level + 16) / 32) as u8;
                let wanted =
                    Rgb565::new(channel(color.r()), channel(color.g()), channel(color.b()));
                assert_eq!(color.lit(level), wanted, "{color:?} at {level}");
                assert_eq!(Rgb565::from(Rgb565Be::from(color).lit(level)), wanted);
            }
        }
        for level in 0..=256 {
            for value in 0..=255u8 {
                let exact = f64::from(value) * f64::from(level) / 256.0;
                let color = Rgb888::new(value, 0, 255).lit(level);
                assert!((f64::from(color.r()) - exact).abs() <= 0.5, "{value} at {level}");
                assert_eq!(Gray8::new(value).lit(level).luma(), color.r());
            }
        }
        assert_eq!(BinaryColor::On.lit(127), BinaryColor::Off);
        assert_eq!(BinaryColor::On.lit(128), BinaryColor::On);
    }
}
