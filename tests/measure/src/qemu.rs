//! Runs programs in QEMU.

use std::{ffi::OsStr, io::ErrorKind, path::Path, process::Command};

use anyhow::{Result, bail};

use crate::{cores::Core, firmware};

/// Runs a program on a core to its end, and returns the lines that it prints.
///
/// # Errors
///
/// Returns an error if QEMU is not installed or the program panics, with the message of the panic.
pub(crate) fn run(core: Core, program: &Path) -> Result<Vec<String>> {
    run_with(core, program, [OsStr::new("-kernel"), program.as_os_str()])
}

/// The same, where the arguments of QEMU say how the program is loaded.
pub(crate) fn run_with(
    core: Core,
    program: &Path,
    arguments: impl IntoIterator<Item = impl AsRef<OsStr>>,
) -> Result<Vec<String>> {
    let mut command = Command::new(core.emulator());
    command
        .arg("-machine")
        .args(core.facts().board)
        .args(["-nographic", "-semihosting-config", "enable=on,target=native"])
        .args(arguments);
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

/// A path as the value of an option, whose parts commas separate: a comma in it is doubled.
pub(crate) fn quoted(path: &Path) -> String {
    path.to_string_lossy().replace(',', ",,")
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
