//! How fast a state wears.

use super::load::Excess;
use super::{EdgeCondition, Patch};
use crate::surface::Region;
use crate::transform::{add, dot};
use std::f64::consts::PI;

/// Most by which the scaling of a rate may differ from 1: beyond it next to nothing wears or moves,
/// and their ratio is rounding.
const MOST_SHARE: f64 = 0.25;

/// Everything that follows from a state.
#[derive(Debug, Clone)]
pub(crate) struct Rate {
    /// dw̃/dN at the moving nodes, m.
    pub(crate) growth: Vec<f64>,
    /// z of all that has worn in the region.
    pub(crate) image: Vec<f64>,
    pub(crate) radius_squared: f64,
    pub(crate) indentation: f64,
    /// U₀, m.
    pub(crate) free_slip: f64,
    /// Where the springs first slip, m; the inner edge where that is not looked for.
    pub(super) stick: f64,
    /// d − g at the nodes, m.
    pub(super) overlap: Vec<f64>,
    /// σ at the nodes, m.
    pub(crate) slip: Vec<f64>,
    /// −dσ/dq there.
    pub(super) slip_fall: Vec<f64>,
    pub(super) radius: Vec<f64>,
    /// b: z = b·h.
    pub(super) scale: Vec<f64>,
    pub(super) pressure: Vec<f64>,
    pub(super) surface_slip: Vec<f64>,
    /// Change of the depths with A where the nodes move along what is at rest.
    pub(super) drift: Vec<f64>,
    /// dA/dN, m².
    pub(super) area_rate: f64,
    /// What fixes the contact edge, where it moves.
    pub(super) edge: Option<EdgeCondition>,
    /// Of the body's load integral, near the contact radius.
    pub(super) excess: Option<Excess>,
    /// Worn volume per cycle by the work of the springs, m³.
    pub(crate) volume_rate: f64,
    /// Ratio by which the product of p and s is scaled to the work of the springs.
    pub(crate) share: f64,
    /// Ratio by which the drift is scaled, so that it moves no volume.
    pub(super) drift_share: f64,
}

/// Where the contact edge may be, and what is known there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// Square of its radius, m².
    pub(crate) radius_squared: f64,
    /// Where the load is given.
    excess: Option<Excess>,
}

impl Patch {
    /// A contact edge near the square of a radius, m².
    pub(crate) fn edge(&self, radius_squared: f64) -> Edge {
        Edge { radius_squared, excess: self.is_force().then(|| self.excess(radius_squared)) }
    }

    /// The rate of wear at given depths inside the region; `None` where no contact edge can be
    /// found.
    pub(crate) fn rate(&self, depth: &[f64], guess: f64) -> Option<Rate> {
        self.rate_of((depth.to_vec(), self.mesh.abel(depth)), self.edge(guess))
    }

    /// The same where z, too, is known. Both may have any value where they are given: z at the
    /// inner edge of an annulus, both at a moving outer one.
    pub(crate) fn rate_of(&self, (depth, image): (Vec<f64>, Vec<f64>), guess: Edge) -> Option<Rate> {
        let Edge { mut radius_squared, mut excess } = guess;
        radius_squared = self.solve_area(&depth, radius_squared, excess)?;
        if self.mesh.region == Region::Disc && !self.rim {
            // in gross slip the overlap is small beside it, so that it has to be that of this edge
            excess = self.edge(radius_squared).excess;
            radius_squared = self.solve_area(&depth, radius_squared, excess)?;
        }
        let rate = self.rate_at((depth, image), radius_squared, excess);
        rate.area_rate.is_finite().then_some(rate)
    }

    /// z of the depths of the state alone.
    pub(crate) fn own_image(&self, rate: &Rate) -> Vec<f64> {
        let mut image = rate.image.clone();
        let outside = self.outside.depth_and_slope(rate.radius_squared).0;
        add(&mut image, -outside, &self.mesh.image_of_share);
        image
    }

