//! The pixels of particles.

use super::Outcome;
use crate::{
    color::{Alpha, Composite},
    geometry::Particle,
    numbers::{S4, Subpixel, divide},
    texture::{Layer, Table, TexelMap as _, Texture, Wrap},
};

/// What a particle looks like. [`Squares`] and [`Frames`] are such; a program can have its own:
///
/// ```
/// use rasterizer::{geometry::Particle, shade::{Layer, Sprite}};
/// # use embedded_graphics_core::pixelcolor::Rgb565;
/// # use rasterizer::color::Alpha;
///
/// /// A disc, without a texture.
/// #[derive(Clone, Copy)]
/// struct Discs;
///
/// impl Sprite<Rgb565> for Discs {
///     type Outcome = Option<Rgb565>;
///
///     fn pixels(
///         self,
///         particle: Particle<Rgb565>,
///         side: u32,
///     ) -> impl Fn([u32; 2]) -> Option<Rgb565> + Copy {
///         let (radius, color) = (side as i32 / 2, particle.color);
///         move |place| {
///             let [x, y] = place.map(|c| c as i32 - radius);
///             (x * x + y * y < radius * radius).then_some(color)
///         }
///     }
/// }
/// ```
pub trait Sprite<C>: Copy {
    /// The result for a pixel: see [`Shader::Outcome`](super::Shader::Outcome).
    type Outcome: Outcome<C>;

    /// Returns the function for the pixels of a particle whose sides are so long on the screen, in
    /// 16ths of a pixel, from 16 to 2<sup>15</sup>. It takes how far a pixel's centre lies to the
    /// right of the square's left side and below its upper one: from 0 to less than the side.
    fn pixels(self, particle: Particle<C>, side: u32) -> impl Fn([u32; 2]) -> Self::Outcome + Copy;
}

/// Squares in the particles' colours and alphas.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Squares;

impl<C: Copy> Sprite<C> for Squares {
    type Outcome = Layer<C>;

    #[inline(always)]
    fn pixels(self, particle: Particle<C>, _: u32) -> impl Fn([u32; 2]) -> Layer<C> + Copy {
        let layer = Layer::new(particle.color, particle.alpha);
        move |_| layer
    }
}

/// Pictures: each particle shows the one that its [`frame`](Particle::frame) tells, with its alpha;
/// one whose frame there is not is invisible. Its colour is not read ([`tinted`](Self::tinted)).
///
/// A pixel has the texel that its centre lies on: within 2<sup>-7</sup> texel, or
/// 2<sup>-17</sup> of the length of the square's side in pixels if that is more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frames<'a, T> {
    pictures: &'a [T],
}

impl<'a, F, const W: usize, const H: usize, X, Y> Frames<'a, Texture<F, W, H, X, Y>> {
    /// These pictures, of any format of texels.
    #[must_use]
    pub const fn new(pictures: &'a [Texture<F, W, H, X, Y>]) -> Self {
        Self { pictures }
    }

    /// The same, each channel times that of the particle's colour: white leaves a picture as it is.
    #[must_use]
    pub const fn tinted(self) -> TintedFrames<'a, Texture<F, W, H, X, Y>> {
        TintedFrames { frames: self }
    }
}

impl<'a, F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap>
    Frames<'a, Texture<F, W, H, X, Y>>
{
    /// The layers of a particle's pixels, with the colour of a texel changed.
    #[inline(always)]
    fn layers<C: Copy>(
        self,
        particle: Particle<F::Color>,
        side: u32,
        change: impl Fn(F::Color) -> C + Copy,
        invisible: C,
    ) -> impl Fn([u32; 2]) -> Layer<C> + Copy {
        let texture = self.pictures.get(usize::from(particle.frame));
        let alpha = particle.alpha;
        // Texels for a 16th of a pixel. A place is less than the side, so that no product reaches
        // the texture's width: 2^30 at most.
        let [across, down] =
            [W, H].map(|texels| divide((texels as u32) << STEP_BITS, side.max(1 << S4::BITS)));
        move |[x, y]| {
            let (column, row) = ((x * across) >> STEP_BITS, (y * down) >> STEP_BITS);
            let texel = texture
                .and_then(|texture| texture.texel(row as usize * W + column as usize).layer());
            match texel {
                Some((color, texel_alpha)) => {
                    let alpha = if F::Texel::HAS_ALPHA { texel_alpha.scaled(alpha) } else { alpha };
                    Layer::new(change(color), alpha)
                }
                None => Layer::new(invisible, Alpha::CLEAR),
            }
        }
    }
}

/// Bits behind the point of texels for a 16th of a pixel.
const STEP_BITS: u32 = 20;

