//! The state of a contact: plain data from which it goes on. Together with the nodes of the worn
//! profile it is what a [`super::Snapshot`] holds.
//!
//! A change that may fail half way is run as a [`FrettingContact::transaction`], which returns to
//! the state before. A single walk along a line computes the new state first and then takes it
//! over, so that it needs none.

use super::FrettingContact;
use super::coating::Coating;
use super::model::Model;
use super::retune::FormerWear;
use super::stroke::StrokeStart;
use crate::counters::Counters;
use crate::friction::Row;
use crate::surface::{Contact, Surface};
use crate::wear::{Sliding, WearBacklog};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::mem::take;
use std::sync::Arc;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) contact: Contact,
    /// That of a line until the body has moved along y in contact.
    pub(super) row: Row,
    /// Displacement along x and y, m.
    pub(super) place: Vector2<f64>,
    /// Direction of the last movement, a unit vector, or 0 before the first.
    pub(super) direction: Vector2<f64>,
    /// Work of friction, J.
    pub(super) work: f64,
    /// The start of the present stroke.
    pub(super) stroke: StrokeStart,
    /// What has worn before the coefficients were last changed.
    pub(super) former: FormerWear,
    /// Largest contact radius so far, m.
    pub(super) reach: f64,
    /// Present only where wear is computed.
    pub(super) wear: Option<Box<WearState>>,
    pub(super) coating: Coating,
    pub(super) counters: Counters,
}

/// What wear needs besides the surface.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct WearState {
    pub(super) backlog: WearBacklog,
    /// Volume that may wear before the profile follows, over π a² d of the contact that wears. A
    /// volume found under a heavy load would let a small contact wear away.
    pub(super) limit: f64,
    /// Work whose wear is deferred to a later update, J; below 0 where the profile has worn by
    /// more.
    pub(super) deferred_work: f64,
    /// Work that the springs did on the profile before the last updates beyond that on the profile
    /// as it wore, J ≥ 0: the next slip counts for so much less.
    pub(super) surplus: f64,
    /// Direction of the last slip, a unit vector, or 0.
    pub(super) slip_direction: Vector2<f64>,
    /// Whether the first slip of the backlog was against the last one before.
    pub(super) begins_at_reversal: bool,
    /// How much the next step of a steady motion should span, and of which.
    pub(super) next_step: Option<(Sliding, f64)>,
    /// Σ of the differences between the work at the nodes and that of the springs, J.
    pub(super) defect: f64,
    /// Work whose wear would have healed the profile, J.
    pub(super) clipped: f64,
}

impl State {
    /// Bodies apart above a surface, at displacement 0.
    pub(super) fn apart(surface: &Surface, model: &Model) -> Self {
        let touch = surface.tip();
        let control = if model.constants.force_control { 0.0 } else { touch };
        Self {
            contact: Contact { control, depth: touch, radius: 0.0, load: 0.0 },
            row: Row::default(),
            place: Vector2::zeros(),
            direction: Vector2::zeros(),
            work: 0.0,
            stroke: StrokeStart::default(),
            former: FormerWear::default(),
            reach: 0.0,
            wear: model.wears().then(Box::default),
            coating: Coating::default(),
            counters: Counters::default(),
        }
    }

    /// Takes over another state, in memory that is there already.
    fn copy_from(&mut self, other: &Self) {
        let (mut row, mut stroke) = (take(&mut self.row), take(&mut self.stroke));
        row.copy_from(&other.row);
        stroke.copy_from(&other.stroke);
        let wear = match (self.wear.take(), &other.wear) {
            (Some(mut own), Some(other)) => {
                own.copy_from(other);
                Some(own)
            }
            (_, other) => other.clone(),
        };
        *self = Self { row, stroke, wear, ..*other };
    }
}

impl WearState {
    /// Takes over another one, in memory that is there already.
    fn copy_from(&mut self, other: &Self) {
        let mut backlog = take(&mut self.backlog);
        backlog.copy_from(&other.backlog);
        *self = Self { backlog, ..*other };
    }

    /// The deferred work, at most so much, J.
    pub(super) fn deferred_share(&self, most: f64) -> f64 {
        self.deferred_work.max(-most).min(most)
    }
}

/// A state to return to, with all that it holds for. It shares parameters and nodes with the
/// contact.
#[derive(Debug, Clone)]
pub(crate) struct Mark {
    model: Arc<Model>,
    surface: Surface,
    state: State,
}

impl FrettingContact {
    /// A mark of the present state.
    pub(crate) fn mark(&self) -> Mark {
        Mark { model: self.model.clone(), surface: self.surface.clone(), state: self.state.clone() }
    }

    /// Goes back to a mark of this contact.
    pub(crate) fn return_to(&mut self, mark: &Mark) {
        (self.model, self.surface) = (mark.model.clone(), mark.surface.clone());
        self.take_state(&mark.state);
    }

    /// Takes over a state. The memory stays: tables know the nodes that they were made for.
    pub(super) fn take_state(&mut self, state: &State) {
        self.state.copy_from(state);
        self.view.forget();
    }

    /// Runs a change; where it fails, the state is as before.
    pub(super) fn transaction<T, E>(
        &mut self,
        change: impl FnOnce(&mut Self) -> Result<T, E>,
    ) -> Result<T, E> {
        let before = match self.memory.get().before.take() {
            Some(mut mark) => {
                (mark.model, mark.surface) = (self.model.clone(), self.surface.clone());
                mark.state.copy_from(&self.state);
                mark
            }
            None => Box::new(self.mark()),
        };
        let result = change(self);
        if result.is_err() {
            self.return_to(&before);
        }
        self.memory.get().before = Some(before);
        result
    }
}
