//! The levels of light that the definitions of shaders have, at triangles and at corners.

use super::{
    Form,
    noted::Noted,
    surface::Surface,
    view::{View, ViewError},
};
use crate::model::Model;

/// The levels of the triangles of the tables, and of those that the faces of the file are cut into,
/// at their middles. In a form, the former are those of the normals that the core has, where they
/// are within their bound.
pub(super) fn flat_levels(
    model: &Model,
    surface: &Surface,
    view: &View,
) -> Result<(Vec<f64>, Vec<f64>), ViewError> {
    let lights = view.lights.reference();
    let mean = |corners: [[f64; 3]; 3]| {
        [0, 1, 2].map(|i| corners.iter().map(|corner| corner[i]).sum::<f64>() / 3.0)
    };
    let positions = view.core_pose_points(&view.form.table_positions(model));
    let [_, mut normals] = view.form.table_normals(model);
    // There is no surface where only the core's picture is wanted.
    let is_judged = !surface.planes.is_empty();
    if is_judged && view.form != Form::AsModelled {
        normals = Noted::of(model, view)?.face_normals(&normals);
    }
    let triangles = model.triangles.as_triangles();
    let levels = view.core_pose_directions(&normals).into_iter().enumerate().map(|(i, normal)| {
        let corners = triangles.get(i).unwrap_or_default();
        lights.diffuse(mean(corners.map(|vertex| positions[vertex])), normal)
    });
    let mesh = surface.mesh(model, &view.rounded());
    let file_normals = view.pose_directions(&surface.normals);
    let file_levels = mesh.triangles.iter().zip(file_normals).map(|(corners, normal)| {
        lights.diffuse(mean(corners.map(|vertex| mesh.positions[vertex])), normal)
    });
    Ok((levels.collect(), file_levels.collect()))
}

/// The levels that each corner of each face may have, at least one.
pub(super) fn corner_levels(model: &Model, surface: &Surface, view: &View) -> Vec<Vec<f64>> {
    let lights = view.lights.reference();
    let positions = view.pose_points(&model.exact.positions).into_iter();
    let of_vertices: Vec<f64> = (view.pose_directions(&model.exact.vertex_normals).into_iter())
        .zip(positions)
        .map(|(normal, position)| lights.diffuse(position, normal))
        .collect();
    let normals: Vec<_> =
        surface.planes.iter().map(|plane| plane.normal().unwrap_or_default()).collect();
    let of_faces = view.pose_directions(&normals);
    let faces = &model.exact.faces;
    let places = view.pose_points(&faces.positions);
    let mut levels = Vec::with_capacity(surface.vertices.len());
    for (face, normal) in faces.faces.iter().zip(of_faces) {
        for corner in face.corners.clone() {
            let vertices = &surface.vertices[corner];
            let of_face = lights.diffuse(places[faces.corners[corner] as usize], normal);
            let known = vertices.iter().filter_map(|&vertex| of_vertices.get(vertex).copied());
            let known: Vec<f64> = known.collect();
            levels.push(if known.is_empty() { vec![of_face] } else { known });
        }
    }
    levels
}
