//! Ready-made shapes against their surfaces in f64: positions, normals, winding, watertightness and
//! texture coordinates.

use std::collections::HashMap;

use rasterizer::{
    mesh::shapes::{Cone, Cube, Cylinder, Icosphere, Plane, Solid, Torus, UvSphere},
    numbers::Scalar,
};

use rasterizer_tests::vector::{Vector, cross, dot, minus, unit};

/// The tables of a shape of any counts.
struct Shape<'a> {
    name: &'a str,
    positions: &'a [[i16; 3]],
    normals: &'a [[i8; 3]],
    texture: &'a [[i16; 2]],
    triangles: &'a [[u16; 3]],
    face_normals: &'a [[i8; 3]],
}

impl<'a, const V: usize, const T: usize> From<(&'a str, &'a Solid<V, T>)> for Shape<'a> {
    fn from((name, solid): (&'a str, &'a Solid<V, T>)) -> Self {
        Self {
            name,
            positions: &solid.positions,
            normals: &solid.vertex_normals,
            texture: &solid.texture_coordinates,
            triangles: &solid.triangles,
            face_normals: &solid.face_normals,
        }
    }
}

/// A static with the tables of a shape.
macro_rules! solid {
    ($name:ident = $shape:expr) => {
        static $name: Solid<{ $shape.vertices() }, { $shape.triangles() }> = $shape.solid();
    };
}

const TUBE: Scalar = Scalar::lit("0.3");

solid!(CUBE = Cube);
solid!(PLANE = Plane::new(5, 3));
solid!(CELL = Plane::new(1, 1));
solid!(SPHERE = UvSphere::new(24, 12));
solid!(OCTAHEDRON = UvSphere::new(4, 2));
solid!(ICOSAHEDRON = Icosphere::new(1));
solid!(HALVES = Icosphere::new(2));
solid!(BALL = Icosphere::new(7));
solid!(RING = Torus::new(24, 12, TUBE));
solid!(TRIANGULAR = Torus::new(3, 3, TUBE));
solid!(CAN = Cylinder::new(20));
solid!(PRISM = Cylinder::new(3));
solid!(HAT = Cone::new(20));
solid!(TETRAHEDRON = Cone::new(3));

fn closed() -> [Shape<'static>; 12] {
    [
        ("cube", &CUBE).into(),
        ("sphere", &SPHERE).into(),
        ("octahedron", &OCTAHEDRON).into(),
        ("icosahedron", &ICOSAHEDRON).into(),
        ("halves", &HALVES).into(),
        ("ball", &BALL).into(),
        ("ring", &RING).into(),
        ("triangular", &TRIANGULAR).into(),
        ("can", &CAN).into(),
        ("prism", &PRISM).into(),
        ("hat", &HAT).into(),
        ("tetrahedron", &TETRAHEDRON).into(),
    ]
}

fn all() -> Vec<Shape<'static>> {
    closed().into_iter().chain([("plane", &PLANE).into(), ("cell", &CELL).into()]).collect()
}

impl Shape<'_> {
    fn position(&self, vertex: u16) -> Vector {
        self.positions[usize::from(vertex)].map(|c| f64::from(c) / 16_384.0)
    }
}

/// Each edge, by the positions of its ends, is a side of two triangles, in both directions.
#[test]
fn closed_shapes_are_watertight() {
    for shape in closed() {
        let mut sides = HashMap::new();
        for triangle in shape.triangles {
            for side in 0..3 {
                let ends = [triangle[side], triangle[(side + 1) % 3]];
                let [a, b] = ends.map(|end| shape.positions[usize::from(end)]);
                assert_ne!(a, b, "{}: a side without a length", shape.name);
                *sides.entry((a, b)).or_insert(0) += 1;
            }
        }
        for (&(a, b), count) in &sides {
            assert_eq!((count, sides.get(&(b, a))), (&1, Some(&1)), "{}: {a:?} {b:?}", shape.name);
        }
    }
}

/// The sum of the tetrahedra below all triangles is positive, and less than the body's volume by
/// what its fineness leaves out.
#[test]
fn front_faces_are_outside() {
    let round = |sectors: f64| sectors / 2.0 * (std::f64::consts::TAU / sectors).sin();
    let icosahedron = 2.536_150_71;
    let volumes = HashMap::from([
        ("cube", 8.0),
        ("octahedron", 4.0 / 3.0),
        ("icosahedron", icosahedron),
        ("can", 2.0 * round(20.0)),
        ("prism", 2.0 * round(3.0)),
        ("hat", 2.0 / 3.0 * round(20.0)),
        ("tetrahedron", 2.0 / 3.0 * round(3.0)),
        // Pappus, for the regular polygons of a ring.
        ("ring", 2.0 * 0.7 * 0.09 * round(12.0) * round(24.0)),
    ]);
    let mut exact = 0;
    for shape in closed() {
        let parts = shape.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| shape.position(vertex));
            dot(a, cross(b, c)) / 6.0
        });
        let volume: f64 = parts.sum();
        assert!(volume > 0.0, "{}: {volume}", shape.name);
        if let Some(want) = volumes.get(shape.name) {
            assert!((volume / want - 1.0).abs() < 1e-3, "{}: {volume} {want}", shape.name);
            exact += 1;
        }
        // The balls are between the icosahedron and the sphere.
        let sphere = 4.0 / 3.0 * std::f64::consts::PI;
        let least = HashMap::from([("sphere", 0.95), ("halves", 0.85), ("ball", 0.985)]);
        if let Some(part) = least.get(shape.name) {
            assert!((part * sphere..sphere).contains(&volume), "{}: {volume}", shape.name);
            exact += 1;
        }
    }
    assert_eq!(exact, 11);
}

