//! Coatings of the contacts of an interface: each wears through by itself.

use super::Interface;
use crate::engine::FrettingContact;

/// Coatings.
impl Interface {
    /// Whether the coating of a contact has worn through; never without a coating.
    ///
    /// Between two updates of the profiles the depth of [`Self::deepest_contact`] alone is read.
    /// [`FrettingContact::worn_through`] is that of one contact.
    pub fn worn_through(&self) -> bool {
        self.is_known_worn_through() || self.has_coating() && self.read_deepest(FrettingContact::worn_through)
    }

    /// Whether an update of a profile has found a coating worn through, at next to no cost.
    pub fn is_known_worn_through(&self) -> bool {
        self.has_coating() && self.members.touched().any(|(_, contact)| contact.is_known_worn_through())
    }

    /// Cycles of [`Self::advance_cycles`] since the start after which the first coating wore
    /// through, within the tolerance; `None` before, without a coating, and where one wore through
    /// in transient motion.
    pub fn cycles_to_wear_through(&self) -> Option<f64> {
        let worn = self.members.touched().filter(|(_, contact)| contact.is_known_worn_through());
        let lives = worn.map(|(_, contact)| contact.cycles_to_wear_through());
        lives.reduce(|first, next| Some(first?.min(next?))).flatten()
    }

    /// Cycles of [`Self::advance_cycles`] so far, counted where there is a coating.
    pub fn cycles_on_coating(&self) -> f64 {
        if self.has_coating() { self.pose.cycles } else { 0.0 }
    }

    fn has_coating(&self) -> bool {
        self.parameters.coating_thickness > 0.0
    }
}
