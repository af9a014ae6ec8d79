//! What the firmware counts while it draws a scene.

use anyhow::{Result, bail};
use serde::Deserialize;

use crate::cores::Core;

/// Sums over the frames, in units of the core's counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Cost {
    frames: u64,
    clear: u64,
    vertices: u64,
    draw: u64,
    pixels_drawn: u64,
    triangles_drawn: u64,
    pixels_changed: u64,
}

impl Cost {
    /// A mean over the frames, to the nearest.
    const fn mean(&self, sum: u64) -> u64 {
        (sum + self.frames / 2) / self.frames
    }

    const fn instructions(&self, sum: u64, core: Core) -> u64 {
        self.mean(sum * core.instructions_per_count())
    }

    /// Instructions of a frame.
    pub(crate) const fn frame(&self, core: Core) -> u64 {
        self.instructions(self.clear + self.vertices + self.draw, core)
    }

    /// Instructions that set depth to the far end.
    pub(crate) const fn clear(&self, core: Core) -> u64 {
        self.instructions(self.clear, core)
    }

    /// Instructions for vertices.
    pub(crate) const fn vertices(&self, core: Core) -> u64 {
        self.instructions(self.vertices, core)
    }

    /// Instructions for triangles and pixels.
    pub(crate) const fn triangles_and_pixels(&self, core: Core) -> u64 {
        self.instructions(self.draw, core)
    }

    /// Pixels that a frame covers.
    pub(crate) const fn pixels_drawn(&self) -> u64 {
        self.mean(self.pixels_drawn)
    }

    /// Triangles that are left of a frame after culling and clipping.
    pub(crate) const fn triangles_drawn(&self) -> u64 {
        self.mean(self.triangles_drawn)
    }

    /// Pixels of the rectangle that a frame changes.
    pub(crate) const fn pixels_changed(&self) -> u64 {
        self.mean(self.pixels_changed)
    }

    /// Refuses sums without a frame or a triangle: they say nothing.
    pub(crate) fn check(&self) -> Result<()> {
        if self.frames == 0 || self.triangles_drawn == 0 {
            bail!("the firmware has drawn nothing: {self:?}");
        }
        Ok(())
    }
}
