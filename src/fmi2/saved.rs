//! Saved states of one instance.
//!
//! The importer's handle is the address of a state that the instance owns. It is only compared,
//! never followed, so that a stale handle or one of another instance is refused instead of read.

use super::model::SavedModel;
use super::refusal::{Checked, Refusal};
use super::status::{Outcome, State};
use fmi_sys::fmi2::fmi2FMUstate;
use serde::{Deserialize, Serialize};

/// What fmi2GetFMUstate copies.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Saved {
    pub(super) state: State,
    pub(super) last_step: Outcome,
    pub(super) model: SavedModel,
}

impl Saved {
    /// Refuses what no instance could have saved.
    pub(super) fn check(&self) -> Checked {
        let initialized = match self.state {
            State::Instantiated | State::InitializationMode => false,
            State::StepComplete | State::Terminated => true,
            State::Failed => {
                return Err(Refusal::SerializedState("it is that of a failed instance".into()).into());
            }
        };
        self.model.check(initialized)
    }
}

/// All states that have been saved and not yet freed. They end with the instance.
#[derive(Default)]
pub(super) struct SavedStates {
    #[expect(clippy::vec_box, reason = "a handle is an address, which must not move with the vector")]
    states: Vec<Box<Saved>>,
}

fn handle(saved: &Saved) -> fmi2FMUstate {
    (&raw const *saved).cast_mut().cast()
}

impl SavedStates {
    /// Keeps `saved`, in the place of the state `old` unless that is null.
    pub(super) fn keep(&mut self, saved: Saved, old: fmi2FMUstate) -> Checked<fmi2FMUstate> {
        let place = if old.is_null() {
            self.states.push(Box::new(saved));
            self.states.len() - 1
        } else {
            let place = self.find(old)?;
            *self.states[place] = saved;
            place
        };
        Ok(handle(&self.states[place]))
    }

    /// The state with this handle.
    pub(super) fn get(&self, state: fmi2FMUstate) -> Checked<&Saved> {
        self.find(state).map(|place| &*self.states[place])
    }

    /// Drops the state with this handle; null is ignored.
    pub(super) fn free(&mut self, state: fmi2FMUstate) -> Checked {
        if !state.is_null() {
            let place = self.find(state)?;
            self.states.swap_remove(place);
        }
        Ok(())
    }

    fn find(&self, state: fmi2FMUstate) -> Checked<usize> {
        if state.is_null() {
            return Err(Refusal::NullPointer("FMUstate").into());
        }
        let found = self.states.iter().position(|saved| handle(saved) == state);
        found.ok_or_else(|| Refusal::UnknownState(state.addr()).into())
    }
}
