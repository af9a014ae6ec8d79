//! The bench cube with a picture on each side, and the spotted cow with its picture, in the formats
//! that are measured.

use std::{
    error::Error,
    fmt::Write as _,
    fs::{self, File},
    io::BufWriter,
    path::Path,
};

use host_tools::model::{ColorFormat, Options, TexelFormat, Texture, TextureOptions};

use crate::convert;

/// Width and height of all textures.
const SIDE: u32 = 128;

/// The cube of `CUBE` with the whole picture on each side: 24 vertices.
const CUBE: &str = "\
     mtllib cube_texture.mtl\nusemtl sides\n\
     v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
     vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
     f 5/1 6/2 7/3 8/4\nf 6/1 2/2 3/3 7/4\nf 2/1 1/2 4/3 3/4\n\
     f 1/1 5/2 8/3 4/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";

/// How the textures of a model are stored: RGB565 in bus order, as the frames are.
const fn stored(format: TexelFormat, mipmaps: bool) -> Option<TextureOptions> {
    Some(TextureOptions {
        size: Some([SIDE as usize; 2]),
        format,
        color: ColorFormat::Rgb565Be,
        mipmaps,
        alpha: None,
    })
}

/// Writes the cube, its picture, and its tables.
pub(crate) fn cube(out: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let obj = out.join("cube_texture.obj");
    fs::write(&obj, CUBE)?;
    fs::write(out.join("cube_texture.mtl"), "newmtl sides\nmap_Kd cube_texture.png\n")?;
    picture(&out.join("cube_texture.png"))?;
    for (name, format, mipmaps) in [
        ("cube_texture", TexelFormat::Direct, false),
        ("cube_texture_8", TexelFormat::Indexed8, false),
        ("cube_texture_4", TexelFormat::Indexed4, false),
        ("cube_texture_mips", TexelFormat::Direct, true),
    ] {
        let textures = stored(format, mipmaps);
        let model = convert(out, &obj, name, Options { textures, ..options.clone() })?;
        if format == TexelFormat::Indexed8 {
            let textures = model.textures.as_ref().ok_or("the cube has no texture")?;
            shaded(out, &textures.textures[0])?;
        }
    }
    Ok(())
}

/// Writes the tables of the wooden crate once more, with mip levels.
pub(crate) fn wooden_crate(out: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let obj = Path::new("../../host-tools/models/wooden_crate.obj");
    let textures = Some(TextureOptions { mipmaps: true, ..TextureOptions::default() });
    convert(out, obj, "wooden_crate_mips", Options { textures, ..options.clone() })?;
    Ok(())
}

/// Writes the tables of the cow.
pub(crate) fn spot(out: &Path, folder: &Path, smooth: &Options) -> Result<(), Box<dyn Error>> {
    let obj = folder.join("spot_textured.obj");
    for (name, format) in
        [("spot_texture", TexelFormat::Direct), ("spot_texture_8", TexelFormat::Indexed8)]
    {
        let model = convert(
            out,
            &obj,
            name,
            Options { textures: stored(format, false), ..smooth.clone() },
        )?;
        for input in &model.inputs {
            println!("cargo::rerun-if-changed={}", input.display());
        }
    }
    Ok(())
}

/// Writes a picture with edges and slopes of all sizes and hues. None of its texels is so dark that
/// light turns it black, which is what counts as not drawn.
fn picture(path: &Path) -> Result<(), Box<dyn Error>> {
    let pixels: Vec<u8> = (0..SIDE * SIDE)
        .flat_map(|pixel| {
            let (x, y) = (pixel % SIDE, pixel / SIDE);
            [x ^ y, x, y].map(|value| 96 + value as u8)
        })
        .collect();
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(path)?), SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}

/// Writes the tables for `Shaded`: the texels' places, and the palette in 32 levels of light. Row i
/// has the channels times i / 31, rounded to the nearest.
fn shaded(out: &Path, texture: &Texture) -> Result<(), Box<dyn Error>> {
    const LEVELS: u32 = 32;
    let (places, colors) = (&texture.texels, texture.palette.len());
    let mut text = format!(
        "/// The texels of [`CUBE_TEXTURE_8`], places in a palette.\n#[rustfmt::skip]\n\
         pub static SHADED_TEXELS: [u8; {}] = {places:?};\n\
         /// Its palette from dark to bright.\n#[rustfmt::skip]\n\
         pub static SHADES: [[rasterizer::output::Rgb565Be; {colors}]; {LEVELS}] = [\n",
        places.len()
    );
    for level in 0..LEVELS {
        let lit = |channel: u32| (channel * level * 2 + LEVELS - 1) / (2 * (LEVELS - 1));
        let row = texture.palette.iter().map(|&number| {
            let [red, green, blue] = [number >> 11, number >> 5 & 63, number & 31].map(lit);
            format!("rasterizer::output::Rgb565Be::new({red}, {green}, {blue}), ")
        });
        writeln!(text, "    [{}],", row.collect::<String>())?;
    }
    text += "];\n";
    fs::write(out.join("shaded.rs"), text)?;
    Ok(())
}
