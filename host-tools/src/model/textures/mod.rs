//! The textures of a model, brought to one size and one format: then they are one type, and the
//! loop over pixels has no size that is known at run time only.

mod format;
mod palette;
mod picture;
mod resample;
mod texture;

use std::{
    collections::HashMap,
    fmt,
    path::{Path, PathBuf},
};

pub use format::{AlphaFormat, ColorFormat, TexelFormat, TextureOptions, TextureWrap};
pub use picture::Picture;
#[cfg(test)]
pub(super) use picture::tests::encoded;
pub use texture::Texture;

use format::name;
use resample::Light;
use texture::{Format, HALF, Stored};

use super::{Provenance, error::ModelError, quote::shown, report::thousands};

/// The longest side of a texture: what the core draws.
const MAX_SIDE: usize = 1_024;

/// The longest side of a texture whose size is not chosen.
const MAX_AUTOMATIC: usize = 256;

/// The textures of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Textures {
    /// The width and height of the largest level of each.
    pub size: [usize; 2],
    /// How texels are stored.
    pub format: TexelFormat,
    /// The type of the colours.
    pub color: ColorFormat,
    /// What lies beyond the borders, along u and along v.
    pub wrap: [TextureWrap; 2],
    /// Whether there are mip levels down to one texel.
    pub mipmaps: bool,
    /// How transparency is stored; `None` if all textures are opaque.
    pub alpha: Option<AlphaFormat>,
    /// The textures, each once.
    pub textures: Vec<Texture>,
    /// For each of the model's materials its place in `textures`.
    pub by_material: Vec<Option<usize>>,
}

/// A material's texture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Wanted {
    /// The file of the picture.
    pub picture: PathBuf,
    /// Where it is named: the library and the line.
    pub place: (PathBuf, usize),
    /// Whether it ends at its borders.
    pub clamps: bool,
}

/// The textures, and the files that they are made from.
pub(super) struct Loaded {
    pub textures: Textures,
    pub files: Vec<Provenance>,
    /// Mean colours as stored, for what draws the model without its textures: for each material
    /// with a texture.
    pub means: Vec<Option<[u8; 3]>>,
}

/// Reads the pictures of the materials, in their order, and brings them to one format; `None` if no
/// material has one.
pub(super) fn load(
    obj: &Path,
    materials: &[Option<Wanted>],
    options: &TextureOptions,
    warnings: &mut Vec<String>,
) -> Result<Option<Loaded>, ModelError> {
    let mut pictures: Vec<(&Path, Picture)> = Vec::new();
    let (mut known, mut files) = (HashMap::new(), Vec::new());
    let mut by_material = Vec::new();
    for material in materials {
        let Some(Wanted { picture: path, place: (library, line), .. }) = material else {
            by_material.push(None);
            continue;
        };
        if let Some(&known) = known.get(path) {
            by_material.push(Some(known));
            continue;
        }
        let (picture, bytes) = picture::read(path).map_err(|fault| ModelError::Picture {
            path: library.clone(),
            line: *line,
            fault,
        })?;
        files.push(Provenance::of(path, &bytes));
        known.insert(path, pictures.len());
        by_material.push(Some(pictures.len()));
        pictures.push((path, picture));
    }
    if pictures.is_empty() {
        return Ok(None);
    }
    let wrap = wrap(obj, materials, warnings);
    let size = size(obj, pictures.iter().map(|(_, picture)| picture.size), wrap, options)?;
    let (texels, means): (Vec<Vec<Stored>>, Vec<[u8; 3]>) = (pictures.iter())
        .map(|(_, picture)| {
            let light = Light::of(picture, size);
            let mean = light.mean().map(|value| value.round() as u8);
            let levels = if options.mipmaps { light.levels() } else { vec![light] };
            (levels.iter().flat_map(Light::stored).collect(), mean)
        })
        .unzip();
    let alpha = alpha(&texels, options.alpha);
    let format = Format { texels: options.format, color: options.color, alpha };
    let textures = (pictures.into_iter().zip(&texels))
        .map(|((path, picture), texels)| Texture::new(path, picture, texels, size, format))
        .collect();
    let means = by_material.iter().map(|place: &Option<usize>| Some(means[(*place)?])).collect();
    let textures = Textures {
        size,
        format: options.format,
        color: options.color,
        wrap: [wrap; 2],
        mipmaps: options.mipmaps,
        alpha,
        textures,
        by_material,
    };
    Ok(Some(Loaded { textures, files, means }))
}

