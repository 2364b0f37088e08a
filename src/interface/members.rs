//! The contacts of an interface: those that have touched, and what the others have in common.
//!
//! Each contact is advanced by itself, so that several threads may do it; sums are taken in one
//! order, so that their number changes no bit.

use super::Pose;
use super::summit::Summit;
use crate::engine::{FrettingContact, Mark, Memory, Model, Models, ROUNDING, unworn_load};
use crate::error::Error;
use crate::parameters::{NormalControl, Parameters};
use crate::profile::Profile;
use std::collections::HashMap;
use std::sync::Arc;

/// Contacts that a thread takes at a time.
#[cfg(feature = "threads")]
const CHUNK: usize = 32;

/// A contact that has touched, or its place.
type Slot = Option<Box<FrettingContact>>;

/// States to return to, of those contacts that have touched, by rising number.
pub(super) type Marks = Vec<(usize, Mark)>;

/// All contacts.
#[derive(Debug, Clone)]
pub(super) struct Members {
    /// Those of every contact; between two calls it is held at its depth.
    models: Models,
    summits: Arc<[Summit]>,
    /// Contacts by rising offset.
    order: Arc<[u32]>,
    profiles: Arc<[Arc<Profile>]>,
    slots: Vec<Slot>,
    /// Whether several threads advance the contacts.
    #[cfg(feature = "threads")]
    pub(super) in_threads: bool,
}

/// How the contacts carry the normal force along a part of a step.
pub(super) enum Loading {
    /// Each at its depth under the approach.
    Depths,
    /// Each with the force that it carries.
    Held,
    /// Under a force that changes.
    Forces(ForceChange),
}

/// A straight line in the normal force.
#[derive(Debug, Clone)]
pub(super) struct ForceChange {
    /// The force before and after, N; 0 where the bodies are apart.
    pub(super) total: (f64, f64),
    /// Of each contact after it, N.
    pub(super) forces: Vec<f64>,
    /// Largest change of the share of a contact that counts as none, relative.
    pub(super) most_change: f64,
}

impl ForceChange {
    /// Whether a contact that carries a force (N) before carries a share of the force that hardly
    /// changes, from its first touch on where the bodies touch or part: then its force follows a
    /// straight line, and else nearly its depth does. `depths` are those before and after beyond
    /// the depth of touch, m.
    fn is_even(&self, (before, index): (f64, usize), depths: (f64, f64)) -> bool {
        let after = self.forces[index];
        let touches =
            |force: f64, depth: f64| force > 0.0 || depth >= -ROUNDING * depths.0.abs().max(depths.1.abs());
        let (a, b) = (before * self.total.1, after * self.total.0);
        touches(before, depths.0) && touches(after, depths.1) && (a - b).abs() <= self.most_change * a.max(b)
    }
}

/// Normal force (N) and contact radius (m) of all contacts in turn at one approach.
pub(super) type Loads = Vec<(f64, f64)>;

impl Members {
    pub(super) fn new(parameters: &Parameters, summits: &[Summit]) -> Result<Self, Error> {
        // the body of an ellipse is its equivalent sphere
        let (models, body) = models(parameters)?;
        // bodies of one size share their profile
        let mut sizes: HashMap<u64, Arc<Profile>> = HashMap::new();
        let mut profiles = Vec::with_capacity(summits.len());
        for (index, summit) in summits.iter().enumerate() {
            let refuse = |problem| Error::InContact { contact: index + 1, problem: Box::new(problem) };
            let profile = match sizes.get(&summit.radius_factor.to_bits()) {
                Some(profile) => profile.clone(),
                None => {
                    let scaled = match summit.radius_factor {
                        1.0 => body.clone(),
                        factor => body.scaled(factor).map_err(refuse)?,
                    };
                    let profile = Arc::new(scaled);
                    sizes.insert(summit.radius_factor.to_bits(), profile.clone());
                    profile
                }
            };
            profiles.push(profile);
        }
        let mut order: Vec<u32> = (0..summits.len() as u32).collect();
        order.sort_by(|a, b| summits[*a as usize].offset.total_cmp(&summits[*b as usize].offset));
        Ok(Self {
            models,
            order: order.into(),
            profiles: profiles.into(),
            slots: vec![None; summits.len()],
            summits: summits.into(),
            #[cfg(feature = "threads")]
            in_threads: true,
        })
    }

    pub(super) fn summits(&self) -> &[Summit] {
        &self.summits
    }

    /// Lowest offset first.
    pub(super) fn first(&self) -> usize {
        self.order[0] as usize
    }

    /// The unworn profile of a contact.
    pub(super) fn profile(&self, index: usize) -> &Arc<Profile> {
        &self.profiles[index]
    }

