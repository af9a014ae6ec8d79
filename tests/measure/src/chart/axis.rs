//! The range of an axis, its ticks, and which of them have room for a label.

use super::{Axis, Scale};

/// The values from one end of an axis to the other, and those that are marked on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Range {
    scale: Scale,
    pub(super) first: f64,
    pub(super) last: f64,
    pub(super) ticks: Vec<f64>,
}

impl Scale {
    /// Whether a value has a place on the axis.
    pub(super) fn has(self, value: f64) -> bool {
        value.is_finite() && (self == Self::Linear || value > 0.0)
    }
}

impl Range {
    /// The range that the axis states, or else one over the values.
    pub(super) fn of(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let scale = axis.scale;
        match axis.range {
            None => Self::over(scale, values),
            Some([first, last]) => {
                let ticks = match scale {
                    Scale::Linear => multiples(round_up((last - first) / 5.0), first, last),
                    Scale::Log => round_numbers(first, last),
                };
                Self { scale, first, last, ticks }
            }
        }
    }

    /// From the least value to the greatest, both moved outwards to a round number.
    fn over(scale: Scale, values: impl Iterator<Item = f64>) -> Self {
        let (first, last) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (value.min(a), value.max(b)));
        let (first, last) = if first <= last { (first, last) } else { (1.0, 1.0) };
        if scale == Scale::Linear {
            let last = if last > first { last } else { first + 1.0 };
            let step = round_up((last - first) / 5.0);
            let (first, last) = ((first / step).floor() * step, (last / step).ceil() * step);
            return Self { scale, first, last, ticks: multiples(step, first, last) };
        }
        let (first, last) = (1.0 / round_up(1.0 / first), round_up(last));
        let last = if last > first { last } else { 10.0 * first };
        Self { scale, first, last, ticks: round_numbers(first, last) }
    }

    /// Where a value lies: 0 at the first, 1 at the last.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [value, first, last] = [value, self.first, self.last]
            .map(|value| if self.scale == Scale::Log { value.log10() } else { value });
        (value - first) / (last - first)
    }

    /// The number of decades of a logarithmic axis.
    pub(super) fn decades(&self) -> f64 {
        (self.last / self.first).log10()
    }

    /// The label of each tick that has room for one. `length` is how much of the axis a label
    /// takes, where the whole axis is 1.
    ///
    /// Labels of powers of ten come first: of all, or of every second, third and so on. Those
    /// between them take the room that is left.
    pub(super) fn labels(&self, length: impl Fn(&str) -> f64) -> Vec<Option<String>> {
        let labels: Vec<_> = self.ticks.iter().map(|&tick| label(tick)).collect();
        let is_clear = |a: usize, b: usize| {
            let distance = self.place(self.ticks[a]) - self.place(self.ticks[b]);
            // A half of each label lies between their ticks.
            2.0 * distance.abs() >= length(&labels[a]) + length(&labels[b])
        };
        let main = |(index, tick): (usize, &f64)| match self.scale {
            Scale::Linear => Some((index, index as i32)),
            Scale::Log => {
                let exponent = tick.log10();
                let is_whole = (exponent - exponent.round()).abs() < 1e-6;
                is_whole.then(|| (index, exponent.round() as i32))
            }
        };
        let main: Vec<_> = self.ticks.iter().enumerate().filter_map(main).collect();
        let mut kept = Vec::new();
        for step in 1.. {
            let every = main.iter().filter(|(_, number)| number % step == 0);
            kept = every.map(|&(index, _)| index).collect();
            if kept.windows(2).all(|pair| is_clear(pair[0], pair[1])) {
                break;
            }
        }
        for index in 0..labels.len() {
            if !kept.contains(&index)
                && !main.iter().any(|&(other, _)| other == index)
                && kept.iter().all(|&other| is_clear(index, other))
            {
                kept.push(index);
            }
        }
        let labels = labels.into_iter().enumerate();
        labels.map(|(index, label)| kept.contains(&index).then_some(label)).collect()
    }
}

/// The multiples of `step` between two values. Those that rounding moves just beyond count too.
fn multiples(step: f64, first: f64, last: f64) -> Vec<f64> {
    let [first, last] = [(first / step - 1e-6).ceil(), (last / step + 1e-6).floor()];
    (first as i32..=last as i32).map(|tick| step * f64::from(tick)).collect()
}

/// The powers of ten between two values; their double and fivefold too, if there is room for them.
fn round_numbers(first: f64, last: f64) -> Vec<f64> {
    // Beyond three decades there is no room for labels between them.
    let factors = if last < 999.0 * first { &[1.0, 2.0, 5.0][..] } else { &[1.0] };
    let exponents = first.log10().floor() as i32..=last.log10().ceil() as i32;
    let ticks = exponents.flat_map(|exponent| factors.iter().map(move |f| f * power(exponent)));
    ticks.filter(|tick| (0.999 * first..1.001 * last).contains(tick)).collect()
}

