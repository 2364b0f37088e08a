//! A line along which friction runs in, in parts over which μ changes little.
//!
//! **Under a load that changes** the bounds go evenly from the start of a part to its end: the
//! trapezoidal rule, of second order in the energy of a part. Springs stick there at the bound that
//! they have on the way, not at that of the end, so that a better mean would serve others only.
//!
//! **Under a constant load** a part is walked in two halves. The bounds go evenly to a middle value
//! and evenly on, and their mean is that of Simpson's rule: of fourth order.

use super::{ACCURACY, BALANCED, FrettingContact};
use crate::engine::line::Point;
use crate::error::Error;
use nalgebra::Vector2;

/// With x = ΔW/W_r and l, by how much the two halves of a part differ over the whole, the relative
/// error of the work is at most the change of μ times (x/2 + l)³ over this. Where both are equal it
/// is x³/2880 by Simpson's rule.
const SIMPSON: f64 = 30.0;

/// Energies of even parts that a line dissipates from which on halves take less time. At twice that
/// a slide of 40 steps takes 900 walks instead of at most 450; at half of it partial slip of an
/// ellipse in the plane a quarter longer than without halves.
const MANY: f64 = 10.0;

/// Least part of a line: within less of it μ may change as it likes. That bounds the parts where
/// W_r is far less than the work of a line, and where a falling μ lets springs snap.
const LEAST_PART: f64 = 1e-3;

/// Share of the allowed error of a part for which its length is chosen.
const AIM: f64 = 0.8;

/// Most passes in which the middle of a part is found; one or two are usual.
const MOST_PASSES: u32 = 4;

/// The rate of work along a line, which changes evenly.
#[derive(Debug, Clone, Copy)]
struct WorkRate {
    /// Work per share of the line where a part begins, J.
    start: f64,
    /// Its change per share of the line, J.
    rise: f64,
}

impl WorkRate {
    /// That of a part, from the work in its halves, J.
    fn of_halves([first, last]: [f64; 2], part: f64) -> Self {
        Self { start: (3.0 * first - last) / part, rise: 4.0 * (last - first) / (part * part) }
    }

    /// That of the part after one.
    fn after(&self, part: f64) -> Self {
        Self { start: self.start + part * self.rise, ..*self }
    }

    /// Work of a part, J.
    fn work(&self, part: f64) -> f64 {
        (part * (self.start + 0.5 * part * self.rise)).max(0.0)
    }
}

/// The end of a part.
struct Walked {
    contact: FrettingContact,
    /// Work in its halves, J; equal ones where it was not divided.
    halves: [f64; 2],
}

impl FrettingContact {
    /// Walks a line in parts in each of which the coefficient changes little.
    pub(super) fn run_in_parts(&mut self, normal: f64, target: Vector2<f64>) -> Result<(), Error> {
        let scale = if self.model.constants.force_control { self.force_scale() } else { 1.0 };
        let start = (self.state.contact.control * scale, self.drive_place());
        // the last part ends at the target to the bit
        let point = |share: f64| {
            let at = |from: f64, to: f64| if share < 1.0 { from + share * (to - from) } else { to };
            (at(start.0, normal), start.1.zip_map(&target, at))
        };
        let mut rest = self.without_wear();
        rest.advance_at_constant_friction(normal, target)?;
        let work = rest.state.work - self.state.work;
        let even = self.energy_of_part(ACCURACY);
        let value = self.checked(normal, target.x)?;
        let in_halves = value == self.state.contact.control && work > MANY * even;
        // from rest the work rises at most with the third power of the path
        let mut part = (even / work).cbrt().min(1.0);
        let mut rate = WorkRate { start: 0.0, rise: 2.0 * work * part };
        let mut done = 0.0;
        while done < 1.0 {
            let of_update = AIM * part * self.work_per_update() / rate.work(part);
            part = part.min(of_update).max(LEAST_PART).min(1.0 - done);
            let ahead = if in_halves { 0.5 * rate.work(part) } else { 0.0 };
            self.absorb_before(ahead, (value, target))?;
            let next = (done + part).min(1.0);
            let (middle, end) = (point(0.5 * (done + next)), point(next));
            let accuracy = if next < 1.0 { ACCURACY } else { BALANCED };
            // where springs snap, the first solution from the coefficient of the start on
            let expected =
                if part > LEAST_PART { [0.5, 1.0].map(|half| rate.work(half * part)) } else { [0.0; 2] };
            let walked = if in_halves {
                self.walk_in_halves((middle, end), expected, accuracy)?
            } else {
                self.walk_evenly(end, (expected[1], part == 1.0), accuracy)?
            };
            // next to a reversal the rate of work may have a kink that the halves do not show
            let (error, order) = self.error_of_part(&walked, in_halves && done > 0.0);
            rate = WorkRate::of_halves(walked.halves, part);
            if error <= ACCURACY || part <= LEAST_PART {
                (*self, done) = (walked.contact, next);
                rate = rate.after(part);
            }
            part *= (AIM / (error / ACCURACY).powf(1.0 / order)).clamp(0.1, 4.0);
        }
        Ok(())
    }

