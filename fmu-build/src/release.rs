//! `cargo fmu release`: what is published, under `target/dist`: the FMU for three platforms, the
//! Python package with this FMU, reference results, presets, notes and checksums.

use crate::commands::Setup;
use crate::platform::Platform;
use crate::workspace::{MODEL_IDENTIFIER, Workspace};
use crate::{emulate, presets, progress, smoke_test, wheel};
use anyhow::{Context, Result};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

/// Platform folders of the FMU.
const PLATFORMS: [&str; 3] = ["linux64", "win64", "aarch64-linux"];

/// Oldest glibc of its Linux libraries: that of manylinux2014, such as CentOS 7.
const GLIBC: &str = "2.17";

/// File of the checksums, in the format of `sha256sum`.
const CHECKSUMS: &str = "SHA256SUMS";

/// Builds the FMU for all platforms and writes the folder again.
pub(crate) fn run(setup: &Setup<'_>) -> Result<()> {
    let workspace = setup.workspace;
    let platforms = Platform::requested(&PLATFORMS.map(str::to_owned))?;
    let fmu = setup.build_for_glibc(&platforms, GLIBC)?;
    let folder = workspace.product("dist");
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    fs::create_dir_all(&folder)?;
    let wheel = wheel::build(workspace, &fmu, &folder)?;
    let wheel = wheel.file_name().context("the wheel has no name")?.to_string_lossy();
    progress::quiet("Writing target/dist", |_| {
        fs::copy(&fmu, folder.join(fmu.file_name().context("the FMU has no name")?))?;
        presets::copy(workspace, &folder)?;
        let description = fs::read_to_string(workspace.file("modelDescription.xml"))?;
        smoke_test::write_cross_check(&folder, MODEL_IDENTIFIER, &description)?;
        let tried = emulate::lines(&emulate::try_out(workspace, &fmu)?);
        fs::write(folder.join("NOTES.md"), notes(&changes(workspace)?, &wheel, &tried))?;
        let sums = checksums(&folder)?;
        fs::write(folder.join(CHECKSUMS), sums)?;
        Ok(())
    })?;
    for path in files(&folder)? {
        let size = fs::metadata(folder.join(&path))?.len();
        println!("{size:>9} {}", path.display());
    }
    println!("Release: {}", folder.display());
    Ok(())
}

/// The part of CHANGELOG.md on the latest version, without its heading.
fn changes(workspace: &Workspace) -> Result<String> {
    let path = workspace.file("CHANGELOG.md");
    let text = fs::read_to_string(&path).with_context(|| format!("cannot read {}", path.display()))?;
    Ok(first_part(&text).to_owned())
}

/// What stands between the first heading of the second level and the next one.
fn first_part(changelog: &str) -> &str {
    let part = changelog.split("\n## ").nth(1).unwrap_or_default();
    part.split_once('\n').map_or("", |(_, text)| text).trim()
}

/// NOTES.md; `wheel` is the file name of the Python package, and `tried` has a line for each
/// library that was run under an emulator, or not.
fn notes(changes: &str, wheel: &str, tried: &[String]) -> String {
    let mut notes = format!("# FrettingContact {}\n\n", env!("CARGO_PKG_VERSION"));
    let _ = write!(
        notes,
        "FMI 2.0 co-simulation FMU for {}. The Linux libraries need glibc {GLIBC} or later; nothing \
         else has to be installed. `{wheel}` is the Python package with this FMU inside: \
         `pip install {wheel}`. `presets/` has parameters of pairs of materials (SSV files), which are \
         also inside the FMU. `{MODEL_IDENTIFIER}_in.csv`, `_ref.csv` and `_ref.opt` are inputs, \
         results and options of the default experiment, to test an importer. To check the files: \
         `sha256sum --check {CHECKSUMS}`.\n\n",
        PLATFORMS.join(", ")
    );
    for line in tried {
        let _ = writeln!(notes, "- {line}");
    }
    let _ = write!(notes, "\n## Changes\n\n{changes}\n");
    notes
}

/// A line for each file of the folder: SHA-256 and path.
fn checksums(folder: &Path) -> Result<String> {
    let mut lines = String::new();
    for path in files(folder)? {
        let sum = Sha256::digest(fs::read(folder.join(&path))?);
        for byte in sum {
            let _ = write!(lines, "{byte:02x}");
        }
        let _ = writeln!(lines, "  {}", path.to_string_lossy().replace('\\', "/"));
    }
    Ok(lines)
}

/// Files of a folder and of those in it, relative to it, in order of their names.
fn files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.strip_prefix(folder)?.to_path_buf();
        if path.is_dir() {
            files.extend(self::files(&path)?.into_iter().map(|file| name.join(file)));
        } else {
            files.push(name);
        }
    }
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_changes_are_those_of_the_latest_version() {
        let text = "# Changelog\n\n## 0.2.0\n\n- new\n- more\n\n## 0.1.0\n\n- old\n";
        assert_eq!(first_part(text), "- new\n- more");
        assert_eq!(first_part("# Changelog\n"), "");
        assert!(changes(&Workspace::of_this_program()).unwrap().contains("slip_state_value"));
    }

    #[test]
    fn notes_have_version_platforms_trials_and_changes() {
        let notes = notes("- new", "contact.whl", &["win64: loaded and stepped".to_owned()]);
        let version = env!("CARGO_PKG_VERSION");
        let expected = [version, "linux64, win64", "glibc 2.17", "- win64: loaded", "- new"];
        for words in expected.into_iter().chain(["pip install contact.whl", "FrettingContact_in.csv"]) {
            assert!(notes.contains(words), "{words}: {notes}");
        }
    }

    #[test]
    fn checksums_are_those_of_sha256sum() {
        let folder = std::env::temp_dir().join(format!("fmu-build-release-{}", std::process::id()));
        fs::create_dir_all(folder.join("b")).unwrap();
        fs::write(folder.join("c"), "abc").unwrap();
        fs::write(folder.join("b/a"), "").unwrap();
        let sums = checksums(&folder).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        // FIPS 180-2, and of no bytes
        let expected = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855  b/a\n\
                        ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  c\n";
        assert_eq!(sums, expected);
    }
}
