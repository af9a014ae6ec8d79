//! Long spans: what steps add up to.
//!
//! A step is rounded to 2^-19 of a unit with depth in 32 bits, which has 18 binary digits behind
//! the point; a span of n pixels adds up n of them, and the first value has half a digit of its own
//! (`plane.rs` of the core). With 16 bits there are 16 digits, but a step comes from a reciprocal
//! of 27 bits instead of a division.

use rasterizer::{
    attribute::DepthFormat,
    numbers::{S8, Subpixel as _},
};

use super::{
    curve::{Family, Law, powers, sweep},
    fragments::{self, Exact, visit},
    stage::Stage,
    work::{Cost, Scene, Work},
};
use crate::reference::random::Random;

const ABOUT: &str = "\
Depth over triangles of this width and up to four rows, with random depths at the corners, against
the plane through these in exact integers, before it is rounded to a whole unit.";
const PARAMETER: &str = "pixels";
const ERROR: &str = "units of depth before rounding";
const END: &str = "\
It holds up to 2,048 pixels, the width of the guard band. Rounding to a unit adds a half, and the
sum stays below the promised unit.";

/// In 32 bits.
pub(super) static U32: Family = Family {
    name: "Long spans, u32",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [16.0, 2048.0],
        why: "each pixel adds the rounding of a step",
    }],
    bound: "2^-18 for each column and row (`plane.rs`)",
    end: END,
    cost: cost(|width, random| Some(work("u32", width, random))),
    measure: |instances| {
        let bound = |width| Some((width + ROWS) / 2f64.powi(18));
        // It counts modulo 2^50.
        let stepped = |value: u64| (value & ((1 << 50) - 1)) as i64;
        sweep(powers(3, 11), instances, bound, |width, random| {
            error(width, u32::MAX, |depth: u32| depth, stepped, 18, random)
        })
    },
};

/// In 16 bits.
pub(super) static U16: Family = Family {
    name: "Long spans, u16",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [512.0, 2048.0],
        why: "each pixel adds the rounding of a step; in shorter spans, whose gradients are \
              larger, the reciprocal's error is more than that",
    }],
    bound: "1/4, 3/2 2^-16 for each column and row, and 2^-8 (`plane.rs`)",
    end: END,
    cost: cost(|width, random| Some(work("u16", width, random))),
    measure: |instances| {
        let bound = |width| Some(0.25 + 1.5 * (width + ROWS) / 65_536.0 + 2f64.powi(-8));
        sweep(powers(3, 11), instances, bound, |width, random| {
            error(width, u32::from(u16::MAX), |depth| depth as u16, i64::from, 16, random)
        })
    },
};

/// What is measured of a triangle.
const fn cost(work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost {
        of: "to draw the triangle",
        laws: &[Law {
            slope: 0.7,
            tolerance: 0.15,
            segment: [512.0, 2048.0],
            why: "its pixels grow with slope 1; set-up and rows, which do not, are a third of the \
                  cycles",
        }],
        work,
    }
}

/// Of a triangle, at most.
const ROWS: f64 = 5.0;

/// The corners of a triangle in sub-pixels, which begins at a place.
fn corners(width: f64, [left, top]: [f64; 2], random: &mut Random) -> [[i32; 2]; 3] {
    let unit = f64::from(1 << S8::BITS);
    // The guard band ends before its last sub-pixel does.
    let width = width - 2.0 / unit;
    let mut row = || top + random.real(0.0, 4.0);
    let corners = [[left, row()], [left + width, row()], [left + width * 0.5, row()]];
    corners.map(|corner| corner.map(|c| (c * unit) as i32))
}

/// Draws one into a picture as wide as the guard band.
fn work(depth: &'static str, width: f64, random: &mut Random) -> Work {
    let corners = corners(width, [-width / 2.0, -ROWS / 2.0], random);
    let size = [2048, 8];
    let scene = Scene { size, ..Stage::of_triangle(corners, random).scene::<S8>() };
    Work::Draw { scene, part: [0, 0, 2048, 8], depth }
}

/// `stepped` returns a value with `bits` binary digits behind the point.
fn error<D: DepthFormat>(
    width: f64,
    most: u32,
    format: impl Fn(u32) -> D,
    stepped: impl Fn(D::Walk) -> i64,
    bits: u32,
    random: &mut Random,
) -> Option<f64> {
    let left = random.real(-1024.0, 1024.0 - width);
    let corners = corners(width, [left, random.real(-1000.0, 1000.0)], random);
    let depths = [(); 3].map(|()| random.real(1.0, f64::from(most)) as u32);
    let (exact, at_corners) = (Exact(corners), depths.map(i64::from));
    let vertices = fragments::corners(corners, depths.map(format));
    let mut worst = 0f64;
    visit(&vertices, |pixel, depth, _| {
        // Half a unit is there for rounding.
        let value = stepped(depth) - (1 << (bits - 1));
        worst = worst.max(exact.error::<S8>(at_corners, pixel, value, bits).abs());
    });
    Some(worst)
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
