//! The same object in other numbers gives the same picture, bit for bit where the numbers are equal
//! in exact arithmetic: every pixel, and its 32-bit depth.

use embedded_graphics::{geometry::Point, pixelcolor::Rgb888, primitives::Rectangle};
use rasterizer::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{CullBack, CullFront, CullNone, Culling, Pose, Projection, ScreenVertex},
    numbers::{Rotation, S4, S8, Scale, Subpixel, Turn, Vec3},
    output::Frame,
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{Picture, Random, Surface, area};

const VIEWPORT: Rectangle = area(3, -2, 64, 48);
const BACKGROUND: Rgb888 = Rgb888::new(1, 2, 3);

/// An object before a camera.
#[derive(Clone)]
struct Shot<P> {
    positions: Vec<[i16; 3]>,
    triangles: Vec<[u16; 3]>,
    scale: Scale,
    offset: Vec3,
    pose: Pose,
    eye: Vec3,
    view: Rotation,
    lens: P,
    viewport: Rectangle,
}

impl<P: Projection> Shot<P> {
    /// A dozen points within 2 units of the origin along each axis, seen from 0.5 to 8 units away.
    fn random(random: &mut Random, lens: P) -> Self {
        let mut angle = || Turn::from_bits(random.bits() as u32);
        let rotation = Rotation::about_x(angle()) * Rotation::about_y(angle());
        let view = Rotation::about_z(angle()) * Rotation::about_x(angle());
        let mut coordinate = || random.within(-1000, 1000) as i16;
        let positions = (0..12).map(|_| [coordinate(), coordinate(), coordinate()]).collect();
        let mut corner = || random.within(0, 11) as u16;
        let triangles = (0..8).map(|_| [corner(), corner(), corner()]).collect();
        let back = view.apply(Vec3::from_bits([0, 0, random.within(1 << 15, 1 << 19)]));
        let mut place = || Vec3::from_bits([(); 3].map(|()| random.within(-(1 << 20), 1 << 20)));
        let pose = Pose::rotated(rotation).at(place());
        let eye = pose.translation + back;
        let (scale, offset) = (Scale::new(1, -9), Vec3::ZERO);
        Self { positions, triangles, scale, offset, pose, eye, view, lens, viewport: VIEWPORT }
    }

    /// Its picture in a frame as large as the viewport.
    fn drawn<S: Subpixel, K: Culling>(&self, culling: K) -> Picture<Rgb888, u32> {
        let mut surface = Surface::new(self.positions.clone(), self.triangles.clone());
        (surface.scale, surface.offset) = (self.scale, self.offset);
        let mesh = surface.mesh();
        let camera = Camera::at(self.eye, self.view, self.lens, self.viewport).unwrap();
        let mut picture = Picture::empty(self.viewport, BACKGROUND);
        let mut frame = Frame::new(&mut picture.color, &mut picture.depth, self.viewport).unwrap();
        let mut storage = vec![ScreenVertex::<S, u32, _>::EMPTY; mesh.vertex_count()];
        let object = Object::new(&mesh, Unlit::new()).posed(self.pose).culled(culling);
        assert_eq!(object.draw(&camera, &mut storage, &mut frame), Ok(()));
        picture
    }
}

/// Draws random objects and what `changed` makes of them: both must be equal. It gets a number that
/// counts the objects.
fn same<S: Subpixel, P: Projection>(lens: P, changed: impl Fn(&Shot<P>, usize) -> Shot<P>) {
    let mut random = Random::new(0x0B1E_C715);
    let mut covered = 0;
    for count in 0..300 {
        let shot = Shot::random(&mut random, lens);
        let (before, after) =
            (shot.drawn::<S, _>(CullNone), changed(&shot, count).drawn::<S, _>(CullNone));
        covered += before.depth.iter().filter(|&&depth| depth != 0).count();
        assert!(before.color == after.color, "object {count}: other pixels");
        assert!(before.depth == after.depth, "object {count}: other depths");
    }
    assert!(covered > 50_000, "only {covered} pixels");
}

fn perspective() -> Perspective {
    Perspective::new(Turn::degrees(60), Distance::lit("0.25"), Distance::lit("50")).unwrap()
}

fn orthographic() -> Orthographic {
    Orthographic::new(Distance::lit("3"), Distance::lit("0.25"), Distance::lit("50")).unwrap()
}

/// [`same`] for both precisions and both projections.
macro_rules! always_same {
    ($changed:expr) => {
        same::<S4, _>(perspective(), $changed);
        same::<S8, _>(perspective(), $changed);
        same::<S4, _>(orthographic(), $changed);
        same::<S8, _>(orthographic(), $changed);
    };
}

/// A quarter turn about one of the axes: exact in Q30.
fn quarter(count: usize) -> Rotation {
    match count % 3 {
        0 => Rotation::about_x(Turn::QUARTER),
        1 => Rotation::about_y(-Turn::QUARTER),
        _ => Rotation::about_z(Turn::QUARTER) * Rotation::about_x(Turn::QUARTER),
    }
}

#[test]
fn larger_positions_of_smaller_quanta() {
    always_same!(|shot, count| {
        let bits = 1 + count as i32 % 5;
        let positions = shot.positions.iter().map(|p| p.map(|c| c << bits)).collect();
        Shot { positions, scale: Scale::new(1, -9 - bits), ..shot.clone() }
    });
}

#[test]
fn scale_of_the_pose_or_of_the_mesh() {
    always_same!(|shot, count| {
        let bits = count as i32 % 8;
        let pose = shot.pose.scaled(Distance::from_bits(1 << (16 + bits)));
        Shot { pose, scale: Scale::new(1, -9 - bits), ..shot.clone() }
    });
}

