//! Wear of both bodies, coatings and the fields at the probes through the C interface.
#![cfg(feature = "fmi2")]
#![allow(unsafe_code, reason = "the C interface is what is tested")]

use crate::host::{Fmu, OK, reference};
use fretting_contact::fmi2::exports::*;
use fretting_contact::{FrettingContact, Parameters};

fn two_bodies(fmu: &Fmu) {
    for (name, value) in [("wear_coefficient", 0.02), ("wear_coefficient_2", 0.03), ("hardness_2", 2e9)] {
        assert_eq!(fmu.set_real(name, value), OK);
    }
}

fn cyclic(fmu: &Fmu) {
    assert_eq!(fmu.set_integer("loading", 2), OK);
    assert_eq!(fmu.set_real("wear_coefficient", 0.01), OK);
    assert_eq!(fmu.set_real("coating_thickness", 0.4e-6), OK);
}

pub(crate) fn boolean(fmu: &Fmu, name: &str) -> bool {
    let mut value = [7];
    // SAFETY: the component is alive, the arrays have one element.
    let status = unsafe { fmi2GetBoolean(fmu.component, [reference(name)].as_ptr(), 1, value.as_mut_ptr()) };
    assert_eq!(status, OK);
    assert!(matches!(value[0], 0 | 1));
    value[0] == 1
}

#[test]
fn both_bodies_are_those_of_the_engine() {
    let parameters = Parameters {
        wear_coefficient: 0.02,
        wear_coefficient_2: 0.03,
        hardness_2: 2e9,
        ..Parameters::default()
    };
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    let fmu = Fmu::started(two_bodies);
    let mut check = |coefficients: [f64; 2], times: [f64; 2]| {
        assert_eq!(fmu.set_real("wear_coefficient", coefficients[0]), OK);
        assert_eq!(fmu.set_real("wear_coefficient_2", coefficients[1]), OK);
        engine.retune_bodies(0.6, coefficients).unwrap();
        for (time, displacement) in times.into_iter().zip([2e-6, -2e-6]) {
            engine.advance_to(100.0, displacement).unwrap();
            fmu.step_with(&[("tangential_displacement", displacement)], time, 1.0);
        }
        let [body_1, body_2] = engine.wear_volumes();
        assert!(body_1 > 0.0 && body_2 > 0.0);
        assert_eq!((fmu.real("wear_volume_1"), fmu.real("wear_volume_2")), (body_1, body_2));
        assert_eq!(fmu.real("wear_volume"), body_1 + body_2);
        let (slopes, status) = fmu.directional(
            &["wear_volume_1", "wear_volume_2", "wear_volume"],
            &[("tangential_displacement", -1.0)],
        );
        assert_eq!(status, OK);
        assert!((slopes[0] + slopes[1] - slopes[2]).abs() <= 1e-12 * slopes[2].abs() && slopes[0] > 0.0);
    };
    check([0.02, 0.03], [0.0, 1.0]);
    check([0.05, 0.01], [2.0, 3.0]);
    // to and from 0 by a new contact only
    fmu.refused(fmu.set_real("wear_coefficient_2", 0.0), &["wear_coefficient_2", "fmi2Reset"]);
    fmu.refused(fmu.set_real("hardness_2", 1e9), &["hardness_2", "fixed after initialization"]);
    // a saved state keeps the parts, as bytes too
    let state = fmu.save();
    let (copy, status) = fmu.deserialized(&fmu.serialized(state));
    assert_eq!(status, OK);
    let before = fmu.bits();
    fmu.step_with(&[("tangential_displacement", 2e-6)], 4.0, 1.0);
    assert_ne!(fmu.bits(), before);
    assert_eq!(fmu.restore(copy), OK);
    assert_eq!(fmu.bits(), before);
}

#[test]
fn parameters_of_body_2_are_checked() {
    let fmu = Fmu::new();
    for name in ["wear_coefficient_2", "hardness_2", "coating_thickness", "probe_radius_max"] {
        fmu.refused(fmu.set_real(name, -1e-6), &["fmi2SetReal", &format!("{name} = -1e-6"), ">= 0.0"]);
        fmu.refused(fmu.set_real(name, f64::NAN), &[&format!("{name} = NaN"), ">= 0.0"]);
    }
    assert_eq!(fmu.set_real("wear_coefficient_2", 1e-4), OK);
    fmu.setup(0.0, None);
    fmu.enter_initialization();
    fmu.refused(fmu.exit_initialization(), &["hardness_2 = 0", "1e30 Pa", "set wear_coefficient_2 = 0"]);
    assert_eq!(fmu.set_real("hardness_2", 1e9), OK);
    assert_eq!(fmu.exit_initialization(), OK);
}

