//! What is seen in a view by each way to decide it, and the work that it takes: all by the core.

use std::{
    cell::{Cell, RefCell},
    convert::Infallible,
};

use embedded_graphics_core::{
    geometry::{Point, Size},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Perspective},
    fixed::types::U16F16,
    geometry::ScreenVertex,
    mesh::{Mesh, MeshFace, MeshMaterial, MeshVertex},
    numbers::{Rotation, S4, S8, Scalar, Subpixel, Vec3},
    output::{Frame, PixelFill, StoredColor, StoredDepth, Target},
    raster::{Fragment, FragmentOf, Gradients, Layout, Primitive, Window},
    scene::Object,
    shade::{Face, Outcome, Shader},
};

use super::{
    Divided, Slivers, Visibility, band_rows, order::Orders, partition::Partition, views::Placed,
};
use crate::check::{Subpixel as Precision, ViewError};

/// The number of the face that a pixel shows, from 1; 0 for none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct FaceNumber(u32);

impl StoredColor for FaceNumber {
    type Fill = PixelFill<Self>;
}

/// The shader whose colour is the number of the face.
#[derive(Clone, Copy, Debug)]
struct Numbered;

impl Shader for Numbered {
    type Color = FaceNumber;
    type Varyings = [u16; 0];
    type Surface = ();
    type Face = ();
    type Outcome = FaceNumber;

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, _: &MeshVertex<'_>) -> [u16; 0] {
        []
    }

    fn face(
        &self,
        (): &(),
        face: &MeshFace<'_>,
        _: &Gradients<'_, [u16; 0]>,
    ) -> Face<FaceNumber, ()> {
        Face::Solid(FaceNumber(face.index() as u32 + 1))
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<[U16F16; 0]>) -> FaceNumber {
        FaceNumber::default()
    }
}

/// What costs of a view depend on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Triangles of the mesh.
    pub triangles: u64,
    /// Triangles that face the camera, and may cover a pixel.
    pub seen: u64,
    /// Those of them that cover none.
    pub missed: u64,
    /// Rows of all of them.
    pub rows: u64,
    /// Pixels of all of them.
    pub covered: u64,
    /// Pixels of them that a depth test passes, in the order of the mesh.
    pub passed: u64,
    /// For each of [`band_rows`], how often bands meet a triangle that is seen.
    pub met: Vec<u64>,
    /// What is divided of texture coordinates, in renderers that correct them.
    pub divided: Divided,
    /// Triangles whose gradients are divided exactly.
    pub slivers: Slivers,
}

/// Adds the bands of each height that a triangle's first and last row are in, and all between.
pub(super) fn add_bands(met: &mut Vec<u64>, heights: &[u32], rows: [i32; 2]) {
    met.resize(heights.len(), 0);
    for (met, &height) in met.iter_mut().zip(heights) {
        let [first, last] = rows.map(|row| row as u32 / height);
        *met += u64::from(last - first + 1);
    }
}

/// A view by all ways.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) work: Work,
    /// The faces of the pixels, by 32 bits of depth: their numbers from 1, or 0.
    pub(super) faces: Vec<u32>,
    /// The pixels that show a face.
    pub(super) shown: usize,
    /// For each of [`Visibility::ALL`] but other orders of the tables the pixels that show another
    /// one.
    pub(super) wrong: [usize; Visibility::ALL.len()],
}

/// What sees a model.
#[derive(Clone, Copy)]
pub(super) struct Eye<'a> {
    pub(super) mesh: &'a Mesh<'a>,
    pub(super) lens: Perspective,
    pub(super) size: [u32; 2],
}

