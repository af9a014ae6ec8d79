//! Textures of materials, from the picture to the tables.

use png::{BitDepth::Eight, ColorType};

use super::{
    super::textures::encoded,
    load_files, parsed,
    reading::{one_warning, with_library},
    *,
};

/// Two triangles that share an edge, one of each material.
const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                   usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";

/// Four pixels: red, green, blue and, below, white. The file's first row is the upper one.
fn picture() -> Vec<u8> {
    let pixels = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
    encoded([2, 2], ColorType::Rgb, Eight, &pixels)
}

fn converted(library: &str, options: &Options) -> Result<Model, ModelError> {
    let files: [(&str, &[u8]); 3] =
        [("m.obj", OBJ.as_bytes()), ("a.mtl", library.as_bytes()), ("my wood.png", &picture())];
    load_files(&files, options)
}

fn with(textures: TextureOptions) -> Options {
    Options { textures: Some(textures), ..Options::default() }
}

#[test]
fn a_material_has_its_picture_as_texture() {
    let library = "newmtl a\nmap_Kd C:\\art\\my wood.png # dark\nnewmtl b\nKd 0 0 1\n";
    let model = converted(library, &Options::default()).unwrap();
    assert_eq!(model.warnings, [""; 0]);
    let textures = model.textures.as_ref().unwrap();
    assert_eq!((textures.size, textures.wrap), ([2, 2], [TextureWrap::Repeat; 2]));
    assert_eq!(textures.by_material, [Some(0), None]);
    assert_eq!((textures.alpha, textures.mipmaps), (None, false));
    let texture = &textures.textures[0];
    let texels: Vec<[f64; 4]> = (0..4).map(|texel| texture.rgba(texel)).collect();
    let [red, green, blue] = [[255.0, 0.0, 0.0], [0.0, 255.0, 0.0], [0.0, 0.0, 255.0]];
    let opaque = |[r, g, b]: [f64; 3]| [r, g, b, 255.0];
    assert_eq!(texels, [red, green, blue, [255.0; 3]].map(opaque));
    assert_eq!(texture.original.rgba(1, 0), opaque(green));
    assert_eq!(texture.psnr_db, f64::INFINITY);
    // Its coordinates come without being asked for, and the file's v runs upwards.
    assert!(model.options.contents.texture_coordinates);
    assert!(model.exact.texture_coordinates.contains(&[0.0, 1.0]));
    assert_eq!(model.report.flash.textures, 4 + 256 * 2);
    let names: Vec<&str> = model.provenance.iter().map(|file| &file.file_name[..]).collect();
    assert_eq!(names, ["m.obj", "a.mtl", "my wood.png"]);
    assert!(model.inputs[2].ends_with("my wood.png"));
}

#[test]
fn options_of_the_map_place_and_end_it() {
    let library = "newmtl a\nmap_Kd -clamp on -s 2 3 1 -o 0.5 -1 my wood.png\nnewmtl b\nKd 0 0 1\n";
    let model = converted(library, &Options::default()).unwrap();
    // (0, 0) and (1, 1) become (0.5, -1) and (2.5, 2), and v is turned. The second triangle has the
    // same corners with the coordinates of the file.
    let exact = &model.exact.texture_coordinates;
    for expected in [[0.5, 2.0], [2.5, 2.0], [2.5, -1.0], [0.0, 1.0], [1.0, 0.0], [0.0, 0.0]] {
        assert!(exact.contains(&expected), "{expected:?} in {exact:?}");
    }
    assert_eq!(model.positions.len(), 6);
    // A texture that ends at its borders cannot be moved, and 2.5 does not fit 16 bits.
    assert_eq!(model.textures.as_ref().unwrap().wrap, [TextureWrap::Clamp; 2]);
    assert!(matches!(model.texture_coordinates, TextureTable::I32(_)));
    let repeated = converted(&library.replace("-clamp on", ""), &Options::default()).unwrap();
    assert!(matches!(repeated.texture_coordinates, TextureTable::I16(_)));

    let library = "newmtl a\nmap_Kd -mm 0 2 -cc on my wood.png\nnewmtl b\nKd 0 0 1\n";
    let model = converted(library, &Options::default()).unwrap();
    one_warning(&model, &["a.mtl:2: 2 options of `map_Kd` without effect", "`-mm`, `-cc`"]);
}

