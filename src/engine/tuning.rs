//! Numbers of the engine that were found by trial, all in one place.
//!
//! They trade time for accuracy or say when two ways of computing are exchanged. Results hold when
//! any of them is halved or doubled: the tests below do that. What else is a number in the engine
//! is a limit of iterations, a size of rounding, or the order of a formula.

/// Values that were found by trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tuning {
    /// How much more than the limit between two updates may wear where an update can wait for the
    /// next reversal: while the load hardly changes, so that strokes make nearly one law however
    /// many they are.
    pub(super) stroke: f64,
    /// Share of what the slip zone can lose that one update of a steady motion wears off at most.
    pub(super) steady_share: f64,
    /// An annulus that slips is taken to be at least this share of the contact radius wide: what
    /// little wears in a thinner one need not be followed at once.
    pub(super) least_width: f64,
    /// Largest share of the work of an update by which deferred work may add to it: much of it at
    /// one place would dig a groove there.
    pub(super) placed_with: f64,
    /// Largest change of load, relative to the larger one, over which slip wears under one depth,
    /// and the body behind a rig is taken to move evenly, and the bound of springs in the plane;
    /// and of the depth, over which an update can wait for the next reversal.
    pub(super) load_share: f64,
    /// Largest change of √F_N, relative to the larger one, over which the depth is taken for a
    /// parabola in F_N. The error of the friction work is of second order in it, 6e-5 in random
    /// histories.
    pub(super) root_share: f64,
    /// Largest change of the coefficient of friction, relative, that one update of the profile
    /// spans while friction runs in.
    pub(super) drift: f64,
    /// How far a body behind a rig may be from the chord halfway, over the displacement of full
    /// slip.
    pub(super) bent: f64,
    /// Width of the cells of a former mesh, over ΔV/(π a d), some way of the contact edge, that an
    /// update may find there.
    pub(super) way_of_edge: f64,
    /// Samples of a row in the plane for each cell of the resolution, across the contact.
    pub(super) samples_per_cell: usize,
}

/// Those of all contacts.
pub(super) const USUAL: Tuning = Tuning {
    stroke: 20.0,
    steady_share: 5e-4,
    least_width: 0.1,
    placed_with: 0.25,
    load_share: 0.05,
    root_share: 0.15,
    drift: 0.02,
    bent: 3e-4,
    way_of_edge: 8.0,
    samples_per_cell: 2,
};

#[cfg(test)]
mod tests;
