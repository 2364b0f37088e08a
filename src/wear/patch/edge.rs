//! Where the contact ends: the square A of the radius that satisfies the condition for the edge,
//! and how that changes.

use super::Patch;
use crate::transform::dot;

/// Sensitivity of the condition that fixes the contact edge.
#[derive(Debug)]
pub(super) struct EdgeCondition {
    /// To the depths at the nodes.
    pub(super) depth: Vec<f64>,
    /// To A, at fixed depths inside.
    pub(super) radius_squared: f64,
}

impl Patch {
    /// w̃ at the contact edge.
    pub(crate) fn edge_depth(&self, a: f64) -> f64 {
        -self.depth_from_inside(a)
    }

    /// Residual of the condition for the edge: g(a) − d, or what the load lacks, from Σ edge·w̃ and
    /// Σ mean·w̃ over the nodes before the last.
    fn edge_residual(&self, radius_squared: f64, sums: (f64, f64)) -> f64 {
        let (a, span, end) = (radius_squared.sqrt(), self.span(radius_squared), self.cells());
        if a > self.body.profile().outer_radius() {
            return f64::INFINITY;
        }
        let (depth, mesh) = (self.edge_depth(a), &self.mesh);
        let z = sums.0 + mesh.edge_image[end] * depth;
        let h = z / self.scale(span, a);
        if !self.is_force() {
            return self.body.image(a) + h - self.motion.value;
        }
        let mean = sums.1 + mesh.mean_image[end] * depth;
        self.body.load(a) + a * h - self.inside_width - span.sqrt() * mean - self.motion.value
    }

    fn edge_sums(&self, depth: &[f64]) -> (f64, f64) {
        let end = self.cells();
        (dot(&self.mesh.edge_image[..end], &depth[..end]), dot(&self.mesh.mean_image[..end], &depth[..end]))
    }

    /// Slope of the residual in A, by a central difference, or from inside next to the end of the
    /// body.
    fn edge_slope(&self, radius_squared: f64, sums: (f64, f64)) -> f64 {
        let step = 1e-5 * self.span(radius_squared);
        let outer = if self.is_inside(radius_squared + step) { step } else { 0.0 };
        let rise = self.edge_residual(radius_squared + outer, sums)
            - self.edge_residual(radius_squared - step, sums);
        rise / (outer + step)
    }

    pub(super) fn is_inside(&self, radius_squared: f64) -> bool {
        radius_squared.sqrt() <= self.body.profile().outer_radius()
    }

    /// A that satisfies the condition for the edge, by Newton's method from a guess, else by
    /// bisection.
    pub(super) fn solve_area(&self, depth: &[f64], guess: f64) -> Option<f64> {
        if self.rim {
            return Some(guess);
        }
        let sums = self.edge_sums(depth);
        let mut radius_squared = guess;
        for _ in 0..8 {
            let change = -self.edge_residual(radius_squared, sums) / self.edge_slope(radius_squared, sums);
            if !(change.is_finite() && change.abs() <= 0.5 * self.span(radius_squared)) {
                break;
            }
            radius_squared += change;
            if change.abs() <= 1e-13 * radius_squared {
                return Some(radius_squared);
            }
        }
        self.bisect_area(guess, sums)
    }

    /// The residual rises with A: a bracket around a guess, then halves.
    fn bisect_area(&self, guess: f64, sums: (f64, f64)) -> Option<f64> {
        let inner = self.inner_radius * self.inner_radius;
        let span = self.span(guess);
        let (mut low, mut high) = (inner + 0.99 * span, inner + 1.01 * span);
        for _ in 0..60 {
            let ends = (self.edge_residual(low, sums), self.edge_residual(high, sums));
            if ends.0 <= 0.0 && ends.1 >= 0.0 {
                break;
            }
            if ends.0 > 0.0 {
                low = inner + 0.5 * (low - inner);
            }
            if ends.1 < 0.0 {
                high = inner + 1.5 * (high - inner);
            }
        }
        if !(self.edge_residual(low, sums) <= 0.0 && self.edge_residual(high, sums) >= 0.0) {
            return None;
        }
        while high - low > 1e-13 * high {
            let middle = 0.5 * (low + high);
            if self.edge_residual(middle, sums) > 0.0 { high = middle } else { low = middle }
        }
        Some(high)
    }

    pub(super) fn edge_condition(
        &self,
        depth: &[f64],
        radius_squared: f64,
        edge_scale: f64,
    ) -> EdgeCondition {
        let (n, span, a) = (self.cells(), self.span(radius_squared), radius_squared.sqrt());
        let mut row: Vec<f64> = if self.is_force() {
            let edge = self.mesh.edge_image.iter().zip(&self.mesh.mean_image);
            edge.map(|(edge, mean)| a * edge / edge_scale - span.sqrt() * mean).collect()
        } else {
            self.mesh.edge_image.iter().map(|edge| edge / edge_scale).collect()
        };
        row[n] = 0.0;
        EdgeCondition { depth: row, radius_squared: self.edge_slope(radius_squared, self.edge_sums(depth)) }
    }
}
