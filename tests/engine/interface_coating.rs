//! Coatings of many contacts: each wears through by itself, the first is reported.

use crate::common::*;
use fretting_contact::{FrettingContact, Interface, NormalControl, Parameters, Summit};

const AMPLITUDE: f64 = 1.5e-6;

fn coated(normal_control: NormalControl, coating_thickness: f64) -> Parameters {
    Parameters {
        wear_coefficient: 0.01,
        coating_thickness,
        normal_control,
        resolution: 32,
        ..Parameters::default()
    }
}

/// At a constant approach each contact is one contact at its depth, to the bit; the life is that of
/// the one that is worn through first. One that has touched late has counted all cycles.
#[test]
fn the_first_contact_to_wear_through_counts() {
    let parameters = coated(NormalControl::Indentation, 0.3e-6);
    let offsets = [0.0, 0.4e-6, 3.2e-6];
    let mut joint = Interface::new(parameters.clone(), &offsets.map(Summit::at_offset)).unwrap();
    joint.start_at(3e-6, [0.0; 2], 0.0).unwrap();
    joint.advance_cycles(3e-6, AMPLITUDE, 10.0).unwrap();
    assert!(!joint.worn_through() && joint.cycles_to_wear_through().is_none());
    assert!(joint.contact(2).is_none());
    joint.advance_cycles(4e-6, AMPLITUDE, 1e5).unwrap();
    let life = |offset: f64, before: f64| {
        let mut one = FrettingContact::new(parameters.clone()).unwrap();
        one.start_at(3e-6 - offset, 0.0).unwrap();
        one.advance_cycles(3e-6 - offset, AMPLITUDE, before).unwrap();
        one.advance_cycles(4e-6 - offset, AMPLITUDE, 1e5).unwrap();
        one.cycles_to_wear_through()
    };
    let lives = offsets.map(|offset| life(offset, 10.0));
    for (k, expected) in lives.iter().enumerate() {
        let found = joint.contact(k).unwrap().cycles_to_wear_through();
        close_to(found.unwrap(), expected.unwrap(), 1e-3, "life of a contact");
        assert!(found.unwrap() > 10.0);
    }
    assert_eq!(joint.contact(0).unwrap().cycles_to_wear_through(), lives[0]);
    let first =
        (0..3).filter_map(|k| joint.contact(k)?.cycles_to_wear_through()).fold(f64::INFINITY, f64::min);
    assert_eq!(joint.cycles_to_wear_through(), Some(first));
    assert!(joint.worn_through() && joint.is_known_worn_through());
    assert_eq!(joint.cycles_on_coating(), 1e5 + 10.0);
}

/// At a constant force equal contacts live as long as one, however the calls are divided, and
/// nothing else changes.
#[test]
fn equal_contacts_wear_through_as_one() {
    lives_as_one(64);
    lives_as_one(128);
}

fn lives_as_one(resolution: usize) {
    let parameters = Parameters { resolution, ..coated(NormalControl::Force, 0.4e-6) };
    let mut one = FrettingContact::new(parameters.clone()).unwrap();
    one.advance_cycles(100.0, AMPLITUDE, 5000.0).unwrap();
    let life = one.cycles_to_wear_through().unwrap();
    let run = |coating_thickness: f64, calls: u32| {
        let parameters = Parameters { coating_thickness, ..parameters.clone() };
        let mut joint = Interface::new(parameters, &[Summit::at_offset(0.0); 3]).unwrap();
        for _ in 0..calls {
            joint.advance_cycles(300.0, AMPLITUDE, 5000.0 / f64::from(calls)).unwrap();
        }
        joint
    };
    for calls in [1, 4] {
        let joint = run(0.4e-6, calls);
        close_to(joint.cycles_to_wear_through().unwrap(), life, 1e-5, "life");
        assert_eq!(joint.wear_volume(), run(0.0, calls).wear_volume());
        let mut again = run(0.4e-6, 0);
        again.restore(&joint.snapshot()).unwrap();
        assert_eq!(again.cycles_to_wear_through(), joint.cycles_to_wear_through());
        assert_eq!(again.snapshot(), joint.snapshot());
    }
}

/// While friction runs in, each contact at a constant approach lives as one contact at its depth;
/// that is longer than with the largest coefficient all the time, and shorter than with the least.
#[test]
fn coatings_wear_through_while_friction_runs_in() {
    let running_in = Parameters {
        friction_coefficient: 0.3,
        friction_coefficient_final: 0.6,
        running_in_energy: 2e-2,
        ..coated(NormalControl::Indentation, 0.2e-6)
    };
    let constant = |friction_coefficient: f64| Parameters {
        friction_coefficient,
        ..coated(NormalControl::Indentation, 0.2e-6)
    };
    let (depth, amplitude, offsets) = (3.5e-6, 4e-6, [0.0, 0.5e-6, 1.5e-6]);
    let mut joint = Interface::new(running_in.clone(), &offsets.map(Summit::at_offset)).unwrap();
    joint.advance_cycles(depth, amplitude, 1e4).unwrap();
    let life = |parameters: &Parameters, offset: f64| {
        let mut one = FrettingContact::new(parameters.clone()).unwrap();
        one.advance_cycles(depth - offset, amplitude, 1e4).unwrap();
        one.cycles_to_wear_through().unwrap()
    };
    let lives = offsets.map(|offset| life(&running_in, offset));
    for (index, (expected, offset)) in lives.into_iter().zip(offsets).enumerate() {
        let contact = joint.contact(index).unwrap();
        close_to(contact.cycles_to_wear_through().unwrap(), expected, 1e-9, "life of a contact");
        assert!(contact.friction_coefficient_now() > 0.4);
        let (longest, shortest) = (life(&constant(0.3), offset), life(&constant(0.6), offset));
        let found = joint.contact(index).and_then(FrettingContact::cycles_to_wear_through).unwrap();
        assert!(1.01 * shortest < found && found < 0.99 * longest, "{shortest} {found} {longest}");
    }
    let first = lives.into_iter().fold(f64::INFINITY, f64::min);
    close_to(joint.cycles_to_wear_through().unwrap(), first, 1e-9, "life of the interface");
}

/// In steps the coating is worn through where its depth is read so, without a number of cycles.
#[test]
fn strokes_wear_a_coating_through() {
    let parameters = coated(NormalControl::Force, 0.1e-6);
    let mut joint = Interface::new(parameters, &[0.0, 0.5e-6].map(Summit::at_offset)).unwrap();
    let mut strokes = 0;
    while !joint.worn_through() {
        assert!(joint.wear_depth() < 0.1e-6 && strokes < 2000);
        let u = if strokes % 2 == 0 { 2e-6 } else { -2e-6 };
        joint.advance_to(200.0, [u, 0.0], 0.0).unwrap();
        strokes += 1;
    }
    assert!(joint.wear_depth() >= 0.1e-6 && strokes > 10);
    joint.advance_cycles(200.0, AMPLITUDE, 1e4).unwrap();
    assert!(joint.is_known_worn_through());
    joint.advance_to(-1.0, [0.0; 2], 0.0).unwrap();
    assert!(joint.worn_through(), "it stays so");
    let mut plain = Interface::new(coated(NormalControl::Force, 0.0), &[Summit::at_offset(0.0); 2]).unwrap();
    plain.advance_cycles(200.0, AMPLITUDE, 1e4).unwrap();
    assert!(!plain.worn_through() && plain.cycles_on_coating() == 0.0);
}