/// What lies beyond the borders of all textures. It is a part of their common type: they end at
/// their borders only if all of them do.
fn wrap(obj: &Path, materials: &[Option<Wanted>], warnings: &mut Vec<String>) -> TextureWrap {
    let all = || materials.iter().flatten();
    let clamped = all().filter(|wanted| wanted.clamps).count();
    if clamped == all().count() {
        return TextureWrap::Clamp;
    }
    if clamped > 0 {
        warnings.push(format!(
            "{}: {} of {} textures end at their borders (`-clamp on`): all repeat, as the textures \
             of a mesh are of one type",
            shown(obj),
            thousands(clamped),
            thousands(all().count())
        ));
    }
    TextureWrap::Repeat
}

/// The common size.
fn size(
    obj: &Path,
    originals: impl Iterator<Item = [usize; 2]>,
    wrap: TextureWrap,
    options: &TextureOptions,
) -> Result<[usize; 2], ModelError> {
    let Some(size) = options.size else {
        let largest = originals.fold([1; 2], |[w, h], size| [w.max(size[0]), h.max(size[1])]);
        let mut size = largest.map(nearest_power_of_two);
        while size[0].max(size[1]) > MAX_AUTOMATIC {
            size = halved(size);
        }
        return Ok(size);
    };
    let refused = |reason| Err(ModelError::TextureSize { path: obj.into(), size, reason });
    if size.iter().any(|side| !(1..=MAX_SIDE).contains(side)) {
        refused("sides are 1 to 1,024")
    } else if wrap == TextureWrap::Repeat && !size.iter().all(|side| side.is_power_of_two()) {
        refused("the sides of textures that repeat are powers of two")
    } else {
        Ok(size)
    }
}

/// The size of the next mip level: half of each side, rounded down to no less than 1.
fn halved(size: [usize; 2]) -> [usize; 2] {
    size.map(|side| (side / 2).max(1))
}

/// The power of two that a side is nearest to as a factor: 91 becomes 128, and 90 becomes 64.
const fn nearest_power_of_two(side: usize) -> usize {
    let above = side.next_power_of_two();
    if 2 * side * side < above * above { above / 2 } else { above }
}

/// The common format of alpha: none unless a texel needs it.
fn alpha(texels: &[Vec<Stored>], choice: Option<AlphaFormat>) -> Option<AlphaFormat> {
    let choice = choice.unwrap_or(AlphaFormat::Key);
    let least_opaque = match choice {
        // With two values, what is more opaque than transparent is opaque.
        AlphaFormat::Key | AlphaFormat::Bits1 => HALF,
        AlphaFormat::Bits4
        | AlphaFormat::Bits8
        | AlphaFormat::Translucent4
        | AlphaFormat::Translucent8 => 255.0 - 1e-9,
    };
    texels.iter().flatten().any(|texel| texel[3] < least_opaque).then_some(choice)
}

/// Chooses at most `count` colours for all of these, so that the mean square distance from one to
/// the nearest of the palette is small; all of them if they are no more than that.
#[must_use]
pub fn choose_palette(colors: &[[u8; 3]], count: usize) -> Vec<[u8; 3]> {
    let texels: Vec<[f64; 3]> = colors.iter().map(|color| color.map(f64::from)).collect();
    let chosen = palette::choose(&texels, count, |color| color.map(f64::round));
    chosen.into_iter().map(|color| color.map(|channel| channel as u8)).collect()
}

impl Textures {
    /// The bytes that all of them take in flash.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.textures.iter().map(Texture::bytes).sum()
    }

    /// The sizes of the levels, the largest first.
    #[must_use]
    pub fn levels(&self) -> Vec<[usize; 2]> {
        let mut levels = vec![self.size];
        while let Some(&level) = levels.last().filter(|&&level| self.mipmaps && level != [1, 1]) {
            levels.push(halved(level));
        }
        levels
    }

    /// Size and format in words.
    #[must_use]
    pub fn description(&self) -> String {
        let [width, height] = self.size;
        let format = name(&TexelFormat::NAMES, &self.format);
        let color = name(&ColorFormat::NAMES, &self.color);
        let levels = self.levels().len();
        let mipmaps = if levels > 1 { format!(", {levels} mip levels") } else { String::new() };
        let alpha = match self.alpha {
            None => String::new(),
            Some(AlphaFormat::Key) => ", colour key".to_owned(),
            Some(alpha) => {
                let blended = if alpha.is_translucent() { " for blending" } else { "" };
                format!(", {} bits of alpha{blended}", alpha.bits().unwrap_or(0))
            }
        };
        format!("{width}x{height}, {format}, {color}{mipmaps}{alpha}")
    }
}

