//! Motion that repeats at constant load, worn by its law of time.

use super::FrettingContact;
use crate::error::Error;
use crate::wear::{Sliding, SlipAtDepth};

impl FrettingContact {
    /// Wears the surface by an amount (cycles or metres) of sliding at constant load, whatever the surface, and adds the work to the
    /// history's: on the moving mesh of [`crate::wear::live`], which needs fields that are smooth at the contact edge, else on nodes at
    /// rest. Afterwards the contact is that of the new surface; the springs are still those of before.
    ///
    /// # Errors
    /// [`Error::TooMuchWear`] where neither can follow; those of the normal contact.
    pub(super) fn wear_steadily(&mut self, value: f64, sliding: Sliding, amount: f64) -> Result<(), Error> {
        match self.wear_by(value, (sliding, None), amount, None) {
            Ok(work) => self.work += work,
            Err(refused @ (Error::TooMuchWear { .. } | Error::NotFinite { .. })) => {
                if !self.wear_at_rest(sliding, amount)? {
                    return Err(refused);
                }
            }
            Err(other) => return Err(other),
        }
        self.contact = self.contact_at(value)?;
        self.balance_work();
        Ok(())
    }

    /// The same on nodes at rest; says whether it could be followed.
    fn wear_at_rest(&mut self, sliding: Sliding, amount: f64) -> Result<bool, Error> {
        let contact = self.contact;
        let unit_work = match sliding {
            Sliding::Onward => self.constants.friction_coefficient * self.normal_reaction(),
            Sliding::Cycles(amplitude) => 4.0 * self.quarter(&contact, amplitude).1,
        };
        let law = SlipAtDepth::of_motion(sliding, amount, contact.depth, self.bound_slope);
        let work = unit_work * amount;
        match self.absorb_law(&[law], work, contact.radius) {
            Ok(()) => {
                self.work += work;
                Ok(true)
            }
            Err(Error::WearOutrun { .. } | Error::NotFinite { .. }) => Ok(false),
            Err(other) => Err(other),
        }
    }

    /// Puts the slipping springs where a steady cycle has them at its end, on a surface that has just worn. Those that stuck
    /// all the time keep what they remember: the cycle need not be about the place where they are relaxed.
    pub(super) fn rest_at_reversal(&mut self, amplitude: f64, stick_before: f64) {
        let contact = self.contact;
        let (mut springs, _) = self.quarter(&contact, amplitude);
        let front = springs.stick_radius(&self.contact, self.constants.bound_slope(), amplitude);
        springs.moved_by(self.direction, amplitude, self.displacement);
        self.springs.take_outer(front.min(stick_before), &springs);
    }

    /// Displacement at which all springs slip, on a line at constant load that goes on so far beyond it that the wear
    /// matters.
    pub(super) fn onset_of_long_slide(&self, value: f64, displacement: f64) -> Option<f64> {
        self.wear.as_ref()?;
        if value != self.contact.control || self.contact.is_open() {
            return None;
        }
        let move_on = displacement - self.displacement;
        let slack = 2.0 * self.constants.bound_slope() * (self.contact.depth - self.surface.tip());
        // a body worn flat slips everywhere at once
        if slack <= 0.0 || move_on.abs() <= 2.0 * slack {
            return None;
        }
        let friction = self.constants.friction_coefficient * self.normal_reaction();
        let volume = self.constants.wear_per_work * friction * (move_on.abs() - slack);
        self.exceeds_limit(volume, &self.contact, 0.0)?;
        Some(self.displacement + slack * (1.0 + 1e-9) * move_on.signum())
    }

    /// Slides on at constant load, all springs slipping already, to a displacement.
    pub(super) fn slide_on(&mut self, displacement: f64) -> Result<(), Error> {
        self.absorb_backlog()?;
        let value = self.contact.control;
        let moved = displacement - self.displacement;
        self.wear_steadily(value, Sliding::Onward, moved.abs())?;
        let to = self.contact;
        let (mut springs, _) = self.quarter(&to, 0.0);
        springs.follow_bound((0.0, moved.signum()), &to, self.constants.bound_slope(), displacement);
        self.arrive(to, displacement, springs, 0.0);
        Ok(())
    }
}
