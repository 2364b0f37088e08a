//! Slip under a contact that does not change, where the outer springs all slip to one side: nearly
//! every step of nearly every run, and so done in place.

use super::Springs;
use super::walk::{Trial, append, between, rounding, share_at_bound, slip_work};
use crate::friction::SlipPiece;
use crate::surface::{Contact, Surface};

impl Springs {
    /// Moves the body to `displacement` under an unchanged contact. Returns the work of friction,
    /// J: `work_scale` = 2G* times the integral that [`Springs::walk`] gives. `None`, with nothing
    /// changed, where the state is of another kind or the work is more than `most_work`.
    ///
    /// Springs that stick stay as they are. Those that slip end up on one line in g, so that two
    /// knots do for all.
    pub(crate) fn slide(
        &mut self,
        surface: &Surface,
        contact: &Contact,
        bound_slope: f64,
        displacement: f64,
        (work_scale, most_work): (f64, f64),
        mut slips: Option<&mut Vec<SlipPiece>>,
    ) -> Option<f64> {
        let bound = |image: f64| bound_slope * (contact.depth - image).max(0.0);
        let rounding = rounding(bound_slope, contact, displacement);
        let trial = |knot| Trial::new(knot, displacement, bound(knot.place.image), rounding);
        let sticking = self.knots.iter().take_while(|knot| !trial(knot).slips()).count();
        let (inner, outer) = self.knots.split_at(sticking);
        let Some((first, others)) = outer.split_first() else { return Some(0.0) };
        let first = trial(first);
        let front;
        let (start, mut work) = match inner.last() {
            None => (first.clipped(), 0.0),
            Some(inner) => {
                let inner = trial(inner);
                front = between(surface, &inner, &first, share_at_bound(&inner, &first, first.side()));
                let at_bound = trial(&front);
                (at_bound.at_front(rounding), slip_work(&at_bound, &first, slips.as_deref_mut()))
            }
        };
        let mut last = first;
        for knot in others {
            let next = trial(knot);
            if !next.slips_with(&first) {
                return None;
            }
            work += slip_work(&last, &next, slips.as_deref_mut());
            last = next;
        }
        let work = work_scale * work;
        let allowed = work <= most_work;
        // so that it also refuses what is no number
        if !allowed {
            return None;
        }
        let end = last.clipped();
        let alone = inner.is_empty() && others.is_empty();
        self.knots.truncate(sticking);
        append(&mut self.knots, start, rounding);
        if !alone {
            append(&mut self.knots, end, rounding);
        }
        Some(work)
    }
}
