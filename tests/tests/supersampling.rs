//! Pixels that are the mean of several samples: by their definition, in frames and in bands, and
//! how near they come to a picture of 16 x 16 samples.

use embedded_graphics::{
    pixelcolor::{Rgb565, Rgb888, RgbColor},
    primitives::{PointsIter as _, Rectangle},
};
use rasterizer::{
    geometry::ScreenVertex,
    numbers::S8,
    output::{Bands, Frame, Supersampled},
    scene::Object,
};
use rasterizer_tests::{
    Picture, area,
    bands::{self, BACKGROUND, DISPLAY, Position, ball},
};

/// A ball that the edges of the picture cut, in `N` by `N` samples a pixel, as one frame.
fn samples<const N: usize>() -> Picture<Rgb888, u16> {
    let ball = ball();
    let area = Rectangle::new(DISPLAY.top_left * N as i32, DISPLAY.size * N as u32);
    let mut picture = Picture::empty(area, BACKGROUND);
    picture.draw(&ball.mesh(), Position, &bands::at("1.7", area));
    picture
}

/// The mean of each square of samples, in f64.
fn means<const N: usize>(picture: &Picture<Rgb888, u16>) -> Vec<[f64; 3]> {
    let width = picture.area.size.width as usize;
    let corners = (0..picture.color.len() / width)
        .step_by(N)
        .flat_map(|y| (0..width).step_by(N).map(move |x| y * width + x));
    let sum = |corner: usize| {
        let square = (0..N).flat_map(|y| (0..N).map(move |x| corner + y * width + x));
        square.fold([0.0; 3], |[r, g, b], i| {
            let color = picture.color[i];
            [r + f64::from(color.r()), g + f64::from(color.g()), b + f64::from(color.b())]
        })
    };
    corners.map(|corner| sum(corner).map(|sum| sum / (N * N) as f64)).collect()
}

fn channels(color: Rgb888) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(f64::from)
}

fn frames_and_bands<const N: usize>() {
    let mut picture = samples::<N>();
    let means = means::<N>(&picture);
    let frame = Frame::new(&mut picture.color, &mut picture.depth, picture.area).unwrap();
    let resolved = frame.resolved::<N>().unwrap();
    assert_eq!(resolved.area(), DISPLAY);
    let pixels: Vec<_> = resolved.pixels().collect();
    assert_eq!(pixels.len(), means.len());
    for (pixel, mean) in pixels.iter().zip(&means) {
        assert_eq!(channels(*pixel), mean.map(|c| (c + 0.5).floor()), "{mean:?}");
    }

    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position);
    let mut storage = vec![ScreenVertex::<S8, u16, _>::EMPTY; mesh.vertex_count()];
    let camera = bands::at("1.7", Supersampled::<N>::area(DISPLAY));
    let seen = object.project(&camera, &mut storage).unwrap();
    for rows in [1, 5, 47] {
        // Some samples more than whole rows of pixels.
        let length = DISPLAY.size.width as usize * N * (rows * N + N - 1);
        let (mut color, mut depth) = (vec![BACKGROUND; length], vec![0u16; length]);
        let mut bands = Bands::supersampled::<N>(DISPLAY, &mut color[..], &mut depth).unwrap();
        let mut screen = bands::Screen::new(DISPLAY);
        bands
            .show(&mut screen, |band| band.clear_color(BACKGROUND), |band| seen.draw(band))
            .unwrap();
        let shown: Vec<_> = screen.pixels.iter().map(|pixel| pixel.unwrap()).collect();
        assert!(shown == pixels, "{N} x {N} in bands of {rows} rows");
    }
}

#[test]
fn a_pixel_is_the_mean_of_its_samples() {
    frames_and_bands::<2>();
    frames_and_bands::<4>();
}

#[test]
fn only_whole_squares_are_resolved() {
    for (rectangle, is_whole) in [
        (area(0, 0, 4, 8), true),
        (area(-4, 8, 4, 4), true),
        (area(1, 0, 4, 4), false),
        (area(0, -2, 4, 4), false),
        (area(0, 0, 6, 4), false),
        (area(0, 0, 4, 7), false),
        (area(0, 0, 0, 0), true),
    ] {
        let mut color = vec![Rgb565::RED; rectangle.points().count()];
        let frame = Frame::without_depth(&mut color, rectangle).unwrap();
        let resolved = frame.resolved::<4>();
        assert_eq!(resolved.is_some(), is_whole, "{rectangle:?}");
        let pixels = resolved.map_or(0, |resolved| resolved.pixels().count());
        assert_eq!(pixels, if is_whole { color.len() / 16 } else { 0 });
    }
}

/// A frame in a larger buffer, whose other pixels are left out.
#[test]
fn rows_may_lie_apart() {
    let mut color = vec![Rgb565::new(31, 63, 31); 7 * 4];
    let mut frame = Frame::without_depth_with_stride(&mut color, area(2, 0, 4, 4), 7).unwrap();
    frame.clear_color(Rgb565::new(1, 2, 3));
    let resolved = frame.resolved::<2>().unwrap();
    assert_eq!(resolved.area(), area(1, 0, 2, 2));
    assert!(resolved.pixels().eq([Rgb565::new(1, 2, 3); 4]));
}

/// The more samples, the nearer to the mean of 16 x 16: in dB of the peak signal-to-noise ratio.
#[test]
fn more_samples_are_nearer_to_the_exact_mean() {
    let exact = means::<16>(&samples::<16>());
    let decibels = |pixels: &[[f64; 3]]| {
        let errors = pixels.iter().flatten().zip(exact.iter().flatten());
        let squares: f64 = errors.map(|(a, b)| (a - b).powi(2)).sum();
        10.0 * (255f64.powi(2) * (3 * exact.len()) as f64 / squares).log10()
    };
    let one = decibels(&means::<1>(&samples::<1>()));
    let four = decibels(&means::<2>(&samples::<2>()));
    let sixteen = decibels(&means::<4>(&samples::<4>()));
    println!("{one:.1} dB, {four:.1} dB with 2 x 2 samples, {sixteen:.1} dB with 4 x 4");
    // Twice the samples along a side halve the error at edges at least: 6 dB.
    assert!(four > one + 5.0 && sixteen > four + 5.0, "{one} {four} {sixteen}");
}
