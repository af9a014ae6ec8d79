//! The lights of a view, for both rasterizers.

use rasterizer::{
    camera::Distance,
    numbers::Vec3,
    shade::{self, Level, Light},
};

use crate::reference::{self, Lights};

/// The most lights of each kind.
pub const MOST_LIGHTS: usize = 4;

/// A light that is infinitely far away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sun {
    /// The direction towards it, of any length.
    pub toward: [f64; 3],
    /// The level of a surface square to it, 0 to 1.
    pub level: f64,
}

/// A light at a point, of level 1 beside it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lamp {
    /// In world space, where the model is turned about the origin.
    pub position: [f64; 3],
    /// Where its level is half.
    pub half: f64,
}

/// The lights of a view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewLights {
    /// Those that are infinitely far away.
    pub suns: [Option<Sun>; MOST_LIGHTS],
    /// Those at points.
    pub lamps: [Option<Lamp>; MOST_LIGHTS],
    /// The level of surfaces that none of them reaches, 0 to 1.
    pub ambient: f64,
}

impl Default for ViewLights {
    fn default() -> Self {
        Self::OVER_THE_SHOULDER
    }
}

/// The lights of the core; those that are not used are dark.
pub(super) type CoreLights = ([Light; MOST_LIGHTS + 1], [shade::Lamp; MOST_LIGHTS]);

impl ViewLights {
    /// One far light, over the viewer's left shoulder.
    pub const OVER_THE_SHOULDER: Self = {
        let mut suns = [None; MOST_LIGHTS];
        suns[0] = Some(Sun { toward: [-1.0, 2.0, 3.0], level: 0.8 });
        Self { suns, lamps: [None; MOST_LIGHTS], ambient: Self::AMBIENT }
    };

    /// The ambient light of a view that chooses none.
    pub const AMBIENT: f64 = 0.2;

    /// Whether light depends on the position.
    pub(super) fn are_near(&self) -> bool {
        self.lamps.iter().any(Option::is_some)
    }

    /// The one light of the core, if there is but one and it is far away.
    pub(super) fn single(&self) -> Option<Light> {
        let mut suns = self.suns.iter().flatten();
        let (sun, None, false) = (suns.next()?, suns.next(), self.are_near()) else { return None };
        Some(Light::new(vector(sun.toward), level(self.ambient), level(sun.level)))
    }

    /// All lights of the core.
    pub(super) fn core(&self) -> CoreLights {
        let mut suns = [Light::new(Vec3::ZERO, Level::ZERO, Level::ZERO); MOST_LIGHTS + 1];
        suns[MOST_LIGHTS] = Light::new(Vec3::ZERO, level(self.ambient), Level::ZERO);
        for (core, sun) in suns.iter_mut().zip(self.suns.iter().flatten()) {
            *core = Light::new(vector(sun.toward), Level::ZERO, level(sun.level));
        }
        let mut lamps = [shade::Lamp::new(Vec3::ZERO, Distance::ONE, Level::ZERO); MOST_LIGHTS];
        for (core, lamp) in lamps.iter_mut().zip(self.lamps.iter().flatten()) {
            let half = Distance::from_num(lamp.half);
            *core = shade::Lamp::new(vector(lamp.position), half, Level::ONE);
        }
        (suns, lamps)
    }

    /// The lights of the reference, in the core's numbers.
    pub(super) fn reference(&self) -> Lights {
        let rounded = |v: [f64; 3]| vector(v).to_bits().map(|c| f64::from(c) / 65_536.0);
        let suns = self.suns.iter().flatten().map(|sun| {
            let toward = rounded(sun.toward);
            let length = toward.iter().map(|c| c * c).sum::<f64>().sqrt();
            reference::Sun { toward: toward.map(|c| c / length), level: sun.level }
        });
        let lamps = self.lamps.iter().flatten().map(|lamp| reference::Lamp {
            position: rounded(lamp.position),
            half: Distance::from_num(lamp.half).to_num(),
            level: 1.0,
        });
        Lights { ambient: self.ambient, suns: suns.collect(), lamps: lamps.collect() }
    }
}

fn level(level: f64) -> Level {
    Level::from_num(level)
}

fn vector(v: [f64; 3]) -> Vec3 {
    Vec3::from_bits(v.map(|c| (c * 65_536.0).round() as i32))
}

/// The sum of all levels.
pub(super) fn total(lights: &Lights) -> f64 {
    lights.suns.iter().map(|sun| sun.level).sum::<f64>()
        + lights.lamps.iter().map(|lamp| lamp.level).sum::<f64>()
}
