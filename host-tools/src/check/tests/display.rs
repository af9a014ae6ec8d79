//! What displays of few colours show.

use super::*;
use crate::check::{Colors, Display, Matrix, display::judge_shown};

const ONE_BIT: Display = Display { colors: Colors::Binary, dither: Matrix::Eight };

/// Every format and matrix, with interpolated colours and with even ones.
#[test]
fn every_format_shows_what_is_defined() {
    let model = shipped("rocket.obj");
    let checker = Checker::new(&model);
    for (name, colors) in Colors::NAMES {
        for dither in [Matrix::None, Matrix::Four, Matrix::Eight] {
            for shading in [Shading::Gouraud, Shading::Unlit] {
                let display = Some(Display { colors, dither });
                let view = View { shading, display, yaw_degrees: 40.0, ..FRONT };
                let outcome = checker.check(&view).unwrap().outcome;
                let display = outcome.display.unwrap();
                assert!(outcome.is_within(&Bounds::ARITHMETIC), "{name} {dither:?}: {display:#?}");
                assert!(display.judged > 5_000, "{name} {dither:?}: {display:#?}");
                let most = if shading == Shading::Unlit { 10 } else { 0 };
                assert!(display.even_blocks >= most, "{name} {dither:?}: {display:#?}");
            }
        }
    }
}

/// A pixel that is on instead of off, a threshold instead of dithering, and a pattern that begins a
/// column too late.
#[test]
fn wrong_pixels_of_a_display_are_found() {
    let model = shipped("rocket.obj");
    let view = View { shading: Shading::Flat, display: Some(ONE_BIT), ..FRONT };
    let checked = check(&model, &view).unwrap();
    let colors: Vec<_> = checked.fixed.pixels.iter().map(|pixel| pixel.color).collect();
    let right = ONE_BIT.shown(view.size, &colors);
    assert_eq!(Some(judge_shown(ONE_BIT, &checked, &right)), checked.outcome.display);

    let mut one_wrong = right.clone();
    let drawn = checked.fixed.pixels.iter().rposition(|pixel| pixel.depth != 0).unwrap();
    one_wrong[drawn] = one_wrong[drawn].map(|channel| 255 - channel);
    let found = judge_shown(ONE_BIT, &checked, &one_wrong);
    assert_eq!((found.wrong_steps, found.wrong_colors), (1, 1));
    assert_eq!(found.first, Some([drawn % 320, drawn / 320]));
    assert!(!found.is_within());

    let threshold = Display { dither: Matrix::None, ..ONE_BIT }.shown(view.size, &colors);
    let found = judge_shown(ONE_BIT, &checked, &threshold);
    assert!(found.wrong_steps > 1_000 && found.wrong_colors > 1_000, "{found:#?}");
    assert!(found.block_max_error > 1.0 / 64.0, "{found:#?}");

    let mut moved = right;
    moved.rotate_right(1);
    let found = judge_shown(ONE_BIT, &checked, &moved);
    assert!(found.wrong_steps > 1_000 && found.wrong_colors > 1_000, "{found:#?}");
}
