//! What the parts of drawing a frame cost, in cycles of [the counter](crate::counter).

use core::{
    convert::Infallible,
    fmt::{self, Debug, Display},
    marker::PhantomData,
};

use embedded_graphics_core::{geometry::Size, pixelcolor::BinaryColor, primitives::Rectangle};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Perspective},
    color::Rgb332,
    geometry::ScreenVertex,
    numbers::Subpixel,
    output::{
        BandAreas, Blending, Frame, FrameDepth, InPages, PackedColor, PackedFrame, Rgb565Be, Target,
    },
    scene::{Mode, Modes, Object, Order, Painter, Projected, Vertices},
    shade::{OnScreen, Shader},
};

use crate::{
    counter::{self, Moment, Stage},
    memory::Memory,
    nothing::Nothing,
};

/// An object whose vertices are in storage.
type Seen<'a, S, D, Sh, M> =
    Projected<'a, &'a [ScreenVertex<S, D, OnScreen<Sh>>], Perspective, Sh, M>;

macro_rules! declare {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// Totals over all frames: the full cost, or (`SET_UP`) everything but the pixel loop.
        ///
        /// Each needs its own program: where both are measured in one, the compiler inlines
        /// less of what they share, and drawing takes up to 7 % longer.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Cost<const SET_UP: bool> {
            $($(#[$doc])* $field: u64,)*
            last: Option<Rectangle>,
            background: Rgb565Be,
        }

        /// The fields of a JSON object.
        impl<const SET_UP: bool> Display for Cost<SET_UP> {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut separator = "";
                for (name, sum) in [$((stringify!($field), self.$field)),*] {
                    write!(f, r#"{separator}"{name}":{sum}"#)?;
                    separator = ",";
                }
                Ok(())
            }
        }
    };
}
cost_fields!(declare);

/// Whether a scene tests depth, by the format of its depth: 16 bits, or [`NoDepth`].
pub trait Depth: FrameDepth {
    /// A frame in memory of just the area's size.
    fn frame<'a>(
        color: &'a mut [Rgb565Be],
        depth: &'a mut [u16],
        area: Rectangle,
    ) -> Frame<'a, Rgb565Be, Self::Buffer<'a>>;
}

impl Depth for u16 {
    fn frame<'a>(
        color: &'a mut [Rgb565Be],
        depth: &'a mut [Self],
        area: Rectangle,
    ) -> Frame<'a, Rgb565Be, &'a mut [Self]> {
        Frame::new(color, depth, area).unwrap_or_else(fail)
    }
}

impl Depth for FloatDepth {
    fn frame<'a>(
        color: &'a mut [Rgb565Be],
        depth: &'a mut [u16],
        area: Rectangle,
    ) -> Frame<'a, Rgb565Be, &'a mut [Self]> {
        Frame::new(color, bytemuck::must_cast_slice_mut(depth), area).unwrap_or_else(fail)
    }
}

impl Depth for NoDepth {
    fn frame<'a>(
        color: &'a mut [Rgb565Be],
        _: &'a mut [u16],
        area: Rectangle,
    ) -> Frame<'a, Rgb565Be, Self> {
        Frame::without_depth(color, area).unwrap_or_else(fail)
    }
}

/// A frame of a colour other than [`Rgb565Be`], with depth, in the memory of a scene.
pub trait InMemory {
    /// The colour of its pixels.
    type Color: Copy;
    /// The frame.
    type Frame<'m>: Target<Color = Self::Color, Depth = u16, Error = Infallible>;

    /// A frame in memory that is large enough.
    fn frame<'m>(
        color: &'m mut [Rgb565Be],
        depth: &'m mut [u16],
        area: Rectangle,
    ) -> Self::Frame<'m>;

    /// Clears its depth.
    fn clear_depth(frame: &mut Self::Frame<'_>);
}

/// A byte a pixel.
#[derive(Clone, Copy, Debug)]
pub struct OfBytes;

impl InMemory for OfBytes {
    type Color = Rgb332;
    type Frame<'m> = Frame<'m, Rgb332, &'m mut [u16]>;

    fn frame<'m>(
        color: &'m mut [Rgb565Be],
        depth: &'m mut [u16],
        area: Rectangle,
    ) -> Self::Frame<'m> {
        let pixels = depth.len();
        let colors = &mut bytemuck::must_cast_slice_mut(color)[..pixels];
        Frame::new(colors, depth, area).unwrap_or_else(fail)
    }

    fn clear_depth(frame: &mut Self::Frame<'_>) {
        frame.clear_depth();
    }
}

