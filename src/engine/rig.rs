//! A spring in series with the contact: what holds the body, and what a measured displacement
//! contains of it.
//!
//! The drive stands at D, the body at U, and both carry the same force,
//!
//! k_rig (D − U) = T(U).
//!
//! **At constant load** T is a concave function of the way that the body has gone since its last
//! reversal, since springs that slip go on slipping (Popov & Heß, chapter 5), and |T| ≤ μF_N. So
//! Newton's method, and the place U = D ∓ μF_N/k_rig of gross slip, both end short of the solution
//! or in it. The body is simply walked to them in turn: no motion is tried in vain, and wear sees a
//! single stroke. Stick and gross slip take one walk, partial slip a few.
//!
//! **Where the load changes** T at the end depends on how body and load went there. The line of
//! load and drive is walked in pieces like any other, the body goes straight in each, and its end
//! is found by regula falsi over trial walks: D − U − T/k_rig falls with U. Where springs touch or
//! leave during that, a piece has an error of second order in its change of load.
//!
//! Nothing is kept: D follows from U and T. What an update of the worn profile changes in T is made
//! up for with the motion that follows, so that it is never a reversal of its own.

mod cycles;

use super::FrettingContact;
use super::history::MOST_PIECES;
use super::line::Line;
use crate::error::Error;
use crate::roots;

/// Ratio of two loads between which the way of the body is checked half way. With 2 the friction
/// work of punches that are lifted off is 9 % off. At every change of load an orbit behind a rig
/// takes 72 walks a step, more than the 50 that its test allows.
const MUCH: f64 = 1.5;

/// Most walks for one equilibrium. Newton's method takes 3 to 6; a bisection in its place would
/// take 52.
pub(super) const MOST_WALKS: u32 = 100;

/// How far from equilibrium counts as none, relative to the lengths that are compared.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Behind a rig.
impl FrettingContact {
    /// Displacement of the drive: U + T/k_rig, m. It is [`Self::displacement`] where the rig is
    /// rigid.
    #[inline]
    pub fn drive_displacement(&self) -> f64 {
        if self.model.compliance == 0.0 {
            return self.state.place.x;
        }
        self.state.place.x + self.model.compliance * self.tangential_force()
    }

    /// [`Self::advance_to`] with the displacement of a drive.
    pub(super) fn advance_drive(&mut self, value: f64, drive: f64) -> Result<(), Error> {
        if !(value == self.state.contact.control && self.slides_after(drive)) {
            if value != self.state.contact.control {
                // refused with the caller's number, not with that of a piece
                self.solve_contact(value)?;
            }
            self.transaction(|this| this.walk_with_drive(value, drive))?;
        }
        self.state.counters.steps += 1;
        Ok(())
    }

    /// Follows the drive under an unchanged load by slip of outer springs alone; `false`, with
    /// nothing changed, if it takes a walk.
    fn slides_after(&mut self, drive: f64) -> bool {
        if self.state.contact.is_open() {
            return false;
        }
        let value = self.state.contact.control;
        let side = self.pull(drive).signum();
        let followed = self.transaction(|this| {
            for _ in 0..MOST_WALKS {
                match this.next_place(drive, side) {
                    None => return Ok(()),
                    Some(target) if this.slides_to(value, target) => {}
                    Some(_) => break,
                }
            }
            Err(())
        });
        followed.is_ok()
    }

    fn walk_with_drive(&mut self, value: f64, drive: f64) -> Result<(), Error> {
        let start = self.drive_displacement();
        let still = (drive - start).abs() <= ROUNDING * (drive.abs() + start.abs());
        let from = self.place_at(if still { drive } else { start });
        let line = Line::new((self.state.contact.control, from), (value, self.place_at(drive)));
        self.walk_line(&line)
    }

    /// Follows one piece of the drive's line.
    pub(super) fn follow_drive_on_line(&mut self, value: f64, drive: f64) -> Result<(), Error> {
        let mut side = self.pull(drive).signum();
        if value != self.state.contact.control || self.state.contact.is_open() {
            let displacement = self.equilibrium(value, drive)?;
            let updates = self.state.counters.profile_updates;
            self.walk_evenly((value, drive), displacement, MOST_PIECES.ilog2())?;
            if self.state.counters.profile_updates == updates {
                return Ok(());
            }
            side = self.state.direction.x;
        }
        for _ in 0..MOST_WALKS {
            let Some(target) = self.next_place(drive, side) else { return Ok(()) };
            // with the wear of an update the body goes on, maybe beyond that place
            let target = self.place_at(target);
            if self.update_is_due(target) {
                self.bounded(|this| this.update_before(value))?;
            } else {
                self.walk(value, target, 1)?;
            }
        }
        Ok(())
    }

    /// Walks to another load and place of the drive, at which the body is found at a displacement.
    /// Where the load changes by much the line is halved until the body, halfway, is near the
    /// middle.
    fn walk_evenly(&mut self, to: (f64, f64), displacement: f64, halvings: u32) -> Result<(), Error> {
        let (value, drive) = to;
        let halfway = 0.5 * (self.state.contact.control + value);
        if halvings > 0 && halfway > self.touch_control() && self.load_changes_much(value) {
            let half = 0.5 * (self.drive_displacement() + drive);
            let between = self.equilibrium(halfway, half)?;
            let bent = (between - 0.5 * (self.state.place.x + displacement)).abs();
            let near = self.straight_within(value)?;
            if bent > near {
                // each half bends by a quarter of it, unless springs begin to slip there
                let halvings = if bent > 4.0 * near { halvings - 1 } else { 0 };
                self.walk_evenly((halfway, half), between, halvings)?;
                let displacement = self.equilibrium(value, drive)?;
                return self.walk_evenly(to, displacement, halvings);
            }
        }
        self.walk(value, self.place_at(displacement), 1)
    }

