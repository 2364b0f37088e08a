//! Many contacts that wear: against one contact, by the identity of volume and work, and to the bit
//! where calls or threads are divided.

use crate::common::{BALL, BLUNTED, CONE, MU, PUNCH, ROUNDED, close, close_to, seeded, uniform};
use fretting_contact::{FrettingContact, Interface, NormalControl, Parameters, Profile, Summit};

fn worn(wear_coefficient: f64) -> Parameters {
    Parameters { wear_coefficient, profile: BALL, resolution: 32, ..Parameters::default() }
}

fn rough(count: u32, span: f64) -> Vec<Summit> {
    let place = |k: u32| {
        let share = |factor: f64| (f64::from(k) * factor).fract();
        Summit {
            offset: span * share(0.618_033_988_75),
            x: 1e-3 * share(0.754_877_666),
            y: 1e-3 * share(0.569_840_291),
            radius_factor: 0.5 + share(0.414_213_562),
        }
    };
    (0..count).map(place).collect()
}

/// A load that swings by 30 % and a displacement, in 100 steps a cycle.
fn motion(k: u32) -> (f64, f64) {
    let phase = 0.0628 * f64::from(k);
    (1.0 + 0.3 * (0.7 * phase).cos(), 1.5e-6 * phase.sin())
}

/// What two contacts differ by that are N and one, relative: V, W, T over μF_N, and d.
fn differences(joint: &Interface, one: &FrettingContact, number: f64) -> [f64; 4] {
    let relative = |sum: f64, single: f64, size: f64| {
        if sum == single { 0.0 } else { ((sum - single) / size).abs() }
    };
    let [volume, work, depth] = [one.wear_volume(), one.dissipated_energy(), one.indentation_depth()];
    [
        relative(joint.wear_volume() / number, volume, volume),
        relative(joint.dissipated_energy() / number, work, work),
        relative(joint.tangential_force() / number, one.tangential_force(), MU * 100.0),
        relative(joint.indentation_depth(), depth, depth),
    ]
}

/// The depth of a joint is that of the contact that is worn deepest, also before the profiles are
/// updated: not that of the one with the most work, which is spread over the largest contact.
#[test]
fn the_deepest_of_unequal_contacts_is_found() {
    let mut missed = 0.0f64;
    for wear_coefficient in [1e-6, 1e-4, 1e-2] {
        let summits = rough(8, 2e-6);
        let mut joint = Interface::new(worn(wear_coefficient), &summits).unwrap();
        let mut random = seeded(3);
        for _ in 0..60 {
            let (load, way) = (uniform(&mut random, 160.0, 640.0), uniform(&mut random, -3e-6, 3e-6));
            joint.advance_to(load, [way, 0.0], 0.0).unwrap();
            let depths = (0..summits.len()).filter_map(|index| Some(joint.contact(index)?.wear_depth()));
            let deepest = depths.fold(0.0, f64::max);
            assert!(deepest > 0.0 && joint.wear_depth() <= deepest);
            missed = missed.max(1.0 - joint.wear_depth() / deepest);
        }
    }
    assert!(missed <= 0.1, "{missed:.1e}");
}

