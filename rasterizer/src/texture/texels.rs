//! How texels are stored.

use super::{Mix, Texel};

/// The texels of a texture, numbered along its rows from the top left.
///
/// [`Colors`](super::Colors), [`Indexed`](super::Indexed), [`Keyed`](super::Keyed),
/// [`Masked`](super::Masked), [`Translucent`](super::Translucent) and [`Shaded`](super::Shaded) are
/// such.
pub trait Texels: Copy {
    /// The colour type of the target.
    type Color: Copy;
    /// A colour, an `Option` of one, or a [`Layer`](super::Layer).
    type Texel: Texel<Self::Color>;

    /// Returns how many texels it can stand for.
    fn counts(&self) -> Counts;

    /// Returns a texel. Any index gives one; only those below the count are the texture's.
    fn texel(&self, index: usize) -> Self::Texel;

    /// The same, for a texture whose rows have `WIDTH` texels.
    #[doc(hidden)]
    #[inline(always)]
    fn texel_in_rows<const WIDTH: usize>(&self, index: usize) -> Self::Texel {
        self.texel(index)
    }
}

/// Texels whose number is known at compile time.
pub trait Table: Texels {
    /// How many texels it can stand for.
    const COUNTS: Counts;
}

/// Texels of which each has a value that is stored: a colour, or a place in a palette.
pub trait StoredTexels: Texels<Texel = <Self as Texels>::Color> {
    /// The type of the value.
    type Stored: Copy + PartialEq;

    /// Returns the value of a texel.
    fn stored(&self, index: usize) -> Self::Stored;
}

/// Texels that can be lit.
///
/// Light acts where it costs the least: on the colour after filtering, or on the way from the
/// table, with [`Shaded`](super::Shaded).
pub trait LitTexels: Texels {
    /// A brightness, in the units that the texels need.
    type Light: Copy + Default;

    /// Returns a brightness in Q16, 0 to 65,536, as the varying that [`light`](Self::light) takes.
    fn varying(level: u32) -> u16;

    /// Returns the brightness of an interpolated varying in Q16.16.
    fn light(varying: u32) -> Self::Light;

    /// Returns a texel as it is filtered.
    fn before_light(&self, index: usize, light: Self::Light) -> Self::Texel;

    /// The same, for a texture whose rows have `WIDTH` texels.
    #[doc(hidden)]
    #[inline(always)]
    fn before_light_in_rows<const WIDTH: usize>(
        &self,
        index: usize,
        light: Self::Light,
    ) -> Self::Texel {
        self.before_light(index, light)
    }

    /// Returns the lit colour of what is filtered.
    fn after_light(color: Self::Color, light: Self::Light) -> Self::Color;

    /// Returns a colour that comes from no texture in this light.
    fn plain(color: Self::Color, light: Self::Light) -> Self::Color;
}

/// The numbers of texels that a table can stand for: a range, because the last byte may have room
/// for more of them than a texture has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    least: usize,
    most: usize,
}

impl Counts {
    /// Exactly this many.
    #[must_use]
    pub const fn exactly(count: usize) -> Self {
        Self { least: count, most: count }
    }

    /// Texels of 1, 2, 4 or 8 bits in this many bytes.
    #[must_use]
    pub const fn in_bytes(bytes: usize, bits: usize) -> Self {
        let per_byte = 8 / bits;
        let most = bytes * per_byte;
        Self { least: (most + 1).saturating_sub(per_byte), most }
    }

    /// Those that both can stand for.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self {
            least: if self.least > other.least { self.least } else { other.least },
            most: if self.most < other.most { self.most } else { other.most },
        }
    }

    /// Whether it can stand for no number of texels.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.least > self.most
    }

    /// Whether it can stand for this many.
    #[must_use]
    pub const fn contain(self, count: usize) -> bool {
        self.least <= count && count <= self.most
    }
}

/// [`LitTexels::varying`] for texels that are lit by the levels of [`Mix`]: 0 and 65,536 lie in the
/// middle of the first and the last level, and a level is the varying's upper bits.
#[inline(always)]
pub(super) const fn varying_of_level<C: Mix>(level: u32) -> u16 {
    // At most 2^15 + 2^13.
    ((level >> 1) + (1 << (14 - C::LIGHT_BITS))) as u16
}

/// [`LitTexels::light`] for texels that are lit by the levels of [`Mix`].
#[inline(always)]
pub(super) const fn level_of_varying<C: Mix>(varying: u32) -> u32 {
    varying >> (31 - C::LIGHT_BITS)
}

/// [`LitTexels`] for texels that are lit after filtering, by the levels of [`Mix`].
macro_rules! lit_after_filtering {
    ([$($parameters:tt)*] $texels:ty) => {
        impl<$($parameters)*> LitTexels for $texels {
            type Light = u32;

            #[inline(always)]
            fn varying(level: u32) -> u16 {
                varying_of_level::<C>(level)
            }

            #[inline(always)]
            fn light(varying: u32) -> u32 {
                level_of_varying::<C>(varying)
            }

            #[inline(always)]
            fn before_light(&self, index: usize, _: u32) -> C {
                self.texel(index)
            }

            #[inline(always)]
            fn before_light_in_rows<const WIDTH: usize>(&self, index: usize, _: u32) -> C {
                self.texel_in_rows::<WIDTH>(index)
            }

            #[inline(always)]
            fn after_light(color: C, light: u32) -> C {
                color.lit(light)
            }

            #[inline(always)]
            fn plain(color: C, light: u32) -> C {
                color.lit(light)
            }
        }
    };
}

