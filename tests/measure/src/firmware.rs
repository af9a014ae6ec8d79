//! Builds programs of the firmware.
//!
//! The toolchain in use builds them if it has the core's target. Otherwise a compiler does that
//! brings the sources of `core`: Debian's, unless the environment names another.

use std::{
    collections::BTreeSet,
    env,
    ffi::OsString,
    fs,
    path::{self, Path, PathBuf},
    process::Command,
};

use anyhow::{Context as _, Result, bail};

use crate::cores::Core;

/// The root of the workspace, wherever this is called from.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

/// Builds a program for a core and returns its path.
pub(crate) fn build(core: Core, name: &str) -> Result<PathBuf> {
    program(Some(core), name, feature(name), |_| ())
}

/// Builds programs, all with the same feature, for several cores in one call: packages wait for
/// those that they are made of, but not for those of other targets. [`build`] then finds them.
pub(crate) fn build_ahead(cores: &[Core], names: &[&str]) -> Result<()> {
    let Some(name) = names.first() else { return Ok(()) };
    for (toolchain, cores) in toolchains(cores)? {
        let mut command = toolchain.cargo(&cores);
        command.args(with_feature(feature(name)));
        run(command, "--bin", names)?;
    }
    Ok(())
}

/// The toolchains of cores, each with those that it builds for in one call. Cores of different
/// architectures are apart: Cargo unites the features of a package for all targets of a call, and
/// `critical-section` must have those of one.
fn toolchains(cores: &[Core]) -> Result<Vec<(Toolchain, Vec<Core>)>> {
    let mut all: Vec<(Toolchain, Vec<Core>)> = Vec::new();
    for &core in cores {
        let toolchain = Toolchain::find(core)?;
        let is_like = |(other, cores): &&mut (Toolchain, Vec<Core>)| {
            *other == toolchain && cores.iter().all(|other| other.emulator() == core.emulator())
        };
        match all.iter_mut().find(is_like) {
            Some((_, cores)) => cores.push(core),
            None => all.push((toolchain, vec![core])),
        }
    }
    Ok(all)
}

/// The feature of the firmware that has a program.
fn feature(name: &str) -> &'static str {
    if name == "frames" { "frames" } else { "bench" }
}

/// What chooses a feature, and leaves out the others.
const fn with_feature(feature: &str) -> [&str; 3] {
    ["--no-default-features", "--features", feature]
}

/// Builds the programs of several scenes for cores at an `opt-level`, into their
/// [folders](scenes). The next build for the same target replaces them, even if it is at another
/// level.
pub(crate) fn build_scenes(cores: &[Core], names: &[&str], opt_level: &str) -> Result<()> {
    for (toolchain, cores) in toolchains(cores)? {
        let mut command = toolchain.cargo(&cores);
        command.env("CARGO_PROFILE_FIRMWARE_OPT_LEVEL", opt_level).args(with_feature("scenes"));
        run(command, "--example", names)?;
    }
    Ok(())
}

/// The folder of the scenes' programs for a core.
pub(crate) fn scenes(core: Core) -> Result<PathBuf> {
    Ok(Toolchain::find(core)?.output(core).join("examples"))
}

/// Builds a program for the host and returns its path.
pub(crate) fn build_for_host(name: &str) -> Result<PathBuf> {
    program(None, name, feature(name), |_| ())
}

/// Builds the program of the choices in a file of Rust, for a core or for the host, and returns its
/// path. The next one for the same target replaces it.
pub(crate) fn build_choices(core: Option<Core>, choices: &Path) -> Result<PathBuf> {
    around(core, "choice", "CHOICES", choices)
}

/// Builds the program of the plan in a file of Rust, in the same way.
pub(crate) fn build_planned(core: Option<Core>, planned: &Path) -> Result<PathBuf> {
    around(core, "planned", "PLANNED", planned)
}

/// Builds the program of the stiff problems in a file of Rust, in the same way.
pub(crate) fn build_stiff(core: Core, instances: &Path) -> Result<PathBuf> {
    around(Some(core), "stiff", "STIFF", instances)
}

/// Builds a program around a file of Rust, which an environment variable names. A feature of the
/// same name keeps it out of other builds.
fn around(core: Option<Core>, name: &str, variable: &str, file: &Path) -> Result<PathBuf> {
    let file = path::absolute(file)?;
    program(core, name, name, |command| {
        command.env(variable, file);
    })
}

/// Builds a program with a feature, for a core or for the host, by a command that `complete`
/// completes, and returns its path.
fn program(
    core: Option<Core>,
    name: &str,
    feature: &str,
    complete: impl FnOnce(&mut Command),
) -> Result<PathBuf> {
    let (mut command, folder, extension) = match core {
        Some(core) => {
            let toolchain = Toolchain::find(core)?;
            (toolchain.cargo(&[core]), toolchain.output(core), "")
        }
        None => {
            let mut command = Command::new(cargo_in_use());
            command.args(CARGO_ARGUMENTS).arg("--release");
            (command, target_directory().join("release"), env::consts::EXE_EXTENSION)
        }
    };
    command.args(with_feature(feature));
    complete(&mut command);
    run(command, "--bin", &[name])?;
    Ok(folder.join(name).with_extension(extension))
}

