//! Access to variables by value reference. A call is checked as a whole before any of it is carried out.

use super::component::Component;
use super::enumerations::Items;
use super::model::Model;
use super::refusal::{Checked, Refusal};
use super::settings::Inputs;
use super::variables::{Access, DataType, PROBES, Variable, variables};
use core::ffi::CStr;
use core::fmt::Debug;
use core::mem::MaybeUninit;
use libc::c_char;

/// The type that a function of the C interface is for.
#[derive(Debug, Clone, Copy)]
pub(super) enum Asked {
    Real,
    Integer,
    Boolean,
    String,
}

impl Asked {
    fn fits(self, data_type: &DataType) -> bool {
        match self {
            Self::Real => matches!(data_type, DataType::Real { .. }),
            Self::Integer => matches!(data_type, DataType::Integer { .. } | DataType::Enumeration(_)),
            Self::Boolean => false,
            Self::String => matches!(data_type, DataType::String),
        }
    }
}

/// The variable with this reference, if it is of the type asked for.
fn find(reference: u32, asked: Asked) -> Checked<&'static Variable> {
    let all = variables();
    let Some(variable) = all.get(reference as usize) else {
        return Err(Refusal::UnknownReference { reference, last: all.len() - 1 }.into());
    };
    if asked.fits(&variable.data_type) { Ok(variable) } else { Err(wrong_type(variable, reference, asked)) }
}

/// Access to a variable that [`find`] has found before.
fn access(reference: u32) -> Access {
    variables()[reference as usize].access
}

#[cold]
fn wrong_type(variable: &Variable, reference: u32, asked: Asked) -> Box<Refusal> {
    let actual = match variable.data_type {
        DataType::Enumeration(_) => "Integer (Enumeration)",
        _ => variable.data_type.name(),
    };
    let asked = format!("{asked:?}");
    Refusal::WrongType { name: variable.name.to_string(), reference, actual, asked }.into()
}

/// Refuses values that are not the importer's to set.
fn check_writable(model: &Model, variable: &Variable, value: &dyn Debug) -> Checked {
    let name = || variable.name.to_string();
    match variable.access {
        Access::Input(_) => Ok(()),
        Access::Parameter(_) | Access::Number(_) | Access::Text(_) if !model.is_initialized() => Ok(()),
        Access::Parameter(_) | Access::Number(_) | Access::Text(_) => {
            Err(Refusal::Fixed { name: name(), value: format!("{value:?}") }.into())
        }
        Access::Output(_) | Access::Slip(_) | Access::Field { .. } => Err(Refusal::ReadOnly {
            name: name(),
            value: format!("{value:?}"),
            causality: variable.causality(),
        }
        .into()),
    }
}

fn check_real(variable: &Variable, value: f64) -> Checked {
    match &variable.data_type {
        DataType::Real { range, .. } if !range.contains(value) => Err(Refusal::Value {
            name: variable.name.to_string(),
            value: format!("{value:?}"),
            requirement: range.to_string(),
        }
        .into()),
        _ => Ok(()),
    }
}

fn check_integer(variable: &Variable, value: i32) -> Checked {
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
    Err(Refusal::Value { name: variable.name.to_string(), value: value.to_string(), requirement }.into())
}

impl Component {
    pub(super) fn get_real(&mut self, references: &[u32], values: &mut [MaybeUninit<f64>]) -> Checked {
        let mut computed = false;
        for &reference in references {
            computed |=
                matches!(find(reference, Asked::Real)?.access, Access::Output(_) | Access::Field { .. });
        }
        if computed {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        let mut radii: Option<[f64; PROBES]> = None;
        for (&reference, value) in references.iter().zip(values) {
            value.write(match (access(reference), contact) {
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

    pub(super) fn set_real(&mut self, references: &[u32], values: &[f64]) -> Checked {
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Asked::Real)?;
            check_writable(&self.model, variable, &value)?;
            check_real(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match access(reference) {
                Access::Input(field) => *field(self.model.change_inputs()) = value,
                Access::Parameter(field) => *field(self.model.change_settings()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    pub(super) fn get_integer(&mut self, references: &[u32], values: &mut [MaybeUninit<i32>]) -> Checked {
        let mut computed = false;
        for &reference in references {
            computed |= matches!(find(reference, Asked::Integer)?.access, Access::Slip(_));
        }
        if computed {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        for (&reference, value) in references.iter().zip(values) {
            value.write(match (access(reference), contact) {
                (Access::Number(field), _) => *field(&mut staged.settings),
                (Access::Slip(read), Some(contact)) => read(contact).number(),
                other => unreachable!("not an integer variable, or not computed: {:?}", other.0),
            });
        }
        Ok(())
    }

    pub(super) fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Checked {
        for (&reference, &value) in references.iter().zip(values) {
            let variable = find(reference, Asked::Integer)?;
            check_writable(&self.model, variable, &value)?;
            check_integer(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match access(reference) {
                Access::Number(field) => *field(self.model.change_settings()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    /// There are no Boolean variables, so that any reference is a mistake.
    pub(super) fn no_boolean(&mut self, references: &[u32]) -> Checked {
        references.iter().try_for_each(|&reference| find(reference, Asked::Boolean).map(|_| ()))
    }

    /// The strings belong to the instance and hold until they are set anew.
    pub(super) fn get_string(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<*const c_char>],
    ) -> Checked {
        for &reference in references {
            find(reference, Asked::String)?;
        }
        let settings = &mut self.model.staged().settings;
        for (&reference, value) in references.iter().zip(values) {
            match access(reference) {
                Access::Text(field) => value.write(field(settings).as_ptr()),
                other => unreachable!("not a string variable: {other:?}"),
            };
        }
        Ok(())
    }

    /// None stands for a null pointer.
    pub(super) fn set_string(&mut self, references: &[u32], values: &[Option<&CStr>]) -> Checked {
        for (&reference, value) in references.iter().zip(values) {
            let variable = find(reference, Asked::String)?;
            let refuse = |problem| Refusal::Text { name: variable.name.to_string(), problem };
            let value = value.ok_or_else(|| refuse("the string is a null pointer"))?;
            check_writable(&self.model, variable, &value)?;
            value.to_str().map_err(|_| refuse("the string is not UTF-8"))?;
        }
        for (&reference, value) in references.iter().zip(values) {
            match (access(reference), value) {
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
    ) -> Checked {
        let given = || references.iter().zip(orders).zip(values);
        let mut slopes = self.model.staged().slopes;
        for ((&reference, &order), &value) in given() {
            let variable = find(reference, Asked::Real)?;
            let name = || variable.name.to_string();
            let Access::Input(field) = variable.access else {
                return Err(
                    Refusal::Derivative { name: name(), value, requirement: "it is not an input" }.into()
                );
            };
            if order != 1 {
                return Err(Refusal::DerivativeOrder { name: name(), order }.into());
            }
            if !value.is_finite() {
                return Err(
                    Refusal::Derivative { name: name(), value, requirement: "give a finite number" }.into()
                );
            }
            *field(&mut slopes) = value;
        }
        self.model.staged().slopes = slopes;
        Ok(())
    }

    /// Refuses a step of `length` at whose end a derivative takes an input out of its range.
    pub(super) fn check_targets(&mut self, length: f64) -> Checked {
        let staged = self.model.staged();
        if staged.slopes != Inputs::ZERO {
            let mut end = staged.inputs.after(&staged.slopes, length);
            for variable in variables() {
                if let Access::Input(field) = variable.access {
                    check_real(variable, *field(&mut end))?;
                }
            }
        }
        Ok(())
    }
}
