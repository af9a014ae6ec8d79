//! The options of the view.

use clap::{
    Args,
    builder::{PossibleValuesParser, TypedValueParser},
};
use host_tools::{
    check::{
        BACKGROUND, Blending, Colors, Correction, DepthFormat, Display, Filter, Fog, FogBy, Lamp,
        MOST_LIGHTS, Matrix, Projection, Shading, Subpixel, Sun, View, ViewLights,
    },
    model::{Model, Options},
    reference,
};
use serde::Serialize;

use super::{smoothing::Smoothing, textures::TextureArguments};

/// The largest width and height of a picture: the core's own limit.
const MAX_SIZE: u32 = 2048;

const SUBPIXELS: [(&str, Subpixel); 2] = [("4", Subpixel::S4), ("8", Subpixel::S8)];

/// The view: from a point on the z axis toward the origin, about which the model is turned.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "View")]
pub(super) struct ViewOptions {
    /// Width and height of the picture in pixels, 1x1 to 2048x2048
    #[arg(long, value_name = "WxH", default_value = "320x240", value_parser = size)]
    size: [u32; 2],
    /// Fraction bits of a pixel coordinate
    #[arg(
        long,
        value_name = "BITS",
        default_value = name(&SUBPIXELS, View::default().subpixel),
        value_parser = choice(&SUBPIXELS)
    )]
    subpixel: Subpixel,
    /// Format of the depth buffer
    #[arg(
        long,
        value_name = "FORMAT",
        default_value = name(&DepthFormat::NAMES, View::default().depth),
        value_parser = choice(&DepthFormat::NAMES)
    )]
    depth: DepthFormat,
    /// How triangles are coloured [default: textured-gouraud if the model has textures,
    /// colored-gouraud if its vertices have colours, otherwise gouraud]
    #[arg(long, value_parser = choice(&Shading::NAMES))]
    shading: Option<Shading>,
    /// Where texture coordinates are divided: nowhere, at every pixel, at every N-th, or as often
    /// as half a texel needs it
    #[arg(
        long,
        value_name = "MODE",
        default_value = name(&Correction::NAMES, View::default().perspective),
        value_parser = choice(&Correction::NAMES)
    )]
    perspective: Correction,
    /// How a colour is taken from a texture; mipmap and trilinear make its mip levels
    #[arg(
        long,
        default_value = name(&Filter::NAMES, View::default().filter),
        value_parser = choice(&Filter::NAMES)
    )]
    filter: Filter,
    /// The colours of the display, which shows the nearest of them
    #[arg(long, value_name = "FORMAT", value_parser = choice(&Colors::NAMES))]
    colors: Option<Colors>,
    /// Dither to them instead, by a matrix of this many rows
    #[arg(long, value_name = "ROWS", requires = "colors", value_parser = choice(&Matrix::NAMES))]
    dither: Option<Matrix>,
    /// How pixels are put onto the picture; all but replace draw every layer from back to front,
    /// with the opacity of the materials
    #[arg(
        long,
        value_name = "MODE",
        default_value = name(&Blending::NAMES, View::default().blending),
        value_parser = choice(&Blending::NAMES)
    )]
    blend: Blending,
    /// What the opacity of all materials is multiplied by with --blend, 0 to 1 in steps of 1/256
    #[arg(
        long,
        value_name = "PART",
        default_value_t = View::default().opacity,
        value_parser = within(0.0, 1.0),
        allow_negative_numbers = true
    )]
    opacity: f64,
    /// Fog by the distance from the camera's plane: none up to START and all from END on, or e to
    /// the -DENSITY a unit
    #[arg(long, value_name = "linear:START:END|exp:DENSITY", value_parser = fog)]
    fog: Option<reference::Fog>,
    /// Where fog is computed
    #[arg(
        long,
        value_name = "WHERE",
        requires = "fog",
        default_value = name(&FogBy::NAMES, FogBy::default()),
        value_parser = choice(&FogBy::NAMES)
    )]
    fog_by: FogBy,
    /// Distance of the camera from the origin; a model is fitted into a sphere of radius 1
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().distance,
        value_parser = within(0.0, 32_000.0),
        allow_negative_numbers = true
    )]
    distance: f64,
    /// Vertical field of view of a perspective camera
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 40.0,
        value_parser = within(0.01, 179.9),
        allow_negative_numbers = true
    )]
    fov: f64,
    /// Use an orthographic camera instead; the picture shows this many units from top to bottom
    #[arg(
        long,
        value_name = "HEIGHT",
        conflicts_with = "fov",
        value_parser = within(1.0 / 65_536.0, 32_000.0),
        allow_negative_numbers = true
    )]
    orthographic: Option<f64>,
    /// Distance of the near plane from the camera
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().near,
        value_parser = within(1.0 / 65_536.0, 65_535.0),
        allow_negative_numbers = true
    )]
    near: f64,
    /// Distance of the far plane
    #[arg(
        long,
        value_name = "UNITS",
        default_value_t = View::default().far,
        value_parser = within(1.0 / 65_536.0, 65_535.0),
        allow_negative_numbers = true
    )]
    far: f64,
    /// Turn of the model about y (up), the first of three turns
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().yaw_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    yaw: f64,
    /// Turn about x (right)
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().pitch_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    pitch: f64,
    /// Turn about z (toward the viewer), the last turn
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = View::default().roll_degrees,
        value_parser = within(-3_600.0, 3_600.0),
        allow_negative_numbers = true
    )]
    roll: f64,
    /// A distant light: the direction towards it, and its level [default: 0.8]; up to 4 of them, in
    /// place of one over the left shoulder
    #[arg(
        long,
        value_name = "X,Y,Z[,LEVEL]",
        value_parser = sun,
        allow_hyphen_values = true
    )]
    light: Vec<Sun>,
    /// A light at a point, where the camera looks at the origin from the z axis, and the distance
    /// at which its level is half; up to 4 of them
    #[arg(long, value_name = "X,Y,Z,HALF", value_parser = lamp, allow_hyphen_values = true)]
    lamp: Vec<Lamp>,
    #[command(flatten)]
    smoothing: Smoothing,
    /// Turn over faces that run against their neighbours, and closed parts that are inside out
    #[arg(long)]
    fix_winding: bool,
    /// Frames of a full turn about y, 1 to 360
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        value_parser = clap::value_parser!(u32).range(1..=360)
    )]
    pub(super) frames: u32,
    #[command(flatten)]
    textures: TextureArguments,
}