    pub(super) fn get(&self, index: usize) -> Option<&FrettingContact> {
        self.slots.get(index)?.as_deref()
    }

    /// Contacts that have touched, with their numbers from 0.
    pub(super) fn touched(&self) -> impl Iterator<Item = (usize, &FrettingContact)> {
        self.slots.iter().enumerate().filter_map(|(index, slot)| Some((index, slot.as_deref()?)))
    }

    /// Puts a contact in its place.
    pub(super) fn put(&mut self, index: usize, contact: Option<FrettingContact>) {
        self.slots[index] = contact.map(Box::new);
    }

    /// A contact that has not touched, as it stands in a pose.
    pub(super) fn untouched(&self, index: usize, pose: &Pose) -> FrettingContact {
        untouched(&self.models.at_depth, &self.profiles[index], &self.summits[index], pose)
    }

    /// Gives all contacts other parameters after each has taken them over.
    ///
    /// # Errors
    /// Those of [`FrettingContact::new`].
    pub(super) fn share(&mut self, parameters: &Parameters) -> Result<(), Error> {
        (self.models, _) = models(parameters)?;
        for contact in self.slots.iter_mut().flatten() {
            contact.share_parameters(&self.models.at_depth);
        }
        Ok(())
    }

    /// Approach at which the first contact touches, m.
    pub(super) fn first_touch(&self) -> f64 {
        // contacts that have never touched come in the order of their offsets
        let untouched = self.order.iter().find(|index| self.slots[**index as usize].is_none());
        let lowest = untouched.map_or(f64::INFINITY, |index| self.summits[*index as usize].offset);
        let worn = self.touched().map(|(index, contact)| self.summits[index].offset + contact.touch_depth());
        worn.fold(lowest, f64::min)
    }

    /// Normal forces and contact radii on the present profiles at an approach, m, by rising offset
    /// up to the last contact that may touch.
    pub(super) fn loads(&self, approach: f64, loads: &mut Loads) -> Result<(), Error> {
        let reached = self.order.partition_point(|index| self.summits[*index as usize].offset < approach);
        let order = &self.order[..reached];
        let load = |index: &u32| {
            let index = *index as usize;
            let depth = approach - self.summits[index].offset;
            let load = match &self.slots[index] {
                Some(contact) => contact.load_at(depth),
                None => unworn_load(&self.models.at_depth, &self.profiles[index], depth),
            };
            load.map_err(|problem| Error::InContact { contact: index + 1, problem: Box::new(problem) })
        };
        loads.clear();
        order.iter().try_for_each(|index| load(index).map(|load| loads.push(load)))
    }

    /// Marks of the present state of every contact.
    pub(super) fn marks(&self) -> Marks {
        self.touched().map(|(index, contact)| (index, contact.mark())).collect()
    }

    /// Goes back to marks.
    pub(super) fn return_to(&mut self, marks: &Marks) {
        let mut marks = marks.iter().peekable();
        for (index, slot) in self.slots.iter_mut().enumerate() {
            match (marks.next_if(|(marked, _)| *marked == index), slot) {
                (Some((_, mark)), Some(contact)) => contact.return_to(mark),
                (_, slot) => *slot = None,
            }
        }
    }

    /// Work of friction of each contact so far, J.
    pub(super) fn work(&self) -> Vec<f64> {
        let work = |slot: &Slot| slot.as_ref().map_or(0.0, |contact| contact.dissipated_energy());
        self.slots.iter().map(work).collect()
    }

    /// Updates of the profile of each contact so far.
    pub(super) fn updates(&self) -> Vec<u64> {
        let updates = |slot: &Slot| slot.as_ref().map_or(0, |contact| contact.counters().profile_updates);
        self.slots.iter().map(updates).collect()
    }

    /// Most updates of one contact since then.
    pub(super) fn most_updates_since(&self, before: &[u64]) -> u64 {
        let since = self.updates().into_iter().zip(before).map(|(now, before)| now - before);
        since.max().unwrap_or(0)
    }

    /// Takes every contact from one pose to another.
    pub(super) fn advance(&mut self, from: &Pose, to: &Pose, loading: &Loading) -> Result<(), Error> {
        let models = self.models.clone();
        self.turn(from, to, |contact, summit, index| {
            let place = summit.displacement(to.displacement, to.rotation);
            let mut depth = to.approach - summit.offset;
            match loading {
                Loading::Held if contact.contact_radius() > 0.0 => {
                    return contact.under_force(&models, |contact| contact.advance_under_load(place));
                }
                Loading::Forces(change) => {
                    let touch = contact.touch_depth();
                    let depths = (from.approach - summit.offset - touch, depth - touch);
                    if change.is_even((contact.normal_reaction(), index), depths) {
                        let force = change.forces[index];
                        return contact
                            .under_force(&models, |contact| contact.advance_to_planar(force, place));
                    }
                    if change.total.1 == 0.0 {
                        depth = depth.min(touch);
                    }
                }
                _ => {}
            }
            contact.advance_to_planar(depth, place)
        })
    }

