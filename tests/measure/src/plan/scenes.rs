//! The scenes whose plans are measured: fixed before costs were, and none of them a body that costs
//! are measured with.

use std::{
    env,
    f64::consts::TAU,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result};
use host_tools::plan::{Core, Request, View, Views};

use super::bodies;
use crate::firmware;

/// A model, and what it is planned for.
#[derive(Clone, Debug)]
pub(super) struct Scene {
    pub(super) name: &'static str,
    /// The OBJ file.
    pub(super) file: PathBuf,
    pub(super) request: Request,
}

/// Where a model comes from.
enum Model {
    Shipped,
    /// In the folder that `RASTERIZER_MODELS` names.
    Foreign,
    /// Made for this: hard for a rasterizer, not for its user.
    Stiff(fn() -> String),
    /// Made for this, with a picture of 16 colours.
    Painted(fn() -> String),
}

/// All scenes for which there is a model. Files that are made lie in `folder`.
pub(super) fn all(folder: &Path) -> Result<Vec<Scene>> {
    use self::Core::{M0plus, M4, Riscv};
    use Model::{Foreign, Painted, Shipped, Stiff};
    let turntable = Views::default;
    let steep = || Views::Turntable { steps: 256, pitch_degrees: 50.0 };
    let orbit = || Views::Orbit { count: 300 };
    let few = || {
        let view = |turns_degrees| View { turns_degrees, distance: None };
        Views::List(vec![
            view([10.0, 20.0, 0.0]),
            view([200.0, -35.0, 15.0]),
            view([95.0, 60.0, 0.0]),
        ])
    };
    let low = || {
        let view = |turns_degrees| View { turns_degrees, distance: None };
        Views::List(vec![view([0.0, 8.0, 0.0]), view([30.0, 12.0, 0.0]), view([75.0, 10.0, 5.0])])
    };
    let table = [
        ("cube", Stiff(cube), M0plus, [320, 240], 32, turntable()),
        ("wooden_crate", Shipped, M4, [320, 240], 192, turntable()),
        ("rocket", Shipped, M0plus, [240, 240], 64, turntable()),
        ("gear", Shipped, M4, [240, 320], 64, steep()),
        ("torus_knot", Shipped, M0plus, [320, 240], 200, turntable()),
        ("spot", Foreign, M0plus, [320, 240], 264, turntable()),
        ("spot_textured", Foreign, M4, [320, 240], 128, steep()),
        ("suzanne", Foreign, M4, [160, 128], 32, turntable()),
        ("teapot", Foreign, M0plus, [240, 240], 48, turntable()),
        // Three beams, each over one of its neighbours and under the other: no order is right.
        ("crossing", Stiff(crossing), M0plus, [320, 240], 64, few()),
        // Four blocks on a plate: no order is right, but planes keep them apart.
        ("blocks", Stiff(blocks), M0plus, [320, 240], 64, turntable()),
        // Two plates a thousandth of their width apart.
        ("plates", Stiff(plates), M4, [320, 240], 200, turntable()),
        // Slivers of 1:300.
        ("needle", Stiff(needle), M0plus, [128, 160], 24, turntable()),
        // A triangle from 0.3 to 2.7 of the camera's distance.
        ("corridor", Stiff(corridor), M4, [320, 240], 96, few()),
        // From anywhere.
        ("torus_knot_orbit", Shipped, M4, [240, 240], 160, orbit()),
        ("spot_orbit", Foreign, M0plus, [240, 240], 200, orbit()),
        // Little flash: only the smallest palette fits.
        ("die", Painted(die), M0plus, [320, 240], 64, turntable()),
        // Seen along its length: far texels are small, near ones large.
        ("floor", Painted(floor), M4, [320, 240], 96, low()),
        ("die_mipmaps", Painted(die), M0plus, [320, 240], 64, few()),
        ("wooden_crate_bilinear", Shipped, M4, [320, 240], 192, turntable()),
        ("wooden_crate_riscv", Shipped, Riscv, [320, 240], 192, turntable()),
        ("suzanne_riscv", Foreign, Riscv, [240, 240], 96, turntable()),
        ("needle_riscv", Stiff(needle), Riscv, [128, 160], 24, turntable()),
    ];
    let mut scenes = Vec::new();
    for (name, model, core, display, kilobytes, views) in table {
        let shipped = firmware::root().join("host-tools/models");
        let (is_bilinear, has_mip_levels) =
            (name.ends_with("_bilinear"), name.ends_with("_mipmaps").then_some(true));
        let model_name = ["_orbit", "_riscv", "_bilinear", "_mipmaps"]
            .iter()
            .fold(name, |name, what| name.trim_end_matches(what));
        let beside = |folder: &Path| folder.join(model_name).with_extension("obj");
        let file = match model {
            Shipped => beside(&shipped),
            Foreign => match env::var_os("RASTERIZER_MODELS") {
                Some(folder) => beside(Path::new(&folder)),
                None => continue,
            },
            Stiff(obj) | Painted(obj) => {
                let file = beside(folder);
                fs::write(&file, obj()).with_context(|| file.display().to_string())?;
                if matches!(model, Painted(_)) {
                    let library = file.with_extension("mtl");
                    let text = format!("newmtl a\nmap_Kd {model_name}.png\n");
                    fs::write(&library, text).with_context(|| library.display().to_string())?;
                    bodies::picture(&file.with_extension("png"), pips)?;
                }
                file
            }
        };
        let request = Request {
            display,
            core,
            ram_bytes: kilobytes << 10,
            clock_hz: core.usual_clock_mhz() * 1e6,
            views,
            flash_bytes: (name == "die").then_some(30 << 10),
            is_bilinear,
            has_mip_levels,
            // The corridor and the floor are long: their nearest ends fill the view.
            distance: if matches!(name, "corridor" | "floor") { 1.25 } else { 3.0 },
            ..Request::default()
        };
        scenes.push(Scene { name, file, request });
    }
    Ok(scenes)
}

