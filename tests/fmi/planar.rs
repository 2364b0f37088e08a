//! Both tangential directions through the C interface.

use crate::host::{Fmu, OK};
use fretting_contact::{FrettingContact, Parameters};
use std::f64::consts::TAU;

const X: &str = "tangential_displacement";
const Y: &str = "tangential_displacement_y";
const FORCES: [&str; 2] = ["tangential_force", "tangential_force_y"];

fn engine(parameters: Parameters) -> FrettingContact {
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    engine
}

fn force(fmu: &Fmu) -> [f64; 2] {
    FORCES.map(|name| fmu.real(name))
}

/// The FMU gives what the engine does, step by step, with wear.
#[test]
fn an_orbit_is_that_of_the_engine() {
    let fmu = Fmu::started(|_| {});
    let mut engine = engine(Parameters::default());
    for k in 1..=80 {
        let phase = TAU * f64::from(k) / 40.0;
        let place = [1.5e-6 * phase.sin(), 1e-6 * (1.0 - phase.cos())];
        fmu.step_with(&[(X, place[0]), (Y, place[1])], f64::from(k - 1), 1.0);
        engine.advance_to_planar(100.0, place).unwrap();
        assert_eq!(force(&fmu), [engine.tangential_force(), engine.tangential_force_y()]);
        assert_eq!(fmu.real("wear_volume"), engine.wear_volume());
        assert_eq!(fmu.real("worn_depth[30]"), engine.worn_depth_at(engine.probe_radii()[29]));
        assert!(force(&fmu)[0].hypot(force(&fmu)[1]) <= 60.0 * (1.0 + 1e-12));
    }
}

/// A straight line at 30° is the line along x: T of a ball on the first loading, μF_N (1 − (1 −
/// θ)^1.5).
#[test]
fn a_line_at_an_angle_has_the_closed_form() {
    let fmu = Fmu::started(|_| {});
    let full_slip = 2.537_551e-6;
    for (k, theta) in [0.25, 0.5, 0.75, 1.2].into_iter().enumerate() {
        let [x, y] = [0.75f64.sqrt(), 0.5].map(|part| part * theta * full_slip);
        fmu.step_with(&[(X, x), (Y, y)], k as f64, 1.0);
        let size = 60.0 * (1.0 - (1.0f64 - theta).max(0.0).powf(1.5));
        let found = force(&fmu);
        for (found, part) in found.into_iter().zip([0.75f64.sqrt(), 0.5]) {
            // 128 samples
            assert!((found - part * size).abs() < 2e-4 * 60.0, "{theta}: {found} {}", part * size);
        }
    }
}

/// Where the body starts on y costs nothing, and the force is that of the motion from there.
#[test]
fn a_contact_may_be_pressed_on_anywhere() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real(Y, 5e-3), OK));
    assert_eq!(force(&fmu), [0.0, 0.0]);
    fmu.step_with(&[(X, 1e-6)], 0.0, 1.0);
    let along_x = force(&fmu);
    assert!((along_x[0] - 31.70).abs() < 0.01 && along_x[1] == 0.0, "{along_x:?}");
}

/// The four derivatives of the force by displacement, and those by the load, are those of
/// differences.
#[test]
fn directional_derivatives_are_a_matrix() {
    let fmu = Fmu::started(|fmu| {
        assert_eq!(fmu.set_real("wear_coefficient", 0.0), OK);
        assert_eq!(fmu.set_integer("resolution", 512), OK);
    });
    fmu.step_with(&[(X, 8e-7)], 0.0, 1.0);
    fmu.step_with(&[(X, 1.2e-6), (Y, 7e-7)], 1.0, 1.0);
    let mut saved = fmu.save();
    // on along the last direction, which the derivatives belong to, and a little aside of it
    for (direction, inputs) in [
        ([4e-11, 7e-11, 0.0], "on"),
        ([7e-11, 7e-11, 0.0], "aside"),
        ([4e-11, 7e-11, -1e-3], "with a load that falls"),
    ] {
        let seed = [(X, direction[0]), (Y, direction[1]), ("normal_force", direction[2])];
        let (by_inputs, status) = fmu.directional(&FORCES, &seed);
        assert_eq!(status, OK);
        let before = force(&fmu);
        let end =
            [(X, 1.2e-6 + direction[0]), (Y, 7e-7 + direction[1]), ("normal_force", 100.0 + direction[2])];
        fmu.step_with(&end, 2.0, 1.0);
        let after = force(&fmu);
        for k in 0..2 {
            let change = after[k] - before[k];
            let size = by_inputs[0].hypot(by_inputs[1]);
            assert!((change - by_inputs[k]).abs() < 0.01 * size, "{inputs}: {change:e} {by_inputs:?}");
        }
        assert_eq!(fmu.restore(saved), OK);
    }
    assert_eq!(fmu.free_saved(&mut saved), OK);
}

