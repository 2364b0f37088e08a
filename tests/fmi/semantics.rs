//! What values mean: the initial state, steps, derivatives of inputs, cycles, fields, saved states.

use crate::host::{DISCARD, ERROR, Fmu, OK, WARNING};
use fretting_contact::fmi2::variables::variables;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};
use std::ffi::CString;

#[test]
fn with_nothing_set_it_is_the_steel_case() {
    let fmu = Fmu::started(|_| {});
    // Hertz in six digits
    assert!((fmu.real("contact_radius") / 186.626e-6 - 1.0).abs() < 5e-6);
    assert!((fmu.real("indentation_depth") / 3.48291e-6 - 1.0).abs() < 5e-6);
    assert!((fmu.real("max_pressure") / 1.37088e9 - 1.0).abs() < 5e-6);
    assert!((fmu.real("tangential_stiffness") / 35.4673e6 - 1.0).abs() < 5e-6);
    assert_eq!(fmu.real("normal_reaction"), 100.0);
    assert_eq!((fmu.real("tangential_force"), fmu.real("wear_volume")), (0.0, 0.0));
    assert_eq!((fmu.real("stick_radius"), fmu.integer("slip_state")), (fmu.real("contact_radius"), 2));
}

#[test]
fn steps_are_those_of_the_engine() {
    let mut engine = FrettingContact::new(Parameters::default()).unwrap();
    engine.start_at(80.0, 2e-7).unwrap();
    let fmu = Fmu::started(|fmu| {
        fmu.set_real("normal_force", 80.0);
        fmu.set_real("tangential_displacement", 2e-7);
    });
    for (i, (force, displacement)) in
        [(80.0, 1e-6), (120.0, 2e-6), (60.0, -3e-6), (0.0, 0.0)].into_iter().enumerate()
    {
        engine.advance_to(force, displacement).unwrap();
        fmu.step_with(&[("normal_force", force), ("tangential_displacement", displacement)], i as f64, 1.0);
        assert_eq!(fmu.real("tangential_force"), engine.tangential_force());
        assert_eq!(fmu.real("wear_volume"), engine.wear_volume());
        assert_eq!(fmu.real("wear_depth"), engine.wear_depth());
        assert_eq!(fmu.real("dissipated_energy"), engine.dissipated_energy());
        assert_eq!(fmu.real("normal_reaction"), engine.normal_reaction());
        assert_eq!(fmu.real("indentation_depth"), engine.indentation_depth());
        assert_eq!(fmu.real("contact_radius"), engine.contact_radius());
        assert_eq!(fmu.real("stick_radius"), engine.stick_radius());
        assert_eq!(fmu.real("max_pressure"), engine.max_pressure());
        assert_eq!(fmu.real("tangential_stiffness"), engine.tangential_stiffness());
        assert_eq!(fmu.real("normal_stiffness"), engine.normal_stiffness());
        let radii = engine.probe_radii();
        for probe in [0, 20, 63] {
            let field = |name| fmu.real(&format!("{name}[{}]", probe + 1));
            assert_eq!(field("radius_probe"), radii[probe]);
            assert_eq!(field("worn_depth"), engine.worn_depth_at(radii[probe]));
            assert_eq!(field("pressure").to_bits(), engine.pressure_at(radii[probe]).to_bits());
            assert_eq!(field("shear_traction").to_bits(), engine.shear_traction_at(radii[probe]).to_bits());
            assert_eq!(field("image").to_bits(), engine.image_at(radii[probe]).to_bits());
        }
    }
}

#[test]
fn cyclic_loading_counts_cycles_by_time() {
    let mut engine = FrettingContact::new(Parameters::default()).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    engine.advance_cycles(100.0, 1.5e-6, 50.0).unwrap();
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_integer("loading", 2), OK));
    fmu.step_with(&[("displacement_amplitude", 1.5e-6), ("frequency", 100.0)], 0.0, 0.5);
    assert_eq!(fmu.real("wear_volume"), engine.wear_volume());
    assert_eq!(fmu.real("tangential_force"), engine.tangential_force());
    // A frequency that rises from 20 to 60 Hz makes 40 cycles in a second.
    engine.advance_cycles(100.0, 1.5e-6, 40.0).unwrap();
    assert_eq!(fmu.set_slope("frequency", 1, 40.0), OK);
    fmu.step_with(&[("frequency", 20.0)], 0.5, 1.0);
    assert_eq!(fmu.real("wear_volume"), engine.wear_volume());
    assert_eq!(fmu.real("frequency"), 60.0);
}

