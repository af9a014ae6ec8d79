//! A point of a surface that light falls on.

use core::marker::PhantomData;

use super::{
    Illuminate, Levels,
    gloss::Gloss,
    viewer::{Eye, Viewpoint},
};
use crate::numbers::{Scaled, at_most, unit_q15};

/// A point of a surface, with what its light depends on.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint<'a, V> {
    /// With one over its length.
    pub(in crate::shade) normal: Scaled,
    /// In 16 bits.
    pub(in crate::shade) position: [i32; 3],
    /// The direction towards the viewer, in Q15.
    viewer: [i32; 3],
    gloss: &'a Gloss,
    kind: PhantomData<V>,
}

impl<'a, V: Viewpoint> SurfacePoint<'a, V> {
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
