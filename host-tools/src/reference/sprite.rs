//! A picture on a square of the screen: which pixels it owns, and what part of it is at a pixel.
//!
//! A square with upright sides as two triangles, by the rules of `coverage.rs` and of
//! `interpolate.rs`: a pixel belongs to it if its centre lies in the square or on the left or the
//! upper side, and shows the place of the picture that its centre lies on.

/// A square on the screen in sub-pixels, of which a pixel has 2^`subpixel_bits`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sprite {
    /// The upper left corner.
    pub corner: [i64; 2],
    /// The length of a side.
    pub side: i64,
    /// At least 1.
    pub subpixel_bits: u32,
}

impl Sprite {
    /// From the corner to the centre of the pixel of a column and a row.
    fn to_center(self, pixel: [i64; 2]) -> [i64; 2] {
        let half = 1 << (self.subpixel_bits - 1);
        [0, 1].map(|axis| (pixel[axis] << self.subpixel_bits) + half - self.corner[axis])
    }

    /// Whether it owns the pixel.
    #[must_use]
    pub fn owns(&self, pixel: [i64; 2]) -> bool {
        self.to_center(pixel).iter().all(|way| (0..self.side).contains(way))
    }

    /// The place in the picture at a pixel that it owns: (0, 0) is its upper left corner, (1, 1)
    /// its lower right one.
    #[must_use]
    pub fn place(&self, pixel: [i64; 2]) -> [f64; 2] {
        self.to_center(pixel).map(|way| way as f64 / self.side as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sprite_owns_the_centers_in_it() {
        // From the centre of pixel 1 to that of pixel 3, which is on its right side.
        let sprite = Sprite { corner: [24, 25], side: 32, subpixel_bits: 4 };
        let owned = |axis: usize| -> Vec<i64> {
            let pixel = |c| if axis == 0 { [c, 2] } else { [1, c] };
            (-2..6).filter(|&c| sprite.owns(pixel(c))).collect()
        };
        assert_eq!([owned(0), owned(1)], [[1, 2], [2, 3]]);
        assert_eq!(sprite.place([1, 2]), [0.0, 15.0 / 32.0]);
        assert_eq!(sprite.place([2, 3]), [0.5, 31.0 / 32.0]);
    }
}
