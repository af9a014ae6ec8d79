//! Random numbers that are the same on every host: `SplitMix64` (Steele, Lea and Flood, OOPSLA
//! 2014).

/// A generator with 64 bits of state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Random(u64);

impl Random {
    /// Equal seeds give equal sequences.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from `least` to `most`.
    ///
    /// # Panics
    ///
    /// Panics if `least > most`.
    pub fn within(&mut self, least: i32, most: i32) -> i32 {
        let count = u64::try_from(i64::from(most) - i64::from(least) + 1).expect("least <= most");
        (i64::from(least) + (self.bits() % count) as i64) as i32
    }

    /// True or false, equally often.
    pub const fn coin(&mut self) -> bool {
        self.bits() >> 63 == 0
    }

    /// A random element.
    ///
    /// # Panics
    ///
    /// Panics if there are none.
    pub const fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.bits() % from.len() as u64) as usize]
    }
}