    /// Whether a load (N, or a depth in m) differs much from the present one.
    pub(super) fn load_changes_much(&self, value: f64) -> bool {
        let [now, then] = [self.state.contact.control, value].map(|value| value - self.touch_control());
        MUCH * now.min(then) < now.max(then)
    }

    /// How far the body may be from the middle of a straight way to a load (N, or a depth in m), m.
    pub(super) fn straight_within(&self, value: f64) -> Result<f64, Error> {
        let depth = self.state.contact.depth.abs();
        let deeper = if self.load_changes_much(value) { self.solve_contact(value)?.depth.abs() } else { 0.0 };
        Ok(self.model.tuning.bent * self.model.bound_slope * depth.max(deeper))
    }

    /// How far the drive is ahead of equilibrium, D − U − T/k_rig, m; 0 where that is rounding.
    fn pull(&self, drive: f64) -> f64 {
        let limit = self.friction_limit();
        self.pull_on((drive, self.state.place.x), self.tangential_force(), limit)
    }

    fn pull_on(&self, (drive, displacement): (f64, f64), force: f64, limit: f64) -> f64 {
        let pull = drive - displacement - self.model.compliance * force;
        let scale = drive.abs() + displacement.abs() + self.model.compliance * limit;
        if pull.abs() <= ROUNDING * scale { 0.0 } else { pull }
    }

    /// A place nearer to equilibrium on one side of where the body stands, and not beyond it;
    /// `None` in equilibrium.
    fn next_place(&self, drive: f64, side: f64) -> Option<f64> {
        let pull = side * self.pull(drive);
        let moves = pull > 0.0 && pull.is_finite();
        if !moves {
            return None;
        }
        let row_modulus = 2.0 * self.model.constants.tangential_modulus;
        let newton = pull / (1.0 + self.model.compliance * row_modulus * self.sticking(side));
        let limit = self.friction_limit();
        let gross_slip = side * (drive - self.state.place.x) - self.model.compliance * limit;
        let target = self.state.place.x + side * newton.max(gross_slip);
        (target != self.state.place.x).then_some(target)
    }

    /// Displacement of the body that balances the drive after a straight line to another load.
    fn equilibrium(&mut self, value: f64, drive: f64) -> Result<f64, Error> {
        let to = self.solve_contact(value)?;
        self.state.counters.contact_solutions += 1;
        if to.is_open() {
            return Ok(drive);
        }
        let row_modulus = 2.0 * self.model.constants.tangential_modulus;
        let limit = self.model.constants.friction_coefficient * to.load * self.force_scale();
        let mut walks = 0;
        let mut spare = std::mem::take(&mut self.memory.get().row);
        let mut pull = |displacement: f64| {
            let path = self.path_to(to, self.place_at(displacement));
            let (row, _) = self.state.row.walk(&path, std::mem::take(&mut spare), None);
            walks += 1;
            let force = row_modulus * row.deflection_integral(path.end).x;
            spare = row;
            self.pull_on((drive, displacement), force, limit)
        };
        let here = self.state.place.x;
        let first = pull(here);
        // all springs stick there at most, and none there
        let stiffest = row_modulus * to.radius.max(self.state.contact.radius);
        let ends = (here + first / (1.0 + self.model.compliance * stiffest), here + first);
        let displacement = if first == 0.0 { here } else { roots::of_falling(ends, pull) };
        self.state.counters.spring_walks += walks;
        self.memory.get().row = spare;
        Ok(displacement)
    }

    /// Amplitude of the drive (m) in steady cycles of the contact itself at the present load: U₀ +
    /// T₀/k_rig.
    pub(super) fn drive_amplitude(&mut self, own: f64) -> f64 {
        if self.model.compliance == 0.0 {
            return own;
        }
        let contact = self.state.contact;
        let (springs, _) = self.quarter(&contact, own);
        own + self.model.compliance
            * 2.0
            * self.model.constants.tangential_modulus
            * springs.deflection_integral(own)
    }

    /// Amplitude of the contact itself in steady cycles of a drive (m) at the present load: the
    /// same law from rest.
    pub(super) fn own_amplitude(&mut self, drive: f64) -> f64 {
        if self.model.compliance == 0.0 || self.state.contact.is_open() {
            return drive;
        }
        let contact = self.state.contact;
        let row_modulus = 2.0 * self.model.constants.tangential_modulus;
        let limit = self.friction_limit();
        roots::from_below((drive - self.model.compliance * limit).max(0.0), |amplitude| {
            let (mut force, mut stick) = (0.0, contact.radius);
            if amplitude > 0.0 {
                let (springs, _) = self.quarter(&contact, amplitude);
                force = row_modulus * springs.deflection_integral(amplitude);
                stick = springs.stick_radius(&contact, self.model.bound_slope, amplitude);
            }
            let pull = self.pull_on((drive, amplitude), force, limit);
            pull / (1.0 + self.model.compliance * row_modulus * stick)
        })
    }
}
