//! Motion that repeats at constant load, worn by its law of time.

use super::FrettingContact;
use super::history::MOST_PIECES;
use crate::error::Error;
use crate::friction::Row;
use crate::surface::{FrontMotion, ROUNDING};
use crate::wear::{self, Part, RepeatedMotion, Sliding, SlipAtDepth};
use nalgebra::Vector2;

/// Part of the way of full slip after which a slide is all slip. At 1 the motion so far has a front
/// next to the axis, and its mesh and that of the slide take turns: strokes of 3 u_max on r⁴ left a
/// profile 16 % of its depth off. 1.01 and 1.5 serve as well.
const BEYOND_ONSET: f64 = 1.1;

/// How the updates of a motion have gone so far.
struct Pace {
    /// The most that one cycle or metre has worked, J.
    work: f64,
    /// The most that one update could have worn, m³.
    limit: f64,
}

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
    pub(super) fn wear_steadily(
        &mut self,
        value: f64,
        (sliding, part): (Sliding, Part),
        amount: f64,
    ) -> Result<(), Error> {
        let (mut left, mut updates, mut next_trial) = (amount, 0, 1);
        let mut pace = Pace { work: 0.0, limit: 0.0 };
        let amplitude = sliding.amplitude();
        let refused = |left, steps| Error::TooMuchWear { cycles: amount, left, amplitude, steps };
        loop {
            if let Some(work) = self.wear_by(value, RepeatedMotion::of(sliding, left), None, part)? {
                self.correct_work(work);
                self.state.contact = self.contact_at(value)?;
                return Ok(());
            }
            while updates < next_trial && left > 0.0 {
                if updates == MOST_PIECES {
                    return Err(refused(left, updates));
                }
                match self.transaction(|this| this.wear_part(sliding, left, &mut pace)) {
                    Ok(part) if part > 0.0 => {
                        left -= part;
                        self.state.contact = self.contact_at(value)?;
                    }
                    Ok(_) | Err(Error::WearOutrun { .. }) => {
                        let work = self.unit_work(sliding).0 * left;
                        let is_little = self.defer_little(work, 1.0);
                        return if is_little { Ok(()) } else { Err(refused(left, updates + 1)) };
                    }
                    Err(other) => return Err(other),
                }
                updates += 1;
            }
            if left <= 0.0 {
                return Ok(());
            }
            next_trial = 2 * next_trial + 1;
        }
    }

    /// Wears as much of a steady motion off as one update may; returns how much that is (cycles or
    /// metres), 0 where the numbers allow none. A slip zone that wears free wears ever less: the
    /// largest limit so far falls with the root of the work of a cycle, so that all updates to the
    /// end are at most twice as many as at the limit itself.
    fn wear_part(&mut self, sliding: Sliding, left: f64, pace: &mut Pace) -> Result<f64, Error> {
        let contact = self.state.contact;
        let (unit_work, stick) = self.unit_work(sliding);
        // a slip zone that has worn free
        if unit_work <= ROUNDING * pace.work || self.defer_little(unit_work * left, ROUNDING) {
            return Ok(left);
        }
        let (tuning, tolerance) = (self.model.tuning, self.model.parameters.tolerance);
        let share = (tuning.stroke * tolerance).min(tuning.steady_share);
        pace.work = pace.work.max(unit_work);
        // a worn rim may stick outside of what slips
        let inner = if stick < contact.radius { stick } else { self.widest_stick(&contact, 0.0) };
        pace.limit = pace.limit.max(wear::update_limit(share, &self.surface, &contact, inner));
        let limit = pace.limit * (unit_work / pace.work).sqrt();
        let volume = self.model.constants.wear_per_work * unit_work * left;
        let part = if volume <= limit { left } else { left * (limit / volume) };
        let work = unit_work * part;
        // what is no number has to stop the loop
        if !work.is_finite() {
            return Ok(0.0);
        }
        let law = SlipAtDepth::of_motion(sliding, part, contact.depth, self.model.bound_slope);
        if !self.absorb_law((&[law], FrontMotion::Creeps), work, contact.radius)? {
            return Ok(left);
        }
        self.add_work(work);
        Ok(part)
    }

    /// Counts work (J) and defers its wear, where that is less than a share of what need not show
    /// on the profile: of a slip zone that is free except for a wall at its front, which no update
    /// follows.
    fn defer_little(&mut self, work: f64, share: f64) -> bool {
        let is_little = self.defer_if_little(work, share);
        if is_little {
            self.add_work(work);
        }
        is_little
    }

    /// Work (J) of a cycle or metre on the present profile, and the radius that sticks, m.
    pub(super) fn unit_work(&mut self, sliding: Sliding) -> (f64, f64) {
        let contact = self.state.contact;
        match sliding {
            Sliding::Onward => (self.friction_limit(), 0.0),
            Sliding::Cycles(amplitude) => {
                let (springs, quarter_work) = self.quarter(&contact, amplitude);
                let stick = springs.stick_radius(&contact, self.model.bound_slope, amplitude);
                (4.0 * quarter_work, stick)
            }
        }
    }

    /// Place on a line at constant load from which on all springs slip, where the line goes on so
    /// far beyond it that the wear matters.
    pub(super) fn onset_of_long_slide(&self, value: f64, place: Vector2<f64>) -> Option<Vector2<f64>> {
        self.state.wear.as_ref()?;
        let stays = value == self.state.contact.control && !self.state.contact.is_open();
        if !(stays && self.is_on_line(place)) {
            return None;
        }
        let move_on = place.x - self.state.place.x;
        let slack = 2.0 * BEYOND_ONSET * self.full_slip();
        // a body worn flat slips everywhere at once
        if slack <= 0.0 || move_on.abs() <= 2.0 * slack {
            return None;
        }
        let volume = self.model.constants.wear_per_work * self.friction_limit() * (move_on.abs() - slack);
        self.exceeds_limit(volume, &self.state.contact, 0.0)?;
        Some(self.place_at(self.state.place.x + slack * move_on.signum()))
    }

    /// Slides on at constant load, all springs slipping already, to a displacement.
    pub(super) fn slide_on(&mut self, displacement: f64) -> Result<(), Error> {
        self.absorb_backlog()?;
        let value = self.state.contact.control;
        let moved = displacement - self.state.place.x;
        self.wear_steadily(value, (Sliding::Onward, Part::Call), moved.abs())?;
        let to = self.state.contact;
        let (mut springs, _) = self.quarter(&to, 0.0);
        springs.follow_bound((0.0, moved.signum()), &to, self.model.constants.bound_slope(), displacement);
        self.arrive(to, self.place_at(displacement), Row::Line(springs), 0.0);
        Ok(())
    }
}