impl ViewOptions {
    /// The view of frame 0, in the shading `otherwise` unless one is chosen.
    pub(super) fn view(&self, otherwise: Shading) -> View {
        View {
            size: self.size,
            distance: self.distance,
            projection: self
                .orthographic
                .map_or(Projection::Perspective { field_of_view_degrees: self.fov }, |height| {
                    Projection::Orthographic { height }
                }),
            near: self.near,
            far: self.far,
            yaw_degrees: self.yaw,
            pitch_degrees: self.pitch,
            roll_degrees: self.roll,
            subpixel: self.subpixel,
            depth: self.depth,
            shading: self.shading.unwrap_or(otherwise),
            perspective: self.perspective,
            filter: self.filter,
            display: self
                .colors
                .map(|colors| Display { colors, dither: self.dither.unwrap_or_default() }),
            lights: self.lights(),
            blending: self.blend,
            background: BACKGROUND,
            opacity: self.opacity,
            fog: self.fog.map(|law| Fog { law, by: self.fog_by, color: BACKGROUND }),
        }
    }

    /// The lights; more of them than fit are left out, which [`check`](Self::check) refuses.
    fn lights(&self) -> ViewLights {
        if self.light.is_empty() && self.lamp.is_empty() {
            return ViewLights::default();
        }
        let nth = |i: usize| self.light.get(i).copied();
        let nth_lamp = |i: usize| self.lamp.get(i).copied();
        ViewLights { suns: std::array::from_fn(nth), lamps: std::array::from_fn(nth_lamp) }
    }

    /// Refuses more lights than a view has.
    pub(super) fn check(&self) -> anyhow::Result<()> {
        for (option, count) in [("--light", self.light.len()), ("--lamp", self.lamp.len())] {
            anyhow::ensure!(
                count <= MOST_LIGHTS,
                "{option} is given {count} times: a view has {MOST_LIGHTS} at most"
            );
        }
        Ok(())
    }

