//! Coverage of triangles by hand, of shared edges, and of what has no area.

use super::super::random::Random;
use super::*;

type Triangle = [[f64; 2]; 3];

const SIZE: usize = 64;

/// The four axes, the four diagonals, and a direction within each octant.
fn directions() -> impl Iterator<Item = [f64; 2]> {
    let first_quarter = [[1.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 2.0]];
    first_quarter.into_iter().flat_map(|[x, y]| [[x, y], [-y, x], [-x, -y], [y, -x]])
}

fn region() -> Region {
    Region::whole((SIZE, SIZE))
}

/// The covered pixels (column, row), row by row.
fn covered(triangle: Triangle) -> Vec<(usize, usize)> {
    let mut pixels = Vec::new();
    for_each_covered(triangle, &region(), &mut |[x, y], _, _| pixels.push((x, y)));
    pixels
}

/// How often each pixel is covered, indexed by `row * SIZE + column`.
fn counts(triangles: &[Triangle]) -> Vec<usize> {
    let mut counts = vec![0; SIZE * SIZE];
    for &triangle in triangles {
        for_each_covered(triangle, &region(), &mut |[x, y], _, _| counts[y * SIZE + x] += 1);
    }
    counts
}

fn center(pixel: usize) -> [f64; 2] {
    [(pixel % SIZE) as f64 + 0.5, (pixel / SIZE) as f64 + 0.5]
}

/// A parallelogram from `corner` along `u` and `v`, cut along either diagonal.
fn parallelogram(
    corner: [f64; 2],
    u: [f64; 2],
    v: [f64; 2],
    other_diagonal: bool,
) -> [Triangle; 2] {
    let at = |s: f64, t: f64| [corner[0] + s * u[0] + t * v[0], corner[1] + s * u[1] + t * v[1]];
    let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    if other_diagonal { [[a, b, d], [d, b, c]] } else { [[a, b, c], [c, d, a]] }
}

/// The top-left rule as a perturbation: a centre on an edge belongs to the triangle that lies
/// to its right, or, along a horizontal edge, below it. So the centre, moved to the right
/// by ε and down by ε², must lie strictly inside as ε goes to 0: the side of an edge it is
/// on is the sign of the cross product, else of its derivative to the right, else of the
/// one downward. In whole numbers, in units of 1/512 pixel.
fn covers_exactly(triangle: Triangle, x: usize, y: usize) -> bool {
    let scale = |value: f64| (value * 512.0) as i64;
    let [a, b, c] = triangle.map(|corner| corner.map(scale));
    let p = [scale(x as f64 + 0.5), scale(y as f64 + 0.5)];
    let side = |a: [i64; 2], b: [i64; 2]| {
        let cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        [cross, a[1] - b[1], b[0] - a[0]].into_iter().find(|&term| term != 0).map_or(0, i64::signum)
    };
    let sides = [side(a, b), side(b, c), side(c, a)];
    sides == [1; 3] || sides == [-1; 3]
}

#[test]
fn an_axis_aligned_rectangle_owns_its_left_and_top_side() {
    for other_diagonal in [false, true] {
        let triangles = parallelogram([3.5, 5.5], [7.0, 0.0], [0.0, 4.0], other_diagonal);
        for (pixel, count) in counts(&triangles).into_iter().enumerate() {
            let inside = (3..10).contains(&(pixel % SIZE)) && (5..9).contains(&(pixel / SIZE));
            assert_eq!(count, usize::from(inside), "{:?}", center(pixel));
        }
    }
}

#[test]
fn a_rectangle_between_centers_covers_as_many_centers_as_its_area() {
    // With its corners on centres and each pair of opposite sides half open, copies of the
    // rectangle tile the plane and each takes its share of the lattice of centres:
    // exactly its area, in every direction.
    for [x, y] in directions() {
        for (length, width) in [(1.0, 1.0), (4.0, 3.0), (2.0, 7.0)] {
            let (u, v) = ([length * x, length * y], [-width * y, width * x]);
            for other_diagonal in [false, true] {
                let triangles = parallelogram([31.5, 31.5], u, v, other_diagonal);
                let counts = counts(&triangles);
                let area = length * width * (x * x + y * y);
                assert_eq!(counts.iter().sum::<usize>() as f64, area, "direction ({x}, {y})");
                assert!(counts.iter().all(|&count| count <= 1));
            }
        }
    }
}

