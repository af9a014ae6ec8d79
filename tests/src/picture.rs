//! A picture with colour and depth, drawn by any shader into a frame of any part of the display.

use embedded_graphics::primitives::{PointsIter, Rectangle};
use rasterizer::{
    camera::Camera,
    geometry::{Projection, ScreenVertex},
    mesh::Mesh,
    numbers::S8,
    output::{Frame, StoredColor, StoredDepth},
    scene::Object,
    shade::{OnScreen, Shader},
};

/// The pixels of a part of the display and their stored depth, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture<C, D> {
    /// The part of the display.
    pub area: Rectangle,
    /// The pixels' colours.
    pub color: Vec<C>,
    /// The pixels' stored depths.
    pub depth: Vec<D>,
}

impl<C: StoredColor, D: StoredDepth> Picture<C, D> {
    /// A picture in which every pixel is background.
    #[must_use]
    pub fn empty(area: Rectangle, background: C) -> Self {
        let pixels = area.size.width as usize * area.size.height as usize;
        Self { area, color: vec![background; pixels], depth: vec![D::ZERO; pixels] }
    }

    /// Draws an object over the picture.
    ///
    /// # Panics
    ///
    /// Panics if the object cannot be drawn.
    pub fn draw<P: Projection, Sh: Shader<Color = C>>(
        &mut self,
        mesh: &Mesh<'_>,
        shader: Sh,
        camera: &Camera<P>,
    ) {
        let mut storage = vec![ScreenVertex::<S8, D, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
        let frame = Frame::new(&mut self.color, &mut self.depth, self.area);
        let mut frame = frame.expect("the buffers fit the area");
        let drawn = Object::new(mesh, shader).draw(camera, &mut storage, &mut frame);
        assert_eq!(drawn, Ok(()));
    }

    /// The picture of `area`: the pixels that both have, and background elsewhere.
    #[must_use]
    pub fn crop(&self, area: Rectangle, background: C) -> Self {
        let mut cropped = Self::empty(area, background);
        let common = area.intersection(&self.area);
        let index = |of: &Rectangle, x: i32, y: i32| {
            (y - of.top_left.y) as usize * of.size.width as usize + (x - of.top_left.x) as usize
        };
        for point in common.points() {
            let (from, to) = (index(&self.area, point.x, point.y), index(&area, point.x, point.y));
            cropped.color[to] = self.color[from];
            cropped.depth[to] = self.depth[from];
        }
        cropped
    }
}
