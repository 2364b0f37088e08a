//! Steps of a steady motion on a moving mesh, under error control.

use super::export::exported_nodes;
use super::patch::{Front, Linear, Motion, Patch, Rate, State, edge_not_found};
use super::rosenbrock::{self, Trial};
use super::settings::{Amount, IntegrationSettings, Part};
use crate::counters::Counters;
use crate::error::Error;
use crate::parameters::USUAL_TOLERANCE;
use crate::surface::Surface;

/// Most steps of one call at the usual tolerance: a whole life takes some fifty.
const MOST_STEPS: f64 = 500.0;

/// And behind a rig: where a front hovers, stretches of constant amplitude come sooner to an end.
const MOST_STEPS_BEHIND_A_RIG: f64 = 250.0;

/// At most as many times that, however tight the tolerance: no call may go on for ever. The method
/// is of third order: a thousandth of the tolerance takes ten times as many.
const MOST_TIGHTER: f64 = 100.0;

/// Most rejected steps of a mesh over wear that other loads have left outside; most have five.
const MOST_REJECTED: u32 = 15;

/// Length of the next step as a share of that which should have an error of the tolerance. With
/// 0.6, a life takes 5 to 12 % more systems; with 0.8 at most 3 % fewer, since twice as many steps
/// are rejected.
const SAFETY: f64 = 0.7;

/// Largest overlap in the slip zone, relative to that at the front and to the tolerance, with which
/// the rest of the motion wears nothing. Steps far longer than the relaxation would follow rounding
/// from there on: 1e9 cycles of a cone took 600 of them.
const WORN_FREE: f64 = 1e-2;

/// Least factor between two steps.
const LEAST_FACTOR: f64 = 0.2;

/// Least error of a step, over the tolerance, that tells a trend.
const LEAST_ERROR: f64 = 1e-2;

/// What goes on from one mesh of a motion to the next.
pub(super) struct Course<'a> {
    motion: &'a Motion,
    amount: &'a Amount,
    settings: &'a IntegrationSettings,
    /// Cycles or metres that are left.
    pub(super) left: f64,
    /// Length of the next step; 0 where it is not known yet.
    pub(super) step: f64,
    steps: u32,
    most_steps: u32,
    /// Length and error, over the tolerance, of the last step.
    previous: Option<(f64, f64)>,
    /// The linear system of the last step, where it may serve the next.
    system: Option<Linear>,
}

/// A mesh where the motion ends or the front has moved.
pub(super) struct End {
    pub(super) patch: Patch,
    pub(super) state: State,
    pub(super) rate: Rate,
    /// Volume worn on the mesh, m³.
    pub(super) volume: f64,
    /// Whether all has worn off that the motion can wear.
    pub(super) is_worn_free: bool,
}

impl<'a> Course<'a> {
    pub(super) fn new(motion: &'a Motion, amount: &'a Amount, settings: &'a IntegrationSettings) -> Self {
        let tighter = (USUAL_TOLERANCE / settings.tolerance).cbrt().clamp(1.0, MOST_TIGHTER);
        let most = motion.rig.map_or(MOST_STEPS, |_| MOST_STEPS_BEHIND_A_RIG);
        Self {
            motion,
            amount,
            settings,
            left: amount.cycles,
            step: settings.last_step,
            steps: 0,
            most_steps: (most * tighter) as u32,
            previous: None,
            system: None,
        }
    }

