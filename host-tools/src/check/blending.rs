//! A model blended with itself and a background, judged layer by layer.
//!
//! The core draws all layers of each pixel from back to front, without storing depth. A recorder in
//! the place of the blending mode keeps each layer's colour and alpha, and blends by the same
//! function of [`Composite`] as the mode does. Four things are compared:
//!
//! * **layers**: each pixel has those that the reference has there, in the order of the triangles;
//! * **alphas of layers**: the product of those of the vertices, the texel, the material and the
//!   view;
//! * **colours of layers**, also of those that a depth test would hide, with the reference's, for
//!   shaders whose arithmetic has one right colour;
//! * **the blended colour** with the same layers blended in f64: what rounding each layer to 8 bits
//!   leaves.

use std::cell::RefCell;

use embedded_graphics_core::{
    geometry::Point,
    pixelcolor::{Rgb888, RgbColor},
    primitives::PointsIter as _,
};
use rasterizer::{
    color::{Alpha, Composite},
    mesh::MeshMaterial,
    output::{Blending as CoreBlending, Factor as _, MaterialOpacity, Readable},
    raster::{FragmentOf, Primitive, Window},
    shade::Outcome,
};

use super::{
    alphas::{AlphaBound, AlphaError, Factors},
    display::rgb888,
    fixed::{ShownColor, TexelAlphas},
    view::View,
};
use crate::{
    model::Model,
    reference::{Blend, Fragment, Layer, Picture},
};

/// A background for pictures: a grey-blue dark enough for light models and light enough for
/// shadows.
pub const BACKGROUND: [u8; 3] = [0x28, 0x32, 0x40];

/// How pixels are put onto the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Blending {
    /// They replace what is there.
    #[default]
    Replace,
    /// From back to front, without testing depth. With [`Blend::Replace`] that is the painter's
    /// algorithm.
    By(Blend),
}

impl Blending {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 6] = [
        ("replace", Self::Replace),
        ("over", Self::By(Blend::Over)),
        ("add", Self::By(Blend::Add)),
        ("multiply", Self::By(Blend::Multiply)),
        ("screen", Self::By(Blend::Screen)),
        ("painter", Self::By(Blend::Replace)),
    ];
}

/// An alpha of the core for an opacity from 0 to 1, rounded to its unit.
pub(super) fn alpha(opacity: f64) -> Alpha {
    Alpha::from_bits((opacity * 256.0).round() as u16)
}

/// A layer of a pixel as the core draws it; `None` if it is invisible.
type Drawn = (Point, Option<(Rgb888, Alpha)>);

/// A blending mode of the core, chosen at run time, that keeps the layers that it is given.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recorder<'r> {
    pub(super) blend: Blend,
    pub(super) factor: MaterialOpacity,
    pub(super) layers: &'r RefCell<Vec<Drawn>>,
}

impl Recorder<'_> {
    fn put(&self, at: Point, stored: Rgb888, (new, alpha): (Rgb888, Alpha)) -> Rgb888 {
        let alpha = alpha.scaled(self.factor.alpha());
        self.layers.borrow_mut().push((at, Some((new, alpha))));
        put(self.blend, stored, (new, alpha))
    }
}

/// A colour over another one, by the core.
fn put(blend: Blend, stored: Rgb888, (new, alpha): (Rgb888, Alpha)) -> Rgb888 {
    match blend {
        Blend::Over => new.over(stored, alpha),
        Blend::Add => Composite::add(new, stored, alpha),
        Blend::Multiply => new.multiply(stored, alpha),
        Blend::Screen => new.screen(stored, alpha),
        Blend::Replace => new,
    }
}

impl<T: Readable<Color: ShownColor>> CoreBlending<T> for Recorder<'_> {
    fn of_material(self, material: &MeshMaterial<'_>) -> Self {
        Self { factor: self.factor.of_material(material), ..self }
    }

    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        self,
        target: &mut T,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), T::Error> {
        target.blend(primitive, window, move |stored, fragment| {
            let at = Point::new(fragment.column, fragment.row);
            Recorded { recorder: self, at, stored, new: pixel(fragment) }
        })
    }
}

