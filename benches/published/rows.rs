//! A matrix whose rows are dense over a range of columns each: the transforms are triangular.

/// Accumulators of a dot product: as many as keep the vector units busy without reordering by the
/// compiler.
const LANES: usize = 8;

/// Row by row, without the zeros before and behind.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rows {
    values: Vec<f64>,
    /// Offset of the first value and its column.
    starts: Vec<(usize, usize)>,
}

impl Rows {
    /// `rows` gives, for each row, the first column and the values from there on.
    pub(crate) fn new(rows: impl Iterator<Item = (usize, Vec<f64>)>) -> Self {
        let mut all = Self::default();
        for (first, row) in rows {
            all.starts.push((all.values.len(), first));
            all.values.extend(row);
        }
        all
    }

    /// Row times `x`, of which only the columns `from..to` are not zero.
    pub(crate) fn dot(&self, row: usize, x: &[f64], from: usize, to: usize) -> f64 {
        let (offset, first) = self.starts[row];
        let end = self.starts.get(row + 1).map_or(self.values.len(), |next| next.0);
        let from = from.max(first);
        let to = to.min(first + (end - offset)).min(x.len());
        if from >= to {
            return 0.0;
        }
        dot(&self.values[offset + from - first..offset + to - first], &x[from..to])
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_chunks, b_chunks) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    let rest: f64 = a_chunks.remainder().iter().zip(b_chunks.remainder()).map(|(a, b)| a * b).sum();
    let mut lanes = [0.0; LANES];
    for (a, b) in a_chunks.zip(b_chunks) {
        for k in 0..LANES {
            lanes[k] += a[k] * b[k];
        }
    }
    rest + lanes.iter().sum::<f64>()
}
