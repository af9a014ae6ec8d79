//! A textured shader of the core against its definition.

use rasterizer::{
    color::Composite,
    shade::{self, OnScreen, Shader},
};

use super::{
    any_mode,
    coordinates::{self, ExactCoordinate},
    filter::{Precision, Seen},
    fixed::{self, Drawn, Placed, ShownColor},
    probe::{Probe, Probed},
    skins::Skins,
    surface::Surface,
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{self, Corner, Footprint, Mipmaps, Sample, is_opaque, lit},
};

/// The varyings of the reference: u, v and 1 / w of
/// [`Correction::corner`](super::Correction::corner), the light level, and u and v as they are. On
/// the screen all are linear.
type Varyings = [f64; 6];

/// By u and v as they are.
fn footprint(sample: &Sample<6>, inverse_w: f64) -> Footprint {
    let uv = |varyings: Varyings| [varyings[4], varyings[5]];
    let [per_column, per_row] = [uv(sample.per_column), uv(sample.per_row)];
    Footprint { uv: uv(sample.varyings), per_column, per_row, inverse_w }
}

/// A corner of a triangle as the core has it on the screen.
pub(super) struct PlacedCorner {
    /// Its texture coordinates.
    pub(super) uv: [f64; 2],
    /// Its near / w.
    pub(super) inverse_w: f64,
    /// Its light level.
    pub(super) light: f64,
}

/// Draws a textured model by the core. `texture_of` returns the texture of a material; `read` takes
/// the texture coordinate in Q8.24 from what a pixel sees; `placed` returns a corner from its
/// triangle and its stored varyings, and `exact` the coordinates and the light level of a corner of
/// the file.
pub(super) fn draw<'a, Sh: Shader<Color: ShownColor + Composite>>(
    (model, surface, skins): (&'a Model, &'a Surface, &'a Skins),
    texture_of: impl Fn(usize) -> &'a Mipmaps + Copy + 'a,
    view: &View,
    shader: &Sh,
    read: fn(&shade::Sample<Sh>) -> Option<[i32; 2]>,
    placed: impl Fn(usize, OnScreen<Sh>) -> PlacedCorner,
    exact: impl Fn(Corner) -> ([f64; 2], f64) + 'a,
) -> Result<Drawn<'a>, ViewError> {
    let Skins { materials, file_materials, is_translucent, .. } = skins;
    let (perspective, filter) = (view.perspective, view.filter);
    let shader = Probe { shader: shader.clone(), read };
    let Placed { picture, triangles, vertices, time, colors, blended, fog } =
        any_mode::with(perspective, || {
            fixed::place::<6, _>(model, view, &shader, |triangle, corner| {
                let PlacedCorner { uv, inverse_w, light } = placed(triangle, corner);
                let [u, v, q] = perspective.corner(uv, inverse_w);
                [u, v, q, light, uv[0], uv[1]]
            })
        })?;
    let coordinates: Vec<_> = colors.iter().map(Probed::uv).collect();
    let size = view.size.map(|c| c as usize).into();
    let depth = view.depth.definition();
    let arithmetic = move |fixed: &super::FixedPicture| {
        let seen = reference::draw_screen(&triangles, size, |sample: Sample<6>| {
            let texture = texture_of(materials[sample.triangle]);
            Some(Seen {
                texture,
                is_translucent: *is_translucent,
                exact: perspective.exact(&sample),
                bounds: perspective.bounds(&sample, texture.base().size()),
                // The core has one level for a triangle: that of its area in the texture over that
                // on the screen.
                level: footprint(&sample, 1.0).level_by_area(texture.base().size()),
                light: sample.varyings[3],
            })
        });
        let exact = seen.recolored(|_, fragment| Some(fragment.color.coordinate()));
        let texels = coordinates::compare(&coordinates, fixed, depth, &exact, perspective.reason());
        let alphas = seen
            .recolored(|_, fragment| Some(fragment.color.alphas(filter, Precision::OF_CHANNELS)));
        let picture = seen.recolored(|[x, y], fragment| {
            let drawn = fixed.pixels[y * size.0 + x];
            let mut color = drawn.color.map(f64::from);
            if let Some(fog) = &fog {
                color = fog.bare([x, y], fragment, color);
            }
            let right = fragment.color.right(filter, Precision::OF_CHANNELS, color);
            // Where it may be transparent, it is if the core shows something behind it.
            let is_drawn = || {
                let units = depth.units(fragment.depth) - f64::from(drawn.depth);
                drawn.depth != 0 && units <= 1.0
            };
            right.color.filter(|_| !right.may_be_transparent || is_drawn())
        });
        let picture = match &fog {
            Some(fog) => fog.over(&picture, |pixel| fixed.color(pixel)),
            None => picture,
        };
        (picture, Some(texels), None, Some(alphas))
    };
    let exact = move |corner: Corner| -> Varyings {
        let (uv, light) = exact(corner);
        [uv[0], uv[1], 1.0, light, uv[0], uv[1]]
    };
    let shade = move |sample: Sample<6>| {
        let exact = footprint(&sample, sample.depth);
        let texture = texture_of(file_materials[sample.triangle]);
        let texel = filter.texel(texture, &exact);
        is_opaque(texel).then(|| lit(texel, sample.varyings[3]))
    };
    Ok(Drawn {
        picture,
        vertices,
        time,
        blended,
        arithmetic: Box::new(arithmetic),
        end_to_end: fixed::end_to_end((model, surface), view, exact, shade),
    })
}

impl Seen<'_> {
    /// The coordinate alone.
    fn coordinate(&self) -> ExactCoordinate {
        let base = self.texture.base();
        ExactCoordinate {
            uv: self.exact.uv,
            bounds: self.bounds,
            size: base.size(),
            wrap: base.wrap(),
        }
    }
}
