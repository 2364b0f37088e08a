//! The volume that a state carries, and the state that carries a little more.

use super::{Patch, Rate, State};
use crate::transform::dot;

/// Largest α or β by which depths may grow for a volume to be met. They oppose each other and are
/// some ten times the share by which the volume grows (8 to 11, measured): this is about 5 % of it,
/// what a new mesh may miss.
const MOST_GROWTH: f64 = 0.5;

impl Patch {
    /// Worn volume of all: the mesh, and the frozen parts on either side, m³.
    pub(crate) fn volume(&self, rate: &Rate) -> f64 {
        let inside = self.sources.integral(rate.radius_squared);
        // 4 ∫ h √(a² − x²) dx, of which the weights hold (2/π) ∫ h dx
        let inside = 2.0 * std::f64::consts::PI * inside;
        self.own_volume(rate) + inside + self.outside.volume_beyond(rate.radius_squared)
    }

    /// Worn volume that the mesh alone carries, m³.
    pub(crate) fn own_volume(&self, rate: &Rate) -> f64 {
        self.span(rate.radius_squared) * dot(&self.mesh.volume_of_image, &rate.image)
    }

    /// Worn depth outside the front at the nodes, m; 0 where nothing slips.
    pub(crate) fn depth_outside(&self, state: &State, rate: &Rate) -> Vec<f64> {
        let (first, end) = (self.mesh.first(), self.end());
        let at_edge = self.outside.depth_and_slope(rate.radius_squared).0;
        let own =
            |i: usize| if i < end { state.depth[i] + self.depth_from_inside(rate.radius[i]) } else { 0.0 };
        let depth = |i: usize| own(i) + at_edge * self.mesh.share[i];
        (0..=self.cells()).map(|i| if i >= first { depth(i) } else { 0.0 }).collect()
    }

    /// The state that carries a little more volume (m³) outside the front, and its rate. The depths
    /// grow by the share α φ + β φ², which leaves the contact edge where it is, and leaves the
    /// image smooth at both edges; one that is not takes many steps to recover from on narrow
    /// cells. `None` where that is no small change.
    pub(crate) fn with_volume(&self, state: &State, rate: &Rate, volume: f64) -> Option<(State, Rate)> {
        let rising = |depth: &[f64]| -> Vec<f64> {
            let edge = depth[self.cells()];
            depth.iter().zip(&self.mesh.share).map(|(depth, phi)| (depth - edge * phi) * phi).collect()
        };
        let first = rising(&self.depth_outside(state, rate));
        let second = rising(&first);
        let volume_of = |depth: &[f64]| self.span(rate.radius_squared) * dot(&self.mesh.volume, depth);
        let (alpha, beta) = if let Some(condition) = &rate.edge {
            let change = |depth: &[f64]| dot(&condition.depth, depth);
            let determinant = volume_of(&first) * change(&second) - volume_of(&second) * change(&first);
            (volume * change(&second) / determinant, -volume * change(&first) / determinant)
        } else {
            (volume / volume_of(&first), 0.0)
        };
        if !(alpha.abs() < MOST_GROWTH && beta.abs() < MOST_GROWTH) {
            return None;
        }
        let grown = |((depth, first), second): ((&f64, &f64), &f64)| depth + alpha * first + beta * second;
        let depth: Vec<f64> = state.depth.iter().zip(&first).zip(&second).map(grown).collect();
        let rate = self.rate(&depth, rate.radius_squared)?;
        Some((State { depth, radius_squared: rate.radius_squared }, rate))
    }
}
