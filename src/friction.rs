//! Stick and slip of the spring row (paper, eq. (13)), exact between its knots.
//!
//! Each spring at x remembers its *origin* e(x), the displacement of the body at which it would be relaxed; it is
//! deflected by u = U − e and slips where |u| would exceed the bound b(x) = m (d − g(x)), m = μE*/G*.
//!
//! e is kept as a continuous function that is piecewise linear **in g** between a few knots. Under constant load every
//! state that the law can reach is of that form (a slip zone is u = ±b, linear in g; a stuck zone keeps what it was), so
//! clipping adds a knot exactly where the front stands and removes those it has wiped out: no error from a grid, and a
//! loop costs a handful of knots whatever the resolution. Springs that come into contact while the body moves start
//! at the displacement of their own instant of touch; where that is not linear in g it is sampled.
//!
//! One clip at the end of a straight line in (F_N, U) is exact, however long the line: d is a concave function of F_N
//! (the stiffness 2E*a rises with the load), so along the line U − e ∓ b is convex or concave and violates the bound
//! most at an end. Hence a step may be split at will without changing the result.

use crate::parameters::NormalControl;
use crate::surface::{Contact, Place, Surface};
use std::borrow::Cow;

/// One knot of the spring row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    pub(crate) place: Place,
    /// Displacement at which this spring would be relaxed, m.
    pub(crate) origin: f64,
}

/// The spring row under the contact, knots from the axis to the contact edge; none where the bodies are apart.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Springs {
    knots: Vec<Knot>,
}

/// A straight line between two states of load and displacement.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path<'a> {
    pub(crate) surface: &'a Surface,
    pub(crate) control: NormalControl,
    /// m = μE*/G*.
    pub(crate) bound_slope: f64,
    pub(crate) from: Contact,
    pub(crate) to: Contact,
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// Finest spacing of the samples of newly touching springs, as a share of the contact radius.
    pub(crate) sampling: f64,
}

impl Path<'_> {
    /// Friction bound b(g) in a given contact, m of spring deflection.
    fn bound(&self, contact: &Contact, image: f64) -> f64 {
        if contact.is_open() { 0.0 } else { self.bound_slope * (contact.depth - image).max(0.0) }
    }

    /// Displacement at the instant at which the spring at `place` comes into or leaves contact.
    fn displacement_at_touch(&self, place: &Place) -> f64 {
        let level = match self.control {
            NormalControl::Force => place.load,
            NormalControl::Indentation => place.image,
        };
        let span = self.to.control - self.from.control;
        let share = if span == 0.0 { 1.0 } else { ((level - self.from.control) / span).clamp(0.0, 1.0) };
        self.start + share * (self.end - self.start)
    }

    /// Mean bound while the spring slips: between its onset and the end of the path.
    fn mean_bound(&self, knot: &Knot, trial: f64, final_bound: f64) -> f64 {
        if self.from == self.to {
            return final_bound;
        }
        let initial_bound = self.bound(&self.from, knot.place.image);
        let sign = trial.signum();
        let room = (initial_bound - sign * (self.start - knot.origin)).max(0.0);
        let excess = (trial.abs() - final_bound).max(0.0);
        let onset = if room + excess > 0.0 { room / (room + excess) } else { 1.0 };
        let onset_bound = initial_bound + onset * (final_bound - initial_bound);
        0.5 * (onset_bound + final_bound)
    }
}

/// Integrals over one interval between knots, for functions linear in g.
struct Interval {
    width: f64,
    rise: f64,
    first: f64,
    second: f64,
}

