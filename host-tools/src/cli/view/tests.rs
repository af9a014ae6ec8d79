//! Every option reaches its view, and none takes a silly value.

use clap::Parser;
use host_tools::{
    check::{
        BACKGROUND, Blending, Colors, Correction, DepthFormat, Display, FadeAlong, Filter, Fog,
        FogBy, Form, Lamp, Look, Matrix, Place, PlaneSpace, Projection, Subpixel, Sun, ViewLights,
        ViewPlanes,
    },
    reference::{self, Blend, HalfSpace, LinearMap},
};

use super::*;

#[derive(Debug, Parser)]
struct Only {
    #[command(flatten)]
    view: ViewOptions,
}

fn parse(arguments: &[&str]) -> Result<ViewOptions, String> {
    let line = ["x"].iter().chain(arguments);
    Only::try_parse_from(line).map(|only| only.view).map_err(|error| error.to_string())
}

#[test]
fn no_options_give_the_library_s_defaults() {
    let options = parse(&[]).unwrap();
    assert_eq!(options.view(Shading::default()), View::default());
    assert_eq!(options.conversion(), Options::default());
}

#[test]
fn every_option_arrives() {
    let line = "--size 7x9 --subpixel 4 --depth u32 --shading flat --perspective \
                every-16 --filter trilinear --fog linear:1.5:9 --fog-by vertex --blend screen --opacity 0.25 --fade z --distance 4 --orthographic 2.5 --near 1 --far 9 --yaw -1 --pitch 2 --roll 3 \
                --crease 10 --frames 5 --light -1,2,3 --light 0,-1,.5,0.25 --lamp -1,0,2,1.5 --ambient 0.375 --colors gray2 --dither 4 --clip 0,-1,0.5,0.25 --clip -3,0,0,-1 --clip-in world \
                --stretch 1,-2,.5";
    let options = parse(&line.split(' ').collect::<Vec<_>>()).unwrap();
    let expected = View {
        size: [7, 9],
        distance: 4.0,
        look: None,
        form: Form::Shaped(LinearMap {
            rows: [[1.0, 0.0, 0.0], [0.0, -2.0, 0.0], [0.0, 0.0, 0.5]],
        }),
        place: Place::default(),
        projection: Projection::Orthographic { height: 2.5 },
        near: 1.0,
        far: 9.0,
        yaw_degrees: -1.0,
        pitch_degrees: 2.0,
        roll_degrees: 3.0,
        subpixel: Subpixel::S4,
        depth: DepthFormat::U32,
        shading: Shading::Flat,
        perspective: Correction::Every16,
        filter: Filter::Trilinear,
        display: Some(Display { colors: Colors::Gray2, dither: Matrix::Four }),
        lights: ViewLights {
            suns: [
                Some(Sun { toward: [-1.0, 2.0, 3.0], level: 0.8 }),
                Some(Sun { toward: [0.0, -1.0, 0.5], level: 0.25 }),
                None,
                None,
            ],
            lamps: [Some(Lamp { position: [-1.0, 0.0, 2.0], half: 1.5 }), None, None, None],
            ambient: 0.375,
        },
        blending: Blending::By(Blend::Screen),
        background: BACKGROUND,
        opacity: 0.25,
        fade: FadeAlong::Z,
        fog: Some(Fog {
            law: reference::Fog::Linear { start: 1.5, end: 9.0 },
            by: FogBy::Vertex,
            color: BACKGROUND,
        }),
        planes: ViewPlanes {
            sides: [
                Some(HalfSpace { normal: [0.0, -1.0, 0.5], offset: 0.25 }),
                Some(HalfSpace { normal: [-3.0, 0.0, 0.0], offset: -1.0 }),
                None,
                None,
                None,
                None,
            ],
            space: PlaneSpace::World,
        },
    };
    assert_eq!(options.view(Shading::Unlit), expected);
    let conversion = options.conversion();
    assert_eq!((conversion.crease_degrees, options.frames), (10.0, Some(5)));
    assert!(!conversion.smoothing_groups, "the angle goes before the file's groups");
}

