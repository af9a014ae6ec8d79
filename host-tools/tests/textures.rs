//! Textures as a user of the program converts them.

use std::{fs, path::Path, process::Command};

use serde_json::Value;

/// A square with a material.
const SQUARE: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                      usemtl a\nf 1/1 2/2 3/3 4/4\n";

/// Runs and expects an exit status. Returns the standard output of a success, and the complaint
/// of a refusal.
#[track_caller]
fn told(directory: &Path, line: &str, status: i32) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-tools"));
    let command = command.current_dir(directory).args(line.split_whitespace());
    let output = command.output().unwrap();
    let [out, complaint] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    assert_eq!(output.status.code(), Some(status), "{line}: {complaint}");
    if status == 0 { out } else { complaint }
}

#[test]
fn convert_tells_what_textures_cost_and_lose() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("a.obj"), SQUARE).unwrap();
    fs::write(path.join("a.mtl"), "newmtl a\nmap_Kd ramp.png\n").unwrap();
    let mut encoder = png::Encoder::new(fs::File::create(path.join("ramp.png")).unwrap(), 16, 16);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&std::array::from_fn::<u8, 256, _>(|i| i as u8)).unwrap();
    writer.finish().unwrap();

    let succeed = |line| told(path, line, 0);
    let refuse = |line| told(path, line, 2);
    let report = succeed("convert a.obj --texture-size 8x4 --texture-format indexed4 --mipmaps");
    for part in [
        "Textures: 8x4, indexed4, rgb565, 4 mip levels\n",
        "ramp.png: 54 bytes, from 16x16 pixels, ",
        " dB from it in that size\n",
        "Wrote a.rs: statics A and A_TEXTURES",
    ] {
        assert!(report.contains(part), "{part}: {report}");
    }
    let json = succeed("convert a.obj --json --texture-format gray8 --color gray8");
    let json: Value = serde_json::from_str(&json).unwrap();
    let texture = &json["textures"][0];
    assert_eq!((&texture["width"], &texture["levels"]), (&16.into(), &1.into()));
    // 256 texels and 256 greys of a byte each.
    assert_eq!((&texture["bytes"], &json["flash"]["textures"]), (&512.into(), &512.into()));
    assert_eq!(texture["psnr_db"], Value::Null);
    let report = succeed("convert a.obj --no-textures");
    assert!(report.contains("static A\n") && !report.contains("Texture"), "{report}");

    for (line, part) in [
        ("convert a.obj --texture-size 12x16", "the sides of textures that repeat are powers"),
        ("convert a.obj --texture-size 16", "write auto, or two numbers"),
        ("convert a.obj --texture-format rgb", "[possible values: "),
        ("convert a.obj --alpha 2", "--alpha"),
        ("convert a.obj --no-textures --mipmaps", "--no-textures"),
    ] {
        let error = refuse(line);
        assert!(error.contains(part), "{line}: {error}");
    }
    fs::remove_file(path.join("ramp.png")).unwrap();
    let error = refuse("convert a.obj");
    assert!(error.contains("a.mtl:2: `map_Kd`: ramp.png: "), "{error}");
}