    /// Follows the motion on a mesh that was made on a surface.
    ///
    /// # Errors
    /// As [`super::integrate`].
    pub(super) fn follow(
        &mut self,
        surface: &Surface,
        (patch, mut state, mut rate): (Patch, State, Rate),
        counters: &mut Counters,
    ) -> Result<End, Error> {
        let mut volume = 0.0;
        if self.step == 0.0 {
            self.step = first_step(&patch, &rate, self.settings);
        }
        // a front that has just been looked for is off by the error of a new mesh: one step is
        // always made
        let (mut fresh, mut rejected, mut is_worn_free) = (true, 0, false);
        while self.left > 0.0 && (fresh || patch.front(&rate) == Front::Kept) {
            if self.is_at_end(&patch, &rate) {
                self.left = 0.0;
                is_worn_free = true;
                break;
            }
            let length = self.step.min(self.left);
            let trial = self.trial(&patch, (&state, &rate), length, counters)?;
            let error = trial.as_ref().map_or(f64::INFINITY, |trial| trial.error);
            let ratio = error / (self.settings.tolerance * patch.scale_of_error(&rate));
            let factor = step_factor((length, ratio), self.previous);
            match trial {
                Some(trial) if ratio <= 1.0 => {
                    self.previous = Some((length, ratio));
                    (state, rate) = (trial.state, trial.rate);
                    volume += trial.volume;
                    fresh = false;
                    let edge = state.radius_squared.sqrt();
                    if surface.reaches_falling_image(edge) {
                        let mut worn = surface.clone();
                        worn.set_worn(Some(exported_nodes(&patch, &state, &rate, self.settings)));
                        worn.check_one_disc(edge)?;
                    }
                    counters.profile_updates += 1;
                    self.left -= length;
                    // a step cut short says nothing about a longer one, unless it was all but too
                    // long
                    if length == self.step || factor < 1.0 {
                        self.step = length * factor;
                    }
                }
                _ => {
                    counters.rejected_steps += 1;
                    rejected += 1;
                    // the edge is held where the wear outside is steep: updates bring it across
                    if patch.outside.is_some() && rejected > MOST_REJECTED {
                        return Err(edge_not_found(self.motion));
                    }
                    self.step = length * factor.min(0.8);
                }
            }
        }
        Ok(End { patch, state, rate, volume, is_worn_free })
    }

    /// Whether all has worn off that the motion can wear.
    pub(super) fn is_at_end(&self, patch: &Patch, rate: &Rate) -> bool {
        patch.is_worn_free(rate, WORN_FREE * self.settings.tolerance)
    }

    /// One step of some length; `None` where it has no end.
    fn trial(
        &mut self,
        patch: &Patch,
        (state, rate): (&State, &Rate),
        length: f64,
        counters: &mut Counters,
    ) -> Result<Option<Trial>, Error> {
        if self.steps >= self.most_steps {
            let (cycles, amplitude) = (self.amount.cycles, self.motion.sliding.amplitude());
            return Err(Error::TooMuchWear { cycles, left: self.left, amplitude, steps: self.steps });
        }
        self.steps += 1;
        let gamma_step = rosenbrock::GAMMA * length;
        let kept = self.system.take().filter(|system| system.serves(patch, gamma_step));
        let is_new = kept.is_none();
        let linear = kept.or_else(|| Linear::new(patch, (&state.depth, rate), gamma_step, counters));
        let trial =
            linear.as_ref().and_then(|linear| rosenbrock::step(patch, state, rate, length, linear, counters));
        // in the first step the rates change most
        self.system =
            linear.filter(|_| is_new && self.amount.part != Part::Update && self.previous.is_some());
        Ok(trial)
    }
}

/// By what the step should change after one of some length and error (over the tolerance), for an
/// error of third order. Where the error rises as time goes on, it is taken to go on rising
/// (Gustafsson, ACM Trans. Math. Softw. 20, 1994, 496; with the bounds of RADAU5 by Hairer and
/// Wanner): without that, one step in four of a life was rejected.
fn step_factor((length, error): (f64, f64), previous: Option<(f64, f64)>) -> f64 {
    if !error.is_finite() {
        return LEAST_FACTOR;
    }
    let factor = SAFETY * error.cbrt().recip();
    let ahead = previous.filter(|_| error <= 1.0).map_or(factor, |(before, last): (f64, f64)| {
        factor * length / before * (last.max(LEAST_ERROR) / error).cbrt()
    });
    factor.min(ahead).clamp(LEAST_FACTOR, 4.0)
}

/// A first step that changes the image by about the size to which the method's error stays within
/// the tolerance.
fn first_step(patch: &Patch, rate: &Rate, settings: &IntegrationSettings) -> f64 {
    let change = patch.largest_image(0, &patch.mesh.abel(&rate.growth), rate);
    0.1 * settings.tolerance.cbrt() * patch.most_worn(rate) / change
}
