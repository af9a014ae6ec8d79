//! Texels that are colours.

use super::{
    Counts, LitTexels, Mix, StoredTexels, Table, Texels,
    texels::{level_of_varying, lit_after_filtering, varying_of_level},
};

/// `N` texels in the target's own colour type, such as `Rgb565` or, in the byte order of a bus,
/// [`Rgb565Be`](crate::output::Rgb565Be).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colors<'a, C, const N: usize>(&'a [C; N]);

impl<'a, C, const N: usize> Colors<'a, C, N> {
    /// These texels. None do not compile.
    #[must_use]
    pub const fn new(texels: &'a [C; N]) -> Self {
        const { assert!(N > 0, "a texture has texels") };
        Self(texels)
    }
}

impl<C: Copy, const N: usize> Texels for Colors<'_, C, N> {
    type Color = C;
    type Texel = C;

    fn counts(&self) -> Counts {
        Self::COUNTS
    }

    #[inline(always)]
    fn texel(&self, index: usize) -> C {
        *at(self.0, index)
    }

    #[inline(always)]
    fn texel_in_rows<const WIDTH: usize>(&self, index: usize) -> C {
        *at_in_rows::<WIDTH, _, _>(self.0, index)
    }
}

impl<C: Copy, const N: usize> Table for Colors<'_, C, N> {
    const COUNTS: Counts = Counts::exactly(N);
}

impl<C: Copy + PartialEq, const N: usize> StoredTexels for Colors<'_, C, N> {
    type Stored = C;

    #[inline(always)]
    fn stored(&self, index: usize) -> C {
        self.texel(index)
    }
}

lit_after_filtering!([C: Mix, const N: usize] Colors<'_, C, N>);

/// An element of a table that is not empty. Indices past the end are wrapped or clamped, so that
/// none can panic; for a power of two that is a mask, which compilers leave out where they know
/// that the index is below it.
#[inline(always)]
pub(super) const fn at<T, const N: usize>(table: &[T; N], index: usize) -> &T {
    if N.is_power_of_two() {
        &table[index & (N - 1)]
    } else {
        &table[if index < N { index } else { N - 1 }]
    }
}

/// The same in a table of rows that have `WIDTH` elements.
///
/// codegen: row and column are the shifted bits of coordinates. Together they are bits masked in
/// their places, and on ARMv6-M the mask of the row is loaded for each pixel.
#[inline(always)]
pub(super) const fn at_in_rows<const WIDTH: usize, T, const N: usize>(
    table: &[T; N],
    index: usize,
) -> &T {
    if WIDTH.is_power_of_two() && N.is_power_of_two() && WIDTH <= N {
        let (rows, _) = table.as_chunks::<WIDTH>();
        &rows[(index / WIDTH) & (N / WIDTH - 1)][index % WIDTH]
    } else {
        at(table, index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_index_finds_a_texel() {
        let four = Colors::new(&[1, 2, 3, 4]);
        assert_eq!([0, 3, 4, 7].map(|index| four.texel(index)), [1, 4, 1, 4]);
        let three = Colors::new(&[1, 2, 3]);
        assert_eq!([0, 2, 3, usize::MAX].map(|index| three.texel(index)), [1, 3, 3, 3]);
        assert_eq!(Colors::new(&[9]).texel(5), 9);
    }

    #[test]
    fn rows_are_the_same_table() {
        let table = core::array::from_fn::<_, 32, _>(|i| i);
        let texels = Colors::new(&table);
        for index in 0..70 {
            let texel = texels.texel(index);
            assert_eq!(texel, index % 32);
            assert_eq!(texels.texel_in_rows::<1>(index), texel);
            assert_eq!(texels.texel_in_rows::<8>(index), texel);
            assert_eq!(texels.texel_in_rows::<32>(index), texel);
            assert_eq!(texels.texel_in_rows::<64>(index), texel);
            assert_eq!(texels.texel_in_rows::<12>(index), texel);
        }
    }
}
