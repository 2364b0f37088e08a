//! Likely mistakes: each is logged once per instance, as a warning with its number; the calls
//! succeed. Sensible scenes cause none.

use crate::host::{Fmu, OK, WARNING};
use std::ffi::CString;

const X: &str = "tangential_displacement";
const AMPLITUDE: &str = "displacement_amplitude";

/// A run after `set`, with these inputs in turn, a second each, ended in good order.
fn run(set: impl FnOnce(&Fmu), steps: &[&[(&str, f64)]]) -> Vec<String> {
    let fmu = Fmu::started(set);
    for (k, inputs) in steps.iter().enumerate() {
        fmu.step_with(inputs, k as f64, 1.0);
    }
    assert_eq!(fmu.terminate(), OK);
    fmu.messages()
}

/// Asserts that there is one message, a warning with all of `texts`.
#[track_caller]
fn warned(messages: &[String], texts: &[&str]) {
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].starts_with("WARN: "), "{messages:?}");
    for text in texts {
        assert!(messages[0].contains(text), "{text:?} is missing in: {messages:?}");
    }
}

fn real(name: &str, value: f64) -> impl FnOnce(&Fmu) + '_ {
    move |fmu| assert_eq!(fmu.set_real(name, value), OK)
}

fn table(content: &str) -> (tempfile::NamedTempFile, impl Fn(&Fmu)) {
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), content).unwrap();
    let path = CString::new(file.path().to_str().unwrap()).unwrap();
    (file, move |fmu: &Fmu| {
        assert_eq!((fmu.set_integer("profile", 7), fmu.set_string("profile_file", &path)), (OK, OK));
    })
}

const STROKES: [&[(&str, f64)]; 4] = [&[(X, 2e-6)], &[(X, -2e-6)], &[(X, 4e-6)], &[(X, -4e-6)]];

#[test]
fn sensible_scenes_cause_no_warning() {
    assert_eq!(run(|_| {}, &STROKES), [""; 0]);
    // every profile with its start values
    for profile in 1..=6 {
        let messages = run(|fmu| assert_eq!(fmu.set_integer("profile", profile), OK), &STROKES);
        assert_eq!(messages, [""; 0], "profile {profile}");
    }
    let cyclic = |fmu: &Fmu| assert_eq!(fmu.set_integer("loading", 2), OK);
    assert_eq!(
        run(cyclic, &[&[(AMPLITUDE, 2e-6)], &[(AMPLITUDE, 3e-6)], &[("normal_force", 50.0)]]),
        [""; 0]
    );
    let held = |fmu: &Fmu| assert_eq!(fmu.set_integer("normal_control", 2), OK);
    assert_eq!(run(held, &STROKES), [""; 0]);
    assert_eq!(run(real("rig_stiffness", 1e7), &STROKES), [""; 0]);
    // an input that is not connected is 0 in some tools; a contact may be found and lost
    let gap = [
        &[(AMPLITUDE, 0.0), ("normal_force", -1.0)][..],
        &[(X, 1e-4)],
        &[("normal_force", 100.0)],
        STROKES[0],
    ];
    assert_eq!(run(real("normal_force", 0.0), &gap), [""; 0]);
    let content: String =
        (0..40).map(|k| f64::from(k) * 1e-5).map(|r| format!("{r:e} {:e}\n", r * r / 0.02)).collect();
    let (_file, set) = table(&content);
    assert_eq!(run(set, &STROKES), [""; 0]);
}

#[test]
fn a_modulus_in_the_wrong_unit() {
    // 210 of one body alone: the materials are not similar either, and the contact is wide
    let fmu = Fmu::new();
    assert_eq!((fmu.set_real("youngs_modulus_1", 210.0), fmu.enter_initialization()), (OK, OK));
    assert_eq!(fmu.exit_initialization(), WARNING, "of the materials, which has always been so");
    let modulus: Vec<_> = fmu.messages().into_iter().filter(|text| text.contains("below 1 MPa")).collect();
    warned(&modulus, &["youngs_modulus_1 = 210 Pa", "check the unit"]);
    let fmu = Fmu::started(|fmu| {
        for (name, value) in [("youngs_modulus_2", 9.9e5), ("normal_force", 1e-3)] {
            assert_eq!(fmu.set_real(name, value), OK);
        }
        assert_eq!(fmu.set_real("youngs_modulus_1", 9.9e5), OK);
    });
    warned(&fmu.messages(), &["youngs_modulus_1 = 9.9e5 Pa"]);
}

#[test]
fn a_contact_that_is_wide_for_its_body() {
    // a = (3 F R/(4 E*))^(1/3) = 0.126 mm on R = 0.5 mm
    let scene = |fmu: &Fmu| {
        for (name, value) in [("radius", 5e-4), ("normal_force", 620.0), ("hardness", 1e11)] {
            assert_eq!(fmu.set_real(name, value), OK);
        }
    };
    warned(&run(scene, &STROKES), &["contact_radius = 1.26", "radius = 5e-4 m", "a tenth of"]);
}

