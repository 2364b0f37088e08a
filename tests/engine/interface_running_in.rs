//! Friction that runs in at each contact of an interface by its own energy: against one contact,
//! the closed energy of sliding, and in what holds for any history.

use crate::common::*;
use fretting_contact::{FrettingContact, Interface, NormalControl, Parameters, Profile, Summit};
use rand::RngExt;

const START: f64 = 0.2;
const END: f64 = 0.8;

fn running_in(energy: f64) -> Parameters {
    Parameters {
        friction_coefficient: START,
        friction_coefficient_final: END,
        running_in_energy: energy,
        ..without_wear(BALL)
    }
}

fn wearing(energy: f64) -> Parameters {
    Parameters { wear_coefficient: 3.2e-2, resolution: 32, ..running_in(energy) }
}

/// An energy that a few of the lines below dissipate in one contact, J.
const USUAL: f64 = 1e-3;

fn uneven() -> Vec<Summit> {
    let at = |k: u32| {
        let share = |factor: f64| (f64::from(k) * factor).fract();
        Summit {
            offset: 2e-6 * share(0.618_033_988_75),
            x: 1e-3 * share(0.754_877_666),
            y: 1e-3 * share(0.569_840_291),
            radius_factor: 0.5 + share(0.414_213_562),
        }
    };
    (0..6).map(at).collect()
}

fn saved(joint: &Interface) -> String {
    serde_json::to_string(&joint.snapshot()).unwrap()
}

/// At constant force, and at any depth, where the approach of the interface is that of the contact.
#[test]
fn equal_contacts_run_in_as_one() {
    for (control, count) in
        [NormalControl::Force, NormalControl::Indentation].into_iter().flat_map(|c| [(c, 1), (c, 4)])
    {
        let parameters = Parameters { normal_control: control, ..running_in(USUAL) };
        let held = control == NormalControl::Indentation;
        let (unit, all) = if held { (3e-6, 3e-6) } else { (FORCE, f64::from(count) * FORCE) };
        let mut one = contact(parameters.clone());
        let mut joint = Interface::new(parameters, &vec![Summit::at_offset(0.0); count as usize]).unwrap();
        one.start_at(unit, 0.0).unwrap();
        joint.start_at(all, [0.0; 2], 0.0).unwrap();
        let mut random = seeded(5);
        for _ in 0..20 {
            let load = if held { uniform(&mut random, 0.5, 1.5) } else { 1.0 };
            let u = uniform(&mut random, -6e-6, 6e-6);
            one.advance_to(load * unit, u).unwrap();
            joint.advance_to(load * all, [u, 0.0], 0.0).unwrap();
        }
        assert!(one.friction_coefficient_now() > 0.4, "{}", one.friction_coefficient_now());
        let sum = f64::from(count);
        let what = format!("{control:?}, {count} contacts: W");
        close_to(joint.dissipated_energy(), sum * one.dissipated_energy(), 1e-9, &what);
        close(joint.tangential_force(), sum * one.tangential_force(), 1e-9 * sum * END * FORCE, "T");
        close_to(joint.friction_coefficient_now(), one.friction_coefficient_now(), 1e-9, "mu");
    }
}

/// W(s) = W_r ln{[μ₀ e^(μ_end F s/W_r) + μ_end − μ₀]/μ_end}: the slip of each contact is the way
/// less what its springs are stretched in gross slip, 0.4 μF u_f of energy.
#[test]
fn each_contact_dissipates_the_closed_energy_of_its_own_force() {
    let (energy, way) = (1.0, 0.02);
    let mut joint = Interface::new(running_in(energy), &uneven()).unwrap();
    let force = 4.0 * FORCE;
    joint.start_at(force, [0.0; 2], 0.0).unwrap();
    joint.advance_to(force, [way, 0.0], 0.0).unwrap();
    let mut friction = Vec::new();
    for index in 0..6 {
        let contact = joint.contact(index).unwrap();
        let normal = contact.normal_reaction();
        let share = (END * normal * way / energy).exp();
        let closed = energy * ((START * share + END - START) / END).ln();
        // the springs store a share of the way of order u_f/s
        close_to(contact.dissipated_energy(), closed, 2e-3, &format!("contact {index}"));
        let mu = contact.friction_coefficient_now();
        close_to(contact.tangential_force(), mu * normal, 1e-11, "T = mu F");
        friction.push(mu);
    }
    let spread =
        friction.iter().fold(0.0f64, |a, b| a.max(*b)) - friction.iter().fold(1.0f64, |a, b| a.min(*b));
    assert!(spread > 0.02, "contacts run in by their own energy: {friction:?}");
    close_to(joint.tangential_force(), joint.friction_coefficient_now() * force, 1e-10, "T = mu F of all");
}

#[test]
fn a_step_may_be_split() {
    let ends = [1, 7].map(|steps| {
        let mut joint = Interface::new(running_in(USUAL), &uneven()).unwrap();
        joint.start_at(4.0 * FORCE, [0.0; 2], 0.0).unwrap();
        let mut random = seeded(3);
        let mut from = 0.0;
        for _ in 0..15 {
            let u = uniform(&mut random, -6e-6, 6e-6);
            for k in 1..=steps {
                let share = f64::from(k) / f64::from(steps);
                let place = if k == steps { u } else { from + share * (u - from) };
                joint.advance_to(4.0 * FORCE, [place, 0.0], 0.0).unwrap();
            }
            from = u;
        }
        joint
    });
    // the loads of the contacts vary, which costs 1e-6 to 3e-6 in such histories
    let [whole, split] = &ends;
    close_to(split.dissipated_energy(), whole.dissipated_energy(), 4e-6, "W");
    close_to(split.friction_coefficient_now(), whole.friction_coefficient_now(), 4e-6, "mu");
    close(split.tangential_force(), whole.tangential_force(), 4e-6 * END * 4.0 * FORCE, "T");
}

