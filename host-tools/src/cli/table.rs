//! The comparison as a table, and what it means in words.

use std::fmt::Write as _;

use host_tools::{
    check::{Bounds, Comparison, Outcome},
    model::thousands,
};

use super::image::Legend;

/// One line of the table.
struct Row {
    title: &'static str,
    figure: fn(&Comparison) -> String,
    /// For the arithmetic: the bound, and whether it is kept.
    bound: Option<(f64, bool)>,
}

/// Both comparisons side by side, with the bounds and whether they are kept.
pub(super) fn comparisons(outcome: &Outcome, bounds: &Bounds) -> String {
    let Outcome { arithmetic, end_to_end } = outcome;
    let free = |title, figure| Row { title, figure, bound: None };
    let bounded = |title, figure: fn(&Comparison) -> String, found: f64, bound: f64| Row {
        title,
        figure,
        bound: Some((bound, found <= bound)),
    };
    let rows = [
        free("Pixels covered", |c| thousands(c.pixels)),
        bounded(
            "Coverage mismatches, pixels",
            |c| thousands(c.coverage_mismatches),
            arithmetic.coverage_mismatches as f64,
            bounds.coverage_mismatches as f64,
        ),
        bounded(
            "Depth error at most, units",
            |c| c.depth_max_ulp.to_string(),
            arithmetic.depth_max_ulp,
            bounds.depth_max_ulp,
        ),
        free("Depth error, root mean square", |c| format!("{:.3}", c.depth_rms_ulp)),
        bounded(
            "Colour error at most, of 255",
            |c| c.color_max_error.to_string(),
            arithmetic.color_max_error,
            bounds.color_max_error,
        ),
        free("PSNR, dB", |c| c.psnr_db.map_or_else(|| "equal".into(), |db| format!("{db:.1}"))),
        free("Vertices off by at most, pixels", |c| format!("{:.4}", c.vertex_error_max_px)),
        free("Fixed-point core, ms", |c| format!("{:.2}", c.fixed_ms)),
        free("Reference, ms", |c| format!("{:.2}", c.reference_ms)),
    ];
    let mut text = format!("{:<32}{:>12}  {:<8}{:>12}\n", "", "Arithmetic", "Bound", "End to end");
    for Row { title, figure, bound } in rows {
        let mark = |(bound, is_kept)| format!("{bound} {}", if is_kept { "ok" } else { "FAIL" });
        let bound = bound.map_or_else(String::new, mark);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{title:<32}{:>12}  {bound:<8}{:>12}",
            figure(arithmetic),
            figure(end_to_end)
        );
    }
    text
}

/// What the table says, in words.
pub(super) fn meaning(outcome: &Outcome, bounds: &Bounds) -> String {
    let verdict = if outcome.is_within(bounds) {
        "Arithmetic: within bounds, the core draws its own vertices as exact arithmetic would."
    } else {
        "Arithmetic: OUT OF BOUNDS, the core does not compute what it should. Please report this with the model."
    };
    let Comparison { pixels, coverage_mismatches, .. } = outcome.end_to_end;
    let share = 100.0 * coverage_mismatches as f64 / pixels.max(1) as f64;
    format!(
        "{verdict}\n\
         End to end: against the unrounded model, {} of {} pixels ({share:.2} %) fall on the other side of its outline.\n\
         A large colour or depth error there is most often a pixel at an inner edge that shows the face next to it.",
        thousands(coverage_mismatches),
        thousands(pixels)
    )
}

/// The colours of the difference picture that occur.
pub(super) fn legend(legend: &Legend) -> String {
    let mut text = String::new();
    for (color, meaning, pixels) in legend.lines() {
        if pixels > 0 {
            let _ = writeln!(text, "  {color:<9}{meaning}, in {} of the pixels", thousands(pixels));
        }
    }
    if text.is_empty() {
        text = "  grey     no difference\n".into();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(depth_max_ulp: f64) -> Outcome {
        let comparison = Comparison {
            pixels: 12_345,
            coverage_mismatches: 0,
            depth_max_ulp,
            depth_rms_ulp: 0.25,
            color_max_error: 1.0,
            psnr_db: None,
            vertex_error_max_px: 0.001,
            fixed_ms: 1.0,
            reference_ms: 2.0,
        };
        Outcome {
            arithmetic: comparison,
            end_to_end: Comparison { coverage_mismatches: 123, ..comparison },
        }
    }

    #[test]
    fn an_exceeded_bound_stands_out() {
        let bounds = Bounds::ARITHMETIC;
        let (good, bad) =
            (comparisons(&outcome(1.0), &bounds), comparisons(&outcome(2.0), &bounds));
        assert_eq!((good.matches(" ok ").count(), good.matches("FAIL").count()), (3, 0), "{good}");
        assert_eq!((bad.matches(" ok ").count(), bad.matches("FAIL").count()), (2, 1), "{bad}");
        assert!(
            bad.lines()
                .any(|line| line.starts_with("Depth error at most") && line.contains("1 FAIL"))
        );
        assert!(good.contains("12,345") && good.contains("equal"), "{good}");
        assert!(meaning(&outcome(1.0), &bounds).contains("123 of 12,345 pixels (1.00 %)"));
        assert!(meaning(&outcome(2.0), &bounds).contains("OUT OF BOUNDS"));
    }
}
