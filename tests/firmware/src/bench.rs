//! The bench scenes: models of 12 to 5,856 triangles on 320 x 240 pixels, each turned in eight
//! frames.

pub mod shades;
pub mod textures;

use core::cell::RefCell;

use critical_section::Mutex;
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::Camera,
    geometry::ScreenVertex,
    mesh::Mesh,
    numbers::{S4, S8, Subpixel},
    output::Rgb565Be,
    scene::{self, Object, bin_words},
    shade::{Flat, Gouraud, OnScreen, Shader},
};

use crate::{
    console,
    cost::{Cost, Depth},
    counter,
    memory::{Memory, Shared},
    models,
    stage::{AREA, PIXELS, SIZE, pose, sun, view, view_on},
};

/// Vertices of the largest model.
const VERTICES: usize = if cfg!(models) { 3000 } else { 300 };
/// Triangles of the largest model.
const TRIANGLES: usize = if cfg!(models) { 6000 } else { 600 };
/// Words for the largest model's triangles in bins, or for their order.
const WORD_COUNT: usize = {
    let bins = bin_words(TRIANGLES, SIZE.height, BAND_ROWS);
    if bins > TRIANGLES { bins } else { TRIANGLES }
};
const FRAMES: u32 = 8;
const BAND_ROWS: u32 = 16;

/// How a frame is drawn: in bands of `rows` rows, with bins if there are several.
#[derive(Clone, Copy)]
struct Mode {
    name: &'static str,
    rows: u32,
}

impl Mode {
    /// Pixels of a band, which is the frame if there is but one.
    const fn pixels(self) -> usize {
        (SIZE.width * self.rows) as usize
    }
}

const MODES: [Mode; 2] =
    [Mode { name: "whole", rows: SIZE.height }, Mode { name: "bands of 16", rows: BAND_ROWS }];

/// The precision that suits the core: S4 where there is no long multiply, S8 elsewhere.
#[cfg(all(target_arch = "arm", not(target_has_atomic = "32")))]
type Suited = S4;
#[cfg(not(all(target_arch = "arm", not(target_has_atomic = "32"))))]
type Suited = S8;

const SUITED: &str = if Suited::BITS == 4 { "S4" } else { "S8" };

static MEMORY: Shared<PIXELS> = Memory::shared();

/// Pixels of a band.
const BAND_PIXELS: usize = (SIZE.width * BAND_ROWS) as usize;
static BAND: Shared<BAND_PIXELS> = Memory::shared();

/// The triangles in bins, or in order: with the models 24 KB, which is much for a stack.
static WORDS: Mutex<RefCell<[u32; WORD_COUNT]>> = Mutex::new(RefCell::new([0; WORD_COUNT]));

/// The program: starts the counter, says how it was compiled, and measures.
pub fn main<const SET_UP: bool>() {
    counter::start();
    console::build();
    Bench::within(&MEMORY, run::<SET_UP, _>);
}

/// The program for boards: measures what fits in the memory of one band.
pub fn board() {
    counter::start();
    console::build();
    Bench::within(&BAND, run::<false, _>);
}

/// Measures all scenes, or their set-up alone, and prints a line for each.
fn run<const SET_UP: bool, const PIXELS: usize>(mut bench: Bench<'_, SET_UP, PIXELS, VERTICES>) {
    let light = sun();
    let (gouraud, flat) = (Gouraud::new(light), Flat::new(light));
    let (close, far) = (view("400", "2.4"), view("160", "3"));
    #[cfg(models)]
    bench.scene::<u16, _>("spot-gouraud", &models::SPOT, gouraud, &close);
    #[cfg(models)]
    bench.scene::<u16, _>("suzanne-gouraud", &models::SUZANNE, gouraud, &close);
    bench.scene::<u16, _>("cube-gouraud", &models::CUBE, gouraud, &close);
    bench.scene::<u16, _>("sphere-flat", &models::SPHERE, flat, &far);
    bench.scene::<NoDepth, _>("cube-flat", &models::CUBE, flat, &close);
    #[cfg(models)]
    bench.painted("spot-gouraud-painter", &models::SPOT, gouraud, &close);
    bench.painted("sphere-flat-painter", &models::SPHERE, flat, &far);
    bench.scene::<FloatDepth, _>("cube-gouraud-float16", &models::CUBE, gouraud, &close);
    bench.scene::<FloatDepth, _>("sphere-flat-float16", &models::SPHERE, flat, &far);
}

/// The program that measures what bands cost that keep less than all that could be kept from one to
/// the next.
pub fn frugal<const SET_UP: bool>() {
    counter::start();
    console::build();
    Bench::within(&MEMORY, |mut bench: Bench<'_, SET_UP, PIXELS, VERTICES>| {
        #[cfg(models)]
        bench.frugal_bands("spot-gouraud", &models::SPOT, Gouraud::new(sun()), &view("400", "2.4"));
        bench.frugal_bands("sphere-flat", &models::SPHERE, Flat::new(sun()), &view("160", "3"));
    });
}

