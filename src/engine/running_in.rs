//! Friction that runs in: μ(W) = μ_end − (μ_end − μ₀) e^(−W/W_r), W the dissipated energy.
//!
//! A line is divided into parts ([`line`]). In a part the bound of a spring goes from m₀ (d₀ − g)
//! to m₁ (d₁ − g), m₁ that of the work at the end, which is found by iteration on a copy of the
//! contact. A call that fails has changed nothing.
//!
//! Many cycles in one call are divided in the same way, each part at the coefficient of its middle.
//! With wear, a part is as long as its halves agree with it.
//! What the constants were measured by is in docs/decisions/running_in.md.

mod line;

use super::history::MOST_PIECES;
use super::{FrettingContact, Gradient};
use crate::error::Error;
use crate::parameters::Parameters;
use crate::wear::{Constants, Part};
use nalgebra::Vector2;
use std::sync::Arc;

/// Relative error of the work of a line, or of μ in cycles, at most.
const ACCURACY: f64 = 1e-7;

/// How far from the solution of an iteration counts as none, relative.
pub(super) const BALANCED: f64 = 1e-13;

/// Most iterations for μ at the end of a part, of which two or three are usual, before its bounds
/// are halved instead.
const MOST_ITERATIONS: u32 = 8;

/// Friction that runs in.
impl FrettingContact {
    /// Coefficient of friction at the present, that of [`Self::dissipated_energy`].
    pub fn friction_coefficient_now(&self) -> f64 {
        self.model.constants.friction_coefficient
    }

    /// dμ/dW = (μ_end − μ)/W_r, 1/J.
    fn friction_slope(&self) -> f64 {
        if !self.runs_in() {
            return 0.0;
        }
        let Parameters { friction_coefficient_final, running_in_energy, .. } = *self.model.parameters;
        (friction_coefficient_final - self.model.constants.friction_coefficient) / running_in_energy
    }

    /// ρ = d(ln μ)/dW, 1/J.
    pub(super) fn bound_growth(&self) -> f64 {
        if self.runs_in() { self.friction_slope() / self.model.constants.friction_coefficient } else { 0.0 }
    }

    /// Of [`Self::friction_coefficient_now`].
    pub fn friction_coefficient_gradient(&self) -> Gradient {
        self.dissipated_energy_gradient().times(self.friction_slope())
    }

    /// By how much one cycle of an amplitude (m) changes the coefficient of friction.
    pub fn friction_coefficient_per_cycle(&self, amplitude: f64) -> f64 {
        let slope = self.friction_slope();
        if slope == 0.0 { 0.0 } else { slope * self.work_per_cycle(amplitude) }
    }

    /// Whether friction depends on what has been dissipated.
    pub(super) fn runs_in(&self) -> bool {
        self.model.parameters.running_in_energy > 0.0
    }

    /// Whether it still changes: in the end μ is that of the end to the bit, and a line as short
    /// work as at a constant one.
    pub(super) fn is_running_in(&self) -> bool {
        let Parameters { friction_coefficient_final, running_in_energy, .. } = *self.model.parameters;
        let has_ended = self.state.work >= Parameters::RUN_IN * running_in_energy
            && self.model.constants.friction_coefficient == friction_coefficient_final;
        self.runs_in() && !has_ended
    }

    /// Takes the coefficient of friction that belongs to the dissipated energy.
    pub(super) fn follow_running_in(&mut self) {
        if self.runs_in() {
            self.set_friction(self.model.parameters.friction_coefficient_after(self.state.work));
            self.keep_bound_slope();
        }
    }

    /// m = μE*/G* after an energy (J) has been dissipated.
    pub(super) fn bound_slope_after(&self, energy: f64) -> f64 {
        let friction_coefficient = self.model.parameters.friction_coefficient_after(energy);
        Constants { friction_coefficient, ..self.model.constants }.bound_slope()
    }

    pub(super) fn set_friction(&mut self, coefficient: f64) {
        let model = Arc::make_mut(&mut self.model);
        model.constants.friction_coefficient = coefficient;
        model.bound_slope = model.constants.bound_slope();
    }

