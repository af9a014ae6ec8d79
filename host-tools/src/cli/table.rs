//! The comparison as a table and in words.

use host_tools::{
    check::{Bounds, Comparison, Deviation, Outcome},
    model::thousands,
};

use super::image::Legend;

/// Both comparisons side by side, with the bounds and whether they are kept.
pub(super) fn comparisons(outcome: &Outcome, bounds: &Bounds) -> String {
    type Figure = fn(&Comparison) -> String;
    let found = &outcome.arithmetic.deviation;
    let bound =
        |found: f64, bound: f64| format!("{bound} {}", if found <= bound { "ok" } else { "FAIL" });
    let coverage = bound(found.coverage_mismatches as f64, bounds.coverage_mismatches as f64);
    let depth = bound(found.depth_max_ulp, bounds.depth_max_ulp);
    let color = bound(found.color_max_error, bounds.color_max_error);
    let psnr = |c: &Comparison| {
        c.deviation.psnr_db.map_or_else(|| "equal".into(), |db| format!("{db:.1}"))
    };
    let rows: [(&str, Figure, &str); 9] = [
        ("Pixels covered", |c| thousands(c.deviation.pixels), ""),
        ("Coverage mismatches, pixels", |c| thousands(c.deviation.coverage_mismatches), &coverage),
        ("Depth error at most, units", |c| c.deviation.depth_max_ulp.to_string(), &depth),
        ("Depth error, root mean square", |c| format!("{:.3}", c.deviation.depth_rms_ulp), ""),
        ("Colour error at most, of 255", |c| c.deviation.color_max_error.to_string(), &color),
        ("PSNR, dB", psnr, ""),
        ("Vertices off by at most, pixels", |c| format!("{:.4}", c.vertex_error_max_px), ""),
        ("Fixed-point core, ms", |c| format!("{:.2}", c.fixed_ms), ""),
        ("Reference, ms", |c| format!("{:.2}", c.reference_ms), ""),
    ];
    let line = |title: &str, arithmetic: &str, bound: &str, end_to_end: &str| {
        format!("{title:<32}{arithmetic:>12}  {bound:<8}{end_to_end:>12}\n")
    };
    let mut text = line("", "Arithmetic", "Bound", "End to end");
    for (title, figure, bound) in rows {
        text += &line(title, &figure(&outcome.arithmetic), bound, &figure(&outcome.end_to_end));
    }
    text
}

/// The comparisons in words.
pub(super) fn meaning(outcome: &Outcome, bounds: &Bounds) -> String {
    let verdict = if outcome.is_within(bounds) {
        "Arithmetic: within bounds. The core draws its own vertices as exact arithmetic does."
    } else {
        "Arithmetic: OUT OF BOUNDS. The core computes wrong values. Please report this with the \
         model."
    };
    let Deviation { pixels, coverage_mismatches, .. } = outcome.end_to_end.deviation;
    let share = 100.0 * coverage_mismatches as f64 / pixels.max(1) as f64;
    format!(
        "{verdict}\n\
         End to end: against the unrounded model, {} of {} pixels ({share:.2} %) fall on the \
         other side of its outline.\n\
         A large colour or depth error there is most often a pixel at an inner edge that shows \
         the face next to it.",
        thousands(coverage_mismatches),
        thousands(pixels)
    )
}

/// The colours of the difference picture that occur.
pub(super) fn legend(legend: &Legend) -> String {
    let mut text = String::new();
    for (color, meaning, pixels) in legend.lines() {
        if pixels > 0 {
            text += &format!("  {color:<9}{meaning}: {} pixels\n", thousands(pixels));
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
        let deviation = Deviation {
            pixels: 12_345,
            coverage_mismatches: 0,
            depth_max_ulp,
            depth_rms_ulp: 0.25,
            color_max_error: 1.0,
            psnr_db: None,
        };
        let comparison =
            Comparison { deviation, vertex_error_max_px: 0.001, fixed_ms: 1.0, reference_ms: 2.0 };
        Outcome {
            arithmetic: comparison,
            end_to_end: Comparison {
                deviation: Deviation { coverage_mismatches: 123, ..deviation },
                ..comparison
            },
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