#[test]
fn indentation_control_and_other_profiles() {
    let parameters = Parameters {
        profile: Profile::RoundedPunch { radius: 0.02, flat_radius: 2e-4 },
        normal_control: NormalControl::Indentation,
        ..Parameters::default()
    };
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(2e-6, 0.0).unwrap();
    let fmu = Fmu::started(|fmu| {
        assert_eq!((fmu.set_integer("profile", 5), fmu.set_integer("normal_control", 2)), (OK, OK));
        assert_eq!((fmu.set_real("radius", 0.02), fmu.set_real("flat_radius", 2e-4)), (OK, OK));
        assert_eq!(fmu.set_real("indentation", 2e-6), OK);
    });
    assert_eq!(fmu.real("normal_reaction"), engine.normal_reaction());
    assert!(fmu.real("normal_reaction") > 0.0);
}

#[test]
fn outputs_follow_what_is_set_during_initialization() {
    let fmu = Fmu::new();
    assert_eq!(fmu.enter_initialization(), OK);
    let first = fmu.real("contact_radius");
    assert_eq!(fmu.set_real("normal_force", 800.0), OK);
    assert!((fmu.real("contact_radius") / first - 2.0).abs() < 1e-12, "a grows with the cube root of F_N");
    assert_eq!(fmu.set_real("radius", 0.08), OK);
    assert!((fmu.real("contact_radius") / first - 4.0).abs() < 1e-12, "and of R");
    assert_eq!(fmu.exit_initialization(), OK);
    let started = fmu.real("contact_radius");
    assert_eq!(fmu.set_real("normal_force", 100.0), OK);
    assert_eq!(fmu.real("contact_radius"), started, "a new input counts from the next step");
    assert_eq!(fmu.do_step(0.0, 0.0), OK);
    assert!((fmu.real("contact_radius") / started - 0.5).abs() < 1e-12, "which may have no length");
}

/// The declared dependencies at the start: what is not declared has no influence on any bit.
#[test]
fn initial_outputs_depend_on_nothing_else() {
    let perturbed = |change: &dyn Fn(&Fmu)| {
        let fmu = Fmu::new();
        assert_eq!(fmu.enter_initialization(), OK);
        // without it, wear of body 2 is refused
        assert_eq!(fmu.set_real("hardness_2", 8e9), OK);
        change(&fmu);
        fmu
    };
    let folder = tempfile::tempdir().expect("a folder for the file");
    let contacts = folder.path().join("contacts.txt");
    std::fs::write(&contacts, "0 1e-3 0\n1e-7 -1e-3 5e-4\n").expect("the file can be written");
    let contacts = CString::new(contacts.to_str().expect("a path in UTF-8")).expect("a path");
    let base = perturbed(&|_| {});
    let mut influences = 0;
    for known in variables().iter().filter(|v| matches!(v.causality(), "input" | "parameter")) {
        let fmu = perturbed(&|fmu| match (known.name, known.data_type.name()) {
            (name, "Real") => assert_eq!(fmu.set_real(name, 1.5 * base.real(name).max(1e-7)), OK),
            ("resolution", _) => assert_eq!(fmu.set_integer("resolution", 64), OK),
            (name, "Enumeration") => assert_eq!(fmu.set_integer(name, 2), OK),
            ("contacts_file", _) => assert_eq!(fmu.set_string("contacts_file", &contacts), OK),
            (name, _) => assert_eq!(fmu.set_string(name, c"tip.txt"), OK),
        });
        let outputs =
            variables().iter().filter(|v| v.causality() == "output" && v.data_type.name() == "Real");
        for output in outputs {
            let differs = fmu.real(output.name).to_bits() != base.real(output.name).to_bits();
            let declared = output.initial_dependencies.contains(&known.name);
            assert!(declared || !differs, "{} depends on {}", output.name, known.name);
            influences += usize::from(differs);
        }
    }
    assert!(influences > 30, "{influences}");
}

#[test]
fn derivatives_of_inputs_aim_at_the_end_of_the_step() {
    let (direct, sloped) = (Fmu::started(|_| {}), Fmu::started(|_| {}));
    direct.step_with(&[("normal_force", 110.0), ("tangential_displacement", 1.5e-6)], 0.0, 0.5);
    assert_eq!(sloped.set_slope("tangential_displacement", 1, 2e-6), OK);
    assert_eq!(sloped.set_slope("normal_force", 1, 20.0), OK);
    sloped.step_with(&[("normal_force", 100.0), ("tangential_displacement", 0.5e-6)], 0.0, 0.5);
    assert_eq!(sloped.bits(), direct.bits());
    // They served one step; the inputs stay where it ended.
    let (at, before) = (sloped.real("tangential_displacement"), sloped.real("tangential_force"));
    assert_eq!(at, 1.5e-6);
    assert_eq!(sloped.do_step(0.5, 0.5), OK);
    assert_eq!((sloped.real("tangential_displacement"), sloped.real("tangential_force")), (at, before));
}

