//! Access to variables by value reference. A call is checked as a whole before any of it is carried out.

use super::component::Component;
use super::enumerations::Items;
use super::model::Model;
use super::refusal::Refusal;
use super::settings::Inputs;
use super::variables::{Access, DataType, PROBES, Variable, variables};
use core::ffi::{CStr, c_char};
use core::fmt::Debug;
use core::mem::MaybeUninit;

/// The type that a function of the C interface is for.
#[derive(Clone, Copy)]
pub(super) enum Asked {
    Real,
    Integer,
    Boolean,
    String,
}

/// The variable with this reference, if it is of the type asked for.
fn find(reference: u32, asked: Asked) -> Result<&'static Variable, Refusal> {
    let all = variables();
    let variable =
        all.get(reference as usize).ok_or(Refusal::UnknownReference { reference, last: all.len() - 1 })?;
    let (fits, asked) = match asked {
        Asked::Real => (matches!(variable.data_type, DataType::Real { .. }), "Real"),
        Asked::Integer => {
            (matches!(variable.data_type, DataType::Integer { .. } | DataType::Enumeration(_)), "Integer")
        }
        Asked::Boolean => (false, "Boolean"),
        Asked::String => (matches!(variable.data_type, DataType::String), "String"),
    };
    if fits {
        return Ok(variable);
    }
    let actual = match variable.data_type {
        DataType::Enumeration(_) => "Integer (Enumeration)",
        _ => variable.data_type.name(),
    };
    Err(Refusal::WrongType { name: variable.name.to_string(), reference, actual, asked })
}

/// Refuses values that are not the importer's to set.
fn check_writable(model: &Model, variable: &Variable, value: &dyn Debug) -> Result<(), Refusal> {
    let name = || variable.name.to_string();
    match variable.access {
        Access::Input(_) => Ok(()),
        Access::Parameter(_) | Access::Number(_) | Access::Text(_) if !model.is_initialized() => Ok(()),
        Access::Parameter(_) | Access::Number(_) | Access::Text(_) => {
            Err(Refusal::Fixed { name: name(), value: format!("{value:?}") })
        }
        Access::Output(_) | Access::Slip(_) | Access::Field { .. } => Err(Refusal::ReadOnly {
            name: name(),
            value: format!("{value:?}"),
            causality: variable.causality(),
        }),
    }
}

fn check_real(variable: &Variable, value: f64) -> Result<(), Refusal> {
    match &variable.data_type {
        DataType::Real { range, .. } if !range.contains(value) => Err(Refusal::Value {
            name: variable.name.to_string(),
            value: format!("{value:?}"),
            requirement: range.to_string(),
        }),
        _ => Ok(()),
    }
}

fn check_integer(variable: &Variable, value: i32) -> Result<(), Refusal> {
    let (accepted, requirement) = match &variable.data_type {
        DataType::Integer { min, max } => ((*min..=*max).contains(&value), format!("give {min} to {max}")),
        DataType::Enumeration(enumeration) => {
            let items = enumeration.items.iter().enumerate();
            let list: Vec<_> = items.map(|(index, (name, _))| format!("{} = {name}", index + 1)).collect();
            ((1..=list.len() as i32).contains(&value), format!("give one of {}", list.join(", ")))
        }
        _ => return Ok(()),
    };
    if accepted {
        return Ok(());
    }
    Err(Refusal::Value { name: variable.name.to_string(), value: value.to_string(), requirement })
}

