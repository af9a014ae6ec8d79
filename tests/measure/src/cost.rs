//! What the firmware counts while it draws a scene.

use anyhow::{Context as _, Result, ensure};
use serde::{Deserialize, de::DeserializeOwned};

use crate::cores::Core;

#[path = "../../firmware/src/cost_fields.rs"]
#[macro_use]
mod fields;

macro_rules! declare {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// Sums over the frames, in units of the core's counter.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
        pub(crate) struct Cost {
            $($(#[$doc])* pub(crate) $field: u64,)*
        }
    };
}
cost_fields!(declare);

impl Cost {
    /// The mean of a sum over the frames, rounded to the nearest.
    pub(crate) const fn mean(&self, sum: u64) -> u64 {
        (sum + self.frames / 2) / self.frames
    }

    /// Instructions a frame, of a sum that the core's counter has measured.
    pub(crate) const fn instructions(&self, core: Core, sum: u64) -> u64 {
        self.mean(sum * core.facts().instructions_per_count)
    }
}

/// A line of the firmware: what was drawn, and its cost.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Line<K> {
    #[serde(flatten)]
    pub(crate) key: K,
    #[serde(flatten)]
    pub(crate) cost: Cost,
}

/// Parses the output of a program. Its first line is the `opt-level`.
pub(crate) fn lines<K: DeserializeOwned>(lines: &[String]) -> Result<Vec<Line<K>>> {
    let parse = |line: &String| {
        let Line { key, cost } = serde_json::from_str(line)
            .with_context(|| format!("the firmware has printed `{line}` instead of figures"))?;
        let Cost { frames, triangles_drawn, .. } = cost;
        ensure!(frames > 0 && triangles_drawn > 0, "the firmware has drawn nothing: {cost:?}");
        Ok(Line { key, cost })
    };
    lines.iter().skip(1).map(parse).collect()
}

#[cfg(test)]
pub(crate) mod tests {
    use serde_json::{Value, json};

    use super::*;

    /// A line of the firmware with these sums over eight frames.
    pub(crate) fn line(key: Value, clear: u64, vertices: u64, draw: u64) -> String {
        let mut line = json!({
            "frames": 8, "clear": clear, "vertices": vertices, "draw": draw,
            "pixels_drawn": 804, "triangles_drawn": 44, "pixels_changed": 1_600,
        });
        for (name, value) in key.as_object().unwrap() {
            line[name] = value.clone();
        }
        line.to_string()
    }

    #[test]
    fn means_are_rounded_to_the_nearest() {
        let line = line(json!({ "scene": "cube" }), 80, 16, 300);
        let lines = lines::<Value>(&["opt-level 3".into(), line]).unwrap();
        let Line { key, cost } = &lines[0];
        assert_eq!(key["scene"], "cube");
        assert_eq!((cost.mean(cost.pixels_drawn), cost.mean(cost.triangles_drawn)), (101, 6));
        assert_eq!(cost.instructions(Core::M33, cost.draw), 1_875);
        assert_eq!(cost.instructions(Core::Riscv, cost.draw), 38);
    }

    #[test]
    fn lines_without_figures_are_quoted() {
        let of = |line: String| lines::<Value>(&["".into(), line]).unwrap_err().to_string();
        assert!(of("panicked at src".into()).contains("`panicked at src`"));
        let line = line(json!({}), 1, 1, 1);
        assert!(of(line.replace(r#""frames":8"#, r#""frames":0"#)).contains("nothing"));
    }
}
