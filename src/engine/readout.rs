//! What can be read from a contact. Scalars come from the knots; fields are computed when asked
//! for.

use super::{FrettingContact, SlipState};
use crate::friction::norm;
use crate::range::LEAST_RISE;
use crate::surface::{Contact, Nodes, Place, Slopes};
use crate::transform;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Relative distance at which a radius lies beside another, where the slope of the image jumps: at
/// the stick radius of a worn profile, at the apex of a cone.
pub(super) const ASIDE: f64 = 1e-9;

/// Number of probe radii.
const PROBES: usize = 64;

/// Rings across the contact. The largest pressure is reached throughout one of them: at a distance
/// δ from a place where it is infinite it rises like 1/√δ, so that twice as many rings show √2
/// times as much.
const RINGS: usize = 64;

/// Forces, lengths, work and wear as they are now.
impl FrettingContact {
    /// Tangential displacement U of the body in the contact, m; in cyclic loading its amplitude.
    /// Where there is a rig stiffness, [`Self::drive_displacement`] is that of the drive.
    pub fn displacement(&self) -> f64 {
        self.state.place.x
    }

    /// Tangential force T = 2G* ∫ u dx along x that the moving body exerts on the substrate, N; |T|
    /// ≤ μF_N.
    pub fn tangential_force(&self) -> f64 {
        self.force().x
    }

    /// Both components of the tangential force, N.
    #[inline]
    pub(super) fn force(&self) -> Vector2<f64> {
        let integral = self.state.row.deflection_integral(self.model.axes.for_springs(self.state.place));
        let force = 2.0 * self.model.constants.tangential_modulus * integral;
        let (size, limit) = (norm(force), self.friction_limit());
        // of a size that is rounding, too
        if size > limit { force / size * limit } else { force }
    }

    /// Elastic energy of the springs, J.
    pub(super) fn stored_energy(&self) -> f64 {
        let place = self.model.axes.for_springs(self.state.place);
        let integral = self.state.row.energy_integral(place, self.model.axes.stiffness_ratio);
        self.model.constants.tangential_modulus * integral
    }

    /// Elastic energy (J) of shares of the springs, each from a place on.
    pub(super) fn energy_of(&self, shares: &[(Place, f64)]) -> f64 {
        let place = self.model.axes.for_springs(self.state.place);
        let integral = self.state.row.energy_integral_of((place, self.model.axes.stiffness_ratio), shares);
        self.model.constants.tangential_modulus * integral
    }

    /// Most that friction can carry, μF_N, N.
    pub(super) fn friction_limit(&self) -> f64 {
        self.model.constants.friction_coefficient * self.normal_reaction()
    }

    /// Normal force F_N, N; 0 where the bodies are apart.
    pub fn normal_reaction(&self) -> f64 {
        self.force_scale() * self.state.contact.load
    }

    /// Indentation depth d, m; under force control of separated bodies, that of first touch.
    pub fn indentation_depth(&self) -> f64 {
        self.state.contact.depth
    }

    /// Contact radius a, m. Of an ellipse with the semi-axes [`Self::contact_semi_axes`] it is
    /// √(a b), the radius of the circle of the same area.
    pub fn contact_radius(&self) -> f64 {
        self.model.axes.size * self.state.contact.radius
    }

    /// Stick radius c, m: inner edge of the outer annulus in which all springs are at their
    /// friction bound on one side; 0 in gross slip, a in full stick. In an ellipse the stick region
    /// has the shape of the contact, and this is the radius of the circle of its area.
    pub fn stick_radius(&self) -> f64 {
        self.model.axes.size * self.stick_edge()
    }

    /// The stick radius of the equivalent sphere, m.
    fn stick_edge(&self) -> f64 {
        if let Some(standing) = self.standing() {
            return standing.stick_radius();
        }
        self.slip_zone().0
    }

    /// [`Row::slip_zone`] of the present row.
    #[inline]
    pub(super) fn slip_zone(&self) -> (f64, f64) {
        self.state.row.slip_zone(&self.state.contact, self.model.bound_slope, self.state.place.x)
    }

    /// Work of friction so far, J.
    pub fn dissipated_energy(&self) -> f64 {
        self.state.work
    }

    /// Volume (k₁/σ₁ + k₂/σ₂) W that both bodies have lost so far, m³: the exact integral of the
    /// wear law, at every instant. Each part of the work counts by the coefficient of its time.
    pub fn wear_volume(&self) -> f64 {
        let [body_1, body_2] = self.wear_volumes();
        body_1 + body_2
    }

    /// Volumes worn off body 1 and body 2 so far, m³; their sum is [`Self::wear_volume`].
    pub fn wear_volumes(&self) -> [f64; 2] {
        let per_work = self.model.parameters.wear_per_work_of_bodies();
        let work = self.state.work - self.state.former.work;
        [0, 1].map(|body| self.state.former.volumes[body] + per_work[body] * work)
    }

