//! A picture as its file has it: PNG or JPEG.

use std::{io::Cursor, path::Path};

use zune_jpeg::{
    JpegDecoder,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

/// The longest side of a picture. Its texels take half a gigabyte.
const MAX_SIDE: usize = 8_192;

/// A decoded picture, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Its width and height.
    pub size: [usize; 2],
    /// Red, green, blue and alpha of each pixel as stored (sRGB), in 65,535ths.
    pub pixels: Vec<[u16; 4]>,
}

impl Picture {
    /// A pixel in steps of 8 bits, 0 to 255: red, green, blue and alpha.
    #[must_use]
    pub fn rgba(&self, x: usize, y: usize) -> [f64; 4] {
        self.pixels[y * self.size[0] + x].map(|value| f64::from(value) / 257.0)
    }

    /// Reads a PNG or JPEG file.
    ///
    /// # Errors
    ///
    /// Returns a message that names the file and what is wrong with it.
    pub fn load(path: &Path) -> Result<Self, String> {
        read(path).map(|(picture, _)| picture)
    }

    /// The colours of a picture of another size that this one fills, row by row: its middle, as
    /// much of it as has the same proportions, filtered in linear light. Where it is transparent,
    /// black shows through.
    ///
    /// # Panics
    ///
    /// Panics if a side is 0.
    #[must_use]
    pub fn filling(&self, size: [usize; 2]) -> Vec<[u8; 3]> {
        let [width, height] = self.size;
        // Of each side as much as the other one allows.
        let part = |side: usize, other: usize, wanted: usize, of: usize| {
            side.min((other * wanted).div_ceil(of))
        };
        let kept = [part(width, height, size[0], size[1]), part(height, width, size[1], size[0])];
        let first = [(width - kept[0]) / 2, (height - kept[1]) / 2];
        let rows = self.pixels.chunks_exact(width).skip(first[1]).take(kept[1]);
        let pixels = rows.flat_map(|row| &row[first[0]..first[0] + kept[0]]).copied().collect();
        let light = super::resample::Light::of(&Self { size: kept, pixels }, size);
        let over_black = |[red, green, blue, alpha]: [f64; 4]| {
            [red, green, blue].map(|c| (c * alpha / 255.0).round() as u8)
        };
        light.stored().into_iter().map(over_black).collect()
    }

    /// Decodes a file. The error is what follows the name of the picture in a message.
    pub(in super::super) fn decode(bytes: &[u8]) -> Result<Self, String> {
        if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            png(bytes).map_err(|error| format!("is a broken PNG file ({error}): save it again"))?
        } else if bytes.starts_with(b"\xFF\xD8\xFF") {
            jpeg(bytes)
                .map_err(|error| format!("is a broken JPEG file ({error}): save it again"))?
        } else {
            Err("is neither PNG nor JPEG: save it as PNG".to_owned())
        }
    }

    /// A picture from the values of its channels: grey, grey and alpha, red, green and blue, or all
    /// four.
    fn of_channels(size: [usize; 2], values: &[u16], channels: usize) -> Self {
        let pixels = (values.chunks_exact(channels))
            .map(|c| match *c {
                [grey] => [grey, grey, grey, u16::MAX],
                [grey, alpha] => [grey, grey, grey, alpha],
                [red, green, blue] => [red, green, blue, u16::MAX],
                [red, green, blue, alpha, ..] => [red, green, blue, alpha],
                [] => [0; 4],
            })
            .collect();
        Self { size, pixels }
    }
}

/// Refuses a picture that would take too much memory.
fn sized([width, height]: [usize; 2]) -> Result<(), String> {
    if width <= MAX_SIDE && height <= MAX_SIDE {
        Ok(())
    } else {
        Err(format!("has {width}x{height} pixels, and {MAX_SIDE} a side are the most: scale it"))
    }
}

fn widened(bytes: &[u8]) -> Vec<u16> {
    bytes.iter().map(|&byte| u16::from(byte) * 257).collect()
}

