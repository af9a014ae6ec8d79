//! The forms in software of what `ARMv6-M` has no instruction for.
//!
//! It has no multiplication that gives more than 32 bits: the compiler would call a routine that
//! multiplies 64 by 64 bits (some 50 instructions). Four products of 16-bit halves need 17 (Warren,
//! *Hacker's Delight*, 2nd ed., section 8-2). To count leading zeros the compiler would call a
//! routine of 33 instructions; a table of 16 entries needs 13.

/// ⌊a b / 2<sup>32</sup>⌋ from four products of halves.
#[inline(always)]
pub(super) const fn mul_high_by_halves(a: i32, b: i32) -> i32 {
    let (a_low, a_high) = (a & 0xFFFF, a >> 16);
    let (b_low, b_high) = (b & 0xFFFF, b >> 16);
    let low = a_low.wrapping_mul(b_low) as u32;
    let middle = a_high.wrapping_mul(b_low).wrapping_add((low >> 16) as i32);
    let other = a_low.wrapping_mul(b_high).wrapping_add(middle & 0xFFFF);
    a_high.wrapping_mul(b_high).wrapping_add(middle >> 16).wrapping_add(other >> 16)
}

/// ⌊a b / 2<sup>32</sup>⌋ without signs, from four products of halves.
#[inline(always)]
pub(super) const fn mul_high_unsigned_by_halves(a: u32, b: u32) -> u32 {
    let (a_low, a_high) = (a & 0xFFFF, a >> 16);
    let (b_low, b_high) = (b & 0xFFFF, b >> 16);
    let middle = a_high * b_low + ((a_low * b_low) >> 16);
    let other = a_low * b_high + (middle & 0xFFFF);
    a_high * b_high + (middle >> 16) + (other >> 16)
}

/// ⌊a / b⌋ by up to 12 subtractions, and by [`divide_by_bits`] if these are too few.
#[inline(always)]
pub(super) const fn divide_by_subtraction(a: u32, b: u32) -> u32 {
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

/// ⌊a / b⌋ by shifts and subtractions; 0 for a `b` of 0.
///
/// It takes some 10 instructions for each bit of the quotient. The compiler's own routine, of 180
/// bytes and 60 to 90 instructions, is then not linked.
#[inline(never)]
pub(super) const fn divide_by_bits(a: u32, b: u32) -> u32 {
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

/// A positive number shifted up to its most significant bit, and by how many bits.
///
/// It is a loop because compilers turn each condition that changes two numbers into two branches.
#[inline(always)]
pub(super) const fn normalised_by_nibbles(value: u32) -> (u32, u32) {
    let (mut rest, mut zeros) = (value, 0);
    while rest >> 28 == 0 && zeros < 28 {
        rest <<= 4;
        zeros += 4;
    }
    let few = ZEROS[(rest >> 28) as usize] as u32;
    (rest << few, zeros + few)
}

/// The leading zeros of a number, bit by bit; 0 has none.
#[inline(always)]
pub(super) const fn leading_zeros_by_bits(value: u32) -> u32 {
    let (mut rest, mut zeros) = (value, 0);
    // Positive as a signed number: neither the most significant bit nor 0.
    while rest.cast_signed() > 0 {
        rest <<= 1;
        zeros += 1;
    }
    zeros
}

/// The leading zeros of a number.
#[inline(always)]
pub(super) const fn leading_zeros_by_table(value: u32) -> u32 {
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
    use crate::random::Random;

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
        let mut random = Random::new(12_345);
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
            let bits = random.bits();
            check(bits as u32, (bits >> 32) as u32);
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
                    let normalised = (value << zeros, zeros);
                    assert_eq!(normalised_by_nibbles(value), normalised, "{value:#x}");
                    assert_eq!(leading_zeros_by_bits(value), zeros, "{value:#x}");
                }
            }
        }
    }
}
