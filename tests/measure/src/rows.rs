//! JSON for files that people compare: a row of figures is a line.

use std::io::{Result, Write};

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter, Serializer};

/// Levels that have a line for each of their items. Deeper ones stay on the line.
const DEPTH: u32 = 4;

/// Returns a value as JSON: with line breaks down to the rows of the figures of each core.
pub(crate) fn to_string(value: &impl Serialize) -> serde_json::Result<String> {
    let mut bytes = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut bytes, Rows::default()))?;
    bytes.push(b'\n');
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[derive(Default)]
struct Rows {
    depth: u32,
    pretty: PrettyFormatter<'static>,
    compact: CompactFormatter,
}

/// Hands each call to one of the two formatters, by the depth before or after it.
macro_rules! by_depth {
    ($($name:ident($($argument:ident: $kind:ty)?) $change:literal,)*) => {
        impl Formatter for Rows {
            $(fn $name<W: ?Sized + Write>(
                &mut self,
                writer: &mut W,
                $($argument: $kind,)?
            ) -> Result<()> {
                // The outermost bracket opens level 1, and closes it.
                let level = self.depth + u32::from($change == 1);
                self.depth = self.depth.saturating_add_signed($change);
                if level <= DEPTH {
                    self.pretty.$name(writer, $($argument)?)
                } else {
                    self.compact.$name(writer, $($argument)?)
                }
            })*
        }
    };
}
by_depth! {
    begin_array() 1,
    end_array() -1,
    begin_array_value(is_first: bool) 0,
    end_array_value() 0,
    begin_object() 1,
    end_object() -1,
    begin_object_key(is_first: bool) 0,
    begin_object_value() 0,
    end_object_value() 0,
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::*;

    #[test]
    fn a_row_is_a_line() {
        let value = json!({ "cores": [{ "core": "m4", "rows": [
            { "a": [1, 2], "b": { "c": 3 } },
            { "a": [], "b": {} },
        ] }] });
        let text = to_string(&value).unwrap();
        let lines: Vec<_> = text.lines().map(str::trim).collect();
        assert!(lines.contains(&r#"{"a":[1,2],"b":{"c":3}},"#), "{text}");
        assert!(lines.contains(&r#"{"a":[],"b":{}}"#), "{text}");
        assert!(lines.contains(&r#""core": "m4","#), "{text}");
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }
}
