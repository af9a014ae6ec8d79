//! The cores that the firmware runs on, and the boards in QEMU that have them.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A core, by its name on the command line.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, ValueEnum, Serialize, Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Core {
    /// Cortex-M0+
    M0plus,
    /// Cortex-M4
    M4,
    /// Cortex-M7
    M7,
    /// Cortex-M33
    M33,
    /// RISC-V, RV32IMC
    Riscv,
}

/// Facts about a core.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    /// Its name on the command line and in files.
    pub(crate) name: &'static str,
    /// Its name in tables.
    pub(crate) title: &'static str,
    /// Its target triple.
    pub(crate) target: &'static str,
    /// The arguments of QEMU that choose its board.
    pub(crate) board: &'static [&'static str],
}

impl Core {
    /// Returns the named cores, each once, or all if none is named.
    pub(crate) fn or_all(named: &[Self]) -> Vec<Self> {
        let is_chosen = |core: &&Self| named.is_empty() || named.contains(core);
        Self::value_variants().iter().filter(is_chosen).copied().collect()
    }

    pub(crate) const fn facts(self) -> Facts {
        let (name, title, target, board): (_, _, _, &[_]) = match self {
            // QEMU has no ARMv6-M board with enough memory. Its Cortex-M3 executes the same
            // instructions.
            Self::M0plus => ("m0plus", "Cortex-M0+", "thumbv6m-none-eabi", &["mps2-an385"]),
            Self::M4 => ("m4", "Cortex-M4", "thumbv7em-none-eabihf", &["mps2-an386"]),
            Self::M7 => ("m7", "Cortex-M7", "thumbv7em-none-eabihf", &["mps2-an500"]),
            Self::M33 => ("m33", "Cortex-M33", "thumbv8m.main-none-eabihf", &["mps2-an505"]),
            Self::Riscv => {
                ("riscv", "RV32IMC", "riscv32imc-unknown-none-elf", &["virt", "-bios", "none"])
            }
        };
        Facts { name, title, target, board }
    }

    pub(crate) const fn title(self) -> &'static str {
        self.facts().title
    }

    /// The QEMU program that emulates it.
    pub(crate) const fn emulator(self) -> &'static str {
        match self {
            Self::Riscv => "qemu-system-riscv32",
            _ => "qemu-system-arm",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_names_are_those_of_the_command_line_and_of_json() {
        for core in Core::or_all(&[]) {
            let name = core.facts().name;
            assert_eq!(Core::from_str(name, false), Ok(core));
            assert_eq!(serde_json::to_string(&core).unwrap(), format!("\"{name}\""));
        }
        assert_eq!(Core::or_all(&[Core::M7, Core::M4, Core::M7]), [Core::M4, Core::M7]);
    }
}