impl Eye<'_> {
    /// Looks at the model in a view.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn look(&self, precision: Precision, view: &Placed) -> Result<Seen, ViewError> {
        match precision {
            Precision::S4 => self.look_in::<S4>(view),
            Precision::S8 => self.look_in::<S8>(view),
        }
    }

    fn look_in<S: Subpixel>(&self, view: &Placed) -> Result<Seen, ViewError> {
        let counts = Counts { bands: band_rows(self.size[1]), ..Counts::default() };
        let faces = self.faces::<S, u32>(view, None)?;
        let shown = faces.iter().filter(|&&FaceNumber(face)| face > 0).count();
        let mut wrong = [0; Visibility::ALL.len()];
        for (wrong, visibility) in wrong.iter_mut().zip(Visibility::ALL) {
            let other = match visibility {
                Visibility::MeshOrder => self.in_order::<S>(view, None)?,
                Visibility::Sorted => self.sorted::<S>(view)?,
                Visibility::U16 => self.faces::<S, u16>(view, Some(&counts))?,
                Visibility::Float16 => self.faces::<S, FloatDepth>(view, None)?,
                // That of the study's own mesh is not judged before all views are known.
                Visibility::FixedOrder | Visibility::PartOrder | Visibility::U32 => continue,
            };
            *wrong = other.iter().zip(&faces).filter(|(a, b)| a != b).count();
        }
        let mut work = counts.work.into_inner();
        work.triangles = self.mesh.triangle_count() as u64;
        work.passed = counts.passed.get();
        work.slivers = self.slivers::<S>(view)?;
        Ok(Seen { work, faces: numbers(faces), shown, wrong })
    }

    /// The faces that a view shows, by 32 bits of depth: their numbers from 1, or 0.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn nearest(
        &self,
        precision: Precision,
        view: &Placed,
    ) -> Result<Vec<u32>, ViewError> {
        let faces = match precision {
            Precision::S4 => self.faces::<S4, u32>(view, None)?,
            Precision::S8 => self.faces::<S8, u32>(view, None)?,
        };
        Ok(numbers(faces))
    }

    /// The same without depth, in the order of the mesh or of its parts: the last face drawn.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn last_drawn(
        &self,
        precision: Precision,
        view: &Placed,
        parts: Option<&Partition>,
    ) -> Result<Vec<u32>, ViewError> {
        let faces = match precision {
            Precision::S4 => self.in_order::<S4>(view, parts)?,
            Precision::S8 => self.in_order::<S8>(view, parts)?,
        };
        Ok(numbers(faces))
    }

    /// Adds the arcs of a view, in which `front` are the [nearest](Self::nearest) faces.
    ///
    /// # Errors
    ///
    /// Returns an error if the core refuses the view.
    pub(super) fn add_arcs(
        &self,
        precision: Precision,
        (number, view): (u32, &Placed),
        front: &[u32],
        orders: &mut Orders,
    ) -> Result<(), ViewError> {
        let mut covering = Covering { eye: self, front, view: number, orders };
        match precision {
            Precision::S4 => self.draw_without_depth::<S4, _>(view, None, &mut covering),
            Precision::S8 => self.draw_without_depth::<S8, _>(view, None, &mut covering),
        }
    }

    /// Draws the triangles in the order of the mesh or of its parts.
    fn draw_without_depth<S: Subpixel, T>(
        &self,
        view: &Placed,
        parts: Option<&Partition>,
        target: &mut T,
    ) -> Result<(), ViewError>
    where
        T: Target<Color = FaceNumber, Depth = NoDepth, Error = Infallible>,
    {
        let mut vertices = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.mesh.vertex_count()];
        let seen = self.object(view).project(&self.camera(view)?, &mut vertices)?;
        let Ok(()) = match parts {
            Some(parts) => parts.with_parts(self.mesh, |parts| match parts {
                Some(parts) => seen.in_parts(parts).draw(target),
                // Of a file that has changed meanwhile.
                None => seen.draw(target),
            }),
            None => seen.draw(target),
        };
        Ok(())
    }

    pub(super) const fn area(&self) -> Rectangle {
        Rectangle::new(Point::zero(), Size::new(self.size[0], self.size[1]))
    }

    pub(super) fn camera(&self, view: &Placed) -> Result<Camera<Perspective>, ViewError> {
        let eye = Vec3::new(Scalar::ZERO, Scalar::ZERO, Scalar::from_num(view.distance));
        Ok(Camera::at(eye, Rotation::IDENTITY, self.lens, self.area())?)
    }

    fn object(&self, view: &Placed) -> Object<'_, Numbered> {
        Object::new(self.mesh, Numbered).posed(view.pose())
    }

    /// The faces by a depth buffer; counts them, if there is something to count in.
    fn faces<S: Subpixel, D: StoredDepth>(
        &self,
        view: &Placed,
        counts: Option<&Counts>,
    ) -> Result<Vec<FaceNumber>, ViewError> {
        let (mut color, mut depth) = (self.pixels(FaceNumber(0)), self.pixels(D::ZERO));
        let mut vertices = vec![ScreenVertex::<S, D, _>::EMPTY; self.mesh.vertex_count()];
        let seen = self.object(view).project(&self.camera(view)?, &mut vertices)?;
        let mut frame = Frame::new(&mut color, &mut depth, self.area())?;
        let Ok(()) = match counts {
            Some(counts) => seen.draw(&mut Counted { target: frame, counts }),
            None => seen.draw(&mut frame),
        };
        Ok(color)
    }

    /// The faces without depth, in the order of the mesh or of its parts: the last on top.
    fn in_order<S: Subpixel>(
        &self,
        view: &Placed,
        parts: Option<&Partition>,
    ) -> Result<Vec<FaceNumber>, ViewError> {
        let mut color = self.pixels(FaceNumber(0));
        let mut frame = Frame::without_depth(&mut color, self.area())?;
        self.draw_without_depth::<S, _>(view, parts, &mut frame)?;
        Ok(color)
    }

    /// The faces without depth, from back to front.
    fn sorted<S: Subpixel>(&self, view: &Placed) -> Result<Vec<FaceNumber>, ViewError> {
        let mut color = self.pixels(FaceNumber(0));
        let mut vertices = vec![ScreenVertex::<S, NoDepth, _>::EMPTY; self.mesh.vertex_count()];
        let mut order = vec![0; self.mesh.triangle_count()];
        let seen = self.object(view).project(&self.camera(view)?, &mut vertices)?;
        let mut frame = Frame::without_depth(&mut color, self.area())?;
        let Ok(()) = seen.back_to_front(&mut order)?.draw(&mut frame);
        Ok(color)
    }

    fn pixels<T: Clone>(&self, value: T) -> Vec<T> {
        vec![value; self.size[0] as usize * self.size[1] as usize]
    }
}