/// Builds the plugin for QEMU, with these features, and returns its path.
pub(crate) fn build_plugin(features: &[&str]) -> Result<PathBuf> {
    let mut command = Command::new(cargo_in_use());
    command.args(["build", "--quiet", "--package", "cycles-plugin", "--release", "--features"]);
    command.arg(features.join(","));
    run(command, "--lib", &[])?;
    let name = format!("{}cycles_plugin{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    Ok(target_directory().join("release").join(name))
}

/// The output of `rustc --version` for the compiler that builds for a core.
pub(crate) fn compiler_version(core: Core) -> Result<String> {
    output_of(Command::new(Toolchain::find(core)?.rustc).arg("--version"))
}

const CARGO_ARGUMENTS: [&str; 4] = ["build", "--quiet", "--package", "firmware"];

/// The profile of the workspace's manifest that firmware is built by.
const PROFILE: &str = "firmware";

/// The compiler, and the folder to build in.
#[derive(PartialEq, Eq)]
struct Toolchain {
    rustc: OsString,
    cargo: OsString,
    directory: PathBuf,
    /// The linker, if `core` has to be built too.
    builds_core_with: Option<PathBuf>,
}

impl Toolchain {
    fn find(core: Core) -> Result<Self> {
        let rustc = env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        if has_core(&rustc, core.facts().target) {
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
        let sources = libraries(&source_rustc).map(|folder| folder.join("src/rust/library/core"));
        if !sources.is_some_and(|sources| sources.exists()) {
            bail!(
                "there is no compiler for {}: `rustup target add {}`, or on Debian install \
                 rustc-web, cargo-web and rust-web-src (or name a compiler with the sources of \
                 `core` in FIRMWARE_RUSTC, and its cargo in FIRMWARE_CARGO)",
                core.facts().name,
                core.facts().target
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

    /// The command that builds programs of the firmware for some cores.
    fn cargo(&self, cores: &[Core]) -> Command {
        let targets: BTreeSet<_> = cores.iter().map(|core| core.facts().target).collect();
        let mut command = Command::new(&self.cargo);
        command.args(CARGO_ARGUMENTS).args(["--profile", PROFILE]);
        command.args(targets.iter().flat_map(|target| ["--target", target]));
        if let Some(linker) = &self.builds_core_with {
            for target in targets {
                let triple = target.replace(['-', '.'], "_").to_uppercase();
                command.env(format!("CARGO_TARGET_{triple}_LINKER"), linker);
            }
            command
                .env("RUSTC", &self.rustc)
                // Debian's compiler is a stable one, and -Zbuild-std is not.
                .env("RUSTC_BOOTSTRAP", "1")
                // Rustup would take it for the toolchain to use.
                .env_remove("RUSTUP_TOOLCHAIN")
                .arg("-Zbuild-std=core")
                .arg("--target-dir")
                .arg(&self.directory);
        }
        command
    }

    /// The folder of the programs for a core.
    fn output(&self, core: Core) -> PathBuf {
        self.directory.join(core.facts().target).join(PROFILE)
    }
}

/// The cargo that started this program, or the one on the path.
fn cargo_in_use() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

pub(crate) fn target_directory() -> PathBuf {
    let named = env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    root().join(named.unwrap_or_else(|| "target".into()))
}

/// Whether a compiler has `core` for a target.
fn has_core(rustc: &OsString, target: &str) -> bool {
    let mut command = Command::new(rustc);
    let library = output_of(command.args(["--print", "target-libdir", "--target", target])).ok();
    let files = library.and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten();
    let mut names = files.flatten().map(|file| file.file_name());
    names.any(|name| name.to_string_lossy().starts_with("libcore-"))
}

/// The folder of a compiler's libraries.
fn libraries(rustc: &OsString) -> Option<PathBuf> {
    let sysroot = output_of(Command::new(rustc).args(["--print", "sysroot"])).ok()?;
    Some(Path::new(&sysroot).join("lib/rustlib"))
}

/// The linker that comes with a compiler.
fn linker(rustc: &OsString) -> Option<PathBuf> {
    let hosts = fs::read_dir(libraries(rustc)?).ok()?;
    let mut linkers = hosts.flatten().map(|host| host.path().join("bin/rust-lld"));
    linkers.find(|linker| linker.is_file())
}

/// Runs cargo in the workspace to build these targets of a kind.
fn run(mut command: Command, kind: &str, names: &[&str]) -> Result<()> {
    command.args(names.iter().flat_map(|name| [kind, name]));
    // A relative path is relative to neither the root, where cargo runs, nor the package, where a
    // build script does.
    if let Some(models) = env::var_os("RASTERIZER_MODELS") {
        command.env("RASTERIZER_MODELS", path::absolute(models)?);
    }
    let output = command.current_dir(root()).output();
    let output = output
        .with_context(|| format!("{} could not be started", command.get_program().display()))?;
    if !output.status.success() {
        let what = if names.is_empty() {
            "the plugin for QEMU".into()
        } else {
            format!("{} of the firmware", names.join(", "))
        };
        bail!("{what} could not be built:\n{}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    Ok(())
}

/// Runs a command and returns its output without the last line break.
pub(crate) fn output_of(command: &mut Command) -> Result<String> {
    let name = command.get_program().display().to_string();
    let output = command.output().with_context(|| format!("{name} could not be started"))?;
    if !output.status.success() {
        bail!("{name} failed: {}", String::from_utf8_lossy(&output.stderr).trim_end());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim_end().to_owned())
}
