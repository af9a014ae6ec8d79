//! What is read of a file, what is refused, and what is ignored with a warning.

use super::{load, load_files, textured, *};

/// A triangle without its face.
const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

const RED_MTL: &[u8] = b"newmtl red\nKd 1 0 0\n";

const RED: [u8; 3] = [255, 0, 0];
const BLUE: [u8; 3] = [0, 0, 255];
const GREY: [u8; 3] = [200; 3];

fn refusal(text: &str, options: &Options) -> String {
    load(text, options).unwrap_err().to_string()
}

fn colors(model: &Model) -> Vec<[u8; 3]> {
    model.materials.iter().map(|material| material.color).collect()
}

/// Loads a triangle whose lines before the face are `head`, beside the library `name`.
#[track_caller]
pub(super) fn with_library(head: &[u8], name: &str, library: &[u8]) -> Model {
    let obj = [CORNERS.as_bytes(), head, b"\nf 1 2 3\n"].concat();
    load_files(&[("m.obj", &obj), (name, library)], &Options::default()).unwrap()
}

/// Asserts that there is one warning, and that it has these parts.
#[track_caller]
pub(super) fn one_warning(model: &Model, parts: &[&str]) {
    assert_eq!(model.warnings.len(), 1, "{:?}", model.warnings);
    for part in parts {
        assert!(model.warnings[0].contains(part), "{part:?} in {:?}", model.warnings[0]);
    }
}

#[test]
fn numbers_that_a_c_library_prints_for_nan_are_errors() {
    for word in [
        "1.#QNAN",
        "-1.#IND",
        "1.#INF",
        "-1.#INF00",
        "1.#SNAN0",
        "1.#J",
        "1.$",
        "1,#INF",
        "nan(ind)",
        "-nan(ind)",
        "NaN",
        "-Infinity",
        "1e400",
    ] {
        for (line, text) in [
            (3, format!("v 0 0 0\nv 1 0 0\nv 0 1 {word}\nf 1 2 3\n")),
            (3, format!("v 0 0 0\nv 1 0 0\nv 0 {word} 1\nf 1 2 3\n")),
            (4, format!("{CORNERS}vn 0 0 {word}\nf 1//1 2//1 3//1\n")),
            (4, format!("{CORNERS}vt 0 {word} # comment\nf 1/1 2/1 3/1\n")),
        ] {
            let message = refusal(&text, &textured());
            let expected = format!("m.obj:{line}: `{word}` is not a finite number");
            assert!(message.contains(&expected), "{text:?}: {message}");
        }
    }
    // `#` inside a word that is no number of any kind.
    let message = refusal("v 0 0 0#5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", &Options::default());
    assert!(message.contains("m.obj:1: `0#5` is not a number"), "{message}");
    let message = refusal(&format!("{CORNERS}f 1 2 3#4\n"), &Options::default());
    assert!(message.contains("m.obj:4: `3#4` is not a face corner"), "{message}");
}

#[test]
fn numbers_that_are_not_finite_matter_only_where_they_are_used() {
    let text = format!("{CORNERS}v 0 nan 0\nvt inf 0\nvn 0 0 1.#QNAN\nf 1/1/1 2/1/1 3/1/1\n");
    let with = |normals, texture_coordinates| Options {
        contents: Contents { vertex_normals: normals, texture_coordinates, ..Contents::default() },
        ..Options::default()
    };
    let model = load(&text, &with(false, false)).unwrap();
    one_warning(&model, &["m.obj:4: ", "`nan`", "3 lines"]);
    assert_eq!(model.positions.len(), 3);
    let error = refusal(&text, &with(true, false));
    assert!(error.contains("m.obj:6: `1.#QNAN` is not a finite number"), "{error}");
    let error = refusal(&text, &with(false, true));
    assert!(error.contains("m.obj:5: `inf` is not a finite number"), "{error}");
    // A face further up names the vertex.
    let error = refusal(&format!("f 1 2 4\n{text}"), &with(false, false));
    assert!(error.contains("m.obj:5: `nan` is not a finite number"), "{error}");
}

