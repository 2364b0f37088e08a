//! Motion that repeats at constant load, worn by its law of time.

use super::FrettingContact;
use super::history::MOST_PIECES;
use crate::error::Error;
use crate::wear::{self, Sliding, SlipAtDepth};

impl FrettingContact {
    /// Wears the surface by an amount (cycles or metres) of sliding at constant load, whatever the
    /// surface, and adds the work to the history's. Afterwards the contact is that of the new
    /// surface; the springs are still those of before.
    ///
    /// The moving mesh of [`crate::wear::integrate`] needs fields that are smooth at the contact
    /// edge. Where they are not, the motion is worn off by implicit updates, as much at a time as
    /// may wear before the profile follows. That smooths the profile, so that the mesh is tried
    /// again after every doubling.
    ///
    /// # Errors
    /// [`Error::TooMuchWear`] where neither the mesh nor [`MOST_PIECES`] updates can follow; those
    /// of the normal contact.
    pub(super) fn wear_steadily(&mut self, value: f64, sliding: Sliding, amount: f64) -> Result<(), Error> {
        let (mut left, mut chunks, mut next_trial) = (amount, 0, 1);
        loop {
            let refused = match self.wear_by(value, (sliding, None), left, false) {
                Ok(work) => {
                    self.state.work += work;
                    self.state.contact = self.contact_at(value)?;
                    return Ok(());
                }
                Err(refused @ (Error::TooMuchWear { .. } | Error::NotFinite { .. })) => refused,
                Err(other) => return Err(other),
            };
            while chunks < next_trial && left > 0.0 {
                // held in depth, a body may wear until it is free
                if self.state.contact.is_open() {
                    return Ok(());
                }
                let (amount, work) = self.chunk(sliding, left);
                let moves = amount > 0.0 && work.is_finite();
                if chunks == MOST_PIECES || !moves {
                    return Err(refused);
                }
                let contact = self.state.contact;
                let law = SlipAtDepth::of_motion(sliding, amount, contact.depth, self.model.bound_slope);
                match self.absorb_law(&[law], work, contact.radius) {
                    Err(Error::WearOutrun { .. }) => return Err(refused),
                    other => other?,
                }
                self.add_work(work);
                self.state.contact = self.contact_at(value)?;
                left -= amount;
                chunks += 1;
            }
            if left <= 0.0 {
                return Ok(());
            }
            next_trial = 2 * next_trial + 1;
        }
    }

    /// As much of a steady motion as one update may take off (cycles or metres), and its work, J.
    fn chunk(&mut self, sliding: Sliding, left: f64) -> (f64, f64) {
        let contact = self.state.contact;
        let (unit_work, stick) = match sliding {
            Sliding::Onward => (self.model.constants.friction_coefficient * self.normal_reaction(), 0.0),
            Sliding::Cycles(amplitude) => {
                let (springs, quarter_work) = self.quarter(&contact, amplitude);
                let stick = springs.stick_radius(&contact, self.model.bound_slope, amplitude);
                (4.0 * quarter_work, stick)
            }
        };
        let volume = self.model.constants.wear_per_work * unit_work * left;
        let (tuning, tolerance) = (self.model.tuning, self.model.parameters.tolerance);
        let share = (tuning.stroke * tolerance).min(tuning.steady_share.max(tolerance));
        let ratio = volume / wear::update_limit(share, &self.surface, &contact, stick);
        // what is no number has to stop the loop
        let amount = if ratio <= 1.0 { left } else { left / ratio };
        (amount, unit_work * amount)
    }

    /// Puts the slipping springs where a steady cycle has them at its end, on a surface that has
    /// just worn. Those that stuck all the time keep what they remember: the cycle need not be
    /// about the place where they are relaxed.
    pub(super) fn rest_at_reversal(&mut self, amplitude: f64, stick_before: f64) {
        let contact = self.state.contact;
        let (mut springs, _) = self.quarter(&contact, amplitude);
        let front = springs.stick_radius(&self.state.contact, self.model.constants.bound_slope(), amplitude);
        springs.moved_by(self.state.direction, amplitude, self.state.displacement);
        self.state.springs.take_outer(front.min(stick_before), &springs);
    }

    /// Displacement at which all springs slip, on a line at constant load that goes on so far
    /// beyond it that the wear matters.
    pub(super) fn onset_of_long_slide(&self, value: f64, displacement: f64) -> Option<f64> {
        self.state.wear.as_ref()?;
        if value != self.state.contact.control || self.state.contact.is_open() {
            return None;
        }
        let move_on = displacement - self.state.displacement;
        let slack =
            2.0 * self.model.constants.bound_slope() * (self.state.contact.depth - self.surface.tip());
        // a body worn flat slips everywhere at once
        if slack <= 0.0 || move_on.abs() <= 2.0 * slack {
            return None;
        }
        let friction = self.model.constants.friction_coefficient * self.normal_reaction();
        let volume = self.model.constants.wear_per_work * friction * (move_on.abs() - slack);
        self.exceeds_limit(volume, &self.state.contact, 0.0)?;
        Some(self.state.displacement + slack * move_on.signum())
    }

    /// Slides on at constant load, all springs slipping already, to a displacement.
    pub(super) fn slide_on(&mut self, displacement: f64) -> Result<(), Error> {
        self.absorb_backlog()?;
        let value = self.state.contact.control;
        let moved = displacement - self.state.displacement;
        self.wear_steadily(value, Sliding::Onward, moved.abs())?;
        let to = self.state.contact;
        let (mut springs, _) = self.quarter(&to, 0.0);
        springs.follow_bound((0.0, moved.signum()), &to, self.model.constants.bound_slope(), displacement);
        self.arrive(to, displacement, springs, 0.0);
        Ok(())
    }
}
