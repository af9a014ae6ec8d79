//! A colour over another: its share of the result, added, multiplied, or screened.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, Gray2, Gray4, Gray8, GrayColor as _, IntoStorage, Rgb555,
    Rgb565, Rgb666, Rgb888, RgbColor as _, raw::RawU16,
};

use super::{Alpha, Rgb332};
use crate::numbers::IS_NARROW;

/// A colour that can be put over another one: all of embedded-graphics but `BinaryColor`,
/// [`Rgb332`] and [`Rgb565Be`](crate::output::Rgb565Be).
///
/// Each channel is computed in the values that are stored, and rounded to the nearest once. With
/// the stored value s, the new one n, both from 0 to max, and the alpha a from 0 to 1:
///
/// | method | result |
/// |---|---|
/// | [`over`](Self::over) | s + (n - s) a |
/// | [`add`](Self::add) | s + n a, at most max |
/// | [`multiply`](Self::multiply) | s (1 - a (1 - n / max)) |
/// | [`screen`](Self::screen) | s + a n (1 - s / max) |
///
/// These are "normal", "plus" (its colour, which the alpha scales), "multiply" and "screen" of
/// the W3C's Compositing and Blending Level 1, on an opaque background.
///
/// Colours of 15 and 16 bits are computed two channels in a word where that gives the same bits:
/// `over` and `add` take two multiplications, the others six.
#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be blended with another colour",
    label = "its colours cannot be mixed",
    note = "a pixel of `BinaryColor` is on or off: it takes `Replace`, and a shader or texels that \
            discard pixels",
    note = "to blend for such a display, draw in `Gray8` or `Rgb888`, and dither what is sent"
)]
pub trait Composite: Copy {
    /// Returns this colour over the stored one, which it hides by its alpha.
    #[must_use]
    fn over(self, stored: Self, alpha: Alpha) -> Self;

    /// Returns the sum of the stored colour and this one times its alpha, as light adds to light.
    #[must_use]
    fn add(self, stored: Self, alpha: Alpha) -> Self;

    /// Returns the stored colour seen through a filter of this one: white changes nothing.
    #[must_use]
    fn multiply(self, stored: Self, alpha: Alpha) -> Self;

    /// Returns the stored colour lit by this one, which has less effect the brighter that is: black
    /// changes nothing.
    #[must_use]
    fn screen(self, stored: Self, alpha: Alpha) -> Self;
}

/// A channel of `BITS` bits, two to eight: the formulas times 256, or 256 times the most, in whole
/// numbers.
struct Channel<const BITS: u32>;

impl<const BITS: u32> Channel<BITS> {
    const MOST: u32 = (1 << BITS) - 1;

    #[inline(always)]
    const fn over(stored: u8, new: u8, alpha: Alpha) -> u8 {
        let alpha = alpha.to_bits() as u32;
        ((stored as u32 * (256 - alpha) + new as u32 * alpha + 128) >> 8) as u8
    }

    #[inline(always)]
    const fn add(stored: u8, new: u8, alpha: Alpha) -> u8 {
        let sum = stored as u32 + ((new as u32 * alpha.to_bits() as u32 + 128) >> 8);
        (if sum < Self::MOST { sum } else { Self::MOST }) as u8
    }

    #[inline(always)]
    const fn multiply(stored: u8, new: u8, alpha: Alpha) -> u8 {
        let part = 256 * Self::MOST - alpha.to_bits() as u32 * (Self::MOST - new as u32);
        Self::nearest(stored as u32 * part) as u8
    }

    #[inline(always)]
    const fn screen(stored: u8, new: u8, alpha: Alpha) -> u8 {
        let light = alpha.to_bits() as u32 * new as u32;
        (stored as u32 + Self::nearest((Self::MOST - stored as u32) * light)) as u8
    }

    /// Returns a number of up to 256 m² divided by 256 m, rounded to the nearest, for m =
    /// 2<sup>`BITS`</sup> - 1.
    ///
    /// ⌊y / m⌋ = ⌊(y + 1 + ⌊y / 2^`BITS`⌋) / 2^`BITS`⌋ for y below 2^(2 `BITS`) - 1; y is
    /// at most m² + m / 2 here.
    #[inline(always)]
    const fn nearest(number: u32) -> u32 {
        let wholes = (number + 128 * Self::MOST) >> 8;
        (wholes + 1 + (wholes >> BITS)) >> BITS
    }
}

