//! Sorting triangles by distance in a word for each: a key and a number.
//!
//! The number of a triangle has as many bits as the largest needs, the key the rest: with 6,000
//! triangles 13 bits and 19. Keys are distances that are measured first, so that they make use of
//! all their bits. Numbers may count the triangles of one object or of several, if the distances
//! have one unit.

use core::cell::Cell;

use crate::numbers::leading_zeros;

/// The distances that are sorted: from the least to the greatest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Distances {
    least: i32,
    greatest: i32,
}

impl Distances {
    /// No distance yet.
    pub(super) const NONE: Self = Self { least: i32::MAX, greatest: i32::MIN };

    /// With one more.
    #[inline(always)]
    pub(super) fn with(self, distance: i32) -> Self {
        Self { least: self.least.min(distance), greatest: self.greatest.max(distance) }
    }
}

/// How a word holds a key and a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Packing {
    /// The distance whose key is 0.
    greatest: i32,
    /// The bits of a distance that have no room in the key.
    drop_bits: u32,
    number_bits: u32,
}

impl Packing {
    /// For these distances, and numbers below `count`.
    #[inline(always)]
    pub(super) const fn new(distances: Distances, count: usize) -> Self {
        let range = distances.greatest.wrapping_sub(distances.least).cast_unsigned();
        let number_bits = bits(count as u32);
        // Not below 0: both have at most 32 bits.
        let drop_bits = (bits(range) + number_bits).saturating_sub(32);
        Self { greatest: distances.greatest, drop_bits, number_bits }
    }

    /// The word of a triangle: the lesser, the farther away it is; of those whose keys are equal,
    /// the lesser, the lesser the number.
    #[inline(always)]
    pub(super) const fn word(self, distance: i32, number: usize) -> u32 {
        let nearer = self.greatest.wrapping_sub(distance).cast_unsigned();
        (nearer >> (self.drop_bits & 31)) << (self.number_bits & 31) | number as u32
    }

    /// The number in a word.
    #[inline(always)]
    pub(super) const fn number(self, word: u32) -> usize {
        (word & ((1 << (self.number_bits & 31)) - 1)) as usize
    }
}

/// The binary digits of a number.
const fn bits(number: u32) -> u32 {
    if number == 0 { 0 } else { 32 - leading_zeros(number) }
}

/// Sorts words in ascending order: by their first digit, then each part by the next (binary radix
/// exchange: Hildebrandt and Isbitz, *Radix Exchange*, Journal of the ACM 6(2), 1959).
///
/// It needs no memory besides a stack of at most log2 n calls, and visits each word at most 32
/// times, most often log2 n times and a few.
pub(super) fn sort(words: &mut [u32]) {
    sort_from(words, 1 << 31);
}

// codegen: not inlined, because it calls itself; and the sort of `core` has ways for any input that
// take 3 KB of flash.
#[inline(never)]
fn sort_from(mut words: &mut [u32], mut bit: u32) {
    while bit != 0 && words.len() > 1 {
        let zeros = partition(words, bit);
        let (low, high) = words.split_at_mut_checked(zeros).unwrap_or_default();
        bit >>= 1;
        // The shorter part by a call, so that calls are nested log2 n deep at most.
        let (shorter, longer) = if low.len() < high.len() { (low, high) } else { (high, low) };
        sort_from(shorter, bit);
        words = longer;
    }
}

/// Moves words without a bit before those that have it. Returns the number of those without.
#[inline(always)]
fn partition(words: &mut [u32], bit: u32) -> usize {
    let cells = Cell::from_mut(words).as_slice_of_cells();
    let (mut low, mut high) = (0, cells.len());
    while low < high {
        let (Some(front), Some(back)) = (cells.get(low), cells.get(high - 1)) else { break };
        let (first, last) = (front.get(), back.get());
        if first & bit == 0 {
            low += 1;
        } else if last & bit != 0 {
            high -= 1;
        } else {
            front.set(last);
            back.set(first);
            low += 1;
            high -= 1;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::random::Random;

    #[test]
    fn words_are_sorted_as_by_the_standard_library() {
        let mut random = Random::new(21);
        for count in (0..70).chain([1_000, 5_856]) {
            // Any words, few different ones, and such as differ in their upper or lower bits alone.
            for (mask, set) in [(u32::MAX, 0), (0x8000_0003, 0), (0xFFFF, 7 << 24), (!0xFF, 0)] {
                let mut words: Vec<u32> =
                    (0..count).map(|_| random.bits() as u32 & mask | set).collect();
                let mut wanted = words.clone();
                wanted.sort_unstable();
                sort(&mut words);
                assert!(words == wanted, "{count} words of {mask:x}");
                // Sorted ones stay.
                sort(&mut words);
                assert!(words == wanted, "{count} sorted words of {mask:x}");
                words.reverse();
                sort(&mut words);
                assert!(words == wanted, "{count} words of {mask:x} in reverse");
            }
        }
    }

    #[test]
    fn the_farthest_comes_first_and_ties_keep_their_order() {
        let mut random = Random::new(22);
        for (least, greatest) in [(i32::MIN, i32::MAX), (-3, 3), (7, 7), (0, 1 << 20)] {
            for count in [1, 2, 3, 1_000, 1_024, 1_025] {
                let distances: Vec<i32> =
                    (0..count).map(|_| random.within(least, greatest)).collect();
                let range = distances.iter().fold(Distances::NONE, |all, &d| all.with(d));
                let packing = Packing::new(range, count);
                let mut words: Vec<u32> = (distances.iter().enumerate())
                    .map(|(number, &distance)| packing.word(distance, number))
                    .collect();
                sort(&mut words);
                let order: Vec<usize> = words.iter().map(|&word| packing.number(word)).collect();
                // A key drops bits that have no room.
                let step = 1i64 << packing.drop_bits;
                for pair in order.windows(2) {
                    let [a, b] = [distances[pair[0]], distances[pair[1]]].map(i64::from);
                    assert!(a > b - step, "{a} before {b} of {least}..={greatest}");
                    assert!(a != b || pair[0] < pair[1], "{a}: {pair:?}");
                }
                let mut all = order;
                all.sort_unstable();
                assert!(all.into_iter().eq(0..count), "{count} numbers");
            }
        }
    }
}
