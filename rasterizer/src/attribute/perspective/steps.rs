//! The modes that divide at some pixels of a span and go straight between them.

use core::marker::PhantomData;

use super::{
    AlongRow, AtPixel, Corrected, Correction, Pace, Quotient,
    quotient::{Block, Corners},
};
use crate::{
    attribute::{
        Change, Components, Field, First, Interpolate, InverseW, Piece, QuickGradients, Step,
        TriangleSetup,
    },
    numbers::{Subpixel, leading_zeros},
};

/// Numbers of a vertex with near / w.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InSteps<V, P> {
    value: V,
    inverse_w: InverseW,
    pace: PhantomData<P>,
}

impl<P: Pace> Correction for P {
    type OnScreen<V: Components> = InSteps<V, P>;

    #[inline(always)]
    fn on_screen<V: Components>(value: V, inverse_w: InverseW) -> InSteps<V, P> {
        InSteps { value, inverse_w, pace: PhantomData }
    }

    #[inline(always)]
    fn parts<V: Components>(vertex: &InSteps<V, P>) -> (V, InverseW) {
        (vertex.value, vertex.inverse_w)
    }
}

/// A triangle's numbers as functions of the pixel.
#[derive(Clone, Copy, Debug)]
pub enum SteppedField<V: Components> {
    /// Linear on the screen.
    Affine(V::Field, InverseW),
    /// Divided, by the law of the steps' lengths.
    Divided(Quotient<V>, i32),
}

/// Its numbers at the first pixel of a span.
#[derive(Clone, Copy, Debug)]
pub enum SteppedFirst<V: Components> {
    /// Linear on the screen.
    Affine(First<V>),
    /// Divided.
    Divided(AtPixel<V>),
}

/// Their change along a row.
#[derive(Clone, Copy, Debug)]
pub enum SteppedChange<V: Components> {
    /// Linear on the screen.
    Affine(Change<V>, InverseW),
    /// Divided, by the law of the steps' lengths.
    Divided(AlongRow<V>, i32),
}

impl<V: Components> Field for SteppedField<V> {
    type First = SteppedFirst<V>;
    type Change = SteppedChange<V>;

    #[inline(always)]
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self {
        match self {
            Self::Affine(field, inverse_w) => {
                Self::Affine(field.over_addresses(to_first, pitch), inverse_w)
            }
            Self::Divided(field, law) => Self::Divided(field.over_addresses(to_first, pitch), law),
        }
    }

    #[inline(always)]
    fn at(&self, address: i32, row: i32) -> SteppedFirst<V> {
        match self {
            Self::Affine(field, _) => SteppedFirst::Affine(field.at(address, row)),
            Self::Divided(field, _) => SteppedFirst::Divided(field.at(address, row)),
        }
    }

    #[inline(always)]
    fn change(&self) -> SteppedChange<V> {
        match self {
            Self::Affine(field, inverse_w) => SteppedChange::Affine(field.change(), *inverse_w),
            Self::Divided(field, law) => SteppedChange::Divided(field.change(), *law),
        }
    }
}

impl<V: Components, P: Pace> Interpolate for InSteps<V, P> {
    const ZERO: Self = Self { value: V::ZERO, inverse_w: InverseW::ZERO, pace: PhantomData };

    type Field = SteppedField<V>;
    type Walk = SteppedWalk<V>;
    type Rest = Rest<V>;
    type Sample = Corrected<V::Sample>;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        [a, b, c]: [Self; 3],
    ) -> SteppedField<V> {
        let corners = Corners::new([a, b, c].map(|corner| (corner.value, corner.inverse_w)));
        if P::is_affine(&corners) {
            let field = V::plane(setup, quick, [a.value, b.value, c.value]);
            return SteppedField::Affine(field, a.inverse_w);
        }
        let bits = corners.bits();
        let quotient = Quotient::new(setup, quick, &corners, bits);
        let law = P::of(&corners, &quotient, bits);
        SteppedField::Divided(quotient, law)
    }

    #[inline(always)]
    fn walk(
        first: SteppedFirst<V>,
        change: SteppedChange<V>,
        pixels: usize,
    ) -> (Piece<SteppedWalk<V>>, Rest<V>) {
        match (first, change) {
            (SteppedFirst::Divided(at), SteppedChange::Divided(change, law)) => {
                let last = at.plus(&change.step.times(pixels as i32 - 1));
                let log2_pixels = P::log2_pixels::<V>(law, [at.q(), last.q()]);
                let mut pieces = Pieces {
                    value: at.divided(&change.block),
                    at,
                    step: change.step,
                    block: change.block,
                    log2_pixels,
                    pixels,
                };
                (pieces.piece(), Rest::Divided(pieces))
            }
            (SteppedFirst::Affine(first), SteppedChange::Affine(change, inverse_w)) => {
                let (piece, rest) = V::walk(first, change, pixels);
                (SteppedWalk::affine(piece, inverse_w), Rest::Affine(rest, inverse_w))
            }
            // Both are of one field.
            _ => {
                let piece = Piece { first: SteppedWalk::ZERO, step: SteppedWalk::ZERO, pixels };
                (piece, Rest::Divided(Pieces::NONE))
            }
        }
    }

    #[inline(always)]
    fn sample(value: SteppedWalk<V>) -> Corrected<V::Sample> {
        Corrected {
            value: V::sample(value.numbers),
            inverse_w: if V::READS_INVERSE_W {
                InverseW::from_bits(value.inverse_w)
            } else {
                InverseW::ONE
            },
        }
    }
}

