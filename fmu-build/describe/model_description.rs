//! modelDescription.xml from the variable table.

use fretting_contact::fmi2::enumerations::ENUMERATIONS;
use fretting_contact::fmi2::variables::{DataType, Range, Start, UNITS, Variable, variables};
use fretting_contact::fmi2::{CATEGORIES, MODEL_IDENTIFIER};
use std::io;
use std::ops::Bound;
use uuid::Uuid;
use xml::{Xml, document};

#[path = "../src/xml.rs"]
mod xml;

/// What a tool shows beside the name.
const DESCRIPTION: &str = "Friction and wear of a small oscillating contact: from normal force and tangential displacement to \
                           tangential force, stick and slip, and the worn profile";

/// The whole file. Its GUID is the name-based UUID of what it says with an empty GUID.
pub(crate) fn model_description() -> String {
    let content = with_guid("");
    with_guid(&Uuid::new_v5(&Uuid::NAMESPACE_OID, content.as_bytes()).to_string())
}

fn with_guid(guid: &str) -> String {
    let attributes = [
        ("fmiVersion", "2.0"),
        ("modelName", MODEL_IDENTIFIER),
        ("guid", guid),
        ("description", DESCRIPTION),
        ("version", env!("CARGO_PKG_VERSION")),
        ("license", env!("CARGO_PKG_LICENSE")),
        ("generationTool", concat!("fretting_contact ", env!("CARGO_PKG_VERSION"))),
        ("variableNamingConvention", "structured"),
    ];
    document("fmiModelDescription", attributes, content)
}

fn content(xml: &mut Xml) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attributes([
            ("modelIdentifier", MODEL_IDENTIFIER),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", "true"),
            ("maxOutputDerivativeOrder", "1"),
            ("canRunAsynchronuously", "false"),
            ("canBeInstantiatedOnlyOncePerProcess", "false"),
            ("canNotUseMemoryManagementFunctions", "true"),
            ("canGetAndSetFMUstate", "true"),
            ("canSerializeFMUstate", "true"),
            ("providesDirectionalDerivative", "true"),
        ])
        .write_empty()?;
    xml.create_element("UnitDefinitions").write_inner_content(units)?;
    xml.create_element("TypeDefinitions").write_inner_content(types)?;
    xml.create_element("LogCategories").write_inner_content(categories)?;
    xml.create_element("DefaultExperiment")
        .with_attributes([("startTime", "0"), ("stopTime", "1"), ("stepSize", "0.01")])
        .write_empty()?;
    xml.create_element("ModelVariables")
        .write_inner_content(|xml| variables().iter().try_for_each(|v| variable(xml, v)))?;
    xml.create_element("ModelStructure").write_inner_content(structure)?;
    Ok(())
}

fn units(xml: &mut Xml) -> io::Result<()> {
    for unit in UNITS {
        xml.create_element("Unit").with_attribute(("name", unit.name)).write_inner_content(|xml| {
            let exponents: Vec<_> =
                unit.base.iter().map(|(base, exponent)| (*base, exponent.to_string())).collect();
            let attributes = exponents.iter().map(|(base, exponent)| (*base, exponent.as_str()));
            xml.create_element("BaseUnit").with_attributes(attributes).write_empty()?;
            unit.display.iter().try_for_each(|display| {
                let attributes = [("name", display.name), ("factor", &format!("{:?}", display.factor))];
                xml.create_element("DisplayUnit").with_attributes(attributes).write_empty().map(drop)
            })
        })?;
    }
    Ok(())
}

fn types(xml: &mut Xml) -> io::Result<()> {
    for enumeration in ENUMERATIONS {
        let attributes = [("name", enumeration.name), ("description", enumeration.description)];
        xml.create_element("SimpleType").with_attributes(attributes).write_inner_content(|xml| {
            xml.create_element("Enumeration").write_inner_content(|xml| {
                for (index, (name, description)) in enumeration.items.iter().enumerate() {
                    let value = (index + 1).to_string();
                    let attributes = [("name", *name), ("value", &value), ("description", description)];
                    xml.create_element("Item").with_attributes(attributes).write_empty()?;
                }
                Ok(())
            })?;
            Ok(())
        })?;
    }
    Ok(())
}

