//! Cycles of a drive: how far the contact itself moves changes with its wear.
//!
//! At constant force the integrator takes the amplitude from the state at every instant
//! ([`crate::wear::integrate`]). At constant depth the front advances into what has not worn, which
//! a mesh that begins at the front sees too late: there the cycles are run in stretches of constant
//! amplitude, and so they are where the integrator cannot follow.

use super::ROUNDING;
use crate::engine::FrettingContact;
use crate::engine::history::MOST_PIECES;
use crate::error::Error;
use crate::roots;
use crate::wear::{Part, Sliding};

/// Share of the tolerance that the amplitude may be wrong by at the end of a stretch, relative. Of
/// 400 lives twice as much makes no difference, but to a cone of the tests (5.6e-3 of V off).
const SHARE: f64 = 0.05;

/// Most by which the amplitude may grow in a stretch, relative. A front that goes too far at once
/// misses what wears on its way; each mesh made again makes the profile behind it less sharp. With
/// half of it 5 of 400 lives are more than 1 % off in V, with this 3, with twice as much one; but a
/// cone of the tests then ends 0.8 % below its final volume.
const MOST_GROWN: f64 = 3e-3;

impl FrettingContact {
    /// Amplitude of the drive (m) in steady cycles of the contact itself at the present load: U₀ +
    /// T₀/k_rig.
    pub(in crate::engine) fn drive_amplitude(&mut self, own: f64) -> f64 {
        if self.model.compliance == 0.0 {
            return own;
        }
        let contact = self.state.contact;
        let (springs, _) = self.quarter(&contact, own);
        own + self.model.compliance
            * 2.0
            * self.model.constants.tangential_modulus
            * springs.deflection_integral(own)
    }

    /// Amplitude of the contact itself in steady cycles of a drive (m) at the present load: the
    /// same law from rest.
    pub(in crate::engine) fn own_amplitude(&mut self, drive: f64) -> f64 {
        if self.model.compliance == 0.0 || self.state.contact.is_open() {
            return drive;
        }
        let contact = self.state.contact;
        let row_modulus = 2.0 * self.model.constants.tangential_modulus;
        let limit = self.friction_limit();
        roots::from_below((drive - self.model.compliance * limit).max(0.0), |amplitude| {
            let (mut force, mut stick) = (0.0, contact.radius);
            if amplitude > 0.0 {
                let (springs, _) = self.quarter(&contact, amplitude);
                force = row_modulus * springs.deflection_integral(amplitude);
                stick = springs.stick_radius(&contact, self.model.bound_slope, amplitude);
            }
            let pull = drive - amplitude - self.model.compliance * force;
            let scale = drive + amplitude + self.model.compliance * limit;
            let pull = if pull.abs() <= ROUNDING * scale { 0.0 } else { pull };
            pull / (1.0 + self.model.compliance * row_modulus * stick)
        })
    }

    /// Wears the surface by cycles of a drive at constant load; returns the amplitude of the
    /// contact itself at their end, m.
    ///
    /// # Errors
    /// As [`Self::wear_steadily`].
    pub(in crate::engine) fn wear_driven_cycles(
        &mut self,
        value: f64,
        drive: f64,
        (cycles, part): (f64, Part),
    ) -> Result<f64, Error> {
        if self.model.constants.force_control {
            let sliding = Sliding::Cycles(self.own_amplitude(drive));
            match self.wear_by(value, (sliding, Some(drive)), cycles, part) {
                Ok(work) => {
                    self.correct_work(work);
                    self.state.contact = self.contact_at(value)?;
                    return Ok(self.own_amplitude(drive));
                }
                Err(Error::TooMuchWear { .. } | Error::NotFinite { .. }) => {}
                Err(other) => return Err(other),
            }
        }
        self.wear_in_stretches(value, drive, (cycles, part))
    }

    /// The same in stretches of constant amplitude, the mean of those at both ends (second order in
    /// the stretch). The end is found with the amplitude of the start first; by how much it moves
    /// when the mean is taken tells how long a stretch may be. So does by how much the amplitude
    /// grows: a front that goes too far at once misses what wears on its way, up to 3 % of V, while
    /// the amplitude in the final state is hardly off.
    ///
    /// # Errors
    /// As [`Self::wear_steadily`].
    fn wear_in_stretches(
        &mut self,
        value: f64,
        drive: f64,
        (cycles, mut part): (f64, Part),
    ) -> Result<f64, Error> {
        let tolerance = self.model.parameters.tolerance;
        let (mut left, mut stretch, mut rejected) = (cycles, cycles, f64::INFINITY);
        let mut amplitude = self.own_amplitude(drive);
        for _ in 0..MOST_PIECES {
            if left <= 0.0 {
                return Ok(amplitude);
            }
            stretch = stretch.min(left);
            let before = self.clone();
            let predicted = self.amplitude_after(value, (drive, amplitude), (stretch, part));
            // the amplitude grows along a stretch: what leaves the table with that of its start
            // leaves it
            if let Err(beyond @ (Error::BeyondTable { .. } | Error::NonMonotoneImage { .. })) = predicted {
                return Err(beyond);
            }
            let corrected = predicted.and_then(|predicted| {
                if predicted == amplitude {
                    return Ok((amplitude, [0.0; 2]));
                }
                self.go_back(before.clone());
                let mean = 0.5 * (amplitude + predicted);
                let end = self.amplitude_after(value, (drive, mean), (stretch, part))?;
                let [missed, grown] = [predicted, amplitude].map(|other| (end - other).abs() / end);
                Ok((end, [missed / (SHARE * tolerance), (grown / MOST_GROWN).powi(2)]))
            });
            let (end, [missed, grown]) = corrected.unwrap_or((amplitude, [f64::INFINITY; 2]));
            let error = missed.max(grown);
            // what a new mesh changes does not fall with the length of a stretch (with a quarter
            // and nine tenths V of 400 lives is the same)
            let accepted = error <= 1.0 || grown <= 1.0 && missed > 0.5 * rejected;
            rejected = if accepted { f64::INFINITY } else { missed };
            if accepted {
                (amplitude, part) = (end, Part::Stretch);
                left = if stretch < left { left - stretch } else { 0.0 };
            } else {
                self.go_back(before);
            }
            let error = if accepted { error.min(1.0) } else { error };
            stretch *= (0.9 / error.sqrt()).clamp(0.1, 4.0);
        }
        Err(Error::TooMuchWear { cycles, left, amplitude: drive, steps: MOST_PIECES })
    }

    /// Runs cycles of the contact itself; returns the amplitude that the drive would make then.
    fn amplitude_after(
        &mut self,
        value: f64,
        (drive, amplitude): (f64, f64),
        (cycles, part): (f64, Part),
    ) -> Result<f64, Error> {
        self.wear_steadily(value, (Sliding::Cycles(amplitude), part), cycles)?;
        Ok(self.own_amplitude(drive))
    }

    /// Back to another state; work is counted nevertheless.
    fn go_back(&mut self, before: Self) {
        let counters = self.state.counters;
        *self = before;
        self.state.counters = counters;
    }
}
