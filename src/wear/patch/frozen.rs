//! Wear inside the stick radius, and the depth outside that belongs to it.

use crate::quadrature::GAUSS_3;
use std::f64::consts::FRAC_2_PI;

/// Wear inside the stick radius, which does not change while the region wears.
#[derive(Debug, Clone, Default)]
pub(crate) struct Frozen {
    /// Radii 0 … c, m; none on a disc.
    pub(crate) x: Vec<f64>,
    /// Image of the wear, m.
    pub(crate) image: Vec<f64>,
    /// Depth, m.
    pub(crate) depth: Vec<f64>,
}

impl Frozen {
    /// Points x² and weights W with which the image alone brings the depth (2/π) ∫ h dx/√(r² − x²)
    /// = Σ W/√(r² − x²) outside, by three-point Gauss in each worn cell.
    pub(super) fn sources(&self) -> Vec<(f64, f64)> {
        let mut sources = Vec::new();
        for (x, h) in self.x.windows(2).zip(self.image.windows(2)).filter(|(_, h)| h[0] != 0.0 || h[1] != 0.0)
        {
            let (middle, half) = (0.5 * (x[0] + x[1]), 0.5 * (x[1] - x[0]));
            for (node, weight) in GAUSS_3 {
                let x_node = middle + half * node;
                let share = (x_node - x[0]) * (x_node + x[0]) / ((x[1] - x[0]) * (x[1] + x[0]));
                let image = h[0] + share * (h[1] - h[0]);
                sources.push((x_node * x_node, FRAC_2_PI * half * weight * image));
            }
        }
        sources
    }

    /// Image at the outermost node, m.
    pub(super) fn edge_image(&self) -> f64 {
        self.image.last().copied().unwrap_or(0.0)
    }

    /// Without the nodes that the line (in x²) between those which stay meets within a share of the
    /// largest image.
    pub(crate) fn thinned(&self, share: f64) -> Self {
        let kept = crate::surface::kept_nodes(&self.x, &self.image, share);
        let pick = |field: &[f64]| kept.iter().map(|&k| field[k]).collect();
        Self { x: pick(&self.x), image: pick(&self.image), depth: pick(&self.depth) }
    }

    /// ∫ h dx, m².
    pub(super) fn width_integral(&self) -> f64 {
        let mut sum = 0.0;
        for (x, h) in self.x.windows(2).zip(self.image.windows(2)) {
            let outer = crate::surface::outer_weight(x[0], x[1]);
            sum += (x[1] - x[0]) * ((1.0 - outer) * h[0] + outer * h[1]);
        }
        sum
    }
}
