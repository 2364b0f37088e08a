//! The `cargo fmu` commands: build, check and try out `FrettingContact.fmu`.
//!
//! Each command first sets up what it needs: a virtual environment under `target/venv` with pinned
//! packages, and libclang for the FMI types, taken from the system or from a wheel. This program
//! does not link the library itself, so it compiles where libclang is not yet found.

mod check;
mod commands;
mod coverage;
mod cross;
mod documentation;
mod emulate;
mod examples;
mod fuzz;
mod harden;
mod libclang;
mod library;
mod licences;
mod lint;
mod merge;
mod package;
mod platform;
mod presets;
mod process;
mod progress;
mod python;
mod reference;
mod release;
mod smoke_test;
mod table_cells;
mod terminals;
mod totals;
mod wheel;
mod wheel_tag;
mod wording;
mod workspace;
mod xml;

use anyhow::Result;
use clap::{Parser, Subcommand};
use platform::Platform;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use workspace::Workspace;

/// Builds, checks and tries out FrettingContact.fmu.
#[derive(Parser)]
#[command(name = "cargo fmu", bin_name = "cargo fmu", version)]
struct Arguments {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Build, package and check target/fmu/FrettingContact.fmu
    Build {
        /// Platform folders to build for, such as linux64; this machine's own if not given
        #[arg(long, value_delimiter = ',', value_name = "FOLDER")]
        platforms: Vec<String>,
        /// Oldest glibc to run on, such as 2.17: for releases; this machine's own if not given
        #[arg(long, value_name = "VERSION")]
        glibc: Option<String>,
    },
    /// Join FMUs that were built on different machines into one
    Merge {
        /// The FMUs; what is not a library is taken from the first
        #[arg(required = true, num_args = 2..)]
        fmus: Vec<PathBuf>,
        /// Where to write; target/fmu/FrettingContact.fmu if not given
        #[arg(long)]
        output: Option<PathBuf>,
    },
    /// Check an FMU: exported functions, archive, model description, `fmpy validate`
    Check {
        /// The FMU; target/fmu/FrettingContact.fmu if not given
        path: Option<PathBuf>,
    },
    /// Build, then drive the FMU through the worked example; pictures, CSV and a page (index.html)
    /// go to target/demo
    Demo,
    /// Build, then run every example; shows the output and time of each
    Examples,
    /// Make a profile table for the FMU from a measured line scan; a picture goes beside it
    #[command(disable_help_flag = true)]
    Profile {
        /// SCAN [--unit um] [--center X] -o FILE; --help lists them all
        #[arg(trailing_var_arg = true, allow_hyphen_values = true, required = true)]
        arguments: Vec<OsString>,
    },
    /// Error against run time, and stability of extreme scenes; pages and pictures go to reports
    Report,
    /// Build, then run the tests of Rust and Python
    Test {
        /// Platform folders to build the tested FMU for; those of other machines are run under
        /// their emulators
        #[arg(long, value_delimiter = ',', value_name = "FOLDER")]
        platforms: Vec<String>,
        /// Drive the FMU with the master in Rust, too, whose importer is long to compile
        #[arg(long)]
        rust_master: bool,
    },
    /// Run the Python tests on an FMU
    TestPython {
        /// The FMU; target/fmu/FrettingContact.fmu if not given
        path: Option<PathBuf>,
    },
    /// Load and step the libraries of an FMU that are for other machines, under their emulators
    Try {
        /// The FMU; target/fmu/FrettingContact.fmu if not given
        path: Option<PathBuf>,
    },
    /// Make the Python package fretting_contact as a wheel, with the FMU inside
    Wheel {
        /// The FMU, for one or several platforms; target/fmu/FrettingContact.fmu if not given
        #[arg(long)]
        fmu: Option<PathBuf>,
        /// Folder to write the wheel into; target/dist if not given
        #[arg(long)]
        output: Option<PathBuf>,
    },
    /// Run the fuzz targets under AddressSanitizer: calls, states, profiles
    Fuzz {
        /// The targets; all if none is given
        targets: Vec<String>,
        /// Time for each target, s
        #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
        seconds: u32,
        /// Inputs for each target, instead of a time
        #[arg(long, conflicts_with = "seconds")]
        runs: Option<u64>,
        /// Of the mutations; 0 for another one each time
        #[arg(long, default_value_t = 1)]
        seed: u32,
    },
    /// Run a C master with 10,000 instances under valgrind and AddressSanitizer
    Harden,
    /// Run the tests of the library with counters: lines that none of them runs; an error below 95
    /// %
    Coverage {
        /// Test programs, such as engine, or modules of them, such as fmi::bad_input; all tests if
        /// none is given
        tests: Vec<String>,
    },
    /// Make what is published, under target/dist: FMU for three platforms, presets, notes,
    /// checksums
    Release,
    /// Write modelDescription.xml and docs/variables.md, which follow from the table of variables
    Describe,
    /// Check formatting, lints, spelling and wording; any finding is an error
    Lint,
    /// Print the environment that plain cargo calls need to find libclang, for `eval "$(cargo fmu
    /// env)"`
    Env,
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(status) => status,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(task: Task) -> Result<ExitCode> {
    let workspace = Workspace::of_this_program();
    match task {
        Task::Build { platforms, glibc } => {
            let platforms = Platform::requested(&platforms)?;
            let setup = commands::set_up(&workspace)?;
            glibc.map_or_else(
                || setup.build(&platforms),
                |version| setup.build_for_glibc(&platforms, &version),
            )?;
        }
        Task::Merge { fmus, output } => {
            let output = std::path::absolute(output.unwrap_or_else(|| workspace.fmu()))?;
            merge::merge(&fmus, &output)?;
            commands::set_up(&workspace)?.check(&output)?;
        }
        Task::Check { path } => {
            let path = std::path::absolute(path.unwrap_or_else(|| workspace.fmu()))?;
            commands::set_up(&workspace)?.check(&path)?;
        }
        Task::Demo => {
            let setup = commands::set_up(&workspace)?;
            setup.demo(&setup.build(&[Platform::own()?])?)?;
        }
        Task::Examples => {
            let setup = commands::set_up(&workspace)?;
            setup.examples(&setup.build(&[Platform::own()?])?)?;
        }
        Task::Profile { arguments } => return commands::profile(&workspace, &arguments),
        Task::Report => commands::set_up(&workspace)?.report()?,
        Task::Test { platforms, rust_master } => {
            let platforms = Platform::requested(&platforms)?;
            commands::set_up(&workspace)?.test(&platforms, rust_master)?;
        }
        Task::TestPython { path } => {
            let path = std::path::absolute(path.unwrap_or_else(|| workspace.fmu()))?;
            commands::set_up(&workspace)?.test_python(&path)?;
        }
        Task::Try { path } => {
            let path = std::path::absolute(path.unwrap_or_else(|| workspace.fmu()))?;
            let lines = emulate::lines(&emulate::try_out(&workspace, &path)?);
            if lines.is_empty() {
                eprintln!("{} has no library for another machine that could be run here", path.display());
            }
            lines.iter().for_each(|line| println!("{line}"));
        }
        Task::Wheel { fmu, output } => {
            let fmu = std::path::absolute(fmu.unwrap_or_else(|| workspace.fmu()))?;
            let output = std::path::absolute(output.unwrap_or_else(|| workspace.product("dist")))?;
            wheel::build(&workspace, &fmu, &output)?;
        }
        Task::Fuzz { targets, seconds, runs, seed } => {
            let effort = runs.map_or(fuzz::Effort::Seconds(seconds), fuzz::Effort::Runs);
            fuzz::run(&workspace, &commands::set_up(&workspace)?.environment, &targets, effort, seed)?;
        }
        Task::Harden => harden::run(&workspace, &commands::set_up(&workspace)?.environment)?,
        Task::Coverage { tests } => {
            coverage::run(&workspace, &commands::set_up(&workspace)?.environment, &tests)?;
        }
        Task::Release => release::run(&commands::set_up(&workspace)?)?,
        Task::Describe => commands::set_up(&workspace)?.describe()?,
        Task::Lint => lint::run(&commands::set_up(&workspace)?)?,
        Task::Env => print_environment(&workspace)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Lines that a POSIX shell evaluates.
fn print_environment(workspace: &Workspace) -> Result<()> {
    for (name, value) in commands::set_up(workspace)?.environment {
        println!("export {name}='{}'", Path::new(&value).display().to_string().replace('\'', r"'\''"));
    }
    Ok(())
}
