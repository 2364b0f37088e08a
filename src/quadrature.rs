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

/// Nodes and weights of the three-point Gauss rule on (−1, 1), for smooth integrands over many
/// short cells: exact for polynomials of degree 5.
pub(crate) const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Nodes and weights of the five-point Gauss rule on (−1, 1): exact for polynomials of degree 9.
pub(crate) const GAUSS_5: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn smooth_integrals_are_exact_to_rounding() {
        assert!((composite(0.0, 3.0, f64::exp) - (3f64.exp() - 1.0)).abs() < 1e-13);
        assert!((composite(-1.0, 1.0, |x| x.powi(30)) - 2.0 / 31.0).abs() < 1e-15);
        assert_eq!(composite(2.0, 2.0, f64::exp), 0.0);
    }

    #[test]
    fn gauss_rules_are_exact_to_their_degree_and_no_further() {
        let moment = |rule: &[(f64, f64)], power: i32| -> f64 {
            rule.iter().map(|(node, weight)| weight * node.powi(power)).sum()
        };
        for (rule, degree) in [(&GAUSS_3[..], 5), (&GAUSS_5[..], 9)] {
            for power in 0..=degree {
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((moment(rule, power) - exact).abs() < 1e-15, "degree {degree}, power {power}");
            }
            let exact = 2.0 / f64::from(degree + 2);
            assert!((moment(rule, degree + 1) - exact).abs() > 1e-3, "degree {degree}");
        }
    }
}
