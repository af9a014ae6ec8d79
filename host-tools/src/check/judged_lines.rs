//! Lines and points of a model against their definitions: which pixels they own, their depth and
//! their colour, where surfaces hide them and where they don't.
//!
//! Each table of lines or points is drawn by the core over what is there. The reference gets the
//! ends as the core places them, clipped or not, and decides for each pixel which of the lines own
//! it, how deep they are there and which colours they have. Vertices are judged by themselves
//! ([`Vertices`](super::Vertices)).

use std::convert::Infallible;

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    geometry::ScreenVertex,
    numbers::Subpixel,
    output::{Frame, FrameError},
};

use super::{LineOptions, View};
use crate::reference::{Line, Point};

/// How far lines and points are off their definitions.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct LineOutcome {
    /// The lines that are in the view, or parts of them.
    pub lines: usize,
    /// The points.
    pub points: usize,
    /// The pixels that they own.
    pub line_pixels: usize,
    /// Pixels of these that something hides.
    pub line_pixels_hidden: usize,
    /// Pixels that a line owns but does not cover, or covers but does not own.
    pub line_coverage_mismatches: usize,
    /// The largest difference of depth in units of 2^-32.
    pub line_depth_max_ulp: f64,
    /// The largest difference of a colour channel in 8-bit steps.
    pub line_color_max_error: f64,
    /// The first pixel that is wrong.
    pub line_first_wrong: Option<[usize; 2]>,
}

impl LineOutcome {
    /// How far depth may be off, in units of 2^-32: a unit for rounding, as of triangles.
    pub const DEPTH_MAX_ULP: f64 = 1.0;
    /// How far a channel may be off, in 8-bit steps: rounding on both sides, as of triangles.
    pub const COLOR_MAX_ERROR: f64 = 1.0;

    /// Whether no pixel is wrong, and depth and colours keep their bounds.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.line_coverage_mismatches == 0
            && self.line_depth_max_ulp <= Self::DEPTH_MAX_ULP
            && self.line_color_max_error <= Self::COLOR_MAX_ERROR
    }

    /// The outcome of these lines and of others.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self {
            lines: self.lines + other.lines,
            points: self.points + other.points,
            line_pixels: self.line_pixels + other.line_pixels,
            line_pixels_hidden: self.line_pixels_hidden + other.line_pixels_hidden,
            line_coverage_mismatches: self.line_coverage_mismatches
                + other.line_coverage_mismatches,
            line_depth_max_ulp: self.line_depth_max_ulp.max(other.line_depth_max_ulp),
            line_color_max_error: self.line_color_max_error.max(other.line_color_max_error),
            line_first_wrong: self.line_first_wrong.or(other.line_first_wrong),
        }
    }
}

/// A frame in memory.
#[derive(Clone, Debug)]
pub(super) struct Canvas {
    pub(super) colors: Vec<Rgb888>,
    pub(super) depth: Vec<u32>,
}

impl Canvas {
    /// Draws into it.
    pub(super) fn draw(
        &mut self,
        view: &View,
        draw: impl FnOnce(&mut Frame<'_, Rgb888, &mut [u32]>) -> Result<(), Infallible>,
    ) -> Result<(), FrameError> {
        let mut frame = Frame::new(&mut self.colors, &mut self.depth[..], view.area())?;
        let Ok(()) = draw(&mut frame);
        Ok(())
    }
}

/// A place on the screen, its depth in units of 2^-32 and its colour.
#[derive(Clone, Copy, Debug)]
struct End {
    place: [i64; 2],
    depth: f64,
    color: [f64; 3],
}

/// Lines or points that own a pixel, with what they have there.
#[derive(Clone, Copy, Debug)]
struct Owner {
    depth: f64,
    color: [f64; 3],
}

/// The definitions of a table of lines or points, pixel by pixel.
pub(super) struct Owners {
    size: [i64; 2],
    subpixel_bits: u32,
    options: LineOptions,
    pixels: Vec<Vec<Owner>>,
    lines: usize,
    points: usize,
}

impl Owners {
    /// None, of a view that is drawn in a precision.
    pub(super) fn new<S: Subpixel>(view: &View, options: LineOptions) -> Self {
        Self {
            size: view.size.map(i64::from),
            subpixel_bits: S::BITS,
            options,
            pixels: vec![Vec::new(); view.pixel_count()],
            lines: 0,
            points: 0,
        }
    }

    /// How lines and points are drawn.
    pub(super) const fn options(&self) -> &LineOptions {
        &self.options
    }

    fn end<S: Subpixel, V: rasterizer::attribute::Interpolate>(
        vertex: &ScreenVertex<S, u32, V>,
        color: [f64; 3],
    ) -> Option<End> {
        let place = vertex.position()?.map(i64::from);
        Some(End { place, depth: vertex.depth().into(), color })
    }

