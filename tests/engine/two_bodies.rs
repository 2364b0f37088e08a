//! Wear of both bodies: one contact with the sum of the two ratios k/σ, divided in their ratio.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, Parameters};
use rand::RngExt;

/// k₁/σ₁ and k₂/σ₂ of the scenes, m³/J.
const RATIOS: [f64; 2] = [0.02 / 8e9, 0.03 / 2e9];

fn two_bodies() -> Parameters {
    Parameters { wear_coefficient: 0.02, wear_coefficient_2: 0.03, hardness_2: 2e9, ..without_wear(BALL) }
}

/// One body that wears by the sum of both ratios.
fn one_body() -> Parameters {
    let sum = RATIOS[0] + RATIOS[1];
    Parameters { wear_coefficient: sum, hardness: 1.0, ..without_wear(BALL) }
}

/// Ends of a seeded history along x and y, N and m.
fn history(seed: u64, in_plane: bool) -> Vec<(f64, [f64; 2])> {
    let mut random = seeded(seed);
    (0..40)
        .map(|_| {
            let force = if random.random_bool(0.5) { FORCE } else { random.random_range(40.0..160.0) };
            let y = if in_plane { random.random_range(-3e-6..3e-6) } else { 0.0 };
            (force, [random.random_range(-3e-6..3e-6), y])
        })
        .collect()
}

fn same_contact(two: &FrettingContact, one: &FrettingContact, what: &str) {
    close_to(two.wear_volume(), one.wear_volume(), 1e-9, &format!("{what}: volume"));
    close_to(two.tangential_force(), one.tangential_force(), 1e-9, &format!("{what}: T"));
    close_to(two.contact_radius(), one.contact_radius(), 1e-9, &format!("{what}: a"));
    for r in one.probe_radii() {
        let (depth, other) = (two.worn_depth_at(r), one.worn_depth_at(r));
        assert!((depth - other).abs() <= 1e-9 * one.wear_depth(), "{what}: {depth:e} {other:e} at {r:e} m");
    }
}

fn divided(contact: &FrettingContact, what: &str) {
    let [body_1, body_2] = contact.wear_volumes();
    assert_eq!(body_1 + body_2, contact.wear_volume(), "{what}: the sum");
    assert!(body_1 > 0.0, "{what}: something has worn");
    close_to(body_2 * RATIOS[0], body_1 * RATIOS[1], 1e-12, &format!("{what}: the ratio"));
}

#[test]
fn a_seeded_history_wears_both_bodies_in_their_ratio() {
    for (seed, in_plane, rig_stiffness) in
        [(1, false, f64::INFINITY), (2, true, f64::INFINITY), (3, false, 2e7), (4, true, 2e7)]
    {
        let mut two = started(Parameters { rig_stiffness, ..two_bodies() });
        let mut one = started(Parameters { rig_stiffness, ..one_body() });
        let mut before = [0.0; 2];
        for (force, place) in history(seed, in_plane) {
            two.advance_to_planar(force, place).unwrap();
            one.advance_to_planar(force, place).unwrap();
            let now = two.wear_volumes();
            assert!(now[0] >= before[0] && now[1] >= before[1], "{seed}: {now:?} after {before:?}");
            before = now;
        }
        divided(&two, &format!("history {seed}"));
        same_contact(&two, &one, &format!("history {seed}"));
    }
}

#[test]
fn cycles_wear_both_bodies_in_their_ratio() {
    for rig_stiffness in [f64::INFINITY, 2e7] {
        let mut two = contact(Parameters { rig_stiffness, ..two_bodies() });
        let mut one = contact(Parameters { rig_stiffness, ..one_body() });
        for cycles in [10.0, 0.5, 200.0] {
            two.advance_cycles(FORCE, 1.5e-6, cycles).unwrap();
            one.advance_cycles(FORCE, 1.5e-6, cycles).unwrap();
            divided(&two, "cycles");
            same_contact(&two, &one, "cycles");
        }
        let per_cycle = two.wear_volumes_per_cycle(1.5e-6);
        close_to(per_cycle[0] + per_cycle[1], two.wear_volume_per_cycle(1.5e-6), 1e-14, "per cycle");
        close_to(per_cycle[1] / per_cycle[0], RATIOS[1] / RATIOS[0], 1e-12, "ratio per cycle");
    }
}