/// N equal contacts are one contact with an Nth of the force, to rounding, whatever they wear: they
/// divide a step as one does, and wear at their force. Where they part and wear much in each of a
/// few long steps, the updates of their profiles enlarge rounding.
#[test]
fn equal_contacts_wear_as_one() {
    type Motion = fn(&mut dyn FnMut() -> f64, u32) -> (f64, [f64; 2]);
    let rounding = (1e-12, 1e-12);
    // at most, and where ten times as much wears
    let motions: [(&str, Motion, (f64, f64)); 10] = [
        ("constant load", |_, k| (1.0, [motion(k).1, 0.0]), rounding),
        ("gross slip", |_, k| (1.0, [4.0 * motion(k).1, 0.0]), rounding),
        ("varying load", |_, k| (motion(k).0, [motion(k).1, 0.0]), rounding),
        ("random strokes", |random, _| (1.0, [3e-6 * random(), 0.0]), rounding),
        ("random strokes and loads", |random, _| (1.0 + 0.6 * random(), [3e-6 * random(), 0.0]), rounding),
        ("long strokes", |random, _| (1.0 + 0.2 * random(), [1e-4 * random(), 0.0]), rounding),
        ("bodies part", |_, k| (0.5 + 3.0 * (motion(k).0 - 1.0), [motion(k).1, 0.0]), rounding),
        ("orbits", |_, k| (motion(k).0, [motion(k).1, motion(k + 25).1]), rounding),
        ("anywhere", |random, _| (1.0 + 0.6 * random(), [2e-6 * random(), 2e-6 * random()]), rounding),
        ("random strokes, bodies part", |random, _| (0.5 + random(), [3e-6 * random(), 0.0]), (2e-5, 1e-3)),
    ];
    for (name, motion, bound) in motions {
        for (number, wear_coefficient) in [(2u32, 3.2e-2), (7, 3.2e-2), (7, 3.2e-1), (7, 0.0)] {
            let bound = if wear_coefficient > 0.1 { bound.1 } else { bound.0 };
            let parameters = Parameters { resolution: 64, ..worn(wear_coefficient) };
            let mut one = FrettingContact::new(parameters.clone()).unwrap();
            let mut joint =
                Interface::new(parameters, &vec![Summit::at_offset(0.0); number as usize]).unwrap();
            let mut random = seeded(11);
            let mut random = || uniform(&mut random, -1.0, 1.0);
            let number = f64::from(number);
            for k in 0..if name == "long strokes" { 20 } else { 300 } {
                let (load, place) = motion(&mut random, k);
                let force = number * 100.0 * load;
                one.advance_to_planar(force / number, place).unwrap();
                joint.advance_to(force, place, 0.0).unwrap();
                let differences = differences(&joint, &one, number);
                assert!(
                    differences.iter().all(|difference| *difference < bound),
                    "{name}, {number} contacts, k = {wear_coefficient}, step {k}: {differences:?}"
                );
            }
            close_to(joint.wear_depth(), one.wear_depth(), bound, "wear depth");
            close_to(joint.normal_reaction(), number * one.normal_reaction(), bound, "force");
            assert!(wear_coefficient == 0.0 || one.counters().profile_updates > 1, "{name}");
        }
    }
}

/// At given depths each contact goes its own way.
#[test]
fn equal_contacts_at_a_given_approach_wear_as_one() {
    let parameters =
        Parameters { normal_control: NormalControl::Indentation, resolution: 64, ..worn(3.2e-2) };
    let mut one = FrettingContact::new(parameters.clone()).unwrap();
    let mut five = Interface::new(parameters, &[Summit::at_offset(0.0); 5]).unwrap();
    for k in 0..2000 {
        let (load, u) = motion(k);
        one.advance_to(3.48e-6 * load, u).unwrap();
        five.advance_to(3.48e-6 * load, [u, 0.0], 0.0).unwrap();
    }
    assert!(one.counters().profile_updates > 10, "{}", one.counters());
    close_to(five.wear_volume(), 5.0 * one.wear_volume(), 1e-12, "worn volume");
    close_to(five.wear_depth(), one.wear_depth(), 1e-12, "wear depth");
    close_to(five.normal_reaction(), 5.0 * one.normal_reaction(), 1e-12, "force");
}