#[test]
fn a_pressure_above_the_hardness() {
    // p₀ = 1.37088 GPa
    let soft = run(real("hardness", 1.37e9), &[]);
    warned(&soft, &["1.371e9 Pa", "hardness = 1.37e9 Pa", "check hardness"]);
    assert_eq!(run(real("hardness", 1.38e9), &[]), [""; 0]);
    // at the first contact, whenever that is
    let fmu = Fmu::started(|fmu| {
        assert_eq!((fmu.set_real("hardness", 1e9), fmu.set_real("normal_force", 0.0)), (OK, OK))
    });
    assert_eq!(fmu.messages(), [""; 0]);
    fmu.step_with(&[("normal_force", 100.0)], 0.0, 1.0);
    warned(&fmu.messages(), &["hardness = 1e9 Pa"]);
    fmu.step_with(&[("normal_force", 0.0)], 1.0, 1.0);
    fmu.step_with(&[("normal_force", 200.0)], 2.0, 1.0);
    assert_eq!(fmu.messages(), [""; 0], "once per instance");
    // and in a saved state of the run, or in another run
    let saved = fmu.save();
    assert_eq!(fmu.restore(saved), OK);
    fmu.step_with(&[(X, 1e-6)], 3.0, 1.0);
    assert_eq!(fmu.reset(), OK);
    assert_eq!(fmu.set_real("hardness", 1e9), OK);
    fmu.initialize();
    assert_eq!(fmu.messages(), [""; 0]);
}

#[test]
fn a_table_in_the_wrong_unit() {
    // µm read as m: a ball of 10 mm is one of 10 km
    let content: String =
        (0..40).map(|k| 10.0 * f64::from(k)).map(|r| format!("{r} {}\n", r * r / 2e4)).collect();
    let (_file, set) = table(&content);
    warned(
        &run(set, &[]),
        &["first three points", "r = 20 m", "unit of profile_file", "contact_radius = 1.8"],
    );
}

#[test]
fn a_rig_in_the_wrong_unit() {
    // 35 N/µm read as N/m, on a contact of 35.4673 N/µm
    warned(&run(real("rig_stiffness", 35.0), &STROKES), &["rig_stiffness = 35 N/m", "3.547e7 N/m"]);
    assert_eq!(run(real("rig_stiffness", 3.6e4), &STROKES), [""; 0]);
}

#[test]
fn a_step_far_beyond_full_slip() {
    // u_max = 2.53755 µm
    warned(
        &run(real("wear_coefficient", 0.0), &[&[(X, 2.6e-4)], &[(X, -2.6e-4)]]),
        &["2.600e-4 m", "2.538e-6 m", "which is m"],
    );
    warned(&run(|_| {}, &[&[("tangential_displacement_y", -2.6e-4)]]), &["2.600e-4 m"]);
    assert_eq!(run(|_| {}, &[&[(X, 2.5e-4)]]), [""; 0]);
    // nothing has moved where a state is put back
    let fmu = Fmu::started(|_| {});
    let saved = fmu.save();
    for k in 0..3 {
        fmu.step_with(&[(X, 2e-4 * f64::from(k + 1))], f64::from(k), 1.0);
    }
    assert_eq!(fmu.restore(saved), OK);
    fmu.step_with(&[(X, 1e-6)], 0.0, 1.0);
    assert_eq!(fmu.messages(), [""; 0]);
}

#[test]
fn motion_in_cyclic_loading_and_an_amplitude_in_transient_loading() {
    let cyclic = |fmu: &Fmu| assert_eq!(fmu.set_integer("loading", 2), OK);
    let strokes = run(cyclic, &STROKES);
    warned(&strokes, &["loading = cyclic", "from 0 m to 2e-6 m", "loading = transient"]);
    // a constant offset is no motion
    let offset = |fmu: &Fmu| {
        cyclic(fmu);
        assert_eq!(fmu.set_real(X, 1e-6), OK);
    };
    assert_eq!(run(offset, &[&[(AMPLITUDE, 2e-6)]]), [""; 0]);
    warned(&run(real(AMPLITUDE, 5e-6), &STROKES), &["displacement_amplitude = 5e-6 m", "loading = cyclic"]);
    warned(&run(|_| {}, &[&[(AMPLITUDE, 2e-6)], &[(AMPLITUDE, 3e-6)]]), &["displacement_amplitude = 2e-6 m"]);
}

#[test]
fn a_rotation_of_a_single_contact() {
    let texts = ["rotation = 0.001 rad has no effect", "contacts_file"];
    warned(&run(real("rotation", 1e-3), &STROKES), &texts);
    warned(&run(|_| {}, &[&[("rotation", 1e-3)], &[("rotation", 2e-3)]]), &texts);
    let cyclic = |fmu: &Fmu| assert_eq!(fmu.set_integer("loading", 2), OK);
    warned(&run(cyclic, &[&[("rotation", 1e-3)], &[]]), &texts);
}

#[test]
fn a_load_that_is_never_positive() {
    let messages =
        run(real("normal_force", 0.0), &[&[("normal_force", -50.0), (X, 1e-6)], &[("normal_force", -20.0)]]);
    warned(&messages, &["never touched", "normal_force was never above 0 N", "connected"]);
    let messages = run(real("normal_force", -100.0), &STROKES);
    warned(&messages, &["never above -100 N"]);
    // nothing moves: nothing is missed
    assert_eq!(run(real("normal_force", 0.0), &[&[], &[]]), [""; 0]);
    let cycles = |fmu: &Fmu| {
        assert_eq!((fmu.set_integer("loading", 2), fmu.set_real("normal_force", 0.0)), (OK, OK));
    };
    warned(&run(cycles, &[&[]]), &["never touched"]);
}

#[test]
fn settings_without_effect_are_named() {
    let file = |fmu: &Fmu| assert_eq!(fmu.set_string("profile_file", c"scan.txt"), OK);
    warned(&run(file, &STROKES), &["profile_file", "scan.txt", "profile = table"]);
    let last = real("friction_coefficient_final", 0.8);
    warned(&run(last, &STROKES), &["friction_coefficient_final = 0.8", "running_in_energy"]);
}
