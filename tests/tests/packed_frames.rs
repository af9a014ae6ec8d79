//! Frames of several pixels in a byte: each shows what a frame of a pixel in a byte shows, whole
//! and in bands, with depth and without, drawn by the core and by embedded-graphics.

use std::convert::Infallible;

use embedded_graphics::{
    image::{Image, ImageRaw},
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::{BinaryColor, Gray2, Gray4, GrayColor, PixelColor, Rgb888},
    prelude::*,
    primitives::{Circle, Line, PrimitiveStyle, Rectangle},
    text::Text,
};
use rasterizer::{
    attribute::NoDepth,
    geometry::CullNone,
    mesh::{MeshMaterial, MeshVertex},
    numbers::S8,
    output::{
        BandAreas, Bands, Blend, Frame, FrameError, InPages, KeepDepth, PackedColor, PackedFrame,
        Replace, StoredColor,
    },
    raster::Fragment,
    scene::Object,
    shade::{Dithered, Outcome, Sample, Shader, Unlit},
};
use rasterizer_tests::{
    area,
    bands::{DISPLAY, EYES, Position, ROWS, Screen, at, ball},
};

/// Parts of the display, and rectangles that reach beyond it: of widths that fill bytes, and
/// others.
const PARTS: [Rectangle; 7] = [
    DISPLAY,
    area(8, 0, 32, 24),
    area(5, -1, 33, 21),
    area(-9, -12, 100, 70),
    area(20, 10, 1, 9),
    area(30, 13, 7, 1),
    area(64, 4, 9, 0),
];

const fn count(area: &Rectangle) -> usize {
    (area.size.width * area.size.height) as usize
}

/// A background of more than one colour.
fn paint<C: PixelColor + From<BinaryColor>>(
    target: &mut impl DrawTarget<Color = C, Error = Infallible>,
) {
    let points = target.bounding_box().points();
    let Ok(()) = target.draw_iter(
        points.map(|at| Pixel(at, BinaryColor::from((at.x * 5 + at.y * 3) % 7 < 3).into())),
    );
}

/// Draws in a frame of the type `$packed` and in a `Frame`, with the constructors that follow and a
/// depth buffer or none, and compares colours and depths.
macro_rules! compare {
    ($color:ty, $packed:ty, $new:ident, $area:expr, ($($depth:expr)?),
     |$target:ident| $draw:expr) => {{
        let area: Rectangle = $area;
        let mut colors = vec![<$color>::from(BinaryColor::Off); count(&area)];
        let mut bytes = vec![0xA5; <$packed>::bytes(area.size)];
        let mut depths = [(); 2].map(|()| ($(vec![$depth; count(&area)],)?));
        let [_of_frame, _of_packed] = &mut depths;
        {
            let mut $target = compare!(@frame colors, _of_frame, area, ($($depth)?));
            paint(&mut $target);
            $draw;
        }
        let shown: Vec<$color> = {
            let mut $target =
                compare!(@packed $color, $new, bytes, _of_packed, area, ($($depth)?));
            paint(&mut $target);
            $draw;
            $target.pixels().collect()
        };
        assert!(shown == colors, "{} in {area:?}", stringify!($packed));
        let [of_frame, of_packed] = &depths;
        assert!(of_frame == of_packed, "depths of {} in {area:?}", stringify!($packed));
        colors
    }};
    (@frame $colors:ident, $depths:ident, $area:ident, ($depth:expr)) => {
        Frame::new(&mut $colors, &mut $depths.0, $area).unwrap()
    };
    (@frame $colors:ident, $depths:ident, $area:ident, ()) => {
        Frame::without_depth(&mut $colors, $area).unwrap()
    };
    (@packed $color:ty, $new:ident, $bytes:ident, $depths:ident, $area:ident, ($depth:expr)) => {
        PackedFrame::<$color, _, _>::$new(&mut $bytes, &mut $depths.0, $area).unwrap()
    };
    (@packed $color:ty, $new:ident, $bytes:ident, $depths:ident, $area:ident, ()) => {
        PackedFrame::<$color, NoDepth, _>::$new(&mut $bytes, $area).unwrap()
    };
}

type Pages = PackedFrame<'static, BinaryColor, NoDepth, InPages>;

