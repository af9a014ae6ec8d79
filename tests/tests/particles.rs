//! Particles against the reference: where they are, which pixels they own, what each shows, hidden
//! and blended from back to front; alike in bands, and refused before the first pixel.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::{PointsIter as _, Rectangle},
};
use host_tools::reference::{self, Blend, Layer, ScreenPoint, Sprite};
use rasterizer::{
    attribute::{DepthFormat as _, NoDepth},
    camera::{Camera, Distance, Perspective},
    color::Alpha,
    geometry::{AsParticle, Particle, ScreenParticle, ScreenVertex},
    numbers::{S8, Scalar, Vec3},
    output::{Add, Blending, Direct, Frame, KeepDepth, Multiply, Over, Replace, Screen},
    scene::{Object, Particles, ProjectError},
    shade::{Frames, Squares, Unlit},
    texture::{Clamp, Colors, Texture, Translucent},
};
use rasterizer_tests::{
    Counter, Picture, Random,
    bands::{BACKGROUND, DISPLAY, Depth, ROWS, at, ball, picture},
};

const SIDE: usize = 8;
const TEXEL_COUNT: usize = SIDE * SIDE;
static COLORS: [[Rgb888; TEXEL_COUNT]; 2] = {
    let mut colors = [[Rgb888::BLACK; TEXEL_COUNT]; 2];
    let mut i = 0;
    while i < TEXEL_COUNT {
        colors[0][i] = Rgb888::new(250 - 3 * i as u8, 4 * i as u8, 90);
        colors[1][i] = Rgb888::new(40 + i as u8, 200, 255 - 2 * i as u8);
        i += 1;
    }
    colors
};
static ALPHAS: [u8; TEXEL_COUNT] = {
    let mut alphas = [0; TEXEL_COUNT];
    let mut i = 0;
    while i < TEXEL_COUNT {
        alphas[i] = (i * 37 % 256) as u8;
        i += 1;
    }
    alphas
};
type Sheet = Texture<
    Translucent<'static, Colors<'static, Rgb888, TEXEL_COUNT>, 8, TEXEL_COUNT>,
    SIDE,
    SIDE,
    Clamp,
    Clamp,
>;
static SHEETS: [Sheet; 2] = [
    Texture::new(Translucent::new(Colors::new(&COLORS[0]), &ALPHAS)),
    Texture::new(Translucent::new(Colors::new(&COLORS[1]), &ALPHAS)),
];

/// Particles all round a ball of radius 1, some of them in it, in many sizes.
fn cloud(count: usize, seed: u64) -> Vec<Particle<Rgb888>> {
    let mut random = Random::new(seed);
    let mut between = |least: i32, most: i32| random.within(least, most);
    (0..count)
        .map(|_| {
            let place = Vec3::from_bits([0; 3].map(|_| between(-0x1_8000, 0x1_8000)));
            let size = Distance::from_bits(between(0x800, 0x6000).cast_unsigned());
            let mut channel = || between(0, 255) as u8;
            let color = Rgb888::new(channel(), channel(), channel());
            let alpha = Alpha::from_bits(between(0, 256) as u16);
            Particle { place, size, color, alpha, frame: between(0, 1) as u16 }
        })
        .collect()
}

/// A square of the definition.
fn sprite(place: &ScreenParticle) -> Sprite {
    let middle = [
        2 * DISPLAY.top_left.x + DISPLAY.size.width.cast_signed(),
        2 * DISPLAY.top_left.y + DISPLAY.size.height.cast_signed(),
    ];
    let side = i64::from(place.side());
    let corner = [0, 1].map(|axis| i64::from(8 * middle[axis] + place.middle()[axis]) - side / 2);
    Sprite { corner, side, subpixel_bits: 4 }
}

fn pixels() -> impl Iterator<Item = [i64; 2]> {
    DISPLAY.points().map(|point| [point.x, point.y].map(i64::from))
}

