//! Edges from a vertex in the picture to one far behind the eye, cut by the near plane.
//!
//! What is interpolated between the ends is off as they are, by less than 4 units of clip space,
//! and the place of the cut adds 4 with S4 ([`ClipAll`](rasterizer::geometry::ClipAll)). An edge
//! that meets the plane at 45 degrees is moved along it by what its ends are off in depth. That
//! makes 16 units in x and none in w, which is exact on the plane: m / near 2^-12 sub-pixels. With
//! S8 a cut adds nothing, and 8 units are m / near 2^-9 of its finer sub-pixels.

use rasterizer::numbers::{S4 as FourBits, S8 as EightBits, Subpixel};

use super::{
    curve::{Family, Law, powers, sweep},
    near_vertex::{FEW, FOCAL_LENGTH, FRACTION, MOVED, PROMISED, SCATTER, position, stage},
    stage::{self, Stage},
    work::{Cost, Work},
};
use crate::reference::random::Random;

const ABOUT: &str = "\
Edges from a vertex in the picture, one to four near distances away, to places behind the eye at a
tenth to three tenths of m. They meet the near plane in the picture at 45 degrees or steeper. Where
the core puts the corners is compared with where the edges meet the plane in f64. The error is what
they are off by beyond the half sub-pixel of snapping.";
const PARAMETER: &str = "m / near";
const ERROR: &str = "sub-pixels beyond snapping";
const WHY: &str = "a unit of clip space is m / 2^30, and it is magnified by 1 / near";

/// With 4 bits.
pub(super) static S4: Family = Family {
    name: "An edge cut by the near plane, S4",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law { slope: 1.0, tolerance: SCATTER, segment: [64.0, 1024.0], why: WHY }],
    bound: "m / near 2^-12: 4 units of clip space for the ends and 4 for the cut (`ClipAll`), \
            in x or y and in w",
    end: "Beyond m = 1,024 near the object is refused (`PoseError`).",
    cost: cost(&[flat(1024.0)], work::<FourBits>),
    measure: |instances| {
        let bound = |reach: f64| Some((reach / 4096.0).min(2.0 * PROMISED));
        sweep(powers(4, 12), instances, bound, error::<FourBits>)
    },
};

/// With 8 bits.
pub(super) static S8: Family = Family {
    name: "An edge cut by the near plane, S8",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law { slope: 0.0, tolerance: 0.1, segment: [512.0, 32_768.0], why: MOVED },
        Law { slope: 1.0, tolerance: FEW, segment: [262_144.0, 2_097_152.0], why: FRACTION },
    ],
    bound: "that of the edge's points: m / near 2^-9 up to m = 64 near, 1/8 beyond \
            (`ClipAll`, `PoseError`)",
    end: "Beyond m = 2^21 near the object is refused (`PoseError`).",
    cost: cost(&[flat(2_097_152.0)], work::<EightBits>),
    measure: |instances| {
        let bound = |reach: f64| Some((reach / 512.0).min(PROMISED));
        sweep(powers(4, 22), instances, bound, error::<EightBits>)
    },
};

/// What is measured of a fan.
const fn cost(laws: &'static [Law], work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost { of: "to clip the 63 triangles of the fan", laws, work }
}

/// Of cycles, up to a reach.
const fn flat(most: f64) -> Law {
    Law {
        slope: 0.0,
        tolerance: 0.05,
        segment: [16.0, most],
        why: "an edge is cut in as many steps wherever it meets the plane",
    }
}

/// A fan of them leaves the vertex in the picture.
const EDGES: u16 = 64;

fn work<S: Subpixel>(reach: f64, random: &mut Random) -> Option<Work> {
    let stage = instance(reach, random);
    stage.corners::<S>().map(|_| Work::Clip(stage.scene::<S>()))
}

/// A fan that lies within a mesh.
fn instance(reach: f64, random: &mut Random) -> Stage {
    loop {
        if let Some(stage) = with_edges(reach, random) {
            return stage;
        }
    }
}

fn error<S: Subpixel>(reach: f64, random: &mut Random) -> Option<f64> {
    let stage = instance(reach, random);
    let camera = stage.definition();
    let corners = stage.corners::<S>()?;
    let ends: Vec<_> = stage.in_world().into_iter().map(|place| camera.to_view(place)).collect();
    let [near, _] = stage.lens.definition.depth_range();
    let mut worst = 0.5f64;
    let from = ends[0];
    for to in &ends[2..] {
        let t = (from[2] + near) / (from[2] - to[2]);
        let crossing = [0, 1, 2].map(|i| from[i] + t * (to[i] - from[i]));
        let exact = camera.to_screen(crossing);
        let nearest =
            corners.iter().map(|&corner| stage::distance::<S>(corner, [exact.x, exact.y]));
        worst = worst.max(nearest.fold(f64::INFINITY, f64::min));
    }
    Some(worst - 0.5)
}

/// An object with triangles of one vertex in the picture and two far behind the eye; `None` if
/// these lie outside the mesh.
fn with_edges(reach: f64, random: &mut Random) -> Option<Stage> {
    let mut stage = stage(reach, random.real(1.2, 3.0), random);
    let camera = stage.definition();
    let [near, _] = stage.lens.definition.depth_range();
    let inside = camera.to_view(stage.in_world()[0]);
    let depth = -inside[2] - near;
    for _ in 0..EDGES {
        let behind = 0.2 * reach * near * random.real(0.5, 1.0);
        let crossing = stage::shown(random, FOCAL_LENGTH.to_num(), near, 0.9);
        if (0..2).any(|i| (crossing[i] - inside[i]).abs() > depth) {
            return None;
        }
        let length = 1.0 + (near + behind) / depth;
        let end = [0, 1, 2].map(|i| inside[i] + length * (crossing[i] - inside[i]));
        let position = position(&stage, end)?;
        stage.positions.push(position);
    }
    // Vertex 1 is the corner of the mesh.
    stage.triangles = (2..=EDGES).map(|end| [0, end, end + 1]).collect();
    Some(stage)
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn with_4_bits() {
        holds(&super::S4);
    }

    #[test]
    fn with_8_bits() {
        holds(&super::S8);
    }
}
