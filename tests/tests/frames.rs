//! Frames as memory and as displays: what embedded-graphics draws under and over objects, frames in
//! larger buffers, and bands that are taken one by one.

use std::{collections::HashMap, convert::Infallible};

use embedded_graphics::{
    Drawable, Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    image::{Image, ImageRaw},
    mono_font::{MonoTextStyle, MonoTextStyleBuilder, ascii::FONT_6X10},
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::{
        Circle, Line, PointsIter, Primitive as _, PrimitiveStyle, Rectangle, StyledDrawable as _,
    },
    text::Text,
};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    geometry::{CullNone, Pose, ScreenVertex},
    numbers::{S8, Vec3},
    output::{Bands, Frame, FrameError, Packed, Rows, StoredDepth, Strided},
    scene::Object,
    shade::{Shader, Unlit},
};
use rasterizer_tests::{
    BusError, Call, Picture, Recorder, area,
    bands::{BACKGROUND, DISPLAY, Depth, Position, ROWS, Screen, at, ball, picture},
};

const WIDTH: usize = DISPLAY.size.width as usize;

/// Anything that is drawn, on a plane without edges.
#[derive(Default)]
struct Plane(HashMap<Point, Rgb888>);

impl Dimensions for Plane {
    fn bounding_box(&self) -> Rectangle {
        DISPLAY
    }
}

impl DrawTarget for Plane {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Infallible> {
        self.0.extend(pixels.into_iter().map(|Pixel(point, color)| (point, color)));
        Ok(())
    }
}

/// Text on a ground, a circle and an image, each across an edge of the display.
fn draw_below<T: DrawTarget<Color = Rgb888, Error = Infallible>>(target: &mut T) {
    let style = MonoTextStyleBuilder::new().font(&FONT_6X10).text_color(Rgb888::RED);
    let style = style.background_color(Rgb888::new(0, 60, 0)).build();
    let Ok(_) = Text::new("Below the ball", Point::new(-5, 12), style).draw(target);
    let Ok(()) = Circle::new(Point::new(40, 25), 40)
        .into_styled(PrimitiveStyle::with_fill(Rgb888::MAGENTA))
        .draw(target);
    let bytes: Vec<u8> = (0..3 * 8 * 9).map(|byte| byte as u8).collect();
    let Ok(()) = Image::new(&ImageRaw::<Rgb888>::new(&bytes, 8), Point::new(-1, -6)).draw(target);
}

/// Text without a ground, a rectangle, a line and an image.
fn draw_above<T: DrawTarget<Color = Rgb888, Error = Infallible>>(target: &mut T) {
    let style = MonoTextStyle::new(&FONT_6X10, Rgb888::YELLOW);
    let Ok(_) = Text::new("Above", Point::new(20, 25), style).draw(target);
    let rectangle = area(25, 30, 300, 4);
    let Ok(()) = rectangle.draw_styled(&PrimitiveStyle::with_fill(Rgb888::CYAN), target);
    let line = Line::new(Point::new(-30, -30), Point::new(90, 70));
    let Ok(()) = line.draw_styled(&PrimitiveStyle::with_stroke(Rgb888::GREEN, 1), target);
    let bytes: Vec<u8> = (0..3 * 5 * 6).map(|byte| 255 - byte as u8).collect();
    let Ok(()) = Image::new(&ImageRaw::<Rgb888>::new(&bytes, 5), Point::new(30, 40)).draw(target);
}

