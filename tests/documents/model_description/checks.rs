//! Checks of what the file says: what validators overlook.

use fretting_contact::fmi2::MODEL_IDENTIFIER;
use roxmltree::{Document, Node};
use std::collections::HashSet;

fn with_document(check: impl FnOnce(Node<'_, '_>)) {
    // Equal to the file by the test beside this module.
    let text = super::writer::model_description();
    let document = Document::parse(&text).expect("modelDescription.xml is XML");
    check(document.root_element());
}

fn child<'a, 'd>(node: Node<'a, 'd>, name: &str) -> Node<'a, 'd> {
    node.children().find(|child| child.has_tag_name(name)).unwrap_or_else(|| panic!("no {name}"))
}

fn elements<'a, 'd: 'a>(node: Node<'a, 'd>) -> impl Iterator<Item = Node<'a, 'd>> {
    node.children().filter(Node::is_element)
}

/// Variables with their type element.
fn variables<'a, 'd: 'a>(root: Node<'a, 'd>) -> Vec<(Node<'a, 'd>, Node<'a, 'd>)> {
    let typed = |variable| (variable, elements(variable).next().expect("a variable has a type"));
    elements(child(root, "ModelVariables")).map(typed).collect()
}

fn number(node: Node<'_, '_>, attribute: &str) -> Option<f64> {
    node.attribute(attribute).map(|text| text.parse().unwrap_or_else(|_| panic!("{attribute} = {text}")))
}

fn name<'a>(node: Node<'a, '_>) -> &'a str {
    node.attribute("name").expect("it has a name")
}

#[test]
fn names_and_references_are_unique() {
    with_document(|root| {
        let variables = variables(root);
        let names: HashSet<_> = variables.iter().map(|(variable, _)| name(*variable)).collect();
        let references: HashSet<_> =
            variables.iter().map(|(variable, _)| variable.attribute("valueReference")).collect();
        assert_eq!((names.len(), references.len()), (variables.len(), variables.len()));
        assert!(!references.contains(&None));
        for simple_type in elements(child(root, "TypeDefinitions")) {
            assert!(
                !names.contains(name(simple_type)),
                "a type has the name of the variable {}",
                name(simple_type)
            );
        }
    });
}

#[test]
fn the_description_of_a_field_has_its_number_where_it_reads_as_a_sentence() {
    with_document(|root| {
        for (variable, _) in variables(root).iter().filter(|(variable, _)| name(*variable).ends_with(']')) {
            let probe = name(*variable).split(['[', ']']).nth(1).unwrap();
            let at = format!(" at radius_probe[{probe}]");
            let about = variable.attribute("description").unwrap();
            assert!(
                about.contains(&at) || about.starts_with(&format!("Radius of probe {probe},")),
                "{}: {about}",
                name(*variable)
            );
            assert_eq!(about.matches('[').count(), about.matches(&at).count(), "{about}");
        }
    });
}

#[test]
fn starts_lie_within_their_bounds() {
    with_document(|root| {
        let mut starts = 0;
        for (variable, data) in variables(root) {
            let (min, max) = (number(data, "min"), number(data, "max"));
            if let (Some(min), Some(max)) = (min, max) {
                assert!(min <= max, "{}", name(variable));
            }
            if data.has_tag_name("String") {
                continue;
            }
            if let Some(start) = number(data, "start") {
                assert!(min.is_none_or(|min| min <= start), "{}", name(variable));
                assert!(max.is_none_or(|max| start <= max), "{}", name(variable));
                starts += 1;
            }
            assert!(number(data, "nominal").is_none_or(|nominal| nominal > 0.0), "{}", name(variable));
        }
        assert_eq!(starts, 7 + 27, "inputs and parameters apart from the files");
    });
}

/// Bounds that do not belong to the range are given by the next numbers.
#[test]
fn real_parameters_have_both_bounds() {
    with_document(|root| {
        for (variable, data) in variables(root) {
            if variable.attribute("causality") != Some("parameter") || !data.has_tag_name("Real") {
                continue;
            }
            assert!(number(data, "min").is_some(), "{}", name(variable));
            // a rig may be rigid
            let is_open_ended = name(variable) == "rig_stiffness";
            assert_eq!(number(data, "max").is_none(), is_open_ended, "{}", name(variable));
            if name(variable) == "cone_slope" {
                assert_eq!(number(data, "max").map(f64::next_up), Some(std::f64::consts::FRAC_PI_2));
            }
        }
    });
}

#[test]
fn starts_are_where_the_standard_wants_them() {
    with_document(|root| {
        for (variable, data) in variables(root) {
            let wanted = matches!(variable.attribute("causality"), Some("input" | "parameter"));
            assert_eq!(data.attribute("start").is_some(), wanted, "{}", name(variable));
        }
    });
}

