//! What the core does in an instance of a problem: its run time is measured on microcontrollers.

use super::curve::Law;
use crate::reference::random::Random;

/// What is measured of a family's run time.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// What an instance does, in a few words.
    pub of: &'static str,
    /// The slopes that cycles are expected to have.
    pub laws: &'static [Law],
    pub(super) work: fn(parameter: f64, random: &mut Random) -> Option<Work>,
}

impl Cost {
    /// How many instances are measured with each value of the parameter.
    const INSTANCES: usize = 8;

    /// What the core does in some random instances with a value of the parameter. None where it
    /// refuses the object.
    #[must_use]
    pub fn work(&self, parameter: f64) -> Vec<Work> {
        let mut random = Random(1);
        (0..Self::INSTANCES).filter_map(|_| (self.work)(parameter, &mut random)).collect()
    }
}

/// Something that the core does.
#[derive(Clone, Debug, PartialEq)]
pub enum Work {
    /// It places the vertices of an object, with all that is set up for it.
    Place(Scene),
    /// It clips the triangles of an object.
    Clip(Scene),
    /// It draws an object into a part of the picture.
    Draw {
        /// The object.
        scene: Scene,
        /// The part's first column and row, its width and its height.
        part: [i32; 4],
        /// The type of depth.
        depth: &'static str,
    },
    /// It draws an object with a texture, without depth.
    DrawTexture {
        /// The object.
        scene: Scene,
        /// The part's first column and row, its width and its height.
        part: [i32; 4],
        /// The value that chooses the filter.
        filter: &'static str,
        /// The type that corrects perspective.
        correction: String,
    },
    /// It composes rotations.
    Compose {
        /// How many.
        count: u32,
        /// Whether rows are restored each time.
        restores: bool,
    },
}

/// An object before a camera that looks along -z, in numbers that tables of a firmware can have.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The type of sub-pixels.
    pub subpixel: &'static str,
    /// In quanta.
    pub positions: Vec<[i16; 3]>,
    /// In turns of the texture, Q8.24; empty without one.
    pub texture_coordinates: Vec<[i32; 2]>,
    /// Vertices by their numbers.
    pub triangles: Vec<[u16; 3]>,
    /// The length of a quantum: a mantissa, and an exponent of two.
    pub scale: (u32, i32),
    /// The entries of the pose's rotation, Q2.30.
    pub rotation: [[i32; 3]; 3],
    /// Where the object is, Q16.16.
    pub translation: [i32; 3],
    /// Where the eye is, Q16.16.
    pub eye: [i32; 3],
    /// The focal length in pixels of a perspective projection, Q16.16; `None` with a parallel one,
    /// of one pixel for a unit.
    pub focal_length: Option<u32>,
    /// The distances of the near and the far plane, Q16.16.
    pub range: [u32; 2],
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
}

#[cfg(test)]
mod tests {
    use super::super::FAMILIES;

    #[test]
    fn instances_with_a_result_have_something_to_measure() {
        for family in FAMILIES {
            for point in family.measure(20).points {
                let works = family.cost.work(point.parameter);
                assert!(works.len() <= super::Cost::INSTANCES, "{}", family.name);
                // Rotations are composed up to a number that is enough.
                if point.error.is_some() && point.parameter <= 4096.0 {
                    assert!(!works.is_empty(), "{} at {}", family.name, point.parameter);
                }
                if point.error.is_none() {
                    assert!(works.is_empty(), "{} at {}", family.name, point.parameter);
                }
            }
        }
    }
}