#[test]
fn dissimilar_materials_are_reported_once_and_not_refused() {
    let fmu = Fmu::new();
    fmu.set_real("youngs_modulus_2", 70e9);
    fmu.set_real("poisson_ratio_2", 0.33);
    fmu.enter_initialization();
    assert!(fmu.real("contact_radius") > 0.0);
    assert_eq!(fmu.exit_initialization(), WARNING);
    let message = fmu.message();
    // 1 - (0.4·2.6/210)/(0.34·2.66/70)
    assert!(message.contains("not elastically similar") && message.contains("61.669 %"), "{message}");
    fmu.step_with(&[("tangential_displacement", 1e-6)], 0.0, 1.0);
    assert_eq!(fmu.messages(), Vec::<String>::new());
}

#[test]
fn a_saved_state_brings_everything_back() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("radius", 0.02), OK));
    fmu.step_with(&[("tangential_displacement", 2e-6)], 0.0, 1.0);
    assert_eq!(fmu.set_real("normal_force", 70.0), OK);
    assert_eq!(fmu.set_slope("tangential_displacement", 1, -3e-6), OK);
    let mut saved = fmu.save();
    let continue_from_here = |fmu: &Fmu| {
        assert_eq!(fmu.do_step(1.0, 1.0), OK, "{:?}", fmu.messages());
        fmu.step_with(&[("tangential_displacement", 4e-6)], 2.0, 1.0);
        fmu.bits()
    };
    let first = continue_from_here(&fmu);
    assert_eq!(fmu.restore(saved), OK);
    assert_eq!(continue_from_here(&fmu), first);
    // Also after a reset, when the contact has other parameters, and after the end.
    assert_eq!(fmu.reset(), OK);
    fmu.initialize();
    assert_eq!(fmu.restore(saved), OK);
    assert_eq!(fmu.real("radius"), 0.02);
    assert_eq!(continue_from_here(&fmu), first);
    assert_eq!(fmu.terminate(), OK);
    assert_eq!(fmu.restore(saved), OK);
    assert_eq!(continue_from_here(&fmu), first);

    assert_eq!(fmu.free_saved(&mut saved), OK);
    assert!(saved.is_null());
    assert_eq!(fmu.free_saved(&mut saved), OK, "null is nothing to free");
}

#[test]
fn states_can_be_saved_in_place_and_foreign_ones_are_refused() {
    let (fmu, other) = (Fmu::started(|_| {}), Fmu::started(|_| {}));
    let foreign = other.save();
    fmu.refused(fmu.restore(foreign), &["fmi2SetFMUstate", "does not belong to this instance"]);
    let mut freed = fmu.save();
    let stale = freed;
    let kept = fmu.save();
    assert_eq!(fmu.free_saved(&mut freed), OK);
    fmu.refused(fmu.restore(stale), &["has been freed"]);
    let mut twice = stale;
    fmu.refused(fmu.free_saved(&mut twice), &["has been freed"]);

    fmu.step_with(&[("tangential_displacement", 2e-6)], 0.0, 1.0);
    let after_step = fmu.bits();
    let mut handle = kept;
    // SAFETY: the component is alive, and handles are never followed.
    #[allow(unsafe_code)]
    let status = unsafe { fretting_contact::fmi2::exports::fmi2GetFMUstate(fmu.component, &raw mut handle) };
    assert_eq!((status, handle), (OK, kept), "the old state's place is used again");
    fmu.step_with(&[("tangential_displacement", -2e-6)], 1.0, 1.0);
    assert_eq!(fmu.restore(kept), OK);
    assert_eq!(fmu.bits(), after_step);
    assert_eq!(fmu.do_step(2.0, 1.0), ERROR, "time went back too");
}

#[test]
fn a_state_of_the_initialization_can_be_saved() {
    let fmu = Fmu::new();
    assert_eq!(fmu.set_real("radius", 0.05), OK);
    let saved = fmu.save();
    assert_eq!(fmu.set_real("radius", 0.06), OK);
    fmu.initialize();
    assert_eq!(fmu.restore(saved), OK);
    fmu.initialize();
    assert_eq!(fmu.real("radius"), 0.05);
}

