//! What the smallest cores have no instruction for: the upper half of a product, the leading zeros
//! of a number, division.
//!
//! `ARMv6-M` has no multiplication that gives more than 32 bits: the compiler would call a routine
//! that multiplies 64 by 64 bits (some 50 instructions). Four products of 16-bit halves need 17
//! (Warren, *Hacker's Delight*, 2nd ed., section 8-2). It counts leading zeros by a routine of 33
//! instructions; a table of 16 entries needs 13. Both forms give the same results, so a frame is
//! the same on every core.

/// ⌊a b / 2<sup>32</sup>⌋.
#[inline(always)]
pub(crate) const fn mul_high(a: i32, b: i32) -> i32 {
    if IS_NARROW { mul_high_by_halves(a, b) } else { ((a as i64 * b as i64) >> 32) as i32 }
}

/// ⌊a b / 2<sup>32</sup>⌋ without signs.
#[inline(always)]
pub(crate) const fn mul_high_unsigned(a: u32, b: u32) -> u32 {
    if IS_NARROW { mul_high_unsigned_by_halves(a, b) } else { ((a as u64 * b as u64) >> 32) as u32 }
}

/// The product with a number in Q30, rounded. A function that is called, for what is worked out
/// once a frame: angles and lights.
#[inline(never)]
pub(crate) const fn mul_q30(a: i32, b: i32) -> i32 {
    ((a as i64 * b as i64 + (1 << 29)) >> 30) as i32
}

/// The leading zeros of a number.
#[inline(always)]
pub(crate) const fn leading_zeros(value: u32) -> u32 {
    if IS_NARROW { leading_zeros_by_table(value) } else { value.leading_zeros() }
}

/// A positive number shifted up to its most significant bit, and by how many bits.
#[inline(always)]
pub(crate) const fn normalised(value: u32) -> (u32, u32) {
    if IS_NARROW {
        normalised_by_nibbles(value)
    } else {
        let zeros = value.leading_zeros();
        (value << zeros, zeros)
    }
}

/// ⌊a / b⌋, for quotients that are mostly small; 0 for a `b` of 0.
///
/// Where there is no instruction for it, taking off the divisor takes 5 instructions a time.
#[inline(always)]
pub(crate) const fn divide_small(a: u32, b: u32) -> u32 {
    if IS_NARROW { divide_by_subtraction(a, b) } else { divide(a, b) }
}

/// ⌊a / b⌋; 0 for a `b` of 0.
#[inline(always)]
pub(crate) const fn divide(a: u32, b: u32) -> u32 {
    if IS_NARROW {
        divide_by_bits(a, b)
    } else {
        match a.checked_div(b) {
            Some(quotient) => quotient,
            None => 0,
        }
    }
}

/// The number or `limit` - 1, whichever is less, for numbers not below -`limit`, a power of two.
#[inline(always)]
pub(crate) const fn saturate(value: i32, limit: i32) -> i32 {
    if value >= limit {
        limit - 1
    } else if !IS_NARROW && value < -limit {
        // With both ends it is a single instruction of cores that have one for it.
        -limit
    } else {
        value
    }
}

/// Whether the core lacks all of them. Among ARM targets these are the ones without atomic
/// read-modify-write instructions (`ARMv6-M`, `ARMv4T`), which is what a stable compiler lets one
/// ask for.
pub(crate) const IS_NARROW: bool = cfg!(all(target_arch = "arm", not(target_has_atomic = "32")));

/// Whether a word may be stored at any address: `ARMv7-M` and `ARMv8-M` with the main extension.
/// The baseline of `ARMv8-M` counts as one of them, as it has atomic instructions too; there a
/// compiler stores two halves.
pub(crate) const HAS_UNALIGNED_WORDS: bool =
    cfg!(all(target_arch = "arm", target_has_atomic = "32"));

#[inline(always)]
const fn mul_high_by_halves(a: i32, b: i32) -> i32 {
    let (a_low, a_high) = (a & 0xFFFF, a >> 16);
    let (b_low, b_high) = (b & 0xFFFF, b >> 16);
    let low = a_low.wrapping_mul(b_low) as u32;
    let middle = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(middle & 0xFFFF);
    a_high.wrapping_mul(b_high).wrapping_add(middle >> 16).wrapping_add(other >> 16)
}

