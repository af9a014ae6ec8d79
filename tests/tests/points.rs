//! Points against the reference: which pixels they own, their depth and varyings; those of an
//! object on its vertices, hidden by its triangles, and alike in bands.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::{PointsIter as _, Rectangle},
};
use host_tools::reference;
use rasterizer::{
    attribute::{Interpolate, NoDepth},
    geometry::ScreenVertex,
    mesh::{Mesh, PointIndices, Points, Tables, Triangles},
    numbers::{S4, S8, Subpixel},
    output::{Direct, Frame, Target as _},
    raster::{Bias, Point, Window},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Counter, Picture, Random, area,
    bands::{BACKGROUND, DISPLAY, Position, ROWS, at, ball, picture},
    front_vertices,
};

/// A window beyond which points reach on all sides.
const WINDOW: Rectangle = area(-5, -3, 40, 30);

const fn vertex<S: Subpixel, V: Interpolate>(
    [x, y]: [i32; 2],
    varyings: V,
) -> ScreenVertex<S, NoDepth, V> {
    ScreenVertex::checked(x, y, NoDepth, varyings).expect("the point lies on the screen")
}

fn definition<S: Subpixel>(place: [i32; 2], size: u8) -> reference::Point {
    reference::Point { place: place.map(i64::from), subpixel_bits: S::BITS, size: size.into() }
}

/// The pixels of a window, row by row.
fn pixels(window: Rectangle) -> impl Iterator<Item = [i64; 2]> {
    window.points().map(|point| [point.x, point.y].map(i64::from))
}

fn check<S: Subpixel>(place: [i32; 2], size: u8, window: Rectangle) {
    let point = definition::<S>(place, size);
    let owned: Vec<_> = pixels(window).map(|pixel| u32::from(point.owns(pixel))).collect();
    let mut counter = Counter::<Rgb888>::new(window);
    let vertex = vertex::<S, [u16; 0]>(place, []);
    let point = Point::new(&vertex).unwrap().sized(size);
    let mut direct = Direct::new(&mut counter);
    direct.fill(&point, &Window::new(&window), Rgb888::WHITE).unwrap();
    assert_eq!(counter.counts(), owned, "{place:?} of {size}");
}

/// Every place in a pixel: on its sides, its corners and its centre, and one sub-pixel beside them.
#[test]
fn points_own_the_pixels_of_the_definition_at_every_place() {
    for (x, y) in (-1..17).flat_map(|y| (-1..17).map(move |x| (x, y))) {
        for size in 0..6 {
            check::<S4>([x, y], size, area(-4, -4, 9, 9));
        }
    }
    for (x, y) in [0, 1, 127, 128, 129, 255].map(|y| [y, 255 - y]).map(|[x, y]| (x, y)) {
        for size in 0..6 {
            check::<S8>([x, y], size, area(-4, -4, 9, 9));
        }
    }
}

/// Among them points that reach over the window's sides or miss it, the largest ones, and those at
/// the ends of the range of coordinates.
#[test]
fn random_points_own_the_pixels_of_the_definition() {
    fn points<S: Subpixel>(seed: u64) {
        let mut random = Random::new(seed);
        for extent in [1, 20, 60, 300] {
            for _ in 0..300 {
                let reach = extent << S::BITS;
                let place = [0; 2].map(|_| random.within(-reach, reach));
                let size = random.pick(&[1, 2, 3, 7, 64, 255]);
                check::<S>(place, size, WINDOW);
            }
        }
        let (low, high) = (-1024 << S::BITS, (1024 << S::BITS) - 1);
        for (x, y) in [low, 0, high].into_iter().flat_map(|x| [(x, low), (x, high)]) {
            for corner in [-1030, 1015] {
                check::<S>([x, y], 9, area(corner, corner, 15, 15));
            }
        }
    }
    points::<S4>(1);
    points::<S8>(2);
}

/// All pixels have the depth and the varyings of the vertex, exactly.
#[test]
fn values_are_those_of_the_vertex() {
    fn points<S: Subpixel>(seed: u64) {
        let count = (WINDOW.size.width * WINDOW.size.height) as usize;
        let mut random = Random::new(seed);
        for _ in 0..300 {
            let place = [0; 2].map(|_| random.within(-20 << S::BITS, 40 << S::BITS));
            let [depth, value] = [0; 2].map(|_| random.within(1, 65_535) as u16);
            let wide = random.bits() as u32;
            let [x, y] = place;
            let vertex =
                ScreenVertex::<S, u16, _>::checked(x, y, depth, ([value], [wide])).unwrap();
            let point = Point::new(&vertex).unwrap().sized(5);
            let (mut colors, mut depths) = (vec![Rgb888::BLACK; count], vec![0u16; count]);
            let mut frame = Frame::new(&mut colors, &mut depths[..], WINDOW).unwrap();
            let window = Window::new(&WINDOW);
            frame
                .shade(&point, &window, |fragment| {
                    let ([got], [got_wide]) = fragment.varyings;
                    assert_eq!((got.to_num::<u16>(), got_wide), (value, wide), "{place:?}");
                    Rgb888::WHITE
                })
                .unwrap();
            for (pixel, got) in pixels(WINDOW).zip(&depths) {
                let expected = if definition::<S>(place, 5).owns(pixel) { depth } else { 0 };
                assert_eq!(*got, expected, "{place:?} {pixel:?}");
            }
        }
    }
    points::<S4>(3);
    points::<S8>(4);
}

