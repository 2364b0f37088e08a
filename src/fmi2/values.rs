//! Access to variables by value reference. A call is checked as a whole before any of it is carried
//! out.

use super::body::Body;
use super::component::Component;
use super::enumerations::Items;
use super::model::{Model, Staged};
use super::refusal::{Checked, Refusal};
use super::settings::{Inputs, Settings};
use super::variables::{Access, DataType, PROBES, Range, Variable, WearThrough, variables};
use crate::engine::FrettingContact;
use core::ffi::CStr;
use core::fmt::Debug;
use core::mem::MaybeUninit;
use fmi_sys::fmi2::fmi2Boolean;
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
    #[inline]
    fn fits(self, data_type: &DataType) -> bool {
        match self {
            Self::Real => matches!(data_type, DataType::Real { .. }),
            Self::Integer => matches!(data_type, DataType::Integer { .. } | DataType::Enumeration(_)),
            Self::Boolean => matches!(data_type, DataType::Boolean),
            Self::String => matches!(data_type, DataType::String),
        }
    }
}

/// The variable table. Calls fetch it once, since even that costs a check each time.
#[derive(Clone, Copy)]
pub(super) struct Table(&'static [Variable]);

impl Table {
    #[inline]
    pub(super) fn get() -> Self {
        Self(variables())
    }

    /// The variable with this reference, if it has the requested type.
    #[inline]
    pub(super) fn find(self, reference: u32, asked: Asked) -> Checked<&'static Variable> {
        match self.0.get(reference as usize) {
            Some(variable) if asked.fits(&variable.data_type) => Ok(variable),
            found => Err(not_found(found, reference, asked)),
        }
    }

    /// The variable with this reference, of any type.
    pub(super) fn find_any(self, reference: u32) -> Checked<&'static Variable> {
        self.0.get(reference as usize).ok_or_else(|| unknown(reference))
    }

    /// Access to a variable that [`Self::find`] has found before.
    #[inline]
    pub(super) fn access(self, reference: u32) -> &'static Access {
        &self.0[reference as usize].access
    }
}

#[cold]
fn unknown(reference: u32) -> Box<Refusal> {
    Refusal::UnknownReference { reference, last: variables().len() - 1 }.into()
}

#[cold]
fn not_found(found: Option<&Variable>, reference: u32, asked: Asked) -> Box<Refusal> {
    let Some(variable) = found else {
        return unknown(reference);
    };
    let actual = match variable.data_type {
        DataType::Enumeration(_) => "Integer (Enumeration)",
        _ => variable.data_type.name(),
    };
    let asked = format!("{asked:?}");
    Refusal::WrongType { name: variable.name.to_string(), reference, actual, asked }.into()
}

/// Refuses values that are not the importer's to set.
#[inline]
fn check_writable(model: &Model, variable: &Variable, value: impl Debug) -> Checked {
    match variable.access {
        Access::Input(_) | Access::Tunable(_) => Ok(()),
        access if !access.is_computed() && !model.is_initialized() => Ok(()),
        _ => Err(not_writable(variable, &value)),
    }
}

#[cold]
fn not_writable(variable: &Variable, value: &dyn Debug) -> Box<Refusal> {
    let (name, value) = (variable.name.to_string(), format!("{value:?}"));
    if variable.access.is_computed() {
        Refusal::ReadOnly { name, value, causality: variable.causality() }
    } else {
        Refusal::Fixed { name, value }
    }
    .into()
}

#[inline]
fn check_real(variable: &Variable, value: f64) -> Checked {
    match &variable.data_type {
        DataType::Real { range, .. } if !range.contains(value) => Err(out_of_range(variable, range, value)),
        _ => Ok(()),
    }
}

#[cold]
fn out_of_range(variable: &Variable, range: &Range, value: f64) -> Box<Refusal> {
    let (name, requirement) = (variable.name.to_string(), range.to_string());
    Refusal::Value { name, value: format!("{value:?}"), requirement }.into()
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

/// Refuses inputs of which one is out of its range.
pub(super) fn check_inputs(inputs: &Inputs) -> Checked {
    let mut inputs = *inputs;
    for variable in variables() {
        if let Access::Input(field) = variable.access {
            check_real(variable, *field(&mut inputs))?;
        }
    }
    Ok(())
}

/// Refuses settings of which one is out of its range.
pub(super) fn check_settings(settings: &Settings) -> Checked {
    let mut settings = settings.clone();
    for variable in variables() {
        match variable.access {
            Access::Parameter(field) | Access::Tunable(field) => check_real(variable, *field(&mut settings))?,
            Access::Number(field) => check_integer(variable, *field(&mut settings))?,
            Access::Text(field) if field(&mut settings).to_str().is_err() => {
                let (name, problem) = (variable.name.to_string(), "the string is not UTF-8");
                return Err(Refusal::Text { name, problem }.into());
            }
            _ => {}
        }
    }
    Ok(())
}

/// Reads real variables other than outputs without a memory.
struct Reader<'a> {
    contact: Option<&'a Body>,
    staged: &'a mut Staged,
    /// Found once in a call, like `deepest`.
    radii: Option<[f64; PROBES]>,
    /// The contact of an interface whose fields are given.
    deepest: Option<Box<FrettingContact>>,
    /// A field that has no numbers.
    unknown: Option<u32>,
}

