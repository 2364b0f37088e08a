//! The order of calls: a whole life, every function in every state, reset, several instances.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use crate::host::{DISCARD, ERROR, Fmu, OK};
use core::ptr::{null, null_mut};
use fmi_sys::fmi2::{fmi2Component, fmi2Status};
use fretting_contact::fmi2::exports::*;
use fretting_contact::{FrettingContact, Parameters};

#[test]
fn a_whole_life() {
    let fmu = Fmu::new();
    assert_eq!(fmu.set_real("friction_coefficient", 0.5), OK);
    assert_eq!(fmu.setup(2.0, Some(3.0)), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    assert_eq!(fmu.set_real("normal_force", 50.0), OK);
    assert_eq!(fmu.exit_initialization(), OK);
    for i in 0..10 {
        let point = 2.0 + 0.1 * f64::from(i);
        fmu.step_with(&[("tangential_displacement", 1e-6 * f64::from(i + 1))], point, 0.1);
    }
    let force = fmu.real("tangential_force");
    assert!((force - 25.0).abs() < 1e-9, "10 µm drag the contact into gross slip, T = μ F_N: {force}");
    assert_eq!(fmu.integer("slip_state"), 4);
    assert_eq!(fmu.terminate(), OK);
    assert_eq!(fmu.real("tangential_force"), force);
    assert_eq!(fmu.messages(), Vec::<String>::new());
}

/// The states an importer can bring an instance into.
const STATES: [&str; 4] = ["instantiated", "initialization mode", "step complete", "terminated"];

fn bring_into(state: &str) -> Fmu {
    let fmu = Fmu::new();
    let calls = [Fmu::enter_initialization, Fmu::exit_initialization, Fmu::terminate];
    for call in &calls[..STATES.iter().position(|s| *s == state).unwrap()] {
        assert_eq!(call(&fmu), OK);
    }
    fmu
}

type Function = fn(fmi2Component) -> fmi2Status;

/// Every function that acts on an instance and returns a status, with empty or harmless arguments,
/// and the states in which the standard allows it: I(nstantiated), M (initialization mode), C (step
/// complete), T(erminated).
// SAFETY: the components are alive or null; empty arrays may be null, and single results have room.
const FUNCTIONS: [(&str, Function, &str); 30] = unsafe {
    [
        ("fmi2SetDebugLogging", |c| fmi2SetDebugLogging(c, 0, 0, null()), "IMCT"),
        ("fmi2SetupExperiment", |c| fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), "I"),
        ("fmi2EnterInitializationMode", |c| fmi2EnterInitializationMode(c), "I"),
        ("fmi2ExitInitializationMode", |c| fmi2ExitInitializationMode(c), "M"),
        ("fmi2Terminate", |c| fmi2Terminate(c), "C"),
        ("fmi2Reset", |c| fmi2Reset(c), "IMCT"),
        ("fmi2GetReal", |c| fmi2GetReal(c, null(), 0, null_mut()), "MCT"),
        ("fmi2GetInteger", |c| fmi2GetInteger(c, null(), 0, null_mut()), "MCT"),
        ("fmi2GetBoolean", |c| fmi2GetBoolean(c, null(), 0, null_mut()), "MCT"),
        ("fmi2GetString", |c| fmi2GetString(c, null(), 0, null_mut()), "MCT"),
        ("fmi2SetReal", |c| fmi2SetReal(c, null(), 0, null()), "IMC"),
        ("fmi2SetInteger", |c| fmi2SetInteger(c, null(), 0, null()), "IMC"),
        ("fmi2SetBoolean", |c| fmi2SetBoolean(c, null(), 0, null()), "IMC"),
        ("fmi2SetString", |c| fmi2SetString(c, null(), 0, null()), "IMC"),
        ("fmi2GetFMUstate", |c| fmi2GetFMUstate(c, &raw mut *Box::new(null_mut())), "IMCT"),
        ("fmi2SetFMUstate", |c| fmi2SetFMUstate(c, null_mut()), "IMCT"),
        ("fmi2FreeFMUstate", |c| fmi2FreeFMUstate(c, null_mut()), "IMCT"),
        ("fmi2SerializedFMUstateSize", |c| fmi2SerializedFMUstateSize(c, null_mut(), null_mut()), "IMCT"),
        ("fmi2SerializeFMUstate", |c| fmi2SerializeFMUstate(c, null_mut(), null_mut(), 0), "IMCT"),
        ("fmi2DeSerializeFMUstate", |c| fmi2DeSerializeFMUstate(c, null(), 0, null_mut()), "IMCT"),
        (
            "fmi2GetDirectionalDerivative",
            |c| fmi2GetDirectionalDerivative(c, null(), 0, null(), 0, null(), null_mut()),
            "MCT",
        ),
        ("fmi2SetRealInputDerivatives", |c| fmi2SetRealInputDerivatives(c, null(), 0, null(), null()), "IMC"),
        (
            "fmi2GetRealOutputDerivatives",
            |c| fmi2GetRealOutputDerivatives(c, null(), 0, null(), null_mut()),
            "CT",
        ),
        ("fmi2DoStep", |c| fmi2DoStep(c, 0.0, 0.1, 1), "C"),
        ("fmi2CancelStep", |c| fmi2CancelStep(c), ""),
        ("fmi2GetStatus", |c| fmi2GetStatus(c, 0, &raw mut *Box::new(0)), "CT"),
        ("fmi2GetRealStatus", |c| fmi2GetRealStatus(c, 2, &raw mut *Box::new(0.0)), "CT"),
        ("fmi2GetIntegerStatus", |c| fmi2GetIntegerStatus(c, 0, &raw mut *Box::new(0)), "CT"),
        ("fmi2GetBooleanStatus", |c| fmi2GetBooleanStatus(c, 3, &raw mut *Box::new(0)), "CT"),
        ("fmi2GetStringStatus", |c| fmi2GetStringStatus(c, 1, &raw mut *Box::new(null())), "CT"),
    ]
};

