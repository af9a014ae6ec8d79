//! Random numbers that are the same on every host, for tests and measurements: `SplitMix64`
//! (Steele, Lea and Flood, OOPSLA 2014).

/// A generator with 64 bits of state; equal seeds give equal sequences on every host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Random(pub u64);

impl Random {
    const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A real number, uniform in `low..high`.
    pub(crate) fn real(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A multiple of `step` in `low..=high`, both of them multiples of `step`, exact when `step` is
    /// a power of two; any real number for the step 0.
    #[cfg(test)]
    pub(crate) fn snapped(&mut self, low: f64, high: f64, step: f64) -> f64 {
        if step == 0.0 {
            return self.real(low, high);
        }
        let count = ((high - low) / step) as u64 + 1;
        low + (self.next() % count) as f64 * step
    }
}
