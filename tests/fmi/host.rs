//! A small importer for the tests: calls the C functions, knows variables by name and keeps the
//! messages.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use core::ffi::{CStr, c_char};
use core::ptr::{null, null_mut};
use fmi_sys::fmi2::logger::callback_logger_handler;
use fmi_sys::fmi2::{fmi2CallbackFunctions, fmi2Component, fmi2FMUstate, fmi2Status};
use fretting_contact::fmi2::GUID;
use fretting_contact::fmi2::exports::*;
use fretting_contact::fmi2::variables::variables;
use std::collections::HashMap;
use std::ffi::CString;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex, Once};

pub(crate) const OK: fmi2Status = 0;
pub(crate) const WARNING: fmi2Status = 1;
pub(crate) const DISCARD: fmi2Status = 2;
pub(crate) const ERROR: fmi2Status = 3;

/// A value reference that no variable has.
pub(crate) const NOWHERE: u32 = 1_000_000;

/// Name of the instances of random calls, whose messages would fill the memory: they are formatted
/// and dropped.
pub(crate) const ANY_ORDER: &str = "any order";

/// Messages by instance name. They arrive formatted by C's vsnprintf, through fmi-sys and the `log`
/// crate.
static MESSAGES: LazyLock<Mutex<HashMap<String, Vec<String>>>> = LazyLock::new(Mutex::default);

struct Capture;

impl log::Log for Capture {
    fn enabled(&self, _: &log::Metadata<'_>) -> bool {
        true
    }
    fn log(&self, record: &log::Record<'_>) {
        let text = format!("{}: {}", record.level(), record.args());
        if record.target() == ANY_ORDER {
            return;
        }
        MESSAGES.lock().unwrap().entry(record.target().to_owned()).or_default().push(text);
    }
    fn flush(&self) {}
}

/// Takes the messages that instances of this name have sent so far.
pub(crate) fn messages_of(instance: &str) -> Vec<String> {
    MESSAGES.lock().unwrap().remove(instance).unwrap_or_default()
}

/// Callbacks that keep every message.
pub(crate) fn callbacks() -> fmi2CallbackFunctions {
    static INSTALL: Once = Once::new();
    INSTALL.call_once(|| log::set_logger(&Capture).expect("no other logger"));
    fmi2CallbackFunctions {
        logger: Some(callback_logger_handler),
        allocateMemory: None,
        freeMemory: None,
        stepFinished: None,
        componentEnvironment: null_mut(),
    }
}

/// One instance, freed when dropped.
pub(crate) struct Fmu {
    pub(crate) component: fmi2Component,
    name: CString,
}

impl Drop for Fmu {
    fn drop(&mut self) {
        // SAFETY: the instance is not used again.
        unsafe { fmi2FreeInstance(self.component) }
    }
}

pub(crate) fn reference(name: &str) -> u32 {
    let position = variables().iter().position(|variable| variable.name == name);
    position.unwrap_or_else(|| panic!("{name} is a variable")) as u32
}

fn pointer(uri: Option<&CStr>) -> *const c_char {
    uri.map_or(null(), CStr::as_ptr)
}

impl Fmu {
    /// A new instance with a name of its own and events switched off.
    pub(crate) fn new() -> Self {
        Self::with_resources(None)
    }

    pub(crate) fn with_resources(uri: Option<&CStr>) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let name = CString::new(format!("contact {}", COUNT.fetch_add(1, Ordering::Relaxed))).unwrap();
        let guid = CString::new(GUID).unwrap();
        // SAFETY: all pointers are valid; the callbacks are copied.
        let component = unsafe {
            fmi2Instantiate(
                name.as_ptr(),
                1,
                guid.as_ptr(),
                pointer(uri),
                &raw const *Box::new(callbacks()),
                0,
                0,
            )
        };
        assert!(!component.is_null(), "{:?}", messages_of(name.to_str().unwrap()));
        Self { component, name }
    }

    /// An instance that is ready for steps, after `set`.
    pub(crate) fn started(set: impl FnOnce(&Self)) -> Self {
        let fmu = Self::new();
        set(&fmu);
        fmu.initialize();
        fmu
    }

    pub(crate) fn initialize(&self) {
        assert_eq!(self.setup(0.0, None), OK);
        assert_eq!(self.enter_initialization(), OK);
        assert_eq!(self.exit_initialization(), OK, "{:?}", self.messages());
    }

    pub(crate) fn messages(&self) -> Vec<String> {
        messages_of(self.name.to_str().unwrap())
    }

    /// The one message there is.
    pub(crate) fn message(&self) -> String {
        let mut messages = self.messages();
        assert_eq!(messages.len(), 1, "{messages:?}");
        messages.remove(0)
    }

    /// Asserts that a call was refused as an error with one message that says all of `texts`.
    #[track_caller]
    pub(crate) fn refused(&self, status: fmi2Status, texts: &[&str]) {
        let message = self.message();
        assert_eq!(status, ERROR, "{message}");
        for text in texts {
            assert!(message.contains(text), "{text:?} is missing in: {message}");
        }
    }
}

