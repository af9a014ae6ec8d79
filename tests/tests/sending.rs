//! Sending bands to a display: their memory, one band after the other, one while the next is drawn,
//! only the part that has changed, and the byte order of a bus.

use std::convert::Infallible;

use embedded_graphics::{
    draw_target::DrawTarget,
    pixelcolor::{IntoStorage, Rgb565, Rgb888, raw::RawU16},
    primitives::{PointsIter, Rectangle},
};
use rasterizer::{
    attribute::NoDepth,
    geometry::{Pose, ScreenVertex},
    mesh::{Mesh, Normals, Tables},
    numbers::{Rotation, S8, Scalar, Turn, Vec3},
    output::{BandAreas, Bands, Frame, FrameError, Rgb565Be, StoredColor, StreamError},
    scene::{Needs, Object, bin_words},
    shade::{Flat, Gouraud, Shader, Unlit},
};
use rasterizer_tests::{
    BusError, Call, Picture, Random, Recorder, Surface, area,
    bands::{
        BACKGROUND, DISPLAY, Depth, MATERIALS, Position, ROWS, Screen, at, ball, light, picture,
    },
};

/// The needs of a mesh are just enough, and their bytes are those of the types.
#[test]
fn needs_are_what_drawing_takes() {
    let ball = ball();
    let mesh = ball.mesh();
    let needs = Needs::of(&mesh, DISPLAY.size, 5);
    let want = Needs {
        vertices: mesh.vertex_count(),
        bin_words: 190,
        sort_words: mesh.triangle_count(),
        pixels: 305,
    };
    assert_eq!(needs, want);
    // A vertex with depth and light has 12 bytes, a word 4, and a pixel 4 of colour and 2 of depth.
    let bytes = needs.vertices * 12 + 190 * 4 + 305 * 6;
    assert_eq!(needs.bytes::<S8, u16, Gouraud<Rgb888>>(), bytes);
    assert_eq!(needs.bytes::<S8, NoDepth, Unlit<Rgb565>>(), needs.vertices * 8 + 190 * 4 + 305 * 2);
    let (mut color, mut depth) = (vec![BACKGROUND; needs.pixels], vec![0u16; needs.pixels]);
    let mut rows = |colors: usize, depths: usize| {
        let bands = Bands::new(DISPLAY, &mut color[..colors], &mut depth[..depths]).unwrap();
        bands.areas().next().unwrap().size.height
    };
    let pixels = needs.pixels;
    assert_eq!(
        (rows(pixels, pixels), rows(pixels - 1, pixels), rows(pixels, pixels - 1)),
        (5, 4, 4)
    );
    assert_eq!(Needs::of(&mesh, DISPLAY.size, 0), Needs::of(&mesh, DISPLAY.size, 1));
}

#[test]
fn bands_need_a_row() {
    let (mut color, mut depth) = ([BACKGROUND; 61], [0u32; 61]);
    let mut rows = |area: Rectangle, colors: usize, depths: usize| {
        Bands::new(area, &mut color[..colors], &mut depth[..depths])
            .map(|bands| bands.areas().collect::<Vec<_>>())
    };
    assert_eq!(rows(DISPLAY, 61, 61).map(|areas| areas.len()), Ok(47));
    assert_eq!(rows(DISPLAY, 60, 61), Err(FrameError::ColorLength { needed: 61 }));
    assert_eq!(rows(DISPLAY, 61, 60), Err(FrameError::DepthLength { needed: 61 }));
    assert_eq!(rows(area(5, 9, 10, 7), 61, 50), Ok(vec![area(5, 9, 10, 5), area(5, 14, 10, 2)]));
    assert_eq!(rows(area(5, 9, 10, 5), 61, 61), Ok(vec![area(5, 9, 10, 5)]));
    for nothing in [area(5, 9, 0, 7), area(5, 9, 10, 0)] {
        assert_eq!(rows(nothing, 0, 0), Ok(vec![]));
    }
    let without = |colors: usize| {
        Bands::without_depth(DISPLAY, &mut vec![BACKGROUND; colors][..]).map(|_| ())
    };
    assert_eq!(without(60), Err(FrameError::ColorLength { needed: 61 }));
    assert_eq!(without(61), Ok(()));
}

