//! Frames in bands: with bins and without, with vertices in storage and worked out on the way, sent one after the other
//! or while the next is drawn. It is always the picture of the whole frame, bit for bit.

use std::{cell::Cell, convert::Infallible, fmt::Debug, thread};

use embedded_graphics::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    pixelcolor::{PixelColor, Rgb565, Rgb888},
    primitives::{PointsIter, Rectangle},
};
use fixed::types::U16F16;
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::{CullBack, CullNone, Culling, NoDepth, Pose, S4, S8, ScreenVertex, Subpixel},
    mesh::{Material, Mesh, Tables},
    numbers::{Angle, Rotation, Scalar, Vec3},
    scene::{Needs, Object, ProjectError, bin_words},
    shade::{Flat, Gouraud, Level, Light, MeshVertex, Shader, Unlit},
    target::{BandAreas, Bands, DepthBuffer, Frame, FrameError, Rgb565Be, StreamError},
};
use rasterizer_tests::{BusError, Call, Picture, Random, Recorder, Surface, area};

const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);
const DISPLAY: Rectangle = area(3, -2, 61, 47);
const ROWS: u32 = DISPLAY.size.height;

/// A user's own shader with three varyings: the position is the colour.
#[derive(Clone, Debug)]
struct Position;

impl Shader for Position {
    type Color = Rgb888;
    type Varyings = [u16; 3];
    type Surface = ();

    fn surface(&self, _: &Material) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 3] {
        vertex.position().map(|c| c as u16 ^ 0x8000)
    }

    fn pixel(&self, (): &(), position: [U16F16; 3]) -> Rgb888 {
        let [red, green, blue] = position.map(|c| (c.to_bits() >> 24) as u8);
        Rgb888::new(red, green, blue)
    }
}

fn light() -> Light {
    Light::new(Vec3::lit("1", "2", "3"), Level::lit("0.2"), Level::lit("0.8"))
}

fn ball() -> Surface {
    Surface::ball(16_384, 7)
        .scaled(-14)
        .with_vertex_normals()
        .colored([250, 220, 150])
}

/// The materials of a mesh of 588 triangles: runs that begin and end anywhere in words of 32, one of them empty.
const MATERIALS: [Material; 6] = {
    const fn material(color: [u8; 3], triangle_count: u32) -> Material {
        Material { color, triangle_count }
    }
    [
        material([250, 220, 150], 31),
        material([20, 220, 150], 1),
        material([250, 20, 150], 0),
        material([250, 220, 15], 97),
        material([120, 120, 250], 5),
        material([220, 20, 10], 454),
    ]
};

fn at(z: &str, viewport: Rectangle) -> Camera<Perspective> {
    let lens = Perspective::new(Angle::degrees(70), Distance::lit("0.25"), Distance::lit("10")).unwrap();
    let eye = Vec3::new(Scalar::lit("0.1"), Scalar::lit("0.2"), z.parse().unwrap());
    Camera::at(eye, Rotation::about_x(-Angle::degrees(8)), lens, viewport).unwrap()
}

/// All of the ball; cut by the picture's edges; cut by the near plane; beyond the guard band; from inside.
const EYES: [&str; 5] = ["3", "1.7", "1.2", "0.9", "0.1"];

/// A display that keeps its pixels.
#[derive(Clone, Debug, PartialEq)]
struct Screen<C> {
    area: Rectangle,
    pixels: Vec<Option<C>>,
}

impl<C: PixelColor> Screen<C> {
    fn new(area: Rectangle) -> Self {
        let pixels = vec![None; area.size.width as usize * area.size.height as usize];
        Self { area, pixels }
    }

    /// The part that shows something.
    fn drawn(&self, background: C) -> Vec<Point> {
        let all = self.area.points().zip(&self.pixels);
        all.filter(|(_, pixel)| pixel.is_some_and(|pixel| pixel != background))
            .map(|(point, _)| point)
            .collect()
    }
}

