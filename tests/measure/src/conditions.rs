//! What figures were measured with.

use std::{
    fmt::{self, Display},
    time::SystemTime,
};

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use crate::{cores::Core, firmware, qemu};

/// The day, and what the figures depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Conditions {
    /// As in 2026-01-31 (UTC).
    pub(crate) date: String,
    /// The compiler's version, as it says it.
    pub(crate) rustc: String,
    pub(crate) opt_level: String,
    pub(crate) qemu: String,
}

impl Conditions {
    /// Today's, for firmware that has printed these lines on a core.
    ///
    /// # Errors
    ///
    /// If the first line is not the firmware's `opt-level`.
    pub(crate) fn of(core: Core, lines: &[String]) -> Result<Self> {
        let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
        Ok(Self {
            date: date(now.map_or(0, |time| time.as_secs() / 86_400)),
            rustc: firmware::compiler_version(core)?,
            opt_level: opt_level(lines)?,
            qemu: qemu::version(core)?,
        })
    }
}

/// Without the date.
impl Display for Conditions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // The compiler's version may end in its hash and source, in parentheses.
        let rustc = self.rustc.split(" (").next().unwrap_or_default();
        write!(f, "{rustc}, opt-level {}, QEMU {}", self.opt_level, self.qemu)
    }
}

fn opt_level(lines: &[String]) -> Result<String> {
    let first = lines.first().map_or("nothing", String::as_str);
    let level = first.strip_prefix("opt-level ");
    Ok(level
        .with_context(|| format!("the firmware begins with `{first}`, not with its opt-level"))?
        .to_owned())
}

/// The date of a day counted from 1970-01-01.
///
/// Howard Hinnant, "chrono-compatible low-level date algorithms", `civil_from_days`: years begin in
/// March, so that the day that some lack is their last; 400 years are 146,097 days.
fn date(day: u64) -> String {
    let day = day + 719_468; // from 0000-03-01
    let (era, day) = (day / 146_097, day % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, carry) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + carry)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        let days = [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_453, "2025-12-31"),
        ];
        for (day, expected) in days {
            assert_eq!(date(day), expected);
        }
    }

    #[test]
    fn the_first_line_is_the_opt_level() {
        assert_eq!(opt_level(&["opt-level s".into(), "x".into()]).unwrap(), "s");
        assert!(opt_level(&["panicked".into()]).unwrap_err().to_string().contains("`panicked`"));
        assert!(opt_level(&[]).is_err());
    }
}
