//! The transpose of a pass that solves for its values: the same weights, read from back to front.

use super::{Expansions, Leaf, Step, Sweep};
use crate::transform::interpolation::{ORDER, Row, add_scaled, product};

impl Sweep {
    /// What [`super::Target::solve`] makes of sums, in a functional Σ fⱼ vⱼ of the values: `row`
    /// holds f and becomes its weights on the sums, and on the value at 0, which is given.
    pub(in crate::transform) fn solve_transposed(&self, row: &mut [f64], expansions: &mut Expansions) {
        for part in [&mut expansions.moments, &mut expansions.fields] {
            part.clear();
            part.resize(self.blocks, [0.0; ORDER]);
        }
        let (moments, fields) = (&mut expansions.moments[..], &mut expansions.fields[..]);
        let mut weights = Backward(&self.weights);
        for step in self.steps.iter().rev() {
            match step {
                Step::Field { block, parent, sources } => {
                    let field = fields[*block];
                    for &source in self.sources[sources.clone()].iter().rev() {
                        weights.add_product(&field, &mut moments[source]);
                    }
                    if let Some(parent) = *parent {
                        weights.add_product(&field, &mut fields[parent]);
                    }
                }
                Step::Moments { block, children } => {
                    let sum = moments[*block];
                    for &child in children.iter().rev() {
                        weights.add_product(&sum, &mut moments[child]);
                    }
                }
                Step::Leaf(leaf) => {
                    if leaf.emits {
                        let sum = moments[leaf.block];
                        for value in row[leaf.start..leaf.end + self.extra].iter_mut().rev() {
                            *value += product(weights.row(), &sum);
                        }
                    }
                    self.targets(leaf, row, &mut fields[leaf.block], &mut weights);
                }
            }
        }
    }

    fn targets(&self, leaf: &Leaf, row: &mut [f64], field: &mut Row, weights: &mut Backward<'_>) {
        for target in (leaf.start + 1..=leaf.end).rev() {
            let run = weights.take(target + self.extra - leaf.near);
            let (before, diagonal) = run.split_at(run.len() - 1);
            row[target] /= diagonal[0];
            let value = row[target];
            let mut take_off = |start: usize, weights: &[f64]| {
                row[start..start + weights.len()].iter_mut().zip(weights).for_each(|(r, w)| *r -= value * w);
            };
            take_off(leaf.near, before);
            for apart in self.apart[leaf.apart.clone()].iter().rev() {
                take_off(apart.start, weights.take(apart.len()));
            }
            if leaf.receives {
                add_scaled(-value, weights.row(), field);
            }
        }
    }
}

/// Weights not read yet, of which the last come first.
struct Backward<'a>(&'a [f64]);

impl<'a> Backward<'a> {
    fn take(&mut self, count: usize) -> &'a [f64] {
        let (rest, taken) = self.0.split_at(self.0.len() - count);
        self.0 = rest;
        taken
    }

    fn row(&mut self) -> &'a Row {
        let (rest, row) = self.0.split_last_chunk().expect("the steps match the weights");
        self.0 = rest;
        row
    }

    /// sum += M v, where the forward pass adds Mᵀ v.
    fn add_product(&mut self, vector: &Row, sum: &mut Row) {
        for sum in sum.iter_mut().rev() {
            *sum += product(self.row(), vector);
        }
    }
}
