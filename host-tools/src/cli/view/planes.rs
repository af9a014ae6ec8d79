//! Planes that cut the model.

use clap::Args;
use host_tools::{
    check::{MOST_PLANES, PlaneSpace, View, ViewPlanes},
    reference::HalfSpace,
};

use super::names::{choice, name, numbers};

#[derive(Clone, Debug, Args)]
pub(super) struct PlaneOptions {
    /// Cut the model at a plane: points with X x + Y y + Z z + D >= 0 are kept; up to 6 of them. A
    /// model is fitted into a sphere of radius 1, before --stretch and --matrix. Faces seen from
    /// behind are not drawn
    #[arg(long, value_name = "X,Y,Z,D", value_parser = half_space, allow_hyphen_values = true)]
    clip: Vec<HalfSpace>,
    /// Whether planes turn with the model or stay in the world, where the camera looks at the
    /// origin from the z axis
    #[arg(
        long,
        value_name = "SPACE",
        requires = "clip",
        default_value = name(&PlaneSpace::NAMES, PlaneSpace::default()),
        value_parser = choice(&PlaneSpace::NAMES)
    )]
    clip_in: PlaneSpace,
}

impl PlaneOptions {
    /// With the planes that fit; [`check`](Self::check) refuses more of them.
    pub(super) fn over(&self, view: View) -> View {
        let nth = |i: usize| self.clip.get(i).copied();
        let planes = ViewPlanes { sides: std::array::from_fn(nth), space: self.clip_in };
        View { planes, ..view }
    }

    /// Refuses more planes than a view has.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        let count = self.clip.len();
        anyhow::ensure!(
            count <= MOST_PLANES,
            "--clip is given {count} times: a model has {MOST_PLANES} clip planes at most"
        );
        Ok(())
    }
}

/// A normal and an offset, as in 0,0,-1,0.25.
fn half_space(text: &str) -> Result<HalfSpace, String> {
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z, offset]) => Some(HalfSpace { normal: [x, y, z], offset }),
        _ => None,
    };
    // A step of the core's numbers.
    let is_direction = |side: &HalfSpace| side.normal.iter().any(|c| c.abs() >= 1.0 / 65_536.0);
    found.filter(is_direction).ok_or_else(|| {
        "write a normal x,y,z that is not zero and an offset, of numbers up to 32000, as in \
         0,0,-1,0.25"
            .to_owned()
    })
}