// SAFETY of every call below: the component is alive until the instance is dropped, and all arrays
// have the lengths given.
impl Fmu {
    pub(crate) fn setup(&self, start: f64, stop: Option<f64>) -> fmi2Status {
        // SAFETY: see above.
        unsafe {
            fmi2SetupExperiment(self.component, 0, 0.0, start, stop.is_some().into(), stop.unwrap_or(0.0))
        }
    }
    pub(crate) fn enter_initialization(&self) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2EnterInitializationMode(self.component) }
    }
    pub(crate) fn exit_initialization(&self) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2ExitInitializationMode(self.component) }
    }
    pub(crate) fn terminate(&self) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2Terminate(self.component) }
    }
    /// Ends the simulation with logging on; what the instance tells.
    pub(crate) fn terminated_aloud(&self) -> Vec<String> {
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2SetDebugLogging(self.component, 1, 0, null()) }, OK);
        assert_eq!(self.terminate(), OK);
        self.messages()
    }
    pub(crate) fn reset(&self) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2Reset(self.component) }
    }
    pub(crate) fn do_step(&self, point: f64, length: f64) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2DoStep(self.component, point, length, 1) }
    }
    pub(crate) fn set_reals(&self, references: &[u32], values: &[f64]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetReal(self.component, references.as_ptr(), references.len(), values.as_ptr()) }
    }
    pub(crate) fn set_integers(&self, references: &[u32], values: &[i32]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2SetInteger(self.component, references.as_ptr(), references.len(), values.as_ptr()) }
    }
    pub(crate) fn get_reals(&self, references: &[u32], values: &mut [f64]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2GetReal(self.component, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }
    pub(crate) fn get_integers(&self, references: &[u32], values: &mut [i32]) -> fmi2Status {
        // SAFETY: see above.
        unsafe { fmi2GetInteger(self.component, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }
    pub(crate) fn set_real(&self, name: &str, value: f64) -> fmi2Status {
        self.set_reals(&[reference(name)], &[value])
    }
    pub(crate) fn set_integer(&self, name: &str, value: i32) -> fmi2Status {
        self.set_integers(&[reference(name)], &[value])
    }
    pub(crate) fn set_string(&self, name: &str, value: &CStr) -> fmi2Status {
        // SAFETY: see above.
        unsafe {
            fmi2SetString(self.component, &raw const *Box::new(reference(name)), 1, [value.as_ptr()].as_ptr())
        }
    }
    pub(crate) fn set_slope(&self, name: &str, order: i32, value: f64) -> fmi2Status {
        let (reference, order, value) = ([reference(name)], [order], [value]);
        // SAFETY: see above.
        unsafe {
            fmi2SetRealInputDerivatives(self.component, reference.as_ptr(), 1, order.as_ptr(), value.as_ptr())
        }
    }
    /// fmi2LastSuccessfulTime.
    pub(crate) fn last_successful_time(&self) -> f64 {
        let mut time = [f64::NAN];
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2GetRealStatus(self.component, 2, time.as_mut_ptr()) }, OK);
        time[0]
    }
    /// fmi2DoStepStatus.
    pub(crate) fn step_status(&self) -> fmi2Status {
        let mut status = [9];
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2GetStatus(self.component, 0, status.as_mut_ptr()) }, OK);
        status[0]
    }
    /// The bytes of a saved state.
    pub(crate) fn serialized(&self, state: fmi2FMUstate) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(self.component, state, &raw mut size) }, OK);
        let mut bytes = vec![0u8; size];
        // SAFETY: see above.
        let status = unsafe { fmi2SerializeFMUstate(self.component, state, bytes.as_mut_ptr().cast(), size) };
        assert_eq!(status, OK, "{:?}", self.messages());
        bytes
    }
    /// A saved state of bytes.
    pub(crate) fn deserialized(&self, bytes: &[u8]) -> (fmi2FMUstate, fmi2Status) {
        let mut state = null_mut();
        // SAFETY: see above.
        let status = unsafe {
            fmi2DeSerializeFMUstate(self.component, bytes.as_ptr().cast(), bytes.len(), &raw mut state)
        };
        (state, status)
    }
    /// Directional derivatives of `unknowns` for a seed.
    pub(crate) fn directional(&self, unknowns: &[&str], seed: &[(&str, f64)]) -> (Vec<f64>, fmi2Status) {
        let unknown: Vec<u32> = unknowns.iter().map(|name| reference(name)).collect();
        let known: Vec<u32> = seed.iter().map(|(name, _)| reference(name)).collect();
        let seed: Vec<f64> = seed.iter().map(|(_, value)| *value).collect();
        let mut result = vec![f64::NAN; unknown.len()];
        // SAFETY: see above.
        let status = unsafe {
            fmi2GetDirectionalDerivative(
                self.component,
                unknown.as_ptr(),
                unknown.len(),
                known.as_ptr(),
                known.len(),
                seed.as_ptr(),
                result.as_mut_ptr(),
            )
        };
        (result, status)
    }
    /// A time derivative of an output.
    pub(crate) fn output_slope(&self, name: &str, order: i32) -> (f64, fmi2Status) {
        let (reference, order, mut value) = ([reference(name)], [order], [f64::NAN]);
        // SAFETY: see above.
        let status = unsafe {
            fmi2GetRealOutputDerivatives(
                self.component,
                reference.as_ptr(),
                1,
                order.as_ptr(),
                value.as_mut_ptr(),
            )
        };
        (value[0], status)
    }
    pub(crate) fn get_string(&self, name: &str) -> String {
        let (reference, mut value) = ([reference(name)], [null()]);
        // SAFETY: see above; the string is copied before the next call.
        unsafe {
            assert_eq!(fmi2GetString(self.component, reference.as_ptr(), 1, value.as_mut_ptr()), OK);
            CStr::from_ptr(value[0]).to_str().unwrap().to_owned()
        }
    }
    pub(crate) fn save(&self) -> fmi2FMUstate {
        let mut state = null_mut();
        // SAFETY: see above.
        assert_eq!(unsafe { fmi2GetFMUstate(self.component, &raw mut state) }, OK);
        state
    }
    pub(crate) fn restore(&self, state: fmi2FMUstate) -> fmi2Status {
        // SAFETY: see above; handles are never followed.
        unsafe { fmi2SetFMUstate(self.component, state) }
    }
    pub(crate) fn free_saved(&self, state: &mut fmi2FMUstate) -> fmi2Status {
        // SAFETY: see above; handles are never followed.
        unsafe { fmi2FreeFMUstate(self.component, &raw mut *state) }
    }

    /// A real value that is there.
    #[track_caller]
    pub(crate) fn real(&self, name: &str) -> f64 {
        let mut value = [f64::NAN];
        assert_eq!(self.get_reals(&[reference(name)], &mut value), OK, "{:?}", self.messages());
        value[0]
    }
    #[track_caller]
    pub(crate) fn integer(&self, name: &str) -> i32 {
        let mut value = [0];
        assert_eq!(self.get_integers(&[reference(name)], &mut value), OK, "{:?}", self.messages());
        value[0]
    }
    /// All outputs and fields, bit for bit.
    pub(crate) fn bits(&self) -> Vec<u64> {
        let computed = |v: &&fretting_contact::fmi2::variables::Variable| {
            matches!(v.causality(), "output" | "local") && v.data_type.name() == "Real"
        };
        variables().iter().filter(computed).map(|v| self.real(v.name).to_bits()).collect()
    }
    /// A step of `length` from `point` with these inputs.
    #[track_caller]
    pub(crate) fn step_with(&self, inputs: &[(&str, f64)], point: f64, length: f64) {
        for &(name, value) in inputs {
            assert_eq!(self.set_real(name, value), OK);
        }
        assert_eq!(self.do_step(point, length), OK, "{:?}", self.messages());
    }
}
