//! What holds in every state that can be reached: random histories with wear, and inputs at the
//! ends of double precision.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile, SlipState};
use rand::rngs::StdRng;

fn profiles() -> Vec<Profile> {
    let mut profiles = analytic().to_vec();
    profiles.push(Profile::Table(sampled_sphere(30)));
    profiles
}

/// A wearing contact: some hundred random lines wear a good part of d off.
///
/// A kink within a cell of a mesh that cycles have left needs more cells: of 60 such histories of a
/// blunted sphere, 16 cells miss up to 3.2e-2 of the volume on the profile, 64 up to 2.9e-3.
fn wearing(profile: &Profile, control: NormalControl) -> FrettingContact {
    let has_kink = matches!(profile, Profile::BluntedSphere { .. });
    let parameters = Parameters {
        profile: profile.clone(),
        normal_control: control,
        wear_coefficient: 8e-2,
        resolution: if has_kink { 64 } else { 16 },
        ..Parameters::default()
    };
    contact(parameters)
}

/// A random load: mostly pressed, sometimes apart, over several decades.
fn normal(profile: &Profile, control: NormalControl, random: &mut StdRng) -> f64 {
    let force = match uniform(random, 0.0, 1.0) {
        chance if chance < 0.07 => 0.0,
        chance if chance < 0.14 => -10.0,
        chance if chance < 0.3 => 10f64.powf(uniform(random, -4.0, 2.0)),
        _ => uniform(random, 1.0, FORCE),
    };
    // a table is one of a sphere
    let analytic = if matches!(profile, Profile::Table(_)) { &BALL } else { profile };
    normal_input(analytic, control, force)
}

/// Everything that can be read is finite and inside its bounds.
#[track_caller]
fn assert_sound(contact: &FrettingContact, what: &str) {
    let (a, c) = (contact.contact_radius(), contact.stick_radius());
    let scalars = [
        ("T", contact.tangential_force()),
        ("F_N", contact.normal_reaction()),
        ("d", contact.indentation_depth()),
        ("a", a),
        ("c", c),
        ("p max", contact.max_pressure()),
        ("W", contact.dissipated_energy()),
        ("V", contact.wear_volume()),
        ("wear depth", contact.wear_depth()),
        ("profile volume", contact.profile_volume()),
        ("tangential stiffness", contact.tangential_stiffness()),
        ("normal stiffness", contact.normal_stiffness()),
        ("transform defect", contact.transform_defect()),
        ("clipped work", contact.clipped_work()),
    ];
    for (name, value) in scalars {
        assert!(value.is_finite(), "{what}: {name} = {value}");
        if !matches!(name, "T" | "d") {
            assert!(value >= 0.0, "{what}: {name} = {value}");
        }
    }
    assert!(c <= a, "{what}: c = {c:e} > a = {a:e}");
    let limit = contact.parameters().friction_coefficient * contact.normal_reaction();
    assert!(contact.tangential_force().abs() <= limit, "{what}: T beyond {limit}");
    let per_work = contact.parameters().wear_per_work();
    assert_eq!(contact.wear_volume(), per_work * contact.dissipated_energy(), "{what}");
    assert_eq!(contact.slip_state() == SlipState::Separated, a == 0.0, "{what}");
    // under indentation control a contact may wear until it carries nothing
    assert!(contact.normal_reaction() == 0.0 || a > 0.0, "{what}");
    for r in contact.probe_radii() {
        let worn = contact.worn_depth_at(r);
        assert!(worn.is_finite() && worn >= 0.0, "{what}: worn {worn} at {r}");
        let fields = [contact.pressure_at(r), contact.shear_traction_at(r)];
        // unworn, the pressure under a cone's apex and at the rim of a flat is infinite
        // a² may underflow
        let any_nan = fields.iter().any(|field| field.is_nan());
        assert!(!any_nan || a < 1e-100, "{what}: {fields:?} at {r}");
    }
}