#[test]
fn areas_cover_a_rectangle_from_the_top() {
    for rows in 0..=50 {
        let areas: Vec<_> = BandAreas::new(DISPLAY, rows).collect();
        let points: Vec<_> = areas.iter().flat_map(Rectangle::points).collect();
        assert!(points.into_iter().eq(DISPLAY.points()), "{rows} rows");
        let (last, others) = areas.split_last().unwrap();
        assert!(others.iter().all(|area| area.size.height == rows.max(1)));
        assert!(last.size.height <= rows.max(1));
    }
}

/// Two objects with different shaders share a band, and the next frame uses the same bands.
#[test]
fn objects_share_bands() {
    let (ball, cube) = (ball(), Surface::cube(13_000, 3).scaled(-14));
    let (ball, cube) = (ball.mesh(), cube.mesh());
    let camera = at("3", DISPLAY);
    let mut smooth = vec![ScreenVertex::<S8, u16, [u16; 1]>::EMPTY; ball.vertex_count()];
    let mut own = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; cube.vertex_count()];
    let mut bands = u16::bands(DISPLAY, 5);
    for angle in [0, 70] {
        let pose = Pose::rotated(Rotation::about_y(Turn::degrees(angle)));
        let ball = Object::new(&ball, Gouraud::new(light())).project(&camera, &mut smooth).unwrap();
        let cube = Object::new(&cube, Position).posed(pose).project(&camera, &mut own).unwrap();
        let whole = picture::<u16>(ROWS, |frame| {
            ball.draw(frame)?;
            cube.draw(frame)
        });
        let alone = [
            picture::<u16>(ROWS, |frame| ball.draw(frame)),
            picture::<u16>(ROWS, |frame| cube.draw(frame)),
        ];
        for alone in &alone {
            let common =
                whole.pixels.iter().zip(&alone.pixels).filter(|(both, one)| both == one).count();
            assert!(common < whole.pixels.len() - 100, "one hides the other");
        }
        let mut bins = vec![0; bin_words(588, ROWS, 5)];
        let ball = ball.binned(5, &mut bins);
        let ball = ball.unwrap();
        let mut screen = Screen::new(DISPLAY);
        let Ok(()) = bands.show(
            &mut screen,
            |band| band.clear_color(BACKGROUND),
            |band| {
                ball.draw(band)?;
                cube.draw(band)
            },
        );
        assert!(screen == whole, "turned by {angle} degrees");
    }
}

/// A band starts in its background, whether or not its memory held a picture.
#[test]
fn bands_begin_cleared() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position).project(&at("1.7", DISPLAY), &mut storage).unwrap();
    let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
    let (mut color, mut depth) = ([Rgb888::new(255, 0, 0); 61 * 9], [9_999u16; 61 * 9]);
    let mut screen = Screen::new(DISPLAY);
    let mut bands = Bands::new(DISPLAY, &mut color, &mut depth).unwrap();
    let Ok(()) =
        bands.show(&mut screen, |band| band.clear_color(BACKGROUND), |band| seen.draw(band));
    assert!(screen == whole);
    let other = Rgb888::new(7, 7, 7);
    let Ok(()) = bands.show(&mut screen, |band| band.clear_color(other), |_| Ok(()));
    assert!(screen.pixels.iter().all(|&pixel| pixel == Some(other)));
}