impl<C> Dimensions for Screen<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Screen<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, color) in pixels {
            let from_corner = point - self.area.top_left;
            let index = from_corner.y as usize * self.area.size.width as usize + from_corner.x as usize;
            self.pixels[index] = Some(color);
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(&mut self, area: &Rectangle, colors: I) -> Result<(), Infallible> {
        let mut colors = colors.into_iter();
        let pixels = area
            .points()
            .zip(colors.by_ref())
            .map(|(p, c)| Pixel(p, c))
            .collect::<Vec<_>>();
        assert_eq!(pixels.len(), area.size.width as usize * area.size.height as usize);
        assert!(colors.next().is_none(), "colours beyond {area:?}");
        self.draw_iter(pixels)
    }
}

/// Bands of so many rows in memory of their own.
trait Depth: Sized {
    type Buffer: DepthBuffer<Format = Self> + Default;
    fn bands(area: Rectangle, rows: u32) -> Bands<Vec<Rgb888>, Rgb888, Self::Buffer>;
}

fn memory<T: Clone>(area: Rectangle, rows: u32, value: T) -> Vec<T> {
    vec![value; (area.size.width * rows) as usize]
}

macro_rules! stored {
    ($depth:ty) => {
        impl Depth for $depth {
            type Buffer = &'static mut [$depth];
            fn bands(area: Rectangle, rows: u32) -> Bands<Vec<Rgb888>, Rgb888, Self::Buffer> {
                Bands::new(area, memory(area, rows, BACKGROUND), memory(area, rows, 0).leak()).unwrap()
            }
        }
    };
}
stored!(u16);
stored!(u32);

impl Depth for NoDepth {
    type Buffer = Self;
    fn bands(area: Rectangle, rows: u32) -> Bands<Vec<Rgb888>, Rgb888, Self> {
        Bands::without_depth(area, memory(area, rows, BACKGROUND)).unwrap()
    }
}

/// A picture of `DISPLAY` in bands of so many rows.
fn picture<D: Depth>(
    rows: u32,
    draw: impl FnMut(&mut Frame<'_, Rgb888, D::Buffer>) -> Result<(), Infallible>,
) -> Screen<Rgb888> {
    let mut screen = Screen::new(DISPLAY);
    let Ok(()) = D::bands(DISPLAY, rows).show(&mut screen, BACKGROUND, draw);
    assert!(screen.pixels.iter().all(Option::is_some), "a pixel was not sent");
    screen
}

fn bands_equal_the_frame<S, D, Sh, K>(shader: &Sh, culling: K, heights: impl Iterator<Item = u32> + Clone)
where
    S: Subpixel,
    D: Depth + rasterizer::geometry::DepthFormat + rasterizer::raster::Interpolate,
    Sh: Shader<Color = Rgb888>,
    K: Culling,
{
    let ball = ball();
    let tables = Tables {
        materials: &MATERIALS,
        ..*ball.mesh().tables()
    };
    let mesh = Mesh::new(tables).unwrap();
    let object = Object::new(&mesh, shader.clone()).culled(culling);
    let mut storage = vec![ScreenVertex::<S, D, Sh::Varyings>::EMPTY; mesh.vertex_count()];
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let seen = object.project(&camera, &mut storage).unwrap();
        let walked = object.walk(&camera, S::default()).unwrap();
        let whole = picture::<D>(ROWS, |frame| seen.draw(frame));
        let covered = whole.drawn(BACKGROUND).len();
        let least = if K::BACK || eye > "1" { 400 } else { 0 };
        assert!(covered >= least, "only {covered} pixels from {eye}");
        assert!(
            whole == picture::<D>(ROWS, |frame| walked.draw(frame)),
            "walked from {eye}"
        );
        for rows in heights.clone() {
            assert!(
                whole == picture::<D>(rows, |band| seen.draw(band)),
                "{rows} rows from {eye}"
            );
            assert!(
                whole == picture::<D>(rows, |band| walked.draw(band)),
                "walked, {rows} rows from {eye}"
            );
            // Bins of the bands' height, and of others that the bands overlap in every way.
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
        bands_equal_the_frame::<S, u32, _, _>(&Position, culling, heights);
    }
    formats::<S4>(CullBack);
    formats::<S8>(CullNone);
}

/// What is drawn last is seen: with back faces drawn too, each pixel tells the order of two triangles.
#[test]
fn bands_keep_the_order_of_the_triangles() {
    bands_equal_the_frame::<S8, NoDepth, _, _>(&Position, CullNone, SOME.into_iter());
    bands_equal_the_frame::<S4, NoDepth, _, _>(&Unlit::new(), CullNone, SOME.into_iter());
}

/// A surface in one colour and the same again in another: at equal depths the first stays, in every band.
#[test]
fn ties_are_won_by_the_first_in_every_band() {
    let once = ball();
    let tables = *once.mesh().tables();
    let first: Vec<[u16; 3]> = (0..)
        .map_while(|i| tables.triangles.get(i))
        .map(|t| t.map(|i| i as u16))
        .collect();
    let twice = Surface::new(tables.positions.to_vec(), [&first[..], &first[..]].concat()).scaled(-14);
    let half = |color| Material {
        color,
        triangle_count: first.len() as u32,
    };
    let materials = [half([9, 8, 7]), half([255, 0, 0])];
    let mesh = Mesh::new(Tables {
        materials: &materials,
        ..*twice.mesh().tables()
    })
    .unwrap();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Unlit::new())
        .project(&at("3", DISPLAY), &mut storage)
        .unwrap();
    let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, 5)];
    let seen = seen.binned(5, &mut bins).unwrap();
    let drawn = picture::<u16>(5, |band| seen.draw(band));
    let shown = |color| drawn.pixels.iter().filter(|&&pixel| pixel == Some(color)).count();
    assert!(shown(Rgb888::new(9, 8, 7)) > 400);
    assert_eq!(shown(Rgb888::new(255, 0, 0)), 0);
}

