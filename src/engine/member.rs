//! A contact as one of many: what is the same in all of them is shared.

use super::model::Model;
use super::{FrettingContact, Memory};
use crate::error::Error;
use crate::profile::Profile;
use crate::surface::{Contact, Surface, TransformCache};
use nalgebra::Vector2;
use std::f64::consts::PI;
use std::mem::swap;
use std::sync::Arc;

/// Share of a force, or of a change of depth, that counts as rounding: a contact whose force is
/// held keeps its depth to the bit.
pub(crate) const ROUNDING: f64 = 1e-12;

/// What the contacts of an interface share, each of them held at its depth, or at its force.
#[derive(Debug, Clone)]
pub(crate) struct Models {
    pub(crate) at_depth: Arc<Model>,
    pub(crate) at_force: Arc<Model>,
}

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
        self.state.place = Vector2::new(x, y);
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
        let contact = self.state.contact;
        let change = depth - contact.depth;
        if change == 0.0 || change.abs() <= ROUNDING * (contact.depth - self.surface.tip()) {
            return Ok((self.force_scale() * contact.load, contact.radius));
        }
        match self.surface.load_in_cell(depth) {
            Some((load, radius)) => Ok((self.force_scale() * load, radius)),
            None => load_of(&self.surface, &self.model, depth),
        }
    }

    /// Runs a change of a contact under depth control as one under force control, which it is in
    /// the meantime: its profile wears at its force, and the depth is what comes of it.
    ///
    /// # Errors
    /// Those of the change.
    pub(crate) fn under_force<T>(
        &mut self,
        models: &Models,
        change: impl FnOnce(&mut Self) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.exchange_model((&models.at_depth, &models.at_force));
        self.state.contact.control = self.state.contact.load;
        let result = change(self);
        self.exchange_model((&models.at_force, &models.at_depth));
        self.state.contact.control = self.state.contact.depth;
        result
    }

    /// Takes another model in place of one, with its own friction where that has run in.
    fn exchange_model(&mut self, (from, to): (&Arc<Model>, &Arc<Model>)) {
        if Arc::ptr_eq(&self.model, from) {
            self.model = to.clone();
        } else {
            let model = Arc::make_mut(&mut self.model);
            model.parameters = to.parameters.clone();
            model.constants.force_control = to.constants.force_control;
        }
    }

    /// Presses the contact at rest to a depth (m) to which the wear of all contacts has brought it.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub(crate) fn follow_wear_to(&mut self, depth: f64) -> Result<(), Error> {
        if self.state.contact.is_open() || depth < self.state.contact.depth {
            let place = self.drive_place();
            return self.advance_to_planar(depth, place.into());
        }
        self.sink_to(depth)
    }

    /// [`Self::advance_to_planar`] under the load as it is, to the bit.
    ///
    /// # Errors
    /// As [`Self::advance_to_planar`].
    pub(crate) fn advance_under_load(&mut self, displacement: [f64; 2]) -> Result<(), Error> {
        let (value, place) = (self.state.contact.control, Vector2::from(displacement));
        if self.is_running_in() {
            return self.run_in_to(value * self.force_scale(), place);
        }
        self.advance_by_value(value, place)
    }

    /// Depth of the wear at the last update of the profile, m: [`Self::wear_depth`] without what
    /// waits for the next update.
    pub(crate) fn updated_wear_depth(&self) -> f64 {
        let depth = |nodes: &crate::surface::Nodes| nodes.depth().iter().fold(0.0f64, |a, w| a.max(*w));
        self.surface.worn().map_or(0.0, depth)
    }

    /// [`Self::updated_wear_depth`] and that of what waits as if all had slipped under a Hertzian
    /// pressure, 3/2 of the mean, m: takes no transform, and says which contact is worn deepest.
    pub(crate) fn wear_depth_by_work(&self) -> f64 {
        let Some(wear) = &self.state.wear else { return 0.0 };
        let waits = self.model.constants.wear_per_work * wear.backlog.work;
        let area = PI * wear.backlog.radius.powi(2);
        self.updated_wear_depth() + if waits > 0.0 { 1.5 * waits / area } else { 0.0 }
    }

    /// Puts the memory of a step back where it is kept, and keeps no more of it than the state
    /// needs.
    pub(crate) fn return_memory(&mut self, memory: &mut Memory) {
        let own = self.memory.get();
        self.state.row.take_smaller(&mut own.row);
        self.state.stroke.origins.shrink_to_fit();
        // tables are those of one profile
        own.transforms = TransformCache::default();
        self.exchange_memory(memory);
    }

    /// Takes the memory of a step from where it is kept, or puts it back there.
    pub(crate) fn exchange_memory(&mut self, memory: &mut Memory) {
        swap(&mut self.memory, memory);
    }
}
