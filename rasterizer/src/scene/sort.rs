//! Sorting triangles by distance in a word for each: a key and a number.
//!
//! The number of a triangle has as many bits as the largest needs, the key the rest: with 6,000
//! triangles 13 bits and 19. Keys count from the farthest distance that there can be, so that they
//! make use of all their bits. Numbers count the triangles of one object or of several.

use core::cell::Cell;

use crate::numbers::leading_zeros;

/// The distances that there can be: from the least to the greatest, in multiples of 2^`unit`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Distances {
    least: i32,
    greatest: i32,
    unit: i32,
}

impl Distances {
    /// None.
    pub(super) const NONE: Self = Self { least: i32::MAX, greatest: i32::MIN, unit: i32::MIN };

    /// From the least to the greatest.
    pub(super) const fn between([least, greatest]: [i32; 2], unit: i32) -> Self {
        Self { least, greatest, unit }
    }

    /// Both of these, in the coarser unit.
    // codegen: not inlined, because it is called for each object of a scene, once a frame.
    #[inline(never)]
    pub(super) fn and(self, other: Self) -> Self {
        let unit = self.unit.max(other.unit);
        let [a, b] = [self, other].map(|one| {
            if one == Self::NONE {
                return one;
            }
            let shift = shift_between(one.unit, unit);
            Self { least: one.least >> shift, greatest: one.greatest >> shift, unit }
        });
        Self { least: a.least.min(b.least), greatest: a.greatest.max(b.greatest), unit }
    }
}

/// By how many bits a number of a finer unit is shifted down for a coarser one.
fn shift_between(finer: i32, coarser: i32) -> u32 {
    coarser.wrapping_sub(finer).clamp(0, 31).cast_unsigned()
}

/// How a word holds a key and a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Packing {
    /// The distances that have keys.
    distances: Distances,
    /// The bits of a distance that have no room in the key.
    drop_bits: u32,
    number_bits: u32,
    /// Ones in a number's bits.
    number_mask: u32,
}

impl Packing {
    /// For these distances, and numbers below `count`.
    pub(super) const fn new(distances: Distances, count: usize) -> Self {
        let range = distances.greatest.wrapping_sub(distances.least).cast_unsigned();
        let number_bits = bits(count as u32);
        // Not below 0: both have at most 32 bits.
        let drop_bits = (bits(range) + number_bits).saturating_sub(32);
        let number_mask = (1 << (number_bits & 31)) - 1;
        Self { distances, drop_bits, number_bits, number_mask }
    }

    /// For an object whose distances, some of these, are told from `zero`.
    pub(super) fn of_object(self, own: Distances, zero: i32) -> ObjectPacking {
        let shift = shift_between(own.unit, self.distances.unit);
        let before = self.distances.greatest.wrapping_sub(own.greatest >> shift).cast_unsigned();
        ObjectPacking { packing: self, greatest: own.greatest.wrapping_add(zero), shift, before }
    }

    /// The number in a word.
    #[inline(always)]
    pub(super) const fn number(self, word: u32) -> usize {
        (word & self.number_mask) as usize
    }
}

/// How words hold the keys of an object.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPacking {
    packing: Packing,
    /// The greatest distance of the object.
    greatest: i32,
    /// By how much finer the object's unit is, in bits.
    shift: u32,
    /// How much farther away the farthest of all objects is.
    before: u32,
}

impl ObjectPacking {
    /// The word of a triangle: the lesser, the farther away it is; of those whose keys are equal,
    /// the lesser, the lesser the number.
    #[inline(always)]
    pub(super) const fn word(self, distance: i32, number: usize) -> u32 {
        let Packing { drop_bits, number_bits, .. } = self.packing;
        let nearer = self.greatest.wrapping_sub(distance).cast_unsigned() >> (self.shift & 31);
        let key = self.before.wrapping_add(nearer) >> (drop_bits & 31);
        key << (number_bits & 31) | number as u32
    }
}

/// The binary digits of a number.
const fn bits(number: u32) -> u32 {
    if number == 0 { 0 } else { 32 - leading_zeros(number) }
}

/// Objects whose triangles are sorted together.
pub trait Members {
    /// How many they are.
    const COUNT: usize;

    /// Of all meshes.
    fn triangle_count(&self) -> usize;

    /// The distances that triangles can have.
    fn distances(&self) -> Distances;

