//! Several lights, near and far, with highlights.

use super::camera::{dot, subtract};

/// What lights a scene, white.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lights {
    /// The level from everywhere.
    pub ambient: f64,
    /// Lights that are infinitely far away.
    pub suns: Vec<Sun>,
    /// Lights at points.
    pub lamps: Vec<Lamp>,
}

/// A light that is infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// The direction towards it: a unit vector in world space.
    pub toward: [f64; 3],
    /// The level of a surface square to it.
    pub level: f64,
}

/// A light at a point. At the distance d its level is `level / (1 + (d / half)²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// In world space.
    pub position: [f64; 3],
    /// Where the level is half of that near the lamp.
    pub half: f64,
    /// The level close to it.
    pub level: f64,
}

/// Where the viewer is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewer {
    /// At a point in world space.
    At([f64; 3]),
    /// Infinitely far away, in the direction of this unit vector.
    Toward([f64; 3]),
}

impl Viewer {
    /// The direction from a point to the viewer.
    #[must_use]
    pub fn direction(&self, from: [f64; 3]) -> [f64; 3] {
        match *self {
            Self::At(eye) => unit(subtract(eye, from)),
            Self::Toward(toward) => toward,
        }
    }
}

impl Lights {
    /// The direction towards each light from a point, and its level there.
    fn at(&self, position: [f64; 3]) -> impl Iterator<Item = ([f64; 3], f64)> {
        let suns = self.suns.iter().map(|sun| (sun.toward, sun.level));
        suns.chain(self.lamps.iter().map(move |lamp| {
            let way = subtract(lamp.position, position);
            let ratio = dot(way, way) / (lamp.half * lamp.half);
            (unit(way), lamp.level / (1.0 + ratio))
        }))
    }

    /// Lambert's law: the ambient level and, for each light, `level * max(0, n · l)`, at most 1.
    #[must_use]
    pub fn diffuse(&self, position: [f64; 3], normal: [f64; 3]) -> f64 {
        let direct = self.at(position).map(|(toward, level)| level * dot(normal, toward).max(0.0));
        (self.ambient + direct.sum::<f64>()).clamp(0.0, 1.0)
    }

    /// Blinn's highlights (*Models of light reflection for computer synthesized pictures*,
    /// SIGGRAPH 1977): for each light `level * max(0, n · h)^exponent` with h halfway between the
    /// directions towards light and viewer, at most 1.
    #[must_use]
    pub fn specular(
        &self,
        position: [f64; 3],
        normal: [f64; 3],
        viewer: [f64; 3],
        exponent: f64,
    ) -> f64 {
        let of = |(toward, level): ([f64; 3], f64)| {
            let half = unit([0, 1, 2].map(|i| toward[i] + viewer[i]));
            level * dot(normal, half).max(0.0).powf(exponent)
        };
        self.at(position).map(of).sum::<f64>().min(1.0)
    }
}

/// What light shows of a surface: the `Kd`, `Ks`, `Ns` and `Ke` of an MTL file, with colours from 0
/// to 255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// The colour in full light.
    pub diffuse: [f64; 3],
    /// The colour of highlights.
    pub specular: [f64; 3],
    /// How small they are.
    pub exponent: f64,
    /// The light that it gives off.
    pub emission: [f64; 3],
}

impl Finish {
    /// The colour at these levels, in stored values: `Ke + Kd diffuse + Ks specular`, at most 255.
    #[must_use]
    pub fn color(&self, diffuse: f64, specular: f64) -> [f64; 3] {
        [0, 1, 2].map(|i| {
            let sum = self.emission[i] + self.diffuse[i] * diffuse + self.specular[i] * specular;
            sum.min(255.0)
        })
    }
}

