//! Steps, their inputs' derivatives, and their status.

use super::conforming;
use crate::fmi2::guard::{array, array_out, enter, out};
use crate::fmi2::lifecycle;
use crate::fmi2::refusal::{Checked, Refusal};
use fmi_sys::fmi2::{
    fmi2Boolean, fmi2Component, fmi2Integer, fmi2Real, fmi2Status, fmi2StatusKind,
    fmi2StatusKind_fmi2DoStepStatus, fmi2StatusKind_fmi2LastSuccessfulTime, fmi2StatusKind_fmi2PendingStatus,
    fmi2StatusKind_fmi2Terminated, fmi2String, fmi2ValueReference,
};

conforming! {
    fmi2SetRealInputDerivatives: fmi2SetRealInputDerivativesTYPE,
    fmi2GetRealOutputDerivatives: fmi2GetRealOutputDerivativesTYPE,
    fmi2DoStep: fmi2DoStepTYPE,
    fmi2CancelStep: fmi2CancelStepTYPE,
    fmi2GetStatus: fmi2GetStatusTYPE,
    fmi2GetRealStatus: fmi2GetRealStatusTYPE,
    fmi2GetIntegerStatus: fmi2GetIntegerStatusTYPE,
    fmi2GetBooleanStatus: fmi2GetBooleanStatusTYPE,
    fmi2GetStringStatus: fmi2GetStringStatusTYPE,
}

/// Sets first time derivatives of inputs for the next step.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_REAL_INPUT_DERIVATIVES, |component| {
            let (references, orders) = (array("vr", vr, nvr)?, array("order", order, nvr)?);
            component.set_input_derivatives(references, orders, array("value", value, nvr)?)
        })
    }
}

/// First time derivatives of outputs at the end of the last step.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_REAL_OUTPUT_DERIVATIVES, |component| {
            let (references, orders) = (array("vr", vr, nvr)?, array("order", order, nvr)?);
            component.output_derivatives(references, orders, array_out("value", value, nvr)?)
        })
    }
}

/// One step. A refused one has changed nothing and may be repeated.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: fmi2Component,
    current_communication_point: fmi2Real,
    communication_step_size: fmi2Real,
    _no_set_fmu_state_prior_to_current_point: fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::DO_STEP, |component| {
            component.do_step(current_communication_point, communication_step_size)
        })
    }
}

/// Always refused: a step is over when fmi2DoStep returns.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: fmi2Component) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::CANCEL_STEP, |_| Ok(())) }
}

/// How the last step ended.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Status,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_STATUS, |component| {
            let status = component.last_step().to_fmi();
            out("value", value)?.write(only(s, fmi2StatusKind_fmi2DoStepStatus, status)?);
            Ok(())
        })
    }
}

/// The time up to which the last step came.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_REAL_STATUS, |component| {
            let time = component.model.staged().clock.time();
            out("value", value)?.write(only(s, fmi2StatusKind_fmi2LastSuccessfulTime, time)?);
            Ok(())
        })
    }
}

/// The standard defines no status of this type.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_INTEGER_STATUS, |_| {
            out("value", value)?;
            Err(Refusal::StatusKind { kind: s }.into())
        })
    }
}

/// Whether the model wants to end the simulation: never.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_BOOLEAN_STATUS, |_| {
            out("value", value)?.write(only(s, fmi2StatusKind_fmi2Terminated, 0)?);
            Ok(())
        })
    }
}

/// What a pending step does; there never is one.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: fmi2Component,
    s: fmi2StatusKind,
    value: *mut fmi2String,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_STRING_STATUS, |_| {
            let text = c"no step is pending: steps are carried out synchronously";
            out("value", value)?.write(only(s, fmi2StatusKind_fmi2PendingStatus, text.as_ptr())?);
            Ok(())
        })
    }
}

/// `value` if the requested kind is the one to which it belongs.
fn only<T>(asked: fmi2StatusKind, kind: fmi2StatusKind, value: T) -> Checked<T> {
    if asked == kind { Ok(value) } else { Err(Refusal::StatusKind { kind: asked }.into()) }
}
