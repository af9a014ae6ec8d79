//! Which way round the corners of faces run.
//!
//! A face shows its front where its corners run counter-clockwise. Two faces that share an edge run
//! through it in opposite directions if both show the same side of the surface. So faces joined by
//! edges form parts, and within a part the direction of one face gives that of all others. A closed
//! part shows its outside if its signed volume is positive.

use std::path::Path;

use super::{
    polygons::{Corner, Polygons},
    quote::shown,
    report::thousands,
    vector::{Vector, add, cross, dot, scaled, sub},
};

/// What is wrong with the winding of a model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Winding {
    /// Whether each face has to be turned over.
    turns: Vec<bool>,
    /// Edges that two faces run through in the same direction.
    mixed_edges: usize,
    /// Faces to turn in parts that are mixed.
    mixed_faces: usize,
    /// Closed parts that are inside out.
    inverted_parts: usize,
    /// The faces of these.
    inverted_faces: usize,
    /// Parts that have one side only.
    one_sided: usize,
}

/// A side of a face.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Use {
    /// The smaller position, then the larger.
    edge: (u32, u32),
    face: u32,
    /// Whether it runs from the smaller position to the larger.
    is_up: bool,
}

/// Faces joined by edges.
#[derive(Default)]
struct Part {
    faces: Vec<usize>,
    is_one_sided: bool,
    is_closed: bool,
    /// The corners of its bounding box.
    bounds: [Vector; 2],
    /// Six times the signed volume once all faces run as its first one does.
    volume: f64,
    /// The same for how well the faces agree with normals of the file.
    agreement: f64,
}

/// Judges the winding of all faces. `positions` are those of the polygons, scaled so that no
/// coordinate exceeds 2.
pub(super) fn judge(polygons: &Polygons, positions: &[Vector]) -> Winding {
    let starts = starts(polygons);
    let face = |index: usize| &polygons.corners[starts[index]..starts[index + 1]];
    // In order, the uses of an edge are together, in less time and memory than in a map.
    let uses = sorted_by_key(positions.len(), |use_side| {
        for index in 0..polygons.faces.len() {
            for (from, to) in sides(face(index)) {
                let edge = (from.min(to), from.max(to));
                use_side(edge.0, Use { edge, face: index as u32, is_up: from < to });
            }
        }
    });
    let mut pairs: Vec<(u32, u32, bool)> = Vec::with_capacity(uses.len() / 2);
    let mut is_open = vec![false; polygons.faces.len()];
    let mut winding = Winding { turns: vec![false; polygons.faces.len()], ..Winding::default() };
    for uses in uses.chunk_by(|one, other| one.edge == other.edge) {
        match *uses {
            [one, other] => {
                let is_mixed = one.is_up == other.is_up;
                winding.mixed_edges += usize::from(is_mixed);
                pairs.push((one.face, other.face, is_mixed));
            }
            // Where several parts meet, it does not show which faces belong together.
            _ if uses.len().is_multiple_of(2) => {}
            _ => uses.iter().for_each(|side| is_open[side.face as usize] = true),
        }
    }
    drop(uses);
    let links = sorted_by_key(polygons.faces.len(), |link| {
        for &(one, other, is_mixed) in &pairs {
            link(one, (one, other, is_mixed));
            link(other, (other, one, is_mixed));
        }
    });
    drop(pairs);

    let mut seen = vec![false; polygons.faces.len()];
    let mut parts = Vec::new();
    for first in 0..polygons.faces.len() {
        if !seen[first] {
            parts.push(part(first, &links, &mut seen, &mut winding.turns));
        }
    }
    for part in &mut parts {
        part.is_closed = !part.faces.iter().any(|&index| is_open[index]);
        measure(part, &winding.turns, positions, face);
    }
    for part in &parts {
        winding.decide(part, &parts);
    }
    winding
}

