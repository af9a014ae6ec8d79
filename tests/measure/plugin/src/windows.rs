//! Counts what runs between the marks that a program sets.
//!
//! A mark is a store to one of the words of an array; its value is of no interest. The word at
//! index `i` opens a window of stage `i` and closes it again; the last word ends a report. So a
//! report has the counts of each stage since the one before it.
//!
//! Before all that, a program sets its memory to zero, from the first word to the last. This opens
//! windows that are followed by the mark of another stage, and ends a report of nothing: neither
//! counts.
//!
//! A window must not hold accesses to devices: QEMU may stop a block at one and translate the rest
//! anew, which would then be counted twice.

use std::fmt::Write as _;

use crate::{
    block::{Block, Runs},
    cache::Cache,
    counts::Counts,
    instruction::{Instruction, Kind},
    predictor::Predictor,
};

/// Where the marks are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Marks {
    /// The address of the first word.
    pub address: u32,
    /// The number of stages: one less than there are words.
    pub stages: usize,
}

/// Flash, and the cache in front of it.
#[derive(Clone, Debug)]
pub struct Flash {
    /// Its first address.
    pub start: u32,
    /// Its length in bytes.
    pub length: u32,
    /// The cache.
    pub cache: Cache,
}

impl Flash {
    const fn holds(&self, address: u32) -> bool {
        address.wrapping_sub(self.start) < self.length
    }
}

/// Counts the stages of a program while it runs.
#[derive(Clone, Debug)]
pub struct Windows {
    marks: Marks,
    flash: Option<Flash>,
    blocks: Vec<(Block, Runs)>,
    /// The blocks whose [`Runs`] are not 0.
    touched: Vec<usize>,
    /// The block that runs.
    current: Option<usize>,
    /// Of a RISC-V core.
    predictor: Option<Predictor>,
    misses: Counts,
    open: Option<Open>,
    stages: Vec<Counts>,
    reports: String,
}

/// An open window.
#[derive(Clone, Copy, Debug)]
struct Open {
    stage: usize,
    /// What its first block counts behind the mark: the block ran before the window was opened.
    first: Counts,
}

impl Windows {
    /// Nothing has run.
    #[must_use]
    pub fn new(marks: Marks, flash: Option<Flash>, predictor: Option<Predictor>) -> Self {
        Self {
            marks,
            flash,
            blocks: Vec::new(),
            touched: Vec::new(),
            current: None,
            predictor,
            misses: Counts::default(),
            open: None,
            stages: vec![Counts::default(); marks.stages],
            reports: String::new(),
        }
    }

    /// Adds a block that QEMU has translated, and returns its number.
    pub fn add(&mut self, start: u32, instructions: &[Instruction]) -> usize {
        let cache = self.flash.as_ref().filter(|flash| flash.holds(start)).map(|f| &f.cache);
        self.blocks.push((Block::new(start, instructions, cache), Runs::default()));
        self.blocks.len() - 1
    }

    /// Whether [`accessed`](Self::accessed) wants to hear of an instruction.
    #[must_use]
    pub const fn watches(&self, instruction: &Instruction) -> bool {
        match instruction.kind {
            Kind::Store { .. } => true,
            Kind::Load
            | Kind::Multiple { is_load: true, .. }
            | Kind::Return { .. }
            | Kind::Table => self.flash.is_some(),
            _ => false,
        }
    }

    /// A block begins to run.
    pub fn executed(&mut self, number: usize) {
        let start = self.blocks[number].0.start;
        let is_jumped_to = match self.current {
            Some(previous) => self.leave(previous, start),
            None => false,
        };
        self.current = Some(number);
        let (block, runs) = &mut self.blocks[number];
        if *runs == Runs::default() {
            self.touched.push(number);
        }
        runs.runs += 1;
        runs.jumps_in += u64::from(is_jumped_to);
        if let Some(flash) = &mut self.flash {
            for &line in &block.lines {
                self.misses.fetch_misses += u64::from(flash.cache.misses(line));
            }
        }
    }

    /// The running block goes on at `next`. Returns whether it jumps there.
    fn leave(&mut self, number: usize, next: u32) -> bool {
        let (block, runs) = &mut self.blocks[number];
        let is_jump = next != block.end;
        let is_branch = block.ending == Kind::Branch { is_conditional: true };
        let is_missed = is_branch
            && self.predictor.as_mut().is_some_and(|p| p.misses(block.last, is_jump, next));
        if is_jump || is_missed {
            if *runs == Runs::default() {
                self.touched.push(number);
            }
            runs.jumps_out += u64::from(is_jump);
            runs.mispredictions += u64::from(is_missed);
        }
        is_jump
    }

    /// An instruction of a block that is [watched](Self::watches) accesses an address.
    pub fn accessed(&mut self, number: usize, index: usize, address: u32) {
        let word = address.wrapping_sub(self.marks.address) / 4;
        if address >= self.marks.address && word as usize <= self.marks.stages {
            self.mark(word as usize, number, index);
        } else if let Some(flash) = self.flash.as_mut().filter(|flash| flash.holds(address)) {
            let line = flash.cache.line(address);
            self.misses.data_misses += u64::from(flash.cache.misses(line));
        }
    }

    /// The instruction at an index of a block sets a mark.
    fn mark(&mut self, word: usize, number: usize, index: usize) {
        let open = self.open.take();
        if word == self.marks.stages {
            self.report();
        } else if let Some(Open { first, .. }) = open.filter(|open| open.stage == word) {
            let mut sum = self.misses;
            for &touched in &self.touched {
                let (block, runs) = &self.blocks[touched];
                sum.add(&block.counts(runs), 1);
            }
            sum.add(&first, 1);
            // The mark itself is not counted, nor what is behind it.
            sum.subtract(&self.blocks[number].0.from(index));
            self.stages[word].add(&sum, 1);
        } else {
            assert!(
                open.is_none() || self.is_untouched(),
                "stage {word} is measured within another"
            );
            for touched in self.touched.drain(..) {
                self.blocks[touched].1 = Runs::default();
            }
            self.misses = Counts::default();
            self.open = Some(Open { stage: word, first: self.blocks[number].0.from(index + 1) });
        }
    }

