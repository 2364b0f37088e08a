//! Stretches of a transient history that are nothing but steady cycles, or sliding onward, at constant load.
//!
//! What such a stretch wears is known as a law of time, [`crate::wear::live`], whatever the steps that made it up: the profile is
//! brought up to date by integrating that, with its error control, for as many cycles as have passed. So stepping through
//! cycles and asking for cycles give the same, and a cycle costs a comparison.

use super::FrettingContact;
use super::history::STROKE;
use super::snapshot::is_contact;
use crate::error::Error;
use crate::friction::Springs;
use crate::surface::{Contact, FrontWay, Nodes};
use crate::wear::{Edge, Pending, Sliding, Steady, annulus, pressure_nodes};
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

impl Rhythm {
    /// Whether it is one that a motion could keep to.
    pub(super) fn is_sound(&self) -> bool {
        let positive = |value: f64| value >= 0.0 && value.is_finite();
        is_contact(&self.contact) && positive(self.amplitude) && positive(self.half_work)
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= STEADY * b.abs()
}

/// Nodes inside a contact below which an update makes more.
const LEAST_NODES: usize = 8;

impl FrettingContact {
    /// What the segment is of a steady motion: half a cycle or, from rest, its first quarter, or sliding onward.
    pub(super) fn steady_segment(&mut self) -> Option<Steady> {
        let wear = self.wear.as_ref()?;
        let segment = &wear.segment;
        let (work, moved) = (segment.work, self.displacement - segment.start);
        if segment.contact != Some(self.contact) || work == 0.0 {
            return None;
        }
        if segment.sliding == moved.signum() {
            // short slides amid other strokes are not worth laying a mesh for
            let repeated = self.surface.worn().is_none_or(|nodes| nodes.mesh().is_some());
            return Some(Steady { sliding: Sliding::Onward, amount: moved.abs(), work, repeated });
        }
        let in_rhythm = self.half_cycle_in_rhythm();
        if in_rhythm.is_some() {
            return in_rhythm;
        }
        let contact = self.contact;
        // on the unworn body nothing speaks against it
        let repeated = self.surface.worn().is_none();
        // a quarter of a cycle dissipates a fourth of its work
        let shares = [(0.5, 0.5 * moved.abs()), (0.25, moved.abs())];
        shares.into_iter().find_map(|(amount, amplitude)| {
            let (springs, quarter_work) = self.quarter(&contact, amplitude);
            near(4.0 * amount * quarter_work, work).then(|| {
                self.set_rhythm(Some(self.rhythm_of(contact, amplitude, &springs, quarter_work)));
                Steady { sliding: Sliding::Cycles(amplitude), amount, work, repeated }
            })
        })
    }

