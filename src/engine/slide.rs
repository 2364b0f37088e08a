//! Steps under a steady load without wear.

use super::FrettingContact;

impl FrettingContact {
    /// Moves the body under an unchanged load if that takes no more than slip of its outer springs; `false`, with
    /// nothing changed, if it takes a walk.
    #[inline]
    pub(super) fn slides_to(&mut self, value: f64, displacement: f64) -> bool {
        if value != self.contact.control || self.contact.is_open() || self.wear.is_some() {
            return false;
        }
        let work_scale = 2.0 * self.constants.tangential_modulus;
        let work =
            self.springs.slide(&self.surface, &self.contact, self.bound_slope, displacement, work_scale);
        let Some(work) = work else { return false };
        self.direction = (displacement - self.displacement).signum();
        self.displacement = displacement;
        self.work += work;
        self.counters.spring_walks += 1;
        self.counters.steps += 1;
        true
    }
}
