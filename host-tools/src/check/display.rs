//! The picture that a display of few colours shows, by the core's dithering and by its definition.

use embedded_graphics_core::{
    draw_target::DrawTarget,
    geometry::{Point, Size},
    pixelcolor::{
        BinaryColor, Gray2, Gray4, Gray8, PixelColor, Rgb555, Rgb565, Rgb666, Rgb888, RgbColor,
    },
    primitives::Rectangle,
};
use rasterizer::{
    color::{Dither, Rgb332},
    output::{Dithering, Frame, PackedColor, PackedFrame, StoredColor},
};

use super::{Checked, Difference, FixedPicture};
use crate::reference::{self, Steps};

/// The colours of a display. The orders of red and blue show the same picture, so that there is one
/// of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Colors {
    /// A bit, on or off.
    Binary,
    /// Four grays.
    Gray2,
    /// 16 grays.
    Gray4,
    /// 256 grays.
    Gray8,
    /// Three bits of red and of green, two of blue.
    Rgb332,
    /// Five bits of each channel.
    Rgb555,
    /// Five bits of red and blue, six of green.
    Rgb565,
    /// Six bits of each channel.
    Rgb666,
    /// Eight bits of each channel.
    Rgb888,
}

impl Colors {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 9] = [
        ("binary", Self::Binary),
        ("gray2", Self::Gray2),
        ("gray4", Self::Gray4),
        ("gray8", Self::Gray8),
        ("rgb332", Self::Rgb332),
        ("rgb555", Self::Rgb555),
        ("rgb565", Self::Rgb565),
        ("rgb666", Self::Rgb666),
        ("rgb888", Self::Rgb888),
    ];

    /// Their steps.
    #[must_use]
    pub const fn steps(self) -> Steps {
        match self {
            Self::Binary => Steps::Gray(2),
            Self::Gray2 => Steps::Gray(4),
            Self::Gray4 => Steps::Gray(16),
            Self::Gray8 => Steps::Gray(256),
            Self::Rgb332 => Steps::Rgb([8, 8, 4]),
            Self::Rgb555 => Steps::Rgb([32, 32, 32]),
            Self::Rgb565 => Steps::Rgb([32, 64, 32]),
            Self::Rgb666 => Steps::Rgb([64, 64, 64]),
            Self::Rgb888 => Steps::Rgb([256, 256, 256]),
        }
    }
}

/// How colours become those of a display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Matrix {
    /// Each becomes the nearest.
    #[default]
    None,
    /// By 4 x 4 thresholds.
    Four,
    /// By 8 x 8 thresholds.
    Eight,
}

impl Matrix {
    /// Those that dither, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 2] = [("4", Self::Four), ("8", Self::Eight)];

    /// Its rows.
    #[must_use]
    pub const fn rows(self) -> Option<u32> {
        match self {
            Self::None => None,
            Self::Four => Some(4),
            Self::Eight => Some(8),
        }
    }
}

/// A display.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Display {
    /// Its colours.
    pub colors: Colors,
    /// How they are made of others.
    pub dither: Matrix,
}

impl Display {
    /// The definition of what it shows.
    #[must_use]
    pub const fn definition(self) -> reference::Display {
        reference::Display { steps: self.colors.steps(), dither: self.dither.rows() }
    }

    /// Returns what it shows of a picture of `size`, row by row, by the core: the picture is sent
    /// to a frame of its colours.
    ///
    /// # Panics
    ///
    /// Panics if the picture does not have as many pixels.
    #[must_use]
    pub fn shown(self, size: [u32; 2], pixels: &[[u8; 3]]) -> Vec<[u8; 3]> {
        let [width, height] = size;
        let area = Rectangle::new(Point::zero(), Size::new(width, height));
        let pixels: Vec<_> = pixels.iter().copied().map(rgb888).collect();
        match self.colors {
            Colors::Binary => self.packed::<BinaryColor>(area, pixels),
            Colors::Gray2 => self.packed::<Gray2>(area, pixels),
            Colors::Gray4 => self.packed::<Gray4>(area, pixels),
            Colors::Gray8 => self.unpacked::<Gray8>(area, pixels),
            Colors::Rgb332 => self.unpacked::<Rgb332>(area, pixels),
            Colors::Rgb555 => self.unpacked::<Rgb555>(area, pixels),
            Colors::Rgb565 => self.unpacked::<Rgb565>(area, pixels),
            Colors::Rgb666 => self.unpacked::<Rgb666>(area, pixels),
            Colors::Rgb888 => self.unpacked::<Rgb888>(area, pixels),
        }
    }

