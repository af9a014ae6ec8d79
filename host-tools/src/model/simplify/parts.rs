//! Parts of a model that vanish.

use std::{collections::HashSet, path::Path};

use super::super::{polygons::Corner, quote::shown, report::thousands};

/// Which positions triangles join: each has the position of another one of its part, or its own.
struct Parts(Vec<u32>);

impl Parts {
    /// The parts of triangles by their corners.
    fn of(corners: &[Corner]) -> Self {
        let count = corners.iter().map(|corner| corner.position + 1).max().unwrap_or(0);
        let mut parts = Self((0..count).collect());
        for triangle in corners.chunks_exact(3) {
            for corner in &triangle[1..] {
                let [one, other] =
                    [triangle[0], *corner].map(|corner| parts.first(corner.position));
                parts.0[one as usize] = other;
            }
        }
        parts
    }

    /// The position that stands for a part.
    fn first(&mut self, mut position: u32) -> u32 {
        while self.0[position as usize] != position {
            let next = self.0[position as usize];
            // Half as many steps the next time.
            self.0[position as usize] = self.0[next as usize];
            position = next;
        }
        position
    }

    fn all(&mut self, corners: &[Corner]) -> HashSet<u32> {
        corners.iter().map(|corner| self.first(corner.position)).collect()
    }
}

/// Returns a warning if parts have no triangle any more. `before` are the corners of all triangles,
/// `after` those that are left, at positions of the former.
pub(super) fn warning(path: &Path, before: &[Corner], after: &[Corner]) -> Option<String> {
    let mut parts = Parts::of(before);
    let [all, left] = [before, after].map(|corners| parts.all(corners).len());
    (left < all).then(|| {
        format!(
            "{}: {} of {} separate parts vanish with so few triangles: allow more to keep them",
            shown(path),
            thousands(all - left),
            thousands(all)
        )
    })
}
