//! One line, pixel by pixel along its longer axis.
//!
//! A line owns the pixels whose diamonds it leaves: the diamond-exit rule of Vulkan ("Bresenham
//! Line Segment Rasterization") and OpenGL (4.6 core profile, section 14.5.1). The diamond of a
//! pixel has the points whose distances from its centre in x and y add up to less than half a
//! pixel. Where an end lies on the border of one, both ends are moved by (-e, -e^2), for an e
//! smaller than any number. So two lines that continue each other along the same axis share no
//! pixel, and leave out none.
//!
//! Let a line be at least as wide as high. Then
//!
//! * it meets the diamonds of a column where it crosses the vertical through their centres, which
//!   lies in one of them; that tells the row: the pixel whose centre is at most half a pixel away.
//!   At exactly half a pixel, the moved line lies below the border if it falls, else above it;
//! * it crosses the verticals of all centres from its left end, inclusive, to its right end,
//!   exclusive, as both are moved to the left;
//! * if it begins in a diamond behind that pixel's centre, it owns that pixel too, and if its end
//!   lies in a diamond beyond the centre, it does not own that one.
//!
//! A line that is higher than wide is the same with the axes exchanged, and a centre half a pixel
//! away always lies to its left. So the row of a column is the boundary of an [`Edge`] whose axes
//! are exchanged, stepped exactly.
//!
//! Values are linear along the longer axis: those of a right triangle of which the line is the
//! longest side, and whose third corner has the start's. A pixel whose centre lies before the start
//! has the start's values, so that none leaves the range of the ends.

use core::ops::Range;

use super::{Layout, Primitive, Span, Triangle, Window, edge::Edge, first_center, signed_area};
use crate::{
    attribute::{DepthFormat, Interpolate},
    geometry::ScreenVertex,
    numbers::Subpixel,
};

/// A line on the screen, from its start to its end, one or more pixels wide.
///
/// A wide line repeats each pixel along the shorter axis, as in Vulkan: at 45 degrees it is thinner
/// by a factor of 0.7 than along an axis.
#[derive(Clone, Copy, Debug)]
pub struct Line<'v, S, D, V> {
    ends: [&'v ScreenVertex<S, D, V>; 2],
    width: i32,
}

impl<'v, S: Subpixel, D: DepthFormat, V: Interpolate> Line<'v, S, D, V> {
    /// One pixel wide. Returns `None` if an end is not on the screen.
    #[must_use]
    pub fn new(ends: [&'v ScreenVertex<S, D, V>; 2]) -> Option<Self> {
        let is_on_screen = ends.iter().all(|end| end.is_on_screen());
        is_on_screen.then_some(Self { ends, width: 1 })
    }

    /// Between ends that are both on the screen.
    pub(crate) const fn between(ends: [&'v ScreenVertex<S, D, V>; 2], width: u8) -> Self {
        Self { ends, width: width as i32 }
    }

    /// The same line in another width, in pixels. A line of width 0 has no pixel.
    #[must_use]
    pub const fn wide(self, width: u8) -> Self {
        Self { width: width as i32, ..self }
    }

    /// Depth and varyings along the line, or those of its start.
    pub(super) fn fields(
        &self,
        is_steep: bool,
        layout: Layout,
        is_start: bool,
    ) -> (D::Field, V::Field) {
        let [from, to] = self.ends;
        let (dx, dy) = (to.x - from.x, to.y - from.y);
        // On the end's side, so that the triangle is no larger than a square over the line.
        let aside = |along: i32, toward: i32| if toward < 0 { -along.abs() } else { along.abs() };
        let aside = if is_steep { [aside(dy, dx), 0] } else { [0, aside(dx, dy)] };
        let values = if is_start { from } else { to };
        let corner = ScreenVertex::new(to.x, to.y, values.depth, values.varyings);
        let third =
            ScreenVertex::new(from.x + aside[0], from.y + aside[1], from.depth, from.varyings);
        let corners = [from, &corner, &third];
        Triangle::with_area(corners, signed_area(corners)).fields(layout)
    }
}

impl<S: Subpixel, D: DepthFormat, V: Interpolate> Primitive for Line<'_, S, D, V> {
    type Depth = D;
    type Varyings = V;

    /// A line of no length covers no pixel.
    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<'_, D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        let ends = self.ends.map(|end| [end.x, end.y]);
        let Some(path) = Path::new::<S>(ends, self.width) else { return Ok(()) };
        let mut fields = None;
        let mut run = |is_start: bool, row: i32, columns: Range<i32>| {
            let (start, end) = (columns.start.max(window.left), columns.end.min(window.right));
            if row < window.top || row >= window.bottom || start >= end {
                return Ok(());
            }
            let (depth, varyings) = match &mut fields {
                Some((of_start, fields)) if *of_start == is_start => fields,
                _ => &mut fields.insert((is_start, self.fields(path.is_steep, layout, is_start))).1,
            };
            let address = layout.row_address(row);
            let (start, end) = (address.wrapping_add(start), address.wrapping_add(end));
            visit(&Span {
                row,
                start: start as usize,
                end: end as usize,
                depth: depth.at(start, row),
                depth_step: depth.per_column,
                varyings,
            })
        };
        if let Some([column, row]) = path.first {
            path.for_each_copy(self.width, row, column..column + 1, |row, columns| {
                run(true, row, columns)
            })?;
        }
        path.for_each_run::<S, E>(window, self.width, |row, columns| {
            path.for_each_copy(self.width, row, columns, |row, columns| run(false, row, columns))
        })
    }
}

