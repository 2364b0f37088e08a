//! Building the shared library: one call of cargo, with the paths of this machine left out of the
//! binary.

use crate::check::newest_glibc;
use crate::libclang::{self, Environment};
use crate::platform::Platform;
use crate::process::run_lines;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The crate that the library is made from.
pub(crate) const PACKAGE: &str = "fretting_contact";

/// Builds the library for a platform in release mode without debug information; returns its path.
/// `old` builds it for an old glibc, if the platform is one of Linux.
pub(crate) fn build(
    workspace: &Workspace,
    environment: &Environment,
    platform: &Platform,
    old: Option<&OldGlibc<'_>>,
) -> Result<PathBuf> {
    let own = platform == Platform::own()?;
    let old = old.filter(|_| platform.is_linux());
    let mut cargo = match old {
        Some(old) => old.cargo(workspace, platform, own)?,
        None => workspace.cargo(),
    };
    // As a cdylib alone: together with an rlib cargo would skip link-time optimisation.
    cargo.args(["rustc", "--release", "--locked", "--package", PACKAGE, "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--message-format", "json-render-diagnostics"]);
    cargo.args(["--config", "profile.release.strip=\"debuginfo\""]);
    cargo.args(["--config", &remap_paths(workspace)?]);
    cargo.envs(environment.iter().map(|(name, value)| (name, value)));
    if let Some(old) = old {
        cargo.args(["--target", &format!("{}.{}", platform.target, old.version)]);
    } else if !own {
        let route = platform.route.context("there is no way to build for this platform here")?;
        cargo.args(["--target", route.target]).envs(route.environment()?);
    }

    let mut library = None;
    let extension = platform.library_extension();
    let status = run_lines(cargo, |line| library = library_of(line, extension).or(library.take()))?;
    if !status.success() {
        bail!("cargo could not build the library {PACKAGE}: correct the errors that it reports above");
    }
    let library =
        library.context("cargo built no shared library: the package must have the crate type cdylib")?;
    old.map_or(Ok(()), |old| old.check(&library))?;
    Ok(library)
}

/// A build that runs on Linux systems with a glibc as old as this: linked by zig, which has all of
/// them.
pub(crate) struct OldGlibc<'a> {
    /// Such as 2.17.
    pub(crate) version: &'a str,
    /// Folder with cargo-zigbuild, and the Python that has zig.
    pub(crate) programs: PathBuf,
}

impl OldGlibc<'_> {
    /// Major and minor number of a version.
    pub(crate) fn numbers(version: &str) -> Result<(u32, u32)> {
        let numbers = version.split_once('.').map(|(major, minor)| (major.parse(), minor.parse()));
        match numbers {
            Some((Ok(major), Ok(minor))) => Ok((major, minor)),
            _ => bail!("--glibc: `{version}` is not a version such as 2.17"),
        }
    }

    /// cargo with zig as linker; `own` states whether the platform is that of this machine.
    fn cargo(&self, workspace: &Workspace, platform: &Platform, own: bool) -> Result<Command> {
        let mut cargo = workspace.command(self.programs.join("cargo-zigbuild"));
        let path = std::env::var_os("PATH").unwrap_or_default();
        let paths = std::iter::once(self.programs.clone()).chain(std::env::split_paths(&path));
        cargo.env("PATH", std::env::join_paths(paths)?);
        // otherwise bindgen would look for the C headers where zig has none
        let clang = match platform.route {
            Some(route) if !own => route.clang_arguments()?,
            _ => {
                let architecture = platform.target.split('-').next().unwrap_or_default();
                let headers = libclang::header_directory()?;
                format!("-I{headers} -I/usr/include -I/usr/include/{architecture}-linux-gnu")
            }
        };
        cargo.env(format!("BINDGEN_EXTRA_CLANG_ARGS_{}", platform.target), clang);
        Ok(cargo)
    }

    /// Whether the library asks for nothing newer.
    fn check(&self, library: &Path) -> Result<()> {
        let newest = newest_glibc(&std::fs::read(library)?);
        let allowed = Self::numbers(self.version)?;
        match newest {
            Some((major, minor)) if (major, minor) > allowed => {
                bail!("the library asks for glibc {major}.{minor}, which is newer than {}", self.version)
            }
            _ => Ok(()),
        }
    }
}

/// The library's path, if a message of cargo names it.
fn library_of(message: &str, extension: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(message).ok()?;
    if message["reason"] != "compiler-artifact" || message["target"]["name"] != PACKAGE {
        return None;
    }
    let files = message["filenames"].as_array()?;
    let mut paths = files.iter().filter_map(Value::as_str).map(PathBuf::from);
    paths.find(|path| path.extension().is_some_and(|found| found == extension))
}

/// A cargo setting that replaces this machine's directories in panic messages, so that the bytes of
/// the library do not depend on where it is built.
fn remap_paths(workspace: &Workspace) -> Result<String> {
    let cargo_home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(std::env::home_dir()?.join(".cargo")))
        .context("the home directory is unknown: set CARGO_HOME")?;
    let mut directories = vec![(cargo_home, "/cargo"), (workspace.root().to_path_buf(), "/fretting_contact")];
    if let Some(target) = std::env::var_os("CARGO_TARGET_DIR") {
        directories.push((workspace.root().join(target), "/fretting_contact/target"));
    }
    let flags: Vec<Value> = directories
        .into_iter()
        .map(|(from, to)| format!("--remap-path-prefix={}={to}", from.display()).into())
        .collect();
    // A list of strings in JSON is one in TOML, too.
    Ok(format!("build.rustflags={}", Value::from(flags)))
}

#[cfg(test)]
mod tests {
    use super::{OldGlibc, library_of};

    #[test]
    fn versions_are_two_numbers() {
        assert_eq!(OldGlibc::numbers("2.17").unwrap(), (2, 17));
        for wrong in ["2", "2.x", "", "new"] {
            assert!(OldGlibc::numbers(wrong).unwrap_err().to_string().contains("such as 2.17"));
        }
    }

    #[test]
    fn the_library_is_found_among_the_messages() {
        let message = |reason: &str, name: &str| {
            format!(
                r#"{{"reason":"{reason}","target":{{"name":"{name}"}},"filenames":["/t/l.rlib","/t/l.dll.a","/t/l.dll"]}}"#
            )
        };
        let found = library_of(&message("compiler-artifact", "fretting_contact"), "dll");
        assert_eq!(found, Some("/t/l.dll".into()));
        assert_eq!(library_of(&message("compiler-artifact", "fretting_contact"), "so"), None);
        assert_eq!(library_of(&message("compiler-artifact", "libc"), "dll"), None);
        assert_eq!(library_of(&message("build-script-executed", "fretting_contact"), "dll"), None);
        assert_eq!(library_of("not JSON", "dll"), None);
    }
}
