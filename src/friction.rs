//! Stick and slip of the spring row (paper, eq. (13)), exact between its knots.
//!
//! Each spring at x remembers its *origin* e(x), the displacement of the body at which it would be
//! relaxed; it is deflected by u = U − e and slips where |u| would exceed the bound b(x) = m (d −
//! g(x)), m = μE*/G*.
//!
//! e is kept as a continuous function that is piecewise linear **in g** between a few knots. Under
//! constant load every state that the law can reach is of that form (a slip zone is u = ±b, linear
//! in g; a stuck zone keeps what it was), so clipping adds a knot exactly where the front stands
//! and removes those it has wiped out: no error from a grid, and a loop costs a handful of knots
//! whatever the resolution. Springs that come into contact while the body moves start at the
//! displacement of their own instant of touch; where that is not linear in g it is sampled.
//!
//! One clip at the end of a straight line in (F_N, U) is exact, however long the line: d is a
//! concave function of F_N (the stiffness 2E*a rises with the load), so along the line U − e ∓ b is
//! convex or concave and violates the bound most at an end. Hence a step may be split at will
//! without changing the result.

mod interval;
mod path;
mod planar;
mod row;
mod slide;
mod slip;
mod walk;

pub(crate) use path::Path;
pub(crate) use planar::{PlanarRow, Resting, Samples, Standing, Tangent, norm};
pub(crate) use row::Row;

use crate::surface::{Contact, Place, Surface};
use interval::Interval;
use serde::{Deserialize, Serialize};
pub(crate) use slip::SlipPiece;

/// Share of a bound that no force shows: so near to its bound a spring is at it, and so near to a
/// line a knot is left out.
const NEARLY: f64 = 1e-9;

/// Intervals that are looked at together where a row is coarsened.
const GROUP: usize = 4;

/// Widest over narrowest of them: the kinks of strokes that hardly differ, not a wide zone beside
/// one, whose springs would slip too early or too late all together.
const EVEN: f64 = 16.0;

/// One knot of the spring row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Knot {
    pub(crate) place: Place,
    /// Displacement at which this spring would be relaxed, m.
    pub(crate) origin: f64,
}

/// The spring row under the contact, knots from the axis to the contact edge; none where the bodies
/// are apart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Springs {
    knots: Vec<Knot>,
}

impl Springs {
    pub(crate) fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Takes the smaller of its own memory and a spare one: among many rows each then has what it
    /// needs, and one large spare serves all.
    pub(crate) fn take_smaller(&mut self, spare: &mut Self) {
        if spare.knots.capacity() < self.knots.capacity() {
            spare.knots.clear();
            spare.knots.reserve_exact(self.knots.len());
            spare.knots.extend_from_slice(&self.knots);
            std::mem::swap(self, spare);
        }
        if self.knots.capacity() > self.knots.len() + 1 {
            self.knots.shrink_to_fit();
        }
    }

