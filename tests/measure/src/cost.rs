//! What the firmware counts while it draws a scene.

use anyhow::{Context as _, Result, ensure};
use serde::{Deserialize, de::DeserializeOwned};

use crate::{counts::Stages, plugin::Output};

#[path = "../../firmware/src/cost_fields.rs"]
#[macro_use]
mod fields;

macro_rules! declare {
    ($($(#[$doc:meta])* $field:ident,)*) => {
        /// Sums over the frames. What the core's counter has measured is true on a board only.
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
        mean(sum, self.frames)
    }
}

/// The mean of a sum over a number of frames, rounded to the nearest.
pub(crate) const fn mean(sum: u64, frames: u64) -> u64 {
    (sum + frames / 2) / frames
}

/// A line of the firmware: what was drawn, and its cost.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub(crate) struct Line<K> {
    #[serde(flatten)]
    pub(crate) key: K,
    #[serde(flatten)]
    pub(crate) cost: Cost,
    /// What the plugin has counted meanwhile.
    #[serde(skip)]
    pub(crate) stages: Stages,
}

/// Parses a line of the firmware.
pub(crate) fn line<K: DeserializeOwned>(line: &str) -> Result<Line<K>> {
    let parsed: Line<K> = serde_json::from_str(line)
        .with_context(|| format!("the firmware has printed `{line}` instead of figures"))?;
    let cost = &parsed.cost;
    // Whole programs count no triangles; triangles on a scaling curve may miss every pixel centre.
    let is_drawn = cost.frames > 0 && (cost.pixels_drawn > 0 || cost.triangles_drawn > 0);
    ensure!(is_drawn, "the firmware has drawn nothing: {cost:?}");
    Ok(parsed)
}

/// Parses the output of a program. Its first line is the `opt-level`; each of the others has a
/// report of the plugin.
pub(crate) fn lines<K: DeserializeOwned>(output: &Output) -> Result<Vec<Line<K>>> {
    let lines = output.lines.get(1..).unwrap_or_default();
    let parse = |(text, &stages): (&String, &Stages)| {
        ensure!(stages.draw.instructions > 0, "the plugin has seen nothing drawn: {text}");
        Ok(Line { stages, ..line(text)? })
    };
    let reports = &output.reports;
    let parsed = lines.iter().zip(reports).map(parse).collect::<Result<_>>()?;
    let (lines, reports) = (lines.len(), reports.len());
    ensure!(lines == reports, "the firmware has printed {lines} lines for {reports} reports");
    Ok(parsed)
}

#[cfg(test)]
pub(crate) mod tests {
    use serde_json::{Value, json};

    use super::*;
    use crate::counts::Counts;

    /// The output of a program that draws eight frames, in which the plugin has counted these
    /// instructions.
    pub(crate) fn output(key: Value, clear: u64, vertices: u64, draw: u64) -> Output {
        let mut line = json!({
            "frames": 8, "clear": 1, "vertices": 2, "draw": 3,
            "pixels_drawn": 804, "triangles_drawn": 44, "pixels_changed": 1_600,
        });
        for (name, value) in key.as_object().unwrap() {
            line[name] = value.clone();
        }
        let [clear, vertices, draw] = [clear, vertices, draw]
            .map(|instructions| Counts { instructions, ..Counts::default() });
        Output {
            lines: vec!["opt-level 3".into(), line.to_string()],
            reports: vec![Stages { clear, vertices, draw }],
        }
    }

    #[test]
    fn means_are_rounded_to_the_nearest() {
        let lines = lines::<Value>(&output(json!({ "scene": "cube" }), 80, 16, 300)).unwrap();
        let Line { key, cost, stages } = &lines[0];
        assert_eq!(key["scene"], "cube");
        assert_eq!((cost.mean(cost.pixels_drawn), cost.mean(cost.triangles_drawn)), (101, 6));
        assert_eq!(cost.mean(stages.draw.instructions), 38);
    }

    /// The line with zeros for these counts.
    fn undrawn(line: &str, counts: &[&str]) -> String {
        let mut line: Value = serde_json::from_str(line).unwrap();
        for &name in counts {
            line[name] = 0.into();
        }
        line.to_string()
    }

    #[test]
    fn a_program_may_count_pixels_or_triangles_alone() {
        for counted in ["pixels_drawn", "triangles_drawn"] {
            let mut output = output(json!({}), 1, 1, 1);
            output.lines[1] = undrawn(&output.lines[1], &[counted]);
            assert_eq!(lines::<Value>(&output).unwrap().len(), 1);
        }
    }

    #[test]
    fn lines_without_figures_or_counts_are_faults() {
        let fault = |change: fn(&mut Output)| {
            let mut output = output(json!({}), 1, 1, 1);
            change(&mut output);
            lines::<Value>(&output).unwrap_err().to_string()
        };
        let panicked = fault(|output| output.lines[1] = "panicked at src".into());
        assert!(panicked.contains("`panicked at src`"));
        let no_frames = fault(|output| {
            output.lines[1] = output.lines[1].replace(r#""frames":8"#, r#""frames":0"#);
        });
        assert!(no_frames.contains("drawn nothing"));
        let empty_frames = fault(|output| {
            output.lines[1] = undrawn(&output.lines[1], &["pixels_drawn", "triangles_drawn"]);
        });
        assert!(empty_frames.contains("drawn nothing"));
        assert!(fault(|output| output.reports[0] = Stages::default()).contains("seen nothing"));
        assert!(fault(|output| output.reports.clear()).contains("1 lines for 0 reports"));
        assert!(fault(|output| output.lines.truncate(1)).contains("0 lines for 1 reports"));
    }
}
