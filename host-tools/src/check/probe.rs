//! A shader that also gives each pixel the texture coordinate that it samples.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    color::{Alpha, Composite},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    output::{PixelFill, StoredColor},
    raster::{Fragment, Gradients},
    shade::{Face, OnScreen, Outcome, Sample, Shader},
};

use super::fixed::ShownColor;

/// A colour, and the texture coordinate that it comes from, in Q8.24.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Probed<C> {
    color: C,
    coordinate: Option<[i32; 2]>,
}

impl<C> Probed<C> {
    /// u and v, where 1 is the texture's width or height; `None` without a texture.
    pub(super) fn uv(&self) -> Option<[f64; 2]> {
        self.coordinate.map(|uv| uv.map(|c| f64::from(c) / 2f64.powi(24)))
    }
}

impl<C: Copy> StoredColor for Probed<C> {
    type Fill = PixelFill<Self>;
}

/// What lies behind keeps its coordinate.
impl<C: Composite> Composite for Probed<C> {
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

impl<C: From<Rgb888>> From<Rgb888> for Probed<C> {
    fn from(color: Rgb888) -> Self {
        Self { color: color.into(), coordinate: None }
    }
}

impl<C: Into<Self>> From<Probed<C>> for Rgb888 {
    fn from(probed: Probed<C>) -> Self {
        probed.color.into()
    }
}

/// A shader whose colours have their coordinates with them. `read` takes the coordinate, in Q8.24,
/// from what a pixel sees of the varyings; it is `None` for a shader without a texture.
#[derive(Debug)]
pub(super) struct Probe<Sh: Shader> {
    pub(super) shader: Sh,
    pub(super) read: fn(&Sample<Sh>) -> Option<[i32; 2]>,
}

impl<Sh: Shader> Clone for Probe<Sh> {
    fn clone(&self) -> Self {
        Self { shader: self.shader.clone(), read: self.read }
    }
}

impl<Sh: Shader<Color: ShownColor>> Shader for Probe<Sh> {
    type Color = Probed<Sh::Color>;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = Sh::Face;
    /// Pixels that the shader discards stay discarded.
    type Outcome = Option<Probed<Sh::Color>>;

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
    ) -> Face<Probed<Sh::Color>, Sh::Face> {
        match self.shader.face(surface, face, gradients) {
            // A face of one colour samples nothing.
            Face::Solid(color) => Face::Solid(Probed { color, coordinate: None }),
            Face::Shaded(shared) => Face::Shaded(shared),
        }
    }

    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Sh::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Option<Probed<Sh::Color>> {
        let coordinate = (self.read)(&fragment.varyings);
        let color = self.shader.pixel(surface, face, fragment).color()?;
        Some(Probed { color, coordinate })
    }

    fn pixels(
        &self,
        surface: &Sh::Surface,
        face: Sh::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Option<Probed<Sh::Color>> + Copy {
        let (pixels, read) = (self.shader.pixels(surface, face), self.read);
        move |fragment| {
            let coordinate = read(&fragment.varyings);
            Some(Probed { color: pixels(fragment).color()?, coordinate })
        }
    }
}
