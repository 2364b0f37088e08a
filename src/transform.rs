//! The two Abel transforms of the method, exact for data that are piecewise linear in the square of
//! the radius.
//!
//! With X = x² and Z = r² (unit m²), nodes x₀ = 0 < x₁ < …, and v linear in X between nodes:
//!
//! * **inverse Abel transform** (paper, eqs. (2), (16)): s(r) = (2/π) ∫₀ʳ v dx/√(r² − x²) = v₀ + Σⱼ
//!   Cⱼ(r) (vⱼ₊₁ − vⱼ), where Cⱼ is the mean over cell j (in X) of (2/π) acos(x/r). It turns an
//!   image into a profile and spring slip into surface slip;
//! * **pressure** (eqs. (12), (17)): p(r) = −(1/π) ∫ᵣ q'(x) dx/√(x² − r²) = Σⱼ Kⱼ(r) (qⱼ − qⱼ₊₁)
//!   with Kⱼ = (2/π)/(√(Xⱼ₊₁ − Z) + √(Xⱼ − Z)), in 1/m.
//!
//! Both are causal node by node: s at node i uses v at nodes ≤ i only, p at node i uses q at nodes
//! ≥ i only. So a spring row that has not slipped up to a node gives a slip of exactly zero there,
//! and a sticking region never wears.

mod abel;
mod cell;

pub use abel::Abel;

use std::f64::consts::FRAC_2_PI;

/// √(x² − r²) for x ≥ r ≥ 0 without loss of digits; 0 below.
pub(crate) fn leg(x: f64, r: f64) -> f64 {
    let (short, long) = ((x - r).max(0.0), x + r);
    let square = short * long;
    // of radii below 1e-154 or above 1e154 the square is no number of use
    if (f64::MIN_POSITIVE..=f64::MAX).contains(&square) { square.sqrt() } else { short.sqrt() * long.sqrt() }
}

/// Row of weights of the inverse Abel transform for radius r: calls `sink(j, C)` for the cells that
/// begin below r. The last of them may be cut by r; its weight then is that of the whole linear
/// piece, ∫ up to r only.
fn inverse_row(x: &[f64], r: f64, mut sink: impl FnMut(usize, f64)) {
    if r <= 0.0 {
        return;
    }
    let mut far = leg(r, x[0]);
    for j in 0..x.len().saturating_sub(1) {
        if x[j] >= r {
            break;
        }
        let end_x = x[j + 1].min(r);
        let (near, width) = (leg(r, end_x), (end_x - x[j]) * (end_x + x[j]));
        // the mean, integrated by parts: the value at the end, and what the fall towards it adds
        let (_, rest) = cell::image_weights(width, (x[j], far), (end_x, near));
        let mean = FRAC_2_PI * near.atan2(end_x) + rest;
        let share = if end_x < x[j + 1] { width / ((x[j + 1] - x[j]) * (x[j + 1] + x[j])) } else { 1.0 };
        sink(j, mean * share);
        far = near;
    }
}

/// Inverse Abel transform at one radius: s(r) for v given at the nodes x. Constant beyond the last
/// node's value is *not* assumed: cells end at the last node, beyond it v is taken as constant.
pub(crate) fn inverse_at(x: &[f64], v: &[f64], r: f64) -> f64 {
    let mut s = v[0];
    inverse_row(x, r, |j, c| s += c * (v[j + 1] - v[j]));
    s
}

/// Solves the inverse Abel transform for its last value: v at the last node of `x` such that s
/// there equals `target`, given v at all nodes before.
pub(crate) fn abel_last(x: &[f64], v: &[f64], target: f64) -> f64 {
    let last = x.len() - 1;
    let (mut rest, mut far, mut weight) = (target, leg(x[last], x[0]), 0.0);
    for j in 0..last {
        rest -= weight * v[j];
        let (near, width) = (leg(x[last], x[j + 1]), (x[j + 1] - x[j]) * (x[j + 1] + x[j]));
        let (inner, outer) = cell::image_weights(width, (x[j], far), (x[j + 1], near));
        rest -= inner * v[j];
        (far, weight) = (near, outer);
    }
    rest / weight
}

/// Weight K of the pressure transform for a cell [x0, x1] with x0 ≥ r, 1/m.
pub(crate) fn pressure_weight(x0: f64, x1: f64, r: f64) -> f64 {
    FRAC_2_PI / (leg(x1, r) + leg(x0, r))
}

/// Σ aᵢ bᵢ in four independent sums, which the compiler turns into vector instructions.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, a_rest) = a.as_chunks::<4>();
    let (b4, b_rest) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (p, q) in a4.iter().zip(b4) {
        for lane in 0..4 {
            sums[lane] += p[lane] * q[lane];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(p, q)| p * q).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Adds a multiple of a term to a sum.
pub(crate) fn add(sum: &mut [f64], factor: f64, term: &[f64]) {
    sum.iter_mut().zip(term).for_each(|(sum, term)| *sum += factor * term);
}

#[cfg(test)]
mod tests;
