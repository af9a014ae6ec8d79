//! Clear cells: their pixels need no depth test.
//!
//! Depth is linear over a span, and every depth of 16 bits is nearer than a clear cell. So a loop
//! of its own stores the depths of a span's first pixels, up to the first cell that is not clear.
//! Their colours are drawn after that, without a test. Each of the two short loops has registers
//! for all that it needs; one loop for both has not.

use core::mem;

use crate::numbers::{IS_NARROW, codegen};

/// Stores the depths of the first pixels, as many as have clear cells, and returns their number.
/// Depths are in the upper halves of the numbers that are stepped.
// codegen: not inlined, because all shaders share it. Four cells at a time are read as two words:
// 4.8 instructions a pixel on the narrowest cores, and 3 on the Cortex-M4.
#[inline(never)]
pub(super) fn claim(cells: &mut [u16], mut depth: u32, step: u32) -> usize {
    let (first, words, _) = bytemuck::pod_align_to_mut::<u16, u32>(cells);
    let mut claimed = 0;
    if let Some(cell) = first.first_mut() {
        if *cell != 0 {
            return 0;
        }
        *cell = upper(depth);
        depth = depth.wrapping_add(step);
        claimed = 1;
    }
    let mut blocks = words.as_chunks_mut::<2>().0;
    claimed += 4 * blocks.len();
    let mut left = blocks.len();
    // The depth of the next pixel but one, and steps of two: a sum of more than two steps would be
    // computed beforehand, for which there are no registers.
    let (mut next, two) = (depth.wrapping_add(step), step.wrapping_mul(2));
    while let Some(([first, second], later)) = mem::take(&mut blocks).split_first_mut() {
        codegen::keep_rolled();
        if *first | *second != 0 {
            break;
        }
        for word in [first, second] {
            store(word, depth, next);
            (depth, next) = (depth.wrapping_add(two), next.wrapping_add(two));
        }
        left = later.len();
        blocks = later;
    }
    claimed = claimed.wrapping_sub(4 * left);
    // Up to three, at the end or before the cell that is not clear.
    while let Some(cell @ 0) = cells.get_mut(claimed) {
        codegen::keep_rolled();
        *cell = upper(depth);
        depth = depth.wrapping_add(step);
        claimed += 1;
    }
    claimed
}

/// Stores the depths of two pixels.
#[inline(always)]
fn store(word: &mut u32, first: u32, second: u32) {
    if IS_NARROW {
        // codegen: as many instructions as for a word, and a register less.
        let [low, high] = bytemuck::must_cast_mut::<u32, [u16; 2]>(word);
        (*low, *high) = (upper(first), upper(second));
    } else {
        *word = bytemuck::must_cast([upper(first), upper(second)]);
    }
}

#[inline(always)]
const fn upper(depth: u32) -> u16 {
    (depth >> 16) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_claimed_up_to_the_first_that_is_not_clear() {
        let (depth, step) = (0x8000_8000_u32, 0x0003_4000_u32);
        for start in 0..2 {
            for length in 0..24 {
                for taken in 0..=length {
                    let mut buffer = [0_u16; 32];
                    let cells = &mut buffer[start..start + length];
                    if let Some(cell) = cells.get_mut(taken) {
                        *cell = 7;
                    }
                    assert_eq!(claim(cells, depth, step), taken, "of {length} from {start}");
                    for (place, &cell) in cells.iter().enumerate() {
                        let here = depth + step * place as u32;
                        let other = if place == taken { 7 } else { 0 };
                        let expected = if place < taken { (here >> 16) as u16 } else { other };
                        assert_eq!(cell, expected, "{place}: {taken} of {length} from {start}");
                    }
                    assert_eq!(buffer[start + length..], [0; 32][start + length..]);
                }
            }
        }
    }
}
