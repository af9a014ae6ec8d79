//! Lights.

use clap::Args;
use host_tools::check::{Lamp, MOST_LIGHTS, Sun, View, ViewLights};

use super::names::{numbers, within};

#[derive(Clone, Debug, Args)]
pub(super) struct LightOptions {
    /// A distant light: the direction towards it in the world, and its level [default: 0.8]; up to
    /// 4 of them, in place of -1,2,3, which is over the left shoulder of a camera on the z axis
    #[arg(
        long,
        value_name = "X,Y,Z[,LEVEL]",
        value_parser = sun,
        allow_hyphen_values = true
    )]
    light: Vec<Sun>,
    /// A light at a point of the world, and the distance at which its level is half; up to 4 of
    /// them
    #[arg(long, value_name = "X,Y,Z,HALF", value_parser = lamp, allow_hyphen_values = true)]
    lamp: Vec<Lamp>,
    /// The level of surfaces that no light reaches, 0 to 1
    #[arg(
        long,
        value_name = "LEVEL",
        default_value_t = ViewLights::AMBIENT,
        value_parser = within(0.0, 1.0),
        allow_negative_numbers = true
    )]
    ambient: f64,
}

impl LightOptions {
    /// With the lights that fit; [`check`](Self::check) refuses more of them.
    pub(super) fn over(&self, view: View) -> View {
        let ambient = self.ambient;
        if self.light.is_empty() && self.lamp.is_empty() {
            return View { lights: ViewLights { ambient, ..ViewLights::default() }, ..view };
        }
        let nth = |i: usize| self.light.get(i).copied();
        let nth_lamp = |i: usize| self.lamp.get(i).copied();
        let lights = ViewLights {
            suns: std::array::from_fn(nth),
            lamps: std::array::from_fn(nth_lamp),
            ambient,
        };
        View { lights, ..view }
    }

    /// Refuses more lights than a view has.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        for (option, count) in [("--light", self.light.len()), ("--lamp", self.lamp.len())] {
            anyhow::ensure!(
                count <= MOST_LIGHTS,
                "{option} is given {count} times: a view has {MOST_LIGHTS} at most"
            );
        }
        Ok(())
    }
}

/// A direction and a level, as in -1,2,3,0.5.
fn sun(text: &str) -> Result<Sun, String> {
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z]) => Some(Sun { toward: [x, y, z], level: 0.8 }),
        Some(&[x, y, z, level]) => Some(Sun { toward: [x, y, z], level }),
        _ => None,
    };
    // A step of the core's numbers.
    let is_direction = |sun: &Sun| sun.toward.iter().any(|c| c.abs() >= 1.0 / 65_536.0);
    found.filter(|sun| is_direction(sun) && (0.0..=1.0).contains(&sun.level)).ok_or_else(|| {
        "write a direction x,y,z that is not zero, of numbers up to 32000, and a level from 0 to \
         1, as in -1,2,3,0.5"
            .to_owned()
    })
}

/// A place and a distance, as in 1,2,0.5,1.5.
fn lamp(text: &str) -> Result<Lamp, String> {
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z, half]) => Some(Lamp { position: [x, y, z], half }),
        _ => None,
    };
    found.filter(|lamp| lamp.half >= 1.0 / 65_536.0).ok_or_else(|| {
        "write a place x,y,z and the distance at which the level is half, over 0, of numbers up to \
         32000, as in 1,2,0.5,1.5"
            .to_owned()
    })
}
