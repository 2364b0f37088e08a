//! Motion in both tangential directions: its limits on a line, orbits, energy.

use crate::common::{
    self, BALL, BLUNTED, CONE, FORCE, MU, PUNCH, ROUNDED, contact, pressed, started, without_wear,
};
use fretting_contact::{FrettingContact, NormalControl, Parameters, Profile, SlipState};
use std::f64::consts::TAU;

const PROFILES: [Profile; 5] = [BALL, CONE, BLUNTED, ROUNDED, PUNCH];

fn polar(size: f64, angle: f64) -> [f64; 2] {
    [size * angle.cos(), size * angle.sin()]
}

fn force(contact: &FrettingContact) -> [f64; 2] {
    [contact.tangential_force(), contact.tangential_force_y()]
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Displacement at which all of a contact slips, m.
fn full(contact: &FrettingContact) -> f64 {
    contact.indentation_depth() * MU * common::E_STAR / common::G_STAR
}

/// The same strokes on a line at an angle and along x: loops in partial and gross slip, under a
/// load that stays or varies.
#[test]
fn a_line_at_any_angle_is_the_line_along_x() {
    for profile in PROFILES {
        for (angle, swing) in [(0.5, 0.0), (2.2, 0.0), (0.5, 0.4), (-1.5, 1.2)] {
            let mut plane = pressed(profile.clone(), FORCE);
            let mut line = pressed(profile.clone(), FORCE);
            let full = full(&line);
            let mut worst = [0.0f64; 2];
            for k in 1..=300 {
                let phase = TAU * f64::from(k) / 60.0;
                let amplitude = full * f64::from(k) / 200.0;
                let load = FORCE * (1.0 + swing * (0.7 * phase).sin());
                line.advance_to(load, amplitude * phase.sin()).unwrap();
                plane.advance_to_planar(load, polar(amplitude * phase.sin(), angle)).unwrap();
                let expected = polar(line.tangential_force(), angle);
                let off = norm([force(&plane)[0] - expected[0], force(&plane)[1] - expected[1]]);
                let limit = MU * line.normal_reaction();
                worst[0] = worst[0].max(off / (MU * FORCE));
                assert!(norm(force(&plane)) <= limit * (1.0 + 1e-12));
            }
            worst[1] = (plane.dissipated_energy() / line.dissipated_energy() - 1.0).abs();
            println!("{profile:?}, {angle}, load ±{swing}: {worst:?}");
            // 128 samples: see the row's own tests
            assert!(worst[0] < 5e-4 && worst[1] < 5e-4, "{profile:?}, {angle}, {swing}: {worst:?}");
        }
    }
}

/// Cycles in which a thin annulus slips: the work is that of the line along x, though it is but
/// 1e-6 to 2e-2 of that of full slip. What the samples leave of it grows as the annulus becomes as
/// thin as their distance; the rounded punch, whose image is the steepest, is the worst.
#[test]
fn small_slip_at_an_angle_takes_the_work_of_the_line_along_x() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED] {
        for (share, most) in [(0.01, 0.1), (0.02, 0.06), (0.05, 0.03), (0.1, 0.015), (0.2, 0.007)] {
            let mut plane = pressed(profile.clone(), FORCE);
            let mut line = pressed(profile.clone(), FORCE);
            let amplitude = share * full(&line);
            for k in 1..=100 {
                let place = amplitude * (TAU * f64::from(k) / 50.0).sin();
                line.advance_to(FORCE, place).unwrap();
                plane.advance_to_planar(FORCE, polar(place, 0.5)).unwrap();
            }
            let off = plane.dissipated_energy() / line.dissipated_energy() - 1.0;
            println!("{profile:?}, {share}: {off:.1e}");
            assert!(off.abs() < most, "{profile:?}, {share}: {off}");
        }
    }
}

/// A closed path: 0 to radius, `orbits` of a circle in `steps` each, and back along a spiral to the
/// start.
fn circle(
    contact: &mut FrettingContact,
    radius: f64,
    steps: u32,
    orbits: u32,
    mut visit: impl FnMut(&FrettingContact),
) {
    for k in 1..=steps * orbits {
        let phase = TAU * f64::from(k % steps) / f64::from(steps);
        contact.advance_to_planar(FORCE, polar(radius, phase)).unwrap();
        visit(contact);
    }
}

