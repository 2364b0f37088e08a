//! Exact weights of one cell in the Abel transforms: differences of square roots or of angles, none
//! of which cancel.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};
use std::ops::Range;

/// Adds the weights of v at the nodes `cells.start..=cells.end` in (1/π) ∫ v dX/√(X (Z − X)) over
/// these cells, all of them below Z. `square` are the nodes X, `root` their square roots; one
/// weight per node.
pub(super) fn add_inverse(square: &[f64], root: &[f64], z: f64, cells: Range<usize>, weights: &mut [f64]) {
    let mut far = (z - square[cells.start]).sqrt();
    let first = cells.start;
    for j in cells {
        let near = (z - square[j + 1]).sqrt();
        let width = square[j + 1] - square[j];
        let (inner, outer) = image_weights(width, (root[j], far), (root[j + 1], near));
        weights[j - first] += inner;
        weights[j - first + 1] += outer;
        far = near;
    }
}

/// (1/π) ∫ v dX/√(X (Z − X)) over a cell for v linear in X: weights of its ends, each given as (x,
/// √(Z − X)).
///
/// With x = r sin φ the measure is (2/π) dφ. In Δ = φ₁ − φ₀ and Σ = φ₀ + φ₁ the weights are (Δ ±
/// cot Σ (1 − Δ cot Δ))/π, where the second term never exceeds a third of the first.
pub(super) fn image_weights(width: f64, inner: (f64, f64), outer: (f64, f64)) -> (f64, f64) {
    let ((x0, far), (x1, near)) = (inner, outer);
    // r² sin Σ, r² cos Δ, r² cos Σ; sin Δ = width/(r² sin Σ)
    let (sin_sum, cos, cos_sum) = (x1 * far + x0 * near, far * near + x0 * x1, far * near - x0 * x1);
    let scale = 1.0 / sin_sum;
    let sin = width * (x1 * x1 + near * near) * scale;
    let (angle, excess) = if 8.0 * sin < cos {
        let t = sin / cos;
        let excess = excess_of_tangent(t * t);
        (t * (1.0 - excess), excess)
    } else {
        let angle = sin.atan2(cos);
        (angle, 1.0 - angle * cos / sin)
    };
    let tilt = cos_sum * scale * excess;
    (FRAC_1_PI * (angle + tilt), FRAC_1_PI * (angle - tilt))
}

/// 1 − atan(t)/t from t² < 1/64, by its series.
fn excess_of_tangent(t2: f64) -> f64 {
    (1..=9).rev().fold(0.0, |sum, k| t2 * (1.0 / f64::from(2 * k + 1) - sum))
}

/// Weights of the drops qⱼ − qⱼ₊₁ over the given cells, all of them beyond Z, in −(1/π) ∫ q' dX/√(X
/// − Z).
pub(super) fn pressure(square: &[f64], z: f64, cells: Range<usize>, weights: &mut [f64]) {
    let mut near = (square[cells.start] - z).sqrt();
    for (weight, j) in weights.iter_mut().zip(cells) {
        let far = (square[j + 1] - z).sqrt();
        *weight = FRAC_2_PI / (near + far);
        near = far;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::composite;
    use crate::transform::leg;

    #[test]
    fn weights_are_the_integrals() {
        // cells from a hair to the whole range below r = 1, at the axis, in the middle and at r
        for (x0, x1) in [
            (0.0, 1.0),
            (0.0, 1e-5),
            (0.0, 0.3),
            (0.2, 0.21),
            (0.2, 0.9),
            (0.5, 0.55),
            (0.69, 0.711),
            (0.95, 1.0),
            (0.999_99, 1.0),
            (0.6, 1.0),
            (0.999, 0.9999),
        ] {
            let (far, near) = (leg(1.0, x0), leg(1.0, x1));
            let width = (x1 - x0) * (x1 + x0);
            // x = sin φ: ∫ dX/√(X (Z − X)) = 2 ∫ dφ; sin² φ − sin² φ₀ = sin(φ + φ₀) sin(φ − φ₀)
            let (from, to) = (x0.atan2(far), x1.atan2(near));
            let outer = |phi: f64| (phi + from).sin() * (phi - from).sin() / width;
            let inner = |phi: f64| (to + phi).sin() * (to - phi).sin() / width;
            let exact = (
                composite(from, to, |p| FRAC_2_PI * inner(p)),
                composite(from, to, |p| FRAC_2_PI * outer(p)),
            );
            let close = |a: f64, b: f64, what: &str| {
                let allowed = 1e-14 + 4e-16 * to / (to - from);
                assert!((a / b - 1.0).abs() < allowed, "{what} of {x0} to {x1}: {a:e} {b:e}");
            };
            let weights = image_weights(width, (x0, far), (x1, near));
            close(weights.0, exact.0, "inner end");
            close(weights.1, exact.1, "outer end");
        }
    }
}
