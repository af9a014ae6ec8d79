//! The cores that the firmware runs on, and the boards in QEMU that have them.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A core, by its name on the command line.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum, Serialize, Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Core {
    /// Cortex-M0+ code. QEMU has no ARMv6-M board with enough memory; its Cortex-M3 retires the
    /// same instructions.
    #[value(help = "Cortex-M0+")]
    M0plus,
    /// Cortex-M4.
    #[value(help = "Cortex-M4")]
    M4,
    /// Cortex-M7.
    #[value(help = "Cortex-M7")]
    M7,
    /// Cortex-M33.
    #[value(help = "Cortex-M33")]
    M33,
    /// RV32IMC.
    #[value(help = "RISC-V, RV32IMC")]
    Riscv,
}

impl Core {
    /// All of them.
    pub(crate) const ALL: [Self; 5] = [Self::M0plus, Self::M4, Self::M7, Self::M33, Self::Riscv];

    /// Those that were named, each once, or all if none was.
    pub(crate) fn or_all(named: &[Self]) -> Vec<Self> {
        let chosen = |core: &Self| named.is_empty() || named.contains(core);
        Self::ALL.into_iter().filter(chosen).collect()
    }

    /// Its name on the command line and in files.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::M0plus => "m0plus",
            Self::M4 => "m4",
            Self::M7 => "m7",
            Self::M33 => "m33",
            Self::Riscv => "riscv",
        }
    }

    /// Its name in tables.
    pub(crate) const fn title(self) -> &'static str {
        match self {
            Self::M0plus => "Cortex-M0+",
            Self::M4 => "Cortex-M4",
            Self::M7 => "Cortex-M7",
            Self::M33 => "Cortex-M33",
            Self::Riscv => "RV32IMC",
        }
    }

    /// What the compiler calls it.
    pub(crate) const fn target(self) -> &'static str {
        match self {
            Self::M0plus => "thumbv6m-none-eabi",
            Self::M4 | Self::M7 => "thumbv7em-none-eabihf",
            Self::M33 => "thumbv8m.main-none-eabihf",
            Self::Riscv => "riscv32imc-unknown-none-elf",
        }
    }

    /// QEMU's program for it.
    pub(crate) const fn emulator(self) -> &'static str {
        match self {
            Self::Riscv => "qemu-system-riscv32",
            _ => "qemu-system-arm",
        }
    }

    /// QEMU's arguments that name the board.
    pub(crate) const fn machine(self) -> &'static [&'static str] {
        match self {
            Self::M0plus => &["-machine", "mps2-an385"],
            Self::M4 => &["-machine", "mps2-an386"],
            Self::M7 => &["-machine", "mps2-an500"],
            Self::M33 => &["-machine", "mps2-an505"],
            Self::Riscv => &["-machine", "virt", "-bios", "none"],
        }
    }

    /// Instructions to a unit of the firmware's counter, with `-icount shift=0`: at a nanosecond
    /// each, a system timer at 25 MHz ticks every 40 of them, one at 20 MHz every 50; `mcycle`
    /// counts every one.
    pub(crate) const fn instructions_per_count(self) -> u64 {
        match self {
            Self::M0plus | Self::M4 | Self::M7 => 40,
            Self::M33 => 50,
            Self::Riscv => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_those_of_the_command_line_and_of_json() {
        for core in Core::ALL {
            assert_eq!(Core::from_str(core.name(), false), Ok(core));
            assert_eq!(serde_json::to_string(&core).unwrap(), format!("\"{}\"", core.name()));
        }
        assert_eq!(Core::value_variants(), Core::ALL);
    }
}
