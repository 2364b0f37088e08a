//! The cells of a row of nodes in a binary tree, and which pairs of its blocks see each other
//! smoothly.

use super::interpolation::{ORDER, POINTS, Row, add_scaled, lagrange, of_lagrange, polynomials};
use crate::quadrature::gauss_legendre;
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};
use std::ops::Range;
use std::sync::LazyLock;

/// Most cells of a leaf.
const LEAF: usize = 24;

/// Cells `start..end`; children (inner, outer) where there are more than a leaf takes.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) parent: Option<usize>,
    pub(super) children: Option<[usize; 2]>,
}

/// Edge of a block from which τ counts: the one that faces the other block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Edge {
    Inner,
    Outer,
}

/// Blocks in the order root, inner half, outer half.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    /// Nodes X, rising strictly.
    pub(super) square: Vec<f64>,
    /// √X.
    pub(super) root: Vec<f64>,
    pub(super) blocks: Vec<Block>,
}

/// Pairs of blocks (outer, inner) that cover all pairs of cells but those within one leaf.
#[derive(Debug, Clone, Default)]
pub(super) struct Pairs {
    /// The gap is at least as wide as either block.
    pub(super) far: Vec<(usize, usize)>,
    /// Leaves that are closer.
    pub(super) near: Vec<(usize, usize)>,
}

impl Tree {
    pub(super) fn new(square: &[f64]) -> Self {
        assert!(square.len() > 1, "a transform needs two nodes or more");
        let root = square.iter().map(|x| x.max(0.0).sqrt()).collect();
        let mut tree = Self { square: square.to_vec(), root, blocks: Vec::new() };
        tree.split(0..square.len() - 1, None);
        tree
    }

    fn split(&mut self, cells: Range<usize>, parent: Option<usize>) -> usize {
        let index = self.blocks.len();
        let (start, end) = (cells.start, cells.end);
        self.blocks.push(Block { start, end, parent, children: None });
        if cells.len() > LEAF {
            let middle = start + cells.len() / 2;
            let inner = self.split(start..middle, Some(index));
            let outer = self.split(middle..end, Some(index));
            self.blocks[index].children = Some([inner, outer]);
        }
        index
    }

    /// X at the inner edge of a block.
    pub(super) fn inner_edge(&self, block: usize) -> f64 {
        self.square[self.blocks[block].start]
    }

    /// X at the outer edge of a block.
    pub(super) fn outer_edge(&self, block: usize) -> f64 {
        self.square[self.blocks[block].end]
    }

    /// Width in X.
    pub(super) fn width(&self, block: usize) -> f64 {
        self.outer_edge(block) - self.inner_edge(block)
    }

    /// Distance of X from an edge of a block.
    fn distance(&self, block: usize, edge: Edge, x: f64) -> f64 {
        match edge {
            Edge::Inner => x - self.inner_edge(block),
            Edge::Outer => self.outer_edge(block) - x,
        }
    }

    /// All pairs.
    pub(super) fn pairs(&self) -> Pairs {
        let mut pairs = Pairs::default();
        for block in &self.blocks {
            if let Some([inner, outer]) = block.children {
                self.pair(outer, inner, &mut pairs);
            }
        }
        pairs
    }

    fn pair(&self, outer: usize, inner: usize, pairs: &mut Pairs) {
        let gap = self.inner_edge(outer) - self.outer_edge(inner);
        let (outer_width, inner_width) = (self.width(outer), self.width(inner));
        if gap >= outer_width.max(inner_width) {
            return pairs.far.push((outer, inner));
        }
        let halves = |block: usize| self.blocks[block].children;
        match (halves(outer), halves(inner)) {
            (None, None) => pairs.near.push((outer, inner)),
            (Some(parts), None) => parts.iter().for_each(|&part| self.pair(part, inner, pairs)),
            (None, Some(parts)) => parts.iter().for_each(|&part| self.pair(outer, part, pairs)),
            (Some(parts), Some(_)) if outer_width >= inner_width => {
                parts.iter().for_each(|&part| self.pair(part, inner, pairs));
            }
            (Some(_), Some(parts)) => parts.iter().for_each(|&part| self.pair(outer, part, pairs)),
        }
    }

    /// 1/√(distance in X) of the points of two far blocks: one row per point of `from`, over those
    /// of `to`.
    pub(super) fn kernel(&self, from: usize, to: usize) -> [Row; ORDER] {
        let (inner, outer) = (from.min(to), from.max(to));
        let gap = self.inner_edge(outer) - self.outer_edge(inner);
        let (from, to) = (self.width(from), self.width(to));
        std::array::from_fn(|a| {
            let start = gap + from * POINTS[a];
            std::array::from_fn(|b| 1.0 / (start + to * POINTS[b]).sqrt())
        })
    }

