//! A square that faces the viewer, with a texture of greys and its mip levels.

use embedded_graphics_core::{
    geometry::{Point, Size},
    pixelcolor::Gray8,
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{Affine, NoDepth},
    camera::{Camera, Distance, Orthographic},
    geometry::{Pose, ScreenVertex},
    mesh::{Material, Mesh, Positions, Tables, TextureCoordinates, Triangles},
    numbers::{Rotation, S8, Scale, Vec3},
    output::Frame,
    scene::Object,
    shade::{OnScreen, Shader, Textured},
    texture::{Colors, Filter, Mipmaps},
};

use super::{
    stage::{self, Lens, Stage},
    work::{Scene, Work},
};
use crate::reference::random::Random;

/// Texels along a side of the texture.
pub(super) const SIDE: usize = 256;
/// Of all levels.
pub(super) const TEXELS: usize = (4 * SIDE * SIDE - 1) / 3;
/// It repeats.
pub(super) type Texture<'a> = Mipmaps<Colors<'a, Gray8, TEXELS>, SIDE, SIDE>;

/// The greys of all levels, each the rounded average of four of the level before it, by the grey of
/// a texel in a column and a row.
pub(super) fn levels(mut grey: impl FnMut(usize, usize) -> f64) -> Box<[Gray8; TEXELS]> {
    let mut level: Vec<f64> =
        (0..SIDE * SIDE).map(|place| grey(place % SIDE, place / SIDE)).collect();
    let mut side = SIDE;
    let mut greys = Vec::with_capacity(TEXELS);
    loop {
        greys.extend(level.iter().map(|&grey| Gray8::new(grey.round() as u8)));
        if side == 1 {
            break;
        }
        let four = |x: usize, y: usize| -> f64 {
            let row = |y: usize| level[y * side + 2 * x] + level[y * side + 2 * x + 1];
            (row(2 * y) + row(2 * y + 1)) / 4.0
        };
        let half = side / 2;
        level = (0..half * half).map(|place| four(place % half, place / half)).collect();
        side = half;
    }
    greys.into_boxed_slice().try_into().expect("it has all levels")
}

/// How far the square's middle is from that of the picture at most, in pixels along x and y.
const REACH: f64 = 8.0;
/// How far the square reaches beyond the picture in pixels.
const MARGIN: i16 = 24;

/// The square: it covers the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Square {
    /// Texels a pixel along x and along y.
    texels: [f64; 2],
    /// Width and height of the picture in pixels.
    picture: [u32; 2],
    /// Of its middle, which is a corner of the texture.
    place: [f64; 3],
}

impl Square {
    /// At a random place.
    pub(super) fn new(texels: [f64; 2], picture: [u32; 2], random: &mut Random) -> Self {
        let [x, y] = [(); 2].map(|()| random.real(-REACH, REACH));
        Self { texels, picture, place: [x, y, -50.0] }
    }

    /// Where the centre of a pixel lies, in texels.
    pub(super) fn texel(&self, [column, row]: [u32; 2]) -> [f64; 2] {
        let [width, height] = self.picture.map(f64::from);
        let [x, y, _] = self.place;
        [
            (f64::from(column) + 0.5 - width / 2.0 - x) * self.texels[0],
            (f64::from(row) + 0.5 - height / 2.0 + y) * self.texels[1],
        ]
    }

    /// Draws it with a filter, to be measured.
    pub(super) fn work(&self, filter: &'static str) -> Work {
        let stage = Stage {
            positions: self.positions().to_vec(),
            triangles: TRIANGLES.map(|corners| corners.map(u16::from)).to_vec(),
            scale: Scale::ONE,
            pose: self.pose(),
            eye: Vec3::ZERO,
            lens: Lens::orthographic(Distance::ONE, FAR),
        };
        let [width, height] = self.picture.map(|side| side as i32);
        Work::DrawTexture {
            scene: Scene {
                texture_coordinates: self.coordinates().to_vec(),
                size: self.picture,
                ..stage.scene::<S8>()
            },
            part: [0, 0, width, height],
            filter,
            correction: "Affine".into(),
        }
    }

    /// The picture.
    pub(super) fn draw<'a, F>(&self, greys: &'a [Gray8; TEXELS], filter: F) -> Vec<Gray8>
    where
        F: Filter<Texture<'a>> + Copy + std::fmt::Debug,
    {
        let (positions, coordinates) = (self.positions(), self.coordinates());
        let mesh = Mesh::new_const(Tables {
            positions: Positions::I16(&positions),
            texture_coordinates: TextureCoordinates::I32(&coordinates),
            triangles: Triangles::U8(&TRIANGLES),
            materials: const { &[Material::new([255; 3], 2)] },
            ..Tables::EMPTY
        });
        let [width, height] = self.picture;
        let picture = Rectangle::new(Point::zero(), Size::new(width, height));
        let camera = Orthographic::new(Distance::from_num(height), Distance::ONE, FAR)
            .and_then(|lens| Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, picture))
            .expect("the distances are in order");
        let textures = [Mipmaps::new(Colors::new(greys))];
        let shader =
            Textured::new(&textures).filtered(filter).corrected(Affine).with_wide_coordinates();
        let mut pixels = vec![Gray8::new(0); (width * height) as usize];
        let mut frame = Frame::without_depth(&mut pixels, picture).expect("it has its size");
        draw(Object::new(&mesh, shader).posed(self.pose()), &camera, &mut frame);
        pixels
    }

    fn pose(&self) -> Pose {
        Pose::IDENTITY.at(stage::vector(self.place))
    }

    /// Half its width in pixels.
    fn half(&self) -> i16 {
        let [width, height] = self.picture;
        (width.max(height) / 2) as i16 + MARGIN
    }

    fn positions(&self) -> [[i16; 3]; 4] {
        let half = self.half();
        [[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]]
    }

    /// The texture coordinates of its corners. v runs down.
    fn coordinates(&self) -> [[i32; 2]; 4] {
        let [u, v] = self
            .texels
            .map(|texels| (f64::from(self.half()) * texels / SIDE as f64 * 2f64.powi(24)) as i32);
        [[-u, v], [u, v], [u, -v], [-u, -v]]
    }
}

const TRIANGLES: [[u8; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const FAR: Distance = Distance::lit("100");

fn draw<Sh: Shader<Color = Gray8>>(
    object: Object<'_, Sh>,
    camera: &Camera<Orthographic>,
    frame: &mut Frame<'_, Gray8, NoDepth>,
) {
    let mut vertices = [ScreenVertex::<S8, NoDepth, OnScreen<Sh>>::EMPTY; 4];
    let Ok(()) = object.draw(camera, &mut vertices, frame) else {
        unreachable!("the square is in the view")
    };
}
