//! The program as a user runs it: arguments, results, exit statuses, and what it leaves behind.

use std::{fs, io::Read as _, path::Path, process::Stdio};

use serde_json::Value;
use tempfile::TempDir;

mod program;

use program::{files, program, refusal, refuse, run, succeed, text};

/// A cube: eight vertices, six faces, no normals.
const CUBE: &str = "\
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// An empty directory with a model in it.
fn directory_with(name: &str, obj: &str) -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join(name), obj).unwrap();
    directory
}

/// Width, height, number of frames, and the pixels of the first.
fn decode(path: &Path) -> (u32, u32, u32, Vec<u8>) {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let info = reader.info();
    let frames = info.animation_control.map_or(1, |animation| animation.num_frames);
    (info.width, info.height, frames, pixels)
}

#[test]
fn convert_writes_the_static_and_reports() {
    let directory = directory_with("my-cube.obj", CUBE);
    let (path, line) = (directory.path(), "convert my-cube.obj");
    let report = succeed(path, line);
    assert!(report.contains("Triangles: 12") && report.contains("Flash: "), "{report}");
    assert!(report.contains("Wrote my-cube.rs: static MY_CUBE"), "{report}");
    let source = fs::read_to_string(path.join("my-cube.rs")).unwrap();
    assert!(source.contains("pub static MY_CUBE: ::rasterizer::mesh::Mesh<'static>"));

    let json: Value = serde_json::from_str(&succeed(
        path,
        "convert my-cube.obj --json --name hull --normals face --keep-units --crease 0 \
         -o tables.rs",
    ))
    .unwrap();
    // A cube's eight corners, as no vertex normals split them; 8 x 6 bytes of positions, 12 x 3 of
    // normals and of indices.
    assert_eq!((&json["model"], &json["output"]), (&"my-cube.obj".into(), &"tables.rs".into()));
    assert_eq!(
        (&json["name"], &json["vertices"], &json["triangles"]),
        (&"HULL".into(), &8.into(), &12.into())
    );
    let flash = &json["flash"];
    assert_eq!((&flash["positions"], &flash["vertex_normals"]), (&48.into(), &0.into()));
    assert_eq!((&flash["face_normals"], &flash["triangles"]), (&36.into(), &36.into()));
    assert!(
        json["position_error_max_percent"].is_f64() && json["flash_total"].as_u64() > Some(120)
    );
    assert_eq!(json["warnings"], Value::Array(Vec::new()));
    let source = fs::read_to_string(path.join("tables.rs")).unwrap();
    assert!(
        source.contains("pub static HULL:")
            && source.contains("coordinates kept, a crease angle of 0 degrees")
    );
}

#[test]
fn convert_writes_several_shapes() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    fs::write(path.join("b.obj"), CUBE.replace("v 1 1 1", "v 1 3 1")).unwrap();
    let report = succeed(path, "convert a.obj b.obj --name box");
    assert!(report.contains("Wrote a.rs: statics BOX and BOX_KEYFRAMES"), "{report}");
    assert!(report.contains("  keyframes"), "{report}");
    let source = fs::read_to_string(path.join("a.rs")).unwrap();
    assert!(source.contains("pub static BOX_KEYFRAMES:") && source.contains("POSITIONS_1"));
    let json: Value = serde_json::from_str(&succeed(path, "convert a.obj b.obj --json")).unwrap();
    assert!(json["flash"]["keyframes"].as_u64() > Some(100), "{json}");

    fs::write(path.join("c.obj"), CUBE.replace("f 4 1 5 8", "f 4 1 5")).unwrap();
    let error = refusal(path, "convert a.obj b.obj c.obj");
    let difference = "c.obj:14: the face has 3 corners and not 4 as at a.obj:14";
    assert!(error.contains(difference), "{error}");
    // Neither of the files is overwritten, and the standard input is one file.
    refusal(path, "convert a.obj b.obj -o b.obj");
    refuse(path, "convert a.obj -", "standard input");
    refuse(path, "convert a.obj b.obj -o a.bin", "one shape");
}

