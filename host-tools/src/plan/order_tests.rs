//! Orders of triangles on bodies whose orders are known by hand.

use std::{fmt::Write as _, fs, path::Path};

use rasterizer::camera::{Distance, Perspective};

use super::{
    arcs::Arcs,
    order::{FixedOrder, Search},
    partition::Partition,
    seen::Eye,
    tests::{CUBE, circle_of_bars, decision, file, request},
    *,
};
use crate::{
    check::angle,
    model::{Model, Options},
    reference::random::Random,
};

/// The views with these turns about y and x.
fn views(turns_degrees: &[[f64; 2]]) -> Views {
    let view = |&[y, x]: &[f64; 2]| View { turns_degrees: [y, x, 0.0], distance: None };
    Views::List(turns_degrees.iter().map(view).collect())
}

/// A large picture, in which thin parts have pixels.
fn large(views: Views) -> Request {
    Request { display: [320, 240], ram_bytes: 512 << 10, views, ..request() }
}

fn study_of(path: &Path, request: &Request) -> Study {
    Study::new(path, &Options::default(), request, |_| ()).unwrap()
}

/// What a model in memory is found out about.
fn study(obj: &str, request: &Request) -> Study {
    study_of(&file(obj).1, request)
}

/// A ring of quadrangles, each of which is flat: tables for light of vertices share no vertex, and
/// those for light of triangles do.
fn ring() -> String {
    let [around, tube] = [16_u32, 8];
    let mut text = "s off\n".to_owned();
    for i in 0..around {
        for j in 0..tube {
            let [a, b] = [(i, around), (j, tube)].map(|(k, n)| f64::from(k * 360 / n).to_radians());
            let radius = 1.0 + 0.4 * b.cos();
            let _ = writeln!(text, "v {} {} {}", radius * a.cos(), radius * a.sin(), 0.4 * b.sin());
        }
    }
    for i in 0..around {
        for j in 0..tube {
            let corner = |i: u32, j: u32| i % around * tube + j % tube + 1;
            let corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            let [a, b, c, d] = corners;
            let _ = writeln!(text, "f {a} {b} {c} {d}");
        }
    }
    text
}

#[test]
fn bars_in_a_circle_have_no_order_and_are_named() {
    let (_directory, path) = file(&circle_of_bars());
    let study = study_of(&path, &large(views(&[[0.0; 2]])));
    assert!(!study.is_right(Visibility::FixedOrder));
    let Search::Cycle(cycle) = &study.order else { panic!("{:?}", study.order) };
    // One triangle of each bar at least, of six.
    assert!((3..=6).contains(&cycle.steps.len()) && cycle.triangles <= 6, "{cycle:?}");
    let plan = study.plan(&Costs::measured()).unwrap();
    assert_eq!(plan.chosen.types.visibility, Visibility::U16);
    let reason = &decision(&plan, "visibility").reason;
    let (first, _) = cycle.steps[0];
    assert!(reason.contains(&format!("triangle {first} is behind")), "{reason}");
    assert!(reason.contains("in view 0"), "{reason}");
    let mut faults = plan.rejected.iter();
    assert!(faults.any(|(candidate, _, fault)| {
        candidate.types.visibility == Visibility::FixedOrder && *fault == Fault::Cycle
    }));
}

/// Steps of a stair that winds up towards the camera, the nearest first, each over the next.
fn spiral() -> String {
    let mut text = String::new();
    for step in 0..12 {
        let z = -0.05 * f64::from(step);
        for degrees in [0, 60] {
            let (sin, cos) = f64::from(30 * step + degrees).to_radians().sin_cos();
            let _ = writeln!(text, "v {} {} {z}\nv {cos} {sin} {z}", 0.1 * cos, 0.1 * sin);
        }
        let first = 4 * step + 1;
        let _ = writeln!(text, "f {first} {} {} {}", first + 1, first + 3, first + 2);
    }
    text
}

#[test]
fn a_spiral_is_drawn_in_its_own_order() {
    let (_directory, path) = file(&spiral());
    let request = large(views(&[[0.0; 2], [10.0, 5.0]]));
    let study = study_of(&path, &request);
    assert!(!study.is_right(Visibility::MeshOrder) && study.is_right(Visibility::FixedOrder));
    assert_eq!(study.worst(Visibility::FixedOrder), Worst::default());
    let plan = study.plan(&Costs::measured()).unwrap();
    assert_eq!(plan.chosen.types.visibility, Visibility::FixedOrder);
    assert!(plan.source.contains("no depth, fixed order"));
    assert!(!plan.source.contains("back_to_front") && !plan.source.contains("memory.depth"));
    let visibility = decision(&plan, "visibility");
    assert!(visibility.reason.contains("have no cycle"), "{visibility:?}");
    // A depth buffer would take two bytes more for each pixel.
    let other = visibility.other.as_ref().unwrap();
    assert!(other.choice == "16-bit depth" && other.ram_bytes >= 2 * 320 * 240, "{other:?}");
}

