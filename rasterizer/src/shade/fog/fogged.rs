//! A shader whose colours fade into fog.

use core::marker::PhantomData;

use super::{AtPixels, Fog, FogMode, mode::SeenFog};
use crate::{
    camera::Distance,
    color::{Alpha, Composite},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
    shade::{Face, OnScreen, Outcome as _, Sample, Shader},
    texture::Texel,
};

/// Any shader in fog: each of its colours has the fog's colour over it, by the [`Fog`] at the
/// pixel's distance, in the values that are stored and rounded to the nearest.
///
/// Fog reads 1 / w of its own, so that it needs no depth buffer. Discarded pixels stay discarded. A
/// triangle that lies in full fog is filled with its colour, unless its shader can discard pixels.
///
/// In a parallel projection all points have the near plane's 1 / w, and so its amount of fog.
///
/// ```
/// use embedded_graphics_core::pixelcolor::{Rgb565, WebColors as _};
/// # use rasterizer::{mesh::Mesh, prelude::*};
/// use rasterizer::{camera::Distance, shade::{AtVertices, Fog, Fogged}};
///
/// static FOG: Fog = Fog::linear(Distance::lit("2"), Distance::lit("10")).unwrap();
///
/// # fn tower<'a>(mesh: &'a Mesh<'a>, light: Light) {
/// let shader = Fogged::new(Gouraud::new(light), &FOG, Rgb565::CSS_LIGHT_STEEL_BLUE);
/// let tower = Object::new(mesh, shader);
/// // With small triangles:
/// let trees = Object::new(mesh, shader.computed(AtVertices));
/// # let _ = (tower, trees);
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Fogged<'f, Sh: Shader, B = AtPixels> {
    shader: Sh,
    fog: &'f Fog,
    color: Sh::Color,
    seen: SeenFog<'f>,
    mode: PhantomData<B>,
}

impl<'f, Sh: Shader> Fogged<'f, Sh> {
    /// A shader in fog of this colour, computed at every pixel.
    #[must_use]
    pub const fn new(shader: Sh, fog: &'f Fog, color: Sh::Color) -> Self {
        // Until a camera sees it.
        let seen = SeenFog::new(fog, Distance::ONE);
        Self { shader, fog, color, seen, mode: PhantomData }
    }
}

impl<'f, Sh: Shader, B> Fogged<'f, Sh, B> {
    /// Computed elsewhere, such as [`AtVertices`](super::AtVertices).
    #[must_use]
    pub fn computed<M: FogMode>(self, _: M) -> Fogged<'f, Sh, M> {
        let Self { shader, fog, color, seen, .. } = self;
        Fogged { shader, fog, color, seen, mode: PhantomData }
    }
}

/// What a shader in fog makes of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct FoggedFace<C, F> {
    /// The colour that all pixels have without fog, if it is one.
    solid: Option<C>,
    face: F,
}

impl<C, F: Default> Default for FoggedFace<C, F> {
    fn default() -> Self {
        Self { solid: None, face: F::default() }
    }
}

impl<'f, Sh, B> Shader for Fogged<'f, Sh, B>
where
    Sh: Shader<Color: Composite, Outcome: Texel<<Sh as Shader>::Color>>,
    B: FogMode,
{
    type Color = Sh::Color;
    /// Those of the shader, and the fog's.
    type Varyings = (Sh::Varyings, B::Varying<'f>);
    type Surface = Sh::Surface;
    type Face = FoggedFace<Sh::Color, Sh::Face>;
    type Outcome = Sh::Outcome;

    const TABLES: RequiredTables = Sh::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        let shader = self.shader.for_object(view);
        Self { shader, seen: SeenFog::new(self.fog, view.near()), ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Sh::Surface {
        self.shader.surface(material)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        (self.shader.vertex(vertex), B::varying(&self.seen))
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Sh::Surface,
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Sh::Color, Self::Face> {
        let [a, b, c] = gradients.corners().map(|(_, corner)| B::at_vertex(corner, &self.seen));
        // What lies between the corners has no less fog than the least of theirs, and no more than
        // the largest.
        let is_even = a == b && b == c;
        if is_even && a == Alpha::OPAQUE && !Sh::Outcome::DISCARDS {
            return Face::Solid(self.color);
        }
        match self.shader.face(surface, face, &gradients.of_first()) {
            Face::Solid(color) if is_even => Face::Solid(self.color.over(color, a)),
            Face::Solid(color) => {
                Face::Shaded(FoggedFace { solid: Some(color), face: Sh::Face::default() })
            }
            Face::Shaded(face) => Face::Shaded(FoggedFace { solid: None, face }),
        }
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Sh::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> Sh::Outcome {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Sh::Surface,
        FoggedFace { solid, face }: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Sh::Outcome + Copy {
        let pixels = self.shader.pixels(surface, face);
        let (seen, fog) = (self.seen, self.color);
        move |Fragment { varyings: (varyings, fogged), depth, column, row }| {
            let alpha = B::at_pixel(fogged, &seen);
            let bare = match solid {
                Some(color) => Sh::Outcome::opaque(color),
                None => pixels(Fragment { varyings, depth, column, row }),
            };
            bare.recolored(|color| fog.over(color, alpha))
        }
    }
}
