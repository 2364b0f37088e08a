//! The variable table: name, type, unit, range, meaning and access of every variable, in one place.
//! A variable's value reference is its position. modelDescription.xml is written from it.

mod table;

use super::enumerations::Enumeration;
use super::settings::{Inputs, Settings};
use crate::engine::{FrettingContact, Gradient, SlipState};
use crate::interface::Interface;
use std::ffi::CString;
use std::fmt;
use std::ops::{Bound, RangeInclusive};

/// Number of radii at which the fields are given.
pub const PROBES: usize = 64;

/// All variables in the order of their value references.
pub fn variables() -> &'static [Variable] {
    &table::TABLE
}

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Variable {
    /// Name in the structured naming convention.
    pub name: &'static str,
    /// Meaning, for the user.
    pub description: &'static str,
    /// Type with unit and range.
    pub data_type: DataType,
    /// The unit in which tools show it, one of those of its unit; the calls of FMI keep to the unit
    /// itself.
    pub display_unit: Option<DisplayUnit>,
    /// Where the value lives.
    pub(super) access: Access,
    /// Names of the variables on which it depends at the end of the initialization, if it is an
    /// output.
    pub initial_dependencies: &'static [&'static str],
    /// Names of the inputs on which it never depends, if it is an output.
    pub independent_of: &'static [&'static str],
}

/// Type of a variable and what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DataType {
    /// fmi2Real.
    Real {
        /// One of [`UNITS`]; none where the unit depends on another parameter.
        unit: Option<Unit>,
        /// A usual size, if 1 is not usual.
        nominal: Option<f64>,
        /// Accepted values.
        range: Range,
    },
    /// fmi2Integer.
    Integer {
        /// Least accepted value.
        min: i32,
        /// Largest accepted value.
        max: i32,
    },
    /// fmi2Integer in C.
    Enumeration(&'static Enumeration),
    /// fmi2Boolean.
    Boolean,
    /// fmi2String.
    String,
}

impl DataType {
    /// Name in modelDescription.xml.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Real { .. } => "Real",
            Self::Integer { .. } => "Integer",
            Self::Enumeration(_) => "Enumeration",
            Self::Boolean => "Boolean",
            Self::String => "String",
        }
    }
}

/// A unit and its exponents of the SI base units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name in modelDescription.xml.
    pub name: &'static str,
    /// Attribute names of BaseUnit with their exponents.
    pub base: &'static [(&'static str, i32)],
    /// Units in which tools may show its values; the first is the default.
    pub display: &'static [DisplayUnit],
}

/// A unit for display: shown value = `factor` · value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayUnit {
    /// Name in modelDescription.xml.
    pub name: &'static str,
    /// Shown value of 1 unit.
    pub factor: f64,
}

const fn shown(name: &'static str, factor: f64) -> DisplayUnit {
    DisplayUnit { name, factor }
}

/// Every unit that a variable may have.
pub const UNITS: [Unit; 12] = [
    Unit { name: "1", base: &[], display: &[] },
    Unit { name: "Hz", base: &[("s", -1)], display: &[] },
    Unit { name: "J", base: &[("kg", 1), ("m", 2), ("s", -2)], display: &[shown("mJ", 1e3)] },
    Unit { name: "J/m2", base: &[("kg", 1), ("s", -2)], display: &[shown("J/mm2", 1e-6)] },
    Unit { name: "N", base: &[("kg", 1), ("m", 1), ("s", -2)], display: &[] },
    Unit { name: "N.m", base: &[("kg", 1), ("m", 2), ("s", -2)], display: &[] },
    Unit { name: "N/m", base: &[("kg", 1), ("s", -2)], display: &[shown("N/um", 1e-6)] },
    Unit {
        name: "Pa",
        base: &[("kg", 1), ("m", -1), ("s", -2)],
        display: &[shown("MPa", 1e-6), shown("GPa", 1e-9)],
    },
    Unit { name: "m", base: &[("m", 1)], display: &[shown("um", 1e6), shown("mm", 1e3)] },
    Unit { name: "m3", base: &[("m", 3)], display: &[shown("mm3", 1e9), shown("um3", 1e18)] },
    Unit { name: "rad", base: &[("rad", 1)], display: &[shown("deg", 180.0 / std::f64::consts::PI)] },
    Unit { name: "s", base: &[("s", 1)], display: &[] },
];

/// Accepted values of a real variable; they are finite, but where the upper bound itself is
/// infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower bound.
    pub low: Bound<f64>,
    /// Upper bound.
    pub high: Bound<f64>,
}