/// What embedded-graphics draws goes under an object and over it, clipped to the frame, and leaves
/// the depth as the object left it. Bands show the same.
#[test]
fn text_shapes_and_images_go_under_objects_and_over_them() {
    let ball = ball();
    let mesh = ball.mesh();
    let (mut below, mut above) = (Plane::default(), Plane::default());
    draw_below(&mut below);
    draw_above(&mut above);
    for eye in ["3", "1.7"] {
        let object = Object::new(&mesh, Position);
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
        let mut alone = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
        alone.draw(&mesh, Position, &at(eye, DISPLAY));

        let mut whole = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut whole.color, &mut whole.depth, DISPLAY).unwrap();
        assert_eq!(frame.bounding_box(), DISPLAY);
        draw_below(&mut frame);
        let Ok(()) = seen.draw(&mut frame);
        draw_above(&mut frame);
        let mut counts = [0; 3];
        for (index, point) in DISPLAY.points().enumerate() {
            let (want, kind) = match (above.0.get(&point), below.0.get(&point)) {
                (Some(&color), _) => (color, 0),
                (None, _) if alone.depth[index] != 0 => (alone.color[index], 1),
                (None, Some(&color)) => (color, 2),
                (None, None) => (BACKGROUND, 2),
            };
            assert_eq!(whole.color[index], want, "{point} from {eye}");
            counts[kind] += 1;
        }
        assert!(counts.iter().all(|&count| count > 100), "{counts:?} from {eye}");
        assert_eq!(whole.depth, alone.depth, "{eye}");
        for planes in [&below, &above] {
            assert!(planes.0.keys().any(|&point| !DISPLAY.contains(point)));
        }

        for rows in [1, 5, 16, ROWS] {
            let mut screen = Screen::new(DISPLAY);
            let Ok(()) = u16::bands(DISPLAY, rows).show(
                &mut screen,
                |band| {
                    band.clear_color(BACKGROUND);
                    draw_below(band);
                },
                |band| {
                    seen.draw(band)?;
                    draw_above(band);
                    Ok(())
                },
            );
            let pixels = screen.pixels.into_iter().flatten();
            assert!(pixels.eq(whole.color.iter().copied()), "{rows} rows from {eye}");
        }
    }
}

/// Whether a rectangle has a point, also if the rectangle reaches beyond the range of `i32`.
fn holds(rectangle: &Rectangle, point: Point) -> bool {
    let is_in = |from: i32, length: u32, at: i32| {
        (0..i64::from(length)).contains(&(i64::from(at) - i64::from(from)))
    };
    let Rectangle { top_left, size } = rectangle;
    is_in(top_left.x, size.width, point.x) && is_in(top_left.y, size.height, point.y)
}

/// Rectangles and points across the edges, beside the frame and at the ends of all numbers: the
/// pixels that the frame has are set, and no others.
fn clips<R: Rows>(mut frame: Frame<'_, Rgb888, NoDepth, R>, name: &str) {
    let at = |index: usize, frame: &Frame<'_, Rgb888, NoDepth, R>| {
        frame.pixels()[index / WIDTH * frame.stride() + index % WIDTH]
    };
    let (low, most) = (i32::MIN, u32::MAX);
    for rectangle in [
        area(3, -2, 61, 47),
        area(10, 4, 20, 9),
        area(-4, -9, 10, 10),
        area(60, 40, 100, 100),
        area(63, -2, 1, 47),
        area(64, -2, 1, 47),
        area(2, -2, 1, 47),
        area(-100, -3, 300, 1),
        area(-100, 45, 300, 1),
        area(-100, 44, 300, 1),
        area(5, 5, 0, 9),
        area(5, 5, 9, 0),
        area(low, low, most, most),
        area(low, 3, most, 1),
        area(20, low, 1, most),
        area(20, 10, i32::MAX as u32 - 20, i32::MAX as u32 - 10),
        area(20, 10, most, most),
        area(i32::MAX, i32::MAX, most, most),
        area(low, low, 5, 5),
    ] {
        frame.clear_color(BACKGROUND);
        let Ok(()) = frame.fill_solid(&rectangle, Rgb888::RED);
        for (index, point) in DISPLAY.points().enumerate() {
            let want = if holds(&rectangle, point) { Rgb888::RED } else { BACKGROUND };
            assert_eq!(at(index, &frame), want, "{name}: {rectangle:?} at {point}");
        }
    }
    frame.clear_color(BACKGROUND);
    let ends = [low, -3, 2, 64, 45, i32::MAX];
    let beside = ends.into_iter().flat_map(|x| ends.map(|y| Point::new(x, y)));
    let beside = beside.filter(|&point| !DISPLAY.contains(point));
    let Ok(()) = frame.draw_iter(beside.map(|point| Pixel(point, Rgb888::RED)));
    assert!(frame.pixels().iter().all(|&pixel| pixel != Rgb888::RED), "{name}");
    // Points of the edges' neighbours, whose addresses would be those of other pixels.
    let sides = (-2..45).flat_map(|y| [Point::new(2, y), Point::new(64, y)]);
    let Ok(()) = frame.draw_iter(sides.map(|point| Pixel(point, Rgb888::RED)));
    assert!(frame.pixels().iter().all(|&pixel| pixel != Rgb888::RED), "{name}");
    let rectangle = area(1, -4, 70, 60);
    let Ok(()) = frame.fill_contiguous(&rectangle, rectangle.points().map(mark));
    for (index, point) in DISPLAY.points().enumerate() {
        assert_eq!(at(index, &frame), mark(point), "{name}: {point}");
    }
}