macro_rules! by_channels {
    ($($color:ident: [$red:literal, $green:literal, $blue:literal]),*) => {
        $(impl Composite for $color {
            by_channels!(over $red $green $blue);
            by_channels!(add $red $green $blue);
            by_channels!(multiply $red $green $blue);
            by_channels!(screen $red $green $blue);
        })*
    };
    ($mode:ident $red:literal $green:literal $blue:literal) => {
        #[inline(always)]
        fn $mode(self, stored: Self, alpha: Alpha) -> Self {
            Self::new(
                Channel::<$red>::$mode(stored.r(), self.r(), alpha),
                Channel::<$green>::$mode(stored.g(), self.g(), alpha),
                Channel::<$blue>::$mode(stored.b(), self.b(), alpha),
            )
        }
    };
}

by_channels!(Rgb332: [3, 3, 2], Rgb666: [6, 6, 6], Rgb888: [8, 8, 8], Bgr666: [6, 6, 6], Bgr888: [8, 8, 8]);

macro_rules! by_luma {
    ($($color:ident: $bits:literal),*) => {
        $(impl Composite for $color {
            by_luma!(over $bits);
            by_luma!(add $bits);
            by_luma!(multiply $bits);
            by_luma!(screen $bits);
        })*
    };
    ($mode:ident $bits:literal) => {
        #[inline(always)]
        fn $mode(self, stored: Self, alpha: Alpha) -> Self {
            Self::new(Channel::<$bits>::$mode(stored.luma(), self.luma(), alpha))
        }
    };
}

by_luma!(Gray2: 2, Gray4: 4, Gray8: 8);

/// A word of three channels: five bits, `MIDDLE`, and five.
///
/// The two outer ones are spread over a word of 32 bits, from bit 0 and from bit 16 on, with 11
/// bits of room above each for a product with an alpha. Products have eight bits more, and are cut
/// off where they are joined.
// codegen: the colour's lower channel is the upper one where shifts are part of other
// instructions. It saves 4 instructions a pixel of `sphere-over` on the Cortex-M4, and would cost 3
// on the M0+.
struct Word<const MIDDLE: u32>;

impl<const MIDDLE: u32> Word<MIDDLE> {
    /// By how much the upper channel moves to have its place from bit 16 on.
    const SPREAD: u32 = 16 - 5 - MIDDLE;
    const OUTER: u32 = 0x1F_001F;
    const HALVES: u32 = 0x80_0080;
    const CARRIES: u32 = 0x20_0020;

    #[inline(always)]
    const fn outer(bits: u16) -> u32 {
        let bits = bits as u32;
        if IS_NARROW {
            (bits | bits << Self::SPREAD) & Self::OUTER
        } else {
            (bits & 0x1F) << 16 | bits << (16 + Self::SPREAD - 5) >> 27
        }
    }

    #[inline(always)]
    const fn middle(bits: u16) -> u32 {
        (bits >> 5) as u32 & Channel::<MIDDLE>::MOST
    }

    /// From products times 256. What is below 256 is left out.
    #[inline(always)]
    const fn joined(outer: u32, middle: u32) -> u16 {
        if IS_NARROW {
            let outer = outer >> 8 & Self::OUTER;
            (outer | outer >> Self::SPREAD | (middle >> 8) << 5) as u16
        } else {
            let (outer, middle) = (outer & Self::OUTER << 8, middle & Channel::<MIDDLE>::MOST << 8);
            // The lower channel leaves the word where the upper one is moved to its place.
            ((outer >> 8 | outer << (24 - Self::SPREAD) | middle << 13) >> 16) as u16
        }
    }

    /// What the outer channels borrow from each other in the difference is given back with the
    /// product, modulo 2<sup>32</sup>.
    #[inline(always)]
    const fn over(stored: u16, new: u16, alpha: Alpha) -> u16 {
        let alpha = alpha.to_bits() as u32;
        let (from, to) = (Self::outer(stored), Self::outer(new));
        let outer = (from << 8).wrapping_add(to.wrapping_sub(from).wrapping_mul(alpha));
        let (from, to) = (Self::middle(stored), Self::middle(new));
        let middle = (from << 8).wrapping_add(to.wrapping_sub(from).wrapping_mul(alpha));
        Self::joined(outer.wrapping_add(Self::HALVES), middle + 128)
    }

