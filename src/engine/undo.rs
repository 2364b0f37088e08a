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
        let next = Segment { unslipped: take(&mut wear.spare_row), ..Segment::default() };
        let segment = replace(&mut wear.segment, next);
        self.start_segment();
        let result = walk_on(self);
        if let Some(wear) = &mut self.wear {
            if result.is_err() {
                wear.pending.steady = Some(before);
                wear.pending.unplaced = unplaced;
                wear.spare_row = replace(&mut wear.segment, segment).unslipped;
                self.counters = counters;
            } else {
                wear.spare_row = segment.unslipped;
            }
        }
        Some(result)
    }
}
