//! The whole way from files to tables.

use std::{env, fs, path::Path};

use super::{
    vector::{angle, cross, dot, length, sub},
    *,
};
use crate::reference::random::Random;

mod cutting;
mod elements;
mod large;
mod reading;
mod shipped;
mod simplify;
mod smoothing;
mod textures;
mod vertex_colors;
mod winding;

/// A cube of side 2 in quads, without normals; a third of its faces blue.
const CUBE: &str = "mtllib cube.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n\
                    v -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nusemtl red\nf 5 6 7 8\nf 2 1 4 3\n\
                    usemtl blue\nf 6 2 3 7\nf 1 5 8 4\nusemtl red\nf 8 7 3 4\nf 1 2 6 5\n";
const CUBE_MTL: &str = "newmtl unused\nKd 1 1 1\nnewmtl blue\nKd 0 0 1.5\nnewmtl red\nKd 0.5 0 0\n";

/// A square with texture coordinates, cut along a seam.
const SEAM: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt -1 1\n\
                    vt -0.5 -0.5\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n";

/// Writes files into a new directory and loads the first.
fn load_files(files: &[(&str, &[u8])], options: &Options) -> Result<Model, ModelError> {
    let directory = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(directory.path().join(name), bytes).unwrap();
    }
    Model::load(directory.path().join(files[0].0), options)
}

fn load(text: &str, options: &Options) -> Result<Model, ModelError> {
    load_files(&[("m.obj", text.as_bytes())], options)
}

fn cube(options: &Options) -> Model {
    load_files(&[("cube.obj", CUBE.as_bytes()), ("cube.mtl", CUBE_MTL.as_bytes())], options)
        .unwrap()
}

fn crease(crease_degrees: f64) -> Options {
    Options { crease_degrees, ..Options::default() }
}

fn textured() -> Options {
    Options {
        contents: Contents { texture_coordinates: true, ..Contents::default() },
        ..Options::default()
    }
}

fn indices(model: &Model) -> Vec<[usize; 3]> {
    let triangles = model.triangles.as_triangles();
    (0..triangles.len()).map(|i| triangles.get(i).unwrap()).collect()
}

#[test]
fn faces_stay_whole_with_their_lines_and_colors() {
    // A triangle without area at the end, which no table has, on two lines of the file.
    let text = format!("{CUBE}# end\nf 1 2 \\\n1\n");
    let model = load_files(
        &[("cube.obj", text.as_bytes()), ("cube.mtl", CUBE_MTL.as_bytes())],
        &Options::default(),
    )
    .unwrap();
    let faces = &model.exact.faces;
    let lines: Vec<usize> = faces.faces.iter().map(|face| face.line).collect();
    assert_eq!(lines, [11, 12, 14, 15, 17, 18, 20]);
    let colors: Vec<u8> = faces.faces.iter().map(|face| face.color[2]).collect();
    assert_eq!(colors, [0, 0, 255, 255, 0, 0, 0]);
    let sizes: Vec<usize> = faces.faces.iter().map(|face| face.corners.len()).collect();
    assert_eq!(sizes, [4, 4, 4, 4, 4, 4, 3]);
    // In the unit sphere as the tables are, and each vertex at its position, bit for bit.
    let third = 1.0 / 3f64.sqrt();
    let ring = faces.ring(&faces.faces[0]);
    for (p, want) in ring.iter().zip([[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]]) {
        let off = sub(*p, want.map(|c| f64::from(c) * third));
        assert!(length(off) < 1e-15, "{ring:?}");
    }
    for (&position, exact) in faces.vertices.iter().zip(&model.exact.positions) {
        assert_eq!(faces.positions[position as usize], *exact);
    }
}