/// A slope of the input leads to the same place as its value; the output has one, too.
#[test]
fn the_input_may_be_given_by_its_slope() {
    let (by_value, by_slope) = (Fmu::started(|_| {}), Fmu::started(|_| {}));
    by_value.step_with(&[(Y, 1e-6)], 0.0, 0.5);
    assert_eq!(by_slope.set_slope(Y, 1, 2e-6), OK);
    assert_eq!(by_slope.do_step(0.0, 0.5), OK);
    assert_eq!(by_value.real(FORCES[1]).to_bits(), by_slope.real(FORCES[1]).to_bits());
    let (slope, status) = by_slope.output_slope(FORCES[1], 1);
    assert_eq!(status, OK);
    assert!(slope > 0.0);
    let (by_place, _) = by_slope.directional(&[FORCES[1]], &[(Y, 2e-6)]);
    assert_eq!(slope, by_place[0]);
}

/// A state saved during an orbit continues bit for bit, in this instance and, as bytes, in another.
#[test]
fn a_saved_orbit_goes_on_with_the_same_bits() {
    let (fmu, other) = (Fmu::started(|_| {}), Fmu::started(|_| {}));
    let orbit = |fmu: &Fmu, from: u32| {
        for k in from..from + 25 {
            let phase = 0.2 * f64::from(k);
            fmu.step_with(&[(X, 2e-6 * phase.sin()), (Y, 2e-6 * phase.cos())], f64::from(k), 1.0);
        }
    };
    orbit(&fmu, 0);
    let mut saved = fmu.save();
    let bytes = fmu.serialized(saved);
    orbit(&fmu, 25);
    let expected = fmu.bits();
    assert_eq!(fmu.restore(saved), OK);
    orbit(&fmu, 25);
    assert_eq!(fmu.bits(), expected);
    let (mut taken, status) = other.deserialized(&bytes);
    assert_eq!(status, OK);
    assert_eq!(other.restore(taken), OK);
    orbit(&other, 25);
    assert_eq!(other.bits(), expected);
    assert_eq!((fmu.free_saved(&mut saved), other.free_saved(&mut taken)), (OK, OK));
}

/// Behind a rig both displacements are the drive's: forces, places of the contact and derivatives
/// are those of the engine, and a step taken back is the same again.
#[test]
fn behind_a_rig_the_drive_is_given_in_both_directions() {
    const RIG: f64 = 2e7;
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("rig_stiffness", RIG), OK));
    let mut engine = engine(Parameters { rig_stiffness: RIG, ..Parameters::default() });
    for k in 1..=40 {
        let phase = TAU * f64::from(k) / 20.0;
        let place = [4e-6 * phase.sin(), 3e-6 * (1.0 - phase.cos())];
        let mut saved = fmu.save();
        for _ in 0..2 {
            assert_eq!(fmu.restore(saved), OK);
            fmu.step_with(&[(X, place[0]), (Y, place[1])], f64::from(k - 1), 1.0);
        }
        assert_eq!(fmu.free_saved(&mut saved), OK);
        engine.advance_to_planar(100.0, place).unwrap();
        assert_eq!(force(&fmu), [engine.tangential_force(), engine.tangential_force_y()]);
        let own = ["contact_displacement", "contact_displacement_y"].map(|name| fmu.real(name));
        assert_eq!(own, [engine.displacement(), engine.displacement_y()]);
        for i in 0..2 {
            assert!((own[i] + force(&fmu)[i] / RIG - place[i]).abs() < 2e-3 * 4e-6, "the drive, {k}");
        }
        let (by_y, status) = fmu.directional(&[FORCES[1], "contact_displacement_y"], &[(Y, 1.0)]);
        assert_eq!(status, OK);
        // what the drive brings is in the contact or in the rig
        assert!((by_y[1] + by_y[0] / RIG - 1.0).abs() < 1e-9, "{by_y:?}");
    }
}

/// In cyclic loading the displacements have no meaning, along y no more than along x.
#[test]
fn cyclic_loading_leaves_displacements_out() {
    let run = |place: f64| {
        let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_integer("loading", 2), OK));
        fmu.step_with(
            &[("displacement_amplitude", 1e-6), ("frequency", 100.0), (X, place), (Y, place)],
            0.0,
            1.0,
        );
        assert_eq!(fmu.real(FORCES[1]), 0.0);
        [fmu.real(FORCES[0]), fmu.real("wear_volume")]
    };
    assert_eq!(run(0.0), run(3e-6));
}
