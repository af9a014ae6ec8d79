//! A picture of a lit ball, looked up by the normal.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::{
    super::{CodeSize, Face, OnScreen, Sample, Shader},
    skin::{ColorOf, Covered, FaceOf, Skin, Slot, TexelOf, Varying},
};
use crate::{
    attribute::{Affine, Correction},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    numbers::mul_q30,
    raster::{Fragment, Gradients},
    texture::{Filter, Nearest},
};

/// A texture looked up by the normal in camera space (a *matcap*, or lit sphere: Sloan, Martin,
/// Gooch and Gooch, *The Lit Sphere*, Graphics Interface 2001): light, highlights and reflections
/// of any kind for the price of a texture, as long as they turn with the camera.
///
/// The texture is a picture of a ball of the material, whose outline touches the borders. Where the
/// unit normal has the part x to the camera's right and y upwards, the coordinates are u = 1/2 +
/// 63/128 x and v = 1/2 - 63/128 y: they stay a 128th off the borders, so that all kinds of borders
/// look alike, and colours outside the ball's outline are not seen.
///
/// Needs [`vertex_normals`](crate::mesh::Tables::vertex_normals) and no texture coordinates. The
/// types are those of [`Textured`](super::Textured). A material without a texture has its colour,
/// and one beyond the table has the first texture.
///
/// # Error
///
/// At a vertex a coordinate is within 2<sup>-14</sup> of what the normal in the table gives.
/// Between vertices, coordinates are interpolated like those of other textures, and not the length
/// of the normal: where two normals of an edge are at the angle θ, its middle is up to (1 - cos
/// θ/2) / 2 of the texture closer to the middle of the ball than a normalised one. For 30 degrees
/// that is 1.7 %, a texel of 59.
#[derive(Clone, Copy, Debug)]
pub struct Matcap<'a, S, F = Nearest, M = Affine> {
    skin: Skin<'a, S, F, M, i16>,
    /// The coordinates' changes by a normal in object space, in Q28 for 127 units.
    factors: [[i32; 3]; 2],
}

impl<'a, S> Matcap<'a, S> {
    /// With the textures of a mesh by its materials, or one for all: nearest texels, linear on the
    /// screen like [`Gouraud`](crate::shade::Gouraud)'s light.
    #[must_use]
    pub const fn new<const N: usize>(textures: &'a [S; N]) -> Self {
        Self { skin: Skin::new(textures), factors: [[0; 3]; 2] }
    }

    /// The same with textures whose number is known at run time; `None` without any.
    #[must_use]
    pub const fn from_slice(textures: &'a [S]) -> Option<Self> {
        match Skin::from_slice(textures) {
            Some(skin) => Some(Self { skin, factors: [[0; 3]; 2] }),
            None => None,
        }
    }
}

impl<'a, S, F, M> Matcap<'a, S, F, M> {
    /// Filtered in another way, such as [`Bilinear`](crate::texture::Bilinear).
    #[must_use]
    pub const fn filtered<G: Copy>(self, _: G) -> Matcap<'a, S, G, M> {
        Matcap { skin: self.skin.chosen(), factors: self.factors }
    }

    /// Corrected in another way, such as [`EveryPixel`](crate::attribute::EveryPixel).
    #[must_use]
    pub const fn corrected<N: Correction>(self, _: N) -> Matcap<'a, S, F, N> {
        Matcap { skin: self.skin.chosen(), factors: self.factors }
    }
}

/// 63/128 of a 127th, in Q28.
const GAIN: i32 = ((63 << 21) + 63) / 127;

/// From Q28 to the Q14 of coordinates.
const DOWN: u32 = 14;

/// A coordinate in Q14: a normal is at most 127.9 long, so that it is from 0 to 1.
#[inline(always)]
const fn coordinate([x, y, z]: [i8; 3], [a, b, c]: [i32; 3]) -> i16 {
    let q28 = x as i32 * a + y as i32 * b + z as i32 * c;
    ((q28 + (1 << 27) + (1 << (DOWN - 1))) >> DOWN) as i16
}