    /// Whether nothing has been counted.
    fn is_untouched(&self) -> bool {
        self.reports.is_empty() && self.stages.iter().all(|stage| *stage == Counts::default())
    }

    /// Ends a report: a line with a JSON array of the counts of all stages.
    fn report(&mut self) {
        if self.is_untouched() {
            return;
        }
        for (stage, counts) in self.stages.iter_mut().enumerate() {
            // Writing to a string cannot fail.
            let _ = write!(self.reports, "{}{counts}", if stage == 0 { "[" } else { "," });
            *counts = Counts::default();
        }
        self.reports.push_str("]\n");
    }

    /// The reports up to here.
    #[must_use]
    pub fn reports(&self) -> &str {
        &self.reports
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARKS: Marks = Marks { address: 1000, stages: 2 };
    const PLAIN: Instruction = Instruction::new(Kind::Plain, 2);
    const STORE: Instruction = Instruction::new(Kind::Store { is_indexed: false }, 2);
    const BRANCH: Instruction = Instruction::new(Kind::Branch { is_conditional: true }, 2);

    #[test]
    fn a_window_holds_what_runs_between_its_marks() {
        let mut windows = Windows::new(MARKS, None, Some(Predictor::default()));
        // A mark, then a loop, then a mark in the middle of a block.
        let first = windows.add(0, &[PLAIN, STORE, PLAIN]);
        let turn = windows.add(6, &[PLAIN, PLAIN, BRANCH]);
        let end = windows.add(12, &[PLAIN, STORE, PLAIN, STORE]);
        for _ in 0..2 {
            windows.executed(first);
            windows.accessed(first, 1, 1004);
            for _ in 0..5 {
                windows.executed(turn);
            }
            windows.executed(end);
            windows.accessed(end, 1, 1004);
            windows.accessed(end, 3, 1008);
        }
        // One behind the mark, five turns of three, one before the mark. The loop is left once, and
        // the predictor misses at its first turn and at its end.
        let expected = "[{},{\"instructions\":17,\"taken\":4,\"taken_folded\":4,\
                        \"untaken_folded\":1,\"mispredictions\":2}]\n";
        assert_eq!(windows.reports(), expected.repeat(2));
    }

    #[test]
    fn windows_of_a_stage_add_up_until_they_are_reported() {
        let mut windows = Windows::new(MARKS, None, None);
        let block = windows.add(0, &[STORE, PLAIN, PLAIN, STORE, STORE]);
        for _ in 0..3 {
            windows.executed(block);
            windows.accessed(block, 0, 1000);
            windows.accessed(block, 3, 1000);
        }
        windows.accessed(block, 4, 1008);
        windows.accessed(block, 4, 1008);
        assert_eq!(windows.reports(), "[{\"instructions\":6},{}]\n[{},{}]\n");
    }

    #[test]
    fn memory_set_to_zero_is_no_window() {
        let mut windows = Windows::new(MARKS, None, None);
        let zeroing = windows.add(100, &[STORE, PLAIN]);
        let block = windows.add(0, &[STORE, PLAIN, PLAIN, STORE, STORE]);
        for address in [996, 1000, 1004, 1008, 1012] {
            windows.executed(zeroing);
            windows.accessed(zeroing, 0, address);
        }
        assert_eq!(windows.reports(), "");
        windows.executed(block);
        windows.accessed(block, 0, 1000);
        windows.accessed(block, 3, 1000);
        windows.accessed(block, 4, 1008);
        assert_eq!(windows.reports(), "[{\"instructions\":2},{}]\n");
    }

    #[test]
    #[should_panic(expected = "stage 1 is measured within another")]
    fn a_stage_within_another_is_a_fault() {
        let mut windows = Windows::new(MARKS, None, None);
        let block = windows.add(0, &[STORE, PLAIN, STORE, STORE, STORE]);
        windows.executed(block);
        for (index, address) in [(0, 1000), (2, 1000), (3, 1000), (4, 1004)] {
            windows.accessed(block, index, address);
        }
    }

    #[test]
    fn other_addresses_are_no_marks() {
        let mut windows = Windows::new(MARKS, None, None);
        let block = windows.add(0, &[STORE, PLAIN]);
        windows.executed(block);
        windows.accessed(block, 0, 996);
        windows.accessed(block, 0, 1012);
        assert!(windows.open.is_none());
    }

    #[test]
    fn flash_is_fetched_through_its_cache_by_code_and_loads() {
        let load = Instruction::new(Kind::Load, 2);
        let flash = Flash { start: 0, length: 64, cache: Cache::new(8, 2, 1) };
        let mut windows = Windows::new(MARKS, Some(flash), None);
        assert!(windows.watches(&load) && !Windows::new(MARKS, None, None).watches(&load));
        let block = windows.add(6, &[STORE, load, PLAIN, STORE, STORE]);
        windows.executed(block);
        windows.accessed(block, 0, 1000);
        // Line 2 takes the place of line 0, which is fetched again by the next run. RAM is not
        // cached.
        for address in [16, 17, 2000] {
            windows.accessed(block, 1, address);
        }
        windows.executed(block);
        windows.accessed(block, 3, 1000);
        windows.accessed(block, 4, 1008);
        let reports = windows.reports();
        assert!(reports.contains(r#""fetch_misses":1,"data_misses":1"#), "{reports}");
    }
}
