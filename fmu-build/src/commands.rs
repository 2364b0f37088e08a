//! The commands, each a list of named steps.

use crate::check::{self, Archive};
use crate::libclang::{self, Environment};
use crate::library::OldGlibc;
use crate::platform::Platform;
use crate::process::{self, run_quietly, run_shown};
use crate::python::Venv;
use crate::totals::Totals;
use crate::workspace::Workspace;
use crate::{emulate, examples, library, package, presets, progress};
use anyhow::{Context, Result, anyhow, bail, ensure};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc;
use std::thread;
use std::time::Instant;

/// What the Python side needs.
const REQUIREMENTS: &str = "tests/python/requirements.txt";

/// What a build for an old glibc needs beyond the rest.
const ZIG: &str = "fmu-build/zig-requirements.txt";

/// What the demo's page of pictures needs beyond the rest.
const PAGE: (&str, &str) = ("The page of pictures", "examples/demo/page-requirements.txt");

/// What some tests need beyond the rest: the page and a driver for browsers, the other masters and
/// tools, and the sweep on Dask.
const EXTRAS: [(&str, &str); 5] = [
    PAGE,
    SWEEP,
    ("The page in a browser", "tests/python/browser-requirements.txt"),
    ("The other masters", "tests/python/masters-requirements.txt"),
    ("The Modelica compiler and the reader of SSP files", "tests/python/tools-requirements.txt"),
];

const SWEEP: (&str, &str) = ("The sweep", "examples/sweep/sweep-requirements.txt");

/// A master in Rust: its importer has more dependencies than the library, so that it is a package
/// of its own.
pub(crate) const RUST_MASTER: &str = "tests/python/masters/rust/Cargo.toml";

/// Runs `python/fretting_contact/profile.py` with these arguments, in the caller's working
/// directory.
pub(crate) fn profile(workspace: &Workspace, arguments: &[OsString]) -> Result<()> {
    let venv = Venv::with(workspace, &[workspace.file(REQUIREMENTS)])?;
    let mut python = venv.python();
    python.args(["-m", "fretting_contact.profile"]).args(arguments);
    python.current_dir(std::env::current_dir()?).env("PYTHONPATH", workspace.file("python"));
    // the matrices are small: threads would only wait for each other
    python.env("OPENBLAS_NUM_THREADS", "1").env("PYTHONDONTWRITEBYTECODE", "1");
    ensure!(python.status()?.success(), "no profile was written: see above");
    Ok(())
}

/// What every command works with, set up on first use.
pub(crate) struct Setup<'a> {
    pub(crate) workspace: &'a Workspace,
    venv: Venv<'a>,
    /// For every call of cargo that compiles fmi-sys.
    pub(crate) environment: Environment,
}

/// Python with its packages, and libclang.
pub(crate) fn set_up(workspace: &Workspace) -> Result<Setup<'_>> {
    let mut requirements = vec![workspace.file(REQUIREMENTS)];
    let of_system = libclang::of_system();
    if of_system.is_none() {
        requirements.push(workspace.file("fmu-build/libclang-requirements.txt"));
    }
    let venv = Venv::with(workspace, &requirements)?;
    let environment = match of_system {
        Some(environment) => environment,
        None => libclang::of_wheel(&venv.site_packages()?)?,
    };
    Ok(Setup { workspace, venv, environment })
}

