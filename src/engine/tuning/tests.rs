//! What becomes of worn volume and friction work where one value is halved or doubled.

use super::{Tuning, USUAL};
use crate::engine::FrettingContact;
use crate::parameters::Parameters;
use crate::profile::Profile;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;
use std::sync::Arc;

type Way = fn(&mut FrettingContact);

fn sine(cycles: f64) -> f64 {
    (TAU * cycles).sin()
}

/// A load that swings by half, as far ahead of the displacement as given, in cycles: 20 of them,
/// since over 10 the rounding of places, which decides where an update falls, changes the work with
/// half of a value by up to 3e-4.
fn load_varies(contact: &mut FrettingContact, ahead: f64) {
    for k in 1..=800 {
        let cycles = f64::from(k) / 40.0;
        contact.advance_to(100.0 + 50.0 * sine(cycles + ahead), 1.6e-6 * sine(cycles)).unwrap();
    }
}

fn in_phase(contact: &mut FrettingContact) {
    load_varies(contact, 0.0);
}

fn a_quarter_ahead(contact: &mut FrettingContact) {
    load_varies(contact, 0.25);
}

fn random_strokes_and_loads(contact: &mut FrettingContact) {
    let mut random = StdRng::seed_from_u64(3);
    for k in 0..120 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let force = random.random_range(60.0..140.0);
        contact.advance_to(force, side * random.random_range(0.3e-6..2.0e-6)).unwrap();
    }
}

fn random_strokes(contact: &mut FrettingContact) {
    let mut random = StdRng::seed_from_u64(4);
    for k in 0..200 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        contact.advance_to(100.0, side * random.random_range(0.3e-6..2.0e-6)).unwrap();
    }
}

/// At constant load; V is a seventh of a² d at the end.
fn cycles(contact: &mut FrettingContact) {
    (1..=400).for_each(|k| contact.advance_to(100.0, 1.8e-6 * sine(f64::from(k) / 20.0)).unwrap());
}

/// At constant load; the profile goes to and fro between the moving mesh and nodes at rest.
fn gross_slip(contact: &mut FrettingContact) {
    (1..=400).for_each(|k| contact.advance_to(100.0, 3.3e-6 * sine(f64::from(k) / 40.0)).unwrap());
}

fn orbit(contact: &mut FrettingContact) {
    for k in 1..=300 {
        let cycles = f64::from(k) / 30.0;
        contact.advance_to_planar(100.0, [1.4e-6 * sine(cycles), 1.4e-6 * sine(cycles + 0.25)]).unwrap();
    }
}

/// Behind a rig, as the drive goes round.
fn orbit_of_a_drive(contact: &mut FrettingContact) {
    for k in 1..=60 {
        let cycles = f64::from(k) / 30.0;
        contact.advance_to_planar(100.0, [3e-6 * sine(cycles), 3e-6 * sine(cycles + 0.25)]).unwrap();
    }
}

/// Name, way, and what of the parameters is not usual.
fn scenes() -> Vec<(&'static str, Way, Parameters)> {
    let base = || {
        let base = Parameters::default();
        // V is a hundredth to a quarter of a² d at the end
        Parameters { wear_coefficient: 1e-11 * base.hardness, ..base }
    };
    let runs_in = Parameters { friction_coefficient_final: 0.3, running_in_energy: 2e-3, ..base() };
    let wears_fast = Parameters { wear_coefficient: 3.0 * base().wear_coefficient, ..base() };
    vec![
        ("load in phase", in_phase, base()),
        ("load a quarter ahead", a_quarter_ahead, base()),
        ("random strokes and loads", random_strokes_and_loads, base()),
        ("random strokes", random_strokes, base()),
        ("cycles", cycles, wears_fast),
        ("gross slip", gross_slip, base()),
        ("no wear", random_strokes_and_loads, Parameters { wear_coefficient: 0.0, ..base() }),
        ("friction runs in", random_strokes, runs_in),
        ("orbit", orbit, base()),
        ("orbit of a drive", orbit_of_a_drive, Parameters { rig_stiffness: 3.5e7, ..base() }),
    ]
}

