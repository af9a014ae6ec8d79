//! The fixed-point picture, by the same tables and the same calls as on a microcontroller.

use std::{
    convert::Infallible,
    time::{Duration, Instant},
};

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use rasterizer::{
    camera::Camera,
    geometry::{Projection, ScreenVertex},
    mesh::Mesh,
    numbers::{S4, S8, Subpixel},
    output::{Frame, StoredDepth},
    scene::Object,
    shade::{Flat, Gouraud, OnScreen, Shader, Unlit},
};

use super::view::{self, Shading, View, ViewError, triangle_colors};
use crate::{
    model::Model,
    reference::{ScreenTriangle, ScreenVertex as ReferenceVertex},
};

/// Of interpolated light: as many steps as a channel of the pictures that are compared.
const LEVELS: usize = 256;

/// A picture by the fixed-point core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FixedPicture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The pixels, row by row.
    pub pixels: Vec<Pixel>,
}

/// A pixel by the fixed-point core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pixel {
    /// Its colour in 8-bit steps; black where nothing was drawn.
    pub color: [u8; 3],
    /// Its stored depth; 0 where nothing was drawn.
    pub depth: u32,
}

/// The picture and what led to it.
pub(super) struct Drawn {
    pub(super) picture: FixedPicture,
    /// Where each vertex was placed, in pixels; nothing for those outside near plane, far plane
    /// and guard band.
    pub(super) vertices: Vec<Option<[f64; 2]>>,
    /// The triangles that were drawn, as they were placed on the screen; depth in units of the
    /// stored format.
    pub(super) triangles: Vec<ScreenTriangle>,
    /// How long the core took for vertices and triangles.
    pub(super) time: Duration,
}

/// A depth format as the judge sees it.
trait Judged: StoredDepth + Into<u32> {}
impl<D: StoredDepth + Into<u32>> Judged for D {}

/// What the judge has to know about a shader.
trait Leveled: Shader<Color = Rgb888> {
    /// The light level, from 0 to 1, of a vertex of the triangle `index`.
    fn level(&self, varyings: OnScreen<Self>, mesh: &Mesh<'_>, index: usize) -> f64;
}

impl Leveled for Unlit<Rgb888> {
    fn level(&self, _: [u16; 0], _: &Mesh<'_>, _: usize) -> f64 {
        1.0
    }
}

impl Leveled for Flat<Rgb888> {
    /// From the normal in the table, by the definition.
    fn level(&self, _: [u16; 0], mesh: &Mesh<'_>, index: usize) -> f64 {
        let light = self.light();
        let normal = mesh.tables().face_normals.get(index).expect("the shader needs normals");
        let dot: f64 = (0..3)
            .map(|i| f64::from(normal[i]) / 127.0 * f64::from(light.toward()[i]) / 2f64.powi(30))
            .sum();
        (light.ambient().to_num::<f64>() + light.diffuse().to_num::<f64>() * dot.max(0.0)).min(1.0)
    }
}

impl Leveled for Gouraud<Rgb888, LEVELS> {
    /// From the varying: 0 and 1 lie in the middle of the first and the last level of the ramp.
    fn level(&self, [place]: [u16; 1], _: &Mesh<'_>, _: usize) -> f64 {
        let levels = LEVELS as f64;
        (f64::from(place) / 65536.0 * levels - 0.5) / (levels - 1.0)
    }
}

/// Draws the model as the view says.
pub(super) fn draw(model: &Model, view: &View) -> Result<Drawn, ViewError> {
    match view.projection {
        view::Projection::Perspective { field_of_view_degrees } => {
            by_camera(model, view, &view.perspective(field_of_view_degrees)?)
        }
        view::Projection::Orthographic { height } => {
            by_camera(model, view, &view.orthographic(height)?)
        }
    }
}

fn by_camera<P: Projection>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
) -> Result<Drawn, ViewError> {
    match view.subpixel {
        view::Subpixel::S4 => by_precision::<P, S4>(model, view, camera),
        view::Subpixel::S8 => by_precision::<P, S8>(model, view, camera),
    }
}

fn by_precision<P: Projection, S: Subpixel>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
) -> Result<Drawn, ViewError> {
    match view.depth {
        view::DepthFormat::U16 => by_depth::<P, S, u16>(model, view, camera),
        view::DepthFormat::U32 => by_depth::<P, S, u32>(model, view, camera),
    }
}

fn by_depth<P: Projection, S: Subpixel, D: Judged>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
) -> Result<Drawn, ViewError> {
    let light = View::light();
    match view.shading {
        Shading::Flat => by_shader::<P, S, D, _>(model, view, camera, Flat::new(light)),
        Shading::Gouraud => {
            by_shader::<P, S, D, _>(model, view, camera, Gouraud::with_levels(light))
        }
        Shading::Unlit => by_shader::<P, S, D, _>(model, view, camera, Unlit::new()),
    }
}

fn by_shader<P: Projection, S: Subpixel, D: Judged, Sh: Leveled>(
    model: &Model,
    view: &View,
    camera: &Camera<P>,
    shader: Sh,
) -> Result<Drawn, ViewError> {
    let mesh = model.mesh();
    let area = view.area();
    let pixels = area.size.width as usize * area.size.height as usize;
    let mut color = vec![Rgb888::BLACK; pixels];
    let mut depth = vec![D::ZERO; pixels];
    let mut storage = vec![ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let object = Object::new(&mesh, shader.clone()).posed(view.pose());

    let start = Instant::now();
    let projected = object.project(camera, &mut storage)?;
    let mut frame = Frame::new(&mut color, &mut depth, area)?;
    let Ok(()) = projected.draw(&mut frame);
    let time = start.elapsed();

    let to_pixels = |c: i32| f64::from(c) / f64::from(1 << S::BITS);
    let colors = triangle_colors(model);
    let for_object = shader.for_object(object.pose());
    let mut triangles = Vec::new();
    let Ok(()) = projected.for_each_triangle(|index, corners| {
        triangles.push(ScreenTriangle {
            vertices: corners.map(|corner| {
                let [x, y] = corner.position().unwrap_or_default().map(to_pixels);
                ReferenceVertex {
                    x,
                    y,
                    depth: f64::from(corner.depth().into()),
                    level: for_object.level(corner.varyings(), &mesh, index),
                }
            }),
            color: colors[index],
        });
        Ok::<(), Infallible>(())
    });
    let place =
        |vertex: &ScreenVertex<S, D, OnScreen<Sh>>| vertex.position().map(|p| p.map(to_pixels));
    let vertices = projected.vertices().iter().map(place).collect();
    let pixel = |(color, depth): (&Rgb888, &D)| Pixel {
        color: [color.r(), color.g(), color.b()],
        depth: (*depth).into(),
    };
    Ok(Drawn {
        picture: FixedPicture {
            size: view.size,
            pixels: color.iter().zip(&depth).map(pixel).collect(),
        },
        vertices,
        triangles,
        time,
    })
}
