//! Models between two shapes.

use std::path::Path;

use super::*;
use crate::reference::{Blend, HalfSpace};

/// A tube whose second shape is twisted, bent and moved: normals turn by up to some 80 degrees.
fn tube() -> Model {
    let file = |twist: f64, bend: f64| {
        let (around, along) = (14, 10);
        let mut text = String::from("mtllib m.mtl\nusemtl red\n");
        for ring in 0..=along {
            let height = 2.0 * f64::from(ring) / f64::from(along) - 1.0;
            for step in 0..around {
                let angle = f64::from(step) / f64::from(around) * std::f64::consts::TAU;
                let (sin, cos) = (angle + twist * height).sin_cos();
                let radius = 0.4 + 0.1 * f64::from(step % 3);
                let [x, z] = [radius * cos + bend * height * height, radius * sin];
                text += &format!("v {x} {height} {z}\n");
            }
        }
        for ring in 0..along {
            for step in 0..around {
                let at = |ring, step| 1 + ring * around + step % around;
                let [a, b] = [at(ring, step), at(ring, step + 1)];
                let [c, d] = [at(ring + 1, step + 1), at(ring + 1, step)];
                text += &format!("f {a} {d} {c} {b}\n");
            }
        }
        text
    };
    let (first, second) = (file(0.0, 0.0), file(1.4, 0.5));
    let further = [(Path::new("b.obj"), second.as_bytes())];
    let model = Model::keyframes_from_bytes(
        (Path::new("a.obj"), first.as_bytes()),
        &further,
        &Options::default(),
    );
    model.unwrap_or_else(|error| panic!("{error}"))
}

fn at(progress: f64) -> Form {
    Form::Between { progress, halfway: progress }
}

/// Views from all sides at places of the way: the ends, the middle, and others.
fn on_the_way() -> impl Iterator<Item = View> {
    let places = [0.5, 0.0, 0.25, 1.0, 0.8, 1.0 / 3.0, 0.999];
    views().zip(places.into_iter().cycle()).map(|(view, t)| View { form: at(t), ..view })
}

#[test]
fn models_between_shapes_pass_and_nearly_all_pixels_are_judged() {
    let model = tube();
    let checker = Checker::new(&model);
    let mut totals = Totals::default();
    let lamp = Some(Lamp { position: [0.5, 1.0, 1.5], half: 1.0 });
    for (view, (_, shading)) in on_the_way().zip(Shading::NAMES.into_iter().cycle()) {
        if shading.is_colored() || shading.is_textured() {
            continue;
        }
        let lights = ViewLights { lamps: [lamp, None, None, None], ..view.lights };
        totals.add("tube", &checker, &View { shading, ..view });
        totals.add("tube", &checker, &View { shading, lights, ..view });
    }
    assert!(totals.drawn > 200_000, "{}", totals.drawn);
    // Faces are not flat on the way, which widens the layers about their edges.
    assert!(totals.are_judged(75), "{} of {}", totals.judged, totals.pixels);
}

#[test]
fn planes_fog_and_layers_go_with_two_shapes() {
    let model = tube();
    let checker = Checker::new(&model);
    let mut totals = Totals::default();
    let side = HalfSpace { normal: [0.4, -0.8, 0.3], offset: 0.1 };
    let fog = Fog { law: reference::Fog::Linear { start: 2.0, end: 4.0 }, ..Fog::NONE };
    for (number, view) in on_the_way().enumerate() {
        let planes = ViewPlanes {
            sides: [Some(side), None, None, None, None, None],
            space: PlaneSpace::Object,
        };
        let blending = Blending::By(Blend::Over);
        let view = match number % 3 {
            0 => View { planes, ..view },
            1 => View { fog: Some(fog), ..view },
            _ => View { blending, opacity: 0.5, fade: FadeAlong::Y, ..view },
        };
        totals.add("tube", &checker, &view);
    }
    assert!(totals.drawn > 100_000, "{}", totals.drawn);
}

/// A 50th of the way moves vertices by up to a pixel, and its normals by a degree.
#[test]
fn a_wrong_place_on_the_way_is_found() {
    let model = tube();
    let view = View { yaw_degrees: 40.0, shading: Shading::Flat, form: at(0.5), ..FRONT };
    pass(&model, &view);
    let judged = view.form;
    let made = judged.made(&model).unwrap();
    let checker = Checker::of(&made, false);
    let Checker { model, surface, skins } = &checker;
    let colors = face_colors::colors(model, surface, skins, &view.rounded());
    let drawn = shading::draw(model, surface, skins, &View { form: at(0.52), ..view }).unwrap();
    let outcome = checker.compare(&view, drawn, &colors).outcome;
    assert!(!outcome.arithmetic.vertices.are_within(), "{outcome:#?}");
    let noted = Noted::of(model, &View { form: at(0.52), ..view }).unwrap();
    let errors = noted.normal_errors(&judged.table_normals(model), judged);
    assert!(!errors.are_within(), "{errors:?}");
}

#[test]
fn a_turn_goes_there_and_back() {
    let view = View { form: Form::Between { progress: 0.25, halfway: 0.75 }, ..FRONT };
    let of = |frame| match view.turned(frame, 8).form {
        Form::Between { progress, .. } => progress,
        _ => f64::NAN,
    };
    assert_eq!([0, 1, 2, 4, 6, 7].map(of), [0.25, 0.375, 0.5, 0.75, 0.5, 0.375]);
}

#[test]
fn one_shape_and_places_off_the_way_are_refused() {
    let view = |progress| View { form: at(progress), ..FRONT };
    assert_eq!(check(&shipped("gear.obj"), &view(0.5)).unwrap_err(), ViewError::OneShape);
    assert_eq!(render(&shipped("gear.obj"), &view(0.5)).unwrap_err(), ViewError::OneShape);
    for progress in [-0.1, 1.1, f64::NAN] {
        let error = render(&tube(), &view(progress)).unwrap_err();
        assert!(matches!(error, ViewError::OutOfRange { .. }), "{error}");
    }
}
