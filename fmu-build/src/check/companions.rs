//! Files beside modelDescription.xml that refer to its variables or to each other: terminals, and
//! reference results.

use super::{Archive, variables};
use roxmltree::{Document, Node};

const TERMINALS: &str = "terminalsAndIcons/terminalsAndIcons.xml";
const EXTRA: &str = "extra/";
const MANIFEST: &str = "/fmi-ls-manifest.xml";

/// What is wrong with them. None has to be there.
pub(super) fn problems(archive: &Archive, root: Node<'_, '_>) -> Vec<String> {
    let names: Vec<_> = variables(root).filter_map(|variable| variable.attribute("name")).collect();
    let mut problems = Vec::new();
    for entry in &archive.entries {
        let name = &entry.name;
        let terminals = name == TERMINALS;
        let references = name.starts_with(EXTRA) && (name.ends_with(MANIFEST) || name.ends_with(".exp"));
        let table = name.starts_with(EXTRA) && name.ends_with(".csv");
        let Ok(text) = std::str::from_utf8(&entry.bytes) else { continue };
        if table {
            let header = text.lines().next().unwrap_or_default();
            let unknown = header.split(',').filter(|column| *column != "time" && !names.contains(column));
            problems.extend(unknown.map(|column| {
                format!("{name} has a column {column}, which is no variable: give it the name of one")
            }));
        }
        if !terminals && !references {
            continue;
        }
        match Document::parse(text) {
            Err(error) => problems.push(format!("{name} is not well-formed: {error}")),
            Ok(document) if terminals => problems.extend(unknown_members(name, &document, &names)),
            Ok(document) => problems.extend(missing(archive, name, &document)),
        }
    }
    problems
}

/// Members of terminals that are no variables.
fn unknown_members(file: &str, document: &Document<'_>, names: &[&str]) -> Vec<String> {
    let members = document.descendants().filter_map(|node| node.attribute("variableName"));
    let unknown = members.filter(|member| !names.contains(member));
    unknown.map(|member| format!("{file} refers to {member}, which is no variable: name one")).collect()
}

/// Sources that are not in the archive.
fn missing(archive: &Archive, file: &str, document: &Document<'_>) -> Vec<String> {
    let sources = document.descendants().filter_map(|node| node.attribute("source"));
    let missing = sources.filter(|source| archive.entry(&resolved(file, source)).is_none());
    missing
        .map(|source| format!("{file} refers to {source}, which is not in the archive: put it there"))
        .collect()
}

/// The entry that a relative source in a file means.
fn resolved(file: &str, source: &str) -> String {
    let mut path: Vec<_> = file.split('/').collect();
    path.pop();
    for part in source.split('/') {
        match part {
            ".." => drop(path.pop()),
            "." => {}
            part => path.push(part),
        }
    }
    path.join("/")
}

#[cfg(test)]
mod tests {
    use super::super::fixture;
    use super::resolved;

    const MANIFEST: &str = "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml";

    #[test]
    fn members_of_terminals_have_to_be_variables() {
        let terminals = |variable: &str| format!("<T><M variableName=\"{variable}\"/></T>").into_bytes();
        let with = |variable| fixture::good().with_file(super::TERMINALS, &terminals(variable));
        with("speed").assert_refused(&["speed", "no variable"]);
        assert!(super::super::problems(&with("load").read()).is_empty());
        fixture::good().with_file(super::TERMINALS, b"<T>").assert_refused(&["not well-formed"]);
    }

    #[test]
    fn related_files_have_to_be_there() {
        let manifest = b"<R><Related source=\"in.csv\"/><Related source=\"../../model.png\"/></R>";
        let with = fixture::good().with_file(MANIFEST, manifest);
        with.assert_refused(&["in.csv", "not in the archive"]);
        let there = with.with_file("extra/org.fmi-standard.fmi-ls-ref/in.csv", b"time,load\n0,1\n");
        assert!(super::super::problems(&there.read()).is_empty());
    }

    #[test]
    fn columns_have_to_be_variables() {
        let table = "extra/org.fmi-standard.fmi-ls-ref/in.csv";
        fixture::good().with_file(table, b"time,loads\n").assert_refused(&["loads", "no variable"]);
    }

    #[test]
    fn sources_are_relative_to_their_file() {
        assert_eq!(resolved("extra/a/b.xml", "../../documentation/x.html"), "documentation/x.html");
        assert_eq!(resolved("extra/a/b.xml", "./c/d.csv"), "extra/a/c/d.csv");
    }
}