/// Each pixel drawn lies in the bounds. If the whole object is in the picture, pixels reach every
/// side, except for thin ends of triangles that contain no centre.
#[test]
fn bounds_hold_what_is_drawn() {
    let (ball, cube) = (ball(), Surface::cube(14_000, 2).scaled(-14));
    let mut random = Random::new(3);
    let mut inside = 0;
    for mesh in [ball.mesh(), cube.mesh()] {
        for round in 0..400 {
            let mut turn = || Turn::from_bits(random.bits() as u32);
            let pose = Pose::rotated(Rotation::about_x(turn()) * Rotation::about_y(turn()));
            let [x, y] = [(); 2].map(|()| Scalar::from_bits(random.within(-3 << 16, 3 << 16)));
            let z = Scalar::from_bits(random.within(-9 << 16, 3 << 14));
            let object = Object::new(&mesh, Unlit::new()).posed(pose.at(Vec3::new(x, y, z)));
            let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
            let seen = object.project(&at("1.7", DISPLAY), &mut storage).unwrap();
            let bounds = seen.bounds();
            assert_eq!(
                bounds,
                object.project_on_demand::<_, _, u16>(&at("1.7", DISPLAY), S8).unwrap().bounds()
            );
            let drawn = picture::<u16>(ROWS, |frame| seen.draw(frame)).drawn(BACKGROUND);
            let is_inside = bounds.is_some_and(|bounds| {
                let (low, high) = (bounds.top_left, bounds.bottom_right().unwrap());
                let last = DISPLAY.bottom_right().unwrap();
                low.x > 3 && low.y > -2 && high.x < last.x && high.y < last.y
            });
            inside += usize::from(is_inside);
            let Some(bounds) = bounds else {
                assert_eq!(drawn, [], "round {round}");
                continue;
            };
            assert_eq!(bounds.intersection(&DISPLAY), bounds);
            assert!(drawn.iter().all(|&point| bounds.contains(point)), "round {round}: {bounds:?}");
            // At a corner of the outline, centres may lie beside the thin ends of triangles.
            let Some(first) = drawn.first().filter(|_| is_inside) else {
                continue;
            };
            let extent = drawn.iter().fold((*first, *first), |(low, high), point| {
                (low.component_min(*point), high.component_max(*point))
            });
            let (low, high) = (bounds.top_left, bounds.bottom_right().unwrap());
            for slack in
                [extent.0.x - low.x, extent.0.y - low.y, high.x - extent.1.x, high.y - extent.1.y]
            {
                assert!((0..=2).contains(&slack), "round {round}: {bounds:?}, drawn {extent:?}");
            }
        }
    }
    assert!(inside > 100, "{inside} objects inside the picture");
}

/// The smallest rectangle that contains both.
fn envelope(a: Rectangle, b: Rectangle) -> Rectangle {
    match (a.bottom_right(), b.bottom_right()) {
        (None, _) => b,
        (_, None) => a,
        (Some(p), Some(q)) => {
            Rectangle::with_corners(a.top_left.component_min(b.top_left), p.component_max(q))
        }
    }
}

/// It is enough to send the union of the last frame's bounds and this frame's: the display shows
/// the whole picture after every frame.
#[test]
fn only_what_changes_is_sent() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let (mut color, mut depth) = ([BACKGROUND; 61 * 5], [0u16; 61 * 5]);
    let mut screen = Screen::new(DISPLAY);
    let mut old = DISPLAY;
    let mut sent = 0;
    for step in 0..12 {
        let place = Vec3::new(
            Scalar::from_num(step) / 2 - Scalar::lit("3"),
            Scalar::ZERO,
            Scalar::lit("-2"),
        );
        let object = Object::new(&mesh, Position).posed(Pose::IDENTITY.at(place));
        let seen = object.project(&at("3", DISPLAY), &mut storage).unwrap();
        let new = seen.bounds().unwrap_or_default();
        let changed = envelope(old, new);
        let mut bands = Bands::new(changed, &mut color, &mut depth).unwrap();
        let Ok(()) =
            bands.show(&mut screen, |band| band.clear_color(BACKGROUND), |band| seen.draw(band));
        assert!(screen == picture::<u16>(ROWS, |frame| seen.draw(frame)), "step {step}");
        sent += changed.size.width * changed.size.height;
        old = new;
    }
    let all = 12 * DISPLAY.size.width * DISPLAY.size.height;
    assert!(sent < all / 2, "{sent} pixels of {all}");
}

