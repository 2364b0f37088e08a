//! The Abel transforms on fixed nodes by triangular tables of exact weights: n²/2 numbers each,
//! read in order.
//!
//! Under X → λX the inverse transform stays what it is and the pressure falls by 1/√λ, so the
//! tables of a disc of unit width serve all that have its shape.

use super::{cell, dot};
use std::ops::Range;

/// The Abel transforms on fixed nodes. All of them work in a buffer, of which one serves any number
/// of them in turn: it is allocated at first use only.
#[derive(Debug, Clone, Default)]
pub struct Abel {
    /// Radii of the nodes.
    root: Vec<f64>,
    /// Row i: weights of the values at nodes 0 … i, from i = 1 on.
    inverse: Vec<f64>,
    /// Row i: weights of the drops over cells i … n − 1.
    pressure: Vec<f64>,
}

impl Abel {
    /// Tabulates the weights for nodes X (m² or any unit), rising strictly from 0.
    ///
    /// # Panics
    /// For no nodes.
    pub fn new(nodes: &[f64]) -> Self {
        let mut tables = Self::default();
        tables.renew(nodes);
        tables
    }

    /// Becomes [`Self::new`] of other nodes in its own memory.
    pub(crate) fn renew(&mut self, nodes: &[f64]) {
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

    fn nodes(&self) -> usize {
        self.root.len()
    }

    /// Inverse transform s(Zᵢ) = (1/π) ∫ v dX/√(X (Zᵢ − X)) from 0 to Zᵢ = Xᵢ, for v linear in X
    /// between the values given at the nodes.
    pub fn inverse_abel(&self, values: &[f64], out: &mut [f64], buffer: &mut Vec<f64>) {
        self.inverse_abel_at(0..self.nodes(), values, out, buffer);
    }

    /// [`Self::inverse_abel`] at some nodes, of values that are equal at all nodes before the
    /// first of them. What stands at other nodes is not to be used.
    pub(crate) fn inverse_abel_at(
        &self,
        targets: Range<usize>,
        values: &[f64],
        out: &mut [f64],
        buffer: &mut Vec<f64>,
    ) {
        // a constant is its own transform, and so it is to the last digit
        let (base, first) = (values[0], targets.start);
        let shifted = self.room(buffer);
        for (shifted, value) in shifted[targets.clone()].iter_mut().zip(&values[first..]) {
            *shifted = value - base;
        }
        out[0] = base;
        for i in first.max(1)..targets.end {
            out[i] = base + dot(&self.inverse[inverse_row(i)][first..], &shifted[first..=i]);
        }
    }

    /// The inverse of [`Self::inverse_abel`] by forward substitution: values whose inverse
    /// transform is `s` at the nodes.
    pub fn abel(&self, s: &[f64], out: &mut [f64], buffer: &mut Vec<f64>) {
        let base = s[0];
        out[0] = base;
        let values = self.room(buffer);
        values[0] = 0.0;
        for target in 1..self.nodes() {
            let row = &self.inverse[inverse_row(target)];
            let known = dot(&row[..target], &values[..target]);
            values[target] = (s[target] - base - known) / row[target];
            out[target] = base + values[target];
        }
    }

    /// Pressure −(1/π) ∫ q' dX/√(X − Zᵢ) from Zᵢ = Xᵢ to Xₙ, for q linear in X between the values
    /// given at the nodes; 0 at the last node.
    pub fn pressure(&self, q: &[f64], out: &mut [f64], buffer: &mut Vec<f64>) {
        self.pressure_at(0..self.nodes(), q, out, buffer);
    }

    /// [`Self::pressure`] at some nodes, of a load that is constant from the last of them on. What
    /// stands at other nodes is not to be used.
    pub(crate) fn pressure_at(
        &self,
        targets: Range<usize>,
        q: &[f64],
        out: &mut [f64],
        buffer: &mut Vec<f64>,
    ) {
        let (first, last) = (targets.start, targets.end - 1);
        let drops = self.room(buffer);
        for (drop, pair) in drops[first..].iter_mut().zip(q[targets].windows(2)) {
            *drop = pair[0] - pair[1];
        }
        for i in first..last {
            let row = &self.pressure[pressure_row(i, self.nodes() - 1)];
            out[i] = dot(&row[..last - i], &drops[i..last]);
        }
        out[last] = 0.0;
    }

    /// A value for each node.
    fn room<'a>(&self, buffer: &'a mut Vec<f64>) -> &'a mut [f64] {
        if buffer.len() < self.nodes() {
            buffer.resize(self.nodes(), 0.0);
        }
        &mut buffer[..self.nodes()]
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

#[cfg(test)]
mod tests;
