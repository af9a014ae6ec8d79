//! A display of 128 x 64 pixels that are on or off: light by dithering, in a kilobyte.
//!
//! `Dithered` makes pixels of any shader's grays, so that a square of them is as bright as the
//! gray. The frame is `PackedFrame`, eight pixels in a byte, in the order of the display's own
//! memory: its bytes can be sent as they are. The picture shows three displays: dithered in a
//! frame, dithered straight onto the display without one, and without dithering, each gray the
//! nearest of black and white.
//!
//! `cargo run -p rasterizer --example oled`

#[path = "models/ball.rs"]
mod ball;
mod common;
/// What `host-tools convert` makes of `rocket.obj`.
#[path = "models/rocket.rs"]
pub mod rocket;

use std::convert::Infallible;

use ball::ball;
use common::{Result, SCREEN, Screen, camera};
use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_5X7},
    pixelcolor::{BinaryColor, Gray8, Rgb565, Rgb888},
    prelude::*,
    primitives::Rectangle,
    text::Text,
};
use rasterizer::{
    mesh::Material,
    output::{InPages, PackedFrame},
    prelude::*,
    shade::Dithered,
};
use rocket::ROCKET;
use static_cell::ConstStaticCell;

static MOON: Mesh<'static> = ball(&[Material::new([235; 3], ball::TRIANGLES)]);
const SUN: Light = Light::new(Vec3::lit("-3", "3", "3"), Level::lit("0.12"), Level::lit("0.88"));

const OLED: Rectangle = Rectangle::new(Point::zero(), Size::new(128, 64));
/// 1,024 bytes.
const BYTES: usize = PackedFrame::<BinaryColor, NoDepth, InPages>::bytes(OLED.size);
static PIXELS: ConstStaticCell<[u8; BYTES]> = ConstStaticCell::new([0; BYTES]);
static DEPTH: ConstStaticCell<[u16; 128 * 64]> = ConstStaticCell::new([0; 128 * 64]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    screen.fill_solid(&SCREEN, Rgb565::new(4, 9, 6))?;
    let camera = camera(OLED)?;
    let tilted = Rotation::about_z(-Turn::degrees(66)) * Rotation::about_y(Turn::degrees(50));
    let near = const { Vec3::lit("-0.55", "-0.12", "0.9") };
    let near = Pose::rotated(tilted).at(near).scaled(const { Distance::lit("1.35") });
    let far = const { Vec3::lit("1.35", "-0.6", "-1") };
    let far = Pose::IDENTITY.at(far).scaled(const { Distance::lit("1.35") });
    let (pixels, depth) = (PIXELS.take(), DEPTH.take());
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; ROCKET.vertex_count()];

    // Grays of eight bits, dithered pixel by pixel. The compiler infers the target's colour.
    let shader = Dithered::new(Gouraud::<Gray8, 256>::with_levels(SUN));
    let mut frame = PackedFrame::<BinaryColor, _, _>::in_pages(pixels, depth, OLED)?;
    frame.clear(BinaryColor::Off);
    Object::new(&MOON, shader).posed(far).project_on_demand(&camera, S4)?.draw(&mut frame);
    Object::new(&ROCKET, shader).posed(near).draw(&camera, &mut vertices, &mut frame)?;
    label(&mut frame)?;
    // On a device: `frame.as_bytes()` goes to the display's memory, by I2C or by SPI.
    frame.present(&mut Oled::new(screen, Point::new(56, 8)))?;

    // Without any buffer: the moon alone, as nothing tests depth.
    let mut oled = Oled::new(screen, Point::new(56, 88));
    oled.clear(BinaryColor::Off)?;
    let moon = Object::new(&MOON, shader).posed(far);
    moon.project_on_demand(&camera, S4)?.draw(&mut Direct::new(&mut oled))?;
    label(&mut oled)?;

    // For comparison: each gray becomes black or white by itself.
    let shader = Gouraud::<BinaryColor, 256>::with_levels(SUN);
    frame.clear(BinaryColor::Off);
    Object::new(&MOON, shader).posed(far).project_on_demand(&camera, S4)?.draw(&mut frame);
    Object::new(&ROCKET, shader).posed(near).draw(&camera, &mut vertices, &mut frame)?;
    label(&mut frame)?;
    frame.present(&mut Oled::new(screen, Point::new(56, 168)))?;
    Ok(())
}

/// Text is drawn by embedded-graphics, as on any other target.
fn label<T: DrawTarget<Color = BinaryColor>>(target: &mut T) -> Result<(), T::Error> {
    let style = MonoTextStyle::new(&FONT_5X7, BinaryColor::On);
    Text::new("384,400 km", Point::new(2, 8), style).draw(target)?;
    Ok(())
}

/// Stands for the driver of an SSD1306: pixels that are on glow in light blue, somewhere in the
/// picture of this example.
struct Oled<'s> {
    screen: &'s mut Screen,
    corner: Point,
}

impl<'s> Oled<'s> {
    const fn new(screen: &'s mut Screen, corner: Point) -> Self {
        Self { screen, corner }
    }
}

impl OriginDimensions for Oled<'_> {
    fn size(&self) -> Size {
        OLED.size
    }
}

impl DrawTarget for Oled<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<BinaryColor>>,
    {
        let glow = Rgb565::from(Rgb888::new(200, 232, 255));
        let inside = pixels.into_iter().filter(|Pixel(point, _)| OLED.contains(*point));
        self.screen.draw_iter(inside.map(|Pixel(point, color)| {
            Pixel(point + self.corner, if color.is_on() { glow } else { Rgb565::BLACK })
        }))
    }
}

fn main() -> Result {
    common::run(draw)
}
