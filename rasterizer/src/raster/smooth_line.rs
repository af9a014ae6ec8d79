//! One antialiased line, pixel by pixel along its longer axis.
//!
//! An antialiased line is a parallelogram about the segment between its ends: two sides run along
//! it, `width` apart, and its ends are cut along the shorter axis. The coverage of a pixel is the
//! area of the parallelogram in it, from 0 to 1: antialiasing by a box filter, like that of
//! Vulkan's smooth rectangular lines.
//!
//! Let a line be at least as wide as high, with a slope m, and let a column of pixels have the part
//! f of its width between the line's ends. In this part a side of the line rises by r = f |m|, at
//! most 1. Of a pixel there, as a function of how far its centre lies above the side's middle, the
//! area beyond the side is
//!
//! ```text
//!   t <= -(1 + r) / 2                  0
//!   -(1 + r) / 2 < t < -(1 - r) / 2    (t + (1 + r) / 2)^2 / 2 r    a triangle
//!   |t| <= (1 - r) / 2                 1/2 + t                      a trapezium
//! ```
//!
//! and 1 minus the same for -t. The coverage is f times the difference for both sides. A steep line
//! is the same with the axes exchanged.
//!
//! Positions along the shorter axis are exact to 2^-16 pixels: the slope has 32 bits behind the
//! point, and is stepped over less than 2^11 pixels. The area beyond a side changes by at most 1 a
//! pixel, so that a coverage is within 2^-12 of the exact one before it is rounded to 256ths.

use fixed::types::U8F8;

use super::{Layout, Line, Primitive, Span, Window, line::turned};
use crate::{
    attribute::{DepthFormat, Interpolate, Plane},
    geometry::ScreenVertex,
    numbers::{Divisor, Subpixel, divide, inverse_square_root},
};

/// An antialiased line on the screen. It visits the pixels that it covers in part or wholly.
///
/// Its varyings are those of its ends, and with them the coverage of the pixel in steps of 1/256, 1
/// to 256: an alpha. Depth and varyings are linear along the longer axis, as with [`Line`].
#[derive(Clone, Copy, Debug)]
pub struct SmoothLine<'v, S, D, V> {
    ends: [&'v ScreenVertex<S, D, V>; 2],
    width: U8F8,
}

