//! Smoothing groups: which faces share their computed normals.

use std::collections::HashMap;

use super::{
    normals::{self, face_normal, mean, opening, places},
    source::Statement,
    triangulate::{Triangle, has_area},
    vector::{Vector, add, normalized, scaled},
};

/// The smoothing group of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Smoothing {
    /// No `s` precedes the face: the crease angle decides.
    Unstated,
    /// `s off` or `s 0`: the face is flat.
    Off,
    /// `s` with another number: the face is smooth with all others of this group.
    Group(u32),
}

impl Smoothing {
    /// Reads an `s`. Some programs write several groups; the first one counts.
    pub(super) fn of(statement: &Statement<'_>) -> Option<Self> {
        let word = statement.arguments().next().unwrap_or(b"off");
        if word.eq_ignore_ascii_case(b"off") {
            return Some(Self::Off);
        }
        if word.eq_ignore_ascii_case(b"on") {
            return Some(Self::Group(1));
        }
        let number = str::from_utf8(word).ok()?.parse().ok()?;
        Some(if number == 0 { Self::Off } else { Self::Group(number) })
    }
}

/// Whether a computed normal depends on the groups.
pub(super) fn matters(triangles: &[Triangle]) -> bool {
    triangles.iter().any(|triangle| {
        triangle.smoothing != Smoothing::Unstated
            && triangle.corners.iter().any(|corner| normalized(corner.normal).is_none())
    })
}

/// A unit normal for each corner of each triangle: the file's, or that of its smoothing group, or
/// by the crease angle where it is in none.
///
/// The normal of a group is the mean of the normals of its faces round the corner's position,
/// weighted by their angles as in [`normals::corner_normals`].
pub(super) fn corner_normals(
    triangles: &[Triangle],
    positions: &[Vector],
    crease: f64,
) -> Vec<[Vector; 3]> {
    if !matters(triangles) {
        return normals::corner_normals(triangles, positions, crease);
    }
    let unstated = triangles.iter().filter(|t| t.smoothing == Smoothing::Unstated);
    let unstated: Vec<Triangle> = unstated.copied().collect();
    let mut by_crease = normals::corner_normals(&unstated, positions, crease).into_iter();

    let mut sums: HashMap<(u32, u32), (Vector, f64)> = HashMap::new();
    for triangle in triangles {
        let Smoothing::Group(group) = triangle.smoothing else { continue };
        let places = places(triangle, positions);
        // The normal of a triangle without area is noise.
        if has_area(places) {
            for (number, corner) in triangle.corners.iter().enumerate() {
                let opening = opening(triangle, number, positions);
                let (sum, weight) = sums.entry((corner.position, group)).or_default();
                *sum = add(*sum, scaled(face_normal(places), opening));
                *weight += opening;
            }
        }
    }
    let computed = |triangle: &Triangle, position: u32| {
        let shared = match triangle.smoothing {
            Smoothing::Group(group) => sums.get(&(position, group)),
            Smoothing::Off | Smoothing::Unstated => None,
        };
        shared
            .and_then(|&(sum, weight)| mean(sum, weight))
            .unwrap_or_else(|| face_normal(places(triangle, positions)))
    };
    triangles
        .iter()
        .map(|triangle| {
            let stated = || {
                triangle.corners.map(|corner| {
                    normalized(corner.normal).unwrap_or_else(|| computed(triangle, corner.position))
                })
            };
            match triangle.smoothing {
                // There is one for each of these triangles.
                Smoothing::Unstated => by_crease.next().unwrap_or_else(stated),
                Smoothing::Off | Smoothing::Group(_) => stated(),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{super::source::statements, *};

    #[test]
    fn a_group_is_a_number_or_off() {
        for (text, smoothing) in [
            ("s 1", Some(Smoothing::Group(1))),
            ("s 4294967295 2", Some(Smoothing::Group(u32::MAX))),
            ("s 0", Some(Smoothing::Off)),
            ("s off", Some(Smoothing::Off)),
            ("s Off # flat", Some(Smoothing::Off)),
            ("s", Some(Smoothing::Off)),
            ("s on", Some(Smoothing::Group(1))),
            ("s -1", None),
            ("s smooth", None),
            ("s \u{e9}", None),
        ] {
            assert_eq!(Smoothing::of(&statements(text.as_bytes())[0]), smoothing, "{text}");
        }
    }
}
