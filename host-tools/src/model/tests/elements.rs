//! Lines and points from a file to its tables.

use super::{load, load_files, *};

/// The ends of lines by their places, in the tables' order, for each material.
fn lines(model: &Model) -> Vec<Vec<[[f64; 3]; 2]>> {
    let place = |vertex: u32| model.exact.positions[vertex as usize];
    let of_material = |lines: &Vec<[u32; 2]>| lines.iter().map(|line| line.map(place)).collect();
    model.lines.iter().map(of_material).collect()
}

fn points(model: &Model) -> Vec<Vec<[f64; 3]>> {
    let place = |vertex: &u32| model.exact.positions[*vertex as usize];
    model.points.iter().map(|points| points.iter().map(place).collect()).collect()
}

fn kept() -> Options {
    Options { fit: Fit::Keep, ..Options::default() }
}

const A: [f64; 3] = [0.0, 0.0, 0.0];
const B: [f64; 3] = [1.0, 0.0, 0.0];
const C: [f64; 3] = [0.0, 1.0, 0.0];
const D: [f64; 3] = [3.0, 1.0, 2.0];
const PLACES: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 1 2\n";

/// Each line once, whichever way it runs and in the material that comes first; its materials come
/// after those of faces.
#[test]
fn lines_are_between_vertices_of_the_mesh() {
    let obj = format!(
        "mtllib m.mtl\n{PLACES}v 1 0 0\nvt 0 0\nl 1/1 2/1 3 1\nusemtl red\nl 2 4\nl 5 1\n\
         usemtl blue\nf 1 2 3\nl -2 4 4\n"
    );
    let mtl = "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
    let files = [("m.obj", obj.as_bytes()), ("m.mtl", mtl.as_bytes())];
    let model = load_files(&files, &kept()).unwrap();
    assert_eq!(model.warnings, [""; 0]);
    let colors: Vec<_> = model.materials.iter().map(|m| (m.color, m.triangle_count)).collect();
    assert_eq!(colors, [([0, 0, 255], 1), ([200; 3], 0), ([255, 0, 0], 0)]);
    assert_eq!(lines(&model), [vec![], vec![[A, B], [B, C], [C, A]], vec![[B, D]]]);
    assert_eq!(model.points, [[0u32; 0]; 0]);
    // The place of D is the only one that no face has.
    assert_eq!((model.positions.len(), model.report.lines), (4, 4));
    assert_eq!((model.vertex_normals[3], model.mesh().triangle_count()), ([0; 3], 1));
    assert_eq!(model.report.flash.lines, 8);
    let source = emit::source(&model);
    for part in [
        "/// 4 lines of [`M`]: a table for each material.",
        "pub static M_LINES: [::rasterizer::mesh::Lines<'static>; 3] = {",
        "    static LINES_1: [[u8; 2]; 3] = [\n",
        "        Lines::new_const(&M, Segments::U8(&[])),\n",
        "        Lines::new_const(&M, Segments::U8(&LINES_1)),\n",
        "// Lines: 4\n",
    ] {
        assert!(source.contains(part), "{part}{source}");
    }
    assert!(!source.contains("POINTS"), "{source}");
}

/// Without faces there is a mesh of vertices, as large as its lines and points.
#[test]
fn a_file_of_lines_or_points_is_a_model() {
    let model = load(&format!("{PLACES}v 9 9 9\nl 1 2 3\n"), &Options::default()).unwrap();
    assert_eq!(model.warnings, [""; 0]);
    let mesh = model.mesh();
    assert_eq!((mesh.vertex_count(), mesh.triangle_count()), (3, 0));
    // The unit sphere is about the lines: the vertex of neither is left out.
    assert_eq!(mesh.bounds().max[0], i16::MAX);
    assert_eq!((model.report.cache_misses, model.report.points), (0.0, 0));
    assert!(!emit::source(&model).contains("TRIANGLES"));

    let model = load(&format!("{PLACES}p 3 4\np 1 -2\n"), &kept()).unwrap();
    assert_eq!(points(&model), [[C, D, A]]);
    assert_eq!(model.mesh().vertex_count(), 3);
    let source = emit::source(&model);
    for part in [
        "/// 3 points of [`M`]: a table for each material.",
        "    static POINTS_0: [u8; 3] = [\n        0, 1, 2,\n    ];\n",
        "        Points::new_const(&M, PointIndices::U8(&POINTS_0)),\n",
    ] {
        assert!(source.contains(part), "{part}{source}");
    }
}

/// A place where colours meet has a vertex for each; a vertex without a colour has that of the
/// material.
#[test]
fn lines_have_the_colors_of_their_vertices() {
    let obj =
        "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nv 0 0 0 0 0 1\nf 1 2 3\nl 4 2\nl 3 2\np 4 1\n";
    let model = load(obj, &kept()).unwrap();
    let color = |vertex: u32| model.vertex_colors[vertex as usize];
    let ends: Vec<_> = model.lines[0].iter().map(|line| line.map(color)).collect();
    assert_eq!(ends, [[[0, 0, 255], [0, 255, 0]], [[200; 3], [0, 255, 0]]]);
    // The first of two points at a place.
    assert_eq!(model.points[0].iter().map(|&v| color(v)).collect::<Vec<_>>(), [[0, 0, 255]]);
    assert_eq!(model.vertex_colors.len(), 4);
}

#[test]
fn vertices_of_lines_count_as_used() {
    let fault = |text: &str| load(text, &Options::default()).unwrap_err().to_string();
    assert!(fault("v 1 1 1\nv 1 1 1\nl 1 2\np 1\n").contains("has no size"));
    assert!(fault("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").contains("zero area"));
    let model = load("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nl 1 2\n", &Options::default()).unwrap();
    assert_eq!((model.report.triangles, model.report.dropped_triangles), (0, 1));
    let many: String = (0..65_537).map(|i| format!("v {i} 0 0\np -1\n")).collect();
    assert!(fault(&many).contains("needs 65537 vertices"));
}
