//! How light a surface is.

use super::camera::dot;

/// A distant light and an even background: Lambert's cosine law.
///
/// A caller shades with it in any way: from the normal of each face (flat), or from the normal of
/// each vertex with the level as a varying (Gouraud, "Continuous shading of curved surfaces", IEEE
/// Transactions on Computers C-20(6), 1971).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Direction from the surface to the light: a unit vector in world space.
    pub toward: [f64; 3],
    /// Level of a surface that is turned away from the light, within 0..=1.
    pub ambient: f64,
    /// What a surface square to the light gains, within 0..=1.
    pub diffuse: f64,
}

impl Light {
    /// The light level of a surface with the unit normal `normal` in world space:
    /// `ambient + diffuse * max(0, normal · toward)`, limited to 0..=1.
    #[must_use]
    pub const fn level(&self, normal: [f64; 3]) -> f64 {
        (self.ambient + self.diffuse * dot(normal, self.toward).max(0.0)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIGHT: Light = Light { toward: [0.0, 0.6, 0.8], ambient: 0.25, diffuse: 0.5 };

    #[test]
    fn the_level_follows_the_cosine() {
        assert_eq!(LIGHT.level([0.0, 0.6, 0.8]), 0.75);
        assert_eq!(LIGHT.level([0.0, 0.0, 1.0]), 0.25 + 0.5 * 0.8);
        assert_eq!(LIGHT.level([1.0, 0.0, 0.0]), 0.25);
    }

    #[test]
    fn a_surface_turned_away_keeps_the_ambient_level() {
        assert_eq!(LIGHT.level([0.0, -0.6, -0.8]), 0.25);
        assert_eq!(LIGHT.level([0.0, 0.0, -1.0]), 0.25);
    }

    #[test]
    fn the_level_stays_within_zero_and_one() {
        let too_bright = Light { ambient: 0.75, diffuse: 0.75, ..LIGHT };
        assert_eq!(too_bright.level(LIGHT.toward), 1.0);
        let too_dark = Light { ambient: -0.5, diffuse: 0.25, ..LIGHT };
        assert_eq!(too_dark.level(LIGHT.toward), 0.0);
    }
}
