//! The C master of the tests under valgrind and under AddressSanitizer: 10,000 instances in 8
//! threads, every function, instances made and freed one after the other, and the library loaded
//! and unloaded. Any access out of bounds and any leak is an error.

use crate::libclang::Environment;
use crate::process::{self, run_lines, run_quietly};
use crate::workspace::Workspace;
use crate::{fuzz, progress};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the master does: `many`, `loop` and `reload` take counts.
const TASKS: [&[&str]; 4] = [&["abi"], &["loop", "1000"], &["reload", "100"], &["many", "10000", "8"]];

/// A tool to run the master under.
#[derive(Clone, Copy, PartialEq)]
enum Tool {
    Valgrind,
    Sanitizer,
}

impl Tool {
    fn name(self) -> &'static str {
        match self {
            Self::Valgrind => "valgrind",
            Self::Sanitizer => "AddressSanitizer",
        }
    }

    /// What this machine lacks for it.
    fn missing(self) -> Option<&'static str> {
        let works = |program: &str, arguments: &[&str]| {
            let output = process::command(program).args(arguments).output();
            output.is_ok_and(|output| output.status.success())
        };
        match self {
            _ if !cfg!(target_os = "linux") => Some("it is set up for Linux only"),
            Self::Valgrind if !works("valgrind", &["--version"]) => {
                Some("valgrind was not found (Debian, Ubuntu: `apt install valgrind libc6-dbg`)")
            }
            Self::Sanitizer if !has_sanitizer() => Some(
                "`cc -fsanitize=address` cannot link (Debian, Ubuntu: `apt install gcc`, with its libasan)",
            ),
            _ => None,
        }
    }
}

/// Whether the C compiler brings the sanitizer's runtime.
fn has_sanitizer() -> bool {
    let output = process::command("cc").arg("-print-file-name=libasan.so").output();
    output.is_ok_and(|output| String::from_utf8_lossy(&output.stdout).trim().starts_with('/'))
}

/// Runs all tasks under both tools, or reports which could not be run.
pub(crate) fn run(workspace: &Workspace, environment: &Environment) -> Result<()> {
    let mut skipped = Vec::new();
    for tool in [Tool::Valgrind, Tool::Sanitizer] {
        if let Some(missing) = tool.missing() {
            skipped.push(format!("{} was NOT RUN: {missing}", tool.name()));
            continue;
        }
        let library = library(workspace, environment, tool)?;
        let master = master(workspace, tool)?;
        for task in TASKS {
            let title = format!("{}: {}", tool.name(), task.join(" "));
            progress::quiet(&title, |step| {
                let mut command = command(workspace, tool, &master);
                command.arg(&library).arg(guid(workspace)?).args(task);
                run_quietly(step, command).map(|_| ())
            })?;
        }
        println!("{}: no error, no leak in {} tasks", tool.name(), TASKS.len());
    }
    skipped.iter().for_each(|line| println!("{line}"));
    Ok(())
}

fn command(workspace: &Workspace, tool: Tool, master: &Path) -> Command {
    match tool {
        Tool::Valgrind => {
            let mut command = workspace.command("valgrind");
            command.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]);
            command.args(["--errors-for-leak-kinds=definite,indirect,possible"]).arg(master);
            command
        }
        Tool::Sanitizer => {
            let mut command = workspace.command(master);
            command.env("ASAN_OPTIONS", "detect_leaks=1:strict_string_checks=1:check_initialization_order=1");
            command
        }
    }
}

/// The library with symbols for the reports, in a folder of its own.
fn library(workspace: &Workspace, environment: &Environment, tool: Tool) -> Result<PathBuf> {
    let directory = workspace.product("harden").join(tool.name());
    let host = fuzz::host()?;
    progress::shown(&format!("Building the library for {}", tool.name()), || {
        let mut cargo = workspace.cargo();
        cargo.args(["rustc", "--release", "--locked", "--package", "fretting_contact", "--lib"]);
        cargo.args(["--crate-type", "cdylib", "--target", &host, "--target-dir"]).arg(&directory);
        cargo.envs(environment.iter().map(|(name, value)| (name, value)));
        if tool == Tool::Sanitizer {
            // not stable in Rust: this variable makes the compiler allow it
            cargo.env("RUSTC_BOOTSTRAP", "1").env_remove("CARGO_ENCODED_RUSTFLAGS");
            cargo.env("RUSTFLAGS", "-Zsanitizer=address -Cdebug-assertions");
        }
        let status = run_lines(cargo, |_| {})?;
        if !status.success() {
            bail!("cargo could not build the library for {}", tool.name());
        }
        Ok(())
    })?;
    let name = format!("{}fretting_contact{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    Ok(directory.join(host).join("release").join(name))
}

fn master(workspace: &Workspace, tool: Tool) -> Result<PathBuf> {
    let program = workspace.product("harden").join(format!("master-{}", tool.name()));
    progress::quiet("Compiling the C master", |step| {
        let mut compiler = workspace.command("cc");
        compiler.args(["-std=gnu11", "-g", "-O1"]);
        if tool == Tool::Sanitizer {
            compiler.arg("-fsanitize=address");
        }
        compiler.arg("-o").arg(&program).args(["tests/c/master.c", "-ldl", "-lpthread"]);
        run_quietly(step, compiler)
    })?;
    Ok(program)
}

/// The identifier that the library was built with.
fn guid(workspace: &Workspace) -> Result<String> {
    let description = std::fs::read_to_string(workspace.file("modelDescription.xml"))?;
    let guid = description.split_once("guid=\"").and_then(|(_, rest)| rest.split_once('"'));
    Ok(guid.context("modelDescription.xml has no guid")?.0.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_guid_is_that_of_the_description() {
        let guid = guid(&Workspace::of_this_program()).unwrap();
        assert_eq!((guid.len(), guid.matches('-').count()), (36, 4), "{guid}");
    }

    #[test]
    fn the_tasks_are_known_to_the_master() {
        let source = std::fs::read_to_string(Workspace::of_this_program().file("tests/c/master.c")).unwrap();
        for task in TASKS {
            assert!(source.contains(&format!("!strcmp(task, \"{}\")", task[0])), "{task:?}");
        }
    }
}