    fn packed<C>(self, area: Rectangle, pixels: Vec<Rgb888>) -> Vec<[u8; 3]>
    where
        C: PackedColor + Dither + From<Rgb888> + Into<Rgb888>,
    {
        let mut bytes = vec![0; PackedFrame::<C>::bytes(area.size)];
        let mut frame = PackedFrame::<C>::without_depth(&mut bytes, area).expect("its size");
        self.send(pixels, &mut frame);
        frame.pixels().map(channels).collect()
    }

    fn unpacked<C>(self, area: Rectangle, pixels: Vec<Rgb888>) -> Vec<[u8; 3]>
    where
        C: PixelColor + StoredColor + Dither + From<Rgb888> + Into<Rgb888>,
    {
        let mut colors = vec![C::from(Rgb888::BLACK); pixels.len()];
        let mut frame = Frame::without_depth(&mut colors, area).expect("its size");
        self.send(pixels, &mut frame);
        colors.into_iter().map(channels).collect()
    }

    /// Sends pixels to a target that they fill.
    fn send<T>(self, mut pixels: Vec<Rgb888>, target: &mut T)
    where
        T: DrawTarget<Color: Dither + From<Rgb888>, Error = core::convert::Infallible>,
    {
        let area = target.bounding_box();
        let frame = Frame::without_depth(&mut pixels, area).expect("a pixel for each");
        let Ok(()) = match self.dither {
            Matrix::None => {
                let colors = frame.pixels().iter().map(|&pixel| pixel.into());
                target.fill_contiguous(&area, colors)
            }
            Matrix::Four => frame.present(&mut Dithering::<_, _, 4>::with_size(target)),
            Matrix::Eight => frame.present(&mut Dithering::<_, _, 8>::with_size(target)),
        };
    }
}

fn channels(color: impl Into<Rgb888>) -> [u8; 3] {
    let color = color.into();
    [color.r(), color.g(), color.b()]
}

/// How far what a display shows is off its definition.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct DisplayOutcome {
    /// Pixels that both pictures cover.
    pub judged: usize,
    /// Those whose step is not that of the core's own colour: the bound is 0.
    pub wrong_steps: usize,
    /// Those whose step is not one of the exact colour, give or take what a colour may be off: the
    /// bound is 0.
    pub wrong_colors: usize,
    /// Column and row of the first of either.
    pub first: Option<[usize; 2]>,
    /// The squares of 8 x 8 pixels of one colour.
    pub even_blocks: usize,
    /// How far the mean of such a square is off its colour at most, as a part of white: of light
    /// with one and two bits, else of stored values.
    pub block_max_error: f64,
    /// How far it may be; `None` without dithering.
    pub block_bound: Option<f64>,
}

impl DisplayOutcome {
    /// Whether each pixel shows a right step, and each square its colour.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.wrong_steps == 0
            && self.wrong_colors == 0
            && self.block_bound.is_none_or(|bound| self.block_max_error <= bound)
    }
}

/// How far a colour of the core may be off, in steps of 8 bits.
const COLOR: f64 = super::Bounds::ARITHMETIC.color_max_error;
/// How far a gray may be off that is made of it, and rounded to 8 bits.
const GRAY: f64 = COLOR + 0.5;

