//! Cameras that look from anywhere to anywhere, models at their places, and several in a picture.

use super::*;
use crate::reference::{Blend, HalfSpace};

/// Cameras about a model, and models that stand elsewhere and in another size.
fn stands() -> impl Iterator<Item = View> {
    let mut random = Random(83);
    (0..).map(move |number| {
        let mut any = |most: f64| [(); 3].map(|()| random.real(-most, most));
        let (way, target, up, at, turn_degrees) =
            (any(1.0), any(0.3), any(1.0), any(40.0), any(360.0));
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt().max(0.01);
        let scale = [1.0, 0.3, 7.5][number % 3];
        let place = Place { at, turn_degrees, scale };
        let eye = [0, 1, 2].map(|i| at[i] + 3.0 * scale * way[i] / length);
        let target = [0, 1, 2].map(|i| at[i] + scale * target[i]);
        let projection = if number % 4 == 3 {
            Projection::Orthographic { height: 2.0 * scale }
        } else {
            FRONT.projection
        };
        let (near, far) = (0.5 * scale, 9.0 * scale);
        View { look: Some(Look { eye, target, up }), place, projection, near, far, ..FRONT }
    })
}

#[test]
fn models_pass_wherever_they_and_the_camera_stand() {
    let lamp = |view: &View| {
        let place = view.place;
        let position = [place.at[0] + 2.0 * place.scale, place.at[1], place.at[2]];
        Some(Lamp { position, half: 2.0 * place.scale })
    };
    let planes = |space| {
        let mut planes = ViewPlanes { space, ..ViewPlanes::default() };
        planes.sides[0] = Some(HalfSpace { normal: [0.3, -1.0, 0.2], offset: 0.3 });
        planes
    };
    for name in ["gear.obj", "rocket.obj", "wooden_crate.obj"] {
        let model = shipped(name);
        let checker = Checker::new(&model);
        let mut totals = Totals::default();
        for (number, view) in stands().take(14).enumerate() {
            let lights = ViewLights { lamps: [lamp(&view), None, None, None], ..view.lights };
            let view = match number % 7 {
                0 => View { shading: Shading::Flat, ..view },
                1 => View { shading: Shading::Gouraud, lights, ..view },
                2 => View { shading: Shading::PhongNear, lights, ..view },
                3 => View { shading: Shading::Phong, ..view },
                4 => View { shading: Shading::Matcap, ..view },
                5 => View { planes: planes(PlaneSpace::Object), ..view },
                _ => View {
                    shading: Shading::of(&model),
                    blending: Blending::By(Blend::Over),
                    opacity: 0.5,
                    ..view
                },
            };
            totals.add(name, &checker, &view);
        }
        assert!(totals.drawn > 100_000, "{name}: {}", totals.drawn);
        assert!(totals.are_judged(96), "{name}: {} of {}", totals.judged, totals.pixels);
    }
}

#[test]
fn a_camera_on_the_z_axis_is_the_same_in_both_ways() {
    let model = shipped("gear.obj");
    let view = View { shading: Shading::Gouraud, distance: 2.5, ..FRONT };
    let look = Look { eye: [0.0, 0.0, 2.5], target: [0.0; 3], up: [0.0, 3.0, 1.0] };
    let other = View { look: Some(look), distance: 9.0, ..view };
    assert_eq!(render(&model, &view).unwrap(), render(&model, &other).unwrap());
}

#[test]
fn a_camera_without_a_direction_is_refused() {
    let model = shipped("gear.obj");
    let upright = Look { eye: [0.0, 0.0, 3.0], target: [0.0; 3], up: [0.0, 1.0, 0.0] };
    for look in [
        Look { target: upright.eye, ..upright },
        Look { up: [0.0, 0.0, -2.0], ..upright },
        Look { eye: [0.0, 0.0, 40_000.0], ..upright },
    ] {
        let view = View { look: Some(look), ..FRONT };
        assert!(render(&model, &view).is_err(), "{look:?}");
    }
    let view = View { place: Place { scale: 0.0, ..Place::default() }, ..FRONT };
    assert!(matches!(render(&model, &view), Err(ViewError::OutOfRange { .. })));
}

/// A square of the width and height 2 at the distance z, of a colour.
fn square(z: f64, color: &str) -> Model {
    load(&format!(
        "mtllib m.mtl\nusemtl {color}\nv -1 -1 {z}\nv 1 -1 {z}\nv 1 1 {z}\nv -1 1 {z}\nf 1 2 3 4\n"
    ))
}

