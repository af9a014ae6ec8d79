//! Where texture coordinates are divided, and how far they may be off there.

use crate::reference::{Footprint, Sample, chord_error_in_steps};

/// How texture coordinates are interpolated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Correction {
    /// Linearly on the screen.
    Affine,
    /// In perspective, with a division at every pixel.
    EveryPixel,
    /// In perspective at every 4th pixel of a span and its last one, linearly between them.
    Every4,
    /// At every 8th.
    Every8,
    /// At every 16th.
    Every16,
    /// At every 32nd.
    Every32,
    /// In perspective as often as half a texel needs it.
    #[default]
    Adaptive,
}

/// The least bound of a coordinate, in texels.
const TEXELS: f64 = 1.0 / 16.0;
/// Where texels are small, a coordinate may be that of a point this far away, in pixels.
const PIXELS: f64 = 1.0 / 256.0;
/// The tolerance of [`Correction::Adaptive`] in texels.
const TOLERANCE: f64 = 0.5;

impl Correction {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 7] = [
        ("affine", Self::Affine),
        ("every-pixel", Self::EveryPixel),
        ("every-4", Self::Every4),
        ("every-8", Self::Every8),
        ("every-16", Self::Every16),
        ("every-32", Self::Every32),
        ("adaptive", Self::Adaptive),
    ];

    /// The number of pixels from an exact one to the next; `None` for all but the modes with a
    /// fixed number.
    const fn step(self) -> Option<usize> {
        match self {
            Self::Every4 => Some(4),
            Self::Every8 => Some(8),
            Self::Every16 => Some(16),
            Self::Every32 => Some(32),
            Self::Affine | Self::EveryPixel | Self::Adaptive => None,
        }
    }

    /// What the reference interpolates from a corner, for [`exact`](Self::exact).
    #[must_use]
    pub fn corner(self, uv: [f64; 2], inverse_w: f64) -> [f64; 3] {
        // All corners at one distance: that is affine.
        Footprint::over_w(uv, if self == Self::Affine { 1.0 } else { inverse_w })
    }

    /// The exact coordinate of a sample whose first three varyings come from
    /// [`corner`](Self::corner).
    #[must_use]
    pub fn exact<const N: usize>(self, sample: &Sample<N>) -> Footprint {
        let first = |all: [f64; N]| [all[0], all[1], all[2]];
        Footprint::in_perspective(
            first(sample.varyings),
            first(sample.per_column),
            first(sample.per_row),
        )
    }

    /// How far u and v may be off, in texels of a texture of `size`.
    #[must_use]
    pub fn bounds<const N: usize>(self, sample: &Sample<N>, size: [usize; 2]) -> [f64; 2] {
        let exact = self.exact(sample);
        [0, 1].map(|axis| {
            let side = size[axis] as f64;
            let per_pixel = exact.per_column[axis].hypot(exact.per_row[axis]) * side;
            let at_exact_points = TEXELS.max(PIXELS * per_pixel);
            let [first, last] = sample.span;
            match self {
                Self::Affine | Self::EveryPixel => at_exact_points,
                Self::Adaptive => at_exact_points.max(TOLERANCE),
                _ => {
                    // The exact values along the row, up to the span's ends.
                    let value = |place: usize| {
                        let by = (first + place) as f64 - sample.pixel[0] as f64;
                        let at = |i: usize| sample.varyings[i] + by * sample.per_column[i];
                        (at(axis) / at(2) * side, at(2))
                    };
                    let step = self.step().unwrap_or(1);
                    let at = sample.pixel[0] - first;
                    at_exact_points + chord_error_in_steps(value, last - first, at, step)
                }
            }
        })
    }

    /// Why [`bounds`](Self::bounds) is that.
    #[must_use]
    pub const fn reason(self) -> &'static str {
        match self {
            Self::Affine | Self::EveryPixel => "1/16 texel or 1/256 pixel, the larger one",
            Self::Adaptive => "its tolerance of 1/2 texel, or 1/256 pixel",
            Self::Every4 | Self::Every8 | Self::Every16 | Self::Every32 => {
                "1/16 texel or 1/256 pixel, and |du| |√r - 1| / (√r + 1) for a step of the span"
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{Picture, ScreenTriangle, ScreenVertex, draw_screen};

    const WIDTH: usize = 320;

    /// A wall from the left side of the picture to the right, at distances from 1 to `ratio`, with
    /// `repeats` of a texture along it and one from top to bottom. Returns exact coordinates and
    /// bounds of one row.
    fn wall(
        correction: Correction,
        ratio: f64,
        repeats: f64,
        size: [usize; 2],
    ) -> Vec<(Footprint, [f64; 2])> {
        let corner = |x: f64, y: f64, uv: [f64; 2]| {
            let inverse_w = if x == 0.0 { 1.0 } else { 1.0 / ratio };
            let varyings = correction.corner(uv, inverse_w);
            ScreenVertex { x, y, depth: inverse_w, varyings }
        };
        // One triangle that reaches over the picture's lower side, so that a row is one span.
        let far = WIDTH as f64;
        let vertices = [
            corner(0.0, 0.0, [0.0, 0.0]),
            corner(far, 0.0, [repeats, 0.0]),
            corner(0.0, 1e3, [0.0, 1.0]),
        ];
        let triangle = ScreenTriangle { vertices, number: 0 };
        let picture: Picture<_> = draw_screen(&[triangle], (WIDTH, 1), |sample| {
            Some((correction.exact(&sample), correction.bounds(&sample, size)))
        });
        (0..WIDTH - 1).map(|x| picture.fragments(x, 0)[0].color).collect()
    }

    #[test]
    fn a_receding_wall_is_hyperbolic_and_affine_is_straight() {
        for (at, (found, _)) in wall(Correction::EveryPixel, 4.0, 8.0, [64; 2]).iter().enumerate() {
            // u = 8 t / 4 / (1 - t + t / 4).
            let t = (at as f64 + 0.5) / WIDTH as f64;
            let expected = 8.0 * t / 4.0 / (1.0 - t + t / 4.0);
            // Half a pixel below the upper edge there is 1/2000 of the third corner.
            assert!((found.uv[0] - expected).abs() < 0.01, "{at}: {found:?} {expected}");
        }
        for (at, (found, _)) in wall(Correction::Affine, 4.0, 8.0, [64; 2]).iter().enumerate() {
            let t = (at as f64 + 0.5) / WIDTH as f64;
            assert!((found.uv[0] - 8.0 * t).abs() < 0.01, "{at}: {found:?}");
        }
    }

    #[test]
    fn bounds_are_texels_or_pixels() {
        // 64 texels over 320 pixels square to the view: 1/5 texel a pixel.
        for correction in [Correction::Affine, Correction::EveryPixel, Correction::Every16] {
            for (_, bounds) in wall(correction, 1.0, 1.0, [64; 2]) {
                assert!((bounds[0] - 1.0 / 16.0).abs() < 1e-9, "{correction:?} {bounds:?}");
            }
        }
        // 320 repeats of 64 texels: 64 texels a pixel, of which 1/256 is 1/4.
        for (_, bounds) in wall(Correction::EveryPixel, 1.0, 320.0, [64; 2]) {
            assert!((bounds[0] - 0.25).abs() < 1e-9, "{bounds:?}");
            assert!((bounds[1] - 1.0 / 16.0).abs() < 1e-9, "{bounds:?}");
        }
        for (_, bounds) in wall(Correction::Adaptive, 1.0, 320.0, [64; 2]) {
            assert_eq!(bounds, [0.5, 0.5]);
        }
    }

    /// The figures of the closed form for a wall of 64 texels per unit of depth: from 1:1 to 1:2
    /// over 320 pixels it is off by 0.07 texels in steps of 16, and by 0.005 in steps of 4.
    #[test]
    fn steps_are_bounded_by_their_law() {
        for (correction, most) in [
            (Correction::Every4, 0.005),
            (Correction::Every8, 0.019),
            (Correction::Every16, 0.074),
            (Correction::Every32, 0.28),
        ] {
            let bounds = wall(correction, 2.0, 1.0, [64; 2]);
            let worst = bounds.iter().map(|(_, bounds)| bounds[0]).fold(0.0, f64::max);
            let law = worst - TEXELS;
            assert!((law / most - 1.0).abs() < 0.1, "{correction:?}: {law}");
            // Least at the near end, most at the far end.
            assert!(bounds[0].1[0] < bounds[WIDTH - 2].1[0]);
        }
    }
}
