//! Where things are: the workspace, its products under `target/`, and cargo itself.

use crate::process;
use anyhow::{Result, anyhow};
use std::path::{Path, PathBuf};
use std::process::Command;

/// modelIdentifier of the FMU: names the file, the library in it and the C functions' owner.
pub(crate) const MODEL_IDENTIFIER: &str = "FrettingContact";

/// Makes a folder and those above it, unless they are there.
pub(crate) fn make_folder(path: &Path) -> Result<()> {
    std::fs::create_dir_all(path)
        .map_err(|reason| anyhow!("cannot make the folder {} ({reason}): give another path", path.display()))
}

/// The checkout this program belongs to.
pub(crate) struct Workspace {
    root: PathBuf,
}

impl Workspace {
    /// The checkout of the running `cargo fmu`.
    pub(crate) fn of_this_program() -> Self {
        // Set by `cargo run`; the compiled-in value serves a program that is started by hand.
        let manifest = std::env::var_os("CARGO_MANIFEST_DIR")
            .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
        Self { root: manifest.parent().map_or(manifest.clone(), Path::to_path_buf) }
    }

    /// A file of the checkout.
    pub(crate) fn file(&self, path: &str) -> PathBuf {
        self.root.join(path)
    }

    /// A product: always under the checkout's own `target/`, wherever cargo keeps its artefacts.
    pub(crate) fn product(&self, path: &str) -> PathBuf {
        self.root.join("target").join(path)
    }

    /// The packaged FMU.
    pub(crate) fn fmu(&self) -> PathBuf {
        self.product("fmu").join(format!("{MODEL_IDENTIFIER}.fmu"))
    }

    /// A program that runs in the workspace root.
    pub(crate) fn command(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = process::command(program);
        command.current_dir(&self.root);
        command
    }

    /// The cargo that started this program.
    pub(crate) fn cargo(&self) -> Command {
        self.command(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
    }

    /// The checkout's root.
    pub(crate) fn root(&self) -> &Path {
        &self.root
    }
}
