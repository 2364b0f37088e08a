//! How a contact comes into being, and where it starts.

use super::model::Model;
use super::{Counters, FrettingContact};
use crate::error::Error;
use crate::friction::Row;
use crate::parameters::Parameters;
use crate::range;
use crate::surface::{Contact, Surface};
use nalgebra::Vector2;
use std::sync::Arc;

/// Construction and start.
impl FrettingContact {
    /// A contact whose bodies are apart, at displacement 0.
    ///
    /// # Errors
    /// [`Error::Parameter`] or [`Error::ProfileTable`] for parameters outside their range.
    pub fn new(parameters: Parameters) -> Result<Self, Error> {
        parameters.validate()?;
        let (model, body) = Model::new(parameters)?;
        Ok(Self::on_surface(Arc::new(model), Surface::new(body)))
    }

    /// What the contact was built from.
    pub fn parameters(&self) -> &Parameters {
        &self.model.parameters
    }

    /// Work counted so far.
    pub fn counters(&self) -> &Counters {
        &self.state.counters
    }

    /// Lifts the body off, moves it to `displacement` (m, along x; its place along y stays) and
    /// presses it down there, so that T = 0. `normal` is the force (N) or the indentation depth
    /// (m), by `normal_control`. Wear and work so far stay.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn start_at(&mut self, normal: f64, displacement: f64) -> Result<(), Error> {
        self.start_at_planar(normal, [displacement, self.state.place.y])
    }

    /// [`Self::start_at`] with a place along x and y, m.
    ///
    /// # Errors
    /// As [`Self::advance_to_planar`].
    pub fn start_at_planar(&mut self, normal: f64, [displacement, y]: [f64; 2]) -> Result<(), Error> {
        range::input(range::Y, y)?;
        let value = self.checked(normal, displacement)?;
        let contact =
            self.surface.contact(self.model.parameters.normal_control, value, self.force_scale())?;
        self.transaction(|this| {
            this.absorb_backlog()?;
            this.state.place = Vector2::new(displacement, y);
            this.state.direction = Vector2::zeros();
            if this.state.work == 0.0 {
                this.state.reach = 0.0;
            }
            this.state.row = Row::default();
            let depth = this.surface.tip();
            this.state.contact = Contact { control: this.touch_control(), depth, radius: 0.0, load: 0.0 };
            this.walk(contact.control, this.state.place, true)
        })
    }
}
