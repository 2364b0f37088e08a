//! The contact edge among nodes at rest, and its part in the pressure.

use crate::surface::{Contact, NodeTransforms, Nodes};
use crate::transform::leg;
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// What lies between the last node inside the contact and the contact edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// Index of the last node with x < a (x ≤ a where the body ends there).
    pub(crate) last: usize,
    /// Radius at which the load ends, m.
    pub(crate) radius: f64,
    /// Whether the load line jumps to zero at the last node (a body that ends there) instead of
    /// falling to zero at a.
    pub(crate) jump: bool,
}

impl Edge {
    /// The edge of a contact with `more` worn depth (m) on top of that of the nodes.
    ///
    /// Where the contact grows over nodes that have not worn, the image rises steeply behind the
    /// wear, and the line to the next node reaches the indentation depth too early. There the load
    /// ends where the worn depth, extended on a line from the last two nodes, comes to zero.
    pub(crate) fn new(nodes: &Nodes, more: &[f64], contact: &Contact, outer_radius: f64) -> Self {
        let (x, mut radius) = (nodes.x(), contact.radius);
        let jump = radius >= outer_radius;
        let last = x.partition_point(|&x| x < radius || (jump && x <= radius)).max(1) - 1;
        let depth = |i: usize| nodes.depth()[i] + more.get(i).copied().unwrap_or(0.0);
        if !jump && last > 0 && last + 1 < x.len() && depth(last + 1) == 0.0 {
            let fall = depth(last - 1) - depth(last);
            if fall > 0.0 {
                let end = x[last] + (x[last] - x[last - 1]) * depth(last) / fall;
                radius = radius.max(end.min(x[last + 1]));
            }
        }
        Self { last, radius, jump }
    }

    /// Weight of the load at the last node in the pressure at node i, 1/m, from the piece behind
    /// that node.
    pub(super) fn weight(&self, x: &[f64], i: usize) -> f64 {
        let (r, end) = (x[i], x[self.last]);
        if !self.jump {
            return FRAC_2_PI / (leg(self.radius, r) + leg(end, r));
        }
        if i < self.last {
            FRAC_1_PI / leg(end, r)
        } else {
            // the edge node stands for the outer half of its cell (in Z): mean of 1/√(b² − r²) over
            // that
            let inner = x[i - 1];
            let half = 0.5 * (end - inner) * (end + inner);
            FRAC_2_PI / half.sqrt()
        }
    }

    /// The same for a change of load there, which also moves the edge: q ≈ γ (a² − x²) keeps its
    /// slope.
    pub(super) fn response(&self, x: &[f64], i: usize) -> f64 {
        let weight = self.weight(x, i);
        if self.jump {
            return weight;
        }
        let (r, end) = (x[i], x[self.last]);
        let reach = leg(self.radius, r);
        let area = (self.radius - end) * (self.radius + end);
        if reach > 0.0 { weight * (1.0 - area / (2.0 * reach * (reach + leg(end, r)))) } else { weight }
    }
}

/// Transform of a load line given at the nodes up to the edge: p or τ at the nodes 0..=last.
pub(crate) fn pressure_nodes(transforms: &NodeTransforms, x: &[f64], load: &[f64], edge: &Edge) -> Vec<f64> {
    let mut pressure = Vec::new();
    let load = &mut load[..=edge.last].to_vec();
    pressure_nodes_into(transforms, (x, 0), (load, edge), (&mut pressure, &mut Vec::new()));
    pressure
}

/// [`pressure_nodes`] from one of them on in memory that is there.
pub(super) fn pressure_nodes_into(
    transforms: &NodeTransforms,
    (x, first): (&[f64], usize),
    (load, edge): (&mut Vec<f64>, &Edge),
    (pressure, buffer): (&mut Vec<f64>, &mut Vec<f64>),
) {
    transforms.pressure_at(first..edge.last + 1, load, pressure, buffer);
    pressure.truncate(edge.last + 1);
    for (i, p) in pressure.iter_mut().enumerate().skip(first) {
        *p += load[edge.last] * edge.weight(x, i);
    }
}
