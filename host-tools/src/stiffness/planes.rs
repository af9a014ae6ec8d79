//! Two parallel planes, and the least gap between them at which the nearer one is seen.
//!
//! At the distance w a unit of depth is w^2 / near units of it, so a relative gap g has
//! g near / w 2^D units. Planes of any slope are told apart if they are three units apart: one for
//! the vertices of both, one for their pixels, and one between them.

use rasterizer::{
    attribute::FloatDepth,
    camera::{Distance, Perspective},
    geometry::Pose,
    numbers::{Rotation, S8, Turn, Vec3},
    output::StoredDepth,
};

use super::{
    curve::{Family, Law, Point, powers},
    stage::{self, Lens, Stage},
    work::{Cost, Work},
};
use crate::reference::random::Random;

const ABOUT: &str = "\
Two parallel planes at w and at (1 - g) w before the eye, tilted by up to 45 degrees in a random
direction, fill 16 x 16 pixels; the focal length is 1,024 pixels and positions on the screen are S8.
A pixel is wrong if the stored depth of the farther plane is not less than that of the nearer one.";
const PARAMETER: &str = "w / near";
const ERROR: &str = "least g in millionths, with under 10^-4 wrong pixels";

/// In 16 bits.
pub(super) static U16: Family = Family {
    name: "Two parallel planes, u16",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [4.0, 4096.0],
        why: "a unit of depth is a 2^16th of near / w",
    }],
    bound: "3 units (`FloatDepth` has why): g / (1 - g) is 3 w / near 2^-16; and 2^-17 for \
            snapping",
    end: "It reaches 1/2 at w / near = 21,845, where the farther plane has 3 units: a plane behind \
          that one is not certain to be told apart from it, however far it is. It ends at 2^16. No \
          depth is under a unit, so that all planes beyond are at that one, and g tends to 1.",
    cost: cost(&[flat(262_144.0)], |ratio, random| {
        Planes::new(Near::far_away(ratio, random), 1.0, random).work("u16")
    }),
    measure: |instances| {
        measure::<u16>(powers(1, 18), instances, Near::far_away, 1.0, |ratio| {
            (ratio <= 65_536.0).then_some(of_units(3.0 * ratio * 2f64.powi(-16)) + SNAPPING)
        })
    },
};

/// In 16 bits with an exponent.
pub(super) static FLOAT: Family = Family {
    name: "Two parallel planes, FloatDepth",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law {
            slope: 0.0,
            tolerance: 0.1,
            segment: [2.0, 1_048_576.0],
            why: "a step of depth is a fixed part of it",
        },
        Law {
            slope: 1.0,
            tolerance: 0.1,
            segment: [8_388_608.0, 268_435_456.0],
            why: "a vertex gets its depth in steps of 2^-32",
        },
    ],
    bound: "3 x 2^-11 of w (`FloatDepth`)",
    end: "Beyond w / near = 2^20 a vertex has fewer bits than a step (`FloatDepth`), and the gap \
          grows with slope 1. From 2^30 on all planes have the least depth, 2^-30.",
    cost: cost(&[flat(MOST)], |ratio, random| {
        Planes::new(Near::far_away(ratio, random), 1.0, random).work("FloatDepth")
    }),
    measure: |instances| {
        measure::<FloatDepth>(powers(1, 31), instances, Near::far_away, 1.0, |ratio| {
            (ratio <= 2f64.powi(20)).then_some(3.0 * 2f64.powi(-11) + SNAPPING)
        })
    },
};

/// In 32 bits.
pub(super) static U32: Family = Family {
    name: "Two parallel planes, u32",
    about: ABOUT,
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [16_384.0, 268_435_456.0],
        why: "a unit of depth is a 2^32nd of near / w; below, snapping is what counts, where the \
              corners of both planes are snapped to different sub-pixels",
    }],
    bound: "3 units: g / (1 - g) is 3 w / near 2^-32; 2^-25 for the vertices of both planes, and \
            2^-17 for snapping (`u32` as a `DepthFormat`)",
    end: END,
    cost: cost(&[flat(MOST)], |ratio, random| {
        Planes::new(Near::far_away(ratio, random), 1.0, random).work("u32")
    }),
    measure: |instances| {
        measure::<u32>(powers(1, 31), instances, Near::far_away, 1.0, |ratio| {
            Some(wide(ratio) + SNAPPING)
        })
    },
};

