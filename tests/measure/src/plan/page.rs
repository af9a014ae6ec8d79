//! The page of plans.

use std::fmt::Write as _;

use host_tools::model::thousands;
use serde::{Deserialize, Serialize};

use super::compare::{Compared, Figures, MOST_BYTES, MOST_CYCLES, MOST_DIFFERENT};

/// What is saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Saved {
    pub(super) compiler: String,
    pub(super) plans: Vec<Compared>,
}

const HEAD: &str = "\
# Plans

`host-tools plan MODEL.obj` looks at a model in the views that it will be seen from, and writes a
renderer with just what it needs. This page compares what it predicts with what is measured: the Rust
file is compiled into a program of a microcontroller, which QEMU runs. Written by `measure plan
--save`; do not edit.

";

/// The page.
pub(super) fn page(saved: &Saved) -> String {
    let mut text = HEAD.to_owned();
    let percent = |part: f64| format!("{:.0} %", 100.0 * part);
    let _ = writeln!(
        text,
        "With {}. Flash and RAM are within {} of what is predicted, cycles within {}, or `measure \
         plan` fails. So it does if more than {:.1} % of the pixels that show the model have a colour \
         that is not, give or take two steps of RGB565, among those of the picture with everything on \
         in the 3 x 3 pixels around.\n",
        saved.compiler.split(" (").next().unwrap_or_default(),
        percent(MOST_BYTES),
        percent(MOST_CYCLES),
        100.0 * MOST_DIFFERENT
    );
    text += "\
## What is chosen

| scene | core | display | RAM for it | views | renderer |
|---|---|---|---:|---:|---|
";
    for plan in &saved.plans {
        let [width, height] = plan.display;
        let (ram, views) = (plan.ram_bytes >> 10, plan.views);
        let _ = writeln!(
            text,
            "| {} | {} | {width} x {height} | {ram} KB | {views} | {} |",
            plan.scene,
            plan.core.title(),
            plan.renderer
        );
    }
    text += "
## Predicted and measured

Flash is that of code and tables, RAM that of buffers and stack, both without the runtime of the core;
cycles are the mean of eight frames, or of all views of a list. An orbit's are its first eight random
views.

| scene | flash | measured | | RAM | measured | | cycles | measured | | different pixels |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|
";
    for plan in &saved.plans {
        let (predicted, measured) = (numbers(&plan.predicted), numbers(&plan.measured));
        let errors = plan.errors().map(|error| format!("{:+.1} %", 100.0 * error));
        let _ = write!(text, "| {}", plan.scene);
        for ((predicted, measured), error) in predicted.iter().zip(&measured).zip(&errors) {
            let _ = write!(text, " | {predicted} | {measured} | {error}");
        }
        let _ = writeln!(text, " | {:.2} % |", 100.0 * plan.different);
    }
    text += "
## Against everything on

The same model with 32 bits of depth, light at vertices, corrected perspective and clipping, in the
highest bands that the RAM holds (or in the lowest, which may take more). Measured.

| scene | flash | everything | saved | RAM | everything | cycles | everything | times as fast |
|---|---:|---:|---:|---:|---:|---:|---:|---:|
";
    for plan in &saved.plans {
        let ([flash, ram, cycles], [all_flash, all_ram, all_cycles]) =
            (numbers(&plan.measured), numbers(&plan.everything));
        let less = 1.0 - f64::from(plan.measured.flash) / f64::from(plan.everything.flash);
        let times = plan.everything.cycles / plan.measured.cycles;
        let _ = writeln!(
            text,
            "| {} | {flash} | {all_flash} | {:.0} % | {ram} | {all_ram} | {cycles} | {all_cycles} | \
             {times:.2} |",
            plan.scene,
            100.0 * less
        );
    }
    text += OMITTED;
    text
}

/// A line for each plan.
pub(super) fn summary(saved: &Saved) -> String {
    let mut text = String::new();
    for plan in &saved.plans {
        let [flash, ram, cycles] = plan.errors().map(|error| format!("{:+.1} %", 100.0 * error));
        let verdict = if plan.is_good() { "as predicted" } else { "NOT as predicted" };
        let _ = writeln!(
            text,
            "{:<14} {:<10} flash {flash}, RAM {ram}, cycles {cycles}, {:.2} % of pixels differ: \
             {verdict}\n{:14} {}",
            plan.scene,
            plan.core.title(),
            100.0 * plan.different,
            "",
            plan.renderer
        );
    }
    text
}

fn numbers(figures: &Figures) -> [String; 3] {
    let cycles = figures.cycles.round() as usize;
    [figures.flash as usize, figures.ram as usize, cycles].map(thousands)
}

const OMITTED: &str = "
## How costs are known, and what is left out

The costs of a renderer are a table (`host-tools/src/plan/costs.json`), measured once with three bodies
that are made for it: a ring of 1,936 small triangles with shared corners, one of 144 large ones
without, both with one-sided sheets in their opening, and a sheet alone, in 24 views each from near to
far. All combinations are measured for one shader, and those without depth and sorting for the one
that interpolates nothing; the others have what they differ by in the simplest renderer. A fixed order
of the triangles has the code of the mesh's order; each further run of a material has an estimated
price, which no scene judges. Parts that planes keep apart have it too, and what programs of 6 and 24
boxes take more for them. Flash and stack are those of that program. Cycles are a sum of what a
frame has of pixels, bands, vertices, triangles, rows, covered pixels and divisions of texture
coordinates; their weights are fitted by least squares of relative errors. No model of this page is
among those bodies. What a sliver takes more, whose gradients are divided exactly, is that of
[stiffness](STIFFNESS.md), on RISC-V of `measure stiffness riscv`; what a row of it without a pixel
takes is an estimate.

- Cores without a table of their own: take that of the Cortex-M4 for an M3, M33 or M7. RISC-V is
  that of an RP2350, Hazard3.
- Mip levels and bilinear filters: the plan makes textures as small as they are seen instead.
- small3dlib: it draws whole frames, without sub-pixels and light, so that no scene here is drawn
  alike. [Results](RESULTS.md) has its instructions beside those of bench scenes in the same view.
- Orders of the triangles for a part of the views each: one order in flash must be right in all of
  them, for the whole mesh or within each of its parts.
- Parts by planes that cut triangles, parts of another number than the planes give (they divide until
  no triangle of a part can hide another one, up to 32 parts), and bodies that touch along two edges
  alone.
- Cycles of few pixels: an order that breaks them could still show fewer wrong pixels than allowed.
- A proof for all views of an orbit (cells of directions): random views bound the part that may fail.
  An order that is made from random views is judged by as many others.
";
