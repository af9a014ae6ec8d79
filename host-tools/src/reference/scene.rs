//! The end-to-end route: from a mesh in world space to the picture.

use super::camera::Camera;
use super::clip::{HalfSpace, ViewVertex, clip, clip_by};
use super::coverage::{Region, doubled_area, for_each_covered};
use super::interpolate::{
    in_perspective, linear, linear_each, linear_slope_each, slopes_in_perspective, weight_slopes,
};
use super::mesh::{Corner, Culling, Mesh};
use super::picture::{Canvas, Picture};
use super::sample::Sample;

/// Draws a mesh as `camera` sees it into a picture of `size` (width, height) pixels.
///
/// `varyings` returns what is interpolated from a corner: perspective-correct, that is, linear on
/// the surface in space. `shade` returns the colour of a sample, of any type, or `None` to discard
/// it.
///
/// Only pixels inside the camera's viewport are drawn. A fragment's depth is that of
/// [`ScreenPoint`](super::ScreenPoint), its triangle the index into [`Mesh::triangles`].
///
/// Rounding moves a depth, on its scale from 0 to 1, by some 1e-12, and a varying of that scale,
/// which is divided by the depth, by some 1e-12 times `w / near`: far below one step of a 16-bit
/// depth or an 8-bit colour. A depth may exceed 1 by a rounding.
///
/// # Panics
///
/// Panics if a triangle refers to a vertex that the mesh does not have.
#[must_use]
pub fn draw_scene<const N: usize, C: Copy>(
    camera: &Camera,
    mesh: &Mesh,
    culling: Culling,
    size: (usize, usize),
    varyings: impl Fn(Corner) -> [f64; N],
    shade: impl Fn(Sample<N>) -> Option<C>,
) -> Picture<C> {
    draw_clipped_scene(camera, mesh, &[], culling, size, varyings, shade)
}

/// [`draw_scene`] of the part of a mesh that lies inside all of some half spaces of the world.
///
/// # Panics
///
/// Panics if a triangle refers to a vertex that the mesh does not have.
#[must_use]
pub fn draw_clipped_scene<const N: usize, C: Copy>(
    camera: &Camera,
    mesh: &Mesh,
    sides: &[HalfSpace],
    culling: Culling,
    size: (usize, usize),
    varyings: impl Fn(Corner) -> [f64; N],
    shade: impl Fn(Sample<N>) -> Option<C>,
) -> Picture<C> {
    draw(camera, mesh, sides, culling, size, &varyings, &shade)
}

/// [`draw_clipped_scene`], compiled once for all its closures.
fn draw<const N: usize, C: Copy>(
    camera: &Camera,
    mesh: &Mesh,
    sides: &[HalfSpace],
    culling: Culling,
    size: (usize, usize),
    varyings: &dyn Fn(Corner) -> [f64; N],
    shade: &dyn Fn(Sample<N>) -> Option<C>,
) -> Picture<C> {
    let [columns, rows] = camera.viewport.pixels(size);
    let region = Region { columns, rows };
    let mut canvas = Canvas::new(size);
    for (triangle, vertices) in mesh.triangles.iter().enumerate() {
        let corners = vertices.map(|vertex| {
            let position = mesh.positions[vertex];
            ViewVertex { position, varyings: varyings(Corner { triangle, vertex, position }) }
        });
        let mut kept = clip_by(&corners, sides);
        for corner in &mut kept {
            corner.position = camera.to_view(corner.position);
        }
        let polygon = clip(&kept, camera.projection.depth_range());
        let points: Vec<_> =
            polygon.iter().map(|corner| camera.to_screen(corner.position)).collect();
        let outline: Vec<_> = points.iter().map(|point| [point.x, point.y]).collect();
        if culling == Culling::Back && !is_front(&outline) {
            continue;
        }
        for fan in (2..polygon.len()).map(|i| [0, i - 1, i]) {
            let depths = fan.map(|i| points[i].depth);
            let inverse_ws = fan.map(|i| points[i].inverse_w);
            let varyings = fan.map(|i| polygon[i].varyings);
            let corners = fan.map(|i| outline[i]);
            let slopes = weight_slopes(corners);
            for_each_covered(corners, &region, &mut |pixel, weights, span| {
                let [per_column, per_row] = slopes.map(|slopes| {
                    linear_slope_each(slopes_in_perspective(weights, slopes, inverse_ws), varyings)
                });
                let sample = Sample {
                    pixel,
                    span: [span.start, span.end - 1],
                    triangle,
                    depth: linear(weights, depths),
                    varyings: linear_each(in_perspective(weights, inverse_ws), varyings),
                    per_column,
                    per_row,
                };
                canvas.shade(sample, shade);
            });
        }
    }
    canvas.into_picture()
}

