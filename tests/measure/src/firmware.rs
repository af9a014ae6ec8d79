//! Builds programs of the firmware.
//!
//! By the toolchain in use if it has the core's target; else by a compiler that brings the sources
//! of `core`, which is Debian's unless the environment names one.

use std::{
    env,
    ffi::OsString,
    fs,
    path::{self, Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail};

use crate::cores::Core;

/// The root of the workspace: programs are built and results written there, wherever this was
/// called from.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

/// Builds a program for a core by the profile `firmware`, and returns where it is. A later
/// build of the same program for the same target replaces it, be it at another `opt-level`.
///
/// # Errors
///
/// If there is no compiler or linker for the core, or it fails; the message has the compiler's.
pub(crate) fn build(core: Core, name: &str) -> Result<PathBuf> {
    Ok(build_all(core, &[name], None)?.join(name))
}

/// Builds several programs at once for a core and returns the directory they are in. `opt_level` is
/// that of the profile unless another is named.
///
/// # Errors
///
/// As [`build`].
pub(crate) fn build_all(core: Core, names: &[&str], opt_level: Option<&str>) -> Result<PathBuf> {
    let toolchain = Toolchain::find(core)?;
    let mut command = toolchain.cargo(core);
    command.args(["--profile", PROFILE, "--target", core.target()]);
    if let Some(level) = opt_level {
        command.env("CARGO_PROFILE_FIRMWARE_OPT_LEVEL", level);
    }
    run(command, names)?;
    Ok(toolchain.directory.join(core.target()).join(PROFILE))
}

/// Builds a program for the machine that this runs on and returns where it is.
///
/// # Errors
///
/// If it does not compile.
pub(crate) fn build_for_host(name: &str) -> Result<PathBuf> {
    let mut command = Command::new(cargo_in_use());
    command.args(CARGO_ARGUMENTS).arg("--release");
    run(command, &[name])?;
    Ok(target_directory().join("release").join(name).with_extension(env::consts::EXE_EXTENSION))
}

/// The version of the compiler that builds for a core, as it says it.
///
/// # Errors
///
/// If there is none.
pub(crate) fn compiler_version(core: Core) -> Result<String> {
    output_of(Command::new(Toolchain::find(core)?.rustc).arg("--version"))
}

const CARGO_ARGUMENTS: [&str; 4] = ["build", "--quiet", "--package", "firmware"];

/// The profile of the workspace's manifest that firmware is built by.
const PROFILE: &str = "firmware";

/// What builds for a core.
struct Toolchain {
    rustc: OsString,
    cargo: OsString,
    /// Where programs are built.
    directory: PathBuf,
    /// If `core` has to be built too: the linker.
    builds_core_with: Option<PathBuf>,
}

impl Toolchain {
    fn find(core: Core) -> Result<Self> {
        let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        if has_core(&rustc, core.target()) {
            return Ok(Self {
                rustc,
                cargo: cargo_in_use(),
                directory: target_directory(),
                builds_core_with: None,
            });
        }
        let or =
            |variable, otherwise: &str| env::var_os(variable).unwrap_or_else(|| otherwise.into());
        let (source_rustc, cargo) =
            (or("FIRMWARE_RUSTC", "/usr/bin/rustc"), or("FIRMWARE_CARGO", "/usr/bin/cargo"));
        if !has_sources(&source_rustc) {
            bail!(
                "there is no compiler for {}: `rustup target add {}`, or on Debian install rustc-web, cargo-web and \
                 rust-web-src (or name a compiler that has its library's sources in FIRMWARE_RUSTC, its cargo in \
                 FIRMWARE_CARGO)",
                core.name(),
                core.target()
            );
        }
        let linker = linker(&rustc).or_else(|| linker(&source_rustc)).or_else(|| {
            let path = env::var_os("PATH")?;
            let found = |name: &str| {
                env::split_paths(&path).map(|directory| directory.join(name)).find(|p| p.is_file())
            };
            ["rust-lld", "ld.lld-22", "ld.lld"].into_iter().find_map(found)
        });
        Ok(Self {
            rustc: source_rustc,
            cargo,
            directory: target_directory().join("microcontrollers"),
            builds_core_with: Some(
                linker.context("there is no linker for microcontrollers: install lld")?,
            ),
        })
    }

    /// The command that builds a program of the firmware.
    fn cargo(&self, core: Core) -> Command {
        let mut command = Command::new(&self.cargo);
        command.args(CARGO_ARGUMENTS);
        if let Some(linker) = &self.builds_core_with {
            let triple = core.target().replace(['-', '.'], "_").to_uppercase();
            command
                .env(format!("CARGO_TARGET_{triple}_LINKER"), linker)
                .env("RUSTC", &self.rustc)
                // Debian's compiler is a stable one, and -Zbuild-std is not.
                .env("RUSTC_BOOTSTRAP", "1")
                // It must not be taken for the toolchain that this was started by.
                .env_remove("RUSTUP_TOOLCHAIN")
                .arg("-Zbuild-std=core")
                .arg("--target-dir")
                .arg(&self.directory);
        }
        command
    }
}

/// The cargo that has started this, or the usual one.
fn cargo_in_use() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

fn target_directory() -> PathBuf {
    let named = env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    root().join(named.unwrap_or_else(|| "target".into()))
}

/// Whether a compiler has `core` for a target.
fn has_core(rustc: &OsString, target: &str) -> bool {
    let library =
        output_of(Command::new(rustc).args(["--print", "target-libdir", "--target", target]));
    let files = library.ok().and_then(|directory| fs::read_dir(directory).ok());
    files.is_some_and(|files| {
        let mut names = files.flatten().map(|file| file.file_name());
        names.any(|name| name.to_string_lossy().starts_with("libcore-"))
    })
}

/// Whether a compiler has the sources of `core`.
fn has_sources(rustc: &OsString) -> bool {
    let sysroot = output_of(Command::new(rustc).args(["--print", "sysroot"]));
    sysroot
        .is_ok_and(|sysroot| Path::new(&sysroot).join("lib/rustlib/src/rust/library/core").exists())
}

/// The linker that comes with a compiler.
fn linker(rustc: &OsString) -> Option<PathBuf> {
    let sysroot = output_of(Command::new(rustc).args(["--print", "sysroot"])).ok()?;
    let hosts = fs::read_dir(Path::new(&sysroot).join("lib/rustlib")).ok()?;
    let mut linkers = hosts.flatten().map(|host| host.path().join("bin/rust-lld"));
    linkers.find(|linker| linker.is_file())
}

/// Runs cargo in the workspace, to build these programs.
fn run(mut command: Command, names: &[&str]) -> Result<()> {
    for name in names {
        command.args(["--bin", name]);
    }
    // Cargo runs in the root, a build script in its package: neither is where a relative path was
    // written.
    if let Some(models) = env::var_os("RASTERIZER_MODELS") {
        command.env("RASTERIZER_MODELS", path::absolute(models)?);
    }
    let output = command.current_dir(root()).output();
    let output = output
        .with_context(|| format!("{} could not be started", command.get_program().display()))?;
    if !output.status.success() {
        bail!(
            "the firmware's program {} could not be built:\n{}",
            names.join(", "),
            String::from_utf8_lossy(&output.stderr).trim_end()
        );
    }
    Ok(())
}

/// What a command prints, without the end of its line.
pub(crate) fn output_of(command: &mut Command) -> Result<String> {
    let name = command.get_program().display().to_string();
    let output = command.output().with_context(|| format!("{name} could not be started"))?;
    if !output.status.success() {
        bail!("{name} failed: {}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim_end().to_owned())
}
