//! What no step can exceed, however it was followed. A step in which a contact wears more than its
//! profile can follow breaks these, and is refused instead of giving a wrong number.

use super::FrettingContact;
use crate::error::Error;
use crate::parameters::USUAL_TOLERANCE;
use crate::surface::Contact;
use crate::wear::disc;
use std::f64::consts::PI;

/// On coarse meshes, this over the square of the resolution: a volume computed cell by cell is of
/// second order, and computed again where a mesh is left. At 64 cells it is the same.
const OF_CELLS: f64 = 4.0;

/// Share of that which a step may add where others have left too much: what wears next takes it up.
const NOT_AT_FAULT: f64 = 0.1;

/// Share of the worn volume and of π a² d by which friction may have taken more than it can, which
/// is lost in those of a step that went wrong.
const OVERTAKEN: f64 = 0.01;

/// Share of all that has worn, and of the largest contact so far, that need not show.
const NEGLIGIBLE: f64 = 1e-6;

/// Rounding and the error of an update, relative.
const SLACK: f64 = 0.05;

impl FrettingContact {
    /// Runs a change along a straight line. Friction can take what the drive brings, at most μF_N
    /// |ΔU|, and what the springs hold; and nearly all of it has to show on the profile.
    ///
    /// # Errors
    /// Those of the change; [`Error::WearOutrun`] if it breaks one of these.
    pub(super) fn bounded(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (work, start, updates) =
            (self.state.work, self.state.place.x, self.state.counters.profile_updates);
        let start_y = self.state.place.y;
        let stored = self.stored_energy();
        let gathered = self.state.wear.as_ref().map_or(0.0, |wear| wear.backlog.work);
        let (force, before, deferred) = (self.normal_reaction(), self.state.contact, self.deferred_volume());
        change(self)?;
        let updated = self.state.counters.profile_updates != updates;
        if self.state.wear.is_none() || !updated && self.deferred_volume() == deferred {
            return Ok(());
        }
        let force = force.max(self.normal_reaction());
        let moved = (self.state.place.x - start).hypot(self.state.place.y - start_y);
        let driven = self.model.constants.friction_coefficient * force * moved;
        let taken = self.state.work - work;
        let per_work = self.model.constants.wear_per_work;
        // what went wrong may have blown up the contact after
        let slack = OVERTAKEN
            * if before.is_open() { disc(&before).max(disc(&self.state.contact)) } else { disc(&before) };
        // an update corrects the work that it wears off
        let most = (1.0 + SLACK) * (driven + stored) + SLACK * gathered;
        let bounded = per_work * taken <= per_work * most + slack + self.negligible_volume();
        let placed = self.is_placed((&before, deferred));
        if bounded && placed {
            return Ok(());
        }
        Err(Error::WearOutrun { displacement: self.state.place.x, from: start })
    }

    /// Runs a change after which nearly all that has worn has to show on the profile.
    ///
    /// # Errors
    /// Those of the change; [`Error::WearOutrun`] where it does not.
    pub(super) fn placed(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let (start, before, deferred) = (self.state.place.x, self.state.contact, self.deferred_volume());
        change(self)?;
        if self.is_placed((&before, deferred)) {
            return Ok(());
        }
        Err(Error::WearOutrun { displacement: self.state.place.x, from: start })
    }

    /// Defers the wear of work (J) where that is less than a share of what need not show on the
    /// profile; says whether it is.
    pub(super) fn defer_if_little(&mut self, work: f64, share: f64) -> bool {
        let volume = self.model.constants.wear_per_work * (work / share);
        let is_little = self.deferred_volume() + volume <= self.most_deferred(&self.state.contact);
        if is_little {
            self.defer(work);
        }
        is_little
    }

    /// Volume whose wear is deferred to a later update, m³.
    fn deferred_volume(&self) -> f64 {
        let work = self.state.wear.as_ref().map_or(0.0, |wear| wear.deferred_work);
        (self.model.constants.wear_per_work * work).abs()
    }

    /// Whether nearly all that has worn shows on the profile, or what does not is hardly more than
    /// before a step; the contact of then counts, too.
    fn is_placed(&self, (contact, before): (&Contact, f64)) -> bool {
        let (now, limit) = (self.deferred_volume(), self.most_deferred(contact));
        now <= limit || now - before <= NOT_AT_FAULT * limit
    }

    /// The most that may be deferred, m³; a contact of before counts, too. What an update leaves
    /// does not fall with a tolerance tighter than the usual one.
    fn most_deferred(&self, contact: &Contact) -> f64 {
        let size = disc(contact).max(disc(&self.state.contact));
        let cells = self.model.parameters.resolution as f64;
        let share = self.model.parameters.tolerance.max(USUAL_TOLERANCE).max(OF_CELLS / (cells * cells));
        (share * (self.wear_volume() + size)).max(self.negligible_volume())
    }

    /// A volume that does not count against all that has worn, nor against π a² g(a) of the largest
    /// contact so far, m³. A load that is 0 but for rounding makes a contact that any slip wears
    /// off.
    fn negligible_volume(&self) -> f64 {
        let radius = self.state.reach;
        let largest_disc = PI * radius * radius * (self.surface.image(radius) - self.surface.tip());
        NEGLIGIBLE * self.wear_volume().max(largest_disc)
    }
}
