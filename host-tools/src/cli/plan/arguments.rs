//! What a plan is made for.

use std::{fs, path::PathBuf};

use anyhow::{Context as _, Result, bail, ensure};
use clap::{ArgAction, Args};
use host_tools::{
    model::{Options, TextureOptions},
    plan::{Core, Request, View, Views},
};

use super::super::{
    smoothing::Smoothing,
    view::{choice, numbers, size, within},
};

const EXAMPLES: &str = "\
Examples:
  host-tools plan model.obj
  host-tools plan model.obj --display 240x240 --core m4 --ram 128K --fps 30 --bus 40MHz
  host-tools plan model.obj --ram 32K --flash 48K --explain
  host-tools plan model.obj --flash 48K --palette-db 35
  host-tools plan model.obj --views orbit              Turned in any way, by random views
  host-tools plan model.obj --views views.txt          From these places alone
  host-tools plan model.obj -o firmware/src/scene.rs

A file of views has one in each line: turns about y, x and z in degrees, in this order, and if it is
not that of --distance the camera's distance; # begins a comment.

Which surface is seen is decided by the order of the mesh, if that is right in all views; by another
order of the triangles in flash, if one is; by planes that keep parts of the mesh apart, from back to
front; by sorting in each frame; or by depth. If no order is right, a cycle of triangles that hide each
other is named, by their numbers in the converted mesh from 0. An order for an orbit is made from its
views and judged by as many others.

Use the file as a module of the firmware (`mod scene;`), give its memory to a static and draw:

  static MEMORY: ConstStaticCell<scene::Memory> = ConstStaticCell::new(scene::Memory::EMPTY);
  let memory = MEMORY.take();
  scene::draw(&mut display, memory, step)?;

Flash and RAM are those of the picture alone, in a program compiled for speed (opt-level 3) with LTO.
Cycles are those of a core whose memory never waits, with a driver that takes a pixel in a few
cycles. They are within 15 % for most models (tests/measure/PLANS.md), but rough for textures, whose
set-up depends on their coordinates.

Textures become as small as they are seen. A palette of 256 or 16 colours is taken if it has the same
colours as without one, or is as near to them as --palette-db says: where it takes at most 2 % more
time, or where 16 bits for each texel do not fit the flash.

They have mip levels if a tenth of the pixels would leave out most of the texels that they cover: one
level for each triangle, or one for each pixel if distances differ by more than a factor of two within
a triangle.

Not planned: lines and points, highlights, fog, blending, shadows, trilinear filters, several objects.

Exit status: 0 for success, 1 if it is slower than --fps, 2 for bad usage, bad input, or if nothing
fits.";