    /// Stick, partial slip, gross slip or separated.
    pub fn slip_state(&self) -> SlipState {
        let stick = self.stick_edge();
        if self.state.contact.is_open() {
            SlipState::Separated
        } else if stick <= 0.0 {
            SlipState::GrossSlip
        } else if stick < self.state.contact.radius {
            SlipState::PartialSlip
        } else {
            SlipState::Stick
        }
    }
}

/// Stiffness.
impl FrettingContact {
    /// ∂F_N/∂d = 2E*a, N/m.
    pub fn normal_stiffness(&self) -> f64 {
        self.force_scale() * self.state.contact.radius
    }

    /// ∂T/∂U for going on in the direction of the last movement, N/m: 2G* times the length of
    /// springs that stick. Where others slip as the load falls, it is that with them slipping on.
    pub fn tangential_stiffness(&self) -> f64 {
        if self.state.row.is_plane() {
            let ahead = self.state.direction;
            return ahead.dot(&(self.tangent().stiffness * ahead));
        }
        2.0 * self.model.constants.tangential_modulus * self.moving_zone().0
    }
}

/// Fields over the radius, and what is found from them.
impl FrettingContact {
    /// 64 radii from the axis to [`crate::Parameters::probe_radius_max`], m; where that is 0, to
    /// the outermost radius that has ever been in contact. None lies beyond the end of the body.
    ///
    /// In an ellipse a radius r stands for the points of the ellipse of the shape of the contact
    /// whose area is π r²: the pressure is the same at all of them, and so is the traction.
    pub fn probe_radii(&self) -> [f64; PROBES] {
        let fixed = self.model.parameters.probe_radius_max.min(self.surface.profile().outer_radius());
        Self::radii_up_to(if fixed > 0.0 { fixed } else { self.model.axes.size * self.state.reach })
    }

    /// 64 radii over all that has ever been in contact, m.
    pub(super) fn reached_radii(&self) -> [f64; PROBES] {
        Self::radii_up_to(self.model.axes.size * self.state.reach)
    }

    fn radii_up_to(outer: f64) -> [f64; PROBES] {
        std::array::from_fn(|i| outer * i as f64 / (PROBES - 1) as f64)
    }

    /// Height f of the unworn profile at radius r, m; for an ellipse that of its equivalent sphere.
    pub fn unworn_height_at(&self, r: f64) -> f64 {
        self.surface.profile().height(self.model.axes.inner(r))
    }

    /// Height f of the worn profile at radius r, m: the unworn profile and the worn depth of both
    /// bodies. It is the gap between the bodies where they touch without load at the unworn tip.
    pub fn profile_height_at(&self, r: f64) -> f64 {
        self.unworn_height_at(r) + self.worn_depth_at(r)
    }

    /// Work of friction per area at radius r so far, J/m²: worn depth over k₁/σ₁ + k₂/σ₂. `None`
    /// where that is not known: without wear it is not gathered, and after a change of a wear
    /// coefficient the depths of before and after it are added up. A wear coefficient of 1e-12
    /// gathers it and leaves the profile as it is.
    pub fn energy_density_at(&self, r: f64) -> Option<f64> {
        if self.model.constants.friction_coefficient == 0.0 {
            return Some(0.0);
        }
        let known = self.state.wear.is_some() && !self.state.former.mixed;
        known.then(|| self.worn_depth_at(r) / self.model.constants.wear_per_work)
    }

    /// 1-D image g of the profile at x, m, as the contact sees it now; for an ellipse that of its
    /// equivalent sphere.
    pub fn image_at(&self, x: f64) -> f64 {
        self.surface.image(self.model.axes.inner(x))
    }

    /// Worn depth w at radius r, the sum of both bodies, m.
    pub fn worn_depth_at(&self, r: f64) -> f64 {
        self.view(|nodes, more| nodes.depth_at(r) + nodes.line(more, r)).unwrap_or(0.0)
    }

    /// Deepest worn point, the sum of both bodies, m. An update of the profile may lower it by up
    /// to 1 %, and by more where a kink or a rim begins to wear: how much the wear since the last
    /// one relieves the pressure is estimated.
    pub fn wear_depth(&self) -> f64 {
        self.view(|nodes, more| nodes.depths_with(more).fold(0.0, f64::max)).unwrap_or(0.0)
    }

    /// Volume of the worn profile by its image h, 4 ∫ h √(a² − x²) dx = ∫ 2πr w dr, m³: the same as
    /// [`Self::wear_volume`] by another route, the transforms.
    pub fn profile_volume(&self) -> f64 {
        let updated = self.surface.worn().map_or(0.0, Nodes::image_volume);
        updated + self.view(Nodes::volume).unwrap_or(0.0)
    }

