//! The choice among all renderers that are right.

use super::{
    Costs, PlanError, Study, Types, Visibility,
    decide::Decision,
    predict::{Candidate, Estimator, Fault, Predicted},
    source,
};

/// A renderer for a model.
#[derive(Debug)]
pub struct Plan {
    /// What was chosen.
    pub chosen: Candidate,
    /// What it is expected to take.
    pub predicted: Predicted,
    /// The cycles of each view.
    pub cycles: Vec<f64>,
    /// The decisions that led to it.
    pub decisions: Vec<Decision>,
    /// The same with everything on: 32 bits of depth, light at vertices, perspective, clipping.
    pub everything: (Candidate, Predicted),
    /// The best of each other kind, and why it is not taken.
    pub rejected: Vec<(Candidate, Predicted, Fault)>,
    /// The Rust file.
    pub source: String,
}

/// Weights leave 1 to 3 % of a frame's cycles unexplained: of renderers within that, the simplest
/// is taken, and of these the smallest.
const SAME_TIME: f64 = 1.02;

impl Study {
    /// Chooses the renderer: of those that are right and fit the memory, the one with the least
    /// time for a frame.
    ///
    /// # Errors
    ///
    /// Returns an error if none fits the memory, or the model cannot be converted any more.
    pub fn plan(&self, costs: &Costs) -> Result<Plan, PlanError> {
        let estimator = Estimator::new(self, costs)?;
        let all = estimator.all();
        let fits = |(_, _, fault): &&(Candidate, Predicted, Option<Fault>)| fault.is_none();
        let by_time = |a: &&(Candidate, Predicted, _), b: &&(Candidate, Predicted, _)| {
            a.1.seconds.total_cmp(&b.1.seconds)
        };
        // Nothing is as simple as the order of the tables.
        let size = |(candidate, p, _): &&(Candidate, Predicted, _)| {
            let visibility = candidate.types.visibility;
            let decides = visibility > Visibility::PartOrder;
            (decides, p.flash_bytes() + p.ram_bytes())
        };
        let least = all.iter().filter(fits).min_by(by_time).map_or(0.0, |(_, p, _)| p.seconds);
        let is_as_fast = |(_, p, _): &&(Candidate, Predicted, _)| p.seconds <= SAME_TIME * least;
        let fast = all.iter().filter(fits).filter(is_as_fast);
        let Some(&(chosen, predicted, _)) = fast.min_by_key(size) else {
            let is_wrong = |fault| matches!(fault, Some(Fault::Wrong | Fault::Cycle));
            let right = || all.iter().filter(|(.., fault)| !is_wrong(*fault));
            return Err(PlanError::TooLarge {
                ram: self.request.ram_bytes,
                flash: self.request.flash_bytes,
                least_ram: right().map(|(_, p, _)| p.ram_bytes()).min().unwrap_or(0),
                has_mip_levels: self.has_mip_levels(),
                least_flash: right().map(|(_, p, _)| p.flash_bytes()).min().unwrap_or(0),
            });
        };
        // The best of each visibility and each place of vertices, in one band and in several.
        let mut rejected: Vec<(Candidate, Predicted, Fault)> = Vec::new();
        let kind = |types: &Types| (types.visibility, types.vertices, types.in_bands);
        let mut sorted: Vec<_> = all.iter().collect();
        sorted.sort_by(|a, b| a.2.is_some().cmp(&b.2.is_some()).then(by_time(a, b)));
        for (candidate, predicted, fault) in sorted {
            let is_known = |other: &Candidate| kind(&other.types) == kind(&candidate.types);
            if !is_known(&chosen) && !rejected.iter().any(|(other, ..)| is_known(other)) {
                rejected.push((*candidate, *predicted, fault.unwrap_or(Fault::Time)));
            }
        }
        rejected.sort_by_key(|(candidate, ..)| kind(&candidate.types));
        let decisions = self.decisions(&estimator, chosen);
        Ok(Plan {
            chosen,
            predicted,
            cycles: estimator.cycles(&chosen).unwrap_or_default(),
            source: source::with_decisions(
                &self.source(&chosen.types, chosen.rows)?,
                &decisions,
                &self.request,
            ),
            decisions,
            everything: estimator.everything(),
            rejected,
        })
    }
}
