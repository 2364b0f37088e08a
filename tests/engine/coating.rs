//! A coating that wears through: found in transient motion and in cycles, with its cycle.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile};

/// Amplitude of the cycles, m, and cycles of a life.
const AMPLITUDE: f64 = 1.5e-6;

fn worn(coating_thickness: f64) -> Parameters {
    Parameters { wear_coefficient: 0.01, coating_thickness, ..Parameters::default() }
}

/// Depth after some cycles in one call, m.
fn depth_after(parameters: &Parameters, amplitude: f64, cycles: f64) -> f64 {
    let mut contact = contact(Parameters { coating_thickness: 0.0, ..parameters.clone() });
    contact.advance_cycles(FORCE, amplitude, cycles).unwrap();
    contact.wear_depth()
}

/// The depth at the cycle that is reported is the thickness, within what the tolerance is of it.
#[test]
fn the_depth_at_wear_through_is_the_thickness() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        for rig_stiffness in [f64::INFINITY, 3e7] {
            let amplitude = if rig_stiffness.is_finite() { 2.0 * AMPLITUDE } else { AMPLITUDE };
            let parameters = Parameters { tolerance, rig_stiffness, ..worn(0.4e-6) };
            let mut contact = contact(parameters.clone());
            contact.advance_cycles(FORCE, amplitude, 5000.0).unwrap();
            let life = contact.cycles_to_wear_through().expect("5000 cycles wear deeper");
            assert!(contact.worn_through() && life > 0.0 && life < 5000.0, "{life}");
            let depth = depth_after(&parameters, amplitude, life);
            close_to(depth, 0.4e-6, tolerance, &format!("depth after {life} cycles at {tolerance}"));
        }
    }
}

/// Slid far to and fro, a ball wears first on its axis: w = 4 (k/σ₀) μ p₀ (U₀ − m d) N with
/// m = μE*/G*, as long as that is little against the indentation.
#[test]
fn the_life_of_a_thin_coating_in_gross_slip_has_a_closed_form() {
    let slide = 1e-3;
    let radius = (3.0 * FORCE * 0.01 / (4.0 * E_STAR)).cbrt();
    let pressure = 1.5 * FORCE / (std::f64::consts::PI * radius * radius);
    let slip = slide - MU * E_STAR / G_STAR * radius * radius / 0.01;
    let off = |coating_thickness: f64| {
        let parameters = Parameters { wear_coefficient: 1e-6, coating_thickness, ..Parameters::default() };
        let mut contact = contact(parameters);
        contact.advance_cycles(FORCE, slide, 100.0).unwrap();
        let life = contact.cycles_to_wear_through().expect("100 cycles wear deeper");
        (life / (coating_thickness / (4.0 * 1e-6 / 8e9 * MU * pressure * slip)) - 1.0).abs()
    };
    // the pressure falls with the depth: the difference is of first order in it
    let offs = [1e-8, 1e-9, 1e-10].map(off);
    assert!(offs[0] < 2e-3 && offs[1] < 2e-4 && offs[2] < 2e-5, "{offs:?}");
}

/// Slid far to and fro, a sharp body wears round from its axis on: the life at the usual resolution
/// is that on eight times as many cells. (With even cells at the axis it was 6, 33 and 9 % longer.)
#[test]
fn a_sharp_body_wears_through_at_the_usual_resolution() {
    for (profile, coating_thickness, tolerance) in [
        (CONE, 0.4e-6, 5e-3),
        (CONE, 0.05e-6, 3e-2),
        (Profile::PowerLaw { exponent: 1.2, coefficient: 0.1 }, 0.05e-6, 1e-2),
    ] {
        let life = |resolution: usize| {
            let parameters = Parameters {
                profile: profile.clone(),
                wear_coefficient: 1e-4,
                coating_thickness,
                resolution,
                ..Parameters::default()
            };
            let mut contact = contact(parameters);
            contact.advance_cycles(FORCE, 1e-5, 500.0).unwrap();
            contact.cycles_to_wear_through().expect("500 cycles wear deeper")
        };
        close_to(life(64), life(512), tolerance, &format!("{profile:?}, {coating_thickness}"));
    }
}

