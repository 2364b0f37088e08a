//! A contact as one of many: what is the same in all of them is shared.

use super::model::Model;
use super::{FrettingContact, Memory};
use crate::error::Error;
use crate::parameters::Parameters;
use crate::profile::Profile;
use crate::surface::{Contact, Surface, TransformCache};
use std::mem::swap;
use std::sync::Arc;

/// Normal force (N) and contact radius (m) of an unworn profile at an indentation depth, m.
///
/// # Errors
/// As [`FrettingContact::advance_to`].
pub(crate) fn unworn_load(model: &Model, profile: &Arc<Profile>, depth: f64) -> Result<(f64, f64), Error> {
    load_of(&Surface::shared(profile.clone()), model, depth)
}

fn load_of(surface: &Surface, model: &Model, depth: f64) -> Result<(f64, f64), Error> {
    let scale = model.force_scale();
    let contact = surface.contact(model.parameters.normal_control, depth, scale)?;
    Ok((scale * contact.load, contact.radius))
}

impl FrettingContact {
    /// A contact of a model, with its own body in place of that of the parameters.
    pub(crate) fn with_profile(model: &Arc<Model>, profile: &Arc<Profile>) -> Self {
        Self::on_surface(model.clone(), Surface::shared(profile.clone()))
    }

    /// Parameters that are equal to those of other contacts but for what the contact has itself.
    pub(crate) fn share_parameters(&mut self, model: &Arc<Model>) {
        if *self.model == **model {
            self.model = model.clone();
        } else {
            Arc::make_mut(&mut self.model).parameters = model.parameters.clone();
        }
    }

    /// Places a body that has not touched yet, at a depth (m) above the other body.
    pub(crate) fn place_apart(&mut self, depth: f64, [x, y]: [f64; 2]) {
        self.state.contact = Contact { control: depth, depth, radius: 0.0, load: 0.0 };
        (self.state.displacement, self.state.displacement_y) = (x, y);
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
        if depth == self.state.contact.control {
            return Ok((self.normal_reaction(), self.state.contact.radius));
        }
        match self.surface.load_in_cell(depth) {
            Some((load, radius)) => Ok((self.force_scale() * load, radius)),
            None => load_of(&self.surface, &self.model, depth),
        }
    }

    /// [`Self::advance_cycles`] of a contact under depth control at a constant force (N), for
    /// which the parameters are given, too. The depth is what comes of it.
    ///
    /// # Errors
    /// As [`Self::advance_cycles`].
    pub(crate) fn advance_cycles_at_force(
        &mut self,
        at_force: &Arc<Parameters>,
        force: f64,
        amplitude: f64,
        cycles: f64,
    ) -> Result<(), Error> {
        // friction that runs in has changed its own model
        self.absorb_backlog()?;
        let at_depth = self.model.clone();
        let mut model = (*at_depth).clone();
        (model.parameters, model.constants.force_control) = (at_force.clone(), true);
        self.model = Arc::new(model);
        self.state.contact.control = self.state.contact.load;
        let run = self.advance_cycles(force, amplitude, cycles);
        let model = Arc::make_mut(&mut self.model);
        (model.parameters, model.constants.force_control) = (at_depth.parameters.clone(), false);
        if *self.model == *at_depth {
            self.model = at_depth;
        }
        self.state.contact.control = self.state.contact.depth;
        self.surface.control_by_depth();
        run
    }

    /// Depth of the wear at the last update of the profile, m: [`Self::wear_depth`] without what
    /// waits for the next update.
    pub(crate) fn updated_wear_depth(&self) -> f64 {
        let depth = |nodes: &crate::surface::Nodes| nodes.depth().iter().fold(0.0f64, |a, w| a.max(*w));
        self.surface.worn().map_or(0.0, depth)
    }

    /// Puts the memory of a step back where it is kept, and keeps no more of it than the state
    /// needs.
    pub(crate) fn return_memory(&mut self, memory: &mut Memory) {
        let own = self.memory.get();
        self.state.springs.take_smaller(&mut own.springs);
        // tables are those of one profile
        own.transforms = TransformCache::default();
        self.exchange_memory(memory);
    }

    /// Takes the memory of a step from where it is kept, or puts it back there.
    pub(crate) fn exchange_memory(&mut self, memory: &mut Memory) {
        swap(&mut self.memory, memory);
    }
}
