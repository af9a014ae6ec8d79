//! The order of triangles and vertices.
//!
//! Triangles that share vertices come close together, so that a small cache of transformed vertices
//! serves most of them (the optimiser is meshoptimizer's, after T. Forsyth, "Linear-speed vertex
//! cache optimisation", 2006). Vertices are in order of first use, so that flash is read front to
//! back.

use optimesh::vcacheoptimizer::optimize_vertex_cache;
use rasterizer::mesh::Material;

use super::weld::Welded;

/// The size of the first-in-first-out cache by which an order is judged.
const CACHE: usize = 16;

/// The most triangles of a vertex that the optimiser sees. Each of its steps visits all triangles
/// left at the vertices of its cache, so that its time is quadratic in them: at the tip of a cone
/// of 60,000 sides it takes ten seconds.
const MOST_TRIANGLES: u32 = 64;

/// Welded vertices and triangles in their final order.
pub(super) struct Ordered {
    pub welded: Welded,
    /// See [`Report`](super::Report).
    pub cache_misses_before: f64,
    /// See [`Report`](super::Report).
    pub cache_misses: f64,
}

impl Ordered {
    /// Orders triangles within their materials, which they are sorted by.
    pub(super) fn new(welded: Welded, materials: &[Material]) -> Self {
        let count = welded.positions.len();
        let runs: Vec<usize> = materials.iter().map(|m| m.triangle_count as usize).collect();
        let mut ordered = triangles(&welded.triangles, &runs, count);
        let cache_misses_before = cache_miss_ratio(&welded.triangles, count);
        let cache_misses = cache_miss_ratio(&ordered, count);
        let vertices = vertices(&mut ordered, count);
        Self {
            welded: Welded {
                positions: vertices.iter().map(|&v| welded.positions[v]).collect(),
                further: vertices.iter().map(|&v| welded.further[v]).collect(),
                normals: vertices.iter().map(|&v| welded.normals[v]).collect(),
                textures: vertices.iter().map(|&v| welded.textures[v]).collect(),
                colors: vertices.iter().filter_map(|&v| welded.colors.get(v).copied()).collect(),
                triangles: ordered,
            },
            cache_misses_before,
            cache_misses,
        }
    }
}

/// Reorders the triangles within each run of `run_lengths`, where that makes for fewer cache
/// misses.
fn triangles(triangles: &[[u32; 3]], run_lengths: &[usize], vertices: usize) -> Vec<[u32; 3]> {
    let mut ordered = Vec::with_capacity(triangles.len());
    let mut numbering = Numbering::of(vertices);
    let mut rest = triangles;
    for &length in run_lengths {
        let (run, tail) = rest.split_at(length);
        rest = tail;
        // The run's own numbers, as the optimiser clears arrays as long as there are vertices.
        let mut run = run.to_vec();
        let vertices = numbering.renumber(&mut run);
        let optimised = optimised(&run, vertices.len());
        let misses = |triangles| cache_miss_ratio(triangles, vertices.len());
        let better = if misses(&optimised) < misses(&run) { optimised } else { run };
        ordered.extend(better.iter().map(|t| t.map(|vertex| vertices[vertex as usize] as u32)));
    }
    ordered
}

/// The optimiser's order. It gets a vertex of more than [`MOST_TRIANGLES`] as several, each of
/// triangles that follow each other.
fn optimised(triangles: &[[u32; 3]], vertices: usize) -> Vec<[u32; 3]> {
    let mut original: Vec<u32> = (0..vertices as u32).collect();
    let mut current: Vec<(u32, u32)> = original.iter().map(|&vertex| (vertex, 0)).collect();
    let mut split = |vertex: u32| {
        let (name, uses) = &mut current[vertex as usize];
        if *uses == MOST_TRIANGLES {
            (*name, *uses) = (original.len() as u32, 0);
            original.push(vertex);
        }
        *uses += 1;
        *name
    };
    let names: Vec<u32> = triangles.as_flattened().iter().map(|&vertex| split(vertex)).collect();
    let mut result = vec![[0; 3]; triangles.len()];
    optimize_vertex_cache(result.as_flattened_mut(), &names, original.len());
    result.iter().map(|triangle| triangle.map(|name| original[name as usize])).collect()
}

