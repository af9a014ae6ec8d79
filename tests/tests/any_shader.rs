//! A user's own shaders against the f64 reference: their definitions are closures over as many
//! varyings as they have.

use embedded_graphics::pixelcolor::{Gray8, GrayColor, Rgb888, RgbColor};
use fixed::types::U16F16;
use host_tools::{
    check::{Bounds, DefinedDepth, Difference, Judged, judge},
    reference::Sample,
};
use rasterizer::{
    attribute::FloatDepth,
    geometry::{CullNone, ScreenVertex},
    mesh::{MeshMaterial, MeshVertex},
    numbers::{S4, S8, Subpixel},
    output::StoredColor,
    raster::Fragment,
    scene::Object,
    shade::Shader,
};
use rasterizer_tests::bands::{DISPLAY, EYES, Position, at, ball};

/// Slices through the model, alternately in the material's red as grey and in black.
#[derive(Clone)]
struct Contours;

impl Shader for Contours {
    type Color = Gray8;
    type Varyings = [u16; 1];
    type Surface = Gray8;
    type Face = ();
    type Outcome = Gray8;

    fn surface(&self, material: &MeshMaterial<'_>) -> Gray8 {
        Gray8::new(material.rgb().r())
    }

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        [vertex.position()[1] as u16 ^ 0x8000]
    }

    fn pixel(&self, surface: &Gray8, (): &(), fragment: Fragment<[U16F16; 1]>) -> Gray8 {
        let [height] = fragment.varyings;
        if height.to_bits() >> 28 & 1 == 0 { *surface } else { Gray8::BLACK }
    }
}

/// The height of a slice in units of the varying.
const SLICE: f64 = 4096.0;

/// The definition of [`Contours`] on the ball. Its red is 250.
fn contour(height: f64) -> [f64; 3] {
    let is_black = ((height + 0.5) / SLICE).floor() % 2.0 == 1.0;
    [if is_black { 0.0 } else { 250.0 }; 3]
}

/// The definition of [`Position`]: the upper 8 of 16 bits.
fn position(varyings: [f64; 3]) -> [f64; 3] {
    varyings.map(|c| ((c + 0.5) / 256.0).floor())
}

/// Both sides of the ball, seen from `eye`. The varyings of the reference are the stored ones.
fn ball_judged<S: Subpixel, D: DefinedDepth, const N: usize, Sh>(
    eye: &str,
    shader: Sh,
    shade: impl Fn(Sample<N>) -> Option<[f64; 3]>,
) -> Judged
where
    Sh: Shader<Color: StoredColor + From<Rgb888> + Into<Rgb888>, Varyings = [u16; N]>,
{
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S, D, [u16; N]>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, shader).culled(CullNone);
    let projected = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
    judge(&projected, DISPLAY, |_, stored| stored.map(f64::from), shade).unwrap()
}

/// Three varyings, each a channel: one step of 256 off at most, where the varying passes from one
/// step to the next.
#[test]
fn three_varyings_are_within_bounds() {
    fn from_all_eyes<S: Subpixel, D: DefinedDepth>() {
        for eye in EYES {
            let judged =
                ball_judged::<S, D, 3, _>(eye, Position, |sample| Some(position(sample.varyings)));
            let found = judged.deviation();
            assert!(found.is_within(&Bounds::ARITHMETIC), "{eye}: {found:?}");
            assert!(found.pixels > 400, "{eye}: {found:?}");
        }
    }
    from_all_eyes::<S4, u16>();
    from_all_eyes::<S8, u16>();
    from_all_eyes::<S8, u32>();
    from_all_eyes::<S8, FloatDepth>();
}

/// A threshold turns an error far below a unit into another colour, but only at the border of a
/// slice.
#[test]
fn contours_differ_at_the_borders_of_slices_alone() {
    let [mut same, mut other] = [0; 2];
    for eye in EYES {
        let judged =
            ball_judged::<S8, u16, 1, _>(eye, Contours, |sample| Some(contour(sample.varyings[0])));
        let found = judged.deviation();
        assert!(found.coverage_mismatches == 0 && found.depth_max_ulp <= 1.0, "{eye}: {found:?}");

        // The height itself in the place of a colour.
        let heights =
            ball_judged::<S8, u16, 1, _>(eye, Contours, |sample| Some([sample.varyings[0]; 3]))
                .reference;
        for y in 0..DISPLAY.size.height as usize {
            for x in 0..DISPLAY.size.width as usize {
                let Difference::Both { color_error, .. } = judged.difference(x, y) else {
                    continue;
                };
                if color_error == 0.0 {
                    same += 1;
                    continue;
                }
                other += 1;
                // How far the nearest border is away: the core is within a unit.
                let is_at_border = heights.fragments(x, y).iter().any(|fragment| {
                    let slices = (fragment.color[0] + 0.5) / SLICE;
                    (slices - slices.round()).abs() * SLICE < 1.0
                });
                assert!(is_at_border, "{eye}: ({x}, {y})");
            }
        }
    }
    assert!(same > 5_000 && other < same / 100, "{same} pixels are equal, {other} are not");
}

/// Channels in another order, a colour two steps off, and a definition with holes.
#[test]
fn a_wrong_definition_is_out_of_bounds() {
    let deviation = |shade: fn([f64; 3]) -> Option<[f64; 3]>| {
        let judged =
            ball_judged::<S8, u16, 3, _>(EYES[0], Position, |sample| shade(sample.varyings));
        let found = judged.deviation();
        (found.coverage_mismatches > 0, found.color_max_error > 1.0, found.depth_max_ulp > 1.0)
    };
    assert_eq!(deviation(|v| Some(position(v))), (false, false, false));
    assert_eq!(deviation(|[x, y, z]| Some(position([y, x, z]))), (false, true, false));
    assert_eq!(deviation(|v| Some(position(v).map(|c| c + 2.0))), (false, true, false));
    // The holes show the far side of the ball.
    let with_holes = |[x, y, z]: [f64; 3]| (z < 40_000.0).then(|| position([x, y, z]));
    assert_eq!(deviation(with_holes), (false, true, true));
    assert_eq!(deviation(|_| None), (true, false, false));
}
