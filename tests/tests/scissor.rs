//! Targets within a rectangle: the pixels inside are those of the whole target, and none outside
//! changes, in colour or in depth.

use std::convert::Infallible;

use embedded_graphics::{
    mock_display::MockDisplay,
    pixelcolor::{BinaryColor, Rgb888, RgbColor},
    prelude::*,
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    color::Alpha,
    geometry::CullNone,
    mesh::{Lines, Segments},
    numbers::S8,
    output::{
        BandAreas, Direct, Frame, InPages, InRows, KeepDepth, Over, PackedFrame, Readable,
        Scissored, StoredDepth, Target,
    },
    scene::Object,
    shade::{Dithered, Unlit},
};
use rasterizer_tests::{
    Picture, Surface, area,
    bands::{BACKGROUND, DISPLAY, EYES, Position, at, ball},
};

/// Rectangles inside the display, over its edges, round it, of a column and a row; empty ones, and
/// those beside the display.
const RECTANGLES: [Rectangle; 12] = [
    area(20, 10, 25, 17),
    area(-9, -12, 40, 30),
    area(40, 30, 500, 500),
    area(-1000, -1000, 4000, 4000),
    area(30, -5, 1, 100),
    area(-5, 21, 100, 1),
    area(20, 10, 0, 17),
    area(20, 10, 25, 0),
    area(64, 0, 9, 9),
    area(5, -30, 20, 28),
    area(i32::MIN, i32::MIN, u32::MAX, u32::MAX),
    area(i32::MAX, 0, u32::MAX, 9),
];

/// A ball in one of several ways, seen from some distance.
struct Ball<'a> {
    surface: &'a Surface,
    eye: &'static str,
    way: Way,
}

#[derive(Clone, Copy, Debug)]
enum Way {
    Interpolated,
    OneColor,
    Blended,
    Lines,
    Depth,
}

const WAYS: [Way; 5] = [Way::Interpolated, Way::OneColor, Way::Blended, Way::Lines, Way::Depth];

impl Ball<'_> {
    fn draw<T>(&self, target: &mut T) -> Result<(), Infallible>
    where
        T: Readable<Color = Rgb888, Error = Infallible>,
    {
        let mesh = self.surface.mesh();
        let camera = at(self.eye, DISPLAY);
        let object = Object::new(&mesh, Position).culled(CullNone);
        let seen = object.project_on_demand(&camera, S8).unwrap();
        match self.way {
            Way::Interpolated => seen.draw(target),
            Way::OneColor => {
                let object = Object::new(&mesh, Unlit::new()).culled(CullNone);
                object.project_on_demand(&camera, S8).unwrap().draw(target)
            }
            Way::Blended => {
                let object = object.blended(KeepDepth(Over(const { Alpha::lit("0.4") })));
                object.project_on_demand(&camera, S8).unwrap().draw(target)
            }
            Way::Lines => {
                let segments: Vec<_> =
                    (1..mesh.vertex_count() as u16).map(|i| [i - 1, i]).collect();
                let lines = Lines::new(&mesh, Segments::U16(&segments)).unwrap();
                seen.lines(&lines).wide(3).draw(target)
            }
            Way::Depth => seen.draw_depth(target),
        }
    }
}

/// A picture of many colours and depths.
fn painted<D: StoredDepth>() -> Picture<Rgb888, D> {
    let mut picture = Picture::empty(DISPLAY, BACKGROUND);
    for (index, (color, depth)) in picture.color.iter_mut().zip(&mut picture.depth).enumerate() {
        *color = Rgb888::new(index as u8, (index >> 3) as u8, 7);
        *depth = D::from_fraction((index as u32 % 9) << 24);
    }
    picture
}

fn drawn<D: StoredDepth>(drawing: &Ball<'_>, rectangle: Option<&Rectangle>) -> Picture<Rgb888, D> {
    let mut picture = painted();
    let mut frame = Frame::new(&mut picture.color, &mut picture.depth, picture.area).unwrap();
    let Ok(()) = match rectangle {
        Some(rectangle) => drawing.draw(&mut Scissored::new(&mut frame, rectangle)),
        None => drawing.draw(&mut frame),
    };
    picture
}

/// The pixels of one picture inside a rectangle, those of another outside it.
fn composed<T: Copy>(inside: &[T], outside: &[T], rectangle: &Rectangle) -> Vec<T> {
    let points = DISPLAY.points().zip(inside.iter().zip(outside));
    points.map(|(at, (a, b))| if contains(rectangle, at) { *a } else { *b }).collect()
}

/// Whether a rectangle contains a pixel, also a rectangle whose right side is beyond `i32`.
fn contains(rectangle: &Rectangle, at: Point) -> bool {
    let along = |from: i32, size: u32, at: i32| {
        (i64::from(from)..i64::from(from) + i64::from(size)).contains(&i64::from(at))
    };
    let Rectangle { top_left, size } = rectangle;
    along(top_left.x, size.width, at.x) && along(top_left.y, size.height, at.y)
}

fn frames_keep_what_is_outside<D: StoredDepth + PartialEq>() {
    let ball = ball();
    let before = painted::<D>();
    let mut inside = 0;
    for eye in EYES {
        for way in WAYS {
            let drawing = Ball { surface: &ball, eye, way };
            let whole = drawn::<D>(&drawing, None);
            assert!(whole != before, "{way:?} from {eye} draws nothing");
            for rectangle in &RECTANGLES {
                let part = drawn::<D>(&drawing, Some(rectangle));
                inside += part.color.iter().zip(&before.color).filter(|(a, b)| a != b).count();
                let color = composed(&whole.color, &before.color, rectangle);
                let depth = composed(&whole.depth, &before.depth, rectangle);
                assert!(part.color == color, "colours: {way:?} from {eye} in {rectangle:?}");
                assert!(part.depth == depth, "depths: {way:?} from {eye} in {rectangle:?}");
            }
        }
    }
    assert!(inside > 50_000, "only {inside} pixels were drawn");
}

