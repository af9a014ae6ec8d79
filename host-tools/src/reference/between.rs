//! A model on the way from one shape to another.

/// A part of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Between {
    /// 0 is the first shape, 1 the second.
    pub progress: f64,
}

impl Between {
    /// What two vectors have on the way: each coordinate changes evenly.
    #[must_use]
    pub fn point(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        let t = self.progress;
        [0, 1, 2].map(|i| from[i] * (1.0 - t) + to[i] * t)
    }

    /// The same in whole numbers: each coordinate is rounded to the nearest one, the larger of two.
    #[must_use]
    pub fn whole(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        self.point(from, to).map(|c| (c + 0.5).floor())
    }

    /// The normal of length 1 on the way: along what [`point`](Self::point) has of both. Zero where
    /// opposite ones meet.
    #[must_use]
    pub fn normal(&self, from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
        let blend = self.point(from, to);
        let length = length(blend);
        if length > 0.0 { blend.map(|c| c / length) } else { [0.0; 3] }
    }

    /// The length of a blend of two normals of length 1: the closer to opposite they are, the more
    /// an error of either turns it.
    #[must_use]
    pub fn steadiness(&self, from: [f64; 3], to: [f64; 3]) -> f64 {
        length(self.point(from, to))
    }
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_change_evenly_and_normals_have_length_one() {
        let (from, to) = ([0.0, -4.0, 1.0], [8.0, 4.0, 1.0]);
        let at = |progress| Between { progress };
        assert_eq!(at(0.0).point(from, to), from);
        assert_eq!(at(1.0).point(from, to), to);
        assert_eq!(at(0.25).point(from, to), [2.0, -2.0, 1.0]);
        assert_eq!(at(0.5).whole([0.0, -1.0, 3.0], [1.0, 0.0, 3.0]), [1.0, 0.0, 3.0]);
        let ([x, y], half) = ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], 0.5f64.sqrt());
        let normal = at(0.5).normal(x, y);
        assert!((normal[0] - half).abs() < 1e-15 && normal[0] == normal[1] && normal[2] == 0.0);
        assert!((at(0.5).steadiness(x, y) - half).abs() < 1e-15);
        assert_eq!(at(0.5).normal(x, x.map(|c| -c)), [0.0; 3]);
    }
}