impl Range {
    pub(super) const FINITE: Self = Self { low: Bound::Unbounded, high: Bound::Unbounded };
    pub(super) const NOT_NEGATIVE: Self = Self { low: Bound::Included(0.0), high: Bound::Unbounded };

    /// Whether `value` is accepted.
    #[inline]
    pub fn contains(&self, value: f64) -> bool {
        let above = match self.low {
            Bound::Included(low) => value >= low,
            Bound::Excluded(low) => value > low,
            Bound::Unbounded => value >= f64::MIN,
        };
        let below = match self.high {
            Bound::Included(high) => value <= high,
            Bound::Excluded(high) => value < high,
            Bound::Unbounded => value <= f64::MAX,
        };
        above && below
    }

    const fn of(range: &RangeInclusive<f64>) -> Self {
        Self { low: Bound::Included(*range.start()), high: Bound::Included(*range.end()) }
    }

    fn is_open_ended(&self) -> bool {
        self.high == Bound::Included(f64::INFINITY)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.is_open_ended() { "give a number" } else { "give a finite number" })?;
        match self.low {
            Bound::Included(low) => write!(f, " >= {low:?}")?,
            Bound::Excluded(low) => write!(f, " > {low:?}")?,
            Bound::Unbounded => {}
        }
        let and = if self.low == Bound::Unbounded { "" } else { " and" };
        match self.high {
            Bound::Included(f64::INFINITY) => Ok(()),
            Bound::Included(high) => write!(f, "{and} <= {high:?}"),
            Bound::Excluded(high) => write!(f, "{and} < {high:?}"),
            Bound::Unbounded => Ok(()),
        }
    }
}

/// Where a value lives. Causality, variability and initial value follow from it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Access {
    Input(fn(&mut Inputs) -> &mut f64),
    Parameter(fn(&mut Settings) -> &mut f64),
    /// A parameter that may be changed between steps.
    Tunable(fn(&mut Settings) -> &mut f64),
    /// An Integer or Enumeration parameter.
    Number(fn(&mut Settings) -> &mut i32),
    Text(fn(&mut Settings) -> &mut CString),
    Output(Output),
    Slip(fn(&FrettingContact) -> SlipState),
    /// A number of contacts, or which it is, of the one contact and of an interface.
    Count {
        one: fn(&FrettingContact) -> i32,
        many: fn(&Interface) -> i32,
    },
    /// The number of the state as a Real, for importers that read only these.
    SlipNumber(fn(&FrettingContact) -> SlipState),
    /// Whether the coating has worn through.
    WornThrough,
    /// What is known of the wear-through: a Real that stays 0 until then.
    WearThrough(WearThrough),
    /// The value of a field at one of the probe radii.
    Field {
        probe: usize,
        read: fn(&FrettingContact, f64) -> f64,
    },
}

impl Access {
    /// Whether the model computes the value, so that an importer only reads it.
    #[inline]
    pub(super) fn is_computed(&self) -> bool {
        match self {
            Self::Input(_) | Self::Parameter(_) | Self::Tunable(_) | Self::Number(_) | Self::Text(_) => false,
            Self::Output(_)
            | Self::Slip(_)
            | Self::SlipNumber(_)
            | Self::WornThrough
            | Self::WearThrough(_)
            | Self::Count { .. }
            | Self::Field { .. } => true,
        }
    }
}

/// When a coating has worn through.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WearThrough {
    /// The time, s.
    Time,
    /// The number of cycles.
    Cycles,
}

/// How a real output is computed, and how it follows the inputs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Output {
    /// What it is of an interface.
    pub(super) whole: Whole,
    pub(super) read: fn(&FrettingContact) -> f64,
    pub(super) gradient: fn(&FrettingContact) -> Gradient,
    /// What a cycle of a given amplitude (m) adds, for outputs that grow with the cycles of cyclic
    /// loading.
    pub(super) per_cycle: Option<fn(&FrettingContact, f64) -> f64>,
    /// Which direction's displacement it is, x or y, at which the contact is pressed on at the
    /// start in transient loading; nothing else follows that.
    pub(super) starts_anywhere: Option<Direction>,
    /// Whether it is the wear depth, of which the largest value read so far is given.
    pub(super) never_falls: bool,
}

/// What an output is of an interface of many contacts.
#[derive(Debug, Clone, Copy)]
pub(super) enum Whole {
    /// The sum over the contacts.
    Sum,
    /// That of the contact which is worn deepest.
    Deepest,
    /// The coefficient of friction: the mean over the contacts by their normal forces.
    Friction,
    /// A quantity of the interface.
    Own { read: fn(&Interface) -> f64, gradient: fn(&Interface) -> Gradient },
}

