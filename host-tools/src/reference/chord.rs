//! How far a straight line between two exact points of a span lies off the span in perspective.
//!
//! On the screen let q = 1 / w go linearly from q₀ to q₁, and so does u q. At the fraction t of the
//! way, u - u₀ = du t q₁ / (q₀ + t (q₁ - q₀)), and the chord has du t. With r = q₁ / q₀ the
//! difference is du t (1 - t) (r - 1) / (1 + t (r - 1)). Its derivative is 0 at t = 1 / (1 + √r),
//! where it is du (√r - 1) / (√r + 1).

/// How far linear interpolation between two exact points is off at most, from the difference `du`
/// of a varying between them and the ratio of their 1 / w, above 0.
///
/// ```
/// use host_tools::reference::chord_error;
///
/// // 64 texels of a wall, from a distance to four times that: a third of them.
/// assert!((chord_error(64.0, 4.0) - 64.0 / 3.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn chord_error(du: f64, ratio: f64) -> f64 {
    let root = ratio.sqrt();
    du.abs() * (root - 1.0).abs() / (root + 1.0)
}

/// The largest [`chord_error`] at place `at` of a span, for any division of it into steps of at
/// most `step` pixels between exact points.
///
/// `value` returns the exact varying and its 1 / w at a place from 0 to `last`, in pixels.
///
/// u is a quotient of two linear functions of the place, so W = u' q² is constant along the span
/// and a step of n pixels has du = n W / (q₀ q₁). Its error is then n² |W q'| / (q₀ q₁ (√q₀ +
/// √q₁)²): it grows with the length of the step, and where q falls. So the worst of the steps that
/// `at` is in is a whole one, as far towards the smaller q as the span reaches.
#[must_use]
pub fn chord_error_in_steps(
    value: impl Fn(usize) -> (f64, f64),
    last: usize,
    at: usize,
    step: usize,
) -> f64 {
    let falls = value(last).1 < value(0).1;
    let [from, to] = if falls {
        let to = (at + step).min(last);
        [to.saturating_sub(step), to]
    } else {
        let from = at.saturating_sub(step);
        [from, (from + step).min(last)]
    };
    let ((u0, q0), (u1, q1)) = (value(from), value(to));
    chord_error(u1 - u0, q1 / q0)
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    /// The varying and 1 / w at the fraction t between two points.
    fn between([(u0, q0), (u1, q1)]: [(f64, f64); 2], t: f64) -> (f64, f64) {
        let q = q0 + t * (q1 - q0);
        ((u0 * q0 * (1.0 - t) + u1 * q1 * t) / q, q)
    }

    #[test]
    fn the_law_is_the_largest_difference_of_a_span_in_small_steps() {
        const STEPS: usize = 20_000;
        let mut random = Random(7);
        for case in 0..60 {
            let [u0, u1] = [(); 2].map(|()| random.real(-64.0, 64.0));
            // Ratios from 1:1,000 to 1,000:1.
            let [q0, q1] = [(); 2].map(|()| 10f64.powf(random.real(-1.5, 1.5)));
            let ends = [(u0, q0), (u1, q1)];
            let off = |t: f64| (between(ends, t).0 - (u0 + t * (u1 - u0))).abs();
            let worst = (0..=STEPS).map(|i| off(i as f64 / STEPS as f64)).fold(0.0, f64::max);
            let law = chord_error(u1 - u0, q1 / q0);
            // 64-bit rounding of values up to 64, and at 1,000:1 the peak lies between two steps:
            // its second derivative is below 2 r² du there, so half a step is off by less than
            // r² du / STEPS² / 4 = 0.08 % of du.
            assert!(worst <= law + 1e-12, "{case}: {worst} {law}");
            assert!(law - worst <= 1e-3 * (u1 - u0).abs() + 1e-12, "{case}: {worst} {law}");
        }
    }

    #[test]
    fn by_hand() {
        assert_eq!(chord_error(10.0, 1.0), 0.0, "a wall square to the view");
        assert_eq!(chord_error(10.0, 9.0), 5.0);
        assert_eq!(chord_error(-10.0, 9.0), 5.0);
        assert!((chord_error(10.0, 1.0 / 9.0) - 5.0).abs() < 1e-14);
        // For ratios close to 1: du |ln r| / 4.
        assert!((chord_error(1.0, 1.001) - 0.001 / 4.0).abs() < 1e-6);
    }

    /// A receding wall with 64 texels per unit of depth over 320 pixels, in steps: the figures of
    /// the closed form, computed once by hand for the last step of the far end.
    #[test]
    fn the_worst_step_is_at_the_far_end() {
        for (ratio, steps) in [(2.0, 16), (10.0, 16), (100.0, 4)] {
            let wall = [(64.0, 1.0), (64.0 * ratio, 1.0 / ratio)];
            let value = |i: usize| between(wall, i as f64 / 320.0);
            let worst = (0..=320).map(|at| chord_error_in_steps(value, 320, at, steps));
            let (u0, q0) = value(320 - steps);
            let (u1, q1) = value(320);
            let last = chord_error(u1 - u0, q1 / q0);
            assert_eq!(worst.fold(0.0, f64::max), last, "{ratio}");
        }
    }

    #[test]
    fn no_division_into_steps_exceeds_the_bound() {
        let mut random = Random(8);
        let mut reached = 0;
        for _ in 0..300 {
            let last = random.real(0.0, 40.0) as usize;
            let step = 1 + random.real(0.0, 16.0) as usize;
            let ends =
                [(); 2].map(|()| (random.real(-64.0, 64.0), 10f64.powf(random.real(-1.0, 1.0))));
            let value = |i: usize| between(ends, i as f64 / last.max(1) as f64);
            for at in 0..=last {
                let bound = chord_error_in_steps(value, last, at, step);
                let mut worst = 0f64;
                for from in at.saturating_sub(step)..=at {
                    for to in at.max(from + 1)..=(from + step).min(last) {
                        let ((u0, q0), (u1, q1)) = (value(from), value(to));
                        worst = worst.max(chord_error(u1 - u0, q1 / q0));
                    }
                }
                assert!(worst <= bound * (1.0 + 1e-9) + 1e-12, "{worst} {bound}");
                // It is no wider than one of them.
                assert!(worst >= bound * (1.0 - 1e-9) - 1e-12, "{worst} {bound}");
                reached += usize::from(bound > 1e-3);
            }
        }
        assert!(reached > 1_000, "{reached}");
    }
}
