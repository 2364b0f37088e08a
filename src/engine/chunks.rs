//! Steady motion on a profile that histories of another kind have left rough.
//!
//! The moving mesh of [`crate::wear::live`] needs fields that are smooth at the contact edge. Where they are not, the motion
//! is worn off like any other history: implicitly, as much at a time as may wear before the profile follows. That smooths the
//! profile, so that the mesh is tried again after every doubling.

use super::FrettingContact;
use super::history::STROKE;
use crate::error::Error;
use crate::wear::{Sliding, Steady, share_of_room};

/// Most implicit updates in place of one call for a steady motion.
const MOST_CHUNKS: u32 = 511;

/// Most chunks' worth of a motion that is begun at all, in the hope that the mesh can follow a smoother profile.
const FARTHEST: f64 = 1e6;

impl FrettingContact {
    /// Wears the surface by an amount (cycles or metres) of sliding at constant load, whatever the surface, and adds
    /// the work to the history's. Afterwards the contact is that of the new surface; the springs are still
    /// those of before.
    ///
    /// # Errors
    /// [`Error::TooMuchWear`] where neither the mesh nor [`MOST_CHUNKS`] updates can follow; those of the normal contact.
    pub(super) fn wear_steadily(&mut self, value: f64, sliding: Sliding, amount: f64) -> Result<(), Error> {
        let (mut left, mut chunks, mut next_trial) = (amount, 0, 1);
        loop {
            let refused = match self.wear_by(value, (sliding, None), left, None) {
                Ok(work) => {
                    self.work += work;
                    self.contact = self.contact_at(value)?;
                    return Ok(());
                }
                Err(refused @ (Error::TooMuchWear { .. } | Error::NotFinite { .. })) => refused,
                Err(other) => return Err(other),
            };
            while chunks < next_trial && left > 0.0 {
                // held in depth, a body may wear until it is free
                if self.contact.is_open() {
                    return Ok(());
                }
                let chunk = self.chunk(sliding, left);
                let hopeless = !(left <= FARTHEST * chunk.amount && chunk.work.is_finite());
                if hopeless || chunks == MOST_CHUNKS {
                    return Err(refused);
                }
                self.spread(chunk);
                if !self.transform_defect().is_finite() {
                    return Err(refused);
                }
                self.work += chunk.work;
                match self.update_surface() {
                    Err(Error::WearOutrun { .. }) => return Err(refused),
                    other => other?,
                };
                self.contact = self.contact_at(value)?;
                left -= chunk.amount;
                chunks += 1;
            }
            if left <= 0.0 {
                return Ok(());
            }
            next_trial = 2 * next_trial + 1;
        }
    }

    /// As much of a steady motion as one update may take off.
    fn chunk(&mut self, sliding: Sliding, left: f64) -> Steady {
        let contact = self.contact;
        let (unit_work, stick) = match sliding {
            Sliding::Onward => (self.constants.friction_coefficient * self.normal_reaction(), 0.0),
            Sliding::Cycles(amplitude) => {
                let (springs, quarter_work) = self.quarter(&contact, amplitude);
                let stick = springs.stick_radius(&contact, self.constants.bound_slope(), amplitude);
                (4.0 * quarter_work, stick)
            }
        };
        let volume = self.constants.wear_per_work * unit_work * left;
        let tolerance = self.parameters.tolerance;
        let ratio = share_of_room(volume, (STROKE * tolerance, tolerance), &self.surface, &contact, stick);
        // what is no number has to stop the loop
        let amount = if ratio <= 1.0 { left } else { left / ratio };
        Steady { sliding, amount, work: unit_work * amount, repeated: true }
    }
}
