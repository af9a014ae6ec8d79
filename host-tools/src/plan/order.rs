//! One order of the triangles that is right in all views, if there is one, for the whole mesh or
//! for each of its parts: the tables in flash have it, and a renderer needs neither depth nor
//! sorting.

use std::collections::{HashMap, VecDeque};

use super::{
    Worst,
    arcs::{Arcs, Cycle},
    convex::{self, Corners},
    partition::Partition,
    seen::Eye,
    views::Placed,
};
use crate::{
    check::{Subpixel, ViewError},
    model::{Model, thousands},
};

/// What is known about such an order.
#[derive(Debug)]
pub(super) enum Search {
    /// It is not needed: that of the mesh is right.
    Unneeded,
    /// It would not help: what is behind holes in a texture must be known too.
    Holes,
    /// There is none.
    Cycle(Cycle),
    /// There is one.
    Found(FixedOrder),
}

/// The arcs of the views that have been looked at, until they have a cycle.
#[derive(Debug)]
pub(super) struct Known {
    arcs: Arcs,
    cycle: Option<Cycle>,
}

impl Known {
    fn new(triangles: usize) -> Self {
        Self { arcs: Arcs::new(triangles), cycle: None }
    }

    /// Looks for a cycle.
    fn check(&mut self) {
        if self.cycle.is_none() {
            self.cycle = self.arcs.cycle();
        }
    }

    /// The arcs, or a cycle of them.
    pub(super) fn arcs(self) -> Result<Arcs, Cycle> {
        self.cycle.map_or(Ok(self.arcs), Err)
    }
}

/// What is found out about orders of a mesh, and of its parts.
#[derive(Debug)]
pub(super) struct Orders {
    pub(super) whole: Known,
    /// The parts, that of each triangle, and the arcs within them.
    parts: Option<(Partition, Vec<u8>, Known)>,
}

impl Orders {
    /// Nothing yet.
    pub(super) fn new(model: &Model) -> Self {
        let new = || Known::new(model.report.triangles);
        let parts = Partition::of(model).map(|parts| {
            let part_of = parts.part_of_triangles();
            (parts, part_of, new())
        });
        Self { whole: new(), parts }
    }

    /// Adds an arc that a view has.
    pub(super) fn add(&mut self, hidden: u32, front: u32, view: u32) {
        if self.whole.cycle.is_none() {
            self.whole.arcs.add(hidden, front, view);
        }
        if let Some((_, part_of, known)) = &mut self.parts {
            let is_within = part_of[hidden as usize] == part_of[front as usize];
            if is_within && known.cycle.is_none() {
                known.arcs.add(hidden, front, view);
            }
        }
    }

    /// Looks for cycles.
    pub(super) fn check(&mut self) {
        self.whole.check();
        if let Some((.., known)) = &mut self.parts {
            known.check();
        }
    }

    /// Whether no further view can change anything.
    pub(super) fn are_refused(&self) -> bool {
        let is_refused = |known: &Known| known.cycle.is_some();
        is_refused(&self.whole) && self.parts.as_ref().is_none_or(|(.., known)| is_refused(known))
    }

    /// An order of the parts' triangles, if there is one; and what is known of the whole.
    pub(super) fn into_parts(self, model: &Model) -> (Option<FixedOrder>, Known) {
        let order = |(parts, _, known): (Partition, Vec<u8>, Known)| {
            FixedOrder::new(model, &known.arcs().ok()?, Some(parts))
        };
        (self.parts.and_then(order), self.whole)
    }
}

/// An order of triangles that holds for tables of any contents, which have the same triangles but
/// not in the same order.
#[derive(Debug)]
pub(super) struct FixedOrder {
    triangles: Vec<Triangle>,
    /// The arcs that it obeys.
    arcs: usize,
    /// How many materials there are, how many runs of one material the tables have, and how many
    /// are drawn: some run on from one part to the next.
    runs: [usize; 3],
    /// The parts that planes keep apart, one behind the other in this order.
    parts: Option<Partition>,
}

/// What is the same of a triangle in all tables: its material, and its corners in quanta, the least
/// one first.
type Triangle = (usize, Corners);

