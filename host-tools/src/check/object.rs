//! Any object of the core, with any shader, against a definition of that shader.

use std::{
    convert::Infallible,
    time::{Duration, Instant},
};

use embedded_graphics_core::{
    geometry::Point,
    pixelcolor::{Rgb888, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::Interpolate,
    geometry::{Projection, ScreenVertex},
    numbers::Subpixel,
    output::{Blending, Frame, FrameError, StoredColor, StoredDepth},
    scene::{Mode, Order, Projected, Vertices},
    shade::{OnScreen, Shader},
};

use super::{
    DefinedDepth,
    compare::{self, Deviation, Difference},
};
use crate::reference::{
    DepthFormat, Picture, Sample, ScreenTriangle, ScreenVertex as ReferenceVertex, draw_screen,
};

/// A picture by the fixed-point core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixedPicture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The pixels, row by row.
    pub pixels: Vec<Pixel>,
}

impl FixedPicture {
    /// Of the colours and the depths of a frame, row by row.
    pub(super) fn new<C: Copy + Into<Rgb888>, D: Copy + Into<u32>>(
        size: [u32; 2],
        colors: &[C],
        depths: &[D],
    ) -> Self {
        let pixel = |(&color, &depth): (&C, &D)| {
            let color: Rgb888 = color.into();
            Pixel { color: [color.r(), color.g(), color.b()], depth: depth.into() }
        };
        Self { size, pixels: colors.iter().zip(depths).map(pixel).collect() }
    }

    /// The colour of the pixel in this column and row.
    pub(super) fn color(&self, [x, y]: [usize; 2]) -> [f64; 3] {
        self.pixels[y * self.size[0] as usize + x].color.map(f64::from)
    }
}

/// A pixel by the fixed-point core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel {
    /// Its colour in 8-bit steps; black where nothing is drawn.
    pub color: [u8; 3],
    /// Its stored depth; 0 where nothing is drawn.
    pub depth: u32,
}

/// An object drawn by the core, and by the reference on the core's own vertices.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The core's picture.
    pub fixed: FixedPicture,
    /// The reference's picture, with depth from 0 to 1.
    pub reference: Picture,
    /// How the core's picture stores depth.
    depth: DepthFormat,
}

impl Judged {
    /// How far the core's picture is off.
    #[must_use]
    pub fn deviation(&self) -> Deviation {
        compare::compare(&self.fixed, &self.reference, self.depth)
    }

    /// How the pixel (x, y) differs.
    ///
    /// # Panics
    ///
    /// Panics if the pixel lies outside the picture.
    #[must_use]
    pub fn difference(&self, x: usize, y: usize) -> Difference {
        compare::difference(&self.fixed, [x, y], self.depth, &self.reference)
    }
}

/// Draws a projected object into a picture of `area`, by the core and by the reference.
///
/// The closures define the shader. `varyings` returns what the reference interpolates, from a
/// triangle's index in the mesh and a corner's stored varyings; there may be more or fewer than
/// those. `shade` returns the colour of a sample (red, green and blue in 0..=255), whose triangle
/// is that index and whose pixel counts from the corner of `area`; or `None` to discard it.
///
/// # Errors
///
/// Returns an error if a frame cannot have that area.
pub fn judge<const N: usize, V, P, Sh, M, O>(
    projected: &Projected<'_, V, P, Sh, M, O>,
    area: Rectangle,
    varyings: impl Fn(usize, OnScreen<Sh>) -> [f64; N],
    shade: impl Fn(Sample<N>) -> Option<[f64; 3]>,
) -> Result<Judged, FrameError>
where
    for<'f> M::Blending: Blending<Frame<'f, Sh::Color, &'f mut [V::Depth]>>,
    V: Vertices<OnScreen<Sh>, Depth: DefinedDepth>,
    P: Projection,
    Sh: Shader<Color: StoredColor + From<Rgb888> + Into<Rgb888>>,
    M: Mode,
    O: Order,
{
    let (fixed, _) = draw(projected, area)?;
    let triangles = screen_triangles(projected, area.top_left, |triangle, corner| {
        (corner.depth().depth(), varyings(triangle, corner.varyings()))
    });
    let size = (area.size.width as usize, area.size.height as usize);
    let reference = draw_screen(&triangles, size, shade);
    Ok(Judged { fixed, reference, depth: V::Depth::DEFINITION })
}

