//! The bench scenes, and how many instructions a frame of each takes.
//!
//! The numbers are QEMU's: with `-icount shift=0` an instruction takes a nanosecond, and the system timer of its MPS2
//! boards counts 25 times in a microsecond. They are the same on every run and every host, and no cycle counts: wait
//! states, divisions and taken branches count as one instruction each.

use core::fmt::Debug;

use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::{Rgb565, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{Pose, ScreenVertex, Subpixel},
    mesh::Mesh,
    numbers::{Angle, Rotation, Vec3},
    scene::{Object, Projected},
    shade::{Flat, Gouraud, Level, Light, Shader},
    target::{DepthBuffer, Frame},
};

use crate::{console, counter::Moment, memory::Memory, models};

/// 320 x 240 in two halves: the memory holds no more, and the triangles are looked through twice.
const SIZE: Size = Size::new(320, 240);
const ROWS: u32 = 120;
/// The pixels of a half.
pub const PIXELS: usize = (SIZE.width * ROWS) as usize;
/// Vertices of the largest model.
pub const VERTICES: usize = 3000;

const FRAMES: u32 = 8;

/// Runs all scenes.
pub fn run(memory: &mut Memory<PIXELS, VERTICES>) {
    let light = Light::new(Vec3::lit("-1", "2", "3"), Level::lit("0.2"), Level::lit("0.8"));
    let gouraud = Gouraud::<Rgb565>::new(light);
    let (close, far) = (view("400", "2.4"), view("160", "3"));
    let mut both = |name: &str, mesh: &'static Mesh<'static>| {
        let Memory {
            color,
            depth,
            coarse,
            fine,
        } = &mut *memory;
        let object = Object::new(mesh, gouraud);
        scene((name, "S4"), object, &close, color, depth, coarse);
        scene((name, "S8"), object, &close, color, depth, fine);
    };
    #[cfg(models)]
    both("spot-gouraud", &models::SPOT);
    #[cfg(models)]
    both("suzanne-gouraud", &models::SUZANNE);
    both("cube-gouraud", &models::CUBE);
    let Memory { color, depth, .. } = memory;
    let flat = Flat::<Rgb565>::new(light);
    let mut coarse = [ScreenVertex::<rasterizer::geometry::S4, _, _>::EMPTY; models::SPHERE.vertex_count()];
    let mut fine = [ScreenVertex::<rasterizer::geometry::S8, _, _>::EMPTY; models::SPHERE.vertex_count()];
    let sphere = Object::new(&models::SPHERE, flat);
    scene(("sphere-flat", "S4"), sphere, &far, color, depth, &mut coarse);
    scene(("sphere-flat", "S8"), sphere, &far, color, depth, &mut fine);
    let mut coarse = [ScreenVertex::<rasterizer::geometry::S4, _, _>::EMPTY; models::CUBE.vertex_count()];
    let mut fine = [ScreenVertex::<rasterizer::geometry::S8, _, _>::EMPTY; models::CUBE.vertex_count()];
    let cube = Object::new(&models::CUBE, flat);
    convex(("cube-flat", "S4"), cube, &close, color, &mut coarse);
    convex(("cube-flat", "S8"), cube, &close, color, &mut fine);
}

fn view(focal_length: &str, distance: &str) -> Camera {
    let near = Distance::lit("0.1");
    let lens = Perspective::with_focal_length(Distance::lit(focal_length), near, Distance::lit("100"));
    let viewport = Rectangle::new(Point::zero(), SIZE);
    let eye = Vec3::lit("0", "0", distance);
    Camera::at(eye, Rotation::IDENTITY, lens.unwrap_or_else(fail), viewport).unwrap_or_else(fail)
}

fn pose(frame: u32) -> Pose {
    Pose::rotated(Rotation::about_x(Angle::turns(30, 512)) * Rotation::about_y(Angle::turns(64 * frame + 20, 512)))
}

fn halves() -> [Rectangle; 2] {
    [0, ROWS].map(|top| Rectangle::new(Point::new(0, top as i32), Size::new(SIZE.width, ROWS)))
}

fn scene<S: Subpixel, Sh: Shader<Color = Rgb565>>(
    name: (&str, &str),
    object: Object<'_, Sh>,
    camera: &Camera,
    color: &mut [Rgb565],
    depth: &mut [u16],
    vertices: &mut [ScreenVertex<S, u16, Sh::Varyings>],
) {
    let mut total = Cost::default();
    for frame in 0..FRAMES {
        let object = object.clone().posed(pose(frame));
        let start = Moment::now();
        let seen = object.project(camera, vertices).unwrap_or_else(fail);
        total.vertices += start.elapsed();
        for area in halves() {
            color.fill(Rgb565::BLACK);
            let mut frame = Frame::new(color, depth, area).unwrap_or_else(fail);
            total.measure(&seen, &mut frame);
        }
    }
    total.report(name);
}

fn convex<S: Subpixel, Sh: Shader<Color = Rgb565>>(
    name: (&str, &str),
    object: Object<'_, Sh>,
    camera: &Camera,
    color: &mut [Rgb565],
    vertices: &mut [ScreenVertex<S, rasterizer::geometry::NoDepth, Sh::Varyings>],
) {
    let mut total = Cost::default();
    for frame in 0..FRAMES {
        let object = object.clone().posed(pose(frame));
        let start = Moment::now();
        let seen = object.project(camera, vertices).unwrap_or_else(fail);
        total.vertices += start.elapsed();
        for area in halves() {
            color.fill(Rgb565::BLACK);
            let mut frame = Frame::without_depth(color, area).unwrap_or_else(fail);
            total.measure(&seen, &mut frame);
        }
    }
    total.report(name);
}

/// Instructions of all frames of a scene.
#[derive(Default)]
struct Cost {
    clear: u32,
    vertices: u32,
    triangles: u32,
    pixels: u32,
}

impl Cost {
    /// Clears the depth, draws, and counts the pixels.
    fn measure<S: Subpixel, Sh: Shader<Color = Rgb565>, B: DepthBuffer>(
        &mut self,
        seen: &Projected<'_, '_, Perspective, S, B::Format, Sh>,
        frame: &mut Frame<'_, Rgb565, B>,
    ) {
        let start = Moment::now();
        frame.clear_depth();
        self.clear += start.elapsed();
        let start = Moment::now();
        let Ok(()) = seen.draw(frame);
        self.triangles += start.elapsed();
        self.pixels += frame.pixels().iter().filter(|&&p| p != Rgb565::BLACK).count() as u32;
    }

    fn report(&self, (scene, precision): (&str, &str)) {
        let mean = |total: u32| (total + FRAMES / 2) / FRAMES;
        let all = self.clear + self.vertices + self.triangles;
        console::line(format_args!(
            "{scene:16} {precision} {:8} instructions a frame: clear {:6} vertices {:7} triangles {:8}; {:6} pixels",
            mean(all),
            mean(self.clear),
            mean(self.vertices),
            mean(self.triangles),
            mean(self.pixels)
        ));
    }
}

fn fail<T, E: Debug>(error: E) -> T {
    panic!("{error:?}")
}