/// Find out what a model needs on a display, and write a renderer that has just that
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(in crate::cli) struct Arguments {
    /// The OBJ file
    pub(super) model: PathBuf,
    /// Where to write the Rust file; - for the standard output, without the report [default: the
    /// model's name with _plan.rs, in this directory]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Overwrite a file that is not from this program
    #[arg(long)]
    pub(super) force: bool,
    /// Print the plan as one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// Show what each other renderer would take, and why it is not chosen
    #[arg(long)]
    pub(super) explain: bool,
    /// Width and height of the display in pixels
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = size)]
    display: [u32; 2],
    /// The microcontroller's core; one with an M3 or M33 takes about as long as an M4
    #[arg(long, default_value = "m0plus", value_parser = choice(&Core::NAMES))]
    core: Core,
    /// The core's clock, as in 48MHz [default: 125MHz for m0plus, 168MHz for m4, 150MHz for riscv]
    #[arg(long, value_name = "HZ", value_parser = hertz)]
    clock: Option<f64>,
    /// The RAM for buffers and stack, as in 20K or 1M
    #[arg(long, value_name = "BYTES", default_value = "64K", value_parser = bytes)]
    ram: u32,
    /// The flash for code and tables [default: as much as it takes]
    #[arg(long, value_name = "BYTES", value_parser = bytes)]
    flash: Option<u32>,
    /// Frames that must be shown in a second
    #[arg(long, value_name = "N", value_parser = within(0.01, 1_000.0))]
    fps: Option<f64>,
    /// Bits that the display's bus takes in a second, as in 62.5MHz; 16 for a pixel are sent after
    /// each band is drawn [default: no limit]
    #[arg(long, value_name = "HZ", value_parser = hertz)]
    bus: Option<f64>,
    /// Where the model is seen from: turntable, orbit, or a file of views
    #[arg(long, value_name = "VIEWS", default_value = "turntable")]
    views: String,
    /// Into how many steps a turntable divides a turn: a power of two
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=65_536))]
    steps: u32,
    /// How many random views an orbit has
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u32).range(10..=100_000))]
    samples: u32,
    /// How far a turntable is tilted about x (right)
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 20.0,
        value_parser = within(-90.0, 90.0),
        allow_negative_numbers = true
    )]
    pitch: f64,
    /// Distance of the camera from the origin; a model is fitted into a sphere of radius 1
    #[arg(long, value_name = "UNITS", default_value_t = 3.0, value_parser = within(0.0, 16_000.0))]
    distance: f64,
    /// Vertical field of view of the camera
    #[arg(long, value_name = "DEGREES", default_value_t = 40.0, value_parser = within(1.0, 179.0))]
    fov: f64,
    /// Where light comes from, and its ambient and diffuse levels
    #[arg(
        long,
        value_name = "X,Y,Z,A,D",
        default_value = "-1,2,3,0.2,0.8",
        value_parser = light,
        allow_hyphen_values = true
    )]
    light: [f64; 5],
    /// Light of triangles or of vertices [default: what the model needs]
    #[arg(long, value_parser = choice(&[("flat", false), ("smooth", true)]))]
    shading: Option<bool>,
    /// Pixels of a view that may show another surface than the nearest, in per cent of those that
    /// show the model
    #[arg(long, value_name = "PERCENT", default_value_t = 0.1, value_parser = within(0.0, 100.0))]
    wrong: f64,
    /// How far a texture may be shifted by perspective that is not corrected
    #[arg(long, value_name = "TEXELS", default_value_t = 0.5, value_parser = within(0.0, 1_024.0))]
    texels: f64,
    /// How near a palette's colours must be to those of 16 bits: their peak signal-to-noise ratio,
    /// as in 35 [default: the same colours]
    #[arg(long, value_name = "DB", value_parser = within(0.0, 200.0))]
    palette_db: Option<f64>,
    /// Which texels make the colour of a pixel: the nearest one, or four that are mixed, which is
    /// smooth where texels are seen large
    #[arg(
        long,
        action = ArgAction::Set,
        default_value = "nearest",
        value_parser = choice(&[("nearest", false), ("bilinear", true)])
    )]
    filter: bool,
    /// Whether textures have mip levels [default: where the views need them]
    #[arg(long, value_parser = choice(&[("no", false), ("yes", true)]))]
    mipmaps: Option<bool>,
    #[command(flatten)]
    smoothing: Smoothing,
    /// Leave the pictures of materials out: they are drawn in their colours (`Kd`)
    #[arg(long)]
    no_textures: bool,
}

impl Arguments {
    /// How the model is converted.
    pub(super) fn options(&self) -> Options {
        let textures = (!self.no_textures).then(TextureOptions::default);
        Options { textures, ..self.smoothing.options() }
    }

    /// What the picture is wanted for.
    pub(super) fn request(&self) -> Result<Request> {
        let [x, y, z, ambient, diffuse] = self.light;
        Ok(Request {
            display: self.display,
            core: self.core,
            ram_bytes: self.ram,
            flash_bytes: self.flash,
            frames_per_second: self.fps,
            clock_hz: self.clock.unwrap_or(self.core.usual_clock_mhz() * 1e6),
            bus_hz: self.bus,
            views: self.views()?,
            distance: self.distance,
            field_of_view_degrees: self.fov,
            light: ([x, y, z], [ambient, diffuse]),
            is_smooth: self.shading,
            background: [0; 3],
            wrong_part: self.wrong / 100.0,
            texels: self.texels,
            is_bilinear: self.filter,
            has_mip_levels: self.mipmaps,
            palette_db: self.palette_db.unwrap_or(f64::INFINITY),
        })
    }

    fn views(&self) -> Result<Views> {
        match &*self.views {
            "turntable" => {
                let steps = self.steps;
                ensure!(
                    steps.is_power_of_two(),
                    "--steps {steps}: it must be a power of two, so that steps are exact angles"
                );
                Ok(Views::Turntable { steps, pitch_degrees: self.pitch })
            }
            "orbit" => Ok(Views::Orbit { count: self.samples }),
            file => {
                let text = fs::read_to_string(file).with_context(|| {
                    format!("--views {file}: it is neither turntable nor orbit, nor a file")
                });
                list(file, &text?)
            }
        }
    }
}

