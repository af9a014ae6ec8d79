//! Frames in bands: with and without bins, with stored vertices and with vertices projected on
//! demand, one band after the other and on two threads. The picture always equals that of the whole
//! frame, bit for bit.

use std::{cell::Cell, convert::Infallible, thread};

use embedded_graphics::pixelcolor::Rgb888;
use fixed::types::U16F16;
use rasterizer::{
    attribute::{DepthFormat, FloatDepth, NoDepth},
    geometry::{CullBack, CullNone, Culling, ScreenVertex},
    mesh::{Material, Mesh, MeshMaterial, MeshVertex, Tables},
    numbers::{S4, S8, Subpixel},
    output::{BandAreas, Frame},
    raster::Fragment,
    scene::{Object, ProjectError, bin_words},
    shade::{Gouraud, OnScreen, Shader, Unlit},
};
use rasterizer_tests::{
    Picture, Random, Surface, area,
    bands::{
        BACKGROUND, DISPLAY, Depth, EYES, MATERIALS, Position, ROWS, Screen, at, ball, light,
        picture,
    },
};

fn bands_equal_the_frame<S, D, Sh, K>(
    shader: &Sh,
    culling: K,
    heights: impl Iterator<Item = u32> + Clone,
) where
    S: Subpixel,
    D: Depth + DepthFormat,
    Sh: Shader<Color = Rgb888>,
    K: Culling,
{
    let ball = ball();
    let tables = Tables { materials: &MATERIALS, ..*ball.mesh().tables() };
    let mesh = Mesh::new(tables).unwrap();
    let object = Object::new(&mesh, shader.clone()).culled(culling);
    let mut storage = vec![ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let seen = object.project(&camera, &mut storage).unwrap();
        let walked = object.project_on_demand(&camera, S::default()).unwrap();
        let whole = picture::<D>(ROWS, |frame| seen.draw(frame));
        let covered = whole.drawn(BACKGROUND).len();
        let least = if K::BACK || eye > "1" { 400 } else { 0 };
        assert!(covered >= least, "only {covered} pixels from {eye}");
        assert!(whole == picture::<D>(ROWS, |frame| walked.draw(frame)), "walked from {eye}");
        for rows in heights.clone() {
            assert!(whole == picture::<D>(rows, |band| seen.draw(band)), "{rows} rows from {eye}");
            assert!(
                whole == picture::<D>(rows, |band| walked.draw(band)),
                "walked, {rows} rows from {eye}"
            );
            // Bins as high as the bands, and others that the bands overlap in every way.
            for bin_rows in [rows, 1, 5, 16, ROWS, 1000] {
                let mut bins = vec![!0; bin_words(mesh.triangle_count(), ROWS, bin_rows)];
                let binned = seen.clone().binned(bin_rows, &mut bins).unwrap();
                let name = || format!("{rows} rows from {eye} in bins of {bin_rows}");
                assert!(whole == picture::<D>(rows, |band| binned.draw(band)), "{}", name());
                let mut others = vec![!0; bins.len()];
                let binned = walked.clone().binned(bin_rows, &mut others).unwrap();
                assert!(
                    whole == picture::<D>(rows, |band| binned.draw(band)),
                    "walked, {}",
                    name()
                );
                assert_eq!(bins, others, "{}", name());
            }
        }
    }
}

#[test]
fn bands_of_every_height_equal_the_whole_frame() {
    bands_equal_the_frame::<S8, u16, _, _>(&Position, CullBack, 1..=ROWS + 1);
}

const SOME: [u32; 6] = [1, 2, 7, 16, 24, 46];

#[test]
fn bands_equal_the_whole_frame_in_every_format() {
    fn formats<S: Subpixel>(culling: impl Culling) {
        let heights = SOME.into_iter();
        bands_equal_the_frame::<S, u16, _, _>(&Unlit::new(), culling, heights.clone());
        bands_equal_the_frame::<S, u32, _, _>(&Gouraud::new(light()), culling, heights.clone());
        bands_equal_the_frame::<S, u16, _, _>(&Gouraud::new(light()), culling, heights.clone());
        bands_equal_the_frame::<S, FloatDepth, _, _>(
            &Gouraud::new(light()),
            culling,
            heights.clone(),
        );
        bands_equal_the_frame::<S, u32, _, _>(&Position, culling, heights);
    }
    formats::<S4>(CullBack);
    formats::<S8>(CullNone);
}

/// Without depth the last triangle drawn is visible. Back faces are drawn too, so that each pixel
/// shows which of two triangles came last.
#[test]
fn bands_keep_the_order_of_the_triangles() {
    bands_equal_the_frame::<S8, NoDepth, _, _>(&Position, CullNone, SOME.into_iter());
    bands_equal_the_frame::<S4, NoDepth, _, _>(&Unlit::new(), CullNone, SOME.into_iter());
}

