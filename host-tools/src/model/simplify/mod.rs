//! Fewer triangles.
//!
//! The simplifier is meshoptimizer's: it collapses edges in the order of their quadric errors
//! (Garland and Heckbert, "Surface simplification using quadric error metrics", 1997), which also
//! count normals, texture coordinates and colours (Hoppe, "New quadric metric for simplifying
//! meshes with appearance attributes", 1999). An edge collapses onto one of its ends, so every
//! vertex that is left is one of the file, with its own normal and texture coordinates.

mod distance;
mod parts;

use std::path::Path;

use optimesh::simplifier::{
    Attributes, SIMPLIFY_PERMISSIVE, SIMPLIFY_VERTEX_PROTECT, SimplifyTarget, VertexData,
    simplify_with_attributes,
};
use rustc_hash::FxHashMap;

use super::{
    Contents,
    error::ModelError,
    fit,
    polygons::{Corner, Face, Polygons},
    report::Simplification,
    smoothing::Smoothing,
    triangulate::Triangle,
    vector::{Vector, key, largest, sub},
};

/// What a unit normal, a repeat of a texture and the full range of a colour count, where the size
/// of the model is 1. With half, which meshoptimizer's own programs take for normals, surfaces move
/// 1.2 to 1.7 times as far.
const WEIGHT: f32 = 0.1;

/// The attributes of a vertex: a normal, texture coordinates and a colour.
const ATTRIBUTES: usize = 8;

/// Which seams a collapse may tear. Each way reaches fewer triangles than the one before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Care {
    /// None: a seam only becomes shorter along itself, and a corner of seams stays.
    AllSeams,
    /// Those of normals alone, as in a model of flat faces.
    Placed,
    /// Also those of textures and of the colours of vertices. Borders of materials stay.
    Materials,
}

impl Care {
    const ALL: [Self; 3] = [Self::AllSeams, Self::Placed, Self::Materials];
}

/// The vertices of a model: corners that are equal in all that is kept, and their materials.
#[derive(Default)]
struct Vertices {
    corners: Vec<Corner>,
    materials: Vec<usize>,
    /// Red, green and blue from 0 to 255.
    colors: Vec<[f64; 3]>,
    indices: Vec<u32>,
}

/// A model of fewer triangles.
pub(super) struct Simplified {
    /// Its triangles as faces.
    pub polygons: Polygons,
    /// Which of the former positions each of its positions is.
    pub kept: Vec<u32>,
    /// The figures.
    pub report: Simplification,
    /// What is lost.
    pub warning: Option<String>,
}

/// Reduces a model to at most `most` triangles; `None` if it has no more than these.
///
/// `triangles` are those of `polygons`, `normals` those of their corners, if `contents` keeps
/// some, and `shape` the positions, scaled so that no coordinate exceeds 2. `is_textured` tells
/// whether texture coordinates are kept.
///
/// # Errors
///
/// Returns an error if that few triangles cannot be reached.
pub(super) fn simplify(
    path: &Path,
    (polygons, shape): (&Polygons, &[Vector]),
    (triangles, normals): (&[Triangle], &[[Vector; 3]]),
    (contents, is_textured): (Contents, bool),
    most: usize,
) -> Result<Option<Simplified>, ModelError> {
    if triangles.len() <= most {
        return Ok(None);
    }
    let vertices = Vertices::of(polygons, (triangles, normals), contents, is_textured);
    let mut least = triangles.len();
    let found = Care::ALL.into_iter().find_map(|care| {
        let indices = vertices.simplified(shape, most, care);
        if indices.is_empty() {
            return None;
        }
        least = least.min(indices.len() / 3);
        (indices.len() / 3 <= most).then_some(indices)
    });
    let Some(indices) = found else {
        return Err(ModelError::TooFewTriangles { path: path.into(), most, least });
    };

    let before: Vec<[Vector; 3]> = (triangles.iter())
        .map(|triangle| triangle.corners.map(|corner| shape[corner.position as usize]))
        .collect();
    let (corners, materials) = vertices.faces(&indices);
    let after: Vec<[Vector; 3]> = (corners.chunks_exact(3))
        .map(|corners| [0, 1, 2].map(|i| shape[corners[i].position as usize]))
        .collect();
    let distance = distance::between(&before, &after);
    // A power of two.
    let unit = largest_of(&polygons.positions) / largest_of(shape);
    let report = Simplification {
        triangles_before: triangles.len(),
        distance_max: distance.most * unit,
        distance_rms: distance.root_mean_square * unit,
        size: fit::diagonal(before.as_flattened()) * unit,
    };
    let before: Vec<Corner> = triangles.iter().flat_map(|triangle| triangle.corners).collect();
    let warning = parts::warning(path, &before, &corners);
    let (polygons, kept) = replaced(polygons, corners, &materials);
    Ok(Some(Simplified { polygons, kept, report, warning }))
}

