//! The scenes. Each but the first two differs from the one before it, or from [`GouraudS4`], in one
//! choice.

mod blended;
mod color;
mod fog;
mod frames;
mod light;
mod lines;
mod motion;
mod painter;
mod particles;
mod textured;

use core::hint::black_box;

use embedded_graphics_core::{
    pixelcolor::{Rgb565, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{ClipAll, ClipNone, Clipping, CullNone, Projection, ScreenVertex},
    mesh::Mesh,
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::{self, StoredDepth},
    scene::{Object, bin_words},
    shade::{Flat, Gouraud, Level, Light, Unlit},
};

pub use blended::{BlendedOver, BlendedSorted};
pub use color::{DitheredDirect, DitheredPacked};
pub use fog::{FogPixels, FogVertices, Matcap, VertexColors};
pub use frames::Bands;
use frames::{HEIGHT, ROWS, View, for_each_view, picture};
pub use light::{GlossyGouraud, GouraudLamp, Phong, PhongLamp};
pub use lines::{LinesDirect, LinesHidden, LinesSmooth, PointsDirect};
pub use motion::{
    GouraudAnyShape, GouraudFile, GouraudMorph, GouraudMoving, GouraudShaped, GouraudShapes,
};
pub use painter::PainterDirect;
pub use particles::ParticlesAdd;
pub use textured::{
    TexturedBilinear, TexturedDepth, TexturedDirect, TexturedGouraud, TexturedTrilinear,
};

use super::{Display, Scene};
#[cfg(models)]
use crate::models::SPOT;
use crate::models::{BALL, CUBE, SPHERE};
pub use crate::walk::Walk;

/// The pixels of a band of a picture of 240 columns.
const NARROW: usize = 240 * ROWS as usize;

const NEAR: Distance = Distance::lit("0.1");
const FAR: Distance = Distance::lit("100");

const PERSPECTIVE: Perspective = match Perspective::new(Turn::degrees(40), NEAR, FAR) {
    Ok(lens) => lens,
    Err(_) => panic!("the lens makes no sense"),
};
const ORTHOGRAPHIC: Orthographic = match Orthographic::new(Distance::lit("2.5"), NEAR, FAR) {
    Ok(lens) => lens,
    Err(_) => panic!("the lens makes no sense"),
};

// In constants, because a text that is read at run time brings the code to read it.
const SUN: Vec3 = Vec3::lit("-1", "2", "3");
const LIGHT: Light = Light::new(SUN, Level::lit("0.2"), Level::lit("0.8"));

const PICTURE: Rectangle = picture(240);

/// A model with light at its vertices and depth, in bands.
fn gouraud<P: Projection, S: Subpixel, D, const PIXELS: usize, const VERTICES: usize>(
    mesh: &'static Mesh<'static>,
    lens: P,
    clipping: impl Clipping,
    memory: &mut Bands<S, D, [u16; 1], PIXELS, VERTICES>,
    display: &mut Display,
) -> Option<()>
where
    D: StoredDepth,
{
    let gouraud = Gouraud::new(LIGHT);
    for_each_view(|view| {
        let camera = camera(view, lens, Bands::<S, D, [u16; 1], PIXELS, VERTICES>::PICTURE)?;
        let object = Object::new(mesh, gouraud).posed(view.pose()).clipped(clipping);
        memory.draw(&object, &camera, display)
    })
}

/// A camera that looks along -z.
fn camera<P: Projection>(view: &View, lens: P, picture: Rectangle) -> Option<Camera<P>> {
    Camera::at(view.eye, Rotation::IDENTITY, lens, picture).ok()
}

/// Nothing at all: the runtime that every other scene has too.
#[derive(Clone, Copy, Debug)]
pub struct Empty;

impl Scene for Empty {
    type Memory = ();

    const MEMORY: () = ();

    fn draw((): &mut (), _: &mut Display) -> Option<()> {
        Some(())
    }
}

/// Nothing but an array of [`BYTES`](Self::BYTES) on the stack, by which the measurement of the
/// stack is checked.
#[derive(Clone, Copy, Debug)]
pub struct Deep;

impl Deep {
    /// What it takes from the stack beyond what [`Empty`] does, but for a few words of a call.
    pub const BYTES: usize = 4096;
}

impl Scene for Deep {
    type Memory = ();

    const MEMORY: () = ();

    #[inline(never)]
    fn draw((): &mut (), _: &mut Display) -> Option<()> {
        black_box(&mut [0xFFu8; Self::BYTES]);
        Some(())
    }
}

/// A cube without light or depth, straight onto the display. Like the next two it is a small
/// display's only object, which its author keeps before the camera: nothing is clipped.
#[derive(Clone, Copy, Debug)]
pub struct UnlitDirect;

impl Scene for UnlitDirect {
    type Memory = Bands<S4, NoDepth, [u16; 0], 0, { CUBE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            let cube = Object::new(&CUBE, Unlit::new()).posed(view.pose()).clipped(ClipNone);
            memory.draw_directly(&cube, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// A lit cube without depth, straight onto the display.
#[derive(Clone, Copy, Debug)]
pub struct FlatDirect;

impl Scene for FlatDirect {
    type Memory = Bands<S4, NoDepth, [u16; 0], 0, { CUBE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let flat = Flat::new(LIGHT);
        for_each_view(|view| {
            let cube = Object::new(&CUBE, flat).posed(view.pose()).clipped(ClipNone);
            memory.draw_directly(&cube, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// The same in bands.
#[derive(Clone, Copy, Debug)]
pub struct FlatBands;

impl Scene for FlatBands {
    type Memory = Bands<S4, NoDepth, [u16; 0], NARROW, { CUBE.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let flat = Flat::new(LIGHT);
        for_each_view(|view| {
            let cube = Object::new(&CUBE, flat).posed(view.pose()).clipped(ClipNone);
            memory.draw_without_depth(&cube, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// A ball of 500 triangles, lit by the triangle, with depth, in bands.
#[derive(Clone, Copy, Debug)]
pub struct FlatDepth;

impl Scene for FlatDepth {
    type Memory = Bands<S4, u16, [u16; 0], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        let flat = Flat::new(LIGHT);
        for_each_view(|view| {
            let ball = Object::new(&BALL, flat).posed(view.pose());
            memory.draw(&ball, &camera(view, PERSPECTIVE, PICTURE)?, display)
        })
    }
}

/// The ball with light at its vertices and depth, in bands.
#[derive(Clone, Copy, Debug)]
pub struct GouraudS4;

impl Scene for GouraudS4 {
    type Memory = Bands<S4, u16, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, PERSPECTIVE, ClipAll, memory, display)
    }
}

/// The same with the triangles sorted into the bands.
#[derive(Clone, Copy, Debug)]
pub struct GouraudBinned;

/// What [`GouraudBinned`] draws with.
#[derive(Debug)]
pub struct Sorted {
    bands: Bands<S4, u16, [u16; 1], NARROW, { BALL.vertex_count() }>,
    bins: [u32; bin_words(BALL.triangle_count(), HEIGHT, ROWS)],
}

impl Scene for GouraudBinned {
    type Memory = Sorted;

    const MEMORY: Sorted =
        Sorted { bands: Bands::EMPTY, bins: [0; bin_words(BALL.triangle_count(), HEIGHT, ROWS)] };

    fn draw(memory: &mut Sorted, display: &mut Display) -> Option<()> {
        let gouraud = Gouraud::new(LIGHT);
        for_each_view(|view| {
            let object = Object::new(&BALL, gouraud).posed(view.pose());
            let camera = camera(view, PERSPECTIVE, PICTURE)?;
            memory.bands.draw_binned(&mut memory.bins, &object, &camera, display)
        })
    }
}

/// [`GouraudS4`] without clipping.
#[derive(Clone, Copy, Debug)]
pub struct GouraudUnclipped;

impl Scene for GouraudUnclipped {
    type Memory = Bands<S4, u16, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, PERSPECTIVE, ClipNone, memory, display)
    }
}

/// The same as [`GouraudS4`] with finer sub-pixels.
#[derive(Clone, Copy, Debug)]
pub struct GouraudS8;

impl Scene for GouraudS8 {
    type Memory = Bands<S8, u16, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, PERSPECTIVE, ClipAll, memory, display)
    }
}

/// The same as [`GouraudS4`] with finer depth.
#[derive(Clone, Copy, Debug)]
pub struct GouraudWide;

impl Scene for GouraudWide {
    type Memory = Bands<S4, u32, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, PERSPECTIVE, ClipAll, memory, display)
    }
}

/// The same as [`GouraudS4`] with depth that resolves at every distance alike.
#[derive(Clone, Copy, Debug)]
pub struct GouraudFloat;

impl Scene for GouraudFloat {
    type Memory = Bands<S4, FloatDepth, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, PERSPECTIVE, ClipAll, memory, display)
    }
}

/// The same as [`GouraudS4`] in a parallel projection.
#[derive(Clone, Copy, Debug)]
pub struct Parallel;

impl Scene for Parallel {
    type Memory = Bands<S4, u16, [u16; 1], NARROW, { BALL.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&BALL, ORTHOGRAPHIC, ClipAll, memory, display)
    }
}

/// The same as [`GouraudS4`] with a model of 5,856 triangles in a picture of 320 columns.
#[cfg(models)]
#[derive(Clone, Copy, Debug)]
pub struct Spot;

#[cfg(models)]
impl Scene for Spot {
    type Memory = Bands<S4, u16, [u16; 1], { 320 * ROWS as usize }, { SPOT.vertex_count() }>;

    const MEMORY: Self::Memory = Bands::EMPTY;

    fn draw(memory: &mut Self::Memory, display: &mut Display) -> Option<()> {
        gouraud(&SPOT, PERSPECTIVE, ClipAll, memory, display)
    }
}

/// Everything together: both projections, all ways to keep depth and to light, indices of both
/// widths.
#[derive(Clone, Copy, Debug)]
pub struct Everything;

/// What [`Everything`] draws with.
#[derive(Debug)]
pub struct Store {
    color: [Rgb565; NARROW],
    near: [u16; NARROW],
    wide: [u32; NARROW],
    smooth: [ScreenVertex<S8, u16, [u16; 1]>; SPHERE.vertex_count()],
    faceted: [ScreenVertex<S8, u16, [u16; 0]>; CUBE.vertex_count()],
    plain: [ScreenVertex<S8, u16, [u16; 0]>; BALL.vertex_count()],
    smooth_wide: [ScreenVertex<S4, u32, [u16; 1]>; SPHERE.vertex_count()],
    faceted_wide: [ScreenVertex<S4, u32, [u16; 0]>; CUBE.vertex_count()],
    convex: Bands<S4, NoDepth, [u16; 0], NARROW, { CUBE.vertex_count() }>,
}

impl Scene for Everything {
    type Memory = Store;

    const MEMORY: Store = Store {
        color: [Rgb565::BLACK; NARROW],
        near: [0; NARROW],
        wide: [0; NARROW],
        smooth: [ScreenVertex::EMPTY; SPHERE.vertex_count()],
        faceted: [ScreenVertex::EMPTY; CUBE.vertex_count()],
        plain: [ScreenVertex::EMPTY; BALL.vertex_count()],
        smooth_wide: [ScreenVertex::EMPTY; SPHERE.vertex_count()],
        faceted_wide: [ScreenVertex::EMPTY; CUBE.vertex_count()],
        convex: Bands::EMPTY,
    };

    fn draw(memory: &mut Store, display: &mut Display) -> Option<()> {
        for_each_view(|view| {
            memory.draw_in_perspective(view, display)?;
            memory.draw_convex(view, display)?;
            memory.draw_in_parallel(view, display)
        })
    }
}

/// One method for each picture.
// codegen: not inlined, so that a picture's stack is free again for the next.
impl Store {
    #[inline(never)]
    fn draw_in_perspective(&mut self, view: &View, display: &mut Display) -> Option<()> {
        let eye = camera(view, PERSPECTIVE, PICTURE)?;
        let smooth = Object::new(&SPHERE, Gouraud::new(LIGHT))
            .posed(view.pose())
            .project(&eye, &mut self.smooth);
        let faceted = Object::new(&CUBE, Flat::new(LIGHT))
            .posed(view.pose().at(Vec3::X))
            .project(&eye, &mut self.faceted);
        let plain =
            Object::new(&BALL, Unlit::new()).culled(CullNone).project(&eye, &mut self.plain);
        let (Ok(smooth), Ok(faceted), Ok(plain)) = (&smooth, &faceted, &plain) else { return None };
        let mut bands = output::Bands::new(PICTURE, &mut self.color, &mut self.near).ok()?;
        let shown = bands.show(
            display,
            |band| band.clear_color(Rgb565::BLACK),
            |band| {
                smooth.draw(band)?;
                faceted.draw(band)?;
                plain.draw(band)
            },
        );
        shown.ok()
    }

    #[inline(never)]
    fn draw_convex(&mut self, view: &View, display: &mut Display) -> Option<()> {
        let eye = camera(view, PERSPECTIVE, PICTURE)?;
        let lit = Object::new(&CUBE, Flat::new(LIGHT)).posed(view.pose().at(Vec3::X));
        self.convex.draw_without_depth(&lit, &eye, display)?;
        let bare = Object::new(&CUBE, Unlit::new()).posed(view.pose());
        self.convex.draw_directly(&bare, &eye, display)
    }

    #[inline(never)]
    fn draw_in_parallel(&mut self, view: &View, display: &mut Display) -> Option<()> {
        let eye = camera(view, ORTHOGRAPHIC, PICTURE)?;
        let smooth = Object::new(&SPHERE, Gouraud::new(LIGHT))
            .posed(view.pose())
            .project(&eye, &mut self.smooth_wide);
        let faceted = Object::new(&CUBE, Flat::new(LIGHT))
            .posed(view.pose().at(Vec3::X))
            .culled(CullNone)
            .project(&eye, &mut self.faceted_wide);
        let (Ok(smooth), Ok(faceted)) = (&smooth, &faceted) else { return None };
        let mut bands = output::Bands::new(PICTURE, &mut self.color, &mut self.wide).ok()?;
        let shown = bands.show(
            display,
            |band| band.clear_color(Rgb565::BLACK),
            |band| {
                smooth.draw(band)?;
                faceted.draw(band)
            },
        );
        shown.ok()
    }
}
