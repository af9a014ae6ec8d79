//! The picture of a ball by the normal.

use super::*;

#[test]
fn a_ball_s_picture_is_right_in_every_mode_and_filter() {
    let model = shipped("torus_knot.obj");
    let mut filters = Filter::NAMES.iter().cycle();
    for ((_, perspective), view) in Correction::NAMES.into_iter().cycle().zip(views()).take(14) {
        let &(_, filter) = filters.next().unwrap();
        let view = View { shading: Shading::Matcap, perspective, filter, ..view };
        let outcome = pass(&model, &view);
        assert!(outcome.arithmetic.deviation.pixels > 5_000, "{view:?}");
        assert!(outcome.arithmetic.texels.is_some());
    }
}

/// Normals that point elsewhere show another side of the ball.
#[test]
fn wrong_normals_are_far_off_end_to_end() {
    let model = shipped("torus_knot.obj");
    let mut turned = model.clone();
    for normal in &mut turned.vertex_normals {
        normal.swap(0, 1);
    }
    let view = View { shading: Shading::Matcap, ..FRONT };
    let psnr =
        |model: &Model| check(model, &view).unwrap().outcome.end_to_end.deviation.psnr_db.unwrap();
    let (right, wrong) = (psnr(&model), psnr(&turned));
    assert!(right > 30.0 && wrong < right - 6.0, "{right} {wrong}");
}
