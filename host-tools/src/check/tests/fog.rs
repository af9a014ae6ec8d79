//! Views in fog.

use super::*;
use crate::reference::{Blend, Fog as Law};

const COLOR: [u8; 3] = [200, 210, 220];

/// From fog that is complete within the model to one that begins behind it.
const LAWS: [Law; 6] = [
    Law::Linear { start: 2.0, end: 4.0 },
    Law::Linear { start: 0.0, end: 100.0 },
    Law::Linear { start: 2.9, end: 3.1 },
    Law::Linear { start: 4.5, end: 5.0 },
    Law::Exponential { density: 0.3 },
    Law::Exponential { density: 3.0 },
];

fn fogs() -> impl Iterator<Item = Fog> + Clone {
    let modes = FogBy::NAMES.map(|(_, by)| by);
    LAWS.into_iter().flat_map(move |law| modes.map(|by| Fog { law, by, color: COLOR }))
}

#[test]
fn fog_is_over_every_shader() {
    let model = shipped("rocket.obj");
    let mut pixels = 0;
    for (view, fog) in views().zip(fogs().cycle()) {
        let outcome = pass(&model, &View { fog: Some(fog), ..view });
        pixels += outcome.arithmetic.deviation.pixels;
    }
    assert!(pixels > 100_000, "{pixels}");
}

#[test]
fn fog_is_over_textures() {
    let model = shipped("wooden_crate.obj");
    let shadings = [Shading::Textured, Shading::TexturedFlat, Shading::TexturedGouraud];
    for (i, (view, fog)) in views().zip(fogs()).enumerate() {
        let (shading, filter) = (shadings[i % 3], Filter::NAMES[i % 2].1);
        let view = View { shading, filter, ..view };
        pass(&model, &View { fog: Some(fog), ..view });
    }
}

/// Each layer has its fog before it is blended: one that is complete hides what lies behind, and
/// none changes nothing.
#[test]
fn fog_is_over_the_layers_of_blended_models() {
    let model = shipped("torus_knot.obj");
    let blending = Blending::By(Blend::Over);
    for (fog, opacity) in fogs().zip([0.5, 1.0].into_iter().cycle()) {
        let view = View { shading: Shading::Gouraud, blending, opacity, fog: Some(fog), ..FRONT };
        let found = pass(&model, &view).arithmetic.blend.unwrap();
        assert!(found.blend_pixels > 2_000 && found.blend_most_layers > 1, "{found:?}");
    }
    let drawn =
        |fog| render(&model, &View { blending, fog, opacity: 1.0, ..FRONT }).unwrap().pixels;
    let linear =
        |start, end| Some(Fog { law: Law::Linear { start, end }, by: FogBy::Pixel, color: COLOR });
    let (bare, full) = (drawn(None), drawn(linear(0.5, 1.0)));
    assert_eq!(bare, drawn(linear(50.0, 60.0)));
    for (full, bare) in full.iter().zip(&bare) {
        assert_eq!(full.color, if full.depth == 0 { bare.color } else { COLOR });
    }
}

/// Faces through the near plane and the far plane.
#[test]
fn fog_is_right_on_clipped_triangles() {
    let model = load(
        "v -1 -0.4 1\nv 1 -0.4 1\nv 0.9 0.3 -1\nv -0.9 0.3 -1\nf 1 2 3 4\nv 0 1 -1\nf 4 3 5\n",
    );
    for fog in fogs() {
        for (distance, near, far) in [(1.05, 0.3, 100.0), (1.5, 0.1, 2.0), (0.9, 0.25, 1.2)] {
            let view = View { fog: Some(fog), distance, near, far, ..FRONT };
            let outcome = pass(&model, &view);
            assert!(outcome.arithmetic.deviation.pixels > 5_000, "{view:?}");
        }
    }
}

#[test]
fn full_fog_has_its_color_and_none_changes_nothing() {
    let model = shipped("rocket.obj");
    let fog = |start, end| {
        let law = Law::Linear { start, end };
        View { fog: Some(Fog { law, by: FogBy::Pixel, color: COLOR }), ..FRONT }
    };
    let drawn = |view: &View| render(&model, view).unwrap().pixels;
    let (full, none, bare) = (drawn(&fog(0.5, 1.0)), drawn(&fog(50.0, 60.0)), drawn(&FRONT));
    assert_eq!(none, bare);
    for (pixel, bare) in full.iter().zip(bare) {
        assert_eq!(pixel.depth, bare.depth);
        assert!(pixel.depth == 0 || pixel.color == COLOR, "{pixel:?}");
    }
}

#[test]
fn fog_that_has_no_law_is_refused() {
    let model = shipped("rocket.obj");
    for law in [
        Law::Linear { start: 2.0, end: 2.0 },
        Law::Linear { start: -1.0, end: 2.0 },
        Law::Linear { start: 1.0, end: 1e9 },
        Law::Exponential { density: f64::NAN },
        Law::Exponential { density: -0.5 },
    ] {
        let view = View { fog: Some(Fog { law, by: FogBy::Pixel, color: COLOR }), ..FRONT };
        let error = render(&model, &view).unwrap_err().to_string();
        assert!(error.contains("fog"), "{error}");
    }
}

/// A picture in fog that is a twentieth thinner, or of another colour, is wrong.
#[test]
fn a_wrong_amount_is_found() {
    let model = shipped("rocket.obj");
    let checker = Checker::new(&model);
    let view = |end, color| {
        let law = Law::Linear { start: 2.0, end };
        View { fog: Some(Fog { law, by: FogBy::Pixel, color }), ..FRONT }
    };
    let right = view(4.0, COLOR);
    let other = |wrong: &View| {
        let mut drawn = shading::draw(&model, &checker.surface, &checker.skins, &right).unwrap();
        drawn.picture = render(&model, wrong).unwrap();
        let colors = face_colors::colors(&model, &checker.surface, &checker.skins, &right);
        checker.compare(&right, drawn, &colors).outcome
    };
    assert!(other(&right).is_within(&Bounds::ARITHMETIC));
    for wrong in [view(4.1, COLOR), view(3.9, COLOR), view(4.0, [190, 210, 220])] {
        let outcome = other(&wrong);
        assert!(!outcome.arithmetic.is_within(&Bounds::ARITHMETIC), "{outcome:?}");
        assert!(outcome.places.wrong > 0, "{outcome:?}");
    }
}
