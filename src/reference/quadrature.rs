//! Double-exponential (tanh–sinh) quadrature.
//!
//! ∫ f dx over (start, end) with x = mid + (length/2) tanh((π/2) sinh t) and the trapezoidal rule
//! in t (Takahasi and Mori 1974). Integrable singularities at the two ends cost nothing, which is
//! what the Abel integrals of the model need; inside the interval the integrand has to be smooth,
//! so split at kinks.

use std::f64::consts::PI;

/// Where the integrand is wanted. Near an end the two distances keep the digits that `x` alone has
/// lost: write √(x² − start²) as √(from_start · (x + start)).
#[derive(Debug, Clone, Copy)]
pub struct Node {
    /// The abscissa.
    pub x: f64,
    /// x − start, > 0.
    pub from_start: f64,
    /// end − x, > 0.
    pub to_end: f64,
}

/// The trapezoidal sum runs over |t| ≤ 4.5: there the ends are e^(−π sinh 4.5) ≈ 4e-62 interval
/// lengths away.
const REACH: f64 = 4.5;
/// Halvings of the step, from 1, before the sum is believed at all, and at most.
const HALVINGS: std::ops::RangeInclusive<u32> = 3..=8;
/// The sum has converged when a halving changes it by less than this part of ∫ abs(f): the error
/// left then is about the square of the change.
const CONVERGED: f64 = 1e-13;

/// ∫ f dx from `start` to `end` ≥ `start`, to about 1e-14 of ∫ abs(f) where f is analytic inside
/// the interval and no more singular than (distance)^(−2/3) at its ends.
pub fn integrate(start: f64, end: f64, mut integrand: impl FnMut(Node) -> f64) -> f64 {
    let length = end - start;
    if length == 0.0 {
        return 0.0;
    }
    let mut term = |t: f64| {
        let v = PI * t.sinh();
        let from_start = length / (1.0 + (-v).exp());
        let to_end = length / (1.0 + v.exp());
        let x = if t < 0.0 { start + from_start } else { end - to_end };
        integrand(Node { x, from_start, to_end }) * PI * t.cosh() * from_start * (to_end / length)
    };
    let (mut sum, mut magnitude, mut value) = (term(0.0), 0.0, f64::INFINITY);
    let mut step = 1.0;
    let mut add_odd_multiples = |step: f64, stride: f64| {
        let mut t = step;
        while t <= REACH {
            let (right, left) = (term(t), term(-t));
            sum += right + left;
            magnitude += right.abs() + left.abs();
            t += stride;
        }
        (sum * step, magnitude * step)
    };
    add_odd_multiples(step, step);
    for halving in 1..=*HALVINGS.end() {
        step *= 0.5;
        let (refined, scale) = add_odd_multiples(step, 2.0 * step);
        let change = (refined - value).abs();
        value = refined;
        if HALVINGS.contains(&halving) && change <= CONVERGED * scale {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(value: f64, exact: f64) {
        assert!((value - exact).abs() <= 3e-15 * exact.abs().max(1e-3), "{value:e} against {exact:e}");
    }

    #[test]
    fn smooth_and_singular_integrands_reach_rounding() {
        assert_close(integrate(0.0, 1.0, |n| n.x.exp()), std::f64::consts::E - 1.0);
        assert_close(integrate(-1.0, 2.0, |n| n.x.powi(3)), 3.75);
        assert_close(integrate(0.0, 1.0, |n| n.x.ln()), -1.0);
        assert_close(integrate(0.0, 1.0, |n| n.from_start.powf(-0.5)), 2.0);
        assert_close(integrate(0.0, 1.0, |n| n.to_end.powf(-2.0 / 3.0)), 3.0);
    }

    #[test]
    fn both_ends_may_be_singular() {
        // ∫ dx / √(x² − 1) / √(4 − x²) · x = π/2: an Abel kernel at either end
        let kernel = |n: Node| n.x / (n.from_start * (n.x + 1.0) * n.to_end * (n.x + 2.0)).sqrt();
        assert_close(integrate(1.0, 2.0, kernel), PI / 2.0);
    }

    #[test]
    fn a_singularity_just_outside_an_end_is_resolved() {
        for gap in [1e-2f64, 1e-6, 1e-12] {
            let exact = ((1.0 + 1f64.hypot(gap)) / gap).ln();
            assert_close(integrate(0.0, 1.0, |n| 1.0 / n.x.hypot(gap)), exact);
        }
    }

    #[test]
    fn an_empty_interval_has_no_integral() {
        assert_eq!(integrate(2.0, 2.0, |_| f64::NAN), 0.0);
    }
}
