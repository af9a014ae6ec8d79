//! A mesh before a camera, and how many layers of it lie over each pixel.

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::Rgb888,
    primitives::Rectangle,
};
use host_tools::{check::screen_triangles, reference::draw_screen};
use rasterizer::{
    camera::{Camera, Distance, Orthographic},
    geometry::{CullBack, CullFront, Culling, NoDepth, Pose, Projection, ScreenVertex, Subpixel},
    mesh::Mesh,
    numbers::{Rotation, Vec3},
    scene::Object,
    shade::Unlit,
    target::Direct,
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
/// If there is no such viewport.
#[must_use]
pub fn pixel_camera(viewport: Rectangle) -> Camera<Orthographic> {
    let height = Distance::from_num(viewport.size.height);
    let lens = Orthographic::new(height, Distance::ONE, Distance::lit("100"))
        .expect("the distances are in order");
    Camera::at(Vec3::lit("0", "0", "50"), Rotation::IDENTITY, lens, viewport)
        .expect("the viewport is not too large")
}

/// A mesh before a camera.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, P> {
    /// What is seen.
    pub mesh: &'a Mesh<'a>,
    /// Where it stands.
    pub pose: Pose,
    /// Who sees it.
    pub camera: Camera<P>,
}

impl<'a, P: Projection> Scene<'a, P> {
    /// The mesh as it was built.
    #[must_use]
    pub const fn new(mesh: &'a Mesh<'a>, camera: Camera<P>) -> Self {
        Self { mesh, pose: Pose::IDENTITY, camera }
    }

    fn object<K: Culling>(&self) -> Object<'a, Unlit<Rgb888>, K> {
        Object::new(self.mesh, Unlit::new()).posed(self.pose).culled(K::default())
    }

    /// How often each pixel of a part of the display is drawn.
    ///
    /// # Panics
    ///
    /// If the object cannot be drawn, or is drawn outside.
    #[must_use]
    pub fn count<S: Subpixel, K: Culling>(&self, part: Rectangle) -> Counter<Rgb888> {
        let mut counter = Counter::new(part);
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        let drawn =
            self.object::<K>().draw(&self.camera, &mut storage, &mut Direct::new(&mut counter));
        assert_eq!(drawn, Ok(()));
        counter
    }

    /// How many more layers of front faces than of back faces lie over each pixel of a part of the
    /// display.
    ///
    /// The boundary of a surface alone decides it, whatever rounding does to the vertices in
    /// between: each inner edge is run along once in both directions.
    #[must_use]
    pub fn net<S: Subpixel>(&self, part: Rectangle) -> Vec<i32> {
        let [front, back] = [self.count::<S, CullBack>(part), self.count::<S, CullFront>(part)];
        let pairs = front.counts().iter().zip(back.counts());
        pairs.map(|(&front, &back)| front as i32 - back as i32).collect()
    }

    /// Where its vertices lie, in pixels from the display's corner; nothing for those that are
    /// clipped.
    ///
    /// # Panics
    ///
    /// If the object cannot be drawn.
    #[must_use]
    pub fn vertices<S: Subpixel>(&self) -> Vec<Option<[f64; 2]>> {
        let mut storage = vec![Placed::<S>::EMPTY; self.mesh.vertex_count()];
        let projected = self.object::<CullBack>().project(&self.camera, &mut storage);
        let vertices = projected.expect("the object can be drawn").vertices();
        vertices.iter().map(|v| v.position().map(to_pixels::<S>)).collect()
    }

    /// How many triangles cover each pixel of a part of the display by the f64 reference, on the
    /// vertices as the core places them.
    ///
    /// # Panics
    ///
    /// If the object cannot be drawn.
    #[must_use]
    pub fn reference<S: Subpixel, K: Culling>(&self, part: Rectangle) -> Vec<u32> {
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

fn to_pixels<S: Subpixel>(position: [i32; 2]) -> [f64; 2] {
    position.map(|c| f64::from(c) / f64::from(1 << S::BITS))
}
