//! Polygons into triangles: every side and every corner stays, on straight lines too.

use std::collections::{HashMap, HashSet};

use super::super::{
    polygons::{Corner, Face, NO_COLOR, Polygons},
    smoothing::Smoothing,
    triangulate::{Triangle, triangulate},
    vector::{Vector, add, cross, dot, length, normalized, scaled, sub},
};
use crate::reference::random::Random;

/// One polygon of these corners. Equal positions have one index, as in a file that is read.
fn polygon(ring: &[Vector]) -> Polygons {
    let mut polygons = Polygons::default();
    for &point in ring {
        let known = polygons.positions.iter().position(|&p| p == point);
        let position = known.unwrap_or_else(|| {
            polygons.positions.push(point);
            polygons.positions.len() - 1
        }) as u32;
        polygons.corners.push(Corner {
            position,
            normal: [0.0; 3],
            texture: [0.0; 2],
            color: NO_COLOR,
        });
    }
    polygons.faces.push(Face { arity: ring.len(), material: 0, smoothing: Smoothing::Unstated });
    polygons.colors.push([0; 3]);
    polygons
}

/// Directed sides, those that run both ways left out: what remains is the border.
fn border(sides: impl Iterator<Item = (u32, u32)>) -> HashMap<(u32, u32), i32> {
    let mut count = HashMap::new();
    for (from, to) in sides {
        let (key, step) = if from < to { ((from, to), 1) } else { ((to, from), -1) };
        *count.entry(key).or_insert(0) += step;
    }
    count.retain(|&(from, to), &mut times| times != 0 && from != to);
    count
}

fn positions(triangle: &Triangle) -> [u32; 3] {
    triangle.corners.map(|corner| corner.position)
}

/// Twice the area, as a vector along the normal.
fn area(ring: &[Vector]) -> Vector {
    let from_first = |i: usize| sub(ring[i], ring[0]);
    (1..ring.len() - 1).fold([0.0; 3], |sum, i| add(sum, cross(from_first(i), from_first(i + 1))))
}

/// Cuts a polygon and checks that its border and all of its corners stay. `rounding` bounds the
/// distance of its corners from a plane, and how far a corner on a side lies beside it.
#[track_caller]
fn check(ring: &[Vector], rounding: f64) -> Vec<Triangle> {
    let polygons = polygon(ring);
    let (triangles, _) = triangulate(&polygons, &[&polygons.positions]);
    let names: Vec<u32> = polygons.corners.iter().map(|corner| corner.position).collect();
    let kept: HashSet<u32> = triangles.iter().flat_map(positions).collect();
    assert_eq!(kept, names.iter().copied().collect(), "corners of {ring:?}");

    let around = (0..names.len()).map(|i| (names[i], names[(i + 1) % names.len()]));
    let sides = triangles.iter().map(positions).flat_map(|[a, b, c]| [(a, b), (b, c), (c, a)]);
    assert_eq!(border(sides), border(around), "border of {ring:?}");

    let whole = area(ring);
    let up = normalized(whole).unwrap();
    let perimeter: f64 =
        (0..ring.len()).map(|i| length(sub(ring[(i + 1) % ring.len()], ring[i]))).sum();
    let mut sum = 0.0;
    for triangle in &triangles {
        let area = dot(area(&positions(triangle).map(|p| polygons.positions[p as usize])), up);
        assert!(area > -rounding * perimeter, "a triangle of {area} in {ring:?}");
        sum += area;
    }
    assert!((sum - length(whole)).abs() < rounding * perimeter, "{sum} of {ring:?}");
    triangles
}

/// A polygon round the origin with corners at random distances, concave ones included, then up to
/// three more on each side.
fn polygon_with_corners_on_sides(random: &mut Random, decimals: f64) -> Vec<Vector> {
    let mut number = |least: f64, most: f64| random.snapped(least, most, 1e-9);
    let axes = [0, 1].map(|_| [0, 1, 2].map(|_| number(-1.0, 1.0)));
    let corners = number(3.0, 9.0) as usize;
    let outline: Vec<Vector> = (0..corners)
        .map(|i| {
            let angle = (i as f64 + number(0.1, 0.9)) / corners as f64 * std::f64::consts::TAU;
            let distance = number(0.3, 0.9);
            add(scaled(axes[0], distance * angle.cos()), scaled(axes[1], distance * angle.sin()))
        })
        .collect();
    let round = |x: f64| (x / decimals).round() * decimals;
    let mut ring = Vec::new();
    for (i, &from) in outline.iter().enumerate() {
        let to = outline[(i + 1) % corners];
        ring.push(from.map(round));
        let more = number(0.0, 3.99) as usize;
        for k in 1..=more {
            let point = add(from, scaled(sub(to, from), k as f64 / (more + 1) as f64));
            ring.push(point.map(round));
        }
    }
    ring
}

