//! Frames and their hashes.

mod colors;

use core::convert::Infallible;

use embedded_graphics_core::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    pixelcolor::{IntoStorage, Rgb565},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{EveryPixel, FloatDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    color::Alpha,
    fixed::types::I8F24,
    geometry::{CullNone, Pose, Projection, ScreenVertex},
    mesh::{Mesh, MeshVertex},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::{
        Add, Bands, Blending, Frame, KeepDepth, Multiply, Over, Replace, Rgb565Be, Screen,
        StoredDepth,
    },
    scene::{Mode, Object, bin_words},
    shade::{
        AtVertices, Colored, ColoredGouraud, Density, Faded, Flat, Fog, Fogged, GlossyGouraud,
        Gouraud, Level, Light, Matcap, OnScreen, Phong, Shader, Textured, TexturedFlat,
        TexturedGouraud,
    },
    texture::{Bilinear, Offset, PerPixel, Trilinear},
};

use crate::{
    console,
    cost::fail,
    hash::hash,
    memory::Memory,
    models, shiny,
    stage::{LAMP, sun},
};

/// Width and height of the frames: 160 KB of colour and depth.
pub const SIDE: u32 = 200;
/// Their pixels.
pub const PIXELS: usize = (SIDE * SIDE) as usize;
/// Vertices of the largest model.
const VERTICES: usize = 1800;
/// Triangles of the largest model.
const TRIANGLES: usize = 1700;
/// Rows of a band; the last one is shorter.
const ROWS: u32 = 24;
const BACKGROUND: Rgb565 = Rgb565::new(1, 2, 3);
const AREA: Rectangle = Rectangle::new(Point::zero(), Size::new(SIDE, SIDE));
const LENS: Perspective =
    match Perspective::new(Turn::degrees(40), Distance::lit("0.02"), Distance::lit("100")) {
        Ok(lens) => lens,
        Err(_) => panic!("the lens makes no sense"),
    };
const PARALLEL: Orthographic =
    match Orthographic::new(Distance::lit("2.2"), Distance::lit("0.5"), Distance::lit("9")) {
        Ok(lens) => lens,
        Err(_) => panic!("the lens makes no sense"),
    };

/// Draws all frames, each as a whole and again in bands, and prints a line for each.
pub fn run(memory: &mut Memory<PIXELS>) {
    let light = sun();
    let gouraud = Gouraud::<Rgb565Be>::new(light);
    let gear = Object::new(&models::GEAR, gouraud);
    let rocket = Object::new(&models::ROCKET, gouraud);
    let knot = Object::new(&models::TORUS_KNOT, gouraud);
    for frame in 0..4 {
        let pose = Pose::rotated(
            Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::fraction(frame, 4)),
        );
        // Filling the picture; with the surface through the near plane; from inside.
        for (view, distance) in [("near", "3"), ("cut", "0.9"), ("inside", "0.05")] {
            let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
                .unwrap_or_else(fail);
            report(("gear", view, frame), &gear.posed(pose), &camera, memory);
            report(("rocket", view, frame), &rocket.posed(pose), &camera, memory);
            report(("torus_knot", view, frame), &knot.posed(pose), &camera, memory);
        }
        let camera = Camera::at(Vec3::lit("0", "0", "3"), Rotation::IDENTITY, PARALLEL, AREA)
            .unwrap_or_else(fail);
        report(("rocket", "parallel", frame), &rocket.posed(pose), &camera, memory);
    }
    flat(memory, light);
    floating_depth(&knot, memory);
    textured(memory, light);
    lit(memory, light);
    colors::dithered(memory, light);
    fog(memory, light);
    blended(memory, light);
}

