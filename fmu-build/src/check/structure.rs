//! ModelStructure (FMI 2.0, section 2.2.8): outputs, initial unknowns and what they depend on.

use super::{children_of, name, variables};
use roxmltree::Node;
use std::collections::BTreeSet;

/// What is wrong with ModelStructure. Indices count the variables from 1.
pub(super) fn problems(root: Node<'_, '_>) -> Vec<String> {
    let variables: Vec<Node<'_, '_>> = variables(root).collect();
    let Some(structure) = root.children().find(|node| node.has_tag_name("ModelStructure")) else {
        return vec!["the element ModelStructure is missing: add it".to_owned()];
    };
    let outputs: BTreeSet<usize> = indices_where(&variables, is_output);
    let calculated = indices_where(&variables, |variable| {
        is_output(variable) && matches!(variable.attribute("initial"), None | Some("approx" | "calculated"))
            || variable.attribute("causality") == Some("calculatedParameter")
    });
    let mut problems = list_problems(structure, "Outputs", &variables, &outputs, is_known_in_steps);
    problems.extend(list_problems(structure, "InitialUnknowns", &variables, &calculated, is_known_initially));
    problems
}

/// Whether the unknowns of one list are the expected variables, and depend on knowns only.
fn list_problems(
    structure: Node<'_, '_>,
    list: &str,
    variables: &[Node<'_, '_>],
    expected: &BTreeSet<usize>,
    is_known: fn(Node<'_, '_>) -> bool,
) -> Vec<String> {
    let mut problems = Vec::new();
    let mut listed = BTreeSet::new();
    let shown = |index: usize| variables.get(index.wrapping_sub(1)).map_or("no variable", |&node| name(node));
    for unknown in children_of(structure, list) {
        let text = unknown.attribute("index").unwrap_or_default();
        let Some(index) = text.parse().ok().filter(|index| (1..=variables.len()).contains(index)) else {
            problems.push(format!("{list} has the index {text:?}: it must be 1 to {}", variables.len()));
            continue;
        };
        if !listed.insert(index) {
            problems.push(format!("{list} names {} twice: remove one", shown(index)));
        }
        problems.extend(
            dependency_problems(unknown).into_iter().map(|what| format!("{list}, {}: {what}", shown(index))),
        );
        for dependency in dependencies(unknown) {
            if !dependency
                .checked_sub(1)
                .and_then(|at| variables.get(at))
                .is_some_and(|&known| is_known(known))
            {
                problems.push(format!(
                    "{list}, {}: depends on {dependency} ({}), which is not known there: remove it",
                    shown(index),
                    shown(dependency)
                ));
            }
        }
    }
    let names =
        |indices: Vec<&usize>| indices.into_iter().map(|&index| shown(index)).collect::<Vec<_>>().join(", ");
    let missing = names(expected.difference(&listed).collect());
    if !missing.is_empty() {
        problems.push(format!("{list} lacks {missing}: add them"));
    }
    let extra = names(listed.difference(expected).collect());
    if !extra.is_empty() {
        problems.push(format!("{list} names {extra}, which do not belong there: remove them"));
    }
    problems
}

fn dependency_problems(unknown: Node<'_, '_>) -> Option<String> {
    let kinds = unknown.attribute("dependenciesKind")?.split_whitespace().count();
    let count = unknown.attribute("dependencies").map_or(0, |text| text.split_whitespace().count());
    (kinds != count).then(|| format!("{count} dependencies have {kinds} dependenciesKind: give one for each"))
}

/// Indices in `dependencies`; what is no number becomes 0, which is no variable.
fn dependencies<'a>(unknown: Node<'a, '_>) -> impl Iterator<Item = usize> + use<'a> {
    let list = unknown.attribute("dependencies").unwrap_or_default();
    list.split_whitespace().map(|text| text.parse().unwrap_or(0))
}

fn indices_where(variables: &[Node<'_, '_>], holds: impl Fn(Node<'_, '_>) -> bool) -> BTreeSet<usize> {
    (1..).zip(variables).filter(|&(_, &variable)| holds(variable)).map(|(index, _)| index).collect()
}

fn is_output(variable: Node<'_, '_>) -> bool {
    variable.attribute("causality") == Some("output")
}

/// What outputs may depend on while the FMU steps.
fn is_known_in_steps(variable: Node<'_, '_>) -> bool {
    matches!(variable.attribute("causality"), Some("input" | "independent"))
}

/// The same and everything with initial = exact, which is the default of parameters and constants.
fn is_known_initially(variable: Node<'_, '_>) -> bool {
    let exact_by_default = matches!(variable.attribute("causality"), Some("parameter"))
        || variable.attribute("variability") == Some("constant");
    is_known_in_steps(variable)
        || variable.attribute("initial").map_or(exact_by_default, |initial| initial == "exact")
}

#[cfg(test)]
mod tests {
    use super::super::fixture;

    #[track_caller]
    fn assert_spoiled(old: &str, new: &str, words: &[&str]) {
        fixture::good().replacing(old, new).assert_refused(words);
    }

    #[test]
    fn missing_outputs_are_named() {
        assert_spoiled(
            "<Outputs><Unknown index=\"2\" dependencies=\"1\"/></Outputs>",
            "",
            &["Outputs lacks depth"],
        );
    }

    #[test]
    fn missing_initial_unknowns_are_named() {
        let list = "<InitialUnknowns><Unknown index=\"2\" dependencies=\"1 3\"/></InitialUnknowns>";
        assert_spoiled(list, "", &["InitialUnknowns lacks depth"]);
    }

    #[test]
    fn what_is_no_output_is_refused() {
        assert_spoiled("<Outputs>", "<Outputs><Unknown index=\"1\"/>", &["Outputs names load"]);
    }

    #[test]
    fn dependencies_must_be_known() {
        assert_spoiled(
            "dependencies=\"1\"",
            "dependencies=\"1 3\"",
            &["Outputs, depth", "depends on 3 (radius)"],
        );
        assert_spoiled(
            "dependencies=\"1 3\"",
            "dependencies=\"2\"",
            &["InitialUnknowns, depth", "depends on 2 (depth)"],
        );
        assert_spoiled("dependencies=\"1\"", "dependencies=\"9\"", &["depends on 9 (no variable)"]);
    }

    #[test]
    fn indices_outside_the_list_are_refused() {
        let unknown = "<InitialUnknowns><Unknown index=\"2\" dependencies=\"1 3\"/>";
        assert_spoiled(unknown, &format!("{unknown}<Unknown index=\"17\"/>"), &["index \"17\"", "1 to 5"]);
    }

    #[test]
    fn kinds_must_match_dependencies() {
        assert_spoiled(
            "dependencies=\"1 3\"",
            "dependencies=\"1 3\" dependenciesKind=\"dependent\"",
            &["2 dependencies have 1 dependenciesKind"],
        );
    }
}
