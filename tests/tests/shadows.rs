//! Shadows on a plane, each pixel once: a pixel is dark if a ray from its point of the floor
//! towards the light meets the object, and bands and every storage of vertices draw the same.

use core::cell::Cell;

use embedded_graphics::pixelcolor::{Rgb888, RgbColor as _};
use rasterizer::{
    attribute::{FloatDepth, NoDepth},
    camera::{Camera, Distance, Perspective},
    color::Alpha,
    geometry::{CullNone, LampShadow, PlanarShadow, Plane, Pose, ScreenVertex},
    mesh::Mesh,
    numbers::{Rotation, S4, S8, Scalar, Subpixel, Turn, Vec3},
    output::{Add, KeepDepth, Once},
    scene::Object,
    shade::Unlit,
};
use rasterizer_tests::{
    Surface,
    bands::{BACKGROUND, DISPLAY, Depth, ROWS, Screen, picture},
    exact::{numbers, quantum, rotated},
    vector::{Vector, cross, dot, minus},
};

/// What a view shows: an object that casts its shadow in the light from `toward`.
struct View {
    eye: Vec3,
    /// How far the camera looks downwards, in degrees.
    down: u32,
    toward: Vec3,
    place: Vec3,
}

/// From above; from the side, with a shadow that leaves the picture; with an object that the floor
/// cuts; with a shadow behind the camera, which the near plane cuts.
const VIEWS: [View; 4] = [
    View {
        eye: Vec3::lit("0.1", "2", "3"),
        down: 35,
        toward: Vec3::lit("0.3", "2", "-0.4"),
        place: Vec3::lit("0.2", "0.1", "0"),
    },
    View {
        eye: Vec3::lit("-0.3", "0.7", "4"),
        down: 20,
        toward: Vec3::lit("-1.5", "1", "0.4"),
        place: Vec3::lit("-0.4", "0.2", "0.6"),
    },
    View {
        eye: Vec3::lit("0.2", "1.5", "3.5"),
        down: 30,
        toward: Vec3::lit("1", "1.5", "0.2"),
        place: Vec3::lit("-0.1", "-1.1", "-0.2"),
    },
    View {
        eye: Vec3::lit("0.1", "-0.4", "1"),
        down: 25,
        toward: Vec3::lit("0.2", "1.3", "-2.5"),
        place: Vec3::lit("0", "0.3", "-0.6"),
    },
];

const FLOOR: Plane = Plane::new(Vec3::lit("0.125", "2", "-0.25"), Scalar::lit("2"));
/// The focal length in pixels.
const FOCAL: f64 = 50.0;
/// The near distance in units.
const NEAR: f64 = 0.25;

impl View {
    fn rotation(&self) -> Rotation {
        Rotation::about_x(-Turn::degrees(self.down))
    }

    fn camera(&self) -> Camera<Perspective> {
        let [focal, near, far] = [FOCAL, NEAR, 100.0].map(Distance::from_num);
        let lens = Perspective::with_focal_length(focal, near, far).unwrap();
        Camera::at(self.eye, self.rotation(), lens, DISPLAY).unwrap()
    }

    fn object<'a>(&self, mesh: &'a Mesh<'a>) -> Object<'a, Unlit<Rgb888>> {
        let pose = Pose::rotated(Rotation::about_z(Turn::degrees(50))).at(self.place);
        Object::new(mesh, Unlit::new()).posed(pose.scaled(Distance::lit("0.9")))
    }

    /// Where the ray of a point of the picture meets the floor; `None` beyond the horizon.
    fn on_floor(&self, x: f64, y: f64) -> Option<Vector> {
        let middle = [DISPLAY.size.width, DISPLAY.size.height].map(|side| f64::from(side) / 2.0);
        let ray = [(x - middle[0]) / FOCAL, (middle[1] - y) / FOCAL, -1.0];
        let direction = rotated(&self.rotation(), ray);
        let (eye, normal) = (numbers(self.eye), numbers(FLOOR.normal));
        let height = dot(normal, eye) + FLOOR.offset.to_num::<f64>();
        let way = -height / dot(normal, direction);
        // Along the view axis.
        (way > NEAR).then(|| [0, 1, 2].map(|i| eye[i] + way * direction[i]))
    }
}

