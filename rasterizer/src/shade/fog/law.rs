//! How much fog lies before a point, as a table by its 1 / w.
//!
//! # The table
//!
//! 1 / w of a point, in world units, is a floating-point number of an exponent and 11 bits of
//! mantissa, of which the whole is a *code*: codes are ordered as distances are, and an octave of
//! distance has 2,048 of them. The table has the amount of fog at every 2^shift-th code over the
//! octaves in which it changes, and is interpolated in between, where 1 / w is linear in the code.
//! Before and behind them the amount is that of the first and of the last entry. Entries are those
//! of the law without its bounds of 0 and 1, which are put to the interpolated amount, so that a
//! linear fog keeps its sharp ends.
//!
//! # Error
//!
//! With x = 1 / w, an amount f(x) that is interpolated over a part h of x, 2^-n of an octave, is
//! off by at most h² |f''| / 8. A linear fog is a / x - b with a x^-1 = w / (end - start), and
//! f'' = 2 a x^-3: 2^-2n w / 4 (end - start). An exponential one is 1 - e^-(d / x), and |f''| x² =
//! |2 y - y²| e^-y for y = d w, at most 0.462: 2^-2n 0.058.
//!
//! * A linear fog that begins at the eye has 2,048 / 2^7 entries an octave over 11 octaves: n = 4,
//!   below 1/1,024. With s = end / (end - start) it is below s/1,024, and finer octaves make it
//!   less from s = 2 on.
//! * An exponential one has n = 4 over 14 octaves: below 1/4,000.
//! * What is cut off before the first octave is 1/1,024, and behind the last 1/1,024 as well, or
//!   nothing for a linear fog.
//! * A code stands for the middle of its interval, within 2^-12 of 1 / w: s/4,096, or e^-1 times
//!   that.

use fixed::types::U8F24;

use crate::{
    camera::Distance,
    color::Alpha,
    numbers::{Float, mul_q30, shifted},
};

/// The part of the light that a world unit of fog takes, for thin fog: the rate of its exponential
/// law. Up to 255, in steps of 2<sup>-24</sup>.
pub type Density = U8F24;

/// How much fog lies before a point at a distance from the camera, by a law. It takes 530 bytes: in
/// a `static`, these are in flash.
///
/// Distances are along the camera's direction: w in world units, from the plane through the eye.
///
/// ```
/// use rasterizer::{camera::Distance, color::Alpha, shade::{Density, Fog}};
///
/// static MIST: Fog = Fog::linear(Distance::lit("2"), Distance::lit("10")).unwrap();
/// static HAZE: Fog = Fog::exponential(Density::lit("0.1"));
///
/// assert_eq!(MIST.at(Distance::lit("6")), Alpha::HALF);
/// assert_eq!(MIST.at(Distance::lit("1.5")), Alpha::CLEAR);
/// assert_eq!(MIST.at(Distance::lit("50")), Alpha::OPAQUE);
/// // e^-1 of the light is left after 10 units.
/// assert_eq!(HAZE.at(Distance::lit("10")).to_bits(), 162);
/// ```
///
/// # Error
///
/// The amount is within 1/512 for the rounding to 256ths and 1/512 for the table, for a linear fog
/// with end ≥ 2 start or start = 0 and any exponential one. With s = end / (end - start) over 2 the
/// latter is s/1,024.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fog {
    /// The amount from the farthest code to the nearest, in 2^-14.
    table: [i16; ENTRIES + 1],
    /// The code of the first entry.
    first: i32,
    /// The last position between two entries, from the first in codes.
    last: i32,
    /// The codes from one entry to the next are 2^shift.
    shift: u32,
}

/// The intervals of a table, of which one has any number up to this.
const ENTRIES: usize = 256;

/// The bits of a code's mantissa.
const MANTISSA_BITS: u32 = 11;

/// An amount of 1.
const ALL: i32 = 1 << 14;

/// log2 e and ln 2 in Q30.
const LOG2_E: Float = Float::new(1_549_082_005, -30);
const LN_2: i32 = 744_261_118;

/// A law, in the core's numbers.
#[derive(Clone, Copy)]
enum Law {
    Linear {
        /// In 2^-24 world units.
        start: i64,
        /// 1 / (end - start).
        slope: Float,
    },
    Exponential {
        /// How often a world unit halves the light.
        halvings: Float,
    },
}