/// Functions that are refused for another reason even where they are allowed, and what they say.
const REFUSED_ANYWAY: [(&str, &str); 4] = [
    ("fmi2SetFMUstate", "FMUstate is a null pointer"),
    ("fmi2SerializedFMUstateSize", "size is a null pointer"),
    ("fmi2SerializeFMUstate", "FMUstate is a null pointer"),
    ("fmi2DeSerializeFMUstate", "FMUstate is a null pointer"),
];

#[test]
fn every_function_in_every_state() {
    for (name, function, allowed) in FUNCTIONS {
        for (state, letter) in STATES.into_iter().zip(["I", "M", "C", "T"]) {
            let fmu = bring_into(state);
            let status = function(fmu.component);
            if !allowed.contains(letter) {
                fmu.refused(status, &[name, &format!("not allowed in state \"{state}\"")]);
            } else if let Some((_, reason)) = REFUSED_ANYWAY.iter().find(|(refused, _)| *refused == name) {
                fmu.refused(status, &[name, reason]);
            } else if name == "fmi2GetIntegerStatus" {
                assert_eq!(status, DISCARD, "{state}");
                assert!(fmu.message().contains("status kind 0"));
            } else {
                assert_eq!((status, fmu.messages()), (OK, vec![]), "{name} in {state}");
            }
        }
    }
}

#[test]
fn a_refused_call_does_not_change_the_state() {
    let fmu = Fmu::new();
    fmu.refused(fmu.do_step(0.0, 0.1), &["fmi2DoStep", "only in \"step complete\""]);
    fmu.refused(fmu.exit_initialization(), &["only in \"initialization mode\""]);
    assert_eq!(fmu.enter_initialization(), OK);
    fmu.refused(fmu.enter_initialization(), &["only in \"instantiated\""]);
    assert_eq!(fmu.exit_initialization(), OK);
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
}

#[test]
fn a_null_component_is_an_error_for_every_function() {
    for (name, function, _) in FUNCTIONS {
        assert_eq!(function(null_mut()), ERROR, "{name}");
    }
    // SAFETY: null is what is tested.
    unsafe { fmi2FreeInstance(null_mut()) }
}

