//! Saved states.

mod soundness;

use super::coating::Coating;
use super::planar::Planar;
use super::retune::FormerWear;
use super::stroke::{Stroke, StrokeStart};
use super::{Counters, FrettingContact};
use crate::error::Error;
use crate::friction::Springs;
use crate::surface::{Contact, Nodes};
use crate::wear::{Sliding, WearBacklog};
use serde::{Deserialize, Serialize};

/// Everything that a [`FrettingContact`] needs to go on from where it was, without its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    contact: Contact,
    springs: Springs,
    displacement: f64,
    #[serde(default)]
    displacement_y: f64,
    #[serde(default)]
    planar: Option<Box<Planar>>,
    direction: f64,
    work: f64,
    stroke: StrokeStart,
    former: FormerWear,
    reach: f64,
    nodes: Option<Nodes>,
    wear: Option<WearSnapshot>,
    #[serde(default)]
    coating: Coating,
    counters: Counters,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct WearSnapshot {
    backlog: WearBacklog,
    limit: f64,
    deferred_work: f64,
    expected: Option<Sliding>,
    next_step: Option<(Sliding, f64)>,
    defect: f64,
    clipped: f64,
}

impl FrettingContact {
    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot { nodes: self.surface.worn().cloned(), ..self.state() }
    }

    /// The present state but for the worn profile.
    pub(super) fn state(&self) -> Snapshot {
        let wear = self.wear.as_ref().map(|wear| WearSnapshot {
            backlog: wear.backlog.clone(),
            limit: wear.limit,
            deferred_work: wear.deferred_work,
            expected: wear.expected,
            next_step: wear.next_step,
            defect: wear.defect,
            clipped: wear.clipped,
        });
        Snapshot {
            contact: self.contact,
            springs: self.springs.clone(),
            displacement: self.displacement,
            displacement_y: self.displacement_y,
            planar: self.planar.as_ref().map(|planar| Box::new(planar.saved())),
            direction: self.direction,
            work: self.work,
            stroke: self.stroke.start.clone(),
            former: self.former,
            reach: self.reach,
            nodes: None,
            wear,
            coating: self.coating,
            counters: self.counters,
        }
    }

    /// Goes back to a state saved by a contact with the same parameters; what follows is the same to the bit. The state may
    /// come from anywhere: everything in it is checked.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the state does not fit this contact.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        if snapshot.wear.is_some() != self.wear.is_some() {
            let problem = "it was saved with wear switched the other way; restore into equal parameters";
            return Err(Error::Snapshot(problem.into()));
        }
        if let Some(problem) = snapshot.problem(self) {
            return Err(Error::Snapshot(problem.into()));
        }
        self.reinstate(snapshot)
    }

    /// The same for a state that is known to be one of a contact with equal parameters.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if it was saved with wear and this contact has none, or the other way.
    pub(crate) fn reinstate(&mut self, snapshot: &Snapshot) -> Result<(), Error> {
        if snapshot.wear.is_some() != self.wear.is_some() {
            return Err(Error::Snapshot("it was saved with wear switched the other way".into()));
        }
        self.surface.set_worn(snapshot.nodes.clone());
        self.take_state(snapshot);
        Ok(())
    }

    /// Takes a state but for its worn profile. Tables and buffers stay, since they hold for the nodes
    /// that they were made for.
    pub(super) fn take_state(&mut self, snapshot: &Snapshot) {
        self.springs.copy_from(&snapshot.springs);
        self.contact = snapshot.contact;
        self.displacement = snapshot.displacement;
        self.displacement_y = snapshot.displacement_y;
        self.planar = snapshot.planar.clone();
        self.direction = snapshot.direction;
        self.work = snapshot.work;
        self.follow_running_in();
        self.stroke = Stroke::since(snapshot.stroke.clone());
        self.former = snapshot.former;
        self.reach = snapshot.reach;
        self.counters = snapshot.counters;
        self.coating = snapshot.coating;
        if let (Some(wear), Some(saved)) = (&mut self.wear, &snapshot.wear) {
            wear.backlog.copy_from(&saved.backlog);
            wear.limit = saved.limit;
            wear.deferred_work = saved.deferred_work;
            wear.expected = saved.expected;
            wear.next_step = saved.next_step;
            wear.defect = saved.defect;
            wear.clipped = saved.clipped;
        }
        self.view.take();
    }
}
