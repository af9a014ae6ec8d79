//! What the core does in instances of stiff problems, which `measure stiffness` has written as
//! tables. The plugin counts its stages from one report to the next.

use core::{cell::RefCell, convert::Infallible, hint::black_box};

use critical_section::Mutex;
use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::Rgb565,
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{Correction, DepthFormat, NoDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    fixed::types::I2F30,
    geometry::{CullNone, Pose, Projection, ScreenVertex},
    mesh::{Material, Mesh, Positions, Tables, TextureCoordinates, Triangles},
    numbers::{Rotation, Scale, Subpixel, Turn, Vec3},
    output::{Frame, StoredDepth},
    scene::{Modes, Object, Projected},
    shade::{OnScreen, Shader, Textured, Unlit},
    texture::{Colors, Filter, Mipmaps},
};

use crate::{
    cost::fail,
    counter::{self, Stage},
};

/// Vertices of the largest object.
const VERTICES: usize = 72;
/// Pixels of the largest part of a picture.
const PIXELS: usize = 320 * 240;

const SIDE: usize = 256;
/// Of all levels.
const TEXELS: usize = (4 * SIDE * SIDE - 1) / 3;
/// The texture that is drawn.
pub type Texture = Mipmaps<Colors<'static, Rgb565, TEXELS>, SIDE, SIDE>;
/// What its texels are makes no difference to the cycles.
static GREYS: [Rgb565; TEXELS] = [Rgb565::new(15, 31, 15); TEXELS];
static TEXTURES: [Texture; 1] = [Mipmaps::new(Colors::new(&GREYS))];

/// What is drawn into.
#[derive(Debug)]
struct Memory {
    color: [Rgb565; PIXELS],
    depth: [u32; PIXELS],
}

static MEMORY: Mutex<RefCell<Memory>> =
    Mutex::new(RefCell::new(Memory { color: [Rgb565::new(0, 0, 0); PIXELS], depth: [0; PIXELS] }));

/// An object before a camera that looks along -z.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// In quanta.
    pub positions: &'static [[i16; 3]],
    /// In turns of the texture, Q8.24; empty without one.
    pub texture_coordinates: &'static [[i32; 2]],
    /// Vertices by their numbers.
    pub triangles: &'static [[u16; 3]],
    /// The length of a quantum: a mantissa, and an exponent of two.
    pub scale: (u32, i32),
    /// The entries of the pose's rotation, Q2.30.
    pub rotation: [[i32; 3]; 3],
    /// Where the object is, Q16.16.
    pub translation: [i32; 3],
    /// Where the eye is, Q16.16.
    pub eye: [i32; 3],
    /// The focal length in pixels of a perspective projection, Q16.16.
    pub focal_length: Option<u32>,
    /// The distances of the near and the far plane, Q16.16.
    pub range: [u32; 2],
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
}

/// A projection that a scene may have.
pub trait Lens: Projection {
    /// That of a scene.
    fn of(scene: &Scene) -> Self;
}

impl Lens for Perspective {
    fn of(scene: &Scene) -> Self {
        let [near, far] = scene.range.map(Distance::from_bits);
        let focal_length = Distance::from_bits(scene.focal_length.unwrap_or(0));
        Self::with_focal_length(focal_length, near, far).unwrap_or_else(fail)
    }
}

/// With a pixel for a unit.
impl Lens for Orthographic {
    fn of(scene: &Scene) -> Self {
        let [near, far] = scene.range.map(Distance::from_bits);
        Self::new(Distance::from_num(scene.size[1]), near, far).unwrap_or_else(fail)
    }
}

/// Solves the instances of a point, which the plugin's next report is about.
pub fn each<T>(instances: &[T], solve: impl Fn(&T)) {
    instances.iter().for_each(solve);
    counter::report();
}

impl Scene {
    /// Places the vertices.
    #[inline(never)]
    pub fn place<S: Subpixel, P: Lens>(&self) {
        self.project::<S, NoDepth, P, _>(Unlit::<Rgb565>::new(), |projected| {
            black_box(projected.vertices());
        });
    }

    /// Clips the triangles.
    #[inline(never)]
    pub fn clip<S: Subpixel, P: Lens>(&self) {
        self.project::<S, NoDepth, P, _>(Unlit::<Rgb565>::new(), |projected| {
            let Ok(()) = projected.for_each_triangle(|_, triangle| {
                black_box(triangle);
                Ok::<(), Infallible>(())
            });
        });
    }

