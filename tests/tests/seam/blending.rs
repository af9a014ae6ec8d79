//! Blended pixels: those of a function of the stored colour and the new one; their depth is stored.

use super::*;

/// A see-through cube that cuts into a ball: where it is nearer its colour is mixed with the
/// ball's, and its depth is stored.
fn blends<D: Framed, Sh: Shader<Color = Rgb888>>(
    shader: &Sh,
    blend: fn(Rgb888, Rgb888) -> Rgb888,
    eye: &str,
) {
    let (ball, cube) = (ball(), cube());
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at(eye, DISPLAY);
    let moved = Pose::IDENTITY.at(Vec3::lit("0.6", "0.3", "0.4"));
    let behind = Object::new(&ball, Position).posed(moved);
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let object = Object::new(&cube, shader.clone()).posed(turned());
    let opaque = object.clone().project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let glass = object.blended(Blend(blend)).project_on_demand::<_, S8, D>(&camera, S8).unwrap();

    let stored = D::frame(|frame| behind.draw(frame));
    let alone = D::frame(|frame| opaque.draw(frame));
    let whole = D::frame(|frame| {
        behind.draw(frame)?;
        glass.draw(frame)
    });
    let [mut over_ball, mut over_background, mut hidden] = [0; 3];
    for (index, point) in DISPLAY.points().enumerate() {
        let (mut color, mut depth) = (stored.color[index], stored.depth[index]);
        if alone.color[index] != BACKGROUND {
            if is_seen::<D>(alone.depth[index], depth) {
                *(if color == BACKGROUND { &mut over_background } else { &mut over_ball }) += 1;
                (color, depth) = (blend(color, alone.color[index]), alone.depth[index]);
            } else {
                hidden += 1;
            }
        }
        assert_eq!((whole.color[index], whole.depth[index]), (color, depth), "{point}");
    }
    let is_tested = size_of::<D>() != 0;
    assert!(over_ball > 100 && over_background > 100, "{over_ball}, {over_background}");
    assert_eq!(hidden > 20, is_tested, "{hidden} are hidden");
    bands_equal::<D>(&whole, |band| {
        behind.draw(band)?;
        glass.draw(band)
    });
}

#[test]
fn blended_pixels_are_those_of_the_definition() {
    fn in_frames<D: Framed>() {
        for eye in ["3", "2.4"] {
            blends::<D, _>(&Position, average, eye);
            blends::<D, _>(&Position, tint, eye);
            // One colour a triangle.
            blends::<D, _>(&Unlit::new(), tint, eye);
        }
    }
    in_frames::<u16>();
    in_frames::<FloatDepth>();
    in_frames::<u32>();
    in_frames::<NoDepth>();
}
