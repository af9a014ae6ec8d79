//! Dithered pictures: by a shader's wrapper and on the way to a display, in every format, in bands
//! and in parts of the display.

use std::fmt::Debug;

use embedded_graphics::{
    pixelcolor::{
        Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, GrayColor, Rgb555,
        Rgb565, Rgb666, Rgb888,
    },
    prelude::*,
    primitives::Rectangle,
};
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Distance, Orthographic},
    color::{Dither, Rgb332},
    geometry::CullNone,
    mesh::{Material, Mesh, Positions, Tables, Triangles},
    numbers::{S8, Vec3},
    output::{Bands, Direct, Dithering, Frame, PackedFrame, Rgb565Be, StoredColor},
    scene::Object,
    shade::{Dithered, Gouraud, Shader, Unlit},
};
use rasterizer_tests::{
    Call, Recorder, area,
    bands::{DISPLAY, EYES, Position, Screen, at, ball, light},
};

const fn count(area: &Rectangle) -> usize {
    (area.size.width * area.size.height) as usize
}

/// A shader's colours on black: dithered when they are drawn, when a frame of them is sent, and in
/// bands and parts of the display.
fn all_ways_are_one<C, Sh, const SIZE: usize>(shader: &Sh)
where
    C: PixelColor + Dither + StoredColor + From<Rgb888> + Debug + 'static,
    Sh: Shader<Color = Rgb888>,
{
    let ball = ball();
    let mesh = ball.mesh();
    let black = C::from(Rgb888::BLACK);
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let plain = Object::new(&mesh, shader.clone()).culled(CullNone);
        let plain = plain.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let dithered = Dithered::<_, C, SIZE>::with_size(shader.clone());
        let dithered = Object::new(&mesh, dithered).culled(CullNone);
        let dithered = dithered.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();

        let mut depth = vec![0u16; count(&DISPLAY)];
        let mut pixels = vec![Rgb888::BLACK; count(&DISPLAY)];
        let mut sent = Screen::<C>::new(DISPLAY);
        let mut frame = Frame::new(&mut pixels, &mut depth, DISPLAY).unwrap();
        let Ok(()) = plain.draw(&mut frame);
        let Ok(()) = frame.present(&mut Dithering::<_, _, SIZE>::with_size(&mut sent));
        let lit = sent.drawn(black).len();
        assert!(lit > 50, "only {lit} pixels from {eye}");

        let mut drawn = Screen::<C>::new(DISPLAY);
        let mut pixels = vec![black; count(&DISPLAY)];
        let mut frame = Frame::new(&mut pixels, &mut depth, DISPLAY).unwrap();
        frame.clear(black);
        let Ok(()) = dithered.draw(&mut frame);
        let Ok(()) = frame.present(&mut drawn);
        assert!(drawn == sent, "from {eye}");

        for rows in [1, 3, 8, 20] {
            let needed = 61 * rows;
            let mut screen = Screen::<C>::new(DISPLAY);
            let mut bands = Bands::new(DISPLAY, &mut pixels[..needed], &mut depth).unwrap();
            let Ok(()) =
                bands.show(&mut screen, |band| band.clear_color(black), |band| dithered.draw(band));
            assert!(screen == sent, "{rows} rows from {eye}");

            let mut screen = Screen::<C>::new(DISPLAY);
            let mut display = Dithering::<_, Rgb888, SIZE>::with_size(&mut screen);
            let mut colors = vec![Rgb888::BLACK; needed];
            let mut bands = Bands::new(DISPLAY, &mut colors[..], &mut depth).unwrap();
            let Ok(()) = bands.show(
                &mut display,
                |band| band.clear_color(Rgb888::BLACK),
                |band| plain.draw(band),
            );
            assert!(screen == sent, "{rows} rows sent from {eye}");
        }

        // What has changed, somewhere in the middle.
        let mut screen = sent.clone();
        for dirty in [area(17, 5, 23, 19), area(3, -2, 1, 47), area(30, 11, 34, 2)] {
            let mut pixels = vec![black; count(&dirty)];
            let mut depth = vec![0u16; count(&dirty)];
            let mut part = Frame::new(&mut pixels, &mut depth, dirty).unwrap();
            let Ok(()) = dithered.draw(&mut part);
            let Ok(()) = part.present(&mut screen);
            let mut pixels = vec![Rgb888::BLACK; count(&dirty)];
            depth.fill(0);
            let mut part = Frame::new(&mut pixels, &mut depth, dirty).unwrap();
            let Ok(()) = plain.draw(&mut part);
            let Ok(()) = part.present(&mut Dithering::<_, _, SIZE>::with_size(&mut screen));
        }
        assert!(screen == sent, "parts from {eye}");
    }
}

