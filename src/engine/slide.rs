//! Steps under a steady load without wear, or with it within a half cycle that wears too little for the profile to follow.

use super::FrettingContact;

impl FrettingContact {
    /// Moves the body under an unchanged load if that takes no more than slip of its outer springs; `false`, with
    /// nothing changed, if it takes a walk.
    #[inline]
    pub(super) fn slides_to(&mut self, value: f64, displacement: f64) -> bool {
        if value != self.contact.control || self.contact.is_open() {
            return false;
        }
        let direction = self.direction_to(displacement);
        let mut slips = None;
        if self.wear.is_some() {
            if direction != self.direction || self.onset_of_long_slide(value, displacement).is_some() {
                return false;
            }
            slips = self.wear.as_mut().map(|wear| std::mem::take(&mut wear.slips));
        }
        if let Some(slips) = &mut slips {
            slips.clear();
        }
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
        if let (Some(wear), Some(slips)) = (&mut self.wear, slips) {
            wear.slips = slips;
        }
        let Some(work) = work else { return false };
        if self.wear.is_some() {
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
