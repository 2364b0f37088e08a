//! The slipping region of a contact while it wears under a steady motion, on a mesh that moves with
//! the contact edge.
//!
//! One cycle of amplitude U₀ at constant load wears ∂w/∂N = 4 κ p s with κ = kμ/σ₀, the pressure p
//! of q = d − g and the slip s, the inverse Abel transform of σ = max(U₀ − m q, 0), m = μE*/G*.
//! Of cycles of several amplitudes σ is the sum of their shares.
//! Here w̃ is the depth that belongs to the image inside the region alone, h·1[x ≥ c]: what lies
//! inside the stick radius c has no part in the rate of wear. At the contact edge a the depth is
//! w_out(a), what other loads have left there, so that w̃(a) = w_out(a) − w_in(a), the latter being
//! the depth there that belongs to the image inside. What is integrated is w̃ − φ w_out(a): if it
//! were w̃, the image at a might fall as a grows, and no edge or several would be found.
//! The nodes move with a² like X = c² + L φ; at them dw̃/dN = R + (∂w̃/∂X) φ dA/dN with A = a². All
//! fields stay smooth in the mesh coordinate, at the moving edge too.

mod edge;
mod front;
mod frozen;
mod linear;
mod load;
mod motion;
mod outside;
mod rate;
mod rig;
mod volume;

use super::Constants;
use super::mesh::UnitMesh;
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::surface::Region;
use crate::surface::{Contact, Surface};
use crate::transform::{add, dot};
use std::sync::Arc;

use edge::EdgeCondition;
pub(crate) use front::{FRONT_CELLS, Front};
pub(crate) use frozen::Frozen;
use frozen::Sources;
pub(super) use linear::Linear;
pub(crate) use motion::{Mixture, Motion, Rig, Sliding};
pub(crate) use outside::Outside;
pub(crate) use rate::Rate;

/// How near to the end of the body, relative, a contact edge counts as standing there. A worn rim
/// carries next to nothing, and would come and go at every step.
pub(crate) const RIM: f64 = 1e-4;

/// The region: the body, its mesh, and the law.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    /// The body without the wear that the mesh carries and that of `inside`.
    pub(crate) body: Surface,
    pub(crate) mesh: Arc<UnitMesh>,
    /// Stick radius c, m; 0 on a disc.
    pub(crate) inner_radius: f64,
    pub(crate) inside: Frozen,
    pub(crate) outside: Outside,
    pub(crate) motion: Motion,
    /// Whether the contact ends at the end of the body, so that its edge stays there.
    pub(crate) rim: bool,
    /// Slip of a spring that is free of load, m per stroke.
    free_slip: f64,
    bound_slope: f64,
    /// 4κE*: wear per cycle = factor · (p/E*) · s.
    factor: f64,
    inside_width: f64,
    /// ∫ g dx over what lies inside the inner edge, m².
    inside_image: f64,
    sources: Sources,
}

/// Depths w̃ − φ w_out(a) at the nodes, m, and the square of the contact radius, m².
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) depth: Vec<f64>,
    pub(crate) radius_squared: f64,
}

impl Patch {
    /// A region from an inner radius (0 on a disc) to the contact edge, with the wear inside that
    /// radius and outside the contact.
    pub(crate) fn new(
        body: Surface,
        mesh: Arc<UnitMesh>,
        (inner_radius, inside, outside): (f64, Frozen, Outside),
        motion: Motion,
        rim: bool,
        constants: &Constants,
    ) -> Self {
        let kappa = constants.wear_per_work * constants.friction_coefficient;
        let (free_slip, ratio, strokes) = motion.sliding.law();
        let inside_width = inside.width_integral();
        let inside_image = motion.rig.map_or(0.0, |_| {
            let inner = body.place(inner_radius);
            inner_radius * inner.image - inner.load + inside_width
        });
        Self {
            body,
            mesh,
            inner_radius,
            inside_width,
            inside_image,
            sources: inside.sources(),
            inside,
            outside,
            motion,
            rim,
            free_slip,
            bound_slope: ratio * constants.bound_slope(),
            factor: strokes * kappa * constants.normal_modulus,
        }
    }

    /// σ (m) of a spring with an overlap (m), and by how much it falls with that.
    fn slip(&self, free_slip: f64, overlap: f64) -> (f64, f64) {
        let bound = self.bound_slope * overlap;
        let Some(mixture) = &self.motion.mixture else {
            return if free_slip > bound { (free_slip - bound, self.bound_slope) } else { (0.0, 0.0) };
        };
        let (mut slip, mut shares) = (0.0, 0.0);
        for (share, amplitude) in mixture.iter().filter(|(_, amplitude)| *amplitude > bound) {
            slip += share * (amplitude - bound);
            shares += share;
        }
        if slip > 0.0 { (slip, shares * self.bound_slope) } else { (0.0, 0.0) }
    }

    fn cells(&self) -> usize {
        self.mesh.cells
    }

    /// One past the last node whose depth is unknown: at a moving edge it is given.
    pub(crate) fn end(&self) -> usize {
        if self.rim { self.cells() + 1 } else { self.cells() }
    }