/// A contact with a radius factor is the scaled body, to the bit, where the body has a flat, too.
#[test]
fn a_radius_factor_wears_as_the_scaled_body() {
    for body in [BLUNTED, ROUNDED, PUNCH, BALL] {
        let parameters = |profile: Profile| Parameters {
            profile,
            normal_control: NormalControl::Indentation,
            ..worn(0.32)
        };
        let scaled = parameters(body.scaled(0.7).unwrap());
        let mut joint = Interface::new(
            parameters(body.clone()),
            &[Summit { radius_factor: 0.7, ..Summit::at_offset(0.0) }],
        )
        .unwrap();
        let mut one = FrettingContact::new(scaled).unwrap();
        let mut random = seeded(5);
        joint.start_at(2e-6, [0.0; 2], 0.0).unwrap();
        one.start_at(2e-6, 0.0).unwrap();
        for _ in 0..40 {
            let [x, y] = [0, 1].map(|_| uniform(&mut random, -2e-6, 2e-6));
            joint.advance_to(2e-6, [x, y], 0.0).unwrap();
            one.advance_to_planar(2e-6, [x, y]).unwrap();
        }
        assert!(one.counters().profile_updates > 5, "{body:?}: {}", one.counters());
        assert_eq!(joint.wear_volume(), one.wear_volume(), "{body:?}");
        assert_eq!(joint.tangential_force(), one.tangential_force(), "{body:?}");
    }
}

/// While contacts of unequal height wear in steps, the tolerance bounds the error.
#[test]
fn unequal_contacts_wear_to_the_tolerance() {
    let run = |wear_coefficient: f64, tolerance: f64| {
        let parameters = Parameters { resolution: 64, tolerance, ..worn(wear_coefficient) };
        let mut joint = Interface::new(parameters, &rough(12, 2e-6)).unwrap();
        for k in 0..400 {
            let (load, u) = motion(k);
            joint.advance_to(900.0 * load, [u, 0.0], 0.0).unwrap();
        }
        (joint.wear_volume(), joint.indentation_depth())
    };
    for (wear_coefficient, volume) in [(3.2e-2, 1e-3), (3.2e-1, 3e-3)] {
        let (usual, fine) = (run(wear_coefficient, 1e-3), run(wear_coefficient, 1e-4));
        close_to(usual.0, fine.0, volume, "worn volume");
        close_to(usual.1, fine.1, 1e-3, "approach");
    }
}

/// A first pull of two contacts of unequal height in very fast wear, in steps of any length, is
/// taken. (What steps before had left to wear counted as the exchange of ever shorter parts: 20,
/// 1,000 and 5,000 steps were refused, and 46 of 108 pairs of balls at the usual settings.)
#[test]
fn unequal_contacts_in_very_fast_wear_are_followed_in_steps_of_any_length() {
    let pulled = |tolerance: f64, offset: f64, steps: u32| {
        let parameters = Parameters { tolerance, resolution: 64, ..worn(0.8) };
        let mut joint = Interface::new(parameters, &[0.0, offset].map(Summit::at_offset)).unwrap();
        joint.start_at(200.0, [0.0; 2], 0.0).unwrap();
        for k in 1..=steps {
            let u = 2.2e-6 * f64::from(k) / f64::from(steps);
            joint.advance_to(200.0, [u, 0.0], 0.0).unwrap_or_else(|error| panic!("{steps}, {k}: {error}"));
        }
        joint.wear_volume()
    };
    for offset in [0.5e-6, 1e-6, 2e-6] {
        let fine = pulled(1e-4, offset, 200);
        for steps in [1, 5, 20, 1000] {
            close_to(pulled(1e-4, offset, steps), fine, 6e-3, &format!("{offset:e} m, {steps} steps"));
        }
        close_to(pulled(1e-3, offset, 20), fine, 2e-2, &format!("{offset:e} m, usual tolerance"));
    }
}

