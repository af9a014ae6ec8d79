//! Objects without clipping: a triangle that reaches beyond the near plane, the far plane or the
//! guard band is left out as a whole, and all others are drawn as with clipping.

use std::convert::Infallible;

use embedded_graphics::pixelcolor::Rgb888;
use rasterizer::{
    attribute::{DepthFormat, FloatDepth, NoDepth},
    camera::{Camera, Distance, Orthographic, Perspective},
    geometry::{ClipNone, CullBack, CullFront, CullNone, Culling, Projection, ScreenVertex},
    mesh::{Mesh, Triangles},
    numbers::{Rotation, S4, S8, Subpixel, Turn, Vec3},
    scene::{Object, bin_words},
    shade::Unlit,
};
use rasterizer_tests::{
    Surface,
    bands::{BACKGROUND, DISPLAY, Depth, EYES, Position, ROWS, at, ball, picture},
};

/// The triangles whose corners all have a place on the screen: their indices and their corners'.
fn whole<P: Projection>(mesh: &Mesh<'_>, camera: &Camera<P>) -> Vec<(usize, [u16; 3])> {
    let mut storage = vec![ScreenVertex::<S8, u16, [u16; 0]>::EMPTY; mesh.vertex_count()];
    let object = Object::new(mesh, Unlit::<Rgb888>::new()).clipped(ClipNone);
    let seen = object.project(camera, &mut storage).unwrap();
    let Triangles::U16(triangles) = mesh.tables().triangles else {
        panic!("surfaces have 16-bit indices")
    };
    let is_whole = |corners: &[u16; 3]| {
        let placed = |&corner: &u16| seen.vertices()[usize::from(corner)].position().is_some();
        corners.iter().all(placed)
    };
    let all = triangles.iter().copied().enumerate();
    all.filter(|(_, corners)| is_whole(corners)).collect()
}

/// Checks that the object without clipping, drawn in every possible way, equals a mesh of its whole
/// triangles with clipping. Returns how many triangles are left out, and how many pixels are drawn.
fn equals_the_mesh_of_whole_triangles<S, D, P, K>(
    mesh: &Mesh<'_>,
    camera: &Camera<P>,
    culling: K,
) -> [usize; 2]
where
    S: Subpixel,
    D: Depth + DepthFormat,
    P: Projection,
    K: Culling,
{
    let whole: Vec<_> = whole(mesh, camera).into_iter().map(|(_, corners)| corners).collect();
    let mut storage = vec![ScreenVertex::<S, D, [u16; 3]>::EMPTY; mesh.vertex_count()];
    let tables = mesh.tables();
    let left_out = mesh.triangle_count() - whole.len();
    let expected = if whole.is_empty() {
        picture::<D>(ROWS, |_| Ok(()))
    } else {
        let positions = (0..).map_while(|index| tables.positions.get(index)).collect();
        let mut rest = Surface::new(positions, whole);
        rest.scale = tables.scale;
        let mesh = rest.mesh();
        let object = Object::new(&mesh, Position).culled(culling);
        let seen = object.project(camera, &mut storage).unwrap();
        picture::<D>(ROWS, |frame| seen.draw(frame))
    };

    let object = Object::new(mesh, Position).culled(culling).clipped(ClipNone);
    let walked = object.project_on_demand(camera, S::default()).unwrap();
    let seen = object.project(camera, &mut storage).unwrap();
    assert!(!seen.is_outside_view());
    for rows in [ROWS, 16, 1] {
        assert!(expected == picture::<D>(rows, |band| seen.draw(band)), "{rows} rows");
        assert!(expected == picture::<D>(rows, |band| walked.draw(band)), "walked, {rows} rows");
        let mut bins = vec![0; bin_words(mesh.triangle_count(), ROWS, 16)];
        let binned = seen.binned(16, &mut bins).unwrap();
        assert!(expected == picture::<D>(rows, |band| binned.draw(band)), "binned, {rows} rows");
    }
    [left_out, expected.drawn(BACKGROUND).len()]
}