#[test]
fn faults_of_files_say_what_to_do() {
    let message =
        |text: &[u8]| load_files(&[("m.obj", text)], &Options::default()).unwrap_err().to_string();
    for (text, expected) in [
        (&b""[..], "m.obj is empty: export"),
        (b"\n\n", "m.obj has no vertices"),
        (b"v 0 0 0\nv 1 0 0\n", "m.obj has vertices but no faces"),
        (b"v 0 0 0\nv \xFF 0 0", "m.obj:2: `\u{FFFD}` is not a number"),
        (b"v\0 \0", "m.obj is UTF-16 text: save it as UTF-8"),
        (b"v 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3", "m.obj:3: `v` needs 3 numbers"),
        (b"v 3 3 3\nv 3 3 3\nv 3 3 3\nf 1 2 3", "m.obj has no size"),
        (b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3", "m.obj: all 1 faces have zero area"),
    ] {
        assert!(message(text).contains(expected), "{}", message(text));
    }
    let directory = tempfile::tempdir().unwrap();
    let at = |path: &Path| Model::load(path, &Options::default()).unwrap_err().to_string();
    assert!(at(directory.path()).contains("is a directory: name the file in it"));
    let missing = at(&directory.path().join("no.obj"));
    assert!(missing.contains("no.obj: ") && missing.contains("check the path"), "{missing}");
    #[cfg(unix)]
    assert!(at(Path::new("/dev/zero")).contains("is not an ordinary file"));
}

#[test]
fn no_bytes_make_it_panic_or_hang() {
    const PIECES: [&str; 24] = [
        "v ",
        "vt ",
        "vn ",
        "f ",
        "usemtl ",
        "mtllib ",
        "\n",
        "\\\n",
        "\r",
        "\t",
        "#",
        "/",
        "-1",
        "0",
        "1",
        "4 ",
        "9999999 ",
        "1e308 ",
        "-1e308 ",
        "5e-324 ",
        "nan",
        "\u{e9}",
        "l 1 2 3\n",
        "f 1 2 3 4 3 2 1 4\n",
    ];
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    let mut generator = Random(1);
    let mut random = |below: usize| generator.snapped(0.0, (below - 1) as f64, 1.0) as usize;
    let (mut good, mut bad) = (0, 0);
    for round in 0..3_000 {
        let (text, options) = [(CUBE, Options::default()), (SEAM, textured())][round % 2].clone();
        let mut bytes = text.as_bytes().to_vec();
        for _ in 0..=random(6) {
            let place = random(bytes.len());
            match random(4) {
                0 => bytes[place] = random(256) as u8,
                1 => drop(bytes.drain(place..(place + random(9)).min(bytes.len()))),
                _ => drop(bytes.splice(place..place, PIECES[random(PIECES.len())].bytes())),
            }
        }
        fs::write(&path, &bytes).unwrap();
        let fit = [Fit::Unit, Fit::Keep][random(2)];
        match Model::load(&path, &Options { fit, ..options }) {
            Ok(model) => {
                assert!(emit::source(&model).len() > 100);
                assert_eq!(model.mesh().vertex_count(), model.exact.positions.len());
                good += 1;
            }
            Err(error) => {
                assert!(error.to_string().contains("m.obj"), "{error}");
                bad += 1;
            }
        }
    }
    assert!(good > 100 && bad > 100, "{good} good and {bad} bad files test only one way out");
}

#[test]
fn options_out_of_range_say_what_to_do() {
    for degrees in [-1.0, 180.1, f64::NAN] {
        let error = load(SEAM, &crease(degrees)).unwrap_err().to_string();
        assert!(error.contains("choose 0 (all edges hard)"), "{error}");
    }
    let error = load(CUBE, &textured()).unwrap_err().to_string();
    assert!(error.contains("has no texture coordinates"), "{error}");
}

#[test]
fn a_cube_has_hard_edges_at_60_degrees_and_none_at_180() {
    let hard = cube(&Options::default());
    assert_eq!((hard.positions.len(), indices(&hard).len()), (24, 12));
    for (&normal, &face) in hard.vertex_normals.iter().zip(&hard.exact.vertex_normals) {
        assert_eq!(normal.map(i32::from).map(i32::abs).iter().sum::<i32>(), 127, "{normal:?}");
        assert_eq!(normal.map(f64::from), face.map(|x| x * 127.0));
    }
    let smooth = cube(&crease(180.0));
    assert_eq!(smooth.positions.len(), 8);
    for (&normal, &position) in smooth.exact.vertex_normals.iter().zip(&smooth.exact.positions) {
        // Each corner's three faces have equal weights, however they are cut: the normal is the
        // diagonal.
        assert!(angle(normal, position) < 1e-12, "{normal:?} at {position:?}");
    }
    for model in [&hard, &smooth] {
        let shape = &model.exact.positions;
        for (triangle, &normal) in indices(model).iter().zip(&model.exact.face_normals) {
            let [a, b, c] = triangle.map(|v| shape[v]);
            assert!(dot(normal, a) > 0.0, "the faces look outwards");
            assert!(angle(cross(sub(b, a), sub(c, a)), normal) < 1e-12);
        }
    }
}

#[test]
fn materials_are_sorted_counted_and_dropped_if_unused() {
    let model = cube(&Options::default());
    assert_eq!(model.materials, [Material::new([128, 0, 0], 8), Material::new([0, 0, 255], 4)]);
    let blue = &model.exact.face_normals[8..];
    assert!(blue.iter().all(|n| n[0].abs() == 1.0), "{blue:?}");
    assert_eq!(model.warnings, [""; 0]);
    assert_eq!(model.inputs.len(), 2);

    let grey = load(CUBE, &Options::default()).unwrap();
    assert_eq!(grey.materials, [Material::new([200; 3], 12)]);
    assert!(grey.warnings[0].contains("cube.mtl: "), "{:?}", grey.warnings);
    assert!(grey.warnings[1].contains("m.obj:10: no material library gives `red`"));
}

#[test]
fn the_same_model_in_other_writing_is_the_same() {
    let plain = load(
        "v 0 0 0\nv 3 0 0\nv 0 4 0\nv 0 0 5\nf 1 3 2\nf 1 2 4\nf 2 3 4\n",
        &Options::default(),
    )
    .unwrap();
    let variants = [
        "# c\r\nv\t0 0 0\r\nv 3 0 0 1\r\nv 0 4 0\r\nv 0 0 5\r\no x\r\nmg 1\r\n\
         f 1 3 2\r\nf 1 2 4 \\\r\n\r\nf 2 3 \\\r\n4",
        "v 0 0 0\nv 3 0 0\nv 0 4 0\nf -3 -1 -2\nv 0 0 5\ng a b\nl 1 2 3 4\np 1\n\
         f -4 -3 -1\nf -3// -2// -1//",
        "f 1 3 2\nf 1 2 4\nf 2 3 4\nv 0e9 .0 -0\nv 3 0 0 # c\nv 0 4 0\nv +0 0 5.000\nv 9 9 9",
        "\u{feff}v 0 0 0\rv 3 0 0\rv 0 4 0\rv 0 0 5\rvn 0 0 0\rf 1//1 3//1 2//1\rf 1 2 4\rf 2 3 4",
    ];
    // The lines differ.
    let exact = |model: &Model| {
        let mut exact = model.exact.clone();
        exact.faces.faces.iter_mut().for_each(|face| face.line = 0);
        exact
    };
    for text in variants {
        let model = load(text, &Options::default()).unwrap();
        assert_eq!(model.positions, plain.positions, "{text:?}");
        assert_eq!(indices(&model), indices(&plain), "{text:?}");
        assert_eq!(model.vertex_normals, plain.vertex_normals, "{text:?}");
        assert_eq!(exact(&model), exact(&plain), "{text:?}");
    }
}

#[test]
fn seams_split_vertices_only_where_textures_are_kept() {
    assert_eq!(load(SEAM, &Options::default()).unwrap().positions.len(), 4);
    let model = load(SEAM, &textured()).unwrap();
    assert_eq!(model.positions.len(), 5);
    // The normals are still smooth across the seam.
    assert!(model.vertex_normals.iter().all(|&n| n == [0, 0, 127]));
    // v is turned, and 1 is 2^14 steps.
    let TextureTable::I16(table) = &model.texture_coordinates else { panic!("32 bits") };
    let top_right = table.iter().filter(|&&t| t == [16_384, 0]).count();
    assert_eq!(top_right, 1, "{table:?}");
    assert!(model.exact.texture_coordinates.contains(&[-0.5, 1.5]));
    assert_eq!(model.report.texture_error, 0.0);

    let partly = load(&SEAM.replace("4/4", "4"), &textured()).unwrap();
    assert!(partly.warnings[0].contains("1 of 6 face corners"), "{:?}", partly.warnings);
}

#[test]
fn fits_describe_the_same_shape() {
    let text = "v 10 0 0\nv 14 0 0\nv 14 3 0\nf 1 2 3\n";
    let unit = load(text, &Options::default()).unwrap();
    assert_eq!(unit.offset, Vec3::ZERO);
    assert!((unit.report.size - 2.0).abs() < 1e-15);
    let options = Options { fit: Fit::Keep, ..Options::default() };
    let kept = load(text, &options).unwrap();
    assert_eq!(kept.offset, Vec3::lit("12", "1.5", "0"));
    assert_eq!(kept.exact.positions[0], [10.0, 0.0, 0.0]);
    assert_eq!(kept.positions, unit.positions);
    assert_eq!(kept.positions[0], [-32_767, -24_575, 0]);
    assert!(kept.report.position_error_max < 3.0 / 65_534.0);
}

#[test]
fn too_many_vertices_are_counted() {
    // 257 by 257 squares, so 66,564 vertices.
    let vertices = (0..258 * 258).map(|i| format!("v {} {} 0\n", i % 258, i / 258));
    let faces = (0..257 * 257).map(|i| {
        let corner = i / 257 * 258 + i % 257 + 1;
        format!("f {corner} {} {} {}\n", corner + 1, corner + 259, corner + 258)
    });
    let text: String = vertices.chain(faces).collect();
    let error = load(&text, &Options::default()).unwrap_err().to_string();
    assert!(error.contains("needs 66564 vertices") && error.contains("split it"), "{error}");
}

#[test]
fn absent_tables_are_empty() {
    let options = Options {
        contents: Contents {
            vertex_normals: false,
            face_normals: false,
            texture_coordinates: false,
            vertex_colors: false,
        },
        ..Options::default()
    };
    let model = cube(&options);
    assert_eq!(model.positions.len(), 8);
    assert!(model.vertex_normals.is_empty() && model.face_normals.is_empty());
    assert!(model.exact.vertex_normals.is_empty() && model.exact.face_normals.is_empty());
    assert_eq!(model.mesh().triangle_count(), 12);
    assert_eq!(model.report.flash.total(), 8 * 6 + 12 * 3 + 2 * 8);
}

#[test]
fn indices_take_the_smallest_type_that_holds_them() {
    assert_eq!(Indices::new(&[[0, 1, 255]], 256), Indices::U8(vec![[0, 1, 255]]));
    assert_eq!(Indices::new(&[[0, 1, 256]], 257), Indices::U16(vec![[0, 1, 256]]));
    assert_eq!(Indices::new(&[[0, 1, 65_535]], 65_536), Indices::U16(vec![[0, 1, 65_535]]));
}

#[test]
fn emitted_source_of_a_small_model() {
    let options = Options { name: Some("tiny-part".into()), ..Options::default() };
    let model = load("v 0 0 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\n", &options).unwrap();
    assert_eq!(
        emit::source(&model),
        r#"// A model as const tables, written by host-tools VERSION: do not edit.
//
// From `m.obj`: 32 bytes, FNV-1a 67b8b7631609f322
// With unit fit, a crease angle of 60 degrees, contents: vertex normals, face normals
//
// Vertices: 3, in the file 3
// Triangles: 1, in the file 1 faces; left out as they have no area: 0
// Size (diagonal of the bounding box): 2.0000 units
// Position error: 6.10e-6 units at most (0.00031 % of the size), 6.10e-6 root mean square (0.00031 %)
// Normal error: 0.000 degrees at most
// Vertices transformed per triangle (cache of 16): 3.000, in the file's order 3.000
// Flash: 41 bytes
//   positions                   18
//   vertex_normals               9
//   face_normals                 3
//   texture_coordinates          0
//   triangles                    3
//   materials                    8
//
// To leave out a table that no shader uses, convert again with fewer contents.

/// `m.obj`: 3 vertices, 1 triangles.
#[allow(clippy::needless_update, reason = "a later version has more tables")]
#[rustfmt::skip]
pub static TINY_PART: ::rasterizer::mesh::Mesh<'static> = {
    use ::rasterizer::{
        mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
        numbers::{Scale, Vec3},
    };
    static POSITIONS: [[i16; 3]; 3] = [
        [-32767, -24575, 0], [32767, -24575, 0], [-32767, 24575, 0],
    ];
    static VERTEX_NORMALS: [[i8; 3]; 3] = [
        [0, 0, 127], [0, 0, 127], [0, 0, 127],
    ];
    static FACE_NORMALS: [[i8; 3]; 1] = [
        [0, 0, 127],
    ];
    static TRIANGLES: [[u8; 3]; 1] = [
        [0, 1, 2],
    ];
    static MATERIALS: [Material; 1] = [
        Material::new([200, 200, 200], 1),
    ];
    Mesh::new_const(Tables {
        positions: Positions::I16(&POSITIONS),
        scale: Scale::new(0xCCCE_666A, -47),
        offset: Vec3::from_bits([0, 0, 0]),
        vertex_normals: Normals::I8(&VERTEX_NORMALS),
        face_normals: Normals::I8(&FACE_NORMALS),
        triangles: Triangles::U8(&TRIANGLES),
        materials: &MATERIALS,
        ..Tables::EMPTY
    })
};
"#
        .replace("VERSION", env!("CARGO_PKG_VERSION"))
    );
}