/// Frames of any part of the display, inside, across and outside the viewport, get the colours and depths that they get
/// without bins.
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
            let binned = seen.clone().binned(bin_rows, &mut bins).unwrap();
            let [x, y] = [(); 2].map(|()| random.within(-30, 70));
            let window = area(x, y, random.within(0, 60) as u32, random.within(0, 60) as u32);
            let draw = |is_binned: bool| {
                let mut part = Picture::<_, u16>::empty(window, BACKGROUND);
                let mut frame = Frame::new(&mut part.color, &mut part.depth, window).unwrap();
                let Ok(()) = if is_binned {
                    binned.draw(&mut frame)
                } else {
                    seen.draw(&mut frame)
                };
                part
            };
            assert!(
                draw(true) == draw(false),
                "round {round} from {eye}: {window:?} in bins of {bin_rows}"
            );
        }
    }
}

/// The bits say exactly which triangles have a column and a row of centres between their corners, also those that are
/// cut: their pieces count, not what was cut off.
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
            let corners = corners.map(|corner| corner.position().unwrap().map(|c| f64::from(c) / 256.0 - 0.5));
            let range = |axis: usize, from: i32, length: u32| {
                let values = corners.map(|corner| corner[axis] - f64::from(from));
                let first = values.into_iter().fold(f64::MAX, f64::min).ceil().max(0.0);
                let end = values
                    .into_iter()
                    .fold(f64::MIN, f64::max)
                    .ceil()
                    .min(f64::from(length));
                first as usize..end.max(0.0) as usize
            };
            let (corner, size) = (DISPLAY.top_left, DISPLAY.size);
            if !range(0, corner.x, size.width).is_empty() {
                range(1, corner.y, size.height).for_each(|row| want[index][row / bin_rows as usize] = true);
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
        assert_eq!(seen.is_hidden(), eye == "-30");
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
    assert_eq!(
        (bin_words(0, 240, 16), bin_words(1, 1, 16), bin_words(33, 17, 16)),
        (0, 1, 4)
    );
}