/// The least of 1, 2, 5 and 10 times a power of ten that is not below a positive value.
fn round_up(value: f64) -> f64 {
    let decade = power(value.log10().floor() as i32);
    let is_enough = |factor: &f64| factor * decade >= 0.999_999 * value;
    decade * [1.0, 2.0, 5.0].into_iter().find(is_enough).unwrap_or(10.0)
}

fn power(exponent: i32) -> f64 {
    10f64.powi(exponent)
}

/// A tick's label, as in 2e-6, 0.2, 100, 20k, 3M, 1e12.
fn label(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(0.000_999..0.999e12).contains(&size) {
        // The digits of a round number; the power of ten may be off in the last place.
        return format!("{value:.2e}").replacen(".00", "", 1).replacen("0e", "e", 1);
    }
    let units = [(1e9, "G"), (1e6, "M"), (1e3, "k")];
    let unit = units.into_iter().find(|(unit, _)| size >= 0.999 * unit);
    let (unit, name) = unit.unwrap_or((1.0, ""));
    format!("{}{name}", (value / unit * 1e6).round() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(range: &Range) -> String {
        range.ticks.iter().map(|&tick| label(tick)).collect::<Vec<_>>().join(" ")
    }

    fn labels(scale: Scale, values: &[f64]) -> String {
        joined(&Range::over(scale, values.iter().copied()))
    }

    /// The labels that have room if each character takes this part of the axis.
    fn with_room(first: f64, last: f64, part: f64) -> String {
        let range = Range::over(Scale::Log, [first, last].into_iter());
        let labels = range.labels(|label| part * label.len() as f64);
        labels.into_iter().map(|label| label.unwrap_or("-".into())).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn axes_end_and_are_marked_at_round_numbers() {
        assert_eq!(labels(Scale::Log, &[98.0, 25_000_000.0]), "100 1k 10k 100k 1M 10M");
        assert_eq!(labels(Scale::Log, &[0.3, 8.0]), "0.2 0.5 1 2 5 10");
        assert_eq!(labels(Scale::Log, &[100.0]), "100 200 500 1k");
        assert_eq!(labels(Scale::Linear, &[-0.1, 0.93]), "-0.5 0 0.5 1");
        assert_eq!(labels(Scale::Linear, &[12_000.0, 20_500.0]), "12k 14k 16k 18k 20k 22k");
        assert_eq!(labels(Scale::Linear, &[]), "1 1.2 1.4 1.6 1.8 2");
        assert_eq!(labels(Scale::Log, &[1.1e-6, 4e-5]), "1e-6 2e-6 5e-6 1e-5 2e-5 5e-5");
        assert_eq!(labels(Scale::Log, &[2e-5, 9e-1]), "1e-4 0.001 0.01 0.1 1");
    }

    #[test]
    fn fixed_axes_end_where_they_are_told_to() {
        let fixed = |scale, range| {
            let axis = Axis { range: Some(range), ..Axis::new("", scale) };
            Range::of(&axis, [1e-9, 1e9].into_iter())
        };
        let range = fixed(Scale::Log, [0.3, 30.0]);
        assert_eq!((range.first, range.last), (0.3, 30.0));
        assert_eq!(joined(&range), "0.5 1 2 5 10 20");
        assert_eq!(joined(&fixed(Scale::Linear, [0.5, 4.2])), "1 2 3 4");
    }

    #[test]
    fn places_are_in_proportion_to_values_or_to_their_logarithms() {
        let place = |scale, value| Range::over(scale, [100.0, 100_000.0].into_iter()).place(value);
        for (scale, middle) in [(Scale::Log, 1_000.0), (Scale::Linear, 33_333.333_333)] {
            assert!((place(scale, 100_000.0) - 1.0).abs() < 1e-9);
            assert!((place(scale, middle) - 1.0 / 3.0).abs() < 1e-9); // logarithms are rounded
        }
    }

    #[test]
    fn labels_without_room_are_left_out_evenly() {
        assert_eq!(with_room(1.0, 100.0, 0.04), "1 2 5 10 20 50 100");
        // From 1 to 2, and from 10 to 20, are 0.15 of the axis; labels of 10 and 20 take 0.16.
        assert_eq!(with_room(1.0, 100.0, 0.08), "1 2 5 10 - - 100");
        assert_eq!(with_room(1e-6, 1e3, 0.05), "1e-6 - 1e-4 - 0.01 - 1 - 100 -");
    }
}
