//! Ends of lines and points where planes cut them.

use rasterizer::numbers::{Scale, Vec3};

use super::{
    super::{judged_lines::End, line_ends::LineEnds},
    *,
};
use crate::{
    model::Fit,
    reference::{HalfSpace, LinearMap},
};

/// Lines and points in a ball about the origin, in the colours of their vertices.
fn scattered(random: &mut Random) -> Model {
    use std::fmt::Write as _;
    let mut obj = String::new();
    for _ in 0..24 {
        let place = [(); 3].map(|()| random.real(-1.0, 1.0));
        let [r, g, b] = [(); 3].map(|()| random.real(0.0, 1.0));
        writeln!(obj, "v {} {} {} {r} {g} {b}", place[0], place[1], place[2]).unwrap();
    }
    for vertex in 1..24 {
        writeln!(obj, "l {vertex} {}\np {vertex}", vertex + 1).unwrap();
    }
    Model::from_bytes(std::path::Path::new("m.obj"), obj.as_bytes(), &Options::default()).unwrap()
}

/// Views in which lines leave the view beyond each kind of plane.
#[derive(Clone, Copy, Debug)]
enum Leave {
    Near,
    Guard,
    Planes,
}

fn view(random: &mut Random, leave: Leave, number: usize) -> View {
    let is_parallel = number.is_multiple_of(3);
    let (distance, near, size) = match leave {
        // The eye is in the ball or just before it.
        Leave::Near => (random.real(0.0, 1.2), random.real(0.001, 0.5), 1.0),
        Leave::Guard => (random.real(2.0, 4.0), 0.5, 0.02),
        Leave::Planes => (random.real(2.0, 4.0), random.real(0.5, 3.0), 1.0),
    };
    let plane = |random: &mut Random| HalfSpace {
        normal: [(); 3].map(|()| random.real(-1.0, 1.0)),
        offset: random.real(-0.1, 0.4),
    };
    let count = if matches!(leave, Leave::Planes) { 1 + number % 3 } else { 0 };
    let mut sides = [None; MOST_PLANES];
    sides[..count].fill_with(|| Some(plane(random)));
    let entry = |random: &mut Random| random.real(-1.5, 1.5);
    View {
        size: [96, 64],
        distance,
        projection: if is_parallel {
            Projection::Orthographic { height: size * random.real(0.5, 3.0) }
        } else {
            Projection::Perspective { field_of_view_degrees: size * random.real(20.0, 120.0) }
        },
        near,
        far: near + random.real(1.0, 4.0),
        yaw_degrees: random.real(-360.0, 360.0),
        pitch_degrees: random.real(-360.0, 360.0),
        roll_degrees: random.real(-360.0, 360.0),
        subpixel: if number.is_multiple_of(2) { Subpixel::S4 } else { Subpixel::S8 },
        form: if number.is_multiple_of(5) {
            Form::Shaped(LinearMap { rows: [(); 3].map(|()| [(); 3].map(|()| entry(random))) })
        } else {
            Form::AsModelled
        },
        planes: ViewPlanes {
            sides,
            space: if number.is_multiple_of(2) { PlaneSpace::Object } else { PlaneSpace::World },
        },
        ..View::default()
    }
}

/// The part of its bound that an error is.
fn part(worst: Option<LineEndError>) -> f64 {
    worst.map_or(0.0, |worst| worst.error / worst.bound)
}

#[test]
fn ends_pass_where_each_kind_of_plane_cuts_them() {
    let mut random = Random(71);
    for leave in [Leave::Near, Leave::Guard, Leave::Planes] {
        let mut all = LineOutcome::default();
        let mut refused = 0;
        for number in 0..120 {
            let model = scattered(&mut random);
            let view = view(&mut random, leave, number);
            match judge_lines(&model, &view, LineOptions::default()) {
                Ok(found) => {
                    assert!(found.is_within(), "{leave:?} {view:?}: {found:?}");
                    all = all.and(found);
                }
                // The eye is so near that the core's numbers do not reach.
                Err(ViewError::Project(_)) => refused += 1,
                Err(error) => panic!("{error}"),
            }
        }
        assert!(refused < 40, "{leave:?}: {refused}");
        assert!(all.line_ends_cut > 500 && all.points > 200, "{leave:?}: {all:?}");
        assert!(part(all.line_end_place) > 0.6, "{leave:?}: the bound is loose: {all:?}");
    }
}

/// A line from behind the eye to before it, red to blue, with points at its ends. The eye is at a z
/// of 3, so they are at distances of -1 and 3, and 2 and -1 to the right of the axis.
fn through_the_eye() -> Model {
    let obj = "v 2 0 4 1 0 0\nv -1 0 0 0 0 1\nl 1 2\np 1 2\n";
    let options = Options { fit: Fit::Keep, ..Options::default() };
    let model = Model::from_bytes(std::path::Path::new("m.obj"), obj.as_bytes(), &options).unwrap();
    // In whole units, so that the tables have exactly these numbers.
    Model {
        positions: vec![[2, 0, 4], [-1, 0, 0]],
        scale: Scale::new(1, 0),
        offset: Vec3::ZERO,
        ..model
    }
}

