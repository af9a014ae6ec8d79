//! A cache in front of flash.

/// A set-associative cache that replaces the line that was used longest ago.
#[derive(Clone, Debug)]
pub struct Cache {
    /// The binary logarithm of the bytes of a line.
    shift: u32,
    ways: usize,
    /// The lines of each set, the one used last in front.
    lines: Vec<Option<u32>>,
}

impl Cache {
    /// An empty cache. The bytes of a line and the number of sets must be powers of two.
    #[must_use]
    pub fn new(line_bytes: u32, sets: u32, ways: usize) -> Self {
        let lines = vec![None; sets as usize * ways];
        Self { shift: line_bytes.trailing_zeros(), ways, lines }
    }

    /// The number of the line that holds an address.
    #[must_use]
    pub const fn line(&self, address: u32) -> u32 {
        address >> self.shift
    }

    /// Uses a line. Returns whether it had to be fetched.
    pub fn misses(&mut self, line: u32) -> bool {
        let sets = self.lines.len() / self.ways;
        let first = line as usize % sets * self.ways;
        let set = &mut self.lines[first..first + self.ways];
        let found = set.iter().position(|&held| held == Some(line));
        set[..=found.unwrap_or(self.ways - 1)].rotate_right(1);
        set[0] = Some(line);
        found.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_used_longest_ago_is_replaced() {
        // Lines of 8 bytes in 4 sets of 2 ways: lines 1, 5 and 9 share a set.
        let mut cache = Cache::new(8, 4, 2);
        assert_eq!([0, 7, 8, 47].map(|address| cache.line(address)), [0, 0, 1, 5]);
        let misses = [1, 5, 1, 9, 1, 5, 2].map(|line| cache.misses(line));
        assert_eq!(misses, [true, true, false, true, false, true, true]);
    }
}
