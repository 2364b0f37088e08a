//! Slip of a spring that is stiffer along one axis than along the other, as under an elliptic
//! contact.
//!
//! With ρ = G*_y/G*_x and K = diag(1, ρ), the spring carries **v** = K (**U** − **e**) per unit of
//! G*_x, is bounded by |**v**| ≤ b and slips along **v** (Coulomb): ė = λ **v**/b. On a straight
//! line of path s at the angle φ to the x axis, with θ the angle of **v** and ψ = θ − φ,
//!
//! b f(θ) dθ/ds = −sin ψ − B sin 2θ db/ds, f = sin²θ + cos²θ/ρ = A + B cos 2θ,
//! λ = cos ψ − (f(θ + π/2) db + B sin 2θ b dθ)/ds, A, B = (1/ρ ± 1)/2.
//!
//! At constant b this is closed: with C = A + B cos 2φ and z = ln tan(ψ/2), the function
//! C z + 2B (cos 2φ cos ψ − sin 2φ sin ψ) falls by s/b, and its slope in z is f, which is between 1
//! and 1/ρ. Without motion it is closed, too: **v** falls by exp(−K l) until |**v**| = b. Where b
//! changes along a line, motion and change of b follow each other (symmetric operator splitting, of
//! second order).

use super::{Moved, along, mean_reciprocal, norm};
use nalgebra::{Rotation2, Vector2};

/// Stages per relative change of b, for a path of the length b: 1.6 % in one stage. The slip is
/// good to 1e-4 of b.
const STAGES: f64 = 64.0;

/// Most stages of one line.
const MOST_STAGES: f64 = 16.0;

/// Most iterations of Newton's method; 3 to 6 are usual.
const MOST_ITERATIONS: u32 = 30;

/// A spring that slips from its bound on, by its `motion` K Δ**U**, while the bound goes evenly
/// between the two given.
pub(super) fn slide(
    start: Vector2<f64>,
    motion: Vector2<f64>,
    (first, last): (f64, f64),
    ratio: f64,
) -> Moved {
    let line = Line::new(motion, ratio);
    let largest = first.max(last);
    let change = (last - first) / largest;
    if first == 0.0 {
        return line.under_growing_bound(last);
    }
    let mut spring = Spring { force: start, slip: 0.0, work: 0.0 };
    if change == 0.0 || change.is_nan() {
        spring.turn(&line, line.path, last, 1.0 / last);
    } else {
        let stages = (STAGES * change.abs() * (1.0 + line.path / largest)).ceil().clamp(1.0, MOST_STAGES);
        let at = |k: f64| first + (last - first) * k / stages;
        let path = line.path / stages;
        let mut share = 1.0;
        for k in 0..stages as u32 {
            let k = f64::from(k);
            let middle = at(k + 0.5);
            share = turning_share(path / (middle * line.slope));
            // the second half of the stage before and the first of this one
            spring.follow_bound(middle, ratio, share);
            spring.turn(&line, path, middle, mean_reciprocal(at(k), at(k + 1.0)));
        }
        spring.follow_bound(last, ratio, share);
    }
    let slip = spring.slip.max(0.0);
    let mean = spring.work / slip;
    let mean_bound = if mean.is_nan() { 0.5 * (first + last) } else { mean.clamp(first.min(last), largest) };
    Moved { deflection: along(spring.force, last), slip, mean_bound }
}

/// Share of the turn by a changing bound, half before and half after the motion by t = s/(b f):
/// with tanh(t/2)/(t/2) the end is right also where the motion turns the spring at once.
fn turning_share(t: f64) -> f64 {
    if t > 1e-4 { (0.5 * t).tanh() / (0.5 * t) } else { 1.0 }
}

/// **v**·K⁻¹**v**, twice the elastic energy over G*_x.
fn stored(force: Vector2<f64>, ratio: f64) -> f64 {
    force.x * force.x + force.y * force.y / ratio
}

/// A straight line of the body.
struct Line {
    ratio: f64,
    /// Its way Δ**U**, m, and the length s of that.
    way: Vector2<f64>,
    path: f64,
    /// Its direction.
    ahead: Vector2<f64>,
    /// B.
    anisotropy: f64,
    /// cos 2φ and sin 2φ.
    double: Vector2<f64>,
    /// C.
    slope: f64,
}

impl Line {
    fn new(motion: Vector2<f64>, ratio: f64) -> Self {
        let way = Vector2::new(motion.x, motion.y / ratio);
        let ahead = along(way, 1.0);
        let [cosine, sine] = ahead.into();
        let double = Vector2::new((cosine - sine) * (cosine + sine), 2.0 * cosine * sine);
        let slope = sine * sine + cosine * cosine / ratio;
        Self { ratio, way, path: norm(way), ahead, anisotropy: 0.5 * (1.0 / ratio - 1.0), double, slope }
    }

    /// A spring whose bound grows from 0, like s: θ and λ are constant.
    fn under_growing_bound(&self, last: f64) -> Moved {
        let force = along(self.steady_direction(last), last);
        // what the drive brings is stored or taken by friction
        let driven = 0.5 * force.dot(&self.way);
        let work = (driven - 0.5 * stored(force, self.ratio)).max(0.0);
        let slip = if last > 0.0 { 2.0 * work / last } else { self.path };
        Moved { deflection: force, slip, mean_bound: 0.5 * last }
    }

