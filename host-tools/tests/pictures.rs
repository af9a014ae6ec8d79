//! `render`: cameras, backgrounds, animations, several models and fewer triangles.

use std::{fs, io::BufReader};

use tempfile::TempDir;

mod frames;
mod program;

use frames::{picture, png_frames};
use program::{refuse, run, succeed};

/// A cube whose faces have six colours.
fn cube() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    let mut text =
        "mtllib m.mtl\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\n\
                    v 1 1 1\nv -1 1 1\n"
            .to_owned();
    let mut library = String::new();
    let faces = [
        ("back", "1 4 3 2", "1 1 0"),
        ("front", "5 6 7 8", "1 0 0"),
        ("bottom", "1 2 6 5", "0 1 1"),
        ("right", "2 3 7 6", "0 0 1"),
        ("top", "3 4 8 7", "0 1 0"),
        ("left", "4 1 5 8", "1 0 1"),
    ];
    for (name, face, color) in faces {
        text += &format!("usemtl {name}\nf {face}\n");
        library += &format!("newmtl {name}\nKd {color}\n");
    }
    fs::write(directory.path().join("a.obj"), text).unwrap();
    fs::write(directory.path().join("m.mtl"), library).unwrap();
    directory
}

fn pixel(picture: &[u8], width: usize, [x, y]: [usize; 2]) -> [u8; 3] {
    let first = 3 * (y * width + x);
    picture[first..first + 3].try_into().unwrap()
}

#[test]
fn an_eye_sees_the_face_that_it_looks_at() {
    let directory = cube();
    let unlit = "render a.obj --shading unlit --size 21x21";
    for (eye, up, color) in [
        ("0,0,4", "0,1,0", [255, 0, 0]),
        ("0,0,-4", "0,1,0", [255, 255, 0]),
        ("4,0,0", "0,1,0", [0, 0, 255]),
        ("-4,0,0", "0,0,1", [255, 0, 255]),
        ("0,4,0", "0,0,-1", [0, 255, 0]),
        ("0,-4,0", "1,0,0", [0, 255, 255]),
    ] {
        let line = format!("{unlit} --eye {eye} --up {up} --target 0,0,0");
        assert_eq!(pixel(&picture(directory.path(), &line), 21, [10, 10]), color, "{line}");
    }
    // In units of the file the cube is larger, so the same eye sees more of its face.
    let count = |line: &str| {
        let picture = picture(directory.path(), &format!("{unlit} --eye 0,0,4 {line}"));
        picture.chunks_exact(3).filter(|&pixel| pixel == [255, 0, 0]).count()
    };
    assert!(count("--keep-units") > 2 * count(""));
    refuse(directory.path(), "render a.obj --eye 0,0,4 --yaw 3", "cannot be used with");
    refuse(directory.path(), "check a.obj --eye 0,0,4 --distance 3", "cannot be used with");
    refuse(directory.path(), "render a.obj --target 0,0,4", "--eye");
    refuse(directory.path(), "render a.obj --eye 0,4,0 -o b.png", "direction");
    let checked = run(directory.path(), "check a.obj --eye 1,2,3 --target 0,.1,0 --up 0,1,.2");
    assert_eq!(checked.status.code(), Some(0));
}

#[test]
fn frames_of_an_animation_are_the_single_pictures() {
    let directory = cube();
    let path = directory.path();
    succeed(path, "render a.obj --size 24x20 --frames 4 --yaw 10 -o turn.png --fps 8");
    let (frames, delay) = png_frames(&path.join("turn.png"));
    assert_eq!((frames.len(), delay), (4, Some([1, 8])));
    for (frame, yaw) in frames.iter().zip([10, 100, 190, 280]) {
        assert_eq!(*frame, picture(path, &format!("render a.obj --size 24x20 --yaw {yaw}")));
    }
}

