//! A wooden crate: six sides of a frame round a panel that lies deeper, all with one picture.

use super::{
    surface::{Point, Surface},
    wood,
};

/// How far a panel lies below its frame.
const DEPTH: f64 = 0.1;

/// The width of the frame in pixels of the picture.
const FRAME: f64 = wood::FRAME as f64;

/// What the walls between frame and panel show of the picture, in pixels.
const WALL: f64 = 2.0;

/// Outwards, to the right and up, on each side.
const SIDES: [[Point; 3]; 6] = [
    [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]],
    [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]],
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
];

/// The corners of a square, counter-clockwise from the lower left.
const SQUARE: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

pub(super) fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mut surface =
        Surface::new("A wooden crate. Its picture is on each side.", "wooden_crate.mtl");
    let corner = |index: usize| [0, 1, 2].map(|axis| [-1.0, 1.0][index >> axis & 1]);
    let corners: Vec<usize> = (0..8).map(|index| surface.point(corner(index))).collect();
    let side = f64::from(wood::SIDE);
    let textures = [0.0, FRAME, FRAME + WALL].map(|margin| {
        SQUARE.map(|corner| surface.texture(corner.map(|c| 0.5 + c * (0.5 - margin / side))))
    });
    surface.material("wood");
    for [out, right, up] in SIDES {
        let place = |height: f64, [x, y]: [f64; 2]| -> Point {
            [0, 1, 2].map(|axis| out[axis] * height + right[axis] * x + up[axis] * y)
        };
        let inner = SQUARE.map(|corner| corner.map(|c| c * (1.0 - 2.0 * FRAME / side)));
        let outer = SQUARE.map(|c| {
            let [x, y, z] = place(1.0, c).map(|c| usize::from(c > 0.0));
            corners[x + 2 * y + 4 * z]
        });
        let edge = inner.map(|corner| surface.point(place(1.0, corner)));
        let panel = inner.map(|corner| surface.point(place(1.0 - DEPTH, corner)));
        let rings = [outer, edge, panel];
        for ring in 0..2 {
            for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
                let corners = [(ring, i), (ring, j), (ring + 1, j), (ring + 1, i)];
                surface.textured_face(corners.map(|(ring, i)| (rings[ring][i], textures[ring][i])));
            }
        }
        surface.textured_face([0, 1, 2, 3].map(|i| (panel[i], textures[2][i])));
    }
    // Without a `Kd`, programs that multiply it show the picture as it is, and others its mean.
    let library = "newmtl wood\nmap_Kd wooden_crate.png\n";
    vec![
        ("wooden_crate.obj", surface.into_text().into_bytes()),
        ("wooden_crate.mtl", library.into()),
        ("wooden_crate.png", wood::png()),
    ]
}
