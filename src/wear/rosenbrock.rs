//! Time integration of a [`Patch`]: a linearly implicit method of third order with an embedded one
//! of second.
//!
//! ROS34PW2 of Rang and Angermann (BIT 45, 2005, 761): four stages, stiffly accurate and L-stable,
//! and of third order with any approximation of the Jacobian. Wear relaxes to its final state at
//! rates that span many decades, which an explicit method would have to follow all; here one small
//! linear system serves the four stages of a step, and that of the step before may serve them, too.

use super::patch::{Linear, Patch, Rate, State};
use crate::counters::Counters;
use crate::transform::add;
use std::f64::consts::PI;

pub(super) const GAMMA: f64 = 0.435_866_521_508_459;

/// Rows of α below the diagonal.
pub(super) const ALPHA: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [0.871_733_043_016_918, 0.0, 0.0],
    [0.844_570_600_153_694_2, -0.112_990_642_364_841_85, 0.0],
    [0.0, 0.0, 1.0],
];

/// Rows of Γ below the diagonal.
pub(super) const COUPLING: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [-0.871_733_043_016_918, 0.0, 0.0],
    [-0.903_380_570_130_440_8, 0.054_180_672_388_095_326, 0.0],
    [0.242_123_807_060_953_46, -1.223_250_583_904_514_7, 0.545_260_255_335_102_1],
];

pub(super) const WEIGHTS: [f64; 4] =
    [0.242_123_807_060_953_46, -1.223_250_583_904_514_7, 1.545_260_255_335_102, 0.435_866_521_508_459];

pub(super) const EMBEDDED: [f64; 4] =
    [0.378_109_031_458_193_7, -0.096_042_292_212_423_18, 0.5, 0.217_933_260_754_229_5];

/// Most by which the area of a contact may change in a step, over that of its slip zone. In lives
/// it changes by 0.11 at most.
const MOST_MOVED: f64 = 0.25;

/// A trial step.
pub(crate) struct Trial {
    pub(crate) state: State,
    pub(crate) rate: Rate,
    /// Worn volume, m³.
    pub(crate) volume: f64,
    /// Largest error of the image, m.
    pub(crate) error: f64,
}

/// One step over `cycles`; `None` where a stage has no contact edge.
pub(crate) fn step(
    patch: &Patch,
    state: &State,
    rate: &Rate,
    cycles: f64,
    linear: &Linear,
    counters: &mut Counters,
) -> Option<Trial> {
    // increments of the depths, of z, and what they make of the volume rate
    let mut increments: Vec<(Vec<f64>, Vec<f64>)> = Vec::with_capacity(4);
    let own_image = patch.own_image(rate);
    let sum = |factors: &[f64], increments: &[(Vec<f64>, Vec<f64>)]| {
        let (mut depth, mut image) = (state.depth.clone(), own_image.clone());
        for (factor, increment) in factors.iter().zip(increments) {
            add(&mut depth, cycles * factor, &increment.0);
            add(&mut image, cycles * factor, &increment.1);
        }
        (depth, image)
    };
    let (mut volume, mut edge) = (0.0, patch.edge(rate.radius_squared));
    for stage in 0..4 {
        let (mut right, volume_rate) = if stage == 0 {
            (rate.growth.clone(), rate.volume_rate)
        } else {
            counters.pressure_transforms += 1;
            counters.descent_transforms += 2;
            let here = patch.rate_of(sum(&ALPHA[stage], &increments), edge)?;
            edge.radius_squared = here.radius_squared;
            (here.growth, here.volume_rate)
        };
        for (coupling, increment) in COUPLING[stage].iter().zip(&increments) {
            add(&mut right, coupling / GAMMA, &increment.0);
        }
        right[patch.end()..].fill(0.0);
        linear.solve(&mut right);
        // the volume has no feedback on the rest, but its rate falls with the depths like theirs
        volume += cycles * WEIGHTS[stage] * (volume_rate + linear.gamma_step * linear.volume_change(&right));
        let mut image = right;
        for (coupling, increment) in COUPLING[stage].iter().zip(&increments) {
            add(&mut image, -coupling / GAMMA, &increment.1);
        }
        increments.push((linear.depth(&image), image));
    }
    let (mut depth, image) = sum(&WEIGHTS, &increments);
    let mut error = vec![0.0; image.len()];
    for (stage, increment) in increments.iter().enumerate() {
        add(&mut error, cycles * (WEIGHTS[stage] - EMBEDDED[stage]), &increment.1);
    }
    let before = rate;
    let mut rate = patch.rate_of((depth.clone(), image), edge)?;
    if patch.hold_front(&mut depth, before, &rate) {
        rate = patch.rate(&depth, rate.radius_squared)?;
    }
    counters.pressure_transforms += 1;
    counters.descent_transforms += 2;
    // another contact edge than the one that grows may meet the condition, too
    let moved = rate.radius_squared - before.radius_squared;
    if moved.abs() > MOST_MOVED * patch.span(before.radius_squared) {
        return None;
    }
    // where the edge passes a kink of what other loads have left, the images of the stages may not
    // tell how much a step has missed; what both volumes differ by does
    let missed = if patch.outside.is_some() {
        (volume - (patch.volume(&rate) - patch.volume(before))).abs()
    } else {
        0.0
    };
    let mean_missed = missed / (PI * patch.span(rate.radius_squared));
    let error = patch.largest_image(patch.sticking(before) + 1, &error, &rate).max(mean_missed);
    let state = State { depth, radius_squared: rate.radius_squared };
    Some(Trial { state, rate, volume, error })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of the method, from its own coefficients.
    #[test]
    fn the_coefficients_are_of_third_order_and_the_embedded_ones_of_second() {
        let beta = |i: usize, j: usize| {
            let below = if j < i { ALPHA[i][j] + COUPLING[i][j] } else { 0.0 };
            if i == j { GAMMA } else { below }
        };
        let row = |i: usize| (0..=i).map(|j| beta(i, j)).sum::<f64>();
        let alpha = |i: usize| ALPHA[i].iter().sum::<f64>();
        let total =
            |weights: &[f64; 4], f: &dyn Fn(usize) -> f64| (0..4).map(|i| weights[i] * f(i)).sum::<f64>();
        for weights in [&WEIGHTS, &EMBEDDED] {
            assert!((total(weights, &|_| 1.0) - 1.0).abs() < 1e-14);
            assert!((total(weights, &row) - 0.5).abs() < 1e-14);
        }
        assert!((total(&WEIGHTS, &|i| alpha(i).powi(2)) - 1.0 / 3.0).abs() < 1e-14);
        assert!((total(&WEIGHTS, &|i| (0..=i).map(|j| beta(i, j) * row(j)).sum()) - 1.0 / 6.0).abs() < 1e-14);
        // whatever the Jacobian: α and γ by themselves
        assert!((total(&WEIGHTS, &alpha) - 0.5).abs() < 1e-14);
        let chained = |i: usize| (0..i).map(|j| ALPHA[i][j] * alpha(j)).sum::<f64>();
        assert!((total(&WEIGHTS, &chained) - 1.0 / 6.0).abs() < 1e-14);
        // stiffly accurate: the last stage is the result
        for j in 0..4 {
            assert!((beta(3, j) - WEIGHTS[j]).abs() < 1e-14, "b{j}");
        }
    }
}
