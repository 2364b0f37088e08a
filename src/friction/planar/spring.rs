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
//! closed at constant b, and for u along **t** at any. Where b changes and u turns at once, they
//! differ from those at the mean bound by the first two moments of 1 − cos θ about the middle of
//! the line. They are integrated by Boole's rule: at quarters of the line tan(θ/2) has fallen by
//! square roots. In parts over which ∫ds/b is at most 1 it is good to 3e-6 of b where b changes by
//! 5 %.

mod anisotropic;

use nalgebra::Vector2;

/// Length of a vector; [`f64::hypot`], which takes three times as long, where squares would not be
/// numbers.
#[inline]
pub(crate) fn norm(a: Vector2<f64>) -> f64 {
    if a.y == 0.0 {
        return a.x.abs();
    }
    let square = a.dot(&a);
    if (1e-280..1e280).contains(&square) { square.sqrt() } else { a.x.hypot(a.y) }
}

/// The vector of a given length (m) along `a`; along x where that has no direction.
pub(crate) fn along(a: Vector2<f64>, length: f64) -> Vector2<f64> {
    // the smallest numbers have lost the digits of a direction
    let a = if norm(a) < 1e-290 { a * 1e300 } else { a };
    let size = norm(a);
    // divided twice: the ratio of the lengths may be beyond all numbers
    if size > 0.0 { a / size * length } else { Vector2::new(length, 0.0) }
}

/// A spring at the end of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moved {
    /// Its deflection u, m.
    pub(super) deflection: Vector2<f64>,
    /// Length of the path by which it slipped, m.
    pub(super) slip: f64,
    /// Mean of its bound while it slipped, m: their product is the work of friction over its
    /// stiffness.
    pub(super) mean_bound: f64,
}

/// A straight line of the body. Lengths are in a unit in which none of the row's is far above 1
/// ([`unit`]), so that their squares are numbers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    motion: Vector2<f64>,
    /// Length and direction of the motion.
    path: f64,
    ahead: Vector2<f64>,
    stiffness_ratio: f64,
    /// A spring whose excess over its bound is within this sticks.
    rounding: f64,
}

