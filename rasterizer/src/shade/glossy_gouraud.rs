//! Highlights computed at the vertices.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::Rgb888;
use fixed::types::U16F16;

use super::{
    FarViewer, Light, Lighting, NearViewer, Shader, ViewedFrom,
    finished::Finished,
    lighting::{Eye, Gloss, Levels, SurfacePoint, unit_varying},
};
use crate::{
    geometry::ObjectView,
    mesh::{Finish, Mesh, MeshMaterial, MeshVertex, RequiredTables},
    raster::Fragment,
};

/// The material's colour with highlights and with light of its own, both lit at the vertices: a
/// [`Gouraud`](super::Gouraud) for shiny materials. Needs
/// [`vertex_normals`](crate::mesh::Tables::vertex_normals).
///
/// The colour is that of [`Phong`](super::Phong), but both levels are computed at the vertices and
/// interpolated on the screen. A highlight is seen if it reaches a vertex: it takes triangles that
/// are smaller than it is. Vertices are shared by materials, so that all of a mesh have one
/// exponent: that of its first material with highlights. Their colours differ.
#[derive(Clone, Copy, Debug)]
pub struct GlossyGouraud<
    C,
    L: Lighting = Light,
    V: ViewedFrom = FarViewer,
    const LEVELS: usize = 64,
> {
    light: L,
    beams: L::Beams,
    eye: Eye<V>,
    spare_bits: u32,
    gloss: Gloss,
    color: PhantomData<C>,
}

impl<C, L: Lighting> GlossyGouraud<C, L> {
    /// Lit by `light`, in 64 levels of diffuse light, for a far viewer.
    #[must_use]
    pub const fn new(light: L) -> Self {
        Self::of(light)
    }
}

impl<C, L: Lighting, V: ViewedFrom, const LEVELS: usize> GlossyGouraud<C, L, V, LEVELS> {
    const fn of(light: L) -> Self {
        Self {
            light,
            beams: L::NO_BEAMS,
            eye: Eye::NOWHERE,
            spare_bits: 0,
            gloss: Gloss::NONE,
            color: PhantomData,
        }
    }

    /// With highlights for a viewer that each point sees in its own direction.
    #[must_use]
    pub const fn with_near_viewer(self) -> GlossyGouraud<C, L, NearViewer, LEVELS> {
        GlossyGouraud::of(self.light)
    }

    /// In another number of levels of diffuse light, a power of two.
    #[must_use]
    pub const fn with_levels<const N: usize>(self) -> GlossyGouraud<C, L, V, N> {
        GlossyGouraud::of(self.light)
    }
}

/// The exponent of the first material with highlights.
fn exponent(mesh: &Mesh<'_>) -> Option<u16> {
    let mut finishes = mesh.tables().finishes.iter();
    Some(finishes.find(|finish| finish.specular != Finish::MATTE.specular)?.exponent)
}

impl<C, L, V, const LEVELS: usize> Shader for GlossyGouraud<C, L, V, LEVELS>
where
    C: Copy + From<Rgb888>,
    L: Lighting,
    V: ViewedFrom,
{
    type Color = C;
    /// The diffuse and the specular level, in Q16.
    type Varyings = [u16; 2];
    type Surface = Finished<C, LEVELS>;
    type Face = ();
    type Outcome = C;

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..RequiredTables::NONE };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        let (light, eye) = (self.light.for_view(view), Eye::of(view));
        Self {
            light,
            beams: light.beams(eye.direction()),
            eye,
            spare_bits: view.mesh().spare_bits(),
            gloss: exponent(view.mesh()).map_or(Gloss::NONE, Gloss::new),
            color: PhantomData,
        }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        Finished::new(material, &material.finish())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 2] {
        let position = vertex.position().map(|c| i32::from(c) << self.spare_bits);
        // To a length of 2^15, and one that is far too long below it.
        let normal = unit_varying(vertex.normal()).map(|c| i32::from(c) << 4);
        let point = SurfacePoint::new([normal, position], &self.eye, &self.gloss);
        let mut sum = Levels::default();
        L::shine(&self.beams, &point, &mut sum);
        point.levels::<L>(&sum).map(|level| level as u16)
    }

    #[inline(always)]
    fn pixel(&self, surface: &Self::Surface, (): &(), fragment: Fragment<[U16F16; 2]>) -> C {
        let [diffuse, specular] = fragment.varyings.map(|level| level.to_bits() >> 16);
        surface.at(diffuse, specular)
    }
}