/// The faces of a box by its corners from 1, x changing first.
const FACES: [[u32; 4]; 6] =
    [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];

fn cube() -> String {
    let faces = FACES.map(|[a, b, c, d]| format!("f {a} {b} {c} {d}\n"));
    cube_corners() + &faces.concat()
}

fn cube_corners() -> String {
    let corners = (0..8).map(|corner| {
        let [x, y, z] = [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1 } else { 1 });
        format!("v {x} {y} {z}\n")
    });
    corners.collect()
}

/// A cube with another part of the picture on each face.
fn die() -> String {
    let mut text = String::from("mtllib die.mtl\nusemtl a\n") + &cube_corners();
    for [column, row] in (0..6).map(|face| [face % 3, face / 3].map(f64::from)) {
        for [right, up] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            let _ = writeln!(text, "vt {:.6} {:.6}", (column + right) / 3.0, (row + up) / 2.0);
        }
    }
    for (face, corners) in FACES.into_iter().enumerate() {
        text.push('f');
        for (place, corner) in corners.into_iter().enumerate() {
            let _ = write!(text, " {corner}/{}", 4 * face + place + 1);
        }
        text.push('\n');
    }
    text
}

/// Red pips on fifteen greys.
fn pips(x: u32, y: u32) -> [u8; 3] {
    let from_middle = |c: u32| (c % 16).abs_diff(8);
    let is_pip = from_middle(x).pow(2) + from_middle(y).pow(2) < 20;
    let grey = (x / 16 + y / 16) as u8 * 12;
    if is_pip { [200, 20, 30] } else { [70 + grey; 3] }
}

/// A box between two corners.
fn boxed(text: &mut String, number: &mut u32, corners: [[f64; 3]; 8]) {
    for [x, y, z] in corners {
        let _ = writeln!(text, "v {x:.6} {y:.6} {z:.6}");
    }
    for face in FACES {
        let [a, b, c, d] = face.map(|corner| corner + *number);
        let _ = writeln!(text, "f {a} {b} {c} {d}");
    }
    *number += 8;
}

