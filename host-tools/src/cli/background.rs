//! What lies behind a model: a colour, a gradient or a picture.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow};
use embedded_graphics_core::{
    Drawable as _,
    geometry::{Point, Size},
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use host_tools::model::Picture;
use rasterizer::output::{Frame, VerticalGradient};

/// A colour in steps of 8 bits.
pub(super) type Rgb = [u8; 3];

/// A background by its colours or its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Background {
    /// The same from top to bottom, or another one at the bottom.
    Colors([Rgb; 2]),
    /// A PNG or JPEG file that fills the picture.
    Picture(PathBuf),
}

/// Six hexadecimal digits, which may follow a `#`.
pub(super) fn color(text: &str) -> Result<Rgb, String> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let is_color = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_color);
    let [_, r, g, b] = number.ok_or("write six hexadecimal digits, as in 283240")?.to_be_bytes();
    Ok([r, g, b])
}

/// A colour, two of them, or the name of a picture.
pub(super) fn background(text: &str) -> Result<Background, String> {
    if let Ok(color) = color(text) {
        return Ok(Background::Colors([color; 2]));
    }
    if let Some((top, bottom)) = text.split_once("..")
        && let (Ok(top), Ok(bottom)) = (color(top), color(bottom))
    {
        return Ok(Background::Colors([top, bottom]));
    }
    let ending = Path::new(text).extension().unwrap_or_default().to_ascii_lowercase();
    if ["png", "jpg", "jpeg"].iter().any(|known| ending == *known) || Path::new(text).is_file() {
        return Ok(Background::Picture(text.into()));
    }
    Err("write a colour as in 283240, two for a gradient from top to bottom as in 102030..8090a0, \
         or the name of a PNG or JPEG file"
        .to_owned())
}

impl Background {
    /// The file that it is read from.
    pub(super) fn input(&self) -> Option<&Path> {
        match self {
            Self::Colors(_) => None,
            Self::Picture(path) => Some(path),
        }
    }

    /// The colours of a picture of this size, row by row: gradients as the core draws them.
    pub(super) fn drawn(&self, [width, height]: [u32; 2]) -> Result<Vec<Rgb>> {
        match self {
            &Self::Colors([top, bottom]) => {
                let area = Rectangle::new(Point::zero(), Size::new(width, height));
                let mut colors = vec![Rgb888::BLACK; width as usize * height as usize];
                let mut frame = Frame::without_depth(&mut colors, area)?;
                let Ok(()) = VerticalGradient::new(area, top, bottom).draw(&mut frame);
                Ok(colors.into_iter().map(|color| [color.r(), color.g(), color.b()]).collect())
            }
            Self::Picture(path) => {
                let picture = Picture::load(path).map_err(|error| anyhow!("{error}"))?;
                Ok(picture.filling([width as usize, height as usize]))
            }
        }
    }
}

/// The mean colour of a picture: that of fog before it.
pub(super) fn mean(picture: &[Rgb]) -> Rgb {
    let sum = |channel: usize| picture.iter().map(|color| u64::from(color[channel])).sum::<u64>();
    let count = picture.len().max(1) as u64;
    [0, 1, 2].map(|channel| ((sum(channel) + count / 2) / count) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_six_digits() {
        assert_eq!(color("102fFF"), Ok([16, 47, 255]));
        assert_eq!(color("#000001"), Ok([0, 0, 1]));
        for text in ["", "12345", "1234567", "+12345", "#", "blue", "ééé", "0x1234"] {
            assert!(color(text).is_err(), "{text}");
        }
    }

    #[test]
    fn backgrounds_are_colors_gradients_or_files() {
        assert_eq!(background("#0a0B0c"), Ok(Background::Colors([[10, 11, 12]; 2])));
        let gradient = Background::Colors([[0; 3], [255, 1, 2]]);
        assert_eq!(background("#000000..#ff0102"), Ok(gradient.clone()));
        assert_eq!(background("000000..ff0102"), Ok(gradient.clone()));
        assert_eq!(background("sky.JPG"), Ok(Background::Picture("sky.JPG".into())));
        for text in ["", "blue", "..", "000000..", "000000..blue", "000000-ff0102"] {
            assert!(background(text).is_err(), "{text}");
        }
        // The first row has the first colour, the last one the second.
        let rows = gradient.drawn([1, 3]).unwrap();
        assert_eq!(rows, [[0; 3], [128, 1, 1], [255, 1, 2]]);
        assert_eq!(mean(&rows), [128, 1, 1]);
        assert_eq!(gradient.drawn([2, 1]).unwrap(), [[0; 3]; 2]);
    }
}
