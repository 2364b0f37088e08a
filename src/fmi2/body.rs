//! What an instance computes: one contact, or an interface of many where `contacts_file` names one.
//!
//! A sum over the contacts is an output of the whole; what has a radius, and the fields, are those
//! of the contact that is worn deepest.

use super::variables::{Output, Whole};
use crate::counters::Counters;
use crate::engine::{FrettingContact, Gradient, SlipState, Snapshot};
use crate::error::Error;
use crate::interface::{Interface, InterfaceSnapshot, Summit};
use crate::parameters::Parameters;
use serde::{Deserialize, Serialize};

/// The engine of one instance.
#[derive(Clone)]
#[expect(clippy::large_enum_variant, reason = "one contact is the usual case, and a box would cost it time")]
pub(super) enum Body {
    One(FrettingContact),
    Many(Box<Interface>),
}

/// A body's state with what it is built from.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[expect(clippy::large_enum_variant, reason = "one contact is the usual case")]
pub(super) enum SavedBody {
    One(Parameters, Snapshot),
    Many(Parameters, Vec<Summit>, InterfaceSnapshot),
}

impl Body {
    /// From parameters and, where there are several contacts, their places.
    pub(super) fn new(parameters: Parameters, summits: Option<&[Summit]>) -> Result<Self, Error> {
        Ok(match summits {
            None => Self::One(FrettingContact::new(parameters)?),
            Some(summits) => Self::Many(Box::new(Interface::new(parameters, summits)?)),
        })
    }

    pub(super) fn parameters(&self) -> &Parameters {
        match self {
            Self::One(contact) => contact.parameters(),
            Self::Many(interface) => interface.parameters(),
        }
    }

    pub(super) fn counters(&self) -> Counters {
        match self {
            Self::One(contact) => *contact.counters(),
            Self::Many(interface) => interface.counters(),
        }
    }

    pub(super) fn start_at(&mut self, normal: f64, place: [f64; 2], rotation: f64) -> Result<(), Error> {
        match self {
            Self::One(contact) => contact.start_at_planar(normal, place),
            Self::Many(interface) => interface.start_at(normal, place, rotation),
        }
    }

    /// A single contact lies on the axis of rotation.
    pub(super) fn advance_to(&mut self, normal: f64, place: [f64; 2], rotation: f64) -> Result<(), Error> {
        match self {
            Self::One(contact) => contact.advance_to_planar(normal, place),
            Self::Many(interface) => interface.advance_to(normal, place, rotation),
        }
    }

    pub(super) fn advance_cycles(&mut self, normal: f64, amplitude: f64, cycles: f64) -> Result<(), Error> {
        match self {
            Self::One(contact) => contact.advance_cycles(normal, amplitude, cycles),
            Self::Many(interface) => interface.advance_cycles(normal, amplitude, cycles),
        }
    }

    pub(super) fn retune(
        &mut self,
        friction_coefficient: f64,
        wear_coefficients: [f64; 2],
    ) -> Result<(), Error> {
        match self {
            Self::One(contact) => contact.retune_bodies(friction_coefficient, wear_coefficients),
            Self::Many(interface) => interface.retune(friction_coefficient, wear_coefficients),
        }
    }

    /// Whether the coating of a contact has worn through.
    pub(super) fn worn_through(&self) -> bool {
        match self {
            Self::One(contact) => contact.worn_through(),
            Self::Many(interface) => interface.worn_through(),
        }
    }

    /// The same by the last updates of the profiles.
    pub(super) fn is_known_worn_through(&self) -> bool {
        match self {
            Self::One(contact) => contact.is_known_worn_through(),
            Self::Many(interface) => interface.is_known_worn_through(),
        }
    }

    /// Cycles up to the first wear-through, where that was in cyclic loading.
    pub(super) fn cycles_to_wear_through(&self) -> Option<f64> {
        match self {
            Self::One(contact) => contact.cycles_to_wear_through(),
            Self::Many(interface) => interface.cycles_to_wear_through(),
        }
    }

    /// Cycles so far, counted where there is a coating.
    pub(super) fn cycles_on_coating(&self) -> f64 {
        match self {
            Self::One(contact) => contact.cycles_on_coating(),
            Self::Many(interface) => interface.cycles_on_coating(),
        }
    }

