//! x ↦ (1 − γτ J) x on one mesh, and how fields go from mesh to mesh.
//!
//! With a moving edge the growth G has the part Ȧ d, d = φ ∂w̃/∂X, and A is fixed by a condition
//! whose change is e·x + e' δA = 0. The change of Ȧ by that of the rest, R x + ∂G/∂A δA, is
//! −e·(…)/(e' + e·d). As x − γτ (…) − γτ δȦ d is the right side y, taking e· of that gives γτ δȦ =
//! δA (1 + γτ e·∂G/∂A/e') + e·y/e': for y + d (e·y)/e' on the right the edge adds the change of A,
//! times a field, and no change of its speed.

use crate::transform::dot;
use crate::wear::mesh::UnitMesh;
use crate::wear::patch::linear::EdgeChange;
use crate::wear::patch::{Patch, Rate};
use nalgebra::DMatrix;
use std::sync::Arc;

/// The system on one mesh. Fields are given at all nodes; depths are zero at the nodes outside
/// `first..end`, where they are given.
#[derive(Debug)]
pub(super) struct Level {
    mesh: Arc<UnitMesh>,
    /// First node whose depth is unknown, and one past the last.
    pub(super) first: usize,
    pub(super) end: usize,
    rim: bool,
    /// γτ times the growth with the depth that follows from the slip, and with the pressure times
    /// √L; 0 where nothing wears.
    soft: Vec<f64>,
    stiff: Vec<f64>,
    /// 1 where springs slip, else 0; none where all do.
    slipping: Option<Vec<f64>>,
    /// 1/b: the image of z.
    softness: Vec<f64>,
    approach: Option<Approach>,
    edge: Option<Edge>,
    /// What of the system is local to a node and its neighbours.
    local: Tridiagonal,
}

/// What is added where the load is held: the body sinks as it wears.
#[derive(Debug)]
struct Approach {
    /// γτ times the growth at the nodes, over the way that it sinks.
    growth: Vec<f64>,
    by: Combination,
}

/// What is added where the contact edge moves.
#[derive(Debug)]
struct Edge {
    /// γτ dA/dN/L.
    speed: f64,
    /// What the change of A adds to the depths.
    column: Vec<f64>,
    /// Change of A with z.
    radius_squared: Combination,
}

/// A functional of z: so many times ∫ h dx/√L and its last value.
#[derive(Debug, Clone, Copy)]
struct Combination {
    width: f64,
    last: f64,
}

impl Combination {
    fn of(self, mesh: &UnitMesh, z: &[f64]) -> f64 {
        let width = if self.width == 0.0 { 0.0 } else { self.width * dot(&mesh.width, z) };
        width + self.last * z[mesh.cells]
    }
}

/// What a change of the depths does.
pub(super) struct Change {
    /// γτ times the change of the growth at given motion of the edge and of the nodes.
    pub(super) growth: Vec<f64>,
    /// Change of A.
    pub(super) radius_squared: f64,
}

