//! The seams that a program extends: blending, shaders that discard pixels or read depth and place,
//! varyings of several kinds, a varying in pieces, and a primitive besides the triangle. Each is
//! compared with its definition, in every kind of target.

use std::{cell::RefCell, collections::HashMap, convert::Infallible, fmt::Debug};

use embedded_graphics::{
    Pixel,
    geometry::Point,
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::PointsIter,
};
use fixed::types::{I16F16, U16F16};
use rasterizer::{
    attribute::{
        DepthFormat, Interpolate, InverseW, NoDepth, Piece, Plane, QuickGradients, Step,
        TriangleSetup, Varyings,
    },
    camera::{Camera, Distance, Perspective},
    geometry::{CullNone, Pose, ScreenVertex},
    mesh::{Mesh, MeshFace, MeshMaterial, MeshVertex, Tables},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    output::{Blend, Direct, Frame, Readable, Target},
    raster::{Fragment, Gradients, Layout, Primitive, Span, Window},
    scene::Object,
    shade::{Face, OnScreen, Outcome, Sample, Shader, Unlit},
};
use rasterizer_tests::{
    Call, Picture, Recorder, Surface, area,
    bands::{BACKGROUND, DISPLAY, Depth, EYES, MATERIALS, Position, ROWS, at, ball, picture},
};

/// What a shader sees of varyings.
type Sampled<W> = <<W as Varyings>::OnScreen as Interpolate>::Sample;

/// A shader of two functions: from a position to the varyings, from a fragment to the outcome.
#[derive(Clone, Copy)]
struct By<W: Varyings, O> {
    vertex: fn([i16; 3]) -> W,
    pixel: fn(Fragment<Sampled<W>>) -> O,
}

impl<W: Varyings, O: Outcome<Rgb888> + Copy> Shader for By<W, O> {
    type Color = Rgb888;
    type Varyings = W;
    type Surface = ();
    type Face = ();
    type Outcome = O;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> W {
        (self.vertex)(vertex.position())
    }

    fn pixel(&self, (): &(), (): &(), fragment: Fragment<Sampled<W>>) -> O {
        (self.pixel)(fragment)
    }
}

/// A shader that has no varyings.
const fn by_fragment<O>(pixel: fn(Fragment<[U16F16; 0]>) -> O) -> By<[u16; 0], O> {
    By { vertex: |_| [], pixel }
}

/// A depth format, with a frame of [`DISPLAY`] that keeps it.
trait Framed: Depth {
    /// What is drawn over background; depths are 0 where none is kept.
    fn frame(
        draw: impl FnOnce(&mut Frame<'_, Rgb888, Self::Buffer<'_>>) -> Result<(), Infallible>,
    ) -> Picture<Rgb888, u32>;
}

