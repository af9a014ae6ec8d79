//! What renderers are expected to take.

use super::{
    Correction, Costs, Load, Paint, PlanError, Study, Types, Vertices, Visibility, band_rows,
    costs::{PartCost, RunCost},
    decide::Other,
    order::{FixedOrder, Search},
    sampled::Sampled,
    types::Tables,
};
use crate::model::Model;

/// A renderer, and the rows that it draws at a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize)]
pub struct Candidate {
    /// Its types.
    pub types: Types,
    /// The rows of a band; all of the display if there is one.
    pub rows: u32,
}

/// What a renderer is expected to take.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Predicted {
    /// Bytes of code and constants.
    pub code_bytes: u32,
    /// Bytes of the model's tables.
    pub table_bytes: u32,
    /// Bytes of buffers.
    pub buffer_bytes: u32,
    /// Bytes of stack.
    pub stack_bytes: u32,
    /// Cycles of a frame: the mean of the views.
    pub cycles: f64,
    /// Cycles of the view that takes most.
    pub most_cycles: f64,
    /// Seconds from the first cycle of a frame to its last bit on the bus: the mean of the views.
    pub seconds: f64,
}

impl Predicted {
    /// Bytes of flash.
    #[must_use]
    pub const fn flash_bytes(&self) -> u32 {
        self.code_bytes + self.table_bytes
    }

    /// Bytes of RAM.
    #[must_use]
    pub const fn ram_bytes(&self) -> u32 {
        self.buffer_bytes + self.stack_bytes
    }
}

/// Why a renderer is not taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fault {
    /// It shows wrong pixels.
    Wrong,
    /// No such order of the triangles is right.
    Cycle,
    /// It takes more RAM than there is.
    Ram,
    /// It takes more flash than there is.
    Flash,
    /// It takes more time.
    Time,
}

/// Predicts what renderers take.
pub(super) struct Estimator<'a> {
    study: &'a Study,
    costs: &'a Costs,
    /// The model for each kind of tables.
    models: Vec<(Tables, Model)>,
}

impl<'a> Estimator<'a> {
    pub(super) fn new(study: &'a Study, costs: &'a Costs) -> Result<Self, PlanError> {
        let mut models: Vec<(Tables, Model)> = Vec::new();
        let paints = study.paints();
        let own =
            paints.iter().flat_map(|&paint| [false, true].map(|is_smooth| (paint, is_smooth)));
        // A decision compares with the filter that is not taken, in the same light.
        let other = study.sampling.as_ref().map(Sampled::with_other_levels);
        let others =
            paints.iter().filter_map(|paint| Some((paint.filtered(other?), study.is_smooth())));
        for (paint, is_smooth) in own.chain(others) {
            for visibility in study.considered() {
                let types = Types { is_smooth, paint, visibility, ..EVERYTHING };
                if !models.iter().any(|(tables, _)| *tables == types.tables()) {
                    models.push((types.tables(), study.model(&types)?));
                }
            }
        }
        Ok(Self { study, costs, models })
    }

    /// The model with the tables of types.
    pub(super) fn model(&self, types: &Types) -> &Model {
        let is_of = |(tables, _): &&(Tables, Model)| *tables == types.tables();
        let found = self.models.iter().find(is_of).or(self.models.first());
        &found.expect("a study has a model").1
    }

    /// What a renderer is expected to take; `None` if nothing is known about its types.
    pub(super) fn predict(&self, candidate: &Candidate) -> Option<Predicted> {
        let Candidate { types, rows } = candidate;
        let (request, model) = (&self.study.request, self.model(types));
        let cost = self.costs.of(request.core, types)?;
        let parts = self.part_cost(types).unwrap_or_default();
        let cycles = self.cycles(candidate)?;
        let mean = cycles.iter().sum::<f64>() / cycles.len().max(1) as f64;
        let [width, height] = request.display;
        let bits = f64::from(16 * width * height);
        Some(Predicted {
            code_bytes: cost.flash_bytes + parts.flash_bytes,
            table_bytes: self.table_bytes(types) as u32,
            buffer_bytes: buffer_bytes(model, types, request.display, *rows),
            stack_bytes: cost.stack_bytes + parts.stack_bytes,
            cycles: mean,
            most_cycles: cycles.iter().copied().fold(0.0, f64::max),
            seconds: mean / request.clock_hz + request.bus_hz.map_or(0.0, |bus| bits / bus),
        })
    }

    /// The cycles of each view.
    pub(super) fn cycles(&self, candidate: &Candidate) -> Option<Vec<f64>> {
        let (Candidate { types, rows }, core) = (candidate, self.study.request.core);
        let cost = self.costs.of(core, types)?;
        let order = self.study.order_of(types.visibility);
        let (run, runs) =
            (RunCost::of(core, types), order.map_or(0, FixedOrder::further_runs_drawn));
        let of_parts = self.part_cost(types).map_or(0.0, |cost| cost.cycles_of(self.planes(types)));
        let loads = self.study.loads(self.model(types), types, *rows);
        let slivers = self.study.sliver_cycles(types, *rows);
        let cycles = |load: &Load| cost.cycles_of(load) + run.cycles_of(runs, load) + of_parts;
        Some(loads.iter().zip(slivers).map(|(load, slivers)| cycles(load) + slivers).collect())
    }

