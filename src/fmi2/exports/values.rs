//! Getting and setting variables.

use super::conforming;
use crate::fmi2::guard::{array, array_out, enter, string};
use crate::fmi2::lifecycle;
use fmi_sys::fmi2::{
    fmi2Boolean, fmi2Component, fmi2Integer, fmi2Real, fmi2Status, fmi2String, fmi2ValueReference,
};

conforming! {
    fmi2GetReal: fmi2GetRealTYPE,
    fmi2GetInteger: fmi2GetIntegerTYPE,
    fmi2GetBoolean: fmi2GetBooleanTYPE,
    fmi2GetString: fmi2GetStringTYPE,
    fmi2SetReal: fmi2SetRealTYPE,
    fmi2SetInteger: fmi2SetIntegerTYPE,
    fmi2SetBoolean: fmi2SetBooleanTYPE,
    fmi2SetString: fmi2SetStringTYPE,
}

/// Reads real variables. Fields are computed here and only here.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_REAL, |component| {
            component.get_real(array("vr", vr, nvr)?, array_out("value", value, nvr)?)
        })
    }
}

/// Reads Integer and Enumeration variables.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_INTEGER, |component| {
            component.get_integer(array("vr", vr, nvr)?, array_out("value", value, nvr)?)
        })
    }
}

/// Reads Boolean variables.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_BOOLEAN, |component| {
            component.get_boolean(array("vr", vr, nvr)?, array_out("value", value, nvr)?)
        })
    }
}

/// Reads String variables; the strings hold until the next call for this instance.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_STRING, |component| {
            component.get_string(array("vr", vr, nvr)?, array_out("value", value, nvr)?)
        })
    }
}

/// Sets real parameters and inputs.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_REAL, |component| {
            component.set_real(array("vr", vr, nvr)?, array("value", value, nvr)?)
        })
    }
}

/// Sets Integer and Enumeration parameters.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Integer,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_INTEGER, |component| {
            component.set_integer(array("vr", vr, nvr)?, array("value", value, nvr)?)
        })
    }
}

/// Boolean variables are outputs; only an empty list succeeds.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_BOOLEAN, |component| {
            component.set_boolean(array("vr", vr, nvr)?, array("value", value, nvr)?)
        })
    }
}

/// Sets String parameters; the strings are copied.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2String,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_STRING, |component| {
            let references = array("vr", vr, nvr)?;
            let values: Vec<_> =
                array("value", value, nvr)?.iter().map(|&value| string("value", value).ok()).collect();
            component.set_string(references, &values)
        })
    }
}
