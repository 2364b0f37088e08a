//! LU factors of a small dense matrix, with partial pivoting.

use crate::transform::add;
use std::array;

/// Columns that are eliminated together: each entry beyond them is loaded and stored once for all.
const BLOCK: usize = 4;

/// The factors of a square matrix: a lower triangle, and an upper one whose diagonal is 1.
#[derive(Debug)]
pub(super) struct Lu {
    /// Column after column.
    factors: Vec<f64>,
    /// Reciprocals of the diagonal.
    inverses: Vec<f64>,
    /// The column with which column k was exchanged at step k.
    pivots: Vec<usize>,
}

impl Lu {
    /// Factors of a matrix of `size` columns, given one after the other; `None` where it is
    /// singular or holds what is no number.
    pub(super) fn new(mut factors: Vec<f64>, size: usize) -> Option<Self> {
        let (mut inverses, mut pivots) = (Vec::with_capacity(size), Vec::with_capacity(size));
        for start in (0..size).step_by(BLOCK) {
            let end = (start + BLOCK).min(size);
            for k in start..end {
                let at = |j: usize| factors[j * size + k].abs();
                let pivot = (k + 1..size).fold(k, |best, j| if at(j) > at(best) { j } else { best });
                let (done, rest) = factors.split_at_mut((k + 1) * size);
                let column = &mut done[k * size..];
                if pivot > k {
                    column.swap_with_slice(&mut rest[(pivot - k - 1) * size..][..size]);
                }
                let inverse = column[k].recip();
                if !inverse.is_finite() {
                    return None;
                }
                for other in rest.chunks_exact_mut(size) {
                    other[k] *= inverse;
                    let factor = other[k];
                    add(&mut other[k + 1..end], -factor, &column[k + 1..end]);
                }
                inverses.push(inverse);
                pivots.push(pivot);
            }
            // below the block: its own columns, then all others
            let (done, rest) = factors.split_at_mut(end * size);
            for k in start..end {
                let (done, rest) = done.split_at_mut((k + 1) * size);
                for other in rest.chunks_exact_mut(size) {
                    let factor = other[k];
                    add(&mut other[end..], -factor, &done[k * size + end..]);
                }
            }
            let mut block = done[start * size..].chunks_exact(size).map(|column| &column[end..]);
            let (Some(a), Some(b), Some(c), Some(d)) =
                (block.next(), block.next(), block.next(), block.next())
            else {
                // the last columns
                break;
            };
            for other in rest.chunks_exact_mut(size) {
                let factors: [f64; BLOCK] = array::from_fn(|m| other[start + m]);
                for ((((entry, a), b), c), d) in other[end..].iter_mut().zip(a).zip(b).zip(c).zip(d) {
                    *entry -= (factors[0] * a + factors[1] * b) + (factors[2] * c + factors[3] * d);
                }
            }
        }
        Some(Self { factors, inverses, pivots })
    }

    /// Replaces a right side by the solution.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let columns = self.factors.chunks_exact(x.len());
        for (k, (column, inverse)) in columns.clone().zip(&self.inverses).enumerate() {
            x[k] *= inverse;
            let factor = x[k];
            add(&mut x[k + 1..], -factor, &column[k + 1..]);
        }
        for (k, column) in columns.enumerate().rev() {
            let factor = x[k];
            add(&mut x[..k], -factor, &column[..k]);
        }
        self.pivots.iter().enumerate().rev().for_each(|(k, pivot)| x.swap(k, *pivot));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of a matrix without a diagonal, and its product with 1, 2, 3 …
    fn system(size: usize) -> (Vec<f64>, Vec<f64>) {
        let entry = |i: usize, j: usize| if i == j { 0.0 } else { ((7 * i + 3 * j * j) as f64).sin() };
        let matrix = (0..size * size).map(|k| entry(k % size, k / size)).collect();
        let product = |i: usize| (0..size).map(|j| entry(i, j) * (j + 1) as f64).sum();
        (matrix, (0..size).map(product).collect())
    }

    #[test]
    fn a_system_is_solved() {
        for size in [2, 3, 4, 5, 8, 41] {
            let (matrix, mut x) = system(size);
            Lu::new(matrix, size).expect("the matrix is regular").solve(&mut x);
            for (i, x) in x.iter().enumerate() {
                assert!((x / (i + 1) as f64 - 1.0).abs() < 1e-10, "{size}: {x} at {i}");
            }
        }
    }

    #[test]
    fn a_matrix_without_an_inverse_is_refused() {
        assert!(Lu::new(vec![1.0, 2.0, 2.0, 4.0], 2).is_none());
        assert!(Lu::new(vec![f64::NAN, 2.0, 2.0, 4.0], 2).is_none());
    }
}