/// A height is as large as its distance at half the angle: 207.8 pixels.
const VIEW: View = View {
    projection: Projection::Perspective { field_of_view_degrees: 60.0 },
    near: 1.0,
    ..FRONT
};

/// An end at a place right of and behind the middle of the picture, half a sub-pixel off at most.
fn end([x, distance]: [f64; 2], color: [f64; 3]) -> End {
    let focal = 120.0 * 3f64.sqrt();
    let column = 160.0 + focal * x / distance;
    let depth = (2f64.powi(32) / distance).min(2f64.powi(32) - 2.0).round();
    End { place: [(256.0 * column).round() as i64, 256 * 120], depth, color }
}

/// The near plane cuts the line in its middle.
#[test]
fn an_end_in_a_wrong_place_is_found() {
    let exact = LineEnds::new(&through_the_eye(), &VIEW.rounded());
    let judge = |drawn: [End; 2]| exact.judge([0, 1], &drawn, true);
    let (start, stop) = (end([0.5, 1.0], [127.5, 0.0, 127.5]), end([-1.0, 3.0], [0.0, 0.0, 255.0]));
    let right = judge([start, stop]);
    assert!(right.is_within(), "{right:?}");
    assert_eq!((right.line_ends, right.line_ends_cut), (2, 1));

    // Another hundredth of the line farther on, with the values that it has there.
    let later = end([0.47, 1.04], [124.95, 0.0, 130.05]);
    let found = judge([later, stop]);
    let place = found.line_end_place.unwrap();
    assert!(!place.is_within() && (place.error - 10.0).abs() < 0.1, "{place:?}");
    assert!(!found.line_end_depth.unwrap().is_within(), "{found:?}");
    assert!(!found.line_end_color.unwrap().is_within(), "{found:?}");
    // In the direction across, by two sub-pixels.
    let [x, y] = stop.place;
    let found = judge([start, End { place: [x, y + 2], ..stop }]);
    assert!(!found.is_within() && found.line_end_depth == right.line_end_depth, "{found:?}");
    // The depth of the other end, and of a way that is off by a millionth.
    for depth in [stop.depth, start.depth * (1.0 - 1e-6)] {
        let found = judge([End { depth, ..start }, stop]);
        assert!(!found.is_within() && found.line_end_place == right.line_end_place, "{found:?}");
    }
    // A twentieth of a step of a colour.
    let found = judge([End { color: [127.55, 0.0, 127.45], ..start }, stop]);
    assert!(!found.is_within() && found.line_end_depth == right.line_end_depth, "{found:?}");
}

#[test]
fn a_line_or_point_that_is_missing_or_should_not_be_there_is_found() {
    let model = through_the_eye();
    let (start, stop) = (end([0.5, 1.0], [0.0; 3]), end([-1.0, 3.0], [0.0; 3]));
    let judge = |view: View, vertices: [usize; 2], drawn: &[End]| {
        let found = LineEnds::new(&model, &view.rounded()).judge(vertices, drawn, false);
        (found.is_within(), found.lines_missing, found.lines_extra)
    };
    let (right, missing, extra) = ((true, 0, 0), (false, 1, 0), (false, 0, 1));
    assert_eq!(judge(VIEW, [0, 1], &[start, stop]), right);
    assert_eq!(judge(VIEW, [0, 1], &[]), missing);
    assert_eq!(judge(VIEW, [1; 2], &[stop]), right);
    assert_eq!(judge(VIEW, [1; 2], &[]), missing);
    assert_eq!(judge(VIEW, [0; 2], &[]), right);
    assert_eq!(judge(VIEW, [0; 2], &[start]), extra);
    // All of it before the near plane.
    let beyond = View { near: 3.5, ..VIEW };
    assert_eq!(judge(beyond, [0, 1], &[]), right);
    assert_eq!(judge(beyond, [0, 1], &[start, stop]), extra);
    // One end on the near plane: rounding decides.
    let through = View { near: 3.0, ..VIEW };
    let on_it = End { depth: 2f64.powi(32) - 2.0, ..stop };
    assert_eq!(judge(through, [0, 1], &[]), right);
    assert_eq!(judge(through, [0, 1], &[on_it; 2]), right);
    assert_eq!(judge(through, [1; 2], &[]), right);
    assert_eq!(judge(through, [1; 2], &[on_it]), right);
    // In the guard band, but the whole object is beside the picture: the core draws nothing.
    let place = Place { at: [8.0, 0.0, 0.0], ..Place::default() };
    let beside = View { distance: 8.0, place, ..VIEW };
    assert_eq!(judge(beside, [0, 1], &[]), right);
    let found = judge_lines(&model, &beside, LineOptions::default()).unwrap();
    assert!(found.lines + found.points == 0 && found.is_within(), "{found:?}");
    let less = Place { at: [6.0, 0.0, 0.0], ..place };
    assert_eq!(judge(View { place: less, ..beside }, [0, 1], &[]), missing);
}