/// Several lights, a lamp, and highlights at vertices and pixels: each in one precision.
fn lit(memory: &mut Memory<PIXELS>, light: Light) {
    let fill = Light::new(Vec3::lit("2", "-1", "1"), Level::ZERO, Level::lit("0.4"));
    let all = ([light, fill], LAMP);
    lit_with::<S4, _>("gouraud lamp S4", Gouraud::new(all), memory);
    lit_with::<S8, _>("glossy gouraud S8", GlossyGouraud::new(light), memory);
    lit_with::<S4, _>("phong S4", Phong::new(light), memory);
    lit_with::<S8, _>("phong lamp S8", Phong::new(all), memory);
    lit_with::<S4, _>("phong near S4", Phong::new(light).with_near_viewer(), memory);
}

/// Filling the picture, with the surface through the near plane, and from inside.
fn lit_with<S: Subpixel, Sh: Shader<Color = Rgb565Be>>(
    name: &str,
    shader: Sh,
    memory: &mut Memory<PIXELS>,
) {
    let pose = Pose::rotated(Rotation::about_x(Turn::degrees(25)));
    let sphere = Object::new(&shiny::SPHERE, shader).posed(pose).culled(CullNone);
    for (view, distance) in [("near", "3"), ("cut", "0.9"), ("inside", "0.05")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let [hash, _] =
            draw::<_, S, u16, _, _, { models::SPHERE.vertex_count() }>(&sphere, &camera, memory);
        console::line(format_args!("sphere {view} {name} {hash:08x}"));
    }
}

/// The gear as a body seen through itself, in each mode, sorted from back to front.
fn blended(memory: &mut Memory<PIXELS>, light: Light) {
    const PART: Alpha = Alpha::lit("0.4");
    let gouraud = Gouraud::new(light);
    blended_by("over", gouraud, KeepDepth(Over(PART)), memory);
    blended_by("add", gouraud, KeepDepth(Add(PART)), memory);
    blended_by("multiply", gouraud, Multiply(PART), memory);
    blended_by("screen", gouraud, Screen(PART), memory);
    let faded = Faded::new(gouraud, |vertex: &MeshVertex<'_>| {
        let [x, ..] = vertex.position();
        Alpha::from_bits(((i32::from(x) + 32_768) >> 8) as u16)
    });
    blended_by("over by vertex", faded, KeepDepth(Over(Alpha::OPAQUE)), memory);
}

/// Whole from stored vertices in one precision, and again in bands from vertices on demand.
fn blended_by<Sh, B>(name: &str, shader: Sh, blending: B, memory: &mut Memory<PIXELS>)
where
    Sh: Shader<Color = Rgb565Be>,
    B: for<'f, 'd> Blending<Frame<'f, Rgb565Be, &'d mut [u16]>>,
{
    const TRIANGLES: usize = models::GEAR.triangle_count();
    let pose = Pose::rotated(Rotation::about_x(Turn::degrees(25)));
    let gear = Object::new(&models::GEAR, shader).posed(pose).culled(CullNone).blended(blending);
    let mut vertices = [ScreenVertex::<S4, u16, OnScreen<Sh>>::EMPTY; models::GEAR.vertex_count()];
    let mut order = [0; TRIANGLES];
    let Memory { color, depth } = memory;
    for (view, distance) in [("near", "3"), ("cut", "0.9"), ("inside", "0.05")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let seen = gear.project(&camera, &mut vertices).unwrap_or_else(fail);
        let seen = seen.back_to_front(&mut order).unwrap_or_else(fail);
        let mut frame = Frame::new(color, depth, AREA).unwrap_or_else(fail);
        frame.clear(BACKGROUND.into());
        let Ok(()) = seen.draw(&mut frame);
        let whole = hash_of(0, frame.pixels());

        let walked = gear.project_on_demand(&camera, S4).unwrap_or_else(fail);
        let walked = walked.back_to_front(&mut order).unwrap_or_else(fail);
        let pixels = (SIDE * ROWS) as usize;
        let mut bands =
            Bands::new(AREA, &mut color[..pixels], &mut depth[..pixels]).unwrap_or_else(fail);
        let mut display = Hashing(0);
        let background =
            |band: &mut Frame<'_, Rgb565Be, &mut [u16]>| band.clear_color(BACKGROUND.into());
        let Ok(()) = bands.show(&mut display, background, |band| walked.draw(band));
        assert_eq!(whole, display.0, "blended bands differ from the whole frame");
        console::line(format_args!("gear {view} blended {name} S4 {whole:08x}"));
    }
}

