//! Blending modes: their formulas in f64, with factors of all kinds, with and without stored depth.

use rasterizer::{
    color::Alpha,
    geometry::{CullBack, CullFront, Culling},
    mesh::{Finish, Material},
    output::{Add, Blending, KeepDepth, MaterialOpacity, Multiply, Over, Replace, Screen},
    shade::{Faded, Layer},
};

use super::*;

/// The new colour of a channel from the stored one, the shader's and an alpha, all from 0 to 1.
type Formula = fn(f64, f64, f64) -> f64;

const OVER: Formula = |s, n, a| s + (n - s) * a;
const ADD: Formula = |s, n, a| (s + n * a).min(1.0);
const MULTIPLY: Formula = |s, n, a| s * (1.0 - a * (1.0 - n));
const SCREEN: Formula = |s, n, a| s + a * n * (1.0 - s);

/// A channel by a formula, rounded to the nearest, halves upwards. A result is a multiple of
/// 1 / (255 * 256): the rounding of f64 is far less.
fn rounded(formula: Formula, [stored, new]: [u8; 2], alpha: Alpha) -> u8 {
    let [s, n] = [stored, new].map(|c| f64::from(c) / 255.0);
    let exact = formula(s, n, f64::from(alpha.to_bits()) / 256.0) * 255.0;
    (exact + 0.5 + 1e-9).floor() as u8
}

fn blended(formula: Formula, [stored, new]: [Rgb888; 2], alpha: Alpha) -> Rgb888 {
    Rgb888::new(
        rounded(formula, [stored.r(), new.r()], alpha),
        rounded(formula, [stored.g(), new.g()], alpha),
        rounded(formula, [stored.b(), new.b()], alpha),
    )
}

/// An alpha by the place of a pixel: from 0 to 256.
const fn by_place(column: i32, row: i32) -> Alpha {
    Alpha::from_bits(((column * 37 + row * 11).rem_euclid(257)) as u16)
}

/// The colours of [`Position`], with an alpha by place.
const LAYERS: By<[u16; 3], Layer<Rgb888>> = By {
    vertex: |position| position.map(|c| c as u16 ^ 0x8000),
    pixel: |fragment| {
        let [red, green, blue] = fragment.varyings.map(|c: U16F16| (c.to_bits() >> 24) as u8);
        Layer::new(Rgb888::new(red, green, blue), by_place(fragment.column, fragment.row))
    },
};

/// A cube that is blended with a ball that it cuts into. Its pixels have the colours of
/// [`Position`] and these alphas.
fn blends<D: Framed, Sh: Shader<Color = Rgb888>, B>(
    shader: &Sh,
    blending: B,
    formula: Formula,
    alpha: fn(Point) -> Alpha,
    keeps_depth: bool,
) where
    B: Copy + for<'f, 'd> Blending<Frame<'f, Rgb888, D::Buffer<'d>>>,
{
    let (ball, cube) = (ball(), cube());
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at("2.4", DISPLAY);
    let moved = Pose::IDENTITY.at(Vec3::lit("0.6", "0.3", "0.4"));
    let behind = Object::new(&ball, Position).posed(moved);
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let opaque = Object::new(&cube, Position).posed(turned());
    let opaque = opaque.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let glass = Object::new(&cube, shader.clone()).posed(turned()).blended(blending);
    let glass = glass.project_on_demand::<_, S8, D>(&camera, S8).unwrap();

    let stored = D::frame(|frame| behind.draw(frame));
    let alone = D::frame(|frame| opaque.draw(frame));
    let whole = D::frame(|frame| {
        behind.draw(frame)?;
        glass.draw(frame)
    });
    let [mut drawn, mut changed] = [0; 2];
    for (index, point) in DISPLAY.points().enumerate() {
        let (mut color, mut depth) = (stored.color[index], stored.depth[index]);
        let is_covered = alone.color[index] != BACKGROUND;
        let alpha = alpha(point);
        // An invisible pixel is discarded.
        if is_covered && alpha > Alpha::CLEAR && is_seen::<D>(alone.depth[index], depth) {
            drawn += 1;
            let new = blended(formula, [color, alone.color[index]], alpha);
            changed += usize::from(new != color);
            color = new;
            if !keeps_depth {
                depth = alone.depth[index];
            }
        }
        assert_eq!((whole.color[index], whole.depth[index]), (color, depth), "{point}");
    }
    assert!(drawn > 300 && changed > 200, "{drawn} drawn, {changed} changed");
    bands_equal::<D>(&whole, |band| {
        behind.draw(band)?;
        glass.draw(band)
    });
}

