//! `slip_state_value`: the state of slip for importers that read only variables of the type Real.

use crate::host::{Fmu, OK};

#[test]
fn the_real_is_the_number_of_the_enumeration_in_every_state() {
    let fmu = Fmu::started(|_| {});
    let mut point = 0.0;
    let mut states_after = |force: f64, displacement: f64| {
        fmu.step_with(&[("normal_force", force), ("tangential_displacement", displacement)], point, 1.0);
        point += 1.0;
        (fmu.integer("slip_state"), fmu.real("slip_state_value"))
    };
    assert_eq!(states_after(100.0, 0.0), (2, 2.0), "stick");
    assert_eq!(states_after(100.0, 1e-6), (3, 3.0), "partial slip");
    assert_eq!(states_after(100.0, 1e-5), (4, 4.0), "gross slip");
    assert_eq!(states_after(-1.0, 1e-5), (1, 1.0), "separated");
}

#[test]
fn the_real_can_be_read_before_the_first_step_and_never_set() {
    let fmu = Fmu::new();
    assert_eq!(fmu.setup(0.0, None), OK);
    assert_eq!(fmu.enter_initialization(), OK);
    assert_eq!(fmu.real("slip_state_value"), 2.0);
    fmu.refused(fmu.set_real("slip_state_value", 3.0), &["slip_state_value = 3.0", "causality local"]);
}