/// From cameras that look anywhere, by the reference's camera: the middle, the side and the depth.
#[test]
fn particles_are_where_the_reference_camera_sees_them() {
    let particles = cloud(300, 1);
    let (near, far) = (Distance::lit("0.25"), Distance::lit("20"));
    let focal = 55.0;
    let lens = Perspective::with_focal_length(Distance::from_num(focal), near, far).unwrap();
    let mut seen_count = 0;
    for eye in [["0.1", "0.4", "4"], ["-2", "1", "0.7"], ["0.3", "-0.2", "0.1"]] {
        let [x, y, z] = eye.map(Scalar::lit);
        let (eye, target) = (Vec3::new(x, y, z), Vec3::lit("0.2", "0", "-0.3"));
        let camera = Camera::look_at(eye, target, Vec3::Y, lens, DISPLAY).unwrap();
        let numbers = |v: Vec3| v.to_bits().map(|c| f64::from(c) / 65_536.0);
        let exact = reference::Camera {
            eye: numbers(eye),
            target: numbers(target),
            up: [0.0, 1.0, 0.0],
            projection: reference::Projection::Perspective {
                focal_length_px: focal,
                near: 0.25,
                far: 20.0,
            },
            viewport: reference::Viewport { x: 0.0, y: 0.0, width: 0.0, height: 0.0 },
        };
        let mut storage = vec![ScreenParticle::EMPTY; particles.len()];
        let seen = Particles::new(&particles, Squares).project(&camera, &mut storage).unwrap();
        seen_count += seen.places().len();
        let mut numbers_seen = seen.places().iter().map(ScreenParticle::number).collect::<Vec<_>>();
        for place in seen.places() {
            let particle = &particles[usize::from(place.number())];
            let ScreenPoint { x, y, depth, inverse_w } =
                exact.to_screen(exact.to_view(numbers(particle.place)));
            // Half a 16th for snapping, an eighth of it for arithmetic.
            for (got, want) in place.middle().into_iter().zip([x, y]) {
                assert!((f64::from(got) - 16.0 * want).abs() < 0.625, "{got} {want}");
            }
            let side = (16.0 * focal * particle.size.to_num::<f64>() * inverse_w).max(16.0);
            assert!((f64::from(place.side()) - side).abs() < 0.625, "{} {side}", place.side());
            assert!((f64::from(place.depth()) / 2f64.powi(32) - depth).abs() < 2f64.powi(-25));
        }
        // Those left out are before the near plane or outside the picture.
        numbers_seen.dedup();
        for (number, particle) in (0..).zip(&particles) {
            let view = exact.to_view(numbers(particle.place));
            if numbers_seen.contains(&number) || view[2] > -0.25 {
                continue;
            }
            let point = exact.to_screen(view);
            let half = focal * particle.size.to_num::<f64>() * point.inverse_w / 2.0;
            let size = [DISPLAY.size.width, DISPLAY.size.height].map(f64::from);
            let is_outside =
                point.x.abs() > size[0] / 2.0 + half || point.y.abs() > size[1] / 2.0 + half;
            assert!(is_outside || point.x.abs().max(point.y.abs()) > 1023.9, "{number} {point:?}");
        }
    }
    assert!(seen_count > 300, "{seen_count}");
}

/// A colour, an alpha and a depth that the definition has at a pixel, and how far these may be off
/// in steps of 8 bits.
struct Defined {
    layer: Layer,
    bound: f64,
}

