//! Where the contact ends: the square A of the radius that satisfies the condition for the edge,
//! and how that changes.

use super::Patch;
use super::load::Excess;
use crate::roots;
use crate::surface::Region;
use crate::transform::dot;

/// Sensitivity of the condition that fixes the contact edge.
#[derive(Debug, Clone)]
pub(super) struct EdgeCondition {
    /// To the depths at the nodes.
    pub(super) depth: Vec<f64>,
    /// To A, at fixed depths inside.
    pub(super) radius_squared: f64,
}

impl Patch {
    /// Depth of the state at the contact edge, and its slope in A.
    pub(super) fn edge_depth(&self, radius_squared: f64) -> (f64, f64) {
        let (depth, slope) = self.sources.depth_and_slope(radius_squared);
        (-depth, -slope)
    }

    /// Residual of the condition for the edge, g(a) − d or what the load lacks, and its slope in A,
    /// from Σ edge·depth and Σ mean·depth over the nodes before the last.
    fn edge_residual(&self, radius_squared: f64, sums: (f64, f64), excess: Option<Excess>) -> (f64, f64) {
        let end = self.cells();
        let (depth, slope) = self.edge_depth(radius_squared);
        let sums = (sums.0 + self.mesh.edge_image[end] * depth, sums.1 + self.mesh.mean_image[end] * depth);
        self.edge_residual_of(radius_squared, sums, slope, excess)
    }

    /// The same from z at the edge that belongs to the depths, its mean Σ width·z, and the slope of
    /// the depth there in A.
    fn edge_residual_of(
        &self,
        radius_squared: f64,
        (edge_image, mean): (f64, f64),
        depth_slope: f64,
        excess: Option<Excess>,
    ) -> (f64, f64) {
        let (a, span, end) = (radius_squared.sqrt(), self.span(radius_squared), self.cells());
        let (outside, outside_slope) = self.outside.depth_and_slope(radius_squared);
        if a > self.body.profile().outer_radius() {
            return (f64::INFINITY, f64::NAN);
        }
        let (mesh, scale) = (&self.mesh, self.scale(span, a));
        let h = (edge_image + outside * mesh.image_of_share[end]) / scale;
        let mean = mean + outside * mesh.mean_of_share;
        let change = |of_depth: f64, of_share: f64| of_depth * depth_slope + of_share * outside_slope;
        // 1/b is a/√L on an annulus
        let stretch = match mesh.region {
            Region::Annulus => 0.5 / radius_squared - 0.5 / span,
            Region::Disc => 0.0,
        };
        let h_slope = change(mesh.edge_image[end], mesh.image_of_share[end]) / scale + h * stretch;
        if !self.is_force() {
            let body_slope = 0.5 * self.body.image_slope(a) / a;
            return (self.body.image(a) + h - self.motion.value, body_slope + h_slope);
        }
        let root = span.sqrt();
        let (length, length_slope) = self.length(radius_squared, excess);
        let worn = length * h - self.inside_width - root * mean;
        let mean_slope = root * change(mesh.mean_image[end], mesh.mean_of_share) + 0.5 * mean / root;
        let worn_slope = length_slope * h + length * h_slope - mean_slope;
        let (load, load_slope) = self.body_load(radius_squared, excess);
        (load + worn - self.motion.value, load_slope + worn_slope)
    }

    fn edge_sums(&self, depth: &[f64]) -> (f64, f64) {
        let end = self.cells();
        (dot(&self.mesh.edge_image[..end], &depth[..end]), dot(&self.mesh.mean_image[..end], &depth[..end]))
    }

    pub(super) fn is_inside(&self, radius_squared: f64) -> bool {
        radius_squared.sqrt() <= self.body.profile().outer_radius()
    }

    /// A that satisfies the condition for the edge, by Newton's method from a guess, else by
    /// bisection.
    pub(super) fn solve_area(&self, depth: &[f64], guess: f64, excess: Option<Excess>) -> Option<f64> {
        if self.rim {
            return Some(guess);
        }
        let sums = self.edge_sums(depth);
        let mut radius_squared = guess;
        for _ in 0..8 {
            let (residual, slope) = self.edge_residual(radius_squared, sums, excess);
            let change = -residual / slope;
            if !(change.is_finite() && change.abs() <= 0.5 * self.span(radius_squared)) {
                break;
            }
            radius_squared += change;
            // the next change would be about the square of this one, both over L
            if change.abs() <= 1e-8 * self.span(radius_squared) {
                return Some(radius_squared);
            }
        }
        self.bisect_area(guess, sums, excess)
    }

    /// The residual rises with A: a bracket around a guess, then the root in it.
    fn bisect_area(&self, guess: f64, sums: (f64, f64), excess: Option<Excess>) -> Option<f64> {
        let inner = self.inner_radius * self.inner_radius;
        let span = self.span(guess);
        let (mut low, mut high) = (inner + 0.99 * span, inner + 1.01 * span);
        let residual = |radius_squared: f64| self.edge_residual(radius_squared, sums, excess).0;
        for _ in 0..60 {
            let ends = (residual(low), residual(high));
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
        if !(residual(low) <= 0.0 && residual(high) >= 0.0) {
            return None;
        }
        Some(roots::of_rising(low, high, |radius_squared| self.edge_residual(radius_squared, sums, excess)))
    }

    /// The condition at given depths, of which that at the edge has the given slope in A, and at z
    /// there that belongs to them.
    pub(super) fn edge_condition(
        &self,
        (depth, edge_image): (&[f64], f64),
        radius_squared: f64,
        (depth_slope, excess): (f64, Option<Excess>),
    ) -> EdgeCondition {
        let (mesh, n, a) = (&*self.mesh, self.cells(), radius_squared.sqrt());
        let (span, is_force) = (self.span(radius_squared), self.is_force());
        let scale = self.scale(span, a);
        let mut row: Vec<f64> = if is_force {
            let length = self.length(radius_squared, excess).0;
            let edge = mesh.edge_image.iter().zip(&mesh.mean_image);
            edge.map(|(edge, mean)| length * edge / scale - span.sqrt() * mean).collect()
        } else {
            mesh.edge_image.iter().map(|edge| edge / scale).collect()
        };
        row[n] = 0.0;
        let mean = if is_force { dot(&mesh.mean_image, depth) } else { 0.0 };
        let (_, slope) = self.edge_residual_of(radius_squared, (edge_image, mean), depth_slope, excess);
        EdgeCondition { depth: row, radius_squared: slope }
    }
}
