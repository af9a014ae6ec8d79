//! A mesh that changes its shape: further shapes of its vertices ([`Keyframes`]), and what lies
//! between two of them ([`Tween`]).
//!
//! All shapes share triangles, materials, texture coordinates and colours, the quantum and the
//! offset. The bounds are those of all shapes together. A blend of two is between them, so it is
//! within these bounds too, and nothing is measured while it is drawn.

use fixed::types::{U1F15, U16F16};

use super::{BoundingBox, Mesh, MeshError, Normals, Positions, Tables};
use crate::numbers::Direction;

/// How far a shape is on the way to another: Q1.15, where 0 is the first and 1 is the second. What
/// is over 1 counts as 1.
pub type Progress = U1F15;

/// Another shape of a mesh: the columns that differ from those of its [`Tables`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Keyframe<'a> {
    /// The vertices' positions in quanta of the mesh: as many as it has vertices.
    pub positions: Positions<'a>,
    /// The normals of the vertices: as many as the mesh has.
    pub vertex_normals: Normals<'a>,
    /// The normals of the triangles: as many as the mesh has.
    pub face_normals: Normals<'a>,
}

impl Keyframe<'_> {
    /// No positions and no normals.
    pub const EMPTY: Keyframe<'static> = Keyframe {
        positions: Positions::I16(&[]),
        vertex_normals: Normals::NONE,
        face_normals: Normals::NONE,
    };
}

impl<'a> Keyframe<'a> {
    /// The columns of a mesh.
    const fn of(tables: &Tables<'a>) -> Self {
        Self {
            positions: tables.positions,
            vertex_normals: tables.vertex_normals,
            face_normals: tables.face_normals,
        }
    }
}

/// A mesh and further shapes of it, checked: `host-tools convert a.obj b.obj` writes them.
///
/// ```
/// use rasterizer::mesh::{
///     Keyframe, Keyframes, Material, Mesh, Positions, Progress, Tables, Triangles,
/// };
///
/// static LOW: Mesh<'static> = Mesh::new_const(Tables {
///     positions: Positions::I16(&[[0, 0, 0], [10, 0, 0], [0, 4, 0]]),
///     triangles: Triangles::U8(&[[0, 1, 2]]),
///     materials: &[Material::new([255, 160, 0], 1)],
///     ..Tables::EMPTY
/// });
/// const HIGH: Keyframe<'static> = Keyframe {
///     positions: Positions::I16(&[[0, 0, 0], [10, 0, 0], [0, 9, 0]]),
///     ..Keyframe::EMPTY
/// };
/// static TREE: Keyframes<'static> = Keyframes::new_const(&LOW, &[HIGH]);
///
/// // Half grown.
/// let tween = TREE.between(0, 1, const { Progress::lit("0.5") });
/// assert!(tween.is_some_and(|tween| tween.position(2) == Some([0, 7, 0])));
/// assert_eq!(TREE.mesh().bounds().max, [10, 9, 0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Keyframes<'a> {
    /// The first shape, with the bounds of all.
    mesh: Mesh<'a>,
    further: &'a [Keyframe<'a>],
}

impl<'a> Keyframes<'a> {
    /// A mesh as shape 0, and further shapes from 1 on. Checks their lengths, and measures the
    /// bounds of all.
    ///
    /// # Errors
    ///
    /// Returns the first keyframe with a column that is not as long as the mesh's.
    pub const fn new(mesh: &Mesh<'a>, further: &'a [Keyframe<'a>]) -> Result<Self, MeshError> {
        let tables = mesh.tables();
        let mut bounds = *mesh.bounds();
        let mut index = 0;
        while index < further.len() {
            let Keyframe { positions, vertex_normals, face_normals } = &further[index];
            if positions.len() != tables.positions.len()
                || vertex_normals.len() != tables.vertex_normals.len()
                || face_normals.len() != tables.face_normals.len()
            {
                return Err(MeshError::KeyframeLength { keyframe: index });
            }
            bounds = bounds.union(&BoundingBox::of(positions.as_slice()));
            index += 1;
        }
        Ok(Self { mesh: mesh.within(bounds), further })
    }

    /// [`Keyframes::new`] for a `static` or a `const`, where a fault stops the compiler.
    ///
    /// # Panics
    ///
    /// Panics if a column is not as long as the mesh's. In a constant that is a compile error.
    #[must_use]
    pub const fn new_const(mesh: &Mesh<'a>, further: &'a [Keyframe<'a>]) -> Self {
        match Self::new(mesh, further) {
            Ok(keyframes) => keyframes,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// Shape 0 as a mesh, which can be drawn by itself. Its bounds are those of all shapes.
    #[must_use]
    pub const fn mesh(&self) -> &Mesh<'a> {
        &self.mesh
    }

    /// The number of shapes, at least 1.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.further.len() + 1
    }

    /// The shape of this number; `None` past the last one.
    fn keyframe(&self, index: usize) -> Option<Keyframe<'a>> {
        match index.checked_sub(1) {
            None => Some(Keyframe::of(self.mesh.tables())),
            Some(index) => self.further.get(index).copied(),
        }
    }

    /// What is between two shapes, or `None` if one of them does not exist.
    #[must_use]
    pub fn between(&self, from: usize, to: usize, progress: Progress) -> Option<Tween<'a>> {
        let Keyframe { positions, vertex_normals, face_normals } = self.keyframe(from)?;
        let tables = Tables { positions, vertex_normals, face_normals, ..*self.mesh.tables() };
        let factor = i32::from(progress.to_bits()).min(ONE);
        Some(Tween { mesh: Mesh { tables, ..self.mesh }, to: self.keyframe(to)?, factor })
    }

