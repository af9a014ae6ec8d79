//! Views with clip planes.

use super::*;
use crate::reference::{Blend, HalfSpace};

fn planes(sides: &[HalfSpace], space: PlaneSpace) -> ViewPlanes {
    let nth = |i: usize| sides.get(i).copied();
    ViewPlanes { sides: std::array::from_fn(nth), space }
}

/// Planes that pass by the middle of a model at up to 0.4 of its radius, on either side.
fn random_planes(random: &mut Random, count: usize, space: PlaneSpace) -> ViewPlanes {
    let sides: Vec<_> = (0..count)
        .map(|_| {
            let normal = [(); 3].map(|()| random.real(-1.0, 1.0));
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            HalfSpace { normal, offset: length * random.real(-0.1, 0.4) }
        })
        .collect();
    planes(&sides, space)
}

fn cuts(random: &mut Random) -> impl Iterator<Item = ViewPlanes> {
    let spaces = [PlaneSpace::Object, PlaneSpace::World];
    (0..).map(move |i| random_planes(random, [1, 2, 6][i % 3], spaces[i % 2]))
}

#[test]
fn cut_models_pass_from_all_sides_and_nearly_all_pixels_are_judged() {
    let mut random = Random(61);
    for name in ["gear.obj", "rocket.obj", "torus_knot.obj"] {
        let model = shipped(name);
        let checker = Checker::new(&model);
        let mut totals = Totals::default();
        for (view, planes) in views().zip(cuts(&mut random)) {
            let whole = View { planes, ..view };
            let near = View { distance: 1.5, near: 1.2, far: 1.9, ..whole };
            for view in [whole, near] {
                totals.add(name, &checker, &view);
            }
        }
        assert!(totals.drawn > 100_000, "{name}: {}", totals.drawn);
        assert!(totals.are_judged(97), "{name}: {} of {}", totals.judged, totals.pixels);
    }
}

/// Draws a model in a view, and judges it by another.
fn judged_by(checker: &Checker<'_>, drawn: &View, view: &View) -> Checked {
    let Checker { model, surface, skins } = checker;
    let of = |view: &View| shading::draw(model, surface, skins, view).unwrap();
    let colors = face_colors::colors(model, surface, skins, &view.rounded());
    checker.compare(view, Drawn { end_to_end: of(view).end_to_end, ..of(drawn) }, &colors)
}

/// A fiftieth of the model's radius is about 2 pixels.
#[test]
fn a_plane_in_a_wrong_place_is_found() {
    let model = shipped("torus_knot.obj");
    let checker = Checker::new(&model);
    let mut random = Random(62);
    for view in views() {
        let planes = random_planes(&mut random, 1, PlaneSpace::Object);
        let moved = |by: f64| {
            let side = planes.sides[0].map(|side| {
                let length = side.normal.iter().map(|c| c * c).sum::<f64>().sqrt();
                side.widened(by * length)
            });
            View {
                planes: ViewPlanes { sides: [side, None, None, None, None, None], ..planes },
                ..view
            }
        };
        assert_eq!(judged_by(&checker, &moved(0.0), &moved(0.0)).outcome.places.wrong, 0);
        let [hole, extra] = [-0.02, 0.02].map(|by| {
            let Checked { outcome, wrong, .. } = judged_by(&checker, &moved(by), &moved(0.0));
            assert!(!outcome.is_within(&Bounds::ARITHMETIC), "{by} {view:?}");
            wrong
        });
        assert!(hole.iter().all(|wrong| wrong.fault != Fault::Extra), "{view:?}");
        assert!(extra.iter().all(|wrong| wrong.fault != Fault::Hole), "{view:?}");
    }
}

/// A plane in a face, give or take a rounding, and planes that meet the face in narrow angles.
#[test]
fn planes_beside_faces_pass() {
    let cube = load(
        "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
         f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n",
    );
    let checker = Checker::new(&cube);
    let half = cube.exact.faces.positions[6][0];
    let (mut judged, mut pixels) = (0, 0);
    for view in views().step_by(4) {
        for tilt in [0.0, 1e-6, 1e-4, 1e-2] {
            for offset in [half, half - 1.0 / 65_536.0, half + 1.0 / 65_536.0] {
                let side = HalfSpace { normal: [-1.0, tilt, 0.0], offset };
                let scaled =
                    HalfSpace { normal: side.normal.map(|c| c * 4e3), offset: offset * 4e3 };
                for side in [side, side.flipped(), scaled] {
                    let planes = planes(&[side], PlaneSpace::Object);
                    let outcome = checker.check(&View { planes, ..view }).unwrap().outcome;
                    assert!(outcome.is_within(&Bounds::ARITHMETIC), "{side:?} {outcome:#?}");
                    judged += outcome.places.judged;
                    pixels += 320 * 240;
                }
            }
        }
    }
    // A face in a plane is not judged, nor what lies behind it.
    assert!(judged * 100 > pixels * 80, "{judged} of {pixels}");
}

/// Planes that keep all draw what no planes draw.
#[test]
fn planes_beside_the_model_change_nothing() {
    let model = shipped("wooden_crate.obj");
    let far = HalfSpace { normal: [1.0, 2.0, -1.0], offset: 9.0 };
    let planes = planes(&[far; MOST_PLANES], PlaneSpace::World);
    for (view, (_, shading)) in views().zip(Shading::NAMES.into_iter().cycle()) {
        if shading.is_colored() {
            continue;
        }
        let view = View { shading, ..view };
        assert_eq!(
            render(&model, &View { planes, ..view }).unwrap(),
            render(&model, &view).unwrap(),
            "{shading:?}"
        );
    }
}

#[test]
fn layers_are_cut_too() {
    let model = shipped("torus_knot.obj");
    let mut random = Random(63);
    let blending = Blending::By(Blend::Over);
    for (view, planes) in views().zip(cuts(&mut random)).take(8) {
        let view = View { shading: Shading::Gouraud, blending, opacity: 0.5, planes, ..view };
        let found = pass(&model, &view).arithmetic.blend.unwrap();
        assert!(found.blend_pixels > 200, "{found:?}");
    }
}

#[test]
fn planes_without_a_normal_and_far_planes_are_refused() {
    let model = shipped("gear.obj");
    for side in [
        HalfSpace { normal: [0.0; 3], offset: 1.0 },
        HalfSpace { normal: [1e-7, 0.0, 0.0], offset: 1.0 },
        HalfSpace { normal: [1e5, 0.0, 0.0], offset: 1.0 },
        HalfSpace { normal: [1.0, 0.0, f64::NAN], offset: 1.0 },
        HalfSpace { normal: [1.0, 0.0, 0.0], offset: 1e5 },
        HalfSpace { normal: [1.0, 0.0, 0.0], offset: f64::NAN },
    ] {
        let planes = planes(&[side], PlaneSpace::World);
        let error = check(&model, &View { planes, ..FRONT }).unwrap_err();
        assert!(matches!(error, ViewError::OutOfRange { .. }), "{side:?}: {error}");
    }
}
