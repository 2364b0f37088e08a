//! Normal contact against the closed forms: depth, radius, force and pressure of every profile.

mod common;

use common::*;
use fretting_contact::reference::{NormalContact, Shape};
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile, ProfileTable};

const RESOLUTIONS: [usize; 3] = [8, 64, 1024];

/// Forces over twelve decades, N.
fn forces() -> impl Iterator<Item = f64> {
    (-6..=6).map(|decade| 10f64.powi(decade))
}

fn under(profile: &Profile, control: NormalControl, resolution: usize, normal: f64) -> FrettingContact {
    let parameters = Parameters { normal_control: control, resolution, ..without_wear(profile.clone()) };
    let mut contact = contact(parameters);
    to(&mut contact, normal, 0.0);
    contact
}

/// The unworn profile is analytic, so that neither resolution nor load matters: only rounding (1e-12) and the
/// quadrature of some pressures are left.
fn assert_agrees(contact: &FrettingContact, exact: &NormalContact, what: &str) {
    close_to(contact.normal_reaction(), exact.force(), 1e-9, &format!("{what}: F_N"));
    close_to(contact.indentation_depth(), exact.depth(), 1e-9, &format!("{what}: d"));
    close_to(contact.contact_radius(), exact.radius(), 1e-9, &format!("{what}: a"));
    close_to(contact.normal_stiffness(), exact.stiffness(), 1e-9, &format!("{what}: dF_N/dd"));
    // the apex of a cone carries an infinite pressure
    let r =
        if matches!(contact.parameters().profile, Profile::Cone { .. }) { 0.5 * exact.radius() } else { 0.0 };
    close_to(
        contact.pressure_at(r),
        exact.pressure(r),
        1e-9 + rim_rounding(exact),
        &format!("{what}: p({r})"),
    );
}

/// Relative error of √(a² − b²), and so of the pressure, that the rounding of a brings next to the rim of a blunted
/// sphere, where d = (a/R) √(a² − b²); 0 for the other shapes, whose pressure does not hang on it.
fn rim_rounding(exact: &NormalContact) -> f64 {
    match exact.shape() {
        Shape::BluntedSphere { radius, .. } => {
            4.0 * f64::EPSILON * (exact.radius().powi(2) / (exact.depth() * radius)).powi(2)
        }
        _ => 0.0,
    }
}

#[test]
fn force_control_meets_the_closed_forms_over_twelve_decades_at_any_resolution() {
    for profile in analytic() {
        for resolution in RESOLUTIONS {
            for force in forces() {
                let contact = under(&profile, NormalControl::Force, resolution, force);
                let exact = NormalContact::at_force(shape(&profile), E_STAR, force);
                assert_agrees(&contact, &exact, &format!("{profile:?}, {force} N, {resolution} cells"));
            }
        }
    }
}

#[test]
fn indentation_control_meets_the_closed_forms_over_twelve_decades_at_any_resolution() {
    for profile in analytic() {
        for resolution in RESOLUTIONS {
            for force in forces() {
                let exact = NormalContact::at_force(shape(&profile), E_STAR, force);
                let contact = under(&profile, NormalControl::Indentation, resolution, exact.depth());
                assert_agrees(&contact, &exact, &format!("{profile:?}, {force} N, {resolution} cells"));
            }
        }
    }
}

#[test]
fn the_two_controls_invert_each_other() {
    for profile in analytic() {
        for force in forces() {
            let by_force = under(&profile, NormalControl::Force, 64, force);
            let depth = by_force.indentation_depth();
            let by_depth = under(&profile, NormalControl::Indentation, 64, depth);
            close_to(by_depth.normal_reaction(), force, 1e-9, &format!("{profile:?}"));
            close_to(by_depth.contact_radius(), by_force.contact_radius(), 1e-9, &format!("{profile:?}"));
        }
    }
}

/// Between the axis and the edge the pressure of the shapes without antiderivative is a quadrature on both sides; at
/// r = 0.999 a next to the edge it has lost three digits.
#[test]
fn the_pressure_agrees_across_the_contact() {
    for profile in analytic() {
        let contact = under(&profile, NormalControl::Force, 64, FORCE);
        let exact = NormalContact::at_force(shape(&profile), E_STAR, FORCE);
        for share in [0.1, 0.3, 0.52, 0.7, 0.9, 0.999] {
            let r = share * exact.radius();
            let scale = exact.pressure(r).max(exact.mean_pressure());
            close(
                contact.pressure_at(r),
                exact.pressure(r),
                1e-9 * scale,
                &format!("{profile:?} at {share} a"),
            );
        }
        assert_eq!(contact.pressure_at(1.001 * exact.radius()), 0.0);
    }
}

