//! The colours of a material with highlights and with light of its own.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::Ramp;
use crate::{
    mesh::{Finish, MeshMaterial},
    numbers::at_most,
};

/// `Ke + Kd diffuse + Ks specular` in each channel, at most full, rounded to the nearest: by a ramp
/// where there is no highlight, which is at most pixels, and computed where there is one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Finished<C, const LEVELS: usize> {
    ramp: Ramp<C, LEVELS>,
    colors: Colors,
}

/// The colours that are added.
// codegen: in words, which take no instructions to unpack. Signed, so that one instruction can
// saturate a sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Colors {
    /// From 0 to 255.
    diffuse: [i32; 3],
    specular: [i32; 3],
    /// In Q16, and a half.
    emission: [i32; 3],
}

impl Colors {
    fn new(diffuse: Rgb888, specular: [u8; 3], emission: [u8; 3]) -> Self {
        Self {
            diffuse: [diffuse.r(), diffuse.g(), diffuse.b()].map(i32::from),
            specular: specular.map(i32::from),
            emission: emission.map(|own| (i32::from(own) << 16) + (1 << 15)),
        }
    }

    /// At levels in Q16, 0 to 65,536.
    #[inline(always)]
    fn at(&self, diffuse: u32, specular: u32) -> Rgb888 {
        let ([r, g, b], [rs, gs, bs], [re, ge, be]) = (self.diffuse, self.specular, self.emission);
        // Below 2^26.
        let channel = |own: i32, glossy: i32, emission: i32| {
            at_most::<8>((own * diffuse as i32 + glossy * specular as i32 + emission) >> 16) as u8
        };
        Rgb888::new(channel(r, rs, re), channel(g, gs, ge), channel(b, bs, be))
    }
}

impl<C: Copy + From<Rgb888>, const LEVELS: usize> Finished<C, LEVELS> {
    /// Of a material of the mesh.
    pub(super) fn new(material: &MeshMaterial<'_>, finish: &Finish) -> Self {
        let Finish { specular, emission, .. } = *finish;
        let colors = Colors::new(material.rgb(), specular, emission);
        // The step from level to level in Q24, within half a unit: levels are within 2^-9 of Q16.
        let step = const { ((1 << 24) + (LEVELS as u32 - 1) / 2) / (LEVELS as u32 - 1) };
        let level = |index: usize| (index as u32 * step + (1 << 7)) >> 8;
        Self { ramp: Ramp::from_fn(|index| colors.at(level(index), 0).into()), colors }
    }

    /// The colour at levels in Q16, 0 to 65,536.
    #[inline(always)]
    pub(super) fn at(&self, diffuse: u32, specular: u32) -> C {
        // Less than half a step of the brightest channel.
        if specular < 1 << 7 { self.ramp.nearest(diffuse) } else { self.sum(diffuse, specular) }
    }

    #[inline(always)]
    fn sum(&self, diffuse: u32, specular: u32) -> C {
        self.colors.at(diffuse, specular).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Material, Tables};

    #[test]
    fn channels_are_sums_that_stay_within_their_range() {
        let materials = [Material::new([200, 90, 0], 1)];
        let tables = Tables { materials: &materials, ..Tables::EMPTY };
        let finish = Finish::MATTE.with_specular([255, 40, 7], 9).with_emission([0, 100, 255]);
        let finished = Finished::<Rgb888, 256>::new(
            &MeshMaterial::new(&tables, (0, &tables.materials[0])),
            &finish,
        );
        for diffuse in (0..=65_536u32).step_by(511) {
            for specular in (0..=65_536u32).step_by(409) {
                let [d, s] = [diffuse, specular].map(|level| f64::from(level) / 65_536.0);
                let got = finished.at(diffuse, specular);
                for (got, want) in [
                    (got.r(), 200.0 * d + 255.0 * s),
                    (got.g(), 100.0 + 90.0 * d + 40.0 * s),
                    (got.b(), 255.0 + 7.0 * s),
                ] {
                    // Rounding; without a highlight also half a step of the ramp and of what is
                    // too dim to add.
                    let bound = if specular < 1 << 7 { 0.5 + 200.0 / 510.0 + 0.5 } else { 0.5 };
                    let error = (f64::from(got) - want.min(255.0)).abs();
                    assert!(error <= bound + 0.01, "{d} {s}: {got} {want}");
                }
            }
        }
    }
}
