//! A shader with another colour of the materials.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{CodeSize, Face, OnScreen, Sample, Shader};
use crate::{
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
};

/// Any shader on materials of another colour, which an object can have at run time: that of a team,
/// of a light that is on, of what is chosen. It is computed once for each material that is drawn,
/// and costs no pixel anything.
///
/// A shader that shows textures or colours of vertices has only its bare materials recoloured.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use rasterizer::shade::Recolored;
///
/// # fn ships<'a>(mesh: &'a Mesh<'a>, light: Light) {
/// let shader = Flat::<Rgb565>::new(light);
/// // All materials, or the one with this place in the mesh's table.
/// let red = Object::new(mesh, Recolored::new(shader, Rgb888::RED));
/// let with_blue_windows = Object::new(mesh, Recolored::material(shader, 2, Rgb888::BLUE));
/// # let _ = (red, with_blue_windows);
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Recolored<Sh> {
    shader: Sh,
    color: Rgb888,
    /// `None` for all.
    material: Option<usize>,
}

impl<Sh> Recolored<Sh> {
    /// All materials in this colour.
    #[must_use]
    pub const fn new(shader: Sh, color: Rgb888) -> Self {
        Self { shader, color, material: None }
    }

    /// The material with this place in the mesh's table, from 0, in this colour.
    #[must_use]
    pub const fn material(shader: Sh, index: usize, color: Rgb888) -> Self {
        Self { shader, color, material: Some(index) }
    }
}

impl<Sh: Shader> Shader for Recolored<Sh> {
    type Color = Sh::Color;
    type Varyings = Sh::Varyings;
    type Surface = Sh::Surface;
    type Face = Sh::Face;
    type Outcome = Sh::Outcome;

    const CODE: CodeSize = Sh::CODE;

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self { shader: self.shader.for_object(view), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        let is_meant = self.material.is_none_or(|index| index == material.index());
        let recolored = if is_meant { material.recolored(self.color) } else { *material };
        self.shader.surface(&recolored)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Sh::Varyings {
        self.shader.vertex(vertex)
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Sh::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Sh::Color, Sh::Face> {
        self.shader.face(surface, face, gradients)
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Sh::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Sh::Outcome {
        self.shader.pixel(surface, face, fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Sh::Surface,
        face: Sh::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Sh::Outcome + Copy {
        self.shader.pixels(surface, face)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, RgbColor as _};

    use super::*;
    use crate::{
        numbers::Vec3,
        shade::{
            Flat, Gouraud, Level, Light, Textured, Unlit,
            textured::square::{GRAY, SIDE, drawn},
        },
        texture::{Colors, Texture},
    };

    fn is_all(shader: impl Shader<Color = Gray8>, gray: u8) {
        let rows = drawn(&shader, false).unwrap();
        assert_eq!(rows, [[gray; SIDE]; SIDE]);
    }

    #[test]
    fn the_color_reaches_every_shader() {
        let (white, black) = (Rgb888::WHITE, Rgb888::BLACK);
        is_all(Recolored::new(Unlit::new(), white), 255);
        is_all(Recolored::new(Unlit::new(), black), 0);
        let half = Light::new(Vec3::Z, Level::lit("0.5"), Level::ZERO);
        is_all(Recolored::new(Flat::new(half), Rgb888::new(200, 200, 200)), 100);
        is_all(Recolored::new(Gouraud::<_, 256>::with_levels(half), white), 128);
    }

    #[test]
    fn only_the_chosen_material_changes() {
        is_all(Recolored::material(Unlit::new(), 0, Rgb888::WHITE), 255);
        is_all(Recolored::material(Unlit::new(), 1, Rgb888::WHITE), GRAY);
        // The outer one is given the material first, and the inner one decides.
        let both =
            Recolored::new(Recolored::material(Unlit::new(), 0, Rgb888::BLACK), Rgb888::WHITE);
        is_all(both, 0);
    }

    #[test]
    fn textures_stay_and_bare_materials_change() {
        type Map<'a> = Texture<Colors<'a, Gray8, 1>, 1, 1>;
        const TEXEL: [Gray8; 1] = [Gray8::new(33)];
        let texel: Map<'_> = Texture::new(Colors::new(&TEXEL));
        is_all(Recolored::new(Textured::new(&[Some(texel)]), Rgb888::WHITE), 33);
        let none: [Option<Map<'_>>; 1] = [None];
        is_all(Recolored::new(Textured::new(&none), Rgb888::WHITE), 255);
    }
}
