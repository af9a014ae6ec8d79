//! Vertices next to the near plane, of an object that reaches far from there.
//!
//! Clip space counts in units of a 2^30th of the object's reach m, the largest coordinate of
//! [`PoseError`](rasterizer::geometry::PoseError). A coordinate is off by less than 4 units, and so
//! is the distance w, which moves a vertex by `(1 + |x / w|) 4 m / w 2^-30` of the guard band, of
//! 2^(10 + S) sub-pixels: by m / w 2^-13 sub-pixels with S4, and 2^-9 with S8.

use rasterizer::{
    camera::Distance,
    geometry::Pose,
    numbers::{S4 as FourBits, S8 as EightBits, Subpixel, Vec3},
};

use super::{
    curve::{Family, Law, powers, sweep},
    stage::{self, Lens, Stage},
    work::{Cost, Work},
};
use crate::reference::random::Random;

const ABOUT: &str = "\
Vertices in the picture at the near plane and up to a quarter of its distance beyond, of an object
in a random pose that reaches to m, far from its origin. Their places are compared with those by the
tables, the pose and the camera in f64. The error is what they are off by beyond the half sub-pixel
of snapping.";
const PARAMETER: &str = "m / near";
const ERROR: &str = "sub-pixels beyond snapping";
const WHY: &str = "a unit of clip space is m / 2^30, and it is magnified by 1 / near";
/// From m = 64 near on with S8.
pub(super) const MOVED: &str = "\
the matrix is exact at the point of the mesh nearest to the eye, so that a vertex is off by a part
of its own distance; what is left is the last of the 29 bits of x / w, a 2^11th of a sub-pixel";
pub(super) const FRACTION: &str = "\
coordinates have 16 bits behind the point of a unit of clip space, m / 2^30";

/// The tolerance of a slope through five points of four octaves: the largest error of a sample
/// scatters by a fifth, which moves the slope by 0.09.
pub(super) const SCATTER: f64 = 0.2;
/// The same of four points of three octaves, which is moved by 0.13.
pub(super) const FEW: f64 = 0.3;

/// What arithmetic may add to snapping, in sub-pixels: `PoseError` promises it of each vertex that
/// is not refused.
pub(super) const PROMISED: f64 = 0.125;

/// With 4 bits.
pub(super) static S4: Family = Family {
    name: "A vertex at the near plane, S4",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law { slope: 1.0, tolerance: SCATTER, segment: [64.0, 1024.0], why: WHY }],
    bound: "m / near 2^-13 (`ClipAll`), which is 1/8 (`PoseError`) at m = 1,024 near",
    end: "Beyond m = 1,024 near the object is refused (`PoseError`).",
    cost: cost(&[flat(8.0, 1024.0)], work::<FourBits>),
    measure: |instances| {
        let bound = |reach: f64| Some((reach / 8192.0).min(PROMISED));
        sweep(powers(2, 12), instances, bound, error::<FourBits>)
    },
};

/// With 8 bits.
pub(super) static S8: Family = Family {
    name: "A vertex at the near plane, S8",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law { slope: 1.0, tolerance: SCATTER, segment: [4.0, 64.0], why: WHY },
        Law { slope: 0.0, tolerance: 0.1, segment: [512.0, 32_768.0], why: MOVED },
        Law { slope: 1.0, tolerance: FEW, segment: [262_144.0, 2_097_152.0], why: FRACTION },
    ],
    bound: "m / near 2^-9, as with S4, up to m = 64 near; 1/8 beyond (`PoseError`)",
    end: "Beyond m = 2^21 near the object is refused (`PoseError`).",
    cost: cost(&[flat(8.0, 64.0), flat(128.0, 2_097_152.0)], work::<EightBits>),
    measure: |instances| {
        let bound = |reach: f64| Some((reach / 512.0).min(PROMISED));
        sweep(powers(2, 22), instances, bound, error::<EightBits>)
    },
};

/// What is measured of a stage.
const fn cost(laws: &'static [Law], work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost { of: "to place 34 vertices", laws, work }
}

/// Of cycles. Below a reach of 8 near distances the mesh has fewer vertices next to the plane; over
/// 64 an object takes a matrix that is exact near the eye.
const fn flat(least: f64, most: f64) -> Law {
    Law {
        slope: 0.0,
        tolerance: 0.05,
        segment: [least, most],
        why: "numbers of any size take the same steps",
    }
}