struct Recorded<'r, C, O> {
    recorder: Recorder<'r>,
    at: Point,
    stored: C,
    new: O,
}

impl<C: ShownColor, O: Outcome<C>> Outcome<C> for Recorded<'_, C, O> {
    const DISCARDS: bool = O::DISCARDS;
    const WRITES_DEPTH: bool = O::WRITES_DEPTH;

    fn color(self) -> Option<C> {
        // What replaces tests the alpha.
        let layer = match self.recorder.blend {
            Blend::Replace => self.new.color().map(|new| (new, Alpha::OPAQUE)),
            _ => self.new.layer(),
        };
        let Some((new, alpha)) = layer else {
            self.recorder.layers.borrow_mut().push((self.at, None));
            return None;
        };
        Some(self.recorder.put(self.at, self.stored.into(), (new.into(), alpha)).into())
    }
}

/// A model that the core has blended.
#[derive(Clone, Debug)]
pub(super) struct Layers {
    blend: Blend,
    background: [u8; 3],
    /// The blended colours, row by row.
    pub(super) colors: Vec<[u8; 3]>,
    /// The layers of each pixel in the order in which they were drawn, also those that are
    /// invisible.
    layers: Vec<Vec<Option<Layer>>>,
    /// The place of each triangle of the tables in the order from back to front.
    ranks: Vec<usize>,
    /// The interpolated alpha of the vertices of each fragment.
    alphas: Picture<f64>,
    /// The alpha of the material of each triangle of the tables.
    materials: Vec<f64>,
    opacity: f64,
}

impl Layers {
    /// What was drawn of a view, the order of the triangles, and the alphas of vertices.
    pub(super) fn new(
        (model, view, blend): (&Model, &View, Blend),
        colors: &[Rgb888],
        drawn: &[Drawn],
        order: &[usize],
        alphas: Picture<f64>,
    ) -> Self {
        let area = view.area();
        let channels = |color: Rgb888| [color.r(), color.g(), color.b()];
        let mut layers = vec![Vec::new(); area.points().count()];
        for &(at, layer) in drawn {
            let from_corner = at - area.top_left;
            let index = from_corner.y as usize * area.size.width as usize + from_corner.x as usize;
            layers[index].push(layer.map(|(color, alpha)| Layer {
                color: channels(color).map(f64::from),
                alpha: f64::from(alpha.to_bits()) / 256.0,
            }));
        }
        let materials: Vec<f64> = (model.materials.iter().enumerate())
            .flat_map(|(number, material)| {
                let opacity = model.finishes.get(number).map_or(u8::MAX, |finish| finish.opacity);
                std::iter::repeat_n(f64::from(opacity) / 255.0, material.triangle_count as usize)
            })
            .collect();
        let mut ranks = vec![usize::MAX; materials.len()];
        for (rank, &triangle) in order.iter().enumerate() {
            ranks[triangle] = rank;
        }
        Self {
            blend,
            background: view.background,
            colors: colors.iter().copied().map(channels).collect(),
            layers,
            ranks,
            alphas,
            materials,
            opacity: view.opacity,
        }
    }

    /// The colours of the same layers over a picture, row by row.
    pub(super) fn over(&self, under: &[[u8; 3]]) -> Vec<[u8; 3]> {
        let blended = |(layers, &stored): (&Vec<Option<Layer>>, &[u8; 3])| {
            let last = layers.iter().flatten().fold(rgb888(stored), |stored, layer| {
                // Both are whole numbers of their units.
                let new = rgb888(layer.color.map(|channel| channel as u8));
                put(self.blend, stored, (new, alpha(layer.alpha)))
            });
            [last.r(), last.g(), last.b()]
        };
        self.layers.iter().zip(under).map(blended).collect()
    }

