//! Antialiased lines of an object.

use core::marker::PhantomData;

use fixed::types::U8F8;

use super::{Mode, ProjectedLines, Vertices};
use crate::{
    color::Alpha,
    geometry::Projection,
    output::{Blending, KeepDepth, Over, Target},
    raster::{Fragment, SmoothLine},
    shade::{OnScreen, Outcome, Shader},
    texture::Layer,
};

/// Antialiased lines: what [`ProjectedLines::smooth`] makes.
///
/// The coverage of a pixel by a [`SmoothLine`] is the alpha by which the line's colour is blended
/// with the stored one, by default [`Over`] it. Pixels are tested against depth, and leave it.
/// Where lines cross or join, each is blended with what those before it left: where two cover the
/// parts a and b of a pixel, 1 - (1 - a)(1 - b) of it shows their colour. At a joint, where a and b
/// add up to 1, that is 3/4 or more.
#[derive(Clone, Copy, Debug)]
pub struct SmoothLines<'p, 'a, V, P: Projection, Sh: Shader, M, B = KeepDepth<Over>> {
    lines: ProjectedLines<'p, 'a, V, P, Sh, M>,
    width: U8F8,
    blending: B,
}

impl<'p, 'a, V, P: Projection, Sh: Shader, M> ProjectedLines<'p, 'a, V, P, Sh, M> {
    /// The same lines antialiased by coverage, in a width in pixels across the line, on a target
    /// whose pixels can be read.
    #[must_use]
    pub const fn smooth(self, width: U8F8) -> SmoothLines<'p, 'a, V, P, Sh, M> {
        SmoothLines { lines: self, width, blending: KeepDepth(Over(Alpha::OPAQUE)) }
    }
}

impl<'p, 'a, V, P: Projection, Sh: Shader, M, B> SmoothLines<'p, 'a, V, P, Sh, M, B> {
    /// The same lines in another blending mode: `KeepDepth(Add(..))` for lines of light, or
    /// [`Over`] an alpha.
    ///
    /// [`Replace`](crate::output::Replace) draws the pixels that are covered by half.
    #[must_use]
    pub fn blended<C>(self, blending: C) -> SmoothLines<'p, 'a, V, P, Sh, M, C> {
        SmoothLines { lines: self.lines, width: self.width, blending }
    }
}

impl<V, P, Sh, M, B> SmoothLines<'_, '_, V, P, Sh, M, B>
where
    V: Vertices<OnScreen<Sh>>,
    P: Projection,
    Sh: Shader,
    M: Mode,
{
    /// Draws all lines in one colour.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no line after it.
    pub fn fill<T>(&self, color: Sh::Color, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        B: Blending<T>,
    {
        let lines = &self.lines;
        let window = target.window().intersection(&lines.seen.viewport);
        let blending = self.blending.of_material(&lines.style.mesh_material(lines.seen.tables()));
        lines.for_each_on_screen(|ends| {
            let ends = ends.map(|end| end.bare());
            let line = SmoothLine::between(ends.each_ref(), self.width);
            blending.shade(target, &line, &window, move |fragment| {
                let (_, [coverage]) = fragment.varyings;
                Layer::new(color, alpha(coverage.to_bits()))
            })
        })
    }

    /// Draws all lines in the colours of the object's shader, as
    /// [`ProjectedLines::draw`] does.
    ///
    /// # Errors
    ///
    /// Returns the target's first error, and draws no line after it.
    pub fn draw<T>(&self, target: &mut T) -> Result<(), T::Error>
    where
        T: Target<Color = Sh::Color, Depth = V::Depth>,
        B: Blending<T>,
        Sh: Shader<Face = ()>,
    {
        let lines = &self.lines;
        let (seen, style) = (lines.seen, lines.style);
        let window = target.window().intersection(&seen.viewport);
        let blending = self.blending.of_material(&style.mesh_material(seen.tables()));
        let mut surface = None;
        seen.prepare(style.material(seen.tables()), &mut surface);
        let Some(surface) = &surface else { return Ok(()) };
        lines.for_each_on_screen(|ends| {
            let line = SmoothLine::between(ends.each_ref(), self.width);
            blending.shade(target, &line, &window, |fragment| {
                let Fragment { varyings: (varyings, [coverage]), depth, column, row } = fragment;
                let fragment = Fragment { varyings, depth, column, row };
                Covered {
                    outcome: seen.shader.pixel(surface, &(), fragment),
                    coverage: alpha(coverage.to_bits()),
                    color: PhantomData,
                }
            })
        })
    }
}

/// The alpha of a coverage that arrives with 16 bits behind the point.
#[inline(always)]
const fn alpha(coverage: u32) -> Alpha {
    Alpha::from_bits((coverage >> 16) as u16)
}

/// An outcome for the covered part of a pixel. That it names its colour tells it from a colour.
struct Covered<C, O> {
    outcome: O,
    coverage: Alpha,
    color: PhantomData<C>,
}

impl<C, O: Outcome<C>> Outcome<C> for Covered<C, O> {
    const DISCARDS: bool = true;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;
    const HAS_ALPHA: bool = true;

    #[inline(always)]
    fn color(self) -> Option<C> {
        if self.coverage.is_half() { self.outcome.color() } else { None }
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        self.outcome.layer().map(|(color, alpha)| (color, alpha.scaled(self.coverage)))
    }
}
