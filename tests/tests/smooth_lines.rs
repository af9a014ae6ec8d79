//! Antialiased lines against the reference: how much of each pixel they cover, the values along
//! them, how they are blended; those of an object hidden by its triangles, and alike in bands.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::{PointsIter as _, Rectangle},
};
use fixed::types::U8F8;
use host_tools::reference;
use rasterizer::{
    attribute::NoDepth,
    color::Alpha,
    geometry::ScreenVertex,
    mesh::{Lines, Segments},
    numbers::{S4, S8, Subpixel},
    output::{Add, Frame, KeepDepth, Over, Readable as _, Replace, Target as _},
    raster::{Bias, SmoothLine, Window},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Picture, Random, area,
    bands::{BACKGROUND, DISPLAY, Position, ROWS, at, ball, picture},
    edges, front_vertices,
};

/// A window beyond which lines reach on all sides.
const WINDOW: Rectangle = area(-5, -3, 40, 30);

/// Before a coverage is rounded to steps of 1/256 it is within 2^-12.
const ERROR: f64 = 1.0 / 512.0 + 1.0 / 4096.0;

fn definition<S: Subpixel>(ends: [[i32; 2]; 2], width: U8F8) -> reference::SmoothLine {
    let pixels = |c: i32| f64::from(c) / f64::from(1 << S::BITS);
    reference::SmoothLine { ends: ends.map(|end| end.map(pixels)), width: width.into() }
}

/// The pixels of a window, row by row.
fn pixels(window: Rectangle) -> impl Iterator<Item = [i64; 2]> {
    window.points().map(|point| [point.x, point.y].map(i64::from))
}

/// The coverage of each pixel of the window in steps of 1/256, 0 where none is drawn.
fn covered<S: Subpixel>(ends: [[i32; 2]; 2], width: U8F8, window: Rectangle) -> Vec<u32> {
    let [from, to] = ends
        .map(|[x, y]| ScreenVertex::<S, NoDepth, [u16; 0]>::checked(x, y, NoDepth, []).unwrap());
    let line = SmoothLine::new([&from, &to], width).unwrap();
    let mut colors = vec![Rgb888::BLACK; (window.size.width * window.size.height) as usize];
    let mut frame = Frame::without_depth(&mut colors, window).unwrap();
    frame
        .blend(&line, &Window::new(&window), |stored, fragment| {
            assert_eq!(stored, Rgb888::BLACK, "a pixel is visited twice");
            let (_, [coverage]) = fragment.varyings;
            let [high, low] = coverage.to_num::<u16>().to_be_bytes();
            Rgb888::new(high, low, 0)
        })
        .unwrap();
    colors.iter().map(|color| u32::from(color.r()) << 8 | u32::from(color.g())).collect()
}

/// Returns the sum of the coverages.
fn check<S: Subpixel>(ends: [[i32; 2]; 2], width: U8F8, window: Rectangle) -> f64 {
    let line = definition::<S>(ends, width);
    let got = covered::<S>(ends, width, window);
    for (pixel, &got) in pixels(window).zip(&got) {
        let (got, expected) = (f64::from(got) / 256.0, line.coverage(pixel));
        let error = (got - expected).abs();
        assert!(error <= ERROR, "{ends:?} of {width} at {pixel:?}: {got}, not {expected}");
    }
    got.iter().map(|&coverage| f64::from(coverage) / 256.0).sum()
}

/// All lines between the points of a grid of quarters of a pixel.
#[test]
fn every_small_line_covers_what_the_definition_does() {
    let places = |step: i32| (0..9).flat_map(move |y| (0..9).map(move |x| [x * step, y * step]));
    let window = area(-3, -3, 9, 9);
    for (i, from) in places(4).enumerate() {
        for (j, to) in places(4).enumerate() {
            let width = U8F8::from_bits([256, 1, 100, 384, 512][(i + j) % 5]);
            check::<S4>([from, to], width, window);
            check::<S8>([from, to].map(|end| end.map(|c| c * 16)), width, window);
        }
    }
}

#[test]
fn random_lines_cover_what_the_definition_does() {
    fn lines<S: Subpixel>(seed: u64) {
        let mut random = Random::new(seed);
        let mut sum = 0.0;
        for extent in [1, 3, 20, 60, 900] {
            for _ in 0..400 {
                let reach = extent << S::BITS;
                let ends = [0; 2].map(|_| [0; 2].map(|_| random.within(-reach, reach)));
                let width = U8F8::from_bits(random.within(1, 1100) as u16);
                sum += check::<S>(ends, width, WINDOW);
            }
        }
        assert!(sum > 10_000.0, "{sum}");
    }
    lines::<S4>(1);
    lines::<S8>(2);
}