/// Σ V = (k/σ₀) Σ W at every instant, on the profiles, too; |T| ≤ μF_N.
#[test]
fn the_worn_volume_is_the_work_of_all_contacts() {
    let mut random = seeded(7);
    let parameters = worn(3.2e-2);
    let per_work = parameters.wear_per_work();
    let mut joint = Interface::new(parameters, &rough(25, 4e-6)).unwrap();
    let (mut volume, mut force) = (0.0, 800.0);
    for k in 0..400 {
        force = (force + uniform(&mut random, -150.0, 150.0)).clamp(100.0, 1500.0);
        let force = if k % 97 == 96 { -1.0 } else { force };
        joint.advance_to(force, [uniform(&mut random, -3e-6, 3e-6), 0.0], 0.0).unwrap();
        close(joint.normal_reaction(), force.max(0.0), 1e-9 * 1500.0, "force");
        assert!(joint.tangential_force().abs() <= MU * force.max(0.0) * (1.0 + 1e-9));
        close_to(joint.wear_volume(), per_work * joint.dissipated_energy(), 1e-12, "volume and work");
        assert!(joint.wear_volume() >= volume);
        volume = joint.wear_volume();
    }
    assert!(joint.counters().profile_updates > 100);
    close_to(joint.profile_volume(), volume, 5e-3, "volume of the profiles");
}

/// A slide of a hundred contact radii in one step: V = (k/σ₀) μ F_N s.
#[test]
fn a_long_slide_wears_by_archard() {
    let parameters = worn(3.2e-2);
    let law = parameters.wear_per_work() * MU * 500.0;
    let mut joint = Interface::new(parameters, &[0.0, 0.0, 1e-6, 2e-6].map(Summit::at_offset)).unwrap();
    joint.start_at(500.0, [0.0; 2], 0.0).unwrap();
    joint.advance_to(500.0, [1e-3, 0.0], 0.0).unwrap();
    // the first 4 µm of the way are not yet gross slip
    close_to(joint.wear_volume(), law * 1e-3, 4e-3, "worn volume");
    close_to(joint.normal_reaction(), 500.0, 1e-11, "force");
}

/// At a constant force each contact wears by the law of its share of the force, and those that
/// exchange none are one, also where steps come between the cycles.
#[test]
fn cycles_of_equal_contacts_are_those_of_one() {
    let parameters = Parameters { resolution: 64, ..worn(3.2e-2) };
    let mut one = FrettingContact::new(parameters.clone()).unwrap();
    let mut four = Interface::new(parameters, &[Summit::at_offset(0.0); 4]).unwrap();
    for cycles in [100.0, 900.0, 9e3, 9e4] {
        one.advance_cycles(100.0, 1.5e-6, cycles).unwrap();
        four.advance_cycles(400.0, 1.5e-6, cycles).unwrap();
        let between = differences(&four, &one, 4.0);
        assert!(between.iter().all(|difference| *difference < 1e-12), "{cycles} cycles: {between:?}");
        close_to(four.wear_depth(), one.wear_depth(), 1e-12, "wear depth");
        close_to(four.normal_reaction(), 400.0, 1e-12, "normal force");
        for k in 0..100 {
            one.advance_to(100.0, motion(k).1).unwrap();
            four.advance_to(400.0, [motion(k).1, 0.0], 0.0).unwrap();
        }
        let between = differences(&four, &one, 4.0);
        assert!(between.iter().all(|difference| *difference < 1e-12), "after {cycles}: {between:?}");
    }
    // at a constant approach there are no blocks
    let held = Parameters { normal_control: NormalControl::Indentation, ..worn(3.2e-2) };
    let mut one = FrettingContact::new(held.clone()).unwrap();
    let mut four = Interface::new(held, &[Summit::at_offset(0.0); 4]).unwrap();
    one.advance_cycles(3e-6, 1.5e-6, 1e3).unwrap();
    four.advance_cycles(3e-6, 1.5e-6, 1e3).unwrap();
    close_to(four.wear_volume(), 4.0 * one.wear_volume(), 1e-12, "worn volume");
}

