//! Transient histories: straight lines in (force or approach, displacement, rotation).

use super::approach::Approach;
use super::members::{ForceChange, Loading};
use super::{Interface, Pose};
use crate::engine::{FrettingContact, MOST_PIECES, ROUNDING};
use crate::error::Error;
use crate::number::short;
use crate::parameters::NormalControl;
use crate::range;

/// Largest share of the normal force by which the wear of a part of a step may change the forces of
/// the contacts, over the tolerance, where a contact wears in several updates.
const LOST_SHARE: f64 = 4.0;

/// Most corrections of the approach after wear. Pressing wears nothing: the second finds nothing to
/// do.
const MOST_CORRECTIONS: usize = 8;

/// How a part of a step went.
enum Outcome {
    /// It is done; `easy` where a longer part would have been.
    Done { easy: bool },
    /// It has to be divided: wear changed the forces of the contacts by a share of their sum.
    TooLong { lost: f64 },
}

/// The number at a share of the way between two, the ends to the bit.
fn mix(a: f64, b: f64, share: f64) -> f64 {
    if share == 1.0 || a == b { b } else { a + share * (b - a) }
}

impl Pose {
    /// Displacement and rotation at a share of the way to another pose.
    fn towards(&self, end: &Self, share: f64) -> Self {
        let displacement = [0, 1].map(|k| mix(self.displacement[k], end.displacement[k], share));
        Self { displacement, rotation: mix(self.rotation, end.rotation, share), ..*self }
    }
}

impl Interface {
    /// Walks the straight line from the present state to a normal force (N) or approach (m), by
    /// `normal_control`, a displacement along x and y (m) and a rotation (rad).
    ///
    /// How the caller splits a line does not matter to the set tolerance.
    ///
    /// # Errors
    /// As [`crate::FrettingContact::advance_to`], of the first contact that refuses;
    /// [`Error::InterfaceOutrun`] for a step that wears more than can be followed.
    pub fn advance_to(&mut self, normal: f64, displacement: [f64; 2], rotation: f64) -> Result<(), Error> {
        self.check(normal, displacement, rotation)?;
        let same = normal == self.control
            && displacement == self.pose.displacement
            && rotation == self.pose.rotation;
        if same {
            return Ok(());
        }
        self.transaction(|this| {
            let to = Pose { approach: normal, displacement, rotation, ..this.pose };
            match this.parameters.normal_control {
                NormalControl::Indentation => this.go_to(to, &Loading::Depths)?,
                NormalControl::Force => this.walk_line(to)?,
            }
            this.control = normal;
            Ok(())
        })
    }

