//! Lines of the library that its tests run, by `cargo llvm-cov`.

use crate::libclang::Environment;
use crate::process::{run_quietly, run_shown};
use crate::progress;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use std::path::PathBuf;

/// The tool and its version.
const TOOL: (&str, &str) = ("cargo-llvm-cov", "0.9.1");

/// Least share of the lines of each part that has to be covered, %.
const LEAST: &str = "95";

/// The parts, each with the files that do not belong to it. Modules of tests do not count, nor does
/// the table of variables, which is computed while compiling.
const PARTS: [(&str, &str); 2] = [
    ("the C interface", r"/src/([^f]|f[^m])|/tests\.rs$|/variables/table\.rs$"),
    ("the engine", r"/src/fmi2/|/tests\.rs$"),
];

/// They look into the symbols of the library and at its memory, to which the counters add some.
const SKIPPED: [&str; 2] = [
    "the_library_exports_the_functions_and_nothing_else",
    "a_library_that_is_loaded_and_unloaded_leaves_no_memory_behind",
];

/// Runs the tests of the library, or some of its test programs, or modules of these as in
/// `fmi::bad_input`; prints for each file the share of its lines that they run, and the lines that
/// they miss. An error below the least, or where a test fails.
pub(crate) fn run(workspace: &Workspace, environment: &Environment, some: &[String]) -> Result<()> {
    if let Some(unknown) = some.iter().find(|name| !is_known(workspace, name)) {
        bail!(
            "`{unknown}` is no test program, nor a module of one: give a folder of tests/ that has a main.rs, such as \
             engine, or a file in it, such as fmi::bad_input"
        );
    }
    let tool = tool(workspace)?;
    let command = |arguments: &[&str]| {
        let mut command = workspace.command(&tool);
        command.arg("llvm-cov").args(arguments);
        command.envs(environment.iter().map(|(name, value)| (name, value)));
        command
    };
    // programs and counts of an earlier run would be added
    progress::quiet("Removing what an earlier run left", |step| {
        run_quietly(step, command(&["clean", "--workspace"]))
    })?;
    let tested = progress::shown("Tests of the library, with counters", || {
        let mut tests = command(&["--no-report", "--locked", "--package", "fretting_contact"]);
        tests.arg("--no-fail-fast");
        if some.is_empty() {
            tests.args(["--lib", "--tests"]);
        }
        tests.args(some.iter().flat_map(|name| ["--test", program_and_module(name).0]));
        tests.arg("--").args(SKIPPED.iter().flat_map(|name| ["--skip", name]));
        tests.args(some.iter().filter_map(|name| program_and_module(name).1));
        run_shown(tests)
    });
    let reported = PARTS.map(|(name, others)| {
        println!("\nLines of {name}:");
        let report = ["report", "--show-missing-lines", "--fail-under-lines", LEAST];
        run_shown(command(&[&report[..], &["--ignore-filename-regex", others]].concat()))
            .with_context(|| format!("there is no report, or less than {LEAST} % of {name} is covered"))
    });
    reported.into_iter().fold(tested, Result::and)
}

/// `fmi` and `bad_input` of `fmi::bad_input`; a program alone has no module.
fn program_and_module(name: &str) -> (&str, Option<&str>) {
    name.split_once("::").map_or((name, None), |(program, module)| (program, Some(module)))
}

/// Whether there is a test program of this name, and in it the module.
fn is_known(workspace: &Workspace, name: &str) -> bool {
    let (program, module) = program_and_module(name);
    let folder = workspace.file("tests").join(program);
    folder.join("main.rs").is_file()
        && module.is_none_or(|module| {
            let first = module.split("::").next().unwrap_or_default();
            folder.join(first).join("mod.rs").is_file() || folder.join(format!("{first}.rs")).is_file()
        })
}

/// The tool, which is built once.
fn tool(workspace: &Workspace) -> Result<PathBuf> {
    let ((name, version), folder) = (TOOL, workspace.product("tools").join(TOOL.1));
    let path = folder.join("bin").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    if !path.exists() {
        progress::quiet(&format!("Building {name}"), |step| {
            let mut cargo = workspace.cargo();
            cargo.args(["install", "--locked", name, "--version", version, "--root"]).arg(&folder);
            run_quietly(step, cargo)
        })?;
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_is_named_behind_its_program() {
        assert_eq!(program_and_module("fmi"), ("fmi", None));
        assert_eq!(program_and_module("fmi::bad_input"), ("fmi", Some("bad_input")));
    }

    #[test]
    fn an_unknown_test_is_named_before_anything_is_compiled() {
        let workspace = Workspace::of_this_program();
        for unknown in ["nope", "", "c", "fmi::nope", "fmi::"] {
            assert!(!is_known(&workspace, unknown), "{unknown}");
        }
        for known in ["engine", "fmi::bad_input", "documents::model_description"] {
            assert!(is_known(&workspace, known), "{known}");
        }
        let error = run(&workspace, &Vec::new(), &["nope".to_owned()]).unwrap_err().to_string();
        assert!(error.contains("`nope` is no test program"), "{error}");
    }
}
