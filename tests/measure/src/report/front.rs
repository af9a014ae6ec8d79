//! The Pareto front: the choices that no other one beats in both error and cost.

/// The places of those points that are on the front, from the cheapest to the most exact. A point
/// is its cost and its error; of equal ones the first is kept.
pub(super) fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<_> = (0..points.len()).collect();
    order.sort_by(|&a, &b| {
        let ([cost_a, error_a], [cost_b, error_b]) = (points[a], points[b]);
        cost_a.total_cmp(&cost_b).then(error_a.total_cmp(&error_b))
    });
    let mut least = f64::INFINITY;
    order.retain(|&place| {
        let is_better = points[place][1] < least;
        least = least.min(points[place][1]);
        is_better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_has_what_nothing_beats() {
        let points = [[3.0, 1.0], [1.0, 9.0], [2.0, 9.0], [2.0, 4.0], [4.0, 1.0], [1.0, 9.0]];
        assert_eq!(front(&points), [1, 3, 0]);
        assert_eq!(front(&[]), [0; 0]);
    }
}
