//! What a model goes through before it is placed: for the core, which changes it vertex by vertex,
//! and for the reference, which draws the model as if it were made in that form.

use std::borrow::Cow;

use rasterizer::{
    geometry::{self, ClipAll, CullBack},
    numbers::{Matrix, Scalar},
    output::Replace,
    raster::NoBias,
    scene::{Modes, Object},
    shade::Shader,
};

use super::{
    quantised_positions,
    stand::{MOST, STEP},
    view::{View, ViewError, checked},
};
use crate::{
    model::{Exact, Faces, Model},
    reference::{HalfSpace, LinearMap},
};

/// What a model goes through before it is placed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Form {
    /// Nothing.
    #[default]
    AsModelled,
    /// A matrix stretches, mirrors or shears it.
    Shaped(LinearMap),
}

/// The most by which a matrix may stretch more in one direction than in another: beyond that the
/// core promises nothing of normals.
const MOST_UNEVEN: f64 = 1_000.0;

/// An object of the core in a form: with back faces culled, and with opaque pixels.
pub(super) type Formed<'a, Sh, G, L = ClipAll> =
    Object<'a, Sh, Modes<CullBack, L, Replace, NoBias, G>>;

/// Draws an object of the core in any form.
pub(super) trait UseObject<Sh: Shader> {
    /// The result.
    type Done;

    /// Draws the object, which has no pose yet.
    fn use_object<G: geometry::Shape>(
        self,
        object: Formed<'_, Sh, G>,
    ) -> Result<Self::Done, ViewError>;
}

/// Draws a model in the form of a view.
pub(super) fn in_form<Sh: Shader, U: UseObject<Sh>>(
    model: &Model,
    view: &View,
    shader: Sh,
    user: U,
) -> Result<U::Done, ViewError> {
    let mesh = model.mesh();
    match view.form {
        Form::AsModelled => user.use_object(Object::new(&mesh, shader)),
        Form::Shaped(map) => user.use_object(Object::new(&mesh, shader).shaped(&matrix(&map)?)),
    }
}

/// The matrix of the core.
fn matrix(map: &LinearMap) -> Result<Matrix, ViewError> {
    for &entry in map.rows.as_flattened() {
        checked("an entry of the matrix", entry, -MOST, MOST)?;
    }
    let rows = rounded(map).rows;
    Ok(Matrix::from_rows(rows.map(|row| row.map(Scalar::from_num))))
}

/// In the core's numbers.
fn rounded(map: &LinearMap) -> LinearMap {
    LinearMap { rows: map.rows.map(|row| row.map(|c| (c / STEP).round() * STEP)) }
}

impl Form {
    /// In the core's numbers.
    pub(super) fn rounded(self) -> Self {
        match self {
            Self::AsModelled => self,
            Self::Shaped(map) => Self::Shaped(rounded(&map)),
        }
    }

    /// Whether it makes a left hand of a right one.
    pub(super) fn is_mirrored(self) -> bool {
        matches!(self.rounded(), Self::Shaped(map) if map.determinant() < 0.0)
    }

    /// What the form makes of half a quantum along the axes of the tables: three directions.
    pub(super) fn half_quanta(self, model: &Model) -> [[f64; 3]; 3] {
        let half = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent()) / 2.0;
        let LinearMap { rows } = LinearMap::IDENTITY;
        let axes = rows.map(|row| row.map(|c| half * c));
        match self.rounded() {
            Self::AsModelled => axes,
            Self::Shaped(map) => axes.map(|axis| map.point(axis)),
        }
    }

    /// By how much the level of a light of level 1 may be off that of the file's normal.
    ///
    /// A normal of the tables lies in the unit cube about the exact one in 127ths, whose diagonal
    /// is the root of 3. A matrix turns it away by that times its unevenness at most, and rounds to
    /// 127ths again.
    pub(super) fn level_error(self) -> f64 {
        let rounding = 1.733 / 127.0;
        match self.rounded() {
            Self::AsModelled => rounding,
            Self::Shaped(map) => rounding * (1.0 + map.unevenness()),
        }
    }

    /// What it makes of a half space of the model's units.
    pub(super) fn half_space(self, side: HalfSpace) -> HalfSpace {
        match self.rounded() {
            Self::AsModelled => side,
            Self::Shaped(map) => HalfSpace { normal: map.plane_normal(side.normal), ..side },
        }
    }

    /// The exact places, in the form, of the vertices of the tables.
    pub(super) fn table_positions(self, model: &Model) -> Vec<[f64; 3]> {
        let positions = quantised_positions(model);
        match self.rounded() {
            Self::AsModelled => positions,
            Self::Shaped(map) => positions.into_iter().map(|p| map.point(p)).collect(),
        }
    }

    /// Where the middle of the box of the tables lies in the form.
    pub(super) fn middle(self, model: &Model) -> [f64; 3] {
        let bounds = *model.mesh().bounds();
        let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
        let offset = model.offset.to_bits().map(|c| f64::from(c) * STEP);
        let middle = [0, 1, 2].map(|i| {
            let ends = f64::from(bounds.min[i]) + f64::from(bounds.max[i]);
            offset[i] + step * ends / 2.0
        });
        match self.rounded() {
            Self::AsModelled => middle,
            Self::Shaped(map) => map.point(middle),
        }
    }

    /// The exact normals, in the form, that follow from those of the tables' vertices and
    /// triangles.
    pub(super) fn table_normals(self, model: &Model) -> [Vec<[f64; 3]>; 2] {
        [&model.vertex_normals, &model.face_normals].map(|normals| {
            let exact = |n: &[i8; 3]| n.map(|c| f64::from(c) / 127.0);
            match self.rounded() {
                Self::AsModelled => normals.iter().map(exact).collect(),
                Self::Shaped(map) => normals.iter().map(|n| map.normal(exact(n))).collect(),
            }
        })
    }

    /// The model with the numbers of its file as if it were made in this form. Its tables are as
    /// they are: the core draws it in the form.
    pub(super) fn made(self, model: &Model) -> Result<Cow<'_, Model>, ViewError> {
        let Self::Shaped(map) = self.rounded() else { return Ok(Cow::Borrowed(model)) };
        matrix(&map)?;
        let unevenness = map.unevenness();
        if unevenness.is_infinite() {
            return Err(ViewError::Flat);
        }
        if unevenness > MOST_UNEVEN {
            return Err(ViewError::Uneven { unevenness, most: MOST_UNEVEN });
        }
        let points = |all: &[[f64; 3]]| all.iter().map(|&p| map.point(p)).collect();
        let normals = |all: &[[f64; 3]]| all.iter().map(|&n| map.normal(n)).collect();
        let Exact { positions, vertex_normals, face_normals, faces, .. } = &model.exact;
        let made = Faces { positions: points(&faces.positions), ..faces.clone() };
        let exact = Exact {
            positions: points(positions),
            vertex_normals: normals(vertex_normals),
            face_normals: normals(face_normals),
            faces: if map.determinant() < 0.0 { turned_over(made) } else { made },
            ..model.exact.clone()
        };
        Ok(Cow::Owned(Model { exact, ..model.clone() }))
    }
}

/// Faces whose corners run the other way round.
fn turned_over(mut faces: Faces) -> Faces {
    for face in &faces.faces {
        let own = face.corners.clone();
        faces.corners[own.clone()].reverse();
        // Tables that are left out are empty.
        if let Some(corners) = faces.texture_coordinates.get_mut(own.clone()) {
            corners.reverse();
        }
        if let Some(corners) = faces.vertex_colors.get_mut(own) {
            corners.reverse();
        }
    }
    faces
}