/// A tangential direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Direction {
    /// That of `tangential_displacement`.
    X,
    /// That of `tangential_displacement_y`.
    Y,
}

/// A start value as modelDescription.xml writes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Start {
    /// Of a Real.
    Real(f64),
    /// Of an Integer or Enumeration.
    Integer(i32),
    /// Of a String.
    Text(String),
}

impl Variable {
    /// FMI causality.
    pub fn causality(&self) -> &'static str {
        match self.access {
            Access::Input(_) => "input",
            Access::Field { .. } | Access::SlipNumber(_) => "local",
            access if access.is_computed() => "output",
            _ => "parameter",
        }
    }

    /// FMI variability.
    pub fn variability(&self) -> &'static str {
        match self.access {
            Access::Tunable(_) => "tunable",
            Access::Input(_) | Access::Output(_) | Access::Field { .. } => "continuous",
            access if access.is_computed() => "discrete",
            _ => "fixed",
        }
    }

    /// FMI `initial`; none for inputs, for which the standard does not allow the attribute.
    pub fn initial(&self) -> Option<&'static str> {
        match self.access {
            Access::Input(_) => None,
            access if access.is_computed() => Some("calculated"),
            _ => Some("exact"),
        }
    }

    /// The value after instantiation, where the model does not compute it.
    pub fn start(&self) -> Option<Start> {
        let (mut settings, mut inputs) = (Settings::default(), Inputs::default());
        match self.access {
            Access::Input(field) => Some(Start::Real(*field(&mut inputs))),
            Access::Parameter(field) | Access::Tunable(field) => Some(Start::Real(*field(&mut settings))),
            Access::Number(field) => Some(Start::Integer(*field(&mut settings))),
            Access::Text(field) => Some(Start::Text(field(&mut settings).to_string_lossy().into_owned())),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::resources::Resources;

    /// The table refuses a value exactly where the engine would: both state the same physics.
    #[test]
    fn ranges_agree_with_the_engine() {
        let accepted = |settings: &Settings| {
            settings.parameters(&Resources::default()).is_ok_and(|parameters| parameters.validate().is_ok())
        };
        let mut checked = 0;
        for variable in variables() {
            let (Access::Parameter(field) | Access::Tunable(field), DataType::Real { range, .. }) =
                (variable.access, &variable.data_type)
            else {
                continue;
            };
            let probes = [
                f64::NAN,
                f64::INFINITY,
                1e-320,
                1e-31,
                1e-13,
                1e9,
                1e31,
                1e301,
                -1.0,
                0.0,
                0.5,
                0.05,
                0.1,
                0.100001,
                0.51,
                1.6,
                99.0,
                101.0,
            ];
            for value in probes {
                // A dimension counts only for the profiles that use it: refused by one of them is
                // refused.
                let by_engine = if variable.name.starts_with("radius_") {
                    // an ellipse, which has no wear, and whose radii do not differ too much
                    let (profile, wear_coefficient) = (8, 0.0);
                    let radii = Settings { profile, radius_x: value, radius_y: value, ..Settings::default() };
                    accepted(&Settings { wear_coefficient, ..radii })
                } else {
                    (1..=6).all(|profile| {
                        let mut settings = Settings { profile, hardness_2: 1e9, ..Settings::default() };
                        *field(&mut settings) = value;
                        accepted(&settings)
                    })
                };
                assert_eq!(range.contains(value), by_engine, "{} = {value}", variable.name);
                checked += 1;
            }
        }
        assert_eq!(checked, 22 * 18);
    }

    #[test]
    fn ranges_print_as_a_request() {
        let ratio = Range { low: Bound::Excluded(-1.0), high: Bound::Included(0.5) };
        assert_eq!(ratio.to_string(), "give a finite number > -1.0 and <= 0.5");
        assert_eq!(Range::FINITE.to_string(), "give a finite number");
        assert!(!ratio.contains(-1.0) && ratio.contains(0.5) && !ratio.contains(f64::NAN));
        assert!(!Range::FINITE.contains(f64::INFINITY));
        let open = Range { low: Bound::Excluded(0.0), high: Bound::Included(f64::INFINITY) };
        assert_eq!(open.to_string(), "give a number > 0.0");
        assert!(open.contains(f64::INFINITY) && !open.contains(f64::NAN) && !open.contains(0.0));
    }
}
