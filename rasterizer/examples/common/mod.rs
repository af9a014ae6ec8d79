//! What all examples share: a display, and a camera before it.

use std::{convert::Infallible, env, error::Error, fs};

use embedded_graphics::{
    pixelcolor::Rgb565, pixelcolor::Rgb888, prelude::*, primitives::Rectangle,
};
use rasterizer::prelude::*;

/// Any error: a firmware has its driver's error here.
pub(crate) type Result<T = (), E = Box<dyn Error>> = core::result::Result<T, E>;

/// The whole display.
pub(crate) const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));

/// Shows what is within 1.05 units of the origin, from in front, in a part of the display that is
/// as high as all of it.
pub(crate) fn camera(viewport: Rectangle) -> Result<Camera> {
    const NEAR: Distance = Distance::lit("0.1");
    const FAR: Distance = Distance::lit("100");
    const EYE: Vec3 = Vec3::lit("0", "0", "4");
    let lens = const { Perspective::new(Turn::degrees(30), NEAR, FAR) }?;
    Ok(Camera::look_at(EYE, Vec3::ZERO, Vec3::Y, lens, viewport)?)
}

/// Stands for the display and its driver: it takes pixels as any other, and keeps them for a file.
pub(crate) struct Screen {
    pixels: Vec<Rgb565>,
}

impl Default for Screen {
    fn default() -> Self {
        Self { pixels: vec![Rgb565::BLACK; (SCREEN.size.width * SCREEN.size.height) as usize] }
    }
}

impl Screen {
    /// Red, green and blue of all pixels.
    pub(crate) fn rgb(&self) -> Vec<u8> {
        let colors = self.pixels.iter().map(|&pixel| Rgb888::from(pixel));
        colors.flat_map(|color| [color.r(), color.g(), color.b()]).collect()
    }

    /// The picture as a PNG file.
    pub(crate) fn png(&self) -> Result<Vec<u8>> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, SCREEN.size.width, SCREEN.size.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.rgb())?;
        Ok(file)
    }
}

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        SCREEN.size
    }
}

impl DrawTarget for Screen {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            if SCREEN.contains(point) {
                self.pixels[(point.y * SCREEN.size.width as i32 + point.x) as usize] = color;
            }
        }
        Ok(())
    }
}

/// Runs an example, and writes its picture into the folder `examples-pictures` beside the build's.
pub(crate) fn run(draw: impl FnOnce(&mut Screen) -> Result) -> Result {
    let mut screen = Screen::default();
    draw(&mut screen)?;
    write(env!("CARGO_CRATE_NAME"), &screen.png()?)
}

/// Writes a picture into that folder.
pub(crate) fn write(name: &str, png: &[u8]) -> Result {
    let program = env::current_exe()?;
    let target = program.ancestors().nth(3).ok_or("the program is not in the folder of a build")?;
    let folder = target.join("examples-pictures");
    fs::create_dir_all(&folder)?;
    let file = folder.join(name).with_extension("png");
    fs::write(&file, png)?;
    println!("{}", file.display());
    Ok(())
}