macro_rules! framed {
    ($depth:ty) => {
        impl Framed for $depth {
            fn frame(
                draw: impl FnOnce(&mut Frame<'_, Rgb888, &mut [Self]>) -> Result<(), Infallible>,
            ) -> Picture<Rgb888, u32> {
                let mut whole = Picture::<Rgb888, Self>::empty(DISPLAY, BACKGROUND);
                let mut frame = Frame::new(&mut whole.color, &mut whole.depth, DISPLAY).unwrap();
                let Ok(()) = draw(&mut frame);
                let depth = whole.depth.into_iter().map(Into::into).collect();
                Picture { area: DISPLAY, color: whole.color, depth }
            }
        }
    };
}
framed!(u16);
framed!(u32);

impl Framed for NoDepth {
    fn frame(
        draw: impl FnOnce(&mut Frame<'_, Rgb888, Self>) -> Result<(), Infallible>,
    ) -> Picture<Rgb888, u32> {
        let mut whole = Picture::empty(DISPLAY, BACKGROUND);
        let Ok(()) = draw(&mut Frame::without_depth(&mut whole.color, DISPLAY).unwrap());
        whole
    }
}

/// Whether a pixel of this depth is drawn over a stored one.
const fn is_seen<D>(depth: u32, stored: u32) -> bool {
    size_of::<D>() == 0 || depth > stored
}

/// Bands of some heights have the colours of the whole frame.
fn bands_equal<D: Framed>(
    whole: &Picture<Rgb888, u32>,
    draw: impl Fn(&mut Frame<'_, Rgb888, D::Buffer<'_>>) -> Result<(), Infallible>,
) {
    for rows in [1, 7, 16, ROWS] {
        let screen = picture::<D>(rows, &draw);
        assert!(screen.pixels.into_iter().flatten().eq(whole.color.clone()), "bands of {rows}");
    }
}

/// The pixels that a display received. None was sent twice.
fn received(screen: &Recorder<Rgb888>) -> Vec<Option<Rgb888>> {
    let mut pixels = HashMap::new();
    for call in screen.calls() {
        let sent: Vec<_> = match call {
            Call::Iter(pixels) => {
                pixels.iter().map(|&Pixel(point, color)| (point, color)).collect()
            }
            Call::Contiguous(area, colors) => {
                assert_eq!(area.points().count(), colors.len());
                area.points().zip(colors.iter().copied()).collect()
            }
            &Call::Solid(area, color) => area.points().map(|point| (point, color)).collect(),
            Call::Clear(_) => panic!("a clear display"),
        };
        for (point, color) in sent {
            assert!(DISPLAY.contains(point), "{point}");
            assert_eq!(pixels.insert(point, color), None, "{point} is sent twice");
        }
    }
    DISPLAY.points().map(|point| pixels.get(&point).copied()).collect()
}

/// What a display shows that an object is drawn onto without a buffer.
fn direct<Sh: Shader<Color = Rgb888>>(object: &Object<'_, Sh>, eye: &str) -> Vec<Rgb888> {
    let mut screen = Recorder::new(DISPLAY);
    let seen = object.project_on_demand(&at(eye, DISPLAY), S8).unwrap();
    assert_eq!(seen.draw(&mut Direct::new(&mut screen)), Ok(()));
    for call in screen.calls() {
        assert_eq!(matches!(call, Call::Iter(_)), Sh::Outcome::DISCARDS, "{call:?}");
    }
    received(&screen).into_iter().map(|pixel| pixel.unwrap_or(BACKGROUND)).collect()
}

/// A cube whose pixels are drawn once, because its back faces are not.
fn cube() -> Surface {
    Surface::cube(16_384, 1).scaled(-14)
}

fn turned() -> Pose {
    Pose::rotated(Rotation::about_y(Turn::degrees(30)) * Rotation::about_x(Turn::degrees(20)))
}

fn average(stored: Rgb888, new: Rgb888) -> Rgb888 {
    mixed(stored, new, [1, 1])
}

/// A quarter of the new colour.
fn tint(stored: Rgb888, new: Rgb888) -> Rgb888 {
    mixed(stored, new, [3, 1])
}

fn mixed(stored: Rgb888, new: Rgb888, [a, b]: [u16; 2]) -> Rgb888 {
    let channel = |s: u8, n: u8| ((u16::from(s) * a + u16::from(n) * b) / (a + b)) as u8;
    Rgb888::new(
        channel(stored.r(), new.r()),
        channel(stored.g(), new.g()),
        channel(stored.b(), new.b()),
    )
}

/// A see-through cube that cuts into a ball: where it is nearer its colour is mixed with the
/// ball's, and its depth is stored.
fn blends<D: Framed, Sh: Shader<Color = Rgb888>>(
    shader: &Sh,
    blend: fn(Rgb888, Rgb888) -> Rgb888,
    eye: &str,
) {
    let (ball, cube) = (ball(), cube());
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at(eye, DISPLAY);
    let moved = Pose::IDENTITY.at(Vec3::lit("0.6", "0.3", "0.4"));
    let behind = Object::new(&ball, Position).posed(moved);
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let object = Object::new(&cube, shader.clone()).posed(turned());
    let opaque = object.clone().project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let glass = object.blended(Blend(blend)).project_on_demand::<_, S8, D>(&camera, S8).unwrap();

    let stored = D::frame(|frame| behind.draw(frame));
    let alone = D::frame(|frame| opaque.draw(frame));
    let whole = D::frame(|frame| {
        behind.draw(frame)?;
        glass.draw(frame)
    });
    let [mut over_ball, mut over_background, mut hidden] = [0; 3];
    for (index, point) in DISPLAY.points().enumerate() {
        let (mut color, mut depth) = (stored.color[index], stored.depth[index]);
        if alone.color[index] != BACKGROUND {
            if is_seen::<D>(alone.depth[index], depth) {
                *(if color == BACKGROUND { &mut over_background } else { &mut over_ball }) += 1;
                (color, depth) = (blend(color, alone.color[index]), alone.depth[index]);
            } else {
                hidden += 1;
            }
        }
        assert_eq!((whole.color[index], whole.depth[index]), (color, depth), "{point}");
    }
    let is_tested = size_of::<D>() != 0;
    assert!(over_ball > 100 && over_background > 100, "{over_ball}, {over_background}");
    assert_eq!(hidden > 20, is_tested, "{hidden} are hidden");
    bands_equal::<D>(&whole, |band| {
        behind.draw(band)?;
        glass.draw(band)
    });
}

#[test]
fn blended_pixels_are_those_of_the_definition() {
    fn in_frames<D: Framed>() {
        for eye in ["3", "2.4"] {
            blends::<D, _>(&Position, average, eye);
            blends::<D, _>(&Position, tint, eye);
            // One colour a triangle.
            blends::<D, _>(&Unlit::new(), tint, eye);
        }
    }
    in_frames::<u16>();
    in_frames::<u32>();
    in_frames::<NoDepth>();
}

/// A third of the pixels.
const fn is_hole(column: i32, row: i32) -> bool {
    (column + row).rem_euclid(3) == 0
}

const PAPER: Rgb888 = Rgb888::new(240, 230, 9);

const OPAQUE: By<[u16; 0], Rgb888> = by_fragment(|_| PAPER);
const LATTICE: By<[u16; 0], Option<Rgb888>> =
    by_fragment(|fragment| (!is_hole(fragment.column, fragment.row)).then_some(PAPER));

/// A lattice, and then a ball behind it and through it, which is seen in the holes.
fn discards<D: Framed>(blend: Option<fn(Rgb888, Rgb888) -> Rgb888>, eye: &str) {
    let (ball, cube) = (ball(), cube());
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at(eye, DISPLAY);
    let behind = Object::new(&ball, Position).posed(Pose::IDENTITY.at(Vec3::lit("0.8", "0", "0")));
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let opaque = Object::new(&cube, OPAQUE).posed(turned());
    let opaque = opaque.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let lattice = Object::new(&cube, LATTICE).posed(turned());
    let blended = lattice.blended(Blend(blend.unwrap_or(average)));
    let lattice = lattice.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let blended = blended.project_on_demand::<_, S8, D>(&camera, S8).unwrap();

    let draw_holes = |frame: &mut Frame<'_, Rgb888, D::Buffer<'_>>| match blend {
        Some(_) => blended.draw(frame),
        None => lattice.draw(frame),
    };
    let draw_both = |frame: &mut Frame<'_, Rgb888, D::Buffer<'_>>| {
        draw_holes(frame)?;
        behind.draw(frame)
    };
    let alone = D::frame(|frame| opaque.draw(frame));
    let ball = D::frame(|frame| behind.draw(frame));
    let (holes, both) = (D::frame(draw_holes), D::frame(draw_both));
    let [mut through, mut before] = [0; 2];
    for (index, point) in DISPLAY.points().enumerate() {
        let is_kept = alone.color[index] != BACKGROUND && !is_hole(point.x, point.y);
        let mut want = (BACKGROUND, 0);
        if is_kept {
            let color = blend.map_or(PAPER, |blend| blend(BACKGROUND, PAPER));
            want = (color, alone.depth[index]);
        }
        assert_eq!((holes.color[index], holes.depth[index]), want, "{point}");
        if ball.color[index] != BACKGROUND && is_seen::<D>(ball.depth[index], want.1) {
            if alone.color[index] != BACKGROUND && alone.depth[index] > ball.depth[index] {
                through += 1;
            }
            want = (ball.color[index], ball.depth[index]);
        } else if is_kept {
            before += 1;
        }
        assert_eq!((both.color[index], both.depth[index]), want, "{point}");
    }
    assert!(before > 50, "{before} before the ball");
    assert_eq!(through > 20, size_of::<D>() != 0, "{through} seen through the holes");
    bands_equal::<D>(&holes, draw_holes);
    bands_equal::<D>(&both, draw_both);
}

#[test]
fn discarded_pixels_keep_color_and_depth() {
    fn in_frames<D: Framed>() {
        for eye in ["3", "2.4"] {
            discards::<D>(None, eye);
            discards::<D>(Some(tint), eye);
        }
    }
    in_frames::<u16>();
    in_frames::<u32>();
    in_frames::<NoDepth>();
}

#[test]
fn a_display_gets_no_discarded_pixel() {
    let cube = cube();
    let mesh = cube.mesh();
    for eye in ["3", "2.4"] {
        let object = Object::new(&mesh, LATTICE).posed(turned());
        let seen = object.project_on_demand(&at(eye, DISPLAY), S8).unwrap();
        let whole = NoDepth::frame(|frame| seen.draw(frame));
        assert!(whole.color.iter().filter(|&&color| color == PAPER).count() > 200);
        assert_eq!(direct(&object, eye), whole.color);
    }
}

/// A colour that tells the place of its pixel.
const fn place(column: i32, row: i32) -> Rgb888 {
    Rgb888::new(column as u8, row as u8, 77)
}

/// A fragment's place is the display's, in frames of the display and of its parts, in bands, and
/// straight onto it.
#[test]
fn fragments_know_their_place() {
    let cube = cube();
    let mesh = cube.mesh();
    let shader = by_fragment(|fragment| place(fragment.column, fragment.row));
    let object = Object::new(&mesh, shader).posed(turned());
    let camera = at("2.4", DISPLAY);
    let seen = object.project_on_demand(&camera, S8).unwrap();
    let whole = NoDepth::frame(|frame| seen.draw(frame));
    let mut drawn = 0;
    for (point, &color) in DISPLAY.points().zip(&whole.color) {
        if color != BACKGROUND {
            assert_eq!(color, place(point.x, point.y), "{point}");
            drawn += 1;
        }
    }
    assert!(drawn > 500, "{drawn}");
    assert_eq!(direct(&object, "2.4"), whole.color);
    bands_equal::<NoDepth>(&whole, |band| seen.draw(band));
    for part in [area(20, 3, 17, 30), area(-9, -7, 40, 30), area(40, 20, 50, 50)] {
        let (mut flat, mut deep) = (Picture::<_, u16>::empty(part, BACKGROUND), vec![0u16; 4000]);
        let mut frame = Frame::new(&mut flat.color, &mut flat.depth, part).unwrap();
        object.project_on_demand(&camera, S8).unwrap().draw(&mut frame).unwrap();
        assert_eq!(flat.color, whole.crop(part, BACKGROUND).color, "{part:?}");
        // In a larger buffer.
        let mut color = vec![BACKGROUND; 4000];
        let mut frame = Frame::with_stride(&mut color, &mut deep, part, 53).unwrap();
        object.project_on_demand(&camera, S8).unwrap().draw(&mut frame).unwrap();
        let width = part.size.width as usize;
        let rows = flat.color.chunks(width).zip(color.chunks(53));
        assert!(rows.into_iter().all(|(packed, strided)| *packed == strided[..width]), "{part:?}");
    }
}

/// A dither by depth and place: the nearer, the more pixels of a block of 2 by 2 are light.
fn dithered(fragment: Fragment<[U16F16; 1]>) -> Rgb888 {
    let [light] = fragment.varyings;
    let threshold = [[0, 2], [3, 1]][(fragment.row & 1) as usize][(fragment.column & 1) as usize];
    let is_light = light.to_num::<u32>() / 16_384 > threshold;
    let depth = (fragment.depth.to_bits() >> 24) as u8;
    if is_light { Rgb888::new(255, depth, 255) } else { Rgb888::new(0, depth, 0) }
}

/// A dither has no seam between bands, nor round a rectangle that is drawn anew.
#[test]
fn a_dither_is_seamless() {
    let ball = ball();
    let mesh = ball.mesh();
    let shader = By { vertex: |[x, _, _]| [x as u16 ^ 0x8000], pixel: dithered };
    for eye in EYES {
        let object = Object::new(&mesh, shader).culled(CullNone);
        let seen = object.project_on_demand::<_, S8, u16>(&at(eye, DISPLAY), S8).unwrap();
        let whole = u16::frame(|frame| seen.draw(frame));
        let of = |level| {
            let shown =
                whole.color.iter().filter(|&color| color.b() == level && color.r() == level);
            shown.count()
        };
        assert!(of(255) > 100 && of(0) > 100, "{} light, {} dark from {eye}", of(255), of(0));
        bands_equal::<u16>(&whole, |band| seen.draw(band));
        for dirty in [area(11, 5, 1, 1), area(4, 3, 33, 18), area(20, 9, 31, 7)] {
            let mut part = Picture::<_, u16>::empty(dirty, BACKGROUND);
            let mut frame = Frame::new(&mut part.color, &mut part.depth, dirty).unwrap();
            let Ok(()) = seen.draw(&mut frame);
            assert_eq!(part.color, whole.crop(dirty, BACKGROUND).color, "{dirty:?} from {eye}");
        }
    }
}

/// The upper 24 bits of the depth.
const fn shown_depth(fragment: Fragment<[U16F16; 0]>) -> Rgb888 {
    let [red, green, blue, _] = fragment.depth.to_bits().to_be_bytes();
    Rgb888::new(red, green, blue)
}

/// The depth that a shader reads is the one that is stored.
#[test]
fn a_shader_reads_the_stored_depth() {
    fn shown<D: Framed>(to_bits: fn(u32) -> u32) {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let object = Object::new(&mesh, by_fragment(shown_depth)).culled(CullNone);
            let seen = object.project_on_demand::<_, S8, D>(&at(eye, DISPLAY), S8).unwrap();
            let whole = D::frame(|frame| seen.draw(frame));
            let mut drawn = 0;
            for (&color, &depth) in whole.color.iter().zip(&whole.depth) {
                // A depth may look like the background.
                let is_drawn = if size_of::<D>() == 0 { color != BACKGROUND } else { depth != 0 };
                if !is_drawn {
                    assert_eq!(color, BACKGROUND, "{eye}");
                    continue;
                }
                let [red, green, blue, _] = to_bits(depth).to_be_bytes();
                assert_eq!(color, Rgb888::new(red, green, blue), "{eye}");
                drawn += 1;
            }
            assert!(drawn > 400, "{drawn} from {eye}");
            bands_equal::<D>(&whole, |band| seen.draw(band));
        }
    }
    shown::<u16>(|depth| depth << 16);
    shown::<u32>(|depth| depth);
    shown::<NoDepth>(|depth| depth);
}

/// Pixels of one row: a primitive besides the triangle.
struct HorizontalLine<D: DepthFormat, V: Interpolate> {
    row: i32,
    left: i32,
    /// The column after the last.
    right: i32,
    depth: D::Accumulator,
    varyings: V::Accumulator,
    varyings_step: V::Accumulator,
}

impl<D: DepthFormat, V: Interpolate> Primitive for HorizontalLine<D, V> {
    type Depth = D;
    type Varyings = V;

    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (left, right) = (self.left.max(window.left), self.right.min(window.right));
        if left >= right || !(window.top..window.bottom).contains(&self.row) {
            return Ok(());
        }
        let address = layout.row_address(self.row);
        let to_left = self.varyings_step.wrapping_mul(left - self.left);
        visit(&Span {
            row: self.row,
            start: (address + left) as usize,
            end: (address + right) as usize,
            depth: self.depth,
            depth_step: Step::ZERO,
            varyings: self.varyings.wrapping_add(to_left),
            varyings_step: self.varyings_step,
        })
    }
}

