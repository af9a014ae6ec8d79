//! A place on a surface that light falls on, and from where it is seen.

use core::{fmt::Debug, marker::PhantomData};

use super::{
    Illuminate, Levels,
    gloss::Gloss,
    place::{Anywhere, Here, Place},
    point::Point,
};
use crate::{
    geometry::{ObjectView, Viewer},
    numbers::{Scaled, at_most, unit_q15},
};

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
    fn from(&self, position: [i32; 3]) -> [i32; 3] {
        if V::IS_NEAR { self.point.from(position).unit } else { self.direction }
    }
}

/// A place on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Spot<'a, V> {
    /// With one over its length.
    pub(in crate::shade) normal: Scaled,
    /// In 16 bits.
    pub(in crate::shade) position: [i32; 3],
    /// The direction towards the viewer, in Q15.
    viewer: [i32; 3],
    gloss: &'a Gloss,
    kind: PhantomData<V>,
}

impl<'a, V: Viewpoint> Spot<'a, V> {
    /// With a normal of a length below 2^15.
    #[inline(always)]
    pub(in crate::shade) fn new(
        [normal, position]: [[i32; 3]; 2],
        eye: &Eye<V>,
        gloss: &'a Gloss,
    ) -> Self {
        Self {
            normal: Scaled::of(normal),
            position,
            viewer: eye.from(position),
            gloss,
            kind: PhantomData,
        }
    }

    /// Whether the surface has highlights.
    #[inline(always)]
    pub(in crate::shade) const fn is_glossy(&self) -> bool {
        self.gloss.is_some()
    }

    /// Adds the highlight of a light of this level, in Q14, by the direction halfway to it.
    #[inline(always)]
    pub(in crate::shade) fn add_highlight(&self, half: &[i32; 3], level: i32, sum: &mut Levels) {
        self.add_power((self.normal.along(half) * self.normal.scale) >> 16, level, sum);
    }

    /// The same by the direction of the light, for a viewer or a light that is near.
    #[inline(always)]
    pub(in crate::shade) fn add_highlight_of(
        &self,
        light: &[i32; 3],
        level: i32,
        sum: &mut Levels,
    ) {
        let half = Scaled::of(half_sum(light, &self.viewer));
        // The cosine times the half sum's length, which the second scale takes off.
        let part = (self.normal.along(&half.vector) * self.normal.scale) >> 16;
        self.add_power((part * half.scale) >> 15, level, sum);
    }

    #[inline(always)]
    fn add_power(&self, cosine: u32, level: i32, sum: &mut Levels) {
        if let Some(below) = self.gloss.below_one(cosine) {
            sum.specular += at_most::<16>((self.gloss.power(below) * level) >> 13);
        }
    }

    /// The levels in Q16, below 2^16.
    #[inline(always)]
    pub(in crate::shade) fn levels<L: Illuminate>(&self, sum: &Levels) -> [u32; 2] {
        // What one light adds is below 2^31. 2^16 is more than full light for a normal of any
        // length.
        let [direct, specular] = [sum.direct, sum.specular]
            .map(|sum| if L::COUNT == 1 { sum } else { at_most::<16>(sum as i32) });
        let direct = (direct * self.normal.scale) >> 14;
        [at_most::<16>((sum.ambient + direct) as i32), specular]
    }
}

/// The direction halfway between two of length one, in Q15; zero if they are opposite.
#[inline(always)]
pub(in crate::shade) fn half(a: &[i32; 3], b: &[i32; 3]) -> [i32; 3] {
    unit_q15(half_sum(a, b))
}

/// Of a length of up to 2^15.
#[inline(always)]
fn half_sum([a, b, c]: &[i32; 3], [d, e, f]: &[i32; 3]) -> [i32; 3] {
    [a + d, b + e, c + f].map(|sum| sum - (sum >> 1))
}
