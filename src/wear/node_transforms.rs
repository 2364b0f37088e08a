//! The transforms between image, profile and pressure at the nodes of a surface.

use crate::transform::{Abel, Density, Scratch};

/// The transforms of one set of nodes.
#[derive(Debug)]
pub(crate) struct NodeTransforms {
    abel: Abel,
    nodes: usize,
}

impl NodeTransforms {
    pub(crate) fn new(x: &[f64]) -> Self {
        let per_metre = (-x[x.len() - 1].log2().floor()).clamp(-1000.0, 1000.0).exp2();
        let squares: Vec<f64> = x.iter().map(|x| (x * per_metre).powi(2)).collect();
        // squares of tiny radii must not vanish
        Self { abel: Abel::new(&squares, Density::Image), nodes: x.len() }
    }

    /// Depth (m) of the profile that belongs to an image (m), or slip to that of the springs. Zero up to the first value
    /// that is not.
    pub(crate) fn descend(&self, image: &[f64]) -> Vec<f64> {
        let mut depth = vec![0.0; self.nodes];
        self.abel.descend(image, &mut depth, &mut Scratch::default());
        depth
    }

    /// The inverse of [`Self::descend`].
    pub(crate) fn ascend(&self, depth: &[f64]) -> Vec<f64> {
        let mut image = vec![0.0; self.nodes];
        self.abel.ascend(depth, &mut image, &mut Scratch::default());
        image
    }
}
