//! The textures of a model as Rust: their type, and a static array of them beside the mesh.

use std::fmt::Write as _;

use super::{
    AlphaFormat, ColorFormat, Model, Texture, TextureWrap, Textures,
    emit::{in_comment, rows, table},
};

/// Writes the textures of a model, if it has any.
pub(super) fn textures(out: &mut String, model: &Model) -> std::fmt::Result {
    let Some(textures) = &model.textures else {
        return Ok(());
    };
    let (name, each, count) = (&model.name, textures.description(), textures.by_material.len());
    let type_name = texture_type(name);
    let layers = Layers::of(textures);
    writeln!(out, "\n/// A texture of [`{name}`]: {each}.")?;
    writeln!(out, "#[rustfmt::skip]")?;
    writeln!(out, "pub type {type_name} = {};", layers.texture_type(textures))?;
    // Shaders have less code for a table in which no material lacks a texture.
    let has_all = textures.by_material.iter().all(Option::is_some);
    let (entry, without) = if has_all {
        (type_name.clone(), "")
    } else {
        (format!("Option<{type_name}>"), "; `None` where it has a colour")
    };
    writeln!(out, "\n/// The texture of each material of [`{name}`]{without}.")?;
    if model.texture_coordinates.is_wide() {
        writeln!(out, "///")?;
        writeln!(
            out,
            "/// Texture coordinates have 32 bits: shaders need `with_wide_coordinates`."
        )?;
    }
    writeln!(out, "#[rustfmt::skip]")?;
    if layers.bits.is_none() {
        let reason = "each colour of a large texture takes the compiler a few steps";
        writeln!(out, "#[allow(long_running_const_eval, reason = \"{reason}\")]")?;
    }
    writeln!(out, "pub static {name}_TEXTURES: [{entry}; {count}] = {{")?;
    writeln!(out, "    use ::rasterizer::{}::{};", color_module(textures.color), layers.color)?;
    writeln!(out, "    use ::rasterizer::texture::{{{}}};", layers.names())?;
    color_function(out, &layers)?;
    for (place, texture) in textures.textures.iter().enumerate() {
        let file = texture.path.file_name().unwrap_or_default().to_string_lossy();
        writeln!(out, "    // {place}: {}.", in_comment(&file))?;
        layers.tables(out, texture, place)?;
    }
    writeln!(out, "    [")?;
    for place in &textures.by_material {
        let texture = place.map(|place| {
            let texels = layers.value(&textures.textures[place], place);
            format!("{type_name}::new({texels})")
        });
        match texture {
            Some(texture) if has_all => writeln!(out, "        {texture},")?,
            Some(texture) => writeln!(out, "        Some({texture}),")?,
            None => writeln!(out, "        None,")?,
        }
    }
    writeln!(out, "    ]")?;
    writeln!(out, "}};")
}

/// How texels are stored, from the inside out.
struct Layers {
    /// The colour type.
    color: &'static str,
    /// The type of the numbers from which colours are made.
    number: &'static str,
    /// The texels of a texture.
    texels: usize,
    /// The bits of a place in the palette; `None` without one.
    bits: Option<usize>,
    alpha: Option<AlphaFormat>,
}

impl Layers {
    fn of(textures: &Textures) -> Self {
        let (color, number) = match textures.color {
            ColorFormat::Rgb565 => ("Rgb565", "u16"),
            ColorFormat::Rgb565Be => ("Rgb565Be", "u16"),
            ColorFormat::Rgb888 => ("Rgb888", "u32"),
            ColorFormat::Gray8 => ("Gray8", "u8"),
            ColorFormat::Rgb332 => ("Rgb332", "u8"),
        };
        let texels = textures.levels().iter().map(|[width, height]| width * height).sum();
        Self { color, number, texels, bits: textures.format.bits(), alpha: textures.alpha }
    }

    /// The types that the tables are put together with.
    fn names(&self) -> String {
        let inner = if self.bits.is_some() { "Indexed" } else { "Colors" };
        match self.alpha {
            None => inner.to_owned(),
            Some(AlphaFormat::Key) => format!("{inner}, Keyed"),
            Some(alpha) => format!("{inner}, {}", plane_type(alpha)),
        }
    }

    const fn bytes(&self, bits: usize) -> usize {
        (self.texels * bits).div_ceil(8)
    }

    /// The whole type.
    fn texture_type(&self, textures: &Textures) -> String {
        const MODULE: &str = "::rasterizer::texture";
        let color = format!("::rasterizer::{}::{}", color_module(textures.color), self.color);
        let inner = match self.bits {
            None => format!("{MODULE}::Colors<'static, {color}, {}>", self.texels),
            Some(bits) => {
                let (bytes, colors) = (self.bytes(bits), 1 << bits);
                format!("{MODULE}::Indexed<'static, {color}, {bits}, {bytes}, {colors}>")
            }
        };
        let texels = match self.alpha.map(|alpha| (plane_type(alpha), alpha.bits())) {
            None => inner,
            Some((_, None)) => format!("{MODULE}::Keyed<{inner}>"),
            Some((plane, Some(bits))) => {
                format!("{MODULE}::{plane}<'static, {inner}, {bits}, {}>", self.bytes(bits))
            }
        };
        let name = if textures.mipmaps { "Mipmaps" } else { "Texture" };
        let [width, height] = textures.size;
        let wrap = |wrap| match wrap {
            TextureWrap::Repeat => "Repeat",
            TextureWrap::Clamp => "Clamp",
        };
        let [x, y] = textures.wrap.map(wrap);
        format!(
            "{MODULE}::{name}<\n    {texels},\n    {width}, {height}, {MODULE}::{x}, {MODULE}::{y},\n>"
        )
    }

