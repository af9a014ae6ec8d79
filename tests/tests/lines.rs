//! Lines on the screen against the reference: which pixels they own, each once, and the values
//! along them.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::{PointsIter as _, Rectangle},
};
use host_tools::reference;
use rasterizer::{
    attribute::{Interpolate, NoDepth},
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
    output::{Direct, Frame, Target as _},
    raster::{Line, Window},
};
use rasterizer_tests::{Counter, Random, area};

/// A window beyond which lines reach on all sides.
const WINDOW: Rectangle = area(-5, -3, 40, 30);

/// Start and end in sub-pixels, and a width in pixels.
type Segment = ([[i32; 2]; 2], u8);

const fn vertex<S: Subpixel, V: Interpolate>(
    [x, y]: [i32; 2],
    varyings: V,
) -> ScreenVertex<S, NoDepth, V> {
    ScreenVertex::checked(x, y, NoDepth, varyings).expect("the end lies on the screen")
}

fn definition<S: Subpixel>((ends, width): Segment) -> reference::Line {
    reference::Line {
        ends: ends.map(|end| end.map(i64::from)),
        subpixel_bits: S::BITS,
        width: width.into(),
    }
}

/// The pixels of a window, row by row.
fn pixels(window: Rectangle) -> impl Iterator<Item = [i32; 2]> {
    window.points().map(|point| [point.x, point.y])
}

/// How often each pixel of the window is drawn by lines, one after another.
fn drawn<S: Subpixel>(lines: &[Segment], window: Rectangle) -> Vec<u32> {
    let mut counter = Counter::<Rgb888>::new(window);
    for &(ends, width) in lines {
        let [from, to] = ends.map(|end| vertex::<S, [u16; 0]>(end, []));
        let line = Line::new([&from, &to]).unwrap().wide(width);
        let mut direct = Direct::new(&mut counter);
        direct.fill(&line, &Window::new(&window), Rgb888::WHITE).unwrap();
    }
    counter.counts().to_vec()
}

fn check<S: Subpixel>(segment: Segment, window: Rectangle) {
    let line = definition::<S>(segment);
    let owned: Vec<_> =
        pixels(window).map(|pixel| u32::from(line.owns(pixel.map(i64::from)))).collect();
    assert_eq!(drawn::<S>(&[segment], window), owned, "{segment:?}");
}

/// All lines between the points of a grid of quarters of a pixel: every case of ends on corners,
/// sides and centres of diamonds.
#[test]
fn every_small_line_owns_the_pixels_of_the_definition() {
    let places = |step: i32| (0..9).flat_map(move |y| (0..9).map(move |x| [x * step, y * step]));
    for (from, to) in places(4).flat_map(|from| places(4).map(move |to| (from, to))) {
        check::<S4>(([from, to], 1), area(-2, -2, 7, 7));
    }
    for (from, to) in places(64).flat_map(|from| places(64).map(move |to| (from, to))).step_by(7) {
        check::<S8>(([from, to], 1), area(-2, -2, 7, 7));
    }
}

/// Among them lines that cross the window's sides, and those that miss it.
#[test]
fn random_lines_own_the_pixels_of_the_definition() {
    fn lines<S: Subpixel>(seed: u64) {
        let mut random = Random::new(seed);
        for extent in [1, 3, 20, 60, 900] {
            for _ in 0..400 {
                let reach = extent << S::BITS;
                let ends = [0; 2].map(|_| [0; 2].map(|_| random.within(-reach, reach)));
                let width = random.within(1, 4) as u8;
                check::<S>((ends, width), WINDOW);
            }
        }
    }
    lines::<S4>(1);
    lines::<S8>(2);
}

/// The longest lines that fit, and lines that are flat or steep by a sub-pixel.
#[test]
fn extreme_lines_own_the_pixels_of_the_definition() {
    fn lines<S: Subpixel>() {
        let (low, high) = (-1024 << S::BITS, (1024 << S::BITS) - 1);
        let half = 1 << (S::BITS - 1);
        let ends = [low, -1, 0, 1, half, half + 1, high];
        let places = || ends.into_iter().flat_map(|x| ends.into_iter().map(move |y| [x, y]));
        for (from, to) in places().flat_map(|from| places().map(move |to| (from, to))) {
            check::<S>(([from, to], 1), WINDOW);
            check::<S>(([from, to], 3), area(1000, -1024, 24, 10));
        }
    }
    lines::<S4>();
    lines::<S8>();
}

