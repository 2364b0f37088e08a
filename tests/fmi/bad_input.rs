//! Bad input one by one: the status, a message with the name and the value, and an instance that is
//! usable afterwards.
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use crate::host::{DISCARD, Fmu, NOWHERE, OK, WARNING, reference};
use core::ptr::null;
use fretting_contact::fmi2::exports::*;
use fretting_contact::fmi2::variables::variables;
use std::ffi::CString;
use std::path::Path;

#[test]
fn inputs_that_are_not_finite() {
    let fmu = Fmu::started(|_| {});
    for input in variables().iter().filter(|v| v.causality() == "input") {
        let before = fmu.real(input.name);
        for (value, text) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf"), (f64::NEG_INFINITY, "-inf")] {
            fmu.refused(
                fmu.set_real(input.name, value),
                &["fmi2SetReal", &format!("{} = {text}", input.name)],
            );
            assert_eq!(fmu.real(input.name), before);
        }
    }
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
}

#[test]
fn inputs_outside_their_range() {
    let fmu = Fmu::started(|_| {});
    for name in ["displacement_amplitude", "frequency"] {
        fmu.refused(fmu.set_real(name, -0.5), &[&format!("{name} = -0.5"), ">= 0.0"]);
    }
    assert_eq!(fmu.set_real("normal_force", -5.0), OK, "the bodies part");
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
    assert_eq!(fmu.integer("slip_state"), 1);
}

#[test]
fn parameters_outside_their_range() {
    let fmu = Fmu::new();
    for (name, value, text, requirement) in [
        ("youngs_modulus_1", 0.0, "0.0", ">= 1e-30"),
        ("youngs_modulus_1", -210e9, "-210000000000.0", ">= 1e-30"),
        ("youngs_modulus_2", -1.0, "-1.0", ">= 1e-30"),
        ("youngs_modulus_2", f64::NAN, "NaN", "finite"),
        ("hardness", 0.0, "0.0", ">= 1e-30"),
        ("radius", 0.0, "0.0", ">= 1e-30"),
        ("radius", -0.01, "-0.01", ">= 1e-30"),
        ("radius", f64::INFINITY, "inf", "finite"),
        ("flat_radius", -1e-4, "-0.0001", ">= 1e-30"),
        ("cone_slope", 2.0, "2.0", "< 1.57"),
        ("exponent", 0.0, "0.0", ">= 0.1"),
        ("coefficient", 0.0, "0.0", ">= 1e-300"),
        ("friction_coefficient", -0.1, "-0.1", ">= 0.0"),
        ("friction_coefficient", f64::NAN, "NaN", ">= 0.0"),
        ("wear_coefficient", -1e-4, "-0.0001", ">= 0.0"),
        ("poisson_ratio_1", -1.0, "-1.0", "> -1.0 and <= 0.5"),
        ("poisson_ratio_1", 0.51, "0.51", "<= 0.5"),
        ("poisson_ratio_2", f64::NAN, "NaN", "<= 0.5"),
        ("tolerance", 0.0, "0.0", ">= 1e-7 and <= 0.1"),
        ("tolerance", 0.2, "0.2", "<= 0.1"),
    ] {
        fmu.refused(fmu.set_real(name, value), &["fmi2SetReal", &format!("{name} = {text}"), requirement]);
    }
    assert_eq!(fmu.set_real("poisson_ratio_1", 0.5), OK);
    fmu.enter_initialization();
    assert_eq!(fmu.exit_initialization(), WARNING, "dissimilar now");
}

#[test]
fn numbers_that_are_no_item_or_out_of_range() {
    let fmu = Fmu::new();
    for (name, value, requirement) in [
        ("profile", 0, "1 = parabola"),
        ("profile", 9, "8 = ellipse"),
        ("normal_control", 3, "2 = indentation"),
        ("loading", -1, "2 = cyclic"),
        ("resolution", 7, "give 8 to 512"),
        ("resolution", 513, "give 8 to 512"),
    ] {
        fmu.refused(
            fmu.set_integer(name, value),
            &["fmi2SetInteger", &format!("{name} = {value}"), requirement],
        );
    }
    fmu.initialize();
}

