//! Texture coordinates: whole repeats that nobody sees, and the integers of the table.

use std::path::Path;

use rasterizer::mesh::TextureCoordinates;

use super::error::ModelError;

/// Texture coordinates in the smaller of the two types that holds them, v running down.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureTable {
    /// In units of 2^-14 repeats, from -2 to 2. An empty table stands for none.
    I16(Vec<[i16; 2]>),
    /// In units of 2^-24 repeats.
    I32(Vec<[i32; 2]>),
}

impl TextureTable {
    /// Whether coordinates have 32 bits: shaders then need `with_wide_coordinates`.
    #[must_use]
    pub const fn is_wide(&self) -> bool {
        matches!(self, Self::I32(_))
    }

    /// Rounds coordinates to the steps of 16 bits if all of them fit, else to those of 32.
    fn new(path: &Path, exact: &[[f64; 2]]) -> Result<Self, ModelError> {
        if let Some(table) = q14(exact) {
            return Ok(Self::I16(table));
        }
        let range = exact.as_flattened().iter().fold(0.0, |m: f64, &c| m.max(c.abs()));
        if range > f64::from(TextureCoordinates::LIMIT) {
            return Err(ModelError::TextureRange { path: path.into(), range });
        }
        let q24 = |c: f64| (c * f64::from(1 << 24)).round() as i32;
        Ok(Self::I32(exact.iter().map(|c| c.map(q24)).collect()))
    }

    /// Borrows them for a mesh.
    #[must_use]
    pub fn as_column(&self) -> TextureCoordinates<'_> {
        match self {
            Self::I16(table) => TextureCoordinates::I16(table),
            Self::I32(table) => TextureCoordinates::I32(table),
        }
    }

    /// The rounded coordinates, in repeats.
    pub(super) fn rounded(&self) -> Vec<[f64; 2]> {
        let column = self.as_column();
        let rows = (0..column.len()).filter_map(|vertex| column.get(vertex));
        rows.map(|c| c.map(|c| f64::from(c) / f64::from(1 << 24))).collect()
    }

    /// The bytes that they take.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::I16(table) => size_of_val(&table[..]),
            Self::I32(table) => size_of_val(&table[..]),
        }
    }
}

/// Coordinates in 2^-14 repeats, or `None` if one of them doesn't fit 16 bits.
fn q14(exact: &[[f64; 2]]) -> Option<Vec<[i16; 2]>> {
    let round = |c: f64| {
        let steps = (c * f64::from(1 << 14)).round();
        (-32_768.0..=32_767.0).contains(&steps).then_some(steps as i16)
    };
    exact.iter().map(|&[u, v]| Some([round(u)?, round(v)?])).collect()
}

/// Turns texture coordinates so that v runs down from the texture's top left.
pub(super) fn turned([u, v]: [f64; 2]) -> [f64; 2] {
    [u, 1.0 - v]
}

/// Rounds turned texture coordinates, and returns the table with what it rounds.
///
/// If they don't fit 16 bits as they are, each part of the mesh that shares no vertex with others
/// is moved by the whole repeats that bring its middle nearest to 0, where a texture repeats: that
/// changes nothing that is seen. `repeats` tells whether it does.
pub(super) fn quantized(
    path: &Path,
    turned: Vec<[f64; 2]>,
    triangles: &[[u32; 3]],
    repeats: bool,
) -> Result<(TextureTable, Vec<[f64; 2]>), ModelError> {
    let stays = !repeats || q14(&turned).is_some();
    let exact = if stays { turned } else { moved(turned, triangles) };
    Ok((TextureTable::new(path, &exact)?, exact))
}