#[test]
fn a_gif_is_a_turntable_in_colors_near_those_of_pictures() {
    let directory = cube();
    let path = directory.path();
    let told = succeed(path, "render a.obj -o turn.gif --size 24x20 --background 102030..a0b0c0");
    assert!(told.contains("24x20 pixels, 36 frames"), "{told}");
    let decode = || {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        options.read_info(BufReader::new(fs::File::open(path.join("turn.gif")).unwrap())).unwrap()
    };
    let mut decoder = decode();
    assert_eq!((decoder.width(), decoder.height()), (24, 20));
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    let (mut count, mut time) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        time += u32::from(frame.delay);
        if count == 9 {
            // A quarter of a turn on from 30 degrees.
            let line = "render a.obj --size 24x20 --background 102030..a0b0c0 --yaw 120";
            let exact = picture(path, line);
            for (found, exact) in frame.buffer.chunks_exact(4).zip(exact.chunks_exact(3)) {
                let off = found.iter().zip(exact).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
                // The 20 colours of the gradient, and up to 256 levels of six others, share 256
                // places: a step is at most 6 * 256 / 236 = 6.5 levels, and a colour is off by half
                // of it.
                assert!(off <= 4, "{found:?} {exact:?}");
            }
        }
        count += 1;
    }
    assert_eq!((count, time), (36, 300), "a turn takes 3 s");

    succeed(path, "render a.obj -o turn.gif --size 24x20 --frames 5 --fps 30");
    let mut decoder = decode();
    let delays: Vec<u16> =
        std::iter::from_fn(|| decoder.read_next_frame().unwrap().map(|frame| frame.delay))
            .collect();
    // They begin at 0, 3.33, 6.67, 10, 13.33 and 16.67 hundredths, rounded.
    assert_eq!(delays, [3, 4, 3, 3, 4]);
}

#[test]
fn other_formats_and_foreign_files_are_refused() {
    let directory = cube();
    let path = directory.path();
    for name in ["a.jpg", "a.mp4", "turn", "a.gif.obj"] {
        refuse(path, &format!("render no.obj -o {name}"), "the ending .png or .gif");
    }
    refuse(path, "render a.obj --fps 10", "--frames");
    refuse(path, "render a.obj --frames 4 --fps 51", "--fps");
    fs::write(path.join("theirs.gif"), b"GIF89a and more").unwrap();
    refuse(path, "render a.obj -o theirs.gif", "is not from this program");
    fs::write(path.join("sky.png"), fs::read(path.join("a.obj")).unwrap()).unwrap();
    refuse(path, "render a.obj --background sky.png -o b.png", "neither PNG nor JPEG");
    refuse(path, "render a.obj --background sky.png -o sky.png --force", "is the input sky.png");
}

#[test]
fn backgrounds_are_gradients_and_pictures() {
    let directory = cube();
    let path = directory.path();
    let gradient = "--background #000a14..#646e78";
    let drawn = picture(path, &format!("render a.obj --size 9x11 --distance 30 {gradient}"));
    for (row, part) in [(0, 0), (5, 50), (10, 100)] {
        assert_eq!(pixel(&drawn, 9, [0, row]), [0, 10, 20].map(|c: u8| c + part), "{row}");
    }
    // A picture of another size fills the whole one: 11 rows become 33, of the middle columns.
    fs::rename(path.join("one.png"), path.join("sky.png")).unwrap();
    let drawn = picture(path, "render a.obj --size 21x33 --distance 30 --background sky.png");
    for (row, part) in [(0, 0), (2, 0), (15, 50), (17, 50), (32, 100)] {
        assert_eq!(pixel(&drawn, 21, [0, row]), [0, 10, 20].map(|c: u8| c + part), "{row}");
    }
}