impl Level {
    pub(super) fn finest(patch: &Patch, rate: &Rate, edge: Option<&EdgeChange>, gamma_step: f64) -> Self {
        let (mesh, n, first, end) = (&patch.mesh, patch.cells(), patch.mesh.first(), patch.end());
        let (root, a) = (patch.span(rate.radius_squared).sqrt(), rate.radius_squared.sqrt());
        let factor = gamma_step * patch.factor * rate.share;
        let of_nodes = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let wears = |i: usize| (first..end).contains(&i) && rate.surface_slip[i] > 0.0;
            (0..=n).map(|i| if wears(i) { value(i) } else { 0.0 }).collect()
        };
        let soft = of_nodes(&|i| factor * rate.pressure[i] * patch.bound_slope);
        let stiff = of_nodes(&|i| factor * rate.surface_slip[i] / root);
        let slips = |i: usize| f64::from(u8::from(i >= first && rate.slip[i] > 0.0));
        let slipping: Vec<f64> = (0..=n).map(slips).collect();
        let softness: Vec<f64> = rate.scale.iter().map(|b| 1.0 / b).collect();
        let approach = patch.is_force().then(|| {
            let moved: Vec<f64> = slipping.iter().zip(&rate.scale).map(|(on, b)| on * b).collect();
            let (mut uniform, mut slid) = (vec![0.0; n + 1], vec![0.0; n + 1]);
            mesh.pressure(&vec![1.0; n + 1], patch.rim, &mut uniform);
            mesh.inverse_abel(&moved, &mut slid);
            let by = if patch.rim {
                Combination { width: root / a, last: 0.0 }
            } else {
                Combination { width: 0.0, last: softness[n] }
            };
            let sensitivity = patch.sensitivity(rate);
            Approach {
                growth: (0..=n).map(|i| stiff[i] * uniform[i] - sensitivity * soft[i] * slid[i]).collect(),
                by,
            }
        });
        let edge = edge.map(|edge| {
            let with_area = edge.condition.radius_squared;
            // by how much a change of A changes its own rate
            let own = 1.0 + gamma_step * dot(&edge.condition.depth, &edge.growth) / with_area;
            let column = (0..=n).map(|i| own * rate.drift[i] + gamma_step * edge.growth[i]).collect();
            let last = -softness[n] / with_area;
            let radius_squared = if patch.is_force() {
                Combination { width: root / with_area, last: a * last }
            } else {
                Combination { width: 0.0, last }
            };
            Edge {
                speed: gamma_step * rate.area_rate / patch.span(rate.radius_squared),
                column,
                radius_squared,
            }
        });
        let all = slipping[first..].iter().all(|on| *on == 1.0);
        let slipping = (!all).then_some(slipping);
        let (mesh, rim) = (mesh.clone(), patch.rim);
        let level = Self {
            mesh,
            first,
            end,
            rim,
            soft,
            stiff,
            slipping,
            softness,
            approach,
            edge,
            local: Tridiagonal::default(),
        };
        level.complete()
    }

    /// The same on every other node; none on the coarsest mesh.
    pub(super) fn coarser(&self) -> Option<Self> {
        let mesh = self.mesh.coarser.clone()?;
        let pick = |field: &Vec<f64>| -> Vec<f64> { field.iter().step_by(2).copied().collect() };
        let approach = |of: &Approach| Approach { growth: pick(&of.growth), by: of.by };
        let edge = |of: &Edge| Edge { column: pick(&of.column), ..*of };
        let level = Self {
            first: self.first,
            end: mesh.cells + self.end - self.mesh.cells,
            rim: self.rim,
            soft: pick(&self.soft),
            stiff: pick(&self.stiff),
            slipping: self.slipping.as_ref().map(pick),
            softness: pick(&self.softness),
            approach: self.approach.as_ref().map(approach),
            edge: self.edge.as_ref().map(edge),
            local: Tridiagonal::default(),
            mesh,
        };
        Some(level.complete())
    }

    /// With what follows from the rest on its own mesh.
    fn complete(mut self) -> Self {
        let mesh = &self.mesh;
        let relief = mesh.relief(self.rim);
        let speed = self.edge.as_ref().map_or(0.0, |edge| edge.speed);
        for i in self.first..self.end {
            let levelled = self.stiff[i] * self.softness[i] * relief[i];
            let slips = self.slipping.as_ref().map_or(1.0, |slipping| slipping[i]);
            // where wear feeds itself, only a coarser mesh can tell
            let own = (1.0 + levelled - self.soft[i] * slips).max(0.5 * (1.0 + levelled));
            self.local.push(own, mesh.drift[i].map(|weight| -speed * weight));
        }
        self
    }

    /// What a change of the depths does.
    pub(super) fn change(&self, depth: &[f64]) -> Change {
        let (mesh, n) = (&*self.mesh, self.mesh.cells);
        let mut z = vec![0.0; n + 1];
        mesh.abel(depth, &mut z);
        let mut overlap: Vec<f64> = z.iter().zip(&self.softness).map(|(z, soft)| z * soft).collect();
        if !self.rim {
            overlap[n] = 0.0;
        }
        let mut growth = vec![0.0; n + 1];
        mesh.pressure(&overlap, self.rim, &mut growth);
        growth.iter_mut().zip(&self.stiff).for_each(|(growth, stiff)| *growth *= -stiff);
        let mut soften = |slid: &[f64]| {
            growth
                .iter_mut()
                .zip(slid)
                .zip(&self.soft)
                .for_each(|((growth, slid), soft)| *growth += soft * slid);
        };
        match &self.slipping {
            None => soften(depth),
            Some(slipping) => {
                let moved: Vec<f64> = z.iter().zip(slipping).map(|(z, on)| z * on).collect();
                let mut slid = vec![0.0; n + 1];
                mesh.inverse_abel(&moved, &mut slid);
                soften(&slid);
            }
        }
        if let Some(approach) = &self.approach {
            add(&mut growth, approach.by.of(mesh, &z), &approach.growth);
        }
        growth[..self.first].fill(0.0);
        growth[self.end..].fill(0.0);
        Change {
            growth,
            radius_squared: self.edge.as_ref().map_or(0.0, |edge| edge.radius_squared.of(mesh, &z)),
        }
    }

    /// The system's left side.
    pub(super) fn apply(&self, depth: &[f64]) -> Vec<f64> {
        let Change { mut growth, radius_squared } = self.change(depth);
        if let Some(edge) = &self.edge {
            for i in 1..self.mesh.cells {
                growth[i] += edge.speed * dot(&self.mesh.drift[i], &depth[i - 1..=i + 1]);
            }
            add(&mut growth, radius_squared, &edge.column);
        }
        let mut image: Vec<f64> = depth.iter().zip(&growth).map(|(depth, growth)| depth - growth).collect();
        image[..self.first].fill(0.0);
        image[self.end..].fill(0.0);
        image
    }

    /// What a residual at the nodes means for the image, about: half a derivative.
    pub(super) fn weights(&self) -> Vec<f64> {
        self.mesh
            .relief(self.rim)
            .iter()
            .map(|relief| if *relief > 0.0 { relief.sqrt() } else { 1.0 })
            .collect()
    }

    /// One step of relaxation, by a share of the change that would do for what is local.
    pub(super) fn relax(&self, depth: &mut [f64], right: &[f64], share: f64) {
        let image = self.apply(depth);
        let mut change: Vec<f64> = (self.first..self.end).map(|i| share * (right[i] - image[i])).collect();
        self.local.solve(&mut change);
        depth[self.first..self.end].iter_mut().zip(&change).for_each(|(depth, change)| *depth += change);
    }

    /// The matrix for the unknown depths, column by column: for few cells.
    pub(super) fn matrix(&self) -> DMatrix<f64> {
        let size = self.end - self.first;
        let mut matrix = DMatrix::zeros(size, size);
        let mut depth = vec![0.0; self.mesh.cells + 1];
        for (k, mut column) in matrix.column_iter_mut().enumerate() {
            depth[self.first + k] = 1.0;
            column.copy_from_slice(&self.apply(&depth)[self.first..self.end]);
            depth[self.first + k] = 0.0;
        }
        matrix
    }

    /// A right side on the mesh of every other node: means over a node and its neighbours.
    pub(super) fn restricted(&self, right: &[f64]) -> Vec<f64> {
        let n = self.mesh.cells;
        let mean = |i: usize| {
            let (before, after) =
                (right[if i == 0 { 1 } else { i - 1 }], right[if i == n { n - 1 } else { i + 1 }]);
            0.5 * right[i] + 0.25 * (before + after)
        };
        let mut coarse: Vec<f64> = (0..=n).step_by(2).map(mean).collect();
        coarse[..self.first].fill(0.0);
        if !self.rim {
            coarse[n / 2] = 0.0;
        }
        coarse
    }

    /// Depths given on the mesh of every other node: means between these.
    pub(super) fn refined(&self, coarse: &[f64]) -> Vec<f64> {
        let between = |i: usize| {
            if i.is_multiple_of(2) { coarse[i / 2] } else { 0.5 * (coarse[i / 2] + coarse[i / 2 + 1]) }
        };
        (0..=self.mesh.cells).map(between).collect()
    }
}

fn add(sum: &mut [f64], factor: f64, term: &[f64]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += factor * term);
}

/// A tridiagonal matrix, factorised row by row. The motion of the mesh alone fills its other
/// diagonals, with weights of opposite signs, so that no row needs another for a pivot.
#[derive(Debug, Default)]
struct Tridiagonal {
    /// Below the diagonal; the inverse pivot; above it, over the pivot.
    rows: Vec<[f64; 3]>,
}

impl Tridiagonal {
    /// Adds a row: its own entry, to which the weights of the node before, itself and the one after
    /// are added.
    fn push(&mut self, own: f64, [before, here, after]: [f64; 3]) {
        let above = self.rows.last().map_or(0.0, |row| row[2]);
        let inverse = 1.0 / (own + here - before * above);
        self.rows.push([before, inverse, after * inverse]);
    }

    fn solve(&self, values: &mut [f64]) {
        let mut last = 0.0;
        for (value, [before, inverse, _]) in values.iter_mut().zip(&self.rows) {
            *value = (*value - before * last) * inverse;
            last = *value;
        }
        let mut last = 0.0;
        for (value, [_, _, above]) in values.iter_mut().zip(&self.rows).rev() {
            *value -= above * last;
            last = *value;
        }
    }
}
