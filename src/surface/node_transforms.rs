//! The transforms between image, profile and pressure at the nodes of a surface.

use super::Nodes;
use crate::transform::{Abel, Scratch};
use std::sync::Arc;

/// The transforms of one set of nodes.
#[derive(Debug)]
pub(crate) struct NodeTransforms {
    abel: Abel,
    /// 1/unit of the radii that the transforms are made for, 1/m: squares of tiny radii must not
    /// vanish.
    per_metre: f64,
    nodes: usize,
}

impl NodeTransforms {
    pub(crate) fn new(x: &[f64]) -> Self {
        let per_metre = (-x[x.len() - 1].log2().floor()).clamp(-1000.0, 1000.0).exp2();
        let squares: Vec<f64> = x.iter().map(|x| (x * per_metre).powi(2)).collect();
        Self { abel: Abel::new(&squares), per_metre, nodes: x.len() }
    }

    /// Depth (m) of the profile that belongs to an image (m), or slip to that of the springs. Zero
    /// up to the first value that is not.
    pub(crate) fn inverse_abel(&self, image: &[f64]) -> Vec<f64> {
        let mut depth = Vec::new();
        self.inverse_abel_into(image, &mut depth, &mut Scratch::default());
        depth
    }

    /// [`Self::inverse_abel`] in memory that is there.
    pub(crate) fn inverse_abel_into(&self, image: &[f64], depth: &mut Vec<f64>, scratch: &mut Scratch) {
        depth.resize(self.nodes, 0.0);
        self.abel.inverse_abel(image, depth, scratch);
    }

    /// The inverse of [`Self::inverse_abel`].
    pub(crate) fn abel(&self, depth: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; self.nodes];
        self.abel.abel(depth, &mut image, &mut Scratch::default());
        image
    }

    /// Pressure (Pa) of a line load (N/m) that goes on beyond the given nodes as it ends there.
    pub(crate) fn pressure(&self, load: &[f64]) -> Vec<f64> {
        let mut pressure = Vec::new();
        self.pressure_into(&mut load.to_vec(), &mut pressure, &mut Scratch::default());
        pressure
    }

    /// [`Self::pressure`] in memory that is there; the load then goes on to the last node.
    pub(crate) fn pressure_into(&self, load: &mut Vec<f64>, pressure: &mut Vec<f64>, scratch: &mut Scratch) {
        load.resize(self.nodes, load.last().copied().unwrap_or(0.0));
        pressure.resize(self.nodes, 0.0);
        self.abel.pressure(load, pressure, scratch);
        pressure.iter_mut().for_each(|p| *p *= self.per_metre);
    }
}

/// The transforms for the nodes last asked for, shared by clones of a contact.
#[derive(Debug, Clone, Default)]
pub(crate) struct TransformCache {
    present: Option<(Vec<f64>, Arc<NodeTransforms>)>,
}

impl TransformCache {
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
