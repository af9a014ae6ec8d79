//! The command `render`: the picture that a display shows.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, ensure};
use clap::{
    Args,
    builder::{PathBufValueParser, TypedValueParser as _},
};
use host_tools::{
    check::{
        self, BACKGROUND, Colors, Display, Edges, FixedPicture, Fog, LineOptions, Matrix, Shading,
        View, ViewError,
    },
    model::{Model, Options},
};

use super::{
    Done, convert, image,
    output::{self, Overwriting},
    png,
    progress::Progress,
    view::{MAX_SIZE, ViewOptions, choice, within},
};

const EXAMPLES: &str = "\
Examples:
  host-tools render model.obj
  host-tools render model.obj -o logo.png --size 240x240 --yaw 45 --pitch 30
  host-tools render model.obj --shading flat --rgb565
  host-tools render model.obj --colors binary --dither 8 --size 128x64
  host-tools render model.obj --filter bilinear --texture-size 64x64
  host-tools render model.obj --shading phong --light=-1,2,3,0.6 --lamp 1,0,1,0.5
  host-tools render model.obj --blend add --opacity 0.3
  host-tools render model.obj --fog linear:2:4       The background hides what is far away
  host-tools render model.obj --supersample 4        Smooth edges
  host-tools render model.obj --hidden-lines --edges 30  The edges that can be seen
  host-tools render model.obj --painter             Without a depth buffer
  host-tools render model.obj --clip 0,0,-1,0 --clip 1,0,0,0.5  What two planes leave
  host-tools render model.obj --wireframe-over --line-color ffffff --line-width 2
  host-tools render model.obj --frames 60           A turntable, as an animated PNG";

/// The widest line and the largest point, so that four samples of each pixel fit 8 bits.
const MOST_PIXELS: i64 = 63;

/// Draw a model with the fixed-point core, as a display shows it
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The OBJ file; - for the standard input, whose libraries lie in this directory
    model: PathBuf,
    /// Where to write the picture, a .png; - for the standard output [default: the model's name
    /// with .png, in this directory]
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(png_file))]
    output: Option<PathBuf>,
    /// Overwrite a file that is not from this program
    #[arg(long)]
    force: bool,
    /// Samples of a pixel along each side, whose mean it shows; 2 and 4 are slower and smoother
    #[arg(
        long,
        value_name = "N",
        default_value = "1",
        value_parser = choice(&[("1", 1u32), ("2", 2), ("4", 4)])
    )]
    supersample: u32,
    /// Draw the edges of the model's faces in place of its surfaces
    #[arg(long, group = "lines")]
    wireframe: bool,
    /// The same without the lines that the model hides
    #[arg(long, group = "lines")]
    hidden_lines: bool,
    /// Draw these edges over the shaded surfaces
    #[arg(long, group = "lines")]
    wireframe_over: bool,
    /// The colour of edges in hexadecimal [default: light; over surfaces dark]
    #[arg(long, value_name = "RRGGBB", requires = "lines", value_parser = color)]
    line_color: Option<Color>,
    /// The width of edges, and of the file's lines (`l`), in pixels
    #[arg(
        long,
        value_name = "PIXELS",
        default_value_t = 1,
        value_parser = clap::value_parser!(u8).range(1..=MOST_PIXELS)
    )]
    line_width: u8,
    /// The size of the file's points (`p`) in pixels
    #[arg(
        long,
        value_name = "PIXELS",
        default_value_t = 3,
        value_parser = clap::value_parser!(u8).range(1..=MOST_PIXELS)
    )]
    point_size: u8,
    /// Only edges in which faces meet at this angle or more, and borders
    #[arg(
        long,
        value_name = "DEGREES",
        requires = "lines",
        value_parser = within(0.0, 180.0),
        allow_negative_numbers = true
    )]
    edges: Option<f64>,
    /// The background's colour in hexadecimal [default: a dark grey-blue]
    #[arg(long, value_name = "RRGGBB", value_parser = color)]
    background: Option<Color>,
    /// The same as --colors rgb565
    #[arg(long, conflicts_with = "colors")]
    rgb565: bool,
    #[command(flatten)]
    view: ViewOptions,
}

impl Arguments {
    const fn drawn_edges(&self) -> Edges {
        if self.wireframe {
            Edges::All
        } else if self.hidden_lines {
            Edges::Visible
        } else if self.wireframe_over {
            Edges::Over
        } else {
            Edges::None
        }
    }
}

