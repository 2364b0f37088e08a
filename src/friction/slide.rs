//! Slip under a contact that does not change, where the outer springs all slip to one side: nearly
//! every step of nearly every run, and so done in place.

use super::interval::Interval;
use super::walk::{FAR_OFF, between, rounding};
use super::{Knot, Springs};
use crate::friction::SlipPiece;
use crate::surface::{Contact, Surface};

impl Springs {
    /// Moves the body to `displacement` under an unchanged contact. Returns the work of friction,
    /// J: `work_scale` = 2G* times the integral that [`Springs::walk`] gives. `None`, with nothing
    /// changed, where the state is of another kind or the work is more than `most_work`.
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
        mut gather: impl FnMut(SlipPiece),
    ) -> Option<f64> {
        let rounding = rounding(bound_slope, contact, displacement);
        let bound = |knot: &Knot| bound_slope * (contact.depth - knot.place.image).max(0.0);
        let sticks = |knot: &Knot| (displacement - knot.origin).abs() - bound(knot) <= rounding;
        let Some(sticking) = self.knots.iter().position(|knot| !sticks(knot)) else { return Some(0.0) };
        let (inner, outer) = self.knots.split_at(sticking);
        let side = 1f64.copysign(displacement - outer[0].origin);
        let excess = |knot: &Knot| side * (displacement - knot.origin) - bound(knot);
        let clipped = |knot: &Knot| Knot { origin: displacement - side * bound(knot), ..*knot };

        // the innermost spring that slips, or the front: a spring at its bound, else one between it
        // and those that stick
        let (mut last, mut slip) = (outer[0], excess(&outer[0]));
        let (mut start, mut kept, mut others) = (clipped(&last), sticking, &outer[1..]);
        if let Some(inner) = inner.last() {
            let margin = -excess(inner);
            if margin <= rounding {
                (start, kept) = (*inner, sticking - 1);
            } else {
                start = between(surface, inner, &last, margin / (margin + slip));
            }
            (last, slip, others) = (start, excess(&start), outer);
            // else it stays as it is: clipping it would put the bound's rounding into the springs
            // that stick
            if slip > FAR_OFF * rounding {
                start = clipped(&start);
            }
            if slip <= rounding {
                slip = 0.0;
            }
        }
        let mut work = 0.0;
        for knot in others {
            let next = excess(knot);
            // written so that it also refuses what is no number
            let slips = next > rounding;
            if !slips {
                return None;
            }
            let interval = Interval::between(&last.place, &knot.place);
            gather(SlipPiece::over((last.place.image, knot.place.image), (slip, next), &interval));
            work += interval.slip_work((bound(&last), bound(knot)), (slip, next));
            (last, slip) = (*knot, next);
        }
        let work = work_scale * work;
        let allowed = work <= most_work;
        // so that it also refuses what is no number
        if !allowed {
            return None;
        }
        let alone = self.knots.len() == 1;
        self.knots.truncate(kept);
        self.knots.push(start);
        if !alone {
            self.knots.push(clipped(&last));
        }
        Some(work)
    }
}
