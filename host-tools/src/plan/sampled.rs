//! How the textures of a model are stored and sampled.

use std::path::Path;

use super::{Filter, LevelChoice, PlanError, Request, Texels, texels::Sampling};
use crate::model::{ColorFormat, Model, Options, TexelFormat, Texture, TextureOptions};

/// Of a step of as many texels, the nearest one shows a sixteenth of what it covers: what it leaves
/// out flickers as the model moves.
pub(super) const MINIFIED_TEXELS: f64 = 4.0;

/// The part of the pixels that may have such steps without mip levels.
pub(super) const MINIFIED_PART: f64 = 0.1;

/// The mip level of a triangle is off by up to log2 r within it, for distances in the ratio r
/// ([`PerTriangle`](rasterizer::texture::PerTriangle)): by one here.
pub(super) const MOST_RATIO: f64 = 2.0;

/// How textures are sampled.
#[derive(Clone, Debug)]
pub(super) struct Sampled {
    /// What all views show of them.
    pub(super) seen: Sampling,
    /// The sides of the textures, before and after they are made as small as they are seen.
    pub(super) sizes: [[usize; 2]; 2],
    /// The part of the pixels whose step covers [`MINIFIED_TEXELS`] or more of these.
    pub(super) minified_part: f64,
    /// Which texels make the colour of a pixel.
    pub(super) filter: Filter,
    /// The largest error of linear interpolation in these texels.
    pub(super) affine_error: f64,
    /// How near the colours of each of [`Texels::ALL`] are to those of the first: the peak
    /// signal-to-noise ratio of the worst texture, in dB. Infinite if they are the same.
    pub(super) psnr_db: [f64; Texels::ALL.len()],
}

impl Sampled {
    /// How near the colours of a format are to those without a palette, in dB.
    pub(super) const fn psnr_db_of(&self, texels: Texels) -> f64 {
        self.psnr_db[texels as usize]
    }

    /// The filter with mip levels instead of without, or the other way round.
    pub(super) fn with_other_levels(&self) -> Filter {
        let mip_levels = match self.filter.mip_levels {
            None => Some(level_choice(&self.seen)),
            Some(_) => None,
        };
        Filter { mip_levels, ..self.filter }
    }

    /// Of a model in a file, with colours of 16 bits, given what all views of a request show.
    ///
    /// # Errors
    ///
    /// Returns an error if the file has changed and cannot be converted any more.
    pub(super) fn new(
        model: &Model,
        path: &Path,
        options: &Options,
        (request, seen): (&Request, Sampling),
    ) -> Result<Self, PlanError> {
        let textures = model.textures.as_ref();
        let size = textures.map_or([1; 2], |textures| textures.size);
        let chosen = options.textures.as_ref().and_then(|textures| textures.size);
        // A size that was asked for stays.
        let halvings = if chosen.is_some() { 0 } else { seen.halvings() };
        let smaller = size.map(|side| (side >> halvings).max(1));
        let minified_part = seen.part_of(MINIFIED_TEXELS * f64::from(1 << halvings));
        let has_mip_levels = request.has_mip_levels.unwrap_or(minified_part > MINIFIED_PART);
        let mip_levels = has_mip_levels.then_some(level_choice(&seen));
        let filter = Filter { is_bilinear: request.is_bilinear, mip_levels };
        let stored = |format| {
            Model::load(path, &with_texels(options, Some(smaller), format, has_mip_levels))
        };
        let is_other = halvings > 0 || has_mip_levels;
        let resized = if is_other { Some(stored(TexelFormat::Direct)?) } else { None };
        let direct = resized.as_ref().unwrap_or(model);
        let mut psnr_db = [f64::INFINITY; Texels::ALL.len()];
        for (psnr_db, texels) in psnr_db.iter_mut().zip(Texels::ALL).skip(1) {
            *psnr_db = psnr(direct, &stored(texels.format())?);
        }
        let scale = smaller[0] as f64 / size[0] as f64;
        let affine_error = seen.affine_error * scale;
        let sizes = [size, smaller];
        Ok(Self { seen, sizes, minified_part, filter, affine_error, psnr_db })
    }
}