    fn is_force(&self) -> bool {
        self.motion.control == NormalControl::Force
    }

    /// L = a² − c², m².
    pub(crate) fn span(&self, radius_squared: f64) -> f64 {
        radius_squared - self.inner_radius * self.inner_radius
    }

    pub(crate) fn radii(&self, radius_squared: f64) -> Vec<f64> {
        self.radii_of(&self.mesh.share, radius_squared)
    }

    /// Radii of shares from 0 to 1, m.
    pub(crate) fn radii_of(&self, shares: &[f64], radius_squared: f64) -> Vec<f64> {
        let (c2, span) = (self.inner_radius * self.inner_radius, self.span(radius_squared));
        let mut x: Vec<f64> = shares.iter().map(|phi| (c2 + span * phi).sqrt()).collect();
        // both ends to the bit: beyond its rim a punch has no image
        x[0] = self.inner_radius;
        x[shares.len() - 1] = radius_squared.sqrt();
        x
    }

    /// b = z/h at a radius.
    fn scale(&self, span: f64, x: f64) -> f64 {
        match self.mesh.region {
            Region::Annulus => span.sqrt() / x,
            Region::Disc => 1.0,
        }
    }

    /// The same at several radii.
    fn scales(&self, span: f64, radii: &[f64]) -> Vec<f64> {
        match self.mesh.region {
            Region::Annulus => {
                let root = span.sqrt();
                radii.iter().map(|x| root / x).collect()
            }
            Region::Disc => vec![1.0; radii.len()],
        }
    }

    /// z at the inner edge of an annulus, which is given.
    fn inner_image(&self, span: f64) -> f64 {
        match self.mesh.region {
            Region::Annulus => self.scale(span, self.inner_radius) * self.inside.edge_image(),
            Region::Disc => 0.0,
        }
    }

    /// Depth (m) at a radius outside the front that belongs to the image inside it.
    pub(crate) fn depth_from_inside(&self, r: f64) -> f64 {
        self.sources.depth_and_slope(r * r).0
    }

    /// Depths of the state that belong to images given at the nodes, m.
    pub(crate) fn depths(&self, images: &[f64], radius_squared: f64) -> Vec<f64> {
        let (n, span) = (self.cells(), self.span(radius_squared));
        let radii = self.radii(radius_squared);
        let mut z: Vec<f64> = images.iter().zip(&radii).map(|(h, x)| h * self.scale(span, *x)).collect();
        if self.mesh.first() == 1 {
            z[0] = self.inner_image(span);
        }
        let mut depth = self.mesh.inverse_abel(&z);
        add(&mut depth, -self.outside.depth_and_slope(radius_squared).0, &self.mesh.share);
        if !self.rim {
            // the depth at the edge is known: the error of taking the image over must not all go to
            // the last cell; and none to the image next to the front, or it would creep
            let error = self.edge_depth(radius_squared).0 - depth[n];
            let behind = depth.iter_mut().zip(&self.mesh.share).skip(FRONT_CELLS + 1);
            behind.for_each(|(w, share)| *w += error * share);
        }
        depth
    }

    /// Largest image (m) from a node on, of those whose image is free, that belongs to z.
    pub(crate) fn largest_image(&self, from: usize, z: &[f64], rate: &Rate) -> f64 {
        let images = z.iter().zip(&rate.scale).map(|(z, b)| (z / b).abs());
        images.skip(self.mesh.first().max(from)).fold(0.0, f64::max)
    }

    /// Image of the wear (m) at the radii that one or two parts a cell give.
    pub(crate) fn worn_image(&self, rate: &Rate, parts: usize, radii: &[f64]) -> Vec<f64> {
        let span = self.span(rate.radius_squared);
        let z = self.mesh.images(parts, &rate.image);
        let mut h: Vec<f64> = z.iter().zip(radii).map(|(z, x)| z / self.scale(span, *x)).collect();
        if self.mesh.first() == 1 {
            h[0] = self.inside.edge_image();
        }
        h
    }

    /// The contact of a state.
    pub(crate) fn contact(&self, rate: &Rate) -> Contact {
        let radius = rate.radius_squared.sqrt();
        let load = if self.is_force() {
            self.motion.value
        } else {
            let span = self.span(rate.radius_squared);
            let worn = self.inside_width + span.sqrt() * dot(&self.mesh.width, &rate.image);
            let excess = Some(self.excess(rate.radius_squared));
            let body = self.body_load(rate.radius_squared, excess).0;
            let overlap = rate.indentation - self.body.image(radius);
            (self.length(rate.radius_squared, excess).0 * overlap + body - worn).max(0.0)
        };
        Contact { control: self.motion.value, depth: rate.indentation, radius, load }
    }
}

/// The error of a patch that cannot go on.
pub(crate) fn edge_not_found(motion: &Motion) -> Error {
    Error::NotFinite {
        what: "the contact edge of the worn profile",
        normal: motion.value,
        displacement: motion.sliding.amplitude(),
    }
}