#[test]
fn every_real_has_a_declared_unit_except_the_coefficient() {
    with_document(|root| {
        let declared: HashSet<_> = elements(child(root, "UnitDefinitions")).map(name).collect();
        let mut used = HashSet::new();
        for (variable, data) in variables(root).into_iter().filter(|(_, data)| data.has_tag_name("Real")) {
            match data.attribute("unit") {
                Some(unit) => {
                    assert!(declared.contains(unit), "{}", name(variable));
                    used.insert(unit);
                }
                None => assert_eq!(name(variable), "coefficient"),
            }
        }
        assert_eq!(used, declared, "a unit is declared and not used");
    });
}

/// What a tool shows for the start values, in the units of the field.
#[test]
fn display_units_belong_to_their_units() {
    with_document(|root| {
        let units = child(root, "UnitDefinitions");
        let mut shown = Vec::new();
        for (variable, data) in variables(root) {
            let Some(display) = data.attribute("displayUnit") else { continue };
            let unit = elements(units).find(|unit| Some(name(*unit)) == data.attribute("unit")).unwrap();
            let definition = elements(unit).find(|node| node.attribute("name") == Some(display));
            let definition = definition.unwrap_or_else(|| panic!("{} in {display}", name(variable)));
            assert!(definition.has_tag_name("DisplayUnit") && !definition.has_attribute("offset"));
            if let Some(start) = number(data, "start") {
                let value = start * number(definition, "factor").expect("a factor");
                shown.push(format!("{} = {value:.3} {display}", name(variable)));
            }
        }
        for start in [
            "displacement_amplitude = 1.000 um",
            "radius = 10.000 mm",
            "cone_slope = 1.146 deg",
            "youngs_modulus_1 = 210.000 GPa",
            "hardness = 8.000 GPa",
        ] {
            assert!(shown.contains(&start.to_owned()), "{shown:?}");
        }
        let factor = |name: &str| {
            let unit = units
                .descendants()
                .find(|node| node.attribute("name") == Some(name))
                .expect("it is declared");
            number(unit, "factor")
        };
        assert_eq!(["um", "mm3", "N/um"].map(factor), [1e6, 1e9, 1e-6].map(Some));
    });
}

#[test]
fn enumerations_are_declared_and_their_starts_are_items() {
    with_document(|root| {
        let types = child(root, "TypeDefinitions");
        let mut seen = Vec::new();
        for (variable, data) in
            variables(root).into_iter().filter(|(_, data)| data.has_tag_name("Enumeration"))
        {
            let declared = data.attribute("declaredType").expect("an enumeration has a type");
            let simple_type = elements(types).find(|t| name(*t) == declared).expect("the type is declared");
            let items: Vec<_> = elements(child(simple_type, "Enumeration")).collect();
            for (index, item) in items.iter().enumerate() {
                assert_eq!(number(*item, "value"), Some((index + 1) as f64));
            }
            let start = number(data, "start").unwrap_or(1.0);
            assert!(start >= 1.0 && start <= items.len() as f64, "{}", name(variable));
            seen.push(name(variable));
        }
        assert_eq!(seen, ["slip_state", "profile", "normal_control", "loading", "profile_unit"]);
    });
}

#[test]
fn the_structure_is_complete_and_refers_to_the_right_variables() {
    with_document(|root| {
        let variables = variables(root);
        let outputs: Vec<_> = (1..=variables.len())
            .filter(|index| variables[index - 1].0.attribute("causality") == Some("output"))
            .collect();
        for (list, knowns) in [("Outputs", &["input"][..]), ("InitialUnknowns", &["input", "parameter"])] {
            let unknowns: Vec<_> = elements(child(child(root, "ModelStructure"), list)).collect();
            let indices: Vec<_> =
                unknowns.iter().map(|u| number(*u, "index").expect("an index") as usize).collect();
            assert_eq!(indices, outputs, "{list}");
            for unknown in unknowns {
                let dependencies = unknown.attribute("dependencies").expect("dependencies are listed");
                let indices: Vec<usize> =
                    dependencies.split_whitespace().map(|i| i.parse().unwrap()).collect();
                assert!(indices.is_sorted_by(|a, b| a < b), "{list}: {dependencies}");
                for index in indices {
                    let causality = variables[index - 1].0.attribute("causality").unwrap();
                    assert!(knowns.contains(&causality), "{list}: {}", name(variables[index - 1].0));
                }
            }
        }
    });
}

#[test]
fn the_identifier_is_the_base_name_of_the_library() {
    with_document(|root| {
        assert_eq!(child(root, "CoSimulation").attribute("modelIdentifier"), Some(MODEL_IDENTIFIER));
        assert_eq!(MODEL_IDENTIFIER, "FrettingContact");
        assert_eq!(root.attribute("variableNamingConvention"), Some("structured"));
    });
}
