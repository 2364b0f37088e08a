//! The Abel transforms by triangular matrices of exact weights: n²/2 numbers each, read in order.
//!
//! Under X → λX the inverse transform stays what it is and the pressure falls by 1/√λ, so the
//! tables of a disc of unit width serve all that have its shape.

use super::{Scratch, cell, dot};

/// Transforms on fixed nodes by full tables, O(n²).
#[derive(Debug, Clone)]
pub struct DenseAbel {
    nodes: usize,
    /// Row i: weights of the values at nodes 0 … i, from i = 1 on.
    inverse: Vec<f64>,
    /// Row i: weights of the drops over cells i … n − 1.
    pressure: Vec<f64>,
}

impl DenseAbel {
    /// Tabulates the weights for nodes X (m² or any unit), rising strictly from 0.
    pub fn new(nodes: &[f64]) -> Self {
        let last = nodes.len() - 1;
        let root: Vec<f64> = nodes.iter().map(|x| x.max(0.0).sqrt()).collect();
        let mut inverse = vec![0.0; last * (last + 3) / 2];
        let mut pressure = vec![0.0; last * (last + 1) / 2];
        let (mut rows, mut drops) = (&mut inverse[..], &mut pressure[..]);
        for i in 1..=last {
            let (row, rest) = rows.split_at_mut(i + 1);
            cell::add_inverse(nodes, &root, nodes[i], 0..i, row);
            rows = rest;
        }
        for i in 0..last {
            let (row, rest) = drops.split_at_mut(last - i);
            cell::pressure(nodes, nodes[i], i..last, row);
            drops = rest;
        }
        Self { nodes: nodes.len(), inverse, pressure }
    }

    /// Multiplications of one Abel transform or its inverse, and of one pressure.
    pub fn work(&self) -> (usize, usize) {
        (self.inverse.len(), self.pressure.len())
    }

    fn inverse_rows(&self) -> impl Iterator<Item = &[f64]> {
        (1..self.nodes).scan(&self.inverse[..], |rest, i| {
            let (row, tail) = rest.split_at(i + 1);
            *rest = tail;
            Some(row)
        })
    }

    /// As [`super::FastAbel::inverse_abel`].
    pub fn inverse_abel(&self, values: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        let base = values[0];
        let (shifted, _) = scratch.parts(self.nodes);
        for (shifted, value) in shifted.iter_mut().zip(values) {
            *shifted = value - base;
        }
        out[0] = base;
        for (i, row) in self.inverse_rows().enumerate() {
            out[i + 1] = base + dot(row, &shifted[..=i + 1]);
        }
    }

    /// As [`super::FastAbel::abel`].
    pub fn abel(&self, s: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        let base = s[0];
        out[0] = base;
        let (values, _) = scratch.parts(self.nodes);
        values[0] = 0.0;
        for (i, row) in self.inverse_rows().enumerate() {
            let target = i + 1;
            let known = dot(&row[..target], &values[..target]);
            values[target] = (s[target] - base - known) / row[target];
            out[target] = base + values[target];
        }
    }

    /// As [`super::FastAbel::pressure`].
    pub fn pressure(&self, q: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        let last = self.nodes - 1;
        let (drops, _) = scratch.parts(self.nodes);
        for (drop, pair) in drops.iter_mut().zip(q.windows(2)) {
            *drop = pair[0] - pair[1];
        }
        let mut rest = &self.pressure[..];
        for i in 0..last {
            let (row, tail) = rest.split_at(last - i);
            out[i] = dot(row, &drops[i..last]);
            rest = tail;
        }
        out[last] = 0.0;
    }
}