#[test]
fn random_histories_with_wear_keep_every_invariant() {
    for (index, profile) in profiles().iter().enumerate() {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            let mut random = seeded(500 + index as u64);
            let mut contact = wearing(profile, control);
            let full = exact(if index < 8 { profile } else { &BALL }, FORCE).full_slip();
            let (mut work, mut refused, mut apart) = (0.0, 0, 0);
            for n in 0..80 {
                let what = format!("{profile:?} {control:?}, line {n}");
                let load = normal(profile, control, &mut random);
                let displacement = uniform(&mut random, -1.5, 1.5) * full;
                let outcome = match n % 40 {
                    10 => contact.start_at(load, displacement),
                    25 => contact.advance_cycles(load, displacement.abs(), uniform(&mut random, 0.0, 3.0)),
                    _ => contact.advance_to(load, displacement),
                };
                match outcome {
                    // a cyclic call may give up on a profile as jagged as this history leaves it
                    Ok(()) | Err(Error::TooMuchWear { .. }) => {}
                    Err(error) => {
                        println!("{what} to {load:e}, {displacement:e}: {error}");
                        refused += 1;
                    }
                }
                assert_sound(&contact, &what);
                assert!(contact.dissipated_energy() >= work, "{what}: work falls");
                work = contact.dissipated_energy();
                apart += u32::from(contact.contact_radius() == 0.0);
            }
            println!(
                "{profile:?} {control:?}: V = {:e} m3, deepest {:e} m, profile {:+.1e}, clipped {:.1e}, refused {refused}",
                contact.wear_volume(),
                contact.wear_depth(),
                contact.profile_volume() / contact.wear_volume() - 1.0,
                contact.clipped_work() / contact.dissipated_energy(),
            );
            assert!(apart > 3 && contact.wear_volume() > 0.0, "{profile:?} {control:?}");
            close_to(contact.profile_volume(), contact.wear_volume(), 5e-3, "volume of the profile");
            assert_eq!(refused, 0, "{profile:?} {control:?}: every line of this history can be walked");
        }
    }
}

/// Cycles lay a mesh over whatever is there: the rim of a worn punch, steep outside it, and fronts
/// near the axis.
#[test]
fn cycles_on_what_a_history_has_left_keep_the_volume_on_the_profile() {
    for profile in profiles() {
        for seed in [1, 2, 3] {
            let what = format!("{profile:?}, history {seed}");
            let wearing =
                Parameters { wear_coefficient: 0.1, resolution: 24, ..without_wear(profile.clone()) };
            let mut contact = contact(wearing);
            let mut random = seeded(seed);
            for _ in 0..25 {
                to(&mut contact, uniform(&mut random, -10.0, FORCE), uniform(&mut random, -4e-6, 4e-6));
            }
            for _ in 0..3 {
                let (load, amplitude) =
                    (uniform(&mut random, 0.5 * FORCE, FORCE), uniform(&mut random, 0.5e-6, 3e-6));
                contact.advance_cycles(load, amplitude, 2.5).expect(&what);
                let disc = std::f64::consts::PI
                    * contact.contact_radius().powi(2)
                    * contact.indentation_depth().abs();
                let missing = contact.wear_volume() - contact.profile_volume();
                assert!(
                    missing.abs() <= contact.parameters().tolerance * (contact.wear_volume() + disc),
                    "{what}: {missing:e} of {:e} m3",
                    contact.wear_volume()
                );
            }
        }
    }
}

/// Nothing but an error or finite results, and after an error the same state as before.
fn attempt(
    contact: &mut FrettingContact,
    what: &str,
    call: impl FnOnce(&mut FrettingContact) -> Result<(), Error>,
) -> bool {
    let before = state(contact);
    let outcome = call(contact);
    match &outcome {
        Ok(()) => assert_sound(contact, what),
        Err(error) => {
            assert_eq!(state(contact), before, "{what}: {error} changed the state");
            assert!(!error.to_string().is_empty());
        }
    }
    outcome.is_ok()
}

/// One call with two inputs.
type Call = fn(&mut FrettingContact, f64, f64) -> Result<(), Error>;

/// Inputs that no scene has, in every place.
const EXTREMES: [f64; 12] = [
    1e300,
    -1e300,
    1e-300,
    -1e-300,
    5e-324,
    f64::MAX,
    f64::MIN,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -0.0,
    1e3,
];

