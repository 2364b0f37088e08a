//! Building the shared library: one call of cargo, with the paths of this machine left out of the binary.

use crate::libclang::Environment;
use crate::platform::Platform;
use crate::process::run_lines;
use crate::workspace::Workspace;
use anyhow::{Context, Result, bail};
use serde_json::Value;
use std::path::PathBuf;

/// The crate that the library is made from.
pub(crate) const PACKAGE: &str = "fretting_contact";

/// Builds the library for a platform in release mode without debug information; returns its path.
pub(crate) fn build(
    workspace: &Workspace,
    environment: &Environment,
    platform: &Platform,
) -> Result<PathBuf> {
    let mut cargo = workspace.cargo();
    // As a cdylib alone: beside an rlib cargo would leave link-time optimisation out.
    cargo.args(["rustc", "--release", "--locked", "--package", PACKAGE, "--lib", "--crate-type", "cdylib"]);
    cargo.args(["--message-format", "json-render-diagnostics"]);
    cargo.args(["--config", "profile.release.strip=\"debuginfo\""]);
    cargo.args(["--config", &remap_paths(workspace)?]);
    cargo.envs(environment.iter().map(|(name, value)| (name, value)));
    if platform != Platform::own()? {
        let route = platform.route.context("there is no way to build for this platform here")?;
        cargo.args(["--target", route.target]).envs(route.environment()?);
    }

    let mut library = None;
    let extension = platform.library_extension();
    let status = run_lines(cargo, |line| library = library_of(line, extension).or(library.take()))?;
    if !status.success() {
        bail!("cargo could not build the library {PACKAGE}: mend what it says above");
    }
    library.context("cargo built no shared library: the package must have the crate type cdylib")
}

/// The library's path, if the message of cargo tells of it.
fn library_of(message: &str, extension: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(message).ok()?;
    if message["reason"] != "compiler-artifact" || message["target"]["name"] != PACKAGE {
        return None;
    }
    let files = message["filenames"].as_array()?;
    let mut paths = files.iter().filter_map(Value::as_str).map(PathBuf::from);
    paths.find(|path| path.extension().is_some_and(|found| found == extension))
}

/// A cargo setting that replaces this machine's directories in panic messages, so that the bytes of the library
/// do not depend on where it is built.
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
    use super::library_of;

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
