//! Sums of unit vectors over those within an angle of a direction: a cap of the sphere.
//!
//! Round the tip of a cone of n sides lie n normals, and each side needs the sum of those within
//! the crease angle of its own. Adding them one by one takes time quadratic in n. A tree of balls
//! takes a ball that lies in the cap as a whole and leaves out one that lies beyond it.

use super::vector::{Vector, add, dot, length, scaled, sub};

/// The most vectors of a ball that is not divided.
const LEAF: usize = 8;

/// More than the rounding of the dot product of two unit vectors.
const MARGIN: f64 = 1e-12;

/// The steps in 1 of a sum. Whole numbers add up to the same sum in any order, so that equal caps
/// have equal sums, and their corners become one vertex.
const ONE: f64 = (1_u64 << 60) as f64;

/// A sum of vectors times their weights, and of the weights, in steps of 1 / [`ONE`].
type Sum = [i128; 4];

/// Unit vectors with weights.
pub(super) struct CapTree {
    vectors: Vec<(Vector, f64)>,
    /// Each ball, then those of its halves.
    balls: Vec<Ball>,
}

struct Ball {
    center: Vector,
    radius: f64,
    sum: Sum,
    /// The place after its last vector.
    end: usize,
    /// The place in [`CapTree::balls`] after its last part.
    next: usize,
}

fn term(&(vector, weight): &(Vector, f64)) -> Sum {
    let [x, y, z] = scaled(vector, weight);
    [x, y, z, weight].map(|value| (value * ONE).round() as i128)
}

fn total(a: Sum, b: Sum) -> Sum {
    std::array::from_fn(|i| a[i] + b[i])
}

impl CapTree {
    pub(super) fn new(vectors: Vec<(Vector, f64)>) -> Self {
        let mut tree = Self { vectors, balls: Vec::new() };
        tree.divide(0, tree.vectors.len());
        tree
    }

    fn divide(&mut self, start: usize, end: usize) {
        let vectors = &mut self.vectors[start..end];
        let mean = vectors.iter().fold([0.0; 3], |sum, &(vector, _)| add(sum, vector));
        let center = scaled(mean, 1.0 / vectors.len() as f64);
        let radius = vectors.iter().fold(0.0, |m: f64, &(v, _)| m.max(length(sub(v, center))));
        let sum = vectors.iter().map(term).fold([0; 4], total);
        let index = self.balls.len();
        self.balls.push(Ball { center, radius, sum, end, next: 0 });
        if vectors.len() > LEAF && radius > MARGIN {
            let extent = |axis: usize| {
                let along = vectors.iter().map(|(vector, _)| vector[axis]);
                along.clone().fold(f64::NEG_INFINITY, f64::max)
                    - along.fold(f64::INFINITY, f64::min)
            };
            let extents = [0, 1, 2].map(extent);
            let axis = (0..3).max_by(|&a, &b| extents[a].total_cmp(&extents[b])).unwrap_or(0);
            let half = vectors.len() / 2;
            vectors.select_nth_unstable_by(half, |(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
            self.divide(start, start + half);
            self.divide(start + half, end);
        }
        self.balls[index].next = self.balls.len();
    }

    /// The sum over all vectors whose dot product with `axis`, a unit vector, is at least `least`;
    /// also the sum of their weights.
    pub(super) fn sum(&self, axis: Vector, least: f64) -> (Vector, f64) {
        let (mut sum, mut start, mut index) = ([0; 4], 0, 0);
        while let Some(ball) = self.balls.get(index) {
            let middle = dot(ball.center, axis);
            let is_in = middle - ball.radius >= least + MARGIN;
            let is_out = middle + ball.radius < least - MARGIN;
            let is_leaf = ball.next == index + 1;
            if is_in {
                sum = total(sum, ball.sum);
            } else if is_leaf && !is_out {
                let vectors = self.vectors[start..ball.end].iter();
                let near = vectors.filter(|(vector, _)| dot(*vector, axis) >= least);
                sum = near.map(term).fold(sum, total);
            }
            if is_in || is_out || is_leaf {
                (start, index) = (ball.end, ball.next);
            } else {
                index += 1;
            }
        }
        let [x, y, z, weight] = sum.map(|steps| steps as f64 / ONE);
        ([x, y, z], weight)
    }
}

#[cfg(test)]
mod tests {
    use super::{super::vector::normalized, *};
    use crate::reference::random::Random;

    fn random_vectors(count: usize) -> Vec<(Vector, f64)> {
        let mut random = Random(7);
        let mut number = || random.snapped(-1.0, 1.0, 1e-6);
        (0..count)
            .filter_map(|_| Some((normalized([number(), number(), number()])?, number().abs())))
            .collect()
    }

    #[test]
    fn sums_are_those_of_adding_one_by_one() {
        let vectors = random_vectors(3_000);
        let tree = CapTree::new(vectors.clone());
        for &(axis, _) in &vectors[..50] {
            for least in [-1.1, -0.5, 0.0, 0.5, 0.99, 1.0 - 1e-9] {
                let near = vectors.iter().filter(|(vector, _)| dot(*vector, axis) >= least);
                let (sum, weight) = near.fold(([0.0; 3], 0.0), |(sum, weight), &(v, w)| {
                    (add(sum, scaled(v, w)), weight + w)
                });
                let found = tree.sum(axis, least);
                // The rounding of 3,000 sums of up to 3,000.
                assert!(length(sub(found.0, sum)) < 1e-9 && (found.1 - weight).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn equal_caps_have_equal_sums() {
        let vectors = random_vectors(1_000);
        let up: Vec<_> = vectors.iter().map(|&([x, y, z], w)| ([x, y, z.abs()], w)).collect();
        let tree = CapTree::new(up.clone());
        let all = tree.sum([0.0, 0.0, 1.0], -0.1);
        // Twice any two of these are less than 180 degrees apart, so that each cap holds all.
        assert!(up.iter().all(|&(axis, _)| tree.sum(axis, -1.1) == all));
        assert!(up.iter().all(|&(axis, _)| tree.sum(axis, -1.0 + 1e-12) == all));
    }
}
