//! Checks of a packaged FMU: what an importer relies on and common validators do not check.

mod archive;
mod companions;
mod description;
mod library;
mod presets;
mod structure;

#[cfg(test)]
mod fixture;

pub(crate) use archive::{Archive, Entry};
pub(crate) use library::newest_glibc;

use roxmltree::{Document, Node};

/// Everything wrong with the archive, each in one sentence; empty if nothing is.
pub(crate) fn problems(archive: &Archive) -> Vec<String> {
    let mut problems = archive::problems(archive);
    let Some(entry) = archive.entry("modelDescription.xml") else {
        return problems; // its absence is already among them
    };
    let Ok(text) = std::str::from_utf8(&entry.bytes) else {
        problems.push("modelDescription.xml is not UTF-8: write it as UTF-8".to_owned());
        return problems;
    };
    match Document::parse(text) {
        Err(error) => problems.push(format!("modelDescription.xml is not well-formed: {error}")),
        Ok(document) => {
            let root = document.root_element();
            problems.extend(description::problems(root));
            problems.extend(structure::problems(root));
            problems.extend(library::problems(archive, root));
            problems.extend(companions::problems(archive, root));
            problems.extend(presets::problems(archive, root));
        }
    }
    problems
}

/// Child elements of the child named `list`, if it is there.
fn children_of<'a, 'input>(root: Node<'a, 'input>, list: &str) -> impl Iterator<Item = Node<'a, 'input>> {
    let parent = root.children().find(|node| node.has_tag_name(list));
    parent.into_iter().flat_map(|node| node.children().filter(Node::is_element))
}

/// The ScalarVariable elements, in the order that ModelStructure counts.
fn variables<'a, 'input>(root: Node<'a, 'input>) -> impl Iterator<Item = Node<'a, 'input>> {
    children_of(root, "ModelVariables")
}

/// The name of a variable for messages.
fn name<'a>(node: Node<'a, '_>) -> &'a str {
    node.attribute("name").unwrap_or("(no name)")
}

#[cfg(test)]
mod tests {
    use super::{fixture, problems};

    #[test]
    fn a_good_fmu_has_no_problems() {
        assert_eq!(problems(&fixture::good().read()), Vec::<String>::new());
    }

    #[test]
    fn a_description_that_is_not_xml_is_one_problem() {
        fixture::good().with_description("<fmiModelDescription").assert_refused(&["not well-formed"]);
    }
}