/// A surface in one colour, then the same surface in another: at equal depths the first stays, in
/// every band.
#[test]
fn ties_are_won_by_the_first_in_every_band() {
    let once = ball();
    let tables = *once.mesh().tables();
    let first: Vec<[u16; 3]> =
        (0..).map_while(|i| tables.triangles.get(i)).map(|t| t.map(|i| i as u16)).collect();
    let positions = (0..).map_while(|i| tables.positions.get(i)).collect();
    let twice = Surface::new(positions, [&first[..], &first[..]].concat()).scaled(-14);
    let half = |color| Material::new(color, first.len() as u32);
    let materials = [half([9, 8, 7]), half([255, 0, 0])];
    let mesh = Mesh::new(Tables { materials: &materials, ..*twice.mesh().tables() }).unwrap();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Unlit::new()).project(&at("3", DISPLAY), &mut storage).unwrap();
    let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, 5)];
    let seen = seen.binned(5, &mut bins).unwrap();
    let drawn = picture::<u16>(5, |band| seen.draw(band));
    let shown = |color| drawn.pixels.iter().filter(|&&pixel| pixel == Some(color)).count();
    assert!(shown(Rgb888::new(9, 8, 7)) > 400);
    assert_eq!(shown(Rgb888::new(255, 0, 0)), 0);
}

/// Frames of any part of the display (inside, across and outside the viewport) get the same colours
/// and depths with and without bins.
#[test]
fn bins_serve_any_window() {
    let (ball, mut random) = (ball(), Random::new(7));
    let mesh = ball.mesh();
    for eye in EYES {
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, Position);
        let seen = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
        for round in 0..300 {
            let bin_rows = random.within(1, 50) as u32;
            let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, bin_rows)];
            let binned = seen.binned(bin_rows, &mut bins).unwrap();
            let [x, y] = [(); 2].map(|()| random.within(-30, 70));
            let window = area(x, y, random.within(0, 60) as u32, random.within(0, 60) as u32);
            let draw = |is_binned: bool| {
                let mut part = Picture::<_, u16>::empty(window, BACKGROUND);
                let mut frame = Frame::new(&mut part.color, &mut part.depth, window).unwrap();
                let Ok(()) =
                    if is_binned { binned.draw(&mut frame) } else { seen.draw(&mut frame) };
                part
            };
            assert!(
                draw(true) == draw(false),
                "round {round} from {eye}: {window:?} in bins of {bin_rows}"
            );
        }
    }
}

/// A bit is set exactly if the triangle's bounding box contains a pixel centre of the bin's rows.
/// Of a clipped triangle the remaining pieces count.
#[test]
fn bits_are_those_of_the_triangles_that_reach_a_band() {
    let ball = ball();
    let mesh = ball.mesh();
    for eye in EYES {
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).culled(CullNone);
        let seen = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
        let bin_rows = 4;
        let bands = ROWS.div_ceil(bin_rows) as usize;
        let mut want = vec![vec![false; bands]; mesh.triangle_count()];
        let Ok(()) = seen.for_each_triangle(|index, corners| {
            let corners = corners
                .map(|corner| corner.position().unwrap().map(|c| f64::from(c) / 256.0 - 0.5));
            let range = |axis: usize, from: i32, length: u32| {
                let values = corners.map(|corner| corner[axis] - f64::from(from));
                let first = values.into_iter().fold(f64::MAX, f64::min).ceil().max(0.0);
                let end = values.into_iter().fold(f64::MIN, f64::max).ceil().min(f64::from(length));
                first as usize..end.max(0.0) as usize
            };
            let (corner, size) = (DISPLAY.top_left, DISPLAY.size);
            if !range(0, corner.x, size.width).is_empty() {
                range(1, corner.y, size.height)
                    .for_each(|row| want[index][row / bin_rows as usize] = true);
            }
            Ok::<(), Infallible>(())
        });
        let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, bin_rows)];
        seen.binned(bin_rows, &mut bins).unwrap();
        for (index, want) in want.iter().enumerate() {
            let words = &bins[index / 32 * bands..][..bands];
            let got: Vec<bool> = words.iter().map(|word| word << (index % 32) >> 31 == 1).collect();
            assert_eq!(&got, want, "triangle {index} from {eye}");
        }
    }
}

#[test]
fn bins_need_their_words() {
    let ball = ball();
    let mesh = ball.mesh();
    assert_eq!(mesh.triangle_count(), 588);
    // 588 bits are 19 words, 47 rows 10 bands of 5.
    let needed = 190;
    assert_eq!(bin_words(588, ROWS, 5), needed);
    for eye in ["3", "-30"] {
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, Unlit::<Rgb888>::new());
        let seen = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
        assert_eq!(seen.is_outside_view(), eye == "-30");
        for room in [0, 1, needed - 1] {
            let error = seen.binned(5, &mut vec![0; room]).err();
            assert_eq!(error, Some(ProjectError::BinStorage { needed }));
        }
        let mut more = vec![7; needed + 1];
        let binned = seen.binned(5, &mut more).unwrap();
        let is_drawn = picture::<u16>(5, |band| binned.draw(band)).drawn(BACKGROUND).len() > 400;
        assert_eq!(is_drawn, eye == "3");
        assert_eq!(more[needed], 7);
    }
    assert_eq!(
        ProjectError::BinStorage { needed }.to_string(),
        "the bands need 190 words for their triangles"
    );
    assert_eq!(bin_words(5_856, 240, 16) * 4, 10_980);
    assert_eq!((bin_words(0, 240, 16), bin_words(1, 1, 16), bin_words(33, 17, 16)), (0, 1, 4));
}

