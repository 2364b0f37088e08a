//! Elliptic contacts: Hertz' table, loops along both axes, the plane, the limit of a sphere.

use crate::common::{FORCE, MU, close_to, contact, seeded, started, state, uniform, without_wear};
use fretting_contact::reference::{AnisotropicRow, EllipticContact};
use fretting_contact::{
    Error, FrettingContact, HertzianEllipse, NormalControl, Parameters, Profile, SlipState,
};
use std::f64::consts::{PI, TAU};

const STEEL: [(f64, f64); 2] = [(210e9, 0.3); 2];
const RUBBER: (f64, f64) = (5e6, 0.49);

/// A ball in a groove, and a long ellipse.
const GROOVE: (f64, f64) = (0.020, 0.005);
const LONG: (f64, f64) = (0.130, 0.004);

fn ellipse((radius_x, radius_y): (f64, f64)) -> Profile {
    Profile::Ellipse { radius_x, radius_y }
}

fn turned((x, y): (f64, f64)) -> (f64, f64) {
    (y, x)
}

fn pressed(radii: (f64, f64)) -> FrettingContact {
    started(without_wear(ellipse(radii)))
}

fn exact(radii: (f64, f64)) -> EllipticContact {
    EllipticContact::at_force(radii, STEEL, FORCE)
}

