//! What the core promises, as pictures that a person can check by eye.
//!
//! A pixel is a character: a triangle's letter, a grey's brightness in tenths, or a dot for the
//! background. Places are pixels from the display's upper left corner: pixel (i, j), which is
//! column i of row j, has its centre at (i + 1/2, j + 1/2).

use std::convert::Infallible;

use embedded_graphics::{
    pixelcolor::{Rgb888, RgbColor},
    primitives::Rectangle,
};
use rasterizer::{
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{
        ClipAll, ClipNone, Clipping, CullBack, CullFront, CullNone, Culling, Projection,
        ScreenVertex,
    },
    mesh::{Mesh, Normals, Tables},
    numbers::{Rotation, S8, Vec3},
    output::{Bands, Frame},
    scene::Object,
    shade::{Flat, Gouraud, Level, Light, Unlit},
};
use rasterizer_tests::{Picture, Surface, area, bands::Screen, pixel_camera};

const DISPLAY: Rectangle = area(0, 0, 24, 12);
const BACKGROUND: Rgb888 = Rgb888::new(b'.', 0, 0);

/// Draws unlit surfaces in their order.
fn draw<P: Projection>(
    frame: &mut Frame<'_, Rgb888, &mut [u16]>,
    surfaces: &[Surface],
    camera: &Camera<P>,
    culling: impl Culling,
    clipping: impl Clipping,
) -> Result<(), Infallible> {
    for surface in surfaces {
        let mesh = surface.mesh();
        let mut vertices = vec![ScreenVertex::<S8, _, _>::EMPTY; mesh.vertex_count()];
        Object::new(&mesh, Unlit::new())
            .culled(culling)
            .clipped(clipping)
            .draw(camera, &mut vertices, frame)
            .unwrap();
    }
    Ok(())
}

/// The picture of unlit surfaces, as text.
fn seen<P: Projection>(
    surfaces: &[Surface],
    camera: &Camera<P>,
    culling: impl Culling,
    clipping: impl Clipping,
) -> String {
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    let mut frame = Frame::new(&mut picture.color, &mut picture.depth, DISPLAY).unwrap();
    let Ok(()) = draw(&mut frame, surfaces, camera, culling, clipping);
    text(picture.color)
}

/// The same from straight above, with both sides of all surfaces.
fn seen_from_above(surfaces: &[Surface]) -> String {
    seen(surfaces, &pixel_camera(DISPLAY), CullNone, ClipAll)
}

fn text(pixels: impl IntoIterator<Item = Rgb888>) -> String {
    // A letter's colour is red alone, a lit white surface is grey.
    let character = |color: Rgb888| match (color.r(), color.g()) {
        (name, 0) if name > 0 => char::from(name),
        (brightness, _) => char::from(b'0' + (u32::from(brightness) * 10 / 256) as u8),
    };
    let characters: Vec<char> = pixels.into_iter().map(character).collect();
    let rows = characters.chunks(DISPLAY.size.width as usize);
    rows.flat_map(|row| row.iter().chain(&['\n'])).collect()
}

/// Compares with a picture that is indented like the code around it.
#[track_caller]
fn assert_shows(drawn: &str, expected: &str) {
    let expected: String = expected.trim().lines().flat_map(|row| [row.trim(), "\n"]).collect();
    assert!(drawn == expected, "expected\n{expected}drawn\n{drawn}");
}

/// A convex polygon with its corners in world coordinates, which are whole or end in a half.
fn polygon(name: char, corners: &[[f64; 3]]) -> Surface {
    let positions = corners.iter().map(|corner| corner.map(|c| (2.0 * c) as i16)).collect();
    let triangles = (2..corners.len() as u16).map(|corner| [0, corner - 1, corner]).collect();
    Surface::new(positions, triangles).scaled(-1).colored([name as u8, 0, 0])
}

/// A convex polygon with its corners in columns, rows and heights over the display, as
/// [`pixel_camera`] shows them. Higher is nearer.
fn raised(name: char, corners: &[[f64; 3]]) -> Surface {
    let corners: Vec<_> = corners.iter().map(|[x, y, z]| [x - 12.0, 6.0 - y, *z]).collect();
    polygon(name, &corners)
}

fn flat(name: char, corners: &[[f64; 2]]) -> Surface {
    let corners: Vec<_> = corners.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
    raised(name, &corners)
}

fn rectangle(name: char, [left, top]: [f64; 2], [right, bottom]: [f64; 2]) -> Surface {
    flat(name, &[[left, top], [left, bottom], [right, bottom], [right, top]])
}