impl Interval {
    /// Width Δx, rise Δg, ∫(g − g₁) dx and ∫(g − g₁)² dx between two places.
    fn between(p: &Place, q: &Place) -> Self {
        let width = q.x - p.x;
        let rise = q.image - p.image;
        if rise <= 0.0 {
            return Self { width, rise: 0.0, first: 0.0, second: 0.0 };
        }
        let first = (q.x * rise - (q.load - p.load)).max(0.0).min(rise * width);
        let second = if width < 3e-4 * q.x {
            // too narrow for a difference of integrals; g is linear in x² there to a relative 1e-4
            let (x, d) = (p.x, width);
            let t = 2.0 * x + d;
            rise * rise * width * (4.0 * x * x / 3.0 + x * d + d * d / 5.0) / (t * t)
        } else {
            q.square - p.square - p.image * (p.image * width + 2.0 * first)
        };
        // Cauchy's inequality below, 0 ≤ g − g₁ ≤ Δg above
        let least = first * first / width.max(f64::MIN_POSITIVE);
        Self { width, rise, first, second: second.max(least).min(rise * first) }
    }

    /// ∫ f dx for f linear in g with the given end values.
    fn linear(&self, f0: f64, f1: f64) -> f64 {
        if self.rise > 0.0 {
            f0 * self.width + (f1 - f0) * (self.first / self.rise)
        } else {
            0.5 * (f0 + f1) * self.width
        }
    }

    /// ∫ f h dx for two such functions.
    fn product(&self, f: (f64, f64), h: (f64, f64)) -> f64 {
        if self.rise > 0.0 {
            let (df, dh) = ((f.1 - f.0) / self.rise, (h.1 - h.0) / self.rise);
            f.0 * h.0 * self.width + (f.0 * dh + df * h.0) * self.first + df * dh * self.second
        } else {
            self.width * (2.0 * f.0 * h.0 + 2.0 * f.1 * h.1 + f.0 * h.1 + f.1 * h.0) / 6.0
        }
    }
}

/// State of a knot at the end of a path, before clipping.
#[derive(Clone, Copy)]
struct Trial {
    knot: Knot,
    deflection: f64,
    bound: f64,
}

impl Trial {
    fn new(path: &Path, knot: Knot) -> Self {
        Self { knot, deflection: path.end - knot.origin, bound: path.bound(&path.to, knot.place.image) }
    }

    /// Slip that brings the deflection back to the bound, signed.
    fn slip(&self) -> f64 {
        self.deflection - self.deflection.clamp(-self.bound, self.bound)
    }

    fn excess(&self, side: f64) -> f64 {
        side * self.deflection - self.bound
    }

    fn clipped(&self) -> Knot {
        Knot { origin: self.knot.origin + self.slip(), ..self.knot }
    }
}

impl Springs {
    pub(crate) fn knots(&self) -> &[Knot] {
        &self.knots
    }

    /// Springs from saved knots (radius and origin) on the present surface.
    pub(crate) fn from_origins(surface: &Surface, origins: &[(f64, f64)]) -> Self {
        let knots = origins.iter().map(|&(x, origin)| Knot { place: surface.place(x), origin }).collect();
        Self { knots }
    }

    /// Walks a path. Returns the new row and ∫ |u| |de| dx, the work of friction over 2G*, m³ (half the row).
    /// `spare` is a row no longer needed whose memory is used again.
    pub(crate) fn walk(&self, path: &Path, spare: Self) -> (Self, f64) {
        let reached = self.candidates(path);
        let mut next = spare;
        next.knots.clear();
        next.knots.reserve(reached.len() + 2);
        let mut work = 0.0;
        let scale = path.bound_slope * path.to.depth.abs() + path.end.abs();
        let mut before: Option<Trial> = None;
        for knot in reached.iter() {
            let trial = Trial::new(path, *knot);
            if let Some(inner) = before {
                work += next.cross(path, inner, trial, scale);
            }
            next.push(path, trial, scale);
            before = Some(trial);
        }
        if path.to.is_open() {
            next.knots.clear();
        }
        (next, work)
    }