/// The numbers of a mesh are just enough, and their bytes those of the types.
#[test]
fn needs_are_what_drawing_takes() {
    let ball = ball();
    let mesh = ball.mesh();
    let needs = Needs::of(&mesh, DISPLAY.size, 5);
    let want = Needs {
        vertices: mesh.vertex_count(),
        bin_words: 190,
        pixels: 305,
    };
    assert_eq!(needs, want);
    // 12 bytes for a vertex with depth and light, a word of four, and four of colour and two of depth for a pixel.
    let bytes = needs.vertices * 12 + 190 * 4 + 305 * 6;
    assert_eq!(needs.bytes::<S8, u16, Gouraud<Rgb888>>(), bytes);
    assert_eq!(
        needs.bytes::<S8, NoDepth, Unlit<Rgb565>>(),
        needs.vertices * 8 + 190 * 4 + 305 * 2
    );
    let (mut color, mut depth) = (vec![BACKGROUND; needs.pixels], vec![0u16; needs.pixels]);
    let mut rows = |colors: usize, depths: usize| {
        let bands = Bands::new(DISPLAY, &mut color[..colors], &mut depth[..depths]).unwrap();
        bands.areas().next().unwrap().size.height
    };
    let pixels = needs.pixels;
    assert_eq!(
        (rows(pixels, pixels), rows(pixels - 1, pixels), rows(pixels, pixels - 1)),
        (5, 4, 4)
    );
    assert_eq!(Needs::of(&mesh, DISPLAY.size, 0), Needs::of(&mesh, DISPLAY.size, 1));
}

#[test]
fn bands_need_a_row() {
    let (mut color, mut depth) = ([BACKGROUND; 61], [0u32; 61]);
    let mut rows = |area: Rectangle, colors: usize, depths: usize| {
        Bands::new(area, &mut color[..colors], &mut depth[..depths]).map(|bands| bands.areas().collect::<Vec<_>>())
    };
    assert_eq!(rows(DISPLAY, 61, 61).map(|areas| areas.len()), Ok(47));
    assert_eq!(rows(DISPLAY, 60, 61), Err(FrameError::ColorLength { needed: 61 }));
    assert_eq!(rows(DISPLAY, 61, 60), Err(FrameError::DepthLength { needed: 61 }));
    assert_eq!(
        rows(area(5, 9, 10, 7), 61, 50),
        Ok(vec![area(5, 9, 10, 5), area(5, 14, 10, 2)])
    );
    assert_eq!(rows(area(5, 9, 10, 5), 61, 61), Ok(vec![area(5, 9, 10, 5)]));
    for nothing in [area(5, 9, 0, 7), area(5, 9, 10, 0)] {
        assert_eq!(rows(nothing, 0, 0), Ok(vec![]));
    }
    let without = |colors: usize| Bands::without_depth(DISPLAY, &mut vec![BACKGROUND; colors][..]).map(|_| ());
    assert_eq!(without(60), Err(FrameError::ColorLength { needed: 61 }));
    assert_eq!(without(61), Ok(()));
}

#[test]
fn areas_cover_a_rectangle_from_the_top() {
    for rows in 0..=50 {
        let areas: Vec<_> = BandAreas::new(DISPLAY, rows).collect();
        let points: Vec<_> = areas.iter().flat_map(Rectangle::points).collect();
        assert!(points.into_iter().eq(DISPLAY.points()), "{rows} rows");
        let (last, others) = areas.split_last().unwrap();
        assert!(others.iter().all(|area| area.size.height == rows.max(1)));
        assert!(last.size.height <= rows.max(1));
    }
}