/// A colour for a place.
const fn mark(point: Point) -> Rgb888 {
    Rgb888::new(point.x as u8, point.y as u8, 7)
}

#[test]
fn drawing_is_clipped_to_the_frame() {
    let mut memory = vec![BACKGROUND; WIDTH * ROWS as usize];
    clips(Frame::without_depth(&mut memory, DISPLAY).unwrap(), "packed");
    let mut memory = vec![BACKGROUND; 70 * ROWS as usize];
    clips(Frame::without_depth_with_stride(&mut memory, DISPLAY, 70).unwrap(), "strided");
    // Beside the pixels of the rows nothing is drawn.
    assert!(memory.chunks(70).all(|row| row[61..].iter().all(|&pixel| pixel == BACKGROUND)));
}

/// Colours and depth are cleared one without the other.
fn clears<D: StoredDepth + PartialEq, R: Rows>(
    color: &mut [Rgb888],
    depth: &mut [D],
    frame: impl for<'f> Fn(&'f mut [Rgb888], &'f mut [D]) -> Frame<'f, Rgb888, &'f mut [D], R>,
) {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("3", DISPLAY);
    let object = Object::new(&mesh, Position);
    let behind =
        Object::new(&mesh, Unlit::new()).posed(Pose::IDENTITY.at(Vec3::lit("1.2", "0", "-1")));
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let mut alone = Picture::<_, D>::empty(DISPLAY, Rgb888::GREEN);
    let mut packed = Frame::new(&mut alone.color, &mut alone.depth, DISPLAY).unwrap();
    let Ok(()) = behind.draw(&mut packed);
    let mut all = frame(color, depth);
    all.clear(BACKGROUND);
    let seen = object.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let Ok(()) = seen.draw(&mut all);
    let drawn = depth.to_vec();
    assert!(drawn.iter().filter(|&&depth| depth != D::ZERO).count() > 400);

    for clear in [
        |frame: &mut Frame<'_, Rgb888, &mut [D], R>| frame.clear_color(Rgb888::BLUE),
        |frame: &mut Frame<'_, Rgb888, &mut [D], R>| {
            let Ok(()) = DrawTarget::clear(frame, Rgb888::BLUE);
        },
    ] {
        depth.copy_from_slice(&drawn);
        let mut all = frame(color, depth);
        let stride = all.stride();
        clear(&mut all);
        let is_blue = |pixels: &[Rgb888]| {
            pixels.chunks(stride).all(|row| row[..WIDTH].iter().all(|&p| p == Rgb888::BLUE))
        };
        assert!(is_blue(all.pixels()));
        assert!(depth == drawn);
        // The ball is not seen, and hides what is behind it.
        let Ok(()) = behind.draw(&mut frame(color, depth));
        let hidden = color
            .iter()
            .zip(&drawn)
            .filter(|&(&color, &depth)| color == Rgb888::BLUE && depth != D::ZERO);
        let shown = color.iter().filter(|&&color| color == Rgb888::new(250, 220, 150));
        let (hidden, shown) = (hidden.count(), shown.count());
        assert!(hidden > 400 && shown > 50, "{hidden} pixels are hidden, {shown} shown");
    }

    // Without the ball's depth all of it is seen.
    depth.copy_from_slice(&drawn);
    let mut all = frame(color, depth);
    all.pixels_mut().iter_mut().for_each(|pixel| *pixel = Rgb888::GREEN);
    all.clear_depth();
    let stride = all.stride();
    assert!(all.pixels().iter().all(|&pixel| pixel == Rgb888::GREEN));
    assert!(depth.chunks(stride).all(|row| row[..WIDTH].iter().all(|&depth| depth == D::ZERO)));
    let Ok(()) = behind.draw(&mut frame(color, depth));
    assert!(color.chunks(stride).flat_map(|row| &row[..WIDTH]).eq(&alone.color));
}

#[test]
fn colors_and_depth_are_cleared_apart() {
    fn in_format<D: StoredDepth + PartialEq>() {
        let pixels = WIDTH * ROWS as usize;
        clears::<D, Packed>(
            &mut vec![BACKGROUND; pixels],
            &mut vec![D::ZERO; pixels],
            |color, depth| Frame::new(color, depth, DISPLAY).unwrap(),
        );
        let pixels = 64 * ROWS as usize;
        clears(&mut vec![BACKGROUND; pixels], &mut vec![D::ZERO; pixels], |color, depth| {
            Frame::with_stride(color, depth, DISPLAY, 64).unwrap()
        });
    }
    in_format::<u16>();
    in_format::<FloatDepth>();
    in_format::<u32>();
}

