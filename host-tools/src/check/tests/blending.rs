//! Blended models pass; a layer too few, a wrong colour of a layer and a wrong blended colour are
//! found.

use super::*;
use crate::reference::Blend;

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
    let surface = Surface::of(&model);
    let skins = Skins::new(&model, &surface, skins::of_materials(&model));
    let drawn = shading::draw(&model, &surface, &skins, &view).unwrap();
    let layers = drawn.blended.unwrap();
    let (reference, ..) = (drawn.arithmetic)(&drawn.picture);
    assert!(layers.judge(&reference, true).is_within(1.0));
    let pixel = layers.first_with_layers(2);

    let mut fewer = layers.clone();
    fewer.drop_layer(pixel);
    let found = fewer.judge(&reference, true);
    assert!(!found.is_within(1.0) && found.blend_layer_mismatches == 1, "{found:?}");

    let mut swapped = layers.clone();
    swapped.tint_layer(pixel, 40.0);
    let found = swapped.judge(&reference, true);
    assert!(!found.is_within(1.0) && found.blend_layer_max_error >= 39.0, "{found:?}");

    let mut off = layers;
    off.colors[pixel][1] ^= 2;
    let found = off.judge(&reference, true);
    let [x, y] = [pixel % 320, pixel / 320];
    assert!(!found.is_within(1.0) && found.blend_worst.unwrap().pixel == [x, y], "{found:?}");
    assert_eq!((found.blend_layer_mismatches, found.blend_layer_max_error <= 1.0), (0, true));
}
