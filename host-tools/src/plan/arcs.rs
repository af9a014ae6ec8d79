//! Which triangles must be drawn before which, so that the nearest one is always the last.
//!
//! In a view a pixel shows the nearest of the triangles that cover it. Each other one is hidden
//! there, and must be drawn before: an arc from it to the one in front. What is right for the arcs
//! of all views is right in all of them. If arcs lead in a circle, no order is.

use std::collections::VecDeque;

use rustc_hash::FxHashMap;

/// Arcs between triangles, which go by their numbers in the tables.
#[derive(Debug)]
pub(super) struct Arcs {
    triangles: usize,
    /// Each arc, from the hidden triangle to the one in front, with the first view that has it.
    views: FxHashMap<[u32; 2], u32>,
}

/// Triangles each of which is behind the next, and the last behind the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Cycle {
    /// The triangles, each with a view in which it is behind the next one.
    pub(super) steps: Vec<(u32, u32)>,
    /// How many triangles lie in cycles.
    pub(super) triangles: usize,
}

/// The most members of a component that the shortest cycle is sought from: each takes a search
/// through all arcs of the component.
const MOST_SEARCHES: usize = 64;

impl Arcs {
    /// None between some triangles.
    pub(super) fn new(triangles: usize) -> Self {
        Self { triangles, views: FxHashMap::default() }
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.views.len()
    }

    /// Adds one that a view has.
    pub(super) fn add(&mut self, hidden: u32, front: u32, view: u32) {
        self.views.entry([hidden, front]).or_insert(view);
    }

    /// For each triangle those that must be drawn after it, in order of their numbers.
    fn later(&self) -> Vec<Vec<u32>> {
        let mut later = vec![Vec::new(); self.triangles];
        for &[hidden, front] in self.views.keys() {
            later[hidden as usize].push(front);
        }
        later.iter_mut().for_each(|fronts: &mut Vec<u32>| fronts.sort_unstable());
        later
    }

    /// A short cycle, if there is any.
    pub(super) fn cycle(&self) -> Option<Cycle> {
        let later = self.later();
        let components = components(&later);
        let mut component_of = vec![usize::MAX; self.triangles];
        for (number, members) in components.iter().enumerate() {
            members.iter().for_each(|&member| component_of[member as usize] = number);
        }
        let smallest = components.iter().min_by_key(|members| members.len())?;
        let within = |from: u32, to: u32| component_of[from as usize] == component_of[to as usize];
        let searches = smallest.iter().take(MOST_SEARCHES);
        let rings = searches.filter_map(|&member| shortest_ring(&later, member, within));
        let ring = rings.min_by_key(Vec::len)?;
        let next = ring.iter().cycle().skip(1);
        let view = |(&from, &to)| (from, self.views.get(&[from, to]).copied().unwrap_or(0));
        Some(Cycle {
            steps: ring.iter().zip(next).map(view).collect(),
            triangles: components.iter().map(Vec::len).sum(),
        })
    }

    /// An order that all arcs allow, or `None` if they have a cycle (Kahn, *Topological sorting of
    /// large networks*, 1962). It stays in a material as long as it can, and takes the lowest
    /// number first: without arcs it is that of tables that are sorted by material.
    pub(super) fn order(&self, materials: &[usize]) -> Option<Vec<usize>> {
        use std::{cmp::Reverse, collections::BinaryHeap};
        let later = self.later();
        let mut before = vec![0_u32; self.triangles];
        later.iter().flatten().for_each(|&front| before[front as usize] += 1);
        let count = materials.iter().max().map_or(0, |most| most + 1);
        let mut ready = vec![BinaryHeap::new(); count];
        for (triangle, _) in before.iter().enumerate().filter(|(_, before)| **before == 0) {
            ready[materials[triangle]].push(Reverse(triangle));
        }
        let (mut order, mut material) = (Vec::with_capacity(self.triangles), 0);
        loop {
            if ready.get(material).is_none_or(BinaryHeap::is_empty) {
                let first = |&material: &usize| ready[material].peek().map(|least| least.0);
                let next =
                    (0..count).filter(|material| first(material).is_some()).min_by_key(first);
                let Some(next) = next else { break };
                material = next;
            }
            let Some(Reverse(triangle)) = ready[material].pop() else { break };
            order.push(triangle);
            for &front in &later[triangle] {
                let front = front as usize;
                before[front] -= 1;
                if before[front] == 0 {
                    ready[materials[front]].push(Reverse(front));
                }
            }
        }
        (order.len() == self.triangles).then_some(order)
    }
}

/// The strongly connected components of more than one member (Tarjan, *Depth-first search and
/// linear graph algorithms*, 1972), without recursion, as a path may be as long as there are
/// triangles.
fn components(later: &[Vec<u32>]) -> Vec<Vec<u32>> {
    const UNSEEN: u32 = u32::MAX;
    let count = later.len();
    let (mut index, mut low, mut is_open) =
        (vec![UNSEEN; count], vec![0; count], vec![false; count]);
    let (mut open, mut seen, mut found) = (Vec::new(), 0, Vec::new());
    for root in 0..count {
        if index[root] != UNSEEN {
            continue;
        }
        // The path from the root, each with the number of its arcs that have been followed.
        let mut path = vec![(root, 0)];
        while let Some((node, followed)) = path.last_mut() {
            let node = *node;
            if *followed == 0 && index[node] == UNSEEN {
                (index[node], low[node], is_open[node]) = (seen, seen, true);
                seen += 1;
                open.push(node as u32);
            }
            if let Some(&next) = later[node].get(*followed) {
                *followed += 1;
                let next = next as usize;
                if index[next] == UNSEEN {
                    path.push((next, 0));
                } else if is_open[next] {
                    low[node] = low[node].min(index[next]);
                }
                continue;
            }
            if low[node] == index[node] {
                let first = open.iter().rposition(|&member| member as usize == node).unwrap_or(0);
                let members = open.split_off(first);
                members.iter().for_each(|&member| is_open[member as usize] = false);
                if members.len() > 1 {
                    found.push(members);
                }
            }
            path.pop();
            if let Some(&(parent, _)) = path.last() {
                low[parent] = low[parent].min(low[node]);
            }
        }
    }
    found
}

