//! Runs programs in QEMU.

use std::{io::ErrorKind, path::Path, process::Command};

use anyhow::{Result, bail};

use crate::{cores::Core, firmware};

/// Runs a program on a core to its end, counting instructions, and returns the lines that it
/// prints.
///
/// # Errors
///
/// Returns an error if QEMU is not installed or the program panics, with the message of the panic.
pub(crate) fn run(core: Core, program: &Path) -> Result<Vec<String>> {
    let mut command = Command::new(core.emulator());
    command
        .arg("-machine")
        .args(core.facts().board)
        .args([
            "-nographic",
            "-icount",
            "shift=0",
            "-semihosting-config",
            "enable=on,target=native",
            "-kernel",
        ])
        .arg(program);
    let output = match command.output() {
        Err(error) if error.kind() == ErrorKind::NotFound => bail!("{}", not_installed(core)),
        output => output?,
    };
    let lines: Vec<_> =
        String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect();
    if !output.status.success() {
        let last = lines.iter().rev().take(3).rev().cloned().collect::<Vec<_>>().join("\n");
        let said = String::from_utf8_lossy(&output.stderr);
        bail!("{} failed on {}:\n{last}\n{}", program.display(), core.title(), said.trim_end());
    }
    Ok(lines)
}

/// The version of QEMU, as in 7.2.22.
pub(crate) fn version(core: Core) -> Result<String> {
    let Ok(text) = firmware::output_of(Command::new(core.emulator()).arg("--version")) else {
        bail!("{}", not_installed(core));
    };
    let words = text.split_whitespace().find(|word| word.starts_with(|c: char| c.is_ascii_digit()));
    Ok(words.unwrap_or("unknown").to_owned())
}

fn not_installed(core: Core) -> String {
    let package = match core {
        Core::Riscv => "qemu-system-misc",
        _ => "qemu-system-arm",
    };
    format!("{} is not installed: on Debian it is in the package {package}", core.emulator())
}
