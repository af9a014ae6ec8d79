//! Highlights and lamps: shipped models with shiny materials, from near, far, and inside.

use super::*;

/// A shipped model whose materials have highlights and light of their own.
fn shiny(name: &str, exponent: u32) -> Model {
    let mut model = shipped(name);
    let finish = rasterizer::mesh::Finish::MATTE
        .with_specular([230, 200, 255], exponent as u16)
        .with_emission([10, 0, 30]);
    model.finishes = vec![finish; model.materials.len()];
    model
}

/// Two far lights, and a lamp beside the model.
fn lights() -> ViewLights {
    let mut lights = ViewLights::OVER_THE_SHOULDER;
    lights.suns[1] = Some(Sun { toward: [3.0, -1.0, 0.5], level: 0.3 });
    lights.lamps[0] = Some(Lamp { position: [0.7, 0.4, 1.1], half: 0.6 });
    lights
}

#[test]
fn highlights_are_within_bounds_from_all_sides() {
    let shadings = [Shading::GlossyGouraud, Shading::Phong, Shading::PhongNear];
    for (name, exponent) in [("gear.obj", 8), ("rocket.obj", 60), ("torus_knot.obj", 1000)] {
        let model = shiny(name, exponent);
        let checker = Checker::new(&model);
        let mut normal_error = 0f64;
        for (i, view) in views().take(9).enumerate() {
            let shading = shadings[i % 3];
            for lights in [ViewLights::OVER_THE_SHOULDER, lights()] {
                let view = View { size: [160, 120], shading, lights, ..view };
                let cut = View { distance: 1.5, near: 1.2, far: 1.9, ..view };
                let inside = View { distance: 0.1, near: 0.02, ..view };
                let far = View { distance: 40.0, ..view };
                for view in [view, cut, inside, far] {
                    let outcome = checker.check(&view).unwrap().outcome;
                    assert!(outcome.is_within(&Bounds::ARITHMETIC), "{name} {view:?} {outcome:#?}");
                    let normals = outcome.arithmetic.normals;
                    assert_eq!(normals.is_some(), shading != Shading::GlossyGouraud);
                    let degrees = normals.map_or(0.0, |n| n.normal_max_error_degrees);
                    normal_error = normal_error.max(degrees);
                }
            }
        }
        assert!((0.01..0.5).contains(&normal_error), "{name}: {normal_error}");
    }
}

/// Lights and lamps on shaders without highlights.
#[test]
fn any_lights_are_within_bounds() {
    let model = shipped("rocket.obj");
    let checker = Checker::new(&model);
    for view in views().take(8) {
        for shading in [Shading::Flat, Shading::Gouraud] {
            let view = View { shading, lights: lights(), ..view };
            let outcome = checker.check(&view).unwrap().outcome;
            assert!(outcome.is_within(&Bounds::ARITHMETIC), "{view:?} {outcome:#?}");
        }
    }
}

/// The definition has the finish of each material: with another one in the core's tables alone, the
/// picture is wrong.
#[test]
fn another_exponent_is_found() {
    let model = shiny("torus_knot.obj", 20);
    let view = View { shading: Shading::Phong, ..FRONT };
    let checker = Checker::new(&model);
    let drawn = checker.check(&view).unwrap();
    let other = shiny("torus_knot.obj", 12);
    let wrong = Checker::new(&other).check(&view).unwrap();
    assert!(drawn.outcome.is_within(&Bounds::ARITHMETIC));
    // The core's picture of one against the definition of the other.
    let differs = (drawn.fixed.pixels.iter().zip(&wrong.fixed.pixels))
        .any(|(a, b)| a.color.iter().zip(b.color).any(|(a, b)| a.abs_diff(b) > 3));
    assert!(differs);
}