fn force(contact: &FrettingContact) -> [f64; 2] {
    [contact.tangential_force(), contact.tangential_force_y()]
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn polar(size: f64, angle: f64) -> [f64; 2] {
    [size * angle.cos(), size * angle.sin()]
}

/// R in m, μ; b/a, R_e in mm, d in µm, a in mm, p₀ in MPa, u_max along the major and the minor axis
/// in µm, six digits each.
const TABLE: [((f64, f64), f64, [f64; 7]); 2] = [
    (GROOVE, 0.6, [0.399887, 10.8119, 3.39345, 0.287724, 1442.28, 2.56826, 2.37648]),
    (LONG, 0.15, [0.107327, 35.5069, 2.28299, 0.657184, 1030.05, 0.449235, 0.382427]),
];

#[test]
fn the_table_of_two_ellipses() {
    for (radii, friction_coefficient, expected) in TABLE {
        let parameters = Parameters { friction_coefficient, ..without_wear(ellipse(radii)) };
        let contact = started(parameters);
        let [a, b] = contact.contact_semi_axes();
        let full = contact.tangential_moduli().map(|modulus| {
            friction_coefficient * crate::common::E_STAR * contact.indentation_depth() / modulus * 1e6
        });
        let equivalent = HertzianEllipse::new(radii.0, radii.1).unwrap().equivalent_radius();
        let found = [
            b / a,
            equivalent * 1e3,
            contact.indentation_depth() * 1e6,
            a * 1e3,
            contact.max_pressure() / 1e6,
            full[0],
            full[1],
        ];
        for (found, expected) in found.into_iter().zip(expected) {
            close_to(found, expected, 4e-6, &format!("{radii:?}"));
        }
    }
}

/// The engine, by the arithmetic-geometric mean and the equivalent sphere, against Johnson's
/// formulas with the integrals by quadrature: for ratios up to the largest that is accepted, and
/// for unlike bodies.
#[test]
fn hertz_formulas_hold_for_any_ratio() {
    for ratio in [1.1, 2.0, 32.5, 1e3, 1e4, 1e6] {
        for materials in [STEEL, [(70e9, 0.33), (210e9, 0.3)], [RUBBER, STEEL[0]]] {
            let radii = (0.002 * ratio, 0.002);
            let reference = EllipticContact::at_force(radii, materials, FORCE);
            let elastic =
                |(youngs_modulus, poisson_ratio)| fretting_contact::Elastic { youngs_modulus, poisson_ratio };
            let materials =
                fretting_contact::Pair { body_1: elastic(materials[0]), body_2: elastic(materials[1]) };
            for along_x in [true, false] {
                let profile = ellipse(if along_x { radii } else { turned(radii) });
                let contact = started(Parameters { materials, ..without_wear(profile) });
                let by_axis = |major: f64, minor: f64| if along_x { [major, minor] } else { [minor, major] };
                let place = format!("{ratio} {along_x}");
                close_to(contact.indentation_depth(), reference.depth, 1e-11, &place);
                close_to(contact.max_pressure(), reference.central_pressure, 1e-11, &place);
                let expected = by_axis(reference.semi_major, reference.semi_minor);
                let moduli = by_axis(reference.tangential_moduli[0], reference.tangential_moduli[1]);
                for k in 0..2 {
                    close_to(contact.contact_semi_axes()[k], expected[k], 1e-11, &place);
                    close_to(contact.tangential_moduli()[k], moduli[k], 1e-11, &place);
                }
                close_to(contact.contact_radius(), (expected[0] * expected[1]).sqrt(), 1e-11, &place);
                let axis = usize::from(!along_x);
                close_to(contact.tangential_stiffness(), reference.tangential_stiffness(axis), 1e-11, &place);
            }
        }
    }
}

/// Pressure and traction over the ellipses of the shape of the contact, each by the circle of its
/// area, carry the forces.
#[test]
fn the_fields_carry_the_forces() {
    let mut contact = pressed(LONG);
    let reference = exact(LONG);
    contact.advance_to(FORCE, 0.6 * reference.shear(0, MU).full_slip).unwrap();
    let (radius, cells) = (contact.contact_radius(), 20_000);
    let integral = |field: &dyn Fn(f64) -> f64| {
        // r = a √(1 − t²) takes the root at the edge away
        let step = 1.0 / f64::from(cells);
        let at = |i: i32| {
            let t = (f64::from(i) + 0.5) * step;
            2.0 * PI * radius * radius * t * step * field(radius * (1.0 - t * t).sqrt())
        };
        (0..cells).map(at).sum::<f64>()
    };
    close_to(integral(&|r| contact.pressure_at(r)), FORCE, 1e-8, "pressure");
    close_to(integral(&|r| contact.shear_traction_at(r)), contact.tangential_force(), 1e-5, "traction");
    for share in [0.0f64, 0.3, 0.9] {
        let expected = reference.central_pressure * (1.0 - share * share).sqrt();
        close_to(contact.pressure_at(share * radius), expected, 1e-10, "Hertz");
    }
    // outside the stick region the traction is μ times the pressure
    let r = 0.5 * (contact.stick_radius() + radius);
    close_to(contact.shear_traction_at(r), MU * contact.pressure_at(r), 1e-9, "slip");
    assert_eq!(contact.probe_radii()[63], radius);
    assert_eq!(contact.slip_state(), SlipState::PartialSlip);
}

/// Readings of a contact that do not depend on how often they are read.
fn readings(contact: &FrettingContact) -> Vec<f64> {
    let [a, b] = contact.contact_semi_axes();
    let mut values = vec![
        contact.tangential_force(),
        contact.tangential_force_y(),
        contact.dissipated_energy() * 1e6,
        contact.stick_radius() * 1e6,
        contact.contact_radius() * 1e6,
        contact.tangential_stiffness() * 1e-6,
        contact.max_pressure() * 1e-6,
        a * 1e6,
        b * 1e6,
    ];
    values.extend(contact.probe_radii().map(|r| contact.pressure_at(r) * 1e-6));
    values.extend(contact.probe_radii().map(|r| contact.shear_traction_at(r) * 1e-6));
    values
}

#[test]
fn equal_radii_are_the_sphere() {
    let mut ellipse = pressed((0.01, 0.01));
    let mut sphere = started(without_wear(crate::common::BALL));
    let mut random = seeded(7);
    for k in 0..120 {
        let place = [uniform(&mut random, -3e-6, 3e-6), uniform(&mut random, -3e-6, 3e-6)];
        let load = uniform(&mut random, 60.0, 140.0);
        for contact in [&mut ellipse, &mut sphere] {
            // a line first, then the plane
            let place = if k < 60 { [place[0], 0.0] } else { place };
            contact.advance_to_planar(load, place).unwrap();
        }
        for (a, b) in readings(&ellipse).into_iter().zip(readings(&sphere)) {
            assert!((a - b).abs() <= 1e-12 * b.abs().max(100.0), "{k}: {a} {b}");
        }
    }
    assert_eq!(ellipse.counters(), sphere.counters());
}

/// Loading, stick region, reversal and the work of a cycle along the major and the minor axis, on a
/// line along x.
#[test]
fn loops_along_either_axis_are_those_of_its_modulus() {
    for radii in [GROOVE, LONG, (10.0, 0.01)] {
        for axis in 0..2 {
            let along_x = if axis == 0 { radii } else { turned(radii) };
            let law = exact(radii).shear(axis, MU);
            for share in [0.2, 0.5, 0.9, 1.0, 1.7] {
                let mut contact = pressed(along_x);
                let amplitude = share * law.full_slip;
                contact.advance_to(FORCE, amplitude).unwrap();
                let scale = law.friction_limit;
                assert!((contact.tangential_force() - law.loading(amplitude)).abs() < 1e-11 * scale);
                let stick = law.stick_ratio(amplitude) * contact.contact_radius();
                // the root of a rounding at full slip
                assert!((contact.stick_radius() - stick).abs() < 1e-6 * contact.contact_radius(), "{share}");
                close_to(
                    contact.dissipated_energy(),
                    0.25 * law.loop_work(amplitude),
                    1e-10,
                    "first quarter",
                );
                let before = contact.dissipated_energy();
                for k in 1..=40 {
                    let place = amplitude * (TAU * f64::from(k) / 40.0).cos();
                    contact.advance_to(FORCE, place).unwrap();
                    if k <= 20 {
                        let expected = law.returning(amplitude, place);
                        assert!((contact.tangential_force() - expected).abs() < 1e-11 * scale, "{share} {k}");
                    }
                }
                close_to(contact.dissipated_energy() - before, law.loop_work(amplitude), 1e-10, "cycle");
            }
        }
    }
}

/// The same along y, where the row is sampled: the error falls with the square of the number of
/// samples.
#[test]
fn loops_along_y_are_those_of_the_other_modulus() {
    for radii in [GROOVE, turned(LONG)] {
        let major = radii.0 < radii.1;
        let reference = exact(if major { turned(radii) } else { radii });
        let law = reference.shear(usize::from(!major), MU);
        let amplitude = 0.7 * law.full_slip;
        let error = |resolution: usize| {
            let mut contact = started(Parameters { resolution, ..without_wear(ellipse(radii)) });
            contact.advance_to_planar(FORCE, [0.0, amplitude]).unwrap();
            let first = (contact.tangential_force_y() / law.loading(amplitude) - 1.0).abs();
            let before = contact.dissipated_energy();
            for k in 1..=40 {
                let place = amplitude * (TAU * f64::from(k) / 40.0).cos();
                contact.advance_to_planar(FORCE, [0.0, place]).unwrap();
            }
            assert!(contact.tangential_force().abs() < 1e-12 * law.friction_limit);
            (first, ((contact.dissipated_energy() - before) / law.loop_work(amplitude) - 1.0).abs())
        };
        let (coarse, fine) = (error(64), error(256));
        println!("{radii:?}: {coarse:?} {fine:?}");
        assert!(coarse.0 < 5e-5 && coarse.1 < 2e-3, "{coarse:?}");
        assert!(fine.0 < 5e-6 && fine.1 < 2e-4, "{fine:?}");
        // from rest nothing slips along y yet
        let stiffness = pressed(radii).tangential_force_y_gradient().displacement_y;
        close_to(stiffness, reference.tangential_stiffness(usize::from(!major)), 1e-11, "stiffness");
    }
}

/// Many cycles in one call: amplitude of T and work by the closed form.
#[test]
fn cycles_in_one_call_follow_the_closed_form() {
    for (radii, axis) in [(GROOVE, 0), (turned(GROOVE), 1)] {
        let law = exact(GROOVE).shear(axis, MU);
        for share in [0.3, 0.8, 2.0] {
            let mut contact = pressed(radii);
            let amplitude = share * law.full_slip;
            contact.advance_cycles(FORCE, amplitude, 1000.0).unwrap();
            close_to(contact.tangential_force(), law.loading(amplitude), 1e-10, "amplitude of T");
            close_to(contact.dissipated_energy(), 1000.0 * law.loop_work(amplitude), 1e-10, "work");
        }
    }
}

/// Each spring carries at most its bound, |(G_x u_x, G_y u_y)| ≤ μE*(d − g), after any history; so
/// does their sum,
/// and friction never gives work back.
#[test]
fn springs_stay_within_their_bound_on_random_histories() {
    for (seed, radii) in [(1, GROOVE), (2, LONG), (3, turned(LONG)), (4, (100.0, 0.001))] {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            let parameters = Parameters { normal_control: control, ..without_wear(ellipse(radii)) };
            let mut contact = contact(parameters);
            let depth = exact(if radii.0 > radii.1 { radii } else { turned(radii) }).depth;
            let normal = if control == NormalControl::Force { FORCE } else { depth };
            contact.start_at(normal, 0.0).unwrap();
            let [along_x, along_y] = contact.tangential_moduli();
            let full = MU * crate::common::E_STAR * depth / along_x;
            let mut random = seeded(seed);
            let mut work = 0.0;
            for k in 0..150 {
                let place = polar(uniform(&mut random, 0.0, 2.0 * full), uniform(&mut random, 0.0, TAU));
                let load = normal * uniform(&mut random, if k % 40 == 39 { -0.5 } else { 0.3 }, 1.5);
                contact.advance_to_planar(load, place).unwrap();
                let limit = MU * contact.normal_reaction();
                assert!(norm(force(&contact)) <= limit * (1.0 + 1e-12), "{seed} {k}");
                assert!(contact.dissipated_energy() >= work * (1.0 - 1e-14), "{seed} {k}");
                work = contact.dissipated_energy();
                if k % 5 != 4 {
                    continue;
                }
                let saved = serde_json::to_value(contact.snapshot()).unwrap();
                let Some(knots) = saved.pointer("/state/row/plane/knots") else { continue };
                for knot in knots.as_array().unwrap() {
                    let number = |path: &str| knot.pointer(path).unwrap().as_f64().unwrap();
                    let pull = [
                        along_x * place[0] - along_x * number("/origin/0"),
                        along_y * place[1] - along_x * number("/origin/1"),
                    ];
                    let room = contact.indentation_depth() - number("/place/image");
                    let bound = MU * crate::common::E_STAR * room.max(0.0);
                    assert!(norm(pull) <= bound + 1e-9 * limit / contact.contact_radius(), "{seed} {k}");
                }
                let mut copy = contact.clone();
                copy.restore(&contact.snapshot()).unwrap();
            }
            assert!(work > 0.0);
        }
    }
}

