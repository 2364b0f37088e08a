//! The volume of a depth, from its image.

use crate::quadrature::GAUSS_3;
use crate::transform::leg;

/// Weights of the two ends of a cell in 4 ∫ h √(a² − x²) dx, the volume of the depth that belongs
/// to an image h linear in x² and none beyond a.
pub(super) fn depth_volume(x0: f64, x1: f64, a: f64) -> (f64, f64) {
    // x = a sin θ leaves a polynomial in sin θ, cos θ for three-point Gauss
    let (t0, t1) = (x0.atan2(leg(a, x0)), x1.atan2(leg(a, x1)));
    let (middle, half) = (0.5 * (t0 + t1), 0.5 * (t1 - t0));
    let (mut inner, mut outer) = (0.0, 0.0);
    for (node, weight) in GAUSS_3 {
        let (sin, cos) = (middle + half * node).sin_cos();
        let x = a * sin;
        let share = ((x - x0) * (x + x0) / ((x1 - x0) * (x1 + x0))).clamp(0.0, 1.0);
        let value = 4.0 * half * weight * a * a * cos * cos;
        inner += value * (1.0 - share);
        outer += value * share;
    }
    (inner, outer)
}