#[test]
fn convert_writes_bytes_to_a_file_of_that_name() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    let report = succeed(path, "convert a.obj -o a.bin");
    assert!(report.contains("Wrote a.bin: a mesh"), "{report}");
    let bytes = fs::read(path.join("a.bin")).unwrap();
    assert!(bytes.starts_with(b"RMSH"));
    assert_eq!(bytes[8..12], (bytes.len() as u32).to_le_bytes());
    // It is ours to overwrite, and another file is not.
    succeed(path, "convert a.obj -o a.bin");
    fs::write(path.join("b.bin"), "by hand").unwrap();
    refuse(path, "convert a.obj -o b.bin", "--force");
}

#[test]
fn convert_overwrites_only_its_own_files() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    succeed(path, "convert a.obj");
    succeed(path, "convert a.obj");
    fs::write(path.join("a.rs"), "// by hand\n").unwrap();
    let error = refusal(path, "convert a.obj");
    assert!(error.contains("a.rs exists") && error.contains("--force"), "{error}");
    assert_eq!(fs::read_to_string(path.join("a.rs")).unwrap(), "// by hand\n");
    succeed(path, "convert a.obj --force");
    assert!(fs::read_to_string(path.join("a.rs")).unwrap().contains("static A:"));
    // The program never overwrites the model itself.
    refusal(path, "convert a.obj -o a.obj");
    refusal(path, "render a.obj -o a.obj");
    assert_eq!(fs::read_to_string(path.join("a.obj")).unwrap(), CUBE);
}

#[test]
fn warnings_go_to_the_standard_error() {
    let directory = directory_with("a.obj", &format!("mtllib none.mtl\n{CUBE}"));
    let output = run(directory.path(), "convert a.obj --json");
    assert_eq!(output.status.code(), Some(0));
    let complaint = text(&output.stderr);
    assert!(complaint.starts_with("warning: ") && complaint.contains("none.mtl"), "{complaint}");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["warnings"].as_array().unwrap().len(), 1);
}

#[test]
#[cfg(target_os = "linux")]
fn control_characters_do_not_reach_the_terminal() {
    let is_plain = |text: &str| !text.chars().any(|c| c.is_control() && c != '\n');
    let name = "a\u{1b}[2J\u{9b}\u{7f}.obj";
    let directory = directory_with(name, &format!("mtllib \u{1b}\u{9b}.mtl\n\u{7}\n{CUBE}"));
    fs::write(directory.path().join("b.obj"), "v \u{1b}[31m 0 0\n").unwrap();
    for line in ["convert", "convert --json", "render", "check", "check --json"] {
        for (model, status) in [(name, 0), ("b.obj", 2), ("\u{1b}c.obj", 2)] {
            let words = line.split(' ');
            let output = program(directory.path()).args(words).arg(model).output().unwrap();
            let (told, complaint) = (text(&output.stdout), text(&output.stderr));
            assert_eq!(output.status.code(), Some(status), "{line} {model}: {complaint}");
            assert!(is_plain(told) && is_plain(complaint), "{line} {model}: {told}{complaint}");
            if line.contains("--json") && status == 0 {
                let json: Value = serde_json::from_str(told).unwrap();
                assert_eq!(json["model"], name);
            }
        }
    }
}

#[test]
fn render_draws_the_model_on_the_background() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    let told = succeed(path, "render a.obj --size 31x17 --background 102030 --shading unlit");
    assert_eq!(told, "Wrote a.png: 31x17 pixels\n");
    let (width, height, frames, pixels) = decode(&path.join("a.png"));
    assert_eq!((width, height, frames, pixels.len()), (31, 17, 1, 31 * 17 * 3));
    let at = |x: usize, y: usize| &pixels[(y * 31 + x) * 3..][..3];
    assert_eq!(at(0, 0), [0x10, 0x20, 0x30]);
    let middle = at(15, 8).to_vec();
    assert_ne!(middle, [0x10, 0x20, 0x30]);

    succeed(
        path,
        "render a.obj --size 31x17 --background 102030 --shading unlit --rgb565 -o b.png",
    );
    let (.., pixels) = decode(&path.join("b.png"));
    // 5 bits of blue: 0x30 of 255 is 5.8 of 31.
    assert!(pixels[2] == 41 || pixels[2] == 49, "{}", pixels[2]);
    assert_eq!(pixels[(8 * 31 + 15) * 3].abs_diff(middle[0]) / 8, 0);
}

