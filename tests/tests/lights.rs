//! Light at pixels against its definition: the normal by itself, and the colour in any light.

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::Rgb888,
    primitives::Rectangle,
};
use fixed::types::I16F16;
use host_tools::{
    check::{judge, screen_triangles},
    reference::{self, Lights, Sample, Sun, Viewer, draw_screen},
};
use rasterizer::{
    attribute::{Correction, PerspectiveCorrect},
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{CullNone, ObjectView, Pose, Projection, ScreenVertex},
    mesh::{
        Finish, Material, Mesh, MeshMaterial, MeshVertex, Normals, Positions, RequiredTables,
        Tables, Triangles,
    },
    numbers::{Rotation, S8, Scale, Turn, Vec3},
    output::{Frame, PixelFill, StoredColor},
    raster::Fragment,
    scene::Object,
    shade::{Lamp, Level, Light, Lighting, OnScreen, Phong, PhongCorrection, Shader, ViewedFrom},
};
use rasterizer_tests::{
    Random,
    exact::{numbers, quantum, rotated},
    vector::{Vector, angle, dot, unit},
};

const SCREEN: Rectangle = Rectangle::new(Point::zero(), Size::new(96, 80));

/// The interpolated normal of a pixel in place of a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen([I16F16; 3]);

impl StoredColor for Seen {
    type Fill = PixelFill<Self>;
}

/// The normals that [`Phong`] makes unit vectors of.
#[derive(Clone)]
struct PixelNormals(Phong<Rgb888>);

impl Shader for PixelNormals {
    type Color = Seen;
    type Varyings = <Phong<Rgb888> as Shader>::Varyings;
    type Surface = ();
    type Face = ();
    type Outcome = Seen;

    const TABLES: RequiredTables = Phong::<Rgb888>::TABLES;

    fn for_object(&self, view: &ObjectView<'_>) -> Self {
        Self(self.0.for_object(view))
    }

    fn surface(&self, _: &MeshMaterial<'_>) {}

    fn vertex(&self, vertex: &MeshVertex<'_>) -> PerspectiveCorrect<[i16; 3], PhongCorrection> {
        self.0.vertex(vertex)
    }

    fn pixel(&self, (): &(), (): &(), fragment: Fragment<rasterizer::shade::Sample<Self>>) -> Seen {
        Seen(fragment.varyings.value)
    }
}

fn quantised(normal: Vector) -> [i8; 3] {
    normal.map(|c| (c * 127.0).round() as i8)
}

/// Random triangles with random normals, near and far, cut by the near plane, and so on.
#[test]
fn normals_of_pixels_are_within_half_a_degree() {
    let mut random = Random::new(31);
    let lens = Perspective::new(Turn::degrees(70), Distance::lit("0.25"), Distance::lit("90"));
    let camera = Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens.unwrap(), SCREEN).unwrap();
    let (mut judged, mut worst) = (0, 0.0);
    for round in 0..3_000 {
        let mut real = |reach: f64| (random.bits() >> 11) as f64 / 2f64.powi(52) * reach - reach;
        let around: Vector = unit([(); 3].map(|()| real(1.0)));
        // Less than 120 degrees apart, the more so the later.
        let spread = f64::from(round % 10) / 10.0 * 0.95;
        let normals = [(); 3].map(|()| {
            quantised(unit(
                [0, 1, 2].map(|i| around[i] + spread * unit([(); 3].map(|()| real(1.0)))[i]),
            ))
        });
        let positions = [(); 3].map(|()| {
            let z = 2f64.powf(real(4.5) + 8.0);
            [real(1.4 * z), real(1.2 * z), -z].map(|c| c.clamp(-32_000.0, 32_000.0) as i16)
        });
        let as_f64 = normals.map(|n| n.map(f64::from));
        let mesh = Mesh::new(Tables {
            positions: Positions::I16(&positions),
            scale: Scale::new(1, -9),
            vertex_normals: Normals::I8(&normals),
            triangles: Triangles::U8(&[[0, 1, 2]]),
            materials: const { &[Material::new([255; 3], 1)] },
            ..Tables::EMPTY
        });
        let mesh = mesh.unwrap();
        let shader = PixelNormals(Phong::new(Light::new(Vec3::Z, Level::ZERO, Level::ONE)));
        let mut storage = [ScreenVertex::<S8, u16, OnScreen<PixelNormals>>::EMPTY; 3];
        let object = Object::new(&mesh, shader).culled(CullNone);
        let Ok(projected) = object.project(&camera, &mut storage) else { continue };
        let nothing = Seen([I16F16::ZERO; 3]);
        let mut color = vec![nothing; 96 * 80];
        let mut depth = [0; 96 * 80];
        let mut frame = Frame::new(&mut color, &mut depth, SCREEN).unwrap();
        projected.draw(&mut frame).unwrap();
        let triangles = screen_triangles(&projected, Point::zero(), |_, corner| {
            let (normal, q) = PhongCorrection::parts(&corner.varyings());
            let q = f64::from(q.to_bits()) / 2f64.powi(32);
            let [x, y, z] = normal.map(|c| f64::from(c) * q);
            (q, [x, y, z, q])
        });
        let exact = draw_screen(&triangles, (96, 80), |sample: Sample<4>| {
            let [x, y, z, q] = sample.varyings;
            Some([x, y, z].map(|c| c / q))
        });
        let longest = as_f64.iter().map(|&n| dot(n, n)).fold(0.0, f64::max).sqrt() * 16.0;
        for (index, seen) in color.iter().enumerate() {
            let Some(fragment) = exact.nearest(index % 96, index / 96) else {
                assert_eq!(*seen, nothing);
                continue;
            };
            let exact: Vector = fragment.color;
            if dot(exact, exact).sqrt() < longest / 2.0 {
                continue;
            }
            let got = seen.0.map(|c| f64::from(c.to_bits()));
            let degrees = angle(unit(got), unit(exact)).to_degrees();
            assert!(degrees < 0.5, "{round}: {degrees} at {index}: {got:?} {exact:?}");
            judged += 1;
            worst = f64::max(worst, degrees);
        }
    }
    assert!(judged > 100_000, "{judged}");
    // The bound is of use: steps between divisions are seen.
    assert!(worst > 0.05, "{worst}");
}