fn categories(xml: &mut Xml) -> io::Result<()> {
    for (name, description) in CATEGORIES {
        let name = name.to_str().expect("the names are ASCII");
        xml.create_element("Category")
            .with_attributes([("name", name), ("description", description)])
            .write_empty()?;
    }
    Ok(())
}

fn variable(xml: &mut Xml, variable: &Variable) -> io::Result<()> {
    let reference = (index(variable.name) - 1).to_string();
    let mut attributes = vec![
        ("name", variable.name),
        ("valueReference", &reference),
        ("description", variable.description),
        ("causality", variable.causality()),
        ("variability", variable.variability()),
    ];
    attributes.extend(variable.initial().map(|initial| ("initial", initial)));
    xml.create_element("ScalarVariable").with_attributes(attributes).write_inner_content(|xml| {
        let attributes = type_attributes(variable);
        let attributes = attributes.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element(variable.data_type.name()).with_attributes(attributes).write_empty().map(drop)
    })?;
    Ok(())
}

fn type_attributes(variable: &Variable) -> Vec<(&'static str, String)> {
    let mut attributes = Vec::new();
    match &variable.data_type {
        DataType::Real { unit, nominal, range: Range { low, high } } => {
            attributes.extend(unit.map(|unit| ("unit", unit.name.to_owned())));
            attributes.extend(variable.display_unit.map(|unit| ("displayUnit", unit.name.to_owned())));
            // the schema's bounds belong to the range: those of an open one are the next numbers
            let min = match *low {
                Bound::Included(min) => Some(min),
                Bound::Excluded(min) => Some(min.next_up()),
                Bound::Unbounded => None,
            };
            let max = match *high {
                Bound::Included(max) => Some(max),
                Bound::Excluded(max) => Some(max.next_down()),
                Bound::Unbounded => None,
            };
            attributes.extend(min.map(|min| ("min", format!("{min:?}"))));
            attributes.extend(max.filter(|max| max.is_finite()).map(|max| ("max", format!("{max:?}"))));
            attributes.extend(nominal.map(|nominal| ("nominal", format!("{nominal:?}"))));
        }
        DataType::Integer { min, max } => {
            attributes.push(("min", min.to_string()));
            attributes.push(("max", max.to_string()));
        }
        DataType::Enumeration(enumeration) => attributes.push(("declaredType", enumeration.name.to_owned())),
        DataType::Boolean | DataType::String => {}
    }
    attributes.extend(variable.start().map(|start| {
        let text = match start {
            Start::Real(value) => format!("{value:?}"),
            Start::Integer(value) => value.to_string(),
            Start::Text(text) => text,
        };
        ("start", text)
    }));
    attributes
}

/// Outputs follow the inputs through the steps, but for those that the table names; at the start
/// they follow what the table says.
fn structure(xml: &mut Xml) -> io::Result<()> {
    let inputs: Vec<_> = variables().iter().filter(|v| v.causality() == "input").map(|v| v.name).collect();
    xml.create_element("Outputs").write_inner_content(|xml| {
        unknowns(xml, |output| {
            inputs.iter().copied().filter(|input| !output.independent_of.contains(input)).collect()
        })
    })?;
    xml.create_element("InitialUnknowns")
        .write_inner_content(|xml| unknowns(xml, |output| output.initial_dependencies.to_vec()))?;
    Ok(())
}

fn unknowns<'a>(xml: &mut Xml, dependencies: impl Fn(&Variable) -> Vec<&'a str>) -> io::Result<()> {
    for output in variables().iter().filter(|v| v.causality() == "output") {
        let mut indices: Vec<_> = dependencies(output).into_iter().map(index).collect();
        indices.sort_unstable();
        let list = indices.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
        let attributes = [("index", index(output.name).to_string()), ("dependencies", list)];
        let attributes = attributes.iter().map(|(name, value)| (*name, value.as_str()));
        xml.create_element("Unknown").with_attributes(attributes).write_empty()?;
    }
    Ok(())
}

/// Position in ModelVariables, from 1.
fn index(name: &str) -> usize {
    let position = variables().iter().position(|variable| variable.name == name);
    position.unwrap_or_else(|| panic!("{name} is in the table")) + 1
}