/// Whether a projected convex polygon shows its front: counter-clockwise for the viewer, which is a
/// negative area as y points down.
fn is_front(outline: &[[f64; 2]]) -> bool {
    let area: f64 =
        (2..outline.len()).map(|i| doubled_area([outline[0], outline[i - 1], outline[i]])).sum();
    area < 0.0
}

#[cfg(test)]
mod clipped;

#[cfg(test)]
mod tests {
    use super::super::camera::{Projection, Viewport};
    use super::super::lights::{Lights, Sun};
    use super::super::random::Random;
    use super::super::ray::{Hit, Ray, add, product, unit};
    use super::*;

    const SIZE: (usize, usize) = (48, 32);
    const VIEWPORT: Viewport = Viewport { x: 0.0, y: 0.0, width: 48.0, height: 32.0 };
    const PERSPECTIVE: Projection =
        Projection::Perspective { focal_length_px: 30.0, near: 0.5, far: 40.0 };
    const DARK_RED: [f64; 3] = [120.0, 40.0, 20.0];

    /// At the origin, looking along -z.
    fn camera(projection: Projection) -> Camera {
        Camera {
            eye: [0.0; 3],
            target: [0.0, 0.0, -1.0],
            up: [0.0, 1.0, 0.0],
            projection,
            viewport: VIEWPORT,
        }
    }

