//! Light of stored values, by the curve of sRGB (IEC 61966-2-1), when tables are compiled.

/// The light of each stored value, from 0 to 1.
const LIGHT: [f64; 256] = {
    let (mut table, mut value) = ([0.0; 256], 0);
    while value < 256 {
        table[value] = light(value as f64 / 255.0);
        value += 1;
    }
    table
};

/// The light of a value from 0 to 1.
const fn light(value: f64) -> f64 {
    if value <= 0.040_45 {
        return value / 12.92;
    }
    let base = (value + 0.055) / 1.055;
    // Its power of 2.4 is its square times the fifth root of its square.
    let square = base * base;
    // Newton's method from above: 30 steps of at most a factor of 4/5 come near, the rest double
    // the digits.
    let (mut root, mut steps) = (1.0, 0);
    while steps < 40 {
        let fourth = root * root * root * root;
        root -= (root * fourth - square) / (5.0 * fourth);
        steps += 1;
    }
    square * root
}

/// The least value whose light is at least the share `share` of the way from that of `dark` to that
/// of `bright`.
pub(super) const fn first_value_of(share: f64, dark: usize, bright: usize) -> u8 {
    let least = LIGHT[dark] + share * (LIGHT[bright] - LIGHT[dark]);
    // Half a range at a time: the light of `low` is less, that of `high` is not.
    let (mut low, mut high) = (dark, bright);
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        if LIGHT[middle] < least {
            low = middle;
        } else {
            high = middle;
        }
    }
    high as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_that_of_srgb() {
        for value in 0..=255u8 {
            let stored = f64::from(value) / 255.0;
            let exact = if stored <= 0.040_45 {
                stored / 12.92
            } else {
                ((stored + 0.055) / 1.055).powf(2.4)
            };
            assert!((LIGHT[usize::from(value)] - exact).abs() < 1e-14, "{value}");
        }
    }

    #[test]
    fn the_first_value_has_the_light_and_the_one_before_has_not() {
        for share in [0.01, 0.25, 0.5, 0.99] {
            let first = usize::from(first_value_of(share, 85, 170));
            let least = LIGHT[85] * (1.0 - share) + LIGHT[170] * share;
            assert!(LIGHT[first] >= least && LIGHT[first - 1] < least, "{share}");
        }
    }
}
