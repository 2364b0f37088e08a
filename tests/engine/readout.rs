//! What a contact tells besides its state: the unworn profile, the depth that a cycle wears, how
//! its own place follows the drive.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, Gradient, Parameters, Profile};

/// f(r) of every kind of profile, Popov and Heß.
#[test]
fn unworn_heights_are_those_of_the_profile() {
    type Height = fn(f64) -> f64;
    let cases: [(Profile, Height); 7] = [
        (BALL, |r| r * r / 0.02),
        (CONE, |r| r * 0.02f64.tan()),
        (Profile::PowerLaw { exponent: 3.0, coefficient: 2e5 }, |r| 2e5 * r * r * r),
        (BLUNTED, |r| (r * r - 1e-8).max(0.0) / 0.02),
        (ROUNDED, |r| (r - 1e-4).max(0.0).powi(2) / 0.02),
        (PUNCH, |r| if r > 1e-4 { f64::INFINITY } else { 0.0 }),
        (Profile::Table(sampled_sphere(401)), |r| r * r / 0.02),
    ];
    for (profile, height) in cases {
        let mut contact = started(Parameters { profile: profile.clone(), ..Parameters::default() });
        // wear is no part of it
        to(&mut contact, FORCE, 1e-4);
        for r in [0.0, 3e-5, 1e-4, 2e-4, 3.5e-4] {
            let (read, expected) = (contact.unworn_height_at(r), height(r));
            let same = read == expected || (read - expected).abs() <= 1e-9 * expected + 1e-16;
            // between its points a table is a curve of its own
            let same = same || matches!(profile, Profile::Table(_)) && (read - expected).abs() < 1e-10;
            assert!(same, "{profile:?} at {r}: {read:e} and not {expected:e}");
        }
    }
}

/// Before it has worn, a ball's depth grows fastest where 4 (kμ/σ₀) p s is largest, with the slip
/// at the surface of a cycle in gross slip s = A − u_max (1 − t²/2) and p = p₀ √(1 − t²), t = r/a;
/// the output is the largest at the radii of the probes.
#[test]
fn the_depth_that_a_first_cycle_wears_has_the_closed_form_in_gross_slip() {
    let exact = exact(&BALL, FORCE);
    let (a, full) = (exact.normal.radius(), exact.full_slip());
    let contact = started(Parameters::default());
    let per_work = contact.parameters().wear_coefficient / contact.parameters().hardness;
    let most_pressure = 1.5 * FORCE / (std::f64::consts::PI * a * a);
    for amplitude in [1.0 + 1e-9, 1.2, 3.0] {
        let rate = |r: f64| {
            let t2 = (r / a).powi(2).min(1.0);
            4.0 * per_work * MU * most_pressure * (1.0 - t2).sqrt() * full * (amplitude - 1.0 + 0.5 * t2)
        };
        let expected = contact.probe_radii().into_iter().map(rate).fold(0.0, f64::max);
        close_to(contact.wear_depth_per_cycle(amplitude * full), expected, 1e-6, "of a cycle");
    }
    // the same from partial slip up, as little wear grows
    for amplitude in [0.3, 0.7, 1.2] {
        let mut worn = contact.clone();
        let rate = worn.wear_depth_per_cycle(amplitude * full);
        let cycles = 1e-4 * exact.normal.depth() / rate;
        worn.advance_cycles(FORCE, amplitude * full, cycles).unwrap();
        close_to(worn.wear_depth(), rate * cycles, 2e-2, "the depth of many");
    }
}

/// Behind a rig the amplitude is the drive's: the contact's own is less by T/k_rig.
#[test]
fn behind_a_rig_a_cycle_wears_what_the_contact_itself_moves() {
    let (rig, amplitude) = (2e7, 1.7e-6);
    let mut driven = contact(Parameters { rig_stiffness: rig, ..Parameters::default() });
    let mut plain = contact(Parameters::default());
    for contact in [&mut driven, &mut plain] {
        contact.start_at(FORCE, 0.0).unwrap();
    }
    let force = exact(&BALL, FORCE).loading(amplitude);
    let (read, own) =
        (driven.wear_depth_per_cycle(amplitude + force / rig), plain.wear_depth_per_cycle(amplitude));
    close_to(read, own, 1e-9, "behind the rig");
    assert!(own > 0.0);
}

#[test]
fn nothing_wears_apart_or_without_a_wear_coefficient() {
    let mut parted = contact(Parameters::default());
    parted.start_at(-1.0, 0.0).unwrap();
    assert_eq!(parted.wear_depth_per_cycle(1e-3), 0.0);
    assert_eq!(pressed(BALL, FORCE).wear_depth_per_cycle(1e-3), 0.0);
}

/// Apart from the counter body it goes with the drive, whatever the rig; in contact by its share of
/// the stiffness.
#[test]
fn the_body_follows_the_drive_by_its_share() {
    for rig in [2e7, f64::INFINITY] {
        let mut contact = contact(Parameters { rig_stiffness: rig, ..without_wear(BALL) });
        contact.start_at(-1.0, 0.0).unwrap();
        assert_eq!(contact.displacement_gradient(), Gradient { displacement: 1.0, ..Gradient::default() });
        contact.start_at(FORCE, 0.0).unwrap();
        let stiffness = 2.0 * G_STAR * contact.contact_radius();
        let share = 1.0 / (1.0 + stiffness / rig);
        close_to(contact.displacement_gradient().displacement, share, 1e-9, "in full stick");
    }
}

#[test]
fn the_number_of_cells_has_its_range() {
    let with = |resolution| FrettingContact::new(Parameters { resolution, ..Parameters::default() });
    for resolution in [0, 7, 513, usize::MAX] {
        let refused = with(resolution).unwrap_err();
        assert!(matches!(refused, Error::Parameter { name: "resolution", .. }), "{refused}");
        assert!(refused.to_string().contains("8 to 512"), "{refused}");
    }
    assert!(with(8).is_ok() && with(512).is_ok());
}

/// In the end the pressure at the stick front of worn cycles is infinite, as at the rim of a punch.
/// The largest pressure that is reported stays of the size of the unworn body's, whatever the cells
/// and the tolerance. (At the nodes next to the front it was 380 to 2,000 times as high.)
#[test]
fn the_largest_pressure_does_not_depend_on_the_nodes_at_a_stick_front() {
    for profile in [BALL, CONE, ROUNDED] {
        let amplitude = 0.4 * exact(&profile, FORCE).full_slip();
        let largest = |cycles: f64, resolution: usize, tolerance: f64| {
            let parameters =
                Parameters { profile: profile.clone(), resolution, tolerance, ..Parameters::default() };
            let mut contact = started(parameters);
            let unworn = contact.max_pressure();
            contact.advance_cycles(FORCE, amplitude, cycles).unwrap();
            contact.max_pressure() / unworn
        };
        for cycles in [1e4, 1e5, 1e6] {
            let usual = largest(cycles, 64, 1e-3);
            println!("{profile:?}, {cycles:e} cycles: {usual:.4}");
            assert!(usual > 0.9 && usual < 2.0, "{profile:?}, {cycles:e}: {usual}");
            for (resolution, tolerance) in [(64, 1e-5), (128, 1e-3), (256, 1e-4)] {
                close_to(largest(cycles, resolution, tolerance), usual, 5e-3, "largest pressure");
            }
        }
    }
}