    /// Draws into a part of the picture, by its first column and row, its width and its height.
    #[inline(never)]
    pub fn draw<S: Subpixel, P: Lens, D: StoredDepth>(&self, part: [i32; 4]) {
        with_memory(|Memory { color, depth }| {
            let depth = bytemuck::cast_slice_mut::<u32, D>(depth);
            let (part, pixels) = area(part);
            depth[..pixels].fill(D::ZERO);
            let frame = Frame::new(&mut color[..pixels], &mut depth[..pixels], part);
            let mut frame = frame.unwrap_or_else(fail);
            self.project::<S, D, P, _>(Unlit::<Rgb565>::new(), |projected| {
                let Ok(()) = projected.draw(&mut frame);
            });
        });
    }

    /// Draws with a texture into a part of the picture.
    #[inline(never)]
    pub fn draw_texture<S: Subpixel, P: Lens, F, M: Correction>(
        &self,
        part: [i32; 4],
        filter: F,
        correction: M,
    ) where
        F: Filter<Texture> + Copy + core::fmt::Debug,
    {
        with_memory(|Memory { color, .. }| {
            let (part, pixels) = area(part);
            let frame = Frame::without_depth(&mut color[..pixels], part);
            let mut frame = frame.unwrap_or_else(fail);
            let shader = Textured::new(&TEXTURES).filtered(filter).corrected(correction);
            self.project::<S, NoDepth, P, _>(shader.with_wide_coordinates(), |projected| {
                let Ok(()) = projected.draw(&mut frame);
            });
        });
    }

    /// Has the projection of the object counted, and what it is used for.
    fn project<S: Subpixel, D: DepthFormat, P: Lens, Sh: Shader>(
        &self,
        shader: Sh,
        then: impl FnOnce(Projected<'_, &[ScreenVertex<S, D, OnScreen<Sh>>], P, Sh, Modes<CullNone>>),
    ) {
        let materials = [Material::new([255; 3], self.triangles.len() as u32)];
        let (mantissa, exponent) = self.scale;
        let mesh = Mesh::new_const(Tables {
            positions: Positions::I16(self.positions),
            scale: Scale::new(mantissa, exponent),
            triangles: Triangles::U16(self.triangles),
            materials: &materials,
            texture_coordinates: TextureCoordinates::I32(self.texture_coordinates),
            ..Tables::EMPTY
        });
        let [width, height] = self.size;
        let viewport = Rectangle::new(Point::zero(), Size::new(width, height));
        let eye = Vec3::from_bits(self.eye);
        let camera = Camera::at(eye, Rotation::IDENTITY, P::of(self), viewport);
        let camera = camera.unwrap_or_else(fail);
        let rows = self.rotation.map(|row| row.map(I2F30::from_bits));
        let rotation = Rotation::from_rows(rows).unwrap_or(Rotation::IDENTITY);
        let pose = Pose::rotated(rotation).at(Vec3::from_bits(self.translation));
        let object = Object::new(&mesh, shader).posed(pose).culled(CullNone);
        let mut vertices = [ScreenVertex::<S, D, OnScreen<Sh>>::EMPTY; VERTICES];
        counter::mark(Stage::Vertices);
        let projected = object.project(&camera, &mut vertices);
        counter::mark(Stage::Vertices);
        let projected = projected.unwrap_or_else(fail);
        counter::mark(Stage::Draw);
        then(projected);
        counter::mark(Stage::Draw);
    }
}

/// Composes rotations about the three axes, one after the other.
#[inline(never)]
pub fn compose(count: u32, restores: bool) {
    let angle = |axis: u32| Turn::from_bits(0x3456_789a_u32.wrapping_mul(2 * axis + 1));
    let turns =
        [Rotation::about_x(angle(0)), Rotation::about_y(angle(1)), Rotation::about_z(angle(2))];
    let mut rotation = Rotation::IDENTITY;
    counter::mark(Stage::Draw);
    for turn in turns.iter().cycle().take(count as usize) {
        rotation = if restores { turn.compose(rotation) } else { *turn * rotation };
    }
    counter::mark(Stage::Draw);
    black_box(rotation);
}

/// A part of a picture, and its pixels.
const fn area([x, y, width, height]: [i32; 4]) -> (Rectangle, usize) {
    let size = Size::new(width as u32, height as u32);
    (Rectangle::new(Point::new(x, y), size), (width * height) as usize)
}

fn with_memory(then: impl FnOnce(&mut Memory)) {
    critical_section::with(|token| then(&mut MEMORY.borrow_ref_mut(token)));
}
