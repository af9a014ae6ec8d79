//! A block of instructions as QEMU translates it, and what a run of it counts.

use crate::{
    cache::Cache,
    counts::Counts,
    instruction::{Float, Instruction, Kind},
};

/// A block, decoded.
#[derive(Clone, Debug)]
pub struct Block {
    /// The address of its first instruction.
    pub start: u32,
    /// The address of its last instruction.
    pub last: u32,
    /// The address behind it.
    pub end: u32,
    /// What its last instruction is.
    pub ending: Kind,
    /// Whether that is a 16-bit instruction.
    ending_is_narrow: bool,
    /// The instruction before the last one.
    before_ending: Option<Instruction>,
    /// Whether it begins with a 32-bit instruction that does not begin at a word.
    starts_split: bool,
    /// What each instruction counts.
    each: Vec<Counts>,
    /// What all of them count.
    total: Counts,
    /// The lines of the cache that it is fetched from.
    pub lines: Vec<u32>,
}

/// How often a block ran, and how it was entered and left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Runs {
    /// How often it ran.
    pub runs: u64,
    /// How often it was jumped to.
    pub jumps_in: u64,
    /// How often it was left by a jump.
    pub jumps_out: u64,
    /// How often the branch at its end was predicted wrong.
    pub mispredictions: u64,
}

impl Block {
    /// A block that starts at an address, and what it is fetched by, if flash has a cache.
    #[must_use]
    pub fn new(start: u32, instructions: &[Instruction], cache: Option<&Cache>) -> Self {
        let (mut last, mut end) = (start, start);
        let (mut each, mut total, mut lines) = (Vec::new(), Counts::default(), Vec::new());
        let mut before = None;
        for instruction in instructions {
            (last, end) = (end, end + u32::from(instruction.size));
            let counts = counts(instruction, before);
            total.add(&counts, 1);
            each.push(counts);
            before = Some(instruction);
            for line in cache.iter().flat_map(|cache| [cache.line(last), cache.line(end - 1)]) {
                if lines.last() != Some(&line) {
                    lines.push(line);
                }
            }
        }
        let ending = instructions.last();
        Self {
            start,
            last,
            end,
            ending: ending.map_or(Kind::Plain, |instruction| instruction.kind),
            ending_is_narrow: ending.is_some_and(|instruction| instruction.size == 2),
            before_ending: instructions.iter().rev().nth(1).copied(),
            starts_split: start & 2 != 0 && instructions.first().is_some_and(|i| i.size == 4),
            each,
            total,
            lines,
        }
    }

    /// What the instructions from an index on count.
    #[must_use]
    pub fn from(&self, index: usize) -> Counts {
        let mut sum = Counts::default();
        for counts in &self.each[index..] {
            sum.add(counts, 1);
        }
        sum
    }

    /// What these runs count.
    #[must_use]
    pub fn counts(&self, runs: &Runs) -> Counts {
        let mut sum = Counts::default();
        sum.add(&self.total, runs.runs);
        sum.mispredictions = runs.mispredictions;
        sum.split_targets = if self.starts_split { runs.jumps_in } else { 0 };
        let before = self.before_ending.filter(|before| before.size == 2 && self.ending_is_narrow);
        match self.ending {
            Kind::Branch { is_conditional } => {
                sum.taken = runs.jumps_out;
                if before.is_some_and(|before| !before.sets_flags) {
                    sum.taken_folded = runs.jumps_out;
                }
                if before.is_some() && is_conditional {
                    sum.untaken_folded = runs.runs.saturating_sub(runs.jumps_out);
                }
            }
            Kind::Call => sum.calls = runs.jumps_out,
            Kind::Register => sum.register_jumps = runs.jumps_out,
            Kind::Table => sum.table_jumps = runs.jumps_out,
            _ => {}
        }
        sum
    }
}

