//! Weights of the transforms and integrals on a mesh of shares. On an annulus what is transformed
//! is a parabola in ξ over each cell, through the ends of the cell and one node more.
//!
//! For the image that node is the one before, so that the inverse Abel transform at a node has no
//! weight beyond it; for the pressure it is the one after. In the first cells, whose widths differ
//! by a power of ξ, and for the pressure in the last, data are linear in X.

use crate::quadrature::{GAUSS_3, gauss_legendre};
use crate::surface::Region;
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// Points in a cell, with the root of the kernel taken out: weights are exact to 1e-9.
const POINTS: usize = 8;

/// Where the nodes lie: φ = (p+1) ξᵖ − p ξᵖ⁺¹ at ξ = i/n.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    pub(super) region: Region,
    /// p.
    pub(super) power: i32,
    pub(super) cells: usize,
}

impl Places {
    /// Cells from the inner edge on in which data are linear in X: of an annulus they make up some
    /// 1e-4. On a disc, where that is exact for an unworn ball, they are all.
    fn lines(self) -> usize {
        match self.region {
            Region::Annulus => self.cells.div_ceil(8),
            Region::Disc => self.cells,
        }
    }

    /// dφ by a cell of ξ; ξ in cells here and below.
    pub(super) fn slope(self, xi: f64) -> f64 {
        let (n, per) = (self.cells as f64, 1.0 / self.cells as f64);
        let share = xi * per;
        // a few products, where powi is a call
        let power: f64 = (1..self.power).map(|_| share).product();
        f64::from(self.power * (self.power + 1)) * power * (n - xi) * per * per
    }

    /// φ at ξ + δ less φ at ξ, without cancellation: the rule is exact for the slope's degree.
    pub(super) fn rise(self, xi: f64, by: f64) -> f64 {
        let slope = |node: f64| self.slope(xi + 0.5 * by * (1.0 + node));
        0.5 * by * GAUSS_3.iter().map(|(node, weight)| weight * slope(*node)).sum::<f64>()
    }

    /// What z is integrated over, by a cell of ξ: dX on an annulus, 2 dx on a disc.
    fn measure(self, xi: f64) -> f64 {
        match self.region {
            Region::Annulus => self.slope(xi),
            Region::Disc => self.slope(xi) / self.rise(0.0, xi).sqrt(),
        }
    }

    /// Values in cell j of what is 1 at one node of j − 1, j, j + 1 and 0 at the others, a share s
    /// of the cell from its inner end. The image may jump at the stick edge, so that it has its
    /// outer value in all of the first cell there.
    fn values(self, j: usize, s: f64) -> [f64; 3] {
        if j == 0 && self.region == Region::Annulus {
            return [0.0, 0.0, 1.0];
        }
        if j < self.lines() {
            let outer = self.rise(j as f64, s) / self.rise(j as f64, 1.0);
            return [0.0, 1.0 - outer, outer];
        }
        [0.5 * s * (s - 1.0), (1.0 - s) * (1.0 + s), 0.5 * s * (s + 1.0)]
    }

    /// The nodes that the value at a place of cell j depends on, with their weights.
    pub(super) fn weights(self, j: usize, s: f64) -> impl Iterator<Item = (usize, f64)> {
        let values = self.values(j, s).into_iter().enumerate();
        // the first cell has no node before it
        values.skip(usize::from(j == 0)).map(move |(k, value)| (j + k - 1, value))
    }

    /// Adds `factor` times the value at a place of cell j to the weights of its nodes.
    fn add_value(self, row: &mut [f64], j: usize, s: f64, factor: f64) {
        self.weights(j, s).for_each(|(node, weight)| row[node] += factor * weight);
    }

    /// φ d/dφ at node i inside: the first of five nodes, and their weights, of fourth order in ξ
    /// where there are neighbours enough. On an annulus a depth goes like √φ where the image jumps
    /// at the stick edge; what is taken for smooth there is its share w/√φ, which is that of the
    /// first node from there on inward.
    pub(super) fn drift(self, i: usize) -> (usize, [f64; 5]) {
        let n = self.cells;
        if i == 0 || i == n {
            return (0, [0.0; 5]);
        }
        let (first, weights) = if i >= 2 && i + 2 <= n {
            (i - 2, [1.0 / 12.0, -2.0 / 3.0, 0.0, 2.0 / 3.0, -1.0 / 12.0])
        } else if i >= 4 {
            (i - 3, [-1.0 / 12.0, 0.5, -1.5, 5.0 / 6.0, 0.25])
        } else {
            (i - 1, [-0.5, 0.0, 0.5, 0.0, 0.0])
        };
        let share = |node: usize| self.rise(0.0, node as f64);
        let ratio = share(i) / self.slope(i as f64);
        let mut weights = weights.map(|weight| weight * ratio);
        if self.region == Region::Annulus {
            if first == 0 {
                (weights[0], weights[1]) = (0.0, weights[0] + weights[1]);
            }
            let nodes = first.max(1)..first + weights.len();
            nodes.for_each(|node| weights[node - first] *= (share(i) / share(node)).sqrt());
            weights[i - first] += 0.5;
        }
        (first, weights)
    }

