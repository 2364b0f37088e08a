//! Interpolation of the kernel 1/√(distance) over a block, in τ: the distance from the block's edge
//! that faces the other block, as a share of its own width.
//!
//! The kernel's singularities lie at τ ≤ −1, since far blocks are at least a block's width apart.
//! The map y = ((b + 2) τ − 1)/(b τ + 1), b = √2 − 1, takes 0 … 1 to −1 … 1 and the singularities
//! to |y| ≥ (1 + √2)² = 5.8. Chebyshev interpolation in y so converges like 11.6⁻ⁿ (5.8 + √(5.8² −
//! 1)); in τ it would like 5.8⁻ⁿ.

use std::f64::consts::{PI, SQRT_2};
use std::sync::LazyLock;

/// Points per block: leaves an error of about 2e-13 of the kernel's largest value.
pub(super) const ORDER: usize = 12;

/// One number per interpolation point.
pub(super) type Row = [f64; ORDER];

/// b of the map.
const SKEW: f64 = SQRT_2 - 1.0;

/// The interpolation points τ, rising.
pub(super) static POINTS: LazyLock<Row> = LazyLock::new(|| {
    std::array::from_fn(|a| {
        let half = (2 * a + 1) as f64 * PI / (4 * ORDER) as f64;
        // with y = −cos 2half: (1 + y)/(b + 2 − b y)
        2.0 * half.sin().powi(2) / (SKEW + 2.0 + SKEW * (2.0 * half).cos())
    })
});

/// Turns the values Tₖ(y) into those of the Lagrange polynomials in y.
static LAGRANGE: LazyLock<[Row; ORDER]> = LazyLock::new(|| {
    std::array::from_fn(|k| {
        std::array::from_fn(|a| {
            let angle = k as f64 * (PI - (2 * a + 1) as f64 * PI / (2 * ORDER) as f64);
            if k == 0 { 1.0 / ORDER as f64 } else { 2.0 / ORDER as f64 * angle.cos() }
        })
    })
});

/// T₀, T₁, … at y(τ).
pub(super) fn polynomials(tau: f64) -> Row {
    let y = ((SKEW + 2.0) * tau - 1.0) / (SKEW * tau + 1.0);
    let mut row = [1.0; ORDER];
    row[1] = y;
    for k in 2..ORDER {
        row[k] = 2.0 * y * row[k - 1] - row[k - 2];
    }
    row
}

/// The linear functional of the Lagrange polynomials that `polynomials` is of the Chebyshev
/// polynomials.
pub(super) fn of_lagrange(polynomials: &Row) -> Row {
    let mut row = [0.0; ORDER];
    for (factor, line) in polynomials.iter().zip(LAGRANGE.iter()) {
        add_scaled(*factor, line, &mut row);
    }
    row
}

/// Lagrange polynomials in y at τ.
pub(super) fn lagrange(tau: f64) -> Row {
    of_lagrange(&polynomials(tau))
}

/// sum += factor · row.
pub(super) fn add_scaled(factor: f64, row: &Row, sum: &mut Row) {
    for (sum, value) in sum.iter_mut().zip(row) {
        *sum += factor * value;
    }
}

/// Σ aᵢ bᵢ in four independent sums.
pub(super) fn product(a: &Row, b: &Row) -> f64 {
    let mut sums = [0.0; 4];
    for (p, q) in a.as_chunks::<4>().0.iter().zip(b.as_chunks::<4>().0) {
        for lane in 0..4 {
            sums[lane] += p[lane] * q[lane];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Interpolates f at τ.
    fn interpolate(f: impl Fn(f64) -> f64, tau: f64) -> f64 {
        lagrange(tau).iter().zip(POINTS.iter()).map(|(l, p)| l * f(*p)).sum()
    }

    #[test]
    fn kernels_of_far_blocks_are_interpolated_to_the_stated_error() {
        for gap in [1.0, 1.7, 12.0] {
            let kernel = |tau: f64| 1.0 / (gap + tau).sqrt();
            for tau in [0.0, 1e-13, 0.06, POINTS[3], 0.5, 0.91, 1.0] {
                let error = (interpolate(kernel, tau) - kernel(tau)).abs() * gap.sqrt();
                assert!(error < 2e-13, "gap {gap}, {tau}: {error:e}");
            }
        }
        // a singularity at a fifth of the distance is out of reach
        let close = |tau: f64| 1.0 / (tau + 0.2).sqrt();
        assert!((interpolate(close, 0.001) - close(0.001)).abs() > 1e-9);
    }

    #[test]
    fn points_are_where_their_polynomials_are_one_and_the_others_zero() {
        for (a, &point) in POINTS.iter().enumerate() {
            for (b, value) in lagrange(point).iter().enumerate() {
                assert!((value - f64::from(u8::from(a == b))).abs() < 1e-13, "{a} {b}: {value}");
            }
        }
    }
}
