//! The core's shaders with textures, right and wrong: their pictures pass, and faults are found.

use super::*;
use crate::{
    check::{any_texture::AnyFilter, skins::Skins, textured},
    model::Contents,
    reference::{Mipmaps, Texture, Wrap},
};

const SIDE: usize = 64;

/// A wall in three faces of two materials, the first of which has a texture.
fn wall() -> Model {
    textured_model(
        "mtllib m.mtl\nv -1 -1 0\nv 0 -1 0.1\nv 1 -1 0\nv 1 1 0\nv 0 1 0.1\nv -1 1 0\nv 1.3 0 0\n\
         vt -1 -1\nvt 0.5 -1\nvt 1.9 -1\nvt 1.9 1.5\nvt 0.5 1.5\nvt -1 1.5\n\
         usemtl red\nf 1/1 2/2 5/5 6/6\nf 2/2 3/3 4/4 5/5\nusemtl blue\nf 3/3 7/4 4/4\n",
    )
}

/// A model with texture coordinates.
fn textured_model(obj: &str) -> Model {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    fs::write(&path, obj).unwrap();
    fs::write(directory.path().join("m.mtl"), "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")
        .unwrap();
    let contents = Contents { texture_coordinates: true, ..Contents::default() };
    let options = Options { contents, ..Options::default() };
    Model::load(&path, &options).unwrap_or_else(|error| panic!("{error}"))
}

/// Texels of random colours, and levels down to a single one. `alpha` returns that of a texel.
fn random_levels(wrap: [Wrap; 2], alpha: impl Fn(usize) -> f64) -> Vec<Texture> {
    let mut random = Random(17);
    (0..=6)
        .map(|level| {
            let side = SIDE >> level;
            let texel = |i| {
                let mut channel = || random.real(0.0, 256.0).floor();
                [channel(), channel(), channel(), alpha(i)]
            };
            Texture::new([side; 2], wrap, (0..side * side).map(texel).collect())
        })
        .collect()
}

fn random_texture(wrap: [Wrap; 2]) -> Mipmaps {
    Mipmaps::new(random_levels(wrap, |_| 255.0))
}

/// Checks a model whose first material has a texture.
fn checker(model: &Model, texture: Mipmaps) -> Checker<'_> {
    let surface = Surface::of(model, false);
    let textures = (0..model.materials.len()).map(|i| (i == 0).then(|| texture.clone()));
    Checker { model, skins: Skins::new(model, &surface, textures), surface }
}

const VIEW: View = View {
    perspective: Correction::EveryPixel,
    filter: Filter::Nearest,
    display: None,
    fog: None,
    shading: Shading::Textured,
    ..FRONT
};

/// Near, far, slanted, cut by both planes, and from close by.
fn some_views() -> Vec<View> {
    vec![
        VIEW,
        View { yaw_degrees: 70.0, subpixel: Subpixel::S4, ..VIEW },
        View { pitch_degrees: -78.0, roll_degrees: 25.0, distance: 1.3, ..VIEW },
        View { yaw_degrees: 60.0, distance: 1.2, near: 0.8, far: 1.5, ..VIEW },
        View { pitch_degrees: -84.0, distance: 0.4, near: 0.02, depth: DepthFormat::U32, ..VIEW },
        View { projection: Projection::Orthographic { height: 2.2 }, yaw_degrees: 40.0, ..VIEW },
    ]
}

const REPEAT: [Wrap; 2] = [Wrap::Repeat; 2];

#[track_caller]
fn passes(checker: &Checker<'_>, view: &View) -> Outcome {
    let outcome = checker.check(view).unwrap().outcome;
    assert!(outcome.is_within(&Bounds::ARITHMETIC), "{view:?} {outcome:#?}");
    assert!(outcome.arithmetic.deviation.pixels > 3_000, "{view:?} {outcome:#?}");
    assert!(outcome.arithmetic.texels.unwrap().texel_max_error > 0.0, "{view:?}");
    outcome
}

