//! How far a model's tables are from the exact values, and the memory that they take.

use super::{
    Flash, Indices, Model, Shape, Textures, fit, quantize,
    vector::{length, sub},
};

impl Model {
    /// Fills in the figures that compare the tables with the exact values.
    pub(super) fn measure(&mut self) {
        let offset = fit::offset_units(self.offset);
        let moved = self
            .keyframes
            .iter()
            .flat_map(|shape| shape.positions.iter().zip(&shape.exact_positions));
        let distances = self
            .positions
            .iter()
            .zip(&self.exact.positions)
            .chain(moved)
            .map(|(&q, &p)| length(sub(quantize::position(q, self.scale, offset), p)));
        let squares: f64 = distances.clone().map(|d| d * d).sum();
        let normal_errors = (self.vertex_normals.iter().zip(&self.exact.vertex_normals))
            .chain(self.face_normals.iter().zip(&self.exact.face_normals))
            .chain(self.keyframes.iter().flat_map(Shape::normals))
            .map(|(&q, &n)| quantize::normal_error(q, n));
        let rounded = self.texture_coordinates.rounded();
        let texture_errors = (rounded.as_flattened().iter())
            .zip(self.exact.texture_coordinates.as_flattened())
            .map(|(q, t)| (q - t).abs());
        let report = &mut self.report;
        report.vertices = self.positions.len();
        report.size = fit::diagonal(&self.exact.positions);
        report.position_error_max = distances.fold(0.0, f64::max);
        let count = self.positions.len() * (1 + self.keyframes.len());
        report.position_error_rms = (squares / count as f64).sqrt();
        report.normal_error_degrees = normal_errors.fold(0.0, f64::max).to_degrees();
        report.texture_error = texture_errors.fold(0.0, f64::max);
        report.flash = Flash {
            positions: size_of_val(&self.positions[..]),
            vertex_normals: size_of_val(&self.vertex_normals[..]),
            face_normals: size_of_val(&self.face_normals[..]),
            texture_coordinates: self.texture_coordinates.bytes(),
            vertex_colors: size_of_val(&self.vertex_colors[..]),
            triangles: match &self.triangles {
                Indices::U8(triangles) => size_of_val(&triangles[..]),
                Indices::U16(triangles) => size_of_val(&triangles[..]),
            },
            edges: 2 * self.edges.len() * self.triangles.index_bytes(),
            lines: 2 * report.lines * self.triangles.index_bytes(),
            points: report.points * self.triangles.index_bytes(),
            materials: size_of_val(&self.materials[..]),
            finishes: size_of_val(&self.finishes[..]),
            textures: self.textures.as_ref().map_or(0, Textures::bytes),
            keyframes: self.keyframes.iter().map(Shape::bytes).sum(),
        };
    }
}
