//! A wall that recedes, drawn in perspective with a division at every k-th pixel.
//!
//! Between two exact points the line is off by the chord's distance from the hyperbola,
//! `du (sqrt(r) - 1) / (sqrt(r) + 1)` with the ratio r of 1 / w at both
//! ([`chord_error`]). Both du and r - 1 grow with k, so that the error grows with its square, while
//! the work falls with one over k.

use rasterizer::{
    attribute::{
        Correction, Every, EveryPixel, Interpolate, InverseW, NoDepth, PerspectiveCorrect,
        Varyings as _,
    },
    camera::Distance,
    geometry::{Pose, ScreenVertex},
    numbers::{S8, Subpixel as _, Vec3},
};

use super::{
    curve::{Family, Law, powers, sweep},
    fragments::{Exact, visit},
    stage::{self, Lens, SIZE, Stage},
    work::{Cost, Scene, Work},
};
use crate::reference::{chord_error, random::Random};

/// The family.
pub(super) static STEPS: Family = Family {
    name: "A wall in perspective by steps",
    about: "\
A number of 16 bits over a wall that recedes to up to three times its distance along 300 pixels,
divided at every k-th pixel (`Every`, and `EveryPixel` for 1), compared with its definition in f64.
The number changes by its whole range along the wall.",
    parameter: "k in pixels",
    error: "units of the number",
    laws: &[Law {
        slope: 2.0,
        tolerance: 0.1,
        segment: [2.0, 16.0],
        why: "the chord of a step is off by its second difference",
    }],
    bound: "du (sqrt(r) - 1) / (sqrt(r) + 1) of the farthest step (`Every`), and 1/256 of a pixel \
            (the crate's table of numbers)",
    end: "Steps have 64 pixels at most. Where r - 1 is over 1/4 in a step, from 37 pixels on, the \
          slope falls below 2, and the bound with it.",
    cost: Cost {
        of: "to draw the wall with a texture",
        laws: &[Law {
            slope: -0.6,
            tolerance: 0.2,
            segment: [2.0, 16.0],
            why: "divisions are one in k pixels; pixels, rows and the set-up are the rest",
        }],
        work: |step, random| Some(work(step, random)),
    },
    measure: |instances| {
        // One in twenty: each has thousands of pixels.
        let instances = instances.div_ceil(20);
        let error = |step: f64, random: &mut Random| {
            Some(match step as u32 {
                1 => error::<EveryPixel>(random),
                2 => error::<Every<2>>(random),
                4 => error::<Every<4>>(random),
                8 => error::<Every<8>>(random),
                16 => error::<Every<16>>(random),
                32 => error::<Every<32>>(random),
                _ => error::<Every<64>>(random),
            })
        };
        sweep(powers(0, 6), instances, |step| Some(bound(step)), error)
    },
};

/// How much farther away the wall's end is than its start, at most.
const RECEDES: f64 = 3.0;
/// In pixels.
const WIDTH: f64 = 300.0;
const RANGE: f64 = 65_535.0;

/// 1 / w falls from 1 to 1 / r along the wall, so that it changes by a part (r - 1) / width of its
/// least value from pixel to pixel, and the number there by that part of its whole range.
fn bound(step: f64) -> f64 {
    let change = (RECEDES - 1.0) / WIDTH;
    // From the step's near end to the far one.
    let ratio = 1.0 + step * change;
    let per_pixel = RANGE * RECEDES / WIDTH;
    let chord = if step > 1.0 { chord_error(step * per_pixel / ratio, ratio) } else { 0.0 };
    chord + per_pixel / 256.0
}

/// Draws one in the middle of the picture, with texture coordinates for the number.
fn work(step: f64, random: &mut Random) -> Work {
    let ratio = random.real(0.9, 1.0) * RECEDES;
    // The focal length is as many pixels as the wall is wide, and its near end one unit away.
    let corner = |is_far: bool, side: f64| {
        let distance = if is_far { ratio } else { 1.0 };
        let x = if is_far { 0.5 } else { -0.5 } * distance;
        [x, side * 10.0 / WIDTH, -distance].map(|c| (c * UNIT) as i16)
    };
    let corners = [false, true].map(|is_far| [-1.0, 1.0].map(|side| corner(is_far, side)));
    let stage = Stage {
        positions: corners.as_flattened().to_vec(),
        triangles: vec![[0, 1, 2], [1, 3, 2]],
        scale: stage::scale(1.0 / UNIT),
        pose: Pose::IDENTITY,
        eye: Vec3::ZERO,
        lens: Lens::perspective(Distance::from_num(WIDTH), Distance::ONE / 2, Distance::MAX),
    };
    let end = 1 << 24;
    Work::DrawTexture {
        scene: Scene {
            texture_coordinates: vec![[0, 0], [0, end], [end, 0], [end, end]],
            ..stage.scene::<S8>()
        },
        part: [0, 0, SIZE[0] as i32, SIZE[1] as i32],
        filter: "Nearest",
        correction: if step == 1.0 { "EveryPixel".into() } else { format!("Every::<{step}>") },
    }
}

/// Quanta in a unit.
const UNIT: f64 = 8192.0;

fn error<M: Correction>(random: &mut Random) -> f64 {
    let (ratio, unit) = (random.real(0.9, 1.0) * RECEDES, f64::from(1 << S8::BITS));
    let (left, middle) = (random.real(-500.0, 500.0), random.real(-500.0, 500.0));
    let corner = |is_far: bool, side: f64| {
        let along = f64::from(u8::from(is_far));
        let q = if is_far { 0.999 / ratio } else { 0.999 };
        let place = [left + along * WIDTH, middle + side * 10.0 * q];
        let place = place.map(|c| (c * unit).round() as i32);
        (place, (q * 2f64.powi(32)) as u32, (along * RANGE) as u16)
    };
    let [a, b] = [-1.0, 1.0].map(|side| corner(false, side));
    let [c, d] = [-1.0, 1.0].map(|side| corner(true, side));
    let mut worst = 0f64;
    for corners in [[a, b, c], [b, d, c]] {
        let vertices = corners.map(|([x, y], q, number)| {
            let number = PerspectiveCorrect::<[u16; 1], M>::new([number]);
            let number = number.on_screen(InverseW::from_bits(q));
            ScreenVertex::<S8, NoDepth, _>::checked(x, y, NoDepth, number).expect("it is near")
        });
        let exact = Exact(corners.map(|(place, ..)| place));
        visit(&vertices, |pixel, (), number| {
            let weights = exact.weights::<S8>(pixel).map(|weight| weight as f64);
            let over_w = |i: usize| weights[i] * f64::from(corners[i].1);
            let sum = |of: &dyn Fn(usize) -> f64| (0..3).map(of).sum::<f64>();
            let exact = sum(&|i| over_w(i) * f64::from(corners[i].2)) / sum(&over_w);
            // Half a unit is there for rounding.
            let [got] = M::OnScreen::<[u16; 1]>::sample(number).value;
            worst = worst.max((got.to_num::<f64>() - 0.5 - exact).abs());
        });
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::super::curve::tests::holds;

    #[test]
    fn by_steps() {
        holds(&super::STEPS);
    }
}