/// Two threads draw every other band each, in any order. They share the object, its vertices and
/// its bins; each owns the memory of its bands.
#[test]
fn threads_share_a_frame() {
    fn drawn_by_two(seen: &(impl Fn(&mut Frame<'_, Rgb888, &mut [u16]>) + Sync)) -> Vec<Rgb888> {
        let mut color = vec![BACKGROUND; 61 * ROWS as usize];
        let mut bands: Vec<_> = BandAreas::new(DISPLAY, 4).zip(color.chunks_mut(61 * 4)).collect();
        let (mut even, mut odd) = (vec![], vec![]);
        while let Some(band) = bands.pop() {
            if bands.len() % 2 == 0 {
                even.push(band);
            } else {
                odd.push(band);
            }
        }
        thread::scope(|scope| {
            for half in [even, odd] {
                scope.spawn(move || {
                    let mut depth = vec![0u16; 61 * 4];
                    for (area, color) in half {
                        let depth = &mut depth[..color.len()];
                        let mut frame = Frame::new(color, depth, area).unwrap();
                        frame.clear(BACKGROUND);
                        seen(&mut frame);
                    }
                });
            }
        });
        color
    }
    let ball = ball();
    let mesh = ball.mesh();
    for eye in EYES {
        let object = Object::new(&mesh, Gouraud::new(light()));
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; mesh.vertex_count()];
        let seen = object.project(&at(eye, DISPLAY), &mut storage).unwrap();
        let walked = object.project_on_demand(&at(eye, DISPLAY), S8).unwrap();
        let whole: Vec<_> =
            picture::<u16>(ROWS, |frame| seen.draw(frame)).pixels.into_iter().flatten().collect();
        let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, 4)];
        let binned = seen.binned(4, &mut bins).unwrap();
        let seen = |frame: &mut Frame<'_, Rgb888, &mut [u16]>| {
            let Ok(()) = seen.draw(frame);
        };
        assert!(drawn_by_two(&seen) == whole, "from {eye}");
        let binned = |frame: &mut Frame<'_, Rgb888, &mut [u16]>| {
            let Ok(()) = binned.draw(frame);
        };
        assert!(drawn_by_two(&binned) == whole, "in bins, from {eye}");
        let walked = |frame: &mut Frame<'_, Rgb888, &mut [u16]>| {
            let Ok(()) = walked.draw(frame);
        };
        assert!(drawn_by_two(&walked) == whole, "walked, from {eye}");
    }
}

/// A shader that counts the vertices it is called for.
#[derive(Clone)]
struct Counting<'c>(&'c Cell<usize>);

impl Shader for Counting<'_> {
    type Color = Rgb888;
    type Varyings = [u16; 1];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        self.0.set(self.0.get() + 1);
        [vertex.position()[0] as u16]
    }

    fn pixel(&self, (): &(), (): &(), fragment: Fragment<[U16F16; 1]>) -> Rgb888 {
        let [x] = fragment.varyings;
        Rgb888::new((x.to_bits() >> 24) as u8, 99, 99)
    }
}

/// The size of the cache does not change the picture. The larger it is, the fewer vertices are
/// projected again, and an object outside the picture projects none.
#[test]
fn walking_remembers_recent_vertices() {
    fn walked<const N: usize>(mesh: &Mesh<'_>, eye: &str, whole: &Screen<Rgb888>) -> usize {
        let count = Cell::new(0);
        let object = Object::new(mesh, Counting(&count));
        let seen = object.project_on_demand(&at(eye, DISPLAY), S8).unwrap().with_cache::<N>();
        assert!(&picture::<u16>(ROWS, |frame| seen.draw(frame)) == whole, "{N} vertices");
        count.get()
    }
    let ball = ball();
    let mesh = ball.mesh();
    let count = Cell::new(0);
    for eye in ["3", "0.9", "-30"] {
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; mesh.vertex_count()];
        let seen =
            Object::new(&mesh, Counting(&count)).project(&at(eye, DISPLAY), &mut storage).unwrap();
        let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
        let counts = [
            walked::<0>(&mesh, eye, &whole),
            walked::<1>(&mesh, eye, &whole),
            walked::<7>(&mesh, eye, &whole),
            walked::<16>(&mesh, eye, &whole),
            walked::<1000>(&mesh, eye, &whole),
        ];
        match eye {
            // Without a cache all corners of all triangles; with a large one each vertex once.
            "3" => {
                assert_eq!(
                    (counts[0], counts[4]),
                    (3 * mesh.triangle_count(), mesh.vertex_count())
                );
            }
            "-30" => assert_eq!(counts, [0; 5]),
            _ => (),
        }
        assert!(counts.is_sorted_by(|a, b| a >= b), "{counts:?}");
    }
}
