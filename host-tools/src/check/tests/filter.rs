//! The colours that count as right, against what the definitions give nearby.

use super::*;
use crate::reference::{Footprint, Mipmaps, Texel, Texture, Wrap};

/// Levels from 8 x 8 texels down to one, of random colours. `alpha` returns that of a texel.
fn mipmaps(wrap: Wrap, alpha: impl Fn(usize) -> f64) -> Mipmaps {
    let mut random = Random(31);
    let level = |level: u32| {
        let side = 8 >> level;
        let mut texel = |i| {
            let [r, g, b] = [(); 3].map(|()| random.real(0.0, 256.0).floor());
            [r, g, b, alpha(i)]
        };
        Texture::new([side; 2], [wrap; 2], (0..side * side).map(&mut texel).collect())
    };
    let levels: Vec<_> = [0, 1, 2, 3].into_iter().map(level).collect();
    Mipmaps::new(levels)
}

/// At a coordinate in texels, with 2^level texels to a pixel.
fn seen(texture: &Mipmaps, texels: [f64; 2], level: f64, bound: f64) -> Seen<'_> {
    let slope = 2f64.powf(level) / 8.0;
    Seen {
        texture,
        is_translucent: false,
        exact: Footprint {
            uv: texels.map(|c| c / 8.0),
            per_column: [slope, 0.0],
            per_row: [0.0, slope],
            inverse_w: 1.0,
        },
        bounds: [bound; 2],
        level,
        light: 1.0,
    }
}

/// How far the closest right colour is from one.
fn off(seen: &Seen<'_>, filter: Filter, [red, green, blue, _]: Texel) -> f64 {
    let drawn = [red, green, blue];
    let right = seen.right(filter, Precision::OF_CHANNELS, drawn).color.unwrap();
    (0..3).map(|i| (right[i] - drawn[i]).abs()).fold(0.0, f64::max)
}

#[test]
fn only_the_texels_that_touch_are_right() {
    let texture = mipmaps(Wrap::Repeat, |_| 255.0);
    let base = texture.base();
    // In the middle of a texel; close to its left border; close to a corner.
    for (place, right) in [
        ([3.5, 4.5], vec![[3, 4]]),
        ([3.05, 4.5], vec![[3, 4], [2, 4]]),
        ([2.97, 4.5], vec![[2, 4], [3, 4]]),
        ([8.02, 4.97], vec![[0, 4], [7, 4], [0, 5], [7, 5]]),
    ] {
        let seen = seen(&texture, place, 0.0, 1.0 / 16.0);
        for column in 0..8 {
            for row in 0..8 {
                let off = off(&seen, Filter::Nearest, base.texel([column, row]));
                assert_eq!(off == 0.0, right.contains(&[column, row]), "{place:?} {column} {row}");
            }
        }
    }
}

#[test]
fn filtered_colors_nearby_are_right_and_others_are_not() {
    let mut random = Random(32);
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        let texture = mipmaps(wrap, |_| 255.0);
        for case in 0..2_000 {
            let bound = [1.0 / 16.0, 0.3, 1.7, 9.0][case % 4];
            let place = [(); 2].map(|()| random.real(-3.0, 12.0));
            let level = random.real(-1.0, 4.0);
            let seen = seen(&texture, place, level, bound);
            let uv = place.map(|c| (c + bound * random.real(-1.0, 1.0)) / 8.0);
            let close = texture.base().bilinear(uv);
            assert!(off(&seen, Filter::Bilinear, close) < 1e-9, "{wrap:?} {place:?} {bound}");
            let close = texture.trilinear(uv, level + random.real(-0.25, 0.25));
            assert!(off(&seen, Filter::Trilinear, close) < 1e-9, "{wrap:?} {place:?} {bound}");
            // At the exact place, the range is no wider than the slopes of the texels around it:
            // 255 steps a texel, both ways.
            if bound < 0.1 {
                let exact = texture.base().bilinear(place.map(|c| c / 8.0));
                let far = exact.map(|c| if c < 128.0 { c + 70.0 } else { c - 70.0 });
                let reach = 2.0 * 255.0 * (bound + 1.0 / 512.0);
                assert!(off(&seen, Filter::Bilinear, far) > 70.0 - reach, "{place:?}");
            }
        }
    }
}

