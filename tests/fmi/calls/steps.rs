//! Calls on values, steps, derivatives and statuses.

use super::bytes::Record;
use super::model::{Expected, Group, is_real_output, reference};
use super::{Called, Host, LEAST_TOLERANCE, MOST_WEARING_CELLS, MOST_WEARING_STEPS, TEXTS};
use core::ffi::CStr;
use core::ptr::{null, null_mut};
use fretting_contact::fmi2::exports::*;
use fretting_contact::fmi2::variables::variables;

// SAFETY of every call below: see the parent module.
impl Host {
    pub(super) fn set_real(&mut self, record: Record) -> Called {
        let references = record.references();
        let values = record.reals(&references);
        let (pointer, count) = match record.mode() >> 1 & 7 {
            1 => (null(), references.len()),
            2 => (references.as_ptr(), usize::MAX),
            3 => (null(), 0),
            _ => (references.as_ptr(), references.len()),
        };
        // SAFETY: see above; null and impossible lengths are refused, an empty list is not read.
        let status = unsafe { fmi2SetReal(self.component, pointer, count, values.as_ptr()) };
        let expected = match count {
            0 => self.model.gated(Group::Set, Expected::Ok),
            usize::MAX => Expected::Error,
            _ if pointer.is_null() => Expected::Error,
            _ => self.model.set_reals(&references, &values),
        };
        (status, expected)
    }

    pub(super) fn get_real(&mut self, record: Record) -> Called {
        let references = record.references();
        let mut values = vec![f64::NAN; references.len()];
        let spoiled = record.mode() & 31 == 31;
        let place = if spoiled { null_mut() } else { values.as_mut_ptr() };
        // SAFETY: see above; null is refused.
        let status = unsafe { fmi2GetReal(self.component, references.as_ptr(), references.len(), place) };
        if spoiled {
            return (status, Expected::Error);
        }
        if status == 0 {
            for (&reference, value) in references.iter().zip(values) {
                match self.model.known_real(reference) {
                    Some(known) => assert_eq!(value.to_bits(), known.to_bits(), "variable {reference}"),
                    // work per area is not known in every state
                    None if variables()[reference as usize].name.starts_with("energy_density") => {}
                    None => assert!(!value.is_nan(), "variable {reference} in {:?}", self.model),
                }
            }
        }
        (status, self.model.get(&references, &["Real"]))
    }

    /// Strings, and Booleans, which are outputs.
    pub(super) fn text(&mut self, record: Record) -> Called {
        let c = self.component;
        let target =
            [if record.mode() & 1 != 0 { record.references()[0] } else { reference("profile_file") }];
        let text: Option<&'static std::ffi::CString> = TEXTS.get(record.index() % 5);
        // SAFETY: see above; the string that is got is looked at before the next call.
        unsafe {
            match record.mode() >> 1 & 3 {
                0 => {
                    let status =
                        fmi2SetString(c, target.as_ptr(), 1, [text.map_or(null(), |t| t.as_ptr())].as_ptr());
                    (status, self.model.set_text(target[0], text.map(|t| t.to_str().expect("it is UTF-8"))))
                }
                1 => {
                    let mut value = [null()];
                    let status = fmi2GetString(c, target.as_ptr(), 1, value.as_mut_ptr());
                    if status == 0 {
                        assert_eq!(CStr::from_ptr(value[0]).to_str(), Ok(self.model.known_text(target[0])));
                    }
                    (status, self.model.get(&target, &["String"]))
                }
                2 => {
                    let status = fmi2GetBoolean(c, target.as_ptr(), 1, [0].as_mut_ptr());
                    (status, self.model.get(&target, &["Boolean"]))
                }
                _ => (
                    fmi2SetBoolean(c, target.as_ptr(), 0, null()),
                    self.model.gated(Group::Set, Expected::Ok),
                ),
            }
        }
    }

    pub(super) fn step(&mut self, record: Record) -> Called {
        let wears =
            self.model.value("wear_coefficient") > 0.0 || self.model.value("wear_coefficient_2") > 0.0;
        if self.model.allows(Group::Step) && wears {
            let cheap = self.model.number("resolution") <= MOST_WEARING_CELLS
                && self.model.value("tolerance") >= LEAST_TOLERANCE;
            if !(self.wears && cheap) || self.wearing_steps == MOST_WEARING_STEPS {
                return (0, Expected::Ok);
            }
            self.wearing_steps += 1;
        }
        let (point, length) = record.step(&self.model);
        let expected = self.model.step(point, length);
        // SAFETY: see above.
        let status = unsafe { fmi2DoStep(self.component, point, length, (record.mode() >> 7).into()) };
        if expected == Expected::Step {
            self.model.stepped(status, point, length);
        }
        (status, expected)
    }

