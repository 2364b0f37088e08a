//! Derivatives of outputs: with respect to inputs, and with respect to time.
//!
//! Those of the engine ([`crate::engine::FrettingContact::tangential_force_gradient`] and its like)
//! in the present sliding direction, with the profile as it is. In cyclic loading the displacement
//! is the amplitude, and what accumulates does not follow the inputs but grows with the cycles.
//! Before the end of the initialization the normal contact is computed again at any displacement,
//! so that nothing depends on the displacement but the displacement of the contact itself. Until
//! then there are derivatives with respect to parameters, too, since InitialUnknowns declares that
//! outputs depend on them.

use super::body::Body;
use super::component::Component;
use super::enumerations::Loading;
use super::refusal::{Checked, Refusal};
use super::settings::Inputs;
use super::values::{Asked, Table};
use super::variables::{Access, DataType, Direction, Output, Variable, Whole, variables};
use crate::engine::Gradient;
use core::mem::MaybeUninit;

/// Relative difference of a parameter for derivatives with respect to it: rounding and curvature
/// then count alike.
const DIFFERENCE: f64 = 6e-6;

/// How the inputs change, per unit of the variable of differentiation.
struct Change {
    normal: f64,
    displacement: f64,
    displacement_y: f64,
    rotation: f64,
    loading: Loading,
    /// Whether the contact may still be pressed on at another place.
    starting: bool,
}

impl Change {
    fn of(&self, output: &Output, contact: &Body) -> f64 {
        if self.starting
            && let Some(direction) = output.starts_anywhere
        {
            return match (self.loading, direction) {
                (Loading::Transient, Direction::X) => self.displacement,
                (Loading::Transient, Direction::Y) => self.displacement_y,
                (Loading::Cyclic, _) => 0.0,
            };
        }
        let still = self.displacement == 0.0 && self.displacement_y == 0.0 && self.rotation == 0.0;
        if self.normal == 0.0 && still || self.loading == Loading::Cyclic && output.per_cycle.is_some() {
            return 0.0;
        }
        let gradient = contact.gradient(output);
        if self.starting {
            return gradient.normal * self.normal;
        }
        gradient.normal * self.normal
            + gradient.displacement * self.displacement
            + gradient.displacement_y * self.displacement_y
            + gradient.rotation * self.rotation
    }
}

/// An output that changes by events alone.
const CONSTANT: Output = Output {
    whole: Whole::Deepest,
    read: |_| 0.0,
    gradient: |_| Gradient::default(),
    per_cycle: None,
    starts_anywhere: None,
    never_falls: false,
};

/// The outputs behind a list of references. `refuse` makes a refusal of a name and the reason.
fn outputs(references: &[u32], refuse: fn(String, String) -> Refusal) -> Checked<Vec<Output>> {
    let table = Table::get();
    let find = |reference: &u32| match table.find_any(*reference)? {
        Variable { access: Access::Output(output), .. } => Ok(*output),
        Variable { access: Access::WearThrough(_), .. } => Ok(CONSTANT),
        other => Err(refuse(other.name.to_string(), no_derivative(other)).into()),
    };
    references.iter().map(find).collect()
}

/// Why a variable has no derivative, and which ones have.
#[cold]
fn no_derivative(variable: &Variable) -> String {
    let reason = match (variable.causality(), variable.variability()) {
        ("output" | "local", "discrete") => "it is discrete".to_owned(),
        (causality, _) => format!("it has the causality {causality}"),
    };
    let with = variables().iter().filter(|other| matches!(other.access, Access::Output(_)));
    let names: Vec<_> = with.map(|other| other.name).collect();
    format!("{reason}; only continuous outputs have derivatives: {}", names.join(", "))
}

