//! One texture: a picture in the size and the format of its mesh.

use std::path::{Path, PathBuf};

use super::{
    format::{AlphaFormat, ColorFormat, TexelFormat},
    palette,
    picture::Picture,
};

/// A texel as it is stored (sRGB), in steps of 8 bits, 0 to 255: red, green, blue and alpha.
pub(super) type Stored = [f64; 4];

/// The format that all textures of a mesh have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    pub texels: TexelFormat,
    pub color: ColorFormat,
    pub alpha: Option<AlphaFormat>,
}

/// A texture as the tables have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The file of its picture.
    pub path: PathBuf,
    /// The picture.
    pub original: Picture,
    /// The texels of all levels, the largest level first, each row by row from the top: places in
    /// the palette, or numbers of colours if there is none.
    pub texels: Vec<u32>,
    /// The numbers of the palette's colours, as many as its places; none without one.
    pub palette: Vec<u32>,
    /// The value of a texel that is transparent.
    pub key: Option<u32>,
    /// The alpha of each texel in the bits of the plane; none without one.
    pub alpha: Vec<u8>,
    /// How near the largest level is to the picture in that size: the peak signal-to-noise ratio of
    /// stored values, in dB. Infinite if they are equal.
    pub psnr_db: f64,
    color: ColorFormat,
    alpha_bits: usize,
}

impl Texture {
    /// A texture whose largest level has `size`, from the texels of all levels.
    pub(super) fn new(
        path: &Path,
        original: Picture,
        texels: &[Stored],
        [width, height]: [usize; 2],
        format: Format,
    ) -> Self {
        let rgb = |&[red, green, blue, _]: &Stored| [red, green, blue];
        let is_opaque = |texel: &Stored| texel[3] >= HALF;
        let has_key = format.alpha == Some(AlphaFormat::Key);
        let opaque: Vec<[f64; 3]> =
            texels.iter().filter(|texel| is_opaque(texel)).map(rgb).collect();

        let stored = |color| format.color.rgb(format.color.number(color));
        let colors = match format.texels.bits() {
            None => Vec::new(),
            Some(bits) => {
                let (count, reserved) = (1 << bits, usize::from(has_key));
                let colors = if format.texels.is_gray() {
                    let grey = |place| stored([place as f64 * 255.0 / (count - 1) as f64; 3]);
                    (reserved..count).map(grey).collect()
                } else {
                    palette::choose(&opaque, count - reserved, stored)
                };
                [vec![[0.0; 3]; reserved], colors].concat()
            }
        };
        let key = has_key.then(|| if colors.is_empty() { format.color.key()[0] } else { 0 });
        let value = |texel: &Stored| match (key, colors.is_empty()) {
            (Some(key), _) if !is_opaque(texel) => key,
            (_, true) => {
                let number = format.color.number(rgb(texel));
                if Some(number) == key { format.color.key()[1] } else { number }
            }
            _ => {
                let reserved = usize::from(has_key);
                (palette::nearest(&colors[reserved..], rgb(texel)) + reserved) as u32
            }
        };
        let alpha_bits = format.alpha.and_then(AlphaFormat::bits).unwrap_or(0);
        let most = f64::from((1_u32 << alpha_bits) - 1);
        let mut palette: Vec<u32> = colors.iter().map(|&c| format.color.number(c)).collect();
        palette.resize(format.texels.bits().map_or(0, |bits| 1 << bits), 0);
        let mut texture = Self {
            path: path.into(),
            original,
            texels: texels.iter().map(value).collect(),
            palette,
            key,
            alpha: if alpha_bits == 0 {
                Vec::new()
            } else {
                // Half and more has the upper bit, as rounding alone would not have it.
                let upper = 1 << (alpha_bits - 1);
                let alpha = |texel: &Stored| {
                    let value = (texel[3] / 255.0 * most).round() as u8;
                    if is_opaque(texel) { value.max(upper) } else { value.min(upper - 1) }
                };
                texels.iter().map(alpha).collect()
            },
            psnr_db: f64::INFINITY,
            color: format.color,
            alpha_bits,
        };
        texture.psnr_db = texture.psnr(&texels[..width * height]);
        texture
    }