/// The layer of a particle at a pixel that it owns; `None` if a border of texels is too near for
/// one right answer.
fn defined(particle: &Particle<Rgb888>, [u, v]: [f64; 2]) -> Option<Defined> {
    // `Frames` is within a 128th of a texel.
    const NEAR: f64 = 1.0 / 128.0;
    let texel = [u, v].map(|c| c * SIDE as f64);
    if texel.iter().any(|c| c.fract() < NEAR) {
        return None;
    }
    let [column, row] = texel.map(|c| c as usize);
    let index = row * SIDE + column;
    let channels = |color: Rgb888| [color.r(), color.g(), color.b()].map(f64::from);
    let (texel, tint) =
        (channels(COLORS[usize::from(particle.frame)][index]), channels(particle.color));
    let alpha = f64::from(ALPHAS[index]) / 255.0 * f64::from(particle.alpha.to_bits()) / 256.0;
    // The alpha of the texel and the product are rounded to a 256th: a step of the colour each.
    // The tinted colour is rounded to a step.
    Some(Defined {
        layer: Layer { color: [0, 1, 2].map(|i| texel[i] * tint[i] / 255.0), alpha },
        bound: 2.0 * 0.5 + 0.5 * alpha,
    })
}

/// Each pixel has the blended layers of the particles that are before the ball, the farthest first.
fn are_blended<B>(blend: Blend, blending: B, eye: &str) -> [usize; 3]
where
    B: Copy + for<'f> Blending<Frame<'f, Rgb888, &'f mut [u32]>>,
{
    let particles = cloud(250, 2);
    let camera = at(eye, DISPLAY);
    let ball = ball();
    let mesh = ball.mesh();
    let mut vertices = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let body = object.project(&camera, &mut vertices).unwrap();
    let mut storage = vec![ScreenParticle::EMPTY; particles.len()];
    let mut order = vec![0; particles.len()];
    let all = Particles::new(&particles, Frames::new(&SHEETS).tinted()).blended(blending);
    let seen = all.project(&camera, &mut storage).unwrap();
    let mut sorted: Vec<_> = seen.places().to_vec();
    let seen = seen.back_to_front(&mut order).unwrap();

    let mut before = Picture::<Rgb888, u32>::empty(DISPLAY, BACKGROUND);
    let mut frame = Frame::new(&mut before.color, &mut before.depth[..], DISPLAY).unwrap();
    body.draw(&mut frame).unwrap();
    let mut after = before.clone();
    let mut frame = Frame::new(&mut after.color, &mut after.depth[..], DISPLAY).unwrap();
    seen.draw(&mut frame).unwrap();
    sorted.sort_by_key(|place| (place.depth() >> 1, place.number()));
    let [mut compared, mut most, mut hidden] = [0; 3];
    for (index, pixel) in pixels().enumerate() {
        let channels = |color: Rgb888| [color.r(), color.g(), color.b()].map(f64::from);
        let (mut exact, mut bound, mut layers) = (channels(before.color[index]), 0.0, 0);
        let mut is_clear = true;
        for place in &sorted {
            let square = sprite(place);
            if !square.owns(pixel) {
                continue;
            }
            if !u32::from_fraction(place.depth()).is_nearer(before.depth[index]) {
                hidden += 1;
                continue;
            }
            let particle = &particles[usize::from(place.number())];
            let Some(Defined { layer, bound: of_layer }) = defined(particle, square.place(pixel))
            else {
                is_clear = false;
                break;
            };
            exact = blend.put(exact, layer);
            // Each result is rounded to a step.
            let passes = (0..3).map(|i| blend.passes(layer, i)).fold(0.0, f64::max);
            bound = bound * passes + of_layer + 0.5;
            layers += 1;
        }
        assert_eq!(after.depth[index], before.depth[index], "{pixel:?}");
        if !is_clear {
            continue;
        }
        compared += usize::from(layers > 0);
        most = most.max(layers);
        let error = (exact.into_iter().zip(channels(after.color[index])))
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(error <= bound + 1e-9, "{blend:?} {pixel:?}: {error} of {bound}, {layers} layers");
    }
    [compared, most, hidden]
}