#[test]
fn names_do_not_swallow_the_next_line() {
    for name in ["g C:\\models\\", "o a\\", "usemtl a\\", "g \\", "usemtl dark \\", "s off\\\n#"] {
        let text = format!("{CORNERS}v 1 1 0\n{name}\nf 1 2 3\nusemtl b\nf 2 4 3\n");
        let model = load(&text, &Options::default()).unwrap();
        assert_eq!((model.report.file_faces, indices(&model).len()), (2, 2), "{name}");
    }
    let obj = [CORNERS.as_bytes(), b"mtllib a.mtl\nusemtl dark\\\nf 1 2 3\n"].concat();
    let mtl = b"newmtl dark\\\nKd 1 0 0\nmap_Ks C:\\\nd 1\n";
    let model = load_files(&[("m.obj", &obj), ("a.mtl", mtl)], &Options::default()).unwrap();
    assert_eq!((colors(&model), &model.warnings[..]), (vec![RED], &[][..]));
    // Numbers and lists of libraries go on.
    let text = b"mtllib a.mtl \\\n b.mtl\nusemtl red\nf 1 \\\n2\\\n 3\n";
    let obj = [CORNERS.as_bytes(), text].concat();
    let files: [(&str, &[u8]); 3] = [("m.obj", &obj), ("a.mtl", b""), ("b.mtl", RED_MTL)];
    assert_eq!(colors(&load_files(&files, &Options::default()).unwrap()), [RED]);
}

#[test]
fn bytes_that_are_not_utf_8_matter_only_where_they_are_used() {
    let obj = b"# W\xFCrfel\ng \xFF\xFE\nmtllib a.mtl # gr\xFCn\nusemtl gr\xFCn";
    let mtl = b"# \x80\nnewmtl rot\nKd 1 0 0\nnewmtl gr\xFCn # hell\nKd 0 0 1\nmap_Ks \xE9.png\n";
    let model = with_library(obj, "a.mtl", mtl);
    assert_eq!((colors(&model), &model.warnings[..]), (vec![BLUE], &[][..]));
    // Another byte is another name; what cannot be read of it is replaced.
    let model = with_library(b"mtllib a.mtl\nusemtl gr\xE9n", "a.mtl", mtl);
    assert_eq!(colors(&model), [GREY]);
    one_warning(&model, &["m.obj:5: ", "`gr\u{FFFD}n`"]);
    let bytes = [CORNERS.as_bytes(), b"f 1 2 \xB3\n"].concat();
    let error = load_files(&[("m.obj", &bytes)], &Options::default()).unwrap_err().to_string();
    assert!(error.contains("m.obj:4: `\u{FFFD}` is not a face corner"), "{error}");
}

#[test]
fn utf_16_is_named() {
    let text = format!("# \u{e9}\u{4e2d}\r\n{CORNERS}f 1 2 3\n");
    for mark in ["", "\u{feff}"] {
        let units: Vec<u16> = format!("{mark}{text}").encode_utf16().collect();
        for bytes in [
            units.iter().flat_map(|unit| unit.to_le_bytes()).collect::<Vec<u8>>(),
            units.iter().flat_map(|unit| unit.to_be_bytes()).collect(),
        ] {
            let error = load_files(&[("m.obj", &bytes)], &Options::default()).unwrap_err();
            let error = error.to_string();
            assert!(error.contains("m.obj is UTF-16") && error.contains("UTF-8"), "{error}");
            let model = with_library(b"mtllib a.mtl", "a.mtl", &bytes);
            one_warning(&model, &["a.mtl is UTF-16"]);
        }
    }
}

