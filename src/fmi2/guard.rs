//! The single entry from C: handles null components, the order of calls, panics, status and
//! message.

use super::component::Component;
use super::lifecycle::Call;
use super::refusal::{Checked, Refusal};
use core::ffi::{CStr, c_char, c_void};
use core::mem::MaybeUninit;
use fmi_sys::fmi2::{fmi2Component, fmi2Status, fmi2Status_fmi2Error};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body` on the instance behind `component` if `call` is allowed in its state, and turns the
/// result into a status, with one message to the logger if it is not fmi2OK. Nothing unwinds out of
/// it.
///
/// # Safety
/// `component` is null or comes from [`new_component`], has not been freed and is not in use
/// elsewhere.
pub(super) unsafe fn enter(
    component: fmi2Component,
    call: &Call,
    body: impl FnOnce(&mut Component) -> Checked,
) -> fmi2Status {
    // SAFETY: by this function's contract the pointer is null or that of a live `Component` in no
    // other use.
    let Some(component) = (unsafe { component.cast::<Component>().as_mut() }) else {
        return fmi2Status_fmi2Error;
    };
    // Unwind safety: after a panic the model is marked as failed and replaced before it is used
    // again.
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        component.admit(call)?;
        body(component)
    }));
    match outcome {
        Ok(result) => component.conclude(call, result),
        Err(payload) => component.fail(call, &panic_text(payload)),
    }
    .to_fmi()
}

/// Moves an instance to the heap and hands its ownership to the importer.
pub(super) fn new_component(component: Component) -> fmi2Component {
    Box::into_raw(Box::new(component)).cast::<c_void>()
}

/// Takes an instance back and drops it; null is ignored.
///
/// # Safety
/// As for [`enter`]; the pointer is dead afterwards.
pub(super) unsafe fn free_component(component: fmi2Component) {
    if component.is_null() {
        return;
    }
    // SAFETY: by this function's contract the pointer is that of `new_component`, and this is its
    // last use.
    let component = unsafe { Box::from_raw(component.cast::<Component>()) };
    // A panic while dropping could only leak memory; there is no instance left to report it.
    let _ = catch_unwind(AssertUnwindSafe(|| drop(component)));
}

/// What a panic said.
pub(super) fn panic_text(payload: Box<dyn Any + Send>) -> String {
    match payload.downcast::<String>() {
        Ok(text) => *text,
        Err(payload) => {
            payload.downcast_ref::<&str>().map_or("unknown panic".into(), |text| (*text).to_owned())
        }
    }
}

/// An array argument to read. An empty one may be null.
///
/// # Safety
/// `pointer` is null or points to `length` values that nobody changes during the call.
pub(super) unsafe fn array<'a, T>(
    argument: &'static str,
    pointer: *const T,
    length: usize,
) -> Checked<&'a [T]> {
    if length == 0 {
        return Ok(&[]);
    }
    check_array(argument, pointer, length)?;
    // SAFETY: the length is possible and the pointer not null, the rest is this function's
    // contract.
    Ok(unsafe { core::slice::from_raw_parts(pointer, length) })
}

/// An array argument to fill. An empty one may be null.
///
/// # Safety
/// `pointer` is null or points to room for `length` values that nobody else uses during the call.
pub(super) unsafe fn array_out<'a, T>(
    argument: &'static str,
    pointer: *mut T,
    length: usize,
) -> Checked<&'a mut [MaybeUninit<T>]> {
    if length == 0 {
        return Ok(&mut []);
    }
    check_array(argument, pointer, length)?;
    // SAFETY: the length is possible and the pointer not null, the rest is this function's
    // contract.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer.cast(), length) })
}

#[inline]
fn check_array<T>(argument: &'static str, pointer: *const T, length: usize) -> Checked {
    if length <= isize::MAX as usize / size_of::<T>() && !pointer.is_null() {
        return Ok(());
    }
    Err(refuse_array(argument, length, size_of::<T>()))
}

#[cold]
fn refuse_array(argument: &'static str, length: usize, size: usize) -> Box<Refusal> {
    if length > isize::MAX as usize / size {
        return Refusal::Length { argument, length }.into();
    }
    Refusal::NullPointer(argument).into()
}

/// A single result to fill.
///
/// # Safety
/// As for [`array_out`] with length 1.
pub(super) unsafe fn out<'a, T>(argument: &'static str, pointer: *mut T) -> Checked<&'a mut MaybeUninit<T>> {
    // SAFETY: this function's contract.
    unsafe { array_out(argument, pointer, 1) }.map(|array| &mut array[0])
}

/// A string argument.
///
/// # Safety
/// `pointer` is null or a C string that nobody changes during the call.
pub(super) unsafe fn string<'a>(argument: &'static str, pointer: *const c_char) -> Checked<&'a CStr> {
    if pointer.is_null() {
        return Err(Refusal::NullPointer(argument).into());
    }
    // SAFETY: this function's contract.
    Ok(unsafe { CStr::from_ptr(pointer) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi2::lifecycle;
    use crate::fmi2::logger::Logger;
    use fmi_sys::fmi2::{fmi2Status_fmi2OK, fmi2Status_fmi2Warning};
    use std::ffi::CString;

    /// Runs `body` on an instance through the gate of `call`.
    fn run(
        component: fmi2Component,
        call: &Call,
        body: impl FnOnce(&mut Component) -> Checked,
    ) -> fmi2Status {
        // SAFETY: the tests pass null or an instance of their own that they free last.
        unsafe { enter(component, call, body) }
    }

    /// The column that no importer can reach by itself: after an internal failure only these are
    /// let through.
    #[test]
    fn a_failed_instance_admits_what_ends_or_mends_it() {
        let component = new_component(Component::new(Logger::new(None, CString::default(), false), None));
        run(component, &lifecycle::DO_STEP, |_| Ok(()));
        run(component, &lifecycle::RESET, |_| panic!("deliberate"));
        let admitted = |call: &&Call| {
            let mut reached = false;
            let status = run(component, call, |_| {
                reached = true;
                Ok(())
            });
            assert_eq!(status == fmi2Status_fmi2OK, reached, "{}", call.name);
            reached
        };
        let names: Vec<_> = lifecycle::ALL.iter().filter(admitted).map(|call| call.name).collect();
        let expected = ["fmi2SetDebugLogging", "fmi2Reset", "fmi2SetFMUstate", "fmi2FreeFMUstate"];
        assert_eq!((lifecycle::ALL.len(), names), (30, expected.to_vec()));
        // SAFETY: it is not used again.
        unsafe { free_component(component) }
    }

    #[test]
    fn a_panic_makes_the_instance_unusable_until_it_is_reset() {
        let component = new_component(Component::new(Logger::new(None, CString::default(), false), None));
        let panics = |_: &mut Component| -> Checked { panic!("deliberate, {}", 42) };
        assert_eq!(run(component, &lifecycle::SETUP_EXPERIMENT, panics), fmi2Status_fmi2Error);

        let mut reached = false;
        let status = run(component, &lifecycle::SETUP_EXPERIMENT, |_| {
            reached = true;
            Ok(())
        });
        assert_eq!((status, reached), (fmi2Status_fmi2Error, false));
        let refusal = {
            // SAFETY: the instance is alive and in no other use.
            let component = unsafe { &mut *component.cast::<Component>() };
            component.admit(&lifecycle::SETUP_EXPERIMENT).unwrap_err().to_string()
        };
        assert!(refusal.contains("deliberate, 42") && refusal.contains("fmi2SetupExperiment"), "{refusal}");

        assert_eq!(run(component, &lifecycle::RESET, Component::reset), fmi2Status_fmi2OK);
        assert_eq!(run(component, &lifecycle::SETUP_EXPERIMENT, |_| Ok(())), fmi2Status_fmi2OK);
        // SAFETY: the last use of the instance.
        unsafe { free_component(component) };
    }

    #[test]
    fn a_failed_instance_goes_on_from_a_state_saved_before() {
        let component = new_component(Component::new(Logger::new(None, CString::default(), false), None));
        let mut saved = core::ptr::null_mut();
        let save = |component: &mut Component| {
            saved = component.save(core::ptr::null_mut())?;
            Ok(())
        };
        assert_eq!(run(component, &lifecycle::GET_FMU_STATE, save), fmi2Status_fmi2OK);
        assert_eq!(run(component, &lifecycle::RESET, |_| panic!("deliberate")), fmi2Status_fmi2Error);
        let restore = |component: &mut Component| component.restore(saved);
        assert_eq!(run(component, &lifecycle::SET_FMU_STATE, restore), fmi2Status_fmi2OK);
        assert_eq!(run(component, &lifecycle::SETUP_EXPERIMENT, |_| Ok(())), fmi2Status_fmi2OK);
        // SAFETY: the last use of the instance.
        unsafe { free_component(component) };
    }

    /// A message may be a string, made at run time or not, or no text at all.
    #[test]
    fn the_text_of_a_panic_is_reported() {
        let number = std::hint::black_box(42);
        for (payload, text) in [
            (Box::new(format!("made of {number}")) as Box<dyn Any + Send>, "made of 42"),
            (Box::new("plain"), "plain"),
            (Box::new(number), "unknown panic"),
        ] {
            assert_eq!(panic_text(payload), text);
        }
    }

    #[test]
    fn a_null_component_never_reaches_the_body() {
        let status = run(core::ptr::null_mut(), &lifecycle::DO_STEP, |_| panic!("reached"));
        assert_eq!(status, fmi2Status_fmi2Error);
    }

    #[test]
    fn the_worst_status_of_a_call_is_returned() {
        let component = new_component(Component::new(Logger::new(None, CString::default(), false), None));
        let warns = |component: &mut Component| {
            component.warn("a warning");
            Ok(())
        };
        assert_eq!(run(component, &lifecycle::RESET, warns), fmi2Status_fmi2Warning);
        assert_eq!(run(component, &lifecycle::RESET, |_| Ok(())), fmi2Status_fmi2OK);
        let warns_and_refuses = |component: &mut Component| {
            component.warn("a warning");
            Err(Refusal::NullPointer("x").into())
        };
        assert_eq!(run(component, &lifecycle::RESET, warns_and_refuses), fmi2Status_fmi2Error);
        // SAFETY: the last use of the instance.
        unsafe { free_component(component) };
    }

    #[test]
    fn arrays_are_checked_before_they_are_touched() {
        let null = core::ptr::null::<f64>();
        // SAFETY: null and impossible lengths are refused, and an empty array is never read.
        unsafe {
            assert!(array("x", null, 0).unwrap().is_empty());
            assert!(array("x", null, 3).is_err_and(|refusal| matches!(*refusal, Refusal::NullPointer("x"))));
            assert!(
                array("x", &raw const NUMBER, usize::MAX)
                    .is_err_and(|refusal| matches!(*refusal, Refusal::Length { .. }))
            );
            assert!(
                string("x", core::ptr::null())
                    .is_err_and(|refusal| matches!(*refusal, Refusal::NullPointer("x")))
            );
        }
    }

    static NUMBER: f64 = 1.0;
}
