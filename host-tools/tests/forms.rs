//! `--stretch`, `--matrix` and `--between`: models that are not as they were modelled, drawn and
//! judged.

use std::{fs, path::Path};

use serde_json::Value;
use tempfile::TempDir;

mod frames;
mod program;

use frames::{picture, png_frames};
use program::{refuse, succeed};

/// A wedge of four faces, of which no two look the same.
const WEDGE: &str = "\
v -1 -1 -1\nv 1 -1 -0.7\nv 0.3 1 -1\nv 0.1 0.2 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn directory_with(files: &[(&str, String)]) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(directory.path().join(name), text).unwrap();
    }
    directory
}

/// What `check` finds, within all bounds.
fn check(directory: &Path, line: &str) -> Value {
    serde_json::from_str(&succeed(directory, &format!("check {line} --json"))).unwrap()
}

#[test]
fn shaped_models_are_judged_in_every_mode() {
    let directory = directory_with(&[("a.obj", WEDGE.to_owned())]);
    let path = directory.path();
    for form in ["--stretch 1,0.5,-1.3", "--matrix=0.7,0.9,-0.2,0.4,0.1,1.2,-0.8,0.3,0.5"] {
        for mode in [
            "--shading flat",
            "--shading gouraud --frames 6",
            "--shading glossy-gouraud",
            "--shading phong --lamp 0.5,1,2,1",
            "--shading matcap --orthographic 2.4",
            "--shading flat --lamp 0.5,1,2,1 --subpixel 4",
            "--blend over --opacity 0.5 --fade y",
            "--blend painter",
            "--fog linear:2:4",
            "--clip 0,0.3,-1,0.1",
            "--clip 0,0.3,-1,0.1 --clip-in world",
            "--edges 30 --depth u32",
            "--near 2.6 --far 3.3",
        ] {
            let found = check(path, &format!("a.obj {form} {mode}"));
            assert!(found["settings"]["matrix"][2][2].is_f64(), "{found}");
            let pixels = found["arithmetic"]["pixels"].as_u64().unwrap();
            let judged = found["places"]["judged"].as_u64().unwrap();
            assert!(pixels > 1_000 && judged > 60_000, "{form} {mode}: {pixels} {judged}");
            let degrees = found["arithmetic"]["normal_max_error_degrees"].as_f64().unwrap();
            assert!(degrees > 0.01 && degrees <= 0.5, "{form} {mode}: {degrees}");
        }
    }
    let told = succeed(path, "check a.obj --stretch 1,0.5,-1.3");
    assert!(told.contains("shaped by a matrix") && told.contains("Normal error"), "{told}");
}

/// A shiny wedge off the origin: the far viewer of a highlight looks from the middle of the shape.
fn shiny(wedge: &str) -> String {
    let moved = wedge.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["v", x, y, z] => format!("v {} {y} {z}\n", x.parse::<f64>().unwrap() + 2.0),
            _ => format!("{line}\n"),
        }
    });
    let library = "mtllib m.mtl\nusemtl shiny\n".to_owned();
    std::iter::once(library).chain(moved).collect()
}

const SHINY: &str = "newmtl shiny\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 4\n";
const BESIDE: &str = "--keep-units --eye 2,1,5 --target 2,0.3,0 --shading phong --light 0.2,1,3";

#[test]
fn highlights_and_smooth_mirrors_are_judged() {
    let directory = directory_with(&[("a.obj", shiny(WEDGE)), ("m.mtl", SHINY.to_owned())]);
    check(directory.path(), &format!("a.obj --stretch 0.4,0.5,-1.3 {BESIDE}"));
    let gear = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/gear.obj");
    let found =
        check(directory.path(), &format!("{} --stretch 1,0.5,-1.3 --near 0.5", gear.display()));
    assert!(found["places"]["judged"].as_u64() > Some(70_000), "{found}");
}

/// A stretch in the file and one in the view are the same shape, in a mirror too, whose faces the
/// file turns over.
#[test]
fn a_stretched_model_is_that_of_a_stretched_file() {
    let stretched = WEDGE.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        let place = |i: usize| words[i].parse::<f64>();
        match words[0] {
            "v" => {
                let [x, y, z] = [1, 2, 3].map(|i| place(i).unwrap());
                format!("v {x} {} {}\n", 0.5 * y, -1.25 * z)
            }
            _ => format!("f {} {} {}\n", words[3], words[2], words[1]),
        }
    });
    let directory = directory_with(&[("a.obj", WEDGE.to_owned()), ("b.obj", stretched.collect())]);
    let path = directory.path();
    for shading in ["flat", "gouraud", "phong"] {
        let rest = format!("--keep-units --distance 6 --size 80x60 --shading {shading}");
        let by_view = picture(path, &format!("render a.obj --stretch 1,0.5,-1.25 {rest}"));
        let by_file = picture(path, &format!("render b.obj {rest}"));
        let plain = picture(path, &format!("render a.obj {rest}"));
        let differ =
            |other: &[u8]| by_view.iter().zip(other).filter(|(a, b)| a.abs_diff(**b) > 8).count();
        // Pixels at edges may be of the other side, and vertices have normals by other angles.
        let (from_file, from_plain) = (differ(&by_file), differ(&plain));
        assert!(from_file * 20 < from_plain, "{shading}: {from_file} {from_plain}");
    }
}

