//! Many contacts without wear, against closed forms and invariants.

use crate::common::{
    BALL, CONE, E_STAR, FORCE, G_STAR, MU, PUNCH, close, close_to, seeded, uniform, without_wear,
};
use crate::interface_derivatives::{OUTPUTS, Output};
use fretting_contact::{
    Error, FrettingContact, Interface, NormalControl, Parameters, Profile, ProfileTable, SlipState, Summit,
};
use std::f64::consts::{PI, TAU};

/// Offsets between 0 and `span` (m) that are no multiples of each other.
fn rough(count: u32, span: f64) -> Vec<Summit> {
    let offset = |k: u32| span * (f64::from(k) * 0.618_033_988_75).fract();
    (0..count).map(|k| Summit::at_offset(offset(k))).collect()
}

/// Σ Fᵢ of balls at an approach, N.
fn of_balls(summits: &[Summit], approach: f64) -> f64 {
    let force = |summit: &Summit| {
        let depth = (approach - summit.offset).max(0.0);
        4.0 / 3.0 * E_STAR * (0.01 * summit.radius_factor).sqrt() * depth.powf(1.5)
    };
    summits.iter().map(force).sum()
}

fn interface(profile: Profile, summits: &[Summit]) -> Interface {
    Interface::new(without_wear(profile), summits).expect("the scene is valid")
}

#[test]
fn equal_contacts_are_one_contact_with_a_share_of_the_force() {
    let ellipse = Profile::Ellipse { radius_x: 0.02, radius_y: 0.005 };
    for profile in [BALL, CONE, PUNCH, ellipse] {
        let mut one = crate::common::contact(without_wear(profile.clone()));
        let mut ten = interface(profile, &[Summit::at_offset(3e-6); 10]);
        for (k, displacement) in [1e-6, -1.5e-6, 3e-6, 1e-7].into_iter().enumerate() {
            // the load changes at rest, where one straight line in depth and in force are the same
            let force = FORCE * (1.0 + 0.3 * k as f64);
            for displacement in [one.displacement(), displacement] {
                one.advance_to(force, displacement).unwrap();
                ten.advance_to(10.0 * force, [displacement, 0.0], 0.0).unwrap();
            }
            close_to(ten.normal_reaction(), 10.0 * force, 1e-12, "normal force");
            close_to(ten.indentation_depth(), one.indentation_depth() + 3e-6, 1e-12, "approach");
            close_to(ten.tangential_force(), 10.0 * one.tangential_force(), 1e-9, "tangential force");
            close_to(ten.dissipated_energy(), 10.0 * one.dissipated_energy(), 1e-9, "work");
            close_to(ten.normal_stiffness(), 10.0 * one.normal_stiffness(), 1e-9, "normal stiffness");
            close_to(ten.tangential_stiffness(), 10.0 * one.tangential_stiffness(), 1e-9, "stiffness");
            assert_eq!(ten.slip_state(), one.slip_state());
            assert_eq!(ten.contacts_in_touch(), 10);
        }
    }
}

/// Probability density and the complement of the distribution of a standard normal variable.
fn normal(z: f64) -> (f64, f64) {
    ((-0.5 * z * z).exp() / TAU.sqrt(), 0.5 * libm::erfc(z / 2f64.sqrt()))
}

/// The height that a share of a standard normal variable exceeds.
fn exceeded_by(share: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if normal(middle).1 > share { low = middle } else { high = middle }
    }
    low
}

