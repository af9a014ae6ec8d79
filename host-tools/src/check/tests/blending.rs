//! Blended models pass; a layer too few, a wrong colour of a layer and a wrong blended colour are
//! found.

use super::*;
use crate::{
    model::{AlphaFormat, TextureOptions},
    reference::Blend,
};

const MODES: [Blend; 5] = [Blend::Over, Blend::Add, Blend::Multiply, Blend::Screen, Blend::Replace];

fn blended(model: &Model, view: &View) -> Blended {
    let found = pass(model, view).arithmetic.blend.unwrap();
    assert!(found.blend_pixels > 2_000, "{found:?}");
    found
}

#[test]
fn every_mode_passes() {
    for name in ["gear.obj", "torus_knot.obj", "wooden_crate.obj"] {
        let model = shipped(name);
        for (blend, opacity) in MODES.into_iter().zip([0.5, 0.3, 1.0, 0.77, 0.5]) {
            for shading in [Shading::Unlit, Shading::of(&model)] {
                let view = View { blending: Blending::By(blend), opacity, shading, ..FRONT };
                let found = blended(&model, &view);
                let worst = found.blend_worst.unwrap();
                assert!(worst.bound_steps >= 0.5 || blend == Blend::Replace, "{found:?}");
                // What replaces is not rounded.
                assert_eq!(found.blend_max_error > 0.0, blend != Blend::Replace, "{found:?}");
                assert_eq!(found.blend_layer_max_error > 0.0, shading == Shading::Gouraud);
                // A knot lies over itself.
                assert!(found.blend_most_layers > 1 || name != "torus_knot.obj", "{found:?}");
            }
        }
    }
}

/// With the near plane through the model, and in both kinds of numbers.
#[test]
fn clipped_layers_pass() {
    let model = shipped("torus_knot.obj");
    for (distance, subpixel) in [(0.9, Subpixel::S4), (0.7, Subpixel::S8)] {
        let blending = Blending::By(Blend::Over);
        let view =
            View { blending, opacity: 0.4, distance, subpixel, depth: DepthFormat::U32, ..FRONT };
        blended(&model, &View { shading: Shading::Gouraud, ..view });
    }
}

/// A triangle whose material lets three quarters through, over a background of 40, 50 and 64.
#[test]
fn materials_have_their_own_opacity() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    fs::write(&path, "mtllib m.mtl\nusemtl m\nv -2 -2 0\nv 2 -2 0\nv 0 2 0\nf 1 2 3\n").unwrap();
    fs::write(directory.path().join("m.mtl"), "newmtl m\nKd 1 1 1\nd 0.25\n").unwrap();
    let model = Model::load(&path, &Options::default()).unwrap();
    let view = View { blending: Blending::By(Blend::Over), ..FRONT };
    blended(&model, &view);
    let picture = render(&model, &view).unwrap();
    // d is 64 of 255, rounded up: 64 of 256.
    let middle = picture.pixels[120 * 320 + 160];
    assert_eq!(middle.color, [40, 50, 64].map(|c| ((c * 192 + 255 * 64 + 128) / 256) as u8));
    assert_eq!(picture.pixels[0].color, BACKGROUND);
    let half = render(&model, &View { opacity: 0.5, ..view }).unwrap();
    let middle = half.pixels[120 * 320 + 160];
    assert_eq!(middle.color, [40, 50, 64].map(|c| ((c * 224 + 255 * 32 + 128) / 256) as u8));
}

