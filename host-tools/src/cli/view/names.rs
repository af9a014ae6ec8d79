//! Names of values and ranges of numbers on the command line.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// The name of a value.
pub(super) fn name<T: PartialEq>(table: &[(&'static str, T)], value: T) -> &'static str {
    table.iter().find(|(_, v)| *v == value).map_or("", |(name, _)| name)
}

/// A parser of the names in a table.
pub(in crate::cli) fn choice<T: Copy + Send + Sync + 'static, const N: usize>(
    table: &'static [(&'static str, T); N],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(table.iter().map(|(name, _)| *name)).try_map(|given| {
        let found = table.iter().find(|(name, _)| *name == given);
        found.map(|(_, value)| *value).ok_or("unknown name")
    })
}

/// A parser of numbers from `least` to `most`. Infinities and NaN lie in no such range.
pub(in crate::cli) fn within(
    least: f64,
    most: f64,
) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| {
        let number = text.parse().ok().filter(|n| (least..=most).contains(n));
        number.ok_or_else(|| format!("it must be a number from {least} to {most}"))
    }
}

/// Numbers up to 32,000 with commas between them.
pub(in crate::cli) fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.trim().parse().ok().filter(|n: &f64| n.abs() <= 32_000.0);
    text.split(',').map(number).collect()
}
