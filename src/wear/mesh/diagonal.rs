//! The diagonal of what turns a depth into the pressure that its image relieves, from nodes near
//! by.

use super::{Region, UnitMesh, density, weights};
use crate::transform::add_inverse;

/// Nodes outside a node that count. What is left out falls with the square of their number.
const REACH: usize = 6;

/// As [`UnitMesh::relief`].
pub(super) fn relief(mesh: &UnitMesh, rim: bool) -> Vec<f64> {
    let n = mesh.cells;
    let root: Vec<f64> = mesh.share.iter().map(|share| share.sqrt()).collect();
    let mut relief = vec![0.0; n + 1];
    for i in mesh.first()..=n {
        let last = (i + REACH).min(n);
        // column i of D̂⁻¹, down to there
        let mut z = [0.0; REACH + 1];
        for k in i..=last {
            let row = mesh.inverse_part(&root, i, k);
            let sum: f64 = row[..k - i].iter().zip(&z).map(|(weight, z)| weight * z).sum();
            z[k - i] = (f64::from(u8::from(k == i)) - sum) / row[k - i];
        }
        relief[i] = (i..=last).map(|j| mesh.pressure_entry(i, j, rim) * z[j - i]).sum();
    }
    relief
}

impl UnitMesh {
    /// D̂ at (k, j) for j from i to k.
    fn inverse_part(&self, root: &[f64], i: usize, k: usize) -> [f64; REACH + 1] {
        let mut part = [0.0; REACH + 1];
        if k == 0 {
            part[0] = if self.region == Region::Disc { 1.0 } else { 0.0 };
            return part;
        }
        let mut row = [0.0; REACH + 2];
        let start = i.saturating_sub(1);
        let row = &mut row[..=k - start];
        add_inverse(density(self.region), &self.share, root, self.share[k], start..k, row);
        part[..=k - i].copy_from_slice(&row[i - start..]);
        part
    }

    /// K̂ at (i, j).
    fn pressure_entry(&self, i: usize, j: usize, rim: bool) -> f64 {
        if j == self.cells {
            return if rim { self.rim[i] } else { 0.0 };
        }
        let own = weights::pressure_weight(&self.share, i, j);
        if j > i { own - weights::pressure_weight(&self.share, i, j - 1) } else { own }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_that_of_the_transforms() {
        for region in [Region::Annulus, Region::Disc] {
            for rim in [false, true] {
                let mesh = UnitMesh::graded(region, 96, 3.0, true);
                let relief = mesh.relief(rim);
                for i in mesh.first()..=96 {
                    let (mut w, mut z, mut p) = (vec![0.0; 97], vec![0.0; 97], vec![0.0; 97]);
                    w[i] = 1.0;
                    mesh.abel(&w, &mut z);
                    mesh.pressure(&z, rim, &mut p);
                    assert!(
                        (relief[i] - p[i]).abs() <= 0.02 * p[i].abs(),
                        "{region:?} {rim} {i}: {} {}",
                        relief[i],
                        p[i]
                    );
                }
            }
        }
    }
}
