//! The core's formats of depth, chosen at run time.
//!
//! Each shader is drawn by two projections with two precisions, with fog and without: a copy of all
//! of it for each format would triple that. Here, one type calls what the chosen format has, as
//! [`any_mode`](super::any_mode) does for the modes of perspective.

use std::cell::Cell;

use bytemuck::{Pod, Zeroable};
use rasterizer::{
    attribute::{
        DepthFormat as Format, FloatDepth, Interpolate, Piece, Plane, QuickGradients, Step,
        TriangleSetup, Whole,
    },
    fixed::types::U0F32,
    numbers::Subpixel,
    output::{FrameDepth, StoredDepth},
};

use super::DepthFormat;

thread_local! {
    /// The format of this thread's pictures: a stored depth has no room for it.
    static CHOSEN: Cell<DepthFormat> = const { Cell::new(DepthFormat::U16) };
}

/// Projects and draws in a format.
pub(super) fn with<T>(format: DepthFormat, draw: impl FnOnce() -> T) -> T {
    let before = CHOSEN.replace(format);
    let drawn = draw();
    CHOSEN.set(before);
    drawn
}

/// The bits of a depth in the format that [`with`] chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub(super) struct AnyDepth(u32);

impl From<AnyDepth> for u32 {
    fn from(depth: AnyDepth) -> Self {
        depth.0
    }
}

/// A format whose bits these are.
trait Bits: Format + Into<u32> {
    fn of(depth: AnyDepth) -> Self;
}

impl Bits for u16 {
    fn of(depth: AnyDepth) -> Self {
        depth.0 as Self
    }
}

impl Bits for FloatDepth {
    fn of(depth: AnyDepth) -> Self {
        Self::from_bits(depth.0 as u16)
    }
}

impl Bits for u32 {
    fn of(depth: AnyDepth) -> Self {
        depth.0
    }
}

fn stored<D: Bits>(depth: D) -> AnyDepth {
    AnyDepth(depth.into())
}

impl Format for AnyDepth {
    fn from_fraction(q32: u32) -> Self {
        match CHOSEN.get() {
            DepthFormat::U16 => stored(u16::from_fraction(q32)),
            DepthFormat::Float16 => stored(FloatDepth::from_fraction(q32)),
            DepthFormat::U32 => stored(u32::from_fraction(q32)),
        }
    }

    fn to_fraction(self) -> U0F32 {
        match CHOSEN.get() {
            DepthFormat::U16 => u16::of(self).to_fraction(),
            DepthFormat::Float16 => FloatDepth::of(self).to_fraction(),
            DepthFormat::U32 => u32::of(self).to_fraction(),
        }
    }

    fn at(value: Walk) -> Self {
        match value {
            Walk::U16(walk) => stored(u16::at(walk)),
            Walk::Float16(walk) => stored(FloatDepth::at(walk)),
            Walk::U32(walk) => stored(u32::at(walk)),
        }
    }

    fn is_nearer(self, stored: Self) -> bool {
        match CHOSEN.get() {
            DepthFormat::U16 => u16::of(self).is_nearer(u16::of(stored)),
            DepthFormat::Float16 => FloatDepth::of(self).is_nearer(FloatDepth::of(stored)),
            DepthFormat::U32 => u32::of(self).is_nearer(u32::of(stored)),
        }
    }
}

/// What is stepped in each format.
#[derive(Clone, Copy, Debug)]
pub(super) enum Walk {
    U16(<u16 as Interpolate>::Walk),
    Float16(<FloatDepth as Interpolate>::Walk),
    U32(<u32 as Interpolate>::Walk),
}

impl Step for Walk {
    const ZERO: Self = Self::U16(Step::ZERO);

    fn wrapping_add(self, change: Self) -> Self {
        match (self, change) {
            (Self::U16(value), Self::U16(change)) => Self::U16(Step::wrapping_add(value, change)),
            (Self::Float16(value), Self::Float16(change)) => {
                Self::Float16(value.wrapping_add(change))
            }
            (Self::U32(value), Self::U32(change)) => Self::U32(Step::wrapping_add(value, change)),
            _ => unreachable!("a depth and its change are of one format"),
        }
    }

    fn wrapping_mul(self, count: i32) -> Self {
        match self {
            Self::U16(value) => Self::U16(Step::wrapping_mul(value, count)),
            Self::Float16(value) => Self::Float16(value.wrapping_mul(count)),
            Self::U32(value) => Self::U32(Step::wrapping_mul(value, count)),
        }
    }
}

/// The plane of a format.
fn plane<S: Subpixel, D: Bits>(
    setup: &TriangleSetup<S>,
    quick: Option<QuickGradients>,
    corners: [AnyDepth; 3],
    walk: fn(D::Walk) -> Walk,
) -> Plane<Walk> {
    let Plane { anchor, per_column, per_row } = D::plane(setup, quick, corners.map(D::of));
    Plane { anchor: walk(anchor), per_column: walk(per_column), per_row: walk(per_row) }
}

impl Interpolate for AnyDepth {
    const ZERO: Self = Self(0);

    type Field = Plane<Walk>;
    type Walk = Walk;
    type Rest = Whole<Walk>;
    type Sample = Self;

    #[inline(never)]
    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<Walk> {
        match CHOSEN.get() {
            DepthFormat::U16 => plane::<S, u16>(setup, quick, corners, Walk::U16),
            DepthFormat::Float16 => plane::<S, FloatDepth>(setup, quick, corners, Walk::Float16),
            DepthFormat::U32 => plane::<S, u32>(setup, quick, corners, Walk::U32),
        }
    }

    fn whole(field: &Plane<Walk>, at: [i32; 2], pixels: usize) -> Option<Piece<Walk>> {
        Some(field.piece(at, pixels))
    }

    fn walk(field: &Plane<Walk>, at: [i32; 2], pixels: usize) -> (Piece<Walk>, Whole<Walk>) {
        (field.piece(at, pixels), std::iter::empty())
    }

    fn sample(value: Walk) -> Self {
        Self::at(value)
    }
}

impl FrameDepth for AnyDepth {
    type Buffer<'b> = &'b mut [Self];
}

impl StoredDepth for AnyDepth {}
