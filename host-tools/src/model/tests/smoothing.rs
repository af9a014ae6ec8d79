//! Normals by the smoothing groups of a file.

use super::{
    super::vector::{add, normalized, scaled},
    *,
};

/// A cylinder about the y axis of radius 1 and height 2, in quads and two caps of `sides` corners.
fn cylinder(sides: usize, side_group: &str, cap_group: &str) -> String {
    let mut text = String::new();
    for i in 0..sides {
        let (sin, cos) = (i as f64 * std::f64::consts::TAU / sides as f64).sin_cos();
        text += &format!("v {cos} -1 {sin}\nv {cos} 1 {sin}\n");
    }
    text += side_group;
    for i in 0..sides {
        let (here, next) = (2 * i + 1, 2 * ((i + 1) % sides) + 1);
        text += &format!("f {here} {} {} {next}\n", here + 1, next + 1);
    }
    let ring = |start: usize| (0..sides).map(move |i| format!(" {}", 2 * i + start));
    let top: String = ring(2).rev().collect();
    let bottom: String = ring(1).collect();
    text + cap_group + "f" + &top + "\nf" + &bottom + "\n"
}

/// Asserts that each triangle's corners have its own normal.
fn is_flat(model: &Model) -> bool {
    indices(model).iter().zip(&model.exact.face_normals).all(|(triangle, &face)| {
        triangle.iter().all(|&v| angle(model.exact.vertex_normals[v], face) < 1e-9)
    })
}

#[test]
fn faces_without_a_group_are_flat() {
    // Eight sides meet at 45 degrees, which the crease angle of 60 makes smooth.
    for off in ["s off\n", "s 0\n", "s 1\ns off\n"] {
        assert!(is_flat(&load(&cylinder(8, off, off), &Options::default()).unwrap()), "{off}");
    }
    assert!(!is_flat(&load(&cylinder(8, "", ""), &Options::default()).unwrap()));
    let options = Options { smoothing_groups: false, ..Options::default() };
    assert!(!is_flat(&load(&cylinder(8, "s off\n", ""), &options).unwrap()));
    // A cube keeps its edges, also at a crease angle that smooths them.
    let off = load(&format!("s off\n{CUBE}"), &crease(180.0)).unwrap();
    assert!(is_flat(&off) && off.positions.len() == 24);
    assert!(off.report.smoothing_groups);
    assert!(emit::source(&off).contains("// With unit fit, smoothing groups, a crease angle"));
}

#[test]
fn faces_of_a_group_are_smooth_and_others_keep_their_edge() {
    // Four sides meet at 90 degrees, beyond the crease angle of 60.
    for sides in [4, 5, 24] {
        for caps in ["s off\n", "s 2\n"] {
            let options = Options { fit: Fit::Keep, ..Options::default() };
            let model = load(&cylinder(sides, "s 1\n", caps), &options).unwrap();
            assert_eq!(model.positions.len(), 4 * sides, "{sides} sides, {caps}");
            let vertices = model.exact.vertex_normals.iter().zip(&model.exact.positions);
            for (&normal, &[x, y, z]) in vertices {
                let outwards = normalized([x, 0.0, z]).unwrap();
                let upwards = [0.0, y.signum(), 0.0];
                let off = angle(normal, outwards).min(angle(normal, upwards));
                assert!(off < 1e-9, "{normal:?} at {x} {y} {z}");
            }
        }
    }
    // All in one group: each corner's two sides of 90 degrees and its cap of 90 weigh the same.
    let model = load(&cylinder(4, "s 3\n", "s 3\n"), &Options::default()).unwrap();
    assert_eq!(model.positions.len(), 8);
    for (&normal, &[x, y, z]) in model.exact.vertex_normals.iter().zip(&model.exact.positions) {
        let sides = scaled(normalized([x, 0.0, z]).unwrap(), 2_f64.sqrt());
        let expected = add(sides, [0.0, y.signum(), 0.0]);
        assert!(angle(normal, expected) < 1e-9, "{normal:?}");
    }
}

#[test]
fn the_file_s_own_normals_and_unstated_faces_stay_as_they_are() {
    let plain = cylinder(8, "", "");
    let alone = load(&plain, &Options::default()).unwrap();
    assert!(!alone.report.smoothing_groups);
    // Groups further down concern only the faces behind them.
    let before = format!("{plain}v 9 0 0\nv 9 1 0\nv 9 0 1\ns off\nf 17 18 19\n");
    let options = Options { fit: Fit::Keep, ..Options::default() };
    let (both, alone) = (load(&before, &options).unwrap(), load(&plain, &options).unwrap());
    let normals = |model: &Model| {
        let mut normals: Vec<_> = model
            .exact
            .positions
            .iter()
            .zip(&model.exact.vertex_normals)
            .collect::<Vec<_>>()
            .into_iter()
            .filter(|(position, _)| position[0] < 5.0)
            .map(|(position, normal)| (*position, *normal))
            .collect();
        normals.sort_by(|a, b| a.partial_cmp(b).unwrap());
        normals
    };
    assert_eq!(normals(&both), normals(&alone));

    let given = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\ns off\nf 1//1 2//1 3//1\n";
    let model = load(given, &Options::default()).unwrap();
    assert!(model.exact.vertex_normals.iter().all(|&n| angle(n, [0.0, 0.6, 0.8]) < 1e-9));
    assert!(!model.report.smoothing_groups);
}
