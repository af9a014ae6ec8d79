//! The bodies that costs are measured with. They are made for it, and no model of anyone.

use std::{
    f64::consts::TAU,
    fmt::Write as _,
    fs::{self, File},
    path::{Path, PathBuf},
};

use anyhow::{Context as _, Result};
use host_tools::{
    model::Options,
    plan::{Core, Paint, Request, Study, Types, View, Views},
};

/// How a body is made.
#[derive(Clone, Copy, Debug)]
struct Shape {
    name: &'static str,
    /// Quadrangles around the ring, and around its tube.
    around: [u32; 2],
    /// Whether each face is flat, so that no corner is shared.
    is_faceted: bool,
    /// Sheets of two triangles beside it, which are seen from one side alone.
    sheets: u32,
}

/// One of small triangles with shared corners, one of large ones without, and next to nothing, so
/// that what a frame takes by itself is told from what vertices and triangles do.
const SHAPES: [Shape; 3] = [
    Shape { name: "fine", around: [44, 22], is_faceted: false, sheets: 12 },
    Shape { name: "coarse", around: [12, 6], is_faceted: true, sheets: 24 },
    Shape { name: "tiny", around: [0, 0], is_faceted: true, sheets: 1 },
];

/// The bodies of all paints, in all views.
#[derive(Debug)]
pub(super) struct Bodies {
    /// By material, by vertex, and with a texture.
    studies: [Vec<Study>; 3],
}

impl Bodies {
    /// Makes them in a folder.
    pub(super) fn new(folder: &Path, core: Core) -> Result<Self> {
        let studies = ["plain", "colored", "textured"].map(|kind| {
            let of = |shape: &Shape| {
                let path = write(folder, shape, kind)?;
                let views = Views::List(views());
                let clock_hz = core.usual_clock_mhz() * 1e6;
                let request = Request { views, core, clock_hz, ..Request::default() };
                Ok(Study::new(&path, &Options::default(), &request, |_| ())?)
            };
            SHAPES.iter().map(of).collect::<Result<Vec<_>>>()
        });
        let [plain, colored, textured] = studies;
        Ok(Self { studies: [plain?, colored?, textured?] })
    }

    /// Those of some types, each with the rows that are drawn at a time. In bands, next to nothing
    /// is drawn in bands of two heights, so that what a band takes by itself is known.
    pub(super) fn of(&self, types: &Types) -> Vec<(&Study, u32)> {
        let studies = &self.studies[match types.paint {
            Paint::Materials => 0,
            Paint::Vertices => 1,
            Paint::Textures(..) => 2,
        }];
        let height = Request::default().display[1];
        let heights: &[u32] = if types.in_bands { &[16, 40, 16, 40] } else { &[height; 3] };
        let place = |place: usize| &studies[place.min(studies.len() - 1)];
        heights.iter().enumerate().map(|(number, &rows)| (place(number), rows)).collect()
    }
}

/// From all sides, near and far: pixels vary by a factor of 30 at the same vertices.
fn views() -> Vec<View> {
    let view = |number: u32| {
        let number = f64::from(number);
        // Steps of the golden angle meet no side twice.
        let turns_degrees = [137.5 * number, (100.0 * number) % 180.0 - 90.0, 61.0 * number];
        View { turns_degrees, distance: Some(1.8 * 1.16_f64.powf(number % 12.0)) }
    };
    (0..24).map(view).collect()
}

/// Writes the OBJ file of a body, its library and its texture.
fn write(folder: &Path, shape: &Shape, kind: &str) -> Result<PathBuf> {
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let path = folder.join(format!("{}_{kind}.obj", shape.name));
    let library = if kind == "textured" {
        texture(&folder.join("texture.png"))?;
        "newmtl a\nKd 1 1 1\nmap_Kd texture.png\n"
    } else {
        "newmtl a\nKd 0.8 0.3 0.2\nnewmtl b\nKd 0.2 0.6 0.9\n"
    };
    fs::write(folder.join(format!("{kind}.mtl")), library)?;
    let obj = obj(shape, kind);
    fs::write(&path, obj).with_context(|| path.display().to_string())?;
    Ok(path)
}