    /// Adds a line between two vertices in their colours.
    pub(super) fn add_line<S: Subpixel, V: rasterizer::attribute::Interpolate>(
        &mut self,
        ends: [&ScreenVertex<S, u32, V>; 2],
        colors: [[f64; 3]; 2],
    ) {
        let ends = [0, 1].map(|i| Self::end(ends[i], colors[i]));
        let [Some(from), Some(to)] = ends else { return };
        self.lines += 1;
        let width = u32::from(self.options.line_width);
        let line = Line { ends: [from.place, to.place], subpixel_bits: self.subpixel_bits, width };
        // All pixels that are no farther from the box of the line than its width.
        let reach = i64::from(width) + 2;
        let range = |axis: usize| {
            let [a, b] = [from, to].map(|end| end.place[axis] >> self.subpixel_bits);
            (a.min(b) - reach).max(0)..(a.max(b) + reach + 1).min(self.size[axis])
        };
        let (minor, half) = (1 - line.major(), f64::from(1 << self.subpixel_bits));
        for row in range(1) {
            for column in range(0) {
                let pixel = [column, row];
                let part = line.part(pixel);
                // Far from the line along its minor axis there is nothing to decide.
                let [a, b] = [from, to].map(|end| end.place[minor] as f64 / half);
                let middle = a + part * (b - a);
                if (pixel[minor] as f64 + 0.5 - middle).abs() > reach as f64 || !line.owns(pixel) {
                    continue;
                }
                let between = |a: f64, b: f64| a + part * (b - a);
                self.pixels[(row * self.size[0] + column) as usize].push(Owner {
                    depth: between(from.depth, to.depth),
                    color: [0, 1, 2].map(|i| between(from.color[i], to.color[i])),
                });
            }
        }
    }

    /// Adds a point at a vertex in its colour.
    pub(super) fn add_point<S: Subpixel, V: rasterizer::attribute::Interpolate>(
        &mut self,
        vertex: &ScreenVertex<S, u32, V>,
        color: [f64; 3],
    ) {
        let Some(End { place, depth, color }) = Self::end(vertex, color) else { return };
        self.points += 1;
        let size = u32::from(self.options.point_size);
        let point = Point { place, subpixel_bits: self.subpixel_bits, size };
        let reach = i64::from(size) + 1;
        let range = |axis: usize| {
            let middle = place[axis] >> self.subpixel_bits;
            (middle - reach).max(0)..(middle + reach + 1).min(self.size[axis])
        };
        for row in range(1) {
            for column in range(0) {
                if point.owns([column, row]) {
                    let index = (row * self.size[0] + column) as usize;
                    self.pixels[index].push(Owner { depth, color });
                }
            }
        }
    }

    /// Compares with what the core has made of a canvas: the nearest owner of a pixel is seen if it
    /// is nearer than what was there; of those within the bound of depth each is right.
    pub(super) fn judge(&self, before: &Canvas, after: &Canvas) -> LineOutcome {
        let mut found =
            LineOutcome { lines: self.lines, points: self.points, ..LineOutcome::default() };
        for (index, owners) in self.pixels.iter().enumerate() {
            let [was, is] = [before, after].map(|canvas| f64::from(canvas.depth[index]));
            let color = after.colors[index];
            let has_changed = was != is || before.colors[index] != color;
            found.line_pixels += usize::from(!owners.is_empty());
            let nearest = owners.iter().map(|owner| owner.depth).fold(0.0, f64::max);
            let bound = LineOutcome::DEPTH_MAX_ULP;
            let is_hidden = nearest + bound < was || owners.is_empty();
            let is_seen = nearest - bound > was && !owners.is_empty();
            found.line_pixels_hidden += usize::from(!owners.is_empty() && is_hidden);
            let mut is_wrong = (is_hidden && has_changed) || (is_seen && is == was);
            found.line_coverage_mismatches += usize::from(is_wrong);
            if !is_wrong && has_changed {
                let depth_error = (is - nearest).abs();
                let channels = [color.r(), color.g(), color.b()].map(f64::from);
                let color_error = (owners.iter())
                    .filter(|owner| nearest - owner.depth <= 2.0 * bound)
                    .map(|owner| {
                        let off = |i: usize| (owner.color[i].round() - channels[i]).abs();
                        off(0).max(off(1)).max(off(2))
                    })
                    .fold(f64::INFINITY, f64::min);
                found.line_depth_max_ulp = found.line_depth_max_ulp.max(depth_error);
                found.line_color_max_error = found.line_color_max_error.max(color_error);
                is_wrong = depth_error > bound || color_error > LineOutcome::COLOR_MAX_ERROR;
            }
            if is_wrong && found.line_first_wrong.is_none() {
                let width = self.size[0] as usize;
                found.line_first_wrong = Some([index % width, index / width]);
            }
        }
        found
    }
}
