//! Varyings in perspective against their definition, u = Σ(bᵢ uᵢ qᵢ) / Σ(bᵢ qᵢ) with the barycentric
//! coordinates bᵢ of a pixel's centre and qᵢ = near / w of the corners, in f64.

use std::convert::Infallible;

use rasterizer::{
    attribute::{
        Adaptive, Affine, Components, Corrected, Correction, Every, EveryPixel, Interpolate,
        InverseW, NoDepth, PerspectiveCorrect, Step as _, Varyings,
    },
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
    raster::{Layout, Primitive as _, Triangle, Window},
    texture::{Clamp, CoordinateFormat, Coordinates, Place, Repeat, Wrap},
};
use rasterizer_tests::Random;

const WINDOW: Window = Window { left: 0, top: 0, right: 320, bottom: 240 };

/// A corner: its place in pixels, near / w, and what it carries.
#[derive(Clone, Copy, Debug)]
struct Corner<V> {
    at: [f64; 2],
    inverse_w: f64,
    value: V,
}

/// What a pixel has by its definition: each number, and how it changes from pixel to pixel.
struct Exact<const N: usize> {
    value: [f64; N],
    slope: [f64; N],
}

/// The definition over a triangle with snapped corners.
struct Definition<const N: usize> {
    places: [[f64; 2]; 3],
    q: [f64; 3],
    values: [[f64; N]; 3],
}

impl<const N: usize> Definition<N> {
    fn at(&self, column: i32, row: i32) -> Exact<N> {
        let [a, b, c] = self.places;
        let p = [f64::from(column) + 0.5, f64::from(row) + 0.5];
        let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
        };
        let whole = area(a, b, c);
        let weights = [area(p, b, c), area(a, p, c), area(a, b, p)].map(|part| part / whole);
        // The weights' changes along x and y.
        let turns = [(b, c), (c, a), (a, b)];
        let along = turns.map(|(from, to)| [(from[1] - to[1]) / whole, (to[0] - from[0]) / whole]);
        let sum = |weights: [f64; 3], of: [f64; 3]| (0..3).map(|i| weights[i] * of[i]).sum::<f64>();
        let q = sum(weights, self.q);
        let mut exact = Exact { value: [0.0; N], slope: [0.0; N] };
        for n in 0..N {
            let products = [0, 1, 2].map(|i| self.values[i][n] * self.q[i]);
            let value = sum(weights, products) / q;
            let slopes = [0, 1].map(|axis| {
                let change = along.map(|weight| weight[axis]);
                (sum(change, products) - value * sum(change, self.q)) / q
            });
            exact.value[n] = value;
            exact.slope[n] = slopes[0].hypot(slopes[1]);
        }
        exact
    }
}

/// Draws a triangle and visits its pixels in the window with what they see.
fn pixels<S: Subpixel, V, M>(
    corners: [Corner<V>; 3],
    mut visit: impl FnMut(i32, i32, Corrected<V::Sample>),
) -> [[f64; 2]; 3]
where
    V: Components + Varyings<OnScreen = V>,
    M: Correction,
{
    let unit = f64::from(1 << S::BITS);
    let places = corners.map(|corner| corner.at.map(|c| (c * unit).round() as i32));
    let vertices = [0, 1, 2].map(|i| {
        let Corner { inverse_w, value, .. } = corners[i];
        let inverse_w = InverseW::from_bits((inverse_w * 2f64.powi(32)) as u32);
        let varyings = PerspectiveCorrect::<V, M>::new(value).on_screen(inverse_w);
        let [x, y] = places[i];
        ScreenVertex::<S, NoDepth, _>::checked(x, y, NoDepth, varyings).unwrap()
    });
    let triangle = Triangle::new(vertices.each_ref()).unwrap();
    let layout = Layout { pitch: 320, origin: 0 };
    let Ok(()) = triangle.for_each_span(&WINDOW, layout, |span| {
        let mut column = span.start as i32 - span.row * 320;
        let (first, rest) = M::OnScreen::<V>::walk(
            span.varyings,
            [span.start as i32, span.row],
            span.end - span.start,
        );
        for piece in [first].into_iter().chain(rest) {
            let mut value = piece.first;
            for _ in 0..piece.pixels {
                visit(column, span.row, M::OnScreen::<V>::sample(value));
                value = value.wrapping_add(piece.step);
                column += 1;
            }
        }
        assert_eq!(column, span.end as i32 - span.row * 320, "all pixels of a span");
        Ok::<(), Infallible>(())
    });
    places.map(|place| place.map(|c| f64::from(c) / unit))
}