/// An orbit with a varying load against springs that are moved in many small steps.
#[test]
fn an_orbit_is_that_of_a_row_of_springs_in_small_steps() {
    for (radii, share, swing) in [(GROOVE, 0.6, 0.0), (GROOVE, 1.3, 0.0), (turned(LONG), 0.8, 0.3)] {
        let equivalent = HertzianEllipse::new(radii.0, radii.1).unwrap().equivalent_radius();
        let parameters = Parameters {
            normal_control: NormalControl::Indentation,
            resolution: 128,
            ..without_wear(ellipse(radii))
        };
        let mut contact = contact(parameters);
        let depth = exact(if radii.0 > radii.1 { radii } else { turned(radii) }).depth;
        let moduli = contact.tangential_moduli();
        contact.start_at(depth, 0.0).unwrap();
        let largest = 1.2 * (equivalent * depth * (1.0 + swing)).sqrt();
        let mut row = AnisotropicRow::new(equivalent, (largest, 600), crate::common::E_STAR, moduli, MU);
        row.walk(depth, [0.0; 2], 1);
        let radius = share * MU * crate::common::E_STAR * depth / moduli[0];
        let limit = MU * contact.normal_reaction();
        let mut worst: f64 = 0.0;
        for k in 1..=72 {
            let phase = TAU * f64::from(k) / 36.0;
            let (place, to) = (polar(radius, phase), depth * (1.0 + swing * (0.5 * phase).sin()));
            contact.advance_to_planar(to, place).unwrap();
            row.walk(to, place, 60);
            let (found, expected) = (force(&contact), row.tangential_force());
            worst = worst.max(norm([found[0] - expected[0], found[1] - expected[1]]) / limit);
        }
        let work = contact.dissipated_energy() / row.work() - 1.0;
        println!("{radii:?} {share} {swing}: force {worst:e}, work {work:e}");
        // 60 explicit steps a corner and 600 springs
        assert!(worst < 1.5e-3 && work.abs() < 2e-3, "{radii:?} {share} {swing}: {worst:e} {work:e}");
    }
}