    /// Whether every contact carries an even share of the force from one pose to another.
    pub(super) fn change_evenly(&self, from: &Pose, to: &Pose, change: &ForceChange) -> bool {
        self.slots.iter().enumerate().all(|(index, slot)| {
            let (force, touch) = match slot {
                Some(contact) => (contact.normal_reaction(), contact.touch_depth()),
                None => (0.0, self.profiles[index].image(0.0)),
            };
            let [before, after] = [from, to].map(|pose| pose.approach - self.summits[index].offset - touch);
            // one that is apart all the time
            force == 0.0 && change.forces[index] == 0.0 && before < 0.0 && after < 0.0
                || change.is_even((force, index), (before, after))
        })
    }

    /// Presses every contact at rest to a common approach, m.
    pub(super) fn press(&mut self, pose: &Pose, approach: f64) -> Result<(), Error> {
        let to = Pose { approach, ..*pose };
        self.turn(pose, &to, |contact, summit, _| {
            let depth = approach - summit.offset;
            let change = (depth - contact.indentation_depth()) * contact.normal_stiffness();
            if change.abs() <= ROUNDING * contact.normal_reaction() && contact.contact_radius() > 0.0 {
                return Ok(());
            }
            contact.follow_wear_to(depth)
        })
    }

    /// Takes every contact at rest to an approach (m) at which none carries a force.
    pub(super) fn lift_to(&mut self, pose: &Pose, approach: f64) -> Result<(), Error> {
        let to = Pose { approach, ..*pose };
        self.turn(pose, &to, |contact, summit, _| {
            let depth = (approach - summit.offset).min(contact.touch_depth());
            contact.advance_to_planar(depth, summit.displacement(pose.displacement, pose.rotation))
        })
    }

    /// Updates the profile of every contact at the force that it carries.
    pub(super) fn update_profiles(&mut self, pose: &Pose) -> Result<(), Error> {
        let models = self.models.clone();
        self.turn(pose, pose, |contact, _, _| contact.under_force(&models, FrettingContact::absorb_backlog))
    }

    /// Σ |∂F/∂d| |d − dᵢ − zᵢ|, N: what the depths of contacts that touch differ from a common
    /// approach, m.
    pub(super) fn misfit(&self, approach: f64) -> f64 {
        let misfit = |(index, contact): (usize, &FrettingContact)| {
            let depth = approach - self.summits[index].offset;
            contact.normal_stiffness() * (depth - contact.indentation_depth()).abs()
        };
        self.touched().map(misfit).sum()
    }

    /// Mean approach of the contacts that touch by their stiffness, m, and the sum of that, N/m.
    pub(super) fn mean_approach(&self) -> (f64, f64) {
        let (mut sum, mut total) = (0.0, 0.0);
        for (index, contact) in self.touched() {
            let stiffness = contact.normal_stiffness();
            sum += stiffness * (contact.indentation_depth() + self.summits[index].offset);
            total += stiffness;
        }
        (sum / total, total)
    }

    /// Displacement cycles of all contacts at the depths of a pose.
    pub(super) fn cycle(&mut self, pose: &Pose, amplitude: f64, cycles: f64) -> Result<(), Error> {
        self.turn(pose, pose, |contact, summit, _| {
            // one that has just touched, or was apart, has missed some
            contact.set_cycles_on_coating(pose.cycles);
            contact.advance_cycles(pose.approach - summit.offset, amplitude, cycles)
        })
    }

    /// Puts all contacts at the depths of a pose and at the amplitude of cycles, m; those that
    /// touch only if they are not at one approach.
    pub(super) fn end_cycles(&mut self, pose: &Pose, amplitude: f64, force: f64) -> Result<(), Error> {
        let fits = self.misfit(pose.approach) <= ROUNDING * force;
        self.turn(pose, pose, |contact, summit, _| {
            contact.set_cycles_on_coating(pose.cycles);
            if fits && contact.contact_radius() > 0.0 {
                return Ok(());
            }
            contact.advance_cycles(pose.approach - summit.offset, amplitude, 0.0)
        })
    }

