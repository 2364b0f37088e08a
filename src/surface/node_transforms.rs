//! The transforms between image, profile and pressure at the nodes of a surface.

use super::Nodes;
use crate::transform::Abel;
use std::ops::Range;
use std::sync::Arc;

/// The transforms of one set of nodes.
#[derive(Debug)]
pub(crate) struct NodeTransforms {
    abel: Abel,
    /// 1/unit of the radii that the transforms are made for, 1/m: squares of tiny radii must not
    /// vanish.
    per_metre: f64,
    /// Squares of the radii in these units.
    squares: Vec<f64>,
}

impl NodeTransforms {
    pub(crate) fn new(x: &[f64]) -> Self {
        let mut transforms = Self { abel: Abel::default(), per_metre: 1.0, squares: Vec::new() };
        transforms.renew(x);
        transforms
    }

    /// Becomes [`Self::new`] of other nodes.
    pub(crate) fn renew(&mut self, x: &[f64]) {
        self.per_metre = (-x[x.len() - 1].log2().floor()).clamp(-1000.0, 1000.0).exp2();
        self.squares.clear();
        self.squares.extend(x.iter().map(|x| (x * self.per_metre).powi(2)));
        self.abel.renew(&self.squares);
    }

    /// Depth (m) of the profile that belongs to an image (m), or slip to that of the springs. Zero
    /// up to the first value that is not.
    pub(crate) fn inverse_abel(&self, image: &[f64]) -> Vec<f64> {
        let mut depth = Vec::new();
        self.inverse_abel_at(0..image.len(), image, &mut depth, &mut Vec::new());
        depth
    }

    /// [`Self::inverse_abel`] at some nodes, from where the image begins to change, in memory that
    /// is there. The depth at others is not to be used.
    pub(crate) fn inverse_abel_at(
        &self,
        targets: Range<usize>,
        image: &[f64],
        depth: &mut Vec<f64>,
        buffer: &mut Vec<f64>,
    ) {
        depth.resize(self.squares.len(), 0.0);
        self.abel.inverse_abel_at(targets, image, depth, buffer);
    }

    /// The inverse of [`Self::inverse_abel`].
    pub(crate) fn abel(&self, depth: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; self.squares.len()];
        self.abel.abel(depth, &mut image, &mut Vec::new());
        image
    }

    /// Pressure (Pa) of a line load (N/m) that goes on beyond the given nodes as it ends there.
    pub(crate) fn pressure(&self, load: &[f64]) -> Vec<f64> {
        let mut pressure = Vec::new();
        let load = &mut load.to_vec();
        self.pressure_at(0..load.len(), load, &mut pressure, &mut Vec::new());
        pressure
    }

    /// [`Self::pressure`] at some of the given nodes up to the last of them, in memory that is
    /// there; the load then goes on to the last node of all. The pressure at others is not to be
    /// used.
    pub(crate) fn pressure_at(
        &self,
        targets: Range<usize>,
        load: &mut Vec<f64>,
        pressure: &mut Vec<f64>,
        buffer: &mut Vec<f64>,
    ) {
        load.resize(self.squares.len(), load.last().copied().unwrap_or(0.0));
        pressure.resize(self.squares.len(), 0.0);
        self.abel.pressure_at(targets.clone(), load, pressure, buffer);
        pressure[targets].iter_mut().for_each(|p| *p *= self.per_metre);
    }
}

/// The transforms for the nodes last asked for, shared by clones of a contact.
#[derive(Debug, Clone, Default)]
pub(crate) struct TransformCache {
    present: Option<(Vec<f64>, Arc<NodeTransforms>)>,
}

impl TransformCache {
    /// Those for the present nodes where they are there.
    pub(crate) fn find(&self, nodes: &Nodes) -> Option<&Arc<NodeTransforms>> {
        self.present.as_ref().filter(|(x, _)| *x == nodes.x()).map(|(_, transforms)| transforms)
    }

    /// Those for the present nodes; the flag says whether they had to be made.
    pub(crate) fn get(&mut self, nodes: &Nodes) -> (Arc<NodeTransforms>, bool) {
        match &self.present {
            Some((x, transforms)) if *x == nodes.x() => (transforms.clone(), false),
            _ => {
                let transforms = Arc::new(NodeTransforms::new(nodes.x()));
                self.present = Some((nodes.x().to_vec(), transforms.clone()));
                (transforms, true)
            }
        }
    }
}