/// A body of random facets with normals away from its middle, in two materials.
struct Body {
    positions: Vec<[i16; 3]>,
    normals: Vec<[i8; 3]>,
    triangles: Vec<[u8; 3]>,
    finishes: [Finish; 2],
    materials: [Material; 2],
    scale: Scale,
    offset: Vec3,
}

const ROWS: u8 = 7;
const COLUMNS: u8 = 12;

impl Body {
    fn new(exponents: [u16; 2], radius: f64) -> Self {
        let mut positions = vec![];
        for row in 0..=ROWS {
            for column in 0..COLUMNS {
                let down = std::f64::consts::PI * f64::from(row) / f64::from(ROWS);
                let round = std::f64::consts::TAU * f64::from(column) / f64::from(COLUMNS);
                let p = [down.sin() * round.cos(), down.cos(), down.sin() * round.sin()];
                positions.push(p);
            }
        }
        let mut triangles = vec![];
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let at = |r: u8, c: u8| r * COLUMNS + c % COLUMNS;
                let [a, b] = [at(row, column), at(row, column + 1)];
                let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
        let half = triangles.len() as u32 / 2;
        Self {
            normals: positions.iter().map(|&p| quantised(p)).collect(),
            positions: positions.iter().map(|p| p.map(|c| (c * 4000.0) as i16)).collect(),
            triangles,
            finishes: [
                Finish::MATTE.with_specular([255, 200, 100], exponents[0]),
                Finish::MATTE.with_specular([90, 255, 255], exponents[1]).with_emission([9, 0, 40]),
            ],
            materials: [Material::new([180, 60, 30], half), Material::new([20, 90, 160], half)],
            scale: Scale::new((radius / 4000.0 * 2f64.powi(34)) as u32, -34),
            offset: Vec3::lit("0.125", "-0.25", "0.5"),
        }
    }

    fn mesh(&self) -> Mesh<'_> {
        Mesh::new(Tables {
            positions: Positions::I16(&self.positions),
            scale: self.scale,
            offset: self.offset,
            vertex_normals: Normals::I8(&self.normals),
            triangles: Triangles::U8(&self.triangles),
            materials: &self.materials,
            finishes: &self.finishes,
            ..Tables::EMPTY
        })
        .unwrap()
    }
}

/// Varyings of [`Phong`] with or without positions.
trait Corner {
    /// The normal and the position of 14 bits.
    fn parts(&self) -> [Vector; 2];
}

impl Corner for [i16; 3] {
    fn parts(&self) -> [Vector; 2] {
        [self.map(f64::from), [0.0; 3]]
    }
}

impl Corner for [i16; 6] {
    fn parts(&self) -> [Vector; 2] {
        let [x, y, z, u, v, w] = self.map(f64::from);
        [[x, y, z], [u, v, w]]
    }
}