/// The textured cube: stored, filtered, corrected and lit in several ways, each in one precision.
fn textured(memory: &mut Memory<PIXELS>, light: Light) {
    use models::{CUBE_TEXTURE_MIPS_TEXTURES as MIPS, CUBE_TEXTURE_TEXTURES as DIRECT};
    let nearest = Textured::new(&models::CUBE_TEXTURE_8_TEXTURES);
    textured_with::<S4, _>("nearest S4", nearest, memory);
    textured_with::<S8, _>("nearest S8", nearest, memory);
    let bilinear = Textured::new(&DIRECT).filtered(Bilinear).corrected(EveryPixel);
    textured_with::<S8, _>("bilinear every pixel S8", bilinear, memory);
    let trilinear = Textured::new(&MIPS).filtered(Trilinear(PerPixel));
    textured_with::<S4, _>("trilinear S4", trilinear, memory);
    textured_with::<S4, _>("flat S4", TexturedFlat::new(&DIRECT, light), memory);
    textured_with::<S8, _>("gouraud S8", TexturedGouraud::new(&DIRECT, light), memory);
}

/// Fog over light and over textures, colours of vertices, a matcap, and a texture that is moved.
fn fog(memory: &mut Memory<PIXELS>, light: Light) {
    use models::{COLORED_SPHERE, CUBE_TEXTURE, CUBE_TEXTURE_TEXTURES as SIDES};
    let gouraud = Fogged::new(Gouraud::new(light), &MIST, FOG);
    shaded_with::<S4, _>("torus_knot", &models::TORUS_KNOT, "fog S4", gouraud, memory);
    let by_vertex = gouraud.computed(AtVertices);
    shaded_with::<S8, _>("torus_knot", &models::TORUS_KNOT, "fog by vertex S8", by_vertex, memory);
    let textured = Fogged::new(Textured::new(&SIDES), &HAZE, FOG);
    shaded_with::<S8, _>("cube", &CUBE_TEXTURE, "texture in fog S8", textured, memory);
    let textured = textured.computed(AtVertices);
    shaded_with::<S4, _>("cube", &CUBE_TEXTURE, "texture in fog by vertex S4", textured, memory);
    shaded_with::<S4, _>("cube", &models::CUBE, "flat in fog S4", flat_in_fog(light), memory);
    shaded_with::<S4, _>("sphere", &COLORED_SPHERE, "vertex colors S4", Colored::new(), memory);
    let lit = ColoredGouraud::new(light).corrected(EveryPixel);
    shaded_with::<S8, _>("sphere", &COLORED_SPHERE, "vertex colors lit S8", lit, memory);
    let matcap = Matcap::new(&SIDES).filtered(Bilinear);
    shaded_with::<S4, _>("sphere", &models::SPHERE, "matcap S4", matcap, memory);
    let [side] = SIDES;
    let moved = [Offset::new(side, [I8F24::lit("0.3"), I8F24::lit("-0.7")])];
    shaded_with::<S4, _>("cube", &CUBE_TEXTURE, "texture moved S4", Textured::new(&moved), memory);
}

const fn flat_in_fog(light: Light) -> Fogged<'static, Flat<Rgb565Be>> {
    Fogged::new(Flat::new(light), &MIST, FOG)
}

static MIST: Fog = Fog::linear(Distance::lit("0.3"), Distance::lit("4")).unwrap();
static HAZE: Fog = Fog::exponential(Density::lit("0.35"));
const FOG: Rgb565Be = Rgb565Be::new(20, 44, 26);

