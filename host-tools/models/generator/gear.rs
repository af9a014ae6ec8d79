//! A spur gear with a brass hub, about the z axis. Hard edges, no normals.

use std::f64::consts::TAU;

use super::surface::{Point, Ring, Surface, library};

const TEETH: u32 = 14;

/// A tooth's outline: places along the pitch in 0 to 1, and radii.
const TOOTH: [(f64, f64); 5] = [(0.0, 0.78), (0.18, 0.80), (0.33, 1.0), (0.67, 1.0), (0.82, 0.80)];

pub(super) fn files() -> Vec<(&'static str, String)> {
    let mut surface = Surface::new("A spur gear with a brass hub.", "gear.mtl");
    // Half of the section from the tip of a tooth to the bore: radius (`None` for the teeth's
    // outline) and height.
    let section = [
        (None, 0.15),
        (Some(0.68), 0.15),
        (Some(0.64), 0.08),
        (Some(0.36), 0.08),
        (Some(0.32), 0.21),
        (Some(0.18), 0.21),
    ];
    let front: Vec<Ring> = section.iter().map(|&(r, z)| ring(&mut surface, r, z)).collect();
    let back: Vec<Ring> = section.iter().map(|&(r, z)| ring(&mut surface, r, -z)).collect();

    surface.material("steel");
    surface.band(back[0], front[0]);
    for i in 0..3 {
        surface.band(front[i], front[i + 1]);
        surface.band(back[i + 1], back[i]);
    }
    surface.material("brass");
    for i in 3..5 {
        surface.band(front[i], front[i + 1]);
        surface.band(back[i + 1], back[i]);
    }
    surface.band(front[5], back[5]);
    let colors = library(&[("steel", [0.56, 0.60, 0.66]), ("brass", [0.80, 0.60, 0.22])]);
    vec![("gear.obj", surface.into_text()), ("gear.mtl", colors)]
}

/// Counter-clockwise about z.
fn ring(surface: &mut Surface, radius: Option<f64>, z: f64) -> Ring {
    let points = (0..TEETH).flat_map(|tooth| {
        TOOTH.map(|(place, outline)| -> Point {
            let (sin, cos) = (TAU * (f64::from(tooth) + place) / f64::from(TEETH)).sin_cos();
            let r = radius.unwrap_or(outline);
            [r * cos, r * sin, z]
        })
    });
    surface.ring(points)
}