    #[inline(always)]
    const fn add(stored: u16, new: u16, alpha: Alpha) -> u16 {
        let factor = alpha.to_bits() as u32;
        let light = (Self::outer(new) * factor + Self::HALVES) >> 8 & Self::OUTER;
        let sums = Self::outer(stored) + light;
        // The sixth bit of a sum sets the five below it.
        let carries = sums & Self::CARRIES;
        let outer = (sums | (carries - (carries >> 5))) << 8;
        let middle = Self::middle(stored) as u8;
        let middle = Channel::<MIDDLE>::add(middle, Self::middle(new) as u8, alpha);
        Self::joined(outer, (middle as u32) << 8)
    }

    #[inline(always)]
    const fn multiply(stored: u16, new: u16, alpha: Alpha) -> u16 {
        let [low, middle, high] = Self::channels(stored);
        let [new_low, new_middle, new_high] = Self::channels(new);
        Self::of_channels([
            Channel::<5>::multiply(low, new_low, alpha),
            Channel::<MIDDLE>::multiply(middle, new_middle, alpha),
            Channel::<5>::multiply(high, new_high, alpha),
        ])
    }

    #[inline(always)]
    const fn screen(stored: u16, new: u16, alpha: Alpha) -> u16 {
        let [low, middle, high] = Self::channels(stored);
        let [new_low, new_middle, new_high] = Self::channels(new);
        Self::of_channels([
            Channel::<5>::screen(low, new_low, alpha),
            Channel::<MIDDLE>::screen(middle, new_middle, alpha),
            Channel::<5>::screen(high, new_high, alpha),
        ])
    }

    #[inline(always)]
    const fn channels(bits: u16) -> [u8; 3] {
        let mask = Channel::<5>::MOST as u16;
        [(bits & mask) as u8, Self::middle(bits) as u8, (bits >> (5 + MIDDLE) & mask) as u8]
    }

    #[inline(always)]
    const fn of_channels([low, middle, high]: [u8; 3]) -> u16 {
        (high as u16) << (5 + MIDDLE) | (middle as u16) << 5 | low as u16
    }
}

macro_rules! by_words {
    ($($color:ident: $middle:literal),*) => {
        $(impl Composite for $color {
            by_words!(over $middle);
            by_words!(add $middle);
            by_words!(multiply $middle);
            by_words!(screen $middle);
        })*
    };
    ($mode:ident $middle:literal) => {
        #[inline(always)]
        fn $mode(self, stored: Self, alpha: Alpha) -> Self {
            let (stored, new) = (stored.into_storage(), self.into_storage());
            RawU16::new(Word::<$middle>::$mode(stored, new, alpha)).into()
        }
    };
}

