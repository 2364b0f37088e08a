//! Normal contact against the closed forms: depth, radius, force and pressure of every profile.

use crate::common::*;
use fretting_contact::reference::{NormalContact, Shape};
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters, Profile, ProfileTable};

const RESOLUTIONS: [usize; 3] = [8, 64, 512];

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

/// The unworn profile is analytic, so that neither resolution nor load matters: only rounding
/// (1e-12) and the quadrature of some pressures are left.
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

/// Relative error of √(a² − b²), and so of the pressure, that the rounding of a brings next to the
/// rim of a blunted sphere, where d = (a/R) √(a² − b²); 0 for the other shapes, whose pressure does
/// not hang on it.
fn rim_rounding(exact: &NormalContact) -> f64 {
    match exact.shape() {
        Shape::BluntedSphere { radius, .. } => {
            4.0 * f64::EPSILON * (exact.radius().powi(2) / (exact.depth() * radius)).powi(2)
        }
        _ => 0.0,
    }
}

/// Over twelve decades of load, at any resolution.
#[test]
fn force_control_meets_the_closed_forms() {
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

/// Over twelve decades of load, at any resolution.
#[test]
fn indentation_control_meets_the_closed_forms() {
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

/// Between the axis and the edge the pressure of the shapes without antiderivative is a quadrature
/// on both sides; at r = 0.999 a next to the edge it has lost three digits.
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

/// The largest pressure is a maximum over places that include the axis: exact for the sphere,
/// finite for the shapes whose pressure is singular somewhere.
#[test]
fn the_largest_pressure_is_finite() {
    let exact = NormalContact::at_force(shape(&BALL), E_STAR, FORCE);
    let ball = under(&BALL, NormalControl::Force, 64, FORCE);
    close_to(ball.max_pressure(), exact.central_pressure(), 1e-12, "p0");
    for profile in analytic() {
        let contact = under(&profile, NormalControl::Force, 64, FORCE);
        let mean = NormalContact::at_force(shape(&profile), E_STAR, FORCE).mean_pressure();
        assert!(contact.max_pressure().is_finite() && contact.max_pressure() > mean, "{profile:?}");
    }
}

/// The table's image is linear in x² between its points, as is that of a sphere: no matter how few
/// points there are.
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

/// The table ends at 0.4 mm, where a sphere of 10 mm carries F = (4/3) E* a³/R = 984.6 N at d = 16
/// µm.
#[test]
fn a_load_beyond_the_table_is_refused() {
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
    let (fall, depth, rough) = (table.monotone_up_to(), table.largest_fall(), table.roughness());
    close(fall, 2e-4, 6e-6, "where the image starts to fall");
    let image: Vec<f64> =
        (0..=4000).map(|i| Profile::Table(table.clone()).image(1e-7 * f64::from(i))).collect();
    let falls = image.iter().enumerate().map(|(i, g)| image[..i].iter().fold(0.0, |a: f64, b| a.max(*b)) - g);
    close(depth, falls.fold(0.0, f64::max), 1e-3 * depth, "by how much it falls");
    let mut contact = contact(without_wear(Profile::Table(table)));
    to(&mut contact, FORCE, 0.0);
    to(&mut contact, FORCE, 1e-6);
    let exact = NormalContact::at_force(shape(&BALL), E_STAR, FORCE);
    close_to(contact.indentation_depth(), exact.depth(), 1e-9, "inside the dent it is a sphere");
    let before = state(&contact);
    match contact.advance_to(400.0, 1e-6) {
        Err(Error::NonMonotoneImage { radius, contact_radius, fall: by, roughness }) => {
            assert_eq!((radius, by, roughness), (fall, depth, rough));
            assert!(contact_radius > fall && contact_radius < 4e-4, "{contact_radius}");
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(state(&contact), before);
    to(&mut contact, 105.0, 0.5e-6);
}
