//! docs/variables.md from the variable table.

use fretting_contact::fmi2::enumerations::ENUMERATIONS;
use fretting_contact::fmi2::variables::{DataType, PROBES, Start, Variable, variables};
use std::fmt::Write;
use std::ops::Bound;
use table_cells::{array_meaning, short_number, unit_cell};

#[path = "../src/table_cells.rs"]
mod table_cells;

const HEAD: &str = "\
# Which variables and enumerations are there?

Written from the variable table in `src/fmi2/variables/table.rs`; do not edit. After a change of the
table write it with `cargo fmu describe`.

All quantities are in SI units. Value references are in
[modelDescription.xml](../modelDescription.xml). Parameters are set before initialization; those
marked *tunable* may be changed between two steps. Where a tool sets an enumeration by its number,
take the number from [the enumerations](variables.md#enumerations). A tool that knows display units
shows lengths in um or mm, volumes in mm3, stresses in MPa or GPa, stiffnesses in N/um, work in mJ
and angles in deg; the values that it exchanges with the FMU stay in SI units.

The range of an input or a parameter is what the FMU accepts; a call with another value is refused.
Where the cell of a number is empty, any finite one is accepted; a step refuses forces beyond
1e60 N, lengths beyond 1e60 m and more than 1e30 cycles. Outputs and local variables stay in their
ranges.
";

const SECTIONS: [(&str, &str); 4] =
    [("input", "Inputs"), ("output", "Outputs"), ("parameter", "Parameters"), ("local", "Local variables")];

/// The whole page.
pub(crate) fn variables_page() -> String {
    let mut page = HEAD.to_owned();
    for (causality, heading) in SECTIONS {
        let start =
            if matches!(causality, "input" | "parameter") { (" start |", " --- |") } else { ("", "") };
        let _ = write!(
            page,
            "\n## {heading}\n\n| name | unit |{} range | meaning |\n| --- | --- |{} --- | --- |\n",
            start.0, start.1
        );
        for variable in variables().iter().filter(|variable| variable.causality() == causality) {
            if let Some(name) = name(variable) {
                let _ = writeln!(
                    page,
                    "| {name} | {} |{} {} | {} |",
                    kind(variable),
                    start_cell(variable),
                    range_cell(variable),
                    meaning(variable)
                );
            }
        }
    }
    page += "\n## Enumerations\n";
    for enumeration in ENUMERATIONS {
        let _ = write!(
            page,
            "\n### {}\n\n{}.\n\n| number | name | meaning |\n| --- | --- | --- |\n",
            enumeration.name, enumeration.description
        );
        for (index, (name, meaning)) in enumeration.items.iter().enumerate() {
            let _ = writeln!(page, "| {} | `{name}` | {meaning} |", index + 1);
        }
    }
    page
}

/// `None` for all elements of an array but the first, which stands for the array.
fn name(variable: &Variable) -> Option<String> {
    match variable.name.split_once('[') {
        Some((array, "1]")) => Some(format!("`{array}[1]` … `{array}[{PROBES}]`")),
        Some(_) => None,
        None => Some(format!("`{}`", variable.name)),
    }
}

/// Unit of a real number, else the type.
fn kind(variable: &Variable) -> String {
    match &variable.data_type {
        DataType::Real { unit, .. } => unit_cell(unit.map_or("", |unit| unit.name)),
        DataType::Enumeration(enumeration) => {
            format!("[{0}](variables.md#{1})", enumeration.name, enumeration.name.to_lowercase())
        }
        other => other.name().to_owned(),
    }
}

fn start_cell(variable: &Variable) -> String {
    match (variable.start(), &variable.data_type) {
        (None, _) => String::new(),
        (Some(Start::Integer(number)), DataType::Enumeration(enumeration)) => {
            let index = usize::try_from(number - 1).expect("items are numbered from 1");
            format!(" {number} (`{}`) |", enumeration.items[index].0)
        }
        (Some(Start::Integer(number)), _) => format!(" {number} |"),
        (Some(Start::Real(value)), _) => format!(" {} |", short_number(value)),
        (Some(Start::Text(text)), _) => format!(" {text} |"),
    }
}

/// Accepted values; nothing where all of the type are.
fn range_cell(variable: &Variable) -> String {
    let (low, high) = match variable.data_type {
        DataType::Real { range, .. } => (range.low, range.high),
        DataType::Integer { min, max } => (Bound::Included(min.into()), Bound::Included(max.into())),
        _ => (Bound::Unbounded, Bound::Unbounded),
    };
    let bound = |bound, included: &str, excluded: &str| match bound {
        Bound::Included(f64::INFINITY) => Some("inf allowed".to_owned()),
        Bound::Included(value) => Some(format!("{included} {}", short_number(value))),
        Bound::Excluded(value) => Some(format!("{excluded} {}", short_number(value))),
        Bound::Unbounded => None,
    };
    let bounds = [bound(low, "≥", ">"), bound(high, "≤", "<")];
    bounds.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn meaning(variable: &Variable) -> String {
    let tunable = if variable.variability() == "tunable" { " (*tunable*)" } else { "" };
    format!("{}{tunable}", array_meaning(variable.description))
}
