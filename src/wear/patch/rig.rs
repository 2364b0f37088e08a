//! The amplitude of the body itself in cycles of a drive at constant force, from the state.
//!
//! Body and drive carry the same force, D − U₀ = (2G*/k_rig) ∫ min(U₀, m q) dx, and the integral of
//! q outside the front follows from the load alone, without quadrature: ∫ q dx over all of the
//! contact is F_N/(2E*), and inside the image does not change.
//!
//! The front stands where m q = U₀. By the same balance U₀ grows by less than m times what the body
//! sinks, so that it never advances. At constant depth it does, into the body that has not worn.

use super::{Motion, Patch, Rate, Sliding};
use crate::roots::from_below;
use crate::surface::{Contact, Surface, outer_weight};

impl Motion {
    /// The same with the amplitude that a drive has on a surface.
    pub(crate) fn on(&self, surface: &Surface, contact: &Contact, bound_slope: f64) -> Self {
        let Some(rig) = self.rig.filter(|_| !contact.is_open()) else { return self.clone() };
        let gross_slip = rig.amplitude - rig.compliance * bound_slope * contact.load;
        let amplitude = from_below(gross_slip.max(0.0), |amplitude| {
            let level = contact.depth - amplitude / bound_slope;
            let stick = if level <= surface.image(0.0) {
                0.0
            } else {
                surface.radius_of_image(level, 0.0, contact.radius)
            };
            let place = surface.place(stick);
            let outside = contact.load - place.load - stick * (contact.depth - place.image);
            let residual =
                rig.amplitude - amplitude - rig.compliance * (amplitude * stick + bound_slope * outside);
            residual / (1.0 + rig.compliance * stick)
        });
        Self { sliding: Sliding::Cycles(amplitude), ..self.clone() }
    }
}

impl Patch {
    /// U₀ (m) and where the springs first slip (m): behind a rig they follow from the overlap d − g
    /// at the nodes, else from the motion.
    pub(super) fn amplitude(&self, indentation: f64, (x, overlap): (&[f64], &[f64])) -> (f64, f64) {
        let Some(rig) = self.motion.rig else { return (self.free_slip, self.inner_radius) };
        let inside = self.inner_radius * indentation - self.inside_image;
        let outside = self.bound_slope * (self.motion.value - inside);
        let mut stick = self.inner_radius;
        // as if all slipped from the inner edge on: too little, and Newton's method goes on from
        // there without passing the solution
        let least = (rig.amplitude - rig.compliance * outside) / (1.0 + rig.compliance * stick);
        let amplitude = from_below(least, |amplitude| {
            let (front, beyond) = self.sticking_on_mesh((x, overlap), amplitude);
            stick = front;
            let force = amplitude * self.inner_radius + outside - beyond;
            (rig.amplitude - amplitude - rig.compliance * force) / (1.0 + rig.compliance * stick)
        });
        (amplitude.max(0.0), stick)
    }

    /// Where the springs first slip on the mesh (m), and ∫ (m q − U₀) dx over what sticks on it,
    /// m².
    fn sticking_on_mesh(&self, (x, overlap): (&[f64], &[f64]), amplitude: f64) -> (f64, f64) {
        let over = |i: usize| self.bound_slope * overlap[i] - amplitude;
        let mut sum = 0.0;
        for j in 0..self.cells() {
            let (ends, hold) = ((x[j], x[j + 1]), (over(j), over(j + 1)));
            if hold.0 <= 0.0 {
                return (ends.0, sum);
            }
            if hold.1 < 0.0 {
                let share = hold.0 / (hold.0 - hold.1);
                let front = (ends.0 * ends.0 + share * (ends.1 - ends.0) * (ends.1 + ends.0)).sqrt();
                return (front, sum + (front - ends.0) * (1.0 - outer_weight(ends.0, front)) * hold.0);
            }
            let outer = outer_weight(ends.0, ends.1);
            sum += (ends.1 - ends.0) * ((1.0 - outer) * hold.0 + outer * hold.1);
        }
        (x[self.cells()], sum)
    }

    /// ∂(m d − U₀)/∂(m d) where springs slip: 1 without a rig.
    pub(super) fn sensitivity(&self, rate: &Rate) -> f64 {
        self.motion.rig.map_or(1.0, |rig| 1.0 / (1.0 + rig.compliance * rate.stick))
    }
}
