//! Lines and points of a model against their definitions: which pixels they own, their depth and
//! their colour, where surfaces hide them and where they don't.
//!
//! Each table of lines or points is drawn by the core over what is there. Its ends, clipped or not,
//! are judged against the exact ones ([`LineEnds`](super::line_ends::LineEnds)). The reference then
//! gets them as the core places them, and decides for each pixel which of the lines own it, how
//! deep they are there and which colours they have.

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
    /// Lines and points that are in the view, but that the core leaves out.
    pub lines_missing: usize,
    /// Lines and points that are not in the view, but that the core draws.
    pub lines_extra: usize,
    /// The ends that are compared with exact ones: two of a line, one of a point.
    pub line_ends: usize,
    /// Those where a plane cuts a line.
    pub line_ends_cut: usize,
    /// The largest error of a place, in x or y in pixels, as a part of its bound.
    pub line_end_place: Option<LineEndError>,
    /// The same of a depth, in units of 2^-32.
    pub line_end_depth: Option<LineEndError>,
    /// The same of a colour channel, in 8-bit steps, if vertices have colours.
    pub line_end_color: Option<LineEndError>,
}

/// How far an end of a line, or a point, is off where it belongs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct LineEndError {
    /// The vertices of the line in the tables; that of a point twice.
    pub vertices: [usize; 2],
    /// How far it is off.
    pub error: f64,
    /// How far it may be.
    pub bound: f64,
}

impl LineEndError {
    /// Whether it keeps its bound.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.error <= self.bound
    }
}

/// The error that is the larger part of its bound.
pub(super) fn worse(
    one: Option<LineEndError>,
    other: Option<LineEndError>,
) -> Option<LineEndError> {
    let (Some(a), Some(b)) = (one, other) else { return one.or(other) };
    if b.error * a.bound > a.error * b.bound { other } else { one }
}

impl LineOutcome {
    /// How far depth may be off, in units of 2^-32: a unit for rounding, as of triangles.
    pub const DEPTH_MAX_ULP: f64 = 1.0;
    /// How far a channel may be off, in 8-bit steps: rounding on both sides, as of triangles.
    pub const COLOR_MAX_ERROR: f64 = 1.0;

    /// Whether no pixel is wrong, no line is missing or there without belonging there, and ends,
    /// depth and colours keep their bounds.
    #[must_use]
    pub fn is_within(&self) -> bool {
        let ends = [self.line_end_place, self.line_end_depth, self.line_end_color];
        self.line_coverage_mismatches + self.lines_missing + self.lines_extra == 0
            && ends.iter().flatten().all(LineEndError::is_within)
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
            lines_missing: self.lines_missing + other.lines_missing,
            lines_extra: self.lines_extra + other.lines_extra,
            line_ends: self.line_ends + other.line_ends,
            line_ends_cut: self.line_ends_cut + other.line_ends_cut,
            line_end_place: worse(self.line_end_place, other.line_end_place),
            line_end_depth: worse(self.line_end_depth, other.line_end_depth),
            line_end_color: worse(self.line_end_color, other.line_end_color),
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

/// A vertex as the core places it: the place on the screen in sub-pixels, its depth in units of
/// 2^-32 and its colour.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) place: [i64; 2],
    pub(super) depth: f64,
    pub(super) color: [f64; 3],
}

impl End {
    /// Of a vertex that is on the screen.
    pub(super) fn of<S: Subpixel, V: rasterizer::attribute::Interpolate>(
        vertex: &ScreenVertex<S, u32, V>,
        color: [f64; 3],
    ) -> Option<Self> {
        let place = vertex.position()?.map(i64::from);
        Some(Self { place, depth: vertex.depth().into(), color })
    }
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

    /// Adds a line between two ends.
    pub(super) fn add_line(&mut self, [from, to]: [End; 2]) {
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

    /// Adds a point.
    pub(super) fn add_point(&mut self, End { place, depth, color }: End) {
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