    /// The shape at a time of an animation that visits all shapes in turn, and then begins again:
    /// in Q16.16, where shape n is at n, and what lies between n and n + 1 between them. After the
    /// last shape comes the first one, at [`count`](Self::count).
    #[must_use]
    pub fn at(&self, time: U16F16) -> Tween<'a> {
        let (count, whole) = (self.count(), time.int().to_num::<usize>());
        // There is a shape at least.
        let from = whole.checked_rem(count).unwrap_or_default();
        let to = if from + 1 < count { from + 1 } else { 0 };
        let progress = Progress::from_bits((time.frac().to_bits() >> 1) as u16);
        // Both exist.
        self.between(from, to, progress).unwrap_or(Tween {
            mesh: self.mesh,
            to: Keyframe::of(self.mesh.tables()),
            factor: 0,
        })
    }
}

/// The factor of a whole way, in Q15.
const ONE: i32 = 1 << 15;

/// A shape between two [`Keyframes`], for a frame: [`Object::morphed`] draws it, like a mesh.
///
/// A position is the blend of both, rounded to a quantum of the mesh: within half of one along each
/// axis. (A converted model is 65,534 quanta long, so that is a hundredth of a pixel where it is
/// 650 pixels long.) A vertex is then placed as exactly as that of a mesh.
///
/// A normal has the direction of the blend of both, within 0.4 degrees, and 127 for its length as
/// those of tables, so that nothing gets dark halfway. It is that of the table at either end. On
/// the way it does not turn at an even speed; it is behind or ahead of one that does by up to 0.14
/// degrees where the two normals are 30 degrees apart, 1.1 at 60, 4.1 at 90 and 11 at 120. Of two
/// opposite normals it is the first up to the middle, none in the middle (the surface has ambient
/// light alone there), and then the second. Normals of faces are blended in the same way.
///
/// [`Object::morphed`]: crate::scene::Object::morphed
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Tween<'a> {
    /// With the tables of the first shape, and the bounds of all.
    mesh: Mesh<'a>,
    to: Keyframe<'a>,
    /// In Q15, 0 to 1.
    factor: i32,
}

impl<'a> Tween<'a> {
    /// The shape that it comes from, as a mesh. Its bounds are those of all shapes.
    #[must_use]
    pub const fn mesh(&self) -> &Mesh<'a> {
        &self.mesh
    }

    /// The position of vertex `index` in quanta of the mesh, or `None` past the end.
    #[must_use]
    pub fn position(&self, index: usize) -> Option<[i16; 3]> {
        let from = self.mesh.tables().positions.get(index)?;
        Some(self.position_from(from, index))
    }

    /// The position of a vertex that is at `from` in the first shape.
    #[inline(always)]
    pub(super) fn position_from(&self, from: [i16; 3], index: usize) -> [i16; 3] {
        let to = self.to.positions.get(index).unwrap_or(from);
        let blend = |from: i16, to: i16| {
            let (from, to) = (i32::from(from), i32::from(to));
            // The product is at most 65,535 * 2^15, and half a unit more is still below 2^31.
            (from + (((to - from) * self.factor + (ONE >> 1)) >> 15)) as i16
        };
        // codegen: not by `from_fn`, whose index is checked where the loop stays one.
        [blend(from[0], to[0]), blend(from[1], to[1]), blend(from[2], to[2])]
    }

    /// The normal of a vertex that is `from` in the first shape.
    #[inline(always)]
    pub(super) fn vertex_normal(&self, from: [i8; 3], index: usize) -> [i8; 3] {
        self.normal(from, self.to.vertex_normals.get(index))
    }

    /// The normal of a triangle that is `from` in the first shape.
    #[inline(always)]
    pub(super) fn face_normal(&self, from: [i8; 3], index: usize) -> [i8; 3] {
        self.normal(from, self.to.face_normals.get(index))
    }

    // codegen: one function for vertices and faces, which is called.
    #[inline(never)]
    fn normal(&self, from: [i8; 3], to: Option<[i8; 3]>) -> [i8; 3] {
        let to = to.unwrap_or(from);
        match self.factor {
            0 => from,
            ONE => to,
            factor => {
                let blend = core::array::from_fn(|axis| {
                    i32::from(from[axis]) * (ONE - factor) + i32::from(to[axis]) * factor
                });
                Direction::of(blend).in_127ths()
            }
        }
    }
}

/// What an object makes of its mesh's vertices and normals, besides its pose.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Changes<'a> {
    // codegen: constants where there is no such change, as all that reads them is inlined.
    /// A blend with another shape.
    pub(crate) tween: Option<&'a Tween<'a>>,
    /// A matrix, after that.
    pub(crate) shaping: Option<&'a super::Shaping>,
}

impl Changes<'_> {
    /// None.
    pub(crate) const NONE: Self = Self { tween: None, shaping: None };

    /// Where the matrix puts a position.
    #[inline(always)]
    pub(super) fn position(&self, position: [i16; 3]) -> [i16; 3] {
        self.shaping.map_or(position, |shaping| shaping.position(position))
    }

    /// What the matrix makes of a normal.
    #[inline(always)]
    pub(super) fn normal(&self, normal: [i8; 3]) -> [i8; 3] {
        self.shaping.map_or(normal, |shaping| shaping.normal(normal))
    }
}
