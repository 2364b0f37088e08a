//! The linear system (1 − γτ J) x = y of a step, in the depths.

use super::direct::Direct;
use super::multigrid::Multigrid;
use super::{EdgeCondition, Patch, Rate};
use crate::counters::Counters;
use crate::transform::dot;

/// The system, factorised or by what it does to depths.
#[derive(Debug)]
pub(in crate::wear) enum Linear<'a> {
    Direct(&'a Patch, Direct),
    Iterative(Box<Multigrid>),
}

impl<'a> Linear<'a> {
    /// The system of a step of length τ, with γτ given.
    pub(in crate::wear) fn new(
        patch: &'a Patch,
        state: (&[f64], &Rate),
        gamma_step: f64,
        counters: &mut Counters,
    ) -> Self {
        counters.factorisations += 1;
        match patch.mesh.tables() {
            Some(tables) => Self::Direct(patch, patch.matrix(state, gamma_step, tables)),
            None => Self::Iterative(Box::new(Multigrid::new(patch, state, gamma_step))),
        }
    }

    /// Depths with the given right side, zero at a moving edge, and the change of the volume rate
    /// that belongs to them; `None` where the matrix is singular.
    pub(in crate::wear) fn solve(&self, right: &[f64], counters: &mut Counters) -> Option<(Vec<f64>, f64)> {
        match self {
            Self::Direct(patch, direct) => direct.solve(patch, right),
            Self::Iterative(multigrid) => multigrid.solve(right, counters),
        }
    }
}

/// How the rates change with a moving edge.
#[derive(Debug)]
pub(super) struct EdgeChange {
    pub(super) condition: EdgeCondition,
    /// Sensitivity of the condition to A with the nodes moving along.
    pub(super) total: f64,
    /// Of the growth at the nodes, to A.
    pub(super) growth: Vec<f64>,
    /// Of the volume rate, to A.
    pub(super) volume: f64,
}

impl Patch {
    pub(super) fn edge_change(&self, depth: &[f64], rate: &Rate) -> EdgeChange {
        let condition = self.edge_condition(depth, rate.radius_squared, rate.scale[self.cells()]);
        let total = condition.radius_squared + dot(&condition.depth, &rate.drift);
        let step = 1e-6 * self.span(rate.radius_squared);
        let step = if self.is_inside(rate.radius_squared + step) { step } else { -step };
        let shifted = self.rate_at(depth, rate.radius_squared + step);
        let growth = shifted.growth.iter().zip(&rate.growth).map(|(new, old)| (new - old) / step).collect();
        EdgeChange { condition, total, growth, volume: (shifted.volume_rate - rate.volume_rate) / step }
    }
}

#[cfg(test)]
mod tests;