/// Moves each part by whole repeats, so that it fits -2 to 2 - 2^-14 if any move makes it.
fn moved(mut turned: Vec<[f64; 2]>, triangles: &[[u32; 3]]) -> Vec<[f64; 2]> {
    let part = parts(triangles, turned.len());
    for axis in 0..2 {
        let mut ranges = vec![[f64::INFINITY, f64::NEG_INFINITY]; turned.len()];
        for (c, &part) in turned.iter().zip(&part) {
            let [low, high] = ranges[part];
            ranges[part] = [low.min(c[axis]), high.max(c[axis])];
        }
        for (c, &part) in turned.iter_mut().zip(&part) {
            // The moves that fit are an interval. If any of them is whole, the one nearest to its
            // middle is.
            let [low, high] = ranges[part];
            c[axis] -= ((low + high + 2_f64.powi(-14)) / 2.0).round();
        }
    }
    turned
}

/// For each vertex the first one of those that triangles join it to.
fn parts(triangles: &[[u32; 3]], vertices: usize) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..vertices).collect();
    let find = |parent: &mut [usize], mut vertex: usize| {
        while parent[vertex] != vertex {
            parent[vertex] = parent[parent[vertex]];
            vertex = parent[vertex];
        }
        vertex
    };
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (one, other) = (find(&mut parent, a as usize), find(&mut parent, other as usize));
            parent[one.max(other)] = one.min(other);
        }
    }
    (0..vertices).map(|vertex| find(&mut parent, vertex)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAN: [[u32; 3]; 2] = [[0, 1, 2], [3, 5, 4]];

    fn table(turned: &[[f64; 2]], repeats: bool) -> Result<TextureTable, ModelError> {
        quantized(Path::new("m.obj"), turned.to_vec(), &FAN, repeats).map(|(table, _)| table)
    }

    #[test]
    fn coordinates_that_fit_stay_where_they_are() {
        let turned =
            [[-2.0, 3.0], [0.5, 0.25], [1.999_9, 2.0], [0.0; 2], [0.0; 2], [0.0; 2]].map(turned);
        let TextureTable::I16(table) = table(&turned, true).unwrap() else { panic!() };
        assert_eq!(table[..3], [[-32_768, -32_768], [8_192, 12_288], [32_766, -16_384]]);
    }

    #[test]
    fn parts_move_by_whole_repeats_to_fit_16_bits() {
        // The first part is 3 repeats wide and far out, the second fits and moves all the same.
        let turned =
            [[40.0, 0.25], [43.0, 0.0], [41.5, 0.0], [1.25, 0.5], [1.75, -0.5], [1.5, 0.0]];
        let TextureTable::I16(table) = table(&turned, true).unwrap() else { panic!() };
        assert_eq!(table[..3], [[-32_768, 4_096], [16_384, 0], [-8_192, 0]]);
        assert_eq!(table[3..], [[-12_288, 8_192], [-4_096, -8_192], [-8_192, 0]]);
    }

    #[test]
    fn nothing_moves_where_a_texture_ends() {
        let turned = [[40.0, 2.0], [40.5, 2.5], [40.0, 2.0], [0.0; 2], [0.0; 2], [0.0; 2]];
        let TextureTable::I32(table) = table(&turned, false).unwrap() else { panic!() };
        assert_eq!(table[..2], [[40 << 24, 2 << 24], [81 << 23, 5 << 23]]);
    }

    #[test]
    fn wide_parts_take_32_bits_up_to_64_repeats() {
        let wide = |low: f64, high: f64| {
            table(&[[low, 0.0], [high, 0.0], [low, 0.0], [0.0; 2], [0.0; 2], [0.0; 2]], true)
        };
        // 4 repeats less a step fit 16 bits, if they begin at a whole one.
        assert!(matches!(wide(7.0, 11.0 - 2_f64.powi(-14)), Ok(TextureTable::I16(_))));
        assert!(matches!(wide(7.0, 11.0), Ok(TextureTable::I32(_))));
        let TextureTable::I32(table) = wide(1_000.0, 1_128.0).unwrap() else { panic!() };
        assert_eq!([table[0][0], table[1][0]], [-64 << 24, 64 << 24]);
        let error = wide(0.0, 129.0).unwrap_err().to_string();
        assert!(error.contains("65 repeats") && error.contains("64 on either side"), "{error}");
    }
}
