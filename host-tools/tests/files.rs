//! What the program writes over, what it never does, and what it leaves behind.
#![cfg(unix)]

use std::{
    fs,
    io::Write as _,
    os::unix::fs::{PermissionsExt as _, symlink},
    path::Path,
    process::{Command, Output, Stdio},
};

use tempfile::TempDir;

const TRIANGLE: &str = "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const LIBRARY: &str = "newmtl red\nKd 1 0 0\nmap_Kd -s 1 1 1 my wood.png\n";

fn model() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("a.obj"), TRIANGLE).unwrap();
    fs::write(directory.path().join("a.mtl"), LIBRARY).unwrap();
    fs::write(directory.path().join("my wood.png"), foreign_png()).unwrap();
    directory
}

/// A picture of another program.
fn foreign_png() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().unwrap().write_image_data(&[7]).unwrap();
    bytes
}

fn run(directory: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-tools"));
    command.current_dir(directory).args(line.split_whitespace()).output().unwrap()
}

#[track_caller]
fn succeed(directory: &Path, line: &str) {
    let output = run(directory, line);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{line}: {complaint}");
}

#[track_caller]
fn refuse(directory: &Path, line: &str, part: &str) {
    let output = run(directory, line);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert!(complaint.contains(part), "{line}: {complaint}");
}

#[test]
fn pictures_of_others_are_kept_and_its_own_are_replaced() {
    let directory = model();
    let path = directory.path();
    fs::create_dir_all(path.join("target")).unwrap();
    fs::create_dir_all(path.join("seen")).unwrap();
    for (line, picture) in [
        ("render a.obj --size 9x9", "a.png"),
        ("render a.obj --size 9x9 --frames 2 -o b.PNG", "b.PNG"),
        ("check a.obj --size 9x9 --pictures seen", "seen/difference.png"),
        ("check a.obj --size 9x9", "target/check/a/fixed.png"),
        ("a.obj", "target/a.png"),
        ("a.obj", "target/a-reference.png"),
    ] {
        let picture = path.join(picture);
        fs::create_dir_all(picture.parent().unwrap()).unwrap();
        fs::write(&picture, foreign_png()).unwrap();
        refuse(path, line, "is not from this program");
        assert_eq!(fs::read(&picture).unwrap(), foreign_png(), "{line}");
        succeed(path, &format!("{line} --force"));
        assert_ne!(fs::read(&picture).unwrap(), foreign_png(), "{line}");
        succeed(path, line);
        // An empty file, as from mktemp.
        fs::write(&picture, "").unwrap();
        succeed(path, line);
    }
    fs::write(path.join("empty.rs"), "").unwrap();
    succeed(path, "convert a.obj -o empty.rs");
}

#[test]
fn inputs_are_never_overwritten() {
    let directory = model();
    let path = directory.path();
    fs::create_dir(path.join("folder")).unwrap();
    symlink("../a.obj", path.join("folder/link.rs")).unwrap();
    fs::hard_link(path.join("a.mtl"), path.join("hard.rs")).unwrap();
    symlink("my wood.png", path.join("wood.png")).unwrap();
    for line in [
        "convert a.obj --force -o a.obj",
        "convert a.obj --force -o ./folder/../a.obj",
        "convert a.obj --force -o folder/link.rs",
        "convert a.obj --force -o hard.rs",
        "render a.obj --force --size 9x9 -o wood.png",
    ] {
        refuse(path, line, "is the input ");
    }
    assert_eq!(fs::read_to_string(path.join("a.obj")).unwrap(), TRIANGLE);
    assert_eq!(fs::read_to_string(path.join("a.mtl")).unwrap(), LIBRARY);
    assert_eq!(fs::read(path.join("my wood.png")).unwrap(), foreign_png());
}

