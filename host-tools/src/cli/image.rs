//! Pictures to look at: those of both rasterizers on a background, and their differences.

use embedded_graphics_core::{
    geometry::Point,
    pixelcolor::{Rgb888, RgbColor as _},
    primitives::Rectangle,
};
use host_tools::{
    check::{Bounds, Checked, Difference, Display, FixedPicture, Pixel},
    reference::Picture,
};
use rasterizer::output::Frame;

/// A picture of 8-bit red, green and blue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Image {
    /// Width and height in pixels.
    pub(super) size: [u32; 2],
    /// The pixels, row by row.
    pub(super) rgb: Vec<[u8; 3]>,
}

/// The factor by which the difference picture amplifies colour differences. From 8 steps of 256 on
/// they are at full strength, and a single step is still visible.
pub(super) const AMPLIFICATION: f64 = 32.0;

const AMPLIFIED: [f64; 3] = [255.0, 214.0, 0.0];
const ONLY_FIXED: [u8; 3] = [255, 0, 255];
const ONLY_REFERENCE: [u8; 3] = [0, 255, 255];
const OUT_OF_BOUNDS: [u8; 3] = [255, 0, 0];
const WRONG_PLACE: [u8; 3] = [255, 128, 0];
const NOTHING: [u8; 3] = [0x0C, 0x0E, 0x12];

/// How many pixels the difference picture marks in each colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Legend {
    /// With any difference of colour.
    pub(super) amplified: usize,
    /// Covered in the fixed-point picture only.
    pub(super) only_fixed: usize,
    /// Covered in the reference only.
    pub(super) only_reference: usize,
    /// Where the arithmetic exceeds a bound.
    pub(super) out_of_bounds: usize,
    /// Wrong though no edge is close.
    pub(super) wrong: usize,
}

impl Legend {
    /// Each colour of the difference picture, its meaning, and how many pixels have it.
    pub(super) fn lines(&self) -> [(&'static str, String, usize); 5] {
        let same = format!("colours differ, amplified {AMPLIFICATION} times");
        [
            ("yellow", same, self.amplified),
            ("magenta", "only the fixed-point picture covers the pixel".into(), self.only_fixed),
            ("cyan", "only the reference covers it".into(), self.only_reference),
            ("red", "the arithmetic exceeds a bound".into(), self.out_of_bounds),
            ("orange", "rounding doesn't explain the pixel".into(), self.wrong),
        ]
    }
}

/// The fixed-point picture on a background.
pub(super) fn of_fixed(picture: &FixedPicture, background: [u8; 3]) -> Image {
    let color = |pixel: &Pixel| if pixel.depth == 0 { background } else { pixel.color };
    Image { size: picture.size, rgb: picture.pixels.iter().map(color).collect() }
}

/// The reference picture on a background.
pub(super) fn of_reference(picture: &Picture, background: [u8; 3]) -> Image {
    over(picture, |x, y| {
        let front = picture.nearest(x, y);
        front.map_or(background, |fragment| fragment.color.map(|c| c.round() as u8))
    })
}

/// The differences of the fixed-point picture from the end-to-end reference, over a dim grey
/// picture of the model. A frame round each pixel in a loud colour makes even a single one visible.
pub(super) fn of_differences(checked: &Checked, bounds: &Bounds) -> (Image, Legend) {
    let mut legend = Legend { wrong: checked.wrong.len(), ..Legend::default() };
    let mut image = over(&checked.end_to_end, |x, y| {
        if exceeds(&checked.arithmetic_difference(x, y), bounds) {
            legend.out_of_bounds += 1;
            return OUT_OF_BOUNDS;
        }
        match checked.end_to_end_difference(x, y) {
            Difference::Background => NOTHING,
            Difference::OnlyFixed => {
                legend.only_fixed += 1;
                ONLY_FIXED
            }
            Difference::OnlyReference { .. } => {
                legend.only_reference += 1;
                ONLY_REFERENCE
            }
            Difference::Both { color_error, color, .. } => {
                legend.amplified += usize::from(color_error > 0.0);
                // A quarter of the brightness, plus enough to tell the darkest model from the
                // background.
                let grey = 32.0 + (color[0] + color[1] + color[2]) / 3.0 / 4.0;
                let strength = (color_error * AMPLIFICATION / 255.0).min(1.0);
                AMPLIFIED.map(|c| (grey + (c - grey) * strength).round() as u8)
            }
        }
    });
    for wrong in &checked.wrong {
        let [x, y] = wrong.pixel;
        image.rgb[y * checked.end_to_end.width() + x] = WRONG_PLACE;
    }
    image.frame(&[ONLY_FIXED, ONLY_REFERENCE, OUT_OF_BOUNDS, WRONG_PLACE]);
    (image, legend)
}

fn exceeds(difference: &Difference, bounds: &Bounds) -> bool {
    match *difference {
        Difference::Background => false,
        Difference::OnlyFixed | Difference::OnlyReference { .. } => true,
        Difference::Both { color_error, depth_error, .. } => {
            color_error > bounds.color_max_error || depth_error > bounds.depth_max_ulp
        }
    }
}

fn over(picture: &Picture, mut color: impl FnMut(usize, usize) -> [u8; 3]) -> Image {
    let (width, height) = (picture.width(), picture.height());
    let mut rgb = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            rgb.push(color(x, y));
        }
    }
    Image { size: [width as u32, height as u32], rgb }
}

