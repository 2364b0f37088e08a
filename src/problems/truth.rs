//! What is known of a problem between its start and its end.

use crate::parameters::NormalControl;
use crate::reference::Shape;
use crate::reference::wear_tables::{
    CONE_CONSTANT_FORCE, ConstantForceRow, INITIAL_STICK_RATIO, PARABOLA_CONSTANT_DEPTH,
    PARABOLA_CONSTANT_FORCE,
};

/// A table of [`crate::reference::wear_tables`], which states its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum History {
    /// Nothing but the start, and the end where there is one.
    Unknown,
    /// (Ñ, V/(a₀² d₀)).
    Volume(&'static [(f64, f64)]),
    /// Depth, stick radius, volume and deepest wear at Ñ.
    ConstantForce(&'static [ConstantForceRow]),
    /// (S, p(0)/p_mean), S by [`super::Problem::reduced_path`].
    CentralPressure(&'static [(f64, f64)]),
    /// (S, w(0)/d₀).
    CentralWear(&'static [(f64, f64)]),
}

impl History {
    /// The table for a body in partial slip, if there is one.
    pub(super) fn of_partial_slip(body: &Shape, control: NormalControl, stick_ratio: f64) -> Self {
        if stick_ratio != INITIAL_STICK_RATIO {
            return Self::Unknown;
        }
        match (body, control) {
            (Shape::Parabola { .. }, NormalControl::Indentation) => Self::Volume(&PARABOLA_CONSTANT_DEPTH),
            (Shape::Parabola { .. }, NormalControl::Force) => Self::ConstantForce(&PARABOLA_CONSTANT_FORCE),
            (Shape::Cone { .. }, NormalControl::Force) => Self::ConstantForce(&CONE_CONSTANT_FORCE),
            _ => Self::Unknown,
        }
    }

    /// First column of the table: Ñ in partial slip, S in gross slip.
    pub fn places(&self) -> Vec<f64> {
        match *self {
            Self::Unknown => Vec::new(),
            Self::ConstantForce(rows) => rows.iter().map(|row| row.cycles).collect(),
            Self::Volume(rows) | Self::CentralPressure(rows) | Self::CentralWear(rows) => {
                rows.iter().map(|row| row.0).collect()
            }
        }
    }
}
