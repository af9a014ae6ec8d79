//! Fog over the shaders of a view, and the definition that judges it.
//!
//! The core computes fog at the pixels or at the vertices by a type. Here one type does both, so
//! that each shader is compiled for it once: see [`super::any_mode`].

use std::cell::Cell;

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    attribute::{FloatDepth, Interpolate},
    camera::Distance,
    color::Alpha,
    shade::{self, AtPixels, AtVertices, Density, FogMode, SeenFog},
};

use super::{display::rgb888, places::FaceColors};
use crate::reference::{self, Picture, ScreenTriangle, ScreenVertex, draw_screen, fogged};

/// Where fog is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FogBy {
    /// At the vertices, and interpolated.
    Vertex,
    /// At every pixel.
    #[default]
    Pixel,
}

impl FogBy {
    /// Both, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 2] = [("vertex", Self::Vertex), ("pixel", Self::Pixel)];
}

/// Fog in a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fog {
    /// How much there is at a distance, in model units.
    pub law: reference::Fog,
    /// Where it is computed.
    pub by: FogBy,
    /// Its colour.
    pub color: [u8; 3],
}

/// What a density is rounded to.
const DENSITY: f64 = 16_777_216.0;

impl Fog {
    /// None at any distance.
    pub(super) const NONE: Self =
        Self { law: reference::Fog::Exponential { density: 0.0 }, by: FogBy::Pixel, color: [0; 3] };

    /// With numbers that the core has.
    pub(super) fn rounded(self) -> Self {
        let law = match self.law {
            reference::Fog::Linear { start, end } => {
                let [start, end] = [start, end].map(|d| (d * 65_536.0).round() / 65_536.0);
                reference::Fog::Linear { start, end }
            }
            reference::Fog::Exponential { density } => {
                reference::Fog::Exponential { density: (density * DENSITY).round() / DENSITY }
            }
        };
        Self { law, ..self }
    }

    /// The core's fog; `None` if it doesn't end beyond its start.
    pub(super) fn core(&self) -> Option<shade::Fog> {
        match self.law {
            reference::Fog::Linear { start, end } => {
                let [start, end] = [start, end].map(Distance::saturating_from_num);
                shade::Fog::linear(start, end)
            }
            reference::Fog::Exponential { density } => {
                Some(shade::Fog::exponential(Density::saturating_from_num(density)))
            }
        }
    }

    pub(super) const fn core_color(&self) -> Rgb888 {
        rgb888(self.color)
    }

    fn reference_color(&self) -> [f64; 3] {
        self.color.map(f64::from)
    }

    /// How far the core's amount may be off. Half a step of 256; the table's bound; and a digit of
    /// 1 / w, of which it has 11, times how fast the amount changes with its logarithm.
    fn slack(&self) -> f64 {
        let slope = match self.law {
            reference::Fog::Linear { start, end } => end / (end - start),
            // y e^-y is e^-1 at most.
            reference::Fog::Exponential { .. } => (-1f64).exp(),
        };
        1.0 / 512.0 + f64::max(1.0 / 512.0, slope / 1_024.0) + slope / 2_048.0
    }

    /// The colours that a face may have in fog, from those without and the distances between which
    /// it lies.
    pub(super) fn colors(&self, colors: FaceColors, distances: [f64; 2]) -> FaceColors {
        let [darkest, lightest] = colors.levels;
        let [least, most] = colors.range;
        let fog = self.reference_color();
        let amounts = distances.map(|distance| self.law.amount(distance));
        let mixes = |of: [f64; 3]| amounts.map(|amount| fogged(of, fog, amount));
        let low = mixes(least.map(|channel| channel * darkest.max(0.0)));
        let high = mixes(most.map(|channel| channel * lightest));
        let slack = 255.0 * self.slack();
        FaceColors {
            range: [
                [0, 1, 2].map(|i| (low[0][i].min(low[1][i]) - slack).max(0.0)),
                [0, 1, 2].map(|i| (high[0][i].max(high[1][i]) + slack).min(255.0)),
            ],
            levels: [1.0, 1.0],
        }
    }

    /// A picture of the file's faces in this fog, by the distance of each pixel. `distance` is that
    /// of a depth.
    pub(super) fn over(&self, bare: &Picture, distance: impl Fn(f64) -> f64) -> Picture {
        let fog = self.reference_color();
        bare.recolored(|_, fragment| {
            let amount = self.law.amount(distance(fragment.depth));
            Some(fogged(fragment.color, fog, amount))
        })
    }
}

thread_local! {
    /// Where the fog of this thread's pictures is computed.
    static CHOSEN: Cell<FogBy> = const { Cell::new(FogBy::Pixel) };
}

/// Draws with fog that is computed in this way.
pub(super) fn with<T>(by: FogBy, draw: impl FnOnce() -> T) -> T {
    let before = CHOSEN.replace(by);
    let drawn = draw();
    CHOSEN.set(before);
    drawn
}

/// The mode that [`with`] chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct AnyFog;

impl FogMode for AnyFog {
    type Varying<'f> = (<AtPixels as FogMode>::Varying<'f>, <AtVertices as FogMode>::Varying<'f>);
    type OnScreen = (FloatDepth, u16);

