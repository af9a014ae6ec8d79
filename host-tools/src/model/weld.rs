//! Merges equal corners into vertices.

use super::{
    Contents,
    polygons::Polygons,
    triangulate::Triangle,
    vector::{Vector, key},
};

/// The distinct vertices and the triangles that name them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Welded {
    /// Each vertex's index into the positions.
    pub positions: Vec<u32>,
    /// Each vertex's unit normal, 0 if normals are left out.
    pub normals: Vec<Vector>,
    /// Each vertex's texture coordinates, 0 if they are left out.
    pub textures: Vec<[f64; 2]>,
    /// Each vertex's colour, none if the file has none or they are left out.
    pub colors: Vec<[u8; 3]>,
    /// The number of each vertex's normals in further files.
    pub further: Vec<u32>,
    /// Three vertices per triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Merges corners that have equal positions and equal values of all that `contents` keeps.
/// `normals` may be empty if it keeps none; `further` has the numbers of those in further files,
/// and is empty without any; `polygons` has the colours.
pub(super) fn weld(
    triangles: &[Triangle],
    normals: &[[Vector; 3]],
    further: &[[u32; 3]],
    polygons: &Polygons,
    contents: Contents,
) -> Welded {
    let has_colors = contents.vertex_colors && !polygons.vertex_colors.is_empty();
    let mut welded = Welded::default();
    let mut known = rustc_hash::FxHashMap::default();
    for (index, triangle) in triangles.iter().enumerate() {
        let vertices = [0, 1, 2].map(|i| {
            let corner = &triangle.corners[i];
            let normal = if contents.vertex_normals { normals[index][i] } else { [0.0; 3] };
            let texture = if contents.texture_coordinates { corner.texture } else { [0.0; 2] };
            let color = has_colors
                .then(|| polygons.color(corner.color, triangle.material).map(|c| c.round() as u8));
            let number = further.get(index).map_or(0, |numbers| numbers[i]);
            let name = (corner.position, key(normal), number, key(texture), color);
            *known.entry(name).or_insert_with(|| {
                welded.positions.push(corner.position);
                welded.normals.push(normal);
                welded.further.push(number);
                welded.textures.push(texture);
                welded.colors.extend(color);
                welded.positions.len() as u32 - 1
            })
        });
        welded.triangles.push(vertices);
    }
    welded
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            polygons::{Corner, NO_COLOR},
            smoothing::Smoothing,
        },
        *,
    };

    #[test]
    fn corners_split_only_where_a_kept_value_differs() {
        let corner =
            |position, u| Corner { position, normal: [0.0; 3], texture: [u, 0.0], color: NO_COLOR };
        let triangle = |corners| Triangle { corners, material: 0, smoothing: Smoothing::Unstated };
        let triangles = [
            triangle([corner(7, 0.0), corner(8, 0.0), corner(9, 0.0)]),
            triangle([corner(7, -0.0), corner(9, 0.0), corner(8, 0.5)]),
        ];
        let up = [0.0, 1.0, 0.0];
        let mut normals = [[up; 3], [up; 3]];
        normals[1][1] = [1.0, 0.0, 0.0];
        let count = |vertex_normals, texture_coordinates| {
            let contents = Contents {
                vertex_normals,
                face_normals: false,
                texture_coordinates,
                vertex_colors: true,
            };
            weld(&triangles, &normals, &[], &Polygons::default(), contents).triangles
        };
        assert_eq!(count(false, false), [[0, 1, 2], [0, 2, 1]]);
        assert_eq!(count(true, false), [[0, 1, 2], [0, 3, 1]]);
        assert_eq!(count(false, true), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(count(true, true), [[0, 1, 2], [0, 3, 4]]);
    }
}