/// Four triangles that share edges and, on the centre of pixel (11, 5), a corner. There is no gap
/// between them, and no overlap: in reverse order another letter would stay on a pixel drawn twice.
#[test]
fn triangles_that_share_edges_share_no_pixel() {
    let hub = [11.5, 5.5];
    let mut triangles = [
        flat('A', &[[2.0, 1.0], [2.0, 11.0], hub]),
        flat('B', &[[2.0, 11.0], [22.0, 11.0], hub]),
        flat('C', &[[22.0, 11.0], [22.0, 1.0], hub]),
        flat('D', &[[22.0, 1.0], [2.0, 1.0], hub]),
    ];
    for _ in 0..2 {
        assert_shows(
            &seen_from_above(&triangles),
            "
            ........................
            ..ADDDDDDDDDDDDDDDDDDC..
            ..AAADDDDDDDDDDDDDCCCC..
            ..AAAAADDDDDDDDDCCCCCC..
            ..AAAAAAADDDDDCCCCCCCC..
            ..AAAAAAAAACCCCCCCCCCC..
            ..AAAAAAAABBBCCCCCCCCC..
            ..AAAAAABBBBBBBCCCCCCC..
            ..AAAABBBBBBBBBBBCCCCC..
            ..AAABBBBBBBBBBBBBBCCC..
            ..ABBBBBBBBBBBBBBBBBBC..
            ........................
            ",
        );
        triangles.reverse();
    }
}

/// All edges run through pixel centres. A centre on a left or top edge is covered (columns 4 and
/// 10, rows 2 and 6), one on a right or bottom edge is not (column 16, row 10).
#[test]
fn centres_on_left_and_top_edges_are_covered() {
    let mut rectangles = [
        rectangle('A', [4.5, 2.5], [10.5, 6.5]),
        rectangle('B', [10.5, 2.5], [16.5, 6.5]),
        rectangle('C', [4.5, 6.5], [16.5, 10.5]),
    ];
    for _ in 0..2 {
        assert_shows(
            &seen_from_above(&rectangles),
            "
            ........................
            ........................
            ....AAAAAABBBBBB........
            ....AAAAAABBBBBB........
            ....AAAAAABBBBBB........
            ....AAAAAABBBBBB........
            ....CCCCCCCCCCCC........
            ....CCCCCCCCCCCC........
            ....CCCCCCCCCCCC........
            ....CCCCCCCCCCCC........
            ........................
            ........................
            ",
        );
        rectangles.reverse();
    }
}

/// The triangle N is drawn first and stays before the rectangle F, which is farther away. F and the
/// rectangle T lie at the same depth: F is drawn first and stays.
fn near_far_and_tie() -> [Surface; 3] {
    [
        raised('N', &[[9.0, 1.0, 1.0], [3.0, 10.0, 1.0], [15.0, 10.0, 1.0]]),
        rectangle('F', [2.0, 3.0], [16.0, 11.0]),
        rectangle('T', [12.0, 5.0], [22.0, 9.0]),
    ]
}

const NEAR_FAR_AND_TIE: &str = "
    ........................
    ........................
    ........NN..............
    ..FFFFFNNNNFFFFF........
    ..FFFFFNNNNFFFFF........
    ..FFFFNNNNNNFFFFTTTTTT..
    ..FFFNNNNNNNNFFFTTTTTT..
    ..FFFNNNNNNNNFFFTTTTTT..
    ..FFNNNNNNNNNNFFTTTTTT..
    ..FNNNNNNNNNNNNF........
    ..FFFFFFFFFFFFFF........
    ........................
";

#[test]
fn nearer_pixels_stay_and_the_first_wins_a_tie() {
    assert_shows(&seen_from_above(&near_far_and_tie()), NEAR_FAR_AND_TIE);
}

/// Bands of all heights, also such that the last is cut.
#[test]
fn bands_show_the_picture_of_the_frame() {
    for rows in 1..=12 {
        let pixels = rows * DISPLAY.size.width as usize;
        let (mut color, mut depth) = (vec![BACKGROUND; pixels], vec![0u16; pixels]);
        let mut screen = Screen::new(DISPLAY);
        let mut bands = Bands::new(DISPLAY, &mut color[..], &mut depth[..]).unwrap();
        let Ok(()) = bands.show(
            &mut screen,
            |band| band.clear_color(BACKGROUND),
            |band| draw(band, &near_far_and_tie(), &pixel_camera(DISPLAY), CullNone, ClipAll),
        );
        assert_shows(&text(screen.pixels.into_iter().flatten()), NEAR_FAR_AND_TIE);
    }
}

