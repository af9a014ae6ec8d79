//! What a model goes through before it is placed: for the core, which changes it vertex by vertex,
//! and for the reference, which draws the model as if it were made in that form.

use std::borrow::Cow;

use rasterizer::{
    camera::Camera,
    geometry::{self, AnyShape, ClipAll, CullBack},
    mesh::{Keyframes, Progress},
    numbers::{Matrix, Scalar, Subpixel},
    output::Replace,
    raster::NoBias,
    scene::{Modes, Object},
    shade::Shader,
};

use super::{
    drawing::{self, Drawing},
    stand::{MOST, STEP},
    view::{View, ViewError, checked},
};
use crate::{
    model::{Exact, Faces, Model, Shape},
    reference::{Between, HalfSpace, LinearMap, Plane},
};

/// What a model goes through before it is placed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Form {
    /// Nothing.
    #[default]
    AsModelled,
    /// A matrix stretches, mirrors or shears it.
    Shaped(LinearMap),
    /// It is between its first shape and its second one.
    Between {
        /// How far on the way it is, from 0 to 1.
        progress: f64,
        /// How far it is in the middle of a turn: it goes there and back
        /// ([`View::turned`](super::View::turned)).
        halfway: f64,
    },
}

/// The most by which a matrix may stretch more in one direction than in another: beyond that the
/// core promises nothing of normals.
const MOST_UNEVEN: f64 = 1_000.0;

/// The least stretch of a matrix that the core's limits count with.
const LEAST_STRETCH: f64 = 1.0 / 4096.0;

/// The step of the way between two shapes.
const PROGRESS: f64 = 1.0 / 32_768.0;

/// An object of the core in a form: with back faces culled, and with opaque pixels. Its shape is
/// chosen at run time: code for each would take minutes to compile.
pub(super) type Formed<'a, Sh, L = ClipAll> =
    Object<'a, Sh, Modes<CullBack, L, Replace, NoBias, AnyShape<'a>>>;

/// Draws an object of the core in any form and precision, with any camera.
pub(super) trait UseObject<Sh: Shader> {
    /// The result.
    type Done;

    /// Draws the object, which has the view's pose.
    fn use_object<S: Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Sh>,
        camera: &Camera<P>,
    ) -> Result<Self::Done, ViewError>;
}

/// Draws a model in the form, in the pose, with the camera and in the precision of a view.
pub(super) fn in_form<Sh: Shader, U: UseObject<Sh>>(
    model: &Model,
    view: &View,
    shader: Sh,
    user: U,
) -> Result<U::Done, ViewError> {
    drawing::draw(view, InForm { model, view, shader, user })
}

/// What draws a model in the form of a view.
struct InForm<'a, Sh, U> {
    model: &'a Model,
    view: &'a View,
    shader: Sh,
    user: U,
}

