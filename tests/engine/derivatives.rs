//! The partial derivatives: against the closed forms of Mindlin's contact, and against differences
//! along the path that the engine itself walks on.

use crate::common::*;
use fretting_contact::{FrettingContact, Gradient, NormalControl, Parameters, Profile, SlipState};

/// A quantity and its gradient.
type Quantity = (&'static str, fn(&FrettingContact) -> f64, fn(&FrettingContact) -> Gradient);

const QUANTITIES: [Quantity; 10] = [
    ("T", FrettingContact::tangential_force, FrettingContact::tangential_force_gradient),
    ("F_N", FrettingContact::normal_reaction, FrettingContact::normal_reaction_gradient),
    ("d", FrettingContact::indentation_depth, FrettingContact::indentation_depth_gradient),
    ("a", FrettingContact::contact_radius, FrettingContact::contact_radius_gradient),
    ("c", FrettingContact::stick_radius, FrettingContact::stick_radius_gradient),
    ("W", FrettingContact::dissipated_energy, FrettingContact::dissipated_energy_gradient),
    ("V", FrettingContact::wear_volume, FrettingContact::wear_volume_gradient),
    ("p", FrettingContact::max_pressure, FrettingContact::max_pressure_gradient),
    ("k_t", FrettingContact::tangential_stiffness, FrettingContact::tangential_stiffness_gradient),
    ("k_n", FrettingContact::normal_stiffness, FrettingContact::normal_stiffness_gradient),
];

/// Compares gradients with central differences over three states of a straight path from where the
/// contact stands. The path has to go on in the sliding direction. Quantities without a derivative
/// there are left out by name.
#[track_caller]
fn agrees_along(
    contact: &FrettingContact,
    at: (f64, f64),
    step: (f64, f64),
    tolerance: f64,
    but: &[&str],
    what: &str,
) {
    let mut middle = contact.clone();
    to(&mut middle, at.0 + step.0, at.1 + step.1);
    let mut end = middle.clone();
    to(&mut end, at.0 + 2.0 * step.0, at.1 + 2.0 * step.1);
    for (name, read, gradient) in QUANTITIES.iter().filter(|(name, ..)| !but.contains(name)) {
        let difference = 0.5 * (read(&end) - read(contact));
        let Gradient { normal, displacement, .. } = gradient(&middle);
        let (by_normal, by_displacement) = (normal * step.0, displacement * step.1);
        let scale = by_normal.abs().max(by_displacement.abs());
        // rounding of the values themselves, which may not change at all
        let rounding = 1e-13 * read(&middle).abs();
        let error = (by_normal + by_displacement - difference).abs();
        assert!(
            error <= tolerance * scale + rounding,
            "{what}, {name}: {by_normal:e} + {by_displacement:e} against {difference:e}"
        );
    }
}

fn usual(profile: &Profile, control: NormalControl) -> (FrettingContact, f64) {
    let contact = contact(Parameters { normal_control: control, ..without_wear(profile.clone()) });
    let normal = match control {
        NormalControl::Force => FORCE,
        NormalControl::Indentation => exact(profile, FORCE).normal.depth(),
    };
    (contact, normal)
}

const CONTROLS: [NormalControl; 2] = [NormalControl::Force, NormalControl::Indentation];

#[test]
fn a_ball_in_partial_slip_has_the_derivatives_of_mindlin() {
    let (mut contact, _) = usual(&BALL, NormalControl::Force);
    contact.start_at(FORCE, 0.0).unwrap();
    let (a, d) = (contact.contact_radius(), contact.indentation_depth());
    let full_slip = MU * E_STAR / G_STAR * d;
    let displacement = 0.6 * full_slip;
    to(&mut contact, FORCE, displacement);
    // T = μF (1 − (1 − U/u_max)^(3/2)), u_max ∝ F^(2/3)
    let left = 1.0 - displacement / full_slip;
    let by_displacement = MU * FORCE * 1.5 * left.sqrt() / full_slip;
    close_to(by_displacement, 2.0 * G_STAR * a * left.sqrt(), 1e-9, "Mindlin's stiffness is 2G*c");
    let by_force =
        MU * (1.0 - left.powf(1.5)) - MU * 1.5 * left.sqrt() * (displacement / full_slip) * 2.0 / 3.0;
    let gradient = contact.tangential_force_gradient();
    close_to(gradient.displacement, by_displacement, 1e-9, "dT/dU");
    close_to(gradient.normal, by_force, 1e-9, "dT/dF");
    close_to(contact.indentation_depth_gradient().normal, 2.0 * d / (3.0 * FORCE), 1e-9, "dd/dF");
    close_to(contact.contact_radius_gradient().normal, a / (3.0 * FORCE), 1e-9, "da/dF");
    let peak = contact.max_pressure();
    close_to(contact.max_pressure_gradient().normal, peak / (3.0 * FORCE), 1e-7, "dp/dF");
    // c = a √(1 − U/u_max)
    close_to(
        contact.stick_radius_gradient().displacement,
        -a / (2.0 * full_slip * left.sqrt()),
        1e-9,
        "dc/dU",
    );

    // in gross slip T = ±μF and W grows by it
    for side in [1.0, -1.0] {
        to(&mut contact, FORCE, side * 5.0 * full_slip);
        assert_eq!(contact.slip_state(), SlipState::GrossSlip);
        let gradient = contact.tangential_force_gradient();
        close_to(gradient.normal, side * MU, 1e-9, "dT/dF in gross slip");
        assert_eq!(gradient.displacement, 0.0);
        close_to(contact.dissipated_energy_gradient().displacement, side * MU * FORCE, 1e-9, "dW/dU");
    }
}

#[test]
fn derivatives_agree_with_differences_along_the_path() {
    for profile in analytic() {
        let punch = matches!(profile, Profile::FlatPunch { .. });
        // a punch sticks as a whole or slips as a whole
        let but: &[&str] = if punch { &["c", "k_t"] } else { &[] };
        for control in CONTROLS {
            let (mut contact, normal) = usual(&profile, control);
            contact.start_at(normal, 0.0).unwrap();
            let full_slip = MU * E_STAR / G_STAR * contact.indentation_depth();
            // a first stroke, back, a minor loop inside, forward again: partial slip after each;
            // then gross slip
            let turns = [0.5, -0.3, 0.1, -0.2, 0.45, 3.0, -3.0];
            let mut last = 0.0;
            for turn in turns {
                let target = turn * full_slip;
                let side = f64::signum(target - last);
                let step = side * 1e-5 * full_slip;
                to(&mut contact, normal, target);
                // the load rests, rises and falls more slowly than the zone follows
                for share in [0.0, 0.2, -0.2] {
                    let what = format!("{profile:?}, {control:?}, at {turn} u_max, load {share}");
                    let by_load = share * 1e-5 * normal;
                    agrees_along(&contact, (normal, target), (by_load, step), 1e-5, but, &what);
                }
                last = target;
            }
        }
    }
}

/// After a small reversal the load falls, at rest or with motion back: the outer springs slip on
/// where they were. (The zone of the last movement was taken, which was empty: derivatives by the
/// load were 0.)
#[test]
fn a_zone_that_slips_as_the_load_falls_counts_after_a_reversal() {
    for profile in [BALL, CONE, ROUNDED] {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            let (mut contact, normal) = usual(&profile, control);
            let full = exact(&profile, FORCE).full_slip();
            to(&mut contact, normal, 0.7 * full);
            to(&mut contact, normal, 0.68 * full);
            for back in [0.0, 1e-3] {
                let mut unloaded = contact.clone();
                let at = (0.9 * normal, (0.68 - back) * full);
                to(&mut unloaded, at.0, at.1);
                let step = (-1e-5 * normal, -1e-4 * back * full);
                agrees_along(&unloaded, at, step, 1e-4, &[], &format!("{profile:?}, {control:?}, {back}"));
                let slope = unloaded.tangential_force_gradient().displacement;
                close_to(unloaded.tangential_stiffness(), slope, 1e-12, "stiffness");
            }
        }
    }
}

