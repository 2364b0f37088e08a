//! One contact and its history: [`FrettingContact`].
//!
//! Data flows one way: load → normal contact (`surface`) → springs (`friction`) → work → wear
//! (`wear`) → surface. Fields are made only when something reads them.

// The documentation shows the methods of a contact in this order.
mod construction;

mod history;

mod cyclic;

mod retune;

mod snapshot;

mod readout;

mod stroke;

mod axes;

mod rig;

mod planar;

mod running_in;

mod coating;

mod derivatives;

// Without public methods.
mod backlog;
mod bounds;
mod line;
mod member;
mod memory;
mod model;
mod slide;
mod state;
mod steady;
mod tuning;
mod view;

pub use crate::counters::Counters;
pub use derivatives::Gradient;
pub(crate) use history::MOST_PIECES;
pub(crate) use member::{Models, ROUNDING, unworn_load};
pub(crate) use memory::Memory;
pub(crate) use model::Model;
pub(crate) use snapshot::CLOSE;
pub use snapshot::Snapshot;
pub(crate) use state::Mark;

use crate::error::Error;
use crate::parameters::NormalControl;
use crate::range;
use crate::surface::Surface;
use crate::wear::UnitMesh;
use serde::{Deserialize, Serialize};
use state::State;
use std::sync::Arc;

/// What the contact does at the moment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SlipState {
    /// The bodies are apart.
    Separated,
    /// No spring is at its friction bound.
    Stick,
    /// An outer annulus slips.
    PartialSlip,
    /// The whole contact slips.
    GrossSlip,
}

/// A fretting contact of a body of revolution on a half-space, or an elliptic one.
///
/// Built from [`crate::Parameters`], apart at first; then driven by [`Self::advance_to`]
/// (transient) or [`Self::advance_cycles`] (cyclic) and read through accessors. SI units
/// throughout. A call that returns an error has changed nothing.
///
/// ```
/// use fretting_contact::{FrettingContact, Parameters};
///
/// let mut contact = FrettingContact::new(Parameters::default())?;
/// contact.start_at(100.0, 0.0)?; // press a 10 mm steel ball with 100 N
/// contact.advance_to(100.0, 1e-6)?; // and push it by 1 µm
/// assert!((contact.tangential_force() - 31.70).abs() < 0.01);
/// assert!(contact.stick_radius() < contact.contact_radius());
/// # Ok::<(), fretting_contact::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FrettingContact {
    /// That of many contacts, where they are equal.
    model: Arc<Model>,
    surface: Surface,
    state: State,
    view: view::View,
    memory: Memory,
    /// Tables of the moving mesh, kept so that they need not be made for each update.
    mesh: Option<Arc<UnitMesh>>,
}

impl FrettingContact {
    fn on_surface(model: Arc<Model>, surface: Surface) -> Self {
        let state = State::apart(&surface, &model);
        Self { model, surface, state, view: view::View::default(), memory: Memory::default(), mesh: None }
    }

    /// 2E*, the ratio of force to load integral, Pa.
    fn force_scale(&self) -> f64 {
        self.model.force_scale()
    }

    /// Value of the controlled quantity at which the bodies touch.
    fn touch_control(&self) -> f64 {
        match self.model.parameters.normal_control {
            NormalControl::Force => 0.0,
            NormalControl::Indentation => self.surface.tip(),
        }
    }

    /// Checks two inputs of a step; returns the controlled quantity, m² of load or m.
    fn checked(&self, normal: f64, displacement: f64) -> Result<f64, Error> {
        let (name, value) = match self.model.parameters.normal_control {
            NormalControl::Force => ("normal_force", normal / self.force_scale()),
            NormalControl::Indentation => ("indentation", normal),
        };
        range::input(name, normal)?;
        range::input("tangential_displacement", displacement)?;
        Ok(value)
    }
}
