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
use crate::wear::{Part, RepeatedMotion, Sliding};

/// Share of the tolerance that the amplitude may be wrong by at the end of a stretch, relative. Of
/// 400 lives twice as much makes no difference, but to a cone of the tests (5.6e-3 of V off).
const SHARE: f64 = 0.05;

/// Most by which the amplitude may grow in a stretch, relative. A front that goes too far at once
/// misses what wears on its way; each mesh made again makes the profile behind it less sharp. With
/// half of it 5 of 400 lives are more than 1 % off in V, with this 3, with twice as much one; but a
/// cone of the tests then ends 0.8 % below its final volume.
const MOST_GROWN: f64 = 3e-3;

/// Error of a stretch over what it may be, from the amplitudes (m) that were predicted and found at
/// its end, and those at the end of a stretch of no length.
fn error_of_stretch(ends: [f64; 2], at_once: [f64; 2], tolerance: f64) -> f64 {
    let missed = (ends[1] - ends[0]) - (at_once[1] - at_once[0]);
    let grown = ends[1] - at_once[1];
    // 0 stays 0
    let [missed, grown] = [missed, grown].map(|by| by.abs() / ends[1].max(f64::MIN_POSITIVE));
    (missed / (SHARE * tolerance)).max((grown / MOST_GROWN).powi(2))
}

impl FrettingContact {
    /// Amplitude U₀ of the contact itself (m) in steady cycles of a drive (m) at the present load:
    /// U₀ + T₀/k_rig is that of the drive.
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
            if let Some(work) = self.wear_by(value, RepeatedMotion::of(sliding, cycles), Some(drive), part)? {
                self.correct_work(work);
                self.state.contact = self.contact_at(value)?;
                return Ok(self.own_amplitude(drive));
            }
        }
        self.wear_in_stretches(value, drive, (cycles, part))
    }

    /// The same in stretches of constant amplitude, the mean of those at both ends (second order in
    /// the stretch). The end is found with the amplitude of the start first; by how much it moves
    /// when the mean is taken tells how long a stretch may be. So does by how much the amplitude
    /// grows: a front that goes too far at once misses what wears on its way, up to 3 % of V, while
    /// the amplitude in the final state is hardly off. What a new mesh changes in both does not
    /// fall with the length of a stretch, and does not count.
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
        let (mut left, mut stretch) = (cycles, cycles);
        let mut amplitude = self.own_amplitude(drive);
        // what a stretch of no length makes of the amplitude, where that has been asked for
        let mut at_once = None;
        for _ in 0..MOST_PIECES {
            if left <= 0.0 {
                return Ok(amplitude);
            }
            stretch = stretch.min(left);
            let mut before = self.clone();
            let ends = match self.amplitudes_after(value, (drive, amplitude), (stretch, part)) {
                // the amplitude grows along a stretch: what leaves the table with that of its start
                // leaves it
                Err(beyond @ (Error::BeyondTable { .. } | Error::NonMonotoneImage { .. })) => {
                    return Err(beyond);
                }
                // in gross slip at constant force the amplitude stays, so that shorter stretches
                // need as many steps
                Err(Error::TooMuchWear { left: of_stretch, steps, .. })
                    if before.model.constants.force_control
                        && before.unit_work(Sliding::Cycles(amplitude)).1 == 0.0 =>
                {
                    let left = left - stretch + of_stretch;
                    return Err(Error::TooMuchWear { cycles, left, amplitude: drive, steps });
                }
                ends => ends.ok().flatten(),
            };
            let error_against = |at_once: Option<[f64; 2]>| {
                let at_once = at_once.unwrap_or([amplitude; 2]);
                ends.map_or(f64::INFINITY, |ends| error_of_stretch(ends, at_once, tolerance))
            };
            let mut error = error_against(at_once);
            if let Some([_, end]) = ends.filter(|_| error <= 1.0) {
                (amplitude, part, at_once) = (end, Part::Stretch, None);
                left = if stretch < left { left - stretch } else { 0.0 };
            } else {
                self.go_back(before.clone());
                if at_once.is_none() {
                    let none = (f64::EPSILON * stretch, part);
                    at_once = self.amplitudes_after(value, (drive, amplitude), none).ok().flatten();
                    self.go_back(before);
                    error = error_against(at_once);
                }
            }
            stretch *= (0.9 / error.sqrt()).clamp(0.1, 4.0);
        }
        Err(Error::TooMuchWear { cycles, left, amplitude: drive, steps: MOST_PIECES })
    }

    /// Amplitudes (m) that the drive would make after cycles of the contact itself at that of the
    /// start, and at the mean of that and the first of them.
    fn amplitudes_after(
        &mut self,
        value: f64,
        (drive, amplitude): (f64, f64),
        (cycles, part): (f64, Part),
    ) -> Result<Option<[f64; 2]>, Error> {
        let before = self.clone();
        let predicted = self.amplitude_after(value, (drive, amplitude), (cycles, part))?;
        if predicted == amplitude {
            return Ok(Some([amplitude; 2]));
        }
        self.go_back(before);
        let mean = 0.5 * (amplitude + predicted);
        let end = self.amplitude_after(value, (drive, mean), (cycles, part));
        Ok(end.ok().map(|end| [predicted, end]))
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
