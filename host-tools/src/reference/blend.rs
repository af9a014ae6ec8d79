//! Layers of a pixel over a background, blended in the order in which they are drawn.

/// How a layer changes the colour behind it. With the stored channel s and the layer's n from 0 to
/// 1, and an alpha a:
///
/// | mode | result |
/// |---|---|
/// | over | s + (n - s) a |
/// | add | s + n a, at most 1 |
/// | multiply | s (1 - a (1 - n)) |
/// | screen | s + a n (1 - s) |
/// | replace | n |
///
/// On an opaque background these are the source-over, plus, multiply and screen of the W3C's
/// Compositing and Blending Level 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    /// The layer hides the stored colour by its alpha.
    Over,
    /// The layer's light is added.
    Add,
    /// The stored colour is seen through the layer's.
    Multiply,
    /// The layer's light is added, the less the brighter the stored colour is.
    Screen,
    /// The layer hides the stored colour, with any alpha: the painter's algorithm.
    Replace,
}

/// A layer: red, green and blue in 0..=255, and an alpha from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Its colour, not multiplied by the alpha.
    pub color: [f64; 3],
    /// How much of it is put onto what is behind.
    pub alpha: f64,
}

/// The alpha of a layer that several things make translucent: each lets its part of what is behind
/// it be covered, so that they multiply.
#[must_use]
pub fn combined_alpha(alphas: &[f64]) -> f64 {
    alphas.iter().product()
}

impl Blend {
    /// Returns a stored colour with a layer on it.
    #[must_use]
    pub fn put(self, stored: [f64; 3], layer: Layer) -> [f64; 3] {
        let a = layer.alpha;
        std::array::from_fn(|channel| {
            let [s, n] = [stored[channel], layer.color[channel]].map(|c| c / 255.0);
            255.0
                * match self {
                    Self::Over => s + (n - s) * a,
                    Self::Add => (s + n * a).min(1.0),
                    Self::Multiply => s * (1.0 - a * (1.0 - n)),
                    Self::Screen => s + a * n * (1.0 - s),
                    Self::Replace => n,
                }
        })
    }

    /// Returns a background with layers on it, the first one lowest.
    #[must_use]
    pub fn put_all(self, background: [f64; 3], layers: &[Layer]) -> [f64; 3] {
        layers.iter().fold(background, |stored, &layer| self.put(stored, layer))
    }

    /// By how much of a small change of the stored channel the result changes: the derivative of
    /// [`put`](Self::put), where a sum does not exceed white.
    #[must_use]
    pub fn passes(self, layer: Layer, channel: usize) -> f64 {
        let (n, a) = (layer.color[channel] / 255.0, layer.alpha);
        match self {
            Self::Over => 1.0 - a,
            Self::Add => 1.0,
            Self::Multiply => 1.0 - a * (1.0 - n),
            Self::Screen => 1.0 - a * n,
            Self::Replace => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    const ALL: [Blend; 4] = [Blend::Over, Blend::Add, Blend::Multiply, Blend::Screen];

    /// A few roundings of values up to 255.
    const ROUNDING: f64 = 1e-12;

    fn grey(value: f64, alpha: f64) -> Layer {
        Layer { color: [value; 3], alpha }
    }

    #[test]
    fn colors_without_effect_have_none() {
        for stored in [0.0, 10.0, 200.0, 255.0] {
            let left = |blend: Blend, layer| {
                let [red, ..] = blend.put([stored; 3], layer);
                assert!((red - stored).abs() < ROUNDING, "{blend:?} {layer:?}: {red}");
            };
            for blend in ALL {
                left(blend, grey(77.0, 0.0));
            }
            left(Blend::Over, grey(stored, 0.5));
            left(Blend::Add, grey(0.0, 1.0));
            left(Blend::Multiply, grey(255.0, 1.0));
            left(Blend::Screen, grey(0.0, 1.0));
        }
    }

    #[test]
    fn known_results() {
        let put = |blend: Blend, stored, layer| blend.put([stored; 3], layer)[0];
        assert_eq!(put(Blend::Over, 100.0, grey(200.0, 0.25)), 125.0);
        assert_eq!(put(Blend::Add, 100.0, grey(200.0, 0.25)), 150.0);
        assert_eq!(put(Blend::Add, 200.0, grey(200.0, 0.5)), 255.0);
        assert!((put(Blend::Replace, 100.0, grey(51.0, 0.0)) - 51.0).abs() < ROUNDING);
        assert!((put(Blend::Multiply, 100.0, grey(51.0, 1.0)) - 20.0).abs() < ROUNDING);
        assert!((put(Blend::Screen, 51.0, grey(51.0, 1.0)) - 91.8).abs() < ROUNDING);
    }

    /// Screen is multiply of the negatives.
    #[test]
    fn screen_is_multiply_in_the_negative() {
        let mut random = Random(41);
        for _ in 0..1_000 {
            let [s, n] = [(); 2].map(|()| random.real(0.0, 255.0));
            let alpha = random.real(0.0, 1.0);
            let [screen, ..] = Blend::Screen.put([s; 3], grey(n, alpha));
            let [negative, ..] = Blend::Multiply.put([255.0 - s; 3], grey(255.0 - n, alpha));
            assert!((screen - (255.0 - negative)).abs() < ROUNDING);
        }
    }

    #[test]
    fn a_small_change_passes_by_the_derivative() {
        const CHANGE: f64 = 1e-3;
        let mut random = Random(42);
        for _ in 0..1_000 {
            let (s, n) = (random.real(0.0, 100.0), random.real(0.0, 150.0));
            let layer = grey(n, random.real(0.0, 1.0));
            for blend in ALL {
                let [here, there] = [s, s + CHANGE].map(|s| blend.put([s; 3], layer)[1]);
                let slope = (there - here) / CHANGE;
                assert!((slope - blend.passes(layer, 1)).abs() < 1e-8, "{blend:?} {layer:?}");
            }
        }
    }

    #[test]
    fn the_first_layer_is_lowest() {
        let layers = [grey(255.0, 0.5), grey(0.0, 0.5)];
        assert_eq!(Blend::Over.put_all([0.0; 3], &layers), [63.75; 3]);
        let turned = [layers[1], layers[0]];
        assert_eq!(Blend::Over.put_all([0.0; 3], &turned), [127.5; 3]);
    }
}
