//! Rotations that are composed many times.
//!
//! An entry of a product is rounded to a 2^30th, by up to half of one, which moves the product of
//! two rows by 2^-29 at most. What the factors themselves are off by adds up too:
//! `A M (A M)^T = A (M M^T - 1) A^T + A A^T`. The sine and the cosine of an angle have
//! `s^2 + c^2 - 1` up to 2^-27.5, with a mean of 1.4e-10. So a fixed rotation adds up its own
//! error; random ones are a random walk first, and a drift of 2 / 3 times that mean later: an axis
//! has no part in a third of them. [`Rotation::compose`] restores the rows each time.

use rasterizer::numbers::Rotation;

use super::{
    curve::{Family, Law, Point},
    stage,
    work::{Cost, Work},
};
use crate::reference::random::Random;

const PARAMETER: &str = "rotations composed";
const ERROR: &str = "largest entry of M M^T - 1 in steps of 2^-30";
const BOUND: &str = "2^-26 for each rotation, and 2^-29 for each product (`Rotation`)";
const END: &str = "\
Up to 56 products stay within the 2^-20 that `Rotation::from_rows` wants. After 2^17 the bound is
2^-8.8, and half of that in length: a pixel at the rim of a picture 2,048 pixels wide.
`Rotation::compose` has no end.";

/// Random ones.
pub(super) static RANDOM: Family = Family {
    name: "Products of random rotations",
    about: "Products by `*` of rotations by random angles about random ones of the three axes.",
    parameter: PARAMETER,
    error: ERROR,
    laws: &[
        Law {
            slope: 0.5,
            tolerance: 0.1,
            segment: [2.0, 64.0],
            why: "errors of random sign add up like a random walk",
        },
        Law {
            slope: 1.0,
            tolerance: 0.1,
            segment: [8192.0, 131_072.0],
            why: "the rows of a random rotation are too long by 9e-11 in the mean, which adds up",
        },
    ],
    bound: BOUND,
    end: END,
    cost: cost(|count, _| work(count, false)),
    measure: |instances| {
        measure(instances, stated, |rotation, _, random| about_an_axis(random) * rotation)
    },
};

/// One rotation again and again.
pub(super) static REPEATED: Family = Family {
    name: "Powers of a rotation",
    about: "A random rotation multiplied by itself with `*`.",
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 1.0,
        tolerance: 0.1,
        segment: [64.0, 131_072.0],
        why: "the error of the repeated rotation is the same each time",
    }],
    bound: BOUND,
    end: END,
    cost: cost(|count, _| work(count, false)),
    measure: |instances| measure(instances, stated, |rotation, repeated, _| repeated * rotation),
};

/// Restored each time.
pub(super) static COMPOSED: Family = Family {
    name: "Rotations composed with their rows restored",
    about: "The same random rotations composed by `Rotation::compose`.",
    parameter: PARAMETER,
    error: ERROR,
    laws: &[Law {
        slope: 0.0,
        tolerance: 0.1,
        segment: [1.0, 131_072.0],
        why: "the rows are made orthonormal each time, and lose what one product loses",
    }],
    bound: "2^-26 (`Rotation::compose`)",
    end: "It has no end.",
    cost: cost(|count, _| work(count, true)),
    measure: |instances| {
        let kept = |_| 2f64.powi(-26);
        measure(instances, kept, |rotation, _, random| about_an_axis(random).compose(rotation))
    },
};

/// What is measured of an instance.
const fn cost(work: fn(f64, &mut Random) -> Option<Work>) -> Cost {
    Cost {
        of: "to compose them",
        laws: &[Law {
            slope: 1.0,
            tolerance: 0.05,
            segment: [1.0, LONGEST],
            why: "each takes as long",
        }],
        work,
    }
}

/// The most compositions whose run time is measured.
const LONGEST: f64 = 4096.0;

fn work(count: f64, restores: bool) -> Option<Work> {
    (count <= LONGEST).then_some(Work::Compose { count: count as u32, restores })
}

/// Of an entry, from 0 to 1.
const STEPS: f64 = (1 << 30) as f64;
/// The last point has 2 to this power compositions.
const MOST: u32 = 17;

fn about_an_axis(random: &mut Random) -> Rotation {
    let about = [Rotation::about_x, Rotation::about_y, Rotation::about_z];
    about[random.real(0.0, 3.0) as usize](stage::angle(random))
}

fn stated(count: f64) -> f64 {
    count * (2f64.powi(-26) + 2f64.powi(-29))
}

/// `step` returns the next product from the last one and a rotation that stays the same.
///
/// One in twenty instances: each goes through all counts.
fn measure(
    instances: usize,
    bound: fn(f64) -> f64,
    step: fn(Rotation, Rotation, &mut Random) -> Rotation,
) -> Vec<Point> {
    let instances = instances.div_ceil(20);
    let mut random = Random(1);
    let mut worst = [0f64; MOST as usize + 1];
    for _ in 0..instances {
        let repeated = stage::rotation(&mut random);
        let mut rotation = Rotation::IDENTITY;
        for count in 1..=1u32 << MOST {
            rotation = step(rotation, repeated, &mut random);
            if count.is_power_of_two() {
                let worst = &mut worst[count.ilog2() as usize];
                *worst = worst.max(skew(&rotation));
            }
        }
    }
    let point = |(exponent, error)| {
        let parameter = 2f64.powi(exponent);
        let [error, bound] = [error, bound(parameter)].map(|value| Some(value * STEPS));
        Point { parameter, error, bound, instances, without: 0 }
    };
    (0..).zip(worst).map(point).collect()
}

/// The largest difference of M M^T from the identity.
fn skew(rotation: &Rotation) -> f64 {
    let rows = rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
    let mut worst = 0f64;
    for i in 0..3 {
        for j in 0..3 {
            let product: f64 = (0..3).map(|k| rows[i][k] * rows[j][k]).sum();
            worst = worst.max((product - f64::from(u8::from(i == j))).abs());
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn of_random_ones() {
        holds(&super::RANDOM);
    }

    #[test]
    fn of_one_rotation() {
        holds(&super::REPEATED);
    }

    #[test]
    fn with_rows_restored() {
        holds(&super::COMPOSED);
    }
}
