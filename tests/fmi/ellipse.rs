//! An elliptic contact through the C interface.
#![cfg(feature = "fmi2")]

use crate::host::{Fmu, OK};
use fretting_contact::{FrettingContact, Parameters, Profile};

/// Number of `ellipse` among the profiles.
const ELLIPSE: i32 = 8;

fn engine() -> FrettingContact {
    let profile = Profile::Ellipse { radius_x: 0.13, radius_y: 0.004 };
    let mut engine =
        FrettingContact::new(Parameters { profile, wear_coefficient: 0.0, ..Parameters::default() }).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    engine
}

fn elliptic(loading: i32) -> Fmu {
    Fmu::started(|fmu| set(fmu, loading))
}

fn set(fmu: &Fmu, loading: i32) {
    assert_eq!(fmu.set_integer("profile", ELLIPSE), OK);
    for (name, value) in [("radius_x", 0.13), ("radius_y", 0.004), ("wear_coefficient", 0.0)] {
        assert_eq!(fmu.set_real(name, value), OK);
    }
    assert_eq!(fmu.set_integer("loading", loading), OK);
}

const OUTPUTS: [&str; 10] = [
    "tangential_force",
    "tangential_force_y",
    "dissipated_energy",
    "contact_radius",
    "stick_radius",
    "max_pressure",
    "contact_semi_axis_x",
    "contact_semi_axis_y",
    "tangential_stiffness",
    "pressure[9]",
];

fn outputs(fmu: &Fmu) -> [f64; 10] {
    OUTPUTS.map(|name| fmu.real(name))
}

fn readings(engine: &FrettingContact) -> [f64; 10] {
    let [a, b] = engine.contact_semi_axes();
    [
        engine.tangential_force(),
        engine.tangential_force_y(),
        engine.dissipated_energy(),
        engine.contact_radius(),
        engine.stick_radius(),
        engine.max_pressure(),
        a,
        b,
        engine.tangential_stiffness(),
        engine.pressure_at(engine.probe_radii()[8]),
    ]
}

#[test]
fn the_fmu_is_the_engine() {
    let (fmu, mut engine) = (elliptic(1), engine());
    assert_eq!(outputs(&fmu), readings(&engine));
    for (k, (force, x, y)) in
        [(100.0, 8e-7, 0.0), (100.0, -2e-7, 0.0), (90.0, -4e-7, 5e-7), (-1.0, 0.0, 0.0), (50.0, 1e-7, 1e-6)]
            .into_iter()
            .enumerate()
    {
        let inputs =
            [("normal_force", force), ("tangential_displacement", x), ("tangential_displacement_y", y)];
        fmu.step_with(&inputs, k as f64, 1.0);
        engine.advance_to_planar(force, [x, y]).unwrap();
        assert_eq!(outputs(&fmu), readings(&engine), "step {k}");
    }
    let fmu = elliptic(2);
    fmu.step_with(&[("displacement_amplitude", 3e-7), ("frequency", 1000.0)], 0.0, 10.0);
    let mut cycles = self::engine();
    cycles.advance_cycles(100.0, 3e-7, 1e4).unwrap();
    assert_eq!(outputs(&fmu), readings(&cycles));
}

/// For a body of revolution both semi-axes are the contact radius.
#[test]
fn a_ball_has_two_equal_semi_axes() {
    let fmu = Fmu::started(|_| {});
    for name in ["contact_semi_axis_x", "contact_semi_axis_y"] {
        assert_eq!(fmu.real(name), fmu.real("contact_radius"));
    }
}

#[test]
fn the_directional_derivatives_are_those_of_both_axes() {
    let fmu = elliptic(1);
    let known = [("tangential_displacement", 1.0), ("tangential_displacement_y", 0.0)];
    let (stuck_x, status) = fmu.directional(&["tangential_force"], &known[..1]);
    assert_eq!(status, OK);
    let (stuck_y, _) = fmu.directional(&["tangential_force_y"], &[("tangential_displacement_y", 1.0)]);
    let [along_x, along_y] = engine().tangential_moduli();
    assert!((stuck_y[0] / stuck_x[0] / (along_y / along_x) - 1.0).abs() < 1e-12);
    // semi-axes grow with the cube root of the force
    let names = ["contact_semi_axis_x", "contact_semi_axis_y"];
    let (by_force, _) = fmu.directional(&names, &[("normal_force", 1.0)]);
    for (name, rate) in names.into_iter().zip(by_force) {
        assert!((rate / (fmu.real(name) / 300.0) - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn a_saved_state_goes_on_with_the_same_bits_in_another_instance() {
    let fmu = elliptic(1);
    fmu.step_with(&[("tangential_displacement", 3e-7), ("tangential_displacement_y", 2e-7)], 0.0, 1.0);
    let mut saved = fmu.save();
    let bytes = fmu.serialized(saved);
    let go_on = |fmu: &Fmu| {
        fmu.step_with(&[("tangential_displacement", -2e-7), ("normal_force", 60.0)], 1.0, 1.0);
        outputs(fmu)
    };
    let first = go_on(&fmu);
    assert_eq!(fmu.restore(saved), OK);
    assert_eq!(go_on(&fmu), first);
    let other = elliptic(1);
    let (mut taken, status) = other.deserialized(&bytes);
    assert_eq!(status, OK);
    assert_eq!(other.restore(taken), OK);
    assert_eq!(go_on(&other), first);
    assert_eq!((fmu.free_saved(&mut saved), other.free_saved(&mut taken)), (OK, OK));
}

/// What cannot be computed is refused where the contact is built, with what to do.
#[test]
fn wear_and_radii_too_different_are_refused() {
    for (changes, parts) in [
        (&[("wear_coefficient", 1e-4)][..], ["wear_coefficient = 0.0001", "set wear_coefficient = 0"]),
        (&[("radius_x", 1e4), ("radius_y", 1e-3)][..], ["radius_x = 10000.0", "factor of 1e6 at most"]),
    ] {
        let fmu = Fmu::new();
        set(&fmu, 1);
        for (name, value) in changes {
            assert_eq!(fmu.set_real(name, *value), OK);
        }
        assert_eq!((fmu.setup(0.0, None), fmu.enter_initialization()), (OK, OK));
        fmu.refused(fmu.exit_initialization(), &parts);
    }
    let fmu = Fmu::new();
    for value in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        fmu.refused(fmu.set_real("radius_x", value), &["radius_x"]);
    }
}