#[test]
fn short_weights_may_be_half_a_unit_of_32_off() {
    // Two black texels on one diagonal, two white ones on the other: weights that are off show the
    // most. In the middle of the four, the product of the fractions is 64 / 256.
    let black_and_white = [0.0, 255.0, 255.0, 0.0].map(|c| [c, c, c, 255.0]).to_vec();
    let texture = Mipmaps::new(vec![Texture::new([2, 2], [Wrap::Clamp; 2], black_and_white)]);
    let seen = Seen { bounds: [0.0; 2], ..seen(&texture, [4.0, 4.0], 0.0, 0.0) };
    let right = |precision, grey: f64| {
        let right = seen.right(Filter::Bilinear, precision, [grey; 3]).color.unwrap();
        (right[0] - grey).abs()
    };
    let exact = 127.5;
    for (precision, units) in [(Precision::OF_CHANNELS, 1e-2), (Precision::OF_WORDS, 1.0 / 16.0)] {
        assert_eq!(right(precision, exact), 0.0);
        // The fractions' rounding is of the second order here.
        assert!(right(precision, exact + 255.0 * units + 1.0) > 0.0, "{precision:?}");
    }
    assert_eq!(right(Precision::OF_WORDS, exact + 255.0 / 32.0), 0.0);
    assert!(right(Precision::OF_CHANNELS, exact + 255.0 / 32.0) > 7.0);
}

#[test]
fn a_level_is_right_within_a_quarter() {
    let texture = mipmaps(Wrap::Repeat, |_| 255.0);
    let place = [3.5, 4.5];
    for (level, right) in [
        (-2.0, vec![0]),
        (0.2, vec![0]),
        (0.3, vec![0, 1]),
        (0.7, vec![0, 1]),
        (0.8, vec![1]),
        (1.5, vec![1, 2]),
        (2.9, vec![3]),
        (7.0, vec![3]),
    ] {
        let seen = seen(&texture, place, level, 0.0);
        for (number, texels) in texture.levels().iter().enumerate() {
            let texel = texels.nearest(place.map(|c| c / 8.0));
            let is_right = off(&seen, Filter::Mipmap, texel) == 0.0;
            assert_eq!(is_right, right.contains(&number), "{level}: {number}");
        }
    }
    // A level too far, or too near, shows in the mixture of two.
    for level in [0.5, 1.5, 2.0] {
        let seen = seen(&texture, place, level, 0.0);
        for wrong in [level - 0.9, level + 0.9] {
            let texel = texture.trilinear(place.map(|c| c / 8.0), wrong);
            assert!(off(&seen, Filter::Trilinear, texel) > 2.0, "{level} {wrong}");
        }
    }
}

#[test]
fn transparent_texels_are_holes_with_uncertain_borders() {
    // Every second column is transparent.
    let texture = mipmaps(Wrap::Repeat, |i| if i % 2 == 0 { 0.0 } else { 255.0 });
    for filter in [Filter::Nearest, Filter::Bilinear] {
        let right = |x: f64| {
            let seen = seen(&texture, [x, 4.5], 0.0, 1.0 / 16.0);
            let right = seen.right(filter, Precision::OF_CHANNELS, [0.0; 3]);
            (right.color.is_some(), right.may_be_transparent)
        };
        assert_eq!(right(2.5), (false, true), "{filter:?}");
        assert_eq!(right(3.5), (true, false), "{filter:?}");
        assert_eq!(right(2.98), (true, true), "{filter:?}");
        assert_eq!(right(3.02), (true, true), "{filter:?}");
    }
}

#[test]
fn light_is_within_half_a_level() {
    let white = Texture::new([1, 1], [Wrap::Clamp; 2], vec![[255.0; 4]]);
    let texture = Mipmaps::new(vec![white]);
    let right = |light, precision, grey: f64| {
        let seen = Seen { light, ..seen(&texture, [0.0; 2], 0.0, 0.0) };
        let right = seen.right(Filter::Nearest, precision, [grey; 3]).color.unwrap();
        (right[0] - grey).abs()
    };
    assert_eq!(right(1.0, Precision::OF_WORDS, 250.0), 5.0, "full light is exact");
    assert!(right(0.5, Precision::OF_WORDS, 127.5 + 255.0 / 64.0) < 1e-9);
    assert!(right(0.5, Precision::OF_WORDS, 127.5 + 255.0 / 64.0 + 1.0) > 0.9);
    assert!(right(0.5, Precision::OF_CHANNELS, 127.5 + 255.0 / 64.0) > 3.0);
}
