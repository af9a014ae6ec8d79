//! A positive scale factor of any magnitude.

/// `mantissa * 2^exponent`.
///
/// A model may measure a thousandth of a unit or a million units: the length of one quantum of its
/// tables needs more range than a fixed-point number has. This form keeps 32 bits of precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Scale {
    mantissa: u32,
    exponent: i32,
}

impl Scale {
    /// One unit per quantum.
    pub const ONE: Self = Self::new(1, 0);

    /// `mantissa * 2^exponent`, normalised so that the mantissa's top bit is set.
    ///
    /// # Panics
    ///
    /// Panics if the mantissa is 0, or the exponent is beyond ±1,000, which no model needs.
    #[must_use]
    pub const fn new(mantissa: u32, exponent: i32) -> Self {
        assert!(mantissa != 0, "a scale of 0 leaves nothing to draw");
        assert!(exponent.unsigned_abs() <= 1000, "the exponent of a scale is at most 1,000");
        let shift = mantissa.leading_zeros();
        Self { mantissa: mantissa << shift, exponent: exponent - shift as i32 }
    }

    /// The mantissa: 2<sup>31</sup> to 2<sup>32</sup> - 1.
    #[must_use]
    pub const fn mantissa(self) -> u32 {
        self.mantissa
    }

    /// The exponent that goes with [`mantissa`](Self::mantissa).
    #[must_use]
    pub const fn exponent(self) -> i32 {
        self.exponent
    }

    /// The scale times a power of 2, at the ends of the exponents at most. Unlike
    /// [`new`](Self::new) it has no code to panic by.
    pub(crate) fn times_power_of_2(self, power: i32) -> Self {
        Self { exponent: self.exponent.saturating_add(power).clamp(-1031, 1000), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalised() {
        assert_eq!(Scale::new(1, 0), Scale::new(2, -1));
        assert_eq!(Scale::new(3, 5).mantissa(), 3 << 30);
        assert_eq!(Scale::new(3, 5).exponent(), 5 - 30);
    }

    #[test]
    fn powers_of_2_stop_at_the_ends() {
        let scale = Scale::new(3, 5);
        assert_eq!(scale.times_power_of_2(-7), Scale::new(3, -2));
        assert_eq!(scale.times_power_of_2(i32::MAX).exponent(), 1000);
        assert_eq!(scale.times_power_of_2(i32::MIN).exponent(), Scale::new(1, -1000).exponent());
    }
}
