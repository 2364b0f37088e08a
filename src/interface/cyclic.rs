//! Cyclic loading: many displacement cycles of all contacts in a few blocks.
//!
//! In a block the approach is constant, so that each contact wears by its own law of constant
//! depth. Under a constant force the approach grows by what wears. The block is run at the approach
//! of its middle, which is extrapolated from the blocks before, so that the force swings about the
//! one asked for: an error of second order in the swing. A block whose mean force is off, or whose
//! swing is too large, is run again.

use super::members::Loads;
use super::{Interface, Pose};
use crate::error::Error;
use crate::parameters::NormalControl;
use crate::range;

/// Most that the mean force of a block may be off, relative, over the tolerance.
const MEAN_ERROR: f64 = 1.0;

/// Square of the largest half swing of the force in a block, relative, over the tolerance. By the
/// tolerance of 1e-3 the swing is 1.6 %, and ten contacts of which one call wears 0.53 a² d each
/// need 19 blocks. Ten contacts in twice as many differ from one by no less: what is left, 0.8 % of
/// the volume at 64 cells and 0.25 % at 256, comes from meshes that are made again at another
/// depth.
const SWING: f64 = 0.25;

/// How much of the largest swing a block is meant to have.
const AIM: f64 = 0.8;

/// Most runs of one block at one length before it is shortened.
const MOST_TRIALS: usize = 4;

/// Most blocks of a call, run or run again.
const MOST_BLOCKS: u64 = 100_000;

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
            let approach = if at_force { this.approach_or_touch(normal)? } else { normal };
            let pose = Pose { approach, displacement: [amplitude, y], rotation: 0.0, ..this.pose };
            if at_force && normal <= 0.0 {
                this.members.start(&pose, true)?;
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
        let (most_swing, most_error) = ((SWING * tolerance).sqrt(), MEAN_ERROR * tolerance);
        let amplitude = pose.displacement[0];
        let mut loads = Loads::new();
        let mut left = cycles;
        let mut block = if self.block > 0.0 { self.block } else { cycles };
        // rates of the approach, m per cycle, of the last blocks, and their lengths
        let mut last: Option<(f64, f64)> = None;
        let mut expected = 0.0;
        let mut trials = 0;
        for _ in 0..MOST_BLOCKS {
            let length = if block >= left { left } else { block };
            let marks = self.members.marks();
            let middle = Pose { approach: pose.approach + 0.5 * expected * length, ..pose };
            let run = self.total_at(middle.approach, &mut loads).and_then(|(before, stiffness)| {
                self.members.cycle(&middle, amplitude, length)?;
                Ok((before, stiffness, self.normal_reaction()))
            });
            let (swing, error, correction) = match run {
                Ok((before, stiffness, after)) => {
                    let mean = 0.5 * (before + after) - force;
                    ((before - after).abs() / (2.0 * force), mean.abs() / force, -mean / stiffness)
                }
                // a shorter block may wear what this one cannot follow
                Err(problem) if length <= cycles * f64::EPSILON => return Err(problem),
                Err(_) => (f64::INFINITY, f64::INFINITY, 0.0),
            };
            let too_long = !(swing <= most_swing && trials < MOST_TRIALS);
            if too_long || error > most_error {
                if length <= cycles * f64::EPSILON {
                    let what = format!("{cycles:e} cycles of amplitude {amplitude:e} m");
                    let parts = (cycles / length) as u64;
                    return Err(Error::InterfaceOutrun { share: 2.0 * swing, what, parts });
                }
                self.members.return_to(&marks);
                if too_long {
                    block = length * (AIM * most_swing / swing).clamp(0.05, 0.7);
                    trials = 0;
                } else {
                    expected += 2.0 * correction / length;
                    trials += 1;
                }
                continue;
            }
            let next = self.approach_under(force, middle.approach)?.value;
            let rate = (next - pose.approach) / length;
            left -= length;
            pose.cycles += length;
            pose.approach = next;
            trials = 0;
            if left <= 0.0 {
                break;
            }
            block = length * (AIM * most_swing / swing).clamp(0.5, 2.0);
            // of the middle of the next block, on the line through those of the last two
            let slope = last.map_or(0.0, |(before, span)| 2.0 * (rate - before) / (span + length));
            expected = (rate + slope * 0.5 * (length + block.min(left))).max(0.0);
            last = Some((rate, length));
        }
        if left > 0.0 {
            let what = format!("{cycles:e} cycles of amplitude {amplitude:e} m, of which {left:e} are left");
            return Err(Error::InterfaceOutrun { share: 1.0, what, parts: MOST_BLOCKS });
        }
        self.block = block;
        self.members.cycle(&pose, amplitude, 0.0)?;
        self.pose = pose;
        Ok(())
    }
}
