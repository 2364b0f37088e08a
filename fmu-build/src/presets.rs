//! Parameters of pairs of materials: the files `presets/*.ssv` (SSP 1.0 parameter values), which go
//! into the FMU and beside it. The sources of the numbers are in the files.

use crate::workspace::Workspace;
use anyhow::{Context, Result, ensure};
use std::fs;
use std::path::Path;

/// Where the files go in the FMU.
pub(crate) const FOLDER: &str = "resources/presets";

/// Names and content, in order of the names.
pub(crate) fn files(workspace: &Workspace) -> Result<Vec<(String, Vec<u8>)>> {
    let folder = workspace.file("presets");
    let mut files = Vec::new();
    for entry in fs::read_dir(&folder).with_context(|| format!("cannot read {}", folder.display()))? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "ssv") {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            files.push((name, fs::read(&path)?));
        }
    }
    ensure!(!files.is_empty(), "{} has no presets (*.ssv)", folder.display());
    files.sort();
    Ok(files)
}

/// Copies the files into the folder `presets` of `target`.
pub(crate) fn copy(workspace: &Workspace, target: &Path) -> Result<()> {
    let folder = target.join("presets");
    fs::create_dir_all(&folder)?;
    for (name, content) in files(workspace)? {
        let path = folder.join(name);
        fs::write(&path, content).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use roxmltree::Document;

    #[test]
    fn each_preset_gives_the_source_of_each_value() {
        let files = files(&Workspace::of_this_program()).unwrap();
        let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["gold.ssv", "steel_52100.ssv", "ti_6al_4v.ssv"]);
        for (name, content) in &files {
            let document = Document::parse(std::str::from_utf8(content).unwrap()).unwrap();
            assert_eq!(document.root_element().attribute("name"), name.strip_suffix(".ssv"));
            for parameter in document.descendants().filter(|node| node.has_tag_name("Parameter")) {
                let source = parameter.attribute("description").unwrap_or_default();
                assert!(source.len() > 10, "{name}: {:?} has no source", parameter.attribute("name"));
            }
        }
    }
}
