//! The lines (`l`) and points (`p`) of a file: from its statements to the vertices of the tables.
//!
//! A statement `l v1 v2 v3 ...` is a line from each of its vertices to the next, `p v1 v2 ...` a
//! point at each. A vertex may have texture coordinates (`l v1/vt1 ...`), which are checked and not
//! kept. Materials and smoothing are as for faces: `usemtl` holds for what comes after it.

use std::collections::{BTreeMap, HashSet};

use rustc_hash::FxHashMap;

use super::{
    keyframes, polygons::Polygons, source::Statement, vector::Vector, vertex_colors::VertexColors,
    weld::Welded,
};

/// A line of two vertices or a point of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Element<V, M, const N: usize> {
    pub vertices: [V; N],
    pub material: M,
}

/// The elements of a file by their vertices, from 0, and by the index of the material's name, which
/// those before the first `usemtl` do not have.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Elements {
    pub lines: Vec<Element<usize, Option<usize>, 2>>,
    pub points: Vec<Element<usize, Option<usize>, 1>>,
    /// The vertices that they use.
    pub vertices: BTreeMap<usize, FileVertex>,
}

/// A vertex of the file: its place, and its colour from 0 to 255 if it has one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FileVertex {
    pub position: Vector,
    pub color: Option<Vector>,
}

/// The place of a vertex and its colour, as indices: see
/// [`Corner`](super::polygons::Corner).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct End {
    pub position: u32,
    pub color: u32,
}

/// An element by indices of positions, colours and materials of [`Polygons`].
pub(super) type Drawn<const N: usize> = Element<End, usize, N>;

impl Elements {
    pub(super) const fn is_empty(&self) -> bool {
        self.lines.is_empty() && self.points.is_empty()
    }

    /// Adds the lines of a statement by its vertices, from 1.
    pub(super) fn add_lines(&mut self, vertices: &[usize], material: Option<usize>) {
        let ends = vertices.windows(2).map(|pair| [pair[0] - 1, pair[1] - 1]);
        self.lines.extend(ends.map(|vertices| Element { vertices, material }));
    }

    /// Adds the points of a statement by its vertices, from 1.
    pub(super) fn add_points(&mut self, vertices: &[usize], material: Option<usize>) {
        let places = vertices.iter().map(|&vertex| [vertex - 1]);
        self.points.extend(places.map(|vertices| Element { vertices, material }));
    }

    /// Every vertex of an element, from 0.
    pub(super) fn used(&self) -> impl Iterator<Item = usize> {
        let lines = self.lines.iter().flat_map(|line| line.vertices);
        lines.chain(self.points.iter().flat_map(|point| point.vertices))
    }

    /// Reads the vertices in use, whose statements have passed the checks.
    pub(super) fn read_vertices(&mut self, statements: &[Statement<'_>], colors: &VertexColors) {
        let used: HashSet<usize> = self.used().collect();
        if used.is_empty() {
            return;
        }
        let rows = statements.iter().filter(|statement| statement.keyword() == b"v").enumerate();
        for (index, statement) in rows.filter(|(index, _)| used.contains(index)) {
            let numbers =
                statement.arguments().map(|word| str::from_utf8(word).unwrap_or_default());
            let vertex = FileVertex {
                position: three(numbers).unwrap_or_default(),
                color: three(colors.text(statement).split_ascii_whitespace())
                    .filter(|color| color.iter().all(|channel| !channel.is_nan())),
            };
            self.vertices.insert(index, vertex);
        }
    }
}

/// The first three words as numbers.
fn three<'a>(words: impl Iterator<Item = &'a str>) -> Option<Vector> {
    let numbers: Vec<f64> = words.take(3).map_while(|word| word.parse().ok()).collect();
    numbers.try_into().ok()
}

/// The lines and the points of the tables: for each material a list of vertices, none at all if
/// the file has no such element.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Placed {
    pub lines: Vec<Vec<[u32; 2]>>,
    pub points: Vec<Vec<u32>>,
}

impl Placed {
    pub(super) fn line_count(&self) -> usize {
        self.lines.iter().map(Vec::len).sum()
    }

    pub(super) fn point_count(&self) -> usize {
        self.points.iter().map(Vec::len).sum()
    }
}

/// Finds the vertices of elements in the tables: the first one of the same place and colour. Adds
/// those that no triangle has, without a normal. Each line and each point is there once, in the
/// material that comes first; lines of no length are left out. `ranks` has the number of each
/// material in the tables, of which there are `materials`.
pub(super) fn place(
    polygons: &Polygons,
    ranks: &[Option<usize>],
    materials: usize,
    welded: &mut Welded,
) -> Placed {
    if polygons.lines.is_empty() && polygons.points.is_empty() {
        return Placed::default();
    }
    let has_colors = !polygons.vertex_colors.is_empty();
    let mut known = FxHashMap::default();
    for (vertex, &position) in welded.positions.iter().enumerate() {
        known.entry((position, welded.colors.get(vertex).copied())).or_insert(vertex as u32);
    }
    let mut vertex = |end: End, material| {
        let color =
            has_colors.then(|| polygons.color(end.color, material).map(|c| c.round() as u8));
        *known.entry((end.position, color)).or_insert_with(|| {
            welded.positions.push(end.position);
            welded.normals.push([0.0; 3]);
            welded.further.push(keyframes::NONE);
            welded.textures.push([0.0; 2]);
            welded.colors.extend(color);
            welded.positions.len() as u32 - 1
        })
    };
    let lines = by_material(&polygons.lines, ranks, materials, |line| {
        line.vertices.map(|end| vertex(end, line.material))
    });
    let points = by_material(&polygons.points, ranks, materials, |point| {
        let [end] = point.vertices;
        vertex(end, point.material)
    });
    Placed { lines, points }
}

/// Sorts different elements by material. `place` returns one by the vertices of the tables.
fn by_material<T, const N: usize>(
    elements: &[Drawn<N>],
    ranks: &[Option<usize>],
    materials: usize,
    mut place: impl FnMut(&Drawn<N>) -> T,
) -> Vec<Vec<T>> {
    if elements.is_empty() {
        return Vec::new();
    }
    let mut sorted: Vec<Vec<T>> = (0..materials).map(|_| Vec::new()).collect();
    let mut seen = HashSet::new();
    for element in elements {
        // In either direction, and with any colours.
        let mut key = element.vertices.map(|end| end.position);
        key.sort_unstable();
        let has_length = key.windows(2).all(|pair| pair[0] != pair[1]);
        if has_length && seen.insert(key) {
            sorted[ranks[element.material].unwrap_or_default()].push(place(element));
        }
    }
    sorted
}