#[test]
fn a_display_that_fails_ends_the_frame() {
    let sent = |works_for: usize| {
        let mut display = Recorder::failing_after(DISPLAY, works_for);
        let mut bands = u16::bands(DISPLAY, 10);
        let mut drawn = 0;
        let mut show = |display: &mut Recorder<Rgb888>| {
            bands.show(
                display,
                |band| band.clear_color(BACKGROUND),
                |_| {
                    drawn += 1;
                    Ok(())
                },
            )
        };
        let shown = show(&mut display);
        let areas: Vec<_> = display
            .calls()
            .iter()
            .map(|call| match call {
                Call::Contiguous(area, _) => *area,
                other => panic!("{other:?}"),
            })
            .collect();
        // The bands still work after a failure.
        let mut works = Recorder::new(DISPLAY);
        assert_eq!((show(&mut works), works.calls().len()), (Ok(()), 5));
        (shown, areas, drawn - 5)
    };
    let all: Vec<_> = BandAreas::new(DISPLAY, 10).collect();
    assert_eq!(sent(5), (Ok(()), all.clone(), 5));
    for works_for in 0..5 {
        let failed = (Err(BusError), all[..=works_for].to_vec(), works_for + 1);
        assert_eq!(sent(works_for), failed);
    }
}

/// Two buffers take turns: while one is sent, the next band is drawn into the other.
#[test]
fn streams_hand_their_buffers_over() {
    let ball = ball();
    let mesh = ball.mesh();
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let seen = Object::new(&mesh, Position).project(&at("1.7", DISPLAY), &mut storage).unwrap();
    let whole = picture::<u16>(ROWS, |frame| seen.draw(frame));
    let mut depth = [0u16; 61 * 6];
    // A buffer with a name. It is longer than a band.
    struct Named(char, Box<[Rgb888]>);
    impl AsMut<[Rgb888]> for Named {
        fn as_mut(&mut self) -> &mut [Rgb888] {
            &mut self.1
        }
    }
    let named = |name: char| Named(name, vec![Rgb888::new(255, 0, 0); 61 * 6 + 3].into());
    let (mut screen, mut resting, mut order) =
        (Screen::new(DISPLAY), Some(named('b')), String::new());
    let bands = Bands::new(DISPLAY, named('a'), &mut depth).unwrap();
    let last = bands.stream(
        |band| band.clear_color(BACKGROUND),
        |band| seen.draw(band),
        |finished, area| {
            order.push(finished.0);
            let pixels = (area.size.width * area.size.height) as usize;
            let Ok(()) = screen.fill_contiguous(&area, finished.1[..pixels].iter().copied());
            resting.replace(finished).ok_or(())
        },
    );
    assert!(screen == whole);
    assert_eq!(order, "abababab");
    assert_eq!((last.ok().unwrap().0, resting.unwrap().0), ('a', 'b'));
}

/// The static arrays of a microcontroller, swapped.
#[test]
fn streams_take_static_buffers() {
    let (front, mut back) =
        (Box::leak(Box::new([BACKGROUND; 61 * 8])), Box::leak(Box::new([BACKGROUND; 61 * 8])));
    let first = front.as_ptr();
    let mut bands = 0;
    let bands_of = Bands::without_depth(DISPLAY, front).unwrap();
    let front: &'static mut [Rgb888; 61 * 8] = bands_of
        .stream(
            |band| band.clear_color(BACKGROUND),
            |_| Ok(()),
            |mut finished, _| {
                bands += 1;
                std::mem::swap(&mut finished, &mut back);
                Ok::<_, ()>(finished)
            },
        )
        .unwrap();
    assert_eq!((bands, front.as_ptr()), (6, first));
}

#[test]
fn streams_end_with_what_fails() {
    let stream = |fails_at: usize, sizes: [usize; 5]| {
        let (mut depth, mut sent) = (vec![0u32; 61 * 10], 0);
        let bands = Bands::new(DISPLAY, vec![BACKGROUND; 61 * 10], &mut depth).unwrap();
        let ended = bands.stream(
            |band| band.clear_color(BACKGROUND),
            |_| Ok(()),
            |_, _| {
                sent += 1;
                if sent > fails_at { Err(BusError) } else { Ok(vec![BACKGROUND; sizes[sent - 1]]) }
            },
        );
        (ended.map(|buffer| buffer.len()), sent)
    };
    let enough = [610, 700, 610, 427, 0];
    assert_eq!(stream(5, enough), (Ok(0), 5));
    for fails_at in 0..5 {
        assert_eq!(stream(fails_at, enough), (Err(StreamError::Send(BusError)), fails_at + 1));
    }
    let short = |needed| Err(StreamError::Frame(FrameError::ColorLength { needed }));
    assert_eq!(stream(5, [609, 0, 0, 0, 0]), (short(610), 1));
    assert_eq!(stream(5, [610, 610, 610, 426, 0]), (short(427), 4));
    let told: StreamError<Infallible> = StreamError::Frame(FrameError::ColorLength { needed: 427 });
    assert_eq!(told.to_string(), "the colour buffer must have 427 pixels");
}