/// The pixels of a line of one pixel in width.
#[derive(Clone, Copy, Debug)]
struct Path {
    /// Whether it is higher than wide: the axis that it runs along is y, not x.
    is_steep: bool,
    /// Start and end in sub-pixels, exchanged if the line runs backwards along the axis.
    ends: [[i32; 2]; 2],
    /// The pixels along the axis whose centres the line crosses and that it owns.
    first_pixel: i32,
    end_pixel: i32,
    /// The pixel in whose diamond it starts, if it does not cross its centre.
    first: Option<[i32; 2]>,
}

impl Path {
    /// Returns `None` for a line that owns no pixel.
    fn new<S: Subpixel>(ends: [[i32; 2]; 2], width: i32) -> Option<Self> {
        let half = 1 << (S::BITS - 1);
        let [from, to] = ends;
        let is_steep = (to[0] - from[0]).abs() < (to[1] - from[1]).abs();
        // The pixels of a wide line are repeated towards larger coordinates.
        let [from, to] = ends.map(|end| {
            let [along, aside] = turned(end, is_steep);
            turned([along, aside - (width - 1) * half], is_steep)
        });
        let along = |place: [i32; 2]| turned(place, is_steep)[0];
        let [start_pixel, last_pixel] = [from, to].map(diamond::<S>);
        if along(from) == along(to) || (start_pixel.is_some() && start_pixel == last_pixel) {
            return None;
        }
        let is_forward = along(from) < along(to);
        let ends = if is_forward { [from, to] } else { [to, from] };
        let [mut first_pixel, mut end_pixel] = ends.map(|end| first_center::<S>(along(end)));
        let crosses = |pixel: [i32; 2]| first_pixel <= along(pixel) && along(pixel) < end_pixel;
        let first = start_pixel.filter(|pixel| !crosses(*pixel));
        if last_pixel.is_some_and(crosses) {
            if is_forward {
                end_pixel -= 1;
            } else {
                first_pixel += 1;
            }
        }
        Some(Self { is_steep, ends, first_pixel, end_pixel, first })
    }

    /// Visits runs of pixels in a row whose centres the line crosses.
    fn for_each_run<S: Subpixel, E>(
        &self,
        window: &Window,
        width: i32,
        mut visit: impl FnMut(i32, Range<i32>) -> Result<(), E>,
    ) -> Result<(), E> {
        let half = 1 << (S::BITS - 1);
        let Self { is_steep, ends: [low, high], .. } = *self;
        let sides =
            if is_steep { [window.top, window.bottom] } else { [window.left, window.right] };
        let (mut pixel, end) = (self.first_pixel.max(sides[0]), self.end_pixel.min(sides[1]));
        let rows = [low[1].min(high[1]), low[1].max(high[1])].map(|y| y >> S::BITS);
        if pixel >= end || rows[0] > window.bottom || rows[1] + width < window.top - 1 {
            return Ok(());
        }
        // A falling line as its mirror image, where a centre half a pixel away is on the same side
        // as with a rising one: pixel n is -1 - n there.
        let is_mirrored = !is_steep && high[1] > low[1];
        let place = |end: [i32; 2]| {
            let [along, aside] = turned(end, is_steep);
            [if is_mirrored { -aside } else { aside } - half, along]
        };
        let mut edge =
            Edge::new::<S>(place(low), place(high), pixel, &Layout { pitch: 0, origin: 0 });
        let aside = |edge: &Edge| if is_mirrored { !edge.boundary } else { edge.boundary };
        if is_steep {
            while pixel < end {
                let column = aside(&edge);
                visit(pixel, column..column + 1)?;
                edge.step();
                pixel += 1;
            }
            return Ok(());
        }
        let (mut start, mut row) = (pixel, aside(&edge));
        loop {
            edge.step();
            pixel += 1;
            if pixel >= end {
                return visit(row, start..end);
            }
            let next = aside(&edge);
            if next != row {
                visit(row, start..pixel)?;
                (start, row) = (pixel, next);
            }
        }
    }

    /// Visits the pixels of a wide line for those of a thin one.
    fn for_each_copy<E>(
        &self,
        width: i32,
        row: i32,
        columns: Range<i32>,
        mut visit: impl FnMut(i32, Range<i32>) -> Result<(), E>,
    ) -> Result<(), E> {
        if self.is_steep {
            return visit(row, columns.start..columns.end - 1 + width);
        }
        (row..row + width).try_for_each(|row| visit(row, columns.clone()))
    }
}

/// The coordinates along a line's axis and aside from it, of x and y, or the other way round.
pub(super) const fn turned([x, y]: [i32; 2], is_steep: bool) -> [i32; 2] {
    if is_steep { [y, x] } else { [x, y] }
}

/// The pixel in whose diamond a place lies, moved by (-e, -e^2).
fn diamond<S: Subpixel>(place: [i32; 2]) -> Option<[i32; 2]> {
    let half = 1 << (S::BITS - 1);
    // On the border between two pixels, that with the lesser number.
    let pixel = place.map(|c| (c - 1) >> S::BITS);
    let from_center = |place: i32, pixel: i32| place - (pixel << S::BITS) - half;
    let (x, y) = (from_center(place[0], pixel[0]), from_center(place[1], pixel[1]));
    // On the border of a diamond, its right half: those points are moved inwards.
    (x.abs() + y.abs() < half + i32::from(x > 0)).then_some(pixel)
}