/// Measures in the memory of a frame or a band, with storage for `VERTICES` vertices on the stack.
struct Bench<'a, const SET_UP: bool, const PIXELS: usize, const VERTICES: usize> {
    memory: &'a mut Memory<PIXELS>,
    words: &'a mut [u32],
}

impl<const SET_UP: bool, const PIXELS: usize, const VERTICES: usize>
    Bench<'_, SET_UP, PIXELS, VERTICES>
{
    /// Lends the memory to a `program`.
    fn within(memory: &Shared<PIXELS>, program: impl FnOnce(Bench<'_, SET_UP, PIXELS, VERTICES>)) {
        critical_section::with(|token| {
            let memory = &mut memory.borrow_ref_mut(token);
            let words = &mut *WORDS.borrow_ref_mut(token);
            program(Bench { memory, words });
        });
    }

    /// A scene with depth `D`, in the modes that memory is enough for, and in both precisions.
    fn scene<D: Depth, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        mesh: &Mesh<'_>,
        shader: Sh,
        camera: &Camera,
    ) {
        let object = Object::new(mesh, shader);
        for mode in MODES.into_iter().filter(|mode| mode.pixels() <= PIXELS) {
            self.scene_in::<S4, D, _>([name, "S4"], mode, &object, camera);
            self.scene_in::<S8, D, _>([name, "S8"], mode, &object, camera);
        }
    }

    fn scene_in<S: Subpixel, D: Depth, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        [name, precision]: [&str; 2],
        Mode { name: mode, rows }: Mode,
        object: &Object<'_, Sh>,
        camera: &Camera,
    ) {
        let mode = [name, precision, mode];
        self.measure::<S, D, _, _>(mode, object, |cost, object, vertices, bins, memory| {
            let bins = (rows < SIZE.height).then_some(bins);
            cost.add(object, camera, rows, vertices, bins, memory);
        });
    }

    /// A scene without depth, from back to front, as a whole frame in both precisions.
    fn painted<Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        mesh: &Mesh<'_>,
        shader: Sh,
        camera: &Camera,
    ) {
        let whole = MODES[0];
        if whole.pixels() <= PIXELS {
            let object = Object::new(mesh, shader);
            self.painted_in::<S4, _>([name, "S4", whole.name], &object, camera);
            self.painted_in::<S8, _>([name, "S8", whole.name], &object, camera);
        }
    }

    fn painted_in<S: Subpixel, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        mode: [&str; 3],
        object: &Object<'_, Sh>,
        camera: &Camera,
    ) {
        self.measure::<S, NoDepth, _, _>(mode, object, |cost, object, vertices, order, memory| {
            cost.add_painted(object, camera, vertices, order, memory);
        });
    }

    /// A scene with depth in bands, without the vertices or the bins or both, in both precisions.
    fn frugal_bands<Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        mesh: &Mesh<'_>,
        shader: Sh,
        camera: &Camera,
    ) {
        let object = Object::new(mesh, shader);
        self.frugal_bands_in::<S4, _>(name, "S4", &object, camera);
        self.frugal_bands_in::<S8, _>(name, "S8", &object, camera);
    }

    fn frugal_bands_in<S: Subpixel, Sh: Shader<Color = Rgb565Be>>(
        &mut self,
        name: &str,
        precision: &str,
        object: &Object<'_, Sh>,
        camera: &Camera,
    ) {
        let mode = [name, precision, "bands of 16, vertices alone"];
        self.measure::<S, u16, _, _>(mode, object, |cost, object, vertices, _, memory| {
            cost.add(object, camera, BAND_ROWS, vertices, None, memory);
        });
        let mode = [name, precision, "bands of 16, bins alone"];
        self.measure::<S, u16, _, _>(mode, object, |cost, object, _, bins, memory| {
            cost.add_on_demand::<S, u16, _, PIXELS>(object, camera, BAND_ROWS, Some(bins), memory);
        });
        let mode = [name, precision, "bands of 16, neither"];
        self.measure::<S, u16, _, _>(mode, object, |cost, object, _, _, memory| {
            cost.add_on_demand::<S, u16, _, PIXELS>(object, camera, BAND_ROWS, None, memory);
        });
    }

    /// Adds frames by `add`, and prints a line.
    fn measure<S: Subpixel, D: Depth, Sh: Shader, M: scene::Mode>(
        &mut self,
        [scene, precision, mode]: [&str; 3],
        object: &Object<'_, Sh, M>,
        mut add: impl FnMut(
            &mut Cost<SET_UP>,
            &Object<'_, Sh, M>,
            &mut [ScreenVertex<S, D, OnScreen<Sh>>],
            &mut [u32],
            &mut Memory<PIXELS>,
        ),
    ) {
        let mut vertices = [ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; VERTICES];
        let mut cost = Cost::<SET_UP>::default();
        for frame in 0..FRAMES {
            let object = object.clone().posed(pose(frame));
            add(&mut cost, &object, &mut vertices, self.words, self.memory);
        }
        counter::report();
        console::line(format_args!(
            r#"{{"scene":"{scene}","precision":"{precision}","mode":"{mode}",{cost}}}"#
        ));
    }
}