/// A ball of several colours without depth, in memory that starts at either half of a word.
fn filled<C: StoredColor + From<Rgb888> + From<Rgb565>>(skipped: usize) -> Vec<C> {
    let ball = ball();
    let mesh = Mesh::new(Tables { materials: &MATERIALS, ..*ball.mesh().tables() }).unwrap();
    let background = C::from(Rgb565::new(1, 2, 3));
    let pixels = (DISPLAY.size.width * DISPLAY.size.height) as usize;
    let mut memory = vec![background; skipped + pixels];
    let mut frame = Frame::without_depth(&mut memory[skipped..], DISPLAY).unwrap();
    frame.clear(C::from(Rgb565::new(4, 5, 6)));
    let mut vertices = vec![ScreenVertex::<S8, _, _>::EMPTY; mesh.vertex_count()];
    let drawn =
        Object::new(&mesh, Unlit::new()).draw(&at("1.7", DISPLAY), &mut vertices, &mut frame);
    assert_eq!(drawn, Ok(()));
    memory
}

/// Runs of one colour are the same if filled by pixels and if filled by words.
#[test]
fn big_endian_runs_are_rgb565_swapped() {
    for skipped in 0..2 {
        let native: Vec<Rgb565Be> =
            filled::<Rgb565>(skipped).into_iter().map(Rgb565Be::from).collect();
        assert!(filled::<Rgb565Be>(skipped) == native);
    }
}

/// In every shader the values are those of RGB565 with their bytes swapped.
#[test]
fn big_endian_pixels_are_rgb565_swapped() {
    fn check<Sh: Shader<Color = Rgb565>, Be: Shader<Color = Rgb565Be>>(native: Sh, swapped: Be) {
        let ball = ball();
        let normals = vec![[90, 20, 87]; ball.mesh().triangle_count()];
        let mesh = Mesh::new(Tables {
            face_normals: Normals::I8(&normals),
            materials: &MATERIALS,
            ..*ball.mesh().tables()
        })
        .unwrap();
        let background = Rgb565::new(1, 2, 3);
        let mut native_picture = Picture::<_, u16>::empty(DISPLAY, background);
        native_picture.draw(&mesh, native, &at("1.7", DISPLAY));
        let mut picture = Picture::<Rgb565Be, u16>::empty(DISPLAY, background.into());
        picture.draw(&mesh, swapped, &at("1.7", DISPLAY));
        let want: Vec<u8> = native_picture.color.iter().flat_map(|pixel| bytes(*pixel)).collect();
        assert!(Rgb565Be::as_bytes(&picture.color) == want);
        assert!(native_picture.color.iter().filter(|&&pixel| pixel != background).count() > 1000);
    }
    fn bytes(pixel: Rgb565) -> [u8; 2] {
        pixel.into_storage().to_be_bytes()
    }
    check(Unlit::new(), Unlit::new());
    check(Flat::new(light()), Flat::new(light()));
    check(Gouraud::new(light()), Gouraud::new(light()));
    for bits in 0..=u16::MAX {
        let color = Rgb565::from(RawU16::from(bits));
        let swapped = Rgb565Be::from(color);
        assert_eq!(Rgb565::from(swapped), color);
        assert_eq!(Rgb565Be::as_bytes(&[swapped]), bits.to_be_bytes());
        let raw = RawU16::from(swapped);
        assert_eq!(Rgb565Be::from(raw), swapped);
    }
    let orange = Rgb888::new(255, 160, 7);
    assert_eq!(Rgb565Be::from(orange), Rgb565Be::from(Rgb565::from(orange)));
}
