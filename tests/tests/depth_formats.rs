//! Floating-point depth over single triangles, against exact planes.

use std::convert::Infallible;

use embedded_graphics::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use host_tools::check::DefinedDepth as _;
use rasterizer::{
    attribute::{DepthFormat as _, FloatDepth, Step as _},
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
    raster::{Layout, Primitive as _, Triangle, Window},
};
use rasterizer_tests::Random;

const WINDOW: Window =
    Window::new(&Rectangle::new(Point::new(-1024, -1024), Size::new_equal(2048)));

const LAYOUT: Layout = Layout { pitch: 0, origin: WINDOW.left() };

/// Depths that are interpolated, and how far off in last bits of the nearest corner's 32.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    pixels: usize,
    /// Pixels of triangles so steep in depth that more than a step may be lost.
    steep: usize,
    /// The largest error in steps of the format.
    steps: f64,
}

/// Draws a triangle whose corners have these places in sub-pixels and these depths' bits, and
/// compares every `every`th row with the exact plane.
fn check<S: Subpixel>(found: &mut Found, corners: [([i32; 2], u16); 3], every: i32) {
    let [a, b, c] = corners.map(|([x, y], bits)| {
        ScreenVertex::<S, FloatDepth, [u16; 0]>::checked(x, y, FloatDepth::from_bits(bits), [])
            .unwrap()
    });
    let triangle = Triangle::new([&a, &b, &c]).unwrap();
    let places = corners.map(|(place, _)| place.map(i128::from));
    let depths = corners.map(|(_, bits)| FloatDepth::from_bits(bits).depth());
    let nearest = depths.into_iter().fold(0.0, f64::max);
    let farthest = depths.into_iter().fold(1.0, f64::min);
    let [width, height] = [0, 1].map(|axis| {
        let all = places.map(|place| place[axis]);
        (all.iter().max().unwrap() - all.iter().min().unwrap()) as f64 / f64::from(1 << S::BITS)
    });
    // Columns and rows from the anchor, at most.
    let steps = width + height + 3.0;
    // By the nearest depth in 32 bits, which has 31 to 32.
    let is_cut = farthest / nearest * 2f64.powi(31) < steps + 2.0;
    let limit = 2f64.powi(20) / if is_cut { 3.0 } else { 1.0 };
    let Ok(()) = triangle.for_each_span(&WINDOW, LAYOUT, |span| {
        if span.row % every != 0 {
            return Ok(());
        }
        let mut value = span.depth;
        for address in span.start..span.end {
            let column = address as i32 + WINDOW.left();
            let half = 1i128 << (S::BITS - 1);
            let [x, y] = [column, span.row].map(|c| (i128::from(c) << S::BITS) + half);
            // Doubled areas, exactly.
            let weight = |i: usize| {
                let ([x0, y0], [x1, y1]) = (places[(i + 1) % 3], places[(i + 2) % 3]);
                (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)
            };
            let weights = [weight(0), weight(1), weight(2)];
            let total: i128 = weights.iter().sum();
            let exact = (0..3).map(|i| weights[i] as f64 / total as f64 * depths[i]).sum::<f64>();
            let got = FloatDepth::at(value);
            let format = FloatDepth::DEFINITION;
            let (units, bits) = (format.units(exact), f64::from(got.to_bits()));
            // From truncated to exact: what truncation takes off is not an error.
            let error = (units - bits - 1.0).max(bits - units);
            found.pixels += 1;
            if nearest / exact * steps <= limit {
                found.steps = found.steps.max(error);
                assert!(error < 1.0, "{corners:?} at ({column}, {}): {units} {bits}", span.row);
            } else {
                found.steep += 1;
                // Last bits of 2^31 to 2^32 in the nearest corner, and truncation.
                let off = (got.depth() - exact).abs();
                let bits = 1.5 * steps + 3.0;
                let bound = nearest * bits * 2f64.powi(-31) + exact * 2f64.powi(-11);
                assert!(off <= bound, "{corners:?} at ({column}, {}): {off} {bound}", span.row);
            }
            // Nothing wraps, and nothing has the depth of a cleared buffer.
            assert!(got.depth() <= nearest * (1.0 + 2f64.powi(-11)), "{corners:?}");
            assert!(got.to_bits() >= 1 << 11, "{corners:?}");
            value = value.wrapping_add(span.depth_step);
        }
        Ok::<(), Infallible>(())
    });
}