/// Many cycles in one call on coarse cells, in which contacts of all heights bed in and new ones
/// touch, are followed: the identity of volume and work holds.
#[test]
fn many_cycles_of_fifty_contacts_are_followed_on_coarse_cells() {
    let ball = Profile::Parabola { radius: 1e-4 };
    let parameters = Parameters { wear_coefficient: 3.2e-4, resolution: 16, profile: ball, ..worn(0.0) };
    let per_work = parameters.wear_per_work();
    let offset = |k: u32| 1e-6 * (f64::from(k) * 0.618_033_988_75).fract();
    let summits: Vec<Summit> = (0..50).map(|k| Summit::at_offset(offset(k))).collect();
    let mut joint = Interface::new(parameters, &summits).unwrap();
    joint.advance_cycles(5.0, 0.3e-6, 1e5).unwrap();
    assert_eq!(joint.contacts_in_touch(), 50);
    close_to(joint.wear_volume(), per_work * joint.dissipated_energy(), 1e-12, "V");
}

/// A rough joint beds in: the high contacts give their load to the low ones. Calls divided in four
/// give the same.
#[test]
fn calls_of_cycles_may_be_divided() {
    let end = |calls: u32| {
        let parameters = Parameters { resolution: 64, ..worn(3.2e-2) };
        let mut joint = Interface::new(parameters, &rough(12, 2e-6)).unwrap();
        for _ in 0..calls {
            joint.advance_cycles(900.0, 2e-6, 2e3 / f64::from(calls)).unwrap();
        }
        (joint.wear_volume(), joint.indentation_depth(), joint.contacts_in_touch())
    };
    let (one, four) = (end(1), end(4));
    close_to(one.0, four.0, 5e-4, "worn volume");
    close_to(one.1, four.1, 2e-4, "approach");
    assert_eq!(one.2, four.2);
}

/// Contacts of unequal height: the one that carries little slips most, and its force changes many
/// times over while it is a small part of the whole.
#[test]
fn a_call_of_cycles_follows_contacts_of_little_force() {
    let ball = Profile::Parabola { radius: 0.01 };
    for (profile, gap, cycles) in [(&ball, 0.7, 1e5), (&ball, 0.95, 1e6), (&CONE, 0.7, 1e6)] {
        let run = |resolution: usize, tolerance: f64, calls: u32| {
            let parameters =
                Parameters { profile: profile.clone(), resolution, tolerance, ..Parameters::default() };
            let mut alone = FrettingContact::new(parameters.clone()).unwrap();
            alone.start_at(100.0, 0.0).unwrap();
            let offsets = [0.0, gap * alone.indentation_depth()];
            let mut joint = Interface::new(parameters, &offsets.map(Summit::at_offset)).unwrap();
            joint.start_at(100.0, [0.0; 2], 0.0).unwrap();
            for _ in 0..calls {
                joint.advance_cycles(100.0, 0.4e-6, cycles / f64::from(calls)).unwrap();
            }
            joint
        };
        let (one, many) = (run(64, 1e-3, 1), run(128, 1e-4, 16));
        let what = format!("{profile:?} at gap {gap}, {cycles:e} cycles");
        close_to(one.wear_volume(), many.wear_volume(), 5e-3, &format!("V of {what}"));
        close_to(one.wear_depth(), many.wear_depth(), 1e-2, &format!("depth of {what}"));
    }
}

/// After a large fall of the load a mesh would put the walls of what has worn elsewhere, even for
/// next to no cycles: no block was short enough for the load that contacts exchange.
#[test]
fn cycles_after_a_large_fall_of_the_load_are_followed() {
    let run = |resolution: usize, tolerance: f64| {
        let parameters = Parameters { resolution, tolerance, ..Parameters::default() };
        let mut joint = Interface::new(parameters, &[1.83824e-6, 4.33777e-7].map(Summit::at_offset)).unwrap();
        joint.start_at(100.0, [0.0, 0.0], 0.0).unwrap();
        for (amplitude, cycles, force) in [
            (1.02889e-6, 191.535, 45.0839),
            (2.822e-6, 677.618, 104.827),
            (3.01149e-6, 4.65194, 128.772),
            (5.7281e-6, 354.414, 132.775),
            (4.3048e-7, 2.92271, 87.6897),
            (1.29191e-6, 73.1362, 34.6608),
        ] {
            joint.advance_cycles(force, amplitude, cycles).unwrap();
        }
        let volume = Parameters::default().wear_per_work() * joint.dissipated_energy();
        close_to(joint.wear_volume(), volume, 1e-12, "V against k/σ₀ W");
        joint
    };
    let [coarse, fine] = [run(64, 1e-3), run(128, 1e-4)];
    for index in 0..2 {
        let [coarse, fine] = [&coarse, &fine].map(|joint| joint.contact(index).unwrap());
        close_to(coarse.wear_volume(), fine.wear_volume(), 1e-3, "V of a contact");
        close(coarse.normal_reaction(), fine.normal_reaction(), 1e-3 * 34.66, "force of a contact");
    }
}

