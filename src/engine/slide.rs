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
        let direction = (displacement - self.displacement).signum();
        let most_work = match &self.wear {
            None => f64::MAX,
            Some(_)
                if direction != self.direction || self.onset_of_long_slide(value, displacement).is_some() =>
            {
                return false;
            }
            Some(_) => self.calm_work(),
        };
        if most_work <= 0.0 {
            return false;
        }
        let work_scale = (2.0 * self.constants.tangential_modulus, most_work);
        let work =
            self.springs.slide(&self.surface, &self.contact, self.bound_slope, displacement, work_scale);
        let Some(work) = work else { return false };
        if let Some(wear) = &mut self.wear {
            wear.segment.work += work;
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