#[test]
fn modes_follow_their_formulas() {
    fn in_frames<D: Framed>() {
        const SOME: Alpha = Alpha::from_bits(91);
        fn some(_: Point) -> Alpha {
            SOME
        }
        blends::<D, _, _>(&Position, Over(SOME), OVER, some, false);
        blends::<D, _, _>(&Position, Add(SOME), ADD, some, false);
        blends::<D, _, _>(&Position, Multiply(SOME), MULTIPLY, some, false);
        blends::<D, _, _>(&Position, Screen(SOME), SCREEN, some, false);
        blends::<D, _, _>(&Position, KeepDepth(Over(SOME)), OVER, some, true);
        blends::<D, _, _>(&Position, KeepDepth(Add(SOME)), ADD, some, true);
        let opaque = |_: Point| Alpha::OPAQUE;
        blends::<D, _, _>(&Position, KeepDepth(Replace), OVER, opaque, true);
    }
    in_frames::<u16>();
    in_frames::<FloatDepth>();
    in_frames::<NoDepth>();
}

#[test]
fn a_pixel_s_alpha_is_multiplied_by_the_factor() {
    let whole: fn(Point) -> Alpha = |point| by_place(point.x, point.y);
    let half: fn(Point) -> Alpha = |point| by_place(point.x, point.y).scaled(Alpha::HALF);
    blends::<u16, _, _>(&LAYERS, Over(Alpha::OPAQUE), OVER, whole, false);
    blends::<NoDepth, _, _>(&LAYERS, Screen(Alpha::OPAQUE), SCREEN, whole, false);
    blends::<u32, _, _>(&LAYERS, KeepDepth(Multiply(Alpha::OPAQUE)), MULTIPLY, whole, true);
    // What is clear after the product has the stored colour, and is seen as drawn.
    let drawn: fn(Point) -> Alpha = half;
    blends::<NoDepth, _, _>(&LAYERS, Over(Alpha::HALF), OVER, drawn, false);
}

#[test]
fn replacing_tests_the_alpha() {
    let tested: fn(Point) -> Alpha = |point| {
        if by_place(point.x, point.y).is_half() { Alpha::OPAQUE } else { Alpha::CLEAR }
    };
    blends::<u16, _, _>(&LAYERS, Replace, OVER, tested, false);
    blends::<u16, _, _>(&LAYERS, KeepDepth(Replace), OVER, tested, true);
    blends::<NoDepth, _, _>(&LAYERS, Blend(|_, new| new), OVER, tested, false);
}

/// Two materials of different opacity: each pixel has that of the material whose colour it has.
#[test]
fn materials_give_an_alpha() {
    const COLORS: [[u8; 3]; 2] = [[250, 220, 150], [20, 220, 150]];
    const OPACITIES: [u8; 2] = [90, 200];
    let materials = COLORS.map(|color| Material::new(color, 6));
    let finishes = OPACITIES.map(|opacity| Finish::MATTE.with_opacity(opacity));
    let cube = cube();
    let plain = Tables { materials: &materials, ..*cube.mesh().tables() };
    let finished = Mesh::new(Tables { finishes: &finishes, ..plain }).unwrap();
    let plain = Mesh::new(plain).unwrap();
    let camera = at("2.4", DISPLAY);
    let draw = |mesh, opacity: Option<Alpha>| {
        NoDepth::frame(|frame| {
            let object = Object::new(mesh, Unlit::new()).posed(turned());
            match opacity {
                Some(factor) => {
                    let object = object.blended(Over(MaterialOpacity::times(factor)));
                    object.project_on_demand(&camera, S8).unwrap().draw(frame)
                }
                None => object.project_on_demand(&camera, S8).unwrap().draw(frame),
            }
        })
    };
    let opaque = draw(&plain, None);
    assert!(draw(&plain, Some(Alpha::OPAQUE)).color == opaque.color, "no finish is opaque");
    for factor in [Alpha::OPAQUE, Alpha::from_bits(100)] {
        let blend = draw(&finished, Some(factor));
        let mut pixels = [0; 2];
        for (&color, &got) in opaque.color.iter().zip(&blend.color) {
            let of = |&rgb: &[u8; 3]| rgb == [color.r(), color.g(), color.b()];
            let Some(material) = COLORS.iter().position(of) else { continue };
            pixels[material] += 1;
            let alpha = Alpha::from_u8(OPACITIES[material]).scaled(factor);
            assert_eq!(got, blended(OVER, [BACKGROUND, color], alpha));
        }
        assert!(pixels.iter().all(|&pixels| pixels > 100), "{pixels:?}");
    }
}