/// Beyond a smaller contact the image that a larger one has left stays as it was. It had notches
/// where the nodes crowd at a former front: the next update took them away, and the forces of the
/// contacts changed at once, however short the block.
#[test]
fn cycles_of_cones_after_a_fall_of_the_load_are_followed() {
    let offsets = [1.18953e-6, 6.38484e-7, 1.4436e-6, 4.61492e-7, 1.94735e-6];
    let run = |resolution: usize, tolerance: f64| {
        let parameters = Parameters { profile: CONE, resolution, tolerance, ..Parameters::default() };
        let mut joint = Interface::new(parameters, &offsets.map(Summit::at_offset)).unwrap();
        joint.start_at(13.1406, [0.0, 0.0], 0.0).unwrap();
        for (amplitude, cycles, force) in [
            (1.33273e-6, 22.435, 13.1406),
            (1.88587e-6, 107.154, 132.573),
            (2.94363e-7, 97.4656, 118.004),
            (1.3639e-6, 9.85566, 74.4586),
            (3.15514e-6, 3.2743, 42.0181),
        ] {
            joint.advance_cycles(force, amplitude, cycles).unwrap();
        }
        joint
    };
    let [coarse, fine] = [run(64, 1e-3), run(128, 1e-4)];
    for index in 0..offsets.len() {
        let [coarse, fine] = [&coarse, &fine].map(|joint| joint.contact(index).unwrap());
        close_to(coarse.wear_volume(), fine.wear_volume(), 1e-3, "V of a contact");
        close(coarse.normal_reaction(), fine.normal_reaction(), 1e-3 * 42.02, "force of a contact");
    }
}

/// Contacts that exchange load in too many blocks are refused as one call, and nothing has changed.
#[test]
fn cycles_in_too_many_blocks_are_refused() {
    let ball = Profile::Parabola { radius: 1e-3 };
    let parameters = Parameters { wear_coefficient: 0.32, resolution: 16, profile: ball, ..worn(0.0) };
    let offset = |k: u32| 1e-6 * (f64::from(k) * 0.618_033_988_75).fract();
    let summits: Vec<Summit> = (0..30).map(|k| Summit::at_offset(offset(k))).collect();
    let mut joint = Interface::new(parameters, &summits).unwrap();
    joint.start_at(20.0, [0.0; 2], 0.0).unwrap();
    let before = joint.snapshot();
    let problem = joint.advance_cycles(20.0, 0.5e-6, 1e6).unwrap_err().to_string();
    assert!(problem.contains("1e6 cycles") && problem.contains("take smaller steps"), "{problem}");
    assert_eq!(joint.snapshot(), before);
    joint.advance_cycles(20.0, 0.5e-6, 1e3).unwrap();
}

#[test]
fn cycles_refuse_what_they_cannot_do() {
    let mut joint = Interface::new(worn(3.2e-4), &rough(3, 1e-6)).unwrap();
    joint.start_at(300.0, [0.0; 2], 1e-5).unwrap();
    let before = joint.snapshot();
    for (amplitude, cycles, name) in
        [(1e-6, 1.0, "rotation"), (-1e-6, 1.0, "displacement_amplitude"), (1e-6, f64::NAN, "cycles")]
    {
        if name != "rotation" {
            joint.start_at(300.0, [0.0; 2], 0.0).unwrap();
        }
        let state = joint.snapshot();
        let problem = joint.advance_cycles(300.0, amplitude, cycles).unwrap_err().to_string();
        assert!(problem.contains(name), "{problem}");
        assert_eq!(joint.snapshot(), state);
    }
    assert_ne!(joint.snapshot(), before);
}