#[test]
fn every_shading_mode_and_filter_is_within_its_bounds() {
    let model = wall();
    let (mut most, mut judged) = (0f64, 0);
    let shadings = [Shading::Textured, Shading::TexturedFlat, Shading::TexturedGouraud];
    // Three of one and four of the other: every pair.
    let (mut shadings, mut filters) = (shadings.into_iter().cycle(), Filter::NAMES.iter().cycle());
    for wrap in [REPEAT, [Wrap::Clamp, Wrap::Mirror]] {
        let checker = checker(&model, random_texture(wrap));
        for (_, perspective) in Correction::NAMES {
            for view in some_views() {
                let (shading, &(_, filter)) = (shadings.next().unwrap(), filters.next().unwrap());
                let view = View { perspective, filter, shading, ..view };
                let outcome = passes(&checker, &view);
                judged += outcome.places.judged;
                if perspective == Correction::Every32 {
                    most = most.max(outcome.arithmetic.texels.unwrap().texel_max_error);
                }
            }
        }
    }
    // The law is needed: some coordinates are farther off than 1/16 texel.
    assert!(most > 0.5, "{most}");
    assert!(judged > 1_000_000, "{judged}");
}

#[test]
fn a_coordinate_that_is_off_is_found_with_its_pixel() {
    let model = wall();
    let checker = checker(&model, random_texture(REPEAT));
    for view in some_views() {
        let textures = checker.skins.filtered(view.filter);
        let shader = rasterizer::shade::Textured::from_slice(&textures)
            .unwrap()
            .filtered(AnyFilter)
            .corrected(any_mode::AnyMode)
            .with_wide_coordinates();
        let drawn = textured::draw(
            (&model, &checker.surface, &checker.skins),
            |material| &checker.skins.textures[material],
            &view,
            &shader,
            // 1/128 of 64 texels is half a texel.
            |seen| Some(seen.value.uv().map(|c| c + (1 << 17))),
            |_, corner| shading::placed_corner(&corner, 1.0),
            |_| ([0.0; 2], 1.0),
        )
        .unwrap();
        let colors = face_colors::colors(&model, &checker.surface, &checker.skins, &view);
        let arithmetic = checker.compare(&view, drawn, &colors).outcome.arithmetic;
        let worst = arithmetic.texels.unwrap().out_of_bounds().unwrap();
        assert!(!arithmetic.is_within(&Bounds::ARITHMETIC));
        // The picture itself is right.
        assert!(arithmetic.deviation.is_within(&Bounds::ARITHMETIC), "{arithmetic:#?}");
        assert!((0.4..0.6).contains(&worst.error_texels), "{worst:?}");
        assert!(worst.pixel[0] < 320 && worst.pixel[1] < 240 && worst.triangle < 5, "{worst:?}");
    }
}

/// The same texture, each level turned by a texel to the right.
fn turned(texture: &Mipmaps) -> Mipmaps {
    let level = |level: &Texture| {
        let [width, height] = level.size().map(|side| side as i64);
        let places = (0..height).flat_map(|row| (0..width).map(move |column| [column - 1, row]));
        let texels = places.map(|place| level.texel(place)).collect();
        Texture::new(level.size(), level.wrap(), texels)
    };
    Mipmaps::new(texture.levels().iter().map(level).collect())
}

#[test]
fn colors_of_the_texel_beside_are_found() {
    let model = wall();
    let texture = random_texture(REPEAT);
    let mut checker = checker(&model, texture.clone());
    checker.skins.textures[0] = turned(&texture);
    for view in some_views() {
        for (_, filter) in Filter::NAMES {
            let view = View { filter, ..view };
            let arithmetic = checker.check(&view).unwrap().outcome.arithmetic;
            assert!(arithmetic.deviation.color_max_error > 1.0, "{view:?} {arithmetic:#?}");
            assert_eq!(arithmetic.deviation.coverage_mismatches, 0);
            assert!(arithmetic.texels.unwrap().are_within(), "{arithmetic:#?}");
        }
    }
}

#[test]
fn one_wrong_texel_is_found() {
    let model = wall();
    let levels = random_levels(REPEAT, |_| 255.0);
    let mut checker = checker(&model, Mipmaps::new(levels.clone()));
    let error = |checker: &Checker<'_>| {
        checker.check(&VIEW).unwrap().outcome.arithmetic.deviation.color_max_error
    };
    assert_eq!(error(&checker), 0.0);
    let mut broken = levels.clone();
    let mut texels = levels[0].texels().to_vec();
    // Two steps of one channel of one of 4,096 texels.
    texels[2_021][1] += if texels[2_021][1] < 128.0 { 2.0 } else { -2.0 };
    broken[0] = Texture::new([SIDE; 2], REPEAT, texels);
    checker.skins.textures[0] = Mipmaps::new(broken);
    assert_eq!(error(&checker), 2.0);
}

