//! Windows, layouts and frames at the ends of `i32`: no overflow, and the pixels that lie in both
//! the window and the triangle.

use std::convert::Infallible;

use embedded_graphics::{
    geometry::{Point, Size},
    pixelcolor::{Gray8, GrayColor as _},
    primitives::Rectangle,
};
use rasterizer::{
    attribute::NoDepth,
    geometry::ScreenVertex,
    numbers::{S4, S8, Subpixel},
    output::{Frame, Target as _},
    raster::{Layout, Primitive as _, Triangle, Window},
};

/// Corners of triangles in pixels: small ones, and the largest that vertices can make.
const TRIANGLES: [[[i32; 2]; 3]; 4] = [
    [[-9, -6], [12, -2], [3, 11]],
    [[0, 0], [0, 9], [9, 0]],
    [[-1024, -1024], [1023, -1000], [-900, 1023]],
    [[1023, 1023], [-1024, 1023], [1000, -1024]],
];

/// Calls `visit` with each of [`TRIANGLES`].
fn for_each_triangle<S: Subpixel>(mut visit: impl FnMut(&Triangle<'_, S, NoDepth, [u16; 1]>)) {
    for corners in TRIANGLES {
        let [a, b, c] = corners.map(|place| {
            let [x, y] = place.map(|c| c << S::BITS);
            ScreenVertex::<S, NoDepth, [u16; 1]>::checked(x, y, NoDepth, [7]).unwrap()
        });
        visit(&Triangle::new([&a, &b, &c]).unwrap());
    }
}

/// The row, the first address and the one after the last of each span.
fn spans<S: Subpixel>(
    triangle: &Triangle<'_, S, NoDepth, [u16; 1]>,
    window: &Window,
    layout: Layout,
) -> Vec<(i32, i64, i64)> {
    let mut spans = vec![];
    let Ok(()) = triangle.for_each_span(window, layout, |span| {
        spans.push((span.row, span.start as i64, span.end as i64));
        Ok::<(), Infallible>(())
    });
    spans
}

/// The covered columns of each row, in a window that holds all vertices.
fn covered<S: Subpixel>(triangle: &Triangle<'_, S, NoDepth, [u16; 1]>) -> Vec<(i32, i64, i64)> {
    let window = Window::new(&Rectangle::new(Point::new(-1100, -1100), Size::new(2200, 2200)));
    let all = spans(triangle, &window, Layout { pitch: 0, origin: -1100 });
    all.into_iter().map(|(row, start, end)| (row, start - 1100, end - 1100)).collect()
}

const ENDS: [i32; 13] = [
    i32::MIN,
    i32::MIN + 1,
    -(1 << 30),
    -(1 << 29) - 1,
    -(1 << 29),
    -5,
    0,
    4,
    1 << 29,
    (1 << 29) + 1,
    1 << 30,
    i32::MAX - 1,
    i32::MAX,
];

const SIZES: [u32; 7] = [0, 1, 6, 1 << 29, 1 << 31, (1 << 31) + 3, u32::MAX];

/// From `start`, `size` long, without the part beyond `i32`.
fn sides(start: i32, size: u32) -> [i64; 2] {
    [start.into(), (i64::from(start) + i64::from(size)).min(i32::MAX.into())]
}

fn windows_cut_triangles<S: Subpixel>() {
    let mut drawn = 0;
    for_each_triangle::<S>(|triangle| {
        let covered = covered(triangle);
        for x in ENDS {
            for y in ENDS {
                for width in SIZES {
                    for height in SIZES {
                        let window = Window::new(&Rectangle::new(
                            Point::new(x, y),
                            Size::new(width, height),
                        ));
                        let ([left, right], [top, bottom]) = (sides(x, width), sides(y, height));
                        let origin = window.left();
                        let want: Vec<_> = covered
                            .iter()
                            .filter(|span| (top..bottom).contains(&i64::from(span.0)))
                            .map(|&(row, start, end)| (row, start.max(left), end.min(right)))
                            .filter(|&(_, start, end)| start < end)
                            .map(|(row, start, end)| {
                                (row, start - i64::from(origin), end - i64::from(origin))
                            })
                            .collect();
                        let got = spans(triangle, &window, Layout { pitch: 0, origin });
                        assert_eq!(got, want, "{window:?}");
                        drawn += got.len();
                    }
                }
            }
        }
    });
    assert!(drawn > 100_000, "{drawn}");
}

#[test]
fn a_window_cuts_triangles_wherever_its_sides_are() {
    windows_cut_triangles::<S4>();
    windows_cut_triangles::<S8>();
}

/// One row of pixels has an address of 0 for its first one by any pitch.
#[test]
fn addresses_count_modulo_2_32() {
    let mut drawn = 0;
    for_each_triangle::<S4>(|triangle| {
        for (row, start, end) in covered(triangle).into_iter().step_by(5) {
            for pitch in ENDS {
                let corner = Point::new(start as i32, row);
                let width = (end - start) as u32;
                let window = Window::new(&Rectangle::new(corner, Size::new(width, 1)));
                let origin = row.wrapping_mul(pitch).wrapping_add(corner.x);
                let got = spans(triangle, &window, Layout { pitch, origin });
                assert_eq!(got, [(row, 0, end - start)], "{pitch}");
                drawn += 1;
            }
        }
    });
    assert!(drawn > 5_000, "{drawn}");
}

#[test]
fn frames_at_the_ends_have_no_pixel_of_a_triangle() {
    let mut drawn = 0;
    for x in ENDS {
        for y in ENDS {
            let mut color = [Gray8::BLACK; 24];
            let area = Rectangle::new(Point::new(x, y), Size::new(8, 3));
            let mut frame = Frame::without_depth(&mut color, area).unwrap();
            let window = frame.window();
            for_each_triangle::<S8>(|triangle| {
                let Ok(()) = frame.shade(triangle, &window, |_| Gray8::WHITE);
            });
            let is_near = [x, y].into_iter().all(|c| (-5..5).contains(&c));
            let white = color.iter().filter(|&&pixel| pixel == Gray8::WHITE).count();
            assert_eq!(white, if is_near { 24 } else { 0 }, "{area:?}");
            drawn += white;
        }
    }
    assert_eq!(drawn, 9 * 24);
}

#[test]
fn a_frame_of_one_row_can_have_any_stride() {
    for stride in [8, 1 << 29, i32::MAX as u32, 1 << 31, u32::MAX] {
        let mut color = [Gray8::BLACK; 8];
        let area = Rectangle::new(Point::new(-3, 4), Size::new(8, 1));
        let mut frame = Frame::without_depth_with_stride(&mut color, area, stride).unwrap();
        let window = frame.window();
        for_each_triangle::<S8>(|triangle| {
            let Ok(()) = frame.shade(triangle, &window, |_| Gray8::WHITE);
        });
        assert_eq!(color, [Gray8::WHITE; 8], "{stride}");
    }
}
