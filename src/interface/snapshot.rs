//! Saved states of an interface.

use super::{Interface, Pose};
use crate::engine::{CLOSE, Snapshot};
use crate::error::Error;
use crate::parameters::NormalControl;
use serde::{Deserialize, Serialize};

/// Everything that an [`Interface`] needs to go on from where it was, without its parameters and
/// places. Contacts that have never touched take no room.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InterfaceSnapshot {
    pose: Pose,
    control: f64,
    block: f64,
    contacts: Vec<(u32, Snapshot)>,
}

impl Interface {
    /// The present state.
    pub fn snapshot(&self) -> InterfaceSnapshot {
        let contacts = self.members.touched().map(|(index, contact)| (index as u32, contact.snapshot()));
        InterfaceSnapshot {
            pose: self.pose,
            control: self.control,
            block: self.block,
            contacts: contacts.collect(),
        }
    }

    /// Goes back to a state saved by an interface with the same parameters and contacts; what
    /// follows is the same to the bit. The state may come from anywhere: everything in it is
    /// checked.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the state does not fit.
    pub fn restore(&mut self, snapshot: &InterfaceSnapshot) -> Result<(), Error> {
        let refuse = |problem: &str| Err(Error::Snapshot(problem.into()));
        let Pose { approach, displacement: [x, y], rotation, cycles } = snapshot.pose;
        let InterfaceSnapshot { control, block, .. } = *snapshot;
        let numbers = [approach, x, y, rotation, control, block, cycles];
        if !numbers.iter().all(|number| number.is_finite()) || block < 0.0 || cycles < 0.0 {
            return refuse("the pose of the interface is no set of numbers");
        }
        let held = self.parameters.normal_control == NormalControl::Indentation;
        if held && control != approach {
            return refuse("its approach is not the one that is held");
        }
        let numbers = snapshot.contacts.iter().map(|contact| contact.0 as usize);
        let rises = numbers.clone().zip(numbers.clone().skip(1)).all(|(a, b)| a < b);
        if !rises || snapshot.contacts.last().is_some_and(|last| last.0 as usize >= self.summits().len()) {
            return refuse("its contacts are not those of the interface");
        }
        let mut same = self.clone();
        same.put_back(snapshot, true)?;
        *self = same;
        Ok(())
    }

    /// The same for a state that is known to be one of an equal interface.
    ///
    /// # Errors
    /// [`Error::Snapshot`] where it is not.
    #[cfg(feature = "fmi2")]
    pub(crate) fn reinstate(&mut self, snapshot: &InterfaceSnapshot) -> Result<(), Error> {
        self.put_back(snapshot, false)
    }

    fn put_back(&mut self, snapshot: &InterfaceSnapshot, checked: bool) -> Result<(), Error> {
        let pose = snapshot.pose;
        let mut saved = snapshot.contacts.iter().peekable();
        for index in 0..self.summits().len() {
            let Some((_, state)) = saved.next_if(|(saved, _)| *saved as usize == index) else {
                self.members.put(index, None);
                continue;
            };
            let mut contact = self.members.untouched(index, &pose);
            let summit = self.summits()[index];
            if checked {
                let refuse = |problem| Error::InContact { contact: index + 1, problem: Box::new(problem) };
                contact.restore(state).map_err(refuse)?;
                let place = summit.displacement(pose.displacement, pose.rotation);
                let depth = pose.approach - summit.offset;
                let size = |a: f64, b: f64| a.abs() + b.abs() + f64::MIN_POSITIVE;
                let near = |a: f64, b: f64, size: f64| (a - b).abs() <= CLOSE * size;
                let placed = near(contact.displacement(), place[0], size(place[0], place[1]))
                    && near(contact.displacement_y(), place[1], size(place[0], place[1]));
                let pressed = contact.contact_radius() == 0.0
                    || near(contact.indentation_depth(), depth, size(pose.approach, summit.offset));
                if !(placed && pressed) {
                    let problem = "it stands elsewhere than the body".into();
                    return Err(refuse(Error::Snapshot(problem)));
                }
            } else {
                contact.reinstate(state);
            }
            self.members.put(index, Some(contact));
        }
        (self.pose, self.control, self.block) = (pose, snapshot.control, snapshot.block);
        Ok(())
    }
}
