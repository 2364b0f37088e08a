//! terminalsAndIcons/terminalsAndIcons.xml (FMI 3.0, section 2.4.9; in FMI 2.0 since 2.0.4): which
//! variables belong to one connection, and where the icon is drawn.

use crate::xml::escape;

/// What is connected as one: name, what it is, matching rule, and its variables.
type Terminal = (&'static str, &'static str, &'static str, &'static [&'static str]);

/// A plug fits whole; of a bus each end may use a part.
const TERMINALS: [Terminal; 5] = [
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
    ("cycles", "Cyclic loading: amplitude and frequency", "plug", &["displacement_amplitude", "frequency"]),
    ("wear", "What has worn", "bus", &["wear_volume", "wear_depth", "dissipated_energy"]),
];

/// Half the side of the square in which the icon is drawn.
const HALF: u32 = 100;

/// The file.
pub(crate) fn description() -> String {
    let terminals: String = TERMINALS.iter().map(terminal).collect();
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiTerminalsAndIcons fmiVersion="3.0">
  <GraphicalRepresentation>
    <CoordinateSystem x1="-{HALF}" y1="-{HALF}" x2="{HALF}" y2="{HALF}" suggestedScalingFactorTo_mm="0.1"/>
    <Icon x1="-{HALF}" y1="-{HALF}" x2="{HALF}" y2="{HALF}"/>
  </GraphicalRepresentation>
  <Terminals>
{terminals}  </Terminals>
</fmiTerminalsAndIcons>
"#
    )
}

fn terminal((name, about, rule, variables): &Terminal) -> String {
    let member = |variable: &&str| {
        format!(
            "      <TerminalMemberVariable variableName=\"{variable}\" memberName=\"{variable}\" variableKind=\"signal\"/>\n"
        )
    };
    let members: String = variables.iter().map(member).collect();
    let about = escape(about);
    format!(
        "    <Terminal name=\"{name}\" matchingRule=\"{rule}\" description=\"{about}\">\n{members}    </Terminal>\n"
    )
}
