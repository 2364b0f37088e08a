//! The walk of a spring row along a straight line in (load, displacement): springs touch and leave,
//! slip where their bound is exceeded, and do work.

use super::interval::Interval;
use super::{Knot, Path, SlipPiece, Springs, interpolate};
use crate::parameters::NormalControl;
use crate::surface::{Contact, Place, Surface};

impl Path<'_> {
    #[inline(always)]
    fn knot_touching(&self, x: f64) -> Knot {
        let place = self.surface.place(x);
        Knot { place, origin: self.displacement_at_touch(&place).x }
    }

    /// B of the bound b(t) = b₀ + (b₁ − b₀) t + B t (1 − t) along the path, m. Under a prescribed
    /// force the depth is a concave function of it, with dd/dF = 1/(2E*a). B keeps the mean that
    /// values and slopes at the ends give; from or to first touch, the mean of a power law.
    fn bulge(&self) -> f64 {
        let (from, to) = (&self.from, &self.to);
        let rise = (to.depth - from.depth).abs();
        if self.control == NormalControl::Indentation || rise == 0.0 {
            return 0.0;
        }
        let change = (to.load - from.load).abs();
        if change <= EVEN * from.load.max(to.load) {
            return 0.0;
        }
        let bulge = if from.is_open() || to.is_open() {
            let exponent = change / (from.radius.max(to.radius) * rise);
            6.0 * rise * (1.0 / (1.0 + exponent) - 0.5)
        } else {
            0.5 * change * (1.0 / from.radius - 1.0 / to.radius).abs()
        };
        self.bound_slope * bulge.clamp(0.0, rise)
    }
}

/// Friction bound b(g) = m (d − g), m of spring deflection, at a [`depth_in_contact`].
#[inline(always)]
fn bound(bound_slope: f64, depth: f64, image: f64) -> f64 {
    bound_slope * (depth - image).max(0.0)
}

/// Largest image of a spring in contact, m; below all images where the bodies are apart.
fn depth_in_contact(contact: &Contact) -> f64 {
    if contact.is_open() { f64::NEG_INFINITY } else { contact.depth }
}

/// Whether a spring is out of contact. That is asked of its radius, where that is known: at the
/// contact edge its image and the depth differ by rounding, and so does the load at which it leaves
/// contact. Under a load that changes by no more it would leave anywhere on the way.
#[inline(always)]
fn is_outside(contact: &Contact, place: &Place) -> bool {
    let is_unknown = place.x.is_nan();
    contact.is_open() || place.x > contact.radius || (is_unknown && place.image > contact.depth)
}

/// Share of a path after which a spring slips that has `margin` to its bound at the start and is
/// `excess` beyond it at the end: the root of (margin + excess) t − `bulge` t (1 − t) = margin.
#[inline]
fn onset(margin: f64, excess: f64, bulge: f64) -> f64 {
    if bulge == 0.0 {
        return margin / (margin + excess);
    }
    let slope = margin + excess - bulge;
    let root = (slope * slope + 4.0 * bulge * margin).sqrt();
    let share = if slope > 0.0 { 2.0 * margin / (slope + root) } else { (root - slope) / (2.0 * bulge) };
    share.min(1.0)
}

/// How much more than the rounding of its bound a front may be off.
pub(super) const FAR_OFF: f64 = 1e4;

/// Spacing of the samples of one line, relative to that of many: T of a first press on 64 cells is
/// 8e-6 of μF_N off, 1.4e-5 at 1.
const WITHIN_A_LINE: f64 = 0.75;

/// Change of load, relative to the larger one, up to which the bound is taken to change evenly: the
/// work of a line is off by up to 2e-4, that of histories by 3e-5, in two thirds of the time.
const EVEN: f64 = 0.05;

/// State of a spring at the end of a path, before it slips.
#[derive(Clone, Copy)]
pub(super) struct Trial {
    pub(super) knot: Knot,
    displacement: f64,
    deflection: f64,
    pub(super) bound: f64,
    /// Mean bound while it slips, m.
    pub(super) mean_bound: f64,
    /// How far it is beyond its bound, m ≥ 0.
    pub(super) excess: f64,
}

impl Trial {
    /// A spring whose excess is within the `rounding` of the bound sticks: else a motion too small
    /// to differ from 0 beside the bound would move the whole row's origins.
    #[inline]
    pub(super) fn new(knot: Knot, displacement: f64, bound: f64, rounding: f64) -> Self {
        let deflection = displacement - knot.origin;
        let excess = deflection.abs() - bound;
        // written so that what is no number is taken to slip, and shows in the work
        let excess = if excess <= rounding { 0.0 } else { excess };
        Self { knot, displacement, deflection, bound, mean_bound: bound, excess }
    }