impl Reader<'_> {
    #[inline(never)]
    fn read(&mut self, reference: u32, access: &Access) -> f64 {
        let Self { contact, staged, .. } = self;
        match (access, *contact) {
            (Access::Input(field), _) => *field(&mut staged.inputs),
            (Access::Parameter(field) | Access::Tunable(field), _) => *field(&mut staged.settings),
            (Access::Output(output), Some(contact)) => {
                staged.deepest_read = staged.deepest_read.max(contact.output(output));
                staged.deepest_read
            }
            (Access::SlipNumber(read), Some(contact)) => contact.slip_state(*read).number().into(),
            (Access::WearThrough(which), Some(contact)) => {
                staged.look_at_coating(contact);
                match which {
                    WearThrough::Time => staged.worn_through_at.unwrap_or(0.0),
                    WearThrough::Cycles => contact.cycles_to_wear_through().unwrap_or(0.0),
                }
            }
            (Access::Field { probe, read }, Some(contact)) => {
                let value = self.field(contact, *probe, *read);
                if value.is_nan() {
                    self.unknown = Some(reference);
                }
                value
            }
            other => unreachable!("not a real variable, or not computed: {:?}", other.0),
        }
    }

    /// A field at one of the probe radii.
    fn field(&mut self, contact: &Body, probe: usize, read: fn(&FrettingContact, f64) -> f64) -> f64 {
        let contact = match contact {
            Body::One(contact) => contact,
            Body::Many(interface) => {
                self.deepest.get_or_insert_with(|| Box::new(interface.read_deepest(FrettingContact::clone)))
            }
        };
        let radii = self.radii.get_or_insert_with(|| contact.probe_radii());
        read(contact, radii[probe])
    }
}

