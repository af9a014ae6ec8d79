//! What tables of fewer bits would cost in error, and save in flash. The core has none of them:
//! rounded values in its own formats show the same picture.

use anyhow::{Context as _, Result};
use host_tools::{
    check::{Shading, Truth, View, render},
    model::Model,
};
use serde::{Deserialize, Serialize};

use super::{errors::Errors, scenes::Scene};

/// A format of positions or of normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Format {
    /// Those of the library: 3 x 16 and 3 x 8 bits.
    Own,
    /// Positions of 3 x 8 bits.
    Positions8,
    /// Normals of 2 x 8 bits, as points of an octahedron that is folded out to a square.
    Octahedral8,
    /// The same with 2 x 4 bits.
    Octahedral4,
}

/// The errors of the default choice with a format, in colours of 8 bits a channel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Narrow {
    pub(super) format: Format,
    /// The bytes of flash that the tables of the model take less.
    pub(super) saved: usize,
    pub(super) rms: f64,
    pub(super) rms_inside: f64,
    pub(super) max: f64,
}

/// The errors of all formats against the true pictures of a scene.
///
/// # Errors
///
/// Returns an error if the core cannot draw the scene.
pub(super) fn of(scene: &Scene, model: &Model, truths: &[Truth]) -> Result<Vec<Narrow>> {
    let of_format = |format: Format| {
        let model = format.rounded(model);
        let picture = |frame| -> Result<_> {
            let view = View { shading: Shading::of(&model), ..scene.view(frame) };
            let picture = render(&model, &view).context("the scene")?;
            Ok(picture.pixels.iter().flat_map(|pixel| pixel.color).collect())
        };
        let pictures = (0..scene.frames).map(picture).collect::<Result<Vec<Vec<u8>>>>()?;
        let errors = Errors::of(pictures.iter().zip(truths)).context("the scene shows nothing")?;
        Ok(Narrow {
            format,
            saved: format.bytes_saved() * model.positions.len(),
            rms: errors.rms,
            rms_inside: errors.rms_inside,
            max: errors.max,
        })
    };
    Format::ALL.into_iter().map(of_format).collect()
}

impl Format {
    const ALL: [Self; 4] = [Self::Own, Self::Positions8, Self::Octahedral8, Self::Octahedral4];

    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Own => "those of the library",
            Self::Positions8 => "positions of 8 bits",
            Self::Octahedral8 => "octahedral normals of 2 x 8 bits",
            Self::Octahedral4 => "octahedral normals of 2 x 4 bits",
        }
    }

    /// What a vertex takes less: of the 6 bytes of a position, and the 3 of a normal.
    const fn bytes_saved(self) -> usize {
        match self {
            Self::Own => 0,
            Self::Positions8 => 3,
            Self::Octahedral8 => 1,
            Self::Octahedral4 => 2,
        }
    }

    /// A model with the values of this format in its own tables.
    fn rounded(self, model: &Model) -> Model {
        let mut model = model.clone();
        let exact = &model.exact.vertex_normals;
        let octahedral = |most| exact.iter().map(|&normal| octahedral(normal, most)).collect();
        match self {
            Self::Own => {}
            Self::Positions8 => {
                model.positions.as_flattened_mut().iter_mut().for_each(|c| *c = eight_bits(*c));
            }
            Self::Octahedral8 => model.vertex_normals = octahedral(127),
            Self::Octahedral4 => model.vertex_normals = octahedral(7),
        }
        model
    }
}

/// The nearest of 255 steps. The largest coordinate of a model is 32,767.
fn eight_bits(coordinate: i16) -> i16 {
    const STEP: f64 = 258.0;
    ((f64::from(coordinate) / STEP).round() * STEP) as i16
}

/// A unit normal in 127ths, after it was stored as two numbers from -`most` to `most`: the place on
/// an octahedron, |x| + |y| + |z| = 1, whose lower half is folded over the upper one. Of the four
/// pairs round that place, it is the one of the least angle (Cigolle et al., *A Survey of Efficient
/// Representations for Independent Unit Vectors*, JCGT 2014).
fn octahedral(normal: [f64; 3], most: i32) -> [i8; 3] {
    let most = f64::from(most);
    let length = normal.iter().map(|c| c.abs()).sum::<f64>();
    let [x, y, z] = normal.map(|c| c / length);
    let place = (if z < 0.0 { folded([x, y]) } else { [x, y] }).map(|c| (c * most).floor());
    let mut best = (f64::NEG_INFINITY, [0.0; 3]);
    for [right, up] in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]] {
        let pair = [place[0] + right, place[1] + up].map(|c| c.min(most) / most);
        let found = unfolded(pair);
        let cosine = (0..3).map(|i| found[i] * normal[i]).sum();
        if cosine > best.0 {
            best = (cosine, found);
        }
    }
    best.1.map(|c| (c * 127.0).round() as i8)
}

/// Takes the lower half of the octahedron to the corners of the square, and back.
fn folded([x, y]: [f64; 2]) -> [f64; 2] {
    [(1.0 - y.abs()).copysign(x), (1.0 - x.abs()).copysign(y)]
}

/// The unit vector of a place in the square.
fn unfolded([x, y]: [f64; 2]) -> [f64; 3] {
    let z = 1.0 - x.abs() - y.abs();
    let [x, y] = if z < 0.0 { folded([x, y]) } else { [x, y] };
    let length = (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|c| c / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_within_half_a_step() {
        let mut found = Vec::new();
        for coordinate in -32_767..=32_767 {
            let rounded = eight_bits(coordinate);
            assert!((i32::from(rounded) - i32::from(coordinate)).abs() <= 129, "{coordinate}");
            found.push(rounded);
        }
        found.dedup();
        assert_eq!(found.len(), 255);
    }

    /// A step of the square is 1 / `most`. Half its diagonal is at most the root of 3/2 steps on
    /// the octahedron, and no point of that is nearer to the middle than the root of 1/3: a normal
    /// is turned by at most the root of 9/2 steps.
    #[test]
    fn normals_are_near_on_all_sides() {
        for most in [127, 7] {
            let mut worst = 0f64;
            for (i, j) in (0..60).flat_map(|i| (0..120).map(move |j| (i, j))) {
                let (tilt, turn) = ((f64::from(i) + 0.5) / 60.0, f64::from(j) / 60.0);
                let ((ring, z), (sine, cosine)) = (
                    (tilt * std::f64::consts::PI).sin_cos(),
                    (turn * std::f64::consts::PI).sin_cos(),
                );
                let normal = [ring * cosine, ring * sine, z];
                let found = octahedral(normal, most).map(|c| f64::from(c) / 127.0);
                let off = (0..3).map(|i| (found[i] - normal[i]).powi(2)).sum::<f64>().sqrt();
                worst = worst.max(off);
            }
            // With the rounding to 127ths.
            let bound = 4.5f64.sqrt() / f64::from(most) + 0.75f64.sqrt() / 127.0;
            assert!(worst <= bound && worst > bound / 4.0, "{most}: {worst} of {bound}");
        }
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let mut normal = [0.0; 3];
                normal[axis] = sign;
                assert_eq!(octahedral(normal, 7), normal.map(|c| (c * 127.0) as i8));
            }
        }
    }
}
