//! What the converter writes compiles, in every format of textures and with edges.

use std::{fs, path::Path};

use host_tools::model::{
    AlphaFormat, ColorFormat, Model, Options, TexelFormat, TextureOptions, emit,
};

use crate::compile_fail::compile;

/// A square with a material, and one without a picture.
const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                   usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";

/// A picture of four colours, of which one is half transparent.
fn picture() -> Vec<u8> {
    let texels: [[u8; 4]; 4] =
        [[250, 10, 0, 255], [0, 200, 30, 255], [0, 0, 90, 128], [255, 255, 255, 255]];
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 2, 2);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(texels.as_flattened()).unwrap();
    file
}

fn compiles(directory: &Path, options: TextureOptions) -> String {
    let textures = Some(options);
    let options = Options { textures, edges_degrees: Some(0.0), ..Options::default() };
    let model = Model::load(directory.join("a.obj"), &options).unwrap();
    let source = emit::source(&model);
    let file = directory.join("a.rs");
    fs::write(&file, format!("#![no_std]\n#![deny(warnings)]\n{source}")).unwrap();
    let output = compile(&file, &["--crate-type=lib"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}\n{source}");
    source
}

#[test]
fn textures_compile_in_every_format() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("written_tables");
    fs::create_dir_all(&directory).unwrap();
    for (name, contents) in [
        ("a.obj", OBJ.as_bytes()),
        ("a.mtl", b"newmtl a\nmap_Kd a.png\nnewmtl b\nKd 1 0 0\n"),
        ("a.png", &picture()),
    ] {
        fs::write(directory.join(name), contents).unwrap();
    }
    let formats = [TexelFormat::Direct, TexelFormat::Indexed2, TexelFormat::Gray4];
    for (i, (_, alpha)) in AlphaFormat::NAMES.into_iter().enumerate() {
        let (_, color) = ColorFormat::NAMES[i % ColorFormat::NAMES.len()];
        let options = TextureOptions {
            format: formats[i % 3],
            color,
            mipmaps: i % 2 == 1,
            alpha: Some(alpha),
            size: None,
        };
        let source = compiles(&directory, options);
        assert_eq!(source.contains("Translucent<"), alpha.is_translucent(), "{source}");
        assert!(source.contains("Segments::U8(&EDGES)"), "{source}");
    }
    // The colours of one byte, and those without any transparency.
    for format in [TexelFormat::Direct, TexelFormat::Indexed8] {
        let (color, alpha) = (ColorFormat::Rgb332, Some(AlphaFormat::Translucent8));
        compiles(&directory, TextureOptions { format, color, alpha, ..TextureOptions::default() });
    }
}

/// With faces and without, in both types of indices.
#[test]
fn lines_and_points_compile() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("written_lines");
    fs::create_dir_all(&directory).unwrap();
    let places =
        |count: u32| -> String { (0..count).map(|i| format!("v {i} 0 {}\n", i % 7)).collect() };
    let many: String = (1..300).map(|i| format!("l {i} {}\np {i}\n", i + 1)).collect();
    for (obj, index) in [
        (format!("{}f 1 2 3\nl 1 4\nl 4 5\np 1 2\n", places(5)), "U8(&LINES_0)"),
        (format!("{}l 1 2\n", places(2)), "U8(&LINES_0)"),
        (format!("{}{many}", places(300)), "U16(&POINTS_0)"),
    ] {
        fs::write(directory.join("a.obj"), obj).unwrap();
        let source = compiles(&directory, TextureOptions::default());
        assert!(source.contains(index), "{source}");
    }
}

/// Further shapes, with all normals, some and none.
#[test]
fn keyframes_compile() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("written_keyframes.rs");
    let shape = |z: u32| format!("v 0 0 0\nv 1 0 0\nv 0 1 {z}\nf 1 2 3\n");
    let [first, second, third] = [0, 1, 2].map(shape);
    for (vertex_normals, face_normals) in [(true, true), (false, true), (false, false)] {
        let mut options = Options::default();
        (options.contents.vertex_normals, options.contents.face_normals) =
            (vertex_normals, face_normals);
        let paths = ["a.obj", "b.obj", "c.obj"].map(Path::new);
        let further = [(paths[1], second.as_bytes()), (paths[2], third.as_bytes())];
        let model =
            Model::keyframes_from_bytes((paths[0], first.as_bytes()), &further, &options).unwrap();
        let source = emit::source(&model);
        fs::write(&file, format!("#![no_std]\n#![deny(warnings)]\n{source}")).unwrap();
        let output = compile(&file, &["--crate-type=lib"]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{told}\n{source}");
        assert!(source.contains("static FURTHER: [Keyframe<'static>; 2]"), "{source}");
    }
}