/// Coulomb: in gross slip the force is along the motion, whatever the stiffnesses are.
#[test]
fn in_steady_sliding_the_force_is_along_the_motion() {
    for angle in [0.3, 0.8, 2.0] {
        let mut contact = pressed(LONG);
        let far = 60.0 * exact(LONG).shear(0, MU).full_slip;
        contact.advance_to_planar(FORCE, polar(far, angle)).unwrap();
        let (found, expected) = (force(&contact), polar(MU * FORCE, angle));
        assert!(norm([found[0] - expected[0], found[1] - expected[1]]) < 1e-9 * MU * FORCE, "{found:?}");
        assert_eq!(contact.slip_state(), SlipState::GrossSlip);
        // going on, each way of length ds takes μF_N ds
        let before = contact.dissipated_energy();
        contact.advance_to_planar(FORCE, polar(2.0 * far, angle)).unwrap();
        close_to(contact.dissipated_energy() - before, MU * FORCE * far, 1e-9, "work");
    }
}

/// A rig in series along either axis: drive = own displacement + T/k, and the stiffness of both in
/// series.
#[test]
fn a_rig_is_in_series_along_both_axes() {
    let reference = exact(GROOVE);
    for axis in 0..2 {
        let law = reference.shear(axis, MU);
        let own_stiffness = reference.tangential_stiffness(axis);
        for rig_stiffness in [0.2 * own_stiffness, 3.0 * own_stiffness] {
            for in_plane in [false, true] {
                // along x the profile is turned; in the plane the drive moves along y
                let radii = if (axis == 0) != in_plane { GROOVE } else { turned(GROOVE) };
                let mut contact = started(Parameters { rig_stiffness, ..without_wear(ellipse(radii)) });
                let along = |value: f64| if in_plane { [0.0, value] } else { [value, 0.0] };
                let component = usize::from(in_plane);
                let first = if in_plane {
                    contact.tangential_force_y_gradient().displacement_y
                } else {
                    contact.tangential_force_gradient().displacement
                };
                let series = own_stiffness * rig_stiffness / (own_stiffness + rig_stiffness);
                close_to(first, series, 1e-11, "series");
                for share in [0.1, 0.5, 0.95] {
                    let own = share * law.full_slip;
                    let expected = law.loading(own);
                    contact.advance_to_planar(FORCE, along(own + expected / rig_stiffness)).unwrap();
                    let tolerance = if in_plane { 2e-5 } else { 1e-11 };
                    let error = (force(&contact)[component] - expected).abs() / law.friction_limit;
                    assert!(error < tolerance, "{axis} {in_plane} {share}: {error:e}");
                    let found = [contact.displacement(), contact.displacement_y()][component];
                    assert!((found - own).abs() < tolerance * law.full_slip);
                }
            }
        }
    }
}