/// Refuses the ending of another format.
fn png_file(path: PathBuf) -> Result<PathBuf, &'static str> {
    let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
    if is_png || output::is_standard(&path) {
        Ok(path)
    } else {
        Err("pictures are PNG files: give the name the ending .png")
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Color([u8; 3]);

fn color(text: &str) -> Result<Color, String> {
    let digits = text.strip_prefix('#').unwrap_or(text);
    let is_color = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_color);
    let [_, r, g, b] = number.ok_or("write six hexadecimal digits, as in 283240")?.to_be_bytes();
    Ok(Color([r, g, b]))
}

pub(super) fn run(arguments: &Arguments) -> Result<Done> {
    let path =
        (arguments.output.clone()).unwrap_or_else(|| output::named_after(&arguments.model, ".png"));
    let is_standard = output::is_standard(&path);
    let edges = arguments.drawn_edges();
    let edges_degrees = (edges != Edges::None).then_some(arguments.edges.unwrap_or(0.0));
    let conversion = Options { edges_degrees, ..arguments.view.conversion() };
    let model = convert::load(&arguments.model, &conversion)?;
    if !is_standard {
        let inputs = output::inputs(&model);
        let overwriting = Overwriting { force: arguments.force, inputs: &inputs };
        output::allow(&path, output::PNG, overwriting)?;
    }
    arguments.view.check()?;
    let background = arguments.background.map_or(BACKGROUND, |Color(color)| color);
    let view = arguments.view.view(Shading::of(&model));
    // Fog hides what it covers.
    let fog = view.fog.map(|fog| Fog { color: background, ..fog });
    let view = View { background, fog, ..view };
    let frames = arguments.view.frames;
    let rgb565 = Display { colors: Colors::Rgb565, dither: Matrix::None };
    let display = view.display.or(arguments.rgb565.then_some(rgb565));

    let side = arguments.supersample;
    let samples = view.size.map(|pixels| pixels * side);
    ensure!(
        samples.iter().all(|&samples| samples <= MAX_SIZE),
        "with --supersample {side} a side of --size is at most {}",
        MAX_SIZE / side
    );

    let lines = LineOptions {
        edges,
        edge_color: arguments.line_color.map_or_else(
            || if edges == Edges::Over { Edges::DARK } else { Edges::LIGHT },
            |Color(color)| color,
        ),
        line_width: arguments.line_width * side as u8,
        point_size: arguments.point_size * side as u8,
    };
    let mut is_empty = true;
    let bytes = {
        let progress = Progress::over(frames, "drawing");
        let images = (0..frames).map(|frame| {
            let view = View { size: samples, ..view.turned(frame, frames) };
            let picture = check::render_with_lines(&model, &view, lines)
                .map_err(|error| refused(&arguments.model, &error))?;
            is_empty &= picture.pixels.iter().all(|pixel| pixel.depth == 0);
            let image = image::of_fixed(&picture, background).resolved(side);
            progress.step();
            Ok(display.map_or_else(|| image.clone(), |display| image.shown_by(display)))
        });
        png::animation(view.size, u16::try_from(frames)?, images)?
    };
    if is_empty {
        output::complain("warning", &nothing_seen(&arguments.model));
    }
    if is_standard {
        return Ok(bytes.into());
    }
    output::write(&path, &bytes)?;
    let [width, height] = view.size;
    let frames = if frames > 1 { format!(", {frames} frames") } else { String::new() };
    Ok(format!("Wrote {}: {width}x{height} pixels{frames}\n", path.display()).into())
}

/// Draws one frame by the fixed-point core.
pub(super) fn draw(path: &Path, model: &Model, view: &View) -> Result<FixedPicture> {
    check::render(model, view).map_err(|error| refused(path, &error))
}

/// The error for a view that cannot be drawn, with the model's path.
pub(super) fn refused(path: &Path, error: &ViewError) -> anyhow::Error {
    anyhow!("{} cannot be drawn in this view: {error}", path.display())
}

/// The message for a picture without a pixel of the model.
pub(super) fn nothing_seen(path: &Path) -> String {
    format!(
        "no pixel shows anything of {}: change --distance, --near, --far, --fov, --orthographic, \
         --clip or --size",
        path.display()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_six_digits() {
        assert_eq!(color("102fFF"), Ok(Color([16, 47, 255])));
        assert_eq!(color("#000001"), Ok(Color([0, 0, 1])));
        for text in ["", "12345", "1234567", "+12345", "#", "blue", "ééé", "0x1234"] {
            assert!(color(text).is_err(), "{text}");
        }
    }
}
