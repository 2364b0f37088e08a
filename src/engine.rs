//! One contact and its history: [`FrettingContact`].
//!
//! Data flows one way: load → normal contact (`surface`) → springs (`friction`) → work → wear
//! (`wear`) → surface. Fields are made only when something reads them.

mod axes;
mod backlog;
mod bounds;
mod coating;
mod cyclic;
mod derivatives;
mod history;
mod line;
mod member;
mod planar;
mod readout;
mod retune;
mod rig;
mod running_in;
mod slide;
mod snapshot;
mod steady;
mod stroke;
mod undo;

use axes::Axes;

pub use crate::counters::Counters;
pub use derivatives::Gradient;
pub(crate) use member::{Mark, WorkMemory, unworn_load};
pub use snapshot::Snapshot;

use crate::error::Error;
use crate::friction::{SlipPiece, Springs};
use crate::parameters::{NormalControl, Parameters};
use crate::profile::Profile;
use crate::range;
use crate::surface::{Contact, Nodes, Surface, TransformCache};
use crate::wear::{Constants, Sliding, UnitMesh, WearBacklog};
use serde::{Deserialize, Serialize};
use std::cell::OnceCell;
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
/// Built from [`Parameters`], apart at first; then driven by [`Self::advance_to`] (transient) or
/// [`Self::advance_cycles`] (cyclic) and read through accessors. SI units throughout. A call that returns an error has
/// changed nothing.
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
    parameters: Arc<Parameters>,
    constants: Constants,
    /// m = μE*/G*, from `constants`.
    bound_slope: f64,
    /// m at the start of the present line: another one while friction runs in.
    start_slope: f64,
    /// 1/k_rig, m/N; 0 where the contact is driven directly.
    compliance: f64,
    axes: Axes,
    surface: Surface,
    contact: Contact,
    springs: Springs,
    /// A former row, kept for its memory.
    spare: Springs,
    /// The row before a change that may fail, likewise.
    undo: Springs,
    displacement: f64,
    /// Displacement along y, m.
    displacement_y: f64,
    /// Present once the body has moved along y in contact; it then takes the place of `springs`.
    planar: Option<Box<planar::Planar>>,
    /// Sign of the last movement along x, 0 before the first.
    direction: f64,
    /// Work of friction, J.
    work: f64,
    /// The present stroke.
    stroke: stroke::Stroke,
    /// What has worn before the coefficients were last changed.
    former: retune::FormerWear,
    /// Largest contact radius so far, m.
    reach: f64,
    /// Present only where wear is computed.
    wear: Option<Box<WearState>>,
    coating: coating::Coating,
    counters: Counters,
    /// The worn profile up to this instant, made when read.
    view: OnceCell<Nodes>,
}

/// What wear needs besides the surface.
#[derive(Debug, Clone, Default)]
struct WearState {
    backlog: WearBacklog,
    /// The backlog before a change that may fail, kept for its memory.
    undo: WearBacklog,
    /// Pieces of slip of the line that is being walked.
    slips: Vec<SlipPiece>,
    /// Volume that may wear before the profile follows, m³.
    limit: f64,
    /// Work whose wear is deferred to a later update, J; below 0 where the profile has worn by
    /// more.
    deferred_work: f64,
    /// The motion that the last backlog was.
    expected: Option<Sliding>,
    /// How much the next step of a steady motion should span, and of which.
    next_step: Option<(Sliding, f64)>,
    /// Tables of the moving mesh, kept so that they need not be made for each update.
    mesh: Option<Arc<UnitMesh>>,
    /// Those of the nodes at rest.
    transforms: TransformCache,
    /// Σ of the differences between the work at the nodes and that of the springs, J.
    defect: f64,
    /// Work whose wear would have healed the profile, J.
    clipped: f64,
}

