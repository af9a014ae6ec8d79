//! A texture with its mip levels: which of them a pixel sees.
//!
//! Williams, "Pyramidal parametrics", SIGGRAPH 1983: level n is the picture at a 2^n-th of its
//! width and height, and linear choice of level blends two of them.

use super::texture::{Texel, Texture, blend, is_opaque};

/// A texture and its mip levels.
#[derive(Clone, Debug, PartialEq)]
pub struct Mipmaps {
    levels: Vec<Texture>,
    is_opaque: bool,
}

impl Mipmaps {
    /// The levels, the largest first. Each side of a level is half that of the one before, rounded
    /// down, but at least 1.
    ///
    /// # Panics
    ///
    /// Panics if there is no level, or if one has another size.
    #[must_use]
    pub fn new(levels: Vec<Texture>) -> Self {
        assert!(!levels.is_empty(), "mipmaps without a level");
        for (level, pair) in levels.windows(2).enumerate() {
            let expected = pair[0].size().map(|side| (side / 2).max(1));
            assert_eq!(pair[1].size(), expected, "the size of level {}", level + 1);
        }
        let is_opaque = levels.iter().flat_map(Texture::texels).all(|&texel| is_opaque(texel));
        Self { levels, is_opaque }
    }

    /// Whether all texels of all levels are opaque.
    #[must_use]
    pub const fn is_opaque(&self) -> bool {
        self.is_opaque
    }

    /// The levels, the largest first.
    #[must_use]
    pub fn levels(&self) -> &[Texture] {
        &self.levels
    }

    /// The largest level.
    #[must_use]
    pub fn base(&self) -> &Texture {
        &self.levels[0]
    }

    /// A level of detail within those that there are.
    #[must_use]
    pub const fn clamp(&self, level: f64) -> f64 {
        level.clamp(0.0, (self.levels.len() - 1) as f64)
    }

    /// The number of the level that is nearest to a level of detail.
    #[must_use]
    pub const fn nearest_level(&self, level: f64) -> usize {
        self.clamp(level).round() as usize
    }

    /// The nearest texel in the level that is nearest to a level of detail.
    #[must_use]
    pub fn nearest(&self, uv: [f64; 2], level: f64) -> Texel {
        self.levels[self.nearest_level(level)].nearest(uv)
    }

    /// Linear between the two levels about a level of detail, bilinear in each.
    #[must_use]
    pub fn trilinear(&self, uv: [f64; 2], level: f64) -> Texel {
        let level = self.clamp(level);
        let [fine, coarse] = [level.floor(), level.ceil()].map(|n| &self.levels[n as usize]);
        blend(fine.bilinear(uv), coarse.bilinear(uv), level - level.floor())
    }
}

#[cfg(test)]
mod tests {
    use super::super::wrap::Wrap;
    use super::*;

    fn level(size: [usize; 2], values: &[f64]) -> Texture {
        let texels = values.iter().map(|&value| [value, 2.0 * value, 0.0, 255.0]).collect();
        Texture::new(size, [Wrap::Repeat; 2], texels)
    }

    /// 4 x 2, 2 x 1 and 1 x 1 texels.
    fn mipmaps() -> Mipmaps {
        Mipmaps::new(vec![
            level([4, 2], &[0.0, 8.0, 16.0, 24.0, 0.0, 8.0, 16.0, 24.0]),
            level([2, 1], &[4.0, 20.0]),
            level([1, 1], &[12.0]),
        ])
    }

    #[test]
    fn the_nearest_level_by_hand() {
        let mipmaps = mipmaps();
        // The first texel of each level but the last.
        let uv = [0.1, 0.1];
        for (level, expected) in [
            (f64::NEG_INFINITY, 0.0),
            (-3.0, 0.0),
            (0.0, 0.0),
            (0.49, 0.0),
            (0.51, 4.0),
            (1.49, 4.0),
            (1.51, 12.0),
            (9.0, 12.0),
            (f64::INFINITY, 12.0),
        ] {
            assert_eq!(mipmaps.nearest(uv, level)[0], expected, "{level}");
        }
    }

    #[test]
    fn trilinear_by_hand() {
        let mipmaps = mipmaps();
        // Half a texel right of the first centre of level 0: halfway from 0 to 8. In level 1 that
        // is in the middle of the first texel: 4; the single texel is 12.
        let uv = [0.25, 0.25];
        for (level, expected) in
            [(-1.0, 4.0), (0.0, 4.0), (0.5, 4.0), (1.0, 4.0), (1.25, 6.0), (2.0, 12.0), (3.0, 12.0)]
        {
            assert_eq!(mipmaps.trilinear(uv, level)[..2], [expected, 2.0 * expected], "{level}");
        }
        // On the first centre of level 0, a quarter of a texel left of that of level 1, where a
        // quarter of the texel across the seam, 20, shows: 8.
        for (level, expected) in [(0.0, 0.0), (0.5, 4.0), (1.0, 8.0), (1.5, 10.0)] {
            assert_eq!(mipmaps.trilinear([0.125, 0.25], level)[0], expected, "{level}");
        }
    }

    #[test]
    fn levels_of_a_constant_are_constant() {
        let sizes = [[3, 5], [1, 2], [1, 1]];
        let of = |size: [usize; 2]| level(size, &vec![0.3; size[0] * size[1]]);
        let mipmaps = Mipmaps::new(sizes.map(of).to_vec());
        for level in [-1.0, 0.0, 0.3, 1.0, 1.7, 2.0] {
            assert_eq!(mipmaps.trilinear([0.77, -3.1], level), [0.3, 0.6, 0.0, 255.0]);
            assert_eq!(mipmaps.nearest([0.77, -3.1], level), [0.3, 0.6, 0.0, 255.0]);
        }
    }

    #[test]
    #[should_panic(expected = "the size of level 1")]
    fn a_level_of_another_size_is_refused() {
        let _ = Mipmaps::new(vec![level([4, 1], &[0.0; 4]), level([1, 1], &[0.0])]);
    }
}