#[test]
fn silly_values_are_refused_by_name() {
    for (option, values) in [
        ("--size", &["0x0", "99999x1", "1x2049", "x", "", "-1x1", "3.5x1", "320", "1x1x1"][..]),
        ("--distance", &["NaN", "inf", "-1", "1e300", "", "far"]),
        ("--fov", &["0", "180", "NaN", "-40"]),
        ("--orthographic", &["0", "nan", "1e9"]),
        ("--near", &["0", "-0.1", "NaN", "1e-300"]),
        ("--far", &["inf", "0"]),
        ("--yaw", &["NaN", "1e300", "-infinity"]),
        ("--crease", &["181", "-1", "NaN"]),
        ("--frames", &["0", "-3", "361", "1.5", "99999999999999"]),
        ("--depth", &["u8", "", "U16"]),
        ("--subpixel", &["5", ""]),
        ("--shading", &["toon"]),
        ("--light", &["0,0,0", "1,2", "1,2,3,4", "1,2,3,0.5,6", "nan,0,1", "", "1e9,0,0"]),
        ("--lamp", &["1,2,3", "1,2,3,0", "1,2,3,-1", "1,2,inf,1", ""]),
        ("--perspective", &["every-5", "every", ""]),
        ("--filter", &["linear", "Nearest"]),
        ("--colors", &["rgb", "", "1"]),
        ("--dither", &["2", "", "bayer"]),
        ("--blend", &["alpha", ""]),
        ("--opacity", &["1.1", "-0.5", "NaN"]),
        (
            "--fog",
            &["", "exp", "exp:", "exp:-1", "exp:nan", "linear:1", "linear:2:2", "linear:3:1", "3"],
        ),
        ("--eye", &["1,2", "1,2,3,4", "nan,0,0", "1e9,0,0", ""]),
        ("--ambient", &["1.1", "-0.1", "nan"]),
        ("--simplify", &["0", "-1", "1.5", "", "many"]),
        ("--fog-by", &["pixel", "face"]),
        ("--clip", &["", "1,0,0", "0,0,0,1", "1,0,0,1,1", "nan,0,1,0", "1e9,0,0,0", "1,0,0,1e9"]),
        ("--clip-in", &["view", "model"]),
    ] {
        for value in values {
            let error = parse(&[&format!("{option}={value}")]).unwrap_err();
            assert!(error.contains(option), "{option}={value}: {error}");
        }
    }
    assert!(parse(&["--fov=30", "--orthographic=2"]).is_err());
    for turntable in ["--distance=2", "--yaw=1", "--pitch=0", "--roll=9"] {
        let error = parse(&["--eye=1,2,3", turntable]).unwrap_err();
        assert!(error.contains("cannot be used with"), "{error}");
    }
    assert!(parse(&["--target=1,2,3"]).is_err() && parse(&["--up=1,2,3"]).is_err());
    assert!(parse(&["--clip-in=world"]).is_err(), "there are no planes");
    assert!(parse(&["--dither=8"]).is_err(), "colours to dither to are missing");
}

#[test]
fn an_eye_looks_at_models_as_they_are_made() {
    let options = parse(&["--eye", "-1,2,3", "--target=0,-.5,0", "--keep-units"]).unwrap();
    let view = options.view(Shading::default());
    let look = Look { eye: [-1.0, 2.0, 3.0], target: [0.0, -0.5, 0.0], up: [0.0, 1.0, 0.0] };
    assert_eq!(view.look, Some(look));
    assert_eq!([view.yaw_degrees, view.pitch_degrees, view.roll_degrees], [0.0; 3]);
    assert_eq!(options.conversion().fit, Fit::Keep);
}

#[test]
fn more_planes_than_six_are_refused() {
    let of = |count: usize| parse(&vec!["--clip=1,0,0,0"; count]).unwrap().check(1, 1);
    assert!(of(6).is_ok());
    let error = of(7).unwrap_err().to_string();
    assert!(error.contains("--clip is given 7 times") && error.contains("6"), "{error}");
}
