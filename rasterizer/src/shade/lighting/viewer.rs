//! From where a surface is seen.

use core::{fmt::Debug, marker::PhantomData};

use super::{
    place::{Anywhere, Here, Place},
    point::Point,
};
use crate::geometry::{ObjectView, Viewer};

/// From where highlights are seen: [`FarViewer`] or [`NearViewer`].
pub trait ViewedFrom: Copy + Debug + Viewpoint {}

impl ViewedFrom for FarViewer {}
impl ViewedFrom for NearViewer {}

/// All points of an object see the viewer in the direction in which the middle of its box does:
/// right in a parallel projection, and for objects that are small beside their distance. Where the
/// lights are far too, a pixel takes no position and one root less.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct FarViewer;

/// Each point sees the viewer in its own direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NearViewer;

pub trait Viewpoint: Copy + Debug {
    /// Whether the direction of the viewer depends on the position.
    type Place: Place;

    /// Whether it does.
    const IS_NEAR: bool;
}

impl Viewpoint for FarViewer {
    type Place = Anywhere;
    const IS_NEAR: bool = false;
}

impl Viewpoint for NearViewer {
    type Place = Here;
    const IS_NEAR: bool = true;
}

/// Where an object is seen from, in its space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::shade) struct Eye<V> {
    point: Point,
    /// The direction from the middle of the mesh's box, in Q15.
    direction: [i32; 3],
    kind: PhantomData<V>,
}

impl<V: Viewpoint> Eye<V> {
    /// Before there is an object.
    pub(in crate::shade) const NOWHERE: Self =
        Self { point: Point::ORIGIN, direction: [0; 3], kind: PhantomData };

    // codegen: not inlined: its temporaries leave the stack.
    #[inline(never)]
    pub(in crate::shade) fn of(view: &ObjectView<'_>) -> Self {
        let point = match view.viewer() {
            Viewer::At(eye) => Point::of(eye, view).0,
            Viewer::Toward(direction) => {
                Point::toward(view.pose().rotation.turn_back(&direction), view)
            }
        };
        let bounds = view.mesh().bounds();
        let middle = core::array::from_fn(|axis| {
            let ends = i32::from(bounds.min[axis]) + i32::from(bounds.max[axis]);
            (ends << view.mesh().spare_bits()) >> 1
        });
        Self { point, direction: point.from(middle).unit, kind: PhantomData }
    }

    /// The direction towards the viewer from the middle of the mesh, in Q15.
    pub(in crate::shade) const fn direction(&self) -> [i32; 3] {
        self.direction
    }

    /// The direction towards the viewer from a position of 16 bits, in Q15.
    #[inline(always)]
    pub(super) fn from(&self, position: [i32; 3]) -> [i32; 3] {
        if V::IS_NEAR { self.point.from(position).unit } else { self.direction }
    }
}