/// Two parts of the display, which lie beside each other in one buffer of [`STRIDE`] pixels a row.
const PARTS: [(usize, Rectangle); 2] = [(0, area(3, -2, 25, 47)), (29, area(28, -2, 36, 47))];
const STRIDE: usize = 70;
const GAP: Rgb888 = Rgb888::new(99, 98, 97);

/// A frame in the buffer.
type Part<'f, D> = Frame<'f, Rgb888, &'f mut [D], Strided>;

/// Whether a pixel of the buffer lies between the rows of the frames.
fn is_gap(index: usize) -> bool {
    !PARTS
        .iter()
        .any(|(first, part)| (*first..first + part.size.width as usize).contains(&(index % STRIDE)))
}

/// A frame's rows in the buffer.
fn rows_of<T: Copy>(buffer: &[T], part: usize) -> Vec<T> {
    let (first, area) = PARTS[part];
    let row = |row: &[T]| row[first..first + area.size.width as usize].to_vec();
    buffer.chunks(STRIDE).flat_map(row).collect()
}

/// Draws into the two frames of a buffer what packed frames have, and sends it.
fn shares_a_buffer<D: StoredDepth + PartialEq, Sh: Shader<Color = Rgb888>>(shader: &Sh, other: D) {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("1.7", DISPLAY);
    let pixels = STRIDE * ROWS as usize;
    let (mut color, mut depth) = (vec![GAP; pixels], vec![other; pixels]);
    let mut screen = Screen::new(DISPLAY);
    let mut whole = Picture::<_, D>::empty(DISPLAY, Rgb888::BLUE);
    whole.draw(&mesh, shader.clone(), &camera);
    for (part, (first, area)) in PARTS.into_iter().enumerate() {
        let gaps_are_kept = |color: &[Rgb888], depth: &[D], after: &str| {
            let kept = |index: usize| color[index] == GAP && depth[index] == other;
            assert!((0..pixels).filter(|&index| is_gap(index)).all(kept), "after {after}");
        };
        let frame =
            |color: &mut [Rgb888], depth: &mut [D], draw: &mut dyn FnMut(&mut Part<'_, D>)| {
                let (color, depth) = (&mut color[first..], &mut depth[first..]);
                let mut frame = Frame::with_stride(color, depth, area, STRIDE as u32).unwrap();
                assert_eq!((frame.area(), frame.stride()), (area, STRIDE));
                draw(&mut frame);
            };
        frame(&mut color, &mut depth, &mut |frame| frame.clear(Rgb888::RED));
        gaps_are_kept(&color, &depth, "clear");
        assert!(rows_of(&color, part).iter().all(|&pixel| pixel == Rgb888::RED));
        assert!(rows_of(&depth, part).iter().all(|&depth| depth == D::ZERO));
        frame(&mut color, &mut depth, &mut |frame| {
            let Ok(()) = DrawTarget::clear(frame, Rgb888::BLUE);
        });
        gaps_are_kept(&color, &depth, "a display's clear");
        depth.iter_mut().enumerate().filter(|(i, _)| !is_gap(*i)).for_each(|(_, d)| *d = other);
        frame(&mut color, &mut depth, &mut |frame| frame.clear_depth());
        gaps_are_kept(&color, &depth, "clear_depth");
        // The second time around the first part is done.
        if part == 1 {
            assert!(rows_of(&depth, 0).iter().all(|&depth| depth == other));
        }
        frame(&mut color, &mut depth, &mut |frame| {
            let object = Object::new(&mesh, shader.clone());
            let seen = object.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
            let Ok(()) = seen.draw(frame);
            let Ok(()) = frame.present(&mut screen);
        });
        gaps_are_kept(&color, &depth, "drawing and sending");
        let want = whole.crop(area, Rgb888::BLUE);
        assert!(rows_of(&color, part) == want.color, "{area:?}");
        assert!(rows_of(&depth, part) == want.depth, "{area:?}");
    }
    assert!(rows_of(&color, 0) == whole.crop(PARTS[0].1, Rgb888::BLUE).color);
    assert!(screen.pixels.into_iter().flatten().eq(whole.color), "on the display");
}

#[test]
fn two_frames_share_a_buffer() {
    shares_a_buffer::<u16, _>(&Position, 7777);
    shares_a_buffer::<u32, _>(&Position, 1 << 31);
    shares_a_buffer::<u16, _>(&Unlit::new(), 7777);
}

