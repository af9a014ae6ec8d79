//! One picture in many targets: whole frames, bands, parts of the display, no buffer at all, and displays that fail.

use embedded_graphics::{
    pixelcolor::{Bgr565, BinaryColor, Gray8, PixelColor, Rgb565, Rgb888, RgbColor},
    primitives::Rectangle,
};
use fixed::types::U16F16;
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{NoDepth, S8, ScreenVertex},
    mesh::{Material, Mesh},
    numbers::{Angle, Rotation, Vec3},
    scene::{DrawError, Object},
    shade::{Gouraud, Level, Light, MeshVertex, Shader, Unlit},
    target::{Direct, Frame, FrameError},
};
use rasterizer_tests::{BusError, Call, Counter, Picture, Recorder, Surface, area};

const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);
const DISPLAY: Rectangle = area(0, 0, 61, 47);

/// A user's own shader: the position is the colour.
#[derive(Clone, Debug)]
struct Position;

impl Shader for Position {
    type Color = Rgb888;
    type Varyings = [u16; 3];
    type Surface = ();

    fn surface(&self, _: &Material) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 3] {
        vertex.position().map(|c| c as u16 ^ 0x8000)
    }

    fn pixel(&self, (): &(), position: [U16F16; 3]) -> Rgb888 {
        let [red, green, blue] = position.map(|c| (c.to_bits() >> 24) as u8);
        Rgb888::new(red, green, blue)
    }
}

fn gouraud<C: PixelColor + From<Rgb888>>() -> Gouraud<C> {
    Gouraud::new(Light::new(
        Vec3::lit("1", "2", "3"),
        Level::lit("0.2"),
        Level::lit("0.8"),
    ))
}

fn ball() -> Surface {
    Surface::ball(16_384, 7).scaled(-14).with_vertex_normals()
}

/// From 0.2 units before the ball, so that some of it is cut by the near plane and the picture's edges.
fn camera(viewport: Rectangle) -> Camera<Perspective> {
    let lens = Perspective::new(Angle::degrees(70), Distance::lit("0.25"), Distance::lit("10")).unwrap();
    Camera::at(Vec3::lit("0.1", "0.2", "1.7"), Rotation::about_x(-Angle::degrees(8)), lens, viewport).unwrap()
}

/// A picture of a ball, and how many of its pixels show it.
fn whole<Sh: Shader<Color = Rgb888>>(mesh: &Mesh<'_>, shader: Sh) -> Picture<Rgb888, u16> {
    let mut picture = Picture::empty(DISPLAY, BACKGROUND);
    picture.draw(mesh, shader, &camera(DISPLAY));
    let covered = picture.color.iter().filter(|&&color| color != BACKGROUND).count();
    assert!(covered > 1000, "only {covered} pixels show the ball");
    picture
}

fn bands_equal_the_frame<Sh: Shader<Color = Rgb888>>(shader: &Sh) {
    let ball = ball();
    let mesh = ball.mesh();
    let whole = whole(&mesh, shader.clone());
    let mut storage = vec![ScreenVertex::<S8, u16, Sh::Varyings>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, shader.clone());
    let projected = object.project(&camera(DISPLAY), &mut storage).unwrap();
    for height in 1..=DISPLAY.size.height {
        for top in (0..DISPLAY.size.height).step_by(height as usize) {
            // The last band may reach below the picture.
            let mut band = Picture::empty(area(0, top as i32, DISPLAY.size.width, height), BACKGROUND);
            let mut frame = Frame::new(&mut band.color, &mut band.depth, band.area).unwrap();
            let Ok(()) = projected.draw(&mut frame);
            assert!(band == whole.crop(band.area, BACKGROUND), "{height} rows from {top}");
        }
    }
}

#[test]
fn bands_of_any_height_equal_the_whole_frame() {
    bands_equal_the_frame(&Unlit::new());
    bands_equal_the_frame(&gouraud());
    bands_equal_the_frame(&Position);
}

