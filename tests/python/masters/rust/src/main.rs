//! The `fmi` crate as a master: <https://github.com/jondo2010/rust-fmi>. Reads its task from stdin
//! as the other masters do, and leaves its answer beside it.

use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common};
use fmi::traits::FmiImport;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;

/// Inputs that are set before each step.
const INPUTS: [&str; 2] = ["normal_force", "tangential_displacement"];

#[derive(Deserialize)]
struct Task {
    fmu: PathBuf,
    folder: PathBuf,
    step: f64,
    inputs: Vec<[f64; 2]>,
    outputs: Vec<String>,
    parameters: BTreeMap<String, f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let task: Task = serde_json::from_reader(std::io::stdin())?;
    let import: Fmi2Import = fmi::import::from_path(&task.fmu)?;
    let reference =
        |name: &str| import.model_description().model_variable_by_name(name).map(|v| v.value_reference);
    let inputs = INPUTS.iter().map(|name| reference(name)).collect::<Result<Vec<_>, _>>()?;
    let outputs = task.outputs.iter().map(|name| reference(name)).collect::<Result<Vec<_>, _>>()?;

    let mut fmu = import.instantiate_cs("rust", false, true)?;
    for (name, value) in &task.parameters {
        fmu.set_real(&[reference(name)?], &[*value])?;
    }
    fmu.setup_experiment(None, 0.0, None)?;
    fmu.enter_initialization_mode()?;
    fmu.exit_initialization_mode()?;
    let mut rows = Vec::new();
    for (k, values) in task.inputs.iter().enumerate() {
        fmu.set_real(&inputs, values)?;
        fmu.do_step(k as f64 * task.step, task.step, true)?;
        let mut row = vec![0.0; outputs.len()];
        fmu.get_real(&outputs, &mut row)?;
        rows.push(row);
    }
    fmu.terminate()?;
    serde_json::to_writer(std::fs::File::create(task.folder.join("answer.json"))?, &rows)?;
    Ok(())
}