/// Where the mesh's axes are the world's, or exchanged.
#[test]
fn offset_of_the_mesh_or_of_the_pose() {
    let offset = Vec3::lit("1.5", "-100.25", "7");
    let upright = |shot: &Shot<_>, count: usize| Shot {
        pose: Pose::rotated(quarter(count)).at(shot.pose.translation),
        ..shot.clone()
    };
    let mut random = Random::new(5);
    for count in 0..300 {
        let shot = upright(&Shot::random(&mut random, perspective()), count);
        let translation = shot.pose.translation - quarter(count).apply(offset);
        let moved = Shot { offset, pose: shot.pose.at(translation), ..shot.clone() };
        assert!(shot.drawn::<S4, _>(CullNone) == moved.drawn::<S4, _>(CullNone), "{count}");
        assert!(shot.drawn::<S8, _>(CullNone) == moved.drawn::<S8, _>(CullNone), "{count}");
    }
}

#[test]
fn object_and_camera_moved_together() {
    let way = Vec3::lit("-77.125", "1000", "0.0625");
    always_same!(|shot, _| Shot {
        pose: shot.pose.at(shot.pose.translation + way),
        eye: shot.eye + way,
        ..shot.clone()
    });
}

#[test]
fn object_and_camera_turned_together() {
    always_same!(|shot, count| {
        let turn = quarter(count);
        let pose = Pose::rotated(turn * shot.pose.rotation).at(turn * shot.pose.translation);
        Shot { pose, eye: turn * shot.eye, view: turn * shot.view, ..shot.clone() }
    });
}

#[test]
fn viewport_moved_by_whole_pixels() {
    always_same!(|shot, count| {
        let way = Point::new(17 * count as i32 % 900, -13 * count as i32 % 700);
        Shot { viewport: Rectangle::new(VIEWPORT.top_left + way, VIEWPORT.size), ..shot.clone() }
    });
}

/// Whether two pictures of a shot are the same but for the order of corners: the same pixels, and
/// where no triangle is cut, depths that differ by two units at most, as each is within one unit of
/// the exact plane. A polygon that remains of a cut triangle is split from another corner; its
/// corners are snapped to sub-pixels, so that it has no plane of its own.
fn is_like<P>(shot: &Shot<P>, a: &Picture<Rgb888, u32>, b: &Picture<Rgb888, u32>) -> bool {
    let way = shot.eye - shot.pose.translation;
    // All of an object lies within 3.5 units of its origin.
    let is_cut = way.length() < 4;
    let is_near = |(a, b): (&u32, &u32)| is_cut || a.abs_diff(*b) <= 2;
    a.color == b.color && a.depth.iter().zip(&b.depth).all(is_near)
}

#[test]
fn corners_in_another_order() {
    let mut random = Random::new(6);
    for count in 0..300 {
        let shot = Shot::random(&mut random, perspective());
        let rotated = |&[a, b, c]: &[u16; 3]| if count % 2 == 0 { [b, c, a] } else { [c, a, b] };
        let triangles = shot.triangles.iter().map(rotated).collect();
        let rotated = Shot { triangles, ..shot.clone() };
        let [a, b] = [&shot, &rotated].map(|shot| shot.drawn::<S4, _>(CullNone));
        assert!(is_like(&shot, &a, &b), "{count}");
        let [a, b] = [&shot, &rotated].map(|shot| shot.drawn::<S8, _>(CullNone));
        assert!(is_like(&shot, &a, &b), "{count}");
    }
}

/// The front faces of an object are the back faces of the one with the other winding.
#[test]
fn winding_and_culling_exchanged() {
    let mut random = Random::new(6);
    for count in 0..300 {
        let shot = Shot::random(&mut random, perspective());
        let triangles = shot.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let reversed = Shot { triangles, ..shot.clone() };
        let (a, b) = (shot.drawn::<S4, _>(CullBack), reversed.drawn::<S4, _>(CullFront));
        assert!(is_like(&shot, &a, &b), "{count}");
        let (a, b) = (shot.drawn::<S8, _>(CullFront), reversed.drawn::<S8, _>(CullBack));
        assert!(is_like(&shot, &a, &b), "{count}");
    }
}

/// The frame's upper and lower parts, drawn alone.
#[test]
fn rows_drawn_in_parts() {
    let mut random = Random::new(7);
    for count in 0..100 {
        let shot = Shot::random(&mut random, perspective());
        let whole = shot.drawn::<S8, _>(CullNone);
        let mut surface = Surface::new(shot.positions.clone(), shot.triangles.clone());
        surface.scale = shot.scale;
        let mesh = surface.mesh();
        let camera = Camera::at(shot.eye, shot.view, shot.lens, VIEWPORT).unwrap();
        let rows = random.within(1, 47);
        for (top, height) in [(0, rows), (rows, 48 - rows)] {
            let part = area(3, -2 + top, 64, height as u32);
            let mut picture = Picture::<_, u32>::empty(part, BACKGROUND);
            let mut frame = Frame::new(&mut picture.color, &mut picture.depth, part).unwrap();
            let mut storage = vec![ScreenVertex::<S8, u32, _>::EMPTY; mesh.vertex_count()];
            let object = Object::new(&mesh, Unlit::new()).posed(shot.pose).culled(CullNone);
            assert_eq!(object.draw(&camera, &mut storage, &mut frame), Ok(()));
            assert!(picture == whole.crop(part, BACKGROUND), "object {count}, rows {top}");
        }
    }
}
