//! The edges, lines and points of a model, by the same calls as on a microcontroller: drawn, and
//! judged.

use std::convert::Infallible;

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::{
    camera::Camera,
    fixed::types::{I0F32, I8F8},
    geometry::{self, ScreenVertex},
    mesh::{Lines, Mesh, PointIndices, Points, Segments},
    numbers,
    output::{Frame, Replace},
    raster::Bias,
    scene::{Mode, Object, Projected, Vertices},
    shade::{Colored, OnScreen, Shader, Unlit},
};

use super::{
    Blending, FixedPicture, LineOutcome, Pixel,
    display::rgb888,
    form::{Formed, UseObject, in_form},
    judged_lines::{Canvas, End, Owners},
    line_ends::LineEnds,
    shading,
    view::{View, ViewError},
};
use crate::model::Model;

/// Moves surfaces behind the lines that lie in them: a line's pixels are up to half a pixel away
/// from it, and depth is rounded.
const BEHIND: Bias = Bias { slope: I8F8::lit("-1"), constant: I0F32::from_bits(-1 << 10) };

/// How a model is drawn: which of its surfaces and [edges](Model::edges), and how large its lines
/// and points are. Lines and points of the file are always drawn, in the colours of their materials
/// or vertices, not lit and without fog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineOptions {
    /// Which edges are drawn.
    pub edges: Edges,
    /// The colour of edges.
    pub edge_color: [u8; 3],
    /// The width of edges and lines in pixels.
    pub line_width: u8,
    /// The size of points in pixels.
    pub point_size: u8,
}

impl Default for LineOptions {
    /// The surfaces with the lines and points of the file.
    fn default() -> Self {
        Self { edges: Edges::None, edge_color: Edges::LIGHT, line_width: 1, point_size: 3 }
    }
}

impl LineOptions {
    /// Whether there is more to draw than surfaces.
    pub(super) const fn has_lines(&self, model: &Model) -> bool {
        !matches!(self.edges, Edges::None) || model.report.lines + model.report.points > 0
    }

    /// Whether surfaces hide lines in a view.
    fn hides(&self, view: &View) -> bool {
        match self.edges {
            Edges::All => false,
            Edges::Visible => true,
            Edges::None | Edges::Over => view.blending == Blending::Replace,
        }
    }
}

/// Which edges of a model are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edges {
    /// None: surfaces alone.
    None,
    /// All, without surfaces, which hide nothing.
    All,
    /// Those that surfaces do not hide, without these.
    Visible,
    /// The same over the surfaces.
    Over,
}

impl Edges {
    /// A colour for edges on the background.
    pub const LIGHT: [u8; 3] = [230, 236, 232];
    /// A colour for edges on surfaces.
    pub const DARK: [u8; 3] = [16, 22, 28];

    /// Whether surfaces are shaded.
    const fn has_surfaces(self) -> bool {
        matches!(self, Self::None | Self::Over)
    }
}

/// Draws the [edges](Model::edges) of a model, all of them or those that it does not hide, and the
/// lines and points of its file, in the view's precision and with 32 bits of depth. The view's
/// shading is not used.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn wireframe(model: &Model, view: &View, hides_lines: bool) -> Result<FixedPicture, ViewError> {
    let edges = if hides_lines { Edges::Visible } else { Edges::All };
    render_with_lines(model, view, LineOptions { edges, ..LineOptions::default() })
}

/// Draws a model by the fixed-point core alone, with its edges: surfaces as
/// [`render`](super::render) draws them.
///
/// Lines are tested against a depth of 32 bits in which surfaces lie behind their edges. In a view
/// that blends, surfaces hide none.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn render_with_lines(
    model: &Model,
    view: &View,
    options: LineOptions,
) -> Result<FixedPicture, ViewError> {
    draw_over(model, view, options, None)
}

/// [`render_with_lines`] over the picture `under`, in place of the background: it is what surfaces
/// blend with, and what is seen where surfaces only hide lines.
pub(super) fn draw_over(
    model: &Model,
    view: &View,
    options: LineOptions,
    under: Option<&[[u8; 3]]>,
) -> Result<FixedPicture, ViewError> {
    let surfaces = if options.edges.has_surfaces() && model.report.triangles > 0 {
        super::surfaces(model, view, under)?
    } else {
        let black = Pixel { color: [0; 3], depth: 0 };
        FixedPicture { size: view.size, pixels: vec![black; view.pixel_count()] }
    };
    if !options.has_lines(model) {
        return Ok(surfaces);
    }
    let over = Over { model, view, options, under, surfaces };
    if model.vertex_colors.is_empty() {
        in_form(model, view, Unlit::new(), over)
    } else {
        in_form(model, view, Colored::new(), over)
    }
}

/// An object in a view, with its surfaces behind its lines.
fn behind_lines<'a, Sh: Shader>(
    object: Formed<'a, Sh>,
    view: &View,
) -> Result<Object<'a, Sh, impl Mode<Blending = Replace> + use<'a, Sh>>, ViewError> {
    Ok(object.clipped(view.planes.core()?).biased(BEHIND))
}

