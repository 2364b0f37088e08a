//! A spring in series with the contact, through the C interface.

use crate::host::{Fmu, OK};
use fretting_contact::{FrettingContact, Parameters};

const RIG: f64 = 2e7;

fn engine() -> FrettingContact {
    let mut engine =
        FrettingContact::new(Parameters { rig_stiffness: RIG, ..Parameters::default() }).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    engine
}

fn behind_a_rig(loading: i32) -> Fmu {
    Fmu::started(|fmu| {
        assert_eq!(fmu.set_real("rig_stiffness", RIG), OK);
        assert_eq!(fmu.set_integer("loading", loading), OK);
    })
}

/// T of a ball on the first loading, U in u_max: μF_N (1 − (1 − θ)^1.5), and on the way back from
/// θ₀.
fn mindlin(theta: f64) -> f64 {
    60.0 * (1.0 - (1.0 - theta).powf(1.5))
}

fn back(from: f64, theta: f64) -> f64 {
    mindlin(from) - 2.0 * mindlin(0.5 * (from - theta))
}

#[test]
fn the_drive_is_given_and_the_contact_follows() {
    let full_slip = 2.537_551e-6;
    let fmu = behind_a_rig(1);
    let mut engine = engine();
    let path = [(0.3, mindlin(0.3)), (0.8, mindlin(0.8)), (0.1, back(0.8, 0.1)), (-0.8, -mindlin(0.8))];
    for (k, (theta, force)) in path.into_iter().enumerate() {
        let drive = theta * full_slip + force / RIG;
        fmu.step_with(&[("tangential_displacement", drive)], k as f64, 1.0);
        engine.advance_to(100.0, drive).unwrap();
        assert!((fmu.real("tangential_force") - force).abs() < 1e-4, "T at {theta}");
        assert!((fmu.real("contact_displacement") - theta * full_slip).abs() < 1e-11, "U at {theta}");
        assert_eq!(fmu.real("tangential_force"), engine.tangential_force());
        assert_eq!(fmu.real("contact_displacement"), engine.displacement());
        // wear has not been taken off the profile yet: k is that of the contact alone
        let k = fmu.real("tangential_stiffness");
        let (by_drive, status) = fmu
            .directional(&["tangential_force", "contact_displacement"], &[("tangential_displacement", 1.0)]);
        assert_eq!(status, OK);
        assert!((by_drive[0] / (k * RIG / (k + RIG)) - 1.0).abs() < 1e-9, "dT/dD at {theta}");
        assert!((by_drive[1] / (RIG / (k + RIG)) - 1.0).abs() < 1e-9, "dU/dD at {theta}");
    }
}

#[test]
fn a_step_taken_back_and_repeated_is_the_same() {
    let fmu = behind_a_rig(1);
    fmu.step_with(&[("tangential_displacement", 3e-6)], 0.0, 1.0);
    let mut saved = fmu.save();
    let mut seen = Vec::new();
    for _ in 0..2 {
        fmu.step_with(&[("tangential_displacement", -2e-6), ("normal_force", 60.0)], 1.0, 1.0);
        seen.push([fmu.real("tangential_force"), fmu.real("contact_displacement"), fmu.real("wear_volume")]);
        assert_eq!(fmu.restore(saved), OK);
    }
    assert_eq!(seen[0], seen[1]);
    assert_eq!(fmu.free_saved(&mut saved), OK);
}

#[test]
fn cycles_are_those_of_the_drive() {
    let fmu = behind_a_rig(2);
    let mut engine = engine();
    fmu.step_with(&[("displacement_amplitude", 3e-6), ("frequency", 1000.0)], 0.0, 10.0);
    engine.advance_cycles(100.0, 3e-6, 1e4).unwrap();
    for (name, value) in [
        ("tangential_force", engine.tangential_force()),
        ("wear_volume", engine.wear_volume()),
        ("contact_displacement", engine.displacement()),
    ] {
        assert_eq!(fmu.real(name), value, "{name}");
    }
    let drive = fmu.real("contact_displacement") + fmu.real("tangential_force") / RIG;
    assert!((drive / 3e-6 - 1.0).abs() < 1e-12, "{drive:e}");
}

#[test]
fn a_rig_may_be_rigid_and_nothing_less_than_a_spring() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("rig_stiffness", f64::INFINITY), OK));
    fmu.step_with(&[("tangential_displacement", 1e-6)], 0.0, 1.0);
    assert_eq!(fmu.real("contact_displacement"), 1e-6);
    assert_eq!(fmu.real("rig_stiffness"), f64::INFINITY);
    for value in [0.0, -1e7, f64::NAN] {
        let fmu = Fmu::new();
        fmu.refused(fmu.set_real("rig_stiffness", value), &["rig_stiffness", "give a number >= 1e-60"]);
    }
}