/// The shortest way from a triangle to itself over arcs that stay `within` its component.
fn shortest_ring(
    later: &[Vec<u32>],
    start: u32,
    within: impl Fn(u32, u32) -> bool,
) -> Option<Vec<u32>> {
    let mut from: FxHashMap<u32, u32> = FxHashMap::default();
    let mut waiting = VecDeque::from([start]);
    while let Some(node) = waiting.pop_front() {
        for &next in later[node as usize].iter().filter(|&&next| within(start, next)) {
            if next == start {
                let mut ring = vec![node];
                while let Some(&before) = ring.last().and_then(|last| from.get(last)) {
                    ring.push(before);
                }
                ring.reverse();
                return Some(ring);
            }
            from.entry(next).or_insert_with(|| {
                waiting.push_back(next);
                node
            });
        }
    }
    None
}

impl std::fmt::Display for Cycle {
    /// Names the triangles and the views.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        /// As many as a reader follows.
        const MOST_STEPS: usize = 4;
        for (place, pair) in self.steps.windows(2).take(MOST_STEPS - 1).enumerate() {
            let [(behind, view), (front, _)] = [pair[0], pair[1]];
            let start = if place == 0 { "triangle " } else { "" };
            write!(f, "{start}{behind} is behind {front} in view {view}, ")?;
        }
        match (self.steps.first(), self.steps.last()) {
            (Some((first, _)), Some((last, view))) if self.steps.len() <= MOST_STEPS => {
                write!(f, "{last} behind {first} in view {view}")
            }
            (Some((first, _)), _) => {
                write!(f, "and so on over {} triangles back to {first}", self.steps.len())
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::random::Random;

    /// All of one material.
    fn arcs(triangles: usize, pairs: &[[u32; 2]]) -> Arcs {
        let mut arcs = Arcs::new(triangles);
        for (view, &[hidden, front]) in pairs.iter().enumerate() {
            arcs.add(hidden, front, view as u32);
        }
        arcs
    }

    #[test]
    fn without_arcs_the_order_stays() {
        assert_eq!(arcs(4, &[]).order(&[0, 0, 1, 1]), Some(vec![0, 1, 2, 3]));
        assert_eq!(arcs(4, &[]).cycle(), None);
    }

    #[test]
    fn an_order_changes_material_as_seldom_as_it_must() {
        // The last triangle of the second material lies behind the first of the first one.
        let found = arcs(4, &[[3, 0]]).order(&[0, 0, 1, 1]);
        assert_eq!(found, Some(vec![1, 2, 3, 0]));
        // Of several other materials that with the lowest number comes first.
        let found = arcs(6, &[[4, 0], [4, 1]]).order(&[0, 0, 1, 1, 2, 2]);
        assert_eq!(found, Some(vec![2, 3, 4, 5, 0, 1]));
    }

    #[test]
    fn the_shortest_cycle_is_named_with_its_views() {
        // A circle of four with a short way across, and a triangle that only leads into it.
        let arcs = arcs(6, &[[0, 1], [1, 2], [2, 3], [3, 0], [1, 3], [5, 0]]);
        assert_eq!(arcs.order(&[0; 6]), None);
        let cycle = arcs.cycle().unwrap();
        let mut steps = cycle.steps.clone();
        steps.sort_unstable();
        assert_eq!((steps, cycle.triangles), (vec![(0, 0), (1, 4), (3, 3)], 4));
        let text = cycle.to_string();
        assert!(text.contains("1 is behind 3 in view 4"), "{text}");
    }

    #[test]
    fn a_long_path_needs_no_deep_stack() {
        let count = 30_000;
        let mut pairs: Vec<[u32; 2]> = (1..count).map(|i| [i, i - 1]).collect();
        assert_eq!(arcs(count as usize, &pairs).cycle(), None);
        pairs.push([0, count - 1]);
        assert_eq!(arcs(count as usize, &pairs).cycle().unwrap().triangles, count as usize);
    }

    #[test]
    fn an_order_exists_where_there_is_no_cycle_and_obeys_all_arcs() {
        let mut random = Random(7);
        let (mut with, mut without) = (0, 0);
        for round in 0..300 {
            let count = 12;
            let number = |random: &mut Random| random.real(0.0, f64::from(count)) as u32;
            let pairs: Vec<[u32; 2]> = (0..4 + round % 16)
                .map(|_| [number(&mut random), number(&mut random)])
                .filter(|[hidden, front]| hidden != front)
                .collect();
            let materials: Vec<usize> = (0..count).map(|i| i as usize / 5).collect();
            let arcs = arcs(count as usize, &pairs);
            let order = arcs.order(&materials);
            assert_eq!(order.is_none(), arcs.cycle().is_some(), "{pairs:?}");
            let Some(order) = order else {
                with += 1;
                continue;
            };
            without += 1;
            let place =
                |triangle: u32| order.iter().position(|&other| other == triangle as usize).unwrap();
            assert!(pairs.iter().all(|&[hidden, front]| place(hidden) < place(front)));
        }
        assert!(with > 50 && without > 50, "{with} {without}");
    }
}
