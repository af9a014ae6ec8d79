//! Fog: how much of what lies at a distance it hides.
//!
//! OpenGL 2.1 specification, section 3.10: "linear" and "exponential", of the distance along the
//! viewing direction. There a factor of 1 leaves all of a colour; here an amount of 1 hides it.

/// A law of fog.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fog {
    /// None up to the start, all from the end on, evenly more in between.
    Linear {
        /// The distance at which it begins.
        start: f64,
        /// The distance from which on it hides everything.
        end: f64,
    },
    /// A constant part of the rest for each unit of distance.
    Exponential {
        /// That part, for thin fog.
        density: f64,
    },
}

impl Fog {
    /// The amount at a distance, from 0 to 1.
    #[must_use]
    pub fn amount(&self, distance: f64) -> f64 {
        match *self {
            Self::Linear { start, end } => ((distance - start) / (end - start)).clamp(0.0, 1.0),
            Self::Exponential { density } => 1.0 - (-density * distance).exp(),
        }
    }
}

/// A colour behind an amount of fog.
#[must_use]
pub fn fogged(color: [f64; 3], fog: [f64; 3], amount: f64) -> [f64; 3] {
    [0, 1, 2].map(|channel| color[channel] + (fog[channel] - color[channel]) * amount)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_by_hand() {
        let linear = Fog::Linear { start: 2.0, end: 10.0 };
        let at = [0.0, 2.0, 4.0, 6.0, 10.0, 1e9].map(|distance| linear.amount(distance));
        assert_eq!(at, [0.0, 0.0, 0.25, 0.5, 1.0, 1.0]);
        let exponential = Fog::Exponential { density: 0.5 };
        assert_eq!(exponential.amount(0.0), 0.0);
        // Half of the light after ln 2 / 0.5 units, and half of that after as many more.
        let half = 2f64.ln() / 0.5;
        assert!((exponential.amount(half) - 0.5).abs() < 1e-15);
        assert!((exponential.amount(2.0 * half) - 0.75).abs() < 1e-15);
    }

    #[test]
    fn colours_by_hand() {
        let mixed = fogged([200.0, 100.0, 0.0], [0.0, 100.0, 40.0], 0.25);
        assert_eq!(mixed, [150.0, 100.0, 10.0]);
    }
}
