//! A texture: what is seen at a texture coordinate.
//!
//! Texel (i, j) of W x H covers `i / W <= u < (i + 1) / W` and `j / H <= v < (j + 1) / H`; its
//! centre is at ((i + 1/2) / W, (j + 1/2) / H). u points right and v down, from the corner of the
//! first texel. (OpenGL 4.6 core profile, section 8.14.2; its v points up.)

use super::wrap::Wrap;

/// A texel's red, green, blue and alpha in 0..=255, as stored: filters and light compute with the
/// stored values, without a gamma curve.
pub type Texel = [f64; 4];

/// Texels, and how they go on beyond the edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    size: [usize; 2],
    wrap: [Wrap; 2],
    texels: Vec<Texel>,
}

impl Texture {
    /// A texture of `size` (width, height) texels, row by row from the top. `wrap` is for u and v.
    ///
    /// # Panics
    ///
    /// Panics if a side is 0, or if there are not as many texels as `size` has.
    #[must_use]
    pub fn new(size: [usize; 2], wrap: [Wrap; 2], texels: Vec<Texel>) -> Self {
        let [width, height] = size;
        assert!(width > 0 && height > 0, "a texture of {width} x {height} texels");
        assert_eq!(texels.len(), width * height, "the texels of {width} x {height}");
        Self { size, wrap, texels }
    }

    /// Width and height in texels.
    #[must_use]
    pub const fn size(&self) -> [usize; 2] {
        self.size
    }

    /// How it goes on to the sides, and up and down.
    #[must_use]
    pub const fn wrap(&self) -> [Wrap; 2] {
        self.wrap
    }

    /// All texels, row by row.
    #[must_use]
    pub fn texels(&self) -> &[Texel] {
        &self.texels
    }

    /// A texture coordinate, or a difference of two, in texels.
    #[must_use]
    pub fn in_texels(&self, uv: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| uv[axis] * self.size[axis] as f64)
    }

    /// The texel seen at column and row, which count on beyond the edges.
    #[must_use]
    pub fn texel(&self, place: [i64; 2]) -> Texel {
        let [column, row] = [0, 1].map(|axis| self.wrap[axis].texel(place[axis], self.size[axis]));
        self.texels[row * self.size[0] + column]
    }

    /// The texel that covers a texture coordinate.
    #[must_use]
    pub fn nearest(&self, uv: [f64; 2]) -> Texel {
        self.texel(self.in_texels(uv).map(|c| c.floor() as i64))
    }

    /// The four texels whose centres enclose a texture coordinate, linear between them.
    ///
    /// Both steps start from one end, so that equal texels give exactly their value.
    #[must_use]
    pub fn bilinear(&self, uv: [f64; 2]) -> Texel {
        let place = self.in_texels(uv).map(|c| c - 0.5);
        let [column, row] = place.map(|c| c.floor() as i64);
        let [right, down] = place.map(|c| c - c.floor());
        let [upper, lower] = [0, 1].map(|below| {
            let [a, b] = [0, 1].map(|beside| self.texel([column + beside, row + below]));
            blend(a, b, right)
        });
        blend(upper, lower, down)
    }
}

/// The texel at the fraction `t` of the way from `a` to `b`.
pub(super) fn blend(a: Texel, b: Texel, t: f64) -> Texel {
    std::array::from_fn(|i| a[i] + t * (b[i] - a[i]))
}

/// Whether a texel is drawn: its alpha is at least half.
#[must_use]
pub const fn is_opaque([.., alpha]: Texel) -> bool {
    alpha >= 127.5
}

/// A texel's colour under a light level from 0 to 1: each channel times the level.
#[must_use]
pub fn lit([red, green, blue, _]: Texel, level: f64) -> [f64; 3] {
    [red, green, blue].map(|channel| channel * level)
}

#[cfg(test)]
mod tests {
    use super::*;

    const REPEAT: [Wrap; 2] = [Wrap::Repeat; 2];
    const MIRROR: [Wrap; 2] = [Wrap::Mirror; 2];
    const CLAMP: [Wrap; 2] = [Wrap::Clamp; 2];

    fn grey(value: f64) -> Texel {
        [value, value, value, 255.0]
    }

    /// A row of four texels: 10, 20, 40, 80.
    fn row(wrap: [Wrap; 2]) -> Texture {
        Texture::new([4, 1], wrap, [10.0, 20.0, 40.0, 80.0].map(grey).to_vec())
    }

    /// The red channel of a row at a place in texels, by both filters.
    fn at(texture: &Texture, texels: f64) -> [f64; 2] {
        let uv = [texels / 4.0, 0.5];
        [texture.nearest(uv)[0], texture.bilinear(uv)[0]]
    }