fn crossing() -> String {
    let (mut text, mut number) = (String::new(), 0);
    for beam in 0..3_u32 {
        // Turned by a third each, and tilted: over the next at one end, under the last at the
        // other.
        let (sin, cos) = (TAU * f64::from(beam) / 3.0).sin_cos();
        let corners = std::array::from_fn(|corner| {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let (along, across, up) = (1.1 * sign(0), 0.35 + 0.12 * sign(1), 0.06 * sign(2));
            [along * cos - across * sin, along * sin + across * cos, up + 0.22 * along]
        });
        boxed(&mut text, &mut number, corners);
    }
    text
}

fn blocks() -> String {
    let (mut text, mut number) = (String::new(), 0);
    let places = [[-0.5, -0.5], [0.5, -0.5], [-0.5, 0.5], [0.5, 0.5]];
    for (block, [x, z]) in places.into_iter().enumerate() {
        let _ = writeln!(text, "usemtl {block}");
        let height = 0.3 + 0.15 * block as f64;
        boxed(&mut text, &mut number, upright([x, -0.5, z], [0.3, height, 0.3]));
    }
    text += "usemtl plate\n";
    boxed(&mut text, &mut number, upright([0.0, -0.6, 0.0], [1.0, 0.1, 1.0]));
    text
}

/// The corners of a box that stands at a point, by half its widths and its height.
fn upright(at: [f64; 3], [width, height, depth]: [f64; 3]) -> [[f64; 3]; 8] {
    std::array::from_fn(|corner| {
        let is_far = |axis: usize| corner >> axis & 1 == 1;
        let side = |axis: usize, half: f64| if is_far(axis) { half } else { -half };
        let up = if is_far(1) { height } else { 0.0 };
        [at[0] + side(0, width), at[1] + up, at[2] + side(2, depth)]
    })
}

/// Two triangles, on which the picture lies eight times in each direction.
fn floor() -> String {
    let mut text = String::from("mtllib floor.mtl\nusemtl a\n");
    for [x, z] in [[0, 0], [0, 1], [1, 1], [1, 0]] {
        let _ = writeln!(text, "v {x} 0 {z}\nvt {} {}", 8 * x, 8 * z);
    }
    text + "f 1/1 2/2 3/3 4/4\n"
}

fn plates() -> String {
    let (mut text, mut number) = (String::new(), 0);
    for place in [0.0, 0.022] {
        let corners = std::array::from_fn(|corner: usize| {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let size = if place > 0.0 { 0.6 } else { 1.0 };
            [size * sign(0), size * sign(1), place + 0.01 * sign(2)]
        });
        text += if place > 0.0 { "usemtl b\n" } else { "usemtl a\n" };
        boxed(&mut text, &mut number, corners);
    }
    text
}

fn needle() -> String {
    let around = 150;
    let mut text = String::from("v 0 1 0\nv 0 -1 0\n");
    for i in 0..around {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(around)).sin_cos();
        let _ = writeln!(text, "v {:.6} 0 {:.6}", 0.16 * cos, 0.16 * sin);
    }
    for i in 0..around {
        let (this, next) = (i + 3, (i + 1) % around + 3);
        let _ = writeln!(text, "f 1 {next} {this}\nf 2 {this} {next}");
    }
    text
}

fn corridor() -> String {
    let (mut text, mut number) = (String::new(), 0);
    for side in 0..4_u32 {
        // Four walls of one box each, as long as the corridor.
        let (sin, cos) = (TAU * f64::from(side) / 4.0).sin_cos();
        let corners = std::array::from_fn(|corner: usize| {
            let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            let (out, across, along) = (0.27 + 0.02 * sign(0), 0.25 * sign(1), 0.9 * sign(2));
            [out * cos - across * sin, out * sin + across * cos, along]
        });
        boxed(&mut text, &mut number, corners);
    }
    text
}