    /// Becomes a copy of another row in its own memory.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.knots.clone_from(&other.knots);
    }

    /// Springs from saved knots (radius and origin) on the present surface.
    pub(crate) fn from_origins(surface: &Surface, origins: &[(f64, f64)]) -> Self {
        let knots = origins.iter().map(|&(x, origin)| Knot { place: surface.place(x), origin }).collect();
        Self { knots }
    }

    /// ∫ u dx from the axis to the edge, m².
    pub(crate) fn deflection_integral(&self, displacement: f64) -> f64 {
        let [first, others @ ..] = &self.knots[..] else { return 0.0 };
        let (mut inner, mut deflection, mut sum) = (&first.place, displacement - first.origin, 0.0);
        for outer in others {
            let next = displacement - outer.origin;
            // springs that have never slipped are all deflected by the same
            sum += if next == deflection {
                deflection * (outer.place.x - inner.x)
            } else {
                Interval::between(inner, &outer.place).linear(deflection, next)
            };
            (inner, deflection) = (&outer.place, next);
        }
        sum
    }

    /// ∫ u² dx from the axis to the edge, m³: the elastic energy of the row over G*.
    pub(crate) fn energy_integral(&self, displacement: f64) -> f64 {
        let pair = |w: &[Knot]| {
            let u = (displacement - w[0].origin, displacement - w[1].origin);
            Interval::between(&w[0].place, &w[1].place).product(u, u)
        };
        self.knots.windows(2).map(pair).sum()
    }

    /// ∫ share u² dx, m³, of a share that changes to another at some places, from inside outwards;
    /// it is 0 inside the first.
    pub(crate) fn energy_integral_of(&self, displacement: f64, shares: &[(Place, f64)]) -> f64 {
        let (mut share, mut sum, mut shares) = (0.0, 0.0, shares.iter().peekable());
        for pair in self.knots.windows(2) {
            let deflection = |origin: f64| displacement - origin;
            let (mut inner, mut u) = (pair[0].place, deflection(pair[0].origin));
            let mut add = |share: f64, place: Place, origin: f64| {
                let ends = (u, deflection(origin));
                if share > 0.0 {
                    sum += share * Interval::between(&inner, &place).product(ends, ends);
                }
                (inner, u) = (place, ends.1);
            };
            while let Some((place, next)) = shares.next_if(|(place, _)| place.x < pair[1].place.x) {
                if place.x > pair[0].place.x {
                    add(share, *place, interpolate(&pair[0], &pair[1], place.image));
                }
                share = *next;
            }
            add(share, pair[1].place, pair[1].origin);
        }
        sum
    }

    /// Origins at the given rising radii inside the contact.
    pub(crate) fn origins_at(&self, surface: &Surface, radii: &[f64]) -> Vec<f64> {
        let mut j = 0;
        radii
            .iter()
            .map(|&x| {
                while j + 2 < self.knots.len() && self.knots[j + 1].place.x <= x {
                    j += 1;
                }
                match self.knots.get(j..j + 2) {
                    // next to a knot the image may be so steep that a rounding of x would show
                    Some([p, _]) if (x - p.place.x).abs() <= 1e-11 * x => p.origin,
                    Some([_, q]) if (x - q.place.x).abs() <= 1e-11 * x => q.origin,
                    Some([p, q]) if x < q.place.x => interpolate(p, q, surface.image(x)),
                    _ => self.knots.last().map_or(0.0, |knot| knot.origin),
                }
            })
            .collect()
    }

    /// The same row on a surface whose wear has changed: origins stay with their springs. Knots are
    /// added at the surface's nodes where the origin is not constant, since it was linear in the
    /// image of before.
    pub(crate) fn moved_to(&self, old: &Surface, new: &Surface) -> Self {
        let nodes = new.worn().map_or(&[][..], |nodes| nodes.x());
        let mut origins: Vec<(f64, f64)> = Vec::with_capacity(self.knots.len() + nodes.len());
        for (i, knot) in self.knots.iter().enumerate() {
            origins.push((knot.place.x, knot.origin));
            if let Some(next) = self.knots.get(i + 1)
                && next.origin != knot.origin
            {
                let first = nodes.partition_point(|&x| x <= knot.place.x);
                let end = nodes.partition_point(|&x| x < next.place.x);
                let inside = nodes.get(first..end).unwrap_or_default();
                origins.extend(inside.iter().map(|&x| (x, interpolate(knot, next, old.image(x)))));
            }
        }
        Self::from_origins(new, &origins)
    }

    /// Leaves out knots that lie on the line between others, but for a share of the bound that no
    /// force shows.
    pub(crate) fn simplify(&mut self, contact: &Contact, bound_slope: f64) {
        let deviation = NEARLY * bound_slope * contact.depth.abs();
        let mut kept = Vec::with_capacity(self.knots.len());
        for knot in &self.knots {
            walk::append(&mut kept, *knot, deviation);
        }
        self.knots = kept;
    }

    /// Leaves out two of the three knots inside each four intervals where that changes the
    /// deflections by less than `share` of the contact radius times the largest bound, in the
    /// integral; the integral itself, and with it the force, stays. Small kinks become fewer and
    /// wider.
    pub(crate) fn coarsen(&mut self, contact: &Contact, bound_slope: f64, share: f64) {
        let most = share * contact.radius * bound_slope * contact.depth.abs();
        let knots = &mut self.knots;
        let (mut kept, mut next) = (0, 0);
        while next + GROUP < knots.len() {
            let replaced = replacement(&knots[next..=next + GROUP], most);
            let taken = if replaced.is_some() { 1 } else { GROUP };
            knots.copy_within(next..next + taken, kept);
            kept += taken;
            if let Some(knot) = replaced {
                knots[kept] = knot;
                kept += 1;
            }
            next += GROUP;
        }
        knots.drain(kept..next);
    }

    /// Puts the springs outside radius `inner` (all, if that is 0) at their bound on one side.
    pub(crate) fn follow_bound(
        &mut self,
        (inner, side): (f64, f64),
        contact: &Contact,
        bound_slope: f64,
        displacement: f64,
    ) {
        for knot in self.knots.iter_mut().filter(|knot| knot.place.x > inner || inner == 0.0) {
            knot.origin = displacement - side * bound_slope * (contact.depth - knot.place.image).max(0.0);
        }
    }

    /// Inner edge of the outer zone in which all springs are at their bound on one side: the stick
    /// radius, m.
    pub(crate) fn stick_radius(&self, contact: &Contact, bound_slope: f64, displacement: f64) -> f64 {
        self.slip_zone(contact, bound_slope, displacement).0
    }

    /// Stick radius and the sign of the slip zone outside it (0 in full stick).
    pub(crate) fn slip_zone(&self, contact: &Contact, bound_slope: f64, displacement: f64) -> (f64, f64) {
        let rounding = 8.0 * f64::EPSILON * displacement.abs();
        let side_at = |knot: &Knot| {
            let bound = bound_slope * (contact.depth - knot.place.image).max(0.0);
            let u = displacement - knot.origin;
            let at_bound = u.abs() >= bound * (1.0 - NEARLY) - rounding;
            // at the very edge bound and deflection vanish: it belongs to either side
            let edge = bound <= NEARLY * bound_slope * contact.depth.abs() + rounding;
            (at_bound || edge, if edge { 0.0 } else { u.signum() })
        };
        let mut zone = (contact.radius, 0.0);
        for pair in self.knots.windows(2).rev() {
            let ((inner, side), (outer, outer_side)) = (side_at(&pair[0]), side_at(&pair[1]));
            if !(inner && outer) || side * outer_side < 0.0 || side * zone.1 < 0.0 {
                break;
            }
            zone = (pair[0].place.x, if side == 0.0 { zone.1 } else { side });
        }
        zone
    }
}

