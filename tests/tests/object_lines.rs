//! Lines between the vertices of an object: on the vertices of its triangles, cut where they are
//! cut, hidden by them, and alike in bands.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::PointsIter as _,
};
use fixed::types::U0F32;
use host_tools::reference;
use rasterizer::{
    attribute::NoDepth,
    camera::{Camera, Perspective},
    geometry::{CullNone, ScreenVertex},
    mesh::{Lines, Mesh, Segments, Tables},
    numbers::{S4, S8, Subpixel},
    output::{Direct, Frame},
    raster::Bias,
    scene::{Object, bin_words},
    shade::{Gouraud, Unlit},
};
use rasterizer_tests::{
    Counter, Picture,
    bands::{BACKGROUND, DISPLAY, MATERIALS, Position, ROWS, at, ball, light, picture},
    edges, front_vertices,
};

fn camera(z: &str) -> Camera<Perspective> {
    at(z, DISPLAY)
}

/// How often each pixel of the display is drawn by lines.
fn counted<S: Subpixel>(
    mesh: &Mesh<'_>,
    camera: &Camera<Perspective>,
    segments: &[[u16; 2]],
    width: u8,
) -> Vec<u32> {
    let lines = Lines::new(mesh, Segments::U16(segments)).unwrap();
    let object = Object::new(mesh, Unlit::<Rgb888>::new());
    let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(camera, &mut storage).unwrap();
    let mut counter = Counter::<Rgb888>::new(DISPLAY);
    let mut direct = Direct::new(&mut counter);
    seen.lines(&lines).wide(width).fill(Rgb888::WHITE, &mut direct).unwrap();
    let mut again = Counter::<Rgb888>::new(DISPLAY);
    let seen = object.project_on_demand::<_, _, NoDepth>(camera, S::default()).unwrap();
    seen.lines(&lines).wide(width).fill(Rgb888::WHITE, &mut Direct::new(&mut again)).unwrap();
    assert_eq!(counter.counts(), again.counts(), "without storage");
    counter.counts().to_vec()
}

fn owned_by_vertices<S: Subpixel>(width: u8) {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = camera("3");
    let edges = edges(&mesh);
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let mut storage = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&camera, &mut storage).unwrap();
    let place = |i: u16| seen.vertices()[usize::from(i)].position().unwrap().map(i64::from);
    let lines: Vec<_> = (edges.iter())
        .map(|edge| reference::Line {
            ends: edge.map(place),
            subpixel_bits: S::BITS,
            width: width.into(),
        })
        .collect();
    let owned: Vec<u32> = (DISPLAY.points())
        .map(|point| [i64::from(point.x), i64::from(point.y)])
        .map(|pixel| lines.iter().filter(|line| line.owns(pixel)).count() as u32)
        .collect();
    assert!(owned.iter().sum::<u32>() > 1000, "the ball is not in the picture");
    assert_eq!(counted::<S>(&mesh, &camera, &edges, width), owned);
}

#[test]
fn lines_of_an_object_lie_on_its_vertices() {
    owned_by_vertices::<S4>(1);
    owned_by_vertices::<S8>(2);
}

/// A line in pixels of the display, cut by the near plane: from the tables' numbers in f64.
fn exact(ends: [[i16; 3]; 2], z: &str) -> Option<[[f64; 2]; 2]> {
    let (sine, cosine) = (-8f64).to_radians().sin_cos();
    let eye = [0.1, 0.2, z.parse::<f64>().unwrap()];
    let near = if z < "1" { 0.004 } else { 0.25 };
    let [a, b] = ends.map(|end| {
        let [x, y, z] = [0, 1, 2].map(|i| f64::from(end[i]) / 16_384.0 - eye[i]);
        // The camera's rotation backwards.
        [x, cosine * y + sine * z, cosine * z - sine * y]
    });
    let cut = |inside: [f64; 3], outside: [f64; 3]| {
        let part = (-near - inside[2]) / (outside[2] - inside[2]);
        [0, 1, 2].map(|i| inside[i] + part * (outside[i] - inside[i]))
    };
    let [a, b] = match [a, b].map(|end| end[2] <= -near) {
        [true, true] => [a, b],
        [true, false] => [a, cut(a, b)],
        [false, true] => [cut(b, a), b],
        [false, false] => return None,
    };
    let (corner, size) = (DISPLAY.top_left, DISPLAY.size);
    let focal = f64::from(size.height) / 2.0 / 35f64.to_radians().tan();
    let middle = [
        f64::from(corner.x) + f64::from(size.width) / 2.0,
        f64::from(corner.y) + f64::from(size.height) / 2.0,
    ];
    Some([a, b].map(|[x, y, z]| [middle[0] - focal * x / z, middle[1] + focal * y / z]))
}

