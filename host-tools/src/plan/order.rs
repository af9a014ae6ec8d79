//! One order of the triangles that is right in all views, if there is one: the tables in flash have
//! it, and a renderer needs neither depth nor sorting.

use std::collections::{HashMap, VecDeque};

use super::{
    Worst,
    arcs::{Arcs, Cycle},
    convex::{self, Corners},
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

/// An order of triangles that holds for tables of any contents, which have the same triangles but
/// not in the same order.
#[derive(Debug)]
pub(super) struct FixedOrder {
    triangles: Vec<Triangle>,
    /// The arcs that it obeys.
    arcs: usize,
    /// Its runs of one material, and how many materials there are.
    runs: [usize; 2],
}

/// What is the same of a triangle in all tables: its material, and its corners in quanta, the least
/// one first.
type Triangle = (usize, Corners);

impl FixedOrder {
    /// The order that arcs between the triangles of a model allow.
    pub(super) fn new(model: &Model, arcs: &Arcs) -> Option<Self> {
        let materials = model.materials_of_triangles();
        let order = arcs.order(&materials)?;
        let all = triangles(model);
        let changes = order.windows(2).filter(|pair| materials[pair[0]] != materials[pair[1]]);
        let runs = [1 + changes.count(), model.materials.len()];
        let triangles = order.iter().filter_map(|&number| all.get(number).copied()).collect();
        Some(Self { triangles, arcs: arcs.count(), runs })
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
            let drawn = reordered.last_drawn(precision, placed)?;
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

    /// The runs of a material that it has more than there are materials.
    pub(super) const fn further_runs(&self) -> usize {
        let [runs, materials] = self.runs;
        runs.saturating_sub(materials)
    }

    /// Why it is right.
    pub(super) fn reason(&self) -> String {
        let [runs, materials] = self.runs;
        let changes = if runs > materials {
            format!(", in {} runs of {} materials", thousands(runs), thousands(materials))
        } else {
            String::new()
        };
        format!(
            "{} arcs from hidden triangles to those in front of all views have no cycle, so that \
             one order in flash obeys them{changes}",
            thousands(self.arcs)
        )
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