    /// The value of a texel in steps of 8 bits: red, green, blue and alpha. Its number counts
    /// through all levels.
    #[must_use]
    pub fn rgba(&self, texel: usize) -> [f64; 4] {
        let value = self.texels[texel];
        let number = self.palette.get(value as usize).map_or(value, |&number| number);
        let [red, green, blue] = self.color.rgb(number);
        let alpha = match self.alpha.get(texel) {
            Some(&alpha) => f64::from(alpha) * 255.0 / f64::from((1_u32 << self.alpha_bits) - 1),
            None if self.key == Some(value) => 0.0,
            None => 255.0,
        };
        [red, green, blue, alpha]
    }

    /// The bytes that it takes in flash.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        let colors = (self.palette.len()) * self.color.bytes();
        let texels = match self.bits() {
            None => self.texels.len() * self.color.bytes(),
            Some(bits) => (self.texels.len() * bits).div_ceil(8),
        };
        texels + colors + (self.alpha.len() * self.alpha_bits).div_ceil(8)
    }

    /// The bits of a place in the palette; `None` without one.
    const fn bits(&self) -> Option<usize> {
        match self.palette.len() {
            0 => None,
            colors => Some(colors.ilog2() as usize),
        }
    }

    /// The bytes of the places in the palette, the leftmost texel in the least significant bits;
    /// `None` without a palette.
    pub(in super::super) fn packed(&self) -> Option<Vec<u8>> {
        let bits = self.bits()?;
        Some(packed(self.texels.iter().map(|&place| place as u8), bits))
    }

    /// The bytes of the alpha plane, in the same order.
    pub(in super::super) fn packed_alpha(&self) -> Vec<u8> {
        packed(self.alpha.iter().copied(), self.alpha_bits)
    }

    /// How near the first texels are to what they stand for: the peak signal-to-noise ratio of
    /// those that stand for opaque ones, in dB. Infinite if they are equal.
    #[must_use]
    pub fn psnr(&self, exact: &[[f64; 4]]) -> f64 {
        let (mut sum, mut count) = (0.0, 0);
        for (texel, exact) in exact.iter().enumerate().filter(|(_, exact)| exact[3] >= HALF) {
            let stored = self.rgba(texel);
            sum += (0..3).map(|i| (stored[i] - exact[i]).powi(2)).sum::<f64>();
            count += 3;
        }
        // What rounding of f64 leaves of equal values is no difference.
        let mean = if count == 0 { 0.0 } else { sum / f64::from(count) };
        if mean < 1e-12 { f64::INFINITY } else { 10.0 * (255.0 * 255.0 / mean).log10() }
    }
}

/// The least alpha of a texel that is drawn.
pub(super) const HALF: f64 = 127.5;

