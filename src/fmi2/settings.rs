//! Parameters and inputs as the importer sets them, and the engine's parameters that follow.

use super::enumerations::{Items, Loading, ProfileKind};
use super::refusal::Checked;
use super::resources::Resources;
use crate::interface::Summit;
use crate::material::{Elastic, Pair};
use crate::parameters::{NormalControl, Parameters};
use crate::profile::{LengthUnit, Profile};
use serde::{Deserialize, Serialize};
use std::ffi::CString;

/// Values of all parameters of modelDescription.xml, each within its declared range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Settings {
    pub(super) profile: i32,
    pub(super) radius: f64,
    pub(super) cone_slope: f64,
    pub(super) exponent: f64,
    pub(super) coefficient: f64,
    pub(super) flat_radius: f64,
    pub(super) profile_file: CString,
    pub(super) profile_unit: i32,
    pub(super) youngs_modulus_1: f64,
    pub(super) poisson_ratio_1: f64,
    pub(super) youngs_modulus_2: f64,
    pub(super) poisson_ratio_2: f64,
    pub(super) friction_coefficient: f64,
    pub(super) friction_coefficient_final: f64,
    pub(super) running_in_energy: f64,
    pub(super) wear_coefficient: f64,
    pub(super) hardness: f64,
    pub(super) wear_coefficient_2: f64,
    pub(super) hardness_2: f64,
    pub(super) coating_thickness: f64,
    pub(super) probe_radius_max: f64,
    pub(super) normal_control: i32,
    pub(super) loading: i32,
    pub(super) rig_stiffness: f64,
    pub(super) resolution: i32,
    pub(super) tolerance: f64,
    pub(super) radius_x: f64,
    pub(super) radius_y: f64,
    pub(super) contacts_file: CString,
}

impl Default for Settings {
    /// The engine's defaults; the dimensions of the other profiles suit a contact of the same size.
    fn default() -> Self {
        let Parameters { materials: Pair { body_1, body_2 }, .. } = Parameters::default();
        let engine = Parameters::default();
        Self {
            profile: ProfileKind::Parabola.number(),
            radius: 0.01,
            cone_slope: 0.02,
            exponent: 2.0,
            coefficient: 50.0,
            flat_radius: 1e-4,
            profile_file: CString::default(),
            profile_unit: LengthUnit::M.number(),
            youngs_modulus_1: body_1.youngs_modulus,
            poisson_ratio_1: body_1.poisson_ratio,
            youngs_modulus_2: body_2.youngs_modulus,
            poisson_ratio_2: body_2.poisson_ratio,
            friction_coefficient: engine.friction_coefficient,
            friction_coefficient_final: engine.friction_coefficient_final,
            running_in_energy: engine.running_in_energy,
            wear_coefficient: engine.wear_coefficient,
            hardness: engine.hardness,
            wear_coefficient_2: engine.wear_coefficient_2,
            hardness_2: engine.hardness_2,
            coating_thickness: engine.coating_thickness,
            probe_radius_max: engine.probe_radius_max,
            normal_control: engine.normal_control.number(),
            loading: Loading::Transient.number(),
            rig_stiffness: Parameters::RIGID,
            resolution: engine.resolution as i32,
            tolerance: engine.tolerance,
            radius_x: 0.02,
            radius_y: 0.005,
            contacts_file: CString::default(),
        }
    }
}

impl Settings {
    pub(super) fn normal_control(&self) -> NormalControl {
        NormalControl::from_number(self.normal_control)
    }

    pub(super) fn loading(&self) -> Loading {
        Loading::from_number(self.loading)
    }

    /// What the engine is built from. Reads the profile file if there is one.
    pub(super) fn parameters(&self, resources: &Resources) -> Checked<Parameters> {
        Ok(self.parameters_with(self.profile(resources)?))
    }

