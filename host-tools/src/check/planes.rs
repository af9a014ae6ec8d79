//! Clip planes of a view, for both rasterizers.

use rasterizer::{
    geometry::{ClipPlanes, Plane},
    numbers::{Scalar, Vec3},
};

use super::{
    stand::{MOST, STEP},
    view::{View, ViewError, checked},
};
use crate::reference::HalfSpace;

/// The most planes of a view.
pub const MOST_PLANES: usize = 6;

/// Of what space planes are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PlaneSpace {
    /// Of the model's, as it was modelled: they turn with it, and a matrix changes them with it.
    #[default]
    Object,
    /// Of the one in which the model is turned: they stay where they are.
    World,
}

impl PlaneSpace {
    /// Both, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 2] = [("object", Self::Object), ("world", Self::World)];
}

/// Half spaces: what lies inside all of them, or on their planes, is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ViewPlanes {
    /// The sides that are kept, in units of the fitted model.
    pub sides: [Option<HalfSpace>; MOST_PLANES],
    /// Of what space they are.
    pub space: PlaneSpace,
}

impl ViewPlanes {
    /// Whether there are any.
    pub(super) fn exist(&self) -> bool {
        self.sides.iter().any(Option::is_some)
    }

    /// The planes in the core's numbers.
    pub(super) fn rounded(self) -> Self {
        let round = |c: f64| (c / STEP).round() * STEP;
        let rounded = |HalfSpace { normal, offset }| HalfSpace {
            normal: normal.map(round),
            offset: round(offset),
        };
        Self { sides: self.sides.map(|side| side.map(rounded)), ..self }
    }

    /// The planes of the core. Those that are not used keep all that a model has: it is fitted into
    /// a sphere of radius 1.
    pub(super) fn core(&self) -> Result<ClipPlanes<MOST_PLANES>, ViewError> {
        let mut planes = [const { Plane::new(Vec3::X, Scalar::MAX) }; MOST_PLANES];
        let sides = self.rounded().sides;
        for (plane, HalfSpace { normal, offset }) in planes.iter_mut().zip(sides.iter().flatten()) {
            for coordinate in normal {
                checked("a coordinate of a clip plane's normal", *coordinate, -MOST, MOST)?;
            }
            let longest = normal.iter().fold(0f64, |most, c| most.max(c.abs()));
            checked("the longest coordinate of a clip plane's normal", longest, STEP, MOST)?;
            checked("a clip plane's offset", *offset, -MOST, MOST)?;
            let [x, y, z] = normal.map(Scalar::from_num);
            *plane = Plane::new(Vec3::new(x, y, z), Scalar::from_num(*offset));
        }
        Ok(match self.space {
            PlaneSpace::Object => ClipPlanes::in_object(planes),
            PlaneSpace::World => ClipPlanes::in_world(planes),
        })
    }
}

impl View {
    /// The half spaces of the reference, in world space: those of the core's numbers, if the view
    /// has them.
    pub(super) fn half_spaces(&self) -> Vec<HalfSpace> {
        let (at, scale) = self.core_place();
        let posed = |side: &HalfSpace| match self.planes.space {
            PlaneSpace::Object => {
                let side = self.form.half_space(*side);
                let normal = self.pose_directions(&[side.normal])[0];
                let moved: f64 = (0..3).map(|i| normal[i] * at[i]).sum();
                HalfSpace { normal, offset: scale * side.offset - moved }
            }
            PlaneSpace::World => *side,
        };
        self.planes.sides.iter().flatten().map(posed).collect()
    }
}
