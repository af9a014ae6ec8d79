//! What a material shows besides its colour: highlights, its own light, and how opaque it is.

/// How a material's surface shines: the `Ks`, `Ns`, `Ke` and `d` of an MTL file.
///
/// Colours are red, green and blue, 0 to 255, as stored in pictures (sRGB). Shaders that do not
/// read a finish draw every material as [`MATTE`](Self::MATTE).
///
/// ```
/// use rasterizer::mesh::Finish;
///
/// const BRASS: Finish = Finish::MATTE.with_specular([255, 230, 160], 60);
/// const LAMP: Finish = Finish::MATTE.with_emission([255, 220, 120]);
/// const GLASS: Finish = Finish::MATTE.with_specular([255; 3], 200).with_opacity(90);
/// ```
// In the order of C, which is that of `blob`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, bytemuck::AnyBitPattern)]
#[repr(C)]
#[non_exhaustive]
pub struct Finish {
    /// The colour of highlights; black for none.
    pub specular: [u8; 3],
    /// How small highlights are, 1 to 1,000: the power of the cosine between the normal and the
    /// direction halfway between light and viewer.
    pub exponent: u16,
    /// The colour of the light that it gives off.
    pub emission: [u8; 3],
    /// 0 for transparent, 255 for opaque.
    pub opacity: u8,
}

impl Finish {
    /// No highlights, no light, opaque.
    pub const MATTE: Self = Self { specular: [0; 3], exponent: 1, emission: [0; 3], opacity: 255 };

    /// The largest exponent.
    pub const MOST_EXPONENT: u16 = 1000;

    /// The same with highlights of this colour. The `exponent` must be 1 to 1,000:
    /// [`Mesh::new`](super::Mesh::new) checks it.
    #[must_use]
    pub const fn with_specular(self, specular: [u8; 3], exponent: u16) -> Self {
        Self { specular, exponent, ..self }
    }

    /// The same with this light of its own.
    #[must_use]
    pub const fn with_emission(self, emission: [u8; 3]) -> Self {
        Self { emission, ..self }
    }

    /// The same with another opacity, 255 for opaque.
    #[must_use]
    pub const fn with_opacity(self, opacity: u8) -> Self {
        Self { opacity, ..self }
    }
}

impl Default for Finish {
    fn default() -> Self {
        Self::MATTE
    }
}