#[test]
fn where_the_order_of_the_mesh_is_right_no_other_is_sought() {
    // A sheet hides nothing either, but that is not proven.
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    assert!(matches!(study(sheet, &request()).order, Search::Unneeded));
    let (_directory, path) = file(CUBE);
    let study = study_of(&path, &request());
    assert!(matches!(study.order, Search::Unneeded));
    let plan = study.plan(&Costs::measured()).unwrap();
    let mut rejected = plan.rejected.iter();
    assert!(rejected.all(|(other, ..)| other.types.visibility != Visibility::FixedOrder));
}

#[test]
fn views_that_contradict_each_other_have_no_common_order() {
    // Two strips beside each other, one rising to the right and one to the left: tilted one way
    // their right ends overlap, tilted the other way their left ends do.
    let strip = |y: f64, z: f64| {
        format!(
            "v -1 {} {}\nv 1 {} {z}\nv 1 {} {z}\nv -1 {} {}\n",
            y - 0.1,
            -z,
            y - 0.1,
            y + 0.1,
            y + 0.1,
            -z
        )
    };
    let obj = strip(0.0, 0.5) + &strip(0.3, -0.5) + "f 1 2 3 4\nf 5 6 7 8\n";
    let [up, down] = [[0.0, 17.5], [0.0, -17.5]];
    for alone in [up, down] {
        let study = study(&obj, &large(views(&[alone])));
        assert!(
            study.is_right(Visibility::MeshOrder) || study.is_right(Visibility::FixedOrder),
            "{alone:?}"
        );
    }
    let study = study(&obj, &large(views(&[up, down])));
    let Search::Cycle(cycle) = &study.order else { panic!("{:?}", study.order) };
    let mut views: Vec<u32> = cycle.steps.iter().map(|&(_, view)| view).collect();
    views.sort_unstable();
    views.dedup();
    assert_eq!(views, [0, 1], "{cycle:?}");
}