/// The unit vector of a direction; zero for zero, so that a light on a surface does not light it.
fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    if length > 0.0 { v.map(|c| c / length) } else { v }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: [f64; 3] = [0.0, 1.0, 0.0];

    fn lights() -> Lights {
        Lights {
            ambient: 0.125,
            suns: vec![
                Sun { toward: [0.0, 0.6, 0.8], level: 0.25 },
                Sun { toward: [0.0, -1.0, 0.0], level: 0.5 },
            ],
            lamps: vec![Lamp { position: [0.0, 3.0, 4.0], half: 5.0, level: 0.5 }],
        }
    }

    /// Ambient light and one sun.
    fn one(ambient: f64, level: f64) -> Lights {
        let sun = Sun { toward: [0.0, 0.6, 0.8], level };
        Lights { ambient, suns: vec![sun], lamps: vec![] }
    }

    #[test]
    fn the_level_follows_the_cosine() {
        let level = |normal| one(0.25, 0.5).diffuse([0.0; 3], normal);
        assert_eq!(level([0.0, 0.6, 0.8]), 0.75);
        assert_eq!(level([0.0, 0.0, 1.0]), 0.25 + 0.5 * 0.8);
        assert_eq!(level([1.0, 0.0, 0.0]), 0.25);
    }

    #[test]
    fn a_surface_turned_away_keeps_the_ambient_level() {
        assert_eq!(one(0.25, 0.5).diffuse([0.0; 3], [0.0, -0.6, -0.8]), 0.25);
    }

    #[test]
    fn the_level_stays_within_zero_and_one() {
        assert_eq!(one(0.75, 0.75).diffuse([0.0; 3], [0.0, 0.6, 0.8]), 1.0);
        assert_eq!(one(-0.5, 0.25).diffuse([0.0; 3], [0.0, -0.6, -0.8]), 0.0);
    }

    #[test]
    fn levels_of_all_lights_add_up() {
        // The first sun at 53 degrees; the second is below. The lamp is 5 away: half of it.
        let want = 0.125 + 0.25 * 0.6 + 0.5 / 2.0 * 0.6;
        assert!((lights().diffuse([0.0; 3], UP) - want).abs() < 1e-15);
        // From below only the second sun.
        assert!((lights().diffuse([0.0; 3], [0.0, -1.0, 0.0]) - 0.625).abs() < 1e-15);
        let bright = Lights { ambient: 0.9, ..lights() };
        assert_eq!(bright.diffuse([0.0; 3], UP), 1.0);
    }

    #[test]
    fn a_lamp_falls_off_with_the_square_of_the_distance() {
        let lamp = Lamp { position: [0.0, 2.0, 0.0], half: 1.0, level: 1.0 };
        let lights = Lights { lamps: vec![lamp], ..Lights::default() };
        for (height, level) in [(2.0 - 1e-9, 1.0), (1.0, 0.5), (0.0, 0.2), (-1.0, 0.1)] {
            assert!((lights.diffuse([0.0, height, 0.0], UP) - level).abs() < 1e-8, "{height}");
        }
        assert_eq!(lights.diffuse([0.0, 2.0, 0.0], UP), 0.0);
        assert_eq!(lights.diffuse([0.0, 3.0, 0.0], UP), 0.0);
    }

    #[test]
    fn highlights_are_brightest_in_the_mirror_direction() {
        let sun = Sun { toward: [0.0, 0.6, 0.8], level: 0.5 };
        let lights = Lights { suns: vec![sun], ..Lights::default() };
        // The mirrored direction: h is the normal.
        let viewer = Viewer::Toward([0.0, 0.6, -0.8]).direction([9.0; 3]);
        assert!((lights.specular([0.0; 3], UP, viewer, 50.0) - 0.5).abs() < 1e-15);
        // The viewer beside the light: h is the light's direction, at 53 degrees.
        let viewer = Viewer::At([0.0, 6.0, 8.0]).direction([0.0; 3]);
        let level = lights.specular([0.0; 3], UP, viewer, 3.0);
        assert!((level - 0.5 * 0.6f64.powi(3)).abs() < 1e-15);
        assert_eq!(lights.specular([0.0; 3], [0.0, -1.0, 0.0], viewer, 3.0), 0.0);
    }

    #[test]
    fn colours_add_up_to_white_at_most() {
        let finish = Finish {
            diffuse: [100.0, 200.0, 0.0],
            specular: [100.0, 255.0, 50.0],
            exponent: 1.0,
            emission: [10.0, 0.0, 0.0],
        };
        assert_eq!(finish.color(0.5, 0.25), [85.0, 163.75, 12.5]);
        assert_eq!(finish.color(1.0, 1.0), [210.0, 255.0, 50.0]);
    }
}
