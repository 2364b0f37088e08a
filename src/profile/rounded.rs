//! Image of a flat tip with a rounded edge, f = (r − b)²/(2R) for r > b.
//!
//! With cos α = b/x: g = (b x/R)(tan α − α), g' = (b/R)(2 tan α − α), φ = (b³/R)[⅔ tan³α + ½(tan α
//! − α) − ½ α tan²α]. The brackets cancel to third order in α, so small angles take their series.

use crate::quadrature;
use crate::roots;
use std::array;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

/// Below this angle the series is at least as accurate as the closed form (both about 1e-12).
const SMALL: f64 = 0.03;

/// Leg b tan α and α, without loss of digits near x = b.
fn leg_and_angle(x: f64, b: f64) -> (f64, f64) {
    let leg = super::leg(x, b);
    (leg, leg.atan2(b))
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
    if x <= b { 0.0 } else { image_at(x, leg_and_angle(x, b), (radius, b)) }
}

fn image_at(x: f64, (leg, alpha): (f64, f64), (radius, b): (f64, f64)) -> f64 {
    x / radius * lost(leg, alpha, b)
}

pub(super) fn image_slope(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b { 0.0 } else { slope_at(leg_and_angle(x, b), (radius, b)) }
}

fn slope_at((leg, alpha): (f64, f64), (radius, b): (f64, f64)) -> f64 {
    (leg + lost(leg, alpha, b)) / radius
}

pub(super) fn load_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b { 0.0 } else { load_at(leg_and_angle(x, b), (radius, b)) }
}

fn load_at((leg, alpha): (f64, f64), (radius, b): (f64, f64)) -> f64 {
    if alpha < SMALL {
        let s = alpha * alpha;
        // coefficients of the Taylor series of the bracket, from those of tan α
        let bracket = alpha * s * (1.0 / 3.0 + s * (2.0 / 5.0 + s * (103.0 / 315.0 + s * 632.0 / 2835.0)));
        return b * b * b / radius * bracket;
    }
    (leg * leg * (2.0 / 3.0 * leg - b * alpha / 2.0) + b * b * lost(leg, alpha, b) / 2.0) / radius
}

/// Radius at which the image is `depth`. With t = tan α, γ = g R/b² = √(1 + t²)(t − α) lies between
/// t³/(3 + t) and the smaller of t³/3 and t². So t lies between t₀ = max((3γ)^⅓, √γ) and 1.325 t₀.
pub(super) fn radius_at_depth(depth: f64, radius: f64, b: f64) -> f64 {
    let scaled = depth * radius / b / b;
    let least = b * (3.0 * scaled).cbrt().max(scaled.sqrt());
    radius_of(b, (least, 1.325 * least), |x, at| {
        (image_at(x, at, (radius, b)) - depth, slope_at(at, (radius, b)) * at.0 / x)
    })
}

/// Radius at which the load integral is `load`: the cube of the leg is 3/2 to 3 times R φ.
pub(super) fn radius_at_load(load: f64, radius: f64, b: f64) -> f64 {
    let least = (1.5 * radius * load).cbrt();
    radius_of(b, (least, 1.26 * least), |_, at| {
        (load_at(at, (radius, b)) - load, slope_at(at, (radius, b)) * at.0)
    })
}

/// Radius at a root of a function of x and of leg and α, between two legs. It returns its
/// derivative by the leg, too.
fn radius_of(b: f64, (low, high): (f64, f64), f: impl Fn(f64, (f64, f64)) -> (f64, f64)) -> f64 {
    let radius = |leg: f64| (leg * leg + b * b).sqrt();
    radius(roots::of_rising(low, high, |leg| f(radius(leg), (leg, leg.atan2(b)))))
}

/// [`image`], [`load_integral`] and [`square_integral`].
pub(super) fn image_and_integrals(x: f64, radius: f64, b: f64) -> (f64, f64, f64) {
    if x <= b {
        return (0.0, 0.0, 0.0);
    }
    let at = leg_and_angle(x, b);
    (image_at(x, at, (radius, b)), load_at(at, (radius, b)), square_at(x, at.1, radius))
}

pub(super) fn square_integral(x: f64, radius: f64, b: f64) -> f64 {
    if x <= b { 0.0 } else { square_at(x, leg_and_angle(x, b).1, radius) }
}

/// Q = x⁵ α⁸/R² K(α²), where K falls from 1/72 at the rim to (2/π)⁸/5 far outside.
fn square_at(x: f64, alpha: f64, radius: f64) -> f64 {
    let fourth = alpha.powi(4) * x / radius * x;
    fourth * fourth * x * square_factor(alpha * alpha)
}

