//! Image of a flat tip with a rounded edge, f = (r − b)²/(2R) for r > b.
//!
//! With cos α = b/x: g = (b x/R)(tan α − α), g' = (b/R)(2 tan α − α), φ = (b³/R)[⅔ tan³α + ½(tan α − α) − ½ α tan²α].
//! The brackets cancel to third order in α, so small angles take their series.

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

pub(super) fn image(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b { 0.0 } else { b * x / radius * excess(angle(x, b)) }
}

pub(super) fn image_slope(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    let alpha = angle(x, b);
    b / radius * (alpha.tan() + excess(alpha))
}

pub(super) fn load_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    let alpha = angle(x, b);
    let bracket = if alpha < SMALL {
        let s = alpha * alpha;
        // coefficients of the Taylor series of the bracket, from those of tan α
        alpha * s * (1.0 / 3.0 + s * (2.0 / 5.0 + s * (103.0 / 315.0 + s * 632.0 / 2835.0)))
    } else {
        let t = alpha.tan();
        t * t * (2.0 / 3.0 * t - alpha / 2.0) + excess(alpha) / 2.0
    };
    b * b * b / radius * bracket
}

pub(super) fn square_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b {
        return 0.0;
    }
    // dx = b tan α/cos α dα; the integrand is smooth in α
    quadrature::composite(0.0, angle(x, b), |alpha| {
        let g = b * b / (radius * alpha.cos()) * excess(alpha);
        g * g * b * alpha.tan() / alpha.cos()
    })
}
