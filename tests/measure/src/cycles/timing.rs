//! How many cycles the counts of the plugin take on a core.

use crate::{cores::Core, counts::Counts, cycles::tables};

/// The timing of a core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    /// Whether it has the instructions of an FPU.
    pub(crate) has_fpu: bool,
    /// What it depends on: the first model is the one that figures are compared by.
    pub(crate) models: &'static [Model],
    pub(crate) rows: &'static [Row],
}

/// A variant of a core, or an end of the range that its timing lies in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    /// The heading of its column.
    pub(crate) name: &'static str,
    /// Whether code and tables are in flash with a cache, whose misses take time.
    pub(crate) is_in_flash: bool,
}

/// Instructions that do not take exactly one cycle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub(crate) what: &'static str,
    pub(crate) count: fn(&Counts) -> u64,
    /// Cycles in each model beyond the one that every instruction takes.
    pub(crate) more: &'static [i64],
    pub(crate) source: &'static str,
}

/// Cycles that a miss of the RP2040's cache takes: about 28 clocks of the flash at half the clock
/// of the core, and a few for the bus.
pub(crate) const MISS: u64 = 60;

impl Timing {
    /// The timing of a core, if there is a table of it.
    pub(crate) const fn of(core: Core) -> Option<Self> {
        match core {
            Core::M0plus => Some(tables::M0PLUS),
            Core::M4 => Some(tables::M4),
            Core::M33 => Some(tables::M33),
            Core::Riscv => Some(tables::HAZARD3),
            // It issues pairs of instructions, and nobody has published which.
            Core::M7 => None,
        }
    }

    /// The cycles that counts take in a model, if a miss of the cache takes `miss` cycles.
    pub(crate) fn cycles(&self, model: usize, counts: &Counts, miss: u64) -> u64 {
        let more = self.rows.iter().map(|row| row.more[model] * (row.count)(counts) as i64);
        let cycles = counts.instructions as i64 + more.sum::<i64>();
        let misses = counts.fetch_misses + counts.data_misses;
        cycles.max(0) as u64 + if self.models[model].is_in_flash { miss * misses } else { 0 }
    }

    /// Whether it has all that was counted.
    pub(crate) const fn covers(&self, counts: &Counts) -> bool {
        self.has_fpu || counts.floats == 0
    }

    /// The cycles in memory without waiting: the least, the figure that is compared, and the most.
    /// They are equal where the table is exact.
    pub(crate) fn range(&self, counts: &Counts) -> [u64; 3] {
        ["least", "cycles", "most"].map(|name| {
            let model = self.models.iter().position(|model| model.name == name).unwrap_or(0);
            self.cycles(model, counts, 0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_has_a_figure_for_every_model_and_a_source() {
        let mut rows = 0;
        for timing in Core::or_all(&[]).into_iter().filter_map(Timing::of) {
            for row in timing.rows {
                assert_eq!(row.more.len(), timing.models.len(), "{}", row.what);
                assert!(row.source.len() > 5, "{}", row.what);
                rows += 1;
            }
        }
        assert!(rows > 20);
    }

    /// What counts take in each model of a core.
    fn cycles(core: Core, counts: &Counts) -> Vec<u64> {
        let timing = Timing::of(core).unwrap();
        (0..timing.models.len()).map(|model| timing.cycles(model, counts, 60)).collect()
    }

    #[test]
    fn a_range_is_exact_or_around_the_figure() {
        let counts = Counts { instructions: 9, divides: 2, taken: 1, ..Counts::default() };
        let of = |core| Timing::of(core).unwrap().range(&counts);
        let [least, cycles, most] = of(Core::M4);
        assert!(least < cycles && cycles < most);
        assert_eq!(of(Core::M0plus), [of(Core::M0plus)[1]; 3]);
    }

    #[test]
    fn cycles_are_counts_times_the_table() {
        // LDR, LDR, STR, MULS, PUSH of 2, POP of 1 and PC, BNE taken.
        let counts = Counts {
            instructions: 7,
            loads: 2,
            pipelined_loads: 1,
            stores: 1,
            multiplies: 1,
            narrow_multiplies: 1,
            multiples: 1,
            multiple_words: 2,
            returns: 1,
            return_words: 2,
            taken: 1,
            fetch_misses: 2,
            data_misses: 1,
            ..Counts::default()
        };
        // 2 + 2 + 2 + 1 (32) + 3 + 5 + 2, and 3 misses.
        assert_eq!(cycles(Core::M0plus, &counts), [17, 48, 197]);
        // 2 + 1 + 1 + 1 + 3 + (3 + P) + (1 + P).
        assert_eq!(cycles(Core::M4, &counts), [16, 14, 18]);
        // 1 + 1 + 1 + 2 + 2 + (2 + 1 to 3) + 2.
        assert_eq!(cycles(Core::M33, &counts), [12, 12, 14]);
    }

    #[test]
    fn only_the_m4_has_a_table_of_its_fpu() {
        let counts = Counts { instructions: 9, floats: 1, ..Counts::default() };
        let of = |core, counts| Timing::of(core).unwrap().covers(counts);
        assert!(of(Core::M4, &counts) && !of(Core::M33, &counts));
        assert!(of(Core::M33, &Counts { floats: 0, ..counts }));
    }

    #[test]
    fn hazard3_pays_for_uses_jumps_and_divides() {
        let counts = Counts {
            instructions: 10,
            load_uses: 1,
            mispredictions: 2,
            calls: 1,
            register_jumps: 1,
            split_targets: 3,
            divides: 1,
            ..Counts::default()
        };
        assert_eq!(cycles(Core::Riscv, &counts), [10 + 1 + 2 + 1 + 1 + 3 + 17]);
    }
}
