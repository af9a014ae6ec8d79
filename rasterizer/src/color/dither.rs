//! Colours of few bits from colours of eight bits a channel, by the place of the pixel.

use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb555, Rgb565,
    Rgb666, Rgb888, RgbColor,
};

use super::{Bayer, Rgb332};

/// A colour of eight bits a channel, which can be dithered: [`Rgb888`] or [`Gray8`].
pub trait FullColor: Copy {
    /// Red, green and blue.
    fn channels(self) -> [u8; 3];

    /// How bright it is: of a colour (77 R + 150 G + 29 B) / 256, rounded, as in the conversions of
    /// embedded-graphics.
    fn luma(self) -> u8;
}

impl FullColor for Rgb888 {
    #[inline(always)]
    fn channels(self) -> [u8; 3] {
        [self.r(), self.g(), self.b()]
    }

    #[inline(always)]
    fn luma(self) -> u8 {
        GrayColor::luma(&Gray8::from(self))
    }
}

impl FullColor for Gray8 {
    #[inline(always)]
    fn channels(self) -> [u8; 3] {
        [GrayColor::luma(&self); 3]
    }

    #[inline(always)]
    fn luma(self) -> u8 {
        GrayColor::luma(&self)
    }
}

/// A colour that another one can be dithered to: all of embedded-graphics, [`Rgb332`] and
/// [`Rgb565Be`](crate::output::Rgb565Be).
///
/// A pixel gets the step below or above the wanted value, by the threshold of its place on the
/// display, so that the mean over a square is right: [`Bayer`] has the rule and its bound. As the
/// place decides and nothing else, bands, parts of the display and whole frames have the same
/// pixels. All channels of a pixel have one threshold: grays stay as gray as the format allows.
///
/// Black, white and all steps of 1, 2 and 4 bits stay as they are, in all places: even surfaces of
/// them have no pattern. Most steps of 3, 5 and 6 bits are no whole numbers of 255ths.
///
/// `BinaryColor` and [`Gray2`] get the right mean of *light*, by the curve of sRGB: seen from
/// afar, a square of pixels is as bright as the colour that they stand for. A format of more bits
/// gets the right mean of *stored values*, which takes less work: between two of its steps the
/// curve is nearly straight. With 16 grays the mean light is off by 1/600 of white at most, less
/// than half of one of 256 steps; in [`Rgb332`] by 1/130, and in its blue by 1/25.
///
/// Colours of eight bits a channel are converted, in all places alike.
///
/// A pixel of Gouraud shading with depth, which takes 16 to 18 instructions on a Cortex-M0+ and 13
/// on an M4, takes this many more (by the loop of two pixels):
///
/// | to | from | Cortex-M0+ | Cortex-M4 |
/// |---|---|---|---|
/// | `BinaryColor` | `Gray8` | 14 to 28 | 7 to 17 |
/// | `Gray2`, `Gray4` | `Gray8` | 26 to 28 | 16 to 20 |
/// | `Rgb332`, `Rgb565` | `Rgb888` | 54 | 33 |
#[diagnostic::on_unimplemented(
    message = "nothing can be dithered to `{Self}`",
    note = "implement `rasterizer::color::Dither` for it, with `Bayer::threshold`"
)]
pub trait Dither: Copy {
    /// Returns what a pixel of the display shows for a colour. The matrix has `SIZE` rows, 4 or 8.
    fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self;
}

/// A whole number below 65,535 divided by 255, cut off.
#[inline(always)]
pub(super) const fn divided_by_255(number: u32) -> u32 {
    // With number = 255 q + r, r at most 254, number >> 8 is q, or q - 1 where r < q (q is at most
    // 256): the sum is 256 q + r + 1 or 256 q + r, and the latter only where r < q.
    (number + 1 + (number >> 8)) >> 8
}

/// A channel of 256 steps as one of `most` + 1.
#[inline(always)]
const fn step(value: u8, most: u8, threshold: u8) -> u8 {
    divided_by_255(value as u32 * most as u32 + threshold as u32) as u8
}

macro_rules! by_channels {
    ($($color:ident),*) => {
        $(impl Dither for $color {
            #[inline(always)]
            fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self {
                let threshold = Bayer::<SIZE>::threshold(column, row);
                let [red, green, blue] = color.channels();
                Self::new(
                    step(red, Self::MAX_R, threshold),
                    step(green, Self::MAX_G, threshold),
                    step(blue, Self::MAX_B, threshold),
                )
            }
        })*
    };
}