/// The largest pressure is a maximum over places that include the axis: exact for the sphere, finite for the shapes whose
/// pressure is singular somewhere.
#[test]
fn the_largest_pressure_is_that_of_the_axis_under_a_sphere_and_finite_elsewhere() {
    let exact = NormalContact::at_force(shape(&BALL), E_STAR, FORCE);
    let ball = under(&BALL, NormalControl::Force, 64, FORCE);
    close_to(ball.max_pressure(), exact.central_pressure(), 1e-12, "p0");
    for profile in analytic() {
        let contact = under(&profile, NormalControl::Force, 64, FORCE);
        let mean = NormalContact::at_force(shape(&profile), E_STAR, FORCE).mean_pressure();
        assert!(contact.max_pressure().is_finite() && contact.max_pressure() > mean, "{profile:?}");
    }
}

/// The table's image is linear in x² between its points, as is that of a sphere: no matter how few points there are.
#[test]
fn a_sampled_sphere_is_a_sphere() {
    for points in [3, 9, 100] {
        let table = Profile::Table(sampled_sphere(points));
        for (control, normal) in [
            (NormalControl::Force, 1e-3),
            (NormalControl::Force, 100.0),
            (NormalControl::Force, 900.0),
            (NormalControl::Indentation, 2e-6),
        ] {
            let exact = match control {
                NormalControl::Force => NormalContact::at_force(shape(&BALL), E_STAR, normal),
                NormalControl::Indentation => NormalContact::at_depth(shape(&BALL), E_STAR, normal),
            };
            let contact = under(&table, control, 64, normal);
            assert_agrees(&contact, &exact, &format!("{points} points, {normal}"));
        }
    }
}

#[test]
fn no_load_or_a_pull_is_no_contact() {
    for profile in analytic() {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            for normal in [0.0, -1e-9, -100.0] {
                let contact = under(&profile, control, 64, normal);
                let values = [
                    contact.normal_reaction(),
                    contact.contact_radius(),
                    contact.max_pressure(),
                    contact.pressure_at(0.0),
                ];
                assert_eq!(values, [0.0; 4], "{profile:?} {control:?} {normal}");
            }
        }
    }
}

/// The table ends at 0.4 mm, where a sphere of 10 mm carries F = (4/3) E* a³/R = 984.6 N at d = 16 µm.
#[test]
fn a_load_beyond_the_table_is_refused_with_its_numbers_and_changes_nothing() {
    let table = Profile::Table(sampled_sphere(50));
    for (control, quantity, inside, beyond) in [
        (NormalControl::Force, "normal_force", 900.0, 1000.0),
        (NormalControl::Indentation, "indentation", 15e-6, 17e-6),
    ] {
        let parameters = Parameters { normal_control: control, ..without_wear(table.clone()) };
        let mut contact = contact(parameters);
        to(&mut contact, inside, 0.0);
        to(&mut contact, inside, 1e-6);
        let before = state(&contact);
        for attempt in [
            |c: &mut FrettingContact, n| c.advance_to(n, 1e-6),
            |c: &mut FrettingContact, n| c.advance_to(n, 2e-6),
            |c: &mut FrettingContact, n| c.start_at(n, 0.0),
            |c: &mut FrettingContact, n| c.advance_cycles(n, 1e-6, 10.0),
        ] {
            match attempt(&mut contact, beyond) {
                Err(Error::BeyondTable { quantity: named, value, radius }) => {
                    assert_eq!(named, quantity);
                    close_to(value, beyond, 1e-15, "the value named");
                    close_to(radius, 4e-4, 1e-15, "the radius named");
                }
                other => panic!("{other:?}"),
            }
            assert_eq!(state(&contact), before);
        }
        to(&mut contact, inside, 2e-6);
    }
}

