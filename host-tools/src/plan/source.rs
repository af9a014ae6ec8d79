//! The planned renderer as a Rust source file.

use std::fmt::Write as _;

use rasterizer::numbers::Turn;

use super::{
    Correction, Decision, Paint, Request, Study, Types, Vertices, Views, Visibility,
    order::FixedOrder, partition::Partition,
};
use crate::{
    check::angle,
    model::{Model, emit},
};

/// The file: the tables of the model, the types, the memory, and a function that draws.
pub(super) fn source(study: &Study, model: &Model, types: &Types, rows: u32) -> String {
    let mut out = emit::source(model);
    let parts = study.order_of(types.visibility).and_then(FixedOrder::parts);
    if let Some(parts) = parts {
        out += &separated(parts, &model.name);
    }
    let _ = write!(out, "{}{}{}", head(study, model, types, rows), memory(model, types), ERROR);
    out + &draw(study, model, types)
}

/// The file with its decisions as comments behind the first line.
pub(super) fn with_decisions(source: &str, decisions: &[Decision], request: &Request) -> String {
    let ([width, height], core) = (request.display, request.core.title());
    let mut lines = format!(
        "//\n// The renderer below draws it on {width} x {height} pixels, planned for a {core} with {} \
         bytes of\n// RAM: {}.\n//\n",
        request.ram_bytes,
        request.views.basis()
    );
    for Decision { about, choice, .. } in decisions {
        let _ = writeln!(lines, "// {:<12} {choice}", format!("{about}:"));
    }
    let (first, rest) = source.split_once('\n').unwrap_or((source, ""));
    format!("{first}\n{lines}{rest}")
}

/// The parts of a mesh, and the planes between them.
fn separated(parts: &Partition, name: &str) -> String {
    let ends = parts.ends().iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let mut planes = String::new();
    for plane in &parts.planes {
        let _ = writeln!(
            planes,
            "        ::rasterizer::mesh::SeparatingPlane::new({:?}, {:?}),",
            plane.points, plane.parts
        );
    }
    format!(
        "
/// The parts of the mesh, which are drawn from back to front.
static PARTS: ::rasterizer::mesh::Parts<'static> = ::rasterizer::mesh::Parts::new_const(
    &{name},
    &[{ends}],
    &[
{planes}    ],
);
"
    )
}

/// The texture type of a model, or nothing.
fn texture_type(model: &Model) -> String {
    let Some(textures) = &model.textures else { return String::new() };
    let name = emit::texture_type(&model.name);
    if textures.by_material.iter().all(Option::is_some) { name } else { format!("Option<{name}>") }
}

