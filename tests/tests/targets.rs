//! One picture in many targets: whole frames, bands, parts of the display, displays without a
//! buffer, and displays that fail.

use embedded_graphics::{
    geometry::Point,
    mock_display::MockDisplay,
    pixelcolor::{Bgr565, BinaryColor, Gray8, Rgb565, Rgb888, RgbColor},
    primitives::{PointsIter, Rectangle},
};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Perspective},
    geometry::ScreenVertex,
    mesh::Mesh,
    numbers::{Rotation, S8, Turn, Vec3},
    output::{Direct, Frame, FrameError, StoredColor},
    scene::{DrawError, Object},
    shade::{Gouraud, Level, Light, OnScreen, Shader, Unlit},
};
use rasterizer_tests::{BusError, Call, Picture, Recorder, Surface, area, bands::Position};

const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);
const DISPLAY: Rectangle = area(0, 0, 61, 47);

const fn gouraud<C: From<Rgb888>>() -> Gouraud<C> {
    Gouraud::new(Light::new(Vec3::lit("1", "2", "3"), Level::lit("0.2"), Level::lit("0.8")))
}

fn ball() -> Surface {
    Surface::ball(16_384, 7).scaled(-14).with_vertex_normals().colored([250, 220, 150])
}

/// A camera close to the ball: the near plane and the picture's edges cut some of it.
fn camera(viewport: Rectangle) -> Camera<Perspective> {
    let lens =
        Perspective::new(Turn::degrees(70), Distance::lit("0.25"), Distance::lit("10")).unwrap();
    Camera::at(Vec3::lit("0.1", "0.2", "1.7"), Rotation::about_x(-Turn::degrees(8)), lens, viewport)
        .unwrap()
}

