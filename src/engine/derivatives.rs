//! Partial derivatives of what can be read with respect to the two inputs of a step, for masters
//! that solve implicitly.
//!
//! They are those of the law in the **present sliding direction**: springs that stick keep their
//! deflection, those of the slip zone (outside the stick radius c, at +b or −b, b = m (d − g))
//! follow their bound. The law is piecewise linear and turns from one piece to another at a
//! reversal, and where the load rises so fast that the slip zone sticks, s δU < m δd (s is the side
//! of the zone); the derivatives belong to the other side of that, s δU > m δd. Where nothing slips
//! yet, they are those for going on as before. The profile is taken as it is: what wear does to it
//! is slow and comes at its updates.
//!
//! With I = ∫ from c to a of (d − g) dx, per unit of depth and of displacement (Popov & Heß,
//! chapters 3 and 5):
//!
//! | quantity | ∂/∂d | ∂/∂U |
//! | --- | --- | --- |
//! | F_N = 2E* ∫(d − g) dx | 2E*a | 0 |
//! | a, where g(a) = d | 1/g'(a); 0 at the end of the body | 0 |
//! | T = 2G* ∫u dx | 2G* m s (a − c) | 2G*c |
//! | W | −2G* m² I | 2G* m s I |
//! | c, where s (U − e(c)) = b(c) | m/(g'(c) (m − s e')) | −s/(g'(c) (m − s e')), e' = de/dg inside c |
//!
//! Motion along y that starts on a line along x turns the springs that slip without pulling them:
//! ∂T_y/∂U_y = 2G*a, all else is 0. Once the body has moved in the plane, see [`super::planar`].
//!
//! While friction runs in, m is a function of W, and its change is part of the derivatives of T, W
//! and c ([`Tangent::running_in`]); stiffness and worn depth are taken at the present m.
//!
//! Under force control all of the first column is divided by ∂F_N/∂d. Where the bodies are apart
//! everything is constant, except the depth under depth control.

use super::FrettingContact;
use super::readout::ASIDE;
use crate::friction::{self, Tangent};
use crate::quadrature;
use crate::surface::Contact;
use nalgebra::{Matrix2, Vector2};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// Partial derivatives of one quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Gradient {
    /// With respect to the prescribed normal quantity: per N or, under depth control, per m.
    pub normal: f64,
    /// With respect to the displacement along x that is given, per m.
    pub displacement: f64,
    /// With respect to the displacement along y, per m.
    pub displacement_y: f64,
    /// With respect to the rotation of an [`crate::Interface`], per rad; 0 for a single contact.
    pub rotation: f64,
}

impl Gradient {
    /// This times a factor; what is infinite there, where a front jumps, is no derivative and
    /// becomes 0.
    pub(crate) fn times(self, factor: f64) -> Self {
        let finite = |value: f64| if value.is_finite() { value } else { 0.0 };
        Self {
            normal: finite(self.normal * factor),
            displacement: finite(self.displacement * factor),
            displacement_y: finite(self.displacement_y * factor),
            rotation: finite(self.rotation * factor),
        }
    }

    /// The sum of this and another.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        Self {
            normal: self.normal + other.normal,
            displacement: self.displacement + other.displacement,
            displacement_y: self.displacement_y + other.displacement_y,
            rotation: self.rotation + other.rotation,
        }
    }
}

/// Relative change of the depth for the one quantity without a closed derivative.
const STEP: f64 = 1e-6;

/// Where in a cell, as a share of its width in x², the pressure is that of its inner node, if it is
/// infinite there. A node takes the image for a line in x²: with q = −k √(x² − r²) over a cell, it
/// has the part (2/π) k of the pressure. At a share s there is (k/π) arcosh(1/√s), so that s =
/// 1/cosh² 2.
const SHARE_OF_NODE: f64 = 0.070_650_824_853;

/// Derivatives by the inputs, and rates per cycle.
impl FrettingContact {
    /// Gradient from derivatives with respect to depth and displacement.
    pub(super) fn gradient(&self, by_depth: f64, by_place: Vector2<f64>) -> Gradient {
        let [displacement, displacement_y] = by_place.into();
        let normal = by_depth * self.depth_per_normal();
        let gradient = Gradient { normal, displacement, displacement_y, ..Gradient::default() };
        self.behind_the_rig(gradient).times(if self.state.contact.is_open() { 0.0 } else { 1.0 })
    }

    /// The same where nothing depends on the displacement along y.
    fn gradient_on_line(&self, by_depth: f64, by_displacement: f64) -> Gradient {
        self.gradient(by_depth, Vector2::new(by_displacement, 0.0))
    }

