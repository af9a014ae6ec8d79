//! Shaders with highlights against their definitions.

use embedded_graphics_core::pixelcolor::Rgb888;
use rasterizer::shade::{
    self, GlossyGouraud, Lighting, OnScreen, Phong, PhongCorrection, ViewedFrom,
};

use super::{
    Form,
    fixed::{self, Drawn, Placed},
    lights::total,
    normals::{NormalErrors, seen_or},
    noted::Noted,
    probe::Probe,
    surface::Surface,
    view::{View, ViewError},
};
use crate::{
    model::Model,
    reference::{self, Corner, Finish, Lights, Sample, Viewer},
};

/// Levels of diffuse light: as many as a channel of the pictures that are compared has.
pub(super) const LEVELS: usize = 256;

/// The shader by pixel that is judged.
pub(super) type Judged<L, V> = Phong<Rgb888, L, V, PhongCorrection, LEVELS>;

/// What the definitions of a view share.
pub(super) struct Definition<'a> {
    model: &'a Model,
    surface: &'a Surface,
    lights: Lights,
    viewer: Viewer,
    /// The direction to the viewer from the middle of the mesh's box.
    far: [f64; 3],
    is_near: bool,
    /// Of each triangle of the tables.
    finishes: Vec<Finish>,
    /// Of each triangle of the file.
    file_finishes: Vec<Finish>,
}

impl<'a> Definition<'a> {
    /// For a far viewer, or one that each point sees in its own direction.
    pub(super) fn new(
        (model, surface): (&'a Model, &'a Surface),
        view: &View,
        is_near: bool,
    ) -> Self {
        let by_material = finishes(model);
        let of_triangle = |(finish, material): (&Finish, &rasterizer::mesh::Material)| {
            std::iter::repeat_n(*finish, material.triangle_count as usize)
        };
        let faces = &model.exact.faces.faces;
        let viewer = view.reference_viewer();
        let middle = view.core_pose_points(&[view.form.middle(model)])[0];
        Self {
            model,
            surface,
            lights: view.lights.reference(),
            viewer,
            far: viewer.direction(middle),
            is_near,
            finishes: by_material.iter().zip(&model.materials).flat_map(of_triangle).collect(),
            file_finishes: (surface.faces.iter())
                .map(|&face| by_material[faces[face].material])
                .collect(),
        }
    }

    /// The diffuse and the specular level of a place with a unit normal.
    fn levels(&self, position: [f64; 3], normal: [f64; 3], exponent: f64) -> [f64; 2] {
        let viewer = if self.is_near { self.viewer.direction(position) } else { self.far };
        let specular = self.lights.specular(position, normal, viewer, exponent);
        [self.lights.diffuse(position, normal), specular]
    }
}

/// The unit normal in world space of each corner of the file.
pub(super) fn file_normals(model: &Model, surface: &Surface, view: &View) -> Vec<[f64; 3]> {
    let of_vertices = view.pose_directions(&model.exact.vertex_normals);
    let of_planes: Vec<_> =
        surface.planes.iter().map(|plane| plane.normal().unwrap_or_default()).collect();
    let of_planes = view.pose_directions(&of_planes);
    let faces = model.exact.faces.faces.iter().zip(of_planes);
    let corner = |vertices: &Vec<usize>, of_plane| {
        let known = vertices.iter().find_map(|&vertex| of_vertices.get(vertex).copied());
        known.unwrap_or(of_plane)
    };
    faces
        .flat_map(|(face, of_plane)| {
            surface.vertices[face.corners.clone()].iter().map(move |v| corner(v, of_plane))
        })
        .collect()
}

/// The finishes of the materials, with their colours.
fn finishes(model: &Model) -> Vec<Finish> {
    let mesh = model.mesh();
    let finish = |index: usize| mesh.tables().finishes.get(index).copied().unwrap_or_default();
    let all = model.materials.iter().enumerate();
    all.map(|(index, material)| {
        let finish = finish(index);
        Finish {
            diffuse: material.color.map(f64::from),
            specular: finish.specular.map(f64::from),
            exponent: f64::from(finish.exponent),
            emission: finish.emission.map(f64::from),
        }
    })
    .collect()
}

/// The exponent that a mesh is lit by at its vertices: that of its first material with highlights.
fn exponent_of_vertices(finishes: &[Finish]) -> f64 {
    let shiny = finishes.iter().find(|finish| finish.specular != [0.0; 3]);
    shiny.map_or(1.0, |finish| finish.exponent)
}

/// The colours that each material may have: up to its own, its highlights and its light together.
pub(super) fn brightest(model: &Model) -> Vec<[f64; 3]> {
    finishes(model).iter().map(|finish| finish.color(1.0, 1.0)).collect()
}

/// Draws with highlights at the vertices.
pub(super) fn draw_at_vertices<'a, L: Lighting>(
    definition: Definition<'a>,
    view: &View,
    lights: L,
) -> Result<Drawn<'a>, ViewError> {
    let shader = GlossyGouraud::<Rgb888, L>::new(lights).with_levels::<LEVELS>();
    let rounded = view.rounded();
    let normals = file_normals(definition.model, definition.surface, &rounded);
    let exponent = exponent_of_vertices(&finishes(definition.model));
    let Definition { model, surface, .. } = definition;
    let (finishes, file_finishes) = (definition.finishes.clone(), definition.file_finishes.clone());
    fixed::draw(
        (model, surface),
        view,
        &shader,
        |_, levels| levels.map(|level| f64::from(level) / 65_536.0),
        move |Sample { triangle, varyings: [diffuse, specular], .. }: Sample<2>| {
            Some(finishes[triangle].color(diffuse, specular))
        },
        move |corner: Corner| definition.levels(corner.position, normals[corner.vertex], exponent),
        move |Sample { triangle, varyings: [diffuse, specular], .. }: Sample<2>| {
            Some(file_finishes[triangle].color(diffuse, specular))
        },
    )
}