#[test]
fn control_characters_are_escaped_in_messages() {
    let is_plain = |text: &str| !text.chars().any(|c| c.is_control() || c == '\u{202e}');
    for text in [
        "v \u{1b}[2J 0 0\n".to_owned(),
        "v 0 0 \u{9b}31m\n".to_owned(),
        format!("{CORNERS}f 1 2 \u{7}\u{202e}3\n"),
        format!("{CORNERS}f 1 2 3\u{7f}/\n"),
    ] {
        let error = refusal(&text, &Options::default());
        assert!(is_plain(&error) && error.contains("\\u{"), "{error:?}");
    }
    let text = "\u{1b}[31m\nmtllib \u{1b}]0;x\u{7}.mtl\nusemtl \u{9b}A\u{202e}\u{8}";
    let model = with_library(text.as_bytes(), "a.mtl", b"");
    assert_eq!(model.warnings.len(), 3, "{:?}", model.warnings);
    for warning in &model.warnings {
        assert!(is_plain(warning) && warning.contains("\\u{"), "{warning:?}");
    }
    let library = "newmtl \u{1b}c\nKd 1 0 0\nd 0.5\nnewmtl \u{1b}c\nKd \u{1b}c\nmap_Kd \u{7}\n";
    let model = with_library(b"mtllib a.mtl\nusemtl \x1bc", "a.mtl", library.as_bytes());
    assert!(model.warnings.len() > 2, "{:?}", model.warnings);
    assert!(model.warnings.iter().all(|warning| is_plain(warning)), "{:?}", model.warnings);
}

#[test]
fn libraries_are_found_by_windows_paths() {
    for name in [
        ".\\red.mtl",
        "C:\\Users\\someone\\red.mtl",
        "./C:\\Users\\some one\\red.mtl",
        "\\\\server\\share\\red.mtl",
        "..\\no\\red.mtl # from Windows",
        "/home/someone/red.mtl",
        "no\\blue.mtl C:\\no\\red.mtl",
    ] {
        let obj = format!("{CORNERS}mtllib {name}\nusemtl red\nf 1 2 3\n");
        let files: [(&str, &[u8]); 3] = [
            ("m.obj", obj.as_bytes()),
            ("red.mtl", RED_MTL),
            ("blue.mtl", b"newmtl blue\nKd 0 0 1\n"),
        ];
        let model = load_files(&files, &Options::default()).unwrap();
        assert_eq!((colors(&model), &model.warnings[..]), (vec![RED], &[][..]), "{name}");
        assert!(model.inputs.last().unwrap().ends_with("red.mtl"), "{name}");
    }
    // A folder is looked into before the OBJ's own.
    let directory = tempfile::tempdir().unwrap();
    fs::create_dir(directory.path().join("deep")).unwrap();
    fs::write(directory.path().join("deep/a.mtl"), RED_MTL).unwrap();
    fs::write(directory.path().join("a.mtl"), "newmtl red\nKd 0 0 1\n").unwrap();
    let obj = directory.path().join("m.obj");
    fs::write(&obj, format!("{CORNERS}mtllib deep\\a.mtl\nusemtl red\nf 1 2 3\n")).unwrap();
    assert_eq!(colors(&Model::load(&obj, &Options::default()).unwrap()), [RED]);
}

#[test]
fn the_first_material_of_a_name_counts() {
    let obj = format!("{CORNERS}mtllib a.mtl b.mtl\nusemtl c\nf 1 2 3\nusemtl d\nf 1 3 2\n");
    let files: [(&str, &[u8]); 3] = [
        ("m.obj", obj.as_bytes()),
        ("a.mtl", b"newmtl c\nKd 1 0 0\nnewmtl d\nKd 0 0 1\nnewmtl c\nKd 0 1 0\n"),
        ("b.mtl", b"newmtl c\nKd 0 1 0\nnewmtl d\nKd 0 1 0\nnewmtl e\nnewmtl e\n"),
    ];
    let model = load_files(&files, &Options::default()).unwrap();
    assert_eq!(colors(&model), [RED, BLUE]);
    one_warning(&model, &["a.mtl:5: ", "`c`", "`d`", "3 "]);
}

