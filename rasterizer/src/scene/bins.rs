//! Which triangles reach which band of rows, found out once a frame.
//!
//! A banded frame would visit every triangle in every band, although most touch one or two. One bit
//! per triangle and band records which. Its size is known in advance, and mesh order is kept, so
//! depth ties and frames without depth match the unbanded frame.

use core::ops::Range;

use super::{Mode, Order, ProjectError, Projected, Vertices, order::Sequence};
use crate::{
    geometry::Projection,
    numbers::{divide, leading_zeros},
    raster::Window,
    shade::{OnScreen, Shader},
};

/// Returns the number of words that [`Projected::binned`] needs for `triangle_count` triangles in
/// bands of `band_rows` rows of a viewport.
#[must_use]
pub const fn bin_words(triangle_count: usize, viewport_rows: u32, band_rows: u32) -> usize {
    let band_rows = if band_rows == 0 { 1 } else { band_rows };
    triangle_count.div_ceil(32) * viewport_rows.div_ceil(band_rows) as usize
}

/// The triangles of an object by the bands of rows that they reach: what
/// [`Projected::binned`] makes.
#[derive(Clone, Copy, Debug)]
pub struct Bins<'b> {
    /// For each 32 triangles a word for each band. The most significant bit is the first
    /// triangle's.
    words: &'b [u32],
    bands: BandMap,
}

impl<'a, V, P, Sh, M> Projected<'a, V, P, Sh, M>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Sorts the triangles into bands of `band_rows` rows each, at least one, from the viewport's
    /// top: after that a target is drawn without a look at the triangles that do not reach the
    /// bands that it lies in.
    ///
    /// Targets may be any rows; bands like those of the bins take the least time. [`bin_words`]
    /// counts the words that `storage` must have.
    ///
    /// # Errors
    ///
    /// If the storage is too small.
    pub fn binned<'b>(
        self,
        band_rows: u32,
        storage: &'b mut [u32],
    ) -> Result<Projected<'a, V, P, Sh, M, Bins<'b>>, ProjectError> {
        let seen = &self.seen;
        let viewport = seen.viewport;
        let bands = BandMap::new((viewport.bottom - viewport.top) as u32, band_rows);
        let needed = seen.triangle_count().div_ceil(32) * bands.count;
        let words = storage.get_mut(..needed).ok_or(ProjectError::BinStorage { needed })?;
        words.fill(0);
        seen.for_each_touching(|index, touched| {
            let first = index / 32 * bands.count;
            let reached = bands.reached(touched, &viewport);
            if let Some(words) = words.get_mut(first + reached.start..first + reached.end) {
                mark(words, FIRST >> (index % 32));
            }
        });
        Ok(Projected { seen: self.seen, order: Bins { words, bands } })
    }
}

impl Order for Bins<'_> {}

impl<'b> Sequence for Bins<'b> {
    /// The bands that a window reaches.
    type Reach = Range<usize>;
    type Indices<'s>
        = Marked<'b>
    where
        Self: 's;

    #[inline(always)]
    fn reach(&self, window: &Window, viewport: &Window) -> Range<usize> {
        self.bands.reached(window, viewport)
    }

    #[inline(always)]
    fn indices(&self, run: Range<usize>, reach: &Range<usize>) -> Marked<'b> {
        Marked::new(self.words, self.bands.count, reach, run)
    }
}

/// The bit of the first triangle in a word.
const FIRST: u32 = 1 << 31;

/// Sets a bit of some words.
// codegen: not inlined, because its loop is unrolled.
#[inline(never)]
fn mark(words: &mut [u32], bit: u32) {
    for word in words {
        *word |= bit;
    }
}

/// The viewport's rows in bands of equal height, the last one cut short.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct BandMap {
    count: usize,
    /// A row's band is ⌊row `multiplier` / 2^`shift`⌋.
    multiplier: u32,
    shift: u32,
}

