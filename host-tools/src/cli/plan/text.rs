//! A plan for a reader.

use std::{fmt::Write as _, path::Path};

use host_tools::{
    model::thousands,
    plan::{Candidate, Fault, Other, Plan, Predicted, Request, Study},
};

/// The whole plan.
pub(super) fn text(
    path: &Path,
    output: &Path,
    study: &Study,
    plan: &Plan,
    with_rejected: bool,
) -> String {
    let request = &study.request;
    let [width, height] = request.display;
    let mut text = format!(
        "{}: {width} x {height} pixels on a {} at {} MHz, {}\n\n",
        path.display(),
        request.core.title(),
        request.clock_hz / 1e6,
        request.views.basis()
    );
    for decision in &plan.decisions {
        let _ = writeln!(text, "{:<12} {}", decision.about, decision.choice);
        let _ = writeln!(text, "{:12} {}", "", decision.reason);
        let _ = writeln!(text, "{:12} {}; margin: {}", "", decision.basis, decision.margin);
        if let Some(other) = &decision.other {
            let _ = writeln!(text, "{:12} instead {}", "", costs(other));
        }
        text.push('\n');
    }
    text += &table(request, plan);
    if with_rejected {
        let _ = write!(text, "\n{}", rejected(request, plan));
    }
    let _ = writeln!(text, "\nThe least time is limited by {}.", limit(request, plan));
    let _ = writeln!(text, "Wrote {}", output.display());
    text
}

/// What another choice costs more.
fn costs(other: &Other) -> String {
    let bytes = |bytes: i64| {
        let sign = if bytes < 0 { '-' } else { '+' };
        format!("{sign}{}", thousands(bytes.unsigned_abs() as usize))
    };
    format!(
        "{}: {} bytes of flash, {} of RAM, {} cycles a frame",
        other.choice,
        bytes(other.flash_bytes),
        bytes(other.ram_bytes),
        bytes(other.cycles.round() as i64)
    )
}

/// What limits the number of frames.
pub(super) fn limit(request: &Request, plan: &Plan) -> String {
    let computing = plan.predicted.cycles / request.clock_hz;
    let sending = plan.predicted.seconds - computing;
    if sending > computing {
        format!("the bus: {:.1} ms of {:.1} ms", 1e3 * sending, 1e3 * plan.predicted.seconds)
    } else {
        format!("the core: {:.1} ms of {:.1} ms", 1e3 * computing, 1e3 * plan.predicted.seconds)
    }
}

/// What the renderer takes, beside the one with everything on.
fn table(request: &Request, plan: &Plan) -> String {
    let (planned, everything) = (&plan.predicted, &plan.everything.1);
    let number = |number: f64| thousands(number.round() as usize);
    let row = |name: &str, of: &dyn Fn(&Predicted) -> String| {
        format!("{name:<28}{:>14}{:>16}\n", of(planned), of(everything))
    };
    let mut text = format!("{:<28}{:>14}{:>16}\n", "", "planned", "everything on");
    text += &row("Flash, bytes", &|p| thousands(p.flash_bytes() as usize));
    text += &row("  code", &|p| thousands(p.code_bytes as usize));
    text += &row("  tables", &|p| thousands(p.table_bytes as usize));
    text += &row("RAM, bytes", &|p| thousands(p.ram_bytes() as usize));
    text += &row("  buffers", &|p| thousands(p.buffer_bytes as usize));
    text += &row("  stack", &|p| thousands(p.stack_bytes as usize));
    text += &row("Cycles a frame, mean", &|p| number(p.cycles));
    text += &row("  most of all views", &|p| number(p.most_cycles));
    text += &row("Frames a second", &|p| format!("{:.1}", 1.0 / p.seconds));
    if request.bus_hz.is_some() {
        text += &row("  without the bus", &|p| format!("{:.1}", request.clock_hz / p.cycles));
    }
    text
}

/// What is not taken.
fn rejected(request: &Request, plan: &Plan) -> String {
    let mut text =
        format!("{:<52}{:>9}{:>9}{:>12}  {}\n", "Not taken", "flash", "RAM", "cycles", "because");
    for (candidate, predicted, fault) in &plan.rejected {
        let because = match fault {
            Fault::Wrong => "it shows wrong pixels",
            Fault::Cycle => "no order is right in all views",
            Fault::Ram => "it takes too much RAM",
            Fault::Flash => "it takes too much flash",
            Fault::Time => "it takes more time",
        };
        let _ = writeln!(
            text,
            "{:<52}{:>9}{:>9}{:>12}  {because}",
            name(request, candidate),
            thousands(predicted.flash_bytes() as usize),
            thousands(predicted.ram_bytes() as usize),
            thousands(predicted.cycles.round() as usize)
        );
    }
    text
}

/// A renderer in a few words.
fn name(request: &Request, candidate: &Candidate) -> String {
    use host_tools::plan::Vertices;
    let Candidate { types, rows } = candidate;
    let bands = match request.display[1].div_ceil(*rows) {
        1 => "whole".to_owned(),
        bands => format!("{bands} bands"),
    };
    let vertices = match types.vertices {
        Vertices::Stored => "",
        Vertices::OnDemand => ", vertices on demand",
    };
    format!("{}, {bands}{vertices}", types.visibility.title())
}
