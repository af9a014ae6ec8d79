//! A tilted plane in a parallel projection, from facing the viewer to edge-on.
//!
//! The corners are up to 5/8 of a sub-pixel from their exact places in x and in y, so the plane
//! through them is off by that times the change of depth from pixel to pixel: the tangent of the
//! tilt, over the depth of the view in pixels.

use embedded_graphics_core::geometry::Point;
use rasterizer::{
    camera::{Distance, Orthographic},
    geometry::Pose,
    numbers::{Rotation, S8, Subpixel as _, Turn, Vec3},
};

use super::{
    curve::{Family, Law, powers, sweep},
    near_vertex::PROMISED,
    stage::{self, Lens, Stage},
    work::Cost,
};
use crate::reference::random::Random;

/// The family.
pub(super) static S8_DEPTH: Family = Family {
    name: "A tilted plane, S8",
    about: "\
A square of up to 60 pixels, tilted about a random axis in the picture by an angle of this tangent.
A unit is a pixel, and the depth range 60,000 units. The depth of its pixels, in 32 bits, is
compared with the square's plane in f64 at the pixels' centres.",
    parameter: "tangent of the tilt",
    error: "2^-16 of the depth range",
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [1.0, 65_536.0],
        why: "snapped corners are off by a fixed part of a pixel, and depth changes by the tangent \
              from pixel to pixel",
    }],
    bound: "5/8 of a sub-pixel (`PoseError`) in x and in y, times the change of depth",
    end: "Where the square is less than a few sub-pixels high, from a tangent of 2^20, it covers \
          few centres or none, and what is drawn has a depth of the square, not of the place.",
    cost: Cost {
        of: "to draw the square",
        laws: &[Law {
            slope: 0.0,
            tolerance: 0.05,
            segment: [4.0, 512.0],
            why: "it covers as many pixels until the depth range ends, and gradients of any size \
                  take the same steps",
        }],
        work: |tangent, random| Some(stage(tangent, random).draw::<S8>(stage::middle(SIDE), "u32")),
    },
    measure: |instances| sweep(powers(0, 24), instances, |tangent| Some(bound(tangent)), error),
};

/// In units.
const RANGE: f64 = 60_000.0;
/// Half the depth of the square at most, in units.
const HALF_RANGE: f64 = 29_000.0;
/// What errors are counted in, in depth.
const UNIT: f64 = 1.0 / 65_536.0;

/// A vertex is further off by 2^-27 of the range, by its coordinate.
fn bound(tangent: f64) -> f64 {
    let change = tangent / RANGE * std::f64::consts::SQRT_2 / f64::from(1 << S8::BITS);
    ((0.5 + PROMISED) * change + 2f64.powi(-27)) / UNIT
}

/// Width and height of the part of the picture that shows all of the square, in pixels.
const SIDE: u32 = 130;

/// The square.
fn stage(tangent: f64, random: &mut Random) -> Stage<Orthographic> {
    let half = (30.0 * tangent).min(HALF_RANGE);
    let angle = tangent.atan() / std::f64::consts::TAU * 2f64.powi(32);
    let tilt = Rotation::about_x(Turn::from_bits(angle as u32));
    let after = Rotation::about_z(stage::angle(random));
    let place = [random.real(-20.0, 20.0), random.real(-20.0, 20.0), 0.0];
    // Along x it is as wide as the picture.
    let [x, y] = [(30.0 / half * 32_767.0) as i16, i16::MAX];
    Stage {
        positions: vec![[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        scale: stage::scale(half / 32_767.0),
        pose: Pose::rotated(after * tilt).at(stage::vector(place)),
        eye: Vec3::lit("0", "0", "30001"),
        lens: Lens::orthographic(Distance::ONE, Distance::from_num(RANGE + 1.0)),
    }
}

fn error(tangent: f64, random: &mut Random) -> Option<f64> {
    let stage = stage(tangent, random);
    let part = stage::middle(SIDE);
    let depths = stage.depths::<S8, u32>(part)?;
    // The plane through three corners.
    let camera = stage.definition();
    let [a, b, c, _] = stage.in_world()[..] else { return None };
    let [a, b, c] = [a, b, c].map(|place| camera.to_screen(camera.to_view(place)));
    let along = [b.x - a.x, b.y - a.y, b.depth - a.depth];
    let up = [c.x - b.x, c.y - b.y, c.depth - b.depth];
    let area = along[0] * up[1] - along[1] * up[0];
    let gradient = [
        (along[2] * up[1] - along[1] * up[2]) / area,
        (along[0] * up[2] - along[2] * up[0]) / area,
    ];
    let mut worst = None;
    for (index, &depth) in (0u32..).zip(&depths) {
        if depth != 0 {
            let Point { x, y } = part.top_left;
            let [column, row] =
                [index % SIDE + x as u32, index / SIDE + y as u32].map(|c| f64::from(c) + 0.5);
            let exact = a.depth + gradient[0] * (column - a.x) + gradient[1] * (row - a.y);
            let off = (f64::from(depth) * 2f64.powi(-32) - exact).abs() / UNIT;
            worst = Some(off.max(worst.unwrap_or(0.0)));
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn depth_by_tilt() {
        holds(&super::S8_DEPTH);
    }
}
