//! Varyings in perspective against their definition, u = Σ(bᵢ uᵢ qᵢ) / Σ(bᵢ qᵢ) with the
//! barycentric coordinates bᵢ of a pixel's centre and qᵢ = near / w of the corners, in f64.
//!
//! Where it is divided, a texture coordinate is within 1/16 of a texel or 1/256 of a pixel,
//! whichever is more; with a tolerance within that or 1/256 of a pixel. A pixel's worth is how much
//! the exact coordinate changes over it.

use std::convert::Infallible;

use embedded_graphics::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use fixed::types::{I16F16, U16F16};
use rasterizer::{
    attribute::{
        Adaptive, Affine, Components, Corrected, Correction, Every, EveryPixel, Interpolate,
        InverseW, NoDepth, PerspectiveCorrect, Step as _, Varyings,
    },
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
    raster::{Layout, Primitive as _, Triangle, Window},
    texture::{Clamp, CoordinateFormat, Coordinates, Mirror, Place, Repeat, Wrap},
};
use rasterizer_tests::Random;

const WINDOW: Window = Window::new(&Rectangle::new(Point::zero(), Size::new(320, 240)));

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
    q: Linear,
    /// Of the numbers times q.
    products: [Linear; N],
}

/// A function that is linear on the screen: its value at the first corner and its changes along x
/// and y.
#[derive(Clone, Copy)]
struct Linear {
    origin: [f64; 2],
    value: f64,
    change: [f64; 2],
}

impl Linear {
    fn through([a, b, c]: [[f64; 2]; 3], values: [f64; 3]) -> Self {
        let (to_b, to_c) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let (by_b, by_c) = (values[1] - values[0], values[2] - values[0]);
        let area = to_b[0] * to_c[1] - to_c[0] * to_b[1];
        let change =
            [(by_b * to_c[1] - by_c * to_b[1]) / area, (by_c * to_b[0] - by_b * to_c[0]) / area];
        Self { origin: a, value: values[0], change }
    }

    fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.value + self.change[0] * (x - self.origin[0]) + self.change[1] * (y - self.origin[1])
    }
}

impl<const N: usize> Definition<N> {
    fn new(places: [[f64; 2]; 3], q: [f64; 3], values: [[f64; N]; 3]) -> Self {
        let product = |n: usize| [0, 1, 2].map(|i| values[i][n] * q[i]);
        Self {
            q: Linear::through(places, q),
            products: std::array::from_fn(|n| Linear::through(places, product(n))),
        }
    }

    fn at(&self, column: i32, row: i32) -> Exact<N> {
        let p = [f64::from(column) + 0.5, f64::from(row) + 0.5];
        let inverse = 1.0 / self.q.at(p);
        let value = self.products.map(|product| product.at(p) * inverse);
        let slope = std::array::from_fn(|n| {
            let [x, y] = [0, 1].map(|axis| {
                (self.products[n].change[axis] - value[n] * self.q.change[axis]) * inverse
            });
            (x * x + y * y).sqrt()
        });
        Exact { value, slope }
    }
}