/// Steps, lift-off, rotation and cycles, with wear and without; a saved state goes on to the bit.
#[test]
fn random_histories_keep_every_invariant() {
    for (seed, parameters) in [(1, running_in(USUAL)), (2, wearing(USUAL))] {
        let per_work = parameters.wear_per_work();
        let mut random = seeded(seed);
        let mut joint = Interface::new(parameters.clone(), &uneven()).unwrap();
        let (mut volume, mut work) = (0.0, 0.0);
        let mut copy: Option<Interface> = None;
        for k in 0..30 {
            let normal = if k % 13 == 12 { -1.0 } else { FORCE * uniform(&mut random, 2.0, 6.0) };
            let u = uniform(&mut random, -6e-6, 6e-6);
            let turn = if random.random_bool(0.2) { 1e-3 * uniform(&mut random, -1.0, 1.0) } else { 0.0 };
            let advance = |joint: &mut Interface| {
                if k % 10 == 9 {
                    joint.advance_to(normal, [u, 0.0], 0.0).unwrap();
                    joint.advance_cycles(normal, u.abs(), 3.0).unwrap();
                } else {
                    joint.advance_to(normal, [u, 0.0], turn).unwrap();
                }
            };
            advance(&mut joint);
            if let Some(copy) = &mut copy {
                advance(copy);
                assert_eq!(saved(copy), saved(&joint), "step {k}");
            }
            if k == 14 {
                let mut other = Interface::new(parameters.clone(), &uneven()).unwrap();
                other.restore(&joint.snapshot()).unwrap();
                copy = Some(other);
            }
            let contacts = || (0..6).filter_map(|index| joint.contact(index));
            let limit: f64 = contacts().map(|c| c.friction_coefficient_now() * c.normal_reaction()).sum();
            let force = joint.tangential_force().hypot(joint.tangential_force_y());
            assert!(force <= limit * (1.0 + 1e-12), "step {k}: {force} above {limit}");
            for contact in contacts() {
                let expected = parameters.friction_coefficient_after(contact.dissipated_energy());
                assert_eq!(contact.friction_coefficient_now(), expected);
            }
            assert!(joint.wear_volume() >= volume && joint.dissipated_energy() >= work);
            (volume, work) = (joint.wear_volume(), joint.dissipated_energy());
            close(volume, per_work * work, 1e-9 * volume, "V = k/sigma W");
        }
        assert!(joint.contact(0).is_some_and(|c| c.friction_coefficient_now() > 0.5));
    }
}

/// Cycles of equal contacts: to rounding without wear; with it, the second call begins at an
/// approach that is searched for.
#[test]
fn cycles_run_in_as_those_of_one() {
    for (parameters, accuracy) in [(running_in(USUAL), 1e-9), (wearing(USUAL), 1e-4)] {
        let mut one = FrettingContact::new(parameters.clone()).unwrap();
        let mut three = Interface::new(parameters, &[Summit::at_offset(0.0); 3]).unwrap();
        for cycles in [3.0, 300.0] {
            one.advance_cycles(FORCE, 1.5e-6, cycles).unwrap();
            three.advance_cycles(3.0 * FORCE, 1.5e-6, cycles).unwrap();
            close_to(three.dissipated_energy(), 3.0 * one.dissipated_energy(), accuracy, "W");
            close_to(three.tangential_force(), 3.0 * one.tangential_force(), accuracy, "T");
            close_to(three.friction_coefficient_now(), one.friction_coefficient_now(), accuracy, "mu");
        }
        assert!(one.friction_coefficient_now() > 0.5);
    }
}

/// A step that one contact refuses after others have run in leaves everything to the bit.
#[test]
fn a_refused_step_changes_nothing() {
    let profile = Profile::Table(sampled_sphere(200));
    for parameters in [running_in(USUAL), wearing(USUAL)] {
        let mut joint =
            Interface::new(Parameters { profile: profile.clone(), ..parameters }, &uneven()).unwrap();
        joint.start_at(4.0 * FORCE, [0.0; 2], 0.0).unwrap();
        joint.advance_to(4.0 * FORCE, [3e-6, 0.0], 0.0).unwrap();
        let (before, now) = (saved(&joint), joint.friction_coefficient_now());
        for force in [1e6, f64::NAN] {
            joint.advance_to(force, [-3e-6, 0.0], 0.0).unwrap_err();
            assert_eq!(saved(&joint), before);
            assert_eq!(joint.friction_coefficient_now(), now);
        }
    }
}

/// ∂μ/∂U against differences.
#[test]
fn the_derivatives_of_the_coefficient_are_its_differences() {
    let mut joint = Interface::new(running_in(100.0 * USUAL), &uneven()).unwrap();
    joint.start_at(4.0 * FORCE, [0.0; 2], 0.0).unwrap();
    for u in [3e-6, -2e-6, 2e-6] {
        joint.advance_to(4.0 * FORCE, [u, 0.0], 0.0).unwrap();
    }
    let slope = joint.friction_coefficient_gradient().displacement;
    let mut ahead = joint.clone();
    let step = 1e-9;
    ahead.advance_to(4.0 * FORCE, [2e-6 + step, 0.0], 0.0).unwrap();
    let difference = (ahead.friction_coefficient_now() - joint.friction_coefficient_now()) / step;
    assert!(slope > 0.0);
    close_to(slope, difference, 3e-3, "by the displacement");
}
