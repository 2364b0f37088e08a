//! Stick and slip of the spring row where the body moves in both tangential directions: springs
//! deflected by a vector u, bounded by Coulomb's circle |u| ≤ b(x) = m (d − g(x)).
//!
//! Springs that slip turn towards the motion, each by its own bound ([`spring`]), so that the row
//! is no longer linear in g in a few pieces as in [`super::Springs`]: it is *sampled*, at radii
//! closer together towards the contact edge and where a front stood when the body left its
//! first line, and taken as linear in g between the samples. Then |u| ≤ b everywhere, for b is
//! linear in g and |u| convex, and |T| ≤ μF_N to rounding. Each sample is exact at constant load,
//! however long the line: a step may be split at will. Where the springs are stiffer along y than
//! along x, all lengths along y are multiplied by the ratio of the moduli, so that |u| is the force
//! over G*_x and the bound stays a circle; only slip, energy and derivatives know the ratio.
//! Sampling costs an error of at most 0.4/n² of μF_N per front. Along a line on which the load
//! changes b is taken to go evenly, as under depth control it does; under force control d is a
//! concave function of the force, db/ds only falls along any line and the mean of both ends is
//! wrong by the square of the change.

mod reading;
mod sampling;
mod spring;
mod walk;

pub(crate) use reading::{Standing, Tangent};
pub(crate) use sampling::{Resting, Samples};
pub(crate) use spring::norm;

use crate::surface::Place;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// One spring of the row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct PlanarKnot {
    pub(crate) place: Place,
    /// Displacement of the body at which this spring would be relaxed, m; along y times G*_y/G*_x.
    pub(crate) origin: Vector2<f64>,
}

/// The springs under the contact, from the axis to the contact edge.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PlanarRow {
    /// Distance of the even samples, m.
    spacing: f64,
    knots: Vec<PlanarKnot>,
}

impl PlanarRow {
    pub(crate) fn knots(&self) -> &[PlanarKnot] {
        &self.knots
    }

    /// Whether the distance of its samples is one.
    pub(crate) fn is_spaced(&self) -> bool {
        self.spacing >= 0.0 && self.spacing.is_finite()
    }

    /// Becomes a copy of another row in its own memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.spacing = other.spacing;
        self.knots.clone_from(&other.knots);
    }
}

#[cfg(test)]
mod tests;
