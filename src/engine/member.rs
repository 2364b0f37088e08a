//! A contact as one of many: what is the same in all of them is shared, and a change of several
//! contacts can be taken back where one of them refuses it.

use super::axes::Axes;
use super::{FrettingContact, Snapshot};
use crate::error::Error;
use crate::friction::{SlipPiece, Springs};
use crate::parameters::Parameters;
use crate::profile::Profile;
use crate::surface::{Contact, Surface, TransformCache};
use crate::wear::{Constants, WearBacklog};
use std::mem::swap;
use std::sync::Arc;

/// Buffers that a step needs and that hold nothing between two steps.
#[derive(Debug, Default)]
pub(crate) struct WorkMemory {
    spare: Springs,
    undo: Springs,
    backlog: WearBacklog,
    slips: Vec<SlipPiece>,
}

/// A state to return to. It shares the nodes of the worn profile with the contact.
#[derive(Debug, Clone)]
pub(crate) struct Mark {
    parameters: Arc<Parameters>,
    constants: Constants,
    surface: Surface,
    state: Snapshot,
}

/// Normal force (N) and contact radius (m) of an unworn profile at an indentation depth, m.
///
/// # Errors
/// As [`FrettingContact::advance_to`].
pub(crate) fn unworn_load(
    parameters: &Parameters,
    profile: &Arc<Profile>,
    depth: f64,
) -> Result<(f64, f64), Error> {
    load_of(&Surface::shared(profile.clone()), parameters, depth)
}

fn load_of(surface: &Surface, parameters: &Parameters, depth: f64) -> Result<(f64, f64), Error> {
    let scale = 2.0 * parameters.materials.normal_modulus();
    let contact = surface.contact(parameters.normal_control, depth, scale)?;
    Ok((scale * contact.load, contact.radius))
}

impl FrettingContact {
    /// A contact of parameters that have been validated, with its own profile in place of theirs.
    pub(crate) fn with_profile(parameters: Arc<Parameters>, profile: Arc<Profile>) -> Self {
        let modulus = parameters.materials.tangential_modulus();
        Self::on_surface(parameters, Surface::shared(profile), (Axes::CIRCLE, modulus))
    }

    /// Parameters that are equal to those of other contacts but for what the contact has itself.
    pub(crate) fn share_parameters(&mut self, parameters: &Arc<Parameters>) {
        self.parameters = parameters.clone();
    }

    /// Places a body that has not touched yet, at a depth (m) above the other body.
    pub(crate) fn place_apart(&mut self, depth: f64, [x, y]: [f64; 2]) {
        self.contact = Contact { control: depth, depth, radius: 0.0, load: 0.0 };
        (self.displacement, self.displacement_y) = (x, y);
    }

    /// Indentation depth at which the worn body touches, m.
    pub(crate) fn touch_depth(&self) -> f64 {
        self.surface.tip()
    }

    /// Normal force (N) and contact radius (m) of the profile as it is at another depth, m.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub(crate) fn load_at(&self, depth: f64) -> Result<(f64, f64), Error> {
        if depth == self.contact.control {
            return Ok((self.normal_reaction(), self.contact.radius));
        }
        match self.surface.load_in_cell(depth) {
            Some((load, radius)) => Ok((self.force_scale() * load, radius)),
            None => load_of(&self.surface, &self.parameters, depth),
        }
    }

    /// Depth of the wear at the last update of the profile, m: [`Self::wear_depth`] without what
    /// waits for the next update.
    pub(crate) fn updated_wear_depth(&self) -> f64 {
        let depth = |nodes: &crate::surface::Nodes| nodes.depth().iter().fold(0.0f64, |a, w| a.max(*w));
        self.surface.worn().map_or(0.0, depth)
    }

    /// Takes the buffers of a step from where they are kept, or puts them back there.
    pub(crate) fn exchange_memory(&mut self, memory: &mut WorkMemory) {
        swap(&mut self.spare, &mut memory.spare);
        swap(&mut self.undo, &mut memory.undo);
        if let Some(wear) = &mut self.wear {
            swap(&mut wear.undo, &mut memory.backlog);
            swap(&mut wear.slips, &mut memory.slips);
            // the tables of the transforms are those of one profile
            wear.transforms = TransformCache::default();
        }
    }

    /// A mark of the present state.
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            parameters: self.parameters.clone(),
            constants: self.constants,
            surface: self.surface.clone(),
            state: self.state(),
        }
    }

    /// Goes back to a mark of this contact.
    pub(crate) fn return_to(&mut self, mark: &Mark) {
        self.parameters = mark.parameters.clone();
        self.constants = mark.constants;
        (self.bound_slope, self.start_slope) = (mark.constants.bound_slope(), mark.constants.bound_slope());
        self.surface = mark.surface.clone();
        self.take_state(&mark.state);
    }
}