/// Pixels of one, two or four bits, side by side.
#[derive(Clone, Copy, Debug)]
pub struct OfRows<C>(PhantomData<C>);

impl<C: PackedColor + 'static> InMemory for OfRows<C> {
    type Color = C;
    type Frame<'m> = PackedFrame<'m, C, &'m mut [u16]>;

    fn frame<'m>(
        color: &'m mut [Rgb565Be],
        depth: &'m mut [u16],
        area: Rectangle,
    ) -> Self::Frame<'m> {
        let needed = PackedFrame::<C>::bytes(area.size);
        let bytes = &mut bytemuck::must_cast_slice_mut(color)[..needed];
        PackedFrame::new(bytes, depth, area).unwrap_or_else(fail)
    }

    fn clear_depth(frame: &mut Self::Frame<'_>) {
        frame.clear_depth();
    }
}

/// Pixels of one bit, one above the other.
#[derive(Clone, Copy, Debug)]
pub struct OfPages;

impl InMemory for OfPages {
    type Color = BinaryColor;
    type Frame<'m> = PackedFrame<'m, BinaryColor, &'m mut [u16], InPages>;

    fn frame<'m>(
        color: &'m mut [Rgb565Be],
        depth: &'m mut [u16],
        area: Rectangle,
    ) -> Self::Frame<'m> {
        let needed = PackedFrame::<BinaryColor, NoDepth, InPages>::bytes(area.size);
        let bytes = &mut bytemuck::must_cast_slice_mut(color)[..needed];
        PackedFrame::in_pages(bytes, depth, area).unwrap_or_else(fail)
    }

    fn clear_depth(frame: &mut Self::Frame<'_>) {
        frame.clear_depth();
    }
}

/// A blending for the targets of the scenes with depth `D`.
pub trait OnTargets<D: Depth>:
    Blending<Nothing<D>> + for<'f, 'd> Blending<Frame<'f, Rgb565Be, D::Buffer<'d>>>
{
}

impl<D: Depth, B> OnTargets<D> for B where
    B: Blending<Nothing<D>> + for<'f, 'd> Blending<Frame<'f, Rgb565Be, D::Buffer<'d>>>
{
}

impl<const SET_UP: bool> Cost<SET_UP> {
    /// Adds a frame that fills the display and is drawn by one call, as a whole.
    pub fn add_whole<T>(&mut self, size: Size, work: impl FnOnce() -> T) -> T {
        self.frames += 1;
        let pixels = u64::from(size.width) * u64::from(size.height);
        self.pixels_drawn += pixels;
        self.pixels_changed += pixels;
        timed(Stage::Draw, &mut self.draw, work)
    }

