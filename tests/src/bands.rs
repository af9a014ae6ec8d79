//! A ball in front of a camera, and its picture drawn in bands.

use std::convert::Infallible;

use embedded_graphics::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    pixelcolor::{PixelColor, Rgb888},
    primitives::{PointsIter, Rectangle},
};
use fixed::types::U16F16;
use rasterizer::{
    attribute::{FloatDepth, Interpolate as _, NoDepth},
    camera::{Camera, Distance, Perspective},
    mesh::{Material, MeshMaterial, MeshVertex},
    numbers::{Rotation, Scalar, Turn, Vec3},
    output::{Bands, Frame, FrameDepth},
    raster::Fragment,
    shade::{Level, Light, Shader},
};

use crate::{Surface, area, recorder::bounded};

/// The colour of pixels that no object covers.
pub const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);
/// A display whose corner is not the origin.
pub const DISPLAY: Rectangle = area(3, -2, 61, 47);
/// The display's height.
pub const ROWS: u32 = DISPLAY.size.height;

/// A shader with three varyings: the position is the colour.
#[derive(Clone, Copy, Debug)]
pub struct Position;

impl Shader for Position {
    type Color = Rgb888;
    type Varyings = [u16; 3];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 3] {
        vertex.position().map(|c| c as u16 ^ 0x8000)
    }

    fn pixel(&self, (): &(), (): &(), fragment: Fragment<[U16F16; 3]>) -> Rgb888 {
        let [red, green, blue] = fragment.varyings.map(|c| (c.to_bits() >> 24) as u8);
        Rgb888::new(red, green, blue)
    }
}

/// A light from the upper right, on the viewer's side.
#[must_use]
pub const fn light() -> Light {
    Light::new(Vec3::lit("1", "2", "3"), Level::lit("0.2"), Level::lit("0.8"))
}

/// A ball of radius 1 with 588 triangles.
#[must_use]
pub fn ball() -> Surface {
    Surface::ball(16_384, 7).scaled(-14).with_vertex_normals().colored([250, 220, 150])
}

/// Materials for a mesh of 588 triangles. Their runs begin and end anywhere in words of 32 bits,
/// and one run is empty.
pub const MATERIALS: [Material; 6] = [
    Material::new([250, 220, 150], 31),
    Material::new([20, 220, 150], 1),
    Material::new([250, 20, 150], 0),
    Material::new([250, 220, 15], 97),
    Material::new([120, 120, 250], 5),
    Material::new([220, 20, 10], 454),
];

/// A camera at this distance from the origin, slightly tilted.
///
/// # Panics
///
/// Panics if `z` is not a number.
#[must_use]
pub fn at(z: &str, viewport: Rectangle) -> Camera<Perspective> {
    // From inside the ball, a near plane this close keeps what lies beside the camera: more than
    // 1,024 pixels from the picture's middle.
    let near = if z < "1" { Distance::lit("0.004") } else { Distance::lit("0.25") };
    let lens = Perspective::new(Turn::degrees(70), near, Distance::lit("10")).unwrap();
    let eye = Vec3::new(Scalar::lit("0.1"), Scalar::lit("0.2"), z.parse().unwrap());
    Camera::at(eye, Rotation::about_x(-Turn::degrees(8)), lens, viewport).unwrap()
}

/// Camera distances: the whole ball is visible; the picture's edges cut it; the near plane cuts it;
/// from inside; from inside, with vertices beyond the guard band.
pub const EYES: [&str; 5] = ["3", "1.7", "1.2", "0.9", "0.18"];

/// A display that keeps its pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Screen<C> {
    /// The display's rectangle.
    pub area: Rectangle,
    /// Row by row; `None` for a pixel that has not been sent.
    pub pixels: Vec<Option<C>>,
}

impl<C: PixelColor> Screen<C> {
    /// A display that has received no pixel.
    #[must_use]
    pub fn new(area: Rectangle) -> Self {
        let pixels = vec![None; area.size.width as usize * area.size.height as usize];
        Self { area, pixels }
    }

    /// The places of the pixels that were sent and differ from the background.
    #[must_use]
    pub fn drawn(&self, background: C) -> Vec<Point> {
        let all = self.area.points().zip(&self.pixels);
        all.filter(|(_, pixel)| pixel.is_some_and(|pixel| pixel != background))
            .map(|(point, _)| point)
            .collect()
    }
}

impl<C> Dimensions for Screen<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Screen<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            let from_corner = point - self.area.top_left;
            let index =
                from_corner.y as usize * self.area.size.width as usize + from_corner.x as usize;
            self.pixels[index] = Some(color);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let mut colors = bounded(colors);
        let pixels =
            area.points().zip(colors.by_ref()).map(|(p, c)| Pixel(p, c)).collect::<Vec<_>>();
        assert_eq!(pixels.len(), area.size.width as usize * area.size.height as usize);
        assert!(colors.next().is_none(), "colours beyond {area:?}");
        self.draw_iter(pixels)
    }
}

/// A depth format, with bands that own their memory.
pub trait Depth: FrameDepth {
    /// Bands of `area`, each `rows` high.
    fn bands(area: Rectangle, rows: u32) -> OwnBands<Self>;
}

/// Bands whose memory lives as long as the program.
pub type OwnBands<D> = Bands<Vec<Rgb888>, Rgb888, <D as FrameDepth>::Buffer<'static>>;

fn memory<T: Clone>(area: Rectangle, rows: u32, value: T) -> Vec<T> {
    vec![value; (area.size.width * rows) as usize]
}

macro_rules! stored {
    ($depth:ty) => {
        impl Depth for $depth {
            fn bands(area: Rectangle, rows: u32) -> OwnBands<Self> {
                Bands::new(
                    area,
                    memory(area, rows, BACKGROUND),
                    memory(area, rows, Self::ZERO).leak(),
                )
                .unwrap()
            }
        }
    };
}
stored!(u16);
stored!(FloatDepth);
stored!(u32);

impl Depth for NoDepth {
    fn bands(area: Rectangle, rows: u32) -> OwnBands<Self> {
        Bands::without_depth(area, memory(area, rows, BACKGROUND)).unwrap()
    }
}

/// Draws [`DISPLAY`] in bands of `rows` rows and returns the picture.
///
/// # Panics
///
/// Panics if a pixel is not sent.
pub fn picture<D: Depth>(
    rows: u32,
    draw: impl FnMut(&mut Frame<'_, Rgb888, D::Buffer<'_>>) -> Result<(), Infallible>,
) -> Screen<Rgb888> {
    let mut screen = Screen::new(DISPLAY);
    let Ok(()) =
        D::bands(DISPLAY, rows).show(&mut screen, |band| band.clear_color(BACKGROUND), draw);
    assert!(screen.pixels.iter().all(Option::is_some), "a pixel was not sent");
    screen
}
