//! Frames of a choice of types: what the work-precision report measures.
//!
//! A program is compiled for each choice, as the firmware that makes the choice would be. On the
//! host the same program writes its pictures, for their errors; on a core the plugin counts, and
//! the hashes tell that the pictures are the same.

mod float;

use core::{cell::RefCell, convert::Infallible};

use critical_section::Mutex;
use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    pixelcolor::{PixelColor, Rgb565, Rgb888, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance},
    color::{Mean, Rgb332},
    geometry::{Pose, ScreenVertex},
    mesh::Mesh,
    numbers::{Subpixel, Vec3},
    output::{BandAreas, Frame, Rgb565Be, StoredColor, StoredDepth, Supersampled},
    scene::{Object, bin_words},
    shade::{OnScreen, Shader},
};

use crate::{
    console,
    cost::{fail, timed},
    counter::{self, Stage},
    hash::hash,
    stage::{AREA, PIXELS, SIZE, pose, view_on},
};

/// The display's rows in a band of supersampled pixels.
const BAND_ROWS: u32 = 8;

/// What the bins of a mesh of some triangles take in bands of `side` by `side` samples a pixel.
#[must_use]
pub const fn words(triangles: usize, side: u32) -> usize {
    bin_words(triangles, SIZE.height * side, BAND_ROWS * side)
}

/// A colour that pictures of choices have.
pub trait Shown: StoredColor + PixelColor {
    /// What a display shows for it.
    fn shown(self) -> Rgb888;
}

impl Shown for Rgb565Be {
    fn shown(self) -> Rgb888 {
        Rgb565::from(self).into()
    }
}

macro_rules! shown {
    ($($color:ty),*) => {
        $(impl Shown for $color {
            fn shown(self) -> Rgb888 {
                self.into()
            }
        })*
    };
}
shown!(Rgb332, Rgb888);

/// The memory of a choice: the largest that one takes.
#[derive(Debug)]
pub struct Memory<C> {
    color: [C; PIXELS],
    /// What the display shows, if frames are drawn in bands.
    display: [C; PIXELS],
    depth: [u32; PIXELS],
}

/// It in a static.
pub type Shared<C> = Mutex<RefCell<Memory<C>>>;

impl<C: Copy> Memory<C> {
    /// For a static, with the colour of the background.
    #[must_use]
    #[expect(clippy::large_stack_arrays, reason = "it is computed when this is compiled")]
    pub const fn shared(background: C) -> Shared<C> {
        Mutex::new(RefCell::new(Self {
            color: [background; PIXELS],
            display: [background; PIXELS],
            depth: [0; PIXELS],
        }))
    }
}

/// A model as it is seen: the same for all choices.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// Its tables.
    pub mesh: &'a Mesh<'a>,
    /// The focal length in pixels.
    pub focal_length_px: u32,
    /// The camera's distance from the origin, in units of the model.
    pub distance: &'a str,
    /// How far it moves to the right where the environment asks for the shifted pictures, in
    /// 65,536ths of a unit of the model.
    pub shift: i32,
    /// How many of its turns are drawn, an eighth of a turn about y each.
    pub frames: u32,
}

impl Scene<'_> {
    /// The camera for a `viewport` of `side` by `side` samples a pixel.
    fn camera(&self, viewport: Rectangle, side: usize) -> Camera {
        let focal_length = Distance::from_num(self.focal_length_px * side as u32);
        view_on(viewport, focal_length, self.eye())
    }

    /// Where the camera stands. It moves to the left for a scene that moves to the right.
    fn eye(&self) -> Vec3 {
        let shift = if console::is_shifted() { self.shift } else { 0 };
        Vec3::lit("0", "0", self.distance) - Vec3::from_bits([shift, 0, 0])
    }
}

/// A choice by its name, and the scene that it draws.
#[derive(Clone, Copy, Debug)]
pub struct Choice<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its scene.
    pub scene: Scene<'a>,
}