/// The whole ball is in view at first. From inside it, triangles cross the near plane and the guard
/// band.
#[test]
fn triangles_are_left_out_whole() {
    let ball = ball();
    let mesh = ball.mesh();
    let (mut left_out, mut drawn) = ([0; EYES.len()], [0; EYES.len()]);
    for (index, eye) in EYES.into_iter().enumerate() {
        let camera = at(eye, DISPLAY);
        for counts in [
            equals_the_mesh_of_whole_triangles::<S4, u16, _, _>(&mesh, &camera, CullNone),
            equals_the_mesh_of_whole_triangles::<S4, FloatDepth, _, _>(&mesh, &camera, CullBack),
            equals_the_mesh_of_whole_triangles::<S8, u32, _, _>(&mesh, &camera, CullFront),
            equals_the_mesh_of_whole_triangles::<S4, NoDepth, _, _>(&mesh, &camera, CullBack),
        ] {
            left_out[index] += counts[0];
            drawn[index] += counts[1];
        }
    }
    assert_eq!(left_out[..2], [0, 0], "the first two eyes see the whole ball");
    assert!(left_out[2..].iter().all(|&count| count >= 30), "{left_out:?}");
    assert!(drawn.iter().all(|&pixels| pixels > 500), "{drawn:?}");
}

/// An object that stays between the planes is drawn as with clipping, also if it lies partly or
/// wholly beside the picture.
#[test]
fn what_stays_inside_is_drawn_alike() {
    fn compare<P: Projection>(mesh: &Mesh<'_>, camera: &Camera<P>) -> usize {
        assert_eq!(whole(mesh, camera).len(), mesh.triangle_count());
        let mut storage = vec![ScreenVertex::<S8, u16, [u16; 3]>::EMPTY; mesh.vertex_count()];
        let object = Object::new(mesh, Position);
        let clipped = object.project(camera, &mut storage).unwrap();
        let expected = picture::<u16>(ROWS, |frame| clipped.draw(frame));
        let seen = object.clipped(ClipNone).project(camera, &mut storage).unwrap();
        assert!(expected == picture::<u16>(ROWS, |frame| seen.draw(frame)));
        assert!(expected == picture::<u16>(7, |frame| seen.draw(frame)));
        assert_eq!(seen.bounds().is_some(), expected != picture::<u16>(ROWS, |_| Ok(())));
        expected.drawn(BACKGROUND).len()
    }
    let ball = ball();
    let mesh = ball.mesh();
    let distance = |text: &str| text.parse::<Distance>().unwrap();
    let lens = Perspective::new(Turn::degrees(70), distance("0.25"), distance("10")).unwrap();
    let parallel = Orthographic::new(distance("2"), distance("0.25"), distance("10")).unwrap();
    for (x, pixels) in [("0", 500..900), ("2", 100..500), ("9", 0..1)] {
        let eye = Vec3::lit(x, "0", "2.5");
        let camera = Camera::at(eye, Rotation::IDENTITY, lens, DISPLAY).unwrap();
        let drawn = compare(&mesh, &camera);
        assert!(pixels.contains(&drawn), "{x}: {drawn}");
        let camera = Camera::at(eye, Rotation::IDENTITY, parallel, DISPLAY).unwrap();
        let drawn = compare(&mesh, &camera);
        assert_eq!(drawn == 0, pixels.contains(&0), "{x}: {drawn}");
    }
}

/// The whole triangles are visited once each, in order, with the same corners as with clipping.
#[test]
fn the_whole_triangles_are_visited() {
    let ball = ball();
    let mesh = ball.mesh();
    for eye in EYES {
        let camera = at(eye, DISPLAY);
        let visited =
            |visits: &mut Vec<_>, index: usize, corners: [&ScreenVertex<S4, u16, [u16; 0]>; 3]| {
                visits.push((index, corners.map(|&corner| corner)));
                Ok::<(), Infallible>(())
            };
        let object = Object::new(&mesh, Unlit::<Rgb888>::new()).culled(CullNone);
        let (mut cut, mut left) = (vec![], vec![]);
        let seen = object.project_on_demand(&camera, S4).unwrap();
        let Ok(()) = seen.for_each_triangle(|index, corners| visited(&mut cut, index, corners));
        let seen = object.clipped(ClipNone).project_on_demand(&camera, S4).unwrap();
        let Ok(()) = seen.for_each_triangle(|index, corners| visited(&mut left, index, corners));
        let whole: Vec<_> = whole(&mesh, &camera).into_iter().map(|(index, _)| index).collect();
        cut.retain(|(index, _)| whole.contains(index));
        assert_eq!(cut, left, "{eye}");
        assert!(left.len() > 100, "{eye}");
    }
}
