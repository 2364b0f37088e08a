//! The commands, each a list of named steps.

use crate::check::{self, Archive};
use crate::libclang::{self, Environment};
use crate::library::OldGlibc;
use crate::platform::Platform;
use crate::process::{self, run_quietly, run_shown};
use crate::progress::Step;
use crate::python::Venv;
use crate::totals::Totals;
use crate::workspace::Workspace;
use crate::{emulate, examples, library, package, presets, progress};
use anyhow::{Context, Result, anyhow, bail, ensure};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
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

/// Where the program is, for the tests of Python.
const RUST_MASTER_VARIABLE: &str = "FRETTING_RUST_MASTER";

/// The tests of Rust without those in documentation, which cargo runs by themselves.
const PROGRAMS: [&str; 3] = ["--lib", "--bins", "--tests"];

/// Runs `python/fretting_contact/profile.py` with these arguments, in the caller's working
/// directory; returns its status. It reports its errors itself.
pub(crate) fn profile(workspace: &Workspace, arguments: &[OsString]) -> Result<ExitCode> {
    let venv = Venv::with(workspace, &[workspace.file(REQUIREMENTS)])?;
    let mut python = venv.python();
    python.args(["-m", "fretting_contact.profile"]).args(arguments);
    python.current_dir(std::env::current_dir()?).env("PYTHONPATH", workspace.file("python"));
    // the matrices are small: threads would only wait for each other
    python.env("OPENBLAS_NUM_THREADS", "1");
    let status = python.status()?;
    Ok(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// What every command works with, set up on first use.
pub(crate) struct Setup<'a> {
    pub(crate) workspace: &'a Workspace,
    /// For every call of cargo that compiles fmi-sys.
    pub(crate) environment: Environment,
}

/// libclang, from a wheel where the system has none. What the Python side needs is installed when
/// it is used.
pub(crate) fn set_up(workspace: &Workspace) -> Result<Setup<'_>> {
    let environment = match libclang::of_system() {
        Some(environment) => environment,
        None => {
            let venv = Venv::with(workspace, &[workspace.file("fmu-build/libclang-requirements.txt")])?;
            libclang::of_wheel(&venv.site_packages()?)?
        }
    };
    Ok(Setup { workspace, environment })
}