#[test]
fn several_frames_are_an_animation() {
    let directory = directory_with("a.obj", CUBE);
    succeed(directory.path(), "render a.obj --size 20x20 --frames 3");
    let path = directory.path().join("a.png");
    assert_eq!((decode(&path).0, decode(&path).2), (20, 3));
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()))
        .read_info()
        .unwrap();
    let mut frames = [const { Vec::new() }; 3];
    for frame in &mut frames {
        frame.resize(20 * 20 * 3, 0);
        reader.next_frame(frame).unwrap();
    }
    // A third of a turn about a line through the middle of a face is no symmetry of a cube.
    assert!(frames[0] != frames[1] && frames[1] != frames[2]);
}

#[test]
fn a_view_of_nothing_is_a_warning() {
    let directory = directory_with("a.obj", CUBE);
    for line in ["render a.obj", "check a.obj", "check a.obj --json --frames 3"] {
        let output = run(directory.path(), &format!("{line} --near 10 --far 20"));
        assert_eq!(output.status.code(), Some(0), "{line}");
        let complaint = text(&output.stderr);
        assert!(complaint.starts_with("warning: no pixel shows anything of a.obj"), "{complaint}");
        if line.contains("json") {
            let json: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(json["arithmetic"]["pixels"], 0);
            assert_eq!(json["end_to_end"]["coverage_mismatches"], 0);
            assert_eq!((&json["within_bounds"], &json["frame"]), (&true.into(), &0.into()));
            assert_eq!(json["places"]["judged"], 320 * 240);
        }
    }
}

#[test]
fn check_prints_one_json_object_and_writes_three_pictures() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    let line = "check a.obj --json --frames 3 --size 40x30 --depth u32 --subpixel 4 --shading flat";
    let json: Value = serde_json::from_str(&succeed(path, line)).unwrap();
    assert_eq!((&json["model"], &json["triangles"]), (&"a.obj".into(), &12.into()));
    assert_eq!(json["frames"], 3);
    assert!(json["frame"].as_u64().unwrap() < 3);
    assert_eq!(
        (&json["within_bounds"], &json["bounds"]["coverage_mismatches"]),
        (&true.into(), &0.into())
    );
    let settings = &json["settings"];
    assert_eq!(settings["size"], serde_json::json!([40, 30]));
    assert_eq!((&settings["depth"], &settings["subpixel"]), (&"u32".into(), &4.into()));
    assert_eq!((&settings["shading"], &settings["fov"]), (&"flat".into(), &40.0.into()));
    for key in ["distance", "near", "far", "yaw", "pitch", "roll"] {
        assert!(settings[key].is_f64(), "{key}");
    }
    for side in ["arithmetic", "end_to_end"] {
        let comparison = &json[side];
        assert!(comparison["pixels"].as_u64() > Some(100), "{comparison}");
        assert!(comparison["coverage_mismatches"].is_u64());
        for key in [
            "depth_max_ulp",
            "depth_rms_ulp",
            "color_max_error",
            "vertex_error_max_px",
            "fixed_ms",
            "reference_ms",
        ] {
            assert!(comparison[key].is_f64(), "{side}.{key}");
        }
        assert!(comparison["psnr_db"].is_f64() || comparison["psnr_db"].is_null());
    }
    for side in ["arithmetic", "end_to_end"] {
        let worst = &json[side]["vertex_worst"];
        assert!(worst["vertex"].as_u64() < Some(24), "{worst}");
        // Of S4: 5/8 of a 16th, and half a quantum more.
        let bound = worst["bound_px"].as_f64().unwrap();
        assert!((0.0390625..0.04).contains(&bound) && worst["error_px"].as_f64() <= Some(bound));
    }
    let places = &json["places"];
    assert!(places["judged"].as_u64() > Some(1_100) && places["judged"].as_u64() <= Some(1_200));
    assert_eq!((&places["wrong"], &places["first"]), (&0.into(), &Value::Null));
    for picture in ["fixed", "reference", "difference"] {
        let name = json["pictures"][picture].as_str().unwrap();
        assert_eq!(name, format!("a-check/{picture}.png"));
        let (width, height, ..) = decode(&path.join(name));
        assert_eq!((width, height), (40, 30));
    }
    let (fixed, reference) =
        (decode(&path.join("a-check/fixed.png")).3, decode(&path.join("a-check/reference.png")).3);
    let differing = fixed.iter().zip(&reference).filter(|(a, b)| a.abs_diff(**b) > 2).count();
    // A few pixels at edges; an upside-down or shifted picture differs in hundreds.
    assert!(differing < fixed.len() / 50, "{differing} of {} bytes", fixed.len());

    fs::create_dir(path.join("target")).unwrap();
    let json: Value =
        serde_json::from_str(&succeed(path, "check a.obj --json --orthographic 2 --size 9x9"))
            .unwrap();
    assert_eq!(json["pictures"]["fixed"], "target/check/a/fixed.png");
    assert_eq!(
        (&json["settings"]["height"], &json["settings"]["fov"]),
        (&2.0.into(), &Value::Null)
    );
    succeed(path, "check a.obj --size 9x9 --pictures seen");
    assert!(path.join("seen/difference.png").is_file());
}

