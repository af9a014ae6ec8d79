//! The models that come with the project.

use std::{
    collections::HashMap,
    fs,
    path::{Path, PathBuf},
};

use super::{
    super::{
        Model, Options, Picture,
        vector::{Vector, cross, dot, key},
    },
    CUBE, cube, indices, load,
};

#[path = "../../../models/generator/mod.rs"]
mod generator;

pub(super) fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name)
}

#[test]
fn shipped_models_are_what_the_generator_makes() {
    for (name, made) in generator::files() {
        assert!(made.len() < 150_000, "{name} has {} bytes", made.len());
        let shipped = fs::read(path(name)).unwrap();
        // Another version of a library may compress a picture in another way.
        let is_equal = if name.ends_with(".png") {
            Picture::decode(&shipped).unwrap() == Picture::decode(&made).unwrap()
        } else {
            shipped == made
        };
        let remedy = "run `cargo run -p host-tools --example generate_models`";
        assert!(is_equal, "{name} differs: {remedy}");
    }
}

/// Six times the volume inside each connected part of a surface, if each of its edges lies between
/// two triangles in opposite directions.
fn volumes_if_closed(model: &Model) -> Option<Vec<f64>> {
    let triangles: Vec<[Vector; 3]> =
        indices(model).into_iter().map(|t| t.map(|v| model.exact.positions[v])).collect();
    let edge = |t: &[Vector; 3], i: usize| (key(t[i]), key(t[(i + 1) % 3]));
    let mut owner = HashMap::new();
    for (number, triangle) in triangles.iter().enumerate() {
        for i in 0..3 {
            if owner.insert(edge(triangle, i), number).is_some() {
                return None;
            }
        }
    }
    let mut volumes = Vec::new();
    let mut seen = vec![false; triangles.len()];
    for start in 0..triangles.len() {
        let mut volume = 0.0;
        let mut open = vec![start];
        while let Some(number) = open.pop() {
            if std::mem::replace(&mut seen[number], true) {
                continue;
            }
            let triangle = &triangles[number];
            volume += dot(triangle[0], cross(triangle[1], triangle[2]));
            for i in 0..3 {
                let (a, b) = edge(triangle, i);
                open.push(*owner.get(&(b, a))?);
            }
        }
        if volume != 0.0 {
            volumes.push(volume);
        }
    }
    Some(volumes)
}

#[test]
fn shipped_models_are_closed_and_face_outwards() {
    for (name, triangles, materials, parts) in [
        ("gear.obj", 1_680, 2, 1),
        ("torus_knot.obj", 1_280, 1, 1),
        ("rocket.obj", 840, 5, 6),
        ("wooden_crate.obj", 108, 1, 1),
    ] {
        let model = Model::load(path(name), &Options::default()).unwrap();
        println!("{name}\n{}", model.report);
        assert_eq!(model.warnings, [""; 0], "{name}");
        assert_eq!(model.report.dropped_triangles, 0, "{name}");
        assert_eq!(
            (model.report.triangles, model.materials.len()),
            (triangles, materials),
            "{name}"
        );
        let volumes = volumes_if_closed(&model).unwrap_or_else(|| panic!("{name} has open edges"));
        assert_eq!(volumes.len(), parts, "{name}: {volumes:?}");
        assert!(volumes.iter().all(|&v| v > 1e-4), "{name}: {volumes:?}");
        assert_eq!(model.mesh().triangle_count(), triangles, "{name}");
    }
    // The test finds an open surface: a cube without one face.
    assert!(volumes_if_closed(&cube(&Options::default())).is_some());
    assert!(
        volumes_if_closed(&load(&CUBE.replace("f 1 2 6 5\n", ""), &Options::default()).unwrap())
            .is_none()
    );
}

#[test]
fn the_crate_has_its_picture_on_each_side() {
    let model = Model::load(path("wooden_crate.obj"), &Options::default()).unwrap();
    let textures = model.textures.as_ref().unwrap();
    assert_eq!((textures.size, &textures.by_material[..]), ([128, 128], &[Some(0)][..]));
    assert!(textures.textures[0].psnr_db > 38.0, "{textures}");
    // Each of the 24 corners of the sides is a corner of the picture.
    let corners = model.exact.texture_coordinates.iter();
    let corners = corners.filter(|c| c.iter().all(|&c| c == 0.0 || c == 1.0)).count();
    assert_eq!(corners, 24);
}
