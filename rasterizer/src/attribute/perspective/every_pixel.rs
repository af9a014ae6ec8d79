//! The mode that divides at every visible pixel.

use super::{
    AtPixel, Corrected, Correction, EveryPixel, Quotient,
    quotient::{Block, Corners},
};
use crate::{
    attribute::{
        Components, Interpolate, InverseW, Piece, QuickGradients, Step, TriangleSetup, Whole,
    },
    numbers::Subpixel,
};

/// Numbers of a vertex with near / w.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct OnEveryPixel<V> {
    value: V,
    inverse_w: InverseW,
}

impl Correction for EveryPixel {
    type OnScreen<V: Components> = OnEveryPixel<V>;

    #[inline(always)]
    fn on_screen<V: Components>(value: V, inverse_w: InverseW) -> OnEveryPixel<V> {
        OnEveryPixel { value, inverse_w }
    }

    #[inline(always)]
    fn parts<V: Components>(vertex: &OnEveryPixel<V>) -> (V, InverseW) {
        (vertex.value, vertex.inverse_w)
    }
}

impl<V: Components> Interpolate for OnEveryPixel<V> {
    const ZERO: Self = Self { value: V::ZERO, inverse_w: InverseW::ZERO };
    const DIFFERS_BY_TRIANGLE: bool = V::DIFFERS_BY_TRIANGLE;

    type Field = Quotient<V>;
    type Walk = Dividend<V>;
    type Rest = Whole<Dividend<V>>;
    type Sample = Corrected<V::Sample>;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Quotient<V> {
        let corners = Corners::new(corners.map(|corner| (corner.value, corner.inverse_w)));
        let bits = corners.bits();
        let quick = quick.filter(|_| !V::HAS_EXACT_GRADIENTS);
        Quotient::new(setup, quick, &corners, bits)
    }

    #[inline(always)]
    fn whole(field: &Quotient<V>, at: [i32; 2], pixels: usize) -> Option<Piece<Dividend<V>>> {
        Some(piece(field, at, pixels))
    }

    #[inline(always)]
    fn walk(
        field: &Quotient<V>,
        at: [i32; 2],
        pixels: usize,
    ) -> (Piece<Dividend<V>>, Whole<Dividend<V>>) {
        (piece(field, at, pixels), core::iter::empty())
    }

    #[inline(always)]
    fn sample(value: Dividend<V>) -> Corrected<V::Sample> {
        let Dividend { at, block } = value;
        Corrected {
            value: V::sample(V::walk_from(at.divided(&block))),
            inverse_w: InverseW::from_bits(block.inverse_w(at.q())),
        }
    }

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self { value: self.value.at_corner(corner), ..self }
    }
}

/// A span, which is one piece.
#[inline(always)]
fn piece<V: Components>(field: &Quotient<V>, at: [i32; 2], pixels: usize) -> Piece<Dividend<V>> {
    let of = |at| Dividend { at, block: field.block };
    Piece { first: of(field.at(at)), step: of(field.along_row()), pixels }
}

/// What is divided at a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Dividend<V: Components> {
    at: AtPixel<V>,
    block: Block<V>,
}

/// In the block of the first operand.
impl<V: Components> Step for Dividend<V> {
    const ZERO: Self = Self { at: AtPixel::ZERO, block: Block::ZERO };

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        Self { at: self.at.plus(&change.at), ..self }
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        Self { at: self.at.times(count), ..self }
    }
}