    #[inline]
    pub(super) fn slips(&self) -> bool {
        self.excess != 0.0
    }

    /// Side of the bound on which it is or would be, ±1.
    #[inline]
    pub(super) fn side(&self) -> f64 {
        1f64.copysign(self.deflection)
    }

    /// Whether both slip, to the same side.
    #[inline]
    pub(super) fn slips_with(&self, other: &Self) -> bool {
        self.slips() && other.slips() && self.side() == other.side()
    }

    /// Excess over the bound on a given side, below 0 where it is inside.
    #[inline]
    fn excess_on(&self, side: f64) -> f64 {
        side * self.deflection - self.bound
    }

    /// The knot of a front, at its bound as it is: clipping it would put the bound's rounding into
    /// the springs that stick. After a way so long that its own rounding is far above that it is
    /// clipped nevertheless.
    #[inline]
    pub(super) fn at_front(&self, rounding: f64) -> Knot {
        if self.excess > FAR_OFF * rounding { self.clipped() } else { self.knot }
    }

    /// The knot after it has slipped back to its bound.
    #[inline]
    pub(super) fn clipped(&self) -> Knot {
        Knot { origin: self.displacement - self.bound.copysign(self.deflection), ..self.knot }
    }
}

impl Springs {
    /// Walks a path. Returns the new row and ∫ |u| |de| dx, the work of friction over 2G*, m³ (half
    /// the row). `spare` is a row no longer needed whose memory is used again. Where `slips` are
    /// asked for, they are put there.
    pub(crate) fn walk(&self, path: &Path, spare: Self, slips: Option<&mut Vec<SlipPiece>>) -> (Self, f64) {
        let mut row = spare.knots;
        row.clear();
        row.reserve(self.knots.len() + 4);
        let rounding = rounding(path.bound_slope, &path.to, path.end.x);
        let depths = (depth_in_contact(&path.from), depth_in_contact(&path.to));
        let mut walk = Walk { path, depths, row, rounding, bulge: path.bulge(), work: 0.0, slips };
        let mut last = None;
        self.reach(path, |knots| walk.take(&mut last, knots));
        if path.to.is_open() {
            walk.row.clear();
        }
        (Self { knots: walk.row }, walk.work)
    }

    /// Shows `take` the knots of the old row, extended by those that touch along the path, or with
    /// one at the new, smaller edge; in turn, from the axis outward.
    fn reach(&self, path: &Path, mut take: impl FnMut(&[Knot])) {
        let (old, new) = (path.from.radius, path.to.radius);
        if new == old {
            take(&self.knots);
        } else if new > old {
            let moved = path.start.x != path.end.x;
            // along a line of depth the origin is linear in g
            let is_linear = !moved || path.control == NormalControl::Indentation;
            // divided by the radius first: a part of the smallest numbers may be none
            let samples = if is_linear {
                1.0
            } else {
                ((new - old) / new / (WITHIN_A_LINE * path.samples.cell())).ceil().max(1.0)
            };
            let new_edge = path.knot_touching(new);
            match &self.knots[..] {
                [] => take(&[path.knot_touching(0.0)]),
                // a ramp in many small steps would leave a knot at each former edge
                [inner_knots @ .., edge]
                    if let Some(inner) = inner_knots.last()
                        && moved
                        && new - inner.place.x <= path.samples.cell() * new
                        && is_smooth(inner, edge, &new_edge) =>
                {
                    take(inner_knots);
                }
                all => take(all),
            }
            for k in 1..samples as usize {
                take(&[path.knot_touching(old + (new - old) * k as f64 / samples)]);
            }
            take(&[new_edge]);
        } else if new < old
            && !path.to.is_open()
            && let Some(j) = self.knots.iter().position(|knot| knot.place.x > new)
            && j > 0
        {
            let place = path.surface.place(new);
            let origin = interpolate(&self.knots[j - 1], &self.knots[j], place.image);
            take(&self.knots[..j]);
            take(&[Knot { place, origin }]);
            take(&self.knots[j..]);
        } else {
            take(&self.knots);
        }
    }
}

/// Whether the origin goes on with much the same slope in g, so that the old edge is no kink worth
/// keeping.
fn is_smooth(inner: &Knot, edge: &Knot, new: &Knot) -> bool {
    let slope = |p: &Knot, q: &Knot| (q.origin - p.origin) / (q.place.image - p.place.image);
    (0.5..=2.0).contains(&(slope(edge, new) / slope(inner, edge)))
}

