//! Tests of whole charts.

use super::*;

fn curve(label: &str, points: Vec<[f64; 2]>, shape: Shape) -> Curve {
    let points = points.into_iter().map(Point::from).collect();
    Curve { label: label.to_owned(), points, shape, ..Curve::default() }
}

#[test]
fn lines_lead_from_point_to_point_and_steps_by_a_corner() {
    let points = vec![[100.0, 10_000.0], [0.0, 500.0], [10_000.0, 1_000_000.0]];
    let curve = |shape| {
        let curve = curve("a < b", points.clone(), shape);
        Curve { color: 7, is_dashed: true, ..curve }
    };
    let axis = Axis::new("", Scale::Log);
    let curves = vec![curve(Shape::Line), curve(Shape::Steps)];
    let chart = Chart { x: axis.clone(), y: axis, curves, ..Chart::default() };
    let text = svg(&[chart], 1);
    let stroke = r##"fill="none" stroke="#d55e00" stroke-width="2" stroke-dasharray="6 3"/>"##;
    for data in ["M60.0 318.0L350.0 48.0", "M60.0 318.0H350.0V48.0"] {
        assert!(text.contains(&format!("<path d=\"{data}\" {stroke}")), "{text}");
    }
    assert_eq!(text.matches(">a &lt; b</text>").count(), 2);
}

/// A chart of how much work buys how much precision, with all that a chart can have.
fn example() -> Chart {
    let labelled = |at, label: &str| Point { label: label.to_owned(), ..Point::from(at) };
    let bars = |at, x_range| Point { x_range: Some(x_range), ..Point::from(at) };
    let upright = |at, y_range| Point { y_range: Some(y_range), ..Point::from(at) };
    let marked = |label: &str, color, marker, points| {
        let label = label.to_owned();
        Curve { label, points, marker: Some(marker), color, ..Curve::default() }
    };
    let scattered = |label: &str, color, marker, points| {
        let curve = marked(label, color, marker, points);
        Curve { shape: Shape::Markers, ..curve }
    };
    let front = vec![[20.0, 0.5], [80.0, 0.02], [400.0, 1e-3], [3_000.0, 2e-5]];
    Chart {
        title: "Work and precision".to_owned(),
        x: Axis { range: Some([10.0, 1e5]), ..Axis::new("cycles a pixel", Scale::Log) },
        y: Axis::new("greatest error in pixels", Scale::Log),
        curves: vec![
            Curve { color: 5, ..curve("front", front, Shape::Steps) },
            marked(
                "every pixel",
                0,
                Marker::Circle,
                vec![
                    labelled([80.0, 0.02], "N = 8"),
                    labelled([95.0, 0.018], "N = 4"),
                    bars([400.0, 1e-3], [250.0, 600.0]),
                    labelled([3_000.0, 2e-5], "N = 1"),
                    labelled([2e5, 1e-6], "slow"), // beyond the range
                ],
            ),
            scattered(
                "affine",
                1,
                Marker::Square,
                vec![
                    labelled([20.0, 0.5], "A"),
                    upright([60.0, 0.3], [0.1, 0.9]),
                    labelled([50.0, f64::INFINITY], "fails"),
                ],
            ),
            Curve {
                is_dashed: true,
                ..marked(
                    "adaptive",
                    2,
                    Marker::Triangle,
                    vec![labelled([150.0, 0.05], "T"), Point::from([900.0, 4e-3])],
                )
            },
            scattered(
                "f64",
                3,
                Marker::Diamond,
                vec![labelled([2e4, 0.0], "exact"), Point::from([1e4, 1e-6])],
            ),
            scattered("quick", 4, Marker::Cross, vec![labelled([120.0, 0.2], "Q")]),
        ],
        references: vec![
            Reference { at: Level::Y(1.0 / 16.0), label: "a sub-pixel".to_owned() },
            Reference { at: Level::X(2_000.0), label: "budget".to_owned() },
            Reference { at: Level::X(1.0), label: "outside".to_owned() },
        ],
        shaded: vec![Level::Y(1e-5), Level::X(16.0)],
        has_equal_decades: true,
    }
}