/// The longest lines that fit, the widest one, and lines that are flat or steep by a sub-pixel.
#[test]
fn extreme_lines_cover_what_the_definition_does() {
    fn lines<S: Subpixel>() {
        let (low, high) = (-1024 << S::BITS, (1024 << S::BITS) - 1);
        let half = 1 << (S::BITS - 1);
        let ends = [low, -1, 0, 1, half, half + 1, high];
        let places = || ends.into_iter().flat_map(|x| ends.into_iter().map(move |y| [x, y]));
        for (from, to) in places().flat_map(|from| places().map(move |to| (from, to))) {
            check::<S>([from, to], U8F8::ONE, WINDOW);
            check::<S>([from, to], U8F8::lit("2.5"), area(1000, -1024, 24, 10));
            check::<S>([from, to], U8F8::MAX, area(-130, -130, 12, 12));
        }
    }
    lines::<S4>();
    lines::<S8>();
}

/// Depth and varyings along a line are within a unit of the reference, and within their ends.
#[test]
fn values_are_linear_along_the_longer_axis() {
    fn lines<S: Subpixel>(seed: u64) {
        let count = (WINDOW.size.width * WINDOW.size.height) as usize;
        let mut random = Random::new(seed);
        let mut visited = 0;
        for extent in [1, 3, 20, 60, 900] {
            for _ in 0..200 {
                let reach = extent << S::BITS;
                let ends = [0; 2].map(|_| [0; 2].map(|_| random.within(-reach, reach)));
                let values = [0; 4].map(|_| random.within(1, 65_535) as u16);
                let width = U8F8::from_bits(random.within(100, 700) as u16);
                let end = |i: usize| {
                    let [x, y] = ends[i];
                    ScreenVertex::<S, u16, _>::checked(x, y, values[i], [values[2 + i]]).unwrap()
                };
                let (from, to) = (end(0), end(1));
                let line = SmoothLine::new([&from, &to], width).unwrap();
                let (mut colors, mut depth) = (vec![Rgb888::BLACK; count], vec![0u16; count]);
                let mut frame = Frame::new(&mut colors, &mut depth[..], WINDOW).unwrap();
                frame
                    .shade(&line, &Window::new(&WINDOW), |fragment| {
                        let ([value], _) = fragment.varyings;
                        let value: u16 = value.to_num();
                        Rgb888::new((value >> 8) as u8, value as u8, 1)
                    })
                    .unwrap();
                let line = definition::<S>(ends, width);
                for (i, pixel) in pixels(WINDOW).enumerate().filter(|(i, _)| depth[*i] > 0) {
                    visited += 1;
                    let part = line.part(pixel);
                    let at = |a: u16, b: u16| f64::from(a) + (f64::from(b) - f64::from(a)) * part;
                    let value = u16::from(colors[i].r()) << 8 | u16::from(colors[i].g());
                    for (got, [a, b]) in
                        [(depth[i], [values[0], values[1]]), (value, [values[2], values[3]])]
                    {
                        // As for a line that is not antialiased.
                        let error = (f64::from(got) - at(a, b)).abs();
                        assert!(error < 0.85, "{ends:?} {values:?} at {pixel:?}: {error}");
                        assert!((a.min(b)..=a.max(b)).contains(&got), "{got} beyond {a} and {b}");
                    }
                }
            }
        }
        assert!(visited > 10_000, "{visited}");
    }
    lines::<S4>(3);
    lines::<S8>(4);
}

