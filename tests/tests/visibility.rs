//! The visibility buffer: its triangles are those that a depth buffer shows, its barycentric
//! coordinates those of the definition, and deferred shading is direct shading.

use std::convert::Infallible;

use embedded_graphics::{geometry::Point, pixelcolor::Rgb888, primitives::Rectangle};
use rasterizer::{
    attribute::{Affine, Correction, EveryPixel, NoDepth},
    camera::{Camera, Distance, Perspective},
    geometry::{CullNone, Pose, ScreenVertex},
    mesh::{Material, Mesh, Positions, Tables, Triangles},
    numbers::{Rotation, S4, S8, Scale, Subpixel, Vec3},
    output::{Frame, StoredColor},
    scene::Object,
    shade::{
        Deferred, Gouraud, Level, Light, OnScreen, Phong, Shader, Visibility, Visible, VisiblePixel,
    },
};
use rasterizer_tests::{
    Random, area,
    bands::{BACKGROUND, DISPLAY, EYES, Position, at, ball, light},
};

/// A display about the origin, so that places on it are directions.
const AROUND: Rectangle = area(-40, -30, 80, 60);
const FOCAL_LENGTH: f64 = 64.0;
const NEAR: f64 = 0.125;
const MATERIALS: [Material; 1] = [Material::new([1; 3], 2)];
/// A quantum of the mesh: 2^-7.
const QUANTUM: f64 = 1.0 / 128.0;

fn camera() -> Camera {
    let [focal_length, near, far] = [FOCAL_LENGTH, NEAR, 1000.0].map(Distance::from_num);
    let lens = Perspective::with_focal_length(focal_length, near, far).unwrap();
    Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, AROUND).unwrap()
}

/// The coordinates of the place in a triangle that is seen in a direction. A corner is its place on
/// the display times its w, and w (Olano and Greer, *Triangle Scan Conversion using 2D Homogeneous
/// Coordinates*, 1997): corners behind the eye have one too.
fn weights(corners: [[f64; 3]; 3], [x, y]: [f64; 2]) -> [f64; 3] {
    let volume = |a: [f64; 3], b: [f64; 3]| {
        x * (a[1] * b[2] - a[2] * b[1])
            + y * (a[2] * b[0] - a[0] * b[2])
            + (a[0] * b[1] - a[1] * b[0])
    };
    let [a, b, c] = corners;
    let parts = [volume(b, c), volume(c, a), volume(a, b)];
    parts.map(|part| part / parts.iter().sum::<f64>())
}

/// The pixels of a visibility buffer, and a triangle's corners on the screen if it is not clipped.
type Drawn = (Vec<VisiblePixel>, Option<[[f64; 2]; 3]>);

/// Draws a triangle; `None` if it comes too near.
fn drawn<S: Subpixel, M: Correction>(positions: &[[i16; 3]; 3], mode: M) -> Option<Drawn> {
    let mesh = Mesh::new(Tables {
        positions: Positions::I16(positions),
        scale: Scale::new(1, -7),
        // The one that is looked at is the second.
        triangles: Triangles::U8(&[[0, 0, 0], [0, 1, 2]]),
        materials: &MATERIALS,
        ..Tables::EMPTY
    })
    .unwrap();
    let shader = Visibility::of_object(9).corrected(mode);
    let object = Object::new(&mesh, shader).culled(CullNone);
    let mut stored = [ScreenVertex::<S, u32, OnScreen<Visibility<M>>>::EMPTY; 3];
    let camera = camera();
    let seen = object.project(&camera, &mut stored).ok()?;
    let mut pixels = vec![VisiblePixel::NONE; 80 * 60];
    let mut depth = vec![0; 80 * 60];
    let Ok(()) = seen.draw(&mut Frame::new(&mut pixels, &mut depth, AROUND).unwrap());
    let bits = S::BITS;
    let places: Vec<_> = (seen.vertices().iter())
        .filter_map(|vertex| vertex.position())
        .map(|place| place.map(|c| f64::from(c) / f64::from(1 << bits)))
        .collect();
    Some((pixels, places.try_into().ok()))
}

/// How a triangle is judged.
#[derive(Default)]
struct Judged {
    triangles: usize,
    clipped: usize,
    pixels: usize,
    /// The largest error beyond rounding, in units.
    worst: f64,
    worst_ratio: f64,
}

