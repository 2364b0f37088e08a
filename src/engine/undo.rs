//! Changes that leave nothing behind where they fail, without a copy of everything wherever that can be had.

use super::FrettingContact;
use crate::error::Error;
use crate::wear::{PLACED_WITH, Segment, Sliding, Steady};
use std::mem::{replace, swap, take};

impl FrettingContact {
    /// Runs a change; where it fails, the state is as before.
    pub(super) fn transaction(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        if self.wear.is_some() {
            let before = self.clone();
            return change(self).inspect_err(|_| *self = before);
        }
        // without wear the surface never changes: the row and a few numbers are all
        let mut row = take(&mut self.undo);
        row.copy_from(&self.springs);
        let Self { contact, displacement, direction, work, reach, counters, .. } = *self;
        let result = change(self);
        if result.is_err() {
            swap(&mut self.springs, &mut row);
            (self.contact, self.displacement, self.direction) = (contact, displacement, direction);
            (self.work, self.reach, self.counters) = (work, reach, counters);
        }
        self.undo = row;
        result
    }

    /// Walks on after a reversal at which half a steady cycle is only to be counted, which takes no copy of the surface;
    /// `None`, with nothing changed, where the reversal asks for more.
    pub(super) fn turn_in_rhythm(
        &mut self,
        steady: Steady,
        limit: f64,
        walk_on: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Option<Result<(), Error>> {
        let per_work = self.constants.wear_per_work;
        let counters = self.counters;
        let wear = self.wear.as_mut()?;
        let before = wear.pending.steady?;
        let alike =
            matches!((before.sliding, steady.sliding), (Sliding::Cycles(a), Sliding::Cycles(b)) if a == b);
        let unplaced = wear.pending.unplaced;
        let work = before.work + (steady.work + unplaced);
        let few = unplaced.abs() <= PLACED_WITH * steady.work;
        if !alike || !few || wear.pending.work > 0.0 || per_work * (work + steady.work) > limit {
            return None;
        }
        let amount = before.amount + steady.amount;
        wear.pending.steady = Some(Steady { amount, work, repeated: true, ..before });
        wear.pending.unplaced = 0.0;
        Some(self.in_new_segment(walk_on, |this| {
            this.counters = counters;
            if let Some(wear) = &mut this.wear {
                wear.pending.steady = Some(before);
                wear.pending.unplaced = unplaced;
            }
        }))
    }

    /// Walks on after a reversal at which nothing is pending and the stroke has worn nothing that the profile could show, without a
    /// copy; `None`, with nothing changed, where there is more to do.
    pub(super) fn turn_without_wear(
        &mut self,
        walk_on: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Option<Result<(), Error>> {
        let (wear, counters) = (self.wear.as_ref()?, self.counters);
        let (work, unplaced) = (wear.segment.work, wear.pending.unplaced);
        if !wear.pending.is_empty() || !self.is_beyond_the_profile(work) {
            return None;
        }
        self.wear.as_mut()?.pending.unplaced += work;
        Some(self.in_new_segment(walk_on, |this| {
            this.counters = counters;
            if let Some(wear) = &mut this.wear {
                wear.pending.unplaced = unplaced;
            }
        }))
    }

    /// Walks on in a new segment; where that fails, goes back to the old one and undoes what else has been done.
    fn in_new_segment(
        &mut self,
        walk_on: impl FnOnce(&mut Self) -> Result<(), Error>,
        undo: impl FnOnce(&mut Self),
    ) -> Result<(), Error> {
        let Some(wear) = &mut self.wear else { return walk_on(self) };
        let next = Segment { unslipped: take(&mut wear.spare_row), ..Segment::default() };
        let segment = replace(&mut wear.segment, next);
        self.start_segment();
        let result = walk_on(self);
        let Some(wear) = &mut self.wear else { return result };
        if result.is_err() {
            wear.spare_row = replace(&mut wear.segment, segment).unslipped;
            undo(self);
        } else {
            wear.spare_row = segment.unslipped;
        }
        result
    }
}
