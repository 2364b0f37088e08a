//! One spring along one straight line of the body, in closed form.
//!
//! The spring is deflected by a vector u = U − e and slips where |u| would exceed its bound b,
//! along u itself: ė = λ u/b. On a straight line of path s in the direction **t**, b linear in s,
//! it sticks at first, and slips from the root of a quadratic on: |u + s **t**| − b is convex in s,
//! so that it is crossed once. From there on, with the angle θ from **t** to u,
//!
//! dθ/ds = −sin θ/b, so tan(θ/2) falls by the factor exp(−∫ds/b), and λ = cos θ − db/ds,
//!
//! which only rises: a spring that slips goes on slipping to the end of the line (db/ds only falls
//! along a line of force, too, see [`super`]). With y = ln cos²(θ₀/2)/cos²(θ/2), for which dy =
//! (cos θ − 1) ds/b, the advance and the work of the drive are
//!
//! ∫cos θ ds = s + ∫b dy, ∫b cos θ ds = ∫b ds + ∫b² dy,
//!
//! closed at constant b, and for u along **t** at any. Where b changes and u turns at once, b is a
//! power of (e^y − cos²(θ₀/2)), which ends like a logarithm: by Gauss's rule in ∛y from there it is
//! good to 2e-5 of b where b changes by 5 %.

mod anisotropic;

use crate::quadrature::GAUSS_5;

/// A vector in the plane of the contact, m.
pub(crate) type Vector = [f64; 2];

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Length of a vector; [`f64::hypot`], which takes three times as long, where squares would not be
/// numbers.
pub(crate) fn norm(a: Vector) -> f64 {
    let square = dot(a, a);
    if (1e-280..1e280).contains(&square) { square.sqrt() } else { a[0].hypot(a[1]) }
}

pub(crate) fn scaled(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor]
}

pub(crate) fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// The vector of a given length (m) along `a`; along x where that has no direction.
pub(crate) fn along(a: Vector, length: f64) -> Vector {
    // the smallest numbers have lost the digits of a direction
    let a = if norm(a) < 1e-290 { scaled(a, 1e300) } else { a };
    let size = norm(a);
    // divided twice: the ratio of the lengths may be beyond all numbers
    if size > 0.0 { [a[0] / size * length, a[1] / size * length] } else { [length, 0.0] }
}

/// A spring at the end of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moved {
    /// Its deflection u, m.
    pub(super) deflection: Vector,
    /// Length of the path by which it slipped, m.
    pub(super) slip: f64,
    /// Mean of its bound while it slipped, m: their product is the work of friction over its
    /// stiffness.
    pub(super) mean_bound: f64,
}

/// A spring deflected by `start` whose body moves by `motion` while its bound goes evenly between
/// the two given. A spring whose excess is within the `rounding` sticks. Where the
/// `stiffness_ratio` is not 1, lengths along y are multiplied by it, except for the slip
/// ([`anisotropic`]).
pub(super) fn move_spring(
    start: Vector,
    motion: Vector,
    (first_bound, bound): (f64, f64),
    stiffness_ratio: f64,
    rounding: f64,
) -> Moved {
    let trial = sum(start, motion);
    let size = norm(trial);
    if size <= bound + rounding {
        return Moved { deflection: trial, slip: 0.0, mean_bound: bound };
    }
    // what is no number has to show in the work
    if !size.is_finite() {
        return Moved { deflection: trial, slip: f64::NAN, mean_bound: bound };
    }
    // beyond a bound that has fallen without a line it slips back along this one
    let first_bound = first_bound.max(norm(start));
    let share = onset(start, motion, (first_bound, bound));
    let onset_bound = first_bound + share * (bound - first_bound);
    if stiffness_ratio != 1.0 {
        let at_onset = along(sum(start, scaled(motion, share)), onset_bound);
        return anisotropic::slide(
            at_onset,
            scaled(motion, 1.0 - share),
            (onset_bound, bound),
            stiffness_ratio,
        );
    }
    let path = (1.0 - share) * norm(motion);
    let ahead = along(motion, 1.0);
    let at_onset = along(sum(start, scaled(motion, share)), 1.0);
    let still = onset_bound == 0.0;
    let (cosine, sine) = if still {
        (1.0, 0.0)
    } else {
        (dot(at_onset, ahead), ahead[0] * at_onset[1] - ahead[1] * at_onset[0])
    };
    let turn = Turn::new((cosine, sine), path, logarithmic_mean(onset_bound, bound));
    let (cosine, sine) = turn.direction;
    let deflection =
        [bound * (cosine * ahead[0] - sine * ahead[1]), bound * (cosine * ahead[1] + sine * ahead[0])];
    let mean = 0.5 * (onset_bound + bound);
    let (advance, driven) = turn.advance(path, (onset_bound, bound));
    let slip = advance - (bound - onset_bound);
    let work = driven - mean * (bound - onset_bound);
    // the mean over a slip of 0 is not a number
    let mean_bound = (work / slip).clamp(onset_bound.min(bound), onset_bound.max(bound));
    Moved {
        deflection,
        slip: if slip < 0.0 { 0.0 } else { slip },
        mean_bound: if mean_bound.is_nan() { mean } else { mean_bound },
    }
}

