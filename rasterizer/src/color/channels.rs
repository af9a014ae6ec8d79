//! Colours whose channels are interpolated, rounded once.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666,
    Rgb888,
};
use fixed::types::U16F16;

use super::Rgb332;
use crate::attribute::{Components, Interpolate, Varyings};

/// A colour that vertices carry channel by channel: all of embedded-graphics, [`Rgb332`] and
/// [`Rgb565Be`](crate::output::Rgb565Be).
///
/// A varying of 16 bits counts in steps of the colour's own channel, whose digits are the upper
/// bits, so that an interpolated channel is rounded to the nearest step once, by a shift. Gray and
/// black and white have one varying, the luma of ITU-R BT.601 in 256ths (77 red, 150 green, 29
/// blue), as embedded-graphics converts colours.
///
/// # Error
///
/// A vertex has the nearest step for all 256 values of a channel. Between vertices a channel is
/// rounded from within 2<sup>-7</sup> of a step of the exact value, if it has 8 bits, and
/// 2<sup>-10</sup> if it has 5: what interpolation is off (1/4 + 3/2 n / 2<sup>16</sup> of a unit
/// over n pixels), and a unit for the vertex's rounding and the sample's.
pub trait Channels: Copy {
    /// The channels of a vertex.
    type Varyings: Components + Varyings<OnScreen = Self::Varyings>;

    /// The varyings of red, green and blue in Q16, 0 to 65,536 each, as pictures store them.
    fn varyings(rgb: [u32; 3]) -> Self::Varyings;

    /// Returns the colour for interpolated varyings.
    fn of(sample: <Self::Varyings as Interpolate>::Sample) -> Self;
}

/// Eight bits of a channel in Q16, 0 to 65,536, within half a unit.
#[inline(always)]
pub(crate) const fn to_q16(channel: u8) -> u32 {
    channel as u32 * 257 + (channel >> 7) as u32
}

/// The steps of a channel of `BITS` bits in the upper bits, and half a step, so that they are
/// rounded to the nearest.
#[inline(always)]
const fn varying<const BITS: u32>(q16: u32) -> u16 {
    // A step is 2^16 / (2^BITS - 1) of Q16, and 2^(16 - BITS) of the varying.
    let steps = q16 - ((q16 + (1 << (BITS - 1))) >> BITS);
    (steps + (1 << (15 - BITS))) as u16
}

/// The step that a varying is nearest to.
#[inline(always)]
const fn step<const BITS: u32>(varying: U16F16) -> u8 {
    (varying.to_bits() >> (32 - BITS)) as u8
}

/// The luma in Q16.
#[inline(always)]
const fn luma([red, green, blue]: [u32; 3]) -> u32 {
    (77 * red + 150 * green + 29 * blue + 128) >> 8
}

macro_rules! by_channels {
    ($($color:ident: [$red:literal, $green:literal, $blue:literal]),*) => {
        $(impl Channels for $color {
            type Varyings = [u16; 3];

            #[inline(always)]
            fn varyings([red, green, blue]: [u32; 3]) -> [u16; 3] {
                [varying::<$red>(red), varying::<$green>(green), varying::<$blue>(blue)]
            }

            #[inline(always)]
            fn of([red, green, blue]: [U16F16; 3]) -> Self {
                Self::new(step::<$red>(red), step::<$green>(green), step::<$blue>(blue))
            }
        })*
    };
}

by_channels!(
    Rgb332: [3, 3, 2],
    Rgb555: [5, 5, 5],
    Rgb565: [5, 6, 5],
    Rgb666: [6, 6, 6],
    Rgb888: [8, 8, 8],
    Bgr555: [5, 5, 5],
    Bgr565: [5, 6, 5],
    Bgr666: [6, 6, 6],
    Bgr888: [8, 8, 8]
);

