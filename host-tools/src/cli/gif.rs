//! Animated GIF files.

use std::collections::HashMap;

use anyhow::Result;
use gif::{Encoder, Extension, Frame, Repeat};
use host_tools::model::choose_palette;

use super::{animation::Timing, image::Image};

/// The comment in every animation of this program.
const COMMENT: &str = concat!("host-tools ", env!("CARGO_PKG_VERSION"));

/// The type of an extension that is a comment.
const COMMENT_EXTENSION: u8 = 0xFE;

/// The colours of an animation.
const COLORS: usize = 256;

/// The most frames whose colours decide on the palette.
const SAMPLED_FRAMES: u32 = 12;

/// About how many colours the palette is chosen for, equal ones included.
const SAMPLED_COLORS: usize = 1 << 16;

/// Whether a file that begins with these bytes is an animation of this program, of any version.
pub(super) fn is_ours(start: &[u8]) -> bool {
    /// The introducer and the type of a comment, of any length, and how every version begins it.
    const TEXT: &[u8] = b"host-tools ";
    let is_comment =
        |part: &[u8]| part.starts_with(&[b'!', COMMENT_EXTENSION]) && part[3..] == *TEXT;
    start.starts_with(b"GIF89a") && start.windows(3 + TEXT.len()).any(is_comment)
}

/// How many of the frames decide on the palette: they are drawn twice.
pub(super) fn sampled_frames(frames: u32) -> u32 {
    frames.min(SAMPLED_FRAMES)
}

/// The bytes of a GIF file that repeats its frames without end. All frames share a palette, so that
/// what stands still has one colour; it is chosen from some of them.
pub(super) fn animation(
    [width, height]: [u32; 2],
    timing: Timing,
    mut image: impl FnMut(u32) -> Result<Image>,
) -> Result<Vec<u8>> {
    let sampled = sampled_frames(timing.frames);
    let mut counts: HashMap<[u8; 3], usize> = HashMap::new();
    for sample in 0..sampled {
        for color in image(sample * timing.frames / sampled)?.rgb {
            *counts.entry(color).or_default() += 1;
        }
    }
    let palette = palette(counts);
    let [width, height] = [u16::try_from(width)?, u16::try_from(height)?];
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, palette.as_flattened())?;
    encoder.set_repeat(Repeat::Infinite)?;
    encoder.write_raw_extension(Extension::Comment.into(), &[COMMENT.as_bytes()])?;
    let mut known = HashMap::new();
    for number in 0..timing.frames {
        let place = |color| *known.entry(color).or_insert_with(|| nearest(&palette, color));
        let buffer: Vec<u8> = image(number)?.rgb.into_iter().map(place).collect();
        let delay = timing.hundredths(number);
        encoder.write_frame(&Frame {
            width,
            height,
            delay,
            buffer: buffer.into(),
            ..Frame::default()
        })?;
    }
    drop(encoder);
    Ok(bytes)
}

/// The palette for colours, each with the number of its pixels.
fn palette(counts: HashMap<[u8; 3], usize>) -> Vec<[u8; 3]> {
    let mut counts: Vec<_> = counts.into_iter().collect();
    // In order, because the choice depends on it.
    counts.sort_unstable();
    let total: usize = counts.iter().map(|(_, count)| count).sum();
    let share = |count: usize| (count * SAMPLED_COLORS).div_ceil(total);
    let colors = counts.iter().flat_map(|&(color, count)| std::iter::repeat_n(color, share(count)));
    choose_palette(&colors.collect::<Vec<_>>(), COLORS)
}

/// The place of the nearest colour; the first of several.
fn nearest(palette: &[[u8; 3]], color: [u8; 3]) -> u8 {
    let distance = |entry: &[u8; 3]| -> u32 {
        entry.iter().zip(color).map(|(&a, b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let places = palette.iter().enumerate();
    places.min_by_key(|(_, entry)| distance(entry)).map_or(0, |(place, _)| place as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colors_are_kept_and_others_are_near() {
        let size = [16, 16];
        let timing = Timing { frames: 3, delay: [1, 10] };
        let few = |frame: u32| {
            let rgb = (0..256).map(|i| [(i % 80) as u8, 200, frame as u8]).collect();
            Ok(Image { size, rgb })
        };
        let bytes = animation(size, timing, few).unwrap();
        assert!(is_ours(&bytes) && !is_ours(&bytes[6..]) && !is_ours(b"GIF89a!"));
        let mut decoder = gif::DecodeOptions::new();
        decoder.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = decoder.read_info(&bytes[..]).unwrap();
        assert_eq!(decoder.repeat(), Repeat::Infinite);
        for number in 0..3 {
            let frame = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!(frame.delay, 10);
            let expected = few(number).unwrap().rgb;
            for (found, expected) in frame.buffer.chunks_exact(4).zip(expected) {
                assert_eq!(found[..3], expected);
            }
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }
}