impl Law {
    /// The amount at a distance, in 2^-14, from -2 to 2.
    const fn at(self, distance: Float) -> i16 {
        let amount = match self {
            Self::Linear { start, slope } => {
                // Distances reach little beyond the end, which is below 2^16.
                let way = shifted(distance.mantissa as i64, distance.exponent + 24) - start;
                Float::new(way, -24).times(slope).in_units_of(-14)
            }
            Self::Exponential { halvings } => {
                let times = distance.times(halvings).in_units_of(-20);
                let whole = times >> 20;
                let left = half_to((times & 0xF_FFFF) << 10);
                if whole > 15 { ALL } else { ALL - (((left >> whole) + (1 << 15)) >> 16) }
            }
        };
        if amount < i16::MIN as i32 {
            i16::MIN
        } else if amount > i16::MAX as i32 {
            i16::MAX
        } else {
            amount as i16
        }
    }
}

/// 2^-x for x in Q30 from 0 to 1, in Q30: the series of e^-y, whose ninth term is below 2^-21.
const fn half_to(x: i32) -> i32 {
    const ONE: i32 = 1 << 30;
    const PARTS: [i32; 9] = {
        let mut parts = [0; 9];
        let mut n = 1;
        while n < 9 {
            parts[n] = ONE / n as i32;
            n += 1;
        }
        parts
    };
    let y = mul_q30(x, LN_2);
    let (mut sum, mut n) = (ONE, 8);
    while n > 0 {
        sum = ONE - mul_q30(mul_q30(y, sum), PARTS[n]);
        n -= 1;
    }
    sum
}

/// The code of a distance, rounded down. Exponents count from 2^-32.
const fn code_of(distance: Float) -> i32 {
    let inverse = distance.reciprocal();
    ((inverse.exponent + 61) << MANTISSA_BITS) + (inverse.mantissa >> (30 - MANTISSA_BITS))
}

/// The distance in the middle of a code.
const fn distance_of(code: i32) -> Float {
    let (exponent, mantissa) = (code >> MANTISSA_BITS, code & ((1 << MANTISSA_BITS) - 1));
    let middle = 2 * ((1 << MANTISSA_BITS) + mantissa) + 1;
    Float::new(middle as i64, exponent - 32 - 1 - MANTISSA_BITS as i32).reciprocal()
}

impl Fog {
    /// Fog that begins at `start` and hides everything from `end` on, and grows evenly in between.
    /// `None` if the end is not beyond the start.
    #[must_use]
    pub const fn linear(start: Distance, end: Distance) -> Option<Self> {
        if start.to_bits() >= end.to_bits() {
            return None;
        }
        let way = end.to_bits() - start.to_bits();
        let law = Law::Linear {
            start: (start.to_bits() as i64) << 8,
            slope: Float::new(way as i64, -16).reciprocal(),
        };
        // A 1,024th.
        let first = Float::new(((start.to_bits() as i64) << 10) + way as i64, -26);
        Some(Self::between(Float::new(end.to_bits() as i64, -16), first, law))
    }

    /// Fog that leaves e<sup>-`density` w</sup> of what lies at the distance w.
    #[must_use]
    pub const fn exponential(density: Density) -> Self {
        if density.to_bits() == 0 {
            return Self { table: [0; ENTRIES + 1], first: 0, last: 0, shift: 0 };
        }
        let halvings = Float::new(density.to_bits() as i64, -24).times(LOG2_E);
        let unit = halvings.reciprocal();
        // Ten halvings leave a 1,024th, and log2 e of a 1,024th take one off.
        let (far, near) = (Float::new(10, 0), Float::new(LOG2_E.mantissa as i64, -40));
        Self::between(far.times(unit), near.times(unit), Law::Exponential { halvings })
    }

    /// The table of a law that changes between these distances.
    const fn between(far: Float, near: Float, law: Law) -> Self {
        // The first entry lies beyond the far distance.
        let (far, near) = (code_of(far) - 1, code_of(near) + 1);
        let mut shift = 0;
        while ((near - (far >> shift << shift)) >> shift) + 1 > ENTRIES as i32 {
            shift += 1;
        }
        let first = far >> shift << shift;
        let intervals = ((near - first) >> shift) + 1;
        let mut table = [0; ENTRIES + 1];
        let mut entry = 0;
        while entry <= intervals {
            table[entry as usize] = law.at(distance_of(first + (entry << shift)));
            entry += 1;
        }
        Self { table, first, last: (intervals << shift) - 1, shift }
    }

    /// How much of what lies at a distance the fog hides.
    #[must_use]
    pub const fn at(&self, distance: Distance) -> Alpha {
        if distance.to_bits() == 0 {
            return Alpha::CLEAR;
        }
        let code = code_of(Float::new(distance.to_bits() as i64, -16));
        Alpha::from_bits(((self.amount(code - self.first) + 32) >> 6) as u16)
    }

    /// The code of the first entry.
    pub(super) const fn first(&self) -> i32 {
        self.first
    }