impl<'v, S: Subpixel, D: DepthFormat, V: Interpolate> SmoothLine<'v, S, D, V> {
    /// Between two ends, of a width in pixels, across the line. Returns `None` if an end is
    /// not on the screen.
    #[must_use]
    pub fn new(ends: [&'v ScreenVertex<S, D, V>; 2], width: U8F8) -> Option<Self> {
        let is_on_screen = ends.iter().all(|end| end.is_on_screen());
        is_on_screen.then_some(Self { ends, width })
    }

    /// Between ends that are both on the screen.
    pub(crate) const fn between(ends: [&'v ScreenVertex<S, D, V>; 2], width: U8F8) -> Self {
        Self { ends, width }
    }

    /// Depth and varyings for pixels whose centres lie before the start, after the end, or between.
    fn fields(&self, is_steep: bool, layout: Layout, part: Part) -> (D::Field, V::Field) {
        let [from, to] = self.ends;
        match part {
            Part::Before => Line::between([from, to], 1).fields(is_steep, layout, true),
            Part::Between => Line::between([from, to], 1).fields(is_steep, layout, false),
            Part::After => Line::between([to, from], 1).fields(is_steep, layout, true),
        }
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Primitive for SmoothLine<'_, S, D, V> {
    type Depth = D;
    type Varyings = (V, [u16; 1]);

    /// A line of no length covers no pixel.
    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<'_, D, Self::Varyings>) -> Result<(), E>,
    ) -> Result<(), E> {
        let ends = self.ends.map(|end| [end.x, end.y]);
        let Some(strip) = Strip::new::<S>(ends, self.width) else { return Ok(()) };
        let is_steep = strip.is_steep;
        let mut fields = None;
        strip.for_each_pixel::<S, E>(window, |[column, row], part, coverage| {
            let (depth, varyings) = match &mut fields {
                Some((of_part, fields)) if *of_part == part => fields,
                _ => {
                    let (depth, varyings) = self.fields(is_steep, layout, part);
                    let coverage = Plane { anchor: [0], per_column: [0], per_row: [0] };
                    &mut fields.insert((part, (depth, (varyings, coverage)))).1
                }
            };
            varyings.1.anchor = [coverage << 16];
            let start = layout.row_address(row).wrapping_add(column);
            visit(&Span {
                row,
                start: start as usize,
                end: start.wrapping_add(1) as usize,
                depth: depth.at(start, row),
                depth_step: depth.per_column,
                varyings,
            })
        })
    }
}

/// Where the centre of a pixel lies along a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Before,
    Between,
    After,
}

/// The sides of a line.
#[derive(Clone, Copy, Debug)]
struct Strip {
    /// Whether it is higher than wide: the axis that it runs along is y, not x.
    is_steep: bool,
    /// Whether it runs towards larger coordinates along this axis.
    is_forward: bool,
    /// Its ends along the axis, the lower one first, in sub-pixels.
    ends: [i32; 2],
    /// The pixel aside of the lower end, from which the numbers aside count.
    base: i32,
    /// Where the lower end lies aside, in Q32.
    start: i64,
    /// What the line rises aside from a pixel to the next along the axis, in Q32.
    slope: i64,
    /// Half of its extent aside, in Q16.
    half: i32,
}

impl Strip {
    /// Returns `None` for a line of no length.
    fn new<S: Subpixel>([from, to]: [[i32; 2]; 2], width: U8F8) -> Option<Self> {
        let is_steep = (to[0] - from[0]).abs() < (to[1] - from[1]).abs();
        let [from, to] = [from, to].map(|end| turned(end, is_steep));
        let is_forward = from[0] < to[0];
        let [low, high] = if is_forward { [from, to] } else { [to, from] };
        let (along, aside) = (high[0] - low[0], high[1] - low[1]);
        if along == 0 {
            return None;
        }
        let slope = Divisor::new(along as u64).divide(i64::from(aside) << 32).0;
        // The square of the secant of the line's angle in Q60, from 1 to 2: two leading zeros,
        // which make the exponent -61.
        let tangent = slope.unsigned_abs() >> 2;
        let square = (1 << 60) + tangent * tangent;
        let (mantissa, _) = inverse_square_root(square);
        let secant = ((square >> 30) * u64::from(mantissa)) >> 31;
        let base = low[1] >> S::BITS;
        Some(Self {
            is_steep,
            is_forward,
            ends: [low[0], high[0]],
            base,
            start: i64::from(low[1] - (base << S::BITS)) << (32 - S::BITS),
            slope,
            half: ((u64::from(width.to_bits()) * secant) >> 23) as i32,
        })
    }

