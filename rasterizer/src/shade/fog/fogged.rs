//! A shader whose colours fade into fog.

use core::marker::PhantomData;

use super::{AtPixels, Fog, FogMode, mode::SeenFog};
use crate::{
    camera::Distance,
    color::{Alpha, Composite},
    geometry::ObjectView,
    mesh::{MeshFace, MeshMaterial, MeshVertex, RequiredTables},
    raster::{Fragment, Gradients},
    shade::{Face, InnerPixel, OnScreen, Outcome as _, Sample, Shader, inner},
    texture::Texel,
};

/// Any shader in fog: each of its colours has the fog's colour over it, by the [`Fog`] at the
/// pixel's distance, in the values that are stored and rounded to the nearest.
///
/// Fog reads 1 / w of its own, so that it needs no depth buffer. Discarded pixels stay discarded. A
/// triangle that lies in full fog is filled with its colour, unless its shader can discard pixels
/// or has pixels with an alpha, whose colour alone is in the fog.
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

impl<'f, Sh, B> Shader for Fogged<'f, Sh, B>
where
    Sh: Shader<Color: Composite, Outcome: Texel<<Sh as Shader>::Color>>,
    B: FogMode,
{
    type Color = Sh::Color;
    /// Those of the shader, and the fog's.
    type Varyings = (Sh::Varyings, B::Varying<'f>);
    type Surface = Sh::Surface;
    type Face = Face<Sh::Color, Sh::Face>;
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
        if is_even && a == Alpha::OPAQUE && !Sh::Outcome::DISCARDS && !Sh::Outcome::HAS_ALPHA {
            return Face::Solid(self.color);
        }
        match self.shader.face(surface, face, &gradients.part(|(own, _)| own)) {
            Face::Solid(color) if is_even => Face::Solid(self.color.over(color, a)),
            face => Face::Shaded(face),
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
        face: Self::Face,
    ) -> impl Fn(Fragment<Sample<Self>>) -> Sh::Outcome + Copy {
        let pixel = inner::pixels(&self.shader, surface, face);
        let (seen, fog) = (self.seen, self.color);
        move |Fragment { varyings: (varyings, fogged), depth, column, row }| {
            let alpha = B::at_pixel(fogged, &seen);
            let bare = match pixel(Fragment { varyings, depth, column, row }) {
                InnerPixel::Solid(color) => Sh::Outcome::opaque(color),
                InnerPixel::Shaded(outcome) => outcome,
            };
            bare.recolored(|color| fog.over(color, alpha))
        }
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_graphics_core::{
        pixelcolor::{Gray8, GrayColor as _},
        prelude::{Point, Size},
        primitives::Rectangle,
    };

    use super::{super::AtVertices, *};
    use crate::{
        camera::{Camera, Orthographic, Perspective},
        geometry::{Projection, ScreenVertex},
        mesh::{Material, Mesh, Positions, Tables, Triangles},
        numbers::{Rotation, S8, Vec3},
        output::Frame,
        prelude::Object,
        shade::{Density, Unlit, textured::square},
        texture::{Colors, Keyed, Texture},
    };

    const SIDE: u32 = 64;
    const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new_equal(SIDE));

    /// A black floor a unit below the eye, from behind the camera to behind the far plane.
    static FLOOR: Mesh<'static> = Mesh::new_const(Tables {
        positions: Positions::I16(&[[-25, -1, 9], [25, -1, 9], [25, -1, -25], [-25, -1, -25]]),
        triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
        materials: &[Material::new([0; 3], 2)],
        ..Tables::EMPTY
    });

    /// A law in f64, and its fog.
    struct Law {
        fog: Fog,
        amount: fn(f64) -> f64,
        /// The most by which the amount changes with the logarithm of the distance.
        slope: f64,
    }

    fn laws() -> [Law; 3] {
        [
            Law {
                fog: Fog::linear(Distance::ZERO, Distance::lit("20")).unwrap(),
                amount: |w| w / 20.0,
                slope: 1.0,
            },
            Law {
                fog: Fog::linear(Distance::lit("2"), Distance::lit("6")).unwrap(),
                amount: |w| (w - 2.0) / 4.0,
                slope: 1.5,
            },
            Law {
                fog: Fog::exponential(Density::lit("0.15")),
                amount: |w| 1.0 - (-0.15 * w).exp(),
                slope: 0.37,
            },
        ]
    }

    fn lens(near: &str) -> Perspective {
        let [focal, near, far] = ["32", near, "20"].map(Distance::lit);
        Perspective::with_focal_length(focal, near, far).unwrap()
    }

    /// Draws the floor as a whole and in bands, which must be equal; 1 is the background.
    fn drawn<P: Projection, Sh: Shader<Color = Gray8>>(lens: P, shader: Sh) -> Vec<u8> {
        let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, SCREEN).unwrap();
        let object = Object::new(&FLOOR, shader);
        let mut vertices = [ScreenVertex::<S8, u16, OnScreen<Sh>>::EMPTY; 4];
        let seen = object.project(&camera, &mut vertices).expect("a floor of this size");
        let pixels = (SIDE * SIDE) as usize;
        let (mut color, mut depth) = (std::vec![Gray8::new(1); pixels], std::vec![0u16; pixels]);
        seen.draw(&mut Frame::new(&mut color, &mut depth, SCREEN).unwrap()).unwrap();
        for top in (0..SIDE).step_by(11) {
            let rows = 11.min(SIDE - top);
            let band = Rectangle::new(Point::new(0, top as i32), Size::new(SIDE, rows));
            let pixels = (SIDE * rows) as usize;
            let (mut part, mut depth) = (std::vec![Gray8::new(1); pixels], std::vec![0u16; pixels]);
            seen.draw(&mut Frame::new(&mut part, &mut depth, band).unwrap()).unwrap();
            assert_eq!(part, color[(SIDE * top) as usize..][..pixels], "row {top}");
        }
        color.iter().map(|pixel| pixel.luma()).collect()
    }

    /// White fog over black shows its amount. A row of the floor has one distance.
    #[test]
    fn the_amount_is_that_of_the_distance_from_near_to_far() {
        let mut judged = 0;
        for near in ["0.25", "0.7", "1", "1.7", "2.5"] {
            for Law { fog, amount, slope } in laws() {
                let pixels = drawn(lens(near), Fogged::new(Unlit::new(), &fog, Gray8::new(255)));
                for (row, pixels) in pixels.chunks_exact(SIDE as usize).enumerate() {
                    let below = row as f64 + 0.5 - f64::from(SIDE / 2);
                    let distance = f64::from(SIDE / 2) / below;
                    if below < 0.0 || distance < near.parse::<f64>().unwrap() || distance > 20.0 {
                        assert!(pixels.iter().all(|&pixel| pixel == 1), "row {row}");
                        continue;
                    }
                    let exact = amount(distance).clamp(0.0, 1.0);
                    // Half a step of 256 and of 255, the table, 1 / w at the vertices and at the
                    // pixel, and corners snapped to 1/512 pixel.
                    let inverse_w = 1.5 / 2_048.0 + 1.0 / 512.0 / below;
                    let bound = 1.0 / 512.0 + 1.0 / 510.0 + 1.0 / 512.0 + slope * inverse_w;
                    for &pixel in pixels {
                        let error = (f64::from(pixel) / 255.0 - exact).abs();
                        assert!(error <= bound, "{error} of {bound}, row {row}, near {near}");
                        judged += 1;
                    }
                }
            }
        }
        assert!(judged > 20_000, "{judged}");
    }

    #[test]
    fn fog_at_vertices_is_between_theirs_and_equal_in_bands() {
        for near in ["0.25", "1.7"] {
            for Law { fog, amount, .. } in laws() {
                let shader = Fogged::new(Unlit::new(), &fog, Gray8::new(255)).computed(AtVertices);
                let pixels = drawn(lens(near), shader);
                // New corners on the near plane have the fog of that.
                let least = amount(near.parse().unwrap()).clamp(0.0, 1.0);
                let below = &pixels[(SIDE * (SIDE / 2 + 1)) as usize..];
                // 1 is the background.
                assert!(
                    below.iter().all(|&p| p == 1 || f64::from(p) >= 255.0 * least - 1.5),
                    "{near}"
                );
            }
        }
    }

    /// A parallel projection has the near plane's fog everywhere.
    #[test]
    fn a_parallel_projection_has_even_fog() {
        let fog = Fog::linear(Distance::ZERO, Distance::lit("4")).unwrap();
        let shader = Fogged::new(Unlit::new(), &fog, Gray8::new(200));
        let lens = Orthographic::new(Distance::lit("4"), Distance::ONE, Distance::lit("50"));
        // Seen along the floor, nothing is; the square of the other tests stands across.
        assert!(drawn(lens.unwrap(), shader).iter().all(|&pixel| pixel == 1));
        let rows = square::drawn(&shader, false).unwrap();
        // A quarter of the way from the grey to the fog's colour.
        let expected = (3 * u32::from(square::GRAY) + 200 + 2) / 4;
        assert!(rows.iter().flatten().all(|&pixel| u32::from(pixel).abs_diff(expected) <= 1));
    }

    #[test]
    fn discarded_pixels_stay_discarded_in_full_fog() {
        type Holes<'a> = Texture<Keyed<Colors<'a, Gray8, 4>>, 2, 2>;
        const TEXELS: [Gray8; 4] = [Gray8::new(0), Gray8::new(7), Gray8::new(7), Gray8::new(0)];
        let map: Holes<'_> = Texture::new(Keyed::new(Colors::new(&TEXELS), Gray8::new(7)));
        let textures = [map];
        let fog = Fog::linear(Distance::ZERO, Distance::lit("0.5")).unwrap();
        let shader = crate::shade::Textured::new(&textures);
        let rows = square::drawn(&Fogged::new(shader, &fog, Gray8::new(99)), false).unwrap();
        assert_eq!([rows[1][1], rows[1][6], rows[6][1], rows[6][6]], [99, 1, 1, 99]);
    }
}
