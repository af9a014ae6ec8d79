//! Checks an OBJ file line by line, and rewrites its statements in a form that the parser reads
//! correctly.
//!
//! The parser, `tobj` 4.0, names no line in its errors. Without an error it gives a wrong result if
//! faces leave out texture coordinates or normals that other faces have (it takes those of the
//! corner before), and it makes faces of polylines (`l`). It refuses comments behind numbers,
//! continued lines, tabs in `usemtl`, one-dimensional texture coordinates, vertex colours on some
//! vertices only, and faces that name a vertex further down. So it gets the same numbers, as
//! written, in plain order: positions, texture coordinates, normals, then faces with absolute
//! indices.

use std::{
    collections::{BTreeMap, HashMap},
    fmt::Write as _,
    path::Path,
};

use super::{
    Contents,
    elements::Elements,
    error::{LineFault, ModelError},
    ignored::Ignored,
    quote::quote,
    smoothing::Smoothing,
    source::Statement,
    vertex_colors::VertexColors,
    warnings::Tally,
};

/// A file that has passed the checks.
#[derive(Clone, Debug, Default)]
pub(super) struct Checked {
    /// Its statements for `tobj`. The last normal is (0, 0, 0) and stands for "none"; the last
    /// texture coordinates are (0, 0), for the corners without. Where a vertex has a colour, all
    /// have one from 0 to 255, or NaN. The names of materials are their indices in
    /// [`materials`](Self::materials).
    pub text: String,
    /// Its lines and points.
    pub elements: Elements,
    /// `mtllib` statements: line and argument.
    pub libraries: Vec<(usize, Vec<u8>)>,
    /// `usemtl` statements: line and name, each name once.
    pub materials: Vec<(usize, Vec<u8>)>,
    /// The smoothing group of each face.
    pub smoothing: Vec<Smoothing>,
    /// The number of `v` lines.
    pub vertices: usize,
    /// The number of faces.
    pub faces: usize,
    /// The line of each face.
    pub face_lines: Vec<usize>,
    /// The number of face corners.
    pub corners: usize,
    /// How many of the corners have texture coordinates.
    pub textured_corners: usize,
    /// The first line with texture coordinates that are not finite and that a face uses, and the
    /// word, if the contents have no texture coordinates.
    pub broken_texture: Option<(usize, String)>,
    /// What the conversion ignores.
    pub warnings: Vec<String>,
}

/// How many positions, texture coordinates and normals there are.
#[derive(Clone, Copy, Default)]
struct Counts([usize; 3]);

const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