#[test]
fn how_the_cycles_are_divided_into_calls_does_not_matter() {
    let parameters = worn(0.4e-6);
    let life = |calls: &[f64]| {
        let mut contact = contact(parameters.clone());
        for cycles in calls {
            contact.advance_cycles(FORCE, AMPLITUDE, *cycles).unwrap();
        }
        contact.cycles_to_wear_through().expect("worn through")
    };
    let one = life(&[5000.0]);
    close_to(life(&[1e6]), one, 2e-3, "a much longer call");
    close_to(life(&[one / 10.5; 12]), one, 5e-3, "twelve calls");
}

#[test]
fn the_contact_is_the_same_with_and_without_a_coating() {
    let mut plain = contact(worn(0.0));
    let mut coated = contact(worn(0.4e-6));
    for contact in [&mut plain, &mut coated] {
        contact.advance_cycles(FORCE, AMPLITUDE, 5000.0).unwrap();
        contact.start_at(FORCE, 0.0).unwrap();
        for displacement in [2e-6, -2e-6, 1e-6] {
            to(contact, FORCE, displacement);
        }
    }
    assert_eq!(coated.tangential_force(), plain.tangential_force());
    assert_eq!(coated.wear_depth(), plain.wear_depth());
    assert_eq!(coated.wear_volume(), plain.wear_volume());
    assert!(coated.worn_through() && !plain.worn_through());
    // without a coating there is nothing to look for
    assert_eq!((plain.counters().coating_trials, plain.cycles_to_wear_through()), (0, None));
    assert!(coated.counters().coating_trials > 0);
    assert!(coated.counters().coating_trials <= 20, "{}", coated.counters());
}

#[test]
fn a_coating_that_holds_costs_nothing() {
    let (mut plain, mut coated) = (contact(worn(0.0)), contact(worn(1e-3)));
    for contact in [&mut plain, &mut coated] {
        contact.advance_cycles(FORCE, AMPLITUDE, 500.0).unwrap();
        for k in 0..40 {
            to(contact, FORCE, if k % 2 == 0 { 2e-6 } else { -2e-6 });
        }
    }
    assert_eq!(coated.counters(), plain.counters());
    assert!(!coated.worn_through());
}

#[test]
fn strokes_wear_through_as_the_depth_says() {
    let thickness = 0.1e-6;
    for (control, normal) in [(NormalControl::Force, FORCE), (NormalControl::Indentation, 3.5e-6)] {
        let mut contact = contact(Parameters { normal_control: control, ..worn(thickness) });
        contact.start_at(normal, 0.0).unwrap();
        let mut strokes = 0;
        while !contact.worn_through() {
            assert!(contact.wear_depth() < thickness, "{strokes}");
            let side = if strokes % 2 == 0 { 1.0 } else { -1.0 };
            contact.advance_to_planar(normal, [side * 2e-6, side * 0.5e-6]).unwrap();
            strokes += 1;
            assert!(strokes < 2000);
        }
        assert!(strokes > 3 && contact.wear_depth() >= thickness, "{strokes}");
        assert_eq!(contact.cycles_to_wear_through(), None, "no cycles were counted");
        // it stays so
        contact.advance_to(-1.0, 0.0).unwrap();
        assert!(contact.worn_through());
    }
}

#[test]
fn a_saved_state_keeps_the_life() {
    let mut saved = contact(worn(0.4e-6));
    saved.advance_cycles(FORCE, AMPLITUDE, 200.0).unwrap();
    let mut resumed: FrettingContact = contact(worn(0.4e-6));
    let text = serde_json::to_string(&saved.snapshot()).unwrap();
    resumed.restore(&serde_json::from_str(&text).unwrap()).unwrap();
    for contact in [&mut saved, &mut resumed] {
        contact.advance_cycles(FORCE, AMPLITUDE, 5000.0).unwrap();
    }
    assert!(saved.cycles_to_wear_through().is_some_and(|life| life > 200.0));
    assert_eq!(resumed.snapshot(), saved.snapshot());
}

#[test]
fn a_bad_thickness_is_refused() {
    for coating_thickness in [-1e-6, f64::NAN, f64::INFINITY, 1e31] {
        match worn(coating_thickness).validate() {
            Err(Error::Parameter { name, .. }) => assert_eq!(name, "coating_thickness"),
            other => panic!("{coating_thickness}: {other:?}"),
        }
    }
}