/// The largest errors over a triangle's pixels, in texels, over what the bound allows for each.
fn worst<S, T, const W: usize, const H: usize, X, Y, M>(
    corners: [Corner<[T; 2]>; 3],
    bound: f64,
) -> Worst
where
    S: Subpixel,
    T: CoordinateFormat,
    X: Wrap,
    Y: Wrap,
    M: Correction,
{
    let coordinates = corners.map(|corner| Corner {
        at: corner.at,
        inverse_w: corner.inverse_w,
        value: Coordinates::<T, W, H, X, Y>::new(corner.value),
    });
    let repeats = |c: T| f64::from(c.to_q24()) / 2f64.powi(24);
    let mut seen = vec![];
    let places = pixels::<S, _, M>(coordinates, |column, row, sample| {
        seen.push((column, row, sample.value));
    });
    let definition = Definition {
        places,
        q: corners.map(|corner| (corner.inverse_w * 2f64.powi(32)).floor()),
        values: corners.map(|corner| corner.value.map(repeats)),
    };
    let mut worst = Worst::default();
    for (column, row, place) in seen {
        let exact = definition.at(column, row);
        let got = place_in_repeats(place);
        for (n, size) in [W, H].into_iter().enumerate() {
            let mut off = got[n] - exact.value[n];
            if X::IS_PERIODIC && Y::IS_PERIODIC {
                off -= off.round();
            }
            let texels = (off * size as f64).abs();
            // 1/256 of a pixel.
            let allowed = bound.max(exact.slope[n] * size as f64 / 256.0);
            worst.texels = worst.texels.max(texels);
            worst.share = worst.share.max(texels / allowed);
        }
        worst.pixels += 1;
    }
    worst
}

fn place_in_repeats<const W: usize, const H: usize, X: Wrap, Y: Wrap>(
    place: Place<W, H, X, Y>,
) -> [f64; 2] {
    place.uv().map(|c| f64::from(c) / 2f64.powi(24))
}

#[derive(Clone, Copy, Debug, Default)]
struct Worst {
    texels: f64,
    share: f64,
    pixels: usize,
}

impl Worst {
    fn or(self, other: Self) -> Self {
        Self {
            texels: self.texels.max(other.texels),
            share: self.share.max(other.share),
            pixels: self.pixels + other.pixels,
        }
    }
}

/// Random triangles whose coordinates span `repeats` and whose distances have the ratio `ratio`.
fn triangle<T>(
    random: &mut Random,
    repeats: f64,
    ratio: f64,
    coordinate: fn(f64) -> T,
) -> [Corner<[T; 2]>; 3] {
    let mut part = || f64::from(random.within(0, 1 << 20)) / f64::from(1 << 20);
    let nearest = 2f64.powf(-8.0 * part());
    let lengths = [1.0, 1.0 / ratio, (1.0 / ratio).powf(part())];
    let turn = (part() * 3.0) as usize;
    let shape = part();
    let middle = [part() * 320.0, part() * 240.0];
    [0, 1, 2].map(|i| {
        let at = if shape < 0.5 {
            [part() * 900.0 - 290.0, part() * 700.0 - 230.0]
        } else if shape < 0.75 {
            // A sliver.
            let along = part() * 600.0 - 300.0;
            [middle[0] + along, middle[1] + along * 0.37 + part() * 3.0]
        } else {
            [middle[0] + part() * 60.0 - 30.0, middle[1] + part() * 60.0 - 30.0]
        };
        let value = [(part() - 0.5) * repeats, (part() - 0.5) * repeats].map(coordinate);
        Corner { at, inverse_w: nearest * lengths[(i + turn) % 3] * 0.999, value }
    })
}