/// Without depth, where one colour fills runs.
#[test]
fn two_frames_without_depth_share_a_buffer() {
    fn shared<Sh: Shader<Color = Rgb888>>(shader: &Sh) {
        let ball = ball();
        let mesh = ball.mesh();
        let object = Object::new(&mesh, shader.clone()).culled(CullNone);
        let seen = object.project_on_demand::<_, S8, NoDepth>(&at("1.7", DISPLAY), S8).unwrap();
        let whole = picture::<NoDepth>(ROWS, |frame| seen.draw(frame));
        let mut color = vec![GAP; STRIDE * ROWS as usize];
        let mut screen = Screen::new(DISPLAY);
        for (first, area) in PARTS {
            let color = &mut color[first..];
            let frame = Frame::without_depth_with_stride(color, area, STRIDE as u32);
            let mut frame = frame.unwrap();
            frame.clear(BACKGROUND);
            let Ok(()) = seen.draw(&mut frame);
            let Ok(()) = frame.present(&mut screen);
        }
        assert!((0..color.len()).filter(|&index| is_gap(index)).all(|index| color[index] == GAP));
        assert!(screen == whole);
    }
    shared(&Position);
    shared(&Unlit::new());
}

/// A strided frame is sent row by row, until the display fails.
#[test]
fn strided_frames_are_sent_by_rows() {
    let mut color: Vec<_> = (0..8 * 3).map(|index| mark(Point::new(index, 0))).collect();
    let rows: Vec<_> = color.chunks(8).map(|row| row[..5].to_vec()).collect();
    let part = area(-7, 9, 5, 3);
    let frame = Frame::without_depth_with_stride(&mut color, part, 8).unwrap();
    let mut display = Recorder::new(DISPLAY);
    assert_eq!(frame.present(&mut display), Ok(()));
    let want = (9..).zip(rows).map(|(y, row)| Call::Contiguous(area(-7, y, 5, 1), row));
    let want: Vec<_> = want.collect();
    assert_eq!(display.calls(), want);
    for works in 0..3 {
        let mut broken = Recorder::failing_after(DISPLAY, works);
        assert_eq!(frame.present(&mut broken), Err(BusError));
        assert_eq!(broken.calls(), &want[..=works]);
    }
}

#[test]
fn strided_frames_need_memory_up_to_their_last_pixel() {
    let (mut color, mut depth) = ([BACKGROUND; 40], [0u16; 40]);
    let mut frame = |colors: usize, depths: usize, [width, height, stride]: [u32; 3]| {
        let (color, depth) = (&mut color[..colors], &mut depth[..depths]);
        let frame = Frame::with_stride(color, depth, area(5, -5, width, height), stride);
        frame.map(|frame| frame.pixels().len())
    };
    // Two rows of 8 pixels and one of 5.
    assert_eq!(frame(21, 21, [5, 3, 8]), Ok(21));
    assert_eq!(frame(40, 40, [5, 3, 8]), Ok(21));
    assert_eq!(frame(20, 21, [5, 3, 8]), Err(FrameError::ColorLength { needed: 21 }));
    assert_eq!(frame(21, 20, [5, 3, 8]), Err(FrameError::DepthLength { needed: 21 }));
    assert_eq!(frame(15, 15, [5, 3, 5]), Ok(15));
    assert_eq!(frame(40, 40, [5, 3, 4]), Err(FrameError::Stride { needed: 5 }));
    assert_eq!(frame(0, 0, [5, 0, 8]), Ok(0));
    assert_eq!(frame(16, 16, [0, 3, 8]), Ok(16));
    let mut bare = |colors: usize, stride: u32| {
        let frame =
            Frame::without_depth_with_stride(&mut color[..colors], area(0, 0, 5, 3), stride);
        frame.map(|frame| frame.stride())
    };
    assert_eq!(bare(21, 8), Ok(8));
    assert_eq!(bare(20, 8), Err(FrameError::ColorLength { needed: 21 }));
    assert_eq!(bare(40, 4), Err(FrameError::Stride { needed: 5 }));
    assert_eq!(FrameError::Stride { needed: 5 }.to_string(), "the stride must be 5 pixels or more");
}

