//! One pass over the leaves of a tree, as a list of steps and one array of weights that they read
//! from front to back.
//!
//! Sources and targets are numbered in the order of the pass. Every leaf first takes in its far
//! field, then computes its targets one by one, then gives out its moments; so all that a target
//! needs is known when it is reached, whether the values at the sources were given or are computed
//! on the way. What is zero up to a target adds exactly nothing.

use super::interpolation::{ORDER, Row, add_scaled, product};
use super::tree::{Block, Edge, Pairs, Tree};
use super::{cell, dot};
use std::ops::Range;

/// Moments and far fields of all blocks during a pass.
#[derive(Debug, Clone, Default)]
pub(super) struct Expansions {
    moments: Vec<Row>,
    fields: Vec<Row>,
}

/// What one block does in a pass.
#[derive(Debug, Clone)]
struct Step {
    /// Cells of the block in the order of the pass; its targets are the nodes at their ends.
    cells: Range<usize>,
    /// First of its weights.
    weights: usize,
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    /// The far field of a block: that of its parent and those of its own far sources.
    Field {
        block: usize,
        parent: Option<usize>,
        sources: Range<usize>,
    },
    Leaf(Leaf),
    /// Moments of a block from those of its children.
    Moments {
        block: usize,
        children: [usize; 2],
    },
}

#[derive(Debug, Clone)]
struct Leaf {
    block: usize,
    receives: bool,
    emits: bool,
    /// First of the sources that adjoin each other up to the target and act by exact weights.
    near: usize,
    /// Sources further back that do so too.
    apart: Range<usize>,
}

/// Steps of one pass with their weights.
#[derive(Debug, Clone)]
pub(super) struct Sweep {
    steps: Vec<Step>,
    weights: Vec<f64>,
    /// Far source blocks of the fields.
    sources: Vec<usize>,
    /// Sources of [`Leaf::apart`].
    apart: Vec<Range<usize>>,
    blocks: usize,
    /// 1 where the values belong to nodes, 0 where to cells.
    extra: usize,
}

/// What one target has to work with: what is known of its sum, and the weights of the sources from
/// `first` to itself.
pub(super) struct Target<'a> {
    pub(super) index: usize,
    pub(super) known: f64,
    pub(super) first: usize,
    pub(super) weights: &'a [f64],
}

impl Target<'_> {
    /// The sum with the present values.
    pub(super) fn sum(&self, values: &[f64]) -> f64 {
        self.known + dot(self.weights, &values[self.first..self.first + self.weights.len()])
    }

    /// The value at the target that makes the sum `sum`.
    pub(super) fn solve(&self, sum: f64, values: &[f64]) -> f64 {
        let (before, diagonal) = self.weights.split_at(self.weights.len() - 1);
        (sum - (self.known + dot(before, &values[self.first..self.index]))) / diagonal[0]
    }
}

impl Sweep {
    /// The inverse Abel transform, from inside outward; values at the nodes.
    pub(super) fn inverse(tree: &Tree, pairs: &Pairs) -> Self {
        let pair = |&(outer, inner): &(usize, usize)| (outer, inner);
        Builder {
            tree,
            far: partners(tree.blocks.len(), pairs.far.iter().map(pair)),
            near: partners(tree.blocks.len(), pairs.near.iter().map(pair)),
            emitting: vec![false; tree.blocks.len()],
            outward: true,
            sweep: Self::empty(tree.blocks.len(), 1),
        }
        .build(
            |block, sink| tree.inverse_moments(block, sink),
            |target, cells, weights| {
                cell::add_inverse(&tree.square, &tree.root, tree.square[target], cells, weights);
            },
        )
    }

    /// The pressure, from outside inward, so that the last node is number 0; values are drops over
    /// the cells.
    pub(super) fn pressure(tree: &Tree, pairs: &Pairs) -> Self {
        let pair = |&(outer, inner): &(usize, usize)| (inner, outer);
        Builder {
            tree,
            far: partners(tree.blocks.len(), pairs.far.iter().map(pair)),
            near: partners(tree.blocks.len(), pairs.near.iter().map(pair)),
            emitting: vec![false; tree.blocks.len()],
            outward: false,
            sweep: Self::empty(tree.blocks.len(), 0),
        }
        .build(
            |block, sink| {
                let mut rows = Vec::new();
                tree.pressure_moments(block, |row| rows.push(row));
                rows.into_iter().rev().for_each(sink);
            },
            |target, cells, weights| {
                cell::pressure(&tree.square, tree.square[target], cells, weights);
                weights.reverse();
            },
        )
    }

    fn empty(blocks: usize, extra: usize) -> Self {
        Self { steps: Vec::new(), weights: Vec::new(), sources: Vec::new(), apart: Vec::new(), blocks, extra }
    }