/// Two objects with shaders of their own in one band, and the same bands again for the next frame.
#[test]
fn objects_share_bands() {
    let (ball, cube) = (ball(), Surface::cube(13_000, 3).scaled(-14));
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at("3", DISPLAY);
    let mut smooth = vec![ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; ball.vertex_count()];
    let mut own = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; cube.vertex_count()];
    let mut bands = u16::bands(DISPLAY, 5);
    for angle in [0, 70] {
        let pose = Pose::rotated(Rotation::about_y(Angle::degrees(angle)));
        let ball = Object::new(&ball, Gouraud::new(light()))
            .project(&camera, &mut smooth)
            .unwrap();
        let cube = Object::new(&cube, Position)
            .posed(pose)
            .project(&camera, &mut own)
            .unwrap();
        let whole = picture::<u16>(ROWS, |frame| {
            ball.draw(frame)?;
            cube.draw(frame)
        });
        let alone = [
            picture::<u16>(ROWS, |frame| ball.draw(frame)),
            picture::<u16>(ROWS, |frame| cube.draw(frame)),
        ];
        for alone in &alone {
            let common = whole
                .pixels
                .iter()
                .zip(&alone.pixels)
                .filter(|(both, one)| both == one)
                .count();
            assert!(common < whole.pixels.len() - 100, "one hides the other");
        }
        let mut bins = vec![0; bin_words(588, ROWS, 5)];
        let ball = ball.binned(5, &mut bins);
        let ball = ball.unwrap();
        let mut screen = Screen::new(DISPLAY);
        let Ok(()) = bands.show(&mut screen, BACKGROUND, |band| {
            ball.draw(band)?;
            cube.draw(band)
        });
        assert!(screen == whole, "turned by {angle} degrees");
    }
}

/// Whatever was in a band before, the next begins with nothing but background.
#[test]
fn bands_begin_cleared() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position)
        .project(&at("1.7", DISPLAY), &mut storage)
        .unwrap();
    let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
    let (mut color, mut depth) = ([Rgb888::new(255, 0, 0); 61 * 9], [9_999u16; 61 * 9]);
    let mut screen = Screen::new(DISPLAY);
    let mut bands = Bands::new(DISPLAY, &mut color, &mut depth).unwrap();
    let Ok(()) = bands.show(&mut screen, BACKGROUND, |band| seen.draw(band));
    assert!(screen == whole);
    let other = Rgb888::new(7, 7, 7);
    let Ok(()) = bands.show(&mut screen, other, |_| Ok(()));
    assert!(screen.pixels.iter().all(|&pixel| pixel == Some(other)));
}

/// Bands in any order, and by two threads at once: each has an object, its vertices and its bins to share, and every
/// other band's memory to itself.
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
        let walked = object.walk(&at(eye, DISPLAY), S8).unwrap();
        let whole: Vec<_> = picture::<u16>(ROWS, |frame| seen.draw(frame))
            .pixels
            .into_iter()
            .flatten()
            .collect();
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

/// Each pixel that is drawn lies in the bounds; of an object all in the picture every side of them is reached but for what no centre lies in.
#[test]
fn bounds_hold_what_is_drawn() {
    let (ball, cube) = (ball(), Surface::cube(14_000, 2).scaled(-14));
    let mut random = Random::new(3);
    let mut inside = 0;
    for mesh in [ball.mesh(), cube.mesh()] {
        for round in 0..400 {
            let mut turn = || Angle::from_bits(random.bits() as u32);
            let pose = Pose::rotated(Rotation::about_x(turn()) * Rotation::about_y(turn()));
            let [x, y] = [(); 2].map(|()| Scalar::from_bits(random.within(-3 << 16, 3 << 16)));
            let z = Scalar::from_bits(random.within(-9 << 16, 3 << 14));
            let object = Object::new(&mesh, Unlit::new()).posed(pose.at(Vec3::new(x, y, z)));
            let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
            let seen = object.project(&at("1.7", DISPLAY), &mut storage).unwrap();
            let bounds = seen.bounds();
            assert_eq!(
                bounds,
                object.walk::<_, _, u16>(&at("1.7", DISPLAY), S8).unwrap().bounds()
            );
            let drawn = picture::<u16>(ROWS, |frame| seen.draw(frame)).drawn(BACKGROUND);
            let is_inside = bounds.is_some_and(|bounds| {
                let (low, high) = (bounds.top_left, bounds.bottom_right().unwrap());
                let last = DISPLAY.bottom_right().unwrap();
                low.x > 3 && low.y > -2 && high.x < last.x && high.y < last.y
            });
            inside += usize::from(is_inside);
            let Some(bounds) = bounds else {
                assert_eq!(drawn, [], "round {round}");
                continue;
            };
            assert_eq!(bounds.intersection(&DISPLAY), bounds);
            assert!(
                drawn.iter().all(|&point| bounds.contains(point)),
                "round {round}: {bounds:?}"
            );
            // Centres next to a corner of the outline may lie beside the thin end of its triangles.
            let Some(first) = drawn.first().filter(|_| is_inside) else {
                continue;
            };
            let extent = drawn.iter().fold((*first, *first), |(low, high), point| {
                (low.component_min(*point), high.component_max(*point))
            });
            let (low, high) = (bounds.top_left, bounds.bottom_right().unwrap());
            for slack in [
                extent.0.x - low.x,
                extent.0.y - low.y,
                high.x - extent.1.x,
                high.y - extent.1.y,
            ] {
                assert!((0..=2).contains(&slack), "round {round}: {bounds:?}, drawn {extent:?}");
            }
        }
    }
    assert!(inside > 100, "{inside} objects inside the picture");
}

