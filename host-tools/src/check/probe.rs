//! A shader that also gives each pixel what it sees: the texture coordinate that it samples, or the
//! normal.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    color::{Alpha, Composite},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    output::{PixelFill, StoredColor},
    raster::{Fragment, Gradients},
    shade::{Face, Layer, OnScreen, Outcome, Sample, Shader},
};

use super::fixed::ShownColor;

/// A colour, and what it comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Probed<C, T = [i32; 2]> {
    color: C,
    seen: Option<T>,
}

impl<C, T: Copy> Probed<C, T> {
    /// What the shader sees; `None` where it reads nothing.
    pub(super) const fn seen(&self) -> Option<T> {
        self.seen
    }
}

impl<C> Probed<C> {
    /// u and v, where 1 is the texture's width or height; `None` without a texture.
    pub(super) fn uv(&self) -> Option<[f64; 2]> {
        self.seen.map(|uv| uv.map(|c| f64::from(c) / 2f64.powi(24)))
    }
}

impl<C: Copy, T: Copy> StoredColor for Probed<C, T> {
    type Fill = PixelFill<Self>;
}

/// What lies behind keeps what it comes from.
impl<C: Composite, T: Copy> Composite for Probed<C, T> {
    fn over(self, stored: Self, alpha: Alpha) -> Self {
        Self { color: self.color.over(stored.color, alpha), ..stored }
    }

    fn add(self, stored: Self, alpha: Alpha) -> Self {
        Self { color: self.color.add(stored.color, alpha), ..stored }
    }

    fn multiply(self, stored: Self, alpha: Alpha) -> Self {
        Self { color: self.color.multiply(stored.color, alpha), ..stored }
    }

    fn screen(self, stored: Self, alpha: Alpha) -> Self {
        Self { color: self.color.screen(stored.color, alpha), ..stored }
    }
}

impl<C: From<Rgb888>, T> From<Rgb888> for Probed<C, T> {
    fn from(color: Rgb888) -> Self {
        Self { color: color.into(), seen: None }
    }
}

impl<C: Into<Self>, T> From<Probed<C, T>> for Rgb888 {
    fn from(probed: Probed<C, T>) -> Self {
        probed.color.into()
    }
}

/// A pixel of a shader with what it sees.
fn probed<C: From<Rgb888>, T>(pixel: impl Outcome<C>, seen: Option<T>) -> Layer<Probed<C, T>> {
    match pixel.layer() {
        Some((color, alpha)) => Layer::new(Probed { color, seen }, alpha),
        None => Layer::new(Probed::from(Rgb888::BLACK), Alpha::CLEAR),
    }
}

/// A shader whose colours have with them what `read` takes from a pixel's varyings: the coordinate
/// in Q8.24 of a texture, which is `None` without one, or the normal.
#[derive(Debug)]
pub(super) struct Probe<Sh: Shader, T = [i32; 2]> {
    pub(super) shader: Sh,
    pub(super) read: fn(&Sample<Sh>) -> Option<T>,
}

impl<Sh: Shader, T> Clone for Probe<Sh, T> {
    fn clone(&self) -> Self {
        Self { shader: self.shader.clone(), read: self.read }
    }
}

impl<Sh: Shader<Color: ShownColor>, T: Copy> Shader for Probe<Sh, T> {
    type Color = Probed<Sh::Color, T>;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = Sh::Face;
    /// Those of pixels that the shader discards are invisible.
    type Outcome = Layer<Probed<Sh::Color, T>>;

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { shader: self.shader.for_object(view), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        self.shader.surface(material)
    }

    fn vertex(&self, vertex: &MeshVertex<'_>) -> Sh::Varyings {
        self.shader.vertex(vertex)
    }

    fn face(
        &self,
        surface: &Sh::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Probed<Sh::Color, T>, Sh::Face> {
        match self.shader.face(surface, face, gradients) {
            // A face of one colour samples nothing.
            Face::Solid(color) => Face::Solid(Probed { color, seen: None }),
            Face::Shaded(shared) => Face::Shaded(shared),
        }
    }

    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Sh::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Self::Outcome {
        let seen = (self.read)(&fragment.varyings);
        probed(self.shader.pixel(surface, face, fragment), seen)
    }

    fn pixels(
        &self,
        surface: &Sh::Surface,
        face: Sh::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Layer<Probed<Sh::Color, T>> + Copy {
        let (pixels, read) = (self.shader.pixels(surface, face), self.read);
        move |fragment| {
            let seen = read(&fragment.varyings);
            probed(pixels(fragment), seen)
        }
    }
}