    /// Σ |∫A dA − W| over all profile updates of a transient history, J: what the transforms of
    /// slip and pressure, whose product is the work per area A, miss of the springs' work W.
    pub fn transform_defect(&self) -> f64 {
        self.state.wear.as_ref().map_or(0.0, |wear| wear.defect)
    }

    /// Work that was left out since its sign would heal the profile, J.
    pub fn clipped_work(&self) -> f64 {
        self.state.wear.as_ref().map_or(0.0, |wear| wear.clipped)
    }

    /// Normal pressure p at radius r, Pa (eq. (12)); infinite at the singular points of an unworn
    /// cone or flat.
    pub fn pressure_at(&self, r: f64) -> f64 {
        let contact = &self.state.contact;
        let slopes = self.slopes(contact.radius);
        self.model.axes.stress(self.pressure_in((contact, &slopes), self.model.axes.inner(r)))
    }

    fn pressure_in(&self, (contact, slopes): (&Contact, &Slopes), r: f64) -> f64 {
        let a = contact.radius;
        if r >= a {
            return 0.0;
        }
        let jump = (contact.depth - self.surface.image(a)).max(0.0);
        let edge = if a >= self.surface.profile().outer_radius() { jump / transform::leg(a, r) } else { 0.0 };
        self.model.constants.normal_modulus / PI * (slopes.integral(r, a) + edge)
    }

    /// A radius (m) beside one at which the pressure is infinite, as at the apex of a cone, where
    /// the traction may be a difference of infinities.
    pub(super) fn off_the_apex(&self, slopes: &Slopes, r: f64) -> f64 {
        let a = self.state.contact.radius;
        if slopes.integral(r, a).is_finite() { r } else { r + ASIDE * a }
    }

    /// Tangential traction τ at radius r, Pa, along x (eq. (17)).
    pub fn shear_traction_at(&self, r: f64) -> f64 {
        self.traction_at(r).x
    }

    /// Both components of the traction, Pa. The deflection u is linear in g between the springs: τ
    /// = −(G*/π) Σ (Δu/Δg) ∫ g' dx/√(x² − r²).
    pub(super) fn traction_at(&self, r: f64) -> Vector2<f64> {
        let (a, r) = (self.state.contact.radius, self.model.axes.inner(r));
        if r >= a {
            return Vector2::zeros();
        }
        let slopes = self.slopes(a);
        let r = self.off_the_apex(&slopes, r);
        let place = self.model.axes.for_springs(self.state.place);
        let (mut sum, mut inner) = (Vector2::zeros(), None);
        for (outer, origin) in self.state.row.origins(place.y) {
            if let Some((Place { x, image, .. }, inner_origin)) = inner.replace((outer, origin))
                && outer.x > r
                && outer.image - image > LEAST_RISE
                && origin != inner_origin
            {
                let integral = slopes.integral_between(r, (x.max(r), outer.x));
                sum += (origin - inner_origin) / (outer.image - image) * integral;
            }
        }
        if let Some((_, edge)) = inner
            && a >= self.surface.profile().outer_radius()
        {
            sum += (place - edge) / transform::leg(a, r);
        }
        sum.map(|part| self.model.axes.stress(self.model.constants.tangential_modulus / PI * part))
    }

    /// Largest pressure, Pa: that on the axis, or the largest that is reached throughout a ring of
    /// a width of 1/64 of the contact radius. Higher peaks are narrower: at the rim of a punch, at
    /// the apex of a cone and, where all that slips has worn off, at the stick front the pressure
    /// is infinite.
    pub fn max_pressure(&self) -> f64 {
        self.max_pressure_in(&self.state.contact)
    }

    /// The same in a contact of this surface.
    pub(super) fn max_pressure_in(&self, contact: &Contact) -> f64 {
        let a = contact.radius;
        // one moved for a derivative may have any radius
        if !(a > 0.0 && a.is_finite()) {
            return 0.0;
        }
        let slopes = self.slopes(a);
        let half_rings = 2 * RINGS;
        let radius = |k: usize| a * k as f64 / half_rings as f64;
        let pressures: Vec<f64> =
            (0..=half_rings).map(|k| self.pressure_in((contact, &slopes), radius(k))).collect();
        let on_ring = |ring: &[f64]| ring.iter().copied().fold(f64::INFINITY, f64::min);
        let on_axis = Some(pressures[0]).filter(|pressure| pressure.is_finite());
        let most = pressures.windows(3).map(on_ring).chain(on_axis).fold(0.0, f64::max);
        self.model.axes.stress(most)
    }
}