    /// The conversion of the model for it.
    pub(super) fn conversion(&self) -> Options {
        let mut textures = self.textures.options();
        if let Some(textures) = &mut textures {
            textures.mipmaps |= self.filter.reads_levels();
        }
        Options { fix_winding: self.fix_winding, textures, ..self.smoothing.options() }
    }
}

/// A view in the names and units of the command line.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Settings {
    size: [u32; 2],
    subpixel: u32,
    depth: &'static str,
    shading: &'static str,
    perspective: &'static str,
    filter: &'static str,
    lights: Vec<[f64; 4]>,
    lamps: Vec<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    colors: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    dither: Option<u32>,
    blend: &'static str,
    opacity: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    fog: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fog_by: Option<&'static str>,
    distance: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    fov: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<f64>,
    near: f64,
    far: f64,
    yaw: f64,
    pitch: f64,
    roll: f64,
    crease: f64,
}

impl Settings {
    pub(super) fn of(model: &Model, view: &View) -> Self {
        let (fov, height) = match view.projection {
            Projection::Perspective { field_of_view_degrees } => {
                (Some(field_of_view_degrees), None)
            }
            Projection::Orthographic { height } => (None, Some(height)),
        };
        Self {
            size: view.size,
            subpixel: view.subpixel.bits(),
            depth: name(&DepthFormat::NAMES, view.depth),
            shading: name(&Shading::NAMES, view.shading),
            perspective: name(&Correction::NAMES, view.perspective),
            filter: name(&Filter::NAMES, view.filter),
            colors: view.display.map(|display| name(&Colors::NAMES, display.colors)),
            dither: view.display.and_then(|display| display.dither.rows()),
            lights: (view.lights.suns.iter().flatten())
                .map(|&Sun { toward: [x, y, z], level }| [x, y, z, level])
                .collect(),
            lamps: (view.lights.lamps.iter().flatten())
                .map(|&Lamp { position: [x, y, z], half }| [x, y, z, half])
                .collect(),
            blend: name(&Blending::NAMES, view.blending),
            opacity: view.opacity,
            fog: view.fog.map(|fog| law(fog.law)),
            fog_by: view.fog.map(|fog| name(&FogBy::NAMES, fog.by)),
            distance: view.distance,
            fov,
            height,
            near: view.near,
            far: view.far,
            yaw: view.yaw_degrees,
            pitch: view.pitch_degrees,
            roll: view.roll_degrees,
            crease: model.options.crease_degrees,
        }
    }

    /// The settings in a line.
    pub(super) fn summary(&self) -> String {
        let [width, height] = self.size;
        let textures = if self.shading.starts_with("textured") {
            format!(", {} filter, {} perspective", self.filter, self.perspective)
        } else {
            String::new()
        };
        let blend = if self.blend == name(&Blending::NAMES, Blending::Replace) {
            String::new()
        } else {
            format!(", blended by {} at {} of its opacity", self.blend, self.opacity)
        };
        let fog = match (&self.fog, self.fog_by) {
            (Some(fog), Some(by)) => format!(", fog {fog} by {by}"),
            _ => String::new(),
        };
        let dither =
            self.dither.map_or_else(String::new, |rows| format!(" dithered {rows}x{rows}"));
        let colors =
            self.colors.map_or_else(String::new, |name| format!(", {name} colours{dither}"));
        format!(
            "{width}x{height} pixels, {} sub-pixel bits, {} depth, {} shading{textures}{fog}{blend}{colors}",
            self.subpixel, self.depth, self.shading
        )
    }
}

