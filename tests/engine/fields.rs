//! Fields at the probes: worn height, slip of the last stroke, friction work per area.

use crate::common::*;
use fretting_contact::{Error, FrettingContact, NormalControl, Parameters};
use rand::RngExt;

/// m = μE*/G*, and the radius of the ball, m.
const SLOPE: f64 = MU * E_STAR / G_STAR;
const RADIUS: f64 = 0.01;

/// Slip of a ball at r in a first stroke to u (m), by the slip |u| − m (d − x²/R) of the springs:
/// (2/π) ∫ from c to r of m (x² − c²)/R dx/√(r² − x²) = (2m/πR) ((r²/2 − c²) arccos(c/r) +
/// c √(r² − c²)/2), in gross slip u − m (d − r²/(2R)).
fn first_stroke(r: f64, u: f64, depth: f64) -> f64 {
    let stick = RADIUS * (depth - u / SLOPE);
    if stick <= 0.0 {
        return u - SLOPE * (depth - r * r / (2.0 * RADIUS));
    }
    let c = stick.sqrt();
    if r <= c {
        return 0.0;
    }
    let rest = (r * r - c * c).sqrt();
    2.0 * SLOPE / (std::f64::consts::PI * RADIUS) * ((0.5 * r * r - c * c) * (c / r).acos() + 0.5 * c * rest)
}

/// Compares the slip at probes inside the contact with `exact`, relative to `scale`, m.
fn slips_as(contact: &FrettingContact, exact: impl Fn(f64) -> f64, scale: f64, what: &str) {
    let a = contact.contact_radius();
    for k in 0..=20 {
        let r = a * f64::from(k) / 20.0;
        let (slip, exact) = (contact.slip_amplitude_at(r), exact(r));
        assert!((slip - exact).abs() <= 1e-8 * scale, "{what}: {slip:e} against {exact:e} at {r:e} m");
    }
    assert_eq!(contact.slip_amplitude_at(1.01 * a), 0.0, "{what}: outside");
}

#[test]
fn the_slip_of_a_stroke_has_mindlins_form() {
    let mut contact = pressed(BALL, FORCE);
    let depth = contact.indentation_depth();
    slips_as(&contact, |_| 0.0, 1e-6, "at rest");
    let full = SLOPE * depth;
    for (u, what) in [(0.3 * full, "partial slip"), (0.9 * full, "more of it"), (2.0 * full, "gross slip")] {
        to(&mut contact, FORCE, u);
        slips_as(&contact, |r| first_stroke(r, u, depth), u, what);
    }
    // a stroke back by 2v is twice one of v from rest, however many steps it takes
    let start = 2.0 * full;
    for share in [0.1, 0.5, 0.8, 1.7] {
        to(&mut contact, FORCE, start - 2.0 * share * full);
        slips_as(&contact, |r| 2.0 * first_stroke(r, share * full, depth), full, "a stroke back");
    }
    // and back again, within the last stroke
    let end = start - 3.4 * full;
    to(&mut contact, FORCE, end + full);
    slips_as(&contact, |r| 2.0 * first_stroke(r, 0.5 * full, depth), full, "to and fro");
}

#[test]
fn cycles_have_the_amplitude_of_the_slip() {
    let mut contact = contact(without_wear(BALL));
    for share in [0.4, 1.5] {
        contact.advance_cycles(FORCE, share * 2e-6, 3.0).unwrap();
        let depth = contact.indentation_depth();
        slips_as(&contact, |r| first_stroke(r, share * 2e-6, depth), 1e-6, "cycles");
    }
}

#[test]
fn a_line_in_any_direction_slips_the_same() {
    let (sin, cos) = 0.7_f64.sin_cos();
    let mut line = pressed(BALL, FORCE);
    let mut turned = pressed(BALL, FORCE);
    for u in [1.5e-6, 0.5e-6, -1.2e-6, -1.0e-6] {
        to(&mut line, FORCE, u);
        turned.advance_to_planar(FORCE, [u * cos, u * sin]).unwrap();
        let a = line.contact_radius();
        for k in 0..=10 {
            let r = a * f64::from(k) / 10.0;
            let (slip, exact) = (turned.slip_amplitude_at(r), line.slip_amplitude_at(r));
            // the row in the plane is sampled at 128 radii
            assert!((slip - exact).abs() <= 2e-3 * 1.5e-6, "{u:e}: {slip:e} against {exact:e} at {r:e}");
        }
    }
}