/// Over a closed orbit in a steady state the work of the drive ∮**T**·d**U** is the work of
/// friction, and |**T**| ≤ μF_N.
#[test]
fn the_work_of_the_drive_over_an_orbit_is_that_of_friction() {
    for profile in PROFILES {
        for share in [0.4, 0.9, 2.0] {
            let mut contact = pressed(profile.clone(), FORCE);
            let radius = share * full(&contact);
            let steps = 720;
            circle(&mut contact, radius, steps, 12, |_| ());
            let (mut driven, mut last) = (0.0, contact.clone());
            let before = contact.dissipated_energy();
            circle(&mut contact, radius, steps, 1, |now| {
                let (place, former) = (
                    [now.displacement(), now.displacement_y()],
                    [last.displacement(), last.displacement_y()],
                );
                let (here, there) = (force(now), force(&last));
                driven += (0..2).map(|k| 0.5 * (here[k] + there[k]) * (place[k] - former[k])).sum::<f64>();
                assert!(norm(here) <= MU * FORCE * (1.0 + 1e-12));
                last = now.clone();
            });
            let taken = contact.dissipated_energy() - before;
            let off = (driven - taken).abs() / (MU * FORCE * TAU * radius);
            println!("{profile:?} {share}: drive {driven:e} J, friction {taken:e} J, off {off:.1e}");
            // the sum of the drive's work is of second order in 720 corners
            assert!(off < 5e-5, "{profile:?} {share}: {driven:e} {taken:e}");
            let state = match profile {
                _ if share > 1.0 => SlipState::GrossSlip,
                Profile::FlatPunch { .. } => SlipState::Stick,
                _ => SlipState::PartialSlip,
            };
            assert_eq!(contact.slip_state(), state, "{profile:?} {share}");
        }
    }
}

/// In a steady orbit of radius U around the place of rest springs inside c stick, where the bound
/// is U, as in a stroke of that length.
#[test]
fn the_stick_radius_of_an_orbit_is_that_of_a_stroke_of_its_radius() {
    for profile in [BALL, CONE, BLUNTED, ROUNDED] {
        let mut contact = pressed(profile.clone(), FORCE);
        let mut line = contact.clone();
        let radius = 0.6 * full(&contact);
        line.advance_to(FORCE, radius).unwrap();
        circle(&mut contact, radius, 90, 10, |_| ());
        common::close_to(contact.stick_radius(), line.stick_radius(), 1e-6, &format!("{profile:?}"));
    }
}

/// Depth or force held, the orbit is the same.
#[test]
fn an_orbit_is_the_same_whichever_normal_quantity_is_held() {
    let mut by_force = pressed(BALL, FORCE);
    let depth = by_force.indentation_depth();
    let parameters = Parameters { normal_control: NormalControl::Indentation, ..without_wear(BALL) };
    let mut by_depth = contact(parameters);
    by_depth.start_at(depth, 0.0).unwrap();
    for k in 1..=200 {
        let place = polar(1.5e-6, 0.1 * f64::from(k));
        by_force.advance_to_planar(FORCE, place).unwrap();
        by_depth.advance_to_planar(depth, place).unwrap();
        let (a, b) = (force(&by_force), force(&by_depth));
        assert!(norm([a[0] - b[0], a[1] - b[1]]) < 1e-12 * MU * FORCE);
    }
    common::close_to(by_force.dissipated_energy(), by_depth.dissipated_energy(), 1e-12, "work");
}

/// Who keeps y as it is gets the row of knots, to the bit and the count, wherever on y he stands.
#[test]
fn a_scene_that_keeps_its_place_along_y_pays_nothing_for_it() {
    for wear in [0.0, 3.2e-3] {
        let parameters = Parameters { wear_coefficient: wear, ..Parameters::default() };
        let mut plain = contact(parameters.clone());
        let mut aside = contact(parameters);
        plain.start_at(FORCE, 0.0).unwrap();
        aside.start_at_planar(FORCE, [0.0, 3e-6]).unwrap();
        for k in 1..=400 {
            let phase = TAU * f64::from(k) / 40.0;
            let load = FORCE * (1.0 + 0.2 * (0.3 * phase).sin());
            plain.advance_to(load, 1.5e-6 * phase.sin()).unwrap();
            aside.advance_to_planar(load, [1.5e-6 * phase.sin(), 3e-6]).unwrap();
        }
        assert_eq!(plain.counters(), aside.counters());
        assert_eq!(plain.tangential_force().to_bits(), aside.tangential_force().to_bits());
        assert_eq!(plain.wear_volume().to_bits(), aside.wear_volume().to_bits());
        assert_eq!(aside.tangential_force_y().to_bits(), 0.0f64.to_bits());
        assert_eq!(aside.displacement_y(), 3e-6);
    }
}

