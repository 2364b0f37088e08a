//! Steps under a constant load in which more springs slip the same way, and after which no update
//! of the profile is due.

use super::FrettingContact;

impl FrettingContact {
    /// Moves the body under an unchanged load if that takes no more than slip of its outer springs; `false`, with
    /// nothing changed, if it takes a walk.
    #[inline]
    pub(super) fn slides_to(&mut self, value: f64, displacement: f64) -> bool {
        if value != self.contact.control || self.contact.is_open() || self.start_slope != self.bound_slope {
            return false;
        }
        let direction = self.direction_to(displacement);
        let wears = self.wear.is_some();
        if wears && (direction != self.direction || self.onset_of_long_slide(value, displacement).is_some()) {
            return false;
        }
        let strokes = self.stroke.mark();
        if direction != self.direction {
            self.begin_stroke();
        }
        let mut slips = self.take_slips();
        let most_work = self.work_to_update();
        let work_scale = (2.0 * self.constants.tangential_modulus, most_work);
        let work = self.springs.slide(
            &self.surface,
            &self.contact,
            self.bound_slope,
            displacement,
            work_scale,
            slips.as_mut(),
        );
        self.keep_slips(slips);
        let Some(work) = work else {
            self.stroke.go_back(strokes);
            return false;
        };
        if wears {
            let to = self.contact;
            self.gather(work, &to);
            // asked first, since taking moves the whole of it
            if self.view.get().is_some() {
                self.view.take();
            }
        }
        self.direction = direction;
        self.displacement = displacement;
        self.work += work;
        self.counters.spring_walks += 1;
        true
    }
}
