//! Steps under a constant load in which more springs slip the same way, and after which no update
//! of the profile is due.

use super::FrettingContact;
use crate::friction::Row;

impl FrettingContact {
    /// Moves the body under an unchanged load if that takes no more than slip of its outer springs;
    /// `false`, with nothing changed, if it takes a walk.
    #[inline]
    pub(super) fn slides_to(&mut self, value: f64, displacement: f64) -> bool {
        if value != self.state.contact.control
            || self.state.contact.is_open()
            || self.state.row.is_plane()
            || self.model.start_slope != self.model.bound_slope
        {
            return false;
        }
        let place = self.place_at(displacement);
        let (wears, turns) = (self.state.wear.is_some(), self.turns(place));
        if wears
            && (turns && self.update_is_due(place, 0.0) || self.onset_of_long_slide(value, place).is_some())
        {
            return false;
        }
        if turns {
            self.begin_stroke();
        }
        let scales = (2.0 * self.model.constants.tangential_modulus, self.work_to_update());
        let mut slips = self.take_slips();
        let Row::Line(springs) = &mut self.state.row else { return false };
        let contact = &self.state.contact;
        let work = springs.slide(
            &self.surface,
            contact,
            self.model.bound_slope,
            displacement,
            scales,
            slips.as_mut(),
        );
        self.keep_slips(slips);
        let Some(work) = work else {
            if turns {
                self.undo_stroke();
            }
            return false;
        };
        if wears {
            let to = self.state.contact;
            self.gather(work, &to, place - self.state.place);
        }
        self.face(place);
        self.state.place = place;
        self.add_work(work);
        self.state.counters.spring_walks += 1;
        true
    }
}
