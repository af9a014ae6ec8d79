//! Rectangles with a whole texture.

use super::{Material, Mesh, Positions, Tables, TextureCoordinates, Triangles};

/// A rectangle of `W` by `H` units in the plane z = 0, its front towards +z, with the whole of a
/// texture on it: for billboards ([`Pose::facing`](crate::geometry::Pose::facing)), decals and blob
/// shadows. Its two triangles have one material, which is white.
///
/// With the texture's width and height in texels, a texel is a unit;
/// [`Pose::scaled`](crate::geometry::Pose::scaled) makes it any size.
///
/// ```
/// use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::{prelude::*, shade::Slot, texture::{TexelMap, Texels}};
/// use rasterizer::{attribute::Affine, mesh::Card};
///
/// // A tree of 2 units in height and 1 in width, of 16 x 32 texels.
/// static TREE: Mesh<'static> = Card::<16, 32>::STANDING;
/// const SIZE: Distance = Distance::lit("0.0625");
///
/// # fn tree(camera: &Camera, place: Vec3) -> Pose {
/// Pose::facing(camera, place).scaled(SIZE)
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Card<const W: i16, const H: i16>;

impl<const W: i16, const H: i16> Card<W, H> {
    const CORNERS: [[i16; 3]; 4] = {
        assert!(W > 0 && H > 0, "a card has a width and a height");
        // In half units.
        [[-W, -H, 0], [W, -H, 0], [W, H, 0], [-W, H, 0]]
    };
    const ABOVE: [[i16; 3]; 4] = {
        assert!(W > 0 && H > 0 && H <= i16::MAX / 2, "a card has a width and a height");
        [[-W, 0, 0], [W, 0, 0], [W, 2 * H, 0], [-W, 2 * H, 0]]
    };

    const fn of(positions: &'static [[i16; 3]; 4]) -> Mesh<'static> {
        const ONE: i16 = 1 << 14;
        Mesh::new_const(Tables {
            positions: Positions::I16(positions),
            scale: crate::numbers::Scale::new(1, -1),
            texture_coordinates: TextureCoordinates::I16(&[[0, ONE], [ONE, ONE], [ONE, 0], [0, 0]]),
            triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
            materials: const { &[Material::new([255; 3], 2)] },
            ..Tables::EMPTY
        })
    }

    /// With its middle at the origin.
    pub const CENTERED: Mesh<'static> = Self::of(&Self::CORNERS);

    /// With the middle of its lower side at the origin: for what stands on the ground.
    pub const STANDING: Mesh<'static> = Self::of(&Self::ABOVE);
}
