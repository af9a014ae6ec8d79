//! Runs every example, and compares its picture with the one in `examples/pictures`.

#![expect(clippy::duplicate_mod, reason = "each example is a program, with its own modules")]

use std::{
    env,
    fmt::Debug,
    fs,
    io::{BufRead, BufReader, Cursor, Seek},
    path::{Path, PathBuf},
};

/// The examples. Each has a function `draw`, and becomes a test that calls it.
macro_rules! examples {
    ($($name:ident = $source:literal,)*) => {
        $(
            #[path = $source]
            #[expect(dead_code, reason = "its main is not called")]
            pub mod $name;

            #[test]
            fn $name() {
                let mut screen = Default::default();
                $name::draw(&mut screen).expect("the example runs");
                check(stringify!($name), &screen.rgb(), || screen.png());
            }
        )*

        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

examples! {
    any_shape = "../examples/any_shape.rs",
    backgrounds = "../examples/backgrounds.rs",
    bands = "../examples/bands.rs",
    billboards = "../examples/billboards.rs",
    blending = "../examples/blending.rs",
    blending_modes = "../examples/blending_modes.rs",
    clip_planes = "../examples/clip_planes.rs",
    clouds = "../examples/clouds.rs",
    cutout = "../examples/cutout.rs",
    depth_formats = "../examples/depth_formats.rs",
    direct = "../examples/direct.rs",
    dirty_rectangle = "../examples/dirty_rectangle.rs",
    discard = "../examples/discard.rs",
    dithering = "../examples/dithering.rs",
    dma_stream = "../examples/dma_stream.rs",
    filters = "../examples/filters.rs",
    flat = "../examples/flat.rs",
    fog = "../examples/fog.rs",
    glass = "../examples/glass.rs",
    glow = "../examples/glow.rs",
    gouraud = "../examples/gouraud.rs",
    highlights = "../examples/highlights.rs",
    keyframes = "../examples/keyframes.rs",
    lamp = "../examples/lamp.rs",
    lamp_shadow = "../examples/lamp_shadow.rs",
    lights = "../examples/lights.rs",
    lit_texture = "../examples/lit_texture.rs",
    matcap = "../examples/matcap.rs",
    materials = "../examples/materials.rs",
    model_file = "../examples/model_file.rs",
    needs = "../examples/needs.rs",
    oled = "../examples/oled.rs",
    own_output = "../examples/own_output.rs",
    own_shader = "../examples/own_shader.rs",
    painter = "../examples/painter.rs",
    particles = "../examples/particles.rs",
    parts = "../examples/parts.rs",
    per_object = "../examples/per_object.rs",
    perspective_modes = "../examples/perspective_modes.rs",
    points = "../examples/points.rs",
    projections = "../examples/projections.rs",
    robot_arm = "../examples/robot_arm.rs",
    scissor = "../examples/scissor.rs",
    several_objects = "../examples/several_objects.rs",
    shadows = "../examples/shadows.rs",
    shaped = "../examples/shaped.rs",
    shapes = "../examples/shapes.rs",
    smooth_lines = "../examples/smooth_lines.rs",
    supersampling = "../examples/supersampling.rs",
    text_over_picture = "../examples/text_over_picture.rs",
    texture_borders = "../examples/texture_borders.rs",
    textured = "../examples/textured.rs",
    unlit = "../examples/unlit.rs",
    vertex_colors = "../examples/vertex_colors.rs",
    viewports = "../examples/viewports.rs",
    visibility = "../examples/visibility.rs",
    walk = "../examples/walk.rs",
    wave = "../examples/wave.rs",
    wireframe = "../examples/wireframe.rs",
}

/// With this variable set, pictures are renewed before they are compared.
const UPDATE: &str = "UPDATE_PICTURES";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")
}

/// Compares what an example drew with the picture that is kept, a PNG file.
fn check<E: Debug>(name: &str, drawn: &[u8], png: impl FnOnce() -> Result<Vec<u8>, E>) {
    let path = folder().join("pictures").join(name).with_extension("png");
    if env::var_os(UPDATE).is_some() {
        fs::write(&path, png().expect("a picture")).expect("the pictures can be written");
    }
    let kept = fs::File::open(&path).expect("the example's picture is kept");
    let kept = frames(BufReader::new(kept));
    assert_eq!(kept.len(), 1, "{} moves", path.display());
    let (drawn, kept) = (drawn.as_chunks::<3>().0, kept[0].as_chunks::<3>().0);
    let different = drawn.iter().zip(kept).filter(|(drawn, kept)| drawn != kept).count();
    assert!(
        different == 0 && drawn.len() == kept.len(),
        "{different} pixels differ from {}. See what `cargo run -p rasterizer --example {name}` \
         draws; `{UPDATE}=1 cargo test -p rasterizer --test examples` keeps it",
        path.display(),
    );
}

/// Red, green and blue of all pixels of each frame of a PNG file.
fn frames(file: impl BufRead + Seek) -> Vec<Vec<u8>> {
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG file");
    let count = reader.info().animation_control().map_or(1, |animation| animation.num_frames);
    let size = reader.output_buffer_size().expect("its size");
    let frame = |_| {
        let mut bytes = vec![0; size];
        reader.next_frame(&mut bytes).expect("its pixels");
        bytes
    };
    (0..count).map(frame).collect()
}

/// The moving picture of the documentation has all frames as they are drawn.
#[test]
fn the_walk_moves() {
    let path = folder().join("pictures/walk_moving.png");
    let drawn = walk::moving_picture().expect("the walk is drawn");
    if env::var_os(UPDATE).is_some() {
        fs::write(&path, &drawn).expect("the pictures can be written");
    }
    let kept = fs::read(&path).expect("the moving picture is kept");
    let [drawn, kept] = [drawn, kept].map(|file| frames(Cursor::new(file)));
    assert!(drawn.len() == 24 && drawn[0] != drawn[12], "it moves");
    assert!(drawn == kept, "`{UPDATE}=1 cargo test -p rasterizer --test examples` keeps it");
}

/// Cargo finds examples by their files; this test's list and the README's tables are written.
#[test]
fn every_example_is_in_the_list_and_in_the_readme() {
    let mut found: Vec<String> = fs::read_dir(folder())
        .expect("the folder of examples can be read")
        .map(|entry| entry.expect("its entries can be read").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    found.sort_unstable();
    assert_eq!(found, NAMES);

    let readme = include_str!("../examples/README.md");
    for name in NAMES {
        for link in [format!("![{name}](pictures/{name}.png)"), format!("[`{name}`]({name}.rs)")] {
            assert!(readme.contains(&link), "examples/README.md lacks {link}");
        }
    }
}
