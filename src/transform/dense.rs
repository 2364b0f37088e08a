//! The Abel transforms by triangular matrices of exact weights: n²/2 numbers each, read in order.
//!
//! Under X → λX the inverse transform stays what it is and the pressure falls by 1/√λ, so the
//! tables of a disc of unit width serve all that have its shape.

use super::{Scratch, cell, dot};
use std::ops::Range;

/// Transforms on fixed nodes by full tables, O(n²).
#[derive(Debug, Clone, Default)]
pub struct DenseAbel {
    /// Radii of the nodes.
    root: Vec<f64>,
    /// Row i: weights of the values at nodes 0 … i, from i = 1 on.
    inverse: Vec<f64>,
    /// Row i: weights of the drops over cells i … n − 1.
    pressure: Vec<f64>,
}

impl DenseAbel {
    /// Tabulates the weights for nodes X (m² or any unit), rising strictly from 0.
    pub fn new(nodes: &[f64]) -> Self {
        let mut tables = Self::default();
        tables.renew(nodes);
        tables
    }

    /// Becomes [`Self::new`] of other nodes in its own memory.
    pub(super) fn renew(&mut self, nodes: &[f64]) {
        let last = nodes.len() - 1;
        let Self { root, inverse, pressure } = self;
        root.clear();
        root.extend(nodes.iter().map(|x| x.max(0.0).sqrt()));
        inverse.clear();
        inverse.resize(last * (last + 3) / 2, 0.0);
        pressure.resize(last * (last + 1) / 2, 0.0);
        for i in 1..=last {
            cell::add_inverse(nodes, root, nodes[i], 0..i, &mut inverse[inverse_row(i)]);
        }
        for i in 0..last {
            cell::pressure(nodes, nodes[i], i..last, &mut pressure[pressure_row(i, last)]);
        }
    }

    /// Multiplications of one Abel transform or its inverse, and of one pressure.
    pub fn work(&self) -> (usize, usize) {
        (self.inverse.len(), self.pressure.len())
    }

    fn nodes(&self) -> usize {
        self.root.len()
    }

    /// As [`super::FastAbel::inverse_abel`].
    pub fn inverse_abel(&self, values: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        self.inverse_abel_at(0..self.nodes(), values, out, scratch);
    }

    /// As [`super::Abel::inverse_abel_at`].
    pub(super) fn inverse_abel_at(
        &self,
        targets: Range<usize>,
        values: &[f64],
        out: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let (base, first) = (values[0], targets.start);
        let (shifted, _) = scratch.parts(self.nodes());
        for (shifted, value) in shifted[targets.clone()].iter_mut().zip(&values[first..]) {
            *shifted = value - base;
        }
        out[0] = base;
        for i in first.max(1)..targets.end {
            out[i] = base + dot(&self.inverse[inverse_row(i)][first..], &shifted[first..=i]);
        }
    }

    /// As [`super::FastAbel::abel`].
    pub fn abel(&self, s: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        let base = s[0];
        out[0] = base;
        let (values, _) = scratch.parts(self.nodes());
        values[0] = 0.0;
        for target in 1..self.nodes() {
            let row = &self.inverse[inverse_row(target)];
            let known = dot(&row[..target], &values[..target]);
            values[target] = (s[target] - base - known) / row[target];
            out[target] = base + values[target];
        }
    }

    /// As [`super::FastAbel::pressure`].
    pub fn pressure(&self, q: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        self.pressure_at(0..self.nodes(), q, out, scratch);
    }

    /// As [`super::Abel::pressure_at`].
    pub(super) fn pressure_at(
        &self,
        targets: Range<usize>,
        q: &[f64],
        out: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let (first, last) = (targets.start, targets.end - 1);
        let (drops, _) = scratch.parts(self.nodes());
        for (drop, pair) in drops[first..].iter_mut().zip(q[targets].windows(2)) {
            *drop = pair[0] - pair[1];
        }
        for i in first..last {
            let row = &self.pressure[pressure_row(i, self.nodes() - 1)];
            out[i] = dot(&row[..last - i], &drops[i..last]);
        }
        out[last] = 0.0;
    }
}

/// Place of the weights of node i, from 1 on, in the table of the inverse transform.
fn inverse_row(i: usize) -> Range<usize> {
    (i - 1) * (i + 2) / 2..i * (i + 3) / 2
}

/// Place of the weights of a node before the last in the table of the pressure.
fn pressure_row(i: usize, last: usize) -> Range<usize> {
    let start = |i: usize| i * (2 * last + 1 - i) / 2;
    start(i)..start(i + 1)
}