fn unlit<'a>(models: &[(&'a Model, Place)]) -> Vec<SceneModel<'a>> {
    let scene = |&(model, place)| SceneModel { model, place, shading: Shading::Unlit };
    models.iter().map(scene).collect()
}

fn under(view: &View) -> Vec<[u8; 3]> {
    let [width, height] = view.size;
    (0..width * height).map(|i| [(i % 251) as u8, (i % 241) as u8, (i % 239) as u8]).collect()
}

#[test]
fn the_nearest_model_is_seen_and_the_picture_under_all_of_them() {
    let [red, blue] = ["red", "blue"].map(|color| square(0.0, color));
    let place = |x: f64, z: f64| Place { at: [x, 0.0, z], scale: 0.5, ..Place::default() };
    let under = under(&FRONT);
    let draw = |models: &[(&Model, Place)]| {
        render_scene(&unlit(models), &FRONT, LineOptions::default(), &under).unwrap()
    };
    let far = (&red, place(0.0, -0.5));
    let near = (&blue, place(0.2, 0.5));
    let scene = draw(&[far, near]);
    assert_eq!(scene.colors, draw(&[near, far]).colors, "depth decides, not the order");
    // The near one covers part of the far one.
    let alone = draw(&[far]);
    assert!(scene.seen[0] > 500 && scene.seen[0] < alone.seen[0], "{:?}", scene.seen);
    assert!(scene.seen[1] > 5_000, "{:?}", scene.seen);
    let [middle, corner] = [120 * 320 + 160, 0];
    assert_eq!(scene.colors[middle], [26, 26, 255]);
    assert_eq!(scene.colors[corner], under[corner]);
    // At the same depth the first one stays.
    let (same, other) = ((&red, near.1), near);
    assert_eq!(draw(&[same, other]).seen[1], 0);
    assert_eq!(draw(&[other, same]).seen[1], 0);
}

#[test]
fn models_that_blend_lie_on_those_before() {
    let [red, blue] = ["red", "blue"].map(|color| square(0.0, color));
    let half = View { blending: Blending::By(Blend::Over), opacity: 0.5, ..FRONT };
    let under = vec![[100, 200, 0]; 320 * 240];
    let models = [(&red, Place::default()), (&blue, Place::default())];
    let scene = render_scene(&unlit(&models), &half, LineOptions::default(), &under).unwrap();
    let middle = 120 * 320 + 160;
    // Red is 255, 26, 26, blue 26, 26, 255; each step is rounded.
    let mean = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| f64::midpoint(a[i], b[i]));
    let first = mean([100.0, 200.0, 0.0], [255.0, 26.0, 26.0]);
    let exact = mean(first, [26.0, 26.0, 255.0]);
    for (found, exact) in scene.colors[middle].map(f64::from).into_iter().zip(exact) {
        assert!((found - exact).abs() <= 1.0, "{:?}", scene.colors[middle]);
    }
    // Over one colour, the picture is that of a view with it as its background.
    let background = [100, 200, 0];
    let alone = render(&red, &View { background, ..half }).unwrap();
    let scene = render_scene(&unlit(&models[..1]), &half, LineOptions::default(), &under).unwrap();
    let colors: Vec<_> = (alone.pixels.iter())
        .map(|pixel| if pixel.depth == 0 { background } else { pixel.color })
        .collect();
    assert_eq!(scene.colors, colors);
}

#[test]
fn models_hide_lines_of_others() {
    let gear = shipped("gear.obj");
    let options = Options { edges_degrees: Some(0.0), ..Options::default() };
    let obj = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    let frame = Model::from_bytes(std::path::Path::new("m.obj"), obj.as_bytes(), &options).unwrap();
    let edges = LineOptions { edges: Edges::Over, ..LineOptions::default() };
    let behind = Place { at: [0.0, 0.0, -2.0], scale: 0.5, ..Place::default() };
    let under = under(&FRONT);
    let seen = |models: &[(&Model, Place)]| {
        let scene = render_scene(&unlit(models), &FRONT, edges, &under).unwrap();
        scene.colors.iter().filter(|&&color| color == edges.edge_color).count()
    };
    let (all, hidden) =
        (seen(&[(&frame, behind)]), seen(&[(&frame, behind), (&gear, Place::default())]));
    assert!(all > 150 && hidden < all / 4, "{hidden} of {all}");
    // Surfaces that only hide lines show what lies under all models.
    let edges = LineOptions { edges: Edges::Visible, ..edges };
    let models = unlit(&[(&frame, behind), (&gear, Place::default())]);
    assert_eq!(render_scene(&models, &FRONT, edges, &under).unwrap().colors, under);
}