/// A walk under way, knot by knot from the axis outward.
struct Walk<'p> {
    path: &'p Path<'p>,
    /// [`depth_in_contact`] at the start and at the end, m.
    depths: (f64, f64),
    row: Vec<Knot>,
    rounding: f64,
    /// [`Path::bulge`].
    bulge: f64,
    /// ∫ |u| |de| dx so far, m³.
    work: f64,
    slips: Option<&'p mut Vec<SlipPiece>>,
}

impl Walk<'_> {
    /// State of a spring at the end, or where it leaves contact, before it slips.
    #[inline(always)]
    fn trial(&self, knot: Knot) -> Trial {
        let (path, (_, depth)) = (self.path, self.depths);
        let leaves = is_outside(&path.to, &knot.place);
        let end = if leaves { path.displacement_at_touch(&knot.place).x } else { path.end.x };
        let bound = bound(path.bound_slope, depth, knot.place.image);
        let mut trial = Trial::new(knot, end, bound, self.rounding);
        if trial.slips() {
            trial.mean_bound = self.mean_bound(&trial, leaves);
        }
        trial
    }

    /// Mean of the bound over what a spring slips, ∫ b |de| / ∫ |de|, m: exact for a bound that
    /// is a parabola along the path, as [`Path::bulge`] has it.
    #[inline(always)]
    fn mean_bound(&self, trial: &Trial, leaves: bool) -> f64 {
        let (path, (depth, _)) = (self.path, self.depths);
        let (place, side) = (&trial.knot.place, trial.side());
        let touches = is_outside(&path.from, place);
        let bound = bound(path.start_slope, depth, place.image);
        // the part of the path on which it is in contact
        let (margin, part) = if touches {
            (0.0, 1.0 - path.share_at_touch(place))
        } else {
            let margin = (bound - side * (path.start.x - trial.knot.origin)).max(0.0);
            (margin, if leaves { path.share_at_touch(place) } else { 1.0 })
        };
        let bulge = self.bulge * part * part;
        let onset = onset(margin, trial.excess, bulge);
        let left = 1.0 - onset;
        let onset_bound = bound + onset * (trial.bound - bound + bulge * left);
        let mean = 0.5 * (onset_bound + trial.bound);
        if bulge == 0.0 {
            return mean;
        }
        let motion = side * path.motion().x * part * left;
        mean + bulge * left * left * motion / (6.0 * trial.excess)
    }

    /// Takes the next knots to the end of the path, outside of the `last` one taken.
    fn take(&mut self, last: &mut Option<Trial>, knots: &[Knot]) {
        for knot in knots {
            let outer = self.trial(*knot);
            let slips = outer.slips();
            if let Some(inner) = last
                && (slips || inner.slips())
            {
                self.work += self.cross(inner, &outer);
            }
            self.push(if slips { outer.clipped() } else { outer.knot });
            *last = Some(outer);
        }
    }

    /// Work of an interval of which at least one end slips. Inserts the knots where its springs
    /// leave the side of the bound on which the inner end slips, and where they reach that on which
    /// the outer end does.
    fn cross(&mut self, inner: &Trial, outer: &Trial) -> f64 {
        if inner.slips_with(outer) {
            return self.slip_work(inner, outer);
        }
        let (mut work, mut left, mut share) = (0.0, *inner, 0.0);
        if inner.slips() {
            share = share_at_bound(inner, outer, inner.side());
            let end = between(self.path.surface, &inner.knot, &outer.knot, share);
            let at_bound = self.trial(end);
            work += self.slip_work(&left, &at_bound);
            self.push(at_bound.at_front(self.rounding));
            left = at_bound;
        }
        if outer.slips() {
            // rounding must not turn the two ends of the sticking part round
            share = share_at_bound(inner, outer, outer.side()).max(share);
            let start = between(self.path.surface, &inner.knot, &outer.knot, share);
            let at_bound = self.trial(start);
            work += self.slip_work(&left, &at_bound);
            self.push(at_bound.at_front(self.rounding));
            left = at_bound;
        }
        work + self.slip_work(&left, outer)
    }

    #[inline(always)]
    fn slip_work(&mut self, inner: &Trial, outer: &Trial) -> f64 {
        if self.bulge == 0.0 {
            slip_work(inner, outer, self.slips.as_deref_mut())
        } else {
            self.uneven_slip_work(inner, outer)
        }
    }

    /// [`slip_work`] where the bound does not change evenly: its product with the slip is a
    /// parabola in g through its values at the ends and in the middle.
    #[inline(never)]
    fn uneven_slip_work(&mut self, inner: &Trial, outer: &Trial) -> f64 {
        let Some(interval) = slip_interval(inner, outer, self.slips.as_deref_mut()) else { return 0.0 };
        let middle = middle(&inner.knot, &outer.knot);
        let density = |trial: &Trial| trial.mean_bound * trial.excess;
        let densities = [inner, &self.trial(middle), outer].map(density);
        interval.parabola(densities).max(0.0)
    }

    /// Appends a knot that is still in contact.
    #[inline]
    fn push(&mut self, knot: Knot) {
        if knot.place.x <= self.path.to.radius {
            append(&mut self.row, knot, self.rounding);
        }
    }
}