/// Checks all statements of the file at `path`, which is converted to `contents`.
pub(super) fn check(
    path: &Path,
    statements: &[Statement<'_>],
    contents: Contents,
) -> Result<Checked, ModelError> {
    let count = |keyword: &[u8]| statements.iter().filter(|s| s.keyword() == keyword).count();
    let total = Counts([count(b"v"), count(b"vt"), count(b"vn")]);
    if total.0[0] == 0 {
        return Err(ModelError::NoVertices { path: path.into() });
    }
    let mut checked = Checked { vertices: total.0[0], ..Checked::default() };
    let mut seen = Counts::default();
    let mut tables = [const { String::new() }; 3];
    let mut faces = String::new();
    let mut named = HashMap::new();
    let mut smoothing = Smoothing::Unstated;
    let mut material = None;
    let mut unused = Unused::default();
    let mut ignored = Ignored::default();
    let colors = VertexColors::of(path, statements, contents, &mut checked.warnings);
    for statement in statements {
        let at_line = |fault| ModelError::Line { path: path.into(), line: statement.line, fault };
        let mut coordinates = |table: usize, keyword, least, dimensions, behind: &str| {
            let row = numbers(statement, keyword, least, dimensions)?;
            seen.0[table] += 1;
            if let Some(word) = row.not_finite {
                unused.0[table].insert(seen.0[table], (statement.line, word.to_vec()));
            }
            // Writing to a string cannot fail.
            let _ = writeln!(tables[table], "{keyword} {}{behind}", row.words.join(" "));
            Ok(())
        };
        match statement.keyword() {
            b"v" => coordinates(0, "v", 3, 3, &colors.text(statement)).map_err(at_line)?,
            b"vt" => coordinates(1, "vt", 1, 2, "").map_err(at_line)?,
            b"vn" => coordinates(2, "vn", 3, 3, "").map_err(at_line)?,
            // `fo` is its name in older files.
            b"f" | b"fo" => {
                let corners = face(statement, seen, total).map_err(at_line)?;
                faces.push('f');
                for [v, vt, vn] in corners {
                    checked.corners += 1;
                    checked.textured_corners += usize::from(vt <= total.0[1]);
                    let _ = write!(faces, " {v}/{vt}/{vn}");
                }
                faces.push('\n');
                checked.smoothing.push(smoothing);
                checked.faces += 1;
                checked.face_lines.push(statement.line);
            }
            b"l" => {
                let vertices = vertices(statement, "l", 2, seen, total).map_err(at_line)?;
                checked.elements.add_lines(&vertices, material);
            }
            b"p" => {
                let vertices = vertices(statement, "p", 1, seen, total).map_err(at_line)?;
                checked.elements.add_points(&vertices, material);
            }
            b"s" => smoothing = Smoothing::of(statement).unwrap_or(smoothing),
            b"mtllib" => checked.libraries.push((statement.line, statement.name().into())),
            b"usemtl" if !statement.name().is_empty() => {
                let name = statement.name();
                let index = *named.entry(name).or_insert_with(|| {
                    checked.materials.push((statement.line, name.into()));
                    checked.materials.len() - 1
                });
                material = Some(index);
                let _ = writeln!(faces, "usemtl {index}");
            }
            _ => {}
        }
        ignored.count(path, statement);
    }
    let used = || checked.elements.used().map(|vertex| vertex + 1);
    if let Some((line, word)) = unused.first_used(&faces, used(), contents) {
        let fault = LineFault::NotFinite { word: quote(word) };
        return Err(ModelError::Line { path: path.into(), line, fault });
    }
    if checked.faces == 0 && checked.elements.is_empty() {
        return Err(ModelError::NoFaces { path: path.into() });
    }
    let textured = Contents { texture_coordinates: true, ..contents };
    checked.broken_texture =
        unused.first_used(&faces, used(), textured).map(|(line, word)| (line, quote(word)));
    checked.elements.read_vertices(statements, &colors);
    unused.warn(path, &mut checked.warnings);
    ignored.warn(&mut checked.warnings);
    let [v, vt, vn] = tables;
    checked.text = format!("mtllib materials\n{v}{vt}vt 0 0\n{vn}vn 0 0 0\n{faces}");
    Ok(checked)
}

/// The coordinates of a statement.
struct Row<'a> {
    /// As written; all 0 if one of them is not finite.
    words: Vec<&'a str>,
    /// The first word that is NaN or infinite.
    not_finite: Option<&'a [u8]>,
}

/// Checks and returns the first `dimensions` numbers of a statement. At least `least` of them must
/// be there; the others default to 0.
fn numbers<'a>(
    statement: &'a Statement<'_>,
    keyword: &'static str,
    least: usize,
    dimensions: usize,
) -> Result<Row<'a>, LineFault> {
    let mut row = Row { words: Vec::with_capacity(dimensions), not_finite: None };
    for word in statement.arguments().take(dimensions) {
        let text = str::from_utf8(word).unwrap_or_default();
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => row.words.push(text),
            Err(_) if !is_printed_nan(word) => {
                return Err(LineFault::NotANumber { word: quote(word) });
            }
            _ => {
                row.not_finite = row.not_finite.or(Some(word));
                row.words.push("0");
            }
        }
    }
    if row.words.len() < least {
        return Err(LineFault::TooFewNumbers { keyword, needed: least, found: row.words.len() });
    }
    if row.not_finite.is_some() {
        row.words.fill("0");
    }
    row.words.resize(dimensions, "0");
    Ok(row)
}

