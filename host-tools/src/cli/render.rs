//! The command `render`: the picture that a display shows.

use std::path::{Path, PathBuf};

use anyhow::{Result, anyhow, ensure};
use clap::{
    Args,
    builder::{PathBufValueParser, TypedValueParser as _},
};
use host_tools::{
    check::{
        self, BACKGROUND, Colors, Display, Edges, FixedPicture, Fog, Form, LineOptions, Matrix,
        Place, SceneModel, Shading, View, ViewError, render_scene,
    },
    model::{Model, Options},
};

use super::{
    Done,
    animation::{Format, MOST_FRAMES_A_SECOND, Timing, picture_file},
    background::{self, Background, Rgb, background, color},
    convert,
    image::Image,
    output::{self, Overwriting},
    placed::{self, Placed},
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
  host-tools render model.obj --stretch 1,0.5,-1    Half as high, and mirrored
  host-tools render up.obj down.obj --between 0.5   Halfway from one shape to another
  host-tools render up.obj down.obj --between 0..1 -o flap.gif  There and back, turning
  host-tools render model.obj --wireframe-over --line-color ffffff --line-width 2
  host-tools render model.obj --frames 60           A turntable, as an animated PNG
  host-tools render model.obj -o model.gif --fps 15  The same as an animated GIF
  host-tools render model.obj --eye 2,1.5,2 --target 0,0.2,0 --ambient 0.1
  host-tools render model.obj --background 102030..8090a0  A gradient; or sky.png
  host-tools render model.obj --simplify 500        What `convert --simplify 500` leaves

Several models in one picture, each with its place: FILE@X,Y,Z[,SCALE[,YAW[,PITCH,ROLL]]]
  host-tools render table.obj cup.obj@0.3,1.2,0,0.25 --eye 2,2,3
  host-tools render ship.obj@-1,0,0 ship.obj@1,0,0,1,180 --distance 5
Each model is fitted into a sphere of radius 1 (or --keep-units), then scaled, turned about y, x and
z in degrees, and moved; the world of all of them is turned by --yaw, --pitch, --roll and --frames.
The nearest is seen; with --blend each lies on those before it.";

/// The widest line and the largest point, so that four samples of each pixel fit 8 bits.
const MOST_PIXELS: i64 = 63;

/// Draw a model with the fixed-point core, as a display shows it
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The OBJ files, each with its place as in model.obj@1,0,0; - for the standard input, whose
    /// libraries lie in this directory
    #[arg(required = true, value_name = "MODEL[@PLACE]", value_parser = placed::parser())]
    models: Vec<Placed>,
    /// Where to write the picture, a .png, or an animation, a .png or .gif; - for a PNG file to the
    /// standard output [default: the first model's name with .png, in this directory]
    #[arg(
        short,
        long,
        value_name = "FILE",
        value_parser = PathBufValueParser::new().try_map(picture_file)
    )]
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
    line_color: Option<Rgb>,
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
    /// What lies behind: a colour in hexadecimal; two for a gradient from top to bottom, as in
    /// 102030..8090a0; or a PNG or JPEG file, which fills the picture. Fog takes its mean colour
    /// [default: a dark grey-blue]
    #[arg(long, value_name = "COLOR|FILE", value_parser = background)]
    background: Option<Background>,
    /// Frames of an animation a second [default: as many as make a turn take 3 s, 50 at most]; GIF
    /// files count hundredths of a second
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..=i64::from(MOST_FRAMES_A_SECOND))
    )]
    fps: Option<u16>,
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

    /// How lines and points are drawn, with `side` samples along the side of a pixel.
    fn lines(&self, side: u8) -> LineOptions {
        let edges = self.drawn_edges();
        let usual = if edges == Edges::Over { Edges::DARK } else { Edges::LIGHT };
        LineOptions {
            edges,
            edge_color: self.line_color.unwrap_or(usual),
            line_width: self.line_width * side,
            point_size: self.point_size * side,
        }
    }

    /// Loads the models; between shapes, both files are one.
    fn load(&self, view: &View) -> Result<Vec<Model>> {
        let standard = self.models.iter().filter(|placed| output::is_standard(&placed.path));
        ensure!(standard.count() <= 1, "the standard input is one model: give - only once");
        let edges_degrees =
            (self.drawn_edges() != Edges::None).then_some(self.edges.unwrap_or(0.0));
        let conversion = Options { edges_degrees, ..self.view.conversion() };
        if let (Form::Between { .. }, [first, second]) = (view.form, &self.models[..]) {
            ensure!(
                second.place == Place::default(),
                "{}: with --between the place stands behind the first file",
                second.path.display()
            );
            let further = std::slice::from_ref(&second.path);
            return Ok(vec![convert::load_shapes(&first.path, further, &conversion)?]);
        }
        self.models.iter().map(|placed| convert::load(&placed.path, &conversion)).collect()
    }
}