/// Numbers on the way along a step.
#[derive(Clone, Copy, Debug)]
pub struct SteppedWalk<V: Components> {
    numbers: V::Walk,
    /// near / w, if it is read.
    inverse_w: u32,
}

impl<V: Components> SteppedWalk<V> {
    /// A piece that is linear on the screen.
    #[inline(always)]
    fn affine(piece: Piece<V::Walk>, inverse_w: InverseW) -> Piece<Self> {
        Piece {
            first: Self { numbers: piece.first, inverse_w: inverse_w.to_bits() },
            step: Self { numbers: piece.step, inverse_w: 0 },
            pixels: piece.pixels,
        }
    }
}

impl<V: Components> Step for SteppedWalk<V> {
    const ZERO: Self = Self { numbers: V::Walk::ZERO, inverse_w: 0 };

    #[inline(always)]
    fn wrapping_add(self, change: Self) -> Self {
        Self {
            numbers: self.numbers.wrapping_add(change.numbers),
            inverse_w: if V::READS_INVERSE_W {
                self.inverse_w.wrapping_add(change.inverse_w)
            } else {
                0
            },
        }
    }

    #[inline(always)]
    fn wrapping_mul(self, count: i32) -> Self {
        Self {
            numbers: self.numbers.wrapping_mul(count),
            inverse_w: self.inverse_w.wrapping_mul(count as u32),
        }
    }
}

/// What follows a span's first piece.
#[derive(Debug)]
pub enum Rest<V: Components> {
    /// Linear on the screen.
    Affine(V::Rest, InverseW),
    /// Divided.
    Divided(Pieces<V>),
}

impl<V: Components> Iterator for Rest<V> {
    type Item = Piece<SteppedWalk<V>>;

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::Affine(rest, inverse_w) => Some(SteppedWalk::affine(rest.next()?, *inverse_w)),
            Self::Divided(pieces) => (pieces.pixels != 0).then(|| pieces.piece()),
        }
    }
}

/// The steps of a span after its first one.
#[derive(Clone, Copy, Debug)]
pub struct Pieces<V: Components> {
    /// The numbers at the next pixel.
    value: V::Each<i32>,
    at: AtPixel<V>,
    step: AtPixel<V>,
    block: Block<V>,
    log2_pixels: u32,
    /// From the next pixel to the end of the span.
    pixels: usize,
}

impl<V: Components> Pieces<V> {
    const NONE: Self = Self {
        value: V::ZEROS,
        at: AtPixel::ZERO,
        step: AtPixel::ZERO,
        block: Block::ZERO,
        log2_pixels: 0,
        pixels: 0,
    };

    /// The next step, of which there is one: to a division after 2^`log2_pixels` pixels or at the
    /// span's last pixel, where the triangle has a value.
    #[inline(always)]
    fn piece(&mut self) -> Piece<SteppedWalk<V>> {
        let length = 1 << self.log2_pixels;
        let is_last = self.pixels <= length;
        let (pixels, way) = if is_last { (self.pixels, self.pixels - 1) } else { (length, length) };
        let (from, q) = (self.value, self.at.q());
        let mut step = V::ZEROS;
        if way != 0 {
            self.at = self.at.plus(&self.step.times(way as i32));
            self.value = self.at.divided(&self.block);
            for ((step, to), from) in
                step.as_mut().iter_mut().zip(self.value.as_ref()).zip(from.as_ref())
            {
                let change = to.wrapping_sub(*from);
                *step = if is_last { part(change, way) } else { change >> self.log2_pixels };
            }
        }
        self.pixels -= pixels;
        let walk = |numbers, q| SteppedWalk {
            numbers,
            inverse_w: if V::READS_INVERSE_W { self.block.inverse_w(q) } else { 0 },
        };
        Piece {
            first: walk(V::walk_from(from), q),
            step: walk(V::step_from(step), (self.step.q >> 32) as u32),
            pixels,
        }
    }
}

/// 2^(15 + log2 n) / n, rounded: from 2^14 to 2^15.
const PARTS: [u16; 64] = {
    let mut parts = [0; 64];
    let mut n = 1;
    while n < 64 {
        parts[n] = (((1 << (15 + n.ilog2())) + n / 2) / n) as u16;
        n += 1;
    }
    parts
};

/// A change over `pixels` pixels, 1 to 63, as that from each to the next: within 2^-15 of it.
#[inline(always)]
const fn part(change: i32, pixels: usize) -> i32 {
    let part = PARTS[pixels & 63] as i32;
    let log2 = 31 - leading_zeros(pixels as u32);
    let (upper, lower) = (change >> 16, change & 0xFFFF);
    (2 * upper * part + ((lower * part) >> 15)) >> log2
}