/// In 32 bits, parallel to the screen.
pub(super) static U32_FACING: Family = Family {
    name: "Two planes parallel to the screen, u32",
    about: "As above, but not tilted.",
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [32.0, 268_435_456.0],
        why: "a unit of depth is a 2^32nd of near / w",
    }],
    bound: "3 units, and 2^-25 for the vertices of both planes (`u32` as a `DepthFormat`)",
    end: END,
    cost: cost(&[flat(MOST)], |ratio, random| {
        Planes::new(Near::far_away(ratio, random), 0.0, random).work("u32")
    }),
    measure: |instances| {
        measure::<u32>(powers(1, 31), instances, Near::far_away, 0.0, |ratio| Some(wide(ratio)))
    },
};

/// In 32 bits, from the least distance that the core can draw to the greatest.
pub(super) static U32_PLACED: Family = Family {
    name: "Two planes from the nearest to the farthest, u32",
    about: "\
As above, but the near plane is at 2^-16 units, the least distance that Q16.16 has, and w runs from
2^-14 to 2^15 units. The steps of Q16.16 in which planes are placed count too.",
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law {
            slope: -1.0,
            tolerance: 0.1,
            segment: [4.0, 16_384.0],
            why: "a step of Q16.16 is a 2^16th of a unit, however near a plane is",
        },
        Law {
            slope: 1.0,
            tolerance: 0.1,
            segment: [262_144.0, 268_435_456.0],
            why: "a unit of depth is a 2^32nd of near / w; both are as large at w / near = 2^16, \
                  where w is a unit",
        },
    ],
    bound: "a step of Q16.16, 2^-16 / w, 3 units, and 2^-25 for the vertices of both planes",
    end: END,
    cost: cost(&[flat(MOST)], |ratio, random| {
        Planes::new(Near::least(ratio, random), 0.0, random).work("u32")
    }),
    measure: |instances| {
        measure::<u32>(powers(2, 31), instances, Near::least, 0.0, |ratio| {
            Some(wide(ratio) + 1.0 / ratio)
        })
    },
};

const END: &str = "\
It reaches 1/2 at w / near = 2^32 / 3, or 2^30.4, where the farther plane has 3 units: a plane \
behind that one is not certain to be told apart from it, however far it is. It ends at 2^32, which \
nothing reaches: the near plane is at 2^-16 units or farther, the far plane at less than 2^16.";

/// What is measured of the farther plane.
const fn cost(laws: &'static [Law], work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost { of: "to draw the farther plane", laws, work }
}

/// Of cycles, up to a ratio.
const fn flat(most: f64) -> Law {
    Law {
        slope: 0.0,
        tolerance: 0.05,
        segment: [2.0, most],
        why: "numbers of any size take the same steps",
    }
}

/// The largest ratio of all, 2^31.
const MOST: f64 = 2_147_483_648.0;

/// A vertex is within 2^-27 by its reciprocal, and its distance within 4 units of clip space. The
/// object reaches to 2 w at most, so that these are 2^-27 of w.
fn wide(ratio: f64) -> f64 {
    2f64.powi(-25) + of_units(3.0 * ratio * 2f64.powi(-32))
}

/// The gap at which depths differ by this part of the farther plane's: the nearer plane is
/// 1 / (1 - g) times as deep.
fn of_units(part: f64) -> f64 {
    part / (1.0 + part)
}

/// In pixels.
const FOCAL_LENGTH: Distance = Distance::lit("1024");
/// World coordinates end at 2^15 units. From here they reach as far along the view.
const EYE: Vec3 = Vec3::lit("0", "0", "16384");
/// Of w. Snapping moves the corners of both planes by up to 5/8 of a 2^8th of a pixel in x and y.
/// Where a plane is tilted by 45 degrees, depth changes by a 1,024th from pixel to pixel, and by
/// 1.42 times that along both.
const SNAPPING: f64 = 1.0 / (1 << 17) as f64;
/// Of the whole.
const MILLIONTHS: f64 = 1e6;
/// Width and height of what is seen of the planes, in pixels.
const SIDE: u32 = 16;
/// Half the width of a plane, in distances: 60 pixels.
const HALF: f64 = 0.06;