/// The picture of a ball that covers more than 1,000 pixels.
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
    let mut storage = vec![ScreenVertex::<S8, u16, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, shader.clone());
    let projected = object.project(&camera(DISPLAY), &mut storage).unwrap();
    for height in 1..=DISPLAY.size.height {
        for top in (0..DISPLAY.size.height).step_by(height as usize) {
            // The last band may reach below the picture.
            let mut band =
                Picture::empty(area(0, top as i32, DISPLAY.size.width, height), BACKGROUND);
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

/// Frames of parts of the display, also beyond its edges. Pixels that the object does not cover
/// keep their colour and depth.
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

/// The picture moves with its viewport, also over the display's edges.
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
    let lens =
        Perspective::new(Turn::degrees(70), Distance::lit("600"), Distance::lit("60000")).unwrap();
    let camera =
        Camera::at(Vec3::lit("0", "0", "11000"), Rotation::IDENTITY, lens, viewport).unwrap();
    let mut picture = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
    picture.draw(&mesh, Unlit::new(), &camera);
    for (index, (&color, &depth)) in picture.color.iter().zip(&picture.depth).enumerate() {
        let point = Point::new(index as i32 % 61, index as i32 / 61);
        let is_drawn = color != BACKGROUND;
        assert_eq!((is_drawn, depth != 0), (viewport.contains(point), is_drawn), "{point}");
    }
}

/// A convex body without its back faces needs no depth, so four kinds of target show one picture.
#[test]
fn targets_agree_on_a_convex_body() {
    let cube = Surface::cube(16_384, 1).scaled(-14);
    let mesh = cube.mesh();
    let whole = whole(&mesh, Position);

    let mut wide = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
    wide.draw(&mesh, Position, &camera(DISPLAY));
    assert_eq!(wide.color, whole.color);
    let is_covered = wide.depth.iter().map(|&depth| depth != 0);
    assert!(is_covered.eq(whole.depth.iter().map(|&depth| depth != 0)));

    let mut storage = vec![ScreenVertex::<S8, NoDepth, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, Position);
    let mut colors = vec![BACKGROUND; whole.color.len()];
    let mut frame = Frame::without_depth(&mut colors, DISPLAY).unwrap();
    object.draw(&camera(DISPLAY), &mut storage, &mut frame).unwrap();
    assert_eq!(colors, whole.color);

    // This display panics if a pixel is drawn twice.
    let mut display = MockDisplay::<Rgb888>::new();
    object.draw(&camera(DISPLAY), &mut storage, &mut Direct::new(&mut display)).unwrap();
    for (point, &color) in DISPLAY.points().zip(&whole.color) {
        assert_eq!(display.get_pixel(point).unwrap_or(BACKGROUND), color, "{point}");
    }
}

/// The memory before and after a frame's part of it does not change.
#[test]
fn memory_round_a_frame_is_left_alone() {
    let ball = ball();
    let mesh = ball.mesh();
    let whole = whole(&mesh, Position);
    let pixels = whole.color.len();
    let (mut color, mut depth) = (vec![BACKGROUND; pixels + 200], vec![0u32; pixels + 200]);
    color[..100].fill(Rgb888::RED);
    color[pixels + 100..].fill(Rgb888::RED);
    let mut frame =
        Frame::new(&mut color[100..pixels + 100], &mut depth[100..pixels + 100], DISPLAY).unwrap();
    let mut storage = vec![ScreenVertex::<S8, u32, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, Position);
    object.draw(&camera(DISPLAY), &mut storage, &mut frame).unwrap();
    assert_eq!(frame.pixels(), whole.color);
    for side in [0..100, pixels + 100..pixels + 200] {
        assert!(color[side.clone()].iter().all(|&color| color == Rgb888::RED));
        assert!(depth[side].iter().all(|&depth| depth == 0));
    }
}

#[test]
fn frames_need_memory_of_their_size() {
    let (mut color, mut depth) = ([BACKGROUND; 12], [0u16; 12]);
    let mut frame = |colors: usize, depths: usize, width: u32| {
        let frame = Frame::new(&mut color[..colors], &mut depth[..depths], area(5, -5, width, 3));
        frame.map(|frame| frame.area())
    };
    assert_eq!(frame(12, 12, 4), Ok(area(5, -5, 4, 3)));
    assert_eq!(frame(11, 12, 4), Err(FrameError::ColorLength { needed: 12 }));
    assert_eq!(frame(12, 9, 3), Err(FrameError::ColorLength { needed: 9 }));
    assert_eq!(frame(12, 11, 4), Err(FrameError::DepthLength { needed: 12 }));
    assert_eq!(frame(9, 12, 3), Err(FrameError::DepthLength { needed: 9 }));
    assert_eq!(frame(0, 0, 0), Ok(area(5, -5, 0, 3)));
    let without = Frame::without_depth(&mut color, area(0, 0, 3, 3)).map(|frame| frame.area());
    assert_eq!(without, Err(FrameError::ColorLength { needed: 9 }));
    assert_eq!(
        FrameError::ColorLength { needed: 9 }.to_string(),
        "the colour buffer must have 9 pixels"
    );
    assert_eq!(
        FrameError::DepthLength { needed: 9 }.to_string(),
        "the depth buffer must have 9 cells"
    );
}

#[test]
fn cleared_frames_are_drawn_on_afresh() {
    let ball = ball();
    let mesh = ball.mesh();
    let once = whole(&mesh, Position);
    let mut again = once.clone();
    let mut frame = Frame::new(&mut again.color, &mut again.depth, DISPLAY).unwrap();
    frame.clear(BACKGROUND);
    assert!(again == Picture::empty(DISPLAY, BACKGROUND));
    again.draw(&mesh, Position, &camera(DISPLAY));
    assert!(again == once);
}

#[test]
fn frames_are_sent_in_one_run() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut band = whole(&mesh, Position).crop(area(3, 11, 50, 20), BACKGROUND);
    let colors = band.color.clone();
    let frame = Frame::new(&mut band.color, &mut band.depth, band.area).unwrap();
    let mut display = Recorder::new(area(0, 0, 240, 240));
    assert_eq!(frame.present(&mut display), Ok(()));
    assert_eq!(display.calls(), [Call::Contiguous(area(3, 11, 50, 20), colors)]);
    let mut broken = Recorder::failing_after(DISPLAY, 0);
    assert_eq!(frame.present(&mut broken), Err(BusError));
}

