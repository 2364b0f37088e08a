//! The ranges of all sizes: beyond them a refusal with the range, at their ends numbers.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile};

/// Sizes beyond all that is built are refused where they are given, with the range that is computed
/// with.
#[test]
fn sizes_beyond_what_is_computed_with_are_refused() {
    let refused = |change: &dyn Fn(&mut Parameters), name: &str| {
        let mut parameters = Parameters { wear_coefficient: 0.0, ..Parameters::default() };
        change(&mut parameters);
        match FrettingContact::new(parameters) {
            Err(Error::Parameter { name: found, requirement, .. }) => {
                assert_eq!(found, name);
                assert!(requirement.contains("lies in"), "{requirement}");
            }
            other => panic!("{name}: {other:?}"),
        }
    };
    refused(&|p| p.profile = Profile::FlatPunch { flat_radius: 1e-282 }, "flat_radius");
    refused(&|p| p.profile = Profile::BluntedSphere { radius: 0.01, flat_radius: 6e151 }, "flat_radius");
    refused(&|p| p.profile = Profile::Parabola { radius: 1e31 }, "radius");
    refused(&|p| p.profile = Profile::Cone { slope: 1e-31 }, "cone_slope");
    refused(&|p| p.profile = Profile::PowerLaw { exponent: 2.0, coefficient: 1e301 }, "coefficient");
    refused(&|p| p.materials.body_2.youngs_modulus = 2.67e-307, "youngs_modulus_2");
    refused(&|p| p.resolution = 7, "resolution");
    refused(&|p| p.hardness = 1e31, "hardness");
    refused(&|p| p.friction_coefficient = 1e10, "friction_coefficient");
    refused(&|p| p.wear_coefficient = 1e31, "wear_coefficient");
    refused(&|p| p.tolerance = 1e-13, "tolerance");
}

#[test]
fn loads_and_contacts_beyond_what_is_computed_with_are_refused() {
    let mut ball = started(without_wear(BALL));
    let before = state(&ball);
    for refusal in [
        ball.advance_to(1e61, 0.0),
        ball.advance_to(FORCE, -1e61),
        ball.advance_cycles(FORCE, 1e61, 1.0),
        ball.advance_cycles(FORCE, 1e-6, 1e31),
    ] {
        assert!(matches!(refusal, Err(Error::Input { .. })), "{refusal:?}");
    }
    assert_eq!(state(&ball), before);
    // a contact of 1e63 m: so blunt a spike hardly rises
    let flat = Profile::PowerLaw { exponent: 0.1, coefficient: 1e-20 };
    let refusal = contact(without_wear(flat)).start_at(1e60, 0.0).unwrap_err();
    assert!(matches!(refusal, Error::BeyondNumbers { .. }), "{refusal}");
    assert!(refusal.to_string().contains("check the units"), "{refusal}");
}

/// Ends and middle of the lengths and moduli.
const ENDS: [f64; 3] = [1e-30, 1.0, 1e30];

const CONTROLS: [NormalControl; 2] = [NormalControl::Force, NormalControl::Indentation];

fn profiles(size: f64) -> impl Iterator<Item = Profile> {
    let flats = ENDS.into_iter().flat_map(move |flat_radius| {
        [
            Profile::BluntedSphere { radius: size, flat_radius },
            Profile::RoundedPunch { radius: size, flat_radius },
        ]
    });
    flats.chain([
        Profile::Parabola { radius: size },
        Profile::FlatPunch { flat_radius: size },
        Profile::Cone { slope: size.min(1.57) },
        Profile::PowerLaw { exponent: 0.1, coefficient: size },
        Profile::PowerLaw { exponent: 100.0, coefficient: if size < 1.0 { 1e-300 } else { 1e300 } },
        Profile::Ellipse { radius_x: size, radius_y: if size < 1.0 { 1e5 * size } else { 1e-5 * size } },
    ])
}

/// Every profile, stiffness, friction and rig at the ends of their ranges.
fn scenes() -> Vec<Parameters> {
    let mut scenes = Vec::new();
    for profile in ENDS.into_iter().flat_map(profiles) {
        for normal_control in CONTROLS {
            for (young_1, young_2) in ENDS.into_iter().flat_map(|e| [(e, 1.0), (e, e)]) {
                for (friction_coefficient, rig_stiffness) in
                    [(1e-300, 1e60), (0.6, 1e60), (1e9, 1e-60), (0.6, 1e59)]
                {
                    let mut parameters = Parameters {
                        friction_coefficient,
                        normal_control,
                        rig_stiffness,
                        resolution: 8,
                        ..without_wear(profile.clone())
                    };
                    parameters.materials.body_1.youngs_modulus = young_1;
                    parameters.materials.body_2.youngs_modulus = young_2;
                    scenes.push(parameters);
                }
            }
        }
    }
    scenes
}

