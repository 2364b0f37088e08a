//! The system of a step on fine meshes, by what it does to depths in O(n) operations, solved by
//! iterations whose number does not grow with that of the cells.
//!
//! Wear levels a wave at a rate in proportion to its wave number, so that one which only just fits
//! on the mesh falls at a rate that each node knows by itself. Hence a step of relaxation takes
//! short waves off an error, and a mesh of half as many cells, which has every other node, the long
//! ones (multigrid; Brandt, Math. Comp. 31 (1977), 333). A cycle from the coarsest mesh, where the
//! system is solved directly, to the finest is the approximate inverse with which [`krylov`] solves
//! it.
//!
//! Two things need care, or the number of iterations grows. The contact edge's speed is a
//! functional of the growth, hence of third halves of a derivative of the depth next to the edge;
//! but the edge's condition gives its change by the depths alone, once as much is taken off the
//! right side (see [`level`]). And where next to nothing slips, the motion of the mesh is all that
//! couples its nodes: the relaxation has to include it.

mod level;

use super::{Patch, Rate};
use crate::counters::Counters;
use crate::transform::dot;
use crate::wear::krylov;
use level::Level;
use nalgebra::{DVector, Dyn, LU};

/// What may be left of the right side, in what it means for the image. Steps and errors of lives
/// are those of direct solutions up to 1e-3; at 1e-2 the error control sees it.
pub(super) const TOLERANCE: f64 = 1e-4;

/// Most iterations. A system that needs more is that of a step far too long.
const MOST_ITERATIONS: usize = 40;

/// Share of the change that would do for what is local to a node, taken by the step of relaxation
/// that ends a cycle. Measured: two steps spare a third of the iterations, but each then costs five
/// thirds.
const RELAXATION: f64 = 0.7;

/// The system on a mesh and those below it.
#[derive(Debug)]
pub(in crate::wear) struct Multigrid {
    /// From the finest.
    levels: Vec<Level>,
    coarsest: LU<f64, Dyn, Dyn>,
    /// Weights of γτ times the growth, and the weight of the change of A, in the change of the
    /// volume rate.
    volume: (Vec<f64>, f64),
    /// What is added to the right side, and its weights in how much of that.
    edge: Option<(Vec<f64>, Vec<f64>)>,
}

impl Multigrid {
    pub(super) fn new(patch: &Patch, (depth, rate): (&[f64], &Rate), gamma_step: f64) -> Self {
        let edge = (!patch.rim).then(|| patch.edge_change(depth, rate));
        let mut levels = vec![Level::finest(patch, rate, edge.as_ref(), gamma_step)];
        while let Some(coarser) = levels.last().and_then(Level::coarser) {
            levels.push(coarser);
        }
        let coarsest = levels[levels.len() - 1].matrix().lu();
        let weight = patch.span(rate.radius_squared) / gamma_step;
        let volume = patch.mesh.volume.depth.iter().map(|depth| weight * depth).collect();
        let volume = (volume, edge.as_ref().map_or(0.0, |edge| edge.volume));
        let edge = edge.map(|edge| {
            let weights =
                edge.condition.depth.iter().map(|depth| depth / edge.condition.radius_squared).collect();
            (rate.drift.clone(), weights)
        });
        Self { levels, coarsest, volume, edge }
    }

    /// As [`super::Linear::solve`].
    pub(super) fn solve(&self, right: &[f64], counters: &mut Counters) -> Option<(Vec<f64>, f64)> {
        self.solve_to(TOLERANCE, right, counters)
    }

    pub(super) fn solve_to(
        &self,
        tolerance: f64,
        right: &[f64],
        counters: &mut Counters,
    ) -> Option<(Vec<f64>, f64)> {
        let finest = &self.levels[0];
        let mut right = right.to_vec();
        right[..finest.first].fill(0.0);
        right[finest.end..].fill(0.0);
        if let Some((column, weights)) = &self.edge {
            let amount = dot(weights, &right);
            right.iter_mut().zip(column).for_each(|(right, column)| *right += amount * column);
        }
        let weights = finest.weights();
        let scaled = |v: &[f64]| -> Vec<f64> { v.iter().zip(&weights).map(|(v, w)| v * w).collect() };
        let unscaled = |v: &[f64]| -> Vec<f64> { v.iter().zip(&weights).map(|(v, w)| v / w).collect() };
        let (x, iterations) = krylov::solve(
            |x| scaled(&finest.apply(x)),
            |r| self.cycle(0, &unscaled(r)),
            &scaled(&right),
            (tolerance, MOST_ITERATIONS),
        )?;
        counters.solver_iterations += iterations;
        let change = finest.change(&x);
        let volume = dot(&self.volume.0, &change.growth) + self.volume.1 * change.radius_squared;
        Some((x, volume))
    }

    /// An approximate solution on a level.
    fn cycle(&self, level: usize, right: &[f64]) -> Vec<f64> {
        let here = &self.levels[level];
        if level + 1 == self.levels.len() {
            let mut x = DVector::from_column_slice(&right[here.first..here.end]);
            let mut whole = vec![0.0; right.len()];
            // of a singular system only the rest is solved, by relaxation
            if self.coarsest.solve_mut(&mut x) {
                whole[here.first..here.end].copy_from_slice(x.as_slice());
            }
            return whole;
        }
        let mut x = here.refined(&self.cycle(level + 1, &here.restricted(right)));
        here.relax(&mut x, right, RELAXATION);
        x
    }
}
