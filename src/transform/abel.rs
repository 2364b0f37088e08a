//! Dense or fast, whichever is quicker for the number of nodes.

use super::dense::DenseAbel;
use super::fast::FastAbel;
use super::sweep::Expansions;
use std::ops::Range;

/// Number of nodes from which the fast transforms are the quicker ones. Measured with `cargo bench
/// --bench transforms`: at 128 cells both take 2 µs; at half as many the tables take a sixth less,
/// at twice as many the fast form a third less.
pub const CROSSOVER: usize = 129;

/// The Abel transforms on fixed nodes.
#[derive(Debug, Clone)]
pub enum Abel {
    /// By tables.
    Dense(DenseAbel),
    /// In O(n).
    Fast(FastAbel),
}

/// Memory that the transforms work in; one serves any number of them in turn.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    values: Vec<f64>,
    expansions: Expansions,
}

impl Scratch {
    /// Room for the values at `nodes` nodes; allocates at first use only.
    pub(super) fn parts(&mut self, nodes: usize) -> (&mut [f64], &mut Expansions) {
        if self.values.len() < nodes {
            self.values.resize(nodes, 0.0);
        }
        (&mut self.values[..nodes], &mut self.expansions)
    }
}

impl Abel {
    /// Prepares the transforms for nodes X (m² or any unit), rising strictly from 0.
    ///
    /// # Panics
    /// For fewer than two nodes.
    pub fn new(nodes: &[f64]) -> Self {
        if nodes.len() < CROSSOVER {
            Self::Dense(DenseAbel::new(nodes))
        } else {
            Self::Fast(FastAbel::new(nodes))
        }
    }

    /// Becomes [`Self::new`] of other nodes; tables do so in their own memory.
    pub(crate) fn renew(&mut self, nodes: &[f64]) {
        match self {
            Self::Dense(dense) if nodes.len() < CROSSOVER => dense.renew(nodes),
            _ => *self = Self::new(nodes),
        }
    }

    /// Multiplications of one Abel transform or its inverse, and of one pressure.
    pub fn work(&self) -> (usize, usize) {
        match self {
            Self::Dense(dense) => dense.work(),
            Self::Fast(fast) => fast.work(),
        }
    }

    /// As [`FastAbel::inverse_abel`].
    pub fn inverse_abel(&self, values: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        match self {
            Self::Dense(dense) => dense.inverse_abel(values, out, scratch),
            Self::Fast(fast) => fast.inverse_abel(values, out, scratch),
        }
    }

    /// [`Self::inverse_abel`] at some nodes, of values that are equal at all nodes before the
    /// first of them. What stands at other nodes is not to be used.
    pub(crate) fn inverse_abel_at(
        &self,
        targets: Range<usize>,
        values: &[f64],
        out: &mut [f64],
        scratch: &mut Scratch,
    ) {
        match self {
            Self::Dense(dense) => dense.inverse_abel_at(targets, values, out, scratch),
            Self::Fast(fast) => fast.inverse_abel_at(targets, values, out, scratch),
        }
    }

    /// As [`FastAbel::abel`].
    pub fn abel(&self, s: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        match self {
            Self::Dense(dense) => dense.abel(s, out, scratch),
            Self::Fast(fast) => fast.abel(s, out, scratch),
        }
    }

    /// As [`FastAbel::pressure`].
    pub fn pressure(&self, q: &[f64], out: &mut [f64], scratch: &mut Scratch) {
        match self {
            Self::Dense(dense) => dense.pressure(q, out, scratch),
            Self::Fast(fast) => fast.pressure(q, out, scratch),
        }
    }

