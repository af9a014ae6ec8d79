//! Fog.

use clap::Args;
use host_tools::{
    check::{BACKGROUND, Fog, FogBy, View},
    reference,
};

use super::names::{choice, name, within};

#[derive(Clone, Debug, Args)]
pub(super) struct FogOptions {
    /// Fog by the distance from the camera's plane: none up to START and all from END on, or e to
    /// the -DENSITY a unit
    #[arg(long, value_name = "linear:START:END|exp:DENSITY", value_parser = fog)]
    fog: Option<reference::Fog>,
    /// Where fog is computed
    #[arg(
        long,
        value_name = "WHERE",
        requires = "fog",
        default_value = name(&FogBy::NAMES, FogBy::default()),
        value_parser = choice(&FogBy::NAMES)
    )]
    fog_by: FogBy,
}

impl FogOptions {
    pub(super) fn over(&self, view: View) -> View {
        let Self { fog, fog_by: by } = *self;
        View { fog: fog.map(|law| Fog { law, by, color: BACKGROUND }), ..view }
    }
}

/// A law of fog, as in linear:2:10 or exp:0.3.
fn fog(text: &str) -> Result<reference::Fog, String> {
    let number = |text: &str, most: f64| within(0.0, most)(text);
    if let Some(density) = text.strip_prefix("exp:") {
        return Ok(reference::Fog::Exponential { density: number(density, 255.0)? });
    }
    let ends = text.strip_prefix("linear:").and_then(|ends| ends.split_once(':'));
    let (start, end) = ends.ok_or("write linear:START:END or exp:DENSITY, as in exp:0.3")?;
    let [start, end] = [number(start, 65_535.0)?, number(end, 65_535.0)?];
    if end <= start {
        return Err("it must end beyond its start".into());
    }
    Ok(reference::Fog::Linear { start, end })
}

/// The law as it is written.
pub(super) fn law(law: reference::Fog) -> String {
    match law {
        reference::Fog::Linear { start, end } => format!("linear:{start}:{end}"),
        reference::Fog::Exponential { density } => format!("exp:{density}"),
    }
}
