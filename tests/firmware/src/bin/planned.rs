//! Draws the frames of a plan, whose Rust file `measure plan` has written and named in `PLANNED`,
//! with a function of them behind it.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::convert::Infallible;

#[cfg(not(target_os = "none"))]
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Size},
    pixelcolor::{IntoStorage as _, Rgb565},
    primitives::Rectangle,
};
use firmware::counter::{self, Stage};

#[allow(dead_code, reason = "a firmware may need fewer of the public names")]
#[allow(unreachable_pub, reason = "the file is that of a firmware")]
mod planned {
    include!(env!("PLANNED"));
}

/// A driver that has next to nothing to do for a pixel: a checksum is all that it keeps, and on the
/// host the picture.
struct Port<'a> {
    display: &'a mut sizes::Display,
    #[cfg(not(target_os = "none"))]
    picture: Vec<Rgb565>,
}

impl<'a> Port<'a> {
    const fn new(display: &'a mut sizes::Display) -> Self {
        Self {
            display,
            #[cfg(not(target_os = "none"))]
            picture: Vec::new(),
        }
    }

    #[inline(always)]
    fn take(&mut self, color: Rgb565) {
        self.display.take_inline(color.into_storage().into());
        #[cfg(not(target_os = "none"))]
        self.picture.push(color);
    }

    /// Writes the picture of a frame, where there are files.
    #[cfg(not(target_os = "none"))]
    fn finish(self, frame: u32) {
        let colors = self.picture.into_iter().map(Rgb888::from);
        let channels = colors.flat_map(|color| [color.r(), color.g(), color.b()]);
        firmware::console::picture("planned", frame, channels);
    }
}

impl OriginDimensions for Port<'_> {
    fn size(&self) -> Size {
        planned::SCREEN.size
    }
}

impl DrawTarget for Port<'_> {
    type Color = Rgb565;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            self.display.take_at(point);
            self.take(color);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        self.display.take_at(area.top_left);
        for color in colors {
            self.take(color);
        }
        Ok(())
    }
}

/// The plan.
struct Planned;

impl Scene for Planned {
    type Memory = planned::Memory;

    const MEMORY: planned::Memory = planned::Memory::EMPTY;

    fn draw(memory: &mut planned::Memory, display: &mut sizes::Display) -> Option<()> {
        for frame in 0..planned::FRAMES {
            counter::mark(Stage::Draw);
            let mut port = Port::new(display);
            let drawn = planned::frame(&mut port, memory, frame);
            counter::mark(Stage::Draw);
            counter::report();
            drawn.ok()?;
            #[cfg(not(target_os = "none"))]
            port.finish(frame);
        }
        Some(())
    }
}

firmware::program!(Planned);