    /// [`Self::pressure`] at some nodes, of a load that is constant from the last of them on. What
    /// stands at other nodes is not to be used.
    pub(crate) fn pressure_at(
        &self,
        targets: Range<usize>,
        q: &[f64],
        out: &mut [f64],
        scratch: &mut Scratch,
    ) {
        match self {
            Self::Dense(dense) => dense.pressure_at(targets, q, out, scratch),
            Self::Fast(fast) => fast.pressure_at(targets, q, out, scratch),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_give_the_same_on_either_side_of_the_crossover() {
        for nodes in [2, 3, CROSSOVER - 1, CROSSOVER] {
            let x: Vec<f64> = (0..nodes).map(|i| (i as f64 / (nodes - 1) as f64).powi(2)).collect();
            let (chosen, dense) = (Abel::new(&x), DenseAbel::new(&x));
            assert_eq!(matches!(chosen, Abel::Fast(_)), nodes >= CROSSOVER);
            let v: Vec<f64> = x.iter().map(|x| 1.0 + x.sin()).collect();
            let mut scratch = Scratch::default();
            let mut results = |transforms: &Abel| {
                let (mut s, mut p, mut back) = (vec![0.0; nodes], vec![0.0; nodes], vec![0.0; nodes]);
                transforms.inverse_abel(&v, &mut s, &mut scratch);
                transforms.pressure(&v, &mut p, &mut scratch);
                transforms.abel(&s, &mut back, &mut scratch);
                [s, p, back]
            };
            let (chosen, dense) = (results(&chosen), results(&Abel::Dense(dense)));
            for (a, b) in chosen.iter().flatten().zip(dense.iter().flatten()) {
                assert!((a - b).abs() < 1e-12, "{nodes} nodes: {a} {b}");
            }
            for (a, b) in chosen[2].iter().zip(&v) {
                assert!((a - b).abs() < 1e-12, "{nodes} nodes: {a} back from {b}");
            }
        }
    }

    /// Values that begin to change at a node, and a load that ends at another.
    #[test]
    fn some_nodes_have_the_values_that_they_have_among_all() {
        for (nodes, first, end) in
            [(100, 37, 81), (100, 1, 100), (300, 37, 38), (300, 90, 211), (300, 150, 300)]
        {
            let x: Vec<f64> = (0..nodes).map(|i| (i as f64 / (nodes - 1) as f64).powi(2)).collect();
            let transforms = Abel::new(&x);
            let values = |from: usize, to: usize| -> Vec<f64> {
                (0..nodes).map(|i| 1.0 + x[i.clamp(from, to)].sin()).collect()
            };
            let (slip, load) = (values(first - 1, nodes), values(0, end - 1));
            let mut scratch = Scratch::default();
            let (mut all, mut some) = (vec![0.0; nodes], vec![0.0; nodes]);
            transforms.inverse_abel(&slip, &mut all, &mut scratch);
            transforms.inverse_abel_at(first..end, &slip, &mut some, &mut scratch);
            let mut off: Vec<f64> = (first..end).map(|i| some[i] - all[i]).collect();
            transforms.pressure(&load, &mut all, &mut scratch);
            transforms.pressure_at(first..end, &load, &mut some, &mut scratch);
            off.extend((first..end).map(|i| some[i] - all[i]));
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{nodes} nodes, {first} to {end}");
        }
    }

    #[test]
    fn transforms_scale_with_the_width_of_the_mesh() {
        // what lets the tables of a unit mesh serve all meshes of its shape
        let share: Vec<f64> = (0..=300).map(|i| (f64::from(i) / 300.0).powi(2)).collect();
        let v: Vec<f64> = share.iter().map(|x| 1.0 + x.sin()).collect();
        let width = 2.25;
        let x: Vec<f64> = share.iter().map(|x| width * x).collect();
        let (unit, wide) = (Abel::new(&share), Abel::new(&x));
        let (mut a, mut b) = (vec![0.0; 301], vec![0.0; 301]);
        unit.inverse_abel(&v, &mut a, &mut Scratch::default());
        wide.inverse_abel(&v, &mut b, &mut Scratch::default());
        assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-12));
        unit.pressure(&v, &mut a, &mut Scratch::default());
        wide.pressure(&v, &mut b, &mut Scratch::default());
        let root = f64::sqrt(width);
        assert!(a.iter().zip(&b).all(|(a, b)| (a / root - b).abs() < 1e-10));
    }
}