/// Looks at a model as a study does.
fn with_eye<R>(model: &Model, study: &Study, look: impl FnOnce(&Eye<'_>) -> R) -> R {
    let mesh = model.mesh();
    let [near, far] = study.depth_range.map(|end| Distance::from_num(end));
    let fov = angle(study.request.field_of_view_degrees);
    let lens = Perspective::new(fov, near, far).unwrap();
    look(&Eye { mesh: &mesh, lens, size: study.request.display })
}

/// The corners of the faces that pixels show, wherever they stand in the tables.
fn corners(model: &Model, faces: &[u32]) -> Vec<Option<[[i16; 3]; 3]>> {
    let table = model.triangles.as_triangles();
    let corners = |face: &u32| {
        let triangle = table.get(face.checked_sub(1)? as usize)?;
        let mut places = triangle.map(|corner| model.positions[corner]);
        places.sort_unstable();
        Some(places)
    };
    faces.iter().map(corners).collect()
}

#[test]
fn where_there_is_an_order_the_last_drawn_is_the_nearest() {
    let mut random = Random(3);
    let (mut found, mut refused) = (0, 0);
    for _ in 0..60 {
        let mut obj = String::new();
        for triangle in 0..9 {
            let at = [0; 3].map(|_| random.real(-1.0, 1.0));
            for _ in 0..3 {
                let [x, y, z] = at.map(|c| c + random.real(-0.5, 0.5));
                let _ = writeln!(obj, "v {x} {y} {z}");
            }
            obj += ["usemtl a\n", "usemtl b\n"][triangle % 2];
            let _ = writeln!(
                obj,
                "f {0} {1} {2}",
                3 * triangle + 1,
                3 * triangle + 2,
                3 * triangle + 3
            );
        }
        let (_directory, path) = file(&obj);
        let small = Request { views: views(&[[0.0; 2], [40.0, 10.0]]), ..request() };
        let study = study_of(&path, &small);
        let types = |visibility| Types {
            is_smooth: study.is_smooth(),
            paint: Paint::Materials,
            visibility,
            in_bands: false,
            vertices: Vertices::Stored,
            clips: false,
        };
        match &study.order {
            Search::Found(_) => found += 1,
            Search::Cycle(_) => refused += 1,
            _ => continue,
        }
        if !matches!(study.order, Search::Found(_)) {
            continue;
        }
        let [plain, ordered] = [Visibility::U32, Visibility::FixedOrder]
            .map(|visibility| study.model(&types(visibility)).unwrap());
        for view in small.views.placed(small.distance) {
            let precision = small.core.subpixel();
            let nearest = with_eye(&plain, &study, |eye| eye.nearest(precision, &view)).unwrap();
            let last =
                with_eye(&ordered, &study, |eye| eye.last_drawn(precision, &view, None)).unwrap();
            assert!(corners(&plain, &nearest) == corners(&ordered, &last), "{obj}");
        }
    }
    assert!(found >= 10 && refused >= 1, "{found} {refused}");
}

/// Copies of a model beside each other, each of its own material.
fn copies(obj: &str, places: &[[f64; 3]]) -> String {
    let count = obj.lines().filter(|line| line.starts_with("v ")).count();
    let mut text = String::new();
    for (copy, place) in places.iter().enumerate() {
        let _ = writeln!(text, "usemtl m{copy}");
        for line in obj.lines() {
            let mut words = line.split(' ');
            let kind = words.next().unwrap();
            let moved: Vec<String> = match kind {
                "v" => {
                    let moved = words.zip(place).map(|(c, by)| c.parse::<f64>().unwrap() + by);
                    moved.map(|c| c.to_string()).collect()
                }
                "f" => {
                    let moved = words.map(|c| c.parse::<usize>().unwrap() + copy * count);
                    moved.map(|corner| corner.to_string()).collect()
                }
                _ => words.map(str::to_owned).collect(),
            };
            let _ = writeln!(text, "{kind} {}", moved.join(" "));
        }
    }
    text
}

const CORNERS: [[f64; 3]; 4] =
    [[0.5, 0.0, 0.5], [0.5, 0.0, -1.5], [-1.5, 0.0, 0.5], [-1.5, 0.0, -1.5]];

#[test]
fn convex_bodies_are_parts_from_wherever_they_are_seen() {
    let (_directory, path) = file(&copies(CUBE, &CORNERS));
    let request = large(Views::default());
    let study = study_of(&path, &request);
    // Each cube is before the next one in some view.
    assert!(matches!(study.order, Search::Cycle(_)), "{:?}", study.order);
    assert_eq!(study.worst(Visibility::PartOrder), Worst::default());
    assert!(study.is_right(Visibility::PartOrder) && study.is_proven(Visibility::PartOrder));
    let plan = study.plan(&Costs::measured()).unwrap();
    assert_eq!(plan.chosen.types.visibility, Visibility::PartOrder);
    assert!(plan.source.contains("seen.in_parts(&PARTS)"), "{}", plan.source);
    assert_eq!(plan.source.matches("SeparatingPlane::new").count(), 3);
    assert!(!plan.source.contains("back_to_front") && !plan.source.contains("memory.depth"));
    let visibility = decision(&plan, "visibility");
    assert!(visibility.reason.contains("planes keep 4 parts apart"), "{visibility:?}");
    assert!(visibility.basis.contains("proven"), "{visibility:?}");
    // A depth buffer would take two bytes more for each pixel.
    let other = visibility.other.as_ref().unwrap();
    assert!(other.choice == "16-bit depth" && other.ram_bytes > 0, "{other:?}");
}

#[test]
fn parts_that_are_not_convex_have_an_order_of_their_own() {
    // Cubes with a dent, which no plane divides.
    let dent = "f 2 6 9\nf 6 8 9\nf 8 4 9\nf 4 2 9\nv 0.5 0.5 0.4\n";
    let dented = CUBE.replace("f 2 6 8 4\n", dent);
    let (_directory, path) = file(&copies(&dented, &CORNERS));
    let views = Views::Turntable { steps: 128, pitch_degrees: 10.0 };
    for is_smooth in [false, true] {
        let request = Request { is_smooth: Some(is_smooth), ..large(views.clone()) };
        let study = study_of(&path, &request);
        assert!(matches!(study.order, Search::Cycle(_)));
        let order = study.part_order.as_ref().unwrap();
        assert_eq!(order.parts().map(Partition::count), Some(4));
        assert!(study.is_right(Visibility::PartOrder) && !study.is_proven(Visibility::PartOrder));
        assert!(order.reason().contains("within them have no cycle"), "{}", order.reason());
        assert!(
            study.worst(Visibility::PartOrder).wrong < study.worst(Visibility::MeshOrder).wrong
        );
        let plan = study.plan(&Costs::measured()).unwrap();
        let mut others = plan.rejected.iter().map(|(other, ..)| other.types.visibility);
        assert!(
            plan.chosen.types.visibility == Visibility::PartOrder
                || others.any(|other| other == Visibility::PartOrder)
        );
    }
}

#[test]
fn parts_are_not_sought_where_an_order_of_the_whole_is_right() {
    let (_directory, path) = file(&spiral());
    let study = study_of(&path, &large(views(&[[0.0; 2], [10.0, 5.0]])));
    assert!(study.is_right(Visibility::FixedOrder) && study.part_order.is_none());
    assert!(!study.is_right(Visibility::PartOrder));
    assert!(study.considered().all(|visibility| visibility != Visibility::PartOrder));
    // And are not found where no plane divides bodies.
    let (_directory, path) = file(&circle_of_bars());
    let study = study_of(&path, &large(views(&[[0.0; 2]])));
    assert!(matches!(study.order, Search::Cycle(_)) && study.part_order.is_none());
}

#[test]
fn what_is_judged_is_the_order_of_the_table_that_is_written() {
    let (_directory, path) = file(&ring());
    let steps = Views::Turntable { steps: 8, pitch_degrees: 50.0 };
    let mut wrong_in_mesh_order = Vec::new();
    for is_smooth in [false, true] {
        let request =
            Request { is_smooth: Some(is_smooth), views: steps.clone(), ..large(steps.clone()) };
        let study = study_of(&path, &request);
        assert!(matches!(study.order, Search::Found(_)), "{:?}", study.order);
        for visibility in [Visibility::MeshOrder, Visibility::FixedOrder] {
            let types = Types {
                is_smooth,
                paint: Paint::Materials,
                visibility,
                in_bands: false,
                vertices: Vertices::Stored,
                clips: false,
            };
            let written = study.model(&types).unwrap();
            let wrong = with_eye(&written, &study, |eye| {
                let precision = request.core.subpixel();
                let wrong = |view| {
                    let [nearest, last] =
                        [eye.nearest(precision, view), eye.last_drawn(precision, view, None)];
                    let (nearest, last) = (nearest.unwrap(), last.unwrap());
                    nearest.iter().zip(&last).filter(|(a, b)| a != b).count()
                };
                request.views.placed(request.distance).iter().map(wrong).max().unwrap()
            });
            assert_eq!(study.worst(visibility).wrong, wrong, "{types}");
            if visibility == Visibility::MeshOrder {
                wrong_in_mesh_order.push(wrong);
            }
        }
        // For light of the other kind too, whose tables have another order.
        let Search::Found(order) = &study.order else { panic!() };
        let other = Types {
            is_smooth: !is_smooth,
            paint: Paint::Materials,
            visibility: Visibility::FixedOrder,
            in_bands: false,
            vertices: Vertices::Stored,
            clips: false,
        };
        let same = |types: &Types| {
            let model = study.model(types).unwrap();
            let faces: Vec<u32> = (1..=model.report.triangles as u32).collect();
            corners(&model, &faces)
        };
        assert_eq!(same(&other), same(&Types { is_smooth, ..other }), "{order:?}");
    }
    assert!(wrong_in_mesh_order[0] != wrong_in_mesh_order[1], "{wrong_in_mesh_order:?}");
}

#[test]
fn an_order_from_random_views_is_judged_by_others() {
    let (_directory, path) = file(&ring());
    let study = study_of(&path, &large(Views::Orbit { count: 2 }));
    // It is right in the views that it is made from, and wrong in others.
    assert!(matches!(study.order, Search::Found(_)), "{:?}", study.order);
    let worst = study.worst(Visibility::FixedOrder);
    assert!(worst.part > study.request.wrong_part, "{worst:?}");
    assert!(!study.is_right(Visibility::FixedOrder));
    let generous = Request { wrong_part: 1.0, ..large(Views::Orbit { count: 2 }) };
    assert!(generous.views.basis_of_order().contains("judged by others"));
    // No view is among both.
    let [made, judging] = [generous.views.placed(3.0), generous.views.judging(3.0)];
    assert_eq!(made.len(), judging.len());
    assert!(made.iter().all(|a| judging.iter().all(|b| a.rotation != b.rotation)));
}

#[test]
fn runs_of_materials_are_told() {
    let (directory, path) = file(
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nf 1 3 4\nusemtl b\n\
         f 1 4 2\n",
    );
    fs::write(directory.path().join("m.mtl"), "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n").unwrap();
    let model = Model::load(&path, &Options::default()).unwrap();
    let mut arcs = Arcs::new(3);
    arcs.add(0, 2, 0);
    arcs.add(2, 1, 0);
    let order = FixedOrder::new(&model, &arcs, None).unwrap();
    assert!(order.reason().contains("in 3 runs of 2 materials"), "{}", order.reason());
    let ordered = order.applied(model);
    let runs: Vec<u32> = ordered.materials.iter().map(|run| run.triangle_count).collect();
    assert_eq!(runs, [1, 1, 1]);
}