/// A dent in the profile: its image falls from 0.2 mm on, which a contact may not reach.
#[test]
fn an_image_that_falls_is_refused_where_it_matters_and_only_there() {
    let dented = |r: f64| r * r / 0.02 - if r > 2e-4 { 0.6e-6 * ((r - 2e-4) / 6e-5).min(1.0) } else { 0.0 };
    let points = (0..=80).map(|i| 5e-6 * f64::from(i)).map(|r| (r, dented(r))).collect();
    let table = ProfileTable::new(points).expect("the points are in order");
    let fall = table.monotone_up_to();
    close(fall, 2e-4, 6e-6, "where the image starts to fall");
    let mut contact = contact(without_wear(Profile::Table(table)));
    to(&mut contact, FORCE, 0.0);
    to(&mut contact, FORCE, 1e-6);
    let exact = NormalContact::at_force(shape(&BALL), E_STAR, FORCE);
    close_to(contact.indentation_depth(), exact.depth(), 1e-9, "inside the dent it is a sphere");
    let before = state(&contact);
    match contact.advance_to(400.0, 1e-6) {
        Err(Error::NonMonotoneImage { radius, contact_radius }) => {
            assert_eq!(radius, fall);
            assert!(contact_radius > fall && contact_radius < 4e-4, "{contact_radius}");
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(state(&contact), before);
    to(&mut contact, 105.0, 0.5e-6);
}

/// Sizes beyond all that is built are refused where they are given, with the range that is computed with.
#[test]
fn sizes_beyond_what_is_computed_with_are_refused() {
    let refused = |change: &dyn Fn(&mut Parameters), name: &str| {
        let mut parameters = Parameters { wear_coefficient: 0.0, ..Parameters::default() };
        change(&mut parameters);
        match FrettingContact::new(parameters) {
            Err(Error::Parameter { name: found, requirement, .. }) => {
                assert_eq!(found, name);
                assert!(requirement.contains("1e"), "{requirement}");
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
    refused(&|p| p.hardness = 1e31, "hardness");
    refused(&|p| p.friction_coefficient = 1e10, "friction_coefficient");
    refused(&|p| p.wear_coefficient = 1e31, "wear_coefficient");
    refused(&|p| p.tolerance = 1e-13, "tolerance");
}

#[test]
fn loads_and_contacts_beyond_what_is_computed_with_are_refused() {
    let mut ball = contact(without_wear(BALL));
    ball.start_at(FORCE, 0.0).unwrap();
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

/// Every combination of sizes at the ends of their ranges, with and without slip: all that can be read is a number, but for the
/// pressure at singular points.
#[test]
fn the_ends_of_all_ranges_give_numbers_or_refusals() {
    let ends = [1e-30, 1.0, 1e30];
    let (mut sound, mut refused) = (0, 0);
    for size in ends {
        let profiles = ends.iter().flat_map(|&b| {
            [
                Profile::Parabola { radius: size },
                Profile::BluntedSphere { radius: size, flat_radius: b },
                Profile::RoundedPunch { radius: size, flat_radius: b },
                Profile::FlatPunch { flat_radius: b },
                Profile::Cone { slope: (1e-30 * size.max(1.0)).min(1.57) },
                Profile::PowerLaw { exponent: 0.1, coefficient: size },
                Profile::PowerLaw { exponent: 100.0, coefficient: size },
            ]
        });
        for profile in profiles {
            for (young, friction_coefficient) in
                ends.into_iter().flat_map(|e| [(e, 1e-300), (e, 0.6), (e, 1e9)])
            {
                for (control, load) in [1e-300, 1e-30, 1.0, 1e60]
                    .into_iter()
                    .flat_map(|load| [(NormalControl::Force, load), (NormalControl::Indentation, load)])
                {
                    let mut parameters = Parameters {
                        friction_coefficient,
                        normal_control: control,
                        resolution: 8,
                        ..without_wear(profile.clone())
                    };
                    parameters.materials.body_1.youngs_modulus = young;
                    let mut contact = contact(parameters);
                    for (load, place) in [(load, 0.0), (load, 1e-6), (0.5 * load, -1e60), (load, 1e-300)] {
                        match contact.advance_to(load, place) {
                            Ok(()) => sound += 1,
                            Err(_) => refused += 1,
                        }
                        let scalars = [
                            contact.tangential_force(),
                            contact.normal_reaction(),
                            contact.indentation_depth(),
                            contact.contact_radius(),
                            contact.stick_radius(),
                            contact.dissipated_energy(),
                            contact.max_pressure(),
                            contact.tangential_stiffness(),
                            contact.normal_stiffness(),
                        ];
                        assert!(
                            scalars.iter().all(|x| x.is_finite()),
                            "{:?}: {scalars:?}",
                            contact.parameters()
                        );
                        for r in contact.probe_radii().into_iter().step_by(9) {
                            let fields =
                                [contact.pressure_at(r), contact.shear_traction_at(r), contact.image_at(r)];
                            assert!(
                                !fields.iter().any(|x| x.is_nan()),
                                "{:?} at {r}: {fields:?}",
                                contact.parameters()
                            );
                        }
                    }
                }
            }
        }
    }
    println!("{sound} steps sound, {refused} refused");
    assert!(sound > 5 * refused);
}