impl<F: Table, const W: usize, const H: usize, X: Wrap, Y: Wrap> Sprite<F::Color>
    for Frames<'_, Texture<F, W, H, X, Y>>
{
    type Outcome = Layer<F::Color>;

    #[inline(always)]
    fn pixels(
        self,
        particle: Particle<F::Color>,
        side: u32,
    ) -> impl Fn([u32; 2]) -> Layer<F::Color> + Copy {
        self.layers(particle, side, |color| color, particle.color)
    }
}

/// [`Frames`] in the particles' colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TintedFrames<'a, T> {
    frames: Frames<'a, T>,
}

impl<F: Table<Color: Composite>, const W: usize, const H: usize, X: Wrap, Y: Wrap> Sprite<F::Color>
    for TintedFrames<'_, Texture<F, W, H, X, Y>>
{
    type Outcome = Layer<F::Color>;

    #[inline(always)]
    fn pixels(
        self,
        particle: Particle<F::Color>,
        side: u32,
    ) -> impl Fn([u32; 2]) -> Layer<F::Color> + Copy {
        let tint = particle.color;
        let tinted = move |color: F::Color| tint.multiply(color, Alpha::OPAQUE);
        self.frames.layers(particle, side, tinted, tint)
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics_core::pixelcolor::{Gray8, Rgb565, RgbColor as _};

    use super::*;
    use crate::{
        camera::Distance,
        numbers::Vec3,
        texture::{Clamp, Colors, Keyed},
    };

    fn particle<C>(color: C, alpha: u16, frame: u16) -> Particle<C> {
        let particle = Particle::new(Vec3::ZERO, Distance::ONE, color);
        Particle { alpha: Alpha::from_bits(alpha), frame, ..particle }
    }

    /// All places of squares of many sizes, against exact fractions. A texel whose border is within
    /// the bound may also be its neighbour.
    #[test]
    fn pixels_have_the_texel_below_them() {
        static TEXELS: [u16; 37 * 3] = {
            let (mut texels, mut i) = ([0; 37 * 3], 0);
            while i < 37 * 3 {
                texels[i] = i as u16;
                i += 1;
            }
            texels
        };
        type Sheet = Texture<Colors<'static, u16, { 37 * 3 }>, 37, 3, Clamp, Clamp>;
        static SHEET: [Sheet; 1] = [Texture::new(Colors::new(&TEXELS))];
        for side in [16, 17, 100, 591, 592, 593, 5000, 32_767, 32_768] {
            let pixels = Frames::new(&SHEET).pixels(particle(0, 256, 0), side);
            let bound = (f64::from(side) / 16.0 * 2f64.powi(-17)).max(2f64.powi(-7));
            for x in 0..side {
                let y = (x * 7 + 3) % side;
                let exact = [(x, 37.0), (y, 3.0)]
                    .map(|(c, texels)| f64::from(c) / f64::from(side) * texels);
                let got = pixels([x, y]).color;
                let texel = [got % 37, got / 37].map(f64::from);
                for (exact, texel) in exact.into_iter().zip(texel) {
                    let is_there = texel <= exact && exact < texel + 1.0 + bound;
                    assert!(is_there, "{side} {x} {y}: {exact} {texel}");
                }
            }
        }
    }

    #[test]
    fn alphas_multiply_and_missing_frames_are_invisible() {
        type Dots = Texture<Keyed<Colors<'static, Gray8, 2>>, 2, 1, Clamp, Clamp>;
        static DOTS: [Dots; 1] =
            [Texture::new(Keyed::new(Colors::new(&[Gray8::new(0), Gray8::new(9)]), Gray8::new(0)))];
        let frames = Frames::new(&DOTS);
        let layers = |alpha, frame| {
            let pixels = frames.pixels(particle(Gray8::new(1), alpha, frame), 32);
            [0, 16].map(|x| pixels([x, 0]).layer())
        };
        assert_eq!(layers(100, 0), [None, Some((Gray8::new(9), Alpha::from_bits(100)))]);
        assert_eq!(layers(100, 1), [None; 2]);
        assert_eq!(layers(0, 0), [None; 2]);
    }

    #[test]
    fn a_tint_multiplies_channels() {
        type Dot = Texture<Colors<'static, Rgb565, 1>, 1, 1, Clamp, Clamp>;
        static DOT: [Dot; 1] = [Texture::new(Colors::new(&[Rgb565::new(20, 40, 31)]))];
        let tinted = |color| {
            let pixels = Frames::new(&DOT).tinted().pixels(particle(color, 256, 0), 16);
            pixels([8, 8]).color
        };
        assert_eq!(tinted(Rgb565::WHITE), Rgb565::new(20, 40, 31));
        // 20 * 10 / 31 = 6.45, 40 * 32 / 63 = 20.3.
        assert_eq!(tinted(Rgb565::new(10, 32, 0)), Rgb565::new(6, 20, 0));
    }
}