/// Whether a ray meets a triangle (Moeller and Trumbore 1997).
fn meets(origin: Vector, direction: Vector, [a, b, c]: [Vector; 3]) -> bool {
    let (ab, ac, ao) = (minus(b, a), minus(c, a), minus(origin, a));
    let p = cross(direction, ac);
    let determinant = dot(ab, p);
    let q = cross(ao, ab);
    let (u, v) = (dot(ao, p) / determinant, dot(direction, q) / determinant);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && dot(ac, q) / determinant > 0.0
}

/// The mesh's triangles in the world.
fn triangles(mesh: &Mesh<'_>, pose: Pose) -> Vec<[Vector; 3]> {
    let tables = mesh.tables();
    let (place, size) =
        (numbers(pose.translation), pose.scale.to_num::<f64>() * quantum(tables.scale));
    let corner = |vertex| {
        let position = tables.positions.get(vertex).unwrap().map(f64::from);
        let turned = rotated(&pose.rotation, position);
        [0, 1, 2].map(|i| turned[i] * size + place[i])
    };
    (0..mesh.triangle_count()).map(|i| tables.triangles.get(i).unwrap().map(corner)).collect()
}

/// A ball that adds 1 to a pixel's red.
fn ball() -> Surface {
    Surface::ball(16_384, 7).scaled(-14).colored([1, 0, 0])
}

/// The picture of its shadow.
fn drawn<S: Subpixel, D: Depth>(view: &View, mesh: &Mesh<'_>, rows: u32) -> Screen<Rgb888> {
    let camera = view.camera();
    let shadow = view.object(mesh).clipped(PlanarShadow::new(FLOOR, view.toward)).culled(CullNone);
    let shadow = shadow.blended(KeepDepth(Add(Alpha::OPAQUE)));
    let bits = vec![Cell::new(0); Once::<()>::words((DISPLAY.size.width * rows) as usize)];
    let mut storage = vec![ScreenVertex::<S, D, _>::EMPTY; mesh.vertex_count()];
    let kept = shadow.project(&camera, &mut storage).unwrap();
    let kept = picture::<D>(rows, |band| kept.draw(&mut Once::new(band, &bits).unwrap()));
    let on_demand = shadow.project_on_demand::<_, S, D>(&camera, S::default()).unwrap();
    let on_demand = picture::<D>(rows, |band| on_demand.draw(&mut Once::new(band, &bits).unwrap()));
    assert!(kept == on_demand, "{rows} rows from {:?}", view.eye);
    kept
}

/// Compares each pixel with eight points round its centre: `is_dark` tells whether the light
/// reaches one. Returns how many are dark, and light, and have both.
fn judged(
    view: &View,
    screen: &Screen<Rgb888>,
    reach: f64,
    is_dark: impl Fn(f64, f64) -> bool,
) -> [usize; 3] {
    let [mut dark, mut light, mut left] = [0; 3];
    for (index, pixel) in screen.pixels.iter().enumerate() {
        let [x, y] = [index % DISPLAY.size.width as usize, index / DISPLAY.size.width as usize]
            .map(|i| i as f64 + 0.5);
        let around = (0..8).filter(|&i| {
            let (sine, cosine) = (f64::from(i) * core::f64::consts::FRAC_PI_4).sin_cos();
            is_dark(x + reach * cosine, y + reach * sine)
        });
        let want = match around.count() {
            0 => BACKGROUND,
            8 => Rgb888::new(BACKGROUND.r() + 1, BACKGROUND.g(), BACKGROUND.b()),
            _ => {
                left += 1;
                continue;
            }
        };
        *if want == BACKGROUND { &mut light } else { &mut dark } += 1;
        assert_eq!(*pixel, Some(want), "at {x}, {y} from {:?}", view.eye);
    }
    println!("from {:?}: {dark} dark, {light} light, {left} left", view.eye);
    [dark, light, left]
}

/// A vertex is 0.6 sub-pixels from where the light puts it in each direction, at most: a pixel is
/// judged if the light reaches none of eight points at 0.9 sub-pixels round its centre, or all of
/// them.
#[test]
fn dark_pixels_are_those_that_the_light_does_not_reach() {
    fn check<S: Subpixel>() {
        let reach = 0.9 / f64::from(1 << S::BITS);
        let ball = ball();
        let mesh = ball.mesh();
        for view in &VIEWS {
            let triangles = triangles(&mesh, *view.object(&mesh).pose());
            let toward = numbers(view.toward);
            let is_dark = |x: f64, y: f64| {
                view.on_floor(x, y).is_some_and(|point| {
                    triangles.iter().any(|&triangle| meets(point, toward, triangle))
                })
            };
            let screen = drawn::<S, NoDepth>(view, &mesh, ROWS);
            let [dark, light, left] = judged(view, &screen, reach, is_dark);
            assert!(dark > 150 && light > 1_500 && left < 12, "{dark} {light} {left}");
        }
    }
    check::<S4>();
    check::<S8>();
}

