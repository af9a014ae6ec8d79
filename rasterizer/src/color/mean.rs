//! The mean of several colours.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor as _,
    IntoStorage as _, Rgb555, Rgb565, Rgb666, Rgb888, RgbColor as _, raw::RawU16,
};

use super::Rgb332;

/// A colour of which a mean can be taken, channel by channel in the values that are stored, rounded
/// to the nearest and half a step up: all of embedded-graphics, [`Rgb332`] and
/// [`Rgb565Be`](crate::output::Rgb565Be). `BinaryColor` is on if at least half of the colours are.
pub trait Mean: Copy {
    /// The sum of up to 16 colours.
    type Sum: Copy;

    /// The sum of no colours.
    const NOTHING: Self::Sum;

    /// Returns a sum with this colour added.
    #[must_use]
    fn added_to(self, sum: Self::Sum) -> Self::Sum;

    /// Returns the mean of 2<sup>`bits`</sup> colours, up to 16.
    #[must_use]
    fn of_sum(sum: Self::Sum, bits: u32) -> Self;
}

/// A sum of one channel divided by 2^`bits`, rounded to the nearest.
#[inline(always)]
const fn divided(sum: u32, bits: u32) -> u8 {
    ((sum + ((1 << bits) >> 1)) >> bits) as u8
}

/// Where the channels of 16 bits are, with a copy of them 16 bits higher, for sums of nine and ten
/// bits: the outer two from bits 0 and 11 on, the middle one from bit 21 on.
const SPREAD: u32 = 0x07E0_F81F;
/// The least significant bits of the three.
const ONES: u32 = 1 << 21 | 1 << 11 | 1;

/// Three sums in a word: `$spread` puts the channels of a colour there, and `$mean` returns the
/// mean of 2^bits.
macro_rules! in_a_word {
    ([$($color:ident),*] $spread:expr, $mean:expr) => {
        $(impl Mean for $color {
            type Sum = u32;

            const NOTHING: u32 = 0;

            #[inline(always)]
            fn added_to(self, sum: u32) -> u32 {
                sum + $spread(self)
            }

            #[inline(always)]
            fn of_sum(sum: u32, bits: u32) -> Self {
                $mean(sum, bits)
            }
        })*
    };
}

// Five, six and five bits: in the places that the channels have.
in_a_word!(
    [Rgb565, Bgr565]
    |color: Self| {
        let bits = u32::from(color.into_storage());
        (bits | bits << 16) & SPREAD
    },
    |sum: u32, bits: u32| {
        let mean = ((sum + ONES * ((1 << bits) >> 1)) >> bits) & SPREAD;
        Self::from(RawU16::new((mean | mean >> 16) as u16))
    }
);

// Channels of up to six bits, of which 16 fit ten bits.
in_a_word!(
    [Rgb332, Rgb555, Rgb666, Bgr555, Bgr666]
    |color: Self| {
        u32::from(color.r()) << 20 | u32::from(color.g()) << 10 | u32::from(color.b())
    },
    |sum: u32, bits: u32| {
        let channel = |sum: u32| divided(sum & 0x3FF, bits);
        Self::new(channel(sum >> 20), channel(sum >> 10), channel(sum))
    }
);

macro_rules! by_channels {
    ($($color:ident),*) => {
        $(impl Mean for $color {
            type Sum = [u16; 3];

            const NOTHING: [u16; 3] = [0; 3];

            #[inline(always)]
            fn added_to(self, [red, green, blue]: [u16; 3]) -> [u16; 3] {
                [
                    red + u16::from(self.r()),
                    green + u16::from(self.g()),
                    blue + u16::from(self.b()),
                ]
            }

            #[inline(always)]
            fn of_sum(sum: [u16; 3], bits: u32) -> Self {
                let [red, green, blue] = sum.map(|channel| divided(channel.into(), bits));
                Self::new(red, green, blue)
            }
        })*
    };
}

by_channels!(Rgb888, Bgr888);

macro_rules! by_luma {
    ($($color:ident: $luma:expr, $of:expr),*) => {
        $(impl Mean for $color {
            type Sum = u16;

            const NOTHING: u16 = 0;

            #[inline(always)]
            fn added_to(self, sum: u16) -> u16 {
                sum + u16::from($luma(self))
            }

            #[inline(always)]
            fn of_sum(sum: u16, bits: u32) -> Self {
                $of(divided(sum.into(), bits))
            }
        })*
    };
}

by_luma!(
    Gray2: |color: Self| color.luma(), Self::new,
    Gray4: |color: Self| color.luma(), Self::new,
    Gray8: |color: Self| color.luma(), Self::new,
    BinaryColor: |color: Self| u8::from(color.is_on()), |luma| Self::from(luma != 0)
);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{output::Rgb565Be, random::Random};

    /// Means of 4 and 16 random colours, whose channels `channels` returns, by their definition.
    fn check<C: Mean, const N: usize>(
        color: impl Fn(&mut Random) -> C,
        channels: impl Fn(C) -> [u8; N],
    ) {
        let mut random = Random::new(7);
        for bits in [0, 2, 4] {
            for _ in 0..300 {
                let colors: [C; 16] = core::array::from_fn(|_| color(&mut random));
                let colors = &colors[..1 << bits];
                let sum = colors.iter().fold(C::NOTHING, |sum, color| color.added_to(sum));
                let mean = channels(C::of_sum(sum, bits));
                for (channel, got) in mean.into_iter().enumerate() {
                    let sum: f64 = colors.iter().map(|&c| f64::from(channels(c)[channel])).sum();
                    let exact = (sum / f64::from(1 << bits) + 0.5).floor();
                    assert_eq!(f64::from(got), exact);
                }
            }
        }
    }

    #[test]
    fn means_are_rounded_to_the_nearest() {
        macro_rules! check_rgb {
            ($($color:ident),*) => {
                $(check(
                    |random| {
                        let [r, g, b] = [0; 3].map(|_| random.bits() as u8);
                        $color::new(r, g, b)
                    },
                    |color: $color| [color.r(), color.g(), color.b()],
                );)*
            };
        }
        check_rgb!(Rgb332, Rgb555, Rgb565, Rgb666, Rgb888, Bgr555, Bgr565, Bgr666, Bgr888);
        let channels = |color: Rgb565Be| {
            let color = Rgb565::from(color);
            [color.r(), color.g(), color.b()]
        };
        check(
            |random| {
                let [r, g, b] = [0; 3].map(|_| random.bits() as u8);
                Rgb565Be::new(r, g, b)
            },
            channels,
        );
        macro_rules! check_gray {
            ($($color:ident),*) => {
                $(check(
                    |random| $color::new(random.bits() as u8),
                    |color: $color| [color.luma()],
                );)*
            };
        }
        check_gray!(Gray2, Gray4, Gray8);
        check(
            |random| BinaryColor::from(random.bits() & 1 == 1),
            |color| [u8::from(color.is_on())],
        );
    }
}
