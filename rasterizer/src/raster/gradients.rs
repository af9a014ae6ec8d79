//! What a shader can read of a triangle before its pixels are drawn.

use super::Triangle;
use crate::{
    attribute::{DepthFormat, Interpolate, NoDepth},
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
};

/// The varyings of a triangle as functions of the pixel. Each method computes its result when it is
/// called.
#[derive(Clone, Copy, Debug)]
pub struct Gradients<'v, V> {
    corners: [&'v V; 3],
    places: [[i32; 2]; 3],
    area: i64,
    subpixel_bits: u32,
}

impl<'v, V: Interpolate> Gradients<'v, V> {
    #[inline(always)]
    pub(crate) fn of<S: Subpixel, D: DepthFormat>(triangle: &Triangle<'v, S, D, V>) -> Self {
        let corners = triangle.corners();
        Self {
            corners: corners.map(|corner| &corner.varyings),
            places: corners.map(|corner| [corner.x, corner.y]),
            area: triangle.area(),
            subpixel_bits: S::BITS,
        }
    }

    /// The varyings at the corners, in the triangle's order.
    #[inline(always)]
    #[must_use]
    pub fn corners(&self) -> [V; 3] {
        self.corners.map(|&varyings| varyings)
    }

    /// Returns those of a part of the varyings: for a shader that adds its own to another's.
    #[inline(always)]
    #[must_use]
    pub fn part<A>(&self, part: impl Fn(&'v V) -> &'v A) -> Gradients<'v, A> {
        let Self { corners, places, area, subpixel_bits } = *self;
        Gradients { corners: corners.map(part), places, area, subpixel_bits }
    }

    /// Twice the area in square pixels, with 2 [`subpixel_bits`](Self::subpixel_bits) binary digits
    /// behind the point: negative if the corners run counter-clockwise on the screen.
    #[inline(always)]
    #[must_use]
    pub const fn doubled_area(&self) -> i64 {
        self.area
    }

    /// The binary digits behind the point of a pixel coordinate: 4 or 8.
    #[inline(always)]
    #[must_use]
    pub const fn subpixel_bits(&self) -> u32 {
        self.subpixel_bits
    }

    /// Computes the varyings as a function of the display's columns and rows, counted from its
    /// top-left pixel: the same that the triangle's spans follow.
    #[must_use]
    pub fn field(&self) -> V::Field {
        if self.subpixel_bits == S4::BITS { self.field_in::<S4>() } else { self.field_in::<S8>() }
    }

    #[inline(always)]
    fn field_in<S: Subpixel>(&self) -> V::Field {
        let [a, b, c] = core::array::from_fn(|i| {
            let [x, y] = self.places[i];
            ScreenVertex::<S, NoDepth, V>::new(x, y, NoDepth, *self.corners[i])
        });
        Triangle::with_area([&a, &b, &c], self.area).varyings_field()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::{Layout, Primitive as _, Window, signed_area};

    /// At the first pixel of each span the plane has the span's value, for quick and exact planes.
    #[test]
    fn the_plane_is_the_spans() {
        let window = Window { left: -64, top: -64, right: 256, bottom: 256 };
        for [b, c] in [[[900, 100], [200, 1000]], [[3000, 17], [2999, 18]], [[40, 7], [-900, 60]]] {
            let vertex = |[x, y]: [i32; 2], value| {
                ScreenVertex::<S4, u16, [u16; 2]>::checked(x, y, 1, [value, 9]).unwrap()
            };
            let corners = [vertex([5, -3], 100), vertex(b, 65_535), vertex(c, 7)];
            let corners = corners.each_ref();
            let triangle = Triangle::with_area(corners, signed_area(corners));
            let gradients = Gradients::of(&triangle);
            assert_eq!(gradients.corners(), [[100, 9], [65_535, 9], [7, 9]]);
            let plane = gradients.field();
            let layout = Layout { pitch: 0, origin: window.left };
            let mut spans = 0;
            let Ok(()) = triangle.for_each_span(&window, layout, |span| {
                let column = span.start as i32 + window.left;
                let first = span.varyings.at(span.start as i32, span.row);
                assert_eq!(plane.at(column, span.row), first, "{b:?} {c:?} {span:?}");
                assert_eq!(plane.per_column, span.varyings.per_column);
                spans += 1;
                Ok::<(), core::convert::Infallible>(())
            });
            assert!(spans > 0, "{b:?} {c:?}");
        }
    }
}
