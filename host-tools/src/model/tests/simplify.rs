//! Fewer triangles: what stays, what is told, and what is refused.

use std::collections::HashMap;

use super::{
    super::{Fit, ModelError, Options},
    Model, indices, load, load_files,
};

fn at_most(most: usize) -> Options {
    Options { simplify: Some(most), ..Options::default() }
}

/// A ball with its materials.
fn load_ball(text: &str, options: &Options) -> Model {
    let library = b"newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n";
    load_files(&[("m.obj", text.as_bytes()), ("m.mtl", library)], options).unwrap()
}

/// A ball of `rows` x `columns` quads, triangles at its poles, with material `b` below the equator.
fn ball(rows: usize, columns: usize) -> String {
    let mut text = "mtllib m.mtl\nv 0 1 0\nv 0 -1 0\n".to_owned();
    for row in 1..rows {
        let (height, across) = (row as f64 / rows as f64 * std::f64::consts::PI).sin_cos();
        for column in 0..columns {
            let (s, c) = (column as f64 / columns as f64 * std::f64::consts::TAU).sin_cos();
            text += &format!("v {} {} {}\n", height * s, across, height * c);
        }
    }
    let ring = |row: usize, column: usize| 3 + (row - 1) * columns + column % columns;
    text += "usemtl a\n";
    for row in 0..rows {
        if row == rows / 2 {
            text += "usemtl b\n";
        }
        for c in 0..columns {
            text += &match row {
                0 => format!("f 1 {} {}\n", ring(1, c), ring(1, c + 1)),
                _ if row == rows - 1 => format!("f 2 {} {}\n", ring(row, c + 1), ring(row, c)),
                _ => {
                    let [a, b] = [c, c + 1].map(|c| ring(row, c));
                    let [d, e] = [c + 1, c].map(|c| ring(row + 1, c));
                    format!("f {a} {e} {d} {b}\n")
                }
            };
        }
    }
    text
}

/// The places of a triangle's corners in the tables.
type Corners = [[i16; 3]; 3];

fn places(model: &Model) -> Vec<Corners> {
    indices(model).iter().map(|t| t.map(|vertex| model.positions[vertex])).collect()
}

/// How often each edge is run through: by direction.
fn edges(triangles: &[Corners]) -> HashMap<[[i16; 3]; 2], i32> {
    let mut edges = HashMap::new();
    for corners in triangles {
        for i in 0..3 {
            *edges.entry([corners[i], corners[(i + 1) % 3]]).or_default() += 1;
        }
    }
    edges
}

fn is_closed(model: &Model) -> bool {
    let edges = edges(&places(model));
    edges.iter().all(|(&[from, to], &count)| count == 1 && edges.get(&[to, from]) == Some(&1))
}

#[test]
fn a_ball_stays_a_closed_ball_of_its_size_and_place() {
    let text = ball(24, 36);
    let whole = load_ball(&text, &Options::default());
    assert_eq!((whole.report.triangles, whole.report.simplification), (1_656, None));
    let mut errors = Vec::new();
    for most in [800, 160] {
        let model = load_ball(&text, &at_most(most));
        let found = model.report.simplification.unwrap();
        assert!((most * 9 / 10..=most).contains(&model.report.triangles), "{}", model.report);
        assert_eq!((found.triangles_before, model.report.file_faces), (1_656, 24 * 36));
        assert_eq!((&model.warnings, model.report.dropped_triangles), (&whole.warnings, 0));
        assert!(is_closed(&model));
        // Every vertex is one of the file: the unit fit is that of the whole model.
        for place in &model.exact.positions {
            assert!(whole.exact.positions.contains(place), "{place:?}");
        }
        // The longest chord between them: a triangle's middle lies that far inside the ball.
        let depths = places(&model).into_iter().map(|corners| {
            let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
            let mean = [0, 1, 2]
                .map(|i| corners.iter().map(|c| step * f64::from(c[i])).sum::<f64>() / 3.0);
            1.0 - mean.iter().map(|c| c * c).sum::<f64>().sqrt()
        });
        let deepest = depths.fold(0.0, f64::max);
        assert!(
            found.distance_max > 0.5 * deepest && found.distance_max < 2.0 * deepest,
            "{found:?} {deepest}"
        );
        assert!(found.distance_rms < found.distance_max && found.distance_rms > 0.0);
        assert!((found.size - 12f64.sqrt()).abs() < 1e-12, "{found:?}");
        errors.push(found.distance_max);
    }
    assert!(errors[0] < 0.02 && errors[1] < 0.12 && errors[1] > 2.0 * errors[0], "{errors:?}");
}

#[test]
fn borders_of_materials_and_winding_stay() {
    let text = ball(24, 36);
    let model = load_ball(&text, &at_most(300));
    assert_eq!(model.materials.len(), 2);
    let upper = model.materials[0].triangle_count as usize;
    // The border is the equator, whose height is rounded to a few quanta.
    for (number, corners) in places(&model).into_iter().enumerate() {
        let is_upper = number < upper;
        for [_, y, _] in corners {
            assert!(if is_upper { y >= -4 } else { y <= 4 }, "{corners:?} of {upper}");
        }
        let [a, b, c] = corners.map(|corner| corner.map(f64::from));
        let volume = super::dot(a, super::cross(b, c));
        assert!(volume > 0.0, "{corners:?} shows its back");
    }
}

