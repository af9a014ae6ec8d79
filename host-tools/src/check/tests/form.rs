//! Models that a matrix stretches, mirrors or shears.

use super::*;
use crate::reference::{Blend, HalfSpace, LinearMap};

const MIRROR: LinearMap = LinearMap { rows: [[1.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, -1.3]] };

/// Of any kind: mirrors or not, stretching up to five times more in one direction than in another.
fn maps() -> impl Iterator<Item = LinearMap> {
    let mut random = Random(91);
    std::iter::repeat_with(move || LinearMap {
        rows: [(); 3].map(|()| [(); 3].map(|()| random.real(-0.9, 0.9))),
    })
    .filter(|map| map.unevenness() < 5.0)
}

/// Views in which a model of up to 1.6 of its size is not too near.
fn shaped() -> impl Iterator<Item = View> {
    views().zip(maps()).map(|(view, map)| View { near: 0.5, form: Form::Shaped(map), ..view })
}

#[test]
fn shaped_models_pass_from_all_sides_and_nearly_all_pixels_are_judged() {
    let shadings = Shading::NAMES.map(|(_, shading)| shading).into_iter().cycle();
    let lamp = Lamp { position: [0.5, 1.0, 1.5], half: 1.0 };
    let mut mirrored = 0;
    for name in ["gear.obj", "rocket.obj", "wooden_crate.obj"] {
        let model = shipped(name);
        let checker = Checker::new(&model);
        let mut totals = Totals::default();
        for (number, (view, shading)) in shaped().zip(shadings.clone()).enumerate() {
            let has_textures = model.textures.is_some();
            if shading.is_colored() || (shading.is_textured() && !has_textures) {
                continue;
            }
            mirrored += usize::from(view.form.is_mirrored());
            let lamps = if number % 3 == 0 { Some(lamp) } else { None };
            let lights = ViewLights { lamps: [lamps, None, None, None], ..view.lights };
            totals.add(name, &checker, &View { shading, lights, ..view });
        }
        assert!(totals.drawn > 50_000, "{name}: {}", totals.drawn);
        assert!(totals.are_judged(95), "{name}: {} of {}", totals.judged, totals.pixels);
    }
    assert!((10..50).contains(&mirrored), "{mirrored}");
}

#[test]
fn planes_fog_and_layers_go_with_a_matrix() {
    let model = shipped("torus_knot.obj");
    let checker = Checker::new(&model);
    let mut totals = Totals::default();
    let side = HalfSpace { normal: [0.4, -0.8, 0.3], offset: 0.1 };
    let fog = Fog { law: reference::Fog::Linear { start: 2.0, end: 4.0 }, ..Fog::NONE };
    for (number, view) in shaped().enumerate() {
        let space = [PlaneSpace::Object, PlaneSpace::World][number / 3 % 2];
        let planes = ViewPlanes { sides: [Some(side), None, None, None, None, None], space };
        let view = match number % 3 {
            0 => View { planes, ..view },
            1 => View { fog: Some(fog), ..view },
            _ => View {
                blending: Blending::By(Blend::Over),
                opacity: 0.5,
                fade: FadeAlong::Y,
                ..view
            },
        };
        totals.add("torus_knot.obj", &checker, &view);
    }
    assert!(totals.drawn > 50_000, "{}", totals.drawn);
    assert!(totals.are_judged(95), "{} of {}", totals.judged, totals.pixels);
}

/// Draws a model in one form and judges it in another.
fn judged_by(model: &Model, view: &View, drawn: LinearMap, judged: LinearMap) -> Checked {
    let of = |map| View { form: Form::Shaped(map), ..*view };
    let (drawn, judged) = (of(drawn), of(judged));
    let made = judged.form.made(model).unwrap();
    let checker = Checker::of(&made, judged.form.is_mirrored());
    let Checker { model, surface, skins } = &checker;
    let by = |view: &View| shading::draw(model, surface, skins, view).unwrap();
    let colors = face_colors::colors(model, surface, skins, &judged.rounded());
    let both = Drawn { end_to_end: by(&judged).end_to_end, ..by(&drawn) };
    checker.compare(&judged, both, &colors)
}

/// A hundredth of the model's radius is about a pixel.
#[test]
fn a_wrong_matrix_is_found() {
    let model = shipped("rocket.obj");
    let LinearMap { rows } = MIRROR;
    let view = View { shading: Shading::Gouraud, yaw_degrees: 40.0, near: 0.5, ..FRONT };
    let right = judged_by(&model, &view, MIRROR, MIRROR).outcome;
    assert!(right.is_within(&Bounds::ARITHMETIC), "{right:#?}");
    let mut stretched = rows;
    stretched[1][1] += 0.02;
    let mut sheared = rows;
    sheared[0][1] += 0.02;
    let mut other_hand = rows;
    other_hand[2][2] = 1.3;
    for rows in [stretched, sheared, other_hand] {
        let outcome = judged_by(&model, &view, LinearMap { rows }, MIRROR).outcome;
        assert!(!outcome.arithmetic.vertices.are_within(), "{rows:?} {outcome:#?}");
        assert!(outcome.places.wrong > 20, "{rows:?} {outcome:#?}");
    }
}

#[test]
fn matrices_without_an_inverse_are_drawn_but_not_judged() {
    let model = shipped("gear.obj");
    let of = |z: f64| {
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, z]];
        View { form: Form::Shaped(LinearMap { rows }), ..FRONT }
    };
    for shading in [Shading::Flat, Shading::Gouraud] {
        let flat = View { shading, ..of(0.0) };
        assert!(render(&model, &flat).unwrap().pixels.iter().any(|pixel| pixel.depth > 0));
        assert_eq!(check(&model, &flat).unwrap_err(), ViewError::Flat);
    }
    assert!(matches!(check(&model, &of(0.0005)), Err(ViewError::Uneven { .. })));
    assert!(matches!(check(&model, &of(40_000.0)), Err(ViewError::OutOfRange { .. })));
    pass(&model, &of(0.01));
}
