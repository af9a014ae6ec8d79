//! The report as a page of Markdown, and as rows of CSV.

use std::fmt::Write as _;

use super::{
    Report,
    narrow::Narrow,
    points::{Measured, Point},
    split::{Split, Texels},
};
use crate::{
    cores::Core,
    figures::count,
    table::{Column, Table},
};

const INTRODUCTION: &str = "\
What accuracy costs. Each point of a diagram is a program: a choice of sub-pixels, visibility,
light, perspective, filter, colours and samples, compiled as a firmware that makes that choice. The
further down, the closer its pictures are to the true one; the further left, the sooner they are
drawn. Both axes are logarithmic. A method is a curve with its settings along it; the steps are the
choices that no other one beats.

* **Error** is that of the colours that a display of 320 x 240 shows, in steps of 8 bits: the root
  of the mean square over all pixels that show the model, in the picture or in truth, and over all
  frames. The true picture is drawn in f64 from the numbers of the OBJ file: light at each point of
  the surface with its smooth normals, textures in their files' size, the mean of 64 samples over
  each pixel. *inside* leaves out the pixels of the outline; *8x8* is that of the means of squares
  of pixels, where dithering gains what it loses in each pixel; *99.9 %* and *most* are of a pixel's
  worst channel.
* **Shimmer** is what changes otherwise than it should while the scene moves by a 64th of a pixel to
  the right, also in steps of 8 bits: the root of the mean square of the difference between the
  change of the picture and that of an exact one, drawn in f64 with as many samples a pixel. What a
  pixel's samples miss flickers in both, and does not count; what is rounded does.
* **Run time** is that of a frame, in cycles by the core's [timing table][cycles]; bars show the
  range where the table has one. It counts clearing depth, vertices, triangles and pixels, and with
  several samples their means.
* **FLIP**, a column of reports made with the feature `flip`, is what an eye sees of the error: the
  mean over the display of the measure by Andersson et al. (2020), from 0 to 1, for a display of 2.4
  inches 40 cm away.
* **f32** is a rasterizer in floating point, for comparison: what one writes for a core that has an
  FPU. It draws the same tables in the same view by Gouraud shading. *f32* computes a colour for
  each pixel, *f32-levels* takes one of 64 levels, as the library does. With a texture it takes the
  nearest texel, in the library's levels of light: *f32* divides at each pixel that is seen,
  *f32-every-16* every 16 pixels. It is no choice of the library, and not among the steps. A
  Cortex-M0+ has no FPU, and does all of it in software.
* **What cannot be seen** is shaded: rounding to RGB565 alone has the error of its upper edge. The
  lower line is the error of the true picture itself, against one of four times as many samples.
* The picture on a core is that of the host, bit by bit: each run compares their hashes.

[cycles]: RESULTS.md#cycles
";

const OMISSIONS: &str = "\
## What was left out

* Positions and normals of other widths as choices: the core has 16 and 8 bits. What 16 bits cost
  shows in the tables of causes, as the difference between *off file* and *off tables*. Narrower
  tables are drawn by the core as it is, from rounded values: what their decoding takes is not
  counted.
* Light at each pixel over a texture: the core does not have it.
* Highlights, several lights, fog and blending: no two choices draw the same there.
* The painter's algorithm with several samples, and with textures.
* Sending pixels. With several samples the means are handed to a display one by one, as drivers
  take them, which is part of their run time.
* Filters, samples and clipping in floating point. The rasterizer for comparison does not draw
  *floor*, which reaches behind the camera.
* The Cortex-M7 has no timing table; RISC-V and the Cortex-M33 have one: name them with `--core`.
  That of the Cortex-M33 lacks its FPU, so there the cycles of f32 are not known.
";

/// The page, with pictures beside it: `picture` returns the path of a scene's.
pub(super) fn page(report: &Report, advice: &str, picture: impl Fn(&str) -> String) -> String {
    let mut text = format!("# Error against run time\n\n{INTRODUCTION}\n{advice}");
    for measured in &report.scenes {
        let name = &measured.scene.name;
        let _ = write!(
            text,
            "\n## {name}\n\n![Error over run time of {name}]({})\n\n{}",
            picture(name),
            table(measured, &report.cores)
        );
        for &core in &report.cores {
            let _ = write!(
                text,
                "\nThe cheapest on the {} whose error is at most\n\n{}",
                core.title(),
                cheapest(measured, Some(core))
            );
        }
        if report.cores.is_empty() {
            let _ = write!(text, "\nThe quickest here\n\n{}", cheapest(measured, None));
        }
        text += &causes(measured);
    }
    let _ = write!(text, "\n{OMISSIONS}\n## Conditions\n\n");
    for (core, conditions) in &report.conditions {
        let _ = writeln!(text, "* {}: {}, {conditions}.", core.title(), conditions.date);
    }
    for (scene, date) in &report.later {
        let _ = writeln!(text, "* {scene}: {date}, with the same tools.");
    }
    if report.conditions.is_empty() {
        text += "* Times are those of this machine: the median of several runs.\n";
    }
    text
}

