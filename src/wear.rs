//! Wear by the Reye–Archard–Khrushchov law (paper, eq. (18)): dw = (k/σ₀) τ ds at each radius.
//!
//! Between profile updates slip is gathered in one dimension ([`WearBacklog`]). A backlog is worn
//! off by [`integrate`], on a mesh that moves with the contact edge, where it is motion on a line
//! at one load, else by one implicit update ([`worn_depth`]) on nodes at rest.
//!
//! The update is linearly implicit: pressure falls where material goes, so with the pressure of the
//! *new* profile, p + ∂p/∂h Δh, the worn depth Δw = D\[Δh\] obeys
//!
//! (D + κ E* B P) Δh = (k/σ₀) A, κ = kμ/σ₀,
//!
//! with A the work of friction per area, B the slip path, D the transform from image to profile and
//! P = −∂p/∂(E* h). An explicit update would have to remove less than about (4/π)(p/E*) Δr at a
//! time, which the fine cells at a stick front make hopeless. D is lower triangular: nodes that
//! have not slipped get Δh = 0 exactly, whatever happens outside.

mod backlog;
mod course;
mod edge;
mod export;
mod fields;
mod first_order;
mod krylov;
mod life;
mod mesh;
mod patch;
mod relief;
mod remesh;
mod rosenbrock;
mod settings;
mod system;
mod update;

pub(crate) use backlog::{RepeatedMotion, SAME, SlipAtDepth, WearBacklog};
pub(crate) use fields::SlipFields;
pub(crate) use first_order::FirstOrderWear;
pub(crate) use life::integrate;
pub(crate) use mesh::UnitMesh;
pub(crate) use patch::{Mixture, Motion, Rig, Sliding};
pub(crate) use relief::{change_of_mean_work, uncounted_shares};
pub(crate) use remesh::THINNEST;
pub(crate) use settings::{Amount, IntegrationSettings, Part, thinning};
pub(crate) use update::{Update, worn_depth};

use crate::surface::{Contact, Surface};
use std::f64::consts::PI;

/// Constants that the update needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Constants {
    /// E*, Pa.
    pub(crate) normal_modulus: f64,
    /// G*, Pa.
    pub(crate) tangential_modulus: f64,
    /// μ.
    pub(crate) friction_coefficient: f64,
    /// k/σ₀, m³/J.
    pub(crate) wear_per_work: f64,
    /// Whether the load, not the depth, is held while the profile changes.
    pub(crate) force_control: bool,
}

impl Constants {
    /// m = μE*/G*, slope of the friction bound.
    pub(crate) fn bound_slope(&self) -> f64 {
        self.friction_coefficient * self.normal_modulus / self.tangential_modulus
    }
}

/// Largest worn volume between two profile updates, m³: a share of what the slipping annulus still
/// has to lose. The scale is at least a tenth of the depth, as the contact nears its final state.
pub(crate) fn update_limit(tolerance: f64, surface: &Surface, contact: &Contact, stick_radius: f64) -> f64 {
    tolerance * left_to_lose(surface, contact, stick_radius, contact.depth.abs())
}

/// The same where strokes slip outside a radius (m), however thin that annulus is: the scale is at
/// least a tenth of the overlap there.
pub(crate) fn limit_of_zone(tolerance: f64, surface: &Surface, contact: &Contact, inner: f64) -> f64 {
    tolerance * left_to_lose(surface, contact, inner, contact.depth - surface.image(inner))
}

/// Volume that an annulus still has to lose, m³, by at least a tenth of an overlap, m.
fn left_to_lose(surface: &Surface, contact: &Contact, inner: f64, overlap: f64) -> f64 {
    annulus(contact, inner) * room(surface, contact, inner).max(0.1 * overlap)
}

/// Twice the mean approach d − g of the slipping annulus, m; 0 where there is none.
fn room(surface: &Surface, contact: &Contact, stick_radius: f64) -> f64 {
    let width = (contact.radius - stick_radius).max(0.0);
    if width == 0.0 {
        return 0.0;
    }
    let inner = surface.place(stick_radius);
    2.0 * (contact.load - inner.load - stick_radius * (contact.depth - inner.image)) / width
}

/// Ratio of a worn volume to [`update_limit`] where it exceeds that.
pub(crate) fn exceeds_limit(
    volume: f64,
    tolerance: f64,
    surface: &Surface,
    contact: &Contact,
    stick_radius: f64,
) -> Option<f64> {
    // most steps wear far less than the least value of the limit, which costs nothing to compute
    if volume <= 0.1 * tolerance * annulus(contact, stick_radius) * contact.depth.abs() {
        return None;
    }
    let limit = update_limit(tolerance, surface, contact, stick_radius);
    // of a contact so small that the limit is lost to underflow, any wear is infinitely much
    let slips = stick_radius < contact.radius && contact.depth > 0.0;
    (volume > limit && (limit > 0.0 || slips)).then(|| volume / limit)
}

/// π a² d of a contact, m³.
pub(crate) fn disc(contact: &Contact) -> f64 {
    annulus(contact, 0.0) * contact.depth.abs()
}

/// A volume (m³) or work (J) over that of a contact; 0 where the bodies are apart.
pub(crate) fn per_disc(amount: f64, contact: &Contact) -> f64 {
    let size = disc(contact);
    if size > 0.0 { amount / size } else { 0.0 }
}

/// Area of the slipping annulus, m².
fn annulus(contact: &Contact, stick_radius: f64) -> f64 {
    PI * (contact.radius - stick_radius).max(0.0) * (contact.radius + stick_radius)
}
