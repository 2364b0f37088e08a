//! Stretches of a transient history that are nothing but steady cycles, or sliding onward, at constant load.
//!
//! What such a stretch wears is known as a law of time, [`crate::wear::live`], whatever the steps that made it up: the profile is
//! brought up to date by integrating that, with its error control, for as many cycles as have passed. So stepping through
//! cycles and asking for cycles give the same, and a cycle costs a comparison.

use super::FrettingContact;
use super::history::STROKE;
use crate::error::Error;
use crate::friction::Springs;
use crate::surface::Contact;
use crate::wear::{Sliding, Steady};
use serde::{Deserialize, Serialize};

/// How near to a steady cycle's a segment's amplitude and work have to be, relative, to be taken for one.
const STEADY: f64 = 1e-6;

/// The cycle that the motion keeps to at the present load.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Rhythm {
    contact: Contact,
    amplitude: f64,
    /// Work of half a cycle, J.
    half_work: f64,
    /// Whether half a cycle wears so little that the profile need not follow amid it.
    calm: bool,
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= STEADY * b.abs()
}

impl FrettingContact {
    /// What the segment is of a steady motion: half a cycle or, from rest, its first quarter, or sliding onward.
    pub(super) fn steady_segment(&mut self) -> Option<Steady> {
        let wear = self.wear.as_ref()?;
        let (segment, rhythm) = (&wear.segment, wear.rhythm);
        let (work, moved) = (segment.work, self.displacement - segment.start);
        if segment.contact != Some(self.contact) || work == 0.0 {
            return None;
        }
        if segment.sliding == moved.signum() {
            return Some(Steady { sliding: Sliding::Onward, amount: moved.abs(), work });
        }
        let contact = self.contact;
        if let Some(rhythm) = rhythm
            && rhythm.contact == contact
            && near(0.5 * moved.abs(), rhythm.amplitude)
            && near(work, rhythm.half_work)
        {
            return Some(Steady { sliding: Sliding::Cycles(rhythm.amplitude), amount: 0.5, work });
        }
        // a quarter of a cycle dissipates a fourth of its work
        let shares = [(0.5, 0.5 * moved.abs()), (0.25, moved.abs())];
        shares.into_iter().find_map(|(amount, amplitude)| {
            let (springs, quarter_work) = self.quarter(&contact, amplitude);
            near(4.0 * amount * quarter_work, work).then(|| {
                self.set_rhythm(Some(self.rhythm_of(contact, amplitude, &springs, quarter_work)));
                Steady { sliding: Sliding::Cycles(amplitude), amount, work }
            })
        })
    }

    /// The part of a steady half cycle that an unfinished segment is, by its work.
    pub(super) fn begun_half_cycle(&self) -> Option<Steady> {
        let wear = self.wear.as_ref()?;
        let rhythm = wear.rhythm.filter(|rhythm| rhythm.contact == self.contact)?;
        let segment = &wear.segment;
        let share = segment.work / rhythm.half_work;
        (segment.contact == Some(self.contact) && share > 0.0 && share <= 1.0 + STEADY).then_some(Steady {
            sliding: Sliding::Cycles(rhythm.amplitude),
            amount: 0.5 * share,
            work: segment.work,
        })
    }

    /// The rhythm of an amplitude, from its springs at the end of a first quarter and their work, J.
    fn rhythm_of(&self, contact: Contact, amplitude: f64, springs: &Springs, quarter_work: f64) -> Rhythm {
        let stick = springs.stick_radius(&contact, self.constants.bound_slope(), amplitude);
        let half_work = 2.0 * quarter_work;
        let volume = self.constants.wear_per_work * half_work;
        let annulus = std::f64::consts::PI * (contact.radius - stick) * (contact.radius + stick);
        let calm = volume <= STROKE * self.parameters.tolerance * annulus * contact.depth.abs();
        Rhythm { contact, amplitude, half_work, calm }
    }

    /// Whether `work` (J) more keeps the segment within half a cycle after which there is time enough for the profile to follow.
    pub(super) fn keeps_calm(&self, contact: &Contact, work: f64) -> bool {
        let Some(wear) = &self.wear else { return true };
        let segment = &wear.segment;
        wear.rhythm.is_some_and(|rhythm| {
            rhythm.calm
                && rhythm.contact == *contact
                && segment.contact == Some(*contact)
                && segment.work + work <= rhythm.half_work * (1.0 + STEADY)
        })
    }

    pub(super) fn set_rhythm(&mut self, rhythm: Option<Rhythm>) {
        if let Some(wear) = &mut self.wear {
            wear.rhythm = rhythm;
        }
    }

    /// Counts a steady segment, after what is pending of another kind has been worn off.
    pub(super) fn add_steady(&mut self, segment: Steady) -> Result<(), Error> {
        let Some(wear) = &self.wear else { return Ok(()) };
        let like = |present: &Steady| match (present.sliding, segment.sliding) {
            (Sliding::Cycles(a), Sliding::Cycles(b)) => near(a, b),
            (a, b) => a == b,
        };
        if wear.pending.work > 0.0 || wear.pending.steady.is_some_and(|steady| !like(&steady)) {
            self.update_under_segment()?;
        }
        if let Some(wear) = &mut self.wear {
            let work = segment.work + std::mem::take(&mut wear.pending.unplaced);
            match &mut wear.pending.steady {
                Some(steady) => {
                    steady.amount += segment.amount;
                    steady.work += work;
                }
                none => *none = Some(Steady { work, ..segment }),
            }
        }
        self.start_segment();
        Ok(())
    }

    /// Puts the springs where a steady cycle has them at its end, on a surface that has just worn.
    pub(super) fn rest_at_reversal(&mut self, amplitude: f64) {
        let contact = self.contact;
        let (mut springs, quarter_work) = self.quarter(&contact, amplitude);
        self.set_rhythm(Some(self.rhythm_of(contact, amplitude, &springs, quarter_work)));
        springs.moved_by(self.direction, amplitude, self.displacement);
        self.springs = springs;
        self.start_segment();
    }

    /// Displacement at which all springs slip, on a line at constant load that goes on so far beyond it that the wear
    /// matters.
    pub(super) fn onset_of_long_slide(&self, value: f64, displacement: f64) -> Option<f64> {
        self.wear.as_ref()?;
        if value != self.contact.control || self.contact.is_open() {
            return None;
        }
        let move_on = displacement - self.displacement;
        let slack = 2.0 * self.constants.bound_slope() * (self.contact.depth - self.surface.image(0.0));
        // a body worn flat slips everywhere at once
        if slack <= 0.0 || move_on.abs() <= 2.0 * slack {
            return None;
        }
        let friction = self.constants.friction_coefficient * self.normal_reaction();
        let volume = self.constants.wear_per_work * friction * (move_on.abs() - slack);
        self.exceeds_limit(volume, &self.contact, 0.0)?;
        Some(self.displacement + slack * (1.0 + 1e-9) * move_on.signum())
    }

    /// Slides on at constant load, all springs slipping already, to a displacement.
    pub(super) fn slide_on(&mut self, displacement: f64) -> Result<(), Error> {
        self.settle()?;
        let value = self.contact.control;
        let moved = displacement - self.displacement;
        let work = self.wear_by(value, Sliding::Onward, moved.abs(), None)?;
        let to = self.contact_at(value)?;
        let (mut springs, _) = self.quarter(&to, 0.0);
        springs.follow_bound((0.0, moved.signum()), &to, self.constants.bound_slope(), displacement);
        self.arrive(to, displacement, springs, work);
        self.start_segment();
        Ok(())
    }
}