/// Random triangles at up to 1:1,000, with corners behind the eye and beside the picture.
fn judge<S: Subpixel, M: Correction>(mode: M, farthest: i32, in_space: bool) -> Judged {
    let mut random = Random::new(71);
    let mut judged = Judged::default();
    for _ in 0..6_000 {
        let positions: [[i16; 3]; 3] = std::array::from_fn(|_| {
            let w = random.within(1, 8) * random.within(4, farthest / 8);
            let w = if random.within(0, 5) == 0 { -w } else { w };
            let [x, y] = [40, 30].map(|half| {
                let reach = i64::from(w.abs()) * 2 * half / FOCAL_LENGTH as i64;
                random.within(-reach as i32, reach as i32)
            });
            [x, y, -w].map(|c| c.clamp(-32_000, 32_000) as i16)
        });
        let Some((pixels, places)) = drawn::<S, M>(&positions, mode) else { continue };
        let w = positions.map(|[_, _, z]| f64::from(-z) * QUANTUM);
        let corners: [[f64; 3]; 3] = std::array::from_fn(|i| match places {
            Some(places) => [places[i][0] * w[i], places[i][1] * w[i], w[i]],
            None => {
                let [x, y, _] = positions[i].map(|c| f64::from(c) * QUANTUM * FOCAL_LENGTH);
                [x, -y, w[i]]
            }
        });
        if !in_space && places.is_none() {
            continue;
        }
        let nearest = w.iter().fold(f64::MAX, |least, &w| least.min(w)).max(NEAR);
        let ratio = w.iter().fold(0.0, |most: f64, &w| most.max(w)) / nearest;
        judged.triangles += 1;
        judged.clipped += usize::from(places.is_none());
        judged.worst_ratio = judged.worst_ratio.max(ratio);
        // Units of Q0.16. The stored near / w is within a unit of Q0.32.
        let bound = if in_space {
            let stored = nearest * ratio / NEAR * (-32f64).exp2();
            65_536.0 * (ratio * (-27f64).exp2() + (-26f64).exp2() + stored)
        } else {
            1.0 / 64.0
        };
        for (index, pixel) in pixels.iter().enumerate() {
            let Some(object) = pixel.object() else { continue };
            assert_eq!((object, pixel.triangle()), (9, 1));
            judged.pixels += 1;
            let place = [index as f64 % 80.0 - 39.5, (index / 80) as f64 - 29.5];
            let flat = |corners: [[f64; 3]; 3]| {
                if in_space { corners } else { corners.map(|[x, y, w]| [x / w, y / w, 1.0]) }
            };
            let exact = weights(flat(corners), place);
            let got = pixel.weights();
            assert_eq!(got.iter().map(|&weight| u32::from(weight)).sum::<u32>(), 65_535);
            // A clipped triangle has no snapped corners: three times what a sub-pixel changes, half
            // of one for each corner of a piece.
            let slack = if places.is_some() {
                0.0
            } else {
                let step = 1.0 / f64::from(1 << S::BITS);
                let moved = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]].map(|by| {
                    let other = weights(corners, [place[0] + by[0], place[1] + by[1]]);
                    (0..3).map(|i| (other[i] - exact[i]).abs()).fold(0.0, f64::max)
                });
                3.0 * 65_535.0 * moved.into_iter().fold(0.0, f64::max)
            };
            for (corner, (got, exact)) in got.into_iter().zip(exact).enumerate() {
                let error = (f64::from(got) - 65_535.0 * exact).abs();
                // Two are rounded, and the third has what both are off.
                let parts = if corner == 2 { 2.0 } else { 1.0 };
                let limit = parts * (0.5 + bound) + slack;
                assert!(
                    error <= limit,
                    "{positions:?} at {place:?}: {got} for {}, {error} beyond {limit}",
                    65_535.0 * exact
                );
                if slack == 0.0 {
                    judged.worst = judged.worst.max(error - parts * 0.5);
                }
            }
        }
    }
    judged
}

#[test]
fn coordinates_in_space_are_those_of_the_definition() {
    let judged = judge::<S8, _>(EveryPixel, 32_000, true);
    assert!(judged.triangles > 2_000 && judged.clipped > 500 && judged.pixels > 200_000);
    assert!(judged.worst_ratio > 900.0, "{}", judged.worst_ratio);
    println!("in space: {:.3} of a unit beyond rounding", judged.worst);
    let coarse = judge::<S4, _>(EveryPixel, 800, true);
    assert!(coarse.triangles > 2_000 && coarse.pixels > 200_000);
}

#[test]
fn coordinates_on_the_screen_are_those_of_the_definition() {
    let judged = judge::<S8, _>(Affine, 8_000, false);
    assert!(judged.triangles > 1_000 && judged.clipped == 0 && judged.pixels > 100_000);
    println!("on the screen: {:.3} of a unit beyond rounding", judged.worst);
}

/// An object's pose, and its number.
const POSES: [(Pose, u8); 2] = [
    (Pose::IDENTITY, 0),
    (Pose::IDENTITY.at(Vec3::lit("0.5", "0.2", "0.6")).scaled(Distance::lit("0.6")), 254),
];

/// Bands of the display.
fn bands(rows: u32) -> impl Iterator<Item = Rectangle> {
    let Rectangle { top_left, size } = DISPLAY;
    (0..size.height).step_by(rows as usize).map(move |row| {
        let height = rows.min(size.height - row);
        area(top_left.x, top_left.y + row as i32, size.width, height)
    })
}

