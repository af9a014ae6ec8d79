//! Runs of pixels of one colour.

use core::hint::black_box;

use super::depth::roll;
use crate::numbers::HAS_UNALIGNED_WORDS;

/// A colour, ready to be stored many times.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fill<C> {
    color: C,
    /// Twice the colour, without the compiler's knowing that they are equal: it copies them at once then, which for 16 bits
    /// each is one word.
    pair: [C; 2],
}

impl<C: Copy> Fill<C> {
    #[inline(always)]
    pub(super) const fn new(color: C) -> Self {
        Self {
            color,
            pair: black_box([color; 2]),
        }
    }

    /// Sets all pixels of a run, in 0.6 to 1.2 instructions each if it is long.
    #[inline(always)]
    pub(super) fn run(self, pixels: &mut [C]) {
        // As many as the shortest instructions of ARMv6-M reach from one address.
        let (blocks, rest) = pixels.as_chunks_mut::<32>();
        for block in blocks {
            roll();
            self.block(block);
        }
        if rest.len() < 16 {
            for pixel in rest {
                roll();
                *pixel = self.color;
            }
            return;
        }
        // Two blocks that may overlap, rather than one and the rest of the rest pixel by pixel.
        if let Some(first) = rest.first_chunk_mut::<16>() {
            self.block(first);
        }
        if let Some(last) = rest.last_chunk_mut::<16>() {
            // Addressed from its own start: no core reaches backwards from the end of the rest.
            self.block(black_box(last));
        }
    }

    /// The same in a function of its own, for what is set once a frame.
    #[inline(never)]
    pub(super) fn all(self, pixels: &mut [C]) {
        self.run(pixels);
    }

    #[inline(always)]
    fn block<const N: usize>(self, block: &mut [C; N]) {
        if HAS_UNALIGNED_WORDS {
            let (pairs, _) = block.as_chunks_mut();
            pairs.iter_mut().for_each(|pixels| *pixels = self.pair);
        } else {
            *block = [self.color; N];
        }
    }
}