fn png(bytes: &[u8]) -> Result<Result<Picture, String>, ::png::DecodingError> {
    let mut decoder = ::png::Decoder::new(Cursor::new(bytes));
    // Palettes become colours, and less than 8 bits 8.
    decoder.set_transformations(::png::Transformations::EXPAND);
    decoder.set_limits(::png::Limits { bytes: 1 << 30 });
    let size = decoder.read_header_info()?.size();
    let size = [size.0 as usize, size.1 as usize];
    if let Err(refused) = sized(size) {
        return Ok(Err(refused));
    }
    let mut reader = decoder.read_info()?;
    let mut data = vec![0; reader.output_buffer_size().unwrap_or(0)];
    let frame = reader.next_frame(&mut data)?;
    data.truncate(frame.buffer_size());
    let values = match frame.bit_depth {
        ::png::BitDepth::Sixteen => {
            data.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect()
        }
        _ => widened(&data),
    };
    Ok(Ok(Picture::of_channels(size, &values, frame.color_type.samples())))
}

fn jpeg(bytes: &[u8]) -> Result<Result<Picture, String>, zune_jpeg::errors::DecodeErrors> {
    let options = DecoderOptions::new_safe()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers()?;
    let size = decoder.dimensions().map_or([0; 2], |(width, height)| [width, height]);
    if let Err(refused) = sized(size) {
        return Ok(Err(refused));
    }
    let data = decoder.decode()?;
    Ok(Ok(Picture::of_channels(size, &widened(&data), 3)))
}

/// Reads the picture at `path`. The error is a whole message but for where it is named.
pub(super) fn read(path: &Path) -> Result<(Picture, Vec<u8>), String> {
    let bytes = super::super::source::read(path).map_err(|error| error.to_string())?;
    let picture = Picture::decode(&bytes)
        .map_err(|fault| format!("{} {fault}", super::super::quote::shown(path)))?;
    Ok((picture, bytes))
}

#[cfg(test)]
pub(in super::super) mod tests {
    use super::*;

    /// The bytes of a PNG file.
    pub(in super::super::super) fn encoded(
        [width, height]: [u32; 2],
        color: ::png::ColorType,
        depth: ::png::BitDepth,
        data: &[u8],
    ) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = ::png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if color == ::png::ColorType::Indexed {
            encoder.set_palette(&[0, 0, 0, 255, 128, 0][..]);
            encoder.set_trns(&[0][..]);
        }
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    #[test]
    fn every_kind_of_png_becomes_colours_and_alpha() {
        use ::png::{BitDepth::*, ColorType::*};
        let pixel = |color, depth, data: &[u8]| {
            let picture = Picture::decode(&encoded([1, 1], color, depth, data)).unwrap();
            assert_eq!(picture.size, [1, 1]);
            picture.rgba(0, 0)
        };
        assert_eq!(pixel(Grayscale, Eight, &[7]), [7.0, 7.0, 7.0, 255.0]);
        assert_eq!(pixel(Grayscale, Two, &[0x80]), [170.0, 170.0, 170.0, 255.0]);
        assert_eq!(pixel(GrayscaleAlpha, Eight, &[7, 9]), [7.0, 7.0, 7.0, 9.0]);
        assert_eq!(pixel(Rgb, Eight, &[1, 2, 3]), [1.0, 2.0, 3.0, 255.0]);
        assert_eq!(pixel(Rgba, Eight, &[1, 2, 3, 4]), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(pixel(Indexed, One, &[0x80]), [255.0, 128.0, 0.0, 255.0]);
        assert_eq!(pixel(Indexed, One, &[0]), [0.0; 4]);
        let exact = Picture::decode(&encoded([1, 1], Grayscale, Sixteen, &[1, 0])).unwrap();
        assert_eq!(exact.pixels, [[256, 256, 256, 65_535]]);
    }

    #[test]
    fn faults_say_what_to_do() {
        let png = encoded([9, 9], ::png::ColorType::Rgb, ::png::BitDepth::Eight, &[0; 243]);
        let fault = |bytes: &[u8]| Picture::decode(bytes).unwrap_err();
        assert!(fault(b"BM").contains("neither PNG nor JPEG: save"));
        assert!(fault(b"").contains("neither PNG nor JPEG: save"));
        assert!(fault(&png[..60]).starts_with("is a broken PNG file ("), "{}", fault(&png[..60]));
        assert!(fault(b"\xFF\xD8\xFF\xE0").starts_with("is a broken JPEG file ("));
        let wide =
            encoded([8_193, 1], ::png::ColorType::Grayscale, ::png::BitDepth::One, &[0; 1025]);
        assert!(fault(&wide).starts_with("has 8193x1 pixels"), "{}", fault(&wide));
    }
}
