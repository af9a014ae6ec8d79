//! Several models in one picture, as a firmware draws them: one after another.

use super::{
    Blending, DepthFormat, Pixel, Shading,
    lines::{LineOptions, draw_over},
    stand::Place,
    view::{View, ViewError},
};
use crate::model::Model;

/// A model of a picture.
#[derive(Clone, Copy, Debug)]
pub struct SceneModel<'a> {
    /// Its tables.
    pub model: &'a Model,
    /// Where it stands.
    pub place: Place,
    /// How its triangles are coloured.
    pub shading: Shading,
}

/// A picture of several models.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenePicture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The colours, row by row.
    pub colors: Vec<[u8; 3]>,
    /// How many pixels show each model.
    pub seen: Vec<usize>,
}

/// Draws models by the fixed-point core over a picture, each with its own place and shading instead
/// of the view's.
///
/// The nearest of them is seen, the first of several at the same depth. In a view that blends, each
/// lies on those before it. Lines and points have a depth of 32 bits: where there are some and
/// several models, surfaces have it too, in every view.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw a model in
/// it: also returns which one.
///
/// # Panics
///
/// Panics if `under` is not of the view's size.
pub fn render_scene(
    models: &[SceneModel<'_>],
    view: &View,
    options: LineOptions,
    under: &[[u8; 3]],
) -> Result<ScenePicture, (usize, ViewError)> {
    assert_eq!(under.len(), view.pixel_count(), "what lies under a picture has its size");
    let has_lines = models.iter().any(|scene| options.has_lines(scene.model));
    let depth = if has_lines && models.len() > 1 { DepthFormat::U32 } else { view.depth };
    let mut pixels: Vec<Pixel> = under.iter().map(|&color| Pixel { color, depth: 0 }).collect();
    let mut owners = vec![usize::MAX; pixels.len()];
    for (number, &SceneModel { model, place, shading }) in models.iter().enumerate() {
        let view = View { place, shading, depth, ..*view };
        let colors: Vec<[u8; 3]> = pixels.iter().map(|pixel| pixel.color).collect();
        let under = match view.blending {
            Blending::Replace => under,
            Blending::By(_) => &colors,
        };
        let drawn =
            draw_over(model, &view, options, Some(under)).map_err(|error| (number, error))?;
        for ((pixel, owner), &new) in pixels.iter_mut().zip(&mut owners).zip(&drawn.pixels) {
            let is_seen = match view.blending {
                // Larger is nearer in every format.
                Blending::Replace => new.depth > pixel.depth,
                Blending::By(_) => new.depth > 0,
            };
            if is_seen {
                (*pixel, *owner) = (new, number);
            }
        }
    }
    let count = |number: usize| owners.iter().filter(|&&owner| owner == number).count();
    Ok(ScenePicture {
        size: view.size,
        colors: pixels.iter().map(|pixel| pixel.color).collect(),
        seen: (0..models.len()).map(count).collect(),
    })
}
