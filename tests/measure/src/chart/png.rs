//! A canvas of dots, as a PNG file.

use std::convert::Infallible;

use embedded_graphics::{
    Pixel,
    geometry::{OriginDimensions, Point, Size},
    mono_font::{
        MonoFont, MonoTextStyle,
        iso_8859_1::{FONT_9X18_BOLD, FONT_10X20},
    },
    pixelcolor::Rgb888,
    prelude::{DrawTarget, Drawable as _, Primitive as _, RgbColor as _},
    primitives::{self, PrimitiveStyle, Triangle},
    text::{Alignment, Text},
};
use png::{BitDepth, ColorType, Encoder, EncodingError};

use super::canvas::{Anchor, Canvas, Color, DASH, Glyph, Line, Outline, Place, Stroke, TextSize};

/// Dots per user unit. The largest font that `embedded-graphics` has, of 10 by 20 dots, is then 10
/// units high, a little less than the text of the SVG.
const SCALE: f64 = 2.0;

/// A picture as dots of 8 bits a channel.
#[derive(Clone, Debug)]
pub(super) struct Dots {
    /// In dots.
    size: Size,
    /// Row by row from the top: red, green and blue of each dot.
    channels: Vec<u8>,
}

impl Dots {
    /// A white picture. The size is in user units.
    pub(super) fn new(size: [f64; 2]) -> Self {
        let [width, height] = size.map(|units| (SCALE * units).round() as u32);
        let channels = vec![0xff; 3 * width as usize * height as usize];
        Self { size: Size::new(width, height), channels }
    }

    /// The whole file.
    ///
    /// # Errors
    ///
    /// If the picture has no dots.
    pub(super) fn finish(self) -> Result<Vec<u8>, EncodingError> {
        let mut file = Vec::new();
        let mut encoder = Encoder::new(&mut file, self.size.width, self.size.height);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.channels)?;
        writer.finish()?;
        Ok(file)
    }

    /// Draws lines between the places, with a disc at each corner of a wide one.
    fn run(&mut self, places: &[Place], stroke: Stroke) {
        let width = (SCALE * stroke.width).round() as u32;
        let style = PrimitiveStyle::with_stroke(rgb(stroke.color), width);
        for pair in places.windows(2) {
            let line = primitives::Line::new(dot(pair[0]), dot(pair[1]));
            let Ok(()) = line.into_styled(style).draw(self);
        }
        if width > 2 {
            for &corner in places.get(1..places.len().saturating_sub(1)).unwrap_or_default() {
                self.disc(corner, width, stroke.color);
            }
        }
    }

    /// Fills a circle. The diameter is in dots.
    fn disc(&mut self, center: Place, diameter: u32, color: Color) {
        let circle = primitives::Circle::with_center(dot(center), diameter);
        let Ok(()) = circle.into_styled(PrimitiveStyle::with_fill(rgb(color))).draw(self);
    }
}

impl OriginDimensions for Dots {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Dots {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        let [width, height] = [self.size.width, self.size.height].map(|side| side as usize);
        for Pixel(Point { x, y }, color) in pixels {
            let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y)) else { continue };
            if x < width && y < height {
                let start = 3 * (y * width + x);
                self.channels[start..start + 3].copy_from_slice(&[color.r(), color.g(), color.b()]);
            }
        }
        Ok(())
    }
}

impl Canvas for Dots {
    fn line(&mut self, line: &Line, stroke: Stroke) {
        let corners = line.corners();
        if !stroke.is_dashed {
            return self.run(&corners, stroke);
        }
        for dash in dashes(&corners) {
            self.run(&dash, stroke);
        }
    }

    fn rectangle(&mut self, corner: Place, [width, height]: [f64; 2], color: Color) {
        let end = dot([corner[0] + width, corner[1] + height]) - dot(corner);
        let size = Size::new(end.x.unsigned_abs(), end.y.unsigned_abs());
        let rectangle = primitives::Rectangle::new(dot(corner), size);
        let Ok(()) = rectangle.into_styled(PrimitiveStyle::with_fill(rgb(color))).draw(self);
    }

    fn glyph(&mut self, glyph: Glyph, at: Place, color: Color) {
        match glyph.outline(at) {
            Outline::Circle { radius } => {
                self.disc(at, (2.0 * SCALE * radius).round() as u32, color);
            }
            Outline::Polygon(corners) => {
                let style = PrimitiveStyle::with_fill(rgb(color));
                for pair in corners.get(1..).unwrap_or_default().windows(2) {
                    let triangle = Triangle::new(dot(corners[0]), dot(pair[0]), dot(pair[1]));
                    let Ok(()) = triangle.into_styled(style).draw(self);
                }
            }
            Outline::Lines(lines) => {
                for line in lines {
                    self.run(&line, Stroke { color, width: 2.0, is_dashed: false });
                }
            }
        }
    }

