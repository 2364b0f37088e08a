//! modelDescription.xml: names, units, value references and start values.

use super::{children_of, name, variables};
use roxmltree::Node;
use std::collections::{HashMap, HashSet};

/// Type elements of a variable or a SimpleType.
const TYPES: [&str; 5] = ["Real", "Integer", "Boolean", "String", "Enumeration"];

/// What is wrong with the description itself, ModelStructure aside.
pub(super) fn problems(root: Node<'_, '_>) -> Vec<String> {
    let mut problems = header_problems(root);
    let units: HashSet<&str> = children_of(root, "UnitDefinitions").map(name).collect();
    let types: HashMap<&str, Node<'_, '_>> = children_of(root, "TypeDefinitions")
        .filter_map(|simple| Some((name(simple), type_element(simple)?)))
        .collect();
    for (name, element) in &types {
        problems.extend(unit_problem(&format!("type {name}"), *element, &units));
    }
    problems.extend(duplicates(root));
    for variable in variables(root) {
        let owner = format!("variable {}", name(variable));
        let Some(element) = type_element(variable) else {
            problems.push(format!("{owner} has no type: add Real, Integer, Boolean, String or Enumeration"));
            continue;
        };
        problems.extend(unit_problem(&owner, element, &units));
        let declared = element.attribute("declaredType");
        let simple = declared.and_then(|name| types.get(name).copied());
        match (declared, simple) {
            (Some(declared), None) => {
                problems
                    .push(format!("{owner} has the undefined type {declared}: add it to TypeDefinitions"));
            }
            (Some(declared), Some(simple)) if simple.tag_name() != element.tag_name() => {
                problems.push(format!(
                    "{owner} is {}, but its type {declared} is {}",
                    element.tag_name().name(),
                    simple.tag_name().name()
                ))
            }
            _ => problems.extend(range_problem(&owner, element, simple)),
        }
    }
    problems
}

fn header_problems(root: Node<'_, '_>) -> Vec<String> {
    let mut problems = Vec::new();
    let version = root.attribute("fmiVersion").unwrap_or_default();
    if version != "2.0" {
        problems.push(format!("fmiVersion is {version:?}: it must be \"2.0\""));
    }
    if root.attribute("guid").unwrap_or_default().is_empty() {
        problems.push("guid is missing: fmi2Instantiate cannot check it".to_owned());
    }
    let has = |tag: &str| root.children().any(|node| node.has_tag_name(tag));
    if !has("CoSimulation") {
        problems.push("the element CoSimulation is missing: add it".to_owned());
    }
    if has("ModelExchange") {
        problems
            .push("ModelExchange is declared, but the library has no such functions: remove it".to_owned());
    }
    problems
}

fn duplicates(root: Node<'_, '_>) -> Vec<String> {
    let mut problems = Vec::new();
    let mut owners: HashMap<(&str, &str), &str> = HashMap::new();
    let mut names = HashSet::new();
    for variable in variables(root) {
        let own = name(variable);
        if !names.insert(own) {
            problems.push(format!("variable name {own} is given twice: rename one"));
        }
        let Some(reference) = variable.attribute("valueReference") else {
            problems.push(format!("variable {own} has no valueReference: give it one"));
            continue;
        };
        // Enumerations are read by fmi2GetInteger, so they share the references of integers.
        let kind = match type_element(variable).map(|element| element.tag_name().name()) {
            Some("Enumeration") => "Integer",
            Some(kind) => kind,
            None => continue,
        };
        if let Some(other) = owners.insert((kind, reference), own) {
            problems.push(format!(
                "variables {other} and {own} share the {kind} value reference {reference}: give each its own"
            ));
        }
    }
    problems
}

fn type_element<'a, 'input>(parent: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    parent.children().find(|node| TYPES.contains(&node.tag_name().name()))
}

fn unit_problem(owner: &str, element: Node<'_, '_>, units: &HashSet<&str>) -> Option<String> {
    let unit = element.attribute("unit")?;
    (!units.contains(unit)).then(|| format!("{owner} has the unknown unit {unit}: add it to UnitDefinitions"))
}