impl Image {
    /// Draws a square around each pixel that has one of the `loud` colours, in that colour at half
    /// strength.
    fn frame(&mut self, loud: &[[u8; 3]]) {
        const RADIUS: i64 = 4;
        let [width, height] = self.size.map(i64::from);
        let original = self.rgb.clone();
        for (index, color) in (0..).zip(&original).filter(|(_, color)| loud.contains(color)) {
            let (x, y) = (index % width, index / width);
            let sides = (-RADIUS..=RADIUS)
                .flat_map(|i| [(i, -RADIUS), (i, RADIUS), (-RADIUS, i), (RADIUS, i)]);
            for (x, y) in sides.map(|(dx, dy)| (x + dx, y + dy)) {
                let place = (y * width + x) as usize;
                if (0..width).contains(&x)
                    && (0..height).contains(&y)
                    && !loud.contains(&original[place])
                {
                    self.rgb[place] = color.map(|c| c / 2);
                }
            }
        }
    }

    /// What a display shows of it.
    pub(super) fn shown_by(&self, display: Display) -> Self {
        Self { size: self.size, rgb: display.shown(self.size, &self.rgb) }
    }

    /// The picture whose pixels are the means of squares of this one's, `side` pixels wide: 1, 2 or
    /// 4. Its own sides are multiples of that.
    pub(super) fn resolved(&self, side: u32) -> Self {
        let mut samples: Vec<_> =
            self.rgb.iter().map(|&[red, green, blue]| Rgb888::new(red, green, blue)).collect();
        let area = Rectangle::new(Point::zero(), self.size.into());
        let frame = Frame::without_depth(&mut samples, area).expect("the picture fills its size");
        let rgb = |color: Rgb888| [color.r(), color.g(), color.b()];
        let means = match side {
            2 => frame.resolved::<2>().map(|means| means.pixels().map(rgb).collect()),
            4 => frame.resolved::<4>().map(|means| means.pixels().map(rgb).collect()),
            _ => None,
        };
        means.map_or_else(|| self.clone(), |rgb| Self { size: self.size.map(|c| c / side), rgb })
    }

    /// This picture and, on its right, another one of the same size.
    pub(super) fn beside(&self, other: &Self) -> Self {
        let [width, height] = self.size;
        let rows = |image: &'_ Self| image.rgb.chunks(width as usize).map(<[_]>::to_vec).collect();
        let [left, right]: [Vec<_>; 2] = [rows(self), rows(other)];
        let rgb = left.into_iter().zip(right).flat_map(|(left, right)| [left, right].concat());
        Self { size: [2 * width, height], rgb: rgb.collect() }
    }
}

#[cfg(test)]
mod tests {
    use host_tools::{
        check::{Comparison, DepthFormat, Deviation, Fault, Outcome, Places, Vertices, Wrong},
        reference::{ScreenTriangle, ScreenVertex, draw_screen},
    };

    use super::*;

    const WIDTH: usize = 10;
    /// In units of a 16-bit depth.
    const DEPTH: u32 = 1000;

