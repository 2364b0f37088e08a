//! Changes that leave nothing behind where they fail, without a copy of everything wherever that can be had.

use super::FrettingContact;
use crate::error::Error;
use std::mem::{swap, take};

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
        let strokes = self.stroke.mark();
        let Self { contact, displacement, direction, work, reach, counters, .. } = *self;
        let result = change(self);
        if result.is_err() {
            swap(&mut self.springs, &mut row);
            self.stroke.go_back(strokes);
            (self.contact, self.displacement, self.direction) = (contact, displacement, direction);
            (self.work, self.reach, self.counters) = (work, reach, counters);
        }
        self.undo = row;
        result
    }
}