#[test]
fn frames_keep_what_is_outside_a_rectangle() {
    frames_keep_what_is_outside::<u16>();
    frames_keep_what_is_outside::<FloatDepth>();
    frames_keep_what_is_outside::<u32>();
}

#[test]
fn bands_keep_what_is_outside_a_rectangle() {
    let ball = ball();
    let drawing = Ball { surface: &ball, eye: "1.2", way: Way::Interpolated };
    for rectangle in &RECTANGLES {
        let whole = drawn::<u16>(&drawing, Some(rectangle));
        for band in [1, 5, 16].into_iter().flat_map(|rows| BandAreas::new(DISPLAY, rows)) {
            let mut picture = painted::<u16>().crop(band, BACKGROUND);
            let mut frame = Frame::new(&mut picture.color, &mut picture.depth, band).unwrap();
            let Ok(()) = drawing.draw(&mut Scissored::new(&mut frame, rectangle));
            assert!(picture == whole.crop(band, BACKGROUND), "{band:?} in {rectangle:?}");
        }
    }
}

#[test]
fn rectangles_intersect() {
    let (mut color, mut depth) = ([Rgb888::BLACK; 100], [0u16; 100]);
    let mut frame = Frame::new(&mut color, &mut depth, area(0, 0, 10, 10)).unwrap();
    let mut outer = Scissored::new(&mut frame, &area(2, 3, 20, 4));
    let window = Scissored::new(&mut outer, &area(-5, 5, 12, 20)).window();
    assert_eq!(
        [window.left(), window.top(), window.right(), window.bottom()],
        [2, 5, 7, 7],
        "{window:?}"
    );
}

/// Without depth, and straight onto a display that panics if a pixel is drawn twice.
#[test]
fn displays_and_frames_without_depth_keep_what_is_outside() {
    let cube = Surface::cube(16_384, 1).scaled(-14);
    let mesh = cube.mesh();
    let camera = at("1.7", area(0, 0, 61, 47));
    let (shaded, solid) = (Object::new(&mesh, Position), Object::new(&mesh, Unlit::new()));
    let shaded = shaded.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let solid = solid.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let display = area(0, 0, 61, 47);
    let mut covered = 0;
    for rectangle in RECTANGLES {
        for is_solid in [false, true] {
            let draw = |target: &mut Frame<'_, Rgb888, NoDepth>, part: &Rectangle| {
                let mut target = Scissored::new(target, part);
                if is_solid { solid.draw(&mut target) } else { shaded.draw(&mut target) }
            };
            let picture = |part: &Rectangle| {
                let mut color = vec![BACKGROUND; 61 * 47];
                let mut frame = Frame::without_depth(&mut color, display).unwrap();
                let Ok(()) = draw(&mut frame, part);
                color
            };
            let (whole, part) = (picture(&display), picture(&rectangle));
            let mut screen = MockDisplay::<Rgb888>::new();
            let mut direct = Direct::new(&mut screen);
            let mut target = Scissored::new(&mut direct, &rectangle);
            let drawn = if is_solid { solid.draw(&mut target) } else { shaded.draw(&mut target) };
            assert_eq!(drawn, Ok(()));
            for (at, (&whole, &part)) in display.points().zip(whole.iter().zip(&part)) {
                let want = if contains(&rectangle, at) { whole } else { BACKGROUND };
                assert_eq!(part, want, "{at} in {rectangle:?}");
                assert_eq!(screen.get_pixel(at).unwrap_or(BACKGROUND), want, "{at} directly");
                covered += usize::from(want != BACKGROUND);
            }
        }
    }
    assert!(covered > 10_000, "only {covered} pixels were drawn");
}

/// Pixels of a bit, in rows and in pages.
#[test]
fn packed_frames_keep_what_is_outside() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Dithered::<_, BinaryColor>::new(Position));
    let seen = object.project_on_demand::<_, S8, u16>(&at("1.7", DISPLAY), S8).unwrap();
    macro_rules! picture {
        ($order:ty, $new:ident, $rectangle:expr) => {{
            type Packed = PackedFrame<'static, BinaryColor, NoDepth, $order>;
            let mut bytes = vec![0xA5; Packed::bytes(DISPLAY.size)];
            let mut depth = vec![0; 61 * 47];
            let mut frame =
                PackedFrame::<BinaryColor, _, _>::$new(&mut bytes, &mut depth, DISPLAY).unwrap();
            let before: Vec<_> = frame.pixels().collect();
            let Ok(()) = seen.draw(&mut Scissored::new(&mut frame, $rectangle));
            (before, frame.pixels().collect::<Vec<_>>(), depth)
        }};
    }
    for rectangle in &RECTANGLES {
        for [(before, part, depth), (_, whole, whole_depth)] in [
            [picture!(InRows, new, rectangle), picture!(InRows, new, &DISPLAY)],
            [picture!(InPages, in_pages, rectangle), picture!(InPages, in_pages, &DISPLAY)],
        ] {
            assert!(part == composed(&whole, &before, rectangle), "{rectangle:?}");
            let far = vec![0u16; depth.len()];
            assert!(depth == composed(&whole_depth, &far, rectangle), "{rectangle:?}");
        }
    }
}