#[test]
fn materials_with_one_picture_share_its_tables() {
    let library = "newmtl a\nmap_Kd my wood.png\nnewmtl b\nmap_Kd -clamp on .\\my wood.png\n";
    let model = converted(library, &Options::default()).unwrap();
    one_warning(&model, &["m.obj: 1 of 2 textures end at their borders"]);
    let textures = model.textures.unwrap();
    assert_eq!(textures.by_material, [Some(0), Some(0)]);
    assert_eq!(model.inputs.len(), 3);
}

#[test]
fn textures_of_a_mesh_get_one_size_and_format() {
    let files: [(&str, &[u8]); 4] = [
        ("m.obj", OBJ.as_bytes()),
        ("a.mtl", b"newmtl a\nmap_Kd my wood.png\nnewmtl b\nmap_Kd b.jpg\n"),
        ("my wood.png", &picture()),
        ("b.jpg", include_bytes!("red_blue.jpg")),
    ];
    let mipmaps = TextureOptions { mipmaps: true, ..TextureOptions::default() };
    let model = load_files(&files, &with(mipmaps)).unwrap();
    let textures = model.textures.unwrap();
    assert_eq!(textures.by_material, [Some(0), Some(1)]);
    assert_eq!(textures.size, [16, 8]);
    assert_eq!(textures.levels(), [[16, 8], [8, 4], [4, 2], [2, 1], [1, 1]]);
    for texture in &textures.textures {
        assert_eq!(texture.texels.len(), 128 + 32 + 8 + 2 + 1);
    }
    // The colours of the JPEG file, within what its compression and RGB565 leave.
    let jpeg = &textures.textures[1];
    for (texel, exact) in [(0, [200.0, 40.0, 20.0]), (15, [30.0, 60.0, 220.0])] {
        let color = jpeg.rgba(texel);
        assert!((0..3).all(|i| (color[i] - exact[i]).abs() < 9.0), "{color:?} for {exact:?}");
    }
    let odd = TextureOptions { size: Some([16, 12]), ..TextureOptions::default() };
    let error = load_files(&files, &with(odd)).unwrap_err().to_string();
    assert!(
        error.ends_with(
            "16x12: the sides of textures that repeat are powers of two: choose \
                             another size"
        ),
        "{error}"
    );
}