#[test]
fn references_that_do_not_exist_or_have_another_type() {
    let fmu = Fmu::started(|_| {});
    let nowhere = &[&*format!("value reference {NOWHERE} does not exist"), "lists 0 to "];
    fmu.refused(fmu.set_reals(&[NOWHERE], &[1.0]), nowhere);
    fmu.refused(fmu.get_reals(&[NOWHERE], &mut [0.0]), nowhere);
    fmu.refused(fmu.set_integers(&[NOWHERE], &[1]), nowhere);
    fmu.refused(fmu.get_integers(&[NOWHERE], &mut [0]), nowhere);
    fmu.refused(
        fmu.get_reals(&[reference("slip_state")], &mut [0.0]),
        &["slip_state", "Integer (Enumeration), not Real"],
    );
    fmu.refused(fmu.set_reals(&[reference("resolution")], &[9.0]), &["resolution", "Integer, not Real"]);
    fmu.refused(fmu.get_integers(&[reference("radius")], &mut [0]), &["radius", "Real, not Integer"]);
    fmu.refused(fmu.set_string("radius", c"0.01"), &["fmi2SetString", "radius", "Real, not String"]);
    fmu.refused(
        fmu.get_reals(&[reference("profile_file")], &mut [0.0]),
        &["profile_file", "String, not Real"],
    );
    let (vr, c) = ([reference("radius")], fmu.component);
    // SAFETY: the arrays have one element.
    unsafe {
        fmu.refused(fmi2SetBoolean(c, vr.as_ptr(), 1, [1].as_ptr()), &["radius", "Real, not Boolean"]);
        fmu.refused(fmi2GetBoolean(c, vr.as_ptr(), 1, [0].as_mut_ptr()), &["radius", "Real, not Boolean"]);
    }
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
}

#[test]
fn what_cannot_be_set() {
    let fmu = Fmu::new();
    fmu.refused(fmu.set_real("wear_volume", 1e-12), &["wear_volume = 1e-12", "causality output"]);
    fmu.refused(fmu.set_real("pressure[3]", 5.0), &["pressure[3] = 5.0", "causality local"]);
    fmu.refused(fmu.set_integer("slip_state", 2), &["slip_state = 2", "causality output"]);
    fmu.initialize();
    fmu.refused(fmu.set_real("radius", 0.02), &["radius = 0.02", "fixed after initialization", "fmi2Reset"]);
    fmu.refused(fmu.set_integer("loading", 2), &["loading = 2", "fixed after initialization"]);
    fmu.refused(fmu.set_string("profile_file", c"tip.txt"), &["profile_file = \"tip.txt\"", "fixed after"]);
    assert_eq!(fmu.real("radius"), 0.01);
    assert_eq!(fmu.do_step(0.0, 0.1), OK);
}

#[test]
fn a_list_with_one_mistake_sets_nothing() {
    let fmu = Fmu::new();
    let references = ["radius", "hardness", "normal_force"].map(reference);
    fmu.refused(fmu.set_reals(&references, &[0.05, -1.0, 7.0]), &["hardness = -1.0"]);
    fmu.refused(fmu.set_reals(&[references[0], NOWHERE], &[0.05, 1.0]), &["1000000"]);
    let integers = ["resolution", "loading"].map(reference);
    fmu.refused(fmu.set_integers(&integers, &[128, 3]), &["loading = 3"]);
    fmu.initialize();
    assert_eq!((fmu.real("radius"), fmu.real("normal_force")), (0.01, 100.0));
    assert_eq!((fmu.integer("resolution"), fmu.integer("loading")), (64, 1));

    let mut values = [-7.0; 2];
    fmu.refused(fmu.get_reals(&[references[0], NOWHERE], &mut values), &["1000000"]);
    assert_eq!(values, [-7.0; 2], "nothing is filled in either");
    let slopes = (["normal_force", "radius"].map(reference), [1, 1], [1.0, 1.0]);
    // SAFETY: the arrays have two elements.
    let status = unsafe {
        fmi2SetRealInputDerivatives(fmu.component, slopes.0.as_ptr(), 2, slopes.1.as_ptr(), slopes.2.as_ptr())
    };
    fmu.refused(status, &["derivative of radius = 1.0", "not an input"]);
    assert_eq!(fmu.do_step(0.0, 1.0), OK);
    assert_eq!(fmu.real("normal_force"), 100.0, "no slope was taken over");
}

