//! What the plugin counts: instructions by what their timing depends on.

use std::ops::Add;

use serde::{Deserialize, Serialize};

#[path = "../plugin/src/count_fields.rs"]
#[macro_use]
mod fields;

macro_rules! declare {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// Counts of what timing depends on. Counts of 0 are not written to files.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub(crate) struct Counts {
            $($(#[$doc])*
            #[serde(skip_serializing_if = "is_zero")]
            pub(crate) $field: u64,)*
        }

        impl Add for Counts {
            type Output = Self;

            fn add(self, other: Self) -> Self {
                Self { $($field: self.$field + other.$field,)* }
            }
        }
    };
}
count_fields!(declare);

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_zero(count: &u64) -> bool {
    *count == 0
}

/// What the plugin has counted in each stage that the firmware marks, in the order of the
/// firmware's `Stage`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub(crate) struct Stages {
    pub(crate) clear: Counts,
    pub(crate) vertices: Counts,
    pub(crate) draw: Counts,
}

impl Stages {
    /// How many there are.
    pub(crate) const COUNT: usize = 3;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_an_array_of_counts() {
        let report = r#"[{},{"instructions":7},{"instructions":20,"loads":3}]"#;
        let stages: Stages = serde_json::from_str(report).unwrap();
        assert_eq!(stages.clear, Counts::default());
        let sum = stages.vertices + stages.draw;
        assert_eq!(sum, Counts { instructions: 27, loads: 3, ..Counts::default() });
        assert_eq!(serde_json::to_string(&sum).unwrap(), r#"{"instructions":27,"loads":3}"#);
        let unknown = r#"[{},{"instruction":7},{}]"#;
        assert!(serde_json::from_str::<Stages>(unknown).is_err());
    }
}
