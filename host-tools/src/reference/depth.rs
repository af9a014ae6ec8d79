//! How depth is stored, by definition.

/// A format of stored depth: numbers from 0, which stands for nothing drawn, up to
/// [`max`](Self::max), nearest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DepthFormat {
    /// Binary digits behind the point, rounded to the nearest.
    Fixed {
        /// How many.
        bits: u32,
    },
    /// `(1 + mantissa / 2^m) 2^(exponent - 2^e)` without a sign, truncated. The exponent 0 stands
    /// for `mantissa / 2^m 2^(1 - 2^e)`.
    Float {
        /// The bits of the exponent, e.
        exponent_bits: u32,
        /// The bits of the mantissa below it, m.
        mantissa_bits: u32,
        /// The least exponent of a depth that is drawn, but for what interpolation rounds off.
        least_exponent: u32,
    },
}

impl DepthFormat {
    /// The stored depth of the near plane.
    #[must_use]
    pub fn max(self) -> f64 {
        2f64.powi(match self {
            Self::Fixed { bits } => bits,
            Self::Float { exponent_bits, mantissa_bits, .. } => exponent_bits + mantissa_bits,
        } as i32)
            - 1.0
    }

    /// The largest difference of the depths that neighbouring stored numbers stand for.
    #[must_use]
    pub fn largest_unit(self) -> f64 {
        0.5f64.powi(match self {
            Self::Fixed { bits } => bits,
            // Just below 1.
            Self::Float { mantissa_bits, .. } => mantissa_bits + 1,
        } as i32)
    }

    /// The place of a depth from 0 to 1 between the numbers that stand for its neighbours.
    #[must_use]
    pub fn units(self, depth: f64) -> f64 {
        match self {
            Self::Fixed { bits } => depth * 2f64.powi(bits as i32),
            Self::Float { exponent_bits, mantissa_bits, .. } => {
                let (bias, steps) =
                    (2f64.powi(exponent_bits as i32), 2f64.powi(mantissa_bits as i32));
                let least = 2f64.powf(1.0 - bias);
                if depth < least {
                    return depth / least * steps;
                }
                // The power of two at or below the depth: an f64 without its mantissa.
                let power = f64::from_bits(depth.to_bits() & !0 << 52);
                (power.log2() + bias + depth / power - 1.0) * steps
            }
        }
    }

    /// The number that stands for a place between two of them; 0 stands for no depth in front of
    /// the far plane.
    #[must_use]
    pub fn stored(self, units: f64) -> f64 {
        match self {
            Self::Fixed { .. } => units.round().clamp(1.0, self.max()),
            Self::Float { mantissa_bits, least_exponent, .. } => {
                let least = f64::from(least_exponent) * 2f64.powi(mantissa_bits as i32);
                units.floor().clamp(least, self.max())
            }
        }
    }

    /// The depth that a stored number stands for.
    #[must_use]
    pub fn depth(self, stored: u32) -> f64 {
        match self {
            Self::Fixed { bits } => f64::from(stored) / 2f64.powi(bits as i32),
            Self::Float { exponent_bits, mantissa_bits, .. } => {
                let bias = 1 << exponent_bits;
                let exponent = (stored >> mantissa_bits) as i32;
                let mantissa = f64::from(stored & ((1 << mantissa_bits) - 1));
                let fraction = mantissa / 2f64.powi(mantissa_bits as i32);
                if exponent == 0 {
                    fraction * 2f64.powi(1 - bias)
                } else {
                    (1.0 + fraction) * 2f64.powi(exponent - bias)
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOAT: DepthFormat =
        DepthFormat::Float { exponent_bits: 5, mantissa_bits: 11, least_exponent: 2 };
    const FIXED: DepthFormat = DepthFormat::Fixed { bits: 16 };

    #[test]
    fn every_number_stands_for_a_depth_at_its_place() {
        for format in [FLOAT, FIXED] {
            let mut before = -1.0;
            for stored in 0..1 << 16 {
                let depth = format.depth(stored);
                assert!(depth > before && depth < 1.0);
                assert_eq!(format.units(depth), f64::from(stored), "{format:?}");
                before = depth;
            }
            assert_eq!(format.max(), 65_535.0);
        }
    }

    #[test]
    fn a_floating_depth_is_truncated_and_keeps_its_least_exponent() {
        let stored = |depth| FLOAT.stored(FLOAT.units(depth));
        // 1/2 has the exponent 31; the steps above it are 2^-12.
        let half = f64::from(31 << 11);
        assert_eq!(stored(0.5), half);
        assert_eq!(stored(0.5 + 0.99 / 4096.0), half);
        assert_eq!(stored(0.5 + 1.0 / 4096.0), half + 1.0);
        assert_eq!(stored(0.5 - 1e-12), half - 1.0);
        assert_eq!(stored(1.0), 65_535.0);
        assert_eq!(stored(0.0), 4096.0);
        assert_eq!(FLOAT.depth(4096), 2f64.powi(-30));
        assert_eq!(FLOAT.depth(1), 2f64.powi(-42));
        // Half a step is half a unit at every distance.
        for exponent in 2..32 {
            let depth = (1.0 + 0.5 / 2048.0) * 2f64.powi(exponent - 32);
            assert_eq!(FLOAT.units(depth), f64::from(exponent << 11) + 0.5);
        }
    }

    #[test]
    fn a_fixed_depth_is_rounded_and_never_0() {
        let stored = |depth| FIXED.stored(FIXED.units(depth));
        assert_eq!(stored(0.5 + 0.49 / 65_536.0), 32_768.0);
        assert_eq!(stored(0.5 + 0.51 / 65_536.0), 32_769.0);
        assert_eq!((stored(0.0), stored(1.0)), (1.0, 65_535.0));
    }
}
