//! A robot arm of six links whose joints turn a little in each frame, against f64.

use rasterizer::{
    geometry::Pose,
    numbers::{Rotation, Turn, Vec3},
};
use rasterizer_tests::exact::numbers;

type Matrix = [[f64; 3]; 3];

/// Of a joint, in a turn's 2^32ths a frame: fast and slow, forwards and backwards.
const STEPS: [u32; 6] =
    [0x0012_3457, 0x0345_6789, 0x1234_5679, 0xFFFF_0F01, 0x0000_0101, 0x8765_4321];
const FRAMES: u32 = 1_000_000;
const LINK: Vec3 = Vec3::lit("0", "0.8", "0");

fn f64s(rotation: &Rotation) -> Matrix {
    rotation.rows().map(|row| row.map(|c| c.to_num::<f64>()))
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn skew(rotation: &Rotation) -> f64 {
    let rows = f64s(rotation);
    let columns = [0, 1, 2].map(|i| rows.map(|row| row[i]));
    let square = product(&rows, &columns);
    let off = |i: usize, j: usize| (square[i][j] - f64::from(u8::from(i == j))).abs();
    (0..9).map(|entry| off(entry / 3, entry % 3)).fold(0.0, f64::max)
}

/// About the axis of a joint, by an angle in f64: x and z in turn.
fn about(joint: usize, radians: f64) -> Matrix {
    let (sin, cos) = radians.sin_cos();
    if joint.is_multiple_of(2) {
        [[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]]
    } else {
        [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]
    }
}

fn turned(joint: usize, angle: Turn) -> Rotation {
    if joint.is_multiple_of(2) { Rotation::about_x(angle) } else { Rotation::about_z(angle) }
}

/// The arm's poses from its joints.
fn links(joints: &[Rotation; 6]) -> [Pose; 6] {
    let mut pose = Pose::IDENTITY;
    joints.map(|joint| {
        pose = pose.compose(Pose::rotated(joint).at(LINK));
        pose
    })
}

/// The direction and the place of the hand, for the joints' exact angles after a number of frames.
fn exact(frames: u32) -> (Matrix, [f64; 3]) {
    let mut rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut place = [0.0; 3];
    for (joint, step) in STEPS.into_iter().enumerate() {
        for (axis, row) in rotation.iter().enumerate() {
            place[axis] += row.iter().zip(numbers(LINK)).map(|(a, b)| a * b).sum::<f64>();
        }
        let angle = f64::from(step.wrapping_mul(frames)) / 2f64.powi(32) * std::f64::consts::TAU;
        rotation = product(&rotation, &about(joint, angle));
    }
    (rotation, place)
}

/// How far the hand's direction is from the exact one, in radians, and its place, in units.
fn error(hand: &Pose, frames: u32) -> [f64; 2] {
    let (rotation, place) = exact(frames);
    let got = f64s(&hand.rotation);
    let apart =
        got.as_flattened().iter().zip(rotation.as_flattened()).map(|(a, b)| (a - b).powi(2));
    // A rotation by a small angle moves the three axes by the root of 2 times it, together.
    let radians = (apart.sum::<f64>() / 2.0).sqrt();
    let way = numbers(hand.translation).into_iter().zip(place).map(|(a, b)| (a - b).powi(2));
    [radians, way.sum::<f64>().sqrt()]
}

/// Each composition turns a joint by up to 2^-29 radians, and the sine and the cosine of its step
/// by up to 2^-28: a million of them by 0.0056, six joints by 0.034. In tests it is a tenth.
#[test]
fn a_million_frames_leave_the_links_orthonormal_and_their_directions_near() {
    let steps: [Rotation; 6] =
        std::array::from_fn(|joint| turned(joint, Turn::from_bits(STEPS[joint])));
    let mut joints = [Pose::IDENTITY; 6];
    let mut worst = [0f64; 2];
    for frame in 1..=FRAMES {
        for (joint, step) in joints.iter_mut().zip(steps) {
            *joint = Pose::rotated(step).compose(*joint);
        }
        if frame % 1000 == 0 {
            let poses = links(&joints.map(|joint| joint.rotation));
            for pose in &poses {
                assert!(skew(&pose.rotation) < 2f64.powi(-26), "{frame}: {pose:?}");
            }
            let error = error(&poses[5], frame);
            worst = [0, 1].map(|i| worst[i].max(error[i]));
        }
    }
    println!("after {FRAMES} frames: {} radians, {} units", worst[0], worst[1]);
    assert!(worst[0] < 0.034 / 10.0, "{worst:?}");
    // Five links of 0.8 units.
    assert!(worst[1] < 0.034 / 10.0 * 4.0, "{worst:?}");
    assert!(worst[0] > 1e-6, "the error grows: {worst:?}");
}

/// Joints that keep their angles do not drift: six compositions and sines are all that the hand is
/// off by.
#[test]
fn joints_with_angles_do_not_drift() {
    let mut worst = [0f64; 2];
    for frame in (0..FRAMES).step_by(997) {
        let joints = std::array::from_fn(|joint| {
            turned(joint, Turn::from_bits(STEPS[joint].wrapping_mul(frame)))
        });
        let error = error(&links(&joints)[5], frame);
        worst = [0, 1].map(|i| worst[i].max(error[i]));
    }
    // Six times 2^-28 and 2^-29; six places rounded to 2^-16.
    assert!(worst[0] < 9.0 * 2f64.powi(-28), "{worst:?}");
    assert!(worst[1] < 6.0 * 2f64.powi(-16), "{worst:?}");
}

#[test]
fn poses_compose_like_their_points() {
    let mut random = rasterizer_tests::Random::new(61);
    for _ in 0..5000 {
        let mut pose = || {
            let turn = Rotation::about_x(Turn::from_bits(random.bits() as u32))
                * Rotation::about_y(Turn::from_bits(random.bits() as u32));
            let place = [(); 3].map(|()| random.within(-9 << 16, 9 << 16));
            Pose::rotated(turn).at(Vec3::from_bits(place)).scaled(
                rasterizer::camera::Distance::from_bits(random.within(1 << 14, 1 << 18) as u32),
            )
        };
        let (a, b) = (pose(), pose());
        let point = Vec3::from_bits([(); 3].map(|()| random.within(-9 << 16, 9 << 16)));
        let apply = |pose: &Pose, v: [f64; 3]| {
            let rows = f64s(&pose.rotation);
            let scale: f64 = pose.scale.to_num();
            let place = numbers(pose.translation);
            [0, 1, 2].map(|i| place[i] + scale * (0..3).map(|j| rows[i][j] * v[j]).sum::<f64>())
        };
        let want = apply(&a, numbers(point));
        for (got, want) in numbers(a.apply(point)).into_iter().zip(want) {
            assert!((got - want).abs() < 2f64.powi(-15), "{got} {want}");
        }
        let want = apply(&a, apply(&b, numbers(point)));
        for (got, want) in numbers(a.compose(b).apply(point)).into_iter().zip(want) {
            // A place within 2^-15; a scale of up to 16 within 2^-17 times 9 times the root of 3
            // units; the result within 2^-15.
            assert!((got - want).abs() < 2f64.powi(-12), "{got} {want}");
        }
    }
    let large = Pose::IDENTITY.scaled(rasterizer::camera::Distance::MAX);
    assert_eq!(large.compose(large).scale, rasterizer::camera::Distance::MAX);
}