#[test]
fn a_name_that_is_unknown_may_have_a_comment() {
    let library = b"newmtl red # paint me\nKd 1 0 0 # red\nnewmtl Material #25\nKd 0 0 1\n";
    for (name, color) in [
        ("red", RED),
        ("red # paint", RED),
        ("red #paint", RED),
        ("red # paint me", RED),
        ("red#paint", GREY),
        ("Material #25", BLUE),
        ("Material #25 # blue", BLUE),
        ("Material #26", GREY),
        ("Material # 25", GREY),
    ] {
        let head = format!("mtllib a.mtl\nusemtl {name}");
        let model = with_library(head.as_bytes(), "a.mtl", library);
        assert_eq!(colors(&model), [color], "{name}");
        assert_eq!(model.warnings.is_empty(), color != GREY, "{:?}", model.warnings);
    }
    // The whole name goes first.
    let library = b"newmtl a\nKd 1 0 0\nnewmtl a # b\nKd 0 0 1\n";
    assert_eq!(colors(&with_library(b"mtllib m.mtl\nusemtl a # b", "m.mtl", library)), [BLUE]);
}

#[test]
fn repeated_warnings_are_one_with_a_count() {
    let many = |line: &dyn Fn(usize) -> String| (0..2_500).map(line).collect::<String>();
    let start = format!("{CORNERS}f 1 2 3\n");
    let unknown = many(&|i| format!("usemtl m{i}\nf 1 2 3\n"));
    let model = load(&format!("{start}{unknown}"), &Options::default()).unwrap();
    one_warning(&model, &["m.obj:5: ", "`m0`, `m1`, `m2` and 2,497 more"]);
    assert!(model.warnings[0].len() < 400);
    for line in ["mtllib no{}.mtl\n", "mtllib\n", "usemtl\n", "curv 0 1\n", "blah{}\n", "vt nan\n"]
    {
        let text = many(&|i| line.replace("{}", &i.to_string()));
        let model = load(&format!("{start}{text}"), &Options::default()).unwrap();
        one_warning(&model, &["m.obj:5", "2,"]);
    }
    let faults = many(&|i| format!("newmtl a{i}\nKd x\nnewmtl\nKd 1 1\n"));
    let model = with_library(b"mtllib a.mtl", "a.mtl", faults.as_bytes());
    assert_eq!(model.warnings.len(), 3, "{:?}", model.warnings);
    for warning in &model.warnings {
        assert!(warning.contains("a.mtl:") && warning.contains("2,500"), "{warning}");
    }
}

#[test]
fn what_is_dropped_is_counted() {
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nv 1 1 0 1 0.5 0.5 0.5\nf 1 2 3\n\
                l 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2 3 4\ncall other.obj\n\
                V 1 1 1\nvertex 2\n";
    let model = load(text, &Options::default()).unwrap();
    for part in [
        "m.obj:3: 1 vertex has no colour, unlike others",
        "m.obj:9: 2 curves and surfaces",
        "m.obj:11: 1 call of another file",
        "m.obj:12: 2 lines begin with an unknown word: `V`, `vertex`",
    ] {
        assert_eq!(
            model.warnings.iter().filter(|warning| warning.contains(part)).count(),
            1,
            "{part}: {:#?}",
            model.warnings
        );
    }
    assert_eq!(model.warnings.len(), 4);
    assert_eq!((model.report.lines, model.report.points), (2, 1));
    // A fourth coordinate is a weight, and nothing else is lost here.
    let text = format!("v 1 1 1 0.5\ng a\no b\ns 1\nmg 1 1\nvp 0\nlod 1\n{CORNERS}f 1 2 3\nend\n");
    assert_eq!(load(&text, &Options::default()).unwrap().warnings, [""; 0]);
}

