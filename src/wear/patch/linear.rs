//! The linear system (1 − γτ J) x = y of a step, as D̂ − γτ J D̂ in the unknowns z at the nodes
//! first ..= n, and its LU factors. At a moving edge its last row keeps the depth there.

use super::{EdgeCondition, Patch, Rate};
use crate::counters::Counters;
use crate::transform::{add, dot};
use crate::wear::mesh::UnitMesh;
use nalgebra::{DMatrix, DVectorViewMut, Dyn, LU};
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Length of a step over that of the one before, whose linear system serves it, too: the method is
/// of third order with any. However fast a mode relaxes, what is left of it is at most 0.72 of it
/// there; beyond 1.63 it would grow.
const KEPT: RangeInclusive<f64> = 0.5..=1.4;

/// The system, factorised.
#[derive(Debug)]
pub(in crate::wear) struct Linear {
    mesh: Arc<UnitMesh>,
    /// One past the last node whose depth is unknown.
    end: usize,
    /// γτ.
    pub(in crate::wear) gamma_step: f64,
    lu: LU<f64, Dyn, Dyn>,
    /// Change of the volume rate with z at all nodes.
    volume_row: Vec<f64>,
}

impl Linear {
    /// The system of a step of length τ, with γτ given; `None` where the matrix is singular.
    pub(in crate::wear) fn new(
        patch: &Patch,
        state: (&[f64], &Rate),
        gamma_step: f64,
        counters: &mut Counters,
    ) -> Option<Self> {
        counters.factorisations += 1;
        let (matrix, volume_row) = patch.matrix(state, gamma_step);
        let size = volume_row.len() - patch.mesh.first();
        let lu = DMatrix::from_vec(size, size, matrix).lu();
        let (mesh, end) = (patch.mesh.clone(), patch.end());
        lu.is_invertible().then_some(Self { mesh, end, gamma_step, lu, volume_row })
    }

    /// Whether it serves a step with γτ given: its unknowns are those of the patch.
    pub(in crate::wear) fn serves(&self, patch: &Patch, gamma_step: f64) -> bool {
        let is_same = self.mesh.kind() == patch.mesh.kind() && self.end == patch.end();
        is_same && KEPT.contains(&(gamma_step / self.gamma_step))
    }

    /// Replaces a right side at the nodes by the solution z, which is zero at a given inner edge.
    pub(in crate::wear) fn solve(&self, right: &mut [f64]) {
        let first = self.mesh.first();
        right[..first].fill(0.0);
        let unknowns = right.len() - first;
        // a regular system, as it was found to be
        self.lu.solve_mut(&mut DVectorViewMut::from_slice(&mut right[first..], unknowns));
    }

    /// Depths that belong to a solution z, zero at a moving edge.
    pub(in crate::wear) fn depth(&self, z: &[f64]) -> Vec<f64> {
        let mut depth = self.mesh.inverse_abel(z);
        depth[self.end..].fill(0.0);
        depth
    }

    /// Change of the volume rate with a solution z.
    pub(in crate::wear) fn volume_change(&self, z: &[f64]) -> f64 {
        dot(&self.volume_row, z)
    }
}

/// How the rates change with a moving edge.
#[derive(Debug)]
struct EdgeChange<'a> {
    condition: &'a EdgeCondition,
    /// Sensitivity of the condition to A with the nodes moving along.
    total: f64,
    /// Of the growth at the nodes, to A.
    growth: Vec<f64>,
    /// Of the volume rate, to A.
    volume: f64,
}

