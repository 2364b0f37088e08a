//! Slip under a contact that does not change, where the outer springs all slip to one side: nearly
//! every step of nearly every run, and so done in place.

use super::interval::{Interval, at_least};
use super::walk::{FAR_OFF, between, rounding};
use super::{Knot, Springs};
use crate::friction::SlipPiece;
use crate::surface::{Contact, Place, Surface};

impl Springs {
    /// Moves the body to `displacement` under an unchanged contact. Returns the work of friction,
    /// J: `work_scale` = 2G* times the integral that [`Springs::walk`] gives. `None`, with nothing
    /// changed, where the state is of another kind or the work is more than `most_work`. Where
    /// `slips` are asked for, they are put there.
    ///
    /// Springs that stick stay as they are. Those that slip end up on one line in g, so that two
    /// knots do for all.
    #[inline]
    pub(crate) fn slide(
        &mut self,
        surface: &Surface,
        contact: &Contact,
        bound_slope: f64,
        displacement: f64,
        (work_scale, most_work): (f64, f64),
        mut slips: Option<&mut Vec<SlipPiece>>,
    ) -> Option<f64> {
        let rounding = rounding(bound_slope, contact, displacement);
        let bound = |knot: &Knot| bound_slope * at_least(contact.depth - knot.place.image, 0.0);
        // deflection and bound: of the outermost of the inner springs that stick, and of the next
        let (mut within, mut sticking) = ((0.0, 0.0), 0);
        let beyond = loop {
            let Some(knot) = self.knots.get(sticking) else { return Some(0.0) };
            let spring = (displacement - knot.origin, bound(knot));
            // written so that what is no number slips, and is refused below
            let sticks = spring.0.abs() - spring.1 <= rounding;
            if !sticks {
                break spring;
            }
            (within, sticking) = (spring, sticking + 1);
        };
        let side = 1f64.copysign(beyond.0);
        let excess = |(deflection, bound): (f64, f64)| side * deflection - bound;
        let clipped = |place: &Place, bound: f64| Knot { place: *place, origin: displacement - side * bound };

        // the innermost spring that slips, or the front: a spring at its bound, else one between it
        // and those that stick
        let (inner, outer) = self.knots.split_at(sticking);
        let (start, kept, mut slip, mut last_bound, others) = match inner.last() {
            None => {
                let (place, slip) = (&outer[0].place, excess(beyond));
                (clipped(place, beyond.1), 0, slip, beyond.1, &outer[1..])
            }
            Some(inner) => {
                let margin = -excess(within);
                let (mut start, kept, bound) = if margin <= rounding {
                    (*inner, sticking - 1, within.1)
                } else {
                    let front = between(surface, inner, &outer[0], margin / (margin + excess(beyond)));
                    (front, sticking, bound(&front))
                };
                let slip = excess((displacement - start.origin, bound));
                // else it stays as it is: clipping it would put the bound's rounding into the
                // springs that stick
                if slip > FAR_OFF * rounding {
                    start = clipped(&start.place, bound);
                }
                (start, kept, if slip <= rounding { 0.0 } else { slip }, bound, outer)
            }
        };
        let (mut work, mut last) = (0.0, start.place);
        for knot in others {
            let knot_bound = bound(knot);
            let next = excess((displacement - knot.origin, knot_bound));
            // written so that it also refuses what is no number
            let is_beyond = next > rounding;
            if !is_beyond {
                return None;
            }
            let interval = Interval::between(&last, &knot.place);
            if let Some(slips) = &mut slips {
                slips.push(SlipPiece::over((last.image, knot.place.image), (slip, next), &interval));
            }
            work += interval.slip_work((last_bound, knot_bound), (slip, next));
            (last, last_bound, slip) = (knot.place, knot_bound, next);
        }
        let work = work_scale * work;
        let allowed = work <= most_work;
        // so that it also refuses what is no number
        if !allowed {
            return None;
        }
        let (end, alone) = (clipped(&last, last_bound), others.is_empty());
        self.knots.truncate(kept);
        self.knots.push(start);
        if !alone {
            self.knots.push(end);
        }
        Some(work)
    }
}
