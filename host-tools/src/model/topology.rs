//! What the files of an animation have in common: faces, texture coordinates and materials, and
//! lines and points.

use std::path::{Path, PathBuf};

use super::{
    error::{Difference, ModelError},
    quote::quote,
    validate::Checked,
};

/// The parts of a file that do not move.
#[derive(Clone, Debug)]
pub(super) struct Topology<'a> {
    path: PathBuf,
    checked: &'a Checked,
    faces: Vec<Face>,
}

/// A face.
#[derive(Clone, Debug, PartialEq)]
struct Face {
    line: usize,
    /// The index of the material's name.
    material: Option<usize>,
    /// The vertex of each corner, from 1, and its texture coordinates if it has any.
    corners: Vec<(usize, Option<[f64; 2]>)>,
}

impl<'a> Topology<'a> {
    /// Reads it from the statements that `check` has written.
    pub(super) fn of(path: &Path, checked: &'a Checked) -> Self {
        let (mut textures, mut faces, mut material) = (Vec::new(), Vec::new(), None);
        let mut lines = checked.face_lines.iter();
        for statement in checked.text.lines() {
            let mut words = statement.split(' ');
            match words.next() {
                Some("vt") => {
                    let mut number = || words.next().and_then(|word| word.parse().ok());
                    textures.push([number(), number()].map(Option::unwrap_or_default));
                }
                Some("usemtl") => material = words.next().and_then(|word| word.parse().ok()),
                Some("f") => {
                    // The last texture coordinates stand for none.
                    let known = textures.len().saturating_sub(1);
                    let corner = |word: &str| {
                        let mut indices =
                            word.split('/').map(|index| index.parse::<usize>().unwrap_or(0));
                        let [vertex, texture] = [(); 2].map(|()| indices.next().unwrap_or(0));
                        let texture = texture.checked_sub(1).filter(|&index| index < known);
                        (vertex, texture.map(|index| textures[index]))
                    };
                    let corners = words.map(corner).collect();
                    let line = lines.next().copied().unwrap_or(0);
                    faces.push(Face { line, material, corners });
                }
                _ => {}
            }
        }
        Self { path: path.into(), checked, faces }
    }

    /// Compares another file with this one.
    pub(super) fn compare(&self, other: &Self) -> Result<(), ModelError> {
        let differs = |line: usize, first_line: usize, difference| ModelError::Topology {
            path: other.path.clone(),
            line,
            first: self.path.clone(),
            first_line,
            difference,
        };
        for (ours, theirs) in self.faces.iter().zip(&other.faces) {
            if let Some(difference) = self.difference(ours, other, theirs) {
                return Err(differs(theirs.line, ours.line, difference));
            }
        }
        let last = |topology: &Self| topology.faces.last().map_or(1, |face| face.line);
        let counts = [other.faces.len(), self.faces.len()];
        if counts[0] != counts[1] {
            let line_of = |topology: &Self| {
                let surplus = topology.faces.get(counts[0].min(counts[1]));
                surplus.map_or_else(|| last(topology), |face| face.line)
            };
            let difference = Difference::FaceCount { counts };
            return Err(differs(line_of(other), line_of(self), difference));
        }
        let (ours, theirs) = (&self.checked.elements, &other.checked.elements);
        if ours.lines != theirs.lines || ours.points != theirs.points {
            return Err(differs(last(other), last(self), Difference::Elements));
        }
        // Of materials that no face has.
        let names = |topology: &Self| topology.checked.materials.clone();
        let (ours, theirs) = (names(self), names(other));
        let longest = ours.len().max(theirs.len());
        let name = |names: &[(usize, Vec<u8>)], index: usize| names.get(index).cloned();
        for index in 0..longest {
            let [ours, theirs] = [&ours, &theirs].map(|names| name(names, index));
            if ours.as_ref().map(|(_, name)| name) != theirs.as_ref().map(|(_, name)| name) {
                let lines = [&theirs, &ours].map(|own| own.as_ref().map(|(line, _)| *line));
                let names = [theirs, ours].map(|own| own.map(|(_, name)| quote(&name)));
                return Err(differs(
                    lines[0].unwrap_or_else(|| last(other)),
                    lines[1].unwrap_or_else(|| last(self)),
                    Difference::Material { names },
                ));
            }
        }
        Ok(())
    }

    /// The first difference of a face of another file, `theirs`, from one of this file.
    fn difference(&self, ours: &Face, other: &Self, theirs: &Face) -> Option<Difference> {
        let name = |topology: &Self, face: &Face| {
            let material = topology.checked.materials.get(face.material?)?;
            Some(material.1.clone())
        };
        let names = [name(other, theirs), name(self, ours)];
        if names[0] != names[1] {
            let names = names.map(|name| name.map(|name| quote(&name)));
            return Some(Difference::Material { names });
        }
        let counts = [theirs.corners.len(), ours.corners.len()];
        if counts[0] != counts[1] {
            return Some(Difference::CornerCount { counts });
        }
        let pairs = theirs.corners.iter().zip(&ours.corners).enumerate();
        for (index, (&(vertex, texture), &(our_vertex, our_texture))) in pairs {
            let corner = index + 1;
            if vertex != our_vertex {
                return Some(Difference::Vertex { corner, vertices: [vertex, our_vertex] });
            }
            if texture != our_texture {
                return Some(Difference::Texture { corner, textures: [texture, our_texture] });
            }
        }
        None
    }
}