#[test]
fn blended_particles_are_those_of_the_definition() {
    for eye in ["3", "1.7"] {
        for found in [
            are_blended(Blend::Over, KeepDepth(Over(Alpha::OPAQUE)), eye),
            are_blended(Blend::Add, KeepDepth(Add(Alpha::OPAQUE)), eye),
            are_blended(Blend::Multiply, KeepDepth(Multiply(Alpha::OPAQUE)), eye),
            are_blended(Blend::Screen, KeepDepth(Screen(Alpha::OPAQUE)), eye),
        ] {
            let [compared, most, hidden] = found;
            assert!(compared > 1000 && most >= 5 && hidden > 300, "{eye}: {found:?}");
        }
    }
}

/// Opaque squares that store their depth, and layers over them, in the slice's order and sorted,
/// with every depth format.
#[test]
fn bands_join_without_a_seam() {
    fn check<D: Depth>() {
        let (opaque, clear) = (cloud(40, 3), cloud(100, 4));
        let camera = at("3", DISPLAY);
        let mut storage = [(); 2].map(|()| vec![ScreenParticle::EMPTY; 100]);
        let [first, second] = &mut storage;
        let mut order = vec![0; 100];
        let opaque = Particles::new(&opaque, Squares).project(&camera, first).unwrap();
        let clear = Particles::new(&clear, Frames::new(&SHEETS)).blended(Over(Alpha::lit("0.7")));
        let clear = clear.project(&camera, second).unwrap().back_to_front(&mut order).unwrap();
        let draw = |band: &mut Frame<'_, Rgb888, D::Buffer<'_>>| {
            opaque.draw(band)?;
            clear.draw(band)
        };
        let whole = picture::<D>(ROWS, draw);
        assert!(whole.drawn(BACKGROUND).len() > 500);
        for rows in [1, 5, 16, 46] {
            assert!(whole == picture::<D>(rows, draw), "in bands of {rows} rows");
        }
    }
    check::<u16>();
    check::<u32>();
    check::<NoDepth>();
}

/// Straight onto a display, which has no depth: each square's pixels, and no others. The bounds are
/// the least that hold them.
#[test]
fn squares_own_the_pixels_of_the_definition() {
    let mut sizes = [0; 2];
    for (is_in_pixels, eye) in [(false, "3"), (true, "3"), (false, "1.2")] {
        for particle in cloud(150, 5) {
            let size = if is_in_pixels { particle.size * 40 } else { particle.size };
            let one = [Particle { size, alpha: Alpha::OPAQUE, ..particle }];
            let mut storage = [ScreenParticle::EMPTY];
            let camera = at(eye, DISPLAY);
            let mut all = Particles::new(&one, Squares);
            if is_in_pixels {
                all = all.in_pixels();
            }
            let seen = all.project(&camera, &mut storage).unwrap();
            let mut counter = Counter::<Rgb888>::new(DISPLAY);
            seen.draw(&mut Direct::new(&mut counter)).unwrap();
            let owns =
                |pixel| u32::from(seen.places().iter().any(|place| sprite(place).owns(pixel)));
            let owned: Vec<_> = pixels().map(owns).collect();
            assert_eq!(counter.counts(), owned, "{one:?}");
            let drawn: Vec<_> = DISPLAY
                .points()
                .zip(&owned)
                .filter_map(|(point, &count)| (count > 0).then_some(point))
                .collect();
            let corners = drawn.first().zip(drawn.last());
            let bounds = corners.map(|(first, last)| Rectangle::with_corners(*first, *last));
            assert_eq!(seen.bounds(), bounds, "{one:?}");
            sizes[0] += usize::from(drawn.len() == 1);
            sizes[1] += usize::from(drawn.len() > 100);
        }
    }
    assert!(sizes.iter().all(|&count| count > 10), "{sizes:?}");
}

/// A type of the program's own.
#[derive(Clone, Copy)]
struct Spark(i32);

impl AsParticle for Spark {
    type Color = Rgb888;

