//! Products with the tables of a mesh.

use std::array;

/// Rows whose sums are gathered together, in registers: as many as hide the time of an addition.
const ROWS: usize = 8;

/// A triangular matrix by blocks of rows.
#[derive(Debug)]
pub(super) struct RowBlocks(Vec<Block>);

/// Some rows of the matrix from their first column that is not zero on.
#[derive(Debug)]
struct Block {
    first: usize,
    columns: Vec<[f64; ROWS]>,
}

impl RowBlocks {
    /// The matrix with some number of rows and columns; rows beyond the last are zero.
    pub(super) fn new(size: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let block = |start: usize| {
            let column = |j: usize| -> [f64; ROWS] {
                array::from_fn(|row| if start + row < size { entry(start + row, j) } else { 0.0 })
            };
            let is_zero = |j: &usize| column(*j).iter().all(|entry| *entry == 0.0);
            let first = (0..size).take_while(is_zero).count();
            let end = size - (first..size).rev().take_while(is_zero).count();
            Block { first, columns: (first..end).map(column).collect() }
        };
        Self((0..size).step_by(ROWS).map(block).collect())
    }

    /// The product of a square matrix with x.
    pub(super) fn times(&self, x: &[f64]) -> Vec<f64> {
        let mut product = Vec::with_capacity(ROWS * self.0.len());
        self.0.iter().for_each(|block| product.extend_from_slice(&block.times(x)));
        product.truncate(x.len());
        product
    }
}

impl Block {
    fn times(&self, x: &[f64]) -> [f64; ROWS] {
        let mut sums = [0.0; ROWS];
        for (column, x) in self.columns.iter().zip(&x[self.first..]) {
            for row in 0..ROWS {
                sums[row] += column[row] * x;
            }
        }
        sums
    }
}
