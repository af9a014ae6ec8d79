//! Directions in 16 bits, for vertices and pixels: as quick as a core without a long multiply can
//! compute them.

use super::{leading_zeros, length::inverse_length};

/// A direction of length one, and how long the vector is that it comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction {
    /// In Q15; zero for a zero vector.
    pub(crate) unit: [i32; 3],
    /// The square of the length, from 2^30 to 2^32.
    pub(crate) square: u32,
    /// The exponent of its unit, which is even.
    pub(crate) exponent: i32,
}

impl Direction {
    /// Of a vector of coordinates below 2^31 in magnitude, within 2^-13.
    #[inline(always)]
    pub(crate) fn of(v: [i32; 3]) -> Self {
        let magnitudes = v.map(|c| (c ^ (c >> 31)) as u32);
        // To 15 bits, so that three squares fit 32.
        let up = leading_zeros(magnitudes[0] | magnitudes[1] | magnitudes[2] | 1) as i32 - 17;
        let short = v.map(|c| if up >= 0 { c << up } else { ((c >> (-up - 1)) + 1) >> 1 });
        let (square, half) = normalised_square(square(short));
        Self { unit: scaled(short, square, half), square, exponent: -2 * (up + half as i32) }
    }
}

impl Direction {
    /// The direction as a normal of a mesh, 127 standing for 1, each coordinate rounded.
    #[inline(always)]
    pub(crate) fn in_127ths(&self) -> [i8; 3] {
        self.unit.map(|c| ((c * 127 + (1 << 14)) >> 15) as i8)
    }
}

/// The direction of a vector of a length below 2^16, in Q15, within 2^-13; zero for a zero vector.
#[inline(always)]
pub(crate) fn unit_q15(v: [i32; 3]) -> [i32; 3] {
    let (square, half) = normalised_square(square(v));
    scaled(v, square, half)
}

/// The scalar product of directions in Q15, in Q30.
#[inline(always)]
pub(crate) const fn dot_q15([a, b, c]: &[i32; 3], [d, e, f]: &[i32; 3]) -> i32 {
    *a * *d + *b * *e + *c * *f
}

#[inline(always)]
const fn square([x, y, z]: [i32; 3]) -> u32 {
    const fn squared(c: i32) -> u32 {
        c.cast_unsigned().wrapping_mul(c.cast_unsigned())
    }
    // Below 2^32, as the length is below 2^16.
    squared(x).wrapping_add(squared(y)).wrapping_add(squared(z))
}

/// A square shifted by an even number of bits to 2^30 or more, and half that number.
#[inline(always)]
fn normalised_square(square: u32) -> (u32, u32) {
    if square >> 30 != 0 {
        (square, 0)
    } else if square >> 28 != 0 {
        (square << 2, 1)
    } else {
        normalised_small_square(square)
    }
}

#[cold]
#[inline(never)]
fn normalised_small_square(square: u32) -> (u32, u32) {
    let half = leading_zeros(square.max(1)) >> 1;
    (square.max(1) << (2 * half), half)
}

/// c 2^half / √square in Q15, rounded.
#[inline(always)]
fn scaled(v: [i32; 3], square: u32, half: u32) -> [i32; 3] {
    // 2^30 / √square, 15 bits: with a coordinate, which is no longer than the root, at most 2^30.
    let factor = ((inverse_length(square >> 2) + 1) >> 1) as i32;
    v.map(|c| ((c << half) * factor + (1 << 14)) >> 15)
}

/// 2^46 / `sum`, for 2^30 <= sum < 2^32, within 2^-13 of itself.
#[inline(always)]
pub(crate) const fn inverse_square(sum: u32) -> u32 {
    // 2^31 / √sum, below 2^16.
    let root = inverse_length(sum >> 2);
    (root * root + (1 << 15)) >> 16
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn error(got: [i32; 3], v: [i32; 3]) -> f64 {
        let v = v.map(f64::from);
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        let parts = (0..3).map(|i| (f64::from(got[i]) / 32_768.0 - v[i] / length).powi(2));
        parts.sum::<f64>().sqrt()
    }

    #[test]
    fn directions_of_any_length_keep_their_bound() {
        let mut random = Random::new(11);
        for step in 0..200_000 {
            let bits = 1 + step % 31;
            let v = [(); 3].map(|()| {
                let c = (random.bits() >> 33) as i32;
                if random.bits() & 1 == 0 { c >> (31 - bits) } else { -(c >> (31 - bits)) }
            });
            if v == [0; 3] {
                continue;
            }
            let direction = Direction::of(v);
            assert!(error(direction.unit, v) < 2f64.powi(-13), "{v:?}: {direction:?}");
            let exact: f64 = v.iter().map(|&c| f64::from(c).powi(2)).sum();
            let got = f64::from(direction.square) * 2f64.powi(direction.exponent);
            // A coordinate of 15 bits is rounded by half a unit.
            assert!((got / exact - 1.0).abs() < 2f64.powi(-13), "{v:?}: {direction:?}");
            assert!(direction.square >> 30 != 0 && direction.exponent % 2 == 0);
        }
        assert_eq!(Direction::of([0; 3]).unit, [0; 3]);
    }

    #[test]
    fn vectors_of_16_bits_keep_their_bound() {
        let mut random = Random::new(12);
        for step in 0..200_000u32 {
            let length = f64::from(1 + step % 65_535);
            let v = [(); 3].map(|()| (random.bits() >> 33) as f64 / 2f64.powi(30) - 1.0);
            let norm = v.iter().map(|c| c * c).sum::<f64>().sqrt();
            let v = v.map(|c| (c / norm * length) as i32);
            if v != [0; 3] {
                let bound = 2f64.powi(-13);
                assert!(error(unit_q15(v), v) < bound, "{v:?}: {:?}", unit_q15(v));
            }
        }
        assert_eq!(unit_q15([0; 3]), [0; 3]);
    }

    #[test]
    fn inverse_squares_keep_their_bound() {
        for sum in (1u64 << 30..1 << 32).step_by(10_007) {
            let exact = 2f64.powi(46) / sum as f64;
            let got = f64::from(inverse_square(sum as u32));
            assert!((got / exact - 1.0).abs() < 2f64.powi(-13), "{sum}: {got} {exact}");
        }
    }
}