/// Sorts items that begin with a number below `keys`, which `visit` calls its argument with, in the
/// same order each time.
///
/// Of each number there are few: they are counted, put in their places, and sorted there.
fn sorted_by_key<T: Ord + Copy + Default>(
    keys: usize,
    visit: impl Fn(&mut dyn FnMut(u32, T)),
) -> Vec<T> {
    // Where the next item of each number goes.
    let mut places = vec![0_usize; keys + 1];
    visit(&mut |key, _| places[key as usize + 1] += 1);
    for key in 0..keys {
        places[key + 1] += places[key];
    }
    let mut sorted = vec![T::default(); places[keys]];
    visit(&mut |key, item| {
        sorted[places[key as usize]] = item;
        places[key as usize] += 1;
    });
    let mut start = 0;
    for &end in &places[..keys] {
        sorted[start..end].sort_unstable();
        start = end;
    }
    sorted
}

/// Where the corners of each face begin, and where the last one's end.
fn starts(polygons: &Polygons) -> Vec<usize> {
    let ends = polygons.faces.iter().scan(0, |end, face| {
        *end += face.arity;
        Some(*end)
    });
    std::iter::once(0).chain(ends).collect()
}

/// The sides of a face from position to position, without those of no length.
fn sides(corners: &[Corner]) -> impl Iterator<Item = (u32, u32)> {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(a, b)| (a.position, b.position)).filter(|(a, b)| a != b)
}

/// Collects the part of a face, and which of its faces run against the first. `links` are sorted:
/// a face, its neighbour, and whether both run through their edge in the same direction.
fn part(first: usize, links: &[(u32, u32, bool)], seen: &mut [bool], turns: &mut [bool]) -> Part {
    let mut part = Part { faces: vec![first], ..Part::default() };
    seen[first] = true;
    let mut next = 0;
    while let Some(&index) = part.faces.get(next) {
        next += 1;
        let from = links.partition_point(|&(face, ..)| (face as usize) < index);
        let of_face = links[from..].iter().take_while(|&&(face, ..)| face as usize == index);
        for &(_, other, is_mixed) in of_face {
            let other = other as usize;
            let turn = turns[index] != is_mixed;
            if !seen[other] {
                seen[other] = true;
                turns[other] = turn;
                part.faces.push(other);
            } else if turns[other] != turn {
                part.is_one_sided = true;
            }
        }
    }
    part
}

fn measure<'a>(
    part: &mut Part,
    turns: &[bool],
    positions: &[Vector],
    face: impl Fn(usize) -> &'a [Corner],
) {
    let at = |corner: &Corner| positions[corner.position as usize];
    // Relative to a point of the part: far from the origin little of a small volume would remain.
    let origin = at(&face(part.faces[0])[0]);
    part.bounds = [origin, origin];
    for &index in &part.faces {
        let corners = face(index);
        let sign = if turns[index] { -1.0 } else { 1.0 };
        let point = |corner: &Corner| sub(at(corner), origin);
        let apex = point(&corners[0]);
        let fan = corners[1..].windows(2).map(|pair| (point(&pair[0]), point(&pair[1])));
        let area = fan.fold([0.0; 3], |sum, (b, c)| {
            part.volume += sign * dot(apex, cross(b, c));
            add(sum, cross(sub(b, apex), sub(c, apex)))
        });
        let normal = corners.iter().fold([0.0; 3], |sum, corner| add(sum, corner.normal));
        part.agreement += sign * dot(area, normal).clamp(-1.0, 1.0);
        for point in corners.iter().map(at) {
            let [least, most] = &mut part.bounds;
            *least = [0, 1, 2].map(|i| least[i].min(point[i]));
            *most = [0, 1, 2].map(|i| most[i].max(point[i]));
        }
    }
}