/// A rises to the right, B to the left. They cross in the middle, between columns 11 and 12.
#[test]
fn depth_decides_pixel_by_pixel() {
    let planes = [
        raised('A', &[[2.0, 1.0, -9.0], [2.0, 8.0, -9.0], [22.0, 8.0, 9.0], [22.0, 1.0, 9.0]]),
        raised('B', &[[2.0, 4.0, 9.0], [2.0, 11.0, 9.0], [22.0, 11.0, -9.0], [22.0, 4.0, -9.0]]),
    ];
    assert_shows(
        &seen_from_above(&planes),
        "
        ........................
        ..AAAAAAAAAAAAAAAAAAAA..
        ..AAAAAAAAAAAAAAAAAAAA..
        ..AAAAAAAAAAAAAAAAAAAA..
        ..BBBBBBBBBBAAAAAAAAAA..
        ..BBBBBBBBBBAAAAAAAAAA..
        ..BBBBBBBBBBAAAAAAAAAA..
        ..BBBBBBBBBBAAAAAAAAAA..
        ..BBBBBBBBBBBBBBBBBBBB..
        ..BBBBBBBBBBBBBBBBBBBB..
        ..BBBBBBBBBBBBBBBBBBBB..
        ........................
        ",
    );
}

/// From the origin along -z, four pixels for a unit at distance 1, and a near plane there.
fn perspective(focal_length: &str) -> Camera<Perspective> {
    let distance = |text: &str| text.parse::<Distance>().unwrap();
    let lens =
        Perspective::with_focal_length(distance(focal_length), distance("1"), distance("2000"))
            .unwrap();
    Camera::at(Vec3::ZERO, Rotation::IDENTITY, lens, DISPLAY).unwrap()
}

/// A road 4 units wide and 1 unit below the camera, from the horizon to behind the camera. At
/// distance z it lies 4 / z rows below the middle and is 16 / z columns wide: 2, 6, 10 and 14 in
/// rows 6 to 9. The near plane cuts it at z = 1, between rows 9 and 10.
#[test]
fn the_near_plane_cuts_a_road() {
    let (left, right) = (-2.0, 2.0);
    let road = polygon(
        'R',
        &[[left, -1.0, 9.0], [right, -1.0, 9.0], [right, -1.0, -1500.0], [left, -1.0, -1500.0]],
    );
    assert_shows(
        &seen(&[road], &perspective("4"), CullBack, ClipAll),
        "
        ........................
        ........................
        ........................
        ........................
        ........................
        ........................
        ...........RR...........
        .........RRRRRR.........
        .......RRRRRRRRRR.......
        .....RRRRRRRRRRRRRR.....
        ........................
        ........................
        ",
    );
}

/// G reaches far beyond the guard band of 1,024 pixels and is cut there; what the display shows of
/// it lies below a line through the middle that rises by a row in two columns. Without clipping G
/// is left out as a whole. S stays between the planes and is drawn in both ways.
#[test]
fn the_guard_band_cuts_a_triangle_or_leaves_it_out() {
    let (middle, far) = ([12.0, 6.0], 3000.0);
    let triangles = [
        flat('S', &[[1.0, 1.0], [3.0, 7.0], [8.0, 2.0]]),
        flat(
            'G',
            &[
                [middle[0] - far, middle[1] + far / 2.0],
                [middle[0] + far, middle[1] + far],
                [middle[0] + far, middle[1] - far / 2.0],
            ],
        ),
    ];
    let camera = pixel_camera(DISPLAY);
    assert_shows(
        &seen(&triangles, &camera, CullBack, ClipAll),
        "
        .......................G
        .SSS.................GGG
        .SSSSSS............GGGGG
        ..SSSS...........GGGGGGG
        ..SSS..........GGGGGGGGG
        ..SS.........GGGGGGGGGGG
        ...........GGGGGGGGGGGGG
        .........GGGGGGGGGGGGGGG
        .......GGGGGGGGGGGGGGGGG
        .....GGGGGGGGGGGGGGGGGGG
        ...GGGGGGGGGGGGGGGGGGGGG
        .GGGGGGGGGGGGGGGGGGGGGGG
        ",
    );
    assert_shows(
        &seen(&triangles, &camera, CullBack, ClipNone),
        "
        ........................
        .SSS....................
        .SSSSSS.................
        ..SSSS..................
        ..SSS...................
        ..SS....................
        ........................
        ........................
        ........................
        ........................
        ........................
        ........................
        ",
    );
}