/// The smallest rectangle that holds both.
fn envelope(a: Rectangle, b: Rectangle) -> Rectangle {
    match (a.bottom_right(), b.bottom_right()) {
        (None, _) => b,
        (_, None) => a,
        (Some(p), Some(q)) => Rectangle::with_corners(a.top_left.component_min(b.top_left), p.component_max(q)),
    }
}

/// Frame after frame, sending only the bounds of what was drawn and what is drawn now shows the whole picture.
#[test]
fn only_what_changes_is_sent() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let (mut color, mut depth) = ([BACKGROUND; 61 * 5], [0u16; 61 * 5]);
    let mut screen = Screen::new(DISPLAY);
    let mut old = DISPLAY;
    let mut sent = 0;
    for step in 0..12 {
        let place = Vec3::new(
            Scalar::from_num(step) / 2 - Scalar::lit("3"),
            Scalar::ZERO,
            Scalar::lit("-2"),
        );
        let object = Object::new(&mesh, Position).posed(Pose::IDENTITY.at(place));
        let seen = object.project(&at("3", DISPLAY), &mut storage).unwrap();
        let new = seen.bounds().unwrap_or_default();
        let changed = envelope(old, new);
        let mut bands = Bands::new(changed, &mut color, &mut depth).unwrap();
        let Ok(()) = bands.show(&mut screen, BACKGROUND, |band| seen.draw(band));
        assert!(screen == picture::<u16>(ROWS, |frame| seen.draw(frame)), "step {step}");
        sent += changed.size.width * changed.size.height;
        old = new;
    }
    let all = 12 * DISPLAY.size.width * DISPLAY.size.height;
    assert!(sent < all / 2, "{sent} pixels of {all}");
}

#[test]
fn a_display_that_fails_ends_the_frame() {
    let sent = |works_for: usize| {
        let mut display = Recorder::failing_after(DISPLAY, works_for);
        let mut bands = u16::bands(DISPLAY, 10);
        let mut drawn = 0;
        let mut show = |display: &mut Recorder<Rgb888>| {
            bands.show(display, BACKGROUND, |_| {
                drawn += 1;
                Ok(())
            })
        };
        let shown = show(&mut display);
        let areas: Vec<_> = display
            .calls()
            .iter()
            .map(|call| match call {
                Call::Contiguous(area, _) => *area,
                other => panic!("{other:?}"),
            })
            .collect();
        // The bands are as good as new.
        let mut works = Recorder::new(DISPLAY);
        assert_eq!((show(&mut works), works.calls().len()), (Ok(()), 5));
        (shown, areas, drawn - 5)
    };
    let all: Vec<_> = BandAreas::new(DISPLAY, 10).collect();
    assert_eq!(sent(5), (Ok(()), all.clone(), 5));
    for works_for in 0..5 {
        let failed = (Err(BusError), all[..=works_for].to_vec(), works_for + 1);
        assert_eq!(sent(works_for), failed);
    }
}

