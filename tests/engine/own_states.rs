//! A contact takes back every state that it comes to, whatever has led there.

use crate::common::*;
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};

/// Scenes and lines of each.
const SCENES: u64 = 36;
const LINES: usize = 12;

/// A contact under [`FORCE`] that is worn through in 20 to 300 cycles of 0.6 u_max, with u_max (m)
/// and the range of its controlled quantity, of force 1e-6 to 100 N.
fn scene(profile: &Profile, seed: u64) -> (FrettingContact, f64, (f64, f64)) {
    let mut random = seeded(seed);
    let control = [NormalControl::Force, NormalControl::Indentation][seed as usize % 2];
    let closed = if matches!(profile, Profile::Table(_)) { &BALL } else { profile };
    let start = exact(closed, FORCE);
    let (a, d) = (start.normal.radius(), start.normal.depth());
    let cycles = 20.0 * 15.0_f64.powf(uniform(&mut random, 0.0, 1.0));
    let wear_per_work = std::f64::consts::PI * a * a * d / (cycles * 0.6 * MU * FORCE * start.full_slip());
    let parameters = Parameters { normal_control: control, resolution: 40, ..without_wear(profile.clone()) };
    let parameters = Parameters { wear_coefficient: wear_per_work * parameters.hardness, ..parameters };
    let range = match control {
        NormalControl::Force => (1e-6, FORCE),
        NormalControl::Indentation => (1e-6 * d, d),
    };
    let mut contact = contact(parameters);
    contact.start_at(range.1, 0.0).expect("the load is carried");
    (contact, start.full_slip(), range)
}

#[test]
fn a_contact_takes_back_every_state_that_it_comes_to() {
    let profiles: Vec<Profile> = analytic().into_iter().chain([Profile::Table(sampled_sphere(30))]).collect();
    let (mut refusals, mut walked) = (Vec::new(), 0);
    for seed in 0..SCENES {
        let profile = &profiles[seed as usize / 2 % profiles.len()];
        let (mut contact, full_slip, (least, most)) = scene(profile, seed);
        let fresh = contact.clone();
        let mut random = seeded(1000 + seed);
        for line in 0..LINES {
            let normal = least * (most / least).powf(uniform(&mut random, 0.0, 1.0));
            let displacement = uniform(&mut random, -1.5, 1.5) * full_slip;
            // what wears more than the profile can follow is refused
            walked += usize::from(contact.advance_to(normal, displacement).is_ok());
            let saved = contact.snapshot();
            for mut target in [contact.clone(), fresh.clone()] {
                match target.restore(&saved) {
                    Ok(()) => assert_eq!(target.snapshot(), saved),
                    Err(problem) => {
                        refusals.push(format!("{profile:?}, scene {seed}, line {line}: {problem}"))
                    }
                }
            }
        }
    }
    assert!(walked > SCENES as usize * LINES / 2, "{walked} lines were walked");
    assert!(refusals.is_empty(), "{} refusals:\n{}", refusals.len(), refusals.join("\n"));
}

/// A worn body that is lifted off to start again stands at the depth of first touch, and goes back
/// to that state.
#[test]
fn a_worn_body_that_starts_without_a_load_is_at_its_depth_of_first_touch() {
    let parameters = Parameters { wear_coefficient: 1e-3, ..Parameters::default() };
    let mut contact = FrettingContact::new(parameters).unwrap();
    contact.advance_cycles(100.0, 1e-5, 1e4).unwrap();
    let mut lifted = contact.clone();
    lifted.advance_to(0.0, 0.0).unwrap();
    contact.start_at(0.0, 0.0).unwrap();
    assert!(lifted.indentation_depth() > 0.0);
    assert_eq!(contact.indentation_depth(), lifted.indentation_depth());
    let saved = contact.snapshot();
    contact.restore(&saved).unwrap();
}