    /// The segment, where it is half a cycle of the rhythm that the motion keeps to.
    pub(super) fn half_cycle_in_rhythm(&self) -> Option<Steady> {
        let wear = self.wear.as_ref()?;
        let (segment, rhythm) = (&wear.segment, wear.rhythm?);
        let (work, moved) = (segment.work, self.displacement - segment.start);
        (work > 0.0
            && segment.contact == Some(self.contact)
            && rhythm.contact == self.contact
            && segment.sliding != moved.signum()
            && near(0.5 * moved.abs(), rhythm.amplitude)
            && near(work, rhythm.half_work))
        .then_some(Steady { sliding: Sliding::Cycles(rhythm.amplitude), amount: 0.5, work, repeated: true })
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
            repeated: true,
        })
    }

    /// The rhythm of an amplitude, from its springs at the end of a first quarter and their work, J.
    fn rhythm_of(&self, contact: Contact, amplitude: f64, springs: &Springs, quarter_work: f64) -> Rhythm {
        let stick = springs.stick_radius(&contact, self.constants.bound_slope(), amplitude);
        let half_work = 2.0 * quarter_work;
        let volume = self.constants.wear_per_work * half_work;
        let calm =
            volume <= STROKE * self.parameters.tolerance * annulus(&contact, stick) * contact.depth.abs();
        Rhythm { contact, amplitude, half_work, calm }
    }

    /// Whether `work` (J) more keeps the segment within half a cycle after which there is time enough for the profile to follow.
    pub(super) fn keeps_calm(&self, contact: &Contact, work: f64) -> bool {
        self.wear.is_none() || (self.contact == *contact && work <= self.calm_work())
    }

    /// Work (J) that the segment may still do within such a half cycle at the present load; below 0 where it is in none.
    pub(super) fn calm_work(&self) -> f64 {
        let Some(wear) = &self.wear else { return f64::MAX };
        let segment = &wear.segment;
        match &wear.rhythm {
            Some(rhythm)
                if rhythm.calm && rhythm.contact == self.contact && segment.contact == Some(self.contact) =>
            {
                rhythm.half_work * (1.0 + STEADY) - segment.work
            }
            _ => -1.0,
        }
    }

    pub(super) fn set_rhythm(&mut self, rhythm: Option<Rhythm>) {
        if let Some(wear) = &mut self.wear {
            wear.rhythm = rhythm;
        }
    }

    /// Whether a segment is taken for part of a steady motion: one seen twice, or one that nothing yet speaks against.
    pub(super) fn is_steady(&self, segment: &Steady) -> bool {
        let pending = self.wear.as_ref().map(|wear| &wear.pending);
        segment.repeated || pending.is_some_and(Pending::is_empty)
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
            let work = segment.work + wear.pending.take_unplaced(segment.work);
            match &mut wear.pending.steady {
                Some(steady) => {
                    steady.amount += segment.amount;
                    steady.work += work;
                    steady.repeated = true;
                }
                none => *none = Some(Steady { work, ..segment }),
            }
        }
        self.start_segment();
        Ok(())
    }

    /// Wears a steady motion off by its law of time. What has not been seen twice, and what cannot be followed on a profile that
    /// histories of another kind have left rough at the contact edge, becomes pending like these, for a single implicit
    /// update: `false`.
    pub(super) fn live_through(&mut self, steady: Steady) -> Result<bool, Error> {
        if !steady.repeated {
            self.spread(steady);
            return Ok(false);
        }
        match self.wear_by(self.contact.control, (steady.sliding, None), steady.amount, Some(steady.work)) {
            Ok(_) => Ok(true),
            Err(Error::TooMuchWear { .. } | Error::NotFinite { .. }) => {
                self.spread(steady);
                Ok(false)
            }
            Err(other) => Err(other),
        }
    }

    /// Work per area and slip path of a steady motion at the nodes of the surface as it is.
    pub(super) fn spread(&mut self, steady: Steady) {
        let (contact, bound_slope) = (self.contact, self.constants.bound_slope());
        let profile = self.surface.profile();
        let stick = match steady.sliding {
            Sliding::Onward => 0.0,
            Sliding::Cycles(amplitude) => {
                let depth = contact.depth - amplitude / bound_slope;
                if depth > self.surface.tip() {
                    self.surface.radius_of_image(depth, 0.0, contact.radius)
                } else {
                    0.0
                }
            }
        };
        match self.surface.worn() {
            None => {
                self.move_to_nodes(Nodes::around(profile, self.parameters.resolution, contact.radius, stick));
            }
            // those of an earlier contact may end inside this one, or have no cells for one that is far smaller
            Some(nodes)
                if nodes.x()[nodes.last()] <= contact.radius
                    || nodes.x().partition_point(|x| *x < contact.radius) < LEAST_NODES =>
            {
                let mut adapted = nodes.clone();
                adapted.adapt(profile, contact.radius, (stick, FrontWay::Returns));
                self.move_to_nodes(adapted);
            }
            Some(_) => {}
        }
        let outer = self.surface.profile().outer_radius();
        let (Some(wear), Some(nodes)) = (&mut self.wear, self.surface.worn()) else { return };
        let (transforms, made) = wear.transforms.get(nodes);
        let room: Vec<f64> =
            nodes.x().iter().map(|x| (contact.depth - self.surface.image(*x)).max(0.0)).collect();
        let load: Vec<f64> = room.iter().map(|q| self.constants.normal_modulus * q).collect();
        let pressure = pressure_nodes(&transforms, nodes.x(), &load, &Edge::new(nodes, &contact, outer));
        let friction = self.constants.friction_coefficient;
        let traction: Vec<f64> = pressure.iter().map(|p| friction * p).collect();
        let path: Vec<f64> = match steady.sliding {
            Sliding::Onward => vec![steady.amount; room.len()],
            Sliding::Cycles(amplitude) => {
                let slip: Vec<f64> = room
                    .iter()
                    .zip(nodes.x())
                    .map(|(q, x)| if *x > stick { (amplitude - bound_slope * q).max(0.0) } else { 0.0 })
                    .collect();
                transforms.descend(&slip).iter().map(|s| 4.0 * steady.amount * s.max(0.0)).collect()
            }
        };
        wear.transform_defect += wear.pending.add(nodes, &contact, (&traction, &path), steady.work, f64::MAX);
        self.counters.transform_tables += u64::from(made);
        self.counters.pressure_transforms += 1;
        self.counters.descent_transforms += 1;
    }

    /// Takes the rhythm of cycles on the present surface, for the next stroke to be held against. Returns their springs at the
    /// end of a first quarter.
    pub(super) fn expect_cycles(&mut self, amplitude: f64) -> Springs {
        let contact = self.contact;
        let (springs, quarter_work) = self.quarter(&contact, amplitude);
        self.set_rhythm(Some(self.rhythm_of(contact, amplitude, &springs, quarter_work)));
        springs
    }

    /// Puts the slipping springs where a steady cycle has them at its end, on a surface that has just worn. Those that stuck
    /// all the time keep what they remember: the cycle need not be about the place where they are relaxed.
    pub(super) fn rest_at_reversal(&mut self, amplitude: f64, stick_before: f64) {
        let mut springs = self.expect_cycles(amplitude);
        let front = springs.stick_radius(&self.contact, self.constants.bound_slope(), amplitude);
        springs.moved_by(self.direction, amplitude, self.displacement);
        self.springs.take_outer(front.min(stick_before), &springs);
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
        let slack = 2.0 * self.constants.bound_slope() * (self.contact.depth - self.surface.tip());
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
        self.wear_steadily(value, Sliding::Onward, moved.abs())?;
        let to = self.contact;
        let (mut springs, _) = self.quarter(&to, 0.0);
        springs.follow_bound((0.0, moved.signum()), &to, self.constants.bound_slope(), displacement);
        self.arrive(to, displacement, springs, 0.0);
        self.start_segment();
        Ok(())
    }
}