/// All points of a scene, the cheapest first.
fn table(measured: &Measured, cores: &[Core]) -> Table {
    let mut headings = vec!["choice", "RMS", "inside", "8x8", "99.9 %", "most", "PSNR", "shimmer"];
    let has_flip = measured.points.iter().any(|point| point.flip.is_some());
    headings.extend(has_flip.then_some("FLIP"));
    headings.extend(cores.iter().map(|core| core.title()));
    if cores.is_empty() {
        headings.extend(["here, \u{b5}s", "least", "most"]);
    }
    let mut table = Table::new(1, &headings);
    let first = cores.first().copied();
    let mut points: Vec<_> = measured.points.iter().collect();
    points.sort_by_key(|point| point.figure(first).unwrap_or(u64::MAX));
    for point in points {
        let Point { choice, errors, nanoseconds, .. } = point;
        let name = choice.name();
        let mut cells =
            vec![if choice.is_default() { format!("**{name}** (default)") } else { name }];
        cells.extend(
            [errors.rms, errors.rms_inside, errors.rms_squares].map(|error| format!("{error:.2}")),
        );
        cells.extend([errors.p999, errors.max].map(|error| format!("{error:.0}")));
        cells.push(format!("{:.1} dB", errors.psnr_db()));
        cells.push(format!("{:.2}", point.shimmer));
        cells.extend(has_flip.then(|| decimals(point.flip, 4)));
        for &core in cores {
            cells.push(point.figure(Some(core)).map_or_else(String::new, count));
        }
        if cores.is_empty() {
            let [least, median, most] = *nanoseconds;
            cells.extend([median, least, most].map(|time| count(time / 1000)));
        }
        table.row(cells);
    }
    table
}

/// A value with some decimals, if it is known.
fn decimals(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(String::new, |value| format!("{value:.decimals$}"))
}

/// The cheapest choice for each bound of the error, by halves.
fn cheapest(measured: &Measured, core: Option<Core>) -> Table {
    let front = measured.front(core);
    let columns: [Column<(f64, &Point, u64)>; 4] = [
        ("error", |(bound, ..)| format!("{bound}")),
        ("choice", |(_, point, _)| point.choice.name()),
        ("RMS", |(_, point, _)| format!("{:.2}", point.errors.rms)),
        ("run time", |(_, _, figure)| count(*figure)),
    ];
    let mut last = None;
    let rows = (-1..7).map(|exponent| 2f64.powi(exponent)).filter_map(|bound| {
        let point = *front.iter().find(|point| point.errors.rms <= bound)?;
        // The closest bound that a choice keeps says the most.
        let is_new = last.replace(point.choice) != Some(point.choice);
        is_new.then_some((bound, point, point.figure(core).unwrap_or(0)))
    });
    let mut rows: Vec<_> = rows.collect();
    rows.reverse();
    Table::of(2, &columns, rows)
}

/// The tables of causes.
fn causes(measured: &Measured) -> String {
    let columns: [Column<&Split>; 8] = [
        ("bits", |split| format!("S{}", split.subpixel)),
        ("depth", |split| split.depth.clone()),
        ("vertices off file, px", |split| format!("{:.4}", split.geometry.off_file_px)),
        ("off tables, px", |split| format!("{:.4}", split.geometry.off_tables_px)),
        ("pixels off file", |split| count(split.geometry.coverage_off_file as u64)),
        ("off snapped", |split| count(split.geometry.coverage_off_snapped as u64)),
        ("depth off file, RMS", |split| format!("{:.2}", split.geometry.depth_off_file)),
        ("off snapped, most", |split| format!("{:.2}", split.geometry.depth_off_snapped)),
    ];
    let mut text = format!(
        "\nCauses, the worst of all frames: *off file* is against the OBJ file's numbers, *off \
         tables* against those of the tables, *off snapped* against the vertices as they are \
         rounded to sub-pixels. Depth is in units of its format.\n\n{}",
        Table::of(2, &columns, &measured.splits)
    );
    if measured.scene.is_textured {
        let columns: [Column<&Texels>; 2] = [
            ("correction", |texels| texels.correction.name()),
            ("most, texels", |texels| format!("{:.4}", texels.most)),
        ];
        text += "\nTexture coordinates against exact perspective on the same vertices:\n\n";
        text += &Table::of(1, &columns, &measured.texels).to_string();
    }
    if !measured.narrow.is_empty() {
        let columns: [Column<&Narrow>; 5] = [
            ("tables", |narrow| narrow.format.name().into()),
            ("save, bytes", |narrow| count(narrow.saved as u64)),
            ("RMS", |narrow| format!("{:.2}", narrow.rms)),
            ("inside", |narrow| format!("{:.2}", narrow.rms_inside)),
            ("most", |narrow| format!("{:.0}", narrow.max)),
        ];
        text += "\nNarrower tables, which the library does not have, drawn by the default choice \
                 in colours of 8 bits:\n\n";
        text += &Table::of(1, &columns, &measured.narrow).to_string();
    }
    text
}

/// All points as rows of CSV: scene, choice, errors, and for each core instructions and cycles.
pub(super) fn csv(report: &Report) -> String {
    let mut text =
        String::from("scene,choice,rms,rms_inside,rms_squares,p999,max,shimmer,flip,host_ns");
    for core in &report.cores {
        let name = core.facts().name;
        let _ = write!(text, ",{name}_instructions,{name}_cycles");
    }
    text.push('\n');
    for measured in &report.scenes {
        for point in &measured.points {
            let errors = point.errors;
            let _ = write!(
                text,
                "{},{},{:.4},{:.4},{:.4},{:.2},{:.2},{:.4},{},{}",
                measured.scene.name,
                point.choice.name(),
                errors.rms,
                errors.rms_inside,
                errors.rms_squares,
                errors.p999,
                errors.max,
                point.shimmer,
                decimals(point.flip, 5),
                point.nanoseconds[1]
            );
            for &core in &report.cores {
                let cost = point.cost(core);
                let of = |value: Option<u64>| value.map_or_else(String::new, |v| v.to_string());
                let instructions = of(cost.map(|cost| cost.instructions));
                let cycles = of(cost.and_then(|cost| cost.cycles).map(|[_, cycles, _]| cycles));
                let _ = write!(text, ",{instructions},{cycles}");
            }
            text.push('\n');
        }
    }
    text
}