#[test]
fn a_center_on_a_side_belongs_to_the_rectangle_if_the_outside_is_to_the_left_or_above() {
    for [x, y] in directions() {
        let (u, v) = ([4.0 * x, 4.0 * y], [-4.0 * y, 4.0 * x]);
        // The middle of each side, from the middle of the rectangle, points outward.
        let middle = [31.5 + (u[0] + v[0]) / 2.0, 31.5 + (u[1] + v[1]) / 2.0];
        for [outward_x, outward_y] in [u, v, u.map(|c| -c), v.map(|c| -c)] {
            let on_side = [middle[0] + outward_x / 2.0, middle[1] + outward_y / 2.0];
            let is_owned = outward_x < 0.0 || (outward_x == 0.0 && outward_y < 0.0);
            for other_diagonal in [false, true] {
                let counts = counts(&parallelogram([31.5, 31.5], u, v, other_diagonal));
                let pixel = on_side[1] as usize * SIZE + on_side[0] as usize;
                assert_eq!(center(pixel), on_side);
                assert_eq!(counts[pixel], usize::from(is_owned), "({outward_x}, {outward_y})");
            }
        }
    }
}

#[test]
fn snapped_triangles_agree_with_whole_numbers_everywhere() {
    let mut random = Random(2);
    // Steps of half a pixel put very many edges on centres; the last case is the documented
    // limit.
    for (low, high, step) in
        [(-20.0, 40.0, 0.5), (-20.0, 40.0, 1.0 / 256.0), (-4032.0, 4095.0, 1.0 / 256.0)]
    {
        for number in 0..600 {
            let mut triangle = [(); 3].map(|()| [(); 2].map(|()| random.snapped(low, high, step)));
            if number % 2 == 0 {
                // An edge right through a centre, however long it is.
                triangle[1] = triangle[0].map(|coordinate| 63.0 - coordinate);
            }
            let mut pixels = covered(triangle).into_iter().peekable();
            for y in 0..SIZE {
                for x in 0..SIZE {
                    let covers = pixels.next_if_eq(&(x, y)).is_some();
                    assert_eq!(
                        covers,
                        covers_exactly(triangle, x, y),
                        "({x}, {y}) in {triangle:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_fan_round_a_center_covers_every_center_once() {
    for count in 3..=64 {
        for turn in [0.0, 0.1, 0.37] {
            let hub = [31.5, 31.5];
            let rim = |i: usize| {
                let angle = (i % count) as f64 / count as f64 * std::f64::consts::TAU + turn;
                [angle.cos(), angle.sin()].map(|c| 31.5 + (c * 25.0 * 16.0).round() / 16.0)
            };
            let fan: Vec<Triangle> = (0..count).map(|i| [hub, rim(i), rim(i + 1)]).collect();
            let counts = counts(&fan);
            assert_eq!(counts[31 * SIZE + 31], 1, "the hub of {count} triangles");
            assert!(counts.iter().all(|&times| times <= 1), "{count} triangles");
            // The inscribed circle of the rim has the radius 25 cos(π / count), less the
            // snapping.
            let inner = 25.0 * (std::f64::consts::PI / count as f64).cos() - 0.1;
            for (pixel, &times) in counts.iter().enumerate() {
                let [x, y] = center(pixel);
                let is_hole = times == 0 && (x - hub[0]).hypot(y - hub[1]) <= inner;
                assert!(!is_hole, "({x}, {y}) of {count} triangles");
            }
        }
    }
}

#[test]
fn triangles_on_both_sides_of_an_edge_share_no_center_and_leave_no_gap() {
    let mut random = Random(3);
    for (reach, step) in [(64.0, 0.5), (64.0, 0.0), (1e6, 0.0), (1e9, 0.0)] {
        let mut crossings = 0;
        for _ in 0..300 {
            let mut point = |low: f64, high: f64| [(); 2].map(|()| random.snapped(low, high, step));
            // A parallelogram whose diagonal from a to b runs through a centre, as nearly as
            // the corners can be rounded; its other corners are c and d.
            let (pixel, a, c) = (point(0.0, 63.0), point(-reach, reach), point(-reach, reach));
            let b = [0, 1].map(|i| 3.0 * (pixel[i].floor() + 0.5) - 2.0 * a[i]);
            let d = [0, 1].map(|i| a[i] + b[i] - c[i]);
            let halves = [[a, b, c], [b, a, d]];
            let whole = counts(&halves);
            assert!(whole.iter().all(|&times| times <= 1), "overlap along {a:?} {b:?}");
            // Cut along the other diagonal, there is no edge at the place of the gap.
            let other_cut = counts(&[[c, a, d], [d, b, c]]);
            assert_eq!(whole, other_cut, "gap along {a:?} {b:?} or {c:?} {d:?}");
            crossings += usize::from(halves.iter().all(|&half| !covered(half).is_empty()));
        }
        assert!(crossings > 200, "{crossings} of 300 pairs meet in the picture");
    }
}

#[test]
fn a_jittered_grid_covers_every_center_once() {
    const CELLS: usize = 16;
    let mut random = Random(4);
    for step in [0.5, 1.0 / 16.0, 1.0 / 256.0, 0.0] {
        // Corners at multiples of 5 pixels from -8, moved by up to 1: less than 5/4, so no cell
        // folds over. They reach to 72, so that the outer ones, moved or not, lie
        // outside the picture.
        let mut jitter = || random.snapped(-1.0, 1.0, step);
        let corners: Vec<[f64; 2]> = (0..(CELLS + 1) * (CELLS + 1))
            .map(|i| {
                [
                    (i % (CELLS + 1)) as f64 * 5.0 - 8.0 + jitter(),
                    (i / (CELLS + 1)) as f64 * 5.0 - 8.0 + jitter(),
                ]
            })
            .collect();
        let mut triangles = Vec::new();
        for i in (0..CELLS * (CELLS + 1)).filter(|i| i % (CELLS + 1) < CELLS) {
            let [a, b, c, d] =
                [i, i + 1, i + CELLS + 2, i + CELLS + 1].map(|corner| corners[corner]);
            triangles.extend([[a, b, c], [a, d, c]]);
        }
        let counts = counts(&triangles);
        let wrong: Vec<_> =
            (0..SIZE * SIZE).filter(|&pixel| counts[pixel] != 1).map(center).collect();
        assert!(wrong.is_empty(), "step {step}: {wrong:?}");
    }
}

#[test]
fn neither_winding_nor_the_first_corner_matters() {
    let mut random = Random(5);
    for _ in 0..500 {
        let [a, b, c] = [(); 3].map(|()| [(); 2].map(|()| random.snapped(-10.0, 74.0, 0.5)));
        let pixels = covered([a, b, c]);
        for order in [[b, c, a], [c, a, b], [a, c, b], [c, b, a], [b, a, c]] {
            assert_eq!(covered(order), pixels);
        }
    }
}

#[test]
fn moving_by_whole_pixels_moves_the_pixels() {
    let mut random = Random(6);
    for _ in 0..500 {
        let triangle = [(); 3].map(|()| [(); 2].map(|()| random.snapped(10.0, 30.0, 1.0 / 16.0)));
        let pixels = covered(triangle);
        for (right, down) in [(1, 0), (0, 1), (17, 29), (34, 34)] {
            let moved = covered(triangle.map(|[x, y]| [x + right as f64, y + down as f64]));
            let expected: Vec<_> = pixels.iter().map(|(x, y)| (x + right, y + down)).collect();
            assert_eq!(moved, expected);
        }
    }
}

#[test]
fn the_picture_border_cuts_and_loses_nothing() {
    let triangle = [[3.25, 1.5], [40.5, 20.75], [11.0, 44.5]];
    let all = covered(triangle);
    for (columns, rows) in [(5..30, 4..40), (0..SIZE, 30..31), (20..21, 0..SIZE), (0..0, 0..SIZE)] {
        let region = Region { columns, rows };
        let mut inside = Vec::new();
        for_each_covered(triangle, &region, &mut |[x, y], _, span| {
            inside.push((x, y));
            let row =
                all.iter().filter(|(column, row)| *row == y && region.columns.contains(column));
            let row: Vec<_> = row.map(|(column, _)| *column).collect();
            assert_eq!(row, span.clone().collect::<Vec<_>>());
        });
        let mut expected = all.clone();
        expected.retain(|(x, y)| region.columns.contains(x) && region.rows.contains(y));
        assert_eq!(inside, expected);
    }
    let one = Region { columns: 0..1, rows: 0..1 };
    let mut count = 0;
    for_each_covered([[0.5, 0.5], [0.625, 0.5], [0.5, 0.625]], &one, &mut |_, _, _| count += 1);
    assert_eq!(count, 1, "a triangle of 1/128 square pixel with its top left corner on the centre");
}

#[test]
fn triangles_without_area_or_with_wild_coordinates_draw_nothing() {
    let (a, b, c) = ([3.5, 3.5], [9.5, 15.5], [6.5, 9.5]);
    for triangle in
        [[a, b, c], [b, c, a], [c, a, b], [c, b, a], [a, a, b], [a, b, a], [b, a, a], [a, a, a]]
    {
        assert_eq!(covered(triangle), []);
    }
    for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
        for triangle in [[[wild, 0.0], b, a], [a, [9.0, wild], [20.0, 3.0]], [a, b, [wild, wild]]] {
            let mut total = 0.0;
            for_each_covered(triangle, &region(), &mut |_, weights, _| {
                total += weights.iter().sum::<f64>();
            });
            assert!(total.is_finite());
        }
    }
    assert_eq!(covered([[f64::NAN, 0.0], [60.0, 0.0], [0.0, 60.0]]), []);
    assert_eq!(covered([[0.0, 0.0], [f64::INFINITY, 0.0], [0.0, 60.0]]), []);
}

#[test]
fn huge_triangles_fill_the_picture_at_the_price_of_the_picture() {
    for reach in [1e4, 1e6, 1e9, 1e12] {
        assert_eq!(
            covered([[-reach, -reach], [3.0 * reach, -reach], [-reach, 3.0 * reach]]).len(),
            SIZE * SIZE
        );
        assert_eq!(
            covered([[-reach, -reach], [reach, -reach], [0.0, -1.0]]),
            [],
            "all of it above the picture"
        );
        // The half-plane below the diagonal y = x, whose line meets every centre of the
        // diagonal: a left edge has its triangle to the right, this one has it to
        // the left and below.
        let below = covered([[-reach, -reach], [reach, reach], [-reach, reach]]);
        assert_eq!(below.len(), SIZE * (SIZE - 1) / 2);
    }
}

#[test]
fn slivers_cover_the_centers_on_their_left_or_top_side_only() {
    let thin = 1.0 / 256.0;
    let width = SIZE as f64;
    // (corner, side, thickness): a sliver with its owned side on a row, a column, a diagonal of
    // centres, then the sliver on the other side of the same centres.
    let cases = [
        ([0.0, 10.5], [width, 0.0], [0.0, thin], SIZE),
        ([0.0, 10.5], [width, 0.0], [0.0, -thin], 0),
        ([10.5, 0.0], [0.0, width], [thin, 0.0], SIZE),
        ([10.5, 0.0], [0.0, width], [-thin, 0.0], 0),
        ([0.0, 0.0], [width, width], [thin, 0.0], SIZE),
        ([0.0, 0.0], [width, width], [-thin, 0.0], 0),
    ];
    for (corner, side, thickness, expected) in cases {
        for other_diagonal in [false, true] {
            let counts = counts(&parallelogram(corner, side, thickness, other_diagonal));
            assert_eq!(counts.iter().sum::<usize>(), expected, "{side:?} {thickness:?}");
            assert!(counts.iter().all(|&times| times <= 1));
        }
    }
    // 256 slivers side by side close one row: its centres lie on the shared edge in the middle.
    let slivers: Vec<Triangle> = (0..256)
        .flat_map(|i| {
            parallelogram([0.0, 10.0 + f64::from(i) * thin], [width, 0.0], [0.0, thin], i % 2 == 0)
        })
        .collect();
    for (pixel, count) in counts(&slivers).into_iter().enumerate() {
        assert_eq!(count, usize::from(pixel / SIZE == 10));
    }
}

#[test]
fn the_weights_are_barycentric_coordinates() {
    let triangle = [[2.25, 3.5], [60.5, 17.75], [21.0, 59.5]];
    let mut visited = 0;
    for [a, b, c] in [triangle, [triangle[2], triangle[1], triangle[0]]] {
        for_each_covered([a, b, c], &region(), &mut |[column, row], [u, v, w], _| {
            visited += 1;
            // Rounding of a dozen operations on numbers below 64.
            assert!((u + v + w - 1.0).abs() < 1e-14);
            assert!((u * a[0] + v * b[0] + w * c[0] - (column as f64 + 0.5)).abs() < 1e-13);
            assert!((u * a[1] + v * b[1] + w * c[1] - (row as f64 + 0.5)).abs() < 1e-13);
        });
    }
    assert!(visited > 2_000);
}

#[test]
fn clockwise_on_the_screen_is_positive() {
    assert_eq!(doubled_area([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]), 12.0);
    assert_eq!(doubled_area([[0.0, 0.0], [0.0, 3.0], [4.0, 0.0]]), -12.0);
}
