//! Poses that turn an object's face to the camera: billboards.

use super::{Pose, Projection};
use crate::{
    camera::{Camera, Distance},
    numbers::{Float, Rotation, Vec3},
};

impl Pose {
    /// As modelled, at a point, turned as the camera is: the model's x axis runs to the right on
    /// the screen, its y axis upwards, and its z axis towards the camera. For billboards: a flat
    /// model, such as a [`Card`](crate::mesh::Card), is parallel to the screen. All of it has the
    /// depth of its point, so that a texture on it needs no division
    /// ([`Affine`](crate::attribute::Affine)), and is a rectangle of the screen.
    ///
    /// The camera's axes are rounded: with 16 bits of depth the corners are within one unit of the
    /// point's.
    #[must_use]
    pub fn facing<P>(camera: &Camera<P>, at: Vec3) -> Self {
        let [right, down, forward] = camera.axes();
        let row = |i: usize| [right[i], -down[i], -forward[i]];
        Self::rotated(Rotation::from_row_bits([row(0), row(1), row(2)])).at(at)
    }

    /// The same pose in the size in which a unit of the model is as many pixels on the screen,
    /// where it is as far from the camera as its point: for labels and icons that do not become
    /// smaller with the distance, and for stars.
    ///
    /// The scale is rounded to a 65,536th. That of a point before the near plane is as at the near
    /// plane; it saturates at the largest scale.
    #[must_use]
    pub fn in_pixels<P: Projection>(self, camera: &Camera<P>, pixels: Distance) -> Self {
        let projection = camera.projection();
        let [across, deep] = projection.magnification(camera.viewport().size.height);
        // w is 1 in a parallel projection, and counts in near distances in the other one.
        let w = if P::IS_PARALLEL {
            Float::new(1, 0)
        } else {
            let forward = &camera.axes()[2];
            let way = self.translation.along(forward) - camera.eye().along(forward);
            let near = i64::from(projection.near_distance().to_bits()) << 30;
            Float::new(way.max(near), -46).times(deep)
        };
        let scale = w.times(across.reciprocal()).times(Float::from_unsigned(pixels));
        Self { scale: Distance::from_bits(scale.in_units_of(-16).cast_unsigned()), ..self }
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::{
        geometry::{Point, Size},
        pixelcolor::Rgb565,
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        geometry::ScreenVertex,
        mesh::{Card, Mesh},
        numbers::{S8, Scalar, Turn},
        scene::Object,
        shade::Unlit,
    };

    static CARD: Mesh<'static> = Card::<6, 9>::STANDING;

    /// The corners of a card on the screen in 256ths of a pixel, and their depths.
    fn corners<P: Projection>(camera: &Camera<P>, pose: Pose) -> [([i32; 2], u16); 4] {
        let mut vertices = [ScreenVertex::<S8, u16, _>::EMPTY; 4];
        let card = Object::new(&CARD, Unlit::<Rgb565>::new()).posed(pose);
        let _ = card.project(camera, &mut vertices).unwrap();
        vertices.map(|vertex| (vertex.position().unwrap(), vertex.depth()))
    }

    /// Upright rectangles of 30 by 45 pixels above the point, of one depth, from any direction.
    fn is_a_rectangle<P: Projection>(lens: P) {
        let viewport = Rectangle::new(Point::new(5, 3), Size::new(200, 150));
        for degrees in (0..360).step_by(13) {
            let eye =
                Rotation::about_y(Turn::degrees(degrees)) * const { Vec3::lit("1", "2", "6") };
            let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, viewport).unwrap();
            let place = Vec3::new(Scalar::lit("0.4"), Scalar::lit("-0.3"), Scalar::lit("0.7"));
            let pose = Pose::facing(&camera, place).in_pixels(&camera, Distance::lit("5"));
            let [(a, depth), (b, _), (c, _), (d, _)] = corners(&camera, pose);
            // The scale is rounded to some thousandths of itself, and each end is snapped.
            let close = |got: i32, want: i32| (got - want).abs() <= 2 + want / 256;
            let point = corners(&camera, Pose { scale: Distance::ZERO, ..pose })[0].0;
            assert!(close(b[0] - a[0], 30 * 256) && close(a[1] - d[1], 45 * 256), "{a:?} {c:?}");
            assert!((a[0] + b[0] - 2 * point[0]).abs() <= 2 && (a[1] - point[1]).abs() <= 1);
            for (corner, want) in [(b, [c[0], a[1]]), (d, [a[0], c[1]])] {
                assert!((0..2).all(|i| (corner[i] - want[i]).abs() <= 1), "{corner:?} {want:?}");
            }
            for (_, other) in corners(&camera, pose) {
                assert!(other.abs_diff(depth) <= 1, "{other} {depth}");
            }
        }
    }

    #[test]
    fn cards_are_rectangles_of_the_screen() {
        let [near, far] = [Distance::lit("0.5"), Distance::lit("50")];
        is_a_rectangle(Perspective::new(Turn::degrees(50), near, far).unwrap());
        is_a_rectangle(Orthographic::new(Distance::lit("6"), near, far).unwrap());
    }
}
