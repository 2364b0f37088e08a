//! The linear system (1 − γτ J) x = y of a step, as D̂ − γτ J D̂ in the unknowns z at the nodes
//! first ..= n, and its LU factors. At a moving edge its last row keeps the depth there.

use super::{EdgeCondition, Patch, Rate};
use crate::counters::Counters;
use crate::transform::dot;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// The system, factorised.
#[derive(Debug)]
pub(in crate::wear) struct Linear<'a> {
    patch: &'a Patch,
    lu: LU<f64, Dyn, Dyn>,
    /// Change of the volume rate with z.
    volume_row: Vec<f64>,
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
        let (matrix, volume_row) = patch.matrix(state, gamma_step);
        Self { patch, lu: matrix.lu(), volume_row }
    }

    /// Depths with the given right side, zero at a moving edge, and the change of the volume rate
    /// that belongs to them; `None` where the matrix is singular.
    pub(in crate::wear) fn solve(&self, right: &[f64]) -> Option<(Vec<f64>, f64)> {
        let mut unknowns = DVector::from_column_slice(&right[self.patch.mesh.first()..]);
        self.lu.solve_mut(&mut unknowns).then(|| {
            let change = dot(&self.volume_row, unknowns.as_slice());
            (self.patch.stage_depth(unknowns.as_slice()), change)
        })
    }
}

/// How the rates change with a moving edge.
#[derive(Debug)]
struct EdgeChange {
    condition: EdgeCondition,
    /// Sensitivity of the condition to A with the nodes moving along.
    total: f64,
    /// Of the growth at the nodes, to A.
    growth: Vec<f64>,
    /// Of the volume rate, to A.
    volume: f64,
}

impl Patch {
    /// The matrix of a step of length τ, with γτ given, and how the volume rate changes with z.
    fn matrix(&self, (depth, rate): (&[f64], &Rate), gamma_step: f64) -> (DMatrix<f64>, Vec<f64>) {
        let (mesh, n, first) = (&*self.mesh, self.cells(), self.mesh.first());
        let size = n + 1 - first;
        let (span, a) = (self.span(rate.radius_squared), rate.radius_squared.sqrt());
        let root = span.sqrt();
        let (factor, sensitivity) = (self.factor * rate.share, self.sensitivity(rate));
        let mut jacobian = vec![0.0; size * size];
        let mut volume_row = vec![0.0; size];
        // h = z/b; whether a spring slips; b of those that do
        let softness: Vec<f64> = rate.scale.iter().map(|b| 1.0 / b).collect();
        let slipping: Vec<f64> = rate.slip[first..].iter().map(|s| f64::from(u8::from(*s > 0.0))).collect();
        let sliding: Vec<f64> = slipping.iter().zip(&rate.scale[first..]).map(|(on, b)| on * b).collect();
        for i in first..self.end() {
            let row = &mut jacobian[(i - first) * size..(i - first + 1) * size];
            let (p, s) = (rate.pressure[i], rate.surface_slip[i]);
            if s > 0.0 {
                let weights = &mesh.pressure_row(i)[..n - i];
                let (stiffness, soft) = (factor * s / root, factor * p * self.bound_slope);
                let springs = row[i - first..].iter_mut().zip(weights).zip(&softness[i..]);
                springs.for_each(|((entry, weight), soft)| *entry -= stiffness * weight * soft);
                let mut uniform: f64 = weights.iter().sum();
                if self.rim {
                    row[n - first] -= stiffness * mesh.rim[i] * softness[n];
                    uniform += mesh.rim[i];
                }
                let inverse = &mesh.inverse_row(i)[first..];
                for ((entry, weight), slips) in row.iter_mut().zip(inverse).zip(&slipping) {
                    *entry += soft * weight * slips;
                }
                let moved = dot(inverse, &sliding[..inverse.len()]);
                // the body sinks as it wears
                let approach = stiffness * uniform - soft * moved * sensitivity;
                if self.is_force() && self.rim {
                    for (entry, width) in row.iter_mut().zip(&mesh.width[first..]) {
                        *entry += approach * root * width / a;
                    }
                } else if self.is_force() {
                    row[n - first] += approach * softness[n];
                }
            }
            for (sum, entry) in volume_row.iter_mut().zip(&*row) {
                *sum += span * mesh.volume[i] * entry;
            }
            if !self.rim && i > 0 {
                for (k, weight) in mesh.drift_weights(i) {
                    let speed = rate.area_rate * rate.drift_share * weight / span;
                    for (entry, inverse) in row.iter_mut().zip(&mesh.inverse_row(k)[first.min(k)..]) {
                        *entry += speed * inverse;
                    }
                }
            }
        }
        if !self.rim {
            self.add_edge_terms(depth, rate, &mut jacobian, &mut volume_row);
        }
        jacobian.iter_mut().for_each(|entry| *entry *= -gamma_step);
        for i in first..=n {
            let row = &mut jacobian[(i - first) * size..];
            row.iter_mut().zip(&mesh.inverse_row(i)[first..]).for_each(|(entry, weight)| *entry += weight);
        }
        (DMatrix::from_row_slice(size, size, &jacobian), volume_row)
    }

    /// What the movement of the edge adds: the drift of the nodes, and the change of all fields
    /// with A.
    fn add_edge_terms(&self, depth: &[f64], rate: &Rate, jacobian: &mut [f64], volume_row: &mut [f64]) {
        let (mesh, n, first) = (&*self.mesh, self.cells(), self.mesh.first());
        let size = n + 1 - first;
        let span = self.span(rate.radius_squared);
        let edge = self.edge_change(depth, rate);
        let mut acceleration = vec![0.0; size];
        for i in first..n {
            let row = &jacobian[(i - first) * size..(i - first + 1) * size];
            for (sum, entry) in acceleration.iter_mut().zip(row) {
                *sum -= edge.condition.depth[i] / edge.total * entry;
            }
        }
        let mut area_row = vec![0.0; size];
        if self.is_force() {
            for j in first..=n {
                area_row[j - first] = span.sqrt() * mesh.width[j] / edge.condition.radius_squared;
            }
            area_row[n - first] -= rate.radius_squared.sqrt() / rate.scale[n] / edge.condition.radius_squared;
        } else {
            area_row[n - first] = -1.0 / rate.scale[n] / edge.condition.radius_squared;
        }
        for (entry, radius_squared) in volume_row.iter_mut().zip(&area_row) {
            *entry += edge.volume * radius_squared;
        }
        for i in first..n {
            let row = &mut jacobian[(i - first) * size..(i - first + 1) * size];
            for j in 0..size {
                row[j] += rate.drift[i] * acceleration[j] + edge.growth[i] * area_row[j];
            }
        }
    }

    /// Depths of a solution z of the stage's system; zero at a moving edge.
    fn stage_depth(&self, z: &[f64]) -> Vec<f64> {
        let (n, first) = (self.cells(), self.mesh.first());
        let mut full = vec![0.0; n + 1];
        full[first..].copy_from_slice(z);
        let mut depth = vec![0.0; n + 1];
        self.mesh.inverse_abel(&full, &mut depth);
        if !self.rim {
            depth[n] = 0.0;
        }
        depth
    }

    fn edge_change(&self, depth: &[f64], rate: &Rate) -> EdgeChange {
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
