//! Saved states and directional derivatives.

use super::conforming;
use crate::fmi2::guard::{array, array_out, enter, out};
use crate::fmi2::lifecycle;
use crate::fmi2::refusal::Refusal;
use fmi_sys::fmi2::{fmi2Byte, fmi2Component, fmi2FMUstate, fmi2Real, fmi2Status, fmi2ValueReference};

conforming! {
    fmi2GetFMUstate: fmi2GetFMUstateTYPE,
    fmi2SetFMUstate: fmi2SetFMUstateTYPE,
    fmi2FreeFMUstate: fmi2FreeFMUstateTYPE,
    fmi2SerializedFMUstateSize: fmi2SerializedFMUstateSizeTYPE,
    fmi2SerializeFMUstate: fmi2SerializeFMUstateTYPE,
    fmi2DeSerializeFMUstate: fmi2DeSerializeFMUstateTYPE,
    fmi2GetDirectionalDerivative: fmi2GetDirectionalDerivativeTYPE,
}

/// Saves everything that makes the instance, parameters and inputs included; into an earlier state
/// if given one.
///
/// # Safety
/// See the [module](super); what `state` points to is null or a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: by this function's contract; the standard demands that the handle is initialized.
    unsafe {
        enter(c, &lifecycle::GET_FMU_STATE, |component| {
            let state = out("FMUstate", state)?.assume_init_mut();
            *state = component.save(*state)?;
            Ok(())
        })
    }
}

/// Back to a saved state, also after an internal failure.
///
/// # Safety
/// See the [module](super). The handle may be anything.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::SET_FMU_STATE, |component| component.restore(state)) }
}

/// Drops a saved state and sets its handle to null.
///
/// # Safety
/// As for [`fmi2GetFMUstate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: by this function's contract; the standard demands that the handle is initialized.
    unsafe {
        enter(c, &lifecycle::FREE_FMU_STATE, |component| {
            if state.is_null() {
                return Ok(());
            }
            let state = out("FMUstate", state)?.assume_init_mut();
            component.free_saved(*state)?;
            *state = core::ptr::null_mut();
            Ok(())
        })
    }
}

/// Number of bytes of a saved state.
///
/// # Safety
/// See the [module](super). The handle may be anything.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    state: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SERIALIZED_FMU_STATE_SIZE, |component| {
            out("size", size)?.write(component.serialize(state)?.len());
            Ok(())
        })
    }
}

/// Writes a saved state into as many bytes as fmi2SerializedFMUstateSize returns.
///
/// # Safety
/// See the [module](super). The handle may be anything.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    state: fmi2FMUstate,
    serialized_state: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SERIALIZE_FMU_STATE, |component| {
            let bytes = component.serialize(state)?;
            if size != bytes.len() {
                return Err(Refusal::SerializedSize { given: size, needed: bytes.len() }.into());
            }
            let places = array_out("serializedState", serialized_state.cast::<u8>(), size)?;
            for (place, byte) in places.iter_mut().zip(bytes) {
                place.write(byte);
            }
            Ok(())
        })
    }
}

/// Makes a saved state of bytes, which may be anything and come from anywhere.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serialized_state: *const fmi2Byte,
    size: usize,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::DE_SERIALIZE_FMU_STATE, |component| {
            let place = out("FMUstate", state)?;
            let bytes = array("serializedState", serialized_state.cast::<u8>(), size)?;
            place.write(component.deserialize(bytes)?);
            Ok(())
        })
    }
}

/// Derivatives of outputs with respect to inputs, times a seed.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: fmi2Component,
    unknowns: *const fmi2ValueReference,
    n_unknown: usize,
    knowns: *const fmi2ValueReference,
    n_known: usize,
    dv_known: *const fmi2Real,
    dv_unknown: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::GET_DIRECTIONAL_DERIVATIVE, |component| {
            let unknowns = array("vUnknown_ref", unknowns, n_unknown)?;
            let knowns = array("vKnown_ref", knowns, n_known)?;
            let seed = array("dvKnown", dv_known, n_known)?;
            let results = array_out("dvUnknown", dv_unknown, n_unknown)?;
            component.directional_derivative(unknowns, (knowns, seed), results)
        })
    }
}