    fn particle(&self) -> Particle<Rgb888> {
        let place = Vec3::new(Scalar::ZERO, Scalar::ZERO, Scalar::from_num(self.0) / 8);
        Particle::new(place, Distance::lit("0.2"), Rgb888::new(self.0 as u8, 0, 0))
    }
}

#[test]
fn the_farthest_comes_first() {
    // Nearer ones have larger numbers here; the slice has them in another order.
    let sparks: Vec<_> = (0..16).map(|i| Spark(i * 5 % 16)).collect();
    let mut storage = vec![ScreenParticle::EMPTY; 16];
    let mut order = vec![0; 16];
    let camera = at("3", DISPLAY);
    let seen = Particles::new(&sparks, Squares).project(&camera, &mut storage).unwrap();
    let sorted = seen.back_to_front(&mut order).unwrap();
    let reds = |screen: rasterizer_tests::bands::Screen<Rgb888>| -> Vec<u8> {
        let colors = screen.pixels.into_iter().flatten();
        colors.filter(|&color| color != BACKGROUND).map(|color| color.r()).collect()
    };
    let (bare, near) = (
        reds(picture::<NoDepth>(ROWS, |frame| sorted.draw(frame))),
        reds(picture::<u32>(ROWS, |frame| seen.draw(frame))),
    );
    // Sorted without depth, as with a depth test in any order; unsorted it is another picture.
    assert_eq!(bare, near);
    assert_ne!(bare, reds(picture::<NoDepth>(ROWS, |frame| seen.draw(frame))));
    assert!(bare.contains(&15) && bare.len() > 30, "{bare:?}");
}

#[test]
fn too_little_storage_is_an_error_before_the_first_pixel() {
    let particles = cloud(20, 6);
    let camera = at("3", DISPLAY);
    let all = Particles::new(&particles, Squares);
    let mut storage = [ScreenParticle::EMPTY; 20];
    let refused = all.project(&camera, &mut storage[..19]).unwrap_err();
    assert_eq!(refused, ProjectError::ParticleStorage { needed: 20 });
    assert!(refused.to_string().contains("20 particles"), "{refused}");
    let seen = all.project(&camera, &mut storage).unwrap();
    assert_eq!(
        seen.back_to_front(&mut [0; 19]).unwrap_err(),
        ProjectError::SortStorage { needed: 20 }
    );
    let many = vec![particles[0]; (1 << 16) + 1];
    let mut storage = vec![ScreenParticle::EMPTY; many.len()];
    let refused = Particles::new(&many, Squares).project(&camera, &mut storage).unwrap_err();
    assert_eq!(refused, ProjectError::TooManyParticles);
    let most = Particles::new(&many[1..], Squares);
    assert_eq!(most.project(&camera, &mut storage).unwrap().places().len(), 1 << 16);
    // No particles, nothing to draw.
    let none: [Particle<Rgb888>; 0] = [];
    let none = Particles::new(&none, Squares).project(&camera, &mut []).unwrap();
    let none = none.back_to_front(&mut []).unwrap();
    assert!(picture::<u16>(ROWS, |frame| none.draw(frame)).drawn(BACKGROUND).is_empty());
    assert_eq!(none.bounds(), None);
}

/// Where pixels are replaced, an alpha below half is left out.
#[test]
fn replaced_pixels_test_their_alpha() {
    let opaque = Particle::new(Vec3::ZERO, Distance::lit("0.5"), Rgb888::WHITE);
    let camera = at("3", DISPLAY);
    for (alpha, is_drawn) in [(127, false), (128, true)] {
        let one = [Particle { alpha: Alpha::from_bits(alpha), ..opaque }];
        let mut storage = [ScreenParticle::EMPTY];
        let seen = Particles::new(&one, Squares).blended(Replace);
        let seen = seen.project(&camera, &mut storage).unwrap();
        let drawn = picture::<u16>(ROWS, |frame| seen.draw(frame)).drawn(BACKGROUND);
        assert_eq!(!drawn.is_empty(), is_drawn, "{alpha}");
    }
}
