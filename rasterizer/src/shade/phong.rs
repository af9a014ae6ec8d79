//! Light computed at each pixel.

use core::marker::PhantomData;

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{
    FarViewer, Light, Lighting, NearViewer, Sample, Shader, ViewedFrom,
    finished::Finished,
    lighting::{
        Ambit, Eye, Gloss, Illuminate, Levels, POSITION_BITS, Place, SurfacePoint, Viewpoint,
        unit_varying,
    },
};
use crate::{
    attribute::{Adaptive, Correction, PerspectiveCorrect},
    geometry::ObjectView,
    mesh::{Finish, MeshMaterial, MeshVertex, RequiredTables},
    raster::Fragment,
};

/// How the normals of [`Phong`] are corrected unless another way is chosen: within three units of
/// 2,032, a twelfth of a degree.
pub type PhongCorrection = Adaptive<48>;

/// The material's colour, lit at each pixel, with highlights (Phong, *Illumination for Computer
/// Generated Pictures*, 1975; Blinn, *Models of Light Reflection for Computer Synthesized
/// Pictures*, 1977). Needs [`vertex_normals`](crate::mesh::Tables::vertex_normals).
///
/// The normal is interpolated in perspective and made a unit vector at each pixel. It is within
/// half a degree of the exact one of the mesh's table where that is at least half as long, before
/// it is made a unit, as the normals of the corners: where these are less than 120 degrees apart.
///
/// A channel of the colour is, in the values that pictures store,
///
/// ```text
///   Ke + Kd min(1, ambient + sum of level max(0, n . l)) + Ks min(1, sum of level (n . h)^Ns)
/// ```
///
/// and at most full; l is the direction to a light, and h lies halfway between it and that to the
/// viewer. `Kd` is the material's colour, the others its [`Finish`]. Highlights are within
/// (1 + `Ns` / 32) / 256 of a light's level for the normal of the pixel: what a cosine's 15 bits
/// leave of its power.
///
/// `L` is the kind of light, `V` the kind of viewer ([`FarViewer`] or [`NearViewer`]) and `M` how
/// the normal is [corrected](crate::attribute::Correction). Only with a [`Lamp`](super::Lamp) or a
/// near viewer a vertex has its position too.
#[derive(Clone, Copy, Debug)]
pub struct Phong<
    C,
    L: Lighting = Light,
    V: ViewedFrom = FarViewer,
    M = PhongCorrection,
    const LEVELS: usize = 64,
> {
    light: L,
    beams: L::Beams,
    eye: Eye<V>,
    spare_bits: u32,
    kind: PhantomData<(C, M)>,
}

impl<C, L: Lighting> Phong<C, L> {
    /// Lit by `light`, in 64 levels, for a far viewer.
    #[must_use]
    pub const fn new(light: L) -> Self {
        Self { light, beams: L::NO_BEAMS, eye: Eye::NOWHERE, spare_bits: 0, kind: PhantomData }
    }
}

impl<C, L: Lighting, V: ViewedFrom, M, const LEVELS: usize> Phong<C, L, V, M, LEVELS> {
    /// With highlights for a viewer that each point sees in its own direction.
    #[must_use]
    pub const fn with_near_viewer(self) -> Phong<C, L, NearViewer, M, LEVELS> {
        self.chosen()
    }

    /// With the normal corrected in another way: [`Affine`](crate::attribute::Affine) is right in a
    /// parallel projection, and for objects that are small beside their distance.
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> Phong<C, L, V, N, LEVELS> {
        self.chosen()
    }

    /// In another number of levels of diffuse light, a power of two.
    #[must_use]
    pub const fn with_levels<const N: usize>(self) -> Phong<C, L, V, M, N> {
        self.chosen()
    }

    const fn chosen<W: ViewedFrom, N, const K: usize>(self) -> Phong<C, L, W, N, K> {
        Phong {
            light: self.light,
            beams: L::NO_BEAMS,
            eye: Eye::NOWHERE,
            spare_bits: 0,
            kind: PhantomData,
        }
    }
}

/// Where light and viewer depend on the position.
type PlaceOf<L, V> = Ambit<<L as Illuminate>::Place, <V as Viewpoint>::Place>;

impl<C, L, V, M, const LEVELS: usize> Shader for Phong<C, L, V, M, LEVELS>
where
    C: Copy + From<Rgb888>,
    L: Lighting,
    V: ViewedFrom,
    M: Correction,
{
    type Color = C;
    /// The normal, and the position if it matters.
    type Varyings = PerspectiveCorrect<<PlaceOf<L, V> as Place>::Vertex, M>;
    type Surface = Glossy<C, LEVELS>;
    type Face = ();
    type Outcome = C;

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..RequiredTables::NONE };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        let (light, eye) = (self.light.for_view(view), Eye::of(view));
        let beams = light.beams(eye.direction());
        Self { light, beams, eye, spare_bits: view.mesh().spare_bits(), kind: PhantomData }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        Glossy::new(material)
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let position = vertex
            .position()
            .map(|c| ((i32::from(c) << self.spare_bits) >> (16 - POSITION_BITS)) as i16);
        PerspectiveCorrect::new(PlaceOf::<L, V>::vertex(unit_varying(vertex.normal()), position))
    }

    #[inline(always)]
    fn pixel(&self, surface: &Self::Surface, (): &(), fragment: Fragment<Sample<Self>>) -> C {
        let [[x, y, z], position] = PlaceOf::<L, V>::pixel(fragment.varyings.value);
        self.shaded(surface, x, y, z, position)
    }
}

impl<C, L, V, M, const LEVELS: usize> Phong<C, L, V, M, LEVELS>
where
    C: Copy + From<Rgb888>,
    L: Lighting,
    V: ViewedFrom,
{
    // codegen: called with coordinates in registers: the loop over pixels has none to spare.
    #[inline(never)]
    fn shaded(&self, surface: &Glossy<C, LEVELS>, x: i32, y: i32, z: i32, position: [i32; 3]) -> C {
        let point = SurfacePoint::new([[x, y, z], position], &self.eye, &surface.gloss);
        let mut sum = Levels::default();
        L::shine(&self.beams, &point, &mut sum);
        let [diffuse, specular] = point.levels::<L>(&sum);
        surface.colors.at(diffuse, specular)
    }
}

/// A material with highlights.
#[derive(Clone, Copy, Debug)]
pub struct Glossy<C, const LEVELS: usize> {
    pub(super) colors: Finished<C, LEVELS>,
    pub(super) gloss: Gloss,
}

impl<C: Copy + From<Rgb888>, const LEVELS: usize> Glossy<C, LEVELS> {
    fn new(material: &MeshMaterial<'_>) -> Self {
        let finish: Finish = material.finish();
        let is_matte = finish.specular == Finish::MATTE.specular;
        let gloss = if is_matte { Gloss::NONE } else { Gloss::new(finish.exponent) };
        Self { colors: Finished::new(material, &finish), gloss }
    }
}
