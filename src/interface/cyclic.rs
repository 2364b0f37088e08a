//! Cyclic loading: many displacement cycles of all contacts in a few blocks.
//!
//! At a constant approach each contact wears by its own law of constant depth. Under a constant
//! force the approach grows by what wears, and the contacts exchange load. In a block each contact
//! wears by its law of constant force, at the mean of its forces before and after: an error of
//! second order in the change of its force. These means are extrapolated from the block before; a
//! block whose means are off, or in which too much load is exchanged, is run again. Both are
//! measured twice: over the total force, and over the force of each contact, weighted by its part
//! in all work so far, since a contact of little force may wear most. Equal contacts exchange none:
//! they are one contact with its share of the force.

use super::{Interface, Pose};
use crate::engine::MOST_PIECES;
use crate::error::Error;
use crate::number::short;
use crate::parameters::NormalControl;
use crate::range;

/// Square of the largest share of the force that contacts exchange in a block, over the tolerance.
const SHARE: f64 = 0.25;

/// Largest mean square of the relative changes of the forces in a block, over the tolerance; the
/// weight of a contact is its work in the block over the work of all so far. Without this bound V
/// of two contacts of unequal height was up to 6.7 times the right one. With half of it and with
/// twice the largest error of V of 100 random joints is 7.6e-3 and 7.9e-3 instead of 6.3e-3.
const CHANGE: f64 = 0.01;

/// How much of the largest change a block is meant to have.
const AIM: f64 = 0.8;

/// Most runs of one block at one length before it is shortened.
const MOST_TRIALS: usize = 4;

/// The load that contacts exchange in a block.
#[derive(Default)]
struct Exchange {
    /// Over the total force.
    share: f64,
    /// Mean square of the relative changes of the forces, weighted by the parts in the work.
    change: f64,
    /// By how much the means were off: over the total force, or relative and weighted like the
    /// changes, whichever is larger.
    error: f64,
}

impl Exchange {
    /// From the forces of the contacts before, after and in a block, N, and their work before and
    /// after it, J.
    fn new(
        total: f64,
        (before, after, mean): (&[f64], &[f64], &[f64]),
        (work_before, work_after): (&[f64], &[f64]),
    ) -> Self {
        let all_work: f64 = work_after.iter().sum();
        let mut exchange = Self::default();
        let mut error_by_work = 0.0;
        for k in 0..mean.len() {
            let (change, error) = (after[k] - before[k], 0.5 * (before[k] + after[k]) - mean[k]);
            exchange.share += change.abs() / total;
            exchange.error += error.abs() / total;
            let work = work_after[k] - work_before[k];
            if work > 0.0 {
                let (part, largest) = (work / all_work, before[k].max(after[k]).max(mean[k]));
                exchange.change += part * (change / largest).powi(2);
                error_by_work += part * error.abs() / largest;
            }
        }
        exchange.error = exchange.error.max(error_by_work);
        exchange
    }

    /// The load that is exchanged, over the largest at this tolerance.
    fn change_over_largest(&self, tolerance: f64) -> f64 {
        let by_share = 0.5 * self.share / (SHARE * tolerance).sqrt();
        // work and forces change with the length of a block, so their product with its cube
        by_share.max((self.change / (CHANGE * tolerance)).cbrt())
    }
}

impl Interface {
    /// Runs `cycles` (≥ 0, need not be whole) displacement cycles between ±`amplitude` (m) along x
    /// of all contacts, at a constant normal force (N) or approach (m). Afterwards the body stands
    /// at `amplitude`, and [`Self::tangential_force`] is the amplitude of T.
    ///
    /// # Errors
    /// As [`crate::FrettingContact::advance_cycles`]; [`Error::Input`] also where the body is
    /// turned.
    pub fn advance_cycles(&mut self, normal: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        let [_, y] = self.pose.displacement;
        self.check(normal, [amplitude, y], self.pose.rotation)?;
        let requirement = "it has to be finite and not negative, at most 1e60 m and 1e30 cycles";
        for (name, value, most) in
            [("displacement_amplitude", amplitude, range::MOST_INPUT), ("cycles", cycles, range::MOST_CYCLES)]
        {
            if !(0.0..=most).contains(&value) {
                return Err(Error::Input { name, value, requirement });
            }
        }
        if self.pose.rotation != 0.0 {
            let requirement = "cycles run along x at rotation 0: turn the body back first";
            return Err(Error::Input { name: "rotation", value: self.pose.rotation, requirement });
        }
        self.transaction(|this| {
            let at_force = this.parameters.normal_control == NormalControl::Force;
            let under = if at_force { Some(this.approach_or_touch(normal)?) } else { None };
            let approach = under.as_ref().map_or(normal, |under| under.value);
            let pose = Pose { approach, displacement: [amplitude, y], rotation: 0.0, ..this.pose };
            if let Some(apart) = under.filter(|_| normal <= 0.0) {
                this.members.start(&pose, Some(&apart.forces))?;
                this.pose = Pose { cycles: pose.cycles + cycles, ..pose };
            } else if at_force && this.wears() && cycles > 0.0 {
                this.run_blocks(normal, pose, cycles)?;
            } else {
                this.members.cycle(&pose, amplitude, cycles)?;
                this.pose = Pose { cycles: pose.cycles + cycles, ..pose };
            }
            this.control = normal;
            Ok(())
        })
    }