/// Constants and types.
fn head(study: &Study, model: &Model, types: &Types, rows: u32) -> String {
    let request = &study.request;
    let ([width, height], (toward, [ambient, diffuse])) = (request.display, request.light);
    let [x, y, z] = toward;
    let [near, far] = study.depth_range;
    let [red, green, blue] = request.background;
    let (red, green, blue) = (red >> 3, green >> 2, blue >> 3);
    let is_wide = model.texture_coordinates.is_wide();
    let shading = types.shader(&texture_type(model), is_wide);
    let name = shading.split('<').next().unwrap_or_default();
    let precision = format!("S{}", request.core.subpixel().bits());
    let depth = types.visibility.depth();
    let is_stored = types.vertices == Vertices::Stored;
    // What is imported besides that all files need, and the shader.
    let is_own = !matches!(types.visibility, Visibility::U16 | Visibility::U32);
    let mut attributes: Vec<&str> = is_own.then_some(depth).into_iter().collect();
    let shader = if let Paint::Textures(correction, _, filter) = types.paint {
        let (attribute, corrected) = match correction {
            Correction::Affine => ("Affine", ".corrected(Affine)"),
            Correction::Adaptive => ("Adaptive", ""),
        };
        attributes.push(attribute);
        let filtered = match filter.types() {
            ["Nearest"] => String::new(),
            [filter, level] => format!(".filtered({filter}({level}))"),
            other => format!(".filtered({})", other.concat()),
        };
        let wide = if is_wide { ".with_wide_coordinates()" } else { "" };
        format!("{name}::new(&{}_TEXTURES, LIGHT){filtered}{corrected}{wide}", model.name)
    } else {
        "Shading::new(LIGHT)".into()
    };
    let attributes: String =
        attributes.iter().map(|name| format!("attribute::{name},\n    ")).collect();
    let bins = if has_bins(types) { ", bin_words" } else { "" };
    let filter = match types.paint {
        Paint::Textures(_, _, filter) => match filter.types() {
            [one] => format!("    texture::{one},\n"),
            several => format!("    texture::{{{}}},\n", several.join(", ")),
        },
        Paint::Materials | Paint::Vertices => String::new(),
    };
    let [screen_vertex, on_screen] =
        if is_stored { [", ScreenVertex", ", OnScreen"] } else { [""; 2] };
    let clip = clipping(types);
    let depth_type = if is_stored || types.visibility.depth_bytes() > 0 {
        format!("\n/// How depth is kept.\ntype Depth = {depth};\n")
    } else {
        String::new()
    };
    let vertex_type = if is_stored { VERTEX } else { "" };
    format!(
        "
use ::rasterizer::{{
    {attributes}camera::{{Camera, CameraError, Distance, Perspective}},
    embedded_graphics_core::{{
        draw_target::DrawTarget,
        geometry::{{Point, Size}},
        pixelcolor::{{Rgb565, RgbColor}},
        primitives::Rectangle,
    }},
    geometry::{{{clip}, Pose{screen_vertex}}},
    numbers::{{Rotation, Scalar, {precision} as Precision, Turn, Vec3}},
    output::{{Bands, FrameError}},
    scene::{{Object, ProjectError{bins}}},
    shade::{{{name}, Level, Light{on_screen}}},
{filter}}};

/// The display's pixels.
pub const SCREEN: Rectangle = Rectangle::new(Point::new(0, 0), Size::new({width}, {height}));

/// The rows that are drawn at a time.
const ROWS: u32 = {rows};

/// The pixels of these.
const PIXELS: usize = ({width} * ROWS) as usize;

/// What is behind the model.
const BACKGROUND: Rgb565 = Rgb565::new({red}, {green}, {blue});

/// What lights it.
const LIGHT: Light = Light::new(
    Vec3::lit(\"{x}\", \"{y}\", \"{z}\"),
    Level::lit(\"{ambient}\"),
    Level::lit(\"{diffuse}\"),
);

/// A vertical field of view of {fov} degrees. The depth range holds the model from all sides.
const LENS: Perspective = match Perspective::new(
    Turn::from_bits({turn:#x}),
    Distance::lit(\"{near}\"),
    Distance::lit(\"{far}\"),
) {{
    Ok(lens) => lens,
    Err(_) => panic!(\"the lens makes no sense\"),
}};

/// How it is coloured.
type Shading = {shading};
{depth_type}{vertex_type}
/// The shader.
const SHADER: Shading = {shader};
",
        fov = request.field_of_view_degrees,
        turn = angle(request.field_of_view_degrees).to_bits(),
    )
}

const VERTEX: &str = "
/// A vertex on the screen.
type Vertex = ScreenVertex<Precision, Depth, OnScreen<Shading>>;
";

/// How triangles are clipped, as Rust.
const fn clipping(types: &Types) -> &'static str {
    if types.clips { "ClipAll" } else { "ClipNone" }
}

/// Whether bands have lists of their triangles.
const fn has_bins(types: &Types) -> bool {
    types.in_bands && !matches!(types.visibility, Visibility::Sorted)
}

/// The memory.
fn memory(model: &Model, types: &Types) -> String {
    let (name, farthest) = (&model.name, types.visibility.farthest());
    let mut constants = String::new();
    // The name of each buffer, its type and its content.
    let mut fields = vec![("color", "[Rgb565; PIXELS]", "[Rgb565::BLACK; PIXELS]".to_owned())];
    if types.visibility.depth_bytes() > 0 {
        fields.push(("depth", "[Depth; PIXELS]", format!("[{farthest}; PIXELS]")));
    }
    if types.vertices == Vertices::Stored {
        constants += &format!("const VERTICES: usize = {name}.vertex_count();\n");
        fields.push(("vertices", "[Vertex; VERTICES]", "[Vertex::EMPTY; VERTICES]".into()));
    }
    if has_bins(types) {
        constants += &format!(
            "const BINS: usize = bin_words({name}.triangle_count(), SCREEN.size.height, ROWS);\n"
        );
        fields.push(("bins", "[u32; BINS]", "[0; BINS]".into()));
    }
    if types.visibility == Visibility::Sorted {
        constants += &format!("const TRIANGLES: usize = {name}.triangle_count();\n");
        fields.push(("order", "[u32; TRIANGLES]", "[0; TRIANGLES]".into()));
    }
    let declared: String =
        fields.iter().map(|(name, kind, _)| format!("    {name}: {kind},\n")).collect();
    let empty: String =
        fields.iter().map(|(name, _, value)| format!("        {name}: {value},\n")).collect();
    format!(
        "
{constants}
/// The memory of a picture, for a static. All its bits are 0 at first: it takes no flash.
#[derive(Debug)]
pub struct Memory {{
{declared}}}

impl Memory {{
    /// The initial memory.
    pub const EMPTY: Self = Self {{
{empty}    }};
}}
"
    )
}

const ERROR: &str = "
/// Why a picture is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error<E> {
    /// The display's error.
    Display(E),
    /// The camera's numbers are out of range.
    Camera(CameraError),
    /// The model is out of range.
    Project(ProjectError),
    /// A buffer is too small.
    Frame(FrameError),
}

impl<E> From<CameraError> for Error<E> {
    fn from(error: CameraError) -> Self {
        Self::Camera(error)
    }
}

impl<E> From<ProjectError> for Error<E> {
    fn from(error: ProjectError) -> Self {
        Self::Project(error)
    }
}

impl<E> From<FrameError> for Error<E> {
    fn from(error: FrameError) -> Self {
        Self::Frame(error)
    }
}
";

/// The function that draws, and the views that it knows.
fn draw(study: &Study, model: &Model, types: &Types) -> String {
    let (views, argument, rotation, distance) = views(study);
    let name = &model.name;
    let clip = clipping(types);
    let project = match types.vertices {
        Vertices::Stored => "project(&camera, &mut memory.vertices)?",
        Vertices::OnDemand => "project_on_demand(&camera, Precision)?",
    };
    let order = match types.visibility {
        Visibility::Sorted => "\n    let seen = seen.back_to_front(&mut memory.order)?;",
        _ if types.in_bands => "\n    let seen = seen.binned(ROWS, &mut memory.bins)?;",
        _ => "",
    };
    let parts = match types.visibility {
        Visibility::PartOrder => "\n    let seen = seen.in_parts(&PARTS);",
        _ => "",
    };
    let bands = if types.visibility.depth_bytes() > 0 {
        "Bands::new(SCREEN, &mut memory.color[..], &mut memory.depth[..])?"
    } else {
        "Bands::without_depth(SCREEN, &mut memory.color[..])?"
    };
    format!(
        "{views}
/// Draws the model and shows it.
///
/// # Errors
///
/// Returns the display's error. The others cannot occur in the views that this file is planned for.
pub fn draw<D: DrawTarget<Color = Rgb565>>(
    display: &mut D,
    memory: &mut Memory,
    {argument},
) -> Result<(), Error<D::Error>> {{{rotation}
    let eye = Vec3::new(Scalar::ZERO, Scalar::ZERO, {distance});
    let camera = Camera::at(eye, Rotation::IDENTITY, LENS, SCREEN)?;
    let object = Object::new(&{name}, SHADER).posed(Pose::rotated(rotation)).clipped({clip});
    let seen = object.{project};{order}{parts}
    {bands}
        .show(display, |band| band.clear_color(BACKGROUND), |band| seen.draw(band))
        .map_err(Error::Display)
}}
"
    )
}

/// The views, the argument of `draw` that chooses one, the statements that compute its rotation,
/// and its distance.
fn views(study: &Study) -> (String, &'static str, String, String) {
    let distance = format!("const {{ Scalar::lit(\"{}\") }}", study.request.distance);
    match &study.request.views {
        Views::Turntable { steps, pitch_degrees } => {
            let tilt = angle(*pitch_degrees).to_bits();
            (
                format!(
                    "
/// The steps of a whole turn: it was planned for each of them.
pub const STEPS: u32 = {steps};
"
                ),
                "step: u32",
                format!(
                    "
    let angle = Turn::from_bits(step.wrapping_shl({}));
    let rotation = Rotation::about_x(Turn::from_bits({tilt:#x})) * Rotation::about_y(angle);",
                    32 - steps.ilog2()
                ),
                distance,
            )
        }
        Views::Orbit { .. } => (String::new(), "rotation: Rotation", String::new(), distance),
        Views::List(views) => {
            let mut text = format!(
                "
/// The views that it was planned for: turns about y, x and z, and the camera's distance.
const VIEWS: [([u32; 3], Scalar); {}] = [
",
                views.len()
            );
            for view in views {
                let [y, x, z] = view.turns().map(Turn::to_bits);
                let distance = view.distance.unwrap_or(study.request.distance);
                let _ =
                    writeln!(text, "    ([{y:#x}, {x:#x}, {z:#x}], Scalar::lit(\"{distance}\")),");
            }
            text += "];\n\n/// How many they are.\npub const VIEW_COUNT: usize = VIEWS.len();\n";
            (
                text,
                "view: usize",
                "
    let (turns, distance) = VIEWS[view.min(VIEW_COUNT - 1)];
    let [y, x, z] = turns.map(Turn::from_bits);
    let rotation = Rotation::about_z(z) * Rotation::about_x(x) * Rotation::about_y(y);"
                    .into(),
                "distance".into(),
            )
        }
    }
}