    /// A mesh without shared vertices: corner i of triangle n is vertex 3 n + i.
    fn mesh(triangles: &[[[f64; 3]; 3]]) -> Mesh {
        Mesh {
            positions: triangles.concat(),
            triangles: (0..triangles.len()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        }
    }

    fn quad([a, b, c, d]: [[f64; 3]; 4]) -> [[[f64; 3]; 3]; 2] {
        [[a, b, c], [c, d, a]]
    }

    /// In dark red, unlit.
    fn draw(camera: &Camera, mesh: &Mesh, culling: Culling) -> Picture {
        draw_scene(camera, mesh, culling, SIZE, |_| [], |_| Some(DARK_RED))
    }

    fn pixels() -> impl Iterator<Item = (usize, usize)> {
        (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y)))
    }

    /// Draws random triangles on all sides of random cameras and compares each pixel and triangle
    /// with its ray. The `N` varyings, three at most, are the colour. Returns the number of
    /// fragments, and of triangles that cross the near plane and that cross the far plane.
    fn compare_with_rays<const N: usize>(
        projection: Projection,
        culling: Culling,
        seed: u64,
    ) -> [usize; 3] {
        // An edge or plane may pass a centre at less than the rounding, where both answers are
        // right; and a surface seen nearly edge-on multiplies the rounding of its distance.
        const MARGIN: f64 = 1e-9;
        // Coordinates around 10 round at 2e-15, and a thin triangle multiplies that by its length
        // over its width. A varying comes from a division by the depth and inherits its error in
        // proportion.
        const TOLERANCE: f64 = 1e-11;
        let mut random = Random(seed);
        let mut vector = |reach: f64| [(); 3].map(|()| random.real(-reach, reach));
        let [near, far] = projection.depth_range();
        let mut tally = [0; 3];
        for _ in 0..20 {
            let camera = Camera {
                eye: vector(2.0),
                target: vector(2.0),
                up: vector(1.0),
                ..camera(projection)
            };
            let triangles: Vec<_> =
                (0..60).map(|_| [vector(12.0), vector(12.0), vector(12.0)]).collect();
            // Each varying at the three corners of each triangle.
            let varyings: Vec<_> =
                (0..60).map(|_| [(); N].map(|()| vector(0.25).map(|value| 0.5 + value))).collect();
            let picture = draw_scene(
                &camera,
                &mesh(&triangles),
                culling,
                SIZE,
                |Corner { triangle, vertex, position }| {
                    let corner = vertex - 3 * triangle;
                    assert_eq!(position, triangles[triangle][corner]);
                    varyings[triangle].map(|values| values[corner])
                },
                |Sample { varyings, .. }| Some([0, 1, 2].map(|i| *varyings.get(i).unwrap_or(&0.5))),
            );
            let forward = unit(add(camera.target, camera.eye, -1.0));
            for triangle in &triangles {
                let distances =
                    triangle.map(|corner| product(forward, add(corner, camera.eye, -1.0)));
                let crosses = |plane: f64| {
                    distances.iter().any(|&d| d < plane) && distances.iter().any(|&d| d > plane)
                };
                tally[1] += usize::from(crosses(near));
                tally[2] += usize::from(crosses(far));
            }
            for (x, y) in pixels() {
                let mut drawn = picture.fragments(x, y).iter().peekable();
                for (number, (triangle, varyings)) in (0..).zip(triangles.iter().zip(&varyings)) {
                    let Hit { distance, weights, determinant } =
                        Ray::through(&camera, x, y).hit(*triangle);
                    let fragment = drawn.next_if(|fragment| fragment.triangle == number);
                    let smallest = weights.into_iter().fold(f64::INFINITY, f64::min);
                    let margins = [smallest, distance - near, far - distance];
                    if margins.iter().any(|margin| margin.abs() < MARGIN)
                        || determinant.abs() < MARGIN
                    {
                        continue;
                    }
                    let is_hit = margins.iter().all(|&margin| margin > 0.0)
                        && (culling == Culling::None || determinant > 0.0);
                    assert_eq!(fragment.is_some(), is_hit, "({x}, {y}), {triangle:?}, {camera:?}");
                    let Some(fragment) = fragment else { continue };
                    tally[0] += 1;
                    let (depth, w_over_near) = match projection {
                        Projection::Perspective { .. } => {
                            (near / distance, f64::max(distance / near, 1.0))
                        }
                        Projection::Orthographic { .. } => ((far - distance) / (far - near), 1.0),
                    };
                    assert!(
                        (fragment.depth - depth).abs() < TOLERANCE,
                        "{fragment:?} instead of {depth}"
                    );
                    for (actual, values) in fragment.color.into_iter().zip(varyings) {
                        let difference = (actual - product(weights, *values)).abs();
                        assert!(
                            difference < TOLERANCE * w_over_near,
                            "{difference} at ({x}, {y}) in {triangle:?}"
                        );
                    }
                }
                assert_eq!(drawn.next(), None, "a triangle twice in the pixel ({x}, {y})");
            }
        }
        tally
    }

    #[test]
    fn every_fragment_is_where_its_ray_hits() {
        for (near, far) in [(0.5, 15.0), (4.0, 6.0), (1e-6, 1e3)] {
            let projection = Projection::Perspective { focal_length_px: 30.0, near, far };
            let [fragments, crossing_near, crossing_far] =
                compare_with_rays::<1>(projection, Culling::None, 8);
            assert!(fragments > 10_000, "{fragments}");
            assert!(crossing_near > 200, "{crossing_near}");
            assert!(crossing_far > 50 || far > 100.0, "{crossing_far}");
        }
    }

    #[test]
    fn every_orthographic_fragment_is_where_its_ray_hits() {
        let projection = Projection::Orthographic { pixels_per_unit: 3.0, near: -2.0, far: 8.0 };
        let [fragments, crossing_near, crossing_far] =
            compare_with_rays::<1>(projection, Culling::None, 9);
        assert!(fragments > 10_000, "{fragments}");
        assert!(crossing_near > 200 && crossing_far > 200, "{crossing_near} {crossing_far}");
    }

    #[test]
    fn any_number_of_varyings_is_what_the_ray_finds() {
        let projection = Projection::Perspective { focal_length_px: 30.0, near: 0.5, far: 15.0 };
        for [fragments, crossing_near, crossing_far] in [
            compare_with_rays::<0>(projection, Culling::None, 15),
            compare_with_rays::<2>(projection, Culling::None, 16),
            compare_with_rays::<3>(projection, Culling::None, 17),
        ] {
            assert!(fragments > 10_000, "{fragments}");
            assert!(crossing_near > 200 && crossing_far > 50, "{crossing_near} {crossing_far}");
        }
    }

    #[test]
    fn culling_keeps_the_faces_whose_rays_come_from_the_front() {
        for projection in
            [PERSPECTIVE, Projection::Orthographic { pixels_per_unit: 3.0, near: -2.0, far: 8.0 }]
        {
            let [fragments, crossing_near, _] =
                compare_with_rays::<1>(projection, Culling::Back, 10);
            assert!(fragments > 5_000 && crossing_near > 200, "{fragments} {crossing_near}");
        }
    }

    #[test]
    fn a_counter_clockwise_triangle_shows_its_front() {
        let front = [[-1.0, -1.0, -3.0], [1.0, -1.0, -3.0], [0.0, 1.0, -3.0]];
        let back = [front[2], front[1], front[0]];
        let both = mesh(&[front, back]);
        let numbers = |culling| -> Vec<usize> {
            let picture = draw(&camera(PERSPECTIVE), &both, culling);
            picture.fragments(24, 16).iter().map(|fragment| fragment.triangle).collect()
        };
        assert_eq!(numbers(Culling::Back), [0]);
        assert_eq!(numbers(Culling::None), [0, 1]);
    }

    #[test]
    fn the_ground_reaches_from_the_near_plane_to_the_far_plane() {
        // A camera 1.5 above the plane y = 0 that looks along -z. The ray through the row at height
        // h pixels below the middle falls by h / 30 per unit of distance and meets the
        // ground at the distance 45 / h.
        let camera =
            Camera { eye: [0.0, 1.5, 0.0], target: [0.0, 1.5, -1.0], ..camera(PERSPECTIVE) };
        let (left, right) = (-1e4, 1e4);
        let ground =
            quad([[left, 0.0, 100.0], [right, 0.0, 100.0], [right, 0.0, -1e4], [left, 0.0, -1e4]]);
        for (near, far) in [(0.5, 40.0), (4.0, 20.0)] {
            let camera = Camera {
                projection: Projection::Perspective { focal_length_px: 30.0, near, far },
                ..camera
            };
            let picture = draw(&camera, &mesh(&ground), Culling::Back);
            for (x, y) in pixels() {
                let distance = 45.0 / (y as f64 + 0.5 - 16.0);
                let is_visible = (near..=far).contains(&distance);
                assert_eq!(picture.layers(x, y), usize::from(is_visible), "({x}, {y})");
                if let Some(fragment) = picture.nearest(x, y) {
                    // A dozen roundings of values up to 1.
                    assert!((fragment.depth - near / distance).abs() < 1e-14);
                    assert_eq!(fragment.color, DARK_RED);
                }
            }
        }
    }

    #[test]
    fn light_on_a_receding_wall_is_hyperbolic() {
        // The wall x = 1 from the distance 1 to 33: the ray of the column c pixels right of the
        // middle meets it at the distance 30 / c. The level falls evenly from 0.75 to 0.25
        // along the wall, not along the screen.
        let wall =
            quad([[1.0, -9.0, -1.0], [1.0, -9.0, -33.0], [1.0, 9.0, -33.0], [1.0, 9.0, -1.0]]);
        let levels = [[0.75, 0.25, 0.25], [0.25, 0.75, 0.75]];
        let picture = draw_scene(
            &camera(PERSPECTIVE),
            &mesh(&wall),
            Culling::None,
            SIZE,
            |corner| [levels[corner.triangle][corner.vertex - 3 * corner.triangle]],
            |Sample { pixel: [x, _], varyings: [level], per_column, per_row, .. }| {
                // d = 30 / c changes by -30 / c² to the right and not at all downwards.
                let column = x as f64 + 0.5 - 24.0;
                assert!((per_column[0] - 0.5 / 32.0 * 30.0 / column.powi(2)).abs() < 1e-11);
                assert!(per_row[0].abs() < 1e-11);
                Some(DARK_RED.map(|channel| channel * level))
            },
        );
        let mut fragments = 0;
        for (x, y) in pixels() {
            let distance = 30.0 / (x as f64 + 0.5 - 24.0);
            if let Some(fragment) = picture.nearest(x, y) {
                fragments += 1;
                let level = 0.75 - 0.5 * (distance - 1.0) / 32.0;
                for (actual, channel) in fragment.color.into_iter().zip(DARK_RED) {
                    // Some 20 roundings of values below 255.
                    assert!((actual - channel * level).abs() < 1e-11, "({x}, {y}): {actual}");
                }
                assert!((fragment.depth - 0.5 / distance).abs() < 1e-14);
            }
        }
        assert!(fragments > 500, "{fragments}");
    }

    #[test]
    fn inside_a_closed_box_every_pixel_sees_one_wall() {
        // The near plane cuts walls in almost every picture; no new vertex may open a gap or cover
        // a pixel twice.
        let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 1 { 1.0 } else { -1.0 });
        let faces =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let walls = faces.map(|face| quad(face.map(corner))).concat();
        let walls = mesh(&walls);
        let mut random = Random(11);
        for near in [0.1, 1e-3, 1e-9] {
            let projection = Projection::Perspective { focal_length_px: 20.0, near, far: 10.0 };
            for _ in 0..50 {
                let mut vector = |reach: f64| [(); 3].map(|()| random.real(-reach, reach));
                let camera = Camera {
                    eye: vector(0.85),
                    target: vector(9.0),
                    up: vector(1.0),
                    ..camera(projection)
                };
                let picture = draw(&camera, &walls, Culling::None);
                for (x, y) in pixels() {
                    // A wall nearer than the near plane is cut open there: the ray decides.
                    let Ray { origin, direction } = Ray::through(&camera, x, y);
                    let distance = (0..3)
                        .map(|axis| (direction[axis].signum() - origin[axis]) / direction[axis])
                        .fold(f64::INFINITY, f64::min);
                    assert_eq!(
                        picture.layers(x, y),
                        usize::from(distance > near),
                        "({x}, {y}) {camera:?}"
                    );
                }
                let from_inside = draw(&camera, &walls, Culling::Back);
                assert!(
                    pixels().all(|(x, y)| from_inside.layers(x, y) == 0),
                    "the fronts are outside"
                );
            }
        }
    }

    #[test]
    fn flat_gouraud_and_unlit_are_closures_over_the_light() {
        let sun = Sun { toward: [0.0, 0.0, 1.0], level: 0.5 };
        let light = Lights { ambient: 0.25, suns: vec![sun], lamps: vec![] };
        let wall = mesh(&[[[-9.0, -9.0, -3.0], [9.0, -9.0, -3.0], [0.0, 9.0, -3.0]]]);
        let (face_normals, vertex_normals) = ([[0.0, 0.0, -1.0]], [[0.0, 0.0, 1.0]; 3]);
        let lit = |Sample { varyings: [level], .. }: Sample<1>| {
            Some(DARK_RED.map(|channel| channel * level))
        };
        let camera = camera(PERSPECTIVE);
        let pictures = [
            draw_scene(
                &camera,
                &wall,
                Culling::Back,
                SIZE,
                |corner| [light.diffuse([0.0; 3], face_normals[corner.triangle])],
                lit,
            ),
            draw_scene(
                &camera,
                &wall,
                Culling::Back,
                SIZE,
                |corner| [light.diffuse([0.0; 3], vertex_normals[corner.vertex])],
                lit,
            ),
            draw(&camera, &wall, Culling::Back),
        ];
        for (picture, level) in pictures.iter().zip([0.25, 0.75, 1.0]) {
            let color = picture.nearest(24, 16).map(|fragment| fragment.color);
            assert_eq!(color, Some(DARK_RED.map(|channel| channel * level)));
        }
    }

    #[test]
    fn a_discarded_fragment_leaves_the_wall_behind() {
        // Two walls across the view; the front one has a hole where its own x, a varying, is
        // positive. At the distance 3 that is the right half of the picture.
        let wall = |z: f64| [[-99.0, -99.0, z], [99.0, -99.0, z], [0.0, 99.0, z]];
        let walls = mesh(&[wall(-3.0), wall(-6.0)]);
        let picture = draw_scene(
            &camera(PERSPECTIVE),
            &walls,
            Culling::Back,
            SIZE,
            |corner| [corner.position[0]],
            |Sample { triangle, varyings: [x], .. }| {
                (triangle == 1 || x <= 0.0).then_some(DARK_RED)
            },
        );
        for (x, y) in pixels() {
            let front = picture.nearest(x, y).map(|fragment| fragment.triangle);
            assert_eq!(front, Some(usize::from(x >= 24)), "({x}, {y})");
        }
    }

    #[test]
    fn nothing_is_drawn_outside_the_viewport() {
        let everywhere = mesh(&[[[-99.0, -99.0, -1.0], [99.0, -99.0, -1.0], [0.0, 99.0, -1.0]]]);
        let camera = Camera {
            viewport: Viewport { x: 5.0, y: 3.0, width: 20.0, height: 10.0 },
            ..camera(PERSPECTIVE)
        };
        let picture = draw(&camera, &everywhere, Culling::Back);
        for (x, y) in pixels() {
            let is_inside = (5..25).contains(&x) && (3..13).contains(&y);
            assert_eq!(picture.layers(x, y), usize::from(is_inside), "({x}, {y})");
        }
    }

    #[test]
    fn a_camera_without_axes_and_wild_vertices_draw_nothing() {
        let triangle = [[-9.0, -9.0, -3.0], [9.0, -9.0, -3.0], [0.0, 9.0, -3.0]];
        let blind = Camera { up: [0.0, 0.0, 1.0], ..camera(PERSPECTIVE) };
        let picture = draw(&blind, &mesh(&[triangle]), Culling::None);
        assert!(pixels().all(|(x, y)| picture.layers(x, y) == 0));
        for wild in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let wild = [triangle[0], triangle[1], [0.0, wild, -3.0]];
            let picture = draw(&camera(PERSPECTIVE), &mesh(&[wild]), Culling::None);
            assert!(pixels().all(|(x, y)| picture.layers(x, y) == 0));
        }
    }
}