/// The first motion along y changes nothing of what is there: force, work and front go on from
/// where they were.
#[test]
fn the_first_motion_along_y_takes_over_what_the_line_has_left() {
    for profile in PROFILES {
        let mut contact = pressed(profile.clone(), FORCE);
        let full = full(&contact);
        for place in [0.8, -0.5, 0.1] {
            contact.advance_to(FORCE, place * full).unwrap();
        }
        let (before, work, stick) =
            (contact.tangential_force(), contact.dissipated_energy(), contact.stick_radius());
        contact.advance_to_planar(FORCE, [0.1 * full, 1e-9 * full]).unwrap();
        common::close(contact.tangential_force(), before, 1e-9 * MU * FORCE, "force");
        common::close(contact.dissipated_energy(), work, 1e-9 * work, "work");
        common::close(contact.stick_radius(), stick, 2e-2 * contact.contact_radius(), "stick radius");
        assert!(contact.tangential_force_y() > 0.0);
    }
}

/// Bodies that part forget the plane: the next contact costs a row of knots again.
#[test]
fn bodies_that_part_begin_on_a_line_again() {
    for wear in [0.0, 3.2e-4] {
        let mut contact = started(Parameters { wear_coefficient: wear, ..Parameters::default() });
        contact.advance_to_planar(FORCE, [1e-6, 1e-6]).unwrap();
        contact.advance_to_planar(-10.0, [2e-6, 3e-6]).unwrap();
        assert_eq!(contact.slip_state(), SlipState::Separated);
        assert_eq!(force(&contact), [0.0, 0.0]);
        assert_eq!([contact.displacement(), contact.displacement_y()], [2e-6, 3e-6]);
        contact.advance_to_planar(-10.0, [2e-6, 4e-6]).unwrap();
        assert_eq!(common::state(&contact)["state"]["direction"], serde_json::json!([1.0, 0.0]));
        contact.advance_to(FORCE, 2e-6).unwrap();
        let mut fresh = pressed(BALL, FORCE);
        fresh.advance_to(FORCE, 1e-6).unwrap();
        contact.advance_to(FORCE, 3e-6).unwrap();
        if wear == 0.0 {
            common::close_to(contact.tangential_force(), fresh.tangential_force(), 1e-12, "force");
        }
        assert_eq!(common::knots(&contact), common::knots(&fresh));
    }
}

/// Bodies that touch while they move in the plane know nothing of where: wherever that is, forces
/// and work are the same.
#[test]
fn where_in_the_plane_bodies_touch_does_not_matter() {
    let touched = |x: f64| {
        let mut contact = pressed(BALL, FORCE);
        contact.advance_to_planar(0.0, [0.0, 0.0]).unwrap();
        contact.advance_to_planar(0.0, [x, 0.0]).unwrap();
        contact.advance_to_planar(FORCE, [x, 5e-7]).unwrap();
        contact.advance_to_planar(FORCE, [x + 1e-6, 1e-6]).unwrap();
        (force(&contact), contact.dissipated_energy())
    };
    let (at_rest, work) = touched(0.0);
    for x in [2e-6, -1e-5] {
        let (moved, moved_work) = touched(x);
        let off = norm([moved[0] - at_rest[0], moved[1] - at_rest[1]]);
        assert!(off < 1e-9 * MU * FORCE, "{x}: {moved:?} for {at_rest:?}");
        common::close_to(moved_work, work, 1e-9, "work");
    }
}

