//! Coefficients of friction and wear that change during a life.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, Parameters, SlipState};

#[test]
fn a_fall_of_friction_lets_the_springs_slip_back() {
    for side in [1.0, -1.0] {
        let mut contact = started(without_wear(BALL));
        to(&mut contact, FORCE, side * 1e-5);
        let (a, d) = (contact.contact_radius(), contact.indentation_depth());
        let work = contact.dissipated_energy();
        contact.retune(0.5 * MU, 0.0).unwrap();
        close_to(contact.tangential_force(), side * 0.5 * MU * FORCE, 1e-12, "T");
        assert_eq!((contact.displacement(), contact.slip_state()), (side * 1e-5, SlipState::GrossSlip));
        // G* ∫u² dx with u = m (d − x²/R) falls to a quarter
        let energy = G_STAR * (MU * E_STAR / G_STAR * d).powi(2) * a * 8.0 / 15.0;
        close_to(contact.dissipated_energy() - work, 0.75 * energy, 1e-9, "work");
        // in partial slip only the springs beyond the new bound do
        to(&mut contact, FORCE, side * (1e-5 - 1e-6));
        let force = contact.tangential_force();
        contact.retune(0.49 * MU, 0.0).unwrap();
        assert!(contact.tangential_force().abs() < force.abs() && contact.stick_radius() > 0.0);
    }
}

#[test]
fn a_rise_of_friction_changes_nothing_at_first() {
    let mut contact = started(without_wear(BALL));
    to(&mut contact, FORCE, 1e-5);
    let (force, work) = (contact.tangential_force(), contact.dissipated_energy());
    contact.retune(2.0 * MU, 0.0).unwrap();
    close_to(contact.tangential_force(), force, 1e-12, "T");
    assert_eq!(contact.dissipated_energy(), work);
    assert_eq!(contact.slip_state(), SlipState::Stick);
    to(&mut contact, FORCE, 1e-4);
    close_to(contact.tangential_force(), 2.0 * MU * FORCE, 1e-12, "T in the end");
}

#[test]
fn a_contact_retuned_at_rest_is_one_of_these_coefficients() {
    for wear in [0.0, 0.05] {
        let parameters = Parameters { wear_coefficient: wear, ..without_wear(BALL) };
        let mut retuned = started(parameters.clone());
        retuned.retune(0.3, 2.0 * wear).unwrap();
        let mut made =
            started(Parameters { friction_coefficient: 0.3, wear_coefficient: 2.0 * wear, ..parameters });
        assert_eq!(retuned.parameters(), made.parameters());
        for displacement in [1e-6, -2e-6, 0.5e-6, 3e-6, -1e-6] {
            to(&mut retuned, FORCE, displacement);
            to(&mut made, FORCE, displacement);
        }
        assert_eq!(state(&retuned), state(&made), "wear {wear}");
    }
}

#[test]
fn each_part_of_the_work_wears_by_the_coefficient_of_its_time() {
    let mut contact = started(Parameters { wear_coefficient: 0.02, ..without_wear(BALL) });
    let (mut volume, mut work, mut last_wear) = (0.0, 0.0, 0.02);
    for (friction, wear) in [(0.6, 0.02), (0.4, 0.05), (0.7, 0.001), (0.5, 0.02)] {
        contact.retune(friction, wear).unwrap();
        // the change itself dissipates: an update of the profile by the old coefficient, a fall of
        // friction by the new
        let (worn, work_then) = (contact.wear_volume() - volume, contact.dissipated_energy() - work);
        let rounding = 1e-12 * contact.wear_volume();
        assert!(worn >= f64::min(wear, last_wear) / 8e9 * work_then - rounding, "{worn} {work_then}");
        assert!(worn <= f64::max(wear, last_wear) / 8e9 * work_then + rounding, "{worn} {work_then}");
        let (before, start) = (contact.wear_volume(), contact.dissipated_energy());
        for k in 0..6 {
            to(&mut contact, FORCE, if k % 2 == 0 { 3e-6 } else { -3e-6 });
        }
        (volume, work, last_wear) = (contact.wear_volume(), contact.dissipated_energy(), wear);
        close_to(volume - before, wear / 8e9 * (work - start), 1e-9, "by the new coefficient");
    }
    close_to(contact.profile_volume(), contact.wear_volume(), 5e-3, "by the transforms");
    // cycles go on from there
    contact.advance_cycles(FORCE, 1e-6, 20.0).unwrap();
    let (before, work) = (contact.wear_volume(), contact.dissipated_energy());
    contact.advance_cycles(FORCE, 1e-6, 20.0).unwrap();
    let per_work = (contact.wear_volume() - before) / (contact.dissipated_energy() - work);
    close_to(per_work, 0.02 / 8e9, 1e-9, "k/σ₀");
}

#[test]
fn what_cannot_be_changed_is_refused_and_changes_nothing() {
    let mut contact = started(Parameters { wear_coefficient: 0.02, ..without_wear(BALL) });
    to(&mut contact, FORCE, 1e-6);
    let before = contact.snapshot();
    for (friction, wear, name) in [
        (0.0, 0.02, "friction_coefficient"),
        (0.6, 0.0, "wear_coefficient"),
        (-0.1, 0.02, "friction_coefficient"),
        (0.6, f64::NAN, "wear_coefficient"),
    ] {
        match contact.retune(friction, wear) {
            Err(Error::Parameter { name: refused, .. }) => assert_eq!(refused, name),
            other => panic!("{friction}, {wear}: {other:?}"),
        }
        assert_eq!(contact.snapshot(), before);
    }
    contact.retune(MU, 0.02).unwrap();
    assert_eq!(contact.snapshot(), before, "nothing new");
}

/// Where springs slip back at a change of friction, they wear the profile that is read at once, as
/// they would in a gradual change.
#[test]
fn what_slips_back_wears_the_profile() {
    for profile in [BALL, CONE] {
        for (way, strokes) in [([1.0, 0.0], 1), ([1.0, 0.0], 4), ([0.8, 0.6], 4)] {
            let parameters = Parameters { wear_coefficient: 0.01, ..without_wear(profile.clone()) };
            let mut contact = started(parameters);
            let stroke = |contact: &mut FrettingContact, size: f64| {
                contact.advance_to_planar(FORCE, way.map(|part| part * size)).unwrap();
            };
            for k in 0..strokes {
                stroke(&mut contact, if k % 2 == 0 { 3e-6 } else { -3e-6 });
            }
            let before = contact.wear_volume();
            let mut gradual = contact.clone();
            contact.retune(0.25 * MU, 0.01).unwrap();
            for k in 1..=30 {
                gradual.retune(MU * (1.0 - 0.025 * f64::from(k)), 0.01).unwrap();
            }
            let what = format!("{profile:?}, {way:?}, {strokes} strokes");
            assert!(contact.wear_volume() > 1.02 * before, "{what}: {}", contact.wear_volume() / before);
            close_to(contact.profile_volume(), contact.wear_volume(), 1e-3, &what);
            close_to(contact.wear_volume(), gradual.wear_volume(), 5e-3, &what);
            for share in [0.5, 0.7, 0.85] {
                let r = share * contact.contact_radius();
                let tolerance = 0.02 * contact.wear_depth();
                close(contact.worn_depth_at(r), gradual.worn_depth_at(r), tolerance, &what);
            }
            for k in 0..4 {
                stroke(&mut contact, if k % 2 == 0 { -3e-6 } else { 3e-6 });
            }
            close_to(contact.profile_volume(), contact.wear_volume(), 1e-3, &format!("{what}, later"));
        }
    }
}