    /// Derivatives of force and work for going on in the present direction at the present
    /// coefficient of friction.
    pub(super) fn tangent(&self) -> Tangent {
        let row = 2.0 * self.model.constants.tangential_modulus;
        if let Some(standing) = self.standing() {
            return standing.tangent().scaled(row);
        }
        let ((stick, side), radius) = (self.moving_zone(), self.state.contact.radius);
        let (bound_slope, room) = (self.model.bound_slope, self.room_outside(stick));
        let on_line = Tangent {
            stiffness: Matrix2::new(stick, 0.0, 0.0, self.model.axes.stiffness_ratio * radius),
            by_depth: Vector2::new(bound_slope * side * (radius - stick), 0.0),
            work: Vector2::new(bound_slope * side * room, 0.0),
            work_by_depth: -bound_slope * bound_slope * room,
            bound_square: self.bound_square_outside(stick),
        };
        on_line.scaled(row)
    }

    /// The same with the change of the coefficient while friction runs in.
    pub(super) fn tangent_running_in(&self) -> Tangent {
        self.tangent().running_in(self.bound_growth())
    }

    /// ∂b/∂d and ∂b/∂**U** of the friction bound b = m (d − g) at a radius, m.
    pub(super) fn bound_gradient(&self, x: f64) -> (f64, Vector2<f64>) {
        let (slope, growth) = (self.model.bound_slope, self.bound_growth());
        if growth == 0.0 {
            return (slope, Vector2::zeros());
        }
        let tangent = self.tangent_running_in();
        let bound = growth * slope * (self.state.contact.depth - self.surface.image(x));
        (slope + bound * tangent.work_by_depth, bound * tangent.work)
    }

    /// ∂d/∂(prescribed normal quantity) of a closed contact.
    pub(super) fn depth_per_normal(&self) -> f64 {
        if self.model.constants.force_control { 1.0 / self.normal_stiffness() } else { 1.0 }
    }

    /// Stick radius and side s of the slip zone for going on; s = ±1 also where that zone is still
    /// empty. Where the load falls as fast as the motion turns back, the zone stays on its side.
    pub(super) fn moving_zone(&self) -> (f64, f64) {
        let (stick, side) = self.slip_zone();
        let onward = if self.state.direction.x < 0.0 { -1.0 } else { 1.0 };
        (stick, if side == 0.0 { onward } else { side })
    }

    /// I = ∫ from c to a of (d − g) dx, m².
    fn room_outside(&self, stick: f64) -> f64 {
        if stick >= self.state.contact.radius {
            return 0.0;
        }
        let inner = self.surface.place(stick);
        (self.state.contact.load - inner.load - stick * (self.state.contact.depth - inner.image)).max(0.0)
    }

    /// ∫ b² dx from c to a of the bound b, m³; asked for while friction runs in.
    fn bound_square_outside(&self, stick: f64) -> f64 {
        let Contact { radius, depth, .. } = self.state.contact;
        if stick >= radius || !self.runs_in() {
            return 0.0;
        }
        let ends = (&self.surface.place(stick), &self.surface.place(radius));
        friction::bound_square(ends, depth, self.model.bound_slope)
    }

    /// Of [`Self::normal_reaction`].
    pub fn normal_reaction_gradient(&self) -> Gradient {
        self.gradient_on_line(self.normal_stiffness(), 0.0)
    }

    /// Of [`Self::indentation_depth`].
    pub fn indentation_depth_gradient(&self) -> Gradient {
        if self.model.constants.force_control {
            self.gradient_on_line(1.0, 0.0)
        } else {
            Gradient { normal: 1.0, ..Gradient::default() }
        }
    }

    /// Of [`Self::contact_radius`].
    pub fn contact_radius_gradient(&self) -> Gradient {
        let radius = self.state.contact.radius;
        if radius >= self.surface.profile().outer_radius() {
            return Gradient::default();
        }
        self.gradient_on_line(self.model.axes.size / self.surface.image_slope(radius), 0.0)
    }

    /// Of the two [`Self::contact_semi_axes`].
    pub fn contact_semi_axes_gradient(&self) -> [Gradient; 2] {
        let factors = self.model.axes.per_contact_radius();
        factors.map(|factor| self.contact_radius_gradient().times(factor))
    }

    /// Of [`Self::normal_stiffness`].
    pub fn normal_stiffness_gradient(&self) -> Gradient {
        self.contact_radius_gradient().times(self.force_scale() / self.model.axes.size)
    }