/// Rows and columns of lines inside the display, across its edges and beside it.
const LINES: [[i32; 3]; 8] = [
    [10, 8, 60],
    [20, -100, 300],
    [21, 30, 31],
    [22, 25, 38],
    [30, -40, 20],
    [31, 50, 900],
    [-3, 0, 60],
    [45, 0, 60],
];

/// The value of the varying at the first pixel and its change, in Q16.
const RAMP: [u32; 2] = [0x1000_0000, 0x0031_0000];

const fn line<D: DepthFormat>(
    [row, left, right]: [i32; 3],
    depth: D::Accumulator,
) -> HorizontalLine<D, u16> {
    let [varyings, varyings_step] = RAMP;
    HorizontalLine { row, left, right, depth, varyings, varyings_step }
}

/// A colour of a line's pixel.
const fn ramp(value: u32) -> Rgb888 {
    Rgb888::new((value >> 24) as u8, (value >> 16) as u8, 200)
}

const INK: Rgb888 = Rgb888::new(0, 9, 255);

/// Draws the lines in three ways, beside each other: filled, shaded, blended.
fn draw_lines<T: Readable<Color = Rgb888, Error = Infallible>>(
    target: &mut T,
    depth: <T::Depth as Interpolate>::Accumulator,
    way: usize,
) {
    let window = target.window();
    for at in LINES {
        let line = line::<T::Depth>(at, depth);
        let Ok(()) = match way {
            0 => target.fill(&line, &window, INK),
            1 => target.shade(&line, &window, |fragment| ramp(fragment.varyings.to_bits())),
            _ => target.blend(&line, &window, |stored, fragment| {
                tint(stored, ramp(fragment.varyings.to_bits()))
            }),
        };
    }
}

