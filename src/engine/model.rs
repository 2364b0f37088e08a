//! What a contact is made of, and what follows from that: it does not change in a step, but for
//! the coefficient of friction while friction runs in.

use super::axes::Axes;
use super::tuning::{Tuning, USUAL};
use crate::error::Error;
use crate::friction::Samples;
use crate::parameters::{NormalControl, Parameters};
use crate::profile::Profile;
use crate::wear::Constants;
use std::sync::Arc;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Model {
    pub(super) parameters: Arc<Parameters>,
    pub(super) constants: Constants,
    /// m = μE*/G*, from `constants`.
    pub(super) bound_slope: f64,
    /// m at the start of the present line: another one while friction runs in.
    pub(super) start_slope: f64,
    /// 1/k_rig, m/N; 0 where the contact is driven directly.
    pub(super) compliance: f64,
    pub(super) axes: Axes,
    pub(super) tuning: Tuning,
}

impl Model {
    /// The model of parameters that have been validated, and the body of revolution that is
    /// pressed: that of the parameters, or the equivalent sphere of an ellipse.
    ///
    /// # Errors
    /// [`Error::Parameter`] for radii that make no ellipse.
    pub(crate) fn new(parameters: Parameters) -> Result<(Self, Profile), Error> {
        let materials = &parameters.materials;
        let (body, axes, tangential_modulus) = match parameters.profile.ellipse()? {
            None => (parameters.profile.clone(), Axes::CIRCLE, materials.tangential_modulus()),
            Some(ellipse) => (
                Profile::Parabola { radius: ellipse.equivalent_radius() },
                Axes::new(&ellipse, materials),
                // along x
                ellipse.tangential_moduli(materials)[0],
            ),
        };
        Ok((Self::with_axes(Arc::new(parameters), axes, tangential_modulus), body))
    }

    fn with_axes(parameters: Arc<Parameters>, axes: Axes, tangential_modulus: f64) -> Self {
        let constants = Constants {
            normal_modulus: parameters.materials.normal_modulus(),
            tangential_modulus,
            friction_coefficient: parameters.friction_coefficient,
            wear_per_work: parameters.wear_per_work(),
            force_control: parameters.normal_control == NormalControl::Force,
        };
        Self {
            bound_slope: constants.bound_slope(),
            start_slope: constants.bound_slope(),
            compliance: parameters.rig_compliance(),
            parameters,
            constants,
            axes,
            tuning: USUAL,
        }
    }

    /// Samples of springs across the contact.
    pub(super) fn samples(&self) -> Samples {
        Samples(self.tuning.samples_per_cell * self.parameters.resolution)
    }

    /// Whether wear is computed.
    pub(super) fn wears(&self) -> bool {
        self.constants.wear_per_work > 0.0 && self.constants.friction_coefficient > 0.0
    }

    /// 2E*, the ratio of force to load integral, Pa.
    pub(crate) fn force_scale(&self) -> f64 {
        2.0 * self.constants.normal_modulus
    }
}
