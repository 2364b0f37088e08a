//! The FMU as a zip archive (FMI 2.0.5, section 2.3): what may be in it and how it is stored.

use crate::platform;
use anyhow::{Context, Result, ensure};
use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;
use zip::{CompressionMethod, ZipArchive};

/// Unix file type bits of a symbolic link, and the mask for them.
const LINK: u32 = 0o120_000;
const TYPE_MASK: u32 = 0o170_000;

/// Folders the standard names at the top level.
const FOLDERS: [&str; 6] =
    ["binaries", "documentation", "extra", "resources", "sources", "terminalsAndIcons"];

/// One entry as it is stored.
pub(crate) struct Entry {
    pub(crate) name: String,
    pub(crate) bytes: Vec<u8>,
    method: CompressionMethod,
    encrypted: bool,
    link: bool,
}

/// A packaged FMU, read whole.
pub(crate) struct Archive {
    pub(crate) entries: Vec<Entry>,
}

impl Archive {
    /// Reads an FMU from a file.
    pub(crate) fn open(path: &Path) -> Result<Self> {
        ensure!(
            path.is_file(),
            "there is no FMU at {}: give the path of one, or run `cargo fmu build`",
            path.display()
        );
        let file = File::open(path).with_context(|| format!("cannot open {}", path.display()))?;
        Self::read(file).with_context(|| format!("{} is not a zip archive that can be read", path.display()))
    }

    /// Reads an FMU; the content of an entry that cannot be unpacked stays empty.
    pub(crate) fn read(source: impl Read + Seek) -> Result<Self> {
        let mut zip = ZipArchive::new(source)?;
        let mut entries = Vec::with_capacity(zip.len());
        for index in 0..zip.len() {
            let raw = zip.by_index_raw(index)?;
            let mut entry = Entry {
                name: String::from_utf8_lossy(raw.name_raw()).into_owned(),
                bytes: Vec::new(),
                method: raw.compression(),
                encrypted: raw.encrypted(),
                link: raw.unix_mode().is_some_and(|mode| mode & TYPE_MASK == LINK),
            };
            drop(raw);
            if entry.is_stored_well() && !entry.encrypted {
                zip.by_index(index)?.read_to_end(&mut entry.bytes)?;
            }
            entries.push(entry);
        }
        Ok(Self { entries })
    }

    /// The entry of this name.
    pub(crate) fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// The libraries: folder under `binaries/`, file name, entry.
    pub(crate) fn libraries(&self) -> impl Iterator<Item = (&str, &str, &Entry)> {
        self.entries.iter().filter_map(|entry| {
            let (folder, file) = entry.name.strip_prefix("binaries/")?.split_once('/')?;
            (!file.is_empty()).then_some((folder, file, entry))
        })
    }
}

impl Entry {
    fn is_stored_well(&self) -> bool {
        matches!(self.method, CompressionMethod::Stored | CompressionMethod::Deflated)
    }

    fn is_expected(&self) -> bool {
        let top_file = self.name == "modelDescription.xml" || self.name == "model.png";
        top_file || self.name.split_once('/').is_some_and(|(folder, _)| FOLDERS.contains(&folder))
    }

    fn problem(&self) -> Option<String> {
        let name = &self.name;
        let steps_outside = name.starts_with('/') || name.split('/').any(|part| part == "..");
        if name.contains('\\') {
            Some(format!("zip entry {name:?} has a backslash in its name: use / between folders"))
        } else if steps_outside {
            Some(format!("zip entry {name:?} leads outside the archive: use a path relative to its top"))
        } else if self.link {
            Some(format!("zip entry {name:?} is a symbolic link: store the file itself"))
        } else if !self.is_stored_well() {
            Some(format!(
                "zip entry {name:?} is packed with {}: only stored and deflated may be used",
                self.method
            ))
        } else if self.encrypted {
            Some(format!("zip entry {name:?} is encrypted: store it openly"))
        } else if !self.is_expected() {
            Some(format!(
                "zip entry {name:?} has no place in an FMU: move it to documentation/ or resources/"
            ))
        } else {
            None
        }
    }
}

/// What is wrong with the entries of the archive.
pub(super) fn problems(archive: &Archive) -> Vec<String> {
    let mut problems: Vec<String> = archive.entries.iter().filter_map(Entry::problem).collect();
    for required in ["modelDescription.xml", "documentation/index.html", "model.png"] {
        if archive.entry(required).is_none() {
            problems.push(format!("zip entry \"{required}\" is missing: put it there"));
        }
    }
    for (folder, _, _) in archive.libraries() {
        if !platform::is_folder(folder) {
            problems.push(format!("binaries/{folder} is not a platform folder of FMI 2.0"));
        }
    }
    if archive.libraries().next().is_none() {
        problems.push("there is no library under binaries/<platform>/: add one".to_owned());
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{self, LIBRARY_ENTRY};

    #[test]
    fn backslashes_are_refused() {
        let fixture = fixture::good().with_file("resources\\notes.txt", b"x");
        fixture.assert_refused(&["backslash", "resources"]);
    }

    #[test]
    fn paths_that_lead_outside_are_refused() {
        let fixture = fixture::good().with_file("resources/../../notes.txt", b"x");
        fixture.assert_refused(&["leads outside", "notes.txt"]);
    }

    #[test]
    fn links_are_refused() {
        let fixture = fixture::good().with_link("resources/link", "model.png");
        fixture.assert_refused(&["symbolic link", "resources/link"]);
    }

    #[test]
    fn other_packing_is_refused() {
        // Marks every entry as packed with method 12 (bzip2); so the description cannot be read
        // either.
        let mut bytes = fixture::good().bytes();
        for at in 0..bytes.len() - 12 {
            match &bytes[at..at + 4] {
                b"PK\x03\x04" => bytes[at + 8] = 12,
                b"PK\x01\x02" => bytes[at + 10] = 12,
                _ => {}
            }
        }
        let archive = super::Archive::read(std::io::Cursor::new(bytes)).unwrap();
        let found = super::problems(&archive);
        assert_eq!(found.len(), archive.entries.len(), "{found:?}");
        assert!(found.iter().all(|problem| problem.contains("only stored and deflated")), "{found:?}");
    }

    #[test]
    fn unknown_files_at_the_top_are_refused() {
        fixture::good().with_file("notes.txt", b"x").assert_refused(&["notes.txt", "no place"]);
    }

    #[test]
    fn missing_entries_are_named() {
        fixture::good()
            .without_file("documentation/index.html")
            .assert_refused(&["documentation/index.html"]);
        fixture::good().without_file("model.png").assert_refused(&["model.png"]);
        fixture::good().without_file(LIBRARY_ENTRY).assert_refused(&["no library"]);
    }

    #[test]
    fn unknown_platform_folders_are_refused() {
        let good = fixture::good().read();
        let library = &good.entry(LIBRARY_ENTRY).unwrap().bytes;
        let fixture = fixture::good().with_file("binaries/linux/FrettingContact.so", library);
        fixture.assert_refused(&["binaries/linux ", "platform folder"]);
    }
}
