//! How the cost of a frame grows with the number of triangles, and with the number of pixels.

use rasterizer::{
    camera::Camera,
    geometry::{Pose, ScreenVertex},
    mesh::Mesh,
    numbers::{Rotation, S4, S8, Subpixel, Turn},
    output::Rgb565Be,
    scene::Object,
    shade::Gouraud,
};

use crate::{
    console,
    cost::Cost,
    counter,
    memory::Memory,
    models,
    stage::{PIXELS, pose, sun, view},
    surface::Surface,
};

/// Vertices of the largest surface.
pub const VERTICES: usize = 50_625;
/// Triangles of the largest surface.
pub const TRIANGLES: usize = 100_352;

/// Each frame covers other pixels along the same edges; four smooth a curve as well as eight.
const FRAMES: u32 = 4;

/// Parallels and meridians of spheres with 100 to 100,000 triangles, about twice as many from each
/// to the next.
const SPHERES: [(u16, u16); 11] = [
    (5, 10),
    (7, 14),
    (10, 20),
    (14, 28),
    (20, 40),
    (28, 56),
    (40, 80),
    (56, 112),
    (80, 160),
    (112, 224),
    (158, 316),
];
/// Cells along a side of squares with 98 to 100,352 triangles.
const SQUARES: [u16; 11] = [7, 10, 14, 20, 28, 40, 56, 79, 112, 158, 224];
/// How many pixels wide a sphere of radius 1 is that lies at distance 2.4, and the focal length in
/// pixels that makes it so: width x sqrt(2.4<sup>2</sup> - 1) / 2. From each to the next it covers
/// twice as many pixels; beyond the width of the display only part of it is seen, and beyond 1,728
/// pixels it reaches out of the guard band and is clipped.
const WIDTHS: [(usize, &str); 18] = [
    (8, "8.727"),
    (11, "12.342"),
    (16, "17.454"),
    (23, "24.684"),
    (32, "34.908"),
    (45, "49.367"),
    (64, "69.816"),
    (91, "98.734"),
    (128, "139.63"),
    (181, "197.47"),
    (256, "279.26"),
    (362, "394.94"),
    (512, "558.53"),
    (724, "789.88"),
    (1024, "1117.1"),
    (1448, "1579.8"),
    (2048, "2234.2"),
    (2896, "3159.6"),
];

/// Measures all curves and prints a line for each of their points.
pub fn run(memory: &mut Memory<PIXELS>, surface: &mut Surface<VERTICES, TRIANGLES>) {
    for (parallels, meridians) in SPHERES {
        surface.sphere(parallels, meridians);
        let mesh = surface.mesh();
        point("sphere-triangles", mesh.triangle_count(), &mesh, "240", pose, memory);
    }
    for cells in SQUARES {
        surface.square(cells);
        let mesh = surface.mesh();
        point(
            "square-triangles",
            mesh.triangle_count(),
            &mesh,
            "200",
            |frame| Pose::rotated(about_z(frame)),
            memory,
        );
    }
    surface.sphere(14, 28);
    let ball = surface.mesh();
    for (curve, mesh) in [("cube-widths", &models::CUBE), ("sphere-widths", &ball)] {
        for (width, focal_length) in WIDTHS {
            point(curve, width, mesh, focal_length, pose, memory);
        }
    }
}

fn about_z(frame: u32) -> Rotation {
    Rotation::about_z(Turn::fraction(64 * frame + 20, 512))
}

/// Measures a point of a curve in both precisions.
fn point(
    curve: &str,
    at: usize,
    mesh: &Mesh<'_>,
    focal_length: &str,
    pose: impl Fn(u32) -> Pose,
    memory: &mut Memory<PIXELS>,
) {
    let object = |frame| Object::new(mesh, Gouraud::new(sun())).posed(pose(frame));
    let camera = view(focal_length, "2.4");
    let coarse = measure::<S4>(object, &camera, memory);
    let fine = measure::<S8>(object, &camera, memory);
    for (precision, cost) in [("S4", coarse), ("S8", fine)] {
        console::line(format_args!(
            r#"{{"curve":"{curve}","at":{at},"precision":"{precision}",{cost}}}"#
        ));
    }
}

fn measure<'a, S: Subpixel>(
    object: impl Fn(u32) -> Object<'a, Gouraud<Rgb565Be>>,
    camera: &Camera,
    memory: &mut Memory<PIXELS>,
) -> Cost<false> {
    #[expect(
        clippy::large_stack_arrays,
        reason = "the boards have 4 MB, and half of it is left for the stack"
    )]
    let mut vertices = [ScreenVertex::<S, u16, [u16; 1]>::EMPTY; VERTICES];
    let mut cost = Cost::default();
    for frame in 0..FRAMES {
        let rows = camera.viewport().size.height;
        cost.add(&object(frame), camera, rows, &mut vertices, None, memory);
    }
    counter::report();
    cost
}