#[test]
fn a_link_stays_and_its_target_is_written() {
    let directory = model();
    let path = directory.path();
    fs::create_dir(path.join("src")).unwrap();
    symlink("src/model.rs", path.join("out.rs")).unwrap();
    for _ in 0..2 {
        succeed(path, "convert a.obj -o out.rs");
        assert!(fs::symlink_metadata(path.join("out.rs")).unwrap().is_symlink());
        assert!(fs::read_to_string(path.join("src/model.rs")).unwrap().contains("static A:"));
    }
    assert_eq!(fs::read_dir(path.join("src")).unwrap().count(), 1);
    symlink("round.rs", path.join("round.rs")).unwrap();
    refuse(path, "convert a.obj -o round.rs", "round.rs");
}

#[test]
fn a_minus_stands_for_the_standard_input_and_output() {
    let directory = model();
    let path = directory.path();
    let mut child = Command::new(env!("CARGO_BIN_EXE_host-tools"))
        .current_dir(path)
        .args(["convert", "-", "-o", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(TRIANGLE.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    // The library lies in the current directory.
    assert!(
        text.starts_with("// A model as const tables") && text.contains("[255, 0, 0]"),
        "{text}"
    );
    assert_eq!(run(path, "render a.obj --size 9x9 -o -").stdout[..4], *b"\x89PNG");
    assert!(!path.join("-").exists());
    refuse(path, "convert a.obj -o - --json", "--json and -o -");
    refuse(path, "render a.obj -o b.jpg", "the ending .png");
}

#[test]
fn conflicts_of_options_are_named() {
    let directory = model();
    for line in [
        "check a.obj --orthographic=2 --fov=40",
        "check --orthographic 2 --fov 40 a.obj",
        "render a.obj --fov=40 --orthographic=2",
    ] {
        refuse(directory.path(), line, "cannot be used with");
    }
}

/// A model that takes a while to write, as its tables have 19,000 entries.
fn grid() -> String {
    let vertices = (0..80 * 80).map(|i| format!("v {} {} {}\n", i % 80, i / 80, i % 7));
    let faces = (0..79 * 79).map(|i| {
        let corner = i / 79 * 80 + i % 79 + 1;
        format!("f {corner} {} {} {}\n", corner + 1, corner + 81, corner + 80)
    });
    vertices.chain(faces).collect()
}

#[test]
fn signals_leave_a_whole_file_or_none() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("g.obj"), grid()).unwrap();
    let start = || {
        Command::new(env!("CARGO_BIN_EXE_host-tools"))
            .current_dir(path)
            .args(["convert", "g.obj", "--normals", "none"])
            .stdout(Stdio::null())
            .spawn()
            .unwrap()
    };
    let begun = std::time::Instant::now();
    assert!(start().wait().unwrap().success());
    let (took, whole) = (begun.elapsed(), fs::read(path.join("g.rs")).unwrap());
    // Signals over the last third of the run, with and without an older file.
    for round in 0..16_u32 {
        let is_new = round % 2 == 0;
        if is_new {
            let _ = fs::remove_file(path.join("g.rs"));
        } else {
            fs::write(path.join("g.rs"), &whole).unwrap();
        }
        let mut child = start();
        std::thread::sleep(took.mul_f64(0.6 + f64::from(round) / 35.0));
        let signal = ["-TERM", "-INT", "-HUP", "-KILL"][round as usize / 2 % 4];
        let _ = Command::new("kill").args([signal, &child.id().to_string()]).output();
        child.wait().unwrap();
        let names: Vec<_> =
            fs::read_dir(path).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert!(names.iter().all(|name| name == "g.obj" || name == "g.rs"), "{signal}: {names:?}");
        match fs::read(path.join("g.rs")) {
            Ok(found) => assert!(found == whole, "{signal}: {} bytes", found.len()),
            Err(_) => assert!(is_new, "{signal}: the older file is gone"),
        }
    }
    let mode = fs::metadata(path.join("g.obj")).unwrap().permissions().mode();
    assert!(start().wait().unwrap().success());
    assert_eq!(fs::metadata(path.join("g.rs")).unwrap().permissions().mode(), mode);
}