    /// Lifts the body off, takes it to a displacement (m) and a rotation (rad), and presses it down
    /// there, so that no contact carries a tangential force. Wear and work so far stay.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn start_at(&mut self, normal: f64, displacement: [f64; 2], rotation: f64) -> Result<(), Error> {
        self.check(normal, displacement, rotation)?;
        let mut pose = Pose { approach: normal, displacement, rotation, ..self.pose };
        self.transaction(|this| {
            let mut forces = None;
            if this.parameters.normal_control == NormalControl::Force {
                this.update_profiles()?;
                let approach = this.approach_or_touch(normal)?;
                (pose.approach, forces) = (approach.value, Some(approach.forces));
            }
            this.members.start(&pose, forces.as_deref())?;
            this.pose = pose;
            this.control = normal;
            this.settle()
        })
    }

    /// Refuses inputs that are no usable numbers.
    pub(super) fn check(&self, normal: f64, [x, y]: [f64; 2], rotation: f64) -> Result<(), Error> {
        let name = match self.parameters.normal_control {
            NormalControl::Force => "normal_force",
            NormalControl::Indentation => "indentation",
        };
        range::input(name, normal)?;
        range::input("tangential_displacement", x)?;
        range::input("tangential_displacement_y", y)?;
        range::input("rotation", rotation)
    }

    /// Walks a line in force; `to.approach` is the force at its end, N.
    fn walk_line(&mut self, to: Pose) -> Result<(), Error> {
        let (from, force) = (self.pose, to.approach);
        let start = self.control;
        // where the bodies touch or part
        let cut = (start * force < 0.0).then(|| start / (start - force));
        let ends = [cut.map(|share| (share, 0.0)), Some((1.0, force))];
        let (mut share, mut at, mut first) = (0.0, start, true);
        for (end, next) in ends.into_iter().flatten() {
            let parts = self.parts(at, next, &from.towards(&to, end))?;
            let mut begin = 0.0;
            for part in parts {
                let here = from.towards(&to, mix(share, end, part));
                self.walk_part((mix(at, next, begin), mix(at, next, part)), (here, &to), first)?;
                (begin, first) = (part, false);
            }
            (share, at) = (end, next);
        }
        Ok(())
    }

    /// Shares of a line between two forces (N) where parts end in which the approach is straight.
    ///
    /// The springs that touch in a part do so at a displacement that is off by an eighth of the
    /// relative change of the stiffness in it, times its length; the tangential force is off by a
    /// twelfth of the square of that change where all parts have the same.
    fn parts(&mut self, from: f64, to: f64, end: &Pose) -> Result<Vec<f64>, Error> {
        let moves = end.displacement != self.pose.displacement || end.rotation != self.pose.rotation;
        if !moves || from == to || (from <= 0.0 && to <= 0.0) {
            return Ok(vec![1.0]);
        }
        let before = self.normal_stiffness();
        let found = self.approach_or_touch(to)?;
        let after = found.stiffness;
        let (change, pose) = self.force_change((from, to), found.clone(), end);
        self.ahead = Some((to, found));
        if self.members.change_evenly(&self.pose, &pose, &change) {
            return Ok(vec![1.0]);
        }
        let (tolerance, largest) = (self.parameters.tolerance, after.max(before));
        // where contacts touch, the stiffness rises from 0, at first without bound: there a part as
        // short as the tolerance is short enough
        let most = largest * tolerance.sqrt().max(1.0 / f64::from(MOST_PIECES));
        let (mut done, mut ahead, mut parts) = ((0.0, before), vec![(1.0, after)], Vec::new());
        while let Some(&(share, stiffness)) = ahead.last() {
            let length: f64 = share - done.0;
            if (stiffness - done.1).abs() > most && length > tolerance {
                let middle = done.0 + 0.5 * length;
                ahead.push((middle, self.approach_or_touch(mix(from, to, middle))?.stiffness));
            } else {
                parts.push(share);
                done = (share, stiffness);
                ahead.pop();
            }
        }
        Ok(parts)
    }

    /// Walks a part of a line to a force, N; where that wears so much that the approach would have
    /// to follow within it, in shorter parts. `to` is the end of the line; `first`: the step began
    /// here.
    fn walk_part(
        &mut self,
        (from_force, force): (f64, f64),
        (end, to): (Pose, &Pose),
        first: bool,
    ) -> Result<(), Error> {
        let from = self.pose;
        let moves = end.displacement != from.displacement || end.rotation != from.rotation;
        if !self.wears() || !moves || force <= 0.0 {
            return self.press_to(force, end).map(|_| ());
        }
        let mut length = 1.0;
        if first {
            // the marks of the step serve
            let updates = self.members.updates();
            if let Outcome::Done { .. } = self.try_part(force, end, &updates)? {
                return Ok(());
            }
            self.roll_back();
            self.wear_off_at(from_force)?;
            length = 0.5;
        }
        let (mut done, mut is_worn_off, shortest) = (0.0, first, 1.0 / f64::from(MOST_PIECES));
        while done < 1.0 {
            let share: f64 = if done + length >= 1.0 { 1.0 } else { done + length };
            let pose = self.pose;
            let marks = self.members.marks();
            let load = mix(from_force, force, share);
            let updates = self.members.updates();
            match self.try_part(load, from.towards(&end, share), &updates)? {
                Outcome::Done { easy } => {
                    (done, is_worn_off) = (share, false);
                    if easy {
                        length *= 2.0;
                    }
                }
                Outcome::TooLong { lost } if is_worn_off && length <= shortest => {
                    let [x, y] = to.displacement;
                    let what = format!(
                        "to displacement ({}, {}) m, rotation {} rad",
                        short(x),
                        short(y),
                        short(to.rotation)
                    );
                    return Err(Error::InterfaceOutrun { share: lost, what, parts: MOST_PIECES.into() });
                }
                Outcome::TooLong { lost } => {
                    self.members.return_to(&marks);
                    self.pose = pose;
                    // what parts before have left to wear does not fall with the length
                    if !is_worn_off {
                        self.wear_off_at(mix(from_force, force, done))?;
                        is_worn_off = true;
                    }
                    // what is lost grows with the length
                    let shorter = (0.7 * self.most_lost() / lost).clamp(1.0 / 16.0, 0.5);
                    length = (length * shorter).max(shortest);
                }
            }
        }
        Ok(())
    }

    /// Lets all profiles follow what has slipped so far, and the approach their wear at a force, N.
    fn wear_off_at(&mut self, force: f64) -> Result<(), Error> {
        self.update_profiles()?;
        self.follow(force).map(|_| ())
    }

    /// Share of the force by which the wear of one part of a step may change those of the contacts.
    fn most_lost(&self) -> f64 {
        LOST_SHARE * self.parameters.tolerance
    }

    /// Walks a part of a line. `updates` are those of the contacts before it.
    fn try_part(&mut self, force: f64, end: Pose, updates: &[u64]) -> Result<Outcome, Error> {
        let lost = match self.press_to(force, end) {
            Ok(lost) => lost,
            // a shorter part may wear what this one cannot follow
            Err(Error::InContact { problem, .. })
                if matches!(*problem, Error::WearOutrun { .. } | Error::TooMuchWear { .. }) =>
            {
                return Ok(Outcome::TooLong { lost: 1.0 });
            }
            Err(other) => return Err(other),
        };
        let limit = self.most_lost();
        // a single update wears what has been gathered at the held force
        if lost > limit && self.members.most_updates_since(updates) > 1 {
            return Ok(Outcome::TooLong { lost });
        }
        Ok(Outcome::Done { easy: lost < 0.5 * limit })
    }

    /// Takes all contacts straight to where they carry a force (N), and lets the approach follow
    /// their wear. Returns the share of the force by which that changed their forces.
    fn press_to(&mut self, force: f64, end: Pose) -> Result<f64, Error> {
        let ahead = self.ahead.take();
        if self.carries(force) {
            self.go_to(Pose { approach: self.pose.approach, ..end }, &Loading::Held)?;
        } else {
            let approach = match ahead {
                Some((ahead, approach)) if ahead == force => approach,
                _ => self.approach_or_touch(force)?,
            };
            let (change, end) = self.force_change((self.normal_reaction(), force), approach, &end);
            self.go_to(end, &Loading::Forces(change))?;
        }
        self.follow(force)
    }

    /// The change of the normal force (N) to an approach, and the pose there.
    fn force_change(&self, (from, to): (f64, f64), approach: Approach, end: &Pose) -> (ForceChange, Pose) {
        let most_change = self.parameters.tolerance.sqrt();
        let change =
            ForceChange { total: (from.max(0.0), to.max(0.0)), forces: approach.forces, most_change };
        (change, Pose { approach: approach.value, ..*end })
    }

    /// Whether the contacts carry a force (N) where they are.
    fn carries(&self, force: f64) -> bool {
        force > 0.0 && (self.normal_reaction() - force).abs() <= ROUNDING * force
    }

    /// First guess of the approach under a force, N.
    pub(super) fn guess(&self, force: f64) -> f64 {
        let (approach, stiffness) = self.members.mean_approach();
        let guess = approach + (force - self.normal_reaction()) / stiffness;
        if guess.is_finite() { guess } else { f64::NEG_INFINITY }
    }

    /// The approach under a force, N; that of first touch where there is none.
    pub(super) fn approach_or_touch(&self, force: f64) -> Result<Approach, Error> {
        if force > 0.0 {
            return self.approach_under(force, self.guess(force));
        }
        let forces = vec![0.0; self.summits().len()];
        Ok(Approach { value: self.members.first_touch(), stiffness: 0.0, forces })
    }

    fn go_to(&mut self, to: Pose, loading: &Loading) -> Result<(), Error> {
        self.members.advance(&self.pose, &to, loading)?;
        self.pose = to;
        Ok(())
    }

    /// Updates the profiles of all contacts, under force control each at its force.
    pub(super) fn update_profiles(&mut self) -> Result<(), Error> {
        if self.parameters.normal_control == NormalControl::Force {
            self.members.update_profiles(&self.pose)?;
        }
        Ok(())
    }

    /// After a change of the profiles at rest: the approach follows under force control.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        if self.parameters.normal_control == NormalControl::Force {
            self.follow(self.control)?;
        }
        Ok(())
    }

    /// Presses the contacts to a common approach under which they carry a force, N. Returns the
    /// share of it by which their forces differ from those before.
    pub(super) fn follow(&mut self, force: f64) -> Result<f64, Error> {
        if !self.wears() {
            return Ok(0.0);
        }
        if force <= 0.0 {
            // profiles that have worn on the way touch at another approach
            let touch = self.members.first_touch();
            if touch != self.pose.approach {
                self.members.lift_to(&self.pose, touch)?;
                self.pose.approach = touch;
            }
            return Ok(0.0);
        }
        let mut exchanged = None;
        for _ in 0..MOST_CORRECTIONS {
            if self.carries(force) && self.members.misfit(self.pose.approach) <= ROUNDING * force {
                break;
            }
            let approach = self.approach_under(force, self.guess(force))?;
            if exchanged.is_none() {
                let change = |(index, contact): (usize, &FrettingContact)| {
                    (approach.forces[index] - contact.normal_reaction()).abs()
                };
                exchanged = Some(self.members.touched().map(change).sum::<f64>() / force);
            }
            self.members.press(&self.pose, approach.value)?;
            self.pose.approach = approach.value;
        }
        Ok(exchanged.unwrap_or(0.0))
    }
}