impl fmt::Display for Textures {
    /// Writes one texture per line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Textures: {}", self.description())?;
        for texture in &self.textures {
            let file = texture.path.file_name().unwrap_or_default();
            let [width, height] = texture.original.size;
            let distance = if texture.psnr_db.is_finite() {
                format!("{:.1} dB from it in that size", texture.psnr_db)
            } else {
                "equal to it in that size".to_owned()
            };
            writeln!(
                f,
                "  {}: {} bytes, from {width}x{height} pixels, {distance}",
                shown(Path::new(file)),
                thousands(texture.bytes())
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(clamps: bool) -> Option<Wanted> {
        Some(Wanted { picture: "a.png".into(), place: ("a.mtl".into(), 3), clamps })
    }

    #[test]
    fn automatic_sizes_are_powers_of_two_up_to_256() {
        let automatic = |sizes: &[[usize; 2]]| {
            let options = TextureOptions::default();
            let sizes = sizes.iter().copied();
            size(Path::new("m.obj"), sizes, TextureWrap::Repeat, &options).unwrap()
        };
        assert_eq!(automatic(&[[1, 1]]), [1, 1]);
        assert_eq!(automatic(&[[90, 91]]), [64, 128]);
        assert_eq!(automatic(&[[16, 200], [100, 8]]), [128, 256]);
        assert_eq!(automatic(&[[1_024, 256]]), [256, 64]);
        assert_eq!(automatic(&[[4_096, 1]]), [256, 1]);
    }

    #[test]
    fn chosen_sizes_fit_their_use() {
        let chosen = |sides, wrap| {
            let options = TextureOptions { size: Some(sides), ..Default::default() };
            size(Path::new("m.obj"), std::iter::empty(), wrap, &options)
                .map_err(|error| error.to_string())
        };
        let fault = |sides, wrap| chosen(sides, wrap).unwrap_err();
        assert_eq!(chosen([1_024, 1], TextureWrap::Repeat), Ok([1_024, 1]));
        assert_eq!(chosen([100, 33], TextureWrap::Clamp), Ok([100, 33]));
        assert!(fault([100, 64], TextureWrap::Repeat).contains("that repeat are powers of two"));
        assert!(fault([2_048, 64], TextureWrap::Clamp).contains("1 to 1,024"));
        assert!(fault([0, 64], TextureWrap::Repeat).contains("1 to 1,024"));
    }

    #[test]
    fn textures_end_at_their_borders_if_all_do() {
        let of = |materials: &[Option<Wanted>]| {
            let mut warnings = Vec::new();
            (wrap(Path::new("m.obj"), materials, &mut warnings), warnings)
        };
        assert_eq!(of(&[wanted(true), None]), (TextureWrap::Clamp, Vec::new()));
        assert_eq!(of(&[wanted(false), None]), (TextureWrap::Repeat, Vec::new()));
        let (wrap, warnings) = of(&[wanted(true), wanted(false)]);
        assert_eq!(wrap, TextureWrap::Repeat);
        assert!(warnings[0].starts_with("m.obj: 1 of 2 textures end"), "{warnings:?}");
    }

    #[test]
    fn alpha_is_kept_only_where_there_is_some() {
        let picture = |alpha: u16| Picture { size: [1, 1], pixels: vec![[9, 9, 9, alpha * 257]] };
        let of = |value, choice| alpha(&[Light::of(&picture(value), [1, 1]).stored()], choice);
        assert_eq!(of(255, Some(AlphaFormat::Bits8)), None);
        assert_eq!(of(254, Some(AlphaFormat::Bits8)), Some(AlphaFormat::Bits8));
        assert_eq!([of(128, None), of(127, None)], [None, Some(AlphaFormat::Key)]);
        assert_eq!(of(128, Some(AlphaFormat::Bits1)), None);
        assert_eq!(of(0, Some(AlphaFormat::Bits1)), Some(AlphaFormat::Bits1));
    }
}
