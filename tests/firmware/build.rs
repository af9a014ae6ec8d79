//! Converts OBJ files to const tables, as the build script of any firmware does.

use std::{
    env,
    error::Error,
    f64::consts::{PI, TAU},
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use host_tools::model::{Model, Options, blob, convert_for_build, emit, write_atomically};

#[path = "build/textures.rs"]
mod textures;

fn main() -> Result<(), Box<dyn Error>> {
    let out = PathBuf::from(env::var("OUT_DIR")?);
    let options = Options::default();
    for name in ["gear", "rocket", "torus_knot", "wooden_crate"] {
        convert_for_build(
            Path::new("../../host-tools/models").join(name).with_extension("obj"),
            &options,
        )?;
    }

    // The bench scenes draw the cube and the sphere, the size scenes also the ball of 500
    // triangles.
    let bodies = [
        ("cube", CUBE.to_owned()),
        ("sphere", sphere(24, 13)?),
        ("ball", sphere(25, 11)?),
        ("colored_sphere", colored(&sphere(24, 13)?)),
    ];
    for (name, obj) in bodies {
        let path = out.join(name).with_extension("obj");
        fs::write(&path, obj)?;
        let edges_degrees = ["ball", "sphere"].contains(&name).then_some(0.0);
        // Not by `convert_for_build`: Cargo would run this again at each build, for a file that is
        // newer than its last run.
        let model = convert(&out, &path, name, Options { edges_degrees, ..options.clone() })?;
        if name == "sphere" {
            write_atomically(&out.join("sphere.bin"), blob::bytes(&model))?;
        }
    }
    pulse(&out, &options)?;
    textures::cube(&out, &options)?;
    textures::wooden_crate(&out, &options)?;

    // Models that do not come with the project.
    println!("cargo::rustc-check-cfg=cfg(models)");
    println!("cargo::rerun-if-env-changed=RASTERIZER_MODELS");
    if let Some(folder) = env::var_os("RASTERIZER_MODELS") {
        // Smooth everywhere: one vertex for each of the file's, as in the figures of other
        // rasterizers.
        let smooth = Options { crease_degrees: 180.0, ..options };
        for name in ["spot", "suzanne"] {
            convert_for_build(Path::new(&folder).join(name).with_extension("obj"), &smooth)?;
        }
        textures::spot(&out, Path::new(&folder), &smooth)?;
        println!("cargo::rustc-cfg=models");
    }

    println!("cargo::rustc-env=OPT_LEVEL={}", env::var("OPT_LEVEL")?);
    link()
}

/// Converts a model under a name.
fn convert(out: &Path, obj: &Path, name: &str, options: Options) -> Result<Model, Box<dyn Error>> {
    let model = Model::load(obj, &Options { name: Some(name.to_owned()), ..options })?;
    write_atomically(&out.join(name).with_extension("rs"), emit::source(&model))?;
    Ok(model)
}

/// Converts the sphere, and one that is drawn out along its axis, as shapes of one model.
fn pulse(out: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let round = sphere(24, 13)?;
    let long: String = round
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            ["v", x, y, z] => Ok(format!("v {x} {} {z}\n", 1.5 * y.parse::<f64>()?)),
            _ => Ok(format!("{line}\n")),
        })
        .collect::<Result<_, std::num::ParseFloatError>>()?;
    let files = [("round.obj", &round), ("long.obj", &long)];
    let [first, second] = files.map(|(name, text)| (Path::new(name), text.as_bytes()));
    let options = Options { name: Some("pulse".to_owned()), ..options.clone() };
    let model = Model::keyframes_from_bytes(first, &[second], &options)?;
    write_atomically(&out.join("pulse.rs"), emit::source(&model))?;
    Ok(())
}

/// Sets the memory of the board in QEMU, or that of another board, which `FIRMWARE_MEMORY` names as
/// in `_flash=0x08000000,_flash_size=1M`. Cortex-M programs get that of `memory.x`, an RP2040's,
/// unless they need more or the board has it elsewhere.
fn link() -> Result<(), Box<dyn Error>> {
    if env::var("CARGO_CFG_TARGET_OS")? != "none" {
        return Ok(());
    }
    let target = env::var("TARGET")?;
    println!("cargo::rerun-if-env-changed=FIRMWARE_MEMORY");
    let board = env::var("FIRMWARE_MEMORY").unwrap_or_default();
    let arg = |arg: &str| {
        println!("cargo::rustc-link-arg-bins={arg}\ncargo::rustc-link-arg-examples={arg}");
    };
    if target.starts_with("riscv32") {
        let boards = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("boards");
        println!("cargo::rerun-if-changed=boards/virt.x");
        arg(&format!("-T{}", boards.join("virt.x").display()));
    } else {
        println!("cargo::rerun-if-changed=../../memory.x");
        if target.starts_with("thumbv8m") && board.is_empty() {
            arg("--defsym=_flash=0x10000000");
            arg("--defsym=_ram=0x38000000");
        }
        for program in [
            "bench",
            "bench_set_up",
            "bench_frugal",
            "bench_frugal_set_up",
            "bench_shades",
            "bench_textures",
            "choice",
            "planned",
            "scaling",
            "stiff",
        ] {
            println!("cargo::rustc-link-arg-bin={program}=--defsym=_ram_size=0x400000");
        }
    }
    for definition in board.split(',').filter(|definition| !definition.is_empty()) {
        arg(&format!("--defsym={definition}"));
    }
    arg("-Tlink.x");
    Ok(())
}

const CUBE: &str = "\
     v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n\
     f 5 6 7 8\nf 6 2 3 7\nf 2 1 4 3\nf 1 5 8 4\nf 8 7 3 4\nf 1 2 6 5\n";

/// Gives the vertices of a body in a cube of side 2 the colours of their places.
fn colored(obj: &str) -> String {
    let colored = |line: &str| {
        let Some(place) = line.strip_prefix("v ") else { return format!("{line}\n") };
        let part = |text: &str| text.parse::<f64>().map_or(0.0, |c| (c + 1.0) / 2.0).to_string();
        let color: Vec<String> = place.split(' ').map(part).collect();
        format!("v {place} {}\n", color.join(" "))
    };
    obj.lines().map(colored).collect()
}

/// Returns a sphere of `around` meridians and `down` rows: 2 `around` (`down` - 1) triangles.
fn sphere(around: usize, down: usize) -> Result<String, std::fmt::Error> {
    let mut obj = String::from("v 0 1 0\nv 0 -1 0\n");
    for row in 1..down {
        for column in 0..around {
            let (latitude, longitude) =
                (PI * row as f64 / down as f64, TAU * column as f64 / around as f64);
            let (ring, y) = latitude.sin_cos();
            writeln!(obj, "v {} {y} {}", ring * longitude.sin(), ring * longitude.cos())?;
        }
    }
    let at = |row: usize, column: usize| 3 + (row - 1) * around + column % around;
    for column in 0..around {
        writeln!(obj, "f 1 {} {}", at(1, column), at(1, column + 1))?;
        writeln!(obj, "f 2 {} {}", at(down - 1, column + 1), at(down - 1, column))?;
        for row in 1..down - 1 {
            let [a, b] = [at(row, column), at(row, column + 1)];
            let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
            writeln!(obj, "f {a} {c} {b}\nf {b} {c} {d}")?;
        }
    }
    Ok(obj)
}