impl BandMap {
    /// For a viewport of up to 2^11 rows.
    ///
    /// With n = 20 + ⌊log2 height⌋ and m = ⌈2^n / height⌉, m height - 2^n = e < height: row m / 2^n
    /// is row / height plus row e / (2^n height), which stays below 1 / height, and so below
    /// the next integer, as row e < 2^11 height < 2^n. All of it fits 32 bits: m <= 2^20, and n
    /// <= 31.
    const fn new(viewport_rows: u32, band_rows: u32) -> Self {
        let height = if band_rows == 0 {
            1
        } else if band_rows > viewport_rows {
            viewport_rows
        } else {
            band_rows
        };
        // Not `ilog2`, which has a panic for 0.
        let shift = 20 + 31 - leading_zeros(height | 1);
        Self {
            count: divide(viewport_rows + height - 1, height) as usize,
            multiplier: divide((1 << shift) + height - 1, height),
            shift,
        }
    }

    const fn of(self, row: i32) -> usize {
        ((row as u32 * self.multiplier) >> self.shift) as usize
    }

    /// The bands that a window inside the viewport reaches.
    const fn reached(self, window: &Window, viewport: &Window) -> Range<usize> {
        self.of(window.top - viewport.top)..self.of(window.bottom - 1 - viewport.top) + 1
    }
}

/// The triangles of a run that reach one of some bands, in order.
#[derive(Clone, Debug)]
pub struct Marked<'b> {
    words: &'b [u32],
    /// Words per group of 32 triangles: the number of bands.
    stride: usize,
    /// The words of the bands for the next group.
    next: Range<usize>,
    /// The unvisited bits of the current group, and the index of its first triangle.
    word: u32,
    base: usize,
    end: usize,
}

impl<'b> Marked<'b> {
    fn new(words: &'b [u32], stride: usize, bands: &Range<usize>, run: Range<usize>) -> Self {
        let from = run.start / 32 * stride;
        let mut marked = Self {
            words,
            stride,
            next: from + bands.start..from + bands.end,
            word: 0,
            base: run.start & !31,
            end: run.end,
        };
        marked.word = marked.load().unwrap_or_default() & u32::MAX >> (run.start % 32);
        marked
    }

    /// The triangles of 32 that reach one of the bands.
    #[inline(always)]
    fn load(&mut self) -> Option<u32> {
        let words = self.words.get(self.next.clone())?;
        self.next = self.next.start + self.stride..self.next.end + self.stride;
        Some(words.iter().fold(0, |all, word| all | word))
    }
}

impl Iterator for Marked<'_> {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        while self.word == 0 {
            self.base += 32;
            if self.base >= self.end {
                return None;
            }
            self.word = self.load()?;
        }
        let place = leading_zeros(self.word);
        self.word &= !(FIRST >> place);
        let index = self.base + place as usize;
        (index < self.end).then_some(index)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    #[test]
    fn every_row_is_in_its_band() {
        for rows in [1, 2, 3, 47, 240, 2047, 2048] {
            for height in 1..=rows + 1 {
                let bands = BandMap::new(rows, height);
                assert_eq!(bands.count, rows.div_ceil(height) as usize);
                for row in 0..rows {
                    assert_eq!(
                        bands.of(row as i32),
                        (row / height) as usize,
                        "row {row} by {height}"
                    );
                }
            }
        }
        assert_eq!(BandMap::new(10, 0), BandMap::new(10, 1));
        assert_eq!(bin_words(33, 10, 0), bin_words(33, 10, 1));
    }

    #[test]
    fn runs_begin_and_end_anywhere() {
        // Two bands of 100 triangles: the multiples of 3, the multiples of 5.
        let mut words = [0u32; 8];
        for triangle in 0..100 {
            for (band, step) in [3, 5].into_iter().enumerate() {
                if triangle % step == 0 {
                    words[triangle / 32 * 2 + band] |= FIRST >> (triangle % 32);
                }
            }
        }
        for start in 0..=100 {
            for end in start..=100 {
                for (bands, steps) in [(0..1, [3, 3]), (1..2, [5, 5]), (0..2, [3, 5])] {
                    let got: Vec<_> = Marked::new(&words, 2, &bands, start..end).collect();
                    let want: Vec<_> = (start..end)
                        .filter(|triangle| steps.iter().any(|step| triangle % step == 0))
                        .collect();
                    assert_eq!(got, want, "{start}..{end} in {bands:?}");
                }
            }
        }
    }
}