    /// The amount in 2^-14 for a code less that of the first entry.
    #[inline(always)]
    pub(super) const fn amount(&self, position: i32) -> u32 {
        let position = if position < 0 {
            0
        } else if position > self.last {
            self.last as u32
        } else {
            position as u32
        };
        let entry = (position >> self.shift) as usize & (ENTRIES - 1);
        let (far, near) = (self.table[entry] as i32, self.table[entry + 1] as i32);
        let part = (position & !(!0 << self.shift)) as i32;
        let amount = far - (((far - near) * part) >> self.shift);
        if amount < 0 {
            0
        } else if amount > ALL {
            ALL as u32
        } else {
            amount as u32
        }
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    /// The definitions, in f64.
    enum Definition {
        Linear(f64, f64),
        Exponential(f64),
    }

    impl Definition {
        fn amount(&self, distance: f64) -> f64 {
            match *self {
                Self::Linear(start, end) => ((distance - start) / (end - start)).clamp(0.0, 1.0),
                Self::Exponential(density) => 1.0 - (-density * distance).exp(),
            }
        }

        fn fog(&self) -> Fog {
            match *self {
                Self::Linear(start, end) => {
                    Fog::linear(Distance::from_num(start), Distance::from_num(end)).unwrap()
                }
                Self::Exponential(density) => Fog::exponential(Density::from_num(density)),
            }
        }
    }

    /// All codes, each at both of its ends and in the middle.
    #[test]
    fn amounts_are_within_their_bound_at_all_distances() {
        let linear = [(0.0, 1.0), (0.0, 65_535.0), (2.0, 10.0), (0.5, 0.75), (10.0, 11.0)];
        let exponential = [0.001, 0.05, 1.0, 17.0, 255.0];
        let all = linear.map(|(start, end)| (Definition::Linear(start, end), end / (end - start)));
        let all = all.into_iter().chain(exponential.map(|d| (Definition::Exponential(d), 1.0)));
        for (definition, thinness) in all {
            let fog = definition.fog();
            let bound = f64::max(1.0 / 512.0, thinness / 1_024.0);
            let mut worst = 0f64;
            for code in 0..(60 << MANTISSA_BITS) {
                let amount = f64::from(fog.amount(code - fog.first)) / f64::from(ALL);
                let (exponent, mantissa) = (code >> 11, f64::from(code & 2_047));
                for part in [0.0, 0.5, 1.0] {
                    let inverse = (1.0 + (mantissa + part) / 2_048.0) * 2f64.powi(exponent - 32);
                    let error = (amount - definition.amount(1.0 / inverse)).abs();
                    assert!(error <= bound, "{error} of {bound} at {}", 1.0 / inverse);
                    worst = worst.max(error);
                }
            }
            // A bound far from what is found would find no fault.
            assert!(worst > bound / 8.0, "{worst} of {bound}");
        }
    }

    #[test]
    fn amounts_never_fall_with_the_distance() {
        let fogs = [Definition::Linear(1.0, 9.0).fog(), Definition::Exponential(0.3).fog()];
        for fog in fogs {
            let amounts: Vec<u32> = (0..60 << 11).map(|code| fog.amount(code)).collect();
            assert!(amounts.is_sorted_by(|a, b| a >= b));
            assert!(amounts[0] >= 16_384 - 16 && amounts[amounts.len() - 1] <= 16);
        }
    }

    #[test]
    fn fog_ends_beyond_its_start() {
        assert_eq!(Fog::linear(Distance::ONE, Distance::ONE), None);
        assert_eq!(Fog::linear(Distance::ONE, Distance::lit("0.5")), None);
        // The thinnest and the thickest.
        let least = Distance::from_bits(1);
        for (start, end) in [
            (Distance::ZERO, least),
            (Distance::ZERO, Distance::MAX),
            (Distance::MAX - least, Distance::MAX),
            (Distance::ONE, Distance::ONE + least),
        ] {
            let fog = Fog::linear(start, end).unwrap();
            assert_eq!(fog.at(Distance::ZERO), Alpha::CLEAR);
            let far = fog.amount(code_of(Float::new(1, 18)) - fog.first);
            assert_eq!(far, 1 << 14, "{start} {end}");
        }
    }

    #[test]
    fn no_density_is_no_fog() {
        let none = Fog::exponential(Density::ZERO);
        for distance in ["0", "0.1", "1", "65535"] {
            assert_eq!(none.at(Distance::lit(distance)), Alpha::CLEAR);
        }
        let thick = Fog::exponential(Density::MAX);
        assert_eq!(thick.at(Distance::ONE), Alpha::OPAQUE);
    }

    #[test]
    fn powers_of_a_half_are_exact() {
        for x in (0..1 << 30).step_by(1_000_003) {
            let exact = 2f64.powf(f64::from(x) / -f64::from(1 << 30)) * f64::from(1 << 30);
            assert!((f64::from(half_to(x)) - exact).abs() < 512.0, "{x}");
        }
    }
}
