//! Licences of the crates that are linked into the library.

use crate::library::PACKAGE;
use crate::workspace::Workspace;
use anyhow::{Context, Result, ensure};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

const HEADING: &str = "Parts of the library that others wrote, with their licences.\n\n";

/// The Rust standard library is linked too, but is no package that cargo lists.
const STANDARD_LIBRARY: &str =
    "the Rust standard library: MIT OR Apache-2.0, https://github.com/rust-lang/rust\n";

/// One list of all crates, then each licence text once, with the crates it came with.
pub(crate) fn text(workspace: &Workspace) -> Result<String> {
    let mut list = String::new();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for package in linked_packages(workspace)? {
        let word = |key: &str| package[key].as_str().unwrap_or_default().to_owned();
        let title = format!("{} {}", word("name"), word("version"));
        list += &format!("{title}: {}, {}\n", word("license"), word("repository"));
        let folder = Path::new(package["manifest_path"].as_str().unwrap_or_default()).parent();
        for text in licence_files(folder.context("a package has no manifest")?)? {
            texts.entry(text).or_default().push(title.clone());
        }
    }
    let mut result = format!("{HEADING}{list}{STANDARD_LIBRARY}");
    for (text, titles) in texts {
        result += &format!("\n{}\n{}:\n\n{}\n", "-".repeat(100), titles.join(", "), text.trim_end());
    }
    Ok(result)
}

/// What cargo reports of each package that is linked into the library, ordered by name and version.
fn linked_packages(workspace: &Workspace) -> Result<Vec<Value>> {
    let mut tree = workspace.cargo();
    tree.args(["tree", "--locked", "--package", PACKAGE, "--edges", "normal,no-proc-macro"]);
    tree.args(["--prefix", "none", "--no-dedupe", "--format", "{p}"]);
    let tree = stdout(tree)?;
    let mut metadata = workspace.cargo();
    metadata.args(["metadata", "--locked", "--format-version", "1"]);
    let metadata: Value = serde_json::from_str(&stdout(metadata)?)?;
    let packages = metadata["packages"].as_array().context("cargo metadata lists no packages")?;
    let mut linked: Vec<Value> = packages
        .iter()
        .filter(|package| package["name"] != PACKAGE && is_in(&tree, package))
        .cloned()
        .collect();
    linked.sort_by_key(|package| (package["name"].to_string(), package["version"].to_string()));
    Ok(linked)
}

/// Whether a line of the tree, such as `libc v0.2.1`, is the package.
fn is_in(tree: &str, package: &Value) -> bool {
    let name = package["name"].as_str().unwrap_or_default();
    let version = format!("v{}", package["version"].as_str().unwrap_or_default());
    tree.lines().any(|line| {
        let mut words = line.split(' ');
        words.next() == Some(name) && words.next() == Some(&version)
    })
}

/// The texts of a package's licence files.
fn licence_files(folder: &Path) -> Result<Vec<String>> {
    let mut texts = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        let is_licence = ["LICENSE", "LICENCE", "COPYING", "COPYRIGHT", "NOTICE"]
            .iter()
            .any(|start| name.starts_with(start));
        if is_licence && path.is_file() {
            texts.push(fs::read_to_string(&path)?.replace("\r\n", "\n"));
        }
    }
    Ok(texts)
}

fn stdout(mut cargo: Command) -> Result<String> {
    let output = cargo.output().context("cannot start cargo")?;
    ensure!(output.status.success(), "cargo failed: {}", String::from_utf8_lossy(&output.stderr));
    Ok(String::from_utf8(output.stdout)?)
}
