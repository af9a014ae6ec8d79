//! The options for textures, and what is told of them.

use clap::Args;
use host_tools::model::{AlphaFormat, ColorFormat, TexelFormat, TextureOptions, Textures};
use serde::Serialize;

use super::view::choice;

/// The names of formats. Textures of colours are also known by the most common type.
const FORMATS: [(&str, TexelFormat); TexelFormat::NAMES.len() + 1] = {
    let mut formats = [("rgb565", TexelFormat::Direct); TexelFormat::NAMES.len() + 1];
    let mut place = 0;
    while place < TexelFormat::NAMES.len() {
        formats[place] = TexelFormat::NAMES[place];
        place += 1;
    }
    formats
};

/// How the pictures of materials (`map_Kd`, PNG or JPEG) become textures of one size and format.
#[derive(Clone, Copy, Debug, Args)]
#[command(next_help_heading = "Textures")]
pub(super) struct TextureArguments {
    /// Width and height, 1x1 to 1024x1024, powers of two where textures repeat; auto for those of
    /// the largest picture, as powers of two, 256 a side at most
    #[arg(long, value_name = "WxH", default_value = "auto", value_parser = size)]
    texture_size: Size,
    /// How texels are stored: as places in a palette of 2 to 256 colours or of greys, or as colours
    #[arg(
        long,
        value_name = "FORMAT",
        default_value = "indexed8",
        value_parser = choice(&FORMATS)
    )]
    texture_format: TexelFormat,
    /// The colours of palettes or texels: the colour type of the target
    #[arg(
        long,
        value_name = "TYPE",
        default_value = "rgb565",
        value_parser = choice(&ColorFormat::NAMES)
    )]
    color: ColorFormat,
    /// Make mip levels: the texture in half the size, a quarter and so on
    #[arg(long)]
    mipmaps: bool,
    /// How transparency is stored where a picture has any: one colour or place in the palette, or a
    /// plane of 1, 4 or 8 bits a texel, from half on drawn and else left out, or one of 4 or 8 bits
    /// by which texels are blended [default: key, if a texel is more transparent than opaque]
    #[arg(
        long,
        value_name = "FORMAT",
        value_parser = choice(&AlphaFormat::NAMES)
    )]
    alpha: Option<AlphaFormat>,
    /// Leave the pictures of materials out: they are drawn in their colours (`Kd`)
    #[arg(
        long,
        conflicts_with_all = ["texture_size", "texture_format", "color", "mipmaps", "alpha"]
    )]
    no_textures: bool,
}

impl TextureArguments {
    /// The options of a conversion.
    pub(super) fn options(self) -> Option<TextureOptions> {
        (!self.no_textures).then_some(TextureOptions {
            size: self.texture_size.0,
            format: self.texture_format,
            color: self.color,
            mipmaps: self.mipmaps,
            alpha: self.alpha,
        })
    }
}

/// A size, or `None` for an automatic one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size(Option<[usize; 2]>);

fn size(text: &str) -> Result<Size, &'static str> {
    if text == "auto" {
        return Ok(Size(None));
    }
    let side = |text: &str| text.parse().ok().filter(|side| (1..=1_024).contains(side));
    text.split_once('x')
        .and_then(|(width, height)| Some(Size(Some([side(width)?, side(height)?]))))
        .ok_or("write auto, or two numbers from 1 to 1024 as in 128x64")
}

/// What `--json` tells of a texture.
#[derive(Serialize)]
pub(super) struct TextureJson {
    file: String,
    width: usize,
    height: usize,
    levels: usize,
    bytes: usize,
    /// `null` where it is equal to the picture in that size.
    psnr_db: Option<f64>,
}

impl TextureJson {
    pub(super) fn all(textures: &Textures) -> Vec<Self> {
        let ([width, height], levels) = (textures.size, textures.levels().len());
        (textures.textures.iter())
            .map(|texture| Self {
                file: texture.path.to_string_lossy().into_owned(),
                width,
                height,
                levels,
                bytes: texture.bytes(),
                psnr_db: Some(texture.psnr_db).filter(|db| db.is_finite()),
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_numbers_or_automatic() {
        assert_eq!(size("auto"), Ok(Size(None)));
        assert_eq!(size("1x1024"), Ok(Size(Some([1, 1_024]))));
        for text in ["", "x", "64", "0x1", "1x1025", "64x64x64", "-1x1", "64 x 64", "Auto"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