/// What a line's pixel becomes.
fn line_pixel([_, left, _]: [i32; 3], column: i32, stored: Rgb888, way: usize) -> Rgb888 {
    let color = ramp(RAMP[0].wrapping_add(RAMP[1].wrapping_mul((column - left) as u32)));
    [INK, color, tint(stored, color)][way]
}

#[test]
fn another_primitive_is_drawn_into_every_target() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position);
    let camera = at("2.4", DISPLAY);
    let tested = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
    let untested = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let stored = u16::frame(|frame| tested.draw(frame));
    // Half way between the ball's nearest and farthest pixels.
    let drawn: Vec<_> = stored.depth.iter().copied().filter(|&depth| depth != 0).collect();
    let depth = (drawn.iter().min().unwrap() + drawn.iter().max().unwrap()) / 2;
    for way in 0..3 {
        let mut with_depth = stored.clone();
        let mut without_depth = NoDepth::frame(|frame| untested.draw(frame)).color;
        let [mut nearer, mut hidden] = [0; 2];
        for at in LINES {
            let [row, left, right] = at;
            for column in left..right {
                if !DISPLAY.contains(Point::new(column, row)) {
                    continue;
                }
                let corner = DISPLAY.top_left;
                let index = ((row - corner.y) * 61 + column - corner.x) as usize;
                let [color, bare] = [&mut with_depth.color[index], &mut without_depth[index]];
                *bare = line_pixel(at, column, *bare, way);
                if depth > with_depth.depth[index] {
                    *color = line_pixel(at, column, *color, way);
                    with_depth.depth[index] = depth;
                    nearer += 1;
                } else {
                    hidden += 1;
                }
            }
        }
        assert!(nearer > 60 && hidden > 20, "{nearer} nearer, {hidden} hidden");
        let got = u16::frame(|frame| {
            tested.draw(frame)?;
            draw_lines(frame, (depth << 16) + 0x8000, way);
            Ok(())
        });
        assert!(got == with_depth, "with depth, way {way}");
        let got = NoDepth::frame(|frame| {
            untested.draw(frame)?;
            draw_lines(frame, (), way);
            Ok(())
        });
        assert!(got.color == without_depth, "without depth, way {way}");
        bands_equal::<NoDepth>(&got, |band| {
            untested.draw(band)?;
            draw_lines(band, (), way);
            Ok(())
        });
    }
    for way in 0..2 {
        let mut screen = Recorder::new(DISPLAY);
        let mut target = Direct::new(&mut screen);
        let window = target.window();
        for at in LINES {
            let line = line::<NoDepth>(at, ());
            let drawn = match way {
                0 => target.fill(&line, &window, INK),
                _ => target.shade(&line, &window, |fragment| ramp(fragment.varyings.to_bits())),
            };
            assert_eq!(drawn, Ok(()));
        }
        for (point, pixel) in DISPLAY.points().zip(received(&screen)) {
            let at = LINES
                .into_iter()
                .find(|&[row, left, right]| row == point.y && (left..right).contains(&point.x));
            assert_eq!(pixel, at.map(|at| line_pixel(at, point.x, INK, way)), "{point}");
        }
    }
}