    fn text(&mut self, text: &str, at: Place, size: TextSize, anchor: Anchor) {
        // Titles are written twice, a dot apart: there is no larger font and no bold one as large.
        // The small font is bold: without, its strokes are one dot wide and look pale.
        let (font, copies): (&MonoFont<'_>, _) = match size {
            TextSize::Small => (&FONT_9X18_BOLD, 1),
            TextSize::Normal => (&FONT_10X20, 1),
            TextSize::Title => (&FONT_10X20, 2),
        };
        let alignment = match anchor {
            Anchor::Start => Alignment::Left,
            Anchor::Middle => Alignment::Center,
            Anchor::End => Alignment::Right,
        };
        let style = MonoTextStyle::new(font, rgb(Color::TEXT));
        for copy in 0..copies {
            let at = dot(at) + Point::new(copy, 0);
            let Ok(_) = Text::with_alignment(text, at, style, alignment).draw(self);
        }
    }
}

const fn rgb(Color([red, green, blue]): Color) -> Rgb888 {
    Rgb888::new(red, green, blue)
}

fn dot(place: Place) -> Point {
    let [x, y] = place.map(|units| (SCALE * units).round() as i32);
    Point::new(x, y)
}

/// The dashes of a line. They continue around its corners.
fn dashes(corners: &[Place]) -> Vec<Vec<Place>> {
    let mut dashes: Vec<Vec<Place>> = Vec::new();
    // How much is left of the present dash or gap.
    let (mut left, mut is_gap) = (0.0, true);
    for pair in corners.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let length = dx.hypot(dy);
        let mut walked = 0.0;
        while walked < length {
            let at = |walked: f64| {
                let part = walked / length;
                [pair[0][0] + part * dx, pair[0][1] + part * dy]
            };
            if left <= 0.0 {
                is_gap = !is_gap;
                left = DASH[usize::from(is_gap)];
                if !is_gap {
                    dashes.push(vec![at(walked)]);
                }
            }
            let step = (length - walked).min(left);
            walked += step;
            left -= step;
            if let (false, Some(dash)) = (is_gap, dashes.last_mut()) {
                dash.push(at(walked));
            }
        }
    }
    dashes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chart::Marker;

    const SIZE: [f64; 2] = [20.0, 10.0];
    const WHITE: Color = Color([0xff; 3]);

    /// The colour of the dot at a place in user units.
    fn color(dots: &Dots, place: Place) -> Color {
        let Point { x, y } = dot(place);
        let start = 3 * (y as usize * dots.size.width as usize + x as usize);
        Color([0, 1, 2].map(|channel| dots.channels[start + channel]))
    }

    #[test]
    fn dashes_turn_at_corners() {
        let found = dashes(&[[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]]);
        let expected = [
            vec![[0.0, 0.0], [6.0, 0.0]],
            vec![[9.0, 0.0], [10.0, 0.0], [10.0, 5.0]],
            vec![[10.0, 8.0], [10.0, 10.0]],
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn what_is_drawn_has_its_colour_and_what_lies_outside_is_left_out() {
        let mut dots = Dots::new(SIZE);
        let blue = Color::of_palette(0);
        dots.rectangle([0.0, 0.0], [4.0, 4.0], Color::SHADE);
        dots.line(&Line::Level { y: 8.0, left: 12.0, right: 30.0 }, Stroke::thin(blue));
        dots.glyph(Glyph::Marker(Marker::Square), [14.0, 4.0], blue);
        assert_eq!(color(&dots, [1.0, 1.0]), Color::SHADE);
        assert_eq!(color(&dots, [4.0, 1.0]), WHITE);
        assert_eq!(color(&dots, [19.5, 8.0]), blue);
        assert_eq!(color(&dots, [0.5, 8.5]), WHITE); // the row below the line
        assert_eq!(color(&dots, [12.0, 3.0]), blue);
        assert_eq!(color(&dots, [18.0, 4.0]), WHITE);
        dots.text("#", [0.0, 8.0], TextSize::Normal, Anchor::Start);
        assert!(dots.channels.chunks(3).any(|dot| dot == Color::TEXT.0));
    }

    #[test]
    fn files_have_the_dots() {
        let mut dots = Dots::new(SIZE);
        dots.rectangle([0.0, 0.0], [1.0, 1.0], Color::of_palette(1));
        let channels = dots.channels.clone();
        let file = dots.finish().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut found = vec![0; reader.output_buffer_size().unwrap()];
        let frame = reader.next_frame(&mut found).unwrap();
        assert_eq!((frame.width, frame.height, found), (40, 20, channels));
        assert!(Dots::new([0.0; 2]).finish().is_err());
    }
}
