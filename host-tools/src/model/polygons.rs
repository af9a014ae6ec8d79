//! The polygons of an OBJ file, as `tobj` reads them, and its lines and points.

use std::{collections::HashMap, path::Path};

use super::{
    elements::{Drawn, Element, End, FileVertex},
    error::ModelError,
    libraries::{self, Libraries},
    smoothing::Smoothing,
    validate::Checked,
    vector::{Vector, key},
};

/// All faces of a file, its lines and its points.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygons {
    /// The positions that all these use, each once, as written in the file.
    pub positions: Vec<Vector>,
    /// The corners of the faces, one face after the other.
    pub corners: Vec<Corner>,
    /// The faces.
    pub faces: Vec<Face>,
    /// The lines.
    pub lines: Vec<Drawn<2>>,
    /// The points.
    pub points: Vec<Drawn<1>>,
    /// The materials' colours.
    pub colors: Vec<[u8; 3]>,
    /// The colours of vertices from 0 to 255, which these name; none if the file has none.
    pub vertex_colors: Vec<[f64; 3]>,
}

/// A face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Face {
    /// How many corners it has.
    pub arity: usize,
    /// Its material.
    pub material: usize,
    /// Its smoothing group.
    pub smoothing: Smoothing,
}

/// A corner of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    /// Index of its position in [`Polygons::positions`].
    pub position: u32,
    /// Its normal in the file, of any length; 0 without one.
    pub normal: Vector,
    /// Its texture coordinates, v running upwards: those of the file, placed as the material's
    /// texture wants them.
    pub texture: [f64; 2],
    /// Index of its colour in [`Polygons::vertex_colors`], or [`NO_COLOR`].
    pub color: u32,
}

/// A corner without a colour: that of its material counts.
pub(super) const NO_COLOR: u32 = u32::MAX;

impl Polygons {
    /// The colour of a corner of a face with this material, from 0 to 255.
    pub(super) fn color(&self, corner: u32, material: usize) -> [f64; 3] {
        let own = self.vertex_colors.get(corner as usize).copied();
        own.unwrap_or_else(|| self.colors[material].map(f64::from))
    }
}

/// Parses a checked file.
pub(super) fn read(
    path: &Path,
    checked: &Checked,
    libraries: &Libraries,
) -> Result<Polygons, ModelError> {
    // The default keeps polygons whole and the three indices of a corner apart.
    let options = tobj::LoadOptions::default();
    let materials = libraries.chosen.iter().enumerate();
    let named: HashMap<String, usize> =
        materials.filter_map(|(name, &chosen)| Some((name.to_string(), chosen?))).collect();
    let (models, _) = tobj::load_obj_buf(&mut checked.text.as_bytes(), &options, |_| {
        Ok((Vec::new(), named.clone()))
    })
    .map_err(|source| ModelError::Parse { path: path.into(), source })?;

    let mut polygons = Polygons {
        // The last one is for faces without a material.
        colors: (libraries.materials.iter().map(|material| material.color))
            .chain([libraries::DEFAULT_COLOR])
            .collect(),
        ..Polygons::default()
    };
    let mut known = HashMap::new();
    // `tobj` keeps the order of faces, and knows no smoothing groups.
    let mut smoothing = checked.smoothing.iter();
    for tobj::Model { mesh, .. } in &models {
        let material = mesh.material_id.unwrap_or(libraries.materials.len());
        let map = libraries.materials.get(material).and_then(|material| material.map.as_ref());
        let mut names: Vec<Option<[u32; 2]>> = vec![None; mesh.positions.len() / 3];
        for corner in 0..mesh.indices.len() {
            let vertex = mesh.indices[corner];
            let [position, color] = *names[vertex as usize].get_or_insert_with(|| {
                let position = nth(&mesh.positions, vertex);
                let index = *known.entry(key(position)).or_insert_with(|| {
                    polygons.positions.push(position);
                    polygons.positions.len() as u32 - 1
                });
                if mesh.vertex_color.is_empty() {
                    return [index, NO_COLOR];
                }
                let color: [f64; 3] = nth(&mesh.vertex_color, vertex);
                if color.iter().any(|channel| channel.is_nan()) {
                    return [index, NO_COLOR];
                }
                polygons.vertex_colors.push(color);
                [index, polygons.vertex_colors.len() as u32 - 1]
            });
            polygons.corners.push(Corner {
                position,
                normal: nth(&mesh.normals, mesh.normal_indices[corner]),
                texture: {
                    let texture = nth(&mesh.texcoords, mesh.texcoord_indices[corner]);
                    map.map_or(texture, |(map, _)| map.place(texture))
                },
                color,
            });
        }
        // `tobj` leaves the arities out if all faces are triangles.
        let count = if mesh.face_arities.is_empty() {
            mesh.indices.len() / 3
        } else {
            mesh.face_arities.len()
        };
        polygons.faces.extend((0..count).zip(&mut smoothing).map(|(face, &smoothing)| Face {
            arity: mesh.face_arities.get(face).map_or(3, |&arity| arity as usize),
            material,
            smoothing,
        }));
    }
    let mut ends = HashMap::new();
    for (&vertex, &FileVertex { position, color }) in &checked.elements.vertices {
        let index = *known.entry(key(position)).or_insert_with(|| {
            polygons.positions.push(position);
            polygons.positions.len() as u32 - 1
        });
        let color = color.map_or(NO_COLOR, |color| {
            polygons.vertex_colors.push(color);
            polygons.vertex_colors.len() as u32 - 1
        });
        ends.insert(vertex, End { position: index, color });
    }
    let material = |name: Option<usize>| {
        let chosen = name.and_then(|name| libraries.chosen.get(name).copied().flatten());
        chosen.unwrap_or(libraries.materials.len())
    };
    let (lines, points) = (&checked.elements.lines, &checked.elements.points);
    polygons.lines = lines.iter().map(|line| drawn(line, &ends, material)).collect();
    polygons.points = points.iter().map(|point| drawn(point, &ends, material)).collect();
    Ok(polygons)
}