/// Mirror image: where only body 2 wears, the contact is that in which only body 1 does.
#[test]
fn body_2_alone_wears_as_body_1_alone() {
    let alone_1 = Parameters { wear_coefficient: 0.02, hardness: 4e9, ..without_wear(BALL) };
    let alone_2 = Parameters { wear_coefficient_2: 0.02, hardness_2: 4e9, ..without_wear(BALL) };
    let [mut first, mut second] = [alone_1, alone_2].map(contact);
    for contact in [&mut first, &mut second] {
        contact.start_at(FORCE, 0.0).unwrap();
        for displacement in [2e-6, -2e-6, 2e-6, -1e-6] {
            to(contact, FORCE, displacement);
        }
    }
    assert!(first.wear_volume() > 0.0);
    assert_eq!(first.wear_volumes(), [first.wear_volume(), 0.0]);
    assert_eq!(second.wear_volumes(), [0.0, first.wear_volume()]);
    assert_eq!(second.wear_depth(), first.wear_depth());
    assert_eq!(second.tangential_force(), first.tangential_force());
}

#[test]
fn a_new_ratio_counts_from_its_change_on() {
    let mut contact = started(two_bodies());
    for displacement in [3e-6, -3e-6, 3e-6, 0.5e-6] {
        to(&mut contact, FORCE, displacement);
    }
    // during a stroke, with slip that no update of the profile has seen
    let (before, work) = (contact.wear_volumes(), contact.dissipated_energy());
    contact.retune_bodies(MU, [0.05, 0.01]).unwrap();
    let (after, closed) = (contact.wear_volumes(), contact.dissipated_energy());
    for body in [0, 1] {
        // what the springs lose as the profile follows wears by the old ratio
        close_to(after[body] - before[body], RATIOS[body] * (closed - work), 1e-6, "the backlog");
    }
    for displacement in [-3e-6, 3e-6] {
        to(&mut contact, FORCE, displacement);
    }
    contact.advance_cycles(FORCE, 2e-6, 10.0).unwrap();
    let now = contact.wear_volumes();
    let work = contact.dissipated_energy() - closed;
    close_to(now[0] - after[0], 0.05 / 8e9 * work, 1e-9, "body 1 by its new coefficient");
    close_to(now[1] - after[1], 0.01 / 2e9 * work, 1e-9, "body 2 by its new coefficient");
    close_to(contact.profile_volume(), contact.wear_volume(), 5e-3, "by the transforms");
}

#[test]
fn a_saved_state_keeps_the_parts() {
    let mut saved = started(two_bodies());
    to(&mut saved, FORCE, 3e-6);
    saved.retune_bodies(MU, [0.03, 0.04]).unwrap();
    to(&mut saved, FORCE, -2e-6);
    let text = serde_json::to_string(&saved.snapshot()).unwrap();
    let mut resumed = contact(saved.parameters().clone());
    resumed.restore(&serde_json::from_str(&text).unwrap()).unwrap();
    for contact in [&mut saved, &mut resumed] {
        to(contact, FORCE, 1e-6);
    }
    assert_eq!(resumed.wear_volumes(), saved.wear_volumes());
    assert_eq!(resumed.snapshot(), saved.snapshot());
}

#[test]
fn the_parts_of_the_gradient_add_up() {
    let mut contact = started(two_bodies());
    to(&mut contact, FORCE, 2e-6);
    let [body_1, body_2] = contact.wear_volumes_gradient();
    let whole = contact.wear_volume_gradient();
    assert!(whole.displacement > 0.0);
    close_to(body_1.displacement + body_2.displacement, whole.displacement, 1e-12, "∂V/∂U");
    close_to(body_2.normal / body_1.normal, RATIOS[1] / RATIOS[0], 1e-12, "∂V/∂F");
}

#[test]
fn bad_coefficients_of_body_2_are_refused() {
    for (wear_coefficient_2, hardness_2, name) in [
        (-1.0, 8e9, "wear_coefficient_2"),
        (f64::NAN, 8e9, "wear_coefficient_2"),
        (1e31, 8e9, "wear_coefficient_2"),
        (1e-4, 0.0, "hardness_2"),
        (1e-4, -1.0, "hardness_2"),
        (1e-4, 1e31, "hardness_2"),
        (0.0, -1.0, "hardness_2"),
        (0.0, f64::NAN, "hardness_2"),
    ] {
        let parameters = Parameters { wear_coefficient_2, hardness_2, ..without_wear(BALL) };
        match parameters.validate() {
            Err(Error::Parameter { name: refused, .. }) => assert_eq!(refused, name),
            other => panic!("{wear_coefficient_2}, {hardness_2}: {other:?}"),
        }
    }
    let message = Parameters { wear_coefficient_2: 1e-4, ..Parameters::default() }.validate().unwrap_err();
    assert!(message.to_string().contains("set wear_coefficient_2 = 0"), "{message}");
    // switched on or off by a new contact only
    let mut contact = contact(Parameters { hardness_2: 1e9, ..one_body() });
    assert!(contact.retune_bodies(MU, [contact.parameters().wear_coefficient, 0.1]).is_err());
    assert_eq!(contact.wear_volumes(), [0.0; 2]);
}