    /// Number of weights, each of which a pass multiplies once.
    pub(super) fn work(&self) -> usize {
        self.weights.len()
    }

    #[cfg(test)]
    pub(super) fn has_sources_apart(&self) -> bool {
        !self.apart.is_empty()
    }

    /// Goes through some targets in order. Sources before the first of them are zero. `finish` may
    /// change the value at its target.
    pub(super) fn run(
        &self,
        targets: Range<usize>,
        values: &mut [f64],
        expansions: &mut Expansions,
        mut finish: impl FnMut(Target<'_>, &mut [f64]),
    ) {
        expansions.moments.resize(self.blocks, [0.0; ORDER]);
        expansions.fields.resize(self.blocks, [0.0; ORDER]);
        let (moments, fields) = (&mut expansions.moments[..], &mut expansions.fields[..]);
        for Step { cells, weights, kind } in &self.steps {
            let mut weights = Reader(&self.weights[*weights..]);
            let is_before = cells.end < targets.start;
            match kind {
                Kind::Field { .. } | Kind::Leaf(_) if cells.start + 1 >= targets.end => break,
                Kind::Field { .. } if is_before => {}
                Kind::Moments { block, .. } | Kind::Leaf(Leaf { block, .. }) if is_before => {
                    moments[*block] = [0.0; ORDER];
                }
                Kind::Field { block, parent, sources } => {
                    let mut field = [0.0; ORDER];
                    if let Some(parent) = *parent {
                        weights.add_product(&fields[parent], &mut field);
                    }
                    for &source in &self.sources[sources.clone()] {
                        weights.add_product(&moments[source], &mut field);
                    }
                    fields[*block] = field;
                }
                Kind::Moments { block, children } => {
                    let mut sum = [0.0; ORDER];
                    for &child in children {
                        weights.add_product(&moments[child], &mut sum);
                    }
                    moments[*block] = sum;
                }
                Kind::Leaf(leaf) => {
                    let apart: usize = self.apart[leaf.apart.clone()].iter().map(Range::len).sum();
                    let weights_of = |target: usize| {
                        usize::from(leaf.receives) * ORDER + apart + target + self.extra - leaf.near
                    };
                    let first = targets.start.max(cells.start + 1);
                    weights.take((cells.start + 1..first).map(weights_of).sum());
                    // sources that are zero
                    let zeros = targets.start.saturating_sub(leaf.near);
                    for target in first..=cells.end.min(targets.end - 1) {
                        let mut known = 0.0;
                        if leaf.receives {
                            known = product(weights.row(), &fields[leaf.block]);
                        }
                        for apart in &self.apart[leaf.apart.clone()] {
                            known += dot(weights.take(apart.len()), &values[apart.clone()]);
                        }
                        let run = weights.take(target + self.extra - leaf.near);
                        let (first, weights) = (leaf.near + zeros, &run[zeros..]);
                        finish(Target { index: target, known, first, weights }, values);
                    }
                    if cells.end >= targets.end {
                        break;
                    }
                    if leaf.emits {
                        let mut sum = [0.0; ORDER];
                        for value in &values[cells.start..cells.end + self.extra] {
                            add_scaled(*value, weights.row(), &mut sum);
                        }
                        moments[leaf.block] = sum;
                    }
                }
            }
        }
    }
}

/// Weights not read yet.
struct Reader<'a>(&'a [f64]);

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> &'a [f64] {
        let (taken, rest) = self.0.split_at(count);
        self.0 = rest;
        taken
    }

    fn row(&mut self) -> &'a Row {
        let (row, rest) = self.0.split_first_chunk().expect("the steps match the weights");
        self.0 = rest;
        row
    }

    /// sum += Mᵀ v.
    fn add_product(&mut self, vector: &Row, sum: &mut Row) {
        for factor in vector {
            let row = self.row();
            if *factor != 0.0 {
                add_scaled(*factor, row, sum);
            }
        }
    }
}

/// For every block the others that it is paired with.
fn partners(blocks: usize, pairs: impl Iterator<Item = (usize, usize)>) -> Vec<Vec<usize>> {
    let mut lists = vec![Vec::new(); blocks];
    for (block, partner) in pairs {
        lists[block].push(partner);
    }
    lists
}

/// Lays out a sweep. `far` and `near` list the sources of each block.
struct Builder<'a> {
    tree: &'a Tree,
    far: Vec<Vec<usize>>,
    near: Vec<Vec<usize>>,
    /// Whether anything listens to the moments of a block.
    emitting: Vec<bool>,
    outward: bool,
    sweep: Sweep,
}