#[test]
fn empty_lists_need_no_arrays_and_full_ones_do() {
    let fmu = Fmu::started(|_| {});
    let (c, none) = (fmu.component, null::<u32>());
    // SAFETY: the pointers are what is tested; where one is not null its array has one element.
    let without_references: [&dyn Fn() -> fmi2Status; 7] = unsafe {
        [
            &|| fmi2GetReal(c, none, 1, &raw mut *Box::new(0.0)),
            &|| fmi2SetReal(c, none, 1, [0.0].as_ptr()),
            &|| fmi2GetInteger(c, none, 1, &raw mut *Box::new(0)),
            &|| fmi2SetInteger(c, none, 1, [0].as_ptr()),
            &|| fmi2GetString(c, none, 1, &raw mut *Box::new(null())),
            &|| fmi2SetString(c, none, 1, [c"".as_ptr()].as_ptr()),
            &|| fmi2SetRealInputDerivatives(c, none, 1, [1].as_ptr(), [0.0].as_ptr()),
        ]
    };
    for call in without_references {
        fmu.refused(call(), &["argument vr is a null pointer"]);
    }
    // SAFETY: as above.
    let without_values: [&dyn Fn() -> fmi2Status; 10] = unsafe {
        [
            &|| fmi2GetReal(c, [0].as_ptr(), 1, null_mut()),
            &|| fmi2SetReal(c, [0].as_ptr(), 1, null()),
            &|| fmi2GetInteger(c, [0].as_ptr(), 1, null_mut()),
            &|| fmi2SetInteger(c, [0].as_ptr(), 1, null()),
            &|| fmi2GetBoolean(c, [0].as_ptr(), 1, null_mut()),
            &|| fmi2SetBoolean(c, [0].as_ptr(), 1, null()),
            &|| fmi2GetString(c, [0].as_ptr(), 1, null_mut()),
            &|| fmi2SetString(c, [0].as_ptr(), 1, null()),
            &|| fmi2GetRealStatus(c, 2, null_mut()),
            &|| fmi2SetRealInputDerivatives(c, [0].as_ptr(), 1, [1].as_ptr(), null()),
        ]
    };
    for call in without_values {
        fmu.refused(call(), &["argument value is a null pointer"]);
    }
    // SAFETY: as above.
    unsafe {
        let status = fmi2SetRealInputDerivatives(c, [0].as_ptr(), 1, null(), [0.0].as_ptr());
        fmu.refused(status, &["argument order is a null pointer"]);
        fmu.refused(fmi2GetFMUstate(c, null_mut()), &["argument FMUstate is a null pointer"]);
        let status = fmi2SetReal(c, [0].as_ptr(), usize::MAX, [0.0].as_ptr());
        fmu.refused(status, &["argument vr", "18446744073709551615 elements"]);
    }
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
}

/// Some steps into gross slip and back.
fn run(fmu: &Fmu) -> Vec<u64> {
    for (i, displacement) in [1e-6, 3e-6, -4e-6, 0.0].into_iter().enumerate() {
        fmu.step_with(&[("tangential_displacement", displacement)], i as f64, 1.0);
    }
    fmu.bits()
}

#[test]
fn reset_gives_the_same_bits() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("radius", 0.02), OK));
    let first = run(&fmu);
    assert_eq!(fmu.reset(), OK);
    fmu.initialize();
    assert_eq!(fmu.real("radius"), 0.01, "reset restores the start values");
    assert_ne!(run(&fmu), first);
    assert_eq!(fmu.reset(), OK);
    assert_eq!(fmu.set_real("radius", 0.02), OK);
    fmu.initialize();
    assert_eq!(run(&fmu), first);
}

#[test]
fn instances_share_nothing() {
    let alone = run(&Fmu::started(|_| {}));
    let (one, two) = (Fmu::started(|_| {}), Fmu::started(|fmu| assert_eq!(fmu.set_real("radius", 0.03), OK)));
    for (i, displacement) in [1e-6, 3e-6, -4e-6, 0.0].into_iter().enumerate() {
        two.step_with(&[("normal_force", 10.0 + i as f64)], i as f64, 1.0);
        one.step_with(&[("tangential_displacement", displacement)], i as f64, 1.0);
    }
    assert_eq!(one.bits(), alone);
    drop(two);
    assert_eq!(one.bits(), alone);
}