    /// Of [`Self::tangential_force`]; the part by displacement is [`Self::tangential_stiffness`] k
    /// or, behind a rig, k k_rig/(k + k_rig). While friction runs in, the change of its coefficient
    /// is part of it.
    pub fn tangential_force_gradient(&self) -> Gradient {
        self.force_gradient(0)
    }

    /// Of [`Self::tangential_force_y`].
    pub fn tangential_force_y_gradient(&self) -> Gradient {
        self.force_gradient(1)
    }

    fn force_gradient(&self, component: usize) -> Gradient {
        let tangent = self.tangent_running_in();
        self.gradient(tangent.by_depth[component], tangent.stiffness.row(component).transpose())
    }

    /// Of [`Self::displacement`].
    pub fn displacement_gradient(&self) -> Gradient {
        self.place_gradient(Vector2::new(1.0, 0.0))
    }

    /// Of [`Self::displacement_y`].
    pub fn displacement_y_gradient(&self) -> Gradient {
        self.place_gradient(Vector2::new(0.0, 1.0))
    }

    /// Of the displacement in a direction.
    fn place_gradient(&self, along: Vector2<f64>) -> Gradient {
        if self.state.contact.is_open() {
            Gradient { displacement: along.x, displacement_y: along.y, ..Gradient::default() }
        } else {
            self.gradient(0.0, along)
        }
    }

    /// Of [`Self::stick_radius`]; 0 where the front jumps, as on a flat punch, in gross slip, and
    /// where all springs up to the end of the body stick.
    pub fn stick_radius_gradient(&self) -> Gradient {
        if let Some(gradient) = self.stick_gradient_in_plane() {
            return gradient;
        }
        let (stick, side) = self.moving_zone();
        if stick <= 0.0 || stick >= self.surface.profile().outer_radius() {
            return Gradient::default();
        }
        let knots = self.state.row.on_line();
        let outer = knots.partition_point(|knot| knot.place.x < stick * (1.0 - ASIDE)).max(1);
        let Some([inner, outer]) = knots.get(outer - 1..=outer) else { return Gradient::default() };
        let rise = outer.place.image - inner.place.image;
        let origin_slope = if rise > 0.0 { (outer.origin - inner.origin) / rise } else { 0.0 };
        let per_bound = 1.0
            / (self.surface.image_slope(stick * (1.0 - ASIDE))
                * (self.model.bound_slope - side * origin_slope));
        let (by_depth, by_place) = self.bound_gradient(stick);
        self.gradient_on_line(by_depth * per_bound, (by_place.x - side) * per_bound)
            .times(self.model.axes.size)
    }

    /// Of [`Self::tangential_stiffness`].
    pub fn tangential_stiffness_gradient(&self) -> Gradient {
        if let Some(gradient) = self.stiffness_gradient_in_plane() {
            return gradient;
        }
        self.stick_radius_gradient()
            .times(2.0 * self.model.constants.tangential_modulus / self.model.axes.size)
    }

    /// Of [`Self::dissipated_energy`].
    pub fn dissipated_energy_gradient(&self) -> Gradient {
        let tangent = self.tangent_running_in();
        self.gradient(tangent.work_by_depth, tangent.work)
    }

    /// Of [`Self::wear_volume`].
    pub fn wear_volume_gradient(&self) -> Gradient {
        self.dissipated_energy_gradient().times(self.model.constants.wear_per_work)
    }

    /// Of [`Self::wear_volumes`].
    pub fn wear_volumes_gradient(&self) -> [Gradient; 2] {
        let work = self.dissipated_energy_gradient();
        self.model.parameters.wear_per_work_of_bodies().map(|per_work| work.times(per_work))
    }

    /// Of [`Self::wear_depth`]: dw = (k/σ₀) |τ| ds at the deepest point, where a slip δ of all
    /// springs outside c moves the surface by δ (2/π) arccos(c/r).
    pub fn wear_depth_gradient(&self) -> Gradient {
        if let Some(gradient) = self.wear_depth_gradient_in_plane() {
            return gradient;
        }
        let (stick, side) = self.moving_zone();
        let rate = |r: f64| {
            let share = if stick < r { FRAC_2_PI * (stick / r).acos() } else { 0.0 };
            let share = if stick == 0.0 { 1.0 } else { share };
            let traction = (side * self.shear_traction_at(r)).max(0.0);
            if traction.is_finite() { self.model.constants.wear_per_work * traction * share } else { 0.0 }
        };
        let rate = if self.state.wear.is_some() { self.at_deepest(rate) } else { 0.0 };
        self.gradient_on_line(-self.model.bound_slope * rate, side * rate)
    }

