//! Vertices of objects in other numbers: how many quanta they use, how far their offset lies, how
//! near they come to the eye of how long a lens.
//!
//! `cargo test --package rasterizer-tests placement_table -- --nocapture` prints the table: for
//! each precision how far the worst of 10,000 vertices is from its exact place, in sub-pixels.
//! It must be at most 5/8: half for snapping, an eighth for arithmetic.

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    camera::{Camera, Distance, Perspective},
    geometry::Pose,
    numbers::{Rotation, S4, S8, Scale, Subpixel, Turn, Vec3},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Placed, Random, Surface, area,
    ends::Stage,
    exact::{Lens, judge, numbers, quantum},
};

const HEIGHT: u32 = 240;

/// An object two units wide, of a number of quanta, seen by a lens.
struct Case {
    name: String,
    quanta: i16,
    offset: f64,
    /// The focal length in pixels, if there is no field of view.
    focal: f64,
    field: Option<Turn>,
    near: f64,
    /// The least and the largest distance along the axis of the vertices that are judged.
    depths: [f64; 2],
    /// Which of S4 and S8 have the range for it.
    is_accepted: [bool; 2],
}

/// The worst of vertices that lie on the screen, or `None` if the object is refused.
fn worst<S: Subpixel>(case: &Case) -> Option<f64> {
    let mut random = Random::new(99);
    let mut worst = None::<f64>;
    for _ in 0..50 {
        let mut angle = || Turn::from_bits(random.bits() as u32);
        let turn = Rotation::about_x(angle()) * Rotation::about_y(angle());
        let view = Rotation::about_z(angle()) * Rotation::about_x(angle());
        let (near, far) = (Distance::from_num(case.near), Distance::from_num(60_000));
        let (lens, focal) = match case.field {
            Some(field) => {
                let half = f64::from(field.to_bits()) / 2f64.powi(33) * std::f64::consts::TAU;
                let focal = f64::from(HEIGHT) / 2.0 / half.tan();
                (Perspective::new(field, near, far), focal)
            }
            None => {
                let focal = Distance::from_num(case.focal);
                (Perspective::with_focal_length(focal, near, far), focal.to_num())
            }
        };
        let lens = lens.unwrap();
        // The eye is a random way in front of a point of the object.
        let [least, most] = case.depths;
        let away = least + (most - least) * f64::from(random.within(0, 1000)) / 1000.0;
        let coordinate = |random: &mut Random| {
            random.within(-i32::from(case.quanta), i32::from(case.quanta)) as i16
        };
        let target = [(); 3].map(|()| coordinate(&mut random));
        let scale = Scale::new((2f64.powi(40) / f64::from(case.quanta)) as u32, -40);
        let quantum = quantum(scale);
        let rows = turn.rows().map(|row| row.map(|c| c.to_num::<f64>()));
        let back = view.rows().map(|row| row[2].to_num::<f64>());
        let offset = [case.offset, -case.offset / 2.0, 0.0];
        let at = target.map(|c| f64::from(c) * quantum);
        let eye: [f64; 3] =
            [0, 1, 2].map(|i| (0..3).map(|k| rows[i][k] * at[k]).sum::<f64>() + back[i] * away);
        let bits = |v: [f64; 3]| Vec3::from_bits(v.map(|c| (c * 65_536.0).round() as i32));
        // Points at these depths on the screen: near the point, within what the screen shows.
        let mut positions = vec![target];
        let reach = most.min(2.0) / quantum;
        for _ in 0..200 {
            let limit = f64::from(case.quanta);
            positions.push(target.map(|c| {
                let way = f64::from(random.within(-1000, 1000)) / 1000.0 * reach;
                (f64::from(c) + way).clamp(-limit, limit) as i16
            }));
        }
        // The whole object counts.
        positions.push([case.quanta; 3]);
        positions.push([-case.quanta; 3]);
        let mut surface = Surface::new(positions, vec![[0, 1, 2]]);
        surface.scale = scale;
        surface.offset = bits(offset);
        let offset = numbers(surface.offset);
        // The pose moves the object back by its offset.
        let moved = [0, 1, 2].map(|i| -(0..3).map(|k| rows[i][k] * offset[k]).sum::<f64>());
        let pose = Pose::rotated(turn).at(bits(moved));
        let stage = Stage { surface, pose, eye: bits(eye), rotation: view };
        let camera = Camera::at(stage.eye, view, lens, area(0, 0, 320, HEIGHT)).unwrap();
        let mesh = stage.surface.mesh();
        let mut storage = vec![Placed::<S>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).posed(stage.pose);
        if object.project(&camera, &mut storage).is_err() {
            return None;
        }
        let exact = Lens::perspective(&lens, focal);
        let judged = judge::<S, _>(&stage, camera, &exact);
        worst = Some(worst.unwrap_or(0.0).max(judged.worst));
    }
    worst
}

#[test]
fn vertices_land_in_place_in_all_numbers() {
    let base = || Case {
        name: String::new(),
        quanta: 32_767,
        offset: 0.0,
        focal: 300.0,
        field: None,
        near: 0.1,
        depths: [3.0, 3.0],
        is_accepted: [true; 2],
    };
    let mut cases = Vec::new();
    for quanta in [32_767, 1024, 64, 1] {
        cases.push(Case { name: format!("±{quanta} quanta, 3 away"), quanta, ..base() });
    }
    for quanta in [32_767, 1024, 64, 1] {
        let name = format!("±{quanta} quanta, near 0.02, 0.02 to 0.1 away");
        cases.push(Case { name, quanta, near: 0.02, depths: [0.02, 0.1], ..base() });
    }
    for offset in [0, 1000, 10_000, 28_000] {
        let name = format!("offset {offset}, moved back by the pose");
        cases.push(Case { name, offset: f64::from(offset), ..base() });
    }
    for focal in [300, 1000, 3000, 10_000, 60_000] {
        let name = format!("focal length {focal} px, near 0.02, 0.02 to 0.1 away");
        let is_accepted = [focal <= 3000, focal <= 10_000];
        let case = Case { name, focal: f64::from(focal), near: 0.02, ..base() };
        cases.push(Case { depths: [0.02, 0.1], is_accepted, ..case });
    }
    for (field, away) in
        [(0.01f64, 15_000.0), (0.1, 1500.0), (1.0, 200.0), (120.0, 3.0), (179.9, 3.0)]
    {
        let name = format!("field of view of {field} degrees, {away} away");
        let field = Some(Turn::from_bits((field / 360.0 * 2f64.powi(32)) as u32));
        cases.push(Case { name, field, depths: [away, away], ..base() });
    }
    for ratio in [4, 100, 1000, 10_000, 100_000] {
        let near = 2.0 / f64::from(ratio);
        let name = format!("size / near = {ratio}");
        let is_accepted = [ratio <= 100, true];
        cases.push(Case { name, near, depths: [near, 5.0 * near], is_accepted, ..base() });
    }
    println!("{:52} {:>8} {:>8}", "Two units wide; focal length 300 px, near 0.1", "S4", "S8");
    let mut faults = Vec::new();
    for case in &cases {
        let found = [worst::<S4>(case), worst::<S8>(case)];
        let text = found.map(|worst| worst.map_or("refused".into(), |worst| format!("{worst:.3}")));
        println!("{:52} {:>8} {:>8}", case.name, text[0], text[1]);
        if found.map(|worst| worst.is_some()) != case.is_accepted {
            faults.push(&case.name);
        }
    }
    assert!(faults.is_empty(), "accepted or refused against expectation: {faults:?}");
}
