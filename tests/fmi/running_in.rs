//! Friction that runs in, through the C interface.

use crate::host::{Fmu, OK};
use fretting_contact::{FrettingContact, Parameters};

const FRICTION: [(&str, f64); 3] =
    [("friction_coefficient", 0.2), ("friction_coefficient_final", 0.8), ("running_in_energy", 1e-3)];

fn runs_in(fmu: &Fmu) {
    for (name, value) in FRICTION {
        assert_eq!(fmu.set_real(name, value), OK);
    }
}

#[test]
fn the_coefficient_is_that_of_the_engine_and_is_restored() {
    let parameters = Parameters {
        friction_coefficient: 0.2,
        friction_coefficient_final: 0.8,
        running_in_energy: 1e-3,
        ..Parameters::default()
    };
    let mut engine = FrettingContact::new(parameters).unwrap();
    engine.start_at(100.0, 0.0).unwrap();
    let fmu = Fmu::started(runs_in);
    assert_eq!(fmu.real("friction_coefficient_now"), 0.2);
    let mut time = 0.0;
    let mut step = |displacement: f64| {
        engine.advance_to(100.0, displacement).unwrap();
        fmu.step_with(&[("tangential_displacement", displacement)], time, 1.0);
        time += 1.0;
        let now = fmu.real("friction_coefficient_now");
        assert_eq!(now, engine.friction_coefficient_now());
        assert_eq!(fmu.real("tangential_force"), engine.tangential_force());
        now
    };
    let before = step(8e-6);
    let now = step(-8e-6);
    assert!(before > 0.25 && now > before, "{before}, {now}");
    // the change of friction with the displacement is that with the work times that of the work
    let (slopes, status) = fmu.directional(
        &["friction_coefficient_now", "dissipated_energy"],
        &[("tangential_displacement", -1.0)],
    );
    assert_eq!(status, OK);
    assert!((slopes[0] / slopes[1] / ((0.8 - now) / 1e-3) - 1.0).abs() < 1e-12);
    let mut saved = fmu.save();
    let (mut copy, status) = fmu.deserialized(&fmu.serialized(saved));
    assert_eq!(status, OK);
    fmu.step_with(&[("tangential_displacement", 8e-6)], 2.0, 1.0);
    assert!(fmu.real("friction_coefficient_now") > now);
    assert_eq!(fmu.restore(copy), OK);
    assert_eq!(fmu.real("friction_coefficient_now"), now);
    for state in [&mut saved, &mut copy] {
        assert_eq!(fmu.free_saved(state), OK);
    }
}

#[test]
fn friction_that_cannot_run_in_is_refused_by_name() {
    let fmu = Fmu::new();
    fmu.refused(fmu.set_real("running_in_energy", -1.0), &["running_in_energy", "-1"]);
    runs_in(&fmu);
    assert_eq!(fmu.set_real("friction_coefficient_final", 0.0), OK);
    assert_eq!(fmu.setup(0.0, None), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    fmu.refused(fmu.exit_initialization(), &["friction_coefficient_final", "above 0"]);
}
