//! The colours that each face of the file may have, for the judge of places.

use super::{
    Form,
    light_levels::corner_levels,
    lights::total,
    matcap,
    places::FaceColors,
    shading::{Shading, file_channels},
    shiny,
    skins::Skins,
    surface::Surface,
    view::{Projection, View},
};
use crate::model::{Face, Model};

/// The colours that each face may have, however it is cut into triangles.
pub(super) fn colors(
    model: &Model,
    surface: &Surface,
    skins: &Skins,
    view: &View,
) -> Vec<Option<FaceColors>> {
    let faces = model.exact.faces.faces.iter();
    let brightest = shiny::brightest(model);
    let levels = levels(model, surface, view);
    let bare = faces.zip(levels).map(|(face, levels)| {
        if view.shading.is_shiny() {
            let range = [[0.0; 3], brightest[face.material]];
            Some(FaceColors { range, levels: [0.0, 1.0] })
        } else if view.shading == Shading::Matcap {
            Some(matcap::colors())
        } else if view.shading.is_textured() {
            skins.colors(face.material, levels)
        } else if view.shading.is_colored() {
            let corners = face.corners.clone().map(|corner| file_channels(model, corner));
            Some(FaceColors { range: range(corners), levels })
        } else {
            Some(FaceColors { range: [face.color.map(f64::from); 2], levels })
        }
    });
    let Some(fog) = view.fog else { return bare.collect() };
    bare.zip(distances(model, view))
        .map(|(colors, distances)| Some(fog.colors(colors?, distances)))
        .collect()
}

/// The distances between which each face lies in fog, with a quantum of the tables on both sides.
fn distances(model: &Model, view: &View) -> Vec<[f64; 2]> {
    let (_, scale) = view.core_place();
    let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    let quantum = scale * view.form.half_quanta(model).map(length).iter().sum::<f64>();
    let (camera, faces) = (view.reference_camera(), &model.exact.faces);
    let [near, far] = [view.near, view.far];
    let posed = view.pose_points(&faces.positions).into_iter();
    let all: Vec<f64> = posed.map(|p| -camera.to_view(p)[2]).collect();
    let is_parallel = matches!(view.projection, Projection::Orthographic { .. });
    let of_face = |face: &Face| {
        let corners = faces.corners[face.corners.clone()].iter().map(|&p| all[p as usize]);
        let least = corners.clone().fold(f64::INFINITY, f64::min);
        let most = corners.fold(f64::NEG_INFINITY, f64::max);
        if is_parallel {
            [near; 2]
        } else {
            [(least - quantum).clamp(near, far), (most + quantum).clamp(near, far)]
        }
    };
    faces.faces.iter().map(of_face).collect()
}

/// The levels of light that each face may have.
fn levels(model: &Model, surface: &Surface, view: &View) -> Vec<[f64; 2]> {
    let lights = view.lights.reference();
    let faces = &model.exact.faces;
    // By how much the level of a normal in 127ths may be off.
    let normal = total(&lights).min(1.0) * view.form.level_error(model);
    let any = [lights.ambient - normal, 1.0];
    let within = |levels: &mut dyn Iterator<Item = f64>| {
        let [low, high] = levels
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], l| [low.min(l), high.max(l)]);
        [low - normal, high + normal]
    };
    match view.shading {
        Shading::Unlit | Shading::Colored | Shading::Matcap | Shading::Textured => {
            vec![[1.0, 1.0]; faces.faces.len()]
        }
        // Where its middle lies, depends on how a face is cut.
        // Between shapes, the blend of two normals depends on it too.
        Shading::Flat | Shading::TexturedFlat
            if view.lights.are_near() || matches!(view.form, Form::Between { .. }) =>
        {
            vec![any; faces.faces.len()]
        }
        Shading::Flat | Shading::TexturedFlat => (0..faces.faces.len())
            .map(|face| {
                surface.possible_normals(faces, face).map_or(any, |normals| {
                    let normals = view.pose_directions(&normals).into_iter();
                    within(&mut normals.map(|n| lights.diffuse([0.0; 3], n)))
                })
            })
            .collect(),
        _ => {
            let levels = corner_levels(model, surface, view);
            (faces.faces.iter())
                .map(|face| within(&mut levels[face.corners.clone()].iter().flatten().copied()))
                .collect()
        }
    }
}

/// The least and the largest of each channel.
fn range(colors: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    colors.fold([[f64::INFINITY; 3], [0.0; 3]], |[least, most], color| {
        let each =
            |of: fn(f64, f64) -> f64, with: [f64; 3]| [0, 1, 2].map(|i| of(with[i], color[i]));
        [each(f64::min, least), each(f64::max, most)]
    })
}
