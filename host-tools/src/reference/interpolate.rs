//! Values between the vertices of a triangle.
//!
//! Vulkan specification, "Basic polygon rasterization" (OpenGL 4.6 core profile, section 14.6.1, is
//! the same): depth is linear in screen space; everything else is linear on the surface in space,
//! so the division by w makes it hyperbolic in the picture.

use super::coverage::doubled_area;

/// The value at the point with the given barycentric weights, linear between the three vertices.
///
/// The sum starts from the first vertex, so that three equal values give exactly that value at
/// every point.
pub(super) const fn linear(weights: [f64; 3], values: [f64; 3]) -> f64 {
    values[0] + weights[1] * (values[1] - values[0]) + weights[2] * (values[2] - values[0])
}

/// [`linear`] for each varying of three vertices.
pub(super) fn linear_each<const N: usize>(weights: [f64; 3], varyings: [[f64; N]; 3]) -> [f64; N] {
    std::array::from_fn(|i| linear(weights, varyings.map(|corner| corner[i])))
}

/// The barycentric weights on the surface in space of the point that has the barycentric `weights`
/// on the screen, from the reciprocal of each vertex's w.
///
/// A value f is hyperbolic on the screen: f / w and 1 / w are linear there, so f = Σ(bᵢ fᵢ / wᵢ) /
/// Σ(bᵢ / wᵢ).
pub(super) fn in_perspective(weights: [f64; 3], inverse_w: [f64; 3]) -> [f64; 3] {
    let parts = [0, 1, 2].map(|i| weights[i] * inverse_w[i]);
    let sum = parts[0] + parts[1] + parts[2];
    parts.map(|part| part / sum)
}

/// How the barycentric weights of a triangle on the screen change from a pixel to the one on its
/// right, and to the one below. The changes of the three sum to 0.
pub(super) fn weight_slopes(corners: [[f64; 2]; 3]) -> [[f64; 3]; 2] {
    let area = doubled_area(corners);
    // The weight of a corner is its distance from the opposite side, over the area.
    let side =
        |i: usize| [0, 1].map(|axis| corners[(i + 2) % 3][axis] - corners[(i + 1) % 3][axis]);
    [[0, 1, 2].map(|i| -side(i)[1] / area), [0, 1, 2].map(|i| side(i)[0] / area)]
}

/// The change of a [`linear`] value from the changes of the weights.
const fn linear_slope(slopes: [f64; 3], values: [f64; 3]) -> f64 {
    slopes[1] * (values[1] - values[0]) + slopes[2] * (values[2] - values[0])
}

/// [`linear_slope`] for each varying of three vertices.
pub(super) fn linear_slope_each<const N: usize>(
    slopes: [f64; 3],
    varyings: [[f64; N]; 3],
) -> [f64; N] {
    std::array::from_fn(|i| linear_slope(slopes, varyings.map(|corner| corner[i])))
}

/// The derivatives of the weights [`in_perspective`] from those of the weights on the screen.
///
/// With pᵢ = bᵢ / wᵢ and its sum q, the derivative of pᵢ / q is (pᵢ' - pᵢ / q q') / q.
pub(super) fn slopes_in_perspective(
    weights: [f64; 3],
    slopes: [f64; 3],
    inverse_w: [f64; 3],
) -> [f64; 3] {
    let parts = [0, 1, 2].map(|i| weights[i] * inverse_w[i]);
    let changes = [0, 1, 2].map(|i| slopes[i] * inverse_w[i]);
    let (sum, change) = (parts.iter().sum::<f64>(), changes.iter().sum::<f64>());
    [0, 1, 2].map(|i| (changes[i] - parts[i] / sum * change) / sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_values_hold_at_the_vertices_and_between() {
        let values = [3.0, 7.0, -5.0];
        assert_eq!(linear([1.0, 0.0, 0.0], values), 3.0);
        assert_eq!(linear([0.0, 1.0, 0.0], values), 7.0);
        assert_eq!(linear([0.0, 0.0, 1.0], values), -5.0);
        assert_eq!(linear([0.5, 0.25, 0.25], values), 2.0);
        let varyings = [[3.0, 0.0], [7.0, 1.0], [-5.0, 2.0]];
        assert_eq!(linear_each([0.5, 0.25, 0.25], varyings), [2.0, 0.75]);
    }

    #[test]
    fn equal_values_stay_exactly_equal() {
        // 0.1 + 0.2 + 0.7 is not 1 in f64.
        for value in [0.1, 1.0 / 3.0, 217.3] {
            assert_eq!(linear([0.1, 0.2, 0.7], [value; 3]), value);
            let weights = in_perspective([0.1, 0.2, 0.7], [0.9, 0.3, 0.01]);
            assert_eq!(linear(weights, [value; 3]), value);
        }
    }

    #[test]
    fn the_middle_of_the_screen_lies_closer_to_the_nearer_vertex() {
        // From w = 1 to w = 3, halfway on the screen: 1 / w = (1 + 1/3) / 2 = 2/3, so w = 1.5, a
        // quarter of the way.
        let weights = in_perspective([0.5, 0.5, 0.0], [1.0, 1.0 / 3.0, 1.0]);
        assert!((weights[0] - 0.75).abs() < 1e-15, "{weights:?}");
        assert!((weights[1] - 0.25).abs() < 1e-15, "{weights:?}");
        assert_eq!(weights[2], 0.0);
    }

    #[test]
    fn equal_distances_leave_the_weights_alone() {
        assert_eq!(in_perspective([0.25, 0.25, 0.5], [0.125; 3]), [0.25, 0.25, 0.5]);
    }

    #[test]
    fn slopes_by_hand() {
        // A right triangle with legs of 4 to the right and 2 down.
        for corners in [[[1.0, 1.0], [5.0, 1.0], [1.0, 3.0]], [[1.0, 1.0], [1.0, 3.0], [5.0, 1.0]]]
        {
            let [right, down] = weight_slopes(corners);
            let values = corners.map(|[x, y]| 7.0 + 3.0 * x - 2.0 * y);
            assert_eq!([linear_slope(right, values), linear_slope(down, values)], [3.0, -2.0]);
            let both = linear_slope_each(down, values.map(|value| [value, 1.0]));
            assert_eq!(both, [-2.0, 0.0]);
        }
        let [right, down] = weight_slopes([[1.0, 1.0], [5.0, 1.0], [1.0, 3.0]]);
        assert_eq!([right, down], [[-0.25, 0.25, 0.0], [-0.5, 0.0, 0.5]]);
    }

    #[test]
    fn slopes_in_perspective_are_the_limit_of_differences() {
        let (weights, slopes) = ([0.5, 0.3, 0.2], [0.11, -0.07, -0.04]);
        let inverse_w = [1.0, 0.25, 0.01];
        const STEP: f64 = 1e-6;
        let at = |t: f64| in_perspective([0, 1, 2].map(|i| weights[i] + t * slopes[i]), inverse_w);
        let (after, before) = (at(STEP), at(-STEP));
        for (i, slope) in slopes_in_perspective(weights, slopes, inverse_w).into_iter().enumerate()
        {
            // Roundings of 2^-53 over 2e-6 are 1e-10; the third derivative adds less.
            assert!((slope - (after[i] - before[i]) / (2.0 * STEP)).abs() < 1e-9);
        }
        // Weights sum to 1 wherever they are.
        let sum: f64 = slopes_in_perspective(weights, slopes, inverse_w).iter().sum();
        assert!(sum.abs() < 1e-15);
    }
}