by_channels!(Rgb332, Rgb555, Rgb565, Rgb666, Bgr555, Bgr565, Bgr666);

macro_rules! converted {
    ($($color:ident),*) => {
        $(impl Dither for $color {
            #[inline(always)]
            fn dithered<const SIZE: usize>(color: impl FullColor, _: i32, _: i32) -> Self {
                let [red, green, blue] = color.channels();
                Self::new(red, green, blue)
            }
        })*
    };
}

converted!(Rgb888, Bgr888);

impl Dither for BinaryColor {
    #[inline(always)]
    fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self {
        Self::from(Bayer::<SIZE>::is_white(color.luma(), column, row))
    }
}

impl Dither for Gray2 {
    #[inline(always)]
    fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self {
        Self::new(Bayer::<SIZE>::of_four(color.luma(), column, row))
    }
}

impl Dither for Gray4 {
    #[inline(always)]
    fn dithered<const SIZE: usize>(color: impl FullColor, column: i32, row: i32) -> Self {
        Self::new(step(color.luma(), 15, Bayer::<SIZE>::threshold(column, row)))
    }
}

impl Dither for Gray8 {
    #[inline(always)]
    fn dithered<const SIZE: usize>(color: impl FullColor, _: i32, _: i32) -> Self {
        Self::new(color.luma())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Rgb565Be;

    /// Light by the curve of sRGB.
    fn light(value: f64) -> f64 {
        let value = value / 255.0;
        if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    }

    /// The steps of all places in a square of 8 x 8 pixels.
    fn square<C: Dither, const SIZE: usize>(color: impl FullColor, step: fn(C) -> u8) -> [u8; 64] {
        core::array::from_fn(|i| {
            step(C::dithered::<SIZE>(color, i as i32 % 8 - 8, i as i32 / 8 + 40))
        })
    }

    /// Judges the mean of a square for every shade: `mean_of` makes what is averaged of a value
    /// from 0 to 255, and `most` is the last step. The bound is half a pixel of the matrix, in the
    /// step that the shade lies in.
    fn means<C: Dither, const SIZE: usize>(most: u8, step: fn(C) -> u8, mean_of: fn(f64) -> f64) {
        let count = (SIZE * SIZE) as f64;
        let of_step = |step: f64| mean_of(step * 255.0 / f64::from(most));
        for shade in 0..=255u8 {
            let steps = square::<C, SIZE>(Gray8::new(shade), step);
            let sum: f64 = steps.iter().map(|&step| of_step(f64::from(step))).sum();
            let lower = (f64::from(shade) * f64::from(most) / 255.0).floor();
            let height = of_step(lower + 1.0) - of_step(lower);
            let off = (sum / 64.0 - mean_of(f64::from(shade))).abs();
            assert!(off <= height / (2.0 * count) + 1e-12, "shade {shade}: {off} of {height}");
            // What the project promises of the mean light, of white, with 8 x 8 pixels.
            assert!(SIZE == 4 || off <= mean_of(255.0) / 64.0, "shade {shade}: {off}");
            let colored = square::<C, SIZE>(Rgb888::new(shade, shade, shade), step);
            assert_eq!(colored, steps, "a gray of three channels is that gray");
        }
    }

    fn stored(value: f64) -> f64 {
        value
    }

    #[test]
    fn the_mean_of_a_square_is_the_shade() {
        fn check<const SIZE: usize>() {
            means::<BinaryColor, SIZE>(1, |color| color.is_on().into(), light);
            means::<Gray2, SIZE>(3, |color| color.luma(), light);
            means::<Gray4, SIZE>(15, |color| color.luma(), stored);
            means::<Gray8, SIZE>(255, |color| color.luma(), stored);
            means::<Rgb332, SIZE>(7, |color| color.r(), stored);
            means::<Rgb332, SIZE>(7, |color| color.g(), stored);
            means::<Rgb332, SIZE>(3, |color| color.b(), stored);
            means::<Rgb555, SIZE>(31, |color| color.g(), stored);
            means::<Bgr555, SIZE>(31, |color| color.b(), stored);
            means::<Rgb565, SIZE>(31, |color| color.r(), stored);
            means::<Rgb565, SIZE>(63, |color| color.g(), stored);
            means::<Bgr565, SIZE>(31, |color| color.b(), stored);
            means::<Rgb565Be, SIZE>(63, |color| Rgb565::from(color).g(), stored);
            means::<Rgb666, SIZE>(63, |color| color.r(), stored);
            means::<Bgr666, SIZE>(63, |color| color.b(), stored);
            means::<Rgb888, SIZE>(255, |color| color.b(), stored);
            means::<Bgr888, SIZE>(255, |color| color.r(), stored);
        }
        check::<4>();
        check::<8>();
    }

    /// In light, as the documentation of [`Dither`] has it for formats whose stored values are
    /// averaged.
    #[test]
    fn grays_of_four_bits_are_nearly_right_in_light() {
        let mut worst = 0.0f64;
        for shade in 0..=255u8 {
            let steps = square::<Gray4, 8>(Gray8::new(shade), |color| color.luma());
            let sum: f64 = steps.iter().map(|&step| light(17.0 * f64::from(step))).sum();
            // What the thresholds alone are off by is judged above.
            let rounding = (light(255.0) - light(238.0)) / 128.0;
            worst = worst.max((sum / 64.0 - light(f64::from(shade))).abs() - rounding);
        }
        assert!(worst <= 1.0 / 600.0, "{worst}");
    }

    #[test]
    fn channels_are_dithered_apart() {
        for column in 0..8 {
            for row in 0..8 {
                let color = Rgb888::new(200, 77, 3);
                let of = |value| Rgb565::dithered::<8>(Gray8::new(value), column, row);
                let wanted = Rgb565::new(of(200).r(), of(77).g(), of(3).b());
                assert_eq!(Rgb565::dithered::<8>(color, column, row), wanted);
                assert_eq!(Rgb565Be::dithered::<8>(color, column, row), wanted.into());
            }
        }
    }

    #[test]
    fn steps_that_are_whole_numbers_stay_as_they_are() {
        fn check<const SIZE: usize>() {
            for place in 0..64 {
                let [column, row] = [place % 8, place / 8];
                for step in 0..=15 {
                    let gray = Gray4::new(step);
                    assert_eq!(Gray4::dithered::<SIZE>(Gray8::from(gray), column, row), gray);
                    let gray = Gray2::new(step);
                    assert_eq!(Gray2::dithered::<SIZE>(Rgb888::from(gray), column, row), gray);
                }
                // Each channel is empty or full.
                for color in [Rgb888::BLACK, Rgb888::RED, Rgb888::CYAN, Rgb888::WHITE] {
                    assert_eq!(Rgb332::dithered::<SIZE>(color, column, row), color.into());
                    assert_eq!(Bgr565::dithered::<SIZE>(color, column, row), color.into());
                    assert_eq!(Rgb666::dithered::<SIZE>(color, column, row), color.into());
                }
            }
        }
        check::<4>();
        check::<8>();
    }

    #[test]
    fn a_division_by_255_is_cut_off() {
        for number in 0..65_535 {
            assert_eq!(divided_by_255(number), number / 255, "{number}");
        }
    }

    /// All colours of embedded-graphics are made of a material's, by their definitions.
    #[test]
    fn every_color_type_has_the_conversions_that_shaders_need() {
        let luma = |color: Rgb888| {
            let sum = 77 * u32::from(color.r()) + 150 * u32::from(color.g());
            ((sum + 29 * u32::from(color.b()) + 128) >> 8) as u8
        };
        for bits in (0..1 << 24).step_by(4_099) {
            let [_, red, green, blue] = u32::to_be_bytes(bits);
            let color = Rgb888::new(red, green, blue);
            let gray = luma(color);
            let nearest = |value: u8, most: f64| (f64::from(value) / 255.0 * most).round() as u8;
            assert_eq!(Gray8::from(color).luma(), gray);
            assert_eq!(Gray4::from(color).luma(), nearest(gray, 15.0));
            assert_eq!(Gray2::from(color).luma(), nearest(gray, 3.0));
            assert_eq!(BinaryColor::from(color).is_on(), gray >= 128);
            assert_eq!(Rgb555::from(color).r(), nearest(red, 31.0));
            assert_eq!(Bgr555::from(color).b(), nearest(blue, 31.0));
            assert_eq!(Rgb565::from(color).g(), nearest(green, 63.0));
            assert_eq!(Bgr565::from(color).r(), nearest(red, 31.0));
            assert_eq!(Rgb666::from(color).b(), nearest(blue, 63.0));
            assert_eq!(Bgr666::from(color).g(), nearest(green, 63.0));
            assert_eq!(Bgr888::from(color).r(), red);
        }
    }
}