/// A white ball that fades along its height, in one colour a triangle and shaded, cut by the near
/// plane and the guard band: its alpha as a grey. Fronts and backs are drawn apart, so that few
/// pixels have two layers: those at the outline, where the ball is not quite convex.
#[test]
fn vertices_give_an_alpha() {
    fn height(y: i16) -> u16 {
        ((i32::from(y) + 16_384) / 128).clamp(0, 256) as u16
    }
    const GREY: By<[u16; 1], Rgb888> = By {
        vertex: |[_, y, _]| [height(y) << 7],
        pixel: |fragment| {
            let [alpha] = fragment.varyings;
            let alpha = (alpha.to_bits() + (1 << 22)) >> 23;
            let grey = ((255 * alpha + 128) >> 8) as u8;
            Rgb888::new(grey, grey, grey)
        },
    };
    const ONE: Alpha = Alpha::from_bits(1);
    const WHITE: By<[u16; 0], Rgb888> = by_fragment(|_| Rgb888::new(255, 255, 255));
    fn fades(shader: impl Shader<Color = Rgb888>, culling: impl Culling, eye: &str) -> usize {
        let ball = ball().colored([255; 3]);
        let mesh = ball.mesh();
        let camera = at(eye, DISPLAY);
        let alpha = |vertex: &MeshVertex<'_>| Alpha::from_bits(height(vertex.position()[1]));
        let grey = Object::new(&mesh, GREY).culled(culling);
        let grey = grey.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let faded = Object::new(&mesh, Faded::new(shader, alpha)).culled(culling);
        let faded = faded.blended(Add(Alpha::OPAQUE));
        let faded = faded.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let black = |frame: &mut Frame<'_, Rgb888, &mut [u16]>| frame.clear_color(Rgb888::BLACK);
        let want = u16::frame(|frame| {
            black(frame);
            grey.draw(frame)
        });
        let got = u16::frame(|frame| {
            black(frame);
            faded.draw(frame)
        });
        let layers = Object::new(&mesh, WHITE).culled(culling).blended(KeepDepth(Add(ONE)));
        let layers = layers.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let layers = u16::frame(|frame| {
            black(frame);
            layers.draw(frame)
        });
        let (mut once, mut twice) = (0, 0);
        for (index, point) in DISPLAY.points().enumerate() {
            match layers.color[index].r() {
                0 => assert_eq!(got.color[index], Rgb888::BLACK, "{point} from {eye}"),
                1 => {
                    once += 1;
                    assert_eq!(got.color[index], want.color[index], "{point} from {eye}");
                }
                _ => twice += 1,
            }
        }
        assert!(twice * 50 <= once, "{twice} pixels have two layers from {eye}, {once} have one");
        bands_equal::<u16>(&got, |band| {
            black(band);
            faded.draw(band)
        });
        once
    }
    let mut pixels = 0;
    for eye in EYES {
        pixels += fades(WHITE, CullFront, eye) + fades(Unlit::new(), CullBack, eye);
    }
    assert!(pixels > 5_000, "{pixels}");
}
