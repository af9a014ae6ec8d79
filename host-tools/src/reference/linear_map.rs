//! A model that a matrix stretches, mirrors or shears before it is placed.

/// A linear map of space: a matrix that multiplies column vectors from the left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearMap {
    /// The rows of the matrix.
    pub rows: [[f64; 3]; 3],
}

impl LinearMap {
    /// Leaves all as it is.
    pub const IDENTITY: Self = Self { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

    /// By how much volumes grow; negative for one that mirrors.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        let [a, b, c] = self.rows;
        dot(a, cross(b, c))
    }

    /// Where it takes a point or a direction along the surface.
    #[must_use]
    pub fn point(&self, p: [f64; 3]) -> [f64; 3] {
        self.rows.map(|row| dot(row, p))
    }

    /// The inverse transpose times the normal of a plane: n . p + d of a point p is that times the
    /// place of p, plus d. The map has an inverse.
    #[must_use]
    pub fn plane_normal(&self, n: [f64; 3]) -> [f64; 3] {
        // The solution x of M^T x = n by Cramer's rule: the columns of M^T are the rows of M.
        let determinant = self.determinant();
        [0, 1, 2].map(|i| {
            let mut replaced = self.rows;
            replaced[i] = n;
            Self { rows: replaced }.determinant() / determinant
        })
    }

    /// The normal, of length 1, of the surface that it makes of one with the normal n: along the
    /// inverse transpose times n, so that it stays at right angles to all directions along the
    /// surface, and on the outer side of it. Zero for a zero vector. The map has an inverse.
    #[must_use]
    pub fn normal(&self, n: [f64; 3]) -> [f64; 3] {
        let normal = self.plane_normal(n);
        let length = dot(normal, normal).sqrt();
        if length > 0.0 { normal.map(|c| c / length) } else { [0.0; 3] }
    }

    /// How many times more it stretches in one direction than in another: the largest of its
    /// singular values over the least, 1 at least. Infinite without an inverse.
    #[must_use]
    pub fn unevenness(&self) -> f64 {
        if self.determinant() == 0.0 {
            return f64::INFINITY;
        }
        let inverse = Self { rows: Self::IDENTITY.rows.map(|axis| self.plane_normal(axis)) };
        (self.most() * inverse.most()).max(1.0)
    }

    /// The most by which it makes a vector longer: its largest singular value.
    fn most(&self) -> f64 {
        // The root of the largest eigenvalue of M M^T, a symmetric matrix: by Smith, "Eigenvalues
        // of a symmetric 3 x 3 matrix", CACM 4(4), 1961.
        let mut rest = self.rows.map(|a| self.rows.map(|b| dot(a, b)));
        let mean = (rest[0][0] + rest[1][1] + rest[2][2]) / 3.0;
        (0..3).for_each(|i| rest[i][i] -= mean);
        let spread = (rest.as_flattened().iter().map(|c| c * c).sum::<f64>() / 6.0).sqrt();
        if spread <= 1e-12 * mean {
            return mean.sqrt();
        }
        let scaled = Self { rows: rest.map(|row| row.map(|c| c / spread)) };
        let angle = (scaled.determinant() / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
        (mean + 2.0 * spread * angle.cos()).sqrt()
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        (0..3).all(|i| (a[i] - b[i]).abs() < 1e-9)
    }

    /// A rotation by the columns that two random directions span.
    fn rotation(random: &mut Random) -> LinearMap {
        let mut direction = || [(); 3].map(|()| random.real(-1.0, 1.0));
        let unit = |v: [f64; 3]| v.map(|c| c / dot(v, v).sqrt());
        let x = unit(direction());
        let z = unit(cross(x, direction()));
        LinearMap { rows: [x, cross(z, x), z] }
    }

    fn product(a: &LinearMap, b: &LinearMap) -> LinearMap {
        let column = |j: usize| a.point(b.rows.map(|row| row[j]));
        let columns = [column(0), column(1), column(2)];
        LinearMap { rows: [0, 1, 2].map(|i| columns.map(|column| column[i])) }
    }

    #[test]
    fn normals_stay_at_right_angles_and_outside() {
        let mut random = Random(71);
        let mut mirrors = 0;
        for _ in 0..1000 {
            let map =
                LinearMap { rows: [(); 3].map(|()| [(); 3].map(|()| random.real(-2.0, 2.0))) };
            if map.determinant().abs() < 0.1 {
                continue;
            }
            mirrors += usize::from(map.determinant() < 0.0);
            let [a, b, outward] = [(); 3].map(|()| [(); 3].map(|()| random.real(-1.0, 1.0)));
            let n = cross(a, b);
            let n = if dot(n, outward) < 0.0 { n.map(|c| -c) } else { n };
            let got = map.normal(n);
            assert!((dot(got, got) - 1.0).abs() < 1e-12);
            assert!(dot(got, map.point(a)).abs() < 1e-9 && dot(got, map.point(b)).abs() < 1e-9);
            assert!(dot(got, map.point(outward)) > 0.0);
            let plane = map.plane_normal(n);
            assert!((dot(plane, map.point(outward)) - dot(n, outward)).abs() < 1e-9);
        }
        assert!(mirrors > 300, "{mirrors}");
        assert_eq!(LinearMap::IDENTITY.normal([0.0; 3]), [0.0; 3]);
    }

    #[test]
    fn unevenness_is_the_ratio_of_stretches_between_rotations() {
        let mut random = Random(72);
        for _ in 0..1000 {
            let stretch = [(); 3].map(|()| 10f64.powf(random.real(-1.5, 1.5)));
            let [x, y, z] = stretch;
            let scaling = LinearMap { rows: [[x, 0.0, 0.0], [0.0, -y, 0.0], [0.0, 0.0, z]] };
            let turned =
                product(&rotation(&mut random), &product(&scaling, &rotation(&mut random)));
            let want = x.max(y).max(z) / x.min(y).min(z);
            let got = turned.unevenness();
            assert!((got / want - 1.0).abs() < 1e-6, "{got} {want}");
            assert!(close(turned.point([0.0; 3]), [0.0; 3]));
        }
        assert!((LinearMap::IDENTITY.unevenness() - 1.0).abs() < 1e-12);
        let flat = LinearMap { rows: [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 2.0, 0.0]] };
        assert_eq!(flat.unevenness(), f64::INFINITY);
    }
}
