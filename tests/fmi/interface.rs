//! Several contacts in one instance: `contacts_file`.
#![cfg(feature = "fmi2")]

use crate::bodies::boolean;
use crate::counting::live_bytes;
use crate::host::{DISCARD, ERROR, Fmu, OK, reference};
use fretting_contact::{Interface, LengthUnit, Parameters, Profile, Summit};
use std::ffi::CString;

const TABLE: &str = "offset x y factor\n0 1000 0 1\n0.5 -1000 500 2\n40 0 -1000 1\n";

/// A file with some text that ends with the test.
struct File(tempfile::TempDir);

impl File {
    fn with(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("contacts.txt"), text).unwrap();
        Self(folder)
    }

    fn path(&self) -> CString {
        CString::new(self.0.path().join("contacts.txt").to_str().unwrap()).unwrap()
    }
}

/// An instance with the contacts of a file in µm.
fn with_contacts(file: &File, set: impl Fn(&Fmu)) -> Fmu {
    Fmu::started(|fmu| {
        assert_eq!(fmu.set_string("contacts_file", &file.path()), OK);
        assert_eq!(fmu.set_integer("profile_unit", 3), OK);
        set(fmu);
    })
}

#[test]
fn a_rotation_wears_a_coating_through() {
    let file = File::with(TABLE);
    for (angle, worn_through) in [(0.0, false), (0.015, true)] {
        let fmu = with_contacts(&file, |fmu| {
            for (name, value) in [("wear_coefficient", 3e-2), ("coating_thickness", 2e-9)] {
                assert_eq!(fmu.set_real(name, value), OK);
            }
        });
        for k in 1..=20 {
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            fmu.step_with(&[("normal_force", 100.0), ("rotation", side * angle)], f64::from(k - 1), 1.0);
        }
        assert_eq!(boolean(&fmu, "worn_through"), worn_through, "rotation of {angle}");
        assert_eq!(fmu.real("worn_through_time") > 0.0, worn_through, "rotation of {angle}");
    }
}