/// What an instruction counts wherever it goes on, from the one right before it in its block.
fn counts(now: &Instruction, before: Option<&Instruction>) -> Counts {
    let needs = |used, is_of: fn(&Instruction) -> bool| {
        before.is_some_and(|before| is_of(before) && before.writes & used != 0)
    };
    let is_load = |before: &Instruction| before.kind == Kind::Load;
    let is_arithmetic = |before: &Instruction| {
        matches!(before.kind, Kind::Plain | Kind::Multiply | Kind::LongMultiply)
    };
    let is_float_arithmetic = |before: &Instruction| {
        use Float::{Arithmetic, Divide, MultiplyAdd};
        matches!(before.kind, Kind::Float(Arithmetic | MultiplyAdd | Divide))
    };
    // The load before is still busy while this one begins.
    let is_pipelined = before.is_some_and(is_load) && !needs(now.address, is_load);
    let mut counts = Counts {
        instructions: 1,
        load_uses: needs(now.reads, is_load).into(),
        address_stalls: needs(now.address, is_arithmetic).into(),
        late_uses: needs(now.reads, |before| before.is_late).into(),
        float_late_uses: needs(now.reads, is_float_arithmetic).into(),
        ..Counts::default()
    };
    match now.kind {
        Kind::Plain | Kind::Branch { .. } | Kind::Call | Kind::Register | Kind::Table => {}
        Kind::Multiply => {
            counts.multiplies = 1;
            counts.narrow_multiplies = (now.size == 2).into();
        }
        Kind::LongMultiply => counts.long_multiplies = 1,
        Kind::Divide => counts.divides = 1,
        Kind::Load => {
            counts.loads = 1;
            counts.pipelined_loads = is_pipelined.into();
        }
        Kind::Store { is_indexed } => {
            counts.stores = 1;
            counts.indexed_stores = (is_indexed && !is_pipelined).into();
        }
        Kind::Multiple { words, .. } => {
            counts.multiples = 1;
            counts.multiple_words = words.into();
        }
        Kind::Return { words } => {
            counts.returns = 1;
            counts.return_words = words.into();
        }
        Kind::It => {
            counts.its = 1;
            counts.its_folded = before.is_some_and(|before| before.size == 2).into();
        }
        Kind::Float(float) => {
            counts.floats = 1;
            match float {
                Float::Move | Float::Arithmetic => {}
                Float::MultiplyAdd => counts.float_multiply_adds = 1,
                Float::Divide => counts.float_divides = 1,
                Float::Load => counts.float_loads = 1,
                Float::Store => counts.float_stores = 1,
            }
        }
        Kind::System => counts.systems = 1,
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOAD: Instruction = Instruction::new(Kind::Load, 2).at(0b1_0000).writing(0b1);
    const ADD: Instruction = Instruction::new(Kind::Plain, 2).reading(0b1).writing(0b1_0000);

    /// What the second of two instructions counts.
    fn second(first: Instruction, second: Instruction) -> Counts {
        Block::new(0, &[first, second], None).each[1]
    }

    #[test]
    fn a_load_behind_a_load_is_pipelined_unless_its_address_needs_the_first() {
        let next = Instruction::new(Kind::Load, 2).at(0b10);
        assert_eq!(second(LOAD, next).pipelined_loads, 1);
        let chained = second(LOAD, Instruction::new(Kind::Load, 2).at(0b1));
        assert_eq!((chained.pipelined_loads, chained.load_uses), (0, 1));
        assert_eq!(second(ADD, next).pipelined_loads, 0);
    }

    #[test]
    fn an_indexed_store_hides_behind_a_load_only() {
        let store = Instruction::new(Kind::Store { is_indexed: true }, 2).at(0b110);
        assert_eq!(second(LOAD, store).indexed_stores, 0);
        assert_eq!(second(ADD, store).indexed_stores, 1);
    }

    #[test]
    fn an_address_waits_for_the_arithmetic_before_it() {
        assert_eq!(second(ADD, LOAD).address_stalls, 1);
        assert_eq!(second(ADD, Instruction::new(Kind::Load, 2).at(0b1)).address_stalls, 0);
        assert_eq!(second(LOAD, Instruction::new(Kind::Load, 2).at(0b1)).address_stalls, 0);
    }

    #[test]
    fn a_value_is_used_too_early() {
        assert_eq!(second(LOAD, ADD).load_uses, 1);
        assert_eq!(second(ADD, ADD).load_uses, 0);
        let user = Instruction::new(Kind::Plain, 4).reading(0b1_0000);
        assert_eq!(second(ADD.late(true), user).late_uses, 1);
        assert_eq!(second(ADD, user).late_uses, 0);
    }

    #[test]
    fn a_result_of_the_fpu_is_used_too_early() {
        let float = |float| Instruction::new(Kind::Float(float), 4);
        let sum = float(Float::Arithmetic).reading(1 << 33).writing(1 << 34);
        let store = float(Float::Store).at(0b1).reading(1 << 34);
        let found = second(sum, store);
        assert_eq!((found.floats, found.float_stores, found.float_late_uses), (1, 1, 1));
        assert_eq!(second(sum, sum).float_late_uses, 0);
        assert_eq!(second(float(Float::Move).writing(1 << 34), store).float_late_uses, 0);
        let divide = float(Float::Divide).reading(1 << 34);
        assert_eq!(second(sum, divide).float_divides, 1);
        assert_eq!(second(sum, Instruction { kind: Kind::Plain, ..ADD }).floats, 0);
    }

    #[test]
    fn branches_are_counted_by_the_way_they_go() {
        let branch = Instruction::new(Kind::Branch { is_conditional: true }, 2);
        let runs = Runs { runs: 10, jumps_in: 4, jumps_out: 7, mispredictions: 2 };
        let of = |before, branch| {
            let counts = Block::new(0, &[before, branch], None).counts(&runs);
            (counts.taken, counts.taken_folded, counts.untaken_folded, counts.mispredictions)
        };
        assert_eq!(of(ADD, branch), (7, 7, 3, 2));
        assert_eq!(of(ADD.setting_flags(), branch), (7, 0, 3, 2));
        assert_eq!(of(Instruction { size: 4, ..ADD }, branch), (7, 0, 0, 2));
        let always = Instruction::new(Kind::Branch { is_conditional: false }, 2);
        assert_eq!(of(ADD, always), (7, 7, 0, 2));
    }

    #[test]
    fn a_jump_to_a_32_bit_instruction_off_a_word_is_counted() {
        let wide = Instruction::new(Kind::Plain, 4);
        let runs = Runs { runs: 10, jumps_in: 4, ..Runs::default() };
        let of = |start, first| Block::new(start, &[first], None).counts(&runs).split_targets;
        assert_eq!([of(2, wide), of(4, wide), of(2, ADD)], [4, 0, 0]);
    }

    #[test]
    fn a_block_knows_its_ends_its_rest_and_its_lines() {
        let cache = Cache::new(8, 4, 2);
        let wide = Instruction::new(Kind::Plain, 4);
        let block = Block::new(14, &[wide, ADD, LOAD], Some(&cache));
        assert_eq!((block.start, block.last, block.end), (14, 20, 22));
        assert_eq!((block.from(1).instructions, block.from(1).loads), (2, 1));
        assert_eq!(block.lines, [1, 2]);
    }
}