by_words!(Rgb565: 6, Bgr565: 6, Rgb555: 5, Bgr555: 5);

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::PixelColor;

    use super::*;
    use crate::{output::Rgb565Be, random::Random};

    /// The definitions: of the stored channel, the new one, and the alpha, all from 0 to 1.
    const DEFINITIONS: [fn(f64, f64, f64) -> f64; 4] = [
        |s, n, a| s + (n - s) * a,
        |s, n, a| (s + n * a).min(1.0),
        |s, n, a| s * (1.0 - a * (1.0 - n)),
        |s, n, a| s + a * n * (1.0 - s),
    ];

    /// Far above the rounding of f64, far below the distance of a result from the next half.
    const ROUNDING: f64 = 1e-9;

    /// Checks a channel of up to `most` by the number of its mode.
    fn check(mode: usize, [stored, new, got]: [u8; 3], most: u8, alpha: Alpha) {
        let [s, n] = [stored, new].map(|channel| f64::from(channel) / f64::from(most));
        let a = f64::from(alpha.to_bits()) / 256.0;
        let exact = DEFINITIONS[mode](s, n, a) * f64::from(most);
        assert!(
            (f64::from(got) - exact).abs() <= 0.5 + ROUNDING,
            "mode {mode}: {stored} and {new} of {most} by {alpha:?}: {got}, not {exact}"
        );
    }

    /// Every value of both channels; every alpha, or with eight bits those near both ends, near the
    /// middle, and every 15th.
    #[test]
    fn every_channel_is_rounded_to_the_nearest() {
        fn check_all<const BITS: u32>() {
            let most = Channel::<BITS>::MOST as u8;
            for alpha in 0..=256 {
                if BITS == 8 && alpha % 15 != 0 && ![1, 2, 127, 128, 129, 254, 256].contains(&alpha)
                {
                    continue;
                }
                let alpha = Alpha::from_bits(alpha);
                for stored in 0..=most {
                    for new in 0..=most {
                        let got = [
                            Channel::<BITS>::over(stored, new, alpha),
                            Channel::<BITS>::add(stored, new, alpha),
                            Channel::<BITS>::multiply(stored, new, alpha),
                            Channel::<BITS>::screen(stored, new, alpha),
                        ];
                        for (mode, got) in got.into_iter().enumerate() {
                            check(mode, [stored, new, got], most, alpha);
                        }
                    }
                }
            }
        }
        check_all::<2>();
        check_all::<3>();
        check_all::<4>();
        check_all::<5>();
        check_all::<6>();
        check_all::<8>();
    }

    fn results<C: Composite>(stored: C, new: C, alpha: Alpha) -> [C; 4] {
        [
            new.over(stored, alpha),
            new.add(stored, alpha),
            new.multiply(stored, alpha),
            new.screen(stored, alpha),
        ]
    }

    /// Random colours of a type with these channels and the most of each.
    fn check_type<C: Composite + PixelColor, const N: usize>(
        color: fn(&mut Random) -> C,
        channels: fn(C) -> [u8; N],
        most: [u8; N],
    ) {
        let mut random = Random::new(12);
        for _ in 0..20_000 {
            let [stored, new] = [color(&mut random), color(&mut random)];
            let alpha = Alpha::from_bits(random.within(0, 256) as u16);
            for (mode, got) in results(stored, new, alpha).into_iter().enumerate() {
                let parts = channels(stored).into_iter().zip(channels(new)).zip(channels(got));
                for (((stored, new), got), most) in parts.zip(most) {
                    check(mode, [stored, new, got], most, alpha);
                }
            }
            let both = [stored, new];
            assert!(results(both[0], both[1], Alpha::CLEAR) == [stored; 4]);
            assert!(new.over(stored, Alpha::OPAQUE) == new);
        }
    }

    macro_rules! check_types {
        ($($color:ident),*) => {
            $(check_type(
                |random| {
                    let [r, g, b, ..] = random.bits().to_le_bytes();
                    $color::new(r, g, b)
                },
                |color| [color.r(), color.g(), color.b()],
                [$color::MAX_R, $color::MAX_G, $color::MAX_B],
            );)*
        };
    }

    #[test]
    fn every_type_of_color_is_blended_channel_by_channel() {
        check_types!(Rgb332, Rgb555, Rgb565, Rgb666, Rgb888, Bgr555, Bgr565, Bgr666, Bgr888);
        check_type(|random| Gray2::new(random.bits() as u8), |gray| [gray.luma()], [3]);
        check_type(|random| Gray4::new(random.bits() as u8), |gray| [gray.luma()], [15]);
        check_type(|random| Gray8::new(random.bits() as u8), |gray| [gray.luma()], [255]);
        check_type(
            |random| Rgb565Be::from(RawU16::new(random.bits() as u16)),
            |color| {
                let color = Rgb565::from(color);
                [color.r(), color.g(), color.b()]
            },
            [31, 63, 31],
        );
    }

    /// By words as by channels, bit for bit: halves too are rounded alike.
    #[test]
    fn words_have_the_bits_of_channels() {
        fn check<const MIDDLE: u32>(stored: u16, new: u16, alpha: Alpha) {
            let [from, to] = [stored, new].map(Word::<MIDDLE>::channels);
            let wanted = [
                Word::<MIDDLE>::of_channels([
                    Channel::<5>::over(from[0], to[0], alpha),
                    Channel::<MIDDLE>::over(from[1], to[1], alpha),
                    Channel::<5>::over(from[2], to[2], alpha),
                ]),
                Word::<MIDDLE>::of_channels([
                    Channel::<5>::add(from[0], to[0], alpha),
                    Channel::<MIDDLE>::add(from[1], to[1], alpha),
                    Channel::<5>::add(from[2], to[2], alpha),
                ]),
            ];
            let got =
                [Word::<MIDDLE>::over(stored, new, alpha), Word::<MIDDLE>::add(stored, new, alpha)];
            assert_eq!(got, wanted, "{from:?} {to:?} {alpha:?}");
        }
        let mut random = Random::new(13);
        for round in 0..200_000u32 {
            let bits = random.bits();
            let alpha = Alpha::from_bits((round % 257) as u16);
            check::<6>(bits as u16, (bits >> 16) as u16, alpha);
            check::<5>(bits as u16 & 0x7FFF, (bits >> 16) as u16 & 0x7FFF, alpha);
        }
    }
}