    /// Compares with the reference on the core's own vertices, and with the alphas of textures, of
    /// which all are 1 without any. `has_colors` tells whether the reference's colour of each layer
    /// is the only right one.
    pub(super) fn judge(
        &self,
        reference: &Picture,
        texels: Option<&TexelAlphas>,
        has_colors: bool,
    ) -> Blended {
        let mut found = Blended::default();
        for (index, (all, &color)) in self.layers.iter().zip(&self.colors).enumerate() {
            let [x, y] = [index % reference.width(), index / reference.width()];
            let layers: Vec<Layer> = all.iter().copied().flatten().collect();
            found.blend_pixels += usize::from(!layers.is_empty());
            found.blend_most_layers = found.blend_most_layers.max(layers.len());
            let alphas = self.in_order(&self.alphas, [x, y]);
            let texels = texels.map(|texels| self.in_order(texels, [x, y]));
            let has_count = alphas.len() == all.len()
                && texels.as_ref().is_none_or(|texels| texels.len() == all.len());
            if !has_count {
                found.blend_layer_mismatches += 1;
            } else {
                let mut is_left_out = false;
                for (i, (fragment, layer)) in alphas.iter().zip(all).enumerate() {
                    let factors = Factors {
                        vertex: fragment.color,
                        texel: texels.as_ref().map_or([1.0; 2], |texels| texels[i].color),
                        material: self.materials[fragment.triangle],
                        view: self.opacity,
                    };
                    if self.blend == Blend::Replace {
                        let [may_be_drawn, may_be_left_out] = factors.test();
                        is_left_out |=
                            !if layer.is_some() { may_be_drawn } else { may_be_left_out };
                    } else {
                        let units = layer.map_or(0.0, |layer| 256.0 * layer.alpha);
                        found.add_alpha(factors.error(units, [x, y], fragment.triangle));
                    }
                }
                found.blend_layer_mismatches += usize::from(is_left_out);
            }
            if has_colors && has_count {
                let exact = self.in_order(reference, [x, y]);
                let drawn = exact.iter().zip(all).filter_map(|(f, layer)| Some((f, (*layer)?)));
                for (fragment, layer) in drawn {
                    let error = distance(fragment.color.map(f64::round), layer.color);
                    found.blend_layer_max_error = found.blend_layer_max_error.max(error);
                }
            }
            found.add_pixel(self.error([x, y], &layers, color));
        }
        found
    }

    /// The fragments of a pixel in the order of the triangles.
    fn in_order<'p, C: Copy>(
        &self,
        picture: &'p Picture<C>,
        [x, y]: [usize; 2],
    ) -> Vec<&'p Fragment<C>> {
        let mut fragments: Vec<_> = picture.fragments(x, y).iter().collect();
        fragments.sort_by_key(|fragment| self.ranks[fragment.triangle]);
        fragments
    }

    fn error(&self, pixel: [usize; 2], layers: &[Layer], color: [u8; 3]) -> BlendError {
        let exact = self.blend.put_all(self.background.map(f64::from), layers);
        let error_steps = distance(exact, color.map(f64::from));
        let bound = |channel: usize| {
            layers.iter().fold(0.0, |bound, &layer| bound * self.blend.passes(layer, channel) + 0.5)
        };
        let bound_steps = [0, 1, 2].map(bound).into_iter().fold(0.0, f64::max);
        BlendError { pixel, layers: layers.len(), error_steps, bound_steps }
    }
}

/// Faults for tests.
#[cfg(test)]
impl Layers {
    pub(super) fn first_with_layers(&self, count: usize) -> usize {
        self.layers.iter().position(|layers| layers.len() >= count).unwrap()
    }

    pub(super) fn drop_layer(&mut self, pixel: usize) {
        self.layers[pixel].pop();
    }

