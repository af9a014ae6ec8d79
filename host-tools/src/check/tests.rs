//! Models whose tables are broken on purpose: each must be found, with its place, and the same
//! model must pass before.

use std::fs;

mod between;
mod blending;
mod colored;
mod display;
mod filter;
mod fog;
mod form;
mod line_ends;
mod lines;
mod matcap;
mod planes;
mod shiny;
mod stand;
mod textured;

use super::*;
use crate::{
    model::{Indices, Options},
    reference::random::Random,
};

const SQUARE_AND_PENTAGON: &str = "\
v -1 -0.7 0\nv 1 -0.5 0\nv 0.9 0.8 0\nv -0.8 0.9 0\nv -1.3 0.1 0\n";

fn load(obj: &str) -> Model {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    fs::write(&path, obj).unwrap();
    fs::write(
        directory.path().join("m.mtl"),
        "newmtl red\nKd 1 0.1 0.1\nnewmtl blue\nKd 0.1 0.1 1",
    )
    .unwrap();
    Model::load(&path, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn shipped(name: &str) -> Model {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("models").join(name);
    Model::load(&path, &Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn triangles(model: &Model) -> Vec<[usize; 3]> {
    (0..).map_while(|i| model.triangles.as_triangles().get(i)).collect()
}

/// Puts other triangles in place of the first of the tables, all of one material.
fn with_triangles(model: &Model, triangles: &[[usize; 3]]) -> Model {
    let mut model = model.clone();
    let normal = model.face_normals[0];
    model.face_normals = vec![normal; triangles.len()];
    model.triangles = Indices::U16(triangles.iter().map(|t| t.map(|i| i as u16)).collect());
    model.materials.truncate(1);
    model.materials[0].triangle_count = triangles.len() as u32;
    model
}

/// Leaves a triangle out of the tables.
fn without(model: &Model, triangle: usize) -> Model {
    let mut broken = model.clone();
    let mut kept = triangles(model);
    kept.remove(triangle);
    broken.face_normals.remove(triangle);
    let mut first = 0;
    for material in &mut broken.materials {
        let end = first + material.triangle_count;
        if (first..end).contains(&(triangle as u32)) {
            material.triangle_count -= 1;
        }
        first = end;
    }
    broken.triangles = Indices::U16(kept.iter().map(|t| t.map(|i| i as u16)).collect());
    broken
}

/// The vertex of the tables at position `number`, from 1, of those that faces use.
fn vertex(model: &Model, number: u32) -> usize {
    let faces = &model.exact.faces;
    faces.vertices.iter().position(|&position| position == number - 1).unwrap()
}

/// Head on, without light, which faces have of their own.
const FRONT: View = View {
    size: [320, 240],
    distance: 3.0,
    look: None,
    form: Form::AsModelled,
    place: Place { at: [0.0; 3], turn_degrees: [0.0; 3], scale: 1.0 },
    projection: Projection::Perspective { field_of_view_degrees: 40.0 },
    near: 0.1,
    far: 100.0,
    yaw_degrees: 0.0,
    pitch_degrees: 0.0,
    roll_degrees: 0.0,
    subpixel: Subpixel::S8,
    depth: DepthFormat::U16,
    shading: Shading::Unlit,
    perspective: Correction::Adaptive,
    filter: Filter::Nearest,
    display: None,
    blending: Blending::Replace,
    background: BACKGROUND,
    opacity: 1.0,
    fade: FadeAlong::None,
    fog: None,
    lights: ViewLights::OVER_THE_SHOULDER,
    planes: ViewPlanes { sides: [None; MOST_PLANES], space: PlaneSpace::Object },
};

#[track_caller]
fn pass(model: &Model, view: &View) -> Outcome {
    let checked = check(model, view).unwrap();
    let outcome = checked.outcome;
    assert!(outcome.is_within(&Bounds::ARITHMETIC), "{outcome:#?} {view:?}");
    assert_eq!((outcome.places.wrong, outcome.places.first), (0, None));
    outcome
}

/// What the pictures of several views have in all.
#[derive(Default)]
struct Totals {
    pixels: usize,
    /// Pixels that the depth of both rasterizers is compared in.
    drawn: usize,
    /// Pixels whose places are judged.
    judged: usize,
}

impl Totals {
    /// Checks a model in a view, which must pass, and adds its pixels.
    #[track_caller]
    fn add(&mut self, name: &str, checker: &Checker<'_>, view: &View) {
        let outcome = checker.check(view).unwrap().outcome;
        assert!(outcome.is_within(&Bounds::ARITHMETIC), "{name} {view:?} {outcome:#?}");
        self.pixels += view.pixel_count();
        self.drawn += outcome.arithmetic.deviation.pixels;
        self.judged += outcome.places.judged;
    }

    /// Whether more than this share of all pixels is judged.
    const fn are_judged(&self, percent: usize) -> bool {
        self.judged * 100 > self.pixels * percent
    }
}

/// The wrong pixels, of which there are some.
#[track_caller]
fn fail(model: &Model, view: &View) -> Vec<Wrong> {
    let Checked { outcome, wrong, .. } = check(model, view).unwrap();
    assert!(!outcome.is_within(&Bounds::ARITHMETIC), "{outcome:#?}");
    assert!(outcome.arithmetic.is_within(&Bounds::ARITHMETIC), "{outcome:#?}");
    assert_eq!(outcome.places.wrong, wrong.len());
    assert_eq!(outcome.places.first, wrong.first().copied());
    assert!(!wrong.is_empty());
    wrong
}

/// Views from all sides with every precision, depth and shading.
fn views() -> impl Iterator<Item = View> {
    let shadings = Shading::NAMES.map(|(_, shading)| shading);
    (0..24).map(move |i| View {
        yaw_degrees: 47.0 * f64::from(i),
        pitch_degrees: 31.0 * f64::from(i),
        roll_degrees: 17.0 * f64::from(i),
        subpixel: if i % 2 == 0 { Subpixel::S4 } else { Subpixel::S8 },
        depth: if i % 4 < 2 { DepthFormat::U16 } else { DepthFormat::U32 },
        shading: shadings[i as usize % 3],
        projection: if i % 5 == 4 {
            Projection::Orthographic { height: 2.2 }
        } else {
            FRONT.projection
        },
        ..FRONT
    })
}

#[test]
fn shipped_models_pass_from_all_sides_and_nearly_all_pixels_are_judged() {
    for name in ["gear.obj", "rocket.obj", "torus_knot.obj"] {
        let model = shipped(name);
        let checker = Checker::new(&model);
        let mut totals = Totals::default();
        for view in views() {
            // The second view is cut by near and far planes, the third is within the model.
            let cut = View { distance: 1.5, near: 1.2, far: 1.9, ..view };
            let inside = View { distance: 0.1, near: 0.02, ..view };
            for view in [view, cut, inside] {
                totals.add(name, &checker, &view);
            }
        }
        // Those close to edges are not; next to the eye a quantum is many pixels.
        assert!(totals.are_judged(97), "{name}: {} of {}", totals.judged, totals.pixels);
    }
}

#[test]
fn a_lost_triangle_is_found_wherever_it_is_seen() {
    for name in ["gear.obj", "rocket.obj", "torus_knot.obj"] {
        let model = shipped(name);
        let (mut random, count) = (Random(51), triangles(&model).len() as f64);
        let mut found = 0;
        for view in views().take(12) {
            // The triangles that the whole model shows, by pixels.
            let whole = check(&model, &view).unwrap();
            let mut seen = vec![0; triangles(&model).len()];
            for (x, y) in (0..240).flat_map(|y| (0..320).map(move |x| (x, y))) {
                if let Some(front) = whole.arithmetic.nearest(x, y) {
                    seen[front.triangle] += 1;
                }
            }
            for _ in 0..4 {
                let triangle = random.real(0.0, count) as usize;
                if seen[triangle] < 12 {
                    continue;
                }
                let wrong = fail(&without(&model, triangle), &view);
                // Pixels close to edges are not judged; few are that.
                assert!(wrong.len() * 3 > seen[triangle], "{} of {}", wrong.len(), seen[triangle]);
                found += 1;
            }
        }
        assert!(found > 3, "{name}: {found}");
    }
}

#[test]
fn a_hole_names_its_pixel_and_the_line_of_its_face() {
    let model = load(&format!("# one\n{SQUARE_AND_PENTAGON}\nf 1 2 3 4\nf 4 5 1\n"));
    pass(&model, &FRONT);
    let all = triangles(&model);
    let of_second = |t: &[usize; 3]| t.contains(&vertex(&model, 5));
    let second = all.iter().position(of_second).unwrap();
    let wrong = fail(&without(&model, second), &FRONT);
    assert!(wrong.len() > 500, "{}", wrong.len());
    for wrong in wrong {
        assert_eq!((wrong.fault, wrong.line, wrong.triangle), (Fault::Hole, Some(9), None));
        // The triangle is at the left of the picture.
        assert!(wrong.pixel[0] < 120, "{wrong:?}");
    }
}

/// Two faces meet along a slanted side with further corners; the tables lack these in one of them.
#[test]
fn a_t_junction_is_found_by_its_cracks() {
    let mut obj = String::new();
    // 1 to 17 along the side, then a corner on either side of it.
    for i in 0..=16 {
        let t = f64::from(i) / 16.0 - 0.5;
        obj += &format!("v {} {} {}\n", 1.9 * t, 1.1 * t, 0.4 * t);
    }
    obj += "v 0.7 -1 0.1\nv -0.7 1 -0.1\nf";
    for i in (1..=17).chain([19]) {
        obj += &format!(" {i}");
    }
    obj += "\nf";
    for i in (1..=17).rev().chain([18]) {
        obj += &format!(" {i}");
    }
    obj += "\n";
    let whole = load(&obj);
    let [first, last, below, above] = [1, 17, 18, 19].map(|number| vertex(&whole, number));
    let mut kept: Vec<_> =
        triangles(&whole).into_iter().filter(|triangle| triangle.contains(&below)).collect();
    kept.push([first, last, above]);
    let broken = with_triangles(&whole, &kept);
    let mut cracks = 0;
    for roll in 0..24 {
        let view = View {
            roll_degrees: 15.0 * f64::from(roll),
            yaw_degrees: 20.0,
            subpixel: Subpixel::S4,
            ..FRONT
        };
        pass(&whole, &view);
        let Checked { wrong, .. } = check(&broken, &view).unwrap();
        cracks += wrong.len();
        for wrong in wrong {
            assert_eq!(wrong.fault, Fault::Hole);
            assert!(matches!(wrong.line, Some(20 | 21)), "{wrong:?}");
        }
    }
    assert!(cracks > 12, "{cracks}");
}

#[test]
fn a_moved_vertex_is_named_and_moves_pixels() {
    let model = load(&format!("{SQUARE_AND_PENTAGON}f 1 2 3 4 5\n"));
    pass(&model, &FRONT);
    let moved = vertex(&model, 3);
    for by in [3, -40, 4_000] {
        let mut broken = model.clone();
        broken.positions[moved][0] -= by;
        let outcome = check(&broken, &FRONT).unwrap().outcome;
        assert!(!outcome.is_within(&Bounds::ARITHMETIC), "{by}: {outcome:#?}");
        assert!(outcome.arithmetic.is_within(&Bounds::ARITHMETIC), "{outcome:#?}");
        let worst = outcome.end_to_end.vertices.out_of_bounds().unwrap();
        assert_eq!(worst.vertex, moved);
        // 240 pixels are 40 degrees: a unit at a distance of 3 is 120 / tan(20 degrees) / 3 pixels.
        let quantum = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
        let pixels = f64::from(by).abs() * quantum * 120.0 / 20f64.to_radians().tan() / 3.0;
        assert!((worst.error_px - pixels).abs() < worst.bound_px, "{by}: {worst:?}");
        // A few quanta move no pixel that is far from an edge.
        assert!(outcome.places.wrong > 0 || by == 3, "{by}");
    }
}

#[test]
fn a_face_behind_in_place_of_the_one_before_is_a_wrong_surface() {
    let obj = "mtllib m.mtl\nv -1 -1 0.2\nv 1 -1 0.2\nv 0 1 0.2\nv -1 -1 -0.2\nv 1 -1 -0.2\n\
               v 0 1 -0.2\nf 1 2 3\nf 4 5 6\n";
    let model = load(obj);
    pass(&model, &FRONT);
    let front = triangles(&model).iter().position(|t| t.contains(&vertex(&model, 1))).unwrap();
    let wrong = fail(&without(&model, front), &FRONT);
    let surfaces = wrong.iter().filter(|wrong| wrong.fault == Fault::Surface);
    assert!(surfaces.count() > 5_000);
    let middle = wrong.iter().find(|wrong| wrong.pixel == [160, 120]).unwrap();
    assert_eq!((middle.fault, middle.line), (Fault::Surface, Some(8)));
    assert_eq!(middle.triangle, Some(0));
}

#[test]
fn a_wrong_material_is_a_wrong_color() {
    let obj =
        format!("mtllib m.mtl\n{SQUARE_AND_PENTAGON}usemtl red\nf 1 2 3 4\nusemtl blue\nf 4 5 1\n");
    let model = load(&obj);
    let mut broken = model.clone();
    assert_eq!(broken.materials[1].color, [26, 26, 255]);
    broken.materials[1].color = [26, 255, 26];
    for shading in [Shading::Flat, Shading::Gouraud, Shading::Unlit] {
        let view = View { shading, ..FRONT };
        pass(&model, &view);
        for wrong in fail(&broken, &view) {
            assert_eq!((wrong.fault, wrong.line), (Fault::Color, Some(10)), "{shading:?}");
        }
    }
}

#[test]
fn a_face_turned_over_covers_too_many_pixels() {
    let model = load(&format!("{SQUARE_AND_PENTAGON}f 5 4 3 2 1\n"));
    assert_eq!(pass(&model, &FRONT).arithmetic.deviation.pixels, 0);
    let turned: Vec<_> = triangles(&model).iter().map(|&[a, b, c]| [a, c, b]).collect();
    let wrong = fail(&with_triangles(&model, &turned), &FRONT);
    assert!(wrong.len() > 10_000);
    for wrong in wrong {
        assert_eq!((wrong.fault, wrong.line), (Fault::Extra, None));
        assert!(wrong.triangle < Some(3));
    }
}

/// However a square with raised corners is cut, its picture is right; a lost half is not.
#[test]
fn a_face_that_is_not_flat_has_no_single_picture() {
    let model =
        load("v -1 -1 0.2\nv 1 -1 -0.2\nv 1 1 0.2\nv -1 1 -0.2\nv 2 0 0\nf 1 2 3 4\nf 2 5 3\n");
    let [a, b, c, d, e] = [1, 2, 3, 4, 5].map(|number| vertex(&model, number));
    let [one, other] = [[[a, b, c], [a, c, d]], [[b, c, d], [b, d, a]]]
        .map(|[first, second]| with_triangles(&model, &[first, second, [b, e, c]]));
    for view in views() {
        let view = View { shading: Shading::Unlit, ..view };
        pass(&one, &view);
        pass(&other, &view);
    }
    let wrong = fail(&with_triangles(&model, &[[a, b, c], [b, e, c]]), &FRONT);
    assert!(wrong.iter().all(|wrong| (wrong.fault, wrong.line) == (Fault::Hole, Some(6))));
}

/// Any picture of it is right, but not any picture of its neighbours.
#[test]
fn a_face_that_crosses_itself_is_not_judged() {
    let model =
        load("v -1 -1 0\nv 1 1 0\nv 1 -1 0\nv -1 0.5 0\nv 2 -1 0\nv 2 1 0\nf 1 2 3 4\nf 3 5 6 2\n");
    let of_second = |t: &[usize; 3]| t.contains(&vertex(&model, 5));
    let all = triangles(&model);
    pass(&model, &FRONT);
    let square: Vec<_> =
        all.iter().copied().filter(|t| of_second(t) || t.contains(&vertex(&model, 6))).collect();
    assert!(square.len() == 2 && all.len() > 2);
    pass(&with_triangles(&model, &square), &FRONT);
    let wrong = fail(&without(&model, all.iter().position(of_second).unwrap()), &FRONT);
    assert!(wrong.iter().all(|wrong| (wrong.fault, wrong.line) == (Fault::Hole, Some(8))));
}
