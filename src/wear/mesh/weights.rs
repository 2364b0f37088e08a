//! Weights of the transforms and integrals on a mesh of shares.

use crate::surface::depth_volume;
use crate::transform::inverse_row;
use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// φ times the weights of a derivative at node i of a mesh graded with the power p, by the central
/// difference in ξ; none at the ends.
pub(super) fn drift_at(p: f64, i: usize, cells: usize) -> [f64; 3] {
    if i == 0 || i == cells {
        return [0.0; 3];
    }
    let xi = i as f64 / cells as f64;
    // φ/φ'(ξ) over 2 Δξ
    let weight = 0.5 * i as f64 * (p + 1.0 - p * xi) / (p * (p + 1.0) * (1.0 - xi));
    [-weight, 0.0, weight]
}

/// Rows of D̂ for k piecewise linear in X: (1/π) ∫ k dX/√(Z − X).
pub(super) fn annulus_table(share: &[f64]) -> Vec<f64> {
    let n = share.len() - 1;
    let mut inverse = Vec::with_capacity((n + 1) * (n + 2) / 2);
    for i in 0..=n {
        let start = inverse.len();
        inverse.resize(start + i + 1, 0.0);
        for j in 0..i {
            let cell = share[j + 1] - share[j];
            let (far, near) = ((share[i] - share[j]).sqrt(), (share[i] - share[j + 1]).sqrt());
            // 2 (far − near), and the share of the outer end in it, without cancellation
            let whole = 2.0 * cell / (far + near);
            let outer = (2.0 * far + near) / (3.0 * (far + near)) * whole;
            inverse[start + j] += FRAC_1_PI * (whole - outer);
            inverse[start + j + 1] += FRAC_1_PI * outer;
        }
    }
    inverse
}

/// Weights for k piecewise linear in X: ∫ k dX / 2 and 2 ∫ k √(1 − X) dX.
pub(super) fn annulus_integrals(share: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = share.len() - 1;
    let mut width = vec![0.0; n + 1];
    let mut volume = vec![0.0; n + 1];
    for j in 0..n {
        let cell = share[j + 1] - share[j];
        width[j] += cell / 4.0;
        width[j + 1] += cell / 4.0;
        // ∫ √(1 − X) dX with the weight of the outer end, in t = √(1 − X)
        let (s, t) = ((1.0 - share[j]).sqrt(), (1.0 - share[j + 1]).max(0.0).sqrt());
        let whole = 2.0 / 3.0 * cell * (s * s + s * t + t * t) / (s + t);
        let outer =
            2.0 / 15.0 * cell * (2.0 * s * s * s + 4.0 * s * s * t + 6.0 * s * t * t + 3.0 * t * t * t)
                / ((s + t) * (s + t));
        volume[j] += 2.0 * (whole - outer);
        volume[j + 1] += 2.0 * outer;
    }
    (width, volume)
}

/// Rows of D̂ for h piecewise linear in X on a disc of radius 1.
pub(super) fn disc_table(share: &[f64]) -> Vec<f64> {
    let n = share.len() - 1;
    let x: Vec<f64> = share.iter().map(|s| s.sqrt()).collect();
    let mut inverse = Vec::with_capacity((n + 1) * (n + 2) / 2);
    for i in 0..=n {
        let start = inverse.len();
        inverse.resize(start + i + 1, 0.0);
        inverse[start] = 1.0;
        inverse_row(&x[..=i], x[i], |j, c| {
            inverse[start + j] -= c;
            inverse[start + j + 1] += c;
        });
    }
    inverse
}

/// Weights for h piecewise linear in X on a disc of radius 1: ∫ h dx and the volume 4 ∫ h √(1 − x²)
/// dx.
pub(super) fn disc_integrals(share: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = share.len() - 1;
    let x: Vec<f64> = share.iter().map(|s| s.sqrt()).collect();
    let mut width = vec![0.0; n + 1];
    let mut volume = vec![0.0; n + 1];
    for j in 0..n {
        let outer = crate::surface::outer_weight(x[j], x[j + 1]);
        let cell = x[j + 1] - x[j];
        width[j] += (1.0 - outer) * cell;
        width[j + 1] += outer * cell;
        let (inner, outer) = depth_volume(x[j], x[j + 1], 1.0);
        volume[j] += inner;
        volume[j + 1] += outer;
    }
    (width, volume)
}

/// Rows of K̂ for a line that falls to zero at the end.
pub(super) fn pressure_table(share: &[f64]) -> Vec<f64> {
    let n = share.len() - 1;
    let mut pressure = Vec::with_capacity((n + 1) * (n + 2) / 2);
    for i in 0..=n {
        let start = pressure.len();
        pressure.resize(start + n + 1 - i, 0.0);
        for j in i..n {
            let weight = pressure_weight(share, i, j);
            pressure[start + j - i] += weight;
            pressure[start + j + 1 - i] -= weight;
        }
    }
    pressure
}

/// Weight of the drop of a line over cell j in the pressure at node i ≤ j.
pub(super) fn pressure_weight(share: &[f64], i: usize, j: usize) -> f64 {
    FRAC_2_PI / ((share[j] - share[i]).sqrt() + (share[j + 1] - share[i]).sqrt())
}

/// Last column of K̂ where the line does not fall to zero in the last cell but jumps at its end.
pub(super) fn rim_column(share: &[f64]) -> Vec<f64> {
    let n = share.len() - 1;
    let column = |i: usize| {
        if i == n {
            // the mean of q/(π √(1 − Z)) over the outer half of the cell
            return FRAC_2_PI / (0.5 * (1.0 - share[n - 1])).sqrt();
        }
        FRAC_1_PI / (1.0 - share[i]).sqrt() - pressure_weight(share, i, n - 1)
    };
    (0..=n).map(column).collect()
}
