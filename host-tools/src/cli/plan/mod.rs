//! The command `plan`: what a scene needs, and the Rust file that has just that.

mod arguments;
mod text;

use std::path::Path;

use anyhow::{Result, bail};
use host_tools::plan::{Candidate, Costs, Decision, Fault, Plan, Predicted, Request, Study};
use serde::Serialize;

pub(super) use self::arguments::Arguments;
use super::{
    Done, convert,
    output::{self, Overwriting},
    progress::Progress,
};

/// What `--json` prints.
#[derive(Serialize)]
struct Json<'a> {
    model: String,
    output: String,
    core: &'static str,
    views: usize,
    chosen: Candidate,
    predicted: Predicted,
    flash_bytes: u32,
    ram_bytes: u32,
    frames_per_second: f64,
    decisions: &'a [Decision],
    everything: Predicted,
    rejected: Vec<Rejected>,
}

#[derive(Serialize)]
struct Rejected {
    candidate: Candidate,
    predicted: Predicted,
    fault: Fault,
}

pub(super) fn run(arguments: &Arguments) -> Result<Done> {
    let path = &arguments.model;
    if output::is_standard(path) {
        bail!("plan reads a model several times: name a file instead of the standard input");
    }
    let output = arguments.output.clone().unwrap_or_else(|| output::named_after(path, "_plan.rs"));
    let is_standard = output::is_standard(&output);
    if is_standard && arguments.json {
        bail!("--json and -o - both write to the standard output: leave out one");
    }
    let (request, options) = (arguments.request()?, arguments.options());
    // For its warnings.
    let model = convert::load(path, &options)?;
    if !is_standard {
        let inputs = output::inputs(&model);
        convert::allow(&output, Overwriting { force: arguments.force, inputs: &inputs })?;
    }
    let study = study(path, &options, &request)?;
    let plan = study.plan(&Costs::measured())?;
    let is_fast_enough =
        request.frames_per_second.is_none_or(|least| 1.0 / plan.predicted.seconds >= least);
    if let Some(least) = request.frames_per_second.filter(|_| !is_fast_enough) {
        let text = format!(
            "{:.1} frames a second are expected, and {least} are wanted: {}",
            1.0 / plan.predicted.seconds,
            text::limit(&request, &plan)
        );
        output::complain("warning", &text);
    }
    let text = if is_standard {
        plan.source
    } else {
        output::write(&output, plan.source.as_bytes())?;
        if arguments.json {
            json(arguments, &output, &study, &plan)?
        } else {
            text::text(path, &output, &study, &plan, arguments.explain)
        }
    };
    Ok(Done { output: text.into(), is_within_bounds: is_fast_enough })
}

fn study(path: &Path, options: &host_tools::model::Options, request: &Request) -> Result<Study> {
    let progress = Progress::over(request.views.count(), "looking at views");
    Ok(Study::new(path, options, request, |_| progress.step())?)
}

fn json(arguments: &Arguments, output: &Path, study: &Study, plan: &Plan) -> Result<String> {
    let rejected = plan.rejected.iter().map(|&(candidate, predicted, fault)| Rejected {
        candidate,
        predicted,
        fault,
    });
    output::json(&Json {
        model: arguments.model.to_string_lossy().into_owned(),
        output: output.to_string_lossy().into_owned(),
        core: study.request.core.name(),
        views: study.work.len(),
        chosen: plan.chosen,
        predicted: plan.predicted,
        flash_bytes: plan.predicted.flash_bytes(),
        ram_bytes: plan.predicted.ram_bytes(),
        frames_per_second: 1.0 / plan.predicted.seconds,
        decisions: &plan.decisions,
        everything: plan.everything.1,
        rejected: rejected.collect(),
    })
}
