//! `cargo fmu merge`: one FMU from several that were built on different machines.

use crate::check::Archive;
use crate::package::{Entries, write_zip};
use anyhow::{Result, bail, ensure};
use std::path::{Path, PathBuf};

/// Joins FMUs of one version into `output`: libraries of all, everything else as in the first.
pub(crate) fn merge(fmus: &[PathBuf], output: &Path) -> Result<()> {
    ensure!(fmus.len() > 1, "merge needs two FMUs or more");
    let archives: Vec<_> = fmus.iter().map(|path| Archive::open(path)).collect::<Result<_>>()?;
    let named: Vec<_> = fmus.iter().map(|path| path.display().to_string()).zip(archives).collect();
    write_zip(&joined(&named)?, output)
}

/// Entries of the archives, each with its name for messages.
fn joined(archives: &[(String, Archive)]) -> Result<Entries> {
    let mut entries = Entries::new();
    for (name, archive) in archives {
        for entry in &archive.entries {
            match entries.get(&entry.name) {
                None => {
                    entries.insert(entry.name.clone(), entry.bytes.clone());
                }
                Some(present) if *present == entry.bytes => {}
                Some(_) if entry.name == "modelDescription.xml" => bail!(
                    "{name} is of another version than {}: their modelDescription.xml differ; build both from one checkout",
                    archives[0].0
                ),
                Some(_) if entry.name.starts_with("binaries/") => {
                    bail!("{name} has another {} than those before it: leave one of them out", entry.name)
                }
                // documentation and the like may differ in dates or line ends
                Some(_) => {}
            }
        }
    }
    Ok(entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Cursor, Write};
    use zip::ZipWriter;
    use zip::write::SimpleFileOptions;

    fn archive(files: &[(&str, &str)]) -> Archive {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, content) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(content.as_bytes()).unwrap();
        }
        Archive::read(zip.finish().unwrap()).unwrap()
    }

    fn of(first: &[(&str, &str)], second: &[(&str, &str)]) -> Result<Entries> {
        joined(&[("one.fmu".to_owned(), archive(first)), ("two.fmu".to_owned(), archive(second))])
    }

    #[test]
    fn libraries_come_together() {
        let first = [("modelDescription.xml", "<m/>"), ("binaries/linux64/a.so", "elf")];
        let second = [("modelDescription.xml", "<m/>"), ("binaries/win64/a.dll", "pe")];
        let names: Vec<_> = of(&first, &second).unwrap().into_keys().collect();
        assert_eq!(names, ["binaries/linux64/a.so", "binaries/win64/a.dll", "modelDescription.xml"]);
    }

    #[test]
    fn other_versions_and_other_libraries_of_a_platform_are_refused() {
        let first = [("modelDescription.xml", "<m/>"), ("binaries/linux64/a.so", "elf")];
        let message = of(&first, &[("modelDescription.xml", "<n/>")]).unwrap_err().to_string();
        assert!(message.contains("two.fmu is of another version than one.fmu"), "{message}");
        let message = of(&first, &[("binaries/linux64/a.so", "other")]).unwrap_err().to_string();
        assert!(message.contains("binaries/linux64/a.so"), "{message}");
        assert!(merge(&["one.fmu".into()], Path::new("x.fmu")).is_err());
    }
}
