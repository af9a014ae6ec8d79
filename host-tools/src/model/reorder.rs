//! The same triangles in another order: then a material may have several runs.

use super::{Indices, Model, order};

impl Model {
    /// The model with its triangles in this order, each named once by its number in the tables.
    /// Where the material changes from one to the next, a new run begins. Vertices keep their
    /// order. Edges, lines and points are left out: they belong to the materials as they were.
    pub(crate) fn reordered(mut self, order: &[usize]) -> Self {
        let runs = runs(&self.materials_of_triangles(), order);
        self.triangles = match &self.triangles {
            Indices::U8(triangles) => Indices::U8(moved(triangles, order)),
            Indices::U16(triangles) => Indices::U16(moved(triangles, order)),
        };
        self.face_normals = moved(&self.face_normals, order);
        self.exact.face_normals = moved(&self.exact.face_normals, order);
        let places: Vec<usize> = runs.iter().map(|&(material, _)| material).collect();
        self.finishes = moved(&self.finishes, &places);
        self.materials = moved(&self.materials, &places);
        for (material, &(_, count)) in self.materials.iter_mut().zip(&runs) {
            material.triangle_count = count;
        }
        if let Some(textures) = &mut self.textures {
            textures.by_material = moved(&textures.by_material, &places);
        }
        self.edges.clear();
        self.lines.clear();
        self.points.clear();
        let table = self.triangles.as_triangles();
        let triangles: Vec<[u32; 3]> = (0..order.len())
            .filter_map(|number| table.get(number))
            .map(|triangle| triangle.map(|vertex| vertex as u32))
            .collect();
        self.report.cache_misses = order::cache_miss_ratio(&triangles, self.positions.len());
        self.report.lines = 0;
        self.report.points = 0;
        self.measure();
        self
    }

    /// The material of each triangle, by its place in the table of materials.
    pub(crate) fn materials_of_triangles(&self) -> Vec<usize> {
        let runs = self.materials.iter().enumerate();
        runs.flat_map(|(place, run)| vec![place; run.triangle_count as usize]).collect()
    }
}

/// The entries of a table in an order. A table that is left out stays empty.
fn moved<T: Clone>(table: &[T], order: &[usize]) -> Vec<T> {
    order.iter().filter_map(|&place| table.get(place).cloned()).collect()
}

/// The runs of one material, each with its number of triangles.
fn runs(materials: &[usize], order: &[usize]) -> Vec<(usize, u32)> {
    let mut runs: Vec<(usize, u32)> = Vec::new();
    for &triangle in order {
        match runs.last_mut() {
            Some((material, count)) if *material == materials[triangle] => *count += 1,
            _ => runs.push((materials[triangle], 1)),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::{super::Options, *};

    #[test]
    fn runs_follow_the_triangles() {
        let directory = tempfile::tempdir().unwrap();
        let library = "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n";
        std::fs::write(directory.path().join("m.mtl"), library).unwrap();
        let obj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nf 1 3 4\nusemtl b\n\
                   f 1 4 2\n";
        let options = Options::default();
        let model =
            Model::from_bytes(&directory.path().join("m.obj"), obj.as_bytes(), &options).unwrap();
        let corners = |model: &Model, number| {
            let triangle = model.triangles.as_triangles().get(number).unwrap();
            (triangle.map(|vertex| model.positions[vertex]), model.face_normals[number])
        };
        let of: Vec<_> = (0..3).map(|number| corners(&model, number)).collect();
        let [a, b] = [0, 1].map(|place| model.materials[place].color);
        let moved = model.clone().reordered(&[1, 2, 0]);
        assert_eq!([0, 1, 2].map(|number| corners(&moved, number)), [of[1], of[2], of[0]]);
        let runs: Vec<_> = moved.materials.iter().map(|m| (m.color, m.triangle_count)).collect();
        assert_eq!(runs, [(a, 1), (b, 1), (a, 1)]);
        // A run takes flash, and the tables are a valid mesh.
        assert!(moved.report.flash.materials > model.report.flash.materials);
        assert_eq!(moved.mesh().triangle_count(), 3);
        // The order of the tables changes nothing.
        assert_eq!(model.clone().reordered(&[0, 1, 2]), model);
    }
}
