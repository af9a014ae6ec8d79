//! A small world and what is needed to draw it in bands: a ground to the horizon, twenty trees in
//! two levels of detail, a rocket with its shadow, fog, a label, and a map in a corner.
//!
//! It needs no heap and no `std`, so that the firmware that is measured draws it too.

use embedded_graphics::{
    mono_font::{MonoTextStyle, ascii::FONT_6X10},
    pixelcolor::{Rgb565, Rgb888},
    prelude::*,
    primitives::Rectangle,
    text::{Alignment, Text},
};
use rasterizer::{
    attribute::Adaptive,
    camera::{CameraError, FirstPerson},
    fixed::types::{I0F32, I8F8},
    geometry::{PlanarShadow, Plane},
    mesh::{
        Material, Mesh, Positions, Tables, TextureCoordinates, Triangles,
        shapes::{Cone, Cylinder, Solid},
    },
    numbers::Scale,
    output::{Bands, VerticalGradient},
    prelude::*,
    raster::Bias,
    scene::{DrawError, Levels, RowRange, Scene, each},
    shade::{AtVertices, Fog, Fogged, OnScreen, Recolored},
    texture::{Indexed, Texture},
};

use super::rocket::ROCKET;

/// The display.
pub(crate) const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(240, 240));
/// The part of it that has the map.
const MAP: Rectangle = Rectangle::new(Point::new(172, 172), Size::new(64, 64));
/// The rows of a band.
pub(crate) const BAND_ROWS: usize = 32;
/// The frames of the walk, round the rocket and back to where it began.
pub(crate) const FRAMES: u32 = 24;

const HAZE: [u8; 3] = [206, 214, 204];
const HAZE_COLOR: Rgb565 = Rgb565::new(25, 53, 25);
const SKY: VerticalGradient<Rgb565> =
    VerticalGradient::new(Rectangle::new(Point::zero(), Size::new(240, 100)), [92, 148, 208], HAZE);
const MAP_COLOR: Rgb565 = Rgb565::new(17, 44, 13);
const MAP_TREE: Rgb888 = Rgb888::new(48, 106, 60);
const MAP_ROCKET: Rgb888 = Rgb888::new(200, 60, 50);

const SHADOW: Rgb888 = Rgb888::new(52, 76, 38);
/// Shadows lie in the ground.
const NEARER: Bias = Bias { slope: I8F8::lit("1"), constant: I0F32::from_bits(3 << 16) };
const SUNWARD: Vec3 = Vec3::lit("-3", "5", "2");
const SUN: Light = Light::new(SUNWARD, Level::lit("0.3"), Level::lit("0.7"));
/// In flash: none up to 4 units from the camera, all from 22 on.
static FOG: Fog = Fog::linear(Distance::lit("4"), Distance::lit("22")).unwrap();

/// 64 x 64 units, with a texture that is repeated in each of them.
static GROUND: Mesh<'static> = Mesh::new_const(Tables {
    positions: Positions::I16(&[[-32, 0, 32], [32, 0, 32], [32, 0, -32], [-32, 0, -32]]),
    scale: Scale::new(1, 0),
    texture_coordinates: {
        const END: i32 = 32 << 24;
        TextureCoordinates::I32(&[[-END, END], [END, END], [END, -END], [-END, -END]])
    },
    triangles: Triangles::U8(&[[0, 1, 2], [0, 2, 3]]),
    materials: &[Material::new([96, 124, 62], 2)],
    ..Tables::EMPTY
});
const FLOOR: Plane = Plane::new(Vec3::Y, Scalar::ZERO);

/// The grass is stepped between divisions within a texel.
const TEXEL: Adaptive<16> = Adaptive;
/// 32 x 32 texels of four greens, in 256 bytes.
type Grass = Texture<Indexed<'static, Rgb565, 2, 256, 4>, 32, 32>;
static GRASS: [Grass; 1] = {
    static TEXELS: [u8; 256] = {
        let (mut texels, mut random, mut index) = ([0; 256], 0x2545_F491u32, 0);
        while index < 256 {
            // Xorshift (Marsaglia 2003).
            random ^= random << 13;
            random ^= random >> 17;
            random ^= random << 5;
            texels[index] = (random >> 24) as u8 & (random >> 8) as u8;
            index += 1;
        }
        texels
    };
    const GREENS: &[Rgb565; 4] = &[
        Rgb565::new(12, 31, 8),
        Rgb565::new(10, 28, 7),
        Rgb565::new(13, 34, 8),
        Rgb565::new(15, 35, 11),
    ];
    [Texture::new(Indexed::new(&TEXELS, GREENS))]
};

