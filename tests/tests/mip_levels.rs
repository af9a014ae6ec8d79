//! The mip level of each pixel of a floor, by the shader and by the derivative of where the ray of
//! the pixel meets the floor, in f64.

use std::fmt::Debug;

use embedded_graphics::{
    pixelcolor::Gray8,
    prelude::{GrayColor as _, Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{Adaptive, Correction, Every, EveryPixel, NoDepth},
    mesh::{Material, Mesh, Positions, Tables, TextureCoordinates, Triangles},
    numbers::Vec3,
    prelude::*,
    shade::{OnScreen, Textured},
    texture::{Colors, Filter, Mipmaps, NearestMip, PerPixel, PerTriangle, Trilinear},
};

const WIDTH: usize = 160;
const HEIGHT: usize = 120;

/// In pixels.
const FOCAL_LENGTH: f64 = 100.0;

/// Of the eye above the floor.
const EYE: f64 = 1.5;

/// A floor from 1 to 60 units ahead, one repeat a unit.
static FLOOR: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-4, 0, -1], [4, 0, -1], [4, 0, -60], [-4, 0, -60]]),
    texture_coordinates: TextureCoordinates::I32(&[
        [-4 << 24, 59 << 24],
        [4 << 24, 59 << 24],
        [4 << 24, 0],
        [-4 << 24, 0],
    ]),
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([255; 3], 2)],
    ..Tables::EMPTY
});

const SIDE: usize = 32;
const LAST: f64 = 5.0;
const COUNT: usize = (4 * SIDE * SIDE - 1) / 3;

/// What a level is brighter than the one before it.
const STEP: u8 = 40;

/// Level k has the grey 40 k.
const GRAYS: [Gray8; COUNT] = {
    let mut grays = [Gray8::new(0); COUNT];
    let (mut place, mut level, mut left) = (0, 0, SIDE * SIDE);
    while place < COUNT {
        if left == 0 {
            level += 1;
            left = (SIDE >> level) * (SIDE >> level);
        }
        grays[place] = Gray8::new(STEP * level as u8);
        (place, left) = (place + 1, left - 1);
    }
    grays
};

type Texture = Mipmaps<Colors<'static, Gray8, COUNT>, SIDE, SIDE>;
static TEXTURE: [Texture; 1] = [Mipmaps::new(Colors::new(&GRAYS))];

/// Draws the floor, and calls `check` with the level by the definition and the one that is drawn.
/// Returns the number of pixels.
fn drawn<F, M>(filter: F, correction: M, check: impl Fn(f64, f64)) -> usize
where
    F: Filter<Texture> + Debug,
    M: Correction,
{
    let picture = Rectangle::new(Point::zero(), Size::new(WIDTH as u32, HEIGHT as u32));
    let lens = Perspective::with_focal_length(
        Distance::lit("100"),
        Distance::lit("0.5"),
        Distance::lit("100"),
    );
    let eye = Vec3::lit("0", "1.5", "0");
    let camera = Camera::at(eye, Rotation::IDENTITY, lens.unwrap(), picture).unwrap();
    let shader =
        Textured::new(&TEXTURE).filtered(filter).corrected(correction).with_wide_coordinates();
    let mut pixels = vec![Gray8::new(255); WIDTH * HEIGHT];
    let mut frame = Frame::without_depth(&mut pixels, picture).unwrap();
    draw(shader, &camera, &mut frame);
    let mut count = 0;
    for (place, pixel) in pixels.iter().enumerate().filter(|(_, pixel)| pixel.luma() != 255) {
        // The ray meets the floor at the depth t = h f / y, with u = h x / y and v = 1 - t: the
        // determinant of their derivatives is h^2 f / y^3.
        let y = (place / WIDTH) as f64 + 0.5 - (HEIGHT / 2) as f64;
        let area = EYE * EYE * FOCAL_LENGTH / y.powi(3);
        let exact = (area * (SIDE * SIDE) as f64).log2() / 2.0;
        check(exact.clamp(0.0, LAST), f64::from(pixel.luma()) / f64::from(STEP));
        count += 1;
    }
    count
}

fn draw<Sh: Shader<Color = Gray8>>(
    shader: Sh,
    camera: &Camera<Perspective>,
    frame: &mut Frame<'_, Gray8, NoDepth>,
) {
    let mut vertices = [ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; 4];
    Object::new(&FLOOR, shader).project(camera, &mut vertices).unwrap().draw(frame).unwrap();
}

/// A level is within 1/30, its fraction within 1/512, and a grey within half of 1/40 level for each
/// of three roundings; near / w adds less than 1/100.
fn trilinear_is_near<M: Correction>(correction: M) {
    let pixels = drawn(Trilinear(PerPixel), correction, |exact, level| {
        assert!((level - exact).abs() < 1.0 / 30.0 + 1.5 / 40.0 + 1.0 / 90.0, "{level} {exact}");
    });
    assert!(pixels > 6000, "{pixels} pixels");
}

#[test]
fn levels_of_pixels_follow_the_derivative_in_every_mode() {
    trilinear_is_near(EveryPixel);
    trilinear_is_near(Every::<16>);
    trilinear_is_near(Every::<5>);
    trilinear_is_near(Adaptive::<1>);
    trilinear_is_near(Adaptive::<8>);
}

/// The nearest of two levels is within half a level, and 1/20 for the error of the level.
#[test]
fn the_nearest_level_is_taken() {
    let pixels = drawn(NearestMip(PerPixel), EveryPixel, |exact, level| {
        assert_eq!(level, level.round());
        assert!((level - exact).abs() < 0.55, "{level} {exact}");
    });
    assert!(pixels > 6000, "{pixels} pixels");
}

/// One level for a triangle whose distances are 1:60 is off by up to log2 60 = 5.9 levels.
#[test]
fn a_level_for_a_triangle_is_that_of_its_middle() {
    use std::cell::RefCell;
    let levels = RefCell::new(Vec::new());
    drawn(NearestMip(PerTriangle), EveryPixel, |exact, level| {
        levels.borrow_mut().push((exact, level));
    });
    let levels = levels.into_inner();
    let mut drawn: Vec<_> = levels.iter().map(|&(_, level)| level as u32).collect();
    drawn.sort_unstable();
    drawn.dedup();
    // Both triangles have half the square's area on both sides of the mapping: one level each.
    assert!(drawn.len() <= 2, "{drawn:?}");
    let range = levels
        .iter()
        .fold((9.0f64, 0.0f64), |(least, most), &(exact, _)| (least.min(exact), most.max(exact)));
    assert!(
        drawn.iter().all(|&level| { (range.0 - 0.5..range.1 + 0.5).contains(&f64::from(level)) })
    );
}
