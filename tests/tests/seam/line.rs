//! A horizontal line: a primitive besides the triangle, in every target.

use super::*;

/// A number that is linear on the screen.
trait Linear: Interpolate<Field = Plane<<Self as Interpolate>::Walk>> {}

impl<V: Interpolate<Field = Plane<<V as Interpolate>::Walk>>> Linear for V {}

/// Pixels of one row: a primitive besides the triangle.
struct HorizontalLine<D: DepthFormat, V: Interpolate> {
    row: i32,
    left: i32,
    /// The column after the last.
    right: i32,
    depth: D::Walk,
    /// At the first pixel, and the change from pixel to pixel.
    varyings: V::Walk,
    varyings_step: V::Walk,
}

impl<D: DepthFormat, V: Linear> Primitive for HorizontalLine<D, V> {
    type Depth = D;
    type Varyings = V;

    fn for_each_span<E>(
        &self,
        window: &Window,
        layout: Layout,
        mut visit: impl FnMut(&Span<'_, D, V>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (left, right) = (self.left.max(window.left()), self.right.min(window.right()));
        if left >= right || !(window.top()..window.bottom()).contains(&self.row) {
            return Ok(());
        }
        let address = layout.row_address(self.row);
        // At the address of the first pixel.
        let to_address_0 = self.varyings_step.wrapping_mul(-(address + self.left));
        let plane = Plane {
            anchor: self.varyings.wrapping_add(to_address_0),
            per_column: self.varyings_step,
            per_row: Step::ZERO,
        };
        visit(&Span {
            row: self.row,
            start: (address + left) as usize,
            end: (address + right) as usize,
            depth: self.depth,
            depth_step: Step::ZERO,
            varyings: &plane,
        })
    }
}

/// Rows and columns of lines inside the display, across its edges and beside it.
const LINES: [[i32; 3]; 8] = [
    [10, 8, 60],
    [20, -100, 300],
    [21, 30, 31],
    [22, 25, 38],
    [30, -40, 20],
    [31, 50, 900],
    [-3, 0, 60],
    [45, 0, 60],
];

/// The value of the varying at the first pixel and its change, in Q16.
const RAMP: [u32; 2] = [0x1000_0000, 0x0031_0000];

const fn line<D: DepthFormat>(
    [row, left, right]: [i32; 3],
    depth: D::Walk,
) -> HorizontalLine<D, u16> {
    let [varyings, varyings_step] = RAMP;
    HorizontalLine { row, left, right, depth, varyings, varyings_step }
}

/// A colour of a line's pixel.
const fn ramp(value: u32) -> Rgb888 {
    Rgb888::new((value >> 24) as u8, (value >> 16) as u8, 200)
}

const INK: Rgb888 = Rgb888::new(0, 9, 255);

/// Draws the lines in three ways, beside each other: filled, shaded, blended.
fn draw_lines<T: Readable<Color = Rgb888, Error = Infallible>>(
    target: &mut T,
    depth: <T::Depth as Interpolate>::Walk,
    way: usize,
) {
    let window = target.window();
    for at in LINES {
        let line = line::<T::Depth>(at, depth);
        let Ok(()) = match way {
            0 => target.fill(&line, &window, INK),
            1 => target.shade(&line, &window, |fragment| ramp(fragment.varyings.to_bits())),
            _ => target.blend(&line, &window, |stored, fragment| {
                tint(stored, ramp(fragment.varyings.to_bits()))
            }),
        };
    }
}

/// What a line's pixel becomes.
fn line_pixel([_, left, _]: [i32; 3], column: i32, stored: Rgb888, way: usize) -> Rgb888 {
    let color = ramp(RAMP[0].wrapping_add(RAMP[1].wrapping_mul((column - left) as u32)));
    [INK, color, tint(stored, color)][way]
}

#[test]
fn another_primitive_is_drawn_into_every_target() {
    let ball = ball();
    let mesh = ball.mesh();
    let object = Object::new(&mesh, Position);
    let camera = at("2.4", DISPLAY);
    let tested = object.project_on_demand::<_, S8, u16>(&camera, S8).unwrap();
    let untested = object.project_on_demand::<_, S8, NoDepth>(&camera, S8).unwrap();
    let stored = u16::frame(|frame| tested.draw(frame));
    // Half way between the ball's nearest and farthest pixels.
    let drawn: Vec<_> = stored.depth.iter().copied().filter(|&depth| depth != 0).collect();
    let depth = (drawn.iter().min().unwrap() + drawn.iter().max().unwrap()) / 2;
    for way in 0..3 {
        let mut with_depth = stored.clone();
        let mut without_depth = NoDepth::frame(|frame| untested.draw(frame)).color;
        let [mut nearer, mut hidden] = [0; 2];
        for at in LINES {
            let [row, left, right] = at;
            for column in left..right {
                if !DISPLAY.contains(Point::new(column, row)) {
                    continue;
                }
                let corner = DISPLAY.top_left;
                let index = ((row - corner.y) * 61 + column - corner.x) as usize;
                let [color, bare] = [&mut with_depth.color[index], &mut without_depth[index]];
                *bare = line_pixel(at, column, *bare, way);
                if depth > with_depth.depth[index] {
                    *color = line_pixel(at, column, *color, way);
                    with_depth.depth[index] = depth;
                    nearer += 1;
                } else {
                    hidden += 1;
                }
            }
        }
        assert!(nearer > 60 && hidden > 20, "{nearer} nearer, {hidden} hidden");
        let got = u16::frame(|frame| {
            tested.draw(frame)?;
            draw_lines(frame, (depth << 16) + 0x8000, way);
            Ok(())
        });
        assert!(got == with_depth, "with depth, way {way}");
        let got = NoDepth::frame(|frame| {
            untested.draw(frame)?;
            draw_lines(frame, (), way);
            Ok(())
        });
        assert!(got.color == without_depth, "without depth, way {way}");
        bands_equal::<NoDepth>(&got, |band| {
            untested.draw(band)?;
            draw_lines(band, (), way);
            Ok(())
        });
    }
    for way in 0..2 {
        let mut screen = Recorder::new(DISPLAY);
        let mut target = Direct::new(&mut screen);
        let window = target.window();
        for at in LINES {
            let line = line::<NoDepth>(at, ());
            let drawn = match way {
                0 => target.fill(&line, &window, INK),
                _ => target.shade(&line, &window, |fragment| ramp(fragment.varyings.to_bits())),
            };
            assert_eq!(drawn, Ok(()));
        }
        for (point, pixel) in DISPLAY.points().zip(received(&screen)) {
            let at = LINES
                .into_iter()
                .find(|&[row, left, right]| row == point.y && (left..right).contains(&point.x));
            assert_eq!(pixel, at.map(|at| line_pixel(at, point.x, INK, way)), "{point}");
        }
    }
}