    /// Visits the pixels of a window that it covers, with their coverage, 1 to 256.
    fn for_each_pixel<S: Subpixel, E>(
        &self,
        window: &Window,
        mut visit: impl FnMut([i32; 2], Part, u32) -> Result<(), E>,
    ) -> Result<(), E> {
        let Self { ends: [low, high], slope, .. } = *self;
        let (mut sides, mut rows) =
            ([window.left, window.right], [window.top, window.bottom].map(|row| row - self.base));
        if self.is_steep {
            let columns = sides.map(|column| column - self.base);
            (sides, rows) = ([window.top, window.bottom], columns);
        }
        let pixel = 1 << S::BITS;
        let (first, end) =
            ((low >> S::BITS).max(sides[0]), (((high - 1) >> S::BITS) + 1).min(sides[1]));
        if first >= end {
            return Ok(());
        }
        // From the lower end to the middle of the first pixel, in halves of a sub-pixel.
        let to_middle = |place: i32| 2 * (place - low) + pixel;
        let mut middle =
            self.start + ((slope * i64::from(to_middle(first << S::BITS))) >> (S::BITS + 1));
        let whole = Column::rising((slope.unsigned_abs() >> 16) as u32);
        for along in first..end {
            let place = along << S::BITS;
            let (from, to) = (place.max(low), (place + pixel).min(high));
            let (part, at, column) = if to - from == pixel {
                (pixel as u32, middle, whole)
            } else {
                let away = (from - place) + (to - place) - pixel;
                let part = (to - from) as u32;
                let rise = ((slope.unsigned_abs() * u64::from(part)) >> (16 + S::BITS)) as u32;
                let at = middle + ((slope * i64::from(away)) >> (S::BITS + 1));
                (part, at, Column::rising(rise))
            };
            let center = place + pixel / 2;
            let of_ends = if center < low {
                if self.is_forward { Part::Before } else { Part::After }
            } else if center > high {
                if self.is_forward { Part::After } else { Part::Before }
            } else {
                Part::Between
            };
            let at = (at >> 16) as i32;
            let reach = self.half + (column.rise / 2) as i32;
            let rows = ((at - reach) >> 16).max(rows[0])..(((at + reach) >> 16) + 1).min(rows[1]);
            for row in rows {
                let above = (row << 16) + (ONE / 2) as i32 - at;
                let covered = column.beyond(above + self.half) - column.beyond(above - self.half);
                let coverage = (((covered * part) >> S::BITS) + 128) >> 8;
                if coverage > 0 {
                    let place = turned([along, row + self.base], self.is_steep);
                    visit(place, of_ends, coverage)?;
                }
            }
            middle += slope;
        }
        Ok(())
    }
}

/// 1 in Q16.
const ONE: u32 = 1 << 16;

/// A column of pixels, or the part of it between the ends of a line.
#[derive(Clone, Copy, Debug)]
struct Column {
    /// How far a side rises in it, in Q16: at most 1.
    rise: u32,
    /// 2^31 / `rise`.
    inverse: u32,
}

impl Column {
    const fn rising(rise: u32) -> Self {
        let inverse = if rise == 0 { 0 } else { divide(1 << 31, rise) };
        Self { rise, inverse }
    }

    /// The area in Q16 that lies beyond a side, of a pixel whose centre lies `t` beyond the side's
    /// middle, in Q16.
    const fn beyond(self, t: i32) -> u32 {
        let away = t.unsigned_abs();
        // How far the side reaches into the pixel, from the corner that it meets last.
        let reach = ((ONE + self.rise) / 2).saturating_sub(away);
        let lesser = if reach >= self.rise {
            (ONE / 2).saturating_sub(away)
        } else {
            // Products are below 2^31 and 2^32.
            (reach * ((reach * self.inverse) >> 15)) >> 17
        };
        if t < 0 { lesser } else { ONE - lesser }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{attribute::NoDepth, numbers::S8};

    #[test]
    fn a_window_far_away_has_no_pixel() {
        let vertex =
            |x, y| ScreenVertex::<S8, NoDepth, [u16; 0]>::checked(x, y, NoDepth, []).unwrap();
        for end in [[5000, 300], [300, 5000], [-5000, 300]] {
            let (from, to) = (vertex(0, 0), vertex(end[0], end[1]));
            let line = SmoothLine::new([&from, &to], U8F8::ONE).unwrap();
            for far in [-1 << 29, (1 << 29) - 8] {
                for [left, top] in [[far, 0], [0, far], [far, far]] {
                    let window = Window { left, top, right: left + 8, bottom: top + 8 };
                    let layout = Layout { pitch: 0, origin: 0 };
                    assert_eq!(line.for_each_span(&window, layout, |_| Err(())), Ok(()));
                }
            }
        }
    }
}
