//! Saved states.

mod soundness;

pub(crate) use soundness::CLOSE;

use super::FrettingContact;
use super::state::State;
use crate::error::Error;
use crate::surface::Nodes;
use serde::{Deserialize, Serialize};

/// Everything that a [`FrettingContact`] needs to go on from where it was, without its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    state: State,
    /// The worn profile.
    nodes: Option<Nodes>,
}

/// Saved states.
impl FrettingContact {
    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot { state: self.state.clone(), nodes: self.surface.worn().cloned() }
    }

    /// Goes back to a state saved by a contact with the same parameters; what follows is the same
    /// to the bit. The state may come from anywhere: everything in it is checked.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the state does not fit this contact.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        if snapshot.state.wear.is_some() != self.state.wear.is_some() {
            let problem = "it was saved with wear switched the other way; restore into equal parameters";
            return Err(Error::Snapshot(problem.into()));
        }
        if let Some(problem) = snapshot.problem(self) {
            return Err(Error::Snapshot(problem.into()));
        }
        self.reinstate(snapshot);
        Ok(())
    }

    /// The same for a state that is known to be one of a contact with equal parameters.
    pub(crate) fn reinstate(&mut self, snapshot: &Snapshot) {
        let nodes = snapshot.nodes.as_ref().map(|nodes| nodes.completed(self.surface.profile()));
        self.surface.set_worn(nodes);
        self.take_state(&snapshot.state);
        self.follow_running_in();
    }
}