    /// Coefficients of friction at both ends of a line along which it changes.
    pub(super) fn running_in_of_line(&self) -> Option<(f64, f64)> {
        let last = self.model.constants.friction_coefficient;
        let change = self.model.start_slope / self.model.bound_slope;
        (change != 1.0 && change.is_finite()).then_some((change * last, last))
    }

    /// Takes the coefficient at a share of such a line for the end of a piece.
    pub(super) fn run_in_along(&mut self, ends: Option<(f64, f64)>, share: f64) {
        let Some((first, last)) = ends else { return };
        self.set_friction(if share == 1.0 { last } else { first + share * (last - first) });
    }

    /// The next piece of such a line begins with the present bound.
    pub(super) fn keep_bound_slope_after(&mut self, ends: Option<(f64, f64)>) {
        if ends.is_some() {
            self.keep_bound_slope();
        }
    }

    /// The next line begins with the present bound.
    pub(super) fn keep_bound_slope(&mut self) {
        let model = Arc::make_mut(&mut self.model);
        model.start_slope = model.bound_slope;
    }

    /// Energy (J) over which μ may go evenly: x = ΔW/W_r of (μ_end − μ) x²/12 = ε μ, the error of
    /// the trapezoidal rule.
    fn energy_of_part(&self, accuracy: f64) -> f64 {
        let mu = self.model.constants.friction_coefficient;
        let difference = (self.model.parameters.friction_coefficient_final - mu).abs() / mu;
        self.model.parameters.running_in_energy * (12.0 * accuracy / difference).sqrt()
    }

    /// A copy that does not wear, for trials.
    fn without_wear(&self) -> Self {
        let mut copy = self.clone();
        copy.state.wear = None;
        copy
    }

    /// [`Self::advance_to_planar`] with friction that runs in.
    pub(super) fn run_in_to(&mut self, normal: f64, target: Vector2<f64>) -> Result<(), Error> {
        let mut now = self.clone();
        let run = now.placed(|now| now.run_in_parts(normal, target));
        run.map_err(|error| self.error_of_step(error, target.x))?;
        now.state.counters.steps = self.state.counters.steps + 1;
        *self = now;
        Ok(())
    }

    /// The contact after a part of a step, with the coefficient of friction of its end: that of its
    /// work, to a relative accuracy, found by the secant method from an expected work, J, which may
    /// be known for the coefficient of the start. It lies between that and the final one.
    pub(super) fn run_in_part(
        &self,
        (expected, is_known): (f64, bool),
        accuracy: f64,
        mut advance: impl FnMut(&mut Self) -> Result<(), Error>,
    ) -> Result<Self, Error> {
        let parameters = &self.model.parameters;
        let first = self.model.constants.friction_coefficient;
        let last = parameters.friction_coefficient_final;
        let (mut low, mut high) = (first.min(last), first.max(last));
        let mut coefficient = parameters.friction_coefficient_after(self.state.work + expected);
        // a coefficient, and what that of the work that it leads to has beyond it
        let mut former = is_known.then_some((first, coefficient - first));
        let mut iterations = 0;
        let (start, mut next) = (self.mark(), self.clone());
        loop {
            next.set_friction(coefficient);
            advance(&mut next)?;
            let found = parameters.friction_coefficient_after(next.state.work);
            let residual = found - coefficient;
            iterations += 1;
            if residual.abs() <= accuracy * found || high - low <= BALANCED * high {
                next.follow_running_in();
                return Ok(next);
            }
            if residual > 0.0 {
                low = coefficient;
            } else {
                high = coefficient;
            }
            let slope = match former {
                Some((before, residual_before)) => (residual - residual_before) / (coefficient - before),
                // in gross slip the work goes with the mean of both ends
                None => {
                    let x = (next.state.work - self.state.work) / parameters.running_in_energy;
                    x * (last - found) / (first + coefficient) - 1.0
                }
            };
            let secant = coefficient - residual / slope;
            former = Some((coefficient, residual));
            let is_between = |guess: &f64| iterations < MOST_ITERATIONS && low < *guess && *guess < high;
            coefficient = [secant, found].into_iter().find(is_between).unwrap_or(0.5 * (low + high));
            next.return_to(&start);
        }
    }

