//! An alpha along an axis of a model.

/// Opaque at one end of an axis and clear at the other, linear between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fade {
    /// 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// Where the alpha is 1.
    pub opaque: f64,
    /// Where it is 0; not the same place.
    pub clear: f64,
}

impl Fade {
    /// The alpha of a point, from 0 to 1.
    #[must_use]
    pub fn alpha(&self, point: [f64; 3]) -> f64 {
        let Self { axis, opaque, clear } = *self;
        ((point[axis] - clear) / (opaque - clear)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alphas_are_linear_between_the_ends() {
        let fade = Fade { axis: 1, opaque: -3.0, clear: 5.0 };
        let alpha = |y| fade.alpha([7.0, y, -7.0]);
        assert_eq!([-9.0, -3.0, -1.0, 3.0, 5.0, 6.0].map(alpha), [1.0, 1.0, 0.75, 0.25, 0.0, 0.0]);
    }
}