/// A polyline whose parts run along the same axis in the same direction draws no pixel twice, and
/// leaves out none.
#[test]
fn lines_share_no_pixel_at_a_joint() {
    let mut random = Random::new(5);
    let window = area(-200, -200, 1000, 1000);
    for _ in 0..40 {
        let mut at = [random.within(0, 300), random.within(0, 300)];
        let mut lines = vec![];
        for _ in 0..40 {
            let along = random.within(0, 200);
            let to = [at[0] + along, at[1] + random.within(-along, along)];
            lines.push(([at, to], 1));
            at = to;
        }
        let counts = drawn::<S4>(&lines, window);
        assert!(counts.iter().all(|count| *count <= 1), "{lines:?}");
        // One in each column.
        let columns = (at[0] - lines[0].0[0][0]) >> 4;
        let drawn = counts.iter().sum::<u32>() as i32;
        assert!((columns..=columns + 1).contains(&drawn), "{drawn} {columns}");
    }
}

/// Depth and varyings along a line are within a unit of the reference, and within their ends.
#[test]
fn values_are_linear_along_the_longer_axis() {
    fn lines<S: Subpixel>(seed: u64) {
        let size = WINDOW.size;
        let count = (size.width * size.height) as usize;
        let mut random = Random::new(seed);
        for extent in [1, 3, 20, 60, 900] {
            for _ in 0..200 {
                let reach = extent << S::BITS;
                let ends = [0; 2].map(|_| [0; 2].map(|_| random.within(-reach, reach)));
                let values = [0; 4].map(|_| random.within(1, 65_535) as u16);
                let width = random.within(1, 3) as u8;
                let end = |i: usize| {
                    let [x, y] = ends[i];
                    ScreenVertex::<S, u16, _>::checked(x, y, values[i], [values[2 + i]]).unwrap()
                };
                let (from, to) = (end(0), end(1));
                let line = Line::new([&from, &to]).unwrap().wide(width);
                let (mut colors, mut depth) = (vec![Rgb888::BLACK; count], vec![0u16; count]);
                let mut frame = Frame::new(&mut colors, &mut depth[..], WINDOW).unwrap();
                let window = Window::new(&WINDOW);
                frame
                    .shade(&line, &window, |fragment| {
                        let [value] = fragment.varyings;
                        let value: u16 = value.to_num();
                        Rgb888::new((value >> 8) as u8, value as u8, 1)
                    })
                    .unwrap();
                let line = definition::<S>((ends, width));
                for (i, [x, y]) in pixels(WINDOW).enumerate() {
                    let pixel = [i64::from(x), i64::from(y)];
                    if !line.owns(pixel) {
                        assert_eq!((depth[i], colors[i]), (0, Rgb888::BLACK));
                        continue;
                    }
                    let part = line.part(pixel);
                    let at = |a: u16, b: u16| f64::from(a) + (f64::from(b) - f64::from(a)) * part;
                    let color = colors[i];
                    let value = u16::from(color.r()) << 8 | u16::from(color.g());
                    for (got, [a, b]) in
                        [(depth[i], [values[0], values[1]]), (value, [values[2], values[3]])]
                    {
                        // Half a unit of rounding, and a quarter and 3/2 n / 2^16 of steps over
                        // n < 2^12 pixels, as for a triangle.
                        let error = (f64::from(got) - at(a, b)).abs();
                        assert!(error < 0.85, "{ends:?} {values:?} at {x}, {y}: {error}");
                        assert!((a.min(b)..=a.max(b)).contains(&got), "{got} beyond {a} and {b}");
                    }
                }
            }
        }
    }
    lines::<S4>(3);
    lines::<S8>(4);
}