/// The frequency rises over the step: the time is that of the cycle.
#[test]
fn a_coating_wears_through_at_a_cycle_and_a_time() {
    let parameters =
        Parameters { wear_coefficient: 0.01, coating_thickness: 0.4e-6, ..Parameters::default() };
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    engine.advance_cycles(100.0, 1.5e-6, 10.0).unwrap();
    engine.advance_cycles(100.0, 1.5e-6, 50_000.0).unwrap();
    let life = engine.cycles_to_wear_through().unwrap();
    let fmu = Fmu::started(cyclic);
    fmu.step_with(&[("displacement_amplitude", 1.5e-6), ("frequency", 10.0)], 0.0, 1.0);
    assert!(!boolean(&fmu, "worn_through"));
    assert_eq!((fmu.real("worn_through_time"), fmu.real("cycles_to_wear_through")), (0.0, 0.0));
    assert_eq!(fmu.set_slope("frequency", 1, 998.0), OK);
    let state = fmu.save();
    fmu.step_with(&[], 1.0, 10.0);
    assert!(boolean(&fmu, "worn_through"));
    assert_eq!(fmu.real("cycles_to_wear_through"), life);
    let time = fmu.real("worn_through_time") - 1.0;
    let cycles = 10.0 + 10.0 * time + 0.5 * 998.0 * time * time;
    assert!((cycles / life - 1.0).abs() < 1e-9, "{cycles} {life}");
    // both are constant between events
    assert_eq!(fmu.output_slope("worn_through_time", 1), (0.0, OK));
    assert_eq!(fmu.restore(state), OK);
    assert!(!boolean(&fmu, "worn_through"));
    assert_eq!(fmu.real("worn_through_time"), 0.0);
}

#[test]
fn strokes_wear_through_at_the_end_of_a_step() {
    let fmu = Fmu::started(|fmu| {
        assert_eq!(fmu.set_real("wear_coefficient", 0.01), OK);
        assert_eq!(fmu.set_real("coating_thickness", 0.1e-6), OK);
    });
    let mut step = 0.0;
    while !boolean(&fmu, "worn_through") {
        assert!(fmu.real("wear_depth") < 0.1e-6 && step < 2000.0);
        let side = if step % 2.0 == 0.0 { 2e-6 } else { -2e-6 };
        fmu.step_with(&[("tangential_displacement", side)], step, 1.0);
        step += 1.0;
    }
    assert_eq!((fmu.real("worn_through_time"), fmu.real("cycles_to_wear_through")), (step, 0.0));
    assert!(fmu.real("wear_depth") >= 0.1e-6);
    fmu.step_with(&[("normal_force", -1.0)], step, 1.0);
    assert!(boolean(&fmu, "worn_through"));
    assert_eq!(fmu.real("worn_through_time"), step, "it stays");
    // a Boolean output is no Real and cannot be set
    let wrong = fmu.get_reals(&[reference("worn_through")], &mut [0.0]);
    fmu.refused(wrong, &["worn_through", "Boolean, not Real"]);
    // SAFETY: the component is alive, the arrays have one element.
    let set = unsafe { fmi2SetBoolean(fmu.component, [reference("worn_through")].as_ptr(), 1, [1].as_ptr()) };
    fmu.refused(set, &["worn_through = true", "causality output"]);
}

#[test]
fn fields_are_those_of_the_engine() {
    let parameters = Parameters { wear_coefficient: 0.02, probe_radius_max: 2.5e-4, ..Parameters::default() };
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    let fmu = Fmu::started(|fmu| {
        assert_eq!(fmu.set_real("wear_coefficient", 0.02), OK);
        assert_eq!(fmu.set_real("probe_radius_max", 2.5e-4), OK);
    });
    for (step, displacement) in [2e-6, -1e-6, 1.5e-6].into_iter().enumerate() {
        engine.advance_to(100.0, displacement).unwrap();
        fmu.step_with(&[("tangential_displacement", displacement)], step as f64, 1.0);
    }
    let mut slips = false;
    for (probe, r) in engine.probe_radii().into_iter().enumerate() {
        let field = |name| fmu.real(&format!("{name}[{}]", probe + 1));
        assert_eq!(field("radius_probe"), r);
        assert_eq!(field("profile_height"), engine.profile_height_at(r));
        assert_eq!(field("slip_amplitude"), engine.slip_amplitude_at(r));
        assert_eq!(field("energy_density"), engine.energy_density_at(r).unwrap());
        slips |= field("slip_amplitude") > 0.0 && field("energy_density") > 0.0;
    }
    assert!(slips && fmu.messages().is_empty());
}

#[test]
fn work_per_area_that_is_not_known_is_no_number_and_says_why() {
    let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", 0.0), OK));
    assert!(fmu.real("energy_density[5]").is_nan() && fmu.real("energy_density[6]").is_nan());
    let message = fmu.message();
    assert!(message.starts_with("WARN") && message.contains("wear_coefficient > 0"), "{message}");
}