    pub(super) fn derivatives(&mut self, record: Record) -> Called {
        let unknowns = record.references();
        let outputs = unknowns.iter().all(|&unknown| is_real_output(unknown));
        let mut values = vec![0.0; unknowns.len()];
        // SAFETY: see above.
        unsafe {
            if record.mode() & 1 != 0 {
                let orders = vec![i32::from(record.mode() >> 1 & 3); unknowns.len()];
                let status = fmi2GetRealOutputDerivatives(
                    self.component,
                    unknowns.as_ptr(),
                    unknowns.len(),
                    orders.as_ptr(),
                    values.as_mut_ptr(),
                );
                let good = outputs && orders[0] > 0;
                assert!(status != 0 || orders[0] < 2 || values.iter().all(|value| *value == 0.0));
                return (
                    status,
                    self.model.gated(Group::Status, if good { Expected::Ok } else { Expected::Error }),
                );
            }
            let known = [match record.index() as u32 % 16 {
                7 => reference("tangential_displacement_y"),
                8 => reference("radius"),
                9 => reference("youngs_modulus_1"),
                10 => reference("friction_coefficient"),
                11 => reference("tolerance"),
                other => other,
            }];
            let seed = [if record.mode() & 2 != 0 { record.raw() } else { 1.0 }];
            let status = fmi2GetDirectionalDerivative(
                self.component,
                unknowns.as_ptr(),
                unknowns.len(),
                known.as_ptr(),
                1,
                seed.as_ptr(),
                values.as_mut_ptr(),
            );
            let good = outputs && self.model.is_known(known[0]) && seed[0].is_finite();
            (status, self.model.gated(Group::Get, if good { self.model.computes() } else { Expected::Error }))
        }
    }

    pub(super) fn slopes(&mut self, record: Record) -> Called {
        let target =
            [if record.mode() & 4 != 0 { record.references()[0] } else { record.target() as u32 % 5 }];
        let order = [if record.mode() & 8 != 0 { record.index() as i32 - 1 } else { 1 }];
        let value = [record.reals(&target)[0]];
        // SAFETY: see above.
        let status = unsafe {
            fmi2SetRealInputDerivatives(self.component, target.as_ptr(), 1, order.as_ptr(), value.as_ptr())
        };
        (status, self.model.set_slope(target[0], order[0], value[0]))
    }

    /// Logging, cancelling and the statuses, of which each function knows one.
    pub(super) fn statuses(&mut self, record: Record) -> Called {
        let (c, kind) = (self.component, u32::from(record.target() % 5));
        let known =
            |one| self.model.gated(Group::Status, if kind == one { Expected::Ok } else { Expected::Discard });
        // SAFETY: see above; the string that is got is looked at before the next call.
        unsafe {
            match record.mode() % 8 {
                0 => {
                    let names = [c"logEvents", c"logAll", c"logStatusError", c"nothing"];
                    let index = record.index() % 5;
                    let list: Vec<_> = names.get(index).into_iter().map(|name| name.as_ptr()).collect();
                    let status =
                        fmi2SetDebugLogging(c, i32::from(record.0[7] & 1), list.len(), list.as_ptr());
                    (status, if index == 3 { Expected::Error } else { Expected::Ok })
                }
                1 => (fmi2CancelStep(c), self.model.gated(Group::Never, Expected::Ok)),
                2 => {
                    let mut value = 9;
                    let status = fmi2GetStatus(c, kind, &raw mut value);
                    assert!(status != 0 || value == self.model.last_step);
                    (status, known(0))
                }
                3 => {
                    let mut value = f64::NAN;
                    let status = fmi2GetRealStatus(c, kind, &raw mut value);
                    assert!(status != 0 || value == self.model.time);
                    (status, known(2))
                }
                4 => (fmi2GetIntegerStatus(c, kind, &raw mut *Box::new(0)), known(9)),
                5 => {
                    let mut value = 9;
                    let status = fmi2GetBooleanStatus(c, kind, &raw mut value);
                    assert!(status != 0 || value == 0);
                    (status, known(3))
                }
                6 => {
                    let mut value = null();
                    let status = fmi2GetStringStatus(c, kind, &raw mut value);
                    assert!(status != 0 || CStr::from_ptr(value).to_bytes().ends_with(b"synchronously"));
                    (status, known(1))
                }
                _ => (fmi2DoStep(null_mut(), 0.0, 0.1, 1), Expected::Error),
            }
        }
    }
}