pub(super) fn run(arguments: &Arguments) -> Result<Done> {
    let first = &arguments.models[0].path;
    let path = (arguments.output.clone()).unwrap_or_else(|| output::named_after(first, ".png"));
    let is_standard = output::is_standard(&path);
    let format = Format::of(&path).unwrap_or(Format::Png);
    let frames = arguments.view.frames.unwrap_or(format.frames());
    let timing = Timing::new(frames, arguments.fps)?;
    arguments.view.check(arguments.models.len(), frames)?;
    let view = arguments.view.view(Shading::default());
    let models = arguments.load(&view)?;
    if !is_standard {
        let mut inputs: Vec<_> = models.iter().flat_map(output::inputs).collect();
        inputs
            .extend(arguments.background.iter().filter_map(Background::input).map(Path::to_owned));
        let overwriting = Overwriting { force: arguments.force, inputs: &inputs };
        output::allow(&path, format.kind(), overwriting)?;
    }
    let scene: Vec<SceneModel<'_>> = (models.iter().zip(&arguments.models))
        .map(|(model, placed)| SceneModel {
            model,
            place: placed.place,
            shading: arguments.view.view(Shading::of(model)).shading,
        })
        .collect();
    let side = arguments.supersample;
    let samples = view.size.map(|pixels| pixels * side);
    ensure!(
        samples.iter().all(|&samples| samples <= MAX_SIZE),
        "with --supersample {side} a side of --size is at most {}",
        MAX_SIZE / side
    );
    let plain = Background::Colors([BACKGROUND; 2]);
    let under = arguments.background.as_ref().unwrap_or(&plain).drawn(samples)?;
    let background = background::mean(&under);
    // Fog hides what it covers.
    let fog = view.fog.map(|fog| Fog { color: background, ..fog });
    let view = View { background, fog, ..view };
    let rgb565 = Display { colors: Colors::Rgb565, dither: Matrix::None };
    let display = view.display.or(arguments.rgb565.then_some(rgb565));
    let lines = arguments.lines(side as u8);

    let mut seen = vec![0; models.len()];
    let bytes = {
        let progress = Progress::over(format.drawn_frames(frames), "drawing");
        format.encode(view.size, timing, |frame| {
            let view = View { size: samples, ..view.turned(frame, frames) };
            let picture = render_scene(&scene, &view, lines, &under)
                .map_err(|(number, error)| refused(&arguments.models[number].path, &error))?;
            seen.iter_mut().zip(picture.seen).for_each(|(sum, count)| *sum += count);
            let image = Image { size: picture.size, rgb: picture.colors }.resolved(side);
            progress.step();
            Ok(display.map_or_else(|| image.clone(), |display| image.shown_by(display)))
        })?
    };
    for (placed, _) in arguments.models.iter().zip(seen).filter(|&(_, seen)| seen == 0) {
        output::complain("warning", &nothing_seen(&placed.path));
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
        "no pixel shows anything of {}: change --distance or --eye, --near, --far, --fov, \
         --orthographic, --clip or --size",
        path.display()
    )
}