#[test]
fn a_chart_has_all_its_parts() {
    let text = svg(&[example()], 1);
    let parts = [
        // Each marker stands once more in the legend.
        ("<circle", 4 + 1),
        (r##"Z" fill="#d55e00"/>"##, 2 + 1),
        (r##"Z" fill="#009e73"/>"##, 2 + 1),
        (r##"stroke="#e69f00" stroke-width="2""##, 1 + 1),
        // A diamond, and an arrow for the point at 0.
        (r##"Z" fill="#cc79a7"/>"##, 1 + 1 + 1),
        // An arrow for the point beyond the range.
        (r##"Z" fill="#0072b2"/>"##, 1),
        // The failure.
        (r##"stroke="#d55e00" stroke-width="2""##, 1),
        // Error bars: a line and its two ends.
        (r##"stroke="#0072b2"/>"##, 3),
        (r##"stroke="#d55e00"/>"##, 3),
        // The staircase, and its sample in the legend.
        (r##"stroke="#777" stroke-width="2""##, 1 + 1),
        // References; the one outside the range is left out.
        (r##"stroke="#555" stroke-width="1" stroke-dasharray="6 3""##, 2),
        (">outside</text>", 0),
        // The shaded regions: a decade of six from below, and log10(1.6) of a decade from the left;
        // a decade has 45 units.
        (r##"<rect x="60.0" y="273.0" width="180.0" height="45.0" fill="#eff3f7"/>"##, 1),
        (r##"<rect x="60.0" y="48.0" width="9.2" height="270.0" fill="#eff3f7"/>"##, 1),
    ];
    for (part, count) in parts {
        assert_eq!(text.matches(part).count(), count, "{part}");
    }
    let labels =
        ["N = 8", "N = 4", "N = 1", "slow", "A", "fails", "exact", "Q", "T", "a sub-pixel"];
    for label in labels {
        assert_eq!(text.matches(&format!(">{label}</text>")).count(), 1, "{label}");
    }
}

#[test]
fn points_without_a_place_stand_at_the_edge() {
    let text = svg(&[example()], 1);
    // Four decades across and six up are 180 by 270 units: 45 a decade, from (60, 318). The failure
    // at x = 50 is on the upper edge, log10(5) of a decade from the left: 91.5. The point at y = 0
    // is on the lower edge, at 3.301 decades: 208.5. The one at x = 2e5 is on the right edge.
    for part in ["M86.0 42.5L97.0 53.5", "M208.5 318.0L", "M240.0 318.0L231.0 "] {
        assert!(text.contains(part), "{part} {text}");
    }
}

#[test]
fn both_formats_show_the_same_parts() {
    let charts = [example(), example(), example()];
    let file = png(&charts, 2).unwrap();
    let mut reader = ::png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut dots = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut dots).unwrap();
    assert_eq!((frame.width, frame.height), (2 * 1040, 2 * 740));
    assert!(svg(&charts, 2).contains(r#"width="1040" height="740""#));
    let color = |x: usize, y: usize| {
        let start = 3 * (2 * y * frame.width as usize + 2 * x);
        [dots[start], dots[start + 1], dots[start + 2]]
    };
    // In the left chart, in the right one, and in the one below: the middle of the failure's cross,
    // a shaded corner, and the empty cell.
    for [x, y] in [[0, 0], [520, 0], [0, 370]] {
        let found = color(x + 91, y + 47);
        assert_eq!(found, [0xd5, 0x5e, 0x00]);
        assert_eq!(color(x + 62, y + 316), [0xef, 0xf3, 0xf7]);
    }
    assert_eq!(color(520 + 62, 370 + 316), [0xff; 3]);
}

#[test]
fn a_long_legend_has_room_before_the_next_chart() {
    let mut long = example();
    long.curves[0].label = "a label of forty characters, to be seen!".into();
    // The area ends at 240; 14 to the sample, 18 and 6 to the label, forty letters of 7.2, and 10.
    let text = svg(&[example(), long], 2);
    assert!(text.contains(r#"width="1152" height="370""#), "{text}");
    assert!(text.contains(r#"x="636.0""#), "the right chart begins at 576 + 60: {text}");
}