/// Friction work, J.
fn work(way: Way, parameters: &Parameters, tuning: Tuning) -> f64 {
    let mut contact = FrettingContact::new(parameters.clone()).unwrap();
    Arc::make_mut(&mut contact.model).tuning = tuning;
    contact.start_at(100.0, 0.0).unwrap();
    way(&mut contact);
    // the work of the last backlog is not corrected yet: a small part of it all
    let updates = contact.counters().profile_updates;
    assert!(parameters.wear_coefficient == 0.0 || updates > 5, "{updates}");
    contact.dissipated_energy()
}

/// By at most the usual tolerance, 1e-3. Work is deferred where an update wears too much for a
/// profile: in none of these scenes.
#[test]
fn results_hold_where_a_value_is_halved_or_doubled() {
    type Set = fn(&mut Tuning, f64);
    let values: [(&str, Set); 9] = [
        ("stroke", |tuning, by| tuning.stroke *= by),
        ("least_width", |tuning, by| tuning.least_width *= by),
        ("placed_with", |tuning, by| tuning.placed_with *= by),
        ("load_share", |tuning, by| tuning.load_share *= by),
        ("root_share", |tuning, by| tuning.root_share *= by),
        ("drift", |tuning, by| tuning.drift *= by),
        ("bent", |tuning, by| tuning.bent *= by),
        ("way_of_edge", |tuning, by| tuning.way_of_edge *= by),
        ("samples_per_cell", |tuning, by| {
            tuning.samples_per_cell = (tuning.samples_per_cell as f64 * by) as usize;
        }),
    ];
    let mut used = [false; 9];
    for (scene, way, parameters) in scenes() {
        let usual = work(way, &parameters, USUAL);
        for (used, (name, set)) in used.iter_mut().zip(values) {
            for by in [0.5, 2.0] {
                let mut tuning = USUAL;
                set(&mut tuning, by);
                let change = work(way, &parameters, tuning) / usual - 1.0;
                *used |= change != 0.0;
                assert!(change.abs() <= 1e-3, "{scene}: {by} {name} changes the work by {change:e}");
            }
        }
    }
    for (used, (name, _)) in used.iter().zip(values) {
        assert_eq!(*used, name != "placed_with", "{name}");
    }
}

/// Cycles in one call over a profile with fronts and edges of other motion, which the mesh of a
/// blunted sphere does not carry at first: the updates that come before it can follow, and those
/// to the end of a life.
#[test]
fn the_updates_of_steady_motion_may_be_halved_or_doubled() {
    fn after_strokes(contact: &mut FrettingContact, amplitude: f64, cycles: f64) {
        for (force, place) in [
            (100.0, 1.0),
            (100.0, -1.0),
            (120.0, 0.9),
            (90.0, -1.0),
            (100.0, 1.0),
            (60.0, -0.5),
            (100.0, 0.7),
        ] {
            contact.advance_to(force, place * 2.5e-6).unwrap();
        }
        contact.advance_cycles(100.0, amplitude, cycles).unwrap();
    }
    let ways: [Way; 2] =
        [|contact| after_strokes(contact, 0.5e-6, 10.0), |contact| after_strokes(contact, 3e-6, 1e6)];
    let profile = Profile::BluntedSphere { radius: 0.01, flat_radius: 1e-4 };
    let base = Parameters::default();
    let parameters = Parameters { profile, wear_coefficient: 1e-11 * base.hardness, ..base };
    for way in ways {
        let work = |by: f64| {
            let tuning = Tuning { steady_share: by * USUAL.steady_share, ..USUAL };
            work(way, &parameters, tuning)
        };
        let changes = [0.5, 2.0].map(|by| work(by) / work(1.0) - 1.0);
        println!("work changed by {changes:?}");
        assert!(changes.iter().all(|change| change.abs() <= 1e-3 && *change != 0.0), "{changes:?}");
    }
}