/// Two buffers go back and forth: while one is on its way, the next band is drawn in the other.
#[test]
fn streams_hand_their_buffers_over() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position)
        .project(&at("1.7", DISPLAY), &mut storage)
        .unwrap();
    let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
    let mut depth = [0u16; 61 * 6];
    // Each buffer with its name; its pixels are the first.
    struct Named(char, Box<[Rgb888]>);
    impl AsMut<[Rgb888]> for Named {
        fn as_mut(&mut self) -> &mut [Rgb888] {
            &mut self.1
        }
    }
    let named = |name: char| Named(name, vec![Rgb888::new(255, 0, 0); 61 * 6 + 3].into());
    let (mut screen, mut resting, mut order) = (Screen::new(DISPLAY), Some(named('b')), String::new());
    let bands = Bands::new(DISPLAY, named('a'), &mut depth).unwrap();
    let last = bands.stream(
        BACKGROUND,
        |band| seen.draw(band),
        |finished, area| {
            order.push(finished.0);
            let pixels = (area.size.width * area.size.height) as usize;
            let Ok(()) = screen.fill_contiguous(&area, finished.1[..pixels].iter().copied());
            resting.replace(finished).ok_or(())
        },
    );
    assert!(screen == whole);
    assert_eq!(order, "abababab");
    assert_eq!((last.ok().unwrap().0, resting.unwrap().0), ('a', 'b'));
}

/// The static arrays of a microcontroller, handed over by exchange.
#[test]
fn streams_take_static_buffers() {
    let (front, mut back) = (
        Box::leak(Box::new([BACKGROUND; 61 * 8])),
        Box::leak(Box::new([BACKGROUND; 61 * 8])),
    );
    let first = front.as_ptr();
    let mut bands = 0;
    let bands_of = Bands::without_depth(DISPLAY, front).unwrap();
    let front: &'static mut [Rgb888; 61 * 8] = bands_of
        .stream(
            BACKGROUND,
            |_| Ok(()),
            |mut finished, _| {
                bands += 1;
                std::mem::swap(&mut finished, &mut back);
                Ok::<_, ()>(finished)
            },
        )
        .unwrap();
    assert_eq!((bands, front.as_ptr()), (6, first));
}

#[test]
fn streams_end_with_what_fails() {
    let stream = |fails_at: usize, sizes: [usize; 5]| {
        let (mut depth, mut sent) = (vec![0u32; 61 * 10], 0);
        let bands = Bands::new(DISPLAY, vec![BACKGROUND; 61 * 10], &mut depth).unwrap();
        let ended = bands.stream(
            BACKGROUND,
            |_| Ok(()),
            |_, _| {
                sent += 1;
                if sent > fails_at {
                    Err(BusError)
                } else {
                    Ok(vec![BACKGROUND; sizes[sent - 1]])
                }
            },
        );
        (ended.map(|buffer| buffer.len()), sent)
    };
    let enough = [610, 700, 610, 427, 0];
    assert_eq!(stream(5, enough), (Ok(0), 5));
    for fails_at in 0..5 {
        assert_eq!(
            stream(fails_at, enough),
            (Err(StreamError::Send(BusError)), fails_at + 1)
        );
    }
    let short = |needed| Err(StreamError::Frame(FrameError::ColorLength { needed }));
    assert_eq!(stream(5, [609, 0, 0, 0, 0]), (short(610), 1));
    assert_eq!(stream(5, [610, 610, 610, 426, 0]), (short(427), 4));
    let told: StreamError<Infallible> = StreamError::Frame(FrameError::ColorLength { needed: 427 });
    assert_eq!(told.to_string(), "the colour buffer must have 427 pixels");
}

