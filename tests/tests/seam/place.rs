//! Shaders that read the place and the depth of their pixels.

use super::*;

/// A colour that tells the place of its pixel.
const fn place(column: i32, row: i32) -> Rgb888 {
    Rgb888::new(column as u8, row as u8, 77)
}

/// A fragment's place is the display's, in frames of the display and of its parts, in bands, and
/// straight onto it.
#[test]
fn fragments_know_their_place() {
    let cube = cube();
    let mesh = cube.mesh();
    let shader = by_fragment(|fragment| place(fragment.column, fragment.row));
    let object = Object::new(&mesh, shader).posed(turned());
    let camera = at("2.4", DISPLAY);
    let seen = object.project_on_demand(&camera, S8).unwrap();
    let whole = NoDepth::frame(|frame| seen.draw(frame));
    let mut drawn = 0;
    for (point, &color) in DISPLAY.points().zip(&whole.color) {
        if color != BACKGROUND {
            assert_eq!(color, place(point.x, point.y), "{point}");
            drawn += 1;
        }
    }
    assert!(drawn > 500, "{drawn}");
    assert_eq!(direct(&object, "2.4"), whole.color);
    bands_equal::<NoDepth>(&whole, |band| seen.draw(band));
    for part in [area(20, 3, 17, 30), area(-9, -7, 40, 30), area(40, 20, 50, 50)] {
        let (mut flat, mut deep) = (Picture::<_, u16>::empty(part, BACKGROUND), vec![0u16; 4000]);
        let mut frame = Frame::new(&mut flat.color, &mut flat.depth, part).unwrap();
        object.project_on_demand(&camera, S8).unwrap().draw(&mut frame).unwrap();
        assert_eq!(flat.color, whole.crop(part, BACKGROUND).color, "{part:?}");
        // In a larger buffer.
        let mut color = vec![BACKGROUND; 4000];
        let mut frame = Frame::with_stride(&mut color, &mut deep, part, 53).unwrap();
        object.project_on_demand(&camera, S8).unwrap().draw(&mut frame).unwrap();
        let width = part.size.width as usize;
        let rows = flat.color.chunks(width).zip(color.chunks(53));
        assert!(rows.into_iter().all(|(packed, strided)| *packed == strided[..width]), "{part:?}");
    }
}

/// A dither by depth and place: the nearer, the more pixels of a block of 2 by 2 are light.
fn dithered(fragment: Fragment<[U16F16; 1]>) -> Rgb888 {
    let [light] = fragment.varyings;
    let threshold = [[0, 2], [3, 1]][(fragment.row & 1) as usize][(fragment.column & 1) as usize];
    let is_light = light.to_num::<u32>() / 16_384 > threshold;
    let depth = (fragment.depth.to_bits() >> 24) as u8;
    if is_light { Rgb888::new(255, depth, 255) } else { Rgb888::new(0, depth, 0) }
}

/// A dither has no seam between bands, nor round a rectangle that is drawn anew.
#[test]
fn a_dither_is_seamless() {
    let ball = ball();
    let mesh = ball.mesh();
    let shader = By { vertex: |[x, _, _]| [x as u16 ^ 0x8000], pixel: dithered };
    for eye in EYES {
        let object = Object::new(&mesh, shader).culled(CullNone);
        let seen = object.project_on_demand::<_, S8, u16>(&at(eye, DISPLAY), S8).unwrap();
        let whole = u16::frame(|frame| seen.draw(frame));
        let of = |level| {
            let shown =
                whole.color.iter().filter(|&color| color.b() == level && color.r() == level);
            shown.count()
        };
        assert!(of(255) > 100 && of(0) > 100, "{} light, {} dark from {eye}", of(255), of(0));
        bands_equal::<u16>(&whole, |band| seen.draw(band));
        for dirty in [area(11, 5, 1, 1), area(4, 3, 33, 18), area(20, 9, 31, 7)] {
            let mut part = Picture::<_, u16>::empty(dirty, BACKGROUND);
            let mut frame = Frame::new(&mut part.color, &mut part.depth, dirty).unwrap();
            let Ok(()) = seen.draw(&mut frame);
            assert_eq!(part.color, whole.crop(dirty, BACKGROUND).color, "{dirty:?} from {eye}");
        }
    }
}

/// The upper 24 bits of the depth.
const fn shown_depth(fragment: Fragment<[U16F16; 0]>) -> Rgb888 {
    let [red, green, blue, _] = fragment.depth.to_bits().to_be_bytes();
    Rgb888::new(red, green, blue)
}

/// The depth that a shader reads is the one that is stored.
#[test]
fn a_shader_reads_the_stored_depth() {
    fn shown<D: Framed>(to_bits: fn(u32) -> u32) {
        let ball = ball();
        let mesh = ball.mesh();
        for eye in EYES {
            let object = Object::new(&mesh, by_fragment(shown_depth)).culled(CullNone);
            let seen = object.project_on_demand::<_, S8, D>(&at(eye, DISPLAY), S8).unwrap();
            let whole = D::frame(|frame| seen.draw(frame));
            let mut drawn = 0;
            for (&color, &depth) in whole.color.iter().zip(&whole.depth) {
                // A depth may look like the background.
                let is_drawn = if size_of::<D>() == 0 { color != BACKGROUND } else { depth != 0 };
                if !is_drawn {
                    assert_eq!(color, BACKGROUND, "{eye}");
                    continue;
                }
                let [red, green, blue, _] = to_bits(depth).to_be_bytes();
                assert_eq!(color, Rgb888::new(red, green, blue), "{eye}");
                drawn += 1;
            }
            assert!(drawn > 400, "{drawn} from {eye}");
            bands_equal::<D>(&whole, |band| seen.draw(band));
        }
    }
    shown::<u16>(|depth| depth << 16);
    // The value by the definition, in Q0.32.
    shown::<FloatDepth>(|bits| (2048 | bits & 2047) << 20 >> (31 - (bits >> 11)));
    shown::<u32>(|depth| depth);
    shown::<NoDepth>(|depth| depth);
}