/// In world units.
const REACH: f64 = 4096.0;
/// The length of a quantum. A mesh of 2^15 quanta whose corner is at the eye has its origin up to
/// the root of 3 times that far away. A point within 1.75 times that of its origin is within 3.49
/// times that of the eye, and that is [`REACH`] without room for the near distance.
const QUANTUM: f64 = REACH / 32_768.0 / 3.6;
/// For each instance.
const STAGES: usize = 8;
/// On each stage.
const VERTICES: usize = 32;
/// In pixels. For coordinates across the view to count as those along it.
pub(super) const FOCAL_LENGTH: Distance = Distance::lit("1024");

/// An object that reaches to m = `reach` near distances or less, which has a corner in the picture
/// next to the near plane: its vertex 0, at `away` near distances or up to a quarter farther.
pub(super) fn stage(reach: f64, away: f64, random: &mut Random) -> Stage {
    let near = Distance::from_num(REACH / reach * random.real(1.0, 1.5));
    let distance = near.to_num::<f64>() * away * random.real(1.01, 1.25);
    let place = stage::shown(random, FOCAL_LENGTH.to_num(), distance, 0.9);
    let corner = [(); 3].map(|()| {
        let quanta = random.real(24_000.0, 32_000.0) as i16;
        if random.real(-1.0, 1.0) < 0.0 { -quanta } else { quanta }
    });
    let rotation = stage::rotation(random);
    let to_corner = stage::turned(&rotation, corner.map(|c| f64::from(c) * QUANTUM));
    let origin = [0, 1, 2].map(|i| place[i] - to_corner[i]);
    Stage {
        positions: vec![corner, corner.map(|c| if c < 0 { i16::MIN } else { i16::MAX })],
        triangles: vec![[0, 0, 1]],
        scale: stage::scale(QUANTUM),
        pose: Pose::rotated(rotation).at(stage::vector(origin)),
        eye: Vec3::ZERO,
        lens: Lens::perspective(FOCAL_LENGTH, near, Distance::MAX),
    }
}

/// The position in quanta that is nearest to a place in view space; `None` if it is out of range.
pub(super) fn position(stage: &Stage, place: [f64; 3]) -> Option<[i16; 3]> {
    let origin = stage::numbers(stage.pose.translation);
    let from_origin = [0, 1, 2].map(|i| (place[i] - origin[i]) / QUANTUM);
    let position = stage::turned(&stage.pose.rotation.inverse(), from_origin);
    let is_in_range = position.iter().all(|c| c.abs() <= 32_767.0);
    is_in_range.then(|| position.map(|c| c.round() as i16))
}

/// One of the stages of an instance.
fn instance(reach: f64, random: &mut Random) -> Stage {
    let mut stage = stage(reach, 1.0, random);
    let [near, _] = stage.lens.definition.depth_range();
    for _ in 0..VERTICES {
        let distance = near * random.real(1.01, 1.25);
        let place = stage::shown(random, FOCAL_LENGTH.to_num(), distance, 0.9);
        stage.positions.extend(position(&stage, place));
    }
    stage
}

fn work<S: Subpixel>(reach: f64, random: &mut Random) -> Option<Work> {
    let stage = instance(reach, random);
    stage.vertices::<S>().map(|_| Work::Place(stage.scene::<S>()))
}

fn error<S: Subpixel>(reach: f64, random: &mut Random) -> Option<f64> {
    let mut worst = 0.5f64;
    for _ in 0..STAGES {
        let stage = instance(reach, random);
        let [near, _] = stage.lens.definition.depth_range();
        let camera = stage.definition();
        for (place, world) in stage.vertices::<S>()?.into_iter().zip(stage.in_world()) {
            let exact = camera.to_view(world);
            // Where a quantum is longer than the near distance, rounding takes most vertices
            // elsewhere, and the corner alone is left.
            if let Some(place) = place
                && -exact[2] > 1.001 * near
                && -exact[2] < 1.3 * near
            {
                let point = camera.to_screen(exact);
                worst = worst.max(stage::distance::<S>(place, [point.x, point.y]));
            }
        }
    }
    Some(worst - 0.5)
}

#[cfg(test)]
mod tests {
    use super::{super::curve::tests::holds, *};

    #[test]
    fn with_4_bits() {
        holds(&S4);
    }

    #[test]
    fn with_8_bits() {
        holds(&S8);
    }

    /// All instances are solved up to the documented limit, and none from twice that on: the near
    /// distance is up to half more than `REACH / reach`.
    #[test]
    fn objects_are_refused_beyond_the_limit() {
        for (family, limit) in [(&S4, 1024.0), (&S8, 2_097_152.0)] {
            for point in family.measure(20).points {
                let refused = if point.parameter <= limit { 0 } else { 20 };
                let is_between = point.parameter > limit && point.parameter < 2.0 * limit;
                assert!(is_between || point.without == refused, "{point:?}");
            }
        }
    }
}
