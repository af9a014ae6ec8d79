//! How often each thing happened that timing depends on.

use std::fmt::{self, Display};

#[path = "count_fields.rs"]
#[macro_use]
mod fields;

macro_rules! declare {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// Counts of what timing depends on.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Counts {
            $($(#[$doc])* pub $field: u64,)*
        }

        impl Counts {
            /// Adds counts a number of times.
            pub const fn add(&mut self, other: &Self, times: u64) {
                $(self.$field += times * other.$field;)*
            }

            /// Subtracts counts that were added before.
            pub const fn subtract(&mut self, other: &Self) {
                $(self.$field -= other.$field;)*
            }
        }

        /// A JSON object without the counts that are 0.
        impl Display for Counts {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                let mut separator = "{";
                for (name, count) in [$((stringify!($field), self.$field)),*] {
                    if count > 0 {
                        write!(f, r#"{separator}"{name}":{count}"#)?;
                        separator = ",";
                    }
                }
                f.write_str(if separator == "{" { "{}" } else { "}" })
            }
        }
    };
}
count_fields!(declare);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_shown_as_an_object_of_those_above_zero() {
        let mut counts = Counts::default();
        assert_eq!(counts.to_string(), "{}");
        let load = Counts { instructions: 1, loads: 1, ..Counts::default() };
        counts.add(&load, 3);
        counts.subtract(&load);
        assert_eq!(counts.to_string(), r#"{"instructions":2,"loads":2}"#);
    }
}
