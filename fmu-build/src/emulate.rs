//! Loading and stepping the libraries of an FMU that are for other machines, each under its
//! emulator.

use crate::check::Archive;
use crate::cross::Outcome;
use crate::platform::Platform;
use crate::workspace::{MODEL_IDENTIFIER, Workspace};
use anyhow::{Context, Result};
use std::fs;
use std::path::Path;

/// The outcome for each library of the FMU that is for another machine and has an emulator; an
/// error if a library fails.
pub(crate) fn try_out(workspace: &Workspace, fmu: &Path) -> Result<Vec<(&'static str, Outcome)>> {
    let archive = Archive::open(fmu)?;
    let own = Platform::own()?;
    let description = archive.entry("modelDescription.xml").context("the FMU has no modelDescription.xml")?;
    let description = std::str::from_utf8(&description.bytes)?;
    let mut outcomes = Vec::new();
    for platform in Platform::all().iter().filter(|platform| *platform != own) {
        let name = format!("{MODEL_IDENTIFIER}.{}", platform.library_extension());
        let entry = archive.entry(&format!("binaries/{}/{name}", platform.folder));
        let (Some(route), Some(entry)) = (platform.route, entry) else { continue };
        let folder = workspace.product("cross").join(route.target);
        fs::create_dir_all(&folder)?;
        let library = folder.join(name);
        fs::write(&library, &entry.bytes)?;
        let outcome = route.try_out(workspace, &library, description);
        outcomes.push((
            platform.folder,
            outcome.with_context(|| format!("the library for {}", platform.folder))?,
        ));
    }
    Ok(outcomes)
}

/// One line for each.
pub(crate) fn lines(outcomes: &[(&str, Outcome)]) -> Vec<String> {
    let line = |(folder, outcome): &(&str, Outcome)| match outcome {
        Outcome::Ran(how) => format!("{folder}: {how}"),
        Outcome::NotRun(why) => format!("{folder}: NOT RUN: {why}"),
    };
    outcomes.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_not_run_is_reported() {
        let outcomes = [
            ("win64", Outcome::NotRun("no wine64".to_owned())),
            ("aarch64-linux", Outcome::Ran("ran".to_owned())),
        ];
        assert_eq!(lines(&outcomes), ["win64: NOT RUN: no wine64", "aarch64-linux: ran"]);
    }
}
