//! Writes the seeds of the target `states`: serialised states of a few scenes, without their
//! headers. `cargo run --manifest-path fuzz/Cargo.toml --example seeds` in the root of the
//! checkout, after each change of the format.

use core::ptr::{null, null_mut};
use fmi_sys::fmi2::fmi2Component;
use fretting_contact::fmi2::GUID;
use fretting_contact::fmi2::exports::*;
use fretting_contact::fmi2::variables::variables;
use std::ffi::CString;
use std::fs;

/// Length of the header, which the target makes itself.
const HEADER: usize = 60;
const FOLDER: &str = "fuzz/corpus/states";

fn reference(name: &str) -> u32 {
    variables().iter().position(|variable| variable.name == name).expect("it is a variable") as u32
}

// SAFETY of every call below: the component is alive, results have room and arrays the lengths
// given.
fn instance() -> fmi2Component {
    let guid = CString::new(GUID).expect("no null");
    // SAFETY: strings end with a null character.
    unsafe { fmi2Instantiate(c"seeds".as_ptr(), 1, guid.as_ptr(), null(), null(), 0, 0) }
}

fn set(c: fmi2Component, name: &str, value: f64) {
    let reference = [reference(name)];
    // SAFETY: see above. Integers are refused as reals and the other way round.
    unsafe {
        let real = fmi2SetReal(c, reference.as_ptr(), 1, [value].as_ptr());
        assert!(
            real == 0 || fmi2SetInteger(c, reference.as_ptr(), 1, [value as i32].as_ptr()) == 0,
            "{name}"
        );
    }
}

fn write(c: fmi2Component, name: &str) {
    let (mut state, mut size) = (null_mut(), 0);
    // SAFETY: see above.
    let bytes = unsafe {
        assert_eq!(fmi2GetFMUstate(c, &raw mut state), 0);
        assert_eq!(fmi2SerializedFMUstateSize(c, state, &raw mut size), 0);
        let mut bytes = vec![0u8; size];
        assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr().cast(), size), 0);
        bytes
    };
    fs::write(format!("{FOLDER}/{name}"), &bytes[HEADER..]).expect("the file can be written");
}

/// Steps with these inputs: name, values.
fn scene(name: &str, parameters: &[(&str, f64)], steps: &[&[(&str, f64)]]) {
    let c = instance();
    for (name, value) in [("resolution", 8.0)].iter().chain(parameters) {
        set(c, name, *value);
    }
    // SAFETY: see above.
    unsafe {
        assert_eq!((fmi2EnterInitializationMode(c), fmi2ExitInitializationMode(c)), (0, 0));
        for (k, inputs) in steps.iter().enumerate() {
            inputs.iter().for_each(|(name, value)| set(c, name, *value));
            assert_eq!(fmi2DoStep(c, k as f64, 1.0, 1), 0);
        }
        write(c, name);
        fmi2FreeInstance(c);
    }
}

fn main() {
    fs::create_dir_all(FOLDER).expect("the folder can be made");
    let c = instance();
    write(c, "instantiated");
    // SAFETY: see above.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(c), 0);
        write(c, "initialization");
        fmi2FreeInstance(c);
    }
    let moved = |x: f64| ("tangential_displacement", x);
    let strokes: &[&[_]] = &[&[moved(1e-6)], &[moved(-2e-6)], &[moved(0.5e-6), ("normal_force", 80.0)]];
    scene("sticks", &[("wear_coefficient", 0.0)], &[&[moved(1e-7)]]);
    scene("slips", &[("wear_coefficient", 0.0)], strokes);
    scene("wears", &[("wear_coefficient", 0.03)], strokes);
    scene("punch", &[("wear_coefficient", 0.03), ("profile", 6.0)], strokes);
    scene("pressed", &[("normal_control", 2.0), ("profile", 2.0)], &[&[moved(1e-6), ("indentation", 2e-6)]]);
    scene("cyclic", &[("loading", 2.0)], &[&[("displacement_amplitude", 1e-6), ("frequency", 1e3)]]);
    scene("rig", &[("rig_stiffness", 1e7), ("wear_coefficient", 0.03)], strokes);
    let aside = |y: f64| ("tangential_displacement_y", y);
    let turns: &[&[_]] = &[&[moved(1e-6)], &[aside(1e-6)], &[moved(-1e-6), ("normal_force", 80.0)]];
    scene("plane", &[("wear_coefficient", 0.0)], turns);
    scene("plane-wears", &[("wear_coefficient", 0.03)], turns);
    scene("plane-rig", &[("rig_stiffness", 1e7), ("wear_coefficient", 0.03)], turns);
    scene("apart", &[], &[&[("normal_force", -1.0)]]);
}
