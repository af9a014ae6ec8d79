//! A mesh whose vertices move: their positions and normals are in RAM, and change from frame to
//! frame.
//!
//! What does not change is checked once: indices, materials, the lengths of all columns. What
//! changes is set through [`MovingMesh`], which keeps every position in a range that was stated
//! before. So the mesh of a frame ([`MovingMesh::mesh`]) is there without a look at its vertices.

use super::{BoundingBox, Mesh, MeshError, Normals, Positions, Tables, check};
use crate::numbers::Direction;

/// The columns of a [`MovingMesh`] that change.
#[derive(Debug, Default, PartialEq, Eq, Hash)]
pub struct Moving<'a> {
    /// The vertices' positions in quanta.
    pub positions: &'a mut [[i16; 3]],
    /// The normal of each vertex: none, or as many as `positions`.
    pub vertex_normals: &'a mut [[i8; 3]],
    /// The normal of each triangle: none, or as many as there are triangles.
    pub face_normals: &'a mut [[i8; 3]],
}

/// A mesh whose vertices move.
///
/// No value that it is given makes it unsafe to draw: positions beyond its range are moved to the
/// nearest point of the range, and normals may have any direction. Vertices are placed as exactly
/// as those of any mesh with the range as its bounds: state it as narrow as the motion is. The
/// range also decides whether the mesh is taken to be out of view, and
/// ([`PoseError`](crate::geometry::PoseError)) how near it may come.
///
/// ```
/// use rasterizer::mesh::{
///     BoundingBox, Material, MeshError, Moving, MovingMesh, Tables, Triangles,
/// };
/// use rasterizer::numbers::Scale;
///
/// /// A bar of a graph, whose two upper vertices move.
/// const BAR: Tables<'static> = Tables {
///     scale: Scale::new(1, -8),
///     triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
///     materials: &[Material::new([90, 200, 120], 2)],
///     ..Tables::EMPTY
/// };
/// const RANGE: BoundingBox = BoundingBox { min: [0, 0, 0], max: [40, 256, 0] };
///
/// let mut positions = [[0, 0, 0], [40, 0, 0], [40, 0, 0], [0, 0, 0]];
/// let moving = Moving { positions: &mut positions, ..Moving::default() };
/// let mut bar = MovingMesh::new(BAR, moving, RANGE)?;
/// for (vertex, x) in [(2, 40), (3, 0)] {
///     // There is nothing above 256.
///     bar.set_position(vertex, [x, 999, 0]);
/// }
/// assert_eq!(bar.mesh().tables().positions.get(3), Some([0, 256, 0]));
/// # Ok::<(), MeshError>(())
/// ```
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct MovingMesh<'a> {
    /// Without the columns that change.
    tables: Tables<'a>,
    moving: Moving<'a>,
    range: BoundingBox,
}

impl<'a> MovingMesh<'a> {
    /// A mesh of columns that stay, those of `tables`, and of columns that change; those of them
    /// that `tables` has are not read. Positions beyond the range are moved to it.
    ///
    /// # Errors
    ///
    /// Returns the first fault of the tables, as [`Mesh::new`] does.
    pub fn new(
        tables: Tables<'a>,
        moving: Moving<'a>,
        range: BoundingBox,
    ) -> Result<Self, MeshError> {
        check::tables(&with_columns(&tables, &moving))?;
        // The least coordinates first.
        let range = BoundingBox::of(&[range.min, range.max]);
        let mut mesh = Self { tables, moving, range };
        mesh.update(|_, position| position);
        Ok(mesh)
    }

    /// The mesh as it is now, to be drawn. This takes no look at any vertex.
    #[must_use]
    pub const fn mesh(&self) -> Mesh<'_> {
        let tables = with_columns(&self.tables, &self.moving);
        Mesh { tables, bounds: self.range, spare_bits: self.range.spare_bits() }
    }

    /// The range of positions.
    #[must_use]
    pub const fn range(&self) -> &BoundingBox {
        &self.range
    }

    /// Moves a vertex, to the nearest point of the range. Returns whether there is such a vertex.
    pub fn set_position(&mut self, vertex: usize, position: [i16; 3]) -> bool {
        let inside = nearest(&self.range, position);
        self.moving.positions.get_mut(vertex).map(|place| *place = inside).is_some()
    }

    /// Moves all vertices: `change` gets the number and the position of each, and returns where it
    /// is then, of which the nearest point of the range is taken.
    pub fn update(&mut self, mut change: impl FnMut(usize, [i16; 3]) -> [i16; 3]) {
        for (vertex, position) in self.moving.positions.iter_mut().enumerate() {
            *position = nearest(&self.range, change(vertex, *position));
        }
    }

    /// Gives a vertex the normal along a direction of any length below 2<sup>31</sup> in each
    /// coordinate; zero for a zero vector. It is within 0.4 degrees of it. Returns whether the mesh
    /// has a normal of that vertex.
    pub fn set_vertex_normal(&mut self, vertex: usize, direction: [i32; 3]) -> bool {
        let place = self.moving.vertex_normals.get_mut(vertex);
        place.map(|normal| *normal = Direction::of(direction).in_127ths()).is_some()
    }

    /// Computes the normals of all triangles from the positions of their corners, if the mesh has
    /// such normals: within 0.4 degrees, and zero for a triangle without area.
    pub fn update_face_normals(&mut self) {
        let positions = &*self.moving.positions;
        for (triangle, normal) in self.moving.face_normals.iter_mut().enumerate() {
            let corners = self.tables.triangles.get(triangle).unwrap_or_default();
            let [a, b, c] =
                corners.map(|corner| positions.get(corner).copied().unwrap_or_default());
            let side = |to: [i16; 3]| {
                core::array::from_fn(|axis| i64::from(to[axis]) - i64::from(a[axis]))
            };
            let ([a, b, c], [d, e, f]): ([i64; 3], [i64; 3]) = (side(b), side(c));
            let across = [b * f - c * e, c * d - a * f, a * e - b * d];
            // Below 2^35. The largest gets 31 bits at most.
            let all = across.iter().fold(0, |all, c| all | c.unsigned_abs());
            let down = 34_u32.saturating_sub(all.leading_zeros());
            *normal = Direction::of(across.map(|c| (c >> down) as i32)).in_127ths();
        }
    }
}

/// The tables with the columns that change.
const fn with_columns<'t>(tables: &Tables<'t>, moving: &'t Moving<'_>) -> Tables<'t> {
    Tables {
        positions: Positions::I16(moving.positions),
        vertex_normals: Normals::I8(moving.vertex_normals),
        face_normals: Normals::I8(moving.face_normals),
        ..*tables
    }
}

/// The point of a box that is nearest to a position.
fn nearest(range: &BoundingBox, position: [i16; 3]) -> [i16; 3] {
    core::array::from_fn(|axis| position[axis].max(range.min[axis]).min(range.max[axis]))
}