/// One line of an object in each mode: the colour is blended by the coverage, as the mode's
/// definition tells, and the stored depth stays.
#[test]
fn lines_are_blended_by_their_coverage() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let mut storage = vec![ScreenVertex::<S8, u16, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&at("3", DISPLAY), &mut storage).unwrap();
    let (stored, color) = (Rgb888::new(40, 200, 0), Rgb888::new(240, 10, 130));
    let count = (DISPLAY.size.width * DISPLAY.size.height) as usize;
    let half = Alpha::HALF;
    for edge in edges(&mesh).into_iter().step_by(29) {
        let one = [edge];
        let lines = Lines::new(&mesh, Segments::U16(&one)).unwrap();
        let ends = edge.map(|i| seen.vertices()[usize::from(i)].position().unwrap());
        let width = U8F8::lit("1.75");
        let covered = covered::<S8>(ends, width, DISPLAY);
        let smooth = seen.lines(&lines).smooth(width);
        for mode in 0..4 {
            let (mut colors, mut depth) = (vec![stored; count], vec![1u16; count]);
            let mut frame = Frame::new(&mut colors, &mut depth, DISPLAY).unwrap();
            match mode {
                0 => smooth.fill(color, &mut frame).unwrap(),
                1 => smooth.blended(KeepDepth(Over(half))).fill(color, &mut frame).unwrap(),
                2 => smooth.blended(Add(Alpha::OPAQUE)).fill(color, &mut frame).unwrap(),
                _ => smooth.blended(Replace).fill(color, &mut frame).unwrap(),
            }
            for (got, coverage) in colors.iter().zip(&covered) {
                let part = f64::from(*coverage) / 256.0;
                let channel = |stored: u8, new: u8| {
                    let (stored, new) = (f64::from(stored), f64::from(new));
                    match mode {
                        0 => stored + (new - stored) * part,
                        1 => stored + (new - stored) * part / 2.0,
                        2 => (stored + new * part).min(255.0),
                        _ if part >= 0.5 => new,
                        _ => stored,
                    }
                };
                let expected = [
                    channel(stored.r(), color.r()),
                    channel(stored.g(), color.g()),
                    channel(stored.b(), color.b()),
                ];
                let got = [got.r(), got.g(), got.b()].map(f64::from);
                // Half a step of rounding, and in mode 1 half of 1/256 of 200 for the alpha's.
                let most = if mode == 1 { 0.5 + 200.0 / 512.0 } else { 0.51 };
                let is_near = got.iter().zip(expected).all(|(a, b)| (a - b).abs() <= most);
                assert!(is_near, "{mode} {coverage}: {got:?}, not {expected:?}");
            }
            let stores = |coverage: u32| match mode {
                0 | 1 => false,
                2 => coverage > 0,
                _ => coverage >= 128,
            };
            let is_stored = depth.iter().map(|depth| *depth > 1);
            assert!(is_stored.eq(covered.iter().map(|coverage| stores(*coverage))), "{mode}");
        }
    }
}

/// Over the depth of the triangles, in the colours of the shader, in bands and in the whole frame.
#[test]
fn bands_join_without_a_seam() {
    let ball = ball();
    let mesh = ball.mesh();
    let edges = edges(&mesh);
    let lines = Lines::new(&mesh, Segments::U16(&edges)).unwrap();
    for z in ["3", "1.2", "0.9", "0.18"] {
        let object = Object::new(&mesh, Position).biased(Bias::BEHIND_LINES);
        let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&at(z, DISPLAY), &mut storage).unwrap();
        let width = U8F8::lit("1.25");
        let draw = |band: &mut Frame<'_, _, &mut [u16]>| {
            seen.draw_depth(band)?;
            seen.lines(&lines).smooth(width).draw(band)
        };
        let whole = picture::<u16>(ROWS, draw);
        let drawn = whole.drawn(BACKGROUND).len();
        assert!(drawn > 100, "{z}: {drawn}");
        for rows in [1, 7, 16] {
            assert!(whole == picture::<u16>(rows, draw), "{z} in bands of {rows} rows");
        }
    }
}

/// A convex body hides its far side: the lines of that leave the pixels inside its outline alone.
#[test]
fn hidden_lines_leave_the_surface() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let mut storage = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&at("3", DISPLAY), &mut storage).unwrap();
    let is_front = front_vertices(&seen, &mesh);
    let is_hidden = |edge: &[u16; 2]| !edge.iter().any(|end| is_front[usize::from(*end)]);
    let hidden: Vec<_> = edges(&mesh).into_iter().filter(is_hidden).collect();
    assert!(hidden.len() > 100, "{}", hidden.len());
    let lines = Lines::new(&mesh, Segments::U16(&hidden)).unwrap();
    let mut picture = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
    let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
    seen.draw_depth(&mut frame).unwrap();
    seen.lines(&lines).smooth(U8F8::ONE).fill(Rgb888::WHITE, &mut frame).unwrap();
    let pixels = picture.color.iter().zip(&picture.depth);
    let drawn = pixels.filter(|(color, depth)| **color != BACKGROUND && **depth > 0).count();
    // At the outline a line's pixels may lie half a pixel away from it, nearer than the surface.
    assert!(drawn < 40, "{drawn}");
}
