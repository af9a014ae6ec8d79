//! What the conversion changes, and the memory of its result.

use std::fmt;

/// The figures of a conversion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Report {
    /// Vertices (`v` lines) in the file.
    pub file_vertices: usize,
    /// Faces of three corners or more in the file.
    pub file_faces: usize,
    /// Vertices in the tables.
    pub vertices: usize,
    /// Triangles in the tables.
    pub triangles: usize,
    /// Lines (`l`) in the tables.
    pub lines: usize,
    /// Points (`p`) in the tables.
    pub points: usize,
    /// Triangles left out because they have no area.
    pub dropped_triangles: usize,
    /// What it costs to have fewer triangles; `None` if the model has all of the file's.
    #[cfg_attr(feature = "cli", serde(skip_serializing_if = "Option::is_none"))]
    pub simplification: Option<Simplification>,
    /// Faces turned over to mend the winding.
    pub turned_faces: usize,
    /// Whether normals follow the file's smoothing groups.
    pub smoothing_groups: bool,
    /// The diagonal of the bounding box in model units.
    pub size: f64,
    /// The longest distance between a vertex and its quantised position, in model units.
    pub position_error_max: f64,
    /// The root of the mean square of these distances, in model units.
    pub position_error_rms: f64,
    /// The largest angle between a vertex or face normal and its quantised form, in degrees.
    pub normal_error_degrees: f64,
    /// The largest error of a texture coordinate, in repeats of the texture.
    pub texture_error: f64,
    /// Vertices transformed per triangle with a first-in-first-out cache of 16, in the file's
    /// order.
    pub cache_misses_before: f64,
    /// The same in the tables' order.
    pub cache_misses: f64,
    /// The bytes of the tables.
    pub flash: Flash,
}

/// How far a surface of fewer triangles lies from the one of the file, in units of the file.
///
/// Distances are measured both ways: from about 50,000 points of each surface, evenly spread over
/// its area, and from its corners and the middles of its edges, to the nearest point of the other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Simplification {
    /// Triangles with an area before.
    pub triangles_before: usize,
    /// The longest distance.
    pub distance_max: f64,
    /// The root of the mean square of the distances over both surfaces.
    pub distance_rms: f64,
    /// The diagonal of the bounding box of the file's faces.
    pub size: f64,
}

impl Simplification {
    /// A distance in percent of the size.
    #[must_use]
    pub fn percent_of_size(&self, distance: f64) -> f64 {
        distance / self.size * 100.0
    }
}

/// The bytes that each table takes in flash.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "cli", derive(serde::Serialize))]
pub struct Flash {
    /// Three `i16` a vertex.
    pub positions: usize,
    /// Three `i8` a vertex.
    pub vertex_normals: usize,
    /// Three `i8` a triangle.
    pub face_normals: usize,
    /// Two `i16` or `i32` a vertex.
    pub texture_coordinates: usize,
    /// Three `u8` a vertex.
    pub vertex_colors: usize,
    /// Three `u8` or `u16` a triangle.
    pub triangles: usize,
    /// Two `u8` or `u16` an edge.
    pub edges: usize,
    /// Two `u8` or `u16` a line.
    pub lines: usize,
    /// One `u8` or `u16` a point.
    pub points: usize,
    /// One `Material` each.
    pub materials: usize,
    /// One `Finish` each.
    pub finishes: usize,
    /// Texels, palettes and planes of alpha.
    pub textures: usize,
    /// Positions and normals of further shapes.
    pub keyframes: usize,
}