#[test]
fn bands_and_every_depth_draw_the_same() {
    let ball = ball();
    let mesh = ball.mesh();
    for view in &VIEWS {
        let whole = drawn::<S8, u16>(view, &mesh, ROWS);
        assert!(whole.drawn(BACKGROUND).len() > 150);
        for rows in [1, 5, 16] {
            assert!(whole == drawn::<S8, u16>(view, &mesh, rows), "{rows} from {:?}", view.eye);
        }
        assert!(whole == drawn::<S8, NoDepth>(view, &mesh, 7), "no depth from {:?}", view.eye);
        assert!(whole == drawn::<S8, FloatDepth>(view, &mesh, 7), "float from {:?}", view.eye);
    }
}

/// Where the lamp of a view is: on the way to its far light.
fn lamp(view: &View) -> Vec3 {
    let at = |place: Scalar, toward: Scalar| place + toward * 2;
    let (place, toward) = (view.place, view.toward);
    Vec3::new(at(place.x, toward.x), at(place.y, toward.y), at(place.z, toward.z))
}

/// The picture of a shadow in the light of a lamp.
fn cast<S: Subpixel, D: Depth>(view: &View, mesh: &Mesh<'_>, rows: u32) -> Screen<Rgb888> {
    let mut positions = vec![[0; 3]; mesh.vertex_count()];
    let pose = *view.object(mesh).pose();
    let shadow = LampShadow::new(mesh, &pose, FLOOR, lamp(view), &mut positions).unwrap();
    let object = Object::new(shadow.mesh(), Unlit::new()).posed(*shadow.pose()).culled(CullNone);
    let object = object.clipped(shadow.clipping()).blended(KeepDepth(Add(Alpha::OPAQUE)));
    let bits = vec![Cell::new(0); Once::<()>::words((DISPLAY.size.width * rows) as usize)];
    let mut storage = vec![ScreenVertex::<S, D, _>::EMPTY; mesh.vertex_count()];
    let seen = object.project(&view.camera(), &mut storage).unwrap();
    picture::<D>(rows, |band| seen.draw(&mut Once::new(band, &bits).unwrap()))
}

/// As in the light of a far source, with rays to the lamp. The shadow's vertices are rounded to a
/// 2^-15th of half its longer side, here of 2 units at most, and to 2^-15 units: at the distances
/// of these views, of 1 unit at least, to 1/200 of a pixel.
#[test]
fn dark_pixels_are_those_that_the_lamp_does_not_reach() {
    fn check<S: Subpixel>(views: &[usize]) {
        let reach = 0.9 / f64::from(1 << S::BITS) + 0.005;
        let ball = ball();
        let mesh = ball.mesh();
        for view in views.iter().map(|&index| &VIEWS[index]) {
            let triangles = triangles(&mesh, *view.object(&mesh).pose());
            let lamp = numbers(lamp(view));
            let is_dark = |x: f64, y: f64| {
                view.on_floor(x, y).is_some_and(|point| {
                    let toward = [0, 1, 2].map(|i| lamp[i] - point[i]);
                    triangles.iter().any(|&triangle| meets(point, toward, triangle))
                })
            };
            let screen = cast::<S, NoDepth>(view, &mesh, ROWS);
            let [dark, light, left] = judged(view, &screen, reach, is_dark);
            assert!(dark > 150 && light > 1_000 && left < 16, "{dark} {light} {left}");
            // Another shadow than that of a far light.
            let far = drawn::<S, NoDepth>(view, &mesh, ROWS);
            let other = far.pixels.iter().zip(&screen.pixels).filter(|(a, b)| a != b).count();
            assert!(other > 10, "{other} from {:?}", view.eye);
            assert!(screen == cast::<S, NoDepth>(view, &mesh, 7), "in bands from {:?}", view.eye);
        }
    }
    check::<S4>(&[0, 1, 2, 3]);
    // S8 promises a sixteenth of the error. It refuses the longest shadow, which comes within some
    // near distances, and that under the camera.
    check::<S8>(&[0, 2]);
}
