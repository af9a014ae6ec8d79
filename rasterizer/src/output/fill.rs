//! Runs of pixels of one colour.

use bytemuck::Pod;

use crate::numbers::{
    HAS_UNALIGNED_WORDS, IS_NARROW,
    codegen::{self, keep_apart, keep_rolled},
};

/// A colour, ready to be stored many times.
pub trait Fill<C> {
    /// Of a colour: once for all runs of a triangle.
    fn new(color: C) -> Self;

    /// Sets all pixels of a run.
    fn run(&self, pixels: &mut [C]);
}

/// Fills by pixels, in 0.6 to 1.2 instructions each if a run is long: for any colour.
#[derive(Clone, Copy, Debug)]
pub struct PixelFill<C> {
    color: C,
    /// The colour twice. Opaque to the compiler, so that two 16-bit pixels are stored as one word.
    pair: [C; 2],
}

impl<C: Copy> Fill<C> for PixelFill<C> {
    #[inline(always)]
    fn new(color: C) -> Self {
        Self { color, pair: codegen::unknown([color; 2]) }
    }

    #[inline(always)]
    fn run(&self, pixels: &mut [C]) {
        // As many as the shortest instructions of ARMv6-M reach from one address.
        let (blocks, rest) = pixels.as_chunks_mut::<32>();
        for block in blocks {
            keep_rolled();
            self.block(block);
        }
        if rest.len() < 16 {
            for pixel in rest {
                keep_rolled();
                *pixel = self.color;
            }
            return;
        }
        // Two blocks that may overlap, rather than one and the rest of the rest pixel by pixel.
        if let Some(first) = rest.first_chunk_mut::<16>() {
            self.block(first);
        }
        if let Some(last) = rest.last_chunk_mut::<16>() {
            // Addressed from its own start: the shortest instructions do not reach backwards from
            // the end of the rest.
            self.block(codegen::rebased(last));
        }
    }
}

impl<C: Copy> PixelFill<C> {
    #[inline(always)]
    fn block<const N: usize>(&self, block: &mut [C; N]) {
        if HAS_UNALIGNED_WORDS {
            let (pairs, _) = block.as_chunks_mut();
            pairs.iter_mut().for_each(|pixels| *pixels = self.pair);
        } else {
            *block = [self.color; N];
        }
    }
}

/// Fills by words of two pixels, in 0.5 to 0.6 instructions a pixel if a run is long: for colours
/// of 16 bits that are plain data and lie where a `u16` may. Others do not compile.
#[derive(Clone, Copy, Debug)]
pub struct WordFill<C> {
    color: C,
    /// Twice the colour.
    word: u32,
}

impl<C: Pod> Fill<C> for WordFill<C> {
    #[inline(always)]
    fn new(color: C) -> Self {
        const {
            assert!(
                align_of::<C>() == align_of::<u16>(),
                "half a word before a run must be a whole pixel"
            );
        }
        Self { color, word: bytemuck::must_cast([color; 2]) }
    }

    #[inline(always)]
    fn run(&self, pixels: &mut [C]) {
        // The first and last pixel may lie in the middle of a word, so both are always stored on
        // their own.
        let before = pixels.as_ptr().addr() / 2 % 2;
        if let Some(first) = pixels.first_mut() {
            *first = self.color;
        }
        if let Some(last) = pixels.last_mut() {
            *last = self.color;
        }
        let Some(pixels) = pixels.get_mut(before..) else {
            return;
        };
        let (pairs, _) = pixels.as_chunks_mut::<2>();
        // They start where a word does.
        if let Ok(words) = bytemuck::try_cast_slice_mut(pairs) {
            fill_words(words, self.word);
        }
    }
}

/// Fills by words of four pixels: for colours of one byte that are plain data. Others do not
/// compile.
#[derive(Clone, Copy, Debug)]
pub struct ByteFill<C> {
    color: C,
}

impl<C: Pod> Fill<C> for ByteFill<C> {
    #[inline(always)]
    fn new(color: C) -> Self {
        const { assert!(size_of::<C>() == 1, "a pixel must be a byte") }
        Self { color }
    }

    #[inline(always)]
    fn run(&self, pixels: &mut [C]) {
        if let (Ok(bytes), Ok(byte)) =
            (bytemuck::try_cast_slice_mut(pixels), bytemuck::try_cast(self.color))
        {
            fill_bytes(bytes, byte);
        }
    }
}

/// Sets all bytes: whole words, and what lies before and after them.
#[inline(always)]
pub(super) fn fill_bytes(bytes: &mut [u8], value: u8) {
    let (before, words, after) = bytemuck::pod_align_to_mut::<u8, u32>(bytes);
    for byte in before {
        keep_rolled();
        *byte = value;
    }
    fill_words(words, u32::from(value) * 0x0101_0101);
    for byte in after {
        keep_rolled();
        *byte = value;
    }
}

#[inline(always)]
fn fill_words(words: &mut [u32], value: u32) {
    if words.len() < 8 {
        for word in words {
            keep_rolled();
            *word = value;
        }
        return;
    }
    let mut rest = &mut *words;
    // As many as the shortest instructions of ARMv6-M reach from one address.
    while let Some(block) = rest.split_off_mut(..32) {
        keep_rolled();
        fill_each(block, value);
    }
    if let Some(block) = rest.split_off_mut(..16) {
        fill_each(block, value);
    }
    if let Some(block) = rest.first_chunk_mut::<8>() {
        fill_each(block, value);
    }
    // A block that may overlap, rather than the rest word by word.
    if let Some(last) = words.last_chunk_mut::<8>() {
        // Addressed from its own start where a core does not reach backwards from the end.
        let last = if IS_NARROW { codegen::rebased(last) } else { last };
        fill_each(last, value);
    }
}

#[inline(always)]
fn fill_each(words: &mut [u32], value: u32) {
    for word in words {
        *word = value;
        keep_apart();
    }
}

/// Sets all pixels, once a frame or a band.
// codegen: not inlined, because it is done rarely.
#[inline(never)]
pub(super) fn fill_all<C, F: Fill<C>>(fill: F, pixels: &mut [C]) {
    fill.run(pixels);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs of all lengths up to some blocks, from all places in a word: in full, and nothing
    /// beside them.
    fn fills<C: Copy + Default + PartialEq + core::fmt::Debug, F: Fill<C>>(color: C) {
        for start in 0..8 {
            for end in start..=start + 290 {
                let mut pixels = [C::default(); 300];
                F::new(color).run(&mut pixels[start..end]);
                for (at, &pixel) in pixels.iter().enumerate() {
                    let want = if (start..end).contains(&at) { color } else { C::default() };
                    assert_eq!(pixel, want, "pixel {at} of {start} to {end}");
                }
            }
        }
    }

    #[test]
    fn runs_are_filled_by_pixels() {
        fills::<u16, PixelFill<u16>>(0xA55A);
    }

    #[test]
    fn runs_are_filled_by_words() {
        fills::<u16, WordFill<u16>>(0xA55A);
    }

    #[test]
    fn runs_are_filled_by_bytes() {
        fills::<u8, ByteFill<u8>>(0xA5);
    }
}
