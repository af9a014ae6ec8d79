//! Builds the OBJ text of a closed surface.

use std::fmt::Write as _;

/// A point in model units.
pub(super) type Point = [f64; 3];

/// An OBJ file under construction.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    text: String,
    points: usize,
    textures: usize,
}

/// The vertices of a closed curve, counted as OBJ counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    first: usize,
    length: usize,
}

impl Ring {
    const fn corner(self, place: usize) -> usize {
        self.first + place % self.length
    }
}

impl Surface {
    /// Starts a file; `library` is its MTL file.
    pub(super) fn new(comment: &str, library: &str) -> Self {
        Self { text: format!("# {comment}\nmtllib {library}\n"), points: 0, textures: 0 }
    }

    /// The finished text.
    pub(super) fn into_text(self) -> String {
        self.text
    }

    /// Adds a line.
    pub(super) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Sets the material of the faces that follow.
    pub(super) fn material(&mut self, name: &str) {
        self.line(&format!("usemtl {name}"));
    }

    /// Adds a vertex and returns its index.
    pub(super) fn point(&mut self, point: Point) -> usize {
        self.line(&format!("v {}", coordinates(&point)));
        self.points += 1;
        self.points
    }

    /// Adds the vertices of a closed curve.
    pub(super) fn ring(&mut self, points: impl IntoIterator<Item = Point>) -> Ring {
        let first = self.points + 1;
        for point in points {
            self.point(point);
        }
        Ring { first, length: self.points + 1 - first }
    }

    /// Adds texture coordinates and returns their index.
    pub(super) fn texture(&mut self, coordinates: [f64; 2]) -> usize {
        self.line(&format!("vt {}", self::coordinates(&coordinates)));
        self.textures += 1;
        self.textures
    }

    /// Adds a face with texture coordinates at its corners.
    pub(super) fn textured_face(&mut self, corners: impl IntoIterator<Item = (usize, usize)>) {
        let corners = corners.into_iter().map(|(point, texture)| format!(" {point}/{texture}"));
        self.line(&format!("f{}", corners.collect::<String>()));
    }

    /// Adds a face.
    pub(super) fn face(&mut self, corners: impl IntoIterator<Item = usize>) {
        self.text.push('f');
        for corner in corners {
            // Writing to a string cannot fail.
            let _ = write!(self.text, " {corner}");
        }
        self.text.push('\n');
    }

    /// Adds quads from one ring to the next. Seen from outside, the rings run counter-clockwise and
    /// `to` lies left of `from`.
    pub(super) fn band(&mut self, from: Ring, to: Ring) {
        for i in 0..from.length {
            self.face([from.corner(i), from.corner(i + 1), to.corner(i + 1), to.corner(i)]);
        }
    }

    /// Adds one polygon inside a ring that runs counter-clockwise seen from outside.
    pub(super) fn cap(&mut self, ring: Ring) {
        self.face((0..ring.length).map(|i| ring.corner(i)));
    }

    /// Adds one polygon inside a ring that runs clockwise seen from outside.
    pub(super) fn cap_reversed(&mut self, ring: Ring) {
        self.face((0..ring.length).rev().map(|i| ring.corner(i)));
    }

    /// Adds triangles from a ring to a point left of it.
    pub(super) fn tip(&mut self, ring: Ring, apex: usize) {
        for i in 0..ring.length {
            self.face([ring.corner(i), ring.corner(i + 1), apex]);
        }
    }
}

/// Numbers with four decimals: a twenty-thousandth of a unit is below the quantum of the tables
/// made from them.
pub(super) fn coordinates(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers
        .iter()
        // Rounded first, so that no -0.0000 is written.
        .map(|x| format!("{:.4}", (x * 1e4).round() / 1e4 + 0.0))
        .collect();
    texts.join(" ")
}

/// A material library.
pub(super) fn library(materials: &[(&str, [f64; 3])]) -> String {
    let mut text = String::new();
    for (name, [r, g, b]) in materials {
        let _ = writeln!(text, "newmtl {name}\nKd {r} {g} {b}");
    }
    text
}
