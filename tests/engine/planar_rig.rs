//! A spring in series with a contact that moves in both tangential directions, as stiff along y as
//! along x. Both carry the same force, so that closed forms of the contact, and of springs in
//! series, are those of the pair.

use crate::common::{self, *};
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile};
use std::f64::consts::TAU;

/// μF_N of the usual scene, N.
const LIMIT: f64 = MU * FORCE;

/// Stiffness of the rig over that of the sticking contact.
const RATIOS: [f64; 3] = [0.1, 1.0, 20.0];

fn polar(size: f64, angle: f64) -> [f64; 2] {
    [size * angle.cos(), size * angle.sin()]
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn force(contact: &FrettingContact) -> [f64; 2] {
    [contact.tangential_force(), contact.tangential_force_y()]
}

fn drive(contact: &FrettingContact) -> [f64; 2] {
    [contact.drive_displacement(), contact.drive_displacement_y()]
}

/// A contact behind a rig, its prescribed normal quantity, and 1/k_rig.
fn behind(
    profile: &Profile,
    (control, ratio): (NormalControl, f64),
    parameters: Parameters,
) -> (FrettingContact, f64, f64) {
    let normal = exact(profile, FORCE).normal;
    let rig_stiffness = ratio * 2.0 * G_STAR * normal.radius();
    let parameters =
        Parameters { profile: profile.clone(), normal_control: control, rig_stiffness, ..parameters };
    let value = if control == NormalControl::Force { FORCE } else { normal.depth() };
    let mut contact = contact(parameters);
    contact.start_at(value, 0.0).expect("the load is carried");
    (contact, value, 1.0 / rig_stiffness)
}

fn unworn() -> Parameters {
    Parameters { wear_coefficient: 0.0, ..Parameters::default() }
}

#[track_caller]
fn goes_to(contact: &mut FrettingContact, normal: f64, target: [f64; 2]) {
    contact.advance_to_planar(normal, target).expect("the line can be walked");
}

/// The same strokes on a line at an angle and along x, in partial and gross slip, under a load that
/// stays or varies.
#[test]
fn a_line_at_any_angle_is_the_line_along_x() {
    for profile in [BALL, CONE, ROUNDED, PUNCH] {
        for ratio in RATIOS {
            for (angle, swing) in [(0.5, 0.0), (-1.5, 0.0), (2.2, 0.4)] {
                let (mut line, _, compliance) = behind(&profile, (NormalControl::Force, ratio), unworn());
                let mut plane = line.clone();
                let reach = 1.3 * exact(&profile, FORCE).full_slip() + compliance * LIMIT;
                let mut worst = 0.0f64;
                for k in 1..=120 {
                    let phase = TAU * f64::from(k) / 40.0;
                    let stroke = reach * f64::from(k) / 100.0 * phase.sin();
                    let load = FORCE * (1.0 + swing * (0.7 * phase).sin());
                    to(&mut line, load, stroke);
                    goes_to(&mut plane, load, polar(stroke, angle));
                    let off = difference(force(&plane), polar(line.tangential_force(), angle));
                    worst = worst.max(norm(off) / LIMIT);
                    let slack = 1e-12 * (reach + compliance * LIMIT);
                    let gone = norm(difference(drive(&plane), polar(stroke, angle)));
                    assert!(gone <= slack, "{profile:?}, rig {ratio}: the drive is {gone:e} off");
                    let limit = MU * plane.normal_reaction();
                    assert!(norm(force(&plane)) <= limit * (1.0 + 1e-12));
                }
                let work = plane.dissipated_energy() / line.dissipated_energy() - 1.0;
                println!("{profile:?}, rig {ratio}, {angle}, ±{swing}: T {worst:.1e}, W {work:.1e}");
                // 128 samples: see the row's own tests
                assert!(worst < 5e-4 && work.abs() < 5e-4, "{profile:?}, {ratio}: {worst:e}, {work:e}");
            }
        }
    }
}

/// Nothing slips under a punch: **T** = **D** k k_rig/(k + k_rig) on any orbit.
#[test]
fn an_orbit_in_full_stick_is_that_of_springs_in_series() {
    for ratio in RATIOS {
        let (mut contact, normal, compliance) = behind(&PUNCH, (NormalControl::Force, ratio), unworn());
        let stiffness = 2.0 * G_STAR * 1e-4;
        let pair = stiffness / (1.0 + compliance * stiffness);
        let radius = 0.4 * LIMIT / pair;
        for k in 1..=30 {
            let target = difference(polar(radius, 0.4 * f64::from(k)), [radius, 0.0]);
            goes_to(&mut contact, normal, target);
            let off = norm(difference(force(&contact), target.map(|part| pair * part)));
            assert!(off <= 1e-11 * LIMIT, "rig {ratio}, step {k}: {off:e}");
        }
        close(contact.dissipated_energy(), 0.0, 1e-12 * LIMIT * radius, "W");
    }
}

/// All of a punch slips as one spring. On a circle of the drive, R, what slips follows on one of
/// radius √(R² − e²), with e = μF_N/k of the pair: the force points along the tangent of that, e
/// behind the drive.
#[test]
fn a_punch_that_slips_follows_the_drive_on_a_smaller_circle() {
    for ratio in RATIOS {
        let error = |steps: u32| {
            let (mut contact, normal, compliance) = behind(&PUNCH, (NormalControl::Force, ratio), unworn());
            let stretch = LIMIT * (compliance + 1.0 / (2.0 * G_STAR * 1e-4));
            let radius = 1.5 * stretch;
            for k in 0..=8 * steps {
                goes_to(&mut contact, normal, polar(radius, TAU * f64::from(k) / f64::from(steps)));
            }
            let smaller = (radius * radius - stretch * stretch).sqrt();
            let slipping = polar(smaller, -(smaller / radius).acos());
            let expected = difference([radius, 0.0], slipping).map(|part| part / stretch * LIMIT);
            norm(difference(force(&contact), expected)) / LIMIT
        };
        let errors = [30, 60, 120].map(error);
        println!("rig {ratio}: {errors:?}");
        // the drive goes along chords
        assert!(errors[2] < 1e-3 && errors[0] / errors[2] > 10.0, "rig {ratio}: {errors:?}");
    }
}

/// Over a steady orbit of the drive its work ∮**T**·d**D** is that of friction, for rig and contact
/// give back what they store.
#[test]
fn the_work_of_the_drive_over_an_orbit_is_that_of_friction() {
    for profile in [BALL, ROUNDED] {
        for ratio in RATIOS {
            for control in [NormalControl::Force, NormalControl::Indentation] {
                let (mut contact, normal, compliance) = behind(&profile, (control, ratio), unworn());
                let radius = 0.6 * exact(&profile, FORCE).full_slip() + 0.7 * compliance * LIMIT;
                goes_to(&mut contact, normal, [radius, 0.0]);
                let steps = 240;
                let (mut driven, mut before, mut last) = (0.0, 0.0, [0.0; 2]);
                for k in 1..=3 * steps {
                    if k == 2 * steps + 1 {
                        (driven, before, last) = (0.0, contact.dissipated_energy(), force(&contact));
                    }
                    let from = drive(&contact);
                    goes_to(&mut contact, normal, polar(radius, TAU * f64::from(k) / f64::from(steps)));
                    let (now, way) = (force(&contact), difference(drive(&contact), from));
                    driven += 0.5 * ((last[0] + now[0]) * way[0] + (last[1] + now[1]) * way[1]);
                    last = now;
                    assert!(norm(now) <= MU * contact.normal_reaction() * (1.0 + 1e-12));
                }
                let lost = contact.dissipated_energy() - before;
                println!("{profile:?}, {control:?}, rig {ratio}: {:.1e}", driven / lost - 1.0);
                close_to(driven, lost, 1e-3, &format!("{profile:?}, {control:?}, rig {ratio}"));
            }
        }
    }
}

/// An orbit of the drive in steps of 30°, each a chord, and in twentieths of them.
#[test]
fn a_step_may_be_split() {
    for profile in [BALL, CONE] {
        for ratio in RATIOS {
            for swing in [0.0, 0.3] {
                let (mut whole, _, compliance) = behind(&profile, (NormalControl::Force, ratio), unworn());
                let mut split = whole.clone();
                let radius = 0.6 * exact(&profile, FORCE).full_slip() + 0.7 * compliance * LIMIT;
                let mut from = (FORCE, [0.0; 2]);
                let mut worst = 0.0f64;
                for k in 1..=40 {
                    let phase = TAU * f64::from(k) / 12.0;
                    let target = (FORCE * (1.0 + swing * phase.sin()), polar(radius, phase));
                    goes_to(&mut whole, target.0, target.1);
                    for part in 1..=20 {
                        let share = f64::from(part) / 20.0;
                        let mix = |a: f64, b: f64| if part == 20 { b } else { a + share * (b - a) };
                        let place = [0, 1].map(|i| mix(from.1[i], target.1[i]));
                        goes_to(&mut split, mix(from.0, target.0), place);
                    }
                    from = target;
                    worst = worst.max(norm(difference(force(&whole), force(&split))) / LIMIT);
                }
                let work = whole.dissipated_energy() / split.dissipated_energy() - 1.0;
                println!(
                    "{profile:?}, rig {ratio}, ±{swing}: T {worst:.1e}, W {work:.1e}, {}",
                    whole.counters()
                );
                assert!(worst < 3e-4, "{profile:?}, rig {ratio}, ±{swing}: {worst:e}");
                let walks = whole.counters().spring_walks / whole.counters().steps;
                assert!(walks <= 50, "{profile:?}, rig {ratio}, ±{swing}: {walks} walks a step");
                assert!(work.abs() < 1.5e-3, "{profile:?}, rig {ratio}, ±{swing}: W {work:e}");
            }
        }
    }
}

/// Long steps of the drive in any direction, while the load varies by half or falls to little: the
/// count of walks, and the force and the work against steps cut into 40.
#[test]
fn long_steps_take_few_walks() {
    for (profile, ratio, most) in
        [(BALL, 0.02, 160), (BALL, 1.0, 40), (BALL, 20.0, 25), (PUNCH, 0.02, 160), (PUNCH, 1.0, 40)]
    {
        for swing in [0.5, 0.98] {
            let (mut whole, _, compliance) = behind(&profile, (NormalControl::Force, ratio), unworn());
            let mut split = whole.clone();
            let reach = 1.2 * exact(&profile, FORCE).full_slip() + compliance * LIMIT;
            let mut random = seeded(7);
            let mut from = (FORCE, [0.0; 2]);
            let mut worst = 0.0f64;
            for _ in 0..24 {
                let load = FORCE * (1.0 - swing * uniform(&mut random, 0.0, 1.0));
                let place = polar(uniform(&mut random, 0.3, 1.0) * reach, uniform(&mut random, 0.0, TAU));
                goes_to(&mut whole, load, place);
                for part in 1..=40 {
                    let share = f64::from(part) / 40.0;
                    let mix = |a: f64, b: f64| if part == 40 { b } else { a + share * (b - a) };
                    let between = [0, 1].map(|i| mix(from.1[i], place[i]));
                    goes_to(&mut split, mix(from.0, load), between);
                }
                from = (load, place);
                worst = worst.max(norm(difference(force(&whole), force(&split))) / LIMIT);
            }
            let work = whole.dissipated_energy() / split.dissipated_energy() - 1.0;
            let walks = whole.counters().spring_walks / whole.counters().steps;
            let what =
                format!("{profile:?}, rig {ratio}, -{swing}: T {worst:.1e}, W {work:.1e}, {walks} walks");
            println!("{what}");
            assert!(walks <= most, "{what}");
            assert!(worst < 5e-4 && work.abs() < 1e-3, "{what}");
        }
    }
}

/// While friction runs in, the bound goes on from piece to piece of a line of load and drive.
#[test]
fn a_step_may_be_split_while_friction_runs_in() {
    for (control, ratio) in [(NormalControl::Force, 1.0), (NormalControl::Indentation, 20.0)] {
        let (_, _, compliance) = behind(&BALL, (control, ratio), unworn());
        let reach = 0.8 * exact(&BALL, FORCE).full_slip() + 0.8 * compliance * LIMIT;
        let parameters = Parameters {
            friction_coefficient_final: 0.9,
            running_in_energy: 3.0 * LIMIT * exact(&BALL, FORCE).full_slip(),
            ..unworn()
        };
        let (mut whole, normal, _) = behind(&BALL, (control, ratio), parameters);
        let mut split = whole.clone();
        let mut from = (normal, [0.0; 2]);
        for k in 1..=30 {
            let phase = TAU * f64::from(k) / 12.0;
            let to = (normal * (1.0 + 0.3 * phase.sin()), polar(reach, phase));
            goes_to(&mut whole, to.0, to.1);
            for part in 1..=20 {
                let share = f64::from(part) / 20.0;
                let mix = |a: f64, b: f64| if part == 20 { b } else { a + share * (b - a) };
                goes_to(&mut split, mix(from.0, to.0), [0, 1].map(|i| mix(from.1[i], to.1[i])));
            }
            from = to;
        }
        let work = whole.dissipated_energy() / split.dissipated_energy() - 1.0;
        let off = norm(difference(force(&whole), force(&split))) / LIMIT;
        println!(
            "{control:?}, rig {ratio}: T {off:.1e}, W {work:.1e}, mu {}",
            whole.friction_coefficient_now()
        );
        assert!(off < 1e-5 && work.abs() < 1e-4, "{control:?}, rig {ratio}: T {off:e}, W {work:e}");
    }
}

/// An orbit with wear: the contact wears as where its own way is given without a rig, and one that
/// is as good as rigid as without one.
#[test]
fn an_orbit_behind_a_rig_wears_as_the_way_that_the_body_goes() {
    for (profile, ratio) in [(BALL, 0.5), (CONE, 3.0), (BALL, 1e6)] {
        let worn = Parameters { wear_coefficient: 2e-2, ..Parameters::default() };
        let (mut contact, normal, compliance) = behind(&profile, (NormalControl::Force, ratio), worn.clone());
        let rigid = Parameters { rig_stiffness: Parameters::RIGID, ..contact.parameters().clone() };
        let mut bare = common::contact(rigid);
        bare.start_at(normal, 0.0).unwrap();
        let radius = 0.7 * exact(&profile, FORCE).full_slip() + 0.8 * compliance * LIMIT;
        let scale = radius + compliance * LIMIT;
        let steps = 72;
        for k in 0..=12 * steps {
            let target = polar(radius, TAU * f64::from(k) / f64::from(steps));
            goes_to(&mut contact, normal, target);
            let off = norm(difference(drive(&contact), target)) / scale;
            assert!(off < 2e-3, "{profile:?}, rig {ratio}, step {k}: the drive is {off:e} off");
            assert!(norm(force(&contact)) <= LIMIT * (1.0 + 1e-12));
            goes_to(&mut bare, normal, [contact.displacement(), contact.displacement_y()]);
        }
        let what = format!("{profile:?}, rig {ratio}");
        let volume = contact.wear_volume();
        println!(
            "{what}: V {:.1e} of a²d, {:+.1e}; {}",
            volume / (exact(&profile, FORCE).normal.radius().powi(2) * contact.indentation_depth()),
            volume / bare.wear_volume() - 1.0,
            contact.counters()
        );
        assert!(contact.counters().profile_updates > 5, "{what}: nothing has worn");
        close_to(volume, bare.wear_volume(), 5e-3, &format!("{what}: V"));
        close_to(contact.wear_depth(), bare.wear_depth(), 1e-2, &format!("{what}: depth"));
        close_to(volume, contact.parameters().wear_per_work() * contact.dissipated_energy(), 1e-12, &what);
        close_to(contact.profile_volume(), volume, 5e-3, &format!("{what}: volume of the profile"));
    }
}

/// Derivatives by load and both displacements of the drive are those of differences, along the last
/// direction and aside of it.
#[test]
fn derivatives_are_those_of_the_pair() {
    for ratio in RATIOS {
        for control in [NormalControl::Force, NormalControl::Indentation] {
            let fine = Parameters { resolution: 512, ..unworn() };
            let (mut contact, normal, compliance) = behind(&BALL, (control, ratio), fine);
            let reach = exact(&BALL, FORCE).full_slip() + compliance * LIMIT;
            goes_to(&mut contact, normal, [0.3 * reach, 0.0]);
            goes_to(&mut contact, normal, [0.5 * reach, 0.3 * reach]);
            let here = drive(&contact);
            for (x, y, load) in [(2.0, 3.0, 0.0), (3.0, 3.0, 0.0), (2.0, 3.0, -1.0)] {
                let way = [1e-5 * reach * x, 1e-5 * reach * y];
                let mut ahead = contact.clone();
                let change = 1e-6 * normal * load;
                goes_to(&mut ahead, normal + change, [here[0] + way[0], here[1] + way[1]]);
                for (what, gradient, moved) in [
                    ("T_x", contact.tangential_force_gradient(), force(&ahead)[0] - force(&contact)[0]),
                    ("T_y", contact.tangential_force_y_gradient(), force(&ahead)[1] - force(&contact)[1]),
                    ("U_x", contact.displacement_gradient(), ahead.displacement() - contact.displacement()),
                    (
                        "U_y",
                        contact.displacement_y_gradient(),
                        ahead.displacement_y() - contact.displacement_y(),
                    ),
                    (
                        "W",
                        contact.dissipated_energy_gradient(),
                        ahead.dissipated_energy() - contact.dissipated_energy(),
                    ),
                ] {
                    let predicted = gradient.displacement * way[0]
                        + gradient.displacement_y * way[1]
                        + gradient.normal * change;
                    let size = (gradient.displacement * way[0]).abs()
                        + (gradient.displacement_y * way[1]).abs()
                        + (gradient.normal * change).abs();
                    let what = format!("{control:?}, rig {ratio}: {what} by ({x}, {y}, {load})");
                    close(moved, predicted, 0.01 * size, &what);
                }
            }
        }
    }
}

/// Before any motion along y, the contact gives way along y by all its springs, in series with the
/// rig.
#[test]
fn motion_along_y_begins_on_springs_in_series() {
    for ratio in RATIOS {
        let (mut contact, normal, compliance) = behind(&BALL, (NormalControl::Force, ratio), unworn());
        goes_to(&mut contact, normal, [0.5 * (exact(&BALL, FORCE).full_slip() + compliance * LIMIT), 0.0]);
        let (force_by, place_by) = (contact.tangential_force_y_gradient(), contact.displacement_y_gradient());
        let stiffness = 2.0 * G_STAR * contact.contact_radius();
        close_to(force_by.displacement_y, stiffness / (1.0 + compliance * stiffness), 1e-12, "T_y");
        close_to(place_by.displacement_y, 1.0 / (1.0 + compliance * stiffness), 1e-12, "U_y");
        let step = 1e-13;
        let target = [contact.drive_displacement(), step];
        goes_to(&mut contact, normal, target);
        close_to(force(&contact)[1], force_by.displacement_y * step, 1e-2, "T_y after a step");
    }
}

/// Motion of a drive along x costs what it costs on a line, to the bit and the count; a body that
/// has parted from the other follows the drive, and begins on a line again.
#[test]
fn the_plane_costs_nothing_before_it_is_used() {
    let (mut line, normal, _) = behind(&BALL, (NormalControl::Force, 1.0), Parameters::default());
    let mut plane = line.clone();
    for k in 1..=50 {
        let stroke = 4e-6 * (0.3 * f64::from(k)).sin();
        to(&mut line, normal, stroke);
        goes_to(&mut plane, normal, [stroke, 0.0]);
    }
    assert_eq!(state(&plane), state(&line));
    assert_eq!(plane.counters(), line.counters());
    goes_to(&mut plane, normal, [2e-6, 3e-6]);
    assert!(force(&plane)[1] > 0.0);
    goes_to(&mut plane, 0.0, [3e-6, 4e-6]);
    assert_eq!((force(&plane), drive(&plane)), ([0.0; 2], [3e-6, 4e-6]));
    goes_to(&mut plane, normal, [3e-6, 4e-6]);
    to(&mut plane, normal, 4e-6);
    assert!(plane.tangential_force() > 0.0 && force(&plane)[1] == 0.0);
}

/// A state within an orbit goes on to the bit where it is taken back; a refused step leaves it as
/// it was.
#[test]
fn a_state_is_taken_back_and_goes_on() {
    for wear_coefficient in [0.0, 1e-3] {
        let parameters = Parameters { wear_coefficient, ..Parameters::default() };
        let (mut contact, normal, _) = behind(&BALL, (NormalControl::Force, 0.7), parameters);
        let orbit = |contact: &mut FrettingContact, from: u32| {
            for k in from..from + 30 {
                goes_to(contact, normal, polar(4e-6, 0.3 * f64::from(k)));
            }
        };
        orbit(&mut contact, 0);
        let snapshot = contact.snapshot();
        let before = state(&contact);
        for refused in [[f64::NAN, 0.0], [0.0, f64::INFINITY], [1e70, 0.0]] {
            contact.advance_to_planar(normal, refused).unwrap_err();
            assert_eq!(state(&contact), before);
        }
        let text = serde_json::to_string(&snapshot).unwrap();
        let mut other = common::contact(contact.parameters().clone());
        other.restore(&serde_json::from_str(&text).unwrap()).unwrap();
        orbit(&mut contact, 30);
        orbit(&mut other, 30);
        assert_eq!(state(&contact), state(&other));
    }
}

/// Held in depth, a body that has worn deep is lifted, let go by the rig, and pressed on again: it
/// may wear free within a step.
#[test]
fn a_worn_body_held_in_depth_is_found_again() {
    for ratio in [0.5, 1.0, 3.0] {
        let worn = Parameters { wear_coefficient: 0.8, ..Parameters::default() };
        let (mut contact, depth, compliance) = behind(&BALL, (NormalControl::Indentation, ratio), worn);
        let radius = 0.6 * exact(&BALL, FORCE).full_slip() + 0.75 * compliance * LIMIT;
        let (mut work, mut volume) = (0.0, 0.0);
        for k in 0..120u32 {
            let lifted = k > 80 && k.is_multiple_of(5);
            let target = polar(radius, TAU * f64::from(k) / 40.0);
            goes_to(&mut contact, if lifted { -1e-9 } else { depth }, target);
            assert!(norm(force(&contact)) <= MU * contact.normal_reaction() * (1.0 + 1e-12));
            assert!(contact.dissipated_energy() >= work && contact.wear_volume() >= volume, "step {k}");
            // a stroke from one step to the next at the whole load is the most that friction can
            // take
            let most = 3.0 * LIMIT * radius;
            assert!(contact.dissipated_energy() - work <= most, "rig {ratio}, step {k}: too much work");
            (work, volume) = (contact.dissipated_energy(), contact.wear_volume());
        }
        close_to(contact.profile_volume(), volume, 2e-3, &format!("rig {ratio}: volume of the profile"));
    }
}