/// The name of a value.
fn name<T: PartialEq>(table: &[(&'static str, T)], value: T) -> &'static str {
    table.iter().find(|(_, v)| *v == value).map_or("", |(name, _)| name)
}

/// A parser of the names in a table.
pub(super) fn choice<T: Copy + Send + Sync + 'static, const N: usize>(
    table: &'static [(&'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(table.iter().map(|(name, _)| *name)).try_map(|given| {
        let found = table.iter().find(|(name, _)| *name == given);
        found.map(|(_, value)| *value).ok_or("unknown name")
    })
}

/// A parser of numbers from `least` to `most`. Infinities and NaN lie in no such range.
pub(super) fn within(
    least: f64,
    most: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let number = text.parse().ok().filter(|n| (least..=most).contains(n));
        number.ok_or_else(|| format!("it must be a number from {least} to {most}"))
    }
}

/// Numbers with commas between them.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.trim().parse().ok().filter(|n: &f64| n.abs() <= 32_000.0);
    text.split(',').map(number).collect()
}

/// A direction and a level, as in -1,2,3,0.5.
fn sun(text: &str) -> Result<Sun, String> {
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z]) => Some(Sun { toward: [x, y, z], level: 0.8 }),
        Some(&[x, y, z, level]) => Some(Sun { toward: [x, y, z], level }),
        _ => None,
    };
    // A step of the core's numbers.
    let is_direction = |sun: &Sun| sun.toward.iter().any(|c| c.abs() >= 1.0 / 65_536.0);
    found.filter(|sun| is_direction(sun) && (0.0..=1.0).contains(&sun.level)).ok_or_else(|| {
        "write a direction x,y,z that is not zero, of numbers up to 32000, and a level from 0 to \
         1, as in -1,2,3,0.5"
            .to_owned()
    })
}

/// A place and a distance, as in 1,2,0.5,1.5.
fn lamp(text: &str) -> Result<Lamp, String> {
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z, half]) => Some(Lamp { position: [x, y, z], half }),
        _ => None,
    };
    found.filter(|lamp| lamp.half >= 1.0 / 65_536.0).ok_or_else(|| {
        "write a place x,y,z and the distance at which the level is half, over 0, of numbers up to \
         32000, as in 1,2,0.5,1.5"
            .to_owned()
    })
}

/// A law of fog, as in linear:2:10 or exp:0.3.
fn fog(text: &str) -> Result<reference::Fog, String> {
    let number = |text: &str, most: f64| within(0.0, most)(text);
    if let Some(density) = text.strip_prefix("exp:") {
        return Ok(reference::Fog::Exponential { density: number(density, 255.0)? });
    }
    let ends = text.strip_prefix("linear:").and_then(|ends| ends.split_once(':'));
    let (start, end) = ends.ok_or("write linear:START:END or exp:DENSITY, as in exp:0.3")?;
    let [start, end] = [number(start, 65_535.0)?, number(end, 65_535.0)?];
    if end <= start {
        return Err("it must end beyond its start".into());
    }
    Ok(reference::Fog::Linear { start, end })
}

/// The law as it is written.
fn law(law: reference::Fog) -> String {
    match law {
        reference::Fog::Linear { start, end } => format!("linear:{start}:{end}"),
        reference::Fog::Exponential { density } => format!("exp:{density}"),
    }
}