/// How far a place lies from a segment, and which part of the way its nearest point is.
fn distance([x, y]: [f64; 2], [from, to]: [[f64; 2]; 2]) -> (f64, f64) {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = along[0].hypot(along[1]);
    let part = ((x - from[0]) * along[0] + (y - from[1]) * along[1]) / length.powi(2);
    let part = if length == 0.0 { 0.0 } else { part.clamp(0.0, 1.0) };
    let nearest = [from[0] + part * along[0], from[1] + part * along[1]];
    ((x - nearest[0]).hypot(y - nearest[1]), part)
}

/// Where the near plane and the guard band cut the ball. A drawn pixel's diamond meets the line, so
/// that its centre is within half a pixel of it; and the line has a pixel every 1.5 pixels.
#[test]
fn lines_are_cut_where_they_leave_the_view() {
    /// A vertex's error in S8 is 5 / 2048 pixel; an end at the near plane is known to 4 units of
    /// clip space, 2^-20 of what the camera sees there.
    const ERROR: f64 = 0.01;
    let ball = ball();
    let mesh = ball.mesh();
    let (mut cut, mut checked) = (0, 0);
    for z in ["1.2", "0.9", "0.18"] {
        for edge in edges(&mesh) {
            let positions = edge.map(|i| mesh.tables().positions.get(i.into()).unwrap());
            let counts = counted::<S8>(&mesh, &camera(z), &[edge], 1);
            let pixels = DISPLAY.points().zip(&counts).filter(|(_, count)| **count > 0);
            let centers: Vec<_> = pixels
                .map(|(point, count)| {
                    assert_eq!(*count, 1, "{edge:?}");
                    [f64::from(point.x) + 0.5, f64::from(point.y) + 0.5]
                })
                .collect();
            let Some(line) = exact(positions, z) else {
                assert!(centers.is_empty(), "{edge:?} is behind the near plane");
                continue;
            };
            cut += usize::from(line.as_flattened().iter().any(|c| c.abs() > 1000.0));
            for &center in &centers {
                let (distance, _) = distance(center, line);
                assert!(distance <= 0.5 + ERROR, "{edge:?} {line:?} {center:?}: {distance}");
            }
            // Places along the line, in the display and not at its ends.
            let [from, to] = line;
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            for point in DISPLAY.points() {
                let center = [f64::from(point.x) + 0.5, f64::from(point.y) + 0.5];
                let (away, part) = distance(center, line);
                let is_inner = DISPLAY.offset(-2).contains(point);
                if away > 0.5 || !is_inner || part * length < 1.5 || (1.0 - part) * length < 1.5 {
                    continue;
                }
                checked += 1;
                let near = |c: &&[f64; 2]| (c[0] - center[0]).hypot(c[1] - center[1]) < 1.5;
                assert!(centers.iter().any(|c| near(&c)), "{edge:?} {line:?} misses {point}");
            }
        }
    }
    assert!(cut > 40 && checked > 1_000, "{cut} {checked}");
}

/// A wireframe over a lit model, hidden by its own depth, in a frame.
fn wireframe(z: &str) -> (Picture<Rgb888, u16>, Vec<[u16; 2]>) {
    let ball = ball();
    let mesh = ball.mesh();
    let edges = edges(&mesh);
    let lines = Lines::new(&mesh, Segments::U16(&edges)).unwrap();
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    let object = Object::new(&mesh, Position).culled(CullNone).biased(Bias::BEHIND_LINES);
    let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&camera(z), &mut storage).unwrap();
    let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
    seen.draw_depth(&mut frame).unwrap();
    assert!(frame.pixels().iter().all(|pixel| *pixel == BACKGROUND), "depth has no colour");
    seen.lines(&lines).wide(2).draw(&mut frame).unwrap();
    (picture, edges)
}

#[test]
fn bands_join_without_a_seam() {
    for z in ["3", "1.2", "0.9", "0.18"] {
        let (whole, edges) = wireframe(z);
        let ball = ball();
        let mesh = ball.mesh();
        let lines = Lines::new(&mesh, Segments::U16(&edges)).unwrap();
        let object = Object::new(&mesh, Position).culled(CullNone).biased(Bias::BEHIND_LINES);
        let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&camera(z), &mut storage).unwrap();
        for rows in [1, 7, 16] {
            let bands = picture::<u16>(rows, |band| {
                seen.draw_depth(band)?;
                seen.lines(&lines).wide(2).draw(band)
            });
            assert!(bands.pixels.iter().flatten().eq(&whole.color), "{z} in bands of {rows} rows");
        }
    }
}