/// Steps of no length take new inputs without moving time; with nothing new they change nothing.
#[test]
fn steps_of_no_length() {
    for loading in [1, 2] {
        let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_integer("loading", loading), OK));
        let inputs = [("tangential_displacement", 1.5e-6), ("displacement_amplitude", 1.5e-6)];
        fmu.step_with(&inputs, 0.0, 0.1);
        let before = fmu.bits();
        for _ in 0..3 {
            assert_eq!(fmu.do_step(0.1, 0.0), OK);
            assert_eq!((fmu.bits() == before, fmu.last_successful_time()), (true, 0.1));
        }
        fmu.step_with(&[("normal_force", 120.0)], 0.1, 0.0);
        assert_eq!((fmu.real("normal_reaction"), fmu.last_successful_time()), (120.0, 0.1));
    }
}

/// However a master divides its way, also below the rounding of its time, the contact ends at the
/// same place.
#[test]
fn communication_points_need_not_add_up() {
    let end = |steps: &[f64]| {
        let fmu = Fmu::new();
        assert_eq!((fmu.setup(-0.3, Some(0.0)), fmu.enter_initialization()), (OK, OK));
        assert_eq!((fmu.set_real("wear_coefficient", 0.0), fmu.exit_initialization()), (OK, OK));
        let mut time = -0.3;
        for step in steps {
            let target = 1e-6 * (time + step + 0.3) / 0.3;
            assert_eq!(fmu.set_real("tangential_displacement", target), OK);
            assert_eq!(fmu.do_step(time, *step), OK, "{:?}", fmu.messages());
            time += step;
        }
        assert!(fmu.last_successful_time().abs() < 1e-15);
        // the stop time is where it was, whatever the sum
        assert_eq!(fmu.do_step(0.0, 1e-3), ERROR);
        fmu.real("tangential_force")
    };
    let whole = end(&[0.3]);
    for steps in [&[0.1, 0.1, 0.1][..], &[0.3 / 7.0; 7], &[0.2999999999, 1e-10], &[0.0, 0.15, 0.0, 0.15, 0.0]]
    {
        assert!((end(steps) / whole - 1.0).abs() < 1e-12, "{steps:?}");
    }
}

#[test]
fn tunable_parameters_count_from_the_next_step() {
    let mut engine = FrettingContact::new(Parameters::default()).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    let fmu = Fmu::started(|_| {});
    engine.advance_to(100.0, 3e-6).unwrap();
    fmu.step_with(&[("tangential_displacement", 3e-6)], 0.0, 1.0);
    let before = fmu.bits();
    assert_eq!((fmu.set_real("friction_coefficient", 0.3), fmu.set_real("wear_coefficient", 1e-3)), (OK, OK));
    assert_eq!((fmu.bits(), fmu.real("friction_coefficient")), (before.clone(), 0.3));
    // the change is part of a state
    let (saved, other) = (fmu.save(), Fmu::new());
    let (copy, status) = other.deserialized(&fmu.serialized(saved));
    assert_eq!((status, other.restore(copy)), (OK, OK), "{:?}", other.messages());
    // a step that cannot be done leaves all as it was
    assert_eq!(fmu.set_real("tangential_displacement", f64::MAX), OK);
    assert_eq!((fmu.do_step(1.0, 1.0), fmu.bits()), (DISCARD, before));
    fmu.messages();

    engine.retune(0.3, 1e-3).unwrap();
    engine.advance_to(100.0, 2.9e-6).unwrap();
    for fmu in [&fmu, &other] {
        fmu.step_with(&[("tangential_displacement", 2.9e-6)], 1.0, 1.0);
        assert_eq!(fmu.real("tangential_force"), engine.tangential_force());
        assert_eq!(fmu.real("wear_volume"), engine.wear_volume());
        assert!(fmu.real("tangential_force") < 30.0 * (1.0 + 1e-12));
    }
    assert_eq!(fmu.bits(), other.bits());
    let reason = fmu.message();
    assert!(reason.contains("energy_density"), "two ratios: {reason}");
    for (name, texts) in [
        ("wear_coefficient", ["wear_coefficient = 0.0", "on or off"]),
        ("friction_coefficient", ["friction_coefficient = 0.0", "on or off"]),
        ("hardness", ["hardness = 0.0", "fixed after initialization"]),
    ] {
        fmu.refused(fmu.set_real(name, 0.0), &texts);
    }
    // back to the state in which they had only been set
    assert_eq!(fmu.restore(saved), OK);
    fmu.step_with(&[("tangential_displacement", 2.9e-6)], 1.0, 1.0);
    assert_eq!(fmu.bits(), other.bits());
}
