//! The core's modes of perspective, chosen at run time.
//!
//! A mode is a type, so that firmware has one of them. A comparison needs all, and a scene compiled
//! for each of them, with each depth format, projection and shader, would take minutes. Here, one
//! type calls what the chosen one has.

use std::cell::Cell;

use rasterizer::{
    attribute::{
        Adaptive, Affine, Components, Corrected, Correction as Mode, Every, EveryPixel, Field,
        Interpolate, InverseW, Piece, QuickGradients, Step, TriangleSetup,
    },
    numbers::Subpixel,
};

use super::Correction;

thread_local! {
    /// The mode of the vertices that are projected in this thread: a shader's type has no room for
    /// it.
    static CHOSEN: Cell<Correction> = const { Cell::new(Correction::EveryPixel) };
}

/// The mode that [`with`] chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AnyMode;

/// Projects and draws in a mode.
pub(super) fn with<T>(mode: Correction, draw: impl FnOnce() -> T) -> T {
    let before = CHOSEN.replace(mode);
    let drawn = draw();
    CHOSEN.set(before);
    drawn
}

type Linear<V> = <Affine as Mode>::OnScreen<V>;
type Exact<V> = <EveryPixel as Mode>::OnScreen<V>;
/// Its types are those of all modes with steps.
type Stepped<V> = <Every<4> as Mode>::OnScreen<V>;

/// Numbers of a vertex with near / w, and their mode.
#[derive(Clone, Copy, Debug)]
pub(super) struct InAnyMode<V> {
    value: V,
    inverse_w: InverseW,
    mode: Correction,
}

impl Mode for AnyMode {
    type OnScreen<V: Components> = InAnyMode<V>;

    fn on_screen<V: Components>(value: V, inverse_w: InverseW) -> InAnyMode<V> {
        InAnyMode { value, inverse_w, mode: CHOSEN.get() }
    }

    fn parts<V: Components>(vertex: &InAnyMode<V>) -> (V, InverseW) {
        (vertex.value, vertex.inverse_w)
    }
}

/// What one of the three kinds of modes has.
#[derive(Clone, Copy, Debug)]
pub(super) enum Of<L, E, S> {
    Linear(L),
    Exact(E),
    /// With its mode.
    Stepped(S, Correction),
}

/// The function of the pixel in a mode.
fn plane<S: Subpixel, M: Mode, V: Components>(
    setup: &TriangleSetup<S>,
    quick: Option<QuickGradients>,
    corners: [InAnyMode<V>; 3],
) -> <M::OnScreen<V> as Interpolate>::Field {
    let corners = corners.map(|corner| M::on_screen(corner.value, corner.inverse_w));
    Interpolate::plane(setup, quick, corners)
}

/// Calls a function of [`Interpolate`] for the mode of a field with steps.
macro_rules! by_steps {
    ($mode:expr, $function:ident($($argument:expr),*)) => {
        match $mode {
            Correction::Every4 => <Every<4> as Mode>::OnScreen::<V>::$function($($argument),*),
            Correction::Every8 => <Every<8> as Mode>::OnScreen::<V>::$function($($argument),*),
            Correction::Every16 => <Every<16> as Mode>::OnScreen::<V>::$function($($argument),*),
            Correction::Every32 => <Every<32> as Mode>::OnScreen::<V>::$function($($argument),*),
            _ => <Adaptive<8> as Mode>::OnScreen::<V>::$function($($argument),*),
        }
    };
}

impl<V: Components> Interpolate for InAnyMode<V> {
    const ZERO: Self =
        Self { value: V::ZERO, inverse_w: InverseW::ONE, mode: Correction::EveryPixel };

    type Field = Of<
        <Linear<V> as Interpolate>::Field,
        <Exact<V> as Interpolate>::Field,
        <Stepped<V> as Interpolate>::Field,
    >;
    type Walk = Of<
        <Linear<V> as Interpolate>::Walk,
        <Exact<V> as Interpolate>::Walk,
        <Stepped<V> as Interpolate>::Walk,
    >;
    type Rest = Of<
        <Linear<V> as Interpolate>::Rest,
        <Exact<V> as Interpolate>::Rest,
        <Stepped<V> as Interpolate>::Rest,
    >;
    type Sample = Corrected<V::Sample>;

