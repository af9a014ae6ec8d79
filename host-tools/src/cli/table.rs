//! The comparison as a table and in words.

use host_tools::{
    check::{
        AlphaError, BlendError, Bounds, Comparison, Deviation, Fault, LineOutcome, Outcome,
        TexelError, VertexError, Wrong,
    },
    model::{Model, thousands},
};

use super::image::Legend;

/// Both comparisons side by side, with the bounds and whether they are kept.
pub(super) fn comparisons(outcome: &Outcome, bounds: &Bounds) -> String {
    type Figure = fn(&Comparison) -> String;
    let Outcome { arithmetic, end_to_end, places, display } = outcome;
    let found = &arithmetic.deviation;
    let coverage = bound(found.coverage_mismatches as f64, bounds.coverage_mismatches as f64);
    let depth = bound(found.depth_max_ulp, bounds.depth_max_ulp);
    let color = bound(found.color_max_error, bounds.color_max_error);
    let [vertices, exact_vertices] = [arithmetic, end_to_end].map(|comparison| {
        let verdict = if comparison.vertices.are_within() { "ok" } else { "FAIL" };
        let worst = comparison.vertices.vertex_worst;
        worst.map_or_else(String::new, |worst| format!("{:.4} {verdict}", worst.bound_px))
    });
    let psnr = |c: &Comparison| {
        c.deviation.psnr_db.map_or_else(|| "equal".into(), |db| format!("{db:.1}"))
    };
    let rows: [(&str, Figure, &str, &str); 9] = [
        ("Pixels covered", |c| thousands(c.deviation.pixels), "", ""),
        (
            "Coverage mismatches, pixels",
            |c| thousands(c.deviation.coverage_mismatches),
            &coverage,
            "",
        ),
        ("Depth error at most, units", |c| c.deviation.depth_max_ulp.to_string(), &depth, ""),
        ("Depth error, root mean square", |c| format!("{:.3}", c.deviation.depth_rms_ulp), "", ""),
        ("Colour error at most, of 255", |c| c.deviation.color_max_error.to_string(), &color, ""),
        ("PSNR, dB", psnr, "", ""),
        (
            "Vertices off by at most, pixels",
            |c| format!("{:.4}", c.vertices.vertex_error_max_px),
            &vertices,
            &exact_vertices,
        ),
        ("Fixed-point core, ms", |c| format!("{:.2}", c.fixed_ms), "", ""),
        ("Reference, ms", |c| format!("{:.2}", c.reference_ms), "", ""),
    ];
    let line = |title: &str, [arithmetic, bound, end_to_end, exact_bound]: [&str; 4]| {
        let line =
            format!("{title:<32}{arithmetic:>12}  {bound:<12}{end_to_end:>12}  {exact_bound}");
        line.trim_end().to_owned() + "\n"
    };
    let mut text = line("", ["Arithmetic", "Bound", "End to end", "Bound"]);
    for (title, figure, bound, exact_bound) in rows {
        text += &line(title, [&figure(arithmetic), bound, &figure(end_to_end), exact_bound]);
    }
    if let Some(texels) = arithmetic.texels {
        let bound =
            texels.texel_worst.map_or_else(String::new, |TexelError { bound_texels, .. }| {
                let verdict = if texels.are_within() { "ok" } else { "FAIL" };
                format!("{bound_texels:.4} {verdict}")
            });
        let most = format!("{:.4}", texels.texel_max_error);
        text += &line("Texel error at most, texels", [&most, &bound, "", ""]);
    }
    if let Some(normals) = arithmetic.normals {
        let verdict = if normals.are_within() { "ok" } else { "FAIL" };
        let bound = format!("{} {verdict}", normals.normal_bound_degrees);
        let most = format!("{:.4}", normals.normal_max_error_degrees);
        text += &line("Normal error at most, degrees", [&most, &bound, "", ""]);
    }
    if let Some(blend) = arithmetic.blend {
        let layers = thousands(blend.blend_most_layers);
        text += &line("Layers of a pixel at most", [&layers, "", "", ""]);
        let mismatches = thousands(blend.blend_layer_mismatches);
        let verdict = bound(blend.blend_layer_mismatches as f64, 0.0);
        text += &line("Layer mismatches, pixels", [&mismatches, &verdict, "", ""]);
        let most = blend.blend_layer_max_error;
        let verdict = bound(most, bounds.color_max_error);
        text += &line("Layer colour error, of 255", [&most.to_string(), &verdict, "", ""]);
        let verdict = blend.blend_alpha_worst.map_or_else(
            || bound(blend.blend_alpha_max_error, 0.0),
            |worst| {
                let verdict = if worst.is_within() { "ok" } else { "FAIL" };
                format!("{:.4} {verdict}", worst.bound_units)
            },
        );
        let most = format!("{:.4}", blend.blend_alpha_max_error);
        text += &line("Layer alpha error, of 256", [&most, &verdict, "", ""]);
        let verdict = blend.blend_worst.map_or_else(String::new, |worst| {
            let verdict = if worst.is_within() { "ok" } else { "FAIL" };
            format!("{:.4} {verdict}", worst.bound_steps)
        });
        let most = format!("{:.4}", blend.blend_max_error);
        text += &line("Blended colour error, of 255", [&most, &verdict, "", ""]);
    }
    let judged = thousands(places.judged);
    text += &line("Pixels judged by their place", ["", "", &judged, ""]);
    let wrong = bound(places.wrong as f64, 0.0);
    text += &line("Wrong pixels among these", ["", "", &thousands(places.wrong), &wrong]);
    if let Some(display) = display {
        let steps = bound(display.wrong_steps as f64, 0.0);
        let colors = bound(display.wrong_colors as f64, 0.0);
        let wrong = [display.wrong_steps, display.wrong_colors].map(thousands);
        text += &line("Wrong steps of the display", [&wrong[0], &steps, "", ""]);
        text += &line("Wrong colours of the display", [&wrong[1], &colors, "", ""]);
        if let Some(most) = display.block_bound.filter(|_| display.even_blocks > 0) {
            let error = format!("{:.5}", display.block_max_error);
            let bound = bound(display.block_max_error, most);
            text += &line("Mean of even 8x8 squares, of 1", [&error, &bound, "", ""]);
        }
    }
    text
}

