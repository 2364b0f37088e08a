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

/// [`Parameters::tolerance`] where it is not given.
pub(crate) const USUAL_TOLERANCE: f64 = 1e-3;

/// The definition of one contact. Fixed for the life of a [`crate::FrettingContact`], but for what
/// [`crate::FrettingContact::retune`] changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Elastic constants; body 1 moves.
    pub materials: Pair,
    /// Shape of the unworn body 1.
    pub profile: Profile,
    /// Coefficient of friction μ, in [0, 1e9].
    pub friction_coefficient: f64,
    /// Coefficient of friction μ_end after running in, in (0, 1e9]; not used where
    /// [`Self::running_in_energy`] is 0.
    #[serde(default)]
    pub friction_coefficient_final: f64,
    /// Dissipated energy W_r over which friction runs in, J, up to 1e30:
    /// μ(W) = μ_end − (μ_end − μ₀) e^(−W/W_r) with μ₀ = [`Self::friction_coefficient`]. 0: μ is
    /// constant.
    #[serde(default)]
    pub running_in_energy: f64,
    /// Wear coefficient k of body 1, eq. (18), in [0, 1e30]; 0 where body 1 does not wear,
    /// as always under [`Profile::Ellipse`].
    pub wear_coefficient: f64,
    /// Hardness σ₀ of body 1, Pa, in [1e-30, 1e30].
    pub hardness: f64,
    /// Wear coefficient of body 2, in [0, 1e30]; 0 where body 2 does not wear.
    #[serde(default)]
    pub wear_coefficient_2: f64,
    /// Hardness of body 2, Pa, in [1e-30, 1e30] where body 2 wears; otherwise not used, and may be
    /// 0.
    #[serde(default)]
    pub hardness_2: f64,
    /// Thickness of a coating, m, up to 1e30; 0 where there is none. The wear depth at which
    /// [`crate::FrettingContact::worn_through`] is true; it changes nothing else.
    #[serde(default)]
    pub coating_thickness: f64,
    /// Outermost radius of [`crate::FrettingContact::probe_radii`], m, up to 1e30; 0 where they
    /// follow the contact.
    #[serde(default)]
    pub probe_radius_max: f64,
    /// What [`crate::FrettingContact::advance_to`] takes as its first argument.
    pub normal_control: NormalControl,
    /// Stiffness of what holds the moving body, in series with the contact, N/m; infinite by
    /// default. Where it is less than [`Self::RIGID`], displacements that are given are those of
    /// the drive behind it.
    #[serde(default = "rigid", with = "infinite_as_none")]
    pub rig_stiffness: f64,
    /// Cells across the slipping annulus, 8 to 512. Only wear and motion in the plane use them: on
    /// a line forces are exact at any resolution. Steady cycles are integrated by parabolas on five
    /// eighths of them, at least 24.
    pub resolution: usize,
    /// Relative tolerance of the wear integration, in [1e-7, 0.1].
    pub tolerance: f64,
}

impl Default for Parameters {
    /// A steel ball of 10 mm radius on a steel flat, μ = 0.6, k/σ₀ = 4e-14 m³/J (52100 steel).
    fn default() -> Self {
        Self {
            materials: Pair { body_1: Elastic::STEEL, body_2: Elastic::STEEL },
            profile: Profile::Parabola { radius: 0.01 },
            friction_coefficient: 0.6,
            friction_coefficient_final: 0.6,
            running_in_energy: 0.0,
            wear_coefficient: 3.2e-4,
            hardness: 8e9,
            wear_coefficient_2: 0.0,
            hardness_2: 0.0,
            coating_thickness: 0.0,
            probe_radius_max: 0.0,
            normal_control: NormalControl::Force,
            rig_stiffness: f64::INFINITY,
            resolution: 64,
            tolerance: USUAL_TOLERANCE,
        }
    }
}

impl Parameters {
    /// Smallest and largest accepted [`Self::resolution`].
    pub const RESOLUTION_RANGE: (usize, usize) = (8, 512);

    /// A [`Self::rig_stiffness`] from which on the contact is driven directly, N/m.
    pub const RIGID: f64 = 1e60;

    /// Times W_r after which friction has run in: e^(−64) of any coefficient is rounding.
    pub(crate) const RUN_IN: f64 = 64.0;

    /// The least accepted [`Self::rig_stiffness`], N/m: far below anything built, and its inverse a
    /// number to reckon with.
    pub const LEAST_RIG_STIFFNESS: f64 = 1e-60;

    /// 1/[`Self::rig_stiffness`], m/N; 0 where the contact is driven directly.
    pub fn rig_compliance(&self) -> f64 {
        if self.rig_stiffness >= Self::RIGID { 0.0 } else { 1.0 / self.rig_stiffness }
    }

    /// μ after an energy (J) has been dissipated: that of running in, else constant.
    pub fn friction_coefficient_after(&self, energy: f64) -> f64 {
        if self.running_in_energy == 0.0 {
            return self.friction_coefficient;
        }
        let passed = energy / self.running_in_energy;
        // both ends are reached to the bit, and kept
        if passed >= Self::RUN_IN {
            return self.friction_coefficient_final;
        }
        (-passed).exp() * self.friction_coefficient - (-passed).exp_m1() * self.friction_coefficient_final
    }