fn largest_of(positions: &[Vector]) -> f64 {
    positions.iter().fold(0.0, |most: f64, &p| most.max(largest(p)))
}

impl Vertices {
    /// Merges equal corners of a material.
    fn of(
        polygons: &Polygons,
        (triangles, normals): (&[Triangle], &[[Vector; 3]]),
        contents: Contents,
        is_textured: bool,
    ) -> Self {
        let has_colors = contents.vertex_colors && !polygons.vertex_colors.is_empty();
        let mut vertices = Self::default();
        let mut known = FxHashMap::default();
        for (index, triangle) in triangles.iter().enumerate() {
            for (number, &corner) in triangle.corners.iter().enumerate() {
                let normal = normals.get(index).map_or(corner.normal, |normals| normals[number]);
                let texture = if is_textured { corner.texture } else { [0.0; 2] };
                let material = triangle.material;
                let color = polygons.color(corner.color, material);
                let color = if has_colors { color } else { [0.0; 3] };
                let normal = if contents.vertex_normals { normal } else { [0.0; 3] };
                let equal = (corner.position, key(normal), key(texture), key(color), material);
                let vertex = *known.entry(equal).or_insert_with(|| {
                    vertices.corners.push(Corner { normal, ..corner });
                    vertices.materials.push(material);
                    vertices.colors.push(color);
                    vertices.corners.len() as u32 - 1
                });
                vertices.indices.push(vertex);
            }
        }
        vertices
    }

    /// The indices of at most `most` triangles, or of more if these cannot be reached.
    fn simplified(&self, shape: &[Vector], most: usize, care: Care) -> Vec<u32> {
        let count = self.corners.len();
        let places: Vec<Vector> =
            self.corners.iter().map(|corner| shape[corner.position as usize]).collect();
        // From the first vertex, so that a small model far from the origin keeps its digits.
        let origin = places[0];
        let positions: Vec<f32> =
            places.iter().flat_map(|&place| sub(place, origin).map(|c| c as f32)).collect();
        let attributes: Vec<f32> = (self.corners.iter().zip(&self.colors))
            .flat_map(|(corner, color)| {
                let color = color.map(|channel| channel / 255.0);
                corner.normal.into_iter().chain(corner.texture).chain(color)
            })
            .map(|value| value as f32)
            .collect();
        let stride = |numbers: usize| numbers * size_of::<f32>();
        let target = SimplifyTarget {
            target_index_count: most * 3,
            // The number of triangles alone ends it. Its square is a number too.
            target_error: 1e10,
            options: if care == Care::AllSeams { 0 } else { SIMPLIFY_PERMISSIVE },
        };
        let mut indices = vec![0; self.indices.len()];
        let (length, _) = simplify_with_attributes(
            &mut indices,
            &self.indices,
            &VertexData { positions: &positions, count, stride: stride(3) },
            &Attributes {
                data: &attributes,
                stride: stride(ATTRIBUTES),
                weights: &[WEIGHT; ATTRIBUTES],
                count: ATTRIBUTES,
            },
            Some(&self.protected(care)),
            &target,
        );
        indices.truncate(length);
        indices
    }

