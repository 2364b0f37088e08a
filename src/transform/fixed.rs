//! Transforms of one image that stays as it is, at any radius: O(log n) operations each.
//!
//! Blocks of a tree that lie at least their own width from the radius act through their moments
//! (see [`super::fast`]), the few cells next to it by exact weights.

use super::cell::image_weights;
use super::interpolation::{ORDER, POINTS, Row, add_scaled, product};
use super::leg;
use super::sweep::{Expansions, Sweep};
use super::tree::{Edge, Tree};
use std::f64::consts::PI;
use std::ops::Range;

/// An image piecewise linear in X = x² between given radii from 0 on.
#[derive(Debug, Clone)]
pub(crate) struct FixedImage {
    tree: Tree,
    /// Radii in units in which the outermost lies between 1 and 2.
    x: Vec<f64>,
    /// 1/unit, a power of 2, 1/m.
    scale: f64,
    /// m.
    image: Vec<f64>,
    /// Moments of the image less its value on the axis, for radii outside a block.
    outside: Vec<Row>,
    /// Moments of its slope, for radii inside of a block.
    inside: Vec<Row>,
}

/// The power of 2 that takes `outer` to between 1 and 2.
fn scale(outer: f64) -> f64 {
    // at either end of the range of numbers a little less will do
    (-outer.log2().floor()).clamp(-1000.0, 1000.0).exp2()
}

impl FixedImage {
    /// The image (m) whose profile has the given heights (m) at the given radii (m), which rise
    /// strictly from 0. It holds NaN or infinities where numbers overflow or squares of radii are
    /// too small to differ.
    pub(crate) fn through(radii: &[f64], heights: &[f64]) -> Self {
        let scale = scale(radii[radii.len() - 1]);
        let x: Vec<f64> = radii.iter().map(|r| r * scale).collect();
        let square: Vec<f64> = x.iter().map(|x| x * x).collect();
        let tree = Tree::new(&square);
        let mut image = vec![0.0; heights.len()];
        Sweep::inverse(&tree, &tree.pairs()).run(
            0..radii.len(),
            &mut image,
            &mut Expansions::default(),
            |target, image| image[target.index] = target.solve(heights[target.index] - heights[0], image),
        );
        let outside = tree.gather(Edge::Outer, |block, sums| {
            let mut values = image[tree.blocks[block].start..].iter();
            tree.inverse_moments(block, |row| {
                add_scaled(values.next().copied().unwrap_or_default(), &row, sums);
            });
        });
        let inside = tree.gather(Edge::Inner, |block, sums| {
            let mut pairs = image[tree.blocks[block].start..].windows(2);
            tree.pressure_moments(block, |row| {
                add_scaled(pairs.next().map_or(0.0, |pair| pair[1] - pair[0]), &row, sums);
            });
        });
        image.iter_mut().for_each(|g| *g += heights[0]);
        Self { tree, x, scale, image, outside, inside }
    }

    /// Image at the radii, m.
    pub(crate) fn values(&self) -> &[f64] {
        &self.image
    }

    /// Height f(r) of the profile, m; beyond the last radius that at the last.
    pub(crate) fn height(&self, r: f64) -> f64 {
        let r = (r * self.scale).min(self.x[self.x.len() - 1]);
        let base = self.image[0];
        let mut sum = 0.0;
        self.cover(0, 0.0, r, true, &mut |part| match part {
            Part::Far { block, gap } => {
                sum += product(&self.tree.seen_from(block, gap), &self.outside[block])
            }
            Part::Near { cells } => {
                for j in cells {
                    let (x0, x1) = (self.x[j], self.x[j + 1].min(r));
                    let width = (x1 - x0) * (x1 + x0);
                    let (inner, outer) = image_weights(width, (x0, leg(r, x0)), (x1, leg(r, x1)));
                    let (g0, g1) = (self.image[j] - base, self.image[j + 1] - base);
                    // the image at the end of a cell that r cuts
                    let cut = width / ((self.x[j + 1] - x0) * (self.x[j + 1] + x0));
                    sum += inner * g0 + outer * (g0 + cut * (g1 - g0));
                }
            }
        });
        base + sum
    }

    /// ∫ from r to a of g'(x) dx/√(x² − r²), 1; nothing beyond the last radius.
    pub(crate) fn slope_integral(&self, r: f64, a: f64) -> f64 {
        let (r, a) = (r * self.scale, (a * self.scale).min(self.x[self.x.len() - 1]));
        let mut sum = 0.0;
        self.cover(0, r, a, false, &mut |part| match part {
            Part::Far { block, gap } => {
                sum += PI * product(&self.tree.seen_from(block, gap), &self.inside[block]);
            }
            Part::Near { cells } => {
                for j in cells {
                    let (x0, x1) = (self.x[j], self.x[j + 1]);
                    let slope = (self.image[j + 1] - self.image[j]) / ((x1 - x0) * (x1 + x0));
                    let (x0, x1) = (x0.max(r), x1.min(a));
                    sum += 2.0 * slope * (x1 - x0) * (x1 + x0) / (leg(x1, r) + leg(x0, r));
                }
            }
        });
        sum * self.scale
    }

    /// Splits the cells between two radii into blocks that are far from the outer (`outward`) or
    /// the inner of the two, and ranges of cells.
    fn cover(&self, block: usize, from: f64, to: f64, outward: bool, sink: &mut impl FnMut(Part)) {
        let cells = &self.tree.blocks[block];
        let (start, end) = (self.x[cells.start], self.x[cells.end]);
        if end <= from || start >= to {
            return;
        }
        if start >= from && end <= to {
            let gap = if outward { (to - end) * (to + end) } else { (start - from) * (start + from) };
            if gap >= self.tree.width(block) {
                return sink(Part::Far { block, gap });
            }
        }
        match cells.children {
            Some(children) => children.iter().for_each(|&child| self.cover(child, from, to, outward, sink)),
            None => {
                let x = &self.x[cells.start..=cells.end];
                let first = x.partition_point(|&x| x <= from).saturating_sub(1);
                let last = x.partition_point(|&x| x < to).min(x.len() - 1);
                sink(Part::Near { cells: cells.start + first..cells.start + last });
            }
        }
    }
}

/// A part of the cells between two radii.
#[derive(Debug)]
enum Part {
    Far { block: usize, gap: f64 },
    Near { cells: Range<usize> },
}

impl Tree {
    /// 1/√|X − Z| at the points of a block whose facing edge lies `gap` from Z.
    fn seen_from(&self, block: usize, gap: f64) -> Row {
        let width = self.width(block);
        std::array::from_fn(|b| 1.0 / (gap + width * POINTS[b]).sqrt())
    }

    /// Moments of all blocks, from those of the leaves.
    fn gather(&self, edge: Edge, leaf: impl Fn(usize, &mut Row)) -> Vec<Row> {
        let mut moments = vec![[0.0; ORDER]; self.blocks.len()];
        // children stand behind their parents
        for block in (0..self.blocks.len()).rev() {
            if self.blocks[block].children.is_none() {
                leaf(block, &mut moments[block]);
            }
            if let (Some(parent), Some(rows)) = (self.blocks[block].parent, self.in_parent(block, edge)) {
                let own = moments[block];
                for (moment, row) in own.iter().zip(&rows) {
                    add_scaled(*moment, row, &mut moments[parent]);
                }
            }
        }
        moments
    }
}

#[cfg(test)]
mod tests;
