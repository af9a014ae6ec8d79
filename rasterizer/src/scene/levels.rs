//! Levels of detail.

use crate::{
    camera::{Camera, Distance},
    geometry::{Pose, Projection},
    mesh::Mesh,
};

/// Meshes of one model in `N` levels of detail, and how far each is seen: the first one up to its
/// distance, the next ones beyond that up to theirs, and nothing beyond the last.
///
/// ```
/// use rasterizer::{
///     mesh::{
///         Material, Mesh,
///         shapes::{Icosphere, Solid},
///     },
///     prelude::*,
///     scene::Levels,
/// };
///
/// const FINE: Icosphere = Icosphere::new(4);
/// const COARSE: Icosphere = Icosphere::new(1);
/// static FINE_BALL: Solid<{ FINE.vertices() }, { FINE.triangles() }> = FINE.solid();
/// static COARSE_BALL: Solid<{ COARSE.vertices() }, { COARSE.triangles() }> = COARSE.solid();
/// static FINE_MESH: Mesh<'static> =
///     FINE_BALL.mesh(&[Material::new([255; 3], FINE.triangles() as u32)]);
/// static COARSE_MESH: Mesh<'static> =
///     COARSE_BALL.mesh(&[Material::new([255; 3], COARSE.triangles() as u32)]);
///
/// const BALL: Levels<'_, 2> =
///     Levels::new([(Distance::lit("5"), &FINE_MESH), (Distance::lit("50"), &COARSE_MESH)]);
/// ```
///
/// Distances that do not grow do not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Levels<'a, const N: usize> {
    levels: [(Distance, &'a Mesh<'a>); N],
}

impl<'a, const N: usize> Levels<'a, N> {
    /// Levels up to these distances in world units, for a model that is drawn in scale 1.
    ///
    /// # Panics
    ///
    /// In a constant, if a distance is not greater than the one before.
    #[must_use]
    pub const fn new(levels: [(Distance, &'a Mesh<'a>); N]) -> Self {
        let mut next = 1;
        while next < N {
            assert!(
                levels[next - 1].0.to_bits() < levels[next].0.to_bits(),
                "each level of detail is seen farther than the one before"
            );
            next += 1;
        }
        Self { levels }
    }

    /// The mesh of the [level](Self::level) for a model in this pose; `None` beyond the last.
    #[must_use]
    pub fn mesh<P: Projection>(&self, pose: &Pose, camera: &Camera<P>) -> Option<&'a Mesh<'a>> {
        self.level(pose, camera).and_then(|level| self.levels.get(level)).map(|(_, mesh)| *mesh)
    }

    /// The number of the level, from 0, for a model in this pose, by the way from the camera to the
    /// model's origin; `None` beyond the last. A model of twice the size is seen twice as far.
    ///
    /// The way is exact within 2<sup>-12</sup>; the camera's direction and its lens do not matter.
    #[must_use]
    pub fn level<P: Projection>(&self, pose: &Pose, camera: &Camera<P>) -> Option<usize> {
        let [from, to] = [camera.eye(), pose.translation].map(|place| place.to_bits());
        // In units of 2^-14: each below 2^31, and the sum of their squares below 2^64.
        let square: u64 = (0..3)
            .map(|axis| u64::from(to[axis].abs_diff(from[axis]) >> DROPPED_BITS))
            .map(|way| way * way)
            .sum();
        let scale = u64::from(pose.scale.to_bits());
        let is_within = |limit: Distance| {
            let limit = (u64::from(limit.to_bits()) * scale) >> (16 + DROPPED_BITS);
            square <= limit.min(u64::from(u32::MAX)).pow(2)
        };
        self.levels.iter().position(|(limit, _)| is_within(*limit))
    }
}

/// Of coordinates with 16 binary digits.
const DROPPED_BITS: u32 = 2;