/// Share (in g) of the way between two springs at which they are just at their bound on one side,
/// of which one is beyond it and the other, but for rounding, is not.
pub(super) fn share_at_bound(inner: &Trial, outer: &Trial, side: f64) -> f64 {
    let (e0, e1) = (inner.excess_on(side), outer.excess_on(side));
    (e0 / (e0 - e1)).clamp(0.0, 1.0)
}

/// Deviation below which a knot lies on the line between its neighbours, and a spring is not beyond
/// its bound, m.
pub(super) fn rounding(bound_slope: f64, contact: &Contact, displacement: f64) -> f64 {
    4.0 * f64::EPSILON * (bound_slope * contact.depth.abs() + displacement.abs())
}

/// Appends a knot to a row; drops its predecessor where that lies on the line.
#[inline]
pub(super) fn append(row: &mut Vec<Knot>, knot: Knot, rounding: f64) {
    if let [.., first, second] = &row[..]
        && (interpolate(first, &knot, second.place.image) - second.origin).abs() <= rounding
    {
        row.pop();
    }
    row.push(knot);
}

/// ∫ |u| |de| dx over an interval that slips to one side.
#[inline(always)]
pub(super) fn slip_work(inner: &Trial, outer: &Trial, slips: Option<&mut Vec<SlipPiece>>) -> f64 {
    slip_interval(inner, outer, slips).map_or(0.0, |interval| {
        interval.slip_work((inner.mean_bound, outer.mean_bound), (inner.excess, outer.excess))
    })
}

/// The interval between two springs of which at least one slips, after its slip is put to others.
#[inline(always)]
fn slip_interval(inner: &Trial, outer: &Trial, slips: Option<&mut Vec<SlipPiece>>) -> Option<Interval> {
    if !inner.slips() && !outer.slips() {
        return None;
    }
    let interval = Interval::between(&inner.knot.place, &outer.knot.place);
    if let Some(slips) = slips {
        let images = (inner.knot.place.image, outer.knot.place.image);
        slips.push(SlipPiece::over(images, (inner.excess, outer.excess), &interval));
    }
    Some(interval)
}

/// The spring in the middle (in g) between two others, without its radius and square integral.
fn middle(p: &Knot, q: &Knot) -> Knot {
    let mean = |a: f64, b: f64| 0.5 * (a + b);
    let rise = q.place.image - p.place.image;
    // dφ/dg = x
    let load = mean(p.place.load, q.place.load) - 0.125 * rise * (q.place.x - p.place.x);
    let image = mean(p.place.image, q.place.image);
    let place = Place { x: f64::NAN, image, load, square: f64::NAN };
    Knot { place, origin: mean(p.origin, q.origin) }
}

/// The spring at the given share (in g) of the way between two others.
#[inline(always)]
pub(super) fn between(surface: &Surface, p: &Knot, q: &Knot, share: f64) -> Knot {
    let rise = q.place.image - p.place.image;
    let origin = p.origin + share * (q.origin - p.origin);
    if rise > 0.0 {
        let image = p.place.image + share * rise;
        let place = surface.place_of_image(image, p.place.x, q.place.x);
        // at a worn front the image is so steep that the rounding of x would show in it, and move
        // the front from stroke to stroke
        let steep = surface.worn().is_some() && (place.image - image).abs() > 1e-12 * q.place.image.abs();
        let image = if steep { image } else { place.image };
        // dφ/dg = x
        let load = place.load + place.x * (image - place.image);
        Knot { place: Place { image, load, ..place }, origin }
    } else {
        Knot { place: surface.place(p.place.x + share * (q.place.x - p.place.x)), origin }
    }
}
