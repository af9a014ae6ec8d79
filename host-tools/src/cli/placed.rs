//! Models of a picture, each with its place, as in `model.obj@1,0,0`.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
};

use clap::builder::{OsStringValueParser, TypedValueParser};
use host_tools::check::Place;

use super::view::numbers;

/// A model and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    /// The file.
    pub(super) path: PathBuf,
    /// Its place.
    pub(super) place: Place,
}

/// A parser of a file with or without a place.
pub(super) fn parser() -> impl TypedValueParser<Value = Placed> {
    OsStringValueParser::new().try_map(placed)
}

/// What stands behind the last `@` of a name is a place, unless there is a file of the whole name.
fn placed(text: OsString) -> Result<Placed, String> {
    let whole = |text: OsString| Placed { path: text.into(), place: Place::default() };
    let Some((path, place)) = text.to_str().and_then(|text| text.rsplit_once('@')) else {
        return Ok(whole(text));
    };
    if path.is_empty() || Path::new(&text).exists() {
        return Ok(whole(text));
    }
    Ok(Placed { path: path.into(), place: self::place(place)? })
}

/// A place, a scale and turns, as in 1,0,0 or 1,0,0,0.5,90.
fn place(text: &str) -> Result<Place, String> {
    let place = |x, y, z, scale, turn_degrees| Place { at: [x, y, z], scale, turn_degrees };
    let found = match numbers(text).as_deref() {
        Some(&[x, y, z]) => Some(place(x, y, z, 1.0, [0.0; 3])),
        Some(&[x, y, z, scale]) => Some(place(x, y, z, scale, [0.0; 3])),
        Some(&[x, y, z, scale, yaw]) => Some(place(x, y, z, scale, [yaw, 0.0, 0.0])),
        Some(&[x, y, z, scale, yaw, pitch, roll]) => {
            Some(place(x, y, z, scale, [yaw, pitch, roll]))
        }
        _ => None,
    };
    found.filter(|place| place.scale >= 1.0 / 65_536.0).ok_or_else(|| {
        "write a place behind the name as @x,y,z or @x,y,z,SCALE or @x,y,z,SCALE,YAW or \
         @x,y,z,SCALE,YAW,PITCH,ROLL, of numbers up to 32000 and a scale over 0, as in \
         model.obj@1,0,-0.5,0.5,90"
            .to_owned()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_stands_behind_the_name() {
        let of = |text: &str| placed(text.into()).unwrap();
        let at = |at| Place { at, ..Place::default() };
        assert_eq!(of("a.obj"), Placed { path: "a.obj".into(), place: at([0.0; 3]) });
        assert_eq!(of("-"), Placed { path: "-".into(), place: at([0.0; 3]) });
        let place = at([1.0, -0.5, 2.0]);
        assert_eq!(of("me@home/a.obj@1,-.5,2"), Placed { path: "me@home/a.obj".into(), place });
        assert_eq!(of("a.obj@0,0,0,0.5").place, Place { scale: 0.5, ..Place::default() });
        let turn_degrees = [90.0, 0.0, 0.0];
        assert_eq!(of("a.obj@0,0,0,1,90").place, Place { turn_degrees, ..Place::default() });
        let turn_degrees = [1.0, 2.0, 3.0];
        assert_eq!(of("a.obj@0,0,0,1,1,2,3").place, Place { turn_degrees, ..Place::default() });
        for text in
            ["a.obj@", "a.obj@1,2", "a.obj@1,2,3,0", "a.obj@1,2,3,-1", "a@b", "a@1,2,3,1,2,3"]
        {
            assert!(placed(text.into()).is_err(), "{text}");
        }
    }
}
