//! What a pixel sees of a texture: the coordinate at its centre, and how that changes around it.

/// A texture coordinate at a pixel centre, with its exact derivatives on the screen. 1 is a
/// texture's width or height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// u and v.
    pub uv: [f64; 2],
    /// Their change to the right, per pixel.
    pub per_column: [f64; 2],
    /// Their change downwards, per pixel.
    pub per_row: [f64; 2],
    /// 1 / w, in the unit of the corners.
    pub inverse_w: f64,
}

impl Footprint {
    /// What [`in_perspective`](Self::in_perspective) expects of a corner: its coordinate over w and
    /// its 1 / w, which are linear on the screen.
    #[must_use]
    pub fn over_w([u, v]: [f64; 2], inverse_w: f64) -> [f64; 3] {
        [u * inverse_w, v * inverse_w, inverse_w]
    }

    /// Divides what is interpolated linearly on the screen from [`over_w`](Self::over_w) at the
    /// corners, given with its derivatives.
    ///
    /// u = s / q, so u' = (s' - u q') / q.
    #[must_use]
    pub fn in_perspective(over_w: [f64; 3], per_column: [f64; 3], per_row: [f64; 3]) -> Self {
        let [s, t, q] = over_w;
        let uv = [s / q, t / q];
        let slopes =
            |[s, t, change]: [f64; 3]| [(s - uv[0] * change) / q, (t - uv[1] * change) / q];
        Self { uv, per_column: slopes(per_column), per_row: slopes(per_row), inverse_w: q }
    }

    /// The determinant of the derivatives: the texture's area per pixel. In perspective it is K /
    /// q³ with q = 1 / w and a K that is constant in a triangle.
    #[must_use]
    pub const fn area(&self) -> f64 {
        self.per_column[0] * self.per_row[1] - self.per_column[1] * self.per_row[0]
    }

    /// The exact level of detail in a texture of `size` texels: log₂ of the texels that a pixel is
    /// long, along the row or the column, whichever is more (Vulkan specification, "Scale factor,
    /// level-of-detail operation and image level selection"). 0 or less where texels are larger
    /// than pixels; -∞ where the coordinate is constant.
    #[must_use]
    pub fn level(&self, size: [usize; 2]) -> f64 {
        let length = |[u, v]: [f64; 2]| (u * size[0] as f64).hypot(v * size[1] as f64);
        length(self.per_column).max(length(self.per_row)).log2()
    }