#[test]
fn several_models_stand_in_one_picture() {
    let directory = cube();
    let path = directory.path();
    let scene = "render a.obj@-1,0,0,0.5 a.obj@1,0,0,0.5,90 a.obj@0,0,-20 --shading unlit \
                 --size 41x21 --eye 0,0,4";
    let drawn = picture(path, scene);
    // The second one shows its left side, turned by 90 degrees about y.
    assert_eq!(pixel(&drawn, 41, [13, 10]), [255, 0, 0]);
    assert_eq!(pixel(&drawn, 41, [27, 10]), [255, 0, 255]);
    assert_eq!(pixel(&drawn, 41, [20, 10]), [255, 0, 0], "far away in the middle");
    refuse(path, "render a.obj@1,2 -o b.png", "@x,y,z");
    refuse(path, "render a.obj b.obj@1,2,3 -o b.png", "b.obj");
    refuse(path, "render - - -o b.png", "give - only once");
    // A file may have such a name.
    fs::copy(path.join("a.obj"), path.join("a.obj@1,0,0")).unwrap();
    succeed(path, "render a.obj@1,0,0 -o named.png");
    let hidden = run(path, "render a.obj a.obj@0,0,-400 -o b.png");
    let warning = String::from_utf8(hidden.stderr).unwrap();
    assert!(warning.starts_with("warning: no pixel shows anything of a.obj"), "{warning}");
}

#[test]
fn ambient_light_is_what_the_dark_side_has() {
    let directory = cube();
    let path = directory.path();
    for (ambient, expected) in [("0", 0), ("0.5", 128), ("1", 255)] {
        let line = format!(
            "render a.obj --size 21x21 --eye 0,0,4 --light 0,0,-1 --shading flat --ambient {ambient}"
        );
        let [red, ..] = pixel(&picture(path, &line), 21, [10, 10]);
        assert!(red.abs_diff(expected) <= 1, "{line}: {red}");
    }
}

#[test]
fn simplified_models_are_converted_and_drawn() {
    let directory = cube();
    let path = directory.path();
    let mut text = String::new();
    let side = 20;
    for row in 0..=side {
        for column in 0..=side {
            let [x, y] = [column, row].map(|c| f64::from(c) / 10.0 - 1.0);
            text += &format!("v {x} {y} {}\n", (x * x + y * y) / -4.0);
        }
    }
    for row in 0..side {
        for column in 0..side {
            let first = 1 + row * (side + 1) + column;
            let [second, third, fourth] = [first + 1, first + side + 2, first + side + 1];
            text += &format!("f {first} {second} {third} {fourth}\n");
        }
    }
    fs::write(path.join("bowl.obj"), text).unwrap();
    let told = succeed(path, "convert bowl.obj --simplify 80");
    assert!(told.contains("Simplified from 800 triangles: the surfaces lie at most"), "{told}");
    let json: serde_json::Value =
        serde_json::from_str(&succeed(path, "convert bowl.obj --simplify 80 --json")).unwrap();
    let found = &json["simplification"];
    assert!(json["triangles"].as_u64() <= Some(80) && found["triangles_before"] == 800, "{json}");
    // A chord of a fifth of the bowl's width lies 0.4 * 0.4 / 4 / 4 = 0.01 from the parabola.
    let error = found["distance_max"].as_f64().unwrap();
    assert!(error > 1e-3 && error < 0.05, "{json}");
    // The picture is nearly the same.
    let [whole, few] =
        ["", "--simplify 80"].map(|s| picture(path, &format!("render bowl.obj --size 60x60 {s}")));
    let far = whole.iter().zip(&few).filter(|(a, b)| a.abs_diff(**b) > 40).count();
    assert!(whole != few && far < whole.len() / 20, "{far} of {}", whole.len());
    let checked = run(path, "check bowl.obj --simplify 80");
    assert_eq!(checked.status.code(), Some(0));
    refuse(path, "convert a.obj --simplify 11", "cannot be simplified to 11 triangles: 12");
    refuse(path, "convert a.obj --simplify 0", "--simplify");
}