/// Width and height, as in 320x240.
fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|n| (1..=MAX_SIZE).contains(n));
    let sides = text.split_once(['x', 'X']).and_then(|(w, h)| Some([side(w)?, side(h)?]));
    sides.ok_or_else(|| {
        format!("write width x height in pixels, each from 1 to {MAX_SIZE}, as in 320x240")
    })
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use host_tools::reference::Blend;

    use super::*;

    #[derive(Debug, Parser)]
    struct Only {
        #[command(flatten)]
        view: ViewOptions,
    }

    fn parse(arguments: &[&str]) -> Result<ViewOptions, String> {
        let line = ["x"].iter().chain(arguments);
        Only::try_parse_from(line).map(|only| only.view).map_err(|error| error.to_string())
    }

    #[test]
    fn no_options_give_the_library_s_defaults() {
        let options = parse(&[]).unwrap();
        assert_eq!(options.view(Shading::default()), View::default());
        assert_eq!(options.conversion(), Options::default());
    }

    #[test]
    fn every_option_arrives() {
        let line = "--size 7x9 --subpixel 4 --depth u32 --shading flat --perspective \
                    every-16 --filter trilinear --fog linear:1.5:9 --fog-by vertex --blend screen --opacity 0.25 --distance 4 --orthographic 2.5 --near 1 --far 9 --yaw -1 --pitch 2 --roll 3 \
                    --crease 10 --frames 5 --light -1,2,3 --light 0,-1,.5,0.25 --lamp -1,0,2,1.5 --colors gray2 --dither 4";
        let options = parse(&line.split(' ').collect::<Vec<_>>()).unwrap();
        let expected = View {
            size: [7, 9],
            distance: 4.0,
            projection: Projection::Orthographic { height: 2.5 },
            near: 1.0,
            far: 9.0,
            yaw_degrees: -1.0,
            pitch_degrees: 2.0,
            roll_degrees: 3.0,
            subpixel: Subpixel::S4,
            depth: DepthFormat::U32,
            shading: Shading::Flat,
            perspective: Correction::Every16,
            filter: Filter::Trilinear,
            display: Some(Display { colors: Colors::Gray2, dither: Matrix::Four }),
            lights: ViewLights {
                suns: [
                    Some(Sun { toward: [-1.0, 2.0, 3.0], level: 0.8 }),
                    Some(Sun { toward: [0.0, -1.0, 0.5], level: 0.25 }),
                    None,
                    None,
                ],
                lamps: [Some(Lamp { position: [-1.0, 0.0, 2.0], half: 1.5 }), None, None, None],
            },
            blending: Blending::By(Blend::Screen),
            background: BACKGROUND,
            opacity: 0.25,
            fog: Some(Fog {
                law: reference::Fog::Linear { start: 1.5, end: 9.0 },
                by: FogBy::Vertex,
                color: BACKGROUND,
            }),
        };
        assert_eq!(options.view(Shading::Unlit), expected);
        let conversion = options.conversion();
        assert_eq!((conversion.crease_degrees, options.frames), (10.0, 5));
        assert!(!conversion.smoothing_groups, "the angle goes before the file's groups");
    }

    #[test]
    fn silly_values_are_refused_by_name() {
        for (option, values) in [
            ("--size", &["0x0", "99999x1", "1x2049", "x", "", "-1x1", "3.5x1", "320", "1x1x1"][..]),
            ("--distance", &["NaN", "inf", "-1", "1e300", "", "far"]),
            ("--fov", &["0", "180", "NaN", "-40"]),
            ("--orthographic", &["0", "nan", "1e9"]),
            ("--near", &["0", "-0.1", "NaN", "1e-300"]),
            ("--far", &["inf", "0"]),
            ("--yaw", &["NaN", "1e300", "-infinity"]),
            ("--crease", &["181", "-1", "NaN"]),
            ("--frames", &["0", "-3", "361", "1.5", "99999999999999"]),
            ("--depth", &["u8", "", "U16"]),
            ("--subpixel", &["5", ""]),
            ("--shading", &["toon"]),
            ("--light", &["0,0,0", "1,2", "1,2,3,4", "1,2,3,0.5,6", "nan,0,1", "", "1e9,0,0"]),
            ("--lamp", &["1,2,3", "1,2,3,0", "1,2,3,-1", "1,2,inf,1", ""]),
            ("--perspective", &["every-5", "every", ""]),
            ("--filter", &["linear", "Nearest"]),
            ("--colors", &["rgb", "", "1"]),
            ("--dither", &["2", "", "bayer"]),
            ("--blend", &["alpha", ""]),
            ("--opacity", &["1.1", "-0.5", "NaN"]),
            (
                "--fog",
                &[
                    "",
                    "exp",
                    "exp:",
                    "exp:-1",
                    "exp:nan",
                    "linear:1",
                    "linear:2:2",
                    "linear:3:1",
                    "3",
                ],
            ),
            ("--fog-by", &["pixel", "face"]),
        ] {
            for value in values {
                let error = parse(&[&format!("{option}={value}")]).unwrap_err();
                assert!(error.contains(option), "{option}={value}: {error}");
            }
        }
        assert!(parse(&["--fov=30", "--orthographic=2"]).is_err());
        assert!(parse(&["--dither=8"]).is_err(), "colours to dither to are missing");
    }
}