    pub(super) fn thin_layer(&mut self, pixel: usize, units: f64) {
        let Some(layer) = &mut self.layers[pixel][0] else { return };
        layer.alpha -= units / 256.0;
    }

    pub(super) fn tint_layer(&mut self, pixel: usize, change: f64) {
        let Some(layer) = &mut self.layers[pixel][0] else { return };
        layer.color[0] = (layer.color[0] + change) % 256.0;
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// How far blended colours are off the same layers blended in f64, and what differs in the layers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Blended {
    /// Pixels with at least one layer.
    pub blend_pixels: usize,
    /// The most layers on one pixel.
    pub blend_most_layers: usize,
    /// Pixels with more layers than the reference has there, or fewer.
    pub blend_layer_mismatches: usize,
    /// The largest difference of a layer's colour from the reference's in 8-bit steps, for the
    /// shadings flat, gouraud and unlit without fog; 0 for others, which have several right colours
    /// and of which those that are seen are judged by themselves.
    pub blend_layer_max_error: f64,
    /// The largest difference of a layer's alpha in units of 1/256, from those that are right.
    pub blend_alpha_max_error: f64,
    /// The layer whose alpha's difference is nearest to its bound or the farthest beyond it; `None`
    /// if nothing is translucent.
    pub blend_alpha_worst: Option<AlphaError>,
    /// Where the bound of an alpha comes from.
    pub blend_alpha_bound: AlphaBound,
    /// The largest difference of a blended colour in 8-bit steps.
    pub blend_max_error: f64,
    /// The pixel whose difference is the largest part of its bound.
    pub blend_worst: Option<BlendError>,
    /// Where a bound comes from.
    pub blend_bound: BlendBound,
}

/// Where the bound of a blended colour comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
#[cfg_attr(feature = "cli", serde(into = "&'static str"))]
pub struct BlendBound;

impl From<BlendBound> for &'static str {
    fn from(BlendBound: BlendBound) -> Self {
        "1/2 step of rounding for each layer, times the part that later layers let pass"
    }
}

/// How far the blended colour of a pixel is off.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct BlendError {
    /// Column and row.
    pub pixel: [usize; 2],
    /// How many layers it has.
    pub layers: usize,
    /// The largest difference of a channel in 8-bit steps.
    pub error_steps: f64,
    /// How large it may be.
    pub bound_steps: f64,
}

/// For the rounding of f64: some 100 roundings of values up to 255.
const ROUNDING: f64 = 1e-9;

impl BlendError {
    /// Whether it keeps its bound.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.error_steps <= self.bound_steps + ROUNDING
    }
}

impl Blended {
    fn add_alpha(&mut self, error: AlphaError) {
        self.blend_alpha_max_error = self.blend_alpha_max_error.max(error.error_units);
        let excess = |error: AlphaError| error.error_units - error.bound_units;
        let is_rounded = error.bound_units > 0.0 || error.error_units > 0.0;
        if is_rounded && self.blend_alpha_worst.is_none_or(|w| excess(error) > excess(w)) {
            self.blend_alpha_worst = Some(error);
        }
    }

    fn add_pixel(&mut self, error: BlendError) {
        self.blend_max_error = self.blend_max_error.max(error.error_steps);
        let part = |error: BlendError| error.error_steps / (error.bound_steps + ROUNDING);
        if self.blend_worst.is_none_or(|worst| part(error) > part(worst)) {
            self.blend_worst = Some(error);
        }
    }

    /// Whether the layers are those of the reference, their colours within `color_max_error`, and
    /// each alpha and each blended colour within its bound.
    #[must_use]
    pub fn is_within(&self, color_max_error: f64) -> bool {
        self.blend_layer_mismatches == 0
            && self.blend_layer_max_error <= color_max_error
            && self.blend_alpha_worst.is_none_or(|worst| worst.is_within())
            && self.blend_worst.is_none_or(|worst| worst.is_within())
    }
}