/// A step in the plane may be split at will: at constant load to rounding.
#[test]
fn a_step_may_be_split() {
    let (mut one, mut many) = (pressed(BALL, FORCE), pressed(BALL, FORCE));
    let (mut last, mut worst) = ([0.0; 2], 0.0f64);
    for k in 1..=50 {
        let place = polar(2e-6 * (0.9 * f64::from(k)).sin(), 1.7 * f64::from(k));
        one.advance_to_planar(FORCE, place).unwrap();
        for part in 1..=7 {
            let share = f64::from(part) / 7.0;
            let at = |k: usize| last[k] + share * (place[k] - last[k]);
            many.advance_to_planar(FORCE, if part == 7 { place } else { [at(0), at(1)] }).unwrap();
        }
        last = place;
        let (a, b) = (force(&one), force(&many));
        worst = worst.max(norm([a[0] - b[0], a[1] - b[1]]) / (MU * FORCE));
    }
    println!("force off by {worst:.1e} of the limit");
    assert!(worst < 1e-12);
    common::close_to(one.dissipated_energy(), many.dissipated_energy(), 1e-12, "work");
}

#[test]
fn friction_that_falls_lets_the_springs_slip_back_in_their_direction() {
    let mut contact = pressed(BALL, FORCE);
    contact.advance_to_planar(FORCE, [0.0, 1e-6]).unwrap();
    contact.advance_to_planar(FORCE, [2e-5, 1.5e-5]).unwrap();
    let before = force(&contact);
    let angle = before[1].atan2(before[0]);
    common::close_to(norm(before), MU * FORCE, 1e-9, "gross slip");
    let work = contact.dissipated_energy();
    contact.retune(0.3, contact.parameters().wear_coefficient).unwrap();
    let after = force(&contact);
    common::close_to(norm(after), 0.3 * FORCE, 1e-9, "slipped back");
    common::close(after[1].atan2(after[0]), angle, 1e-9, "direction");
    assert!(contact.dissipated_energy() > work);
}

#[test]
fn friction_may_fall_to_the_smallest_numbers() {
    let groove = Profile::Ellipse { radius_x: 0.020, radius_y: 0.005 };
    for profile in [BALL, ROUNDED, groove] {
        for friction_coefficient in [1e-150, 1e-305, 5e-324] {
            let mut contact = started(without_wear(profile.clone()));
            contact.advance_to_planar(FORCE, [1e-6, 2e-6]).unwrap();
            contact.retune(friction_coefficient, 0.0).unwrap();
            let limit = friction_coefficient * FORCE * (1.0 + 1e-9);
            assert!(norm(force(&contact)) <= limit, "{profile:?}, {friction_coefficient}");
            contact.restore(&contact.snapshot()).expect("a state of its own");
        }
    }
}

/// Nothing that is given makes it panic, leave its limits or change by what it refuses.
#[test]
fn extremes_are_refused_or_computed() {
    let values = [0.0, 1e-320, 1e-9, 1e30, 1e60, 1e300, f64::INFINITY, f64::NAN, -1e-6];
    let rigid = Parameters::RIGID;
    for (wear_coefficient, rig_stiffness) in
        [(0.0, rigid), (3.2e-4, rigid), (0.0, 1e7), (3.2e-4, 1e7), (0.0, 1e-60), (0.0, 1e59)]
    {
        for profile in PROFILES {
            let mut contact = started(Parameters {
                profile,
                wear_coefficient,
                rig_stiffness,
                resolution: if rig_stiffness == rigid { 64 } else { 16 },
                ..Parameters::default()
            });
            contact.advance_to_planar(FORCE, [1e-6, 1e-7]).unwrap();
            for load in [FORCE, 1e-300, 1e40] {
                for x in values {
                    for y in values {
                        let before = common::state(&contact);
                        let mut next = contact.clone();
                        match next.advance_to_planar(load, [x, y]) {
                            Ok(()) => {
                                let limit = MU * next.normal_reaction();
                                assert!(norm(force(&next)) <= limit * (1.0 + 1e-9), "{x:e} {y:e} {load:e}");
                                assert!(next.dissipated_energy().is_finite(), "{x:e} {y:e} {load:e}");
                            }
                            Err(_) => assert_eq!(common::state(&next), before, "{x:e} {y:e} {load:e}"),
                        }
                    }
                }
            }
        }
    }
}

/// A contact that starts aside has not slipped on the way there.
#[test]
fn a_start_aside_is_no_slip() {
    let mut contact = contact(without_wear(BALL));
    contact.start_at_planar(FORCE, [1e-6, 5e-6]).expect("the load is carried");
    assert_eq!((contact.slip_amplitude_at(1e-4), contact.slip_amplitude_at(1.8e-4)), (0.0, 0.0));
    assert_eq!(contact.displacement_y(), 5e-6);
}