/// The four derivatives of the force by the displacement against differences, in the plane, with
/// and without a rig.
#[test]
fn the_derivatives_are_those_of_differences() {
    for rig_stiffness in [f64::INFINITY, 2e7] {
        let parameters = Parameters { rig_stiffness, resolution: 512, ..without_wear(ellipse(LONG)) };
        let mut contact = started(parameters);
        let full = exact(LONG).shear(0, MU).full_slip;
        for (size, angle) in [(0.5, 0.7), (0.8, 0.2), (1.6, 1.1)] {
            contact.advance_to_planar(FORCE, polar(size * full, angle)).unwrap();
            let place = [contact.drive_displacement(), contact.drive_displacement_y()];
            let (x, y) = (contact.tangential_force_gradient(), contact.tangential_force_y_gradient());
            let energy = contact.dissipated_energy_gradient();
            let stick = contact.stick_radius_gradient();
            let step = 1e-4 * full;
            for turn in [-0.2, 0.0, 0.2] {
                let ahead = polar(step, (y_of(&contact)).atan2(x_of(&contact)) + turn);
                let mut moved = contact.clone();
                moved.advance_to_planar(FORCE, [place[0] + ahead[0], place[1] + ahead[1]]).unwrap();
                let predicted = |gradient: &fretting_contact::Gradient| {
                    gradient.displacement * ahead[0] + gradient.displacement_y * ahead[1]
                };
                let found = [
                    moved.tangential_force() - contact.tangential_force(),
                    moved.tangential_force_y() - contact.tangential_force_y(),
                ];
                let scale = step * x.displacement.max(y.displacement_y);
                let off = norm([found[0] - predicted(&x), found[1] - predicted(&y)]) / scale;
                assert!(off < 5e-3, "{rig_stiffness} {size} {turn}: {off:e}");
                let work = moved.dissipated_energy() - contact.dissipated_energy();
                assert!(
                    (work - predicted(&energy)).abs() < 5e-3 * MU * FORCE * step,
                    "{size} {turn}: {work:e}"
                );
                if stick.displacement != 0.0 {
                    let change = moved.stick_radius() - contact.stick_radius();
                    let off = (change - predicted(&stick)).abs() / change.abs();
                    assert!(off < 0.05, "{size} {turn}: {change:e} {}", predicted(&stick));
                }
            }
            // the matrix is symmetric: friction along the force is an associated law here
            assert!((x.displacement_y - y.displacement).abs() < 1e-9 * x.displacement.max(y.displacement_y));
        }
    }
}