/// Where mip levels are chosen.
fn level_choice(seen: &Sampling) -> LevelChoice {
    if seen.ratio > MOST_RATIO { LevelChoice::PerPixel } else { LevelChoice::PerTriangle }
}

/// The options with textures of a size and a format, with mip levels or without.
pub(super) fn with_texels(
    options: &Options,
    size: Option<[usize; 2]>,
    format: TexelFormat,
    mipmaps: bool,
) -> Options {
    let textures = options.textures.as_ref().map(|textures| TextureOptions {
        size: size.or(textures.size),
        format,
        color: ColorFormat::Rgb565,
        mipmaps,
        ..*textures
    });
    Options { textures, ..options.clone() }
}

/// How near the textures of a model are to those of another one, which has them in another format:
/// [`Texture::psnr`] of the worst.
fn psnr(expected: &Model, stored: &Model) -> f64 {
    let [expected, stored] =
        [expected, stored].map(|model| model.textures.iter().flat_map(|set| &set.textures));
    let of = |(expected, stored): (&Texture, &Texture)| {
        let exact: Vec<_> = (0..expected.texels.len()).map(|texel| expected.rgba(texel)).collect();
        stored.psnr(&exact)
    };
    expected.zip(stored).map(of).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use std::{fs, path::PathBuf};

    use tempfile::TempDir;

    use super::{super::tests, *};
    use crate::plan::{Costs, Paint, Plan, Study, View, Views};

    /// A square with a picture of 64 x 64 pixels, each 2 x 2 of them in one of some colours, some
    /// times in each direction.
    fn painted(colors: u32, times: u32) -> (TempDir, PathBuf) {
        let square = format!(
            "mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
             vt 0 0\nvt {times} 0\nvt {times} {times}\nvt 0 {times}\nf 1/1 2/2 3/3 4/4\n"
        );
        let (directory, path) = tests::file(&square);
        fs::write(directory.path().join("m.mtl"), "newmtl a\nmap_Kd m.png\n").unwrap();
        let color = |x: u32, y: u32| {
            let number = (x / 2 + 32 * (y / 2)) % colors;
            [number % 8 * 32, number / 8 % 8 * 32, number / 64 * 60].map(|c| c as u8)
        };
        let pixels: Vec<u8> =
            (0..64 * 64).flat_map(|place| color(place % 64, place / 64)).collect();
        let file = fs::File::create(directory.path().join("m.png")).unwrap();
        let mut encoder = png::Encoder::new(file, 64, 64);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
        (directory, path)
    }

    fn study(colors: u32, request: &Request) -> (TempDir, Study) {
        study_of(painted(colors, 1), request)
    }

    fn study_of((directory, path): (TempDir, PathBuf), request: &Request) -> (TempDir, Study) {
        let options = Options { textures: Some(TextureOptions::default()), ..Options::default() };
        let study = Study::new(&path, &options, request, |_| ()).unwrap();
        (directory, study)
    }

    #[test]
    fn palettes_have_the_same_colours_if_they_have_as_many() {
        let psnr_db = |colors| study(colors, &tests::request()).1.sampling.unwrap().psnr_db;
        assert_eq!(psnr_db(16), [f64::INFINITY; 3]);
        let [direct, of_256, of_16] = psnr_db(17);
        assert_eq!([direct, of_256], [f64::INFINITY; 2]);
        assert!(of_16.is_finite() && of_16 > 20.0, "{of_16} dB");
        assert!(psnr_db(257)[1].is_finite());
    }

    /// The format of the texels of a plan for little flash: too little for all of them, and with
    /// the least for that of 16 colours alone.
    #[test]
    fn flash_and_nearness_decide_the_format() {
        let request = tests::request();
        let plan = |colors, request: &Request| -> Result<Plan, PlanError> {
            let (_directory, study) = study(colors, request);
            study.plan(&Costs::measured())
        };
        let format = |plan: &Plan| match plan.chosen.types.paint {
            Paint::Textures(_, format, _) => format,
            paint => panic!("{paint:?}"),
        };
        let free = plan(16, &request).unwrap();
        assert_eq!(format(&free), Texels::Direct);
        // The picture takes 64 x 64 texels of 2 bytes, of 1 byte and 512 bytes of palette, or of
        // half a byte.
        let most = free.predicted.flash_bytes();
        let with = |flash: u32| Request { flash_bytes: Some(flash), ..request.clone() };
        let of = |flash| format(&plan(16, &with(flash)).unwrap());
        assert_eq!(of(most - 2_000), Texels::Indexed8);
        assert_eq!(of(most - 5_000), Texels::Indexed4);
        assert!(plan(16, &with(most - 8_000)).is_err());
        // Of 17 colours one is missing, which must be allowed.
        assert!(matches!(plan(17, &with(most - 5_000)), Err(PlanError::TooLarge { .. })));
        let lossy = Request { palette_db: 20.0, ..with(most - 5_000) };
        let lossy = plan(17, &lossy).unwrap();
        assert_eq!(format(&lossy), Texels::Indexed4);
        let textures = tests::decision(&lossy, "textures");
        assert!(textures.choice.contains("a palette of 16 colours"), "{textures:?}");
        assert!(textures.margin.contains("20 dB are wanted"), "{textures:?}");
    }

    #[test]
    fn views_and_distances_decide_the_filter() {
        let filter = |degrees: f64, distance: f64, request: Request| {
            let turns_degrees = [0.0, degrees, 0.0];
            let views = Views::List(vec![View { turns_degrees, distance: Some(distance) }]);
            let request = Request { views, ..request };
            study_of(painted(16, 4), &request).1.sampling.unwrap().filter
        };
        let (request, mip) =
            (tests::request(), |mip_levels| Filter { mip_levels, ..Filter::NEAREST });
        // All steps are the same, and the texture is made as small as that.
        assert_eq!(filter(0.0, 3.0, request.clone()), Filter::NEAREST);
        // From 1.25 - 0.7 to 1.25 + 0.7 away, almost along the square.
        let per_pixel = mip(Some(LevelChoice::PerPixel));
        assert_eq!(filter(80.0, 1.25, request.clone()), per_pixel);
        let (no, yes) = (Some(false), Some(true));
        let asked_for = |has_mip_levels| Request { has_mip_levels, ..request.clone() };
        assert_eq!(filter(80.0, 1.25, asked_for(no)), Filter::NEAREST);
        assert_eq!(filter(80.0, 1.25, asked_for(yes)), per_pixel);
        // From 2.3 to 3.7 away distances differ by a factor of 1.6.
        let per_triangle = mip(Some(LevelChoice::PerTriangle));
        assert_eq!(filter(80.0, 3.0, asked_for(yes)), per_triangle);
        let bilinear = Request { is_bilinear: true, ..asked_for(yes) };
        let wanted = Filter { is_bilinear: true, ..per_triangle };
        assert_eq!(filter(80.0, 3.0, bilinear), wanted);
    }

    #[test]
    fn the_file_has_the_filter_and_its_levels() {
        let planned = |request: &Request| {
            // More than a palette has.
            let (_directory, study) = study(300, request);
            (study.plan(&Costs::measured()), study.sampling.unwrap().sizes[1])
        };
        let request = Request { has_mip_levels: Some(true), ..tests::request() };
        let (plan, [side, _]) = planned(&request);
        let plan = plan.unwrap();
        let source = &plan.source;
        assert!(source.contains("texture::{NearestMip, PerTriangle}"), "{source}");
        assert!(source.contains(".filtered(NearestMip(PerTriangle))"));
        assert!(source.contains("::rasterizer::texture::Mipmaps<"));
        let filter = tests::decision(&plan, "filter");
        assert!(filter.reason.starts_with("as asked for"), "{filter:?}");
        assert_eq!(filter.other.as_ref().unwrap().choice, "nearest texel");
        // n^2 / 4 + n^2 / 16 + ... + 1 texels of 2 bytes.
        let none = planned(&Request { has_mip_levels: Some(false), ..request.clone() }).0.unwrap();
        let levels = plan.predicted.table_bytes - none.predicted.table_bytes;
        assert_eq!(levels as usize, 2 * (side * side - 1) / 3);
        let flash_bytes = Some(plan.predicted.flash_bytes() / 2);
        let error = planned(&Request { flash_bytes, ..request }).0.unwrap_err().to_string();
        assert!(error.ends_with("; textures without mip levels take less"), "{error}");
    }
}
