//! Everything that defines a contact: materials, profile, friction, wear and how finely to compute.

use crate::error::Error;
use crate::material::{Elastic, Pair};
use crate::profile::Profile;
use crate::range;
use serde::{Deserialize, Serialize};

/// Which normal quantity the caller prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NormalControl {
    /// The normal force F_N, N.
    Force,
    /// The indentation depth d, m.
    Indentation,
}

/// The definition of one contact. Fixed for the life of a [`crate::FrettingContact`], but for what
/// [`crate::FrettingContact::retune`] changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Elastic constants; body 1 moves and wears.
    pub materials: Pair,
    /// Shape of the unworn body 1.
    pub profile: Profile,
    /// Coefficient of friction μ, in [0, 1e9].
    pub friction_coefficient: f64,
    /// Wear coefficient k of eq. (18), in [0, 1e30]; 0 computes no wear, and is the only value for
    /// [`Profile::Ellipse`].
    pub wear_coefficient: f64,
    /// Hardness σ₀ of the worn body, Pa, in [1e-30, 1e30].
    pub hardness: f64,
    /// What [`crate::FrettingContact::advance_to`] takes as its first argument.
    pub normal_control: NormalControl,
    /// Stiffness of what holds the moving body, in series with the contact, N/m; infinite by default. Where it is less than
    /// [`Self::RIGID`], displacements that are given are those of the drive behind it.
    #[serde(default = "rigid", with = "infinite_as_none")]
    pub rig_stiffness: f64,
    /// Cells across the slipping annulus, 8 to 8192. Only wear and motion in the plane use them: on a line forces are exact at any resolution.
    pub resolution: usize,
    /// Relative tolerance of the wear integration, in [1e-12, 0.1].
    pub tolerance: f64,
}

impl Default for Parameters {
    /// A steel ball of 10 mm radius on a steel flat, μ = 0.6, k/σ₀ = 4e-14 m³/J (52100 steel).
    fn default() -> Self {
        Self {
            materials: Pair { body_1: Elastic::STEEL, body_2: Elastic::STEEL },
            profile: Profile::Parabola { radius: 0.01 },
            friction_coefficient: 0.6,
            wear_coefficient: 3.2e-4,
            hardness: 8e9,
            normal_control: NormalControl::Force,
            rig_stiffness: f64::INFINITY,
            resolution: 64,
            tolerance: 1e-3,
        }
    }
}

impl Parameters {
    /// Smallest and largest accepted [`Self::resolution`].
    pub const RESOLUTION_RANGE: (usize, usize) = (8, 8192);

    /// A [`Self::rig_stiffness`] from which on the contact is driven directly, N/m.
    pub const RIGID: f64 = 1e60;

    /// The least accepted [`Self::rig_stiffness`], N/m: far below anything built, and its inverse a number to reckon with.
    pub const LEAST_RIG_STIFFNESS: f64 = 1e-60;

    /// 1/[`Self::rig_stiffness`], m/N; 0 where the contact is driven directly.
    pub fn rig_compliance(&self) -> f64 {
        if self.rig_stiffness >= Self::RIGID { 0.0 } else { 1.0 / self.rig_stiffness }
    }

    /// k/σ₀, the worn volume per unit of friction work, m³/J.
    pub fn wear_per_work(&self) -> f64 {
        self.wear_coefficient / self.hardness
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the first offending name and value; [`Error::ProfileTable`] for a bad table.
    pub fn validate(&self) -> Result<(), Error> {
        self.materials.validate()?;
        self.profile.validate()?;
        for (name, value, range, requirement) in [
            (
                "friction_coefficient",
                self.friction_coefficient,
                range::FRICTION,
                "a coefficient of friction lies in 0 to 1e9",
            ),
            ("wear_coefficient", self.wear_coefficient, range::WEAR, "a wear coefficient lies in 0 to 1e30"),
            ("hardness", self.hardness, range::STRESS, "a hardness lies in 1e-30 to 1e30 Pa"),
            ("tolerance", self.tolerance, range::TOLERANCE, "the relative tolerance lies in 1e-12 to 0.1"),
        ] {
            range::parameter(name, value, &range, requirement)?;
        }
        if matches!(self.profile, Profile::Ellipse { .. }) && self.wear_coefficient > 0.0 {
            let requirement = "profile = ellipse has no worn shape: set wear_coefficient = 0; the worn volume is \
                               dissipated_energy times the wear coefficient over the hardness";
            return Err(Error::Parameter {
                name: "wear_coefficient",
                value: self.wear_coefficient,
                requirement,
            });
        }
        let held = self.rig_stiffness >= Self::LEAST_RIG_STIFFNESS;
        if !held {
            let requirement =
                "a rig stiffness is 1e-60 N/m or more, infinite where the contact is driven directly";
            return Err(Error::Parameter { name: "rig_stiffness", value: self.rig_stiffness, requirement });
        }
        let (least, most) = Self::RESOLUTION_RANGE;
        if !(least..=most).contains(&self.resolution) {
            let requirement = "the number of cells across the contact lies in 8 to 8192";
            return Err(Error::Parameter { name: "resolution", value: self.resolution as f64, requirement });
        }
        Ok(())
    }
}

fn rigid() -> f64 {
    f64::INFINITY
}

/// Text formats know no infinity: it is saved as none.
mod infinite_as_none {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
    pub(super) fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        (*value != f64::INFINITY).then_some(*value).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Option::deserialize(deserializer).map(|value| value.unwrap_or(f64::INFINITY))
    }
}