/// Direction of the last motion of the body in the contact, which derivatives are taken for.
fn x_of(contact: &FrettingContact) -> f64 {
    direction(contact)[0]
}

fn y_of(contact: &FrettingContact) -> f64 {
    direction(contact)[1]
}

fn direction(contact: &FrettingContact) -> [f64; 2] {
    let saved = serde_json::to_value(contact.snapshot()).unwrap();
    [0, 1].map(|k| saved.pointer(&format!("/state/direction/{k}")).unwrap().as_f64().unwrap())
}

/// Semi-axes and radii follow the load.
#[test]
fn the_derivatives_of_the_semi_axes_follow_the_load() {
    let mut contact = pressed(GROOVE);
    contact.advance_to(FORCE, 1e-6).unwrap();
    let (before, gradients) = (contact.contact_semi_axes(), contact.contact_semi_axes_gradient());
    let radius = (contact.contact_radius(), contact.contact_radius_gradient());
    let stiffness = (contact.normal_stiffness(), contact.normal_stiffness_gradient());
    let pressure = (contact.max_pressure(), contact.max_pressure_gradient());
    contact.advance_to(FORCE * (1.0 + 1e-6), 1e-6).unwrap();
    let change = 1e-6 * FORCE;
    for k in 0..2 {
        let rate = (contact.contact_semi_axes()[k] - before[k]) / change;
        close_to(gradients[k].normal, rate, 1e-5, "semi-axis");
    }
    close_to(radius.1.normal, (contact.contact_radius() - radius.0) / change, 1e-5, "radius");
    close_to(stiffness.1.normal, (contact.normal_stiffness() - stiffness.0) / change, 1e-5, "stiffness");
    close_to(pressure.1.normal, (contact.max_pressure() - pressure.0) / change, 1e-5, "pressure");
}