/// All that can be read is a number, and finite but for fields at singular points.
fn assert_numbers(contact: &FrettingContact, what: &str) {
    let scalars = [
        contact.tangential_force(),
        contact.normal_reaction(),
        contact.indentation_depth(),
        contact.contact_radius(),
        contact.stick_radius(),
        contact.displacement(),
        contact.drive_displacement(),
        contact.dissipated_energy(),
        contact.wear_volume(),
        contact.wear_depth(),
        contact.max_pressure(),
        contact.tangential_stiffness(),
        contact.normal_stiffness(),
    ];
    assert!(scalars.iter().all(|x| x.is_finite()), "{what}, {:?}: {scalars:?}", contact.parameters());
    let gradients = [
        contact.tangential_force_gradient(),
        contact.contact_radius_gradient(),
        contact.stick_radius_gradient(),
        contact.dissipated_energy_gradient(),
        contact.max_pressure_gradient(),
    ];
    let finite = gradients.iter().all(|g| g.normal.is_finite() && g.displacement.is_finite());
    assert!(finite, "{what}, {:?}: {gradients:?}", contact.parameters());
    for r in contact.probe_radii().into_iter().step_by(21) {
        let fields = [
            contact.pressure_at(r),
            contact.shear_traction_at(r),
            contact.image_at(r),
            contact.worn_depth_at(r),
        ];
        assert!(!fields.iter().any(|x| x.is_nan()), "{what}, {:?} at {r}: {fields:?}", contact.parameters());
    }
}

type Call = fn(&mut FrettingContact, f64) -> Result<(), Error>;

const CALLS: [(&str, Call); 7] = [
    ("pressed", |c, load| c.start_at(load, 0.0)),
    ("moved", |c, load| c.advance_to(load, 1e-6)),
    ("moved far", |c, load| c.advance_to(0.5 * load, -1e60)),
    ("moved back, nearly to 0", |c, load| c.advance_to(load, 1e-300)),
    ("in cycles", |c, load| c.advance_cycles(load, 1e-6, 1e30)),
    ("in far cycles", |c, load| c.advance_cycles(load, 1e60, 1.0)),
    ("lifted", |c, load| c.advance_to(-load, 0.0)),
];

/// Makes all calls of a contact under each load, looks for numbers after each, and counts those
/// that are done and those refused.
fn call_all(parameters: Parameters, loads: &[f64], (sound, refused): (&mut u32, &mut u32)) {
    let fresh = contact(parameters);
    for &load in loads {
        let mut contact = fresh.clone();
        for (what, call) in CALLS {
            match call(&mut contact, load) {
                Ok(()) => *sound += 1,
                Err(_) => *refused += 1,
            }
            assert_numbers(&contact, &format!("{load:e} {what}"));
        }
    }
}

#[test]
fn the_ends_of_all_ranges_give_numbers_or_refusals() {
    let (mut sound, mut refused) = (0, 0);
    for parameters in scenes() {
        call_all(parameters, &[5e-324, 1.0, 1e60], (&mut sound, &mut refused));
    }
    println!("{sound} calls done, {refused} refused");
    assert!(sound > 5 * refused, "{sound} calls done, {refused} refused");
}

/// A wear that is next to none, and one that no profile can follow.
#[test]
fn the_ends_of_the_ranges_of_wear_give_numbers_or_refusals() {
    let (mut sound, mut refused) = (0, 0);
    // an ellipse has no worn shape
    let revolved = |profile: &Profile| !matches!(profile, Profile::Ellipse { .. });
    for profile in profiles(0.01).filter(revolved) {
        for normal_control in CONTROLS {
            for (wear_coefficient, hardness) in [(5e-324, 1e30), (1e-30, 1.0), (3.2e-4, 8e9), (1e30, 1e-30)] {
                let parameters = Parameters {
                    wear_coefficient,
                    hardness,
                    normal_control,
                    resolution: 8,
                    ..without_wear(profile.clone())
                };
                call_all(parameters, &[1e-300, 1e-30, 1e-6, 1e60], (&mut sound, &mut refused));
            }
        }
    }
    println!("{sound} calls done, {refused} refused");
    assert!(sound > refused, "{sound} calls done, {refused} refused");
}

/// The friction bound is not lost in the rounding of a way that is 10³⁴ times as long.
#[test]
fn after_a_way_beyond_all_measure_friction_is_at_its_limit() {
    for rig_stiffness in [f64::INFINITY, 1e9] {
        let parameters = Parameters { rig_stiffness, ..without_wear(BALL) };
        let mut contact = contact(parameters);
        contact.start_at(100.0, 1.7e34).unwrap();
        contact.advance_to(1e8, 1.7e34).unwrap();
        contact.advance_to(1e8, 1e-6).unwrap();
        close_to(contact.tangential_force(), -MU * 1e8, 1e-12, "force");
        // springs that touch on such a way hold no more than those that were there, and the state
        // is one that it takes back
        contact.start_at(100.0, 1.7e34).unwrap();
        contact.advance_to(1e8, 1.0).unwrap();
        let state = contact.snapshot();
        contact.restore(&state).unwrap();
    }
}