/// What was found of lines and points, with the bounds and whether they are kept.
pub(super) fn of_lines(lines: &LineOutcome) -> String {
    let mut text = String::new();
    let mut line = |title: &str, found: String, bound: String| {
        text += format!("{title:<34}{found:>12}  {bound}").trim_end();
        text += "\n";
    };
    line("Lines seen, or parts of them", thousands(lines.lines), String::new());
    line("Points seen", thousands(lines.points), String::new());
    line("Pixels that they own", thousands(lines.line_pixels), String::new());
    line("Pixels of these that are hidden", thousands(lines.line_pixels_hidden), String::new());
    for (title, found) in [
        ("Lines and points that are missing", lines.lines_missing),
        ("Lines and points too many", lines.lines_extra),
        ("Coverage mismatches, pixels", lines.line_coverage_mismatches),
    ] {
        line(title, thousands(found), bound(found as f64, 0.0));
    }
    let depth = lines.line_depth_max_ulp;
    let verdict = bound(depth, LineOutcome::DEPTH_MAX_ULP);
    line("Depth error at most, of 2^32", format!("{depth:.3}"), verdict);
    let color = lines.line_color_max_error;
    let verdict = bound(color, LineOutcome::COLOR_MAX_ERROR);
    line("Colour error at most, of 255", color.to_string(), verdict);
    line("Ends judged", thousands(lines.line_ends), String::new());
    line("Ends where planes cut lines", thousands(lines.line_ends_cut), String::new());
    for (title, worst, digits) in [
        ("Place of an end, pixels", lines.line_end_place, 5),
        ("Depth of an end, of 2^32", lines.line_end_depth, 1),
        ("Colour of an end, of 255", lines.line_end_color, 5),
    ] {
        let Some(worst) = worst else { continue };
        let verdict = if worst.is_within() { "ok" } else { "FAIL" };
        let verdict = format!("{:.digits$} {verdict}", worst.bound);
        line(title, format!("{:.digits$}", worst.error), verdict);
        if !worst.is_within() {
            line("  of the vertices", format!("{:?}", worst.vertices), String::new());
        }
    }
    if let Some([x, y]) = lines.line_first_wrong {
        text += &format!("The first wrong pixel of lines: column {x} of row {y}.\n");
    }
    text
}

/// A bound, and whether it is kept.
fn bound(found: f64, bound: f64) -> String {
    format!("{bound} {}", if found <= bound { "ok" } else { "FAIL" })
}