/// Fragments of pixels, with the places of their triangles in the mesh's table.
type Logged<W> = Vec<(usize, Fragment<Sampled<W>>)>;

/// A shader that notes what its pixels see.
#[derive(Clone)]
struct Noting<'l, W: Varyings> {
    vertex: fn([i16; 3]) -> W,
    log: &'l RefCell<Logged<W>>,
}

impl<W: Varyings> Shader for Noting<'_, W> {
    type Color = Rgb888;
    type Varyings = W;
    type Surface = ();
    type Face = usize;
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> W {
        (self.vertex)(vertex.position())
    }

    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        _: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Rgb888, usize> {
        Face::Shaded(face.index())
    }

    fn pixel(&self, (): &(), &triangle: &usize, fragment: Fragment<Sample<Self>>) -> Rgb888 {
        self.log.borrow_mut().push((triangle, fragment));
        BACKGROUND
    }
}

/// A triangle on the screen: its place in the mesh's table, its corners in pixels, and what they
/// carry.
type OnTheScreen<V> = (usize, [[f64; 2]; 3], [V; 3]);

/// What all pixels of both sides of a mesh see, and its triangles.
fn noted<S: Subpixel, W: Varyings>(
    mesh: &Mesh<'_>,
    vertex: fn([i16; 3]) -> W,
    camera: &Camera<Perspective>,
) -> (Logged<W>, Vec<OnTheScreen<W::OnScreen>>) {
    let log = RefCell::new(vec![]);
    let object = Object::new(mesh, Noting { vertex, log: &log }).culled(CullNone);
    let seen = object.project_on_demand::<_, S, NoDepth>(camera, S::default()).unwrap();
    let mut triangles = vec![];
    let Ok(()) = seen.for_each_triangle(|index, corners| {
        let places = corners.map(|corner| {
            corner.position().unwrap().map(|c| f64::from(c) / f64::from(1 << S::BITS))
        });
        triangles.push((index, places, corners.map(ScreenVertex::varyings)));
        Ok::<(), Infallible>(())
    });
    NoDepth::frame(|frame| seen.draw(frame));
    (log.into_inner(), triangles)
}

/// The barycentric coordinates of a pixel's centre.
fn weights([a, b, c]: [[f64; 2]; 3], column: i32, row: i32) -> [f64; 3] {
    let p = [f64::from(column) + 0.5, f64::from(row) + 0.5];
    let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
    };
    [area(p, b, c), area(a, p, c), area(a, b, p)].map(|part| part / area(a, b, c))
}

/// Each number that a pixel sees lies on the plane through the numbers at the triangle's corners:
/// within the bound of its width, given in units.
fn is_on_the_plane<S: Subpixel, W: Varyings, const N: usize>(
    vertex: fn([i16; 3]) -> W,
    corner: fn(W::OnScreen) -> [f64; N],
    sample: fn(Sampled<W>) -> [f64; N],
    bounds: [f64; N],
) {
    let ball = ball();
    let mesh = ball.mesh();
    let (mut lowest, mut highest) = ([f64::MAX; N], [f64::MIN; N]);
    for eye in EYES {
        let (log, triangles) = noted::<S, W>(&mesh, vertex, &at(eye, DISPLAY));
        assert!(log.len() > 400, "{} pixels from {eye}", log.len());
        for (index, fragment) in log {
            // A triangle that is cut leaves several.
            let (places, corners) = triangles
                .iter()
                .filter(|triangle| triangle.0 == index)
                .map(|&(_, places, corners)| (places, corners.map(corner)))
                .find(|&(places, _)| {
                    weights(places, fragment.column, fragment.row).iter().all(|&w| w > -1e-9)
                })
                .unwrap();
            let weights = weights(places, fragment.column, fragment.row);
            let got = sample(fragment.varyings);
            for i in 0..N {
                let exact: f64 = (0..3).map(|k| weights[k] * corners[k][i]).sum();
                assert!(
                    (got[i] - exact).abs() < bounds[i],
                    "number {i} from {eye}: {} instead of {exact} at {:?}",
                    got[i],
                    (fragment.column, fragment.row)
                );
                lowest[i] = lowest[i].min(got[i]);
                highest[i] = highest[i].max(got[i]);
            }
        }
    }
    // The ball's positions are within 16,384 of the origin: each number has a good part of its
    // range.
    for i in 0..N {
        assert!(highest[i] - lowest[i] > 7000.0, "{} to {}", lowest[i], highest[i]);
    }
}

/// The value, half a unit below what a shader sees.
fn signed(value: I16F16) -> f64 {
    value.to_num::<f64>() - 0.5
}

fn unsigned(value: U16F16) -> f64 {
    value.to_num::<f64>() - 0.5
}

/// Of 16 bits, by the bound for 4,096 pixels. (Of 32 bits half a unit of rounding is added to n /
/// 2^18.)
const NARROW: f64 = 0.36;
const WIDE: f64 = 0.52;