/// The same four views of any model.
fn shaded_with<S: Subpixel, Sh: Shader<Color = Rgb565Be>>(
    model: &str,
    mesh: &Mesh<'_>,
    name: &str,
    shader: Sh,
    memory: &mut Memory<PIXELS>,
) {
    let pose =
        Pose::rotated(Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::degrees(35)));
    let object = Object::new(mesh, shader).posed(pose).culled(CullNone);
    for (view, distance) in [("far", "5"), ("near", "3"), ("cut", "0.7"), ("inside", "0.05")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let [hash, _] = draw::<_, S, u16, _, _, VERTICES>(&object, &camera, memory);
        console::line(format_args!("{model} {view} {name} {hash:08x}"));
    }
}

/// Far away, filling the picture, with a side through the near plane, and from inside.
fn textured_with<S: Subpixel, Sh: Shader<Color = Rgb565Be>>(
    name: &str,
    shader: Sh,
    memory: &mut Memory<PIXELS>,
) {
    let pose =
        Pose::rotated(Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::degrees(35)));
    // From inside, the back of its sides is seen.
    let cube = Object::new(&models::CUBE_TEXTURE, shader).posed(pose).culled(CullNone);
    let mut last = 0;
    for (view, distance) in [("far", "15"), ("near", "3"), ("cut", "0.7"), ("inside", "0.05")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let [hash, _] = draw::<_, S, u16, _, _, { models::CUBE_TEXTURE.vertex_count() }>(
            &cube, &camera, memory,
        );
        assert_ne!(hash, last, "two views show the same");
        last = hash;
        console::line(format_args!("cube {view} textured {name} {hash:08x}"));
    }
}

/// Depth in floating point, from near to far, with the hash of the depths too.
fn floating_depth<Sh: Shader<Color = Rgb565Be, Varyings = [u16; 1]>>(
    object: &Object<'_, Sh>,
    memory: &mut Memory<PIXELS>,
) {
    let pose = Pose::rotated(Rotation::about_x(Turn::degrees(25)));
    for (view, distance) in [("near", "3"), ("cut", "0.9"), ("inside", "0.05"), ("far", "40")] {
        let camera = Camera::at(Vec3::lit("0", "0", distance), Rotation::IDENTITY, LENS, AREA)
            .unwrap_or_else(fail);
        let object = object.clone().posed(pose);
        let [coarse, coarse_depth] =
            draw::<_, S4, FloatDepth, _, _, VERTICES>(&object, &camera, memory);
        let [fine, fine_depth] =
            draw::<_, S8, FloatDepth, _, _, VERTICES>(&object, &camera, memory);
        console::line(format_args!(
            "torus_knot {view} float16 S4 {coarse:08x} {coarse_depth:08x} S8 {fine:08x} \
             {fine_depth:08x}"
        ));
    }
}

/// A convex body, straight into memory without depth, lit by the normals of its triangles.
fn flat(memory: &mut Memory<PIXELS>, light: Light) {
    let camera =
        Camera::at(Vec3::lit("0", "0", "4"), Rotation::IDENTITY, LENS, AREA).unwrap_or_else(fail);
    let mut vertices = [ScreenVertex::<S4, _, _>::EMPTY; models::CUBE.vertex_count()];
    let pose =
        Pose::rotated(Rotation::about_x(Turn::degrees(30)) * Rotation::about_y(Turn::degrees(40)));
    let cube = Object::new(&models::CUBE, Flat::<Rgb565Be>::new(light)).posed(pose);
    let mut frame = Frame::without_depth(&mut memory.color, AREA).unwrap_or_else(fail);
    frame.clear(Rgb565Be::BLACK);
    cube.draw(&camera, &mut vertices, &mut frame).unwrap_or_else(fail);
    console::line(format_args!("cube flat {:08x}", hash_of(0, frame.pixels())));
}