impl Component {
    /// fmi2GetDirectionalDerivative: `results` = ∂unknowns/∂knowns · `seed`.
    pub(super) fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        (knowns, seed): (&[u32], &[f64]),
        results: &mut [MaybeUninit<f64>],
    ) -> Checked {
        let outputs = outputs(unknowns, |name, reason| Refusal::Unknown { name, reason })?;
        let mut change = Inputs::ZERO;
        let mut by_parameters = vec![0.0; outputs.len()];
        for (&reference, &value) in knowns.iter().zip(seed) {
            let variable = Table::get().find(reference, Asked::Real)?;
            let name = || variable.name.to_string();
            if !value.is_finite() {
                let requirement = "give a finite number";
                return Err(Refusal::Derivative { name: name(), value, requirement }.into());
            }
            match variable.access {
                Access::Input(field) => *field(&mut change) += value,
                Access::Parameter(_) | Access::Tunable(_) if !self.model.is_initialized() => {
                    for (sum, slope) in
                        by_parameters.iter_mut().zip(self.parameter_slopes(variable, &outputs)?)
                    {
                        *sum += value * slope;
                    }
                }
                _ => return Err(Refusal::Known { name: name() }.into()),
            }
        }
        self.model.contact(&self.resources)?;
        let change = self.change(&change);
        if let (Some(contact), _) = self.model.parts() {
            for ((output, by_parameters), result) in outputs.iter().zip(by_parameters).zip(results) {
                result.write(by_parameters + change.of(output, contact));
            }
        }
        Ok(())
    }

    /// Derivatives of the initial values of outputs with respect to a parameter, by differences of
    /// two contacts that are built with others, central ones but at the ends of its range. What
    /// friction and wear switch on or off is no derivative.
    fn parameter_slopes(&mut self, variable: &Variable, outputs: &[Output]) -> Checked<Vec<f64>> {
        let settings = &self.model.staged().settings.clone();
        let (Access::Parameter(field) | Access::Tunable(field)) = variable.access else {
            return Ok(vec![0.0; outputs.len()]);
        };
        let value = *field(&mut settings.clone());
        let switch = matches!(variable.access, Access::Tunable(_)) && value == 0.0;
        let step = DIFFERENCE * if value == 0.0 { 1.0 } else { value.abs() };
        let [low, high] = [value - step, value + step].map(|moved| {
            let allowed =
                matches!(&variable.data_type, DataType::Real { range, .. } if range.contains(moved));
            if allowed { moved } else { value }
        });
        if switch || !(high - low).is_normal() {
            return Ok(vec![0.0; outputs.len()]);
        }
        let with = |value: f64| {
            let mut settings = settings.clone();
            *field(&mut settings) = value;
            self.model.beginning_with(&settings, &self.resources)
        };
        let (before, after) = (with(low)?, with(high)?);
        let slope = |output: &Output| (after.output(output) - before.output(output)) / (high - low);
        Ok(outputs.iter().map(slope).collect())
    }

    /// fmi2GetRealOutputDerivatives: how outputs change at the end of the last step, along which
    /// the inputs moved evenly. Derivatives of an order above maxOutputDerivativeOrder are 0, as in
    /// the standard's example.
    pub(super) fn output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &mut [MaybeUninit<f64>],
    ) -> Checked {
        let outputs = outputs(references, |name, reason| Refusal::OutputDerivative { name, reason })?;
        for (&reference, &order) in references.iter().zip(orders) {
            if order < 1 {
                let name = Table::get().find(reference, Asked::Real)?.name.to_string();
                return Err(Refusal::OutputDerivativeOrder { name, order }.into());
            }
        }
        let rates = self.model.staged().last_step.rates();
        let (frequency, amplitude) = self.model.staged().last_step.cycles();
        let change = self.change(&rates);
        if let (Some(contact), _) = self.model.parts() {
            for ((output, order), value) in outputs.iter().zip(orders).zip(values) {
                value.write(match output.per_cycle {
                    _ if *order > 1 => 0.0,
                    Some(per_cycle) if change.loading == Loading::Cyclic => {
                        if frequency > 0.0 {
                            frequency * contact.per_cycle(per_cycle, output, amplitude)
                        } else {
                            0.0
                        }
                    }
                    _ => change.of(output, contact),
                });
            }
        }
        Ok(())
    }

    /// What a change of the inputs means for the contact.
    fn change(&mut self, change: &Inputs) -> Change {
        let starting = !self.model.is_initialized();
        let settings = &self.model.staged().settings;
        let loading = settings.loading();
        let ([displacement, displacement_y], rotation) = match loading {
            Loading::Transient => (change.place(), change.rotation),
            Loading::Cyclic => ([change.displacement_amplitude, 0.0], 0.0),
        };
        let normal = change.normal(settings.normal_control());
        Change { normal, displacement, displacement_y, rotation, loading, starting }
    }
}