#[test]
fn varyings_of_several_kinds_are_exact_planes() {
    fn in_precision<S: Subpixel>() {
        is_on_the_plane::<S, ([u16; 1], i16), 2>(
            |[x, y, _]| ([x as u16 ^ 0x8000], y.saturating_mul(2)),
            |([a], b)| [f64::from(a), f64::from(b)],
            |([a], b)| [unsigned(a), signed(b)],
            [NARROW; 2],
        );
        // Negative everywhere, of both signs, and of the whole width.
        is_on_the_plane::<S, ([i16; 2], u32), 3>(
            |[x, y, z]| ([x / 2 - 24_000, y], (z.saturating_mul(2) as u32 ^ 0x8000) << 16),
            |([a, b], c)| [f64::from(a), f64::from(b), f64::from(c)],
            |([a, b], c)| [signed(a), signed(b), f64::from(c)],
            [NARROW, NARROW, WIDE],
        );
        is_on_the_plane::<S, (i16, ([u32; 1], (u16, [i16; 1]))), 4>(
            |[x, y, z]| {
                (-x, ([u32::from(x as u16) ^ 0x8000], (y as u16 ^ 0x8000, [z / 2 - 24_000])))
            },
            |(a, ([b], (c, [d])))| [f64::from(a), f64::from(b), f64::from(c), f64::from(d)],
            |(a, ([b], (c, [d])))| [signed(a), f64::from(b), unsigned(c), signed(d)],
            [NARROW, WIDE, NARROW, NARROW],
        );
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A floor that runs from before the camera to behind it. Where the near plane cuts it, the
/// varyings are those of the cut: the distance, which the depth tells too.
#[test]
fn the_near_plane_cuts_signed_varyings() {
    let floor = Surface::new(
        vec![[-900, -150, 8000], [900, -150, 8000], [900, -150, -8000], [-900, -150, -8000]],
        vec![[0, 1, 2], [0, 2, 3]],
    )
    .scaled(-8);
    let near = 0.25;
    let lens = Perspective::new(Turn::degrees(70), Distance::from_num(near), Distance::lit("100"))
        .unwrap();
    let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, DISPLAY).unwrap();
    let mesh = floor.mesh();
    type Numbers = (i16, ([i16; 1], u32));
    let shader = By::<Numbers, Rgb888> {
        vertex: |[_, _, z]| (z, ([z - 20_000], (i32::from(z) + 100_000) as u32)),
        pixel: |_| BACKGROUND,
    };
    let object = Object::new(&mesh, shader);
    let seen = object.project_on_demand::<_, S8, u32>(&camera, S8).unwrap();
    let mut cut = 0;
    let Ok(()) = seen.for_each_triangle(|_, corners| {
        for corner in corners {
            let distance = near * 2f64.powi(32) / f64::from(corner.depth());
            // In quanta; the depth is within 2^-27, of 1 at the near plane.
            let z = -distance * 256.0;
            let (a, ([b], c)) = corner.varyings();
            for got in [f64::from(a), f64::from(b) + 20_000.0, f64::from(c) - 100_000.0] {
                assert!((got - z).abs() < 1.0, "{got} instead of {z}");
            }
            cut += u32::from(distance < 1.01 * near);
        }
        Ok::<(), Infallible>(())
    });
    assert!(cut >= 3, "{cut} corners lie on the near plane");
}

/// Tuples are pictures of the same pixels as arrays.
#[test]
fn tuples_equal_arrays_of_the_same_numbers() {
    fn equal<W: Varyings>(tuple: fn([i16; 3]) -> W, as_array: fn(Sampled<W>) -> [U16F16; 3]) {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let camera = at(eye, DISPLAY);
            let array = |p: [i16; 3]| p.map(|c| c as u16 ^ 0x8000);
            let (want, _) = noted::<S8, [u16; 3]>(&mesh, array, &camera);
            let (got, _) = noted::<S8, W>(&mesh, tuple, &camera);
            assert!(want.len() > 400, "{eye}");
            assert_eq!(got.len(), want.len(), "{eye}");
            for ((index, got), (wanted, want)) in got.into_iter().zip(want) {
                let place = (got.column, got.row);
                assert_eq!((index, place), (wanted, (want.column, want.row)), "{eye}");
                assert_eq!(as_array(got.varyings), want.varyings, "{eye}: {place:?}");
            }
        }
    }
    fn offset([x, y, z]: [i16; 3]) -> [u16; 3] {
        [x, y, z].map(|c| c as u16 ^ 0x8000)
    }
    equal::<([u16; 2], u16)>(
        |p| {
            let [x, y, z] = offset(p);
            ([x, y], z)
        },
        |([x, y], z)| [x, y, z],
    );
    equal::<(u16, (u16, u16))>(
        |p| {
            let [x, y, z] = offset(p);
            (x, (y, z))
        },
        |(x, (y, z))| [x, y, z],
    );
    // Signed numbers are the same ones, 2^15 less.
    equal::<([i16; 1], [i16; 2])>(
        |[x, y, z]| ([x], [y, z]),
        |([x], [y, z])| [x, y, z].map(|c| U16F16::from_bits(c.to_bits() as u32 ^ 0x8000_0000)),
    );
}

/// A shader whose triangles have colours by their slope and size, and whose pixels follow the
/// triangle's plane.
#[derive(Clone, Copy)]
struct Slopes {
    /// Whether a triangle has one colour.
    is_flat: bool,
}

impl Shader for Slopes {
    type Color = Rgb888;
    type Varyings = ([u16; 1], i16);
    type Surface = ();
    type Face = Option<Plane<([u32; 1], u32)>>;
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> ([u16; 1], i16) {
        let [x, y, _] = vertex.position();
        ([x as u16 ^ 0x8000], y)
    }

    fn face(
        &self,
        (): &(),
        _: &MeshFace<'_>,
        gradients: &Gradients<'_, OnScreen<Self>>,
    ) -> Face<Rgb888, Self::Face> {
        let plane = gradients.plane();
        if !self.is_flat {
            return Face::Shaded(Some(plane));
        }
        let ([x], y) = plane.per_column;
        let size = gradients.doubled_area() >> (2 * gradients.subpixel_bits());
        Face::Solid(Rgb888::new((x >> 18) as u8, (y >> 18) as u8, size as u8))
    }

    fn pixel(
        &self,
        (): &(),
        plane: &Self::Face,
        fragment: Fragment<([U16F16; 1], I16F16)>,
    ) -> Rgb888 {
        let ([x], y) = plane.unwrap().at(fragment.column, fragment.row);
        let seen = (([U16F16::from_bits(x)]), I16F16::from_bits((y ^ 1 << 31) as i32));
        assert_eq!(fragment.varyings, seen);
        Rgb888::new((x >> 24) as u8, (y >> 24) as u8, 9)
    }
}

