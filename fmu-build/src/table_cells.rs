//! What tables of variables show: shared by the page in the FMU and docs/variables.md.

/// The description of an array, from that of its first element, whose row stands for all.
pub(crate) fn array_meaning(of_first: &str) -> String {
    of_first.replace("[1]", "").replace("probe 1,", "the probe,")
}

/// A unit as it is printed.
pub(crate) fn unit_cell(unit: &str) -> String {
    unit.replace("m3", "m³")
}

/// A number far from 1 with an exponent, 2.1e11 for 210000000000.
pub(crate) fn short_number(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) { format!("{value:e}") } else { value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::{array_meaning, short_number, unit_cell};

    #[test]
    fn the_first_element_stands_for_its_array() {
        assert_eq!(
            array_meaning("Radius of probe 1, computed when read"),
            "Radius of the probe, computed when read"
        );
        assert_eq!(
            array_meaning("Pressure at radius_probe[1], computed"),
            "Pressure at radius_probe, computed"
        );
    }

    #[test]
    fn units_and_numbers_are_short() {
        assert_eq!((unit_cell("m3"), unit_cell("N/m")), ("m³".into(), "N/m".into()));
        let shown = [2.1e11, 3.482_91e-6, 0.01, 0.0, 128.0, f64::INFINITY].map(short_number);
        assert_eq!(shown, ["2.1e11", "3.48291e-6", "0.01", "0", "128", "inf"]);
    }
}
