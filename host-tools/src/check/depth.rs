//! How depth is stored: the core's types, and their definitions for the reference.

use rasterizer::{attribute::FloatDepth, output::StoredDepth};

use crate::reference;

/// How depth is stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DepthFormat {
    /// 16 bits.
    #[default]
    U16,
    /// 16 bits, floating-point.
    Float16,
    /// 32 bits.
    U32,
}

impl DepthFormat {
    /// All of them, each with its name on the command line.
    pub const NAMES: [(&'static str, Self); 3] =
        [("u16", Self::U16), ("float16", Self::Float16), ("u32", Self::U32)];

    /// What its stored numbers stand for.
    #[must_use]
    pub const fn definition(self) -> reference::DepthFormat {
        match self {
            Self::U16 => u16::DEFINITION,
            Self::Float16 => FloatDepth::DEFINITION,
            Self::U32 => u32::DEFINITION,
        }
    }
}

/// A depth of the core whose stored numbers have a definition.
pub trait DefinedDepth: StoredDepth + Into<u32> {
    /// What they stand for.
    const DEFINITION: reference::DepthFormat;

    /// The depth that this one stands for, from 0 to 1.
    fn depth(self) -> f64 {
        Self::DEFINITION.depth(self.into())
    }
}

impl DefinedDepth for u16 {
    const DEFINITION: reference::DepthFormat = reference::DepthFormat::Fixed { bits: 16 };
}

impl DefinedDepth for FloatDepth {
    const DEFINITION: reference::DepthFormat =
        reference::DepthFormat::Float { exponent_bits: 5, mantissa_bits: 11, least_exponent: 2 };
}

impl DefinedDepth for u32 {
    const DEFINITION: reference::DepthFormat = reference::DepthFormat::Fixed { bits: 32 };
}
