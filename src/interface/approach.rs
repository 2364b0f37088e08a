//! The approach at which all contacts together carry a force.
//!
//! Σ Fᵢ(d − zᵢ) = F_N. The stiffness of a contact grows with its depth, so that the sum is a
//! convex, rising function of d, and Newton's method has the slope Σ 2E* aᵢ from the contact radii.

use super::Interface;
use super::members::Loads;
use crate::error::Error;

/// Most steps of the search. Newton's method takes 2 or 3; bisection to the last digit would take
/// 60.
const MOST_STEPS: usize = 200;

/// An approach, and the normal stiffness near to it.
#[derive(Debug, Clone)]
pub(super) struct Approach {
    /// m.
    pub(super) value: f64,
    /// Σ ∂F/∂d, N/m.
    pub(super) stiffness: f64,
    /// Normal force of each contact, N: they add up to the force to rounding.
    pub(super) forces: Vec<f64>,
}

impl Interface {
    /// Sums of normal force (N) and stiffness (N/m) on the present profiles at an approach, m.
    pub(super) fn total_at(&self, approach: f64, loads: &mut Loads) -> Result<(f64, f64), Error> {
        self.members.loads(approach, loads)?;
        let (force, radius) = loads.iter().fold((0.0, 0.0), |sum, load| (sum.0 + load.0, sum.1 + load.1));
        Ok((force, self.force_scale() * radius))
    }

    /// The approach under a normal force > 0, N, from a first guess, m.
    ///
    /// # Errors
    /// Those of the contacts; [`Error::NoApproach`].
    pub(super) fn approach_under(&self, force: f64, guess: f64) -> Result<Approach, Error> {
        let touch = self.members.first_touch();
        let mut loads = Loads::new();
        let (mut low, mut high, mut refused) = (touch, f64::INFINITY, None);
        let mut value = if guess > touch { guess } else { touch + self.first_depth(force) };
        let found = |next: f64, value: f64, stiffness: f64, loads: &Loads| {
            let forces = self.members.forces(loads, next - value, force);
            Ok(Approach { value: next, stiffness, forces })
        };
        for _ in 0..MOST_STEPS {
            let resolved = 4.0 * f64::EPSILON * value.abs().max(touch.abs());
            let total = match self.total_at(value, &mut loads) {
                Ok(total) => total,
                // too deep for one of the contacts, which need not be where the approach ends
                Err(problem) => {
                    (high, refused) = (value, Some(problem));
                    if high - low <= resolved {
                        break;
                    }
                    value = 0.5 * (low + high);
                    continue;
                }
            };
            let (carried, stiffness) = total;
            let excess = carried - force;
            if excess == 0.0 {
                return found(value, value, stiffness, &loads);
            }
            if excess > 0.0 {
                high = value;
            } else {
                low = value;
            }
            let step = -excess / stiffness;
            let next = value + step;
            // its error is of second order in the step
            let small = f64::EPSILON.sqrt() * (value - touch);
            if (step.abs() <= small || step.abs() <= resolved) && next > touch {
                return found(next, value, stiffness, &loads);
            }
            if high - low <= resolved && refused.is_none() {
                return found(value, value, stiffness, &loads);
            }
            value = if next > low && next < high {
                next
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                touch + 2.0 * (value - touch)
            };
            if refused.is_some() && high - low <= resolved {
                break;
            }
        }
        let none = Error::NoApproach { force, contacts: self.members.summits().len() };
        Err(refused.unwrap_or(none))
    }

    /// Depth (m) at which the first contact alone, of an unworn profile, carries a force, N: more
    /// than all contacts need together.
    fn first_depth(&self, force: f64) -> f64 {
        let first = self.members.first();
        let profile = self.members.profile(first);
        let load = force / self.force_scale();
        let radius = profile.radius_at_load(load).unwrap_or(0.0);
        let depth = profile.image(radius);
        if depth > 0.0 && depth.is_finite() { depth } else { load.sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Interface, Parameters, Summit};

    /// The approach under each force is where the contacts carry it, from any guess.
    #[test]
    fn the_approach_carries_the_force() {
        let summits: Vec<_> = (0..50).map(|k| Summit::at_offset(1e-7 * f64::from(k * k))).collect();
        let interface = Interface::new(Parameters::default(), &summits).unwrap();
        let mut loads = Vec::new();
        for force in [1e-6, 1.0, 1e4] {
            for guess in [-1.0, 1e-9, 1e-3] {
                let found = interface.approach_under(force, guess).unwrap();
                let (carried, stiffness) = interface.total_at(found.value, &mut loads).unwrap();
                assert!((carried / force - 1.0).abs() < 1e-13, "{force} N from {guess} m: {carried} N");
                assert!((found.stiffness / stiffness - 1.0).abs() < 1e-7);
            }
        }
    }
}