#[test]
fn a_sticking_contact_goes_on_elastically() {
    for control in CONTROLS {
        let (mut contact, normal) = usual(&BALL, control);
        contact.start_at(normal, 0.0).unwrap();
        let a = contact.contact_radius();
        close_to(contact.tangential_force_gradient().displacement, 2.0 * G_STAR * a, 1e-9, "at rest");
        assert_eq!(contact.tangential_force_gradient().normal, 0.0);
        assert_eq!(contact.dissipated_energy_gradient(), Gradient::default());
        // after a rise of the load the zone that slipped before sticks
        to(&mut contact, normal, 1e-6);
        to(&mut contact, 1.2 * normal, 1e-6);
        assert_eq!(contact.slip_state(), SlipState::Stick);
        let gradient = contact.tangential_force_gradient();
        close_to(gradient.displacement, 2.0 * G_STAR * contact.contact_radius(), 1e-9, "after a rise");
        assert_eq!(gradient.normal, 0.0);
    }
}

#[test]
fn bodies_apart_feel_nothing() {
    for control in CONTROLS {
        let (mut contact, normal) = usual(&BALL, control);
        for normal in [-normal, 0.0] {
            contact.start_at(normal, 0.0).unwrap();
            for (name, _, gradient) in QUANTITIES {
                let depth = control == NormalControl::Indentation && name == "d";
                let expected = Gradient { normal: if depth { 1.0 } else { 0.0 }, ..Gradient::default() };
                assert_eq!(gradient(&contact), expected, "{name}, {control:?}, {normal}");
            }
        }
    }
}

