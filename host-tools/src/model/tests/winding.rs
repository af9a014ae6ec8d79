//! Inside-out models and mixed windings: told, and mended.

use super::{
    super::{Options, vector::sub},
    Model, cross, dot, indices, load,
};

const CORNERS: [[i32; 3]; 8] = [
    [-1, -1, -1],
    [1, -1, -1],
    [1, 1, -1],
    [-1, 1, -1],
    [-1, -1, 1],
    [1, -1, 1],
    [1, 1, 1],
    [-1, 1, 1],
];
const FACES: [[usize; 4]; 6] =
    [[1, 4, 3, 2], [5, 6, 7, 8], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [4, 1, 5, 8]];

/// A cube of half-side `size` about (x, 0, 0), whose faces in `turned` show their backs. `before`
/// is the number of vertices ahead of it.
fn cube(before: usize, x: i32, size: i32, turned: &[usize]) -> String {
    let corner = |[a, b, c]: [i32; 3]| format!("v {} {} {}\n", x + size * a, size * b, size * c);
    let mut text: String = CORNERS.into_iter().map(corner).collect();
    for (index, mut face) in FACES.into_iter().enumerate() {
        if turned.contains(&index) {
            face.reverse();
        }
        let [a, b, c, d] = face.map(|i| i + before);
        text += &format!("f {a} {b} {c} {d}\n");
    }
    text
}

const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn mended(text: &str) -> Model {
    load(text, &Options { fix_winding: true, ..Options::default() }).unwrap()
}

fn warnings(text: &str) -> Vec<String> {
    load(text, &Options::default()).unwrap().warnings
}

/// Six times the signed volume in model units.
fn volume(model: &Model) -> f64 {
    let shape = &model.exact.positions;
    indices(model).iter().map(|&[a, b, c]| dot(shape[a], cross(shape[b], shape[c]))).sum()
}

#[test]
fn inside_out_and_mixed_cubes_become_the_plain_one() {
    let plain = load(&cube(0, 0, 1, &[]), &Options::default()).unwrap();
    assert_eq!(plain.warnings, [""; 0]);
    // A cube in a sphere of radius 1 has a volume of 8 / 3^1.5.
    assert!((volume(&plain) - 48.0 / 27_f64.sqrt()).abs() < 1e-12);
    for (turned, told) in [
        (&ALL[..], "1 closed part of 6 faces are inside out"),
        (&[3], "1 face runs against neighbours (4 edges are run through"),
        (&[0, 1, 2, 3, 5], "5 faces run against neighbours (4 edges are run through"),
        (&[0, 2], "2 faces run against neighbours (6 edges are run through"),
    ] {
        let text = cube(0, 0, 1, turned);
        let found = warnings(&text);
        assert!(found.len() == 1 && found[0].contains(told), "{turned:?}: {found:?}");
        assert!(found[0].contains("--fix-winding"), "{found:?}");
        let model = mended(&text);
        assert_eq!((model.warnings.len(), model.report.turned_faces), (0, turned.len()));
        assert!((volume(&model) - volume(&plain)).abs() < 1e-12, "{turned:?}");
        let shape = &model.exact.positions;
        for ([a, b, c], normal) in indices(&model).into_iter().zip(&model.exact.face_normals) {
            assert!(dot(cross(sub(shape[b], shape[a]), sub(shape[c], shape[a])), shape[a]) > 0.0);
            assert!(dot(*normal, shape[a]) > 0.0, "{turned:?}");
        }
    }
}

#[test]
fn each_part_is_judged_alone() {
    let two = cube(0, 0, 1, &[]) + &cube(8, 5, 1, &ALL);
    let found = warnings(&two);
    assert!(found.len() == 1 && found[0].contains("1 closed part of 6 faces"), "{found:?}");
    assert_eq!(mended(&two).report.turned_faces, 6);
    // The inner wall of a hollow cube shows its outside to the hollow.
    let hollow = cube(0, 0, 2, &[]) + &cube(8, 0, 1, &ALL);
    assert_eq!(warnings(&hollow), [""; 0]);
    assert_eq!(mended(&hollow).report.turned_faces, 0);
}

#[test]
fn open_surfaces_follow_their_normals_or_the_majority() {
    let grid = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\nvn 0 0 1\n";
    let majority = format!("{grid}f 1 2 6 5\nf 2 6 7 3\nf 3 4 8 7\n");
    let model = mended(&majority);
    assert_eq!(model.report.turned_faces, 1);
    assert!(model.face_normals.iter().all(|&n| n == [0, 0, 127]), "{:?}", model.face_normals);
    // Two of three faces run against their normals.
    let normals =
        format!("{grid}f 1//1 2//1 6//1 5//1\nf 2//1 6//1 7//1 3//1\nf 3//1 7//1 8//1 4//1\n");
    let model = mended(&normals);
    assert_eq!(model.report.turned_faces, 2);
    assert!(model.face_normals.iter().all(|&n| n == [0, 0, 127]), "{:?}", model.face_normals);
    // An open surface shows whichever side it was made with.
    assert_eq!(warnings(&format!("{grid}f 5 6 2 1\nf 6 7 3 2\n")), [""; 0]);
}

#[test]
fn a_moebius_strip_cannot_be_mended() {
    let n = 12;
    let mut text = String::new();
    for i in 0..n {
        let turn = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (turn / 2.0).cos();
            let z = side * (turn / 2.0).sin();
            text += &format!("v {} {} {z}\n", r * turn.cos(), r * turn.sin());
        }
    }
    for i in 0..n {
        let (a, b) = (2 * i + 1, 2 * i + 2);
        let (c, d) = if i + 1 < n { (a + 2, b + 2) } else { (2, 1) };
        text += &format!("f {a} {c} {d} {b}\n");
    }
    for found in [warnings(&text), mended(&text).warnings] {
        assert!(found.len() == 1 && found[0].contains("1 part has one side only"), "{found:?}");
    }
    assert_eq!(mended(&text).report.turned_faces, 0);
}