fn narrow(repeats: f64) -> i16 {
    (repeats * 2f64.powi(14)) as i16
}

fn wide(repeats: f64) -> i32 {
    (repeats * 2f64.powi(24)) as i32
}

const RATIOS: [f64; 5] = [1.0, 2.0, 10.0, 100.0, 1000.0];

fn random_worst<S, T, const W: usize, const H: usize, X, Y, M>(
    repeats: f64,
    coordinate: fn(f64) -> T,
    bound: f64,
) -> Worst
where
    S: Subpixel,
    T: CoordinateFormat,
    X: Wrap,
    Y: Wrap,
    M: Correction,
{
    let mut all = Worst::default();
    for ratio in RATIOS {
        let mut random = Random::new(ratio as u64);
        for _ in 0..60 {
            let corners = triangle(&mut random, repeats, ratio, coordinate);
            all = all.or(worst::<S, T, W, H, X, Y, M>(corners, bound));
        }
    }
    all
}

/// 1/16 of a texel or 1/256 of a pixel, whichever is more.
#[test]
fn every_pixel_is_exact() {
    fn in_precision<S: Subpixel>() {
        for (name, worst) in [
            (
                "128 texels",
                random_worst::<S, i16, 128, 128, Repeat, Repeat, EveryPixel>(
                    1.0,
                    narrow,
                    1.0 / 16.0,
                ),
            ),
            (
                "1,024 texels",
                random_worst::<S, i16, 1024, 1024, Repeat, Repeat, EveryPixel>(
                    1.0,
                    narrow,
                    1.0 / 16.0,
                ),
            ),
            (
                "clamped",
                random_worst::<S, i16, 100, 1000, Clamp, Clamp, EveryPixel>(
                    1.0,
                    narrow,
                    1.0 / 16.0,
                ),
            ),
            (
                "64 repeats",
                random_worst::<S, i32, 1024, 1024, Repeat, Repeat, EveryPixel>(
                    64.0,
                    wide,
                    1.0 / 16.0,
                ),
            ),
        ] {
            eprintln!("S{} {name}: {worst:?}", S::BITS);
            assert!(worst.pixels > 10_000 && worst.share < 1.0, "{name}: {worst:?}");
        }
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

#[test]
fn adaptive_steps_are_within_the_tolerance() {
    fn in_precision<S: Subpixel>() {
        for (name, worst) in [
            (
                "1/2 of 128",
                random_worst::<S, i16, 128, 128, Repeat, Repeat, Adaptive<8>>(
                    1.0,
                    narrow,
                    8.0 / 16.0,
                ),
            ),
            (
                "1/8 of 128",
                random_worst::<S, i16, 128, 128, Repeat, Repeat, Adaptive<2>>(
                    1.0,
                    narrow,
                    2.0 / 16.0,
                ),
            ),
            (
                "1/2 of 256",
                random_worst::<S, i16, 256, 256, Repeat, Repeat, Adaptive<8>>(
                    2.0,
                    narrow,
                    8.0 / 16.0,
                ),
            ),
            (
                "1 of 1,024",
                random_worst::<S, i16, 1024, 1024, Clamp, Clamp, Adaptive<16>>(1.0, narrow, 1.0),
            ),
            (
                "1/2 of 64 repeats",
                random_worst::<S, i32, 1024, 1024, Repeat, Repeat, Adaptive<8>>(
                    64.0,
                    wide,
                    8.0 / 16.0,
                ),
            ),
        ] {
            eprintln!("S{} {name}: {worst:?}", S::BITS);
            assert!(worst.pixels > 10_000 && worst.share < 1.0, "{name}: {worst:?}");
        }
    }
    in_precision::<S4>();
    in_precision::<S8>();
}