/// One contact that refuses wear takes the whole step back.
#[test]
fn a_step_that_wears_too_much_changes_nothing() {
    let mut joint = Interface::new(worn(3.2e-2), &rough(10, 2e-6)).unwrap();
    (0..150).for_each(|k| joint.advance_to(400.0, [motion(k).1, 0.0], 0.0).unwrap());
    let before = joint.snapshot();
    let depth = joint.wear_depth();
    joint.advance_to(400.0, [1e12, 0.0], 0.0).unwrap_err();
    assert_eq!(joint.snapshot(), before);
    assert_eq!(joint.wear_depth(), depth);
    joint.advance_to(400.0, [motion(150).1, 0.0], 0.0).unwrap();
}

/// One contact that is pressed beyond its profile takes back what another has slipped and worn: the
/// interface goes on as one that was never asked.
#[test]
fn a_step_beyond_a_profile_takes_the_slip_of_others_back() {
    // the second body is known up to 0.1 mm only
    let summits = [1.0, 0.25].map(|radius_factor| Summit { radius_factor, ..Summit::at_offset(0.0) });
    let parameters = Parameters {
        profile: Profile::Table(crate::common::sampled_sphere(100)),
        normal_control: NormalControl::Indentation,
        ..worn(3.2e-1)
    };
    let mut joint = Interface::new(parameters, &summits).unwrap();
    let mut unasked = joint.clone();
    for k in 0..300 {
        let (load, u) = motion(k);
        for joint in [&mut joint, &mut unasked] {
            joint.advance_to(2.5e-6 * load, [u, 0.0], 0.0).unwrap();
        }
        joint.advance_to(6e-6, [-u, 0.0], 0.0).unwrap_err();
    }
    assert!(joint.counters().profile_updates > 10, "{}", joint.counters());
    assert_eq!(joint.snapshot(), unasked.snapshot());
}

#[test]
fn a_saved_state_with_wear_goes_on_to_the_same_bits() {
    let summits = rough(15, 3e-6);
    let mut joint = Interface::new(worn(3.2e-2), &summits).unwrap();
    let step = |joint: &mut Interface, k: u32| {
        joint.advance_to(600.0 * motion(k).0, [motion(k).1, 0.0], 0.0).unwrap()
    };
    (0..300).for_each(|k| step(&mut joint, k));
    let mut other = Interface::new(worn(3.2e-2), &summits).unwrap();
    other
        .restore(&serde_json::from_str(&serde_json::to_string(&joint.snapshot()).unwrap()).unwrap())
        .unwrap();
    (300..600).for_each(|k| {
        step(&mut joint, k);
        step(&mut other, k);
    });
    assert_eq!(other.snapshot(), joint.snapshot());
}

#[test]
fn coefficients_may_change_during_a_life() {
    let mut joint = Interface::new(worn(3.2e-2), &rough(8, 2e-6)).unwrap();
    (0..100).for_each(|k| joint.advance_to(400.0, [motion(k).1, 0.0], 0.0).unwrap());
    let (volume, work) = (joint.wear_volume(), joint.dissipated_energy());
    joint.retune(0.3, [6.4e-2, 0.0]).unwrap();
    let slipped_back = joint.dissipated_energy() - work;
    assert!(joint.tangential_force().abs() <= 0.3 * 400.0 * (1.0 + 1e-9));
    (100..200).for_each(|k| joint.advance_to(400.0, [motion(k).1, 0.0], 0.0).unwrap());
    let later = joint.dissipated_energy() - work;
    assert!(slipped_back >= 0.0 && later > slipped_back);
    // what friction takes while the backlog is worn off counts by the old one
    close_to(joint.wear_volume() - volume, 8e-12 * later, 1e-4, "volume worn by the new coefficient");
    assert_eq!(joint.parameters().friction_coefficient, 0.3);
    assert!(joint.retune(0.3, [0.0; 2]).is_err());
}