/// Of each level one grey, so that only the level shows.
fn grey_levels(grey: impl Fn(usize) -> f64) -> Mipmaps {
    let level = |number: usize| {
        let side = SIDE >> number;
        let texel = [grey(number), grey(number), grey(number), 255.0];
        Texture::new([side; 2], REPEAT, vec![texel; side * side])
    };
    Mipmaps::new((0..=6).map(level).collect())
}

#[test]
fn another_mip_level_is_found() {
    let model = wall();
    let mut checker = checker(&model, grey_levels(|level| 40.0 * level as f64));
    for filter in [Filter::Mipmap, Filter::Trilinear] {
        let (mut right, mut wrong) = (0, 0);
        for distance in [3.0, 7.0, 20.0, 33.0, 55.0] {
            let view = View { filter, distance, yaw_degrees: 25.0, ..VIEW };
            checker.skins.textures[0] = grey_levels(|level| 40.0 * level as f64);
            right += usize::from(
                checker.check(&view).unwrap().outcome.arithmetic.is_within(&Bounds::ARITHMETIC),
            );
            // Half a level farther than the core, and one that may be either of two.
            let off = if filter == Filter::Mipmap { 60.0 } else { 20.0 };
            checker.skins.textures[0] = grey_levels(|level| 40.0 * level as f64 + off);
            let found = checker.check(&view).unwrap().outcome.arithmetic;
            wrong += usize::from(!found.is_within(&Bounds::ARITHMETIC));
        }
        assert_eq!([right, wrong], [5, 5], "{filter:?}");
    }
}

#[test]
fn transparent_texels_show_what_is_behind() {
    // A wall with holes before another one.
    let model = textured_model(
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 -0.5\nv 1 -1 -0.5\nv 1 1 -0.5\n\
         v -1 1 -0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nf 5/1 6/2 7/3 8/4\n",
    );
    let holes = |i: usize| if i.is_multiple_of(3) { 0.0 } else { 255.0 };
    let texture = Mipmaps::new(random_levels(REPEAT, holes));
    let mut checker = checker(&model, texture.clone());
    for (_, filter) in Filter::NAMES {
        for view in some_views() {
            let view = View { filter, ..view };
            checker.skins.textures[0] = texture.clone();
            passes(&checker, &view);
            checker.skins.textures[0] = turned(&texture);
            let outcome = checker.check(&view).unwrap().outcome;
            assert!(!outcome.is_within(&Bounds::ARITHMETIC), "{view:?}");
        }
    }
}

#[test]
fn pictures_of_materials_are_drawn_without_being_chosen() {
    let directory = tempfile::tempdir().unwrap();
    let file = |name: &str, contents: &[u8]| fs::write(directory.path().join(name), contents);
    // A picture that differs at all four corners, so that none may take the place of another.
    let mut picture = Vec::new();
    let mut encoder = png::Encoder::new(&mut picture, 16, 32);
    encoder.set_color(png::ColorType::Rgb);
    let texel = |i: usize| [(16 * (i % 16)) as u8, (8 * (i / 16)) as u8, 90];
    let data: Vec<u8> = (0..16 * 32).flat_map(texel).collect();
    encoder.write_header().unwrap().write_image_data(&data).unwrap();
    file("p.png", &picture).unwrap();
    file("m.mtl", b"newmtl red\nmap_Kd p.png\n").unwrap();
    let obj = "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0.2\nv -1 1 0\nvt 0.05 0.05\nvt 0.95 0.1\n\
               vt 0.9 0.95\nvt 0.1 0.9\nusemtl red\nf 1/1 2/2 3/3 4/4\n";
    file("m.obj", obj.as_bytes()).unwrap();
    let textures = Some(crate::model::TextureOptions { mipmaps: true, ..Default::default() });
    let options = Options { textures, ..Options::default() };
    let model = Model::load(directory.path().join("m.obj"), &options).unwrap();
    assert_eq!(Shading::of(&model), Shading::TexturedGouraud);
    for (_, filter) in Filter::NAMES {
        for shading in [Shading::Textured, Shading::TexturedGouraud] {
            let view = View { filter, shading, yaw_degrees: 20.0, ..VIEW };
            let outcome = passes(&Checker::new(&model), &view);
            // From the file's own coordinates: apart from texels beside, the same picture. One
            // turned over would have some 10 dB.
            let psnr = outcome.end_to_end.deviation.psnr_db.unwrap();
            assert!(psnr > 35.0, "{view:?}: {psnr}");
        }
    }
}