#[test]
fn no_corner_is_lost_on_a_slanted_side() {
    let mut random = Random(11);
    let mut with_more = 0;
    for round in 0..3_000 {
        // The rounding of f64, then that of files with six and with four decimals.
        let decimals = [1e-17, 1e-6, 1e-4][round % 3];
        let ring = polygon_with_corners_on_sides(&mut random, decimals);
        with_more += usize::from(ring.len() > 9);
        // A projection along an axis that is not the normal lengthens an offset at most twofold.
        check(&ring, 4.0 * decimals.max(1e-15));
    }
    assert!(with_more > 1_000, "only {with_more} polygons have corners on sides");
}

#[test]
fn slivers_are_flipped_away_where_another_cut_has_none() {
    // A slanted parallelogram, and a triangle, with the middles of their sides in decimals.
    let parallelogram = [[0.1, 0.2, 0.3], [0.7, 0.5, 0.4], [0.8, 1.1, 0.7], [0.2, 0.8, 0.6]];
    let triangle = [[0.1, 0.7, 0.3], [0.9, 0.2, 0.5], [0.4, 0.4, 1.3]];
    for outline in [&parallelogram[..], &triangle] {
        for parts in 2..7 {
            let n = outline.len();
            let ring: Vec<Vector> = (0..n * parts)
                .map(|i| {
                    let (from, to) = (outline[i / parts], outline[(i / parts + 1) % n]);
                    let step = (i % parts) as f64 / parts as f64;
                    [0, 1, 2].map(|axis| from[axis] * (1.0 - step) + to[axis] * step)
                })
                .collect();
            for shift in 0..ring.len() {
                let mut ring = ring.clone();
                ring.rotate_left(shift);
                let triangles = check(&ring, 1e-15);
                assert_eq!(triangles.len(), ring.len() - 2);
                let least = triangles
                    .iter()
                    .map(|t| {
                        length(area(
                            &t.corners.map(|c| polygon(&ring).positions[c.position as usize]),
                        ))
                    })
                    .fold(f64::INFINITY, f64::min);
                assert!(least > 1e-4, "{parts} parts, start {shift}: a sliver of {least}");
            }
        }
    }
}

#[test]
fn neighbours_of_a_subdivided_side_keep_its_vertices() {
    // The left polygon names the middle of the side that they share, written in decimals.
    let text = "v 0.1 0.1 0\nv 0.4 0.7 0\nv 0.25 0.4 0\nv -0.5 0.5 0\nv 0.9 0.3 0\n\
                f 1 3 2 4\nf 3 1 5\nf 2 3 5\n";
    let model = super::load(text, &super::Options::default()).unwrap();
    let sides = super::indices(&model).into_iter().flat_map(|t| {
        let [a, b, c] = t.map(|vertex| model.positions[vertex]);
        [(a, b), (b, c), (c, a)]
    });
    let sides: HashSet<_> = sides.collect();
    let border = sides.iter().filter(|&&(from, to)| !sides.contains(&(to, from)));
    // Four sides round the patch; a T-junction adds the three along its crack.
    assert_eq!(border.count(), 4);
}

#[test]
fn repeated_corners_keep_holes_and_spikes() {
    let flat = |points: &[[f64; 2]]| -> Vec<Vector> {
        points.iter().map(|&[x, y]| [x, y, 0.25 * x - 0.5 * y]).collect()
    };
    // A square with a square hole, cut open along a line; the hole runs clockwise.
    let hole = [[0.4, 0.4], [0.4, 0.6], [0.6, 0.6], [0.6, 0.4], [0.4, 0.4]];
    let outside = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
    let keyhole = flat(&[&outside[..], &hole].concat());
    assert_eq!(check(&keyhole, 1e-15).len(), 8);
    // A spike into the inside, and one to the outside.
    for tip in [[0.5, 0.5], [0.5, -0.5]] {
        let spike = [[0.5, 0.0], tip, [0.5, 0.0]];
        check(&flat(&[&outside[..1], &spike, &outside[1..4]].concat()), 1e-15);
    }
    // Two squares that touch at a corner, and one that is named twice.
    let other = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0]];
    let eight = flat(&[&outside[..2], &other, &outside[3..4]].concat());
    assert_eq!(check(&eight, 1e-15).len(), 4);
    assert_eq!(check(&flat(&[&outside[..4], &outside[..4]].concat()), 1e-15).len(), 4);
}