const FINE: Cone = Cone::new(12);
const COARSE: Cone = Cone::new(5);
const TRUNK: Cylinder = Cylinder::new(6);
static FINE_TABLES: Solid<{ FINE.vertices() }, { FINE.triangles() }> = FINE.solid();
static COARSE_TABLES: Solid<{ COARSE.vertices() }, { COARSE.triangles() }> = COARSE.solid();
static TRUNK_TABLES: Solid<{ TRUNK.vertices() }, { TRUNK.triangles() }> = TRUNK.solid();
const GREEN: [u8; 3] = [48, 106, 60];
static FINE_CROWN: Mesh<'static> =
    FINE_TABLES.mesh(&[Material::new(GREEN, FINE.triangles() as u32)]);
static COARSE_CROWN: Mesh<'static> =
    COARSE_TABLES.mesh(&[Material::new(GREEN, COARSE.triangles() as u32)]);
static BARE_TRUNK: Mesh<'static> =
    TRUNK_TABLES.mesh(&[Material::new([112, 84, 60], TRUNK.triangles() as u32)]);
const CROWN: Levels<'static, 2> =
    Levels::new([(Distance::lit("9"), &FINE_CROWN), (Distance::lit("24"), &COARSE_CROWN)]);
/// A cylinder of radius 1 and height 2 in this scale, with its middle this high.
const TRUNK_SIZE: Distance = Distance::lit("0.16");
const TRUNK_HEIGHT: Scalar = Scalar::lit("0.16");
/// Where a crown begins.
const CROWN_BASE: Scalar = Scalar::lit("0.25");
/// A trunk is left out from six units on.
const TRUNK_LEVELS: Levels<'static, 1> = Levels::new([(Distance::lit("36"), &BARE_TRUNK)]);

/// Where the trees stand, and half the height of their crowns.
static TREES: [(Vec3, Distance); 20] = {
    const fn tree(x: &str, z: &str, size: &str) -> (Vec3, Distance) {
        (Vec3::lit(x, "0", z), Distance::lit(size))
    }
    [
        tree("-2.6", "-0.9", "0.45"),
        tree("-1.6", "-2.4", "0.5"),
        tree("2.1", "-1.7", "0.5"),
        tree("2.8", "0.9", "0.4"),
        tree("1.2", "2.5", "0.5"),
        tree("-1.5", "1.9", "0.4"),
        tree("-9.5", "1.5", "1.2"),
        tree("-8.3", "5.6", "1"),
        tree("-8.8", "-5.3", "1.3"),
        tree("-4.6", "-9.4", "1"),
        tree("0.7", "-10.2", "1.2"),
        tree("5.2", "-8.8", "0.9"),
        tree("9.4", "-4.1", "1.1"),
        tree("10.3", "0.4", "1.3"),
        tree("9", "5.2", "0.9"),
        tree("5.8", "9.3", "1.2"),
        tree("0.9", "10.1", "1"),
        tree("-4.4", "9.1", "1.3"),
        tree("-13", "-9", "1.4"),
        tree("12", "10", "1.4"),
    ]
};

/// A shadow, a trunk and a crown of each tree, and the rocket's shadow.
const ROWS: usize = 3 * TREES.len() + 1;
type Lit = Fogged<'static, Gouraud<Rgb565>, AtVertices>;
type Vertex = ScreenVertex<S4, u16, OnScreen<Lit>>;

/// The memory of a frame, besides its bands.
#[derive(Debug)]
pub(crate) struct Storage {
    /// Those of the rocket, which reaches many bands.
    vertices: [Vertex; ROCKET.vertex_count()],
    /// Where the other objects are on the screen.
    rows: [RowRange; ROWS],
}

impl Storage {
    /// All bits 0.
    pub(crate) const EMPTY: Self =
        Self { vertices: [Vertex::EMPTY; ROCKET.vertex_count()], rows: [RowRange::EMPTY; ROWS] };
}

/// The walker, who has gone this far round the rocket, and the map that goes along.
///
/// # Errors
///
/// None: the viewports have valid sizes.
fn cameras(turned: Turn) -> Result<(Camera, Camera<Orthographic>), CameraError> {
    const LENS: Perspective =
        match Perspective::new(Turn::degrees(50), Distance::lit("0.2"), Distance::lit("50")) {
            Ok(lens) => lens,
            Err(_) => panic!("the lens makes no sense"),
        };
    const PLAN: Orthographic =
        match Orthographic::new(Distance::lit("16"), Distance::lit("1"), Distance::lit("50")) {
            Ok(lens) => lens,
            Err(_) => panic!("the lens makes no sense"),
        };
    let mut walker = FirstPerson::new(const { Vec3::lit("0", "1", "0") });
    walker.look(turned, Turn::ZERO);
    walker.step(const { Scalar::lit("-5.5") }, Scalar::ZERO, Scalar::ZERO);
    walker.look(Turn::degrees(12), Turn::degrees(4));
    let above = walker.eye + const { Vec3::lit("0", "30", "0") };
    let down = Rotation::about_y(walker.yaw()) * Rotation::about_x(-Turn::QUARTER);
    Ok((walker.camera(LENS, SCREEN)?, Camera::at(above, down, PLAN, MAP)?))
}

