//! The views that a model is looked at in.

use rasterizer::{
    geometry::Pose,
    numbers::{Rotation, Turn},
};

use crate::{check::angle, reference::random::Random};

/// Where a model is seen from: it turns, and the camera stands still.
#[derive(Clone, Debug, PartialEq)]
pub enum Views {
    /// It turns about its y axis, and is tilted after that.
    Turntable {
        /// Into how many steps a turn is divided: a power of two from 2 to 65,536.
        steps: u32,
        /// The tilt about the x axis, in degrees.
        pitch_degrees: f64,
    },
    /// From anywhere: these many random views.
    Orbit {
        /// How many.
        count: u32,
    },
    /// From these places alone.
    List(Vec<View>),
}

/// A view of a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Turns about y, x and z in degrees, in this order.
    pub turns_degrees: [f64; 3],
    /// The camera's distance from the origin; `None` for that of the request.
    pub distance: Option<f64>,
}

impl Default for Views {
    /// 512 steps, seen from 20 degrees above.
    fn default() -> Self {
        Self::Turntable { steps: 512, pitch_degrees: 20.0 }
    }
}

/// A view as the core has it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) rotation: Rotation,
    pub(super) distance: f64,
}

impl Placed {
    /// The model's pose.
    pub(super) const fn pose(&self) -> Pose {
        Pose::rotated(self.rotation)
    }

    /// A point of the model in the space of the camera: right, up, and the distance along its axis.
    pub(super) fn see(&self, point: [f64; 3]) -> [f64; 3] {
        let rows = self.rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()));
        let [x, y, z] = rows.map(|row| (0..3).map(|i| row[i] * point[i]).sum::<f64>());
        [x, y, self.distance - z]
    }
}

impl Views {
    /// The views that an order made from all of them is judged by. For random views these are as
    /// many others: in those that it was made from it is right in any case, which tells nothing
    /// about the rest.
    pub(super) fn judging(&self, distance: f64) -> Vec<Placed> {
        match self {
            &Self::Orbit { count } => orbit(count, 2, distance),
            _ => self.placed(distance),
        }
    }

    /// What is known if an order made from all of them is right in those that judge it.
    pub(super) fn basis_of_order(&self) -> String {
        match self {
            Self::Orbit { .. } => {
                format!("made from as many random views, judged by others: {}", self.basis())
            }
            _ => self.basis(),
        }
    }

    /// All of them.
    pub(super) fn placed(&self, distance: f64) -> Vec<Placed> {
        match self {
            &Self::Turntable { steps, pitch_degrees } => {
                let tilt = Rotation::about_x(angle(pitch_degrees));
                let step = |step: u32| {
                    tilt * Rotation::about_y(Turn::from_bits(step << (32 - steps.ilog2())))
                };
                (0..steps).map(|s| Placed { rotation: step(s), distance }).collect()
            }
            &Self::Orbit { count } => orbit(count, 1, distance),
            Self::List(views) => {
                let place = |view: &View| Placed {
                    rotation: view.rotation(),
                    distance: view.distance.unwrap_or(distance),
                };
                views.iter().map(place).collect()
            }
        }
    }

    /// The views of a list or of an orbit; none of a turntable, which has steps.
    #[must_use]
    pub fn listed(&self) -> Vec<View> {
        match self {
            Self::Turntable { .. } => Vec::new(),
            &Self::Orbit { count } => any_views(1).take(count as usize).collect(),
            Self::List(views) => views.clone(),
        }
    }

    /// How many they are.
    #[must_use]
    pub const fn count(&self) -> u32 {
        match self {
            &Self::Turntable { steps, .. } => steps,
            &Self::Orbit { count } => count,
            Self::List(views) => views.len() as u32,
        }
    }

    /// What is known if something holds in each of them.
    #[must_use]
    pub fn basis(&self) -> String {
        match self {
            Self::Turntable { steps, .. } => format!("all {steps} views of the turntable"),
            // None of n fails: with p failing, that has the probability (1 - p)^n < e^(-p n), which
            // is 5 % at p = 3 / n.
            Self::Orbit { count } => format!(
                "{count} random views: with 95 % confidence less than {:.2} % of all do otherwise",
                300.0 / f64::from(*count)
            ),
            Self::List(views) => format!("all {} views", views.len()),
        }
    }
}

impl View {
    /// Its turns about y, x and z as the core has them.
    #[must_use]
    pub fn turns(&self) -> [Turn; 3] {
        self.turns_degrees.map(angle)
    }

    fn rotation(&self) -> Rotation {
        let [y, x, z] = self.turns();
        Rotation::about_z(z) * Rotation::about_x(x) * Rotation::about_y(y)
    }
}

/// Random views of a seed.
fn orbit(count: u32, seed: u64, distance: f64) -> Vec<Placed> {
    let placed = |view: View| Placed { rotation: view.rotation(), distance };
    any_views(seed).take(count as usize).map(placed).collect()
}

/// Views from anywhere: the direction that is seen from the front is uniform on the sphere, whose
/// area between two heights is proportional to their difference (Archimedes).
fn any_views(seed: u64) -> impl Iterator<Item = View> {
    let mut random = Random(seed);
    std::iter::repeat_with(move || {
        let [yaw, roll] = [0, 1].map(|_| random.real(0.0, 360.0));
        let pitch = random.real(-1.0, 1.0).asin().to_degrees();
        View { turns_degrees: [yaw, pitch, roll], distance: None }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turntable_has_exactly_its_steps() {
        let views = Views::Turntable { steps: 4, pitch_degrees: 0.0 }.placed(3.0);
        // The x axis turns towards the camera, which lies on the z axis: about y, x goes to -z.
        let seen: Vec<_> = views.iter().map(|view| view.see([1.0, 0.0, 0.0])).collect();
        let expected = [[1.0, 0.0, 3.0], [0.0, 0.0, 4.0], [-1.0, 0.0, 3.0], [0.0, 0.0, 2.0]];
        for (seen, expected) in seen.iter().zip(expected) {
            assert!((0..3).all(|i| (seen[i] - expected[i]).abs() < 1e-8), "{seen:?} {expected:?}");
        }
    }

    #[test]
    fn random_views_are_uniform_on_the_sphere() {
        let views = Views::Orbit { count: 4_000 }.placed(3.0);
        // The mean of a coordinate of a uniform direction is 0 and that of its square 1/3; four
        // standard deviations of the means of 4,000 are 0.037 and 0.019.
        for axis in 0..3 {
            let front = |placed: &Placed| placed.rotation.rows()[2][axis].to_num::<f64>();
            let mean = views.iter().map(front).sum::<f64>() / 4_000.0;
            let square = views.iter().map(|v| front(v).powi(2)).sum::<f64>() / 4_000.0;
            assert!(mean.abs() < 0.037, "{axis}: {mean}");
            assert!((square - 1.0 / 3.0).abs() < 0.019, "{axis}: {square}");
        }
    }

    #[test]
    fn a_sample_is_told_from_all_views() {
        assert_eq!(Views::default().basis(), "all 512 views of the turntable");
        let orbit = Views::Orbit { count: 1_000 }.basis();
        assert!(orbit.contains("less than 0.30 %"), "{orbit}");
    }
}
