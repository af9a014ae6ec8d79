//! The choices that are compared: each is one program, and one picture.

use serde::{Deserialize, Serialize};

/// How light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Shading {
    Flat,
    Gouraud,
    Phong,
}

/// How texture coordinates are corrected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Correction {
    Affine,
    /// Exact at every N-th pixel of a span.
    Every(u32),
    /// Within a tolerance, in sixteenths of a texel.
    Adaptive(u32),
    EveryPixel,
}

/// How a colour is taken from a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Filter {
    Nearest,
    Bilinear,
    /// The nearest texel of a mip level for each triangle.
    Mipmap,
    /// Between texels and levels.
    Trilinear,
}

/// What decides which surface is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Visibility {
    U16,
    U32,
    Float16,
    /// Triangles from back to front, without depth.
    Painter,
}

/// The colours of a display.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Color {
    Rgb565,
    Rgb888,
    Rgb332,
}

/// The numbers that a picture is computed in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Arithmetic {
    /// Those of the library.
    #[default]
    Fixed,
    /// `f32`, by a rasterizer for comparison: Gouraud shading with depth, also in `f32`, and with
    /// colours computed for each pixel. Textures have the levels of light of the library.
    Float,
    /// The same with colours of 64 levels, as the library has them.
    FloatLevels,
}

/// One way to draw a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Choice {
    /// With floating-point numbers, the parts below are those of the default, but for the
    /// correction.
    #[serde(default)]
    pub(super) arithmetic: Arithmetic,
    /// Bits of a pixel behind the point: 4 or 8.
    pub(super) subpixel: u32,
    pub(super) visibility: Visibility,
    pub(super) shading: Shading,
    /// How the texture is drawn, if there is one.
    pub(super) texture: Option<(Correction, Filter)>,
    pub(super) color: Color,
    pub(super) is_dithered: bool,
    /// Samples along a side of a pixel: 1, 2 or 4.
    pub(super) samples: u32,
}

/// What the library and the tools take unless told otherwise.
const DEFAULT: Choice = Choice {
    arithmetic: Arithmetic::Fixed,
    subpixel: 8,
    visibility: Visibility::U16,
    shading: Shading::Gouraud,
    texture: None,
    color: Color::Rgb565,
    is_dithered: false,
    samples: 1,
};

/// The same with a texture.
const DEFAULT_TEXTURED: Choice =
    Choice { texture: Some((Correction::Adaptive(8), Filter::Nearest)), ..DEFAULT };

/// A method, and its settings in order: a curve of the diagrams.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Method {
    pub(super) name: &'static str,
    pub(super) choices: Vec<Choice>,
}

/// Several samples a pixel by a choice.
fn sampled(choice: Choice) -> Vec<Choice> {
    [1, 2, 4].map(|samples| Choice { samples, ..choice }).into()
}

/// The methods for a model without textures.
pub(super) fn of_colors() -> Vec<Method> {
    let shaded = |shading| sampled(Choice { shading, ..DEFAULT });
    let seen = |visibility| Choice { visibility, ..DEFAULT };
    let colored = |(color, is_dithered)| Choice { color, is_dithered, ..DEFAULT };
    vec![
        Method { name: "flat, 1 to 16 samples", choices: shaded(Shading::Flat) },
        Method { name: "Gouraud, 1 to 16 samples", choices: shaded(Shading::Gouraud) },
        Method { name: "Phong, 1 to 16 samples", choices: shaded(Shading::Phong) },
        Method {
            name: "sub-pixels: S4, S8",
            choices: [4, 8].map(|subpixel| Choice { subpixel, ..DEFAULT }).into(),
        },
        Method {
            name: "painter, u16, float16, u32",
            choices: [Visibility::Painter, Visibility::U16, Visibility::Float16, Visibility::U32]
                .map(seen)
                .into(),
        },
        Method {
            name: "colours: RGB332 to RGB888",
            choices: [
                (Color::Rgb332, false),
                (Color::Rgb332, true),
                (Color::Rgb565, false),
                (Color::Rgb565, true),
                (Color::Rgb888, false),
            ]
            .map(colored)
            .into(),
        },
        Method {
            name: "f32, for comparison",
            choices: [Arithmetic::FloatLevels, Arithmetic::Float]
                .map(|arithmetic| Choice { arithmetic, ..DEFAULT })
                .into(),
        },
    ]
}

