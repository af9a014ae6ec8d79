//! An object and the camera that sees it, as a shader needs them.

use super::{Pose, Projection};
use crate::{
    camera::{Camera, Distance},
    mesh::Mesh,
    numbers::Vec3,
};

/// An object and the camera that sees it: what a shader is prepared with, once per frame.
///
/// All but the mesh is in world space. It knows the kind of projection by its values, not by a
/// type, so that a shader has no type parameter for it.
#[derive(Clone, Copy, Debug)]
pub struct ObjectView<'a> {
    mesh: &'a Mesh<'a>,
    pose: &'a Pose,
    axes: &'a [[i32; 3]; 3],
    viewer: Viewer,
    near: Distance,
}

/// Where the viewer is, in world space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Viewer {
    /// At a point: the eye of a perspective camera.
    At(Vec3),
    /// So far away that all points see the viewer in the same direction: a parallel projection. The
    /// direction towards the viewer has length one and is in Q30.
    Toward([i32; 3]),
}

impl<'a> ObjectView<'a> {
    /// A mesh in a pose, as this camera sees it.
    #[inline(always)]
    #[must_use]
    pub fn new<P: Projection>(mesh: &'a Mesh<'a>, pose: &'a Pose, camera: &'a Camera<P>) -> Self {
        let axes = camera.axes();
        let viewer = if P::IS_PARALLEL {
            let [x, y, z] = axes[2];
            Viewer::Toward([-x, -y, -z])
        } else {
            Viewer::At(camera.eye())
        };
        Self { mesh, pose, axes, viewer, near: camera.projection().near_distance() }
    }

    /// The object's mesh. Its tables have the scale and the offset of positions.
    #[must_use]
    pub const fn mesh(&self) -> &'a Mesh<'a> {
        self.mesh
    }

    /// Where the object stands.
    #[must_use]
    pub const fn pose(&self) -> &'a Pose {
        self.pose
    }

    /// Where the viewer is, in world space.
    #[must_use]
    pub const fn viewer(&self) -> Viewer {
        self.viewer
    }

    /// The camera's directions right, down and forward, in world space: unit vectors in Q30.
    #[must_use]
    pub const fn axes(&self) -> &'a [[i32; 3]; 3] {
        self.axes
    }

    /// The same directions in object space.
    #[must_use]
    pub fn object_axes(&self) -> [[i32; 3]; 3] {
        self.axes.map(|axis| self.pose.rotation.turn_back(&axis))
    }

    /// The distance of the near plane in world units. 1 / w is counted in it: a vertex at distance
    /// w carries near / w. In a parallel projection w is the near distance everywhere.
    #[must_use]
    pub const fn near(&self) -> Distance {
        self.near
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::{geometry::Point, geometry::Size, primitives::Rectangle};

    use super::*;
    use crate::{
        camera::{Orthographic, Perspective},
        mesh::{Material, Positions, Tables, Triangles},
        numbers::{Rotation, Turn},
    };

    static MESH: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]]),
        triangles: Triangles::U8(&[[0, 1, 2]]),
        materials: &[Material::new([255, 160, 0], 1)],
        ..Tables::EMPTY
    });

    #[test]
    fn a_viewer_is_at_the_eye_or_far_away_behind_the_camera() {
        let screen = Rectangle::new(Point::zero(), Size::new(32, 32));
        let [near, far] = [Distance::lit("0.5"), Distance::lit("10")];
        let eye = Vec3::lit("3", "0", "0");
        let pose = Pose::rotated(Rotation::about_z(Turn::QUARTER));
        let lens = Perspective::new(Turn::degrees(60), near, far).unwrap();
        let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, screen).unwrap();
        let view = ObjectView::new(&MESH, &pose, &camera);
        assert_eq!((view.viewer(), view.near()), (Viewer::At(eye), near));
        let lens = Orthographic::new(Distance::ONE, near, far).unwrap();
        let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, screen).unwrap();
        let view = ObjectView::new(&MESH, &pose, &camera);
        let Viewer::Toward(toward) = view.viewer() else { panic!("a parallel projection") };
        // Unit vectors are within 2^-28.
        let close = |got: [i32; 3], want: [i32; 3]| {
            got.iter().zip(want).all(|(got, want)| (got - want).abs() <= 16)
        };
        const ONE: i32 = 1 << 30;
        assert!(close(toward, [ONE, 0, 0]), "{toward:?}");
        assert_eq!(view.near(), near);
        // The camera's right is -z, its down -y, its forward -x. The pose takes the object's x to
        // the world's y, and its y to the world's -x.
        let [right, down, forward] = view.object_axes();
        assert!(close(right, [0, 0, -ONE]), "{right:?}");
        assert!(close(down, [-ONE, 0, 0]), "{down:?}");
        assert!(close(forward, [0, ONE, 0]), "{forward:?}");
    }
}
