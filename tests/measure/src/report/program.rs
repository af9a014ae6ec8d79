//! The programs of choices: Rust source as a firmware has it.

use std::fmt::Write as _;

use super::{
    choices::{Arithmetic, Choice, Color, Correction, Filter, Shading, Visibility},
    scenes::{Scene, Tables},
};

/// The source of a program that draws a scene by these choices, one after the other.
pub(super) fn source(scene: &Scene, tables: &[Tables], choices: &[Choice]) -> String {
    let mut text = String::from(
        "\
use firmware::choice::{Choice, Memory, Scene, Shared};
#[allow(unused_imports)]
use rasterizer::{
    attribute::{Adaptive, Affine, Every, EveryPixel},
    color::Rgb332,
    prelude::*,
    shade::{Dithered, Phong},
    texture::{Bilinear, Nearest, NearestMip, PerTriangle, Trilinear},
};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

const SUN: Light = Light::new(Vec3::lit(\"-1\", \"2\", \"3\"), Level::lit(\"0.2\"), Level::lit(\"0.8\"));
",
    );
    let is_read = |table: &&Tables| choices.iter().any(|choice| table.are_of(choice));
    for table in tables.iter().filter(is_read) {
        text += "#[allow(unreachable_pub, missing_docs)]\n";
        text += &format!("mod {} {{ include!({:?}); }}\n", table.module(), table.path);
    }
    // One for all choices of a colour: a microcontroller in QEMU has 4 MB.
    for color in [Color::Rgb565, Color::Rgb888, Color::Rgb332] {
        if choices.iter().any(|choice| choice.color == color) {
            let (name, [kind, black]) = (memory(color), rust(color));
            text += &format!("static {name}: Shared<{kind}> = Memory::shared({black});\n");
        }
    }
    text += "\nfn choices() {\n";
    for choice in choices {
        let _ = writeln!(text, "    {};", call(scene, choice));
    }
    text + "}\n"
}

/// The block that draws one choice.
fn call(scene: &Scene, choice: &Choice) -> String {
    let (name, memory, [_, black]) = (choice.name(), memory(choice.color), rust(choice.color));
    let tables = Tables::module_of(choice);
    let Scene { focal_length_px, distance, frames, .. } = scene;
    let shift = scene.shift_steps();
    let subpixel = format!("S{}", choice.subpixel);
    let depth = match choice.visibility {
        Visibility::U16 => "u16",
        Visibility::U32 => "u32",
        Visibility::Float16 => "FloatDepth",
        Visibility::Painter => "",
    };
    let method = match (choice.arithmetic, choice.visibility, choice.samples) {
        (Arithmetic::Float, ..) => match choice.texture {
            None => "in_f32::<V>".into(),
            Some((Correction::Every(pixels), _)) => {
                format!("textured_in_f32_every::<_, {pixels}, V>")
            }
            Some(_) => "textured_in_f32::<_, V>".into(),
        },
        (Arithmetic::FloatLevels, ..) => "in_f32_levels::<64, V>".into(),
        (_, Visibility::Painter, _) => format!("painted::<{subpixel}, _, V, T>"),
        (_, _, 1) => format!("frames::<{subpixel}, {depth}, _, V>"),
        (_, _, side) => {
            let words = format!("{{ firmware::choice::words(T, {side}) }}");
            format!("supersampled::<{subpixel}, {depth}, _, {side}, V, {words}>")
        }
    };
    let shaded_by = match (choice.arithmetic, choice.texture) {
        (Arithmetic::Fixed, _) => shader(choice, tables),
        (_, Some(_)) => format!("&{tables}::MODEL_TEXTURES, &SUN"),
        (_, None) => "&SUN".into(),
    };
    format!(
        "{{
        const V: usize = {tables}::MODEL.vertex_count();
        #[allow(dead_code)]
        const T: usize = {tables}::MODEL.triangle_count();
        let scene = Scene {{
            mesh: &{tables}::MODEL,
            focal_length_px: {focal_length_px},
            distance: \"{distance}\",
            shift: {shift},
            frames: {frames},
        }};
        Choice {{ name: \"{name}\", scene }}.{method}({shaded_by}, {black}, &{memory})
    }}"
    )
}

/// The shader as Rust.
fn shader(choice: &Choice, tables: &str) -> String {
    let shader = match (choice.texture, choice.shading) {
        (Some((correction, filter)), shading) => {
            let correction = match correction {
                Correction::Affine => "Affine".into(),
                Correction::Every(pixels) => format!("Every::<{pixels}>"),
                Correction::Adaptive(sixteenths) => format!("Adaptive::<{sixteenths}>"),
                Correction::EveryPixel => "EveryPixel".into(),
            };
            let filter = match filter {
                Filter::Nearest => "Nearest",
                Filter::Bilinear => "Bilinear",
                Filter::Mipmap => "NearestMip(PerTriangle)",
                Filter::Trilinear => "Trilinear(PerTriangle)",
            };
            let name = if shading == Shading::Flat { "TexturedFlat" } else { "TexturedGouraud" };
            let textures = format!("&{tables}::MODEL_TEXTURES");
            format!("{name}::new({textures}, SUN).filtered({filter}).corrected({correction})")
        }
        (None, Shading::Flat) => "Flat::new(SUN)".into(),
        (None, Shading::Gouraud) => "Gouraud::new(SUN)".into(),
        (None, Shading::Phong) => "Phong::new(SUN)".into(),
    };
    if choice.is_dithered {
        // From eight bits a channel, as dithering needs.
        let true_color = shader.replacen("::new(SUN)", "::<Rgb888>::new(SUN)", 1);
        format!("Dithered::new({true_color})")
    } else {
        shader
    }
}

/// A type of colours, and its black.
const fn rust(color: Color) -> [&'static str; 2] {
    match color {
        Color::Rgb565 => ["Rgb565Be", "Rgb565Be::BLACK"],
        Color::Rgb888 => ["Rgb888", "Rgb888::BLACK"],
        Color::Rgb332 => ["Rgb332", "Rgb332::new(0, 0, 0)"],
    }
}

/// The static with the memory of its pictures.
const fn memory(color: Color) -> &'static str {
    match color {
        Color::Rgb565 => "RGB565",
        Color::Rgb888 => "RGB888",
        Color::Rgb332 => "RGB332",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::choices;

    /// The shaders of all methods.
    fn shaders(methods: Vec<choices::Method>) -> Vec<String> {
        let all = methods.into_iter().flat_map(|method| method.choices);
        all.map(|choice| shader(&choice, "tables")).collect()
    }

    #[test]
    fn shaders_are_what_a_firmware_has() {
        let all = [shaders(choices::of_colors()), shaders(choices::of_texture())].concat();
        for shader in [
            "Flat::new(SUN)",
            "Phong::new(SUN)",
            "Dithered::new(Gouraud::<Rgb888>::new(SUN))",
            "TexturedGouraud::new(&tables::MODEL_TEXTURES, SUN).filtered(Nearest).corrected(Affine)",
            "TexturedGouraud::new(&tables::MODEL_TEXTURES, SUN)\
             .filtered(Trilinear(PerTriangle)).corrected(Adaptive::<8>)",
        ] {
            assert!(all.iter().any(|found| found == shader), "{shader}");
        }
    }
}
