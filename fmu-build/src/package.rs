//! The FMU's zip file: which entries it has, and writing them so that equal content gives equal
//! bytes.

use crate::platform::Platform;
use crate::workspace::{MODEL_IDENTIFIER, Workspace, make_folder};
use crate::{documentation, licences, presets, reference, terminals};
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// Entry names and content.
pub(crate) type Entries = BTreeMap<String, Vec<u8>>;

/// Writes the FMU with a library for each platform.
pub(crate) fn write(workspace: &Workspace, libraries: &[(&Platform, PathBuf)], fmu: &Path) -> Result<()> {
    let read = |path: &Path| fs::read(path).with_context(|| format!("cannot read {}", path.display()));
    let description = workspace.file("modelDescription.xml");
    let description =
        fs::read_to_string(&description).with_context(|| format!("cannot read {}", description.display()))?;
    let mut entries = Entries::new();
    let platforms: Vec<_> = libraries.iter().map(|(platform, _)| *platform).collect();
    for (platform, library) in libraries {
        for folder in platform.package_folders(&platforms) {
            let name = format!("binaries/{folder}/{MODEL_IDENTIFIER}.{}", platform.library_extension());
            entries.insert(name, read(library)?);
        }
    }
    entries.insert("documentation/index.html".to_owned(), documentation::page(&description)?.into_bytes());
    for file in ["LICENSE-APACHE", "LICENSE-MIT"] {
        entries.insert(format!("documentation/licenses/{file}"), read(&workspace.file(file))?);
    }
    entries
        .insert("documentation/licenses/third-party.txt".to_owned(), licences::text(workspace)?.into_bytes());
    let icon = read(&workspace.file("fmu-build/assets/model.png"))?;
    entries.insert("terminalsAndIcons/icon.png".to_owned(), icon.clone());
    entries
        .insert("terminalsAndIcons/terminalsAndIcons.xml".to_owned(), terminals::description().into_bytes());
    entries.insert("model.png".to_owned(), icon);
    entries.extend(reference::files(&description)?.into_iter().map(|(name, text)| (name, text.into_bytes())));
    for (name, content) in presets::files(workspace)? {
        entries.insert(format!("{}/{name}", presets::FOLDER), content);
    }
    entries.insert("modelDescription.xml".to_owned(), description.into_bytes());
    write_zip(&entries, fmu)
}

/// Names in order and one date for all: two builds give the same bytes.
pub(crate) fn write_zip(entries: &Entries, path: &Path) -> Result<()> {
    if let Some(parent) = path.parent() {
        make_folder(parent)?;
    }
    let file = File::create(path).with_context(|| format!("cannot write {}", path.display()))?;
    let mut zip = ZipWriter::new(file);
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    for (name, content) in entries {
        zip.start_file(name.as_str(), options)?;
        zip.write_all(content)?;
    }
    zip.finish()?;
    Ok(())
}