    /// The level of detail by the area of a pixel in texels: log₂ √|area|. Never above
    /// [`level`](Self::level); the same where a pixel is a square in the texture.
    #[must_use]
    pub fn level_by_area(&self, size: [usize; 2]) -> f64 {
        (self.area().abs() * size[0] as f64 * size[1] as f64).log2() / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::super::screen::{ScreenTriangle, ScreenVertex, draw_screen};
    use super::*;

    fn footprint(per_column: [f64; 2], per_row: [f64; 2]) -> Footprint {
        Footprint { uv: [0.0; 2], per_column, per_row, inverse_w: 1.0 }
    }

    #[test]
    fn levels_by_hand() {
        let size = [64, 128];
        // A texel per pixel; four to the right and one down; turned by a quarter; half a texel.
        let one = footprint([1.0 / 64.0, 0.0], [0.0, 1.0 / 128.0]);
        assert_eq!([one.level(size), one.level_by_area(size)], [0.0, 0.0]);
        let long = footprint([4.0 / 64.0, 0.0], [0.0, 1.0 / 128.0]);
        assert_eq!([long.level(size), long.level_by_area(size)], [2.0, 1.0]);
        let turned = footprint([0.0, -8.0 / 128.0], [8.0 / 64.0, 0.0]);
        assert_eq!([turned.level(size), turned.level_by_area(size)], [3.0, 3.0]);
        let close = footprint([0.5 / 64.0, 0.0], [0.0, 0.5 / 128.0]);
        assert_eq!([close.level(size), close.level_by_area(size)], [-1.0, -1.0]);
        // 3 and 4 texels for a pixel are 5.
        let slanted = footprint([3.0 / 64.0, 4.0 / 128.0], [0.0, 0.0]);
        assert_eq!(slanted.level(size), 5f64.log2());
        assert_eq!(slanted.level_by_area(size), f64::NEG_INFINITY);
        assert_eq!(footprint([0.0; 2], [0.0; 2]).level(size), f64::NEG_INFINITY);
    }

    /// Random triangles in random perspective; `visit` gets corners, 1 / w and coordinates of
    /// each, and the footprint at a pixel. Returns the number of pixels.
    fn triangles(
        seed: u64,
        visit: impl Fn([[f64; 2]; 3], [f64; 3], [[f64; 2]; 3], [f64; 2], Footprint),
    ) -> usize {
        let mut random = Random(seed);
        let pixels = std::cell::Cell::new(0);
        for _ in 0..200 {
            let corners = [(); 3].map(|()| [(); 2].map(|()| random.snapped(0.0, 40.0, 1.0 / 16.0)));
            let inverse_w = [(); 3].map(|()| 10f64.powf(random.real(-3.0, 0.0)));
            let uv = [(); 3].map(|()| [(); 2].map(|()| random.real(-64.0, 64.0)));
            let vertices = [0, 1, 2].map(|i| ScreenVertex {
                x: corners[i][0],
                y: corners[i][1],
                depth: inverse_w[i],
                varyings: Footprint::over_w(uv[i], inverse_w[i]),
            });
            let _ = draw_screen(&[ScreenTriangle { vertices, number: 0 }], (40, 40), |sample| {
                let center = sample.pixel.map(|c| c as f64 + 0.5);
                let found =
                    Footprint::in_perspective(sample.varyings, sample.per_column, sample.per_row);
                assert_eq!(found.inverse_w, sample.varyings[2]);
                visit(corners, inverse_w, uv, center, found);
                pixels.set(pixels.get() + 1);
                None::<()>
            });
        }
        pixels.get()
    }

    /// The coordinate where the ray of a place on the screen meets the triangle's plane in space:
    /// by Cramer's rule from the corners (x w, y w, w), which are points on the rays of theirs.
    fn by_ray(corners: [[f64; 2]; 3], q: [f64; 3], uv: [[f64; 2]; 3], at: [f64; 2]) -> [f64; 2] {
        let points = [0, 1, 2].map(|i| [corners[i][0] / q[i], corners[i][1] / q[i], 1.0 / q[i]]);
        let determinant = |[a, b, c]: [[f64; 3]; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let ray = [at[0], at[1], 1.0];
        let parts = [0, 1, 2].map(|i| {
            let mut replaced = points;
            replaced[i] = ray;
            determinant(replaced)
        });
        let sum: f64 = parts.iter().sum();
        [0, 1].map(|axis| (0..3).map(|i| parts[i] / sum * uv[i][axis]).sum())
    }

    #[test]
    fn the_coordinate_is_where_the_ray_meets_the_triangle() {
        let pixels = triangles(21, |corners, q, uv, at, found| {
            let expected = by_ray(corners, q, uv, at);
            // Thin triangles multiply the rounding of determinants of 1e9 by 1e-16.
            for (found, expected) in found.uv.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            }
        });
        assert!(pixels > 20_000, "{pixels}");
    }

    #[test]
    fn derivatives_are_the_limits_of_differences() {
        const STEP: f64 = 1e-4;
        let pixels = triangles(22, |corners, q, uv, [x, y], found| {
            let at = |x, y| by_ray(corners, q, uv, [x, y]);
            for (slope, after, before) in [
                (found.per_column, at(x + STEP, y), at(x - STEP, y)),
                (found.per_row, at(x, y + STEP), at(x, y - STEP)),
            ] {
                for axis in 0..2 {
                    let limit = (after[axis] - before[axis]) / (2.0 * STEP);
                    // The rounding of the rays over the step, and the third derivative.
                    let size =
                        found.per_column.map(f64::abs)[axis] + found.per_row.map(f64::abs)[axis];
                    assert!((slope[axis] - limit).abs() < 1e-3 + 1e-3 * size, "{slope:?} {limit}");
                }
            }
        });
        assert!(pixels > 20_000, "{pixels}");
    }

    #[test]
    fn the_area_of_a_pixel_is_a_constant_over_the_cube_of_inverse_w() {
        let cross = |[a, b, c]: [[f64; 2]; 3]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let pixels = triangles(23, |corners, q, uv, _, found| {
            let k = q[0] * q[1] * q[2] * cross(uv) / cross(corners);
            let expected = k / found.inverse_w.powi(3);
            // Differences of products up to 64 times the derivatives cancel.
            let size = found.per_column[0].abs().max(found.per_column[1].abs())
                * found.per_row[0].abs().max(found.per_row[1].abs());
            let area = found.area();
            assert!((area - expected).abs() <= 1e-9 * (size + expected.abs()), "{area} {expected}");
        });
        assert!(pixels > 20_000, "{pixels}");
    }
}