    /// The contacts of an interface, read from their file; none where there is one contact.
    pub(super) fn summits(&self, resources: &Resources) -> Checked<Option<Vec<Summit>>> {
        if self.contacts_file.is_empty() {
            return Ok(None);
        }
        let unit = LengthUnit::from_number(self.profile_unit);
        resources.contacts(&self.contacts_file, unit).map(Some)
    }

    /// Whether these settings give those parameters, wherever the points of a table came from.
    pub(super) fn give(&self, parameters: &Parameters) -> bool {
        let table = ProfileKind::from_number(self.profile) == ProfileKind::Table;
        if table != matches!(parameters.profile, Profile::Table(_)) {
            return false;
        }
        let profile =
            if table { Ok(parameters.profile.clone()) } else { self.profile(&Resources::default()) };
        profile.is_ok_and(|profile| self.parameters_with(profile) == *parameters)
    }

    fn parameters_with(&self, profile: Profile) -> Parameters {
        let elastic = |youngs_modulus, poisson_ratio| Elastic { youngs_modulus, poisson_ratio };
        Parameters {
            materials: Pair {
                body_1: elastic(self.youngs_modulus_1, self.poisson_ratio_1),
                body_2: elastic(self.youngs_modulus_2, self.poisson_ratio_2),
            },
            profile,
            friction_coefficient: self.friction_coefficient,
            friction_coefficient_final: self.friction_coefficient_final,
            running_in_energy: self.running_in_energy,
            wear_coefficient: self.wear_coefficient,
            hardness: self.hardness,
            wear_coefficient_2: self.wear_coefficient_2,
            hardness_2: self.hardness_2,
            coating_thickness: self.coating_thickness,
            probe_radius_max: self.probe_radius_max,
            normal_control: self.normal_control(),
            rig_stiffness: self.rig_stiffness(),
            resolution: self.resolution as usize,
            tolerance: self.tolerance,
        }
    }

    /// Those of body 1 and body 2.
    pub(super) fn wear_coefficients(&self) -> [f64; 2] {
        [self.wear_coefficient, self.wear_coefficient_2]
    }

    /// Infinite where it is so for the engine: not every importer knows a number for that.
    fn rig_stiffness(&self) -> f64 {
        if self.rig_stiffness >= Parameters::RIGID { f64::INFINITY } else { self.rig_stiffness }
    }

    fn profile(&self, resources: &Resources) -> Checked<Profile> {
        let Self { radius, flat_radius, exponent, coefficient, cone_slope: slope, .. } = *self;
        let Self { radius_x, radius_y, .. } = *self;
        Ok(match ProfileKind::from_number(self.profile) {
            ProfileKind::Parabola => Profile::Parabola { radius },
            ProfileKind::Cone => Profile::Cone { slope },
            ProfileKind::PowerLaw => Profile::PowerLaw { exponent, coefficient },
            ProfileKind::BluntedSphere => Profile::BluntedSphere { radius, flat_radius },
            ProfileKind::RoundedPunch => Profile::RoundedPunch { radius, flat_radius },
            ProfileKind::FlatPunch => Profile::FlatPunch { flat_radius },
            ProfileKind::Table => {
                let unit = LengthUnit::from_number(self.profile_unit);
                Profile::Table(resources.profile_table(&self.profile_file, unit)?)
            }
            ProfileKind::Ellipse => Profile::Ellipse { radius_x, radius_y },
        })
    }
}

/// Values of all inputs, or of their derivatives with respect to time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Inputs {
    pub(super) normal_force: f64,
    pub(super) indentation: f64,
    pub(super) tangential_displacement: f64,
    pub(super) displacement_amplitude: f64,
    pub(super) frequency: f64,
    pub(super) tangential_displacement_y: f64,
    pub(super) rotation: f64,
}

impl Default for Inputs {
    /// 100 N on the default contact, or the indentation depth that belongs to it; the bodies are
    /// not displaced.
    fn default() -> Self {
        Self {
            normal_force: 100.0,
            indentation: 3.48291e-6,
            tangential_displacement: 0.0,
            displacement_amplitude: Self::AMPLITUDE,
            frequency: 1.0,
            tangential_displacement_y: 0.0,
            rotation: 0.0,
        }
    }
}

