//! Any sequence of calls on the C interface, beside a reference model that says what each has to
//! return.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

mod bytes;
mod model;
mod saved;
mod steps;

use bytes::Record;
use core::ffi::{CStr, c_char};
use core::ptr::{null, null_mut};
use fmi_sys::fmi2::{fmi2CallbackFunctions, fmi2Component};
use fretting_contact::fmi2::GUID;
use fretting_contact::fmi2::exports::*;
use model::{Expected, Group, Model, State, Status, reference};
use saved::Slots;
use std::ffi::CString;
use std::sync::LazyLock;

/// Most calls of a sequence.
pub(crate) const MOST_CALLS: usize = 64;

/// Wear costs: so many steps with it in a sequence, and only where they are cheap.
const MOST_WEARING_STEPS: usize = 2;
const MOST_WEARING_CELLS: i32 = 16;
const LEAST_TOLERANCE: f64 = 1e-3;

/// Texts for a file name; the second is a profile.
static TEXTS: LazyLock<[CString; 4]> = LazyLock::new(|| {
    let profile = std::env::temp_dir().join(format!("fretting-profile-{}.txt", std::process::id()));
    std::fs::write(&profile, "0 0\n1e-4 5e-7\n2e-4 2e-6\n4e-4 8e-6\n8e-4 3.2e-5\n")
        .expect("a file can be written");
    [
        CString::default(),
        CString::new(profile.to_str().expect("the path is UTF-8")).expect("a path has no null"),
        c"no such file".to_owned(),
        c"100 %s %n".to_owned(),
    ]
});

static GUID_TEXT: LazyLock<CString> = LazyLock::new(|| CString::new(GUID).expect("no null"));

/// One instance and what an importer knows of it.
struct Host {
    component: fmi2Component,
    model: Model,
    slots: Slots,
    wearing_steps: usize,
    /// Whether contacts wear unless set otherwise, and steps with wear are taken. One sequence in
    /// 256 does, by a sum of its bytes, so that a fuzzer does not spend its time on the slow ones.
    wears: bool,
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: the instance is not used again; null is ignored.
        unsafe { fmi2FreeInstance(self.component) }
    }
}

/// Carries out the calls that `bytes` stand for, and returns their number. Panics where the
/// component does not do what the model says.
pub(crate) fn run(bytes: &[u8]) -> usize {
    let Some((&first, rest)) = bytes.split_first() else { return 0 };
    let sum = bytes.iter().fold(0u8, |sum, byte| sum.wrapping_mul(31).wrapping_add(*byte));
    let mut host = Host::new(sum == 0, first & 1 != 0);
    let records = rest.as_chunks::<8>().0;
    let records = &records[..records.len().min(MOST_CALLS)];
    for (k, record) in records.iter().enumerate() {
        let record = Record(*record);
        let (status, expected) = host.call(record);
        assert!(
            expected.admits(status),
            "call {k}, {record:?}: status {status}, expected {expected:?} in {:?}",
            host.model
        );
    }
    // an instance that had failed inside would refuse this in every state
    assert!(
        host.slots.save(host.component, &host.model, 0).0 == 0,
        "the instance has failed: {:?}",
        host.model
    );
    records.len()
}

type Called = (Status, Expected);

// SAFETY of every call below: the component is alive until the host is dropped, arrays have the
// lengths given or are null, single results have room, and strings end with a null character.
impl Host {
    fn new(wears: bool, logs: bool) -> Self {
        let mut host = Self {
            component: instantiate(1, &GUID_TEXT, logs),
            model: Model::new(),
            slots: Slots::default(),
            wearing_steps: 0,
            wears,
        };
        assert!(!host.component.is_null());
        host.make_cheap();
        host
    }

    /// Few cells, and wear only where it is asked for.
    fn make_cheap(&mut self) {
        for (name, value) in [("resolution", 8), ("wear_coefficient", 0)] {
            let reference = [reference(name)];
            // SAFETY: see above.
            let called = unsafe {
                if name == "resolution" {
                    let status = fmi2SetInteger(self.component, reference.as_ptr(), 1, [value].as_ptr());
                    (status, self.model.set_integers(&reference, &[value]))
                } else if self.wears {
                    continue;
                } else {
                    let value = [f64::from(value)];
                    (
                        fmi2SetReal(self.component, reference.as_ptr(), 1, value.as_ptr()),
                        self.model.set_reals(&reference, &value),
                    )
                }
            };
            assert!(called.1.admits(called.0));
        }
    }

