//! Gauss–Legendre quadrature of smooth functions on panels of bounded length.

use gauss_quad::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

// an array, since a library that is unloaded does not free what its statics have allocated
static RULE: LazyLock<[(f64, f64); 16]> = LazyLock::new(gauss_legendre);

/// Nodes and weights of the rule with `N` points on [−1, 1].
pub(crate) fn gauss_legendre<const N: usize>() -> [(f64, f64); N] {
    let rule = GaussLegendre::new(NonZeroUsize::new(N).unwrap_or(NonZeroUsize::MIN));
    let mut points = rule.iter().map(|(node, weight)| (*node, *weight));
    std::array::from_fn(|_| points.next().unwrap_or_default())
}

/// ∫ from `start` to `end` of `f`, by a 16-point rule on panels no longer than ½: relative error
/// near rounding for integrands that are analytic within a distance of order 1 of the interval.
pub(crate) fn composite(start: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let panels = ((end - start).abs() / 0.5).ceil().clamp(1.0, 4096.0);
    let half = (end - start) / panels / 2.0;
    let panel = |k: usize| {
        let centre = start + (2 * k + 1) as f64 * half;
        RULE.iter().map(|(node, weight)| weight * f(centre + half * node)).sum::<f64>() * half
    };
    (0..panels as usize).map(panel).sum()
}

/// Half of a length up to which three points are as good as sixteen: of a function that is analytic
/// within a distance of 1 they miss some (half/2)⁶ = 6e-17.
const SHORT: f64 = 0.004;

/// [`composite`] of a function that changes little over lengths far less than 1, with three points
/// where the interval is so short.
pub(crate) fn of_slow(start: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (centre, half) = (0.5 * (start + end), 0.5 * (end - start));
    if half.abs() > SHORT {
        return composite(start, end, f);
    }
    GAUSS_3.iter().map(|(node, weight)| weight * f(centre + half * node)).sum::<f64>() * half
}

/// Nodes and weights of the three-point Gauss rule on (−1, 1), for smooth integrands over many
/// short cells: exact for polynomials of degree 5.
pub(crate) const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_integrals_are_exact_to_rounding() {
        assert!((composite(0.0, 3.0, f64::exp) - (3f64.exp() - 1.0)).abs() < 1e-13);
        assert!((composite(-1.0, 1.0, |x| x.powi(30)) - 2.0 / 31.0).abs() < 1e-15);
        assert_eq!(composite(2.0, 2.0, f64::exp), 0.0);
    }

    /// Over lengths beside that at which the rules change, of a function with a pole at a distance
    /// of 1.
    #[test]
    fn three_points_are_enough_over_short_lengths() {
        for (length, points) in [(1e-9, 3), (1.99 * SHORT, 3), (2.01 * SHORT, 16), (0.1, 16)] {
            let calls = std::cell::Cell::new(0);
            let found = of_slow(0.0, length, |x| {
                calls.set(calls.get() + 1);
                1.0 / (x + 1.0).powi(2)
            });
            let exact = length / (1.0 + length);
            assert!((found / exact - 1.0).abs() < 1e-15, "{length}: {found:e} {exact:e}");
            assert_eq!(calls.get(), points, "{length}");
        }
    }

    #[test]
    fn the_gauss_rule_is_exact_to_its_degree_and_no_further() {
        let moment =
            |power: i32| -> f64 { GAUSS_3.iter().map(|(node, weight)| weight * node.powi(power)).sum() };
        for power in 0..=5 {
            let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
            assert!((moment(power) - exact).abs() < 1e-15, "power {power}");
        }
        assert!((moment(6) - 2.0 / 7.0).abs() > 1e-3);
    }
}
