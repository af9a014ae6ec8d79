//! Colours of vertices from a file to its tables.

use super::{load, load_files, reading::one_warning, *};

/// A square of two triangles, whose lower corners are red and green.
const SQUARE: &str = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0.2 0.4 0.6\nv 0 1 0 1 1 1\n\
                      f 1 2 3\nf 1 3 4\n";

/// The colour of each corner of each triangle, by its position.
fn by_place(model: &Model) -> Vec<([f64; 3], [u8; 3])> {
    let corners = indices(model).concat();
    let place = |&vertex: &usize| {
        let place = model.exact.positions[vertex];
        (place, model.vertex_colors[vertex])
    };
    let mut all: Vec<_> = corners.iter().map(place).collect();
    all.sort_by(|a, b| a.partial_cmp(b).unwrap());
    all.dedup();
    all
}

fn kept() -> Options {
    Options { fit: Fit::Keep, ..Options::default() }
}

#[test]
fn every_vertex_has_its_color() {
    let model = load(SQUARE, &kept()).unwrap();
    assert_eq!(model.warnings, [""; 0]);
    assert_eq!(
        by_place(&model),
        [
            ([0.0, 0.0, 0.0], [255, 0, 0]),
            ([0.0, 1.0, 0.0], [255, 255, 255]),
            ([1.0, 0.0, 0.0], [0, 255, 0]),
            ([1.0, 1.0, 0.0], [51, 102, 153]),
        ]
    );
    assert_eq!(model.mesh().tables().vertex_colors, model.vertex_colors);
    assert_eq!(model.report.flash.vertex_colors, 4 * 3);
    let corners = &model.exact.faces.vertex_colors;
    let [red, green, blue] = corners[2];
    assert_eq!(corners.len(), 6);
    assert!((red - 51.0).abs() + (green - 102.0).abs() + (blue - 153.0).abs() < 1e-9);
}

#[test]
fn vertices_split_where_colors_differ_in_the_tables() {
    // Three times the same place: red, a red that is rounded to it, and blue.
    let text = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 0 0.999 0 0\nv 0 0 0 0 0 1\n\
                v -1 0 0 1 0 0\nv 0 -1 0 1 0 0\nf 1 2 3\nf 4 3 6\nf 5 6 7\n";
    let model = load(text, &kept()).unwrap();
    assert_eq!((model.positions.len(), by_place(&model).len()), (6, 6));
    let contents = Contents { vertex_colors: false, ..Contents::default() };
    let model = load(text, &Options { contents, ..kept() }).unwrap();
    assert_eq!((model.positions.len(), model.vertex_colors.len()), (5, 0));
    assert!(model.exact.faces.vertex_colors.is_empty());
}

#[test]
fn vertices_without_a_color_have_that_of_their_material() {
    let text = "mtllib cube.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0 0 1 0\nv -1 0 0\nusemtl blue\nf 1 2 3\n\
                usemtl red\nf 1 3 4\n";
    let files: [(&str, &[u8]); 2] = [("m.obj", text.as_bytes()), ("cube.mtl", CUBE_MTL.as_bytes())];
    let model = load_files(&files, &kept()).unwrap();
    one_warning(&model, &["m.obj:2: 3 vertices have no colour"]);
    assert_eq!(
        by_place(&model),
        [
            ([-1.0, 0.0, 0.0], [128, 0, 0]),
            ([0.0, 0.0, 0.0], [0, 0, 255]),
            ([0.0, 0.0, 0.0], [128, 0, 0]),
            ([0.0, 1.0, 0.0], [0, 255, 0]),
            ([1.0, 0.0, 0.0], [0, 0, 255]),
        ]
    );
}

/// Colours of vertices that no face uses make no table.
#[test]
fn only_colors_of_faces_are_kept() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 5 5 5 1 0 0\n";
    let model = load(text, &kept()).unwrap();
    assert!(model.vertex_colors.is_empty() && model.exact.faces.vertex_colors.is_empty());
}

#[test]
fn only_files_with_colors_have_their_table() {
    let plain: String = SQUARE
        .lines()
        .map(|line| line.split(' ').take(4).collect::<Vec<_>>().join(" ") + "\n")
        .collect();
    let (with, without) = (load(SQUARE, &kept()).unwrap(), load(&plain, &kept()).unwrap());
    let (with, without) = (emit::source(&with), emit::source(&without));
    assert!(!without.contains("olor:") && !without.contains("vertex_colors"), "{without}");
    // The lines that a table of colours adds.
    let added: Vec<&str> =
        with.lines().filter(|line| !without.contains(line) && !line.starts_with("//")).collect();
    assert_eq!(
        added,
        [
            "    static VERTEX_COLORS: [[u8; 3]; 4] = [",
            "        [255, 0, 0], [0, 255, 0], [51, 102, 153], [255, 255, 255],",
            "        vertex_colors: &VERTEX_COLORS,",
        ]
    );
}
