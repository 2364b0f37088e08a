//! Counted work: what a run has cost, independent of the machine.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Numbers of the costly operations since the contact was built.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Counters {
    /// Calls of `advance_to` and `advance_cycles` that succeeded.
    pub steps: u64,
    /// Solutions of the tangential contact, each along a straight piece of load and displacement.
    pub spring_walks: u64,
    /// Solutions of the normal contact.
    pub contact_solutions: u64,
    /// Abel transforms and their inverses (spring slip to surface slip, image to profile, and
    /// back).
    pub descent_transforms: u64,
    /// Pressure transforms.
    pub pressure_transforms: u64,
    /// Tabulations of the transforms for a new set of nodes.
    pub transform_tables: u64,
    /// Factorisations of the steps on the moving mesh.
    pub factorisations: u64,
    /// Updates of the worn profile.
    pub profile_updates: u64,
    /// Steps on the moving mesh that were rejected by the error control.
    pub rejected_steps: u64,
    /// Trial runs for the cycle at which a coating wears through.
    #[serde(default)]
    pub coating_trials: u64,
}

impl Counters {
    /// The sum of these and others.
    pub(crate) fn plus(self, other: &Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            spring_walks: self.spring_walks + other.spring_walks,
            contact_solutions: self.contact_solutions + other.contact_solutions,
            descent_transforms: self.descent_transforms + other.descent_transforms,
            pressure_transforms: self.pressure_transforms + other.pressure_transforms,
            transform_tables: self.transform_tables + other.transform_tables,
            factorisations: self.factorisations + other.factorisations,
            profile_updates: self.profile_updates + other.profile_updates,
            rejected_steps: self.rejected_steps + other.rejected_steps,
            coating_trials: self.coating_trials + other.coating_trials,
        }
    }
}

impl fmt::Display for Counters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} steps, {} tangential solutions, {} normal solutions, {} Abel and {} pressure transforms, {} transform \
             tables, {} factorisations, {} profile updates, {} rejected steps, {} coating trials",
            self.steps,
            self.spring_walks,
            self.contact_solutions,
            self.descent_transforms,
            self.pressure_transforms,
            self.transform_tables,
            self.factorisations,
            self.profile_updates,
            self.rejected_steps,
            self.coating_trials
        )
    }
}
