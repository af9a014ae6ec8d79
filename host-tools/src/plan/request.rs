//! What a picture is wanted for.

use super::Views;
use crate::{check::Subpixel, reference::Projection};

/// The cores that costs are known for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Core {
    /// Cortex-M0+, as in an RP2040.
    M0plus,
    /// Cortex-M4, as in an STM32F4 or an nRF52.
    M4,
    /// RISC-V with multiplication and division (RV32IMC), as in an RP2350.
    Riscv,
}

impl Core {
    /// All of them, by their names on the command line.
    pub const NAMES: [(&'static str, Self); 3] =
        [("m0plus", Self::M0plus), ("m4", Self::M4), ("riscv", Self::Riscv)];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::M0plus => "m0plus",
            Self::M4 => "m4",
            Self::Riscv => "riscv",
        }
    }

    /// Its name in a text.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::M0plus => "Cortex-M0+",
            Self::M4 => "Cortex-M4",
            Self::Riscv => "RV32IMC",
        }
    }

    /// A usual clock, in MHz: that of an RP2040, an STM32F407 and an RP2350.
    #[must_use]
    pub const fn usual_clock_mhz(self) -> f64 {
        match self {
            Self::M0plus => 125.0,
            Self::M4 => 168.0,
            Self::Riscv => 150.0,
        }
    }

    /// The precision of vertices that costs nothing: without a long multiply, 256ths of a pixel
    /// take one to two per cent more cycles than sixteenths.
    #[must_use]
    pub const fn subpixel(self) -> Subpixel {
        match self {
            Self::M0plus => Subpixel::S4,
            Self::M4 | Self::Riscv => Subpixel::S8,
        }
    }
}

/// How a model is shown, and what there is for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Width and height of the display in pixels.
    pub display: [u32; 2],
    /// The microcontroller's core.
    pub core: Core,
    /// The RAM that the picture may take, with its part of the stack, in bytes.
    pub ram_bytes: u32,
    /// The flash that it may take, in bytes; `None` for all that it wants.
    pub flash_bytes: Option<u32>,
    /// Frames that must be shown in a second; `None` for as many as there will be.
    pub frames_per_second: Option<f64>,
    /// The core's clock, in Hz.
    pub clock_hz: f64,
    /// Bits that the display's bus takes in a second; `None` if it is no limit.
    pub bus_hz: Option<f64>,
    /// Where the model is seen from.
    pub views: Views,
    /// How far the camera stands from the origin, in model units, where a view names no distance.
    pub distance: f64,
    /// The vertical field of view.
    pub field_of_view_degrees: f64,
    /// Where light comes from, and its ambient and diffuse levels.
    pub light: ([f64; 3], [f64; 2]),
    /// Whether light is that of vertices and not of triangles; `None` for what the model needs.
    pub is_smooth: Option<bool>,
    /// What is behind the model, in 8-bit steps.
    pub background: [u8; 3],
    /// The part of a view's pixels that may show another surface than the nearest one, from 0 to 1.
    pub wrong_part: f64,
    /// How far a texture coordinate may be off, in texels.
    pub texels: f64,
    /// Whether four texels are mixed, and not the nearest one is taken.
    pub is_bilinear: bool,
    /// Whether textures have mip levels; `None` for where views need them.
    pub has_mip_levels: Option<bool>,
    /// How near a palette's colours must be to those without one: the peak signal-to-noise ratio,
    /// in dB. Infinite if they must be the same.
    pub palette_db: f64,
}

impl Default for Request {
    /// A turntable on a display of 320 x 240 pixels, by a Cortex-M0+ with 64 KB.
    fn default() -> Self {
        Self {
            display: [320, 240],
            core: Core::M0plus,
            ram_bytes: 64 << 10,
            flash_bytes: None,
            frames_per_second: None,
            clock_hz: Core::M0plus.usual_clock_mhz() * 1e6,
            bus_hz: None,
            views: Views::default(),
            distance: 3.0,
            field_of_view_degrees: 40.0,
            light: ([-1.0, 2.0, 3.0], [0.2, 0.8]),
            is_smooth: None,
            background: [0; 3],
            wrong_part: 0.001,
            texels: 0.5,
            is_bilinear: false,
            has_mip_levels: None,
            palette_db: f64::INFINITY,
        }
    }
}

impl Request {
    /// The focal length in pixels.
    pub(super) fn focal_length_px(&self) -> f64 {
        let height = f64::from(self.display[1]);
        Projection::focal_length_px(self.field_of_view_degrees.to_radians(), height)
    }
}
