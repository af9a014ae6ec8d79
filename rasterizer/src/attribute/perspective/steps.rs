//! The modes that divide at some pixels of a span and go straight between them.

use core::marker::PhantomData;

use super::{
    Corrected, Correction, Pace, Quotient,
    pace::{Law, log2_below},
    quick::{QuickPieces, QuickQuotient},
    quotient::{AtPixel, Block, Corners},
};
use crate::{
    attribute::{
        Components, Field, Interpolate, InverseW, Piece, Plane, QuickGradients, Step, TriangleSetup,
    },
    numbers::Subpixel,
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
    /// Linear on the screen, in what pixels step.
    Short(Plane<V::Walk>, InverseW),
    /// Linear on the screen.
    Affine(V::Field, InverseW),
    /// Divided, by the law of the steps' lengths.
    #[expect(private_interfaces, reason = "only its steps know it")]
    Divided(Quotient<V>, Law<V>),
    /// Divided in 16 bits.
    Quick(QuickQuotient<V>),
}

impl<V: Components> Field for SteppedField<V> {
    #[inline(always)]
    fn over_addresses(mut self, to_first: [i32; 2], pitch: i32) -> Self {
        self.count_addresses(to_first, pitch);
        self
    }

    // codegen: in place, because a value that is returned is copied at its largest size.
    #[inline(always)]
    fn count_addresses(&mut self, to_first: [i32; 2], pitch: i32) {
        match self {
            Self::Short(plane, _) => plane.count_addresses(to_first, pitch),
            Self::Affine(field, _) => field.count_addresses(to_first, pitch),
            Self::Divided(field, _) => field.count_addresses(to_first, pitch),
            Self::Quick(field) => field.count_addresses(to_first, pitch),
        }
    }
}

