//! Weights of a sum that are not below 0, by least squares.

/// The weights w >= 0 that make the sum of ((a w - b) / b)^2 over all rows (a, b) least, by the
/// active set of Lawson and Hanson, *Solving Least Squares Problems*, 1974, chapter 23.
///
/// Columns without any count get the weight 0.
pub(super) fn fit<const N: usize>(rows: &[([f64; N], f64)]) -> [f64; N] {
    // Columns of a norm of 1, so that none counts for more because of its unit.
    let norms: [f64; N] = std::array::from_fn(|column| {
        let squares = rows.iter().map(|(row, b)| (row[column] / b).powi(2)).sum::<f64>();
        if squares > 0.0 { squares.sqrt() } else { 1.0 }
    });
    let scaled: Vec<[f64; N]> =
        rows.iter().map(|(row, b)| std::array::from_fn(|i| row[i] / b / norms[i])).collect();
    let products = |i: usize, j: usize| scaled.iter().map(|row| row[i] * row[j]).sum::<f64>();
    let gram: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| products(i, j)));
    let right: [f64; N] = std::array::from_fn(|i| scaled.iter().map(|row| row[i]).sum());

    let (mut weights, mut is_free) = ([0.0; N], [false; N]);
    for _ in 0..10 * N {
        let gradient: [f64; N] = std::array::from_fn(|i| {
            right[i] - (0..N).map(|j| gram[i][j] * weights[j]).sum::<f64>()
        });
        let best =
            (0..N).filter(|&i| !is_free[i]).max_by(|&a, &b| gradient[a].total_cmp(&gradient[b]));
        let Some(best) = best.filter(|&best| gradient[best] > 1e-9) else { break };
        is_free[best] = true;
        loop {
            let solved = solve(&gram, &right, &is_free);
            let below = (0..N).filter(|&i| is_free[i] && solved[i] <= 0.0);
            // As far towards the solution as no weight falls below 0.
            let step = below.map(|i| weights[i] / (weights[i] - solved[i])).fold(1.0, f64::min);
            for i in 0..N {
                weights[i] += step * (solved[i] - weights[i]);
            }
            if step >= 1.0 {
                break;
            }
            for i in 0..N {
                if is_free[i] && weights[i] <= 1e-12 {
                    (is_free[i], weights[i]) = (false, 0.0);
                }
            }
        }
    }
    std::array::from_fn(|i| weights[i] / norms[i])
}

/// Solves the equations of the free columns by elimination. A column that depends on others gets 0.
fn solve<const N: usize>(gram: &[[f64; N]; N], right: &[f64; N], is_free: &[bool; N]) -> [f64; N] {
    let free: Vec<usize> = (0..N).filter(|&i| is_free[i]).collect();
    let mut rows: Vec<Vec<f64>> = (free.iter())
        .map(|&i| free.iter().map(|&j| gram[i][j]).chain([right[i]]).collect())
        .collect();
    let count = free.len();
    let mut pivots = vec![None; count];
    let mut done = 0;
    for column in 0..count {
        let Some(row) =
            (done..count).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
        else {
            break;
        };
        if rows[row][column].abs() < 1e-10 {
            continue;
        }
        rows.swap(done, row);
        let pivot = rows[done].clone();
        let (before, rest) = rows.split_at_mut(done);
        for row in before.iter_mut().chain(rest.iter_mut().skip(1)) {
            let factor = row[column] / pivot[column];
            for (value, pivot) in row.iter_mut().zip(&pivot) {
                *value -= factor * pivot;
            }
        }
        pivots[column] = Some(done);
        done += 1;
    }
    let mut solved = [0.0; N];
    for (column, row) in pivots.iter().enumerate() {
        if let Some(row) = *row {
            solved[free[column]] = rows[row][count] / rows[row][column];
        }
    }
    solved
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_a_sum_are_found() {
        let rows: Vec<_> = (1..20_i32)
            .map(|i| {
                let row = [f64::from(i), f64::from(i * i), 1.0, 0.0];
                (row, 3.0 * row[0] + 0.5 * row[1] + 40.0)
            })
            .collect();
        let weights = fit(&rows);
        for (weight, expected) in weights.into_iter().zip([3.0, 0.5, 40.0, 0.0]) {
            assert!((weight - expected).abs() < 1e-6, "{weights:?}");
        }
    }

    #[test]
    fn no_weight_is_below_0() {
        // The best weights without the condition are 2 and -1.
        let rows: Vec<_> =
            (2..20_i32).map(|i| ([f64::from(i), 1.0], 2.0 * f64::from(i) - 1.0)).collect();
        let weights = fit(&rows);
        assert!(weights[1] == 0.0 && (1.8..2.0).contains(&weights[0]), "{weights:?}");
    }
}
