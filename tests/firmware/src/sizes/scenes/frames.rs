//! The frames of a scene: what is seen in each, and the memory and the loop that draw one.
//!
//! All use of the rasterizer's targets is here: the scenes need no change when a target does.

use core::{convert::Infallible, hint::black_box};

use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::{Rgb565, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{DepthFormat, Interpolate, NoDepth, Varyings},
    camera::Camera,
    geometry::{Pose, Projection, ScreenVertex},
    mesh::Lines,
    numbers::{Rotation, Subpixel, Turn, Vec3},
    output::{self, Blending, Direct, Frame, FrameDepth, Replace, StoredDepth},
    scene::{Mode, Object, ProjectedLines},
    shade::Shader,
};

use crate::sizes::Display;

/// Rows of all pictures.
pub(super) const HEIGHT: u32 = 240;
/// Rows of a band.
pub(super) const ROWS: u32 = 16;

/// What changes from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct View {
    /// Where the camera stands; it looks along -z.
    pub(super) eye: Vec3,
    /// How far the objects have turned.
    pub(super) turn: Turn,
}

impl View {
    const fn new(distance: &str, degrees: u32) -> Self {
        Self { eye: Vec3::lit("0", "0", distance), turn: Turn::degrees(degrees) }
    }

    /// The pose of the objects.
    pub(super) fn pose(&self) -> Pose {
        Pose::rotated(Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(self.turn))
    }
}

/// As a whole, closer than the near plane allows, from inside, and from afar: together they take
/// every path of the rasterizer, and the deepest stack.
const VIEWS: [View; 4] =
    [View::new("4", 40), View::new("1.05", 85), View::new("0.05", 130), View::new("99", 175)];

/// Draws a frame for each view. The compiler cannot see them, like a program's input.
pub(super) fn for_each_view(mut draw: impl FnMut(&View) -> Option<()>) -> Option<()> {
    for view in black_box(&VIEWS) {
        draw(view)?;
    }
    Some(())
}

/// A picture of `width` columns.
pub(super) const fn picture(width: u32) -> Rectangle {
    Rectangle::new(Point::zero(), Size::new(width, HEIGHT))
}

/// The memory of one object in one picture: a band of `PIXELS` pixels, and `VERTICES` vertices.
#[derive(Debug)]
pub struct Bands<S, D, V, const PIXELS: usize, const VERTICES: usize> {
    color: [Rgb565; PIXELS],
    depth: [D; PIXELS],
    vertices: [ScreenVertex<S, D, V>; VERTICES],
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate, const PIXELS: usize, const VERTICES: usize>
    Bands<S, D, V, PIXELS, VERTICES>
{
    pub(super) const EMPTY: Self = Self {
        color: [Rgb565::BLACK; PIXELS],
        depth: [D::ZERO; PIXELS],
        vertices: [ScreenVertex::EMPTY; VERTICES],
    };

    pub(super) const PICTURE: Rectangle = picture(PIXELS as u32 / ROWS);
}

/// A blending for bands with this depth.
pub(super) trait OnBands<D: FrameDepth>:
    for<'f, 'd> Blending<Frame<'f, Rgb565, D::Buffer<'d>>>
{
}

impl<D: FrameDepth, B> OnBands<D> for B where
    B: for<'f, 'd> Blending<Frame<'f, Rgb565, D::Buffer<'d>>>
{
}

impl<S, D, V, const PIXELS: usize, const VERTICES: usize> Bands<S, D, V, PIXELS, VERTICES>
where
    S: Subpixel,
    D: StoredDepth,
    V: Interpolate,
{
    /// Projects the object's vertices once, and draws it into each band.
    pub(super) fn draw<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending: OnBands<D>>,
    >(
        &mut self,
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
    ) -> Option<()> {
        // By reference, as an object that is moved out of the result would be on the stack twice.
        let seen = object.project(camera, &mut self.vertices);
        let Ok(seen) = &seen else { return None };
        let mut bands = output::Bands::new(Self::PICTURE, &mut self.color, &mut self.depth).ok()?;
        bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band)).ok()
    }

    /// Draws the lines that the object does not hide. `fill` draws them all.
    pub(super) fn draw_lines<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending = Replace>,
    >(
        &mut self,
        lines: &Lines<'_>,
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
        fill: impl Fn(
            ProjectedLines<'_, '_, &[ScreenVertex<S, D, V>], P, Sh, M>,
            &mut Frame<'_, Rgb565, D::Buffer<'_>>,
        ) -> Result<(), Infallible>,
    ) -> Option<()> {
        let seen = object.project(camera, &mut self.vertices);
        let Ok(seen) = &seen else { return None };
        let mut bands = output::Bands::new(Self::PICTURE, &mut self.color, &mut self.depth).ok()?;
        bands
            .show(
                display,
                |band| band.clear_color(Rgb565::BLACK),
                |band| {
                    seen.draw_depth(band)?;
                    fill(seen.lines(lines), band)
                },
            )
            .ok()
    }

    /// Draws the object with its triangles sorted into the bands.
    pub(super) fn draw_binned<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending = Replace>,
    >(
        &mut self,
        bins: &mut [u32],
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
    ) -> Option<()> {
        let seen = object.project(camera, &mut self.vertices).ok()?;
        let seen = seen.binned(ROWS, bins).ok()?;
        let mut bands = output::Bands::new(Self::PICTURE, &mut self.color, &mut self.depth).ok()?;
        bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band)).ok()
    }
}

impl<S, V, const PIXELS: usize, const VERTICES: usize> Bands<S, NoDepth, V, PIXELS, VERTICES>
where
    S: Subpixel,
    V: Interpolate,
{
    /// The same without depth.
    pub(super) fn draw_without_depth<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending = Replace>,
    >(
        &mut self,
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
    ) -> Option<()> {
        // By reference, as an object that is moved out of the result would be on the stack twice.
        let seen = object.project(camera, &mut self.vertices);
        let Ok(seen) = &seen else { return None };
        let mut bands = output::Bands::without_depth(Self::PICTURE, &mut self.color).ok()?;
        bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band)).ok()
    }

    /// The same from back to front.
    pub(super) fn draw_sorted<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending: OnBands<NoDepth>>,
    >(
        &mut self,
        order: &mut [u32],
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
    ) -> Option<()> {
        let seen = object.project(camera, &mut self.vertices).ok()?.back_to_front(order);
        let Ok(seen) = &seen else { return None };
        let mut bands = output::Bands::without_depth(Self::PICTURE, &mut self.color).ok()?;
        bands.show(display, |band| band.clear_color(Rgb565::BLACK), |band| seen.draw(band)).ok()
    }

    /// The same straight onto the display, in the camera's viewport.
    pub(super) fn draw_directly<
        P: Projection,
        Sh: Shader<Color = Rgb565, Varyings: Varyings<OnScreen = V>>,
        M: Mode<Blending = Replace>,
    >(
        &mut self,
        object: &Object<'_, Sh, M>,
        camera: &Camera<P>,
        display: &mut Display,
    ) -> Option<()> {
        object.draw(camera, &mut self.vertices, &mut Direct::new(display)).ok()
    }
}