    /// Marks the vertices on seams that must not be torn.
    fn protected(&self, care: Care) -> Vec<u8> {
        let texture = |vertex: usize| match care {
            Care::Materials => None,
            Care::AllSeams | Care::Placed => {
                Some((key(self.corners[vertex].texture), key(self.colors[vertex])))
            }
        };
        let kind = |vertex: usize| (self.materials[vertex], texture(vertex));
        let mut first = FxHashMap::default();
        let mut is_seam = FxHashMap::default();
        for (vertex, corner) in self.corners.iter().enumerate() {
            let one = *first.entry(corner.position).or_insert(vertex);
            *is_seam.entry(corner.position).or_insert(false) |= kind(one) != kind(vertex);
        }
        let mark = |corner: &Corner| {
            if is_seam[&corner.position] { SIMPLIFY_VERTEX_PROTECT } else { 0 }
        };
        self.corners.iter().map(mark).collect()
    }

    /// The corners of the triangles, and the material of each. Where a seam is torn, the material
    /// is that of most corners.
    fn faces(&self, indices: &[u32]) -> (Vec<Corner>, Vec<usize>) {
        let corners = indices.iter().map(|&vertex| self.corners[vertex as usize]).collect();
        let material = |vertices: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|i| self.materials[vertices[i] as usize]);
            if b == c { b } else { a }
        };
        (corners, indices.chunks_exact(3).map(material).collect())
    }
}

/// The polygons with other faces: triangles of these corners and materials. Positions that nothing
/// uses are left out; also returns which each one is.
fn replaced(
    polygons: &Polygons,
    corners: Vec<Corner>,
    materials: &[usize],
) -> (Polygons, Vec<u32>) {
    let mut kept = Vec::new();
    let mut known = vec![None; polygons.positions.len()];
    let mut renumber = |position: &mut u32| {
        *position = *known[*position as usize].get_or_insert_with(|| {
            kept.push(*position);
            kept.len() as u32 - 1
        });
    };
    let mut corners = corners;
    let (mut lines, mut points) = (polygons.lines.clone(), polygons.points.clone());
    corners.iter_mut().for_each(|corner| renumber(&mut corner.position));
    lines
        .iter_mut()
        .flat_map(|line| &mut line.vertices)
        .for_each(|end| renumber(&mut end.position));
    (points.iter_mut().flat_map(|point| &mut point.vertices))
        .for_each(|end| renumber(&mut end.position));
    let face = |&material: &usize| Face { arity: 3, material, smoothing: Smoothing::Unstated };
    let polygons = Polygons {
        positions: kept.iter().map(|&i| polygons.positions[i as usize]).collect(),
        corners,
        faces: materials.iter().map(face).collect(),
        lines,
        points,
        colors: polygons.colors.clone(),
        vertex_colors: polygons.vertex_colors.clone(),
    };
    (polygons, kept)
}

/// The line of each triangle of a simplified model: that of the first face of the file at its first
/// corner. `lines` are those of the faces of `polygons`, which `simplified` is made from.
pub(super) fn lines_of(
    polygons: &Polygons,
    lines: &[usize],
    simplified: &Simplified,
) -> Vec<usize> {
    let mut first = vec![0; polygons.positions.len()];
    let mut start = 0;
    for (face, &line) in polygons.faces.iter().zip(lines) {
        for corner in &polygons.corners[start..start + face.arity] {
            let known = &mut first[corner.position as usize];
            if *known == 0 {
                *known = line;
            }
        }
        start += face.arity;
    }
    let line = |corners: &[Corner]| first[simplified.kept[corners[0].position as usize] as usize];
    simplified.polygons.corners.chunks_exact(3).map(line).collect()
}