/// Pressed on along a line of load and displacement that is too steep for slip, all springs stick
/// where they touch.
#[test]
fn springs_that_touch_along_a_line_have_not_slipped() {
    let mut contact =
        contact(Parameters { normal_control: NormalControl::Indentation, ..without_wear(BALL) });
    contact.start_at(1e-9, 0.0).unwrap();
    to(&mut contact, 2e-6, 0.5 * SLOPE * 2e-6);
    let a = contact.contact_radius();
    for k in 0..=10 {
        let slip = contact.slip_amplitude_at(a * f64::from(k) / 10.0);
        assert!(slip <= 2e-3 * 1e-6, "{slip:e}");
    }
}

/// Worn depth of slow wear: (k/σ₀) μ p s 4N, with the slip of the closed form.
#[test]
fn energy_density_is_traction_times_slip() {
    let amplitude = 1.5e-6;
    let mut contact = contact(Parameters { wear_coefficient: 1e-9, ..without_wear(BALL) });
    contact.advance_cycles(FORCE, amplitude, 10.0).unwrap();
    let (a, depth) = (contact.contact_radius(), contact.indentation_depth());
    let stick = (RADIUS * (depth - amplitude / SLOPE)).max(0.0).sqrt();
    let mut checked = 0;
    for k in 1..20 {
        let r = a * f64::from(k) / 20.0;
        let pressure = 1.5 * FORCE / (std::f64::consts::PI * a * a) * (1.0 - r * r / (a * a)).sqrt();
        let exact = 40.0 * MU * pressure * first_stroke(r, amplitude, depth);
        let density = contact.energy_density_at(r).expect("it wears by constant coefficients");
        assert!((density - exact).abs() <= 5e-3 * 40.0 * MU * 1.4e9 * 0.3e-6, "{density} {exact} at {r:e}");
        checked += usize::from(r > stick && density > 0.0);
    }
    assert!(checked >= 5);
}

/// ∫ 2πr A dr is the work of friction.
#[test]
fn the_work_per_area_adds_up_to_the_work() {
    let parameters = Parameters { wear_coefficient: 0.02, probe_radius_max: 3e-4, ..without_wear(BALL) };
    let mut contact = started(parameters);
    for u in [2e-6, -2e-6, 2e-6, -1e-6, 2e-6] {
        to(&mut contact, FORCE, u);
    }
    let count = 4000;
    let cell = 3e-4 / f64::from(count);
    let work: f64 = (0..count)
        .map(|k| {
            let r = (f64::from(k) + 0.5) * cell;
            2.0 * std::f64::consts::PI * r * cell * contact.energy_density_at(r).unwrap()
        })
        .sum();
    close_to(work, contact.dissipated_energy(), 5e-3, "work");
}

/// A wear coefficient so small that nothing wears gathers the work per area, and changes no force.
#[test]
fn next_to_no_wear_gives_the_work_per_area() {
    let (mut free, mut contact) =
        (pressed(BALL, FORCE), started(Parameters { wear_coefficient: 1e-12, ..without_wear(BALL) }));
    for k in 0..400 {
        let (force, u) =
            (FORCE * (1.0 + 0.02 * (0.21 * f64::from(k)).cos()), 3e-6 * (0.3 * f64::from(k)).sin());
        to(&mut free, force, u);
        to(&mut contact, force, u);
        close_to(contact.tangential_force(), free.tangential_force(), 1e-3, "T");
    }
    close_to(contact.dissipated_energy(), free.dissipated_energy(), 1e-3, "work");
    assert_eq!(contact.counters().profile_updates, 0);
    let (count, outer) = (4000, contact.contact_radius() * 1.2);
    let cell = outer / f64::from(count);
    let ring = |k: u32| {
        let r = (f64::from(k) + 0.5) * cell;
        2.0 * std::f64::consts::PI * r * cell * contact.energy_density_at(r).unwrap()
    };
    close_to((0..count).map(ring).sum::<f64>(), contact.dissipated_energy(), 5e-3, "sum");
    let smooth = contact_of(0.0);
    assert_eq!(smooth.energy_density_at(1e-4), Some(0.0), "without friction there is no work");
}

/// The ball with wear and a coefficient of friction.
fn contact_of(friction_coefficient: f64) -> FrettingContact {
    started(Parameters { friction_coefficient, wear_coefficient: 0.02, ..without_wear(BALL) })
}