impl Flash {
    /// The tables by name.
    #[must_use]
    pub const fn tables(&self) -> [(&'static str, usize); 13] {
        [
            ("positions", self.positions),
            ("vertex_normals", self.vertex_normals),
            ("face_normals", self.face_normals),
            ("texture_coordinates", self.texture_coordinates),
            ("vertex_colors", self.vertex_colors),
            ("triangles", self.triangles),
            ("edges", self.edges),
            ("lines", self.lines),
            ("points", self.points),
            ("materials", self.materials),
            ("finishes", self.finishes),
            ("textures", self.textures),
            ("keyframes", self.keyframes),
        ]
    }

    /// The bytes of all tables. The `Mesh` that refers to them takes some 120 bytes more.
    #[must_use]
    pub fn total(&self) -> usize {
        self.tables().iter().map(|(_, bytes)| bytes).sum()
    }
}

impl Report {
    /// `error`, a length in model units, in percent of the model's size.
    #[must_use]
    pub fn percent_of_size(&self, error: f64) -> f64 {
        error / self.size * 100.0
    }
}

impl fmt::Display for Report {
    /// Writes one figure per line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Vertices: {}, in the file {}",
            thousands(self.vertices),
            thousands(self.file_vertices)
        )?;
        writeln!(
            f,
            "Triangles: {}, in the file {} faces; left out as they have no area: {}",
            thousands(self.triangles),
            thousands(self.file_faces),
            thousands(self.dropped_triangles)
        )?;
        if let Some(simplified) = &self.simplification {
            writeln!(
                f,
                "Simplified from {} triangles: the surfaces lie at most {:.3e} units of the file \
                 apart ({:.3} % of the size), {:.3e} root mean square ({:.3} %), sampled both ways",
                thousands(simplified.triangles_before),
                simplified.distance_max,
                simplified.percent_of_size(simplified.distance_max),
                simplified.distance_rms,
                simplified.percent_of_size(simplified.distance_rms)
            )?;
        }
        for (count, name) in [(self.lines, "Lines"), (self.points, "Points")] {
            if count > 0 {
                writeln!(f, "{name}: {}", thousands(count))?;
            }
        }
        if self.turned_faces > 0 {
            writeln!(f, "Faces turned over: {}", thousands(self.turned_faces))?;
        }
        writeln!(f, "Size (diagonal of the bounding box): {:.4} units", self.size)?;
        writeln!(
            f,
            "Position error: {:.2e} units at most ({:.5} % of the size), \
             {:.2e} root mean square ({:.5} %)",
            self.position_error_max,
            self.percent_of_size(self.position_error_max),
            self.position_error_rms,
            self.percent_of_size(self.position_error_rms)
        )?;
        if self.flash.vertex_normals + self.flash.face_normals > 0 {
            writeln!(f, "Normal error: {:.3} degrees at most", self.normal_error_degrees)?;
        }
        if self.smoothing_groups {
            writeln!(f, "Normals follow the file's smoothing groups")?;
        }
        if self.flash.texture_coordinates > 0 {
            writeln!(
                f,
                "Texture coordinate error: {:.2e} of a repeat at most",
                self.texture_error
            )?;
        }
        if self.triangles > 0 {
            writeln!(
                f,
                "Vertices transformed per triangle (cache of 16): {:.3}, in the file's order {:.3}",
                self.cache_misses, self.cache_misses_before
            )?;
        }
        writeln!(f, "Flash: {} bytes", thousands(self.flash.total()))?;
        const RARE: [&str; 7] =
            ["vertex_colors", "edges", "lines", "points", "finishes", "textures", "keyframes"];
        let is_shown = |&(name, bytes): &(&str, usize)| !RARE.contains(&name) || bytes > 0;
        for (name, bytes) in self.flash.tables().into_iter().filter(is_shown) {
            writeln!(f, "  {name:<20}{:>10}", thousands(bytes))?;
        }
        Ok(())
    }
}

/// Writes 1234567 as 1,234,567.
#[must_use]
pub fn thousands(number: usize) -> String {
    grouped(number, ',')
}

/// A number with its digits in groups of three.
pub(super) fn grouped(number: usize, separator: char) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(separator);
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped() {
        assert_eq!(thousands(0), "0");
        assert_eq!(thousands(999), "999");
        assert_eq!(thousands(123_456), "123,456");
        assert_eq!(grouped(1_234_567, '_'), "1_234_567");
    }

    #[test]
    fn figures_of_absent_tables_are_not_shown() {
        let mut report = Report { size: 2.0, position_error_max: 1e-5, ..Report::default() };
        let text = report.to_string();
        assert!(text.contains("1.00e-5 units at most (0.00050 % of the size)"), "{text}");
        assert!(!text.contains("Normal") && !text.contains("Texture"), "{text}");
        assert!(!text.contains("smoothing"), "{text}");
        report.smoothing_groups = true;
        assert!(report.to_string().contains("Normals follow the file's smoothing groups"));
        report.flash.vertex_normals = 3;
        report.flash.texture_coordinates = 4;
        let text = report.to_string();
        assert!(
            text.contains("Normal error") && text.contains("Texture coordinate error"),
            "{text}"
        );
        assert!(text.contains("Flash: 7 bytes"), "{text}");
    }
}