    /// Reads something of the one contact, or of that of the interface which is worn deepest.
    #[inline]
    pub(super) fn read<T>(&self, read: impl FnOnce(&FrettingContact) -> T) -> T {
        match self {
            Self::One(contact) => read(contact),
            Self::Many(interface) => interface.read_deepest(read),
        }
    }

    /// State of slip of all contacts; `read` gives that of one.
    pub(super) fn slip_state(&self, read: fn(&FrettingContact) -> SlipState) -> SlipState {
        match self {
            Self::One(contact) => read(contact),
            Self::Many(interface) => interface.slip_state(),
        }
    }

    /// Value of an output.
    #[inline]
    pub(super) fn output(&self, output: &Output) -> f64 {
        match self {
            Self::One(contact) => (output.read)(contact),
            Self::Many(interface) => output_of_many(interface, output),
        }
    }

    /// Derivatives of an output.
    pub(super) fn gradient(&self, output: &Output) -> Gradient {
        match self {
            Self::One(contact) => (output.gradient)(contact),
            Self::Many(interface) => match output.whole {
                Whole::Sum => interface.total_gradient(output.gradient),
                Whole::Deepest => interface.deepest_gradient(output.gradient),
                Whole::Friction => interface.friction_coefficient_gradient(),
                Whole::Own { gradient, .. } => gradient(interface),
            },
        }
    }

    /// What a cycle adds to an output.
    pub(super) fn per_cycle(
        &self,
        per_cycle: fn(&FrettingContact, f64) -> f64,
        output: &Output,
        amplitude: f64,
    ) -> f64 {
        match (self, output.whole) {
            (Self::Many(interface), Whole::Sum) => interface.sum(|contact| per_cycle(contact, amplitude)),
            (Self::Many(interface), Whole::Friction) => {
                interface.mean_by_load(|contact| per_cycle(contact, amplitude))
            }
            _ => self.read(|contact| per_cycle(contact, amplitude)),
        }
    }

    pub(super) fn save(&self) -> SavedBody {
        match self {
            Self::One(contact) => SavedBody::One(contact.parameters().clone(), contact.snapshot()),
            Self::Many(interface) => SavedBody::Many(
                interface.parameters().clone(),
                interface.summits().to_vec(),
                interface.snapshot(),
            ),
        }
    }

    /// Takes a state of a body that was built from the same; `false` where it was not.
    pub(super) fn take(&mut self, saved: &SavedBody) -> Result<bool, Error> {
        match (self, saved) {
            (Self::One(contact), SavedBody::One(parameters, snapshot))
                if contact.parameters() == parameters =>
            {
                contact.reinstate(snapshot);
            }
            (Self::Many(interface), SavedBody::Many(parameters, summits, snapshot))
                if interface.parameters() == parameters && interface.summits() == summits =>
            {
                interface.reinstate(snapshot)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

fn output_of_many(interface: &Interface, output: &Output) -> f64 {
    match output.whole {
        Whole::Sum => interface.sum(output.read),
        Whole::Deepest => interface.read_deepest(output.read),
        Whole::Friction => interface.friction_coefficient_now(),
        Whole::Own { read, .. } => read(interface),
    }
}

impl SavedBody {
    pub(super) fn parameters(&self) -> &Parameters {
        match self {
            Self::One(parameters, _) | Self::Many(parameters, ..) => parameters,
        }
    }

    /// Whether it is that of several contacts.
    pub(super) fn is_interface(&self) -> bool {
        matches!(self, Self::Many(..))
    }

    /// A body in this state. The state may come from anywhere if it is to be `checked`.
    pub(super) fn revive(&self, checked: bool) -> Result<Body, Error> {
        match self {
            Self::One(parameters, snapshot) => {
                let mut contact = FrettingContact::new(parameters.clone())?;
                if checked {
                    contact.restore(snapshot)?;
                } else {
                    contact.reinstate(snapshot);
                }
                Ok(Body::One(contact))
            }
            Self::Many(parameters, summits, snapshot) => {
                let mut interface = Interface::new(parameters.clone(), summits)?;
                if checked {
                    interface.restore(snapshot)?
                } else {
                    interface.reinstate(snapshot)?
                }
                Ok(Body::Many(Box::new(interface)))
            }
        }
    }
}
