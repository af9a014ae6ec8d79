//! What a chart is drawn on: lines, rectangles, markers and text.
//!
//! Places and lengths are in user units from the upper left corner, x to the right and y down.

use std::fmt;

use super::Marker;

/// Where something stands on a canvas: x and y.
pub(super) type Place = [f64; 2];

/// Something to draw on.
pub(super) trait Canvas {
    fn line(&mut self, line: &Line, stroke: Stroke);
    /// Fills a rectangle from its upper left corner.
    fn rectangle(&mut self, corner: Place, size: [f64; 2], color: Color);
    fn glyph(&mut self, glyph: Glyph, at: Place, color: Color);
    /// Writes a line of text on a base line. Pictures of dots have the characters of Latin-1; they
    /// show a question mark for any other.
    fn text(&mut self, text: &str, at: Place, size: TextSize, anchor: Anchor);
}

/// Red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Color(pub(super) [u8; 3]);

impl Color {
    pub(super) const GRID: Self = Self([0xdd; 3]);
    pub(super) const TEXT: Self = Self([0x33; 3]);
    pub(super) const REFERENCE: Self = Self([0x55; 3]);
    /// Lighter than the grid, which stays visible on it.
    pub(super) const SHADE: Self = Self([0xef, 0xf3, 0xf7]);

    /// One of six, over and over: colours that people who see red and green alike can tell apart
    /// (Okabe and Ito, "Color Universal Design", 2008: blue, vermillion, bluish green, reddish
    /// purple, orange), and a grey.
    pub(super) const fn of_palette(index: usize) -> Self {
        Self(match index % 6 {
            0 => [0x00, 0x72, 0xb2],
            1 => [0xd5, 0x5e, 0x00],
            2 => [0x00, 0x9e, 0x73],
            3 => [0xcc, 0x79, 0xa7],
            4 => [0xe6, 0x9f, 0x00],
            _ => [0x77, 0x77, 0x77],
        })
    }
}

/// As in CSS: `#0072b2`, or short as `#ddd`.
impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_short = self.0.iter().all(|channel| channel % 0x11 == 0);
        f.write_str("#")?;
        self.0.iter().try_for_each(|channel| match is_short {
            true => write!(f, "{:x}", channel / 0x11),
            false => write!(f, "{channel:02x}"),
        })
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub(super) color: Color,
    /// In user units.
    pub(super) width: f64,
    /// Dashes as long as [`DASH`].
    pub(super) is_dashed: bool,
}

/// The lengths of a dash and of the gap after it, in user units.
pub(super) const DASH: [f64; 2] = [6.0, 3.0];

impl Stroke {
    /// A line one unit wide without dashes.
    pub(super) const fn thin(color: Color) -> Self {
        Self { color, width: 1.0, is_dashed: false }
    }
}

/// The path of a line. A format with commands for upright and level lines uses them.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Line {
    /// Straight from place to place.
    Straight(Vec<Place>),
    /// Level from each place to the column of the next, then upright.
    Steps(Vec<Place>),
    /// A line of the grid. Its ends are those of the area.
    Upright { x: f64, top: f64, bottom: f64 },
    /// As [`Self::Upright`].
    Level { y: f64, left: f64, right: f64 },
    /// The sample of a curve in the legend.
    Sample { at: Place, width: f64 },
}

