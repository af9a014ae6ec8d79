//! Large models take time in proportion to their size.

use std::{
    fmt::Write as _,
    fs,
    path::Path,
    time::{Duration, Instant},
};

use super::super::{Contents, Model, Options, emit};

/// A file of about as many corners as its argument.
type Maker = fn(usize) -> String;

fn circle(n: usize, mut radius: impl FnMut(usize) -> f64) -> String {
    (0..n).fold(String::new(), |mut text, i| {
        let (sin, cos) = (i as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
        let r = radius(i);
        let _ = writeln!(text, "v {:.9} {:.9} 0", r * cos, r * sin);
        text
    })
}

fn face(corners: impl Iterator<Item = usize>) -> String {
    corners.fold("f".to_owned(), |mut text, i| {
        let _ = write!(text, " {i}");
        text
    })
}

/// One polygon, convex up to its decimals.
fn disc(n: usize) -> String {
    circle(n, |_| 1.0) + &face(1..=n)
}

/// One polygon whose every other corner is concave.
fn star(n: usize) -> String {
    circle(n, |i| 1.0 - 0.3 * (i % 2) as f64) + &face(1..=n)
}

/// One polygon of long teeth.
fn comb(n: usize) -> String {
    let teeth = (0..n).fold(String::new(), |mut text, i| {
        let _ = writeln!(text, "v {} {} {}", i, [0.1, 1000.0][i % 2], 0.3 * i as f64);
        text
    });
    format!("{teeth}v {} -1 {}\nv 0 -1 0\n{}", n, 0.3 * n as f64, face((1..=n + 2).rev()))
}

/// One polygon along a slanted rectangle with all but four corners on its sides.
fn subdivided_rectangle(n: usize) -> String {
    let outline = [[0.1, 0.2, 0.3], [0.7, 0.5, 0.4], [0.8, 1.1, 0.7], [0.2, 0.8, 0.6]];
    let corners = (0..n).fold(String::new(), |mut text, i| {
        let (side, step) = (4 * i / n, (4 * i % n) as f64 / n as f64);
        let (from, to): ([f64; 3], [f64; 3]) = (outline[side], outline[(side + 1) % 4]);
        let [x, y, z] = [0, 1, 2].map(|axis| from[axis] * (1.0 - step) + to[axis] * step);
        let _ = writeln!(text, "v {x} {y} {z}");
        text
    });
    corners + &face(1..=n)
}

/// One polygon that names the same four positions again and again, one of them concave.
fn repeated(n: usize) -> String {
    "v 0 0 0\nv 3 0 0\nv 1 1 0\nv 0 3 0\n".to_owned() + &face((0..n).map(|i| i % 4 + 1))
}

/// All triangles share the tip.
fn cone(n: usize) -> String {
    (0..n).fold(circle(n, |_| 1.0) + "v 0 0 1\n", |mut text, i| {
        let _ = writeln!(text, "f {} {} {}", i + 1, (i + 1) % n + 1, n + 1);
        text
    })
}

/// Squares side by side, each in a material of its number.
fn materials(n: usize) -> String {
    let strip = (0..=n / 4).fold("mtllib m.mtl\n".to_owned(), |mut text, i| {
        let _ = writeln!(text, "v {i} 0 0\nv {i} 1 0");
        text
    });
    (0..n / 4).fold(strip, |mut text, i| {
        let [a, b, c, d] = [1, 3, 4, 2].map(|corner| 2 * i + corner);
        let _ = writeln!(text, "usemtl m{i}\nf {a} {b} {c} {d}");
        text
    })
}

/// The time that this thread has had on a core. Elsewhere than on Linux, the time that has gone by.
fn clock(start: Instant) -> Duration {
    let on_core = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = on_core.and_then(|text| text.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| start.elapsed(), Duration::from_nanos)
}

/// The time that it takes to convert a file `times` times.
fn duration(directory: &Path, text: &str, options: &Options, times: u32) -> Duration {
    let path = directory.join("m.obj");
    fs::write(&path, text).unwrap();
    let start = Instant::now();
    let before = clock(start);
    for _ in 0..times {
        let model = Model::load(&path, options).unwrap();
        assert!(emit::source(&model).len() > 100);
    }
    clock(start) - before
}

/// A file of 16 n corners takes as long as 16 files of n corners if time is linear, and 16 times as
/// long if it is quadratic. Sorting takes less than 1.6 times as long; ears as long as the polygon
/// meet four times as many cells of a grid each. A program that runs beside this one takes its
/// share of the caches, which the larger model misses more: each limit lies about twice above what
/// is expected. Both sides take long enough for clocks that tick every few milliseconds. Seconds
/// would depend on the host and on how the tests are optimised.
#[test]
fn time_grows_with_the_size_and_not_with_its_square() {
    let makers: [(&str, Maker, f64); 8] = [
        ("disc", disc, 4.0),
        ("star", star, 4.0),
        ("comb", comb, 9.0),
        ("subdivided rectangle", subdivided_rectangle, 9.0),
        ("repeated", repeated, 4.0),
        ("cone", cone, 4.0),
        ("cone of face normals", cone, 4.0),
        ("materials", materials, 4.0),
    ];
    let directory = tempfile::tempdir().unwrap();
    let n = 625;
    let mtl = (0..n).fold(String::new(), |text, i| text + &format!("newmtl m{i}\nKd 1 0 0\n"));
    fs::write(directory.path().join("m.mtl"), mtl).unwrap();
    for (name, make, most) in makers {
        let contents =
            Contents { vertex_normals: name != "cone of face normals", ..Contents::default() };
        let options = Options { contents, ..Options::default() };
        // Other programs lengthen a run by their use of caches: the shortest ones count, of as
        // many as it takes.
        let texts = [(make(n), 16), (make(16 * n), 1)];
        let mut least = [Duration::MAX; 2];
        let mut ratio = f64::INFINITY;
        for _ in 0..30 {
            for (least, (text, times)) in least.iter_mut().zip(&texts) {
                *least = duration(directory.path(), text, &options, *times).min(*least);
            }
            ratio = least[1].as_secs_f64() / least[0].as_secs_f64();
            if ratio < most {
                break;
            }
        }
        let [many, one] = least;
        println!("{name}: {many:.1?} for 16 of {n}, {one:.1?} for one of all: {ratio:.1}");
        assert!(ratio < most, "{name}: {many:?} for 16 of {n} corners, {one:?} for one of all");
    }
}
