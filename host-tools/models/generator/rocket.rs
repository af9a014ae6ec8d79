//! A rocket that stands on its fins, y up: a turned body, three fins and two windows, each a closed
//! surface.

use std::f64::consts::TAU;

use super::surface::{Point, Ring, Surface, library};

const SIDES: u32 = 20;

/// The body from the engine's rim upwards: radius, height, and the material of the band above.
const BODY: [(f64, f64, &str); 13] = [
    (0.24, 0.20, "soot"),
    (0.17, 0.42, "soot"),
    (0.27, 0.42, "paint"),
    (0.36, 0.75, "paint"),
    (0.43, 1.15, "paint"),
    (0.45, 1.50, "stripe"),
    (0.45, 1.62, "paint"),
    (0.43, 2.05, "paint"),
    (0.37, 2.45, "stripe"),
    (0.31, 2.70, "stripe"),
    (0.22, 2.97, "stripe"),
    (0.12, 3.17, "stripe"),
    (0.05, 3.27, "stripe"),
];

/// A fin's outline: distance from the axis and height, counter-clockwise; concave at the trailing
/// edge.
const FIN: [(f64, f64); 7] = [
    (0.18, 0.55),
    (0.42, 0.46),
    (0.66, 0.0),
    (0.82, 0.0),
    (0.84, 0.42),
    (0.68, 0.86),
    (0.30, 1.28),
];

pub(super) fn files() -> Vec<(&'static str, String)> {
    let mut surface = Surface::new("A rocket.", "rocket.mtl");
    body(&mut surface);
    surface.material("stripe");
    for fin_number in 0..3 {
        fin(&mut surface, TAU * (f64::from(fin_number) / 3.0 + 0.25));
    }
    for y in [1.86, 2.26] {
        window(&mut surface, y);
    }
    let colors = library(&[
        ("soot", [0.22, 0.22, 0.25]),
        ("paint", [0.93, 0.92, 0.88]),
        ("stripe", [0.82, 0.16, 0.13]),
        ("frame", [0.62, 0.64, 0.68]),
        ("glass", [0.20, 0.45, 0.75]),
    ]);
    vec![("rocket.obj", surface.into_text()), ("rocket.mtl", colors)]
}

/// Seen from above, about y, counter-clockwise: from z towards x.
fn body(surface: &mut Surface) {
    let rings = BODY.map(|(r, y, _)| {
        surface.ring((0..SIDES).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(SIDES)).sin_cos();
            [r * sin, y, r * cos]
        }))
    });
    let throat = surface.point([0.0, 0.36, 0.0]);
    let nose = surface.point([0.0, 3.31, 0.0]);
    let mut material = "";
    for (i, (_, _, name)) in BODY.into_iter().enumerate() {
        if name != material {
            surface.material(name);
            material = name;
        }
        match rings.get(i + 1) {
            Some(&next) => surface.band(rings[i], next),
            None => surface.tip(rings[i], nose),
        }
    }
    // The engine is hollow: a cone from its rim inwards.
    surface.material("soot");
    for [a, b] in (0..SIDES as usize).map(|i| [i, (i + 1) % SIDES as usize]) {
        surface.face([b + 1, a + 1, throat]);
    }
}

/// A plate round a half plane through the axis, from 0.03 on one side to 0.03 on the other.
fn fin(surface: &mut Surface, angle: f64) {
    let (sin, cos) = angle.sin_cos();
    let mut side = |depth: f64| -> Ring {
        surface
            .ring(FIN.map(|(r, y)| -> Point { [r * cos + depth * sin, y, -r * sin + depth * cos] }))
    };
    let (near, far) = (side(0.03), side(-0.03));
    surface.cap(near);
    surface.cap_reversed(far);
    surface.band(far, near);
}

/// A round window in front: a frame that rises from the hull and a pane set back in it.
fn window(surface: &mut Surface, y: f64) {
    let mut disc = |radius: f64, z: f64| -> Ring {
        surface.ring((0..16).map(|i| {
            let (sin, cos) = (TAU * f64::from(i) / 16.0).sin_cos();
            [radius * cos, y + radius * sin, z]
        }))
    };
    let rings = [(0.15, 0.30), (0.15, 0.47), (0.11, 0.47), (0.10, 0.455)]
        .map(|(radius, z)| disc(radius, z));
    surface.material("frame");
    for i in 0..3 {
        surface.band(rings[i], rings[i + 1]);
    }
    surface.cap_reversed(rings[0]);
    surface.material("glass");
    surface.cap(rings[3]);
}