/// Drawing returns the display's first error, and makes no call after it.
fn stops_at_the_first_error<Sh: Shader<Color = Rgb888>>(shader: Sh) {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, shader);
    let mut works = Recorder::new(DISPLAY);
    object.draw(&camera(DISPLAY), &mut storage, &mut Direct::new(&mut works)).unwrap();
    let calls = works.calls();
    assert!(calls.len() > 100);
    for working in [0, 1, calls.len() / 2, calls.len() - 1] {
        let mut fails = Recorder::failing_after(DISPLAY, working);
        let drawn = object.draw(&camera(DISPLAY), &mut storage, &mut Direct::new(&mut fails));
        assert_eq!(drawn, Err(DrawError::Target(BusError)));
        assert_eq!(fails.calls(), &calls[..=working]);
    }
    let mut fails = Recorder::failing_after(DISPLAY, 3);
    let projected = object.project(&camera(DISPLAY), &mut storage).unwrap();
    assert_eq!(projected.draw(&mut Direct::new(&mut fails)), Err(BusError));
    assert_eq!(fails.calls().len(), 4);
}

#[test]
fn drawing_stops_at_the_first_error_of_a_display() {
    stops_at_the_first_error(Unlit::new());
    stops_at_the_first_error(gouraud());
    stops_at_the_first_error(Position);
}

/// The spans of a ball, as a display receives them.
fn spans<Sh: Shader<Color = Rgb888>>(shader: Sh, is_solid: bool) -> Vec<Rectangle> {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let mut display = Recorder::new(DISPLAY);
    let object = Object::new(&mesh, shader);
    object.draw(&camera(DISPLAY), &mut storage, &mut Direct::new(&mut display)).unwrap();
    let row = |call: &Call<Rgb888>| match call {
        Call::Solid(row, _) if is_solid => *row,
        Call::Contiguous(row, colors) if !is_solid && colors.len() == row.size.width as usize => {
            *row
        }
        other => panic!("{other:?}"),
    };
    display.calls().iter().map(row).collect()
}

/// A span of one colour is one `fill_solid`, a span of interpolated colours one `fill_contiguous`.
/// None is empty.
#[test]
fn spans_are_runs() {
    let solid = spans(Unlit::new(), true);
    assert!(solid.iter().all(|row| row.size.height == 1 && row.size.width > 0));
    assert_eq!(solid, spans(gouraud(), false));
    assert_eq!(solid, spans(Position, false));
}

/// The picture in any colour type is the 24-bit one, converted: colours are computed in 24 bits.
fn draws_in<C: StoredColor + From<Rgb888> + PartialEq + std::fmt::Debug>(background: C) {
    let ball = ball();
    let mesh = ball.mesh();
    let convert = |&color: &Rgb888| if color == BACKGROUND { background } else { color.into() };
    let mut flat = Picture::<C, u16>::empty(DISPLAY, background);
    flat.draw(&mesh, Unlit::new(), &camera(DISPLAY));
    assert!(flat.color.iter().copied().eq(whole(&mesh, Unlit::new()).color.iter().map(convert)));
    let mut smooth = Picture::<C, u16>::empty(DISPLAY, background);
    smooth.draw(&mesh, gouraud(), &camera(DISPLAY));
    assert!(smooth.color.iter().copied().eq(whole(&mesh, gouraud()).color.iter().map(convert)));
    assert!(smooth.color.iter().any(|&color| color != background));
}

#[test]
fn all_kinds_of_colors_are_drawn() {
    draws_in(Rgb888::BLUE);
    draws_in(Rgb565::BLUE);
    draws_in(Bgr565::BLUE);
    draws_in(Gray8::new(3));
    draws_in(BinaryColor::Off);
}
