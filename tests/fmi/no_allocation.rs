//! A step asks for no memory: counted at the C interface, scene by scene, once the rows have found
//! their size.

use crate::counting::allocations;
use crate::host::{Fmu, OK, reference};
use fretting_contact::{FrettingContact, Parameters};
use std::f64::consts::TAU;

/// Steps of a cycle.
const STEPS: u32 = 40;

/// One cycle of U = amplitude·sin, F_N = 100 N + swing·cos; requests for memory in its steps, one
/// by one.
fn cycle(fmu: &Fmu, number: u32, amplitude: f64, swing: f64) -> Vec<u64> {
    let inputs = [reference("normal_force"), reference("tangential_displacement")];
    let outputs = ["tangential_force", "dissipated_energy", "wear_volume", "wear_depth", "stick_radius"];
    let outputs = outputs.map(reference);
    (0..STEPS)
        .map(|k| {
            let phase = TAU * f64::from(k + 1) / f64::from(STEPS);
            let before = allocations();
            let values = [100.0 + swing * phase.cos(), amplitude * phase.sin()];
            assert_eq!(fmu.set_reals(&inputs, &values), OK);
            assert_eq!(fmu.do_step(f64::from(number * STEPS + k), 1.0), OK);
            assert_eq!(fmu.get_reals(&outputs, &mut [0.0; 5]), OK);
            allocations() - before
        })
        .collect()
}

/// Runs 50 cycles and then asserts that 50 more ask for nothing.
fn asks_for_nothing(what: &str, wear: f64, amplitude: f64, swing: f64) {
    let fmu = Fmu::started(|fmu| {
        assert_eq!(fmu.set_real("wear_coefficient", wear), OK);
    });
    for number in 0..50 {
        cycle(&fmu, number, amplitude, swing);
    }
    for number in 50..100 {
        let asked = cycle(&fmu, number, amplitude, swing);
        assert_eq!(asked, vec![0; STEPS as usize], "{what}, cycle {number}");
    }
}

#[test]
fn contact_alone() {
    asks_for_nothing("full stick", 0.0, 1e-9, 0.0);
    asks_for_nothing("partial slip", 0.0, 1e-6, 0.0);
    asks_for_nothing("gross slip", 0.0, 5e-6, 0.0);
}

#[test]
fn contact_alone_under_a_load_that_varies() {
    asks_for_nothing("varying load", 0.0, 1e-6, 30.0);
    asks_for_nothing("chatter", 0.0, 1e-6, 130.0);
}

/// An orbit and a Lissajous figure, at constant and at varying load.
#[test]
fn motion_in_the_plane() {
    asks_for_nothing_in_the_plane(0.0);
}

fn asks_for_nothing_in_the_plane(wear: f64) {
    let inputs = ["normal_force", "tangential_displacement", "tangential_displacement_y"].map(reference);
    let outputs = [
        "tangential_force",
        "tangential_force_y",
        "dissipated_energy",
        "stick_radius",
        "tangential_stiffness",
    ]
    .map(reference);
    for (turns, swing) in [(1.0, 0.0), (2.0, 0.0), (1.0, 30.0), (2.0, 30.0)] {
        let fmu = Fmu::started(|fmu| assert_eq!(fmu.set_real("wear_coefficient", wear), OK));
        for step in 0..20 * STEPS {
            let phase = TAU * f64::from(step + 1) / f64::from(STEPS);
            let before = allocations();
            let values = [100.0 + swing * phase.cos(), 1.5e-6 * phase.sin(), 1.5e-6 * (turns * phase).cos()];
            assert_eq!(fmu.set_reals(&inputs, &values), OK);
            assert_eq!(fmu.do_step(f64::from(step), 1.0), OK);
            assert_eq!(fmu.get_reals(&outputs, &mut [0.0; 5]), OK);
            assert!(step < 10 * STEPS || allocations() == before, "{turns}, {swing}: step {step}");
        }
    }
}

/// Wear so slow that no profile update falls into the cycles.
#[test]
fn with_wear_between_two_updates() {
    asks_for_nothing("partial slip", 1e-9, 1e-6, 0.0);
    asks_for_nothing("gross slip", 1e-9, 5e-6, 0.0);
    asks_for_nothing("varying load", 1e-9, 1e-6, 30.0);
    asks_for_nothing("widely varying load", 1e-11, 1e-6, 60.0);
    asks_for_nothing_in_the_plane(1e-11);
}

/// Load (N) and displacements (m) of a step.
type Inputs<'a> = &'a dyn Fn(u32) -> [f64; 3];

/// The depth of the wear, read after every step where updates of the profile come and go: its
/// buffers grow now and then, and are kept.
#[test]
fn readings_of_the_depth() {
    let sine = |amplitude: f64, step: u32| amplitude * (TAU * f64::from(step) / f64::from(STEPS)).sin();
    let scenes: [(&str, Inputs); 4] = [
        ("cycles", &|step| [100.0, sine(1.5e-6, step), 0.0]),
        ("varying load", &|step| [100.0 + sine(30.0, step + 5), sine(1.5e-6, step), 0.0]),
        ("changing strokes", &|step| [100.0 + sine(40.0, 7 * step), sine(2e-6, 17 * step), 0.0]),
        ("orbit", &|step| [100.0, sine(1.5e-6, step), sine(1.5e-6, step + 10)]),
    ];
    for (what, inputs) in scenes {
        let parameters = Parameters { wear_coefficient: 0.032, ..Parameters::default() };
        let mut contact = FrettingContact::new(parameters).expect("valid parameters");
        contact.start_at(100.0, 0.0).expect("the load is carried");
        let (mut asked, mut deepest) = (0, 0.0_f64);
        for step in 1..50 * STEPS {
            let [force, x, y] = inputs(step);
            contact.advance_to_planar(force, [x, y]).expect("the step is taken");
            let before = allocations();
            deepest = deepest.max(contact.wear_depth());
            asked += if step > 25 * STEPS { allocations() - before } else { 0 };
        }
        let updates = contact.counters().profile_updates;
        println!("{what}: {asked} requests, {updates} updates");
        assert!(deepest > 0.0 && updates > 20 && asked < u64::from(STEPS) / 4, "{what}: {asked}, {updates}");
    }
}

/// The counter counts: building an instance asks for memory.
#[test]
fn an_instance_asks_for_memory() {
    let before = allocations();
    drop(Fmu::started(|_| {}));
    assert!(allocations() > before);
}