impl Component {
    pub(super) fn get_real(&mut self, references: &[u32], values: &mut [MaybeUninit<f64>]) -> Checked {
        let table = Table::get();
        for &reference in references {
            table.find(reference, Asked::Real)?;
        }
        let is_computed = |reference: &u32| table.access(*reference).is_computed();
        if self.model.has_to_start() && references.iter().any(is_computed) {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        let mut reader = Reader { contact, staged, radii: None, deepest: None, unknown: None };
        for (&reference, value) in references.iter().zip(values) {
            value.write(match (table.access(reference), contact) {
                (Access::Output(output), Some(contact)) if !output.never_falls => contact.output(output),
                (access, _) => reader.read(reference, access),
            });
        }
        if let Some(reference) = reader.unknown {
            let name = table.find(reference, Asked::Real)?.name;
            self.warn_of_unknown_field(name);
        }
        Ok(())
    }

    pub(super) fn set_real(&mut self, references: &[u32], values: &[f64]) -> Checked {
        let table = Table::get();
        for (&reference, &value) in references.iter().zip(values) {
            let variable = table.find(reference, Asked::Real)?;
            let Access::Input(_) = variable.access else {
                return self.set_reals_of_any_kind(references, values);
            };
            check_real(variable, value)?;
        }
        // inputs alone, as before each step
        let inputs = self.model.change_inputs();
        for (&reference, &value) in references.iter().zip(values) {
            if let Access::Input(field) = table.access(reference) {
                *field(inputs) = value;
            }
        }
        Ok(())
    }

    #[cold]
    fn set_reals_of_any_kind(&mut self, references: &[u32], values: &[f64]) -> Checked {
        let table = Table::get();
        for (&reference, &value) in references.iter().zip(values) {
            let variable = table.find(reference, Asked::Real)?;
            check_writable(&self.model, variable, value)?;
            check_real(variable, value)?;
            if let Access::Tunable(field) = variable.access {
                self.check_switch(variable, field, value)?;
            }
        }
        for (&reference, &value) in references.iter().zip(values) {
            match table.access(reference) {
                Access::Input(field) => *field(self.model.change_inputs()) = value,
                Access::Parameter(field) => *field(self.model.change_settings()) = value,
                Access::Tunable(field) => *field(self.model.tune()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    /// Refuses to switch friction or wear on or off once the contact has been built for it.
    #[cold]
    fn check_switch(
        &mut self,
        variable: &Variable,
        field: fn(&mut Settings) -> &mut f64,
        value: f64,
    ) -> Checked {
        let present = *field(&mut self.model.staged().settings);
        if !self.model.is_initialized() || (present == 0.0) == (value == 0.0) {
            return Ok(());
        }
        let (name, value) = (variable.name.to_string(), format!("{value:?}"));
        let requirement = format!(
            "it is {present:?} since the initialization, and cannot change to or from 0; call fmi2Reset to switch it on or off"
        );
        Err(Refusal::Value { name, value, requirement }.into())
    }

    pub(super) fn get_integer(&mut self, references: &[u32], values: &mut [MaybeUninit<i32>]) -> Checked {
        let table = Table::get();
        let mut computed = false;
        for &reference in references {
            let access = table.find(reference, Asked::Integer)?.access;
            computed |= matches!(access, Access::Slip(_) | Access::Count { .. });
        }
        if computed {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        for (&reference, value) in references.iter().zip(values) {
            value.write(match (table.access(reference), contact) {
                (Access::Number(field), _) => *field(&mut staged.settings),
                (Access::Slip(read), Some(contact)) => contact.slip_state(*read).number(),
                (Access::Count { one, .. }, Some(Body::One(contact))) => one(contact),
                (Access::Count { many, .. }, Some(Body::Many(interface))) => many(interface),
                other => unreachable!("not an integer variable, or not computed: {:?}", other.0),
            });
        }
        Ok(())
    }

    pub(super) fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Checked {
        let table = Table::get();
        for (&reference, &value) in references.iter().zip(values) {
            let variable = table.find(reference, Asked::Integer)?;
            check_writable(&self.model, variable, value)?;
            check_integer(variable, value)?;
        }
        for (&reference, &value) in references.iter().zip(values) {
            match table.access(reference) {
                Access::Number(field) => *field(self.model.change_settings()) = value,
                other => unreachable!("checked above: {other:?}"),
            }
        }
        Ok(())
    }

    pub(super) fn get_boolean(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<fmi2Boolean>],
    ) -> Checked {
        let table = Table::get();
        for &reference in references {
            table.find(reference, Asked::Boolean)?;
        }
        if !references.is_empty() {
            self.model.contact(&self.resources)?;
        }
        let (contact, staged) = self.model.parts();
        for (&reference, value) in references.iter().zip(values) {
            value.write(match (table.access(reference), contact) {
                (Access::WornThrough, Some(contact)) => staged.look_at_coating(contact).into(),
                other => unreachable!("not a Boolean variable, or not computed: {:?}", other.0),
            });
        }
        Ok(())
    }

    /// No Boolean variable is the importer's to set.
    pub(super) fn set_boolean(&mut self, references: &[u32], values: &[fmi2Boolean]) -> Checked {
        let table = Table::get();
        for (&reference, &value) in references.iter().zip(values) {
            let variable = table.find(reference, Asked::Boolean)?;
            check_writable(&self.model, variable, value != 0)?;
        }
        Ok(())
    }

    /// The strings belong to the instance and hold until they are set again.
    pub(super) fn get_string(
        &mut self,
        references: &[u32],
        values: &mut [MaybeUninit<*const c_char>],
    ) -> Checked {
        let table = Table::get();
        for &reference in references {
            table.find(reference, Asked::String)?;
        }
        let settings = &mut self.model.staged().settings;
        for (&reference, value) in references.iter().zip(values) {
            match table.access(reference) {
                Access::Text(field) => value.write(field(settings).as_ptr()),
                other => unreachable!("not a string variable: {other:?}"),
            };
        }
        Ok(())
    }

    /// `None` is a null pointer.
    pub(super) fn set_string(&mut self, references: &[u32], values: &[Option<&CStr>]) -> Checked {
        let table = Table::get();
        for (&reference, value) in references.iter().zip(values) {
            let variable = table.find(reference, Asked::String)?;
            let refuse = |problem| Refusal::Text { name: variable.name.to_string(), problem };
            let value = value.ok_or_else(|| refuse("the string is a null pointer"))?;
            check_writable(&self.model, variable, value)?;
            value.to_str().map_err(|_| refuse("the string is not UTF-8"))?;
        }
        for (&reference, value) in references.iter().zip(values) {
            match (table.access(reference), value) {
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
        let table = Table::get();
        let given = || references.iter().zip(orders).zip(values);
        let mut slopes = self.model.staged().slopes.unwrap_or(Inputs::ZERO);
        for ((&reference, &order), &value) in given() {
            let variable = table.find(reference, Asked::Real)?;
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
        self.model.staged().slopes = (slopes != Inputs::ZERO).then_some(slopes);
        Ok(())
    }

    /// Refuses a step of `length` at whose end a derivative takes an input out of its range.
    pub(super) fn check_targets(&mut self, length: f64) -> Checked {
        let staged = self.model.staged();
        if let Some(slopes) = &staged.slopes {
            check_inputs(&staged.inputs.after(slopes, length))?;
        }
        Ok(())
    }
}