/// ∫ from h on of (z − h)ⁿ φ(z) dz, by Simpson's rule in √(z − h).
fn greenwood_williamson(h: f64, n: f64) -> f64 {
    let (cells, end) = (4000, (9.0 - h).sqrt());
    let f = |t: f64| 2.0 * t.powf(2.0 * n + 1.0) * normal(h + t * t).0;
    let sum: f64 = (0..=cells)
        .map(|k| {
            let weight = if k == 0 || k == cells { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
            weight * f(end * f64::from(k) / f64::from(cells))
        })
        .sum();
    sum * end / (3.0 * f64::from(cells))
}

#[test]
fn gaussian_summits_follow_greenwood_and_williamson() {
    // 10⁴ summits at the mean heights of 10⁴ equally likely classes
    const COUNT: usize = 10_000;
    let sigma = 1e-6;
    let bounds: Vec<f64> = (0..=COUNT).map(|k| exceeded_by(k as f64 / COUNT as f64)).collect();
    let height = |k: usize| sigma * COUNT as f64 * (normal(bounds[k + 1]).0 - normal(bounds[k]).0);
    let highest = height(0);
    let summits: Vec<_> = (0..COUNT).map(|k| Summit::at_offset(highest - height(k))).collect();
    let depth_control = Parameters { normal_control: NormalControl::Indentation, ..without_wear(BALL) };
    let mut held = Interface::new(depth_control, &summits).unwrap();
    let mut pressed = interface(BALL, &summits);
    for h in [0.0, 0.5, 1.0, 1.5, 2.0] {
        let approach = highest - h * sigma;
        held.advance_to(approach, [0.0; 2], 0.0).unwrap();
        let count = COUNT as f64;
        let force =
            count * 4.0 / 3.0 * E_STAR * 0.01f64.sqrt() * sigma.powf(1.5) * greenwood_williamson(h, 1.5);
        println!("h = {h}: force off by {:.1e}", held.normal_reaction() / force - 1.0);
        close_to(held.normal_reaction(), force, 1e-3, "force");
        close_to(held.contacts_in_touch() as f64, count * normal(h).1, 3e-3, "number of contacts");
        let area = held.sum(|contact| PI * contact.contact_radius().powi(2));
        close_to(area, count * PI * 0.01 * sigma * greenwood_williamson(h, 1.0), 1e-3, "area");
        pressed.advance_to(force, [0.0; 2], 0.0).unwrap();
        assert!((pressed.indentation_depth() - approach).abs() < 1e-3 * sigma);
    }
    // those that have never touched hold no state
    let touched = (0..COUNT).filter(|index| held.contact(*index).is_some()).count();
    assert_eq!(touched, held.contacts_in_touch().max(touched));
    assert!(touched < COUNT);
}

/// At constant force T = μ (F(d) − F(d − G*U/(μE*))) with the normal curve F of all contacts, and
/// the Masing rule on the way back (Ciavarella, Jäger; Borri-Brunetto et al. for rough surfaces).
#[test]
fn tangential_force_is_the_difference_of_normal_curves() {
    let summits = rough(200, 4e-6);
    let mut joint = interface(BALL, &summits);
    let force = 2000.0;
    joint.start_at(force, [0.0; 2], 0.0).unwrap();
    let approach = joint.indentation_depth();
    close_to(of_balls(&summits, approach), force, 1e-12, "normal force");
    let loading = |u: f64| MU * (force - of_balls(&summits, approach - G_STAR * u / (MU * E_STAR)));
    for k in 1..=10 {
        let u = 0.3e-6 * f64::from(k);
        joint.advance_to(force, [u, 0.0], 0.0).unwrap();
        close_to(joint.tangential_force(), loading(u), 1e-10, "loading");
    }
    for k in 0..=20 {
        let u = 3e-6 - 0.3e-6 * f64::from(k);
        joint.advance_to(force, [u, 0.0], 0.0).unwrap();
        let expected = loading(3e-6) - 2.0 * loading(0.5 * (3e-6 - u));
        close(joint.tangential_force(), expected, 1e-10 * MU * force, "unloading");
    }
}

/// A step that changes force and displacement at once is one straight line, however it is divided;
/// the error of one step falls with the tolerance.
#[test]
fn the_division_of_a_step_does_not_matter_to_the_tolerance() {
    let summits = rough(60, 4e-6);
    let end = |steps: u32, tolerance: f64| {
        let parameters = Parameters { tolerance, ..without_wear(BALL) };
        let mut joint = Interface::new(parameters, &summits).unwrap();
        for (from, to) in
            [((0.0, 0.0), (900.0, 2e-6)), ((900.0, 2e-6), (300.0, -1e-6)), ((300.0, -1e-6), (1500.0, 0.0))]
        {
            for k in 1..=steps {
                let share = f64::from(k) / f64::from(steps);
                let (force, u) = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
                joint.advance_to(force, [u, 0.0], 0.0).unwrap();
            }
        }
        joint.tangential_force()
    };
    let exact = end(2000, 1e-3);
    let error = |tolerance| (end(1, tolerance) - exact).abs() / (MU * 1500.0);
    let errors = [1e-1, 1e-2, 1e-3, 1e-4].map(error);
    println!("error of a step in one: {errors:?}");
    for (error, tolerance) in errors.into_iter().zip([1e-1, 1e-2, 1e-3, 1e-4]) {
        assert!(error < tolerance, "{error:e} at {tolerance:e}");
    }
    // the error of a part is of second order in its length, which goes with the root of the
    // tolerance
    assert!(errors[3] < errors[1] / 20.0, "{errors:?}");
}

/// A step from separation, in which contacts touch and slip. (Parts of equal force had a third of
/// the stiffness in the first one: T was off by 2e-3 of μF_N, the work by up to 2.4 %.)
#[test]
fn contacts_that_touch_and_slip_in_one_step_follow_the_line() {
    for (profile, spread) in [(BALL, 2e-7), (CONE, 5e-7)] {
        for (from, reach) in [(0.0, 1e-6), (0.0, 2e-6), (-188.0, 2e-6)] {
            let summits: Vec<_> = (0..25).map(|k| Summit::at_offset(spread * f64::from(k) / 24.0)).collect();
            let end = |steps: u32| {
                let mut joint = Interface::new(without_wear(profile.clone()), &summits).unwrap();
                joint.start_at(from, [0.0; 2], 0.0).unwrap();
                for k in 1..=steps {
                    let share = f64::from(k) / f64::from(steps);
                    joint.advance_to(from + share * (1250.0 - from), [share * reach, 0.0], 0.0).unwrap();
                }
                (joint.tangential_force(), joint.dissipated_energy())
            };
            let (one, fine) = (end(1), end(2000));
            let what = format!("{profile:?}, {from} N to {reach:e} m");
            close(one.0, fine.0, 1e-4 * MU * 1250.0, &format!("T, {what}"));
            close(one.1, fine.1, 5e-4 * MU * 1250.0 * reach, &format!("W, {what}"));
        }
    }
}

#[test]
fn friction_bounds_the_force_on_random_histories() {
    let mut random = seeded(11);
    for round in 0..4 {
        let place = |k: u32| {
            let angle = f64::from(k);
            Summit { x: 1e-2 * angle.cos(), y: 1e-2 * angle.sin(), ..rough(40, 5e-6)[k as usize] }
        };
        let mut summits: Vec<_> = (0..40).map(place).collect();
        summits.iter_mut().for_each(|s| s.radius_factor = uniform(&mut random, 0.5, 2.0));
        let mut joint = interface(BALL, &summits);
        let mut work = 0.0;
        for _ in 0..40 {
            let force = uniform(&mut random, -100.0, 2000.0);
            let place = [0, 1].map(|_| uniform(&mut random, -4e-6, 4e-6));
            let place = if round < 2 { [place[0], 0.0] } else { place };
            let turn = if round % 2 == 0 { 0.0 } else { uniform(&mut random, -3e-4, 3e-4) };
            joint.advance_to(force, place, turn).unwrap();
            close(joint.normal_reaction(), force.max(0.0), 1e-11 * 2000.0, "normal force");
            let tangential = joint.tangential_force().hypot(joint.tangential_force_y());
            assert!(tangential <= MU * force.max(0.0) * (1.0 + 1e-11), "{tangential} N at {force} N");
            assert!(joint.moment().abs() <= MU * force.max(0.0) * 1e-2 * (1.0 + 1e-11));
            assert!(joint.dissipated_energy() >= work);
            work = joint.dissipated_energy();
            assert_eq!(joint.slip_state() == SlipState::Separated, force <= 0.0);
        }
    }
}

/// Contacts on a ring that is turned: M = Σ kᵢ r² φ in stick, which is 2G*a r² φ each, and μ F_N r
/// in gross slip.
#[test]
fn a_ring_that_turns_bears_the_moment_of_its_contacts() {
    let (count, ring, force) = (12, 5e-3, 1200.0);
    let place = |k: i32| {
        let angle = TAU * f64::from(k) / f64::from(count);
        Summit { x: ring * angle.cos(), y: ring * angle.sin(), ..Summit::at_offset(0.0) }
    };
    let summits: Vec<_> = (0..count).map(place).collect();
    // in the plane the springs are sampled
    let mut joint = Interface::new(Parameters { resolution: 512, ..without_wear(BALL) }, &summits).unwrap();
    joint.start_at(force, [0.0; 2], 0.0).unwrap();
    let radius = (0.75 * FORCE * 0.01 / E_STAR).cbrt();
    let stiffness = f64::from(count) * 2.0 * G_STAR * radius;
    // so little that what slips is the square of it
    let turn = 1e-9 / ring;
    joint.advance_to(force, [0.0; 2], turn).unwrap();
    close_to(joint.moment(), stiffness * ring * ring * turn, 1e-3, "moment in stick");
    close(joint.tangential_force(), 0.0, 1e-9 * force, "force along x");
    close(joint.tangential_force_y(), 0.0, 1e-9 * force, "force along y");
    joint.advance_to(force, [0.0; 2], 20e-6 / ring).unwrap();
    close_to(joint.moment(), MU * force * ring, 1e-6, "moment in gross slip");
    assert_eq!(joint.slip_state(), SlipState::GrossSlip);
    // turned back: the moment changes its sign
    joint.advance_to(force, [0.0; 2], 0.0).unwrap();
    close_to(joint.moment(), -MU * force * ring, 1e-6, "moment on the way back");
}

/// A contact at (0, y) that turns is displaced along x by −φy.
#[test]
fn a_rotation_displaces_each_contact() {
    let summits = [2e-3, -1e-3].map(|y| Summit { y, ..Summit::at_offset(0.0) });
    let mut joint = interface(BALL, &summits);
    joint.start_at(2.0 * FORCE, [0.0; 2], 0.0).unwrap();
    joint.advance_to(2.0 * FORCE, [0.5e-6, 0.0], 4e-4).unwrap();
    let mut sum = [0.0, 0.0];
    for (index, summit) in summits.iter().enumerate() {
        let mut alone = crate::common::pressed(BALL, FORCE);
        alone.advance_to(FORCE, 0.5e-6 - 4e-4 * summit.y).unwrap();
        let force = joint.contact(index).unwrap().tangential_force();
        close_to(force, alone.tangential_force(), 1e-9, "tangential force");
        sum = [sum[0] + force, sum[1] - summit.y * force];
    }
    close_to(joint.tangential_force(), sum[0], 1e-12, "sum");
    close_to(joint.moment(), sum[1], 1e-12, "moment");
}

#[test]
fn radius_factors_scale_each_contact() {
    let factors = [0.25, 1.0, 4.0];
    for profile in [BALL, CONE, PUNCH, Profile::Table(crate::common::sampled_sphere(200))] {
        let summits = factors.map(|radius_factor| Summit { radius_factor, ..Summit::at_offset(0.0) });
        let held = Parameters { normal_control: NormalControl::Indentation, ..without_wear(profile.clone()) };
        let mut joint = Interface::new(held.clone(), &summits).unwrap();
        joint.advance_to(1e-6, [0.0; 2], 0.0).unwrap();
        for (index, factor) in factors.into_iter().enumerate() {
            // f(r) = k f₀(r/k): depth k d, force k² F
            let mut same = FrettingContact::new(held.clone()).unwrap();
            same.advance_to(1e-6 / factor, 0.0).unwrap();
            let force = joint.contact(index).unwrap().normal_reaction();
            close_to(force, factor * factor * same.normal_reaction(), 1e-9, "force");
        }
    }
}

/// Every gradient against differences of two interfaces.
#[test]
fn gradients_are_those_of_differences() {
    let place = |k: usize, summit: Summit| Summit { x: 1e-3 * k as f64, y: 2e-3 - 5e-4 * k as f64, ..summit };
    let summits: Vec<_> = rough(8, 2e-6).into_iter().enumerate().map(|(k, s)| place(k, s)).collect();
    // in the plane the springs are sampled
    let mut joint = Interface::new(Parameters { resolution: 512, ..without_wear(BALL) }, &summits).unwrap();
    joint.start_at(400.0, [0.0; 2], 0.0).unwrap();
    joint.advance_to(400.0, [0.7e-6, 0.4e-6], 1e-4).unwrap();
    let more: [Output; 2] = [
        ("tangential_force_y", Interface::tangential_force_y, |i| {
            i.total_gradient(FrettingContact::tangential_force_y_gradient)
        }),
        ("normal_stiffness", Interface::normal_stiffness, |i| {
            i.total_gradient(FrettingContact::normal_stiffness_gradient)
        }),
    ];
    for (name, read, gradient) in OUTPUTS.into_iter().chain(more) {
        let expected = gradient(&joint);
        let given = [expected.normal, expected.displacement, expected.displacement_y, expected.rotation];
        for (k, step) in [(0, 1e-3), (1, 1e-11), (2, 1e-11), (3, 1e-8)] {
            // the law is that of going on as before
            let moved = |step: f64| {
                let part = |index: usize| if k == index { step } else { 0.0 };
                let on = 1.001;
                let displacement = [on * 0.7e-6 + part(1), on * 0.4e-6 + part(2)];
                let mut moved = joint.clone();
                moved.advance_to(400.0 + part(0), displacement, on * 1e-4 + part(3)).unwrap();
                read(&moved)
            };
            let difference = (moved(step) - moved(0.0)) / step;
            close(difference, given[k], 2e-2 * given[k].abs() + 1e-4 * read(&joint).abs(), name);
        }
    }
}

/// A step that one contact refuses changes none.
#[test]
fn a_step_that_fails_leaves_the_interface_unchanged() {
    // the second body is known up to 0.1 mm only
    let summits = [1.0, 0.25].map(|radius_factor| Summit { radius_factor, ..Summit::at_offset(0.0) });
    let mut joint = interface(Profile::Table(crate::common::sampled_sphere(100)), &summits);
    joint.start_at(60.0, [0.0; 2], 0.0).unwrap();
    joint.advance_to(60.0, [1e-6, 0.0], 0.0).unwrap();
    let before = joint.snapshot();
    let problem = joint.advance_to(1e4, [2e-6, 0.0], 0.0).unwrap_err();
    assert!(matches!(problem, Error::InContact { contact: 2, .. }), "{problem}");
    assert!(problem.to_string().contains("beyond the last point of the profile table"), "{problem}");
    assert_eq!(joint.snapshot(), before);
    for (force, u, turn, name) in [
        (f64::NAN, 0.0, 0.0, "normal_force"),
        (1.0, 1e70, 0.0, "tangential_displacement"),
        (1.0, 0.0, f64::INFINITY, "rotation"),
    ] {
        let problem = joint.advance_to(force, [u, 0.0], turn).unwrap_err();
        assert!(problem.to_string().contains(name), "{problem}");
        assert_eq!(joint.snapshot(), before);
    }
}

#[test]
fn scenes_that_are_none_are_refused() {
    let refused = |parameters: Parameters, summits: &[Summit]| {
        Interface::new(parameters, summits).unwrap_err().to_string()
    };
    let driven = Parameters { rig_stiffness: 1e7, ..without_wear(BALL) };
    assert!(refused(driven, &[Summit::at_offset(0.0)]).contains("rig_stiffness = 10000000.0"));
    assert!(refused(without_wear(BALL), &[]).contains("no contact"));
    let far = [Summit::at_offset(0.0), Summit::at_offset(f64::NAN)];
    assert!(refused(without_wear(BALL), &far).contains("contact 2: offset = NaN"));
    let table = ProfileTable::new(vec![(0.0, 0.0), (1e-5, 1e-9), (2e-5, 4e-9)]).unwrap();
    let tiny = Summit { radius_factor: 1e-29, ..Summit::at_offset(0.0) };
    assert!(refused(without_wear(Profile::Table(table)), &[tiny]).contains("contact 1 of the interface"));
}

/// A saved interface goes on to the same bits, through text as well.
#[test]
fn a_saved_state_goes_on_to_the_same_bits() {
    let summits: Vec<_> =
        rough(30, 4e-6).into_iter().enumerate().map(|(k, s)| Summit { x: 1e-4 * k as f64, ..s }).collect();
    let mut joint = interface(BALL, &summits);
    let step = |joint: &mut Interface, k: u32| {
        let phase = 0.3 * f64::from(k);
        let turn = if k > 20 { 1e-4 * phase.sin() } else { 0.0 };
        joint.advance_to(500.0 + 400.0 * phase.cos(), [2e-6 * phase.sin(), 0.0], turn).unwrap();
    };
    (0..30).for_each(|k| step(&mut joint, k));
    let text = serde_json::to_string(&joint.snapshot()).unwrap();
    let mut other = interface(BALL, &summits);
    other.restore(&serde_json::from_str(&text).unwrap()).unwrap();
    assert_eq!(other.snapshot(), joint.snapshot());
    for k in 30..60 {
        step(&mut joint, k);
        step(&mut other, k);
        assert_eq!(joint.tangential_force().to_bits(), other.tangential_force().to_bits());
    }
    assert_eq!(other.snapshot(), joint.snapshot());
    let mut fewer = interface(BALL, &summits[..3]);
    assert!(matches!(fewer.restore(&joint.snapshot()), Err(Error::Snapshot(_))));
    let mut shifted = summits.clone();
    shifted.iter_mut().for_each(|summit| summit.offset += 1e-7);
    assert!(interface(BALL, &shifted).restore(&joint.snapshot()).is_err());
}

/// Contacts that do not touch do no work and hold no state.
#[test]
fn contacts_out_of_reach_cost_nothing() {
    let mut summits = vec![Summit::at_offset(1e-3); 1000];
    summits[500].offset = 0.0;
    summits[600].offset = 1e-7;
    let mut joint = interface(BALL, &summits);
    joint.start_at(2.0 * FORCE, [0.0; 2], 0.0).unwrap();
    let before = joint.counters();
    for k in 1..=100 {
        joint.advance_to(2.0 * FORCE, [1e-8 * f64::from(k), 0.0], 0.0).unwrap();
    }
    let counters = joint.counters();
    assert_eq!(counters.spring_walks - before.spring_walks, 200);
    assert_eq!(counters.contact_solutions, before.contact_solutions);
    assert_eq!((0..1000).filter(|index| joint.contact(*index).is_some()).count(), 2);
}

#[test]
fn what_an_interface_does_not_have_is_refused_by_name() {
    let plain = without_wear(BALL);
    let parameters = Parameters { rig_stiffness: 1e7, ..plain };
    match Interface::new(parameters, &[Summit::at_offset(0.0)]) {
        Err(Error::Parameter { name, .. }) => assert_eq!(name, "rig_stiffness"),
        other => panic!("rig_stiffness: {other:?}"),
    }
}