/// Returns the normal of a pixel from what the shader sees there.
type Read<L, V> = fn(&shade::Sample<Judged<L, V>>) -> Option<[i32; 3]>;

/// Draws with light at each pixel. `read` takes the normal from what a pixel sees; `placed` returns
/// the normal of a corner and its position of 14 bits.
pub(super) fn draw_at_pixels<'a, L: Lighting, V: ViewedFrom>(
    definition: Definition<'a>,
    view: &View,
    shader: &Judged<L, V>,
    read: Read<L, V>,
    placed: impl Fn(&OnScreen<Judged<L, V>>) -> ([[f64; 3]; 2], f64),
) -> Result<Drawn<'a>, ViewError> {
    let shader = Probe { shader: *shader, read };
    let Definition { model, surface, .. } = definition;
    let Placed { picture, triangles, vertices, time, colors, blended, fog } =
        fixed::place::<7, _>(model, view, &shader, |_, corner| {
            let ([[x, y, z], [u, v, w]], q) = placed(&corner);
            [x * q, y * q, z * q, u * q, v * q, w * q, q]
        })?;
    let seen: Vec<Option<[f64; 3]>> =
        colors.iter().map(|color| color.seen().map(|n| n.map(f64::from))).collect();
    let size: (usize, usize) = view.size.map(|c| c as usize).into();
    let depth = view.depth.definition();
    let rounded = view.rounded();
    let normals = file_normals(definition.model, definition.surface, &rounded);
    let file_finishes = definition.file_finishes.clone();
    let file = Definition::new((model, surface), &rounded, definition.is_near);
    let core_view = *view;
    let positions = position_units(model, view)?;
    let arithmetic = move |fixed: &super::FixedPicture| {
        let parts = |sample: &Sample<7>| {
            let [x, y, z, u, v, w, q] = sample.varyings;
            [[x / q, y / q, z / q], [u / q, v / q, w / q]]
        };
        let exact =
            reference::draw_screen(&triangles, size, |sample: Sample<7>| Some(parts(&sample)[0]));
        let errors = NormalErrors::of(&seen, fixed, depth, &exact);
        let (unit, offset) = positions;
        // Of each fragment its colour, and by how much each channel of that may be off.
        let right = reference::draw_screen(&triangles, size, |sample: Sample<7>| {
            let [exact, position] = parts(&sample);
            let normal = seen_or(seen[sample.pixel[1] * size.0 + sample.pixel[0]], exact);
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            let position = [0, 1, 2].map(|i| offset[i] + position[i] * unit);
            let normal = core_view.core_pose_directions(&[normal.map(|c| c / length)])[0];
            let position = core_view.core_pose_points(&[position])[0];
            let finish = &definition.finishes[sample.triangle];
            let [diffuse, specular] = definition.levels(position, normal, finish.exponent);
            // What the 15 bits of a cosine, and lines between powers, leave of the exact power.
            let lost = (1.0 + finish.exponent / 32.0) / 256.0 * total(&definition.lights);
            Some((finish.color(diffuse, specular), finish.specular.map(|channel| lost * channel)))
        });
        let picture = right.recolored(|pixel, fragment| {
            let mut drawn = fixed.color(pixel);
            if let Some(fog) = &fog {
                drawn = fog.bare(pixel, fragment, drawn);
            }
            let (color, off) = fragment.color;
            Some([0, 1, 2].map(|i| drawn[i].clamp(color[i] - off[i], color[i] + off[i])))
        });
        let picture = match &fog {
            Some(fog) => fog.over(&picture, |pixel| fixed.color(pixel)),
            None => picture,
        };
        (picture, None, Some(errors), None)
    };
    let exact = move |corner: Corner| {
        let [x, y, z] = normals[corner.vertex];
        let [u, v, w] = corner.position;
        [x, y, z, u, v, w]
    };
    let shade = move |Sample { triangle, varyings: [x, y, z, u, v, w], .. }: Sample<6>| {
        let length = (x * x + y * y + z * z).sqrt().max(1e-9);
        let finish = &file_finishes[triangle];
        let normal = [x, y, z].map(|c| c / length);
        let [diffuse, specular] = file.levels([u, v, w], normal, finish.exponent);
        Some(finish.color(diffuse, specular))
    };
    Ok(Drawn {
        picture,
        vertices,
        time,
        blended,
        arithmetic: Box::new(arithmetic),
        end_to_end: fixed::end_to_end((model, surface), view, exact, shade),
    })
}

/// The length of a unit of a position of 14 bits, and where its zero lies.
fn position_units(model: &Model, view: &View) -> Result<(f64, [f64; 3]), ViewError> {
    if matches!(view.form, Form::Shaped(_)) {
        // The positions that the core computes fill 16 bits.
        let Noted { quantum, offset, .. } = Noted::of(model, view)?;
        return Ok((4.0 * quantum, offset));
    }
    let all = view.form.shapes(model).flat_map(<[_]>::as_flattened);
    let most = all.map(|c| c ^ (c >> 15)).max().unwrap_or(0);
    let spare = most.leading_zeros() as i32 - 1;
    let step = f64::from(model.scale.mantissa()) * 2f64.powi(model.scale.exponent());
    Ok((2f64.powi(2 - spare) * step, model.offset.to_bits().map(|c| f64::from(c) / 65_536.0)))
}