    /// Puts the words of the triangles that are seen into the first of `words`, and returns
    /// how many they are. Numbers count from `first`.
    fn write_words(&self, words: &mut [u32], packing: Packing, first: usize) -> usize;

    /// The object of a triangle's number, and its place in the mesh.
    fn locate(&self, number: usize) -> (usize, usize);
}

/// Buckets of the first pass: by 8 bits.
const BUCKETS: usize = 256;

/// Parts up to this length are left to insertion, which moves a word by a quarter of its part on
/// average.
const SHORT: usize = 24;

/// Sorts words in ascending order: by the first 8 of the bits that they use, each part by the next
/// bits, and the short parts by insertion. In place, with 512 bytes of stack (the American flag
/// sort of *Engineering Radix Sort*, Computing Systems 6(1), 1993).
///
/// Of any words, each is visited at most 32 times and moved at most 23 places by insertion.
pub(super) fn sort(words: &mut [u32]) {
    distribute(words);
    insert(words);
}

/// Moves words into buckets by the first bits that they use, and sorts long buckets by the next.
// codegen: not inlined, so that the buckets leave the stack.
#[inline(never)]
fn distribute(words: &mut [u32]) {
    let used = words.iter().fold(0, |used, &word| used | word);
    let Ok(count) = u16::try_from(words.len()) else {
        return sort_from(words, 1 << 31);
    };
    if usize::from(count) <= SHORT || used == 0 {
        return;
    }
    // Of 8 bits or fewer, the last ones are the bucket.
    let shift = (32 - leading_zeros(used)).saturating_sub(BUCKETS.ilog2()) & 31;
    let bucket = |word: u32| (word >> shift) as usize % BUCKETS;
    // The place behind the last word that a bucket lacks.
    let mut ends = [0u16; BUCKETS];
    for &word in &*words {
        ends[bucket(word)] += 1;
    }
    let mut end = 0;
    for count in &mut ends {
        end += *count;
        *count = end;
    }
    let cells = Cell::from_mut(words).as_slice_of_cells();
    let mut place = 0;
    while let Some(here) = cells.get(place) {
        let end = &mut ends[bucket(here.get())];
        if usize::from(*end) <= place {
            place += 1;
            continue;
        }
        *end -= 1;
        let Some(there) = cells.get(usize::from(*end)) else { break };
        here.swap(there);
    }
    // Now each end is its bucket's first place.
    let mut rest = words;
    for &first in ends.iter().rev() {
        let (before, bucket) = rest.split_at_mut_checked(first.into()).unwrap_or_default();
        if shift > 0 {
            sort_from(bucket, 1 << (shift - 1));
        }
        rest = before;
    }
}

/// Sorts words that are in parts of [`SHORT`] words at most, of which no word belongs to another.
fn insert(words: &mut [u32]) {
    let cells = Cell::from_mut(words).as_slice_of_cells();
    for end in 1..cells.len() {
        let Some((last, before)) = cells.get(..=end).and_then(<[_]>::split_last) else { break };
        let word = last.get();
        let mut hole = last;
        for cell in before.iter().rev() {
            if cell.get() <= word {
                break;
            }
            hole.set(cell.get());
            hole = cell;
        }
        hole.set(word);
    }
}

/// Brings words in order by a bit and those below it, but for parts of [`SHORT`] words: by their
/// first digit, then each part by the next (binary radix exchange: Hildebrandt and Isbitz, *Radix
/// Exchange*, Journal of the ACM 6(2), 1959). Calls are nested at most log2 n deep.
// codegen: not inlined, because it calls itself; and the sort of `core` has ways for any input that
// take 3 KB of flash.
#[inline(never)]
fn sort_from(mut words: &mut [u32], mut bit: u32) {
    while bit != 0 && words.len() > SHORT {
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
        for count in (0..70).chain([1_000, 5_856, 65_535, 65_536]) {
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
                let range = distances.iter().fold(Distances::NONE, |all, &distance| {
                    all.and(Distances::between([distance; 2], 0))
                });
                let packing = Packing::new(range, count);
                // Told from another zero, as the distances of an object are.
                let zero = random.bits() as i32;
                let own = packing.of_object(range, zero);
                let mut words: Vec<u32> = (distances.iter().enumerate())
                    .map(|(number, &distance)| own.word(distance.wrapping_add(zero), number))
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