impl Setup<'_> {
    /// Python with its packages.
    fn venv(&self) -> Result<Venv<'_>> {
        Venv::with(self.workspace, &[self.workspace.file(REQUIREMENTS)])
    }

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
        let venv = self.venv()?;
        progress::quiet("Checking with `fmpy validate`", |step| {
            let mut fmpy = venv.python();
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
        let venv = self.venv()?;
        self.install_if_possible(PAGE);
        let output = self.workspace.product("demo");
        progress::shown("Running the worked example", || {
            let mut demo = venv.python();
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
        examples::run(examples::all(self.workspace, &self.venv()?, fmu, sweep)?)
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
        let venv = self.venv()?;
        progress::shown(title, || {
            let mut python = venv.python();
            python.args([&format!("reports/harness/{script}"), "reports"]);
            python.env("MPLBACKEND", "Agg");
            run_shown(python)
        })
    }

    /// Builds the FMU for some platforms and runs all tests, with the master in Rust where that is
    /// asked for. On two cores most of the time is compiling, so that nothing waits: the tests of
    /// Rust are compiled beside the library; the tests of Python, which take one core, run beside
    /// those of Rust, and their output follows. What they need is installed meanwhile.
    pub(crate) fn test(&self, platforms: &[&Platform], with_rust_master: bool) -> Result<()> {
        let started = Instant::now();
        let (mut rust, mut python) = (Totals::default(), Totals::default());
        let rust_result = thread::scope(|scope| {
            let (sender, rust_master) = mpsc::channel();
            let compiler = scope.spawn(move || {
                // nobody listens any more where there is no FMU
                let _ = sender.send(with_rust_master.then(|| self.rust_master()));
                // what cannot be compiled is reported where the tests are run
                let _ = run_quietly(&Step::hidden(), self.rust_tests_command(&PROGRAMS, &["--no-run"]));
            });
            let packages = scope.spawn(|| self.install_for_python_tests());
            let fmu = self.build(platforms)?;
            packages.join().map_err(|_| anyhow!("the thread that sets up Python failed"))?;

            let mut python_tests = process::command(std::env::current_exe()?);
            python_tests.arg("test-python").arg(&fmu);
            if let Ok(Some(program)) = rust_master.recv() {
                let program = program.context("the master in Rust cannot be built")?;
                python_tests.env(RUST_MASTER_VARIABLE, program);
            }
            let (sender, python_lines) = mpsc::channel();
            // a program of its own, with all its output in one stream
            let python_program = scope.spawn(move || {
                process::run_all_lines(python_tests, |line| {
                    // nobody listens any more after a failure, which is reported there
                    let _ = sender.send(line.to_owned());
                })
            });
            let compiled = compiler.join();

            let rust_result = progress::shown("Rust tests", || {
                // without the examples, which `cargo fmu lint` compiles
                let programs = self.rust_tests(&PROGRAMS, &mut rust);
                programs.and(self.rust_tests(&["--doc"], &mut rust))
            });
            for line in python_lines {
                println!("{line}");
                python.add_pytest_line(&line);
            }
            let status =
                python_program.join().map_err(|_| anyhow!("the reader of the Python tests failed"))??;
            python.finish(status.success());
            compiled.map_err(|_| anyhow!("the thread that compiles failed"))?;
            anyhow::Ok(rust_result)
        })?;

        println!("Rust: {rust}. Python: {python}. Time: {}.", progress::seconds(started.elapsed()));
        rust_result?;
        ensure!(python.passed(), "tests failed: see above");
        Ok(())
    }

    /// Runs the tests of Rust that these arguments of cargo choose.
    fn rust_tests(&self, which: &[&str], totals: &mut Totals) -> Result<()> {
        let command = self.rust_tests_command(which, &["--no-fail-fast"]);
        let status = process::run_lines(command, |line| {
            println!("{line}");
            totals.add_rust_line(line);
        })?;
        totals.finish(status.success());
        ensure!(totals.passed(), "tests failed: see above");
        Ok(())
    }

    fn rust_tests_command(&self, which: &[&str], options: &[&str]) -> Command {
        let mut cargo = self.cargo("test");
        cargo.args(["--workspace", "--locked"]).args(which).args(options);
        cargo
    }

    /// Runs the tests of Python.
    pub(crate) fn test_python(&self, fmu: &Path) -> Result<()> {
        Archive::open(fmu)?; // else every test reports that it is no FMU
        let venv = self.venv()?;
        for extra in EXTRAS {
            self.install_if_possible(extra);
        }
        let mut pytest = venv.python();
        let cache = self.workspace.product("pytest");
        pytest.args(["-m", "pytest", "tests/python", "-o"]).arg(format!("cache_dir={}", cache.display()));
        // skipped tests are listed by name
        pytest.arg("-rs").env("FRETTING_FMU_BUILD", std::env::current_exe()?);
        pytest.env("FRETTING_FMU", fmu).env("MPLBACKEND", "Agg").env("PYTHONUNBUFFERED", "1");
        progress::shown("Python tests", || run_shown(pytest))
    }

    /// Installs what the tests of Python need, beside other work. What cannot be installed is
    /// reported where it is used.
    fn install_for_python_tests(&self) {
        let files = [REQUIREMENTS].into_iter().chain(EXTRAS.map(|(_, requirements)| requirements));
        for requirements in files {
            let _ = Venv::beside(self.workspace, &[self.workspace.file(requirements)]);
        }
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
        let mut cargo = self.cargo("build");
        cargo.args(["--locked", "--manifest-path", RUST_MASTER, "--target-dir"]).arg(&directory);
        run_quietly(&Step::hidden(), cargo)?;
        Ok(directory.join("debug").join(format!("rust-master{}", std::env::consts::EXE_SUFFIX)))
    }

    /// Any other call of cargo, with libclang set up for it.
    pub(crate) fn cargo(&self, subcommand: &str) -> Command {
        let mut cargo = self.workspace.cargo();
        cargo.arg(subcommand).envs(self.environment.iter().map(|(name, value)| (name, value)));
        cargo
    }
}