/// Share of the line after which the spring slips: the root of |u + t ΔU|² = (b₀ + t Δb)² at which
/// the bound is left.
fn onset(start: Vector, motion: Vector, (first_bound, bound): (f64, f64)) -> f64 {
    let scale = norm(motion).max(first_bound).max(bound);
    let (start, motion) = ([start[0] / scale, start[1] / scale], [motion[0] / scale, motion[1] / scale]);
    let (first_bound, change) = (first_bound / scale, (bound - first_bound) / scale);
    let size = norm(start);
    let square = dot(motion, motion) - change * change;
    let half = dot(start, motion) - first_bound * change;
    // at its bound it may be beyond by a rounding
    let constant = ((size - first_bound) * (size + first_bound)).min(0.0);
    let root = (half * half - square * constant).max(0.0).sqrt();
    let share = if half > 0.0 { -constant / (half + root) } else { (root - half) / square };
    // within the rounding of the bound nothing is left of the line
    if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
}

/// How a slipping spring turns.
struct Turn {
    /// Cosine and sine of the angle to the motion at the end.
    direction: (f64, f64),
    /// sin²(θ₀/2).
    outer: f64,
    /// y at the end, ≤ 0.
    end: f64,
}

impl Turn {
    /// From a direction over a path, at a bound by its logarithmic mean.
    fn new((cosine, sine): (f64, f64), path: f64, bound: f64) -> Self {
        // cos² and sin² of half the angle, neither as a difference
        let (inner, outer) = if cosine < 0.0 {
            (0.5 * sine * sine / (1.0 - cosine), 0.5 * (1.0 - cosine))
        } else {
            (0.5 * (1.0 + cosine), 0.5 * sine * sine / (1.0 + cosine))
        };
        let turn = path / bound;
        let left = outer * (-2.0 * turn).exp();
        if path == 0.0 {
            return Self { direction: (cosine, sine), outer, end: 0.0 };
        }
        // pushed straight back, but for rounding
        if inner <= f64::EPSILON * f64::EPSILON * left || inner == 0.0 {
            return Self { direction: (cosine, sine), outer, end: f64::NEG_INFINITY };
        }
        let total = inner + left;
        let direction = ((inner - left) / total, sine * (-turn).exp() / total);
        let end = if outer < 0.5 { (outer * (-2.0 * turn).exp_m1()).ln_1p() } else { total.ln() };
        Self { direction, outer, end }
    }

    /// ∫cos θ ds and ∫b cos θ ds.
    fn advance(&self, path: f64, (first, last): (f64, f64)) -> (f64, f64) {
        let mean = 0.5 * (first + last);
        if self.end == f64::NEG_INFINITY {
            return (-path, -mean * path);
        }
        let change = last - first;
        let (mut lost, mut undriven) = (first * self.end, first * first * self.end);
        if change.abs() > 1e-12 * first && path > 0.0 && first > 0.0 && self.end < 0.0 {
            (lost, undriven) = (0.0, 0.0);
            for (node, weight) in GAUSS_5 {
                let v = 0.5 * (1.0 + node);
                let (y, share) = (self.end * (1.0 - v * v * v), 1.5 * weight * v * v * self.end);
                let left = (1.0 + y.exp_m1() / self.outer).max(0.0);
                let bound = (first * left.powf(-0.5 * change / path)).clamp(first.min(last), first.max(last));
                lost += share * bound;
                undriven += share * bound * bound;
            }
        }
        let advance = path + lost;
        // the most that it can lose is to be pushed back all the way
        if advance < -path { (-path, -mean * path) } else { (advance, mean * path + undriven) }
    }
}

/// (b − a)/ln(b/a), the mean bound by which springs turn; 0 where one of them is.
fn logarithmic_mean(a: f64, b: f64) -> f64 {
    if a <= 0.0 || b <= 0.0 {
        return 0.0;
    }
    let rise = (b - a) / a;
    if rise.abs() < 1e-3 {
        a * (1.0 + rise * (0.5 - rise * (1.0 / 12.0 - rise / 24.0)))
    } else {
        (b - a) / (b / a).ln()
    }
}

#[cfg(test)]
mod tests;
