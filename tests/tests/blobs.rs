//! Models as bytes: the same meshes and pictures as their tables, and no bytes that do harm.

use std::{collections::HashSet, path::Path};

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use host_tools::model::{Model, Options, blob};
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::ScreenVertex,
    mesh::{BlobError, Finish, Mesh, MeshError},
    numbers::{Rotation, S4, Turn, Vec3},
    output::Frame,
    scene::Object,
    shade::{ColoredGouraud, Level, Light, OnScreen, Phong, Shader, TexturedFlat},
    texture::{Colors, Texture},
};
use rasterizer_tests::{Random, area, shipped_models};

/// Bytes that begin at a multiple of 4, or some bytes after it.
struct Place(Vec<u32>);

impl Place {
    fn new(length: usize) -> Self {
        Self(vec![0; length / 4 + 2])
    }

    fn put(&mut self, bytes: &[u8], after: usize) -> &[u8] {
        for (index, word) in self.0.iter_mut().enumerate() {
            let byte = |i: usize| {
                (4 * index + i).checked_sub(after).and_then(|i| bytes.get(i)).copied().unwrap_or(0)
            };
            *word = u32::from_ne_bytes([0, 1, 2, 3].map(byte));
        }
        &bytemuck::cast_slice(&self.0)[after..after + bytes.len()]
    }
}

fn load(name: &str) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../host-tools/models").join(name);
    Model::load(path, &Options::default()).unwrap()
}

const LIGHT: Light = Light::new(Vec3::lit("-1", "2", "3"), Level::lit("0.1"), Level::lit("0.9"));
static TEXTURES: [Texture<Colors<'static, Rgb888, 4>, 2, 2>; 4] =
    [Texture::new(Colors::new(&[Rgb888::RED, Rgb888::BLUE, Rgb888::GREEN, Rgb888::WHITE])); 4];

/// The picture by a shader; `None` if the mesh lacks a table, or is refused.
fn picture<Sh: Shader<Color = Rgb888>>(mesh: &Mesh<'_>, shader: Sh) -> Option<Vec<Rgb888>> {
    let lens = Perspective::new(Turn::degrees(40), Distance::lit("0.5"), Distance::lit("100"));
    let display = area(0, 0, 40, 30);
    let eye = Vec3::lit("0.3", "0.4", "2.5");
    let camera = Camera::at(eye, Rotation::IDENTITY, lens.unwrap(), display).unwrap();
    let mut storage = vec![ScreenVertex::<S4, u16, OnScreen<Sh>>::EMPTY; mesh.vertex_count()];
    let (mut color, mut depth) = (vec![Rgb888::BLACK; 1200], vec![0_u16; 1200]);
    let mut frame = Frame::new(&mut color, &mut depth, display).unwrap();
    Object::new(mesh, shader).draw(&camera, &mut storage, &mut frame).ok()?;
    Some(color)
}

fn pictures(mesh: &Mesh<'_>) -> [Option<Vec<Rgb888>>; 3] {
    [
        picture(mesh, Phong::new(LIGHT)),
        picture(mesh, TexturedFlat::new(&TEXTURES, LIGHT).with_wide_coordinates()),
        picture(mesh, ColoredGouraud::new(LIGHT)),
    ]
}

/// A body with all tables, of few bytes.
fn small() -> Model {
    let text = "v -1 -1 0 1 0 0\nv 1 -1 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 1\nvt 0 0\nvt 1 0\n\
                vt 0 1\nusemtl a\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nusemtl b\nf 3/1 1/2 4/3\n\
                f 1/1 3/2 2/3\n";
    let mut options = Options { textures: None, ..Options::default() };
    options.contents.texture_coordinates = true;
    let mut model = Model::from_bytes(Path::new("small.obj"), text.as_bytes(), &options).unwrap();
    let finish = Finish::MATTE.with_specular([1, 2, 3], 456).with_emission([7, 8, 9]);
    // Both materials are unknown, and are one.
    model.finishes = vec![finish.with_opacity(10); model.materials.len()];
    model
}

#[test]
fn models_as_bytes_are_the_same_meshes() {
    let mut models: Vec<Model> = shipped_models()
        .iter()
        .map(|path| Model::load(path, &Options::default()).unwrap())
        .collect();
    models.push(small());
    let mut far = small();
    far.texture_coordinates =
        host_tools::model::TextureTable::I32(vec![[3 << 24, -5]; far.positions.len()]);
    models.push(far);
    let mut formats = HashSet::new();
    for model in &models {
        let bytes = blob::bytes(model);
        let mut place = Place::new(bytes.len());
        let mesh = Mesh::from_bytes(place.put(&bytes, 0)).unwrap();
        assert_eq!(mesh, model.mesh(), "{}", model.name);
        let drawn = pictures(&mesh);
        assert!(drawn == pictures(&model.mesh()), "{}", model.name);
        assert!(drawn[0].as_ref().is_some_and(|p| p.iter().any(|&c| c != Rgb888::BLACK)));
        formats.insert(bytes[24]);
        // Each table is there once, and there are no bytes beside but for the header's 48 and those
        // that align.
        let tables = model.report.flash;
        let counted = tables.total() - tables.textures - tables.edges;
        // The figures of the small one are those before it was changed.
        let is_changed = model.name == "SMALL";
        assert!(
            is_changed || (counted + 48..=counted + 48 + 24).contains(&bytes.len()),
            "{}",
            model.name
        );
    }
    assert!(formats.len() >= 4, "{formats:?}");
}

#[test]
fn each_fault_is_named() {
    let bytes = blob::bytes(&small());
    let mut place = Place::new(bytes.len() + 8);
    let mut fault = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut changed = bytes.clone();
        change(&mut changed);
        Mesh::from_bytes(place.put(&changed, 0)).map(|_| ()).unwrap_err()
    };
    assert_eq!(fault(&|b| b.clear()), BlobError::Length);
    assert_eq!(fault(&|b| b.truncate(3)), BlobError::Length);
    assert_eq!(fault(&|b| b.truncate(30)), BlobError::Length);
    assert_eq!(fault(&|b| b.push(0)), BlobError::Length);
    assert_eq!(fault(&|b| b[0] = b'r'), BlobError::Magic);
    assert_eq!(fault(&|b| b[4] = 2), BlobError::Version);
    assert_eq!(fault(&|b| b[6..8].reverse()), BlobError::Endianness);
    assert_eq!(fault(&|b| b[12] += 1), BlobError::Length);
    assert_eq!(fault(&|b| b[12..16].fill(255)), BlobError::Length);
    assert_eq!(fault(&|b| b[24] |= 0x80), BlobError::Columns);
    assert_eq!(fault(&|b| b[24] |= 0x0C), BlobError::Columns);
    assert_eq!(fault(&|b| b[31] &= 0x7F), BlobError::Scale);
    assert_eq!(fault(&|b| b[33] ^= 0x40), BlobError::Scale);
    for after in 1..4 {
        assert_eq!(Mesh::from_bytes(place.put(&bytes, after)).unwrap_err(), BlobError::Alignment);
    }
    assert!(Mesh::from_bytes(place.put(&bytes, 4)).is_ok());
    let error = BlobError::Tables(MeshError::IndexOutOfRange { triangle: 1 });
    assert!(error.to_string().ends_with("(triangle 1)"));
}