    /// Columns of D̂ from the diagonal down: (1/π) ∫ z dX/√(Z − X) on an annulus,
    /// (2/π) ∫ z dx/√(r² − x²) on a disc.
    pub(super) fn inverse_table(self) -> Vec<f64> {
        let n = self.cells;
        let rule = gauss_legendre::<POINTS>();
        let mut table = vec![0.0; (n + 1) * (n + 2) / 2];
        if self.region == Region::Disc {
            table[0] = 1.0;
        }
        for i in 1..=n {
            let row = &mut table[i * (i + 1) / 2..][..=i];
            for j in 0..i {
                // ξ = i − t²
                let (near, far) = (((i - j - 1) as f64).sqrt(), ((i - j) as f64).sqrt());
                for (node, weight) in rule {
                    let t = 0.5 * (far + near) + 0.5 * (far - near) * node;
                    let (xi, room) = (i as f64 - t * t, -self.rise(i as f64, -t * t));
                    let kernel = (far - near) * weight * t * self.measure(xi) / room.sqrt();
                    self.add_value(row, j, xi - j as f64, FRAC_1_PI * kernel);
                }
            }
        }
        let column = |j: usize| (j..=n).map(move |i| i * (i + 1) / 2 + j);
        (0..=n).flat_map(column).map(|place| table[place]).collect()
    }

    /// Weights of widths, ∫ b q dx/√L, and of the volume over L. On an annulus the overlap of the
    /// bodies, and its product with a slip, vanish like powers of ξ and 1 − ξ at the edges, and the
    /// trapezoidal rule is nearly exact.
    pub(super) fn integrals(self) -> (Vec<f64>, Vec<f64>) {
        let n = self.cells;
        let rule = gauss_legendre::<POINTS>();
        let mut width = match self.region {
            Region::Annulus => (0..=n).map(|i| 0.5 * self.slope(i as f64)).collect(),
            Region::Disc => vec![0.0; n + 1],
        };
        let mut volume = vec![0.0; n + 1];
        for j in 0..n {
            for (node, weight) in rule {
                let s = 0.5 * (1.0 + node);
                let xi = j as f64 + s;
                let part = 0.5 * weight * self.measure(xi);
                let room = self.rise(xi, n as f64 - xi).sqrt();
                if self.region == Region::Disc {
                    self.add_value(&mut width, j, s, 0.5 * part);
                }
                self.add_value(&mut volume, j, s, 2.0 * part * room);
            }
        }
        (width, volume)
    }

    /// Columns of K̂ down to the diagonal, for a line that falls to zero at the end:
    /// −(1/π) ∫ dq/√(X − Z).
    pub(super) fn pressure_table(self) -> Vec<f64> {
        let n = self.cells;
        let rule = gauss_legendre::<POINTS>();
        let mut table = vec![0.0; (n + 1) * (n + 2) / 2];
        for i in 0..=n {
            let mut add = |j: usize, weight: f64| table[j * (j + 1) / 2 + i] += weight;
            for j in i..n {
                if j < self.lines() || j + 1 == n {
                    let to = |node: usize| self.rise(i as f64, (node - i) as f64).sqrt();
                    let weight = FRAC_2_PI / (to(j) + to(j + 1));
                    add(j, weight);
                    add(j + 1, -weight);
                    continue;
                }
                // ξ = i + t²
                let (near, far) = (((j - i) as f64).sqrt(), ((j + 1 - i) as f64).sqrt());
                for (node, weight) in rule {
                    let t = 0.5 * (far + near) + 0.5 * (far - near) * node;
                    let s = t * t - (j - i) as f64;
                    let kernel = (far - near) * weight * t / self.rise(i as f64, t * t).sqrt();
                    for (k, slope) in [s - 1.5, 2.0 - 2.0 * s, s - 0.5].into_iter().enumerate() {
                        add(j + k, -FRAC_1_PI * kernel * slope);
                    }
                }
            }
        }
        table
    }

    /// Last column of K̂ where the line does not fall to zero in the last cell but jumps at its
    /// end; `falling(i)` is that of a line which falls.
    pub(super) fn rim_column(self, falling: impl Fn(usize) -> f64) -> Vec<f64> {
        let n = self.cells;
        let column = |i: usize| {
            let room = self.rise(i as f64, (n - i) as f64);
            FRAC_1_PI / room.sqrt() + falling(i)
        };
        // the mean of q/(π √(1 − Z)) over the outer half of the last cell
        let last = FRAC_2_PI / (0.5 * self.rise((n - 1) as f64, 1.0)).sqrt();
        (0..n).map(column).chain([last]).collect()
    }
}
