//! Plans of models whose needs are known by hand.

use std::{fs, path::PathBuf};

use tempfile::TempDir;

use super::*;
use crate::model::Options;

/// A model as a file, and its directory.
pub(super) fn file(obj: &str) -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("m.obj");
    fs::write(&path, obj).unwrap();
    (directory, path)
}

fn study(obj: &str, request: &Request) -> Result<Study, PlanError> {
    let (_directory, path) = file(obj);
    let study = Study::new(&path, &Options::default(), request, |_| ())?;
    // The plan reads the file again.
    Ok(study)
}

fn plan(obj: &str, request: &Request) -> Plan {
    let (_directory, path) = file(obj);
    let study = Study::new(&path, &Options::default(), request, |_| ()).unwrap();
    study.plan(&Costs::measured()).unwrap()
}

/// A few views, so that tests take no time.
pub(super) fn request() -> Request {
    let views = Views::Turntable { steps: 16, pitch_degrees: 20.0 };
    Request { display: [80, 60], views, ..Request::default() }
}

pub(super) const CUBE: &str = "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\n\
                    f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";

/// Three bars in a triangle, each over the next and under the last: no order of theirs is right.
pub(super) fn circle_of_bars() -> String {
    let mut text = String::new();
    for bar in 0..3 {
        let (sin, cos) = f64::from(bar * 120).to_radians().sin_cos();
        for [along, across] in [[-1.0, 0.3], [1.0, 0.3], [1.0, 0.6], [-1.0, 0.6]] {
            let (x, y) = (along * cos - across * sin, along * sin + across * cos);
            text += &format!("v {x} {y} {}\n", 0.3 * along);
        }
        let first = 4 * bar + 1;
        text += &format!("f {} {} {} {}\n", first, first + 1, first + 2, first + 3);
    }
    text
}

/// The decision about something.
pub(super) fn decision<'a>(plan: &'a Plan, about: &str) -> &'a Decision {
    plan.decisions.iter().find(|decision| decision.about == about).unwrap()
}

#[test]
fn a_cube_needs_neither_depth_nor_sorting_nor_normals_of_vertices() {
    let plan = plan(CUBE, &request());
    let types = plan.chosen.types;
    assert_eq!(types.visibility, Visibility::MeshOrder);
    assert!(!types.is_smooth && !types.clips);
    let visibility = decision(&plan, "visibility");
    assert!(visibility.basis.contains("proven"), "{visibility:?}");
    assert!(plan.source.contains("type Depth = NoDepth"));
    assert!(!plan.source.contains("VERTEX_NORMALS"));
    // A depth buffer would take two bytes more for each pixel.
    let other = visibility.other.as_ref().unwrap();
    assert!(other.ram_bytes >= 2 * 80 * 60 && other.flash_bytes > 0, "{other:?}");
}

#[test]
fn bars_in_a_circle_need_depth() {
    let view = View { turns_degrees: [0.0; 3], distance: None };
    let request = Request { views: Views::List(vec![view]), ..request() };
    let study = study(&circle_of_bars(), &request).unwrap();
    assert!(!study.is_right(Visibility::MeshOrder) && !study.is_right(Visibility::Sorted));
    assert!(study.is_right(Visibility::U16), "{:?}", study.worst(Visibility::U16));
    // By however many pixels: with all of them allowed, sorting is right.
    let generous = Request { wrong_part: 1.0, ..request };
    assert!(self::study(&circle_of_bars(), &generous).unwrap().is_right(Visibility::Sorted));
}

#[test]
fn an_open_surface_is_judged_by_its_views() {
    // A sheet hides nothing, but is not closed.
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let plan = plan(sheet, &request());
    assert_eq!(plan.chosen.types.visibility, Visibility::MeshOrder);
    // Also where sorting a triangle would cost next to nothing, and save bins.
    let triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
    let large = Request { display: [320, 240], ..request() };
    assert_eq!(self::plan(triangle, &large).chosen.types.visibility, Visibility::MeshOrder);
    assert_eq!(decision(&plan, "visibility").basis, "all 16 views of the turntable");
}

#[test]
fn less_memory_takes_more_bands_and_then_none() {
    let rows = |ram_bytes| plan(CUBE, &Request { ram_bytes, ..request() }).chosen.rows;
    let whole = 2 * 80 * 60;
    assert_eq!(rows(whole + 4_000), 60);
    assert!(rows(whole) < 60);
    let (_directory, path) = file(CUBE);
    let tight = Request { ram_bytes: 1_000, ..request() };
    let study = Study::new(&path, &Options::default(), &tight, |_| ()).unwrap();
    let error = study.plan(&Costs::measured()).unwrap_err();
    assert!(
        matches!(error, PlanError::TooLarge { ram: 1_000, least_ram, .. } if least_ram > 1_000)
    );
}

#[test]
fn a_camera_within_the_model_is_refused() {
    let error = study(CUBE, &Request { distance: 1.0, ..request() }).unwrap_err();
    assert!(matches!(error, PlanError::Inside { .. }), "{error}");
    let error = study("v 0 0 0\nv 1 0 0\nl 1 2\n", &request()).unwrap_err();
    assert!(matches!(error, PlanError::NoFaces(_)), "{error}");
}

#[test]
fn a_long_lens_clips() {
    // The sphere of radius 1 reaches 1,024 pixels from the middle.
    let study = study(CUBE, &Request { field_of_view_degrees: 1.0, ..request() }).unwrap();
    assert!(study.clips && study.reach_px > 1_024.0);
    assert!(!self::study(CUBE, &request()).unwrap().clips);
}

#[test]
fn the_work_is_that_of_the_picture() {
    // One square across the view, 80 x 60 pixels with 2 pixels a unit at this distance.
    let sheet = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    let view = View { turns_degrees: [0.0; 3], distance: None };
    let request = Request { views: Views::List(vec![view]), ..request() };
    let study = study(sheet, &request).unwrap();
    let work = &study.work[0];
    // Unit fit makes the half diagonal 1; the side is sqrt 2 units of f / 3 pixels.
    let side = 2f64.sqrt() * request.focal_length_px() / 3.0;
    assert_eq!((work.triangles, work.seen, work.missed), (2, 2, 0));
    assert!((work.covered as f64 - side * side).abs() < 2.0 * side, "{work:?}");
    assert_eq!(work.passed, work.covered);
    // Each of two triangles has a row for each of the square's, which are rounded to whole ones,
    // but maybe not at its tip.
    assert!((work.rows as f64 - 2.0 * side).abs() <= 4.0, "{work:?}");
    // Bands of 30 rows divide the square in its middle.
    let place = band_rows(60).iter().position(|&rows| rows == 30).unwrap();
    assert_eq!((work.met[0], work.met[place]), (2, 4));
}

#[test]
fn bands_are_whole_parts_of_the_display() {
    let rows = band_rows(240);
    assert_eq!(rows[..5], [240, 120, 80, 60, 48]);
    assert_eq!(rows.last(), Some(&4));
    assert_eq!(band_rows(3), [3]);
}