/// The comparisons in words.
pub(super) fn meaning(model: &Model, outcome: &Outcome, bounds: &Bounds) -> String {
    let Outcome { arithmetic, end_to_end, places, display } = outcome;
    let mut text = if arithmetic.is_within(bounds) {
        "Arithmetic: within bounds. The core draws its own vertices as exact arithmetic does."
            .to_owned()
    } else {
        "Arithmetic: OUT OF BOUNDS. The core computes wrong values. Please report this with the \
         model."
            .to_owned()
    };
    let vertex = |error: VertexError, rounded: &str| {
        let [x, y, z] = model.exact.positions[error.vertex];
        format!(
            "\n  Vertex {} at ({x:.6}, {y:.6}, {z:.6}) lies {:.4} pixels off its place{rounded}, and \
             may lie {:.4}.",
            error.vertex, error.error_px, error.bound_px
        )
    };
    if let Some(worst) = arithmetic.vertices.out_of_bounds() {
        text += &vertex(worst, "");
    }
    if let Some(texels) = arithmetic.texels {
        if let Some(TexelError { pixel: [x, y], triangle, error_texels, bound_texels }) =
            texels.out_of_bounds()
        {
            text += &format!(
                "\n  Column {x} of row {y}, triangle {triangle} of the tables: its texture coordinate \
                 is {error_texels:.4} texels off, and may be {bound_texels:.4}."
            );
        }
        text += &format!("\n  The bound of a texture coordinate: {}.", texels.texel_bound);
    }
    if let Some(normals) = arithmetic.normals {
        if !normals.are_within() {
            let degrees = normals.normal_max_error_degrees;
            text += &match normals.normal_worst {
                Some([x, y]) => {
                    format!("\n  Column {x} of row {y}: its normal is {degrees:.3} degrees off.")
                }
                None => format!("\n  A normal of the tables is {degrees:.3} degrees off."),
            };
        }
        text += &format!(
            "\n  The bound of a normal: {} degrees, where it is at least half as long as those of \
             the corners. The colour is judged by the core's own normal.",
            normals.normal_bound_degrees
        );
    }
    if let Some(blend) = arithmetic.blend {
        if let Some(BlendError { pixel: [x, y], layers, error_steps, bound_steps }) =
            blend.blend_worst.filter(|worst| !worst.is_within())
        {
            text += &format!(
                "\n  Column {x} of row {y}: the blended colour of {layers} layers is \
                 {error_steps:.4} steps off, and may be {bound_steps:.4}."
            );
        }
        if let Some(AlphaError { pixel: [x, y], triangle, error_units, bound_units }) =
            blend.blend_alpha_worst.filter(|worst| !worst.is_within())
        {
            text += &format!(
                "\n  Column {x} of row {y}: the alpha of triangle {triangle} of the tables is \
                 {error_units:.4} of 256 off, and may be {bound_units:.4}."
            );
        }
        if blend.blend_alpha_worst.is_some() {
            let reason: &str = blend.blend_alpha_bound.into();
            text += &format!("\n  The bound of an alpha: {reason}.");
        }
        let reason: &str = blend.blend_bound.into();
        text += &format!("\n  The bound of a blended colour: {reason}.");
    }
    let Deviation { pixels, coverage_mismatches, .. } = end_to_end.deviation;
    let share = 100.0 * coverage_mismatches as f64 / pixels.max(1) as f64;
    text += &format!(
        "\nEnd to end: against the faces of the file, {} of {} pixels ({share:.2} %) fall on the \
         other side of an outline.\n",
        thousands(coverage_mismatches),
        thousands(pixels)
    );
    text += if places.wrong == 0 && end_to_end.vertices.are_within() {
        "Rounding explains them all: no pixel is wrong beyond it, and no vertex.\n"
    } else {
        "OUT OF BOUNDS: rounding doesn't explain this. Please report it with the model.\n"
    };
    if let Some(worst) = end_to_end.vertices.out_of_bounds() {
        text += vertex(worst, " in the file").trim_start_matches('\n');
        text += "\n";
    }
    if let Some([x, y]) = display.and_then(|display| display.first) {
        text += &format!(
            "The display: OUT OF BOUNDS. The first pixel with a wrong step is column {x} of row {y}. \
             Please report it with the model.\n"
        );
    }
    if let Some(first) = places.first {
        text += &format!("  {} wrong pixels. {}\n", thousands(places.wrong), place(model, first));
    }
    text + "A large colour or depth error there is most often a pixel at an inner edge that shows the \
            face next to it."
}

