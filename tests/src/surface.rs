//! Meshes for tests: sheets, fans, random triangulations, and closed bodies.

use rasterizer::{
    mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
    numbers::{Scale, Vec3},
};

use crate::Random;

/// A mesh in memory, in one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    positions: Vec<[i16; 3]>,
    triangles: Vec<[u16; 3]>,
    vertex_normals: Vec<[i8; 3]>,
    materials: [Material; 1],
    /// The length of a quantum.
    pub scale: Scale,
    /// Where position (0, 0, 0) lies.
    pub offset: Vec3,
}

impl Surface {
    /// A surface of these positions and triangles, with a quantum of one unit.
    #[must_use]
    pub const fn new(positions: Vec<[i16; 3]>, triangles: Vec<[u16; 3]>) -> Self {
        let materials = [Material::new([200, 100, 50], triangles.len() as u32)];
        Self {
            positions,
            triangles,
            vertex_normals: vec![],
            materials,
            scale: Scale::ONE,
            offset: Vec3::ZERO,
        }
    }

    /// The same surface with a quantum of 2^`exponent` units.
    #[must_use]
    pub fn scaled(self, exponent: i32) -> Self {
        let scale = Scale::new(1, exponent);
        Self { scale, ..self }
    }

    /// The same surface in another colour.
    #[must_use]
    pub const fn colored(mut self, color: [u8; 3]) -> Self {
        self.materials[0].color = color;
        self
    }

    /// The same surface with normals that point away from the origin.
    #[must_use]
    pub fn with_vertex_normals(mut self) -> Self {
        let outwards = |p: &[i16; 3]| {
            let length = p.map(|c| f64::from(c).powi(2)).iter().sum::<f64>().sqrt().max(1.0);
            p.map(|c| (f64::from(c) / length * 127.0).round() as i8)
        };
        self.vertex_normals = self.positions.iter().map(outwards).collect();
        self
    }

