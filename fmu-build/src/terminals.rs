//! terminalsAndIcons/terminalsAndIcons.xml (FMI 3.0, section 2.4.9; in FMI 2.0 since 2.0.4): which
//! variables belong to one connection, and where the icon is drawn.

use crate::xml::{Xml, document};
use std::io;

/// What is connected as one: name, what it is, matching rule, and its variables.
type Terminal = (&'static str, &'static str, &'static str, &'static [&'static str]);

/// A plug fits whole; of a bus each end may use a part.
const TERMINALS: [Terminal; 6] = [
    (
        "tangential",
        "Tangential connection: the displacement goes in, the force that body 1 exerts on body 2 comes out",
        "plug",
        &["tangential_displacement", "tangential_force"],
    ),
    (
        "tangential_y",
        "Tangential connection at right angles to the first",
        "plug",
        &["tangential_displacement_y", "tangential_force_y"],
    ),
    (
        "normal",
        "Normal connection: force or indentation goes in, by normal_control, both come out",
        "bus",
        &["normal_force", "indentation", "normal_reaction", "indentation_depth"],
    ),
    (
        "rotation",
        "Rotation about the normal, of an interface of many contacts: the angle goes in, the moment comes out",
        "plug",
        &["rotation", "moment"],
    ),
    ("cycles", "Cyclic loading: amplitude and frequency", "plug", &["displacement_amplitude", "frequency"]),
    ("wear", "What has worn", "bus", &["wear_volume", "wear_depth", "dissipated_energy"]),
];

/// Corners of the square in which the icon is drawn.
const CORNERS: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];

/// The file.
pub(crate) fn description() -> String {
    document("fmiTerminalsAndIcons", [("fmiVersion", "3.0")], content)
}

fn content(xml: &mut Xml) -> io::Result<()> {
    xml.create_element("GraphicalRepresentation").write_inner_content(|xml| {
        xml.create_element("CoordinateSystem")
            .with_attributes(CORNERS)
            .with_attribute(("suggestedScalingFactorTo_mm", "0.1"))
            .write_empty()?;
        xml.create_element("Icon").with_attributes(CORNERS).write_empty().map(drop)
    })?;
    xml.create_element("Terminals")
        .write_inner_content(|xml| TERMINALS.iter().try_for_each(|one| terminal(xml, one)))
        .map(drop)
}

fn terminal(xml: &mut Xml, (name, about, rule, variables): &Terminal) -> io::Result<()> {
    let attributes = [("name", *name), ("matchingRule", rule), ("description", about)];
    let member = |xml: &mut Xml, variable: &str| {
        let attributes = [("variableName", variable), ("memberName", variable), ("variableKind", "signal")];
        xml.create_element("TerminalMemberVariable").with_attributes(attributes).write_empty().map(drop)
    };
    xml.create_element("Terminal")
        .with_attributes(attributes)
        .write_inner_content(|xml| variables.iter().try_for_each(|variable| member(xml, variable)))
        .map(drop)
}
