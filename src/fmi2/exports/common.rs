//! Versions, creation and destruction, logging, initialization and termination.

use super::conforming;
use crate::fmi2::component::Component;
use crate::fmi2::guard::{array, enter, free_component, new_component, panic_text, string};
use crate::fmi2::lifecycle;
use crate::fmi2::logger::Logger;
use crate::fmi2::status::Status;
use core::ffi::CStr;
use core::ptr::null_mut;
use fmi_sys::fmi2::{
    fmi2Boolean, fmi2CallbackFunctions, fmi2Component, fmi2Real, fmi2Status, fmi2String, fmi2Type,
};
use libc::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

conforming! {
    fmi2GetTypesPlatform: fmi2GetTypesPlatformTYPE,
    fmi2GetVersion: fmi2GetVersionTYPE,
    fmi2SetDebugLogging: fmi2SetDebugLoggingTYPE,
    fmi2Instantiate: fmi2InstantiateTYPE,
    fmi2FreeInstance: fmi2FreeInstanceTYPE,
    fmi2SetupExperiment: fmi2SetupExperimentTYPE,
    fmi2EnterInitializationMode: fmi2EnterInitializationModeTYPE,
    fmi2ExitInitializationMode: fmi2ExitInitializationModeTYPE,
    fmi2Terminate: fmi2TerminateTYPE,
    fmi2Reset: fmi2ResetTYPE,
}

/// Name of the set of C types in use.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

/// Version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// Creates an instance; null on failure, for a reason that has been logged.
///
/// # Safety
/// See the [module](super); `functions` is null or points to callbacks that stay callable until
/// fmi2FreeInstance. The struct itself is copied.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instance_name: fmi2String,
    fmu_type: fmi2Type,
    fmu_guid: fmi2String,
    fmu_resource_location: fmi2String,
    functions: *const fmi2CallbackFunctions,
    _visible: fmi2Boolean,
    logging_on: fmi2Boolean,
) -> fmi2Component {
    // SAFETY: null or valid by this function's contract.
    let (callbacks, name, guid, resource_location) = unsafe {
        (functions.as_ref(), optional(instance_name), optional(fmu_guid), optional(fmu_resource_location))
    };
    let refuse = |logger: Logger, text: &str| {
        logger.log(Status::Error, &format!("fmi2Instantiate: {text}"));
        null_mut()
    };
    let create = || {
        let name = name.filter(|name| !name.is_empty());
        let logger = Logger::new(callbacks, name.unwrap_or(c"FrettingContact").to_owned(), logging_on != 0);
        if name.is_none() {
            return refuse(logger, "instanceName is null or empty: give the instance a name");
        }
        match Component::instantiate(logger, fmu_type, guid, resource_location) {
            Ok(component) => new_component(component),
            Err((logger, text)) => refuse(logger, &text),
        }
    };
    catch_unwind(AssertUnwindSafe(create)).unwrap_or_else(|payload| {
        let logger = Logger::new(callbacks, c"FrettingContact".to_owned(), logging_on != 0);
        refuse(logger, &format!("internal failure: {}", panic_text(payload)))
    })
}

/// A string argument that may be missing.
///
/// # Safety
/// As for [`string`].
unsafe fn optional<'a>(pointer: fmi2String) -> Option<&'a CStr> {
    // SAFETY: this function's contract.
    unsafe { string("", pointer) }.ok()
}

/// Frees an instance with all its saved states; null is ignored.
///
/// # Safety
/// See the [module](super); the component is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    // SAFETY: by this function's contract the pointer is null or a live instance.
    unsafe { free_component(c) }
}

/// Switches events and discards on or off, and selects their categories.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: fmi2Component,
    logging_on: fmi2Boolean,
    n_categories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SET_DEBUG_LOGGING, |component| {
            let names = array("categories", categories, n_categories)?;
            let names =
                names.iter().map(|&name| string("categories", name)).collect::<Result<Vec<_>, _>>()?;
            component.set_debug_logging(logging_on != 0, &names)
        })
    }
}

/// Sets the start time, and the stop time if there is one.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: fmi2Component,
    tolerance_defined: fmi2Boolean,
    tolerance: fmi2Real,
    start_time: fmi2Real,
    stop_time_defined: fmi2Boolean,
    stop_time: fmi2Real,
) -> fmi2Status {
    let tolerance = (tolerance_defined != 0).then_some(tolerance);
    let stop = (stop_time_defined != 0).then_some(stop_time);
    // SAFETY: by this function's contract.
    unsafe {
        enter(c, &lifecycle::SETUP_EXPERIMENT, |component| {
            component.setup_experiment(tolerance, start_time, stop)
        })
    }
}

/// Begins the initialization.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::ENTER_INITIALIZATION_MODE, Component::enter_initialization_mode) }
}

/// Ends the initialization: builds the contact and presses the bodies together.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::EXIT_INITIALIZATION_MODE, Component::exit_initialization_mode) }
}

/// Ends the simulation; results can still be read.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: fmi2Component) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::TERMINATE, Component::terminate) }
}

/// Back to the state after fmi2Instantiate, with all start values.
///
/// # Safety
/// See the [module](super).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: fmi2Component) -> fmi2Status {
    // SAFETY: by this function's contract.
    unsafe { enter(c, &lifecycle::RESET, Component::reset) }
}