#[test]
fn steps_of_a_wrong_length_or_from_a_wrong_point() {
    let fmu = Fmu::new();
    assert_eq!(fmu.setup(0.0, Some(1.0)), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    assert_eq!(fmu.exit_initialization(), OK);
    fmu.refused(fmu.do_step(0.0, -0.1), &["communicationStepSize = -0.1", "not negative"]);
    fmu.refused(fmu.do_step(0.0, f64::NAN), &["communicationStepSize = NaN"]);
    fmu.refused(fmu.do_step(0.0, f64::INFINITY), &["communicationStepSize = inf"]);
    fmu.refused(fmu.do_step(0.5, 0.1), &["currentCommunicationPoint = 0.5", "ended at 0.0"]);
    fmu.refused(fmu.do_step(f64::NAN, 0.1), &["currentCommunicationPoint = NaN"]);
    fmu.refused(fmu.do_step(0.0, 1.5), &["0.0 of length 1.5", "stop time 1.0"]);
    assert_eq!(fmu.do_step(0.0, 0.4), OK);
    assert_eq!(fmu.do_step(0.4 + 1e-16, 0.6), OK);
    fmu.refused(fmu.do_step(1.0, 0.1), &["stop time 1.0"]);
}

#[test]
fn experiments_that_make_no_sense() {
    let fmu = Fmu::new();
    fmu.refused(fmu.setup(f64::NAN, None), &["startTime = NaN"]);
    fmu.refused(fmu.setup(1.0, Some(0.5)), &["stopTime = 0.5"]);
    // SAFETY: the component is alive.
    let status = unsafe { fmi2SetupExperiment(fmu.component, 1, -1.0, 0.0, 0, 0.0) };
    fmu.refused(status, &["tolerance = -1.0"]);
    fmu.initialize();
}

const CONTINUOUS: &str = "only continuous outputs have derivatives: tangential_force, wear_volume, ";

#[test]
fn derivatives_that_are_not_supported() {
    let fmu = Fmu::started(|_| {});
    fmu.refused(fmu.set_slope("normal_force", 2, 1.0), &["derivative of normal_force", "order 2"]);
    fmu.refused(fmu.set_slope("normal_force", 0, 1.0), &["derivative of normal_force", "order 0"]);
    fmu.refused(fmu.set_slope("normal_force", 1, f64::NAN), &["derivative of normal_force = NaN"]);
    fmu.refused(fmu.set_slope("wear_depth", 1, 1.0), &["derivative of wear_depth = 1.0", "not an input"]);
    let output = |name, order| fmu.output_slope(name, order).1;
    fmu.refused(output("wear_depth", 0), &["fmi2GetRealOutputDerivatives", "wear_depth", "order 0"]);
    fmu.refused(output("wear_depth", 0), &["wear_depth", "order 0"]);
    fmu.refused(
        output("normal_force", 1),
        &["normal_force is refused: it has the causality input", CONTINUOUS],
    );
    fmu.refused(
        output("pressure[1]", 1),
        &["pressure[1] is refused: it has the causality local", CONTINUOUS],
    );
    let directional = |unknown, known, seed| fmu.directional(&[unknown], &[(known, seed)]).1;
    let refused = |status, texts: &[&str]| fmu.refused(status, texts);
    refused(
        directional("pressure[1]", "normal_force", 1.0),
        &["pressure[1] is refused as an unknown: it has the causality local", CONTINUOUS],
    );
    refused(
        directional("radius", "normal_force", 1.0),
        &["radius is refused as an unknown: it has the causality parameter", CONTINUOUS],
    );
    for name in ["slip_state", "slip_state_value", "worn_through"] {
        let text = format!("{name} is refused as an unknown: it is discrete; only continuous outputs");
        refused(directional(name, "normal_force", 1.0), &[&text, ": tangential_force, wear_volume, "]);
    }
    refused(output("slip_state", 1), &["derivative of slip_state is refused: it is discrete", CONTINUOUS]);
    refused(directional("tangential_force", "radius", 1.0), &["radius", "with respect to inputs"]);
    refused(directional("tangential_force", "wear_depth", 1.0), &["wear_depth", "with respect to inputs"]);
    refused(directional("tangential_force", "normal_force", f64::NAN), &["normal_force = NaN"]);
    assert_eq!(fmu.set_slope("frequency", 1, -2.0), OK);
    fmu.refused(fmu.do_step(0.0, -1.0), &["communicationStepSize = -1.0"]);
    fmu.refused(fmu.do_step(0.0, 1.0), &["frequency = -1.0", ">= 0.0"]);
    assert_eq!(fmu.do_step(0.0, 0.5), OK);
}

#[test]
fn strings_that_are_null_or_not_utf8() {
    let fmu = Fmu::new();
    let vr = [reference("profile_file")];
    // SAFETY: the arrays have one element.
    unsafe {
        let status = fmi2SetString(fmu.component, vr.as_ptr(), 1, [null()].as_ptr());
        fmu.refused(status, &["profile_file", "null pointer"]);
        let status = fmi2SetString(fmu.component, vr.as_ptr(), 1, [c"tip\xff.txt".as_ptr()].as_ptr());
        fmu.refused(status, &["profile_file", "not UTF-8"]);
    }
    fmu.initialize();
    assert_eq!(fmu.get_string("profile_file"), "");
}

/// Tries to initialize with a profile file of this content, which must fail with these texts; then
/// repairs it.
fn profile_refused(content: impl AsRef<[u8]>, texts: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tip 100%s.txt");
    std::fs::write(&file, content.as_ref()).unwrap();
    let fmu = Fmu::new();
    fmu.set_integer("profile", 7);
    fmu.set_string("profile_file", &c_path(&file));
    fmu.enter_initialization();
    let status = fmu.exit_initialization();
    let mut all = vec!["fmi2ExitInitializationMode"];
    all.extend(texts);
    fmu.refused(status, &all);
    fmu.refused(fmu.get_reals(&[reference("contact_radius")], &mut [0.0]), texts);

    std::fs::write(&file, "0 0\n1e-4 5e-7\n2e-4 2e-6\n4e-4 8e-6\n").unwrap();
    fmu.set_real("normal_force", 100.0);
    assert_eq!(fmu.exit_initialization(), OK, "{:?}", fmu.messages());
    assert!(
        (fmu.real("contact_radius") / 186.626e-6 - 1.0).abs() < 0.02,
        "a sphere of 10 mm, coarsely sampled"
    );
}

fn c_path(path: &Path) -> CString {
    CString::new(path.to_str().unwrap()).unwrap()
}

#[test]
fn profile_files_that_are_no_profile() {
    let file = "tip 100%s.txt";
    profile_refused("0 0\n2e-4 2e-6\n1e-4 5e-7\n", &[file, "line 3, \"1e-4 5e-7\"", "sort"]);
    profile_refused("0 0\n1e-4 5e-7\n1e-4 6e-7\n2e-4 2e-6\n", &[file, "line 3", "twice"]);
    profile_refused("0\n1e-4\n2e-4\n", &[file, "line 1", "column"]);
    profile_refused("0 0\n1e-4 high\n2e-4 2e-6\n", &[file, "line 2", "`high` is not a number"]);
    profile_refused("0 0\n1e-4 nan\n2e-4 2e-6\n", &[file, "line 2", "NaN", "finite"]);
    profile_refused("# nothing\n", &[file, "0 point(s)"]);
    profile_refused("r f\nm m\n0 0\n1e-4 5e-7\n", &[file, "line 2, \"m m\"", "one header line"]);
    profile_refused("0 5e-6\n1e-4 4e-6\n2e-4 0\n", &[file, "line 2, \"1e-4 4e-6\"", "change the sign"]);
    profile_refused(b"\xff\xfe0\0 \x000\0\n\0", &[file, "UTF-16", "save it as text in UTF-8"]);
    profile_refused(vec![b'#'; 16_000_001], &[file, "16000001 bytes", "at most 16000000"]);
}

#[test]
fn a_profile_that_is_not_monotone_where_it_matters() {
    profile_refused(
        "0 0\n5e-5 1e-6\n1e-4 2e-7\n2e-4 2e-6\n4e-4 8e-6\n",
        &[
            "normal_force = 100.0 N",
            "not monotone",
            "it first falls at r = 5",
            "m rms off",
            "`cargo fmu profile`",
        ],
    );
}

#[test]
fn a_load_beyond_the_table() {
    let wide = "0 0\n1e-5 5e-9\n2e-5 2e-8\n";
    profile_refused(
        wide,
        &["normal_force = 100.0 N", "beyond the last point", "check the unit of the table (profile_unit)"],
    );
}

/// What can be set but not computed is refused by the step, which says what it was given.
#[test]
fn inputs_beyond_what_is_computed_with() {
    for (control, name) in [(1, "normal_force"), (2, "indentation")] {
        let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_integer("normal_control", control), OK));
        let before = fmu.bits();
        assert_eq!(fmu.set_real(name, 1e61), OK);
        assert_eq!(fmu.do_step(0.0, 0.1), DISCARD);
        let message = fmu.message();
        assert!(message.contains(&format!("{name} = 1e61")) && message.contains("1e60 at most"), "{message}");
        assert_eq!(fmu.bits(), before);
        assert_eq!(fmu.set_real(name, 1e-6), OK);
        assert_eq!(fmu.do_step(0.0, 0.1), OK);
    }
}