/// Bands that a program takes one by one are those that `show` draws; and any other rectangle that
/// the memory holds is a band too.
#[test]
fn bands_are_taken_one_by_one() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position).project(&at("1.7", DISPLAY), &mut storage).unwrap();
    let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
    // As an earlier picture left them.
    let (mut color, mut depth) = (vec![Rgb888::RED; WIDTH * 6], vec![60_000u16; WIDTH * 6]);
    let mut bands = Bands::new(DISPLAY, &mut color[..], &mut depth).unwrap();
    let mut screen = Screen::new(DISPLAY);
    assert_eq!(bands.areas().count(), 8);
    for area in bands.areas() {
        let mut band = bands.band(area).unwrap();
        assert_eq!(band.area(), area);
        band.clear_color(BACKGROUND);
        let Ok(()) = seen.draw(&mut band);
        let Ok(()) = band.present(&mut screen);
    }
    assert!(screen == whole);

    for part in [area(10, 3, 20, 18), area(3, 10, 61, 6), area(40, -2, 7, 47), area(9, 9, 0, 3)] {
        let mut band = bands.band(part).unwrap();
        band.clear_color(BACKGROUND);
        let Ok(()) = seen.draw(&mut band);
        let all = DISPLAY.points().zip(whole.pixels.iter().flatten());
        let want = all.filter(|(point, _)| part.contains(*point)).map(|(_, color)| color);
        assert!(band.pixels().iter().eq(want), "{part:?}");
    }

    let needed = 61 * 7;
    let taken = bands.band(area(3, 10, 61, 7)).map(|band| band.area());
    assert_eq!(taken, Err(FrameError::ColorLength { needed }));
    let mut more = vec![BACKGROUND; needed];
    let mut bands = Bands::new(DISPLAY, &mut more[..], &mut depth).unwrap();
    let taken = bands.band(area(3, 10, 61, 7)).map(|band| band.area());
    assert_eq!(taken, Err(FrameError::DepthLength { needed }));
    let mut bands = Bands::without_depth(DISPLAY, &mut more[..needed - 1]).unwrap();
    let taken = bands.band(area(3, 10, 61, 7)).map(|band| band.area());
    assert_eq!(taken, Err(FrameError::ColorLength { needed }));
    assert_eq!(bands.band(area(3, 10, 61, 6)).map(|band| band.pixels().len()), Ok(61 * 6));
}

/// Two buffers in turn, by `exchange` after each band and by `stream`: the same pixels are sent
/// from the same buffers.
#[test]
fn exchanged_buffers_equal_a_stream() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u32, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position).project(&at("1.7", DISPLAY), &mut storage).unwrap();
    let whole = picture::<u32>(ROWS, |frame| seen.draw(frame));
    let buffers = || [Rgb888::RED, Rgb888::BLUE].map(|color| vec![color; WIDTH * 6]);
    let mut depth = vec![0u32; WIDTH * 6];
    let send = |screen: &mut Screen<Rgb888>, finished: &[Rgb888], area: Rectangle| {
        let pixels = area.size.width as usize * area.size.height as usize;
        let Ok(()) = screen.fill_contiguous(&area, finished[..pixels].iter().copied());
        finished.as_ptr().addr()
    };

    let [front, mut back] = buffers();
    let places = [front.as_ptr().addr(), back.as_ptr().addr()];
    let (mut streamed, mut order) = (Screen::new(DISPLAY), vec![]);
    let last = Bands::new(DISPLAY, front, &mut depth).unwrap().stream(
        |band| band.clear_color(BACKGROUND),
        |band| seen.draw(band),
        |finished, area| {
            order.push(places.iter().position(|&at| at == send(&mut streamed, &finished, area)));
            Ok::<_, Infallible>(std::mem::replace(&mut back, finished))
        },
    );
    let last = places.iter().position(|&at| at == last.as_ref().unwrap().as_ptr().addr());

    let [front, mut back] = buffers();
    let places = [front.as_ptr().addr(), back.as_ptr().addr()];
    let (mut exchanged, mut turns) = (Screen::new(DISPLAY), vec![]);
    let mut bands = Bands::new(DISPLAY, front, &mut depth).unwrap();
    for area in bands.areas() {
        let mut band = bands.band(area).unwrap();
        band.clear_color(BACKGROUND);
        let Ok(()) = seen.draw(&mut band);
        let finished = bands.exchange(back);
        turns.push(places.iter().position(|&at| at == send(&mut exchanged, &finished, area)));
        back = finished;
    }
    assert!(exchanged == whole && streamed == whole);
    assert_eq!(turns, order);
    assert_eq!(turns, [Some(0), Some(1)].repeat(4));
    let rest = bands.into_color();
    assert_eq!(places.iter().position(|&at| at == rest.as_ptr().addr()), last);
}