/// Draws a frame of the walk and sends it to the display.
///
/// # Errors
///
/// Returns the display's first error; of a view elsewhere also that an object is too near.
pub(crate) fn draw<D: DrawTarget<Color = Rgb565>>(
    frame: u32,
    storage: &mut Storage,
    bands: &mut Bands<&mut [Rgb565], Rgb565, &mut [u16]>,
    display: &mut D,
) -> Result<(), DrawError<D::Error>> {
    let turned = Turn::from_bits(frame.wrapping_mul(u32::MAX / FRAMES + 1));
    let Ok((walker, above)) = cameras(turned) else { return Ok(()) };
    let lit: Lit = Fogged::new(Gouraud::new(SUN), &FOG, HAZE_COLOR).computed(AtVertices);
    let dark =
        Fogged::new(Recolored::new(Unlit::new(), SHADOW), &FOG, HAZE_COLOR).computed(AtVertices);
    let shadow_of = |mesh, pose| {
        let shadow = PlanarShadow::new(FLOOR, SUNWARD);
        Object::new(mesh, dark).posed(pose).clipped(shadow).biased(NEARER)
    };

    let grass = Textured::new(&GRASS).corrected(TEXEL).with_wide_coordinates();
    let ground = Object::new(&GROUND, Fogged::new(grass, &FOG, HAZE_COLOR));
    let ground = ground.project_on_demand(&walker, S8)?;

    // It spins, and hovers.
    let pose =
        Pose::rotated(Rotation::about_y(turned + turned)).at(const { Vec3::lit("0", "1.3", "0") });
    let rocket = Object::new(&ROCKET, lit).posed(pose).project(&walker, &mut storage.vertices)?;
    let trees = each(&TREES, |&(place, size)| {
        let trunk =
            Pose::IDENTITY.at(place + Vec3 { y: TRUNK_HEIGHT, ..Vec3::ZERO }).scaled(TRUNK_SIZE);
        let up = Scalar::from_bits(size.to_bits() as i32) + CROWN_BASE;
        let crown = Pose::IDENTITY.at(place + Vec3 { y: up, ..Vec3::ZERO }).scaled(size);
        let near = CROWN.level(&crown, &walker) == Some(0);
        let object = |mesh| Object::new(mesh, lit);
        (
            near.then(|| shadow_of(&COARSE_CROWN, crown)),
            TRUNK_LEVELS.mesh(&trunk, &walker).map(|mesh| object(mesh).posed(trunk)),
            CROWN.mesh(&crown, &walker).map(|mesh| object(mesh).posed(crown)),
        )
    });
    let contents = (&ground, shadow_of(&ROCKET, pose), trees, &rocket);
    let world = Scene::new(contents, &walker, S4, &mut storage.rows)?;

    // The map has the trees as they are seen from above, and a red spot for the rocket. Nothing of
    // it is near the camera, so that no triangle is clipped.
    let spot = |color, place, size| {
        let pose = Pose::IDENTITY.at(place).scaled(size);
        let shader = Recolored::new(Unlit::new(), color);
        Object::new(&COARSE_CROWN, shader).posed(pose).clipped(ClipNone)
    };
    let trees = each(&TREES, |&(place, size)| spot(MAP_TREE, place, size));
    let middle = spot(MAP_ROCKET, Vec3::ZERO, Distance::ONE);
    let mut map_rows = [RowRange::EMPTY; TREES.len() + 1];
    let map = Scene::new((trees, middle), &above, S4, &mut map_rows)?;

    let label = walker.place_on_screen(const { Vec3::lit("0", "2.6", "0") });
    let draw_band = |band: &mut Frame<'_, Rgb565, &mut [u16]>| {
        world.draw(band)?;
        if let Some(label) = label {
            let style = MonoTextStyle::new(&FONT_6X10, Rgb565::BLACK);
            Text::with_alignment("rocket", label.pixel(), style, Alignment::Center).draw(band)?;
        }
        if band.area().intersection(&MAP).is_zero_sized() {
            return Ok(());
        }
        // A picture of its own, over the other one.
        band.fill_solid(&MAP, MAP_COLOR)?;
        band.clear_depth();
        map.draw(band)?;
        band.fill_solid(&Rectangle::with_center(MAP.center(), Size::new(3, 3)), Rgb565::WHITE)
    };
    let background = |band: &mut Frame<'_, Rgb565, &mut [u16]>| {
        band.clear_color(HAZE_COLOR);
        let Ok(()) = SKY.draw(band);
    };
    bands.show(display, background, draw_band).map_err(DrawError::Target)
}
