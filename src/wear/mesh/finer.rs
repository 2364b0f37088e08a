//! What a mesh has at its nodes and, with two parts a cell, half way between them in ξ.

use super::UnitMesh;
use super::weights::Places;
use crate::surface::Region;
use crate::transform::dot;

impl UnitMesh {
    /// Shares φ; one or two `parts` a cell here and below.
    pub(crate) fn shares(&self, parts: usize) -> Vec<f64> {
        let middle = |j: usize| self.places().rise(0.0, j as f64 + 0.5);
        self.with_middles(parts, &self.share, middle)
    }

    /// z, by the parabolas that D̂ takes.
    pub(crate) fn images(&self, parts: usize, z: &[f64]) -> Vec<f64> {
        let middle = |j: usize| self.places().weights(j, 0.5).map(|(k, weight)| weight * z[k]).sum();
        self.with_middles(parts, z, middle)
    }

    /// A depth, which is smooth in ξ: of fourth order, at the ends of third.
    pub(crate) fn depths(&self, parts: usize, w: &[f64]) -> Vec<f64> {
        let n = self.cells;
        let middle = |j: usize| match j {
            0 => w[0] + (w[1] - w[0]) * self.first_rise(),
            j if j + 1 == n => dot(&w[n - 2..], &[-0.125, 0.75, 0.375]),
            j => dot(&w[j - 1..j + 3], &[-0.0625, 0.5625, 0.5625, -0.0625]),
        };
        self.with_middles(parts, w, middle)
    }

    /// Share of the rise of a depth in the middle of the first cell: like √X from the stick edge
    /// on, like X from an axis.
    fn first_rise(&self) -> f64 {
        let share = self.places().rise(0.0, 0.5) / self.share[1];
        match self.region {
            Region::Annulus => share.sqrt(),
            Region::Disc => share,
        }
    }

    fn with_middles(&self, parts: usize, nodes: &[f64], middle: impl Fn(usize) -> f64) -> Vec<f64> {
        if parts == 1 {
            return nodes.to_vec();
        }
        (0..=2 * self.cells).map(|k| if k % 2 == 0 { nodes[k / 2] } else { middle(k / 2) }).collect()
    }

    fn places(&self) -> Places {
        Places { region: self.region, power: self.power, cells: self.cells }
    }
}