/// A power of two of the size of a length, m: dividing by it rounds nothing.
pub(super) fn unit(length: f64) -> f64 {
    f64::from_bits(length.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}

impl Line {
    /// Where the `stiffness_ratio` is not 1, lengths along y are multiplied by it, except for the
    /// slip ([`anisotropic`]).
    pub(super) fn new(motion: Vector2<f64>, stiffness_ratio: f64, rounding: f64) -> Self {
        Self { motion, path: norm(motion), ahead: along(motion, 1.0), stiffness_ratio, rounding }
    }

    /// A part of the line.
    pub(super) fn part(&self, share: f64) -> Self {
        Self { motion: self.motion * share, path: self.path * share, ..*self }
    }

    /// Deflection at the end of a spring that sticks.
    pub(super) fn trial(&self, start: Vector2<f64>) -> Vector2<f64> {
        start + self.motion
    }

    /// A spring whose deflection would be `trial` at the end, while its bound goes evenly between
    /// the two given; `None` where it sticks.
    #[inline(always)]
    pub(super) fn slip(&self, trial: Vector2<f64>, (first, last): (f64, f64)) -> Option<Moved> {
        let limit = last + self.rounding;
        // written so that it also takes what is no number, and squares lost to underflow
        if trial.dot(&trial) < limit * limit { None } else { Some(self.slide(trial, (first, last))) }
    }

    #[inline(never)]
    fn slide(&self, trial: Vector2<f64>, (first, last): (f64, f64)) -> Moved {
        let (start, ahead) = (trial - self.motion, self.ahead);
        let (near, aside) = (start.dot(&ahead), ahead.perp(&start));
        let square = near * near + aside * aside;
        // what is no number has to show in the work
        if !square.is_finite() {
            return Moved { deflection: trial, slip: f64::NAN, mean_bound: last };
        }
        let share = self.onset((near, square), (first, last));
        let onset = first + share * (last - first);
        if self.stiffness_ratio != 1.0 {
            let at_onset = along(start + self.motion * share, onset);
            let rest = self.motion * (1.0 - share);
            return anisotropic::slide(at_onset, rest, (onset, last), self.stiffness_ratio);
        }
        let mut turning = Turning::new((near + share * self.path, aside), onset);
        turning.follow((1.0 - share) * self.path, (onset, last));
        let (slip, mean_bound) = turning.slipped((onset, last));
        Moved { deflection: turning.direction(ahead) * last, slip, mean_bound }
    }

    /// Share of the line after which the spring slips: the root of |u + t ΔU|² = (b₀ + t Δb)² at
    /// which the bound is left, of a spring deflected by `near` along the line.
    fn onset(&self, (near, square): (f64, f64), (first, last): (f64, f64)) -> f64 {
        let change = last - first;
        let leading = self.path * self.path - change * change;
        let half = near * self.path - first * change;
        // at its bound it may be beyond by a rounding
        let constant = (square - first * first).min(0.0);
        let root = (half * half - leading * constant).max(0.0).sqrt();
        let share = if half > 0.0 { -constant / (half + root) } else { (root - half) / leading };
        // within the rounding of the bound nothing is left of the line
        if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
    }
}

/// Turn ∫ds/b of one part of a line along which the bound changes.
const MOST_TURN: f64 = 1.0;

/// A spring that slips, at an angle θ to the motion.
struct Turning {
    /// cos² and sin² of θ/2.
    inner: f64,
    outer: f64,
    /// Sine of θ.
    sine: f64,
    /// ∫λ ds and ∫bλ ds.
    slip: f64,
    work: f64,
}

impl Turning {
    /// From a deflection along and across the motion, at a bound.
    fn new((along, across): (f64, f64), bound: f64) -> Self {
        let size = (along * along + across * across).sqrt();
        // neither as a difference
        let larger = size + along.abs();
        let scale = 0.5 / (size * larger);
        if bound == 0.0 || !scale.is_finite() {
            // of no direction
            return Self { inner: 1.0, outer: 0.0, sine: 0.0, slip: 0.0, work: 0.0 };
        }
        let (large, small) = (larger * larger * scale, across * across * scale);
        let (inner, outer) = if along < 0.0 { (small, large) } else { (large, small) };
        Self { inner, outer, sine: 2.0 * across * larger * scale, slip: 0.0, work: 0.0 }
    }

    /// Follows a path in parts, while the bound goes evenly between the two given.
    fn follow(&mut self, mut path: f64, (mut first, last): (f64, f64)) {
        let slope = (last - first) / path;
        // pushed straight back it does not turn
        while path > MOST_TURN * first && slope != 0.0 && self.outer > f64::EPSILON && self.outer < 1.0 {
            let (part, bound) = (MOST_TURN * first, first + MOST_TURN * first * slope);
            self.turn(part, (first, bound));
            (path, first) = (path - part, bound);
        }
        self.turn(path, (first, last));
    }

    /// Follows one part.
    fn turn(&mut self, path: f64, (first, last): (f64, f64)) {
        let turn = if path > 0.0 { path * mean_reciprocal(first, last) } else { 0.0 };
        let (change, mean) = (last - first, 0.5 * (first + last));
        let fall = (-turn).exp();
        let square = fall * fall;
        let left = self.outer * square;
        // pushed straight back, but for rounding
        if self.inner <= f64::EPSILON * f64::EPSILON * left || self.inner == 0.0 {
            self.slip -= path + change;
            self.work -= mean * (path + change);
            return;
        }
        let total = self.inner + left;
        let lag = -total.ln();
        let (mut behind, mut moment) = (mean * lag, 0.0);
        if change != 0.0 {
            // 1 − cos θ at quarters of the path, and its moments about the middle by Boole's rule
            let rise = change / mean;
            let root = fall.sqrt() * (1.0 - 3.0 / 16.0 * turn.min(MOST_TURN) * rise);
            let [start, quarter, last_quarter, end] = [1.0, root, root * fall, square].map(|square| {
                let left = self.outer * square;
                2.0 * left / (self.inner + left)
            });
            let even = (7.0 * (start + end) + 8.0 * (quarter + last_quarter)) / 360.0;
            moment = (7.0 * (end - start) + 16.0 * (last_quarter - quarter)) / 180.0;
            let (a, b) = (lag * first, lag * last);
            behind = (behind + path * rise * (moment - rise * even)).max(a.min(b)).min(a.max(b));
        }
        let slip = path - behind.min(2.0 * path) - change;
        self.slip += slip;
        self.work += mean * slip - change * path * moment;
        (self.sine, self.inner, self.outer) = (self.sine * fall / total, self.inner / total, left / total);
    }

    /// The unit vector at the angle from the motion's direction.
    fn direction(&self, ahead: Vector2<f64>) -> Vector2<f64> {
        let cosine = self.inner - self.outer;
        cosine * ahead + self.sine * Vector2::new(-ahead.y, ahead.x)
    }

    /// Length of the path by which it has slipped, and the mean of its bound over that.
    fn slipped(&self, (first, last): (f64, f64)) -> (f64, f64) {
        let mean = self.work / self.slip;
        // the mean over a slip of 0 is not a number
        let mean = if mean.is_nan() { last } else { mean.clamp(first.min(last), first.max(last)) };
        (if self.slip < 0.0 { 0.0 } else { self.slip }, mean)
    }
}

/// ln(b/a)/(b − a), the mean of 1/b over a path; infinite where one of them is 0.
fn mean_reciprocal(a: f64, b: f64) -> f64 {
    let reciprocal = 1.0 / (a + b);
    if a <= 0.0 || b <= 0.0 || reciprocal == f64::INFINITY {
        return f64::INFINITY;
    }
    let rise = (b - a) * reciprocal;
    let z = rise * rise;
    // ln(b/a) = 2 artanh of the rise, whose series is exact to rounding here
    if z < 1e-3 {
        2.0 * reciprocal * (1.0 + z * (1.0 / 3.0 + z * (1.0 / 5.0 + z * (1.0 / 7.0 + z / 9.0))))
    } else {
        (b / a).ln() / (b - a)
    }
}

#[cfg(test)]
mod tests;
