//! Runs programs in QEMU under the plugin that counts instructions by what their timing depends on.

use std::{
    ffi::{OsStr, OsString},
    fs,
    path::{Path, PathBuf},
    process,
};

use anyhow::{Context as _, Result, bail};
use object::File;

use crate::{cores::Core, counts::Stages, firmware, qemu, size::image};

/// The plugin, built for the QEMU that emulates a core.
#[derive(Clone, Debug)]
pub(crate) struct Plugin {
    core: Core,
    library: PathBuf,
}

/// What a program has printed, and what was counted up to each of its reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Output {
    pub(crate) lines: Vec<String>,
    pub(crate) reports: Vec<Stages>,
}

/// The words of the firmware that tell the plugin about stages.
const MARKS: &str = "firmware::counter::MARKS";

/// The cache of an RP2040 in front of its flash: 16 KB in two ways, lines of 8 bytes. The firmware
/// for QEMU has its flash at 0, of 2 MB.
const RP2040_CACHE: &str = "cache=0:0x200000:8:1024:2";

impl Plugin {
    pub(crate) fn build(core: Core) -> Result<Self> {
        let features = features(&qemu::version(core)?)?;
        Ok(Self { core, library: firmware::build_plugin(features)? })
    }

    /// Runs a program of the firmware to its end.
    pub(crate) fn run(&self, program: &Path) -> Result<Output> {
        let kernel = [OsStr::new("-kernel"), program.as_os_str()];
        self.run_with(program, marks(program)?, &kernel)
    }

    /// Runs a program whose marks begin at an address, where the arguments of QEMU say how it is
    /// loaded.
    pub(crate) fn run_with(
        &self,
        program: &Path,
        marks: u32,
        arguments: &[&OsStr],
    ) -> Result<Output> {
        let out = std::env::temp_dir().join(format!("measure-{}.json", process::id()));
        let mut plugin = OsString::new();
        for (separator, path) in [("", &self.library), (",out=", &out)] {
            plugin.push(separator);
            plugin.push(qemu::quoted(path));
        }
        plugin.push(format!(",marks={marks:#x}:{}", Stages::COUNT));
        if self.core == Core::M0plus {
            plugin.push(format!(",{RP2040_CACHE}"));
        }
        let arguments =
            [OsStr::new("-plugin"), &plugin].into_iter().chain(arguments.iter().copied());
        let lines = qemu::run_with(self.core, program, arguments)?;
        let text = fs::read_to_string(&out).context("the plugin has written no counts")?;
        fs::remove_file(&out).with_context(|| out.display().to_string())?;
        let report = |line| serde_json::from_str(line).context("the plugin's counts are no JSON");
        Ok(Output { lines, reports: text.lines().map(report).collect::<Result<_>>()? })
    }
}

/// The address of a program's marks.
pub(crate) fn marks(program: &Path) -> Result<u32> {
    let file = fs::read(program).with_context(|| program.display().to_string())?;
    let file = File::parse(file.as_slice()).context("the program is no ELF file")?;
    let marks = image::symbols(&file).into_iter().find(|symbol| symbol.name == MARKS);
    Ok(marks.with_context(|| format!("{} has no {MARKS}", program.display()))?.address)
}

/// The features that the plugin is built with for a version of QEMU.
fn features(version: &str) -> Result<&'static [&'static str]> {
    let mut numbers = version.split('.').map_while(|number| number.parse::<u32>().ok());
    match (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0)) {
        (7, 2..) | (8, _) => Ok(&[]),
        (9, 1..) | (10.., _) => Ok(&["api-3"]),
        _ => {
            bail!("the plugin that counts needs QEMU 7.2, 8 or from 9.1 on, and this is {version}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_plugin_is_built_for_the_version_of_qemu() {
        let api_3: &[&str] = &["api-3"];
        for (version, expected) in
            [("7.2.22", &[][..]), ("8.2.2", &[]), ("9.1.0", api_3), ("10.0.2", api_3)]
        {
            assert_eq!(features(version).unwrap(), expected, "{version}");
        }
        for version in ["5.2.0", "7.1.0", "9.0.1", "unknown"] {
            assert!(features(version).unwrap_err().to_string().contains(version));
        }
    }
}
