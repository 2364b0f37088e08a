//! Steps under a constant load in which more springs slip the same way, and after which no update
//! of the profile is due.

use super::FrettingContact;
use nalgebra::Vector2;

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
        let scales = (2.0 * self.model.constants.tangential_modulus, self.work_to_update());
        let work = if wears {
            self.slide_with_slips(displacement, scales)
        } else {
            let (springs, contact) = (&mut self.state.springs, &self.state.contact);
            springs.slide(&self.surface, contact, self.model.bound_slope, displacement, scales, |_| ())
        };
        let Some(work) = work else {
            if turns {
                self.undo_stroke();
            }
            return false;
        };
        if wears {
            let to = self.state.contact;
            self.gather(work, &to, Vector2::new(direction, 0.0));
        }
        self.state.direction = direction;
        self.state.displacement = displacement;
        self.add_work(work);
        self.state.counters.spring_walks += 1;
        true
    }

    /// [`Springs::slide`](crate::friction::Springs::slide) whose slip is kept, to be gathered.
    fn slide_with_slips(&mut self, displacement: f64, scales: (f64, f64)) -> Option<f64> {
        let (springs, contact) = (&mut self.state.springs, &self.state.contact);
        let slips = &mut self.memory.get().slips;
        slips.clear();
        let gather = |piece| slips.push(piece);
        springs.slide(&self.surface, contact, self.model.bound_slope, displacement, scales, gather)
    }
}