impl FixedOrder {
    /// The order that arcs between the triangles of a model allow, or between those within parts.
    pub(super) fn new(model: &Model, arcs: &Arcs, parts: Option<Partition>) -> Option<Self> {
        let materials = model.materials_of_triangles();
        let mut order = arcs.order(&materials)?;
        let part_of = match &parts {
            Some(parts) => parts.part_of_triangles(),
            None => vec![0; order.len()],
        };
        // Stable: within a part the order stays.
        order.sort_by_key(|&number| part_of[number]);
        let all = triangles(model);
        let count = |differ: &dyn Fn(usize, usize) -> bool| {
            1 + order.windows(2).filter(|pair| differ(pair[0], pair[1])).count()
        };
        let in_tables = count(&|a, b| materials[a] != materials[b]);
        let drawn = count(&|a, b| materials[a] != materials[b] || part_of[a] != part_of[b]);
        let runs = [model.materials.len(), in_tables, drawn];
        let triangles = order.iter().filter_map(|&number| all.get(number).copied()).collect();
        Some(Self { triangles, arcs: arcs.count(), runs, parts })
    }

    /// The parts that are drawn from back to front.
    pub(super) const fn parts(&self) -> Option<&Partition> {
        self.parts.as_ref()
    }

    /// The places of its triangles in the tables of a model.
    fn places(&self, model: &Model) -> Vec<usize> {
        let mut places: HashMap<Triangle, VecDeque<usize>> = HashMap::new();
        for (place, triangle) in triangles(model).into_iter().enumerate() {
            places.entry(triangle).or_default().push_back(place);
        }
        let next = |triangle| places.get_mut(triangle).and_then(VecDeque::pop_front);
        let mut order: Vec<usize> = self.triangles.iter().filter_map(next).collect();
        // Of a file that has changed meanwhile.
        let mut rest: Vec<usize> = places.into_values().flatten().collect();
        rest.sort_unstable();
        order.append(&mut rest);
        order
    }

    /// A model with its triangles in this order.
    pub(super) fn applied(&self, model: Model) -> Model {
        let places = self.places(&model);
        model.reordered(&places)
    }

    /// The worst of some views in this order, against the depth of the model as it was.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses a view.
    pub(super) fn judge(
        &self,
        model: &Model,
        eye: &Eye<'_>,
        precision: Subpixel,
        views: &[Placed],
    ) -> Result<Worst, ViewError> {
        let places = self.places(model);
        let ordered = model.clone().reordered(&places);
        let mesh = ordered.mesh();
        let reordered = Eye { mesh: &mesh, ..*eye };
        let mut worst = Worst::default();
        for (view, placed) in views.iter().enumerate() {
            let expected = eye.nearest(precision, placed)?;
            let drawn = reordered.last_drawn(precision, placed, self.parts())?;
            let original = |face: u32| match face.checked_sub(1) {
                Some(number) => places[number as usize] as u32 + 1,
                None => 0,
            };
            let pairs = || expected.iter().zip(&drawn);
            let wrong = pairs().filter(|&(&face, &drawn)| face != original(drawn)).count();
            let shown = expected.iter().filter(|&&face| face > 0).count();
            worst = worst.or_worse(Worst::new(view, wrong, shown));
        }
        Ok(worst)
    }

    /// The runs of a material that the tables have more than there are materials.
    pub(super) const fn further_runs(&self) -> usize {
        let [materials, in_tables, _] = self.runs;
        in_tables.saturating_sub(materials)
    }

    /// Those that are drawn.
    pub(super) const fn further_runs_drawn(&self) -> usize {
        let [materials, _, drawn] = self.runs;
        drawn.saturating_sub(materials)
    }

    /// Whether it is right in all views, whichever they are.
    pub(super) fn is_proven(&self) -> bool {
        self.parts.as_ref().is_some_and(|parts| parts.is_convex)
    }

    /// Why it is right.
    pub(super) fn reason(&self) -> String {
        let [materials, _, runs] = self.runs;
        let changes = if runs > materials {
            format!(", in {} runs of {} materials", thousands(runs), thousands(materials))
        } else {
            String::new()
        };
        let arcs = thousands(self.arcs);
        match &self.parts {
            Some(parts) if parts.is_convex => format!(
                "planes keep {} parts apart in each of which no triangle can hide another one{changes}",
                parts.count()
            ),
            Some(parts) => format!(
                "planes keep {} parts apart; {arcs} arcs from hidden triangles to those in front \
                 within them have no cycle{changes}",
                parts.count()
            ),
            None => format!(
                "{arcs} arcs from hidden triangles to those in front of all views have no cycle, so \
                 that one order in flash obeys them{changes}"
            ),
        }
    }
}

/// The triangles of a model's tables.
fn triangles(model: &Model) -> Vec<Triangle> {
    let materials = model.materials_of_triangles();
    let triangle = |(mut places, material): (Corners, usize)| {
        let least = (0..3).min_by_key(|&corner| places[corner]).unwrap_or(0);
        places.rotate_left(least);
        (material, places)
    };
    convex::triangles(model).into_iter().zip(materials).map(triangle).collect()
}