fn obj(shape: &Shape, kind: &str) -> String {
    let [around, tube] = shape.around;
    let mut text = format!("mtllib {kind}.mtl\nusemtl a\n");
    if shape.is_faceted {
        text += "s off\n";
    } else {
        text += "s 1\n";
    }
    let point = |text: &mut String, place: [f64; 3]| {
        let [x, y, z] = place;
        let _ = write!(text, "v {x:.6} {y:.6} {z:.6}");
        if kind == "colored" {
            let _ = write!(text, " {:.3} {:.3} {:.3}", x / 4.0 + 0.5, y / 4.0 + 0.5, z / 4.0 + 0.5);
        }
        text.push('\n');
    };
    for i in 0..around {
        for j in 0..tube {
            let [a, b] = [(i, around), (j, tube)].map(|(k, n)| TAU * f64::from(k) / f64::from(n));
            let radius = 1.0 + 0.45 * b.cos();
            point(&mut text, [radius * a.cos(), radius * a.sin(), 0.45 * b.sin()]);
        }
    }
    for i in 0..=around {
        for j in 0..=tube {
            // The texture lies on it once, as on most models.
            let [u, v] = [f64::from(i) / f64::from(around), f64::from(j) / f64::from(tube)];
            let _ = writeln!(text, "vt {u:.6} {v:.6}");
        }
    }
    for i in 0..around {
        for j in 0..tube {
            let corner =
                |i: u32, j: u32| (i % around * tube + j % tube + 1, i * (tube + 1) + j + 1);
            let corners = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            text.push('f');
            for (vertex, coordinate) in corners {
                let _ = write!(text, " {vertex}/{coordinate}");
            }
            text.push('\n');
        }
    }
    if kind != "textured" {
        text += "usemtl b\n";
    }
    let first = around * tube + 1;
    let coordinate = (around + 1) * (tube + 1) + 1;
    text += "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    for sheet in 0..shape.sheets {
        // Beside each other in the opening of the ring, in planes of their own.
        let angle = TAU * f64::from(sheet) / f64::from(shape.sheets);
        let (sin, cos) = angle.sin_cos();
        let height = 0.3 * (3.0 * angle).sin();
        for [along, across] in [[0.05, -0.05], [0.45, -0.05], [0.45, 0.05], [0.05, 0.05]] {
            let place = [along * cos - across * sin, along * sin + across * cos, height + across];
            point(&mut text, place);
        }
    }
    for sheet in 0..shape.sheets {
        text.push('f');
        for corner in 0..4 {
            let _ = write!(text, " {}/{}", first + 4 * sheet + corner, coordinate + corner);
        }
        text.push('\n');
    }
    text
}

/// Bricks of 200 colours.
fn texture(path: &Path) -> Result<()> {
    picture(path, |x, y| {
        let is_joint = y % 16 < 2 || (x + y / 16 * 8) % 32 < 2;
        let grain = ((x * 7 + y * 13) % 40) as u8;
        if is_joint { [180, 170 + grain, 160] } else { [120 + 2 * grain, 50 + grain, 40] }
    })
}

/// Writes a picture of 128 x 128 pixels.
pub(super) fn picture(path: &Path, pixel: impl Fn(u32, u32) -> [u8; 3]) -> Result<()> {
    const SIDE: u32 = 128;
    let pixels: Vec<u8> =
        (0..SIDE * SIDE).flat_map(|place| pixel(place % SIDE, place / SIDE)).collect();
    let file = File::create(path).with_context(|| path.display().to_string())?;
    let mut encoder = png::Encoder::new(file, SIDE, SIDE);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
