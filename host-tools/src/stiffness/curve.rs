//! A family of problems, its curve of error against stiffness, and the slope of that.

use super::work::Cost;
use crate::reference::random::Random;

/// Problems that differ in one parameter, and what is known about their error.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// What it is about, in a few words.
    pub name: &'static str,
    /// What an instance of it is, and how it is judged.
    pub about: &'static str,
    /// The parameter, with its unit.
    pub parameter: &'static str,
    /// The error, with its unit.
    pub error: &'static str,
    /// The slopes that theory expects.
    pub laws: &'static [Law],
    /// The bound that the documentation states, and where it comes from.
    pub bound: &'static str,
    /// Where the bound ends, and what happens beyond.
    pub end: &'static str,
    /// What is measured of its run time.
    pub cost: Cost,
    pub(super) measure: fn(instances: usize) -> Vec<Point>,
}

/// The slope of the logarithm of an error, or of a run time, over that of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// The slope: the power of the parameter that it grows with.
    pub slope: f64,
    /// How far the fitted slope may lie off.
    pub tolerance: f64,
    /// The first and the last parameter for which it holds.
    pub segment: [f64; 2],
    /// Why the slope is that.
    pub why: &'static str,
}

/// All instances with one value of the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// The value of the parameter.
    pub parameter: f64,
    /// The largest error; `None` if there is none, because all instances are without a result.
    pub error: Option<f64>,
    /// The bound; `None` where none is stated.
    pub bound: Option<f64>,
    /// How many instances there are.
    pub instances: usize,
    /// How many of them are without a result: the core refuses them with an error value, or they
    /// cover no pixel.
    pub without: usize,
}

/// The error of a family against its parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// In the order of the parameter.
    pub points: Vec<Point>,
}

impl Family {
    /// Measures the error with this number of random instances for each value of the parameter.
    /// They are the same on every host.
    #[must_use]
    pub fn measure(&self, instances: usize) -> Curve {
        Curve { points: (self.measure)(instances) }
    }
}

impl Curve {
    /// The slope of the errors in a law's segment; `None` unless at least two of its points have an
    /// error over 0.
    #[must_use]
    pub fn slope(&self, law: &Law) -> Option<f64> {
        let errors = self.points.iter().map(|point| (point.parameter, point.error));
        law.slope_of(errors.filter_map(|(parameter, error)| Some([parameter, error?])))
    }

    /// The largest error as a part of its bound: 1 or less if all errors are within their bounds.
    #[must_use]
    pub fn share_of_bound(&self) -> f64 {
        let share = |point: &Point| Some(point.error? / point.bound?);
        self.points.iter().filter_map(share).fold(0.0, f64::max)
    }
}

impl Law {
    /// The slope of points in its segment, each of a parameter and a value, by least squares of
    /// their logarithms; `None` unless at least two of the values are over 0.
    pub fn slope_of(&self, points: impl Iterator<Item = [f64; 2]>) -> Option<f64> {
        let [first, last] = self.segment;
        let points = points.filter(|[parameter, _]| (first..=last).contains(parameter));
        let points: Vec<_> =
            points.map(|point| point.map(f64::ln)).filter(|[_, value]| value.is_finite()).collect();
        let count = points.len() as f64;
        let mean = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
        let sum = |axis: usize| -> f64 {
            points.iter().map(|point| (point[0] - mean[0]) * (point[axis] - mean[axis])).sum()
        };
        (points.len() > 1).then(|| sum(1) / sum(0))
    }
}

/// The powers of two from 2^`first` to 2^`last`.
pub(super) fn powers(first: i32, last: i32) -> impl Iterator<Item = f64> {
    (first..=last).map(|exponent| 2f64.powi(exponent))
}

/// Measures a curve. `error` solves a random instance and returns its error, or `None` without
/// a result. The instances have the same random numbers for each parameter.
pub(super) fn sweep(
    parameters: impl Iterator<Item = f64>,
    instances: usize,
    bound: impl Fn(f64) -> Option<f64>,
    error: impl Fn(f64, &mut Random) -> Option<f64>,
) -> Vec<Point> {
    let point = |parameter| {
        let mut random = Random(1);
        let errors: Vec<f64> =
            (0..instances).filter_map(|_| error(parameter, &mut random)).collect();
        Point {
            parameter,
            error: errors.iter().copied().reduce(f64::max),
            bound: bound(parameter),
            instances,
            without: instances - errors.len(),
        }
    };
    parameters.map(point).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Asserts that a family has the slopes that its laws state, and keeps its bound. A bound that
    /// is over ten times the largest error would say little.
    pub(in super::super) fn holds(family: &Family) {
        let curve = family.measure(super::super::INSTANCES);
        for law in family.laws {
            let slope = curve.slope(law).expect("its segment has points");
            let off = (slope - law.slope).abs();
            assert!(off <= law.tolerance, "{}: {slope} instead of {law:?}", family.name);
        }
        let share = curve.share_of_bound();
        assert!(share <= 1.0, "{}: {share} of the bound: {curve:#?}", family.name);
        assert!(share > 0.1, "{}: {share} of the bound", family.name);
    }

    fn point(parameter: f64, error: f64, bound: f64) -> Point {
        let [error, bound] = [error, bound].map(|value| (value > 0.0).then_some(value));
        Point { parameter, error, bound, instances: 1, without: 0 }
    }

    #[test]
    fn a_slope_is_that_of_a_power_in_its_segment() {
        let law = |segment| Law { slope: 2.0, tolerance: 0.0, segment, why: "" };
        let mut points: Vec<_> = powers(-3, 3).map(|x| point(x, 7.0 * x.powi(2), 0.0)).collect();
        points.push(point(16.0, 1e9, 0.0));
        points.push(point(32.0, 0.0, 0.0));
        let curve = Curve { points };
        let slope = curve.slope(&law([0.125, 8.0])).unwrap();
        assert!((slope - 2.0).abs() < 1e-12, "{slope}");
        assert!(curve.slope(&law([0.125, 16.0])).unwrap() > 2.5);
        assert_eq!(curve.slope(&law([8.0, 9.0])), None);
        assert_eq!(curve.slope(&law([16.0, 64.0])), None);
    }

    #[test]
    fn a_share_is_the_largest_where_a_bound_is_stated() {
        let points = vec![point(1.0, 1.0, 4.0), point(2.0, 3.0, 5.0), point(4.0, 9.0, 0.0)];
        assert_eq!(Curve { points }.share_of_bound(), 0.6);
    }

    #[test]
    fn points_have_the_largest_error_and_count_what_has_none() {
        let points = sweep(
            [1.0, 2.0].into_iter(),
            100,
            |_| None,
            |parameter, random| {
                let error = random.real(0.0, 1.0) * parameter;
                (error < 1.0).then_some(error)
            },
        );
        assert_eq!(points[0].without, 0);
        assert!((20..80).contains(&points[1].without), "{points:?}");
        assert!(points.iter().all(|point| point.error.is_some_and(|error| error > 0.9)));
    }
}