/// The same values as RGB565 with their bytes exchanged, in every shader.
#[test]
fn big_endian_pixels_are_rgb565_swapped() {
    fn check<Sh: Shader<Color = Rgb565>, Be: Shader<Color = Rgb565Be>>(native: Sh, swapped: Be) {
        let ball = ball();
        let normals = vec![[90, 20, 87]; ball.mesh().triangle_count()];
        let mesh = Mesh::new(Tables {
            face_normals: &normals,
            materials: &MATERIALS,
            ..*ball.mesh().tables()
        })
        .unwrap();
        let background = Rgb565::new(1, 2, 3);
        let mut native_picture = Picture::<_, u16>::empty(DISPLAY, background);
        native_picture.draw(&mesh, native, &at("1.7", DISPLAY));
        let mut picture = Picture::<Rgb565Be, u16>::empty(DISPLAY, background.into());
        picture.draw(&mesh, swapped, &at("1.7", DISPLAY));
        let want: Vec<u8> = native_picture.color.iter().flat_map(|pixel| bytes(*pixel)).collect();
        assert!(Rgb565Be::as_bytes(&picture.color) == want);
        assert!(
            native_picture
                .color
                .iter()
                .filter(|&&pixel| pixel != background)
                .count()
                > 1000
        );
    }
    fn bytes(pixel: Rgb565) -> [u8; 2] {
        embedded_graphics::pixelcolor::IntoStorage::into_storage(pixel).to_be_bytes()
    }
    check(Unlit::new(), Unlit::new());
    check(Flat::new(light()), Flat::new(light()));
    check(Gouraud::new(light()), Gouraud::new(light()));
    for bits in 0..=u16::MAX {
        let color = Rgb565::from(embedded_graphics::pixelcolor::raw::RawU16::from(bits));
        let swapped = Rgb565Be::from(color);
        assert_eq!(Rgb565::from(swapped), color);
        assert_eq!(Rgb565Be::as_bytes(&[swapped]), bits.to_be_bytes());
        let raw = embedded_graphics::pixelcolor::raw::RawU16::from(swapped);
        assert_eq!(Rgb565Be::from(raw), swapped);
    }
    let orange = Rgb888::new(255, 160, 7);
    assert_eq!(Rgb565Be::from(orange), Rgb565Be::from(Rgb565::from(orange)));
}

/// A shader that counts its vertices.
#[derive(Clone)]
struct Counting<'c>(&'c Cell<usize>);

impl Shader for Counting<'_> {
    type Color = Rgb888;
    type Varyings = [u16; 1];
    type Surface = ();

    fn surface(&self, _: &Material) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 1] {
        self.0.set(self.0.get() + 1);
        [vertex.position()[0] as u16]
    }

    fn pixel(&self, (): &(), [x]: [U16F16; 1]) -> Rgb888 {
        Rgb888::new((x.to_bits() >> 24) as u8, 99, 99)
    }
}

/// Whatever the size of the cache, the picture stays; the larger it is, the fewer vertices are worked out again; and
/// what is out of the picture costs nothing.
#[test]
fn walking_remembers_recent_vertices() {
    fn walked<const N: usize>(mesh: &Mesh<'_>, eye: &str, whole: &Screen<Rgb888>) -> usize {
        let count = Cell::new(0);
        let object = Object::new(mesh, Counting(&count));
        let seen = object.walk(&at(eye, DISPLAY), S8).unwrap().remembering::<N>();
        assert!(&picture::<u16>(ROWS, |frame| seen.draw(frame)) == whole, "{N} vertices");
        count.get()
    }
    let ball = ball();
    let mesh = ball.mesh();
    let count = Cell::new(0);
    for eye in ["3", "0.9", "-30"] {
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; mesh.vertex_count()];
        let seen = Object::new(&mesh, Counting(&count))
            .project(&at(eye, DISPLAY), &mut storage)
            .unwrap();
        let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
        let counts = [
            walked::<0>(&mesh, eye, &whole),
            walked::<1>(&mesh, eye, &whole),
            walked::<7>(&mesh, eye, &whole),
            walked::<16>(&mesh, eye, &whole),
            walked::<1000>(&mesh, eye, &whole),
        ];
        match eye {
            // All corners of all triangles; each vertex once.
            "3" => assert_eq!((counts[0], counts[4]), (3 * mesh.triangle_count(), mesh.vertex_count())),
            "-30" => assert_eq!(counts, [0; 5]),
            _ => (),
        }
        assert!(counts.is_sorted_by(|a, b| a >= b), "{counts:?}");
    }
}