/// At a given depth each contact of an interface whose coefficients change is one contact whose
/// coefficients change, and what it wears afterwards is its work by the new one.
#[test]
fn each_contact_goes_on_with_other_coefficients_as_one() {
    let parameters = Parameters { normal_control: NormalControl::Indentation, ..worn(3.2e-2) };
    let offsets = [0.0, 0.4e-6, 1.1e-6];
    let mut joint = Interface::new(parameters.clone(), &offsets.map(Summit::at_offset)).unwrap();
    let mut alone = offsets.map(|_| FrettingContact::new(parameters.clone()).unwrap());
    let changes = [(300, 0.3, 6.4e-2), (600, 0.8, 1.6e-2)];
    for k in 0..900 {
        if let Some((_, mu, wear)) = changes.iter().find(|change| change.0 == k) {
            joint.retune(*mu, [*wear, 0.0]).unwrap();
            alone.iter_mut().for_each(|one| one.retune(*mu, *wear).unwrap());
        }
        let (load, u) = motion(k);
        joint.advance_to(3.5e-6 * load, [u, 0.0], 0.0).unwrap();
        for (one, offset) in alone.iter_mut().zip(offsets) {
            one.advance_to(3.5e-6 * load - offset, u).unwrap();
        }
    }
    assert!(joint.counters().profile_updates > 10, "{}", joint.counters());
    for (index, one) in alone.iter().enumerate() {
        let contact = joint.contact(index).unwrap();
        close_to(contact.wear_volume(), one.wear_volume(), 1e-12, "V of a contact");
        close_to(contact.wear_depth(), one.wear_depth(), 1e-12, "depth of a contact");
        close_to(contact.tangential_force(), one.tangential_force(), 1e-12, "T of a contact");
    }
    let total = |of: fn(&FrettingContact) -> f64| alone.iter().map(of).sum::<f64>();
    close_to(joint.dissipated_energy(), total(FrettingContact::dissipated_energy), 1e-12, "W");
}

/// Contacts are advanced by several threads with the same bits, also while friction runs in.
#[cfg(feature = "threads")]
#[test]
fn threads_change_no_bit() {
    let summits = rough(200, 3e-6);
    let runs_in = Parameters { friction_coefficient_final: 0.9, running_in_energy: 1e-4, ..worn(3.2e-2) };
    let run = |parameters: &Parameters, in_threads: bool| {
        let mut joint = Interface::new(parameters.clone(), &summits).unwrap();
        joint.use_threads(in_threads);
        for k in 0..150 {
            let turn = if k > 120 { 1e-3 * f64::from(k - 120) } else { 0.0 };
            joint.advance_to(5000.0 * motion(k).0, [motion(k).1, 0.0], turn * 1e-3).unwrap();
        }
        joint.start_at(5000.0, [0.0; 2], 0.0).unwrap();
        joint.advance_cycles(5000.0, 1e-6, 50.0).unwrap();
        joint.snapshot()
    };
    for parameters in [worn(3.2e-2), runs_in] {
        assert_eq!(run(&parameters, true), run(&parameters, false));
    }
}

/// A profile of points scales like the others.
#[test]
fn tables_wear_as_the_shapes_they_sample() {
    let summits = rough(6, 2e-6);
    let volume = |profile: Profile| {
        let mut joint = Interface::new(Parameters { profile, ..worn(3.2e-2) }, &summits).unwrap();
        (0..150).for_each(|k| joint.advance_to(300.0, [motion(k).1, 0.0], 0.0).unwrap());
        joint.wear_volume()
    };
    let table = Profile::Table(crate::common::sampled_sphere(400));
    close_to(volume(table), volume(BALL), 1e-3, "worn volume");
}