/// A face knows the plane that its pixels follow, the same in bands and in the whole frame, and
/// from vertices in both precisions.
#[test]
fn faces_know_their_gradients() {
    fn in_precision<S: Subpixel>() {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let camera = at(eye, DISPLAY);
            for is_flat in [true, false] {
                let object = Object::new(&mesh, Slopes { is_flat }).culled(CullNone);
                let seen = object.project_on_demand::<_, S, u16>(&camera, S::default()).unwrap();
                let whole = u16::frame(|frame| seen.draw(frame));
                bands_equal::<u16>(&whole, |band| seen.draw(band));
                let mut colors: Vec<_> =
                    whole.color.iter().map(|color| [color.r(), color.g(), color.b()]).collect();
                colors.sort_unstable();
                colors.dedup();
                assert!(colors.len() > 10, "{} colours from {eye}", colors.len());
            }
        }
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A triangle's place in the mesh's table, the varying at its corners, the doubled area in square
/// pixels, and the varying's change a column.
type Measured = (usize, [u16; 3], f64, f64);

/// A shader that notes what a face can know.
#[derive(Clone)]
struct Measuring<'l>(&'l RefCell<Vec<Measured>>);

impl Shader for Measuring<'_> {
    type Color = Rgb888;
    type Varyings = u16;
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> u16 {
        vertex.position()[0] as u16 ^ 0x8000
    }

    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        gradients: &Gradients<'_, u16>,
    ) -> Face<Rgb888, ()> {
        let unit = 2f64.powi(2 * gradients.subpixel_bits() as i32);
        let area = gradients.doubled_area() as f64 / unit;
        let slope = f64::from(gradients.plane().per_column as i32) / 65_536.0;
        self.0.borrow_mut().push((face.index(), gradients.corners(), area, slope));
        Face::Solid(BACKGROUND)
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<U16F16>) -> Rgb888 {
        unreachable!("the face has a colour")
    }
}

/// The gradients of a face are those of its corners. Here no triangle is cut.
#[test]
fn gradients_are_those_of_the_corners() {
    fn in_precision<S: Subpixel>() {
        let (ball, log) = (ball(), RefCell::new(vec![]));
        let mesh = ball.mesh();
        let object = Object::new(&mesh, Measuring(&log)).culled(CullNone);
        let seen = object.project_on_demand::<_, S, NoDepth>(&at("3", DISPLAY), S::default());
        let seen = seen.unwrap();
        NoDepth::frame(|frame| seen.draw(frame));
        let log = log.take();
        let mut found = 0;
        let Ok(()) = seen.for_each_triangle(|index, corners| {
            let Some(&(_, values, area, slope)) = log.iter().find(|entry| entry.0 == index) else {
                return Ok(());
            };
            assert_eq!(values, corners.map(ScreenVertex::varyings));
            let [a, b, c] = corners.map(|corner| {
                corner.position().unwrap().map(|c| f64::from(c) / f64::from(1 << S::BITS))
            });
            let exact = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
            assert_eq!(area, exact);
            // Slopes of thin triangles are cut to 32 bits.
            if area.abs() > 1.0 {
                let [va, vb, vc] = values.map(f64::from);
                let exact = ((vb - va) * (c[1] - a[1]) - (vc - va) * (b[1] - a[1])) / area;
                assert!((slope - exact).abs() < 0.01, "{slope} instead of {exact}");
                found += 1;
            }
            Ok::<(), Infallible>(())
        });
        assert!(found > 200, "{found}");
    }
    in_precision::<S4>();
    in_precision::<S8>();
}

/// A shader that notes which materials it gets, and for which triangles.
#[derive(Clone)]
struct Materials<'l>(&'l RefCell<Vec<(usize, Rgb888, usize)>>);

impl Shader for Materials<'_> {
    type Color = Rgb888;
    type Varyings = [u16; 0];
    type Surface = (usize, Rgb888);
    type Face = ();
    type Outcome = Rgb888;

    fn surface(&self, material: &MeshMaterial<'_>) -> (usize, Rgb888) {
        (material.index(), material.rgb())
    }

    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    fn face(
        &self,
        &(material, color): &(usize, Rgb888),
        face: &MeshFace<'_>,
        _: &Gradients<'_, [u16; 0]>,
    ) -> Face<Rgb888, ()> {
        self.0.borrow_mut().push((material, color, face.index()));
        Face::Solid(color)
    }

    fn pixel(&self, _: &(usize, Rgb888), (): &(), _: Fragment<[U16F16; 0]>) -> Rgb888 {
        unreachable!("the face has a colour")
    }
}

/// A triangle gets the material whose run it is in, also behind an empty run.
#[test]
fn materials_are_those_of_their_runs() {
    let (ball, log) = (ball(), RefCell::new(vec![]));
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let object = Object::new(&mesh, Materials(&log)).culled(CullNone);
    let seen = object.project_on_demand::<_, S8, u16>(&at("3", DISPLAY), S8).unwrap();
    u16::frame(|frame| seen.draw(frame));
    let log = log.take();
    assert!(log.len() > 500, "{} triangles", log.len());
    let mut first = 0;
    for (index, material) in MATERIALS.iter().enumerate() {
        let run = first..first + material.triangle_count as usize;
        let [red, green, blue] = material.color;
        let want = (index, Rgb888::new(red, green, blue));
        let of_run: Vec<_> = log.iter().filter(|entry| run.contains(&entry.2)).collect();
        assert_eq!(of_run.is_empty(), material.triangle_count == 0);
        assert!(of_run.iter().all(|entry| (entry.0, entry.1) == want), "{of_run:?}");
        first = run.end;
    }
}

/// A `u16` whose spans come in pieces of five pixels. With `HOLDS` a piece keeps the value of its
/// first pixel, otherwise it is stepped as a `u16` is.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stepped<const HOLDS: bool>(u16);

/// The pixels of a piece.
const PIECE: usize = 5;

impl<const HOLDS: bool> Varyings for Stepped<HOLDS> {
    type OnScreen = Self;

    fn lerp(self, other: Self, t: u32) -> Self {
        Self(self.0.lerp(other.0, t))
    }