#[test]
fn a_model_has_finishes_only_if_one_of_them_is_not_matte() {
    let obj = b"mtllib m.mtl\nv 0 0 0\nv 4 0 0\nv 0 3 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n";
    let model =
        |mtl: &[u8]| load_files(&[("m.obj", obj), ("m.mtl", mtl)], &Options::default()).unwrap();
    let matte = model(b"newmtl a\nKd 1\nd 1\nNs 10\nnewmtl b\nKd 1\nKs 0\nnewmtl c\nKs 1\n");
    assert!(matte.finishes.is_empty() && matte.mesh().tables().finishes.is_empty());
    assert!(!emit::source(&matte).to_lowercase().contains("finish"));
    let shiny = model(b"newmtl a\nKd 1\nnewmtl b\nKd 1\nKs 1 0.2 0\nNs 40\nKe 0.4\nd 0.6\n");
    let finish = Finish::MATTE.with_specular([255, 51, 0], 40).with_emission([102; 3]);
    assert_eq!(shiny.mesh().tables().finishes, [Finish::MATTE, finish.with_opacity(153)]);
    let source = emit::source(&shiny);
    for line in [
        "//   finishes                    20\n",
        "        mesh::{Finish, Material, Mesh, Normals, Positions, Tables, Triangles},\n",
        "    static FINISHES: [Finish; 2] = [\n        Finish::MATTE,\n        \
         Finish::MATTE.with_specular([255, 51, 0], 40).with_emission([102, 102, 102])\
         .with_opacity(153),\n    ];\n",
        "        finishes: &FINISHES,\n",
    ] {
        assert!(source.contains(line), "{line}{source}");
    }
}

