//! The branch predictor of Hazard3.

/// Remembers the backward branch that was taken last, and predicts that it is taken again. Every
/// other branch is predicted not to be taken.
#[derive(Clone, Copy, Debug, Default)]
pub struct Predictor {
    /// The address of that branch.
    taken_backward: Option<u32>,
}

impl Predictor {
    /// Runs a conditional branch, which goes on at `next`. Returns whether it was predicted wrong.
    pub fn misses(&mut self, branch: u32, is_taken: bool, next: u32) -> bool {
        let is_predicted_taken = self.taken_backward == Some(branch);
        if is_taken && next <= branch {
            self.taken_backward = Some(branch);
        } else if is_predicted_taken && !is_taken {
            self.taken_backward = None;
        }
        is_predicted_taken != is_taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_misses_at_its_first_turn_and_at_its_end() {
        let mut predictor = Predictor::default();
        let mut back = |is_taken| predictor.misses(100, is_taken, if is_taken { 80 } else { 104 });
        assert_eq!([true, true, true, false].map(&mut back), [true, false, false, true]);
        assert_eq!([false, true].map(&mut back), [false, true]);
    }

    #[test]
    fn forward_branches_are_predicted_not_taken_and_leave_the_memory() {
        let mut predictor = Predictor::default();
        assert!(predictor.misses(100, true, 80));
        assert!(predictor.misses(90, true, 96));
        assert!(predictor.misses(90, true, 96));
        assert!(!predictor.misses(90, false, 94));
        assert!(!predictor.misses(100, true, 80));
    }
}
