//! Any number of lights of any kind.

mod gloss;
mod lamp;
mod light;
mod lit;
mod place;
mod point;
mod surface_point;
mod viewer;

use core::fmt::Debug;

pub(super) use self::{
    gloss::Gloss,
    lit::{Lit, face_level, vertex_level},
    place::{Ambit, POSITION_BITS, Place, unit_varying},
    surface_point::SurfacePoint,
    viewer::{Eye, Viewpoint},
};
pub use self::{
    lamp::Lamp,
    light::{Level, Light},
    viewer::{FarViewer, NearViewer, ViewedFrom},
};
use crate::geometry::ObjectView;

/// What lights a surface: a [`Light`], a [`Lamp`], or several, as an array or a tuple of up to four
/// of any kind, such as `([Light; 2], Lamp)`.
///
/// Their levels are added, and the sum is at most 1. Light is white: it makes a surface's colour
/// brighter or darker in the values that pictures store. Coloured light is not supported, and
/// surfaces cast no shadows.
pub trait Lighting: Copy + Debug + Illuminate {}

impl<L: Illuminate> Lighting for L {}

/// What shaders need of lights.
pub trait Illuminate: Copy + Debug {
    /// The lights as pixels need them.
    type Beams: Copy + Debug;

    /// Whether light depends on the position of a surface.
    type Place: Place;

    /// How many lights there are.
    const COUNT: usize;

    /// [`Beams`](Self::Beams) before there is an object.
    const NO_BEAMS: Self::Beams;

    /// Returns the lights in the space of an object.
    fn for_view(&self, view: &ObjectView<'_>) -> Self;

    /// The brightness of a surface with this normal, 127 standing for 1, at a position in quanta:
    /// Q28, from 0 to 2^28.
    fn brightness(&self, normal: [i8; 3], position: [i16; 3]) -> u32;

    /// Returns what pixels need of lights in object space, for a viewer in the direction `viewer`,
    /// in Q15, if that is the same from everywhere.
    fn beams(&self, viewer: [i32; 3]) -> Self::Beams;

    /// Adds the levels of a point.
    fn shine<V: Viewpoint>(beams: &Self::Beams, point: &SurfacePoint<'_, V>, sum: &mut Levels);
}

/// The sums of [`Illuminate::shine`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Levels {
    /// In Q16, below 2^17 for each light.
    pub(in crate::shade) ambient: u32,
    /// The diffuse level times the length of the point's normal, so that a sum is scaled once:
    /// below 2^17 for each light.
    pub(in crate::shade) direct: u32,
    /// In Q16, below 2^17 for each light.
    pub(in crate::shade) specular: u32,
}

/// The brightness in Q16, from 0 to 65,536.
#[inline(always)]
pub(in crate::shade) fn level<L: Illuminate>(
    lights: &L,
    normal: [i8; 3],
    position: [i16; 3],
) -> u32 {
    lights.brightness(normal, position) >> 12
}

impl<L: Illuminate, const N: usize> Illuminate for [L; N] {
    type Beams = [L::Beams; N];
    type Place = L::Place;

    const COUNT: usize = N * L::COUNT;

    const NO_BEAMS: Self::Beams = [L::NO_BEAMS; N];

    fn for_view(&self, view: &ObjectView<'_>) -> Self {
        self.map(|light| light.for_view(view))
    }

    #[inline(always)]
    fn brightness(&self, normal: [i8; 3], position: [i16; 3]) -> u32 {
        let mut sum = 0;
        for light in self {
            sum = (sum + light.brightness(normal, position)).min(1 << 28);
        }
        sum
    }

    fn beams(&self, viewer: [i32; 3]) -> Self::Beams {
        self.map(|light| light.beams(viewer))
    }

    #[inline(always)]
    fn shine<V: Viewpoint>(beams: &Self::Beams, point: &SurfacePoint<'_, V>, sum: &mut Levels) {
        for beams in beams {
            L::shine(beams, point, sum);
        }
    }
}

macro_rules! several {
    ($place:ty: $($light:ident $index:tt),*) => {
        impl<$($light: Illuminate),*> Illuminate for ($($light,)*) {
            type Beams = ($($light::Beams,)*);
            type Place = $place;

            const COUNT: usize = 0 $(+ $light::COUNT)*;

            const NO_BEAMS: Self::Beams = ($($light::NO_BEAMS,)*);

            fn for_view(&self, view: &ObjectView<'_>) -> Self {
                ($(self.$index.for_view(view),)*)
            }

            #[inline(always)]
            fn brightness(&self, normal: [i8; 3], position: [i16; 3]) -> u32 {
                // Four of 2^28 at most.
                let sum = 0 $(+ self.$index.brightness(normal, position))*;
                sum.min(1 << 28)
            }

            fn beams(&self, viewer: [i32; 3]) -> Self::Beams {
                ($(self.$index.beams(viewer),)*)
            }

            #[inline(always)]
            fn shine<V: Viewpoint>(beams: &Self::Beams, point: &SurfacePoint<'_, V>, sum: &mut Levels) {
                $($light::shine(&beams.$index, point, sum);)*
            }
        }
    };
}

several!(Ambit<A::Place, B::Place>: A 0, B 1);
several!(Ambit<Ambit<A::Place, B::Place>, C::Place>: A 0, B 1, C 2);
several!(Ambit<Ambit<Ambit<A::Place, B::Place>, C::Place>, D::Place>: A 0, B 1, C 2, D 3);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        numbers::Vec3,
        shade::{Level, Light},
    };

    const A: Light = Light::new(Vec3::lit("1", "2", "2"), Level::lit("0.1"), Level::lit("0.4"));
    const B: Light = Light::new(Vec3::lit("-2", "1", "2"), Level::ZERO, Level::lit("0.3"));
    const BRIGHT: Light = Light::new(Vec3::Z, Level::ZERO, Level::MAX);

    #[test]
    fn levels_of_several_lights_are_sums_up_to_full_light() {
        let place = [0; 3];
        for normal in [[127, 0, 0], [0, 127, 0], [0, 0, 127], [42, 85, 85], [0, 0, -127]] {
            let [a, b] = [A.brightness(normal, place), B.brightness(normal, place)];
            assert_eq!([A].brightness(normal, place), a);
            assert_eq!([A, B].brightness(normal, place), a + b, "{normal:?}");
            assert_eq!((B, A).brightness(normal, place), a + b, "{normal:?}");
            assert_eq!((A, [B], B).brightness(normal, place), a + 2 * b, "{normal:?}");
            assert_eq!((A, B, B, B).brightness(normal, place), a + 3 * b, "{normal:?}");
            let full = (A, BRIGHT).brightness(normal, place);
            assert_eq!(full, (a + BRIGHT.brightness(normal, place)).min(1 << 28));
        }
        assert_eq!([BRIGHT; 40].brightness([0, 0, 127], place), 1 << 28);
        assert_eq!((BRIGHT, BRIGHT, BRIGHT, BRIGHT).brightness([0, 0, 127], place), 1 << 28);
    }
}