    fn on_screen(self, _: InverseW) -> Self {
        self
    }
}

/// The pieces after a span's first one.
struct Pieces<const HOLDS: bool> {
    first: u32,
    step: u32,
    pixels: usize,
}

impl<const HOLDS: bool> Iterator for Pieces<HOLDS> {
    type Item = Piece<u32>;

    fn next(&mut self) -> Option<Piece<u32>> {
        let pixels = self.pixels.min(PIECE);
        let piece = Piece { first: self.first, step: if HOLDS { 0 } else { self.step }, pixels };
        self.pixels -= pixels;
        self.first = self.first.wrapping_add(self.step.wrapping_mul(pixels as u32));
        (pixels > 0).then_some(piece)
    }
}

impl<const HOLDS: bool> Interpolate for Stepped<HOLDS> {
    const ZERO: Self = Self(0);

    type Accumulator = u32;
    type Walk = u32;
    type Rest = Pieces<HOLDS>;
    type Sample = U16F16;

    fn plane<S: Subpixel>(
        setup: &TriangleSetup<S>,
        quick: Option<QuickGradients>,
        corners: [Self; 3],
    ) -> Plane<u32> {
        u16::plane(setup, quick, corners.map(|corner| corner.0))
    }

    fn walk(first: u32, step: u32, pixels: usize) -> (Piece<u32>, Pieces<HOLDS>) {
        let mut pieces = Pieces { first, step, pixels };
        (pieces.next().unwrap(), pieces)
    }

    fn sample(value: u32) -> U16F16 {
        u16::sample(value)
    }
}

/// What pixels see of a varying in pieces, beside a plain one before and after it.
#[test]
fn a_varying_in_pieces_is_defined_by_them() {
    fn number([x, _, _]: [i16; 3]) -> u16 {
        x as u16 ^ 0x8000
    }
    fn other([_, y, _]: [i16; 3]) -> u16 {
        y as u16 ^ 0x8000
    }
    type Tuple = (Stepped<true>, (u16, Stepped<false>));
    let ball = ball();
    let mesh = ball.mesh();
    let mut long = 0;
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let (plain, _) = noted::<S8, [u16; 2]>(&mesh, |p| [number(p), other(p)], &camera);
        let (stepped, _) = noted::<S8, Stepped<false>>(&mesh, |p| Stepped(number(p)), &camera);
        let (held, _) = noted::<S8, Stepped<true>>(&mesh, |p| Stepped(number(p)), &camera);
        let (tuple, _) = noted::<S8, Tuple>(
            &mesh,
            |p| (Stepped(number(p)), (other(p), Stepped(other(p)))),
            &camera,
        );
        let lengths = [stepped.len(), held.len(), tuple.len()];
        assert!(plain.len() > 400 && lengths == [plain.len(); 3], "{lengths:?} from {eye}");
        // The first pixel of the piece at hand, and that of the span.
        let (mut piece, mut start) = (0, 0);
        for (index, (triangle, fragment)) in plain.iter().enumerate() {
            let place = (triangle, fragment.column, fragment.row);
            let is_next = index.checked_sub(1).is_some_and(|before| {
                let (same, before) = &plain[before];
                (same, before.column + 1, before.row) == place
            });
            if !is_next {
                (piece, start) = (index, index);
            } else if (index - start) % PIECE == 0 {
                piece = index;
                long += 1;
            }
            let [number, other] = fragment.varyings;
            let [first, _] = plain[piece].1.varyings;
            let of = |triangle, column, row| (triangle, column, row);
            let (triangle, fragment) = &stepped[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, number, "{eye}: {place:?}");
            let (triangle, fragment) = &held[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, first, "{eye}: {place:?}");
            let (triangle, fragment) = &tuple[index];
            assert_eq!(of(triangle, fragment.column, fragment.row), place, "{eye}");
            assert_eq!(fragment.varyings, (first, (other, other)), "{eye}: {place:?}");
        }
    }
    assert!(long > 100, "{long} pieces after the first");
}

/// All 16 bits of a number.
fn shown(value: U16F16) -> Rgb888 {
    let [high, low] = value.to_num::<u16>().to_be_bytes();
    Rgb888::new(high, low, 9)
}

/// A varying in pieces gives one picture in all targets: that of a plain number if it is stepped
/// like one.
#[test]
fn targets_agree_on_a_varying_in_pieces() {
    fn number([x, y, _]: [i16; 3]) -> u16 {
        (x / 2 + y / 3) as u16 ^ 0x8000
    }
    let cube = cube();
    let mesh = cube.mesh();
    let plain = By::<u16, Rgb888> { vertex: number, pixel: |seen| shown(seen.varyings) };
    let stepped = By::<Stepped<false>, Rgb888> {
        vertex: |position| Stepped(number(position)),
        pixel: |seen| shown(seen.varyings),
    };
    let held = By::<(u16, Stepped<true>), Rgb888> {
        vertex: |position| (7, Stepped(number(position))),
        pixel: |seen| shown(seen.varyings.1),
    };
    for eye in ["3", "2.4"] {
        let camera = at(eye, DISPLAY);
        let object = Object::new(&mesh, plain).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let want = u16::frame(|frame| seen.draw(frame));

        let object = Object::new(&mesh, stepped).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        assert!(u16::frame(|frame| seen.draw(frame)) == want, "{eye}");
        bands_equal::<u16>(&want, |band| seen.draw(band));
        let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        assert!(NoDepth::frame(|frame| seen.draw(frame)).color == want.color, "{eye}");
        bands_equal::<NoDepth>(&want, |band| seen.draw(band));
        assert!(direct(&object, eye) == want.color, "{eye}");

        let object = Object::new(&mesh, held).posed(turned());
        let seen = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
        let in_steps = u16::frame(|frame| seen.draw(frame));
        assert!(in_steps.depth == want.depth && in_steps.color != want.color, "{eye}");
        bands_equal::<u16>(&in_steps, |band| seen.draw(band));
        let seen = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
        assert!(NoDepth::frame(|frame| seen.draw(frame)).color == in_steps.color, "{eye}");
        assert!(direct(&object, eye) == in_steps.color, "{eye}");
    }
}
