//! What a texture shows beside its edges.

/// How a texture goes on beyond its edges, for one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// It begins again.
    #[default]
    Repeat,
    /// Every second repeat is turned over, so that equal texels meet.
    Mirror,
    /// The texel at the edge goes on.
    Clamp,
}

impl Wrap {
    /// The texel of a side of `side` texels that is seen at the number `texel`, which counts on
    /// beyond both ends.
    ///
    /// Whole numbers are wrapped, not coordinates, so that each texel of a repeat is as wide as in
    /// the texture, mirrored or not (OpenGL 4.6 core profile, table 8.21).
    ///
    /// # Panics
    ///
    /// Panics if `side` is 0.
    #[must_use]
    pub fn texel(self, texel: i64, side: usize) -> usize {
        let side = side as i64;
        let within = match self {
            Self::Repeat => texel.rem_euclid(side),
            Self::Mirror => {
                let place = texel.rem_euclid(2 * side);
                place.min(2 * side - 1 - place)
            }
            Self::Clamp => texel.clamp(0, side - 1),
        };
        within as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The texels seen at the numbers -5 to 7 of a side of 3.
    fn row(wrap: Wrap) -> Vec<usize> {
        (-5..=7).map(|texel| wrap.texel(texel, 3)).collect()
    }

    #[test]
    fn a_side_of_three_by_hand() {
        assert_eq!(row(Wrap::Repeat), [1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1]);
        assert_eq!(row(Wrap::Mirror), [1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1]);
        assert_eq!(row(Wrap::Clamp), [0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2]);
    }

    #[test]
    fn one_texel_is_seen_everywhere() {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            for texel in [i64::MIN / 4, -2, -1, 0, 1, 2, i64::MAX / 4] {
                assert_eq!(wrap.texel(texel, 1), 0, "{wrap:?} {texel}");
            }
        }
    }
}
