//! Wear inside the stick radius, and the depth outside that belongs to it.

use crate::quadrature::GAUSS_3;
use std::array;
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

/// Points x² and weights W with which the image inside alone brings the depth (2/π) ∫ h dx/√(r² −
/// x²) = Σ W/√(r² − x²) outside, four at a time; what fills the last four weighs nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct Sources(Vec<([f64; 4], [f64; 4])>);

impl Sources {
    /// The depth at a radius outside, m, and its slope in the square of the radius.
    pub(super) fn depth_and_slope(&self, radius_squared: f64) -> (f64, f64) {
        let (mut depth, mut slope) = ([0.0; 4], [0.0; 4]);
        for (squares, weights) in &self.0 {
            for lane in 0..4 {
                let inverse = 1.0 / (radius_squared - squares[lane]);
                let part = weights[lane] * inverse.sqrt();
                depth[lane] += part;
                slope[lane] -= 0.5 * part * inverse;
            }
        }
        (depth.iter().sum(), slope.iter().sum())
    }

    /// ∫ r w dr of the depth up to a radius, m³.
    pub(super) fn integral(&self, radius_squared: f64) -> f64 {
        let mut integral = [0.0; 4];
        for (squares, weights) in &self.0 {
            for lane in 0..4 {
                integral[lane] += weights[lane] * (radius_squared - squares[lane]).max(0.0).sqrt();
            }
        }
        integral.iter().sum()
    }
}

impl Frozen {
    /// Three-point Gauss in each worn cell.
    pub(super) fn sources(&self) -> Sources {
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
        let four = |four: &[(f64, f64)]| {
            let source = |lane: usize| four.get(lane).copied().unwrap_or_default();
            (array::from_fn(|lane| source(lane).0), array::from_fn(|lane| source(lane).1))
        };
        Sources(sources.chunks(4).map(four).collect())
    }

    /// Image at the outermost node, m.
    pub(super) fn edge_image(&self) -> f64 {
        self.image.last().copied().unwrap_or(0.0)
    }

    /// Without the nodes that the lines (in x²) between those which stay meet, the image within a
    /// share of the largest, and without those from the start of a mesh (m) on that are crowded at
    /// the edge.
    pub(crate) fn thinned(&self, share: f64, mesh_start: f64) -> Self {
        let kept = crate::surface::kept_nodes([&self.x, &self.image, &self.depth], (share, mesh_start));
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