    /// A rate at the deepest worn point, or the largest where nothing has worn.
    fn at_deepest(&self, rate: impl Fn(f64) -> f64) -> f64 {
        match self.deepest() {
            Some(r) => rate(r),
            None => self.reached_radii().into_iter().map(rate).fold(0.0, f64::max),
        }
    }

    /// Radius of the deepest worn point, m, once something has worn; where the pressure is infinite
    /// there, as at the apex of a cone until it has worn round, one beside it with the pressure by
    /// which its node wears.
    pub(super) fn deepest(&self) -> Option<f64> {
        let (r, next) = self.view(|nodes, more| {
            let depths = nodes.depths_with(more).enumerate();
            let (j, depth) = depths.max_by(|a, b| a.1.total_cmp(&b.1))?;
            let x = nodes.x();
            (depth > 0.0).then(|| (x[j], x[(j + 1).min(nodes.last())]))
        })??;
        if self.pressure_at(self.model.axes.size * r).is_finite() {
            return Some(r);
        }
        Some((r * r + SHARE_OF_NODE * (next - r) * (next + r)).sqrt())
    }

    /// Of [`Self::max_pressure`], by central differences in the depth: it is one of many places
    /// that move with the edge.
    pub fn max_pressure_gradient(&self) -> Gradient {
        let Contact { radius, depth, load, .. } = self.state.contact;
        // held in depth, a body may wear until it carries nothing
        if radius == 0.0 || load == 0.0 {
            return Gradient::default();
        }
        // mean approach of the contact: the depth may be small beside it where the profile is worn
        let step = STEP * load / radius;
        let growth = if radius >= self.surface.profile().outer_radius() {
            0.0
        } else {
            1.0 / self.surface.image_slope(radius)
        };
        let pressure = |change: f64| {
            let moved =
                Contact { depth: depth + change, radius: radius + growth * change, ..self.state.contact };
            self.max_pressure_in(&moved)
        };
        self.gradient_on_line((pressure(step) - pressure(-step)) / (2.0 * step), 0.0)
    }

    /// Work of one cycle of this amplitude (m) at the present load and profile, J. The amplitude is
    /// the drive's here, too.
    pub fn work_per_cycle(&self, amplitude: f64) -> f64 {
        let mut copy = self.clone();
        let amplitude = copy.own_amplitude(amplitude);
        4.0 * copy.quarter(&self.state.contact, amplitude).1
    }

    /// Volume that one cycle of this amplitude (m) wears, m³.
    pub fn wear_volume_per_cycle(&self, amplitude: f64) -> f64 {
        self.model.constants.wear_per_work * self.work_per_cycle(amplitude)
    }

    /// Volumes that one cycle of this amplitude (m) wears off body 1 and body 2, m³.
    pub fn wear_volumes_per_cycle(&self, amplitude: f64) -> [f64; 2] {
        let work = self.work_per_cycle(amplitude);
        self.model.parameters.wear_per_work_of_bodies().map(|per_work| per_work * work)
    }

    /// Depth by which one cycle of this amplitude (m) wears the deepest point: dw/dN = 4 (kμ/σ₀) p
    /// s there, with the surface slip s = (2/π) ∫ (U₀ − b(x))⁺ dx/√(r² − x²) from 0 to r, b = m (d
    /// − g).
    pub fn wear_depth_per_cycle(&self, amplitude: f64) -> f64 {
        if self.state.wear.is_none() || self.state.contact.is_open() {
            return 0.0;
        }
        let amplitude =
            if self.model.compliance > 0.0 { self.clone().own_amplitude(amplitude) } else { amplitude };
        let per_length = self.model.constants.wear_per_work * self.model.constants.friction_coefficient;
        let room =
            |x: f64| self.model.bound_slope * (self.state.contact.depth - self.surface.image(x)).max(0.0);
        let bound_depth = self.state.contact.depth - amplitude / self.model.bound_slope;
        let stick = if bound_depth > self.surface.tip() {
            self.surface.radius_of_image(bound_depth, 0.0, self.state.contact.radius)
        } else {
            0.0
        };
        let rate = |r: f64| {
            if r < stick || r >= self.state.contact.radius {
                return 0.0;
            }
            let start = if r > 0.0 { (stick / r).asin() } else { 0.0 };
            let slip = FRAC_2_PI
                * quadrature::composite(start, FRAC_PI_2, |t| (amplitude - room(r * t.sin())).max(0.0));
            let rate = 4.0 * per_length * self.pressure_at(r) * slip;
            if rate.is_finite() { rate } else { 0.0 }
        };
        self.at_deepest(rate)
    }
}
