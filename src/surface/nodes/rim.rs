//! Nodes at the rim of a body that ends there, once it has worn.
//!
//! The pressure rises towards a sharp rim like the inverse root of the distance, for whose sake a
//! fan of cells is placed there. Wear that is deeper by w at the rim than at the axis takes that
//! load over some a (w/d)². In cells far narrower than this nothing is left to resolve, but each of
//! them leaves the contact on its own, and is a sharp rim itself for a while, whose pressure an
//! update cannot follow: a flat punch to and fro in gross slip was refused from some step on.

use super::Nodes;
use crate::profile::Profile;
use crate::transform;

/// Share of an even cell that the cells at the rim need not go above. With a quarter, a rim that
/// had come free of load touched again, and V under a load at twice the frequency of the motion was
/// up to 3.3 % too large; with half of the value it is the same, with twice 0.8 % too large.
const OF_EVEN: f64 = 0.05;

impl Nodes {
    /// These nodes without those that crowd at a worn rim under a contact of some depth (m); `None`
    /// where none do, or where the stick front (m) is among them. Image and depth stay at all
    /// others but the last, which takes what keeps the worn volume.
    pub(crate) fn spread_at_rim(&self, depth: f64, front: f64, profile: &Profile) -> Option<Self> {
        let (start, least) = self.relieved_rim(depth, profile)?;
        if front > start {
            return None;
        }
        let rim = self.last();
        let mut kept: Vec<usize> = Vec::with_capacity(rim + 1);
        for k in 0..rim {
            let inner = kept.last().map_or(f64::NEG_INFINITY, |&k: &usize| self.x[k]);
            let crowds = inner >= start && (self.x[k] - inner).min(self.x[rim] - self.x[k]) < least;
            if !crowds {
                kept.push(k);
            }
        }
        kept.push(rim);
        if kept.len() == self.x.len() {
            return None;
        }
        let mut nodes =
            Self::of_kept(&kept, [&self.x, &self.worn_image, &self.depth], self.resolution, profile);
        nodes.keep_volume_at_rim(self.worn_volume());
        nodes.update_integrals(profile);
        Some(nodes)
    }

    /// Where the last even cells of a body that ends at its last node begin, and the width that
    /// they need not go below, m.
    fn relieved_rim(&self, depth: f64, profile: &Profile) -> Option<(f64, f64)> {
        let worn = self.depth[self.last()] - self.depth[0];
        if !(self.reach_rim(profile) && worn > 0.0 && depth > 0.0) {
            return None;
        }
        let outer = profile.outer_radius();
        let even = outer / self.resolution as f64;
        let least = (outer * (worn / depth).powi(2)).min(OF_EVEN * even);
        Some((outer - 1.5 * even, least))
    }

    /// Takes the last node to the depth at which a volume (m³) has worn, no deeper than it is.
    fn keep_volume_at_rim(&mut self, volume: f64) {
        let last = self.last();
        let mut unit = vec![0.0; last + 1];
        unit[last] = 1.0;
        let more = (volume - self.worn_volume()) / self.volume(&unit);
        self.depth[last] = (self.depth[last] + more).max(0.0).min(self.depth[last]);
        self.worn_image[last] = transform::abel_last(&self.x, &self.worn_image, self.depth[last]);
    }
}
