//! A load that all but stays: what a master's solver leaves of a constant one.

use crate::common::*;
use fretting_contact::reference::NormalContact;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};
use rand::RngExt;

/// Steps of a cycle.
const STEPS: usize = 96;

/// Changes of the load from step to step, relative: from its last bit on.
const JITTERS: [f64; 6] = [1.2e-16, 1e-15, 1e-13, 1e-12, 1e-10, 1e-8];

/// Cycles of an amplitude (m), straight or also along y, under a load that varies by a jitter: the
/// tangential force at each step, N, and the contact.
fn cycles(
    parameters: &Parameters,
    (amplitude, in_plane): (f64, bool),
    jitter: f64,
    cycles: usize,
) -> (Vec<f64>, FrettingContact) {
    let (mut contact, mut random) = (contact(parameters.clone()), seeded(7));
    let load = match parameters.normal_control {
        NormalControl::Force => FORCE,
        NormalControl::Indentation => {
            NormalContact::at_force(shape(&parameters.profile), E_STAR, FORCE).depth()
        }
    };
    contact.start_at(load, 0.0).expect("the load is carried");
    let forces = (1..=cycles * STEPS).map(|step| {
        let place = amplitude * (std::f64::consts::TAU * step as f64 / STEPS as f64).sin();
        let normal = load * (1.0 + jitter * random.random_range(-1.0..1.0));
        let y = if in_plane { 0.3 * place } else { 0.0 };
        contact.advance_to_planar(normal, [place, y]).expect("the step is followed");
        contact.tangential_force()
    });
    (forces.collect(), contact)
}

/// Largest difference of two histories of T over μF_N.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs() / (MU * FORCE)).fold(0.0, f64::max)
}

/// Springs next to the contact edge touch and leave by rounding. They took the others along: T was
/// off by 0.2 of μF_N, and the work of a thin slip zone by 8 %.
#[test]
fn a_load_that_varies_by_rounding_changes_neither_force_nor_work() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED] {
        for normal_control in [NormalControl::Force, NormalControl::Indentation] {
            let parameters = Parameters { normal_control, ..without_wear(profile.clone()) };
            for share in [0.06, 0.3, 0.9, 2.0] {
                let motion = (share * exact(&profile, FORCE).full_slip(), false);
                let (still, at_rest) = cycles(&parameters, motion, 0.0, 3);
                for jitter in JITTERS {
                    let (forces, contact) = cycles(&parameters, motion, jitter, 3);
                    let what = format!("{profile:?}, {normal_control:?}, {share} u_max, {jitter:e}");
                    let off = apart(&forces, &still);
                    assert!(off < 1e-12 + 4.0 * jitter, "{what}: T is {off:e} off");
                    let work = contact.dissipated_energy() / at_rest.dissipated_energy() - 1.0;
                    assert!(work.abs() < 1e-9 + 30.0 * jitter, "{what}: the work is {work:e} off");
                }
            }
        }
    }
}

/// With wear as well: a step of the slip at the contact edge made the other hinges of the backlog
/// pass for rounding, and gross slip under such a load was refused after some strokes.
#[test]
fn a_load_that_varies_by_rounding_changes_no_wear() {
    let bodies: [Profile; 3] = [BALL, CONE, ROUNDED];
    for (profile, in_plane) in bodies.into_iter().flat_map(|body| [(body.clone(), false), (body, true)]) {
        for normal_control in [NormalControl::Force, NormalControl::Indentation] {
            let parameters = Parameters {
                profile: profile.clone(),
                normal_control,
                wear_coefficient: 3.2e-3,
                ..Parameters::default()
            };
            for share in [0.6, 1.6] {
                let motion = (share * exact(&profile, FORCE).full_slip(), in_plane);
                let (still, at_rest) = cycles(&parameters, motion, 0.0, 8);
                for jitter in JITTERS {
                    let (forces, contact) = cycles(&parameters, motion, jitter, 8);
                    let off = apart(&forces, &still);
                    let volume = contact.wear_volume() / at_rest.wear_volume() - 1.0;
                    let what = format!("{profile:?}, {in_plane}, {normal_control:?}, {share}, {jitter:e}");
                    assert!(off < 1e-3, "{what}: T is {off:e} off");
                    assert!(volume.abs() < 1e-3, "{what}: V is {volume:e} off");
                }
            }
        }
    }
}