impl Inputs {
    /// Start value of the amplitude, m.
    pub(super) const AMPLITUDE: f64 = 1e-6;

    /// Nothing, as the derivatives of constant inputs.
    pub(super) const ZERO: Self = Self {
        normal_force: 0.0,
        indentation: 0.0,
        tangential_displacement: 0.0,
        displacement_amplitude: 0.0,
        frequency: 0.0,
        tangential_displacement_y: 0.0,
        rotation: 0.0,
    };

    /// Each with its like of others.
    fn with(&self, others: &Self, of: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            normal_force: of(self.normal_force, others.normal_force),
            indentation: of(self.indentation, others.indentation),
            tangential_displacement: of(self.tangential_displacement, others.tangential_displacement),
            displacement_amplitude: of(self.displacement_amplitude, others.displacement_amplitude),
            frequency: of(self.frequency, others.frequency),
            tangential_displacement_y: of(self.tangential_displacement_y, others.tangential_displacement_y),
            rotation: of(self.rotation, others.rotation),
        }
    }

    /// The inputs after `time`, s, when they change at the rates `slopes`.
    pub(super) fn after(&self, slopes: &Self, time: f64) -> Self {
        self.with(slopes, |value, slope| value + slope * time)
    }

    /// Rates of change over `time`, s, since `start`.
    pub(super) fn rates(&self, start: &Self, time: f64) -> Self {
        self.with(start, |end, start| (end - start) / time)
    }

    /// Whether all are finite.
    pub(super) fn is_finite(&self) -> bool {
        // less itself an infinite number is no number, and nothing equals that
        self.with(self, |value, same| value - same) == Self::ZERO
    }

    /// The quantity that `control` prescribes, N or m.
    pub(super) fn normal(&self, control: NormalControl) -> f64 {
        match control {
            NormalControl::Force => self.normal_force,
            NormalControl::Indentation => self.indentation,
        }
    }

    /// The displacement in the plane, m.
    pub(super) fn place(&self) -> [f64; 2] {
        [self.tangential_displacement, self.tangential_displacement_y]
    }

    /// The inputs in use, for messages.
    pub(super) fn describe(&self, settings: &Settings) -> String {
        let normal = match settings.normal_control() {
            NormalControl::Force => format!("normal_force = {:?} N", self.normal_force),
            NormalControl::Indentation => format!("indentation = {:?} m", self.indentation),
        };
        match settings.loading() {
            Loading::Transient => {
                let [x, y] = self.place();
                let along_y =
                    if y == 0.0 { String::new() } else { format!(", tangential_displacement_y = {y:?} m") };
                let turned = match self.rotation {
                    0.0 => String::new(),
                    angle => format!(", rotation = {angle:?} rad"),
                };
                format!("{normal}, tangential_displacement = {x:?} m{along_y}{turned}")
            }
            Loading::Cyclic => format!(
                "{normal}, displacement_amplitude = {:?} m, frequency = {:?} Hz",
                self.displacement_amplitude, self.frequency
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_start_values_are_the_engines_defaults() {
        let parameters = Settings::default().parameters(&Resources::default()).unwrap();
        assert_eq!(parameters, Parameters::default());
    }

    #[test]
    fn every_profile_is_usable_with_its_start_values() {
        for kind in ProfileKind::ALL.iter().filter(|kind| **kind != ProfileKind::Table) {
            let mut settings = Settings { profile: kind.number(), ..Settings::default() };
            if *kind == ProfileKind::Ellipse {
                settings.wear_coefficient = 0.0;
            }
            let parameters = settings.parameters(&Resources::default()).unwrap();
            assert!(parameters.validate().is_ok(), "{kind:?}");
        }
    }
}