/// Draws a body and compares. Returns the largest part of its bound that a pixel is off, and the
/// pixels with a highlight.
fn compare<L, W, P, K>(
    body: &Body,
    pose: Pose,
    camera: &Camera<P>,
    shader: Phong<Rgb888, L, W, PhongCorrection, 256>,
    lights: &Lights,
    is_near: bool,
) -> (f64, usize)
where
    L: Lighting,
    W: ViewedFrom,
    P: Projection,
    K: rasterizer::attribute::Components + Corner,
    Phong<Rgb888, L, W, PhongCorrection, 256>:
        Shader<Color = Rgb888, Varyings = PerspectiveCorrect<K, PhongCorrection>>,
    PerspectiveCorrect<K, PhongCorrection>:
        rasterizer::attribute::Varyings<OnScreen = <PhongCorrection as Correction>::OnScreen<K>>,
{
    let mesh = body.mesh();
    let turned = |v: Vector| rotated(&pose.rotation, v);
    let scale = quantum(body.scale);
    let world = |quanta: Vector| {
        let offset = numbers(body.offset);
        let model = [0, 1, 2].map(|i| offset[i] + scale * quanta[i]);
        let turned = turned(model.map(|c| c * pose.scale.to_num::<f64>()));
        let translation = numbers(pose.translation);
        [0, 1, 2].map(|i| turned[i] + translation[i])
    };
    let view = ObjectView::new(&mesh, &pose, camera);
    let viewer = match view.viewer() {
        rasterizer::geometry::Viewer::At(eye) => Viewer::At(numbers(eye)),
        rasterizer::geometry::Viewer::Toward(toward) => {
            Viewer::Toward(toward.map(|c| f64::from(c) / 2f64.powi(30)))
        }
    };
    let far = viewer.direction(world([0.0; 3]));
    let mut storage =
        vec![
            ScreenVertex::<S8, u16, OnScreen<Phong<Rgb888, L, W, PhongCorrection, 256>>>::EMPTY;
            mesh.vertex_count()
        ];
    let object = Object::new(&mesh, shader).posed(pose);
    let projected = object.project(camera, &mut storage).unwrap();
    let half = body.triangles.len() / 2;
    let surface = |sample: &Sample<7>| {
        let q = sample.varyings[6];
        let [x, y, z, u, v, w] = [0, 1, 2, 3, 4, 5].map(|i| sample.varyings[i] / q);
        // Positions of up to 4,000 have 13 bits: two to spare for 14.
        let position = world([u, v, w].map(|c| c / 2.0));
        let normal = unit(turned([x, y, z]));
        let toward = if is_near { viewer.direction(position) } else { far };
        let finish = &body.finishes[usize::from(sample.triangle >= half)];
        let material = &body.materials[usize::from(sample.triangle >= half)];
        let specular = lights.specular(position, normal, toward, f64::from(finish.exponent));
        let finish = reference::Finish {
            diffuse: material.color.map(f64::from),
            specular: finish.specular.map(f64::from),
            exponent: f64::from(finish.exponent),
            emission: finish.emission.map(f64::from),
        };
        (finish, lights.diffuse(position, normal), specular)
    };
    let judged = judge(
        &projected,
        SCREEN,
        |_, stored| {
            let (varyings, q) = PhongCorrection::parts::<K>(&stored);
            let q = f64::from(q.to_bits()) / 2f64.powi(32);
            let [[x, y, z], [u, v, w]] = varyings.parts();
            [x * q, y * q, z * q, u * q, v * q, w * q, q]
        },
        |sample| {
            let (finish, diffuse, specular) = surface(&sample);
            Some(finish.color(diffuse, specular))
        },
    )
    .unwrap();
    let found = judged.deviation();
    assert_eq!(found.coverage_mismatches, 0);
    assert!(found.pixels > 500, "{found:?}");
    let is_bright = |x, y| {
        let fragment = judged.reference.nearest(x, y);
        fragment.is_some_and(|f| f.triangle < half && f.color[0] > 185.0)
    };
    let highlights = (0..80)
        .flat_map(|y| (0..96).map(move |x| (x, y)))
        .filter(|&(x, y)| is_bright(x, y))
        .count();
    // The normal may be off by the tolerance of its correction, three units of 2,032 in each of
    // three coordinates; the level of light by that, and the power by its slope, at most
    // sqrt(n / e) for a radian. Then what the colour's arithmetic adds: 1.5 steps, and what the 15
    // bits of a cosine leave of its power, n / 32 steps.
    let angle = 3f64.sqrt() * 3.0 / 2032.0;
    let levels: f64 = lights.suns.iter().map(|sun| sun.level).sum::<f64>()
        + lights.lamps.iter().map(|lamp| lamp.level).sum::<f64>();
    let exponent =
        body.finishes.iter().map(|finish| f64::from(finish.exponent)).fold(0.0, f64::max);
    let bound = 1.5
        + 255.0 * levels * angle * (1.0 + (exponent / std::f64::consts::E).sqrt())
        + levels * (1.0 + exponent / 32.0);
    (found.color_max_error / bound, highlights)
}

