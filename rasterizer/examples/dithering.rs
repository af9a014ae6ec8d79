//! Few colours, with dithering and without: 4 grays, 16 grays, and a byte of red, green and blue.
//!
//! A frame of `Rgb888` is sent to three displays. Above, each takes the nearest of its colours.
//! Below, `Dithering` stands before the display: it chooses between the two nearest by the place of
//! the pixel, so that the mean is right. Everything that is sent is dithered: the sky as well as
//! the planet.
//!
//! `cargo run -p rasterizer --example dithering`

#[path = "models/ball.rs"]
mod ball;
mod common;

use std::{convert::Infallible, marker::PhantomData};

use ball::ball;
use common::{Result, Screen, camera};
use embedded_graphics::{
    draw_target::DrawTargetExt as _,
    pixelcolor::{Gray2, Gray4, Rgb565, Rgb888},
    prelude::*,
    primitives::Rectangle,
};
use rasterizer::{
    color::{Dither, Rgb332},
    mesh::Material,
    output::Dithering,
    prelude::*,
};
use static_cell::ConstStaticCell;

static PLANET: Mesh<'static> = ball(&[Material::new([255, 150, 60], ball::TRIANGLES)]);
const SUN: Light = Light::new(Vec3::lit("-3", "3", "2"), Level::lit("0.04"), Level::lit("0.96"));

/// What each display shows.
const PART: Rectangle = Rectangle::new(Point::zero(), Size::new(80, 120));
const PIXELS: usize = 80 * 120;
static COLOR: ConstStaticCell<[Rgb888; PIXELS]> = ConstStaticCell::new([Rgb888::BLACK; PIXELS]);
static DEPTH: ConstStaticCell<[u16; PIXELS]> = ConstStaticCell::new([0; PIXELS]);

pub(crate) fn draw(screen: &mut Screen) -> Result {
    let mut frame = Frame::new(COLOR.take(), DEPTH.take(), PART)?;
    let Ok(()) = frame.fill_contiguous(&PART, PART.points().map(sky));
    let planet = Object::new(&PLANET, Gouraud::<Rgb888, 256>::with_levels(SUN));
    let planet = planet.posed(Pose::IDENTITY.scaled(const { Distance::lit("0.58") }));
    planet.project_on_demand(&camera(PART)?, S4)?.draw(&mut frame);

    for (column, left) in (0..3).zip([0, 80, 160]) {
        let [nearest, dithered] =
            [0, 120].map(|top| Rectangle::new(Point::new(left, top), PART.size));
        match column {
            0 => show::<Gray2>(&frame, screen, nearest, dithered),
            1 => show::<Gray4>(&frame, screen, nearest, dithered),
            _ => show::<Rgb332>(&frame, screen, nearest, dithered),
        }
    }
    Ok(())
}

/// A sky that gets lighter towards the horizon.
const fn sky(point: Point) -> Rgb888 {
    let light = point.y.unsigned_abs() as u8;
    Rgb888::new(light / 3, light / 2, 40 + light)
}

/// Sends the frame to a display of colours `C`, in two ways.
fn show<C>(
    frame: &Frame<'_, Rgb888, &mut [u16]>,
    screen: &mut Screen,
    nearest: Rectangle,
    dithered: Rectangle,
) where
    C: PixelColor + Dither + From<Rgb888> + Into<Rgb888>,
{
    let mut part = screen.cropped(&nearest);
    let mut display = Display::<_, C>(&mut part, PhantomData);
    let Ok(()) = display.fill_contiguous(&PART, frame.pixels().iter().map(|&color| color.into()));

    let mut part = screen.cropped(&dithered);
    let mut display = Display::<_, C>(&mut part, PhantomData);
    let Ok(()) = frame.present(&mut Dithering::<_, Rgb888>::new(&mut display));
}

/// Stands for the driver of a display of colours `C`.
struct Display<'s, T, C>(&'s mut T, PhantomData<C>);

impl<T: Dimensions, C> Dimensions for Display<'_, T, C> {
    fn bounding_box(&self) -> Rectangle {
        self.0.bounding_box()
    }
}

impl<T, C> DrawTarget for Display<'_, T, C>
where
    T: DrawTarget<Color = Rgb565, Error = Infallible>,
    C: PixelColor + Into<Rgb888>,
{
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let shown = |color: C| Rgb565::from(color.into());
        self.0.draw_iter(pixels.into_iter().map(|Pixel(at, color)| Pixel(at, shown(color))))
    }
}

fn main() -> Result {
    common::run(draw)
}