    /// The row at the end of a path had it not slipped: extended by springs that touched, cut at the new edge.
    pub(crate) fn touched(&self, path: &Path) -> Self {
        let mut knots = self.candidates(path).into_owned();
        knots.retain(|knot| knot.place.x <= path.to.radius && !path.to.is_open());
        Self { knots }
    }

    /// Knots of the old row, extended by those that touch along the path, or with one at the new, smaller edge.
    fn candidates(&self, path: &Path) -> Cow<'_, [Knot]> {
        let (old, new) = (path.from.radius, path.to.radius);
        if new == old {
            return Cow::Borrowed(&self.knots);
        }
        let mut knots = Vec::with_capacity(self.knots.len() + 4);
        knots.extend_from_slice(&self.knots);
        if new > old {
            if knots.is_empty() {
                let place = path.surface.place(0.0);
                knots.push(Knot { place, origin: path.displacement_at_touch(&place) });
            }
            let moved = path.start != path.end;
            let samples = if moved { ((new - old) / (path.sampling * new)).ceil().max(1.0) } else { 1.0 };
            // a ramp in many small steps would leave a knot at each former edge
            if let [.., inner, edge] = knots[..]
                && moved
                && new - inner.place.x <= path.sampling * new
                && self.is_smooth(edge.origin - inner.origin, path.end - edge.origin)
            {
                knots.pop();
            }
            for k in 1..=samples as usize {
                let x = old + (new - old) * k as f64 / samples;
                let place = path.surface.place(if k as f64 == samples { new } else { x });
                knots.push(Knot { place, origin: path.displacement_at_touch(&place) });
            }
        } else if new < old
            && !path.to.is_open()
            && let Some(j) = knots.iter().position(|knot| knot.place.x > new)
            && j > 0
        {
            let place = path.surface.place(new);
            let origin = interpolate(&knots[j - 1], &knots[j], place.image);
            knots.insert(j, Knot { place, origin });
        }
        Cow::Owned(knots)
    }

    /// Whether the origin goes on in the same direction, so that the old edge is no kink worth keeping.
    fn is_smooth(&self, last_rise: f64, next_rise: f64) -> bool {
        last_rise * next_rise >= 0.0 && last_rise != 0.0
    }

    /// Inserts the knots where the deflection crosses a bound between two trials; returns the interval's work.
    fn cross(&mut self, path: &Path, inner: Trial, outer: Trial, scale: f64) -> f64 {
        if inner.slip() == 0.0 && outer.slip() == 0.0 {
            return 0.0;
        }
        let mut shares = [f64::NAN; 2];
        let mut count = 0;
        for side in [1.0, -1.0] {
            let (e0, e1) = (inner.excess(side), outer.excess(side));
            if (e0 > 0.0) != (e1 > 0.0) && e0 != e1 {
                shares[count] = e0 / (e0 - e1);
                count += 1;
            }
        }
        if count == 2 && shares[0] > shares[1] {
            shares.swap(0, 1);
        }
        let mut work = 0.0;
        let mut left = inner;
        for &share in &shares[..count] {
            let middle = Trial::new(path, between(path.surface, &inner.knot, &outer.knot, share));
            work += slip_work(path, &left, &middle);
            self.push(path, middle, scale);
            left = middle;
        }
        work + slip_work(path, &left, &outer)
    }

    /// Appends a clipped knot that is still in contact; drops its predecessor where that lies on the line.
    fn push(&mut self, path: &Path, trial: Trial, scale: f64) {
        if trial.knot.place.x > path.to.radius {
            return;
        }
        let knot = trial.clipped();
        if let [.., first, second] = self.knots[..]
            && (interpolate(&first, &knot, second.place.image) - second.origin).abs()
                <= 4.0 * f64::EPSILON * scale
        {
            self.knots.pop();
        }
        self.knots.push(knot);
    }

    /// ∫ u dx from the axis to the edge, m².
    pub(crate) fn deflection_integral(&self, displacement: f64) -> f64 {
        let pair = |w: &[Knot]| {
            let interval = Interval::between(&w[0].place, &w[1].place);
            interval.linear(displacement - w[0].origin, displacement - w[1].origin)
        };
        self.knots.windows(2).map(pair).sum()
    }

    /// ∫ u² dx from the axis to the edge, m³: the elastic energy of the row over G*.
    pub(crate) fn energy_integral(&self, displacement: f64) -> f64 {
        let pair = |w: &[Knot]| {
            let u = (displacement - w[0].origin, displacement - w[1].origin);
            Interval::between(&w[0].place, &w[1].place).product(u, u)
        };
        self.knots.windows(2).map(pair).sum()
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

    /// The same row on a surface whose wear has changed: origins stay with their springs. Knots are added at the
    /// surface's nodes where the origin is not constant, since it was linear in the image of before.
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

    /// Takes a row that stands at +`amplitude` to a `displacement` with the same deflections, in direction `side`.
    pub(crate) fn moved_by(&mut self, side: f64, amplitude: f64, displacement: f64) {
        for knot in &mut self.knots {
            knot.origin = displacement - side * (amplitude - knot.origin);
        }
    }

    /// Inner edge of the outer zone in which all springs are at their bound on one side: the stick radius, m.
    pub(crate) fn stick_radius(&self, contact: &Contact, bound_slope: f64, displacement: f64) -> f64 {
        self.slip_zone(contact, bound_slope, displacement).0
    }

    /// Stick radius and the sign of the slip zone outside it (0 in full stick).
    pub(crate) fn slip_zone(&self, contact: &Contact, bound_slope: f64, displacement: f64) -> (f64, f64) {
        let rounding = 8.0 * f64::EPSILON * displacement.abs();
        let side_at = |knot: &Knot| {
            let bound = bound_slope * (contact.depth - knot.place.image).max(0.0);
            let u = displacement - knot.origin;
            let at_bound = u.abs() >= bound * (1.0 - 1e-9) - rounding;
            // at the very edge bound and deflection vanish: it belongs to either side
            let edge = bound <= 1e-12 * bound_slope * contact.depth.abs() + rounding;
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

/// ∫ |u| |de| dx over an interval in which neither end has left its side.
fn slip_work(path: &Path, inner: &Trial, outer: &Trial) -> f64 {
    let slips = (inner.slip().abs(), outer.slip().abs());
    if slips.0 == 0.0 && slips.1 == 0.0 {
        return 0.0;
    }
    let mean = |t: &Trial| path.mean_bound(&t.knot, t.deflection, t.bound);
    Interval::between(&inner.knot.place, &outer.knot.place).product((mean(inner), mean(outer)), slips)
}

/// Origin at image g on the line between two knots.
fn interpolate(p: &Knot, q: &Knot, image: f64) -> f64 {
    let rise = q.place.image - p.place.image;
    let share = if rise > 0.0 { ((image - p.place.image) / rise).clamp(0.0, 1.0) } else { 0.5 };
    p.origin + share * (q.origin - p.origin)
}

/// Knot at the given share (in g) of the way between two others.
fn between(surface: &Surface, p: &Knot, q: &Knot, share: f64) -> Knot {
    let rise = q.place.image - p.place.image;
    let origin = p.origin + share * (q.origin - p.origin);
    if rise > 0.0 {
        let image = p.place.image + share * rise;
        let place = surface.place(surface.radius_of_image(image, p.place.x, q.place.x));
        // at a worn front the image is so steep that the rounding of x would show in it, and move the front from stroke to
        // stroke
        let steep = surface.worn().is_some() && (place.image - image).abs() > 1e-12 * q.place.image.abs();
        Knot { place: if steep { Place { image, ..place } } else { place }, origin }
    } else {
        Knot { place: surface.place(p.place.x + share * (q.place.x - p.place.x)), origin }
    }
}

#[cfg(test)]
mod tests;