/// Whether a C library prints NaN or infinity like this. Microsoft's older one prints 1.#QNAN,
/// -1.#IND and 1.#INF, or rounds these to 1.#J and 1.$; its newer one prints -nan(ind).
fn is_printed_nan(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let start = word.get(..3).unwrap_or_default();
    matches!(word, [b'1', b'.' | b',', b'#' | b'$', ..])
        || start.eq_ignore_ascii_case(b"nan")
        || start.eq_ignore_ascii_case(b"inf")
}

/// Lines whose numbers are not finite: for each table, the rows from 1 with the line and the word.
#[derive(Default)]
struct Unused([BTreeMap<usize, (usize, Vec<u8>)>; 3]);

impl Unused {
    /// Returns the first line on which the result depends. `faces` are those for `tobj`, and
    /// `vertices` those of lines and points, from 1; without any of them, it is the first line of
    /// all.
    fn first_used(
        &self,
        faces: &str,
        vertices: impl Iterator<Item = usize>,
        contents: Contents,
    ) -> Option<(usize, &[u8])> {
        let all = || self.0.iter().flat_map(BTreeMap::values);
        let mut vertices = vertices.peekable();
        let used: Vec<&(usize, Vec<u8>)> = if faces.is_empty() && vertices.peek().is_none() {
            all().collect()
        } else if all().next().is_none() {
            Vec::new()
        } else {
            let is_kept = [true, contents.texture_coordinates, contents.vertex_normals];
            let corners = faces.split_ascii_whitespace().filter(|word| word.contains('/'));
            corners
                .flat_map(|corner| corner.split('/').enumerate())
                .filter(|&(table, _)| is_kept[table])
                .filter_map(|(table, index)| self.0[table].get(&index.parse().ok()?))
                .chain(vertices.filter_map(|vertex| self.0[0].get(&vertex)))
                .collect()
        };
        used.into_iter().min().map(|(line, word)| (*line, &word[..]))
    }

    fn warn(&self, path: &Path, warnings: &mut Vec<String>) {
        let mut lines: Vec<_> = self.0.iter().flat_map(BTreeMap::values).collect();
        lines.sort_unstable();
        let mut tally = Tally::default();
        for (line, word) in lines {
            tally.add_word(path, *line, word);
        }
        tally.warn(warnings, |tally| {
            let lines = tally.counted("line has", "lines have");
            let words = tally.examples();
            format!("{lines} a number that is not finite ({words}), which nothing uses: ignored")
        });
    }
}

/// Returns the corners of a face as absolute indices from 1. An index that a corner leaves out is
/// one past the end.
fn face(
    statement: &Statement<'_>,
    seen: Counts,
    total: Counts,
) -> Result<Vec<[usize; 3]>, LineFault> {
    let corners = corners(statement, seen, total)?;
    if corners.len() < 3 {
        return Err(LineFault::TooFewCorners { found: corners.len() });
    }
    Ok(corners)
}

/// Returns the vertices of a line or of points as absolute indices from 1, at least `needed`.
fn vertices(
    statement: &Statement<'_>,
    keyword: &'static str,
    needed: usize,
    seen: Counts,
    total: Counts,
) -> Result<Vec<usize>, LineFault> {
    let corners = corners(statement, seen, total).map_err(|fault| match fault {
        LineFault::BadCorner { corner } => LineFault::BadVertex { keyword, vertex: corner },
        fault => fault,
    })?;
    if corners.len() < needed {
        return Err(LineFault::TooFewVertices { keyword, needed, found: corners.len() });
    }
    Ok(corners.iter().map(|[vertex, ..]| *vertex).collect())
}