#[test]
fn work_per_area_is_given_only_where_it_is_known() {
    let mut free = pressed(BALL, FORCE);
    to(&mut free, FORCE, 3e-6);
    assert!(free.dissipated_energy() > 0.0);
    assert_eq!(free.energy_density_at(1e-4), None, "without wear");
    let mut contact = started(Parameters { wear_coefficient: 0.02, ..without_wear(BALL) });
    // before anything has worn, and a change of friction alone
    contact.retune(MU, 0.03).unwrap();
    to(&mut contact, FORCE, 3e-6);
    contact.retune(0.5, 0.03).unwrap();
    to(&mut contact, FORCE, -3e-6);
    let density = contact.energy_density_at(1.5e-4).expect("one ratio");
    close_to(density, contact.worn_depth_at(1.5e-4) / (0.03 / 8e9), 1e-12, "A");
    contact.retune(0.5, 0.01).unwrap();
    assert_eq!(contact.energy_density_at(1.5e-4), None, "two ratios");
}

#[test]
fn the_height_is_the_unworn_profile_and_the_depth_of_both_bodies() {
    let two = Parameters {
        wear_coefficient: 0.02,
        wear_coefficient_2: 0.02,
        hardness_2: 8e9,
        ..without_wear(BALL)
    };
    let mut contact = contact(two);
    contact.advance_cycles(FORCE, 1.5e-6, 100.0).unwrap();
    assert!(contact.wear_depth() > 0.0);
    for r in contact.probe_radii() {
        let height = r * r / (2.0 * RADIUS) + contact.worn_depth_at(r);
        close_to(contact.profile_height_at(r).max(1e-30), height.max(1e-30), 1e-12, "f");
    }
}

#[test]
fn fixed_probes_stay() {
    let parameters = Parameters { wear_coefficient: 0.02, probe_radius_max: 2.5e-4, ..without_wear(BALL) };
    let mut fixed = contact(parameters.clone());
    let mut following = contact(Parameters { probe_radius_max: 0.0, ..parameters });
    let before = fixed.probe_radii();
    assert_eq!((before[0], before[63]), (0.0, 2.5e-4));
    for contact in [&mut fixed, &mut following] {
        contact.advance_cycles(FORCE, 2e-6, 1000.0).unwrap();
    }
    assert_eq!(fixed.probe_radii(), before);
    assert_eq!(following.probe_radii()[63], following.contact_radius());
    // what is computed does not depend on where it is read
    assert_eq!(fixed.wear_depth(), following.wear_depth());
    assert_eq!(fixed.wear_depth_gradient(), following.wear_depth_gradient());
    let punch = contact(Parameters { profile: PUNCH, probe_radius_max: 1.0, ..Parameters::default() });
    assert_eq!(punch.probe_radii()[63], 1e-4, "no farther than the body");
    for probe_radius_max in [-1e-6, f64::NAN, f64::INFINITY, 1e31] {
        match (Parameters { probe_radius_max, ..Parameters::default() }).validate() {
            Err(Error::Parameter { name, .. }) => assert_eq!(name, "probe_radius_max"),
            other => panic!("{probe_radius_max}: {other:?}"),
        }
    }
}

#[test]
fn random_histories_give_finite_slip_and_keep_it_when_saved() {
    let mut random = seeded(5);
    for (profile, wear_coefficient, rig_stiffness) in
        [(BALL, 0.0, f64::INFINITY), (CONE, 0.0, 3e7), (ROUNDED, 0.02, f64::INFINITY), (PUNCH, 0.0, 3e7)]
    {
        let parameters = Parameters { wear_coefficient, rig_stiffness, ..without_wear(profile.clone()) };
        let mut contact = started(parameters.clone());
        for step in 0..30 {
            let force = random.random_range(-20.0..150.0);
            let y = if step > 15 { random.random_range(-2e-6..2e-6) } else { 0.0 };
            contact.advance_to_planar(force, [random.random_range(-3e-6..3e-6), y]).unwrap();
            let mut again = crate::common::contact(parameters.clone());
            again.restore(&contact.snapshot()).unwrap();
            for r in contact.probe_radii() {
                let slip = contact.slip_amplitude_at(r);
                assert!((0.0..1e-4).contains(&slip), "{profile:?} {step}: {slip:e} at {r:e} m");
                assert_eq!(again.slip_amplitude_at(r), slip);
            }
        }
    }
}

/// A step that is refused leaves the stroke as it was.
#[test]
fn a_refused_step_keeps_the_stroke() {
    let mut contact = started(without_wear(fretting_contact::Profile::Table(sampled_sphere(200))));
    to(&mut contact, FORCE, 1e-6);
    let slip = contact.slip_amplitude_at(1.7e-4);
    assert!(slip > 0.0);
    assert!(contact.advance_to(1e9, -1e-6).is_err());
    assert!(contact.advance_to_planar(1e9, [-1e-6, 1e-6]).is_err());
    assert_eq!(contact.slip_amplitude_at(1.7e-4), slip);
}