impl Component {
    pub(super) fn get_real(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<f64>],
    ) -> Result<(), Refusal> {
        let found = || references.iter().map(|&reference| find(reference, Asked::Real));
        let mut computed = false;
        for variable in found() {
            computed |= matches!(variable?.access, Access::Output(_) | Access::Field { .. });
        }
        if computed {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        let mut radii: Option<[f64; PROBES]> = None;
        for (variable, value) in found().zip(values) {
            value.write(match (variable?.access, contact) {
                (Access::Input(field), _) => *field(&mut staged.inputs),
                (Access::Parameter(field), _) => *field(&mut staged.settings),
                (Access::Output(read), Some(contact)) => read(contact),
                (Access::Field { probe, read }, Some(contact)) => {
                    let radii = radii.get_or_insert_with(|| contact.probe_radii());
                    read(contact, radii[probe])
                }
                other => unreachable!("not a real variable, or not computed: {:?}", other.0),
            });
        }
        Ok(())
    }

    pub(super) fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Refusal> {
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Asked::Real)?;
            check_writable(&self.model, variable, &value)?;
            check_real(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match find(reference, Asked::Real)?.access {
                Access::Input(field) => *field(self.model.change_inputs()) = value,
                Access::Parameter(field) => *field(self.model.change_settings()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    pub(super) fn get_integer(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<i32>],
    ) -> Result<(), Refusal> {
        let found = || references.iter().map(|&reference| find(reference, Asked::Integer));
        let mut computed = false;
        for variable in found() {
            computed |= matches!(variable?.access, Access::Slip(_));
        }
        if computed {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        for (variable, value) in found().zip(values) {
            value.write(match (variable?.access, contact) {
                (Access::Number(field), _) => *field(&mut staged.settings),
                (Access::Slip(read), Some(contact)) => read(contact).number(),
                other => unreachable!("not an integer variable, or not computed: {:?}", other.0),
            });
        }
        Ok(())
    }

    pub(super) fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Result<(), Refusal> {
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Asked::Integer)?;
            check_writable(&self.model, variable, &value)?;
            check_integer(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match find(reference, Asked::Integer)?.access {
                Access::Number(field) => *field(self.model.change_settings()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    /// There are no Boolean variables, so that any reference is a mistake.
    pub(super) fn no_boolean(&mut self, references: &[u32]) -> Result<(), Refusal> {
        references.iter().try_for_each(|&reference| find(reference, Asked::Boolean).map(|_| ()))
    }

    /// The strings belong to the instance and hold until they are set anew.
    pub(super) fn get_string(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<*const c_char>],
    ) -> Result<(), Refusal> {
        for &reference in references {
            find(reference, Asked::String)?;
        }
        let settings = &mut self.model.staged().settings;
        for (&reference, value) in references.iter().zip(values) {
            match find(reference, Asked::String)?.access {
                Access::Text(field) => value.write(field(settings).as_ptr()),
                other => unreachable!("not a string variable: {other:?}"),
            };
        }
        Ok(())
    }

    /// None stands for a null pointer.
    pub(super) fn set_string(&mut self, references: &[u32], values: &[Option<&CStr>]) -> Result<(), Refusal> {
        for (&reference, value) in references.iter().zip(values) {
            let variable = find(reference, Asked::String)?;
            let refuse = |problem| Refusal::Text { name: variable.name.to_string(), problem };
            let value = value.ok_or_else(|| refuse("the string is a null pointer"))?;
            check_writable(&self.model, variable, &value)?;
            value.to_str().map_err(|_| refuse("the string is not UTF-8"))?;
        }
        for (&reference, value) in references.iter().zip(values) {
            match (find(reference, Asked::String)?.access, value) {
                (Access::Text(field), Some(value)) => {
                    *field(self.model.change_settings()) = (*value).to_owned()
                }
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    pub(super) fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Refusal> {
        let given = || references.iter().zip(orders).zip(values);
        let mut slopes = self.model.staged().slopes;
        for ((&reference, &order), &value) in given() {
            let variable = find(reference, Asked::Real)?;
            let name = variable.name.to_string();
            let Access::Input(field) = variable.access else {
                return Err(Refusal::Derivative { name, value, requirement: "it is not an input" });
            };
            if order != 1 {
                return Err(Refusal::DerivativeOrder { name, order });
            }
            if !value.is_finite() {
                return Err(Refusal::Derivative { name, value, requirement: "give a finite number" });
            }
            *field(&mut slopes) = value;
        }
        self.model.staged().slopes = slopes;
        Ok(())
    }

    /// fmi2DoStep, after a look at where derivatives take the inputs.
    pub(super) fn step_with_derivatives(&mut self, point: f64, length: f64) -> Result<(), Refusal> {
        let staged = self.model.staged();
        if staged.slopes != Inputs::ZERO && length > 0.0 {
            let mut end = staged.inputs.after(&staged.slopes, length);
            for variable in variables() {
                if let Access::Input(field) = variable.access {
                    check_real(variable, *field(&mut end))?;
                }
            }
        }
        self.do_step(point, length)
    }
}