impl Builder<'_> {
    fn build(
        mut self,
        moments: impl Fn(usize, &mut dyn FnMut(Row)),
        exact: impl Fn(usize, Range<usize>, &mut [f64]),
    ) -> Sweep {
        for source in self.far.iter().flatten() {
            self.emitting[*source] = true;
        }
        for block in 0..self.tree.blocks.len() {
            self.emitting[block] |=
                self.tree.blocks[block].parent.is_some_and(|parent| self.emitting[parent]);
        }
        self.visit(0, false, &moments, &exact);
        self.sweep
    }

    /// A cell or node in the order of the pass; `most` is the number of the last.
    fn number(&self, index: usize, most: usize) -> usize {
        if self.outward { index } else { most - index }
    }

    /// Cells of a block in the order of the pass.
    fn cells(&self, block: usize) -> Range<usize> {
        let (cells, block) = (self.tree.square.len() - 1, &self.tree.blocks[block]);
        if self.outward { block.start..block.end } else { cells - block.end..cells - block.start }
    }

    fn push(&mut self, block: usize, weights: usize, kind: Kind) {
        let cells = self.cells(block);
        self.sweep.steps.push(Step { cells, weights, kind });
    }

    fn append(&mut self, rows: impl IntoIterator<Item = Row>) {
        self.sweep.weights.extend(rows.into_iter().flatten());
    }

    fn visit(
        &mut self,
        block: usize,
        parent_receives: bool,
        moments: &impl Fn(usize, &mut dyn FnMut(Row)),
        exact: &impl Fn(usize, Range<usize>, &mut [f64]),
    ) {
        let (target_edge, source_edge) =
            if self.outward { (Edge::Inner, Edge::Outer) } else { (Edge::Outer, Edge::Inner) };
        let Block { parent, children, .. } = self.tree.blocks[block];
        let receives = parent_receives || !self.far[block].is_empty();
        let weights = self.sweep.weights.len();
        if receives {
            if parent_receives && let Some(rows) = self.tree.in_parent(block, target_edge) {
                self.append(transposed(&rows));
            }
            let first = self.sweep.sources.len();
            for source in std::mem::take(&mut self.far[block]) {
                self.append(self.tree.kernel(source, block));
                self.sweep.sources.push(source);
            }
            let parent = parent.filter(|_| parent_receives);
            let sources = first..self.sweep.sources.len();
            self.push(block, weights, Kind::Field { block, parent, sources });
        }
        let Some([inner, outer]) = children else {
            return self.leaf(block, receives, moments, exact);
        };
        let children = if self.outward { [inner, outer] } else { [outer, inner] };
        for child in children {
            self.visit(child, receives, moments, exact);
        }
        if self.emitting[block] {
            let weights = self.sweep.weights.len();
            for child in children {
                let rows = self.tree.in_parent(child, source_edge);
                self.append(rows.into_iter().flatten());
            }
            self.push(block, weights, Kind::Moments { block, children });
        }
    }

    fn leaf(
        &mut self,
        block: usize,
        receives: bool,
        moments: &impl Fn(usize, &mut dyn FnMut(Row)),
        exact: &impl Fn(usize, Range<usize>, &mut [f64]),
    ) {
        let (last, extra, weights) = (self.tree.square.len() - 1, self.sweep.extra, self.sweep.weights.len());
        let cells = self.cells(block);
        // sources from the leaf backwards: those that adjoin it, then what lies apart, adjoining
        // pieces as one
        let mut near: Vec<_> = self.near[block].iter().map(|&source| self.cells(source)).collect();
        near.sort_unstable_by_key(|cells| std::cmp::Reverse(cells.start));
        let mut runs = vec![cells.clone()];
        for piece in near {
            match runs.last_mut() {
                Some(run) if run.start == piece.end => run.start = piece.start,
                _ => runs.push(piece),
            }
        }
        let (near, apart) = (runs[0].start, &runs[1..]);
        let first = self.sweep.apart.len();
        self.sweep.apart.extend(apart.iter().map(|run| run.start..run.end + extra));
        for target in cells.start + 1..=cells.end {
            let node = self.number(target, last);
            if receives {
                let edge = if self.outward { Edge::Inner } else { Edge::Outer };
                self.append([self.tree.at_node(block, edge, node)]);
            }
            for run in apart.iter().cloned().chain(std::iter::once(near..target)) {
                let start = self.sweep.weights.len();
                self.sweep.weights.resize(start + run.len() + extra, 0.0);
                let cells = if self.outward { run } else { last - run.end..last - run.start };
                exact(node, cells, &mut self.sweep.weights[start..]);
            }
        }
        let emits = self.emitting[block];
        if emits {
            moments(block, &mut |row| self.sweep.weights.extend(row));
        }
        let apart = first..self.sweep.apart.len();
        self.push(block, weights, Kind::Leaf(Leaf { block, receives, emits, near, apart }));
    }
}

fn transposed(rows: &[Row; ORDER]) -> [Row; ORDER] {
    std::array::from_fn(|a| std::array::from_fn(|b| rows[b][a]))
}
