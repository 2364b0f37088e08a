//! Closed integrals over the interval between two knots.

use crate::range::LEAST_RISE;
use crate::surface::Place;

/// The part of an integral from the axis below which a difference has less than six digits.
const LOST: f64 = 2e-10;

/// Integrals over one interval between knots, for functions linear in g.
pub(super) struct Interval {
    pub(super) width: f64,
    pub(super) rise: f64,
    pub(super) first: f64,
    pub(super) second: f64,
}

impl Interval {
    /// Width Δx, rise Δg, ∫(g − g₁) dx and ∫(g − g₁)² dx between two places. Inlined so that a
    /// caller pays only for those that it uses.
    #[inline(always)]
    pub(super) fn between(p: &Place, q: &Place) -> Self {
        let width = q.x - p.x;
        let rise = q.image - p.image;
        if rise <= LEAST_RISE {
            return Self { width, rise: 0.0, first: 0.0, second: 0.0 };
        }
        let first = at_most(at_least(q.x * rise - (q.load - p.load), 0.0), rise * width);
        // next to a flat the integrals count from its rim, and keep their digits
        let second = if width < 3e-4 * q.x && rise * rise * width < LOST * q.square {
            // too narrow for a difference of integrals; g is linear in x² there to a relative 1e-4
            let (x, d) = (p.x, width);
            let t = 2.0 * x + d;
            rise * rise * width * (4.0 * x * x / 3.0 + x * d + d * d / 5.0) / (t * t)
        } else {
            q.square - p.square - p.image * (p.image * width + 2.0 * first)
        };
        // Cauchy's inequality below, 0 ≤ g − g₁ ≤ Δg above
        let sound = first * first <= second * width && second <= rise * first;
        Self { width, rise, first, second: if sound { second } else { rounded(width, rise, first, second) } }
    }

    /// [`Self::between`], with the digits of ∫(g − g₁) dx in an interval so narrow that a
    /// difference of integrals loses them: g is linear in x² there to a relative 1e-5.
    pub(super) fn between_near(p: &Place, q: &Place) -> Self {
        let interval = Self::between(p, q);
        let Self { width, rise, .. } = interval;
        if rise * width >= LOST * q.load {
            return interval;
        }
        Self { first: rise * width * (p.x + width / 3.0) / (2.0 * p.x + width), ..interval }
    }

    /// ∫ f dx for f linear in g with the given end values.
    pub(super) fn linear(&self, f0: f64, f1: f64) -> f64 {
        if self.rise > 0.0 {
            f0 * self.width + (f1 - f0) * (self.first / self.rise)
        } else {
            0.5 * (f0 + f1) * self.width
        }
    }

    /// ∫ b s dx of bound and slip, both ≥ 0: in a cell in which nearly all the rise is at one end,
    /// rounding may deny it.
    #[inline(always)]
    pub(super) fn slip_work(&self, bound: (f64, f64), slip: (f64, f64)) -> f64 {
        at_least(self.product(bound, slip), 0.0)
    }

    /// ∫ f dx for a parabola in g with the given values at the inner end, in the middle and at the
    /// outer end.
    pub(super) fn parabola(&self, [inner, middle, outer]: [f64; 3]) -> f64 {
        let slope = 4.0 * middle - 3.0 * inner - outer;
        let curvature = 2.0 * (inner + outer) - 4.0 * middle;
        let (first, second) = if self.rise > 0.0 {
            (self.first / self.rise, self.second / (self.rise * self.rise))
        } else {
            (0.5 * self.width, self.width / 3.0)
        };
        inner * self.width + slope * first + curvature * second
    }

    /// ∫ f h dx for two such functions.
    pub(super) fn product(&self, f: (f64, f64), h: (f64, f64)) -> f64 {
        if self.rise > 0.0 {
            // not by the reciprocal: on a punch worn flat, where the rise is rounding, it split one
            // line of the snapshot test into 15,000 profile updates
            let (df, dh) = ((f.1 - f.0) / self.rise, (h.1 - h.0) / self.rise);
            // the product of both slopes alone may be beyond all numbers
            f.0 * h.0 * self.width + (f.0 * dh + df * h.0) * self.first + df * (dh * self.second)
        } else {
            self.width * (2.0 * f.0 * h.0 + 2.0 * f.1 * h.1 + f.0 * h.1 + f.1 * h.0) / 6.0
        }
    }
}

/// ∫(g − g₁)² dx within its bounds, where rounding has taken it out of them. Rarely needed.
#[cold]
fn rounded(width: f64, rise: f64, first: f64, second: f64) -> f64 {
    let least = first * first / at_least(width, f64::MIN_POSITIVE);
    at_most(at_least(second, least), rise * first)
}

/// `value`, but not below `bound`: `f64::max` without its care for a bound that is no number, which
/// costs as much again.
#[inline]
pub(super) fn at_least(value: f64, bound: f64) -> f64 {
    if value < bound { bound } else { value }
}

/// `value`, but not above `bound`.
#[inline]
fn at_most(value: f64, bound: f64) -> f64 {
    if value > bound { bound } else { value }
}
