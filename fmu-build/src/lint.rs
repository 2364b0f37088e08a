//! `cargo fmu lint`: formatting, lints, spelling and wording; any finding is an error.

use crate::commands::{RUST_MASTER, Setup};
use crate::process::{run_quietly, run_shown};
use crate::python::Venv;
use crate::{progress, wording};
use anyhow::{Result, bail};
use std::path::PathBuf;
use std::process::Command;

/// Packages whose wheels bring the programs typos and ruff.
const REQUIREMENTS: &str = "fmu-build/lint-requirements.txt";

/// Arguments of typos for the list of words that are not to be used.
const WORDS: [&str; 3] = ["--isolated", "--config", "fmu-build/words.toml"];

/// Runs all checks in turn, the fastest first; stops at the first that has findings.
pub(crate) fn run(setup: &Setup<'_>) -> Result<()> {
    let workspace = setup.workspace;
    let venv = Venv::with(workspace, &[workspace.file(REQUIREMENTS)])?;
    let program = |name: &str| -> Command {
        workspace.command(venv.programs().join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
    };
    progress::shown("Spelling", || run_shown(program("typos")))?;
    progress::shown("Words", || {
        let mut typos = program("typos");
        typos.args(WORDS);
        run_shown(typos)
    })?;
    progress::quiet("Phrases and columns", |step| {
        let mut typos = program("typos");
        // the files of the checkout without those that the list of words excludes
        typos.args(WORDS).arg("--files");
        let files: Vec<PathBuf> = run_quietly(step, typos)?.lines().map(PathBuf::from).collect();
        let findings = wording::findings(workspace.root(), &files)?;
        if !findings.is_empty() {
            bail!("{} finding(s):\n  {}", findings.len(), findings.join("\n  "));
        }
        Ok(())
    })?;
    progress::shown("ruff", || {
        let mut ruff = program("ruff");
        ruff.args(["check", "--quiet", "--no-cache", "--output-format", "concise", "."]);
        run_shown(ruff)
    })?;
    progress::shown("rustfmt", || {
        // the fuzz targets are a workspace of their own, and so is the master
        ["Cargo.toml", "fuzz/Cargo.toml", RUST_MASTER].iter().try_for_each(|manifest| {
            let mut cargo = setup.cargo("fmt");
            cargo.args(["--all", "--check", "--manifest-path", manifest]);
            run_shown(cargo)
        })
    })?;
    progress::shown("clippy", || {
        let mut cargo = setup.cargo("clippy");
        cargo.args(["--workspace", "--all-targets", "--locked", "--", "--deny", "warnings"]);
        run_shown(cargo)
    })
}
