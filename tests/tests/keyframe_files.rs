//! OBJ files of one model in several shapes: their tables against the files' own numbers, which
//! vertices are one, and what is refused.

use std::{collections::HashSet, path::Path};

use host_tools::model::{Contents, Fit, Model, ModelError, Options, emit};
use rasterizer::mesh::{Keyframes, Progress};

const A: &str = "a.obj";
const B: &str = "b.obj";

fn options() -> Options {
    Options { fit: Fit::Keep, ..Options::default() }
}

fn convert(first: &str, further: &[&str], options: &Options) -> Result<Model, ModelError> {
    let further: Vec<_> = further.iter().map(|text| (Path::new(B), text.as_bytes())).collect();
    Model::keyframes_from_bytes((Path::new(A), first.as_bytes()), &further, options)
}

/// A closed body of 8 vertices, and further places of them.
const FACES: &str = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const CUBE: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

fn file(vertices: &[[f64; 3]]) -> String {
    let lines = vertices.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
    lines.chain([FACES.to_owned()]).collect()
}

fn moved(by: f64) -> Vec<[f64; 3]> {
    CUBE.iter().map(|[x, y, z]| [x * (2.0 + z), y * 1.5 + 3.0 * by, z - by * x]).collect()
}

/// Each vertex of the tables has in each shape the place of one and the same vertex of the files,
/// within half a quantum; triangles are those of the files' faces, and normals those of each shape.
#[test]
fn shapes_share_triangles_scale_and_offset() {
    let files = [CUBE.to_vec(), moved(0.0), moved(5.0)];
    let [first, second, third] = files.each_ref().map(|vertices| file(vertices));
    let model = convert(&first, &[&second, &third], &options()).unwrap();
    let (mesh, further) = (model.mesh(), model.further_shapes());
    let keyframes = Keyframes::new(&mesh, &further).unwrap();
    assert_eq!(keyframes.count(), 3);
    let quantum = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
    let offset = model.offset.to_bits().map(|c| f64::from(c) / 65_536.0);
    let place =
        |position: [i16; 3]| [0, 1, 2].map(|i| offset[i] + quantum * f64::from(position[i]));
    let mut found = HashSet::new();
    for vertex in 0..mesh.vertex_count() {
        let is_at = |file: usize, number: usize| {
            let tween = keyframes.between(file, file, Progress::ZERO).unwrap();
            let got = place(tween.position(vertex).unwrap());
            (0..3).all(|i| (got[i] - files[file][number][i]).abs() <= quantum * 0.500_001)
        };
        let number = (0..8).find(|&number| (0..3).all(|file| is_at(file, number)));
        found.insert(number.unwrap_or_else(|| panic!("vertex {vertex} is nowhere")));
    }
    assert_eq!(found.len(), 8);
    // The largest coordinate of all shapes is the largest of the format.
    let largest = further.iter().flat_map(|shape| (0..).map_while(|i| shape.positions.get(i)));
    assert_eq!(largest.flatten().map(|c| c.unsigned_abs()).max(), Some(32_767));
    let bounds = keyframes.mesh().bounds();
    assert!(bounds.max.iter().chain(&bounds.min).any(|c| c.unsigned_abs() == 32_767));

    for shape in &model.keyframes {
        for (index, normal) in shape.exact_face_normals.iter().enumerate() {
            let corners = mesh.tables().triangles.get(index).unwrap();
            let [a, b, c] = corners.map(|corner| shape.exact_positions[corner]);
            let [u, v] = [b, c].map(|p| [0, 1, 2].map(|i| p[i] - a[i]));
            for side in [u, v] {
                let along: f64 = (0..3).map(|i| side[i] * normal[i]).sum();
                assert!(along.abs() < 1e-9, "{along}");
            }
        }
    }
    let source = emit::source(&model);
    assert!(source.contains("pub static A_KEYFRAMES: ::rasterizer::mesh::Keyframes<'static>"));
    assert!(source.contains("// From `b.obj`"), "{source}");
    assert_eq!(source.matches("static POSITIONS_").count(), 2);
    // One alone is converted as before.
    let alone = convert(&first, &[], &options()).unwrap();
    assert!(!emit::source(&alone).contains("KEYFRAMES"));
    assert_eq!(alone, Model::from_bytes(Path::new(A), first.as_bytes(), &options()).unwrap());
}