#[test]
fn what_cannot_be_shaped_is_refused() {
    let directory = directory_with(&[("a.obj", WEDGE.to_owned())]);
    let path = directory.path();
    refuse(path, "check a.obj --stretch 1,2", "1,0.5,-1");
    refuse(path, "check a.obj --matrix 1,0,0,0,1,0,0,0", "nine entries");
    refuse(path, "check a.obj --stretch 1,2,3 --matrix 1,0,0,0,1,0,0,0,1", "cannot be used with");
    refuse(path, "check a.obj --stretch 1,0,1", "flattens the model");
    refuse(path, "check a.obj --stretch 1,0.00048828125,1", "stretches 2048 times more");
    refuse(path, "render a.obj a.obj@1,0,0 --stretch 1,2,3", "one model");
    succeed(path, "render a.obj --stretch 1,0,1 -o flat.png");
}

/// The wedge, bent and larger.
fn bent_wedge() -> String {
    WEDGE.replace("v 0.3 1 -1\n", "v 0.6 1.4 -0.2\n").replace("v 0.1 0.2 1.1\n", "v -0.4 0.7 1.3\n")
}

fn two_shapes() -> TempDir {
    directory_with(&[("a.obj", WEDGE.to_owned()), ("b.obj", bent_wedge())])
}

#[test]
fn models_between_shapes_are_judged_in_every_mode() {
    let directory = two_shapes();
    let path = directory.path();
    for mode in [
        "--between 0.5 --shading flat",
        "--between 0..1 --shading gouraud --frames 6",
        "--between 0.3 --shading phong --lamp 0.5,1,2,1",
        "--between 0.7 --shading matcap --orthographic 2.4",
        "--between 0.25 --blend over --opacity 0.5 --fade y",
        "--between 0.6 --fog linear:2:4",
        "--between 0.6 --clip 0,0.3,-1,0.1",
        "--between 0.4 --edges 30",
    ] {
        let found = check(path, &format!("a.obj b.obj {mode}"));
        assert!(found["settings"]["between"][1].is_f64(), "{found}");
        let pixels = found["arithmetic"]["pixels"].as_u64().unwrap();
        let judged = found["places"]["judged"].as_u64().unwrap();
        assert!(pixels > 3_000 && judged > 60_000, "{mode}: {pixels} {judged}");
        let degrees = found["arithmetic"]["normal_max_error_degrees"].as_f64().unwrap();
        assert!(degrees <= 0.5, "{mode}: {degrees}");
    }
    let told = succeed(path, "check a.obj b.obj --between 0.5");
    assert!(told.contains("at 0.5 between two shapes"), "{told}");
}

#[test]
fn highlights_between_shapes_are_judged() {
    let directory = directory_with(&[
        ("a.obj", shiny(WEDGE)),
        ("b.obj", shiny(&bent_wedge())),
        ("m.mtl", SHINY.to_owned()),
    ]);
    check(directory.path(), &format!("a.obj b.obj --between 0.5 {BESIDE}"));
}

#[test]
fn a_motion_begins_and_ends_at_the_shapes() {
    let directory = two_shapes();
    let path = directory.path();
    // Both in the units of their files, so that they have one size.
    let rest = "--keep-units --distance 6 --size 80x60 --shading unlit";
    let shape = |t: &str| picture(path, &format!("render a.obj b.obj --between {t} {rest}"));
    let alone = |name: &str| picture(path, &format!("render {name} {rest}"));
    let differ = |a: &[u8], b: &[u8]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    // Quanta of two shapes are larger than those of one: a pixel at an edge may differ.
    assert!(differ(&shape("0"), &alone("a.obj")) <= 9);
    assert!(differ(&shape("1"), &alone("b.obj")) <= 9);
    let [to_first, to_second] = ["a.obj", "b.obj"].map(|name| differ(&shape("0.5"), &alone(name)));
    assert!(to_first > 100 && to_second > 100, "{to_first} {to_second}");
    // Frame 2 of 8 is a quarter of a turn on, and halfway to the second shape.
    let line = format!("render a.obj b.obj --between 0..1 --frames 8 -o turn.png {rest}");
    assert!(succeed(path, &line).contains("8 frames"));
    let frame = png_frames(&path.join("turn.png")).0.swap_remove(2);
    let turned = "render a.obj b.obj --between 0.5 --yaw 120";
    assert_eq!(frame, picture(path, &format!("{turned} {rest}")));
}

#[test]
fn what_has_no_two_shapes_is_refused() {
    let directory = two_shapes();
    let path = directory.path();
    fs::write(path.join("c.obj"), WEDGE.replace("f 3 1 4", "f 3 4 1")).unwrap();
    refuse(path, "check a.obj --between 0.5", "name the files of both");
    refuse(path, "check a.obj b.obj", "--between");
    refuse(path, "check a.obj b.obj --between 1.5", "from 0 to 1");
    refuse(path, "check a.obj b.obj --between 0..1", "--frames");
    refuse(path, "check a.obj c.obj --between 0.5", "corner");
    refuse(path, "check a.obj b.obj --between 0.5 --stretch 1,2,3", "cannot be used with");
    refuse(path, "render a.obj b.obj a.obj --between 0.5", "name the files of both");
    refuse(path, "render a.obj b.obj@1,0,0 --between 0.5", "behind the first file");
    refuse(path, "check a.obj - --between 0.5", "standard input");
}
