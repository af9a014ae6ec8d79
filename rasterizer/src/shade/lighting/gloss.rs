//! Powers of cosines, for highlights.

use crate::numbers::{at_most, codegen, divide, mul_high_unsigned, not_negative};

/// The power of a cosine, by a table of the exponent's own: linear between 64 equal steps of 1 - c,
/// from where the power is 1 to where it is below a 1,024th.
///
/// It is within 2<sup>-9</sup> of the exact power of the cosine as it is rounded: lines between
/// points h apart are off by h^2 / 8 of the second derivative, which is largest at the peak, where
/// the 64 steps take 6.93 units of ln: (6.93 / 64)^2 / 8 is 2<sup>-9.4</sup>.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::shade) struct Gloss {
    /// In Q15. The last two are 0.
    powers: [u16; STEPS + 2],
    /// Steps for a unit of the cosine, 2^-15, in Q16.
    steps: u32,
    /// From how far below 1 on a cosine's power is 0, in Q15.
    reach: i32,
}

const STEPS: usize = 64;

/// A full power, in Q15.
const ONE: u32 = 1 << 15;

impl Gloss {
    /// Without highlights.
    pub(in crate::shade) const NONE: Self = Self { powers: [0; STEPS + 2], steps: 0, reach: 0 };

    /// For an exponent from 1 to 1,000.
    // codegen: not inlined, because it is for once a material: its temporaries leave the stack.
    #[inline(never)]
    pub(in crate::shade) fn new(exponent: u16) -> Self {
        let exponent = u32::from(exponent);
        // As -ln(1 - s) >= s, the power is below 2^-10 where s = 6.93 / n. In steps of Q16:
        // 64 * 2^16 * n / (6.93 * 2^15) = 18.47 n. All of the way to c = 0 takes 128.
        let steps = ((exponent * 1182) >> 6).max(128);
        // A step of 1 - c in Q31: 2^32 / steps.
        let step = divide(u32::MAX, steps);
        // `step` is 2^16 of the cosine's units for one of the table's.
        let reach = (step >> (16 - STEPS.trailing_zeros())) as i32 + 1;
        let mut gloss = Self { powers: [0; STEPS + 2], steps, reach };
        let mut cosine = 1u32 << 31;
        for power in gloss.powers.iter_mut().take(STEPS) {
            codegen::keep_rolled();
            *power = ((self::power(cosine, exponent) + (1 << 15)) >> 16) as u16;
            cosine = cosine.saturating_sub(step);
        }
        gloss
    }

    /// Whether there are highlights.
    #[inline(always)]
    pub(in crate::shade) const fn is_some(&self) -> bool {
        self.reach != 0
    }

    /// By how much a cosine in Q15, which may be over 1 by a rounding, is below 1; `None` where its
    /// power is 0.
    #[inline(always)]
    pub(in crate::shade) const fn below_one(&self, cosine: u32) -> Option<i32> {
        let below = (ONE as i32).wrapping_sub(cosine as i32);
        if below < self.reach { Some(below) } else { None }
    }

    /// The power in Q15 of a cosine that is below 1 by this much.
    #[inline(always)]
    pub(in crate::shade) fn power(&self, below_one: i32) -> i32 {
        // At most 2^15 times 2^14.2.
        let way = not_negative::<16>(below_one) * self.steps;
        let step = at_most::<{ STEPS.trailing_zeros() }>((way as i32) >> 16) as usize;
        let [from, to] = [self.powers[step], self.powers[step + 1]].map(i32::from);
        // codegen: signed like what follows, so that it can saturate by an instruction.
        from - (((from - to) * ((way & 0xFFFF) >> 1) as i32) >> 15)
    }
}

/// The power of a number up to 1 in Q31, by the exponent's binary digits.
fn power(base: u32, mut exponent: u32) -> u32 {
    let product = |a: u32, b: u32| mul_high_unsigned(a, b) << 1;
    let (mut power, mut square) = (1u32 << 31, base);
    while exponent != 0 {
        if exponent & 1 == 1 {
            power = product(power, square);
        }
        square = product(square, square);
        exponent >>= 1;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    impl Gloss {
        fn at(&self, cosine: u32) -> u32 {
            self.below_one(cosine).map_or(0, |below| self.power(below) as u32)
        }
    }

    #[test]
    fn powers_are_near_the_exact_ones() {
        for exponent in (1..=1000u16).filter(|n| *n < 40 || n % 37 == 0 || *n == 1000) {
            let gloss = Gloss::new(exponent);
            for cosine in 0..=ONE {
                let exact = (f64::from(cosine) / f64::from(ONE)).powi(exponent.into());
                let error = f64::from(gloss.at(cosine)) / f64::from(ONE) - exact;
                assert!(error.abs() < 2f64.powi(-9), "{cosine}^{exponent}: {error}");
            }
            // None is cut off before it is 0.
            assert_eq!(gloss.at(ONE), ONE);
            assert_eq!(gloss.at(ONE + 9), ONE);
        }
        assert_eq!(Gloss::NONE.at(ONE), 0);
    }

    #[test]
    fn powers_fall_with_the_cosine() {
        for exponent in [1, 2, 7, 60, 999] {
            let gloss = Gloss::new(exponent);
            let falls = (0..ONE).all(|cosine| gloss.at(cosine) <= gloss.at(cosine + 1));
            assert!(falls, "{exponent}");
        }
    }
}