    /// Adds a whole frame of a colour other than [`Rgb565Be`].
    pub fn add_frame<
        F: InMemory,
        S: Subpixel,
        Sh: Shader<Color = F::Color>,
        const PIXELS: usize,
    >(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, u16, OnScreen<Sh>>],
        memory: &mut Memory<PIXELS>,
    ) {
        let seen = self.projected(object, camera, vertices);
        let area = camera.viewport();
        let pixels = (area.size.width * area.size.height) as usize;
        let mut frame = F::frame(&mut memory.color, &mut memory.depth[..pixels], area);
        timed(Stage::Clear, &mut self.clear, || F::clear_depth(&mut frame));
        let Ok(()) = timed(Stage::Draw, &mut self.draw, || seen.draw(&mut frame));
        drop(frame);
        self.pixels_drawn += memory.depth.iter().filter(|&&depth| depth != 0).count() as u64;
    }

    /// Adds a frame in bands of `rows` rows, the vertices in storage.
    pub fn add<S: Subpixel, D: Depth, Sh: Shader<Color = Rgb565Be>, const PIXELS: usize>(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        rows: u32,
        vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
        bins: Option<&mut [u32]>,
        memory: &mut Memory<PIXELS>,
    ) {
        let seen = timed(Stage::Vertices, &mut self.vertices, || object.project(camera, vertices));
        self.add_seen(seen.unwrap_or_else(fail), camera, rows, bins, memory);
    }

    /// Adds a frame in bands of `rows` rows, without storage for vertices.
    pub fn add_on_demand<
        S: Subpixel,
        D: Depth,
        Sh: Shader<Color = Rgb565Be>,
        const PIXELS: usize,
    >(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        rows: u32,
        bins: Option<&mut [u32]>,
        memory: &mut Memory<PIXELS>,
    ) {
        let seen = timed(Stage::Vertices, &mut self.vertices, || {
            object.project_on_demand::<_, S, D>(camera, S::default())
        });
        self.add_seen(seen.unwrap_or_else(fail), camera, rows, bins, memory);
    }

    /// Adds a whole frame of an object that is blended with a grey, from back to front if there is
    /// storage for the `order`.
    pub fn add_blended<S: Subpixel, D: Depth, Sh, M, const PIXELS: usize>(
        &mut self,
        object: &Object<'_, Sh, M>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
        order: Option<&mut [u32]>,
        memory: &mut Memory<PIXELS>,
    ) where
        Sh: Shader<Color = Rgb565Be>,
        M: Mode<Blending: OnTargets<D>>,
    {
        self.background = Rgb565Be::new(11, 20, 12);
        let seen = self.projected(object, camera, vertices);
        let areas = BandAreas::new(camera.viewport(), camera.viewport().size.height);
        match order {
            Some(order) => {
                let seen = timed(Stage::Draw, &mut self.draw, || seen.back_to_front(order));
                self.draw_bands(&seen.unwrap_or_else(fail), areas, memory);
            }
            None => self.draw_bands(&seen, areas, memory),
        }
    }

    /// Adds a whole frame of an object that `draw` draws: its lines or points, or a part of it.
    pub fn add_drawn<S: Subpixel, D: Depth, Sh, M: Mode, const PIXELS: usize>(
        &mut self,
        object: &Object<'_, Sh, M>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
        draw: impl FnOnce(
            &Seen<'_, S, D, Sh, M>,
            &mut Frame<'_, Rgb565Be, D::Buffer<'_>>,
        ) -> Result<(), Infallible>,
        memory: &mut Memory<PIXELS>,
    ) where
        Sh: Shader<Color = Rgb565Be>,
    {
        let seen = self.projected(object, camera, vertices);
        self.draw_frame::<D, PIXELS>(camera.viewport(), memory, |frame| draw(&seen, frame));
    }

    /// Adds a frame that `draw` draws and sends to a display. It returns how many pixels are drawn.
    pub fn add_sent<S: Subpixel, D: Depth, Sh: Shader>(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
        draw: impl FnOnce(&Seen<'_, S, D, Sh, Modes>) -> u64,
    ) {
        let seen = self.projected(object, camera, vertices);
        self.pixels_drawn += timed(Stage::Draw, &mut self.draw, || draw(&seen));
    }

    /// Adds a whole frame of steps with storage for the vertices of the object or of another one,
    /// which are projected while it is drawn.
    pub fn add_steps<S: Subpixel, D: Depth, Sh, const PIXELS: usize>(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, D, OnScreen<Sh>>],
        memory: &mut Memory<PIXELS>,
        draw: impl FnOnce(
            &mut [ScreenVertex<S, D, OnScreen<Sh>>],
            &mut Frame<'_, Rgb565Be, D::Buffer<'_>>,
        ) -> Result<(), Infallible>,
    ) where
        Sh: Shader<Color = Rgb565Be>,
    {
        self.count(&object.project(camera, vertices).unwrap_or_else(fail));
        self.draw_frame::<D, PIXELS>(camera.viewport(), memory, |frame| draw(vertices, frame));
    }

    /// Adds a whole frame from back to front by the painter's algorithm.
    pub fn add_painted<S: Subpixel, Sh: Shader<Color = Rgb565Be>, const PIXELS: usize>(
        &mut self,
        object: &Object<'_, Sh>,
        camera: &Camera,
        vertices: &mut [ScreenVertex<S, NoDepth, OnScreen<Sh>>],
        order: &mut [u32],
        memory: &mut Memory<PIXELS>,
    ) {
        let seen = self.projected(object, camera, vertices);
        let painter = timed(Stage::Draw, &mut self.draw, || Painter::new((&seen,), order));
        let painter = painter.unwrap_or_else(fail);
        if SET_UP {
            let mut nothing = Nothing::new(&camera.viewport());
            let Ok(()) = timed(Stage::Draw, &mut self.draw, || painter.draw(&mut nothing));
            return;
        }
        self.draw_frame::<NoDepth, PIXELS>(camera.viewport(), memory, |frame| painter.draw(frame));
    }

    /// Projects the vertices of an object, and counts what is seen of it.
    #[inline(always)]
    fn projected<'s, S: Subpixel, D: Depth, Sh: Shader, M: Mode>(
        &mut self,
        object: &Object<'s, Sh, M>,
        camera: &Camera,
        vertices: &'s mut [ScreenVertex<S, D, OnScreen<Sh>>],
    ) -> Seen<'s, S, D, Sh, M> {
        let seen = timed(Stage::Vertices, &mut self.vertices, || object.project(camera, vertices));
        let seen = seen.unwrap_or_else(fail);
        self.count(&seen);
        seen
    }

    /// Sorts the triangles into `bins`, if there are any, and draws the bands.
    fn add_seen<V, Sh, const PIXELS: usize>(
        &mut self,
        seen: Projected<'_, V, Perspective, Sh>,
        camera: &Camera,
        rows: u32,
        bins: Option<&mut [u32]>,
        memory: &mut Memory<PIXELS>,
    ) where
        V: Vertices<OnScreen<Sh>, Depth: Depth>,
        Sh: Shader<Color = Rgb565Be>,
    {
        self.count(&seen);
        let areas = BandAreas::new(camera.viewport(), rows);
        match bins {
            Some(bins) => {
                let seen = timed(Stage::Draw, &mut self.draw, || seen.binned(rows, bins));
                self.draw_bands(&seen.unwrap_or_else(fail), areas, memory);
            }
            None => self.draw_bands(&seen, areas, memory),
        }
    }

    fn draw_bands<V, Sh, M, O: Order, const PIXELS: usize>(
        &mut self,
        seen: &Projected<'_, V, Perspective, Sh, M, O>,
        areas: BandAreas,
        memory: &mut Memory<PIXELS>,
    ) where
        V: Vertices<OnScreen<Sh>, Depth: Depth>,
        Sh: Shader<Color = Rgb565Be>,
        M: Mode<Blending: OnTargets<V::Depth>>,
    {
        for area in areas {
            if SET_UP {
                let mut nothing = Nothing::new(&area);
                let Ok(()) = timed(Stage::Draw, &mut self.draw, || seen.draw(&mut nothing));
                continue;
            }
            self.draw_frame::<V::Depth, PIXELS>(area, memory, |frame| seen.draw(frame));
        }
    }

    /// Draws a frame of an area, and counts the pixels that are no background afterwards.
    #[inline(always)]
    fn draw_frame<D: Depth, const PIXELS: usize>(
        &mut self,
        area: Rectangle,
        memory: &mut Memory<PIXELS>,
        draw: impl FnOnce(&mut Frame<'_, Rgb565Be, D::Buffer<'_>>) -> Result<(), Infallible>,
    ) {
        let pixels = (area.size.width * area.size.height) as usize;
        let (color, depth) = (&mut memory.color[..pixels], &mut memory.depth[..pixels]);
        color.fill(self.background);
        let mut frame = D::frame(color, depth, area);
        timed(Stage::Clear, &mut self.clear, || frame.clear_depth());
        let Ok(()) = timed(Stage::Draw, &mut self.draw, || draw(&mut frame));
        let drawn = frame.pixels().iter().filter(|&&pixel| pixel != self.background);
        self.pixels_drawn += drawn.count() as u64;
    }

    /// Counts a frame, its triangles, and the pixels that change with it.
    fn count<V: Vertices<OnScreen<Sh>>, Sh: Shader, M: Mode>(
        &mut self,
        seen: &Projected<'_, V, Perspective, Sh, M>,
    ) {
        let Ok(()) = seen.for_each_triangle(|_, _| {
            self.triangles_drawn += 1;
            Ok::<(), Infallible>(())
        });
        let bounds = seen.bounds();
        let both = [self.last, bounds].into_iter().flatten().reduce(around);
        self.pixels_changed += both.map_or(0, |area| u64::from(area.size.width * area.size.height));
        self.last = bounds;
        self.frames += 1;
    }
}

/// The smallest rectangle that holds two.
fn around(a: Rectangle, b: Rectangle) -> Rectangle {
    let ends = [a, b].map(|area| area.top_left + area.size);
    let first = a.top_left.component_min(b.top_left);
    let size = ends[0].component_max(ends[1]) - first;
    Rectangle::new(first, Size::new(size.x as u32, size.y as u32))
}

/// Does the work of a stage and adds the cycles that it took to a sum.
#[inline(always)]
pub fn timed<T>(stage: Stage, sum: &mut u64, work: impl FnOnce() -> T) -> T {
    let start = Moment::now();
    counter::mark(stage);
    let result = work();
    counter::mark(stage);
    *sum += u64::from(start.elapsed());
    result
}

/// Ends the program: there is no frame to be measured.
///
/// # Panics
///
/// Always.
pub fn fail<T, E: Debug>(error: E) -> T {
    panic!("{error:?}")
}