/// They give an error or finite results.
#[test]
fn extreme_inputs_leave_a_usable_contact() {
    for profile in [BALL, CONE, BLUNTED, PUNCH, Profile::Table(sampled_sphere(30))] {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            // wear over endless paths is slow: two profiles show it
            let wearing = if matches!(profile, Profile::Parabola { .. } | Profile::FlatPunch { .. }) {
                3.2e-4
            } else {
                0.0
            };
            for wear_coefficient in [0.0, wearing] {
                let parameters = Parameters {
                    normal_control: control,
                    wear_coefficient,
                    resolution: 16,
                    ..without_wear(profile.clone())
                };
                let load = if control == NormalControl::Force { FORCE } else { 3e-6 };
                let fresh = {
                    let mut fresh = contact(parameters);
                    to(&mut fresh, load, 0.0);
                    to(&mut fresh, load, 1e-6);
                    fresh
                };
                for extreme in EXTREMES {
                    let what = format!("{profile:?} {control:?} k = {wear_coefficient} with {extreme:e}");
                    // each from the usual state: two such inputs in a row mean a body worn beyond
                    // all measure
                    let calls: [(&str, Call); 8] = [
                        ("load", |c, _, x| c.advance_to(x, 1e-6)),
                        ("displacement", |c, load, x| c.advance_to(load, x)),
                        ("both", |c, _, x| c.advance_to(x, x)),
                        ("start load", |c, _, x| c.start_at(x, 0.0)),
                        ("start displacement", |c, load, x| c.start_at(load, x)),
                        ("load of cycles", |c, _, x| c.advance_cycles(x, 1e-6, 1.0)),
                        ("amplitude", |c, load, x| c.advance_cycles(load, x, 1.0)),
                        ("cycles", |c, load, x| c.advance_cycles(load, 1e-6, x.min(1e3))),
                    ];
                    for (name, call) in calls {
                        attempt(&mut fresh.clone(), &format!("{what} as {name}"), |c| call(c, load, extreme));
                    }
                    if !extreme.is_finite() {
                        let mut contact = fresh.clone();
                        assert!(
                            !attempt(&mut contact, &what, |c| c.advance_to(extreme, 0.0)),
                            "{what} was accepted"
                        );
                        assert!(
                            !attempt(&mut contact, &what, |c| c.advance_to(load, extreme)),
                            "{what} was accepted"
                        );
                        to(&mut contact, load, 0.5e-6);
                        let mut undisturbed = fresh.clone();
                        to(&mut undisturbed, load, 0.5e-6);
                        assert_eq!(state(&contact), state(&undisturbed), "{what}");
                    }
                }
            }
        }
    }
}

#[test]
fn inputs_that_are_no_numbers_are_named() {
    for (control, name) in
        [(NormalControl::Force, "normal_force"), (NormalControl::Indentation, "indentation")]
    {
        let mut contact = contact(Parameters { normal_control: control, ..Parameters::default() });
        let named = |outcome: Result<(), Error>| match outcome {
            Err(Error::Input { name, value, .. }) => (name, value),
            other => panic!("{other:?}"),
        };
        assert_eq!(named(contact.advance_to(f64::INFINITY, 0.0)), (name, f64::INFINITY));
        assert_eq!(named(contact.advance_to(f64::NAN, 0.0)).0, name);
        let displaced = named(contact.advance_to(0.0, f64::NEG_INFINITY));
        assert_eq!(displaced, ("tangential_displacement", f64::NEG_INFINITY));
        assert_eq!(named(contact.advance_cycles(0.0, -1e-6, 1.0)), ("displacement_amplitude", -1e-6));
        assert_eq!(named(contact.advance_cycles(0.0, 1e-6, -1.0)), ("cycles", -1.0));
        assert_eq!(named(contact.advance_cycles(0.0, 1e-6, f64::NAN)).0, "cycles");
    }
}

/// Materials and dimensions at the ends of what is accepted.
#[test]
fn extreme_parameters_give_errors_or_sound_contacts() {
    let profiles = [1e-9, 1e-6, 1e6, 1e9].into_iter().flat_map(|size| {
        [
            Profile::Parabola { radius: size },
            Profile::BluntedSphere { radius: size, flat_radius: 1e-4 },
            Profile::BluntedSphere { radius: 0.01, flat_radius: size },
            Profile::RoundedPunch { radius: size, flat_radius: 1e-4 },
            Profile::RoundedPunch { radius: 0.01, flat_radius: size },
            Profile::FlatPunch { flat_radius: size },
            Profile::PowerLaw { exponent: 0.1, coefficient: size },
            Profile::PowerLaw { exponent: 100.0, coefficient: size },
        ]
    });
    let slopes = [1e-9, 1e-6, 1.57].map(|slope| Profile::Cone { slope });
    let (mut sound, mut refused) = (0, 0);
    for profile in profiles.chain(slopes) {
        for force in [1e-9, 1.0, 1e6] {
            let parameters = Parameters { resolution: 8, ..without_wear(profile.clone()) };
            let Ok(mut contact) = FrettingContact::new(parameters) else {
                refused += 1;
                continue;
            };
            let what = format!("{profile:?} under {force} N");
            let walked = attempt(&mut contact, &what, |c| c.advance_to(force, 0.0))
                && attempt(&mut contact, &what, |c| c.advance_to(force, 1e-6))
                && attempt(&mut contact, &what, |c| c.advance_to(force, -1e-6));
            *if walked { &mut sound } else { &mut refused } += 1;
        }
    }
    println!("sound {sound}, refused {refused}");
    assert!(sound > 40, "sound {sound}, refused {refused}");
}