/// Lines and points over a picture.
struct Over<'a> {
    model: &'a Model,
    view: &'a View,
    options: LineOptions,
    under: Option<&'a [[u8; 3]]>,
    surfaces: FixedPicture,
}

impl<Sh: Shader<Color = Rgb888, Outcome = Rgb888, Face = ()>> UseObject<Sh> for Over<'_> {
    type Done = FixedPicture;

    fn use_object<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Sh>,
        camera: &Camera<P>,
    ) -> Result<FixedPicture, ViewError> {
        let Self { model, view, options, under, surfaces } = self;
        let object = behind_lines(object, view)?;
        let mesh = *object.mesh();
        let mut storage = vec![ScreenVertex::<S, u32, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
        let seen = object.project(camera, &mut storage)?;

        let shown = |(place, pixel): (usize, &Pixel)| {
            let behind = || under.map_or(view.background, |under| under[place]);
            if pixel.depth == 0 { behind() } else { pixel.color }
        };
        let mut colors: Vec<Rgb888> =
            (surfaces.pixels.iter().enumerate().map(shown)).map(rgb888).collect();
        let mut depth = vec![0u32; colors.len()];
        if options.hides(view) {
            let mut frame = Frame::new(&mut colors, &mut depth, view.area())?;
            let Ok(()) = seen.draw_depth(&mut frame);
        }
        let before = depth.clone();
        let mut frame = Frame::new(&mut colors, &mut depth, view.area())?;
        let Ok(()) = for_each_element(model, &mesh, options.edges, &mut |element| {
            element.draw(options, &seen, &mut frame)
        });
        let drawn = FixedPicture::new(view.size, &colors, &depth);
        let pixels = (drawn.pixels.iter().zip(&surfaces.pixels).zip(before))
            .map(|((line, surface), before)| {
                let is_surface = line.depth == before && options.edges.has_surfaces();
                if is_surface { *surface } else { *line }
            })
            .collect();
        Ok(FixedPicture { pixels, ..drawn })
    }
}