    /// Cycles at a constant force, N, from the approach of a pose on.
    fn run_blocks(&mut self, force: f64, mut pose: Pose, cycles: f64) -> Result<(), Error> {
        let tolerance = self.parameters.tolerance;
        let amplitude = pose.displacement[0];
        let mut before = self.approach_under(force, pose.approach)?.forces;
        let mut left = cycles;
        let mut block = if self.block > 0.0 { self.block } else { cycles };
        // by how much the forces are expected to change in the block, N
        let mut expected = vec![0.0; before.len()];
        let mut trials = 0;
        let mut exchange = Exchange::default();
        // blocks that are run again count as well
        for _ in 0..MOST_PIECES {
            let length = if block >= left { left } else { block };
            let (marks, work) = (self.members.marks(), self.members.work());
            let mean: Vec<f64> =
                before.iter().zip(&expected).map(|(force, change)| (force + 0.5 * change).max(0.0)).collect();
            let run = self.members.cycle_at_forces(&pose, &mean, amplitude, length).and_then(|()| {
                let next = self.approach_under(force, self.guess(force))?;
                Ok((next.value, next.forces))
            });
            let (change, error) = match &run {
                Ok((_, after)) => {
                    let work = (&work[..], &self.members.work()[..]);
                    exchange = Exchange::new(force, (&before, after, &mean), work);
                    (exchange.change_over_largest(tolerance), exchange.error)
                }
                Err(_) => (f64::INFINITY, f64::INFINITY),
            };
            match run {
                Ok((next, after)) if change <= 1.0 && error <= tolerance => {
                    left -= length;
                    pose.cycles += length;
                    pose.approach = next;
                    trials = 0;
                    if left <= 0.0 {
                        // contacts that exchange nothing are as one: no need for blocks
                        block = if change == 0.0 { f64::MAX } else { block };
                        break;
                    }
                    block = length * (AIM / change).clamp(0.5, 2.0);
                    let growth = block.min(left) / length;
                    expected =
                        after.iter().zip(&before).map(|(after, before)| growth * (after - before)).collect();
                    before = after;
                }
                // a shorter block may wear what this one cannot follow
                Err(problem) if length <= cycles * f64::EPSILON => return Err(problem),
                run => {
                    if length <= cycles * f64::EPSILON {
                        let what = format!("{} cycles of amplitude {} m", short(cycles), short(amplitude));
                        let parts = (cycles / length) as u64;
                        return Err(Error::InterfaceOutrun { share: exchange.share, what, parts });
                    }
                    self.members.return_to(&marks);
                    match run {
                        Ok((_, after)) if change <= 1.0 && trials < MOST_TRIALS => {
                            expected =
                                after.iter().zip(&before).map(|(after, before)| after - before).collect();
                            trials += 1;
                        }
                        _ => {
                            let shorter = (AIM / change).clamp(0.05, 0.7);
                            expected.iter_mut().for_each(|change| *change *= shorter);
                            block = length * shorter;
                            trials = 0;
                        }
                    }
                }
            }
        }
        if left > 0.0 {
            let what = format!(
                "{} cycles of amplitude {} m, of which {} are left",
                short(cycles),
                short(amplitude),
                short(left)
            );
            return Err(Error::InterfaceOutrun { share: exchange.share, what, parts: MOST_PIECES.into() });
        }
        self.block = block;
        self.members.end_cycles(&pose, amplitude, force)?;
        self.pose = pose;
        Ok(())
    }
}