/// The numbers of the table `name` in an emitted file.
fn parsed(source: &str, name: &str) -> Vec<i64> {
    let Some((_, table)) = source.split_once(&format!("static {name}: ")) else {
        return Vec::new();
    };
    // `[...];` or `colors([...]);`
    let table = table.split_once("= ").unwrap().1.split_once("\n    ]").unwrap().0;
    let number = |text: &str| match text.strip_prefix("0x") {
        Some(digits) => i64::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    };
    table
        .split(|c: char| !c.is_ascii_alphanumeric() && c != '-' && c != '_')
        .filter_map(|text| number(&text.replace('_', "")))
        .collect()
}

#[test]
fn emitted_numbers_read_back_the_same() {
    let path = shipped::path("torus_knot.obj");
    let model = Model::load(&path, &textured()).unwrap();
    let source = emit::source(&model);
    let flat = |numbers: &[[i8; 3]]| -> Vec<i64> {
        numbers.as_flattened().iter().map(|&n| n.into()).collect()
    };
    let positions: Vec<i64> = model.positions.as_flattened().iter().map(|&n| n.into()).collect();
    // It repeats its texture too often for 16 bits.
    let TextureTable::I32(textures) = &model.texture_coordinates else { panic!("16 bits") };
    let textures: Vec<i64> = textures.as_flattened().iter().map(|&n| n.into()).collect();
    let triangles: Vec<i64> = indices(&model).as_flattened().iter().map(|&n| n as i64).collect();
    assert_eq!(parsed(&source, "POSITIONS"), positions);
    assert_eq!(parsed(&source, "VERTEX_NORMALS"), flat(&model.vertex_normals));
    assert_eq!(parsed(&source, "FACE_NORMALS"), flat(&model.face_normals));
    assert_eq!(parsed(&source, "TEXTURE_COORDINATES"), textures);
    assert_eq!(parsed(&source, "TRIANGLES"), triangles);
    let color = model.materials[0].color.map(i64::from);
    assert_eq!(parsed(&source, "MATERIALS"), [&color[..], &[triangles.len() as i64 / 3]].concat());
    assert_eq!(emit::source(&Model::load(&path, &textured()).unwrap()), source);
}