    #[inline(never)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Self::Field {
        match corners[0].mode {
            Correction::Affine => Of::Linear(plane::<S, Affine, V>(setup, quick, corners)),
            Correction::EveryPixel => Of::Exact(plane::<S, EveryPixel, V>(setup, quick, corners)),
            mode @ Correction::Every4 => {
                Of::Stepped(plane::<S, Every<4>, V>(setup, quick, corners), mode)
            }
            mode @ Correction::Every8 => {
                Of::Stepped(plane::<S, Every<8>, V>(setup, quick, corners), mode)
            }
            mode @ Correction::Every16 => {
                Of::Stepped(plane::<S, Every<16>, V>(setup, quick, corners), mode)
            }
            mode @ Correction::Every32 => {
                Of::Stepped(plane::<S, Every<32>, V>(setup, quick, corners), mode)
            }
            mode @ Correction::Adaptive => {
                Of::Stepped(plane::<S, Adaptive<8>, V>(setup, quick, corners), mode)
            }
        }
    }

    #[inline(never)]
    fn whole(field: &Self::Field, at: [i32; 2], pixels: usize) -> Option<Piece<Self::Walk>> {
        match field {
            Of::Linear(field) => Some(piece_of(Linear::<V>::whole(field, at, pixels)?, Of::Linear)),
            Of::Exact(field) => Some(piece_of(Exact::<V>::whole(field, at, pixels)?, Of::Exact)),
            &Of::Stepped(ref field, mode) => {
                let whole = by_steps!(mode, whole(field, at, pixels));
                Some(piece_of(whole?, |walk| Of::Stepped(walk, mode)))
            }
        }
    }

    #[inline(never)]
    fn walk(field: &Self::Field, at: [i32; 2], pixels: usize) -> (Piece<Self::Walk>, Self::Rest) {
        match field {
            Of::Linear(field) => {
                let (piece, rest) = Linear::<V>::walk(field, at, pixels);
                (piece_of(piece, Of::Linear), Of::Linear(rest))
            }
            Of::Exact(field) => {
                let (piece, rest) = Exact::<V>::walk(field, at, pixels);
                (piece_of(piece, Of::Exact), Of::Exact(rest))
            }
            &Of::Stepped(ref field, mode) => {
                let (piece, rest) = by_steps!(mode, walk(field, at, pixels));
                (piece_of(piece, |walk| Of::Stepped(walk, mode)), Of::Stepped(rest, mode))
            }
        }
    }

    fn for_each_piece(
        field: &Self::Field,
        at: [i32; 2],
        pixels: usize,
        mut visit: impl FnMut(Piece<Self::Walk>) -> usize,
    ) {
        for_each_piece::<V>(field, at, pixels, &mut visit);
    }

    fn sample(value: Self::Walk) -> Self::Sample {
        match value {
            Of::Linear(walk) => Linear::<V>::sample(walk),
            Of::Exact(walk) => Exact::<V>::sample(walk),
            // Steps of all lengths are sampled alike.
            Of::Stepped(walk, _) => Stepped::<V>::sample(walk),
        }
    }
}

/// [`Interpolate::for_each_piece`], without a copy of `visit` for each mode: it contains the loop
/// over pixels.
fn for_each_piece<V: Components>(
    field: &<InAnyMode<V> as Interpolate>::Field,
    at: [i32; 2],
    pixels: usize,
    visit: &mut dyn FnMut(Piece<<InAnyMode<V> as Interpolate>::Walk>) -> usize,
) {
    match field {
        Of::Linear(field) => {
            let visit = |piece| visit(piece_of(piece, Of::Linear));
            Linear::<V>::for_each_piece(field, at, pixels, visit);
        }
        Of::Exact(field) => {
            let visit = |piece| visit(piece_of(piece, Of::Exact));
            Exact::<V>::for_each_piece(field, at, pixels, visit);
        }
        &Of::Stepped(ref field, mode) => {
            let visit = |piece| visit(piece_of(piece, |walk| Of::Stepped(walk, mode)));
            by_steps!(mode, for_each_piece(field, at, pixels, visit));
        }
    }
}

fn piece_of<A, B>(piece: Piece<A>, of: impl Fn(A) -> B) -> Piece<B> {
    Piece { first: of(piece.first), step: of(piece.step), pixels: piece.pixels }
}

impl<L: Field, E: Field, S: Field> Field for Of<L, E, S> {
    fn over_addresses(self, to_first: [i32; 2], pitch: i32) -> Self {
        match self {
            Self::Linear(field) => Self::Linear(field.over_addresses(to_first, pitch)),
            Self::Exact(field) => Self::Exact(field.over_addresses(to_first, pitch)),
            Self::Stepped(field, mode) => {
                Self::Stepped(field.over_addresses(to_first, pitch), mode)
            }
        }
    }
}

impl<L: Step, E: Step, S: Step> Step for Of<L, E, S> {
    const ZERO: Self = Self::Linear(L::ZERO);

    fn wrapping_add(self, change: Self) -> Self {
        match (self, change) {
            (Self::Linear(value), Self::Linear(change)) => Self::Linear(value.wrapping_add(change)),
            (Self::Exact(value), Self::Exact(change)) => Self::Exact(value.wrapping_add(change)),
            (Self::Stepped(value, mode), Self::Stepped(change, _)) => {
                Self::Stepped(value.wrapping_add(change), mode)
            }
            _ => unreachable!("a value and its change are of one mode"),
        }
    }

    fn wrapping_mul(self, count: i32) -> Self {
        match self {
            Self::Linear(value) => Self::Linear(value.wrapping_mul(count)),
            Self::Exact(value) => Self::Exact(value.wrapping_mul(count)),
            Self::Stepped(value, mode) => Self::Stepped(value.wrapping_mul(count), mode),
        }
    }
}

impl<L, E, S, A, B, C> Iterator for Of<L, E, S>
where
    L: Iterator<Item = Piece<A>>,
    E: Iterator<Item = Piece<B>>,
    S: Iterator<Item = Piece<C>>,
{
    type Item = Piece<Of<A, B, C>>;

    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::Linear(rest) => Some(piece_of(rest.next()?, Of::Linear)),
            Self::Exact(rest) => Some(piece_of(rest.next()?, Of::Exact)),
            Self::Stepped(rest, mode) => {
                let mode = *mode;
                Some(piece_of(rest.next()?, |walk| Of::Stepped(walk, mode)))
            }
        }
    }
}