/// Q0.32.
fn to_q32(inverse_w: f64) -> u32 {
    (inverse_w * 2f64.powi(32)) as u32
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
        let inverse_w = InverseW::from_bits(to_q32(inverse_w));
        let varyings = PerspectiveCorrect::<V, M>::new(value).on_screen(inverse_w);
        let [x, y] = places[i];
        ScreenVertex::<S, NoDepth, _>::checked(x, y, NoDepth, varyings).unwrap()
    });
    let triangle = Triangle::new(vertices.each_ref()).unwrap();
    let layout = Layout { pitch: 320, origin: 0 };
    let Ok(()) = triangle.for_each_span(&WINDOW, layout, |span| {
        let mut column = span.start as i32 - span.row * 320;
        let (at, pixels) = ([span.start as i32, span.row], span.end - span.start);
        let (first, rest) = M::OnScreen::<V>::walk(span.varyings, at, pixels);
        let pieces: Vec<_> = [first].into_iter().chain(rest).collect();
        let (mut visited, mut left) = (pieces.iter(), pixels);
        M::OnScreen::<V>::for_each_piece(span.varyings, at, pixels, |piece| {
            assert_eq!(format!("{piece:?}"), format!("{:?}", visited.next().unwrap()));
            left -= piece.pixels;
            left
        });
        assert_eq!((visited.len(), left), (0, 0), "both ways along a span have the same pieces");
        for piece in pieces {
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
    let values = corners.map(|corner| corner.value.map(repeats));
    let q = corners.map(|corner| f64::from(to_q32(corner.inverse_w)));
    let definition = Definition::new(places, q, values);
    // It does not leave the range of the corners, so that an atlas does not bleed.
    let ranges = [0, 1].map(|n| {
        let corners = values.map(|corner| corner[n]);
        [corners.into_iter().fold(f64::MAX, f64::min), corners.into_iter().fold(f64::MIN, f64::max)]
    });
    let mut worst = Worst::default();
    for (column, row, place) in seen {
        let exact = definition.at(column, row);
        let got = place_in_repeats(place);
        for (n, size) in [W, H].into_iter().enumerate() {
            let mut off = got[n] - exact.value[n];
            let is_periodic = X::IS_PERIODIC && Y::IS_PERIODIC;
            if is_periodic {
                off -= off.round();
            }
            let texels = (off * size as f64).abs();
            // 1/256 of a pixel.
            let allowed = bound.max(exact.slope[n] * size as f64 / 256.0);
            worst.texels = worst.texels.max(texels);
            worst.share = worst.share.max(texels / allowed);
            let [least, most] = ranges[n];
            let beyond = (least - got[n]).max(got[n] - most) * size as f64;
            assert!(is_periodic || beyond <= allowed, "{beyond} texels beyond the corners");
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
    const fn or(self, other: Self) -> Self {
        Self {
            texels: self.texels.max(other.texels),
            share: self.share.max(other.share),
            pixels: self.pixels + other.pixels,
        }
    }
}

/// A triangle whose coordinates span up to `repeats` and whose distances have the ratio `ratio`:
/// tiny, large, a sliver, or small.
fn random_triangle<T>(
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
        let at = if shape < 0.1 {
            [middle[0] + part() * 2.0, middle[1] + part() * 2.0]
        } else if shape < 0.5 {
            [part() * 900.0 - 290.0, part() * 700.0 - 230.0]
        } else if shape < 0.75 {
            let along = part() * 600.0 - 300.0;
            [middle[0] + along, middle[1] + along * 0.37 + part() * 3.0]
        } else {
            [middle[0] + part() * 60.0 - 30.0, middle[1] + part() * 60.0 - 30.0]
        };
        let value = [(part() - 0.5) * repeats, (part() - 0.5) * repeats].map(coordinate);
        // In a parallel projection near / w is 1 everywhere.
        let inverse_w = if ratio == 1.0 { 1.0 } else { nearest * lengths[(i + turn) % 3] };
        Corner { at, inverse_w, value }
    })
}

/// The halves of a wall that recedes to the right, or of a floor that recedes upwards to the
/// horizon: 200 or 300 pixels wide where it is near.
fn receding<T: Copy>(
    is_floor: bool,
    ratio: f64,
    repeats: f64,
    coordinate: fn(f64) -> T,
) -> [[Corner<[T; 2]>; 3]; 2] {
    let corner = |is_far: bool, side: f64| {
        let along = f64::from(u8::from(is_far));
        let half = if is_far { 100.0 / ratio } else { 100.0 };
        let at = if is_floor {
            [160.3 + side * half * 1.5, 230.7 - along * 200.0]
        } else {
            [10.2 + along * 300.0, 120.4 + side * half]
        };
        let value = [along - 0.5, side / 2.0].map(|part| coordinate(part * repeats));
        Corner { at, inverse_w: if is_far { 0.999 / ratio } else { 0.999 }, value }
    };
    let [a, b] = [-1.0, 1.0].map(|side| corner(false, side));
    let [c, d] = [-1.0, 1.0].map(|side| corner(true, side));
    [[a, b, c], [b, d, c]]
}

fn narrow(repeats: f64) -> i16 {
    (repeats * 2f64.powi(14)) as i16
}

fn wide(repeats: f64) -> i32 {
    (repeats * 2f64.powi(24)) as i32
}

/// The worst of random triangles, walls and floors of all ratios.
fn worst_of_all<S, T, const W: usize, const H: usize, X, Y, M>(
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
    for ratio in [1.0, 2.0, 10.0, 100.0, 1000.0] {
        let mut random = Random::new(ratio as u64);
        let mut triangles = vec![];
        for _ in 0..150 {
            triangles.push(random_triangle(&mut random, repeats, ratio, coordinate));
        }
        triangles.extend(receding(false, ratio, repeats, coordinate));
        triangles.extend(receding(true, ratio, repeats, coordinate));
        for corners in triangles {
            all = all.or(worst::<S, T, W, H, X, Y, M>(corners, bound));
        }
    }
    assert!(all.pixels > 100_000, "{all:?}");
    all
}

/// The worst of textures of several sizes, formats and borders.
fn worst_of_textures<S: Subpixel, M: Correction>(bound: f64) -> [(&'static str, Worst); 5] {
    [
        ("128 x 128", worst_of_all::<S, i16, 128, 128, Repeat, Repeat, M>(1.0, narrow, bound)),
        (
            "256 x 32, 3 repeats",
            worst_of_all::<S, i16, 256, 32, Repeat, Repeat, M>(3.0, narrow, bound),
        ),
        (
            "1,024 x 1,024",
            worst_of_all::<S, i16, 1024, 1024, Repeat, Mirror, M>(1.0, narrow, bound),
        ),
        (
            "100 x 1,000, clamped",
            worst_of_all::<S, i16, 100, 1000, Clamp, Clamp, M>(1.0, narrow, bound),
        ),
        (
            "1,024 x 1,024, 64 repeats",
            worst_of_all::<S, i32, 1024, 1024, Repeat, Repeat, M>(64.0, wide, bound),
        ),
    ]
}

/// Returns the largest part of its bound that an error has.
fn are_within<S: Subpixel, M: Correction>(bound: f64) -> f64 {
    let all = worst_of_textures::<S, M>(bound);
    for (name, worst) in all {
        assert!(worst.share < 1.0, "S{}, {name}: {worst:?}", S::BITS);
    }
    all.iter().map(|(_, worst)| worst.share).fold(0.0, f64::max)
}

#[test]
fn every_pixel_is_exact() {
    are_within::<S4, EveryPixel>(1.0 / 16.0);
    are_within::<S8, EveryPixel>(1.0 / 16.0);
}

/// They are as long as it allows, too: a step's chord is off by |du| |√r - 1| / (√r + 1), of which
/// some have more than half of the tolerance.
#[test]
fn adaptive_steps_are_within_their_tolerance() {
    let shares = [
        are_within::<S4, Adaptive<2>>(2.0 / 16.0),
        are_within::<S8, Adaptive<8>>(8.0 / 16.0),
        are_within::<S4, Adaptive<8>>(8.0 / 16.0),
        are_within::<S4, Adaptive<64>>(64.0 / 16.0),
    ];
    assert!(shares.iter().all(|&share| share > 0.5), "{shares:?}");
}

/// Where near / w is 1 at all corners, straight lines are right in every mode.
#[test]
fn parallel_projections_are_exact() {
    fn is_exact<M: Correction>() {
        let mut random = Random::new(9);
        for _ in 0..60 {
            let corners = random_triangle(&mut random, 1.0, 1.0, narrow);
            let worst = worst::<S8, i16, 128, 128, Repeat, Repeat, M>(corners, 1.0 / 16.0);
            assert!(worst.share < 1.0, "{worst:?}");
        }
    }
    is_exact::<Affine>();
    is_exact::<EveryPixel>();
    is_exact::<Every<2>>();
    is_exact::<Every<64>>();
    is_exact::<Adaptive>();
}

/// Steps of a fixed length: by the law for a wall that recedes from w = 1 to 2 over 300 pixels,
/// with 64 texels in all, the chord over 16 pixels is off by up to 0.1 texel, over 64 by 1.2.
#[test]
fn steps_of_a_fixed_length_follow_the_law() {
    fn off<M: Correction>() -> f64 {
        receding(false, 2.0, 1.0, narrow)
            .map(|corners| worst::<S8, i16, 64, 64, Repeat, Repeat, M>(corners, 1.0).texels)
            .into_iter()
            .fold(0.0, f64::max)
    }
    // r = q1 / q0 over n pixels at the far end, where du is the largest.
    let law = |n: f64| {
        let (q1, q0) = (0.5, 0.5 + 0.5 * n / 300.0);
        let s = |q: f64| (1.0 / q - 1.0) * 64.0;
        let root = (q0 / q1).sqrt();
        (s(q1) - s(q0)) * (root - 1.0) / (root + 1.0)
    };
    for (n, off) in
        [(8.0, off::<Every<8>>()), (16.0, off::<Every<16>>()), (64.0, off::<Every<64>>())]
    {
        // Fractions of 16 bits stepped n times add (n / 2 + 1) 2^-16 of 64 texels.
        let rounding = (n / 2.0 + 1.0) / 1024.0;
        assert!(off <= law(n) + rounding && off > law(n) / 2.0, "{n}: {off} {}", law(n));
    }
    // Straight over the whole wall: |du| (√2 - 1) / (√2 + 1) = 11 of 64 texels.
    let affine = off::<Affine>();
    assert!((10.0..11.1).contains(&affine), "{affine}");
}

/// Levels of light and other numbers of 16 bits: within half a unit of rounding and the bound of a
/// division, U (r 2^-27 + 2^-26) = 1/32 unit for r = 100; in steps within their tolerance.
#[test]
fn numbers_of_16_bits_are_exact() {
    fn worst<V, M>(value: fn(f64) -> V, number: fn(V) -> f64, sample: fn(V::Sample) -> f64) -> f64
    where
        V: Components + Varyings<OnScreen = V>,
        M: Correction,
    {
        let mut random = Random::new(5);
        let mut worst = 0.0f64;
        for ratio in [1.0, 3.0, 100.0] {
            for _ in 0..60 {
                let corners = random_triangle(&mut random, 1.0, ratio, |part| part);
                let numbers = corners.map(|corner| Corner {
                    at: corner.at,
                    inverse_w: corner.inverse_w,
                    value: value(corner.value[0] + 0.5),
                });
                let mut seen = vec![];
                let places = pixels::<S8, V, M>(numbers, |column, row, corrected| {
                    seen.push((column, row, sample(corrected.value)));
                });
                let q = corners.map(|corner| f64::from(to_q32(corner.inverse_w)));
                let values = numbers.map(|corner| [number(corner.value)]);
                let definition = Definition::new(places, q, values);
                for (column, row, got) in seen {
                    let exact = definition.at(column, row);
                    // 1/256 of a pixel.
                    let off = (got - 0.5 - exact.value[0]).abs() - exact.slope[0] / 256.0;
                    worst = worst.max(off);
                }
            }
        }
        worst
    }
    type Unsigned = [u16; 1];
    let value: fn(f64) -> Unsigned = |part| [(part * 65_535.0) as u16];
    let number: fn(Unsigned) -> f64 = |[value]| f64::from(value);
    let sample: fn([U16F16; 1]) -> f64 = |[value]| value.to_num();
    let off = worst::<Unsigned, EveryPixel>(value, number, sample);
    assert!(off < 1.0 / 16.0, "{off}");
    // 256 units, a level of 256.
    let off = worst::<Unsigned, Adaptive<4096>>(value, number, sample);
    assert!(off < 256.0 && off > 64.0, "{off}");

    let value: fn(f64) -> i16 = |part| ((part - 0.5) * 65_535.0) as i16;
    let number: fn(i16) -> f64 = f64::from;
    let sample: fn(I16F16) -> f64 = |value| value.to_num();
    let off = worst::<i16, EveryPixel>(value, number, sample);
    assert!(off < 1.0 / 16.0, "{off}");
}