/// The numbers of faces, from 1, or 0.
fn numbers(faces: Vec<FaceNumber>) -> Vec<u32> {
    faces.into_iter().map(|FaceNumber(face)| face).collect()
}

/// A target that finds out which triangles are hidden, and by which.
struct Covering<'c> {
    eye: &'c Eye<'c>,
    front: &'c [u32],
    view: u32,
    orders: &'c mut Orders,
}

impl Target for Covering<'_> {
    type Color = FaceNumber;
    type Depth = NoDepth;
    type Error = Infallible;

    fn window(&self) -> Window {
        Window::new(&self.eye.area())
    }

    /// Not called: all faces are of one colour.
    fn shade<Q: Primitive<Depth = NoDepth>, O: Outcome<FaceNumber>>(
        &mut self,
        _: &Q,
        _: &Window,
        _: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        Ok(())
    }

    fn fill<Q: Primitive<Depth = NoDepth>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        FaceNumber(face): FaceNumber,
    ) -> Result<(), Infallible> {
        let layout = Layout { pitch: self.eye.size[0] as i32, origin: 0 };
        // The face in front is mostly that of the pixel before.
        let mut last = face;
        primitive.for_each_span(window, layout, |span| {
            for &front in self.front.get(span.start..span.end).unwrap_or_default() {
                if front != last && front != face && front > 0 {
                    self.orders.add(face - 1, front - 1, self.view);
                    last = front;
                }
            }
            Ok(())
        })
    }
}

/// What is counted while a view is drawn.
#[derive(Default)]
struct Counts {
    bands: Vec<u32>,
    work: RefCell<Work>,
    passed: Cell<u64>,
}

/// A target that counts what it is given.
struct Counted<'c, T> {
    target: T,
    counts: &'c Counts,
}

impl<T: Target<Error = Infallible>> Target for Counted<'_, T> {
    type Color = T::Color;
    type Depth = T::Depth;
    type Error = Infallible;

    fn window(&self) -> Window {
        self.target.window()
    }

    fn shade<Q: Primitive<Depth = T::Depth>, O: Outcome<T::Color>>(
        &mut self,
        primitive: &Q,
        window: &Window,
        pixel: impl Fn(FragmentOf<Q>) -> O + Copy,
    ) -> Result<(), Infallible> {
        let passed = &self.counts.passed;
        self.target.shade(primitive, window, |fragment| {
            passed.set(passed.get() + 1);
            pixel(fragment)
        })?;
        let mut work = self.counts.work.borrow_mut();
        let mut rows: Option<[i32; 2]> = None;
        let layout = Layout { pitch: 0, origin: 0 };
        primitive.for_each_span(window, layout, |span| {
            work.rows += 1;
            work.covered += (span.end - span.start) as u64;
            rows = Some([rows.map_or(span.row, |[first, _]| first), span.row]);
            Ok::<(), Infallible>(())
        })?;
        work.seen += 1;
        work.missed += u64::from(rows.is_none());
        // One that covers no pixel is met by a band, too.
        add_bands(&mut work.met, &self.counts.bands, rows.unwrap_or_default());
        Ok(())
    }
}