    /// A row of pixels, those at `covered` drawn in grey.
    fn row(covered: &[(usize, f64)], depth: f64) -> Picture {
        let pixel = |&(column, grey): &(usize, f64)| {
            let vertex = |x, y| ScreenVertex { x: column as f64 + x, y, depth, varyings: [grey] };
            ScreenTriangle {
                vertices: [vertex(0.5, 0.1), vertex(0.1, 0.9), vertex(0.9, 0.9)],
                number: column,
            }
        };
        let triangles: Vec<_> = covered.iter().map(pixel).collect();
        draw_screen(&triangles, (WIDTH, 1), |sample| Some([sample.varyings[0]; 3]))
    }

    fn checked() -> Checked {
        let mut pixels = vec![Pixel { color: [0; 3], depth: 0 }; WIDTH];
        for (x, grey) in [(1, 108), (3, 108), (4, 108), (5, 100)] {
            pixels[x] = Pixel { color: [grey; 3], depth: DEPTH };
        }
        let comparison = Comparison {
            deviation: Deviation {
                pixels: 4,
                coverage_mismatches: 1,
                depth_max_ulp: 0.0,
                depth_rms_ulp: 0.0,
                color_max_error: 0.0,
                psnr_db: None,
            },
            vertices: Vertices::default(),
            texels: None,
            normals: None,
            blend: None,
            fixed_ms: 0.0,
            reference_ms: 0.0,
        };
        Checked {
            outcome: Outcome {
                arithmetic: comparison,
                end_to_end: comparison,
                places: Places::default(),
                display: None,
            },
            wrong: vec![Wrong { pixel: [7, 0], fault: Fault::Hole, line: Some(1), triangle: None }],
            fixed: FixedPicture { size: [WIDTH as u32, 1], pixels },
            arithmetic: row(
                &[(1, 108.0), (3, 108.0), (5, 100.0)],
                DepthFormat::U16.definition().depth(DEPTH),
            ),
            end_to_end: row(
                &[(1, 100.0), (2, 50.0), (5, 100.0)],
                DepthFormat::U16.definition().depth(DEPTH),
            ),
            depth: DepthFormat::U16,
            blended: None,
        }
    }

    #[test]
    fn each_difference_has_its_color() {
        let (image, legend) = of_differences(&checked(), &Bounds::ARITHMETIC);
        assert_eq!(image.size, [10, 1]);
        // 8 steps are full strength, equal pixels a quarter of their brightness over 32; 8 is the
        // frame of 4.
        assert_eq!(image.rgb[1], [255, 214, 0]);
        assert_eq!(image.rgb[2..6], [ONLY_REFERENCE, ONLY_FIXED, OUT_OF_BOUNDS, [57; 3]]);
        assert_eq!(image.rgb[6], ONLY_REFERENCE.map(|c| c / 2));
        assert_eq!(image.rgb[7], WRONG_PLACE);
        assert_eq!(image.rgb[8], OUT_OF_BOUNDS.map(|c| c / 2));
        assert_eq!(image.rgb[9], NOTHING);
        let expected =
            Legend { amplified: 1, only_fixed: 1, only_reference: 1, out_of_bounds: 1, wrong: 1 };
        assert_eq!(legend, expected);
    }

    #[test]
    fn a_wrong_depth_or_color_is_out_of_bounds() {
        for (color_error, depth_error, expected) in
            [(1.0, 1.0, false), (2.0, 0.0, true), (0.0, 2.0, true)]
        {
            let difference = Difference::Both { color_error, depth_error, color: [0.0; 3] };
            assert_eq!(exceeds(&difference, &Bounds::ARITHMETIC), expected);
        }
    }

    #[test]
    fn both_pictures_lie_on_the_same_background() {
        let checked = checked();
        let (fixed, reference) =
            (of_fixed(&checked.fixed, [1, 2, 3]), of_reference(&checked.end_to_end, [1, 2, 3]));
        assert_eq!((fixed.rgb[0], reference.rgb[0]), ([1, 2, 3], [1, 2, 3]));
        assert_eq!((fixed.rgb[1], reference.rgb[1]), ([108; 3], [100; 3]));
    }
}
