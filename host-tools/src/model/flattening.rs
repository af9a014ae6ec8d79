//! Triangles that lose their area when positions are rounded, and the vertex that causes it.

use std::path::Path;

use super::{
    quote::shown,
    report::thousands,
    source::Statement,
    triangulate::has_area,
    vector::{Vector, length, sub},
};

/// A vertex this many times as far out as half of the vertices is what makes the steps of positions
/// coarse: without it they are at least half as many times finer.
const FAR: f64 = 16.0;

/// The positions before and after rounding.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounding<'a> {
    /// All positions of the file's faces, as written.
    pub written: &'a [Vector],
    /// The vertices' positions in the same numbers, and scaled so that no coordinate exceeds 2.
    pub original: &'a [Vector],
    /// See [`original`](Self::original).
    pub shape: &'a [Vector],
    /// The vertices' positions in quanta.
    pub rounded: &'a [[i16; 3]],
}

/// Returns a warning if triangles lose their area.
pub(super) fn warning(
    path: &Path,
    statements: &[Statement<'_>],
    triangles: &[[u32; 3]],
    rounding: Rounding<'_>,
) -> Option<String> {
    let Rounding { written, original, shape, rounded } = rounding;
    let is_lost = |t: &&[u32; 3]| {
        is_flat(t.map(|v| rounded[v as usize])) && has_area(t.map(|v| shape[v as usize]))
    };
    let mut lost = triangles.iter().filter(is_lost);
    let first = lost.next()?;
    let (count, all) = (thousands(1 + lost.count()), thousands(triangles.len()));
    let (vertex, times) = farthest(written)?;
    let is_cause = times >= FAR;
    let vertex = if is_cause { vertex } else { original[first[0] as usize] };
    let line = line_of(statements, vertex).map_or(String::new(), |line| format!(":{line}"));
    let reason = if is_cause {
        let times = if times < 1e6 { thousands(times as usize) } else { format!("{times:.0e}") };
        format!(
            "vertex {vertex:?} lies {times} times as far out as half of the others, so the steps \
             of positions are coarse: move or remove it"
        )
    } else {
        format!(
            "the first at vertex {vertex:?}: merge the vertices of details that are this small, or \
             split the model"
        )
    };
    Some(format!(
        "{}{line}: {count} of {all} triangles lose their area when positions are rounded to 16 \
         bits: {reason}",
        shown(path)
    ))
}

/// Whether a triangle has no area.
fn is_flat(triangle: [[i16; 3]; 3]) -> bool {
    let [a, b, c] = triangle.map(|p| p.map(i64::from));
    let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    (0..3).all(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        u[j] * v[k] == u[k] * v[j]
    })
}

/// The position farthest from the middle, and its distance in multiples of the median distance. The
/// middle is the median of each coordinate, which single positions do not move.
fn farthest(positions: &[Vector]) -> Option<(Vector, f64)> {
    let median = |mut values: Vec<f64>| {
        let half = values.len() / 2;
        *values.select_nth_unstable_by(half, f64::total_cmp).1
    };
    let (&first, _) = positions.split_first()?;
    let middle = [0, 1, 2].map(|axis| median(positions.iter().map(|p| p[axis]).collect()));
    let distances: Vec<f64> = positions.iter().map(|&p| length(sub(p, middle))).collect();
    let (mut farthest, mut most) = (first, 0.0);
    for (&position, &distance) in positions.iter().zip(&distances) {
        if distance > most {
            (farthest, most) = (position, distance);
        }
    }
    let typical = median(distances);
    Some((farthest, if typical > 0.0 { most / typical } else { f64::INFINITY }))
}

/// The line of the first `v` with these coordinates.
fn line_of(statements: &[Statement<'_>], position: Vector) -> Option<usize> {
    let is_there = |statement: &&Statement<'_>| {
        let words = statement.arguments().take(3);
        let numbers = words.map(|word| str::from_utf8(word).ok()?.parse::<f64>().ok());
        statement.keyword() == b"v" && numbers.eq(position.map(Some))
    };
    statements.iter().find(is_there).map(|statement| statement.line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_line_are_flat() {
        assert!(is_flat([[-32_768, -32_768, 0], [0; 3], [32_767, 32_767, 0]]));
        assert!(is_flat([[5, 6, 7], [5, 6, 7], [1, 2, 3]]));
        assert!(!is_flat([[-32_767; 3], [0, 0, 1], [32_767; 3]]));
    }

    #[test]
    fn the_farthest_position_is_compared_with_the_median() {
        let mut positions: Vec<Vector> = (0..5).map(|i| [5.0 + f64::from(i), 1.0, 0.0]).collect();
        assert_eq!(farthest(&positions), Some(([5.0, 1.0, 0.0], 2.0)));
        positions.push([7.0, 1.0, -1e300]);
        let (position, times) = farthest(&positions).unwrap();
        assert!(position[2] == -1e300 && times > 1e299);
        assert_eq!(farthest(&[[1.0; 3], [1.0; 3], [2.0; 3]]), Some(([2.0; 3], f64::INFINITY)));
    }
}