fn report<P: Projection, Sh: Shader<Color = Rgb565Be, Varyings = [u16; 1]>>(
    name: (&str, &str, u32),
    object: &Object<'_, Sh>,
    camera: &Camera<P>,
    memory: &mut Memory<PIXELS>,
) {
    let (model, view, frame) = name;
    let [coarse, _] = draw::<_, S4, u16, _, _, VERTICES>(object, camera, memory);
    let [fine, _] = draw::<_, S8, u16, _, _, VERTICES>(object, camera, memory);
    console::line(format_args!("{model} {view} {frame} S4 {coarse:08x} S8 {fine:08x}"));
}

/// Draws a frame as a whole, again in bands, and again without storage for vertices, and checks
/// that they are the same. Returns the hashes of its colours and of its depths. The model has at
/// most `VERTICES` vertices.
fn draw<
    P: Projection,
    S: Subpixel,
    D: StoredDepth,
    Sh: Shader<Color = Rgb565Be>,
    M: Mode<Blending = Replace>,
    const VERTICES: usize,
>(
    object: &Object<'_, Sh, M>,
    camera: &Camera<P>,
    memory: &mut Memory<PIXELS>,
) -> [u32; 2] {
    let Memory { color, depth } = memory;
    let depth: &mut [D] = bytemuck::must_cast_slice_mut(depth);
    let mut vertices = [ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; VERTICES];
    let seen = object.project(camera, &mut vertices).unwrap_or_else(fail);
    let mut frame = Frame::new(color, depth, AREA).unwrap_or_else(fail);
    frame.clear(BACKGROUND.into());
    let Ok(()) = seen.draw(&mut frame);
    let whole = hash_of(0, frame.pixels());
    let depths = hash(0, bytemuck::must_cast_slice(depth).iter().copied());

    let pixels = (SIDE * ROWS) as usize;
    let mut bands =
        Bands::new(AREA, &mut color[..pixels], &mut depth[..pixels]).unwrap_or_else(fail);
    let mut bins = [0; bin_words(TRIANGLES, SIDE, ROWS)];
    let background = |band: &mut Frame<'_, Rgb565Be, &mut [D]>| band.clear_color(BACKGROUND.into());
    let mut display = Hashing(0);
    let binned = seen.binned(ROWS, &mut bins).unwrap_or_else(fail);
    let Ok(()) = bands.show(&mut display, background, |band| binned.draw(band));
    assert_eq!(whole, display.0, "bands differ from the whole frame");

    let mut display = Hashing(0);
    let walked = object.project_on_demand(camera, S::default()).unwrap_or_else(fail);
    let walked = walked.binned(ROWS, &mut bins).unwrap_or_else(fail);
    let Ok(()) = bands.show(&mut display, background, |band| walked.draw(band));
    assert_eq!(whole, display.0, "without storage for vertices the frame differs");
    [whole, depths]
}

/// A display that keeps the hash of its pixels.
struct Hashing(u32);

impl OriginDimensions for Hashing {
    fn size(&self) -> Size {
        AREA.size
    }
}

impl DrawTarget for Hashing {
    type Color = Rgb565Be;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb565Be>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.fill_contiguous(&AREA, pixels.into_iter().map(|pixel| pixel.1))
    }

    fn fill_contiguous<I: IntoIterator<Item = Rgb565Be>>(
        &mut self,
        _: &Rectangle,
        colors: I,
    ) -> Result<(), Infallible> {
        self.0 = colors.into_iter().fold(self.0, |before, pixel| hash_of(before, &[pixel]));
        Ok(())
    }
}

/// The hash of the pixels' values.
fn hash_of(before: u32, pixels: &[Rgb565Be]) -> u32 {
    hash(before, pixels.iter().map(|&pixel| Rgb565::from(pixel).into_storage()))
}