/// Values of 1, 2, 4 or 8 bits as bytes, the first value in the least significant bits.
fn packed(values: impl Iterator<Item = u8>, bits: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (place, value) in values.enumerate() {
        let shift = place * bits % 8;
        if shift == 0 {
            bytes.push(0);
        }
        if let Some(byte) = bytes.last_mut() {
            *byte |= value << shift;
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::{super::resample::Light, *};

    fn texture(pixels: &[[u16; 4]], texels: TexelFormat, alpha: Option<AlphaFormat>) -> Texture {
        colored(pixels, texels, ColorFormat::Rgb888, alpha)
    }

    fn colored(
        pixels: &[[u16; 4]],
        texels: TexelFormat,
        color: ColorFormat,
        alpha: Option<AlphaFormat>,
    ) -> Texture {
        let size = [pixels.len(), 1];
        let pixels = pixels.iter().map(|pixel| pixel.map(|value| value * 257)).collect();
        let picture = Picture { size, pixels };
        let stored = Light::of(&picture, size).stored();
        Texture::new(Path::new("a.png"), picture, &stored, size, Format { texels, color, alpha })
    }

    fn rgba(texture: &Texture) -> Vec<[f64; 4]> {
        (0..texture.texels.len()).map(|texel| texture.rgba(texel).map(f64::round)).collect()
    }

    const ROW: [[u16; 4]; 4] = [[0, 0, 0, 255], [9, 8, 7, 127], [255, 0, 255, 128], [1, 2, 3, 0]];

    #[test]
    fn bits_fill_bytes_from_the_least_significant_on() {
        assert_eq!(packed([1, 0, 1, 1, 0, 0, 0, 0, 1].into_iter(), 1), [0b0000_1101, 1]);
        assert_eq!(packed([1, 2, 3, 0, 3].into_iter(), 2), [0b0011_1001, 3]);
        assert_eq!(packed([0xA, 0xB, 0xC].into_iter(), 4), [0xBA, 0x0C]);
        assert_eq!(packed([1, 255].into_iter(), 8), [1, 255]);
    }

    #[test]
    fn opaque_pictures_come_back() {
        let opaque = ROW.map(|[r, g, b, _]| [r, g, b, 255]);
        for texels in [TexelFormat::Direct, TexelFormat::Indexed8, TexelFormat::Indexed2] {
            let texture = texture(&opaque, texels, None);
            assert_eq!(rgba(&texture), opaque.map(|p| p.map(f64::from)), "{texels:?}");
            assert_eq!(texture.psnr_db, f64::INFINITY);
        }
        let coarse = colored(&opaque, TexelFormat::Direct, ColorFormat::Rgb565, None);
        assert!(coarse.psnr_db > 40.0 && coarse.psnr_db < 60.0, "{}", coarse.psnr_db);
        assert_eq!(coarse.texels, [0, 1 << 11 | 2 << 5 | 1, 0xF81F, 0]);
        let grey = texture(&opaque, TexelFormat::Gray4, None);
        assert_eq!(grey.texels[0], 0);
        assert_eq!(grey.palette[1], 0x11_1111);
    }

    #[test]
    fn a_key_is_no_opaque_colour() {
        let direct = texture(&ROW, TexelFormat::Direct, Some(AlphaFormat::Key));
        assert_eq!(direct.texels, [0, 0xFF_00FF, 0xFF_01FF, 0xFF_00FF]);
        assert_eq!(direct.key, Some(0xFF_00FF));
        for texels in [TexelFormat::Indexed2, TexelFormat::Indexed4, TexelFormat::Gray8] {
            let texture = texture(&ROW, texels, Some(AlphaFormat::Key));
            assert_eq!(texture.key, Some(0));
            let transparent: Vec<bool> = texture.texels.iter().map(|&place| place == 0).collect();
            assert_eq!(transparent, [false, true, false, true], "{texels:?}");
            let alpha: Vec<f64> = rgba(&texture).iter().map(|texel| texel[3]).collect();
            assert_eq!(alpha, [255.0, 0.0, 255.0, 0.0]);
        }
        // A key leaves one colour of two.
        let one = texture(&ROW, TexelFormat::Indexed1, Some(AlphaFormat::Key));
        assert_eq!(one.texels, [1, 0, 1, 0]);
    }

    #[test]
    fn planes_keep_alpha_and_half_is_opaque_in_all_of_them() {
        let alpha = |format| {
            let texture = texture(&ROW, TexelFormat::Indexed8, Some(format));
            (texture.alpha.clone(), texture.packed_alpha())
        };
        assert_eq!(alpha(AlphaFormat::Bits1), (vec![1, 0, 1, 0], vec![0b0101]));
        assert_eq!(alpha(AlphaFormat::Bits4), (vec![15, 7, 8, 0], vec![0x7F, 0x08]));
        assert_eq!(alpha(AlphaFormat::Bits8).0, [255, 127, 128, 0]);
    }

    #[test]
    fn bytes_are_those_of_all_tables() {
        let bytes = |texels, color, alpha| colored(&ROW, texels, color, alpha).bytes();
        assert_eq!(bytes(TexelFormat::Direct, ColorFormat::Rgb565, None), 8);
        assert_eq!(bytes(TexelFormat::Direct, ColorFormat::Rgb888, None), 16);
        assert_eq!(bytes(TexelFormat::Indexed8, ColorFormat::Rgb565Be, None), 4 + 512);
        let masked = bytes(TexelFormat::Indexed1, ColorFormat::Gray8, Some(AlphaFormat::Bits4));
        assert_eq!(masked, 1 + 2 + 2);
    }
}