/// Reads a file of views.
fn list(file: &str, text: &str) -> Result<Views> {
    let mut views = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.is_empty() {
            continue;
        }
        let numbers: Option<Vec<f64>> =
            words.iter().map(|word| word.parse().ok().filter(|n: &f64| n.is_finite())).collect();
        let view = match numbers.as_deref() {
            Some(&[y, x, z]) => View { turns_degrees: [y, x, z], distance: None },
            Some(&[y, x, z, distance]) if distance > 0.0 => {
                View { turns_degrees: [y, x, z], distance: Some(distance) }
            }
            _ => bail!(
                "{file}:{}: a view is three turns in degrees and, if it has its own, a distance \
                 above 0",
                number + 1
            ),
        };
        views.push(view);
    }
    ensure!(!views.is_empty(), "{file} has no views: write three turns in degrees into a line");
    Ok(Views::List(views))
}

/// A number of bytes.
fn bytes(text: &str) -> Result<u32, String> {
    let (number, factor) = match text.split_at(text.len().saturating_sub(1)) {
        (number, "K" | "k") if !number.is_empty() => (number, 1_024.0),
        (number, "M" | "m") if !number.is_empty() => (number, 1_048_576.0),
        _ => (text, 1.0),
    };
    let bytes = number.parse().ok().map(|number: f64| number * factor);
    let bytes = bytes.filter(|bytes| (1.0..=4_294_967_295.0).contains(bytes));
    bytes.map(|bytes| bytes as u32).ok_or_else(|| "it must be bytes, as in 65536, 64K or 1M".into())
}

/// A frequency.
fn hertz(text: &str) -> Result<f64, String> {
    let units = [("MHz", 1e6), ("kHz", 1e3), ("Hz", 1.0), ("M", 1e6), ("", 1.0)];
    let parse = |(unit, factor): (&str, f64)| {
        let number: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * factor)
    };
    let hertz = units.into_iter().find_map(parse).filter(|hertz| (1_000.0..=1e10).contains(hertz));
    hertz.ok_or_else(|| "it must be a frequency from 1kHz on, as in 62.5MHz".into())
}

/// A direction and two levels.
fn light(text: &str) -> Result<[f64; 5], String> {
    let light = numbers(text).and_then(|numbers| <[f64; 5]>::try_from(numbers).ok());
    let is_light = |light: &[f64; 5]| {
        let [x, y, z, levels @ ..] = light;
        [x, y, z].iter().any(|&&c| c != 0.0) && levels.iter().all(|l| (0.0..=1.0).contains(l))
    };
    light.filter(is_light).ok_or_else(|| {
        "it must be a direction and two levels from 0 to 1: x,y,z,ambient,diffuse".into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_have_units() {
        assert_eq!(bytes("65536"), Ok(65_536));
        assert_eq!(bytes("64K"), Ok(65_536));
        assert_eq!(bytes("1.5M"), Ok(1_572_864));
        for text in ["", "K", "-1", "64KB", "9G", "NaN"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn frequencies_have_units() {
        assert_eq!(hertz("62.5MHz"), Ok(62_500_000.0));
        assert_eq!(hertz("48 MHz"), Ok(48_000_000.0));
        assert_eq!(hertz("400kHz"), Ok(400_000.0));
        for text in ["", "MHz", "0", "inf", "5 parsecs", "-3MHz"] {
            assert!(hertz(text).is_err(), "{text}");
        }
    }

    #[test]
    fn views_are_read_from_lines() {
        let views = list("v", "# yaw pitch roll\n10 20 30\n\n 40 50 60 2.5 # near\n").unwrap();
        let of = |turns_degrees, distance| View { turns_degrees, distance };
        let expected = [of([10.0, 20.0, 30.0], None), of([40.0, 50.0, 60.0], Some(2.5))];
        assert_eq!(views, Views::List(expected.into()));
        for (text, expected) in
            [("1 2 3\n1 2", "v:2"), ("1 2 x", "v:1"), ("1 2 3 0", "v:1"), ("# none", "no views")]
        {
            let error = list("v", text).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
