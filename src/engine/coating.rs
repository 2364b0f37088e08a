//! A coating that wears through: when the wear depth has reached its thickness.
//!
//! The depth is looked at where the worn profile is updated, so that it costs no transform. In
//! cyclic loading the cycle is found by running a part of the cycles of the call again. The
//! contact itself does not change: below the coating the same coefficients apply, unless
//! [`FrettingContact::retune`] changes them.

use super::FrettingContact;
use crate::error::Error;
use crate::wear::Part;
use serde::{Deserialize, Serialize};

/// Most trial runs for one wear-through. Regula falsi takes 4 to 24, the most where the cycles of
/// the call are far more than the coating lasts.
const MOST_TRIALS: u32 = 60;

/// What has become of the coating.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Coating {
    /// Cycles of cyclic loading so far.
    cycles: f64,
    worn_through: bool,
    /// Cycles up to the wear-through, where that was in cyclic loading.
    life: Option<f64>,
}

impl Coating {
    /// Numbers that a coating can have.
    pub(super) fn is_sound(&self) -> bool {
        let within = |life: f64| (0.0..=self.cycles).contains(&life) && self.worn_through;
        (0.0..f64::INFINITY).contains(&self.cycles) && self.life.is_none_or(within)
    }
}

/// A coating.
impl FrettingContact {
    /// Whether the wear depth has reached the thickness of the coating; never without a coating.
    ///
    /// Once an update of the profile has found it, it stays so. Between two updates the depth is
    /// read, at the cost and to the order of [`Self::wear_depth`]: within a percent of the
    /// thickness it may be true early, and false again after the next update.
    pub fn worn_through(&self) -> bool {
        self.has_coating() && (self.state.coating.worn_through || self.wear_depth() >= self.thickness())
    }

    /// Cycles of [`Self::advance_cycles`] since the start after which the wear depth reached the
    /// thickness of the coating, within the tolerance; `None` before, without a coating, and where
    /// it was reached in transient motion.
    pub fn cycles_to_wear_through(&self) -> Option<f64> {
        self.state.coating.life
    }

    /// Whether an update of the profile has found the coating worn through: [`Self::worn_through`]
    /// without the wear since the last update, at no cost.
    pub fn is_known_worn_through(&self) -> bool {
        self.state.coating.worn_through
    }

    /// Cycles of [`Self::advance_cycles`] so far, counted where there is a coating.
    pub fn cycles_on_coating(&self) -> f64 {
        self.state.coating.cycles
    }

    /// Counts from a number of cycles on, of which the contact may have missed some.
    pub(crate) fn set_cycles_on_coating(&mut self, cycles: f64) {
        if self.has_coating() {
            self.state.coating.cycles = cycles;
        }
    }

    fn thickness(&self) -> f64 {
        self.model.parameters.coating_thickness
    }

    fn has_coating(&self) -> bool {
        self.thickness() > 0.0
    }

    /// To be called after each update of the profile.
    pub(super) fn look_at_coating(&mut self) {
        if self.has_coating() && !self.state.coating.worn_through {
            self.state.coating.worn_through = self.updated_wear_depth() >= self.thickness();
        }
    }

    /// Runs cycles, and finds the one at which the coating wears through.
    ///
    /// # Errors
    /// Those of the cycles.
    pub(super) fn run_cycles_on_coating(
        &mut self,
        value: f64,
        amplitude: f64,
        (cycles, part): (f64, Part),
    ) -> Result<(), Error> {
        if !self.has_coating() {
            return self.run_cycles(value, amplitude, (cycles, part));
        }
        let before = (!self.state.coating.worn_through).then(|| self.clone());
        self.run_cycles(value, amplitude, (cycles, part))?;
        if let (true, Some(before)) = (self.state.coating.worn_through, before) {
            let life = self.cycles_until_worn_through(&before, (value, amplitude), (cycles, part))?;
            self.state.coating.life = Some(before.state.coating.cycles + life);
        }
        self.state.coating.cycles += cycles;
        Ok(())
    }

    /// How many of the `cycles` that led from `before` to here it took to wear through: regula
    /// falsi (Illinois) in the depth after a part of them. The work of the trials is counted.
    fn cycles_until_worn_through(
        &mut self,
        before: &Self,
        (value, amplitude): (f64, f64),
        (cycles, part): (f64, Part),
    ) -> Result<f64, Error> {
        let at_end = self.updated_wear_depth() - self.thickness();
        let mut excess = |tried: f64| {
            let mut trial = before.clone();
            trial.state.counters = self.state.counters;
            trial.run_cycles(value, amplitude, (tried, part))?;
            self.state.counters = trial.state.counters;
            self.state.counters.coating_trials += 1;
            Ok::<_, Error>(trial.updated_wear_depth() - trial.thickness())
        };
        let at_start = excess(0.0)?;
        if at_start >= 0.0 {
            return Ok(0.0);
        }
        let (mut low, mut high, mut last) = ((0.0, at_start), (cycles, at_end), 0.0);
        for _ in 0..MOST_TRIALS {
            let accuracy = before.model.parameters.tolerance * (before.state.coating.cycles + high.0);
            let crossing = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
            if high.0 - low.0 <= accuracy {
                return Ok(crossing.clamp(low.0, high.0));
            }
            // so that the last trials enclose the crossing from both sides
            let tried = crossing.max(low.0 + 0.5 * accuracy).min(high.0 - 0.5 * accuracy);
            let now = excess(tried)?;
            // an end that stays for a second time counts half
            let stays = if now * last > 0.0 { 0.5 } else { 1.0 };
            if now >= 0.0 {
                (low.1, high) = (stays * low.1, (tried, now));
            } else {
                (low, high.1) = ((tried, now), stays * high.1);
            }
            last = now;
        }
        Ok(high.0)
    }
}
