//! Many contacts of one rigid body: a joint, a spline, a rough surface. [`Interface`].
//!
//! Body 1 is rigid but for its contacts. Each has its own offset zᵢ, place (xᵢ, yᵢ), size and wear;
//! all share the approach d, the displacement U and a rotation φ about the normal through the
//! origin:
//!
//! | quantity | of contact i | of the interface |
//! | --- | --- | --- |
//! | depth | dᵢ = d − zᵢ | d, where Σ Fᵢ(dᵢ) = F_N, or given |
//! | displacement | (U_x − φ yᵢ, U_y + φ xᵢ) | (U_x, U_y), φ |
//! | tangential force | Tᵢ | T = Σ Tᵢ |
//! | moment | | M = Σ (xᵢ T_yi − yᵢ T_xi) |
//! | work, worn volume, stiffness | | sums |
//!
//! The rotation counts to first order, and the torsion of a single contact about its own axis, of
//! order a/|(x, y)| smaller, is left out.
//!
//! Without wear this is the model of Greenwood and Williamson (Proc. R. Soc. A 295, 1966) with the
//! friction of Cattaneo and Mindlin in each contact.
//!
//! Friction that runs in does so in each contact by its own work: μᵢ(Wᵢ), with one
//! `running_in_energy` for a contact of any size. In sliding T = Σ μᵢ Fᵢ.
//!
//! # Limits of validity
//! Contacts do not feel each other through the half-space: the surface displacement
//! u(r) = F(1 − ν²)/(πEr) of a neighbour, taken as E* of both, is neglected against the depth. In
//! the guide `docs/interface.md` its effect is measured against a boundary-element code.
//!
//! # How is a step followed?
//! Under force control the approach is a curve in the force. A step that changes force and
//! displacement at once is divided until that curve is straight to the tolerance, unless all
//! contacts keep their shares of the force. A contact that does so follows a straight line in its
//! force, and wears at its force; the others follow one in depth. Afterwards all are pressed to a
//! common approach at rest. A part of a step in which that would change more than a set share of
//! the force is divided further. Cycles at a constant force are run in blocks in which each contact
//! has a constant force of its own.

mod approach;
mod coating;
mod cyclic;
mod history;
mod members;
mod readout;
mod snapshot;
mod summit;

pub use snapshot::InterfaceSnapshot;
pub use summit::Summit;

use crate::engine::FrettingContact;
use crate::error::Error;
use crate::parameters::{NormalControl, Parameters};
use approach::Approach;
use members::{Marks, Members};
use serde::{Deserialize, Serialize};

/// Where the body stands, and how many cycles it has done.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Pose {
    /// Approach d, m.
    approach: f64,
    /// Displacement along x and y, m.
    displacement: [f64; 2],
    /// Angle about the normal, rad.
    rotation: f64,
    /// Cycles of cyclic loading up to here.
    cycles: f64,
}

/// Contacts of one rigid body with another, each with its own history of friction and wear.
///
/// Built from the [`Parameters`] of all and one [`Summit`] for each; then driven like a
/// [`FrettingContact`]. A contact that has never touched holds no state. A call that returns an
/// error has changed nothing.
///
/// ```
/// use fretting_contact::{Interface, Parameters, Summit};
///
/// // two equal summits and a lower one, on steel balls of 10 mm radius
/// let summits = [0.0, 0.0, 2e-6].map(Summit::at_offset);
/// let mut joint = Interface::new(Parameters::default(), &summits)?;
/// joint.start_at(150.0, [0.0, 0.0], 0.0)?; // press with 150 N
/// joint.advance_to(150.0, [1e-6, 0.0], 0.0)?; // and push by 1 µm
/// assert_eq!(joint.contacts_in_touch(), 3);
/// assert!((joint.normal_reaction() - 150.0).abs() < 1e-9);
/// assert!(joint.tangential_force() < 0.6 * 150.0);
/// # Ok::<(), fretting_contact::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Interface {
    parameters: Parameters,
    members: Members,
    pose: Pose,
    /// Normal force (N) or approach (m) that was given last, by `normal_control`.
    control: f64,
    /// Cycles of the last block of cyclic loading.
    block: f64,
    /// The approach under a force (N) that a step is about to ask for, on the profiles as they are.
    ahead: Option<(f64, Approach)>,
    /// What the present call began with.
    before: Option<Before>,
}