/// The methods for a model with a texture.
pub(super) fn of_texture() -> Vec<Method> {
    let textured =
        |correction, filter| Choice { texture: Some((correction, filter)), ..DEFAULT_TEXTURED };
    let nearest = Choice::corrected;
    let every = [64, 32, 16, 8, 4].map(|pixels| nearest(Correction::Every(pixels)));
    let adaptive =
        [64, 32, 16, 8, 4, 2].map(|sixteenths| nearest(Correction::Adaptive(sixteenths)));
    let filtered = |filter| textured(Correction::Adaptive(8), filter);
    vec![
        Method { name: "affine", choices: vec![nearest(Correction::Affine)] },
        Method { name: "every 64 to 4 pixels", choices: every.into() },
        Method { name: "adaptive, 4 to 1/8 texel", choices: adaptive.into() },
        Method { name: "every pixel", choices: vec![nearest(Correction::EveryPixel)] },
        Method {
            name: "nearest to trilinear",
            choices: [Filter::Nearest, Filter::Mipmap, Filter::Bilinear, Filter::Trilinear]
                .map(filtered)
                .into(),
        },
        Method { name: "nearest, 1 to 16 samples", choices: sampled(DEFAULT_TEXTURED) },
        Method {
            name: "trilinear, 1 to 16 samples",
            choices: sampled(filtered(Filter::Trilinear)),
        },
        Method {
            name: "flat, Gouraud",
            choices: [Shading::Flat, Shading::Gouraud]
                .map(|shading| Choice { shading, ..DEFAULT_TEXTURED })
                .into(),
        },
        Method {
            name: "sub-pixels: S4, S8",
            choices: [4, 8].map(|subpixel| Choice { subpixel, ..DEFAULT_TEXTURED }).into(),
        },
        Method {
            name: "f32, for comparison",
            choices: [Correction::Every(16), Correction::EveryPixel]
                .map(|correction| Choice { arithmetic: Arithmetic::Float, ..nearest(correction) })
                .into(),
        },
    ]
}

impl Correction {
    pub(super) fn name(self) -> String {
        match self {
            Self::Affine => "affine".into(),
            Self::Every(pixels) => format!("every-{pixels}"),
            Self::Adaptive(sixteenths) => format!("adaptive-{sixteenths}"),
            Self::EveryPixel => "every-pixel".into(),
        }
    }
}

impl Choice {
    /// Its name, of the parts by which choices differ.
    pub(super) fn name(&self) -> String {
        match (self.arithmetic, self.texture) {
            (Arithmetic::Float, Some((correction @ Correction::Every(_), _))) => {
                return format!("f32-{}", correction.name());
            }
            (Arithmetic::Float, _) => return "f32".into(),
            (Arithmetic::FloatLevels, _) => return "f32-levels".into(),
            (Arithmetic::Fixed, _) => {}
        }
        let mut parts = vec![format!("{:?}", self.shading).to_lowercase()];
        if let Some((correction, filter)) = self.texture {
            parts.push(correction.name());
            parts.push(format!("{filter:?}").to_lowercase());
        }
        parts.push(format!("s{}", self.subpixel));
        parts.push(format!("{:?}", self.visibility).to_lowercase());
        parts.push(format!("{:?}", self.color).to_lowercase());
        if self.is_dithered {
            parts.push("dithered".into());
        }
        if self.samples > 1 {
            parts.push(format!("{0}x{0}", self.samples));
        }
        parts.join("-")
    }

    /// Whether it reads mip levels.
    pub(super) fn has_mip_levels(&self) -> bool {
        let filter = self.texture.map(|(_, filter)| filter);
        matches!(filter, Some(Filter::Mipmap | Filter::Trilinear))
    }

    /// The choice that is otherwise the default, but corrects texture coordinates so.
    pub(super) const fn corrected(correction: Correction) -> Self {
        Self { texture: Some((correction, Filter::Nearest)), ..DEFAULT_TEXTURED }
    }

    /// Whether it is what the library and the tools take unless told otherwise.
    pub(super) fn is_default(&self) -> bool {
        [DEFAULT, DEFAULT_TEXTURED].contains(self)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn choices_have_names_of_their_own_and_the_default_is_one() {
        for methods in [of_colors(), of_texture()] {
            let all: Vec<_> = methods.into_iter().flat_map(|method| method.choices).collect();
            let mut distinct: Vec<Choice> = Vec::new();
            for choice in &all {
                if !distinct.contains(choice) {
                    distinct.push(*choice);
                }
            }
            let names: HashSet<_> = all.iter().map(Choice::name).collect();
            assert_eq!(names.len(), distinct.len());
            assert_eq!(distinct.iter().filter(|choice| choice.is_default()).count(), 1);
        }
    }

    #[test]
    fn a_name_has_what_a_choice_is() {
        let names = [DEFAULT, DEFAULT_TEXTURED].map(|choice| choice.name());
        assert_eq!(names, ["gouraud-s8-u16-rgb565", "gouraud-adaptive-8-nearest-s8-u16-rgb565"]);
        let samples = Choice { samples: 4, is_dithered: true, ..DEFAULT };
        assert_eq!(samples.name(), "gouraud-s8-u16-rgb565-dithered-4x4");
        let float = |correction| {
            let arithmetic = Arithmetic::Float;
            Choice { arithmetic, ..Choice::corrected(correction) }.name()
        };
        assert_eq!(float(Correction::Every(16)), "f32-every-16");
        assert_eq!(float(Correction::EveryPixel), "f32");
    }
}