/// A table of lines or points, and in which material it is drawn.
enum Element<'a> {
    Points(usize, Points<'a>),
    Lines(usize, Lines<'a>),
    /// In the colour of edges.
    Edges(Lines<'a>),
}

/// Visits what is drawn, in its order: what is drawn first wins where depths are equal, points over
/// lines over edges.
fn for_each_element<E>(
    model: &Model,
    mesh: &Mesh<'_>,
    edges: Edges,
    visit: &mut dyn FnMut(&Element<'_>) -> Result<(), E>,
) -> Result<(), E> {
    let table = |pairs: &[[u32; 2]]| -> Vec<[u16; 2]> {
        pairs.iter().map(|pair| pair.map(|i| i as u16)).collect()
    };
    for (material, points) in model.points.iter().enumerate() {
        let indices: Vec<u16> = points.iter().map(|&i| i as u16).collect();
        visit(&Element::Points(material, Points::new_const(mesh, PointIndices::U16(&indices))))?;
    }
    for (material, lines) in model.lines.iter().enumerate() {
        let segments = table(lines);
        visit(&Element::Lines(material, Lines::new_const(mesh, Segments::U16(&segments))))?;
    }
    if edges != Edges::None {
        let segments = table(&model.edges);
        visit(&Element::Edges(Lines::new_const(mesh, Segments::U16(&segments))))?;
    }
    Ok(())
}

impl Element<'_> {
    fn draw<V, P, Sh, M>(
        &self,
        options: LineOptions,
        seen: &Projected<'_, V, P, Sh, M>,
        frame: &mut Frame<'_, Rgb888, &mut [u32]>,
    ) -> Result<(), Infallible>
    where
        V: Vertices<OnScreen<Sh>, Depth = u32>,
        P: geometry::Projection,
        Sh: Shader<Color = Rgb888, Outcome = Rgb888, Face = ()>,
        M: Mode<Blending = Replace>,
    {
        let LineOptions { edge_color, line_width, point_size, .. } = options;
        match self {
            Self::Points(material, points) => {
                seen.points(points).sized(point_size).of_material(*material).draw(frame)
            }
            Self::Lines(material, lines) => {
                seen.lines(lines).wide(line_width).of_material(*material).draw(frame)
            }
            Self::Edges(lines) => {
                seen.lines(lines).wide(line_width).fill(rgb888(edge_color), frame)
            }
        }
    }

    /// Adds what the core draws to the definitions, and judges its ends against the exact ones.
    /// `color` returns the colour of a vertex, if vertices have colours.
    fn define<V, P, Sh, M>(
        &self,
        model: &Model,
        mesh: &Mesh<'_>,
        seen: &Projected<'_, V, P, Sh, M>,
        color: impl Fn(OnScreen<Sh>) -> Option<[f64; 3]>,
        exact: &LineEnds,
        owners: &mut Owners,
    ) -> LineOutcome
    where
        V: Vertices<OnScreen<Sh>, Depth = u32>,
        P: geometry::Projection,
        Sh: Shader<Color = Rgb888>,
        M: Mode,
    {
        let has_colors = !matches!(self, Self::Edges(_)) && !model.vertex_colors.is_empty();
        let plain = match self {
            Self::Edges(_) => owners.options().edge_color,
            Self::Points(material, _) | Self::Lines(material, _) => {
                model.materials.get(*material).map_or([0; 3], |m| m.color)
            }
        }
        .map(f64::from);
        let end = |vertex: &ScreenVertex<_, _, _>| {
            let own = if has_colors { color(vertex.varyings()) } else { None };
            End::of(vertex, own.unwrap_or(plain))
        };
        let mut found = LineOutcome::default();
        // Each by itself, which tells whether it is left out.
        match self {
            Self::Points(_, points) => {
                let indices = points.indices();
                for vertex in (0..indices.len()).map_while(|index| indices.get(index)) {
                    let mut drawn = None;
                    let index = [vertex as u16];
                    let alone = Points::new_const(mesh, PointIndices::U16(&index));
                    let Ok(()) = seen.points(&alone).for_each_point(|vertex| {
                        drawn = end(vertex);
                        Ok::<(), Infallible>(())
                    });
                    found = found.and(exact.judge([vertex; 2], drawn.as_slice(), has_colors));
                    drawn.into_iter().for_each(|end| owners.add_point(end));
                }
            }
            Self::Lines(_, lines) | Self::Edges(lines) => {
                let segments = lines.segments();
                for vertices in (0..segments.len()).map_while(|index| segments.get(index)) {
                    let mut drawn = Vec::new();
                    let pair = [vertices.map(|vertex| vertex as u16)];
                    let alone = Lines::new_const(mesh, Segments::U16(&pair));
                    let Ok(()) = seen.lines(&alone).for_each_line(|ends| {
                        drawn.extend(ends.into_iter().filter_map(end));
                        Ok::<(), Infallible>(())
                    });
                    found = found.and(exact.judge(vertices, &drawn, has_colors));
                    if let [from, to] = drawn[..] {
                        owners.add_line([from, to]);
                    }
                }
            }
        }
        found
    }
}

/// Judges the [edges](Model::edges), lines and points of a model against their definitions: see
/// [`LineOutcome`]. In the view's precision and with 32 bits of depth; where surfaces hide them, by
/// the depth that the core draws. Their ends are judged against those that exact arithmetic gives
/// the tables, cut by the planes of the view.
///
/// # Errors
///
/// Returns an error if the view's numbers are out of range, or if the core cannot draw the model in
/// it.
pub fn judge_lines(
    model: &Model,
    view: &View,
    options: LineOptions,
) -> Result<LineOutcome, ViewError> {
    if model.vertex_colors.is_empty() {
        in_form(model, view, Unlit::new(), Judged { model, view, options, color: |_| None })
    } else {
        let color = |corner| Some(shading::channels(&corner));
        in_form(model, view, Colored::new(), Judged { model, view, options, color })
    }
}

/// Lines and points that are judged.
struct Judged<'a, F> {
    model: &'a Model,
    view: &'a View,
    options: LineOptions,
    /// The colour of a vertex, if vertices have colours.
    color: F,
}

impl<Sh, F> UseObject<Sh> for Judged<'_, F>
where
    Sh: Shader<Color = Rgb888, Outcome = Rgb888, Face = ()>,
    F: Fn(OnScreen<Sh>) -> Option<[f64; 3]>,
{
    type Done = LineOutcome;

    fn use_object<S: numbers::Subpixel, P: geometry::Projection>(
        self,
        object: Formed<'_, Sh>,
        camera: &Camera<P>,
    ) -> Result<LineOutcome, ViewError> {
        let Self { model, view, options, color } = self;
        let object = behind_lines(object, view)?;
        let mesh = *object.mesh();
        let mut storage = vec![ScreenVertex::<S, u32, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
        let seen = object.project(camera, &mut storage)?;
        let pixels = view.pixel_count();
        let mut canvas =
            Canvas { colors: vec![rgb888(view.background); pixels], depth: vec![0; pixels] };
        if options.hides(view) {
            canvas.draw(view, |frame| seen.draw_depth(frame))?;
        }
        let exact = LineEnds::new(model, &view.rounded());
        let mut found = LineOutcome::default();
        for_each_element(model, &mesh, options.edges, &mut |element| {
            let before = canvas.clone();
            canvas.draw(view, |frame| element.draw(options, &seen, frame))?;
            let mut owners = Owners::new::<S>(view, options);
            let ends = element.define(model, &mesh, &seen, &color, &exact, &mut owners);
            found = found.and(ends).and(owners.judge(&before, &canvas));
            Ok::<(), ViewError>(())
        })?;
        Ok(found)
    }
}