fn every_vertex(mesh: &Mesh<'_>) -> Vec<u16> {
    (0..mesh.vertex_count() as u16).collect()
}

/// Of a mesh without triangles too, and with vertices on demand. From near by, vertices behind the
/// near plane are left out.
#[test]
fn points_of_an_object_lie_on_its_vertices() {
    fn points<S: Subpixel>(z: &str, size: u8) -> usize {
        let ball = ball();
        let tables =
            Tables { triangles: Triangles::U8(&[]), materials: &[], ..*ball.mesh().tables() };
        let mesh =
            Mesh::new(Tables { positions: tables.positions, scale: tables.scale, ..Tables::EMPTY })
                .unwrap();
        let indices = every_vertex(&mesh);
        let points = Points::new(&mesh, PointIndices::U16(&indices)).unwrap();
        let camera = at(z, DISPLAY);
        let object = Object::new(&mesh, Unlit::<Rgb888>::new());
        let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&camera, &mut storage).unwrap();
        let places: Vec<_> = seen.vertices().iter().filter_map(|v| v.position()).collect();
        let owned: Vec<u32> = pixels(DISPLAY)
            .map(|pixel| {
                let owns = |place: &&[i32; 2]| definition::<S>(**place, size).owns(pixel);
                places.iter().filter(owns).count() as u32
            })
            .collect();
        assert!(owned.iter().sum::<u32>() > 20, "{z}: no points are in the picture");
        let mut counter = Counter::<Rgb888>::new(DISPLAY);
        seen.points(&points)
            .sized(size)
            .fill(Rgb888::WHITE, &mut Direct::new(&mut counter))
            .unwrap();
        assert_eq!(counter.counts(), owned, "{z}");
        let mut again = Counter::<Rgb888>::new(DISPLAY);
        let seen = object.project_on_demand::<_, _, NoDepth>(&camera, S::default()).unwrap();
        seen.points(&points).sized(size).fill(Rgb888::WHITE, &mut Direct::new(&mut again)).unwrap();
        assert_eq!(again.counts(), owned, "{z}: without storage");
        places.len()
    }
    for z in ["3", "1.2", "0.9", "0.18"] {
        let seen = [points::<S4>(z, 1), points::<S8>(z, 4)];
        assert_eq!(seen[0] == ball().mesh().vertex_count(), z == "3", "{z} {seen:?}");
    }
}

/// Points in the colours of the shader over the triangles, hidden by these.
#[test]
fn bands_join_without_a_seam() {
    let ball = ball();
    let mesh = ball.mesh();
    let indices = every_vertex(&mesh);
    let points = Points::new(&mesh, PointIndices::U16(&indices)).unwrap();
    for z in ["3", "0.9"] {
        let object = Object::new(&mesh, Position);
        let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&at(z, DISPLAY), &mut storage).unwrap();
        let nearer = "0.01".parse().unwrap();
        let draw = |band: &mut Frame<'_, _, &mut [u16]>| {
            seen.draw_depth(band)?;
            seen.points(&points).sized(3).nearer(nearer).draw(band)
        };
        let whole = picture::<u16>(ROWS, draw);
        let drawn = whole.drawn(BACKGROUND).len();
        assert!(drawn > 100, "{z}: {drawn}");
        for rows in [1, 7, 16] {
            assert!(whole == picture::<u16>(rows, draw), "{z} in bands of {rows} rows");
        }
    }
}

/// A convex body hides the points at its far side.
#[test]
fn points_are_tested_against_depth() {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = at("3", DISPLAY);
    let object = Object::new(&mesh, Unlit::<Rgb888>::new()).biased(Bias::BEHIND_LINES);
    let mut storage = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&camera, &mut storage).unwrap();
    let is_front = front_vertices(&seen, &mesh);
    let (mut before, mut behind) = (0, 0);
    for vertex in every_vertex(&mesh) {
        let one = [vertex];
        let points = Points::new(&mesh, PointIndices::U16(&one)).unwrap();
        let mut picture = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
        seen.draw_depth(&mut frame).unwrap();
        let surface = picture.depth.clone();
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
        seen.points(&points).fill(Rgb888::WHITE, &mut frame).unwrap();
        // A point's pixel may lie beyond the ball's outline, where the surface is steep.
        let [x, y] = seen.vertices()[usize::from(vertex)].position().unwrap().map(|c| c >> 8);
        let is_inside = pixels(DISPLAY)
            .zip(&surface)
            .filter(|([px, py], _)| (px - i64::from(x)).abs() < 2 && (py - i64::from(y)).abs() < 2)
            .all(|(_, depth)| *depth > 0);
        if !is_inside {
            continue;
        }
        let drawn = picture.color.iter().filter(|color| **color == Rgb888::WHITE).count();
        if is_front[usize::from(vertex)] {
            assert_eq!(drawn, 1, "{vertex} is before the ball");
            before += 1;
        } else {
            assert_eq!(drawn, 0, "{vertex} is behind the ball");
            behind += 1;
        }
    }
    assert!(before > 20 && behind > 20, "{before} {behind}");
}
