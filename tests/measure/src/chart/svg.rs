//! A canvas that writes SVG.

use std::fmt::Write as _;

use super::canvas::{Anchor, Canvas, Color, DASH, Glyph, Line, Outline, Place, Stroke, TextSize};

/// A picture as the text of an SVG file.
#[derive(Clone, Debug)]
pub(super) struct Svg {
    text: String,
}

impl Svg {
    /// A white picture. The size is in user units.
    pub(super) fn new([width, height]: [f64; 2]) -> Self {
        Self {
            text: format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"
 width="{width}" height="{height}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="white"/>
"#
            ),
        }
    }

    /// The whole file.
    pub(super) fn finish(self) -> String {
        self.text + "</svg>\n"
    }

    fn path(&mut self, data: &str, stroke: Stroke) {
        let Stroke { color, width, is_dashed } = stroke;
        let attributes = if stroke == Stroke::thin(color) {
            format!(r#"stroke="{color}""#)
        } else {
            let [dash, gap] = DASH;
            let dashes = if is_dashed { format!("{dash} {gap}") } else { "none".to_owned() };
            format!(r#"stroke="{color}" stroke-width="{width}" stroke-dasharray="{dashes}""#)
        };
        self.text += &format!("<path d=\"{data}\" fill=\"none\" {attributes}/>\n");
    }
}

impl Canvas for Svg {
    fn line(&mut self, line: &Line, stroke: Stroke) {
        self.path(&data(line), stroke);
    }

    fn rectangle(&mut self, [x, y]: Place, [width, height]: [f64; 2], color: Color) {
        self.text += &format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" \
             fill=\"{color}\"/>\n"
        );
    }

    fn glyph(&mut self, glyph: Glyph, at: Place, color: Color) {
        match glyph.outline(at) {
            Outline::Circle { radius } => {
                let [x, y] = at;
                self.text += &format!(
                    "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{color}\"/>\n"
                );
            }
            Outline::Polygon(corners) => {
                let data = straight(&corners);
                self.text += &format!("<path d=\"{data}Z\" fill=\"{color}\"/>\n");
            }
            Outline::Lines(lines) => {
                let data = lines.map(|line| straight(&line)).concat();
                self.path(&data, Stroke { color, width: 2.0, is_dashed: false });
            }
        }
    }

    fn text(&mut self, text: &str, [x, y]: Place, size: TextSize, anchor: Anchor) {
        let size = match size {
            TextSize::Normal => None,
            _ => Some(format!(r#"font-size="{}""#, size.units())),
        };
        let anchor = match anchor {
            Anchor::Start => None,
            Anchor::Middle => Some(r#"text-anchor="middle""#.to_owned()),
            Anchor::End => Some(r#"text-anchor="end""#.to_owned()),
        };
        let attributes = [size, anchor].into_iter().flatten().collect::<Vec<_>>().join(" ");
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        let color = Color::TEXT;
        self.text += &format!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{color}\" {attributes}>{text}</text>\n"
        );
    }
}

/// The commands of a path.
fn data(line: &Line) -> String {
    match *line {
        Line::Straight(ref places) => straight(places),
        Line::Steps(ref places) => {
            let mut data = straight(places.get(..1).unwrap_or_default());
            for [x, y] in places.iter().skip(1) {
                // Writing to a string cannot fail.
                let _ = write!(data, "H{x:.1}V{y:.1}");
            }
            data
        }
        Line::Upright { x, top, bottom } => format!("M{x:.1} {top}V{bottom}"),
        Line::Level { y, left, right } => format!("M{left} {y:.1}H{right}"),
        Line::Sample { at: [x, y], width } => format!("M{x} {y:.1}h{width}"),
    }
}

fn straight(places: &[Place]) -> String {
    let commands = ["M"].into_iter().chain(std::iter::repeat("L"));
    places.iter().zip(commands).map(|([x, y], command)| format!("{command}{x:.1} {y:.1}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_becomes_elements() {
        let mut svg = Svg::new([20.0, 10.0]);
        let (color, at) = (Color::of_palette(0), [5.0, 6.0]);
        svg.line(&Line::Straight(vec![]), Stroke::thin(color));
        svg.rectangle(at, [1.0, 2.0], Color::SHADE);
        svg.glyph(Glyph::Failure, at, color);
        svg.glyph(Glyph::Arrow([1.0, 0.0]), at, color);
        svg.text("a < b & c", at, TextSize::Small, Anchor::End);
        let text = svg.finish();
        let elements: Vec<_> = text.lines().skip(3).collect();
        assert_eq!(
            elements,
            [
                r##"<path d="" fill="none" stroke="#0072b2"/>"##,
                r##"<rect x="5.0" y="6.0" width="1.0" height="2.0" fill="#eff3f7"/>"##,
                r##"<path d="M-0.5 0.5L10.5 11.5M-0.5 11.5L10.5 0.5" fill="none" stroke="#0072b2" stroke-width="2" stroke-dasharray="none"/>"##,
                r##"<path d="M5.0 6.0L-4.0 10.5L-4.0 1.5Z" fill="#0072b2"/>"##,
                r##"<text x="5.0" y="6.0" fill="#333" font-size="10" text-anchor="end">a &lt; b &amp; c</text>"##,
                "</svg>",
            ]
        );
    }
}
