//! The smoke test: the DefaultExperiment of modelDescription.xml with results of the FMU itself.
//!
//! The reference results are written by `tests/python/test_smoke_test.py` with BLESS=1. They are
//! inside the FMU, and beside a release as the FMI cross-check rules name such files.

use anyhow::{Context, Result};
use roxmltree::Document;
use std::fs;
use std::path::Path;

/// Inputs over time.
pub(crate) const STIMULI: &str = include_str!("../assets/default-in.csv");

/// Outputs over time.
pub(crate) const RESULTS: &str = include_str!("../assets/default-ref.csv");

/// Largest deviation from the results, relative to the largest value of each column. Importers
/// that set inputs at the start of a step make other steps than those that interpolate them.
const TOLERANCE: &str = "2e-3";

/// Times of an experiment, as modelDescription.xml gives them.
struct Times {
    start: String,
    stop: String,
    step: String,
}

impl Times {
    fn of(description: &str) -> Result<Self> {
        let document = Document::parse(description).context("modelDescription.xml is not well-formed")?;
        let node = document.descendants().find(|node| node.has_tag_name("DefaultExperiment"));
        let node = node.context("modelDescription.xml has no DefaultExperiment")?;
        let time = |name: &str| -> Result<String> {
            let value = node.attribute(name);
            value.map(str::to_owned).with_context(|| format!("DefaultExperiment has no {name}"))
        };
        Ok(Self { start: time("startTime")?, stop: time("stopTime")?, step: time("stepSize")? })
    }
}

/// The experiment in the format of the layered standard References.
pub(crate) fn experiment(description: &str) -> Result<String> {
    let Times { start, stop, step } = Times::of(description)?;
    Ok(format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<Experiments name="Smoke test" description="The default experiment, with results of the FMU itself">
  <Experiment name="default" description="Ball under a varying load, in partial slip and gross slip, with wear" startTime="{start}" stopTime="{stop}" stepSize="{step}" tolerance="{TOLERANCE}">
    <Stimuli source="default-in.csv"/>
    <References source="default-ref.csv"/>
  </Experiment>
</Experiments>
"#
    ))
}

/// Writes inputs, results and options of a FMU into a folder, by the FMI cross-check rules.
pub(crate) fn write_cross_check(folder: &Path, name: &str, description: &str) -> Result<()> {
    let Times { start, stop, step } = Times::of(description)?;
    let options = format!(
        "StartTime, {start}\nStopTime, {stop}\nStepSize, {step}\nRelTol, {TOLERANCE}\n\
         OutputIntervalLength, {step}\n"
    );
    for (ending, text) in [("in.csv", STIMULI), ("ref.csv", RESULTS), ("ref.opt", &options)] {
        let path = folder.join(format!("{name}_{ending}"));
        fs::write(&path, text).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const DESCRIPTION: &str = r#"<d><DefaultExperiment startTime="0" stopTime="2" stepSize="0.5"/></d>"#;

    #[test]
    fn the_experiment_has_the_times_of_the_description() {
        let text = experiment(DESCRIPTION).unwrap();
        let document = Document::parse(&text).unwrap();
        let node = document.descendants().find(|node| node.has_tag_name("Experiment")).unwrap();
        for (name, value) in [("startTime", "0"), ("stopTime", "2"), ("stepSize", "0.5")] {
            assert_eq!(node.attribute(name), Some(value));
        }
        assert!(experiment("<d/>").unwrap_err().to_string().contains("no DefaultExperiment"));
        let error = experiment("<d><DefaultExperiment/></d>").unwrap_err();
        assert!(error.to_string().contains("no startTime"));
    }

    #[test]
    fn files_have_the_names_of_the_cross_check() {
        let folder = std::env::temp_dir().join(format!("fmu-build-cross-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        write_cross_check(&folder, "Contact", DESCRIPTION).unwrap();
        let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
        assert_eq!(read("Contact_in.csv"), STIMULI);
        assert_eq!(read("Contact_ref.csv"), RESULTS);
        assert!(read("Contact_ref.opt").starts_with("StartTime, 0\nStopTime, 2\nStepSize, 0.5\n"));
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn stimuli_and_results_span_the_default_experiment() {
        let description = fs::read_to_string("../modelDescription.xml").unwrap();
        let stop: f64 = Times::of(&description).unwrap().stop.parse().unwrap();
        for table in [STIMULI, RESULTS] {
            let last = table.lines().last().unwrap().split(',').next().unwrap();
            assert_eq!(last.parse::<f64>().unwrap(), stop);
        }
    }
}
