//! The shared library as an importer loads it: its symbols, and a run through dynamic linking.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use core::ptr::null;
use fmi_sys::fmi2::{Fmi2Binding, fmi2CallbackFunctions};
use fretting_contact::fmi2::GUID;
use object::{Object, ObjectSymbol};
use std::collections::BTreeSet;
use std::ffi::CString;
use std::path::PathBuf;
use std::{env, fs};

/// The functions of FMI 2.0 for co-simulation.
const FUNCTIONS: [&str; 34] = [
    "fmi2CancelStep",
    "fmi2DeSerializeFMUstate",
    "fmi2DoStep",
    "fmi2EnterInitializationMode",
    "fmi2ExitInitializationMode",
    "fmi2FreeFMUstate",
    "fmi2FreeInstance",
    "fmi2GetBoolean",
    "fmi2GetBooleanStatus",
    "fmi2GetDirectionalDerivative",
    "fmi2GetFMUstate",
    "fmi2GetInteger",
    "fmi2GetIntegerStatus",
    "fmi2GetReal",
    "fmi2GetRealOutputDerivatives",
    "fmi2GetRealStatus",
    "fmi2GetStatus",
    "fmi2GetString",
    "fmi2GetStringStatus",
    "fmi2GetTypesPlatform",
    "fmi2GetVersion",
    "fmi2Instantiate",
    "fmi2Reset",
    "fmi2SerializeFMUstate",
    "fmi2SerializedFMUstateSize",
    "fmi2SetBoolean",
    "fmi2SetDebugLogging",
    "fmi2SetFMUstate",
    "fmi2SetInteger",
    "fmi2SetReal",
    "fmi2SetRealInputDerivatives",
    "fmi2SetString",
    "fmi2SetupExperiment",
    "fmi2Terminate",
];

/// The library that cargo builds beside the tests.
fn library() -> PathBuf {
    let test = env::current_exe().expect("the test has a path");
    test.with_file_name("libfretting_contact.so")
}

#[test]
fn the_library_exports_the_functions_and_nothing_else() {
    let bytes = fs::read(library()).expect("the library has been built");
    let library = object::File::parse(&*bytes).expect("the library is an object file");
    let exported: BTreeSet<_> = library
        .dynamic_symbols()
        .filter(|symbol| symbol.is_definition() && symbol.is_global())
        .map(|symbol| symbol.name().expect("a symbol has a name"))
        .collect();
    assert_eq!(exported, FUNCTIONS.into_iter().collect());
}

#[test]
fn a_dynamically_linked_run() {
    // SAFETY: the library is ours, and its functions have the types of the header.
    let binding = unsafe { Fmi2Binding::new(library()) }.expect("the library loads");
    let guid = CString::new(GUID).unwrap();
    let functions = fmi2CallbackFunctions {
        logger: None,
        allocateMemory: None,
        freeMemory: None,
        stepFinished: None,
        componentEnvironment: core::ptr::null_mut(),
    };
    // SAFETY: all pointers are valid, and the instance is freed last.
    unsafe {
        let name = c"linked".as_ptr();
        let c = binding.fmi2Instantiate(name, 1, guid.as_ptr(), null(), &raw const functions, 0, 0);
        assert!(!c.is_null());
        assert_eq!(binding.fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), 0);
        assert_eq!(binding.fmi2EnterInitializationMode(c), 0);
        assert_eq!(binding.fmi2ExitInitializationMode(c), 0);
        // tangential_displacement is variable 2, tangential_force variable 5.
        assert_eq!(binding.fmi2SetReal(c, [2].as_ptr(), 1, [1e-5].as_ptr()), 0);
        assert_eq!(binding.fmi2DoStep(c, 0.0, 1.0, 1), 0);
        let mut force = [0.0];
        assert_eq!(binding.fmi2GetReal(c, [5].as_ptr(), 1, force.as_mut_ptr()), 0);
        assert!((force[0] - 60.0).abs() < 1e-9, "gross slip: {force:?}");
        assert_eq!(binding.fmi2Terminate(c), 0);
        binding.fmi2FreeInstance(c);
    }
}
