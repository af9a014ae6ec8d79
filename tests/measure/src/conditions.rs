//! The conditions that figures were measured under.

use std::{
    fmt::{self, Display},
    time::SystemTime,
};

use anyhow::{Context as _, Result};
use serde::{Deserialize, Serialize};

use crate::{cores::Core, firmware, qemu};

/// The day, and the tools that the figures depend on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Conditions {
    /// As in 2026-01-31 (UTC).
    pub(crate) date: String,
    /// The output of `rustc --version`.
    pub(crate) rustc: String,
    pub(crate) opt_level: String,
    pub(crate) qemu: String,
}

impl Conditions {
    /// The conditions of today, for firmware that printed these lines on a core.
    ///
    /// # Errors
    ///
    /// Returns an error if the first line is not the firmware's `opt-level`.
    pub(crate) fn of(core: Core, lines: &[String]) -> Result<Self> {
        let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        Ok(Self {
            date: now.split('T').next().unwrap_or_default().to_owned(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_is_the_opt_level() {
        assert_eq!(opt_level(&["opt-level s".into(), "x".into()]).unwrap(), "s");
        assert!(opt_level(&["panicked".into()]).unwrap_err().to_string().contains("`panicked`"));
        assert!(opt_level(&[]).is_err());
    }
}