    /// The same at a given contact edge.
    pub(super) fn rate_at(
        &self,
        (mut depth, mut image): (Vec<f64>, Vec<f64>),
        radius_squared: f64,
        excess: Option<Excess>,
    ) -> Rate {
        let (mesh, n) = (&*self.mesh, self.cells());
        let (a, span) = (radius_squared.sqrt(), self.span(radius_squared));
        let radius = self.radii(radius_squared);
        let scale = self.scales(span, &radius);
        let mut edge_slope = 0.0;
        if !self.rim {
            (depth[n], edge_slope) = self.edge_depth(radius_squared);
            image[n] = dot(&mesh.edge_image, &depth);
        }
        if mesh.first() == 1 {
            image[0] = self.inner_image(span);
        }
        let (outside, outside_slope) = self.outside.depth_and_slope(radius_squared);
        let edge_image = image[n];
        add(&mut image, outside, &mesh.image_of_share);
        let mut whole = self.body.images(&radius);
        whole.iter_mut().zip(&image).zip(&scale).for_each(|((g, z), b)| *g += z / b);
        let indentation = if !self.is_force() {
            self.motion.value
        } else if self.rim {
            let worn = self.inside_width + span.sqrt() * dot(&mesh.width, &image);
            let load = self.motion.value - self.body_load(radius_squared, excess).0;
            self.body.image(a) + (load + worn) / self.length(radius_squared, excess).0
        } else {
            whole[n]
        };
        let mut overlap = whole;
        overlap.iter_mut().for_each(|g| *g = indentation - *g);
        if !self.rim {
            overlap[n] = 0.0;
        }
        let (free_slip, stick) = self.amplitude(indentation, (&radius, &overlap));
        let (mut slip, slip_fall): (Vec<f64>, Vec<f64>) =
            overlap.iter().map(|q| self.slip(free_slip, *q)).unzip();
        if mesh.first() == 1 {
            slip[0] = 0.0;
        }
        let mut pressure = mesh.pressure(&overlap, self.rim);
        let root = span.sqrt();
        pressure.iter_mut().for_each(|p| *p /= root);
        let scaled: Vec<f64> = slip.iter().zip(&scale).map(|(s, b)| s * b).collect();
        let surface_slip = mesh.inverse_abel(&scaled);
        let mut growth: Vec<f64> =
            pressure.iter().zip(&surface_slip).map(|(p, s)| self.factor * p * s).collect();
        if !self.rim {
            growth[n] = 0.0;
        }
        let volume_rate = self.volume_rate((span, &scale), &overlap, &slip);
        let share = volume_rate / (span * dot(&mesh.volume, &growth));
        let share =
            if share.is_finite() { share.clamp(1.0 / (1.0 + MOST_SHARE), 1.0 + MOST_SHARE) } else { 1.0 };
        growth.iter_mut().for_each(|rate| *rate *= share);
        let (mut drift, mut area_rate, mut drift_share, mut edge) = (Vec::new(), 0.0, 1.0, None);
        if !self.rim {
            drift = (0..=n).map(|i| mesh.drift_of(&depth, i) / span).collect();
            drift_share = self.drift_share(&depth, span, &drift);
            drift.iter_mut().for_each(|drift| *drift *= drift_share);
            add(&mut drift[..n], outside / span - outside_slope, &mesh.share);
            let condition = self.edge_condition((&depth, edge_image), radius_squared, (edge_slope, excess));
            area_rate =
                -dot(&condition.depth, &growth) / (condition.radius_squared + dot(&condition.depth, &drift));
            add(&mut growth, area_rate, &drift);
            edge = Some(condition);
        }
        Rate {
            growth,
            image,
            radius_squared,
            indentation,
            free_slip,
            stick,
            overlap,
            slip,
            slip_fall,
            radius,
            scale,
            pressure,
            surface_slip,
            drift,
            area_rate,
            edge,
            excess,
            volume_rate,
            share,
            drift_share,
        }
    }

    /// Nodes that move along a depth at rest take no volume with them: ∫ (w + φ ∂w/∂φ) dφ is w at
    /// the contact edge. What the differences miss of it is in proportion to the drift.
    fn drift_share(&self, depth: &[f64], span: f64, drift: &[f64]) -> f64 {
        let volume = &self.mesh.volume;
        let share = (PI * depth[self.cells()] - dot(volume, depth)) / (span * dot(volume, drift));
        if (share - 1.0).abs() <= MOST_SHARE { share } else { 1.0 }
    }

    /// (k/σ₀) times the work of the springs in a cycle, m³: 2π ∫ p s r dr = 2 ∫ q σ dx.
    fn volume_rate(&self, (span, scale): (f64, &[f64]), overlap: &[f64], slip: &[f64]) -> f64 {
        let weights = self.mesh.width.iter().zip(scale);
        let work: f64 = weights.zip(overlap).zip(slip).map(|(((w, b), q), s)| w * b * q * s).sum();
        2.0 * self.factor * span.sqrt() * work
    }
}