/// Judges what a display shows of a picture that the core has drawn.
pub(super) fn judge(display: Display, checked: &Checked) -> DisplayOutcome {
    let colors: Vec<_> = checked.fixed.pixels.iter().map(|pixel| pixel.color).collect();
    judge_shown(display, checked, &display.shown(checked.fixed.size, &colors))
}

/// [`judge`] for what the core shows.
pub(super) fn judge_shown(
    display: Display,
    checked: &Checked,
    shown: &[[u8; 3]],
) -> DisplayOutcome {
    let FixedPicture { size, ref pixels } = checked.fixed;
    let definition = display.definition();
    let width = size[0] as usize;
    let mut outcome = DisplayOutcome {
        // Half of the pixels of the matrix that one step of the pattern changes, of the largest
        // step, which is not larger than white.
        block_bound: display
            .dither
            .rows()
            .map(|rows| if rows == 8 { 1.0 / 64.0 } else { 1.0 / 32.0 }),
        ..DisplayOutcome::default()
    };
    for (index, (pixel, &step)) in pixels.iter().zip(shown).enumerate() {
        let color = pixel.color;
        let place = [index % width, index / width];
        let Difference::Both { color: exact, .. } =
            checked.arithmetic_difference(place[0], place[1])
        else {
            continue;
        };
        outcome.judged += 1;
        let of_core = definition.shown(gray_of(&definition, full(color)), place);
        let is_step = near(step, of_core, of_core);
        let off = if matches!(definition.steps, Steps::Gray(_)) { GRAY } else { COLOR };
        let [least, most] = [-off, off]
            .map(|off| definition.shown(exact.map(|c| (c + off).clamp(0.0, 255.0)), place));
        let is_color = near(step, least, most);
        outcome.wrong_steps += usize::from(!is_step);
        outcome.wrong_colors += usize::from(!is_color);
        if !(is_step && is_color) {
            outcome.first.get_or_insert(place);
        }
    }
    blocks(&mut outcome, &definition, checked, shown);
    outcome
}

fn full(color: [u8; 3]) -> [f64; 3] {
    color.map(f64::from)
}

/// Whether a step is one of two, or between them. Its 8 bits are rounded.
fn near(step: [u8; 3], least: [f64; 3], most: [f64; 3]) -> bool {
    let within = |i: usize| (least[i] - 0.51..=most[i] + 0.51).contains(&f64::from(step[i]));
    (0..3).all(within)
}

/// Compares the mean of each square of 8 x 8 pixels of one colour with that.
fn blocks(
    outcome: &mut DisplayOutcome,
    definition: &reference::Display,
    checked: &Checked,
    shown: &[[u8; 3]],
) {
    let [width, height] = checked.fixed.size.map(|side| side as usize);
    for (left, top) in
        (0..height / 8).flat_map(|row| (0..width / 8).map(move |column| (8 * column, 8 * row)))
    {
        let places = || (0..64).map(|i| (top + i / 8) * width + left + i % 8);
        let first = checked.fixed.pixels[top * width + left];
        let is_even = |index: usize| {
            let pixel = checked.fixed.pixels[index];
            pixel.depth != 0 && pixel.color == first.color
        };
        if !places().all(is_even) {
            continue;
        }
        outcome.even_blocks += 1;
        let wanted = definition.measured(gray_of(definition, full(first.color)));
        for (channel, wanted) in wanted.into_iter().enumerate() {
            let sum: f64 =
                places().map(|index| definition.measured(full(shown[index]))[channel]).sum();
            let off = (sum / 64.0 - wanted).abs();
            outcome.block_max_error = outcome.block_max_error.max(off);
        }
    }
}

/// The colour that is dithered: a gray is rounded to 8 bits before.
fn gray_of(definition: &reference::Display, color: [f64; 3]) -> [f64; 3] {
    match definition.steps {
        Steps::Gray(_) => [reference::luma(color).round(); 3],
        Steps::Rgb(_) => color,
    }
}

/// A colour of the core.
pub(super) const fn rgb888([red, green, blue]: [u8; 3]) -> Rgb888 {
    Rgb888::new(red, green, blue)
}
