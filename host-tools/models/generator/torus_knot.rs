//! A trefoil: a tube along a curve that winds three times round a torus while it goes twice about
//! its axis. Smooth, with normals and texture coordinates.

use std::f64::consts::TAU;

use super::surface::{Point, Surface, coordinates, library};

const ALONG: usize = 80;
const AROUND: usize = 8;

/// The torus on which the curve lies, and the tube.
const MAJOR: f64 = 1.0;
const MINOR: f64 = 0.42;
const TUBE: f64 = 0.2;

/// The tube is some 14.5 units long and 1.26 round: with this many repeats a square texture looks
/// undistorted.
const REPEATS: f64 = 12.0;

pub(super) fn files() -> Vec<(&'static str, String)> {
    let mut surface = Surface::new("A trefoil knot.", "torus_knot.mtl");
    let tube: Vec<(Point, Point)> = (0..ALONG)
        .flat_map(|i| (0..AROUND).map(move |j| on_tube(part(i, ALONG), part(j, AROUND))))
        .collect();
    for &(point, _) in &tube {
        surface.point(point);
    }
    for &(_, normal) in &tube {
        surface.line(&format!("vn {}", coordinates(&normal)));
    }
    // One more than vertices in both directions: the texture's two ends lie on the same vertices.
    for i in 0..=ALONG {
        for j in 0..=AROUND {
            let texture = [part(i, ALONG) * REPEATS, part(j, AROUND)];
            surface.line(&format!("vt {}", coordinates(&texture)));
        }
    }
    surface.material("enamel");
    for i in 0..ALONG {
        for j in 0..AROUND {
            let corner = |i: usize, j: usize| {
                let vertex = i % ALONG * AROUND + j % AROUND + 1;
                format!("{vertex}/{}/{vertex}", i * (AROUND + 1) + j + 1)
            };
            let [a, b, c, d] =
                [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            surface.line(&format!("f {a} {b} {c}"));
            surface.line(&format!("f {a} {c} {d}"));
        }
    }
    let colors = library(&[("enamel", [0.13, 0.55, 0.60])]);
    vec![("torus_knot.obj", surface.into_text()), ("torus_knot.mtl", colors)]
}

fn part(i: usize, n: usize) -> f64 {
    i as f64 / n as f64
}

/// A point of the tube and the normal there, which is radial as in any pipe. Both parameters go
/// from 0 to 1.
///
/// The frame stays level, as for a walker on the curve: at its steepest the curve rises at 47
/// degrees.
fn on_tube(along: f64, around: f64) -> (Point, Point) {
    let ((sin_u, cos_u), (sin_v, cos_v)) =
        ((2.0 * TAU * along).sin_cos(), (3.0 * TAU * along).sin_cos());
    let radius = MAJOR + MINOR * cos_v;
    let center = [radius * cos_u, radius * sin_u, MINOR * sin_v];
    let tangent = {
        let (east, north) = (2.0 * radius, 3.0 * MINOR);
        let length = east.hypot(north);
        let (e, n) = (east / length, north / length);
        [-e * sin_u - n * sin_v * cos_u, e * cos_u - n * sin_v * sin_u, n * cos_v]
    };
    let level = tangent[0].hypot(tangent[1]);
    let right = [tangent[1] / level, -tangent[0] / level, 0.0];
    let up = [right[1] * tangent[2], -right[0] * tangent[2], level];
    let (sin, cos) = (TAU * around).sin_cos();
    let normal = [0, 1, 2].map(|i| cos * right[i] + sin * up[i]);
    ([0, 1, 2].map(|i| center[i] + TUBE * normal[i]), normal)
}