    fn call(&mut self, record: Record) -> Called {
        let (c, model) = (self.component, &mut self.model);
        // SAFETY: see above.
        unsafe {
            match record.kind() % 28 {
                0..=3 => self.set_real(record),
                4 | 5 => self.get_real(record),
                6 => {
                    let references = record.references();
                    let values = record.integers(references.len());
                    let status = fmi2SetInteger(c, references.as_ptr(), references.len(), values.as_ptr());
                    (status, model.set_integers(&references, &values))
                }
                7 => {
                    let references = record.references();
                    let mut values = vec![0; references.len()];
                    let status =
                        fmi2GetInteger(c, references.as_ptr(), references.len(), values.as_mut_ptr());
                    if status == 0 {
                        for (&reference, value) in references.iter().zip(values) {
                            assert!(model.known_integer(reference).is_none_or(|known| known == value));
                        }
                    }
                    (status, model.get(&references, &["Integer", "Enumeration"]))
                }
                8 => self.text(record),
                9 => {
                    let (start, stop, tolerance) = record.experiment();
                    let status = fmi2SetupExperiment(
                        c,
                        tolerance.is_some().into(),
                        tolerance.unwrap_or(0.0),
                        start,
                        stop.is_some().into(),
                        stop.unwrap_or(0.0),
                    );
                    (status, model.setup(tolerance, start, stop))
                }
                10 => {
                    let called = (fmi2EnterInitializationMode(c), model.gated(Group::Setup, Expected::Ok));
                    self.moves_on(called, State::Initialization)
                }
                11 | 12 => {
                    let called = (fmi2ExitInitializationMode(c), model.gated(Group::Exit, Expected::Scene));
                    self.moves_on(called, State::Step)
                }
                13..=17 => self.step(record),
                18 => {
                    let called = (fmi2Terminate(c), model.gated(Group::Step, Expected::Ok));
                    self.moves_on(called, State::Terminated)
                }
                19 if record.mode() < 128 => {
                    let status = fmi2Reset(c);
                    self.model = Model::new();
                    self.make_cheap();
                    (status, Expected::Ok)
                }
                19 => self.instantiate_again(record),
                20 => self.slots.save(c, model, record.index()),
                21 => {
                    let (status, expected, restored) = self.slots.restore(c, model, record.index());
                    if let Some(state) = restored {
                        self.model.restored(state);
                    }
                    (status, expected)
                }
                22 => self.slots.free(c, record.index()),
                23 => self.slots.serialize(c, record.index()),
                24 => self.slots.deserialize(c, record.index(), record.mode(), record.raw()),
                25 => self.derivatives(record),
                26 => self.slopes(record),
                _ => self.statuses(record),
            }
        }
    }

    fn moves_on(&mut self, (status, expected): Called, state: State) -> Called {
        if status <= 1 && expected != Expected::Error {
            self.model.state = state;
        }
        (status, expected)
    }

    /// Frees the instance and makes another one, which may be refused for its arguments.
    fn instantiate_again(&mut self, record: Record) -> Called {
        let (kind, guid) = ([1, 0, 2][record.index() % 3], [&*GUID_TEXT, &*TEXTS[3]][record.index() / 3 % 2]);
        let refused = kind != 1 || guid != &*GUID_TEXT;
        let component = instantiate(kind, guid, record.mode() & 2 != 0);
        assert_eq!(component.is_null(), refused);
        if !refused {
            // SAFETY: the former instance is not used again, nor are its saved states.
            unsafe { fmi2FreeInstance(self.component) }
            self.component = component;
            self.model = Model::new();
            self.slots.forget();
            self.make_cheap();
        }
        (0, Expected::Ok)
    }
}

/// An instance with logging to the callback of fmi-sys, which formats and drops the messages, or
/// with none.
fn instantiate(kind: u32, guid: &CStr, logs: bool) -> fmi2Component {
    let functions = fmi2CallbackFunctions {
        logger: Some(fmi_sys::fmi2::logger::callback_logger_handler),
        allocateMemory: None,
        freeMemory: None,
        stepFinished: None,
        componentEnvironment: null_mut(),
    };
    let callbacks = if logs { &raw const functions } else { null() };
    // SAFETY: every string ends with a null character; the callbacks are copied.
    unsafe {
        let name: *const c_char = c"any order".as_ptr();
        fmi2Instantiate(name, kind, guid.as_ptr(), c"file:///".as_ptr(), callbacks, 0, logs.into())
    }
}