/// Returns corners as [`face`] does.
fn corners(
    statement: &Statement<'_>,
    seen: Counts,
    total: Counts,
) -> Result<Vec<[usize; 3]>, LineFault> {
    statement
        .arguments()
        .map(|corner| {
            let slashes = corner.iter().filter(|&&byte| byte == b'/').count();
            if slashes > 2 || corner.starts_with(b"/") {
                return Err(LineFault::BadCorner { corner: quote(corner) });
            }
            let mut indices = total.0.map(|count| count + 1);
            for (kind, part) in corner.split(|&byte| byte == b'/').enumerate() {
                if !part.is_empty() {
                    indices[kind] = index(corner, part, kind, seen.0[kind], total.0[kind])?;
                }
            }
            Ok(indices)
        })
        .collect()
}

/// Returns an absolute index from 1. A negative one counts back from the last of those `seen` so
/// far.
fn index(
    corner: &[u8],
    part: &[u8],
    kind: usize,
    seen: usize,
    total: usize,
) -> Result<usize, LineFault> {
    let number = str::from_utf8(part).ok().and_then(|part| part.parse().ok());
    let written: i64 = number.ok_or_else(|| LineFault::BadCorner { corner: quote(corner) })?;
    let (absolute, count) = match written {
        0 => return Err(LineFault::IndexZero { corner: quote(corner) }),
        1.. => (usize::try_from(written).ok().filter(|&i| i <= total), total),
        _ => {
            let back = usize::try_from(written.unsigned_abs()).ok();
            (back.and_then(|b| (seen + 1).checked_sub(b)).filter(|&i| i > 0), seen)
        }
    };
    absolute.ok_or_else(|| LineFault::IndexOutOfRange {
        corner: quote(corner),
        kind: KINDS[kind],
        index: written,
        count,
    })
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            elements::{Element, FileVertex},
            source::statements,
        },
        *,
    };

    const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    fn message(text: &str) -> String {
        let statements = statements(text.as_bytes());
        check(Path::new("m.obj"), &statements, Contents::default()).unwrap_err().to_string()
    }

    #[test]
    fn each_fault_names_its_line_and_what_to_do() {
        let cases = [
            ("# nothing\n", "m.obj has no vertices"),
            ("v 0 0 0\n", "m.obj has vertices but no faces"),
            ("v 0 0 0\nv 1 2\n", "m.obj:2: `v` needs 3 numbers and has 2: complete"),
            ("v 0 0 0\n\nvn 1\n", "m.obj:3: `vn` needs 3 numbers and has 1"),
            ("v 0 0 0\nvt\n", "m.obj:2: `vt` needs 1 numbers and has 0"),
            ("v 0 0,5 0\n", "m.obj:1: `0,5` is not a number: write it like 1.5"),
            ("v 0 nan 0\n", "m.obj:1: `nan` is not a finite number"),
            ("v 0 0 0\nv 0 0 1e999\n", "m.obj:2: `1e999` is not a finite number"),
            ("v 0 0 0\nvn 0 -inf 0\n", "m.obj:2: `-inf` is not a finite number"),
        ];
        for (text, expected) in cases {
            assert!(message(text).starts_with(expected), "{text:?}: {}", message(text));
        }
    }

    #[test]
    fn each_fault_of_a_face_names_its_line_and_what_to_do() {
        let cases = [
            ("f 1 2", ":4: a face needs 3 corners or more and has 2"),
            ("f 1 2 4", ":4: `4` names vertex 4, but there are 3"),
            ("f 1 2 -4", ":4: `-4` names vertex -4, but there are 3"),
            ("f 1 2 0", ":4: index 0 in `0`: OBJ counts from 1"),
            ("f 1 2 3/1", ":4: `3/1` names texture coordinate 1, but there are 0"),
            ("f 1 2 3//7", ":4: `3//7` names normal 7, but there are 0"),
            ("f 1 2 x", ":4: `x` is not a face corner: write whole numbers"),
            ("f 1 2 /1", ":4: `/1` is not a face corner"),
            ("f 1 2 3/1/1/1", ":4: `3/1/1/1` is not a face corner"),
            ("f 1 2 99999999999999999999", ":4: `99999999999999999999` is not a face corner"),
            ("f 1 \\\n2\nf 9 9 9", ":4: a face needs 3 corners"),
            ("f -1 -2 -9223372036854775808", ":4: `-9223372036854775808` names vertex"),
        ];
        for (face, expected) in cases {
            let text = format!("{TRIANGLE}{face}");
            assert!(message(&text).contains(expected), "{face:?}: {}", message(&text));
        }
    }

    #[test]
    fn each_fault_of_a_line_or_a_point_names_its_line_and_what_to_do() {
        let cases = [
            ("l 1", ":4: `l` needs 2 vertices or more and has 1: complete"),
            ("l", ":4: `l` needs 2 vertices or more and has 0"),
            ("p", ":4: `p` needs 1 vertices or more and has 0"),
            ("l 1 2 4", ":4: `4` names vertex 4, but there are 3"),
            ("l 1/1 2", ":4: `1/1` names texture coordinate 1, but there are 0"),
            ("l 1 0", ":4: index 0 in `0`: OBJ counts from 1"),
            ("l 1 x", ":4: `x` is not a vertex of `l`: write whole numbers"),
            ("p 1 -4", ":4: `-4` names vertex -4, but there are 3"),
            ("p 1.5", ":4: `1.5` is not a vertex of `p`"),
            ("v nan 0 0\np 4", ":4: `nan` is not a finite number"),
            ("v nan 0 0\nl 1 -1", ":4: `nan` is not a finite number"),
        ];
        for (element, expected) in cases {
            let text = format!("{TRIANGLE}{element}");
            assert!(message(&text).contains(expected), "{element:?}: {}", message(&text));
        }
    }

    #[test]
    fn statements_become_a_form_that_the_parser_reads_correctly() {
        let text = "v 0 0 0 0.5 # weight\nv 1 0 0 1 0 0\nv\t0 1 0\nvt 0.25\nvn 0 0 2\n\
                    l 1 2 3\np 1\nusemtl\tdark red\nf 1/1 2//1 -1/-1/-1\nl -2 4/1\nf 1 2 4\nv 5 5 5";
        let statements = statements(text.as_bytes());
        let checked = check(Path::new("m.obj"), &statements, Contents::default()).unwrap();
        assert_eq!(
            checked.text,
            "mtllib materials\nv 0 0 0 NaN NaN NaN\nv 1 0 0 255 0 0\nv 0 1 0 NaN NaN NaN\n\
             v 5 5 5 NaN NaN NaN\nvt 0.25 0\nvt 0 0\n\
             vn 0 0 2\nvn 0 0 0\nusemtl 0\nf 1/1/2 2/2/1 3/1/1\nf 1/2/2 2/2/2 4/2/2\n"
        );
        assert_eq!((checked.vertices, checked.faces), (4, 2));
        assert_eq!((checked.corners, checked.textured_corners), (6, 2));
        let line = |vertices, material| Element { vertices, material };
        let lines = [line([0, 1], None), line([1, 2], None), line([1, 3], Some(0))];
        assert_eq!(checked.elements.lines, lines);
        assert_eq!(checked.elements.points, [Element { vertices: [0], material: None }]);
        let vertex = |position, color| FileVertex { position, color };
        let vertices: Vec<_> = checked.elements.vertices.into_iter().collect();
        assert_eq!(
            vertices,
            [
                (0, vertex([0.0; 3], None)),
                (1, vertex([1.0, 0.0, 0.0], Some([255.0, 0.0, 0.0]))),
                (2, vertex([0.0, 1.0, 0.0], None)),
                (3, vertex([5.0; 3], None)),
            ]
        );
        assert_eq!(checked.materials, [(8, b"dark red".to_vec())]);
    }

    #[test]
    fn an_endless_word_is_shortened() {
        let text = format!("v 0 0 {}", "x".repeat(1_000_000));
        assert!(message(&text).len() < 200, "{} bytes", message(&text).len());
    }
}