/// Start outside min and max, or outside the items of an enumeration; limits may come from the
/// declared type.
fn range_problem(owner: &str, element: Node<'_, '_>, simple: Option<Node<'_, '_>>) -> Option<String> {
    if !["Real", "Integer", "Enumeration"].contains(&element.tag_name().name()) {
        return None;
    }
    let inherited = |key: &str| element.attribute(key).or_else(|| simple?.attribute(key));
    let number = |key: &str| -> Result<Option<f64>, String> {
        let Some(text) = inherited(key) else { return Ok(None) };
        match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Some(value)),
            _ => Err(format!("{owner} has {key} = {text}: it must be a finite number")),
        }
    };
    let (min, max, start) = match (number("min"), number("max"), number("start")) {
        (Ok(min), Ok(max), Ok(start)) => (min, max, start),
        (Err(problem), _, _) | (_, Err(problem), _) | (_, _, Err(problem)) => return Some(problem),
    };
    if let (Some(min), Some(max)) = (min, max)
        && min > max
    {
        return Some(format!("{owner} has min = {min} above max = {max}: correct one"));
    }
    let start = start?;
    if min.is_some_and(|min| start < min) || max.is_some_and(|max| start > max) {
        let shown = |limit: Option<f64>, none: &str| limit.map_or(none.to_owned(), |value| value.to_string());
        return Some(format!(
            "{owner} has start = {start} outside its range [{}, {}]: correct the start or the range",
            shown(min, "-inf"),
            shown(max, "inf")
        ));
    }
    let is_item = |simple: Node<'_, '_>| {
        let mut items = simple.children().filter(|node| node.has_tag_name("Item"));
        items.any(|item| item.attribute("value").and_then(|text| text.parse().ok()) == Some(start))
    };
    match simple {
        Some(simple) if simple.has_tag_name("Enumeration") && !is_item(simple) => {
            Some(format!("{owner} has start = {start}, which is no item of its enumeration"))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture;

    #[track_caller]
    fn assert_spoiled(old: &str, new: &str, words: &[&str]) {
        fixture::good().replacing(old, new).assert_refused(words);
    }

    #[test]
    fn start_above_max_is_refused() {
        assert_spoiled("start=\"16\"", "start=\"65\"", &["cells", "start = 65", "[8, 64]"]);
    }

    #[test]
    fn limits_of_the_declared_type_count() {
        assert_spoiled("start=\"0.5\"", "start=\"-1\"", &["radius", "start = -1", "[0, 2]"]);
    }

    #[test]
    fn min_above_max_is_refused() {
        assert_spoiled("min=\"8\"", "min=\"80\"", &["cells", "min = 80", "max = 64"]);
    }

    #[test]
    fn a_start_that_is_no_number_is_refused() {
        assert_spoiled("start=\"16\"", "start=\"NaN\"", &["cells", "start = NaN"]);
    }

    #[test]
    fn a_start_that_is_no_item_is_refused() {
        assert_spoiled("\"State\" start=\"1\"", "\"State\" start=\"3\"", &["state", "start = 3", "no item"]);
    }

    #[test]
    fn duplicate_references_are_refused() {
        assert_spoiled(
            "valueReference=\"2\"",
            "valueReference=\"1\"",
            &["depth and radius", "Real value reference 1"],
        );
    }

    #[test]
    fn enumerations_share_the_references_of_integers() {
        assert_spoiled(
            "name=\"state\" valueReference=\"1\"",
            "name=\"state\" valueReference=\"0\"",
            &["cells and state", "Integer value reference 0"],
        );
    }

    #[test]
    fn duplicate_names_are_refused() {
        assert_spoiled("name=\"radius\"", "name=\"depth\"", &["name depth", "twice"]);
    }

    #[test]
    fn unknown_units_are_refused() {
        assert_spoiled("unit=\"N\"", "unit=\"kN\"", &["load", "unknown unit kN"]);
        assert_spoiled("unit=\"m\" min", "unit=\"mm\" min", &["type Length", "unknown unit mm"]);
    }

    #[test]
    fn undefined_types_are_refused() {
        assert_spoiled(
            "declaredType=\"Length\"",
            "declaredType=\"Width\"",
            &["radius", "undefined type Width"],
        );
        assert_spoiled(
            "declaredType=\"Length\"",
            "declaredType=\"State\"",
            &["radius is Real", "State is Enumeration"],
        );
    }

    #[test]
    fn the_header_is_checked() {
        assert_spoiled("fmiVersion=\"2.0\"", "fmiVersion=\"3.0\"", &["fmiVersion is \"3.0\""]);
        assert_spoiled("guid=\"{0e3c5f7a}\"", "", &["guid is missing"]);
        assert_spoiled("<CoSimulation", "<ModelExchange/><CoSimulation", &["ModelExchange"]);
    }
}