    /// Normal force (N) of each contact from loads by rising offset, which a change of the approach
    /// (m) alters little, such that they add up to a sum; 0 of those that do not touch.
    pub(super) fn forces(&self, loads: &Loads, change: f64, sum: f64) -> Vec<f64> {
        let scale = self.models.at_depth.force_scale() * change;
        let mut forces = vec![0.0; self.slots.len()];
        for (index, (force, radius)) in self.order.iter().zip(loads) {
            forces[*index as usize] = (force + scale * radius).max(0.0);
        }
        // by the largest: equal contacts carry the same to the bit, whatever their number
        let largest = forces.iter().copied().fold(0.0, f64::max);
        forces.iter_mut().for_each(|force| *force /= largest);
        let shares = forces.iter().sum::<f64>();
        forces.iter_mut().for_each(|share| *share = sum * *share / shares);
        forces
    }

    /// Displacement cycles of each contact at a constant force of its own, N; those of a contact
    /// that does not touch are counted.
    pub(super) fn cycle_at_forces(
        &mut self,
        pose: &Pose,
        forces: &[f64],
        amplitude: f64,
        cycles: f64,
    ) -> Result<(), Error> {
        let models = self.models.clone();
        self.turn(pose, pose, |contact, _, index| {
            contact.set_cycles_on_coating(pose.cycles);
            let force = forces[index];
            if force > 0.0 {
                contact.under_force(&models, |contact| contact.advance_cycles(force, amplitude, cycles))
            } else {
                Ok(())
            }
        })
    }

    /// Lifts all contacts off and presses them down in a pose, so that none carries a tangential
    /// force: to a force each, N, or to their depths.
    pub(super) fn start(&mut self, pose: &Pose, forces: Option<&[f64]>) -> Result<(), Error> {
        let models = self.models.clone();
        self.turn(pose, pose, |contact, summit, index| {
            let mut depth = pose.approach - summit.offset;
            let place = summit.displacement(pose.displacement, pose.rotation);
            if let Some(forces) = forces {
                let force = forces[index];
                if force > 0.0 {
                    return contact.under_force(&models, |contact| contact.start_at_planar(force, place));
                }
                depth = depth.min(contact.touch_depth());
            }
            contact.start_at_planar(depth, place)
        })
    }

    /// Changes every contact that has touched or touches in the pose `to`; each with its number.
    pub(super) fn turn(
        &mut self,
        from: &Pose,
        to: &Pose,
        change: impl Fn(&mut FrettingContact, &Summit, usize) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        let (model, summits, profiles) =
            (self.models.at_depth.clone(), self.summits.clone(), self.profiles.clone());
        self.each(|index, slot, memory| {
            let summit = &summits[index];
            if slot.is_none() && to.approach <= summit.offset {
                return Ok(());
            }
            let contact =
                slot.get_or_insert_with(|| Box::new(untouched(&model, &profiles[index], summit, from)));
            contact.exchange_memory(memory);
            let result = change(contact, summit, index);
            contact.return_memory(memory);
            result.map_err(|problem| Error::InContact { contact: index + 1, problem: Box::new(problem) })
        })
    }

    /// Changes every slot; the first refusal in order is returned.
    fn each(
        &mut self,
        change: impl Fn(usize, &mut Slot, &mut Memory) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        #[cfg(feature = "threads")]
        if self.in_threads && self.slots.len() > CHUNK {
            use rayon::prelude::*;
            let change_all = |(chunk, slots): (usize, &mut [Slot])| {
                let mut memory = Memory::default();
                let mut slots = slots.iter_mut().enumerate();
                slots.try_for_each(|(k, slot)| change(chunk * CHUNK + k, slot, &mut memory))
            };
            let results: Vec<Result<(), Error>> =
                self.slots.par_chunks_mut(CHUNK).enumerate().map(change_all).collect();
            return results.into_iter().collect();
        }
        let mut memory = Memory::default();
        let mut slots = self.slots.iter_mut().enumerate();
        slots.try_for_each(|(index, slot)| change(index, slot, &mut memory))
    }
}

/// Models of a contact, and its body.
fn models(parameters: &Parameters) -> Result<(Models, Profile), Error> {
    let model = |normal_control| Model::new(Parameters { normal_control, ..parameters.clone() });
    let (at_depth, body) = model(NormalControl::Indentation)?;
    let (at_force, _) = model(NormalControl::Force)?;
    Ok((Models { at_depth: Arc::new(at_depth), at_force: Arc::new(at_force) }, body))
}

fn untouched(model: &Arc<Model>, profile: &Arc<Profile>, summit: &Summit, pose: &Pose) -> FrettingContact {
    let mut contact = FrettingContact::with_profile(model, profile);
    let depth = (pose.approach - summit.offset).min(contact.touch_depth());
    contact.place_apart(depth, summit.displacement(pose.displacement, pose.rotation));
    contact
}