/// Frames of parts of the display, also beyond its edges; what the object does not cover keeps its colour and depth.
#[test]
fn parts_equal_the_same_part_of_the_whole_frame() {
    let ball = ball();
    let mesh = ball.mesh();
    let whole = whole(&mesh, Position);
    for part in [
        area(10, 5, 20, 30),
        area(-5, -9, 20, 30),
        area(50, 40, 30, 30),
        area(-100, -100, 300, 300),
        area(30, 20, 1, 1),
        area(0, 20, 61, 1),
        area(-40, 0, 20, 20),
        area(61, 0, 20, 47),
        area(7, 9, 0, 5),
    ] {
        let mut picture = Picture::<_, u16>::empty(part, BACKGROUND);
        picture.draw(&mesh, Position, &camera(DISPLAY));
        assert!(picture == whole.crop(part, BACKGROUND), "{part:?}");
    }
}

/// The viewport moves on the display, over its edges too, and takes the picture along.
#[test]
fn viewports_carry_their_picture() {
    let ball = ball();
    let mesh = ball.mesh();
    let whole = whole(&mesh, Position);
    for (x, y) in [(0, 0), (20, 11), (-13, -30), (40, -20), (300, 0), (-61, 5)] {
        let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
        let viewport = area(x, y, DISPLAY.size.width, DISPLAY.size.height);
        picture.draw(&mesh, Position, &camera(viewport));
        let moved = Picture { area: viewport, ..whole.clone() };
        assert!(picture == moved.crop(DISPLAY, BACKGROUND), "({x}, {y})");
    }
}

/// An object that fills the display stays in a viewport in the middle of it.
#[test]
fn nothing_is_drawn_beside_the_viewport() {
    let cube = Surface::cube(10_000, 2);
    let mesh = cube.mesh();
    let viewport = area(9, 8, 20, 15);
    let lens = Perspective::new(Angle::degrees(70), Distance::lit("0.25"), Distance::lit("60000")).unwrap();
    let camera = Camera::at(Vec3::lit("0", "0", "10100"), Rotation::IDENTITY, lens, viewport).unwrap();
    let mut picture = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
    picture.draw(&mesh, Unlit::new(), &camera);
    for (index, (&color, &depth)) in picture.color.iter().zip(&picture.depth).enumerate() {
        let point = embedded_graphics::geometry::Point::new(index as i32 % 61, index as i32 / 61);
        let is_drawn = color != BACKGROUND;
        assert_eq!((is_drawn, depth != 0), (viewport.contains(point), is_drawn), "{point}");
    }
}

/// A convex body without its back faces needs no depth: three kinds of target, one picture. The depth test may let a
/// pixel go to either of two triangles nowhere, as no two cover it.
#[test]
fn targets_agree_on_a_convex_body() {
    let ball = ball();
    let mesh = ball.mesh();
    let whole = whole(&mesh, Position);

    let mut wide = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
    wide.draw(&mesh, Position, &camera(DISPLAY));
    assert_eq!(wide.color, whole.color);
    let covered = |is_covered: Vec<bool>| is_covered;
    assert_eq!(
        covered(wide.depth.iter().map(|&d| d != 0).collect()),
        covered(whole.depth.iter().map(|&d| d != 0).collect())
    );

    let mut storage = vec![ScreenVertex::<S8, NoDepth, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, Position);
    let mut colors = vec![BACKGROUND; whole.color.len()];
    let mut frame = Frame::without_depth(&mut colors, DISPLAY).unwrap();
    object.draw(&camera(DISPLAY), &mut storage, &mut frame).unwrap();
    assert_eq!(colors, whole.color);

    let mut colors = vec![BACKGROUND; whole.color.len()];
    let mut display = Frame::without_depth(&mut colors, DISPLAY).map(Display).unwrap();
    object.draw(&camera(DISPLAY), &mut storage, &mut Direct::new(&mut display)).unwrap();
    assert_eq!(colors, whole.color);
}

/// A display of pixels in memory.
struct Display<'a>(Frame<'a, Rgb888, NoDepth>);
