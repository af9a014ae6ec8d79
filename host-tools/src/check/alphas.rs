//! The alphas of layers: by vertex, by texel, by material and by the view.

use rasterizer::{color::Alpha, mesh::MeshVertex};

use super::{
    Form,
    noted::Noted,
    view::{View, ViewError},
};
use crate::{model::Model, reference};

/// Along which axis of the model pixels fade: they are opaque at its lower end and clear at the
/// upper one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FadeAlong {
    /// Along none: all are opaque.
    #[default]
    None,
    /// Along x.
    X,
    /// Along y.
    Y,
    /// Along z.
    Z,
}

impl FadeAlong {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 4] =
        [("none", Self::None), ("x", Self::X), ("y", Self::Y), ("z", Self::Z)];

    const fn axis(self) -> Option<usize> {
        match self {
            Self::None => None,
            Self::X => Some(0),
            Self::Y => Some(1),
            Self::Z => Some(2),
        }
    }
}

/// The alpha of a vertex, as a program gives it to [`Faded`](rasterizer::shade::Faded).
#[derive(Clone, Copy, Debug)]
pub(super) struct Fading {
    /// The axis, and the lower and the upper end of the mesh along it in quanta.
    along: Option<(usize, [i16; 2])>,
}

impl Fading {
    /// That of a model in a view.
    pub(super) fn of(model: &Model, view: &View) -> Result<Self, ViewError> {
        let Some(axis) = view.fade.axis() else { return Ok(Self { along: None }) };
        let along = |positions: &[[i16; 3]]| {
            let all = || positions.iter().map(|position| position[axis]);
            let ends = [all().min().unwrap_or(0), all().max().unwrap_or(0)];
            Self { along: (ends[0] < ends[1]).then_some((axis, ends)) }
        };
        Ok(match view.form {
            Form::AsModelled => along(&model.positions),
            _ => along(&Noted::of(model, view)?.positions),
        })
    }

    /// The alpha by the position in quanta, rounded to a 256th.
    pub(super) fn alpha(&self, position: [i16; 3]) -> Alpha {
        let Some((axis, ends)) = self.along else { return Alpha::OPAQUE };
        let [low, high, at] = [ends[0], ends[1], position[axis]].map(i32::from);
        let whole = high - low;
        Alpha::from_bits(((512 * (high - at) + whole) / (2 * whole)) as u16)
    }

    /// The same as a shader takes it.
    pub(super) fn of_vertices(self) -> impl Fn(&MeshVertex<'_>) -> Alpha + Clone {
        move |vertex: &MeshVertex<'_>| self.alpha(vertex.position())
    }

    /// The definition, for positions in quanta; `None` if all is opaque.
    #[cfg(test)]
    fn definition(&self) -> Option<reference::Fade> {
        let (axis, [low, high]) = self.along?;
        Some(reference::Fade { axis, opaque: low.into(), clear: high.into() })
    }
}

/// Where the bound of a layer's alpha comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
#[cfg_attr(feature = "cli", serde(into = "&'static str"))]
pub struct AlphaBound;

impl From<AlphaBound> for &'static str {
    fn from(AlphaBound: AlphaBound) -> Self {
        "1/2 unit of 1/256 for each alpha that is rounded (of the vertex, the texel, the material, \
         the view), for each product of two, and for each mix of texels"
    }
}

/// How far the alpha of a layer is off, in units of 1/256.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct AlphaError {
    /// Column and row.
    pub pixel: [usize; 2],
    /// The triangle of the tables.
    pub triangle: usize,
    /// The difference.
    pub error_units: f64,
    /// How large it may be.
    pub bound_units: f64,
}

impl AlphaError {
    /// Whether it keeps its bound.
    #[must_use]
    pub fn is_within(&self) -> bool {
        self.error_units <= self.bound_units + 1e-9
    }
}

/// What the alpha of a layer is the product of, from 0 to 1 each. That of a texel lies in a range,
/// as its coordinate may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Factors {
    pub(super) vertex: f64,
    pub(super) texel: [f64; 2],
    pub(super) material: f64,
    pub(super) view: f64,
}

impl Factors {
    /// The least and the greatest alpha.
    fn products(&self) -> [f64; 2] {
        self.texel
            .map(|texel| reference::combined_alpha(&[self.vertex, texel, self.material, self.view]))
    }

    /// By how much an alpha may be off, in units of 1/256: those of 8 bits are within 0.502 units
    /// when they are rounded to such, and what is interpolated is off by less than a 64th.
    fn bound_units(&self) -> f64 {
        let [least, most] = self.texel;
        let are_rounded =
            [self.vertex < 1.0, least.min(most) < 1.0, self.material < 1.0, self.view < 1.0];
        let count = are_rounded.iter().filter(|&&is_rounded| is_rounded).count() as f64;
        if count == 0.0 { 0.0 } else { 0.502 * count + 0.5 * (count - 1.0) + 1.0 / 64.0 }
    }

    /// How far an alpha in units of 1/256 is off the nearest right one.
    pub(super) fn error(&self, units: f64, pixel: [usize; 2], triangle: usize) -> AlphaError {
        let [low, high] = self.products().map(|alpha| 256.0 * alpha);
        let error_units = (low - units).max(units - high).max(0.0);
        AlphaError { pixel, triangle, error_units, bound_units: self.bound_units() }
    }

    /// Whether a pixel that is drawn from half of the vertex's and the texel's alpha on may be
    /// drawn, and may be left out.
    pub(super) fn test(&self) -> [bool; 2] {
        let alone = Self { material: 1.0, view: 1.0, ..*self };
        let ([low, high], bound) = (alone.products().map(|a| 256.0 * a), alone.bound_units());
        [high + bound >= 127.5, low - bound < 128.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_have_the_alpha_of_the_definition() {
        let fading = Fading { along: Some((2, [-300, 777])) };
        let definition = fading.definition().unwrap();
        for z in -300..=777i16 {
            let exact = 256.0 * definition.alpha([1.0, 2.0, z.into()]);
            let got = f64::from(fading.alpha([1, 2, z]).to_bits());
            assert!((got - exact).abs() <= 0.5, "{z}: {got} {exact}");
        }
        assert_eq!([-300, 777].map(|z| fading.alpha([0, 0, z]).to_bits()), [256, 0]);
        assert_eq!(Fading { along: None }.alpha([0; 3]), Alpha::OPAQUE);
    }

    #[test]
    fn each_alpha_adds_to_the_bound() {
        let opaque = Factors { vertex: 1.0, texel: [1.0; 2], material: 1.0, view: 1.0 };
        assert_eq!((opaque.bound_units(), opaque.test()), (0.0, [true, false]));
        let error = |factors: Factors, units| factors.error(units, [0; 2], 0).error_units;
        assert_eq!([error(opaque, 256.0), error(opaque, 255.0)], [0.0, 1.0]);
        let both = Factors { vertex: 0.5, texel: [0.25, 0.5], ..opaque };
        assert!((1.5..1.53).contains(&both.bound_units()));
        assert_eq!(
            [31.0, 32.0, 50.0, 64.0, 66.0].map(|u| error(both, u)),
            [1.0, 0.0, 0.0, 0.0, 2.0]
        );
        assert_eq!(both.test(), [false, true]);
        assert_eq!(Factors { vertex: 0.5, ..opaque }.test(), [true, true]);
    }
}