impl<V: Components, P: Pace> Interpolate for InSteps<V, P> {
    const ZERO: Self = Self { value: V::ZERO, inverse_w: InverseW::ZERO, pace: PhantomData };
    const DIFFERS_BY_TRIANGLE: bool = V::DIFFERS_BY_TRIANGLE;

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
            return match V::short_plane(&field, setup.reach()) {
                Some(plane) => SteppedField::Short(plane, a.inverse_w),
                None => SteppedField::Affine(field, a.inverse_w),
            };
        }
        let bits = corners.bits();
        let quotient = Quotient::new(setup, quick, &corners, bits);
        let law = P::law(&corners, &quotient);
        QuickQuotient::new::<P>(&corners, &quotient, &law, setup.last_row())
            .map_or(SteppedField::Divided(quotient, law), SteppedField::Quick)
    }

    #[inline(always)]
    fn whole(
        field: &SteppedField<V>,
        at: [i32; 2],
        pixels: usize,
    ) -> Option<Piece<SteppedWalk<V>>> {
        match field {
            SteppedField::Short(plane, inverse_w) => {
                Some(SteppedWalk::affine(plane.piece(at, pixels), *inverse_w))
            }
            SteppedField::Affine(field, inverse_w) => {
                Some(SteppedWalk::affine(V::whole(field, at, pixels)?, *inverse_w))
            }
            SteppedField::Divided(..) | SteppedField::Quick(_) => None,
        }
    }

    #[inline(always)]
    fn walk(
        field: &SteppedField<V>,
        at: [i32; 2],
        pixels: usize,
    ) -> (Piece<SteppedWalk<V>>, Rest<V>) {
        match field {
            SteppedField::Short(plane, inverse_w) => {
                (SteppedWalk::affine(plane.piece(at, pixels), *inverse_w), Rest::Nothing)
            }
            SteppedField::Affine(field, inverse_w) => {
                let (piece, rest) = V::walk(field, at, pixels);
                (SteppedWalk::affine(piece, *inverse_w), Rest::Affine(rest, *inverse_w))
            }
            SteppedField::Divided(field, law) => {
                let mut pieces = Pieces::new::<P>(field, law, at, pixels);
                let piece = pieces.piece(pixels);
                (piece, Rest::Divided(pieces, pixels - piece.pixels))
            }
            SteppedField::Quick(field) => {
                let mut pieces = QuickPieces::new::<P>(field, at, pixels);
                let piece = pieces.piece(pixels);
                (piece, Rest::Quick(pieces, pixels - piece.pixels))
            }
        }
    }

    #[inline(always)]
    fn for_each_piece(
        field: &SteppedField<V>,
        at: [i32; 2],
        pixels: usize,
        mut visit: impl FnMut(Piece<SteppedWalk<V>>) -> usize,
    ) {
        match field {
            SteppedField::Short(plane, inverse_w) => {
                visit(SteppedWalk::affine(plane.piece(at, pixels), *inverse_w));
            }
            SteppedField::Affine(field, inverse_w) => {
                V::for_each_piece(field, at, pixels, |piece| {
                    visit(SteppedWalk::affine(piece, *inverse_w))
                });
            }
            SteppedField::Divided(field, law) => {
                let mut pieces = Pieces::new::<P>(field, law, at, pixels);
                let mut left = pixels;
                while left != 0 {
                    left = visit(pieces.piece(left));
                }
            }
            SteppedField::Quick(field) => {
                let mut pieces = QuickPieces::new::<P>(field, at, pixels);
                let mut left = pixels;
                while left != 0 {
                    left = visit(pieces.piece(left));
                }
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

    #[inline(always)]
    fn at_corner(self, corner: usize) -> Self {
        Self { value: self.value.at_corner(corner), ..self }
    }
}

/// Numbers on the way along a step.
#[derive(Clone, Copy, Debug)]
pub struct SteppedWalk<V: Components> {
    pub(super) numbers: V::Walk,
    /// near / w, if it is read.
    inverse_w: u32,
}

impl<V: Components> SteppedWalk<V> {
    /// Numbers beside near / w, which is dropped if it is not read.
    #[inline(always)]
    pub(super) const fn new(numbers: V::Walk, inverse_w: u32) -> Self {
        Self { numbers, inverse_w: if V::READS_INVERSE_W { inverse_w } else { 0 } }
    }

    /// A piece that is linear on the screen.
    #[inline(always)]
    const fn affine(piece: Piece<V::Walk>, inverse_w: InverseW) -> Piece<Self> {
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
                self.inverse_w
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
    /// It was the whole span.
    Nothing,
    /// Linear on the screen.
    Affine(V::Rest, InverseW),
    /// Divided, with the number of pixels that are left.
    Divided(Pieces<V>, usize),
    /// Divided in 16 bits, with the number of pixels that are left.
    Quick(QuickPieces<V>, usize),
}

impl<V: Components> Iterator for Rest<V> {
    type Item = Piece<SteppedWalk<V>>;

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::Nothing => None,
            Self::Affine(rest, inverse_w) => Some(SteppedWalk::affine(rest.next()?, *inverse_w)),
            Self::Divided(pieces, left) => next(left, |left| pieces.piece(left)),
            Self::Quick(pieces, left) => next(left, |left| pieces.piece(left)),
        }
    }
}

/// The next piece, if pixels are left.
#[inline(always)]
fn next<W>(left: &mut usize, piece: impl FnOnce(usize) -> Piece<W>) -> Option<Piece<W>> {
    (*left != 0).then(|| {
        let piece = piece(*left);
        *left -= piece.pixels;
        piece
    })
}

/// The steps of a span after its first one.
#[derive(Clone, Copy, Debug)]
pub struct Pieces<V: Components> {
    /// The numbers at the next pixel.
    value: V::Each<i32>,
    at: AtPixel<V>,
    /// Along a whole step.
    stride: AtPixel<V>,
    last: AtPixel<V>,
    block: Block<V>,
    /// The pixels of a step.
    length: usize,
}

impl<V: Components> Pieces<V> {
    /// From the first pixel of a span.
    #[inline(always)]
    fn new<P: Pace>(field: &Quotient<V>, law: &Law<V>, at: [i32; 2], pixels: usize) -> Self {
        let rows = field.rows(at[1]);
        let (first, change) = (field.at(at), field.along_row());
        let last = first.plus(&change.times(pixels as i32 - 1));
        let least = first.q().min(last.q());
        let length = P::pixels::<V>(P::level(law, rows) + 3 * log2_below(least));
        Self {
            value: first.divided(&field.block),
            at: first,
            stride: change.times(length as i32),
            last,
            block: field.block,
            length,
        }
    }

    /// The next step, with this many pixels from its first one to the end of the span, at least 1.
    /// It leads to a division after `length` pixels or at the span's last pixel, where the triangle
    /// has a value.
    #[inline(always)]
    fn piece(&mut self, left: usize) -> Piece<SteppedWalk<V>> {
        let (from, q) = (self.value, self.at.q());
        let (mut pixels, mut way) = (self.length, self.length);
        self.at = self.at.plus(&self.stride);
        if left <= pixels {
            (pixels, way) = (left, left - 1);
            self.at = self.last;
        }
        let (mut step, mut step_of_q) = (V::ZEROS, 0);
        if way != 0 {
            self.value = self.at.divided(&self.block);
            for ((step, to), from) in
                step.as_mut().iter_mut().zip(self.value.as_ref()).zip(from.as_ref())
            {
                *step = shared(to.wrapping_sub(*from), way);
            }
            if V::READS_INVERSE_W {
                step_of_q = shared(self.at.q().wrapping_sub(q) as i32, way);
            }
        }
        Piece {
            first: SteppedWalk::new(V::walk_from(from), self.block.inverse_w(q)),
            step: SteppedWalk::new(V::step_from(step), self.block.step_of_inverse_w(step_of_q)),
            pixels,
        }
    }
}

/// For n from 1 to 64, 2^(15 + log2 n) / n, rounded: from 2^14 to 2^15. The upper half has log2 n,
/// rounded down. Modulo 64, so that 64 is the first.
// codegen: a table of both, because a core without an instruction for logarithms takes long.
const PARTS: [u32; 64] = {
    let mut parts = [0; 64];
    let mut n = 1;
    while n <= 64 {
        let pixels = n as u32;
        let log2 = pixels.ilog2();
        let part = ((1 << (15 + log2)) + pixels / 2) / pixels;
        parts[n % 64] = part | log2 << 16;
        n += 1;
    }
    parts
};

/// What a change over `pixels` pixels, 1 to 64, is multiplied and shifted to the right by, for
/// that from each to the next: 2^15 times too much, and within 2^-15 of it.
#[inline(always)]
pub(super) const fn part(pixels: usize) -> (i32, u32) {
    let part = PARTS[pixels % 64];
    ((part & 0xFFFF) as i32, part >> 16)
}

/// A change over `pixels` pixels, 1 to 64, as that from each to the next.
#[inline(always)]
const fn shared(change: i32, pixels: usize) -> i32 {
    let (part, log2) = part(pixels);
    let (upper, lower) = (change >> 16, change & 0xFFFF);
    (2 * upper * part + ((lower * part) >> 15)) >> log2
}
