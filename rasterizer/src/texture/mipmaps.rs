//! Textures with mip levels: smaller and smaller pictures of themselves.

use core::marker::PhantomData;

use super::{
    CoordinateFormat, Coordinates, Grid, MAX_SIDE, Place, Quad, Repeat, Side, Table, TexelMap,
    Wrap, image::check_sides,
};

/// The most levels that a texture can have: of 1,024 texels down to 1.
pub(super) const MAX_LEVELS: usize = MAX_SIDE.ilog2() as usize + 1;

/// The mip levels of a texture: each is half as wide and high as the one before it, rounded down
/// but at least one texel, until both sides are one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Levels {
    grids: [Grid; MAX_LEVELS],
    last: u32,
}

impl Levels {
    /// Of a texture of this width and height, 1 to [`MAX_SIDE`].
    #[must_use]
    pub const fn new(width: usize, height: usize) -> Self {
        let mut grids = [Grid::new(width, height); MAX_LEVELS];
        let last = (if width > height { width } else { height }).ilog2();
        let mut level = 0;
        while level < last as usize {
            let Grid { first, width: across, height: down } = grids[level];
            level += 1;
            grids[level] = Grid {
                first: first + (across.length() * down.length()) as u32,
                width: Side::new(width >> level),
                height: Side::new(height >> level),
            };
        }
        Self { grids, last }
    }

    /// The number of the last level, of one texel.
    #[inline(always)]
    #[must_use]
    pub const fn last(&self) -> u32 {
        self.last
    }

    /// The texels of a level; beyond the last one, of the last.
    #[inline(always)]
    #[must_use]
    pub const fn grid(&self, level: u32) -> Grid {
        self.grids[if level < self.last { level } else { self.last } as usize % MAX_LEVELS]
    }

    /// The number of texels of all levels.
    #[must_use]
    pub const fn texel_count(&self) -> usize {
        self.grid(self.last).first as usize + 1
    }
}

/// A texture with mip levels.
pub trait Mipmapped: TexelMap {
    /// Returns the sizes of its levels.
    fn levels(&self) -> &Levels;

    /// Returns the number of the texel of a level that covers the place. Beyond the last level, it
    /// is that of the last.
    fn nearest_in(&self, place: Self::Place, level: u32) -> usize;

    /// Returns the four texels of a level between whose centres the place lies.
    fn bilinear_in(&self, place: Self::Place, bits: u32, level: u32) -> Quad;
}

/// A texture of `W` x `H` texels with all its mip levels: in one table, the largest first, each
/// half as wide and high as the one before it, rounded down but at least one texel, until both
/// sides are one.
///
/// Filters without levels take the largest.
///
/// ```
/// use rasterizer::texture::{Clamp, Colors, Mipmaps};
///
/// // 5 x 2, 2 x 1 and 1 x 1.
/// const COUNT: usize = 10 + 2 + 1;
/// type Sign = Mipmaps<Colors<'static, u16, COUNT>, 5, 2, Clamp, Clamp>;
/// static SIGN: Sign = Mipmaps::new(Colors::new(&[0; COUNT]));
/// ```
///
/// A wrong number of texels does not compile:
///
/// ```compile_fail,E0080
/// # use rasterizer::texture::{Colors, Mipmaps};
/// let texture: Mipmaps<Colors<'_, u16, 16>, 4, 4> = Mipmaps::new(Colors::new(&[0; 16]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mipmaps<F, const W: usize, const H: usize, X = Repeat, Y = Repeat> {
    texels: F,
    wrap: PhantomData<(X, Y)>,
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> Mipmaps<F, W, H, X, Y> {
    /// A texture of these texels.
    #[must_use]
    pub const fn new(texels: F) -> Self {
        const {
            check_sides::<X, Y>(W, H);
            assert!(
                F::COUNTS.contain(Levels::new(W, H).texel_count()),
                "mip levels have the texels of all levels, from width x height down to one"
            );
        }
        Self { texels, wrap: PhantomData }
    }
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> TexelMap
    for Mipmaps<F, W, H, X, Y>
{
    type Texels = F;
    type Place = Place<W, H, X, Y>;
    type Coordinates<C: CoordinateFormat> = Coordinates<C, W, H, X, Y>;

    #[inline(always)]
    fn texels(&self) -> &F {
        &self.texels
    }

    #[inline(always)]
    fn nearest(&self, place: Self::Place) -> usize {
        place.nearest()
    }

    #[inline(always)]
    fn bilinear(&self, place: Self::Place, bits: u32) -> Quad {
        place.bilinear(bits)
    }
}

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> Mipmapped
    for Mipmaps<F, W, H, X, Y>
{
    #[inline(always)]
    fn levels(&self) -> &Levels {
        const { &Levels::new(W, H) }
    }

    #[inline(always)]
    fn nearest_in(&self, place: Self::Place, level: u32) -> usize {
        self.levels().grid(level).nearest::<X, Y>(place.uv())
    }

    #[inline(always)]
    fn bilinear_in(&self, place: Self::Place, bits: u32, level: u32) -> Quad {
        self.levels().grid(level).bilinear::<X, Y>(place.uv(), bits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Clamp, Colors};

    #[test]
    fn levels_halve_until_both_sides_are_one() {
        let levels = Levels::new(20, 3);
        let sizes: std::vec::Vec<_> = (0..=levels.last())
            .map(|level| {
                let grid = levels.grid(level);
                (grid.first, grid.width.length(), grid.height.length())
            })
            .collect();
        assert_eq!(sizes, [(0, 20, 3), (60, 10, 1), (70, 5, 1), (75, 2, 1), (77, 1, 1)]);
        assert_eq!(levels.texel_count(), 78);
        assert_eq!(levels.grid(9), levels.grid(4));
        assert_eq!(Levels::new(1024, 1024).texel_count(), (4usize.pow(11) - 1) / 3);
        assert_eq!((Levels::new(1, 1).texel_count(), Levels::new(1, 1).last()), (1, 0));
    }

    #[test]
    fn a_place_is_on_a_texel_of_each_level() {
        type Map = Mipmaps<Colors<'static, u16, 21>, 4, 4, Repeat, Clamp>;
        let map: Map = Mipmaps::new(Colors::new(&[0; 21]));
        // In the last column and the second row.
        let place = Place::new([(1 << 24) - 1, 3 << 21]);
        assert_eq!([0, 1, 2, 3].map(|level| map.nearest_in(place, level)), [7, 17, 20, 20]);
        let quad = map.bilinear_in(place, 4, 1);
        // Half-way between the level's columns, beyond the border; a quarter above row 1's centre.
        assert_eq!(quad, Quad { texels: [17, 16, 19, 18], fractions: [8, 4] });
        assert_eq!(map.bilinear(place, 4), place.bilinear(4));
    }
}