/// ∫ b² dx between two places of the bound b = m (d − g), m³, m the `bound_slope`.
pub(crate) fn bound_square((inner, outer): (&Place, &Place), depth: f64, bound_slope: f64) -> f64 {
    let bounds = [inner, outer].map(|place| bound_slope * (depth - place.image).max(0.0)).into();
    Interval::between(inner, outer).product(bounds, bounds)
}

/// The middle one of some knots with an origin that keeps ∫ e dx if the others inside are left out;
/// `None` if ∫ |Δe| dx would exceed `most`, m², or if the intervals differ much.
fn replacement(knots: &[Knot], most: f64) -> Option<Knot> {
    let (first, middle, last) = (&knots[0], &knots[knots.len() / 2], &knots[knots.len() - 1]);
    let integral = |p: &Knot, q: &Knot| Interval::between_near(&p.place, &q.place).linear(p.origin, q.origin);
    let wanted: f64 = knots.windows(2).map(|pair| integral(&pair[0], &pair[1])).sum();
    let inner = Interval::between_near(&first.place, &middle.place);
    let outer = Interval::between_near(&middle.place, &last.place);
    let of_ends = inner.linear(first.origin, 0.0) + outer.linear(0.0, last.origin);
    let weight = inner.linear(0.0, 1.0) + outer.linear(1.0, 0.0);
    let knot = Knot { origin: (wanted - of_ends) / weight, ..*middle };
    let line = |place: &Place| {
        if place.x < knot.place.x {
            interpolate(first, &knot, place.image)
        } else {
            interpolate(&knot, last, place.image)
        }
    };
    let deviation = |knot: &Knot| (knot.origin - line(&knot.place)).abs();
    let change: f64 = knots
        .windows(2)
        .map(|pair| (pair[1].place.x - pair[0].place.x) * deviation(&pair[0]).max(deviation(&pair[1])))
        .sum();
    let widths = knots.windows(2).map(|pair| pair[1].place.image - pair[0].place.image);
    let (narrowest, widest) =
        widths.fold((f64::INFINITY, 0f64), |(n, w), width| (n.min(width), w.max(width)));
    // so that it also refuses what is no number
    (change <= most && widest <= EVEN * narrowest).then_some(knot)
}

/// Origin at image g on the line between two knots.
fn interpolate(p: &Knot, q: &Knot, image: f64) -> f64 {
    let rise = q.place.image - p.place.image;
    let share = if rise > 0.0 { ((image - p.place.image) / rise).clamp(0.0, 1.0) } else { 0.5 };
    p.origin + share * (q.origin - p.origin)
}

#[cfg(test)]
mod tests;