    /// k₁/σ₁ + k₂/σ₂, the volume that both bodies lose per unit of friction work, m³/J.
    ///
    /// Slip is small against the contact, so both bodies lose material at the same radius:
    /// dw₁ + dw₂ = (k₁/σ₁ + k₂/σ₂) τ ds. The contact depends on the sum of the depths alone.
    pub fn wear_per_work(&self) -> f64 {
        let [body_1, body_2] = self.wear_per_work_of_bodies();
        body_1 + body_2
    }

    /// k₁/σ₁ and k₂/σ₂, the volumes that body 1 and body 2 lose per unit of friction work, m³/J.
    pub fn wear_per_work_of_bodies(&self) -> [f64; 2] {
        let body_2 =
            if self.wear_coefficient_2 == 0.0 { 0.0 } else { self.wear_coefficient_2 / self.hardness_2 };
        [self.wear_coefficient / self.hardness, body_2]
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Parameter`] with the first offending name and value; [`Error::ProfileTable`] for a
    /// bad table.
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
            ("tolerance", self.tolerance, range::TOLERANCE, "the relative tolerance lies in 1e-7 to 0.1"),
        ] {
            range::parameter(name, value, &range, requirement)?;
        }
        self.validate_ellipse()?;
        self.validate_running_in()?;
        self.validate_body_2()?;
        for (name, value, requirement) in [
            (
                "coating_thickness",
                self.coating_thickness,
                "the thickness of a coating lies in 0 to 1e30 m; give 0 where there is none",
            ),
            (
                "probe_radius_max",
                self.probe_radius_max,
                "the outermost probe lies in 0 to 1e30 m; give 0 to let the probes follow the contact",
            ),
        ] {
            range::parameter(name, value, &(0.0..=*range::LENGTH.end()), requirement)?;
        }
        let held = self.rig_stiffness >= Self::LEAST_RIG_STIFFNESS;
        if !held {
            let requirement =
                "a rig stiffness is 1e-60 N/m or more, infinite where the contact is driven directly";
            return Err(Error::Parameter { name: "rig_stiffness", value: self.rig_stiffness, requirement });
        }
        let (least, most) = Self::RESOLUTION_RANGE;
        if !(least..=most).contains(&self.resolution) {
            let requirement = "the number of cells across the contact lies in 8 to 512; give 64, or 128 to 256 with tolerance = 1e-4 for \
                               the profile next to the stick zone";
            return Err(Error::Parameter { name: "resolution", value: self.resolution as f64, requirement });
        }
        Ok(())
    }
}

impl Parameters {
    fn validate_running_in(&self) -> Result<(), Error> {
        let energy = self.running_in_energy;
        let requirement = "the energy of running in lies in 0 to 1e30 J; give 0 for constant friction";
        range::parameter("running_in_energy", energy, &range::RUNNING_IN, requirement)?;
        let requirement = "a final coefficient of friction lies in 0 to 1e9";
        let last = self.friction_coefficient_final;
        range::parameter("friction_coefficient_final", last, &range::FRICTION, requirement)?;
        if energy > 0.0 {
            let requirement = "friction that runs in has coefficients above 0 at the start and at the end";
            for (name, value) in
                [("friction_coefficient", self.friction_coefficient), ("friction_coefficient_final", last)]
            {
                if value == 0.0 {
                    return Err(Error::Parameter { name, value, requirement });
                }
            }
        }
        Ok(())
    }

    fn validate_ellipse(&self) -> Result<(), Error> {
        if !matches!(self.profile, Profile::Ellipse { .. }) {
            return Ok(());
        }
        for (name, value) in
            [("wear_coefficient", self.wear_coefficient), ("wear_coefficient_2", self.wear_coefficient_2)]
        {
            if value > 0.0 {
                let requirement = "profile = ellipse has no worn shape: set wear_coefficient = 0 and wear_coefficient_2 = 0; the worn volume is \
                                   dissipated_energy times the wear coefficient over the hardness";
                return Err(Error::Parameter { name, value, requirement });
            }
        }
        Ok(())
    }

    fn validate_body_2(&self) -> Result<(), Error> {
        let (coefficient, hardness) = (self.wear_coefficient_2, self.hardness_2);
        let requirement = "a wear coefficient lies in 0 to 1e30";
        range::parameter("wear_coefficient_2", coefficient, &range::WEAR, requirement)?;
        if coefficient > 0.0 {
            let requirement = "body 2 wears, since wear_coefficient_2 > 0: its hardness lies in 1e-30 to 1e30 Pa; give \
                               it, or set wear_coefficient_2 = 0";
            return range::parameter("hardness_2", hardness, &range::STRESS, requirement);
        }
        let requirement =
            "the hardness of body 2 lies in 1e-30 to 1e30 Pa, or is 0 where body 2 does not wear";
        range::parameter("hardness_2", hardness, &(0.0..=*range::STRESS.end()), requirement)
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
