//! The enumeration types of modelDescription.xml. Items are numbered from 1 in the order listed.

use crate::engine::SlipState;
use crate::parameters::NormalControl;
use crate::profile::LengthUnit;

/// One enumeration type as modelDescription.xml declares it.
#[derive(Debug, PartialEq)]
pub struct Enumeration {
    /// Name of the type; no variable has it.
    pub name: &'static str,
    /// What it chooses.
    pub description: &'static str,
    /// Name and description of the items, numbered from 1.
    pub items: &'static [(&'static str, &'static str)],
}

/// Every enumeration type there is.
pub const ENUMERATIONS: [&Enumeration; 5] = [&PROFILE, &NORMAL_CONTROL, &LOADING, &SLIP_STATE, &LENGTH_UNIT];

/// Shapes of the unworn body 1; `ProfileKind` in Rust.
pub const PROFILE: Enumeration = Enumeration {
    name: "Profile",
    description: "Shape of the unworn body 1",
    items: &[
        ("parabola", "sphere, f = r^2/(2 radius)"),
        ("cone", "f = r tan(cone_slope)"),
        ("power_law", "f = coefficient r^exponent"),
        ("blunted_sphere", "sphere with its tip cut off flat at flat_radius"),
        ("rounded_punch", "flat tip up to flat_radius, beyond it f = (r - flat_radius)^2/(2 radius)"),
        ("flat_punch", "flat-ended cylinder of radius flat_radius"),
        ("table", "the points of profile_file"),
        ("ellipse", "f = x^2/(2 radius_x) + y^2/(2 radius_y), a ball in a groove; wear_coefficient = 0 only"),
    ],
};

/// The prescribed normal quantity; [`NormalControl`] in Rust.
pub const NORMAL_CONTROL: Enumeration = Enumeration {
    name: "NormalControl",
    description: "Normal quantity that is prescribed",
    items: &[("force", "input normal_force"), ("indentation", "input indentation")],
};

/// The kind of tangential loading; `Loading` in Rust.
pub const LOADING: Enumeration = Enumeration {
    name: "Loading",
    description: "What the tangential inputs mean",
    items: &[
        ("transient", "tangential_displacement is followed from step to step"),
        ("cyclic", "displacement_amplitude and frequency; each step makes many cycles"),
    ],
};

/// The state of slip; [`SlipState`] in Rust.
pub const SLIP_STATE: Enumeration = Enumeration {
    name: "SlipState",
    description: "Which part of the contact slips",
    items: &[
        ("separated", "the bodies are apart"),
        ("stick", "the whole contact sticks"),
        ("partial_slip", "the contact sticks inside stick_radius and slips outside"),
        ("gross_slip", "the whole contact slips"),
    ],
};

/// The unit of a profile file; [`LengthUnit`] in Rust.
pub const LENGTH_UNIT: Enumeration = Enumeration {
    name: "LengthUnit",
    description: "Unit of both columns of profile_file",
    items: &[("m", "metre"), ("mm", "millimetre"), ("um", "micrometre")],
};

/// [`PROFILE`] as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProfileKind {
    Parabola,
    Cone,
    PowerLaw,
    BluntedSphere,
    RoundedPunch,
    FlatPunch,
    Table,
    Ellipse,
}

/// [`LOADING`] as a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Loading {
    Transient,
    Cyclic,
}

/// A Rust type whose values are the items of an [`Enumeration`].
pub(super) trait Items: Copy + PartialEq + 'static {
    /// The values in the order of the items.
    const ALL: &'static [Self];

    /// The value with this number; callers have checked it against the type's range.
    fn from_number(number: i32) -> Self {
        Self::ALL[(number - 1) as usize]
    }

    /// The number of this value.
    fn number(self) -> i32 {
        let index = Self::ALL.iter().position(|item| *item == self).expect("every value is listed");
        index as i32 + 1
    }
}

impl Items for ProfileKind {
    const ALL: &'static [Self] = &[
        Self::Parabola,
        Self::Cone,
        Self::PowerLaw,
        Self::BluntedSphere,
        Self::RoundedPunch,
        Self::FlatPunch,
        Self::Table,
        Self::Ellipse,
    ];
}

impl Items for NormalControl {
    const ALL: &'static [Self] = &[Self::Force, Self::Indentation];
}

impl Items for Loading {
    const ALL: &'static [Self] = &[Self::Transient, Self::Cyclic];
}

impl Items for LengthUnit {
    const ALL: &'static [Self] = &[Self::M, Self::Mm, Self::Um];
}

impl Items for SlipState {
    const ALL: &'static [Self] = &[Self::Separated, Self::Stick, Self::PartialSlip, Self::GrossSlip];
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The item names are the snake case of the Rust names.
    fn check<T: Items + std::fmt::Debug>(enumeration: &Enumeration) {
        assert_eq!(T::ALL.len(), enumeration.items.len(), "{}", enumeration.name);
        for (index, (item, (name, _))) in T::ALL.iter().zip(enumeration.items).enumerate() {
            assert_eq!(format!("{item:?}").to_lowercase(), name.replace('_', ""));
            assert_eq!(item.number(), index as i32 + 1);
            assert_eq!(T::from_number(item.number()), *item);
        }
    }

    #[test]
    fn rust_values_and_items_correspond() {
        check::<ProfileKind>(&PROFILE);
        check::<NormalControl>(&NORMAL_CONTROL);
        check::<Loading>(&LOADING);
        check::<SlipState>(&SLIP_STATE);
        check::<LengthUnit>(&LENGTH_UNIT);
    }
}
