//! The inverse square root, from a table and three Newton steps, and unit vectors, which use it.

/// The inverse square root in the middle of each of 128 intervals of [0, 1), in 256ths, less 256.
/// Entries below 1/4 are never read: they make any 7 bits an index in range.
const SEED: [u8; 128] = {
    let mut seed = [0; 128];
    let mut interval = 32;
    while interval < 128 {
        // The middle of the interval is (2 i + 1) / 256; 256 times its inverse root, rounded.
        let middle = 2 * interval as u64 + 1;
        let twice = ((1u64 << 26) / middle).isqrt();
        seed[interval] = (twice.div_ceil(2) - 256) as u8;
        interval += 1;
    }
    seed
};

/// 1 / √`value` as `(mantissa, exponent)`, which stand for `mantissa * 2^exponent`.
///
/// The mantissa is from 2<sup>30</sup> to 2<sup>31</sup>, and its relative error is below
/// 2<sup>-28</sup>: each step turns an error e, 2<sup>-6.8</sup> from the table, into 1.5
/// e<sup>2</sup>, down to the limit of 30-bit arithmetic. 0 counts as 1.
pub(crate) const fn inverse_square_root(value: u64) -> (u32, i32) {
    let value = if value == 0 { 1 } else { value };
    // Normalised by an even shift to m / 2^32 in [1/4, 1).
    let zeros = value.leading_zeros() & !1;
    let m = (value << zeros) >> 32;
    (mantissa(m), zeros as i32 / 2 - 62)
}

/// 2^46 / sqrt(m) for 2^30 <= m < 2^32.
const fn mantissa(m: u64) -> u32 {
    let mut y = (256 + SEED[(m >> 25) as usize & 127] as u64) << 22;
    let mut step = 0;
    while step < 3 {
        // y (3 - m y^2) / 2 in Q30
        let square = (y * y) >> 30;
        let near_one = (m * square) >> 32;
        y = (y * ((3 << 30) - near_one)) >> 31;
        step += 1;
    }
    y as u32
}

/// A direction as three numbers in Q30 whose squares add up to 1, within 2<sup>-28</sup>, or `None`
/// for a zero vector. Or as four.
#[inline(never)]
pub(crate) const fn unit<const N: usize>(v: [i64; N]) -> Option<[i32; N]> {
    const { assert!(N <= 4) }
    let (mut largest, mut axis) = (0, 0);
    while axis < N {
        largest |= v[axis].unsigned_abs();
        axis += 1;
    }
    if largest == 0 {
        return None;
    }
    // To 30 bits, so that four squares add up in 64.
    let shift = 34 - largest.leading_zeros() as i32;
    let (mut v, mut squares, mut axis) = (v, 0, 0);
    while axis < N {
        v[axis] = if shift > 0 { v[axis] >> shift } else { v[axis] << -shift };
        squares += (v[axis] * v[axis]) as u64;
        axis += 1;
    }
    let (mantissa, exponent) = inverse_square_root(squares);
    // c * mantissa * 2^exponent in Q30, rounded; c has 30 bits, the mantissa 31, and exponent + 30
    // is about -31.
    let down = -(exponent + 30);
    let mut unit = [0; N];
    while axis > 0 {
        axis -= 1;
        unit[axis] = ((v[axis] * mantissa as i64 + (1 << (down - 1))) >> down) as i32;
    }
    Some(unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of a Newton step is a smooth function of m inside one interval of the table, so
    /// that steps of 61 cannot miss its bound by more than 61 / 2^30 of the slope, below 2^-33.
    #[test]
    fn error_bound_holds_for_all_mantissas() {
        let worst = (1u64 << 30..1 << 32)
            .step_by(61)
            .map(|m| (f64::from(mantissa(m)) * (m as f64).sqrt() / 2f64.powi(46) - 1.0).abs())
            .fold(0.0, f64::max);
        assert!(worst < 2f64.powi(-28), "2^{}", worst.log2());
    }

    #[test]
    fn scales_with_the_value() {
        for shift in 0..64 {
            for value in [1u64 << shift, (1u64 << shift) | 1, ((1u64 << shift) - 1) | 1] {
                let (mantissa, exponent) = inverse_square_root(value);
                let got = f64::from(mantissa) * 2f64.powi(exponent) * (value as f64).sqrt();
                assert!((got - 1.0).abs() < 2f64.powi(-28), "1/sqrt({value})");
            }
        }
    }

    #[test]
    fn unit_vectors_have_length_one_and_keep_their_direction() {
        let cases = [
            [1, 0, 0],
            [0, -7, 0],
            [3, 4, 0],
            [1, 1, 1],
            [i64::from(i32::MAX) * 2, 5, -9],
            [1 << 61, -(1 << 61), 1 << 61],
            [-1, 1 << 40, 3],
        ];
        for v in cases {
            let u = unit(v).unwrap().map(|c| f64::from(c) / 2f64.powi(30));
            let length = v.iter().map(|&c| (c as f64).powi(2)).sum::<f64>().sqrt();
            for axis in 0..3 {
                assert!((u[axis] - v[axis] as f64 / length).abs() < 2f64.powi(-28), "{v:?} {u:?}");
            }
        }
        assert_eq!(unit([0; 3]), None);
    }
}