/// Bits of a depth whose exponent is `spread` below `exponent`, if there is one.
fn bits(random: &mut Random, exponent: i32, spread: i32) -> u16 {
    let mantissa = match random.within(0, 3) {
        0 => 0,
        1 => 2047,
        _ => random.within(0, 2047),
    };
    ((exponent - random.within(0, spread)).max(2) << 11 | mantissa) as u16
}

fn random_triangles<S: Subpixel>(seed: u64) -> Found {
    let (mut random, mut found) = (Random::new(seed), Found::default());
    let unit = 1 << S::BITS;
    for extent in [unit, 5 * unit, 60 * unit, 400 * unit] {
        for spread in [0, 1, 3, 4, 5, 8, 12, 20, 30] {
            for _ in 0..if extent > 60 * unit { 6 } else { 120 } {
                let exponent = random.within(2, 31);
                let middle = [0; 2].map(|_| random.within(-500 * unit, 500 * unit));
                let corners = [0; 3].map(|_| {
                    let place = middle.map(|c| c + random.within(-extent, extent));
                    (place, bits(&mut random, exponent, spread))
                });
                check::<S>(&mut found, corners, if extent > 60 * unit { 7 } else { 1 });
            }
        }
    }
    found
}

#[test]
fn floating_depth_is_within_a_step_of_the_plane() {
    for found in [random_triangles::<S4>(1), random_triangles::<S8>(2)] {
        assert!(found.pixels > 500_000 && found.steep > 0, "{found:?}");
        // The bound is not loose: half a unit, which is half a step four octaves down.
        assert!(found.steps > 0.4, "{found:?}");
    }
}

/// The guard band's largest triangles and its slivers, with depths at the ends of each way to
/// interpolate.
#[test]
fn floating_depth_never_wraps_in_the_largest_triangles() {
    fn extremes<S: Subpixel>(found: &mut Found) {
        let (low, high) = (-1024 << S::BITS, (1024 << S::BITS) - 1);
        for places in [
            [[low, low], [high, low], [low, high]],
            [[high, high], [high, low], [low, high]],
            [[low, low], [high, high - 1], [high, high]],
            [[low, 0], [high, 1], [high, 0]],
            [[0, low], [1, high], [0, high]],
            [[0, 0], [1, high], [1, high - 1]],
        ] {
            for depths in [
                [0xFFFF, 0x1000, 0x1000],
                [0x1000, 0xFFFF, 0x1000],
                [0x1000, 0x1000, 0xFFFF],
                [0xFFFF, 0xFFFF, 0x1000],
                [0x1000; 3],
                [0x17FF, 0x1000, 0x1800],
                [0xFFFF; 3],
                [0xFFFF, 0xD800, 0xDFFF],
                [0xFFFF, 0xD000, 0xD7FF],
                [0x37FF, 0x1000, 0x1000],
            ] {
                check::<S>(found, [0, 1, 2].map(|i| (places[i], depths[i])), 61);
            }
        }
    }
    let mut found = Found::default();
    extremes::<S4>(&mut found);
    extremes::<S8>(&mut found);
    assert!(found.pixels > 500_000 && found.steep > 1_000, "{found:?}");
}

/// A vertex that the caller makes can have any bits.
#[test]
fn depths_below_the_least_are_drawn_as_the_least() {
    for depths in [[0, 1, 2], [0x07FF, 0, 0x0FFF], [0, 0x1000, 0x1001], [0xFFFF, 0, 0]] {
        let [a, b, c] = [0, 1, 2].map(|i| {
            let [x, y] = [[-99, -99], [900, -30], [40, 800]][i];
            let depth = FloatDepth::from_bits(depths[i]);
            ScreenVertex::<S4, FloatDepth, [u16; 0]>::checked(x, y, depth, []).unwrap()
        });
        let triangle = Triangle::new([&a, &b, &c]).unwrap();
        let allowed = 0x0FFF..=depths.into_iter().max().unwrap().max(0x1000);
        let Ok(()) = triangle.for_each_span(&WINDOW, LAYOUT, |span| {
            let last = span.depth_step.wrapping_mul((span.end - span.start) as i32 - 1);
            for value in [span.depth, span.depth.wrapping_add(last)] {
                let got = FloatDepth::at(value).to_bits();
                assert!(allowed.contains(&got), "{depths:x?}: {got:x}");
            }
            Ok::<(), Infallible>(())
        });
    }
}