/// A flat square of `side` x `side` quads with its texture coordinates.
fn sheet(side: usize) -> String {
    let mut text = String::new();
    for row in 0..=side {
        for column in 0..=side {
            let [x, y] = [column, row].map(|c| c as f64 / side as f64);
            text += &format!("v {x} {y} 0\nvt {x} {y}\n");
        }
    }
    for row in 0..side {
        for column in 0..side {
            let corner = |x: usize, y: usize| {
                let number = 1 + (row + y) * (side + 1) + column + x;
                format!("{number}/{number}")
            };
            text +=
                &format!("f {} {} {} {}\n", corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
        }
    }
    text
}

#[test]
fn a_flat_sheet_keeps_its_border_and_its_texture() {
    let mut options = at_most(2);
    options.contents.texture_coordinates = true;
    options.fit = Fit::Keep;
    let model = load(&sheet(12), &options).unwrap();
    assert_eq!((model.report.triangles, model.report.vertices), (2, 4));
    // Nothing of it moves but by rounding.
    let found = model.report.simplification.unwrap();
    assert!(found.distance_max < 1e-12, "{found:?}");
    for (place, texture) in model.exact.positions.iter().zip(&model.exact.texture_coordinates) {
        let [x, y, _] = *place;
        assert!([x, y].iter().all(|&c| c == 0.0 || c == 1.0), "{place:?}");
        assert_eq!(*texture, [x, 1.0 - y]);
    }
}

/// A cube of six such sheets: its edges are sharp.
#[test]
fn sharp_edges_stay_sharp() {
    let mut text = String::new();
    let side = 6;
    let mut before = 0;
    for face in 0..6 {
        for i in 0..(side + 1) * (side + 1) {
            let [u, v] = [i % (side + 1), i / (side + 1)]
                .map(|c| f64::from(c) * 2.0 / f64::from(side) - 1.0);
            let [x, y, z] = match face {
                0 => [u, v, 1.0],
                1 => [-u, v, -1.0],
                2 => [1.0, v, -u],
                3 => [-1.0, v, u],
                4 => [u, 1.0, -v],
                _ => [u, -1.0, v],
            };
            text += &format!("v {x} {y} {z}\n");
        }
        for i in 0..side * side {
            let first = before + 1 + i % side + i / side * (side + 1);
            text +=
                &format!("f {} {} {} {}\n", first, first + 1, first + side + 2, first + side + 1);
        }
        before += (side + 1) * (side + 1);
    }
    let model = load(&text, &at_most(12)).unwrap();
    assert_eq!((model.report.triangles, model.report.vertices), (12, 24));
    for normal in &model.vertex_normals {
        let mut normal = normal.map(i8::abs);
        normal.sort_unstable();
        assert_eq!(normal, [0, 0, 127]);
    }
    assert!(model.report.simplification.unwrap().distance_max < 1e-12);
}

#[test]
fn what_has_few_triangles_stays_as_it_is() {
    let text = ball(6, 8);
    let whole = load_ball(&text, &Options::default());
    let mut same = load_ball(&text, &at_most(whole.report.triangles));
    (same.options, same.inputs) = (whole.options.clone(), whole.inputs.clone());
    assert_eq!(same, whole);
}

#[test]
fn a_number_out_of_reach_is_refused_with_the_least() {
    // A cube of six materials: each corner is on three borders.
    let mut library = String::new();
    let mut text =
        "mtllib m.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\n\
                    v 1 1 1\nv -1 1 1\n"
            .to_owned();
    let faces = ["1 4 3 2", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8"];
    for (number, face) in faces.iter().enumerate() {
        library += &format!("newmtl m{number}\nKd 0.{number} 0 0\n");
        text += &format!("usemtl m{number}\nf {face}\n");
    }
    let load = |most| {
        let files = [("m.obj", text.as_bytes()), ("m.mtl", library.as_bytes())];
        load_files(&files, &at_most(most))
    };
    assert_eq!(load(12).unwrap().materials.len(), 6);
    let error = load(11).unwrap_err();
    assert!(matches!(error, ModelError::TooFewTriangles { most: 11, least: 12, .. }), "{error}");
    let message = error.to_string();
    assert!(message.contains("cannot be simplified to 11 triangles: 12 are"), "{message}");
}

#[test]
fn parts_that_vanish_are_told() {
    let parts: String = (0..5)
        .map(|part| {
            let corner = |x: i32, y: i32, z: i32| format!("v {} {y} {z}\n", x + 3 * part);
            let first = 4 * part + 1;
            let face =
                |[a, b, c]: [i32; 3]| format!("f {} {} {}\n", first + a, first + b, first + c);
            let corners =
                [corner(0, 0, 0), corner(1, 0, 0), corner(0, 1, 0), corner(0, 0, 1)].concat();
            corners + &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(face).concat()
        })
        .collect();
    let warnings = |most| load(&parts, &at_most(most)).unwrap().warnings;
    assert_eq!(warnings(20), [""; 0]);
    let told = warnings(3);
    assert!(told.len() == 1 && told[0].contains(" of 5 separate parts vanish"), "{told:?}");
}
