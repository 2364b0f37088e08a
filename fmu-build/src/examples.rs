//! `cargo fmu examples`: runs each example as a user would, shows its output and its time.

use crate::check::Archive;
use crate::process;
use crate::progress;
use crate::python::Venv;
use crate::workspace::Workspace;
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

/// Sets of parameters that the sweep is run with: enough to see that it keeps all cores busy.
const SETS: &str = "500";

/// One example, ready to run.
pub(crate) struct Example {
    /// Path below `examples/`.
    pub(crate) name: String,
    pub(crate) command: Command,
}

/// The examples in the order of their page; `sweep` says whether its packages are there.
pub(crate) fn all(workspace: &Workspace, venv: &Venv<'_>, fmu: &Path, sweep: bool) -> Result<Vec<Example>> {
    let folder = workspace.product("examples");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let mut rust = workspace.cargo();
    rust.arg("run").args(RUST);
    let mut examples = vec![Example { name: "rust/main.rs".to_owned(), command: rust }];
    for script in scripts(workspace)? {
        let mut python = venv.python();
        python.arg(workspace.file("examples/python").join(&script)).arg(fmu);
        examples.push(Example { name: format!("python/{script}"), command: python });
    }
    if cfg!(target_os = "linux") {
        let (program, unpacked) = (folder.join("drive"), folder.join("contact"));
        compile(workspace, &venv.site_packages()?.join("fmpy/c-code"), &program)?;
        unpack(fmu, &unpacked)?;
        let mut drive = workspace.command(program);
        drive.arg(unpacked);
        examples.push(Example { name: "c/drive.c".to_owned(), command: drive });
    }
    if sweep {
        let mut python = venv.python();
        python.arg("examples/sweep/sweep.py").arg("--fmu").arg(fmu).args(["--sets", SETS]);
        python.arg("--out").arg(folder.join("sweep"));
        examples.push(Example { name: format!("sweep/sweep.py --sets {SETS}"), command: python });
    }
    Ok(examples)
}

/// The Rust example, for cargo's `build` and `run`.
const RUST: [&str; 6] = ["--quiet", "--release", "--locked", "--no-default-features", "--example", "rust"];

/// Compiles the Rust example, so that its time does not include compiling.
pub(crate) fn build_rust(workspace: &Workspace) -> Result<()> {
    progress::quiet("Building the Rust example", |step| {
        let mut cargo = workspace.cargo();
        cargo.arg("build").args(RUST);
        process::run_quietly(step, cargo).map(|_| ())
    })
}

/// Python examples, without the scripts that make their data.
fn scripts(workspace: &Workspace) -> Result<Vec<String>> {
    let mut scripts = Vec::new();
    for entry in fs::read_dir(workspace.file("examples/python"))? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if name.ends_with(".py") && !name.starts_with("make_") {
            scripts.push(name);
        }
    }
    scripts.sort();
    Ok(scripts)
}

fn compile(workspace: &Workspace, headers: &Path, program: &Path) -> Result<()> {
    progress::quiet("Compiling the C example", |step| {
        let mut compiler = workspace.command("cc");
        compiler.arg("-I").arg(headers).arg("examples/c/drive.c").args(["-ldl", "-lm", "-o"]).arg(program);
        process::run_quietly(step, compiler).map(|_| ())
    })
}

fn unpack(fmu: &Path, folder: &Path) -> Result<()> {
    for entry in Archive::open(fmu)?.entries {
        let path = folder.join(&entry.name);
        fs::create_dir_all(path.parent().context("an entry without a folder")?)?;
        fs::write(path, entry.bytes)?;
    }
    Ok(())
}

/// Runs them one after the other with their output shown; ends with a table of times. An error if
/// any fails, after all have run.
pub(crate) fn run(examples: Vec<Example>) -> Result<()> {
    let mut times: Vec<(String, Duration, bool)> = Vec::new();
    for Example { name, command } in examples {
        println!("\n--- {name}");
        let started = Instant::now();
        let ran = process::run_shown(command);
        if let Err(problem) = &ran {
            println!("{problem:#}");
        }
        times.push((name, started.elapsed(), ran.is_ok()));
    }
    println!("\n{}", table(&times));
    let failed: Vec<_> = times.iter().filter(|(.., well)| !well).map(|(name, ..)| name.as_str()).collect();
    ensure!(failed.is_empty(), "failed: {}", failed.join(", "));
    Ok(())
}

/// Names and times as a Markdown table.
fn table(times: &[(String, Duration, bool)]) -> String {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut lines = vec![format!("| example | time on {cores} core(s) |"), "| --- | --- |".to_owned()];
    for (name, time, well) in times {
        let note = if *well { "" } else { ", FAILED" };
        lines.push(format!("| {name} | {}{note} |", progress::seconds(*time)));
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_is_reported_after_all_have_run() {
        let of = |name: &str, program: &str| {
            let mut command = process::command(program);
            command.arg("--version");
            Example { name: name.to_owned(), command }
        };
        let done = run(vec![of("a", "no-such-program"), of("b", "cargo"), of("c", "no-such-either")]);
        assert_eq!(done.unwrap_err().to_string(), "failed: a, c");
    }

    #[test]
    fn every_python_example_is_found() {
        let found = scripts(&Workspace::of_this_program()).unwrap();
        assert!(found.contains(&"loop.py".to_owned()), "{found:?}");
        assert!(found.iter().all(|name| !name.starts_with("make_")));
    }

    #[test]
    fn times_are_a_table() {
        let text = table(&[
            ("a".to_owned(), Duration::from_millis(1500), true),
            ("b".to_owned(), Duration::ZERO, false),
        ]);
        assert!(text.contains("| a | 1.5 s |") && text.contains("| b | 0.0 s, FAILED |"), "{text}");
    }
}
