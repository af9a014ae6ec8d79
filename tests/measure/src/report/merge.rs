//! A report of some scenes, and a saved one that has the others.

use anyhow::{Context as _, Result, ensure};

use super::Report;
use crate::{conditions::Conditions, cores::Core};

/// The saved report, if scenes that are measured on these cores can be put into it.
///
/// # Errors
///
/// Returns an error if there is none, or if it is of other cores.
pub(super) fn kept(saved: Option<Report>, cores: &[Core]) -> Result<Report> {
    let saved = saved.context("there is no saved report whose other scenes are kept")?;
    ensure!(saved.cores == cores, "the saved scenes were measured on other cores: measure all");
    Ok(saved)
}

/// Puts what is measured into the saved report, in the order of the scenes' names.
///
/// # Errors
///
/// Returns an error if the saved figures are of other tools: they would not be comparable.
pub(super) fn merge(saved: Report, measured: Report, names: &[String]) -> Result<Report> {
    let of_tools = |report: &Report| -> Vec<(Core, Conditions)> {
        let undated = |(core, conditions): &(Core, Conditions)| {
            (*core, Conditions { date: String::new(), ..conditions.clone() })
        };
        report.conditions.iter().map(undated).collect()
    };
    ensure!(
        of_tools(&saved) == of_tools(&measured),
        "the saved scenes were measured with another compiler or QEMU: measure all of them"
    );
    let is_new = |name: &String| measured.scenes.iter().any(|of| of.scene.name == *name);
    let mut later = saved.later;
    later.retain(|(name, _)| !is_new(name));
    let day = |report: &[(Core, Conditions)]| report.first().map(|(_, of)| of.date.clone());
    let today = day(&measured.conditions);
    if let Some(today) = today.filter(|today| Some(today) != day(&saved.conditions).as_ref()) {
        later.extend(measured.scenes.iter().map(|of| (of.scene.name.clone(), today.clone())));
    }
    let kept = saved.scenes.into_iter().filter(|of| !is_new(&of.scene.name));
    let mut scenes: Vec<_> = kept.chain(measured.scenes.clone()).collect();
    scenes.sort_by_key(|of| names.iter().position(|name| *name == of.scene.name));
    Ok(Report { cores: saved.cores, conditions: saved.conditions, later, scenes })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{points::Measured, scenes};

    fn report(date: &str, qemu: &str, names: &[&str], reference_rms: f64) -> Report {
        let conditions = Conditions {
            date: date.into(),
            rustc: "rustc 1".into(),
            opt_level: "3".into(),
            qemu: qemu.into(),
        };
        let scene = scenes::Scene::of(&scenes::shipped()[0], 1).unwrap();
        let measured = |name: &&str| Measured {
            scene: scenes::Scene { name: (*name).into(), ..scene.clone() },
            reference_rms,
            points: Vec::new(),
            splits: Vec::new(),
            texels: Vec::new(),
            narrow: Vec::new(),
        };
        Report {
            cores: vec![Core::M4],
            conditions: vec![(Core::M4, conditions)],
            later: Vec::new(),
            scenes: names.iter().map(measured).collect(),
        }
    }

    #[test]
    fn new_scenes_take_the_place_of_saved_ones() {
        let names = ["a", "b", "c"].map(str::to_owned);
        let saved = report("2026-01-01", "7", &["a", "c"], 1.0);
        let merged = merge(saved, report("2026-01-02", "7", &["c", "b"], 2.0), &names).unwrap();
        let found: Vec<_> =
            merged.scenes.iter().map(|of| (of.scene.name.as_str(), of.reference_rms)).collect();
        assert_eq!(found, [("a", 1.0), ("b", 2.0), ("c", 2.0)]);
        let day = |name: &str| (name.to_owned(), "2026-01-02".to_owned());
        assert_eq!(merged.later, [day("c"), day("b")]);
        assert_eq!(merged.conditions[0].1.date, "2026-01-01");
        // Measured once more on the first day, which is that of the others.
        let merged = merge(merged, report("2026-01-01", "7", &["b"], 3.0), &names).unwrap();
        assert_eq!(merged.later, [day("c")]);
        assert_eq!(merged.scenes[1].reference_rms, 3.0);
    }

    #[test]
    fn figures_of_other_tools_are_not_mixed() {
        let names = ["a".to_owned()];
        let saved = report("2026-01-01", "7", &["a"], 1.0);
        assert!(merge(saved.clone(), report("2026-01-01", "8", &["a"], 2.0), &names).is_err());
        assert!(kept(Some(saved.clone()), &[Core::M0plus]).is_err());
        assert!(kept(None, &[Core::M4]).is_err());
        assert_eq!(kept(Some(saved.clone()), &[Core::M4]).unwrap(), saved);
    }
}