/// A state to return to: marks of the contacts, pose, control and block.
type Before = (Marks, Pose, f64, f64);

impl Interface {
    /// An interface whose bodies are apart.
    ///
    /// # Errors
    /// Those of [`FrettingContact::new`]; [`Error::ContactsTable`] for summits that are not valid;
    /// [`Error::Parameter`] for what an interface does not have: a rig stiffness.
    pub fn new(parameters: Parameters, summits: &[Summit]) -> Result<Self, Error> {
        parameters.validate()?;
        if parameters.rig_compliance() > 0.0 {
            let requirement = "an interface of several contacts is driven directly: leave it infinite (1e60 N/m or more in the FMU)";
            let value = parameters.rig_stiffness;
            return Err(Error::Parameter { name: "rig_stiffness", value, requirement });
        }
        Summit::check_number(summits.len())?;
        for (index, summit) in summits.iter().enumerate() {
            if let Some(problem) = summit.problem() {
                return Err(Error::ContactsTable { place: format!("contact {}", index + 1), problem });
            }
        }
        let members = Members::new(&parameters, summits)?;
        let approach = members.first_touch();
        let control = match parameters.normal_control {
            NormalControl::Force => 0.0,
            NormalControl::Indentation => approach,
        };
        let pose = Pose { approach, displacement: [0.0; 2], rotation: 0.0, cycles: 0.0 };
        Ok(Self { parameters, members, pose, control, block: 0.0, ahead: None, before: None })
    }

    /// What the interface was built from: the parameters of every contact.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The contacts that it was built from.
    pub fn summits(&self) -> &[Summit] {
        self.members.summits()
    }

    /// One contact by its index from 0; `None` where it has never touched.
    pub fn contact(&self, index: usize) -> Option<&FrettingContact> {
        self.members.get(index)
    }

    /// Whether several threads advance the contacts, which is the default with the feature
    /// `threads`. The results are the same to the bit.
    #[cfg(feature = "threads")]
    pub fn use_threads(&mut self, in_threads: bool) {
        self.members.in_threads = in_threads;
    }

    /// Goes on with other coefficients of friction and wear, as [`FrettingContact::retune`].
    ///
    /// # Errors
    /// As [`FrettingContact::retune`].
    pub fn retune(&mut self, friction_coefficient: f64, wear_coefficients: [f64; 2]) -> Result<(), Error> {
        let [wear_coefficient, wear_coefficient_2] = wear_coefficients;
        let new = Parameters {
            friction_coefficient,
            wear_coefficient,
            wear_coefficient_2,
            ..self.parameters.clone()
        };
        new.validate()?;
        // a probe refuses what no contact may do, even where none has touched
        FrettingContact::new(self.parameters.clone())?
            .retune_bodies(friction_coefficient, wear_coefficients)?;
        let pose = self.pose;
        self.transaction(|this| {
            this.update_profiles()?;
            this.members.turn(&pose, &pose, |contact, _, _| {
                contact.retune_bodies(friction_coefficient, wear_coefficients)
            })?;
            this.settle()
        })?;
        self.members.share(&new)?;
        self.parameters = new;
        Ok(())
    }

    /// 2E*, Pa.
    fn force_scale(&self) -> f64 {
        2.0 * self.parameters.materials.normal_modulus()
    }

    /// Whether contacts wear.
    fn wears(&self) -> bool {
        self.parameters.wear_per_work() > 0.0 && self.parameters.friction_coefficient > 0.0
    }

    /// Returns to the state before the present call.
    fn roll_back(&mut self) {
        if let Some((marks, pose, control, block)) = &self.before {
            self.members.return_to(marks);
            (self.pose, self.control, self.block) = (*pose, *control, *block);
        }
    }

    /// Runs a change of all contacts; where it fails, the state is as before.
    fn transaction(&mut self, change: impl FnOnce(&mut Self) -> Result<(), Error>) -> Result<(), Error> {
        self.ahead = None;
        self.before = Some((self.members.marks(), self.pose, self.control, self.block));
        let result = change(self);
        if result.is_err() {
            self.roll_back();
        }
        self.before = None;
        result
    }
}