impl Setup<'_> {
    /// Builds, packages and checks the FMU for some platforms; returns its path. A faulty package
    /// is kept beside it under another name. Libraries for other machines are loaded and stepped
    /// under an emulator, if there is one.
    pub(crate) fn build(&self, platforms: &[&Platform]) -> Result<PathBuf> {
        self.build_with(platforms, None)
    }

    /// The same for systems with a glibc as old as `version`.
    pub(crate) fn build_for_glibc(&self, platforms: &[&Platform], version: &str) -> Result<PathBuf> {
        OldGlibc::numbers(version)?;
        ensure!(cfg!(target_os = "linux"), "--glibc is for Linux");
        let venv = Venv::with(self.workspace, &[self.workspace.file(ZIG)])?;
        let old = OldGlibc { version, programs: venv.programs() };
        self.build_with(platforms, Some(&old))
    }

    fn build_with(&self, platforms: &[&Platform], old: Option<&OldGlibc<'_>>) -> Result<PathBuf> {
        let fmu = self.workspace.fmu();
        let unchecked = fmu.with_extension("unchecked.fmu");
        let mut libraries = Vec::new();
        for &platform in platforms {
            let title = format!("Building the library for {}", platform.folder);
            let build = || library::build(self.workspace, &self.environment, platform, old);
            libraries.push((platform, progress::shown(&title, build)?));
        }
        progress::quiet("Packaging", |_| package::write(self.workspace, &libraries, &unchecked))?;
        self.check(&unchecked)?;
        for line in emulate::lines(&emulate::try_out(self.workspace, &unchecked)?) {
            eprintln!("{line}");
        }
        std::fs::rename(&unchecked, &fmu)?;
        presets::copy(self.workspace, fmu.parent().context("the FMU is in no folder")?)?;
        let folders: Vec<_> =
            platforms.iter().flat_map(|platform| platform.package_folders(platforms)).collect();
        eprintln!("FMU for {}: {}", folders.join(", "), fmu.display());
        Ok(fmu)
    }

    /// Our own checks, then those of fmpy.
    pub(crate) fn check(&self, fmu: &Path) -> Result<()> {
        progress::quiet("Checking exports, archive and model description", |_| {
            let problems = check::problems(&Archive::open(fmu)?);
            if !problems.is_empty() {
                bail!("{} has {} fault(s):\n  {}", fmu.display(), problems.len(), problems.join("\n  "));
            }
            Ok(())
        })?;
        progress::quiet("Checking with `fmpy validate`", |step| {
            let mut fmpy = self.venv.python();
            fmpy.args(["-m", "fmpy", "validate"]).arg(fmu);
            run_quietly(step, fmpy)?;
            Ok(())
        })
    }

    /// Writes the files that follow from the table of variables.
    pub(crate) fn describe(&self) -> Result<()> {
        progress::shown("Writing modelDescription.xml and docs/variables.md", || {
            let mut cargo = self.cargo("run");
            cargo.args(["--quiet", "--locked", "--example", "describe"]);
            run_shown(cargo)
        })
    }

    /// Drives the FMU through the worked example.
    pub(crate) fn demo(&self, fmu: &Path) -> Result<()> {
        self.install_if_possible(PAGE);
        let output = self.workspace.product("demo");
        progress::shown("Running the worked example", || {
            let mut demo = self.venv.python();
            demo.arg("examples/demo/demo.py").arg("--fmu").arg(fmu).arg("--out").arg(&output);
            demo.env("MPLBACKEND", "Agg").env("PYTHONUNBUFFERED", "1");
            run_shown(demo)
        })?;
        eprintln!("Pictures, tables and a page: {}", output.display());
        Ok(())
    }

    /// Runs every example with its output and time.
    pub(crate) fn examples(&self, fmu: &Path) -> Result<()> {
        let sweep = self.install_if_possible(SWEEP);
        examples::build_rust(self.workspace)?;
        examples::run(examples::all(self.workspace, &self.venv, fmu, sweep)?)
    }

    /// Measures what the pages under `reports` state, and draws their pictures: some five minutes,
    /// each scene within its budget.
    pub(crate) fn report(&self) -> Result<()> {
        self.report_script("Independent solution", "independent.py")?;
        for (title, example) in [
            ("Cost of features that are not used", "left_out"),
            ("Stability of extreme scenes", "stability"),
            ("Error against run time", "precision"),
        ] {
            progress::shown(title, || {
                let mut cargo = self.cargo("run");
                cargo.args([
                    "--release",
                    "--locked",
                    "--no-default-features",
                    "--example",
                    example,
                    "reports",
                ]);
                run_shown(cargo)
            })?;
        }
        self.report_script("Pictures", "plot.py")?;
        eprintln!("Reports: {}", self.workspace.file("reports").display());
        Ok(())
    }

    /// Runs a script of the reports on their folder.
    fn report_script(&self, title: &str, script: &str) -> Result<()> {
        progress::shown(title, || {
            let mut python = self.venv.python();
            python.args([&format!("reports/harness/{script}"), "reports"]);
            python.env("MPLBACKEND", "Agg");
            run_shown(python)
        })
    }

    /// Runs the tests of Rust, and at the same time those of Python, which take one core; their
    /// output follows.
    pub(crate) fn test(&self, fmu: &Path) -> Result<()> {
        let started = Instant::now();
        let mut python_tests = process::command(std::env::current_exe()?);
        python_tests.arg("test-python").arg(fmu);
        let (sender, python_lines) = mpsc::channel();
        // a program of its own, with all its output in one stream
        let python_program = thread::spawn(move || {
            process::run_all_lines(python_tests, |line| {
                // nobody listens any more after a failure, which is reported there
                let _ = sender.send(line.to_owned());
            })
        });

        let mut rust = Totals::default();
        let rust_result = progress::shown("Rust tests", || {
            // without the examples, which `cargo fmu lint` compiles
            let programs = self.rust_tests(&["--lib", "--bins", "--tests"], &mut rust);
            programs.and(self.rust_tests(&["--doc"], &mut rust))
        });
        let mut python = Totals::default();
        for line in python_lines {
            println!("{line}");
            python.add_pytest_line(&line);
        }
        let status =
            python_program.join().map_err(|_| anyhow!("the reader of the Python tests failed"))??;
        python.finish(status.success());

        println!("Rust: {rust}. Python: {python}. Time: {}.", progress::seconds(started.elapsed()));
        rust_result?;
        ensure!(python.passed(), "tests failed: see above");
        Ok(())
    }

    /// Runs the tests of Rust that these arguments of cargo choose.
    fn rust_tests(&self, which: &[&str], totals: &mut Totals) -> Result<()> {
        let mut cargo = self.cargo("test");
        cargo.args(["--workspace", "--locked", "--no-fail-fast"]).args(which);
        let status = process::run_lines(cargo, |line| {
            println!("{line}");
            totals.add_rust_line(line);
        })?;
        totals.finish(status.success());
        ensure!(totals.passed(), "tests failed: see above");
        Ok(())
    }

    /// Runs the tests of Python.
    pub(crate) fn test_python(&self, fmu: &Path) -> Result<()> {
        for extra in EXTRAS {
            self.install_if_possible(extra);
        }
        let rust_master = self.rust_master();
        if let Err(problem) = &rust_master {
            eprintln!("The master in Rust: not tested, since it cannot be built: {problem:#}");
        }
        let mut pytest = self.venv.python();
        let cache = self.workspace.product("pytest");
        pytest.args(["-m", "pytest", "tests/python", "-o"]).arg(format!("cache_dir={}", cache.display()));
        if let Ok(program) = rust_master {
            pytest.env("FRETTING_RUST_MASTER", program);
        }
        // skipped tests are listed by name
        pytest.arg("-rs").env("FRETTING_FMU_BUILD", std::env::current_exe()?);
        pytest.env("FRETTING_FMU", fmu).env("MPLBACKEND", "Agg").env("PYTHONUNBUFFERED", "1");
        progress::shown("Python tests", || run_shown(pytest))
    }

    /// Installs requirements for which not every machine has wheels. Without them the parts that
    /// need them are skipped, with a message. Returns whether they are installed.
    fn install_if_possible(&self, (what, requirements): (&str, &str)) -> bool {
        let installed = Venv::with(self.workspace, &[self.workspace.file(requirements)]);
        if let Err(problem) = &installed {
            eprintln!("{what}: left out, since what it needs cannot be installed: {problem:#}");
        }
        installed.is_ok()
    }

    /// Builds the master in Rust, among the products of the workspace: the tools that its
    /// dependencies need are the same; returns its path.
    fn rust_master(&self) -> Result<PathBuf> {
        let directory = self.workspace.product("");
        progress::shown("Building the master in Rust", || {
            let mut cargo = self.cargo("build");
            cargo.args(["--locked", "--manifest-path", RUST_MASTER, "--target-dir"]).arg(&directory);
            run_shown(cargo)
        })?;
        Ok(directory.join("debug").join(format!("rust-master{}", std::env::consts::EXE_SUFFIX)))
    }

    /// Any other call of cargo, with libclang set up for it.
    pub(crate) fn cargo(&self, subcommand: &str) -> Command {
        let mut cargo = self.workspace.cargo();
        cargo.arg(subcommand).envs(self.environment.iter().map(|(name, value)| (name, value)));
        cargo
    }
}