/// An element by the indices of its vertices and its material.
fn drawn<const N: usize>(
    element: &Element<usize, Option<usize>, N>,
    ends: &HashMap<usize, End>,
    material: impl Fn(Option<usize>) -> usize,
) -> Drawn<N> {
    Element {
        vertices: element.vertices.map(|vertex| ends[&vertex]),
        material: material(element.material),
    }
}

fn nth<const N: usize>(values: &[f64], index: u32) -> [f64; N] {
    std::array::from_fn(|i| values[index as usize * N + i])
}

#[cfg(test)]
mod tests {
    use super::{
        super::{Contents, source::statements, validate},
        *,
    };

    fn polygons(text: &str) -> Polygons {
        let path = Path::new("m.obj");
        let statements = statements(text.as_bytes());
        let checked = validate::check(path, &statements, Contents::default()).unwrap();
        let libraries = Libraries {
            materials: [[255, 0, 0], [0, 0, 255]]
                .map(|color| libraries::Material { color, ..Default::default() })
                .into(),
            chosen: vec![Some(1), Some(0), None],
            ..Libraries::default()
        };
        read(path, &checked, &libraries).unwrap()
    }

    #[test]
    fn corners_keep_their_own_indices() {
        // The second face leaves out texture coordinates and normals, names a vertex further down,
        // and repeats a position.
        let polygons = polygons(
            "v 0.1 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nvn 0 0 3\nf 1/1/1 2/1/1 3/1/1\n\
             f 1 -2 4 5\nv 0.1 -0 0\nv 2 2 2",
        );
        assert_eq!(polygons.positions[0], [0.1, 0.0, 0.0]);
        let indices: Vec<u32> = polygons.corners.iter().map(|c| c.position).collect();
        assert_eq!(indices, [0, 1, 2, 0, 1, 0, 3]);
        let faces: Vec<_> = polygons.faces.iter().map(|face| (face.arity, face.material)).collect();
        assert_eq!(faces, [(3, 2), (4, 2)]);
        assert_eq!(
            (polygons.corners[2].normal, polygons.corners[2].texture),
            ([0.0, 0.0, 3.0], [0.5, 0.25])
        );
        assert_eq!((polygons.corners[3].normal, polygons.corners[3].texture), ([0.0; 3], [0.0; 2]));
    }

    #[test]
    fn materials_and_smoothing_groups_are_those_in_force() {
        let polygons = polygons(
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl b\ns 4\nf 1 2 3\nusemtl a\no x\n\
             f 1 2 3\ng\nusemtl c\ns off\nf 1 2 3",
        );
        let smoothing: Vec<Smoothing> = polygons.faces.iter().map(|face| face.smoothing).collect();
        let group = Smoothing::Group(4);
        assert_eq!(smoothing, [Smoothing::Unstated, group, group, Smoothing::Off]);
        let colors: Vec<[u8; 3]> =
            polygons.faces.iter().map(|face| polygons.colors[face.material]).collect();
        assert_eq!(colors, [[200; 3], [0, 0, 255], [255, 0, 0], [200; 3]]);
    }
}