/// A worn profile, taken as it is: it wears so slowly that the steps do not matter.
#[test]
fn derivatives_agree_on_a_worn_profile() {
    for profile in [BALL, CONE, BLUNTED] {
        for control in CONTROLS {
            let wear_coefficient = 1e-4 * Parameters::default().wear_coefficient;
            let parameters = Parameters {
                profile: profile.clone(),
                normal_control: control,
                wear_coefficient,
                ..Parameters::default()
            };
            let mut contact = contact(parameters);
            let (_, normal) = usual(&profile, control);
            contact.start_at(normal, 0.0).unwrap();
            let amplitude = 0.7 * MU * E_STAR / G_STAR * contact.indentation_depth();
            contact.advance_cycles(normal, amplitude, 2e8).unwrap();
            // at the very load of the cycles the contact edge is where they have left it, elsewhere
            // where the image is d: the two differ by the error of the cells; no front then passes
            // a node, where its slope has a kink
            let normal = 1.003 * normal;
            assert!(contact.wear_depth() > 0.03 * contact.indentation_depth(), "{}", contact.wear_depth());
            let updates = contact.counters().profile_updates;
            for target in [-0.2, 0.3] {
                // the image jumps within a cell as narrow as 1e-8 of the radius: T there is good to
                // 1e-9, not to rounding
                let step = 1e-4 * amplitude * f64::signum(target * amplitude - contact.displacement());
                to(&mut contact, normal, target * amplitude);
                for share in [0.0, 1e-5, -1e-5] {
                    let what = format!("{profile:?}, {control:?}, to {target}, load {share}");
                    let at = (normal, target * amplitude);
                    agrees_along(&contact, at, (share * normal, step), 1e-4, &["p"], &what);
                }
            }
            assert_eq!(contact.counters().profile_updates, updates);
        }
    }
}

/// In gross slip the deepest point of a ball is its middle, which wears by Archard's law with the
/// pressure there.
#[test]
fn the_depth_of_wear_grows_by_the_law_at_the_deepest_point() {
    let mut contact = started(Parameters { profile: BALL, ..Parameters::default() });
    to(&mut contact, FORCE, 1e-3);
    let per_work = contact.parameters().wear_coefficient / contact.parameters().hardness;
    let gradient = contact.wear_depth_gradient();
    close_to(gradient.displacement, per_work * MU * contact.pressure_at(0.0), 1e-6, "at the axis");
    let before = contact.wear_depth();
    to(&mut contact, FORCE, 1.2e-3);
    close_to(gradient.displacement * 2e-4, contact.wear_depth() - before, 1e-2, "over a stretch");
    to(&mut contact, FORCE, 1.1e-3);
    assert!(contact.wear_depth_gradient().displacement < 0.0, "it grows on the way back, too");
}

/// Until the rim of a worn punch reaches the bound, all of it sticks and no front moves; then the
/// front does.
#[test]
fn no_front_moves_before_the_rim_of_a_worn_punch_slips() {
    let mut contact = started(Parameters { profile: PUNCH, wear_coefficient: 1e-8, ..Parameters::default() });
    let full = MU * FORCE / (2.0 * G_STAR * contact.contact_radius());
    contact.advance_cycles(FORCE, 1.3 * full, 1e5).unwrap();
    for (target, sticks) in [(0.2, true), (-0.6, false)] {
        let (at, step) = (target * full, -1e-4 * full);
        to(&mut contact, FORCE, at);
        assert_eq!(contact.slip_state() == SlipState::Stick, sticks, "at {target}");
        for share in [0.0, 1e-5, -1e-5] {
            agrees_along(&contact, (FORCE, at), (share * FORCE, step), 1e-5, &["p"], &format!("{target}"));
        }
    }
}

/// The pressure at the apex of a cone is infinite until it has worn round; its node wears at a
/// finite rate.
#[test]
fn the_apex_of_a_cone_in_gross_slip_wears_at_a_rate() {
    let amplitude = 1e-5;
    for cycles in [1.0, 30.0, 1000.0] {
        let parameters = Parameters { profile: CONE, wear_coefficient: 1e-4, ..Parameters::default() };
        let mut contact = contact(parameters);
        contact.advance_cycles(FORCE, amplitude, cycles).unwrap();
        let (rate, depth) = (contact.wear_depth_per_cycle(amplitude), contact.wear_depth());
        let mut later = contact.clone();
        later.advance_cycles(FORCE, amplitude, 0.02 * cycles).unwrap();
        let grown = (later.wear_depth() - depth) / (0.02 * cycles);
        close_to(rate, grown, 5e-2, &format!("per cycle, after {cycles}"));

        contact.start_at(FORCE, 0.0).unwrap();
        to(&mut contact, FORCE, 0.9 * amplitude);
        let (gradient, depth) = (contact.wear_depth_gradient().displacement, contact.wear_depth());
        to(&mut contact, FORCE, amplitude);
        let grown = (contact.wear_depth() - depth) / (0.1 * amplitude);
        close_to(gradient, grown, 5e-2, &format!("per displacement, after {cycles}"));
    }
}