    /// Relative error of the work of a part that begins here, and its order in the length.
    fn error_of_part(&self, walked: &Walked, in_halves: bool) -> (f64, f64) {
        let [first, last] = walked.halves;
        let gained = first + last;
        let x = gained / self.model.parameters.running_in_energy;
        let change = (walked.contact.model.bound_slope / self.model.bound_slope - 1.0).abs();
        if in_halves && gained > 0.0 {
            let uneven = (last - first).abs() / gained;
            (change * (0.5 * x + uneven).powi(3) / SIMPSON, 4.0)
        } else {
            (change * x / 12.0, 2.0)
        }
    }

    /// Walks a part along which the bounds change evenly. `work` is that of the part, J, and
    /// whether it is known for the coefficient of the start.
    fn walk_evenly(&self, end: Point, work: (f64, bool), accuracy: f64) -> Result<Walked, Error> {
        let advance = |this: &mut Self| this.advance_at_constant_friction(end.0, end.1);
        let contact = self.run_in_part(work, accuracy, advance)?;
        let half = 0.5 * (contact.state.work - self.state.work);
        Ok(Walked { contact, halves: [half, half] })
    }

    /// Walks a part in two halves. `work` is that expected up to the middle and the end, J. With
    /// the share s of the change of μ in the first half, the bound in the middle is that at (8s −
    /// 1)/6 of the change: the mean in each half is then that of the parabola through the three
    /// values of μ.
    fn walk_in_halves(
        &self,
        (middle, end): (Point, Point),
        mut work: [f64; 2],
        accuracy: f64,
    ) -> Result<Walked, Error> {
        let before = self.state.work;
        let after = |work: f64| self.model.parameters.friction_coefficient_after(before + work);
        let share_of = |work: [f64; 2]| {
            let share = (after(work[0]) - after(0.0)) / (after(work[1]) - after(0.0));
            if share.is_finite() { share } else { 0.5 }
        };
        let mut passes = 0;
        loop {
            passes += 1;
            let (share, mut half) = (share_of(work), 0.0);
            let contact = self.run_in_part((work[1], false), accuracy, |this| {
                let ends = this.running_in_of_line();
                this.run_in_along(ends, ((8.0 * share - 1.0) / 6.0).clamp(0.0, 1.0));
                this.advance_at_constant_friction(middle.0, middle.1)?;
                this.keep_bound_slope_after(ends);
                half = this.state.work - before;
                this.run_in_along(ends, 1.0);
                this.advance_at_constant_friction(end.0, end.1)
            })?;
            work = [half, contact.state.work - before];
            let missed = (share_of(work) - share).abs() * (after(work[1]) / after(0.0) - 1.0).abs();
            if missed <= ACCURACY || passes == MOST_PASSES {
                return Ok(Walked { contact, halves: [work[0], work[1] - work[0]] });
            }
        }
    }

    /// Wears the backlog off before a part of a line that goes on to a value of the control and a
    /// place, where the profile has to follow before or after so much work (J), or where the
    /// backlog spans too much of the running in: it is worn at one coefficient.
    fn absorb_before(&mut self, work: f64, (value, place): Point) -> Result<(), Error> {
        let Some(wear) = &self.state.wear else { return Ok(()) };
        let before = self.model.parameters.friction_coefficient_after(self.state.work - wear.backlog.work);
        let drift = (self.model.constants.friction_coefficient / before - 1.0).abs();
        if drift > self.model.tuning.drift || self.update_is_due(place, work) {
            self.update_before(value)?;
            self.follow_running_in();
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::Parameters;

    /// In gross slip at constant load dW = μF dU − 2eμ dμ with the energy eμ² of the springs.
    #[test]
    fn the_work_of_gross_slip_is_of_fourth_order_in_the_length_of_parts() {
        let (first, last, energy, force) = (0.2, 0.8, 5e-3, 100.0);
        let parameters = Parameters {
            friction_coefficient: first,
            friction_coefficient_final: last,
            running_in_energy: energy,
            wear_coefficient: 0.0,
            ..Parameters::default()
        };
        let mut slides = FrettingContact::new(parameters).unwrap();
        slides.start_at(force, 0.0).unwrap();
        slides.advance_to(force, 2e-5).unwrap();
        let stored = slides.stored_energy() / slides.friction_coefficient_now().powi(2);
        let way = |contact: &FrettingContact| {
            let grown = (contact.dissipated_energy() / energy).exp();
            let slid = energy / last * ((last * grown - (last - first)) / first).ln();
            (slid + 2.0 * stored * contact.friction_coefficient_now()) / force
        };
        let length = 1.2e-4;
        let errors = [2u32, 4, 8].map(|parts| {
            let mut contact = slides.clone();
            for k in 0..parts {
                let at = |k: f64| Vector2::new(2e-5 + length * k / f64::from(parts), 0.0);
                let (middle, end) = (at(f64::from(k) + 0.5), at(f64::from(k) + 1.0));
                let work = contact.friction_coefficient_now() * force * length / f64::from(parts);
                let points = ((force, middle), (force, end));
                contact = contact.walk_in_halves(points, [0.5 * work, work], BALANCED).unwrap().contact;
            }
            (way(&contact) - way(&slides)) / length - 1.0
        });
        println!("{errors:?}, mu {}", slides.friction_coefficient_now());
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).abs().log2();
            assert!((3.7..4.5).contains(&order), "order {order}: {errors:?}");
        }
        assert!(errors[2].abs() < 1e-6, "{errors:?}");
    }
}