#[test]
fn check_prints_a_table_with_bounds() {
    let directory = directory_with("a.obj", CUBE);
    let table = succeed(directory.path(), "check a.obj --frames 2");
    for part in [
        "Arithmetic",
        "End to end",
        "Coverage mismatches",
        "PSNR",
        "Pixels judged by their place",
        "Wrong pixels among these",
        "0 ok",
        "1 ok",
        "The worst of 2 frames",
    ] {
        assert!(table.contains(part), "{part}: {table}");
    }
    assert!(!table.contains('\u{1b}'), "colours in a pipe");
}

#[test]
fn plan_writes_a_renderer_and_says_why() {
    let directory = directory_with("cube.obj", CUBE);
    let line = "plan cube.obj --display 64x48 --steps 8 --explain";
    let output = succeed(directory.path(), line);
    for expected in ["the mesh is convex", "proven for all views", "everything on", "Not taken"] {
        assert!(output.contains(expected), "{expected} in {output}");
    }
    let source = fs::read_to_string(directory.path().join("cube_plan.rs")).unwrap();
    for expected in ["pub fn draw<", "pub struct Memory", "pub static CUBE", "const STEPS: u32 = 8"]
    {
        assert!(source.contains(expected), "{expected} in {source}");
    }
    // As one object, and to the standard output.
    let json = succeed(directory.path(), "plan cube.obj --display 64x48 --steps 8 --json");
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["chosen"]["types"]["visibility"], "mesh-order");
    assert_eq!(json["views"], 8);
    assert!(json["flash_bytes"].as_u64().unwrap() > 1_000);
    assert_eq!(succeed(directory.path(), "plan cube.obj --display 64x48 --steps 8 -o -"), source);
}

#[test]
fn plan_takes_a_filter() {
    let directory = tempfile::tempdir().unwrap();
    let crate_model = concat!(env!("CARGO_MANIFEST_DIR"), "/models/wooden_crate.obj");
    for (options, filter) in [
        ("", "Nearest,"),
        ("--filter nearest --mipmaps no", "Nearest,"),
        ("--filter bilinear --mipmaps no", "Bilinear,"),
        ("--mipmaps yes", "NearestMip<PerTriangle>,"),
        ("--filter bilinear --mipmaps yes", "BilinearMip<PerTriangle>,"),
    ] {
        let line = format!("plan {crate_model} --ram 400K --steps 2 -o - {options}");
        let source = succeed(directory.path(), &line);
        let shading = source.lines().find(|line| line.starts_with("type Shading")).unwrap();
        assert!(shading.contains(&format!(", {filter}")), "{options}: {shading}");
    }
}

