//! The program that solves instances of stiff problems: Rust source with their numbers.

use std::fmt::Write as _;

use host_tools::stiffness::{Scene, Work};

/// The source of a program that solves the instances of some points, one point after the other.
pub(super) fn source<'a>(points: impl IntoIterator<Item = &'a [Work]>) -> String {
    let mut text = String::from(
        "\
use firmware::stiff::{Scene, compose, each};
use rasterizer::{
    attribute::{Affine, Every, EveryPixel, FloatDepth},
    camera::{Orthographic, Perspective},
    numbers::{S4, S8},
    texture::{Nearest, PerTriangle, Trilinear},
};

fn instances() {
",
    );
    for works in points {
        let tables = works.iter().map(table).collect::<Vec<_>>().join(", ");
        let solve = works.first().map_or_else(String::new, solve);
        let _ = writeln!(text, "    each(&[{tables}], {solve});");
    }
    text + "}\n"
}

/// The numbers of an instance.
fn table(work: &Work) -> String {
    match work {
        Work::Place(scene) | Work::Clip(scene) => of_scene(scene),
        Work::Draw { scene, part, .. } | Work::DrawTexture { scene, part, .. } => {
            format!("({}, {part:?})", of_scene(scene))
        }
        Work::Compose { count, .. } => format!("{count}"),
    }
}

/// The closure that solves an instance.
fn solve(work: &Work) -> String {
    match work {
        Work::Place(scene) => format!("|scene| scene.place::<{}>()", types(scene)),
        Work::Clip(scene) => format!("|scene| scene.clip::<{}>()", types(scene)),
        Work::Draw { scene, depth, .. } => {
            format!("|(scene, part)| scene.draw::<{}, {depth}>(*part)", types(scene))
        }
        Work::DrawTexture { scene, filter, correction, .. } => {
            let types = types(scene);
            format!(
                "|(scene, part)| scene.draw_texture::<{types}, _, _>(*part, {filter}, {correction})"
            )
        }
        Work::Compose { restores, .. } => format!("|&count| compose(count, {restores})"),
    }
}

/// The types of positions on the screen and of the projection.
fn types(scene: &Scene) -> String {
    let lens = scene.focal_length.map_or("Orthographic", |_| "Perspective");
    format!("{}, {lens}", scene.subpixel)
}

fn of_scene(scene: &Scene) -> String {
    let Scene {
        subpixel: _,
        positions,
        texture_coordinates,
        triangles,
        scale,
        rotation,
        translation,
        eye,
        focal_length,
        range,
        size,
    } = scene;
    format!(
        "Scene {{ positions: &{positions:?}, texture_coordinates: &{texture_coordinates:?}, \
         triangles: &{triangles:?}, scale: {scale:?}, rotation: {rotation:?}, \
         translation: {translation:?}, eye: {eye:?}, focal_length: {focal_length:?}, \
         range: {range:?}, size: {size:?} }}"
    )
}
