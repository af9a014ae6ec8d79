//! A mesh in front of a camera, and the number of its layers over each pixel.

use std::convert::Infallible;

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::Rgb888,
    primitives::Rectangle,
};
use host_tools::{check::screen_triangles, reference::draw_screen};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic},
    geometry::{CullBack, CullFront, Culling, Pose, Projection, ScreenVertex},
    mesh::Mesh,
    numbers::{Rotation, Subpixel, Vec3},
    output::Direct,
    scene::{Mode, Modes, Object, Projected, Vertices},
    shade::{OnScreen, Shader, Unlit},
};

use crate::Counter;

/// A vertex as [`Scene`] projects it.
pub type Placed<S> = ScreenVertex<S, NoDepth, [u16; 0]>;

/// A rectangle of the display.
#[must_use]
pub const fn area(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
    Rectangle::new(Point::new(x, y), Size::new(width, height))
}

/// A camera on the z axis that shows one unit as one pixel: with a quantum of 2<sup>-S</sup> units,
/// positions are sub-pixels from the viewport's middle, y upwards.
///
/// # Panics
///
/// Panics if the viewport is too large.
#[must_use]
pub fn pixel_camera(viewport: Rectangle) -> Camera<Orthographic> {
    let height = Distance::from_num(viewport.size.height);
    let lens = Orthographic::new(height, Distance::ONE, Distance::lit("100"))
        .expect("the distances are in order");
    Camera::at(Vec3::lit("0", "0", "50"), Rotation::IDENTITY, lens, viewport)
        .expect("the viewport is not too large")
}

/// A mesh in front of a camera.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, P> {
    /// The mesh.
    pub mesh: &'a Mesh<'a>,
    /// The mesh's pose.
    pub pose: Pose,
    /// The camera.
    pub camera: Camera<P>,
}

impl<'a, P: Projection> Scene<'a, P> {
    /// The mesh in the identity pose.
    #[must_use]
    pub const fn new(mesh: &'a Mesh<'a>, camera: Camera<P>) -> Self {
        Self { mesh, pose: Pose::IDENTITY, camera }
    }

    fn object<K: Culling + Default>(&self) -> Object<'a, Unlit<Rgb888>, Modes<K>> {
        Object::new(self.mesh, Unlit::new()).posed(self.pose).culled(K::default())
    }

    /// Whether the object fits the number range of `S`.
    #[must_use]
    pub fn is_accepted<S: Subpixel>(&self) -> bool {
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        self.object::<CullBack>().project(&self.camera, &mut storage).is_ok()
    }

    /// Counts how often each pixel of `part` is drawn.
    ///
    /// # Panics
    ///
    /// Panics if the object cannot be drawn, or is drawn outside `part`.
    #[must_use]
    pub fn count<S: Subpixel, K: Culling + Default>(&self, part: Rectangle) -> Counter<Rgb888> {
        let mut counter = Counter::new(part);
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        let drawn =
            self.object::<K>().draw(&self.camera, &mut storage, &mut Direct::new(&mut counter));
        assert_eq!(drawn, Ok(()));
        counter
    }

    /// Returns for each pixel of `part` how many more front faces than back faces cover it.
    ///
    /// Only the boundary of the surface decides this number; rounding of the vertices in between
    /// does not change it, because triangles traverse each inner edge once in both directions.
    #[must_use]
    pub fn net<S: Subpixel>(&self, part: Rectangle) -> Vec<i32> {
        let [front, back] = [self.count::<S, CullBack>(part), self.count::<S, CullFront>(part)];
        let pairs = front.counts().iter().zip(back.counts());
        pairs.map(|(&front, &back)| front as i32 - back as i32).collect()
    }

    /// Returns where the vertices lie, in pixels from the display's corner; `None` for those that
    /// are clipped.
    ///
    /// # Panics
    ///
    /// Panics if the object cannot be drawn.
    #[must_use]
    pub fn vertices<S: Subpixel>(&self) -> Vec<Option<[f64; 2]>> {
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        let projected = self.object::<CullBack>().project(&self.camera, &mut storage);
        places(projected.expect("the object can be drawn").vertices())
    }

    /// Counts how many triangles cover each pixel of `part` in the f64 reference, with the vertices
    /// where the core places them.
    ///
    /// # Panics
    ///
    /// Panics if the object cannot be drawn.
    #[must_use]
    pub fn reference<S: Subpixel, K: Culling + Default>(&self, part: Rectangle) -> Vec<u32> {
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        let projected = self.object::<K>().project(&self.camera, &mut storage);
        let projected = projected.expect("the object can be drawn");
        let triangles = screen_triangles(&projected, part.top_left, |_, _| (1.0, []));
        let [width, height] = [part.size.width as usize, part.size.height as usize];
        let picture = draw_screen(&triangles, (width, height), |_| Some([0.0; 3]));
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        places.map(|(x, y)| picture.layers(x, y) as u32).collect()
    }
}

/// Whether each vertex of a mesh is a corner of a triangle that is drawn.
///
/// # Panics
///
/// Panics if `seen` is of a larger mesh.
#[must_use]
pub fn front_vertices<V, P, Sh, M>(seen: &Projected<'_, V, P, Sh, M>, mesh: &Mesh<'_>) -> Vec<bool>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    let mut is_front = vec![false; mesh.vertex_count()];
    let Ok(()) = seen.for_each_triangle(|index, _| {
        let corners = mesh.tables().triangles.get(index).expect("a triangle of the mesh");
        corners.iter().for_each(|&corner| is_front[corner] = true);
        Ok::<(), Infallible>(())
    });
    is_front
}

/// Where vertices lie, in pixels from the display's corner; `None` for those that are clipped.
#[must_use]
pub fn places<S: Subpixel>(vertices: &[Placed<S>]) -> Vec<Option<[f64; 2]>> {
    vertices.iter().map(|v| v.position().map(to_pixels::<S>)).collect()
}

fn to_pixels<S: Subpixel>(position: [i32; 2]) -> [f64; 2] {
    position.map(|c| f64::from(c) / f64::from(1 << S::BITS))
}