/// One in four instances, each with 256 pixels. `tilt` is the largest tangent of the angle between
/// planes and screen.
fn measure<D: StoredDepth>(
    ratios: impl Iterator<Item = f64>,
    instances: usize,
    near: fn(f64, &mut Random) -> Near,
    tilt: f64,
    bound: impl Fn(f64) -> Option<f64>,
) -> Vec<Point> {
    let instances = instances.div_ceil(4);
    let point = |ratio| {
        let mut random = Random(1);
        let scenes: Vec<_> = (0..instances)
            .map(|_| Planes::new(near(ratio, &mut random), tilt, &mut random))
            .collect();
        let farther: Vec<Vec<D>> = scenes.iter().map(|planes| planes.depths(0.0)).collect();
        let is_resolved = |gap: f64| {
            let wrong = scenes.iter().zip(&farther).map(|(planes, farther)| {
                let nearer = planes.depths::<D>(gap);
                nearer.iter().zip(farther).filter(|(near, far)| !near.is_nearer(**far)).count()
            });
            wrong.sum::<usize>() as f64 <= 1e-4 * f64::from(instances as u32 * SIDE * SIDE)
        };
        // Powers of the eighth root of 2: the least one by bisection.
        let gap = |eighths: i32| 2f64.powf(f64::from(eighths) / 8.0);
        let (mut low, mut high) = (-8 * 29, 0i32);
        while low < high {
            let middle = (low + high).div_euclid(2);
            if is_resolved(gap(middle)) { high = middle } else { low = middle + 1 }
        }
        Point {
            parameter: ratio,
            error: (high < 0).then(|| gap(high) * MILLIONTHS),
            bound: bound(ratio).map(|gap| gap * MILLIONTHS),
            instances,
            without: 0,
        }
    };
    ratios.map(point).collect()
}

/// How far away the near plane and the farther of both planes are.
#[derive(Clone, Copy, Debug)]
struct Near {
    near: Distance,
    ratio: f64,
}

impl Near {
    /// The plane some 10,000 units away, where a step of Q16.16 is below 2^-29 of its distance, and
    /// the near plane at its place in Q16.16 at or before that. From a ratio of 2^29 on, which puts
    /// the near plane at the least place, the plane is as far away as the ratio wants.
    fn far_away(ratio: f64, random: &mut Random) -> Self {
        // At most 2^14 units away, so that the object reaches to less than 2 w.
        let near = Distance::from_num(random.real(8_500.0, 15_000.0) / ratio);
        Self { near: near.max(Distance::from_bits(1)), ratio }
    }

    /// The near plane at the least place.
    const fn least(ratio: f64, _: &mut Random) -> Self {
        Self { near: Distance::from_bits(1), ratio }
    }
}

/// A plane before the eye.
struct Planes {
    stage: Stage<Perspective>,
    /// Of its middle, in units.
    distance: f64,
}

impl Planes {
    /// The largest tangent of the angle between it and the screen is `tilt`.
    fn new(Near { near, ratio }: Near, tilt: f64, random: &mut Random) -> Self {
        let distance = near.to_num::<f64>() * ratio;
        let angle = random.real(0.0, 1.0).atan() / std::f64::consts::TAU * tilt;
        let tilt = Rotation::about_x(Turn::from_bits((angle * 2f64.powi(32)) as u32));
        let [before, after] = [(); 2].map(|()| Rotation::about_z(stage::angle(random)));
        let half = i16::MAX;
        let stage = Stage {
            positions: vec![[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            scale: stage::scale(HALF * distance / f64::from(half)),
            pose: Pose::rotated(after * tilt * before),
            eye: EYE,
            lens: Lens::perspective(FOCAL_LENGTH, near, Distance::MAX),
        };
        Self { stage, distance }
    }

    /// The plane nearer by a part of its distance.
    fn nearer(&self, gap: f64) -> Stage<Perspective> {
        let [x, y, z] = stage::numbers(EYE);
        let place = stage::vector([x, y, z - self.distance * (1.0 - gap)]);
        Stage { pose: self.stage.pose.at(place), ..self.stage.clone() }
    }

    /// The depths of its pixels.
    fn depths<D: StoredDepth>(&self, gap: f64) -> Vec<D> {
        let depths = self.nearer(gap).depths::<S8, D>(stage::middle(SIDE));
        depths.expect("a plane is small compared with its distance")
    }

    /// Draws the farther one.
    #[expect(clippy::unnecessary_wraps, reason = "the core refuses other families' objects")]
    fn work(&self, depth: &'static str) -> Option<Work> {
        Some(self.nearer(0.0).draw::<S8>(stage::middle(SIDE), depth))
    }
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn in_16_bits() {
        holds(&super::U16);
    }

    #[test]
    fn in_16_bits_with_an_exponent() {
        holds(&super::FLOAT);
    }

    #[test]
    fn in_32_bits() {
        holds(&super::U32);
        holds(&super::U32_FACING);
        holds(&super::U32_PLACED);
    }
}
