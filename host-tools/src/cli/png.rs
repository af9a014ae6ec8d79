//! PNG files, still and animated.

use anyhow::Result;
use png::{BitDepth, ColorType, Encoder};

use super::{animation::Timing, image::Image};

/// The value of the keyword "Software" in every picture of this program.
const SOFTWARE: &str = concat!("host-tools ", env!("CARGO_PKG_VERSION"));

/// Whether a file that begins with these bytes is a picture of this program, of any version.
pub(super) fn is_ours(start: &[u8]) -> bool {
    /// The type of a text chunk, its keyword, and how every version begins the text.
    const MARK: &[u8] = b"tEXtSoftware\0host-tools ";
    start.starts_with(b"\x89PNG\r\n\x1a\n") && start.windows(MARK.len()).any(|part| part == MARK)
}

/// The bytes of a PNG file of one picture.
pub(super) fn still(image: &Image) -> Result<Vec<u8>> {
    animation(image.size, Timing::STILL, std::iter::once(Ok(image.clone())))
}

/// The bytes of a PNG file that repeats its frames without end, or of an ordinary PNG file for one
/// frame.
///
/// Viewers without support for animations (PNG specification, third edition, 2025) show the first
/// frame.
pub(super) fn animation(
    [width, height]: [u32; 2],
    timing: Timing,
    images: impl Iterator<Item = Result<Image>>,
) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.add_text_chunk("Software".into(), SOFTWARE.into())?;
    if timing.frames > 1 {
        encoder.set_animated(timing.frames, 0)?;
        let [seconds, parts] = timing.delay;
        encoder.set_frame_delay(seconds, parts)?;
    }
    let mut writer = encoder.write_header()?;
    for image in images {
        writer.write_image_data(image?.rgb.as_flattened())?;
    }
    writer.finish()?;
    Ok(bytes)
}
