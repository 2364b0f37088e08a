//! Image of a flat tip with a rounded edge, f = (r − b)²/(2R) for r > b.
//!
//! With cos α = b/x: g = (b x/R)(tan α − α), g' = (b/R)(2 tan α − α), φ = (b³/R)[⅔ tan³α + ½(tan α
//! − α) − ½ α tan²α]. The brackets cancel to third order in α, so small angles take their series.

use crate::quadrature;

/// Below this angle the series is at least as accurate as the closed form (both about 1e-12).
const SMALL: f64 = 0.03;

/// α = acos(b/x), without loss of digits near x = b.
fn angle(x: f64, b: f64) -> f64 {
    super::leg(x, b).atan2(b)
}

/// tan α − α.
fn excess(alpha: f64) -> f64 {
    if alpha < SMALL {
        let s = alpha * alpha;
        alpha * s * (1.0 / 3.0 + s * (2.0 / 15.0 + s * (17.0 / 315.0 + s * 62.0 / 2835.0)))
    } else {
        alpha.tan() - alpha
    }
}

/// b (tan α − α), from the leg ℓ = b tan α, which far outside the tip tan α would lose the digits
/// of.
fn lost(leg: f64, alpha: f64, b: f64) -> f64 {
    if alpha < SMALL { b * excess(alpha) } else { leg - b * alpha }
}

pub(super) fn image(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b { 0.0 } else { x / radius * lost(super::leg(x, b), angle(x, b), b) }
}

pub(super) fn image_slope(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    let leg = super::leg(x, b);
    (leg + lost(leg, angle(x, b), b)) / radius
}

pub(super) fn load_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    let (leg, alpha) = (super::leg(x, b), angle(x, b));
    if alpha < SMALL {
        let s = alpha * alpha;
        // coefficients of the Taylor series of the bracket, from those of tan α
        let bracket = alpha * s * (1.0 / 3.0 + s * (2.0 / 5.0 + s * (103.0 / 315.0 + s * 632.0 / 2835.0)));
        return b * b * b / radius * bracket;
    }
    (leg * leg * (2.0 / 3.0 * leg - b * alpha / 2.0) + b * b * lost(leg, alpha, b) / 2.0) / radius
}

/// Leg in units of b up to which the angle is a good variable; beyond, it runs into the pole of its
/// tangent.
const STEEP: f64 = 4.0;

/// e⁻⁵ of this is beyond the digits of a double.
const NEGLIGIBLE: f64 = 8.0;

pub(super) fn square_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    let leg = super::leg(x, b);
    // dx = b tan α/cos α dα; the integrand is smooth in α
    let inner = quadrature::composite(0.0, leg.min(STEEP * b).atan2(b), |alpha| {
        let g = b * b / (radius * alpha.cos()) * excess(alpha);
        g * g * b * alpha.tan() / alpha.cos()
    });
    if leg <= STEEP * b {
        return inner;
    }
    // further out in the logarithm of the leg, in which it grows like the fifth power
    let depth = (leg / (STEEP * b)).ln().min(NEGLIGIBLE);
    let outer = quadrature::composite(0.0, depth, |q| {
        let v = leg * (-q).exp();
        let g = v.hypot(b) / radius * (v - b * v.atan2(b));
        // dx = v/x dv
        g * g * v * v / v.hypot(b)
    });
    inner + outer
}