#[test]
fn normals_of_faces_are_those_of_their_corners() {
    for shape in all() {
        for (triangle, normal) in shape.triangles.iter().zip(shape.face_normals) {
            let [a, b, c] = triangle.map(|vertex| shape.position(vertex));
            let want = unit(cross(minus(b, a), minus(c, a)));
            for (got, want) in normal.iter().zip(want) {
                assert!((f64::from(*got) - 127.0 * want).abs() < 0.51, "{}", shape.name);
            }
            for corner in triangle {
                let normal = shape.normals[usize::from(*corner)].map(f64::from);
                assert!(dot(normal, want) > 20.0, "{}: a vertex looks inwards", shape.name);
            }
        }
    }
}

/// The distance of a point from a surface, and the surface's normal there.
fn surface(name: &str, p: Vector) -> (f64, Vector) {
    let radius = p[0].hypot(p[2]);
    match name {
        "ring" | "triangular" => {
            let out = radius - 0.7;
            let to_tube = [p[0] / radius * out, p[1], p[2] / radius * out];
            (out.hypot(p[1]) - 0.3, unit(to_tube))
        }
        _ => (dot(p, p).sqrt() - 1.0, unit(p)),
    }
}

#[test]
fn vertices_lie_on_their_surfaces_with_their_normals() {
    let curved = ["sphere", "octahedron", "icosahedron", "halves", "ball", "ring", "triangular"];
    let mut found = 0;
    for shape in closed().iter().filter(|shape| curved.contains(&shape.name)) {
        for vertex in 0..shape.positions.len() {
            let p = shape.position(vertex as u16);
            let (distance, normal) = surface(shape.name, p);
            // Half a 2^14th along each axis.
            assert!(distance.abs() < 2f64.powi(-14), "{}: {p:?} {distance}", shape.name);
            for (got, want) in shape.normals[vertex].iter().zip(normal) {
                // The position's own rounding turns the normal of a tube by up to a 5,000th.
                assert!((f64::from(*got) - 127.0 * want).abs() < 0.55, "{}: {p:?}", shape.name);
            }
        }
        found += 1;
    }
    assert_eq!(found, curved.len());
}

/// The side of a cylinder and of a cone, their ends, and a cube's sides.
#[test]
fn vertices_of_edged_shapes_have_the_normals_of_their_sides() {
    let root = 5f64.sqrt();
    for shape in closed() {
        for (vertex, normal) in shape.normals.iter().enumerate() {
            let p = shape.position(vertex as u16);
            let n = normal.map(|c| f64::from(c) / 127.0);
            let radius = p[0].hypot(p[2]);
            let is_level = n[1].abs() > 0.999;
            let (want, place) = match shape.name {
                "can" | "prism" if is_level => ([0.0, p[1], 0.0], p[1].abs()),
                "can" | "prism" => ([p[0], 0.0, p[2]], radius),
                "hat" | "tetrahedron" if is_level => ([0.0, -1.0, 0.0], -p[1]),
                // At the point, where the direction is that of the sector.
                "hat" | "tetrahedron" if p[1] > 0.0 => {
                    let across = n[0].hypot(n[2]);
                    ([n[0] / across * 2.0 / root, 1.0 / root, n[2] / across * 2.0 / root], p[1])
                }
                "hat" | "tetrahedron" => {
                    ([p[0] * 2.0 / root, 1.0 / root, p[2] * 2.0 / root], -p[1])
                }
                "cube" => (n, dot(n, p)),
                _ => continue,
            };
            assert!((place - 1.0).abs() < 2f64.powi(-13), "{}: {p:?}", shape.name);
            assert!(
                (0..3).all(|i| (n[i] - want[i]).abs() < 0.6 / 127.0),
                "{}: {n:?} {want:?}",
                shape.name
            );
        }
    }
}

/// A texture is on each triangle as on a wall: u runs to the right and v downwards, seen from
/// outside. All of it is inside the texture.
#[test]
fn textures_are_not_mirrored() {
    for shape in all() {
        let is_without = ["icosahedron", "halves", "ball"].contains(&shape.name);
        for triangle in shape.triangles {
            let [a, b, c] = triangle.map(|vertex| shape.texture[usize::from(vertex)]);
            assert!([a, b, c].as_flattened().iter().all(|c| (0..=1 << 14).contains(c)));
            let [u, v] = [b, c].map(|p| [0, 1].map(|i| i32::from(p[i]) - i32::from(a[i])));
            let area = u[0] * v[1] - u[1] * v[0];
            // Counter-clockwise, with v downwards.
            let is_right = if is_without { area == 0 } else { area < 0 };
            assert!(is_right, "{}: {a:?} {b:?} {c:?}", shape.name);
        }
    }
}

/// Longitude and latitude of a sphere's vertices, by the arctangent.
#[test]
fn textures_go_round_a_sphere_once() {
    let mut judged = 0;
    for (p, texture) in SPHERE.positions.iter().zip(SPHERE.texture_coordinates) {
        let [x, y, z] = p.map(|c| f64::from(c) / 16_384.0);
        let [u, v] = texture.map(|c| f64::from(c) / 16_384.0);
        if y.abs() < 0.99 {
            let longitude = x.atan2(z) / std::f64::consts::TAU;
            let apart = u - longitude;
            assert!((apart - apart.round()).abs() < 1e-3, "{u} {longitude}");
            assert!((v - y.acos() / std::f64::consts::PI).abs() < 1e-3, "{v} {y}");
            judged += 1;
        }
    }
    assert!(judged > 200, "{judged}");
}