    /// The same surface seen from behind: the corners of all triangles in reverse.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.triangles.iter_mut().for_each(|triangle| triangle.reverse());
        self
    }

    /// The same surface, each triangle starting with a random one of its corners.
    #[must_use]
    pub fn rotated(mut self, random: &mut Random) -> Self {
        let triangles = self.triangles.iter_mut();
        triangles.for_each(|triangle| triangle.rotate_left((random.bits() % 3) as usize));
        self
    }

    /// The mesh of this surface.
    ///
    /// # Panics
    ///
    /// Panics if the tables are invalid.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh::new_const(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            offset: self.offset,
            vertex_normals: Normals::I8(&self.vertex_normals),
            triangles: Triangles::U16(&self.triangles),
            materials: &self.materials,
            ..Tables::EMPTY
        })
    }

    /// The rectangle from (`x[0]`, `y[0]`) to (`x[1]`, `y[1]`) in the plane z = 0. It has
    /// `cells[0]` columns and `cells[1]` rows of cells, each cut in two along a random diagonal.
    /// The corners of the cells are moved by up to a fifth of a cell, so that all cells stay
    /// convex; those on the border stay on it.
    #[must_use]
    pub fn sheet(x: [i16; 2], y: [i16; 2], cells: [usize; 2], random: &mut Random) -> Self {
        let mut place = |range: [i16; 2], cells: usize, index: usize| {
            let [from, to] = range.map(i32::from);
            let length = to - from;
            let exact = from + (i64::from(length) * index as i64 / cells as i64) as i32;
            let jitter = length / (5 * cells as i32);
            if index == 0 || index == cells {
                exact as i16
            } else {
                (exact + random.within(-jitter, jitter)) as i16
            }
        };
        let [columns, rows] = cells;
        let mut positions = vec![];
        for row in 0..=rows {
            for column in 0..=columns {
                positions.push([place(x, columns, column), place(y, rows, row), 0]);
            }
        }
        let mut triangles = vec![];
        for row in 0..rows {
            for column in 0..columns {
                let a = (row * (columns + 1) + column) as u16;
                let (b, c, d) = (a + 1, a + columns as u16 + 2, a + columns as u16 + 1);
                triangles.extend(if random.coin() {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                });
            }
        }
        Self::new(positions, triangles).rotated(random)
    }

    /// Triangles round a hub. The rim runs counter-clockwise.
    #[must_use]
    pub fn fan(hub: [i16; 3], rim: &[[i16; 3]]) -> Self {
        let positions = std::iter::once(hub).chain(rim.iter().copied()).collect();
        let count = rim.len() as u16;
        let triangles = (0..count).map(|i| [0, i + 1, (i + 1) % count + 1]).collect();
        Self::new(positions, triangles)
    }

    /// A square of this half width in the plane z = 0, cut by random points: each splits the
    /// triangle that contains it in three.
    #[must_use]
    pub fn shattered(half: i16, points: usize, random: &mut Random) -> Self {
        let mut positions =
            vec![[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]];
        let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
        while positions.len() < points + 4 {
            let limit = i32::from(half);
            let p = [random.within(-limit, limit) as i16, random.within(-limit, limit) as i16, 0];
            let left_of = |a: u16, b: u16| {
                let [a, b, p] = [positions[usize::from(a)], positions[usize::from(b)], p]
                    .map(|p| p.map(i64::from));
                (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0
            };
            let holds = |&[a, b, c]: &[u16; 3]| left_of(a, b) && left_of(b, c) && left_of(c, a);
            // A point on an edge or on another point is skipped.
            if let Some(index) = triangles.iter().position(holds) {
                let ([a, b, c], n) = (triangles.swap_remove(index), positions.len() as u16);
                positions.push(p);
                triangles.extend([[a, b, n], [b, c, n], [c, a, n]]);
            }
        }
        Self::new(positions, triangles).rotated(random)
    }

    /// A cube round the origin, each side in `cells` times `cells` squares.
    #[must_use]
    pub fn cube(half: i16, cells: usize) -> Self {
        let (mut positions, mut triangles) = (vec![], vec![]);
        let along = |index: usize| {
            (i32::from(half) * (2 * index as i32 - cells as i32) / cells as i32) as i16
        };
        for axis in 0..3 {
            for side in [half, -half] {
                let first = positions.len() as u16;
                for row in 0..=cells {
                    for column in 0..=cells {
                        let mut p = [0; 3];
                        p[axis] = side;
                        p[(axis + 1) % 3] = along(column);
                        p[(axis + 2) % 3] = along(row);
                        positions.push(p);
                    }
                }
                for row in 0..cells {
                    for column in 0..cells {
                        let a = first + (row * (cells + 1) + column) as u16;
                        let (b, c, d) = (a + 1, a + cells as u16 + 2, a + cells as u16 + 1);
                        triangles.extend(if side > 0 {
                            [[a, b, c], [a, c, d]]
                        } else {
                            [[a, c, b], [a, d, c]]
                        });
                    }
                }
            }
        }
        Self::new(positions, triangles)
    }

    /// A ball: [`cube`](Self::cube) with its vertices moved to `radius`.
    #[must_use]
    pub fn ball(radius: i16, cells: usize) -> Self {
        let mut ball = Self::cube(radius, cells);
        for p in &mut ball.positions {
            let length = p.map(|c| f64::from(c).powi(2)).iter().sum::<f64>().sqrt();
            *p = p.map(|c| (f64::from(c) / length * f64::from(radius)).round() as i16);
        }
        ball
    }
}

/// Whether a mesh is closed: its triangles traverse every edge, identified by the positions of its
/// ends, equally often in both directions.
#[must_use]
pub fn is_closed(mesh: &Mesh<'_>) -> bool {
    let tables = mesh.tables();
    let mut balance = std::collections::HashMap::new();
    for [a, b, c] in (0..).map_while(|index| tables.triangles.get(index)) {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = (tables.positions.get(from), tables.positions.get(to));
            *balance.entry((from, to)).or_insert(0i32) += 1;
            *balance.entry((to, from)).or_insert(0) -= 1;
        }
    }
    balance.values().all(|&count| count == 0)
}

/// Each edge of a mesh's triangles once, by its vertices.
///
/// # Panics
///
/// Panics if the mesh has over 65,536 vertices.
#[must_use]
pub fn edges(mesh: &Mesh<'_>) -> Vec<[u16; 2]> {
    let triangles = mesh.tables().triangles;
    let corners = (0..).map_while(|index| triangles.get(index));
    let mut edges: Vec<_> = corners
        .map(|corners| corners.map(|corner| u16::try_from(corner).unwrap()))
        .flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}