impl<Sh: Shader, U: UseObject<Sh>> Drawing for InForm<'_, Sh, U> {
    type Drawn = U::Done;

    fn draw<S: Subpixel, P: geometry::Projection>(
        self,
        camera: &Camera<P>,
    ) -> Result<U::Done, ViewError> {
        let Self { model, view, shader, user } = self;
        let (mesh, pose) = (model.mesh(), view.pose()?);
        match view.form.rounded() {
            Form::AsModelled => {
                let object = Object::new(&mesh, shader).posed(pose).in_any_shape();
                user.use_object::<S, P>(object, camera)
            }
            Form::Shaped(map) => {
                let object = Object::new(&mesh, shader).posed(pose).shaped(&matrix(&map)?);
                user.use_object::<S, P>(object.in_any_shape(), camera)
            }
            Form::Between { progress, .. } => {
                let further = model.further_shapes();
                let progress =
                    Progress::from_num(checked("the way between shapes", progress, 0.0, 1.0)?);
                let keyframes = Keyframes::new(&mesh, &further).ok();
                let tween = keyframes.and_then(|keyframes| keyframes.between(0, 1, progress));
                let tween = tween.ok_or(ViewError::OneShape)?;
                let object = Object::morphed(&tween, shader).posed(pose).in_any_shape();
                user.use_object::<S, P>(object, camera)
            }
        }
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
            Self::Between { progress, halfway } => {
                let [progress, halfway] =
                    [progress, halfway].map(|part| (part / PROGRESS).round() * PROGRESS);
                Self::Between { progress, halfway }
            }
        }
    }

    /// The form at a part of a turn, from 0 to 1.
    pub(super) fn turned(self, part: f64) -> Self {
        let Self::Between { progress, halfway } = self else { return self };
        let there = 1.0 - (1.0 - 2.0 * part).abs();
        Self::Between { progress: progress + there * (halfway - progress), halfway }
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
            // Each shape is rounded, and so is what lies between them.
            Self::Between { .. } => axes.map(|axis| axis.map(|c| 2.0 * c)),
        }
    }

    /// By how much the level of a light of level 1 may be off that of the file's normal.
    ///
    /// A normal of the tables lies in the unit cube about the exact one in 127ths, whose diagonal
    /// is the root of 3. A matrix turns it away by that times its unevenness at most, and rounds to
    /// 127ths again. So does a blend, whose error is the larger the shorter it is.
    pub(super) fn level_error(self, model: &Model) -> f64 {
        let rounding = 1.733 / 127.0;
        match self.rounded() {
            Self::AsModelled => rounding,
            Self::Shaped(map) => rounding * (1.0 + map.unevenness()),
            Self::Between { progress, .. } => {
                let between = Between { progress };
                let to = model.keyframes.first().map_or(&[][..], |shape| &shape.vertex_normals);
                let least = (model.vertex_normals.iter().zip(to))
                    .map(|(&from, &to)| between.steadiness(of_127ths(from), of_127ths(to)))
                    .fold(1.0, f64::min);
                (rounding * (1.0 + 1.0 / least)).min(1.0)
            }
        }
    }

    /// How far a normal that the core makes of the tables' may be off, in degrees.
    pub(super) const fn normal_bound_degrees(self) -> f64 {
        match self {
            Self::AsModelled => 0.0,
            Self::Shaped(_) => 0.5,
            Self::Between { .. } => 0.4,
        }
    }

    /// What it makes of a half space of the model's units.
    pub(super) fn half_space(self, side: HalfSpace) -> HalfSpace {
        match self.rounded() {
            Self::AsModelled | Self::Between { .. } => side,
            Self::Shaped(map) => HalfSpace { normal: map.plane_normal(side.normal), ..side },
        }
    }

    /// The exact places, in the form, of the vertices of the tables.
    pub(super) fn table_positions(self, model: &Model) -> Vec<[f64; 3]> {
        let quanta = model.positions.iter().map(|p| p.map(f64::from));
        match self.rounded() {
            Self::AsModelled => quanta.map(|p| place(model, p)).collect(),
            Self::Shaped(map) => quanta.map(|p| map.point(place(model, p))).collect(),
            // By definition in whole quanta.
            Self::Between { progress, .. } => {
                let between = Between { progress };
                let to = model.keyframes.first().map_or(&[][..], |shape| &shape.positions);
                let pairs = quanta.zip(to.iter().map(|p| p.map(f64::from)));
                pairs.map(|(from, to)| place(model, between.whole(from, to))).collect()
            }
        }
    }

    /// Where the middle of the box of the tables lies in the form: between shapes, of that of all.
    pub(super) fn middle(self, model: &Model) -> [f64; 3] {
        let [low, high] = self.box_in_quanta(model);
        self.place(model, [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0))
    }

    /// Where the corners of that box lie in the form.
    pub(super) fn box_corners(self, model: &Model) -> [[f64; 3]; 8] {
        let ends = self.box_in_quanta(model);
        let corner = |number: usize| [0, 1, 2].map(|i| ends[number >> i & 1][i]);
        std::array::from_fn(|number| self.place(model, corner(number)))
    }

    /// The least and the largest coordinates of the tables: between shapes, of those of all.
    fn box_in_quanta(self, model: &Model) -> [[f64; 3]; 2] {
        let of_all = self.shapes(model).flatten();
        of_all.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], p| {
            let p = p.map(f64::from);
            [[0, 1, 2].map(|i| low[i].min(p[i])), [0, 1, 2].map(|i| high[i].max(p[i]))]
        })
    }

    /// The place in the form, in model units, of a position in quanta.
    fn place(self, model: &Model, quanta: [f64; 3]) -> [f64; 3] {
        let modelled = place(model, quanta);
        match self.rounded() {
            Self::Shaped(map) => map.point(modelled),
            Self::AsModelled | Self::Between { .. } => modelled,
        }
    }

    /// Where the origin of the tables lies in the form, and the largest magnitude of a coordinate
    /// from there, in model units: what [`PoseError`](rasterizer::geometry::PoseError) calls h. A
    /// matrix multiplies it by the largest sum of the magnitudes in a row or a column, rounded up
    /// to a power of two, as [`Shaped`](rasterizer::geometry::Shaped) states.
    pub(super) fn extent(self, model: &Model) -> ([f64; 3], f64) {
        let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
        let ends = self.box_in_quanta(model);
        let most = ends.as_flattened().iter().fold(0f64, |most, c| most.max(c.abs()));
        let stretch = match self.rounded() {
            Self::Shaped(LinearMap { rows }) => {
                let row = |i: usize| rows[i].iter().map(|c| c.abs()).sum::<f64>();
                let column = |i: usize| rows.iter().map(|row| row[i].abs()).sum::<f64>();
                let sum = [0, 1, 2].map(|i| row(i).max(column(i))).into_iter().fold(0.0, f64::max);
                sum.max(LEAST_STRETCH).log2().ceil().exp2()
            }
            Self::AsModelled | Self::Between { .. } => 1.0,
        };
        (self.place(model, [0.0; 3]), stretch * step * most)
    }

    /// The positions of the shapes that the core's box is about, in quanta.
    pub(super) fn shapes(self, model: &Model) -> impl Iterator<Item = &[[i16; 3]]> {
        let further: &[Shape] = match self {
            Self::Between { .. } => &model.keyframes,
            _ => &[],
        };
        std::iter::once(&model.positions[..])
            .chain(further.iter().map(|shape| &shape.positions[..]))
    }

    /// The exact normals, in the form, that follow from those of the tables' vertices and
    /// triangles.
    pub(super) fn table_normals(self, model: &Model) -> [Vec<[f64; 3]>; 2] {
        let to = model.keyframes.first();
        let both = [
            (&model.vertex_normals, to.map_or(&[][..], |shape| &shape.vertex_normals)),
            (&model.face_normals, to.map_or(&[][..], |shape| &shape.face_normals)),
        ];
        both.map(|(normals, to)| match self.rounded() {
            Self::AsModelled => normals.iter().map(|&n| of_127ths(n)).collect(),
            Self::Shaped(map) => normals.iter().map(|&n| map.normal(of_127ths(n))).collect(),
            // In whole numbers opposite ones meet exactly.
            Self::Between { progress, .. } => {
                let blend = |(from, to): (&[i8; 3], &[i8; 3])| {
                    Between { progress }.normal(from.map(f64::from), to.map(f64::from))
                };
                normals.iter().zip(to).map(blend).collect()
            }
        })
    }

    /// The model with the numbers of its file as if it were made in this form. Its tables are as
    /// they are: the core draws it in the form.
    pub(super) fn made(self, model: &Model) -> Result<Cow<'_, Model>, ViewError> {
        let exact = match self.rounded() {
            Self::AsModelled => return Ok(Cow::Borrowed(model)),
            Self::Shaped(map) => shaped(&model.exact, &map)?,
            Self::Between { progress, .. } => {
                let to = model.keyframes.first().ok_or(ViewError::OneShape)?;
                between(&model.exact, to, Between { progress })
            }
        };
        Ok(Cow::Owned(Model { exact, ..model.clone() }))
    }

    /// The normals of the triangles of a surface by the definition of the form, from the model as
    /// it was modelled; `None` if they are those of the surface itself.
    pub(super) fn triangle_normals(
        self,
        model: &Model,
        triangles: &[[usize; 3]],
    ) -> Option<Vec<[f64; 3]>> {
        let Self::Between { progress, .. } = self.rounded() else { return None };
        let faces = &model.exact.faces;
        let to = model.keyframes.first()?;
        let of = |positions: &[[f64; 3]], triangle: &[usize; 3]| {
            let corners = triangle.map(|corner| positions[faces.corners[corner] as usize]);
            Plane::of(&corners).normal().unwrap_or_default()
        };
        let blend = |triangle| {
            let [from, to] = [&faces.positions, &to.face_positions].map(|all| of(all, triangle));
            Between { progress }.normal(from, to)
        };
        Some(triangles.iter().map(blend).collect())
    }
}