/// A saved state goes on with the same bits, on the line and in the plane; one of other springs is
/// refused.
#[test]
fn a_restored_state_goes_on_with_the_same_bits() {
    for planar in [false, true] {
        let mut one = pressed(LONG);
        let mut random = seeded(11);
        let walk = |contact: &mut FrettingContact, random: &mut rand::rngs::StdRng| {
            for _ in 0..20 {
                let y = uniform(random, -2e-6, 2e-6);
                let place = [uniform(random, -2e-6, 2e-6), if planar { y } else { 0.0 }];
                contact.advance_to_planar(uniform(random, 50.0, 150.0), place).unwrap();
            }
        };
        walk(&mut one, &mut random);
        let text = serde_json::to_string(&one.snapshot()).unwrap();
        let mut other = pressed(LONG);
        other.restore(&serde_json::from_str(&text).unwrap()).unwrap();
        let mut random = (seeded(12), seeded(12));
        walk(&mut one, &mut random.0);
        walk(&mut other, &mut random.1);
        assert_eq!(state(&one), state(&other));
        // along y it is stiffer: springs that are deflected as far along y are beyond their bound
        let mut sphere = started(without_wear(Profile::Parabola { radius: 0.01 }));
        assert!(matches!(sphere.restore(&one.snapshot()), Err(Error::Snapshot(_))));
    }
}

/// Less friction: springs slip back along their force, and friction takes what they lose.
#[test]
fn another_coefficient_of_friction_counts_from_now_on() {
    for planar in [false, true] {
        let mut contact = pressed(GROOVE);
        let full = exact(GROOVE).shear(0, MU).full_slip;
        let place = if planar { polar(0.8 * full, 0.6) } else { [0.8 * full, 0.0] };
        contact.advance_to_planar(FORCE, place).unwrap();
        let work = contact.dissipated_energy();
        contact.retune(0.3, 0.0).unwrap();
        assert!(norm(force(&contact)) <= 0.3 * FORCE * (1.0 + 1e-12));
        assert!(contact.dissipated_energy() > work);
        if !planar {
            let law = exact(GROOVE).shear(0, 0.3);
            close_to(contact.tangential_force(), law.loading(place[0]), 1e-10, "as if it had been so");
        }
        let refused = contact.retune(0.3, 1e-4);
        assert!(matches!(refused, Err(Error::Parameter { name: "wear_coefficient", .. })), "{refused:?}");
    }
}

/// No worn shape: refused with what to do in its place.
#[test]
fn wear_is_refused_and_the_message_says_what_to_do() {
    let parameters = Parameters { profile: ellipse(GROOVE), ..Parameters::default() };
    let message = FrettingContact::new(parameters).unwrap_err().to_string();
    for part in ["wear_coefficient = 0.00032", "set wear_coefficient = 0", "dissipated_energy"] {
        assert!(message.contains(part), "{message}");
    }
    for radii in [(0.0, 0.01), (0.01, f64::NAN), (1e5, 1e-3), (1e-3, 1e5)] {
        let error = FrettingContact::new(without_wear(ellipse(radii))).unwrap_err();
        assert!(matches!(error, Error::Parameter { name: "radius_x" | "radius_y", .. }), "{error}");
    }
}

/// Parameters of an ellipse survive their text.
#[test]
fn parameters_have_a_text() {
    let parameters = without_wear(ellipse(GROOVE));
    let text = serde_json::to_string(&parameters).unwrap();
    assert!(text.contains(r#""ellipse":{"radius_x":0.02,"radius_y":0.005}"#), "{text}");
    assert_eq!(serde_json::from_str::<Parameters>(&text).unwrap(), parameters);
}

/// The same motion of the same body, seen from axes that are exchanged.
#[test]
fn the_slip_along_y_is_that_of_the_turned_body_along_x() {
    let mut along_x = pressed(turned(LONG));
    let mut along_y = pressed(LONG);
    let full = MU * along_x.indentation_depth() * 1.2;
    for place in [0.6 * full, -0.4 * full] {
        along_x.advance_to(FORCE, place).unwrap();
        along_y.advance_to_planar(FORCE, [0.0, place]).unwrap();
        let most = along_x.slip_amplitude_at(0.999 * along_x.contact_radius());
        assert!(most > 0.2 * place.abs(), "{most} of {place}");
        for share in [0.3, 0.7, 0.9, 0.99] {
            let r = share * along_x.contact_radius();
            let (x, y) = (along_x.slip_amplitude_at(r), along_y.slip_amplitude_at(r));
            assert!((x - y).abs() < 1e-3 * most, "{share}: {x:e} along x, {y:e} along y");
        }
    }
}
