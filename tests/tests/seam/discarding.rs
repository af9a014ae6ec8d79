//! Pixels that a shader discards keep what is stored, and are not sent to a display.

use super::*;

/// A third of the pixels.
const fn is_hole(column: i32, row: i32) -> bool {
    (column + row).rem_euclid(3) == 0
}

const PAPER: Rgb888 = Rgb888::new(240, 230, 9);

const OPAQUE: By<[u16; 0], Rgb888> = by_fragment(|_| PAPER);
const LATTICE: By<[u16; 0], Option<Rgb888>> =
    by_fragment(|fragment| (!is_hole(fragment.column, fragment.row)).then_some(PAPER));

/// A lattice, and then a ball behind it and through it, which is seen in the holes.
fn discards<D: Framed>(blend: Option<fn(Rgb888, Rgb888) -> Rgb888>, eye: &str) {
    let (ball, cube) = (ball(), cube());
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at(eye, DISPLAY);
    let behind = Object::new(&ball, Position).posed(Pose::IDENTITY.at(Vec3::lit("0.8", "0", "0")));
    let behind = behind.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let opaque = Object::new(&cube, OPAQUE).posed(turned());
    let opaque = opaque.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let lattice = Object::new(&cube, LATTICE).posed(turned());
    let blended = lattice.blended(Blend(blend.unwrap_or(average)));
    let lattice = lattice.project_on_demand::<_, S8, D>(&camera, S8).unwrap();
    let blended = blended.project_on_demand::<_, S8, D>(&camera, S8).unwrap();

    let draw_holes = |frame: &mut Frame<'_, Rgb888, D::Buffer<'_>>| match blend {
        Some(_) => blended.draw(frame),
        None => lattice.draw(frame),
    };
    let draw_both = |frame: &mut Frame<'_, Rgb888, D::Buffer<'_>>| {
        draw_holes(frame)?;
        behind.draw(frame)
    };
    let alone = D::frame(|frame| opaque.draw(frame));
    let ball = D::frame(|frame| behind.draw(frame));
    let (holes, both) = (D::frame(draw_holes), D::frame(draw_both));
    let [mut through, mut before] = [0; 2];
    for (index, point) in DISPLAY.points().enumerate() {
        let is_kept = alone.color[index] != BACKGROUND && !is_hole(point.x, point.y);
        let mut want = (BACKGROUND, 0);
        if is_kept {
            let color = blend.map_or(PAPER, |blend| blend(BACKGROUND, PAPER));
            want = (color, alone.depth[index]);
        }
        assert_eq!((holes.color[index], holes.depth[index]), want, "{point}");
        if ball.color[index] != BACKGROUND && is_seen::<D>(ball.depth[index], want.1) {
            if alone.color[index] != BACKGROUND && alone.depth[index] > ball.depth[index] {
                through += 1;
            }
            want = (ball.color[index], ball.depth[index]);
        } else if is_kept {
            before += 1;
        }
        assert_eq!((both.color[index], both.depth[index]), want, "{point}");
    }
    assert!(before > 50, "{before} before the ball");
    assert_eq!(through > 20, size_of::<D>() != 0, "{through} seen through the holes");
    bands_equal::<D>(&holes, draw_holes);
    bands_equal::<D>(&both, draw_both);
}

#[test]
fn discarded_pixels_keep_color_and_depth() {
    fn in_frames<D: Framed>() {
        for eye in ["3", "2.4"] {
            discards::<D>(None, eye);
            discards::<D>(Some(tint), eye);
        }
    }
    in_frames::<u16>();
    in_frames::<FloatDepth>();
    in_frames::<u32>();
    in_frames::<NoDepth>();
}

#[test]
fn a_display_gets_no_discarded_pixel() {
    let cube = cube();
    let mesh = cube.mesh();
    for eye in ["3", "2.4"] {
        let object = Object::new(&mesh, LATTICE).posed(turned());
        let seen = object.project_on_demand(&at(eye, DISPLAY), S8).unwrap();
        let whole = NoDepth::frame(|frame| seen.draw(frame));
        assert!(whole.color.iter().filter(|&&color| color == PAPER).count() > 200);
        assert_eq!(direct(&object, eye), whole.color);
    }
}
