//! The walk of the row along a straight line in load and displacement: springs touch and leave,
//! stick and slip.

use super::sampling::{Samples, interpolated};
use super::spring::{Vector, difference, move_spring, norm, scaled, sum};
use super::{PlanarKnot, PlanarRow};
use crate::friction::SlipPiece;
use crate::friction::interval::Interval;
use crate::friction::walk::share_at_touch;
use crate::parameters::NormalControl;
use crate::surface::{Contact, Place, Surface};

/// A straight line between two states of load and displacement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlanarPath<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) control: NormalControl,
    /// m = μE*/G* at the end.
    pub(crate) bound_slope: f64,
    /// m at the start.
    pub(crate) start_slope: f64,
    /// G*_y/G*_x, by which `start` and `end` are multiplied along y.
    pub(crate) stiffness_ratio: f64,
    pub(crate) from: Contact,
    pub(crate) to: Contact,
    pub(crate) start: Vector,
    pub(crate) end: Vector,
    pub(crate) samples: Samples,
}

impl PlanarPath<'_> {
    /// The spring that comes into contact at a radius along the line.
    pub(super) fn touching(&self, x: f64) -> PlanarKnot {
        let place = self.surface.place(x);
        let origin = sum(self.start, scaled(self.motion(), self.share_at_touch(&place)));
        PlanarKnot { place, origin }
    }

    fn share_at_touch(&self, place: &Place) -> f64 {
        share_at_touch(self.control, (&self.from, &self.to), place)
    }

    fn motion(&self) -> Vector {
        difference(self.end, self.start)
    }
}

/// A spring after its line.
struct End {
    place: Place,
    slip: f64,
    mean_bound: f64,
}

impl PlanarRow {
    /// Walks a path. Returns the new row and ∫ |u| |de| dx, the work of friction over 2G*, m³.
    /// `spare` is a row no longer needed whose memory is used again. Where `slips` are asked for,
    /// they are put there.
    pub(crate) fn walk(
        &self,
        path: &PlanarPath,
        mut spare: Self,
        mut slips: Option<&mut Vec<SlipPiece>>,
    ) -> (Self, f64) {
        spare.copy_from(self);
        let mut row = spare;
        if path.to.radius > path.from.radius {
            row.touch(path);
        }
        let rounding = 4.0
            * f64::EPSILON
            * (path.bound_slope * path.to.depth.abs() + norm(path.start).max(norm(path.end)));
        let mut work = 0.0;
        let mut last: Option<End> = None;
        let inside = row.knots.partition_point(|knot| knot.place.x <= path.to.radius);
        if !path.to.is_open() && row.knots.get(inside.max(1) - 1).is_some_and(|k| k.place.x < path.to.radius)
        {
            let place = path.surface.place(path.to.radius);
            row.knots.insert(inside, interpolated(&row, inside - 1, place));
        }
        for j in 0..row.knots.len() {
            let knot = &mut row.knots[j];
            let before = knot.origin;
            // m (d − g), below 0 out of contact
            let first = path.start_slope * (path.from.depth - knot.place.image);
            let bound = path.bound_slope * (path.to.depth - knot.place.image);
            let touches = path.from.is_open() || knot.place.x > path.from.radius;
            let leaves = path.to.is_open() || knot.place.x > path.to.radius;
            let motion = if touches {
                // on the way, relaxed
                scaled(path.motion(), 1.0 - path.share_at_touch(&knot.place))
            } else if leaves && bound < 0.0 && first > 0.0 {
                scaled(path.motion(), first / (first - bound))
            } else {
                path.motion()
            };
            let start = if touches { [0.0; 2] } else { difference(path.start, before) };
            let moved =
                move_spring(start, motion, (first.max(0.0), bound.max(0.0)), path.stiffness_ratio, rounding);
            // a slip may be lost to rounding beside a bound that falls far
            let held = moved.slip <= 0.0 && moved.deflection == sum(start, motion);
            if !held || norm(moved.deflection) == 0.0 {
                knot.origin = difference(path.end, moved.deflection);
            }
            let end = End { place: knot.place, slip: moved.slip, mean_bound: moved.mean_bound };
            if let Some(inner) = &last
                && (inner.slip > 0.0 || end.slip > 0.0)
            {
                let interval = Interval::between(&inner.place, &end.place);
                let slip = (inner.slip, end.slip);
                work += interval.slip_work((inner.mean_bound, end.mean_bound), slip);
                if let Some(slips) = &mut slips {
                    slips.push(SlipPiece::over((inner.place.image, end.place.image), slip, &interval));
                }
            }
            last = Some(end);
        }
        let kept = if path.to.is_open() {
            0
        } else {
            row.knots.partition_point(|knot| knot.place.x <= path.to.radius)
        };
        row.knots.truncate(kept);
        row.tidy(path);
        (row, work)
    }
}
