//! From a point of the world to the screen, and from a pixel into the world.

use embedded_graphics_core::geometry::Point;
use fixed::types::{I2F30, I16F16, U0F32};

use super::{Plane, Projection, screen::GUARD_BITS};
use crate::{
    camera::Camera,
    numbers::{Float, Scalar, Vec3, unit},
};

/// The points of the world that a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ray {
    /// Where it begins: at the eye, or in a parallel projection beside it.
    pub origin: Vec3,
    /// Its direction, of length one.
    pub direction: [I2F30; 3],
}

/// Where a point of the world lies on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ScreenPlace {
    /// In pixels from the display's left side.
    pub x: I16F16,
    /// In pixels from the display's upper side.
    pub y: I16F16,
    /// Its depth: near / w in a perspective, as a depth buffer has it. What is nearer has more.
    pub depth: U0F32,
}

impl ScreenPlace {
    /// The pixel that it is in.
    #[must_use]
    pub const fn pixel(&self) -> Point {
        Point::new(self.x.to_bits() >> 16, self.y.to_bits() >> 16)
    }
}

impl<P: Projection> Camera<P> {
    /// The ray through the centre of a pixel of the display: what a finger or a mouse points at. It
    /// may lie outside the viewport.
    ///
    /// The direction is within 2<sup>-26</sup> of exact. In a parallel projection the origin is
    /// rounded to 2<sup>-16</sup> units and a 2<sup>28</sup>th of its distance from the eye; it
    /// saturates.
    #[must_use]
    pub fn ray(&self, pixel: Point) -> Ray {
        let viewport = self.viewport();
        let [right, down, forward] = *self.axes();
        // From the viewport's middle, in half pixels.
        let from_middle = |pixel: i32, corner: i32, side: u32| {
            2 * (i64::from(pixel) - i64::from(corner)) + 1 - i64::from(side)
        };
        let x = from_middle(pixel.x, viewport.top_left.x, viewport.size.width);
        let y = from_middle(pixel.y, viewport.top_left.y, viewport.size.height);
        let across = |i: usize| {
            // Q30 times 34 bits.
            let [right, down] = [(right[i], x), (down[i], y)]
                .map(|(axis, c)| Float::new(axis.into(), -30).times(Float::new(c, -1)));
            right.plus(down)
        };
        let pixels = self.pixels_per_unit();
        if P::IS_PARALLEL {
            let per_pixel = pixels.reciprocal();
            let eye = self.eye().to_bits();
            let origin = [0, 1, 2].map(|i| {
                let way = across(i).times(per_pixel).in_units_of(-16);
                eye[i].saturating_add(way)
            });
            let direction = forward.map(I2F30::from_bits);
            return Ray { origin: Vec3::from_bits(origin), direction };
        }
        let way =
            [0, 1, 2].map(|i| Float::new(forward[i].into(), -30).times(pixels).plus(across(i)));
        let most = way.iter().fold(i32::MIN, |most, c| most.max(c.magnitude()));
        let direction = unit(way.map(|c| i64::from(c.in_units_of(most - 31)))).unwrap_or(forward);
        Ray { origin: self.eye(), direction: direction.map(I2F30::from_bits) }
    }

    /// Where a point of the world lies on the display: for labels, and for marks drawn over the
    /// picture. `None` if it is before the near plane or beyond the far plane, or more than 1,024
    /// pixels from the viewport's middle along x or y. It may lie outside the viewport.
    ///
    /// It is within 2<sup>-15</sup> pixels of exact, and its depth within 2<sup>-28</sup>. A label
    /// is hidden where the depth buffer has more than that at its pixel.
    #[must_use]
    pub fn place_on_screen(&self, point: Vec3) -> Option<ScreenPlace> {
        // In Q46: each product is below 2^62.
        let [x, y, z] = self
            .axes()
            .map(|axis| Float::new(point.along(&axis).wrapping_sub(self.eye().along(&axis)), -46));
        let [near, far] = self.projection().range();
        if z.is_below(near) || far.is_below(z) {
            return None;
        }
        let per_w = if P::IS_PARALLEL { Float::new(1, 0) } else { z.reciprocal() };
        let pixels = self.pixels_per_unit().times(per_w);
        let viewport = self.viewport();
        let place = |c: Float, corner: i32, side: u32| {
            // In 65,536ths: below 2^31, as the guard band has 2^10 pixels.
            let c = c.times(pixels).in_units_of(-16);
            let middle = (2 * corner + side.cast_signed()) << 15;
            (c.unsigned_abs() <= 1 << (GUARD_BITS + 16)).then(|| I16F16::from_bits(c + middle))
        };
        let depth = self.projection().depth_at(z).in_units_of(-31).cast_unsigned();
        Some(ScreenPlace {
            x: place(x, viewport.top_left.x, viewport.size.width)?,
            y: place(y, viewport.top_left.y, viewport.size.height)?,
            depth: U0F32::from_bits(if depth < (1 << 31) - 1 { depth << 1 } else { u32::MAX }),
        })
    }

    /// The length on the screen of a unit at w = 1.
    pub(super) fn pixels_per_unit(&self) -> Float {
        let [across, deep] = self.projection().magnification(self.viewport().size.height);
        if P::IS_PARALLEL { across } else { across.times(deep.reciprocal()) }
    }
}

impl Ray {
    /// The point a way from its origin, in units. It is rounded to 2<sup>-16</sup> units, and
    /// saturates.
    #[must_use]
    pub fn at(&self, way: Scalar) -> Vec3 {
        let origin = self.origin.to_bits();
        Vec3::from_bits([0, 1, 2].map(|i| {
            let along = i64::from(self.direction[i].to_bits()) * i64::from(way.to_bits());
            origin[i].saturating_add(((along + (1 << 29)) >> 30) as i32)
        }))
    }

    /// Where it meets a plane, from either side: the place of the ground that a finger points at.
    /// `None` if the plane is behind it or parallel to it, or if the place is out of range.
    ///
    /// With s, the sine of the angle between both, it is within 2<sup>-15</sup> / s units, and
    /// 2<sup>-26</sup> / s of its distance.
    #[must_use]
    pub fn meets(&self, plane: &Plane) -> Option<Vec3> {
        let direction = self.direction.map(I2F30::to_bits);
        let normal = plane.normal.to_bits();
        let slope: i64 = (0..3).map(|i| i64::from(normal[i]) * i64::from(direction[i])).sum();
        let origin = self.origin.to_bits();
        let height = (0..3).fold(Float::new(plane.offset.to_bits().into(), -16), |sum, i| {
            sum.plus(Float::new(i64::from(normal[i]) * i64::from(origin[i]), -32))
        });
        // The height over the plane falls by the slope for each unit of the way.
        let (toward, height) = if slope > 0 {
            (Float::new(slope, -46), height.negative())
        } else {
            (Float::new(-slope, -46), height)
        };
        if slope == 0 || height.mantissa < 0 {
            return None;
        }
        let way = height.times(toward.reciprocal());
        let mut place = [0; 3];
        for (i, place) in place.iter_mut().enumerate() {
            let c = Float::new(direction[i].into(), -30).times(way).in_units_of(-16);
            // It saturates where it does not fit.
            if c == i32::MAX || c == i32::MIN {
                return None;
            }
            *place = origin[i].checked_add(c)?;
        }
        Some(Vec3::from_bits(place))
    }
}