#[test]
fn pictures_that_cannot_be_read_are_refused_where_they_are_named() {
    let refused = |name: &str| {
        let library = format!("newmtl a\nKd 1 1 1\nmap_Kd {name}\n");
        converted(&library, &Options::default()).unwrap_err().to_string()
    };
    for (name, parts) in [
        ("no.png", ["a.mtl:3: `map_Kd`: ", "no.png: ", "or convert without textures"]),
        ("C:\\x\\no.png", ["a.mtl:3: `map_Kd`: ", "x\\no.png: ", "check the path"]),
        ("m.obj", ["a.mtl:3: `map_Kd`: ", "m.obj is neither PNG nor JPEG", "save it as PNG"]),
        (".", ["a.mtl:3: `map_Kd`: ", " is a directory", "name the file in it"]),
    ] {
        let error = refused(name);
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
    // A material that no triangle has needs no picture.
    let library = "newmtl a\nKd 1 1 1\nnewmtl b\nKd 1 1 1\nnewmtl c\nmap_Kd no.png\n";
    assert!(converted(library, &Options::default()).unwrap().textures.is_none());
}

#[test]
fn a_texture_takes_the_place_of_kd() {
    let material = |kd: &str| {
        let library = format!("newmtl a\n{kd}map_Kd my wood.png\nnewmtl b\nKd 0 0 1\n");
        converted(&library, &Options::default()).unwrap()
    };
    // What draws without textures draws in the mean of the picture, in linear light: half of each
    // colour is stored as 188.
    for kd in ["", "Kd 0 0 0\n"] {
        let model = material(kd);
        assert_eq!(model.warnings, [""; 0]);
        assert_eq!(model.materials[0].color, [188; 3]);
        assert_eq!(model.exact.faces.faces[0].color, [188; 3]);
    }
    let grey = material("Kd 0.8 0.8 0.8\n");
    assert_eq!((&grey.warnings[..], grey.materials[0].color), (&[][..], [204; 3]));
    let tinted = material("Kd 1 0 0\n");
    one_warning(&tinted, &["a.mtl:2: 1 material has a coloured `Kd` beside a texture", "`a`"]);
    let colors = |model: &Model| {
        let texture = &model.textures.as_ref().unwrap().textures[0];
        [0, 1, 2, 3].map(|texel| texture.rgba(texel))
    };
    assert_eq!(colors(&tinted), colors(&grey));
}

#[test]
fn textures_are_left_out_where_they_cannot_or_shall_not_be() {
    let library = "newmtl a\nKd 1 1 1\nmap_Kd no.png\nnewmtl b\nKd 1 1 1\n";
    let without = Options { textures: None, ..Options::default() };
    let model = converted(library, &without).unwrap();
    one_warning(&model, &["a.mtl:3: 1 material has a texture (`map_Kd`), which is ignored: `a`"]);
    assert!(model.textures.is_none() && !model.options.contents.texture_coordinates);
    // Another shader may have a texture for the coordinates.
    let kept = Options { textures: None, ..textured() };
    assert_eq!(converted(library, &kept).unwrap().warnings, [""; 0]);
    let no_place = with_library(b"mtllib a.mtl\nusemtl a", "a.mtl", library.as_bytes());
    one_warning(&no_place, &["ignored as no face has texture coordinates: `a`"]);
    assert!(no_place.textures.is_none());
}

#[test]
fn coordinates_of_textures_must_be_numbers() {
    let obj = OBJ.replace("vt 1 1", "vt 1 nan");
    let load = |library: &[u8]| {
        load_files(
            &[("m.obj", obj.as_bytes()), ("a.mtl", library), ("my wood.png", &picture())],
            &Options::default(),
        )
    };
    let error = load(b"newmtl a\nmap_Kd my wood.png\n").unwrap_err().to_string();
    assert!(error.contains("m.obj:8: `nan` is not a finite number"), "{error}");
    assert_eq!(load(b"newmtl a\nKd 1 0 0\nnewmtl b\nKd 1 1 0\n").unwrap().warnings.len(), 1);
}

#[test]
fn emitted_textures_read_back_the_same() {
    let pixels: Vec<u8> = (0..8 * 8 * 4).map(|i| (i * 37 % 256) as u8).collect();
    let picture = encoded([8, 8], ColorType::Rgba, Eight, &pixels);
    let library = b"newmtl a\nmap_Kd -clamp on a.png\nnewmtl b\nKd 0 0 1\n";
    let files: [(&str, &[u8]); 3] =
        [("m.obj", OBJ.as_bytes()), ("a.mtl", library), ("a.png", &picture)];
    for (format, color, alpha, declared) in [
        (
            TexelFormat::Indexed4,
            ColorFormat::Rgb565Be,
            AlphaFormat::Bits4,
            "::rasterizer::texture::Masked<'static, ::rasterizer::texture::Indexed<'static, \
             ::rasterizer::output::Rgb565Be, 4, 43, 16>, 4, 43>",
        ),
        (
            TexelFormat::Indexed8,
            ColorFormat::Rgb888,
            AlphaFormat::Key,
            "::rasterizer::texture::Keyed<::rasterizer::texture::Indexed<'static, \
             ::rasterizer::embedded_graphics_core::pixelcolor::Rgb888, 8, 85, 256>>",
        ),
        (
            TexelFormat::Direct,
            ColorFormat::Gray8,
            AlphaFormat::Bits1,
            "::rasterizer::texture::Masked<'static, ::rasterizer::texture::Colors<'static, \
             ::rasterizer::embedded_graphics_core::pixelcolor::Gray8, 85>, 1, 11>",
        ),
        (
            TexelFormat::Direct,
            ColorFormat::Rgb332,
            AlphaFormat::Translucent4,
            "::rasterizer::texture::Translucent<'static, ::rasterizer::texture::Colors<'static, \
             ::rasterizer::color::Rgb332, 85>, 4, 43>",
        ),
    ] {
        let alpha = Some(alpha);
        let options = TextureOptions { size: None, format, color, mipmaps: true, alpha };
        let model = load_files(&files, &with(options)).unwrap();
        let texture = &model.textures.as_ref().unwrap().textures[0];
        let source = emit::source(&model);
        assert!(source.contains("pub static M_TEXTURES: [Option<MTexture>; 2] = {"), "{source}");
        let clamp = "::rasterizer::texture::Clamp";
        let declared = format!(
            "pub type MTexture = ::rasterizer::texture::Mipmaps<\n    {declared},\n    8, 8, \
             {clamp}, {clamp},\n>;"
        );
        assert!(source.contains(&declared), "{declared}\n{source}");
        assert!(source.contains("Some(MTexture::new(") && source.contains("        None,\n"));

        let numbers = |name: &str| parsed(&source, name);
        let expected =
            |numbers: &[u32]| -> Vec<i64> { numbers.iter().map(|&number| number.into()).collect() };
        let texels = match texture.packed() {
            Some(bytes) => bytes.into_iter().map(i64::from).collect(),
            None => expected(&texture.texels),
        };
        assert_eq!(numbers("TEXELS_0"), texels);
        assert_eq!(numbers("PALETTE_0"), expected(&texture.palette));
        let plane: Vec<i64> = texture.packed_alpha().into_iter().map(i64::from).collect();
        assert_eq!(numbers("ALPHA_0"), plane);
        assert_eq!(emit::source(&load_files(&files, &with(options)).unwrap()), source);
    }
}

#[test]
fn a_table_without_gaps_needs_no_options() {
    let library = "newmtl a\nmap_Kd my wood.png\nnewmtl b\nmap_Kd my wood.png\n";
    let source = emit::source(&converted(library, &Options::default()).unwrap());
    assert!(source.contains("pub static M_TEXTURES: [MTexture; 2] = {"), "{source}");
    let texture = "        MTexture::new(Indexed::new(&TEXELS_0, &PALETTE_0)),\n";
    assert!(source.contains(&texture.repeat(2)), "{source}");
}

#[test]
fn no_picture_makes_it_panic() {
    let mut generator = Random(7);
    let mut random = |below: usize| generator.snapped(0.0, (below - 1) as f64, 1.0) as usize;
    let png = encoded([9, 9], ColorType::Rgba, Eight, &[77; 324]);
    let jpeg = include_bytes!("red_blue.jpg");
    let (mut good, mut bad) = (0, 0);
    for round in 0..2_000 {
        let mut bytes = if round % 2 == 0 { png.clone() } else { jpeg.to_vec() };
        for _ in 0..=random(3) {
            let place = random(bytes.len());
            match random(4) {
                0 => bytes.truncate(place + 1),
                _ => bytes[place] = random(256) as u8,
            }
        }
        match Picture::decode(&bytes) {
            Ok(picture) => {
                assert_eq!(picture.pixels.len(), picture.size[0] * picture.size[1]);
                good += 1;
            }
            Err(fault) => {
                assert!(fault.contains(": "), "{fault}");
                bad += 1;
            }
        }
    }
    assert!(good > 100 && bad > 100, "{good} good and {bad} bad files test only one way out");
}