/// Files from other sources, in the folder that the environment variable names.
#[test]
fn models_from_elsewhere_load() {
    let Some(folder) = env::var_os("RASTERIZER_MODELS") else {
        return;
    };
    let mut loaded = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "obj") {
            continue;
        }
        let text = fs::read_to_string(&path).unwrap();
        let count = |keyword: &str| text.lines().filter(|line| line.starts_with(keyword)).count();
        let cuts: usize = (text.lines().filter(|line| line.starts_with("f ")))
            .map(|line| line.split_whitespace().count() - 3)
            .sum();
        let options = if count("vt ") > 0 { textured() } else { Options::default() };
        let model = Model::load(&path, &options).unwrap_or_else(|error| panic!("{error}"));
        let report = &model.report;
        println!("{}\n{report}{:?}\n", path.display(), model.warnings);
        assert_eq!(report.file_vertices, count("v "), "{}", path.display());
        assert_eq!(report.file_faces, count("f "), "{}", path.display());
        assert_eq!(report.triangles + report.dropped_triangles, cuts, "{}", path.display());
        assert!(report.cache_misses <= report.cache_misses_before, "{}", path.display());
        // Half a quantum on each axis; a model's diagonal is at least its largest half-extent.
        let limit = 0.5 * 3_f64.sqrt() / 32_767.0;
        assert!(report.position_error_max <= limit * report.size, "{}", path.display());
        assert_eq!(model.mesh().vertex_count(), model.exact.vertex_normals.len());
        loaded += 1;
    }
    assert!(loaded > 0, "no OBJ files in RASTERIZER_MODELS");
}