#[test]
fn what_a_colour_loses_is_counted() {
    let library = b"newmtl a\nKd 0 0 0\nmap_Kd wood.png\nnewmtl b\nKd 1 1 1\nd 0.2\nTr 0.8\n\
                    newmtl c\nKd 1 0 0\nTr 0.5\nnewmtl d\nKd 1 0 0\nd 1\nTr 1\n\
                    newmtl unused\nKd 0 0 0\nmap_Kd a.png\nd -halo 0\nnewmtl e\nKd 1 1 1\n\
                    map_Kd -s 1 1 1 b.png\nnewmtl f\nKd 0 0 0\nnewmtl g\nKd 1 1 1\nd -halo 0.5\n";
    let faces: String = ["a", "b", "c", "d", "e", "f", "g"]
        .map(|name| format!("usemtl {name}\nf 1 2 3\nf 1 2 3\n"))
        .concat();
    let model = with_library(format!("mtllib a.mtl\n{faces}").as_bytes(), "a.mtl", library);
    assert_eq!(model.warnings.len(), 3, "{:#?}", model.warnings);
    for (warning, parts) in model.warnings.iter().zip([
        ["a.mtl:6: ", "3 materials", "`b`, `c`, `g`"],
        ["a.mtl:3: ", "2 materials", "`a`, `e`"],
        ["a.mtl:2: ", "1 material", "`a`"],
    ]) {
        assert!(parts.iter().all(|part| warning.contains(part)), "{parts:?}: {warning}");
    }
}

/// A grid of 10 by 10 squares in steps of 1, with a further triangle to a vertex in line 122.
fn grid_and(vertex: &str) -> String {
    let vertices = (0..121).map(|i| format!("v {} {} 0\n", i % 11, i / 11)).collect::<String>();
    let squares = (0..10).flat_map(|y| (0..10).map(move |x| y * 11 + x + 1));
    let faces = squares.map(|i| format!("f {i} {} {} {}\n", i + 1, i + 12, i + 11));
    format!("{vertices}v {vertex}\n{}f 1 12 122\n", faces.collect::<String>())
}

#[test]
fn a_vertex_that_flattens_the_model_is_named() {
    for (vertex, lost) in [
        ("-5 0 5", false),
        // A third of a million units in 65,534 steps: a step is ten of the grid's.
        ("-3e5 0 5", true),
        ("1e9 0 50", true),
        // So far out that its triangle has no area, and only that one is left out.
        ("0 -1e17 0", false),
        ("0 0 1e300", false),
    ] {
        let model = load(&grid_and(vertex), &Options::default()).unwrap();
        let is_left_out = vertex.contains("e17") || vertex.contains("e300");
        assert_eq!(model.report.dropped_triangles, usize::from(is_left_out), "{vertex}");
        if lost {
            let times = "times as far out as half of the others";
            one_warning(&model, &["m.obj:122: ", "of 201 triangles lose their area", times]);
        } else {
            assert_eq!(model.warnings, [""; 0]);
        }
    }
    // A triangle of one unit in a model of a million: no vertex is far from all others.
    let corners = "v 0 0 0\nv 1e6 0 0\nv 1e6 1e6 0\nv 0 1e6 0\n";
    let text = format!(
        "{corners}{}v 3 0 0\nv 3 1 0\nv 4 1 0\nf 1 2 3 4\nf 5 6 7 8\nf 9 10 11\n",
        corners.replace(" 0\n", " 1e6\n")
    );
    let model = load(&text, &Options::default()).unwrap();
    one_warning(&model, &["m.obj:9: 1 of 5 triangles", "the first at vertex [3.0, 0.0, 0.0]"]);
}

#[test]
fn a_texture_is_not_lost_where_its_coordinates_are_kept() {
    let obj = format!("{CORNERS}vt 0 0\nmtllib a.mtl\nusemtl a\nf 1/1 2/1 3/1\n");
    let files: [(&str, &[u8]); 2] =
        [("m.obj", obj.as_bytes()), ("a.mtl", b"newmtl a\nKd 1 1 1\nmap_Kd a.png\n")];
    let without = |options| Options { textures: None, ..options };
    let lost = load_files(&files, &without(Options::default())).unwrap();
    one_warning(&lost, &["a.mtl:3: ", "texture"]);
    assert_eq!(load_files(&files, &without(textured())).unwrap().warnings, [""; 0]);
}