#[test]
fn plans_that_cannot_be_are_refused() {
    let directory = directory_with("cube.obj", CUBE);
    let path = directory.path();
    fs::write(path.join("views.txt"), "10 20 30\n10 20\n").unwrap();
    for (line, expected) in [
        ("plan cube.obj --ram 1K", "no renderer fits 1024 bytes"),
        ("plan cube.obj --steps 100", "power of two"),
        ("plan cube.obj --distance 1", "within the sphere"),
        ("plan cube.obj --views views.txt", "views.txt:2"),
        ("plan cube.obj --views nowhere.txt", "neither turntable nor orbit"),
        ("plan - --steps 8", "name a file"),
        ("plan cube.obj --ram 64KB", "64K"),
    ] {
        let error = refusal(path, line);
        assert!(error.contains(expected), "{line}: {error}");
    }
    // Too slow is no bad input: the renderer is written.
    let line = "plan cube.obj --display 64x48 --steps 8 --fps 1000 --clock 1MHz";
    let output = run(path, line);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("frames a second are expected"));
    assert!(path.join("cube_plan.rs").exists());
}

#[test]
fn without_a_command_everything_is_made() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    let names = |stem: &str| {
        [".rs", ".png", "-fixed.png", "-reference.png", "-difference.png"]
            .map(|ending| format!("target/{stem}{ending}"))
    };
    let told = succeed(path, "a.obj");
    for name in names("a") {
        assert!(path.join(&name).is_file() && told.contains(&name), "{name}: {told}");
    }
    assert!(told.contains("Coverage mismatches") && told.contains("draw `a::A`"), "{told}");
    let told = succeed(path, "");
    for name in names("wooden_crate").iter().chain(&names("rocket")) {
        assert!(path.join(name).is_file() && told.contains(name), "{name}: {told}");
    }
    assert!(told.contains("with `wooden_crate::WOODEN_CRATE_TEXTURES`"), "{told}");
    // The model, the directory and three times five files; nothing temporary.
    assert_eq!(files(path).len(), 17);
}

