//! The seams that a program extends: blending, shaders that discard pixels or read depth and place,
//! varyings of several kinds, a varying in pieces, and a primitive besides the triangle. Each is
//! compared with its definition, in every kind of target. This file holds what these tests share.

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
        DepthFormat, FloatDepth, Interpolate, InverseW, NoDepth, Piece, Plane, QuickGradients,
        Step, TriangleSetup, Varyings,
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

mod blending;
mod discarding;
mod faces;
mod line;
mod modes;
mod pieces;
mod place;
mod varyings;

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
framed!(FloatDepth);
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