impl Winding {
    /// Decides which faces of a part are turned: those that run against the first one, or all
    /// others.
    fn decide(&mut self, part: &Part, parts: &[Part]) {
        let size = part.faces.len();
        let against = part.faces.iter().filter(|&&index| self.turns[index]).count();
        if part.is_one_sided {
            self.one_sided += 1;
            part.faces.iter().for_each(|&index| self.turns[index] = false);
            return;
        }
        // A closed part within another may be the wall of a hollow: it may run either way.
        let is_solid = part.is_closed && part.volume != 0.0;
        let is_judged = is_solid && (part.volume > 0.0 || !parts.iter().any(|p| p.surrounds(part)));
        let turns_others = if is_judged {
            part.volume < 0.0
        } else if part.agreement != 0.0 && !is_solid {
            part.agreement < 0.0
        } else {
            2 * against > size
        };
        if turns_others {
            part.faces.iter().for_each(|&index| self.turns[index] = !self.turns[index]);
        }
        let turned = if turns_others { size - against } else { against };
        if turned == size && is_judged {
            self.inverted_parts += 1;
            self.inverted_faces += size;
        } else if against > 0 {
            self.mixed_faces += turned;
        } else {
            // Normals of the file that point to the back: they may be meant so.
            part.faces.iter().for_each(|&index| self.turns[index] = false);
        }
    }

    /// How many faces [`mend`](Self::mend) turns over.
    pub(super) fn turned(&self) -> usize {
        self.turns.iter().filter(|&&turn| turn).count()
    }

    /// Turns faces over, with normals of the file that point to their backs.
    pub(super) fn mend(&self, polygons: &mut Polygons, positions: &[Vector]) {
        let starts = starts(polygons);
        for index in (0..self.turns.len()).filter(|&index| self.turns[index]) {
            let corners = &mut polygons.corners[starts[index]..starts[index + 1]];
            // The first corner stays the first.
            corners[1..].reverse();
            let points: Vec<Vector> =
                corners.iter().map(|corner| positions[corner.position as usize]).collect();
            let area = points[1..].windows(2).fold([0.0; 3], |sum, pair| {
                add(sum, cross(sub(pair[0], points[0]), sub(pair[1], points[0])))
            });
            for corner in corners.iter_mut().filter(|corner| dot(corner.normal, area) < 0.0) {
                corner.normal = scaled(corner.normal, -1.0);
            }
        }
    }

    /// The warning for a model that is not mended, or that cannot be.
    pub(super) fn warning(&self, path: &Path, is_mended: bool) -> Option<String> {
        let count = |number: usize, one: &str, several: &str| {
            format!("{} {}", thousands(number), if number == 1 { one } else { several })
        };
        let mut faults = Vec::new();
        if self.mixed_faces > 0 && !is_mended {
            faults.push(format!(
                "{} against neighbours ({} run through twice in one direction)",
                count(self.mixed_faces, "face runs", "faces run"),
                count(self.mixed_edges, "edge is", "edges are")
            ));
        }
        if self.inverted_parts > 0 && !is_mended {
            faults.push(format!(
                "{} of {} inside out",
                count(self.inverted_parts, "closed part", "closed parts"),
                count(self.inverted_faces, "face is", "faces are")
            ));
        }
        let mut text = faults.join(", and ");
        if !faults.is_empty() {
            text += ": culling hides them; --fix-winding (Options::fix_winding) turns them over";
        }
        if self.one_sided > 0 {
            text += if faults.is_empty() { "" } else { "; " };
            text += &count(self.one_sided, "part has", "parts have");
            text += " one side only, as a Moebius strip has: it cannot be mended, so draw it \
                     without culling";
        }
        (!text.is_empty()).then(|| format!("{}: {text}", shown(path)))
    }
}

impl Part {
    /// Whether another part lies in the bounding box of this closed one, and touches no side.
    fn surrounds(&self, other: &Self) -> bool {
        let [least, most] = self.bounds;
        let [inner_least, inner_most] = other.bounds;
        self.is_closed && (0..3).all(|i| least[i] < inner_least[i] && inner_most[i] < most[i])
    }
}
