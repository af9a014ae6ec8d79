//! Triangles from as high as wide to as flat as a sub-pixel.
//!
//! The gradient across a sliver grows with one over its altitude, far beyond the width of a step.
//! Steps wrap, and at a covered centre the sum is between the corners' numbers again, as exact as
//! anywhere (`plane.rs` of the core): the curve is flat.

use rasterizer::{
    attribute::DepthFormat,
    numbers::{S8, Subpixel as _},
};

use super::{
    curve::{Family, Law, Point, powers, sweep},
    fragments::{self, Exact, visit},
    stage::{self, Stage},
    work::{Cost, Work},
};
use crate::reference::random::Random;

const ABOUT: &str = "\
Triangles on a base of 64 pixels in a random direction, of this altitude, that cover a centre, with
random depths at the corners. Stored depth is compared with the plane through the snapped corners in
exact integers.";

/// In 16 bits.
pub(super) static U16: Family = family(
    "Slivers, u16",
    |altitude, random| Some(work("u16", altitude, random)),
    |instances| measure(instances, u32::from(u16::MAX), |depth| depth as u16),
);

/// In 32 bits.
pub(super) static U32: Family = family(
    "Slivers, u32",
    |altitude, random| Some(work("u32", altitude, random)),
    |instances| measure(instances, u32::MAX, |depth| depth),
);

const fn family(
    name: &'static str,
    work: fn(f64, &mut Random) -> Option<Work>,
    measure: fn(usize) -> Vec<Point>,
) -> Family {
    Family {
        name,
        about: ABOUT,
        parameter: "altitude in pixels",
        error: "units of depth",
        laws: &[Law {
            slope: 0.0,
            tolerance: 0.1,
            segment: [0.003_906_25, 64.0],
            why: "steps wrap, so that a gradient of any size is as exact",
        }],
        bound: "1 unit (the crate's table of numbers)",
        end: "It holds down to the least altitude, a sub-pixel. Without an area a triangle covers \
              no centre.",
        cost: Cost {
            of: "to draw the triangle",
            laws: &[
                Law {
                    slope: 0.0,
                    tolerance: 0.1,
                    segment: [0.003_906_25, 0.25],
                    why: "it has as many rows, and next to no pixels",
                },
                Law {
                    slope: 0.7,
                    tolerance: 0.15,
                    segment: [16.0, 64.0],
                    why: "its pixels grow with slope 1; set-up and rows, which do not, are a third \
                          of the cycles",
                },
            ],
            work,
        },
        measure,
    }
}

fn measure<D: DepthFormat + Into<i64>>(
    instances: usize,
    most: u32,
    format: fn(u32) -> D,
) -> Vec<Point> {
    let error = |altitude, random: &mut Random| error(altitude, most, format, random);
    sweep(powers(-8, 6), instances, |_| Some(1.0), error)
}

/// In pixels.
const BASE: f64 = 64.0;

/// The corners of a triangle in sub-pixels. The first is up to `away` pixels from the middle along
/// each axis.
fn corners(altitude: f64, away: f64, random: &mut Random) -> [[i32; 2]; 3] {
    let unit = f64::from(1 << S8::BITS);
    let [x, y] = [random.real(-away, away), random.real(-away, away)];
    let (sin, cos) = random.real(0.0, std::f64::consts::TAU).sin_cos();
    let along = random.real(0.0, BASE);
    let corners = [
        [x, y],
        [x + cos * BASE, y + sin * BASE],
        [x + cos * along - sin * altitude, y + sin * along + cos * altitude],
    ];
    corners.map(|corner| corner.map(|c| (c * unit).round() as i32))
}

/// Draws one that is in the picture.
fn work(depth: &'static str, altitude: f64, random: &mut Random) -> Work {
    let corners = corners(altitude, 30.0, random);
    Stage::of_triangle(corners, random).draw::<S8>(stage::middle(240), depth)
}

fn error<D: DepthFormat + Into<i64>>(
    altitude: f64,
    most: u32,
    format: fn(u32) -> D,
    random: &mut Random,
) -> Option<f64> {
    let mut worst = None;
    while worst.is_none() {
        let corners = corners(altitude, 500.0, random);
        let depths = [(); 3].map(|()| random.real(1.0, f64::from(most)) as u32);
        let (exact, at_corners) = (Exact(corners), depths.map(i64::from));
        let vertices = fragments::corners(corners, depths.map(format));
        visit(&vertices, |pixel, depth, _| {
            let off = exact.error::<S8>(at_corners, pixel, D::at(depth).into(), 0).abs();
            worst = Some(off.max(worst.unwrap_or(0.0)));
        });
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn in_16_bits() {
        holds(&super::U16);
    }

    #[test]
    fn in_32_bits() {
        holds(&super::U32);
    }
}