/// [`Texels`] and [`StoredTexels`] for texels of `BITS` bits that are places in a `palette` of
/// `COLORS` colours, of which `byte` reads some together.
macro_rules! places_in_a_palette {
    ([$($parameters:tt)*] $texels:ty, $counts:expr) => {
        impl<C: Copy, const BITS: usize, const COLORS: usize $($parameters)*> Texels for $texels {
            type Color = C;
            type Texel = C;

            fn counts(&self) -> Counts {
                let counts: fn(&Self) -> Counts = $counts;
                counts(self)
            }

            #[inline(always)]
            fn texel(&self, index: usize) -> C {
                *at(self.palette(), self.stored(index).into())
            }
        }

        impl<C: Copy, const BITS: usize, const COLORS: usize $($parameters)*> StoredTexels
            for $texels
        {
            type Stored = u8;

            #[inline(always)]
            fn stored(&self, index: usize) -> u8 {
                Packing::<BITS>::unpack(self.byte(index >> Packing::<BITS>::PART_BITS), index)
            }
        }
    };
}

/// [`LitTexels`] for texels of such a palette, of which there is one for each row of light.
macro_rules! lit_by_palettes {
    ([$($parameters:tt)*] $texels:ty) => {
        impl<C: Mix, const BITS: usize, const COLORS: usize $($parameters)*> LitTexels
            for $texels
        {
            /// A row of the table.
            type Light = usize;

            #[inline(always)]
            fn varying(level: u32) -> u16 {
                varying_of_shade(level)
            }

            #[inline(always)]
            fn light(varying: u32) -> usize {
                shade_of_varying(varying)
            }

            #[inline(always)]
            fn before_light(&self, index: usize, shade: usize) -> C {
                *at(at(self.palettes, shade), self.stored(index).into())
            }

            #[inline(always)]
            fn after_light(color: C, _: usize) -> C {
                color
            }

            #[inline(always)]
            fn plain(color: C, shade: usize) -> C {
                color.lit(level_of_shade(shade, C::LIGHT_BITS))
            }
        }
    };
}

/// [`Texels`] and [`LitTexels`] for `texels` that may be transparent: each an `Option`, of
/// which the colour is there if `is_opaque`, or a `Layer` with an `alpha`.
macro_rules! with_alpha {
    (@Option $texels:ident, $index:ident, $color:expr) => {
        $texels.is_opaque($index).then(|| $color)
    };
    (@Layer $texels:ident, $index:ident, $color:expr) => {
        Layer::new($color, $texels.alpha($index))
    };
    ($kind:ident, [$($parameters:tt)*] $texels:ty, $counts:expr) => {
        impl<F: Texels<Texel = <F as Texels>::Color> + $($parameters)*> Texels for $texels {
            type Color = F::Color;
            type Texel = $kind<F::Color>;

            fn counts(&self) -> Counts {
                let counts: fn(&Self) -> Counts = $counts;
                counts(self)
            }

            #[inline(always)]
            fn texel(&self, index: usize) -> $kind<F::Color> {
                with_alpha!(@$kind self, index, self.texels.texel(index))
            }
        }

        impl<F: LitTexels<Texel = <F as Texels>::Color> + $($parameters)*> LitTexels for $texels {
            type Light = F::Light;

            #[inline(always)]
            fn varying(level: u32) -> u16 {
                F::varying(level)
            }

            #[inline(always)]
            fn light(varying: u32) -> F::Light {
                F::light(varying)
            }

            #[inline(always)]
            fn before_light(&self, index: usize, light: F::Light) -> $kind<F::Color> {
                with_alpha!(@$kind self, index, self.texels.before_light(index, light))
            }

            #[inline(always)]
            fn after_light(color: F::Color, light: F::Light) -> F::Color {
                F::after_light(color, light)
            }

            #[inline(always)]
            fn plain(color: F::Color, light: F::Light) -> F::Color {
                F::plain(color, light)
            }
        }
    };
}

pub(super) use {lit_after_filtering, lit_by_palettes, places_in_a_palette, with_alpha};

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, Rgb565};

    use super::*;

    #[test]
    fn the_last_byte_may_have_room_for_more() {
        assert!(Counts::in_bytes(5, 4).contain(9));
        assert!(Counts::in_bytes(5, 4).contain(10));
        assert!(!Counts::in_bytes(5, 4).contain(8));
        assert!(!Counts::in_bytes(5, 4).contain(11));
        assert!(Counts::in_bytes(2, 1).contain(9));
        assert!(!Counts::in_bytes(2, 1).contain(8));
        assert_eq!(Counts::in_bytes(7, 8), Counts::exactly(7));
        let both = Counts::in_bytes(5, 4).and(Counts::in_bytes(2, 1));
        assert!(both.contain(9) && both.contain(10) && !both.contain(11));
    }

    #[test]
    fn levels_are_met_in_their_middle() {
        fn check<C: Mix>() {
            let levels = 1 << C::LIGHT_BITS;
            for brightness in 0..=65_536u32 {
                let varying = varying_of_level::<C>(brightness);
                // Half a unit above, as an interpolated varying is.
                let level = level_of_varying::<C>((u32::from(varying) << 16) + (1 << 15));
                let exact = f64::from(brightness) * f64::from(levels) / 65_536.0;
                // The varying has one digit less than the brightness.
                let bound = 0.5 + f64::from(levels) / 65_536.0;
                assert!((f64::from(level) - exact).abs() <= bound, "{brightness}: {level}");
            }
        }
        check::<Rgb565>();
        check::<Gray8>();
    }
}