    #[test]
    fn texels_at_half_a_texel_around_the_seam() {
        // By hand: at 0 texels a bilinear filter is halfway between the texel left of the seam and
        // the first one; at -1/2 and 1/2 it is on their centres.
        for (wrap, before) in [(REPEAT, 80.0), (MIRROR, 10.0), (CLAMP, 10.0)] {
            let texture = row(wrap);
            assert_eq!(at(&texture, -0.5), [before, before], "{wrap:?}");
            assert_eq!(at(&texture, 0.0), [10.0, (before + 10.0) / 2.0], "{wrap:?}");
            assert_eq!(at(&texture, 0.5), [10.0, 10.0], "{wrap:?}");
            assert_eq!(at(&texture, 1.0), [20.0, 15.0], "{wrap:?}");
        }
        for (wrap, after) in [(REPEAT, 10.0), (MIRROR, 80.0), (CLAMP, 80.0)] {
            let texture = row(wrap);
            assert_eq!(at(&texture, 3.5), [80.0, 80.0], "{wrap:?}");
            assert_eq!(at(&texture, 4.0), [after, (80.0 + after) / 2.0], "{wrap:?}");
            assert_eq!(at(&texture, 4.5), [after, after], "{wrap:?}");
        }
    }

    #[test]
    fn a_repeat_away_is_the_same_and_a_mirrored_one_is_turned_over() {
        let (repeated, mirrored) = (row(REPEAT), row(MIRROR));
        for place in [0.25, 0.5, 1.75, 2.5, 3.25] {
            for repeats in [-8.0, -4.0, 4.0, 256.0] {
                assert_eq!(at(&repeated, place + repeats), at(&repeated, place));
                assert_eq!(at(&mirrored, place + 2.0 * repeats), at(&mirrored, place));
            }
            assert_eq!(at(&mirrored, -place), at(&mirrored, place));
            assert_eq!(at(&mirrored, 8.0 - place), at(&mirrored, place));
        }
    }

    #[test]
    fn a_clamped_edge_goes_on() {
        let texture = row(CLAMP);
        for (place, edge) in [(-1e3, 10.0), (-0.75, 10.0), (4.25, 80.0), (1e3, 80.0)] {
            assert_eq!(at(&texture, place), [edge, edge]);
        }
    }

    #[test]
    fn axes_wrap_apart() {
        // 1 2 over 3 4.
        let texels = [1.0, 2.0, 3.0, 4.0].map(grey).to_vec();
        let texture = Texture::new([2, 2], [Wrap::Clamp, Wrap::Mirror], texels);
        assert_eq!(texture.nearest([-0.25, 0.25])[0], 1.0, "left, clamped");
        assert_eq!(texture.nearest([1.25, 0.75])[0], 4.0, "right, clamped");
        assert_eq!(texture.nearest([0.25, 1.25])[0], 3.0, "below, mirrored");
        assert_eq!(texture.nearest([0.75, 1.75])[0], 2.0, "below, mirrored");
        // The middle of all four.
        assert_eq!(texture.bilinear([0.5, 0.5])[0], 2.5);
        // A quarter of a texel right of the first centre, three quarters below it.
        assert_eq!(texture.bilinear([0.375, 0.625])[0], 1.0 + 0.25 + 2.0 * 0.75);
    }

    #[test]
    fn a_constant_texture_is_constant() {
        for value in [0.1, 77.7, 255.0] {
            let texel = [value, 3.0 * value, 1.0 / value, 255.0 - value];
            for wrap in [REPEAT, MIRROR, CLAMP] {
                let texture = Texture::new([3, 2], wrap, vec![texel; 6]);
                for place in [-1.3, -0.1, 0.0, 1.0 / 3.0, 0.77, 12.9] {
                    let uv = [place, 2.0 - 3.0 * place];
                    assert_eq!(texture.nearest(uv), texel);
                    assert_eq!(texture.bilinear(uv), texel);
                }
            }
        }
    }

    #[test]
    fn a_single_texel_is_everywhere() {
        for wrap in [REPEAT, MIRROR, CLAMP] {
            let texture = Texture::new([1, 1], wrap, vec![[9.0, 8.0, 7.0, 6.0]]);
            for uv in [[-0.5, 0.0], [0.0, 0.5], [0.5, 1.0], [-17.3, 64.0]] {
                assert_eq!(texture.nearest(uv), [9.0, 8.0, 7.0, 6.0]);
                assert_eq!(texture.bilinear(uv), [9.0, 8.0, 7.0, 6.0]);
            }
        }
    }

    #[test]
    fn half_of_alpha_is_opaque_and_light_multiplies() {
        let alpha = |alpha| is_opaque([0.0, 0.0, 0.0, alpha]);
        // Of 8 bits, 128 and more; of 4 bits in steps of 17, 8 and more.
        assert_eq!([127.0, 128.0, 7.0 * 17.0, 8.0 * 17.0].map(alpha), [false, true, false, true]);
        assert_eq!(lit([200.0, 100.0, 50.0, 0.0], 0.25), [50.0, 25.0, 12.5]);
    }

    #[test]
    #[should_panic(expected = "the texels of 2 x 2")]
    fn a_wrong_number_of_texels_is_refused() {
        let _ = Texture::new([2, 2], REPEAT, vec![grey(0.0); 3]);
    }
}