    /// The texels of the texture at `place` in its mesh.
    fn value(&self, texture: &Texture, place: usize) -> String {
        let inner = if self.bits.is_some() {
            format!("Indexed::new(&TEXELS_{place}, &PALETTE_{place})")
        } else {
            format!("Colors::new(&TEXELS_{place})")
        };
        match (self.alpha, texture.key) {
            (None, _) => inner,
            (_, Some(key)) if self.bits.is_some() => format!("Keyed::new({inner}, {key})"),
            (_, Some(key)) => {
                format!("Keyed::new({inner}, colors([{}])[0])", self.hexadecimal(key))
            }
            (Some(alpha), None) => {
                format!("{}::new({inner}, &ALPHA_{place})", plane_type(alpha))
            }
        }
    }

    fn tables(&self, out: &mut String, texture: &Texture, place: usize) -> std::fmt::Result {
        let bytes = |bytes: Vec<u8>| bytes.into_iter().map(|byte| byte.to_string());
        if let Some(packed) = texture.packed() {
            table(out, &format!("TEXELS_{place}"), "u8", bytes(packed))?;
            self.colors(out, &format!("PALETTE_{place}"), &texture.palette)?;
        } else {
            self.colors(out, &format!("TEXELS_{place}"), &texture.texels)?;
        }
        table(out, &format!("ALPHA_{place}"), "u8", bytes(texture.packed_alpha()))
    }

    /// A table of colours from their numbers.
    fn colors(&self, out: &mut String, name: &str, numbers: &[u32]) -> std::fmt::Result {
        let (color, count) = (self.color, numbers.len());
        writeln!(out, "    static {name}: [{color}; {count}] = colors([")?;
        rows(out, numbers.iter().map(|&number| self.hexadecimal(number)))?;
        writeln!(out, "    ]);")
    }

    /// A number with as many digits as its colour has.
    fn hexadecimal(&self, number: u32) -> String {
        match self.number {
            "u8" => format!("0x{number:02X}"),
            "u16" => format!("0x{number:04X}"),
            _ => format!("0x{:02X}_{:04X}", number >> 16, number & 0xFFFF),
        }
    }
}

/// The type of texels with a plane.
const fn plane_type(alpha: AlphaFormat) -> &'static str {
    if alpha.is_translucent() { "Translucent" } else { "Masked" }
}

/// The module of a colour type, in the crate.
const fn color_module(color: ColorFormat) -> &'static str {
    match color {
        ColorFormat::Rgb565Be => "output",
        ColorFormat::Rgb332 => "color",
        _ => "embedded_graphics_core::pixelcolor",
    }
}

/// The function that makes colours of their numbers. The types have no constant for that.
fn color_function(out: &mut String, Layers { color, number, .. }: &Layers) -> std::fmt::Result {
    let (zero, value) = match *color {
        "Gray8" => ("0", "numbers[i]"),
        // More significant bits are ignored.
        "Rgb332" => ("0, 0, 0", "numbers[i] >> 5, numbers[i] >> 2, numbers[i]"),
        "Rgb888" => {
            ("0, 0, 0", "(numbers[i] >> 16) as u8, (numbers[i] >> 8) as u8, numbers[i] as u8")
        }
        _ => (
            "0, 0, 0",
            "(numbers[i] >> 11) as u8, (numbers[i] >> 5) as u8 & 63, numbers[i] as u8 & 31",
        ),
    };
    writeln!(
        out,
        "    const fn colors<const N: usize>(numbers: [{number}; N]) -> [{color}; N] {{"
    )?;
    writeln!(out, "        let (mut colors, mut i) = ([{color}::new({zero}); N], 0);")?;
    writeln!(out, "        while i < N {{")?;
    writeln!(out, "            colors[i] = {color}::new({value});")?;
    writeln!(out, "            i += 1;")?;
    writeln!(out, "        }}")?;
    writeln!(out, "        colors")?;
    writeln!(out, "    }}")
}

/// The name of the type for that of the static: `TORUS_KNOT` becomes `TorusKnotTexture`.
pub(crate) fn texture_type(name: &str) -> String {
    let words = name.split('_').filter_map(|word| {
        let (first, rest) = word.split_at_checked(1)?;
        Some(first.to_owned() + &rest.to_ascii_lowercase())
    });
    words.collect::<String>() + "Texture"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_named_after_the_static() {
        for (name, expected) in [
            ("GEAR", "GearTexture"),
            ("TORUS_KNOT", "TorusKnotTexture"),
            ("MODEL_2CV", "Model2cvTexture"),
            ("W_RFEL", "WRfelTexture"),
        ] {
            assert_eq!(texture_type(name), expected);
        }
    }
}