/// A wrong pixel in words.
fn place(model: &Model, Wrong { pixel: [x, y], fault, line, triangle }: Wrong) -> String {
    let file = model.inputs.first().map_or_else(String::new, |path| path.display().to_string());
    let face = line.map_or_else(|| "no face".into(), |line| format!("the face at {file}:{line}"));
    let drawn = triangle.map_or_else(String::new, |triangle| {
        format!("; the core draws triangle {triangle} of the tables")
    });
    let what = match fault {
        Fault::Hole => format!("is not covered, but {face} covers it"),
        Fault::Extra => format!("is covered, but no face of {file} covers it{drawn}"),
        Fault::Surface => format!("should show {face}, by its depth{drawn}"),
        Fault::Color => format!("should show the colour of {face}{drawn}"),
    };
    format!("The first, column {x} of row {y}, {what}.")
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
    use host_tools::{
        check::{Places, Texels, Vertices},
        model::Options,
    };

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
        let vertices = |error_px| Vertices {
            vertex_error_max_px: error_px,
            vertex_worst: Some(VertexError { vertex: 2, error_px, bound_px: 0.0024 }),
        };
        let comparison = Comparison {
            deviation,
            vertices: vertices(0.001),
            texels: None,
            normals: None,
            blend: None,
            fixed_ms: 1.0,
            reference_ms: 2.0,
        };
        Outcome {
            arithmetic: comparison,
            end_to_end: Comparison {
                deviation: Deviation { coverage_mismatches: 123, ..deviation },
                ..comparison
            },
            places: Places { judged: 54_321, wrong: 0, first: None },
            display: None,
        }
    }

    fn gear() -> Model {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/models/gear.obj");
        Model::load(path, &Options::default()).unwrap()
    }

    #[test]
    fn an_exceeded_bound_stands_out() {
        let bounds = Bounds::ARITHMETIC;
        let (good, bad) =
            (comparisons(&outcome(1.0), &bounds), comparisons(&outcome(2.0), &bounds));
        let count =
            |text: &str, word| text.split_whitespace().filter(|found| *found == word).count();
        assert_eq!((count(&good, "ok"), count(&good, "FAIL")), (6, 0), "{good}");
        assert_eq!((count(&bad, "ok"), count(&bad, "FAIL")), (5, 1), "{bad}");
        assert!(
            bad.lines()
                .any(|line| line.starts_with("Depth error at most") && line.contains("1 FAIL"))
        );
        assert!(good.contains("12,345") && good.contains("equal"), "{good}");
        assert!(good.contains("54,321") && good.contains("0.0024 ok"), "{good}");
        let model = gear();
        let good = meaning(&model, &outcome(1.0), &bounds);
        assert!(good.contains("123 of 12,345 pixels (1.00 %)"), "{good}");
        assert!(!good.contains("OUT OF BOUNDS") && good.contains("Rounding explains"), "{good}");
        assert!(meaning(&model, &outcome(2.0), &bounds).contains("OUT OF BOUNDS"));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let (model, bounds) = (gear(), Bounds::ARITHMETIC);
        let mut bad = outcome(1.0);
        bad.end_to_end.vertices.vertex_worst =
            Some(VertexError { vertex: 2, error_px: 0.5, bound_px: 0.25 });
        let text = meaning(&model, &bad, &bounds);
        assert!(text.contains("Vertex 2 at (") && text.contains("0.5000 pixels off"), "{text}");
        assert!(text.contains("may lie 0.2500"), "{text}");
        assert!(comparisons(&bad, &bounds).contains("0.2500 FAIL"));

        for (fault, line, triangle, parts) in [
            (Fault::Hole, Some(9), None, ["is not covered", "gear.obj:9"]),
            (Fault::Extra, None, Some(5), ["no face", "triangle 5 of the tables"]),
            (Fault::Surface, Some(9), Some(5), ["by its depth", "gear.obj:9"]),
            (Fault::Color, Some(9), Some(5), ["the colour of", "gear.obj:9"]),
        ] {
            let first = Some(Wrong { pixel: [7, 3], fault, line, triangle });
            let bad = Outcome { places: Places { judged: 8, wrong: 4, first }, ..outcome(1.0) };
            let text = meaning(&model, &bad, &bounds);
            assert!(text.contains("OUT OF BOUNDS"), "{text}");
            assert!(text.contains("4 wrong pixels. The first, column 7 of row 3,"), "{text}");
            assert!(parts.iter().all(|part| text.contains(part)), "{text}");
            assert!(comparisons(&bad, &bounds).contains("0 FAIL"));
        }
    }

    #[test]
    fn texel_errors_have_a_row_a_bound_and_a_place() {
        let (model, bounds) = (gear(), Bounds::ARITHMETIC);
        let text = comparisons(&outcome(1.0), &bounds);
        assert!(!text.contains("Texel"), "{text}");
        for (error_texels, verdict) in [(0.03, "ok"), (0.25, "FAIL")] {
            let worst =
                TexelError { pixel: [7, 3], triangle: 5, error_texels, bound_texels: 0.0625 };
            let mut outcome = outcome(1.0);
            outcome.arithmetic.texels = Some(Texels {
                texel_max_error: error_texels,
                texel_worst: Some(worst),
                texel_bound: "1/16 texel",
            });
            assert_eq!(outcome.is_within(&bounds), verdict == "ok");
            let text = comparisons(&outcome, &bounds);
            let row = text.lines().find(|line| line.starts_with("Texel error at most")).unwrap();
            assert!(row.contains(&format!("{error_texels:.4}")), "{row}");
            assert!(row.contains(&format!("0.0625 {verdict}")), "{row}");
            let text = meaning(&model, &outcome, &bounds);
            assert!(text.contains("coordinate: 1/16 texel."), "{text}");
            let names_place = text.contains("Column 7 of row 3, triangle 5 of the tables");
            assert_eq!(names_place, verdict == "FAIL", "{text}");
        }
    }
}