#[inline(always)]
const fn mul_high_unsigned_by_halves(a: u32, b: u32) -> u32 {
    let (a_low, a_high) = (a & 0xFFFF, a >> 16);
    let (b_low, b_high) = (b & 0xFFFF, b >> 16);
    let middle = a_high * b_low + ((a_low * b_low) >> 16);
    let other = a_low * b_high + (middle & 0xFFFF);
    a_high * b_high + (middle >> 16) + (other >> 16)
}

#[inline(always)]
const fn divide_by_subtraction(a: u32, b: u32) -> u32 {
    let (mut rest, mut quotient) = (a, 0);
    while rest >= b {
        if quotient == 12 {
            return divide_by_bits(a, b);
        }
        rest -= b;
        quotient += 1;
    }
    quotient
}

/// Shifts and subtracts, some 10 instructions for each bit of the quotient: the compiler's own
/// routine, of 180 bytes and 60 to 90 instructions, is not linked then.
#[inline(never)]
const fn divide_by_bits(a: u32, b: u32) -> u32 {
    if b == 0 {
        return 0;
    }
    let (mut divisor, mut bit) = (b, 1);
    while divisor <= a >> 1 {
        (divisor, bit) = (divisor << 1, bit << 1);
    }
    let (mut rest, mut quotient) = (a, 0);
    while bit != 0 {
        if rest >= divisor {
            (rest, quotient) = (rest - divisor, quotient | bit);
        }
        (divisor, bit) = (divisor >> 1, bit >> 1);
    }
    quotient
}

/// The leading zeros of four bits.
const ZEROS: [u8; 16] = [4, 3, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0];

/// A loop, as compilers make two branches of each condition that moves two numbers.
#[inline(always)]
const fn normalised_by_nibbles(value: u32) -> (u32, u32) {
    let (mut rest, mut zeros) = (value, 0);
    while rest >> 28 == 0 && zeros < 28 {
        rest <<= 4;
        zeros += 4;
    }
    let few = ZEROS[(rest >> 28) as usize] as u32;
    (rest << few, zeros + few)
}

#[inline(always)]
const fn leading_zeros_by_table(value: u32) -> u32 {
    let (mut rest, mut zeros) = (value, 0);
    if rest >> 16 == 0 {
        rest <<= 16;
        zeros += 16;
    }
    if rest >> 24 == 0 {
        rest <<= 8;
        zeros += 8;
    }
    if rest >> 28 == 0 {
        rest <<= 4;
        zeros += 4;
    }
    zeros + ZEROS[(rest >> 28) as usize] as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [u32; 12] = [
        0,
        1,
        2,
        0x7FFF,
        0xFFFF,
        0x1_0000,
        0x1_0001,
        0x7FFF_FFFF,
        0x8000_0000,
        0x8000_0001,
        0xFFFF_0000,
        0xFFFF_FFFF,
    ];

    #[test]
    fn halves_equal_the_long_product() {
        let mut random: u32 = 12345;
        let mut next = || {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            random ^ random >> 13
        };
        let check = |a: u32, b: u32| {
            assert_eq!(
                mul_high_unsigned_by_halves(a, b),
                ((u64::from(a) * u64::from(b)) >> 32) as u32
            );
            let (a, b) = (a.cast_signed(), b.cast_signed());
            assert_eq!(mul_high_by_halves(a, b), ((i64::from(a) * i64::from(b)) >> 32) as i32);
        };
        for a in CORNERS {
            for b in CORNERS {
                check(a, b);
            }
        }
        for _ in 0..1_000_000 {
            check(next(), next());
        }
    }

    #[test]
    fn subtraction_and_bits_equal_division() {
        for a in (0..300).chain(CORNERS) {
            for b in (0..40).chain(CORNERS) {
                let quotient = a.checked_div(b).unwrap_or(0);
                assert_eq!(divide_by_subtraction(a, b), quotient, "{a} / {b}");
                assert_eq!(divide_by_bits(a, b), quotient, "{a} / {b}");
            }
        }
    }

    #[test]
    fn table_counts_leading_zeros() {
        for bit in 0..32 {
            for value in [1u32 << bit, (1 << bit) - 1, u32::MAX >> bit, (1 << bit) | 1] {
                let zeros = value.leading_zeros();
                assert_eq!(leading_zeros_by_table(value), zeros, "{value:#x}");
                if value > 0 {
                    assert_eq!(normalised_by_nibbles(value), (value << zeros, zeros), "{value:#x}");
                }
            }
        }
    }
}
