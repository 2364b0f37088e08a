//! The walk of the row along a straight line in load and displacement: springs touch and leave,
//! stick and slip.

use super::sampling::interpolated;
use super::spring::{Line, Moved, norm, unit};
use super::{PlanarKnot, PlanarRow};
use crate::friction::interval::Interval;
use crate::friction::{Path, SlipPiece};
use nalgebra::Vector2;

impl Path<'_> {
    /// The spring that comes into contact at a radius along the line.
    pub(super) fn touching(&self, x: f64) -> PlanarKnot {
        let place = self.surface.place(x);
        PlanarKnot { place, origin: self.displacement_at_touch(&place) }
    }
}

impl PlanarRow {
    /// Walks a path. Returns the new row and ∫ |u| |de| dx, the work of friction over 2G*, m³.
    /// `spare` is a row no longer needed whose memory is used again. Where `slips` are asked for,
    /// they are put there.
    pub(crate) fn walk(
        &self,
        path: &Path,
        mut spare: Self,
        mut slips: Option<&mut Vec<SlipPiece>>,
    ) -> (Self, f64) {
        spare.copy_from(self);
        let mut row = spare;
        if path.to.radius > path.from.radius {
            row.touch(path);
        }
        let inside = row.knots.partition_point(|knot| knot.place.x <= path.to.radius);
        if !path.to.is_open() && row.knots.get(inside.max(1) - 1).is_some_and(|k| k.place.x < path.to.radius)
        {
            let place = path.surface.place(path.to.radius);
            row.knots.insert(inside, interpolated(&row, inside - 1, place));
        }
        let (motion, depths) = (path.motion(), (path.from.depth, path.to.depth));
        let bound = path.bound_slope * depths.1.abs();
        let unit = unit(norm(motion).max(bound).max(path.start_slope * depths.0.abs()));
        let rounding = 4.0 * f64::EPSILON * (bound + norm(path.start).max(norm(path.end)));
        let scale = 1.0 / unit;
        let line = Line::new(motion * scale, path.stiffness_ratio, scale * rounding);
        let slopes = (scale * path.start_slope, scale * path.bound_slope);
        // those inside are in contact all the way
        let lasting = if path.from.is_open() { 0.0 } else { path.from.radius.min(path.to.radius) };
        let mut work = 0.0;
        let mut inner = (0.0, 0.0);
        for j in 0..row.knots.len() {
            let knot = &mut row.knots[j];
            // m (d − g), below 0 out of contact
            let first = slopes.0 * (depths.0 - knot.place.image);
            let last = slopes.1 * (depths.1 - knot.place.image);
            let bounds = (first.max(0.0), last.max(0.0));
            let moved = if knot.place.x <= lasting {
                line.slip((path.end - knot.origin) * scale, bounds)
            } else if path.from.is_open() || knot.place.x > path.from.radius {
                // on the way, relaxed
                let line = line.part(1.0 - path.share_at_touch(&knot.place));
                line.slip(line.trial(Vector2::zeros()), bounds)
            } else {
                let share = if last < 0.0 && first > 0.0 { first / (first - last) } else { 1.0 };
                let line = line.part(share);
                line.slip(line.trial((path.start - knot.origin) * scale), bounds)
            };
            let mut outer = (0.0, bounds.1);
            if let Some(Moved { deflection, slip, mean_bound }) = moved {
                knot.origin = path.end - deflection * unit;
                outer = (slip, mean_bound);
            }
            if j > 0 && (inner.0 > 0.0 || outer.0 > 0.0) {
                let (p, q) = (&row.knots[j - 1].place, &row.knots[j].place);
                let interval = Interval::between(p, q);
                work += interval.slip_work((inner.1, outer.1), (inner.0, outer.0));
                if let Some(slips) = &mut slips {
                    let slip = (unit * inner.0, unit * outer.0);
                    slips.push(SlipPiece::over((p.image, q.image), slip, &interval));
                }
            }
            inner = outer;
        }
        let kept = if path.to.is_open() {
            0
        } else {
            row.knots.partition_point(|knot| knot.place.x <= path.to.radius)
        };
        row.knots.truncate(kept);
        row.tidy(path);
        (row, work * unit * unit)
    }
}