/// Two triangles with a side in common, whose ends are in the file twice.
#[test]
fn vertices_are_one_only_if_they_agree_in_all_files() {
    let strip = |apart: f64, lift: f64| {
        format!(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv {apart} 0 0\nv 1 1 0\nv 0 1 {lift}\nf 1 2 3\nf 4 5 6\n"
        )
    };
    let contents = Contents { vertex_normals: false, ..Contents::default() };
    let plain = Options { contents, ..options() };
    let count = |options: &Options, first: &str, further: &[&str]| {
        convert(first, further, options).unwrap().positions.len()
    };
    let together = strip(0.0, 0.0);
    assert_eq!(count(&plain, &together, &[&together]), 4);
    assert_eq!(count(&plain, &together, &[&strip(0.5, 0.0)]), 5);
    assert_eq!(count(&plain, &strip(0.5, 0.0), &[&together]), 5);
    assert_eq!(count(&plain, &together, &[&together, &strip(0.5, 0.0)]), 5);
    // Normals are smooth in both files, or have a crease in one of them.
    assert_eq!(count(&options(), &together, &[&strip(0.0, 0.1)]), 4);
    for (first, second) in [(0.0, 9.0), (9.0, 0.0)] {
        assert_eq!(count(&options(), &strip(0.0, first), &[&strip(0.0, second)]), 6);
    }
}

/// What has no area in one shape, and some in another, is drawn between them.
#[test]
fn faces_may_grow_out_of_a_line() {
    let square = |side: f64| {
        format!("v 0 0 0\nv 1 0 0\nv 1 {side} 0\nv 0 {side} 0\nv 0 0 2\nf 1 2 3 4\nf 1 2 5\n")
    };
    for (first, second) in [(0.0, 1.0), (1.0, 0.0)] {
        let model = convert(&square(first), &[&square(second)], &options()).unwrap();
        assert_eq!(model.report.triangles, 3);
        assert_eq!(model.report.dropped_triangles, 0);
        for normal in model.face_normals.iter().chain(&model.keyframes[0].face_normals) {
            assert!(normal == &[0, 0, 127] || normal == &[0, -127, 0], "{normal:?}");
        }
    }
    assert_eq!(convert(&square(0.0), &[&square(0.0)], &options()).unwrap().report.triangles, 1);
}

#[test]
fn the_first_difference_is_named_with_its_lines() {
    let first = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nvt 0 0\nvt 0.5 1\nusemtl red\nf 1/1 2/1 3/2\n\
                 usemtl blue\nf 2 4 3\nl 1 2\n";
    let refused = |from: &str, to: &str| {
        let second = first.replacen(from, to, 1);
        assert_ne!(first, second, "{from}");
        convert(first, &[first, &second], &options()).map(|_| ()).unwrap_err().to_string()
    };
    let plain = Options { textures: None, ..options() };
    assert!(convert(first, &[&first.replace("v 1 1 1", "v 1 1 7")], &plain).is_ok());
    for (from, to, message) in [
        (
            "f 2 4 3",
            "f 2 3 4",
            "b.obj:10: corner 2 of the face is vertex 3 and not 4 as at a.obj:10",
        ),
        ("f 2 4 3", "f 2 4 3 1", "b.obj:10: the face has 4 corners and not 3 as at a.obj:10"),
        ("f 2 4 3\n", "f 2 4 3\nf 1 2 3\n", "b.obj:11: there are 3 faces and not 2 as at a.obj:10"),
        ("f 2 4 3\n", "\n", "b.obj:8: there are 1 faces and not 2 as at a.obj:10"),
        (
            "vt 0.5 1",
            "vt 0.5 0.25",
            "b.obj:8: corner 3 of the face has texture coordinates \
         (0.5, 0.25) and not (0.5, 1) as at a.obj:8",
        ),
        (
            "1/1 2/1",
            "1/1 2",
            "b.obj:8: corner 2 of the face has texture coordinates none and not \
         (0, 0) as at a.obj:8",
        ),
        (
            "usemtl blue",
            "usemtl green",
            "b.obj:10: material `green` and not material `blue` as at \
         a.obj:10",
        ),
        ("usemtl red\n", "\n", "b.obj:8: no material and not material `red` as at a.obj:8"),
        ("l 1 2", "l 1 3", "b.obj:10: lines (`l`) or points (`p`) are not those at a.obj:10"),
        ("l 1 2", "usemtl grey\nl 1 2", "b.obj:10: lines (`l`) or points"),
        ("l 1 2\n", "l 1 2\nusemtl grey\n", "b.obj:12: material `grey` and not no material as"),
    ] {
        let error = refused(from, to);
        assert!(error.starts_with(message), "{error}\n{message}");
        assert!(error.ends_with("export them from one model"), "{error}");
    }
    let broken = refused("v 1 1 1", "v 1 1 x");
    assert!(broken.starts_with("b.obj:4: `x` is not a number"), "{broken}");
}