/// A band of the visibility buffer of all balls.
fn buffer<S: Subpixel, V: Shader<Color: StoredColor + Default>>(
    mesh: &Mesh<'_>,
    camera: &Camera,
    band: Rectangle,
    shader: impl Fn(u8) -> V,
) -> Vec<V::Color> {
    let pixels = (band.size.width * band.size.height) as usize;
    let mut buffer = vec![V::Color::default(); pixels];
    let mut depth = vec![0u16; pixels];
    let mut frame = Frame::new(&mut buffer, &mut depth, band).unwrap();
    for (pose, number) in POSES {
        let object = Object::new(mesh, shader(number)).posed(pose).culled(CullNone);
        if let Ok(object) = object.project_on_demand::<_, S, u16>(camera, S::default()) {
            let Ok::<(), Infallible>(()) = object.draw(&mut frame);
        }
    }
    buffer
}

/// A band of which each pixel that is visible is shaded.
fn shaded<S: Subpixel, Sh: Shader<Color = Rgb888> + Copy, P: Visible>(
    mesh: &Mesh<'_>,
    camera: &Camera,
    band: Rectangle,
    shader: Sh,
    buffer: &[P],
) -> Vec<Rgb888> {
    let mut colors = vec![BACKGROUND; buffer.len()];
    let mut frame = Frame::without_depth(&mut colors, band).unwrap();
    for (pose, number) in POSES {
        let shader = Deferred::new(shader, number, buffer, band);
        let object = Object::new(mesh, shader).posed(pose).culled(CullNone);
        if let Ok(object) = object.project_on_demand::<_, S, NoDepth>(camera, S::default()) {
            let Ok::<(), Infallible>(()) = object.draw(&mut frame);
        }
    }
    colors
}

fn deferred_is_direct<S: Subpixel, Sh: Shader<Color = Rgb888> + Copy>(shader: Sh) {
    let ball = ball();
    let mesh = ball.mesh();
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let pixels = (DISPLAY.size.width * DISPLAY.size.height) as usize;
        let mut direct = vec![BACKGROUND; pixels];
        let mut depth = vec![0u16; pixels];
        let mut frame = Frame::new(&mut direct, &mut depth, DISPLAY).unwrap();
        for (pose, _) in POSES {
            let object = Object::new(&mesh, shader).posed(pose).culled(CullNone);
            // An object that is too large for how near it comes is refused, each time.
            if let Ok(seen) = object.project_on_demand::<_, S, u16>(&camera, S::default()) {
                let Ok::<(), Infallible>(()) = seen.draw(&mut frame);
            }
        }
        for rows in [DISPLAY.size.height, 16, 1] {
            let mut picture = Vec::new();
            for band in bands(rows) {
                let pixels = buffer::<S, _>(&mesh, &camera, band, Visibility::of_object);
                let seen = |number| Visibility::of_object(number).without_weights();
                let triangles = buffer::<S, _>(&mesh, &camera, band, seen);
                for (pixel, seen) in pixels.iter().zip(&triangles) {
                    assert_eq!(pixel.object(), seen.object());
                    assert_eq!(pixel.triangle(), seen.triangle());
                }
                let colors = shaded::<S, _, _>(&mesh, &camera, band, shader, &pixels);
                assert!(colors == shaded::<S, _, _>(&mesh, &camera, band, shader, &triangles));
                picture.extend(colors);
            }
            assert!(picture == direct, "{rows} rows from {eye}");
        }
        let drawn = direct.iter().filter(|&&color| color != BACKGROUND).count();
        assert!(drawn > 400 || eye < "1.5" && S::BITS == 4, "{drawn} from {eye}");
    }
}

#[test]
fn deferred_shading_is_direct_shading() {
    deferred_is_direct::<S8, _>(Gouraud::new(light()));
    deferred_is_direct::<S4, _>(Position);
    let sun = Light::new(Vec3::lit("1", "2", "3"), Level::lit("0.2"), Level::lit("0.8"));
    deferred_is_direct::<S8, _>(Phong::new(sun));
}

/// What a buffer does not have is not drawn.
#[test]
fn pixels_beside_the_buffer_are_hidden() {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("1.7", DISPLAY);
    let part = area(DISPLAY.top_left.x + 20, DISPLAY.top_left.y + 15, 12, 9);
    let mut buffer = vec![VisiblePixel::NONE; 12 * 9];
    let mut depth = vec![0u16; 12 * 9];
    let object = Object::new(&mesh, Visibility::of_object(1));
    let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
    let Ok(()) = seen.draw(&mut Frame::new(&mut buffer, &mut depth, part).unwrap());
    assert!(buffer.iter().all(|pixel| pixel.object() == Some(1)));
    for (object, wanted) in [(1, 12 * 9), (2, 0)] {
        let pixels = (DISPLAY.size.width * DISPLAY.size.height) as usize;
        let mut colors = vec![BACKGROUND; pixels];
        let shader = Deferred::new(Position, object, &buffer, part);
        let seen = Object::new(&mesh, shader);
        let seen = seen.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        let Ok(()) = seen.draw(&mut Frame::without_depth(&mut colors, DISPLAY).unwrap());
        let drawn = (0..).zip(&colors).filter(|(_, color)| **color != BACKGROUND);
        let inside = drawn.clone().all(|(index, _): (i32, _)| {
            let width = DISPLAY.size.width as i32;
            part.contains(DISPLAY.top_left + Point::new(index % width, index / width))
        });
        assert!(inside && drawn.count() == wanted, "object {object}");
    }
}