impl Line {
    /// The ends and corners of the line.
    pub(super) fn corners(&self) -> Vec<Place> {
        match *self {
            Self::Straight(ref places) => places.clone(),
            Self::Steps(ref places) => {
                let mut corners: Vec<Place> = places.first().copied().into_iter().collect();
                for pair in places.windows(2) {
                    corners.extend([[pair[1][0], pair[0][1]], pair[1]]);
                }
                corners
            }
            Self::Upright { x, top, bottom } => vec![[x, top], [x, bottom]],
            Self::Level { y, left, right } => vec![[left, y], [right, y]],
            Self::Sample { at: [x, y], width } => vec![[x, y], [x + width, y]],
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextSize {
    /// Labels beside points and lines.
    Small,
    Normal,
    Title,
}

impl TextSize {
    /// The size of the font, in user units.
    pub(super) const fn units(self) -> f64 {
        match self {
            Self::Small => 10.0,
            Self::Normal => 12.0,
            Self::Title => 14.0,
        }
    }

    /// About the width of a text, in user units: no sans-serif font has wider digits and small
    /// letters, on average, than six tenths of its size, or wider capitals than nine tenths.
    pub(super) fn width_of(self, text: &str) -> f64 {
        let tenths = |letter: char| if letter.is_uppercase() { 9 } else { 6 };
        self.units() * f64::from(text.chars().map(tenths).sum::<u32>()) / 10.0
    }
}

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// The length of an arrow, in user units.
pub(super) const ARROW: f64 = 9.0;

/// A sign that stands for a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Glyph {
    Marker(Marker),
    /// A triangle with its tip at the place. The direction has no zero length.
    Arrow([f64; 2]),
    /// A cross larger than the marker.
    Failure,
}

/// What a glyph looks like.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outline {
    /// A filled circle around the place.
    Circle { radius: f64 },
    /// A filled convex polygon.
    Polygon(Vec<Place>),
    /// Lines two units wide.
    Lines([[Place; 2]; 2]),
}

impl Glyph {
    /// The outline of the glyph at a place.
    pub(super) fn outline(self, [x, y]: Place) -> Outline {
        let polygon = |offsets: &[Place]| {
            Outline::Polygon(offsets.iter().map(|offset| [x + offset[0], y + offset[1]]).collect())
        };
        let cross = |arm: f64| {
            let [left, right, top, bottom] = [x - arm, x + arm, y - arm, y + arm];
            Outline::Lines([[[left, top], [right, bottom]], [[left, bottom], [right, top]]])
        };
        // The sizes look alike.
        match self {
            Self::Marker(Marker::Circle) => Outline::Circle { radius: 4.0 },
            Self::Marker(Marker::Square) => {
                polygon(&[[-3.5, -3.5], [3.5, -3.5], [3.5, 3.5], [-3.5, 3.5]])
            }
            Self::Marker(Marker::Triangle) => polygon(&[[0.0, -5.0], [4.5, 3.5], [-4.5, 3.5]]),
            Self::Marker(Marker::Diamond) => {
                polygon(&[[0.0, -5.0], [5.0, 0.0], [0.0, 5.0], [-5.0, 0.0]])
            }
            Self::Marker(Marker::Cross) => cross(3.5),
            Self::Failure => cross(5.5),
            Self::Arrow([dx, dy]) => {
                let [dx, dy] = [dx / dx.hypot(dy), dy / dx.hypot(dy)];
                let side = |half: f64| [-ARROW * dx - half * dy, -ARROW * dy + half * dx];
                polygon(&[[0.0, 0.0], side(4.5), side(-4.5)])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_written_as_css_reads_them() {
        assert_eq!(Color::GRID.to_string(), "#ddd");
        assert_eq!(Color::of_palette(6).to_string(), "#0072b2");
    }

    #[test]
    fn steps_have_a_corner_below_or_above_each_later_place() {
        let line = Line::Steps(vec![[0.0, 5.0], [3.0, 7.0]]);
        assert_eq!(line.corners(), [[0.0, 5.0], [3.0, 5.0], [3.0, 7.0]]);
        assert_eq!(Line::Steps(vec![]).corners(), [[0.0; 2]; 0]);
    }

    #[test]
    fn arrows_point_at_their_place_from_within() {
        let outline = Glyph::Arrow([0.0, 2.0]).outline([10.0, 20.0]);
        assert_eq!(outline, Outline::Polygon(vec![[10.0, 20.0], [5.5, 11.0], [14.5, 11.0]]));
    }
}
