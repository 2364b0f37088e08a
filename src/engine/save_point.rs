//! States of many contacts that change together, to return to where one of them refuses.
//!
//! In contrast to a [`Mark`](super::state::Mark) they are made for each step, so that nothing of
//! them is kept between two steps. So they take no memory of their own for the arrays of a contact.

use super::FrettingContact;
use super::model::Model;
use super::state::{State, WearState};
use crate::friction::{Knot, Springs};
use crate::surface::Surface;
use crate::wear::WearBacklog;
use nalgebra::Vector2;
use std::mem::take;
use std::ops::Range;
use std::sync::Arc;

/// States to return to of some contacts.
#[derive(Debug, Clone, Default)]
pub(crate) struct SavePoints {
    points: Vec<SavePoint>,
    /// Springs of all contacts.
    knots: Vec<Knot>,
    /// Origins at the start of the strokes of all contacts.
    origins: Vec<(f64, Vector2<f64>)>,
}

/// The state of one contact. Its backlog keeps by itself what returns the levels.
#[derive(Debug, Clone)]
struct SavePoint {
    contact: usize,
    model: Arc<Model>,
    surface: Surface,
    /// Without the arrays that follow.
    state: State,
    wear: Option<WearState>,
    knots: Range<usize>,
    origins: Range<usize>,
}

impl SavePoints {
    /// Saves the present state of a contact under a number that is larger than those before.
    pub(crate) fn save(&mut self, number: usize, contact: &mut FrettingContact) {
        let state = &mut contact.state;
        let (springs, origins, mut wear) =
            (take(&mut state.springs), take(&mut state.stroke.origins), state.wear.take());
        let (first_knot, first_origin) = (self.knots.len(), self.origins.len());
        self.knots.extend_from_slice(springs.knots());
        self.origins.extend_from_slice(&origins);
        let saved_wear = wear.as_mut().map(|wear| {
            let backlog = wear.backlog.save_point();
            WearState { backlog, ..**wear }
        });
        self.points.push(SavePoint {
            contact: number,
            model: contact.model.clone(),
            surface: contact.surface.clone(),
            state: state.clone(),
            wear: saved_wear,
            knots: first_knot..self.knots.len(),
            origins: first_origin..self.origins.len(),
        });
        (state.springs, state.stroke.origins, state.wear) = (springs, origins, wear);
    }

    /// Returns to the saved states, which stay. `contacts` gives those of all numbers in turn; one
    /// without a saved state is removed.
    pub(crate) fn return_to<'a>(&self, contacts: impl Iterator<Item = &'a mut Option<Box<FrettingContact>>>) {
        let mut points = self.points.iter().peekable();
        for (number, slot) in contacts.enumerate() {
            match (points.next_if(|point| point.contact == number), slot) {
                (Some(point), Some(contact)) => self.return_one(point, contact),
                (_, slot) => *slot = None,
            }
        }
    }

    fn return_one(&self, point: &SavePoint, contact: &mut FrettingContact) {
        (contact.model, contact.surface) = (point.model.clone(), point.surface.clone());
        let own = &mut contact.state;
        let mut origins = take(&mut own.stroke.origins);
        origins.clear();
        origins.extend_from_slice(&self.origins[point.origins.clone()]);
        let springs = Springs::from_knots(&self.knots[point.knots.clone()]);
        let mut wear = own.wear.take();
        if let (Some(own), Some(saved)) = (&mut wear, &point.wear) {
            own.copy_from(saved, WearBacklog::return_to_save_point);
        }
        *own = State { springs, wear, ..point.state.clone() };
        own.stroke.origins = origins;
        contact.view.forget();
    }
}

impl FrettingContact {
    /// Forgets the last save point.
    pub(crate) fn forget_save_point(&mut self) {
        if let Some(wear) = &mut self.state.wear {
            wear.backlog.forget_save_point();
        }
    }
}
