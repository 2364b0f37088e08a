//! The volume of a depth, from its image.

use crate::quadrature::GAUSS_3;
use crate::transform::leg;

/// 4 ∫ h √(a² − x²) dx, the volume of the depth that belongs to an image h linear in x² between
/// some radii, of which a is the last, and none beyond. Radii and images in m.
pub(super) fn depth_volume(x: &[f64], image: &[f64]) -> f64 {
    let Some(&a) = x.last() else { return 0.0 };
    let angle = |x: f64| x.atan2(leg(a, x));
    let (mut volume, mut start) = (0.0, angle(x[0]));
    for (x, h) in x.windows(2).zip(image.windows(2)) {
        // x = a sin θ leaves a polynomial in sin θ, cos θ for three-point Gauss
        let end = angle(x[1]);
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let per_area = (h[1] - h[0]) / ((x[1] - x[0]) * (x[1] + x[0]));
        let mean = GAUSS_3.iter().map(|(node, weight)| {
            let (sin, cos) = (middle + half * node).sin_cos();
            let inside = (a * sin).clamp(x[0], x[1]);
            weight * cos * cos * (h[0] + per_area * (inside - x[0]) * (inside + x[0]))
        });
        volume += 4.0 * half * a * a * mean.sum::<f64>();
        start = end;
    }
    volume
}
