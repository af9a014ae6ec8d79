//! What a shader makes of a pixel, with what is known about the shader.

use super::{CodeSize, Outcome, Shader};
use crate::color::Alpha;

/// The outcome of a shader. That it names its colour tells it from a colour.
pub(crate) struct Shaded<C, Sh: Shader<Color = C>>(pub(crate) Sh::Outcome);

impl<C, Sh: Shader<Color = C>> Outcome<C> for Shaded<C, Sh> {
    const DISCARDS: bool = Sh::Outcome::DISCARDS;
    const WRITES_DEPTH: bool = Sh::Outcome::WRITES_DEPTH;
    const HAS_ALPHA: bool = Sh::Outcome::HAS_ALPHA;
    const CODE: CodeSize = Sh::CODE;

    #[inline(always)]
    fn color(self) -> Option<C> {
        self.0.color()
    }

    #[inline(always)]
    fn layer(self) -> Option<(C, Alpha)> {
        self.0.layer()
    }
}
