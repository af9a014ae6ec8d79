//! Which pixels a point owns.
//!
//! Vulkan specification, "Basic Point Rasterization": those whose centres lie in a square about the
//! point, with sides of its size. On a side, by the top-left rule of Direct3D 10 and later, which
//! draw a point as two triangles: a centre on the left or on the upper side is owned.

/// A point on the screen in sub-pixels, of which a pixel has 2^`subpixel_bits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    /// The middle of the square.
    pub place: [i64; 2],
    /// At least 1.
    pub subpixel_bits: u32,
    /// The side of the square in pixels.
    pub size: u32,
}

impl Point {
    /// Whether it owns the pixel of a column and a row.
    #[must_use]
    pub fn owns(&self, pixel: [i64; 2]) -> bool {
        // In halves of a sub-pixel, where the pixel's centre and the sides are whole.
        let unit = 2i64 << self.subpixel_bits;
        [0, 1].iter().all(|&axis| {
            let center = pixel[axis] * unit + unit / 2;
            let from_middle = 2 * center - 4 * self.place[axis];
            let side = i64::from(self.size) * unit;
            -side <= from_middle && from_middle < side
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The owned pixels along one axis of a point in sixteenths.
    fn owned(place: i64, size: u32) -> Vec<i64> {
        let point = Point { place: [place, 8], subpixel_bits: 4, size };
        (-4..8).filter(|&column| point.owns([column, 0])).collect()
    }

    #[test]
    fn a_point_owns_the_centers_in_its_square() {
        // In the middle of pixel 1, and between two pixels: the one whose left side it is on.
        assert_eq!(owned(24, 1), [1]);
        assert_eq!(owned(16, 1), [0]);
        assert_eq!(owned(17, 1), [1]);
        assert_eq!(owned(31, 1), [1]);
        assert_eq!(owned(32, 1), [1]);
        assert_eq!(owned(16, 2), [0, 1]);
        // Centre 0 is on the left side, centre 2 on the right one.
        assert_eq!(owned(24, 2), [0, 1]);
        assert_eq!(owned(25, 2), [1, 2]);
        assert_eq!(owned(24, 3), [0, 1, 2]);
        assert_eq!(owned(24, 0), [0i64; 0]);
    }

    #[test]
    fn both_axes_count() {
        let point = Point { place: [24, 56], subpixel_bits: 4, size: 2 };
        let pixels = (0..5).flat_map(|row| (0..5).map(move |column| [column, row]));
        let owned: Vec<_> = pixels.filter(|&pixel| point.owns(pixel)).collect();
        assert_eq!(owned, [[0, 2], [1, 2], [0, 3], [1, 3]]);
    }
}
