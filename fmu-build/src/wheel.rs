//! `cargo fmu wheel`: the Python package `fretting_contact` with the FMU inside, as a wheel.

use crate::check::Archive;
use crate::process::run_quietly;
use crate::python::Venv;
use crate::workspace::{MODEL_IDENTIFIER, Workspace, make_folder};
use crate::{progress, wheel_tag};
use anyhow::{Context, Result, bail, ensure};
use std::fs;
use std::path::{Path, PathBuf};

/// What the wheel is built with.
const REQUIREMENTS: [&str; 2] = ["tests/python/requirements.txt", "fmu-build/wheel-requirements.txt"];

/// Files of the package beside its modules, and files of the workspace that go with it.
const FILES: [(&str, &str); 5] = [
    ("python/pyproject.toml", "pyproject.toml"),
    ("python/hatch_build.py", "hatch_build.py"),
    ("python/README.md", "README.md"),
    ("LICENSE-MIT", "LICENSE-MIT"),
    ("LICENSE-APACHE", "LICENSE-APACHE"),
];

/// Name of the package and of its folder.
const PACKAGE: &str = "fretting_contact";

/// Environment variable with the wheel's tag, for `hatch_build.py`.
const TAG: &str = "FRETTING_WHEEL_TAG";

/// Builds the wheel with this FMU into a folder; returns the wheel's path.
///
/// The sources are copied to `target/wheel` first, so that the FMU is never among them.
pub(crate) fn build(workspace: &Workspace, fmu: &Path, folder: &Path) -> Result<PathBuf> {
    let tag = wheel_tag::of(&Archive::open(fmu)?)?;
    make_folder(folder)?;
    let venv = Venv::with(workspace, &REQUIREMENTS.map(|file| workspace.file(file)))?;
    let staged = workspace.product("wheel");
    let name = progress::quiet("Building the wheel", |step| {
        stage(workspace, fmu, &staged)?;
        let mut hatchling = venv.python();
        hatchling
            .args(["-m", "hatchling", "build", "-t", "wheel", "-d"])
            .arg(folder)
            .current_dir(&staged)
            .env(TAG, &tag);
        wheel_name(&run_quietly(step, hatchling)?)
    })?;
    let wheel = folder.join(name);
    ensure!(wheel.is_file(), "hatchling has reported {}, but it is not there", wheel.display());
    eprintln!("Wheel for {tag}: {}", wheel.display());
    Ok(wheel)
}

/// Copies the package, the FMU and the licences into an empty folder.
fn stage(workspace: &Workspace, fmu: &Path, folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    let package = folder.join(PACKAGE);
    fs::create_dir_all(&package)?;
    let source = workspace.file("python").join(PACKAGE);
    for entry in fs::read_dir(&source).with_context(|| format!("cannot read {}", source.display()))? {
        let path = entry?.path();
        if path.is_file() && path.extension().is_none_or(|extension| extension != "fmu") {
            fs::copy(&path, package.join(path.file_name().unwrap_or_default()))?;
        }
    }
    fs::copy(fmu, package.join(format!("{MODEL_IDENTIFIER}.fmu")))?;
    for (from, to) in FILES {
        fs::copy(workspace.file(from), folder.join(to)).with_context(|| format!("cannot copy {from}"))?;
    }
    Ok(())
}

/// File name of the wheel in what hatchling has printed: the last line that ends so.
fn wheel_name(output: &str) -> Result<String> {
    let line = output.lines().rev().map(str::trim).find(|line| line.ends_with(".whl"));
    match line.and_then(|line| line.rsplit(['/', '\\']).next()) {
        Some(name) => Ok(name.to_owned()),
        None => bail!("hatchling has not reported a wheel:\n{output}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_the_wheel_is_the_last_one_reported() {
        let name = wheel_name("[wheel]\n../dist/fretting_contact-0.1.0-py3-none-win_amd64.whl\n\n").unwrap();
        assert_eq!(name, "fretting_contact-0.1.0-py3-none-win_amd64.whl");
        assert!(wheel_name("nothing\n").unwrap_err().to_string().contains("has not reported a wheel"));
    }

    #[test]
    fn the_package_is_staged_with_fmu_and_licences_and_without_caches() {
        let workspace = Workspace::of_this_program();
        let folder = std::env::temp_dir().join(format!("fretting-wheel-{}", std::process::id()));
        let fmu = folder.with_extension("fmu");
        fs::write(&fmu, b"an FMU").unwrap();
        stage(&workspace, &fmu, &folder).unwrap();
        assert_eq!(fs::read(folder.join("fretting_contact/FrettingContact.fmu")).unwrap(), b"an FMU");
        for file in
            ["fretting_contact/contact.py", "fretting_contact/py.typed", "LICENSE-MIT", "pyproject.toml"]
        {
            assert!(folder.join(file).is_file(), "{file}");
        }
        assert!(!folder.join("fretting_contact/__pycache__").exists());
        fs::remove_dir_all(folder).unwrap();
        fs::remove_file(fmu).unwrap();
    }

    #[test]
    fn a_missing_fmu_is_an_error_that_says_what_to_do() {
        let problem = build(&Workspace::of_this_program(), Path::new("/no/such.fmu"), Path::new("/tmp"));
        assert!(problem.unwrap_err().to_string().contains("cargo fmu build"));
    }
}