    /// [`Self::advance_cycles`] with friction that runs in.
    pub(super) fn run_in_over(&mut self, normal: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        let mut now = self.clone();
        // refuses a load that cannot be carried, and finds contact
        now.advance_equal_cycles(normal, amplitude, (0.0, Part::Call))?;
        // with wear each part takes an integration of the profile
        let accuracy = if now.state.wear.is_some() { self.model.parameters.tolerance } else { ACCURACY };
        let (mut left, mut longest, mut trials, mut part) = (cycles, f64::INFINITY, 0, Part::Call);
        while left > 0.0 {
            let mut one = now.without_wear();
            one.advance_equal_cycles(normal, amplitude, (1.0, Part::Call))?;
            let work = one.state.work - now.state.work;
            let most = now.energy_of_part(accuracy);
            let stretch = (most / work).min(longest).min(left);
            let run = |from: &Self, cycles: f64, part: Part| {
                from.run_in_cycles(cycles, |this, cycles| {
                    this.advance_equal_cycles(normal, amplitude, (cycles, part))
                })
            };
            if now.state.wear.is_none() {
                (now, left) = (run(&now, stretch, part)?, left - stretch);
                continue;
            }
            if trials == MOST_PIECES {
                return Err(Error::TooMuchWear { cycles, left, amplitude, steps: trials });
            }
            trials += 1;
            // wear changes the work of a cycle, and a change of friction what can wear
            let whole = run(&now, stretch, part)?;
            let halves = run(&run(&now, 0.5 * stretch, part)?, 0.5 * stretch, Part::Stretch)?;
            let missed = (whole.state.work - halves.state.work).abs();
            let error = if missed == 0.0 { 0.0 } else { missed / (accuracy * halves.state.work) };
            if error <= 1.0 {
                (now, left, part) = (halves, left - stretch, Part::Stretch);
            }
            longest = stretch * (0.8 / error.cbrt()).clamp(0.1, 4.0);
        }
        // the body stands at its amplitude with the friction of the end
        now.follow_running_in();
        now.advance_equal_cycles(normal, amplitude, (0.0, Part::Call))?;
        now.state.counters.steps = self.state.counters.steps + 1;
        *self = now;
        Ok(())
    }

    /// The contact after some cycles at the coefficient of friction of their middle.
    fn run_in_cycles(
        &self,
        cycles: f64,
        advance: impl Fn(&mut Self, f64) -> Result<(), Error>,
    ) -> Result<Self, Error> {
        let half = |half: &mut Self| advance(half, 0.5 * cycles);
        let middle = self
            .without_wear()
            .run_in_part((0.0, false), BALANCED, half)?
            .model
            .constants
            .friction_coefficient;
        let mut next = self.clone();
        next.set_friction(middle);
        next.keep_bound_slope();
        advance(&mut next, cycles)?;
        next.follow_running_in();
        Ok(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn three_iterations_find_the_coefficient_at_the_end_of_a_usual_step() {
        let parameters = Parameters {
            friction_coefficient: 0.2,
            friction_coefficient_final: 0.8,
            running_in_energy: 2e-3,
            wear_coefficient: 0.0,
            ..Parameters::default()
        };
        let mut contact = FrettingContact::new(parameters).unwrap();
        contact.start_at(100.0, 0.0).unwrap();
        let (iterations, steps) = (Cell::new(0), 200);
        for step in 1..=steps {
            let place = Vector2::new(2e-6 * (f64::from(step) * 0.0628).sin(), 0.0);
            let mut rest = contact.clone();
            rest.advance_at_constant_friction(100.0, place).unwrap();
            let walk = |this: &mut FrettingContact| {
                iterations.set(iterations.get() + 1);
                this.advance_at_constant_friction(100.0, place)
            };
            let expected = rest.state.work - contact.state.work;
            contact = contact.run_in_part((expected, true), BALANCED, walk).unwrap();
        }
        assert!(contact.friction_coefficient_now() > 0.22, "{}", contact.friction_coefficient_now());
        assert!(iterations.get() <= 3 * steps, "{} for {steps} steps", iterations.get());
    }
}