#[test]
fn the_status_functions_answer() {
    let fmu = Fmu::started(|_| {});
    let c = fmu.component;
    assert_eq!(fmu.do_step(0.0, 0.25), OK);
    let (mut time, mut status, mut terminated, mut text) = (f64::NAN, 9, 9, null());
    // SAFETY: every result has room.
    unsafe {
        assert_eq!(fmi2GetRealStatus(c, 2, &raw mut time), OK);
        assert_eq!(fmi2GetStatus(c, 0, &raw mut status), OK);
        assert_eq!(fmi2GetBooleanStatus(c, 3, &raw mut terminated), OK);
        assert_eq!(fmi2GetStringStatus(c, 1, &raw mut text), OK);
        assert_eq!((time, status, terminated), (0.25, OK, 0));
        assert!(core::ffi::CStr::from_ptr(text).to_str().unwrap().contains("no step is pending"));

        fmu.refused(fmu.do_step(0.0, 0.25), &["fmi2DoStep"]);
        assert_eq!(fmi2GetStatus(c, 0, &raw mut status), OK);
        assert_eq!(fmi2GetRealStatus(c, 2, &raw mut time), OK);
        assert_eq!((time, status), (0.25, ERROR), "a refused step has not moved time");

        assert_eq!(fmi2GetRealStatus(c, 7, &raw mut time), DISCARD);
        assert!(fmu.message().contains("status kind 7"));
    }
}

/// A run with profile updates, and how the importer wants to hear of it: the messages at its end.
fn messages_at_the_end(logging_on: bool, categories: &[&core::ffi::CStr]) -> Vec<String> {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", 0.1), OK));
    for (k, displacement) in [3e-6, -3e-6, 1e-6, 3e-6].into_iter().enumerate() {
        fmu.step_with(&[("tangential_displacement", displacement)], k as f64, 1.0);
    }
    let names: Vec<_> = categories.iter().map(|name| name.as_ptr()).collect();
    // SAFETY: the names end with a null character, and there are as many as said.
    let status =
        unsafe { fmi2SetDebugLogging(fmu.component, logging_on.into(), names.len(), names.as_ptr()) };
    assert_eq!((status, fmu.messages(), fmu.terminate()), (OK, vec![], OK));
    fmu.messages()
}

#[test]
fn the_end_of_a_run_tells_its_work_as_an_event() {
    let mut engine =
        FrettingContact::new(Parameters { wear_coefficient: 0.1, ..Parameters::default() }).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    for displacement in [3e-6, -3e-6, 1e-6, 3e-6] {
        engine.advance_to(100.0, displacement).unwrap();
    }
    let counters = engine.counters();
    assert!(counters.steps == 4 && counters.profile_updates > 0 && counters.descent_transforms > 0);
    assert!(counters.factorisations > 0 && counters.spring_walks > 0);
    for categories in [&[][..], &[c"logEvents"], &[c"logAll"]] {
        let messages = messages_at_the_end(true, categories);
        assert_eq!(messages, [format!("INFO: terminated after this work: {counters}")]);
    }
    assert_eq!(messages_at_the_end(false, &[]), Vec::<String>::new());
    assert_eq!(messages_at_the_end(true, &[c"logStatusDiscard"]), Vec::<String>::new());
    for number in [
        counters.factorisations,
        counters.profile_updates,
        counters.rejected_steps,
        counters.descent_transforms,
        counters.pressure_transforms,
    ] {
        assert!(counters.to_string().contains(&format!(" {number} ")), "{counters}");
    }
}

/// "201 steps" stood in the log after 200.
#[test]
fn the_end_of_a_run_counts_the_steps_that_were_asked_for() {
    let fmu = Fmu::started(|_| {});
    for k in 0..200 {
        fmu.step_with(&[("tangential_displacement", 1e-6 * f64::from(k).sin())], f64::from(k), 1.0);
    }
    let messages = fmu.terminated_aloud();
    assert!(messages[0].contains(" work: 200 steps, "), "{messages:?}");
}

/// A single hash in a message begins a value reference that the importer replaces; the standard has
/// it doubled.
#[test]
fn hashes_in_messages_are_doubled() {
    let fmu = Fmu::new();
    assert_eq!(
        (fmu.set_integer("profile", 7), fmu.set_string("profile_file", c"tip #r1# no. 3.txt")),
        (OK, OK)
    );
    assert_eq!((fmu.setup(0.0, None), fmu.enter_initialization()), (OK, OK));
    assert_eq!(fmu.exit_initialization(), ERROR);
    let message = fmu.message();
    assert!(message.contains("profile_file = \"tip ##r1## no. 3.txt\""), "{message}");
    assert!(!message.replace("##", "").contains('#'), "{message}");
}
