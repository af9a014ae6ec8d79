//! Spheres and squares of any number of triangles, made where they are drawn: as constants they
//! would fill the flash.

use core::cell::RefCell;

use critical_section::Mutex;
use rasterizer::{
    mesh::{Material, Mesh, Normals, Positions, Tables, Triangles},
    numbers::{Scale, Turn},
};

use crate::cost::fail;

/// Quanta in a unit, and their logarithm.
const UNIT: i32 = 1 << UNIT_BITS;
const UNIT_BITS: u32 = 14;

/// A surface of up to `VERTICES` vertices, with their normals, and `TRIANGLES` triangles.
#[derive(Debug)]
pub struct Surface<const VERTICES: usize, const TRIANGLES: usize> {
    positions: [[i16; 3]; VERTICES],
    normals: [[i8; 3]; VERTICES],
    triangles: [[u16; 3]; TRIANGLES],
    material: [Material; 1],
    vertex_count: u16,
    triangle_count: u32,
}

/// A surface in a static, lent to one at a time.
pub type Shared<const VERTICES: usize, const TRIANGLES: usize> =
    Mutex<RefCell<Surface<VERTICES, TRIANGLES>>>;

impl<const VERTICES: usize, const TRIANGLES: usize> Surface<VERTICES, TRIANGLES> {
    /// For a static: no surface yet.
    #[must_use]
    pub const fn shared() -> Shared<VERTICES, TRIANGLES> {
        Mutex::new(RefCell::new(Self {
            positions: [[0; 3]; VERTICES],
            normals: [[0; 3]; VERTICES],
            triangles: [[0; 3]; TRIANGLES],
            material: [Material::new([0; 3], 0)],
            vertex_count: 0,
            triangle_count: 0,
        }))
    }

    /// Makes a sphere of radius 1 with `parallels` circles between its poles: 2 `parallels`
    /// `meridians` triangles.
    ///
    /// # Panics
    ///
    /// Panics as [`square`](Self::square) does.
    pub fn sphere(&mut self, parallels: u16, meridians: u16) {
        self.clear();
        let (north, south) =
            (self.vertex([0, UNIT, 0], [0, 127, 0]), self.vertex([0, -UNIT, 0], [0, -127, 0]));
        for parallel in 1..=parallels {
            for meridian in 0..meridians {
                let colatitude = Turn::fraction(parallel.into(), 2 * u32::from(parallels + 1));
                let longitude = Turn::fraction(meridian.into(), meridians.into());
                let direction = [
                    colatitude.sin() * longitude.sin(),
                    colatitude.cos(),
                    colatitude.sin() * longitude.cos(),
                ];
                // From Q30, to the nearest.
                let to = |unit: i64| {
                    direction.map(|c| ((i64::from(c.to_bits()) * unit + (1 << 29)) >> 30) as i32)
                };
                self.vertex(to(UNIT.into()), to(127));
            }
        }
        let at =
            |parallel: u16, meridian: u16| 2 + (parallel - 1) * meridians + meridian % meridians;
        for meridian in 0..meridians {
            let next = meridian + 1;
            self.triangle([north, at(1, meridian), at(1, next)]);
            for parallel in 1..parallels {
                let [a, b] = [at(parallel, meridian), at(parallel, next)];
                let [c, d] = [at(parallel + 1, meridian), at(parallel + 1, next)];
                self.triangle([a, c, b]);
                self.triangle([b, c, d]);
            }
            self.triangle([south, at(parallels, next), at(parallels, meridian)]);
        }
    }

    /// Makes the square of side 2 that faces +z, of `cells` x `cells` cells: 2 `cells`<sup>2</sup>
    /// triangles.
    ///
    /// # Panics
    ///
    /// Panics if there is no room for its vertices or triangles.
    pub fn square(&mut self, cells: u16) {
        self.clear();
        let coordinate = |line: u16| 2 * UNIT * i32::from(line) / i32::from(cells) - UNIT;
        for row in 0..=cells {
            for column in 0..=cells {
                self.vertex([coordinate(column), -coordinate(row), 0], [0, 0, 127]);
            }
        }
        for row in 0..cells {
            for column in 0..cells {
                let a = row * (cells + 1) + column;
                let c = a + cells + 1;
                self.triangle([a, c, a + 1]);
                self.triangle([a + 1, c, c + 1]);
            }
        }
    }

    /// Returns the last surface as a mesh.
    ///
    /// # Panics
    ///
    /// Panics if there is none.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_> {
        let vertices = usize::from(self.vertex_count);
        let tables = Tables {
            positions: Positions::I16(&self.positions[..vertices]),
            scale: Scale::new(1 << 31, -31 - UNIT_BITS as i32),
            vertex_normals: Normals::I8(&self.normals[..vertices]),
            triangles: Triangles::U16(&self.triangles[..self.triangle_count as usize]),
            materials: &self.material,
            ..Tables::EMPTY
        };
        Mesh::new(tables).unwrap_or_else(fail)
    }

    const fn clear(&mut self) {
        self.vertex_count = 0;
        self.triangle_count = 0;
    }

    fn vertex(&mut self, position: [i32; 3], normal: [i32; 3]) -> u16 {
        let index = self.vertex_count;
        self.positions[usize::from(index)] = position.map(|c| c as i16);
        self.normals[usize::from(index)] = normal.map(|c| c as i8);
        self.vertex_count += 1;
        index
    }

    const fn triangle(&mut self, corners: [u16; 3]) {
        self.triangles[self.triangle_count as usize] = corners;
        self.triangle_count += 1;
        self.material[0] = Material::new([200, 160, 60], self.triangle_count);
    }
}
