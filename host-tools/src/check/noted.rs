//! What the shaders of the core see of a model that is not as it was modelled: positions and
//! normals that the core makes of its tables, against the exact ones.

use std::cell::RefCell;

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    camera::Camera,
    geometry::{self, CullNone, ObjectView, ScreenVertex},
    mesh::{MeshFace, MeshMaterial, MeshVertex},
    numbers,
    output::Frame,
    raster::{Fragment, Gradients},
    shade::{Face, Sample, Shader},
};

use super::{
    Form, NormalErrors,
    form::{Formed, UseObject, in_form},
    normals,
    stand::STEP,
    view::{View, ViewError},
};
use crate::model::Model;

/// The vertices and triangles of a model as shaders see them.
#[derive(Clone, Debug, Default)]
pub(super) struct Noted {
    /// Positions in quanta of the mesh that shaders see.
    pub(super) positions: Vec<[i16; 3]>,
    /// The length of that quantum in model units.
    pub(super) quantum: f64,
    /// Where position (0, 0, 0) lies.
    pub(super) offset: [f64; 3],
    /// The normals of the vertices in 127ths.
    vertex_normals: Vec<[i8; 3]>,
    /// The normals of the triangles in 127ths; `None` for those outside the picture.
    face_normals: Vec<Option<[i8; 3]>>,
}

impl Noted {
    /// Of a model in a view.
    pub(super) fn of(model: &Model, view: &View) -> Result<Self, ViewError> {
        let noted = RefCell::new(Self {
            face_normals: vec![None; model.mesh().triangle_count()],
            ..Self::default()
        });
        in_form(model, view, Recorder(&noted), Take { view })?;
        Ok(noted.into_inner())
    }

    /// The normals of the triangles: those of the core where they are within their bound of the
    /// exact ones, else the exact ones.
    pub(super) fn face_normals(&self, exact: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let of = |(seen, &exact): (&Option<[i8; 3]>, &[f64; 3])| {
            normals::seen_or(seen.map(|n| n.map(|c| f64::from(c) / 127.0)), exact)
        };
        self.face_normals.iter().zip(exact).map(of).collect()
    }

    /// How far the normals are off the exact ones.
    pub(super) fn normal_errors(
        &self,
        [vertices, faces]: &[Vec<[f64; 3]>; 2],
        form: Form,
    ) -> NormalErrors {
        let seen = |n: [i8; 3]| n.map(f64::from);
        let of_vertices = self.vertex_normals.iter().zip(vertices).map(|(&n, &e)| (seen(n), e));
        let of_faces =
            (self.face_normals.iter().zip(faces)).filter_map(|(n, &e)| Some(((*n).map(seen)?, e)));
        NormalErrors::of_tables(of_vertices.chain(of_faces), form.normal_bound_degrees())
    }
}

/// Draws the object that the notes are taken of.
struct Take<'a> {
    view: &'a View,
}

impl<'r> UseObject<Recorder<'r>> for Take<'_> {
    type Done = ();

    fn use_object<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Recorder<'r>>,
        camera: &Camera<P>,
    ) -> Result<(), ViewError> {
        let pixels = self.view.pixel_count();
        let (mut colors, mut depth) = (vec![Rgb888::BLACK; pixels], vec![0u16; pixels]);
        let mut frame = Frame::new(&mut colors, &mut depth, self.view.area())?;
        let mut storage =
            vec![ScreenVertex::<S, u16, [u16; 0]>::EMPTY; object.mesh().vertex_count()];
        let Ok(()) = object.culled(CullNone).project(camera, &mut storage)?.draw(&mut frame);
        Ok(())
    }
}

/// A shader that writes down what it sees.
#[derive(Clone, Copy, Debug)]
struct Recorder<'r>(&'r RefCell<Noted>);

impl Shader for Recorder<'_> {
    type Color = Rgb888;
    type Varyings = [u16; 0];
    type Surface = ();
    type Face = ();
    type Outcome = Rgb888;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        let tables = view.mesh().tables();
        let mut noted = self.0.borrow_mut();
        noted.quantum = f64::from(tables.scale.mantissa()) * 2f64.powi(tables.scale.exponent());
        noted.offset = tables.offset.to_bits().map(|c| f64::from(c) * STEP);
        *self
    }

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> [u16; 0] {
        let mut noted = self.0.borrow_mut();
        noted.positions.push(vertex.position());
        noted.vertex_normals.push(vertex.normal());
        []
    }

    fn face(&self, (): &(), face: &MeshFace<'_>, _: &Gradients<'_, [u16; 0]>) -> Face<Rgb888, ()> {
        self.0.borrow_mut().face_normals[face.index()] = Some(face.normal());
        Face::Solid(Rgb888::BLACK)
    }

    fn pixel(&self, (): &(), (): &(), _: Fragment<Sample<Self>>) -> Rgb888 {
        Rgb888::BLACK
    }
}
