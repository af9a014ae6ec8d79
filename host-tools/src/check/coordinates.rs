//! Texture coordinates: the core's at each pixel against the exact ones.

use super::object::FixedPicture;
use crate::reference::{DepthFormat, Picture, Wrap};

/// An exact texture coordinate, and how far one of the core may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactCoordinate {
    /// u and v: 1 is the texture's width or height.
    pub uv: [f64; 2],
    /// How far each may be off, in texels.
    pub bounds: [f64; 2],
    /// Width and height of the texture in texels.
    pub size: [usize; 2],
    /// How it goes on beyond its edges.
    pub wrap: [Wrap; 2],
}

/// How far the texture coordinates of a picture are off.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Texels {
    /// The largest error of u or v, in texels.
    pub texel_max_error: f64,
    /// The pixel whose error is the largest part of its bound; `None` if no pixel has a texture.
    pub texel_worst: Option<TexelError>,
    /// What the bound of a pixel is.
    pub texel_bound: &'static str,
}

/// How far the coordinate of a pixel is off, in the axis where that is more of the bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct TexelError {
    /// Column and row.
    pub pixel: [usize; 2],
    /// The triangle of the tables that is compared there.
    pub triangle: usize,
    /// The error in texels.
    pub error_texels: f64,
    /// How large it may be.
    pub bound_texels: f64,
}

impl Texels {
    /// Whether each pixel keeps its bound.
    #[must_use]
    pub fn are_within(&self) -> bool {
        self.out_of_bounds().is_none()
    }

    /// The pixel that exceeds its bound the most.
    #[must_use]
    pub fn out_of_bounds(&self) -> Option<TexelError> {
        self.texel_worst.filter(|worst| worst.error_texels > worst.bound_texels)
    }
}

impl TexelError {
    /// Whether this is a larger part of its bound than the other.
    fn is_worse(&self, other: &Self) -> bool {
        self.error_texels * other.bound_texels > other.error_texels * self.bound_texels
    }
}

impl ExactCoordinate {
    /// How far a coordinate of the core is off. Whole repeats don't count, nor whole pairs of
    /// mirror images.
    fn error(&self, uv: [f64; 2], pixel: [usize; 2], triangle: usize) -> TexelError {
        let of_axis = |axis: usize| {
            let off = uv[axis] - self.uv[axis];
            let off = match self.wrap[axis] {
                Wrap::Clamp => off,
                Wrap::Repeat => off - off.round(),
                Wrap::Mirror => off - 2.0 * (off / 2.0).round(),
            };
            TexelError {
                pixel,
                triangle,
                error_texels: off.abs() * self.size[axis] as f64,
                bound_texels: self.bounds[axis],
            }
        };
        let [u, v] = [of_axis(0), of_axis(1)];
        if v.is_worse(&u) { v } else { u }
    }
}

/// Compares the coordinates of the core's pixels, row by row and `None` where there is none, with
/// the exact ones of a reference with depth from 0 to 1.
///
/// Each layer within a unit of the stored depth may be the one that is drawn. (The nearest may not:
/// there it may be transparent.)
pub(super) fn compare(
    drawn: &[Option<[f64; 2]>],
    fixed: &FixedPicture,
    depth: DepthFormat,
    reference: &Picture<ExactCoordinate>,
    texel_bound: &'static str,
) -> Texels {
    let mut found = Texels { texel_bound, ..Texels::default() };
    for (index, &uv) in drawn.iter().enumerate() {
        let Some(uv) = uv.filter(|_| fixed.pixels[index].depth != 0) else { continue };
        let [x, y] = [index % reference.width(), index / reference.width()];
        let stored = f64::from(fixed.pixels[index].depth);
        let is_shown = |of: f64| (depth.stored(depth.units(of)) - stored).abs() <= 1.0;
        let best = reference
            .fragments(x, y)
            .iter()
            .filter(|fragment| is_shown(fragment.depth))
            .map(|fragment| fragment.color.error(uv, [x, y], fragment.triangle))
            .reduce(|best, next| if best.is_worse(&next) { next } else { best });
        let Some(error) = best else { continue };
        found.texel_max_error = found.texel_max_error.max(error.error_texels);
        if found.texel_worst.is_none_or(|worst| error.is_worse(&worst)) {
            found.texel_worst = Some(error);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: ExactCoordinate = ExactCoordinate {
        uv: [0.25, -0.5],
        bounds: [1.0, 0.5],
        size: [64, 32],
        wrap: [Wrap::Repeat, Wrap::Mirror],
    };

    #[test]
    fn errors_are_in_texels_without_whole_repeats() {
        let error = |exact: &ExactCoordinate, uv| {
            let TexelError { error_texels, bound_texels, .. } = exact.error(uv, [0; 2], 0);
            (error_texels, bound_texels)
        };
        assert_eq!(error(&EXACT, [0.25, -0.5]), (0.0, 1.0));
        // 1/64 of 64 texels, against 1; 1/32 of 32 texels, against 1/2.
        assert_eq!(error(&EXACT, [0.25 + 1.0 / 64.0, -0.5]), (1.0, 1.0));
        assert_eq!(error(&EXACT, [0.25 + 1.0 / 64.0, -0.5 - 1.0 / 32.0]), (1.0, 0.5));
        // Any repeats of u, pairs of those of v.
        assert_eq!(error(&EXACT, [-6.75, 7.5]), (0.0, 1.0));
        assert_eq!(error(&EXACT, [0.25, 0.5]).0, 32.0);
        let clamped = ExactCoordinate { wrap: [Wrap::Clamp; 2], ..EXACT };
        assert_eq!(error(&clamped, [1.25, -0.5]), (64.0, 1.0));
    }

    #[test]
    fn the_worst_is_the_largest_part_of_its_bound() {
        let error = |error_texels, bound_texels| TexelError {
            pixel: [0; 2],
            triangle: 0,
            error_texels,
            bound_texels,
        };
        assert!(error(0.5, 0.5).is_worse(&error(3.0, 4.0)));
        assert!(!error(3.0, 4.0).is_worse(&error(0.5, 0.5)));
        let texels = |worst| Texels { texel_worst: worst, ..Texels::default() };
        assert!(texels(None).are_within() && texels(Some(error(0.5, 0.5))).are_within());
        assert_eq!(texels(Some(error(0.6, 0.5))).out_of_bounds(), Some(error(0.6, 0.5)));
    }
}
