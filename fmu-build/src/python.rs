//! The virtual environment under `target/venv`, with pinned requirements.

use crate::process::{capture, run_quietly};
use crate::progress::{self, Step};
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};

/// Oldest Python that the pinned fmpy accepts.
const OLDEST_PYTHON: (u32, u32) = (3, 10);

/// Names under which a Python may be found, the usual ones first.
const PYTHON_NAMES: [&str; 7] =
    ["python3", "python", "python3.14", "python3.13", "python3.12", "python3.11", "python3.10"];

/// Held while packages are looked for and installed: threads do it beside each other.
static INSTALLING: Mutex<()> = Mutex::new(());

/// A virtual environment.
pub(crate) struct Venv<'a> {
    workspace: &'a Workspace,
    directory: PathBuf,
}

impl<'a> Venv<'a> {
    /// The environment with everything of the requirements files in it; does nothing if it is up to
    /// date.
    pub(crate) fn with(workspace: &'a Workspace, requirements: &[PathBuf]) -> Result<Self> {
        Self::set_up(workspace, requirements, |install| {
            progress::quiet("Setting up Python under target/venv", install)
        })
    }

    /// The same beside another step, which is shown.
    pub(crate) fn beside(workspace: &'a Workspace, requirements: &[PathBuf]) -> Result<Self> {
        Self::set_up(workspace, requirements, |install| install(&Step::hidden()))
    }

    fn set_up(
        workspace: &'a Workspace,
        requirements: &[PathBuf],
        run: impl FnOnce(&dyn Fn(&Step) -> Result<()>) -> Result<()>,
    ) -> Result<Self> {
        let _guard = INSTALLING.lock().unwrap_or_else(PoisonError::into_inner);
        let venv = Self { workspace, directory: workspace.product("venv") };
        let mut wanted = Vec::new();
        for file in requirements {
            let text = fs::read_to_string(file).with_context(|| format!("cannot read {}", file.display()))?;
            wanted.push((file, text));
        }
        let works = venv.runs(&["-c", ""]);
        if works && wanted.iter().all(|(file, text)| venv.has_installed(file, text)) {
            venv.link_package()?;
            return Ok(venv);
        }
        run(&|step| {
            if !works || !venv.runs(&["-m", "pip", "--version"]) {
                venv.create(step)?;
            }
            for (file, text) in &wanted {
                if !venv.has_installed(file, text) {
                    venv.install(step, file)?;
                    fs::write(venv.stamp(file), text)?;
                }
            }
            Ok(())
        })?;
        venv.link_package()?;
        Ok(venv)
    }

    /// Lets the environment find the package in the checkout's folder `python`.
    fn link_package(&self) -> Result<()> {
        let link = self.site_packages()?.join("fretting_contact_checkout.pth");
        let folder = format!("{}\n", self.workspace.file("python").display());
        if !fs::read_to_string(&link).is_ok_and(|found| found == folder) {
            fs::write(&link, folder).with_context(|| format!("cannot write {}", link.display()))?;
        }
        Ok(())
    }

    /// The environment's Python, to be run in the workspace root.
    pub(crate) fn python(&self) -> Command {
        let mut command = self.workspace.command(self.interpreter());
        command.env("VIRTUAL_ENV", &self.directory).env_remove("PYTHONHOME");
        // pip compiles nothing: what is imported is compiled once
        command.env("PYTHONPYCACHEPREFIX", self.workspace.product("pycache"));
        command.env_remove("PYTHONDONTWRITEBYTECODE");
        command
    }

    /// The folder of its programs.
    pub(crate) fn programs(&self) -> PathBuf {
        self.directory.join(if cfg!(windows) { "Scripts" } else { "bin" })
    }

    /// The folder that packages are installed in.
    pub(crate) fn site_packages(&self) -> Result<PathBuf> {
        let mut python = self.python();
        python.args(["-c", "import sysconfig; print(sysconfig.get_paths()['purelib'])"]);
        let output = python.output().context("cannot run the Python of target/venv")?;
        Ok(PathBuf::from(String::from_utf8_lossy(&output.stdout).trim()))
    }

    fn interpreter(&self) -> PathBuf {
        self.directory.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
    }

    /// A copy of the requirements file that was installed last.
    fn stamp(&self, requirements: &Path) -> PathBuf {
        self.directory.join("installed").join(requirements.file_name().unwrap_or_default())
    }

    fn has_installed(&self, requirements: &Path, text: &str) -> bool {
        fs::read_to_string(self.stamp(requirements)).is_ok_and(|installed| installed == text)
    }

    fn runs(&self, arguments: &[&str]) -> bool {
        self.python().args(arguments).output().is_ok_and(|output| output.status.success())
    }

    /// Makes a new environment, without packages.
    fn create(&self, step: &Step) -> Result<()> {
        if self.directory.exists() {
            fs::remove_dir_all(&self.directory)?;
        }
        let python = find_python()?;
        // Debian keeps ensurepip, which `venv` needs, in a package of its own; virtualenv brings
        // its own pip.
        for module in ["venv", "virtualenv"] {
            let mut make = self.workspace.command(python);
            make.args(["-m", module]).arg(&self.directory);
            let (status, _) = capture(step, make)?;
            if status.success() {
                fs::create_dir_all(self.directory.join("installed"))?;
                return Ok(());
            }
            if self.directory.exists() {
                fs::remove_dir_all(&self.directory)?;
            }
        }
        bail!(
            "{python} cannot make a virtual environment: install its venv module (Debian, Ubuntu: `apt install python3-venv`)"
        )
    }

    fn install(&self, step: &Step, requirements: &Path) -> Result<()> {
        let mut pip = self.python();
        pip.args(["-m", "pip", "install", "--no-input", "--no-compile", "--disable-pip-version-check"]);
        pip.arg("-r").arg(requirements);
        run_quietly(step, pip)?;
        Ok(())
    }
}

/// The first Python on the path that is new enough.
fn find_python() -> Result<&'static str> {
    let mut too_old = None;
    for name in PYTHON_NAMES {
        match python_version(name) {
            Some(version) if version >= OLDEST_PYTHON => return Ok(name),
            Some(version) => too_old = Some((name, version)),
            None => {}
        }
    }
    let (major, minor) = OLDEST_PYTHON;
    let found = too_old.map_or("none was found".to_owned(), |(name, (x, y))| format!("{name} is {x}.{y}"));
    bail!(
        "Python {major}.{minor} or newer is needed, but {found}: install it (Debian, Ubuntu: `apt install python3 python3-venv`)"
    )
}

fn python_version(name: &str) -> Option<(u32, u32)> {
    let output = crate::process::command(name)
        .args(["-c", "import sys; print(*sys.version_info[:2])"])
        .output()
        .ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let mut numbers = text.split_whitespace().map(str::parse);
    Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
}
