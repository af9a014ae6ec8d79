//! Cards that face the camera: with a texel a pixel they are copies of their texture, and bands,
//! every storage of vertices and the display itself draw the same.

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::{Affine, FloatDepth, NoDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{Pose, Projection, ScreenVertex},
    mesh::{Card, Mesh},
    numbers::{Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::{Direct, Frame},
    scene::Object,
    shade::Textured,
    texture::{Clamp, Colors, Keyed, Nearest, Texture},
};
use rasterizer_tests::{
    Random, area,
    bands::{BACKGROUND, DISPLAY, Depth, ROWS, Screen, at, picture},
};

const W: usize = 7;
const H: usize = 10;

/// Texels that all differ; the first one is transparent, and is there in every corner.
static TEXELS: [Rgb888; W * H] = {
    let mut texels = [Rgb888::BLACK; W * H];
    let mut i = 0;
    while i < W * H {
        texels[i] = Rgb888::new(40 + i as u8, 200 - i as u8, 7);
        i += 1;
    }
    texels[W - 1] = texels[0];
    texels[W * (H - 1)] = texels[0];
    texels[W * H - 1] = texels[0];
    texels
};
type Picture = Texture<Keyed<Colors<'static, Rgb888, { W * H }>>, W, H, Clamp, Clamp>;
static PICTURES: [Picture; 1] =
    [Texture::new(Keyed::new(Colors::new(&TEXELS), Rgb888::new(40, 200, 7)))];

static CENTERED: Mesh<'static> = Card::<{ W as i16 }, { H as i16 }>::CENTERED;
static STANDING: Mesh<'static> = Card::<{ W as i16 }, { H as i16 }>::STANDING;

/// A point to the right of the camera's axis and above it, in pixels, at a distance along it.
fn point(eye: Vec3, rotation: Rotation, [right, up]: [i32; 2], pixel: f64, way: f64) -> Vec3 {
    let [x, y] = [right, up].map(|pixels| Scalar::from_num(f64::from(pixels) * pixel));
    let aside = rotation.apply(Vec3::new(x, y, -Scalar::from_num(way)));
    Vec3::new(eye.x + aside.x, eye.y + aside.y, eye.z + aside.z)
}

/// A lens, and the size of a pixel in units by the distance.
fn are_copies<S: Subpixel, P: Projection>(lens: P, pixel: impl Fn(f64) -> f64) {
    const VIEWPORT: Rectangle = area(3, -2, 61, 48);
    let eye = Vec3::lit("0.3", "-1.2", "2.5");
    let turn = |fraction: u32| Turn::fraction(fraction, 97);
    for number in 0..97 {
        let rotation = Rotation::about_y(turn(number * 31)) * Rotation::about_x(turn(number * 17));
        let camera = Camera::at(eye, rotation, lens, VIEWPORT).unwrap();
        let way = 0.6 + f64::from(number * 13 % 97) / 10.0;
        // Some are cut by the picture's edges.
        let at = [number * 29 % 67, number * 7 % 53].map(|i| i as i32 - 30);
        let pose = Pose::facing(&camera, point(eye, rotation, at, pixel(way), way));
        let pose = pose.in_pixels(&camera, Distance::ONE);
        for (mesh, below) in [(&CENTERED, H as i32 / 2), (&STANDING, 0)] {
            let mut color = [BACKGROUND; 61 * 48];
            let mut frame = Frame::without_depth(&mut color, VIEWPORT).unwrap();
            let card = Object::new(mesh, Textured::new(&PICTURES).corrected(Affine)).posed(pose);
            let mut corners = [ScreenVertex::<S, NoDepth, _>::EMPTY; 4];
            card.draw(&camera, &mut corners, &mut frame).unwrap();
            let (left, top) = (30 + at[0] - W as i32 / 2, 24 - at[1] + below - H as i32);
            for (index, got) in color.iter().enumerate() {
                let [column, row] = [index as i32 % 61 - left, index as i32 / 61 - top];
                let is_inside = (0..W as i32).contains(&column) && (0..H as i32).contains(&row);
                let texel = if is_inside { (row * W as i32 + column) as usize } else { 0 };
                let want = if TEXELS[texel] == TEXELS[0] { BACKGROUND } else { TEXELS[texel] };
                assert_eq!(*got, want, "texel {column}, {row} of {way} from {rotation:?}");
            }
        }
    }
}

#[test]
fn a_card_with_a_texel_a_pixel_is_a_copy_of_its_texture() {
    let [near, far] = ["0.5", "50"].map(Distance::lit);
    let perspective = Perspective::with_focal_length(Distance::lit("50"), near, far).unwrap();
    are_copies::<S4, _>(perspective, |way| way / 50.0);
    are_copies::<S8, _>(perspective, |way| way / 50.0);
    let parallel = Orthographic::new(Distance::lit("6"), near, far).unwrap();
    are_copies::<S4, _>(parallel, |_| 6.0 / 48.0);
    are_copies::<S8, _>(parallel, |_| 6.0 / 48.0);
}

/// Cards of many sizes in front of the camera, beside it and behind it.
fn poses(camera: &Camera<Perspective>) -> Vec<Pose> {
    let mut random = Random::new(5);
    let mut number = |reach: f64| f64::from(random.bits() as i16) / 32_768.0 * reach;
    (0..60)
        .map(|i| {
            let [x, y, z] = [number(2.0), number(1.5), number(4.0)].map(Scalar::from_num);
            let pose = Pose::facing(camera, Vec3::new(x, y, z));
            let size = Distance::from_num(number(1.0).abs());
            if i % 2 == 0 { pose.scaled(size / 24) } else { pose.in_pixels(camera, size * 2) }
        })
        .collect()
}

fn card() -> Object<'static, Textured<'static, Picture, Nearest, Affine>> {
    Object::new(&STANDING, Textured::new(&PICTURES).corrected(Affine))
}

#[test]
fn bands_and_the_display_itself_equal_the_whole_frame() {
    fn check<D: Depth>() -> Screen<Rgb888> {
        let camera = at("3", DISPLAY);
        let poses = poses(&camera);
        let draw = |rows| {
            picture::<D>(rows, |band| {
                let mut corners = [ScreenVertex::<S8, D, _>::EMPTY; 4];
                poses.iter().for_each(|&pose| {
                    card().posed(pose).draw(&camera, &mut corners, band).unwrap();
                });
                Ok(())
            })
        };
        let whole = draw(ROWS);
        assert!((900..1_600).contains(&whole.drawn(BACKGROUND).len()));
        for rows in [1, 5, 16] {
            assert!(whole == draw(rows), "{rows} rows");
        }
        let on_demand = picture::<D>(ROWS, |band| {
            poses.iter().try_for_each(|&pose| {
                let card = card().posed(pose).project_on_demand::<_, S8, D>(&camera, S8);
                card.unwrap().draw(band)
            })
        });
        assert!(whole == on_demand);
        whole
    }
    let whole = check::<NoDepth>();
    check::<u16>();
    check::<u32>();
    check::<FloatDepth>();

    let camera = at("3", DISPLAY);
    let mut screen = Screen::new(DISPLAY);
    screen.pixels.fill(Some(BACKGROUND));
    let mut corners = [ScreenVertex::<S8, NoDepth, _>::EMPTY; 4];
    for pose in poses(&camera) {
        let card = card().posed(pose);
        card.draw(&camera, &mut corners, &mut Direct::new(&mut screen)).unwrap();
    }
    assert!(whole == screen);
}
