//! The tangential force at an update of the profile, as a master sees it that repeats a step.

use crate::common::*;
use fretting_contact::{FrettingContact, Parameters};
use std::f64::consts::TAU;

/// Force (N) and displacement (m) at the end of a step.
type End = (f64, f64);

/// A share of the way whose motion changes T by rounding.
const NEAR: f64 = 1e-10;

/// Change of T by an update of the profile, in μF_N: from the state before the step to an end next
/// to it, or where the share of the way at which the step ends goes by an update; and the largest
/// between two ends of one step next to each other, on the way and at its start.
fn change_and_jump(before: &FrettingContact, from: End, to: End) -> (f64, f64) {
    let at = |share: f64| {
        let mut contact = before.clone();
        let place = from.1 + share * (to.1 - from.1);
        contact.advance_to(from.0 + share * (to.0 - from.0), place).expect("a part of a step");
        contact
    };
    let updates = |share: f64| at(share).counters().profile_updates;
    let force = |share: f64| at(share).tangential_force();
    let across = if updates(-NEAR) == updates(NEAR) { 0.0 } else { force(NEAR) - force(-NEAR) };
    let (mut low, mut high) = (NEAR, 1.0);
    let at_start = updates(low);
    let on_the_way = if updates(high) == at_start {
        0.0
    } else {
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if updates(middle) == at_start { low = middle } else { high = middle }
        }
        force(high) - force(low)
    };
    let at_once = force(NEAR) - before.tangential_force();
    let jump = across.abs().max(on_the_way.abs());
    let unit = before.parameters().friction_coefficient * from.0.min(to.0);
    (at_once.abs().max(jump) / unit, jump / unit)
}

/// The largest of both on a way, and the number of updates.
fn largest(parameters: Parameters, ends: impl Iterator<Item = End>) -> ((f64, f64), u32) {
    let mut contact = contact(parameters);
    let mut ends = ends.peekable();
    let mut last = (ends.peek().expect("a way").0, 0.0);
    contact.start_at(last.0, 0.0).expect("the load is carried");
    let (mut most, mut updates) = ((0.0_f64, 0.0_f64), 0);
    for end in ends {
        let known = contact.counters().profile_updates;
        let before = contact.clone();
        to(&mut contact, end.0, end.1);
        if contact.counters().profile_updates > known {
            let (change, jump) = change_and_jump(&before, last, end);
            most = (most.0.max(change), most.1.max(jump));
            updates += 1;
        }
        last = end;
    }
    (most, updates)
}

/// Between updates T belongs to the profile of the last one. What it drifts meanwhile comes at once
/// at the update: it goes with the volume that wears between two updates, so with the tolerance.
/// Where the load varies an update comes before a step, so that T is a function of its end without
/// a jump. While it hardly changes, as about the crest of a load that varies, it comes at a
/// reversal, and jumps there. A step of a random history is a whole stroke in many pieces, with
/// updates between them.
#[test]
fn the_tangential_force_jumps_by_less_than_the_tolerance() {
    let sine = |k: u32| (TAU * f64::from(k) / 40.0).sin();
    for friction_coefficient in [0.3, 0.6] {
        let amplitude = 2.5e-6 * friction_coefficient;
        for (name, wear_per_work, steps, swing) in [
            ("constant load", 4e-14, 20_000, 0.0),
            ("varying load", 4e-13, 4_000, 30.0),
            ("fast wear", 4e-12, 2_000, 0.0),
            ("random", 4e-13, 600, 50.0),
        ] {
            let measure = |tolerance: f64| {
                let base = Parameters { tolerance, friction_coefficient, ..Parameters::default() };
                let wear_coefficient = wear_per_work * base.hardness;
                let mut random = seeded(5);
                let end = |k: u32| {
                    if name != "random" {
                        return (FORCE + swing * sine(k + 5), amplitude * sine(k));
                    }
                    let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
                    let load = FORCE + uniform(&mut random, -swing, swing);
                    (load, side * amplitude * uniform(&mut random, 0.2, 1.5))
                };
                largest(Parameters { wear_coefficient, ..base }, (1..=steps).map(end))
            };
            let ((usual, updates), (fine, more)) = (measure(1e-3), measure(1e-4));
            println!(
                "{name}, μ {friction_coefficient}: T changes by {:.1e} μF_N in {updates} updates, between two \
                 ends of a step by {:.1e}; at a tolerance of 1e-4 by {:.1e} in {more}, and {:.1e}",
                usual.0, usual.1, fine.0, fine.1
            );
            assert!(updates > 0 && usual.0 < 1e-3, "{name}: {usual:?}");
            assert!(more > updates && fine.0 < 2e-4, "{name}: {fine:?}");
            if name == "varying load" {
                assert!(usual.1 == 0.0 && fine.1 < 2e-5, "{name}: {usual:?} {fine:?}");
            }
        }
    }
}