/// Draws a projected object by the core. Returns the picture of `area` and how long drawing takes.
fn draw<V, P, Sh, M, O>(
    projected: &Projected<'_, V, P, Sh, M, O>,
    area: Rectangle,
) -> Result<(FixedPicture, Duration), FrameError>
where
    for<'f> M::Blending: Blending<Frame<'f, Sh::Color, &'f mut [V::Depth]>>,
    V: Vertices<OnScreen<Sh>, Depth: DefinedDepth>,
    P: Projection,
    Sh: Shader<Color: StoredColor + From<Rgb888> + Into<Rgb888>>,
    M: Mode,
    O: Order,
{
    let drawn = draw_colors(projected, area)?;
    Ok((drawn.picture(area), drawn.time))
}

/// What the core has drawn.
pub(super) struct Drawn<C, D> {
    /// The colours, row by row.
    pub(super) color: Vec<C>,
    depth: Vec<D>,
    /// How long it takes.
    pub(super) time: Duration,
}

impl<C: Copy + Into<Rgb888>, D: Copy + Into<u32>> Drawn<C, D> {
    /// The picture of the area.
    pub(super) fn picture(&self, area: Rectangle) -> FixedPicture {
        FixedPicture::new([area.size.width, area.size.height], &self.color, &self.depth)
    }
}

/// Draws a projected object by the core into the colours of its shader.
pub(super) fn draw_colors<V, P, Sh, M, O>(
    projected: &Projected<'_, V, P, Sh, M, O>,
    area: Rectangle,
) -> Result<Drawn<Sh::Color, V::Depth>, FrameError>
where
    for<'f> M::Blending: Blending<Frame<'f, Sh::Color, &'f mut [V::Depth]>>,
    V: Vertices<OnScreen<Sh>, Depth: StoredDepth>,
    P: Projection,
    Sh: Shader<Color: StoredColor + From<Rgb888>>,
    M: Mode,
    O: Order,
{
    let pixels = area.size.width as usize * area.size.height as usize;
    let mut color = vec![Sh::Color::from(Rgb888::BLACK); pixels];
    let mut depth = vec![V::Depth::ZERO; pixels];
    let start = Instant::now();
    let mut frame = Frame::new(&mut color, &mut depth, area)?;
    let Ok(()) = projected.draw(&mut frame);
    Ok(Drawn { time: start.elapsed(), color, depth })
}

/// The triangles that the core draws of a projected object, for the reference.
///
/// Positions are in pixels from `origin`, a place on the display. `corner` returns the depth and
/// the varyings of a corner, from the triangle's index in the mesh, which becomes its number.
pub fn screen_triangles<const N: usize, V, P, Sh, M, O>(
    projected: &Projected<'_, V, P, Sh, M, O>,
    origin: Point,
    mut corner: impl FnMut(usize, &ScreenVertex<V::Subpixel, V::Depth, OnScreen<Sh>>) -> (f64, [f64; N]),
) -> Vec<ScreenTriangle<N>>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
    O: Order,
{
    let mut triangles = Vec::new();
    let Ok(()) = projected.for_each_triangle(|number, [a, b, c]| {
        let mut vertex = |vertex: &ScreenVertex<_, _, _>| {
            let position = vertex.position().expect("the corners of a clipped triangle have one");
            let (depth, varyings) = corner(number, vertex);
            reference_vertex(to_pixels::<V::Subpixel>(position), origin, depth, varyings)
        };
        // Not by `map`, of which each object, shader, camera and precision would have its own copy.
        triangles.push(ScreenTriangle { vertices: [vertex(a), vertex(b), vertex(c)], number });
        Ok::<(), Infallible>(())
    });
    triangles
}

/// A vertex at a place in pixels, which counts from `origin`.
fn reference_vertex<const N: usize>(
    [x, y]: [f64; 2],
    origin: Point,
    depth: f64,
    varyings: [f64; N],
) -> ReferenceVertex<N> {
    let [x, y] = [x - f64::from(origin.x), y - f64::from(origin.y)];
    ReferenceVertex { x, y, depth, varyings }
}

/// A position on the screen in pixels.
pub(super) fn to_pixels<S: Subpixel>(position: [i32; 2]) -> [f64; 2] {
    position.map(|c| f64::from(c) / f64::from(1 << S::BITS))
}