#[test]
fn profile_files_that_cannot_be_read() {
    let fmu = Fmu::new();
    assert_eq!(fmu.set_integer("profile", 7), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    fmu.refused(fmu.exit_initialization(), &["profile_file = \"\"", "needs a file"]);
    fmu.set_string("profile_file", c"/nowhere/tip.txt");
    fmu.refused(fmu.exit_initialization(), &["profile_file = \"/nowhere/tip.txt\"", "cannot be read"]);
    fmu.set_string("profile_file", c"no such tip.txt");
    fmu.refused(fmu.exit_initialization(), &["profile_file = \"no such tip.txt\"", "/no such tip.txt:"]);
    fmu.set_string("profile_file", c"/");
    fmu.refused(fmu.exit_initialization(), &["profile_file = \"/\"", "cannot be read"]);
    assert_eq!(fmu.set_integer("profile", 1), OK);
    assert_eq!(fmu.exit_initialization(), OK);
}

#[test]
fn a_step_that_the_model_cannot_do_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tip.txt");
    std::fs::write(&file, "0 0\n5e-5 1.25e-7\n1e-4 5e-7\n1.5e-4 1.125e-6\n2e-4 2e-6\n").unwrap();
    let fmu = Fmu::started(|fmu| {
        fmu.set_integer("profile", 7);
        fmu.set_string("profile_file", &c_path(&file));
    });
    fmu.step_with(&[("tangential_displacement", 1e-6)], 0.0, 0.1);
    let before = fmu.bits();
    assert_eq!(fmu.set_real("normal_force", 1e6), OK);
    for length in [0.1, 0.05] {
        assert_eq!(fmu.do_step(0.1, length), DISCARD);
        let message = fmu.message();
        let step = format!("step from t = 0.1 s by {length} s");
        for text in [&*step, "normal_force = 1000000.0 N", "beyond the last point", "nothing has changed"] {
            assert!(message.contains(text), "{text:?} is missing in: {message}");
        }
        assert_eq!(fmu.bits(), before);
        assert_eq!((fmu.last_successful_time(), fmu.step_status()), (0.1, DISCARD));
    }
    fmu.step_with(&[("normal_force", 90.0)], 0.1, 0.1);
    assert_ne!(fmu.bits(), before);
}