impl<S, F, M> Shader for Matcap<'_, S, F, M>
where
    S: Slot,
    ColorOf<S>: From<Rgb888>,
    F: Filter<S::Texture>,
    M: Correction,
{
    type Color = ColorOf<S>;
    type Varyings = Varying<S, F, M, i16>;
    type Surface = Covered<S, ColorOf<S>>;
    type Face = FaceOf<S, F>;
    type Outcome = TexelOf<S>;

    const CODE: CodeSize = F::CODE.max(CodeSize::Medium);

    const TABLES: RequiredTables = RequiredTables { vertex_normals: true, ..RequiredTables::NONE };

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        let [right, down, _] = view.object_axes();
        let factors = [right, down].map(|axis| axis.map(|part| mul_q30(part, GAIN)));
        Self { factors, ..*self }
    }

    fn surface(&self, material: &MeshMaterial<'_>) -> Self::Surface {
        self.skin.surface(material, material.rgb().into())
    }

    #[inline(always)]
    fn vertex(&self, vertex: &MeshVertex<'_>) -> Self::Varyings {
        let (normal, [right, down]) = (vertex.normal(), &self.factors);
        Skin::<S, F, M, i16>::at([coordinate(normal, *right), coordinate(normal, *down)])
    }

    #[inline(always)]
    fn face(
        &self,
        surface: &Self::Surface,
        _: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<ColorOf<S>, FaceOf<S, F>> {
        Skin::<S, F, M, i16>::plain_face(surface, gradients)
    }

    #[inline(always)]
    fn pixel(
        &self,
        surface: &Self::Surface,
        face: &Self::Face,
        fragment: Fragment<Sample<Self>>,
    ) -> TexelOf<S> {
        self.pixels(surface, *face)(fragment)
    }

    #[inline(always)]
    fn pixels(
        &self,
        surface: &Self::Surface,
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> TexelOf<S> + Copy {
        Skin::<S, F, M, i16>::plain_pixels(surface, face)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::{
        pixelcolor::Gray8,
        prelude::{Point, Size},
        primitives::Rectangle,
    };

    use super::*;
    use crate::{
        camera::{Camera, Distance, Perspective},
        geometry::Pose,
        mesh::{Material, Mesh, Positions, Tables, Triangles},
        numbers::{Rotation, Turn, Vec3},
        random::Random,
        shade::textured::square::{GRAY, SIDE, drawn},
        texture::{Colors, Texture},
    };

    static MESH: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[[0, 0, 0], [1, 0, 0], [0, 1, 0]]),
        triangles: Triangles::U8(&[[0, 1, 2]]),
        materials: &[Material::new([0; 3], 1)],
        ..Tables::EMPTY
    });

    type Map<'a> = Texture<Colors<'a, Gray8, 4>, 2, 2>;
    const TEXELS: [Gray8; 4] = [Gray8::new(10), Gray8::new(20), Gray8::new(30), Gray8::new(40)];

    /// Random normals and poses, by the definition in f64.
    #[test]
    fn coordinates_are_those_of_the_normal_in_camera_space() {
        let map: Map<'_> = Texture::new(Colors::new(&TEXELS));
        let textures = [map];
        let mut random = Random::new(5);
        let near = Distance::lit("0.1");
        let lens = Perspective::new(Turn::degrees(50), near, Distance::lit("10")).unwrap();
        let screen = Rectangle::new(Point::zero(), Size::new(32, 32));
        for _ in 0..2_000 {
            let mut turn = || Turn::from_bits(random.bits() as u32);
            let rotation =
                Rotation::about_z(turn()) * Rotation::about_x(turn()) * Rotation::about_y(turn());
            let camera = Rotation::about_y(turn()) * Rotation::about_x(turn());
            let camera = Camera::at(Vec3::lit("1", "2", "3"), camera, lens, screen).unwrap();
            let pose = Pose::rotated(rotation);
            let view = ObjectView::new(&MESH, &pose, &camera);
            let shader = Matcap::new(&textures).for_object(&view);
            let normal = {
                let [x, y, z] = core::array::from_fn(|_| f64::from(random.within(-100, 100)));
                let length = (x * x + y * y + z * z).sqrt().max(1.0);
                [x, y, z].map(|part: f64| (part / length * 127.0).round() as i8)
            };
            let rows = rotation.rows().map(|row| row.map(|part| part.to_num::<f64>()));
            let world = rows.map(|row| (0..3).map(|i| row[i] * f64::from(normal[i])).sum::<f64>());
            let along = |axis: usize| {
                let axis = camera.axes()[axis].map(|part| f64::from(part) / 2f64.powi(30));
                (0..3).map(|i| axis[i] * world[i]).sum::<f64>() / 127.0
            };
            for (axis, factors) in shader.factors.into_iter().enumerate() {
                let got = f64::from(coordinate(normal, factors)) / 16_384.0;
                let exact = 0.5 + 63.0 / 128.0 * along(axis);
                assert!((got - exact).abs() <= 2f64.powi(-14), "{got}, not {exact}");
                assert!((0.0..1.0).contains(&got));
            }
        }
    }

    #[test]
    fn a_normal_towards_the_viewer_is_the_middle() {
        let map: Map<'_> = Texture::new(Colors::new(&TEXELS));
        let rows = drawn(&Matcap::new(&[map]), false).unwrap();
        // On the corner of all four texels, which belongs to the right lower one.
        assert_eq!(rows, [[40; SIDE]; SIDE]);
        let none: [Option<Map<'_>>; 1] = [None];
        assert_eq!(drawn(&Matcap::new(&none), false).unwrap(), [[GRAY; SIDE]; SIDE]);
    }
}