/// Depth is the same in every order of the triangles.
#[test]
fn depth_alone_is_drawn_in_every_order() {
    let ball = ball();
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let object = Object::new(&mesh, Unlit::<Rgb888>::new());
    let mut storage = vec![ScreenVertex::<S4, u16, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&camera("1.7"), &mut storage).unwrap();
    fn depth(draw: impl FnOnce(&mut Frame<'_, Rgb888, &mut [u16]>)) -> Vec<u16> {
        let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
        draw(&mut Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap());
        assert!(picture.color.iter().all(|color| *color == BACKGROUND));
        picture.depth
    }
    let expected = depth(|frame| seen.draw_depth(frame).unwrap());
    assert!(expected.iter().filter(|depth| **depth > 0).count() > 500);
    let mut words = vec![0; mesh.triangle_count()];
    let sorted = seen.back_to_front(&mut words).unwrap();
    assert!(depth(|frame| sorted.draw_depth(frame).unwrap()) == expected, "from back to front");
    let mut words = vec![0; bin_words(mesh.triangle_count(), ROWS, 7)];
    let binned = seen.binned(7, &mut words).unwrap();
    assert!(depth(|frame| binned.draw_depth(frame).unwrap()) == expected, "in bins");
}

/// A closed convex body hides the edges on its far side, and none on its near side, but at its
/// outline.
#[test]
fn hidden_lines_are_those_behind_the_surface() {
    let ball = ball();
    let mesh = ball.mesh();
    let camera = camera("3");
    let edges = edges(&mesh);
    let object = Object::new(&mesh, Gouraud::<Rgb888>::new(light())).biased(Bias::BEHIND_LINES);
    let mut storage = vec![ScreenVertex::<S8, u16, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&camera, &mut storage).unwrap();
    let is_front = front_vertices(&seen, &mesh);
    let mut front = vec![];
    seen.for_each_triangle(|index, _| {
        let corners = mesh.tables().triangles.get(index).unwrap();
        let [a, b, c] = corners.map(|corner| corner as u16);
        front.extend([[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]));
        Ok::<(), std::convert::Infallible>(())
    })
    .unwrap();
    let mut visible = 0;
    for edge in edges {
        let one = [edge];
        let lines = Lines::new(&mesh, Segments::U16(&one)).unwrap();
        let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
        seen.draw_depth(&mut frame).unwrap();
        let surface = picture.depth.clone();
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
        seen.lines(&lines).fill(Rgb888::WHITE, &mut frame).unwrap();
        let is_drawn = |color: &Rgb888| *color == Rgb888::WHITE;
        let drawn = picture.color.iter().filter(|color| is_drawn(color)).count();
        // A line's pixel may lie half a pixel beyond the ball's outline, and at the outline the
        // surface is so steep that the bias moves it far away.
        let width = DISPLAY.size.width as usize;
        let is_inside = |i: usize| {
            let row = i.saturating_sub(1)..i + 2;
            let rows = [row.start.saturating_sub(width), row.start, row.start + width];
            rows.iter().all(|&start| {
                surface.get(start..start + 3).is_some_and(|depths| depths.iter().all(|d| *d > 0))
            })
        };
        let over_surface = (picture.color.iter().enumerate())
            .filter(|(i, color)| is_drawn(color) && is_inside(*i));
        let mut counter = Counter::<Rgb888>::new(DISPLAY);
        let unseen = Object::new(&mesh, Unlit::<Rgb888>::new());
        let mut storage = vec![ScreenVertex::<S8, NoDepth, _>::EMPTY; mesh.vertex_count()];
        let line = unseen.project(&camera, &mut storage).unwrap();
        line.lines(&lines).fill(Rgb888::WHITE, &mut Direct::new(&mut counter)).unwrap();
        let missing = (counter.counts().iter().zip(&picture.color).enumerate())
            .filter(|(i, (count, color))| **count > 0 && !is_drawn(color) && is_inside(*i));
        // An edge of two triangles in front.
        if front.iter().filter(|other| **other == edge).count() == 2 {
            assert_eq!(missing.count(), 0, "{edge:?} lies before the ball");
            visible += drawn;
        } else if !edge.iter().any(|end| is_front[usize::from(*end)]) {
            assert_eq!(over_surface.count(), 0, "{edge:?} lies behind the ball");
        }
    }
    assert!(visible > 300, "{visible}");
}

/// Nearer lines are seen where the same lines in the surface are not.
#[test]
fn lines_can_be_moved_nearer() {
    let ball = ball();
    let mesh = ball.mesh();
    let edges = edges(&mesh);
    let lines = Lines::new(&mesh, Segments::U16(&edges)).unwrap();
    let seen_pixels = |depth: &str| {
        let object = Object::new(&mesh, Unlit::<Rgb888>::new());
        let mut storage = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&camera("3"), &mut storage).unwrap();
        let mut picture = Picture::<_, u32>::empty(DISPLAY, BACKGROUND);
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
        seen.draw(&mut frame).unwrap();
        let nearer = depth.parse::<U0F32>().unwrap();
        seen.lines(&lines).nearer(nearer).fill(Rgb888::WHITE, &mut frame).unwrap();
        picture.color.iter().filter(|color| **color == Rgb888::WHITE).count()
    };
    let counts = ["0", "0.001", "0.999"].map(seen_pixels);
    assert!(counts.is_sorted() && counts[0] < counts[1] && counts[1] < counts[2], "{counts:?}");
}
