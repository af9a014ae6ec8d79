//! Objects between two shapes of a mesh.

use super::{Modes, Object};
use crate::{
    geometry::{ClipAll, CullBack, Morphed, Pose},
    mesh::Tween,
    output::Replace,
    raster::NoBias,
    shade::Shader,
};

impl<'a, Sh: Shader> Object<'a, Sh, Modes<CullBack, ClipAll, Replace, NoBias, Morphed<'a>>> {
    /// A mesh between two of its shapes, at the origin, without its back faces: drawn like any
    /// other, by every shader, with its vertices stored or on demand.
    ///
    /// ```
    /// # use embedded_graphics_core::pixelcolor::Rgb565;
    /// # use rasterizer::{mesh::Keyframes, numbers::Scalar, prelude::*, scene::DrawError};
    /// # type Vertices<'v> = &'v mut [ScreenVertex<S4, u16, [u16; 1]>];
    /// # fn draw<T: rasterizer::output::Target<Color = Rgb565, Depth = u16>>(
    /// #     bird: &Keyframes<'_>, light: Light, camera: &Camera<Perspective>,
    /// #     vertices: Vertices<'_>, frame: &mut T, time: Distance,
    /// # ) -> Result<(), DrawError<T::Error>> {
    /// // The third of `bird`'s four shapes at 2.0, the fourth at 3.0, the first again at 4.0.
    /// let tween = bird.at(time);
    /// Object::morphed(&tween, Gouraud::new(light)).draw(camera, vertices, frame)
    /// # }
    /// ```
    #[must_use]
    pub const fn morphed(tween: &'a Tween<'a>, shader: Sh) -> Self {
        let mode = Modes {
            culling: CullBack,
            clipping: ClipAll,
            blending: Replace,
            bias: NoBias,
            shape: Morphed::new(tween),
        };
        Self { mesh: tween.mesh(), pose: Pose::IDENTITY, shader, mode }
    }
}