    fn varying<'f>(seen: &SeenFog<'f>) -> Self::Varying<'f> {
        (AtPixels::varying(seen), AtVertices::varying(seen))
    }

    fn at_pixel(
        (inverse_w, amount): <Self::OnScreen as Interpolate>::Sample,
        seen: &SeenFog<'_>,
    ) -> Alpha {
        match CHOSEN.get() {
            FogBy::Pixel => AtPixels::at_pixel(inverse_w, seen),
            FogBy::Vertex => AtVertices::at_pixel(amount, seen),
        }
    }

    fn at_vertex((inverse_w, amount): Self::OnScreen, seen: &SeenFog<'_>) -> Alpha {
        match CHOSEN.get() {
            FogBy::Pixel => AtPixels::at_vertex(inverse_w, seen),
            FogBy::Vertex => AtVertices::at_vertex(amount, seen),
        }
    }
}

/// Triangles with 1 / w as varying: `inverses` has that of each corner.
pub(super) fn triangles<const N: usize>(
    triangles: &[ScreenTriangle<N>],
    inverses: &[f64],
) -> Vec<ScreenTriangle<1>> {
    let (inverses, _) = inverses.as_chunks::<3>();
    let of = |(triangle, inverses): (&ScreenTriangle<N>, &[f64; 3])| {
        let corner = |i: usize| {
            let ScreenVertex { x, y, depth, .. } = triangle.vertices[i];
            ScreenVertex { x, y, depth, varyings: [inverses[i]] }
        };
        ScreenTriangle { vertices: [0, 1, 2].map(corner), number: triangle.number }
    };
    triangles.iter().zip(inverses).map(of).collect()
}

/// Fog as the reference sees it on the core's own vertices.
pub(super) struct SeenPicture {
    fog: Fog,
    /// The amount of each fragment.
    amounts: Picture<f64>,
}

impl SeenPicture {
    /// Of triangles with 1 / w as varying.
    pub(super) fn new(fog: Fog, triangles: &[ScreenTriangle<1>], size: (usize, usize)) -> Self {
        let amount = |inverse_w: f64| fog.law.amount(1.0 / inverse_w);
        let amounts = match fog.by {
            FogBy::Pixel => draw_screen(triangles, size, |s| Some(amount(s.varyings[0]))),
            FogBy::Vertex => {
                let mut triangles = triangles.to_vec();
                for vertex in triangles.iter_mut().flat_map(|triangle| &mut triangle.vertices) {
                    vertex.varyings = vertex.varyings.map(amount);
                }
                draw_screen(&triangles, size, |sample| Some(sample.varyings[0]))
            }
        };
        Self { fog, amounts }
    }

    fn amount<C>(&self, [x, y]: [usize; 2], of: &reference::Fragment<C>) -> f64 {
        let all = self.amounts.fragments(x, y);
        let same = |other: &&reference::Fragment<f64>| {
            (other.triangle, other.depth) == (of.triangle, of.depth)
        };
        all.iter().find(same).map_or(0.0, |fragment| fragment.color)
    }

    /// The colour that a fragment has without fog, if it is drawn in this one.
    pub(super) fn bare<C>(
        &self,
        pixel: [usize; 2],
        of: &reference::Fragment<C>,
        drawn: [f64; 3],
    ) -> [f64; 3] {
        let fog = self.fog.reference_color();
        let left = (1.0 - self.amount(pixel, of)).max(1.0 / 255.0);
        [0, 1, 2].map(|i| (fog[i] + (drawn[i] - fog[i]) / left).clamp(0.0, 255.0))
    }

    /// The picture in fog. Of the colours that a fragment may have for what the amount may be off,
    /// it has the one that is nearest to the drawn colour.
    pub(super) fn over(&self, bare: &Picture, drawn: impl Fn([usize; 2]) -> [f64; 3]) -> Picture {
        /// Amounts that are tried.
        const STEPS: i32 = 8;
        let (fog, slack) = (self.fog.reference_color(), self.fog.slack());
        bare.recolored(|pixel, fragment| {
            let (exact, drawn) = (self.amount(pixel, fragment), drawn(pixel));
            let error = |color: &[f64; 3]| {
                [0, 1, 2].map(|i| (color[i] - drawn[i]).abs()).into_iter().fold(0.0, f64::max)
            };
            (-STEPS..=STEPS)
                .map(|step| exact + slack * f64::from(step) / f64::from(STEPS))
                .map(|amount| fogged(fragment.color, fog, amount.clamp(0.0, 1.0)))
                .min_by(|a, b| error(a).total_cmp(&error(b)))
        })
    }
}

/// 1 / w in world units, as the core has it at a vertex: 2^k / w by the format's definition, where
/// 2^k is the near distance rounded down.
pub(super) fn inverse_w((stored, _): (FloatDepth, u16), near: f64) -> f64 {
    let (exponent, mantissa) = (stored.to_bits() >> 11, f64::from(stored.to_bits() & 2_047));
    let value = if exponent == 0 {
        mantissa / 2f64.powi(42)
    } else {
        (1.0 + mantissa / 2_048.0) * 2f64.powi(i32::from(exponent) - 32)
    };
    value / 2f64.powf(near.log2().floor())
}