macro_rules! by_luma {
    ($($color:ident: $bits:literal, $of:expr),*) => {
        $(impl Channels for $color {
            type Varyings = [u16; 1];

            #[inline(always)]
            fn varyings(rgb: [u32; 3]) -> [u16; 1] {
                [varying::<$bits>(luma(rgb))]
            }

            #[inline(always)]
            fn of([luma]: [U16F16; 1]) -> Self {
                $of(step::<$bits>(luma))
            }
        })*
    };
}

by_luma!(
    Gray2: 2, Self::new,
    Gray4: 4, Self::new,
    Gray8: 8, Self::new,
    BinaryColor: 1, |step| Self::from(step != 0)
);

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{GrayColor as _, RgbColor as _};

    use super::*;

    /// What a vertex's own pixel sees: half a unit above its varying.
    fn at_vertex<const N: usize>(varyings: [u16; N]) -> [U16F16; N] {
        varyings.map(|varying| U16F16::from_bits((u32::from(varying) << 16) + (1 << 15)))
    }

    #[test]
    fn vertices_have_the_nearest_step() {
        fn check<const BITS: u32>() {
            let most = f64::from((1u32 << BITS) - 1);
            for channel in 0..=255u8 {
                let [sample] = at_vertex([varying::<BITS>(to_q16(channel))]);
                let exact = f64::from(channel) / 255.0 * most;
                let got = f64::from(step::<BITS>(sample));
                assert!((got - exact).abs() <= 0.5, "{channel} in {BITS} bits: {got}, not {exact}");
            }
        }
        check::<1>();
        check::<2>();
        check::<3>();
        check::<4>();
        check::<5>();
        check::<6>();
        check::<8>();
    }

    /// Between two vertices, exactly interpolated, the step is the nearest but for two units of the
    /// varying.
    #[test]
    fn steps_between_vertices_are_nearest() {
        fn check<const BITS: u32>() {
            let most = f64::from((1u32 << BITS) - 1);
            let slack = 2.0 / f64::from(1u32 << (16 - BITS));
            for (a, b) in [(0, 255), (255, 0), (13, 200), (77, 78), (254, 1)] {
                let [from, to] = [a, b].map(|c| i64::from(varying::<BITS>(to_q16(c))) << 16);
                for way in 0..=1_000i64 {
                    let bits = from + (to - from) * way / 1_000 + (1 << 15);
                    let got = f64::from(step::<BITS>(U16F16::from_bits(bits as u32)));
                    let [a, b] = [a, b].map(f64::from);
                    let exact = (a + (b - a) * way as f64 / 1_000.0) / 255.0 * most;
                    assert!((got - exact).abs() <= 0.5 + slack, "{BITS} bits: {got}, not {exact}");
                }
            }
        }
        check::<1>();
        check::<4>();
        check::<5>();
        check::<6>();
        check::<8>();
    }

    #[test]
    fn channels_arrive_in_every_order() {
        let rgb = [255, 100, 0].map(to_q16);
        let orange = Rgb888::of(at_vertex(Rgb888::varyings(rgb)));
        assert_eq!(orange, Rgb888::new(255, 100, 0));
        let swapped = Bgr888::of(at_vertex(Bgr888::varyings(rgb)));
        assert_eq!([swapped.r(), swapped.g(), swapped.b()], [255, 100, 0]);
        let short = Rgb565::of(at_vertex(Rgb565::varyings(rgb)));
        assert_eq!(short, Rgb565::from(orange));
    }

    #[test]
    fn grays_are_those_of_embedded_graphics() {
        for color in [[255, 0, 0], [0, 255, 0], [0, 0, 255], [255; 3], [0; 3], [90, 40, 200]] {
            let [red, green, blue] = color;
            let wanted = Gray8::from(Rgb888::new(red, green, blue));
            let got = Gray8::of(at_vertex(Gray8::varyings(color.map(to_q16))));
            assert_eq!(got.luma(), wanted.luma(), "{color:?}");
            let is_on = BinaryColor::of(at_vertex(BinaryColor::varyings(color.map(to_q16))));
            assert_eq!(is_on, BinaryColor::from(wanted), "{color:?}");
        }
    }
}