/// Terms of the Chebyshev series of K: the last one is rounding.
const TERMS: usize = 20;

/// Coefficients of the series, from quadrature at first use. Its variable is s = 1 − 2p with
/// p = √(1 − (2α/π)²): far outside, K has the logarithm of p times p¹⁰, which would take 48 terms
/// in α² itself.
static SQUARE_FACTOR: LazyLock<[f64; TERMS]> = LazyLock::new(|| {
    let angle = |j: usize| PI * (j as f64 + 0.5) / TERMS as f64;
    let values: [f64; TERMS] = array::from_fn(|j| {
        let p = (0.5 * angle(j)).sin().powi(2);
        let alpha = FRAC_PI_2 * ((1.0 - p) * (1.0 + p)).sqrt();
        square_by_quadrature(alpha.tan()) * alpha.cos().powi(5) / alpha.powi(8)
    });
    array::from_fn(|k| {
        let term = |(j, value): (usize, &f64)| value * (k as f64 * angle(j)).cos();
        let sum: f64 = values.iter().enumerate().map(term).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / TERMS as f64
    })
});

/// K(α²), by Clenshaw's recurrence.
fn square_factor(alpha_squared: f64) -> f64 {
    let p = (1.0 - alpha_squared / (FRAC_PI_2 * FRAC_PI_2)).max(0.0).sqrt();
    let s = 1.0 - 2.0 * p;
    let (mut next, mut after) = (0.0, 0.0);
    for coefficient in SQUARE_FACTOR[1..].iter().rev() {
        (next, after) = (coefficient + 2.0 * s * next - after, next);
    }
    SQUARE_FACTOR[0] + s * next - after
}

/// Leg in units of b up to which the angle is a good variable; beyond, it runs into the pole of its
/// tangent.
const STEEP: f64 = 4.0;

/// e⁻⁵ of this is beyond the digits of a double.
const NEGLIGIBLE: f64 = 8.0;

/// Q R²/b⁵ at a leg in units of b.
fn square_by_quadrature(leg: f64) -> f64 {
    // dx = b tan α/cos α dα; the integrand is smooth in α
    let inner = quadrature::composite(0.0, leg.min(STEEP).atan(), |alpha| {
        let g = excess(alpha) / alpha.cos();
        g * g * alpha.tan() / alpha.cos()
    });
    if leg <= STEEP {
        return inner;
    }
    // further out in the logarithm of the leg, in which it grows like the fifth power
    let depth = (leg / STEEP).ln().min(NEGLIGIBLE);
    let outer = quadrature::composite(0.0, depth, |q| {
        let v = leg * (-q).exp();
        let g = v.hypot(1.0) * (v - v.atan());
        // dx = v/x dv
        g * g * v * v / v.hypot(1.0)
    });
    inner + outer
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To the digits of the quadrature: tan α − α has lost three of them above `SMALL`.
    #[test]
    fn the_square_integral_is_that_of_quadrature_at_all_radii() {
        let worst = (1..400)
            .map(|k| {
                let leg = 10f64.powf(-3.0 + f64::from(k) / 50.0);
                let (x, alpha) = (leg.hypot(1.0), leg.atan());
                (square_at(x, alpha, 1.0) / square_by_quadrature(leg) - 1.0).abs()
            })
            .fold(0.0, f64::max);
        assert!(worst < 2e-13, "{worst:e}");
        assert!((72.0 * square_factor(0.0) - 1.0).abs() < 1e-12);
        let far = 5.0 * FRAC_PI_2.powi(8) * square_factor(FRAC_PI_2 * FRAC_PI_2);
        assert!((far - 1.0).abs() < 1e-12, "{far}");
    }

    /// From 1e-12 of the radius of the flat to 1e12 of it.
    #[test]
    fn radii_are_found_where_image_and_load_are_given() {
        let (radius, b) = (0.01, 1e-4);
        for k in -12..=12 {
            let leg = b * 10f64.powi(k);
            let x = leg.hypot(b);
            let at = (leg, leg.atan2(b));
            let found = radius_at_depth(image_at(x, at, (radius, b)), radius, b);
            assert!((found / x - 1.0).abs() < 1e-15, "{k}: {found:e} {x:e}");
            let found = radius_at_load(load_at(at, (radius, b)), radius, b);
            assert!((found / x - 1.0).abs() < 1e-15, "{k}: {found:e} {x:e}");
        }
    }
}
