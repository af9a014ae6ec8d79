//! The walk of the documentation: the world of `rasterizer/examples/walk.rs`, frame by frame.

use embedded_graphics_core::pixelcolor::{Rgb565, RgbColor as _};
use rasterizer::output::Bands;

use crate::{
    console,
    cost::{Cost, fail},
    counter,
    sizes::{Display, Scene},
};

mod rocket {
    pub(super) use crate::models::ROCKET;
}

#[path = "../../../rasterizer/examples/world/mod.rs"]
mod world;

use world::{BAND_ROWS, FRAMES, SCREEN, Storage};

const BAND_PIXELS: usize = SCREEN.size.width as usize * BAND_ROWS;

/// What the walk keeps in RAM.
#[derive(Debug)]
pub struct Memory {
    color: [Rgb565; BAND_PIXELS],
    depth: [u16; BAND_PIXELS],
    storage: Storage,
}

impl Memory {
    const EMPTY: Self = Self {
        color: [Rgb565::BLACK; BAND_PIXELS],
        depth: [0; BAND_PIXELS],
        storage: Storage::EMPTY,
    };

    fn draw(&mut self, frame: u32, display: &mut Display) -> Option<()> {
        let Self { color, depth, storage } = self;
        let mut bands = Bands::new(SCREEN, &mut color[..], &mut depth[..]).ok()?;
        world::draw(frame, storage, &mut bands, display).ok()
    }
}

/// Three frames of the walk as a firmware of its own.
#[derive(Clone, Copy, Debug)]
pub struct Walk;

impl Scene for Walk {
    type Memory = Memory;

    const MEMORY: Memory = Memory::EMPTY;

    fn draw(memory: &mut Memory, display: &mut Display) -> Option<()> {
        (0..FRAMES).step_by(8).try_for_each(|frame| memory.draw(frame, display))
    }
}

/// The program that measures all frames of the walk.
pub fn main() {
    counter::start();
    console::build();
    let mut memory = Memory::EMPTY;
    let mut cost = Cost::<false>::default();
    let mut display = Display::default();
    for frame in 0..FRAMES {
        let drawn = cost.add_whole(SCREEN.size, || memory.draw(frame, &mut display));
        drawn.ok_or("a frame of the walk was not drawn").unwrap_or_else(fail);
    }
    counter::report();
    console::line(format_args!(
        r#"{{"scene":"walk","precision":"S4","mode":"bands of 32",{cost}}}"#
    ));
}