impl Patch {
    /// Columns of the matrix of a step of length τ, with γτ given, and how the volume rate changes
    /// with z.
    fn matrix(&self, (depth, rate): (&[f64], &Rate), gamma_step: f64) -> (Vec<f64>, Vec<f64>) {
        let (mesh, n, first, end) = (&*self.mesh, self.cells(), self.mesh.first(), self.end());
        let size = n + 1 - first;
        let (span, length) =
            (self.span(rate.radius_squared), self.length(rate.radius_squared, rate.excess).0);
        let root = span.sqrt();
        // how −γτ times the rates at the nodes change with the pressure, times √L, and with the
        // slip of the springs
        let wears = |i: usize| i < end && rate.surface_slip[i] > 0.0;
        let at_nodes = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let factor = -gamma_step * self.factor * rate.share;
            (0..=n).map(|i| if wears(i) { factor * value(i) } else { 0.0 }).collect()
        };
        let stiffness = at_nodes(&|i| rate.surface_slip[i] / root);
        let softening = at_nodes(&|i| rate.pressure[i]);
        let speed = -gamma_step * rate.area_rate * rate.drift_share / span;
        let edge = rate.edge.as_ref().map(|condition| self.edge_change(condition, depth, rate));
        let approach = self.is_force().then(|| self.approach_change(rate, &stiffness, &softening));
        let mut volume_row = vec![0.0; n + 1];
        let mut matrix = vec![0.0; size * size];
        for (j, column) in (first..).zip(matrix.chunks_exact_mut(size)) {
            // h = z/b, and so the overlap, which is zero at a moving edge
            let softness = 1.0 / rate.scale[j];
            let slips = rate.slip[j] > 0.0;
            if j < end {
                let weights = if j == n { &mesh.rim } else { mesh.pressure_column(j) };
                let rows = weights[first..].iter().zip(&stiffness[first..]);
                let rows = column.iter_mut().zip(rows);
                rows.for_each(|(entry, (weight, stiffness))| *entry = -stiffness * weight * softness);
                if slips {
                    volume_row[j] =
                        self.volume_weight(j, rate) * (rate.overlap[j] * rate.slip_fall[j] - rate.slip[j]);
                }
            }
            if slips {
                let rows = mesh.inverse_column(j).iter().zip(&softening[j..]);
                let rows = column[j - first..].iter_mut().zip(rows);
                let fall = rate.slip_fall[j];
                rows.for_each(|(entry, (weight, softening))| *entry += fall * softening * weight);
            }
            // the body sinks as it wears
            if let Some((growth, volume)) = &approach
                && (self.rim || j == n)
            {
                let approach_of_image = if self.rim { root * mesh.width[j] / length } else { softness };
                add(column, approach_of_image, &growth[first..]);
                volume_row[j] += approach_of_image * volume;
            }
            if let Some(edge) = &edge {
                add(column, speed, &mesh.drift_column(j)[first..]);
                let moved = -dot(&edge.condition.depth[first..], column) / edge.total;
                add(column, moved, &rate.drift[first..]);
                let radius_squared = self.area_change(j, rate) / edge.condition.radius_squared;
                if radius_squared != 0.0 {
                    add(column, -gamma_step * radius_squared, &edge.growth[first..]);
                    volume_row[j] += radius_squared * edge.volume;
                }
            }
            add(&mut column[j - first..], 1.0, mesh.inverse_column(j));
        }
        (matrix, volume_row)
    }

    /// How −γτ times the rates at the nodes, and the volume rate, change with the approach of the
    /// bodies, at a given image.
    fn approach_change(&self, rate: &Rate, stiffness: &[f64], softening: &[f64]) -> (Vec<f64>, f64) {
        let (mesh, n, end) = (&*self.mesh, self.cells(), self.end());
        let sensitivity = self.sensitivity(rate);
        let pressure = mesh.pressure(&vec![1.0; n + 1], self.rim);
        let slips: Vec<f64> = (0..=n).map(|j| if rate.slip[j] > 0.0 { rate.scale[j] } else { 0.0 }).collect();
        let falls: Vec<f64> = slips.iter().zip(&rate.slip_fall).map(|(b, fall)| b * fall).collect();
        let fall = mesh.inverse_abel(&falls);
        let growth = |i: usize| stiffness[i] * pressure[i] - sensitivity * softening[i] * fall[i];
        let volume = |j: usize| {
            let fall = rate.overlap[j] * rate.slip_fall[j];
            self.volume_weight(j, rate) * slips[j] * (rate.slip[j] - sensitivity * fall)
        };
        ((0..=n).map(growth).collect(), (0..end).map(volume).sum())
    }

    /// Part of the volume rate over q s of a spring, and over its b.
    fn volume_weight(&self, j: usize, rate: &Rate) -> f64 {
        2.0 * self.factor * self.span(rate.radius_squared).sqrt() * self.mesh.width[j]
    }

    /// How what fixes the contact edge changes with z at a node, with the opposite sign.
    fn area_change(&self, j: usize, rate: &Rate) -> f64 {
        let (n, root) = (self.cells(), self.span(rate.radius_squared).sqrt());
        let edge = if j == n { 1.0 / rate.scale[n] } else { 0.0 };
        if !self.is_force() {
            return -edge;
        }
        root * self.mesh.width[j] - self.length(rate.radius_squared, rate.excess).0 * edge
    }

    fn edge_change<'a>(&self, condition: &'a EdgeCondition, depth: &[f64], rate: &Rate) -> EdgeChange<'a> {
        let total = condition.radius_squared + dot(&condition.depth, &rate.drift);
        let step = 1e-6 * self.span(rate.radius_squared);
        let step = if self.is_inside(rate.radius_squared + step) { step } else { -step };
        let shifted = (depth.to_vec(), self.own_image(rate));
        let shifted = self.rate_at(shifted, rate.radius_squared + step, rate.excess);
        let growth = shifted.growth.iter().zip(&rate.growth).map(|(new, old)| (new - old) / step).collect();
        EdgeChange { condition, total, growth, volume: (shifted.volume_rate - rate.volume_rate) / step }
    }
}

#[cfg(test)]
mod tests;
