//! Parameter values (*.ssv, SSP 1.0) in the archive: each sets a variable of the FMU that may be
//! set, in its unit, to a value that it allows.

use super::{Archive, children_of, variables};
use roxmltree::{Document, Node};

const NAMESPACE: &str = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";

/// What is wrong with them; there need not be any.
pub(super) fn problems(archive: &Archive, root: Node<'_, '_>) -> Vec<String> {
    let mut problems = Vec::new();
    for entry in archive.entries.iter().filter(|entry| entry.name.ends_with(".ssv")) {
        let text = String::from_utf8_lossy(&entry.bytes);
        match Document::parse(&text) {
            Err(error) => problems.push(format!("{} is not well-formed: {error}", entry.name)),
            Ok(document) => problems.extend(
                parameters(&document)
                    .filter_map(|parameter| problem(root, parameter))
                    .map(|problem| format!("{}: {problem}", entry.name)),
            ),
        }
    }
    problems
}

fn parameters<'a, 'input>(document: &'a Document<'input>) -> impl Iterator<Item = Node<'a, 'input>> {
    document.descendants().filter(|node| node.has_tag_name((NAMESPACE, "Parameter")))
}

fn problem(root: Node<'_, '_>, parameter: Node<'_, '_>) -> Option<String> {
    let name = super::name(parameter);
    let Some(variable) = variables(root).find(|variable| variable.attribute("name") == Some(name)) else {
        return Some(format!("{name} is no variable: give the name of one"));
    };
    if !matches!(variable.attribute("causality"), Some("parameter" | "input")) {
        return Some(format!("{name} cannot be set: give a parameter or an input"));
    }
    let (given, allowed) = (parameter.first_element_child()?, variable.first_element_child()?);
    let (given_type, allowed_type) = (given.tag_name().name(), allowed.tag_name().name());
    if given_type != allowed_type {
        return Some(format!("{name} is given as {given_type}: write {allowed_type}"));
    }
    let value = given.attribute("value").unwrap_or_default();
    match allowed_type {
        "Real" => real_problem(name, value, given, allowed),
        "Enumeration" => item_problem(root, name, value, allowed),
        _ => None,
    }
}

fn real_problem(name: &str, value: &str, given: Node<'_, '_>, allowed: Node<'_, '_>) -> Option<String> {
    let unit = given.attribute("unit");
    if unit.is_some() && unit != allowed.attribute("unit") {
        let (unit, wanted) = (unit.unwrap_or_default(), allowed.attribute("unit").unwrap_or("none"));
        return Some(format!("{name} is given in {unit}: its unit is {wanted}"));
    }
    let bound = |key: &str| allowed.attribute(key).and_then(|text| text.parse::<f64>().ok());
    let Ok(number) = value.parse::<f64>() else {
        return Some(format!("{name} = {value} is no number"));
    };
    let low = bound("min").is_some_and(|min| number < min);
    let high = bound("max").is_some_and(|max| number > max);
    (low || high || !number.is_finite()).then(|| format!("{name} = {value} is outside its range"))
}

fn item_problem(root: Node<'_, '_>, name: &str, value: &str, allowed: Node<'_, '_>) -> Option<String> {
    let declared = allowed.attribute("declaredType")?;
    let types = children_of(root, "TypeDefinitions");
    let simple = types.into_iter().find(|simple| simple.attribute("name") == Some(declared))?;
    let mut items = simple.descendants().filter(|node| node.has_tag_name("Item"));
    let known = items.any(|item| item.attribute("name") == Some(value));
    (!known).then(|| format!("{name} = {value} is no item of {declared}"))
}

#[cfg(test)]
mod tests {
    use super::super::fixture;

    const FILE: &str = "resources/presets/pair.ssv";

    fn set(parameters: &str) -> fixture::Fixture {
        let text = format!(
            "<ssv:ParameterSet xmlns:ssv=\"{}\" version=\"1.0\" name=\"pair\"><ssv:Parameters>{parameters}\
             </ssv:Parameters></ssv:ParameterSet>",
            super::NAMESPACE
        );
        fixture::good().with_file(FILE, text.as_bytes())
    }

    fn real(name: &str, rest: &str) -> fixture::Fixture {
        set(&format!("<ssv:Parameter name=\"{name}\"><ssv:Real {rest}/></ssv:Parameter>"))
    }

    #[test]
    fn good_values_are_accepted() {
        let file = real("load", "value=\"2\" unit=\"N\"");
        assert_eq!(super::super::problems(&file.read()), Vec::<String>::new());
    }

    #[test]
    fn names_types_units_and_values_are_checked() {
        real("lode", "value=\"1\"").assert_refused(&[FILE, "lode is no variable"]);
        real("depth", "value=\"1\"").assert_refused(&["depth cannot be set"]);
        real("cells", "value=\"1\"").assert_refused(&["cells is given as Real", "Integer"]);
        real("load", "value=\"1\" unit=\"kN\"").assert_refused(&["given in kN", "its unit is N"]);
        real("load", "value=\"much\"").assert_refused(&["load = much is no number"]);
        real("load", "value=\"inf\"").assert_refused(&["load = inf is outside"]);
        let item = "<ssv:Parameter name=\"state\"><ssv:Enumeration value=\"none\"/></ssv:Parameter>";
        set(item).assert_refused(&["state = none is no item of State"]);
        fixture::good().with_file(FILE, b"<ssv").assert_refused(&[FILE, "not well-formed"]);
    }
}