/// Layers drawn by the core, then changed in one pixel.
#[test]
fn every_fault_is_found() {
    let model = shipped("torus_knot.obj");
    let view = View {
        blending: Blending::By(Blend::Over),
        opacity: 0.5,
        shading: Shading::Gouraud,
        ..FRONT
    };
    let surface = Surface::of(&model, false);
    let skins = Skins::new(&model, &surface, skins::of_materials(&model));
    let drawn = shading::draw(&model, &surface, &skins, &view).unwrap();
    let layers = drawn.blended.unwrap();
    let (reference, ..) = (drawn.arithmetic)(&drawn.picture);
    assert!(layers.judge(&reference, None, true).is_within(1.0));
    let pixel = layers.first_with_layers(2);

    let mut fewer = layers.clone();
    fewer.drop_layer(pixel);
    let found = fewer.judge(&reference, None, true);
    assert!(!found.is_within(1.0) && found.blend_layer_mismatches == 1, "{found:?}");

    let mut swapped = layers.clone();
    swapped.tint_layer(pixel, 40.0);
    let found = swapped.judge(&reference, None, true);
    assert!(!found.is_within(1.0) && found.blend_layer_max_error >= 39.0, "{found:?}");

    let mut thin = layers.clone();
    thin.thin_layer(pixel, 3.0);
    let found = thin.judge(&reference, None, true);
    let worst = found.blend_alpha_worst.unwrap();
    assert!(!found.is_within(1.0) && !worst.is_within(), "{found:?}");
    assert!((worst.error_units, worst.pixel) == (3.0, [pixel % 320, pixel / 320]), "{found:?}");

    let mut off = layers;
    off.colors[pixel][1] ^= 2;
    let found = off.judge(&reference, None, true);
    let [x, y] = [pixel % 320, pixel / 320];
    assert!(!found.is_within(1.0) && found.blend_worst.unwrap().pixel == [x, y], "{found:?}");
    assert_eq!((found.blend_layer_mismatches, found.blend_layer_max_error <= 1.0), (0, true));
}

/// A model that fades along each axis, in every mode; and clipped, where varyings are cut.
#[test]
fn alphas_of_vertices_pass() {
    let model = shipped("torus_knot.obj");
    for (blend, opacity) in MODES.into_iter().zip([1.0, 0.3, 1.0, 0.77, 0.5]) {
        for fade in [FadeAlong::X, FadeAlong::Y, FadeAlong::Z] {
            let view = View { blending: Blending::By(blend), opacity, fade, ..FRONT };
            let found = blended(&model, &View { shading: Shading::Gouraud, ..view });
            if blend == Blend::Replace {
                continue;
            }
            // One alpha is rounded, or two and their product.
            let bound = if opacity < 1.0 { 1.504 } else { 0.502 } + 1.0 / 64.0;
            let worst = found.blend_alpha_worst.unwrap();
            assert!((worst.bound_units - bound).abs() < 1e-9, "{found:?}");
            assert!(found.blend_alpha_max_error > 0.4, "{found:?}");
        }
    }
    let blending = Blending::By(Blend::Over);
    let view = View { blending, fade: FadeAlong::Y, distance: 0.8, ..FRONT };
    blended(&model, &View { shading: Shading::Unlit, ..view });
}

/// A square in a texture whose alpha goes from 0 to 255, by every filter, as a plane of 4 bits, of
/// 8 bits, and as a mask.
#[test]
fn alphas_of_texels_pass() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    let square = "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n\
                  vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    fs::write(&path, square).unwrap();
    fs::write(directory.path().join("m.mtl"), "newmtl m\nmap_Kd -clamp on m.png\nd 0.8\n").unwrap();
    let mut png =
        png::Encoder::new(fs::File::create(directory.path().join("m.png")).unwrap(), 16, 16);
    png.set_color(png::ColorType::Rgba);
    let texel = |i: usize| [200, 16 * (i / 16) as u8, 90, 17 * (i % 16) as u8];
    let pixels: Vec<u8> = (0..256).flat_map(texel).collect();
    png.write_header().unwrap().write_image_data(&pixels).unwrap();
    for alpha in [AlphaFormat::Bits1, AlphaFormat::Translucent4, AlphaFormat::Translucent8] {
        let textures = TextureOptions { alpha: Some(alpha), mipmaps: true, ..Default::default() };
        let model = Model::load(&path, &Options { textures: Some(textures), ..Options::default() })
            .unwrap();
        for (_, filter) in Filter::NAMES {
            for (_, blending) in Blending::NAMES {
                for fade in [FadeAlong::None, FadeAlong::X] {
                    let (shading, size) = (Shading::Textured, [160, 120]);
                    let view =
                        View { shading, size, filter, blending, fade, opacity: 0.9, ..FRONT };
                    let outcome = pass(&model, &view);
                    let Some(found) = outcome.arithmetic.blend else { continue };
                    let has_alphas = blending != Blending::By(Blend::Replace);
                    // The fade runs against the texture: together they are below half everywhere,
                    // and what replaces is left out.
                    let is_empty = !has_alphas && fade == FadeAlong::X;
                    assert_eq!(found.blend_pixels < 2_000, is_empty, "{alpha:?} {found:?}");
                    assert_eq!(found.blend_alpha_worst.is_some(), has_alphas, "{found:?}");
                }
            }
        }
    }
}
