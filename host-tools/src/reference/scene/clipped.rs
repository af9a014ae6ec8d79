//! Tests of planes of the user's: each pixel is decided by where its ray meets the triangle.

use super::super::camera::{Projection, Viewport};
use super::super::random::Random;
use super::super::ray::{Hit, Ray};
use super::*;

const SIZE: (usize, usize) = (48, 32);
/// Closer to an edge or a plane, rounding decides.
const MARGIN: f64 = 1e-9;

#[test]
fn every_fragment_lies_inside_the_half_spaces() {
    let mut random = Random(31);
    let mut vector = |reach: f64| [(); 3].map(|()| random.real(-reach, reach));
    // Drawn, left out by a plane, and where the near plane is crossed too.
    let mut tally = [0; 2];
    for count in [1, 2, 3] {
        for _ in 0..20 {
            let camera = Camera {
                eye: vector(2.0),
                target: vector(2.0),
                up: vector(1.0),
                projection: Projection::Perspective { focal_length_px: 30.0, near: 0.5, far: 15.0 },
                viewport: Viewport { x: 0.0, y: 0.0, width: 48.0, height: 32.0 },
            };
            let sides: Vec<_> = (0..count)
                .map(|_| HalfSpace { normal: vector(3.0), offset: vector(5.0)[0] })
                .collect();
            let triangles: Vec<_> =
                (0..20).map(|_| [vector(12.0), vector(12.0), vector(12.0)]).collect();
            let mesh = Mesh {
                positions: triangles.concat(),
                triangles: (0..triangles.len()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            };
            // The position in the world is interpolated.
            let picture = draw_clipped_scene(
                &camera,
                &mesh,
                &sides,
                Culling::None,
                SIZE,
                |corner| corner.position,
                |Sample { varyings, .. }| Some(varyings),
            );
            for (x, y) in (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y))) {
                let mut drawn = picture.fragments(x, y).iter().peekable();
                for (number, triangle) in triangles.iter().enumerate() {
                    let fragment = drawn.next_if(|fragment| fragment.triangle == number);
                    let ray = Ray::through(&camera, x, y);
                    let Hit { distance, weights, determinant } = ray.hit(*triangle);
                    let place: [f64; 3] =
                        std::array::from_fn(|i| ray.origin[i] + distance * ray.direction[i]);
                    let smallest = weights.into_iter().fold(f64::INFINITY, f64::min);
                    let in_view = [smallest, distance - 0.5, 15.0 - distance];
                    let depth = sides.iter().map(|side| side.depth(place));
                    let depth = depth.fold(f64::INFINITY, f64::min);
                    if in_view.into_iter().chain([depth]).any(|margin| margin.abs() < MARGIN)
                        || determinant.abs() < MARGIN
                    {
                        continue;
                    }
                    let is_seen = in_view.iter().all(|&margin| margin > 0.0);
                    assert_eq!(fragment.is_some(), is_seen && depth > 0.0, "({x}, {y}) {sides:?}");
                    tally[0] += usize::from(fragment.is_some());
                    tally[1] += usize::from(is_seen && depth < 0.0);
                    if let Some(fragment) = fragment {
                        for (got, want) in fragment.color.iter().zip(place) {
                            // A varying comes from a division by the depth, up to 1 / 30.
                            assert!((got - want).abs() < 1e-9, "{got} {want}");
                        }
                    }
                }
                assert_eq!(drawn.next(), None, "a triangle twice in the pixel ({x}, {y})");
            }
        }
    }
    assert!(tally.iter().all(|&count| count > 10_000), "{tally:?}");
}
