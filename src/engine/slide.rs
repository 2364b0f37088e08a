//! Steps under a constant load in which more springs slip the same way, and after which no update
//! of the profile is due.

use super::FrettingContact;

impl FrettingContact {
    /// Moves the body under an unchanged load if that takes no more than slip of its outer springs;
    /// `false`, with nothing changed, if it takes a walk.
    #[inline]
    pub(super) fn slides_to(&mut self, value: f64, displacement: f64) -> bool {
        if value != self.state.contact.control
            || self.state.contact.is_open()
            || self.model.start_slope != self.model.bound_slope
        {
            return false;
        }
        let direction = self.direction_to(displacement);
        let (wears, turns) = (self.state.wear.is_some(), direction != self.state.direction);
        if wears && (turns || self.onset_of_long_slide(value, displacement).is_some()) {
            return false;
        }
        if turns {
            self.begin_stroke();
        }
        let mut slips = self.take_slips();
        let most_work = self.work_to_update();
        let work_scale = (2.0 * self.model.constants.tangential_modulus, most_work);
        let work = self.state.springs.slide(
            &self.surface,
            &self.state.contact,
            self.model.bound_slope,
            displacement,
            work_scale,
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
            self.gather(work, &to);
        }
        self.state.direction = direction;
        self.state.displacement = displacement;
        self.state.work += work;
        self.state.counters.spring_walks += 1;
        true
    }
}