/// Interpolated colours and triangles of one colour.
fn in_format<C>()
where
    C: PixelColor + Dither + StoredColor + From<Rgb888> + Debug + 'static,
{
    all_ways_are_one::<C, _, 8>(&Position);
    all_ways_are_one::<C, _, 4>(&Unlit::new());
    all_ways_are_one::<C, _, 8>(&Gouraud::new(light()));
}

#[test]
fn one_bit_is_dithered_in_place() {
    in_format::<BinaryColor>();
}

#[test]
fn grays_are_dithered_in_place() {
    in_format::<Gray2>();
    in_format::<Gray4>();
    in_format::<Gray8>();
}

#[test]
fn colors_are_dithered_in_place() {
    in_format::<Rgb332>();
    in_format::<Rgb555>();
    in_format::<Rgb565>();
    in_format::<Rgb565Be>();
    in_format::<Rgb666>();
    in_format::<Rgb888>();
}

#[test]
fn colors_in_the_other_order_are_dithered_in_place() {
    in_format::<Bgr555>();
    in_format::<Bgr565>();
    in_format::<Bgr666>();
    in_format::<Bgr888>();
}

/// Light of a stored value by the curve of sRGB (IEC 61966-2-1).
fn light_of(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// A square of two triangles that fills a display of 64 x 64 pixels.
const SQUARE: Tables<'static> = Tables {
    positions: Positions::I16(&[[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    ..Tables::EMPTY
};

const SQUARE_DISPLAY: Rectangle = area(0, 0, 64, 64);

fn in_front() -> Camera<Orthographic> {
    let [height, near, far] = ["2", "1", "5"].map(Distance::lit);
    let lens = Orthographic::new(height, near, far).unwrap();
    Camera::look_at(Vec3::lit("0", "0", "2"), Vec3::ZERO, Vec3::Y, lens, SQUARE_DISPLAY).unwrap()
}

/// Triangles of one colour are dithered pixel by pixel: each block of 8 x 8 pixels has the light of
/// the shade, within 1/64 of white. A threshold is far off.
#[test]
fn blocks_of_even_triangles_have_the_light_of_their_shade() {
    fn mean<const SIZE: usize>(shade: u8, bound: f64) {
        let materials = [Material::new([shade; 3], 2)];
        let mesh = Mesh::new(Tables { materials: &materials, ..SQUARE }).unwrap();
        let mut bytes = [0; PackedFrame::<BinaryColor>::bytes(Size::new(64, 64))];
        let mut frame =
            PackedFrame::<BinaryColor>::without_depth(&mut bytes, SQUARE_DISPLAY).unwrap();
        let object = Object::new(&mesh, Dithered::<_, _, SIZE>::with_size(Unlit::<Gray8>::new()));
        let Ok(()) = object.project_on_demand(&in_front(), S8).unwrap().draw(&mut frame);
        let mut two_bits = [0; PackedFrame::<Gray2>::bytes(Size::new(64, 64))];
        let mut of_two =
            PackedFrame::<Gray2>::without_depth(&mut two_bits, SQUARE_DISPLAY).unwrap();
        let object = Object::new(&mesh, Dithered::<_, _, SIZE>::with_size(Unlit::<Gray8>::new()));
        let Ok(()) = object.project_on_demand(&in_front(), S8).unwrap().draw(&mut of_two);
        let pixels: Vec<_> = frame.pixels().zip(of_two.pixels()).collect();
        for block in 0..64 {
            let [mut lit, mut light] = [0.0; 2];
            for pixel in 0..64 {
                let (x, y) = (block % 8 * 8 + pixel % 8, block / 8 * 8 + pixel / 8);
                let (one, two) = pixels[y * 64 + x];
                lit += f64::from(u8::from(one.is_on())) / 64.0;
                light += light_of(85 * two.luma()) / 64.0;
            }
            let wanted = light_of(shade);
            assert!((lit - wanted).abs() <= bound, "shade {shade}, block {block}: {lit}");
            assert!((light - wanted).abs() <= bound, "shade {shade}, block {block}: {light}");
        }
    }
    for shade in 0..=255 {
        mean::<8>(shade, 1.0 / 64.0);
        // Sixteen pixels have seventeen levels: none may be nearer than 1/32.
        mean::<4>(shade, 1.0 / 32.0);
    }
    // What a threshold shows of half the light of white.
    assert_eq!(BinaryColor::from(Rgb888::new(188, 188, 188)), BinaryColor::On);
    assert!((light_of(188) - 0.5).abs() < 0.01);
}

/// Black, white and other even colours reach a display as rectangles of one colour, which drivers
/// fill quickly; others pixel by pixel. Nothing is sent twice.
#[test]
fn even_colors_stay_rectangles() {
    let part = area(2, 3, 5, 2);
    let mut display = Recorder::<BinaryColor>::new(DISPLAY);
    let mut gray = Dithering::<_, Gray8>::new(&mut display);
    gray.fill_solid(&part, Gray8::BLACK).unwrap();
    gray.fill_solid(&part, Gray8::WHITE).unwrap();
    gray.fill_solid(&part, Gray8::new(120)).unwrap();
    gray.draw_iter([Pixel(Point::new(7, 7), Gray8::new(250))]).unwrap();
    assert_eq!(gray.bounding_box(), DISPLAY);
    let pixels: Vec<_> =
        part.points().map(|at| BinaryColor::dithered::<8>(Gray8::new(120), at.x, at.y)).collect();
    assert!(pixels.contains(&BinaryColor::On) && pixels.contains(&BinaryColor::Off));
    let wanted = [
        Call::Solid(part, BinaryColor::Off),
        Call::Solid(part, BinaryColor::On),
        Call::Contiguous(part, pixels),
        Call::Iter(vec![Pixel(Point::new(7, 7), BinaryColor::On)]),
    ];
    assert_eq!(display.calls(), wanted);

    // 85 is a step of two bits, 100 lies between two.
    let mut display = Recorder::<Gray2>::new(DISPLAY);
    let mut gray = Dithering::<_, Rgb888, 4>::with_size(&mut display);
    gray.fill_solid(&part, Rgb888::new(85, 85, 85)).unwrap();
    gray.fill_solid(&part, Rgb888::new(100, 100, 100)).unwrap();
    assert_eq!(display.calls()[0], Call::Solid(part, Gray2::new(1)));
    assert!(matches!(display.calls()[1], Call::Contiguous(..)));
}

/// Straight onto a display of one bit, without a buffer.
#[test]
fn a_display_without_a_buffer_shows_the_same() {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("3", DISPLAY);
    let object =
        Object::new(&mesh, Dithered::<_, BinaryColor>::new(Gouraud::<Gray8>::new(light())));
    let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let mut bytes = vec![0; PackedFrame::<BinaryColor>::bytes(DISPLAY.size)];
    let mut frame = PackedFrame::<BinaryColor>::without_depth(&mut bytes, DISPLAY).unwrap();
    let Ok(()) = seen.draw(&mut frame);
    let mut shown = vec![BinaryColor::Off; count(&DISPLAY)];
    let mut display = Frame::without_depth(&mut shown, DISPLAY).unwrap();
    let Ok(()) = seen.draw(&mut Direct::new(&mut display));
    assert!(frame.pixels().eq(shown));
    assert!(frame.pixels().filter(|pixel| pixel.is_on()).count() > 100);
}