/// Mutations of files, of their headers above all: each is refused, or drawn.
#[test]
fn no_bytes_do_harm() {
    let (mut random, mut faults, mut accepted) = (Random::new(61), HashSet::new(), 0);
    for model in [small(), load("gear.obj")] {
        let bytes = blob::bytes(&model);
        let mut place = Place::new(bytes.len() + 64);
        let rounds = if bytes.len() < 1000 { 60_000 } else { 3000 };
        for _ in 0..rounds {
            let mut changed = bytes.clone();
            for _ in 0..random.within(1, 4) {
                let header = if random.coin() { 48 } else { bytes.len() };
                let index = random.within(0, header as i32 - 1) as usize;
                changed[index] = match random.within(0, 4) {
                    0 => 0,
                    1 => 255,
                    2 => changed[index].wrapping_add(1),
                    3 => changed[index] ^ 1 << random.within(0, 7),
                    _ => random.bits() as u8,
                };
            }
            match random.within(0, 9) {
                0 => changed.truncate(random.within(0, bytes.len() as i32) as usize),
                1 => changed.resize(bytes.len() + random.within(0, 60) as usize, 7),
                _ => {}
            }
            if random.coin() {
                // Past the check of the length.
                let length = changed.len() as u32;
                if let Some(own) = changed.get_mut(8..12) {
                    own.copy_from_slice(&length.to_le_bytes());
                }
            }
            match Mesh::from_bytes(place.put(&changed, 0)) {
                Ok(mesh) => {
                    accepted += 1;
                    let _ = pictures(&mesh);
                }
                Err(error) => {
                    faults.insert(std::mem::discriminant(&error));
                }
            }
        }
    }
    assert!(accepted > 5000, "{accepted}");
    // All but that of alignment.
    assert_eq!(faults.len(), 7);
}