    /// Lagrange polynomials of the parent at the points of a block: one row per point.
    pub(super) fn in_parent(&self, block: usize, edge: Edge) -> Option<[Row; ORDER]> {
        let parent = self.blocks[block].parent?;
        let width = self.width(parent);
        let own = match edge {
            Edge::Inner => self.inner_edge(block),
            Edge::Outer => self.outer_edge(block),
        };
        let (start, scale) = (self.distance(parent, edge, own) / width, self.width(block) / width);
        Some(std::array::from_fn(|b| lagrange(start + scale * POINTS[b])))
    }

    /// Lagrange polynomials of a block at one of its nodes.
    pub(super) fn at_node(&self, block: usize, edge: Edge, node: usize) -> Row {
        lagrange(self.distance(block, edge, self.square[node]) / self.width(block))
    }

    /// τ at the share g of a cell.
    fn in_cell(&self, block: usize, edge: Edge, j: usize) -> impl Fn(f64) -> f64 {
        let (width, cell) = (self.width(block), self.square[j + 1] - self.square[j]);
        let start = self.distance(block, edge, self.square[j]) / width;
        let slope = if edge == Edge::Inner { cell / width } else { -cell / width };
        move |g| start + slope * g
    }

    /// Moments (1/π) ∫ L(τ) v dX/√X of a block, seen from outside it, for each of its nodes'
    /// values, in rising order.
    pub(super) fn inverse_moments(&self, block: usize, mut sink: impl FnMut(Row)) {
        let mut inner = [0.0; ORDER];
        for j in self.blocks[block].start..self.blocks[block].end {
            let mut outer = [0.0; ORDER];
            let cell = self.square[j + 1] - self.square[j];
            let tau = self.in_cell(block, Edge::Outer, j);
            let mut add = |share: f64, weight: f64| {
                let row = polynomials(tau(share));
                add_scaled(weight * (1.0 - share), &row, &mut inner);
                add_scaled(weight * share, &row, &mut outer);
            };
            // dX/√X = 2 dx
            let (x0, x1) = (self.root[j], self.root[j + 1]);
            let length = cell / (x0 + x1);
            let rule = if length < 0.1 * x1 { rule(cell / self.width(block)) } else { &RULES.0 };
            for &(g, weight) in rule {
                add(g * (2.0 * x0 + g * length) / (x0 + x1), FRAC_2_PI * length * weight);
            }
            sink(of_lagrange(&inner));
            inner = outer;
        }
        sink(of_lagrange(&inner));
    }

    /// Moments (1/π) × mean of L over each cell of a block, seen from inside it, in rising order.
    pub(super) fn pressure_moments(&self, block: usize, mut sink: impl FnMut(Row)) {
        for j in self.blocks[block].start..self.blocks[block].end {
            let mut sums = [0.0; ORDER];
            let share = (self.square[j + 1] - self.square[j]) / self.width(block);
            let tau = self.in_cell(block, Edge::Inner, j);
            for &(g, weight) in rule(share) {
                add_scaled(FRAC_1_PI * weight, &polynomials(tau(g)), &mut sums);
            }
            sink(of_lagrange(&sums));
        }
    }
}

/// Gauss–Legendre rules on [0, 1]. A kernel that is singular a block's width from the block is
/// integrated over a cell of the share δ of its width with an error of (r + √(r² − 1))^−2n, r = 1 +
/// 2/δ: below 1e-13 for all of them. The first rule is for integration over x instead of X, where
/// that distance may shrink to 0.41 of the cell.
static RULES: LazyLock<Rules> = LazyLock::new(|| (on_unit(), on_unit(), on_unit(), on_unit()));

/// Nodes and weights of rules with so many points.
type Rules = ([(f64, f64); 14], [(f64, f64); 9], [(f64, f64); 6], [(f64, f64); 4]);

fn on_unit<const N: usize>() -> [(f64, f64); N] {
    gauss_legendre().map(|(node, weight)| (0.5 + 0.5 * node, 0.5 * weight))
}

/// The rule for a cell of the given share of its block.
fn rule(share: f64) -> &'static [(f64, f64)] {
    if share > 0.25 {
        &RULES.1
    } else if share > 0.0625 {
        &RULES.2
    } else {
        &RULES.3
    }
}