/// [`compare`] for all colours and orders of pixels. `$color` is the colour's name in `$draw`.
macro_rules! compare_all {
    ($area:expr, $color:ident, |$target:ident| $draw:expr) => {{
        let of_binary = {
            type $color = BinaryColor;
            compare!(BinaryColor, Pages, in_pages, $area, (0u16), |$target| $draw);
            compare!(BinaryColor, PackedFrame<'_, BinaryColor>, new, $area, (0u32), |$target| $draw)
        };
        {
            type $color = Gray2;
            compare!(Gray2, PackedFrame<'_, Gray2>, new, $area, (0u16), |$target| $draw);
        }
        {
            type $color = Gray4;
            compare!(Gray4, PackedFrame<'_, Gray4>, new, $area, (0u16), |$target| $draw);
        }
        of_binary
    }};
}

/// [`compare_all`] without depth.
macro_rules! compare_without_depth {
    ($area:expr, $color:ident, |$target:ident| $draw:expr) => {{
        let of_binary = {
            type $color = BinaryColor;
            compare!(BinaryColor, Pages, in_pages_without_depth, $area, (), |$target| $draw);
            type Rows = PackedFrame<'static, BinaryColor>;
            compare!(BinaryColor, Rows, without_depth, $area, (), |$target| $draw)
        };
        {
            type $color = Gray2;
            compare!(Gray2, PackedFrame<'_, Gray2>, without_depth, $area, (), |$target| $draw);
        }
        {
            type $color = Gray4;
            compare!(Gray4, PackedFrame<'_, Gray4>, without_depth, $area, (), |$target| $draw);
        }
        of_binary
    }};
}

/// Clipped and not; behind itself, because back faces are drawn.
#[test]
fn triangles_are_those_of_a_frame() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut lit = 0;
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        for part in PARTS {
            let shown = compare_all!(part, C, |target| {
                let object = Object::new(&mesh, Dithered::<_, C>::new(Position)).culled(CullNone);
                let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
            });
            lit += shown.iter().filter(|color| color.is_on()).count();
            compare_without_depth!(part, C, |target| {
                let object = Object::new(&mesh, Dithered::<_, C>::new(Position)).culled(CullNone);
                let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
            });
            // Spans of one colour, by whole bytes where there is no depth.
            compare_all!(part, C, |target| {
                let object = Object::new(&mesh, Unlit::<C>::new());
                let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
            });
            compare_without_depth!(part, C, |target| {
                let object = Object::new(&mesh, Unlit::<C>::new());
                let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
            });
        }
    }
    assert!(lit > 10_000, "only {lit} pixels are lit");
}

/// A shader that leaves out a third of the pixels of another one.
#[derive(Clone)]
struct Lattice<Sh>(Sh);

impl<Sh: Shader> Shader for Lattice<Sh> {
    type Color = Sh::Color;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = Sh::Face;
    type Outcome = Option<Sh::Color>;

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        self.0.surface(material)
    }

    fn vertex(&self, vertex: &MeshVertex<'_>) -> Sh::Varyings {
        self.0.vertex(vertex)
    }

    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Sh::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Option<Sh::Color> {
        let is_hole = (fragment.column + fragment.row).rem_euclid(3) == 0;
        self.0.pixel(surface, face, fragment).color().filter(|_| !is_hole)
    }
}

/// Colours are read, blended and left out as in a frame, also those that are dithered after they
/// have been left out.
#[test]
fn pixels_are_read_and_left_out_as_in_a_frame() {
    fn darker<C: PackedColor>(stored: C, new: C) -> C {
        C::from_bits(stored.to_bits() & new.to_bits())
    }
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("1.2", DISPLAY);
    for part in PARTS {
        compare_all!(part, C, |target| {
            let shader = Dithered::<_, C>::new(Lattice(Position));
            let object = Object::new(&mesh, shader).blended(Blend(darker::<C>));
            let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
        });
        compare_all!(part, C, |target| {
            let shader = Dithered::<_, C>::new(Position);
            let object = Object::new(&mesh, shader).blended(KeepDepth(Replace));
            let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
        });
        compare_without_depth!(part, C, |target| {
            let object = Object::new(&mesh, Lattice(Unlit::<C>::new())).culled(CullNone);
            let Ok(()) = object.project_on_demand(&camera, S8).unwrap().draw(&mut target);
        });
    }
}

#[test]
fn text_and_figures_are_those_of_a_frame() {
    for part in PARTS {
        compare_all!(part, C, |target| {
            let on = C::from(BinaryColor::On);
            let filled = PrimitiveStyle::with_fill(C::from(Rgb888::new(140, 140, 140)));
            Circle::new(Point::new(-4, -8), 38).into_styled(filled).draw(&mut target).unwrap();
            Rectangle::new(Point::new(17, 3), Size::new(23, 5))
                .into_styled(filled)
                .draw(&mut target)
                .unwrap();
            Line::new(Point::new(70, -9), Point::new(-3, 60))
                .into_styled(PrimitiveStyle::with_stroke(on, 2))
                .draw(&mut target)
                .unwrap();
            let style = MonoTextStyle::new(&FONT_6X10, on);
            Text::new("1 bit", Point::new(9, 20), style).draw(&mut target).unwrap();
        });
    }
}

/// Each of the bands as high as memory allows, and each frame sent to a display.
#[test]
fn bands_of_packed_pixels_equal_the_whole_frame() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut drawn = 0;
    for eye in EYES {
        let object = Object::new(&mesh, Dithered::<_, BinaryColor>::new(Position));
        let seen = object.project_on_demand::<_, S8, u16>(&at(eye, DISPLAY), S8).unwrap();
        let off = BinaryColor::Off;
        let mut pixels = vec![off; count(&DISPLAY)];
        let mut depth = vec![0u16; count(&DISPLAY)];
        let mut whole = Screen::new(DISPLAY);
        let mut frame = Frame::new(&mut pixels, &mut depth, DISPLAY).unwrap();
        let Ok(()) = seen.draw(&mut frame);
        let Ok(()) = frame.present(&mut whole);
        drawn += whole.drawn(off).len();
        for rows in 1..=ROWS as usize + 9 {
            // 61 pixels of a bit take 8 bytes.
            let mut bytes = vec![0xFF; 8 * rows];
            let mut screen = Screen::new(DISPLAY);
            let mut bands = Bands::packed(DISPLAY, &mut bytes[..], &mut depth).unwrap();
            assert_eq!(bands.areas(), BandAreas::new(DISPLAY, rows.min(47) as u32));
            let Ok(()) =
                bands.show(&mut screen, |band| band.clear_color(off), |band| seen.draw(band));
            assert!(screen == whole, "{rows} rows from {eye}");

            // In pages of eight rows, a byte for each column.
            let mut bytes = vec![0xFF; 61 * rows.div_ceil(8)];
            let mut screen = Screen::new(DISPLAY);
            let mut bands = Bands::in_pages(DISPLAY, &mut bytes[..], &mut depth).unwrap();
            let high = rows.div_ceil(8) as u32 * 8;
            assert_eq!(bands.areas(), BandAreas::new(DISPLAY, high.min(47)));
            let Ok(()) =
                bands.show(&mut screen, |band| band.clear_color(off), |band| seen.draw(band));
            assert!(screen == whole, "{rows} rows in pages from {eye}");
        }
    }
    assert!(drawn > 500, "only {drawn} pixels are on");
}

/// `ImageRaw` shows the bytes of a frame as the frame does.
#[test]
fn a_frame_is_the_data_of_an_image() {
    fn check<C>(color: impl Fn(u8) -> C)
    where
        C: PackedColor + StoredColor + From<C::Raw>,
        for<'a> ImageRaw<'a, C>: ImageDrawable<Color = C>,
    {
        for width in 1..=19 {
            let whole = area(0, 0, width, 5);
            let mut bytes = vec![0; PackedFrame::<C>::bytes(whole.size)];
            let mut frame = PackedFrame::<C>::without_depth(&mut bytes, whole).unwrap();
            frame.clear(color(1));
            let color_at = |at: Point| color((at.x * 3 + at.y) as u8);
            let Ok(()) = frame.draw_iter(whole.points().map(|at| Pixel(at, color_at(at))));
            let pixels: Vec<C> = frame.pixels().collect();
            let mut shown = vec![color(0); count(&whole)];
            let mut screen = Frame::without_depth(&mut shown, whole).unwrap();
            let image = ImageRaw::<C>::new(&bytes, width);
            let Ok(()) = Image::new(&image, Point::zero()).draw(&mut screen);
            assert!(shown == pixels, "{width} pixels of {} bits", C::BITS);
            assert!(
                pixels.into_iter().eq(whole.points().map(color_at)),
                "{width} pixels of {} bits",
                C::BITS
            );
        }
    }
    check(|value| BinaryColor::from(value % 2 == 1));
    check(Gray2::new);
    check(Gray4::new);
}

/// A page has the uppermost of its eight rows in the lowest bit, as the SSD1306 takes it (data
/// sheet, figure 10-2).
#[test]
fn a_page_is_what_an_oled_takes() {
    let whole = area(0, 0, 3, 12);
    let mut bytes = [0; Pages::bytes(Size::new(3, 12))];
    let mut frame =
        PackedFrame::<BinaryColor, _, _>::in_pages_without_depth(&mut bytes, whole).unwrap();
    let on = [(0, 0), (1, 7), (2, 1), (2, 8), (0, 11)];
    let Ok(()) = frame.draw_iter(on.map(|(x, y)| Pixel(Point::new(x, y), BinaryColor::On)));
    assert_eq!(bytes, [1, 1 << 7, 1 << 1, 1 << 3, 0, 1]);
}

#[test]
fn memory_of_the_wrong_size_is_refused() {
    let whole = area(0, 0, 9, 9);
    let of = |bytes: usize, depths: usize| {
        let (mut bytes, mut depths) = (vec![0; bytes], vec![0u16; depths]);
        let frame = PackedFrame::<Gray2, _>::new(&mut bytes, &mut depths, whole);
        frame.map(|frame| frame.area())
    };
    // Nine pixels of two bits take three bytes.
    assert_eq!(of(27, 81), Ok(whole));
    assert_eq!(of(26, 81), Err(FrameError::PackedLength { needed: 27 }));
    assert_eq!(of(28, 81), Err(FrameError::PackedLength { needed: 27 }));
    assert_eq!(of(27, 80), Err(FrameError::DepthLength { needed: 81 }));

    let rows = |bytes: usize, depths: usize| {
        let (mut bytes, mut depths) = (vec![0; bytes], vec![0u16; depths]);
        let bands = Bands::<_, Gray4, _, _>::packed(whole, &mut bytes[..], &mut depths);
        bands.map(|bands| bands.areas())
    };
    assert_eq!(rows(5, 9), Ok(BandAreas::new(whole, 1)));
    assert_eq!(rows(14, 81), Ok(BandAreas::new(whole, 2)));
    assert_eq!(rows(99, 35), Ok(BandAreas::new(whole, 3)));
    assert_eq!(rows(4, 9), Err(FrameError::PackedLength { needed: 5 }));
    assert_eq!(rows(5, 8), Err(FrameError::DepthLength { needed: 9 }));

    let pages = |bytes: usize, depths: usize| {
        let (mut bytes, mut depths) = (vec![0; bytes], vec![0u16; depths]);
        let bands = Bands::<_, BinaryColor, _, _>::in_pages(whole, &mut bytes[..], &mut depths);
        bands.map(|bands| bands.areas())
    };
    assert_eq!(pages(9, 72), Ok(BandAreas::new(whole, 8)));
    assert_eq!(pages(18, 80), Ok(BandAreas::new(whole, 8)));
    assert_eq!(pages(18, 81), Ok(BandAreas::new(whole, 9)));
    assert_eq!(pages(8, 72), Err(FrameError::PackedLength { needed: 9 }));
    assert_eq!(pages(9, 71), Err(FrameError::DepthLength { needed: 72 }));

    let mut bands = Bands::<_, BinaryColor, _, _>::packed_without_depth(whole, [0; 4]).unwrap();
    assert_eq!(bands.areas(), BandAreas::new(whole, 2));
    assert!(bands.band(area(3, 3, 16, 2)).is_ok());
    let needed = FrameError::PackedLength { needed: 6 };
    assert_eq!(bands.band(area(3, 3, 17, 2)).map(|_| ()), Err(needed));
}

/// Levels of grays arrive as they are.
#[test]
fn all_steps_are_stored() {
    let whole = area(0, 0, 16, 1);
    let mut bytes = [0; 8];
    let mut frame = PackedFrame::<Gray4>::without_depth(&mut bytes, whole).unwrap();
    let Ok(()) = frame.fill_contiguous(&whole, (0..16).map(Gray4::new));
    assert!(frame.pixels().map(|pixel| pixel.luma()).eq(0..16));
    assert_eq!(bytes, [0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF]);
}