/// The vertices in order of first use. All triangles are renumbered to it; vertices that none uses
/// are left out.
fn vertices(triangles: &mut [[u32; 3]], vertices: usize) -> Vec<usize> {
    Numbering::of(vertices).renumber(triangles)
}

/// Numbers vertices in order of first use, in time that depends on the triangles alone.
struct Numbering {
    /// Each vertex's new number; `u32::MAX` for all of them between two calls.
    place: Vec<u32>,
}

impl Numbering {
    fn of(vertices: usize) -> Self {
        Self { place: vec![u32::MAX; vertices] }
    }

    /// Renumbers the triangles, and returns the old number of each vertex in use.
    fn renumber(&mut self, triangles: &mut [[u32; 3]]) -> Vec<usize> {
        let mut order = Vec::new();
        for index in triangles.as_flattened_mut() {
            let place = &mut self.place[*index as usize];
            if *place == u32::MAX {
                *place = order.len() as u32;
                order.push(*index as usize);
            }
            *index = *place;
        }
        for &vertex in &order {
            self.place[vertex] = u32::MAX;
        }
        order
    }
}

/// Vertices transformed per triangle: from 0.5 (a large regular grid, at best) to 3 (nothing
/// shared); 0 without any.
pub(super) fn cache_miss_ratio(triangles: &[[u32; 3]], vertices: usize) -> f64 {
    if triangles.is_empty() {
        return 0.0;
    }
    // The cache holds the vertices of the last `CACHE` misses.
    let mut last_miss = vec![None; vertices];
    let mut misses = 0_usize;
    for &vertex in triangles.as_flattened() {
        let last = &mut last_miss[vertex as usize];
        if last.is_none_or(|last| misses - last > CACHE) {
            *last = Some(misses);
            misses += 1;
        }
    }
    misses as f64 / triangles.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of 30 by 30 squares, its triangles scattered by a step that shares no factor with
    /// their number.
    fn scattered_grid() -> Vec<[u32; 3]> {
        let corner = |x: u32, y: u32| y * 31 + x;
        let grid: Vec<[u32; 3]> = (0..900)
            .flat_map(|i| {
                let (x, y) = (i % 30, i / 30);
                let [a, b, c, d] =
                    [corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        (0..1800).map(|i| grid[i * 1_001 % 1800]).collect()
    }

    fn turned_to_least(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let mut turned = triangles.to_vec();
        for triangle in &mut turned {
            let least = (0..3).min_by_key(|&i| triangle[i]).unwrap();
            triangle.rotate_left(least);
        }
        turned.sort_unstable();
        turned
    }

    #[test]
    fn triangles_and_winding_survive_and_misses_fall() {
        let before = scattered_grid();
        let after = triangles(&before, &[1000, 800], 961);
        for run in [0..1000, 1000..1800] {
            assert_eq!(turned_to_least(&before[run.clone()]), turned_to_least(&after[run]));
        }
        let (worse, better) = (cache_miss_ratio(&before, 961), cache_miss_ratio(&after, 961));
        // Strips of a grid come to about 0.7 with a cache of 16; two interleaved runs of random
        // triangles to somewhat more, as their neighbours are in the other run.
        assert!(worse > 2.0 && better < 1.5, "{worse} to {better}");
        assert_eq!(after, triangles(&before, &[1000, 800], 961));
    }

    #[test]
    fn vertices_follow_their_first_use() {
        let mut triangles = [[5, 2, 9], [2, 5, 0]];
        assert_eq!(vertices(&mut triangles, 10), [5, 2, 9, 0]);
        assert_eq!(triangles, [[0, 1, 2], [1, 0, 3]]);
    }

    #[test]
    fn miss_ratio_is_that_of_a_fifo_of_16() {
        assert_eq!(cache_miss_ratio(&[[0, 1, 2], [3, 4, 5]], 6), 3.0);
        assert_eq!(cache_miss_ratio(&[[0, 1, 2], [0, 2, 3]], 4), 2.0);
        let run: Vec<[u32; 3]> = (0..5).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let then = |last| cache_miss_ratio(&[&run[..], &[last]].concat(), 17);
        // Vertex 0 is still there when 15 others have come, though not when 16 have.
        assert_eq!(then([15, 0, 1]), 16.0 / 6.0);
        assert_eq!(then([15, 16, 0]), 3.0);
    }
}