impl FrettingContact {
    /// A contact whose bodies are apart, at displacement 0.
    ///
    /// # Errors
    /// [`Error::Parameter`] or [`Error::ProfileTable`] for parameters outside their range.
    pub fn new(parameters: Parameters) -> Result<Self, Error> {
        parameters.validate()?;
        let materials = &parameters.materials;
        // along x
        let (body, axes, tangential_modulus) = match parameters.profile.ellipse()? {
            None => (parameters.profile.clone(), Axes::CIRCLE, materials.tangential_modulus()),
            Some(ellipse) => (
                Profile::Parabola { radius: ellipse.equivalent_radius() },
                Axes::new(&ellipse, materials),
                ellipse.tangential_moduli(materials)[0],
            ),
        };
        Ok(Self::on_surface(Arc::new(parameters), Surface::new(body), (axes, tangential_modulus)))
    }

    /// A contact whose bodies are apart, with its axes and the tangential modulus along x, Pa.
    fn on_surface(
        parameters: Arc<Parameters>,
        surface: Surface,
        (axes, tangential_modulus): (Axes, f64),
    ) -> Self {
        let constants = Constants {
            normal_modulus: parameters.materials.normal_modulus(),
            tangential_modulus,
            friction_coefficient: parameters.friction_coefficient,
            wear_per_work: parameters.wear_per_work(),
            force_control: parameters.normal_control == NormalControl::Force,
        };
        let touch = surface.tip();
        let control = if constants.force_control { 0.0 } else { touch };
        let wear = (constants.wear_per_work > 0.0 && constants.friction_coefficient > 0.0)
            .then(|| Box::new(WearState::default()));
        Self {
            bound_slope: constants.bound_slope(),
            start_slope: constants.bound_slope(),
            compliance: parameters.rig_compliance(),
            parameters,
            constants,
            axes,
            surface,
            contact: Contact { control, depth: touch, radius: 0.0, load: 0.0 },
            springs: Springs::default(),
            spare: Springs::default(),
            undo: Springs::default(),
            displacement: 0.0,
            displacement_y: 0.0,
            planar: None,
            direction: 0.0,
            work: 0.0,
            stroke: stroke::Stroke::default(),
            former: retune::FormerWear::default(),
            reach: 0.0,
            wear,
            coating: coating::Coating::default(),
            counters: Counters::default(),
            view: OnceCell::new(),
        }
    }

    /// What the contact was built from.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Work counted so far.
    pub fn counters(&self) -> &Counters {
        &self.counters
    }

    /// Lifts the body off, moves it to `displacement` (m, along x; its place along y stays) and presses it down there, so that T = 0. `normal` is the
    /// force (N) or the indentation depth (m), by `normal_control`. Wear and work so far stay.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn start_at(&mut self, normal: f64, displacement: f64) -> Result<(), Error> {
        let (value, _) = self.checked(normal, displacement)?;
        let contact = self.surface.contact(self.parameters.normal_control, value, self.force_scale())?;
        self.view.take();
        self.transaction(|this| {
            this.close_backlog()?;
            this.displacement = displacement;
            this.direction = 0.0;
            if this.work == 0.0 {
                this.reach = 0.0;
            }
            this.springs = Springs::default();
            this.planar = None;
            this.contact = Contact { control: this.touch_control(), depth: 0.0, radius: 0.0, load: 0.0 };
            this.walk(contact.control, displacement, 1)
        })
    }

    /// 2E*, the ratio of force to load integral, Pa.
    fn force_scale(&self) -> f64 {
        2.0 * self.constants.normal_modulus
    }

    /// Value of the controlled quantity at which the bodies touch.
    fn touch_control(&self) -> f64 {
        match self.parameters.normal_control {
            NormalControl::Force => 0.0,
            NormalControl::Indentation => self.surface.tip(),
        }
    }

    /// Checks two inputs of a step; returns the controlled quantity (m² of load or m) and the displacement.
    fn checked(&self, normal: f64, displacement: f64) -> Result<(f64, f64), Error> {
        let (name, value) = match self.parameters.normal_control {
            NormalControl::Force => ("normal_force", normal / self.force_scale()),
            NormalControl::Indentation => ("indentation", normal),
        };
        range::input(name, normal)?;
        range::input("tangential_displacement", displacement)?;
        Ok((value, displacement))
    }
}