/// The corners of F run counter-clockwise on the screen: its front is seen. Those of B run
/// clockwise.
#[test]
fn culling_leaves_one_side_out() {
    let triangles = [
        flat('F', &[[2.0, 1.0], [2.0, 11.0], [11.0, 6.0]]),
        flat('B', &[[22.0, 1.0], [22.0, 11.0], [13.0, 6.0]]),
    ];
    let camera = pixel_camera(DISPLAY);
    let both = "
        ........................
        ..F..................B..
        ..FFF..............BBB..
        ..FFFF...........BBBBB..
        ..FFFFFF........BBBBBB..
        ..FFFFFFFF....BBBBBBBB..
        ..FFFFFFFF....BBBBBBBB..
        ..FFFFFF........BBBBBB..
        ..FFFF...........BBBBB..
        ..FFF..............BBB..
        ..F..................B..
        ........................
    ";
    assert_shows(&seen(&triangles, &camera, CullNone, ClipAll), both);
    assert_shows(&seen(&triangles, &camera, CullBack, ClipAll), &both.replace('B', "."));
    assert_shows(&seen(&triangles, &camera, CullFront, ClipAll), &both.replace('F', "."));
}

/// N and F are 8 units wide. In parallel both take 8 pixels at any distance. In
/// perspective, with a focal length of 8 pixels, N at distance 8 takes 8 pixels and F at distance
/// 16 takes 4, half as far from the middle.
#[test]
fn perspective_makes_far_things_small() {
    let square = |name: char, x: f64, z: f64| {
        polygon(
            name,
            &[[x - 4.0, 4.0, z], [x - 4.0, -4.0, z], [x + 4.0, -4.0, z], [x + 4.0, 4.0, z]],
        )
    };
    let squares = [square('N', -6.0, -8.0), square('F', 6.0, -16.0)];
    assert_shows(
        &seen(&squares, &pixel_camera(DISPLAY), CullBack, ClipAll),
        "
        ........................
        ........................
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ..NNNNNNNN....FFFFFFFF..
        ........................
        ........................
        ",
    );
    assert_shows(
        &seen(&squares, &perspective("8"), CullBack, ClipAll),
        "
        ........................
        ........................
        ..NNNNNNNN..............
        ..NNNNNNNN..............
        ..NNNNNNNN...FFFF.......
        ..NNNNNNNN...FFFF.......
        ..NNNNNNNN...FFFF.......
        ..NNNNNNNN...FFFF.......
        ..NNNNNNNN..............
        ..NNNNNNNN..............
        ........................
        ........................
        ",
    );
}

/// The normals at the corners point away from the middle, 4/5 of them along x, where the light
/// comes from: level 0 at the left corners, which face away, and 0.8 at the right ones, 16 columns
/// further. That is half a tenth a column.
#[test]
fn gouraud_shading_is_a_ramp() {
    let sheet = rectangle('W', [4.0, 0.0], [20.0, 12.0]).colored([255; 3]).with_vertex_normals();
    let light = Light::new(Vec3::X, Level::ZERO, Level::ONE);
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    picture.draw(&sheet.mesh(), Gouraud::new(light), &pixel_camera(DISPLAY));
    assert_shows(&text(picture.color), &"....0011223344556677....\n".repeat(12));
}

/// The light comes from (2, 6, 3) / 7: the sides towards x, y and z get 2/7, 6/7 and 3/7 of it,
/// which is 2, 8 and 4 tenths.
#[test]
fn flat_shading_gives_a_cube_three_shades() {
    let cube = Surface::cube(7, 1).scaled(-1).colored([255; 3]);
    // Two triangles a side, in the order of the axes, the positive side first.
    let normals: Vec<[i8; 3]> = (0..12)
        .map(|triangle| {
            let mut normal = [0; 3];
            normal[triangle / 4] = if triangle % 4 < 2 { 127 } else { -127 };
            normal
        })
        .collect();
    let mesh =
        Mesh::new(Tables { face_normals: Normals::I8(&normals), ..*cube.mesh().tables() }).unwrap();
    let lens = Orthographic::new(Distance::lit("12"), Distance::ONE, Distance::lit("100")).unwrap();
    let eye = Vec3::lit("20", "20", "30");
    let camera = Camera::look_at(eye, Vec3::ZERO, Vec3::Y, lens, DISPLAY).unwrap();
    let light = Light::new(Vec3::lit("2", "6", "3"), Level::ZERO, Level::ONE);
    let mut picture = Picture::<_, u16>::empty(DISPLAY, BACKGROUND);
    picture.draw(&mesh, Flat::new(light), &camera);
    assert_shows(
        &text(picture.color),
        "
        ........................
        ..........8888..........
        ........888888888.......
        .......8888888822.......
        .......4444888222.......
        .......4444442222.......
        .......4444442222.......
        .......4444442222.......
        .......4444442222.......
        .......444444222........
        ..........4442..........
        ........................
        ",
    );
}
