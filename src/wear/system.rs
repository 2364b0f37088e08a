//! The linear system of an implicit update, known by what it does to a vector, and an approximate
//! inverse.

use super::edge::Edge;
use super::{Constants, SlipFields};
use crate::surface::{NodeTransforms, outer_weight};
use crate::transform::{abel_last, dot, pressure_weight};

/// The operator 1 + κ E* B P S⁻¹ on depths at the nodes `first` to the edge.
pub(super) struct System<'a> {
    transforms: &'a NodeTransforms,
    x: &'a [f64],
    first: usize,
    edge: Edge,
    /// κ E* B at the nodes, m.
    stiffness: Vec<f64>,
    /// Pressure at the nodes of a uniform load and, at its end, of a change of the load there, 1/m.
    response: Vec<f64>,
    /// Weights of the mean of the image over the contact, by which the body sinks under a given
    /// force.
    mean: Option<Vec<f64>>,
}

impl<'a> System<'a> {
    pub(super) fn new(
        x: &'a [f64],
        transforms: &'a NodeTransforms,
        fields: &SlipFields,
        first: usize,
        edge: Edge,
        constants: &Constants,
    ) -> Self {
        let kappa = constants.wear_per_work * constants.friction_coefficient * constants.normal_modulus;
        Self {
            transforms,
            x,
            first,
            stiffness: fields.slip_path[first..=edge.last].iter().map(|path| kappa * path).collect(),
            response: (first..=edge.last).map(|i| edge.response(x, i)).collect(),
            mean: constants.force_control.then(|| depth_weights(x, &edge)),
            edge,
        }
    }

    pub(super) fn apply(&self, depth: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.x.len()];
        all[self.first..=self.edge.last].copy_from_slice(depth);
        let image = &self.transforms.abel(&all)[..=self.edge.last];
        let relief = self.transforms.pressure(image);
        let approach = self.mean.as_ref().map_or(0.0, |mean| dot(mean, image));
        let end = image[self.edge.last] - approach;
        let relief = relief[self.first..].iter().zip(&self.response).map(|(p, response)| p + end * response);
        depth.iter().zip(&self.stiffness).zip(relief).map(|((w, s), p)| w + s * p).collect()
    }

    /// Its approximate inverse.
    pub(super) fn levels(&self) -> Levels {
        Levels::new(&self.x[self.first..=self.edge.last], &self.stiffness)
    }
}

/// An approximate inverse of 1 + b|∂/∂x|, which is what the operator does to short waves: on nodes
/// of which every other is left out from level to level, what a level has beyond the next coarser
/// one is divided by 1 + b k, k being the wave number of its cells. So the number of iterations
/// hardly grows with that of the nodes (multilevel diagonal scaling, Bramble, Pasciak and Xu, Math.
/// Comp. 55 (1990), 1; Zhang, Numer. Math. 63 (1992), 521).
pub(super) struct Levels {
    /// From fine to coarse: weight of the coarse node before in the line through a node that is
    /// left out, and divisors.
    levels: Vec<Level>,
}

struct Level {
    /// For each odd node that has coarse nodes on either side: weight of the outer one.
    outer: Vec<f64>,
    divisor: Vec<f64>,
}

impl Levels {
    fn new(x: &[f64], stiffness: &[f64]) -> Self {
        let (mut x, mut stiffness) = (x.to_vec(), stiffness.to_vec());
        let mut levels = Vec::new();
        loop {
            let divisor = (0..x.len()).map(|i| 1.0 + stiffness[i] * wave_number(&x, i)).collect();
            if x.len() < 3 {
                levels.push(Level { outer: Vec::new(), divisor });
                return Self { levels };
            }
            let share = |i: usize| {
                let area = |a: f64, b: f64| (b - a) * (b + a);
                area(x[i - 1], x[i]) / area(x[i - 1], x[i + 1])
            };
            levels.push(Level { outer: (1..x.len() - 1).step_by(2).map(share).collect(), divisor });
            x = x.into_iter().step_by(2).collect();
            stiffness = stiffness.into_iter().step_by(2).collect();
        }
    }

    /// The approximate inverse of a vector.
    pub(super) fn relax(&self, right: &[f64]) -> Vec<f64> {
        let mut details = Vec::with_capacity(self.levels.len());
        let mut fine = right.to_vec();
        for level in &self.levels {
            if level.divisor.len() < 3 {
                break;
            }
            let coarse = level.restrict(&fine);
            let smooth = level.prolong(&coarse);
            let detail = fine.iter().zip(&smooth).zip(&level.divisor).map(|((f, s), d)| (f - s) / d);
            details.push(detail.collect::<Vec<f64>>());
            fine = coarse;
        }
        if let Some(last) = self.levels.last() {
            fine.iter_mut().zip(&last.divisor).for_each(|(f, d)| *f /= d);
        }
        for (level, detail) in self.levels.iter().zip(&details).rev() {
            fine = level.prolong(&fine);
            fine.iter_mut().zip(detail).for_each(|(f, detail)| *f += detail);
        }
        fine
    }
}

impl Level {
    /// Every other node: half of what it has and a quarter of each neighbour.
    fn restrict(&self, fine: &[f64]) -> Vec<f64> {
        let at = |i: usize| {
            if i == 0 || i + 1 >= fine.len() {
                fine[i]
            } else {
                0.25 * fine[i - 1] + 0.5 * fine[i] + 0.25 * fine[i + 1]
            }
        };
        (0..fine.len()).step_by(2).map(at).collect()
    }

    /// On the line (in x²) through the coarse nodes; beyond the last one as it is.
    fn prolong(&self, coarse: &[f64]) -> Vec<f64> {
        let fine = self.divisor.len();
        let at = |i: usize| {
            let inner = coarse[i / 2];
            match (i % 2, coarse.get(i / 2 + 1)) {
                (1, Some(outer)) => inner + self.outer[i / 2] * (outer - inner),
                _ => inner,
            }
        };
        (0..fine).map(at).collect()
    }
}

/// Pressure over depth of a hat at node i, 1/m.
fn wave_number(x: &[f64], i: usize) -> f64 {
    if x.len() < 2 {
        return 0.0;
    }
    // image that a depth of 1 at this node alone brings there
    let image = if i == 0 { 1.0 } else { abel_last(&x[i - 1..=i], &[0.0, 0.0], 1.0) };
    let outer = if i + 1 < x.len() { x[i + 1] } else { 2.0 * x[i] - x[i - 1] };
    pressure_weight(x[i], outer, x[i]) * image
}

/// Weights of the nodes in (1/a) ∫₀ᵃ h dx.
fn depth_weights(x: &[f64], edge: &Edge) -> Vec<f64> {
    let mut weights = vec![0.0; edge.last + 1];
    for j in 0..edge.last {
        let (width, outer) = (x[j + 1] - x[j], outer_weight(x[j], x[j + 1]));
        weights[j] += (1.0 - outer) * width / edge.radius;
        weights[j + 1] += outer * width / edge.radius;
    }
    weights[edge.last] += (edge.radius - x[edge.last]) / edge.radius;
    weights
}