#[test]
fn bad_models_are_refused_with_path_and_line() {
    let directory = directory_with("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    let path = directory.path();
    fs::write(path.join("empty.obj"), "").unwrap();
    fs::write(path.join("nan.obj"), "v 0 0 0\nv NaN 0 0\n").unwrap();
    fs::create_dir(path.join("folder")).unwrap();
    for (model, part) in [
        ("missing.obj", "missing.obj: "),
        ("folder", "folder is a directory"),
        ("empty.obj", "empty.obj is empty"),
        ("range.obj", "range.obj:4: "),
        ("nan.obj", "nan.obj:2: "),
    ] {
        for command in ["convert", "render", "check", "check --json", ""] {
            let error = refusal(path, &format!("{command} {model}"));
            assert!(error.contains(part), "{command} {model}: {error}");
            assert_eq!(error.lines().count(), 1, "{error}");
        }
    }
}

#[test]
fn bad_arguments_are_refused() {
    let directory = directory_with("a.obj", CUBE);
    let path = directory.path();
    fs::create_dir(path.join("folder.rs")).unwrap();
    for (line, part) in [
        ("render a.obj --size 0x0", "--size"),
        ("render a.obj --size 2049x1", "--size"),
        ("check a.obj --distance NaN", "--distance"),
        ("check a.obj --fov inf", "--fov"),
        ("check a.obj --near 5 --far 2", "the far plane beyond it"),
        ("convert a.obj --crease 181", "--crease"),
        ("render a.obj --background red", "--background"),
        ("convert", "<MODEL>"),
        ("chek", "the commands are convert, render, check and plan"),
        ("chek a.obj", "the commands are convert, render, check and plan"),
        ("a.obj b.obj", "b.obj"),
        ("convert a.obj -o no/a.rs", "there is no directory no"),
        ("render a.obj -o no/a.png", "there is no directory no"),
        ("check a.obj --pictures no/where", "there is no directory no"),
        ("check a.obj --pictures a.obj", "a.obj is not a directory"),
        ("convert a.obj -o folder.rs", "folder.rs is a directory"),
        ("convert a.obj --texture-coordinates", "no texture coordinates"),
    ] {
        let error = refusal(path, line);
        assert!(error.contains(part), "{line}: {error}");
    }
}

#[test]
#[cfg(unix)]
fn devices_are_not_replaced() {
    let directory = directory_with("a.obj", CUBE);
    std::os::unix::fs::symlink("/dev/null", directory.path().join("null")).unwrap();
    let error = refusal(directory.path(), "convert a.obj --force -o null");
    assert!(error.contains("null is not an ordinary file"), "{error}");
}

#[test]
#[cfg(target_os = "linux")]
fn paths_need_not_be_utf8() {
    use std::os::unix::ffi::OsStrExt as _;
    let directory = tempfile::tempdir().unwrap();
    let name =
        |ending: &[u8]| std::ffi::OsStr::from_bytes(&[b"caf\xE9", ending].concat()).to_owned();
    fs::write(directory.path().join(name(b".obj")), CUBE).unwrap();
    for command in ["convert", "render", "check"] {
        let output = program(directory.path()).arg(command).arg(name(b".obj")).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    }
    for result in [name(b".rs"), name(b".png"), name(b"-check/fixed.png")] {
        assert!(directory.path().join(&result).is_file(), "{}", result.display());
    }
    let output =
        program(directory.path()).args(["check", "--json"]).arg(name(b".obj")).output().unwrap();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["model"], "caf\u{FFFD}.obj");
}

#[test]
fn a_closed_pipe_is_not_an_error() {
    let directory = directory_with("a.obj", CUBE);
    for line in ["convert a.obj", "check a.obj --json", "a.obj", "--help"] {
        let mut child = program(directory.path())
            .args(line.split_whitespace())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let mut complaint = String::new();
        child.stderr.take().unwrap().read_to_string(&mut complaint).unwrap();
        assert_eq!((child.wait().unwrap().code(), complaint.as_str()), (Some(0), ""), "{line}");
    }
}

#[test]
fn help_shows_examples() {
    let directory = tempfile::tempdir().unwrap();
    for line in ["--help", "convert --help", "render --help", "check --help"] {
        let help = succeed(directory.path(), line);
        assert!(help.contains("Examples:\n  host-tools"), "{help}");
    }
}

#[test]
fn the_worst_frame_is_the_one_reported() {
    // A wedge with a steep slope: the faces of a cube all look the same.
    let wedge =
        "v -1 -1 -1\nv 1 -1 -0.7\nv 0.3 1 -1\nv 0.1 0.2 1.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let directory = directory_with("a.obj", wedge);
    let check = |line: &str| -> Value {
        let line = format!("check a.obj --json --subpixel 4 --size 200x150 {line}");
        serde_json::from_str(&succeed(directory.path(), &line)).unwrap()
    };
    let badness = |json: &Value| {
        ["arithmetic", "end_to_end"].map(|side| {
            ["coverage_mismatches", "color_max_error", "depth_max_ulp"]
                .map(|key| json[side][key].as_f64().unwrap())
        })
    };
    let single: Vec<_> =
        [30, 102, 174, 246, 318].map(|yaw| badness(&check(&format!("--yaw {yaw}")))).into();
    let worst = check("--frames 5");
    let frame = worst["frame"].as_u64().unwrap() as usize;
    assert_eq!(badness(&worst), single[frame]);
    assert!(single.iter().all(|other| *other <= single[frame]), "{frame} of {single:?}");
    assert!(
        single.iter().any(|other| *other != single[frame]),
        "{single:?} leave nothing to choose"
    );
}
