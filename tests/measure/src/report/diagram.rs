//! The work-precision diagrams: error over run time, both logarithmic.

use super::{
    choices::{Choice, Correction},
    points::{Measured, Point},
};
use crate::{
    chart::{Axis, Chart, Curve, Level, Marker, Point as Place, Reference, Scale, Shape},
    cores::Core,
};

/// The root of the mean square of rounding to RGB565, in steps of 8 bits: a step of red and of blue
/// is 255 / 31, one of green 255 / 63, and rounding to the nearest has a deviation of a step over
/// the root of 12. A display with these colours shows no error below it.
fn rgb565_rounding() -> f64 {
    let squares = [31.0, 63.0, 31.0].map(|steps: f64| (255.0 / steps).powi(2) / 12.0);
    (squares.iter().sum::<f64>() / 3.0).sqrt()
}

const MARKERS: [Marker; 5] =
    [Marker::Circle, Marker::Square, Marker::Triangle, Marker::Diamond, Marker::Cross];

/// The diagram of a scene on a core, or on the host.
pub(super) fn diagram(measured: &Measured, core: Option<Core>) -> Chart {
    let place = |point: &Point| -> Option<[f64; 2]> {
        Some([point.figure(core)? as f64, point.errors.rms])
    };
    let found = |choice| measured.points.iter().find(|point| point.choice == choice);
    let mut curves: Vec<Curve> = Vec::new();
    for (number, method) in measured.scene.methods().into_iter().enumerate() {
        let points = method.choices.into_iter().filter_map(|choice| {
            let point = found(choice)?;
            let cycles = core.and_then(|core| point.cost(core)?.cycles);
            let range = match core {
                Some(_) => cycles.map(|[least, _, most]| [least, most]),
                None => Some([point.nanoseconds[0], point.nanoseconds[2]]),
            };
            Some(Place {
                at: place(point)?,
                x_range: range.filter(|[least, most]| least < most).map(|r| r.map(|c| c as f64)),
                ..Place::default()
            })
        });
        let points: Vec<_> = points.collect();
        // On this core its run time may not be known.
        if points.is_empty() {
            continue;
        }
        curves.push(Curve {
            label: method.name.to_owned(),
            points,
            shape: Shape::Line,
            // A second curve of a colour has another marker.
            marker: Some(MARKERS[(number + number / 5) % MARKERS.len()]),
            color: number % 5,
            is_dashed: number >= 5,
        });
    }
    let points = measured.front(core).into_iter().filter_map(|point| Some(place(point)?.into()));
    curves.insert(
        0,
        Curve {
            label: "cheapest for its error".into(),
            points: points.collect(),
            shape: Shape::Steps,
            marker: None,
            color: 5,
            is_dashed: false,
        },
    );
    let (on, unit) = run_time(core);
    let reference =
        |error: f64, label: &str| Reference { at: Level::Y(error), label: label.into() };
    Chart {
        title: format!("{} on {on}", measured.scene.name),
        x: Axis::new(unit, Scale::Log),
        y: Axis::new("RMS error of colour, in steps of 8 bits", Scale::Log),
        curves,
        references: vec![
            reference(rgb565_rounding(), "rounding to RGB565"),
            reference(measured.reference_rms, "the reference's own error"),
        ],
        shaded: vec![Level::Y(rgb565_rounding())],
        ..Chart::default()
    }
}

/// The error of texture coordinates on a core, or on the host, by the number of pixels from one
/// division to the next.
pub(super) fn texels(measured: &Measured, core: Option<Core>) -> Chart {
    let place = |correction| -> Option<Place> {
        let most = measured.texels.iter().find(|texels| texels.correction == correction)?.most;
        let choice = Choice::corrected(correction);
        let point = measured.points.iter().find(|point| point.choice == choice)?;
        Some([point.figure(core)? as f64, most].into())
    };
    let curves = [
        ("every 32 to 4 pixels", [32, 16, 8, 4].map(Correction::Every).to_vec()),
        ("adaptive, 1/2 texel", vec![Correction::Adaptive(8)]),
        ("every pixel", vec![Correction::EveryPixel]),
    ];
    let curves = curves.into_iter().enumerate().map(|(number, (label, corrections))| Curve {
        label: label.into(),
        points: corrections.into_iter().filter_map(place).collect(),
        shape: Shape::Line,
        marker: Some(MARKERS[number]),
        color: number,
        is_dashed: false,
    });
    let (on, unit) = run_time(core);
    Chart {
        title: format!("{}: perspective, on {on}", measured.scene.name),
        x: Axis::new(unit, Scale::Log),
        y: Axis::new("largest error of a coordinate, in texels", Scale::Log),
        curves: curves.collect(),
        references: vec![Reference { at: Level::Y(0.5), label: "half a texel".into() }],
        ..Chart::default()
    }
}

/// Where frames are drawn, and the unit of their run time.
const fn run_time(core: Option<Core>) -> (&'static str, &'static str) {
    match core {
        Some(core) => (core.title(), "cycles of a frame"),
        None => ("this machine", "nanoseconds of a frame"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_rounding_is_that_of_its_steps() {
        // 8.23 / 3.46 of red and of blue, 4.05 / 3.46 of green.
        assert!((rgb565_rounding() - 2.055).abs() < 0.005);
    }
}