/// The place in model units of a position in quanta.
fn place(model: &Model, quanta: [f64; 3]) -> [f64; 3] {
    let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
    let offset = model.offset.to_bits().map(|c| f64::from(c) * STEP);
    [0, 1, 2].map(|i| offset[i] + step * quanta[i])
}

fn of_127ths(n: [i8; 3]) -> [f64; 3] {
    n.map(|c| f64::from(c) / 127.0)
}

/// The numbers of a model that is made in a shape.
fn shaped(exact: &Exact, map: &LinearMap) -> Result<Exact, ViewError> {
    matrix(map)?;
    let unevenness = map.unevenness();
    if unevenness.is_infinite() {
        return Err(ViewError::Flat);
    }
    if unevenness > MOST_UNEVEN {
        return Err(ViewError::Uneven { unevenness, most: MOST_UNEVEN });
    }
    let points = |all: &[[f64; 3]]| all.iter().map(|&p| map.point(p)).collect();
    let normals = |all: &[[f64; 3]]| all.iter().map(|&n| map.normal(n)).collect();
    let faces = Faces { positions: points(&exact.faces.positions), ..exact.faces.clone() };
    Ok(Exact {
        positions: points(&exact.positions),
        vertex_normals: normals(&exact.vertex_normals),
        face_normals: normals(&exact.face_normals),
        faces: if map.determinant() < 0.0 { turned_over(faces) } else { faces },
        ..exact.clone()
    })
}

/// The numbers of a model on the way to another shape.
fn between(exact: &Exact, to: &Shape, between: Between) -> Exact {
    type All = [[f64; 3]];
    let pairs = |from: &All, to: &All, blend: fn(&Between, [f64; 3], [f64; 3]) -> [f64; 3]| {
        from.iter().zip(to).map(|(&from, &to)| blend(&between, from, to)).collect()
    };
    let positions = pairs(&exact.faces.positions, &to.face_positions, Between::point);
    Exact {
        positions: pairs(&exact.positions, &to.exact_positions, Between::point),
        vertex_normals: pairs(&exact.vertex_normals, &to.exact_vertex_normals, Between::normal),
        face_normals: pairs(&exact.face_normals, &to.exact_face_normals, Between::normal),
        faces: Faces { positions, ..exact.faces.clone() },
        ..exact.clone()
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
