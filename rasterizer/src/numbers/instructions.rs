//! Operations for which the smallest cores have no instruction: the upper half of a product, the
//! leading zeros of a number, division.
//!
//! Each uses the core's instruction where there is one and its form in [`software`] elsewhere. Both
//! give the same results, so a frame is the same on every core.

use super::software;

/// Whether the core has none of these instructions. Among ARM targets these are the ones without
/// atomic read-modify-write instructions (`ARMv6-M`, `ARMv4T`), which a stable compiler can test
/// for. With `--cfg rasterizer_narrow` the host computes like these, for tests.
pub(crate) const IS_NARROW: bool =
    cfg!(any(all(target_arch = "arm", not(target_has_atomic = "32")), rasterizer_narrow));

/// Whether a word may be stored at any address: `ARMv7-M` and `ARMv8-M` with the main extension.
/// The baseline of `ARMv8-M` counts as one of them, because it has atomic instructions too; the
/// compiler stores two halves there.
pub(crate) const HAS_UNALIGNED_WORDS: bool =
    cfg!(all(target_arch = "arm", target_has_atomic = "32"));

/// Whether counting leading zeros takes one instruction or a few.
pub(crate) const HAS_LEADING_ZEROS: bool = !(IS_NARROW
    || cfg!(all(
        any(target_arch = "riscv32", target_arch = "riscv64"),
        not(target_feature = "zbb")
    )));

/// ⌊a b / 2<sup>32</sup>⌋.
#[inline(always)]
pub(crate) const fn mul_high(a: i32, b: i32) -> i32 {
    if IS_NARROW {
        software::mul_high_by_halves(a, b)
    } else {
        ((a as i64 * b as i64) >> 32) as i32
    }
}

/// ⌊a b / 2<sup>32</sup>⌋ without signs.
#[inline(always)]
pub(crate) const fn mul_high_unsigned(a: u32, b: u32) -> u32 {
    if IS_NARROW {
        software::mul_high_unsigned_by_halves(a, b)
    } else {
        ((a as u64 * b as u64) >> 32) as u32
    }
}

/// a b in 64 bits.
#[inline(always)]
pub(crate) const fn mul_wide(a: i32, b: i32) -> i64 {
    if IS_NARROW {
        ((software::mul_high_by_halves(a, b) as i64) << 32) | (a.wrapping_mul(b) as u32 as i64)
    } else {
        a as i64 * b as i64
    }
}

/// The product with a number in Q30, rounded. It is not inlined: only angles and lights use it,
/// once per frame.
#[inline(never)]
pub(crate) const fn mul_q30(a: i32, b: i32) -> i32 {
    ((a as i64 * b as i64 + (1 << 29)) >> 30) as i32
}

/// The product of a wide number with a factor in Q30, rounded down. It is not inlined: only
/// matrices use it, once per frame.
#[inline(never)]
pub(crate) const fn mul_wide_q30(a: i64, factor: i32) -> i64 {
    let (upper, lower) = (a >> 30, a & ((1 << 30) - 1));
    upper * factor as i64 + ((lower * factor as i64) >> 30)
}

/// The product of a wide number with a factor in Q60 of magnitude up to 1, within two steps.
pub(crate) const fn mul_q60(a: i64, factor: i64) -> i64 {
    let lower = (factor & ((1 << 30) - 1)) as i32;
    mul_wide_q30(a, (factor >> 30) as i32) + (mul_wide_q30(a, lower) >> 30)
}

/// `value * 2^shift`, rounded. It must fit. It is not inlined: only matrices use it, once per
/// frame.
// codegen: loops, because the routines that shift 64 bits are more code.
#[inline(never)]
pub(crate) const fn shifted(value: i64, shift: i32) -> i64 {
    let (mut value, mut shift) = (value, if shift < -64 { -64 } else { shift });
    while shift > 0 {
        value <<= 1;
        shift -= 1;
    }
    while shift < 0 {
        // The last step rounds.
        shift += 1;
        value = if shift < 0 { value >> 1 } else { (value >> 1) + (value & 1) };
    }
    value
}

/// The leading zeros of a number.
#[inline(always)]
pub(crate) const fn leading_zeros(value: u32) -> u32 {
    if IS_NARROW { software::leading_zeros_by_table(value) } else { value.leading_zeros() }
}

/// A positive number shifted up to its most significant bit, and by how many bits.
#[inline(always)]
pub(crate) const fn normalised(value: u32) -> (u32, u32) {
    if IS_NARROW {
        software::normalised_by_nibbles(value)
    } else {
        let zeros = value.leading_zeros();
        (value << zeros, zeros)
    }
}

/// The leading zeros of a number that mostly has few; 0 has none.
///
/// It is for cores that have no instruction for it: each leading zero takes 4 instructions.
#[inline(always)]
pub(crate) const fn few_leading_zeros(value: u32) -> u32 {
    software::leading_zeros_by_bits(value)
}

/// ⌊a / b⌋, for quotients that are mostly small; 0 for a `b` of 0.
///
/// Where there is no instruction for it, each subtraction of the divisor takes 5 instructions.
#[inline(always)]
pub(crate) const fn divide_small(a: u32, b: u32) -> u32 {
    if IS_NARROW { software::divide_by_subtraction(a, b) } else { divide(a, b) }
}

/// ⌊a / b⌋; 0 for a `b` of 0.
#[inline(always)]
pub(crate) const fn divide(a: u32, b: u32) -> u32 {
    if IS_NARROW {
        software::divide_by_bits(a, b)
    } else {
        match a.checked_div(b) {
            Some(quotient) => quotient,
            None => 0,
        }
    }
}

/// The lesser of the number and `limit` - 1. The number is at least -`limit`, and `limit` is a
/// power of two.
#[inline(always)]
pub(crate) const fn saturate(value: i32, limit: i32) -> i32 {
    if value >= limit {
        limit - 1
    } else if !IS_NARROW && value < -limit {
        // Where a core has an instruction that saturates, it takes both ends.
        -limit
    } else {
        value
    }
}

/// The number, or 0 if it is negative. It is below 2^`BITS`.
#[inline(always)]
pub(crate) const fn not_negative<const BITS: u32>(value: i32) -> u32 {
    // Where a core has an instruction that saturates, it takes both ends.
    let value = if !IS_NARROW && value >= 1 << BITS { (1 << BITS) - 1 } else { value };
    (if value < 0 { 0 } else { value }) as u32
}

/// The lesser of the number, which is not negative, and 2^`BITS` - 1.
#[inline(always)]
pub(crate) const fn at_most<const BITS: u32>(value: i32) -> u32 {
    if IS_NARROW {
        let value = value as u32;
        if value >= 1 << BITS { (1 << BITS) - 1 } else { value }
    } else {
        not_negative::<BITS>(value)
    }
}