#[test]
fn outputs_are_those_of_the_interface() {
    let file = File::with(TABLE);
    let fmu = with_contacts(&file, |fmu| assert_eq!(fmu.set_real("wear_coefficient", 3.2e-2), OK));
    let summits = Summit::parse(TABLE, LengthUnit::Um).unwrap();
    let mut joint =
        Interface::new(Parameters { wear_coefficient: 3.2e-2, ..Parameters::default() }, &summits).unwrap();
    joint.start_at(100.0, [0.0; 2], 0.0).unwrap();
    for k in 1..=200 {
        let phase = 0.1 * f64::from(k);
        let inputs = [100.0 + 20.0 * phase.cos(), 2e-6 * phase.sin(), 0.0, 2e-4 * (0.3 * phase).sin()];
        let names = ["normal_force", "tangential_displacement", "tangential_displacement_y", "rotation"];
        assert_eq!(fmu.set_reals(&names.map(reference), &inputs), OK);
        assert_eq!(fmu.do_step(f64::from(k - 1), 1.0), OK);
        joint.advance_to(inputs[0], [inputs[1], 0.0], inputs[3]).unwrap();
    }
    type Read = (&'static str, fn(&Interface) -> f64);
    let outputs: [Read; 13] = [
        ("tangential_force", Interface::tangential_force),
        ("tangential_force_y", Interface::tangential_force_y),
        ("moment", Interface::moment),
        ("normal_reaction", Interface::normal_reaction),
        ("indentation_depth", Interface::indentation_depth),
        ("wear_volume", Interface::wear_volume),
        ("wear_depth", Interface::wear_depth),
        ("dissipated_energy", Interface::dissipated_energy),
        ("normal_stiffness", Interface::normal_stiffness),
        ("tangential_stiffness", Interface::tangential_stiffness),
        ("contact_displacement", Interface::displacement),
        ("contact_radius", |joint| joint.read_deepest(|contact| contact.contact_radius())),
        ("worn_depth[32]", |joint| {
            joint.read_deepest(|contact| contact.worn_depth_at(contact.probe_radii()[31]))
        }),
    ];
    for (name, read) in outputs {
        assert_eq!(fmu.real(name).to_bits(), read(&joint).to_bits(), "{name}");
    }
    assert_eq!(fmu.integer("contact_count_in_touch"), 2);
    assert_eq!(fmu.integer("deepest_contact"), joint.deepest_contact() as i32 + 1);
}

/// The coefficient of the contacts is their mean by normal force, and a saved state has it.
#[test]
fn friction_runs_in_at_each_contact() {
    let file = File::with(TABLE);
    let fmu = with_contacts(&file, |fmu| {
        for (name, value) in
            [("friction_coefficient", 0.2), ("friction_coefficient_final", 0.8), ("running_in_energy", 1e-4)]
        {
            assert_eq!(fmu.set_real(name, value), OK);
        }
    });
    let parameters = Parameters {
        friction_coefficient: 0.2,
        friction_coefficient_final: 0.8,
        running_in_energy: 1e-4,
        ..Parameters::default()
    };
    let mut joint = Interface::new(parameters, &Summit::parse(TABLE, LengthUnit::Um).unwrap()).unwrap();
    joint.start_at(100.0, [0.0; 2], 0.0).unwrap();
    let mut step = |time: f64, displacement: f64| {
        fmu.step_with(&[("tangential_displacement", displacement)], time, 1.0);
        joint.advance_to(100.0, [displacement, 0.0], 0.0).unwrap();
        let now = fmu.real("friction_coefficient_now");
        assert_eq!(now.to_bits(), joint.friction_coefficient_now().to_bits());
        assert_eq!(fmu.real("tangential_force").to_bits(), joint.tangential_force().to_bits());
        now
    };
    assert!(step(0.0, 8e-6) > 0.2);
    let now = step(1.0, -4e-6);
    let mut saved = fmu.save();
    assert!(step(2.0, 8e-6) > now);
    assert_eq!(fmu.restore(saved), OK);
    assert_eq!(fmu.real("friction_coefficient_now"), now);
    assert_eq!(fmu.free_saved(&mut saved), OK);
}

/// What the contacts hold between two steps that wear: counted, not estimated.
#[test]
fn worn_contacts_hold_little_memory() {
    let summits: Vec<_> = (0..20).map(|k| Summit::at_offset(5e-8 * f64::from(k))).collect();
    let parameters = Parameters {
        profile: Profile::Parabola { radius: 1e-4 },
        wear_coefficient: 3.2e-4,
        resolution: 16,
        ..Parameters::default()
    };
    let mut joint = Interface::new(parameters, &summits).unwrap();
    let before = live_bytes();
    for k in 0..3000 {
        let phase = 0.0628 * f64::from(k);
        joint.advance_to(2.0 + 0.6 * (0.7 * phase).cos(), [0.6e-6 * phase.sin(), 0.0], 0.0).unwrap();
    }
    let touched = (0..20).filter(|index| joint.contact(*index).is_some()).count() as i64;
    assert!(touched > 10 && joint.counters().profile_updates > 50, "{}", joint.counters());
    let bytes = (live_bytes() - before) / touched;
    assert!(bytes < 4300, "{bytes} bytes of each of {touched} contacts");
}

/// The first coating to wear through, at its cycle and time.
#[test]
fn a_coating_of_several_contacts_wears_through() {
    let file = File::with(TABLE);
    let parameters =
        Parameters { wear_coefficient: 0.01, coating_thickness: 0.3e-6, ..Parameters::default() };
    let mut joint = Interface::new(parameters, &Summit::parse(TABLE, LengthUnit::Um).unwrap()).unwrap();
    joint.start_at(100.0, [0.0; 2], 0.0).unwrap();
    joint.advance_cycles(100.0, 1.5e-6, 10.0).unwrap();
    joint.advance_cycles(100.0, 1.5e-6, 5e4).unwrap();
    let fmu = with_contacts(&file, |fmu| {
        assert_eq!(fmu.set_real("wear_coefficient", 0.01), OK);
        assert_eq!(fmu.set_real("coating_thickness", 0.3e-6), OK);
        assert_eq!(fmu.set_integer("loading", 2), OK);
    });
    fmu.step_with(&[("displacement_amplitude", 1.5e-6), ("frequency", 10.0)], 0.0, 1.0);
    assert_eq!((fmu.real("worn_through_time"), fmu.real("cycles_to_wear_through")), (0.0, 0.0));
    fmu.step_with(&[], 1.0, 5000.0);
    let life = joint.cycles_to_wear_through().unwrap();
    assert_eq!(fmu.real("cycles_to_wear_through"), life);
    assert!((fmu.real("worn_through_time") - life / 10.0).abs() < 1e-9 * life);
    assert!(boolean(&fmu, "worn_through"));
}

/// Of several contacts as of one: not known without wear, and the message says how it is.
#[test]
fn work_per_area_is_read_with_next_to_no_wear() {
    let file = File::with(TABLE);
    for coefficient in [0.0, 1e-12] {
        let fmu = with_contacts(&file, |fmu| assert_eq!(fmu.set_real("wear_coefficient", coefficient), OK));
        fmu.step_with(&[("normal_force", 100.0), ("tangential_displacement", 2e-6)], 0.0, 1.0);
        assert_eq!(fmu.real("energy_density[60]") > 0.0, coefficient > 0.0);
        if coefficient == 0.0 {
            let message = fmu.message();
            assert!(message.contains("wear_coefficient = 1e-12"), "{message}");
        }
        assert!(fmu.messages().is_empty());
    }
}

#[test]
fn one_contact_has_no_moment_and_is_the_first() {
    let fmu = Fmu::started(|_| {});
    assert_eq!(fmu.set_real("rotation", 1e-3), OK);
    assert_eq!(fmu.do_step(0.0, 1.0), OK);
    assert_eq!(fmu.real("moment"), 0.0);
    assert_eq!((fmu.integer("contact_count_in_touch"), fmu.integer("deepest_contact")), (1, 1));
}

#[test]
fn derivatives_are_those_of_differences() {
    let file = File::with(TABLE);
    let fmu = with_contacts(&file, |fmu| assert_eq!(fmu.set_integer("resolution", 512), OK));
    let inputs = ["tangential_displacement", "rotation"].map(reference);
    let go = |values: [f64; 2], time: f64| {
        assert_eq!(fmu.set_reals(&inputs, &values), OK);
        assert_eq!(fmu.do_step(time, 1.0), OK);
    };
    go([0.5e-6, 1e-4], 0.0);
    let outputs = ["moment", "tangential_force", "tangential_force_y"];
    let (derivatives, status) = fmu.directional(&outputs, &[("rotation", 1.0)]);
    assert_eq!(status, OK);
    let saved = fmu.save();
    // the law is that of going on as before
    let after = |more: f64| {
        assert_eq!(fmu.restore(saved), OK);
        go([0.5005e-6, 1.001e-4 + more], 1.0);
        outputs.map(|name| fmu.real(name))
    };
    let (base, moved) = (after(0.0), after(1e-8));
    for (k, derivative) in derivatives.into_iter().enumerate() {
        let difference = (moved[k] - base[k]) / 1e-8;
        let allowed = 2e-2 * derivative.abs() + base[k].abs();
        assert!((difference - derivative).abs() < allowed, "{}: {difference} {derivative}", outputs[k]);
    }
}

#[test]
fn states_are_saved_as_bytes_too() {
    let file = File::with(TABLE);
    let run = |fmu: &Fmu, steps: std::ops::Range<u32>| {
        for k in steps {
            let phase = 0.1 * f64::from(k);
            assert_eq!(fmu.set_real("tangential_displacement", 2e-6 * phase.sin()), OK);
            assert_eq!(fmu.do_step(f64::from(k), 1.0), OK);
        }
    };
    let start = || with_contacts(&file, |fmu| assert_eq!(fmu.set_real("wear_coefficient", 3.2e-2), OK));
    let fmu = start();
    run(&fmu, 0..100);
    let saved = fmu.save();
    let bytes = fmu.serialized(saved);
    run(&fmu, 100..200);
    let end = fmu.real("wear_volume");
    assert_eq!(fmu.restore(saved), OK);
    run(&fmu, 100..200);
    assert_eq!(fmu.real("wear_volume").to_bits(), end.to_bits());
    let other = start();
    let (taken, status) = other.deserialized(&bytes);
    assert_eq!(status, OK);
    assert_eq!(other.restore(taken), OK);
    run(&other, 100..200);
    assert_eq!(other.real("wear_volume").to_bits(), end.to_bits());
}

#[test]
fn cycles_beds_the_contacts_in() {
    let file = File::with("0\n0.5\n1\n");
    let fmu = with_contacts(&file, |fmu| {
        assert_eq!(fmu.set_integer("loading", 2), OK);
        assert_eq!(fmu.set_real("displacement_amplitude", 1e-6), OK);
        assert_eq!(fmu.set_real("wear_coefficient", 3.2e-2), OK);
    });
    let before = fmu.integer("contact_count_in_touch");
    assert_eq!(fmu.do_step(0.0, 1000.0), OK);
    assert!((fmu.real("normal_reaction") - 100.0).abs() < 1e-3);
    assert!(fmu.real("wear_depth") > 1e-8 && fmu.integer("contact_count_in_touch") >= before);
    let per_work = 3.2e-2 / 8e9;
    assert!((fmu.real("wear_volume") / (per_work * fmu.real("dissipated_energy")) - 1.0).abs() < 1e-12);
}

/// Files that are not valid are refused with the file, the line, the value and what is allowed.
#[test]
fn bad_files_are_refused_with_their_line() {
    for (text, parts) in [
        ("0\nhigh\n", ["line 2, \"high\"", "give it in um"]),
        ("0 1\n", ["line 1, \"0 1\"", "1, 3 or 4 are allowed"]),
        ("0 0 0 0\n", ["line 1, \"0 0 0 0\"", "radius factor = 0.0: it lies in 1e-30 to 1e30"]),
        ("", ["the whole table", "it has no contact"]),
    ] {
        let file = File::with(text);
        let fmu = Fmu::new();
        assert_eq!(fmu.set_string("contacts_file", &file.path()), OK);
        assert_eq!(fmu.set_integer("profile_unit", 3), OK);
        let _ = fmu.enter_initialization();
        assert_eq!(fmu.exit_initialization(), ERROR, "{text:?}");
        let messages = fmu.messages().join("\n");
        assert!(messages.contains("contacts_file = "), "{messages}");
        assert!(parts.iter().all(|part| messages.contains(part)), "{text:?}: {messages}");
    }
    let fmu = Fmu::new();
    assert_eq!(fmu.set_string("contacts_file", c"nowhere.txt"), OK);
    let _ = fmu.enter_initialization();
    assert_eq!(fmu.exit_initialization(), ERROR);
    assert!(fmu.messages().join("\n").contains("contacts_file = \"nowhere.txt\" cannot be read"));
}

#[test]
fn a_rig_and_a_step_that_cannot_be_done_are_refused() {
    let file = File::with(TABLE);
    let fmu = Fmu::new();
    assert_eq!(fmu.set_string("contacts_file", &file.path()), OK);
    assert_eq!(fmu.set_real("rig_stiffness", 1e7), OK);
    let _ = fmu.enter_initialization();
    assert_eq!(fmu.exit_initialization(), ERROR);
    assert!(fmu.messages().join("\n").contains("rig_stiffness = 10000000.0 is not allowed"));
    let fmu = with_contacts(&file, |_| {});
    let force = fmu.real("tangential_force");
    assert_eq!(fmu.set_real("tangential_displacement", 1e70), OK);
    assert_eq!(fmu.do_step(0.0, 1.0), DISCARD);
    assert_eq!(fmu.real("tangential_force"), force);
}