    /// The planes between the parts that are drawn from back to front.
    fn planes(&self, types: &Types) -> usize {
        let parts = self.study.order_of(types.visibility).and_then(FixedOrder::parts);
        parts.map_or(0, |parts| parts.planes.len())
    }

    /// What parts take, for types that draw them.
    fn part_cost(&self, types: &Types) -> Option<PartCost> {
        (self.planes(types) > 0).then(|| PartCost::of(self.study.request.core, types))
    }

    /// The bytes of the model's tables.
    fn table_bytes(&self, types: &Types) -> usize {
        // The texture of a run: at most the addresses of texels and of a palette.
        let order = self.study.order_of(types.visibility);
        let of_textures = match types.paint {
            Paint::Textures(..) => 8 * order.map_or(0, FixedOrder::further_runs),
            _ => 0,
        };
        let of_parts = PartCost::table_bytes(self.planes(types));
        self.model(types).report.flash.total() + of_textures + of_parts
    }

    /// All renderers that costs are known of, and why they cannot be taken.
    pub(super) fn all(&self) -> Vec<(Candidate, Predicted, Option<Fault>)> {
        let (study, mut all) = (self.study, Vec::new());
        let is_smooth = study.is_smooth();
        for paint in study.paints() {
            for visibility in study.considered() {
                for vertices in [Vertices::Stored, Vertices::OnDemand] {
                    for rows in band_rows(study.request.display[1]) {
                        let in_bands = rows < study.request.display[1];
                        let clips = study.clips;
                        let types =
                            Types { is_smooth, paint, visibility, in_bands, vertices, clips };
                        let candidate = Candidate { types, rows };
                        let Some(predicted) = self.predict(&candidate) else { continue };
                        all.push((candidate, predicted, self.fault(&candidate, &predicted)));
                    }
                }
            }
        }
        all
    }

    fn fault(&self, candidate: &Candidate, predicted: &Predicted) -> Option<Fault> {
        let request = &self.study.request;
        let visibility = candidate.types.visibility;
        let is_in_order = visibility == Visibility::FixedOrder;
        if is_in_order && matches!(self.study.order, Search::Cycle(_)) {
            Some(Fault::Cycle)
        } else if !self.study.is_right(visibility) {
            Some(Fault::Wrong)
        } else if predicted.ram_bytes() > request.ram_bytes {
            Some(Fault::Ram)
        } else if request.flash_bytes.is_some_and(|flash| predicted.flash_bytes() > flash) {
            Some(Fault::Flash)
        } else {
            None
        }
    }

    /// The renderer with everything on, in the largest bands that fit, or the smallest.
    pub(super) fn everything(&self) -> (Candidate, Predicted) {
        let (request, paints) = (&self.study.request, self.study.paints());
        let paint = paints.first().map_or(Paint::Materials, |paint| match paint {
            Paint::Textures(_, texels, filter) => {
                Paint::Textures(Correction::Adaptive, *texels, *filter)
            }
            other => *other,
        });
        let height = request.display[1];
        let all = band_rows(height).into_iter().filter_map(|rows| {
            let types = Types { paint, in_bands: rows < height, ..EVERYTHING };
            let candidate = Candidate { types, rows };
            Some((candidate, self.predict(&candidate)?))
        });
        let all: Vec<_> = all.collect();
        let fits = |(_, predicted): &&(_, Predicted)| predicted.ram_bytes() <= request.ram_bytes;
        let found = all.iter().find(fits).or(all.last());
        *found.expect("all types have costs")
    }

    /// What other types cost more than the chosen ones.
    pub(super) fn other(
        &self,
        choice: &str,
        chosen: Candidate,
        types: Types,
        rows: u32,
    ) -> Option<Other> {
        let (own, other) = (self.predict(&chosen)?, self.predict(&Candidate { types, rows })?);
        Some(Other {
            choice: choice.into(),
            flash_bytes: i64::from(other.flash_bytes()) - i64::from(own.flash_bytes()),
            ram_bytes: i64::from(other.ram_bytes()) - i64::from(own.ram_bytes()),
            cycles: other.cycles - own.cycles,
        })
    }
}

/// What a renderer without a plan has.
const EVERYTHING: Types = Types {
    is_smooth: true,
    paint: Paint::Materials,
    visibility: Visibility::U32,
    in_bands: false,
    vertices: Vertices::Stored,
    clips: true,
};

/// The bytes of the buffers that the Rust file has.
const fn buffer_bytes(model: &Model, types: &Types, display: [u32; 2], rows: u32) -> u32 {
    let [width, height] = display;
    let wide = model.texture_coordinates.is_wide();
    let triangles = model.report.triangles;
    let pixels = width * rows * (2 + types.visibility.depth_bytes());
    let vertices = match types.vertices {
        Vertices::Stored => types.vertex_bytes(wide) * model.positions.len() as u32,
        Vertices::OnDemand => 0,
    };
    let words = match types.visibility {
        Visibility::Sorted => triangles,
        _ if types.in_bands => rasterizer::scene::bin_words(triangles, height, rows),
        _ => 0,
    };
    pixels + vertices + 4 * words as u32
}