    /// Direction of **v** on a line along which the bound grows from 0: sin ψ = −B sin 2θ db/ds.
    fn steady_direction(&self, bound: f64) -> Vector2<f64> {
        let rise = self.anisotropy * bound / self.path;
        let mut angle = 0.0;
        if !rise.is_finite() {
            return self.ahead;
        }
        for _ in 0..MOST_ITERATIONS {
            let n = self.turned(angle);
            let next = (-rise * 2.0 * n.x * n.y).clamp(-1.0, 1.0).asin();
            if (next - angle).abs() <= f64::EPSILON {
                break;
            }
            angle = next;
        }
        self.turned(angle)
    }

    /// The unit vector at the angle ψ from the line.
    fn turned(&self, angle: f64) -> Vector2<f64> {
        Rotation2::new(angle) * self.ahead
    }

    /// z after the function of the line has fallen by `turn` = s/b, on the side of the sine of ψ.
    fn turned_to(&self, start: f64, turn: f64, side: f64) -> f64 {
        let [cosine, sine] = (2.0 * self.anisotropy * self.double).into();
        let sine = side * sine;
        let value = |z: f64| self.slope * z - cosine * z.tanh() - sine / z.cosh();
        let wanted = value(start) - turn;
        let mut z = start - turn / self.slope;
        for _ in 0..MOST_ITERATIONS {
            let (tangent, secant) = (z.tanh(), 1.0 / z.cosh());
            let slope = self.slope - cosine * secant * secant + sine * secant * tangent;
            let step = (value(z) - wanted) / slope;
            z -= step;
            if step.abs() <= 4.0 * f64::EPSILON * (1.0 + z.abs()) {
                break;
            }
        }
        z
    }

    /// ∫ tan(ψ/2) f dψ from 0, with cos ψ = −tanh z.
    fn lost_path(&self, z: f64, side: f64) -> f64 {
        let tangent = z.exp();
        let half = 1.0 + tangent * tangent;
        let (less, sine) = (2.0 * tangent * tangent / half, side * 2.0 * tangent / half);
        let angle = side * 2.0 * tangent.atan();
        let [cosine_double, sine_double] = self.double.into();
        // 2 sin ψ − ψ − sin ψ cos ψ = (sin ψ − ψ) + sin ψ (1 − cos ψ)
        self.slope * (tangent * tangent).ln_1p()
            - self.anisotropy * (cosine_double * less * less + sine_double * (sine - angle + sine * less))
    }
}

/// A spring on its way.
struct Spring {
    /// **v**, m, at the bound.
    force: Vector2<f64>,
    /// ∫λ ds, m.
    slip: f64,
    /// ∫b λ ds, m².
    work: f64,
}

impl Spring {
    /// Follows part of a line at a constant bound; it turns by the path times `reciprocal`.
    fn turn(&mut self, line: &Line, path: f64, bound: f64, reciprocal: f64) {
        let before = along(self.force, 1.0);
        let (cosine, sine) = (before.dot(&line.ahead), line.ahead.perp(&before));
        let side = 1f64.copysign(sine);
        // tan(ψ/2), not as a difference
        let tangent = if cosine < 0.0 { (1.0 - cosine) / sine.abs() } else { sine.abs() / (1.0 + cosine) };
        let start = tangent.ln();
        let turn = if path > 0.0 { path * reciprocal } else { 0.0 };
        let end = match start.is_finite() {
            false => start,
            true if turn.is_finite() => line.turned_to(start, turn, side),
            true => f64::NEG_INFINITY,
        };
        let mut turned = before;
        let slip = if start.is_finite() {
            turned = line.turned(side * 2.0 * end.exp().atan());
            let sine_of_change = before.perp(&turned);
            let sine_of_sum = before.x * turned.y + before.y * turned.x;
            let lost = line.lost_path(start, side) - line.lost_path(end, side);
            path - bound * (lost + line.anisotropy * sine_of_sum * sine_of_change)
        } else {
            // along the line, or pushed straight back
            path.copysign(cosine)
        };
        self.force = along(turned, bound);
        self.slip += slip;
        self.work += bound * slip;
    }

    /// Follows a bound that changes without motion: **v** falls by exp(−K l), or grows where the
    /// bound does. It turns by a share of that.
    fn follow_bound(&mut self, bound: f64, ratio: f64, share: f64) {
        let before = norm(self.force);
        let level = (before / bound).ln();
        if !level.is_finite() {
            // to or from 0: by its own length
            self.slip += before - bound;
            self.work += 0.5 * (before - bound) * (before + bound);
            self.force = along(self.force, bound);
            return;
        }
        let start = along(self.force, 1.0);
        let (a, b) = (start.x * start.x, start.y * start.y);
        let mut l = level / (a + ratio * b);
        for _ in 0..MOST_ITERATIONS {
            let (p, q) = (a * (-2.0 * l).exp(), b * (-2.0 * ratio * l).exp());
            // ½ ln of the square, whose slope is between 1 and ρ
            let step = (0.5 * (p + q).ln() + level) / ((p + ratio * q) / (p + q));
            l += step;
            if step.abs() <= 4.0 * f64::EPSILON * (1.0 + l.abs()) {
                break;
            }
        }
        let end = along(Vector2::new(start.x * (-l).exp(), start.y * (-ratio * l).exp()), 1.0);
        let turn = share * start.perp(&end).atan2(start.dot(&end));
        let after = along(Rotation2::new(turn) * start, bound);
        let work = 0.5 * (stored(self.force, ratio) - stored(after, ratio));
        self.work += work;
        // b falls nearly like exp(−l): the mean over the slip is that of both ends
        self.slip += work / (0.5 * (before + bound));
        self.force = after;
    }
}

#[cfg(test)]
mod tests;
