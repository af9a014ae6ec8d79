//! The same picture of an object of any size, at a distance in proportion to it; and of an object
//! anywhere in the world.
//!
//! World coordinates are rounded to a 2^16th of a unit: those of the eye and those of the pose each
//! move a vertex by half of that. From the distance w the f pixels of focal length make that
//! `2 f 2^-17 (1 + |x / w|) / w` pixels. This is what inputs lose; arithmetic keeps its 5/8 of a
//! sub-pixel.

use rasterizer::{
    camera::Distance,
    geometry::Pose,
    numbers::{S8, Subpixel as _},
};

use super::{
    curve::{Family, Law, powers, sweep},
    near_vertex::PROMISED,
    stage::{self, Lens, Stage},
    work::{Cost, Work},
};
use crate::reference::{Camera, random::Random};

const ERROR: &str = "sub-pixels of S8";

/// By its size.
pub(super) static SIZE: Family = Family {
    name: "The same picture of a small object",
    about: "\
A cube of edges L in a random pose, 2.4 L before the eye, up to 100 units from the world's origin;
the focal length is 400 pixels. Where the core puts its corners, from an eye and a pose rounded to
Q16.16, is compared with where they are in f64 without that rounding.",
    parameter: "L in units",
    error: ERROR,
    laws: &[Law {
        slope: -1.0,
        tolerance: 0.1,
        segment: [0.003_906_25, 0.0625],
        why: "eye and pose are rounded to steps of fixed length, seen from w = 2.4 L",
    }],
    bound: "5/8 (`PoseError`) and 2^S f 2^-16 (1 + |x / w|) / w, with w at least 1.53 L, for the \
            steps of the inputs",
    end: "It has no end: under 2.6 units the inputs' steps are more than the arithmetic's 5/8 of a \
          sub-pixel with S8, and under 0.16 units with S4. Give such a scene in larger units.",
    cost: cost(&[flat(0.003_906_25, 16.0)], |size, random| work(size, 100.0, random)),
    measure: |instances| {
        sweep(
            powers(-8, 4),
            instances,
            |size| Some(bound(size)),
            |size, random| error(size, 100.0, random),
        )
    },
};

/// By where it is.
pub(super) static PLACE: Family = Family {
    name: "The same picture far from the origin",
    about: "\
A cube of edges of 1/4 unit in a random pose, 0.6 units before the eye, both moved away from the
world's origin; judged as above.",
    parameter: "distance from the origin in units",
    error: ERROR,
    laws: &[Law {
        slope: 0.0,
        tolerance: 0.1,
        segment: [1.0, 16_384.0],
        why: "steps of world coordinates are as long everywhere (those of f32 would give 1)",
    }],
    bound: "as above, 7.0 for this cube",
    end: "World coordinates end at 32,768 units.",
    cost: cost(&[flat(1.0, 16_384.0)], |distance, random| work(0.25, distance, random)),
    measure: |instances| {
        sweep(
            powers(0, 14),
            instances,
            |_| Some(bound(0.25)),
            |distance, random| error(0.25, distance, random),
        )
    },
};

/// What is measured of a cube.
const fn cost(laws: &'static [Law], work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost { of: "to place the corners", laws, work }
}

/// Of cycles.
const fn flat(first: f64, last: f64) -> Law {
    Law {
        slope: 0.0,
        tolerance: 0.05,
        segment: [first, last],
        why: "numbers of any size take the same steps",
    }
}

/// In pixels.
const FOCAL_LENGTH: f64 = 400.0;
/// From the eye to the cube's middle, in edges.
const DISTANCE: f64 = 2.4;

/// In sub-pixels. Half a diagonal, 0.867 edges, is in front of the cube's middle and beside it.
fn bound(size: f64) -> f64 {
    const HALF: f64 = 0.867;
    let nearest = DISTANCE - HALF;
    let step = FOCAL_LENGTH * 2f64.powi(-16) * (1.0 + HALF / nearest) / (nearest * size);
    0.5 + PROMISED + f64::from(1 << S8::BITS) * step
}

/// A cube whose middle is at a place.
fn stage(size: f64, place: [f64; 3], random: &mut Random) -> Stage {
    let corner =
        |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -i16::MAX } else { i16::MAX });
    Stage {
        positions: (0..8).map(corner).collect(),
        triangles: vec![[0, 1, 2]],
        scale: stage::scale(size / 2.0 / f64::from(i16::MAX)),
        pose: Pose::rotated(stage::rotation(random)).at(stage::vector(place)),
        eye: stage::vector(eye(size, place)),
        lens: Lens::perspective(
            Distance::from_num(FOCAL_LENGTH),
            Distance::from_num(size / 2.0),
            Distance::MAX,
        ),
    }
}

/// Where the eye is.
fn eye(size: f64, [x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, y, z + DISTANCE * size]
}

/// The world's origin is `distance` units away along each axis.
fn place(distance: f64, random: &mut Random) -> [f64; 3] {
    [(); 3].map(|()| random.real(0.9, 1.0) * distance)
}

fn work(size: f64, distance: f64, random: &mut Random) -> Option<Work> {
    let stage = stage(size, place(distance, random), random);
    stage.vertices::<S8>().map(|_| Work::Place(stage.scene::<S8>()))
}

fn error(size: f64, distance: f64, random: &mut Random) -> Option<f64> {
    let place = place(distance, random);
    let (stage, eye) = (stage(size, place, random), eye(size, place));
    // Where the rounded inputs put the corners, and by how much they are off themselves.
    let off = stage::numbers(stage.pose.translation);
    let camera = Camera { eye, target: [eye[0], eye[1], eye[2] - 1.0], ..stage.definition() };
    let placed = stage.vertices::<S8>()?;
    let mut worst = 0f64;
    for (got, rounded) in placed.into_iter().zip(stage.in_world()) {
        let exact = [0, 1, 2].map(|i| rounded[i] - off[i] + place[i]);
        let exact = camera.to_screen(camera.to_view(exact));
        // All of the cube is in front of the near plane and in the picture.
        worst = worst.max(stage::distance::<S8>(got?, [exact.x, exact.y]));
    }
    Some(worst)
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn by_size() {
        holds(&super::SIZE);
    }

    #[test]
    fn by_place() {
        holds(&super::PLACE);
    }
}