impl Choice<'_> {
    /// Draws whole frames with depth. `VERTICES` are those of the mesh.
    pub fn frames<S: Subpixel, D: StoredDepth, Sh: Shader<Color: Shown>, const VERTICES: usize>(
        &self,
        shader: Sh,
        background: Sh::Color,
        memory: &Shared<Sh::Color>,
    ) {
        let mut vertices = [ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; VERTICES];
        let (object, camera) = (Object::new(self.scene.mesh, shader), self.scene.camera(AREA, 1));
        self.each(memory, |pose, Memory { color, depth, .. }, ticks| {
            color.fill(background);
            let object = object.clone().posed(pose);
            let depth = &mut bytemuck::cast_slice_mut::<u32, D>(depth)[..PIXELS];
            let mut frame = Frame::new(color, depth, AREA).unwrap_or_else(fail);
            timed(Stage::Clear, ticks, || frame.clear_depth());
            let seen = timed(Stage::Vertices, ticks, || object.project(&camera, &mut vertices));
            let seen = seen.unwrap_or_else(fail);
            let Ok(()) = timed(Stage::Draw, ticks, || seen.draw(&mut frame));
            Shows::Frame
        });
    }

    /// Draws whole frames from back to front, without depth. `TRIANGLES` are those of the mesh.
    pub fn painted<
        S: Subpixel,
        Sh: Shader<Color: Shown>,
        const VERTICES: usize,
        const TRIANGLES: usize,
    >(
        &self,
        shader: Sh,
        background: Sh::Color,
        memory: &Shared<Sh::Color>,
    ) {
        let mut vertices = [ScreenVertex::<S, NoDepth, OnScreen<Sh>>::EMPTY; VERTICES];
        let mut order = [0; TRIANGLES];
        let (object, camera) = (Object::new(self.scene.mesh, shader), self.scene.camera(AREA, 1));
        self.each(memory, |pose, Memory { color, .. }, ticks| {
            color.fill(background);
            let object = object.clone().posed(pose);
            let mut frame = Frame::without_depth(color, AREA).unwrap_or_else(fail);
            let seen = timed(Stage::Vertices, ticks, || object.project(&camera, &mut vertices));
            let seen = seen.unwrap_or_else(fail);
            let Ok(()) = timed(Stage::Draw, ticks, || {
                seen.back_to_front(&mut order).unwrap_or_else(fail).draw(&mut frame)
            });
            Shows::Frame
        });
    }

    /// Draws frames in bands of `SIDE` by `SIDE` samples a pixel, and shows their means. `VERTICES`
    /// are those of the mesh, and `WORDS` what the bins of its triangles take.
    pub fn supersampled<
        S: Subpixel,
        D: StoredDepth,
        Sh: Shader<Color: Shown + Mean>,
        const SIDE: usize,
        const VERTICES: usize,
        const WORDS: usize,
    >(
        &self,
        shader: Sh,
        background: Sh::Color,
        memory: &Shared<Sh::Color>,
    ) {
        let mut vertices = [ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; VERTICES];
        let mut bins = [0; WORDS];
        let object = Object::new(self.scene.mesh, shader);
        let samples = Supersampled::<SIDE>::area(AREA);
        let camera = self.scene.camera(samples, SIDE);
        self.each(memory, |pose, Memory { color, depth, display }, ticks| {
            let object = object.clone().posed(pose);
            let depth = bytemuck::cast_slice_mut::<u32, D>(depth);
            let seen = timed(Stage::Vertices, ticks, || object.project(&camera, &mut vertices));
            let rows = BAND_ROWS * SIDE as u32;
            let seen = timed(Stage::Draw, ticks, || {
                seen.unwrap_or_else(fail).binned(rows, &mut bins).unwrap_or_else(fail)
            });
            let mut display = Display(display);
            for area in BandAreas::new(samples, rows) {
                let pixels = (area.size.width * area.size.height) as usize;
                let (color, depth) = (&mut color[..pixels], &mut depth[..pixels]);
                color.fill(background);
                let mut frame = Frame::new(color, depth, area).unwrap_or_else(fail);
                timed(Stage::Clear, ticks, || frame.clear_depth());
                let Ok(()) = timed(Stage::Draw, ticks, || {
                    let Ok(()) = seen.draw(&mut frame);
                    frame.resolved::<SIDE>().map_or(Ok(()), |means| means.present(&mut display))
                });
            }
            Shows::Display
        });
    }

    /// Draws each frame by `draw`, and prints the line of the choice.
    fn each<C: Shown>(
        &self,
        memory: &Shared<C>,
        mut draw: impl FnMut(Pose, &mut Memory<C>, &mut u64) -> Shows,
    ) {
        let (mut all, mut ticks) = (0, 0);
        critical_section::with(|token| {
            let memory = &mut *memory.borrow_ref_mut(token);
            for frame in 0..self.scene.frames {
                let pixels = match draw(pose(frame), memory, &mut ticks) {
                    Shows::Frame => &memory.color,
                    Shows::Display => &memory.display,
                };
                let pixels = pixels.iter().map(|&color| color.shown());
                let channels = pixels.flat_map(|color| [color.r(), color.g(), color.b()]);
                all = hash(all, channels.clone().map(u16::from));
                console::picture(self.name, frame, channels);
            }
        });
        counter::report();
        let Self { name, scene: Scene { frames, .. } } = self;
        console::line(format_args!(
            r#"{{"choice":"{name}","frames":{frames},"hash":"{all:08x}","ticks":{ticks}}}"#
        ));
    }
}

/// Where a frame's pixels are.
enum Shows {
    Frame,
    Display,
}

/// A display whose pixels are memory.
struct Display<'a, C>(&'a mut [C; PIXELS]);

impl<C> Dimensions for Display<'_, C> {
    fn bounding_box(&self) -> Rectangle {
        AREA
    }
}

impl<C: PixelColor> DrawTarget for Display<'_, C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            let place = y * SIZE.width as i32 + x;
            if let Some(pixel) = self.0.get_mut(place as usize) {
                *pixel = color;
            }
        }
        Ok(())
    }

    /// Bands are as wide as the display.
    #[inline(always)]
    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        let first = (area.top_left.y as u32 * SIZE.width) as usize;
        for (pixel, color) in self.0[first..].iter_mut().zip(colors) {
            *pixel = color;
        }
        Ok(())
    }
}