/// The lights of a scene for the reference: the sun of [`SUN`], and a lamp.
const SUN: Light = Light::new(Vec3::lit("1", "2", "2"), Level::lit("0.125"), Level::lit("0.5"));

fn lights(lamp: Option<&Lamp>) -> Lights {
    let sun = Sun { toward: [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0], level: 0.5 };
    let lamps = lamp.map(|lamp| reference::Lamp {
        position: numbers(lamp.position()),
        half: lamp.half().to_num(),
        level: lamp.level().to_num(),
    });
    Lights { ambient: 0.125, suns: vec![sun], lamps: lamps.into_iter().collect() }
}

/// Objects of several sizes, turned and moved; a lamp far away, near, and inside.
#[test]
fn colours_of_pixels_are_those_of_the_definition() {
    let turned = Rotation::about_x(Turn::degrees(25)) * Rotation::about_y(Turn::degrees(70));
    let (mut worst, mut highlights) = (0.0, 0);
    for exponents in [[1, 4], [20, 60], [300, 1000]] {
        for (radius, scale) in [(1.0, "1"), (0.02, "50"), (80.0, "0.0125"), (3.0, "0.5")] {
            let body = Body::new(exponents, radius);
            let scale = Distance::from_num(scale.parse::<f64>().unwrap());
            let pose = Pose::rotated(turned).at(Vec3::lit("0.5", "-0.25", "0")).scaled(scale);
            // Where the middle of the body is.
            let middle = {
                let offset = numbers(body.offset).map(|c| c * scale.to_num::<f64>());
                let rows = turned.rows().map(|row| row.map(|c| c.to_num::<f64>()));
                let at = numbers(pose.translation);
                [0, 1, 2].map(|i| dot(rows[i], offset) + at[i])
            };
            let size = radius * scale.to_num::<f64>();
            let vector = |v: Vector| Vec3::from_bits(v.map(|c| (c * 65_536.0) as i32));
            let beside = |to: Vector, radii: f64| {
                vector([0, 1, 2].map(|i| middle[i] + unit(to)[i] * radii * size))
            };
            let lens = Perspective::new(
                Turn::degrees(50),
                Distance::from_num(size / 2.0),
                Distance::from_num(size * 30.0),
            );
            let eye = beside([0.3, 0.4, 1.0], 3.0);
            let camera =
                |eye| Camera::look_at(eye, vector(middle), Vec3::Y, lens.unwrap(), SCREEN).unwrap();
            let height = Distance::from_num(size * 2.5);
            let flat = Orthographic::new(height, Distance::ONE, Distance::lit("1000")).unwrap();
            let flat = Camera::look_at(
                beside([0.3, 0.4, 1.0], 5.0),
                vector(middle),
                Vec3::Y,
                flat,
                SCREEN,
            );
            let flat = flat.unwrap();
            let mut check = |(part, bright): (f64, usize), what: &str| {
                assert!(part <= 1.0, "{what} {exponents:?} {radius}: {part} of the bound");
                worst = f64::max(worst, part);
                highlights += bright;
            };
            let plain = Phong::new(SUN).with_levels();
            let none = lights(None);
            check(
                compare::<_, _, _, [i16; 3]>(&body, pose, &camera(eye), plain, &none, false),
                "a sun",
            );
            check(
                compare::<_, _, _, [i16; 3]>(&body, pose, &flat, plain, &none, false),
                "parallel",
            );
            let near = plain.with_near_viewer();
            check(
                compare::<_, _, _, [i16; 6]>(&body, pose, &camera(eye), near, &none, true),
                "a near viewer",
            );
            for (place, half) in [(1.3, 0.5), (4.0, 2.0), (1000.0, 800.0), (0.5, 1.0)] {
                let half = Distance::from_num(half * size);
                let lamp = Lamp::new(beside([0.7, 0.2, 0.9], place), half, Level::lit("0.9"));
                let shader = Phong::new((SUN, lamp)).with_levels();
                let all = lights(Some(&lamp));
                let found =
                    compare::<_, _, _, [i16; 6]>(&body, pose, &camera(eye), shader, &all, false);
                check(found, &format!("a lamp at {place} radii"));
                let near = shader.with_near_viewer();
                let found =
                    compare::<_, _, _, [i16; 6]>(&body, pose, &camera(eye), near, &all, true);
                check(found, &format!("a lamp at {place} radii, a near viewer"));
            }
        }
    }
    assert!(highlights > 10_000, "{highlights}");
    // No bound is idle.
    assert!(worst > 0.2, "{worst}");
}
